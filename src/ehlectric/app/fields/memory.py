"""Memory of a form: the last own values of what is switched off or replaced, so that they come back."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from copy import deepcopy
from typing import Any

from ehlectric.app.fields.ends import at_end, bearing_at, end_and_key
from ehlectric.app.fields.field import Field, Group
from ehlectric.app.fields.rules import changed, is_own, own_values
from ehlectric.app.inputs import Inputs
from ehlectric.quantities.alternatives import DIMENSIONS

# Keys of a geometry of one's own; those that a kind does not have are left out when they come back.
_GEOMETRY = (*(f"bearing.{name}" for name in DIMENSIONS), "bearing.contact_angle")


class Memory:
    """Last values of groups that can be switched off, of own entries of lists, and of ways.

    Parameters
    ----------
    groups : sequence of Group
        Fields of the form under their headings.

    Examples
    --------
    >>> memory = Memory([Group("Motor", (), table="motor", start={"rise_time": "1 us"})])
    >>> memory.note(Inputs({"motor": {"rise_time": "3 us"}}))
    >>> memory.table(memory.groups[0], Inputs({}))
    {'rise_time': '3 us'}
    """

    def __init__(self, groups: Sequence[Group]) -> None:
        self.groups = groups
        self._tables: dict[str, Mapping[str, Any]] = {}
        self._own: dict[str, dict[str, Any]] = {}
        self._ways: dict[tuple[str, int], dict[str, Any]] = {}

    def note(self, inputs: Inputs) -> None:
        """Remember the values that inputs have now."""
        for group in self.groups:
            if group.table and inputs.value(group.table) is None:
                continue
            if group.table:
                self._tables[group.table] = inputs.value(group.table)
            for field in group.fields:
                self._note_field(field, inputs)

    def table(self, group: Group, inputs: Inputs) -> dict[str, Any]:
        """Table of a group that is switched on: the last one, or that with which it begins."""
        if group.table in self._tables:
            return deepcopy(dict(self._tables[group.table]))
        copied = inputs.value(group.copies) if group.copies else None
        return deepcopy(dict(copied if isinstance(copied, Mapping) else group.start))

    def own(self, field: Field, inputs: Inputs) -> dict[str, Any]:
        """Changes that bring back the last own values of a list, or those of the library as own ones."""
        return deepcopy(self._own[field.key]) if field.key in self._own else own_values(inputs, field.key)

    def way(self, field: Field, place: int, inputs: Inputs) -> dict[str, Any]:
        """Changes that take a way with its last values, or with those with which it begins."""
        way = field.ways[place]
        last = {**way.changes, **deepcopy(self._ways.get((field.key, place), {}))}
        return last if field.way(changed(inputs, last)) == place else dict(way.changes)

    def _note_field(self, field: Field, inputs: Inputs) -> None:
        if field.kind == "ways":
            place = field.way(inputs)
            given = {key: inputs.value(key) for key in field.ways[place].changes}
            self._ways[field.key, place] = {key: value for key, value in given.items() if value is not None}
        elif field.own and is_own(inputs, field.key):
            self._own[field.key] = _own_of(inputs, field.key)


def _own_of(inputs: Inputs, key: str) -> dict[str, Any]:
    """Changes that make the present own values those of other inputs."""
    end, key = end_and_key(key)
    return at_end(_own_of_case(bearing_at(inputs, end), key), end)


def _own_of_case(inputs: Inputs, key: str) -> dict[str, Any]:
    table = key.rpartition(".")[0]
    if table != "bearing":
        return {table: inputs.value(table)}
    given = {name: inputs.value(name) for name in _GEOMETRY}
    return {name: value for name, value in given.items() if value is not None} | {key: None}
