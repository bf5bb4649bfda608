"""Warnings of a solved bearing: films, voltages, clearance, shoulders, and single contacts."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from functools import partial
from operator import mul, truediv

import numpy as np

from ehlectric.arrays import Array, Mask, Numbers, where
from ehlectric.bearing.bearing_discharges import (
    breakdown_of,
    current_warning_conditions,
    film_voltage,
    leakage_warning_conditions,
    shaft_voltage,
    strength_per_volt,
)
from ehlectric.bearing.bearing_touching import BearingDuty, duty_of
from ehlectric.bearing.film_factor import conductivity_warning_condition, film_note, supply_warning_conditions
from ehlectric.bearing.impedance import shaft_path
from ehlectric.bearing.mounted_clearance import class_warning_conditions, fit_warning_conditions
from ehlectric.bearing.preparation import TAKEN, groove_ratio, shoulder_angle
from ehlectric.bearing.rating_life import dynamic_rating, life_warning_conditions
from ehlectric.bearing.ring_contacts import ContactSolution
from ehlectric.bearing.solution import (
    BearingSolution,
    Position,
    RingState,
    bearing_state,
    capacitance_is_bound,
    conducts,
    error_text,
    insulating,
    lambda_text,
    with_light,
)
from ehlectric.bearing.uncertain_inputs import estimated_keys
from ehlectric.cases import library
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.cases.bearing_inputs import Bearing
from ehlectric.cases.bearing_kinds import KINDS_OF_BEARINGS, has_rollers
from ehlectric.cases.case_oil import Lubricant, viscosity_over_temperature
from ehlectric.cases.coating_inputs import Coating
from ehlectric.cases.film_inputs import shear_unused
from ehlectric.cases.library.designations import parts_of, seals_of
from ehlectric.cases.library.estimated_bearings import WITHOUT_KNOWN
from ehlectric.cases.library.printed_ratings import printed_ratings
from ehlectric.cases.oil_inputs import OilTemperature
from ehlectric.cases.plausibility import (
    PLAUSIBLE,
    extreme,
    oil_doubts,
    rq_warning_condition,
    unusual,
    unusual_machine,
)
from ehlectric.contact import PERMANENT
from ehlectric.discharge.discharge_laws import known, known_of
from ehlectric.discharge.film_breakdown import field_warning_conditions, strength_warning_conditions
from ehlectric.discharge.film_verdict import breakdown_warning_condition
from ehlectric.lubricant.data_sheet import GRADE_WIDTH, LEAST_AT_100, viscosity_index
from ehlectric.quantities.formats import CELSIUS, time_share_text
from ehlectric.quantities.lubrication_states import BOUNDARY, FREQUENT, MIXED
from ehlectric.quantities.result_warnings import ResultWarning, WarningCondition, active
from ehlectric.quantities.units import rpm
from ehlectric.readable import readable

# Largest speed factor n d_m [mm/min] of bearings with a contact angle of 40 degrees, of the source of
# ``KINDS_OF_BEARINGS``, whose values hold at 15 degrees and below.
_STEEP, _SPEED_STEEP, _FLAT = math.radians(40.0), 6.5e5, math.radians(15.0)

# Minimum load of balls and of rollers divided by the dynamic load rating. SKF, Rolling bearings, "requisite
# minimum load": a general rule of thumb.
_MINIMUM_LOAD = {"ball": 0.01, "roller": 0.02}

# Load, as a part of the static load rating, below which a unit is probably wrong: makers state minimum loads
# of about a hundredth of the rating.
_LEAST_LOAD = 1e-3

# Viscosity above which an oil is near its pour point [Pa s].
_MOST_VISCOUS = PLAUSIBLE["viscosity"].high

# Temperature below which the viscosity, extrapolated from 40 and 100 degC, may be far off [degC].
_COLD = 0.0


def bearing_warnings(solution: BearingSolution) -> list[ResultWarning]:
    """Warnings about where the result of a bearing is unreliable, each once."""
    warnings = [
        *active(warning_conditions(solution)),
        *contact_warnings(dict(zip(("inner", "outer"), with_light(solution.curves), strict=True))),
    ]
    return list(dict.fromkeys(warnings))


def warning_conditions(solution: BearingSolution) -> Iterator[WarningCondition]:
    """Conditions of the warnings of a whole bearing, at one or many points; without the warnings of its
    contacts.
    """
    oil = solution.conditions.oil
    yield from input_warning_conditions(solution.case, oil.viscosity)
    yield from (
        condition for condition in oil_doubts(oil) if condition.values["name"] != PLAUSIBLE["viscosity"].name
    )
    yield from unusual("viscosity", np.minimum(oil.viscosity, _MOST_VISCOUS))
    mounted = solution.conditions.clearance
    given = solution.case.bearing.radial_clearance
    yield from unusual("clearance", given if mounted is None else mounted.running.clearance)
    yield from film_warning_conditions(solution)
    yield from voltage_warning_conditions(solution)
    yield from edge_warning_conditions(solution)


def codes_of(solution: BearingSolution) -> Iterator[tuple[str, Mask]]:
    """Codes of the warnings of many points with estimated contacts, and the points that have them, shape
    (...).
    """
    yield from ((condition.code, condition.where) for condition in warning_conditions(solution))
    yield from _contact_codes(solution)


def _contact_codes(solution: BearingSolution) -> Iterator[tuple[str, Mask]]:
    """Yield warning codes for estimated contacts at many points, and the points that have them, shape (...):
    contacts outside the atlas, pressures that deform steel, and oil laws beyond their range.

    The texts of a single bearing name the contacts; see ``contact_warnings``.
    """
    permanent = PERMANENT["line" if has_rollers(solution.case.bearing.kind) else "point"]
    for ring, curve in zip((solution.inner, solution.outer), solution.curves, strict=True):
        if curve.left is not None:
            heavy, left = curve.counted.used, curve.left & curve.used
            yield "atlas-left", np.any(left & heavy, axis=-1)
            yield "atlas-left-light", np.any(left & ~heavy, axis=-1)
        pressure = np.max(curve.values.max_pressure, axis=-1)
        yield "plastic-deformation", pressure > permanent
        yield from ring.oil.codes(pressure)


def film_warning_conditions(solution: BearingSolution) -> Iterator[WarningCondition]:
    """Warnings of the films of a whole bearing: how they are computed, oil, temperature and clearance."""
    case, error = solution.case, partial(error_text, solution)
    yield WarningCondition.of(case.contacts == "formula", "formula-contacts", "bearing", error=error)
    yield WarningCondition.of(case.contacts == "atlas", "atlas-contacts", "bearing", error=error)
    yield from film_note(solution)
    yield conductivity_warning_condition(solution)
    yield from supply_warning_conditions(solution)
    base, follows = library_viscosity(case.lubricant), viscosity_over_temperature(case.lubricant) is not None
    is_typed = base is None or np.isnan(base)
    yield WarningCondition.of(
        np.logical_not(is_typed),
        "viscosity-of-base",
        viscosity=known(mul, 1e3, base),
        base=case.lubricant.base,
        temperature=lambda: CELSIUS.text(case.bearing.oil_temperature),
    )
    constants = shear_unused(case.lubricant)
    yield WarningCondition.of(
        bool(constants),
        "shear-constant-unused",
        "machine",
        names=" and ".join(constants),
        are="are" if len(constants) > 1 else "is",
    )
    given_pressure = Lubricant.model_fields["ambient_pressure"].default
    yield WarningCondition.of(
        np.not_equal(case.lubricant.ambient_pressure, given_pressure), "key-unused", "ambient"
    )
    given = [f"bearing.{key}" for key in case.bearing.temperatures()]
    yield WarningCondition.of(
        np.logical_and(is_typed, not follows),
        "temperature-unused",
        "bearing",
        temperatures=" and ".join(given),
        are="is" if len(given) == 1 else "are",
    )
    if follows and case.lubricant.temperature_range is None:
        for key, temperature in case.bearing.temperatures().items():
            # The viscosity is extrapolated far.
            celsius = CELSIUS.of(temperature)
            yield WarningCondition.of(
                np.logical_and(is_typed, celsius < _COLD), "temperature-low", key=key, celsius=celsius
            )
    yield from fit_warning_conditions(solution.conditions.clearance)
    geometry = solution.conditions.geometry
    if not geometry.follows_films:
        yield clearance_warning_condition(geometry.room, solution.positions[0])


def library_viscosity(oil: Lubricant) -> Numbers | None:
    """Viscosity of a lubricant [Pa s] if it is the one that its base has in the library, shape (...).

    Otherwise it is None, and NaN at one of many points.
    """
    if oil.temperature is not None or oil.base is None:
        return None
    if "viscosity" not in library.lubricant(oil.base):
        return None
    of_base = Lubricant.from_dict(library.lubricant(oil.base)).viscosity
    assert of_base is not None
    return where(oil.viscosity == of_base, of_base)


def input_warning_conditions(case: BearingCase, viscosity: Numbers) -> Iterator[WarningCondition]:
    """Warnings of inputs that are unusual for a machine, and of inputs that stand for a range of values.
    ``viscosity``, dynamic viscosity of the oil at the temperature of the bearing [Pa s], shape (...).
    """
    bearing = case.bearing
    turns, celsius, pitch = (
        rpm(bearing.inner_speed),
        CELSIUS.of(bearing.oil_temperature),
        1e3 * bearing.pitch_diameter,
    )
    factor, most = turns * pitch, _most_speed(bearing)
    yield WarningCondition.of(
        factor > most,
        "speed-high",
        speed=turns,
        pitch=pitch,
        factor=factor,
        limit=most,
        kind=bearing.kind,
    )
    load, rating = np.hypot(bearing.radial_load, bearing.axial_load), _static_rating(bearing)
    tiny = load < _LEAST_LOAD * rating
    yield WarningCondition.of(tiny, "load-low", load=load, rating=rating)
    yield _minimum_load_warning_condition(bearing, load, tiny)
    for key, temperature in bearing.temperatures().items():
        yield extreme(f"bearing.{key}", temperature)
    yield WarningCondition.of(
        viscosity > _MOST_VISCOUS, "viscosity-high", viscosity=viscosity, celsius=celsius, limit=_MOST_VISCOUS
    )
    yield from unusual("roughness", bearing.composite_rq)
    yield from rq_warning_condition("bearing.composite_ra", bearing.composite_ra, bearing.rq_over_ra)
    around = np.pi * bearing.pitch_diameter
    yield from unusual("filling", bearing.elements * bearing.element_diameter / around)
    yield from unusual("strength", case.discharge.dielectric_strength)
    if case.motor is not None:
        yield from unusual_machine({f"motor.{key}": value for key, value in case.motor})
    yield from class_warning_conditions(bearing)
    yield from _geometry_warning_conditions(bearing)
    yield from _maker_warning_conditions(bearing)
    yield from _seal_warning_conditions(bearing)
    oil = case.lubricant.temperature
    if oil is not None and oil.iso_vg is not None:
        low, high = (1e6 * oil.at_40() * (1.0 + part) for part in (-GRADE_WIDTH, GRADE_WIDTH))
        index = partial(_index_of, oil)
        graded = oil.iso_vg > 0
        yield WarningCondition.of(
            graded, "viscosity-grade", grade=oil.iso_vg, low=low, high=high, index=index
        )


def _most_speed(bearing: Bearing) -> Numbers:
    """Largest speed factor n d_m of ordinary bearings of a kind and contact angle [mm/min], shape (...)."""
    most = KINDS_OF_BEARINGS[bearing.kind].most_speed
    if has_rollers(bearing.kind) or bearing.contact_angle is None:
        return most
    return np.interp(bearing.contact_angle, (_FLAT, _STEEP), (most, _SPEED_STEEP))


def _minimum_load_warning_condition(bearing: Bearing, load: Numbers, tiny: Mask) -> WarningCondition:
    """Note of a load [N] below the minimum load of catalogues; a preload is a sufficient load."""
    kind = KINDS_OF_BEARINGS[bearing.kind]
    least = _MINIMUM_LOAD[kind.elements] * dynamic_rating(bearing)
    preload = None if bearing.pair is None else bearing.pair.preload
    free = True if preload is None else np.equal(preload, 0.0)
    below = np.logical_and(load < least, np.logical_not(tiny))
    return WarningCondition.of(
        below & free, "load-below-minimum", load=load, least=least, elements=kind.elements
    )


def _geometry_warning_conditions(bearing: Bearing) -> Iterator[WarningCondition]:
    """Note of a geometry that is estimated from load ratings."""
    rollers = KINDS_OF_BEARINGS[bearing.kind].rollers
    yield WarningCondition.of(
        bool(estimated_keys(bearing)),
        "geometry-estimated",
        "as_widest" if bearing.kind in WITHOUT_KNOWN else "of_known",
        name=(bearing.base or "").upper().replace("-", " "),
        elements=f"{bearing.elements} {'rollers' if rollers else 'balls'}",
        diameter=lambda: 1e3 * float(bearing.element_diameter),
        pitch=lambda: 1e3 * float(bearing.pitch_diameter),
    )


def _maker_warning_conditions(bearing: Bearing) -> Iterator[WarningCondition]:
    """Note of load ratings that another maker prints than the maker in the designation."""
    maker = parts_of(bearing.designation).maker if bearing.designation else ""
    printed, life = printed_ratings(bearing.base), bearing.life
    if not maker or printed is None or printed.kind != bearing.kind:
        return
    ratings = () if life is None else (life.dynamic_rating, life.static_rating)
    used = None in ratings or (life is None and bool(estimated_keys(bearing)))
    yield WarningCondition.of(
        used and printed.maker != maker,
        "ratings-of-other-maker",
        name=printed.designation.replace("-", " "),
        catalogue=printed.maker,
        maker=maker,
    )


def _seal_warning_conditions(bearing: Bearing) -> Iterator[WarningCondition]:
    """Note of a bearing with two seals or shields, greased for life, whose film is fully flooded."""
    seals = seals_of(bearing.designation) if bearing.designation else ""
    closed = seals.startswith("two") and isinstance(bearing.supply, str) and bearing.supply == "flooded"
    yield WarningCondition.of(closed, "sealed-flooded", name=bearing.designation, seals=seals)


def _index_of(oil: OilTemperature) -> str:
    """Viscosity index of a grade with a given viscosity at 100 degC, in words; empty without one."""
    if oil.kinematic_viscosity_100 is None or 1e6 * oil.at_100() < LEAST_AT_100:
        return ""
    at_40, at_100 = float(oil.at_40()), float(oil.at_100())
    given = f"{readable(1e6 * oil.kinematic_viscosity_100, 4)} mm²/s at 100 °C"
    return f", which gives a viscosity index of {viscosity_index(at_40, at_100):.0f} with {given}"


def _static_rating(bearing: Bearing) -> Numbers:
    """Static load rating of all rows of elements by ISO 76 [N], for typical ratios of diameters."""
    kind, diameter = KINDS_OF_BEARINGS[bearing.kind], 1e3 * bearing.element_diameter
    across = 1e3 * bearing.roller_length if bearing.roller_length is not None else diameter
    return kind.static * bearing.rows * bearing.elements * diameter * across


def voltage_warning_conditions(solution: BearingSolution) -> Iterator[WarningCondition]:
    """Warnings of the capacitance and the voltages of a bearing: lubrication, ceramics, Weibull strength."""
    yield from _contact_of_asperities(solution)
    yield WarningCondition.of(capacitance_is_bound(solution), "capacitance-bound")
    breakdown, shaft, per_volt = breakdown_of(solution), shaft_voltage(solution), strength_per_volt(solution)
    field = known(mul, film_voltage(solution), per_volt)
    first, scattered = known_of(breakdown, "shaft_first_break"), solution.case.discharge.weibull is not None
    margin, converged = known(truediv, first, shaft), solution.converged
    yield breakdown_warning_condition(
        "shaft voltage",
        shaft,
        lambda: f"first breakdown at {readable(first)} V",
        margin if converged else None,
        field=None if scattered else field,
    )
    if converged:
        yield from strength_warning_conditions(solution.conditions.discharge)
        yield from field_warning_conditions(field, "the motor")
    yield from _coating_warning_conditions(solution, shaft)
    yield from leakage_warning_conditions(solution)
    yield from current_warning_conditions(solution)
    yield from life_warning_conditions(solution)
    yield WarningCondition.of(scattered & insulating(solution), "weibull-voltage")


def _coating_warning_conditions(
    solution: BearingSolution, shaft: Numbers | None
) -> Iterator[WarningCondition]:
    """Warnings of a coating: assumed values, and a shaft voltage [V] that breaks it down.

    The coating breaks down by itself after the films have broken down.
    """
    coating = solution.case.bearing.coating
    if coating is not None:
        values = partial(_assumed_text, coating)
        yield WarningCondition.of(coating.any_assumed, "coating-assumed", coating=coating.base, values=values)
    withstands = shaft_path(solution).coating_breakdown
    if withstands is not None and shaft is not None:
        yield WarningCondition.of(withstands < shaft, "coating-breakdown", withstands=withstands, shaft=shaft)


def _assumed_text(coating: Coating) -> str:
    """Values of a coating that are assumed, as text."""
    shown = {"thickness": f"{readable(1e6 * coating.thickness, 4)} µm"}
    return ", ".join(
        f"{key} {shown.get(key, f'{readable(value, 4)}')}" for key, value in coating.assumed.items()
    )


def _touching_text(duty: BearingDuty) -> str:
    return time_share_text(float(duty.touching_time_share))


def _contact_of_asperities(solution: BearingSolution) -> Iterator[WarningCondition]:
    """Warning of surfaces that touch all or some of the time."""
    ratio, height = partial(lambda_text, solution), solution.case.bearing.summit_height
    state, shorted = bearing_state(solution), conducts(solution)
    boundary, frequent, mixed = (np.asarray(state == each.name) for each in (BOUNDARY, FREQUENT, MIXED))
    yield WarningCondition.of(shorted & boundary, "touching", "steel", ratio=ratio)
    yield WarningCondition.of(shorted & frequent, "touching", "summits", ratio=ratio, height=height)
    if solution.conditions.ceramic:
        yield WarningCondition.of(boundary, "touching", "ceramic", ratio=ratio)
        partly = mixed | frequent
        yield WarningCondition.of(partly, "partial-film", "ceramic", ratio=ratio)
        return
    duty = duty_of(solution)
    partly = (mixed | (duty.behaviour != "capacitive")) & ~np.asarray(shorted)
    share = partial(_touching_text, duty)
    yield WarningCondition.of(partly, "partial-film", "steel", ratio=ratio, share=share)


def edge_warning_conditions(solution: BearingSolution) -> Iterator[WarningCondition]:
    """Warnings of contact ellipses that reach over the shoulder of a groove, at most one per ring.

    Of the contacts that reach over, the warning names the one with the largest load.
    """
    bearing, positions = solution.case.bearing, solution.positions
    bottom = solution.conditions.geometry.bottom_angle
    for k, name in enumerate(("inner", "outer")):
        shoulder = shoulder_angle(bearing, inner=k == 0)
        groove = groove_ratio(bearing, inner=k == 0) * bearing.element_diameter
        rings = [position.rings[k] for position in positions]
        angles = [position.equilibrium.ring(inner=k == 0).angle - bottom for position in positions]
        ends = np.stack([_end(*pair, groove) for pair in zip(rings, angles, strict=True)], axis=-2)
        loads = np.stack([ring.load for ring in rings], axis=-2)
        over = np.where(ends > np.asarray(shoulder)[..., np.newaxis, np.newaxis], loads, 0.0)
        yield WarningCondition.of(
            np.any(over > 0.0, axis=(-2, -1)),
            "shoulder-reached",
            ring=name,
            load=partial(np.max, over),
            reached=partial(_reached, over, ends),
            shoulder=np.degrees(shoulder),
        )


def _end(ring: RingState, angle: Array, groove: Numbers) -> Array:
    """Angle from the bottom of a groove with a radius [m] to the end of each contact ellipse [rad]."""
    end: Array = np.abs(angle) + ring.values.semi_axis_y / np.asarray(groove)[..., np.newaxis]
    return end


def _reached(over: Array, ends: Array) -> float:
    """Angle [deg] to the end of the contact of one bearing that has the largest load."""
    return math.degrees(ends.flat[np.argmax(over)])


def clearance_warning_condition(clearance: Numbers, position: Position) -> WarningCondition:
    """Warning of films that take up much of the clearance, an effect that the equilibrium neglects.
    ``clearance``, room for the films [m], the full diametral play of one row; 0 or negative with a preload.
    """
    at = position.equilibrium
    most = np.argmax(at.inner_load, axis=-1)[..., np.newaxis]

    def of_most(values: Array) -> Array:
        """Values of the most loaded element, shape (...)."""
        return np.take_along_axis(values, most, -1)[..., 0]

    films = sum(of_most(ring.values.central_thickness) for ring in position.rings)
    # Preloaded elements have no clearance: the films are compared with the elastic approach.
    preloaded = np.asarray(clearance) <= 0.0
    room = np.where(preloaded, of_most(at.inner_approach + at.outer_approach), clearance)
    return WarningCondition.of(
        films > TAKEN * room,
        "clearance-taken-up",
        films=1e6 * films,
        compared=lambda: "an elastic approach of" if preloaded else "a clearance of",
        room=lambda: 1e6 * float(room),
    )


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
        return f"{ring} contact at {readable(loads[0], 4)} N"
    return f"{len(loads)} {ring} contacts at {readable(min(loads), 4)} to {readable(max(loads), 4)} N"
