"""Box of the rough surfaces of a contact: uploaded or made, and shown step by step before they are used."""

from __future__ import annotations

from collections.abc import Awaitable, Callable, Mapping, Sequence
from typing import Any

from nicegui import ui

from ehlectric.app.calls import SURFACE
from ehlectric.app.form_fields.contact_fields import geometry_of
from ehlectric.app.page_inputs import Inputs
from ehlectric.app.pages.file_field import LOST_FILE, NOT_IN_LINKS, UploadField
from ehlectric.app.pages.page_parts import (
    Control,
    GroupBox,
    JobBox,
    Plot,
    button,
    control,
    follow,
    heading,
    say,
)
from ehlectric.app.pages.result_parts import show_warnings, table_html
from ehlectric.app.roughness_keys import (
    FILE_KEYS,
    FIRST_VALUES,
    GENERATOR_KEYS,
    GENERATOR_NAMES,
    PLACE_KEYS,
    STEP_KEYS,
    STEPPED,
    RoughKey,
    value_of,
)
from ehlectric.app.session import Session
from ehlectric.app.view_models import SummitsTable, SurfaceAnswer, Table
from ehlectric.app.work import Job
from ehlectric.errors import InputError, LostError
from ehlectric.readable import capital

Changed = Callable[[str, Any], Awaitable[None]]


class Keys:
    """Fields of a table; ``changed`` is called with a key and its new value, None for an empty field."""

    def __init__(
        self, table: str, keys: Sequence[RoughKey], values: Mapping[str, Any], changed: Changed
    ) -> None:
        self._table, self._changed = table, changed
        self._fields: dict[str, Control] = {}
        with ui.element("div").classes("key-fields"):
            for key in keys:
                self._fields[key.key] = self._field(key, values.get(key.key))

    def tell(self, error: Exception | None) -> bool:
        """Show an error next to its field, and remove others; False where no field here has its key."""
        name = str(getattr(error, "key", None) or "").removeprefix(f"{self._table}.")
        for key, field in self._fields.items():
            field.show(error=str(error) if error is not None and key == name else "")
        return name in self._fields

    def _field(self, key: RoughKey, value: Any) -> Control:
        async def typed(text: str) -> None:
            field.turn(text=text)
            await self._changed(key.key, value_of(key, text))

        kind = "list" if key.choices else "text"
        field = control(f"{self._table}-{key.key}", key.label, typed, key.choices or None, kind=kind)
        text = "true" if value is True else "" if value is None else str(value)
        field.show(text=text or next(iter(key.choices), ""))
        field.show(placeholder=f"for example {key.example}" if key.example else "")
        return field


def show_surface(answer: SurfaceAnswer) -> None:
    """Show a surface with its steps, its summits and warnings."""
    ui.label(_sentence(answer)).props('data-testid="surface-size"')
    if answer.rows:
        table = Table("Statistics", answer.heads, answer.rows)
        ui.html(table_html(table, "surface-statistics"), sanitize=False)
    show_warnings(answer.warnings)
    if answer.summits is not None:
        _show_summits(answer.summits)
    with ui.element("div").classes("steps"):
        for step in answer.figures:
            with ui.element("div"):
                heading(step.name, 3)
                Plot(step.figure, step.label)


def _show_summits(summits: SummitsTable) -> None:
    """Table of the summits, which bearings and models of asperities take."""
    title = capital(summits.title)
    table = Table(title, summits.heads, summits.rows)
    ui.html(table_html(table, "surface-summits"), sanitize=False)
    ui.label(summits.note).classes("soft")


def _sentence(answer: SurfaceAnswer) -> str:
    if not answer.rows:
        return "Exact shape, drawn over the domain of the contact."
    first, last = answer.rows[0], answer.rows[-1]
    name = answer.heads[2].split("\n")[0]
    parts = [answer.size, f"{name} {first[2]} nm {first[0]}"]
    if len(answer.rows) > 1:
        parts.append(f"{last[2]} nm as used")
    if answer.lines:
        parts.append(f"{answer.lines['row']} rows and {answer.lines['column']} columns in the file")
    return "; ".join(parts)


# Size of a file from which a process of its own reads it [bytes]; smaller ones take a second at most.
_LARGE = 4_000_000

_SURFACE = RoughKey("surface", "Surface of the contact", choices={"1": "1, the lower", "2": "2, the upper"})
_SOURCE = RoughKey("source", "Surface", choices={"file": "from an instrument's file"} | dict(GENERATOR_NAMES))


