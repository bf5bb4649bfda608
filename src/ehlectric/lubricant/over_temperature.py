"""Temperature dependence of an oil at ambient pressure: viscosity by Vogel and Roelands, density, and
measured tables.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ehlectric.arrays import Array
from ehlectric.errors import InputError
from ehlectric.lubricant.law import Law, parameters_of, refused, required, within
from ehlectric.lubricant.viscosity import ROELANDS_CONSTANT

# Temperature of the pole of Roelands' law [K], -135 degC.
ROELANDS_TEMPERATURE = 138.0


def vogel(temperature: ArrayLike | None, *, vogel_viscosity: float, vogel_b: float, vogel_c: float) -> Array:
    """Viscosity at ambient pressure after Vogel, eta = K exp(B/(T - C)).

    ``temperature`` [K], shape (...); ``vogel_viscosity``, constant K, the viscosity at unlimited temperature
    [Pa s]; ``vogel_b`` [K]; ``vogel_c``, temperature C of the pole [K]. Returns viscosity eta [Pa s],
    shape (...). Raises InputError if the temperature is missing, or not above the pole.

    H. Vogel, Phys. Z. 22 (1921) 645.

    Examples
    --------
    >>> fva3 = dict(vogel_viscosity=6.2e-5, vogel_b=1021.7, vogel_c=171.5983)
    >>> (1e3 * vogel([313.15, 333.15, 353.15, 373.15], **fva3)).round(2).tolist()
    [84.54, 34.59, 17.24, 9.86]
    """
    return np.asarray(vogel_viscosity * np.exp(vogel_b / (_above_pole(temperature, vogel_c) - vogel_c)))


def _above_pole(temperature: ArrayLike | None, vogel_c: float) -> Array:
    """Temperature [K] above the pole of Vogel's law."""
    at = required(temperature, "atmospheric_law 'vogel'")
    within(at, "atmospheric_law 'vogel'", vogel_c, math.inf, "its pole is vogel_c")
    return at


def vogel_coefficient(
    temperature: ArrayLike, *, vogel_viscosity: float, vogel_b: float, vogel_c: float
) -> Array:
    """Temperature coefficient of the viscosity after Vogel, -d ln(eta)/dT = B/(T - C)^2, in 1/K.
    ``temperature`` [K], shape (...).

    Examples
    --------
    >>> fva3 = dict(vogel_viscosity=6.2e-5, vogel_b=1021.7, vogel_c=171.5983)
    >>> round(float(vogel_coefficient(353.15, **fva3)), 4)
    0.031
    """
    return np.asarray(vogel_b / (_above_pole(temperature, vogel_c) - vogel_c) ** 2)


def vogel_temperature(
    viscosity: ArrayLike, *, vogel_viscosity: float, vogel_b: float, vogel_c: float
) -> Array:
    """Temperature [K] at which an oil of Vogel's law has a viscosity; the inverse of ``vogel``. ``viscosity``
    [Pa s], shape (...). Raises InputError if no temperature has the viscosity.

    Examples
    --------
    >>> fva3 = dict(vogel_viscosity=6.2e-5, vogel_b=1021.7, vogel_c=171.5983)
    >>> round(float(vogel_temperature(0.08454, **fva3)), 2)
    313.15
    """
    eta = np.asarray(viscosity, dtype=float)
    if wrong := refused(eta, eta > vogel_viscosity, "Pa s"):
        raise InputError(
            "viscosity",
            got=f"{wrong};",
            takes=f"above {vogel_viscosity:g} Pa s, the range of atmospheric_law 'vogel'",
        )
    return np.asarray(vogel_c + vogel_b / np.log(eta / vogel_viscosity))


def roelands_over_temperature(
    temperature: ArrayLike | None, *, viscosity: float, reference_temperature: float, roelands_s0: float
) -> Array:
    """Viscosity at ambient pressure after Roelands.

    ln eta + 9.67 = (ln eta_ref + 9.67) ((T - 138 K)/(T_ref - 138 K))^-S0, with viscosities in Pa s.

    ``temperature`` [K], shape (...); ``viscosity``, viscosity eta_ref at the reference temperature [Pa s];
    ``reference_temperature``, reference temperature T_ref [K]; ``roelands_s0``, slope index S0,
    dimensionless. Returns viscosity eta [Pa s], shape (...). Raises InputError if the temperature is missing
    or not above 138 K, or the viscosity is below the pole of 6.3e-5 Pa s.

    C. J. A. Roelands, Correlational aspects of the viscosity-temperature-pressure relationship of
    lubricating oils, thesis, Delft, 1966. The pressure-viscosity coefficient at the temperature follows from
    the viscosity by ``viscosity.roelands_alpha``.

    Examples
    --------
    >>> oil = dict(viscosity=0.04, reference_temperature=313.15, roelands_s0=1.1)
    >>> roelands_over_temperature([313.15, 353.15], **oil).round(4).tolist()
    [0.04, 0.0108]
    """
    reduced = _reduced(viscosity)
    ratio = (_above_138(temperature) - ROELANDS_TEMPERATURE) / (_distance(reference_temperature))
    return np.asarray(np.exp(reduced * ratio**-roelands_s0 - ROELANDS_CONSTANT))


