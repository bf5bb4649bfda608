"""Jobs as their pages see them: progress, result or error, and an end at any time."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, Literal

from ehlectric.app.processes import Worker

State = Literal["waiting", "running", "done", "failed", "cancelled"]


@dataclass(eq=False)
class Job:
    """Work in a process of its own, as its page sees it.

    Attributes
    ----------
    state : str
        "waiting", "running", "done", "failed" or "cancelled".
    done, of, text : int, int, str
        Progress, as ``runtime.progress`` tells it.
    result : object
        What the function returned, of a job that is done.
    error : InputError, ConvergenceError, LostError or None
        Error of a failed job.
    call : tuple
        Function and arguments.
    owner : object
        Session of the job; sessions take turns.
    """

    state: State = "waiting"
    done: int = 0
    of: int = 0
    text: str = "waiting for a free core"
    result: Any = None
    error: Exception | None = None
    call: tuple[Callable[..., Any], tuple[Any, ...]] | None = None
    owner: object = None
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

    def told(self, done: int, of: int, text: str) -> None:
        """Take over its progress."""
        self.done, self.of, self.text = done, of, text

    def end(self, state: State, *, result: Any = None, error: Exception | None = None) -> None:
        """End the job, with its process; nothing happens where it has ended."""
        if self.over:
            return
        self.state, self.result, self.error = state, result, error
        if self._worker is not None:
            self._worker.end()
        self._ended.set()
