"""Page of a drive, which says how often both bearings discharge, and what changes that."""

from __future__ import annotations

from collections.abc import Awaitable, Callable, Mapping
from functools import partial
from typing import Any, ClassVar

from nicegui import ui

from ehlectric.app.calls import DRIVE_QUICK, DRIVE_SIMULATED
from ehlectric.app.form_fields.axle_fields import without_table
from ehlectric.app.form_fields.drive_fields import (
    MOST_FORCES,
    PAGE_GROUPS,
    PRESETS,
    ROTOR,
    changes_of,
    force_title,
    is_applicable,
    remedies_of,
    with_remedy,
    with_rotor_force,
    without_remedy,
)
from ehlectric.app.pages.answer_page import AnswerPage, AnswerView
from ehlectric.app.pages.duty_box import DUTY_FILE, DutyField
from ehlectric.app.pages.file_field import WAVEFORM_FILE, WaveformField
from ehlectric.app.pages.frame import DRIVE, PATHS
from ehlectric.app.pages.page_parts import Choices, GroupBox, button, removable
from ehlectric.app.pages.result_parts import FigureBox, behind, table_html
from ehlectric.app.session import Session
from ehlectric.app.view_models import DriveAnswer, Figure
from ehlectric.quantities.sheets import DRIVE_CARDS

# Figures of which the page shows one at a time, by their buttons.
_FURTHER = {
    "Voltages": "voltages",
    "How long": "histogram",
    "Spectrum": "spectrum",
    "Discharge voltage": "discharge-voltage",
    "Energy": "discharge-energy",
    "Charge": "discharge-charge",
    "Current": "discharge-current",
}
_SUMMARY = "Further figures: voltages over time, spectrum, and what discharges are like"

# Keys of the inputs that other parts of the page than its form show.
REMEDIES = "remedies"

NOT_APPLICABLE = "not applicable: the source is measured"


class DriveView(AnswerView[DriveAnswer]):
    """Place of an answer about a drive."""

    rows_name = "Numbers of the drive"
    keys = tuple(DRIVE_CARDS)
    leading = ("remedies", "voltages")

    def build(self) -> None:
        """Build the parts of the answer below its numbers."""
        self._remedies = ui.html("", sanitize=False).props('data-testid="remedies-table"')
        self.build_figures(("duty",), ("duty",))
        self._offered: dict[str, Figure] = {}
        self._opened = False
        with ui.element("details").props('data-testid="further"') as self._further:
            ui.html(_SUMMARY, sanitize=False, tag="summary")
            self._choices = Choices(_FURTHER, "Further figures", lambda _: self._draw(), always=True)
            self._drawing = FigureBox("further")
        self._further.on("toggle", self._toggled, js_handler="(event) => emit(event.target.open)")
        self._ends = ui.html("", sanitize=False).props('data-testid="ends"')

    def show(self, answer: DriveAnswer) -> None:
        """Show an answer."""
        super().show(answer)
        self.panel.lead(answer.deciding.figure, answer.figures.get(answer.deciding.figure))
        self.body.props["data-simulated"] = str(answer.simulated).lower()
        self.body.update()
        remedies = answer.remedies
        self._remedies.content = (
            "" if remedies is None else f"<h2>Mitigation measures</h2>{table_html(remedies)}"
        )
        self._remedies.set_visibility(remedies is not None)
        self._ends.content = behind("Both bearings, as the command prints them", table_html(answer.ends))
        leading = answer.deciding.figure
        names = (name for name, key in _FURTHER.items() if key in answer.figures and key != leading)
        self._offered = {name: answer.figures[_FURTHER[name]] for name in names}
        self._further.set_visibility(bool(self._offered))
        self._choices.offer(self._offered)
        self._draw()

    def _toggled(self, event: Any) -> None:
        self._opened = bool(event.args)
        self._draw()

    def _draw(self) -> None:
        """Draw the chosen figure where its place is open."""
        self._drawing.show(self._offered.get(self._choices.chosen) if self._opened else None)


