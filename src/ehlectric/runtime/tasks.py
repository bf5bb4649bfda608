"""Tasks solved by a crew of workers: every task gets an outcome, also where its process dies."""

from __future__ import annotations

import traceback
from collections.abc import Callable, Generator, Iterable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, CancelledError, Future, wait
from contextlib import closing
from dataclasses import dataclass, field
from itertools import islice
from typing import Any, Generic, TypeVar, cast

from ehlectric.errors import ConvergenceError, InputError, LostError, printable
from ehlectric.runtime.memory import is_out_of_memory
from ehlectric.runtime.worker_processes import Crew, cores, processes
from ehlectric.version import __version__

A = TypeVar("A")
K = TypeVar("K")
T = TypeVar("T")

# Interval at which the caller is called back while no task finishes [s].
_PULSE = 1.0

# Times that a task is run without others after its process was killed, where one lost task loses all results.
_TRIES = 3

_CANCELLED = "tasks in flight were cancelled"


@dataclass(frozen=True)
class _Attempt(Generic[T]):
    """Result of a task, or the error that it raised."""

    result: T | None = None
    error: BaseException | None = None


def run_all(
    tasks: Sequence[Callable[[], T]],
    done: Callable[[int, T], None],
    *,
    limit: int | None = None,
    what: str = "task",
) -> None:
    """Run tasks in parallel, in processes of their own.

    A task whose process is killed is run again, with nothing in parallel, up to three times; one that runs
    out of memory once. All other results are kept meanwhile.

    Raises LostError where the process of a task was killed four times, or no process can begin; MemoryError
    where a task also ran out of memory without other tasks.

    An exception of a task is raised again here, and all other tasks are stopped.
    """
    number = min(limit or cores(), len(tasks))
    with (
        processes(number) as crew,
        closing(finished_tasks(enumerate(tasks), crew, _attempt, _lost, _ran_out, tries=_TRIES)) as batches,
    ):
        for place, attempt in (each for batch in batches for each in batch):
            if isinstance(attempt.error, LostError):
                raise LostError(f"a {what} was not solved: {attempt.error}")
            if attempt.error is not None:
                raise attempt.error
            done(place, cast("T", attempt.result))


def _attempt(task: Callable[[], T]) -> _Attempt[T]:
    """Result of a task, or its error, in a process of its own."""
    try:
        return _Attempt(task())
    except Exception as error:
        if not isinstance(error, InputError | ConvergenceError):
            # The error is raised again in another process, which does not know where it came from.
            error.add_note("".join(traceback.format_exception(error)))
        return _Attempt(error=error)


def _lost(reason: str) -> _Attempt[Any]:
    return _Attempt(error=LostError(reason))


def _ran_out(attempt: _Attempt[Any]) -> bool:
    return is_out_of_memory(attempt.error)


def finished_tasks(
    tasks: Iterable[tuple[K, A]],
    crew: Crew,
    call: Callable[[A], T],
    lost: Callable[[str], T],
    ran_out: Callable[[T], bool] = lambda _: False,
    *,
    tries: int = 1,
) -> Generator[list[tuple[K, T]], None, None]:
    """Run a function on many values with a crew, and yield what is finished. Yields finished tasks; while
    none finishes, an empty list about every second. Raises LostError if the crew cannot be reached any more,
    or lacks a package.

    If a process dies, the tasks in flight are tried again one at a time. A task whose process dies again in
    all of these tries is lost. If not even an empty call returns, the crew is lost. A task that ran out of
    memory is tried again without other tasks where the crew shares the memory of one machine.
    """
    remaining, flying = iter(tasks), dict[Future[T], tuple[K, A]]()
    try:
        while True:
            refused = _fill(flying, remaining, crew, call)
            if not flying and not refused:
                return
            ended = wait(flying, _PULSE, FIRST_COMPLETED).done
            if not ended:
                crew.check()
            finished = _take(flying, ended, crew, ran_out)
            died, short = refused + finished.died, finished.short
            yield finished.outcomes
            if (died or short) and not finished.broken:
                finished = _take(flying, wait(flying).done, crew, ran_out)
                died, short = died + finished.died, short + finished.short
                yield finished.outcomes
            if finished.broken:
                raise LostError(finished.broken)
            if died:
                crew.renew()
            for key, value in died + short:
                yield [(key, _alone(value, crew, call, lost, tries))]
    finally:
        crew.abandon(flying)


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
            raise LostError(f"no more tasks are taken: {error}") from None
    return []


@dataclass
class _Finished(Generic[K, A, T]):
    """Tasks that are no longer in flight."""

    outcomes: list[tuple[K, T]] = field(default_factory=list)
    # died and short: tasks whose process died, and tasks that ran out of memory next to others.
    died: list[tuple[K, A]] = field(default_factory=list)
    short: list[tuple[K, A]] = field(default_factory=list)
    # Why the crew solves no more: a task was cancelled, or a worker could not begin it. Empty if it does.
    broken: str = ""


def _take(
    flying: dict[Future[T], tuple[K, A]], ended: Iterable[Future[T]], crew: Crew, ran_out: Callable[[T], bool]
) -> _Finished[K, A, T]:
    """Take the tasks whose futures have ended out of those in flight."""
    finished = _Finished[K, A, T]()
    for future in ended:
        task = flying.pop(future)
        try:
            outcome = future.result()
        except CancelledError:
            finished.broken = _CANCELLED
        except ImportError as error:  # of the worker, before the function began
            finished.broken = _lacking(error)
        except Exception:  # raised by the executor, because the function raises none
            finished.died.append(task)
        else:
            if crew.shares_memory and ran_out(outcome):
                finished.short.append(task)
            else:
                finished.outcomes.append((task[0], outcome))
    return finished


def _lacking(error: ImportError) -> str:
    return f"a worker cannot import what a task needs: {printable(str(error))}"


def _alone(value: A, crew: Crew, call: Callable[[A], T], lost: Callable[[str], T], tries: int) -> T:
    """Outcome of a task run with nothing else in flight, to find out whether it kills its process."""
    for number in range(2, 2 + tries):
        _ask(crew)
        try:
            outcome: T = _result(crew, crew.submit(call, value))
        except CancelledError:
            raise LostError(_CANCELLED) from None
        except ImportError as error:
            raise LostError(_lacking(error)) from None
        except Exception as error:  # raised by the executor
            crew.renew()
            reason = _reason(error, number)
        else:
            return outcome
    _ask(crew)
    return lost(reason)


def _reason(error: Exception, number: int) -> str:
    """Reason why a task was lost whose process died a number of times."""
    kind = type(error).__name__
    if isinstance(error, BrokenExecutor) or kind == "KilledWorker":  # an error class of Dask
        times = "twice" if number == 2 else f"{number} times"
        return f"its process was killed {times}, as by a system out of memory ({kind})"
    return " ".join(f"not taken by the executor: {kind}: {error}".split())[:1000]


def _result(crew: Crew, future: Future[T]) -> T:
    """Wait for a result; an error where its process dies."""
    while not wait([future], _PULSE).done:
        crew.check()
    return future.result()


def _ask(crew: Crew) -> None:
    """Check with an empty call that the crew still answers, and raise a LostError if it does not."""
    try:
        _result(crew, crew.submit(_here))
    except (CancelledError, Exception) as error:
        text = f"{type(error).__name__}: {error}".rstrip(": ")
        raise LostError(f"the processes stopped, nothing more can be solved: {text}") from None


def _here() -> str:
    return __version__
