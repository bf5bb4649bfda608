"""Input ranges of a bearing: ranges of its file, and the usual ranges for other inputs."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from ehlectric.arrays import Numbers
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.cases.bearing_inputs import Bearing
from ehlectric.cases.bearing_kinds import has_rollers
from ehlectric.cases.case_oil import Lubricant, depends_on_temperature
from ehlectric.cases.input_keys import input_of
from ehlectric.cases.input_ranges import InputRange
from ehlectric.cases.library.bearing_catalogue import clearance_range
from ehlectric.cases.library.estimated_bearings import (
    ESTIMATE_ERRORS,
    estimated_geometry,
    is_estimated,
    series,
)
from ehlectric.cases.table_edits import given_value
from ehlectric.discharge.breakdown_rule import STRENGTH_UNKNOWN
from ehlectric.lubricant.data_sheet import GRADE_WIDTH
from ehlectric.quantities.rows import value_at
from ehlectric.runtime.display import is_number

# Changes of the inputs, either way: load relative to its value, temperature [K], clearance [m] and free
# contact angle [rad], and these two relative to their value where they are small. Engineering judgement: what
# is seldom known better in a machine.
LOAD, TEMPERATURE, CLEARANCE, ANGLE, RELATIVE = 0.2, 10.0, 5e-6, math.radians(5.0), 0.5

# Change of the height of the summits, in units of the composite Rq. Contact is said to begin at lambda ratios
# from 1 to 3, and no case has higher summits than the last number.
SUMMITS, HIGHEST = 1.0, 6.0

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
_OF_LOAD = _JUDGED + "loads in operation differ from the design"
_OF_SUMMITS = "contact of run-in surfaces is said to begin at lambda ratios from 1 to 3; measured at 2"
_OF_ESTIMATE = "estimated from load ratings: error if known bearings are omitted"
_OF_MOTOR = _JUDGED + "data sheets do not have it, and few measure it"


@dataclass(frozen=True)
class Change:
    """Two values of an input of a case, and the changes of the case that make them."""

    key: str
    label: str
    value: float  # value of the input in the case, SI units; 1 for a factor on a table
    ends: tuple[float, float]  # smaller and larger value, SI units
    reason: str = ""  # where a usual range comes from; empty for a range of the file
    # Values in the case of inputs that change by one step, or in proportion: this one among them.
    shifted: Mapping[str, float] = field(default_factory=dict)
    scaled: Mapping[str, float] = field(default_factory=dict)

    def changes(self, end: Numbers) -> dict[str, Any]:
        """Changed inputs of the case by key, at one value of this input or at many, shape (...)."""
        if self.shifted:
            step = end - self.value
            return {key: value + step for key, value in self.shifted.items()}
        if self.scaled:
            factor = end / self.value
            return {key: factor * value for key, value in self.scaled.items()}
        return {self.key: end}


def changes_of(case: BearingCase) -> tuple[Change, ...]:
    """Changes of all inputs that are uncertain, each once: a range of the file replaces the usual one."""
    table = case.to_dict()
    changes = {change.key: change for change in usual_changes(case, table)}
    for entry in case.ranges or ():
        changes[entry.key] = stated_change(table, entry)
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
    """Changes of strength, temperature, clearance or contact angle, load, geometry, summits, and motor."""
    bearing = case.bearing
    yield from strength_changes(table)
    if not temperature_is_unused(case):
        yield _temperature(bearing)
    yield from grade_changes(case.lubricant)
    yield from clearance_change(bearing)
    # Cones of tapered rollers are ground to their angle; the angle of balls also follows from their
    # clearance.
    if bearing.contact_angle is not None and not has_rollers(bearing.kind):
        key, angle = "bearing.contact_angle", bearing.contact_angle
        yield Change(key, label_of(key), angle, _around(angle, ANGLE), _OF_ANGLE)
    yield _load(bearing)
    yield from _geometry(bearing)
    yield from summit_changes("bearing.summit_height", bearing.summit_height)
    for name in ("winding_rotor", "rotor_frame"):
        key = f"motor.{name}_capacitance"
        capacitance = value_at(table, key)
        if capacitance is not None:
            yield Change(key, label_of(key), capacitance, _part(capacitance, MOTOR), _OF_MOTOR)


def strength_changes(table: Mapping[str, Any]) -> Iterator[Change]:
    """Changes of the dielectric strength of a case with the given tables."""
    for key in STRENGTHS:
        strength = value_at(table, key)
        if strength is not None:
            yield Change(key, label_of(key), strength, _part(strength, STRENGTH_UNKNOWN), _OF_STRENGTH)
    if value_at(table, "discharge.strength_table") is not None:
        label = "factor on the dielectric strength"
        yield Change(OF_TABLE, label, 1.0, _part(1.0, STRENGTH_UNKNOWN), _OF_STRENGTH)


def grade_changes(lubricant: Lubricant) -> Iterator[Change]:
    """Change of the viscosity at 40 degC within the limits of a viscosity grade; none without one."""
    oil = lubricant.temperature
    if oil is not None and oil.iso_vg is not None:
        label = f"{label_of(_AT_40)} (limits of ISO VG {oil.iso_vg})"
        at_40 = oil.at_40()
        yield Change(_AT_40, label, float(at_40), _part(float(at_40), GRADE_WIDTH), _OF_GRADE)


def summit_changes(key: str, height: float) -> Iterator[Change]:
    """Change of the height of summits, divided by the composite Rq; none of smooth films."""
    if height > 0.0:
        # Smooth films, of a height of 0, are asked for as a bound.
        low, high = _around(height, SUMMITS)
        yield Change(key, label_of(key), height, (low, min(high, HIGHEST)), _OF_SUMMITS)


def load_change(key: str, value: float) -> Change:
    """Change of a load that is larger than 0."""
    return Change(key, label_of(key), value, _part(value, LOAD), _OF_LOAD)


def temperature_change(key: str, value: float) -> Change:
    """Change of a temperature."""
    return Change(key, label_of(key), value, _around(value, TEMPERATURE), _OF_TEMPERATURE)


def stated_change(table: Mapping[str, Any], entry: InputRange) -> Change:
    """Change of an input of a case with the given tables to the ends of its range in the file."""
    value = float(given_value(table, entry.key))
    return Change(entry.key, label_of(entry.key), value, (entry.low, entry.high))


def _load(bearing: Bearing) -> Change:
    """Change of the larger component of the load, and of the other one in proportion."""
    loads = {"radial": bearing.radial_load, "axial": bearing.axial_load}
    # Of equal components the first one.
    larger = max(loads, key=loads.__getitem__)
    both = {f"bearing.{name}_load": load for name, load in loads.items() if load}
    key, value = f"bearing.{larger}_load", loads[larger]
    change = load_change(key, value)
    if len(both) < 2:
        return change
    other = "axial" if larger == "radial" else "radial"
    return replace(change, label=f"{change.label} ({other} in proportion)", scaled=both)


def _temperature(bearing: Bearing) -> Change:
    """Change of the temperature of the oil, and by the same step of all other parts that have their own."""
    known = {f"bearing.{name}": value for name, value in bearing.all_temperatures().items()}
    change = temperature_change(*next(iter(known.items())))
    label = change.label + (" (of all other parts by the same step)" if len(known) > 1 else "")
    return replace(change, label=label, shifted=known)


def clearance_change(bearing: Bearing) -> Iterator[Change]:
    """Change of the clearance to the limits of its class, or by a step either way; none without one."""
    key, clearance = "bearing.fits.unmounted_clearance", bearing.unmounted_clearance
    if clearance is None:
        key, clearance = "bearing.radial_clearance", bearing.radial_clearance
    if clearance is None:
        return
    if bearing.clearance_class is None or bearing.bore is None:
        yield Change(key, label_of(key), clearance, _around(clearance, CLEARANCE), _OF_CLEARANCE)
        return
    limits = clearance_range(bearing.kind, bearing.clearance_class, bearing.bore)
    label = f"{label_of(key)} (limits of class {bearing.clearance_class})"
    yield Change(key, label, clearance, (limits.least, limits.most), _OF_CLASS)


# Largest part of the distance of two elements on their pitch circle that an element fills.
_FILLED = 0.99


def _geometry(bearing: Bearing) -> Iterator[Change]:
    """Changes of an estimated geometry by its error; none of dimensions that a file gives."""
    for name in estimated_keys(bearing):
        key, value = f"bearing.{name}", getattr(bearing, name)
        low, high = _part(value, getattr(ESTIMATE_ERRORS[bearing.kind], name))
        if name == "element_diameter":
            pitch = (1.0 - ESTIMATE_ERRORS[bearing.kind].pitch_diameter) * bearing.pitch_diameter
            high = max(min(high, _FILLED * pitch * math.sin(math.pi / bearing.elements)), value)
        # The raceway under needles is known, so that their pitch circle follows their diameter.
        both = ("element_diameter", "pitch_diameter") if name == "element_diameter" else ()
        known = {
            f"bearing.{name}": getattr(bearing, name) for name in both if bearing.kind == "needle roller"
        }
        yield Change(key, label_of(key), value, (low, high), _OF_ESTIMATE, shifted=known)


def estimated_keys(bearing: Bearing) -> tuple[str, ...]:
    """Keys of a bearing whose values are estimated with an error, as neither file nor library has them."""
    if bearing.base is None or not is_estimated(bearing.base):
        return ()
    given = (
        (None, None) if bearing.life is None else (bearing.life.dynamic_rating, bearing.life.static_rating)
    )
    estimate = estimated_geometry(series()[bearing.base], *(x if is_number(x) else None for x in given))
    error = ESTIMATE_ERRORS[bearing.kind]
    return tuple(
        name
        for name in ("element_diameter", "pitch_diameter", "roller_length")
        if getattr(error, name)
        and np.allclose(getattr(bearing, name), getattr(estimate, name), rtol=1e-9, atol=0.0)
    )


def _part(value: float, part: float) -> tuple[float, float]:
    """Value less and plus a part of it."""
    return (1.0 - part) * value, (1.0 + part) * value


def _around(value: float, step: float) -> tuple[float, float]:
    """Value less and plus a step, or half of the value where a positive value would not stay positive."""
    if 0.0 < value <= step:
        step = RELATIVE * value
    return value - step, value + step


def label_of(key: str) -> str:
    """Label of an input in the book; its dotted key if no file has it."""
    entry = input_of(key)
    return key if entry is None else entry.label