def _above_138(temperature: ArrayLike | None) -> Array:
    """Temperature [K] above the pole of Roelands' law."""
    at = required(temperature, "atmospheric_law 'roelands'")
    within(at, "atmospheric_law 'roelands'", ROELANDS_TEMPERATURE, math.inf, "its pole")
    return at


def _distance(reference_temperature: float) -> float:
    """Difference of the reference temperature to the pole of Roelands' law [K]."""
    if reference_temperature <= ROELANDS_TEMPERATURE:
        raise InputError(
            "reference_temperature",
            got=f"{reference_temperature:g} K",
            takes=f"above {ROELANDS_TEMPERATURE:g} K, the pole of atmospheric_law 'roelands'",
        )
    return reference_temperature - ROELANDS_TEMPERATURE


def _reduced(viscosity: float | Array) -> Array:
    """Ln eta + 9.67 of Roelands' laws."""
    least = math.exp(-ROELANDS_CONSTANT)
    eta = np.asarray(viscosity, dtype=float)
    if wrong := refused(eta, eta > least, "Pa s"):
        raise InputError(
            "viscosity",
            got=f"{wrong};",
            takes=f"above {least:.2g} Pa s, the range of atmospheric_law 'roelands'",
        )
    return np.asarray(np.log(eta) + ROELANDS_CONSTANT)


def roelands_coefficient(
    temperature: ArrayLike, *, viscosity: float, reference_temperature: float, roelands_s0: float
) -> Array:
    """Temperature coefficient after Roelands, -d ln(eta)/dT = S0 (ln eta + 9.67)/(T - 138 K), in 1/K.
    ``temperature`` [K], shape (...).

    Examples
    --------
    >>> oil = dict(viscosity=0.04, reference_temperature=313.15, roelands_s0=1.1)
    >>> round(float(roelands_coefficient(313.15, **oil)), 4)
    0.0405
    """
    at = _above_138(temperature)
    eta = roelands_over_temperature(
        at, viscosity=viscosity, reference_temperature=reference_temperature, roelands_s0=roelands_s0
    )
    return np.asarray(roelands_s0 * (np.log(eta) + ROELANDS_CONSTANT) / (at - ROELANDS_TEMPERATURE))


def roelands_temperature(
    value: ArrayLike, *, viscosity: float, reference_temperature: float, roelands_s0: float
) -> Array:
    """Temperature [K] at which an oil has a viscosity; the inverse of ``roelands_over_temperature``.
    ``value`` [Pa s], shape (...). Raises InputError if no temperature has the viscosity.

    Examples
    --------
    >>> oil = dict(viscosity=0.04, reference_temperature=313.15, roelands_s0=1.1)
    >>> round(float(roelands_temperature(0.04, **oil)), 2)
    313.15
    """
    ratio = _reduced(np.asarray(value, dtype=float)) / _reduced(viscosity)
    return np.asarray(ROELANDS_TEMPERATURE + _distance(reference_temperature) * ratio ** (-1.0 / roelands_s0))


ATMOSPHERIC_LAWS = {
    "vogel": Law(
        vogel,
        parameters_of(vogel),
        needs_temperature=True,
        coefficient=vogel_coefficient,
        inverse=vogel_temperature,
    ),
    "roelands": Law(
        roelands_over_temperature,
        parameters_of(roelands_over_temperature),
        needs_temperature=True,
        coefficient=roelands_coefficient,
        inverse=roelands_temperature,
    ),
}


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

    Examples
    --------
    >>> oil = Walther.of(46e-6, 6.8e-6)
    >>> round(oil.viscosity(343.15) * 1e6, 2)
    14.85
    """

    # a and b: constants A and B, dimensionless.
    a: float
    b: float

    @classmethod
    def of(cls, at_40: float, at_100: float) -> Walther:
        """Walther equation of an oil from its kinematic viscosities at 40 and 100 degC [m^2/s]. Raises
        InputError if the viscosity does not fall with temperature, or is too low for the equation.
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
        """Kinematic viscosity [m^2/s] at an absolute temperature [K]. Raises InputError if the viscosity is
        too low for the equation, or the oil is solid at this temperature.
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