class RoughnessBox:
    """Box in which rough surfaces are uploaded or made, processed, and put into the inputs."""

    def __init__(self, session: Session, changed: Callable[[], Awaitable[None]]) -> None:
        self._session, self._changed = session, changed
        self._draft: dict[str, Any] = {"surface": 1}
        self._parts: list[Keys] = []
        self._groups: dict[Keys, GroupBox] = {}
        self._answer: SurfaceAnswer | None = None
        # Numbers of the last look, and of that for which a job reads a large file.
        self._looks = self._look_of_job = 0
        # Inputs to which the note belongs.
        self._noted: Inputs | None = None
        with ui.element("div").classes("box").props('data-testid="roughness"'):
            self._used = ui.element("div").classes("box").props('aria-live="polite"')
            self._note = ui.label().classes("hint").props('role="status" data-testid="roughness-note"')
            self._editor = ui.element("div").classes("box")
            self._message = ui.label().classes("error").props('role="alert" id="roughness-error"')
            self._message.props('data-testid="error-roughness"')
            self._job = JobBox(session, self._ended, self._tell)
            self._view = ui.element("div").classes("box").props('aria-live="polite" data-testid="surface"')
            with ui.element("div").classes("buttons"):
                self._use = button("Use this surface", "use-surface", self._put, primary=True)
        self._tell(None)
        self._use.disable()
        self._edit()
        self.refresh()

    def refresh(self) -> None:
        """Show the rough surfaces of the present inputs, as after an undo."""
        if self._point != self._is_point():
            self._edit()
        if self._noted != self._session.inputs:
            self._note.text = ""
        self._used.clear()
        with self._used:
            tables = _tables(self._session)
            if not tables:
                ui.label("Both surfaces are smooth.").classes("muted").props('data-testid="surfaces-used"')
            for table in tables:
                self._show_used(table)

    def _show_used(self, table: Mapping[str, Any]) -> None:
        file = table.get("file")
        lost = isinstance(file, str) and self._session.path_of(file) is None
        with ui.element("div").classes("used"):
            text = f"Surface {table.get('surface', '?')}: {self._description(table)}"
            ui.label(text).props('data-testid="surfaces-used"')
            button("Remove", f"remove-surface-{table.get('surface', 0)}", lambda: self._remove(table))
            if not lost:
                ui.button("Change", on_click=lambda: self._reopen(table), color=None).props("flat no-caps")
        if lost:
            ui.label(f"{LOST_FILE}, or remove the surface.").classes("error").props('role="alert"')
        elif isinstance(file, str):
            ui.label(NOT_IN_LINKS).classes("hint")

    def _is_point(self) -> bool:
        return geometry_of(self._session.inputs) == "point"

    def _description(self, table: Mapping[str, Any]) -> str:
        if isinstance(table.get("file"), str):
            source = self._session.name_of(table["file"])
        else:
            source = GENERATOR_NAMES.get(str(table.get("generator")), str(table.get("generator")))
        named = ("surface", "file", "generator")
        shown = (f"{key} {value}" for key, value in table.items() if key not in named)
        return ", ".join([source, *shown])

    def _edit(self) -> None:
        """Build the fields for the kind of surface of the draft."""
        self._editor.clear()
        self._parts, self._groups = [], {}
        point = self._point = self._is_point()
        generator = self._draft.get("generator")
        values = {**self._draft, "source": generator or "file"}
        with self._editor:
            self._parts.append(Keys("roughness", (_SOURCE, _SURFACE), values, self._set))
            if generator is None:
                UploadField(self._session, self._take, self._refuse)
                file = self._draft.get("file")
                ui.label(f"File: {self._session.name_of(file)}" if file else "No file yet.").classes("muted")
                ui.label(
                    "The server keeps the file in a folder that is removed when this tab is closed. The "
                    "address of the page cannot hold it; the downloaded case comes with it."
                ).classes("hint")
                self._group("Units and lines of the file", FILE_KEYS, point=point)
            else:
                keys = GENERATOR_KEYS[generator]
                self._group("Heights (values at first are assumptions)", keys, point=point, opened=True)
            if generator is None or generator in STEPPED:
                self._group("Form and filter", STEP_KEYS, point=point, opened=True)
            self._group("Place in the contact", PLACE_KEYS, point=point)

    def _group(self, title: str, keys: Sequence[RoughKey], *, point: bool, opened: bool = False) -> None:
        shown = [key for key in keys if point or not key.point]
        opened = opened or any(key.key in self._draft for key in shown)
        with GroupBox(title, opened=opened, first=True) as group:
            part = Keys("roughness", shown, self._draft, self._set)
        self._parts.append(part)
        self._groups[part] = group

    async def _set(self, key: str, value: Any) -> None:
        if key == "source":
            surface = self._draft["surface"]
            self._draft = {"surface": surface}
            if value is not None:
                self._draft |= {"generator": value, **FIRST_VALUES[value]}
            self._edit()
        elif key == "surface":
            self._draft["surface"] = 1 if value is None else int(value)
        elif value is None:
            self._draft.pop(key, None)
        else:
            self._draft[key] = value
        await self._look()

    async def _take(self, name: str) -> None:
        """Show an uploaded file of the folder of the session."""
        # The file of an instrument has the tilt of the sample, which is no roughness.
        self._draft = {"form": "line"} | {
            key: value for key, value in self._draft.items() if key != "generator"
        }
        self._draft["file"] = name
        self._edit()
        await self._look()

    def _refuse(self, text: str) -> None:
        self._tell(InputError.worded(None, text))

    async def _look(self) -> None:
        """Show the surface of the draft; an answer that comes after newer values is dropped."""
        self._looks += 1
        look = self._looks
        self._job.cancel()
        if "file" not in self._draft and "generator" not in self._draft:
            self._show(None)
            return
        follow(self._view, on=self._answer is not None)
        self._use.disable()
        file = self._draft.get("file", "")
        path = self._session.path_of(file) if file else None
        inputs, folder = dict(self._session.inputs.table), str(self._session.folder)
        values = dict(self._draft), inputs, folder, self._session.name_of(file) if file else ""
        if path is not None and path.stat().st_size > _LARGE:
            self._look_of_job = look
            self._job.start(SURFACE, *values)
            return
        try:
            answer = await self._session.work.quick(SURFACE, *values)
        except (InputError, LostError) as error:
            if look == self._looks:
                self._fail(error)
            return
        if look == self._looks:
            self._show(answer)

    def _ended(self, job: Job) -> None:
        if self._look_of_job != self._looks:
            return
        if job.state == "done":
            self._show(job.result)
        else:
            self._fail(job.error or LostError("cancelled"))

    def _fail(self, error: Exception) -> None:
        self._show(None)
        self._tell(error)

    def _show(self, answer: SurfaceAnswer | None) -> None:
        self._answer = answer
        self._tell(None)
        self._use.set_enabled(answer is not None)
        follow(self._view, on=False)
        self._view.clear()
        if answer is not None:
            with self._view:
                show_surface(answer)

    def _tell(self, error: Exception | None) -> None:
        showing = [part for part in self._parts if part.tell(error)]
        for part in showing:
            if part in self._groups:
                self._groups[part].turn(opened=True)
        say(self._message, "" if error is None or showing else str(error))
        if error is not None:
            self._use.disable()

    async def _put(self) -> None:
        """Put the surface of the draft into the inputs, instead of the previous surface of this body."""
        if self._answer is not None:
            kept = [
                table for table in _tables(self._session) if table.get("surface") != self._draft["surface"]
            ]
            await self._give(sorted([*kept, dict(self._draft)], key=lambda table: int(table["surface"])))

    async def _remove(self, table: Mapping[str, Any]) -> None:
        await self._give([other for other in _tables(self._session) if other != table])

    async def _reopen(self, table: Mapping[str, Any]) -> None:
        self._draft = dict(table)
        self._edit()
        await self._look()

    async def _give(self, tables: list[Any]) -> None:
        """Put other rough surfaces into the inputs; nothing moves without one."""
        changes: dict[str, Any] = {"roughness": tables or None}
        stops = not tables and self._session.inputs.value("motion") is not None
        if stops:
            changes["motion"] = None
        self._session.history.push(self._session.inputs.changed(changes))
        self.refresh()
        if stops:
            self._noted = self._session.inputs
            self._note.text = "The motion is removed, too: it needs a rough surface."
        await self._changed()


def _tables(session: Session) -> list[Any]:
    """Tables of rough surfaces in the inputs."""
    tables = session.inputs.value("roughness")
    return [table for table in tables if isinstance(table, Mapping)] if isinstance(tables, list) else []
