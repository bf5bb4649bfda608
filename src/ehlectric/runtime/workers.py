"""Pool of processes that ends at once where a run is stopped, and with its parent process."""

from __future__ import annotations

import multiprocessing
import os
import signal
import threading
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from typing import TypeVar

T = TypeVar("T")


def cores() -> int:
    """Number of cores that this process may use."""
    affinity = getattr(os, "sched_getaffinity", None)
    return (os.cpu_count() or 1) if affinity is None else len(affinity(0))


def run_all(
    tasks: Sequence[Callable[[], T]], done: Callable[[int, T], None], *, processes: int | None = None
) -> None:
    """Run tasks in parallel, in processes of their own.

    Parameters
    ----------
    tasks : sequence of callable
        Tasks without arguments. They and their results must pickle.
    done : callable
        Called in this process with the number of a task and its result, as the tasks finish.
    processes : int, optional
        Largest number of processes; by default as many as there are cores.

    Raises
    ------
    RuntimeError
        Where a process was killed or could not begin. A script that calls this needs
        ``if __name__ == "__main__":``.
    """
    pool = ProcessPoolExecutor(
        min(processes or cores(), len(tasks)),
        mp_context=multiprocessing.get_context("spawn"),
        initializer=end_with_parent,
    )
    try:
        with without_interrupts():
            # The processes start with the first tasks and inherit that interrupts are ignored.
            futures = {pool.submit(task): number for number, task in enumerate(tasks)}
        for future in as_completed(futures):
            done(futures[future], future.result())
    except BaseException as error:
        end_now(pool)
        if isinstance(error, BrokenProcessPool):
            raise RuntimeError(
                "a process that solves contacts was killed or could not begin; a script that solves in "
                'parallel needs its calls below if __name__ == "__main__":'
            ) from None
        raise
    pool.shutdown()


def end_now(pool: ProcessPoolExecutor) -> None:
    """End a pool and its processes at once, without waiting for the tasks that are running."""
    with without_interrupts():
        for process in list((getattr(pool, "_processes", None) or {}).values()):
            process.terminate()
        pool.shutdown(cancel_futures=True)


@contextmanager
def without_interrupts() -> Iterator[None]:
    """Context in which Ctrl-C is ignored. In other threads than the main thread it does nothing."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    before = signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)


def end_with_parent() -> None:
    """Start a thread that ends this process as soon as its parent has ended. Processes of a pool call it."""

    def watch() -> None:
        parent = multiprocessing.parent_process()
        if parent is not None:
            parent.join()
            os._exit(1)

    threading.Thread(target=watch, daemon=True).start()
