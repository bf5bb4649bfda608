"""Rules by which a new input replaces others, and a memory of the values that were replaced.

The rules are the rules of ``BearingCase.replace`` and ``Case.replace``. They work on inputs as a person
writes them, so that the values of the library stay in the library.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from copy import deepcopy
from typing import Any

from ehlectric.app.catalogue import bearing, coating, contradicts, designated, oil
from ehlectric.app.form_fields.axle_fields import fitted_axle, without_first_values
from ehlectric.app.form_fields.drive_fields import (
    DRIVE_ALTERNATIVES,
    fitted_to_source,
    with_fitted_remedies,
    with_loads,
)
from ehlectric.app.form_fields.field import Field, Group, first_of_kind, fitted_to_kind, form_data, kind_of
from ehlectric.app.form_fields.field_defaults import at_end, bearing_at, end_and_key, with_bearing_at
from ehlectric.app.form_fields.gear_fields import of_the_example, rq_of_flanks, with_lists
from ehlectric.app.page_inputs import Inputs
from ehlectric.cases.defaults import DEFAULT_FILM, FILM_FACTORS
from ehlectric.quantities import alternatives
from ehlectric.quantities.alternatives import (
    CONTACT_ALTERNATIVES,
    DIMENSIONS,
    GRID_OF_ANY,
    ONLY,
    Rows,
    dotted,
)
from ehlectric.quantities.inputs import ENDS

# Keys of a geometry of one's own; keys that a kind does not have are dropped when they come back.
_GEOMETRY = (*(f"bearing.{name}" for name in DIMENSIONS), "bearing.contact_angle")


class Memory:
    """Last values of optional groups, of user-defined list entries, and of alternatives.

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
        self._custom: dict[str, dict[str, Any]] = {}
        self._alternatives: dict[tuple[str, int], dict[str, Any]] = {}
        # Keys whose present values the user has set: they do not follow the kind of bearing.
        self.given: frozenset[str] = frozenset()

    def take(self, changes: Mapping[str, Any]) -> None:
        """Remember the keys that the user sets; a removed one is no longer set."""
        flat = _flat(changes)
        gone = {key for key, value in flat.items() if value is None}
        self.given = (self.given - gone) | (flat.keys() - gone)

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
        """Table of a group that is switched on: the last one, or its first values."""
        if group.table in self._tables:
            return deepcopy(dict(self._tables[group.table]))
        copied = inputs.value(group.copies) if group.copies else None
        return deepcopy(dict(copied if isinstance(copied, Mapping) else group.start))

    def custom(self, field: Field, inputs: Inputs) -> dict[str, Any]:
        """Changes to the last user-defined values of a list, or to copies of the values of the library."""
        return (
            deepcopy(self._custom[field.key])
            if field.key in self._custom
            else custom_values(inputs, field.key)
        )

    def alternative(self, field: Field, place: int, inputs: Inputs) -> dict[str, Any]:
        """Changes to an alternative with its last values, or with its first ones."""
        first = _first_of_alternative(field.alternatives[place].changes, inputs)
        last = {**first, **deepcopy(self._alternatives.get((field.key, place), {}))}
        return last if field.alternative(changed(inputs, last)) == place else first

    def _note_field(self, field: Field, inputs: Inputs) -> None:
        if field.kind == "alternatives":
            place = field.alternative(inputs)
            given = {key: inputs.value(key) for key in field.alternatives[place].changes}
            self._alternatives[field.key, place] = {
                key: value for key, value in given.items() if value is not None
            }
        elif field.custom_label and is_custom(inputs, field.key):
            self._custom[field.key] = _custom_changes(inputs, field.key)


def _first_of_alternative(changes: Mapping[str, Any], inputs: Inputs) -> dict[str, Any]:
    """First values of an alternative; a composite roughness of flanks begins with the present roughness."""
    first = dict(changes)
    for key in changes:
        end, inner = end_and_key(key)
        if inner == "gear.composite_rq" and (rq := rq_of_flanks(bearing_at(inputs, end))) is not None:
            first[key] = rq
    return first


def _custom_changes(inputs: Inputs, key: str) -> dict[str, Any]:
    """Changes that set the present user-defined values again."""
    end, key = end_and_key(key)
    inputs, table = bearing_at(inputs, end), key.rpartition(".")[0]
    if table != "bearing":
        return at_end({table: inputs.value(table)}, end)
    given = {name: inputs.value(name) for name in _GEOMETRY}
    return at_end({name: value for name, value in given.items() if value is not None} | {key: None}, end)


