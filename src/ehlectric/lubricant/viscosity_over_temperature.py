"""Viscosity of an oil over temperature at ambient pressure: laws of Vogel, Roelands and Walther."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ehlectric.arrays import Array, Mask, Numbers, as_float
from ehlectric.errors import InputError
from ehlectric.lubricant.law import Law, parameters_of, within
from ehlectric.lubricant.viscosity import ROELANDS_CONSTANT

# Temperature of the pole of Roelands' law [K], -135 degC.
ROELANDS_TEMPERATURE = 138.0


def vogel(
    temperature: ArrayLike | None, *, vogel_viscosity: Numbers, vogel_b: Numbers, vogel_c: Numbers
) -> Array:
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
    at = within(temperature, "atmospheric_law 'vogel'", vogel_c, math.inf, "its pole is vogel_c")
    return np.asarray(vogel_viscosity * np.exp(vogel_b / (at - vogel_c)))


def roelands_over_temperature(
    temperature: ArrayLike | None, *, viscosity: Numbers, reference_temperature: Numbers, roelands_s0: Numbers
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
    law, least = "atmospheric_law 'roelands'", math.exp(-ROELANDS_CONSTANT)
    # Points with such parameters have no temperature at which the law holds.
    if np.ndim(viscosity) == 0 and not viscosity > least:
        takes = f"above {least:.2g} Pa s, the range of {law}"
        raise InputError("viscosity", got=f"{viscosity:.5g} Pa s;", takes=takes)
    at = within(temperature, law, ROELANDS_TEMPERATURE, math.inf, "its pole")
    if np.ndim(reference_temperature) == 0 and reference_temperature <= ROELANDS_TEMPERATURE:
        takes = f"above {ROELANDS_TEMPERATURE:g} K, the pole of {law}"
        raise InputError("reference_temperature", got=f"{reference_temperature:g} K", takes=takes)
    ratio = (at - ROELANDS_TEMPERATURE) / (reference_temperature - ROELANDS_TEMPERATURE)
    reduced = np.log(viscosity) + ROELANDS_CONSTANT
    return np.asarray(np.exp(reduced * ratio**-roelands_s0 - ROELANDS_CONSTANT))


def _vogel_holds(temperature: Array, *, vogel_c: Numbers, **_others: Numbers) -> Mask:
    """Whether temperatures [K] are above the pole."""
    return np.asarray(temperature > vogel_c)


def _roelands_holds(
    temperature: Array, *, viscosity: Numbers, reference_temperature: Numbers, roelands_s0: Numbers
) -> Mask:
    """Whether temperatures [K], reference temperature and viscosity are above the poles."""
    above = np.greater(viscosity, math.exp(-ROELANDS_CONSTANT)) & (temperature > ROELANDS_TEMPERATURE)
    return np.asarray(above & np.greater(reference_temperature, ROELANDS_TEMPERATURE))


ATMOSPHERIC_LAWS = {
    "vogel": Law(vogel, parameters_of(vogel), needs_temperature=True, holds=_vogel_holds),
    "roelands": Law(
        roelands_over_temperature,
        parameters_of(roelands_over_temperature),
        needs_temperature=True,
        holds=_roelands_holds,
    ),
}


# 40 and 100 degC as absolute temperatures [K].
COLD, HOT = 313.15, 373.15

# Smallest kinematic viscosity of ASTM D341 [mm^2/s].
_LEAST = 0.21

# log10(Z) above which an oil counts as solid.
_SOLID = 300.0

# Steps of Newton's method, with which the viscosity of 0.21 mm^2/s has an error of 1e-15.
_STEPS = 5


def _z(nu: Numbers) -> Numbers:
    """Z of ASTM D341 from the kinematic viscosity [mm^2/s]."""
    return nu + 0.7 + np.exp(-1.47 - 1.84 * nu - 0.51 * np.square(nu))


def _nu(z: Numbers) -> Numbers:
    """Kinematic viscosity [mm^2/s] from Z, by Newton's method from the inverse of the standard."""
    short = np.minimum(z - 0.7, 20.0)
    nu = z - 0.7 - np.exp(-0.7487 - 3.295 * short + 0.6119 * short**2 - 0.3193 * short**3)
    for _ in range(_STEPS):
        slope = 1.0 - (1.84 + 1.02 * nu) * np.exp(-1.47 - 1.84 * nu - 0.51 * np.square(nu))
        nu = nu - (_z(nu) - z) / slope
    return nu


