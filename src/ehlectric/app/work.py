"""Work of the app: temporary folders, immediate answers, and jobs that report progress and can be cancelled.

The process of the server computes nothing, so that every page answers at once whatever is being solved. A
immediate answer waits for one of a few warm processes. A job has a process of its own, which is killed when
it is cancelled, when its tab is closed, or when it uses more time or memory than is allowed. Sessions are
served alternately. Immediate answers of calls that are ``kept`` stay for a while: a page gets an answer that
was computed before, or that is being computed, without a second computation.
"""

from __future__ import annotations

import asyncio
import contextlib
import json
import logging
import os
import shutil
import tempfile
from collections.abc import Callable, Mapping
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field, replace
from functools import cached_property
from multiprocessing.util import Finalize, get_temp_dir
from pathlib import Path
from typing import Any, Literal, TypeVar, cast
from weakref import WeakKeyDictionary

from ehlectric.app.calls import Call
from ehlectric.app.processes import Bounds, Raised, Returned, Worker, new_context
from ehlectric.errors import LostError
from ehlectric.readable import readable
from ehlectric.runtime.locks import RENAMES_OPEN, try_lock
from ehlectric.runtime.memory import available_memory
from ehlectric.runtime.progress import Remaining
from ehlectric.runtime.worker_processes import cores

T = TypeVar("T")

_log = logging.getLogger("ehlectric.app")

# Quick answers of one session that are computed at once, and those that may wait.
_AT_ONCE, _QUEUED = 2, 50

# Immediate answers that are kept; an answer about a bearing has 130 kB.
_KEPT = 64

# Names of the folders of servers, and of the file in each that its server keeps locked.
_PREFIX, _LOCK = "ehlectric-app-", "lock"

# Beginning of the name of the folder that multiprocessing makes for its sockets.
_MULTIPROCESSING = "pymp-"

# Longest path of a folder whose sockets have names that systems allow, of about 100 characters, below the
# folder that multiprocessing makes.
_LONGEST = 70


class Scratch:
    """Temporary folder of a server, which only this user can read.

    Examples
    --------
    >>> scratch = Scratch()
    >>> scratch.new().is_dir()
    True
    >>> scratch.remove()
    >>> scratch.folder.exists()
    False
    """

    def __init__(self) -> None:
        self.folder = Path(tempfile.mkdtemp(prefix=_PREFIX))
        # The file gets its name when it is locked, so that no other server takes the folder for a dead one's.
        begun = self.folder / ("unlocked" if RENAMES_OPEN else _LOCK)
        self._lock = begun.open("wb")
        try_lock(self._lock.fileno())
        if RENAMES_OPEN:
            begun.rename(self.folder / _LOCK)
        # At exit, and after multiprocessing has removed its folder in it.
        Finalize(None, shutil.rmtree, (self.folder,), {"ignore_errors": True}, exitpriority=-200)

    def new(self) -> Path:
        """New folder in it."""
        return Path(tempfile.mkdtemp(prefix="session-", dir=self.folder))

    def remove(self) -> None:
        """Remove the folder with all that is in it; the folder of multiprocessing lasts until the exit."""
        for entry in list(self.folder.iterdir()) if self.folder.exists() else []:
            if entry.is_dir() and not entry.name.startswith(_MULTIPROCESSING):
                shutil.rmtree(entry, ignore_errors=True)
            elif not entry.is_dir():
                entry.unlink(missing_ok=True)
        self._lock.close()
        with contextlib.suppress(OSError):
            self.folder.rmdir()


def take_temporary_files(folder: Path) -> None:
    """Have this process put its temporary files into a folder, with the sockets of its workers if they fit.

    The names of sockets are bounded, so those below a long path lie in /tmp.
    """
    fits = len(str(folder)) <= _LONGEST or not Path("/tmp").is_dir()
    tempfile.tempdir = str(folder) if fits else "/tmp"
    # multiprocessing makes its folder for sockets once.
    get_temp_dir()
    tempfile.tempdir = str(folder)


def clear_left_behind() -> None:
    """Remove the folders of servers that were killed."""
    for folder in Path(tempfile.gettempdir()).glob(f"{_PREFIX}*"):
        if _left_behind(folder):
            shutil.rmtree(folder, ignore_errors=True)


def _left_behind(folder: Path) -> bool:
    """Whether a folder is this user's and its server has ended."""
    try:
        owner = getattr(os, "getuid", lambda: folder.lstat().st_uid)()
        if folder.is_symlink() or folder.lstat().st_uid != owner:
            return False
        with (folder / _LOCK).open("rb+") as file:
            return try_lock(file.fileno()) == "taken"
    except OSError:
        # It is another user's, or it is being made or removed by its server.
        return False


