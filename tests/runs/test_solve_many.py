"""Many cases in parallel: results as they finish, errors in their place, and processes that die."""

import itertools
import os
import signal
import subprocess
import sys

import pytest

from ehlectric import Case, InputError, LostError, solve, solve_many
from ehlectric.runs import solve as module
from tests.conftest import PAPER_CONTACT
from tests.helpers.bearings import BALLS, bearing_case
from tests.helpers.each import each

CONTACT = {"contact": PAPER_CONTACT, "lubricant": {"base": "paper"}, "grid": {"nodes": 129}}
CASES = [Case.from_dict(CONTACT).replace({"contact.entrainment_speed": speed}) for speed in (1.0, 2.0, 4.0)]


def dies(case):
    """Solve a case, but die on that with 131 nodes."""
    if isinstance(case, Case) and case.grid.nodes == 131:
        os.kill(os.getpid(), signal.SIGKILL)
    return solve_case(case)


solve_case = module.solve_case


def test_in_this_process_in_their_order():
    found = list(solve_many([*CASES, bearing_case(BALLS, contacts="formula")], workers=1))
    assert [one.number for one in found] == [0, 1, 2, 3]
    assert [one.result for one in found[:3]] == [solve(case) for case in CASES]
    assert found[3].result.converged


def test_an_error_stands_in_the_place_of_a_result():
    given = [CASES[0], {"contact": {}}, "nowhere.toml", CASES[1]]
    found = {one.number: one for one in solve_many(given, workers=1)}
    assert [found[k].error is None for k in range(4)] == [True, False, False, True]
    assert isinstance(found[1].error, InputError)
    assert found[1].result is None
    assert "nowhere.toml: cannot be read" in str(found[2].error)


@pytest.mark.slow
@pytest.mark.parametrize("workers", [1, 2])
def test_progress_is_told_for_each_case(workers):
    """How many are finished, of how many; their number is not known of what has no length."""
    told = []
    given = [CASES[0].replace({"title": "Slow"}), {"contact": {}}]
    found = [
        one.number for one in solve_many(given, workers=workers, progress=lambda *values: told.append(values))
    ]
    titles = {0: "Slow", 1: "case 1"}
    assert told == [(done, 2, titles[number]) for done, number in enumerate(found, 1)]
    list(solve_many(iter(given), workers=1, progress=lambda *values: told.append(values)))
    assert told[-1] == (2, 0, "case 1")
    with pytest.raises(InputError, match=r"^progress: got True; expected a function"):
        solve_many(given, progress=True)


@pytest.mark.slow
def test_in_processes():
    found = {number: result for number, result, error in solve_many(CASES, workers=2) if error is None}
    assert {number: result == solve(CASES[number]) for number, result in found.items()} == {
        0: True,
        1: True,
        2: True,
    }


@pytest.mark.slow
def test_errors_come_back_from_processes():
    (one,) = solve_many([{"contact": {}}], workers=2)
    assert isinstance(one.error, InputError)
    assert one.error.key == "contact.reduced_radius"


@pytest.mark.slow
def test_cases_may_be_endless():
    """They are read as processes get free, and the processes end with the loop."""
    read = []

    def endless():
        for number in itertools.count():
            read.append(number)
            yield CASES[number % 3]

    for one in solve_many(endless(), workers=2):
        if one.number >= 3:
            break
    assert len(read) < 20


@pytest.mark.slow
@pytest.mark.gate
def test_a_process_that_dies_costs_only_its_case(monkeypatch):
    monkeypatch.setattr(module, "solve_case", dies)
    deadly = CASES[0].replace({"grid.nodes": 131})
    found = {one.number: one for one in solve_many([CASES[0], deadly, CASES[1]], workers=2)}
    assert isinstance(found[1].error, LostError)
    assert "killed twice" in str(found[1].error)
    assert found[0].result == solve(CASES[0])
    assert found[2].result == solve(CASES[1])


@each("workers", [0, -1, 1.5, True, "2"])
def test_workers_are_a_number(workers):
    with pytest.raises(InputError, match=r"workers: got .*; expected a whole number of at least 1"):
        next(solve_many(CASES, workers=workers))


@pytest.mark.slow
def test_a_script_needs_no_main_guard(tmp_path):
    """Processes do not import the script: it is run once, and its calls may stand at its top level."""
    script = tmp_path / "script.py"
    script.write_text(
        "import ehlectric\n"
        "print('run')\n"
        f"for one in ehlectric.solve_many([{CONTACT!r}] * 2, workers=2):\n"
        "    print(one.number, one.result.converged)\n",
        encoding="utf-8",
    )
    done = subprocess.run([sys.executable, script], capture_output=True, text=True, timeout=600)
    assert (done.returncode, done.stderr) == (0, "")
    assert sorted(done.stdout.splitlines()) == ["0 True", "1 True", "run"]


@pytest.mark.slow
def test_tables_may_have_values_of_classes_of_the_script(tmp_path):
    """Processes cannot import these classes."""
    script = tmp_path / "script.py"
    script.write_text(
        "import enum, ehlectric\n"
        "class Oil(enum.StrEnum):\n"
        "    PAPER = 'paper'\n"
        f"table = {CONTACT!r} | {{'lubricant': {{'base': Oil.PAPER}}}}\n"
        "for one in ehlectric.solve_many([table, table], workers=2):\n"
        "    print(one.result.converged, one.error)\n",
        encoding="utf-8",
    )
    done = subprocess.run([sys.executable, script], capture_output=True, text=True, timeout=600)
    assert (done.returncode, done.stderr, done.stdout) == (0, "", "True None\n" * 2)


@each("one", [CASES[0], CONTACT, "case.toml", 3])
def test_a_single_case_is_no_list_of_cases(one):
    with pytest.raises(
        InputError, match=rf"^cases: got '{type(one).__name__}'; expected a list of cases; solve "
    ):
        solve_many(one)
