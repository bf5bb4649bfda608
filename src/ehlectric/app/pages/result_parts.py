"""Parts of an answer: panel with its verdict and its gauge, numbers, notes, figures and tables."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from html import escape

from nicegui import ui

from ehlectric.app.pages.page_parts import Plot, follow, mark, say, scrolling_table
from ehlectric.app.view_models import Deciding, Figure, Gauge, Note, Number, PageWarning, Table, counts
from ehlectric.quantities.result_warnings import SEVERITY_WORDS
from ehlectric.quantities.verdict import Verdict
from ehlectric.readable import capital


class Panel:
    """Verdict, the number that decides, and next to them the figure that shows why."""

    def __init__(self, leading: Iterable[str], waits: str) -> None:
        with ui.element("div").classes("panel").props('data-testid="panel"') as self._box:
            with (
                ui.element("div")
                .classes("panel-words")
                .props('role="status" aria-atomic="false"') as self._words
            ):
                self.verdict = VerdictBox()
                with ui.element("div").classes("deciding") as self._deciding:
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

    def dim(self, *, dimmed: bool) -> None:
        """Dim the verdict and its number while their final answer is computed."""
        mark(self._words, "stale", on=dimmed)

    def empty(self, text: str) -> None:
        """Show no figure, and describe instead what would show one."""
        for box in self.figures.values():
            box.show(None)
        say(self._waits, text)
        mark(self._box, "alone", on=not text)

    def tell(self, deciding: Deciding, number: Number | None, notes: Iterable[Note]) -> None:
        """Show the number that decides, with its interval and its gauge."""
        self._deciding.set_visibility(number is not None)
        self._number.show(number, notes)
        self._gauge.content = "" if deciding.gauge is None else gauge_svg(deciding.gauge)
        self._facts.content = facts_html(deciding.facts)

    def lead(self, name: str, shown: Figure | None) -> None:
        """Show the figure that decides, of a name; without one the verdict takes the whole width."""
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

    def __init__(self, test: str = "verdict") -> None:
        self._box = ui.element("div").classes("verdict grey").props(f'data-testid="{test}"')
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
        with ui.element("div").classes("sentences"):
            self._assumed = ui.label().classes("assumed").props('data-testid="assumptions"')
            self._reasons = ui.html("", sanitize=False)
        say(self._assumed, "")

    def show(
        self, verdict: Verdict, meaning: str = "", said: tuple[str, ...] = (), *, whole: bool = True
    ) -> None:
        """Show a verdict, with what it means and without the statements of the codes ``said`` elsewhere.

        The place of the sentences that follow with a ``whole`` answer is kept for them.
        """
        self._box.classes(replace=f"verdict {verdict.level}").props(f'data-level="{verdict.level}"')
        self._lead.text, self._meaning.text = verdict.heading, meaning
        say(self._bound, verdict.bound_note)
        stated = verdict.answer is None or verdict.answer.code in said
        reasons = (*([] if stated else [verdict.numbers]), *verdict.sentences(said))
        kept = () if whole else self._last[len(reasons) :]
        self._reasons.content = _list(reasons, kept)
        if whole:
            self._last = reasons
        say(self._assumed, verdict.assumed)


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
        codes = {warning.code for warning in number.warnings}
        letters = ", ".join(note.letter for note in notes if note.letter and note.warning.code in codes)
        self._letters.content = f'<span class="unseen">note </span>{letters}' if letters else ""


def note_html(note: Note) -> str:
    """Warning with its meaning and the numbers that it concerns in sight, and its text behind it."""
    warning = note.warning
    letter = f"<sup>{note.letter}</sup> " if note.letter else ""
    names = f"{escape(', '.join(note.names))}: " if note.names else ""
    head = f"{letter}<b>{SEVERITY_WORDS[warning.severity]}</b> {names}"
    if not warning.meaning:
        return (
            f'<div class="told {warning.severity}" data-code="{warning.code}">'
            f"{head}{escape(warning.text)}</div>"
        )
    texts = "<br>".join(map(escape, (warning.text, *note.further)))
    return (
        f'<details class="told {warning.severity}" data-code="{warning.code}">'
        f"<summary>{head}{escape(warning.meaning)}</summary>{texts}</details>"
    )


def show_warnings(warnings: Iterable[PageWarning]) -> None:
    """Warnings of a part of a page that has no numbers of an answer."""
    ui.html("".join(note_html(Note(warning)) for warning in warnings), sanitize=False)


class FigureBox:
    """Figure with its heading and the table of its numbers; a wide one has the whole row of a grid."""

    def __init__(self, name: str, *, wide: bool = False) -> None:
        with ui.element("div").classes("figure-box").props(f'data-testid="figure-{name}"') as self._box:
            with ui.element("h3"):
                self._title = ui.label()
            self.plot = Plot({}, name)
            self._caption = ui.label().classes("soft")
            self._table = ui.html("", sanitize=False)
        mark(self._box, "wide", on=wide)
        self._box.set_visibility(False)

    def dim(self, *, dimmed: bool) -> None:
        """Dim the figure while it belongs to earlier inputs."""
        follow(self._box, on=dimmed)

    def show(self, shown: Figure | None) -> None:
        """Show a figure; None hides the one before."""
        self._box.set_visibility(shown is not None)
        if shown is not None:
            self._title.text, self._caption.text = shown.title, shown.caption
            self.plot.show(shown.plot, shown.label)
            table = shown.table
            self._table.content = "" if table is None else behind("Numbers of this figure", table_html(table))


class NoteList:
    """List of all notes and warnings, the severe ones first."""

    def __init__(self) -> None:
        with ui.element("section").props('aria-label="Notes" data-testid="warnings"') as self.box:
            with ui.element("h2"):
                self._head = ui.label()
            self._list = ui.html("", sanitize=False)
        self.box.set_visibility(False)

    def show(self, notes: Sequence[Note]) -> None:
        """Show notes under their count."""
        self.box.set_visibility(True)
        count = counts(note.warning for note in notes)
        self._head.text = capital(count)
        self._list.content = "".join(map(note_html, notes))


def behind(summary: str, inner: str) -> str:
    """Part of a page that is closed at first."""
    return f"<details><summary>{escape(summary)}</summary>{inner}</details>"


def table_html(table: Table, test: str = "") -> str:
    """Table that scrolls within its own box, with a mark for tests."""
    rows = "".join(
        "<tr>" + "".join(f"<td>{escape(cell)}</td>" for cell in row) + "</tr>" for row in table.rows
    )
    caption = f"<caption>{escape(table.caption)}</caption>"
    return scrolling_table(table.caption, table.heads, rows, test, caption)


def _list(texts: Iterable[str], kept: Iterable[str] = ()) -> str:
    """List of texts, with the place of some that nobody sees or hears."""
    items = "".join(f"<li>{escape(text)}</li>" for text in texts)
    items += "".join(f'<li class="kept" aria-hidden="true">{escape(text)}</li>' for text in kept)
    return f"<ul>{items}</ul>" if items else ""
