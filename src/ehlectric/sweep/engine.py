"""Solution of the points of a sweep by an executor; every point gets an outcome, also if it fails."""

from __future__ import annotations

import multiprocessing
import os
import time
from collections.abc import Callable, Generator, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import (
    FIRST_COMPLETED,
    BrokenExecutor,
    CancelledError,
    Executor,
    Future,
    ProcessPoolExecutor,
    wait,
)
from contextlib import closing, contextmanager
from dataclasses import dataclass
from itertools import islice
from typing import Any, TypeVar

import numpy as np

from ehlectric.bearing.solver import solve_bearing
from ehlectric.bearing.summary import summary_of
from ehlectric.cases.any_case import case_of_dict
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.contact.solver import solve
from ehlectric.errors import ConvergenceError, InputError, LostError, MemoryLimitError
from ehlectric.runtime.files import now
from ehlectric.runtime.workers import end_now, end_with_parent, without_interrupts
from ehlectric.sweep.plan import Outcome
from ehlectric.sweep.results import Status
from ehlectric.version import __version__

A = TypeVar("A")
K = TypeVar("K")
T = TypeVar("T")

# Points in flight per process: one that is being solved, and one that waits, so that no process idles.
_AHEAD = 2

# Interval at which the caller is called back while no point finishes [s].
_PULSE = 1.0

# Environment variables in which BLAS libraries look up the number of threads when they are loaded.
_THREADS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")
Task = tuple[str, Mapping[str, Any]]


@dataclass(frozen=True)
class Crew:
    """Processes or machines that solve points.

    Attributes
    ----------
    submit : callable
        Function that submits a call with its arguments, and returns its future.
    width : callable
        Function that returns the number of points that may be in flight.
    renew : callable
        Function that replaces processes that died.
    waiting : callable
        Function that returns what the crew is waiting for, as text; empty if it is working.
    """

    submit: Callable[..., Future[Any]]
    width: Callable[[], int]
    renew: Callable[[], None] = lambda: None
    waiting: Callable[[], str] = str


def solve_point(table: Mapping[str, Any]) -> Outcome:
    """Solve a case given as plain data, in any process.

    Parameters
    ----------
    table : mapping
        The case, from ``Case.to_dict``.

    Returns
    -------
    Outcome
        Outcome of the point. No exception is raised: an error becomes the reason of a failed point.
    """
    started = time.perf_counter()
    status, reason, again, summary = _attempt(table)
    # Messages of libraries may have several lines; the reason is a single one.
    reason = " ".join(reason.split())[:1000]
    return Outcome(status, reason, again, summary, time.perf_counter() - started, __version__, now())


def _attempt(table: Mapping[str, Any]) -> tuple[Status, str, bool, dict[str, Any] | None]:
    """Status and reason of a case, whether another try may succeed, and its summary."""
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
    """Whether a case converged, its summary, and the reason if it did not."""
    case = case_of_dict(table)
    if isinstance(case, BearingCase):
        bearing = solve_bearing(case, workers=1)
        # Without the analysis of the margin, which would solve twenty bearings for every point.
        summary = summary_of(bearing.solution)
        del summary["contacts"]  # with columns for every contact, the table would be too wide
        return bearing.converged, summary, "a contact of the bearing is not converged"
    result = solve(case)
    # This warning says what residual was reached and what to try.
    reasons = (warning.text for warning in result.warnings if warning.code == "not-converged")
    return result.converged, result.summary(), next(reasons, result.film.status)


def run_points(
    tasks: Iterable[Task], crew: Crew, done: Callable[[Sequence[tuple[str, Outcome]]], None]
) -> None:
    """Solve points with a crew, as many at a time as it can take.

    Parameters
    ----------
    tasks : iterable of (str, mapping)
        Key of each point and its case as plain data. An item is read only when its point is handed over.
    crew : Crew
        Processes or machines that solve the points.
    done : callable
        Called in this thread with a sequence of the keys and outcomes of finished points. While no point
        finishes, it is called about every second with an empty sequence.

    Raises
    ------
    LostError
        If the crew cannot be reached any more. All finished points have been passed to ``done`` before.
    """
    with closing(finished_tasks(tasks, crew, solve_point, _lost)) as batches:
        for outcomes in batches:
            done(outcomes)


def _lost(reason: str) -> Outcome:
    """Outcome of a point that was not solved because its process died; another try may succeed."""
    return Outcome("failed", reason, again=True, date=now())


