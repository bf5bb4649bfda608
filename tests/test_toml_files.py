"""Contents of data files, compared with the parser of the standard library."""

import os
import sys
import tomllib
from importlib import resources
from pathlib import Path

import pytest

from ehlectric.quantities.quantity import data_file
from ehlectric.toml_files import contents

PACKAGE = Path(str(resources.files("ehlectric")))


@pytest.fixture(params=[False, True], ids=["kept", "not kept"])
def file(request, tmp_path, monkeypatch):
    """A data file, in a folder where Python may keep its contents, or not."""
    monkeypatch.setattr(sys, "dont_write_bytecode", request.param)
    file = tmp_path / "inputs.toml"
    file.write_text("[oil]\nlimit = inf\ntexts = ['µ', 'a']\n", encoding="utf-8")
    return file


def test_contents_are_those_of_the_parser_at_each_call(file):
    expected = {"oil": {"limit": float("inf"), "texts": ["µ", "a"]}}
    first = contents(file)
    assert first == expected
    first["oil"]["texts"].append("b")
    assert contents(file) == expected
    assert (file.parent / "__pycache__").exists() is not sys.dont_write_bytecode


def test_a_changed_file_is_read_again(file):
    contents(file)
    file.write_text("[oil]\nlimit = 2\n", encoding="utf-8")
    assert contents(file) == {"oil": {"limit": 2}}
    # The same size, at another time.
    file.write_text("[oil]\nlimit = 3\n", encoding="utf-8")
    os.utime(file, (1e9, 1e9))
    assert contents(file) == {"oil": {"limit": 3}}


def test_a_module_of_the_same_name_stays_apart(file):
    file.with_suffix(".py").write_text("LIMIT = 1\n", encoding="utf-8")
    contents(file)
    kept = {path.name.split(".cpython")[0] for path in (file.parent / "__pycache__").glob("*")}
    assert kept <= {"inputs.toml"}


def test_all_data_files_are_read_as_they_are():
    """Python cannot keep dates, which TOML has."""
    files = sorted(PACKAGE.rglob("*.toml"))
    assert len(files) > 50
    for path in files:
        assert contents(path) == tomllib.loads(path.read_text(encoding="utf-8")), path


def test_an_archive_is_read_without_a_file():
    class Member:
        def read_text(self, **_):
            return "limit = 3"

    assert contents(Member()) == {"limit": 3}


def test_the_book_is_read_from_its_files():
    text = (PACKAGE / "quantities" / "sheets.toml").read_text(encoding="utf-8")
    assert data_file("ehlectric.quantities", "sheets.toml") == tomllib.loads(text)
