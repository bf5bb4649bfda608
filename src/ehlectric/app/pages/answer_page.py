"""Pages with an immediate answer that follows the inputs and a solution on request."""

from __future__ import annotations

import asyncio
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any, ClassVar, Generic, Literal, TypeVar

from fastapi import Request
from nicegui import ui

from ehlectric.app.calls import Call
from ehlectric.app.form_fields.field import Group
from ehlectric.app.form_fields.measured_fields import has_measured, measured_keys
from ehlectric.app.latest_answer import LatestAnswer
from ehlectric.app.page_inputs import Inputs
from ehlectric.app.pages.downloads import Downloads
from ehlectric.app.pages.form import Form, is_to_type
from ehlectric.app.pages.frame import PAGE_PATIENCE, Toolbar, framed, session_of, show_address
from ehlectric.app.pages.measured_box import CalibrationView, MeasuredBox
from ehlectric.app.pages.page_parts import Strip, button, follow, heading, lines_html, mark, page_texts, say
from ehlectric.app.pages.result_parts import FigureBox, NoteList, NumberBox, Panel, behind
from ehlectric.app.pages.solving import Solving
from ehlectric.app.processes import Returned
from ehlectric.app.session import Session
from ehlectric.app.view_models import PENDING, CalibrationAnswer, PageAnswer, notes_of
from ehlectric.app.work import Work, key_of
from ehlectric.errors import InputError, LostError
from ehlectric.readable import capital

A = TypeVar("A", bound=PageAnswer)


