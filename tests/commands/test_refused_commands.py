"""Wrong commands in a folder with small files: one line says what was got and taken, nothing is written.

``tests/data/refusals/commands`` holds the files of the folder (their texts, or copies of files of the
repository), and for each command its words, its exit status and the parts that the line must have.
"""

import shutil
import tomllib

import pytest

from tests.helpers.places import ROOT

FILES = sorted((ROOT / "tests" / "data" / "refusals" / "commands").glob("*.toml"))


def fill(folder, data):
    """Make the files and folders in which the commands are typed."""
    for name in data.get("folders", ()):
        (folder / name).mkdir()
    for name, source in data.get("copies", {}).items():
        shutil.copy(ROOT / source, folder / name)
    for name, text in data.get("files", {}).items():
        (folder / name).parent.mkdir(exist_ok=True)
        (folder / name).write_text(text, encoding="utf-8")


def contents(folder):
    """Contents of all files below a folder, None for a folder."""
    return {path: path.read_bytes() if path.is_file() else None for path in folder.rglob("*")}


@pytest.mark.slow
@pytest.mark.parametrize("file", FILES, ids=[file.stem for file in FILES])
def test_refused_commands(file, typed, tmp_path, subtests):
    data = tomllib.loads(file.read_text(encoding="utf-8"))
    fill(tmp_path, data)
    before = contents(tmp_path)
    for entry in data["refused"]:
        with subtests.test(" ".join(entry["words"])):
            done = typed(*entry["words"])
            assert (done.returncode, done.stdout) == (entry["status"], ""), done.stderr
            assert done.stderr.startswith("error: ")
            assert done.stderr.count("\n") == 1
            assert len(done.stderr) < 500
            assert [part for part in entry["names"] if part not in done.stderr] == []
            assert contents(tmp_path) == before