def finished_tasks(
    tasks: Iterable[tuple[K, A]], crew: Crew, call: Callable[[A], T], lost: Callable[[str], T]
) -> Generator[list[tuple[K, T]], None, None]:
    """Run a function on many values with a crew, and yield what is finished.

    Parameters
    ----------
    tasks : iterable of (key, value)
        Key of each task and the argument of ``call``. An item is read only when it is handed over.
    crew : Crew
        Processes or machines that run the tasks.
    call : callable
        Function of a value; it raises no exception.
    lost : callable
        Makes the outcome of a task whose process died twice, from the reason.

    Yields
    ------
    list of (key, outcome)
        Finished tasks. While none finishes, an empty list about every second.

    Raises
    ------
    LostError
        If the crew cannot be reached any more. All finished tasks have been yielded before.

    Notes
    -----
    If a process dies, the tasks in flight are tried again one at a time. A task whose process dies again is
    lost. If not even an empty call returns, the crew is lost.
    """
    remaining, flying = iter(tasks), dict[Future[T], tuple[K, A]]()
    try:
        while True:
            suspects = _fill(flying, remaining, crew, call)
            if not flying and not suspects:
                return
            for waits_for_all in (False, True):
                if waits_for_all and not suspects:
                    continue
                waiting = wait(flying) if waits_for_all else wait(flying, _PULSE, FIRST_COMPLETED)
                outcomes, died, gone = _take(flying, waiting.done)
                suspects += died
                yield outcomes
                if gone:
                    raise LostError("points in flight were cancelled")
            if suspects:
                crew.renew()
                for key, value in suspects:
                    yield [(key, _alone(value, crew, call, lost))]
    finally:
        for future in flying:
            future.cancel()


def _fill(
    flying: dict[Future[T], tuple[K, A]], remaining: Iterator[tuple[K, A]], crew: Crew, call: Callable[[A], T]
) -> list[tuple[K, A]]:
    """Hand the next tasks to the crew; returns the task that was refused because a process had died."""
    for task in islice(remaining, max(0, crew.width() - len(flying))):
        try:
            flying[crew.submit(call, task[1])] = task
        except BrokenExecutor:
            return [task]
        except Exception as error:  # raised by the executor
            raise LostError(f"no more points are taken: {error}") from None
    return []


def _take(
    flying: dict[Future[T], tuple[K, A]], finished: Iterable[Future[T]]
) -> tuple[list[tuple[K, T]], list[tuple[K, A]], bool]:
    """Outcomes of finished tasks, the tasks whose process died, and whether any was cancelled."""
    outcomes: list[tuple[K, T]] = []
    suspects: list[tuple[K, A]] = []
    gone = False
    for future in finished:
        task = flying.pop(future)
        try:
            outcomes.append((task[0], future.result()))
        except CancelledError:
            gone = True
        except Exception:  # raised by the executor, because the function raises none
            suspects.append(task)
    return outcomes, suspects, gone


def _alone(value: A, crew: Crew, call: Callable[[A], T], lost: Callable[[str], T]) -> T:
    """Outcome of a task run with nothing else in flight, to find out whether it kills its process."""
    _ask(crew)
    try:
        outcome: T = crew.submit(call, value).result()
    except CancelledError:
        raise LostError("points in flight were cancelled") from None
    except Exception as error:  # raised by the executor
        crew.renew()
        _ask(crew)
        kind = type(error).__name__
        killed = isinstance(error, BrokenExecutor) or kind == "KilledWorker"  # an error class of Dask
        return lost(
            f"its process was killed twice, as by a system out of memory ({kind})"
            if killed
            else " ".join(f"not taken by the executor: {kind}: {error}".split())[:1000]
        )
    return outcome


def _ask(crew: Crew) -> None:
    """Check with an empty call that the crew still answers, and raise a LostError if it does not."""
    try:
        crew.submit(_here).result()
    except (CancelledError, Exception) as error:
        text = f"{type(error).__name__}: {error}".rstrip(": ")
        raise LostError(f"the processes stopped, no further point can be solved: {text}") from None


def _here() -> str:
    return __version__


def crew_of(executor: Executor) -> Crew:
    """Crew of an executor with the interface of ``concurrent.futures``.

    Parameters
    ----------
    executor : Executor
        Executor whose workers can import ehlectric. It is not shut down here, but by its owner.

    Returns
    -------
    Crew
        The workers of the executor.
    """
    workers = getattr(executor, "_max_workers", None) or 32
    return Crew(executor.submit, lambda: _AHEAD * workers + 1)


@contextmanager
def processes(number: int) -> Iterator[Crew]:
    """Context manager that yields a crew of processes on this machine.

    The processes end when the context or the calling process ends.

    Parameters
    ----------
    number : int
        Number of processes; each uses one BLAS thread.

    Yields
    ------
    Crew
        The processes.
    """
    pool = _pool(number)

    def submit(call: Callable[..., T], *values: Any) -> Future[T]:
        # The first calls start the processes. They inherit the setting that ignores interrupts (Ctrl-C).
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
    # Nothing is in flight, so the processes end by themselves and need not be waited for.
    pool.shutdown(wait=False)


def _pool(number: int) -> ProcessPoolExecutor:
    return ProcessPoolExecutor(
        number, mp_context=multiprocessing.get_context("spawn"), initializer=_prepare_process
    )


def _prepare_process() -> None:
    """Prepare a new process: it ends with its parent, and uses one BLAS thread."""
    from threadpoolctl import threadpool_limits

    end_with_parent()
    # The environment limits libraries that are loaded later; threadpool_limits limits loaded libraries.
    os.environ |= dict.fromkeys(_THREADS, "1")
    threadpool_limits(1)
