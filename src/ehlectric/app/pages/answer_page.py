"""Pages with a quick answer that follows the inputs and a solution on request, and the parts of an answer."""

from __future__ import annotations

import asyncio
from collections.abc import Iterable, Sequence
from functools import partial
from html import escape
from typing import Any, ClassVar, Generic, Literal, TypeVar

from fastapi import Request
from nicegui import ui

from ehlectric.app.answers import Figure, Judged, Number, PageAnswer, PageWarning, Table, counts, unplaced
from ehlectric.app.calls import Call
from ehlectric.app.following import Following
from ehlectric.app.form_fields.field import Group
from ehlectric.app.page_inputs import Inputs
from ehlectric.app.pages.downloads import Downloads
from ehlectric.app.pages.form import Form
from ehlectric.app.pages.frame import PAGE_PATIENCE, Toolbar, framed, session_of, show_address
from ehlectric.app.pages.page_parts import Strip, button, figure, lines_html, mark, say, scrolling_table
from ehlectric.app.pages.solving import Solving
from ehlectric.app.session import Session
from ehlectric.app.work import Work
from ehlectric.errors import SEVERITY_WORDS, InputError

A = TypeVar("A", bound=PageAnswer)


class AnswerPage(Generic[A]):
    """Page of one tab."""

    path: ClassVar[str]
    title: ClassVar[str]
    start: ClassVar[Inputs]  # inputs with which the page begins
    kind: ClassVar[Literal["bearing", "drive"]]
    groups: ClassVar[Sequence[Group]]
    short: ClassVar[Sequence[str]]  # keys of the numbers of the short answer
    # Time for which the page waits for its first answer before it is sent without one [s].
    wait: ClassVar[float] = 0.0
    elsewhere: ClassVar[Sequence[str]] = ()  # keys that other parts of the page than its form show
    # Functions that compute the quick answer, fuller quick answers in their order, and the solution.
    quick: ClassVar[Call[Any]]
    later: ClassVar[Sequence[Call[Any]]] = ()
    solved: ClassVar[Call[Any]]

    view: AnswerView[A]

    def __init__(self, session: Session) -> None:
        self.session = session
        self._following: Following[Inputs, A] = Following(
            lambda inputs: self._answer(self.quick, inputs),
            [partial(self._answer, call) for call in self.later],
            show=self._show,
            passing=lambda _, answer: self._put(answer),
            refuse=self._refuse,
            behind=session.work.behind,
        )

    async def _answer(self, call: Call[A], inputs: Inputs) -> A:
        return await self.session.work.quick(call, dict(inputs.table), self.session.made_folder)

    @classmethod
    def add(cls, work: Work) -> None:
        """Add the page to the server."""

        @ui.page(cls.path, response_timeout=PAGE_PATIENCE)
        async def page(request: Request) -> None:
            inputs, error = Inputs.of_link(request.query_params.multi_items(), cls.start)
            page = cls(session_of(work, inputs))
            ui.context.client.on_delete(page.close)
            with framed(cls.title, cls.path):
                page.build(error)
            # The first answer comes with the page, unless the processes are still starting.
            await asyncio.wait([page.refresh()], timeout=cls.wait)

    def build(self, error: InputError | None) -> None:
        """Build the form and the places of the answer; with the error of a wrong address."""
        self._strip = Strip()
        Toolbar(self.session, self.path, self.shown_again)
        text = f"{error}. The example is shown in place of the inputs of the address."
        self._address = ui.label("" if error is None else text).classes("notice wrong")
        self._address.props('role="alert" data-testid="error-address"').set_visibility(error is not None)
        with ui.element("div").classes("columns"):
            with ui.element("div").classes("inputs"):
                self.form = Form(self.groups, self.session.inputs, self.change, elsewhere=self.elsewhere)
                self.build_boxes()
            with ui.element("section").classes("answer").props('aria-label="Answer"'):
                self._build_answer()

    def _build_answer(self) -> None:
        self.solving: Solving[A] = Solving(self.solved, self.kind, self.session, self._ask, self.go_to)
        self._notice = ui.label().classes("notice wrong").props('data-testid="notice"')
        self._notice.set_visibility(False)
        leads = button("Go to the field", "to-field", self.form.go_to_wrong, "no-caps dense")
        leads.bind_visibility_from(
            self._notice, "visible", lambda shown: shown and self.form.wrong is not None
        )
        self.build_view()
        self._downloads = Downloads(self.session, self.kind, self.solving.folder)

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

    def _answer_again(self) -> None:
        self.show_boxes()
        self._address.set_visibility(False)
        show_address(self.session.inputs, self.path)
        self.refresh()

    def refresh(self) -> asyncio.Future[None]:
        """Answer the present inputs; the future ends with the quick answer."""
        self.solving.forget()
        return self._ask()

    def close(self) -> None:
        """Want no further answers."""
        self._following.drop()

    def _ask(self) -> asyncio.Future[None]:
        """Show the solved answer where there is one, or ask for the quick one; the one before is dimmed."""
        solved = self.solving.answer()
        if solved is None:
            self._dim(dimmed=True)
            return self._following.ask(self.session.inputs)
        self._following.drop()
        self._show(self.session.inputs, solved)
        ended = asyncio.get_running_loop().create_future()
        ended.set_result(None)
        return ended

    def _show(self, _: Inputs, answer: A) -> None:
        self._put(answer)
        self._dim(dimmed=False)
        self.form.tell(None)
        self._notice.set_visibility(False)
        self.solving.show(answer)
        self._downloads.look()

    def _put(self, answer: A) -> None:
        self.view.show(answer)
        named = [one for one in answer.shown if one.key in self.short and one.known]
        texts = [f"{one.label} {one.with_unit}" for one in named]
        self._strip.show(answer.judged.level, answer.judged.lead, texts, bound=answer.judged.bound)

    def _dim(self, *, dimmed: bool) -> None:
        self.view.dim(dimmed=dimmed)
        self._strip.dim(dimmed=dimmed)

    def _refuse(self, error: Exception) -> None:
        self.form.tell(error)
        words = self.form.words(error)
        self.view.stop()
        self._strip.show("grey", "No answer", [words])
        self.solving.show(None, error)
        earlier = " The answer below is that of earlier inputs." if self.view.shown else ""
        say(self._notice, f"{words}.{earlier}")


