"""Form of a page: a field and a slider for every input, and errors next to the field that is wrong."""

from __future__ import annotations

import re
from collections.abc import Awaitable, Callable, Mapping, Sequence
from contextlib import nullcontext
from functools import partial
from typing import Any

from nicegui import ui

from ehlectric.app.catalogue import choices
from ehlectric.app.form_fields import BEARING_GROUPS, GEAR_GROUPS
from ehlectric.app.form_fields.axle_fields import axle_groups, shape_of
from ehlectric.app.form_fields.contact_fields import geometry_of, groups_of
from ehlectric.app.form_fields.drive_fields import PAGE_GROUPS
from ehlectric.app.form_fields.field import Field, Group, in_field_unit, shown_text, written_text
from ehlectric.app.form_fields.field_defaults import default_of, end_and_key, list_of
from ehlectric.app.form_fields.field_rules import Memory, changed, is_custom
from ehlectric.app.latest_answer import OnlyLast
from ehlectric.app.page_inputs import Inputs
from ehlectric.app.pages.frame import session_here
from ehlectric.app.pages.page_parts import Control, GroupBox, brief, kind_of_list, removable, say
from ehlectric.errors import InputError
from ehlectric.quantities.inputs import input_at
from ehlectric.quantities.units import printed
from ehlectric.readable import capital

Change = Callable[[str, Any], Awaitable[None]]

# Value in a list that stands for values of one's own.
_CUSTOM = "~own"


