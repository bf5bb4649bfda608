"""Answers that follow the inputs of a page: one at once, and a whole one when the inputs are quiet."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable
from typing import Generic, TypeVar

from ehlectric.errors import ConvergenceError, InputError, LostError

I = TypeVar("I")  # noqa: E741
T = TypeVar("T")

# Time without a change after which the whole answer is computed [s].
_QUIET = 0.3


class Following(Generic[I, T]):
    """Answers to the latest inputs; those to older inputs that have not begun are never computed. ``quick``
    and ``whole``, compute the answer at once and the whole one; None where the one at once is whole;
    ``refuse``, called with the error where the latest inputs have no answer.
    """

    def __init__(
        self,
        quick: Callable[[I], Awaitable[T]],
        whole: Callable[[I], Awaitable[T]] | None,
        *,
        show: Callable[[I, T], None],
        passing: Callable[[I, T], None],
        refuse: Callable[[Exception], None],
        behind: asyncio.Semaphore,
    ) -> None:
        self._quick, self._whole, self._refuse = quick, whole, refuse
        self._show, self._pass = show, passing
        self._behind = behind
        self._asked = 0
        self._wanted: tuple[int, I] | None = None
        self._running: asyncio.Task[None] | None = None
        self._later: asyncio.Task[None] | None = None

    def ask(self, inputs: I) -> asyncio.Task[None]:
        """Ask for the answers to new inputs. Returns task that ends when the latest inputs have their answer
        at once.
        """
        self.drop()
        self._wanted = (self._asked, inputs)
        if self._running is None or self._running.done():
            self._running = asyncio.create_task(self._run())
        return self._running

    def drop(self) -> None:
        """Want no answers any more to the inputs so far."""
        self._asked += 1
        self._wanted = None

    async def _run(self) -> None:
        while self._wanted is not None:
            (asked, inputs), self._wanted = self._wanted, None
            try:
                answer = await self._quick(inputs)
            except (InputError, ConvergenceError, LostError) as error:
                if asked == self._asked:
                    self._refuse(error)
                continue
            if asked == self._asked:
                if self._whole is not None:
                    self._later = asyncio.create_task(self._when_quiet(asked, inputs, self._whole))
                self._show(inputs, answer)
            elif self._waits():
                self._pass(inputs, answer)

    def _waits(self) -> bool:
        """Whether newer inputs wait for their answer; they do not where nothing is wanted any more."""
        return self._wanted is not None

    async def _when_quiet(self, asked: int, inputs: I, whole: Callable[[I], Awaitable[T]]) -> None:
        await asyncio.sleep(_QUIET)
        async with self._behind:
            if asked != self._asked:
                return
            try:
                answer = await whole(inputs)
            except (InputError, ConvergenceError, LostError) as error:
                if asked == self._asked:
                    self._refuse(error)
                return
        if asked == self._asked:
            self._show(inputs, answer)
