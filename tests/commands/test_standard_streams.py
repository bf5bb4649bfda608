"""Commands whose standard output or error is closed, missing or full, or whose reader leaves."""

import os
import shlex
import subprocess
import sys

import pytest

from tests.helpers.commands import COMMAND
from tests.helpers.places import EXAMPLES

pytestmark = pytest.mark.skipif(os.name == "nt", reason="redirections of a POSIX shell")
LINE = EXAMPLES / "line_contact.toml"
FULL = "error: standard output: cannot be written to, no space left on device\n"


def shell(words, redirection, cwd):
    """Exit status, output and errors of a command with a redirection."""
    line = f"{shlex.join(map(str, (COMMAND, *words)))} {redirection}"
    done = subprocess.run(["bash", "-c", line], cwd=cwd, capture_output=True, text=True, check=False)
    return done.returncode, done.stdout, done.stderr


@pytest.mark.slow
@pytest.mark.parametrize(
    ("redirection", "status"),
    [(">&-", 0), ("2>&-", 0), ("<&- >&- 2>&-", 0), ("2> /dev/full", 0), ("> /dev/full", 2)],
)
def test_a_stream_that_takes_nothing(tmp_path, redirection, status):
    found, output, errors = shell(("check", LINE), redirection, tmp_path)
    assert found == status
    assert errors == (FULL if status else "")
    assert bool(output) == (">&-" not in redirection.split() and not status)


@pytest.mark.slow
@pytest.mark.parametrize("redirection", ["2>&-", "2> /dev/full", ">&- 2>&-"])
def test_a_wrong_input_has_its_status_without_stderr(tmp_path, redirection):
    assert shell(("check", "no.toml"), redirection, tmp_path) == (2, "", "")


@pytest.mark.slow
@pytest.mark.parametrize(
    "words", ["bearings", "examples", "oils --json", "film --m 20 --l 10", "--version", "schema contact"]
)
def test_a_full_device_is_named_by_every_command(tmp_path, words):
    assert shell(words.split(), "> /dev/full", tmp_path) == (2, "", FULL)


@pytest.mark.slow
@pytest.mark.gate
def test_files_are_whole_where_all_streams_are_closed(tmp_path):
    """A closed stream has a low number, which the first file must not get."""
    words = ("oil", "fva-3", "--no-plots", "-o", "open")
    assert shell(words, "", tmp_path)[0] == 0
    assert shell((*words[:-1], "closed"), "<&- >&- 2>&-", tmp_path) == (0, "", "")
    assert (tmp_path / "closed" / "oil.csv").read_bytes() == (tmp_path / "open" / "oil.csv").read_bytes()


@pytest.mark.slow
def test_streams_that_python_does_not_have(tmp_path):
    """As with pythonw of Windows."""
    code = (
        "import sys; sys.stdout = sys.stderr = sys.__stdout__ = sys.__stderr__ = None\n"
        "from ehlectric.__main__ import main\n"
        "sys.argv = ['ehlectric', *sys.argv[1:]]; main()"
    )
    command = [sys.executable, "-c", code, "oil", "fva-3", "--no-plots", "-o", "out"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, check=False)
    assert (done.returncode, done.stdout, done.stderr) == (0, b"", b"")
    assert (tmp_path / "out" / "oil.csv").is_file()


@pytest.mark.slow
@pytest.mark.parametrize("words", ["oils", "check case.toml", "bearings"])
def test_a_reader_that_leaves_gives_the_status_of_sigpipe(tmp_path, words):
    """The reader takes nothing: what it takes first would depend on the moment at which it leaves."""
    (tmp_path / "case.toml").write_bytes(LINE.read_bytes())
    redirection = '| true; exit "${PIPESTATUS[0]}"'
    assert shell(words.split(), redirection, tmp_path) == (128 + 13, "", "")
