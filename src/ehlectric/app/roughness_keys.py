"""Keys of a table ``[[roughness]]`` as fields of a page, as data."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any


@dataclass(frozen=True)
class RoughKey:
    """Field for a key of a rough surface."""

    key: str
    label: str  # name of the quantity, with what an empty field means
    example: str = ""  # value that shows how one is written
    # Values to choose from, with what they mean; empty for a field to type in. The first one is the default.
    choices: Mapping[str, str] = field(default_factory=dict)
    number: bool = False  # whether the value is a number without a unit
    point: bool = False  # whether only point contacts use it
    needed: bool = False  # whether a made surface must have it


FILE_KEYS = (
    RoughKey("x_unit", "Unit of positions, where the file states none", "um"),
    RoughKey("z_unit", "Unit of heights, where the file states none", "nm"),
    RoughKey(
        "along",
        "Lines of a map along x",
        choices={"row": "rows of the file", "column": "columns of the file"},
    ),
    RoughKey("line", "Number of the line of a map, from 0", "0", number=True),
    RoughKey(
        "direction",
        "Direction of a measured line",
        choices={"x": "along entrainment", "y": "across entrainment"},
    ),
    RoughKey(
        "assume_transverse",
        "A line measured across, in a line contact",
        choices={"": "refuse it", "true": "use it as if along (assumption)"},
    ),
)

STEP_KEYS = (
    RoughKey(
        "form",
        "Form to remove",
        choices={
            "none": "none (files: mean)",
            "mean": "mean",
            "line": "line or plane",
            "parabola": "parabola or quadric",
        },
    ),
    RoughKey("cutoff_long", "Remove waves longer than", "80 um"),
    RoughKey("cutoff_short", "Remove waves shorter than", "2.5 um"),
    RoughKey("trim", "Cut off each end (empty: half of the longer cutoff)", "40 um"),
    RoughKey("rescale_rq", "Scale the heights to this Rq (Sq of a map)", "50 nm"),
    RoughKey("truncate", "Limit heights to plus and minus", "200 nm"),
    RoughKey(
        "extend",
        "Beyond the ends",
        choices={"mirror": "mirrored", "repeat": "repeated", "flat": "flat"},
    ),
)

PLACE_KEYS = (
    RoughKey("shift", "Shift along x", "20 um"),
    RoughKey("shift_y", "Shift along y", "20 um", point=True),
)

GENERATOR_NAMES: Mapping[str, str] = {
    "sinusoid": "waviness (sinusoid)",
    "gaussian": "random (Gaussian)",
    "self-affine": "random (self-affine)",
    "asperity": "single asperity",
    "pit": "single pit",
}

_RQ = RoughKey("rq", "Root mean square height Rq", "50 nm", needed=True)
_SEED = RoughKey("seed", "Seed of the random numbers", "1", number=True, needed=True)
_WIDTH = RoughKey("width", "Width", "50 um", needed=True)
_ORIENTATION = RoughKey("orientation", "Orientation, counter-clockwise from x", "30 deg", point=True)
_PLACES = (
    RoughKey("position", "Position along x", "0 um"),
    RoughKey("position_y", "Position along y", "0 um", point=True),
)

# Keys of each kind of made surface.
GENERATOR_KEYS: Mapping[str, tuple[RoughKey, ...]] = {
    "sinusoid": (
        RoughKey("amplitude", "Amplitude", "50 nm", needed=True),
        RoughKey("wavelength", "Wavelength", "50 um", needed=True),
        RoughKey("phase", "Phase [rad]", "0", number=True),
        _ORIENTATION,
    ),
    "gaussian": (
        _RQ,
        RoughKey("correlation_length", "Correlation length along x", "20 um", needed=True),
        _SEED,
        RoughKey(
            "correlation_length_y", "Correlation length along y (empty: as along x)", "60 um", point=True
        ),
        _ORIENTATION,
    ),
    "self-affine": (
        _RQ,
        RoughKey("hurst", "Hurst exponent", "0.8", number=True, needed=True),
        RoughKey("rolloff_wavelength", "Roll-off wavelength", "50 um", needed=True),
        _SEED,
        RoughKey(
            "shortest_wavelength",
            "Shortest wavelength (empty: a fraction of the roll-off wavelength)",
            "2 um",
        ),
    ),
    "asperity": (RoughKey("height", "Height", "50 nm", needed=True), _WIDTH, *_PLACES),
    "pit": (
        RoughKey("depth", "Depth", "500 nm", needed=True),
        _WIDTH,
        RoughKey("rim", "Height of the rim", "0 nm"),
        *_PLACES,
    ),
}

# Kinds of made surfaces with processing steps: random ones.
STEPPED = ("gaussian", "self-affine")


def value_of(key: RoughKey, text: str) -> str | int | float | bool | None:
    """Value of a field for the table; None where the field is empty or has the default.

    Examples
    --------
    >>> value_of(FILE_KEYS[3], " 12 "), value_of(STEP_KEYS[1], "80 um"), value_of(STEP_KEYS[0], "none")
    (12, '80 um', None)
    """
    text = text.strip()
    if not text or (key.choices and text == next(iter(key.choices))):
        return None
    if text == "true":
        return True
    if key.number:
        for kind in (int, float):
            try:
                return kind(text)
            except ValueError:
                continue
    return text


# Values with which a made surface begins: the examples of the keys that it needs. All are assumptions.
FIRST_VALUES: Mapping[str, Mapping[str, Any]] = {
    kind: {key.key: value_of(key, key.example) for key in keys if key.needed}
    for kind, keys in GENERATOR_KEYS.items()
}
