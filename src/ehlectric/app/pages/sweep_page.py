"""Page of a sweep: two inputs with their ranges, a map that fills as points are solved, and the chosen
point.
"""

from __future__ import annotations

import shutil
import time
from collections.abc import Awaitable, Callable, Mapping, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

from fastapi import Request
from nicegui import ui

from ehlectric.app.calls import (
    SWEEP_CHOICES,
    SWEEP_FILES,
    SWEEP_PLANNED,
    SWEEP_POINT,
    SWEEP_SEEN,
    SWEEP_SOLVED,
)
from ehlectric.app.form_fields import Group
from ehlectric.app.form_fields.field import Field as FormField
from ehlectric.app.form_fields.field import in_field_unit, written_text
from ehlectric.app.page_inputs import (
    Inputs,
    Range,
    case_of_link,
    example_inputs,
    lists_of,
    ranges_of,
    same_sweep,
    sweep_file,
    sweep_inputs,
    with_ranges,
    with_shown,
)
from ehlectric.app.pages import page_parts
from ehlectric.app.pages.downloads import Downloads
from ehlectric.app.pages.form import Form, groups_for
from ehlectric.app.pages.frame import (
    DRIVE,
    PAGE_PATIENCE,
    PATHS,
    SWEEP,
    Toolbar,
    address_of,
    connected,
    framed,
    session_of,
    show_address,
)
from ehlectric.app.pages.page_parts import Control, GroupBox, card, control, page_texts
from ehlectric.app.pages.result_parts import NoteList, Panel
from ehlectric.app.session import Session
from ehlectric.app.view_models import Chart, Deciding, Note, SweepChoices, SweepPlan, SweepView, Variable
from ehlectric.app.work import Job, Work
from ehlectric.errors import InputError, LostError
from ehlectric.quantities.palette import ORANGE
from ehlectric.quantities.units import split
from ehlectric.quantities.verdict import Verdict
from ehlectric.readable import readable
from ehlectric.runtime.worker_processes import cores

Change = Callable[[Inputs], Awaitable[None]]

_NONE = "no second input"

# Longest text that is read as a number of values [characters].
_LONGEST = 7


# Paths of pages by a table that only their cases have; other cases are contacts.
_PATHS = {
    "drive_end": PATHS["drive"],
    "shaft": PATHS["axle"],
    "gear": PATHS["gear"],
    "bearing": PATHS["bearing"],
}