class RemedyBox:
    """Group with a box to tick for each usual remedy, and a list of the others of the file."""

    def __init__(self, session: Session, change: Callable[[str, Any], Awaitable[None]]) -> None:
        self._session, self._change = session, change
        self._boxes: dict[str, tuple[ui.checkbox, ui.label, ui.element]] = {}
        with (
            ui.element("div").classes("form").props('role="form" aria-label="Mitigation measures"'),
            GroupBox("Remedies", title="Mitigation measures to compare", opened=True),
        ):
            ui.label(
                "Each measure is simulated in addition to the drive, with the same random numbers."
            ).classes("field-help")
            for title in PRESETS:
                self._preset(title)
            self._others = ui.element("div")
        self.refresh()

    def refresh(self) -> None:
        """Show the remedies of the present inputs, as after an undo."""
        given = remedies_of(self._session.inputs)
        for title, (box, note, place) in self._boxes.items():
            applied = given.get(title)
            changes = changes_of(self._session.inputs, title) if applied is None else applied
            place.set_visibility(changes is not None)
            box.set_value(applied is not None)
            note.text = _text(changes or {}) + self._remark(changes or {})
        self._others.clear()
        with self._others:
            for title, changes in given.items():
                if title not in PRESETS:
                    removable(
                        f"{title}: {_text(changes)}{self._remark(changes)}",
                        f"the mitigation measure {title}",
                        partial(self._remove, title),
                    )

    def _remark(self, changes: Mapping[str, Any]) -> str:
        """Text behind the changes of a remedy that does not apply to the source."""
        return "" if is_applicable(self._session.inputs, changes) else f" ({NOT_APPLICABLE})"

    def _preset(self, title: str) -> None:
        with ui.element("div").classes("remedy") as place:
            box = ui.checkbox(title, on_change=partial(self._switched, title))
            box.props("dense").props["data-testid"] = f"remedy-{_name(title)}"
            note = ui.label().classes("field-note")
        self._boxes[title] = (box, note, place)

    async def _switched(self, title: str, event: Any) -> None:
        inputs = self._session.inputs
        if bool(event.value) == (title in remedies_of(inputs)):
            return
        changes = changes_of(inputs, title) if event.value else None
        after = without_remedy(inputs, title) if changes is None else with_remedy(inputs, title, changes)
        await self._put(after)

    async def _remove(self, title: str) -> None:
        await self._put(without_remedy(self._session.inputs, title))

    async def _put(self, remedies: list[Any]) -> None:
        await self._change(REMEDIES, remedies or None)
        self.refresh()


def _text(changes: Mapping[str, Any]) -> str:
    return ", ".join(f"{key} = {value}" for key, value in changes.items())


def _name(title: str) -> str:
    return title.lower().replace(" ", "-")


class DrivePage(AnswerPage[DriveAnswer]):
    """Page of one tab."""

    path = PATHS["drive"]
    title = "How often do the bearings of this drive discharge?"
    start = DRIVE
    kind = "drive"
    groups = PAGE_GROUPS
    elsewhere = (REMEDIES, WAVEFORM_FILE, DUTY_FILE)
    first = 1
    short: ClassVar[Mapping[str, str]] = dict.fromkeys(
        ("end.events_per_second", "end.voltage_at_peak", "end.breakdown_voltage"), ""
    )
    quick, solved = DRIVE_QUICK, DRIVE_SIMULATED

    def build_view(self) -> None:
        """Build the place of the answer."""
        self.view = DriveView()

    def build_boxes(self) -> None:
        """Build the field of a measured waveform, the remedies, and the field of a duty cycle."""
        with self.form.group("Source"):
            self.waveform = WaveformField(self.session, self.form.take)
        with self.form.group(ROTOR):
            button("Add a force", "add-force", lambda: self.go_to(with_rotor_force(self.session.inputs)))
        for number in range(1, MOST_FORCES + 1):
            self._remove_force(number)
        self.remedies = RemedyBox(self.session, self.change)
        self.duty = DutyField(self.session, self.form, self.kind)

    def _remove_force(self, number: int) -> None:
        """Build the button that removes a force."""
        with self.form.group(title := force_title(number)):
            button(
                f"Remove {title.lower()}",
                f"remove-force-{number}",
                lambda: self.go_to(without_table(self.session.inputs, "force", number)),
            )

    def show_boxes(self) -> None:
        """Show the present inputs in the fields of files, and in the remedies."""
        self.waveform.refresh()
        self.remedies.refresh()
        self.duty.refresh()

    def _put(self, answer: DriveAnswer) -> None:
        self.view.place(cycle=self.duty.file is not None)
        super()._put(answer)

    async def change(self, key: str, value: Any) -> None:
        """Take over a changed input, and answer."""
        await super().change(key, value)
        if key == REMEDIES:
            # The inputs that the form sends as a whole are already in it.
            self.form.set(self.session.inputs)
