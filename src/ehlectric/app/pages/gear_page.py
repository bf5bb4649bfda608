"""Page of a gear pair, which says whether the film of its mesh insulates, and when it breaks down."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar

from nicegui import ui

from ehlectric.app.calls import GEAR_DUTY, GEAR_QUICK, GEAR_SOLVED, GEAR_WHOLE
from ehlectric.app.form_fields import GEAR_GROUPS
from ehlectric.app.form_fields.gear_fields import Gears, gears_of, of_gears
from ehlectric.app.page_inputs import Inputs
from ehlectric.app.pages.answer_page import ProbableView
from ehlectric.app.pages.cycle_page import CyclePage
from ehlectric.app.pages.duty_box import DUTY_FILE, DutyView
from ehlectric.app.pages.frame import GEAR, PATHS
from ehlectric.app.pages.page_parts import page_texts
from ehlectric.app.pages.result_parts import behind, table_html
from ehlectric.app.session import Session
from ehlectric.app.view_models import WITHOUT_PROBABILITY, GearAnswer
from ehlectric.quantities.sheets import GEAR_CARDS


class GearView(ProbableView[GearAnswer]):
    """Place of an answer about a gear pair."""

    rows_name = "Numbers of the gear pair"
    keys = tuple(GEAR_CARDS)
    leading = ("film",)
    without = WITHOUT_PROBABILITY

    def build(self) -> None:
        """Build the parts of the answer below its numbers."""
        self._points = ui.html("", sanitize=False).props('data-testid="points"')
        self.build_figures(("flank", "mesh", "path"), ("path",))
        self._geometry = ui.html("", sanitize=False).props('data-testid="geometry"')
        self.duty = DutyView()

    def show(self, answer: GearAnswer) -> None:
        """Show an answer."""
        super().show(answer)
        self.body.props["data-solved"] = str(answer.solved).lower()
        self.body.update()
        self.panel.lead("film", answer.figures.get("film"))
        self._points.content = f"<h2>Points of the path of contact</h2>{table_html(answer.points)}"
        self._geometry.content = behind("Geometry that follows from the drawing", table_html(answer.geometry))


class GearPage(CyclePage[GearAnswer]):
    """Page of one tab."""

    path = PATHS["gear"]
    title = "Does the film between these gears insulate?"
    start = GEAR
    kind = "gear"
    groups = GEAR_GROUPS
    elsewhere = ("contacts", DUTY_FILE)
    short: ClassVar[Mapping[str, str]] = {"mesh.margin": "", "mesh.lambda_ratio": "λ"}
    wait = 0.4
    quick, later, solved = GEAR_QUICK, (GEAR_WHOLE,), GEAR_SOLVED
    cycle, or_solve = GEAR_DUTY, "compute it with ehlectric gear"

    def __init__(self, session: Session) -> None:
        super().__init__(session)
        # Inputs of each kind of gear pair when it was left.
        self._left: dict[Gears, Inputs] = {}

    def build_form(self) -> None:
        """Build the choice of the kind of gear pair, and the form."""
        self._kind = ui.radio(_KINDS, value=gears_of(self.session.inputs), on_change=self._switch)
        self._kind.props('inline aria-label="Kind of gear pair" data-testid="gears"')
        ui.label(page_texts("gear")["kinds"]).classes("field-note")
        super().build_form()

    async def _switch(self, event: Any) -> None:
        """Change to the last inputs of the other kind of gear pair, or to its example."""
        now, kind = self.session.inputs, event.value
        if kind != gears_of(now):
            self._left[gears_of(now)] = now
            self.go_to(self._left.get(kind) or of_gears(kind, now))

    def show_boxes(self) -> None:
        """Show the kind of the present gear pair, and the field of the duty cycle."""
        super().show_boxes()
        self._kind.set_value(gears_of(self.session.inputs))

    def build_view(self) -> None:
        """Build the place of the answer."""
        self.view = GearView()

    def _show(self, inputs: Inputs, answer: GearAnswer) -> None:
        super()._show(inputs, answer)
        self.form.follow(answer.follows)

    def _refuse(self, error: Exception) -> None:
        super()._refuse(error)
        self.form.follow({})


_KINDS: dict[Gears, str] = {"helical": "Helical pair", "spur": "Spur pair"}
