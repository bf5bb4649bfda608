"""View of a rough surface: its figures and its statistics after every processing step."""

from __future__ import annotations

from html import escape

from nicegui import ui

from ehlectric.app.answers.surface import SurfaceAnswer
from ehlectric.app.pages.parts import figure, heading, warnings


def show_surface(answer: SurfaceAnswer) -> None:
    """Show a surface with its steps and warnings."""
    ui.label(_sentence(answer)).props('data-testid="surface-size"')
    if answer.rows:
        with ui.element("div").classes("scrolls").props('tabindex="0" role="group" aria-label="Statistics"'):
            ui.html(_table(answer), sanitize=False, tag="table").props('data-testid="surface-statistics"')
    warnings(answer.warnings)
    with ui.element("div").classes("steps"):
        for step in answer.figures:
            with ui.element("div"):
                heading(step.name, 3)
                figure(step.figure, step.label)


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


def _table(answer: SurfaceAnswer) -> str:
    heads = "".join(f'<th scope="col">{escape(head)}</th>' for head in answer.heads)
    rows = "".join(
        f'<tr><th scope="row">{escape(row[0])}</th>'
        + "".join(f"<td>{escape(entry)}</td>" for entry in row[1:])
        + "</tr>"
        for row in answer.rows
    )
    return f"<thead><tr>{heads}</tr></thead><tbody>{rows}</tbody>"
