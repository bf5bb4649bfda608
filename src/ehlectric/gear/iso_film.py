"""Specific film thickness lambda_GF of ISO/TS 6336-22, a number for comparison with other programs. SI units.

    h_Y/rho_n = 1.6 G^0.6 U^0.7 W^-0.13 S_GF^0.22        G = alpha E'        U = eta u_m/(E' rho_n)
    W = 2 pi (p_H/E')^2        S_GF = (alpha eta at theta_M + theta_fl)/(alpha eta at theta_M)
    theta_fl = 1.11 mu w abs(v_1 - v_2)/(B (sqrt v_1 + sqrt v_2) sqrt(2 b))        B = sqrt(k rho c)
    lambda_GF = minimum of h_Y/((Ra_1 + Ra_2)/2)

theta_fl is Blok's flash temperature. J. Jbily et al., Procedia Struct. Integr. 57 (2024) 199, print h_Y. The
scope of the standard are modules of 3 to 11 mm and pitch line speeds of 8 to 60 m/s. lambda_GF is no lambda
ratio: with equal flanks of Rq = 1.25 Ra the same film has a lambda_GF 1.77 times as large.
"""

from __future__ import annotations

import math
from functools import lru_cache

import numpy as np

from ehlectric.arrays import Array
from ehlectric.cases import library
from ehlectric.cases.case_oil import Lubricant
from ehlectric.cases.gear_inputs import both
from ehlectric.gear.flank_films import FlankFilms
from ehlectric.gear.solution import GearSolution
from ehlectric.quantities.units import to_si


def iso_thickness(
    films: FlankFilms, viscosity: float, alpha: float, modulus: float, local: Array | float = 1.0
) -> Array:
    """Film thickness h_Y [m]. ``viscosity`` [Pa s] and ``alpha`` [1/Pa] at the temperature of the flanks;
    ``local``, S_GF.
    """
    speed = viscosity * films.mean_speed / (modulus * films.reduced_radius)
    load = 2.0 * math.pi * (films.max_pressure / modulus) ** 2
    thickness: Array = (
        films.reduced_radius * 1.6 * (alpha * modulus) ** 0.6 * speed**0.7 * load**-0.13 * local**0.22
    )
    return thickness


@lru_cache(maxsize=32)
def _effusivity(material: str) -> float:
    """Thermal effusivity B of a solid of the library [W s^(1/2)/(m^2 K)]."""
    table = library.solid(material)
    product = (
        to_si(table["thermal_conductivity"], "W/m/K")
        * to_si(table["density"], "kg/m**3")
        * to_si(table["heat_capacity"], "J/kg/K")
    )
    return math.sqrt(product)


def flash_temperature(solution: GearSolution, friction: float) -> Array:
    """Flash temperature of Blok on all lines of contact [K]."""
    films, effusivity = solution.films, _effusivity(solution.case.gear.material)
    first = films.mean_speed + 0.5 * films.sliding_speed
    second = films.mean_speed - 0.5 * films.sliding_speed
    speeds = np.sqrt(first) + np.sqrt(second)
    heat: Array = 1.11 * friction * films.load * np.abs(films.sliding_speed)
    rise: Array = heat / (effusivity * speeds * np.sqrt(2.0 * films.half_width))
    return rise


# Distance of temperatures [K] at which an oil is tabulated, and their range for an oil without a range.
_STEP, _RANGE = 2.0, (230.0, 600.0)

# Lubricants whose products were computed last, with temperatures and logarithms of products.
_latest: list[tuple[Lubricant, Array, Array]] = []


def _products(lubricant: Lubricant) -> tuple[Array, Array]:
    """Temperatures [K] and ln(alpha* eta) of an oil there. Beyond its range the product is constant."""
    for known, temperatures, logs in _latest:
        if known is lubricant or known == lubricant:
            return temperatures, logs
    low, high = lubricant.temperature_range or _RANGE
    temperatures = np.linspace(low, high, max(2, math.ceil((high - low) / _STEP) + 1))
    oil = lubricant.at(temperatures, "gear.operation.bulk_temperature")
    with np.errstate(divide="ignore", invalid="ignore"):
        logs = np.log(np.broadcast_to(oil.alpha_star * oil.viscosity, temperatures.shape))
    within = np.isfinite(logs)
    _latest[:] = [(lubricant, temperatures[within], logs[within]), *_latest[:7]]
    return _latest[0][1:]


def lambda_gf(solution: GearSolution) -> float | None:
    """Smallest specific film thickness by ISO/TS 6336-22; None without the Ra of the flanks, a friction
    coefficient or thermal properties of the gears.
    """
    gear = solution.case.gear
    friction = gear.operation.friction_coefficient
    if friction is None or gear.flank_ra is None or gear.material not in library.solid_names(thermal=True):
        return None
    oil, bulk = solution.flanks.oil, solution.bulk_temperature
    temperatures, logs = _products(solution.case.lubricant)
    rise = flash_temperature(solution, friction)
    local = np.exp(np.interp(bulk + rise, temperatures, logs) - np.interp(bulk, temperatures, logs))
    thickness = iso_thickness(solution.films, oil.viscosity, oil.alpha_star, solution.flanks.modulus, local)
    mean_ra = 0.5 * sum(both(gear.flank_ra))
    return float(np.nanmin(thickness)) / mean_ra
