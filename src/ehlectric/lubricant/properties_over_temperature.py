"""Properties of an oil over temperature at ambient pressure: density, and measured tables."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from ehlectric.arrays import Array, Numbers
from ehlectric.errors import InputError
from ehlectric.lubricant.law import refused

# 15 degC as an absolute temperature [K].
REFERENCE = 288.15


def density(at_15: Numbers, expansion: Numbers, temperature: Numbers) -> Numbers:
    """Density of an oil at a temperature, rho = rho_15 (1 - a (T - 288.15 K)). ``at_15``, density rho_15 at
    15 degC [kg/m^3]; ``expansion``, coefficient a of thermal expansion [1/K]; ``temperature``, absolute
    temperature T [K]. Returns density rho [kg/m^3].

    Examples
    --------
    >>> round(density(870.0, 6.5e-4, 343.15), 1)
    838.9
    """
    return at_15 * (1.0 - expansion * (temperature - REFERENCE))


def interpolated(
    temperature: ArrayLike,
    temperatures: Sequence[float],
    values: Sequence[float],
    *,
    table: str,
    arrhenius: bool = False,
) -> Array:
    """Property of an oil at a temperature, from a table over temperature.

    ``temperature`` [K], shape (...); ``temperatures``, temperatures of the table [K], increasing, shape (n,);
    ``values``, values of the property; with ``arrhenius`` above zero, shape (n,). Returns values of the
    property at the temperatures, shape (...). Raises InputError if a temperature is outside the table;
    nothing is extrapolated.

    Examples
    --------
    >>> round(float(interpolated(323.15, [313.15, 333.15], [2.070, 2.056], table="permittivity_table")), 4)
    2.063
    """
    at, known = np.asarray(temperature, dtype=float), np.asarray(temperatures, dtype=float)
    if wrong := refused(at, (at >= known[0]) & (at <= known[-1]), "K"):
        raise InputError(
            "temperature",
            got=f"{wrong};",
            takes=f"{known[0]:.5g} to {known[-1]:.5g} K, the range of {table}",
        )
    if not arrhenius:
        return np.asarray(np.interp(at, known, values))
    # 1/T falls where T rises; np.interp takes increasing abscissae.
    return np.asarray(np.exp(np.interp(-1.0 / at, -1.0 / known, np.log(values))))
