"""Page of a bearing, which says whether it sparks, and what changes that."""

from __future__ import annotations

import asyncio
from collections.abc import Iterable
from dataclasses import replace
from html import escape
from typing import Any

from fastapi import Request
from nicegui import ui

from ehlectric.app.answers import (
    FOLLOWS,
    PENDING,
    RANGE_FOLLOWS,
    BearingAnswer,
    Difference,
    Figure,
    Judged,
    Number,
    Table,
)
from ehlectric.app.calls import BEARING_QUICK, BEARING_SOLVED, BEARING_WHOLE
from ehlectric.app.fields import BEARING_GROUPS
from ehlectric.app.following import Following
from ehlectric.app.page_inputs import Inputs
from ehlectric.app.page_warnings import Told, counts, elsewhere
from ehlectric.app.pages import page_parts
from ehlectric.app.pages.downloads import Downloads
from ehlectric.app.pages.form import Form
from ehlectric.app.pages.frame import BEARING, PAGE_PATIENCE, Toolbar, framed, session_of, show_address
from ehlectric.app.pages.page_parts import Strip, lines_html
from ehlectric.app.pages.solving import Solving, Words
from ehlectric.app.session import Session
from ehlectric.app.work import Work
from ehlectric.cases.defaults import HOW
from ehlectric.errors import SEVERITY_WORDS, InputError
from ehlectric.quantities.sheets import BEARING_CARDS


class VerdictBox:
    """Traffic light of a bearing with its sentences."""

    def __init__(self) -> None:
        with (
            ui.element("div")
            .classes("verdict grey")
            .props('data-testid="verdict" role="status"') as self._box
        ):
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
        self._lead.text, self._bound.text = judged.lead, judged.bound
        self._bound.set_visibility(bool(judged.bound))
        self._meaning.text, self._numbers.text = judged.meaning, judged.numbers
        kept = () if whole else self._last[len(judged.reasons) :]
        self._reasons.content = _list(judged.reasons, kept)
        if whole:
            self._last = judged.reasons
        self._assumed.text = judged.assumptions
        self._assumed.set_visibility(bool(judged.assumptions))


class NumberBox:
    """Number with its name, its bound, a note, and the warnings that concern it."""

    def __init__(self, key: str) -> None:
        with ui.element("div").classes("number").props(f'data-testid="number-{key}"') as self._box:
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
        self._value.text = " ".join(filter(None, [number.bound, number.text, number.unit]))
        self._value.classes(replace="value" if number.known else "value unknown")
        self._told.content = "".join(map(_told, number.told))


def _told(one: Told) -> str:
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
        look = "figure-box wide" if wide else "figure-box"
        with ui.element("div").classes(look).props(f'data-testid="figure-{name}"') as self._box:
            with ui.element("h3"):
                self._title = ui.label()
            self._plot = page_parts.figure({"data": [], "layout": {}}, name)
            self._caption = ui.label().classes("soft")
            self._table = ui.html("", sanitize=False)
        self._box.set_visibility(False)

    def dim(self, *, dimmed: bool) -> None:
        """Dim the figure while it is that of earlier inputs."""
        self._box.classes(add="stale" if dimmed else "", remove="" if dimmed else "stale")

    def show(self, figure: Figure | None) -> None:
        """Show a figure; None hides the one before."""
        self._box.set_visibility(figure is not None)
        if figure is not None:
            self._title.text = figure.title
            self._plot.props["aria-label"] = figure.label
            self._plot.update_figure(dict(figure.plot))
            self._caption.text = figure.caption
            self._table.content = behind("Numbers of this figure", table_html(figure.table))


class WarningList:
    """List of the warnings that concern no single number, under the count of all."""

    def __init__(self) -> None:
        with ui.element("section").props('aria-label="Warnings" data-testid="warnings"'):
            with ui.element("h2") as self._heading:
                self._head = ui.label()
            self._list = ui.html("", sanitize=False)
            self._none = ui.label().classes("soft")

    def show(self, every: tuple[Told, ...], listed: tuple[Told, ...]) -> None:
        """Show the count of all warnings, and a list of some of them."""
        beside = len(every) - len(listed)
        where = f" ({beside} beside the numbers)" if beside else ""
        self._head.text = f"This result has {counts(every)}{where}"
        self._list.content = "".join(map(_told, listed))
        self._heading.set_visibility(bool(listed))
        stands = "Warnings: none." if not every else f"{counts(every)}, beside the numbers that they concern."
        self._none.text = stands[0].upper() + stands[1:]
        self._none.set_visibility(not listed)


def behind(summary: str, inner: str) -> str:
    """Part of a page that is closed at first."""
    return f"<details><summary>{escape(summary)}</summary>{inner}</details>"