class RangesForm:
    """Form of a sweep; ``choices`` has what may vary, and is None where the base case is not valid."""

    def __init__(self, inputs: Inputs, choices: SweepChoices | None, change: Change) -> None:
        self._inputs, self._choices, self._change = inputs, choices, change
        # Fields of the varied inputs and of the base case, by the keys of their texts.
        self._axes: dict[str, Control] = {}
        self._base: dict[str, Control] = {}
        self._groups: Sequence[Group] | None = None
        self._focus = ""
        with ui.element("div").classes("form").props('role="form" aria-label="Sweep"'):
            with GroupBox("What varies", first=True):
                self._varied = ui.element("div").classes("group-body")
                self._message = (
                    ui.label().classes("field-error").props('role="alert" data-testid="error-form"')
                )
            with GroupBox("Base case"):
                self._build_base()
        self._build_axes()
        self._set_base()

    def set(self, inputs: Inputs, choices: SweepChoices | None) -> None:
        """Show other inputs; fields are made anew only where others are needed, so that the focus stays."""
        before = _shape(self._inputs, self._choices)
        self._inputs, self._choices = inputs, choices
        self._set_base()
        if _shape(inputs, choices) != before:
            self._build_axes()
            return
        for key, text in _texts(inputs).items():
            if key in self._axes:
                self._axes[key].show(text=text)

    def tell(self, error: InputError | None) -> None:
        """Show an error next to its field, and remove the one before."""
        for field in (*self._axes.values(), self._link):
            field.show(error="")
        self._message.text = ""
        self.case.tell(None)
        if error is None:
            return
        key = str(error.key or "")
        axis_field = self._axes.get(key) or self._axes.get(f"{key}.from")
        if axis_field is not None:
            axis_field.show(error=self._in_unit(key, error.text))
        elif key and not f"{key}.".startswith("vary."):
            self._values.turn(opened=True)
            self.case.tell(InputError(key.removeprefix("case."), error.text))
        else:
            self._message.text = str(error)

    def _in_unit(self, key: str, text: str) -> str:
        """Return the error text of a range, with bounds in the unit that the field shows."""
        field = self._field_of(key.removeprefix("vary.").rpartition(".")[0])
        return text if field is None else in_field_unit(field, text)

    def _with_unit(self, key: str, text: str) -> str:
        """Text of a value that was typed, with the unit of the field of its input where it has none."""
        field = self._field_of(key)
        return (
            text if field is None or split(text) is None else str(field.from_text(written_text(field, text)))
        )

    def _field_of(self, key: str) -> FormField | None:
        """Field of an input of the base case; None where its form has none."""
        fields = (field for group in self._groups or () for field in group.fields)
        return next((field for field in fields if field.key == key), None)

    def _build_axes(self) -> None:
        """Fields of the varied inputs."""
        self._axes.clear()
        self._varied.clear()
        with self._varied:
            ranges = ranges_of(self._inputs)
            lists = lists_of(self._inputs)
            for key, values in lists.items():
                ui.label(f"{key} takes {values}, as the file says.").classes("muted")
            # A map has two axes, of which lists take some.
            if ranges or len(lists) < 2:
                self._axis(0, ranges)
            if len(ranges) > 1 or (ranges and not lists):
                self._axis(1, ranges)
        if self._focus in self._axes:
            self._axes[self._focus].focus()
        self._focus = ""

    def _build_base(self) -> None:
        """Source of the base case, and its inputs in the form of its page."""
        self._title = ui.label().classes("case-title")
        examples = {"": "choose …", **page_texts("examples")}
        self._example_box = control("base-example", "Take an example", self._example, examples)
        self._link = control("base-link", "Or paste a link of a page", self._take_over)
        kinds = {
            "atlas": "from the atlas: half a second each",
            "formula": "from the film-thickness formula: half a second each",
            "solved": "solved: ten seconds or more each",
        }
        contacts = partial(self._changed_case, "contacts")
        self._kind = control("case.contacts", "Contacts of the bearing", contacts, kinds)
        self._page = ui.link("Open the base case on its page", "/", new_tab=True)
        self._values = GroupBox("Inputs of the base case", opened=False)

    def _set_base(self) -> None:
        """Show the base case."""
        case = Inputs(self._inputs.value("case") or {})
        self._title.text = str(case.value("title") or "Case without a title")
        path = next((path for name, path in _PATHS.items() if case.value(name)), PATHS["contact"])
        self._page.props["href"] = address_of(path, case)
        self._page.update()
        self._kind.show(shown=bool(case.value("bearing")), text=str(case.value("contacts") or "solved"))
        if self._groups is groups_for(case):
            self.case.set(case)
            return
        self._groups = groups_for(case)
        self._values.clear()
        with self._values:
            self.case: Form = Form(self._groups, case, self._changed_case, label="Inputs of the base case")

    async def _changed_case(self, key: str, value: Any) -> None:
        await self._change(self._inputs.changed({f"case.{key}": value}))

    async def _example(self, name: str) -> None:
        if not name:
            return
        table = dict((DRIVE if name == "drive" else example_inputs(name)).table)
        self._example_box.turn(text="")
        await self._change(Inputs({"case": table | ({"contacts": "atlas"} if "bearing" in table else {})}))

    async def _take_over(self, link: str) -> None:
        case = case_of_link(link)
        if case is not None:
            await self._change(Inputs({"case": case}))
        elif link:
            self._link.show(error="this link has no case: copy the link of a page with one")

    def _axis(self, place: int, ranges: Sequence[Range]) -> None:
        """Fields of one varied input."""
        now = ranges[place] if place < len(ranges) else None
        others = {other.key for other in ranges} - ({now.key} if now else set())
        names = {key: variable.label for key, variable in self._offered().items() if key not in others}
        if now is not None and now.key not in names:
            names = {now.key: now.key, **names}
        name = f"vary-{place}"

        async def chosen(key: str) -> None:
            present, offered = ranges_of(self._inputs), self._offered()
            new = present[:place] + ([range_of(offered[key])] if key in offered else [])
            self._focus = name
            await self._change(with_ranges(self._inputs, new + ([] if place else present[1:])))

        title = "Second input (upwards)" if place else "First input (to the right)"
        with ui.element("fieldset").classes("axis"):
            self._field(name, title, chosen, {"": _NONE, **names} if place else names)
            if now is not None:
                self._range(place, now)

    def _offered(self) -> dict[str, Variable]:
        """Inputs that can be varied, by key."""
        return {variable.key: variable for variable in (self._choices.variables if self._choices else ())}

    def _range(self, place: int, now: Range) -> None:
        async def put(**changes: Any) -> None:
            present = ranges_of(self._inputs)
            present[place] = replace(present[place], **changes)
            await self._change(with_ranges(self._inputs, present))

        def count(text: str) -> int | str:
            return int(text) if text.isdecimal() and len(text) < _LONGEST else text

        parts = (
            ("from", "From", lambda text: put(start=self._with_unit(now.key, text))),
            ("to", "To", lambda text: put(stop=self._with_unit(now.key, text))),
            ("count", "Number of values", lambda text: put(count=count(text))),
        )
        with ui.element("div").classes("range"):
            for name, label, typed in parts:
                self._field(f"vary.{now.key}.{name}", label, typed, test=f"vary-{place}-{name}")
            kinds = {"linear": "equal steps", "log": "equal ratios"}
            self._field(f"vary-{place}-spacing", "Spacing", lambda value: put(log=value == "log"), kinds)

    def _field(
        self,
        key: str,
        label: str,
        typed: Callable[[str], Awaitable[None]],
        options: Mapping[str, str] | None = None,
        test: str = "",
    ) -> None:
        """Field of a varied input; ``key`` is the key of its text."""
        self._axes[key] = control(test or key, label, typed, options)
        self._axes[key].show(text=_texts(self._inputs)[key])


