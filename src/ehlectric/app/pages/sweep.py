"""Page of a sweep: two inputs with their ranges, and a map that fills as points are solved."""

from __future__ import annotations

import shutil
import time
from dataclasses import replace
from pathlib import Path
from typing import Any

from fastapi import Request
from nicegui import ui

from ehlectric.app.answers.calls import SWEEP_CHOICES, SWEEP_FILES, SWEEP_PLANNED, SWEEP_SEEN, SWEEP_SOLVED
from ehlectric.app.answers.sweep import SweepChoices, SweepPlan
from ehlectric.app.inputs import Inputs
from ehlectric.app.pages.downloads import Downloads
from ehlectric.app.pages.frame import PAGE_PATIENCE, framed, session_of, show_address
from ehlectric.app.pages.map import MapPart
from ehlectric.app.pages.parts import card
from ehlectric.app.pages.ranges import RangesForm, range_of
from ehlectric.app.pages.starts import SWEEP
from ehlectric.app.pages.toolbar import Toolbar
from ehlectric.app.ranges import same_sweep, sweep_file, sweep_inputs, with_ranges
from ehlectric.app.session import Session
from ehlectric.app.work import Job, Work
from ehlectric.errors import InputError, LostError
from ehlectric.runtime.parallel.workers import cores

_PATH = "/sweep"

# Shortest time between two looks at the database [s]; where reading takes longer, looks are rarer.
_LOOK = 1.0
_SHARE = 4.0

# Files of a sweep that can be downloaded: name, label and what it is for tests.
_DOWNLOADS = (
    ("sweep.sqlite", "Database (SQLite)", "download-sqlite"),
    ("sweep.csv", "Table (CSV)", "download-csv"),
    ("sweep.nc", "Table (NetCDF)", "download-netcdf"),
)


def add(work: Work) -> None:
    """Add the page to the server."""

    @ui.page(_PATH, response_timeout=PAGE_PATIENCE)
    async def page(request: Request) -> None:
        found, error = Inputs.of_link(request.query_params.multi_items(), Inputs())
        given = sweep_inputs(found)
        if given is None and found.table and error is None:
            error = InputError("address", "has no case", takes="the inputs of a case, or of a sweep")
        page = SweepPage(session_of(work, SWEEP if given is None else given))
        with framed("Sweep: what happens over a range?", _PATH):
            page.build(error)
        client = ui.context.client
        await client.connected()
        if not client.is_deleted:
            await page.begin()


