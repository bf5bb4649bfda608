"""Oil of a case over the temperatures of a heated film."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ehlectric.cases.oils.lubricant import Lubricant
from ehlectric.cases.oils.resolution import CELSIUS
from ehlectric.errors import InputError
from ehlectric.film.thermal.oil import HotOil
from ehlectric.lubricant.oil import Oil

# Temperatures over which the laws of the oil are taken: that far below the coldest part at the inlet, since
# oil that expands in the outlet cools by some kelvins, and that far above the hottest one [K].
_BELOW, _ABOVE = 20.0, 250.0

# Steps by which the range shrinks where a law has no value at its end [K], and its smallest part above the
# inlet.
_STEP, _LEAST = 10.0, 30.0

# Largest number of such steps in the search for a temperature that a message may name.
_SEARCHED = 100


def oil_over_temperature(lubricant: Lubricant) -> Callable[[float], Oil]:
    """Oil as a function of temperature, also beyond the range of its measurements.

    The film is nearly always hotter than the oil in the inlet, so that ``temperature_range`` does not bound
    its temperatures; a warning tells when they leave it. Electrical properties have no part in the film.
    """
    mechanical = lubricant.model_copy(
        update={
            "temperature_range": None,
            "permittivity_table": None,
            "conductivity_table": None,
            "conductivity_law": None,
            "relative_permittivity": 1.0,
        }
    )
    return lambda temperature: mechanical.at(temperature)


def hot_oil(
    lubricant: Lubricant, temperatures: tuple[float, ...], max_pressure: float, keys: tuple[str, ...] = ()
) -> HotOil:
    """Oil over pressure and temperature for the energy equation of a film.

    Parameters
    ----------
    lubricant : Lubricant
        Table of the oil, with density, thermal conductivity and heat capacity.
    temperatures : tuple of float
        Temperatures of the oil in the inlet and of both bodies [K].
    max_pressure : float
        Hertz pressure [Pa], at which the laws must have values.
    keys : tuple of str
        Keys of the temperatures in the file, which a message names; without them it names the lubricant.

    Returns
    -------
    HotOil
        Oil from 20 K below the lowest of the temperatures to 250 K above the highest, or to where its laws
        have values.

    Raises
    ------
    InputError
        If the laws of the oil have no values in this neighbourhood.
    """
    oil_at = oil_over_temperature(lubricant)
    ends = []
    for extreme, furthest, least in ((min, -_BELOW, 0.0), (max, _ABOVE, _LEAST)):
        start = extreme(temperatures)
        end = _end(oil_at, start, furthest, least, max_pressure)
        if end is None:
            key = keys[temperatures.index(start)] if keys else None
            raise _no_values(oil_at, start, np.copysign(least, furthest), max_pressure, key)
        ends.append(end)
    return HotOil.through(oil_at, *ends)


def _end(
    oil_at: Callable[[float], Oil], start: float, furthest: float, least: float, max_pressure: float
) -> float | None:
    """End of the range [K]: as far from ``start`` as the laws of the oil have values; None if nowhere."""
    away = abs(furthest)
    while away >= least:
        end = start + np.copysign(away, furthest)
        if _has_values(oil_at, end, max_pressure):
            return float(end)
        away -= _STEP
    return None


def _no_values(
    oil_at: Callable[[float], Oil], start: float, beyond: float, max_pressure: float, key: str | None
) -> InputError:
    """Error of a temperature [K] from which the film reaches ``beyond`` [K], where an oil has no values."""
    needed = start + beyond
    what = f"has no viscosity, density or thermal properties at {needed - CELSIUS:.4g} °C"
    if key is None:
        text = f"{what}, a temperature that the film may reach; choose other laws for a thermal film"
        return InputError.worded("lubricant", text)
    towards = np.copysign(_STEP, -beyond)
    known = (needed + k * towards for k in range(1, _SEARCHED))
    end = next((at for at in known if _has_values(oil_at, at, max_pressure)), None)
    takes = "other laws of the lubricant"
    if end is not None:
        takes = f"at {'least' if towards > 0.0 else 'most'} {end - beyond - CELSIUS:.4g} °C, or {takes}"
    return InputError(
        key,
        f"got {start - CELSIUS:.4g} °C, with which the film may reach {needed - CELSIUS:.4g} °C, where the "
        "lubricant has no viscosity, density or thermal properties",
        takes=takes,
    )


def _has_values(oil_at: Callable[[float], Oil], temperature: float, max_pressure: float) -> bool:
    """Whether the laws of an oil have values at a temperature and at pressures up to the largest."""
    pressure = np.array([0.0, 0.5, 1.0]) * max_pressure
    try:
        with np.errstate(all="ignore"):
            oil = oil_at(temperature)
            laws = (oil.log_viscosity, oil.density_ratio, oil.thermal_conductivity_law, oil.heat_capacity_law)
            values = [law(pressure)[0] for law in laws if law is not None]
    except (InputError, ArithmeticError, ValueError):
        return False
    thermal = [value for value in values[1:] if not np.all(value > 0.0)]
    return not thermal and all(bool(np.all(np.isfinite(value))) for value in values) and oil.viscosity > 0.0
