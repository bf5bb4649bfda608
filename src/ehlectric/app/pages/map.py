"""Map of a sweep on its page, the chosen point with the link to its case, and the table of points."""

from __future__ import annotations

from collections.abc import Awaitable, Callable, Mapping
from typing import Any

from nicegui import ui

from ehlectric.app.answers.calls import SWEEP_POINT
from ehlectric.app.answers.sweep import SweepView
from ehlectric.app.figures.sweep import chosen_trace, place
from ehlectric.app.inputs import Inputs
from ehlectric.app.pages import parts
from ehlectric.app.session import Session
from ehlectric.errors import InputError, LostError

# Only the number of the point goes to the server, not the whole figure.
_CLICKED = "(event) => emit(event.points.map((p) => p.customdata).find((n) => n !== undefined))"
_KEYS = """(event) => {
  if (["ArrowLeft", "ArrowRight", "ArrowUp", "ArrowDown", "Enter"].includes(event.key)) {
    event.preventDefault(); emit(event.key);
  }
}"""
_STEPS = {"ArrowLeft": (-1, 0), "ArrowRight": (1, 0), "ArrowUp": (0, 1), "ArrowDown": (0, -1)}

# Words of the link to the case of a point, by the address of its page.
_OPEN = {"/": "Open its bearing", "/drive": "Open its drive", "/contact": "Open its contact"}

# States of points whose own words say too little.
_STATES = {
    "do not use": 'solved, but "do not use"',
    "no value": "solved, without this number",
    "failed": "refused or failed",
}

# Most points whose table is written anew at each look while points are being solved.
_FEW = 200


