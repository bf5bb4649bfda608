"""Solution that a page starts as a job: its button, its progress, and earlier answers."""

from __future__ import annotations

from collections.abc import Awaitable, Callable
from dataclasses import dataclass, fields
from pathlib import Path
from shutil import rmtree
from typing import Generic, TypeVar

from nicegui import ui

from ehlectric.app.calls import Call
from ehlectric.app.page_inputs import Inputs
from ehlectric.app.pages.page_parts import JobBox, button, page_texts, say
from ehlectric.app.session import Session
from ehlectric.app.view_models import PageAnswer
from ehlectric.app.work import Job

A = TypeVar("A", bound=PageAnswer)


@dataclass(frozen=True)
class SolvingTexts:
    """Texts of a solution."""

    solve: str
    # Buttons that change between its answer and the quick one.
    show_solved: str
    show_quick: str
    back: str  # button that goes back to the inputs of the last answer
    # Sentences on inputs that have changed since: next to an immediate answer, while a solution runs, and
    # when it is done.
    earlier: str
    running: str
    done: str
    # Sentence on a cancelled solution, and words before an error.
    cancelled: str
    failed: str
    # Addition to an error if only an immediate answer lacks what is asked for; empty without one.
    beyond: str = ""


# Names of the texts.
_TEXTS = tuple(field.name for field in fields(SolvingTexts))

# Solved answers that a tab keeps.
_KEPT = 20


@dataclass(frozen=True)
class _Solved(Generic[A]):
    """Answer of a solution: its inputs, and the folder with its files as the command writes them."""

    inputs: Inputs
    answer: A
    folder: Path


class Solving(Generic[A]):
    """Button that starts a solution, and the answers solved so far by their inputs; without a call, only how
    the immediate answer was computed.

    ``changed`` is called when another answer is to be shown, ``back`` with the inputs to go back to, and
    ``prepare`` before a solution, so that the inputs have what it needs.
    """

    def __init__(
        self,
        call: Call[A] | None,
        kind: str,
        session: Session,
        changed: Callable[[], object],
        back: Callable[[Inputs], None],
        prepare: Callable[[], Awaitable[None]],
    ) -> None:
        self._call = call
        given = page_texts("solving")[kind] if call is not None else dict.fromkeys(_TEXTS, "")
        self._texts = texts = SolvingTexts(**given)
        self._session, self._changed, self._back = session, changed, back
        self._prepare = prepare
        self._solved: dict[str, _Solved[A]] = {}
        self._quick = False
        self._running: tuple[Inputs, Path] | None = None
        self._runs = 0
        with ui.element("div").classes("solving"):
            self.how = ui.label().props('data-testid="how" aria-live="polite"')
            self._solve = button(texts.solve, "solve", self.start, "no-caps unelevated", primary=True)
            self._other = button("", "other-contacts", self._switch)
            self._return = button(texts.back, "back-to-solved", self._go_back)
        self._box = JobBox(session, self._done, lambda error: self._tell(str(error)))
        self._message = ui.label().classes("notice").props('role="status" data-testid="solve-message"')
        self._tell("")
        self.show(None)

    def answer(self) -> A | None:
        """Solved answer to the present inputs; None without one, or where the quick one is wanted."""
        solution = self._shown_solution()
        return None if solution is None else solution.answer

    def folder(self) -> Path | None:
        """Folder of the result whose answer is shown; None where it is the quick one."""
        solution = self._shown_solution()
        return None if solution is None else solution.folder

    def _shown_solution(self) -> _Solved[A] | None:
        return None if self._quick else self._solved.get(self._session.inputs.toml())

    def forget(self) -> None:
        """Forget what was wanted for earlier inputs."""
        self._quick = False
        self._message.set_visibility(False)

    def show(self, answer: A | None, error: Exception | None = None) -> None:
        """Show how an answer was computed, if there is one, and the buttons that suit it."""
        solved = self._session.inputs.toml() in self._solved
        self.how.text = "" if answer is None else answer.how
        offered = self._call is not None and (answer is None or answer.solvable)
        self._solve.set_visibility(offered and not solved and self._running is None)
        beyond = bool(self._texts.beyond) and self._texts.beyond in str(error)
        self._solve.set_enabled(answer is not None or beyond)
        self._other.set_visibility(solved)
        self._other.text = self._texts.show_solved if self._quick else self._texts.show_quick
        self._return.set_visibility(bool(self._solved) and not solved)
        if self._solved and not solved and answer is not None and answer.solvable:
            self.how.text += f" {self._texts.earlier}"
        if self._running is not None and self._running[0] != self._session.inputs:
            self.how.text += f" {self._texts.running}"
        self.how.set_visibility(bool(self.how.text))

    async def start(self) -> None:
        """Solve the present inputs."""
        assert self._call is not None
        await self._prepare()
        inputs = self._session.inputs
        # A folder for every run, so that the files of an answer stay as long as the answer.
        self._runs += 1
        folder = self._session.folder / f"solved-{self._runs}"
        if self._box.start(self._call, dict(inputs.table), self._session.folder, folder):
            self._running = (inputs, folder)
            self._tell("")
            self._solve.set_visibility(False)

    def _done(self, job: Job) -> None:
        running, self._running = self._running, None
        if running is not None:
            self._keep(job, *running)
        if job.state == "cancelled":
            self._tell(self._texts.cancelled)
        elif job.state == "failed":
            self._tell(f"{self._texts.failed}: {job.error}")
        self._changed()

    def _keep(self, job: Job, inputs: Inputs, folder: Path) -> None:
        """Keep the answer of a job with its files, and the last ones before it."""
        if job.state != "done":
            rmtree(folder, ignore_errors=True)
            return
        self._solved[inputs.toml()] = _Solved(inputs, job.result, folder)
        while len(self._solved) > _KEPT:
            rmtree(self._solved.pop(next(iter(self._solved))).folder, ignore_errors=True)
        if inputs != self._session.inputs:
            self._tell(self._texts.done)

    def _tell(self, text: str) -> None:
        say(self._message, text)

    def _switch(self) -> None:
        self._quick = not self._quick
        self._changed()

    def _go_back(self) -> None:
        *_, last = self._solved.values()
        self._back(last.inputs)
