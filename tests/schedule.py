"""Runs of tests that fit a machine: ``python -m tests.schedule gate part changed``, as ``.ci/run`` does.

The long tests have three fixed parts. A run takes one part, so that three consecutive commits run all tests;
then the other long tests of the rooms that changed lately, and of the rooms that import them. A clock stops
the start of new tests. A test of the app that fails in the browser runs once more alone.
"""

from __future__ import annotations

import argparse
import datetime
import json
import os
import subprocess
import sys
import tempfile
import time
import zlib
from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path

import pytest

from tests.durations import durations, tables
from tests.helpers.shared import SHARED

PARTS = 3
COMMITS = 50  # whose changes count as late
MINUTES = 65.0  # after the beginning of a run, in which tests may start

# Time at which .ci/run began [s since 1970], and the part that a user wants, such as 2/3.
BEGIN, PART = "EHLECTRIC_BEGIN", "PART"

SOURCE = "src/ehlectric/"
NOT_RUN = "not run: the time of this run is up"

# Folders of tests of several rooms: what changes a room below the commands changes them.
ABOVE_ALL = "commands"


def part_of(test: str) -> int:
    """Part of a test, from 1 to 3, by its file: the tests of a file share what they solve.

    Examples
    --------
    >>> part_of("tests/film/test_a.py::test_b[1]") == part_of("tests/film/test_a.py::test_c")
    True
    """
    return zlib.crc32(test.partition("::")[0].encode()) % PARTS + 1


def room_of(path: str) -> str:
    """Room of a file of the source or of the tests; empty for another file.

    Examples
    --------
    >>> room_of("src/ehlectric/film/mesh.py"), room_of("tests/film/test_mesh.py"), room_of("docs/conf.py")
    ('film', 'film', '')
    >>> room_of("src/ehlectric/errors.py"), room_of("tests/test_types.py"), room_of("tests/attack/kills.py")
    ('errors', 'commands', 'commands')
    """
    for top in (SOURCE, "tests/"):
        if path.startswith(top) and path.endswith((".py", ".pyi", ".toml")):
            room = path.removeprefix(top).partition("/")[0].partition(".")[0]
            return room if top == SOURCE or Path(SOURCE, room).exists() else ABOVE_ALL
    return ""


def with_importers(rooms: Iterable[str]) -> frozenset[str]:
    """Rooms, and all rooms that import from them."""
    import grimp

    graph = grimp.build_graph("ehlectric")
    importers = {
        name.split(".")[1]
        for room in rooms
        if f"ehlectric.{room}" in graph.modules
        for name in graph.find_downstream_modules(f"ehlectric.{room}", as_package=True)
        if "." in name
    }
    return frozenset(rooms) | importers


def _git(*words: str) -> str:
    return subprocess.run(["git", *words], capture_output=True, text=True, check=True).stdout.strip()


def changed_rooms(commits: int = COMMITS) -> frozenset[str]:
    """Rooms that changed in the last commits, with the rooms that import them; all for a short history."""
    count = int(_git("rev-list", "--count", "HEAD"))
    if count <= commits:
        return frozenset(path.stem for path in Path(SOURCE).iterdir())
    names = _git("diff", "--name-only", f"HEAD~{commits}", "HEAD").splitlines()
    sources = {room_of(name) for name in names if name.startswith(SOURCE)} - {""}
    tests = {room_of(name) for name in names if name.startswith("tests/")} - {""}
    return with_importers(sources) | tests


def part_of_commit() -> int:
    """Part that the present commit runs; the date decides in a clone without history."""
    if wanted := os.environ.get(PART):
        number, _, of = wanted.partition("/")
        if of != str(PARTS) or number not in map(str, range(1, PARTS + 1)):
            raise SystemExit(f"{PART} is 1/{PARTS} to {PARTS}/{PARTS}, not {wanted}")
        return int(number)
    if _git("rev-parse", "--is-shallow-repository") == "true":
        return datetime.datetime.now(datetime.UTC).date().toordinal() % PARTS + 1
    return int(_git("rev-list", "--count", "HEAD")) % PARTS + 1


def is_in_run(test: str, run: str, part: int, rooms: frozenset[str]) -> bool:
    """Whether a long test belongs to a run: ``part``, or ``changed`` for the rest of some rooms."""
    if run == "part":
        return part_of(test) == part
    if run == "changed":
        return part_of(test) != part and room_of(test.partition("::")[0]) in rooms
    return True


# The plugin of pytest: ``-p tests.schedule``.


def pytest_addoption(parser: pytest.Parser) -> None:
    group = parser.getgroup("schedule")
    group.addoption("--run-of", default="", help="which long tests run: part or changed")
    group.addoption("--part", type=int, default=0)
    group.addoption("--rooms", default="")
    group.addoption("--until", type=float, default=float("inf"), help="time after which no test starts")
    group.addoption("--outcomes", default="", help="file to which the failed tests are added")


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    run, part = config.getoption("--run-of"), config.getoption("--part")
    rooms = frozenset(config.getoption("--rooms").split(","))
    left_out = [item for item in items if not is_in_run(item.nodeid, run, part, rooms)]
    if left_out:
        config.hook.pytest_deselected(items=left_out)
        items[:] = [item for item in items if is_in_run(item.nodeid, run, part, rooms)]


