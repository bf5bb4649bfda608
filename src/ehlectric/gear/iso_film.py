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

import numpy as np

from ehlectric.arrays import Array
from ehlectric.cases import library
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


def flash_temperature(solution: GearSolution, friction: float) -> Array:
    """Flash temperature of Blok on all lines of contact [K]."""
    films = solution.films
    table = library.solid(solution.case.gear.material)
    product = (
        to_si(table["thermal_conductivity"], "W/m/K")
        * to_si(table["density"], "kg/m**3")
        * to_si(table["heat_capacity"], "J/kg/K")
    )
    first = films.mean_speed + 0.5 * films.sliding_speed
    second = films.mean_speed - 0.5 * films.sliding_speed
    speeds = np.sqrt(first) + np.sqrt(second)
    heat: Array = 1.11 * friction * films.load * np.abs(films.sliding_speed)
    rise: Array = heat / (math.sqrt(product) * speeds * np.sqrt(2.0 * films.half_width))
    return rise


def lambda_gf(solution: GearSolution) -> float | None:
    """Smallest specific film thickness by ISO/TS 6336-22; None without the Ra of the flanks, a friction
    coefficient or thermal properties of the gears.
    """
    gear = solution.case.gear
    friction = gear.operation.friction_coefficient
    if friction is None or gear.flank_ra is None or gear.material not in library.solid_names(thermal=True):
        return None
    oil, lubricant = solution.flanks.oil, solution.case.lubricant
    rise = flash_temperature(solution, friction)
    # The product of alpha and viscosity changes smoothly: a few temperatures are enough. Beyond the range of
    # the oil it is taken as constant.
    hottest, ends = float(np.nanmax(rise)), lubricant.temperature_range
    if ends is not None:
        hottest = min(hottest, ends[1] - solution.bulk_temperature)
    nodes = np.linspace(0.0, max(hottest, 0.0), 9)
    products = []
    for node in nodes.tolist():
        hot = lubricant.at(solution.bulk_temperature + node, "gear.operation.bulk_temperature")
        products.append(hot.alpha_star * hot.viscosity)
    local = np.interp(rise, nodes, np.array(products) / products[0])
    thickness = iso_thickness(
        solution.films, float(oil.viscosity), float(oil.alpha_star), solution.flanks.modulus, local
    )
    mean_ra = 0.5 * sum(both(gear.flank_ra))
    return float(np.nanmin(thickness)) / mean_ra
