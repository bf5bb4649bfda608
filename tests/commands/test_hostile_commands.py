"""Commands that are given special files, hostile texts and names with control characters."""

import os

import pytest

from tests.commands.conftest import CASE
from tests.helpers.each import each

ONLY_POSIX = pytest.mark.skipif(os.name == "nt", reason="Windows has no such files and names")
NAME = "a\x1b[31m\nb\u202e.toml"
SHOWN = r"a\x1b[31m\nb\u202e.toml"


def refusal(done):
    """The single line of a command that refuses its input."""
    assert done.returncode == 2
    assert done.stdout == ""
    assert done.stderr.startswith("error: ")
    assert done.stderr.count("\n") == 1
    assert done.stderr.rstrip("\n").isprintable()
    return done.stderr


@pytest.mark.slow
@ONLY_POSIX
@each("command", ["check", "run", "bearing", "sweep", "plot", "surface"])
@pytest.mark.parametrize("kind", ["pipe", "zero"])
def test_special_files_end_every_command_in_one_line(ehlectric, tmp_path, command, kind):
    (tmp_path / "case.toml").unlink(missing_ok=True)
    if kind == "pipe":
        os.mkfifo(tmp_path / "case.toml")
    else:
        (tmp_path / "case.toml").symlink_to("/dev/zero")
    words = {"pipe": "it is a pipe", "zero": "it is a device"}[kind]
    assert f"case.toml: cannot be read, {words}" in refusal(ehlectric(command, "case.toml"))
    assert [path.name for path in tmp_path.iterdir()] == ["case.toml"]


@pytest.mark.slow
@ONLY_POSIX
def test_names_with_control_characters_are_escaped(ehlectric, tmp_path):
    assert SHOWN in refusal(ehlectric("check", NAME))
    assert SHOWN in refusal(ehlectric("plot", NAME))
    assert r"\x1b" in refusal(ehlectric("no\x1bcommand"))
    assert r"\x1b" in refusal(ehlectric("check", "--no\x1boption"))
    done = ehlectric("init", NAME)
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout.startswith(f"written: {SHOWN}\n")
    assert "\x1b" not in done.stdout
    assert (tmp_path / NAME).is_file()


@pytest.mark.slow
@ONLY_POSIX
def test_a_folder_with_control_characters_is_escaped(ehlectric, case_file):
    done = ehlectric("run", case_file.name, "-o", "out\x1b[2J", "--no-plots")
    assert done.returncode == 0
    assert r"written to out\x1b[2J:" in done.stdout
    assert "\x1b" not in done.stdout + done.stderr


@each("letter", ["\\u202e", "\\u2028", "\\u0085", "\\u001b", "\\u200b"])
def test_titles_with_hidden_characters_are_refused(typed, tmp_path, letter):
    (tmp_path / "case.toml").write_text(CASE.replace('"Test"', f'"Te{letter}st"'))
    assert "title: got 'Te" in refusal(typed("check", "case.toml"))


@each("value", ["1" * 2000 + "y\\nz", "1 " + "a" * 200_000, "1 " + "m*" * 3000 + "m"])
def test_a_hostile_quantity_ends_in_a_short_line(typed, tmp_path, value):
    (tmp_path / "case.toml").write_text(CASE.replace('"14.1 mm"', f'"{value}"'))
    line = refusal(typed("check", "case.toml"))
    assert "contact.reduced_radius: got '1" in line
    assert len(line) < 300


@pytest.mark.slow
def test_a_title_that_is_a_formula_is_none_in_sweep_csv(ehlectric, tmp_path):
    (tmp_path / "case.toml").write_text(CASE.replace("801", "401"))
    vary = 'title = ["=HYPERLINK(A1)", "b"]\n"grid.nodes" = [401, 601]\n'
    (tmp_path / "sweep.toml").write_text(f'case = "case.toml"\ndesign = "paired"\n[vary]\n{vary}')
    done = ehlectric("sweep", "sweep.toml", "-o", "out", "--workers", "1")
    assert done.returncode == 0, done.stderr
    text = (tmp_path / "out" / "sweep.csv").read_text(encoding="utf-8")
    assert ",'=HYPERLINK(A1)," in text
    assert ",=HYPERLINK" not in text