class Form:
    """Fields of a page.

    ``change`` is called with a key and its new value, which is a whole table where a new input replaces
    others, and None where the key is removed. Other parts of the page show the keys ``elsewhere``.
    ``listed`` returns all inputs by dotted key; the page lists inputs without a field.
    On a narrow screen only the ``first`` groups are opened.

    While a slider is dragged, a new value waits until the one before is answered, and only the last waiting
    value is sent.
    """

    def __init__(
        self,
        groups: Sequence[Group],
        inputs: Inputs,
        change: Change,
        *,
        label: str = "Inputs",
        elsewhere: Sequence[str] = (),
        first: int = 2,
        listed: Callable[[Inputs], Mapping[str, Any]] = Inputs.flat,
    ) -> None:
        self._change = change
        self._first = groups[:first]
        self._inputs = inputs
        self._groups, self._elsewhere, self._flat = groups, elsewhere, listed
        self._memory = Memory(groups)
        self._follows: Mapping[str, str] = {}  # values of empty fields that follow from other inputs
        self.wrong: Field | None = None  # field with an error
        self._slide = OnlyLast(self._take_slid)
        self._boxes: dict[str, GroupBox] = {}
        self._mores: dict[str, GroupBox] = {}
        self._controls: list[tuple[Field, Control]] = []
        with ui.element("div").classes("form").props(f'role="form" aria-label="{label}"') as self._top:
            self.message = ui.label().classes("form-error").props('role="alert" data-testid="form-error"')
            self.note = ui.label().classes("form-note").props('aria-live="polite" data-testid="form-note"')
            for group in groups:
                self._group(group)
            with ui.element("details").classes("form-others").props('data-testid="other-inputs"') as others:
                self._others_head = ui.html("", sanitize=False, tag="summary").classes("group-title")
                self._others_list = ui.element("div")
            self._others = others
        brief(self.note, "")
        self._show()
        self.tell(None)

    def tell(self, error: Exception | None) -> None:
        """Show an error next to its field, and remove the one before."""
        key = error.key if isinstance(error, InputError) else None
        field = None if key is None else self._field_of(key)
        exact = field is not None and key in (field.key, list_of(field.key))
        field_text = (
            in_field_unit(field, error.text) if field is not None and isinstance(error, InputError) else ""
        )
        text = field_text if exact else "" if error is None else str(error)
        self.wrong = field
        for other, control in self._controls:
            control.show(
                error=text if other is field else "",
                empty=other is field and is_to_type(error),
                shown=self._is_shown(other),
            )
        say(self.message, "" if field is not None else text)
        if field is not None:
            title = self._group_of(field).title
            self._boxes[title].turn(opened=True)
            if field.optional:
                self._mores[title].turn(opened=True)

    def words(self, error: Exception) -> str:
        """Line on an error for another place of the page, with the name of its field."""
        key = error.key if isinstance(error, InputError) else None
        field = next((field for field, _ in self._controls if field.key == key), None)
        if field is None or not isinstance(error, InputError):
            return str(error)
        words = f"{field.label}: {in_field_unit(field, error.text)}"
        return ", ".join(filter(None, [self._place_of(field.key), words]))

    def go_to_wrong(self) -> None:
        """Move the page and the focus to the field that is wrong."""
        for field, control in self._controls:
            if field is self.wrong:
                control.focus()

    def group(self, title: str) -> GroupBox:
        """Box of a group, to which a page may add what is no field."""
        return self._boxes[title]

    def set(self, inputs: Inputs) -> None:
        """Show other inputs, as after an undo; nothing is sent."""
        self._slide.drop()
        self._inputs = inputs
        self.note.classes(remove="stays")
        brief(self.note, "")
        self._show()

    def follow(self, values: Mapping[str, str]) -> None:
        """Show values that follow from other inputs, by key, in the empty fields of their keys."""
        changed_keys = {key for key, _ in {*values.items()} ^ {*self._follows.items()}}
        self._follows = dict(values)
        for field, control in self._controls:
            if field.key in changed_keys:
                self._show_field(field, control)

    def _group(self, group: Group) -> None:
        async def switched(event: Any) -> None:
            await self._switch(group, on=bool(event.args))

        first, opened = group in self._first, group.opened
        box = GroupBox(group.title, note=group.note, opened=opened, first=first)
        if group.table:
            box.show(switches=True)
            box.on("switch", switched)
        self._boxes[group.title] = box
        with box:
            for field in group.fields:
                if not field.optional:
                    self._controls.append((field, self._control(field)))
            self._more(group)

    async def turn_on(self, title: str) -> None:
        """Switch a group on, with the last values of its table or the first ones."""
        group = next(group for group in self._groups if group.title == title)
        self._boxes[title].turn(opened=True)
        await self._switch(group, on=True)

    async def _switch(self, group: Group, *, on: bool) -> None:
        await self.take({group.table: self._memory.table(group, self._inputs) if on else None})

    def _more(self, group: Group) -> None:
        """Optional fields of a group, which are folded away until one of them is given."""
        fields = [field for field in group.fields if field.optional]
        if not fields:
            return
        given = not group.folds and any(self._inputs.value(field.key) is not None for field in fields)
        box = GroupBox(f"{group.title} more", title="More", opened=given, first=True)
        self._mores[group.title] = box
        with box:
            self._controls.extend((field, self._control(field)) for field in fields)

    def _control(self, field: Field) -> Control:
        async def committed(event: Any) -> None:
            await self._commit(field, str(event.args))
            # The box shows what was typed, which may be another text for the present value.
            control.turn()

        async def slid(event: Any) -> None:
            await self._slide(field, float(event.args))

        options = self._options(field)
        kind = kind_of_list(options) if options else "text"
        number = field.kind in ("number", "count")
        control = Control(
            field.key, kind=kind, label=field.label, note=field.note, slides=number, options=options
        )
        unit = printed(field.unit) if field.unit else ""
        about = {"ignored": field.ignored, "no-match": field.no_match_text, "free": field.free}
        control.show(**about, help=field.help, unit=unit)
        control.on("commit", committed)
        if number:
            control.on("slide", slid)
        return control

    def _options(self, field: Field) -> list[dict[str, str]]:
        """Entries of a list; empty for a field that has none."""
        if field.kind == "alternatives":
            return [
                {"value": str(place), "label": alternative.label, "group": ""}
                for place, alternative in enumerate(field.alternatives)
                if alternative.listed or place == field.alternative(self._inputs)
            ]
        if field.kind == "flag":
            return [{"value": word, "label": word, "group": ""} for word in ("no", "yes")]
        if field.kind != "choice":
            return []
        entries = [{"value": name, "label": name, "group": ""} for name in field.choices]
        if not entries:
            library = choices().get(end_and_key(field.key)[1], ())
            entries = [{"value": entry.name, "label": entry.label, "group": entry.group} for entry in library]
        if field.custom_label:
            entries.insert(0, {"value": _CUSTOM, "label": field.custom_label, "group": ""})
        elif field.optional:
            entries.insert(0, {"value": "", "label": "not given", "group": ""})
        return entries

    async def _commit(self, field: Field, text: str) -> None:
        self._slide.drop()
        if field.kind == "alternatives":
            await self.take(self._memory.alternative(field, int(text), self._inputs))
        elif text == _CUSTOM:
            await self.take(self._memory.custom(field, self._inputs))
        else:
            await self.take({field.key: field.from_text(written_text(field, text))})

    async def _take_slid(self, field: Field, place: float) -> None:
        await self.take({field.key: field.from_slider(place)}, drag=field.key)

    async def take(self, changes: Any, drag: str = "") -> None:
        """Take over changes with the inputs that they replace, show them, and send them.

        They are one step to undo, together with those just before of the same dragged slider.
        """
        self._memory.note(self._inputs)
        before, after = self._inputs, changed(self._inputs, changes, self._memory.given)
        self._memory.take(changes)
        self._inputs = after
        self._tell_also(self._also(before, after, changes), changes)
        self._show()
        session = session_here()
        with nullcontext() if session is None else session.history.step(drag):
            for key, value in _sent(before, after, changes).items():
                await self._change(key, value)

    def _tell_also(self, text: str, changes: Mapping[str, Any]) -> None:
        """Show which further inputs changed: for a while, or with a new kind of bearing in the group of the
        bearing, until the kind changes again.
        """
        if _is_of_kind(changes):
            titles = [group.title for group in self._groups for each in group.fields if each.key in changes]
            self.note.move(self._boxes[titles[0]] if titles else self._top, 0)
            self.note.classes(add="stays")
            say(self.note, text)
        elif text or not self.note.visible or "stays" not in self.note.classes:
            self.note.move(self._top, 0)
            self.note.classes(remove="stays")
            brief(self.note, text)

    def _also(self, before: Inputs, after: Inputs, changes: Any) -> str:
        """Sentence on the further inputs that changed."""
        fields = {field.key: field for field, _ in self._controls}
        labels = {key: field.label for key, field in fields.items()}
        old, new = self._flat(before), self._flat(after)
        # Lists of several fields, and inputs that only files contain.
        others = {*(list_of(key) for key in fields), *(old.keys() ^ new.keys())} - labels.keys()
        entries = {key: input_at(end_and_key(key)[1]) for key in others}
        labels |= {key: capital(entry.label) for key, entry in entries.items() if entry is not None}

        def other(key: str) -> bool:
            return not any(
                key in (changed_key, list_of(changed_key)) or key.startswith(f"{changed_key}.")
                for changed_key in changes
            )

        def text(key: str, value: Any) -> str:
            return shown_text(fields[key], str(value)) if key in fields else str(value)

        by_word = {
            "removed": {key: labels.get(key, key) for key in old if key not in new and other(key)},
            "assumed": {
                key: f"{labels.get(key, key)} = {text(key, value)}"
                for key, value in new.items()
                # A typed designation is no assumption.
                if key not in old and other(key) and end_and_key(key)[1] != "bearing.designation"
            },
            "changed": {
                key: f"{labels.get(key, key)} from {text(key, old[key])} to {text(key, value)}"
                for key, value in new.items()
                if key in old and old[key] != value and other(key)
            },
            "kept": {
                key: f"{labels[key]} = {text(key, value)}"
                for key, value in self._kept(before, after, changes).items()
            },
        }
        places = dict.fromkeys(self._place_of(key) for items in by_word.values() for key in items)
        sentences = []
        for place in places:
            parts = [
                f"{word}: {', '.join(said)}"
                for word, items in by_word.items()
                if (said := [each for key, each in items.items() if self._place_of(key) == place])
            ]
            sentences.append(f"{place}, also {'; '.join(parts)}" if place else f"Also {'; '.join(parts)}")
        return ". ".join(sentences)

    def _kept(self, before: Inputs, after: Inputs, changes: Mapping[str, Any]) -> dict[str, Any]:
        """Roughness and clearance that another bearing gets from the bearing before it, by key."""
        ends = {
            end_and_key(key)[0]
            for key in changes
            if _is_of_kind({key: ""}) and before.value(key) != after.value(key)
        }
        kept = {}
        for field, _ in self._controls:
            end, key = end_and_key(field.key)
            if end in ends and key in _OF_A_BEARING and field.key not in changes:
                old, new = (field.view(inputs).value(field.key) for inputs in (before, after))
                if old is not None and old == new:
                    kept[field.key] = new
        return kept

    def _place_of(self, key: str) -> str:
        """Name of the shaft, bearing, mesh, link or force of a key; empty for any other key."""
        end = next(iter(_NUMBERED.findall(key)), end_and_key(key)[0])
        if not end:
            return ""
        titles = (
            group.title for group in self._groups for each in group.fields if each.key.startswith(f"{end}.")
        )
        return next(titles, "").partition(":")[0]

    def _show(self) -> None:
        """Show the present inputs in all fields."""
        for group in self._groups:
            self._boxes[group.title].set_visibility(group.when(self._inputs))
            self._boxes[group.title].show(tells=group.tells(self._inputs))
            if group.table:
                self._boxes[group.title].show(on=self._on(group))
            if group.title in self._mores:
                self._mores[group.title].set_visibility(self._has_more(group))
        for field, control in self._controls:
            self._show_field(field, control)
        self._show_others()

    def _show_field(self, field: Field, control: Control) -> None:
        value = self._inputs.value(field.key)
        default = self._follows.get(field.key, default_of(self._inputs, field.key))
        if field.kind == "alternatives":
            control.show(text=str(field.alternative(self._inputs)), options=self._options(field))
        elif field.custom_label and is_custom(self._inputs, field.key):
            control.show(text=_CUSTOM)
        elif field.kind == "flag":
            control.show(text=field.text(value))
        elif field.kind == "choice":
            control.show(text=str(value if value is not None else default or ""))
        else:
            number = field.number(value if value is not None else default)
            moved = {} if number is None else {"place": round(field.place(number), 4)}
            note = field.note if len(field.note) <= _LONGEST_PLACEHOLDER else ""
            empty = shown_text(field, field.text(default)) or note or "not given"
            full = field.text(value)
            text = shown_text(field, full)
            rounded = full if len(full) > len(text) + 2 else ""
            control.show(text=text, full=rounded, placeholder=empty, **moved)
        control.show(shown=self._is_shown(field))

    def _show_others(self) -> None:
        """Show the inputs that no field has, such as inputs of a file, so that nothing is hidden."""
        shown = {*self._elsewhere, *(list_of(field.key) for field, _ in self._controls)}
        rest = {
            key: value for key, value in self._flat(self._inputs).items() if key not in shown and value != {}
        }
        self._others.set_visibility(bool(rest))
        self._others_head.set_content(f"Other inputs of the file ({len(rest)})")
        self._others_list.clear()
        with self._others_list:
            for key, value in rest.items():
                removable(f"{key} = {value}", key, partial(self.take, {key: None}))

    def _on(self, group: Group) -> bool:
        given = not group.table or self._inputs.value(group.table) is not None
        return given and group.when(self._inputs)

    def _has_more(self, group: Group) -> bool:
        return any(field.optional and self._is_shown(field) for field in group.fields)

    def _is_shown(self, field: Field) -> bool:
        on = self._on(self._group_of(field))
        return field is self.wrong or (on and field.shown(self._inputs))

    def _group_of(self, field: Field) -> Group:
        return next(group for group in self._groups if field in group.fields)

    def _field_of(self, key: str) -> Field | None:
        """Field of a key of an error: for the key, for the table it is in, or the first of its table."""
        fields = [field for field, _ in self._controls]
        shown = sorted(fields, key=lambda field: not self._is_shown(field))
        exact = [field for field in shown if field.key == key]
        above = [field for field in shown if key.startswith(f"{field.key}.")]
        below = [field for field in shown if field.key.startswith(f"{key}.")]
        return next(iter([*exact, *above, *below]), None)


