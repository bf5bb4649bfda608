"""Page of an axle, which says which bearing or gear mesh breaks down first, and what changes that."""

from __future__ import annotations

from collections.abc import Awaitable, Callable, Iterable, Mapping
from functools import partial
from html import escape
from typing import Any, ClassVar

from nicegui import ui

from ehlectric.app.calls import AXLE_QUICK, AXLE_REMEDIED, AXLE_SIMULATED, AXLE_WHOLE, FILES_UPLOADED
from ehlectric.app.form_fields.axle_fields import (
    LISTS,
    SIMULATED,
    axle_groups,
    link_title,
    mesh_title,
    names_of,
    other_inputs,
    remedy_presets,
    request_of_rows,
    shaft_title,
    shape_of,
    summary_of,
    with_bearing,
    with_force,
    with_link,
    with_mesh,
    with_shaft,
    without_shaft,
    without_table,
)
from ehlectric.app.form_fields.drive_fields import force_title, remedies_of, with_remedy, without_remedy
from ehlectric.app.form_fields.field import form_data
from ehlectric.app.form_fields.measured_fields import measured_keys
from ehlectric.app.page_inputs import Inputs
from ehlectric.app.pages.answer_page import AnswerPage, ProbableView
from ehlectric.app.pages.file_field import WAVEFORM_FILE, UploadField, WaveformField
from ehlectric.app.pages.form import Form
from ehlectric.app.pages.frame import AXLE, PATHS
from ehlectric.app.pages.page_parts import GroupBox, button, follow, heading, page_texts, removable, say
from ehlectric.app.pages.result_parts import FigureBox, behind, table_html
from ehlectric.app.session import Session
from ehlectric.app.view_models import (
    AXLE_WITHOUT_PROBABILITY,
    MOST_CASE,
    AxleAnswer,
    NetworkNode,
    NetworkPart,
)
from ehlectric.errors import InputError, LostError

REMEDIES = "remedies"


# Colours and signs of the parts of a network are in axle.css. A bar is 100 wide and 8 high.
_BAR = (
    '<svg class="net-bar" viewBox="0 0 100 8" preserveAspectRatio="none" aria-hidden="true">'
    '<rect class="all" width="100" height="8"/><rect class="part" width="{width:.1f}" height="8"/>'
    '<line x1="50" x2="50" y1="0" y2="8"/></svg>'
)


def network_html(nodes: Iterable[NetworkNode]) -> str:
    """Picture of a network: a row for each shaft with its parts to the housing, and rows between shafts."""
    rows = []
    for node in nodes:
        name = f"<div class=net-node><b>{escape(node.name)}</b> <span>{escape(node.voltage)}</span></div>"
        parts = "".join(map(_part_html, node.to_housing))
        rows.append(f"<section class=net-shaft>{name}<ul>{parts}</ul></section>")
        if node.to_shafts:
            parts = "".join(map(_part_html, node.to_shafts))
            rows.append(f"<ul class=net-between>{parts}</ul>")
    return f"<div class=network>{''.join(rows)}</div>"


def _part_html(part: NetworkPart) -> str:
    """Part of a network: name and value, its voltages, and the bar of U/V_b."""
    look = " ".join(word for word in ("first", "conducts") if getattr(part, word))
    sign = "<em>first</em> " if part.first else ""
    bar = "" if part.bar is None else _BAR.format(width=100.0 * part.bar)
    voltage = f"<div class=net-voltage>{escape(part.voltage)}</div>" if part.voltage else ""
    head = f"{sign}<b>{escape(part.name)}</b> {escape(part.value)}"
    return f'<li class="{look}"><div>{head}</div>{voltage}{bar}</li>'


