"""Answer about a drive on its page: verdict, numbers of both ends, remedies, figures and warnings."""

from __future__ import annotations

from nicegui import ui

from ehlectric.app.answers.drive import DriveAnswer
from ehlectric.app.answers.told import elsewhere
from ehlectric.app.pages.bearing_parts import (
    FigureBox,
    NumberBox,
    VerdictBox,
    WarningList,
    behind,
    table_html,
)
from ehlectric.app.pages.parts import lines_html
from ehlectric.quantities.sheets import DRIVE_CARDS

# Numbers of either answer, in their order.
_FIGURES = (
    *("voltages", "remedies", "histogram", "spectrum"),
    *("discharge-voltage", "discharge-energy", "discharge-charge", "discharge-current"),
)
_WIDE = ("voltages",)


class DriveView:
    """Place of an answer, whose texts and figures change in place so that zoom and focus stay."""

    def __init__(self) -> None:
        with ui.element("div").classes("answer-body").props('data-testid="answer"') as self._body:
            self._verdict = VerdictBox()
            with ui.element("div").classes("numbers").props('data-testid="numbers" aria-live="polite"'):
                self._numbers = {name: NumberBox(name) for name in DRIVE_CARDS}
            self._remedies = ui.html("", sanitize=False).props('data-testid="remedies-table"')
            self._warnings = WarningList()
            with ui.element("div").classes("figures"):
                self._figures = {name: FigureBox(name, wide=name in _WIDE) for name in _FIGURES}
            self._ends = ui.html("", sanitize=False).props('data-testid="ends"')
            self._lines = ui.html("", sanitize=False).props('data-testid="details"')
        self._body.set_visibility(False)

    @property
    def shown(self) -> bool:
        """Whether there is an answer."""
        return bool(self._body.visible)

    def dim(self, *, dimmed: bool) -> None:
        """Dim the answer while it is that of earlier inputs."""
        self._body.classes(add="stale" if dimmed else "", remove="" if dimmed else "stale")
        self._body.props(f'aria-busy="{str(dimmed).lower()}"')

    def show(self, answer: DriveAnswer) -> None:
        """Show an answer."""
        self._body.set_visibility(True)
        self._body.props["data-simulated"] = str(answer.simulated).lower()
        self._body.update()
        self._verdict.show(answer.judged)
        for name, box in self._numbers.items():
            box.show(answer.number(name))
        remedies = answer.remedies
        self._remedies.content = "" if remedies is None else f"<h2>Remedies</h2>{table_html(remedies)}"
        self._remedies.set_visibility(remedies is not None)
        self._warnings.show(answer.warnings, elsewhere(answer.warnings))
        for name, figure in self._figures.items():
            figure.show(answer.figures.get(name))
        self._ends.content = f"<h2>Both bearings</h2>{table_html(answer.ends)}"
        self._lines.content = behind(
            "All rows, as the command prints them", lines_html(answer.lines, "Numbers of the drive")
        )
