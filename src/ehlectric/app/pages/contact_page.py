"""Page of one contact, line or point: its film, pressure and field from formulas at once, and solved."""

from __future__ import annotations

from collections.abc import Awaitable, Callable, Mapping, Sequence
from pathlib import Path
from typing import Any, ClassVar

from nicegui import ui

from ehlectric.app.calls import CONTACT_CUTS, CONTACT_QUICK, CONTACT_SOLVED
from ehlectric.app.form_fields.contact_fields import geometry_of, groups_of, switched
from ehlectric.app.latest_answer import OnlyLast
from ehlectric.app.page_inputs import Inputs
from ehlectric.app.pages.answer_page import AnswerPage, AnswerView
from ehlectric.app.pages.form import Form
from ehlectric.app.pages.frame import PATHS, contact_start
from ehlectric.app.pages.movie_box import MovieBox
from ehlectric.app.pages.page_parts import GroupBox, heading
from ehlectric.app.pages.result_parts import FigureBox
from ehlectric.app.pages.roughness_box import RoughnessBox
from ehlectric.app.session import Session
from ehlectric.app.view_models import ContactAnswer, Reach
from ehlectric.errors import InputError, LostError
from ehlectric.quantities.sheets import (
    BREAKDOWN_FORMULAS,
    CHECK_CARDS,
    CONTACT_CARDS,
    SPOT_CARDS,
    TOUCHING_CARDS,
)
from ehlectric.readable import readable

# Figures next to the verdict, further figures, and figures on which a click chooses the point of the cuts.
_LEADING = ("profiles", "surface")
_MAPS = ("film-map", "pressure-map", "field-map")
_FURTHER = ("section", *_MAPS)
_WIDE = ("section",)
_CUTS = ("cut-x", "cut-y")

# Position of a click on a figure, all that is sent of it.
_PLACE = "(event) => emit({x: event.points[0].x, y: event.points[0].y})"

# Formula films of the short answer, of a line and of a point contact.
_FILMS_BY_FORMULA = tuple(f"film_formulas.{name}.minimum_thickness" for name in BREAKDOWN_FORMULAS.values())


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
        self._label.text = f"{self._name} = {readable(self.value, 4)} {self._unit}"
        self._slider.props["aria-valuetext"] = self._label.text


class CutsBox:
    """Cuts of a solved point contact through a point that is chosen on a map or by sliders."""

    def __init__(
        self, session: Session, folder: Callable[[], Path | None], maps: Sequence[FigureBox]
    ) -> None:
        self._session, self._folder, self._maps = session, folder, maps
        self._reach: Reach | None = None
        self._sliders: dict[str, CutSlider] = {}
        self._cut = OnlyLast(self._cut_through)
        self._choice = ui.element("div").classes("cut-choice")
        with ui.element("div").classes("figures"):
            self._figures = {name: FigureBox(name) for name in _CUTS}
        for map_box in maps:
            map_box.plot.on("plotly_click", self._clicked, js_handler=_PLACE)

    def show(self, answer: ContactAnswer) -> None:
        """Show the cuts of an answer; nothing where it has none."""
        for name, box in self._figures.items():
            box.show(answer.cuts.get(name))
        reach = answer.reach
        if reach is not None and reach == self._reach:
            return
        self._reach = reach
        self._choice.clear()
        if reach is None:
            return
        with self._choice:
            heading("Cuts through a point", 2)
            ui.label(f"Click on a map, or move the sliders. At first: {reach.first}.").classes("soft")
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
        reach, folder = self._reach, self._folder()
        if reach is None or folder is None:
            return
        across, down = (y, x) if reach.turned else (x, y)
        # The shapes of the cuts on the maps are the third and the fourth.
        places = {f"shapes[2].{end}": down for end in ("y0", "y1")}
        places |= {f"shapes[3].{end}": across for end in ("x0", "x1")}
        for map_box in self._maps:
            map_box.plot.run_method("relayout", places)
        try:
            cuts = await self._session.work.quick(CONTACT_CUTS, str(folder), x, y)
        except (InputError, LostError) as error:
            ui.notify(str(error), type="negative")
            return
        if folder == self._folder():
            for name, box in self._figures.items():
                box.show(cuts.get(name))


class ContactView(AnswerView[ContactAnswer]):
    """Place of an answer about a contact."""

    rows_name = "Numbers of the contact"
    keys = tuple(
        dict.fromkeys(
            key.replace("*", formula)
            for cards in (CONTACT_CARDS, TOUCHING_CARDS, SPOT_CARDS, CHECK_CARDS)
            for key in cards
            for formula in BREAKDOWN_FORMULAS.values()
        )
    )
    leading = _LEADING
    waits = "Film, pressure and field stand here when the film is solved."

    def __init__(self, session: Session, folder: Callable[[], Path | None]) -> None:
        self._session, self._folder = session, folder
        super().__init__()

    def build(self) -> None:
        """Build the parts of the answer below its numbers."""
        self.build_figures(_FURTHER, _WIDE)
        self._cuts = CutsBox(self._session, self._folder, [self.figures[name] for name in _MAPS])

    def show(self, answer: ContactAnswer) -> None:
        """Show an answer."""
        super().show(answer)
        self.body.props(f'data-solved="{str(answer.solved).lower()}"')
        if answer.solved:
            self.panel.lead(answer.deciding.figure, answer.figures.get(answer.deciding.figure))
        else:
            self.panel.empty(self.waits)
        self._cuts.show(answer)


