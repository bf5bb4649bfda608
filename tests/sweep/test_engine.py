"""Points solved by executors: outcomes of all kinds, processes that die, and executors that go away."""

import os
import pickle
import pickletools
import signal
import time
from concurrent.futures import CancelledError, Executor, Future, ThreadPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from dataclasses import replace

import numpy as np
import pytest

from ehlectric import ConvergenceError, InputError, solve
from ehlectric.bearing.speed_curves import over_speed
from ehlectric.errors import LostError
from ehlectric.runtime import tasks as runtime_tasks
from ehlectric.runtime.worker_processes import Crew, cores, crew_of, processes
from ehlectric.sweep import engine as sweep_engine
from ehlectric.sweep.engine import Outcome, run_points, solve_point
from ehlectric.version import __version__
from tests.helpers.bearings import BALLS, bearing_case
from tests.helpers.each import each
from tests.helpers.sweeps import CASE, DEADLY, NODES, SLOW, SPEED, solve_or_die


def table(**changes):
    return CASE.replace({NODES: 129} | changes).to_dict()


def points(nodes):
    """Points of so many nodes, their keys their places."""
    return [(str(place), table(**{NODES: count, SPEED: 1.0 + place})) for place, count in enumerate(nodes)]


def found_by(crew, tasks):
    """Outcomes by key; each once."""
    found = {}

    def done(some):
        for key, outcome in some:
            assert key not in found
            found[key] = outcome

    run_points(tasks, crew, done)
    return found


def with_deaths(crew):
    """The crew, with the function that dies of deadly points."""
    return replace(
        crew, submit=lambda call, *v: crew.submit(solve_or_die if call is solve_point else call, *v)
    )


def test_points_of_bearings_do_not_pay_for_the_analysis_of_the_margin(monkeypatch):
    """It would solve some twenty bearings more for each point; the warning of a margin below 1 stays."""

    def refuse(_solution):
        raise AssertionError("the margin is analysed")

    monkeypatch.setattr("ehlectric.bearing.result.analyse_margin", refuse)
    case = bearing_case(BALLS, contacts="formula", discharge__dielectric_strength="1 V/um")
    outcome = solve_point(case.to_dict())
    assert outcome.status == "solved", outcome.reason
    assert outcome.summary["bearing"]["margin"] < 1.0
    assert "breakdown-expected" in outcome.summary["warning_codes"]
    assert not {"verdict", "margin"} & outcome.summary.keys()
    points, left_out = over_speed(case, count=2)
    assert (len(points), left_out) == (2, [])


def test_a_point_is_the_solution_of_its_case():
    outcome = solve_point(table())
    assert (outcome.status, outcome.reason, outcome.again, outcome.version) == (
        "solved",
        "",
        False,
        __version__,
    )
    here = solve(CASE).summary()
    assert {**outcome.summary, "seconds": None} == {**here, "seconds": None}
    assert 0.0 < sum(outcome.summary["seconds"].values()) < outcome.seconds


def test_a_film_that_does_not_converge_has_its_reason_and_summary():
    outcome = solve_point(table(**{"solver.max_iterations": 1}))
    assert outcome.status == "not converged"
    assert outcome.summary["converged"] is False
    told = dict(zip(outcome.summary["warning_codes"], outcome.summary["warnings"], strict=True))
    assert outcome.reason == told["not-converged"]
    assert outcome.summary["status"] in outcome.reason


def test_a_case_that_is_refused_is_a_row():
    # The radii contradict each other: both bodies concave, which no field of the case forbids by itself.
    refused = CASE.replace({"contact.radius_1": -0.02, "contact.radius_2": -0.03})
    with pytest.raises(InputError) as told:
        solve(refused)
    outcome = solve_point(refused.to_dict())
    assert (outcome.status, outcome.reason, outcome.again) == ("failed", str(told.value), False)
    assert outcome.summary is None


