"""Points of a sweep solved by any executor: a few in flight, each with an outcome, whatever becomes of it."""

from __future__ import annotations

import multiprocessing
import os
import time
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import (
    FIRST_COMPLETED,
    BrokenExecutor,
    CancelledError,
    Executor,
    Future,
    ProcessPoolExecutor,
    wait,
)
from contextlib import contextmanager
from dataclasses import dataclass
from itertools import islice
from typing import Any, TypeVar

import numpy as np

from ehlectric.bearing.solver import solve_bearing
from ehlectric.cases.any_case import case_of_dict
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.contact.solver import solve
from ehlectric.errors import ConvergenceError, InputError, LostError, MemoryLimitError
from ehlectric.runtime.files import now
from ehlectric.runtime.workers import end_now, end_with_parent, without_interrupts
from ehlectric.sweep.results import Status
from ehlectric.sweep.store import Outcome
from ehlectric.version import __version__

T = TypeVar("T")

# Points in flight for each that is being solved: the next ones wait beside it.
_AHEAD = 2

# How often those who wait are told so [s].
_PULSE = 1.0

# What BLAS libraries read as they are loaded.
_THREADS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")
Task = tuple[str, Mapping[str, Any]]


@dataclass(frozen=True)
class Crew:
    """Those who solve points.

    ``submit`` hands over a call, ``width`` is how many points may be in flight, ``renew`` makes good for
    processes that died, and ``waiting`` says what holds them up.
    """

    submit: Callable[..., Future[Any]]
    width: Callable[[], int]
    renew: Callable[[], None] = lambda: None
    waiting: Callable[[], str] = str


def solve_point(table: Mapping[str, Any]) -> Outcome:
    """Solve a case that came as plain data, wherever that may be.

    Parameters
    ----------
    table : mapping
        As ``Case.to_dict`` gives it.

    Returns
    -------
    Outcome
        Of every case: what goes wrong in solving is the reason of a point that failed.
    """
    started = time.perf_counter()
    status, reason, again, summary = _attempt(table)
    # One line, whatever a library wrote.
    reason = " ".join(reason.split())[:1000]
    return Outcome(status, reason, again, summary, time.perf_counter() - started, __version__, now())


def _attempt(table: Mapping[str, Any]) -> tuple[Status, str, bool, dict[str, Any] | None]:
    try:
        solved, summary, reason = _solved(table)
    except MemoryLimitError as error:
        return "failed", str(error), True, None
    except InputError as error:
        return "failed", str(error), False, None
    except MemoryError as error:
        return "failed", f"out of memory: {error}", True, None
    except (ConvergenceError, ArithmeticError, np.linalg.LinAlgError) as error:
        return "failed", f"not solved: {error}", False, None
    except Exception as error:
        return "failed", f"unexpected: {type(error).__name__}: {error}", False, None
    return ("solved", "", False, summary) if solved else ("not converged", reason, False, summary)


def _solved(table: Mapping[str, Any]) -> tuple[bool, dict[str, Any], str]:
    """Whether a case is solved, its summary, and what is to be said where it is not."""
    case = case_of_dict(table)
    if isinstance(case, BearingCase):
        bearing = solve_bearing(case, workers=1)
        summary = bearing.summary()
        del summary["contacts"]  # a row for each would be more columns than a table has
        return bearing.converged, summary, "a contact of the bearing is not converged"
    result = solve(case)
    # The warning that says how far it came and what to try.
    reasons = (warning.text for warning in result.warnings if warning.code == "not-converged")
    return result.converged, result.summary(), next(reasons, result.film.status)


def run_points(
    tasks: Iterable[Task], crew: Crew, done: Callable[[Sequence[tuple[str, Outcome]]], None]
) -> None:
    """Solve points, as many at a time as the crew takes.

    Parameters
    ----------
    tasks : iterable of (str, mapping)
        Key of each point and its case as plain data, taken as they are needed.
    crew : Crew
        Who solves them.
    done : callable
        Called with the keys and outcomes of what has finished, in this thread; about every second with none
        while nothing does.

    Raises
    ------
    LostError
        Where the crew is gone; what had finished has been handed to ``done``.

    Notes
    -----
    Where a process dies, the points in flight are tried again one at a time, and one whose process dies
    again fails. Where not even an empty call comes back, nobody is left.
    """
    remaining, flying = iter(tasks), dict[Future[Outcome], Task]()
    try:
        while True:
            suspects = _fill(flying, remaining, crew)
            if not flying and not suspects:
                return
            finished = wait(flying, timeout=_PULSE, return_when=FIRST_COMPLETED).done
            suspects += _take(flying, finished, done)
            if suspects:
                suspects += _take(flying, wait(flying).done, done)
                crew.renew()
                for task in suspects:
                    done([(task[0], _alone(task, crew))])
    finally:
        for future in flying:
            future.cancel()


