"""Frame and toolbar of every page: links, undo and redo, opened files, and the inputs with which pages
begin.
"""

from __future__ import annotations

import json
from collections.abc import Awaitable, Callable, Iterator, Mapping
from contextlib import contextmanager
from functools import cache
from importlib import resources
from pathlib import Path
from typing import Any, Protocol

from nicegui import Client, events, ui

from ehlectric.app.calls import FILES_UPLOADED
from ehlectric.app.form_fields.drive_fields import times
from ehlectric.app.form_fields.field import form_data
from ehlectric.app.form_fields.field_rules import changed
from ehlectric.app.page_inputs import LONGEST_QUERY, Inputs, example_inputs
from ehlectric.app.pages.page_parts import ThemeButton, brief, heading, page_texts, script, tool, weakly
from ehlectric.app.session import Session
from ehlectric.app.view_models import MOST_CASE, MOST_FILES, MOST_SURFACE, Uploaded
from ehlectric.app.work import Work
from ehlectric.errors import InputError, LostError
from ehlectric.quantities.inputs import REPLACED, SPEED, TEMPERATURE
from ehlectric.quantities.units import in_unit

BEARING = example_inputs("bearing_6208")

# The way to the films stands in the table of the drive, where the form offers it for both bearings.
DRIVE = example_inputs("drive").changed({"drive_end.contacts": None, "drive.contacts": "atlas"})

GEAR = example_inputs("gear_pair")


def _axle() -> Inputs:
    """Axle of the example, whose meshes contain the tables of their gear files."""
    axle = example_inputs("e_axle")
    meshes = [
        {key: value for key, value in mesh.items() if key != "file"}
        | {"pair": dict(example_inputs(Path(mesh["file"]).stem).table)}
        for mesh in axle.value("mesh")
    ]
    return axle.changed({"mesh": meshes})


AXLE = _axle()


# First values of pages, all assumptions.
_FIRST = form_data("first_values")

# Tables of a bearing that a drive does not take over: of its title and its margin, and of the motor, whose
# capacitances go into the circuit.
_COMMON_MODE = "motor.common_mode_voltage"
_NOT_OF_DRIVES = ("title", "contacts", "ranges", "motor")


def drive_with(bearing: Inputs) -> Inputs:
    """Drive of the example with a bearing at both ends, at its speed, temperature and common-mode voltage.

    Raises InputError for a common-mode voltage that is no single value.
    """
    end = bearing.changed({**dict.fromkeys(_NOT_OF_DRIVES), "discharge.peak_current": None})
    strength = {} if end.value("discharge") else _FIRST["strength"]
    changes = {
        "drive_end": dict(end.changed(strength).table),
        **{REPLACED[key]: bearing.value(key) for key in (SPEED, TEMPERATURE)},
        "title": bearing.value("title"),
    }
    motor = {theirs: bearing.value(key) for key, theirs in form_data("motor_in_drive").items()}
    common_mode = bearing.value(_COMMON_MODE)
    if isinstance(common_mode, int | float):
        common_mode = f"{common_mode} V"
    if common_mode is not None:
        # The largest common-mode voltage of an inverter is half of its DC link.
        motor["source.dc_link"] = times(common_mode, 2.0)
        if in_unit(str(common_mode), "V") is None:
            raise InputError(_COMMON_MODE, got=str(common_mode), takes="one value with its unit for a drive")
    given = {key: value for key, value in motor.items() if value is not None}
    return changed(DRIVE, changes | given)


def contact_start(geometry: str) -> Inputs:
    """Inputs with which the page of a line contact or of a point contact begins, with an assumed strength."""
    if geometry == "point":
        return example_inputs("ball_contact").changed({**_FIRST["strength"], **_FIRST["point_domain"]})
    return example_inputs("line_contact").changed(_FIRST["strength"])


SWEEP = Inputs({"case": dict(BEARING.changed({"contacts": "atlas"}).table), "vary": _FIRST["vary"]})


# Time in which the server answers with a page, also where many ask at once [s].
PAGE_PATIENCE = 30.0


@cache
def _styles() -> tuple[str, ...]:
    """Style sheets of the pages; the common one comes first, so that the others may add to it."""
    files = resources.files("ehlectric.app").joinpath("static").iterdir()
    sheets = {file.name: file.read_text(encoding="utf-8") for file in files if file.name.endswith(".css")}
    return tuple(sheets[name] for name in sorted(sheets, key=lambda name: (name != _COMMON, name)))


_COMMON = "ehlectric.css"


@contextmanager
def framed(title: str, here: str) -> Iterator[None]:
    """Context in which the main part of a page is built."""
    for style in _styles():
        ui.add_css(style)
    with ui.element("header").classes("head"):
        ui.link("ehlectric", "/").classes("name")
        with ui.element("nav").props('aria-label="Pages"'):
            for address, name in page_texts("links").items():
                link = ui.link(name, address)
                if address == here:
                    link.props('aria-current="page"')
        ThemeButton()
    with ui.element("main").classes("page").props('tabindex="-1"') as main:
        ui.skip_link(target=main)
        heading(title, 1)
        yield