class SweepPage:
    """Page of one tab."""

    def __init__(self, session: Session) -> None:
        self.session = session
        self.workers = max(1, cores() - 1)
        self._asked = 0
        self._choices: SweepChoices | None = None
        # Inputs whose points the map shows; None where nothing was run. The database has them, until a run of
        # other inputs, the wanted ones, has begun to write its own.
        self._ran: Inputs | None = None
        self._wanted: Inputs | None = None
        self._job: Job | None = None
        self._started = self._next = 0.0
        self._first = 0
        # Time of a point in the last run, on all its processes together [s], and its base case.
        self._pace: tuple[Any, float] | None = None
        self._looking = self._valid = False

    @property
    def folder(self) -> str:
        """Folder of the database."""
        return str(self.session.folder / "sweep")

    def build(self, error: InputError | None) -> None:
        """Build the form, the buttons and the place of the map."""
        self.toolbar = Toolbar(self.session, _PATH, self.shown_again)
        if error is not None:
            ui.label(str(error)).classes("wrong").props('role="alert" data-testid="error-address"')
        with ui.element("div").classes("columns") as self._place:
            self.form = RangesForm(self.session.inputs, None, self.change)
            with ui.element("section").props('aria-label="Sweep"'):
                self._controls()
                self.map = MapPart(self.session, self._show)
                self._outputs()
        self._timer = ui.timer(0.25, self._look, active=False)

    async def begin(self) -> None:
        """Complete the inputs of an address, and show the size of the sweep."""
        await self._set(self.session.inputs, begins=True)

    async def shown_again(self) -> None:
        """Show the present inputs, as after an undo."""
        await self._set(self.session.inputs)

    async def change(self, inputs: Inputs) -> None:
        """Take over changed inputs."""
        # The field that was changed may be made anew meanwhile, and with it the place of its events.
        with self._place:
            await self._set(inputs)

    async def _set(self, inputs: Inputs, *, begins: bool = False) -> None:
        """Take over inputs; those without varied ones get the usual ranges."""
        self._asked += 1
        asked = self._asked
        if inputs.value("vary"):
            self._take(inputs)
        try:
            choices = await self.session.work.quick(SWEEP_CHOICES, dict(inputs.value("case") or {}))
        except (InputError, LostError) as error:
            if asked == self._asked:
                self._take(inputs)
                self._refuse(error)
            return
        if asked != self._asked:
            return
        self._choices = choices
        if not inputs.value("vary"):
            inputs = with_ranges(inputs, [range_of(one) for one in choices.variables[:2]])
            if begins:
                # Nothing was there before that an undo could show.
                self.session.history.now = inputs
        self._take(inputs)
        if self._ran is not None and self.map.differs:
            await self._read()
        await self._plan(asked)

    def _take(self, inputs: Inputs) -> None:
        self.session.history.push(inputs)
        if inputs.linkable:
            show_address(inputs, _PATH)
        self.form.set(inputs, self._choices)
        self.map.offer(self._choices.values if self._choices else {}, str(inputs.value("show") or ""))
        self._tell_state()

    async def _plan(self, asked: int) -> None:
        self.plan.text = "Checking …"
        self._allow(valid=True)
        try:
            found = await self.session.work.quick(SWEEP_PLANNED, self._table(), self.workers)
        except (InputError, LostError) as error:
            if asked == self._asked:
                self._refuse(error)
            return
        if asked == self._asked:
            self.form.tell(None)
            self.plan.text = _in_words(self._paced(found))

    def _paced(self, plan: SweepPlan) -> SweepPlan:
        """Plan with the time that the points of the same base case took, where some are solved."""
        if self._pace is None or self._pace[0] != self.session.inputs.value("case"):
            return plan
        return replace(plan, seconds=plan.points * self._pace[1])

    def _table(self) -> dict[str, Any]:
        return dict(sweep_file(self.session.inputs).table)

    def _allow(self, *, valid: bool) -> None:
        self._valid = valid
        self._tell_state()

    def _refuse(self, error: Exception) -> None:
        self._allow(valid=False)
        self.plan.text = "The inputs cannot be run; see what is wrong beside them."
        if isinstance(error, InputError):
            self.form.tell(error)
        else:
            self.plan.text = str(error)

    async def _show(self, key: str) -> None:
        """Show another result of the points."""
        self.session.history.push(self.session.inputs.changed({"show": key}))
        if self.session.inputs.linkable:
            show_address(self.session.inputs, _PATH)
        if self._ran is not None:
            await self._read()

    def _controls(self) -> None:
        with card("Run"):
            self.plan = ui.label().props('data-testid="plan" aria-live="polite"')
            with ui.element("div").classes("buttons"):
                self.run = ui.button("Run", on_click=self._run, color=None).classes("primary")
                self.run.props("no-caps unelevated data-testid=solve")
                self.stop = ui.button("Stop", on_click=self._stop)
                self.stop.props("no-caps outline data-testid=cancel").set_enabled(False)
                self.clear = ui.button("Clear results", on_click=self._clear)
                self.clear.props("no-caps flat data-testid=clear").set_enabled(False)
            self.bar = ui.linear_progress(0.0, show_value=False)
            self.bar.props('aria-label="Solved part of the sweep"').set_visibility(False)
            self.state = ui.label().props('role="status" data-testid="progress"')
            self.failure = ui.label().classes("wrong").props('role="alert" data-testid="failure"')

    def _outputs(self) -> None:
        with card("Downloads"):
            with ui.element("div").classes("buttons"):
                button = ui.button("Sweep file (TOML)", on_click=self._download_toml)
                button.props("no-caps outline data-testid=download-toml")
                self.downloads = [self._download_of(*about) for about in _DOWNLOADS]
            ui.label("ehlectric sweep sweep.toml runs this file; the files are those that it writes.")
        Downloads(self.session, "sweep", self._finished_folder, only_made=True)

    def _finished_folder(self) -> Path | None:
        """Folder of the database, where it has points of the present inputs and is not written to."""
        return self.session.folder / "sweep" if self._same and not self.stop.enabled else None

    @property
    def _same(self) -> bool:
        """Whether the map shows the sweep of the present inputs."""
        return self._ran is not None and same_sweep(self._ran, sweep_file(self.session.inputs))

    def _download_of(self, name: str, label: str, test_id: str) -> ui.button:
        async def download() -> None:
            try:
                names = await self.session.work.quick(SWEEP_FILES, self.folder)
            except (InputError, LostError) as error:
                self.failure.text = str(error)
                return
            if name in names:
                ui.download.file(self.session.folder / "sweep" / name, name)

        button = ui.button(label, on_click=download).props(f"no-caps outline data-testid={test_id}")
        button.set_enabled(False)
        return button

    def _download_toml(self) -> None:
        ui.download.content(sweep_file(self.session.inputs).toml(), "sweep.toml", "application/toml")

    def _run(self) -> None:
        """Solve the open points; those that the database has are kept."""
        self.failure.text = ""
        try:
            self._job = self.session.start(SWEEP_SOLVED, self._table(), self.folder, self.workers)
        except LostError as error:
            self.failure.text = str(error)
            return
        self._wanted = sweep_file(self.session.inputs)
        self._started = self._next = 0.0
        self.state.text = ""
        self._timer.activate()
        self._tell_state()

    def _stop(self) -> None:
        if self._job is not None:
            self._job.cancel()

    def _clear(self) -> None:
        """Remove the database; its points would have to be solved again."""
        if self._job is None or self._job.over:
            shutil.rmtree(self.folder, ignore_errors=True)
            self._ran = self._wanted = None
            self.map.clear()
            self.state.text = self.failure.text = ""
            self._tell_state()

    async def _look(self) -> None:
        """Show the progress of the job, and now and then the points that it has solved."""
        job = self._job
        if job is None or self._looking:
            return
        self._looking = True
        try:
            over = job.over
            self._tell_progress(job)
            if over:
                self._timer.deactivate()
                self._tell_state()
            if over or (job.of and time.monotonic() > self._next):
                await self._read(running=not over)
            if over and job is self._job:
                self._end(job)
        finally:
            self._looking = False

    def _tell_progress(self, job: Job) -> None:
        if not job.of:
            self.state.text = {"waiting": job.text, "running": "starting"}.get(job.state, "")
            return
        if not self._started:
            self._started, self._first = time.monotonic(), job.done
        self.bar.value = job.done / job.of
        solved, passed = job.done - self._first, time.monotonic() - self._started
        if solved > 0 and self._wanted is not None:
            self._pace = (self._wanted.value("case"), passed / solved)
        more = f" ({job.text})" if job.text else ""
        self.state.text = f"{job.done} of {job.of} points done{more}{self._left(job, 'about {} left')}"

    def _left(self, job: Job, text: str) -> str:
        """Time that the other points of a job will take, in a text; empty where none is solved yet."""
        if self._pace is None or job.done >= job.of or job.done <= self._first:
            return ""
        return f", {text.format(duration((job.of - job.done) * self._pace[1]))}"

    def _end(self, job: Job) -> None:
        """Say how a job has ended, after the last look at its points."""
        if self._wanted is not self._ran:
            # The job ended before its sweep was in the database, which still has that of the map.
            self._wanted = self._ran
        if job.state == "cancelled" and not job.of:
            self.state.text = "Stopped before the first point was done."
        elif job.state == "cancelled":
            rest = self._left(job, "in about {}")
            self.state.text = f"Stopped: {job.done} of {job.of} points are done and kept. "
            self.state.text += f"Resume solves only the others{rest}."
        elif job.state == "failed":
            self.failure.text = f"{job.error}. The points that are done are kept; Resume solves the others."
            if isinstance(job.error, InputError):
                self.failure.text = str(job.error)
        self._tell_state()

    async def _read(self, *, running: bool = False) -> None:
        """Look at the points, and show them if they are those of the wanted sweep."""
        begun, wanted = time.monotonic(), self._wanted
        if wanted is None:
            return
        try:
            view = await self.session.work.quick(SWEEP_SEEN, self.folder, self.map.shown, dict(wanted.table))
        except (InputError, LostError) as error:
            # A job that has just begun has no database yet.
            if not running and self._job is not None and self._job.state == "done":
                self.failure.text = str(error)
            return
        finally:
            self._next = time.monotonic() + max(_LOOK, _SHARE * (time.monotonic() - begun))
        if view is None or wanted is not self._wanted:
            return
        self._ran = wanted
        self.map.began(wanted)
        self.map.show(view, running=running)
        self._tell_state()

    def _tell_state(self) -> None:
        """Enable the buttons that can be used, and name the first one by what it does."""
        running = self._job is not None and not self._job.over
        same = self._same
        remain = self.map.open_points
        finished = same and self.map.finished and not running
        self.run.set_enabled(self._valid and not running and not finished)
        self.run.text = "Resume" if same and remain and not running else "Run"
        self.stop.set_enabled(running)
        self.clear.set_enabled(not running and self._ran is not None)
        self.bar.set_visibility(running)
        for button in self.downloads:
            button.set_enabled(not running and same)
        self.map.outdated(old=self._ran is not None and not same)


def duration(seconds: float) -> str:
    """Time in words, with two digits.

    Examples
    --------
    >>> duration(12.3), duration(200.0), duration(9000.0)
    ('12 s', '3.3 min', '2.5 h')
    """
    if seconds < 100.0:
        return f"{max(1, round(seconds))} s"
    return f"{seconds / 60.0:.2g} min" if seconds < 5400.0 else f"{seconds / 3600.0:.2g} h"


def _in_words(plan: SweepPlan) -> str:
    where = f"on {plan.workers} core{'s' if plan.workers > 1 else ''}"
    text = f"{plan.points} points {where}"
    if plan.seconds is None:
        text += (
            ": each takes as long as one solution, a second for a contact or a quick drive, ten or more "
            "for a bearing."
        )
    else:
        text += f", without solving contacts: about {duration(plan.seconds)}."
    if plan.refused:
        text += f" {plan.refused} of {plan.corners} corners of the ranges are no valid case: {plan.reason}."
    return text
