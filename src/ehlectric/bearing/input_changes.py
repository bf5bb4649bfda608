"""Ranges of the inputs of a bearing: those of its file, and the usual ones of the others."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from ehlectric.arrays import Numbers
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.cases.bearing_inputs import Bearing
from ehlectric.cases.case_oil import depends_on_temperature
from ehlectric.cases.input_keys import input_of
from ehlectric.cases.library.bearing_catalogue import clearance_range
from ehlectric.discharge.film_verdict import STRENGTH_UNKNOWN
from ehlectric.lubricant.data_sheet import GRADE_WIDTH
from ehlectric.quantities.rows import value_at

# Changes of the inputs, either way: load relative to its value, temperature [K], clearance [m] and free
# contact angle [rad], and these two relative to their value where they are small. Engineering judgement: what
# is seldom known better in a machine.
LOAD, TEMPERATURE, CLEARANCE, ANGLE, RELATIVE = 0.2, 10.0, 5e-6, math.radians(5.0), 0.5

# Relative change of the capacitances of the motor, which data sheets do not have and few users measure.
MOTOR = 0.5

# Input that an ISO viscosity grade stands for.
_AT_40 = "lubricant.temperature.kinematic_viscosity_40"

# Inputs that scale a dielectric strength, and the list of strengths of a table, which a factor scales. Every
# breakdown voltage is proportional to the strength.
STRENGTHS = ("discharge.dielectric_strength", "discharge.weibull.scale")
OF_TABLE = "discharge.strength_table.strength"

# Reasons of the usual ranges.
_JUDGED = "engineering judgement: "
_OF_STRENGTH = _JUDGED + "the strength of films is seldom measured"
_OF_TEMPERATURE = _JUDGED + "the temperature in the contacts is seldom measured"
_OF_GRADE = "limits of the viscosity grade, ISO 3448"
_OF_CLASS = "limits of the clearance class, ISO 5753-1"
_OF_CLEARANCE = _JUDGED + "fits and warm rings change the clearance"
_OF_ANGLE = _JUDGED + "makers state nominal contact angles"
_OF_LOAD = _JUDGED + "loads in operation differ from those of the design"
_OF_MOTOR = _JUDGED + "data sheets do not have it, and few measure it"


@dataclass(frozen=True)
class Change:
    """Two values of an input, and the changes of the case that make them.

    With ``factor_of_load`` both loads change in proportion; the inputs ``shift_of`` change by one step.
    """

    key: str
    label: str
    ends: tuple[float, float]
    reason: str = ""  # where a usual range comes from; empty for a range of the file
    factor_of_load: bool = False
    shift_of: tuple[str, ...] = ()

    def value(self, case: BearingCase) -> float:
        """Value of the input in a case, SI units; 1 for a factor on a table."""
        return 1.0 if self.key == OF_TABLE else float(value_at(case.to_dict(), self.key))

    def changes(self, case: BearingCase, end: Numbers) -> dict[str, Any]:
        """Changed inputs of a case by key, at one value of this input or at many, shape (...)."""
        if self.shift_of:
            table = case.to_dict()
            step = end - value_at(table, self.key)
            return {key: value_at(table, key) + step for key in self.shift_of}
        if not self.factor_of_load:
            return {self.key: end}
        bearing, factor = case.bearing, end / value_at(case.to_dict(), self.key)
        loads = {"bearing.radial_load": bearing.radial_load, "bearing.axial_load": bearing.axial_load}
        return {key: factor * load for key, load in loads.items() if load}


def changes_of(case: BearingCase) -> tuple[Change, ...]:
    """Changes of all inputs that are uncertain, each once: a range of the file replaces the usual one."""
    changes = {change.key: change for change in usual_changes(case, case.to_dict())}
    changes |= {one.key: Change(one.key, _label(one.key), (one.low, one.high)) for one in case.ranges or ()}
    return tuple(changes.values())


def proportional_to_strength(key: str) -> bool:
    """Whether a key scales the dielectric strength, so that every breakdown voltage is proportional to it."""
    return key == OF_TABLE or key in STRENGTHS


def temperature_is_unused(case: BearingCase) -> bool:
    """Whether the temperature has no effect: oil, strength and clearance do not depend on it."""
    strengths = case.discharge.strength_table
    over_temperature = strengths is not None and strengths.over == "temperature"
    constant = not depends_on_temperature(case.lubricant)
    return constant and not over_temperature and case.bearing.fits is None


def usual_changes(case: BearingCase, table: Mapping[str, Any]) -> Iterator[Change]:
    """Changes of strength, temperature, clearance or contact angle, load, and motor."""
    bearing = case.bearing
    for key in STRENGTHS:
        strength = value_at(table, key)
        if strength is not None:
            yield Change(key, _label(key), _part(strength, STRENGTH_UNKNOWN), _OF_STRENGTH)
    if case.discharge.strength_table is not None:
        yield Change(
            OF_TABLE, "factor on the dielectric strength", _part(1.0, STRENGTH_UNKNOWN), _OF_STRENGTH
        )
    if not temperature_is_unused(case):
        yield _temperature(bearing)
    oil = case.lubricant.temperature
    if oil is not None and oil.iso_vg is not None:
        label = f"{_label(_AT_40)} (limits of ISO VG {oil.iso_vg})"
        yield Change(_AT_40, label, _part(oil.at_40(), GRADE_WIDTH), _OF_GRADE)
    yield from _clearance(bearing)
    if bearing.contact_angle is not None:
        key = "bearing.contact_angle"
        yield Change(key, _label(key), _around(bearing.contact_angle, ANGLE), _OF_ANGLE)
    radial = bearing.radial_load >= bearing.axial_load
    load = bearing.radial_load if radial else bearing.axial_load
    both = min(bearing.radial_load, bearing.axial_load) > 0.0
    key = f"bearing.{'radial' if radial else 'axial'}_load"
    name = _label(key)
    yield Change(
        key,
        f"{name} ({'axial' if radial else 'radial'} in proportion)" if both else name,
        _part(load, LOAD),
        _OF_LOAD,
        factor_of_load=both,
    )
    for name in ("winding_rotor", "rotor_frame"):
        key = f"motor.{name}_capacitance"
        yield Change(key, _label(key), _part(value_at(table, key), MOTOR), _OF_MOTOR)


def _temperature(bearing: Bearing) -> Change:
    """Change of the temperature of the oil, and by the same step of all other parts that have their own."""
    keys = tuple(f"bearing.{key}" for key in bearing.all_temperatures())
    label = _label(keys[0]) + (" (of all other parts by the same)" if len(keys) > 1 else "")
    return Change(
        keys[0], label, _around(bearing.oil_temperature, TEMPERATURE), _OF_TEMPERATURE, shift_of=keys
    )


def _clearance(bearing: Bearing) -> Iterator[Change]:
    """Change of the clearance to the limits of its class, or by a step either way; none without one."""
    key, clearance = "bearing.fits.unmounted_clearance", bearing.unmounted_clearance
    if clearance is None:
        key, clearance = "bearing.radial_clearance", bearing.radial_clearance
    if clearance is None:
        return
    if bearing.clearance_class is None or bearing.bore is None:
        yield Change(key, _label(key), _around(clearance, CLEARANCE), _OF_CLEARANCE)
        return
    limits = clearance_range(bearing.kind, bearing.clearance_class, bearing.bore)
    label = f"{_label(key)} (limits of class {bearing.clearance_class})"
    yield Change(key, label, (limits.least, limits.most), _OF_CLASS)


def _part(value: float, part: float) -> tuple[float, float]:
    """Value less and plus a part of it."""
    return (1.0 - part) * value, (1.0 + part) * value


def _around(value: float, step: float) -> tuple[float, float]:
    """Value less and plus a step, or half of the value where a positive value would not stay positive."""
    if 0.0 < value <= step:
        step = RELATIVE * value
    return value - step, value + step


def _label(key: str) -> str:
    """Label of an input in the book; its dotted key if no file has it."""
    entry = input_of(key)
    return key if entry is None else entry.label
