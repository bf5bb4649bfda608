"""Tables of the keys of summary.json, written from the tables beside the code that fills them."""

from __future__ import annotations

from collections.abc import Iterable

from ehlectric.quantities.quantity import Keys
from ehlectric.quantities.results import (
    AXLE_KEYS,
    BEARING_KEYS,
    CONTACT_KEYS,
    DRIVE_KEYS,
    GEAR_KEYS,
    MOTION_KEYS,
    PATH_POINTS,
)

_DISCHARGE, _METER, _SURFACES = "discharge", "meter", "rough"
# Tables of a drive that repeat the keys of its drive end.
_OTHER_END, _REMEDIES = "non_drive_end", "remedies"
# Points of the path of contact of a gear pair that repeat the keys of point A.
_OTHER_POINTS = tuple(f"points.{point}." for point in PATH_POINTS[1:])


def summary_pages() -> dict[str, str]:
    """Text of each table by the name of its file, for results of every kind."""
    line, point = (_without(_without(keys, _DISCHARGE), _METER) for keys in CONTACT_KEYS.values())
    other = {name: key for name, key in point.items() if line.get(name) != key}
    discharges = [_within(keys, _DISCHARGE) for keys in CONTACT_KEYS.values()]
    # What was done to each rough surface has the keys of the surfaces of a contact.
    motions = [_without(keys, _SURFACES) for keys in MOTION_KEYS.values()]
    return {
        "summary_line": _table(line),
        "summary_point": _table(other),
        "summary_discharge": _table(*discharges),
        "summary_meter": _table(_within(CONTACT_KEYS["point"], _METER)),
        "summary_bearing": _table(BEARING_KEYS),
        "summary_drive": _table(_without(_without(DRIVE_KEYS, _OTHER_END), _REMEDIES)),
        "summary_gear": _table(_gear()),
        "summary_axle": _table(AXLE_KEYS),
        "summary_motion": _table(*motions),
    }


def _gear() -> Keys:
    """Keys of a gear pair; those of point A stand for all points of the path of contact."""
    keys = {name: key for name, key in GEAR_KEYS.items() if not name.startswith(_OTHER_POINTS)}
    return {name.replace("points.A.", "points.<point>."): key for name, key in keys.items()}


def _within(keys: Keys, table: str) -> Keys:
    return {name: key for name, key in keys.items() if name.startswith(f"{table}.")}


def _without(keys: Keys, table: str) -> Keys:
    return {name: key for name, key in keys.items() if not name.startswith(f"{table}.")}


def _table(*kinds: Keys) -> str:
    """Rows of key, meaning and unit; where the units of a line and a point contact differ it has both."""
    names = dict.fromkeys(name for keys in kinds for name in keys)
    rows = []
    for name in names:
        found = [keys[name] for keys in kinds if name in keys]
        rows.append((f"`{name}`", found[0].meaning, _units(key.unit for key in found)))
    lines = [("key", "meaning", "unit"), ("---", "---", "---"), *rows]
    return "```{rst-class} keys\n```\n\n" + "".join(f"| {' | '.join(cells)} |\n" for cells in lines)


def _units(units: Iterable[str]) -> str:
    """Units as they are printed, a dash for none."""
    printed = (unit.replace("**2", "²").replace("**3", "³").replace("*", " ") for unit in units)
    return "; ".join(unit or "\N{EN DASH}" for unit in dict.fromkeys(printed))
