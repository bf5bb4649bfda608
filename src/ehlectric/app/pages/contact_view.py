"""Solved contact on a page: verdict, numbers, figures, point of the cuts, and the table of the command."""

from __future__ import annotations

from collections.abc import Awaitable, Callable, Iterable, Mapping
from pathlib import Path
from typing import Any

from nicegui import ui

from ehlectric.app.answers.calls import CONTACT_CUTS
from ehlectric.app.answers.contact import ContactView, Reach
from ehlectric.app.answers.figure import Shown
from ehlectric.app.answers.number import Number
from ehlectric.app.pages.parts import figure, heading, light, lines_html, number, warnings
from ehlectric.app.session import Session
from ehlectric.errors import InputError, LostError

# Figures on which a click chooses the point of the cuts, and those that take the whole width.
_MAPS = ("film-map", "pressure-map", "field-map")
_WIDE = ("profiles", "section", "surface")

# Position of a click on a figure, all that is sent of it.
_PLACE = "(event) => emit({x: event.points[0].x, y: event.points[0].y})"


def number_cards(numbers: Iterable[Number], prefix: str = "") -> None:
    """Main numbers beside each other, each with what concerns it."""
    with ui.element("div").classes("numbers"):
        for one in numbers:
            with ui.element("div").props(f'data-testid="number-{prefix}{one.key}"'):
                number(one.label, one.text, one.unit, bound=one.bound, warnings=one.told, note=one.note)


class FigureBox:
    """Figure with its heading and its caption, which can be replaced by another one of the same name.

    Parameters
    ----------
    shown : Shown
        Figure.
    """

    def __init__(self, shown: Shown) -> None:
        wide = " wide" if shown.name in _WIDE else ""
        with ui.element("figure").classes("figure-box" + wide).props(f'data-testid="figure-{shown.name}"'):
            with ui.element("h3"):
                self._title = ui.label(shown.title)
            self.plot = figure(shown.plot, shown.label)
            with ui.element("figcaption").classes("caption"):
                self._caption = ui.label(shown.caption)

    def show(self, shown: Shown) -> None:
        """Replace the figure; what was zoomed stays so."""
        self._title.text, self._caption.text = shown.title, shown.caption
        self.plot.props["aria-label"] = shown.label
        self.plot.update_figure(dict(shown.plot))


class CutSlider:
    """Slider of the browser's own for one coordinate of the point of the cuts.

    Parameters
    ----------
    name : str
        "x" or "y".
    ends : tuple of float
        Ends of its range.
    value : float
        First value.
    unit : str
        Unit.
    slid : callable
        Called after its value has changed by the user.

    Attributes
    ----------
    value : float
        Present value.
    """

    def __init__(
        self,
        name: str,
        ends: tuple[float, float],
        value: float,
        unit: str,
        slid: Callable[[], Awaitable[None]],
    ) -> None:
        self.value = value
        self._name, self._ends, self._unit, self._changed = name, ends, unit, slid
        self._label = ui.label().classes("cut-value")
        slider = ui.element("input").props(f'type="range" data-testid="slider-cut-{name}" step="any"')
        slider.props(f'aria-label="{name} of the cut in {unit}" min="{ends[0]}" max="{ends[1]}"')
        slider.on("input", self._moved, js_handler="(event) => emit(event.target.value)", throttle=0.1)
        self._slider = slider
        self.set(value)

    def set(self, value: float) -> None:
        """Show another value, within the range."""
        self.value = min(self._ends[1], max(self._ends[0], value))
        self._slider.props["value"] = self.value
        self._slider.update()
        self._tell()

    async def _moved(self, event: Any) -> None:
        self.value = float(event.args)
        # What the element was told last must not come back with its next update.
        self._slider.props["value"] = self.value
        self._tell()
        await self._changed()

    def _tell(self) -> None:
        text = f"{self._name} = {self.value:.4g} {self._unit}"
        self._label.text = text
        self._slider.props["aria-valuetext"] = text