# Alternatives of the checks, of an oil of one's own, and of tables that exclude each other.
_TABLES = ("bearing", "gear", "lubricant", "discharge", "meter", "inlet", "motion", "grid", "contact")
ALTERNATIVES: tuple[Rows, ...] = (
    *(group for table in _TABLES for group in dotted(table, alternatives.ALTERNATIVES[table])),
    (("lubricant.viscosity",), ("lubricant.temperature",), ("lubricant.atmospheric_law",)),
    (("lubricant.density",), ("lubricant.temperature",)),
    (("lubricant.relative_permittivity",), ("lubricant.permittivity_table",)),
    (("lubricant.conductivity", "lubricant.conductivity_law"), ("lubricant.conductivity_table",)),
    (("inlet",), ("meter",)),
    (("inlet.film_ratio",), ("motion",)),
    (("grid.error", "grid.refine", "grid.most_nodes"), ("motion",)),
    *DRIVE_ALTERNATIVES,
)

# Alternatives that are others for a line contact and for a point contact.
OF_GEOMETRY: Mapping[str, tuple[Rows, ...]] = {
    geometry: dotted("contact", groups) for geometry, groups in CONTACT_ALTERNATIVES.items()
}


def changed(inputs: Inputs, changes: Mapping[str, Any], given: frozenset[str] = frozenset()) -> Inputs:
    """Inputs with new values by dotted key, and without those that they replace.

    None removes a key, and a mapping sets a table. With another kind of bearing, the first values of the old
    kind become the first values of the new kind, except of the keys ``given``, which the user has set. A name
    that the library does not know changes no other value. With
    another drawing of gears, the values of the example that would contradict it are removed.

    Examples
    --------
    >>> inputs = Inputs({"bearing": {"base": "6208", "elements": 8, "radial_clearance": "10 um"}})
    >>> dict(changed(inputs, {"bearing.clearance_class": "C3"}).table["bearing"])
    {'base': '6208', 'elements': 8, 'clearance_class': 'C3'}
    >>> dict(changed(inputs, {"bearing.base": "6206"}).table["bearing"])
    {'base': '6206', 'clearance_class': 'CN', 'composite_rq': '0.03 um'}
    >>> dict(changed(inputs, {"bearing.base": "6314-C3"}).table["bearing"])
    {'base': '6314', 'designation': '6314-C3', 'clearance_class': 'C3', 'composite_rq': '0.03 um'}
    >>> set_by_user = frozenset({"bearing.radial_clearance"})
    >>> changed(inputs, {"bearing.base": "6206"}, set_by_user).value("bearing.radial_clearance")
    '10 um'
    """
    by_end: dict[str, dict[str, Any]] = {"": {}}
    for key, value in changes.items():
        end, inner = end_and_key(key)
        by_end.setdefault(end, {})[inner] = value
    result = _changed(inputs, with_lists(inputs, by_end.pop("")), given)
    for end, changes_at_end in by_end.items():
        given_at_end = frozenset(inner for key in given for at, inner in [end_and_key(key)] if at == end)
        before = bearing_at(result, end)
        after = _changed(before, with_lists(before, changes_at_end), given_at_end)
        if end not in ENDS:
            after = without_first_values(inputs, before, after, changes_at_end)
        result = with_bearing_at(result, end, after)
    return fitted_axle(inputs, with_loads(inputs, with_fitted_remedies(inputs, result)))


def _changed(inputs: Inputs, changes: Mapping[str, Any], set_by_user: frozenset[str]) -> Inputs:
    """Inputs of a case, or of the bearing at one end of a drive, with new values."""
    named = changes.get("bearing.base") or changes.get("bearing.designation")
    if isinstance(named, str):
        typed = {"designation": None} | designated(named)
        changes = {**changes, **{f"bearing.{key}": value for key, value in typed.items()}}
        if not bearing(str(changes["bearing.base"])):
            # A name that the library does not know replaces no values: the user corrects it.
            changes = {key: value for key, value in changes.items() if key != "bearing.designation"}
            return inputs.changed(changes)
    given = _flat(changes)
    displaced = (*_displaced(inputs, given), *of_the_example(inputs, given, set_by_user))
    dropped = {key: None for key in displaced if key not in given}
    result = inputs.changed(dropped).changed(changes)
    if {"bearing.base", "bearing.kind"} & set(given):
        result = result.changed(dict.fromkeys(_first_values(inputs, result, {*given, *set_by_user})))
        result = result.changed(fitted_to_kind(result))
    if "bearing.film_factor" in given or _is_any_of(given, "lubricant"):
        result = result.changed(_needed_by_heat(result))
    if _is_any_of(given, "source"):
        result = result.changed(fitted_to_source(result))
    return result