# Session of each tab, for the parts of its page. A session refers to parts of the page that it informs of
# changes, and with them to its tab; it is removed when the tab ends.
_SESSIONS: dict[Client, Session] = {}


def session_here() -> Session | None:
    """Session of the present tab; None before it has one."""
    return _SESSIONS.get(ui.context.client)


def session_of(work: Work, inputs: Inputs) -> Session:
    """Session of the present tab, which ends with it."""
    session, client = Session(work, inputs), ui.context.client
    _SESSIONS[client] = session

    def end() -> None:
        del _SESSIONS[client]
        session.close()

    client.on_delete(end)
    return session


async def connected() -> bool:
    """Wait until a browser shows the present page; False where its tab was closed meanwhile.

    An answer to a closed tab would make the folder of its session again.
    """
    client = ui.context.client
    await client.connected()
    return not client.is_deleted


def show_address(inputs: Inputs, path: str) -> None:
    """Put the inputs into the address of the page; one that cannot hold them stays as it is."""
    if inputs.linkable:
        ui.navigate.history.replace(address_of(path, inputs))


# Called after the inputs changed in another way than by the form.
Show = Callable[[], Awaitable[None] | None]


class Report(Protocol):
    """Shows a text of the program, or an error."""

    def __call__(self, text: str = "", *, error: str = "") -> None:
        """Show both."""


# Pages of the kinds of files.
PATHS = {
    "bearing": "/",
    "drive": "/drive",
    "gear": "/gear",
    "axle": "/axle",
    "contact": "/contact",
    "motion": "/contact",
    "sweep": "/sweep",
}

# Time in which the browser answers, also where it draws figures without a graphics card [s].
_ANSWER = 60.0


def address_of(path: str, inputs: Inputs) -> str:
    """Address of a page with inputs."""
    return f"{path}?{inputs.address()}"


class OpenFile:
    """Button that opens a case with the files that it names, and the element that takes them up.

    Parameters
    ----------
    test
        Name of the element for tests, after "upload-".
    opened
        Takes the case up.
    report
        Shows a text, or an error.
    """

    def __init__(
        self, session: Session, test: str, opened: Callable[[Uploaded], Awaitable[None]], report: Report
    ) -> None:
        self._session, self._opened, self._report = session, opened, report
        # Opened files, and those that the case among them names and that are not there yet.
        self._pending: dict[str, bytes] = {}
        self._missing: tuple[str, ...] = ()
        self._upload = ui.upload(
            multiple=True,
            auto_upload=True,
            max_file_size=MOST_SURFACE,
            max_files=MOST_FILES,
            on_multi_upload=weakly(self._uploaded),
            on_rejected=weakly(self._rejected),
            label="Case and surfaces",
        )
        self._upload.classes("out-of-sight").props(
            f'data-testid="upload-{test}" aria-hidden="true" tabindex="-1"'
        )
        open_file = ui.button("Open file").props(f'outline no-caps dense data-testid="open-{test}"')
        open_file.tooltip(
            "A case, bearing, drive, axle, gear or sweep file (TOML), with the files that it names"
        )
        open_file.on("click", js_handler=f"() => getElement({self._upload.id}).$refs.qRef.pickFiles()")

    def _rejected(self, _: events.UiEventArguments) -> None:
        """Say why the browser sends no file."""
        self._report(
            error=f"a file is too large; expected a case of at most {MOST_CASE // 1000} kB, "
            f"surfaces of at most {MOST_SURFACE // 1_000_000} MB"
        )

    async def _uploaded(self, event: events.MultiUploadEventArguments) -> None:
        """Take up files: a case, or those that the case opened before names."""
        self._upload.reset()
        contents = {file.name: await file.read() for file in event.files}
        self._pending = {**self._pending, **contents} if set(contents) & set(self._missing) else contents
        await self._read()

    async def _read(self) -> None:
        """Read the opened files, and ask for those that are missing."""
        work = self._session.work
        try:
            uploaded = await work.quick(FILES_UPLOADED, self._pending, self._session.folder)
        except (InputError, LostError) as error:
            self._pending, self._missing = {}, ()
            self._report(error=str(error))
            return
        self._missing = uploaded.missing
        if uploaded.missing:
            self._report(f"{uploaded.name} names {', '.join(uploaded.missing)}: open it as well.")
            return
        self._pending = {}
        await self._opened(uploaded)


