"""Answers that follow inputs: the latest wins, and a whole one comes when the inputs are quiet."""

import asyncio

import pytest

from ehlectric.app import latest_answer
from ehlectric.app.latest_answer import LatestAnswer
from ehlectric.errors import InputError, LostError


class Lock(asyncio.Semaphore):
    """Lock of whole answers that counts how often it was asked for."""

    def __init__(self):
        super().__init__(1)
        self.asked = 0

    async def acquire(self):
        self.asked += 1
        return await super().acquire()


async def until(condition):
    """Wait until a condition is met."""
    async with asyncio.timeout(60.0):
        while not condition():
            await asyncio.sleep(0.002)


class Page:
    """Page that records what it is asked to compute and to show; every quick answer waits for ``go``."""

    def __init__(self):
        self.asked, self.shown, self.passed, self.refused = [], [], [], []
        self.go = asyncio.Event()
        self.go.set()
        self.behind = Lock()
        self.latest_answer = LatestAnswer(
            self.quick,
            [self.whole],
            show=lambda inputs, answer: self.shown.append((inputs, answer)),
            passing=lambda inputs, _: self.passed.append(inputs),
            refuse=lambda error: self.refused.append(error.key),
            behind=self.behind,
        )

    async def quick(self, inputs):
        self.asked.append(inputs)
        await self.go.wait()
        if inputs < 0:
            raise InputError("load", got=inputs, takes="above 0")
        return "quick"

    async def whole(self, inputs):
        self.asked.append(("whole", inputs))
        return "whole"


@pytest.fixture(autouse=True)
def short(monkeypatch):
    monkeypatch.setattr(latest_answer, "_QUIET", 0.01)


def test_a_whole_answer_follows_the_quick_one():
    async def use():
        page = Page()
        await page.latest_answer.ask(1)
        assert page.shown == [(1, "quick")]
        await until(lambda: len(page.shown) > 1)
        return page

    page = asyncio.run(use())
    assert page.shown == [(1, "quick"), (1, "whole")]


def test_fuller_answers_follow_in_their_order():
    async def use():
        page = Page()

        async def fullest(_):
            return "fullest"

        page.latest_answer._steps = (page.quick, page.whole, fullest)
        await page.latest_answer.ask(1)
        await until(lambda: len(page.shown) > 2)
        return page

    assert [answer for _, answer in asyncio.run(use()).shown] == ["quick", "whole", "fullest"]


def test_a_prompt_answer_follows_before_the_inputs_are_quiet(monkeypatch):
    """The inputs are never quiet here."""
    monkeypatch.setattr(latest_answer, "_QUIET", 1e6)

    async def use():
        page = Page()
        steps = page.latest_answer._steps
        page.latest_answer._steps, page.latest_answer._prompt = (*steps, page.whole), 1
        await page.latest_answer.ask(1)
        await until(lambda: len(page.shown) > 1)
        page.latest_answer._later.cancel()
        return page

    page = asyncio.run(use())
    assert page.shown == [(1, "quick"), (1, "whole")]
    assert page.asked == [1, ("whole", 1)]


def test_answers_before_one_that_is_known_are_skipped():
    async def use():
        page = Page()
        page.latest_answer._known = lambda inputs: int(inputs == 1)
        await page.latest_answer.ask(1)
        await page.latest_answer.ask(2)
        await until(lambda: len(page.shown) > 2)
        return page

    assert asyncio.run(use()).shown == [(1, "whole"), (2, "quick"), (2, "whole")]


def test_inputs_in_between_are_never_computed():
    async def use():
        page = Page()
        page.go.clear()
        page.latest_answer.ask(1)
        await asyncio.sleep(0)
        for inputs in (2, 3, 4):
            task = page.latest_answer.ask(inputs)
        page.go.set()
        await task
        return page

    page = asyncio.run(use())
    assert page.asked == [1, 4]
    assert (page.passed, page.shown) == ([1], [(4, "quick")])


def test_a_whole_answer_to_older_inputs_is_not_computed():
    async def use():
        page = Page()
        async with page.behind:
            await page.latest_answer.ask(1)
            await until(lambda: page.behind.asked == 2)
            await page.latest_answer.ask(2)
        # The lock is given in the order in which it was asked for.
        await until(lambda: ("whole", 2) in page.asked)
        return page

    page = asyncio.run(use())
    assert page.asked == [1, 2, ("whole", 2)]


def test_an_error_of_the_latest_inputs_is_told_and_that_of_older_ones_is_not():
    async def use():
        page = Page()
        await page.latest_answer.ask(-1)
        page.go.clear()
        page.latest_answer.ask(-2)
        await asyncio.sleep(0)
        task = page.latest_answer.ask(3)
        page.go.set()
        await task
        return page

    page = asyncio.run(use())
    assert (page.refused, page.shown) == (["load"], [(3, "quick")])


def test_a_closed_page_wants_no_answer():
    async def use():
        page = Page()
        page.go.clear()
        task = page.latest_answer.ask(1)
        await asyncio.sleep(0)
        page.latest_answer.drop()
        page.go.set()
        await task
        await asyncio.gather(*(asyncio.all_tasks() - {asyncio.current_task()}))
        return page

    page = asyncio.run(use())
    assert (page.asked, page.shown, page.passed) == ([1], [], [])


def test_a_lost_fuller_answer_leaves_the_answer_before_it():
    async def use():
        shown, lacks, refused = [], [], []

        async def quick(inputs):
            return inputs

        async def lost(_):
            raise LostError("took too long")

        answers = LatestAnswer(
            quick,
            [quick, lost],
            show=lambda _, answer: shown.append(answer),
            passing=lambda *_: None,
            refuse=refused.append,
            behind=asyncio.Semaphore(1),
            lack=lambda error, number: lacks.append((str(error), number)),
        )
        await answers.ask(1, at_once=True)
        await until(lambda: lacks)
        return shown, lacks, refused

    assert asyncio.run(use()) == ([1, 1], [("took too long", 2)], [])
