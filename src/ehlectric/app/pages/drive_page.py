"""Page of a drive, which says how often both bearings discharge, and what changes that."""

from __future__ import annotations

import asyncio
import shutil
from collections.abc import Awaitable, Callable, Mapping
from functools import partial
from typing import Any

from fastapi import Request
from nicegui import events, ui

from ehlectric.app.answers import DriveAnswer
from ehlectric.app.calls import DRIVE_QUICK, DRIVE_SIMULATED
from ehlectric.app.fields.drive_fields import (
    DRIVE_GROUPS,
    PRESETS,
    SOURCE,
    changes_of,
    remedies_of,
    with_remedy,
    without_remedy,
)
from ehlectric.app.following import Following
from ehlectric.app.page_inputs import Inputs
from ehlectric.app.page_warnings import elsewhere
from ehlectric.app.pages.bearing_page import FigureBox, NumberBox, VerdictBox, WarningList, behind, table_html
from ehlectric.app.pages.downloads import Downloads
from ehlectric.app.pages.file_field import UploadField
from ehlectric.app.pages.form import Form
from ehlectric.app.pages.frame import DRIVE, PAGE_PATIENCE, PATHS, Toolbar, framed, session_of, show_address
from ehlectric.app.pages.page_parts import GroupBox, Strip, lines_html
from ehlectric.app.pages.solving import Solving, Words
from ehlectric.app.session import LARGEST, MOST_TOGETHER, SURFACES, Session, new_file, own_file, shown_name
from ehlectric.app.work import Work
from ehlectric.errors import InputError
from ehlectric.quantities.sheets import DRIVE_CARDS

# Numbers of either answer, in their order.
_FIGURES = (
    *("voltages", "remedies", "histogram", "spectrum"),
    *("discharge-voltage", "discharge-energy", "discharge-charge", "discharge-current"),
)
_WIDE = ("voltages",)


class DriveView:
    """Place of an answer, whose texts and figures change in place so that zoom and focus stay."""

    def __init__(self) -> None:
        with ui.element("div").classes("answer-body").props('data-testid="answer"') as self._body:
            self._verdict = VerdictBox()
            with ui.element("div").classes("numbers").props('data-testid="numbers" aria-live="polite"'):
                self._numbers = {name: NumberBox(name) for name in DRIVE_CARDS}
            self._remedies = ui.html("", sanitize=False).props('data-testid="remedies-table"')
            self._warnings = WarningList()
            with ui.element("div").classes("figures"):
                self._figures = {name: FigureBox(name, wide=name in _WIDE) for name in _FIGURES}
            self._ends = ui.html("", sanitize=False).props('data-testid="ends"')
            self._lines = ui.html("", sanitize=False).props('data-testid="details"')
        self._body.set_visibility(False)

    @property
    def shown(self) -> bool:
        """Whether there is an answer."""
        return bool(self._body.visible)

    def dim(self, *, dimmed: bool) -> None:
        """Dim the answer while it is that of earlier inputs."""
        self._body.classes(add="stale" if dimmed else "", remove="" if dimmed else "stale")
        self._body.props(f'aria-busy="{str(dimmed).lower()}"')

    def show(self, answer: DriveAnswer) -> None:
        """Show an answer."""
        self._body.set_visibility(True)
        self._body.props["data-simulated"] = str(answer.simulated).lower()
        self._body.update()
        self._verdict.show(answer.judged)
        for name, box in self._numbers.items():
            box.show(answer.number(name))
        remedies = answer.remedies
        self._remedies.content = "" if remedies is None else f"<h2>Remedies</h2>{table_html(remedies)}"
        self._remedies.set_visibility(remedies is not None)
        self._warnings.show(answer.warnings, elsewhere(answer.warnings))
        for name, figure in self._figures.items():
            figure.show(answer.figures.get(name))
        self._ends.content = f"<h2>Both bearings</h2>{table_html(answer.ends)}"
        self._lines.content = behind(
            "All rows, as the command prints them", lines_html(answer.lines, "Numbers of the drive")
        )


REMEDIES = "remedies"


class RemedyBox:
    """Group with a box to tick for each usual remedy, and a list of the others of the file."""

    def __init__(self, session: Session, change: Callable[[str, Any], Awaitable[None]]) -> None:
        self._session, self._change = session, change
        self._boxes: dict[str, tuple[ui.checkbox, ui.label, ui.element]] = {}
        with (
            ui.element("div").classes("form").props('role="form" aria-label="Remedies"'),
            GroupBox("Remedies", title="Remedies to compare", opened=True),
        ):
            ui.label("Each is simulated beside the drive, with the same random numbers.").classes(
                "field-help"
            )
            for title in PRESETS:
                self._preset(title)
            self._others = ui.element("div")
        self.refresh()

    def refresh(self) -> None:
        """Show the remedies of the present inputs, as after an undo."""
        given = remedies_of(self._session.inputs)
        for title, (box, note, place) in self._boxes.items():
            found = given.get(title)
            changes = changes_of(self._session.inputs, title) if found is None else found
            place.set_visibility(changes is not None)
            box.set_value(found is not None)
            note.text = _text(changes or {})
        self._others.clear()
        with self._others:
            for title, changes in given.items():
                if title not in PRESETS:
                    self._other(title, changes)

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

    def _other(self, title: str, changes: Mapping[str, Any]) -> None:
        async def removed() -> None:
            await self._put(without_remedy(self._session.inputs, title))

        with ui.element("div").classes("other"):
            ui.label(f"{title}: {_text(changes)}")
            button = ui.button("Remove", on_click=removed).props("flat dense no-caps")
            button.props["aria-label"] = f"Remove the remedy {title}"

    async def _put(self, remedies: list[Any]) -> None:
        await self._change(REMEDIES, remedies or None)
        self.refresh()


def _text(changes: Mapping[str, Any]) -> str:
    return ", ".join(f"{key} = {value}" for key, value in changes.items())


def _name(title: str) -> str:
    return title.lower().replace(" ", "-")


_KEY = "source.file"


class WaveformField:
    """Field for a measured common-mode voltage; build it in the group of the source."""

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
    """Page of one tab."""

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
        """Answer the present inputs. Returns ends with the answer at once."""
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
