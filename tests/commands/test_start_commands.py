"""The commands that one begins with: init, examples, help, completion, and a start without POSIX."""

import json
import os
import re
import subprocess
import sys

import pytest

from ehlectric.commands.command_line import app
from ehlectric.commands.options import files_ending
from ehlectric.commands.start_commands import TEMPLATES, template
from ehlectric.runs.by_kind import RUNS
from ehlectric.runs.file_kinds import read_input
from ehlectric.runs.preview import preview_of
from tests.commands.conftest import CASE
from tests.helpers.each import each
from tests.helpers.gate import gated
from tests.helpers.places import EXAMPLES

KINDS = {
    "moving": "motion",
    **dict.fromkeys(("bearing", "tapered-pair", "needle", "thrust", "four-point"), "bearing"),
    "drive": "drive",
    **dict.fromkeys(("gear", "helical-gear"), "gear"),
    "e-axle": "axle",
    "sweep": "sweep",
    "uncertainty": "sweep",
}
COMMANDS = {"bearing": "bearing", "drive": "drive", "gear": "gear", "axle": "drive", "sweep": "sweep"}


@pytest.mark.slow
@pytest.mark.parametrize("kind", gated(TEMPLATES, "bearing", "line"))
def test_a_template_of_each_kind_is_written_checked_and_solved_as_it_is(ehlectric, tmp_path, kind):
    """In a folder of its own: it needs no other file."""
    done = ehlectric("init", "new.toml", "--kind", kind)
    assert done.returncode == 0, done.stderr
    file = read_input(tmp_path / "new.toml")
    found = file.kind
    assert found == KINDS.get(kind, "contact")
    command = COMMANDS.get(found, "run")
    schema = f"ehlectric-{found.replace('motion', 'contact')}.schema.json"
    for part in ("new.toml", schema, "ehlectric check new.toml", f"ehlectric {command} new.toml"):
        assert part in done.stdout
    assert preview_of(RUNS[found].read(file)).rows
    text = (tmp_path / "new.toml").read_text(encoding="utf-8")
    assert text.startswith(f"#:schema ./{schema}\n# ")
    # What is not published is marked; a line and a point have assumptions in their alternatives.
    assert "assumption" in text
    options = ["--no-plots"] if command in ("run", "bearing") else []
    # The contacts of the bearing take a minute: they are solved in a test of the example.
    options += ["--contacts", "formula"] if command == "bearing" else []
    done = ehlectric(command, "new.toml", "-o", "out", *options)
    assert done.returncode == 0, done.stderr


@pytest.mark.slow
@pytest.mark.gate
def test_examples_are_listed_and_copied_with_what_they_need(ehlectric, tmp_path):
    listed = ehlectric("examples")
    assert listed.returncode == 0
    names = sorted(path.stem for path in EXAMPLES.glob("*.toml"))
    assert [text.split()[0] for text in listed.stdout.splitlines()[:-1]] == names
    assert ehlectric("examples", "sweep", "-o", "one").returncode == 0
    # A sweep needs its case.
    assert sorted(path.name for path in (tmp_path / "one").iterdir()) == ["discharge.toml", "sweep.toml"]
    assert ehlectric("examples", "rough_contact.toml").returncode == 0
    assert (tmp_path / "surfaces" / "dektak-1.csv").is_file()
    assert ehlectric("check", "rough_contact.toml").returncode == 0
    # Both examples name one file, which a user need not remove.
    for name in ("duty_wltc", "duty_gear"):
        assert ehlectric("examples", name).returncode == 0
    (tmp_path / "rough_contact.toml").write_text("changed")
    again = ehlectric("examples", "rough_contact")
    assert again.stderr.startswith("error: rough_contact.toml: ")
    assert "--force" in again.stderr
    assert ehlectric("examples", "-o", "all", "-q").returncode == 0
    for path in EXAMPLES.glob("*.toml"):
        assert (tmp_path / "all" / path.name).read_bytes() == path.read_bytes()


def test_help_is_the_answer_to_no_words(typed):
    done = typed()
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout == typed("--help").stdout


@pytest.mark.slow
@each("command", [one.name for one in app.registered_commands])
def test_help_has_what_it_says_and_no_types_of_python(typed, command):
    text = typed(command, "--help").stdout
    assert "<bool>" not in text
    assert f"ehlectric {command} " in text
    assert "Examples:\n    ehlectric " in text
    # Every option is explained in a whole sentence.
    for option in text.partition("Options:\n")[2].partition("\n\n")[0].split("\n  -"):
        words = option.partition("  [default")[0].split()
        assert words[-1].endswith((".", "]")), option


@each("command, word", [("run", "[motion]"), ("check", "[discharge]")])
def test_tables_in_brackets_stand_in_the_help(typed, command, word):
    assert word in typed(command, "--help").stdout


