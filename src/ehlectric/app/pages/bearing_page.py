"""Page of a bearing, which says whether it sparks, and what changes that."""

from __future__ import annotations

import asyncio
from collections.abc import Iterable, Mapping
from dataclasses import replace
from typing import ClassVar

from nicegui import ui

from ehlectric.app.calls import (
    BEARING_CURVES,
    BEARING_DUTY,
    BEARING_QUICK,
    BEARING_SOLVED,
    BEARING_WHOLE,
)
from ehlectric.app.form_fields import BEARING_GROUPS
from ehlectric.app.page_inputs import Inputs
from ehlectric.app.pages.answer_page import AnswerView
from ehlectric.app.pages.cycle_page import CyclePage
from ehlectric.app.pages.duty_box import DUTY_FILE, DutyView
from ehlectric.app.pages.frame import BEARING
from ehlectric.app.pages.page_parts import follow, say
from ehlectric.app.pages.remedies_box import RemediesBox
from ehlectric.app.pages.result_parts import FigureBox, table_html
from ehlectric.app.session import Session
from ehlectric.app.view_models import (
    PENDING,
    RANGE_FOLLOWS,
    BearingAnswer,
    Difference,
    Table,
)
from ehlectric.cases.defaults import HOW
from ehlectric.quantities.sheets import BEARING_CARDS

_AT_ONCE, _OVER_SPEED = ("load", "film"), ("capacitance",)

_OTHER_ROWS = "All rows of the operating point, as the command prints them"

_OR_SOLVE = "solve the contacts, which computes the duty cycle, too"

# Codes of statements about what a later answer has.
_TO_FOLLOW = ("range-follows", "probability-follows")


class BearingView(AnswerView[BearingAnswer]):
    """Place of an answer about a bearing."""

    rows_name = "Numbers of the bearing"
    keys = tuple(BEARING_CARDS)
    leading = ("breakdown",)
    waits = "Computing the breakdown over the speed …"

    def __init__(self, session: Session) -> None:
        self._session = session
        super().__init__()

    def build_below_panel(self) -> None:
        """Build the place of the remedies."""
        self.remedies = RemediesBox(self._session)

    def build(self) -> None:
        """Build the parts of the answer below its numbers."""
        self._changes = ui.html("", sanitize=False).props('data-testid="differences"')
        self._effects = ui.html("", sanitize=False).classes("effects").props('data-testid="effects"')
        self._none = ui.label().classes("notice").props('data-testid="no-figures"')
        self.build_figures((*_AT_ONCE, *_OVER_SPEED), wide=_OVER_SPEED)
        self.duty = DutyView()
        self._pending: BearingAnswer | None = None

    def place(self, *, cycle: bool) -> None:
        """State what belongs to the operating point if there is a duty ``cycle``."""
        super().place(cycle=cycle)
        self.rows_title = _OTHER_ROWS if cycle else AnswerView.rows_title

    def stop(self) -> None:
        """Show that what was to follow is not computed, as after a wrong input."""
        super().stop()
        if self._pending is not None:
            self.tell(without_what_follows(self._pending))
            self._pending = None
            self.panel.dim(dimmed=False)

    def show(self, answer: BearingAnswer) -> None:
        """Show an answer; what follows with the whole answer stays dimmed until that is there."""
        super().show(answer)
        self.body.props(f'data-contacts="{answer.contacts}" data-whole="{str(answer.whole).lower()}"')
        self._pending = None if answer.analysed else answer
        self._changes.content = differences_html(answer.differences)
        self._changes.set_visibility(bool(answer.differences))
        if answer.analysed or not answer.figures:
            self._effects.content = effects_html(answer.effects)
        known = answer.has_curves or not answer.figures
        if known:
            self.panel.lead("breakdown", answer.figures.get("breakdown"))
        else:
            self.panel.wait(self.waits)
        self.panel.figures["breakdown"].dim(dimmed=not known)
        self._effects.set_visibility(bool(self._effects.content))
        follow(self._effects, on=not answer.analysed)
        self.panel.dim(dimmed=not answer.analysed)
        say(self._none, "" if answer.figures else "Not converged: the figures would show no solution.")

    def show_figure(self, name: str, place: FigureBox, answer: BearingAnswer) -> None:
        """Show a figure; one over the speed stays as it is until an answer has it."""
        if name in _AT_ONCE or answer.has_curves or not answer.figures:
            place.show(answer.figures.get(name))
        place.dim(dimmed=name in _OVER_SPEED and not answer.has_curves)


def without_what_follows(answer: BearingAnswer) -> BearingAnswer:
    """Answer whose later parts are not computed, as after a wrong input."""
    numbers = []
    for number in answer.shown:
        note = number.note.removeprefix(RANGE_FOLLOWS).removeprefix("; ")
        pending = number.text == PENDING
        numbers.append(
            replace(number, text="none", note="not computed") if pending else replace(number, note=note)
        )
    # The range of the margin and the probability of breakdown.
    reasons = tuple(reason for reason in answer.verdict.reasons if reason.code not in _TO_FOLLOW)
    return replace(
        answer,
        whole=True,
        shown=tuple(numbers),
        verdict=replace(answer.verdict, reasons=reasons),
        deciding=replace(answer.deciding, facts=()),
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
    cells = tuple((row.name, row.quick, row.solved, row.change) for row in rows)
    return table_html(Table(f"Solved contacts compared with the {way}", heads, cells))


class BearingPage(CyclePage[BearingAnswer]):
    """Page of one tab."""

    path = "/"
    title = "Does this bearing spark?"
    start = BEARING
    kind = "bearing"
    groups = BEARING_GROUPS
    short: ClassVar[Mapping[str, str]] = {"bearing.margin": "", "margin.critical_speed": "breakdown below"}
    wait = 0.4
    elsewhere = (DUTY_FILE,)
    quick, later, solved = BEARING_QUICK, (BEARING_CURVES, BEARING_WHOLE), BEARING_SOLVED
    prompt = 1
    cycle, or_solve = BEARING_DUTY, _OR_SOLVE

    view: BearingView

    def build_view(self) -> None:
        """Build the place of the answer."""
        self.view = BearingView(self.session)

    def close(self) -> None:
        """Want no further answers."""
        super().close()
        self.view.remedies.latest_answer.drop()

    def _ask(self, *, at_once: bool = False) -> asyncio.Future[None]:
        self.view.remedies.wait()
        return super()._ask(at_once=at_once)

    def _show(self, inputs: Inputs, answer: BearingAnswer) -> None:
        super()._show(inputs, answer)
        if answer.whole:
            self.view.remedies.refresh()
        else:
            self.view.remedies.offer()