class AxleView(ProbableView[AxleAnswer]):
    """Place of an answer about an axle."""

    rows_name = "Numbers of the axle"
    keys = (
        *("first.margin", "first.voltage", "first.breakdown_voltage"),
        *("simulated.rate", "simulated.energy", "simulated.peak", "edge.voltage"),
    )
    leading = ("ratios",)
    without = AXLE_WITHOUT_PROBABILITY

    def build_below_panel(self) -> None:
        """Build the picture of the network, and the place of the remedies."""
        with ui.element("section").classes("answer-body").props('data-testid="simulated"') as self._simulated:
            heading("Discharges over time", 2)
            self._simulation = ui.html("", sanitize=False).props('data-testid="simulation"')
            with ui.element("div").classes("figures"):
                self._timed = {name: FigureBox(name, wide=True) for name in ("rates", "shaft-voltages")}
        self._simulated.set_visibility(False)
        self._network = ui.html("", sanitize=False).props('data-testid="network"')
        self._remedies = ui.html("", sanitize=False).props('data-testid="remedies-table"')

    def build(self) -> None:
        """Build the parts of the answer below its numbers."""
        self._elements, self._chances, self._shafts = (
            ui.html("", sanitize=False).props(f'data-testid="{name}"')
            for name in ("elements", "chances", "shafts")
        )
        self.build_figures(())

    def show(self, answer: AxleAnswer) -> None:
        """Show an answer."""
        super().show(answer)
        self.panel.lead("ratios", answer.figures.get("ratios"))
        caption = escape(page_texts("axle")["network"])
        self._network.content = f"<h2>Network</h2><p class=soft>{caption}</p>{network_html(answer.network)}"
        self.body.props["data-simulated"] = str(answer.simulated).lower()
        self.body.update()
        self._show_simulated(answer)
        # The earlier table remains until the remedies are computed.
        follow(self._remedies, on=not answer.remedied and bool(self._remedies.content))
        if answer.remedied:
            self._show_remedies(answer)
        self._elements.content = f"<h2>Bearings and meshes</h2>{table_html(answer.elements)}"
        chances = answer.chances
        follow(self._chances, on=not answer.whole and bool(self._chances.content))
        if answer.whole:
            self._chances.content = "" if chances is None else table_html(chances)
        self._shafts.content = behind("Speeds, torques and voltages of the shafts", table_html(answer.shafts))

    def lack(self) -> None:
        """Show that a part does not follow, without parts that belong to other inputs than the answer."""
        super().lack()
        for part in (self._remedies, self._chances):
            if "follows" in part.classes:
                part.content = ""
                follow(part, on=False)

    def _show_simulated(self, answer: AxleAnswer) -> None:
        """Show the discharges over time, if they are simulated."""
        self._simulated.set_visibility(answer.simulation is not None)
        self._simulation.content = "" if answer.simulation is None else table_html(answer.simulation)
        for name, place in self._timed.items():
            place.show(answer.figures.get(name))

    def _show_remedies(self, answer: AxleAnswer) -> None:
        effects = "".join(f"<li>{escape(text)}</li>" for text in answer.effects)
        remedies = answer.remedies
        self._remedies.content = (
            ""
            if remedies is None
            else f"<h2>Mitigation measures</h2><ul data-testid=effects>{effects}</ul>{table_html(remedies)}"
        )
        self._remedies.set_visibility(remedies is not None)


class AxleRemedies:
    """Group with a box to tick for each usual remedy of the axle, and a list of the others of the file."""

    def __init__(self, session: Session, change: Callable[[str, Any], Awaitable[None]]) -> None:
        self._session, self._change = session, change
        self._boxes: dict[str, tuple[ui.checkbox, ui.label]] = {}
        with (
            ui.element("div").classes("form").props('role="form" aria-label="Mitigation measures"'),
            GroupBox("Remedies", title="Mitigation measures to compare", opened=True, first=True),
        ):
            ui.label("Each measure is computed in addition to the axle.").classes("field-help")
            self._usual, self._others = ui.element("div"), ui.element("div")
        self.refresh()

    def refresh(self) -> None:
        """Show the remedies of the present inputs. Boxes stay, unless other shafts or meshes have others."""
        inputs = self._session.inputs
        given = remedies_of(inputs)
        presets: Mapping[str, Mapping[str, Any]] = remedy_presets(inputs)
        if [*presets] != [*self._boxes]:
            self._usual.clear()
            with self._usual:
                self._boxes = {title: self._box(title) for title in presets}
        for title, (box, note) in self._boxes.items():
            box.set_value(title in given)
            note.text = _text(given.get(title, presets[title]))
        self._others.clear()
        with self._others:
            for title, changes in given.items():
                if title not in presets:
                    remove = partial(self._remove, title)
                    removable(f"{title}: {_text(changes)}", f"the mitigation measure {title}", remove)

    def _box(self, title: str) -> tuple[ui.checkbox, ui.label]:
        with ui.element("div").classes("remedy"):
            box = ui.checkbox(title, on_change=partial(self._switched, title)).props("dense")
            box.props["data-testid"] = f"remedy-{title.lower().replace(' ', '-')}"
            return box, ui.label().classes("field-note")

    async def _switched(self, title: str, event: Any) -> None:
        inputs = self._session.inputs
        if bool(event.value) == (title in remedies_of(inputs)):
            return
        changes = remedy_presets(inputs)[title]
        after = with_remedy(inputs, title, changes) if event.value else without_remedy(inputs, title)
        await self._change(REMEDIES, after or None)

    async def _remove(self, title: str) -> None:
        await self._change(REMEDIES, without_remedy(self._session.inputs, title) or None)