def _fill(flying: dict[Future[Outcome], Task], remaining: Iterator[Task], crew: Crew) -> list[Task]:
    """Hand over the next points; those that nobody took."""
    for task in islice(remaining, max(0, crew.width() - len(flying))):
        try:
            flying[crew.submit(solve_point, task[1])] = task
        except BrokenExecutor:
            return [task]
        except Exception as error:  # of the executor
            raise LostError(f"no more points are taken: {error}") from None
    return []


def _take(
    flying: dict[Future[Outcome], Task],
    finished: Iterable[Future[Outcome]],
    done: Callable[[Sequence[tuple[str, Outcome]]], None],
) -> list[Task]:
    """Hand on what has finished; the points that got lost with their process."""
    found: list[tuple[str, Outcome]] = []
    suspects: list[Task] = []
    gone = False
    for future in finished:
        task = flying.pop(future)
        try:
            found.append((task[0], future.result()))
        except CancelledError:
            gone = True
        except Exception:  # of the executor: solve_point has none
            suspects.append(task)
    done(found)
    if gone:
        raise LostError("points in flight were cancelled")
    return suspects


def _alone(task: Task, crew: Crew) -> Outcome:
    """A point with nothing else in flight, to see whether it is the one that kills its process."""
    _ask(crew)
    try:
        outcome: Outcome = crew.submit(solve_point, task[1]).result()
    except CancelledError:
        raise LostError("points in flight were cancelled") from None
    except Exception as error:  # of the executor
        crew.renew()
        _ask(crew)
        kind = type(error).__name__
        killed = isinstance(error, BrokenExecutor) or kind == "KilledWorker"  # the latter is Dask's
        reason = (
            f"its process was killed twice, as by a system out of memory ({kind})"
            if killed
            else " ".join(f"not taken by the executor: {kind}: {error}".split())[:1000]
        )
        return Outcome("failed", reason, again=True, date=now())
    return outcome


def _ask(crew: Crew) -> None:
    """See whether anybody is there."""
    try:
        crew.submit(_here).result()
    except (CancelledError, Exception) as error:
        text = f"{type(error).__name__}: {error}".rstrip(": ")
        raise LostError(f"no point can be solved any more, {text}") from None


def _here() -> str:
    return __version__


def crew_of(executor: Executor) -> Crew:
    """A crew of any executor of the kind of concurrent.futures, which its owner ends.

    Parameters
    ----------
    executor : Executor
        Its workers import ehlectric.
    """
    workers = getattr(executor, "_max_workers", None) or 32
    return Crew(executor.submit, lambda: _AHEAD * workers + 1)


@contextmanager
def processes(number: int) -> Iterator[Crew]:
    """A crew of processes on this machine, which end with the context, or with this process.

    Parameters
    ----------
    number : int
        How many; each has one BLAS thread.
    """
    pool = _pool(number)

    def submit(call: Callable[..., T], *values: Any) -> Future[T]:
        # Processes begin with the first calls, and inherit that interrupts are not for them.
        with without_interrupts():
            return pool.submit(call, *values)

    def renew() -> None:
        nonlocal pool
        end_now(pool)
        pool = _pool(number)

    try:
        yield Crew(submit, lambda: _AHEAD * number + 1, renew)
    except BaseException:
        end_now(pool)
        raise
    # Nothing is in flight: they are on their way out, and need nobody who waits.
    pool.shutdown(wait=False)


def _pool(number: int) -> ProcessPoolExecutor:
    return ProcessPoolExecutor(
        number, mp_context=multiprocessing.get_context("spawn"), initializer=_prepare_process
    )


def _prepare_process() -> None:
    """What a process does before its first point."""
    from threadpoolctl import threadpool_limits

    end_with_parent()
    # For libraries that are not loaded yet, and for those that are.
    os.environ |= dict.fromkeys(_THREADS, "1")
    threadpool_limits(1)