def range_of(variable: Variable) -> Range:
    """Range of an input to begin with."""
    return Range(variable.key, variable.low, variable.high, log=variable.log)


def _shape(inputs: Inputs, choices: SweepChoices | None) -> tuple[Any, ...]:
    """Values on which the fields of the varied inputs depend."""
    offered = tuple((variable.key, variable.label) for variable in (choices.variables if choices else ()))
    return tuple(axis.key for axis in ranges_of(inputs)), str(lists_of(inputs)), offered


def _texts(inputs: Inputs) -> dict[str, str]:
    """Texts of all fields by their keys."""
    ranges = ranges_of(inputs)
    texts = {f"vary-{place}": "" for place in range(2)}
    for place, axis in enumerate(ranges):
        texts |= {f"vary-{place}": axis.key, f"vary-{place}-spacing": "log" if axis.log else "linear"}
        ends = {"from": axis.start, "to": axis.stop, "count": str(axis.count)}
        texts |= {f"vary.{axis.key}.{name}": text for name, text in ends.items()}
    return texts


# Only the number of the point goes to the server, not the whole figure.
_CLICKED = "(event) => emit(event.points.map((p) => p.customdata).find((n) => n !== undefined))"
_MAP = "Map of the sweep"
_STEPS = {"ArrowLeft": (-1, 0), "ArrowRight": (1, 0), "ArrowUp": (0, 1), "ArrowDown": (0, -1)}

# Most points whose table is written anew at each look while points are being solved.
_FEW = 200


# Verdicts of a sweep before its points are solved.
_NOTHING = Verdict("grey", "nothing-solved"), "Run fills the map."
_RUNNING = Verdict("grey", "solving"), "The verdict follows with the last of them."


# Words above a map that does not belong to the present inputs.
_OLD = (
    "The inputs have changed, or the result to show needs further numbers: Run computes them. This is the "
    "map of the ones before."
)


