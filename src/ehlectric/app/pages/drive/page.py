"""Page of a drive, which says how often both bearings discharge, and what changes that."""

from __future__ import annotations

import asyncio
from typing import Any

from fastapi import Request
from nicegui import ui

from ehlectric.app.answers.calls import DRIVE_QUICK, DRIVE_SIMULATED
from ehlectric.app.answers.drive import DriveAnswer
from ehlectric.app.fields.drive import DRIVE_GROUPS
from ehlectric.app.fields.source import SOURCE
from ehlectric.app.following import Following
from ehlectric.app.inputs import Inputs
from ehlectric.app.pages.downloads import Downloads
from ehlectric.app.pages.drive.remedies import REMEDIES, RemedyBox
from ehlectric.app.pages.drive.view import DriveView
from ehlectric.app.pages.drive.waveform import WaveformField
from ehlectric.app.pages.form import Form
from ehlectric.app.pages.frame import PAGE_PATIENCE, framed, session_of, show_address
from ehlectric.app.pages.parts import Strip
from ehlectric.app.pages.solving import Solving, Words
from ehlectric.app.pages.starts import DRIVE
from ehlectric.app.pages.toolbar import PATHS, Toolbar
from ehlectric.app.session import Session
from ehlectric.app.work import Work
from ehlectric.errors import InputError

_PATH = PATHS["drive"]

# Numbers of the short answer.
_SHORT = ("end.events_per_second", "end.voltage_at_peak", "end.breakdown_voltage")

_WORDS = Words(
    solve="Simulate",
    show_solved="Show the simulation",
    show_quick="Show the capacitive divider",
    back="Back to the simulated inputs",
    earlier="The simulation is of earlier inputs.",
    running="The simulation that runs is of earlier inputs.",
    done="The drive of earlier inputs is simulated.",
    cancelled="Cancelled: nothing was kept.",
    failed="Not simulated",
    beyond="a simulation with solved contacts",
)


def add(work: Work) -> None:
    """Add the page to the server."""

    @ui.page(_PATH, response_timeout=PAGE_PATIENCE)
    async def page(request: Request) -> None:
        inputs, error = Inputs.of_link(request.query_params.multi_items(), DRIVE)
        page = DrivePage(session_of(work, inputs))
        ui.context.client.on_delete(page.close)
        with framed("How often do the bearings of this drive discharge?", _PATH):
            page.build(error)
        page.refresh()


class DrivePage:
    """Page of one tab.

    Parameters
    ----------
    session : Session
        Session of the tab.
    """

    def __init__(self, session: Session) -> None:
        self.session = session
        work = session.work
        self._following: Following[Inputs, DriveAnswer] = Following(
            lambda inputs: work.quick(DRIVE_QUICK, dict(inputs.table), session.made_folder),
            None,
            show=self._show,
            passing=lambda _, answer: self._put(answer),
            refuse=self._refuse,
            behind=work.behind,
        )

    def build(self, error: InputError | None) -> None:
        """Build the form and the places of the answer; with the error of a wrong address."""
        self._strip = Strip()
        Toolbar(self.session, _PATH, self.shown_again)
        if error is not None:
            text = f"{error}. The example is shown in place of the inputs of the address."
            ui.label(text).classes("notice wrong").props('role="alert" data-testid="error-address"')
        with ui.element("div").classes("columns"):
            with ui.element("div").classes("inputs"):
                self.form = Form(
                    DRIVE_GROUPS, self.session.inputs, self.change, elsewhere=(REMEDIES, *_FILES)
                )
                with self.form.group(SOURCE.title):
                    self.waveform = WaveformField(self.session, self.form.take)
                self.remedies = RemedyBox(self.session, self.change)
            with ui.element("section").classes("answer").props('aria-label="Answer"'):
                self._build_answer()

    def _build_answer(self) -> None:
        self.solving = Solving(DRIVE_SIMULATED, _WORDS, self.session, self._ask, self.go_to)
        self._notice = ui.label().classes("notice wrong").props('data-testid="notice"')
        self._notice.set_visibility(False)
        button = ui.button("Go to the field", on_click=self.form.go_to_wrong, color=None)
        button.props("no-caps dense data-testid=to-field")
        button.bind_visibility_from(
            self._notice, "visible", lambda told: told and self.form.wrong is not None
        )
        self.view = DriveView()
        self._downloads = Downloads(self.session, "drive", self.solving.folder)

    async def change(self, key: str, value: Any) -> None:
        """Take over a changed input, and answer."""
        self.session.history.push(self.session.inputs.changed({key: value}))
        self._show_address()
        if key == REMEDIES:
            # The form has the inputs that it sends whole.
            self.form.set(self.session.inputs)
        self.waveform.refresh()
        self.remedies.refresh()
        self.refresh()

    def go_to(self, inputs: Inputs) -> None:
        """Make other inputs the present ones, as after a step back."""
        self.session.history.push(inputs)
        self.shown_again()

    def shown_again(self) -> None:
        """Show the present inputs in the form and in the address, and answer them."""
        self.form.set(self.session.inputs)
        self.waveform.refresh()
        self.remedies.refresh()
        self._show_address()
        self.refresh()

    def _show_address(self) -> None:
        """Put the inputs into the address; one that cannot hold them stays as it is."""
        if self.session.inputs.linkable:
            show_address(self.session.inputs, _PATH)

    def refresh(self) -> asyncio.Future[None]:
        """Answer the present inputs.

        Returns
        -------
        asyncio.Future
            Ends with the answer at once.
        """
        self.solving.forget()
        return self._ask()

    def close(self) -> None:
        """Want no further answers."""
        self._following.drop()

    def _ask(self) -> asyncio.Future[None]:
        """Show the simulation where there is one, or ask for the quick answer; the one before is dimmed."""
        solved = self.solving.answer()
        if solved is None:
            self._dim(dimmed=True)
            return self._following.ask(self.session.inputs)
        self._following.drop()
        self._show(self.session.inputs, solved)
        ended = asyncio.get_running_loop().create_future()
        ended.set_result(None)
        return ended

    def _show(self, _: Inputs, answer: DriveAnswer) -> None:
        self._put(answer)
        self._dim(dimmed=False)
        self.form.tell(None)
        self._notice.set_visibility(False)
        self.solving.show(answer)
        self._downloads.look()

    def _put(self, answer: DriveAnswer) -> None:
        self.view.show(answer)
        named = [one for one in answer.shown if one.key in _SHORT and one.known]
        texts = [" ".join(filter(None, [one.label, one.bound, one.text, one.unit])) for one in named]
        self._strip.show(answer.judged.level, answer.judged.lead, texts)

    def _dim(self, *, dimmed: bool) -> None:
        self.view.dim(dimmed=dimmed)
        self._strip.dim(dimmed=dimmed)

    def _refuse(self, error: Exception) -> None:
        self.form.tell(error)
        words = self.form.words(error)
        self._strip.show("grey", "No answer", [words])
        stands = " The answer below is that of earlier inputs." if self.view.shown else ""
        self._notice.text = f"{words}.{stands}"
        self._notice.set_visibility(True)
        self.solving.show(None, error)


# Keys of the source that the field of a measured waveform has.
_FILES = ("source.file",)
