"""Film factor of the contacts with a ring: heat in the inlet times supply of oil."""

from __future__ import annotations

import math
from dataclasses import dataclass

from ehlectric.bearing.loads.geometry import Geometry
from ehlectric.bearing.loads.kinematics import rolling_speeds
from ehlectric.cases.bearings.bearing import Bearing
from ehlectric.cases.bearings.case import BearingCase
from ehlectric.cases.oils.resolution import temperature_coefficient
from ehlectric.errors import InputError
from ehlectric.formulas.inlet_heating import inlet_shear_factor
from ehlectric.formulas.replenishment import replenishment_factor
from ehlectric.lubricant.oil import Oil
from ehlectric.quantities.units import rpm

# Least factor by rule: far below it the rule leaves films thinner than an atom.
_LEAST = 0.01


@dataclass(frozen=True)
class FilmFactor:
    """Film thickness over that of isothermal, fully flooded oil, with its parts; dimensionless.

    Attributes
    ----------
    total : float
        Film thickness over that of isothermal, fully flooded oil.
    heat : float or None
        Part of the heat in the inlet; None where a number stands for it and possibly for more.
    supply : float or None
        Part of the supply of oil; None where ``total`` contains it, as in a measured film factor.
    inlet_shear : float or None
        Part of the heat in the inlet by formula, also where the heat is to be solved; None where no heat is
        computed.
    """

    total: float
    heat: float | None = None
    supply: float | None = None
    inlet_shear: float | None = None


def film_factor_of(case: BearingCase, geometry: Geometry, oil: Oil, temperature: float) -> FilmFactor:
    """Film factor of the contacts with a ring at its temperature [K], by the bearing file.

    Parameters
    ----------
    case : BearingCase
        Bearing file.
    geometry : BallBearing or RollerBearing
        Internal geometry in operation.
    oil : Oil
        Oil at the temperature of the ring.
    temperature : float
        Temperature of the ring [K].

    Returns
    -------
    FilmFactor
        Factor with its parts. With ``film_factor`` "solved", whose heat is that of a loaded contact, ``heat``
        and ``total`` are NaN.

    Raises
    ------
    InputError
        Where the rule for a way of supply leaves next to no film.
    """
    factor, supply = case.bearing.film_factor, _supply_factor(case.bearing, oil)
    if isinstance(factor, float):
        return FilmFactor(factor * supply, None, supply)
    if factor == "none":
        return FilmFactor(supply, 1.0, supply)
    by_formula = _inlet_shear(case, geometry, oil, temperature)
    heat = by_formula if factor == "inlet-shear" else math.nan
    return FilmFactor(heat * supply, heat, supply, by_formula)


def _inlet_shear(case: BearingCase, geometry: Geometry, oil: Oil, temperature: float) -> float:
    """Film over the isothermal one at a temperature [K] by the formula of the heat in the inlet."""
    bearing = case.bearing
    # Speed at the free contact angle: it differs little from the speed at the loaded contact angle.
    speeds = rolling_speeds(
        bearing.element_diameter,
        bearing.pitch_diameter,
        bearing.inner_speed,
        contact_angle=geometry.free_angle,
    )
    slope = temperature_coefficient(case.lubricant, temperature)
    assert slope is not None and oil.thermal_conductivity is not None
    return inlet_shear_factor(oil.viscosity, slope, float(speeds.inner_entrainment), oil.thermal_conductivity)


def _supply_factor(bearing: Bearing, oil: Oil) -> float:
    """Film thickness over the fully flooded one, by the number or the rule of the file."""
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
    if factor < _LEAST:
        raise InputError(
            "bearing.supply",
            got=f"{bearing.supply!r}, whose rule leaves {float(factor):.2g} of the flooded film at "
            f"{1e6 * oil.viscosity / oil.density:.0f} mm^2/s and {rpm(bearing.inner_speed):.0f} rpm;",
            takes=f"a speed and an oil of which it leaves {_LEAST:g}, or a measured number",
        )
    return float(factor)
