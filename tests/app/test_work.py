"""Quick answers and jobs: limits, turns, and processes that end with all that they started."""

import asyncio
import logging
import os
import signal
import tomllib
from multiprocessing.forkserver import _forkserver

import pytest

from ehlectric.app.calls import BEARING_QUICK, Call
from ehlectric.app.work import Limits, Work, crowding, key_of, limits_of
from ehlectric.errors import InputError, LostError
from ehlectric.runs.example_files import example_text
from tests.helpers import calls
from tests.helpers.processes import PATIENCE, alive, wait_until

# Far above what a fork of the physics takes, and far below what ``allocate`` is asked for [bytes].
MEMORY = 3e9


def working(limits, use):
    """Result of ``use(work)``, a coroutine, after which the work is closed."""

    async def run():
        # Processes load the physics before their first answer.
        work = Work(limits or Limits(patience=PATIENCE))
        try:
            return await asyncio.wait_for(use(work), 2.0 * PATIENCE)
        finally:
            work.close()

    return asyncio.run(run())


async def outcome(job):
    await job.wait()
    return job.state, job.result, job.error


@pytest.mark.slow
def test_a_work_closed_when_a_job_ends_closes_no_file_of_others():
    """A pipe closed by two threads at once closes a file that another was given in between."""

    async def use(work):
        job = work.share().start(calls.refuse)
        await job.wait()
        return os.fstat(work.scratch._lock.fileno()).st_size

    for _ in range(10):
        assert working(Limits(memory=MEMORY), use) == 0


@pytest.mark.slow
def test_a_quick_answer():
    assert working(None, lambda work: work.share().quick(calls.double, 21)) == 42


def test_an_input_error_is_that_of_the_function():
    with pytest.raises(InputError) as caught:
        working(None, lambda work: work.share().quick(calls.refuse))
    assert (caught.value.key, caught.value.takes) == ("bearing.radial_load", "above 0 N")


@pytest.mark.parametrize("function", [calls.fail, calls.make_unpicklable])
def test_an_error_of_the_program_is_one_line_and_its_traceback_is_in_the_log(function, caplog):
    with caplog.at_level(logging.ERROR, "ehlectric.app"), pytest.raises(LostError) as caught:
        working(None, lambda work: work.share().quick(function))
    assert "error in the program" in str(caught.value)
    assert "\n" not in str(caught.value)
    assert "Traceback" in caplog.text


@pytest.mark.slow
@pytest.mark.gate
def test_a_killed_process_loses_its_answer_only_and_another_takes_its_place():
    async def use(work):
        slow = asyncio.create_task(work.share().quick(calls.wait, 1.0))
        with pytest.raises(LostError, match="killed"):
            await work.share().quick(calls.die)
        return await slow, [await work.share().quick(calls.double, 1) for _ in range(8)]

    assert working(None, use) == (1.0, [2] * 8)


@pytest.mark.slow
def test_an_answer_that_takes_too_long_is_given_up():
    async def use(work):
        # The first answers wait until the processes have loaded the physics.
        await asyncio.gather(*(work.share().quick(calls.wait, 0.1) for _ in range(4)))
        work.limits = Limits(patience=0.5)
        with pytest.raises(LostError, match=r"longer than [0-9.]+ s"):
            await work.share().quick(calls.wait, 600.0)
        work.limits = Limits(patience=PATIENCE)
        return await work.share().quick(calls.double, 2)

    assert working(None, use) == 4


def test_a_loaded_machine_has_more_patience(monkeypatch):
    """Expected: processes by core, at most 6."""
    loads = {0.5: 1.0, 2.0: 1.0, 7.0: 3.5, 100.0: 6.0}
    monkeypatch.setattr("ehlectric.app.work.cores", lambda: 2)
    for load, expected in loads.items():
        monkeypatch.setattr("os.getloadavg", lambda load=load: (load, 0.0, 0.0), raising=False)
        assert crowding() == expected


@pytest.mark.slow
def test_a_session_that_floods_does_not_starve_another():
    async def use(work):
        begun, submit = [], work._threads.submit
        work._threads.submit = lambda ask, function, *given: (
            begun.append(function) or submit(ask, function, *given)
        )
        greedy, modest = work.share(), work.share()
        flood = [asyncio.create_task(greedy.quick(calls.wait, 0.01)) for _ in range(40)]
        await asyncio.sleep(0)
        await modest.quick(calls.double, 1)
        await asyncio.gather(*flood)
        return begun

    # Only the two answers that are computed at once are ahead of the other session.
    begun = working(None, use)
    assert len(begun) == 41
    assert begun.index(calls.double) <= 2


def test_more_answers_than_may_wait_are_refused():
    async def use(work):
        share = work.share()
        return await asyncio.gather(
            *(share.quick(calls.double, 1) for _ in range(60)), return_exceptions=True
        )

    found = working(None, use)
    assert found[:50] == [2] * 50
    assert all(isinstance(error, LostError) for error in found[50:])


TABLE = tomllib.loads(example_text("bearing_6208"))
WRONG = {**TABLE, "bearing": {**TABLE["bearing"], "radial_load": "-1 N"}}


CONCERNED = Call("answer_parts.concerned", kept=True)