class Toolbar:
    """Toolbar of a page, at the place where it is made."""

    def __init__(self, session: Session, path: str, show: Show, *, opens: bool = True) -> None:
        self.session, self._path, self._show = session, path, show
        ui.add_body_html(f"<script>{script('undo_keys')}</script>")
        with ui.element("div").classes("toolbar").props('role="toolbar" aria-label="Case"'):
            self._undo = _button("Undo", "undo", self.undo, "Control+Z")
            self._redo = _button("Redo", "redo", self.redo, "Control+Shift+Z")
            _button("Copy link", "copy-link", self.copy_link)
            if opens:
                if path not in (PATHS["drive"], PATHS["gear"]):
                    _button("Compare", "compare", self.compare)
                if path != PATHS["sweep"]:
                    _button("Vary", "vary", self.vary)
                if path == PATHS["bearing"]:
                    _button("In its drive", "in-drive", self.in_drive)
                self._file = OpenFile(session, "case", self._opened, self._tell)
            self._link = ui.input("Link to this page").props('readonly dense outlined data-testid="link"')
            self._link.classes("link").set_visibility(False)
            self._status = ui.label().classes("told-status").props('role="status"')
            self._toast = ui.label().classes("toast").props('role="status" data-testid="toast"')
            self._error = ui.label().classes("wrong").props('role="alert" data-testid="error-file"')
        session.history.listeners.append(self._look)
        self._look()

    async def undo(self) -> None:
        """Go back to the inputs before."""
        self.session.history.undo()
        await self._changed("Undone")

    async def redo(self) -> None:
        """Take back an undo."""
        self.session.history.redo()
        await self._changed("Redone")

    async def copy_link(self) -> None:
        """Copy the address of the page with its inputs, and show it."""
        if not self.session.inputs.linkable:
            self._tell(error=f"no link holds these inputs: it has more than {LONGEST_QUERY} characters")
            return
        address = address_of(self._path, self.session.inputs)
        copying = f"return await ({script('copy_link')})({json.dumps(address)})"
        answer = await ui.run_javascript(copying, timeout=_ANSWER)
        if answer is None:  # The tab was closed meanwhile.
            return
        self._link.value, copied = answer
        self._link.set_visibility(True)
        brief(self._toast, "Link copied" if copied else "Copy the link from the field.")
        if not copied:
            self._link.run_method("select")

    def compare(self) -> None:
        """Open the page that compares, with this case on both sides."""
        table = self._case.table
        case = table.get("case", table)
        if "drive_end" in case:
            self._tell(error="drives are compared on the page Drive, with mitigation measures")
            return
        case = compared_part(case)
        self._go("/compare", Inputs({"a": case, "b": case}))

    def vary(self) -> None:
        """Open the page of sweeps with this case."""
        self._go("/sweep", Inputs({"case": dict(self._case.table)}))

    def in_drive(self) -> None:
        """Open the page of drives with this bearing at both ends."""
        try:
            drive = drive_with(self._case)
        except InputError as error:
            self._tell(error=str(error))
        else:
            self._go(PATHS["drive"], drive)

    @property
    def _case(self) -> Inputs:
        """Inputs for other pages, which have no duty cycle and no measured values."""
        return self.session.inputs.changed({"duty": None, "measured": None})

    def _go(self, path: str, inputs: Inputs) -> None:
        """Open another page with inputs; files stay in the session of this one."""
        if _has_files(self._case.table):
            self._tell(error="the case has data from files, which other pages do not have: open it there")
        elif not inputs.linkable:
            self._tell(error="the case is too long for an address; open its file on the other page")
        else:
            ui.navigate.to(address_of(path, inputs))

    async def _opened(self, uploaded: Uploaded) -> None:
        """Show an opened case on its page."""
        inputs, path = Inputs(uploaded.table), PATHS[uploaded.kind]
        if path == self._path:
            self.session.history.push(inputs)
            await self._changed(f"{uploaded.name} is open.")
        elif _has_files(uploaded.table):
            self._tell(error=f"{uploaded.name} names files and belongs to the page {path}: open them there")
        elif not inputs.linkable:
            self._tell(error=f"{uploaded.name} belongs to the page {path}: open it there")
        else:
            ui.navigate.to(address_of(path, inputs))

    async def _changed(self, text: str) -> None:
        """Show changed inputs, and put them into the address."""
        show_address(self.session.inputs, self._path)
        brief(self._toast, text)
        showing = self._show()
        if showing is not None:
            await showing

    def _tell(self, text: str = "", *, error: str = "") -> None:
        self._status.text, self._error.text = text, error

    def _look(self) -> None:
        """Enable the buttons that can be used, and remove messages on earlier inputs."""
        self._tell()
        brief(self._toast, "")
        self._link.set_visibility(False)
        history = self.session.history
        self._undo.set_enabled(bool(history.before))
        self._redo.set_enabled(bool(history.after))


def compared_part(case: Mapping[str, Any]) -> dict[str, Any]:
    """Return the tables of a case that are compared: one operating point, without mitigation measures."""
    return {key: value for key, value in case.items() if key not in ("duty", "measured", "remedies")}


def _has_files(table: Mapping[str, Any]) -> bool:
    """Whether a case, or the case of a sweep, has data from files, which stay in their session."""
    case = table.get("case", table)
    named = [case.get(name) for name in ("source", "duty", "measured")] if isinstance(case, Mapping) else []
    if any(isinstance(part, Mapping) and "file" in part for part in named):
        return True
    rough = case.get("roughness") if isinstance(case, Mapping) else None
    return isinstance(rough, list) and any(isinstance(part, Mapping) and "file" in part for part in rough)


def _button(name: str, test: str, click: Callable[[], Any], keys: str = "") -> ui.button:
    """Button of the toolbar, with its keyboard shortcuts."""
    button = tool(name, test, click)
    return button.props(f'aria-keyshortcuts="{keys}"').tooltip(keys) if keys else button
