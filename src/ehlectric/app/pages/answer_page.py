"""Pages with a quick answer that follows the inputs and a solution on request, and the parts of an answer."""

from __future__ import annotations

import asyncio
import math
from collections.abc import Iterable, Sequence
from functools import partial
from html import escape
from typing import Any, ClassVar, Generic, Literal, TypeVar

from fastapi import Request
from nicegui import ui

from ehlectric.app.answers import (
    Deciding,
    Figure,
    Gauge,
    Judged,
    Note,
    Number,
    PageAnswer,
    Table,
    counts,
    notes_of,
)
from ehlectric.app.calls import Call
from ehlectric.app.following import Following
from ehlectric.app.form_fields.field import Group
from ehlectric.app.page_inputs import Inputs
from ehlectric.app.pages.downloads import Downloads
from ehlectric.app.pages.form import Form
from ehlectric.app.pages.frame import PAGE_PATIENCE, Toolbar, framed, session_of, show_address
from ehlectric.app.pages.page_parts import (
    Strip,
    button,
    figure,
    heading,
    lines_html,
    mark,
    say,
    scrolling_table,
)
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
        texts = [f"{one.name} {one.with_unit}" for one in named]
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
    keys: ClassVar[Iterable[str]]  # keys of the main numbers, in their order
    # Names of figures that may stand beside the verdict, and why its place is empty at first.
    leading: ClassVar[Sequence[str]]
    waits: ClassVar[str] = ""

    def __init__(self) -> None:
        self.shown = False  # whether there is an answer
        with ui.element("div").classes("answer-body").props('data-testid="answer"') as self.body:
            self.panel = Panel(self.leading, self.waits)
            with ui.element("div").classes("answer-body") as self._rest:
                heading("Numbers", 2)
                table = ui.element("table").classes("quiet").props('data-testid="numbers" aria-live="polite"')
                with table.props('aria-label="Numbers"'), ui.element("tbody"):
                    self.numbers = {key: NumberBox("tr", "th", "td") for key in self.keys}
                self._notes = NoteList()
                self.build()
                self._lines = ui.html("", sanitize=False).props('data-testid="details"')
        self._rest.set_visibility(False)
        self.dim(dimmed=True)

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
        """Dim the answer while it is that of earlier inputs."""
        mark(self.body, "stale", on=dimmed and self.shown)
        self.body.props(f'aria-busy="{str(dimmed).lower()}"')

    def stop(self) -> None:
        """Show that what was to follow is not computed, as after a wrong input."""
        self.body.set_visibility(self.shown)
        self.panel.wait("This figure is not computed.")

    def show(self, answer: A) -> None:
        """Show an answer."""
        self.shown = True
        self.tell(answer)
        for name, place in self.figures.items():
            self.show_figure(name, place, answer)
        self._drawn.set_visibility(bool(answer.figures.keys() - {answer.deciding.figure}))
        rows = lines_html(answer.lines, self.rows_name)
        self._lines.content = behind(self.rows_title, rows)
        for part in (self.body, self._rest):
            part.set_visibility(True)

    def tell(self, answer: A) -> None:
        """Show the verdict, the numbers and their notes."""
        deciding = answer.deciding
        notes = notes_of(answer.shown, answer.warnings, deciding.said)
        self.panel.verdict.show(answer.judged, deciding.said, whole=answer.whole)
        self.panel.tell(deciding, answer.number(deciding.key), notes)
        for key, box in self.numbers.items():
            box.show(None if key == deciding.key else answer.number(key), notes)
        self._notes.show(notes)

    def show_figure(self, name: str, place: FigureBox, answer: A) -> None:
        """Show a figure of an answer in its place, unless it stands beside the verdict."""
        place.show(None if name == answer.deciding.figure else answer.figures.get(name))