@dataclass
class TimeLeft:
    """Words about the time that is left of the part of a job that is under way.

    Examples
    --------
    >>> left = TimeLeft()
    >>> left.text_of("time steps", 0, 200, now=0.0), left.text_of("time steps", 50, 200, now=60.0)
    ('', 'about 3 min left')
    >>> left.text_of("drawing", 1, 2, now=61.0)
    ''
    """

    text: str = ""
    remaining: Remaining = field(default_factory=Remaining)

    def text_of(self, text: str, done: int, of: int, *, now: float) -> str:
        """Words about the time that is left; empty where it is not known."""
        if text != self.text:
            self.text, self.remaining = text, Remaining()
        self.remaining.step(done, of, now=now)
        left = self.remaining.seconds(now=now)
        if left is None:
            return ""
        if left < 60.0:
            return f"about {max(1.0, left):.0f} s left"
        return f"about {left / 60.0:.0f} min left"


State = Literal["waiting", "running", "done", "failed", "cancelled"]


@dataclass(eq=False)
class Job:
    """Work in a process of its own, as its page sees it."""

    state: State = "waiting"  # "waiting", "running", "done", "failed" or "cancelled"
    # Progress: steps that are done, all steps, and what is being done.
    done: int = 0
    of: int = 0
    text: str = "waiting for a free core"
    result: Any = None  # what the function returned, of a job that is done
    error: Exception | None = None
    call: tuple[Callable[..., Any], tuple[Any, ...]] | None = None
    owner: object = None  # session of the job; sessions are served alternately
    _worker: Worker | None = None
    _ended: asyncio.Event = field(default_factory=asyncio.Event)

    @property
    def over(self) -> bool:
        """Whether the job has ended in any way."""
        return self.state in ("done", "failed", "cancelled")

    def cancel(self) -> None:
        """End the job now; nothing happens where it has ended."""
        self.end("cancelled")

    async def wait(self) -> None:
        """Wait until the job has ended."""
        await self._ended.wait()

    def run_in(self, worker: Worker) -> None:
        """Note the process in which the job runs."""
        self._worker, self.state, self.text = worker, "running", "starting"

    def report(self, done: int, of: int, text: str) -> None:
        """Note its progress."""
        self.done, self.of, self.text = done, of, text

    def end(self, state: State, *, result: Any = None, error: Exception | None = None) -> None:
        """End the job, with its process; nothing happens where it has ended."""
        if self.over:
            return
        self.state, self.result, self.error = state, result, error
        if self._worker is not None:
            self._worker.end()
        self._ended.set()


