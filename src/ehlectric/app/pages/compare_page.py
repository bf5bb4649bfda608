"""Page of two cases side by side: what differs, and the effect on every result."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from functools import partial
from html import escape
from typing import Any, Literal

from fastapi import Request
from nicegui import ui

from ehlectric.app.calls import COMPARE_SIDE, COMPARE_WHOLE_SIDE, Call
from ehlectric.app.charts import compare_charts as figures
from ehlectric.app.form_fields.axle_fields import other_inputs
from ehlectric.app.latest_answer import LatestAnswer
from ehlectric.app.page_inputs import Inputs
from ehlectric.app.pages import page_parts
from ehlectric.app.pages.form import Form, groups_for, shape_of_form
from ehlectric.app.pages.frame import (
    BEARING,
    PAGE_PATIENCE,
    PATHS,
    OpenFile,
    Toolbar,
    address_of,
    compared_part,
    framed,
    session_of,
    show_address,
)
from ehlectric.app.pages.result_parts import FigureBox, Panel, behind, note_html
from ehlectric.app.session import Session
from ehlectric.app.view_models import (
    Deciding,
    Effect,
    Figure,
    InputRow,
    Note,
    Result,
    Side,
    Uploaded,
    counts,
    effects,
    file_title,
    in_both,
    input_rows,
    only_in,
)
from ehlectric.app.work import Work
from ehlectric.errors import InputError, LostError
from ehlectric.quantities.verdict import Verdict

# Words of the signs of inputs, for readers who cannot see that a row is marked.
_SIGNS = {"=": "equal", "≠": "≠ differs", "only A": "only in A", "only B": "only in B"}


def inputs_table(rows: Sequence[InputRow], labels: Mapping[str, str]) -> str:
    """Table of the inputs that differ, and of all others in a part that can be opened."""
    differ = [row for row in rows if row.sign != "="]
    equal = [row for row in rows if row.sign == "="]
    first = _inputs(differ, labels, "inputs-differ") if differ else "<p>Both cases have the same inputs.</p>"
    return first + behind(f"{len(equal)} inputs that are equal", _inputs(equal, labels, "inputs-equal"))


def effects_table(effects: Sequence[Effect]) -> str:
    """Table of the results that decide, and of all others in a part that can be opened."""
    main = [effect for effect in effects if effect.either.main]
    others = [effect for effect in effects if not effect.either.main]
    return _effects(main) + behind(f"{len(others)} further results", _effects(others))


def _inputs(rows: Iterable[InputRow], labels: Mapping[str, str], test: str) -> str:
    body = ""
    for row in rows:
        test_id = _quoted(f"input-{row.key.replace('.', '-')}")
        body += (
            f"<tr{' class=differs' if row.sign != '=' else ''} data-testid={test_id}>"
            f"<th scope=row>{_named(labels.get(row.key, ''), row.key)}</th>"
            f"<td>{escape(row.first) or '–'}</td><td>{escape(row.second) or '–'}</td>"
            f"<td>{_SIGNS[row.sign]}</td></tr>"
        )
    heads = ("input", "A", "B", "A and B")
    return page_parts.scrolling_table(test.replace("-", " "), heads, body, test)


def _effects(effects: Iterable[Effect]) -> str:
    body, group = "", None
    for effect in effects:
        either = effect.either
        if either.group != group:
            group = either.group
            body += f"<tr class=grouped><th colspan=4 scope=rowgroup>{escape(group)}</th></tr>"
        test = f"effect-{file_title(either.name)}"
        differs = " class=differs" if effect.large else ""
        body += (
            f"<tr{differs} data-testid={_quoted(test)}><th scope=row>{escape(either.name)}</th>"
            f"{_cell(effect.first)}{_cell(effect.second)}<td>{escape(effect.words)}</td></tr>"
        )
    return page_parts.scrolling_table("effects", ("result", "A", "B", "from A to B"), body, "effects")


def _cell(result: Result | None) -> str:
    if result is None:
        return "<td>–</td>"
    note = f"<span class=note>{escape(result.note)}</span>" if result.note else ""
    return f"<td>{escape(result.with_unit)}{note}</td>"


def _named(label: str, key: str) -> str:
    """Name of an input with its key beneath."""
    return f"{escape(label)}<span class=note>{escape(key)}</span>" if label else escape(key)


def _quoted(text: str) -> str:
    return f'"{escape(text, quote=True)}"'


def notes_html(first: Side, second: Side) -> str:
    """Notes of two cases: of only one, and of both."""
    parts = (
        ("Only A", only_in(first, second)),
        ("Only B", only_in(second, first)),
        ("Both, in the words of A", in_both(first, second)),
    )
    return "".join(
        f"<h3>{words}: {counts(warnings)}</h3>{''.join(note_html(Note(warning)) for warning in warnings)}"
        for words, warnings in parts
    )


def drawn(sides: tuple[Side, Side]) -> dict[str, Figure | None]:
    """Figures of two cases by name; None where one of them has no numbers for it."""
    over_speed = films = None
    if all(side.voltages for side in sides):
        title, words = (
            "First breakdown and shaft voltage over the speed",
            "Voltages of A and B over the speed",
        )
        over_speed = Figure(title, words, figures.over_speed(sides))
    if all(side.films for side in sides):
        title, words = "Minimum film of the elements [µm]", "Minimum film over the position of the elements"
        films = Figure(title, words, figures.films(sides))
    ratios = None
    if all(side.ratios for side in sides):
        title = "Voltage after an edge / breakdown voltage"
        ratios = Figure(
            title,
            "Bars of the bearings and meshes of A and B",
            figures.ratios(sides),
            caption="Above 1 the element breaks down.",
        )
    return {"over-speed": over_speed, "films": films, "ratios": ratios}


_PATH = "/compare"
Name = Literal["a", "b"]
Sides = tuple[Side | Exception, Side | Exception]
_NAMES: tuple[Name, Name] = ("a", "b")
_LOOKS: dict[Name, str] = {"a": "side first", "b": "side second"}

# Two cases with which the page begins: a bearing at two speeds.
_START = Inputs(
    {"a": dict(BEARING.table), "b": dict(BEARING.changed({"bearing.inner_speed": "1000 rpm"}).table)}
)

# Time for which the page waits for its first answer before it is sent without one [s].
_FIRST = 0.4

_LATE = "contacts not solved; the critical speeds took too long and are omitted"
_EARLIER = "A case has no answer: the effects below, if any, belong to earlier inputs."

# Kinds of files that have an answer here.
_COMPARED = ("bearing", "axle", "contact", "motion")
_NOTHING = "<p>The effects stand here when both cases have an answer.</p>"


def add(work: Work) -> None:
    """Add the page to the server."""

    @ui.page(_PATH, response_timeout=PAGE_PATIENCE)
    async def page(request: Request) -> None:
        inputs, error = Inputs.of_link(request.query_params.multi_items(), _START)
        given = [isinstance(inputs.value(name), Mapping) for name in _NAMES]
        if not all(given):
            # A link with one case compares it with itself.
            case = next(
                (inputs.value(name) for name, there in zip(_NAMES, given, strict=True) if there), None
            )
            inputs = Inputs({"a": case, "b": case}) if case else _START
        page = ComparePage(session_of(work, inputs))
        ui.context.client.on_delete(page.close)
        with framed("Two cases side by side", _PATH):
            page.build(error)
        # The first answer comes with the page, unless the processes are still starting.
        await asyncio.wait([page.refresh()], timeout=_FIRST)


class SideBox:
    """Title, panel and link of one of two cases, and the button that opens the file of another one."""

    def __init__(
        self, name: Name, session: Session, opened: Callable[[Name, Uploaded], Awaitable[None]]
    ) -> None:
        self._name, self._opened = name, opened
        with ui.element("section").classes(f"{_LOOKS[name]} answer").props(f'data-testid="side-{name}"'):
            with ui.element("div").classes("toolbar"):
                page_parts.heading(f"Case {name.upper()}", 2)
                self._file = OpenFile(session, name, self._open, self._tell)
                self._error = ui.label().classes("wrong").props(f'role="alert" data-testid="error-{name}"')
            self._title = ui.label("").props(f'data-testid="title-{name}"')
            self._panel = Panel((), "")
            self._link = ui.link("Open only this case", "/")

    async def _open(self, uploaded: Uploaded) -> None:
        """Take up a file that has an answer here."""
        if uploaded.kind not in _COMPARED:
            self._tell(error=f"{uploaded.name} belongs to the page {PATHS[uploaded.kind]}: open it there")
            return
        self._tell()
        await self._opened(self._name, uploaded)

    def _tell(self, text: str = "", *, error: str = "") -> None:
        self._error.text = error or text

    def show(self, answer: Side | Exception, case: Inputs) -> None:
        """Show the answer about a case, or why there is none."""
        self._link.set_visibility(isinstance(answer, Side))
        if isinstance(answer, Exception):
            self._title.text = ""
            self._panel.verdict.show(Verdict("grey", "no-answer"), str(answer))
            self._panel.tell(Deciding(""), None, ())
            return
        self._title.text = answer.title or "no title"
        self._panel.verdict.show(answer.verdict, answer.meaning, answer.deciding.said)
        self._panel.tell(answer.deciding, answer.number, ())
        path = PATHS[answer.kind]
        self._link.props["href"] = address_of(path, case)
        self._link.update()


class ComparePage:
    """Page of one tab; its inputs have one case in the table ``a`` and one in ``b``."""

    def __init__(self, session: Session) -> None:
        self.session = session
        self._forms: dict[Name, Form] = {}
        self._shapes: dict[Name, Any] = {}
        self._quick: Sides | None = None
        self._latest_answer: LatestAnswer[Inputs, Sides] = LatestAnswer(
            self._at_once,
            [self._whole],
            show=self._show,
            passing=self._show,
            refuse=self._refuse,
            behind=session.work.behind,
        )

    def case(self, name: Name) -> Inputs:
        """Inputs of one of both cases."""
        return Inputs(self.session.inputs.value(name) or {})

    def build(self, error: InputError | None) -> None:
        """Build the forms and the places of the answers."""
        self.toolbar = Toolbar(self.session, _PATH, self.show, opens=False)
        page_parts.address_error(error)
        with ui.element("div").classes("toolbar").props('role="toolbar" aria-label="Both cases"'):
            page_parts.tool("Swap A and B", "swap", partial(self._take, "b", "a"))
            page_parts.tool("Take B as A", "b-as-a", partial(self._take, "b", "b"))
            page_parts.tool("Take A as B", "a-as-b", partial(self._take, "a", "a"))
        with ui.element("div").classes("sides"):
            self._sides = {name: SideBox(name, self.session, self._open) for name in _NAMES}
        self._notice = ui.label(_EARLIER).classes("wrong notice").props('role="status" data-testid="notice"')
        self._notice.set_visibility(False)
        with ui.element("div").classes("answer").props('data-testid="compared"'):
            # The effects stand above the forms, so that a form that is opened does not push them away.
            self._answers = [ui.element("div").classes("compared")]
            with ui.element("div").classes("sides changing"):
                self._places = {name: self._inputs_of(name) for name in _NAMES}
            self._answers.append(ui.element("div").classes("compared"))
        self._build_answer()
        self._set_forms()

    def _inputs_of(self, name: Name) -> ui.expansion:
        """Place of the form of a case, which is opened where an input is wrong."""
        with ui.element("section").classes(_LOOKS[name]).props(f'data-testid="form-{name}"'):
            form = ui.expansion(f"Change the inputs of {name.upper()}").props(f'data-testid="inputs-{name}"')
            return form.classes("inputs")

    def _build_answer(self) -> None:
        first, second = self._answers
        with first:
            page_parts.heading("Inputs", 2)
            self._inputs = ui.html("", sanitize=False)
            self._figures = {name: FigureBox(name) for name in ("over-speed", "ratios")}
            page_parts.heading("Effect on the results", 2)
            self._method = ui.label().classes("soft")
            self._effects = ui.html(_NOTHING, sanitize=False)
        with second:
            self._notes = ui.html("", sanitize=False).props('data-testid="warnings"')
            self._figures["films"] = FigureBox("films")

    def _set_forms(self) -> None:
        """Show the present inputs in the forms, which are made anew where a case needs another one."""
        for name in _NAMES:
            case = self.case(name)
            shape = shape_of_form(case)
            if self._shapes.get(name) == shape:
                self._forms[name].set(case)
                continue
            self._shapes[name] = shape
            place = self._places[name]
            place.clear()
            with place:
                words = f"Inputs of {name.upper()}"
                listed = other_inputs if case.value("shaft") else Inputs.flat
                self._forms[name] = Form(
                    groups_for(case), case, self._change(name), label=words, listed=listed
                )

    def _change(self, name: Name) -> Any:
        async def change(key: str, value: Any) -> None:
            case = self.case(name).changed({key: value})
            self._push({**self.session.inputs.table, name: dict(case.table)})
            if shape_of_form(case) != self._shapes[name]:
                # A field of the form that is made anew has no place on the page any more.
                with self._places[name]:
                    self._set_forms()

        return change

    async def _open(self, name: Name, uploaded: Uploaded) -> None:
        """Take the case of a file as one of both."""
        self._push({**self.session.inputs.table, name: compared_part(uploaded.table)})
        self._set_forms()

    def _take(self, first: Name, second: Name) -> None:
        """Take other cases as A and B."""
        self._push({"a": dict(self.case(first).table), "b": dict(self.case(second).table)})
        self._set_forms()

    def _push(self, table: Mapping[str, Any]) -> None:
        self.session.history.push(Inputs(table))
        show_address(self.session.inputs, _PATH)
        self.refresh()

    def show(self) -> None:
        """Show inputs that have changed in another way than by the forms."""
        self._set_forms()
        self.refresh()

    def refresh(self) -> asyncio.Task[None]:
        """Answer both cases at once, and then with their critical speeds."""
        for element in self._answers:
            page_parts.follow(element, on=bool(self._effects.content))
            page_parts.mark(element, "stopped", on=False)
        return self._latest_answer.ask(self.session.inputs)

    def close(self) -> None:
        """Want no further answers."""
        self._latest_answer.drop()

    async def _at_once(self, inputs: Inputs) -> Sides:
        first, second = await asyncio.gather(*(self._ask(COMPARE_SIDE, inputs, name) for name in _NAMES))
        self._quick = (first, second)
        return first, second

    async def _whole(self, inputs: Inputs) -> Sides:
        """Answers with the critical speeds, one after the other: others also need the processes."""
        sides: list[Side | Exception] = []
        for name, quick in zip(_NAMES, self._quick or (None, None), strict=True):
            if inputs != self.session.inputs:
                raise LostError("the inputs have changed")
            answer = await self._ask(COMPARE_WHOLE_SIDE, inputs, name)
            late = isinstance(answer, LostError) and isinstance(quick, Side)
            sides.append(replace(quick, method=_LATE) if late and isinstance(quick, Side) else answer)
        return sides[0], sides[1]

    def _refuse(self, error: Exception) -> None:
        """Say what is wrong with both cases together; the error of one case stands next to it."""
        self._notice.text = str(error)
        self._notice.set_visibility(True)
        for element in self._answers:
            page_parts.mark(element, "stopped", on=True)

    def _show(self, inputs: Inputs, sides: Sides) -> None:
        """Show the answers, and their differences where there are two."""
        for name, answer in zip(_NAMES, sides, strict=True):
            self._show_side(name, answer)
        first, second = sides
        both = isinstance(first, Side) and isinstance(second, Side)
        self._notice.text = _EARLIER
        self._notice.set_visibility(not both)
        for element in self._answers:
            page_parts.mark(element, "stopped", on=not both)
        if isinstance(first, Side) and isinstance(second, Side):
            self._show_both(inputs, first, second)

    async def _ask(self, call: Call[Side], inputs: Inputs, name: Name) -> Side | Exception:
        """Answer about one case, or its error."""
        table = dict(inputs.value(name) or {})
        try:
            return await self.session.work.quick(call, table, self.session.made_folder)
        except (InputError, LostError) as error:
            return error

    def _show_side(self, name: Name, answer: Side | Exception) -> None:
        self._forms[name].tell(answer if isinstance(answer, Exception) else None)
        if isinstance(answer, Exception):
            self._places[name].open()
        self._sides[name].show(answer, self.case(name))

    def _show_both(self, inputs: Inputs, first: Side, second: Side) -> None:
        """Show the differences of two answers."""
        changes = effects(first, second)
        cases = [Inputs(inputs.value(name) or {}) for name in _NAMES]
        self._method.text = "; ".join(dict.fromkeys((first.method, second.method)))
        self._effects.content = effects_table(changes)
        rows = input_rows(cases[0].table, cases[1].table, _flat_of(cases))
        self._inputs.content = inputs_table(rows, _labels(cases))
        for name, shown in drawn((first, second)).items():
            self._figures[name].show(shown)
        self._notes.content = notes_html(first, second)
        for element in self._answers:
            page_parts.follow(element, on=False)


def _flat_of(cases: Iterable[Inputs]) -> Callable[[Mapping[str, Any]], Mapping[str, Any]]:
    """Function that returns the inputs of a case by dotted key; keys of axles contain numbers."""
    axles = all(case.value("shaft") for case in cases)
    return lambda table: other_inputs(Inputs(table)) if axles else Inputs(table).flat()


def _labels(sides: Iterable[Inputs]) -> dict[str, str]:
    """Names of the inputs of cases by their keys."""
    groups = (group for case in sides for group in groups_for(case))
    return {field.key: field.label for group in groups for field in group.fields}