class Panel:
    """Verdict, the number that decides, and beside them the figure that shows why."""

    def __init__(self, leading: Iterable[str], waits: str) -> None:
        with ui.element("div").classes("panel").props('data-testid="panel"') as self._box:
            with ui.element("div").classes("panel-words"):
                self.verdict = VerdictBox()
                with ui.element("div").classes("deciding").props('aria-live="polite"') as self._deciding:
                    self._number = NumberBox("div", "div", "div")
                    self._gauge, self._facts = (ui.html("", sanitize=False) for _ in range(2))
                self.verdict.build_sentences()
            with ui.element("div").classes("panel-figure kept" if waits else "panel-figure"):
                self._waits = ui.label().classes("soft waits").props('data-testid="figure-waits"')
                self.figures = {name: FigureBox(name) for name in leading}
        self._deciding.set_visibility(False)
        say(self._waits, waits)
        mark(self._box, "alone", on=not waits)

    def wait(self, text: str) -> None:
        """Say why the place of the figure is still empty."""
        if self._waits.visible:
            self._waits.text = text

    def tell(self, deciding: Deciding, number: Number | None, notes: Iterable[Note]) -> None:
        """Show the number that decides, with its interval and its gauge."""
        self._deciding.set_visibility(number is not None)
        self._number.show(number, notes)
        self._gauge.content = "" if deciding.gauge is None else gauge_svg(deciding.gauge)
        self._facts.content = facts_html(deciding.facts)

    def lead(self, name: str, shown: Figure | None) -> None:
        """Show the figure that decides, of a name; without one the verdict has the whole width."""
        say(self._waits, "")
        for other, box in self.figures.items():
            box.show(shown if other == name else None)
        mark(self._box, "alone", on=shown is None)


# Ends of the scale of a gauge, as powers of ten, and its ticks.
_DECADES, _TICKS = 1.0, (0.1, 0.3, 1, 3, 10)


def gauge_svg(gauge: Gauge) -> str:
    """Gauge as a graphic in SVG.

    Examples
    --------
    >>> 'x1="50.0%"' in gauge_svg(Gauge("margin 1", 1.0, (0.5, 2.0)))
    True
    """

    def at(value: float) -> float:
        """Place on the scale [%], at its ends for values beyond."""
        power = -_DECADES if value <= 0.0 else min(_DECADES, max(-_DECADES, math.log10(value)))
        return 50.0 * (1.0 + power / _DECADES)

    parts = [
        '<rect class="below" x="0" y="20" width="50%" height="8"/>',
        '<rect class="above" x="50%" y="20" width="50%" height="8"/>',
        '<text x="49%" y="13" text-anchor="end">breakdown</text><text x="51%" y="13">no breakdown</text>',
    ]
    if gauge.interval is not None:
        low, high = map(at, gauge.interval)
        wide = max(high - low, 0.5)
        parts.append(f'<rect class="bar" x="{low:.1f}%" y="18" width="{wide:.1f}%" height="12" rx="6"/>')
    for tick in _TICKS:
        anchor = {_TICKS[0]: "start", _TICKS[-1]: "end"}.get(tick, "middle")
        parts.append(f'<text x="{at(tick):.1f}%" y="46" text-anchor="{anchor}">{tick:g}</text>')
    parts.append(f'<line class="limit" x1="{at(1.0):.1f}%" x2="{at(1.0):.1f}%" y1="3" y2="34"/>')
    parts.append(f'<circle class="at" cx="{at(gauge.value):.1f}%" cy="24" r="6"/>')
    label = escape(gauge.label)
    return (
        f'<svg class="gauge" role="img" aria-label="{label}" width="100%" height="50">{"".join(parts)}</svg>'
    )


def facts_html(facts: Iterable[tuple[str, str]]) -> str:
    """Names and values as a list of descriptions; empty without any."""
    items = "".join(f"<dt>{escape(name)}</dt><dd>{escape(value)}</dd>" for name, value in facts)
    return f'<dl class="facts">{items}</dl>' if items else ""


