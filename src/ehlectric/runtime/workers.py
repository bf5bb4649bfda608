"""A pool of processes that ends when it should: at once where the run is stopped, and with its parent."""

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
    """Cores that this process may use."""
    affinity = getattr(os, "sched_getaffinity", None)
    return (os.cpu_count() or 1) if affinity is None else len(affinity(0))


def run_all(
    tasks: Sequence[Callable[[], T]], done: Callable[[int, T], None], *, processes: int | None = None
) -> None:
    """Run tasks in processes of their own, one a core.

    Parameters
    ----------
    tasks : sequence of callable
        Without arguments; they and what they return must pickle.
    done : callable
        Called in this process with the number of a task and what it returned, as they finish.
    processes : int, optional
        How many at most; as many as there are cores otherwise.

    Raises
    ------
    RuntimeError
        Where a process was killed, or could not begin: a script that calls this needs
        ``if __name__ == "__main__":``.
    """
    pool = ProcessPoolExecutor(
        min(processes or cores(), len(tasks)),
        mp_context=multiprocessing.get_context("spawn"),
        initializer=end_with_parent,
    )
    try:
        with without_interrupts():
            # Processes begin with the first tasks, and inherit that interrupts are not for them.
            futures = {pool.submit(task): number for number, task in enumerate(tasks)}
        for future in as_completed(futures):
            done(futures[future], future.result())
    except BaseException as error:
        end_now(pool)
        if isinstance(error, BrokenProcessPool):
            raise RuntimeError(
                "a process that solves contacts was killed or could not begin; a script that solves in "
                'parallel takes its calls below if __name__ == "__main__":'
            ) from None
        raise
    pool.shutdown()


def end_now(pool: ProcessPoolExecutor) -> None:
    """End a pool and its processes, whatever they are at: nobody waits for what they would still find."""
    with without_interrupts():
        for process in list((getattr(pool, "_processes", None) or {}).values()):
            process.terminate()
        pool.shutdown(cancel_futures=True)


@contextmanager
def without_interrupts() -> Iterator[None]:
    """Ctrl-C ignored for a moment; threads that are not the main one have no say in that."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    before = signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)


def end_with_parent() -> None:
    """End this process when its parent is gone, however that came: what a process of a pool begins with."""

    def watch() -> None:
        parent = multiprocessing.parent_process()
        if parent is not None:
            parent.join()
            os._exit(1)

    threading.Thread(target=watch, daemon=True).start()
