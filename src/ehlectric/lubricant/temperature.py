"""Temperature dependence of an oil: viscosity, density, and measured tables."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ehlectric.arrays import Array
from ehlectric.errors import InputError
from ehlectric.lubricant.law import refused

# 15, 40 and 100 degC as absolute temperatures [K].
REFERENCE = 288.15
COLD, HOT = 313.15, 373.15

# Constant that ASTM D341 adds to the kinematic viscosity, and the smallest viscosity for which a constant is
# accurate enough [mm^2/s].
_ADDED, _LEAST = 0.7, 2.0


@dataclass(frozen=True)
class Walther:
    """Kinematic viscosity of an oil over temperature, after ASTM D341 (Walther's equation).

    log10 log10(nu + 0.7) = A - B log10 T, with nu in mm^2/s and T in K. This is the short form of ASTM D341,
    for nu of at least 2 mm^2/s.

    Attributes
    ----------
    a, b : float
        Constants A and B, dimensionless.

    Examples
    --------
    >>> oil = Walther.of(46e-6, 6.8e-6)
    >>> round(oil.viscosity(343.15) * 1e6, 2)
    14.85
    """

    a: float
    b: float

    @classmethod
    def of(cls, at_40: float, at_100: float) -> Walther:
        """Walther equation of an oil from its kinematic viscosities at 40 and 100 degC [m^2/s].

        Raises
        ------
        InputError
            If the viscosity does not fall with temperature, or is too low for the equation.
        """
        if not at_40 > at_100:
            raise InputError(
                "temperature.kinematic_viscosity_100",
                got=f"{at_100:g} m^2/s",
                takes=f"less than kinematic_viscosity_40, {at_40:g} m^2/s",
            )
        if at_100 < 1e-6 * _LEAST:
            raise InputError(
                "temperature.kinematic_viscosity_100",
                got=f"{at_100:g} m^2/s",
                takes=f"at least {1e-6 * _LEAST:g} m^2/s, for which ASTM D341 holds in its short form",
            )
        cold, hot = (math.log10(math.log10(1e6 * nu + _ADDED)) for nu in (at_40, at_100))
        b = (cold - hot) / math.log10(HOT / COLD)
        return cls(cold + b * math.log10(COLD), b)

    def viscosity(self, temperature: float) -> float:
        """Kinematic viscosity [m^2/s] at an absolute temperature [K].

        Raises
        ------
        InputError
            If the viscosity is too low for the equation, or the oil is solid at this temperature.
        """
        double = math.pow(10.0, self.a - self.b * math.log10(temperature))
        if double > 300.0:
            raise InputError("temperature", got=f"{temperature:g} K, at which the oil is solid")
        nu = math.pow(10.0, double) - _ADDED
        if nu < _LEAST:
            raise InputError(
                "temperature",
                got=f"{temperature:g} K, at which the oil has {nu:.3g} mm^2/s;",
                takes=f"one at which it has {_LEAST:g} mm^2/s or more, for which ASTM D341 holds in its "
                "short form",
            )
        return 1e-6 * nu

    def slope(self, temperature: float) -> float:
        """Temperature coefficient of the kinematic viscosity, -d ln(nu)/dT [1/K], at a temperature [K]."""
        total = 1e6 * self.viscosity(temperature) + _ADDED
        return math.log(total) * self.b * total / ((total - _ADDED) * temperature)


def density(at_15: float, expansion: float, temperature: float) -> float:
    """Density of an oil at a temperature, rho = rho_15 (1 - a (T - 288.15 K)).

    Parameters
    ----------
    at_15 : float
        Density rho_15 at 15 degC [kg/m^3].
    expansion : float
        Coefficient a of thermal expansion [1/K].
    temperature : float
        Absolute temperature T [K].

    Returns
    -------
    float
        Density rho [kg/m^3].

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

    Parameters
    ----------
    temperature : array_like, shape (...)
        Temperature [K].
    temperatures : sequence of float, shape (n,)
        Temperatures of the table [K], increasing.
    values : sequence of float, shape (n,)
        Values of the property; with ``arrhenius`` above zero.
    table : str
        Name of the table, for the message.
    arrhenius : bool, optional
        Whether the logarithm of the value is interpolated linearly over 1/T, as for an electrical
        conductivity. Without it, the value is interpolated linearly over T.

    Returns
    -------
    ndarray, shape (...)
        Values of the property at the temperatures.

    Raises
    ------
    InputError
        If a temperature is outside the table; nothing is extrapolated.

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
