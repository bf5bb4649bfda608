"""Box of moving roughness: a run in the background, and its film, pressure and field as a movie."""

from __future__ import annotations

import json
from collections.abc import Awaitable, Callable, Mapping
from pathlib import Path
from typing import Any

from nicegui import ui

from ehlectric.app.calls import MOTION_RUN, MOTION_STORED
from ehlectric.app.page_inputs import example_inputs
from ehlectric.app.pages.page_parts import (
    JobBox,
    Plot,
    button,
    heading,
    lines_html,
    mark,
    say,
    script,
)
from ehlectric.app.pages.result_parts import behind, show_warnings
from ehlectric.app.pages.roughness_box import Keys
from ehlectric.app.roughness_keys import MOTION_KEYS
from ehlectric.app.session import Session
from ehlectric.app.view_models import Line, MotionAnswer
from ehlectric.app.work import Job
from ehlectric.errors import InputError, LostError

# Motion with which the page begins: the motion of the example, with fewer instants, at each of which a field
# is solved.
_FIRST = {**example_inputs("moving_roughness").value("motion"), "record": 60}


class MovieBox:
    """Box in which the roughness of a contact is set in motion and shown over time."""

    def __init__(self, session: Session, changed: Callable[[], Awaitable[None]]) -> None:
        self._session, self._changed = session, changed
        self._of: Mapping[str, Any] | None = None
        self._folder: Path | None = None
        self._state_text = ""
        self._keys: Keys | None = None
        self._on = False
        with ui.element("div").classes("box").props('data-testid="motion"'):
            self._switch = ui.switch("Moving roughness", on_change=self._switched)
            self._switch.props('data-testid="switch-motion"')
            self._inputs = ui.element("div").classes("box")
            self._message = ui.label().classes("error").props('role="alert" data-testid="error-motion"')
            with ui.element("div").classes("buttons"):
                self._run = button("Compute the movie", "solve-motion", self._start, primary=True)
            self._job = JobBox(session, self._ended, self._tell)
            self._state = ui.label().classes("muted").props('aria-live="polite" data-testid="motion-state"')
            self._view = ui.element("div").classes("box").props('data-testid="movie"')
        self._tell(None)
        self.refresh()

    @property
    def folder(self) -> Path | None:
        """Folder with the files of a complete movie of the present inputs; None without one."""
        return self._folder if self._of == self._session.inputs.table else None

    def show_switch(self) -> None:
        """Bring the switch into view with the focus, after its card has changed its place."""
        element = f'document.getElementById("{self._switch.html_id}")'
        shown = f"{element}?.scrollIntoView({{block: 'center'}}); {element}?.focus();"
        ui.run_javascript(f"setTimeout(() => {{{shown}}}, 100)")

    def refresh(self) -> None:
        """Show the present inputs; a movie of other inputs is dimmed, and words state it."""
        table = self._session.inputs.value("motion")
        on = isinstance(table, Mapping)
        if on != self._on or self._keys is None or not on:
            self._build(table if on else None)
        self._on = on
        self._switch.set_value(on)
        self._run.set_visibility(on)
        old = self._of is not None and self._of != self._session.inputs.table
        mark(self._view, "old", on=old)
        if old:
            self._state.text = "This movie is of earlier inputs. Compute it again for the present ones."
        elif self._of is None:
            self._state.text = "No movie yet." if on else ""
        else:
            self._state.text = self._state_text

    def _build(self, table: Mapping[str, Any] | None) -> None:
        self._inputs.clear()
        with self._inputs:
            if table is None:
                self._keys = None
                ui.label(
                    "Rough surfaces pass through the contact at the speeds of their bodies, and the film "
                    "follows over time. It needs a rough surface."
                ).classes("hint")
                return
            self._keys = Keys("motion", MOTION_KEYS, table, self._set)
            ui.label("The first values come from an example: assumptions.").classes("hint")

    async def _switched(self, event: Any) -> None:
        on = bool(event.value)
        if on == isinstance(self._session.inputs.value("motion"), Mapping):
            return
        await self._give(_FIRST if on else None)

    async def _set(self, key: str, value: Any) -> None:
        table = {**(self._session.inputs.value("motion") or {}), key: value}
        if value is not None and key in ("passes", "duration"):
            table.pop("duration" if key == "passes" else "passes", None)
        given = {name: entry for name, entry in table.items() if entry is not None}
        self._keys = None
        await self._give(given)

    async def _give(self, table: Mapping[str, Any] | None) -> None:
        self._session.history.push(self._session.inputs.changed({"motion": table}))
        self._tell(None)
        self.refresh()
        await self._changed()

    def _start(self) -> None:
        self._tell(None)
        self._running = dict(self._session.inputs.table)
        if self._job.start(MOTION_RUN, self._running, str(self._session.folder)):
            self._run.disable()

    async def _ended(self, job: Job) -> None:
        self._run.enable()
        if job.state == "done":
            self._show(job.result, "")
            return
        if job.error is not None and self._running == self._session.inputs.table:
            self._tell(job.error)
        await self._show_part("cancelled" if job.state == "cancelled" else str(job.error))

    async def _show_part(self, why: str) -> None:
        """Show the instants that were solved before a run ended."""
        self._state.text = "Reading the instants that are solved."
        try:
            answer = await self._session.work.quick(MOTION_STORED, self._running, str(self._session.folder))
        except (InputError, LostError) as error:
            # The error of the run itself is shown already.
            if why == "cancelled" and self._running == self._session.inputs.table:
                self._tell(error)
            answer = None
        if answer is not None:
            self._show(answer, why)
        else:
            newer = self._running != self._session.inputs.table
            self._state.text = (
                f"Earlier inputs ({why}): no instant is solved." if newer else "No instant is solved."
            )

    def _show(self, answer: MotionAnswer, why: str) -> None:
        self._of = self._running
        self._folder = Path(answer.folder) if answer.complete else None
        self._state_text = _state(answer, why)
        mark(self._state, "failed", on=not answer.complete)
        self._view.clear()
        self._view.classes(remove="old")
        with self._view:
            _movie(answer)
        self.refresh()

    def _tell(self, error: Exception | None) -> None:
        at_field = self._keys is not None and self._keys.tell(error)
        say(self._message, "" if error is None or at_field else str(error))