class MapPart:
    """Verdict on a sweep, its map, its notes and its table."""

    def __init__(self, session: Session, shown: Callable[[str], Awaitable[None]]) -> None:
        self.session = session
        self.shown = ""
        self._when_shown = shown
        self._ran: Inputs | None = None
        self._view: SweepView | None = None
        self._drawn = ""
        self._chosen: int | None = None
        self._address = ""
        self._build()

    @property
    def open_points(self) -> int:
        """Number of points that are not solved yet."""
        return self._view.counts.get("open", 0) if self._view else 0

    @property
    def differs(self) -> bool:
        """Whether the map shows another result than that which is asked for."""
        return self._view is not None and self._drawn != self.shown

    @property
    def finished(self) -> bool:
        """Whether every point has been tried with an end that another try would not change."""
        counts = self._view.counts if self._view else {}
        return bool(counts) and not counts.get("open") and not counts.get("failed")

    def _build(self) -> None:
        with ui.element("div").classes("answer-body") as self._body:
            self._panel = Panel((), "")
            self._note = ui.label().classes("soft").props('data-testid="map-note"')
            self._select = control("show", "Result to show", self._other, {}, kind="search")
            with ui.element("div").classes("map-keys").props('tabindex="0" data-testid="map"') as self._keys:
                self._plot = page_parts.Plot({}, _MAP)
                self._plot.on("plotly_click", self._clicked, js_handler=_CLICKED)
            self._keys.on("keydown", self._pressed, js_handler=page_parts.script("map_keys"))
            self._keys.set_visibility(False)
            self._point = ui.element("div").classes("point").props('aria-live="polite" data-testid="point"')
            self._notes = NoteList()
            with ui.expansion("Table of the points").props('data-testid="points"') as self._points:
                self._table = ui.table(columns=[], rows=[], row_key="number", pagination=10).classes(
                    "points-table"
                )
                self._table.add_slot("body-cell-number", _BUTTON)
                self._table.on("choose", self._from_table)
        self.clear()

    def offer(self, values: Mapping[str, str], shown: str) -> None:
        """Offer results to show; the first unless another is asked for."""
        options = {} if self._view is None else dict(self._view.values)
        options = {**values, **{key: name for key, name in options.items() if key not in values}}
        if shown and shown not in options:
            options[shown] = shown
        self.shown = shown or next(iter(values), self.shown)
        listed = [{"value": key, "label": name, "group": ""} for key, name in options.items()]
        self._select.show(options=listed, text=self.shown)

    def began(self, ran: Inputs) -> None:
        """Remember the inputs of the points that are being solved."""
        if self._ran != ran:
            self._ran, self._chosen = ran, None
            self._point.clear()

    def clear(self) -> None:
        """Take everything away."""
        self._view = self._ran = self._chosen = None
        self._point.clear()
        self._panel.verdict.show(*_NOTHING)
        self._panel.tell(Deciding(""), None, ())
        for part in (self._keys, self._points, self._notes.box):
            part.set_visibility(False)
        self._note.text = ""

    def outdated(self, *, old: bool) -> None:
        """Dim the map where the inputs have changed since."""
        page_parts.mark(self._body, "stale", on=old)
        if old:
            self._note.text = _OLD
        elif self._view is not None:
            self._note.text = _points_text(self._view)

    def show(self, view: SweepView, *, running: bool) -> None:
        """Show the state of a sweep."""
        self._view = view
        self._drawn = self.shown
        self._note.text = _points_text(view)
        if self._chosen is not None and self._chosen >= len(view.chart.points):
            self._chosen = None
        self._draw()
        self._keys.set_visibility(True)
        judged = _RUNNING if running else (view.verdict, view.meaning)
        self._panel.verdict.show(*judged, view.deciding.said)
        self._panel.tell(view.deciding, None if running else view.number, ())
        if not running:
            self._notes.show([Note(warning) for warning in view.warnings])
        if not running or len(view.rows) <= _FEW:
            self._fill(view)

    def _draw(self) -> None:
        view = self._view
        if view is None:
            return
        figure = dict(view.figure)
        figure["data"] = [*figure["data"], chosen_trace(view.chart, self._chosen)]
        self._plot.show(figure, _MAP)
        about = f"{view.chart.title} over {' and '.join(view.chart.inputs)}"
        about += "; arrow keys choose a point, Enter opens its case; the table below has all numbers"
        self._keys.props.update({"role": "group", "aria-label": about})

    def _fill(self, view: SweepView) -> None:
        columns = [{"name": "number", "label": "Point", "field": "number", "sortable": True}]
        columns += [
            {"name": f"c{k}", "label": name, "field": f"c{k}", "align": "left"}
            for k, name in enumerate(view.columns[1:])
        ]
        self._table.columns = columns
        self._table.rows = [
            {"number": int(row[0]), **{f"c{k}": cell for k, cell in enumerate(row[1:])}} for row in view.rows
        ]
        self._points.set_visibility(True)

    async def _other(self, key: str) -> None:
        self.shown = key
        self._select.show(text=key)
        await self._when_shown(key)

    async def _clicked(self, event: Any) -> None:
        if isinstance(event.args, int) and await self._choose(event.args):
            ui.navigate.to(self._address, new_tab=True)

    async def _from_table(self, event: Any) -> None:
        if isinstance(event.args, int):
            await self._choose(event.args)

    async def _pressed(self, event: Any) -> None:
        if self._view is None:
            return
        if event.args == "Enter":
            if self._chosen is not None and self._address:
                ui.navigate.to(self._address, new_tab=True)
            return
        right, up = _STEPS[str(event.args)]
        width, height = (*self._view.chart.shape, 1)[:2]
        i, j = (0, 0) if self._chosen is None else divmod(self._chosen, height)
        if self._chosen is not None:
            i, j = i + right, j + up
        if 0 <= i < width and 0 <= j < height:
            await self._choose(i * height + j)

    async def _choose(self, number: int) -> bool:
        """Choose a point; whether it has a case that a page can show."""
        view, ran = self._view, self._ran
        if view is None or ran is None or not 0 <= number < len(view.chart.points):
            return False
        self._chosen, self._address, refused = number, "", ""
        self._draw()
        folder = str(self.session.folder / "sweep")
        try:
            point = await self.session.work.quick(SWEEP_POINT, folder, dict(ran.table), number)
            self._address = f"{point.path}?{point.query}"
        except (InputError, LostError) as error:
            refused = str(error)
        self._tell(view, number, refused)
        return bool(self._address)

    def _tell(self, view: SweepView, number: int, refused: str) -> None:
        self._point.clear()
        with self._point:
            page_parts.heading(f"Point {number}", 3)
            with ui.element("ul"):
                for text in view.chart.points[number].texts:
                    with ui.element("li"):
                        ui.label(text)
            if self._address:
                name = page_texts("open")[self._address.partition("?")[0]]
                link = ui.link(f"{name} (new tab)", self._address, new_tab=True)
                link.props('data-testid="open-point"')
            else:
                ui.label(f"It has no page: {refused}").classes("wrong")


