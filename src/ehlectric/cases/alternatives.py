"""Alternative keys of a case: a new key removes those it replaces, a new geometry those of the old one."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ehlectric.cases.changes import displace, drop
from ehlectric.cases.contact import CONTACT_ALTERNATIVES, ONLY
from ehlectric.cases.discharge import STRENGTHS, TABLES

# Keys of a grid that stay if the geometry changes. Lengths and numbers of nodes are removed, because the
# other geometry has other units of length and other defaults.
_GRID_OF_ANY = ("wedge", "field_degree", "refine")


def drop_geometry(table: dict[str, Any], geometry: str) -> None:
    """Remove the keys of a case that only contacts of this geometry have."""
    for key in ONLY[geometry]:
        drop(table["contact"], key)
    drop(table, "discharge.length")
    table["grid"] = {key: value for key, value in table["grid"].items() if key in _GRID_OF_ANY}


def displace_alternatives(table: dict[str, Any], changes: Mapping[str, Any], geometry: object) -> None:
    """Remove from the tables of a case the keys that the changes replace."""
    if "lubricant.base" in changes:
        table["lubricant"] = {}
    alternatives = {
        "contact": (
            *CONTACT_ALTERNATIVES.get(str(geometry), ()),
            (("slide_to_roll_ratio",), ("speed_1", "speed_2")),
        ),
        "discharge": (STRENGTHS, TABLES),
        "motion": ((("passes",), ("duration",)),),
    }
    displace(table, changes, alternatives)
