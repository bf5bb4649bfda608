"""Page of one contact, line or point: its film, pressure and field by formula at once, and solved."""

from __future__ import annotations

import shutil
from collections.abc import Awaitable, Callable, Iterable
from pathlib import Path
from typing import Any

from fastapi import Request
from nicegui import ui

from ehlectric.app.answers import ContactCheck, ContactView, Reach, Shown
from ehlectric.app.calls import CONTACT_AT_ONCE, CONTACT_CHECK, CONTACT_CUTS, CONTACT_SOLVED
from ehlectric.app.following import OnlyLast
from ehlectric.app.form_fields.contact_fields import geometry_of, groups_of, switched
from ehlectric.app.page_inputs import Inputs
from ehlectric.app.pages.downloads import Downloads
from ehlectric.app.pages.form import Form
from ehlectric.app.pages.frame import (
    PAGE_PATIENCE,
    Toolbar,
    connected,
    contact_start,
    framed,
    session_of,
    show_address,
)
from ehlectric.app.pages.movie_box import MovieBox
from ehlectric.app.pages.page_parts import (
    JobBox,
    Strip,
    address_error,
    button,
    card,
    figure,
    heading,
    light,
    light_shown,
    lines_behind,
    mark,
    number_cards,
    warnings,
)
from ehlectric.app.pages.roughness_box import RoughnessBox
from ehlectric.app.session import Session
from ehlectric.app.work import Job, Work
from ehlectric.errors import ConvergenceError, InputError, LostError

# Figures on which a click chooses the point of the cuts, and those that take the whole width.
_MAPS = ("film-map", "pressure-map", "field-map")
_WIDE = ("profiles", "section", "surface")

# Position of a click on a figure, all that is sent of it.
_PLACE = "(event) => emit({x: event.points[0].x, y: event.points[0].y})"


class FigureBox:
    """Figure with its heading and its caption, which can be replaced by another one of the same name."""

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
    """Slider of the browser's own for one coordinate of the point of the cuts."""

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
        self._slider = ui.element("input").props(f'type="range" data-testid="slider-cut-{name}" step="any"')
        self._slider.props(f'aria-label="{name} of the cut in {unit}" min="{ends[0]}" max="{ends[1]}"')
        self._slider.on("input", self._moved, js_handler="(event) => emit(event.target.value)", throttle=0.1)
        self.set(value)

    def set(self, value: float) -> None:
        """Show another value, within the range."""
        self.value = min(self._ends[1], max(self._ends[0], value))
        self._slider.props["value"] = self.value
        self._slider.update()
        self._tell()

    async def _moved(self, event: Any) -> None:
        self.value = float(event.args)
        # The next update of the element must not set its earlier value again.
        self._slider.props["value"] = self.value
        self._tell()
        await self._changed()

    def _tell(self) -> None:
        self._label.text = f"{self._name} = {self.value:.4g} {self._unit}"
        self._slider.props["aria-valuetext"] = self._label.text