_BUTTON = """
<q-td :props="props">
  <button type="button" class="choose" @click="() => $parent.$emit('choose', props.row.number)"
    :aria-label="'choose point ' + props.row.number">{{ props.row.number }}</button>
</q-td>
"""


def chosen_trace(chart: Chart, chosen: int | None) -> dict[str, Any]:
    """Trace that marks the chosen point; without one it is empty."""
    points = [] if chosen is None else [chart.points[chosen]]
    return {
        "type": "scatter",
        "mode": "markers",
        "x": [point.place[0] for point in points],
        "y": [point.place[1] for point in points],
        "yaxis": points[0].axis if points else "y",
        "marker": {"symbol": "square-open", "size": 16, "color": ORANGE, "line": {"width": 3}},
        "hoverinfo": "skip",
        "showlegend": False,
    }


def _points_text(view: SweepView) -> str:
    """How many points have which state, and how their contacts are computed."""
    words = page_texts("states")
    some = (f"{count} {words.get(state, state)}" for state, count in view.counts.items())
    return f"Points: {', '.join(some)}. {view.accuracy}".rstrip()


_PATH = "/sweep"

# Shortest time between two looks at the database [s]; where reading takes longer, looks are rarer.
_LOOK = 1.0
_SHARE = 4.0


def add(work: Work) -> None:
    """Add the page to the server."""

    @ui.page(_PATH, response_timeout=PAGE_PATIENCE)
    async def page(request: Request) -> None:
        inputs, error = Inputs.of_link(request.query_params.multi_items(), Inputs())
        given = sweep_inputs(inputs)
        if given is None and inputs.table and error is None:
            error = InputError("address", "has no case", takes="the inputs of a case, or of a sweep")
        page = SweepPage(session_of(work, SWEEP if given is None else given))
        with framed("Sweep: what happens over a range?", _PATH):
            page.build(error)
        if await connected():
            await page.begin()