def test_an_answer_to_the_same_inputs_is_computed_once(tmp_path):
    async def use(work):
        begun, submit = [], work._threads.submit
        work._threads.submit = lambda ask, *given: begun.append(given[1]) or submit(ask, *given)
        shares = [work.share(), work.share()]
        # Of two pages at once, and of one of them later.
        first, second = await asyncio.gather(*(share.quick(BEARING_QUICK, TABLE, None) for share in shares))
        kept = shares[0].has(BEARING_QUICK, TABLE, None)
        third = await shares[0].quick(BEARING_QUICK, dict(TABLE), None)
        answers_of_one = len(begun)
        # Files of a session may change.
        await shares[0].quick(BEARING_QUICK, TABLE, tmp_path)
        for _ in range(2):
            with pytest.raises(InputError, match="radial_load"):
                await shares[1].quick(BEARING_QUICK, WRONG, None)
        wrong_kept = shares[1].has(BEARING_QUICK, WRONG, None)
        return first == second == third, kept, answers_of_one, wrong_kept, len(begun)

    assert working(None, use) == (True, True, 1, False, 4)


def test_an_answer_of_an_earlier_start_is_not_computed_again():
    async def use(work):
        work.keep({key_of(BEARING_QUICK, (TABLE, None)): "of an earlier start"})
        share = work.share()
        return share.has(BEARING_QUICK, TABLE, None), await share.quick(BEARING_QUICK, TABLE, None)

    assert working(None, use) == (True, "of an earlier start")


def test_the_answers_that_are_kept_are_few():
    async def use(work):
        share = work.share()
        for number in range(70):
            await share.quick(CONCERNED, f"film_formulas.{number}.thickness")
        return [share.has(CONCERNED, f"film_formulas.{number}.thickness") for number in (0, 69)]

    assert working(None, use) == [False, True]


def test_a_job_tells_its_progress_and_returns():
    async def use(work):
        job = work.share().start(calls.count_up, 5)
        return *await outcome(job), job.done, job.of, job.text

    assert working(None, use) == ("done", 5, None, 4, 5, "points")


@pytest.mark.slow
@pytest.mark.parametrize(
    ("function", "values", "told"),
    [
        (calls.die, (), "killed"),
        (calls.fail, (), "error in the program"),
        (calls.make_unpicklable, (), "error in the program"),
        (calls.allocate, (20e9,), "out of memory"),
        (calls.refuse, (), "expected above 0 N"),
    ],
)
def test_a_job_fails_in_words(function, values, told, caplog):
    async def use(work):
        return await outcome(work.share().start(function, *values))

    with caplog.at_level(logging.CRITICAL, "ehlectric.app"):
        state, _, error = working(Limits(memory=MEMORY), use)
    assert state == "failed"
    assert told in str(error)


@pytest.mark.slow
def test_a_job_that_takes_too_long_is_stopped():
    async def use(work):
        return await outcome(work.share().start(calls.wait, 600.0))

    state, _, error = working(Limits(seconds=3.0), use)
    assert state == "failed"
    assert "0.05 min" in str(error)


@pytest.mark.skipif(not hasattr(os, "killpg"), reason="processes are watched by the files of Linux")
@pytest.mark.parametrize(
    "how", [pytest.param("cancel", marks=pytest.mark.gate), "close the session", "close the work"]
)
@pytest.mark.parametrize("forks", ["served", pytest.param("no longer served", marks=pytest.mark.slow)])
def test_a_job_ends_with_all_that_it_started(how, forks, tmp_path):
    """Also where the process that makes the others has died, as when a terminal is closed."""
    path = tmp_path / "numbers"

    async def use(work):
        share = work.share()
        job = share.start(calls.start_child, path)
        while not (path.exists() and path.read_text()):
            await asyncio.sleep(0.05)
        numbers = [int(text) for text in path.read_text().split()]
        assert all(map(alive, numbers))
        if forks == "no longer served":
            server = _forkserver._forkserver_pid
            os.kill(server, signal.SIGKILL)
            assert wait_until(lambda: not alive(server))
        {"cancel": job.cancel, "close the session": share.close, "close the work": work.close}[how]()
        assert job.state == "cancelled"
        return numbers

    numbers = working(None, use)
    assert wait_until(lambda: not any(map(alive, numbers)))


@pytest.mark.slow
def test_sessions_take_turns_with_their_jobs():
    async def use(work):
        one, other = work.share(), work.share()
        jobs = [one.start(calls.wait, 0.2) for _ in range(3)]
        late = other.start(calls.wait, 0.2)
        await late.wait()
        return [job.state for job in jobs]

    # One job runs at once: the first of the first session, and then that of the other session.
    assert working(Limits(jobs=1), use) == ["done", "waiting", "waiting"]


def test_jobs_beyond_the_limits_are_refused():
    async def use(work):
        share = work.share()
        jobs = [share.start(calls.wait, 60.0) for _ in range(2)]
        with pytest.raises(LostError, match="2 computations"):
            share.start(calls.wait, 60.0)
        work.share().start(calls.wait, 60.0)
        with pytest.raises(LostError, match="too many computations"):
            work.share().start(calls.wait, 60.0)
        jobs[0].cancel()
        share.start(calls.wait, 60.0)

    working(Limits(jobs=1, each=2, waiting=2), use)


def test_a_closed_session_asks_for_nothing_more():
    async def use(work):
        share = work.share()
        share.close()
        with pytest.raises(LostError, match="closed"):
            await share.quick(calls.double, 1)
        with pytest.raises(LostError, match="closed"):
            share.start(calls.wait, 1.0)

    working(None, use)


def test_limits_of_options():
    assert limits_of(jobs=3, gigabytes=2.0, minutes=5.0) == Limits(jobs=3, memory=2e9, seconds=300.0)
    assert limits_of(jobs=None, gigabytes=None, minutes=60.0).jobs == Limits().jobs