class ContactViewBox:
    """Solved contact of a tab, empty at first."""

    def __init__(self, session: Session) -> None:
        self._session = session
        self._figures: dict[str, FigureBox] = {}
        self._cuts: dict[str, FigureBox] = {}
        self._folder: Path | None = None
        self._reach: Reach | None = None
        self._sliders: dict[str, CutSlider] = {}
        self._cut = OnlyLast(self._cut_through)
        with ui.element("div").props('data-testid="solved"') as self._box:
            self._words = ui.element("div").classes("told-answer").props('aria-live="polite"')
            self._plots = ui.element("div").classes("figures")
            self._choice = ui.element("div").classes("cut-choice")
            self._cut_plots = ui.element("div").classes("figures")
            self._table = ui.element("div")
        self._box.set_visibility(False)

    def dim(self, *, old: bool) -> None:
        """Dim the answer where it belongs to earlier inputs."""
        mark(self._box, "old", on=old)

    def show(self, view: ContactView, folder: Path | None) -> None:
        """Show a solved contact."""
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
        with self._table:
            title = "All numbers, as the command prints them"
            lines_behind(title, view.rows, "Numbers of the solved contact", "rows")

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
            ui.label(f"Click on a map, or move the sliders. At first: {reach.first}.").classes("note")
            for name, ends, at in (("x", reach.x, reach.at[0]), ("y", reach.y, reach.at[1])):
                self._sliders[name] = CutSlider(name, ends, at, reach.unit, self._slid)

    async def _clicked(self, event: Any) -> None:
        if self._reach is not None:
            axes = ("y", "x") if self._reach.turned else ("x", "y")
            for axis, place in zip(axes, ("x", "y"), strict=True):
                self._sliders[axis].set(float(event.args[place]))
            await self._slid()

    async def _slid(self) -> None:
        """Cut through the chosen point; while one cut is made, only the last of further points waits."""
        await self._cut(self._sliders["x"].value, self._sliders["y"].value)

    async def _cut_through(self, x: float, y: float) -> None:
        reach, folder = self._reach, self._folder
        if reach is None or folder is None:
            return
        self._draw_lines(*((y, x) if reach.turned else (x, y)))
        try:
            cuts = await self._session.work.quick(CONTACT_CUTS, str(folder), x, y)
        except (InputError, LostError) as error:
            ui.notify(str(error), type="negative")
            return
        if folder == self._folder:
            self._show_figures(self._cut_plots, self._cuts, cuts)

    def _draw_lines(self, across: float, down: float) -> None:
        """Move the lines of the cuts on the maps; their shapes are the third and the fourth."""
        places = {f"shapes[2].{end}": down for end in ("y0", "y1")}
        places |= {f"shapes[3].{end}": across for end in ("x0", "x1")}
        for name in _MAPS:
            if name in self._figures:
                self._figures[name].plot.run_plot_method("relayout", places)


_PATH = "/contact"
_GEOMETRIES = {"line": "Line contact", "point": "Point contact"}

# Ends of the keys of the numbers of the short answer, by formula or solved, and where the surfaces touch.
_SHORT = (".minimum_thickness", ".breakdown_voltage")
_SHORT_OF_SPOTS = (".behaviour", ".breakdown_5")

# Places of the movie among the cards of the answer, while surfaces move and at rest.
_MOVIE_FIRST, _MOVIE_LAST = 1, 3

_MOVING = (
    "These surfaces move, so that the command solves their film over time. The movie above is that solution; "
    "switch the motion off to solve them at rest."
)


def add(work: Work) -> None:
    """Add the page to the server."""

    @ui.page(_PATH, response_timeout=PAGE_PATIENCE)
    async def page(request: Request) -> None:
        pairs = request.query_params.multi_items()
        inputs, error = Inputs.of_link(pairs, contact_start("line"))
        if inputs.flat() in ({}, {"contact.geometry": "line"}, {"contact.geometry": "point"}):
            inputs = contact_start(geometry_of(inputs))
        page = ContactPage(session_of(work, inputs))
        with framed("Film, pressure and field of one contact", _PATH):
            page.build(error)
        if await connected():
            await page.refresh()