def _text(changes: Mapping[str, Any]) -> str:
    """Text of the changes of a remedy.

    Examples
    --------
    >>> _text({"link": [{"between": ["rotor", "housing"], "kind": "ring", "resistance": "1 ohm"}]})
    'ring between rotor and housing, 1 ohm'
    """
    return ", ".join(
        _link_texts(value) if key == "link" else f"{key} = {value}" for key, value in changes.items()
    )


def _link_texts(links: Any) -> str:
    """Text of the links of a remedy, or of a value that lists no tables."""
    if not isinstance(links, list) or not all(isinstance(link, Mapping) for link in links):
        return str(links)
    texts = []
    for link in links:
        nodes = link.get("between")
        ends = " and ".join(map(str, nodes)) if isinstance(nodes, list) else str(nodes)
        values = [str(link[name]) for name in ("resistance", "capacitance") if name in link]
        texts.append(", ".join([f"{link.get('kind', '')} between {ends}", *values]))
    return "; ".join(texts)


class GearFileField:
    """Field for the gear file of a mesh, whose tables replace the tables of the mesh; build it in its group.

    ``take`` is called with the inputs that contain them.
    """

    def __init__(self, session: Session, number: int, take: Callable[[Inputs], None]) -> None:
        self._session, self._number, self._take = session, number, take
        name = f"gear-{number}"
        with ui.element("div").classes("box"):
            UploadField(
                session, self._stored, self._refuse, name=name, label="Or a gear file (TOML)", most=MOST_CASE
            )
            self._error = ui.label().classes("error").props(f'role="alert" id="{name}-error"')
            self._error.props(f'data-testid="error-{name}"')

    async def _stored(self, file: str) -> None:
        path, name = self._session.path_of(file), self._session.name_of(file)
        if path is None:
            return
        content = path.read_bytes()
        path.unlink()
        try:
            opened = await self._session.work.quick(FILES_UPLOADED, {name: content}, self._session.folder)
        except (InputError, LostError) as error:
            self._refuse(str(error))
            return
        if opened.kind != "gear":
            self._refuse(f"{name}: is no gear file; open it with the button Open file")
            return
        self._refuse("")
        self._take(self._session.inputs.changed({f"mesh.{self._number}.pair": dict(opened.table)}))

    def _refuse(self, text: str) -> None:
        say(self._error, text)


