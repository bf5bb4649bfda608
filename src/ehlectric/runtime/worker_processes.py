"""Worker processes of this machine, and other crews that solve tasks.

The processes end as soon as nobody waits for a task of theirs, and with their parent process.
"""

from __future__ import annotations

import os
import pickle
import signal
import sys
import threading
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, TypeVar

from ehlectric.runtime.locks import held_back
from ehlectric.runtime.progress import LOGGER

if TYPE_CHECKING:
    from concurrent.futures import Executor, Future, ProcessPoolExecutor

T = TypeVar("T")

# Tasks in flight per process: one that is being solved, and three that wait, so that no process idles while
# finished tasks are saved. A disk takes up to 30 ms for that, and a line contact 15 ms.
_AHEAD = 4

# Largest number of processes: Windows can wait for no more at once.
_MOST = 61 if os.name == "nt" else sys.maxsize

# Environment variables in which BLAS libraries look up the number of threads when they are loaded.
_THREADS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")


def limit_blas() -> None:
    """Limit BLAS libraries that are loaded later to one thread, unless the environment has another number."""
    for name in _THREADS:
        os.environ.setdefault(name, "1")


def cores() -> int:
    """Number of cores that this process may use."""
    affinity = getattr(os, "sched_getaffinity", None)
    return (os.cpu_count() or 1) if affinity is None else len(affinity(0))


def cancel(futures: Iterable[Future[Any]]) -> None:
    """Cancel the futures whose tasks have not begun."""
    for future in futures:
        future.cancel()


@dataclass(frozen=True)
class Crew:
    """Processes or machines that solve tasks."""

    # Function that submits a call with its arguments, and returns its future.
    submit: Callable[..., Future[Any]]
    width: Callable[[], int]  # function that returns the number of tasks that may be in flight
    renew: Callable[[], None] = lambda: None  # function that replaces processes that died
    # Function that returns what the crew is waiting for, as text; empty if it is working.
    waiting: Callable[[], str] = str
    # Whether all share the memory of one machine, so that a task finds more of it when no other runs.
    shares_memory: bool = False
    # Function that is given the futures that nobody waits for any more, and stops what it can of them.
    abandon: Callable[[Iterable[Future[Any]]], None] = cancel
    # Function that is called about every second while nothing finishes, and ends a crew that would never
    # finish.
    check: Callable[[], None] = lambda: None


def crew_of(executor: Executor) -> Crew:
    """Crew of an executor with the interface of ``concurrent.futures``."""
    workers = getattr(executor, "_max_workers", None) or 32
    of_dask = type(executor).__module__.partition(".")[0] == "distributed"
    return Crew(
        packed_submit(executor) if of_dask else executor.submit,
        lambda: _AHEAD * workers + 1,
    )


def this_process() -> Crew:
    """Crew that runs each task at once in this process."""
    from concurrent.futures import Future

    def submit(call: Callable[..., T], *values: Any) -> Future[T]:
        future: Future[T] = Future()
        try:
            future.set_result(call(*values))
        except Exception as error:
            future.set_exception(error)
        return future

    return Crew(submit, lambda: 1)


def packed_submit(executor: Executor) -> Callable[..., Future[Any]]:
    """Submit function of an executor of Dask, whose workers need no package to receive a task.

    A worker of Dask that receives a function that it cannot import ends without a message, and the task waits
    endlessly for another one. The task is therefore received as bytes, and the error is its outcome.
    """

    def submit(call: Callable[..., T], *values: Any) -> Future[T]:
        return executor.submit(pickle.loads, pickle.dumps(_Packed(call, values)))

    return submit


@dataclass(frozen=True)
class _Packed:
    """Call whose unpickling is to do it, so that its value comes out."""

    call: Callable[..., Any]
    values: tuple[Any, ...]

    def __reduce__(self) -> tuple[Callable[..., Any], tuple[Any, ...]]:
        return self.call, self.values


@contextmanager
def processes(number: int) -> Iterator[Crew]:
    """Context manager that yields a crew of processes on this machine.

    The processes end when the context or the calling process ends. If this process may have no children, the
    crew is this process.
    """
    pool = None if _is_daemonic() else _pool_or_none(min(number, _MOST))
    if pool is None:
        yield this_process()
    else:
        with _of_pool(pool, min(number, _MOST)) as crew:
            yield crew


def _is_daemonic() -> bool:
    """Whether this process may have no children, such as a worker of ``multiprocessing.Pool`` or Celery."""
    import multiprocessing

    return multiprocessing.current_process().daemon


