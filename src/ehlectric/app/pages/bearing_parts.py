"""Parts of the answer about a bearing, whose texts change in place: verdict, numbers, figures and tables."""

from __future__ import annotations

from collections.abc import Iterable
from html import escape

from nicegui import ui

from ehlectric.app.answers.bearing import Difference, Figure, Judged, Table
from ehlectric.app.answers.number import Number
from ehlectric.app.answers.told import Told, counts
from ehlectric.app.pages import parts
from ehlectric.cases.bearings.ways import HOW
from ehlectric.errors import SEVERITY_WORDS


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
            self._plot = parts.figure({"data": [], "layout": {}}, name)
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
