"""Measured values of a page: their fields, and the place of the calibration with them."""

from __future__ import annotations

from collections.abc import Awaitable, Callable, Mapping
from functools import partial
from typing import Any

from nicegui import ui

from ehlectric.app.calls import CALIBRATED, CALIBRATION_CHECKED
from ehlectric.app.form_fields.axle_fields import MEASURED
from ehlectric.app.form_fields.field import Field, in_field_unit, shown_text
from ehlectric.app.form_fields.measured_fields import (
    MEASURED_FILE,
    is_uncertainty,
    measured_fields,
    measured_text,
    with_uncertainty,
    with_value,
)
from ehlectric.app.latest_answer import LatestAnswer
from ehlectric.app.page_inputs import Inputs
from ehlectric.app.pages.file_field import LOST_FILE, NOT_IN_LINKS, UploadField
from ehlectric.app.pages.page_parts import (
    Control,
    GroupBox,
    JobBox,
    button,
    heading,
    mark,
    page_texts,
    say,
    tool,
)
from ehlectric.app.pages.result_parts import FigureBox, VerdictBox, behind, note_html, table_html
from ehlectric.app.session import Session
from ehlectric.app.view_models import CalibrationAnswer, Note, file_title
from ehlectric.app.work import Job
from ehlectric.errors import InputError
from ehlectric.quantities.units import printed
from ehlectric.runtime.memory import MOST_MEASURED

_TITLE, _FILE = "Measured values", "Or a CSV of operating points"

# Calibrations that a tab keeps.
_KEPT = 20

# Figures of a calibration.
_FIGURES = ("ranges", "compared")

_TO_RESULT = (
    "setTimeout(() => document.querySelector('[data-testid=calibration]')"
    "?.scrollIntoView({ block: 'start' }), 50)"
)


