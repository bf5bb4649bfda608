"""Warnings of a solved bearing: films, voltages, clearance, shoulders, and single contacts."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from operator import mul

import numpy as np

from ehlectric.bearing.bearing_discharges import (
    breakdown_of,
    current_warnings,
    film_voltage,
    leakage_warnings,
    shaft_voltage,
    strength_per_volt,
)
from ehlectric.bearing.bearing_touching import duty_of, time_text
from ehlectric.bearing.film_factor import film_note, supply_warnings
from ehlectric.bearing.impedance import shaft_path
from ehlectric.bearing.mounted_clearance import class_warnings, fit_warnings
from ehlectric.bearing.preparation import TAKEN, groove_ratio, shoulder_angle
from ehlectric.bearing.quick_contacts import is_quick
from ehlectric.bearing.ring_contacts import ContactSolution
from ehlectric.bearing.solution import (
    BearingSolution,
    Position,
    capacitance_is_bound,
    error_text,
    insulating,
    lambda_text,
    lubrication,
    with_light,
)
from ehlectric.cases import library
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.cases.bearing_inputs import ROLLERS, Bearing
from ehlectric.cases.case_oil import Lubricant, viscosity_over_temperature
from ehlectric.cases.oil_inputs import OilTemperature
from ehlectric.discharge.discharge_laws import known
from ehlectric.discharge.film_breakdown import field_warnings, strength_warnings
from ehlectric.discharge.film_verdict import breakdown_warning
from ehlectric.errors import ResultWarning
from ehlectric.lubricant.data_sheet import GRADE_WIDTH, LEAST_AT_100, viscosity_index
from ehlectric.quantities.units import rpm

# Speed factor n d_m, rotational speed times pitch diameter, above which a bearing needs a special design
# [mm/min]. Catalogues state limiting speeds near half of it to all of it for oil lubrication.
_MOST_SPEED = 1e6

# Temperatures that bearing steel, stabilised for 200 degC at most, and ordinary oils stand [degC].
_COLDEST, _HOTTEST = -40.0, 200.0

# Load, as a part of the static load rating, below which a unit is probably wrong: makers state minimum loads
# of about a hundredth of the rating.
_LEAST_LOAD = 1e-3

# Viscosity above which an oil is near its pour point [Pa s].
_MOST_VISCOUS = 10.0

# Temperature below which the viscosity, extrapolated from 40 and 100 degC, may be far off [K].
_COLD = 273.15


def bearing_warnings(solution: BearingSolution) -> list[ResultWarning]:
    """Warnings that tell where the result of a bearing is unreliable, each once."""
    inputs = input_warnings(solution.case, solution.conditions.oil.viscosity)
    warnings = [
        *inputs,
        *film_warnings(solution),
        *voltage_warnings(solution),
        *edge_warnings(solution.case.bearing, solution.positions),
        *contact_warnings(
            {"inner": with_light(solution.inner_curve), "outer": with_light(solution.outer_curve)}
        ),
    ]
    return list(dict.fromkeys(warnings))


def film_warnings(solution: BearingSolution) -> Iterator[ResultWarning]:
    """Warnings of the films of a whole bearing: how they are computed, oil, temperature and clearance."""
    contacts = solution.case.contacts
    if is_quick(solution.case):
        code = "formula-contacts" if contacts == "formula" else "atlas-contacts"
        yield ResultWarning.of(code, "bearing", error=error_text(solution))
    yield film_note(solution)
    yield from supply_warnings(solution)
    of_base = library_viscosity(solution.case.lubricant)
    if of_base is not None:
        at = f"{solution.case.bearing.oil_temperature - 273.15:.4g} °C"
        base = solution.case.lubricant.base
        yield ResultWarning.of("viscosity-of-base", viscosity=1e3 * of_base, base=base, temperature=at)
    elif viscosity_over_temperature(solution.case.lubricant) is None:
        given = [f"bearing.{key}" for key in solution.case.bearing.temperatures()]
        yield ResultWarning.of(
            "temperature-unused",
            "bearing",
            temperatures=" and ".join(given),
            are="is" if len(given) == 1 else "are",
        )
    elif solution.case.lubricant.temperature_range is None:
        yield from _cold(solution.case.bearing)
    yield from fit_warnings(solution.conditions.clearance)
    yield from clearance_warnings(solution.conditions.geometry.clearance, solution.positions[0])


def _cold(bearing: Bearing) -> Iterator[ResultWarning]:
    """Warnings of temperatures at which the viscosity is extrapolated far."""
    for key, temperature in bearing.temperatures().items():
        if temperature < _COLD:
            yield ResultWarning.of("temperature-low", key=key, celsius=temperature - 273.15)


def library_viscosity(oil: Lubricant) -> float | None:
    """Viscosity of a lubricant [Pa s] if it is the one that its base has in the library, else None."""
    if oil.temperature is not None or oil.base is None:
        return None
    if "viscosity" not in library.lubricant(oil.base):
        return None
    of_base = Lubricant.from_dict(library.lubricant(oil.base)).viscosity
    return of_base if oil.viscosity == of_base else None


def input_warnings(case: BearingCase, viscosity: float) -> Iterator[ResultWarning]:
    """Warnings of inputs that a machine hardly has, and of inputs that stand for a range of values.
    ``viscosity``, dynamic viscosity of the oil at the temperature of the bearing [Pa s].
    """
    bearing = case.bearing
    turns, celsius = rpm(bearing.inner_speed), bearing.oil_temperature - 273.15
    factor = turns * 1e3 * bearing.pitch_diameter
    if factor > _MOST_SPEED:
        pitch = 1e3 * bearing.pitch_diameter
        yield ResultWarning.of("speed-high", speed=turns, pitch=pitch, factor=factor, limit=_MOST_SPEED)
    load, rating = math.hypot(bearing.radial_load, bearing.axial_load), _static_rating(bearing)
    if load < _LEAST_LOAD * rating:
        yield ResultWarning.of("load-low", load=load, rating=rating)
    for key, temperature in bearing.temperatures().items():
        if not _COLDEST <= temperature - 273.15 <= _HOTTEST:
            yield ResultWarning.of(
                "temperature-extreme",
                key=key,
                celsius=temperature - 273.15,
                coldest=_COLDEST,
                hottest=_HOTTEST,
            )
    if viscosity > _MOST_VISCOUS:
        yield ResultWarning.of("viscosity-high", viscosity=viscosity, celsius=celsius, limit=_MOST_VISCOUS)
    yield from class_warnings(bearing)
    oil = case.lubricant.temperature
    if oil is not None and oil.iso_vg is not None:
        low, high = (1e6 * oil.at_40() * (1.0 + part) for part in (-GRADE_WIDTH, GRADE_WIDTH))
        yield ResultWarning.of("viscosity-grade", grade=oil.iso_vg, low=low, high=high, index=_index_of(oil))


def _index_of(oil: OilTemperature) -> str:
    """Viscosity index of a grade with a given viscosity at 100 degC, in words; empty without one."""
    if oil.kinematic_viscosity_100 is None or 1e6 * oil.at_100() < LEAST_AT_100:
        return ""
    given = f"{1e6 * oil.kinematic_viscosity_100:.4g} mm²/s at 100 °C"
    return f"; with {given} its viscosity index is {viscosity_index(oil.at_40(), oil.at_100()):.0f}"


def _static_rating(bearing: Bearing) -> float:
    """Static load rating of a row of elements by ISO 76 [N], for typical ratios of diameters.

    A radial row of Z balls of diameter D carries 13 Z D^2, and one of rollers of length L 40 Z D L, in N and
    mm. The factor of balls, f0 of the standard, is 12.4 to 15.7 for diameters up to 0.35 of the pitch
    diameter; that of rollers, 44 (1 - D/d_m), is 33 to 42.
    """
    diameter, length = 1e3 * bearing.element_diameter, 1e3 * (bearing.roller_length or 0.0)
    each = 40.0 * diameter * length if bearing.kind == ROLLERS else 13.0 * diameter**2
    return bearing.elements * each


def voltage_warnings(solution: BearingSolution) -> Iterator[ResultWarning]:
    """Warnings of the capacitance and the voltages of a bearing: lubrication, ceramics, Weibull strength."""
    yield from _contact_of_asperities(solution)
    if capacitance_is_bound(solution):
        yield ResultWarning.of("capacitance-bound")
    breakdown, shaft, per_volt = breakdown_of(solution), shaft_voltage(solution), strength_per_volt(solution)
    field = known(mul, film_voltage(solution), per_volt)
    first = None if breakdown is None else breakdown.shaft_first_break
    if first is not None and shaft is not None and first < shaft and solution.converged:
        at = f"first breakdown at {first:.3g} V"
        ratio = first / shaft
        scattered = solution.case.discharge.weibull is not None
        yield breakdown_warning("shaft voltage", shaft, at, ratio, field=None if scattered else field)
    if solution.converged:
        yield from strength_warnings(solution.conditions.discharge)
        yield from field_warnings(field, "the motor")
    yield from _coating_warnings(solution, shaft)
    yield from leakage_warnings(solution)
    yield from current_warnings(solution)
    if solution.case.discharge.weibull is not None and insulating(solution):
        yield ResultWarning.of("weibull-voltage")


def _coating_warnings(solution: BearingSolution, shaft: float | None) -> Iterator[ResultWarning]:
    """Warnings of a coating: assumed values, and a shaft voltage [V] that breaks it down.

    The coating breaks down alone after the films have broken down.
    """
    coating = solution.case.bearing.coating
    assumed = {} if coating is None else coating.assumed
    if coating is not None and assumed:
        shown = {"thickness": f"{1e6 * coating.thickness:.4g} µm"}
        values = ", ".join(f"{key} {shown.get(key, f'{value:.4g}')}" for key, value in assumed.items())
        yield ResultWarning.of("coating-assumed", coating=coating.base, values=values)
    withstands = shaft_path(solution).coating_breakdown
    if withstands is not None and shaft is not None and withstands < shaft:
        yield ResultWarning.of("coating-breakdown", withstands=withstands, shaft=shaft)


def _contact_of_asperities(solution: BearingSolution) -> Iterator[ResultWarning]:
    """Warning of surfaces that touch all or some of the time."""
    state, ceramic = lubrication(solution), solution.conditions.ceramic
    ratio = lambda_text(solution)
    if state == "conducting":
        yield ResultWarning.of("touching", "steel", ratio=ratio)
    elif state == "touching":
        yield ResultWarning.of("touching", "ceramic", ratio=ratio)
    elif state == "partial film" and ceramic:
        yield ResultWarning.of("partial-film", "ceramic", ratio=ratio)
    else:
        duty = duty_of(solution)
        if state == "partial film" or duty.regime != "capacitive":
            share = time_text(duty.touching_time_share)
            yield ResultWarning.of("partial-film", "steel", ratio=ratio, share=share)


def edge_warnings(bearing: Bearing, positions: Sequence[Position]) -> Iterator[ResultWarning]:
    """Warnings of contact ellipses that reach over the shoulder of a groove, at most one per ring.

    Of the contacts that reach over, the warning names the one with the largest load.
    """
    for k, name in enumerate(("inner", "outer")):
        shoulder = shoulder_angle(bearing, inner=k == 0)
        groove = groove_ratio(bearing, inner=k == 0) * bearing.element_diameter
        load, reached = 0.0, 0.0
        for position in positions:
            ring, angle = position.rings[k], position.equilibrium.ring(inner=k == 0).angle
            ends = np.abs(angle) + ring.values.semi_axis_y / groove
            over = np.where(ends > shoulder, ring.load, 0.0)
            heaviest = int(np.argmax(over))
            if over[heaviest] > load:
                load, reached = float(over[heaviest]), float(ends[heaviest])
        if load > 0.0:
            yield ResultWarning.of(
                "shoulder-reached",
                ring=name,
                load=load,
                reached=math.degrees(reached),
                shoulder=math.degrees(shoulder),
            )


def clearance_warnings(clearance: float, position: Position) -> Iterator[ResultWarning]:
    """Warnings of films that take up much of the clearance, an effect that the equilibrium neglects.
    ``clearance``, radial internal clearance, the full diametral play [m]; negative with a preload.
    """
    at, room = position.equilibrium, clearance
    most = int(np.argmax(at.inner_load))
    films = sum(float(ring.values.central_thickness[most]) for ring in position.rings)
    compared = "a clearance of"
    if room <= 0.0:
        # Preloaded elements have no clearance: the films are compared with the elastic approach.
        room, compared = float(at.inner_approach[most] + at.outer_approach[most]), "an elastic approach of"
    if films > TAKEN * room:
        yield ResultWarning.of("clearance-taken-up", films=1e6 * films, compared=compared, room=1e6 * room)


def contact_warnings(rings: Mapping[str, Sequence[ContactSolution]]) -> list[ResultWarning]:
    """Warnings of the contacts of a bearing; equal warnings of several contacts become one."""
    loads_by_ring: dict[ResultWarning, dict[str, list[float]]] = {}
    for ring, contacts in rings.items():
        for contact in contacts:
            for warning in dict.fromkeys(contact.warnings):
                loads_by_ring.setdefault(warning, {}).setdefault(ring, []).append(contact.load)
    every = sum(map(len, rings.values()))
    return [
        warning
        if sum(map(len, by_ring.values())) == every
        else ResultWarning(
            warning.code, ", ".join(_named(ring, loads) for ring, loads in by_ring.items()) + f": {warning}"
        )
        for warning, by_ring in loads_by_ring.items()
    ]


def _named(ring: str, loads: Sequence[float]) -> str:
    """Text that names one or several contacts with a ring by their loads [N].

    Examples
    --------
    >>> _named("inner", [800.0]), _named("outer", [20.0, 40.0, 80.0])
    ('inner contact at 800 N', '3 outer contacts at 20 to 80 N')
    """
    if len(loads) == 1:
        return f"{ring} contact at {loads[0]:.4g} N"
    return f"{len(loads)} {ring} contacts at {min(loads):.4g} to {max(loads):.4g} N"