def table_html(table: Table) -> str:
    """Table that scrolls within its own box."""
    heads = "".join(f'<th scope="col">{escape(head)}</th>' for head in table.heads)
    rows = "".join(
        "<tr>" + "".join(f"<td>{escape(cell)}</td>" for cell in row) + "</tr>" for row in table.rows
    )
    return (
        f'<div class="scroll" tabindex="0" role="region" aria-label="{escape(table.caption)}"><table>'
        f"<caption>{escape(table.caption)}</caption><thead><tr>{heads}</tr></thead>"
        f"<tbody>{rows}</tbody></table></div>"
    )


def effects_html(effects: Table | None) -> str:
    """Table of the inputs that change the margin, under its heading; empty without any."""
    return "" if effects is None else f"<h2>What changes the margin</h2>{table_html(effects)}"


def differences_html(differences: Iterable[Difference]) -> str:
    """Table of the differences of a solved result from the quick one; empty without any."""
    rows = tuple(differences)
    if not rows:
        return ""
    way = rows[0].way
    heads = ("", HOW[way], "solved", "solved differs by")
    cells = tuple((one.name, one.quick, one.solved, one.change) for one in rows)
    return table_html(Table(f"Solved contacts compared with the {way}", heads, cells))


def _list(texts: Iterable[str], kept: Iterable[str] = ()) -> str:
    """List of texts, with the place of some that nobody sees or hears."""
    items = "".join(f"<li>{escape(text)}</li>" for text in texts)
    items += "".join(f'<li class="kept" aria-hidden="true">{escape(text)}</li>' for text in kept)
    return f"<ul>{items}</ul>" if items else ""


_AT_ONCE, _OVER_SPEED = ("load", "film"), ("breakdown", "capacitance")


class AnswerView:
    """Place of an answer, whose texts and figures change in place so that zoom and focus stay."""

    def __init__(self) -> None:
        with ui.element("div").classes("answer-body").props('data-testid="answer"') as self._body:
            self._verdict = VerdictBox()
            self._changes = ui.html("", sanitize=False).props('data-testid="differences"')
            with ui.element("div").classes("numbers").props('data-testid="numbers" aria-live="polite"'):
                self._numbers = {key: NumberBox(key) for key in BEARING_CARDS}
            self._effects = ui.html("", sanitize=False).classes("effects").props('data-testid="effects"')
            self._warnings = WarningList()
            self._none = ui.label().classes("notice").props('data-testid="no-figures"')
            with ui.element("div").classes("figures"):
                self._figures = {name: FigureBox(name) for name in (*_AT_ONCE, *_OVER_SPEED)}
            self._lines = ui.html("", sanitize=False).props('data-testid="details"')
        self._body.set_visibility(False)
        self._pending: BearingAnswer | None = None

    @property
    def shown(self) -> bool:
        """Whether there is an answer."""
        return bool(self._body.visible)

    def dim(self, *, dimmed: bool) -> None:
        """Dim the answer while it is that of earlier inputs."""
        self._body.classes(add="stale" if dimmed else "", remove="" if dimmed else "stale")
        self._body.props(f'aria-busy="{str(dimmed).lower()}"')

    def stop(self) -> None:
        """Say that what was to follow is not computed, as after a wrong input."""
        if self._pending is None:
            return
        for one in self._pending.shown:
            if one.text == PENDING:
                self._numbers[one.key].show(replace(one, text="none", note="not computed"))
            elif one.note.startswith(RANGE_FOLLOWS):
                self._numbers[one.key].show(replace(one, note=one.note.removeprefix(f"{RANGE_FOLLOWS}; ")))
        judged = self._pending.judged
        self._verdict.show(replace(judged, reasons=tuple(one for one in judged.reasons if one != FOLLOWS)))
        self._pending = None

    def _show_effects(self, answer: BearingAnswer) -> None:
        """Show the effects of the inputs; those of earlier inputs stay dimmed until new ones are there."""
        if answer.whole or not answer.figures:
            self._effects.content = effects_html(answer.effects)
        self._effects.set_visibility(bool(self._effects.content))
        self._effects.classes(add="" if answer.whole else "stale", remove="stale" if answer.whole else "")

    def show(self, answer: BearingAnswer) -> None:
        """Show an answer; the figures over the speed stay dimmed until those of a whole answer are there."""
        self._body.set_visibility(True)
        self._body.props(f'data-contacts="{answer.contacts}" data-whole="{str(answer.whole).lower()}"')
        self._verdict.show(answer.judged, whole=answer.whole)
        self._pending = None if answer.whole else answer
        self._changes.content = differences_html(answer.differences)
        self._changes.set_visibility(bool(answer.differences))
        for key, box in self._numbers.items():
            box.show(answer.number(key))
        self._show_effects(answer)
        self._warnings.show(answer.warnings, elsewhere(answer.warnings))
        self._none.set_visibility(not answer.figures)
        self._none.text = "" if answer.figures else "Not converged: the figures would show no solution."
        for name in _AT_ONCE:
            self._figures[name].show(answer.figures.get(name))
        for name in _OVER_SPEED:
            figure = self._figures[name]
            if answer.whole or not answer.figures:
                figure.show(answer.figures.get(name))
            figure.dim(dimmed=not answer.whole)
        self._lines.content = behind(
            "All rows, as the command prints them", lines_html(answer.lines, "Numbers of the bearing")
        )


