"""Numbers of the oil at the temperature of the flanks of gear pairs, for many pairs at once. SI units."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from ehlectric.arrays import Array, Numbers
from ehlectric.bearing import permittivity_of_mass
from ehlectric.cases.case_oil import Lubricant, refusals, temperature_coefficient
from ehlectric.errors import InputError
from ehlectric.film import OilGroups
from ehlectric.formulas.dry_means import STRIP, pressure_mean
from ehlectric.lubricant.heat_laws import ASSUMED_CONDUCTIVITY
from ehlectric.lubricant.oil import Oil

# Hertz pressures [Pa] for which permittivities are averaged over the zone, in equal steps from 0.
_PRESSURES = np.linspace(0.0, 4e9, 41)

_KEY = "gear.operation.bulk_temperature"


@dataclass(frozen=True)
class FlankOil:
    """Oil at the temperature of the flanks."""

    viscosity: float  # eta0 [Pa s]
    alpha_star: float  # reciprocal asymptotic pressure-viscosity coefficient [1/Pa]
    film_coefficient: float  # pressure-viscosity coefficient of the atlas [1/Pa]
    relative_permittivity: float
    conductivity: float | None  # electrical conductivity [S/m]
    # Temperature coefficient of the viscosity [1/K]; without one films are isothermal.
    slope: float | None
    thermal_conductivity: float  # [W/(m K)]
    # Means over the Hertz zone of relative permittivity times density ratio, over the Hertz pressure.
    zone_permittivities: Array

    def zone_permittivity(self, pressure: Array) -> Array:
        """Mean over the Hertz zone of relative permittivity times density ratio at Hertz pressures [Pa]."""
        return np.interp(pressure, _PRESSURES, self.zone_permittivities)


@dataclass(frozen=True)
class FlankOils:
    """Oils of n gear pairs: one lubricant at their temperatures."""

    oil: Oil  # oil of n points
    groups: OilGroups
    each: list[FlankOil]


def by_lubricant(lubricants: Iterable[Lubricant]) -> Iterator[tuple[Lubricant, list[int]]]:
    """Places of equal lubricants among many."""
    groups: list[tuple[Lubricant, list[int]]] = []
    for place, oil in enumerate(lubricants):
        for lubricant, places in groups:
            if lubricant is oil or lubricant == oil:
                places.append(place)
                break
        else:
            groups.append((oil, [place]))
    yield from groups


def check_oils(lubricant: Lubricant, temperatures: Array) -> list[InputError | None]:
    """Errors of the pairs whose oil has no value at the temperature of the flanks [K], shape (n,)."""
    try:
        return refusals(lubricant, temperatures, _KEY)
    except InputError as error:
        # The oil has a value at none of the temperatures.
        errors: list[InputError | None] = [error] * temperatures.size
        for k, temperature in enumerate(temperatures.tolist()):
            try:
                lubricant.at(temperature, _KEY)
            except InputError as single:
                errors[k] = single
        return errors


def flank_oils(lubricant: Lubricant, temperatures: Array) -> FlankOils:
    """Oils at the temperatures of the flanks [K], shape (n,). Raises InputError for an oil whose viscosity
    does not depend on the pressure.
    """
    oil = lubricant.at(temperatures, _KEY)
    if not np.any(oil.alpha):
        raise InputError(
            "lubricant.viscosity_law",
            got=f"{oil.laws['viscosity']!r} with gears, whose films are computed for piezoviscous oils;",
            takes="another law",
        )
    groups = OilGroups.of(oil.log_viscosity, oil.density_ratio, oil.alpha_star)
    number = temperatures.size
    known = oil.thermal_conductivity
    columns = [
        _column(value, number)
        for value in (
            oil.viscosity,
            oil.alpha_star,
            groups.alpha,
            oil.relative_permittivity,
            oil.conductivity,
            temperature_coefficient(lubricant, temperatures),
            ASSUMED_CONDUCTIVITY if known is None else known,
        )
    ]
    pressures = np.broadcast_to(_PRESSURES[:, np.newaxis], (_PRESSURES.size, number))
    means = pressure_mean(STRIP, partial(permittivity_of_mass, oil), pressures)
    rows = zip(*columns, means.T, strict=True)
    return FlankOils(oil, groups, [FlankOil(*row) for row in rows])


def _column(value: Numbers | None, number: int) -> list[Any]:
    """Value of each pair."""
    return [None] * number if value is None else np.broadcast_to(value, number).tolist()
