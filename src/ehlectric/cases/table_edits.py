"""Changes of nested tables by dotted keys: new values are set, and alternatives to them are removed."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from pydantic import BaseModel

from ehlectric.cases.oil_inputs import displace_oil
from ehlectric.errors import InputError, shown
from ehlectric.quantities.alternatives import ALTERNATIVES, CONTACT_ALTERNATIVES, GRID_OF_ANY, ONLY, Rows
from ehlectric.quantities.rows import value_at


def set_keys(table: dict[str, Any], flat: Mapping[str, Any]) -> None:
    """Set values of nested tables by dotted key; a table or a number in a list is named by its place, from 1.
    Raises InputError if a part of a key is not the name of a table, or not a place in a list.

    Examples
    --------
    >>> table = {"grid": {"nodes": 3201}}
    >>> set_keys(table, {"grid.nodes": 801, "electric.potential_1": "0 V"})
    >>> table
    {'grid': {'nodes': 801}, 'electric': {'potential_1': '0 V'}}
    """
    for key, value in flat.items():
        *parents, leaf = key.split(".")
        target: Any = table
        for place, parent in enumerate(parents, 1):
            if leaf.isdecimal() and place == len(parents) and parents[0] == _GEAR:
                _make_pair(target, parent, key)
            target = _part(target, parent, key)
        if isinstance(target, list) and target and not any(isinstance(each, dict) for each in target):
            if not (leaf.isdecimal() and 1 <= int(leaf) <= len(target)):
                raise InputError(key, got=shown(leaf), takes=f"a place from 1 to {len(target)} in the list")
            target[int(leaf) - 1] = value
            continue
        if isinstance(target, list):
            of_list = _part(target, leaf, key)
            raise InputError(
                key, "is a table", takes=f"one of its keys, as {key}.{next(iter(of_list), '...')}"
            )
        # An empty value adds a missing table, but does not change an existing table.
        if not (isinstance(value, dict) and not value and isinstance(target.get(leaf), dict)):
            target[leaf] = value


# Table whose numbers may be one for both gears, or a list.
_GEAR = "gear"


def _make_pair(table: Any, name: str, key: str) -> None:
    """Make a list of one value that holds for both gears, of which a key changes one."""
    value = table.get(name) if isinstance(table, dict) else {}
    if value is None:
        raise InputError(
            key, got="one value", takes=f"{key.rpartition('.')[0]} with the values of both gears"
        )
    if not isinstance(value, dict | list):
        table[name] = [value, value]


def given_value(table: Mapping[str, Any], key: str) -> Any:
    """Value at the dotted key of an input, in which places in lists count from 1; None where there is none.

    Examples
    --------
    >>> given_value({"gear": {"flank_ra": [5e-8, 1e-7]}}, "gear.flank_ra.2")
    1e-07
    """
    above, _, leaf = key.rpartition(".")
    if not (above and leaf.isdecimal()):
        return value_at(table, key)
    values = value_at(table, above)
    if isinstance(values, list | tuple):
        return values[int(leaf) - 1] if 1 <= int(leaf) <= len(values) else None
    return values  # one number for both


def _part(table: Any, name: str, key: str) -> Any:
    """Table with this name in a table, or with this number, from 1, in a list of tables."""
    if isinstance(table, list):
        if not (name.isdecimal() and 1 <= int(name) <= len(table)):
            there = f"a number from 1 to {len(table)}" if table else "none, as there are no tables"
            raise InputError(key, got=f"{shown(name)} for the table of a list", takes=there)
        return table[int(name) - 1]
    part = table.setdefault(name, {})
    if not isinstance(part, dict | list):
        raise InputError(key, f"unknown key, {name} is not a table")
    return part


def flattened(tables: Mapping[str, Any], prefix: str = "") -> dict[str, Any]:
    """Flatten nested tables to values by dotted key.

    Examples
    --------
    >>> flattened({"grid": {"nodes": 801}, "title": "A"})
    {'grid.nodes': 801, 'title': 'A'}
    """
    flat: dict[str, Any] = {}
    for key, value in tables.items():
        if isinstance(value, BaseModel):
            value = value.model_dump(mode="json", exclude_none=True, exclude_unset=True)
        if isinstance(value, Mapping) and value:
            flat |= flattened(value, f"{prefix}{key}.")
        else:
            flat[prefix + key] = value
    return flat


def displace(
    table: dict[str, Any], changes: Mapping[str, Any], alternatives: Mapping[str, tuple[Rows, ...]]
) -> None:
    """Remove from nested tables the keys that are alternatives to changed keys.

    Examples
    --------
    >>> table = {"contact": {"load": 20.0, "geometry": "point"}}
    >>> displace(table, {"contact.pressure": 1e9}, {"contact": ((("load",), ("pressure",)),)})
    >>> table
    {'contact': {'geometry': 'point'}}
    """
    for name, groups in alternatives.items():
        _displace_in(table.get(name, {}), _names_in(name, changes), groups)


def nested(changes: Mapping[str, Any], table: str) -> dict[str, Any]:
    """Changed values of one table, with the values of its own tables nested once.

    Examples
    --------
    >>> nested({"lubricant.temperature.iso_vg": 46, "lubricant.viscosity": None}, "lubricant")
    {'temperature': {'iso_vg': 46}, 'viscosity': None}
    """
    tables: dict[str, Any] = {}
    for key, value in flattened(changes).items():
        first, _, rest = key.removeprefix(f"{table}.").partition(".")
        if key.startswith(f"{table}."):
            tables[first] = {**tables.get(first, {}), rest: value} if rest else value
    return tables


def _names_in(table: str, changes: Mapping[str, Any]) -> set[str]:
    """Changed keys of one table, without the name of the table."""
    return {key.removeprefix(f"{table}.") for key in flattened(changes) if key.startswith(f"{table}.")}


def _displace_in(table: dict[str, Any], names: set[str], groups: tuple[Rows, ...]) -> None:
    """Remove from one table the keys that are alternatives to its changed keys."""
    for group in groups:
        for row in group:
            if any(_within(name, key) for name in names for key in row):
                for key in {key for other in group if other is not row for key in other}:
                    if not any(_within(name, key) for name in names):
                        drop(table, key)


def _within(name: str, key: str) -> bool:
    """Whether a dotted name is equal to the key, or is a key inside the table ``key``."""
    return name == key or name.startswith(f"{key}.")


def drop(table: dict[str, Any], key: str) -> None:
    """Remove a dotted key from nested tables, and its table if no key is left in it."""
    first, _, leaf = key.partition(".")
    if not leaf:
        table.pop(first, None)
    elif isinstance(table.get(first), dict):
        table[first].pop(leaf, None)
        if not table[first]:
            del table[first]


def drop_geometry(table: dict[str, Any], geometry: str) -> None:
    """Remove the keys of a case that only contacts of this geometry have."""
    for key in ONLY[geometry]:
        drop(table["contact"], key)
    drop(table, "discharge.length")
    drop(table, "meter.length")
    drop(table, "inlet.layer_table")
    table["grid"] = {key: value for key, value in table["grid"].items() if key in GRID_OF_ANY}


def displace_alternatives(table: dict[str, Any], changes: Mapping[str, Any], geometry: object) -> None:
    """Remove from the tables of a case the keys that the changes replace."""
    if "lubricant.base" in changes:
        table["lubricant"] = {}
    alternatives = {name: ALTERNATIVES[name] for name in ("discharge", "meter", "inlet", "motion", "grid")}
    of_geometry = CONTACT_ALTERNATIVES.get(str(geometry), ())
    alternatives["contact"] = (*of_geometry, *ALTERNATIVES["contact"])
    displace(table, changes, alternatives)
    for number, surface in enumerate(table.get("roughness", ()), 1):
        names = _names_in(f"roughness.{number}", changes)
        _displace_in(surface, names, ALTERNATIVES["roughness"])
    displace_oil(table.get("lubricant", {}), nested(changes, "lubricant"))