class AnswerPage(Generic[A]):
    """Page of one tab."""

    path: ClassVar[str]
    title: ClassVar[str]
    start: ClassVar[Inputs]  # inputs with which the page begins
    kind: ClassVar[Literal["bearing", "drive", "gear", "axle", "contact"]]
    groups: ClassVar[Sequence[Group]]
    # Keys of the numbers of the short answer, with the words before each; its name where there are none.
    short: ClassVar[Mapping[str, str]]
    # Time for which the page waits for its first answer before it is sent without one [s].
    wait: ClassVar[float] = 0.0
    elsewhere: ClassVar[Sequence[str]] = ()  # keys that other parts of the page than its form show
    first: ClassVar[int] = 2  # groups of the form that are opened on a narrow screen
    # Functions that compute the immediate answer, fuller immediate answers in their order, and the solution;
    # None for a page without one.
    quick: ClassVar[Call[Any]]
    later: ClassVar[Sequence[Call[Any]]] = ()
    # What each of them adds, for a page that shows which part of its answer is missing.
    parts: ClassVar[Sequence[str]] = ()
    prompt: ClassVar[int] = 0  # fuller answers that follow right after the immediate one
    solved: ClassVar[Call[Any] | None] = None

    view: AnswerView[A]

    def __init__(self, session: Session) -> None:
        self.session = session
        self._measured: MeasuredBox | None = None  # None for a page without measured values
        self._answer_shown: A | None = None
        self._updated: CalibrationAnswer | None = None  # calibration of the present inputs
        self._latest_answer: LatestAnswer[Inputs, A] = LatestAnswer(
            lambda inputs: self._answer(self.quick, inputs),
            [partial(self._answer, call) for call in self.later],
            show=self._show,
            passing=lambda _, answer: self._put(answer),
            refuse=self._refuse,
            behind=session.work.behind,
            prompt=self.prompt,
            known=self._known,
            lack=self._lack if self.parts else None,
        )

    async def _answer(self, call: Call[A], inputs: Inputs) -> A:
        return await self.session.work.quick(call, dict(inputs.table), self.session.made_folder)

    def _known(self, inputs: Inputs) -> int:
        """Number of the fullest answer that is computed already; 0 without one."""
        values, calls = (dict(inputs.table), self.session.made_folder), (self.quick, *self.later)
        return max((n for n, call in enumerate(calls) if self.session.work.has(call, *values)), default=0)

    @classmethod
    async def answer_start(cls, work: Work) -> dict[str, A]:
        """Compute the answers to the inputs with which the page begins; returns the fullest one by its key.

        Returns none if they cannot be computed.
        """
        values = (dict(cls.start.table), None)
        for call in (cls.quick, *cls.later):
            outcome = await work.answer(call, values)
        return {key_of(call, values): outcome.result} if isinstance(outcome, Returned) else {}

    @classmethod
    def add(cls, work: Work) -> None:
        """Add the page to the server."""

        @ui.page(cls.path, response_timeout=PAGE_PATIENCE)
        async def page(request: Request) -> None:
            inputs, error = Inputs.of_link(request.query_params.multi_items(), cls.start)
            page = cls(session_of(work, cls.starting(inputs)))
            ui.context.client.on_delete(page.close)
            with framed(cls.title, cls.path):
                page.build(error)
            # The first answer comes with the page, unless the processes are still starting.
            await asyncio.wait([page.refresh(at_once=True)], timeout=cls.wait)

    @classmethod
    def starting(cls, inputs: Inputs) -> Inputs:
        """Inputs with which the page begins, from the inputs of its address."""
        return inputs

    def build(self, error: InputError | None) -> None:
        """Build the form and the places of the answer; with the error of a wrong address."""
        self._strip = Strip()
        Toolbar(self.session, self.path, self.shown_again)
        text = f"{error}. The example is shown instead of the inputs of the address."
        self._address = ui.label("" if error is None else text).classes("notice wrong")
        self._address.props('role="alert" data-testid="error-address"').set_visibility(error is not None)
        with ui.element("div").classes("columns"):
            with ui.element("div").classes("inputs"):
                self.build_form()
                self.build_boxes()
                if has_measured(self.kind):
                    self._measured = MeasuredBox(self.session, self.kind, self._take, self._show_calibration)
            with ui.element("section").classes("answer").props('aria-label="Answer"'):
                self._build_answer()

    def _build_answer(self) -> None:
        self.solving: Solving[A] = Solving(
            self.solved, self.kind, self.session, self._ask, self.go_to, self.prepare
        )
        self._notice = ui.label().classes("notice wrong").props('data-testid="notice"')
        self._notice.set_visibility(False)
        leads = button("Go to the field", "to-field", lambda: self.form.go_to_wrong(), "no-caps dense")
        leads.bind_visibility_from(
            self._notice, "visible", lambda shown: shown and self.form.wrong is not None
        )
        self._again = button(
            "Compute again", "compute-again", lambda: self._ask(at_once=True), "no-caps dense"
        )
        self._again.set_visibility(False)
        self._calibration = CalibrationView(self.session, self.go_to)
        self._before = heading(page_texts("calibration")["before"], 2).props('data-testid="before"')
        self._before.set_visibility(False)
        self.build_view()
        self._downloads = Downloads(self.session, self.kind, self.folder)

    async def prepare(self) -> None:
        """Add inputs that a solution needs, before it begins."""

    def build_form(self) -> None:
        """Build the form."""
        inputs = self.session.inputs
        elsewhere = (*self.elsewhere, *measured_keys(self.kind, inputs))
        self.form = Form(self.groups, inputs, self.change, elsewhere=elsewhere, first=self.first)

    def folder(self) -> Path | None:
        """Folder with the files of the answer that is shown; None where they are still to be made."""
        return self.solving.folder()

    def build_boxes(self) -> None:
        """Build further parts of the inputs below the form."""

    def build_view(self) -> None:
        """Build the place of the answer."""
        raise NotImplementedError

    def show_boxes(self) -> None:
        """Show the present inputs in the parts below the form."""

    async def change(self, key: str, value: Any) -> None:
        """Apply a changed input, and answer."""
        self.session.history.push(self.session.inputs.changed({key: value}))
        self._answer_again()

    def go_to(self, inputs: Inputs) -> None:
        """Make other inputs the present ones, as after a step back."""
        self.session.history.push(inputs)
        self.shown_again()

    def shown_again(self) -> None:
        """Show the present inputs in the form and in the address, and answer them."""
        self.form.set(self.session.inputs)
        self._answer_again()

    async def _take(self, changes: dict[str, Any]) -> None:
        """Take over changed inputs through the present form, which a page may build again."""
        await self.form.take(changes)

    def _show_calibration(self, answer: CalibrationAnswer | None, state: str) -> None:
        self._calibration.show(answer, state)
        self._before.set_visibility(answer is not None)
        self._updated = answer if answer is not None and answer.explained and not state else None
        if self._answer_shown is not None:
            self._show_strip(self._answer_shown)

    def _answer_again(self) -> None:
        self.show_boxes()
        if self._measured is not None:
            self._measured.refresh()
        self._address.set_visibility(False)
        show_address(self.session.inputs, self.path)
        self.refresh()

    def refresh(self, *, at_once: bool = False) -> asyncio.Future[None]:
        """Answer the present inputs; the future ends with the immediate answer."""
        self.solving.forget()
        return self._ask(at_once=at_once)

    def close(self) -> None:
        """Want no further answers."""
        self._latest_answer.drop()
        if self._measured is not None:
            self._measured.close()

    def _ask(self, *, at_once: bool = False) -> asyncio.Future[None]:
        """Show the solved answer where there is one, or ask for the quick one; the one before is dimmed."""
        solved = self.solving.answer()
        if solved is None:
            self._dim(dimmed=True)
            return self._latest_answer.ask(self.session.inputs, at_once=at_once)
        self._latest_answer.drop()
        self._show(self.session.inputs, solved)
        ended = asyncio.get_running_loop().create_future()
        ended.set_result(None)
        return ended

    def _show(self, _: Inputs, answer: A) -> None:
        self._put(answer)
        self._dim(dimmed=False)
        self.form.tell(None)
        self._notice.set_visibility(False)
        self._again.set_visibility(False)
        self.solving.show(answer)
        self._downloads.look()

    def _put(self, answer: A) -> None:
        named = self.session.named
        warnings = tuple(replace(warning, text=named(warning.text)) for warning in answer.warnings)
        answer = replace(answer, warnings=warnings)
        self.view.show(answer)
        self._answer_shown = answer
        self._show_strip(answer)

    def _show_strip(self, answer: A) -> None:
        """Show the short answer: after the measurement if the inputs are calibrated."""
        texts = page_texts("calibration")
        if self._updated is not None:
            verdict, chance = self._updated.verdict, self._updated.chance
            state = texts["after"]
            self._strip.show(verdict.level, verdict.heading, [chance], state=state)
            return
        state = texts["before"] if self._before.visible else ""
        named = [number for number in answer.shown if number.key in self.short and number.known]
        numbers = [f"{self.short[number.key] or number.name} {number.with_unit}" for number in named]
        verdict = answer.verdict
        self._strip.show(verdict.level, verdict.heading, numbers, bound=verdict.bound_note, state=state)

    def _dim(self, *, dimmed: bool) -> None:
        self.view.dim(dimmed=dimmed)
        self._strip.dim(dimmed=dimmed)

    def _refuse(self, error: Exception) -> None:
        error = self.session.named_error(error)
        self.form.tell(error)
        words = self.form.words(error)
        self.view.stop()
        self._answer_shown = None
        self._strip.show("grey", "No answer", [words])
        self.solving.show(None, error)
        earlier = " The answer below belongs to earlier inputs." if self.view.shown else ""
        mark(self._notice, "wrong", on=not is_to_type(error))
        say(self._notice, f"{capital(words)}.{earlier}")
        self._again.set_visibility(isinstance(error, LostError))

    def _lack(self, error: LostError, number: int) -> None:
        """Show which part of the answer is missing; the other parts belong to the present inputs."""
        self.view.lack()
        mark(self._notice, "wrong", on=True)
        part = self.parts[number - 1]
        say(self._notice, f"{part} not computed: {error}. The values below belong to the present inputs.")
        self._again.set_visibility(True)