class MeasuredBox:
    """Group with the measured values of a page of a ``kind``, and the button that calibrates.

    ``change`` is called with changed keys and their values, ``show`` with a calibration and an empty
    text, or with a calibration of earlier inputs and a sentence; with None without a calibration.
    """

    def __init__(
        self,
        session: Session,
        kind: str,
        change: Callable[[dict[str, Any]], Awaitable[None]],
        show: Callable[[CalibrationAnswer | None, str], None],
    ) -> None:
        self._session, self._change, self._show = session, change, show
        self._kind, self._fields = kind, measured_fields(kind, session.inputs)
        self._had = self._given  # whether the inputs that were shown last had measured values
        self._begun: list[str] = []  # quantities whose value is still to be typed
        self._rows: dict[str, tuple[Control, Control]] = {}
        self._built: list[Field] = []  # fields of the rows
        self._results: dict[str, CalibrationAnswer] = {}
        self._running: Inputs | None = None
        self._checked: LatestAnswer[Inputs, str] = LatestAnswer(
            self._check,
            show=lambda _, text: self._accept(text),
            passing=lambda *_: None,
            refuse=self._refuse,
            behind=session.work.behind,
        )
        texts = page_texts("calibration")
        self._texts: Mapping[str, Any] = texts
        note = f"{texts['note']} {texts['places'][kind]}"
        with (
            ui.element("div").classes("form").props('role="form" aria-label="Measured values"'),
            GroupBox(_TITLE, note=note, opened=self._given, first=True) as self._group,
            ui.element("div").classes("box"),
        ):
            self._place = ui.element("div").classes("box")
            self._add = Control("measured.add", kind="list", label=texts["add"])
            self._add.on("commit", self._added)
            UploadField(session, self._upload, self.refuse, name="measured", label=_FILE, most=MOST_MEASURED)
            self._error = ui.label().classes("error").props('role="alert" id="measured-error"')
            self._error.props('data-testid="error-measured"')
            self._used = ui.label().classes("hint").props('data-testid="measured-used" aria-live="polite"')
            with ui.element("div").classes("buttons"):
                self._start = tool("Calibrate", "calibrate", self.start)
                self._remove_file = button("Remove the file", "measured-remove", self._file_removed)
            self._job = JobBox(session, self._done, lambda error: self.refuse(str(error)))
            self._message = ui.label().classes("hint").props('role="status" data-testid="calibrate-message"')
            say(self._message, "")
        self._fill()

    @property
    def _given(self) -> bool:
        """Whether the present inputs have measured values."""
        return self._session.inputs.value(MEASURED) is not None

    @property
    def _file(self) -> str | None:
        file = self._session.inputs.value(MEASURED_FILE)
        return file if isinstance(file, str) else None

    def close(self) -> None:
        """Want no further answers."""
        self._checked.drop()

    def refresh(self) -> None:
        """Show the measured values of the present inputs, as after an undo, and their calibration."""
        self._fill()
        known = self._results.get(self._session.inputs.toml())
        latest = next(reversed(self._results.values()), None) if self._given else None
        self._show(known or latest, "" if known else self._texts["earlier"])

    def _fill(self) -> None:
        inputs = self._session.inputs
        if self._given and not self._had:
            self._group.turn(opened=True)
        self._had = self._given
        self._fields = measured_fields(self._kind, inputs)
        given = [name for name in self._fields if inputs.value(f"{MEASURED}.{name}") is not None]
        self._begun = [name for name in self._begun if name not in given]
        names = [name for name in self._fields if name in given or name in self._begun]
        fields = [self._fields[name] for name in names]
        if fields != self._built:
            self._built = fields
            self._place.clear()
            with self._place:
                self._rows = {name: self._row(name) for name in names}
        for name, pair in self._rows.items():
            for control, text in zip(pair, measured_text(inputs, name), strict=True):
                control.show(text=shown_text(self._fields[name], text), error="")
        others = {name: field.label for name, field in self._fields.items() if name not in names}
        entries = {"": "choose a quantity", **others}
        options = [{"value": name, "label": label, "group": ""} for name, label in entries.items()]
        self._add.show(options=options, shown=bool(others))
        self._add.turn(text="")
        self._remove_file.set_visibility(self._file is not None)
        self._start.set_visibility(self._given and self._running is None)
        say(self._error, "")
        if not self._given:
            self._checked.drop()
            say(self._used, "")
        elif self._file is not None and self._session.path_of(self._file) is None:
            self._checked.drop()
            self.refuse(f"{LOST_FILE}, or remove the file.")
        else:
            self._checked.ask(inputs)

    def _row(self, name: str) -> tuple[Control, Control]:
        """Fields of a value and its uncertainty."""
        field = self._fields[name]
        unit = printed(field.unit) if field.unit else ""
        with ui.element("div").classes("measured-row"):
            value = Control(field.key, kind="text", label=field.label, help=field.help, unit=unit)
            part = Control(f"{field.key}.uncertainty", kind="text", label="± uncertainty")
            remove = button(
                "Remove", f"remove-measured-{name}", partial(self._removed, name), "flat dense no-caps"
            )
            remove.props["aria-label"] = f"Remove {field.label.lower()}"
        value.show(placeholder=unit or "number")
        part.show(placeholder="not given")

        async def value_typed(event: Any) -> None:
            await self._put(name, with_value(self._session.inputs, name, field, str(event.args)))
            value.turn()

        async def part_typed(event: Any) -> None:
            if measured_text(self._session.inputs, name)[0]:
                text = str(event.args)
                await self._put(name, with_uncertainty(self._session.inputs, name, field, text))
            part.turn()

        value.on("commit", value_typed)
        part.on("commit", part_typed)
        return value, part

    async def _put(self, name: str, text: str | None) -> None:
        if text is None:
            self._begun.append(name)
        await self._change({f"{MEASURED}.{name}": text})

    async def _removed(self, name: str) -> None:
        self._begun = [other for other in self._begun if other != name]
        await self._change({f"{MEASURED}.{name}": None})
        self._fill()

    def _added(self, event: Any) -> None:
        name = str(event.args)
        if name in self._fields and name not in self._rows:
            self._begun.append(name)
            self._fill()
            self._rows[name][0].focus()

    async def _upload(self, name: str) -> None:
        await self._change({MEASURED_FILE: name})

    async def _file_removed(self) -> None:
        await self._change({MEASURED_FILE: None})

    async def _check(self, inputs: Inputs) -> str:
        table = dict(inputs.table)
        return await self._session.work.quick(CALIBRATION_CHECKED, table, self._session.made_folder)

    def _accept(self, text: str) -> None:
        """Show how many measured values there are."""
        if self._file is not None:
            text = f"{self._session.name_of(self._file)}: {text} {NOT_IN_LINKS}"
        say(self._used, text)
        self._start.set_enabled(True)

    def _refuse(self, error: Exception) -> None:
        """Show why the measured values cannot be used; errors of other inputs are in their fields."""
        say(self._used, "")
        self._start.set_enabled(False)
        key = getattr(error, "key", None) or ""
        # A name of the inputs may have quotes, which the key of an error has not.
        keys = {field.key.replace('"', ""): name for name, field in self._fields.items()}
        name = keys.get(key, "")
        pair = self._rows.get(name)
        of_file = self._file is not None and str(self._session.path_of(self._file)) in str(error)
        if pair is not None and isinstance(error, InputError):
            self._show_wrong(name, pair, error)
            self._group.turn(opened=True)
        elif not key or key.startswith(MEASURED) or of_file:
            self.refuse(str(error))

    def _show_wrong(self, name: str, pair: tuple[Control, Control], error: InputError) -> None:
        """Show an error at the value, or at the uncertainty if only the uncertainty is wrong."""
        field, (value, part) = self._fields[name], measured_text(self._session.inputs, name)
        wrong = part and field.number(value) is not None and not is_uncertainty(field, part)
        pair[bool(wrong)].show(error=in_field_unit(field, error.text))

    def refuse(self, text: str) -> None:
        """Show why there is no calibration; a file with the name that its user gave."""
        say(self._error, self._session.named(text))
        self._group.turn(opened=True)

    def start(self) -> None:
        """Calibrate the present inputs."""
        inputs = self._session.inputs
        if self._job.start(CALIBRATED, dict(inputs.table), self._session.folder):
            self._running = inputs
            say(self._message, "")
            say(self._error, "")
            self._start.set_visibility(False)

    def _done(self, job: Job) -> None:
        inputs, self._running = self._running, None
        if job.state == "done" and inputs is not None:
            key = inputs.toml()
            self._results = {**{k: v for k, v in self._results.items() if k != key}, key: job.result}
            for first in [*self._results][:-_KEPT]:
                del self._results[first]
        self.refresh()
        if job.state == "done":
            ui.run_javascript(_TO_RESULT)
        elif job.state == "cancelled":
            say(self._message, self._texts["cancelled"])
        elif isinstance(job.error, InputError) and job.error.key:
            self._refuse(job.error)
            if not self._error.visible:
                say(self._message, self._session.named(f"{self._texts['failed']}: {job.error}"))
        else:
            say(self._message, self._session.named(f"{self._texts['failed']}: {job.error}"))


