"""Inputs that exclude each other, and those of one kind only, for checks, changes of cases, and forms."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TypeAlias

# Rows of alternative keys of a table: a file has the keys of one row at most.
Rows: TypeAlias = tuple[tuple[str, ...], ...]

_BODIES = ("body_1", "body_2")
_ELASTIC = tuple(f"{body}.{key}" for body in _BODIES for key in ("youngs_modulus", "poissons_ratio"))
_RADII = tuple(f"{body}.{key}" for body in _BODIES for key in ("radius_x", "radius_y"))
_SPEEDS: Rows = (("entrainment_speed",), ("speed_1", "speed_2"))

# Keys of a source that is described, and of one that is measured.
DESCRIBED = (
    *("dc_link", "modulation", "switching_frequency", "fundamental_frequency", "pole_pairs"),
    *("modulation_index", "base_frequency", "rise_time", "ringing_frequency", "overshoot", "ringing_time"),
)
MEASURED = ("file", "column", "time_column", "step", "time_unit", "value_unit", "scale", "resample")

# Groups of rows by geometry of a contact, which has all keys of exactly one row of each.
CONTACT_ALTERNATIVES: Mapping[str, tuple[Rows, ...]] = {
    "line": (
        (("reduced_radius",), ("radius_1", "radius_2")),
        (("reduced_modulus",), _ELASTIC),
        (("load_per_length",), ("max_hertz_pressure",)),
        _SPEEDS,
    ),
    "point": (
        (("radius_x", "radius_y"), _RADII),
        (("reduced_modulus",), _ELASTIC),
        (("load",), ("max_hertz_pressure",)),
        _SPEEDS,
    ),
}

# Groups of rows by table.
ALTERNATIVES: Mapping[str, tuple[Rows, ...]] = {
    "contact": ((("slide_to_roll_ratio",), ("speed_1", "speed_2")),),
    "lubricant": (
        (("viscosity",), ("temperature",)),
        (("temperature.kinematic_viscosity_40",), ("temperature.iso_vg",)),
        (("temperature.kinematic_viscosity_100",), ("temperature.viscosity_index",)),
    ),
    "discharge": (
        (("dielectric_strength",), ("strength_table", "temperature"), ("weibull",)),
        (("strength_table.pressure",), ("strength_table.temperature", "temperature")),
    ),
    "meter": ((("fill",), ("oil_radius",)),),
    "inlet": ((("oil_layer",), ("layer_table",), ("film_ratio",)),),
    "motion": ((("passes",), ("duration",)),),
    "grid": tuple((("error",), (key,)) for key in ("nodes", "nodes_y", "refine")),
    "bearing": (
        (("radial_clearance",), ("clearance_class",), ("fits.unmounted_clearance",)),
        (("radial_clearance",), ("fits",)),
        (("coating.strength",), ("coating.breakdown_voltage",)),
        (("summits.height_deviation",), ("summits.bandwidth",)),
    ),
    "source": ((("fundamental_frequency",), ("pole_pairs",)),),
    "breakdown": ((("extinction_current",), ("extinction_voltage",)),),
}

# Keys that only contacts of one geometry have.
ONLY: Mapping[str, tuple[str, ...]] = {
    "line": ("reduced_radius", "radius_1", "radius_2", "load_per_length"),
    "point": ("radius_x", "radius_y", "load", *_RADII),
}

# Dimensions of a bearing, which belong to its base.
DIMENSIONS = (
    *("kind", "elements", "bore", "outer_diameter", "width", "element_diameter", "pitch_diameter"),
    *("inner_groove", "outer_groove", "roller_length", "profile", "shoulder_height"),
)

# Keys of a grid that stay if the geometry changes. Lengths, numbers of nodes and the error are removed,
# because the other geometry has other units of length and other defaults.
GRID_OF_ANY = ("wedge", "field_degree", "refine")


def dotted(table: str, groups: tuple[Rows, ...]) -> tuple[Rows, ...]:
    """Groups of a table with dotted keys.

    Examples
    --------
    >>> dotted("meter", ALTERNATIVES["meter"])
    ((('meter.fill',), ('meter.oil_radius',)),)
    """
    return tuple(tuple(tuple(f"{table}.{key}" for key in row) for row in rows) for rows in groups)