# Places of the card of the movie: above the answer while surfaces move, and below their roughness at rest.
_MOVIE_FIRST = 0


class ContactPage(AnswerPage[ContactAnswer]):
    """Page of one tab."""

    path = PATHS["contact"]
    title = "Film, pressure and field of one contact"
    start = contact_start("line")
    kind = "contact"
    short: ClassVar[Mapping[str, str]] = {
        **dict.fromkeys(
            ("discharge.margin", "breakdown_by_formula.margin", "asperities.electrical_behaviour"), ""
        ),
        **dict.fromkeys(("film.minimum_thickness", *_FILMS_BY_FORMULA), "minimum film"),
    }
    quick, solved = CONTACT_QUICK, CONTACT_SOLVED

    view: ContactView

    def __init__(self, session: Session) -> None:
        super().__init__(session)
        # Inputs of each geometry when it was left.
        self._other: dict[str, Inputs] = {}

    @classmethod
    def starting(cls, inputs: Inputs) -> Inputs:
        """Inputs of an address; the example of its geometry where it names only this."""
        only = [{}, *({"contact.geometry": name} for name in _GEOMETRIES)]
        return contact_start(geometry_of(inputs)) if inputs.flat() in only else inputs

    def build_form(self) -> None:
        """Build the choice of the geometry, and the form of the present one."""
        self._kind = ui.radio(_GEOMETRIES, value=geometry_of(self.session.inputs), on_change=self._switch)
        self._kind.props('inline aria-label="Kind of contact" data-testid="geometry"')
        self._form_place = ui.element("div")
        self._build_fields()

    def _build_fields(self) -> None:
        self._form_place.clear()
        self._form_of = geometry_of(self.session.inputs)
        with self._form_place:
            self.form = Form(groups_of(self._form_of), self.session.inputs, self.change)

    def build_view(self) -> None:
        """Build the place of the answer, and the boxes of rough and of moving surfaces."""
        with ui.element("div").classes("answer-body") as self._places:
            self.view = ContactView(self.session, self.solving.folder)
            rough = self.session.inputs.value("roughness") is not None
            with GroupBox("Rough surfaces", opened=rough, first=True):
                self._roughness = RoughnessBox(self.session, self._inputs_changed)
            moves = "Rough surfaces in motion"
            with GroupBox("Motion", title=moves, opened=self._moving, first=True) as self._movie_card:
                self._movie = MovieBox(self.session, self._inputs_changed)
        self._movie_first = False
        self._place_movie()

    def folder(self) -> Path | None:
        """Folder of the movie of moving surfaces, or of the solved film."""
        return self._movie.folder if self._moving else super().folder()

    @property
    def _moving(self) -> bool:
        return self.session.inputs.value("motion") is not None

    def _place_movie(self) -> bool:
        """Put the movie above the answer while surfaces move; True where it changed its place."""
        moving = self._moving
        if moving == self._movie_first:
            return False
        self._movie_first = moving
        self._movie_card.move(self._places, _MOVIE_FIRST if moving else -1)
        return True

    async def _switch(self, event: Any) -> None:
        """Change between line and point contact, with what both have."""
        now, geometry = self.session.inputs, str(event.value)
        if geometry != geometry_of(now):
            self._other[geometry_of(now)] = now
            self.go_to(switched(now, self._other.get(geometry) or contact_start(geometry)))

    async def change(self, key: str, value: Any) -> None:
        """Take over a changed input, and answer."""
        # The button that removed an input is no longer there.
        with self._form_place:
            await super().change(key, value)

    async def _inputs_changed(self) -> None:
        """Answer inputs into which a box has put other surfaces or another motion."""
        # The button that removed a surface is no longer there.
        with self._form_place:
            if self._place_movie():
                self._movie.show_switch()
            self.shown_again()

    def shown_again(self) -> None:
        """Show the present inputs everywhere, as after an undo, and answer them."""
        self._place_movie()
        self._kind.set_value(geometry_of(self.session.inputs))
        if self._form_of != geometry_of(self.session.inputs):
            self._build_fields()
        super().shown_again()

    def show_boxes(self) -> None:
        """Show the present inputs in the boxes of rough and of moving surfaces."""
        self._roughness.refresh()
        self._movie.refresh()


_GEOMETRIES = {"line": "Line contact", "point": "Point contact"}
