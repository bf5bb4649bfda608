"""Page of a bearing, which says whether it sparks, and what changes that."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from nicegui import ui

from ehlectric.app.answers import (
    PENDING,
    RANGE_FOLLOWS,
    BearingAnswer,
    Difference,
    Table,
)
from ehlectric.app.calls import BEARING_OVER_SPEED, BEARING_QUICK, BEARING_SOLVED, BEARING_WHOLE
from ehlectric.app.form_fields import BEARING_GROUPS
from ehlectric.app.pages.answer_page import AnswerPage, AnswerView, FigureBox, WarningList, table_html
from ehlectric.app.pages.frame import BEARING
from ehlectric.app.pages.page_parts import mark, say
from ehlectric.cases.defaults import HOW
from ehlectric.quantities.sheets import BEARING_CARDS

_AT_ONCE, _OVER_SPEED = ("load", "film"), ("breakdown", "capacitance")


# End of sentences about what a later answer has.
_TO_FOLLOW = "follows."


class BearingView(AnswerView[BearingAnswer]):
    """Place of an answer about a bearing."""

    rows_name = "Numbers of the bearing"

    def build(self) -> None:
        """Build the parts of the answer."""
        self._changes = ui.html("", sanitize=False).props('data-testid="differences"')
        self.build_numbers(BEARING_CARDS)
        self._effects = ui.html("", sanitize=False).classes("effects").props('data-testid="effects"')
        self._warnings = WarningList()
        self._none = ui.label().classes("notice").props('data-testid="no-figures"')
        self.build_figures((*_AT_ONCE, *_OVER_SPEED))
        self._pending: BearingAnswer | None = None

    def stop(self) -> None:
        """Show that what was to follow is not computed, as after a wrong input."""
        if self._pending is None:
            return
        for one in self._pending.shown:
            if one.text == PENDING:
                self.numbers[one.key].show(replace(one, text="none", note="not computed"))
            elif one.note.startswith(RANGE_FOLLOWS):
                self.numbers[one.key].show(replace(one, note=one.note.removeprefix(f"{RANGE_FOLLOWS}; ")))
        judged = self._pending.judged
        # The range of the margin and the probability of breakdown.
        reasons = tuple(one for one in judged.reasons if not one.endswith(_TO_FOLLOW))
        self.verdict.show(replace(judged, reasons=reasons))
        self._pending = None

    def show(self, answer: BearingAnswer) -> None:
        """Show an answer; what follows with the whole answer stays dimmed until that is there."""
        super().show(answer)
        self.body.props(f'data-contacts="{answer.contacts}" data-whole="{str(answer.whole).lower()}"')
        self.verdict.show(answer.judged, whole=answer.whole)
        self._pending = None if answer.whole else answer
        self._changes.content = differences_html(answer.differences)
        self._changes.set_visibility(bool(answer.differences))
        if answer.over_speed or not answer.figures:
            self._effects.content = effects_html(answer.effects)
        self._effects.set_visibility(bool(self._effects.content))
        mark(self._effects, "stale", on=not answer.over_speed)
        self._warnings.show(answer.warnings)
        say(self._none, "" if answer.figures else "Not converged: the figures would show no solution.")

    def show_figure(self, name: str, place: FigureBox, answer: BearingAnswer) -> None:
        """Show a figure; one over the speed stays as it is until an answer has it."""
        if name in _AT_ONCE or answer.over_speed or not answer.figures:
            place.show(answer.figures.get(name))
        place.dim(dimmed=name in _OVER_SPEED and not answer.over_speed)


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


class BearingPage(AnswerPage[BearingAnswer]):
    """Page of one tab."""

    path = "/"
    title = "Does this bearing spark?"
    start = BEARING
    kind = "bearing"
    groups = BEARING_GROUPS
    short = ("bearing.capacitance", "bearing.margin")
    wait = 1.0
    quick, later, solved = BEARING_QUICK, (BEARING_OVER_SPEED, BEARING_WHOLE), BEARING_SOLVED

    def build_view(self) -> None:
        """Build the place of the answer."""
        self.view = BearingView()
