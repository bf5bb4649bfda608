"""Commands that are given a damaged result end with one line and status 2, and draw nothing."""

import shutil
import sqlite3
from contextlib import closing

import pytest

from ehlectric.runtime.hdf5_guard import seal_of
from tests.helpers.each import each
from tests.helpers.places import ROOT

RELEASE = ROOT / "tests" / "data" / "releases" / "1.0.0"


@pytest.fixture
def folder(tmp_path):
    shutil.copytree(RELEASE / "line", tmp_path / "out")
    return tmp_path / "out"


def refused(done):
    assert (done.returncode, done.stdout) == (2, "")
    assert "Traceback" not in done.stderr
    text = " ".join(done.stderr.split())
    assert text.startswith("error: ")
    assert "is damaged" in text
    return text


@pytest.mark.slow
def test_plot_of_a_damaged_header(ehlectric, folder):
    """A byte of the header, without a seal and with one."""
    path = folder / "result.nc"
    content = bytearray(path.read_bytes()[: -len(seal_of([b""]))])
    content[96:104] = b"\xff" * 8
    path.write_bytes(content)
    assert "is damaged: HDF5 cannot read it" in refused(ehlectric("plot", "out"))
    shutil.copy(RELEASE / "line" / "result.nc", path)
    content = bytearray(path.read_bytes())
    content[-5000] ^= 1
    path.write_bytes(content)
    assert "its bytes are not those that were written" in refused(ehlectric("plot", "out"))
    assert sorted(one.suffix for one in folder.iterdir()) == [".json", ".nc"]


@each(
    "statement, names",
    [
        ("UPDATE results SET summary = '[]'", ["summary", "point"]),
        ("UPDATE sweep SET value = '3' WHERE name = 'axes'", ["axes"]),
        ("UPDATE points SET inputs = '7'", ["point"]),
    ],
)
def test_commands_on_an_edited_sweep(statement, names, typed, tmp_path):
    shutil.copy(RELEASE / "sweep" / "sweep.sqlite", tmp_path)
    with closing(sqlite3.connect(tmp_path / "sweep.sqlite")) as file, file:
        file.execute(statement)
    for words in (("map", ".", "--x", "grid.nodes"), ("sensitivity", "."), ("plot", ".")):
        text = refused(typed(*words))
        assert [name for name in names if name not in text] == []
    assert [path.name for path in tmp_path.iterdir()] == ["sweep.sqlite"]