class MapPart:
    """Map of a sweep with its table.

    Parameters
    ----------
    session : Session
        Session of the tab.
    shown : callable
        Called with the dotted key of the result that shall be shown.

    Attributes
    ----------
    shown : str
        Dotted key of the shown result.
    """

    def __init__(self, session: Session, shown: Callable[[str], Awaitable[None]]) -> None:
        self.session = session
        self.shown = ""
        self._told = shown
        self._ran: Inputs | None = None
        self._view: SweepView | None = None
        self._drawn = ""
        self._chosen: int | None = None
        self._address = ""
        self._build()

    @property
    def open_points(self) -> int:
        """Number of points that are not solved yet."""
        return self._view.counts.get("open", 0) if self._view else 0

    @property
    def differs(self) -> bool:
        """Whether the map shows another result than that which is asked for."""
        return self._view is not None and self._drawn != self.shown

    @property
    def finished(self) -> bool:
        """Whether every point has been tried with an end that another try would not change."""
        counts = self._view.counts if self._view else {}
        return bool(counts) and not counts.get("open") and not counts.get("failed")

    def _build(self) -> None:
        with parts.card("Map") as self._card:
            self._select = ui.select({}, label="Result to show", on_change=self._other, with_input=True)
            self._select.props("outlined dense data-testid=show").classes("full")
            self._note = ui.label("Nothing is solved yet: Run fills the map.").props('data-testid="map-note"')
            self._verdict = ui.element("div").props('aria-live="polite" data-testid="verdict"')
            with ui.element("div").classes("map-keys").props('tabindex="0" data-testid="map"') as self._keys:
                self._plot = parts.figure({"data": [], "layout": {}}, "Map of the sweep")
                self._plot.on("plotly_click", self._clicked, js_handler=_CLICKED)
            self._keys.on("keydown", self._pressed, js_handler=_KEYS)
            self._keys.set_visibility(False)
            self._point = ui.element("div").classes("point").props('aria-live="polite" data-testid="point"')
            self._warnings = ui.element("div")
            with ui.expansion("Table of the points").props('data-testid="points"') as self._points:
                self._table = ui.table(columns=[], rows=[], row_key="number", pagination=10).classes(
                    "points-table"
                )
                self._table.add_slot("body-cell-number", _BUTTON)
                self._table.on("choose", self._from_table)
            self._points.set_visibility(False)

    def offer(self, values: Mapping[str, str], shown: str) -> None:
        """Offer results to show; the first unless another is asked for."""
        options = dict(values)
        if self._view is not None:
            options |= {key: name for key, name in self._view.values.items() if key not in options}
        if shown and shown not in options:
            options[shown] = shown
        self.shown = shown or next(iter(values), self.shown)
        self._select.set_options(options, value=self.shown or None)

    def began(self, ran: Inputs) -> None:
        """Remember the inputs of the points that are being solved."""
        if self._ran != ran:
            self._ran, self._chosen = ran, None
            self._point.clear()

    def clear(self) -> None:
        """Take everything away."""
        self._view = self._ran = self._chosen = None
        self._point.clear()
        self._verdict.clear()
        self._warnings.clear()
        self._keys.set_visibility(False)
        self._points.set_visibility(False)
        self._note.text = "Nothing is solved yet: Run fills the map."

    def outdated(self, *, old: bool) -> None:
        """Dim the map where the inputs have changed since."""
        self._card.classes(add="old" if old else "", remove="" if old else "old")
        if old:
            self._note.text = "The inputs have changed: this is the map of the ones before."
        elif self._view is not None:
            self._note.text = _told(self._view)

    def show(self, view: SweepView, *, running: bool) -> None:
        """Show the state of a sweep."""
        self._view = view
        self._drawn = self.shown
        self._note.text = _told(view)
        if self._chosen is not None and self._chosen >= len(view.chart.points):
            self._chosen = None
        self._draw()
        self._keys.set_visibility(True)
        self._verdict.clear()
        self._warnings.clear()
        if view.text and not running:
            with self._verdict:
                parts.light(view.level, view.text)
            with self._warnings:
                parts.warnings(view.warnings)
        if not running or len(view.rows) <= _FEW:
            self._fill(view)

    def _draw(self) -> None:
        view = self._view
        if view is None:
            return
        figure = dict(view.figure)
        figure["data"] = [*figure["data"][:-1], chosen_trace(view.chart, self._chosen)]
        self._plot.update_figure(figure)
        about = f"{view.chart.title} over {view.chart.x.title}"
        about += f" and {view.chart.y.title}" if view.chart.y else ""
        about += "; arrow keys choose a point, Enter opens its case; the table below has all numbers"
        self._keys.props.update({"role": "group", "aria-label": about})

    def _fill(self, view: SweepView) -> None:
        columns = [{"name": "number", "label": "Point", "field": "number", "sortable": True}]
        columns += [
            {"name": f"c{k}", "label": name, "field": f"c{k}", "align": "left"}
            for k, name in enumerate(view.columns[1:])
        ]
        self._table.columns = columns
        self._table.rows = [
            {"number": int(row[0]), **{f"c{k}": cell for k, cell in enumerate(row[1:])}} for row in view.rows
        ]
        self._points.set_visibility(True)

    async def _other(self, event: Any) -> None:
        if event.value and event.value != self.shown:
            self.shown = str(event.value)
            await self._told(self.shown)

    async def _clicked(self, event: Any) -> None:
        if isinstance(event.args, int) and await self._choose(event.args):
            ui.navigate.to(self._address, new_tab=True)

    async def _from_table(self, event: Any) -> None:
        if isinstance(event.args, int):
            await self._choose(event.args)

    async def _pressed(self, event: Any) -> None:
        if self._view is None:
            return
        if event.args == "Enter":
            if self._chosen is not None and self._address:
                ui.navigate.to(self._address, new_tab=True)
            return
        right, up = _STEPS[str(event.args)]
        chart = self._view.chart
        i, j = (0, 0) if self._chosen is None else place(chart, self._chosen)
        if self._chosen is not None:
            i, j = i + right, j + up
        height = len(chart.y.values) if chart.y else 1
        if 0 <= i < len(chart.x.values) and 0 <= j < height:
            await self._choose(i * height + j)

    async def _choose(self, number: int) -> bool:
        """Choose a point; whether it has a case that a page can show."""
        view, ran = self._view, self._ran
        if view is None or ran is None or not 0 <= number < len(view.chart.points):
            return False
        self._chosen, self._address, refused = number, "", ""
        self._draw()
        folder = str(self.session.folder / "sweep")
        try:
            found = await self.session.work.quick(SWEEP_POINT, folder, dict(ran.table), number)
            self._address = f"{found.path}?{found.query}"
        except (InputError, LostError) as error:
            refused = str(error)
        self._tell(view, number, refused)
        return bool(self._address)

    def _tell(self, view: SweepView, number: int, refused: str) -> None:
        self._point.clear()
        with self._point:
            parts.heading(f"Point {number}", 3)
            with ui.element("ul"):
                for text in view.chart.points[number].texts:
                    with ui.element("li"):
                        ui.label(text)
            if self._address:
                name = _OPEN[self._address.partition("?")[0]]
                link = ui.link(f"{name} (new tab)", self._address, new_tab=True)
                link.props('data-testid="open-point"')
            else:
                ui.label(f"It has no page: {refused}").classes("wrong")


_BUTTON = """
<q-td :props="props">
  <button type="button" class="choose" @click="() => $parent.$emit('choose', props.row.number)"
    :aria-label="'choose point ' + props.row.number">{{ props.row.number }}</button>
</q-td>
"""


def _told(view: SweepView) -> str:
    """How many points have which state, and how their contacts are computed."""
    some = (f"{count} {_STATES.get(state, state)}" for state, count in view.counts.items())
    return f"Points: {', '.join(some)}.{_basis(view)}"


def _basis(view: SweepView) -> str:
    return f" {view.accuracy}" if view.accuracy else ""
