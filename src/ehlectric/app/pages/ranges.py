"""Form of the sweep page: the base case, and one or two inputs with their ranges."""

from __future__ import annotations

from collections.abc import Awaitable, Callable, Mapping, Sequence
from dataclasses import replace
from typing import Any

from nicegui import ui

from ehlectric.app.answers.sweep import SweepChoices, Variable
from ehlectric.app.fields import Group
from ehlectric.app.fields.words import in_field_unit
from ehlectric.app.inputs import Inputs
from ehlectric.app.pages.form import Form, groups_for
from ehlectric.app.pages.parts import card
from ehlectric.app.pages.starts import DRIVE, start
from ehlectric.app.ranges import Range, case_of_link, lists_of, ranges_of, with_ranges
from ehlectric.errors import InputError

Change = Callable[[Inputs], Awaitable[None]]

# Examples that may be the base case. Their films are computed as they say.
EXAMPLES = {
    "bearing_6208": "Ball bearing 6208 in a drive",
    "drive": "Inverter, motor and both bearings",
    "discharge": "Line contact with breakdown",
    "oil_contact": "Ball on disc",
}

_NONE = "no second input"

# Longest text that is read as a number of values [characters].
_LONGEST = 7

# Number of choices above which a list can be searched by typing.
_SEARCHED = 9


class Box:
    """Text field whose error is told beside it.

    Parameters
    ----------
    label, value : str
        Label and text.
    test_id : str
        Name of the field for tests.
    typed : callable
        Called with a new text.
    """

    def __init__(self, label: str, value: str, test_id: str, typed: Callable[[str], Awaitable[None]]) -> None:
        async def changed() -> None:
            await typed(str(self._input.value or "").strip())

        with ui.element("div").classes("sweep-box"):
            self._input = ui.input(label, value=value).props("outlined dense").classes("full")
            self._input.props(f"data-testid=field-{test_id}")
            self._input.on("change", changed)
            self._error = ui.label().classes("wrong")
            self._error.props(f'role="alert" id="wrong-{test_id}" data-testid="error-{test_id}"')

    def put(self, text: str) -> None:
        """Show another text."""
        if self._input.value != text:
            self._input.value = text

    def tell(self, text: str) -> None:
        """Show an error; an empty text takes it away."""
        self._error.text = text
        self._error.set_visibility(bool(text))
        name = self._error.props["id"]
        if text:
            self._input.props(f'error hide-bottom-space aria-invalid=true aria-describedby="{name}"')
        else:
            self._input.props(remove="error aria-invalid aria-describedby")