class CalibrationView:
    """Place of the calibration of a page: the verdict, and the ranges before and after the measurement.

    ``use`` is called with the inputs with the updated ranges.
    """

    def __init__(self, session: Session, use: Callable[[Inputs], None]) -> None:
        self._session, self._use = session, use
        self._texts = page_texts("calibration")
        self._answer: CalibrationAnswer | None = None
        with ui.element("section").classes("calibration").props('aria-label="Calibration"') as self.body:
            self.body.props('data-testid="calibration"')
        self._built = False
        self.body.set_visibility(False)

    def _build(self) -> None:
        """Build the parts of the place, which a page without a calibration does not have."""
        self._built = True
        heading(self._texts["after"], 2)
        self._state = ui.label().classes("notice").props('role="status" data-testid="calibration-state"')
        with ui.element("div").classes("calibration") as self._result:
            self._verdict = VerdictBox("calibration-verdict")
            self._verdict.build_sentences()
            self._chances = ui.html("", sanitize=False).props('data-testid="calibration-chances"')
            self._warnings = ui.html("", sanitize=False)
            with ui.element("div").classes("buttons") as self._actions:
                button("Use the updated ranges", "use-calibrated", self._taken, "no-caps dense")
                button("Updated case (TOML)", "download-calibrated", self._saved, "no-caps dense")
            with ui.element("div").classes("figures"):
                self._figures = {name: FigureBox(f"calibration-{name}") for name in _FIGURES}
            self._tables = ui.html("", sanitize=False).props('data-testid="calibration-tables"')

    def show(self, answer: CalibrationAnswer | None, state: str) -> None:
        """Show a calibration, with a sentence on its ``state`` if it is of earlier inputs; None hides the
        place.
        """
        self.body.set_visibility(answer is not None)
        if answer is None:
            return
        if not self._built:
            with self.body:
                self._build()
        say(self._state, state)
        mark(self._result, "stale", on=bool(state))
        if answer is self._answer:
            return
        self._answer = answer
        self.body.props["data-explained"] = str(answer.explained).lower()
        self.body.update()
        self._verdict.show(answer.verdict, "" if answer.explained else self._texts["unexplained"])
        chances = answer.chances
        self._chances.content = "" if chances is None else table_html(chances)
        self._warnings.content = "".join(note_html(Note(warning)) for warning in answer.warnings)
        for place in (self._chances, self._warnings):
            place.set_visibility(bool(place.content))
        self._actions.set_visibility(answer.updated is not None)
        for name, figure in self._figures.items():
            figure.show(answer.figures.get(name))
        inputs = answer.inputs
        ranges = "" if inputs is None else behind("Ranges of the inputs before and after", table_html(inputs))
        compared = behind("Measured and computed values", table_html(answer.compared))
        self._tables.content = f"{ranges}{compared}"

    def _taken(self) -> None:
        if self._answer is not None and self._answer.updated is not None:
            self._use(Inputs(self._answer.updated))

    def _saved(self) -> None:
        if self._answer is not None and self._answer.updated is not None:
            inputs = Inputs(self._answer.updated)
            name = f"{file_title(inputs.value('title'))}-calibrated.toml"
            ui.download.content(inputs.toml().encode(), name)