@pytest.hookimpl(tryfirst=True)
def pytest_runtest_setup(item: pytest.Item) -> None:
    if time.time() > item.config.getoption("--until"):
        pytest.skip(NOT_RUN)


@dataclass(eq=False)  # pytest keeps its plugins in sets
class _Outcomes:
    """Failed tests of a run, and those that the clock left out."""

    path: str
    failed: dict[str, bool] = field(default_factory=dict)  # whether a browser is driven
    left_out: list[str] = field(default_factory=list)

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        if report.failed:
            self.failed[report.nodeid] = "browser" in report.keywords
        elif report.skipped and NOT_RUN in str(report.longrepr):
            self.left_out.append(report.nodeid)

    def pytest_collectreport(self, report: pytest.CollectReport) -> None:
        if report.failed:
            self.failed[report.nodeid] = False

    def pytest_terminal_summary(self, terminalreporter: pytest.TerminalReporter) -> None:
        if self.left_out:
            terminalreporter.section(f"{len(self.left_out)} tests not run: the time of this run is up")
            for name in self.left_out:
                terminalreporter.line(name)

    def pytest_sessionfinish(self) -> None:
        Path(self.path).write_text(json.dumps(self.failed))


def pytest_configure(config: pytest.Config) -> None:
    # The process that starts the others sees the outcomes of all.
    if config.getoption("--outcomes") and not hasattr(config, "workerinput"):
        config.pluginmanager.register(_Outcomes(config.getoption("--outcomes")), "outcomes")


# The runs.

SELECTIONS = {
    "gate": "not slow or gate",
    "part": "slow and not gate",
    "changed": "slow and not gate",
    "slow": "slow",
}
_NO_TESTS = 5


def run_pytest(name: str, *words: str, until: float) -> tuple[int, dict[str, bool]]:
    """Exit status of a run of pytest, and its failed tests with whether each one drives a browser."""
    outcomes = Path("build") / f"failed-{name}.json"
    outcomes.parent.mkdir(exist_ok=True)
    outcomes.unlink(missing_ok=True)
    command = [
        sys.executable, "-m", "pytest", "-p", "tests.schedule", f"--junitxml=build/tests-{name}.xml",
        f"--outcomes={outcomes}", f"--until={until}", *words,
    ]  # fmt: skip
    status = subprocess.run(command, check=False).returncode
    return status, json.loads(outcomes.read_text()) if outcomes.exists() else {}


def passes(name: str, *words: str, until: float) -> bool:
    """Whether a run of pytest passes; failed tests of the browser get a second try alone."""
    status, failed = run_pytest(name, *words, until=until)
    if status in (0, _NO_TESTS):
        return True
    if status != 1 or not failed or not all(failed.values()):
        return False
    again = ["-n", "0", "-m", "slow or not slow", *failed]
    second, twice = run_pytest(f"{name}-again", *again, until=float("inf"))
    if second > 1:
        print(f"The second try ended with status {second}, before its tests")
        return False
    for test in failed:
        print(f"{test}: failed, {'failed' if test in twice else 'passed'} alone")
    return second == 0


def main(words: list[str]) -> int:
    """Run tests as named in the words of a command; 1 where some failed."""
    parser = argparse.ArgumentParser(prog="python -m tests.schedule", description=__doc__)
    parser.add_argument("runs", nargs="+", choices=SELECTIONS)
    parser.add_argument("--minutes", type=float, default=MINUTES, help="in which tests may start")
    given = parser.parse_args(words)
    until = float(os.environ.get(BEGIN, time.time())) + 60.0 * given.minutes
    part = part_of_commit() if {"part", "changed"} & set(given.runs) else 0
    rooms = changed_rooms() if "changed" in given.runs else frozenset()
    if part:
        print(f"Part {part}/{PARTS} of the long tests; another one with: {PART}=1/{PARTS}")
    if rooms:
        print(f"Rooms that changed in {COMMITS} commits or import these: {', '.join(sorted(rooms))}")
    with tempfile.TemporaryDirectory() as folder:
        # Films that several tests read are solved once in a run.
        os.environ.setdefault(SHARED, folder)
        return 0 if _all_pass(given.runs, part, rooms, until) else 1


def _all_pass(runs: list[str], part: int, rooms: frozenset[str], until: float) -> bool:
    passed = True
    for run in runs:
        print(f"Tests: {run}", flush=True)
        selected = ["-m", SELECTIONS[run], f"--run-of={run}", f"--part={part}", f"--rooms={','.join(rooms)}"]
        passed &= passes(run, *selected, until=until)
        print(tables(durations(Path(f"build/tests-{run}.xml"))), flush=True)
    return passed


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