def _pool_or_none(number: int) -> ProcessPoolExecutor | None:
    """Pool of processes; None where the machine has no semaphores for it, as some services have none."""
    try:
        return _pool(number)
    except (ImportError, NotImplementedError, OSError) as error:
        LOGGER.info(_HERE, error)
        return None


_HERE = "everything is solved in this process, which cannot start others: %s"


@contextmanager
def _of_pool(pool: ProcessPoolExecutor, number: int) -> Iterator[Crew]:
    """Context with the crew of a pool, or with this process if no process can be started."""
    here: Crew | None = None

    def submit(call: Callable[..., T], *values: Any) -> Future[T]:
        nonlocal here
        if here is not None:
            return here.submit(call, *values)
        from concurrent.futures import BrokenExecutor

        # The first calls start the processes, which inherit the setting that ignores interrupts (Ctrl-C).
        # Later calls hold an interrupt back: it would be lost.
        first = not _of(pool)
        try:
            with without_interrupts() if len(_of(pool)) < number else held_back():
                return pool.submit(call, *values)
        except (OSError, RuntimeError) as error:
            if not first or isinstance(error, BrokenExecutor):
                raise
            LOGGER.info(_HERE, error)
        # Limits of a service or a shell, such as ``ulimit -u``, allow no process.
        _terminate(pool)
        pool.shutdown(wait=False, cancel_futures=True)  # a thread that did not start cannot be waited for
        here = this_process()
        return here.submit(call, *values)

    def renew() -> None:
        nonlocal pool
        end_now(pool)
        pool = _pool(number)

    def abandon(_: Iterable[Future[Any]]) -> None:
        """They end with the pool. Were they cancelled as a process dies, its own thread would fail."""

    def check() -> None:
        # Where a process dies in the middle of a result, the pool waits for the rest of it.
        if any(process.exitcode is not None for process in _of(pool)):
            _terminate(pool)

    def width() -> int:
        return _AHEAD * number + 1 if here is None else 1

    try:
        yield Crew(submit, width, renew, shares_memory=True, abandon=abandon, check=check)
    finally:
        # Not left to end by themselves: in a process that multiprocessing started, the pool's thread may come
        # too late to stop them, and the process then waits for them endlessly. This is also faster.
        end_now(pool)


def _pool(number: int) -> ProcessPoolExecutor:
    # Every command asks for the number of cores; few start processes.
    from concurrent.futures import ProcessPoolExecutor

    from ehlectric.runtime.spawning import Context

    return ProcessPoolExecutor(number, mp_context=Context(), initializer=_prepare_process)


def _prepare_process() -> None:
    """Prepare a new process: it ends with its parent, and uses one BLAS thread."""
    from threadpoolctl import threadpool_limits

    # Where the process has not inherited it, as on Windows.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    end_with_parent()
    # The environment limits libraries that are loaded later; threadpool_limits limits loaded libraries.
    os.environ |= dict.fromkeys(_THREADS, "1")
    threadpool_limits(1)


def end_now(pool: ProcessPoolExecutor) -> None:
    """End a pool and its processes at once, without waiting for the tasks that are running."""
    with without_interrupts():
        _terminate(pool)
        pool.shutdown(cancel_futures=True)


def _of(pool: ProcessPoolExecutor) -> list[Any]:
    """Processes of a pool."""
    return list((getattr(pool, "_processes", None) or {}).values())


def _terminate(pool: ProcessPoolExecutor) -> None:
    """End the processes of a pool, also where one of them is sending a result."""
    for process in _of(pool):
        process.terminate()
    results = getattr(pool, "_result_queue", None)
    if results is not None:
        # Of a result that was cut off, the pool's thread would wait for the rest while a writer is open.
        results._writer.close()


@contextmanager
def without_interrupts() -> Iterator[None]:
    """Context in which Ctrl-C is ignored, and other signals that stop the program are held back.

    In other threads than the main thread it does nothing.
    """
    with held_back():
        if threading.current_thread() is threading.main_thread():
            # Processes that are started inherit this; ``held_back`` restores what was before.
            signal.signal(signal.SIGINT, signal.SIG_IGN)
        yield


def end_with_parent() -> None:
    """Start a thread that ends this process as soon as its parent has ended. Processes of a pool call it."""
    import multiprocessing

    def watch() -> None:
        parent = multiprocessing.parent_process()
        if parent is not None:
            parent.join()
            os._exit(1)

    threading.Thread(target=watch, daemon=True).start()
