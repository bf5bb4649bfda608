"""View of a rough surface: figures and statistics after every processing step, and its summits."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from html import escape

from nicegui import ui

from ehlectric.app.answers.surface import SummitsTable, SurfaceAnswer
from ehlectric.app.pages.parts import figure, heading, warnings


def show_surface(answer: SurfaceAnswer) -> None:
    """Show a surface with its steps, its summits and warnings."""
    ui.label(_sentence(answer)).props('data-testid="surface-size"')
    if answer.rows:
        _show_table("Statistics", "surface-statistics", answer.heads, answer.rows)
    warnings(answer.warnings)
    if answer.summits is not None:
        _show_summits(answer.summits)
    with ui.element("div").classes("steps"):
        for step in answer.figures:
            with ui.element("div"):
                heading(step.name, 3)
                figure(step.figure, step.label)


def _show_summits(summits: SummitsTable) -> None:
    """Table of the summits, which bearings and models of asperities take."""
    title = summits.title[0].upper() + summits.title[1:]
    heading(title, 3)
    _show_table(title, "surface-summits", summits.heads, summits.rows)
    ui.label(summits.note).classes("note")


def _show_table(name: str, testid: str, heads: Sequence[str], rows: Iterable[Sequence[str]]) -> None:
    """Table that scrolls sideways where it is wider than the screen."""
    with ui.element("div").classes("scrolls").props(f'tabindex="0" role="group" aria-label="{name}"'):
        ui.html(_table(heads, rows), sanitize=False, tag="table").props(f'data-testid="{testid}"')


def _sentence(answer: SurfaceAnswer) -> str:
    if not answer.rows:
        return "Exact shape, drawn over the domain of the contact."
    first, last = answer.rows[0], answer.rows[-1]
    name = answer.heads[2].split("\n")[0]
    parts = [answer.size, f"{name} {first[2]} nm {first[0]}"]
    if len(answer.rows) > 1:
        parts.append(f"{last[2]} nm as used")
    if answer.lines:
        parts.append(f"{answer.lines['row']} rows and {answer.lines['column']} columns in the file")
    return "; ".join(parts)


def _table(heads: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    head = "".join(f'<th scope="col">{escape(one)}</th>' for one in heads)
    body = "".join(
        f'<tr><th scope="row">{escape(row[0])}</th>'
        + "".join(f"<td>{escape(entry)}</td>" for entry in row[1:])
        + "</tr>"
        for row in rows
    )
    return f"<thead><tr>{head}</tr></thead><tbody>{body}</tbody>"