class RangesForm:
    """Form of a sweep.

    Parameters
    ----------
    inputs : Inputs
        Present inputs.
    choices : SweepChoices or None
        What may vary; None where the base case is not valid.
    change : callable
        Called with new inputs.
    """

    def __init__(self, inputs: Inputs, choices: SweepChoices | None, change: Change) -> None:
        self._inputs, self._choices, self._change = inputs, choices, change
        self._boxes: dict[str, Box] = {}
        self._selects: dict[str, ui.select] = {}
        self._groups: Sequence[Group] | None = None
        self._focus = ""
        with ui.element("div").classes("form sweep-form").props('role="form" aria-label="Sweep"'):
            with card("What varies"):
                self._varied = ui.element("div")
                self._message = ui.label().classes("wrong").props('role="alert" data-testid="error-form"')
            with card("Base case"):
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
            if key in self._boxes:
                self._boxes[key].put(text)
            elif key in self._selects:
                self._selects[key].value = text if text in self._selects[key].options else None

    def tell(self, error: InputError | None) -> None:
        """Show an error beside its field, and take away the one before."""
        for box in (*self._boxes.values(), self._link):
            box.tell("")
        self._message.text = ""
        self.case.tell(None)
        key = "" if error is None else str(error.key or "")
        found = self._boxes.get(key) or self._boxes.get(f"{key}.from")
        if error is None:
            return
        if found is not None:
            found.tell(self._in_unit(key, error.text))
        elif key and not f"{key}.".startswith("vary."):
            self._values.open()
            self.case.tell(InputError(key.removeprefix("case."), error.text))
        else:
            self._message.text = str(error)

    def _in_unit(self, key: str, text: str) -> str:
        """Text of an error of a range with its bounds in the unit of the field of its input."""
        name = key.removeprefix("vary.").rpartition(".")[0]
        fields = [field for group in self._groups or () for field in group.fields if field.key == name]
        return in_field_unit(fields[0], text) if fields else text

    def _build_axes(self) -> None:
        """Fields of the varied inputs."""
        self._boxes.clear()
        for name in [name for name in self._selects if name.startswith("vary")]:
            del self._selects[name]
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
        if self._focus in self._selects:
            self._selects[self._focus].run_method("focus")
        self._focus = ""

    def _build_base(self) -> None:
        """Source of the base case, and its inputs in the form of its page."""
        self._title = ui.label().classes("case-title")
        chosen = ui.select(EXAMPLES, label="Take an example", on_change=self._example)
        chosen.props("outlined dense data-testid=base-example").classes("full")
        self._link = Box("or paste a link of a page", "", "base-link", self._take_over)
        with ui.element("div") as self._kind:
            kinds = {
                "atlas": "from the atlas: half a second each",
                "formula": "by formula: half a second each",
                "solved": "solved: ten seconds or more each",
            }
            self._select("case.contacts", "Contacts of the bearing", kinds, self._contacts)
        self._page = ui.link("Open the base case on its page", "/", new_tab=True)
        self._values = ui.expansion("Inputs of the base case").props('data-testid="base-inputs"')

    def _set_base(self) -> None:
        """Show the base case."""
        case = Inputs(self._inputs.value("case") or {})
        self._title.text = str(case.value("title") or "Case without a title")
        path = "/drive" if case.value("drive_end") else "/" if case.value("bearing") else "/contact"
        self._page.props["href"] = f"{path}?{case.address()}"
        self._page.update()
        self._kind.set_visibility(bool(case.value("bearing")))
        self._selects["case.contacts"].value = _texts(self._inputs)["case.contacts"]
        if self._groups is groups_for(case):
            self.case.set(case)
            return
        self._groups = groups_for(case)
        self._values.clear()
        with self._values:
            self.case: Form = Form(self._groups, case, self._changed_case, label="Inputs of the base case")

    async def _changed_case(self, key: str, value: Any) -> None:
        await self._change(self._inputs.changed({f"case.{key}": value}))

    async def _example(self, event: Any) -> None:
        table = dict((DRIVE if event.value == "drive" else start(str(event.value))).table)
        await self._change(Inputs({"case": table | ({"contacts": "atlas"} if "bearing" in table else {})}))

    async def _take_over(self, link: str) -> None:
        found = case_of_link(link)
        if found is not None:
            await self._change(Inputs({"case": found}))
        elif link:
            self._link.tell("this link has no bearing, drive or contact: copy one of their pages")

    async def _contacts(self, value: str) -> None:
        await self._change(self._inputs.changed({"case.contacts": value}))

    def _axis(self, place: int, ranges: Sequence[Range]) -> None:
        """Fields of one varied input."""
        now = ranges[place] if place < len(ranges) else None
        others = {one.key for one in ranges} - ({now.key} if now else set())
        names = {key: one.label for key, one in self._offered().items() if key not in others}
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
            self._select(name, title, {"": _NONE, **names} if place else names, chosen)
            if now is not None:
                self._range(place, now)

    def _offered(self) -> dict[str, Variable]:
        """Inputs that can be varied, by key."""
        return {one.key: one for one in (self._choices.variables if self._choices else ())}

    def _range(self, place: int, now: Range) -> None:
        async def put(**changes: Any) -> None:
            present = ranges_of(self._inputs)
            present[place] = replace(present[place], **changes)
            await self._change(with_ranges(self._inputs, present))

        async def first(text: str) -> None:
            await put(start=text)

        async def last(text: str) -> None:
            await put(stop=text)

        async def count(text: str) -> None:
            await put(count=int(text) if text.isdecimal() and len(text) < _LONGEST else text)

        async def spacing(value: str) -> None:
            await put(log=value == "log")

        parts = (
            ("from", "From", now.start, first),
            ("to", "To", now.stop, last),
            ("count", "Number of values", str(now.count), count),
        )
        with ui.element("div").classes("range"):
            for name, label, value, typed in parts:
                self._boxes[f"vary.{now.key}.{name}"] = Box(label, value, f"vary-{place}-{name}", typed)
            kinds = {"linear": "equal steps", "log": "equal ratios"}
            self._select(f"vary-{place}-spacing", "Spacing", kinds, spacing)

    def _select(
        self, name: str, label: str, options: Mapping[str, str], chosen: Callable[[str], Awaitable[None]]
    ) -> None:
        """List to choose from; ``name`` is its key among the texts of the inputs."""

        async def changed(event: Any) -> None:
            if event.value is not None and event.value != _texts(self._inputs)[name]:
                await chosen(str(event.value))

        text = _texts(self._inputs)[name]
        value = text if text in options else None
        box = ui.select(
            dict(options), label=label, value=value, on_change=changed, with_input=len(options) > _SEARCHED
        )
        box.props(f"outlined dense data-testid=field-{name.replace('.', '-')}").classes("full")
        self._selects[name] = box


def range_of(variable: Variable) -> Range:
    """Range of an input to begin with."""
    return Range(variable.key, variable.low, variable.high, log=variable.log)


def _shape(inputs: Inputs, choices: SweepChoices | None) -> tuple[Any, ...]:
    """Values on which the fields of the varied inputs depend."""
    offered = tuple((one.key, one.label) for one in (choices.variables if choices else ()))
    return tuple(one.key for one in ranges_of(inputs)), str(lists_of(inputs)), offered


def _texts(inputs: Inputs) -> dict[str, str]:
    """Texts of all fields by their keys."""
    ranges = ranges_of(inputs)
    texts = {"case.contacts": str(inputs.value("case.contacts") or "solved")}
    texts |= {f"vary-{place}": "" for place in range(2)}
    for place, one in enumerate(ranges):
        texts |= {f"vary-{place}": one.key, f"vary-{place}-spacing": "log" if one.log else "linear"}
        ends = {"from": one.start, "to": one.stop, "count": str(one.count)}
        texts |= {f"vary.{one.key}.{name}": text for name, text in ends.items()}
    return texts