def test_what_does_not_fit_into_memory_is_tried_again():
    outcome = solve_point(table(**{NODES: 10**7, "grid.field_degree": 20, "grid.field_nodes": 10**7}))
    assert (outcome.status, outcome.again) == ("failed", True)
    assert "GB" in outcome.reason


@each(
    ("error", "reason", "again"),
    [
        (MemoryError("Unable to allocate 5 GiB"), "out of memory: Unable to allocate 5 GiB", True),
        (ConvergenceError("no field"), "not solved: no field", False),
        (FloatingPointError("overflow"), "not solved: overflow", False),
        (np.linalg.LinAlgError("singular\n matrix"), "not solved: singular matrix", False),
        (RuntimeError("what"), "unexpected: RuntimeError: what", False),
        (KeyError("a" * 2000), "unexpected: KeyError: '".ljust(1000, "a"), False),
    ],
)
def test_what_goes_wrong_is_the_reason(monkeypatch, error, reason, again):
    def fails(_case):
        raise error

    with monkeypatch.context() as patch:
        patch.setattr(sweep_engine, "solve", fails)
        outcome = solve_point(table())
    assert (outcome.status, outcome.reason, outcome.again, outcome.summary) == ("failed", reason, again, None)


class Counting(Executor):
    """Solves as it is asked to, and notes how many points were in flight."""

    def __init__(self, inner):
        self.inner, self.flying, self.most = inner, 0, 0

    def submit(self, call, *values):
        self.flying += 1
        self.most = max(self.most, self.flying)
        future = self.inner.submit(call, *values)
        future.add_done_callback(lambda _: setattr(self, "flying", self.flying - 1))
        return future


def test_few_points_are_in_flight_and_few_are_taken():
    taken = 0

    def tasks():
        nonlocal taken
        for task in points([129] * 12):
            taken += 1
            yield task
            assert taken <= len(found) + width

    found, width = {}, 3
    with ThreadPoolExecutor(1) as threads:
        counting = Counting(threads)
        run_points(tasks(), Crew(counting.submit, lambda: width), found.update)
    assert sorted(found, key=int) == [str(k) for k in range(12)]
    assert counting.most == width


def test_any_executor_will_do():
    with ThreadPoolExecutor(2) as threads:
        found = found_by(crew_of(threads), points([129] * 3))
    assert [found[str(k)].status for k in range(3)] == ["solved"] * 3


@pytest.mark.slow
@pytest.mark.gate
def test_only_the_point_that_kills_its_process_fails():
    with processes(1) as crew:
        found = found_by(with_deaths(crew), points([129, 129, DEADLY, 129, 129]))
    statuses = [found[str(k)].status for k in range(5)]
    assert statuses == ["solved", "solved", "failed", "solved", "solved"]
    assert found["2"].again
    assert found["2"].reason.startswith("its process was killed twice")


@pytest.mark.slow
def test_a_process_killed_once_costs_nothing():
    """As by a system that is out of memory for a moment."""
    killed = []

    def submit(call, *values):
        future = inner.submit(call, *values)
        if not killed and values and values[0]["grid"]["nodes"] == SLOW:
            killed.append(inner.submit(os.getpid))
        return future

    with processes(1) as inner:
        crew = with_deaths(replace(inner, submit=submit))

        def done(some):
            found.update(some)
            if found and len(killed) == 1:
                # The first point is solved by the process that now has the slow one.
                os.kill(pids[0], signal.SIGKILL)
                killed.append(None)

        found, pids = {}, [inner.submit(os.getpid).result()]
        run_points(points([129, SLOW, 129]), crew, done)
    assert len(killed) == 2
    assert {key: outcome.status for key, outcome in found.items()} == dict.fromkeys("012", "solved")


@pytest.mark.slow
def test_processes_have_one_blas_thread_and_end_with_the_crew():
    with processes(2) as crew:
        threads = [crew.submit(_blas_threads) for _ in range(4)]
        pids = {future.result()[0] for future in threads}
        assert all(future.result()[1] == {1} for future in threads)
    assert not any(_alive(pid) for pid in pids)