class VerdictBox:
    """Traffic light of a bearing, and below the number that decides its sentences."""

    def __init__(self) -> None:
        self._box = ui.element("div").classes("verdict grey").props('data-testid="verdict" role="status"')
        with self._box:
            with ui.element("h2").classes("lead"):
                ui.element("span").classes("sign").props('aria-hidden="true"')
                self._lead = ui.label("Computing …")
                self._bound = ui.label().classes("at-most").props('data-testid="bound"')
            self._meaning = ui.label()
        say(self._bound, "")
        self._last: tuple[str, ...] = ()

    def build_sentences(self) -> None:
        """Build the place of the sentences."""
        with ui.element("div").classes("sentences").props('aria-live="polite"'):
            self._assumed = ui.label().classes("assumed").props('data-testid="assumptions"')
            self._reasons = ui.html("", sanitize=False)
        say(self._assumed, "")

    def show(self, judged: Judged, said: tuple[str, ...] = (), *, whole: bool = True) -> None:
        """Show a verdict without the sentences that begin as those ``said`` elsewhere.

        The place of the sentences that follow with a ``whole`` answer is kept for them.
        """
        self._box.classes(replace=f"verdict {judged.level}").props(f'data-level="{judged.level}"')
        self._lead.text, self._meaning.text = judged.lead, judged.meaning
        say(self._bound, judged.bound)
        sentences = filter(None, (judged.numbers, *judged.reasons))
        reasons = tuple(one for one in sentences if not one.startswith(said))
        kept = () if whole else self._last[len(reasons) :]
        self._reasons.content = _list(reasons, kept)
        if whole:
            self._last = reasons
        say(self._assumed, judged.assumptions)


class NumberBox:
    """Place of a number: its name, the letters of its notes, its value with its bound, and what it says."""

    def __init__(self, outer: str, head: str, cell: str) -> None:
        with ui.element(outer).classes("quantity") as self._box:
            with ui.element(head).classes("name").props('scope="row"' if head == "th" else ""):
                self._label = ui.label()
                self._letters = ui.html("", sanitize=False, tag="sup")
            with ui.element(cell):
                self._value = ui.label().classes("value").props('data-testid="value"')
                self._note = ui.label().classes("soft")
        self.show(None)

    def show(self, number: Number | None, notes: Iterable[Note] = ()) -> None:
        """Show a number; None hides the one before."""
        self._box.set_visibility(number is not None)
        if number is None:
            self._box.props(remove="data-testid")
            return
        self._box.props(f'data-testid="number-{number.key}"')
        self._label.text, self._note.text = number.label, number.note
        self._value.text = number.with_unit
        self._value.classes(replace="value" if number.known else "value unknown")
        codes = {one.code for one in number.warnings}
        letters = ", ".join(one.letter for one in notes if one.letter and one.warning.code in codes)
        self._letters.content = f'<span class="unseen">note </span>{letters}' if letters else ""


def told(note: Note) -> str:
    """Warning with its meaning and the numbers that it concerns in sight, and its text behind it."""
    one = note.warning
    letter = f"<sup>{note.letter}</sup> " if note.letter else ""
    names = f"{escape(', '.join(note.names))}: " if note.names else ""
    head = f"{letter}<b>{SEVERITY_WORDS[one.severity]}</b> {names}"
    if not one.meaning:
        return f'<div class="told {one.severity}" data-code="{one.code}">{head}{escape(one.text)}</div>'
    return (
        f'<details class="told {one.severity}" data-code="{one.code}">'
        f"<summary>{head}{escape(one.meaning)}</summary>{escape(one.text)}</details>"
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


class NoteList:
    """List of all notes and warnings, the severe ones first."""

    def __init__(self) -> None:
        with ui.element("section").props('aria-label="Notes" data-testid="warnings"') as self._box:
            with ui.element("h2"):
                self._head = ui.label()
            self._list = ui.html("", sanitize=False)
        self._box.set_visibility(False)

    def show(self, notes: Sequence[Note]) -> None:
        """Show notes under their count."""
        self._box.set_visibility(True)
        count = counts(one.warning for one in notes)
        self._head.text = f"{count[:1].upper()}{count[1:]}"
        self._list.content = "".join(map(told, notes))


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
