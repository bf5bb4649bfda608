"""Downloads of a page: its case, the files and figures as the command writes them, and a report."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any, Literal

from nicegui import ui

from ehlectric.app.calls import FILES_CONVERTED, FILES_DRAWN, FILES_PACKED, FILES_WRITTEN
from ehlectric.app.page_inputs import Inputs
from ehlectric.app.pages.page_parts import JobBox, card, page_texts, tool
from ehlectric.app.session import Session
from ehlectric.app.view_models import Download, Written, file_title
from ehlectric.app.work import Job
from ehlectric.cases.defaults import quick_way
from ehlectric.errors import InputError, LostError

# Downloads from a folder of results, and what is made from a result: data-testid, words, and kind or ending.
_FILES: list[tuple[str, str, Download]] = page_texts("downloads")["files"]
_MADE: list[tuple[str, str, str]] = page_texts("downloads")["made"]

# Forms that only the results of contacts have.
_OF_CONTACTS = ("vtkhdf",)

# Downloads that need figures.
_DRAWN: tuple[Download, ...] = ("figures", "all")

# Commands that solve the kinds of files.
_COMMANDS = {
    "bearing": "bearing",
    "drive": "drive",
    "gear": "gear",
    "axle": "drive",
    "contact": "run",
    "sweep": "sweep",
}

# Kinds whose contacts a page takes from the atlas or a formula, whatever the file says, until it solves them.
_QUICK = ("bearing", "gear")


class Downloads:
    """Card with the downloads of a page, at the place where it is made.

    ``folder`` is called for the folder with a result of the present inputs; it returns None where the page
    has none, and then the files are made first. With ``only_made`` the card has only what is made from a
    result: reports, and files for other programs.

    The contacts in the files of a bearing or a gear pair are not solved, as its page shows them, unless there
    is a folder with solved contacts.
    """

    def __init__(
        self,
        session: Session,
        kind: Literal["bearing", "drive", "gear", "axle", "contact", "sweep"],
        folder: Callable[[], Path | None] = lambda: None,
        *,
        only_made: bool = False,
    ) -> None:
        self.session, self._kind, self._folder = session, kind, folder
        self._made: tuple[Inputs, Written] | None = None
        self._requested, self._job = session.inputs, Job("done")
        self._then: Callable[[Path], Any] | None = None
        self._command: ui.element | None = None
        with (
            card("Report, and files for other programs" if only_made else "Files and report"),
            ui.element("div").classes("downloads"),
        ):
            if not only_made:
                with ui.element("p"):
                    ui.label("The case runs with the command, with the same numbers to the last digit:")
                    self._command = ui.element("code")
            with ui.element("div").classes("buttons"):
                if not only_made:
                    self._file_buttons()
                for test, words, ending in _MADE:
                    if ending not in _OF_CONTACTS or kind == "contact":
                        tool(words, test, partial(self._with_files, partial(self._convert, ending)))
            self._box = JobBox(session, self._ended, lambda error: self._tell(error=str(error)))
            self._status = ui.label().classes("told-status").props('role="status"')
            self._error = ui.label().classes("wrong").props('role="alert" data-testid="error-download"')
        session.history.listeners.append(self.look)
        self.look()

    def _file_buttons(self) -> None:
        """Buttons of the case and of the files of its result."""
        tool("Case (TOML)", "download-toml", self.toml)
        for test, words, what in _FILES:
            tool(words, test, partial(self._with_files, partial(self._pack, what)))

    @property
    def title(self) -> str:
        """Name of the files without their ending."""
        inputs = self.session.inputs
        return file_title(inputs.value("title") or inputs.value("case.title"))

    @property
    def _quick(self) -> str:
        """Way to the contacts of the present inputs without solving them; empty where the case decides."""
        return quick_way(self.session.inputs.value("contacts")) if self._kind in _QUICK else ""

    def toml(self) -> None:
        """Download the inputs."""
        ui.download.content(self.session.inputs.toml(), f"{self.title}.toml", "application/toml")

    def look(self) -> None:
        """Say how the command solves the downloaded case with the numbers that the page shows now."""
        if self._command is None:
            return
        quick = self._quick
        options = f" --contacts {quick if self._folder() is None else 'solved'}" if quick else ""
        self._command.clear()
        with self._command:
            ui.label(f"ehlectric {_COMMANDS[self._kind]} {self.title}.toml{options}")

    async def _with_files(self, then: Callable[[Path], Any]) -> None:
        """Do something with the files of the present inputs, which are made first where there are none."""
        self.look()
        self._tell()
        if not self._job.over:
            self._tell("The files are being made.")
            return
        there = self._folder()
        if there is not None:
            self._requested = self.session.inputs
            await then(there)
            return
        if self._made is not None and self._made[0] == self.session.inputs:
            await then(Path(self._made[1].folder))
            return
        if self._kind == "sweep":
            self._tell(error="there are no files yet; run the sweep first")
            return
        # The folder of earlier files is written anew.
        self._made = None
        self._then, self._requested = then, self.session.inputs
        self._start(FILES_WRITTEN, dict(self.session.inputs.table), self._quick, self.session.folder)

    def _start(self, *call: Any) -> None:
        self._job = self._box.start(*call) or self._job

    async def _ended(self, job: Job) -> None:
        """Go on with the files of a job that is done."""
        if job.state == "failed":
            self._tell(error=str(job.error))
        elif job.state == "cancelled":
            self._tell("Cancelled.")
        elif isinstance(job.result, Written):
            self._made = (self._requested, job.result)
            if job.result.failure:
                self._tell(error=f"{job.result.failure}; the files state this, do not use these values")
            if self._then is not None:
                await self._then(Path(job.result.folder))
        else:
            self._offer(Path(job.result))

    async def _pack(self, what: Download, out: Path) -> None:
        """Download files of a folder of results, whose figures are drawn first where it has none."""
        call = (out, what, dict(self._requested.table), self.title, self.session.folder)
        if self._kind != "sweep" and what in _DRAWN and not any(out.glob("*.svg")):
            self._start(FILES_DRAWN, *call)
            return
        try:
            path = await self.session.work.quick(FILES_PACKED, *call)
        except (InputError, LostError) as error:
            self._tell(error=str(error))
        else:
            self._offer(Path(path))

    async def _convert(self, ending: str, out: Path) -> None:
        """Download a report on a folder of results, or its result in the form of another program."""
        self._start(FILES_CONVERTED, out, ending, self.title, self.session.folder)

    def _offer(self, path: Path) -> None:
        """Download a file of the session."""
        if not path.resolve().is_relative_to(self.session.folder.resolve()) or not path.is_file():
            self._tell(error="the file is no longer there; make it again")
            return
        ui.download.file(path, path.name)
        if not self._error.text:
            self._tell(f"{path.name} is downloaded.")

    def _tell(self, text: str = "", *, error: str = "") -> None:
        self._status.text, self._error.text = text, error
