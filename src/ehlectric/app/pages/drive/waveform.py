"""Field for the file of an oscilloscope, whose voltage takes the place of a described source."""

from __future__ import annotations

import shutil
from collections.abc import Awaitable, Callable
from typing import Any

from nicegui import events, ui

from ehlectric.app.pages.surfaces.upload import UploadField
from ehlectric.app.session import Session
from ehlectric.app.uploads import LARGEST, MOST_TOGETHER, SURFACES, new_file, own_file, shown_name

_KEY = "source.file"


class WaveformField:
    """Field for a measured common-mode voltage; build it in the group of the source.

    Parameters
    ----------
    session : Session
        Session of the tab.
    change : callable
        Called with changes of the inputs by dotted key.
    """

    def __init__(self, session: Session, change: Callable[[dict[str, Any]], Awaitable[None]]) -> None:
        self._session, self._change = session, change
        self._names: dict[str, str] = {}
        with ui.element("div").classes("box"):
            UploadField(
                self._take,
                self._refuse,
                name="waveform",
                label=f"Or a measured waveform: CSV of an oscilloscope, at most {LARGEST / 1e6:g} MB",
            )
            self._used = ui.label().classes("hint").props('data-testid="waveform-used"')
            self._error = ui.label().classes("error").props('role="alert" id="waveform-error"')
            self._error.props('data-testid="error-waveform"')
        self.refresh()

    def refresh(self) -> None:
        """Show the file of the present inputs, as after an undo."""
        file = self._session.inputs.value(_KEY)
        self._error.text = ""
        self._used.set_visibility(isinstance(file, str))
        if not isinstance(file, str):
            return
        self._used.text = (
            f"Measured: {self._names.get(file, shown_name(file))}. A link cannot hold the file; a download "
            "with everything has it."
        )
        folder = self._session.made_folder
        if folder is None or own_file(file, folder) is None:
            self._error.text = "This file was uploaded in another session. Upload it again."

    async def _take(self, event: events.UploadEventArguments) -> None:
        """Keep an uploaded file in the folder of the session, and take it as the source."""
        size, given, folder = event.file.size(), event.file.name, self._session.folder
        kept = sum(file.stat().st_size for file in folder.glob(f"{SURFACES}/*"))
        if size > LARGEST or kept + size > MOST_TOGETHER:
            limits = f"at most {LARGEST / 1e6:g} MB, and {MOST_TOGETHER / 1e6:g} MB of all uploaded files"
            self._refuse(f"{shown_name(given)}: has {size / 1e6:.4g} MB; expected {limits}")
            return
        name = new_file(given, folder)
        try:
            await event.file.save(folder / name)
        except OSError:
            (folder / name).unlink(missing_ok=True)
            self._refuse(f"{shown_name(given)}: could not be stored; try again")
            return
        if self._used.is_deleted:
            # The tab was closed meanwhile, and its folder removed.
            shutil.rmtree(folder, ignore_errors=True)
            return
        self._names[name] = shown_name(given)
        await self._change({_KEY: name})

    def _refuse(self, text: str) -> None:
        self._error.text = text