@pytest.mark.slow
def test_a_shell_is_completed():
    """As bash asks: commands, and keys of an option that takes one of some names."""

    def completed(line):
        words = line.split(" ")
        environment = {
            "_EHLECTRIC_COMPLETE": "complete_bash", "COMP_WORDS": line, "COMP_CWORD": str(len(words) - 1),
        }  # fmt: skip
        program = [sys.executable, "-c", "from ehlectric.__main__ import main; main()"]
        done = subprocess.run(program, env=os.environ | environment, capture_output=True, text=True)
        return done.stdout.split()

    assert completed("ehlectric se") == ["sensitivity"]
    assert completed("ehlectric init --kind b") == ["bearing"]
    assert completed("ehlectric run --format ") == ["png", "svg", "pdf"]


def test_names_of_files_are_completed(tmp_path, monkeypatch):
    (tmp_path / "cases" / "more.d").mkdir(parents=True)
    for name in ("a.toml", "cases/b.toml", "cases/c.csv", ".hidden.toml"):
        (tmp_path / name).write_text("")
    monkeypatch.chdir(tmp_path)
    complete = files_ending(".toml")
    assert complete("") == ["a.toml", "cases/"]
    assert complete("cases/") == ["cases/b.toml", "cases/more.d/"]
    assert complete("ca") == ["cases/"]
    assert complete("none/") == []


@pytest.mark.slow
def test_varied_keys_of_a_sweep_are_completed(ehlectric, tmp_path, case_file, monkeypatch):
    from typer import Context
    from typer.main import get_command

    from ehlectric.commands.command_line import app
    from ehlectric.commands.sweep_commands import _varied_keys

    case_file.write_text(CASE.replace("801", "65"))
    (tmp_path / "sweep.toml").write_text(
        'case = "case.toml"\n[vary]\ncontact.entrainment_speed = ["1 m/s", "2 m/s"]\n'
    )
    assert ehlectric("sweep", "sweep.toml", "-o", "out", "--workers", 1, "-q").returncode == 0
    monkeypatch.chdir(tmp_path)
    context = Context(get_command(app))
    context.params["folder"] = "out"
    assert _varied_keys(context, "contact.") == ["contact.entrainment_speed"]
    assert _varied_keys(context, "bearing.") == []
    context.params["folder"] = "none"
    assert _varied_keys(context, "") == []


# What Windows lacks of the modules that are used here, and modules that it lacks altogether.
WITHOUT_POSIX = """
import os, signal, sys
lacking = {
    signal: ("SIGHUP", "SIGKILL", "SIGALRM", "SIGUSR1", "SIGCHLD", "SIGQUIT", "pthread_sigmask", "setitimer"),
    os: ("sysconf", "sched_getaffinity", "fork", "killpg", "setsid", "mkfifo", "nice", "statvfs"),
}
for module, names in lacking.items():
    for name in names:
        if hasattr(module, name):
            delattr(module, name)
for name in ("fcntl", "resource", "termios", "pwd", "grp", "tty", "pty"):
    sys.modules[name] = None
from ehlectric.__main__ import main
sys.argv = ["ehlectric", *sys.argv[1:]]
main()
"""


@pytest.mark.slow
@pytest.mark.parametrize(
    "words",
    [("--version",), ("check", "case.toml"), ("run", "case.toml", "-o", "out", "--no-plots")],
    ids=["version", "check", "run"],
)
def test_the_command_starts_where_posix_is_not(tmp_path, case_file, words):
    """SIGHUP and its like are taken away, as on Windows."""
    case_file.write_text(CASE.replace("801", "257"))
    program = [sys.executable, "-c", WITHOUT_POSIX, *words]
    done = subprocess.run(program, cwd=tmp_path, capture_output=True, text=True, timeout=600)
    assert done.returncode == 0, done.stderr
    assert "Traceback" not in done.stderr


@pytest.mark.slow
@pytest.mark.gate
def test_bearings_of_the_library_are_listed(ehlectric):
    """The 6208 as a person and as a program reads it; nothing is cut at the width of 80 characters."""
    done = ehlectric("bearings")
    assert done.returncode == 0, done.stderr
    assert "…" not in done.stdout
    (line,) = (line.split() for line in done.stdout.splitlines() if line.startswith("6208 "))
    assert line == ["6208", "40", "80", "18", "9", "x", "11.906", "60", "29.1", "17.9", "published"]
    assert "as 6314-C3 or SKF NU 210 ECP" in done.stdout
    listed = json.loads(ehlectric("bearings", "--json").stdout)
    (found,) = (bearing for bearing in listed if bearing["name"] == "nu-205")
    assert (found["elements"], found["roller_length"], found["static_rating"]) == (13, 0.008, 27700.0)
    assert (found["rating_of"], found["internal_geometry"]) == ("NSK NU 205 EW", "by rule")


def test_files_with_a_motor_state_that_the_second_bearing_is_equal():
    """All files with a motor but without the capacitance of the second bearing."""
    files = [*EXAMPLES.glob("*.toml"), *map(template, TEMPLATES)]
    with_motor = [path for path in files if re.search(r"^\[(case\.)?motor\]", path.read_text("utf-8"), re.M)]
    assert len(with_motor) >= 8
    missing = [path.name for path in with_motor if "second bearing" not in path.read_text("utf-8")]
    assert not missing