def _state(answer: MotionAnswer, why: str) -> str:
    shown = len(answer.times)
    count = f"{shown} instants" if shown == answer.of else f"{shown} of {answer.of} recorded instants"
    if answer.complete:
        return f"All time steps are solved; {count}."
    reason = answer.failure or why or "stopped"
    last = answer.texts[-1].split(":")[0]
    return f"Not complete ({reason}): {count} until {last}. Later instants are not known."


def _movie(answer: MotionAnswer) -> None:
    """Slider, figures and tables of a movie."""
    with ui.element("div").classes("movie-bar"):
        play = ui.html("Play", sanitize=False, tag="button")
        play.props('type="button" class="q-btn movie-play" aria-pressed="false" data-testid="movie-play"')
        slider = ui.element("input").props(
            f'type="range" min="0" max="{len(answer.times) - 1}" step="1" aria-label="Instant of the movie" '
            'data-testid="movie-slider"'
        )
    text = ui.html("", sanitize=False).classes("movie-text").props('data-testid="movie-text"')
    with ui.element("div").classes("buttons"):
        for label, instant in (
            ("Thinnest film", answer.at_least_film),
            ("Largest field", answer.at_largest_field),
        ):
            go = f'() => document.getElementById("{slider.html_id}")'
            go += f'.dispatchEvent(new CustomEvent("instant", {{detail: {instant}}}))'
            ui.button(label, color=None).props("flat no-caps").on("click", js_handler=go)
    movie = Plot(answer.movie, f"Film, pressure and field of {answer.title} at one instant")
    heading("Over time", 3)
    ui.label(
        "A click sets the time. Dots: instants at which the field is solved; between them it follows from "
        "the minimum film. Dashed: the same roughness held stationary."
    ).classes("hint")
    history = Plot(answer.history, "Minimum film, maximum field and breakdown voltage over time")
    show_warnings(answer.warnings)
    rows = (Line(name, value) for name, value in answer.rows)
    about = "Numbers of the run"
    ui.html(behind(about, lines_html(rows, about)), sanitize=False).props('data-testid="motion-numbers"')
    values = {
        "movie": movie.html_id,
        "history": history.html_id,
        "slider": slider.html_id,
        "text": text.html_id,
        "play": play.html_id,
        "times": answer.times,
        "texts": answer.texts,
        "first": answer.at_least_film,
    }
    ui.run_javascript(f"{script('movie')}({json.dumps(values)})")