class SweepPage:
    """Page of one tab."""

    def __init__(self, session: Session) -> None:
        self.session = session
        self.workers = max(1, cores() - 1)
        self._request = 0
        self._choices: SweepChoices | None = None
        # Inputs whose points the map shows; None where nothing was run. The database has them, until a run of
        # other inputs, the submitted ones, has begun to write its own.
        self._ran: Inputs | None = None
        self._submitted: Inputs | None = None
        self._job: Job | None = None
        self._started = self._next = 0.0
        self._first = 0
        # Time of a point in the last run, on all its processes together [s], and what it depends on.
        self._pace: tuple[Any, float] | None = None
        self._looking = self._valid = False

    @property
    def folder(self) -> str:
        """Folder of the database."""
        return str(self.session.folder / "sweep")

    def build(self, error: InputError | None) -> None:
        """Build the form, the buttons and the place of the map."""
        self.toolbar = Toolbar(self.session, _PATH, self.shown_again)
        page_parts.address_error(error)
        with ui.element("div").classes("columns") as self._place:
            self.form = RangesForm(self.session.inputs, None, self.change)
            with ui.element("section").classes("answer").props('aria-label="Sweep"'):
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
        """Take over inputs; inputs without varied keys get the usual ranges."""
        self._request += 1
        request = self._request
        if inputs.value("vary"):
            self._take(inputs)
        try:
            choices = await self.session.work.quick(SWEEP_CHOICES, dict(inputs.value("case") or {}))
        except (InputError, LostError) as error:
            if request == self._request:
                self._take(inputs)
                self._refuse(error)
            return
        if request != self._request:
            return
        self._choices = choices
        if not inputs.value("vary"):
            inputs = with_ranges(inputs, [range_of(variable) for variable in choices.variables[:2]])
            if begins:
                # Nothing was there before that an undo could show.
                self.session.history.now = inputs
        self._take(inputs)
        if self._ran is not None and self.map.differs:
            await self._read()
        await self._plan(request)

    def _take(self, inputs: Inputs) -> None:
        self.session.history.push(inputs)
        show_address(inputs, _PATH)
        self.form.set(inputs, self._choices)
        self.map.offer(self._choices.values if self._choices else {}, str(inputs.value("show") or ""))
        self._tell_state()

    async def _plan(self, request: int) -> None:
        self.plan.text = "Checking …"
        self._allow(valid=True)
        try:
            plan = await self.session.work.quick(SWEEP_PLANNED, self._table(), self.workers)
        except (InputError, LostError) as error:
            if request == self._request:
                self._refuse(error)
            return
        if request == self._request:
            self.form.tell(None)
            self.plan.text = _in_words(self._paced(plan))

    def _paced(self, plan: SweepPlan) -> SweepPlan:
        """Plan with the time that the points of the same base case took, where some are solved."""
        if self._pace is None or self._pace[0] != _work_of(self.session.inputs):
            return plan
        return replace(plan, seconds=plan.points * self._pace[1])

    def _table(self) -> dict[str, Any]:
        return dict(sweep_file(self.session.inputs).table)

    def _allow(self, *, valid: bool) -> None:
        self._valid = valid
        self._tell_state()

    def _refuse(self, error: Exception) -> None:
        self._allow(valid=False)
        self.plan.text = str(error)
        if isinstance(error, InputError):
            self.plan.text = "The inputs cannot be run; see what is wrong next to them."
            self.form.tell(error)

    async def _show(self, key: str) -> None:
        """Show another result of the points."""
        before, inputs = sweep_file(self.session.inputs), with_shown(self.session.inputs, key, self._ran)
        if sweep_file(inputs) != before:
            # Points need other results, which takes another time.
            await self._set(inputs)
            return
        self.session.history.push(inputs)
        show_address(self.session.inputs, _PATH)
        if self._ran is not None:
            await self._read()

    def _controls(self) -> None:
        with card("Run"):
            self.plan = ui.label().props('data-testid="plan" aria-live="polite"')
            with ui.element("div").classes("buttons"):
                self.run = page_parts.button("Run", "solve", self._run, "no-caps unelevated", primary=True)
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
                files = page_texts("downloads")["sweep"]
                self.downloads = [self._download_of(*about) for about in files]
            ui.label("ehlectric sweep sweep.toml runs this file; the files are those that it writes.")
        Downloads(self.session, "sweep", self._finished_folder, only_made=True)

    def _finished_folder(self) -> Path | None:
        """Folder of the database, where it has points of the present inputs and is not written to."""
        return self.session.folder / "sweep" if self._same and not self.stop.enabled else None

    @property
    def _same(self) -> bool:
        """Whether the map shows the sweep of the present inputs."""
        return self._ran is not None and same_sweep(self._ran, sweep_file(self.session.inputs))

    def _download_of(self, test_id: str, label: str, name: str) -> ui.button:
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
            self._job = self.session.work.start(SWEEP_SOLVED, self._table(), self.folder, self.workers)
        except LostError as error:
            self.failure.text = str(error)
            return
        self._submitted = sweep_file(self.session.inputs)
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
            self._ran = self._submitted = None
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
        if solved > 0 and self._submitted is not None:
            self._pace = (_work_of(self._submitted), passed / solved)
        more = f" ({job.text})" if job.text else ""
        self.state.text = f"{job.done} of {job.of} points done{more}{self._left(job, 'about {} left')}"

    def _left(self, job: Job, text: str) -> str:
        """Time that the other points of a job will take, in a text; empty where none is solved yet."""
        if self._pace is None or job.done >= job.of or job.done <= self._first:
            return ""
        return f", {text.format(duration((job.of - job.done) * self._pace[1]))}"

    def _end(self, job: Job) -> None:
        """Say how a job has ended, after the last look at its points."""
        if self._submitted is not self._ran:
            # The job ended before its sweep was in the database, which still contains the sweep of the map.
            self._submitted = self._ran
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
        """Look at the points, and show them if they belong to the submitted sweep."""
        begun, inputs = time.monotonic(), self._submitted
        if inputs is None:
            return
        try:
            view = await self.session.work.quick(SWEEP_SEEN, self.folder, self.map.shown, dict(inputs.table))
        except (InputError, LostError) as error:
            # A job that has just begun has no database yet.
            if not running and self._job is not None and self._job.state == "done":
                self.failure.text = str(error)
            return
        finally:
            self._next = time.monotonic() + max(_LOOK, _SHARE * (time.monotonic() - begun))
        if view is None or inputs is not self._submitted:
            return
        self._ran = inputs
        self.map.began(inputs)
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


def _work_of(inputs: Inputs) -> tuple[Any, Any]:
    """Inputs on which the time of a point depends: its base case and its samples."""
    return inputs.value("case"), inputs.value("uncertainty_samples")


def duration(seconds: float) -> str:
    """Time in words, with two digits.

    Examples
    --------
    >>> duration(12.3), duration(200.0), duration(9000.0)
    ('12 s', '3.3 min', '2.5 h')
    """
    if seconds < 100.0:
        return f"{max(1, round(seconds))} s"
    return f"{readable(seconds / 60.0, 2)} min" if seconds < 5400.0 else f"{readable(seconds / 3600.0, 2)} h"


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
