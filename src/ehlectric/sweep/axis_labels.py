"""Labels of inputs and results: name, symbol and unit of a dotted key, and prefixed units for its values."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ehlectric.arrays import Array
from ehlectric.cases.axle_case import AxleCase
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.cases.drive_case import DriveCase
from ehlectric.cases.gear_case import GearCase
from ehlectric.cases.input_keys import input_of, kind_of, unit_of
from ehlectric.cases.solved_case import SolvedCase
from ehlectric.quantities.formats import CELSIUS, Scale, scale_for
from ehlectric.quantities.former_keys import successors
from ehlectric.quantities.inputs import end_and_key
from ehlectric.quantities.quantity import Bound, Keys, key_of
from ehlectric.quantities.results import (
    AXLE_ELEMENT_KEYS,
    AXLE_KEYS,
    AXLE_SHAFT_KEYS,
    BEARING_KEYS,
    CONTACT_KEYS,
    DRIVE_KEYS,
    GEAR_KEYS,
    MOTION_KEYS,
    NAMES_OF_ENDS,
)


@dataclass(frozen=True)
class Label:
    """Name, symbol and unit of a key for tables and figures."""

    name: str  # name, such as "load per length"; the dotted key itself if it has no name
    symbol: str  # symbol, such as "$w$"; may be empty
    unit: str  # SI unit in the notation of pint; empty for dimensionless values, or if the unit is not known
    bound: Bound = ""  # sign of the bound that an ideal film makes of a result
    shown: str = ""  # unit in which a value is usually shown; empty if there is none
    successor: str = ""  # dotted key that replaces a former key; empty for a key in use

    @property
    def absolute(self) -> bool:
        """Whether the values are temperatures on a scale with a zero, and no differences of temperatures."""
        return self.unit == "K" and self.shown == "°C"

    def scaled(self, values: Array) -> Scale:
        """Prefixed unit that suits the largest of some SI values; values that are not finite are ignored.
        Temperatures are in °C, and differences of temperatures in K.
        """
        if self.absolute:
            return CELSIUS
        finite = np.abs(values[np.isfinite(values)])
        return scale_for(float(np.max(finite, initial=0.0)) or 1.0, self.unit)

    def attributes(self, *, number: bool) -> dict[str, str]:
        """CF attributes of a variable: its name, the unit of a ``number``, and the key that replaces it."""
        units = {"units": self.unit.replace("**", "^").replace("*", " ") or "1"} if number else {}
        notice = {"deprecated": f"use {self.successor}"} if self.successor else {}
        return {"long_name": self.name, **units, **notice}

    @property
    def with_symbol(self) -> str:
        """Name and symbol."""
        return f"{self.name} {self.symbol}".rstrip()

    def axis(self, scale: Scale) -> str:
        """Label of an axis: name, symbol and the unit of ``scale``."""
        return f"{self.with_symbol} [{scale.unit}]" if scale.unit else self.with_symbol


def label_of(key: str, case: SolvedCase) -> Label:
    """Name, symbol and unit of a varied key or of a value of the summary."""
    inner = _counted_from_1(key.removeprefix("inputs.")) if key.startswith("inputs.") else key
    if isinstance(case, AxleCase) and inner.startswith("drive."):
        inner = f"axle.{inner}"
    result, entry = key_of(result_keys(case), key), input_of(inner) or input_of(_list_of(inner))
    # A number of the case that is in the summary, too, is the input.
    if result is not None and (entry is None or (result.label and kind_of(inner) is None)):
        bound = result.bound if _bounds(case) else ""
        replaced_by = successors(result_keys(case)).get(key, "") if result.successor else ""
        return Label(result.label or key, result.symbol, result.unit, bound, result.shown, replaced_by)
    end = _place(end_and_key(inner)[0])
    if entry is None:
        return Label(key, "", "" if inner == key else unit_of(inner))
    name = f"{entry.label}, {end}" if end else entry.label
    return Label(name, entry.symbol, entry.unit, shown="°C" if entry.absolute else entry.shown)


def _place(end: str) -> str:
    """Words for the bearing of a drive, or for a part of an axle, before a key.

    Examples
    --------
    >>> _place("drive_end"), _place("bearing.rotor"), _place("mesh.1"), _place("mesh.*"), _place("")
    ('drive end', 'bearings of rotor', 'mesh 1', 'all meshes', '')
    """
    kind, _, name = end.partition(".")
    if name == "*":
        return {"bearing": "all bearings", "mesh": "all meshes"}[kind]
    words = {"bearing": f"bearings of {name}"}
    return words.get(kind, f"{kind} {name}") if name else NAMES_OF_ENDS.get(end, "")


def _list_of(key: str) -> str:
    """Key of the list that a number of a dotted key counts; the key itself if it does not end in a number."""
    head, _, number = key.rpartition(".")
    return head if number.isdecimal() else key


def _bounds(case: SolvedCase) -> bool:
    """Whether the films of a case are upper bounds; films of a bearing with heat are best estimates."""
    match case:
        case BearingCase():
            return case.bearing.bounding
        case DriveCase():
            return any(at.bearing.bounding for at in case.bearings)
        case GearCase() | AxleCase():
            return False
        case _:
            return True


def _counted_from_1(key: str) -> str:
    """Key of an input from its key in the summary, whose rough surfaces are counted from zero."""
    table, _, rest = key.partition(".")
    number, dot, name = rest.partition(".")
    return f"{table}.{int(number) + 1}.{name}" if table == "roughness" and dot and number.isdecimal() else key


def result_keys(case: SolvedCase) -> Keys:
    """Documented keys of the summary of a case. Returns keys of a line or point contact, stationary or
    transient, of a bearing, of a drive, of an axle or of a gear pair.
    """
    if isinstance(case, BearingCase):
        return BEARING_KEYS
    if isinstance(case, DriveCase):
        return DRIVE_KEYS
    if isinstance(case, GearCase):
        return GEAR_KEYS
    if isinstance(case, AxleCase):
        return _axle_keys(case)
    return (CONTACT_KEYS if case.motion is None else MOTION_KEYS)[case.contact.geometry]


def _axle_keys(case: AxleCase) -> Keys:
    """Documented keys of the points of an axle: the rows of its elements and shafts have their keys."""
    named = {
        **{f"elements.{key}": (AXLE_ELEMENT_KEYS, name) for key, name in case.keys_of_elements().items()},
        **{f"shafts.{key}": (AXLE_SHAFT_KEYS, name) for key, name in case.keys_of_shafts().items()},
    }
    rows = {
        f"{table}.{key}": replace(quantity, label=f"{quantity.label}, {name}")
        for table, (keys, name) in named.items()
        for key, quantity in keys.items()
    }
    return {**AXLE_KEYS, **rows}
