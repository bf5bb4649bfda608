"""Answer about a bearing on its page: verdict, numbers, figures, warnings and all rows of the command."""

from __future__ import annotations

from dataclasses import replace

from nicegui import ui

from ehlectric.app.answers.bearing import FOLLOWS, PENDING, RANGE_FOLLOWS, BearingAnswer
from ehlectric.app.answers.told import elsewhere
from ehlectric.app.pages.bearing_parts import (
    FigureBox,
    NumberBox,
    VerdictBox,
    WarningList,
    behind,
    differences_html,
    effects_html,
)
from ehlectric.app.pages.parts import lines_html
from ehlectric.quantities.sheets import BEARING_CARDS

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
