"""Film factor of bearing contacts due to heat and oil supply, and the rolling friction.

The friction is the hydrodynamic rolling resistance of all contacts, from one solved contact of each ring.
Spin and slip of the balls, cage, ribs, seals, churned oil and hysteresis of the steel add to it, and are not
computed.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import fields, replace
from typing import Any

import numpy as np

from ehlectric.arrays import Array, Numbers, as_float
from ehlectric.bearing.bearing_kinds import kind_of
from ehlectric.bearing.conditions import BearingConditions, ContactFriction
from ehlectric.bearing.loads.geometry import Geometry, rolling_speeds
from ehlectric.bearing.ring_contacts import RingContacts
from ehlectric.bearing.solution import BearingSolution
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.cases.bearing_inputs import Bearing
from ehlectric.cases.bearing_kinds import has_rollers
from ehlectric.cases.case_oil import temperature_coefficient, viscosity_follows
from ehlectric.contact import PointConditions
from ehlectric.errors import InputError
from ehlectric.formulas.inlet_supply import (
    LOADING_EXPONENT,
    decay_rate,
    film_half_time,
    inlet_shear_factor,
    line_rolling_force,
    point_rolling_force,
    replenishment_factor,
)
from ehlectric.lubricant.heat_laws import ASSUMED_CONDUCTIVITY, USUAL_CONDUCTIVITY
from ehlectric.lubricant.oil import Oil
from ehlectric.quantities.result_warnings import WarningCondition
from ehlectric.quantities.units import rpm
from ehlectric.readable import readable


def half_time(solution: BearingSolution) -> Numbers | None:
    """Time [s] after which the film of the most loaded contact of a ring has halved without supply. Returns
    smaller time of both rings, shape (...); None for a flooded bearing, whose tracks are filled up at every
    passage, and for rollers, from whose contacts almost no oil flows to the sides.

    All contacts are taken as loaded like the most loaded one, so that real films decay more slowly.
    """
    bearing = solution.case.bearing
    if bearing.supply == "flooded" or has_rollers(bearing.kind):
        return None
    times = []
    for ring, state in zip((solution.inner, solution.outer), solution.positions[0].rings, strict=True):
        most, values = np.argmax(state.load, axis=-1)[..., np.newaxis], state.values
        quantities = values.max_pressure, values.semi_axis_x, values.semi_axis_y, values.central_thickness
        pressure, along, across, thickness = (
            np.take_along_axis(quantity, most, -1)[..., 0] for quantity in quantities
        )
        times.append(contact_half_time(ring, pressure, (along, across), thickness))
    return as_float(np.minimum(*map(np.asarray, times)))


def contact_half_time(
    ring: RingContacts[Any], max_pressure: Numbers, semi_axes: tuple[Numbers, Numbers], thickness: Numbers
) -> Numbers:
    """Time in which the film of a contact with a ring halves if no oil returns to its track, shape (...) [s].
    ``max_pressure``, Hertz pressure of the contact [Pa]; ``semi_axes``, semi-axes of the contact along and
    across the track [m]; ``thickness``, central film thickness at the start [m].
    """
    rate = decay_rate(
        max_pressure=max_pressure,
        semi_axes=semi_axes,
        viscosity=ring.oil.viscosity,
        pressure_viscosity_coefficient=ring.oil.alpha_star,
        density_ratio=as_float(ring.oil.density_ratio(max_pressure)[0]),
        track_length=track_length(ring.conditions, ring.angle, inner=ring.inner),
    )
    return as_float(film_half_time(thickness, rate))


def track_length(conditions: BearingConditions[Any], angle: Numbers, *, inner: bool) -> Numbers:
    """Length of track on both surfaces from which one contact with a ring presses oil, shape (...) [m].

    All Z contacts with the ring share its track of the length pi (d_m -+ D cos a), and both contacts of an
    element share the track of the length pi D on its surface.
    """
    bearing = conditions.bearing
    sign = -1.0 if inner else 1.0
    race = bearing.pitch_diameter + sign * bearing.element_diameter * np.cos(angle)
    return as_float(math.pi * (race / bearing.elements + 0.5 * bearing.element_diameter))


# Least factor by rule: far below it the rule leaves films thinner than an atom.
_LEAST = 0.01


def factors_of(case: BearingCase, geometry: Geometry, oil: Oil, temperature: Numbers) -> dict[str, Any]:
    """Film factor of the contacts with a ring at its temperature [K], and its parts, for ``RingConditions``.

    The film factor is NaN where its heat has to be solved. Raises InputError where the rule for a kind of
    supply leaves next to no film, of many points in which NaN stands for it; and where the heat of many
    points has to be solved.
    """
    if case.bearing.film_factor == "solved" and case.shape:
        takes = "a factor that needs no solved film: 'none', 'inlet-shear' or a number"
        raise InputError("bearing.film_factor", got="'solved' for many points", takes=takes)
    factor, supply = case.bearing.film_factor, _supply_factor(case.bearing, oil)
    if isinstance(factor, float):
        return {"film_factor": factor * supply, "supply_factor": supply}
    if factor == "none":
        return {"film_factor": supply, "heat_factor": 1.0, "supply_factor": supply}
    by_formula = _inlet_shear(case, geometry, oil, temperature)
    heat = by_formula if factor == "inlet-shear" else math.nan
    parts = {"heat_factor": heat, "supply_factor": supply, "inlet_shear_factor": by_formula}
    return {"film_factor": heat * supply, **parts}


def _inlet_shear(case: BearingCase, geometry: Geometry, oil: Oil, temperature: Numbers) -> Numbers:
    """Film divided by the isothermal film at a temperature [K], from the formula of inlet shear heating."""
    bearing = case.bearing
    # Speed at the free contact angle: it differs little from the speed at the loaded contact angle.
    speeds = rolling_speeds(
        element_diameter=bearing.element_diameter,
        pitch_diameter=bearing.pitch_diameter,
        inner_speed=bearing.inner_speed,
        contact_angle=geometry.free_angle,
    )
    slope = temperature_coefficient(case.lubricant, temperature)
    assert slope is not None
    known = oil.thermal_conductivity
    conductivity = ASSUMED_CONDUCTIVITY if known is None else known
    return inlet_shear_factor(oil.viscosity, slope, speeds.inner_entrainment, conductivity)


def _supply_factor(bearing: Bearing, oil: Oil) -> Numbers:
    """Film thickness divided by the fully flooded thickness, by the number or the rule of the file."""
    if isinstance(bearing.supply, float):
        return bearing.supply
    if not bearing.by_supply_rule:
        return 1.0
    assert bearing.bore is not None and bearing.outer_diameter is not None and oil.density is not None
    factor = replenishment_factor(
        bearing.inner_speed,
        oil.viscosity / oil.density,
        bore=bearing.bore,
        outer_diameter=bearing.outer_diameter,
        supply=bearing.supply,
        kind=bearing.kind,
    )
    if np.ndim(factor):
        return np.where(factor < _LEAST, np.nan, factor)
    if factor < _LEAST:
        raise InputError(
            "bearing.supply",
            got=f"{bearing.supply!r}, whose rule gives a film of {readable(float(factor), 2)} of the flooded "
            f"film at {1e6 * oil.viscosity / oil.density:.0f} mm^2/s and {rpm(bearing.inner_speed):.0f} rpm;",
            takes=f"a speed and an oil that give at least {_LEAST:g}, or a measured number",
        )
    return float(factor)


def rolling_force(ring: RingContacts[Any], friction: ContactFriction, load: Array) -> Array:
    """Hydrodynamic rolling force on each surface of the contacts with a ring. ``load``, loads of the contacts
    [N]; 0 without contact, shape (...). Returns force [N]: the force of the solved contact times the ratio of
    the forces at both loads from formulas, shape (...).

    The formulas follow Biboulet and Houpert (2010), doi:10.1243/13506501JET790 and JET791. The force of
    a heavily loaded ball goes with the cube root of the load, the force of a roller does not depend on it.
    Heat and a short supply of oil reduce the force of all contacts as in the solved contact, and heat reduces
    the force of lightly loaded contacts too much.
    """
    # The formulas take the speed of the surfaces, which a film factor would reduce.
    conditions = replace(kind_of(ring).contact(ring, friction.load).conditions, film_factor=1.0)
    loads = np.array([friction.load, *np.ravel(load)])
    if isinstance(conditions, PointConditions):
        by_formula = point_rolling_force(conditions.contact, loads)
    else:
        per_length = loads * (conditions.load_per_length / friction.load)
        by_formula = line_rolling_force(conditions.contact, per_length)
    solved = friction.rolling_coefficient * friction.load
    return np.reshape(solved * by_formula[1:] / by_formula[0], np.shape(load))


def rolling_power_loss(solution: BearingSolution) -> float | None:
    """Power that the hydrodynamic rolling resistance of all contacts takes, mean over the positions. Returns
    power [W], 2 F u for each of them; None where no heat is solved, or not the film with heat and supply.
    """
    power = 0.0
    for k, (ring, conditions) in enumerate(
        zip((solution.inner, solution.outer), solution.conditions.rings, strict=True)
    ):
        if conditions.friction is None:
            return None
        loads = np.array([position.rings[k].load for position in solution.positions])
        force = rolling_force(ring, conditions.friction, loads)
        power += 2.0 * float(ring.speed) * float(np.mean(np.sum(force, axis=-1)))
    return power


def friction_summary(solution: BearingSolution) -> dict[str, float | None]:
    """Friction of the solved contacts and of the bearing as in summary.json; None where no heat is solved."""
    power = rolling_power_loss(solution)
    numbers: dict[str, float | None] = {
        "rolling_power_loss": power,
        "rolling_moment": None if power is None else power / solution.case.bearing.inner_speed,
    }
    for name, conditions in zip(("inner", "outer"), solution.conditions.rings, strict=True):
        for each in fields(ContactFriction)[1:]:
            # The power loss of the bearing has its own key.
            key = "contact_power_loss" if each.name == "power_loss" else each.name
            numbers[f"{name}_{key}"] = getattr(conditions.friction, each.name, None)
    return numbers


def solved_scales(solution: BearingSolution) -> tuple[float, float]:
    """Film of the most loaded contact with each ring, solved with heat and supply, divided by the solution's
    film.

    The films of a solution are films of a slower bearing, by the exponent of a formula, and may be from
    formulas themselves. 1 where no film with heat and supply is known.
    """
    inner, outer = (
        1.0
        if conditions.friction is None or conditions.friction.solved_thickness is None
        else conditions.friction.solved_thickness
        / float(curve.at(np.array([conditions.friction.load])).central_thickness[0])
        for conditions, curve in zip(solution.conditions.rings, solution.curves, strict=True)
    )
    return inner, outer


# Supply factor below which the layer of oil on the tracks sets the film rather than speed and viscosity: the
# flooded film is then about twice as thick as the layer, or more.
_LOW = 0.5

# Film factor below which films differ from it by more than several per cent, as the speed at which they are
# computed is reduced with one exponent for all contacts: for balls from the atlas 5 % here, 16 % at 0.1.
_FAR = 0.5

# Half time of a film without supply [s] below which a bearing runs for long without it: all except slow
# bearings.
_SOON = 3600.0

# Heat of a film factor in words.
_HEAT: Mapping[object, str] = {
    "inlet-shear": "inlet shear heating",
    "solved": "the thermal solution for pure rolling",
}

# Ways of supply that bring little or no oil to the track at each passage.
_SPARSE = ("grease", "oil-air")


def film_note(solution: BearingSolution) -> Iterator[WarningCondition]:
    """Note about the effects that the films neglect, and whether they are bounds or best estimates."""
    bearing, whole = solution.case.bearing, solution.conditions.film_factor == 1.0
    factor = bearing.film_factor
    name = factor if isinstance(factor, str) else f"{factor:g}"
    smooth = not np.any(bearing.summit_height)
    surfaces = "smooth" if smooth else "rough"
    unknown = factor == "none" and not viscosity_follows(solution.case.lubricant)
    yield WarningCondition.of(
        whole, "isothermal-film", "viscosity" if unknown else "given", factor=name, surfaces=surfaces
    )
    yield WarningCondition.of(
        np.logical_not(whole),
        "smooth-film",
        "bound" if bearing.bounding else "estimate",
        factor=lambda: _film_words(solution)[0],
        neglected=lambda: _film_words(solution)[1],
        height=bearing.summit_height,
        roughness=" as well as roughness" if smooth else "",
    )


def conductivity_warning_condition(solution: BearingSolution) -> WarningCondition:
    """Note about a thermal conductivity that is assumed for the heat of the inlet."""
    heated = solution.case.bearing.film_factor == "inlet-shear"
    low, high = USUAL_CONDUCTIVITY
    return WarningCondition.of(
        heated and solution.conditions.oil.thermal_conductivity is None,
        "conductivity-assumed",
        value=ASSUMED_CONDUCTIVITY,
        low=low,
        high=high,
        least=lambda: _with_conductivity(solution, low),
        most=lambda: _with_conductivity(solution, high),
    )


def _with_conductivity(solution: BearingSolution, conductivity: float) -> float:
    """Factor of the heat in the inlet of one bearing if its oil had a thermal conductivity [W/(m K)]."""
    factor = solution.conditions.part_of_film_factor("inlet_shear_factor")
    assert isinstance(factor, float)
    # The thermal loading is inversely proportional to the conductivity.
    share = (1.0 / factor - 1.0) * (ASSUMED_CONDUCTIVITY / conductivity) ** LOADING_EXPONENT
    return float(1.0 / (1.0 + share))


def _film_words(solution: BearingSolution) -> tuple[str, str]:
    """Film factor of one bearing with its parts, and what it neglects, in words."""
    bearing = solution.case.bearing
    factor, supply = bearing.film_factor, bearing.supply
    left = "any starvation and heat beyond this factor"
    words = readable(float(solution.conditions.film_factor))
    if supply != "flooded":
        given = isinstance(factor, float) and factor != 1.0
        other = f"a given factor of {readable(float(factor))}" if given else _HEAT.get(factor)
        words += f", from {other} and the oil supply" if other else ", from the oil supply"
    elif factor in _HEAT:
        left, words = "starvation and grease", f"{words}, from {_HEAT[factor]}"
    if factor == "solved":
        left = f"{left}, spin and sliding"
    return words, left


def supply_words(solution: BearingSolution) -> str:
    """Parts of the film factor with a supply, as "0.939 of the flooded thickness by grease"."""
    supply, share = solution.case.bearing.supply, solution.conditions.part_of_film_factor("supply_factor")
    by = f" by {supply}" if solution.case.bearing.by_supply_rule else ""
    heat = solution.case.bearing.film_factor
    more = f" and a given factor of {readable(heat)}" if isinstance(heat, float) else ""
    more = {"inlet-shear": " and inlet shear heating", "solved": " and the thermal solution"}.get(
        str(heat), more
    )
    return f"{readable(float(share or 1.0))} of the flooded thickness{by}{more}"


def supply_warning_conditions(solution: BearingSolution) -> Iterator[WarningCondition]:
    """Warnings of a film factor by rule, of a starved film, and of a film that supply has to maintain."""
    total = solution.conditions.film_factor
    yield WarningCondition.of(total < _FAR, "film-factor-low", factor=total)
    supply, share = solution.case.bearing.supply, solution.conditions.part_of_film_factor("supply_factor")
    if (isinstance(supply, str) and supply == "flooded") or share is None:
        return
    rule = solution.case.bearing.by_supply_rule
    yield WarningCondition.of(rule, "supply-rule", supply=supply, share=share)
    yield WarningCondition.of(share < _LOW, "supply-low", share=share)
    solved = solution.case.bearing.film_factor == "solved"
    yield WarningCondition.of(
        solved and solution.conditions.inner.friction is None, "starved-film-unsolved", share=share
    )
    time = half_time(solution) if isinstance(supply, str) and supply in _SPARSE else None
    if time is not None:
        yield WarningCondition.of(time < _SOON, "film-decays", seconds=time, supply=supply)