def _is_of_kind(changes: Mapping[str, Any]) -> bool:
    """Whether changes may bring another kind of bearing."""
    return any(end_and_key(key)[1] in ("bearing.base", "bearing.kind") for key in changes)


def is_to_type(error: Exception | None) -> bool:
    """Return whether an error is a value that is still to be typed, which is not shown as a wrong one."""
    return isinstance(error, InputError) and error.is_missing


def groups_for(case: Inputs) -> Sequence[Group]:
    """Return the groups of fields of a drive, a gear pair, an axle, a bearing, or a contact with its
    geometry.
    """
    if case.value("drive_end"):
        return PAGE_GROUPS
    if case.value("gear"):
        return GEAR_GROUPS
    if case.value("shaft"):
        return axle_groups(case)
    return BEARING_GROUPS if case.value("bearing") else groups_of(geometry_of(case))


def shape_of_form(case: Inputs) -> Any:
    """Return what the groups of a case depend on, to be compared with the shape of an existing form."""
    return shape_of(case) if case.value("shaft") else groups_for(case)


# Beginning of a key of a numbered table.
_NUMBERED = re.compile(r"^(?:shaft|bearing|mesh|link|force)\.\d+")

# Inputs of a bearing that another designation does not determine.
_OF_A_BEARING = (
    *("bearing.composite_rq", "bearing.composite_ra", "bearing.rq_over_ra"),
    *("bearing.radial_clearance", "bearing.clearance_class"),
)

# Longest note that is shown in an empty box [characters].
_LONGEST_PLACEHOLDER = 14


def _sent(before: Inputs, after: Inputs, changes: Any) -> dict[str, Any]:
    """Changes to send: the one asked for, or whole tables, so that the page sees no state in between."""
    if before == after:
        return {}
    if len(changes) == 1 and before.changed(changes) == after:
        return dict(changes)
    names = {*before.table, *after.table}
    return {name: after.table.get(name) for name in names if before.table.get(name) != after.table.get(name)}