class AnswerView(Generic[A]):
    """Place of an answer, whose texts and figures change in place so that zoom and focus stay."""

    rows_name: ClassVar[str]  # name of the table of all rows, for screen readers
    rows_title = "All rows, as the command prints them"

    def __init__(self) -> None:
        with ui.element("div").classes("answer-body").props('data-testid="answer"') as self.body:
            self.verdict = VerdictBox()
            self.build()
            self._lines = ui.html("", sanitize=False).props('data-testid="details"')
        self.body.set_visibility(False)

    def build(self) -> None:
        """Build what stands between the verdict and the table of all rows."""
        raise NotImplementedError

    def build_numbers(self, keys: Iterable[str]) -> None:
        """Build the places of the main numbers."""
        with ui.element("div").classes("numbers").props('data-testid="numbers" aria-live="polite"'):
            self.numbers = {key: NumberBox(key) for key in keys}

    def build_figures(self, names: Iterable[str], wide: Iterable[str] = ()) -> None:
        """Build the places of the figures, of which some have a whole row."""
        with ui.element("div").classes("figures"):
            self.figures = {name: FigureBox(name, wide=name in wide) for name in names}

    @property
    def shown(self) -> bool:
        """Whether there is an answer."""
        return bool(self.body.visible)

    def dim(self, *, dimmed: bool) -> None:
        """Dim the answer while it is that of earlier inputs."""
        mark(self.body, "stale", on=dimmed)
        self.body.props(f'aria-busy="{str(dimmed).lower()}"')

    def stop(self) -> None:
        """Show that what was to follow is not computed, as after a wrong input."""

    def show(self, answer: A) -> None:
        """Show an answer."""
        self.body.set_visibility(True)
        for key, box in self.numbers.items():
            box.show(answer.number(key))
        for name, place in self.figures.items():
            self.show_figure(name, place, answer)
        rows = lines_html(answer.lines, self.rows_name)
        self._lines.content = behind(self.rows_title, rows)

    def show_figure(self, name: str, place: FigureBox, answer: A) -> None:
        """Show a figure of an answer in its place."""
        place.show(answer.figures.get(name))


class VerdictBox:
    """Traffic light of a bearing with its sentences."""

    def __init__(self) -> None:
        self._box = ui.element("div").classes("verdict grey").props('data-testid="verdict" role="status"')
        with self._box:
            with ui.element("div").classes("lead"):
                ui.element("span").classes("sign").props('aria-hidden="true"')
                self._lead = ui.label()
                self._bound = ui.label().classes("at-most").props('data-testid="bound"')
            self._meaning, self._numbers = (ui.label().classes("sentence") for _ in range(2))
            self._reasons = ui.html("", sanitize=False)
            self._last: tuple[str, ...] = ()
            self._assumed = ui.label().classes("assumed").props('data-testid="assumptions"')

    def show(self, judged: Judged, *, whole: bool = True) -> None:
        """Show a verdict; the place of the sentences that follow with a ``whole`` answer is kept for them."""
        self._box.classes(replace=f"verdict {judged.level}").props(f'data-level="{judged.level}"')
        self._lead.text = judged.lead
        say(self._bound, judged.bound)
        self._meaning.text, self._numbers.text = judged.meaning, judged.numbers
        kept = () if whole else self._last[len(judged.reasons) :]
        self._reasons.content = _list(judged.reasons, kept)
        if whole:
            self._last = judged.reasons
        say(self._assumed, judged.assumptions)


