"""Files that are written whole or not at all, with the permissions of any other file of the process."""

import json
import os
import stat
import subprocess
import sys
from pathlib import Path

import pytest

from ehlectric import InputError
from ehlectric.runtime.files import reading, write_json
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
