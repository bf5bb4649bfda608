"""Runs of tests: three of them contain every test, a clock ends them, and a browser has a second try."""

import subprocess

import pytest

from tests import schedule
from tests.helpers.places import ROOT

FILES = sorted(path.relative_to(ROOT).as_posix() for path in (ROOT / "tests").rglob("test_*.py"))
NOTHING = frozenset()

SUITE = """
import pathlib
import pytest

@pytest.mark.slow
def test_long():
    pass

@pytest.mark.{mark}
def test_that_fails_at_first():
    tries = pathlib.Path("tries")
    tries.write_text(tries.read_text() + "x" if tries.exists() else "x")
    assert len(tries.read_text()) > {failures}
"""


@pytest.fixture
def suite(tmp_path, monkeypatch):
    """Function that writes a suite whose marked test fails so many times, and goes to its folder.

    It has two folders with a file of fixtures each, for which pytest compares its plugins.
    """

    def write(mark, failures):
        (tmp_path / "pytest.ini").write_text("[pytest]\nmarkers =\n    slow\n    gate\n    browser\n")
        for folder in ("one", "two"):
            (tmp_path / folder).mkdir()
            (tmp_path / folder / "conftest.py").touch()
        (tmp_path / "one" / "test_suite.py").write_text(SUITE.format(mark=mark, failures=failures))
        (tmp_path / "two" / "test_other.py").write_text("def test_other():\n    pass\n")
        monkeypatch.chdir(tmp_path)
        monkeypatch.setenv("PYTHONPATH", str(ROOT))
        monkeypatch.setenv("PYTEST_ADDOPTS", "-p no:cacheprovider")

    return write


def test_three_consecutive_commits_run_every_test(tmp_path, monkeypatch):
    monkeypatch.delenv(schedule.PART, raising=False)
    monkeypatch.chdir(tmp_path)
    author = ("-c", "user.name=a", "-c", "user.email=a@b")
    subprocess.run(["git", "init", "--quiet"], check=True)
    parts = []
    for number in range(4):
        message = ("commit", "--quiet", "--allow-empty", "-m", f"Commit {number}")
        subprocess.run(["git", *author, *message], check=True)
        parts.append(schedule.part_of_commit())
    assert sorted(parts[:3]) == [1, 2, 3]
    assert parts[3] == parts[0]
    run = [{file for file in FILES if schedule.is_in_run(file, "part", part, NOTHING)} for part in parts[:3]]
    assert set().union(*run) == set(FILES)
    assert all(not first & second for first, second in zip(run, [*run[1:], run[0]], strict=True))


def test_a_chosen_part_and_a_wrong_one(monkeypatch):
    monkeypatch.setenv(schedule.PART, "3/3")
    assert schedule.part_of_commit() == 3
    for wrong in ("4/3", "0/3", "1/5", "2"):
        monkeypatch.setenv(schedule.PART, wrong)
        with pytest.raises(SystemExit, match=wrong):
            schedule.part_of_commit()


@pytest.mark.slow
@pytest.mark.gate
@pytest.mark.skipif(not (ROOT / ".git").exists(), reason="the source is no clone")
def test_the_clone_without_history_takes_the_date(tmp_path, monkeypatch):
    monkeypatch.delenv(schedule.PART, raising=False)
    subprocess.run(
        ["git", "clone", "--quiet", "--depth", "1", f"file://{ROOT}", tmp_path / "clone"], check=True
    )
    monkeypatch.chdir(tmp_path / "clone")
    assert schedule.part_of_commit() in (1, 2, 3)
    # A short history says nothing about what changed: the long tests of all rooms may run.
    assert {"film", "field", "app", "commands"} <= schedule.changed_rooms()


@pytest.mark.slow
@pytest.mark.gate
def test_rooms_above_a_changed_one_are_changed():
    """The contract of imports: contacts and all above them use films, and nothing below does."""
    rooms = schedule.with_importers({"film"})
    assert {"film", "contact", "bearing", "drive", "gear", "axle", "sweep", "commands", "app"} <= rooms
    assert not rooms & {"field", "formulas", "lubricant", "quantities", "runtime"}
    assert schedule.with_importers({"app"}) == {"app", "commands", "__main__"}


def test_the_rest_of_changed_rooms_is_what_the_part_leaves():
    rooms = {"film", "app"}
    rest = {file for file in FILES if schedule.is_in_run(file, "changed", 1, rooms)}
    assert {schedule.room_of(file) for file in rest} == rooms
    assert rest == {file for file in FILES if schedule.room_of(file) in rooms and schedule.part_of(file) != 1}


@pytest.mark.slow
@pytest.mark.gate
@pytest.mark.parametrize(
    ("mark", "failures", "passed"), [("browser", 1, True), ("browser", 2, False), ("gate", 1, False)]
)
def test_a_test_of_the_browser_has_a_second_try_alone(suite, capfd, mark, failures, passed):
    suite(mark, failures)
    assert schedule.passes("all", "-m", "not slow", "-n", "1", until=float("inf")) is passed
    outcome = f"one/test_suite.py::test_that_fails_at_first: failed, {'passed' if passed else 'failed'} alone"
    assert (outcome in capfd.readouterr().out) is (mark == "browser")


@pytest.mark.slow
@pytest.mark.gate
def test_no_test_starts_after_the_time_of_a_run(suite, capfd):
    suite("gate", 9)
    assert schedule.passes("all", "-n", "2", until=0.0)
    printed = capfd.readouterr().out
    assert "3 tests not run" in printed
    assert "one/test_suite.py::test_long" in printed
    assert not (ROOT / "tries").exists()
