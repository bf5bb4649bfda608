"""Answers that are kept from one start of the app to the next."""

import pytest

from ehlectric.app import kept_answers

ANSWERS = {"a call": 1.5, "another": ("text", None)}


@pytest.fixture
def path(tmp_path):
    return tmp_path / "folder" / "answers"


def test_answers_are_kept_for_the_same_program(path, monkeypatch):
    kept_answers.write(ANSWERS, path)
    assert kept_answers.read(path) == ANSWERS
    assert [file.name for file in path.parent.iterdir()] == ["answers"]
    monkeypatch.setattr(kept_answers, "_state", lambda: "another program")
    assert kept_answers.read(path) == {}


def test_a_changed_file_of_the_package_is_another_program(tmp_path, monkeypatch):
    monkeypatch.setattr(kept_answers, "_PACKAGE", tmp_path)
    module = tmp_path / "module.py"
    module.write_text("1")
    before = kept_answers._state()
    (tmp_path / "__pycache__").mkdir()
    (tmp_path / "__pycache__" / "module.pyc").write_text("1")
    assert kept_answers._state() == before
    module.write_text("10")
    assert kept_answers._state() != before


def test_a_file_that_cannot_be_read_or_written_keeps_nothing(path):
    assert kept_answers.read(path) == {}
    kept_answers.write(ANSWERS, path)
    path.write_bytes(path.read_bytes()[:-4])
    assert kept_answers.read(path) == {}
    kept_answers.write(ANSWERS, path / "below a file")
    assert not list(path.parent.glob("*.*"))


def test_where_python_keeps_no_modules_no_answers_are_kept(monkeypatch):
    monkeypatch.setattr("sys.dont_write_bytecode", True)
    assert kept_answers._path() is None
    monkeypatch.setattr("sys.dont_write_bytecode", False)
    assert kept_answers._path().parent.name == "__pycache__"