_AT_POINT = "Numbers belong to the operating point of the form, unless they name the duty cycle."


class AnswerView(Generic[A]):
    """Place of an answer, whose texts and figures change in place so that zoom and focus stay."""

    rows_name: ClassVar[str]  # name of the table of all rows, for screen readers
    rows_title = "All rows, as the command prints them"
    keys: ClassVar[Iterable[str]]  # keys of the main numbers, in their order
    # Names of figures that may stand next to the verdict, and why its place is empty at first.
    leading: ClassVar[Sequence[str]]
    waits: ClassVar[str] = ""

    def __init__(self) -> None:
        self.shown = False  # whether there is an answer
        with ui.element("div").classes("answer-body").props('data-testid="answer"') as self.body:
            self._point = ui.label().classes("notice").props('data-testid="operating-point"')
            self.panel = Panel(self.leading, self.waits)
            self.build_below_panel()
            with ui.element("div").classes("answer-body") as self._rest:
                heading("Numbers", 2)
                table = ui.element("table").classes("quiet").props('data-testid="numbers"')
                with table.props('aria-label="Numbers"'), ui.element("tbody"):
                    self.numbers = {key: NumberBox("tr", "th", "td") for key in self.keys}
                self._notes = NoteList()
                self.build()
                self._lines = ui.html("", sanitize=False).props('data-testid="details"')
        self._rest.set_visibility(False)
        self.place(cycle=False)
        self.dim(dimmed=True)

    def place(self, *, cycle: bool) -> None:
        """State what belongs to the operating point if there is a duty ``cycle``."""
        say(self._point, _AT_POINT if cycle else "")

    def build_below_panel(self) -> None:
        """Build what stands between the panel and the numbers."""

    def build(self) -> None:
        """Build what stands between the notes and the table of all rows."""
        raise NotImplementedError

    def build_figures(self, names: Iterable[str], wide: Iterable[str] = ()) -> None:
        """Build the places of the figures, of which some have a whole row."""
        with ui.element("section").props('aria-label="Figures"') as self._drawn:
            heading("Figures", 2)
            with ui.element("div").classes("figures"):
                self.figures = {name: FigureBox(name, wide=name in wide) for name in names}

    def dim(self, *, dimmed: bool) -> None:
        """Dim the answer while it belongs to earlier inputs."""
        follow(self.body, on=dimmed and self.shown)
        mark(self.body, "stopped", on=False)
        self.body.props(f'aria-busy="{str(dimmed).lower()}"')

    def stop(self) -> None:
        """Show that what was to follow is not computed, as after a wrong input."""
        self.body.set_visibility(self.shown)
        mark(self.body, "stopped", on=True)
        self.lack()

    def lack(self) -> None:
        """Show that what was to follow is not computed; the rest of the answer belongs to its inputs."""
        self.panel.wait("This figure is not computed.")

    def show(self, answer: A) -> None:
        """Show an answer."""
        self.shown = True
        self.tell(answer)
        for name, place in self.figures.items():
            self.show_figure(name, place, answer)
        self._drawn.set_visibility(
            not self.figures.keys().isdisjoint(answer.figures.keys() - {answer.deciding.figure})
        )
        rows = lines_html(answer.lines, self.rows_name)
        self._lines.content = behind(self.rows_title, rows)
        for part in (self.body, self._rest):
            part.set_visibility(True)

    def tell(self, answer: A) -> None:
        """Show the verdict, the numbers and their notes."""
        deciding = answer.deciding
        notes = notes_of(answer.shown, answer.warnings, deciding.said)
        self.panel.verdict.show(answer.verdict, answer.meaning, deciding.said, whole=answer.whole)
        self.panel.tell(deciding, answer.number(deciding.key), notes)
        for key, box in self.numbers.items():
            box.show(None if key == deciding.key else answer.number(key), notes)
        self._notes.show(notes)

    def show_figure(self, name: str, place: FigureBox, answer: A) -> None:
        """Show a figure of an answer at its position, unless it is shown next to the verdict."""
        place.show(None if name == answer.deciding.figure else answer.figures.get(name))


class ProbableView(AnswerView[A]):
    """Place of an answer whose probability of breakdown follows with the whole answer."""

    without: ClassVar[str]  # code of the statement that the probability is not computed

    def __init__(self) -> None:
        self._pending: A | None = None  # shown answer whose probability follows
        super().__init__()

    def lack(self) -> None:
        """Show that the probability is not computed."""
        super().lack()
        self._end_pending()

    def _end_pending(self) -> None:
        """Show the pending answer without the words that its probability follows."""
        if self._pending is not None:
            facts = tuple(fact for fact in self._pending.deciding.facts if fact[1] != PENDING)
            said = tuple(code for code in self._pending.deciding.said if code != self.without)
            deciding = replace(self._pending.deciding, facts=facts, said=said)
            self.tell(replace(self._pending, whole=True, deciding=deciding))
            self.panel.dim(dimmed=False)
            self._pending = None

    def show(self, answer: A) -> None:
        """Show an answer."""
        super().show(answer)
        self.body.props["data-whole"] = str(answer.whole).lower()
        self.body.update()
        self.panel.dim(dimmed=not answer.whole)
        self._pending = None if answer.whole else answer
