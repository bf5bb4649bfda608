"""Answers that follow the inputs of a page: one at once, and fuller ones when the inputs are quiet."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable, Sequence
from typing import Any, Generic, TypeVar

from ehlectric.errors import ConvergenceError, InputError, LostError

I = TypeVar("I")  # noqa: E741
T = TypeVar("T")

# Time without a change after which fuller answers are computed [s].
_QUIET = 0.15


class OnlyLast:
    """Coroutine function that runs one call at a time; of the calls made meanwhile only the last is kept."""

    def __init__(self, run: Callable[..., Awaitable[None]]) -> None:
        self._run = run
        self._waiting: tuple[Any, ...] | None = None
        self._running = False

    async def __call__(self, *values: Any) -> None:
        """Run with these values, after the run that is under way."""
        self._waiting = values
        if self._running:
            return
        self._running = True
        try:
            while self._waiting is not None:
                values, self._waiting = self._waiting, None
                await self._run(*values)
        finally:
            self._running = False

    def drop(self) -> None:
        """Drop the call that waits."""
        self._waiting = None


class LatestAnswer(Generic[I, T]):
    """Answers to the latest inputs; those to older inputs that have not begun are never computed.

    ``quick`` computes an answer at once, and each of ``later`` a fuller one, in their order: the first
    ``prompt`` of them right after the immediate answer, the others when the inputs are quiet.
    ``known`` returns the number of the fullest answer that is computed already; those before are skipped.
    ``show`` shows an answer to the latest inputs, ``passing`` one to inputs that have changed meanwhile, and
    ``refuse`` the error where the latest inputs have no answer. ``lack`` gets the number of a fuller answer
    that was lost, as when it took too long; by default ``refuse`` gets its error.
    """

    def __init__(
        self,
        quick: Callable[[I], Awaitable[T]],
        later: Sequence[Callable[[I], Awaitable[T]]] = (),
        *,
        show: Callable[[I, T], None],
        passing: Callable[[I, T], None],
        refuse: Callable[[Exception], None],
        behind: asyncio.Semaphore,
        prompt: int = 0,
        known: Callable[[I], int] = lambda _: 0,
        lack: Callable[[LostError, int], None] | None = None,
    ) -> None:
        self._lack = lack
        self._steps, self._known, self._refuse = (quick, *later), known, refuse
        self._show, self._pass = show, passing
        self._behind, self._prompt = behind, prompt
        self._request = 0
        self._pending: tuple[int, I, bool] | None = None
        self._running: asyncio.Task[None] | None = None
        self._later: asyncio.Task[None] | None = None

    def ask(self, inputs: I, *, at_once: bool = False) -> asyncio.Task[None]:
        """Ask for the answers to new inputs; the task ends with the immediate answer to the latest inputs.

        Fuller answers follow ``at_once``, or when the inputs are quiet.
        """
        self.drop()
        self._pending = (self._request, inputs, at_once)
        if self._running is None or self._running.done():
            self._running = asyncio.create_task(self._run())
        return self._running

    def drop(self) -> None:
        """Want no answers any more to the inputs so far."""
        self._request += 1
        self._pending = None

    async def _run(self) -> None:
        while self._pending is not None:
            (request, inputs, at_once), self._pending = self._pending, None
            step = self._known(inputs)
            answer = await self._answer(request, inputs, self._steps[step])
            if answer is not None and request == self._request:
                if step + 1 < len(self._steps):
                    quiet = 0.0 if at_once else _QUIET
                    self._later = asyncio.create_task(self._follow(request, inputs, step + 1, quiet))
                self._show(inputs, answer)
            elif answer is not None and self._waits():
                self._pass(inputs, answer)

    def _waits(self) -> bool:
        """Whether newer inputs wait for their answer."""
        return self._pending is not None

    async def _answer(
        self, request: int, inputs: I, compute: Callable[[I], Awaitable[T]], number: int = 0
    ) -> T | None:
        """Answer to inputs; None for an error, which is shown if they are still the latest."""
        try:
            return await compute(inputs)
        except (InputError, ConvergenceError, LostError) as error:
            if request == self._request:
                if number and self._lack is not None and isinstance(error, LostError):
                    self._lack(error, number)
                else:
                    self._refuse(error)
            return None

    async def _follow(self, request: int, inputs: I, first: int, quiet: float) -> None:
        """Show the fuller answers from the number ``first``; ``quiet``, time without a change [s]."""
        for number, compute in enumerate(self._steps[first:], first):
            if number == max(first, self._prompt + 1):
                await asyncio.sleep(quiet)
            async with self._behind:
                if request != self._request:
                    return
                answer = await self._answer(request, inputs, compute, number)
            if answer is None or request != self._request:
                return
            self._show(inputs, answer)
