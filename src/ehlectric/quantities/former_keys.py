"""Former keys of results: tables that contain them and their successors, and warnings to their readers."""

from __future__ import annotations

import warnings
from collections.abc import Mapping
from typing import Any

from ehlectric.quantities.quantity import Keys


class Table(dict[str, Any]):
    """Table of a summary that warns a reader of a former key; it is equal to a dict with these items.

    Examples
    --------
    >>> table = Table({"old": 2.0, "new": 2.0}, {"old": "bearing.new"})
    >>> with warnings.catch_warnings(record=True) as caught:
    ...     warnings.simplefilter("always")
    ...     table["new"], table["old"], str(caught[0].message)
    (2.0, 2.0, 'old is deprecated; use bearing.new')
    """

    def __init__(self, values: Mapping[str, Any], successors: Mapping[str, str]) -> None:
        super().__init__(values)
        self._successors = dict(successors)

    def __getitem__(self, key: str) -> Any:
        self._warn(key)
        return super().__getitem__(key)

    def get(self, key: str, default: Any = None) -> Any:
        """Return the value of a key, or ``default`` if the table does not contain the key."""
        self._warn(key)
        return super().get(key, default)

    def __reduce__(self) -> tuple[type[Table], tuple[dict[str, Any], dict[str, str]]]:
        return Table, (dict(self), self._successors)

    def _warn(self, key: str) -> None:
        if key in self._successors:
            _warn(key, self._successors[key], stacklevel=4)


def _warn(key: str, successor: str, *, stacklevel: int) -> None:
    text = f"{key} is deprecated; use {successor}"
    warnings.warn(text, DeprecationWarning, stacklevel=stacklevel)


def successors(keys: Keys) -> dict[str, str]:
    """Return the dotted key of the successor by each former key of a summary."""
    return {
        key: f"{key.rpartition('.')[0]}.{quantity.successor}".removeprefix(".")
        for key, quantity in keys.items()
        if quantity.successor
    }


def current_key(key: str, keys: Keys) -> str:
    """Return the key to use; for a former key this is its successor, with a DeprecationWarning."""
    successor = successors(keys).get(key)
    if successor is None:
        return key
    _warn(key, successor, stacklevel=4)
    return successor


def with_former_keys(table: Mapping[str, Any], name: str, keys: Keys) -> dict[str, Any]:
    """Add the former keys to a table, with the values of their successors.

    ``name`` is the name of the table in the summary that ``keys`` describe. Keys that the
    table contains keep their values.
    """
    former = {
        key.removeprefix(f"{name}."): table[successor.removeprefix(f"{name}.")]
        for key, successor in successors(keys).items()
        if key.startswith(f"{name}.") and successor.removeprefix(f"{name}.") in table
    }
    return {**former, **table}


def with_successors(summary: dict[str, Any], keys: Keys) -> dict[str, Any]:
    """Add the successors of former keys to a stored summary of an earlier version.

    Words of former keys keep their spelling.
    """
    tables: dict[str, dict[str, Any]] = {}
    for key, successor in successors(keys).items():
        name, _, former = key.rpartition(".")
        table = tables.get(name, summary.get(name))
        if isinstance(table, dict) and former in table:
            tables[name] = {successor.removeprefix(f"{name}."): dict.get(table, former), **table}
    return {**summary, **tables}


def warning_tables(summary: Mapping[str, Any], keys: Keys) -> dict[str, Any]:
    """Replace each table of a summary that contains former keys with a ``Table``, also in lists of rows."""
    by_table: dict[str, dict[str, str]] = {}
    for key, successor in successors(keys).items():
        name, _, former = key.rpartition(".")
        by_table.setdefault(name, {})[former] = successor

    def replaced(value: Any, name: str) -> Any:
        if isinstance(value, list):
            return [replaced(item, name) for item in value]
        if not isinstance(value, Mapping):
            return value
        items = {key: replaced(item, f"{name}.{key}".removeprefix(".")) for key, item in value.items()}
        return Table(items, by_table[name]) if name in by_table else items

    whole: dict[str, Any] = replaced(summary, "")
    return whole
