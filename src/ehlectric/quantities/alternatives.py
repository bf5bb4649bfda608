"""Inputs that exclude each other, and inputs of only one kind, for checks, changes of cases, and forms."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import TypeAlias

from ehlectric.quantities.inputs import attributes
from ehlectric.quantities.quantity import data_file

# Rows of alternative keys of a table: a file has the keys of one row at most.
Rows: TypeAlias = tuple[tuple[str, ...], ...]

_READ = data_file("ehlectric.quantities", "alternatives.toml")

# Groups of rows by table.
ALTERNATIVES: Mapping[str, tuple[Rows, ...]] = {
    table: tuple(tuple(map(tuple, rows)) for rows in groups) for table, groups in _READ["tables"].items()
}

GEOMETRIES = ("line", "point")

# Keys that only contacts of one geometry have.
ONLY: Mapping[str, tuple[str, ...]] = {
    geometry: tuple(
        key.removeprefix("contact.") for key, only in attributes("only").items() if only == geometry
    )
    for geometry in GEOMETRIES
}


def _groups(geometry: str) -> dict[str, Rows]:
    """Groups of rows of alternative keys of a contact, by their names."""
    groups: dict[str, dict[int, list[str]]] = {}
    for key, places in attributes("row_of").items():
        if attributes("only").get(key, geometry) == geometry:
            for group, row in places.items():
                groups.setdefault(group, {}).setdefault(row, []).append(key.removeprefix("contact."))
    return {group: tuple(tuple(rows[row]) for row in sorted(rows)) for group, rows in groups.items()}


# Groups of rows by name and geometry of a contact, which has all keys of exactly one row of each.
CONTACT_GROUPS: Mapping[str, Mapping[str, Rows]] = {geometry: _groups(geometry) for geometry in GEOMETRIES}
CONTACT_ALTERNATIVES: Mapping[str, tuple[Rows, ...]] = {
    geometry: tuple(groups.values()) for geometry, groups in CONTACT_GROUPS.items()
}

# Keys of a source that is described, and of one that is measured; dimensions of a bearing, which belong to
# its base; and keys of a grid that stay if the geometry changes.
DESCRIBED, MEASURED, DIMENSIONS, GRID_OF_ANY = (
    tuple[str, ...](_READ["keys"][name]) for name in ("described", "measured", "dimensions", "grid_of_any")
)


def with_groups(keys: Iterable[str]) -> tuple[str, ...]:
    """Keys in which the name of a group, in angle brackets, stands for its keys in all results.

    Examples
    --------
    >>> with_groups(["inputs.contact.<load>", "inputs.contact.temperature"])
    ('inputs.contact.load', 'inputs.contact.load_per_length', 'inputs.contact.temperature')
    """
    listed: dict[str, None] = {}
    for key in keys:
        head, _, group = key.removesuffix(">").partition("<")
        firsts = (CONTACT_GROUPS[geometry][group][0] for geometry in ("point", "line")) if group else [("",)]
        listed |= dict.fromkeys(f"{head}{name}" for names in firsts for name in names)
    return tuple(listed)


def dotted(table: str, groups: tuple[Rows, ...]) -> tuple[Rows, ...]:
    """Groups of a table with dotted keys.

    Examples
    --------
    >>> dotted("meter", ALTERNATIVES["meter"])[0]
    (('meter.fill',), ('meter.oil_radius',))
    """
    return tuple(tuple(tuple(f"{table}.{key}" for key in row) for row in rows) for rows in groups)
