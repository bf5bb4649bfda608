"""Effect of single inputs on the margin of a bearing."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from ehlectric.bearing.margin.quick_margins import QuickMargins
from ehlectric.cases.bearings.bearing import Bearing
from ehlectric.cases.bearings.case import BearingCase
from ehlectric.cases.input_keys import input_of
from ehlectric.cases.library.clearance import clearance_range
from ehlectric.cases.oils.resolution import depends_on_temperature
from ehlectric.discharge.verdict import STRENGTH_UNKNOWN
from ehlectric.errors import InputError
from ehlectric.lubricant.viscosity_index import GRADE_WIDTH
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
_STRENGTHS = ("discharge.dielectric_strength", "discharge.weibull.scale")
OF_TABLE = "discharge.strength_table.strength"


@dataclass(frozen=True)
class Effect:
    """Effect of one input on the margin, all others as in the case.

    Attributes
    ----------
    key : str
        Dotted key of the input; for the load that of the larger component, where both change together.
    label : str
        Name of the input.
    low_input, high_input : float
        Smaller and larger value of the input, SI units.
    low_margin, high_margin : float
        Margin at these values, dimensionless; 0 where the surfaces touch.
    """

    key: str
    label: str
    low_input: float
    high_input: float
    low_margin: float
    high_margin: float

    @property
    def size(self) -> float:
        """Size of the effect: logarithm of the ratio of both margins; infinite where one of them is 0."""
        low, high = sorted((self.low_margin, self.high_margin))
        return math.inf if low <= 0.0 else math.log(high / low)


@dataclass(frozen=True)
class _Change:
    """Two values of an input, and the changes of the case that make them.

    With ``factor_of_load`` both loads change in proportion; the inputs ``shift_of`` change by one step.
    """

    key: str
    label: str
    ends: tuple[float, float]
    factor_of_load: bool = False
    shift_of: tuple[str, ...] = ()

    def changes(self, case: BearingCase, end: float) -> dict[str, Any]:
        if self.shift_of:
            table = case.to_dict()
            step = end - value_at(table, self.key)
            return {key: value_at(table, key) + step for key in self.shift_of}
        if not self.factor_of_load:
            return {self.key: end}
        bearing, factor = case.bearing, end / value_at(case.to_dict(), self.key)
        loads = {"bearing.radial_load": bearing.radial_load, "bearing.axial_load": bearing.axial_load}
        return {key: factor * load for key, load in loads.items() if load}


def effects_of(margins: QuickMargins, margin: float) -> tuple[tuple[Effect, ...], tuple[str, ...]]:
    """Effects of strength, temperature, clearance, load and motor, and of all inputs that have a range.

    Parameters
    ----------
    margins : QuickMargins
        Margins of the bearing at changed inputs.
    margin : float
        Margin of the bearing, dimensionless.

    Returns
    -------
    effects : tuple of Effect
        The largest effect first. A range of the file replaces the change that is made without it.
    left_out : tuple of str
        Inputs whose effect has no result, and why.
    """
    case, effects, left_out = margins.case, [], []
    ranges = {one.key: (one.low, one.high) for one in case.ranges or ()}
    table = case.to_dict()
    if _temperature_is_unused(case):
        left_out.append("temperature: without effect, because lubricant.viscosity is given")
    for change in _changes(case, table, ranges):
        try:
            low, high = (_margin(margins, margin, table, change, end) for end in change.ends)
        except InputError as error:
            left_out.append(f"{change.label}: {error}")
        else:
            effects.append(Effect(change.key, change.label, *change.ends, low, high))
    effects.sort(key=lambda effect: -effect.size)
    return tuple(effects), tuple(left_out)


def _margin(
    margins: QuickMargins, margin: float, table: Mapping[str, Any], change: _Change, end: float
) -> float:
    """Margin with one changed input."""
    if change.key == OF_TABLE:
        return margin * end
    if change.key in _STRENGTHS:
        return margin * end / float(value_at(table, change.key))
    return margins.at(change.changes(margins.case, end)).margin


def _temperature_is_unused(case: BearingCase) -> bool:
    """Whether the temperature has no effect: oil, strength and clearance do not depend on it."""
    strengths = case.discharge.strength_table
    over_temperature = strengths is not None and strengths.over == "temperature"
    constant = not depends_on_temperature(case.lubricant)
    return constant and not over_temperature and case.bearing.fits is None


def _changes(
    case: BearingCase, table: Mapping[str, Any], ranges: Mapping[str, tuple[float, float]]
) -> Iterator[_Change]:
    """Changes of the inputs that the case has; a range takes the place of the change without it."""
    standard = {change.key: change for change in _standard(case, table)}
    for key in dict.fromkeys([*standard, *ranges]):
        if key in ranges:
            yield _Change(key, _label(key), ranges[key])
        else:
            yield standard[key]


def _standard(case: BearingCase, table: Mapping[str, Any]) -> Iterator[_Change]:
    """Changes of strength, temperature, clearance or contact angle, load, and motor."""
    bearing = case.bearing
    for key in _STRENGTHS:
        strength = value_at(table, key)
        if strength is not None:
            yield _Change(key, _label(key), _part(strength, STRENGTH_UNKNOWN))
    if case.discharge.strength_table is not None:
        yield _Change(OF_TABLE, "factor on the dielectric strength", _part(1.0, STRENGTH_UNKNOWN))
    if not _temperature_is_unused(case):
        yield _temperature(bearing)
    oil = case.lubricant.temperature
    if oil is not None and oil.iso_vg is not None:
        label = f"{_label(_AT_40)} (limits of ISO VG {oil.iso_vg})"
        yield _Change(_AT_40, label, _part(oil.at_40(), GRADE_WIDTH))
    if bearing.unmounted_clearance is not None:
        yield _Change("bearing.fits.unmounted_clearance", *_clearance(bearing, bearing.unmounted_clearance))
    elif bearing.radial_clearance is not None:
        yield _Change("bearing.radial_clearance", *_clearance(bearing, bearing.radial_clearance))
    if bearing.contact_angle is not None:
        key = "bearing.contact_angle"
        yield _Change(key, _label(key), _around(bearing.contact_angle, ANGLE))
    radial = bearing.radial_load >= bearing.axial_load
    load = bearing.radial_load if radial else bearing.axial_load
    both = min(bearing.radial_load, bearing.axial_load) > 0.0
    key = f"bearing.{'radial' if radial else 'axial'}_load"
    name = _label(key)
    yield _Change(
        key,
        f"{name} ({'axial' if radial else 'radial'} in proportion)" if both else name,
        _part(load, LOAD),
        factor_of_load=both,
    )
    for name in ("winding_rotor", "rotor_frame"):
        key = f"motor.{name}_capacitance"
        yield _Change(key, _label(key), _part(value_at(table, key), MOTOR))


def _temperature(bearing: Bearing) -> _Change:
    """Change of the temperature of the oil, and by the same step of all other parts that have their own."""
    keys = tuple(f"bearing.{key}" for key in bearing.all_temperatures())
    label = _label(keys[0]) + (" (of all other parts by the same)" if len(keys) > 1 else "")
    return _Change(keys[0], label, _around(bearing.oil_temperature, TEMPERATURE), shift_of=keys)


def _clearance(bearing: Bearing, clearance: float) -> tuple[str, tuple[float, float]]:
    """Name of the clearance [m] and its two values: those of its class, or a step either way."""
    name = _label("bearing.radial_clearance" if bearing.fits is None else "bearing.fits.unmounted_clearance")
    if bearing.clearance_class is None or bearing.bore is None:
        return name, _around(clearance, CLEARANCE)
    limits = clearance_range(bearing.kind, bearing.clearance_class, bearing.bore)
    return f"{name} (limits of class {bearing.clearance_class})", (limits.least, limits.most)


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