class AxlePage(AnswerPage[AxleAnswer]):
    """Page of one tab."""

    path = PATHS["axle"]
    title = "Which bearing or gear mesh of this axle breaks down first?"
    start = AXLE
    kind = "axle"
    groups = ()
    elsewhere = (*LISTS, REMEDIES, WAVEFORM_FILE)
    first = 1
    short: ClassVar[Mapping[str, str]] = {"first.margin": "margin", "first.voltage": "U"}
    wait = 0.6
    quick, later, solved = AXLE_QUICK, (AXLE_REMEDIED, AXLE_WHOLE), AXLE_SIMULATED
    parts = ("Mitigation measures and probabilities are", "Probabilities are")

    async def prepare(self) -> None:
        """Switch the simulated time on, before a simulation."""
        inputs = self.session.inputs
        if inputs.value("breakdown") is None:
            await self.form.turn_on(SIMULATED)
        elif inputs.value("drive.duration") is None:
            await self.form.take(form_data("first_values")["simulated_time"])

    def build_view(self) -> None:
        """Build the place of the answer."""
        self.view = AxleView()

    def build_form(self) -> None:
        """Build the form, whose groups follow the shafts, bearings, meshes and links."""
        self._place = ui.element("div")
        self._build_groups()

    def _build_groups(self) -> None:
        inputs = self.session.inputs
        self._shape = shape_of(inputs)
        self._place.clear()
        with self._place:
            self.form = Form(
                axle_groups(inputs),
                inputs,
                self.change,
                elsewhere=(*measured_keys(self.kind, inputs), WAVEFORM_FILE),
                first=self.first,
                listed=other_inputs,
            )
        with self.form.group("Source"):
            self.waveform = WaveformField(self.session, self.form.take)
        self._build_buttons()
        self._show_summaries()

    def _build_buttons(self) -> None:
        """Build the buttons that add and remove elements, each in the group of its element."""
        inputs = self.session.inputs
        names = names_of(inputs)
        for number, name in enumerate(names, 1):
            mounted = [n for n in range(1, _count(inputs, "bearing") + 1) if _shaft_of(inputs, n) == name]
            with self.form.group(shaft_title(name)):
                if len(mounted) < 2:
                    self._button("Add a bearing", f"add-bearing-{number}", partial(with_bearing, shaft=name))
                if inputs.value(f"shaft.{number}.rotor") is not True:
                    remove = partial(without_shaft, number=number)
                    self._button(f"Remove the shaft {name}", f"remove-shaft-{number}", remove)
            for place, n in enumerate(mounted, 1):
                self._remove(f"Bearing {place} of {name}", "bearing", n)
        for number in range(1, _count(inputs, "mesh") + 1):
            with self.form.group(mesh_title(number)):
                GearFileField(self.session, number, self.go_to)
            self._remove(mesh_title(number), "mesh", number)
        for number in range(1, _count(inputs, "force") + 1):
            self._remove(force_title(number), "force", number)
        for number in range(1, _count(inputs, "link") + 1):
            self._remove(link_title(number), "link", number)
        with self._place, ui.element("div").classes("buttons"):
            self._button("Add a shaft with bearings and a mesh", "add-shaft", with_shaft)
            self._button("Add a gear mesh", "add-mesh", with_mesh)
            self._button("Add a ring, seal or coupling", "add-link", with_link)
            self._button("Add a force", "add-force", with_force)

    def _remove(self, title: str, name: str, number: int) -> None:
        with self.form.group(title):
            remove = partial(without_table, name=name, number=number)
            self._button(f"Remove {title.lower()}", f"remove-{name}-{number}", remove)

    def _button(self, text: str, test: str, change: Callable[[Inputs], Inputs]) -> None:
        button(text, test, lambda: self.go_to(change(self.session.inputs)), "no-caps dense")

    def _show_summaries(self) -> None:
        for group in axle_groups(self.session.inputs):
            self.form.group(group.title).show(about=summary_of(self.session.inputs, group.title))

    def build_boxes(self) -> None:
        """Build the remedies."""
        self.remedies = AxleRemedies(self.session, self.change)

    def show_boxes(self) -> None:
        """Show the present inputs in the remedies and in the titles of the groups."""
        if shape_of(self.session.inputs) == self._shape:
            self._show_summaries()
        self.waveform.refresh()
        self.remedies.refresh()

    def shown_again(self) -> None:
        """Show the present inputs in the form, whose groups are made anew where elements were added or
        removed.
        """
        # A button or a field of the form that is made anew has no place on the page any more.
        with self._place:
            if shape_of(self.session.inputs) != self._shape:
                self._build_groups()
            super().shown_again()

    def _refuse(self, error: Exception) -> None:
        super()._refuse(
            request_of_rows(self.session.inputs, error) if isinstance(error, InputError) else error
        )

    async def change(self, key: str, value: Any) -> None:
        """Take over a changed input, and answer."""
        await super().change(key, value)
        if key == REMEDIES or shape_of(self.session.inputs) != self._shape:
            self.shown_again()


def _count(inputs: Inputs, name: str) -> int:
    tables = inputs.value(name)
    return len(tables) if isinstance(tables, list) else 0


def _shaft_of(inputs: Inputs, number: int) -> str:
    return str(inputs.value(f"bearing.{number}.shaft") or "")