@dataclass(frozen=True)
class Limits:
    """Limits of the work of all sessions together."""

    # Jobs that run at once; further ones wait.
    jobs: int = field(default_factory=lambda: max(1, cores() // 2))
    each: int = 8  # jobs of one session that run or wait
    waiting: int = 100  # jobs of all sessions that may wait
    # Address space of a process of a job and of each that it starts [bytes].
    memory: float = field(default_factory=lambda: min(8e9, max(2e9, available_memory() / 2.0)))
    quick_memory: float = 4e9  # address space of a process of immediate answers [bytes]
    seconds: float = 3600.0  # time of a job [s]
    patience: float = 30.0  # time of an immediate answer if each process has a core [s]


# Largest factor by which a loaded machine extends the time of an immediate answer.
_MOST_CROWDING = 6.0


def crowding() -> float:
    """Return the number of running processes by core, from 1 to 6; 1 if the system does not count them."""
    load = getattr(os, "getloadavg", None)
    return 1.0 if load is None else min(_MOST_CROWDING, max(1.0, load()[0] / cores()))


def limits_of(*, jobs: int | None, gigabytes: float | None, minutes: float) -> Limits:
    """Limits with a number of jobs, memory [GB] and time of a job [min]; None for the usual ones."""
    usual = Limits(seconds=60.0 * minutes)
    return replace(
        usual,
        jobs=usual.jobs if jobs is None else jobs,
        memory=usual.memory if gigabytes is None else 1e9 * gigabytes,
    )


class Work:
    """Quick answers and jobs of a server, within limits.

    Use it on one event loop. ``close`` ends all processes and removes the temporary folder.
    """

    def __init__(self, limits: Limits | None = None) -> None:
        self.limits = limits or Limits()
        self._context = new_context()
        number = max(1, min(4, cores()))
        self._quick = [Worker(self._context, self._bounds(self.limits.quick_memory)) for _ in range(number)]
        self.behind = asyncio.Semaphore(max(1, number - 1))
        # The last process that answered answers next: it has parts of the answers to the same inputs.
        self._idle: asyncio.LifoQueue[Worker] = asyncio.LifoQueue()
        self._answers: dict[str, asyncio.Future[Returned | Raised]] = {}
        for worker in self._quick:
            self._idle.put_nowait(worker)
        self._threads = ThreadPoolExecutor(number + self.limits.jobs, "ehlectric-work")
        self._waiting: list[Job] = []
        self._running: dict[Job, Worker] = {}
        self._tasks: set[asyncio.Task[None]] = set()
        # Number of the last job that began, by session.
        self._turns: WeakKeyDictionary[object, int] = WeakKeyDictionary()
        self._number = 0

    @cached_property
    def scratch(self) -> Scratch:
        """Temporary folder of the server, made when first used."""
        return Scratch()

    def warm(self) -> None:
        """Start the processes of immediate answers, which load what they need, without waiting for them."""
        for worker in self._quick:
            self._threads.submit(worker.start)

    def share(self) -> Share:
        """Share of a session in the work."""
        return Share(self)

    def close(self) -> None:
        """End all jobs and processes, and remove the temporary folder."""
        for job in [*self._waiting, *self._running]:
            job.cancel()
        workers = [*self._quick, *self._running.values()]
        for worker in workers:
            worker.end()
        for worker in workers:
            worker.close()
        self._threads.shutdown(wait=False, cancel_futures=True)
        if "scratch" in self.__dict__:
            self.scratch.remove()

    async def answer(self, function: Call[Any], values: tuple[Any, ...]) -> Returned | Raised:
        """Outcome of a function in one of the processes of immediate answers, or its kept outcome."""
        key = key_of(function, values)
        if not key:
            return await self._answer(function, values)
        task = self._answers.pop(key, None)
        if task is None or task.cancelled():
            task = asyncio.ensure_future(self._answer(function, values))
        self._answers[key] = task  # the latest at the end
        if len(self._answers) > _KEPT:
            del self._answers[next(iter(self._answers))]
        outcome = await asyncio.shield(task)
        if isinstance(outcome, Raised):
            self._answers.pop(key, None)
        return outcome

    def has(self, function: Call[Any], values: tuple[Any, ...]) -> bool:
        """Whether the outcome of a function is kept."""
        task = self._answers.get(key_of(function, values))
        return task is not None and task.done()

    def keep(self, answers: Mapping[str, Any]) -> None:
        """Keep results by their keys, as if they had been computed."""
        for key, result in answers.items():
            self._answers[key] = asyncio.get_running_loop().create_future()
            self._answers[key].set_result(Returned(result))

    async def _answer(self, function: Call[Any], values: tuple[Any, ...]) -> Returned | Raised:
        worker = await self._idle.get()
        loop, overdue = asyncio.get_running_loop(), asyncio.Event()

        def end() -> None:
            overdue.set()
            worker.kill()

        def ended(_: object) -> None:
            timers[0].cancel()
            self._idle.put_nowait(worker)

        begun = loop.time()

        def look() -> None:
            # Other processes of a loaded machine slow the answer down.
            allowed = self.limits.patience * crowding()
            if loop.time() - begun < allowed:
                timers[:] = [loop.call_later(max(0.1, begun + allowed - loop.time()), look)]
            else:
                end()

        future = loop.run_in_executor(self._threads, worker.ask, function, values)
        # Call and process end in time also where nobody waits for the answer any more.
        timers = [loop.call_later(self.limits.patience, look)]
        future.add_done_callback(ended)
        outcome = await asyncio.shield(future)
        if overdue.is_set():
            seconds = readable(loop.time() - begun, 2)
            return Raised(LostError(f"the answer took longer than {seconds} s"))
        return outcome

    def add(self, job: Job) -> None:
        """Queue a job, which runs as soon as its session has its turn.

        Raises LostError if too many jobs wait already, of its session or of all.
        """
        unfinished = [other for other in [*self._waiting, *self._running] if not other.over]
        if sum(other.owner is job.owner for other in unfinished) >= self.limits.each:
            raise LostError(f"{self.limits.each} computations of this page run or wait; cancel one of them")
        if len(unfinished) >= self.limits.jobs + self.limits.waiting:
            raise LostError("too many computations are waiting; try again later")
        self._waiting.append(job)
        self._begin()

    def _begin(self) -> None:
        """Begin waiting jobs while there is room.

        The session with the fewest running jobs is first, then that which had none for the longest time.
        """
        self._waiting = [job for job in self._waiting if not job.over]
        while self._waiting and len(self._running) < self.limits.jobs:
            owners = [job.owner for job in self._running]
            turns = [(owners.count(job.owner), self._turns.get(job.owner, 0)) for job in self._waiting]
            job = self._waiting.pop(turns.index(min(turns)))
            self._number += 1
            self._turns[job.owner] = self._number
            worker = Worker(self._context, self._bounds(self.limits.memory))
            self._running[job] = worker
            job.run_in(worker)
            task = asyncio.get_running_loop().create_task(self._run(job, worker))
            self._tasks.add(task)
            task.add_done_callback(self._tasks.discard)

    async def _run(self, job: Job, worker: Worker) -> None:
        assert job.call is not None
        future = asyncio.get_running_loop().run_in_executor(self._threads, worker.ask, *job.call, job.report)
        try:
            outcome = await asyncio.wait_for(asyncio.shield(future), self.limits.seconds)
        except TimeoutError:
            minutes = self.limits.seconds / 60.0
            job.end(
                "failed", error=LostError(f"stopped: it took longer than the {readable(minutes)} min allowed")
            )
            await future
        else:
            if isinstance(outcome, Returned):
                job.end("done", result=outcome.result)
            else:
                if not job.over:
                    log(outcome)
                job.end("failed", error=outcome.error)
        finally:
            await asyncio.get_running_loop().run_in_executor(self._threads, worker.close)
            del self._running[job]
            self._begin()

    def _bounds(self, memory: float) -> Callable[[], Bounds]:
        return lambda: Bounds(memory, str(self.scratch.folder))


class Share:
    """Share of one session in the work: no session keeps others from their answers."""

    def __init__(self, work: Work) -> None:
        self._work = work
        self.behind = work.behind
        self._turn = asyncio.Semaphore(_AT_ONCE)
        self._queued = 0
        self._jobs: list[Job] = []
        self._closed = False

    async def quick(self, function: Call[T], *values: Any) -> T:
        """Result of a function of a worker process that takes a second at most.

        Raises InputError and ConvergenceError as the function raises them; LostError where it takes too long,
        its process dies, the session has ended, or the program has an error.
        """
        if self._queued >= _QUEUED:
            raise LostError("this page asks for more answers than are computed; wait a moment")
        self._queued += 1
        try:
            async with self._turn:
                if self._closed:
                    raise LostError("the page was closed")
                outcome = await self._work.answer(function, values)
        finally:
            self._queued -= 1
        if isinstance(outcome, Raised):
            log(outcome)
            raise outcome.error
        return cast("T", outcome.result)

    def has(self, function: Call[Any], *values: Any) -> bool:
        """Whether ``quick`` has its result without a computation."""
        return self._work.has(function, values)

    def start(self, function: Call[Any], *values: Any) -> Job:
        """Start a job: ``function(*values, progress)`` in a process of its own.

        Raises LostError if too many jobs wait already, or the session has ended.
        """
        if self._closed:
            raise LostError("the page was closed")
        job = Job(call=(function, values), owner=self)
        self._work.add(job)
        self._jobs = [*(job for job in self._jobs if not job.over), job]
        return job

    def close(self) -> None:
        """End the jobs, and refuse what follows."""
        self._closed = True
        for job in self._jobs:
            job.cancel()


def key_of(function: Call[Any], values: tuple[Any, ...]) -> str:
    """Key of an outcome that depends on nothing else than a call and plain values; empty for another.

    Examples
    --------
    >>> key_of(Call("drive_answers.quick_answer", kept=True), ({"title": "A"}, None))
    'drive_answers.quick_answer [{"title": "A"}, null]'
    >>> key_of(Call("drive_answers.quick_answer", kept=True), ({}, Path("folder of uploaded files")))
    ''
    >>> key_of(Call("sweep_answers.files"), ("folder of a sweep",))
    ''
    """
    if not (isinstance(function, Call) and function.kept):
        return ""
    try:
        return f"{function.name} {json.dumps(values)}"
    except TypeError:  # Folders and contents of files.
        return ""


def log(outcome: Raised) -> None:
    """Write the traceback of an error of the program to the log of the server."""
    if outcome.trace:
        _log.error("%s", outcome.trace.rstrip())