class NumberBox:
    """Number with its name, its bound, a note, and the warnings that concern it."""

    def __init__(self, name: str) -> None:
        with ui.element("div").classes("number").props(f'data-testid="number-{name}"') as self._box:
            self._label = ui.label().classes("label")
            self._value = ui.label().classes("value").props('data-testid="value"')
            self._note = ui.label().classes("note")
            self._told = ui.html("", sanitize=False)

    def show(self, number: Number | None) -> None:
        """Show a number; None hides the one before."""
        self._box.set_visibility(number is not None)
        if number is None:
            return
        self._label.text, self._note.text = number.label, number.note
        self._value.text = number.with_unit
        self._value.classes(replace="value" if number.known else "value unknown")
        self._told.content = "".join(map(told, number.warnings))


def told(one: PageWarning) -> str:
    """Warning with its meaning in sight, and its text with numbers behind it."""
    word = SEVERITY_WORDS[one.severity]
    if not one.meaning:
        return f'<div class="told {one.severity}" data-code="{one.code}">{word}: {escape(one.text)}</div>'
    return (
        f'<details class="told {one.severity}" data-code="{one.code}">'
        f"<summary>{word}: {escape(one.meaning)}</summary>{escape(one.text)}</details>"
    )


class FigureBox:
    """Figure with its heading and the table of its numbers; a wide one has the whole row of a grid."""

    def __init__(self, name: str, *, wide: bool = False) -> None:
        with ui.element("div").classes("figure-box").props(f'data-testid="figure-{name}"') as self._box:
            with ui.element("h3"):
                self._title = ui.label()
            self._plot = figure({"data": [], "layout": {}}, name)
            self._caption = ui.label().classes("soft")
            self._table = ui.html("", sanitize=False)
        mark(self._box, "wide", on=wide)
        self._box.set_visibility(False)

    def dim(self, *, dimmed: bool) -> None:
        """Dim the figure while it is that of earlier inputs."""
        mark(self._box, "stale", on=dimmed)

    def show(self, shown: Figure | None) -> None:
        """Show a figure; None hides the one before."""
        self._box.set_visibility(shown is not None)
        if shown is not None:
            self._title.text, self._caption.text = shown.title, shown.caption
            self._plot.props["aria-label"] = shown.label
            self._plot.update_figure(dict(shown.plot))
            self._table.content = behind("Numbers of this figure", table_html(shown.table))


class WarningList:
    """List of the warnings that concern no single number, under the count of all."""

    def __init__(self) -> None:
        with ui.element("section").props('aria-label="Warnings" data-testid="warnings"'):
            with ui.element("h2") as self._heading:
                self._head = ui.label()
            self._list = ui.html("", sanitize=False)
            self._none = ui.label().classes("soft")

    def show(self, every: tuple[PageWarning, ...]) -> None:
        """Show the count of all warnings, and a list of those that concern no single number."""
        listed = unplaced(every)
        others = len(every) - len(listed)
        where = f" ({others} beside the numbers)" if others else ""
        self._head.text = f"This result has {counts(every)}{where}"
        self._list.content = "".join(map(told, listed))
        self._heading.set_visibility(bool(listed))
        stands = "Warnings: none." if not every else f"{counts(every)}, beside the numbers that they concern."
        self._none.text = stands[0].upper() + stands[1:]
        self._none.set_visibility(not listed)


def behind(summary: str, inner: str) -> str:
    """Part of a page that is closed at first."""
    return f"<details><summary>{escape(summary)}</summary>{inner}</details>"


def table_html(table: Table) -> str:
    """Table that scrolls within its own box."""
    rows = "".join(
        "<tr>" + "".join(f"<td>{escape(cell)}</td>" for cell in row) + "</tr>" for row in table.rows
    )
    caption = f"<caption>{escape(table.caption)}</caption>"
    return scrolling_table(table.caption, table.heads, rows, caption=caption)


def _list(texts: Iterable[str], kept: Iterable[str] = ()) -> str:
    """List of texts, with the place of some that nobody sees or hears."""
    items = "".join(f"<li>{escape(text)}</li>" for text in texts)
    items += "".join(f'<li class="kept" aria-hidden="true">{escape(text)}</li>' for text in kept)
    return f"<ul>{items}</ul>" if items else ""