def test_processes_end_at_once_where_the_run_is_stopped():
    started, pids = time.monotonic(), []

    def stopped():
        with processes(1) as crew:
            pids.append(crew.submit(os.getpid).result())
            crew.submit(time.sleep, 600.0)
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        stopped()
    # Far from the end of the task, however busy the machine is.
    assert time.monotonic() - started < 300.0
    assert not _alive(pids[0])


def _blas_threads():
    import scipy.linalg  # noqa: F401
    from threadpoolctl import threadpool_info

    return os.getpid(), {library["num_threads"] for library in threadpool_info()}


def _alive(pid):
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    return True


def test_an_executor_that_is_shut_down_is_lost():
    threads = ThreadPoolExecutor(1)
    threads.shutdown()
    with pytest.raises(LostError, match="no more tasks are taken: cannot schedule new futures"):
        found_by(crew_of(threads), points([129]))


def test_points_that_are_cancelled_are_lost_and_others_handed_on():
    """As by a scheduler that is gone: futures in flight are cancelled, what had finished is good."""
    found = {}

    def submit(_call, case):
        future = Future()
        if case["contact"]["entrainment_speed"] == 3.0:
            future.cancel()
            future.set_running_or_notify_cancel()
        else:
            future.set_result(Outcome("solved"))
        return future

    with pytest.raises(LostError, match="tasks in flight were cancelled"):
        run_points(points([129] * 5), Crew(submit, lambda: 5), found.update)
    assert sorted(found) == ["0", "1", "3", "4"]


@each("error", [BrokenProcessPool("terminated"), ModuleNotFoundError("No module named 'ehlectric'")])
def test_where_nobody_is_left_no_point_is_to_blame(error):
    """A broken pool that only its owner can make again, or workers without the package."""

    def submit(_call, *_values):
        future = Future()
        future.set_exception(error)
        return future

    found = {}
    with pytest.raises(LostError, match=str(error)):
        run_points(points([129] * 3), Crew(submit, lambda: 2), found.update)
    assert found == {}


def test_a_task_of_dask_is_received_without_the_package():
    """Its worker unpickles bytes by the standard library alone; their value is that of the call."""
    taken = []

    class OfDask(ThreadPoolExecutor):
        def submit(self, call, *values):
            taken.append(pickle.dumps((call, values)))
            return super().submit(call, *values)

    OfDask.__module__ = "distributed.cfexecutor"
    with OfDask(1) as executor:
        assert crew_of(executor).submit(Outcome, "solved").result() == Outcome("solved")
    modules = {name for opcode, name, _ in pickletools.genops(taken[0]) if "UNICODE" in opcode.name}
    assert modules <= {"_pickle", "loads"}


def test_what_is_in_flight_is_cancelled_where_the_run_is_stopped(monkeypatch):
    monkeypatch.setattr(runtime_tasks, "_PULSE", 0.01)
    futures = []

    def submit(_call, *_values):
        futures.append(Future())
        return futures[-1]

    def stopped(_some):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        run_points(points([129] * 3), Crew(submit, lambda: 2), stopped)
    assert len(futures) == 2
    with pytest.raises(CancelledError):
        futures[0].result()


def test_as_many_processes_as_cores():
    assert cores() == len(os.sched_getaffinity(0))


class _Refusing(ThreadPoolExecutor):
    """An executor that takes no point of one speed."""

    def submit(self, call, *values, **named):
        if values and values[0]["contact"]["entrainment_speed"] == 2.0:
            failed = Future()
            failed.set_exception(ValueError("disk quota of the worker\nexceeded"))
            return failed
        return super().submit(call, *values, **named)


def test_what_an_executor_says_is_the_reason():
    with _Refusing(1) as executor:
        found = found_by(crew_of(executor), points([129, 129]))
    assert found["0"].status == "solved"
    assert found["1"].reason == "not taken by the executor: ValueError: disk quota of the worker exceeded"
    assert found["1"].again