# Numbers of the short answer.
_SHORT = ("bearing.capacitance", "bearing.margin")

_WORDS = Words(
    solve="Solve the contacts",
    show_solved="Show the solved contacts",
    show_quick="Show the quick answer",
    back="Back to the solved inputs",
    earlier="The solved result is of earlier inputs.",
    running="The contacts being solved are those of earlier inputs.",
    done="The contacts of earlier inputs are solved.",
    cancelled="Cancelled: no contacts were kept.",
    failed="Not solved",
    beyond="or solved contacts",
)

# Time for which the page waits for its first answer before it is sent without one [s].
_FIRST = 1.0


def add(work: Work) -> None:
    """Add the page to the server."""

    @ui.page("/", response_timeout=PAGE_PATIENCE)
    async def page(request: Request) -> None:
        inputs, error = Inputs.of_link(request.query_params.multi_items(), BEARING)
        page = BearingPage(session_of(work, inputs))
        ui.context.client.on_delete(page.close)
        with framed("Does this bearing spark?", "/"):
            page.build(error)
        # The first answer comes with the page, unless the processes are still starting.
        await asyncio.wait([page.refresh()], timeout=_FIRST)


class BearingPage:
    """Page of one tab."""

    def __init__(self, session: Session) -> None:
        self.session = session
        work = session.work
        self._following: Following[Inputs, BearingAnswer] = Following(
            lambda inputs: work.quick(BEARING_QUICK, dict(inputs.table), session.made_folder),
            lambda inputs: work.quick(BEARING_WHOLE, dict(inputs.table), session.made_folder),
            show=self._show,
            passing=lambda _, answer: self._put(answer),
            refuse=self._refuse,
            behind=work.behind,
        )

    def build(self, error: InputError | None) -> None:
        """Build the form and the places of the answer; with the error of a wrong address."""
        self._strip = Strip()
        Toolbar(self.session, "/", self.shown_again)
        self._address = ui.label(_wrong(error)).classes("notice wrong")
        self._address.props('role="alert" data-testid="error-address"').set_visibility(error is not None)
        with ui.element("div").classes("columns"):
            self.form = Form(BEARING_GROUPS, self.session.inputs, self.change)
            with ui.element("section").classes("answer").props('aria-label="Answer"'):
                self.solving = Solving(BEARING_SOLVED, _WORDS, self.session, self._ask, self.go_to)
                self._notice = ui.label().classes("notice wrong").props('data-testid="notice"')
                self._notice.set_visibility(False)
                button = ui.button("Go to the field", on_click=self.form.go_to_wrong, color=None)
                button.props("no-caps dense data-testid=to-field")
                button.bind_visibility_from(
                    self._notice, "visible", lambda told: told and self.form.wrong is not None
                )
                self.view = AnswerView()
                self._downloads = Downloads(self.session, "bearing", self.solving.folder)

    async def change(self, key: str, value: Any) -> None:
        """Take over a changed input, and answer."""
        self.session.history.push(self.session.inputs.changed({key: value}))
        self._show_address()
        self.refresh()

    def go_to(self, inputs: Inputs) -> None:
        """Make other inputs the present ones, as after a step back."""
        self.session.history.push(inputs)
        self.shown_again()

    def shown_again(self) -> None:
        """Show the present inputs in the form and in the address, and answer them."""
        self.form.set(self.session.inputs)
        self._show_address()
        self.refresh()

    def _show_address(self) -> None:
        """Put the inputs into the address; one that cannot hold them stays as it is."""
        self._address.set_visibility(False)
        if self.session.inputs.linkable:
            show_address(self.session.inputs, "/")

    def refresh(self) -> asyncio.Future[None]:
        """Answer the present inputs. Returns ends with the answer at once."""
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

    def _show(self, _: Inputs, answer: BearingAnswer) -> None:
        self._put(answer)
        self._dim(dimmed=False)
        self.form.tell(None)
        self._notice.set_visibility(False)
        self.solving.show(answer)
        self._downloads.look()

    def _put(self, answer: BearingAnswer) -> None:
        self.view.show(answer)
        named = [one for one in answer.shown if one.key in _SHORT and one.known]
        texts = [" ".join(filter(None, [one.label, one.bound, one.text, one.unit])) for one in named]
        self._strip.show(answer.level, answer.judged.lead, texts, bound=answer.judged.bound)

    def _dim(self, *, dimmed: bool) -> None:
        self.view.dim(dimmed=dimmed)
        self._strip.dim(dimmed=dimmed)

    def _refuse(self, error: Exception) -> None:
        self.form.tell(error)
        self.view.stop()
        self.solving.show(None, error)
        earlier = ". The answer below is that to earlier inputs." if self.view.shown else ""
        self._notice.text = f"{self.form.words(error)}{earlier}"
        self._notice.set_visibility(True)


def _wrong(error: InputError | None) -> str:
    return "" if error is None else f"{error}. The example is shown in place of the inputs of the address."
