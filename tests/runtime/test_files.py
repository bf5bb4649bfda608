"""Files that are written whole or not at all, with the permissions of any other file of the process."""

import errno
import json
import os
import stat
import subprocess
import sys
from pathlib import Path

import pytest

from ehlectric import InputError
from ehlectric.errors import WriteError
from ehlectric.runtime.files import (
    clear_left_behind,
    prepare,
    reading,
    whole,
    write,
    write_json,
    write_together,
)
from ehlectric.runtime.reading import refuse_unreadable

WRITE = """
import os, sys
from pathlib import Path
os.umask(int(sys.argv[1], 8))
calls = []
umask = os.umask
os.umask = lambda mask: calls.append(mask) or umask(mask)
from ehlectric.runtime.files import whole, write_json
write_json(Path(sys.argv[2]), {"a": 1})
with whole(Path(sys.argv[2]).with_suffix(".txt")) as path:
    path.write_text("text")
print(len(calls))
"""


@pytest.mark.slow
@pytest.mark.parametrize(("umask", "mode"), [("077", 0o600), ("022", 0o644), ("002", 0o664)])
def test_the_umask_holds_and_is_never_set(umask, mode, tmp_path):
    file = tmp_path / "summary.json"
    command = [sys.executable, "-c", WRITE, umask, file]
    assert subprocess.run(command, capture_output=True, text=True, check=True).stdout == "0\n"
    assert [stat.S_IMODE(path.stat().st_mode) for path in (file, file.with_suffix(".txt"))] == [mode] * 2


def test_a_change_of_the_umask_holds_for_the_next_file(tmp_path):
    """The umask is not that at the time of the import."""
    before = os.umask(0o077)
    try:
        write_json(tmp_path / "a.json", {})
        os.umask(0o022)
        write_json(tmp_path / "b.json", {})
    finally:
        os.umask(before)
    assert [stat.S_IMODE((tmp_path / name).stat().st_mode) for name in ("a.json", "b.json")] == [0o600, 0o644]


def test_json_is_written_whole_or_not_at_all(tmp_path):
    file = tmp_path / "summary.json"
    write_json(file, {"load": 20.0})
    with pytest.raises(ValueError, match="not JSON compliant"):
        write_json(file, {"load": float("nan")})
    assert json.loads(file.read_text()) == {"load": 20.0}
    assert list(tmp_path.iterdir()) == [file]


def test_a_file_that_cannot_be_read_is_refused(tmp_path):
    with pytest.raises(InputError) as refused:
        refuse_unreadable(tmp_path / "no.nc")
    assert (refused.value.key, refused.value.text) == (
        str(tmp_path / "no.nc"),
        "cannot be read, no such file or directory",
    )
    with pytest.raises(InputError, match=r"cannot be read, is a directory$"):
        refuse_unreadable(tmp_path)
    with pytest.raises(InputError, match=r"^x: cannot be read, broken$"), reading(Path("x")):
        raise OSError("Broken")


def full(part=b"half"):
    """Content that meets a full disk after some bytes."""

    def content(file):
        file.write(part)
        raise OSError(errno.ENOSPC, "No space left on device")

    return content


def named(path):
    return f"{path}: cannot be written to, no space left on device; free some space, or choose another folder"


def contents(folder):
    return {path.name: path.read_text() for path in folder.iterdir()}


def test_a_full_disk_is_one_line_that_names_the_file(tmp_path):
    write(tmp_path / "film.csv", b"old")
    with pytest.raises(WriteError) as told:
        write(tmp_path / "film.csv", full())
    assert str(told.value) == named(tmp_path / "film.csv")
    assert contents(tmp_path) == {"film.csv": "old"}


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="only Linux has a device that is always full")
def test_the_last_bytes_may_be_those_that_do_not_fit(tmp_path):
    """Python writes the end of a file when it is closed."""

    def content(file):
        os.dup2(os.open("/dev/full", os.O_WRONLY), file.fileno())
        file.write(b"short")

    with pytest.raises(WriteError, match="no space left"):
        write(tmp_path / "film.csv", content)
    assert not list(tmp_path.iterdir())


def test_an_error_about_another_file_is_left_as_it_is(tmp_path):
    def content(_file):
        (tmp_path / "missing").read_bytes()

    with pytest.raises(FileNotFoundError, match="missing"):
        write(tmp_path / "film.csv", content)
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("broken", ["a", "b", "c"])
def test_files_of_a_result_are_written_all_or_none(tmp_path, broken):
    """The earlier result stays where the new one does not fit."""
    earlier = {"a": "old a", "b": "old b", "figure.png": "old figure"}
    for name, text in earlier.items():
        (tmp_path / name).write_text(text)
    new = {name: full() if name == broken else name.encode() for name in "abc"}
    with pytest.raises(WriteError) as told:
        write_together(tmp_path, new, ["figure.png", "gone"])
    assert str(told.value) == named(tmp_path / broken)
    assert contents(tmp_path) == earlier
    files = write_together(tmp_path, {name: name.encode() for name in "abc"}, ["figure.png", "gone"])
    assert files == [tmp_path / name for name in "abc"]
    assert contents(tmp_path) == {"a": "a", "b": "b", "c": "c"}


def test_a_disk_without_any_space_is_refused_before_anything_is_solved(tmp_path, monkeypatch):
    monkeypatch.setattr("tempfile.TemporaryFile", lambda **_: Path("/dev/full").open("wb"))  # noqa: SIM115
    with pytest.raises(InputError) as told:
        prepare(tmp_path)
    assert str(told.value) == named(tmp_path)


LEFT = """
import os, signal, sys
from pathlib import Path
from ehlectric.runtime.files import whole
with whole(Path(sys.argv[1])) as beside:
    beside.write_text("half")
    os.kill(os.getpid(), signal.SIGKILL)
"""


def test_what_a_kill_left_is_removed_and_nothing_else(tmp_path):
    for name in ("film.png", "no_suffix"):
        subprocess.run([sys.executable, "-c", LEFT, tmp_path / name], check=False)
    left = [path.name for path in tmp_path.iterdir()]
    assert len(left) == 2
    assert all(name.startswith(".ehlectric-") for name in left)
    # Names that a user may have chosen, a folder and a link of the pattern, and a file that is being written.
    users = {
        ".ehlectric-notes",
        ".film-0123abcd.png",
        "ehlectric-0123456789abcdef.png",
        ".ehlectric-01.png",
    }
    for name in users:
        (tmp_path / name).touch()
    (tmp_path / ".ehlectric-0123456789abcdef.d").mkdir()
    (tmp_path / ".ehlectric-0123456789abcdef.nc").symlink_to(tmp_path / ".ehlectric-notes")
    with whole(tmp_path / "alive.png") as beside:
        clear_left_behind(tmp_path)
        assert beside.exists()
        kept = {path.name for path in tmp_path.iterdir()} - {beside.name}
    links = {".ehlectric-0123456789abcdef.d", ".ehlectric-0123456789abcdef.nc"}
    assert kept == users | links
