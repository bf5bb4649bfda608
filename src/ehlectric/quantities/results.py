"""Results of all kinds by the dotted keys of summary.json, from the files ``*_results.toml`` of this folder.

``contact_results.toml`` explains the fields of an entry. Keys that several kinds have, and the keys of oils
and of surfaces, stand once. A book has besides the keys of a summary what outputs show and no summary stores.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from functools import cache
from types import MappingProxyType
from typing import Any

from ehlectric.quantities.inputs import ENDS, attributes, input_at
from ehlectric.quantities.quantity import Keys, Quantity, data_file, under

# Voltages whose share of time the summary of a drive has [V]: in the field, discharges begin at a few volts.
LIMITS = (1.0, 2.0, 5.0, 10.0, 20.0, 50.0)

# Bearings of a drive in labels, by the names of their tables.
NAMES_OF_ENDS: Mapping[str, str] = MappingProxyType(
    dict(zip(ENDS, ("drive end", "non-drive end"), strict=True))
)

# Results of bearings and gears that are texts and may differ between the points of a sweep.
TEXTS_OF_POINTS = (
    "bearing.lubrication_state",
    "bearing.lubrication",
    "bearing.electrical_behaviour",
    "bearing.regime",
    "bearing.first_break_at",
    "mesh.state",
    "mesh.minimum_at",
    "first.element",
)


def is_text_of_points(key: str) -> bool:
    """Whether a result of a dotted key is a text that may differ between the points of a sweep.

    Examples
    --------
    >>> is_text_of_points("mesh.state"), is_text_of_points("elements.mesh_1.state")
    (True, True)
    """
    return key in TEXTS_OF_POINTS or (key.startswith("elements.") and key.endswith(".state"))


# Results that are no number, and no text that differs between points: tables, and ends of dotted keys.
_WORDS = ("laws",)
_ENDS_OF_WORDS = ("_source", "_limits", ".contact_model", ".contacts", ".name", ".element", ".shaft")


def is_number_of_points(key: str) -> bool:
    """Whether a result of a dotted key is a number, also where no point has one.

    Examples
    --------
    >>> is_number_of_points("bearing.first_break"), is_number_of_points("life.static_rating_source")
    (True, False)
    """
    words = any(part in key.split(".") for part in _WORDS) or key.endswith(_ENDS_OF_WORDS)
    return not (words or is_text_of_points(key))


# Statistics of the discharges of a bearing, by the ends of their keys.
STATISTICS = {"mean": "mean", "median": "median", "high": "95th percentile", "largest": "maximum"}

# Columns of the spectrum of the shaft voltage, with their units.
SPECTRUM_COLUMNS = {"frequency": "Hz", "shaft_voltage": "V"}

# Table of a file whose keys stand in no table of a summary.
_OUTSIDE = "summary"

_GEOMETRIES = ("line", "point")


@cache
def _entries(kind: str) -> Mapping[str, Mapping[str, Any]]:
    """Fields of the entries of a kind of result, by dotted key; former keys are the last ones."""
    entries: dict[str, Mapping[str, Any]] = {
        name if table == _OUTSIDE else f"{table}.{name}": fields
        for table, keys in data_file("ehlectric.quantities", f"{kind}_results.toml").items()
        for name, fields in keys.items()
    }
    for key, former in data_file("ehlectric.quantities", "former_results.toml").get(kind, {}).items():
        successor = f"{key.rpartition('.')[0]}.{former['successor']}"
        meaning = f"deprecated; use `{successor.removeprefix('end.')}`"
        words = f". Values: {former['meaning']}" if "meaning" in former else ""
        entries[key] = {**entries[successor], "meaning": meaning + words, "successor": former["successor"]}
    return entries


def _quantity(fields: Mapping[str, Any], geometry: str) -> Quantity:
    chosen = {
        name: value[geometry] if isinstance(value, dict) else value
        for name, value in fields.items()
        if name not in ("only", "stored")
    }
    return Quantity(**chosen)


# Tables of the inputs that rows of a kind of result show.
_INPUTS = {"contact": ("contact", "grid"), "bearing": ("bearing", "motor", "discharge")}


def _inputs(kind: str) -> dict[str, Quantity]:
    """Inputs that rows of a kind of result show, by dotted key."""
    shown: dict[str, Quantity] = {}
    for key, unit in attributes("in_results").items():
        entry = input_at(key)
        if entry is not None and key.partition(".")[0] in _INPUTS.get(kind, ()):
            shown[f"inputs.{key}"] = Quantity(entry.meaning, entry.unit, entry.label, shown=unit)
    return shown


def _read(kind: str, geometry: str = "", *, stored: bool = True) -> dict[str, Quantity]:
    """Quantities of a file by dotted key: those that a summary stores, or the others, with inputs."""
    read = {
        key: _quantity(fields, geometry)
        for key, fields in _entries(kind).items()
        if fields.get("stored", True) is stored and fields.get("only", geometry) == geometry
    }
    return read if stored else read | _inputs(kind)


def _within(table: str, keys: Keys) -> dict[str, Quantity]:
    """Quantities of a table, by their names in it."""
    start = f"{table}."
    return {key.removeprefix(start): quantity for key, quantity in keys.items() if key.startswith(start)}


def _of_heights(statistics: Keys, zone: str) -> dict[str, Quantity]:
    """Statistics of z1 + z2 within a zone."""
    return {
        name: replace(quantity, meaning=f"{quantity.meaning}, of z1 + z2 within the {zone}")
        for name, quantity in statistics.items()
    }


_SURFACES = _read("surface")
_PROFILE, _MAP = _within("profile", _SURFACES), _within("map", _SURFACES)
_OF_PROFILE = {
    **_within("surface", _SURFACES),
    **under("steps", {**_within("profile_step", _SURFACES), **_PROFILE}),
}
# Keys of a rough surface; a point contact may have a profile too, which is constant across its direction.
_ROUGH: Mapping[str, Keys] = {
    "line": _OF_PROFILE,
    "point": {**_OF_PROFILE, **under("steps", {**_within("map_step", _SURFACES), **_MAP})},
}
_COMBINED: Mapping[str, Keys] = {
    "line": _of_heights(_PROFILE, "Hertzian zone"),
    "point": _of_heights(_MAP, "rectangle around the Hertzian ellipse"),
}
_OIL = under("lubricant", _within("oil", _read("oil")))

# Contacts, by geometry.
CONTACT_KEYS: Mapping[str, Keys] = {
    geometry: {
        **_OIL,
        **_read("contact", geometry),
        **under("roughness.surfaces", _ROUGH[geometry]),
        **under("roughness.combined", _COMBINED[geometry]),
    }
    for geometry in _GEOMETRIES
}
CONTACT_BOOK: Mapping[str, Keys] = {
    geometry: {**keys, **_read("contact", geometry, stored=False)} for geometry, keys in CONTACT_KEYS.items()
}

# Contacts with moving roughness, by geometry.
MOTION_KEYS: Mapping[str, Keys] = {
    geometry: {**_read("motion", geometry), **under("rough", _ROUGH[geometry])} for geometry in _GEOMETRIES
}
MOTION_BOOK: Mapping[str, Keys] = {
    geometry: {**keys, **_read("motion", geometry, stored=False)} for geometry, keys in MOTION_KEYS.items()
}

# Bearings, and the rows of their contacts, which are also the columns of contacts.csv.
BEARING_KEYS: Keys = {**_OIL, **_read("bearing")}
BEARING_BOOK: Keys = {**BEARING_KEYS, **_read("bearing", stored=False)}
ELEMENT_KEYS: Keys = _within("contacts", BEARING_KEYS)

# Drives: the table "end" belongs to the bearing at either end, "event" a row of the table of discharges.
_DRIVE = {**_read("drive"), **under("end.life", _within("life", BEARING_KEYS))}
_ENDS: Keys = {
    f"{end}.{name}": replace(quantity, label=f"{quantity.label}, {words}" if quantity.label else "")
    for end, words in NAMES_OF_ENDS.items()
    for name, quantity in _within("end", _DRIVE).items()
}
# Sums of both bearings that each remedy has.
_SUMS = (
    "drive.events",
    "drive.events_per_second",
    "drive.events_per_second_low",
    "drive.events_per_second_high",
    "drive.power",
    "duty.discharges",
    "duty.energy",
    "duty.left_out_share",
)
DRIVE_KEYS: Keys = {
    **{key: quantity for key, quantity in _DRIVE.items() if not key.startswith(("end.", "event."))},
    **_ENDS,
    **under("remedies", _ENDS),
    **under("remedies", {key: _DRIVE[key] for key in _SUMS}),
}
DRIVE_BOOK: Keys = {**_DRIVE, **DRIVE_KEYS, **_read("drive", stored=False)}

# Gear pairs, and the points of their path of contact, which are also the rows of path.csv.
_GEAR = {**_OIL, **_read("gear")}
POINT_KEYS: Keys = _within("point", _GEAR)
PATH_POINTS = ("A", "B", "C", "D", "E")
GEAR_KEYS: Keys = {
    **{key: quantity for key, quantity in _GEAR.items() if not key.startswith("point.")},
    **{
        f"points.{point}.{name}": replace(quantity, label=f"{quantity.label}, point {point}")
        for point in PATH_POINTS
        for name, quantity in POINT_KEYS.items()
    },
}
# Columns of mesh.csv, with their units.
PHASE_COLUMNS = {
    "phase": "",
    "capacitance": "F",
    "breakdown_voltage": "V",
    "contact_time_share": "",
    "phase_weight": "",
}
GEAR_BOOK: Keys = {**GEAR_KEYS, **_read("gear", stored=False)}

# Axles, and the rows of their elements and shafts, which are also the columns of elements.csv and shafts.csv.
_AXLE = _read("axle")
AXLE_ELEMENT_KEYS: Keys = _within("element", _AXLE)
AXLE_SHAFT_KEYS: Keys = _within("shaft", _AXLE)
AXLE_KEYS: Keys = {
    **{key: quantity for key, quantity in _AXLE.items() if not key.startswith(("element.", "shaft."))},
    **under("elements", AXLE_ELEMENT_KEYS),
    **under("shafts", AXLE_SHAFT_KEYS),
}
EVENT_KEYS: Keys = _within("event", _DRIVE)
EVENT_COLUMNS = {name: quantity.unit for name, quantity in EVENT_KEYS.items()}
