"""Keys of a table ``[[roughness]]`` as fields of a page, from the book of quantities."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from ehlectric.app.form_fields.field import form_data


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
    needed: bool = False  # whether a generated surface must have it


_DATA = form_data("roughness")
FILE_KEYS, STEP_KEYS, PLACE_KEYS, MOTION_KEYS = (
    tuple(RoughKey(**entry) for entry in _DATA[name]) for name in ("file", "steps", "place", "motion")
)

# Names of the kinds of generated surfaces, and the keys of each.
GENERATOR_NAMES: Mapping[str, str] = {kind: entry["label"] for kind, entry in _DATA["generators"].items()}
GENERATOR_KEYS: Mapping[str, tuple[RoughKey, ...]] = {
    kind: tuple(RoughKey(**key) for key in entry["keys"]) for kind, entry in _DATA["generators"].items()
}

# Kinds of generated surfaces with processing steps: random ones.
STEPPED = ("gaussian", "self-affine")


def value_of(key: RoughKey, text: str) -> str | int | float | bool | None:
    """Value of a field for the table; None where the field is empty or has the default.

    Examples
    --------
    >>> value_of(FILE_KEYS[5], " 12 "), value_of(STEP_KEYS[1], "80 um"), value_of(STEP_KEYS[0], "none")
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


# Values with which a generated surface begins: the examples of the keys that it needs. All are assumptions.
FIRST_VALUES: Mapping[str, Mapping[str, Any]] = {
    kind: {key.key: value_of(key, key.example) for key in keys if key.needed}
    for kind, keys in GENERATOR_KEYS.items()
}