class ContactPage:
    """Page of one tab."""

    def __init__(self, session: Session) -> None:
        self.session = session
        self._asked = self._runs = 0
        self._solve_at_once = OnlyLast(self._solve_now)
        self._check: ContactCheck | None = None
        # Inputs of the solved contact that is shown, and the folder of its files; small ones have none.
        self._solved: Inputs | None = None
        self._folder: Path | None = None
        self._running: tuple[Inputs, Path] | None = None
        self._other: dict[str, Inputs] = {}

    @property
    def folder(self) -> Path | None:
        """Folder with files of a result of the present inputs; None where they are still to be made."""
        if self._moving:
            return self._movie.folder
        return self._folder if self._is_solved else None

    def build(self, error: InputError | None = None) -> None:
        """Build the form and the places of the answers; ``error`` is that of the address."""
        self._strip = Strip()
        Toolbar(self.session, _PATH, self.shown_again)
        address_error(error)
        with ui.element("div").classes("columns"):
            with ui.element("div").classes("inputs"):
                self._build_inputs()
            with ui.element("section").props('aria-label="Answer"').classes("answer"):
                self._build_answer()

    def _build_inputs(self) -> None:
        self._kind = ui.radio(_GEOMETRIES, value=geometry_of(self.session.inputs), on_change=self._switch)
        self._kind.props('inline aria-label="Kind of contact" data-testid="geometry"')
        self._form_place = ui.element("div")
        self._build_form()

    def _build_form(self) -> None:
        self._form_place.clear()
        self._form_of = geometry_of(self.session.inputs)
        with self._form_place:
            self.form = Form(groups_of(self._form_of), self.session.inputs, self.change)

    def _build_answer(self) -> None:
        self._answer = ui.context.slot.parent
        with card("Before solving, by formula"):
            self._formula = ui.element("div").classes("told-answer")
            self._formula.props('aria-live="polite" data-testid="by-formula"')
        with card("Solved"):
            with ui.element("div").classes("solving"):
                self._solve = button("Solve", "solve", self.solve, primary=True)
                self._state = ui.label().props('role="status" data-testid="solve-state"').classes("state")
            self._job = JobBox(self.session, self._ended, lambda error: self._state.set_text(str(error)))
            self.view = ContactViewBox(self.session)
        with card("Rough surfaces"):
            self._roughness = RoughnessBox(self.session, self._inputs_changed)
        with card("Rough surfaces in motion") as self._movie_card:
            self._movie = MovieBox(self.session, self._inputs_changed)
        self._movie_first = False
        self._place_movie()
        Downloads(self.session, "contact", lambda: self.folder)

    async def _switch(self, event: Any) -> None:
        """Change between line and point contact, with what both have."""
        now, wanted = self.session.inputs, str(event.value)
        if wanted == geometry_of(now):
            return
        self._other[geometry_of(now)] = now
        self.session.history.push(switched(now, self._other.get(wanted) or contact_start(wanted)))
        await self.shown_again()

    async def change(self, key: str, value: Any) -> None:
        """Take over a changed input, and answer."""
        self.session.history.push(self.session.inputs.changed({key: value}))
        # The button that removed an input is no longer there.
        with self._form_place:
            show_address(self.session.inputs, _PATH)
            self._roughness.refresh()
            self._movie.refresh()
            await self.refresh()

    async def _inputs_changed(self) -> None:
        """Answer inputs into which a box has put other surfaces or another motion."""
        # The button that removed a surface is no longer there.
        with self._form_place:
            if self._place_movie():
                self._movie.show_switch()
            await self.shown_again()

    async def shown_again(self) -> None:
        """Show the present inputs everywhere, as after an undo, and answer them."""
        self._place_movie()
        show_address(self.session.inputs, _PATH)
        self._kind.set_value(geometry_of(self.session.inputs))
        if self._form_of == geometry_of(self.session.inputs):
            self.form.set(self.session.inputs)
        else:
            self._build_form()
        self._roughness.refresh()
        self._movie.refresh()
        await self.refresh()

    async def refresh(self) -> None:
        """Answer the present inputs; an answer that comes after newer inputs is dropped."""
        self._asked += 1
        asked = self._asked
        self._formula.classes(add="old")
        self._strip.dim(dimmed=True)
        self._show_state()
        try:
            table, folder = dict(self.session.inputs.table), str(self.session.folder)
            answer = await self.session.work.quick(CONTACT_CHECK, table, folder)
        except (InputError, LostError) as error:
            if self._awaits(asked):
                self._check = None
                self._tell(error)
            return
        if not self._awaits(asked):
            return
        self.form.tell(None)
        self._check = answer
        self._show_check(answer)
        self._show_state()
        if answer.quick and not self._is_solved:
            await self._solve_at_once()

    def _awaits(self, asked: int) -> bool:
        """Whether the tab is still open, and no newer answer was asked for than that of this number."""
        return asked == self._asked and not self._formula.is_deleted

    def _show_check(self, answer: ContactCheck) -> None:
        self._formula.classes(remove="old")
        self._formula.clear()
        with self._formula:
            number_cards(answer.numbers, prefix="formula-")
            light(answer.level, answer.text, testid="verdict-formula")
            warnings(answer.warnings)
            lines_behind("All numbers before solving", answer.rows, "Numbers before the film is solved")
        if not self._is_solved:
            self._show_short(answer, "by formula")

    def _show_short(self, answer: ContactCheck | ContactView, what: str = "") -> None:
        """Show the short answer of a narrow screen."""
        shown = light_shown(answer.level, answer.text)
        spots = answer.spots if isinstance(answer, ContactView) else ()
        texts = [
            f"{one.label.lower()} {one.with_unit}"
            for one in spots or answer.numbers
            if one.key.endswith(_SHORT_OF_SPOTS if spots else _SHORT)
        ]
        self._strip.show(answer.level, f"{shown.words} {what}".strip(), texts, bound=shown.bound)
        self._strip.dim(dimmed=False)

    @property
    def _moving(self) -> bool:
        return self.session.inputs.value("motion") is not None

    @property
    def _is_solved(self) -> bool:
        return self._solved == self.session.inputs

    def _place_movie(self) -> bool:
        """Put the movie above what is solved at rest while surfaces move; True where it changed its place."""
        moving = self._moving
        if moving == self._movie_first:
            return False
        self._movie_first = moving
        self._movie_card.move(self._answer, _MOVIE_FIRST if moving else _MOVIE_LAST)
        return True

    def _show_state(self, text: str = "") -> None:
        """Say what the solved answer belongs to, and dim it where that is other inputs."""
        moving = self._moving
        old = self._solved is not None and not self._is_solved
        self._solve.set_visibility(not moving)
        self.view.dim(old=old)
        if moving:
            text = f"{_MOVING}{' The result below belongs to earlier inputs.' if old else ''}"
        elif old and not text:
            text = "The result below belongs to earlier inputs."
        elif self._is_solved and not text:
            text = "Solved." if self._converged else "Not converged."
        self._state.text = text

    async def solve(self) -> None:
        """Solve the present inputs: small contacts at once, others as a job with progress."""
        if self._check is None or self._moving:
            return
        if self._check.quick:
            await self._solve_at_once()
            return
        self._runs += 1
        folder = self.session.folder / f"contact-{self._runs}"
        inputs = self.session.inputs
        if self._job.start(CONTACT_SOLVED, dict(inputs.table), str(self.session.folder), str(folder)):
            self._running = (inputs, folder)
            self._solve.disable()

    async def _solve_now(self) -> None:
        """Solve the latest inputs without a job."""
        if self._formula.is_deleted:
            return
        asked, inputs = self._asked, self.session.inputs
        try:
            view = await self.session.work.quick(
                CONTACT_AT_ONCE, dict(inputs.table), str(self.session.folder)
            )
        except (InputError, ConvergenceError, LostError) as error:
            if self._awaits(asked):
                self._tell(error)
            return
        if not self._formula.is_deleted:
            self._show(view, inputs, None)

    def _ended(self, job: Job) -> None:
        """Show the outcome of a job."""
        self._solve.enable()
        if job.state == "done" and self._running is not None:
            self._show(job.result, *self._running)
        elif job.state == "cancelled":
            self._show_state("Cancelled.")
        elif job.error is not None and self._running is not None:
            if self._running[0] == self.session.inputs:
                self._tell(job.error)
            else:
                self._show_state(f"Earlier inputs were not solved: {job.error}")

    def _show(self, view: ContactView, inputs: Inputs, folder: Path | None) -> None:
        before, self._folder, self._solved = self._folder, folder, inputs
        if before is not None and before != folder:
            shutil.rmtree(before, ignore_errors=True)
        self._converged = view.converged
        self.view.show(view, folder)
        self._show_state()
        if self._is_solved:
            self._show_short(view)

    def _tell(self, error: Exception) -> None:
        """Show an error next to its field, and that the answers belong to earlier inputs."""
        self.form.tell(error)
        self._state.text = "No answer to the present inputs." if isinstance(error, InputError) else str(error)
        self.view.dim(old=True)