@dataclass(frozen=True)
class Walther:
    """Kinematic viscosity of an oil over temperature, after ASTM D341 (Walther's equation).

    log10 log10 Z = A - B log10 T, with Z = nu + 0.7 + exp(-1.47 - 1.84 nu - 0.51 nu^2), nu in mm^2/s and T in
    K. This form holds for nu of 0.21 mm^2/s and more. From 2 mm^2/s on, the exponential is below 0.001.

    ASTM D341-09, Standard Practice for Viscosity-Temperature Charts for Liquid Petroleum Products, as public
    programs quote it. Earlier editions have six exponentials, and nu then differs by 2 % at most from 0.3
    mm^2/s on.

    Examples
    --------
    >>> oil = Walther.of(46e-6, 6.8e-6)
    >>> round(oil.viscosity(343.15) * 1e6, 2)
    14.85
    >>> round(Walther.of(9.5e-6, 2.6e-6).viscosity(393.15) * 1e6, 2)
    1.96
    """

    # a and b: constants A and B, dimensionless; floats, or arrays of shape (...) of many oils.
    a: Numbers
    b: Numbers

    @classmethod
    def of(cls, at_40: Numbers, at_100: Numbers) -> Walther:
        """Walther equation of an oil from its kinematic viscosities at 40 and 100 degC [m^2/s]. Raises
        InputError as ``through`` does.
        """
        return cls.through((COLD, at_40), (HOT, at_100))

    @classmethod
    def through(
        cls,
        first: tuple[Numbers, Numbers],
        second: tuple[Numbers, Numbers],
        key: str = "temperature.kinematic_viscosity_100",
    ) -> Walther:
        """Walther equation of an oil through two points.

        ``first`` and ``second``, absolute temperature [K] and kinematic viscosity [m^2/s] of both points;
        ``key``, key of the second viscosity, for messages. Raises InputError if the viscosity does not fall
        with temperature, or is too low for the equation; of many oils, those have NaN.
        """
        swapped = np.less(second[0], first[0])
        # Temperature and viscosity of the colder and of the warmer point.
        (t_cold, cold), (t_hot, hot) = (
            [as_float(np.where(swapped, b, a)) for a, b in zip(either, opposite, strict=True)]
            for either, opposite in ((first, second), (second, first))
        )
        falls, thick = np.greater(cold, hot), np.greater_equal(hot, 1e-6 * _LEAST * (1.0 - 1e-12))
        known = falls & thick
        if np.ndim(known):
            cold, hot = np.where(known, cold, np.nan), np.where(known, hot, np.nan)
        elif not falls:
            takes = f"a viscosity that falls with temperature; it is {first[1]:g} m^2/s at {first[0]:g} K"
            raise InputError(key, got=f"{second[1]:g} m^2/s at {second[0]:g} K", takes=takes)
        elif not thick:
            takes = f"at least {1e-6 * _LEAST:g} m^2/s, the least of ASTM D341"
            raise InputError(key, got=f"{hot:g} m^2/s at {t_hot:g} K", takes=takes)
        log_cold, log_hot = (np.log10(np.log10(_z(1e6 * nu))) for nu in (cold, hot))
        b = (log_cold - log_hot) / np.log10(t_hot / t_cold)
        return cls(as_float(log_cold + b * np.log10(t_cold)), as_float(b))

    def viscosity(self, temperature: Numbers) -> Numbers:
        """Kinematic viscosity [m^2/s] at an absolute temperature [K], shape (...). Raises InputError if the
        viscosity is too low for the equation, or the oil is solid at this temperature; of many temperatures
        or oils, those where it is so have NaN.
        """
        double = 10.0 ** (self.a - self.b * np.log10(temperature))
        solid = double > _SOLID
        z = 10.0 ** np.where(solid, 0.0, double)
        thin = z < _z(_LEAST) * (1.0 - 1e-12)
        nu = _nu(np.where(thin, 10.0, z))
        if np.ndim(nu):
            return np.where(solid | thin, np.nan, 1e-6 * nu)
        if solid:
            raise InputError("temperature", got=f"{temperature:g} K, at which the oil is solid")
        if thin:
            raise InputError(
                "temperature",
                got=f"{temperature:g} K, at which the oil has less than {_LEAST:g} mm^2/s;",
                takes="a temperature with a higher viscosity; this is the minimum of ASTM D341",
            )
        return 1e-6 * float(nu)
