"""Forks of a process in which another thread solves, draws, starts a process or computes a property."""

import os
import subprocess
import sys

import pytest

from ehlectric.runtime.threads import Turn
from tests.commands.conftest import CASE

# The child solves and draws. If it hangs, a signal ends it after a time that only a hang takes [s].
FORK = """
import os, signal, sys, threading
from contextlib import ExitStack, nullcontext
from functools import cached_property
from ehlectric import Case, solve
from ehlectric.contact.contact_solution import Solution
from ehlectric.figures.style import style
from ehlectric.runtime.spawning import _without_script
from ehlectric.runtime.threads import one_blas_thread

def locks():
    properties = [each for each in vars(Solution).values() if isinstance(each, cached_property)]
    # Python 3.12 has none.
    return [getattr(each, "lock", nullcontext()) for each in properties]

def hold():
    with ExitStack() as stack:
        for each in (one_blas_thread(), style(), *locks()):
            stack.enter_context(each)
        held.set()
        end.wait()

def start():
    while not end.is_set():
        with _without_script():
            pass

def child():
    signal.alarm(20)
    result = solve(Case.from_toml("case.toml"))
    with style("journal"), _without_script():
        pass
    return result.summary()["converged"] and sys.modules["__main__"] is script

script = sys.modules["__main__"]
held, end = threading.Event(), threading.Event()
threads = [threading.Thread(target=target) for target in (hold, start)]
for thread in threads:
    thread.start()
held.wait()
statuses = []
for turn in range(3):
    number = os.fork()
    if number == 0:
        try:
            found = child()
        finally:
            os._exit(0 if found else 1)
    statuses.append(os.waitstatus_to_exitcode(os.waitpid(number, 0)[1]))
end.set()
for thread in threads:
    thread.join()
sys.exit(f"children ended with {statuses}" if any(statuses) else 0)
"""


@pytest.mark.slow
@pytest.mark.gate
@pytest.mark.skipif(not hasattr(os, "fork"), reason="the system has no forks")
def test_a_child_that_is_forked_beside_a_solution_solves(tmp_path):
    (tmp_path / "case.toml").write_text(CASE)
    done = subprocess.run(
        # Python warns of every fork beside threads.
        [sys.executable, "-W", "ignore::DeprecationWarning", "-c", FORK],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr


def test_a_thread_that_forks_in_its_own_turn_goes_on():
    """Such as one whose progress starts a process: parent and child leave their turns as they took them."""
    turn = Turn()
    with turn.taken():
        turn._renew()
        with turn.taken():
            pass
    with turn.taken():
        pass