def _first_values(before: Inputs, after: Inputs, set_by_user: set[str]) -> Iterable[str]:
    """Keys of another bearing whose values are first values of the kind before, or follow from its
    designation; ``set_by_user``, keys that the user has set.
    """
    clearance, of_class = "bearing.radial_clearance", "bearing.clearance_class"
    designated_now = after.value("bearing.base") is not None
    for key, value in first_of_kind(before).items():
        follows = kind_of(before) != kind_of(after) or (key == clearance and designated_now)
        if follows and key not in set_by_user and after.value(key) == before.value(key) == value:
            yield key
    if designated_now and of_class not in set_by_user and before.value(of_class) is not None:
        yield of_class


def _needed_by_heat(inputs: Inputs) -> dict[str, Any]:
    """First values of the thermal properties of a data sheet, which the heat of the films needs."""
    factor = inputs.value("bearing.film_factor") or DEFAULT_FILM
    sheet, bearing = (inputs.value(table) is not None for table in ("lubricant.temperature", "bearing"))
    if not (sheet and bearing) or factor not in FILM_FACTORS:
        return {}
    needed = list(form_data("first_values")["needed_by_heat"].items())[: FILM_FACTORS.index(factor)]
    return {key: value for key, value in needed if inputs.value(key) is None}


def custom_values(inputs: Inputs, key: str) -> dict[str, Any]:
    """Changes by which the values of the library under a key become user-defined values."""
    end, key = end_and_key(key)
    inputs = bearing_at(inputs, end)
    base, first = str(inputs.value(key)), form_data("first_values")
    if key == "lubricant.base":
        # The paper's oil has all laws; the data sheet replaces its viscosity and density.
        return at_end({key: "paper", "lubricant.temperature": dict(first["data_sheet"])}, end)
    known = {
        "bearing.base": bearing(base),
        "bearing.coating.base": first["coating"] | coating(base),
    }.get(key, {})
    values = {f"{key.rpartition('.')[0]}.{name}": value for name, value in known.items()}
    return at_end(
        {name: value for name, value in values.items() if inputs.value(name) is None} | {key: None}, end
    )


def is_custom(inputs: Inputs, key: str) -> bool:
    """Whether the values under a key are user-defined, and not values of the library."""
    end, key = end_and_key(key)
    local = bearing_at(inputs, end)
    if key == "lubricant.base" and local.value("lubricant.temperature") is not None:
        return True
    return local.value(key) is None


def _displaced(inputs: Inputs, given: Mapping[str, Any]) -> Iterable[str]:
    """Keys that new values replace."""
    new = {key for key, value in given.items() if value is not None}
    if "lubricant.base" in new and oil(str(given["lubricant.base"])):
        yield from _within(inputs, "lubricant")
    typed, clearance = inputs.value("bearing.designation"), given.get("bearing.clearance_class")
    if "bearing.base" in given or (typed and clearance and contradicts(str(typed), str(clearance))):
        yield "bearing.designation"
    if "bearing.base" in new:
        names = {*DIMENSIONS, *bearing(str(inputs.value("bearing.base")))}
        yield from (f"bearing.{name}" for name in names - {"base"})
    if "bearing.coating.base" in new and coating(str(given["bearing.coating.base"])):
        known = {"ring", "thickness", "breakdown_voltage", "strength", "resistance"}
        yield from (f"bearing.coating.{name}" for name in known)
    geometry = inputs.value("contact.geometry") or "line"
    new_geometry = given.get("contact.geometry", geometry)
    if new_geometry != geometry:
        yield from (f"contact.{key}" for key in ONLY.get(geometry, ()))
        yield from ("discharge.length", "meter.length")
        yield from (key for key in _within(inputs, "grid") if key.partition(".")[2] not in GRID_OF_ANY)
    for rows in (*ALTERNATIVES, *OF_GEOMETRY.get(str(new_geometry), ())):
        yield from _of_other_rows(rows, new)


def _of_other_rows(rows: Rows, new: set[str]) -> Iterable[str]:
    """Keys of the rows without a new value, where another row has one."""
    taken = [row for row in rows if any(_is_in(name, key) for name in new for key in row)]
    for row in rows:
        if taken and row not in taken:
            yield from row


def _is_in(name: str, key: str) -> bool:
    return name == key or name.startswith(f"{key}.")


def _is_any_of(given: Mapping[str, Any], table: str) -> bool:
    return any(_is_in(key, table) for key in given)


def _within(inputs: Inputs, table: str) -> list[str]:
    return [key for key in inputs.flat() if key.startswith(f"{table}.")]


def _flat(changes: Mapping[str, Any], prefix: str = "") -> dict[str, Any]:
    """Changes by dotted key, with changes of tables under the keys of the tables."""
    flat: dict[str, Any] = {}
    for key, value in changes.items():
        if isinstance(value, Mapping) and value:
            flat |= _flat(value, f"{prefix}{key}.")
        else:
            flat[prefix + key] = value
    return flat