class ContactViewBox:
    """Solved contact of a tab, empty at first.

    Parameters
    ----------
    session : Session
        Session of the tab.
    """

    def __init__(self, session: Session) -> None:
        self._session = session
        self._figures: dict[str, FigureBox] = {}
        self._cuts: dict[str, FigureBox] = {}
        self._folder: Path | None = None
        self._reach: Reach | None = None
        self._cutting = False
        self._sliders: dict[str, CutSlider] = {}
        self._at: tuple[float, float] | None = None
        with ui.element("div").props('data-testid="solved"') as self._box:
            self._words = ui.element("div").classes("told-answer").props('aria-live="polite"')
            self._plots = ui.element("div").classes("figures")
            self._choice = ui.element("div").classes("cut-choice")
            self._cut_plots = ui.element("div").classes("figures")
            self._table = ui.element("div")
        self._box.set_visibility(False)

    def dim(self, *, old: bool) -> None:
        """Dim the answer where it belongs to earlier inputs."""
        self._box.classes(add="old" if old else "", remove="" if old else "old")

    def show(self, view: ContactView, folder: Path | None) -> None:
        """Show a solved contact.

        Parameters
        ----------
        view : ContactView
            Solved contact.
        folder : Path or None
            Folder with its files, from which cuts are made; a line contact may have none.
        """
        self._folder = folder
        self._box.set_visibility(True)
        self._words.clear()
        with self._words:
            light(view.level, view.text)
            number_cards(view.numbers)
            if view.spots:
                heading("Where the surfaces touch", 3)
                number_cards(view.spots, prefix="spots-")
            warnings(view.warnings)
        self._show_figures(self._plots, self._figures, view.figures)
        self._show_figures(self._cut_plots, self._cuts, view.cuts)
        self._show_choice(view.reach)
        self._table.clear()
        with self._table, ui.expansion("All numbers, as the command prints them").props('data-testid="rows"'):
            ui.html(lines_html(view.rows, "Numbers of the solved contact"), sanitize=False)

    def _show_figures(self, place: ui.element, boxes: dict[str, FigureBox], figures: Iterable[Shown]) -> None:
        figures = tuple(figures)
        if list(boxes) == [shown.name for shown in figures]:
            for shown in figures:
                boxes[shown.name].show(shown)
            return
        place.clear()
        boxes.clear()
        with place:
            for shown in figures:
                boxes[shown.name] = FigureBox(shown)
                if shown.name in _MAPS:
                    boxes[shown.name].plot.on("plotly_click", self._clicked, js_handler=_PLACE)

    def _show_choice(self, reach: Reach | None) -> None:
        """Sliders for the point of the cuts."""
        if reach is not None and reach == self._reach:
            return
        self._reach = reach
        self._choice.clear()
        if reach is None:
            return
        with self._choice:
            heading("Cuts through a point", 3)
            said = f"Click on a map, or move the sliders. At first: {reach.first}."
            ui.label(said).classes("note")
            for name, ends, at in (("x", reach.x, reach.at[0]), ("y", reach.y, reach.at[1])):
                self._sliders[name] = CutSlider(name, ends, at, reach.unit, self._slid)

    async def _slid(self) -> None:
        await self._cut(self._sliders["x"].value, self._sliders["y"].value)

    async def _clicked(self, event: Any) -> None:
        place: Mapping[str, Any] = event.args
        if self._reach is None:
            return
        across, down = float(place["x"]), float(place["y"])
        x, y = (down, across) if self._reach.turned else (across, down)
        self._sliders["x"].set(x)
        self._sliders["y"].set(y)
        await self._slid()

    async def _cut(self, x: float, y: float) -> None:
        """Cut through a point; while one cut is made, only the last of further points waits."""
        reach, folder = self._reach, self._folder
        if reach is None or folder is None:
            return
        self._at = (x, y)
        if self._cutting:
            return
        self._cutting = True
        try:
            while self._at is not None:
                at, self._at = self._at, None
                self._draw_lines(*((at[1], at[0]) if reach.turned else at))
                cuts = await self._session.work.quick(CONTACT_CUTS, str(folder), *at)
                if folder == self._folder:
                    self._show_figures(self._cut_plots, self._cuts, cuts)
        except (InputError, LostError) as error:
            ui.notify(str(error), type="negative")
        finally:
            self._cutting = False

    def _draw_lines(self, across: float, down: float) -> None:
        """Move the lines of the cuts on the maps; their shapes are the third and the fourth."""
        places = {f"shapes[2].{end}": down for end in ("y0", "y1")}
        places |= {f"shapes[3].{end}": across for end in ("x0", "x1")}
        for name in _MAPS:
            if name in self._figures:
                self._figures[name].plot.run_plot_method("relayout", places)
