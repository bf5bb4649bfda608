"""Changes of the nested tables of a file by dotted keys: what is set, and what that displaces."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from pydantic import BaseModel

from ehlectric.errors import InputError, shown

# Groups of alternatives in one table: rows of keys of which one is given.
Groups = tuple[tuple[tuple[str, ...], ...], ...]


def set_keys(table: dict[str, Any], flat: Mapping[str, Any]) -> None:
    """Set values by dotted key, those of a list of tables with their number from 1.

    Raises
    ------
    InputError
        Where a key leads into no table.

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
        for parent in parents:
            target = _part(target, parent, key)
        if isinstance(target, list):
            raise InputError(key, "is a table", takes=f"one of its keys, as {key}.surface")
        # An empty table changes nothing, but is there.
        if not (value == {} and isinstance(target.get(leaf), dict)):
            target[leaf] = value


def _part(table: Any, name: str, key: str) -> Any:
    """The table of this name within another, or of this number, from 1, within a list."""
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
    """Values of nested tables by dotted key, as they are given.

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


def displace(table: dict[str, Any], changes: Mapping[str, Any], alternatives: Mapping[str, Groups]) -> None:
    """Drop from nested tables what the changes, by dotted key, are alternatives to.

    Examples
    --------
    >>> table = {"contact": {"load": 20.0, "geometry": "point"}}
    >>> displace(table, {"contact.pressure": 1e9}, {"contact": ((("load",), ("pressure",)),)})
    >>> table
    {'contact': {'geometry': 'point'}}
    """
    for name, groups in alternatives.items():
        _displace_in(table.get(name, {}), _names_in(name, changes), groups)


def _names_in(table: str, changes: Mapping[str, Any]) -> set[str]:
    """Keys of one table that change, without its name."""
    return {key.removeprefix(f"{table}.") for key in flattened(changes) if key.startswith(f"{table}.")}


def _displace_in(table: dict[str, Any], names: set[str], groups: Groups) -> None:
    """Drop from one table what is an alternative to the keys that change."""
    for group in groups:
        for row in group:
            if any(_within(name, key) for name in names for key in row):
                for key in {key for other in group if other is not row for key in other}:
                    if not any(_within(name, key) for name in names):
                        drop(table, key)


def _within(name: str, key: str) -> bool:
    """Whether a dotted name is the key, or lies in the table of that name."""
    return name == key or name.startswith(f"{key}.")


def drop(table: dict[str, Any], key: str) -> None:
    """Drop a dotted key, and its table where that leaves it empty."""
    first, _, leaf = key.partition(".")
    if not leaf:
        table.pop(first, None)
    elif isinstance(table.get(first), dict):
        table[first].pop(leaf, None)
        if not table[first]:
            del table[first]
