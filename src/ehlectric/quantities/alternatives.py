"""Inputs that exclude each other, and those of one kind only, for checks, changes of cases, and forms."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, TypeAlias

from ehlectric.quantities.quantity import data_file

# Rows of alternative keys of a table: a file has the keys of one row at most.
Rows: TypeAlias = tuple[tuple[str, ...], ...]

_READ = data_file("ehlectric.quantities", "alternatives.toml")


def _groups(read: Mapping[str, Any]) -> dict[str, tuple[Rows, ...]]:
    """Groups of rows by their names, from nested lists."""
    return {name: tuple(tuple(map(tuple, rows)) for rows in groups) for name, groups in read.items()}


# Groups of rows by geometry of a contact, which has all keys of exactly one row of each; and by table.
CONTACT_ALTERNATIVES, ALTERNATIVES = _groups(_READ["contact"]), _groups(_READ["tables"])

# Keys that only contacts of one geometry have.
ONLY: Mapping[str, tuple[str, ...]] = {name: tuple(keys) for name, keys in _READ["only"].items()}

# Keys of a source that is described, and of one that is measured; dimensions of a bearing, which belong to
# its base; and keys of a grid that stay if the geometry changes.
DESCRIBED, MEASURED, DIMENSIONS, GRID_OF_ANY = (
    tuple[str, ...](_READ["keys"][name]) for name in ("described", "measured", "dimensions", "grid_of_any")
)


def dotted(table: str, groups: tuple[Rows, ...]) -> tuple[Rows, ...]:
    """Groups of a table with dotted keys.

    Examples
    --------
    >>> dotted("meter", ALTERNATIVES["meter"])[0]
    (('meter.fill',), ('meter.oil_radius',))
    """
    return tuple(tuple(tuple(f"{table}.{key}" for key in row) for row in rows) for rows in groups)
