"""Field for a file: an ordinary field of the browser, so that a keyboard and a screen reader can use it."""

from __future__ import annotations

import json
from collections.abc import Awaitable, Callable
from typing import Any

from nicegui import events, ui

from ehlectric.app.pages.page_parts import script, weakly
from ehlectric.app.session import ENDINGS, LARGEST, Session, shown_name
from ehlectric.errors import InputError, LostError
from ehlectric.readable import readable

# What pages say of an uploaded file, and of one that the session does not have.
NOT_IN_LINKS = "A link cannot hold the file; a download with everything has it."
LOST_FILE = "This file was uploaded in another session. Upload it again"

_INSTRUMENT = f"File of an instrument: {', '.join(ENDINGS)} and others"


class UploadField:
    """Field for the file of an instrument, which is stored in the folder of the session.

    ``take`` is called with the name of a file there, and ``refuse`` with the reason why there is none. The
    file has at most the size ``most`` [bytes].
    """

    def __init__(
        self,
        session: Session,
        take: Callable[[str], Awaitable[None]],
        refuse: Callable[[str], None],
        *,
        name: str = "surface",
        label: str = _INSTRUMENT,
        most: int = LARGEST,
    ) -> None:
        self._session, self._take, self._refuse, self._most = session, take, refuse, most
        uploader = ui.upload(on_upload=weakly(self._uploaded), max_file_size=most).style("display: none")
        address = json.dumps(uploader.props["url"])
        send = f"(event) => ({script('send_file')})({most}, {address}, emit)(event)"
        with ui.element("div").classes("upload"):
            words = f"{label}, at most {most / 1e6:g} MB"
            ui.html(words, sanitize=False, tag="label").props(f'for="{name}-file"')
            field = ui.element("input").props(f'type="file" id="{name}-file" data-testid="upload-{name}"')
            field.props["aria-describedby"] = "roughness-error" if name == "surface" else f"{name}-error"
            field.props["accept"] = ",".join((*ENDINGS, "*/*"))
            field.on("change", self._sent, js_handler=send)
            self._state = ui.label().classes("muted").props('aria-live="polite"')

    async def _uploaded(self, event: events.UploadEventArguments) -> None:
        try:
            name = await self._session.store(event.file, self._most)
        except LostError:
            # The tab was closed meanwhile.
            return
        except InputError as error:
            self._state.text = ""
            self._refuse(str(error))
            return
        self._state.text = ""
        await self._take(name)

    def _sent(self, event: Any) -> None:
        """Show that the browser sends a file, or why it does not."""
        name, status = shown_name(str(event.args.get("name", ""))), event.args.get("status")
        if status is None:
            size = float(event.args.get("size", 0)) / 1e6
            self._refuse(f"{name}: has {readable(size, 4)} MB; expected at most {self._most / 1e6:g} MB")
        elif status == 0:
            self._state.text = f"Reading {name}"
        else:
            self._state.text = ""
            self._refuse(f"{name}: could not be sent to the server; try again")


# Key of the file of a measured common-mode voltage.
WAVEFORM_FILE = "source.file"


class WaveformField:
    """Field for a measured common-mode voltage; build it in the group of the source."""

    def __init__(self, session: Session, change: Callable[[dict[str, Any]], Awaitable[None]]) -> None:
        self._session, self._change = session, change
        with ui.element("div").classes("box"):
            UploadField(
                session,
                self._take,
                self._refuse,
                name="waveform",
                label="Or a measured waveform: file of an oscilloscope",
            )
            self._used = ui.label().classes("hint").props('data-testid="waveform-used"')
            self._error = ui.label().classes("error").props('role="alert" id="waveform-error"')
            self._error.props('data-testid="error-waveform"')
        self.refresh()

    def refresh(self) -> None:
        """Show the file of the present inputs, as after an undo."""
        file = self._session.inputs.value(WAVEFORM_FILE)
        self._error.text = ""
        self._used.set_visibility(isinstance(file, str))
        if not isinstance(file, str):
            return
        self._used.text = f"Measured: {self._session.name_of(file)}. {NOT_IN_LINKS}"
        if self._session.path_of(file) is None:
            self._error.text = f"{LOST_FILE}."

    async def _take(self, name: str) -> None:
        await self._change({WAVEFORM_FILE: name})

    def _refuse(self, text: str) -> None:
        self._error.text = text
