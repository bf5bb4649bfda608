"""Worker processes that call functions for the server, one call at a time."""

from __future__ import annotations

import contextlib
import multiprocessing
import os
import signal
import tempfile
import threading
import traceback
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from importlib import import_module
from multiprocessing import resource_tracker
from typing import Any

from ehlectric.errors import ConvergenceError, InputError, LostError
from ehlectric.runtime.progress import Progress
from ehlectric.runtime.worker_processes import end_with_parent, limit_blas

# Loaded before there is any work, in the process from which all others are forked.
_PRELOADED = "ehlectric.app.compute.preload"

# Modules of the other pages, which a process loads one by one when it was idle for a time [s]. Before the
# first answer they would take as long as the answer itself.
_OTHERS = tuple(
    f"ehlectric.app.compute.{name}_answers"
    for name in ("contact", "drive", "gear", "sweep", "remedy", "compare")
)
_IDLE = 5.0


@dataclass(frozen=True)
class Returned:
    """Outcome of a call that returned."""

    result: Any


@dataclass(frozen=True)
class Raised:
    """Outcome of a call that failed."""

    error: Exception
    trace: str = ""  # traceback for the log of the server, of an error of the program itself


@dataclass(frozen=True)
class Bounds:
    """Bounds of a worker process."""

    memory: float  # address space of the process and of each that it starts [bytes]
    folder: str


class Worker:
    """Process that calls functions, one at a time.

    The process starts with the first call, within the bounds that ``bounds`` returns then. If it has died,
    the next call starts another.
    """

    def __init__(self, context: Any, bounds: Callable[[], Bounds]) -> None:
        self._context, self._bounds = context, bounds
        self._process: Any = None
        self._pipe: Any = None
        self._starting = threading.Lock()
        # Held while a thread uses the pipe: a pipe closed under it, or twice at once, may close a file of
        # another that was given its number in between.
        self._using = threading.Lock()
        self._closed = threading.Event()

    @property
    def pid(self) -> int | None:
        """Number of the process; None where there is none."""
        return None if self._process is None else self._process.pid

    def start(self) -> None:
        """Start the process unless it runs; this waits until it has loaded what it needs."""
        with self._starting:
            if self._closed.is_set() or (self._process is not None and self._process.is_alive()):
                return
            self._pipe, theirs = self._context.Pipe()
            process = self._context.Process(target=_serve, args=(theirs, self._bounds()), daemon=False)
            with _uninterrupted():
                process.start()
            theirs.close()
            self._process = process
        if self._closed.is_set():
            self.kill()

    def ask(
        self, function: Callable[..., Any], values: tuple[Any, ...], tell: Progress | None = None
    ) -> Returned | Raised:
        """Call a function in the process, and wait for its outcome, a LostError where the process died.

        This blocks its thread.
        """
        try:
            self.start()
        except Exception as error:
            return _fault(error)
        try:
            with self._using:
                return self._answer(function, values, tell)
        except (EOFError, OSError):
            # The next call finds it dead, and starts another.
            self._process.join(1.0)
            return Raised(LostError("its process was killed, as by a system out of memory"))
        except Exception as error:
            self.kill()
            return _fault(error)

    def _answer(
        self, function: Callable[..., Any], values: tuple[Any, ...], tell: Progress | None
    ) -> Returned | Raised:
        if self._closed.is_set():
            return Raised(LostError("the server is being stopped"))
        self._pipe.send((function, values, tell is not None))
        while True:
            message = self._pipe.recv()
            if isinstance(message, Returned | Raised):
                return message
            if tell is not None:
                tell(*message)

    def kill(self) -> None:
        """End the process now, with all that it started."""
        process = self._process
        # Where the server of forks has died, its processes count as dead, except a process that answers.
        if process is None or not (process.is_alive() or self._using.locked()):
            return
        with contextlib.suppress(OSError, AttributeError):
            # The process leads a group of its own; systems without groups lack the function.
            os.killpg(process.pid, signal.SIGKILL)
        process.kill()

    def end(self) -> None:
        """End the process for good, without waiting."""
        self._closed.set()
        self.kill()

    def close(self) -> None:
        """End the process for good, and wait until it has ended."""
        self.end()
        with self._starting:
            if self._process is None:
                return
            self._process.join(5.0)
        # The thread that waits for the process gets no answer any more, and leaves the pipe.
        if self._using.acquire(timeout=5.0):
            try:
                self._pipe.close()
            finally:
                self._using.release()


def new_context() -> Any:
    """Context that starts processes: forks of one that has loaded the physics, or new ones."""
    if "forkserver" not in multiprocessing.get_all_start_methods():
        return multiprocessing.get_context("spawn")
    # A fork must not inherit the threads of a BLAS library.
    limit_blas()
    context = multiprocessing.get_context("forkserver")
    context.set_forkserver_preload([_PRELOADED])
    return context


@contextlib.contextmanager
def _uninterrupted() -> Iterator[None]:
    """Context in which this thread starts processes that Ctrl-C does not reach, not even while they load."""
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    # It is started with the first process, and lets the signal through again.
    resource_tracker.ensure_running()
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def _serve(pipe: Any, bounds: Bounds) -> None:
    """Answer calls until the server closes the pipe; in the process."""
    _prepare(bounds)
    others = [*_OTHERS]
    with contextlib.suppress(EOFError, BrokenPipeError):
        while True:
            while others and not pipe.poll(_IDLE):
                import_module(others.pop(0))
            try:
                function, values, reports = pipe.recv()
            except EOFError:
                raise
            except Exception as error:
                pipe.send(_fault(error))
                continue
            further = (lambda *progress: pipe.send(progress),) if reports else ()
            _reply(pipe, _outcome(function, (*values, *further)))


def _reply(pipe: Any, outcome: Returned | Raised) -> None:
    try:
        pipe.send(outcome)
    except (EOFError, BrokenPipeError):
        raise
    except Exception as error:
        # The result does not pickle, or there is no memory for its copy.
        pipe.send(_fault(error))


def _outcome(function: Callable[..., Any], values: tuple[Any, ...]) -> Returned | Raised:
    try:
        return Returned(function(*values))
    except (InputError, ConvergenceError, LostError) as error:
        return Raised(error)
    except Exception as error:
        return _fault(error)


def _fault(error: Exception) -> Raised:
    """Outcome of a call that failed for another reason than its inputs."""
    from ehlectric.runtime.memory import is_out_of_memory, out_of_memory

    if is_out_of_memory(error):
        return Raised(LostError(out_of_memory(error)))
    message = f"error in the program ({type(error).__name__}); the log of the server has the details"
    return Raised(LostError(message), "".join(traceback.format_exception(error)))


def _prepare(bounds: Bounds) -> None:
    """Prepare this process: it leads a group, ends with the server, ignores Ctrl-C and is bounded."""
    if hasattr(os, "setpgid"):
        os.setpgid(0, 0)
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    end_with_parent()
    tempfile.tempdir = os.environ["TMPDIR"] = bounds.folder
    with contextlib.suppress(ImportError, ValueError, OSError):
        # Windows lacks the module.
        resource: Any = import_module("resource")
        resource.setrlimit(resource.RLIMIT_AS, (int(bounds.memory), int(bounds.memory)))
