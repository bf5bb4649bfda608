"""Duty cycle of a page: the field of its file, and the place of its result."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from nicegui import ui

from ehlectric.app.calls import DUTY_LOOK
from ehlectric.app.form_fields.field import VEHICLE, VEHICLE_TABLE, form_data
from ehlectric.app.pages.file_field import LOST_FILE, NOT_IN_LINKS, UploadField
from ehlectric.app.pages.form import Form
from ehlectric.app.pages.page_parts import GroupBox, button, follow, heading, lines_html, say
from ehlectric.app.pages.result_parts import FigureBox, note_html, table_html
from ehlectric.app.session import Session
from ehlectric.app.view_models import DutyAnswer, Note
from ehlectric.errors import InputError, LostError
from ehlectric.runs.example_files import example
from ehlectric.runtime.memory import MOST_MEASURED

# Key of the file, and the example that a click loads.
DUTY_FILE, _EXAMPLE = "duty.file", "measurements/wltc_class_3b_motor.csv"

_COLUMNS = (
    "The file contains the column time [s], and any of speed [rpm] or vehicle speed [km/h], {columns}. "
    "Values without a column are as above."
)
_OF_BEARINGS = "radial load [N], axial load [N], temperature [degC] and common-mode voltage [V]"
_OF_GEARS = "torque [N m], temperature [degC], flank temperature [degC] and voltage [V]"

# What a cycle gives, by the kind of the page, and where its result is.
_GIVES = {
    "bearing": "The bearing over time.",
    "drive": "Discharges over time, with the simulation; both bearings have the loads of their files.",
    "gear": "The mesh over time.",
}
_PLACES = {"bearing": "duty", "drive": "figure-duty", "gear": "duty"}

_COMPUTING = "The cycle is being computed."

_TO_RESULT = "document.querySelector('[data-testid={}]')?.scrollIntoView({{ block: 'start' }})"


class DutyField:
    """Field for the file of a duty cycle, next to the vehicle in the ``form`` of the page.

    The ``kind`` of the page is "bearing", "drive" or "gear".
    """

    def __init__(self, session: Session, form: Form, kind: str) -> None:
        self._session, self._change, self._kind = session, form.take, kind
        columns = _COLUMNS.format(columns=_OF_GEARS if kind == "gear" else _OF_BEARINGS)
        self._sentences: dict[str, str] = {}  # sentences about files that were looked at
        self._last: str | None = None  # file that was shown last
        title, given, to_result = "Duty cycle", self.file is not None, _TO_RESULT.format(_PLACES[kind])
        with (
            ui.element("div").classes("form").props('role="form" aria-label="Duty cycle"'),
            GroupBox(
                title, title=title, note=f"{_GIVES[kind]} {columns}", opened=given, first=True
            ) as self._group,
            ui.element("div").classes("box"),
        ):
            UploadField(
                session,
                self._take,
                self.refuse,
                name="duty",
                label="CSV of the cycle",
                most=MOST_MEASURED,
            )
            self._error = ui.label().classes("error").props('role="alert" id="duty-error"')
            self._error.props('data-testid="error-duty"')
            self._used = ui.label().classes("hint").props('data-testid="duty-used" aria-live="polite"')
            with ui.element("div").classes("buttons"):
                leads = button("Go to its result", "to-duty", lambda: ui.run_javascript(to_result))
                removes = button("Remove the cycle", "duty-remove", self._removed)
                button("Use the example, the WLTC of a car", "duty-example", self._example)
            form.group(VEHICLE).move(ui.element("div").classes("box"))
            self._of_cycle = (leads, removes)
        self.refresh()

    @property
    def file(self) -> str | None:
        """Name of the file of the present inputs; None without one."""
        file = self._session.inputs.value(DUTY_FILE)
        return file if isinstance(file, str) else None

    @property
    def lost(self) -> bool:
        """Whether the present inputs name a file that this session does not have."""
        return self.file is not None and self._session.path_of(self.file) is None

    def refresh(self) -> None:
        """Show the file of the present inputs, as after an undo."""
        file = self.file
        if file is not None and self._last is None:
            self._group.turn(opened=True)
        self._last = file
        say(self._error, "")
        for element in self._of_cycle:
            element.set_visibility(file is not None)
        if file is None:
            say(self._used, "")
            return
        about, name = self._sentences.get(file), self._session.name_of(file)
        what = f"{name}: {about}" if about else f"The file is {name}."
        say(self._used, f"{what} {NOT_IN_LINKS}")
        if self.lost:
            self.refuse(f"{LOST_FILE}, or remove the cycle.")

    def refuse(self, error: Exception | str) -> None:
        """Show why there is no cycle; each file with the name that its user gave."""
        say(self._error, self._session.named(str(error)))
        self._group.turn(opened=True)

    async def _example(self) -> None:
        try:
            path = example(_EXAMPLE)
            name = self._session.add(path.name, path.read_bytes())
        except (InputError, OSError) as error:
            self.refuse(error)
        else:
            await self._take(name)

    async def _take(self, name: str) -> None:
        """Put an uploaded file into the inputs, if it is a duty cycle."""
        try:
            look = await self._session.work.quick(DUTY_LOOK, name, self._session.folder, self._kind)
        except (InputError, LostError) as error:
            self.refuse(error)
            return
        self._sentences[name] = look.text
        vehicle = self._session.inputs.value(VEHICLE_TABLE) or form_data("first_values")["vehicle"]
        await self._change({DUTY_FILE: name, VEHICLE_TABLE: vehicle if look.of_vehicle else None})

    async def _removed(self) -> None:
        await self._change({"duty": None})


class DutyView:
    """Place of the result of a duty cycle, below the answer about its bearing or gear pair."""

    def __init__(self) -> None:
        with ui.element("section").classes("duty").props('aria-label="Duty cycle"') as self.body:
            self.body.props('data-testid="duty"')
            heading("Duty cycle", 2)
            self._state = ui.label().classes("notice").props('role="status" data-testid="duty-state"')
            with ui.element("div").classes("duty") as self._result:
                self._lines = ui.html("", sanitize=False).props('data-testid="duty-numbers"')
                self._warnings = ui.html("", sanitize=False).props('data-testid="duty-warnings"')
                self.figure = FigureBox("duty", wide=True)
                self._stretches = ui.html("", sanitize=False).props('data-testid="duty-stretches"')
        self.show(None)

    def show(self, answer: DutyAnswer | None, name: Callable[[str], str] = str) -> None:
        """Show a result; None hides the place. ``name`` gives files in texts the names of their user."""
        self.body.set_visibility(answer is not None)
        self._result.set_visibility(answer is not None)
        say(self._state, "")
        follow(self._result, on=False)
        if answer is None:
            return
        self._lines.content = lines_html(
            answer.lines, "Numbers of the duty cycle, as the command prints them"
        )
        named = (replace(warning, text=name(warning.text)) for warning in answer.warnings)
        self._warnings.content = "".join(note_html(Note(warning)) for warning in named)
        self.figure.show(answer.figure)
        stretches = answer.stretches
        self._stretches.content = "" if stretches is None else table_html(stretches)
        self._stretches.set_visibility(stretches is not None)

    def wait(self) -> None:
        """Show that a result is being computed; the one before is dimmed."""
        self.body.set_visibility(True)
        say(self._state, _COMPUTING)
        follow(self._result, on=True)

    def stop(self) -> None:
        """Show that what was to follow is not computed, as after a wrong input."""
        say(self._state, "")
        self.body.set_visibility(self._result.visible)

    def fail(self, text: str) -> None:
        """Show why there is no result."""
        self.body.set_visibility(True)
        self._result.set_visibility(False)
        say(self._state, text)
