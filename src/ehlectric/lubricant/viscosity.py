"""Viscosity laws of the lubricant over pressure and temperature, their pressure-viscosity coefficients,
and glass.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from ehlectric.arrays import Array, Numbers, as_float
from ehlectric.lubricant.doolittle import DOOLITTLE
from ehlectric.lubricant.law import Derivation, Law, PressureLaw, parameter
from ehlectric.lubricant.modulus import MODULUS
from ehlectric.lubricant.yasutomi import YASUTOMI
from ehlectric.quantities.result_warnings import ResultWarning

# Constant of Roelands' law in ln(eta0) + 9.67, with the viscosity eta0 at zero pressure in Pa s.
ROELANDS_CONSTANT = 9.67


def roelands_exponent(
    viscosity: Numbers, pressure_viscosity_coefficient: Numbers, roelands_pressure: Numbers
) -> Numbers:
    """Exponent z of Roelands' law from viscosity and pressure-viscosity coefficient.

    z = alpha p0/(ln eta0 + 9.67), with eta0 in Pa s.

    ``viscosity``, viscosity eta0 at zero pressure [Pa s]; ``pressure_viscosity_coefficient``, slope alpha of
    ln eta at zero pressure [1/Pa]; ``roelands_pressure``, constant p0 [Pa]; floats, or arrays of shape (...).
    Returns exponent z, dimensionless, shape (...); infinite for a viscosity below the pole of the relation at
    6.3e-5 Pa s.

    C. J. A. Roelands, Correlational aspects of the viscosity-temperature-pressure relationship of
    lubricating oils, thesis, Delft, 1966.

    Examples
    --------
    >>> round(roelands_exponent(0.04, 22e-9, 0.198e9), 3)
    0.675
    """
    reduced = np.log(viscosity) + ROELANDS_CONSTANT
    below = reduced <= 0.0
    exponent = pressure_viscosity_coefficient * roelands_pressure / np.where(below, 1.0, reduced)
    return as_float(np.where(below, math.inf, exponent))


def roelands_alpha(viscosity: Numbers, roelands_z: Numbers, roelands_pressure: Numbers) -> Numbers:
    """Pressure-viscosity coefficient of Roelands' law from the viscosity at a temperature.

    alpha = z (ln eta0 + 9.67)/p0, with eta0 in Pa s.

    ``viscosity``, viscosity eta0 at zero pressure and at this temperature [Pa s]; ``roelands_z``, exponent z,
    dimensionless, almost independent of temperature; ``roelands_pressure``, constant p0 [Pa]; floats, or
    arrays of shape (...). Returns pressure-viscosity coefficient alpha [1/Pa], shape (...).

    C. J. A. Roelands, Correlational aspects of the viscosity-temperature-pressure relationship of
    lubricating oils, thesis, Delft, 1966.

    Examples
    --------
    >>> round(roelands_alpha(0.04, 0.67, 0.198e9) * 1e9, 2)
    21.83
    """
    return as_float(roelands_z * (np.log(viscosity) + ROELANDS_CONSTANT) / roelands_pressure)


def roelands(
    pressure: ArrayLike,
    temperature: ArrayLike | None = None,
    *,
    pressure_viscosity_coefficient: Numbers,
    roelands_z: Numbers,
    roelands_pressure: Numbers,
) -> tuple[Array, Array]:
    """Logarithm of the relative viscosity after Roelands, and its derivative by pressure.

    ln(eta/eta0) = (alpha p0/z) ((1 + p/p0)^z - 1), with the viscosity eta0 at zero pressure.

    ``pressure`` [Pa], shape (...); ``temperature`` [K]; ``pressure_viscosity_coefficient``, slope alpha of ln
    eta at zero pressure [1/Pa]; ``roelands_z``, exponent z, dimensionless; ``roelands_pressure``, constant p0
    [Pa]. Returns ln(eta/eta0), dimensionless, and its derivative by pressure [1/Pa], shape (...).

    Eq. (13) of Morris et al. (2022), doi:10.3390/lubricants10050087, after C. J. A. Roelands,
    Correlational aspects of the viscosity-temperature-pressure relationship of lubricating oils, PhD
    thesis, TU Delft, 1966.

    Examples
    --------
    >>> law = dict(pressure_viscosity_coefficient=22e-9, roelands_z=0.67, roelands_pressure=0.198e9)
    >>> exponent, slope = roelands(1e9, **law)
    >>> round(float(exponent), 2)
    15.22
    """
    ratio = 1.0 + np.asarray(pressure, dtype=float) / roelands_pressure
    power = ratio**roelands_z
    exponent = pressure_viscosity_coefficient * roelands_pressure / roelands_z * (power - 1.0)
    return exponent, pressure_viscosity_coefficient * power / ratio


def barus(
    pressure: ArrayLike, temperature: ArrayLike | None = None, *, pressure_viscosity_coefficient: Numbers
) -> tuple[Array, Array]:
    """Logarithm of the relative viscosity after Barus, and its derivative by pressure.

    ln(eta/eta0) = alpha p, with the viscosity eta0 at zero pressure.

    ``pressure`` [Pa], shape (...); ``temperature`` [K]; ``pressure_viscosity_coefficient``, slope alpha of ln
    eta [1/Pa]. Returns ln(eta/eta0), dimensionless, and its derivative by pressure [1/Pa], shape (...).

    C. Barus, Am. J. Sci. 45 (1893) 87, doi:10.2475/ajs.s3-45.266.87. Above about 0.5 GPa the law
    overestimates the viscosity by orders of magnitude.

    Examples
    --------
    >>> float(barus(1e9, pressure_viscosity_coefficient=22e-9)[0])
    22.0
    """
    p = np.asarray(pressure, dtype=float)
    return pressure_viscosity_coefficient * p, np.zeros_like(p) + pressure_viscosity_coefficient


def constant_viscosity(pressure: ArrayLike, temperature: ArrayLike | None = None) -> tuple[Array, Array]:
    """Logarithm of the relative viscosity of an isoviscous lubricant, and its derivative; both are zero.
    ``pressure`` [Pa], shape (...); ``temperature`` [K]. Returns ln(eta/eta0), dimensionless, and its
    derivative [1/Pa]; zeros, shape (...).

    Examples
    --------
    >>> float(constant_viscosity(1e9)[0])
    0.0
    """
    p = np.asarray(pressure, dtype=float)
    return np.zeros_like(p), np.zeros_like(p)


def _barus_warnings(
    max_pressure: float, viscosity: float, temperature: float | None = None, **parameters: float
) -> Iterator[ResultWarning]:
    """Warning about Barus' law at a high Hertz pressure ``max_pressure`` [Pa]."""
    if max_pressure > 0.5e9:
        yield ResultWarning.of("law-range", "barus")


def _roelands_warnings(
    max_pressure: float,
    viscosity: float,
    temperature: float | None = None,
    *,
    roelands_z: float,
    **others: float,
) -> Iterator[ResultWarning]:
    """Warning about an exponent that differs by more than 10 % from Roelands' relation."""
    z = float(roelands_exponent(viscosity, **others))
    if abs(z / roelands_z - 1.0) > 0.1:
        yield ResultWarning.of("roelands-z", given=roelands_z, relation=z)


def _roelands_hint(viscosity: Numbers, given: Mapping[str, Numbers]) -> str:
    """Text with the exponent of Roelands' relation, if the exponent is the only missing parameter."""
    if given.keys() != {"pressure_viscosity_coefficient", "roelands_pressure"}:
        return ""
    z = float(roelands_exponent(viscosity, **given))
    if not math.isfinite(z):
        return ""
    return (
        "; Roelands' relation pressure_viscosity_coefficient roelands_pressure/(ln viscosity + "
        f"{ROELANDS_CONSTANT}) gives {z:.3g}"
    )


_ALPHA = replace(
    parameter("pressure_viscosity_coefficient"),
    derivation=Derivation(roelands_alpha, ("roelands_z", "roelands_pressure")),
)
_ROELANDS_Z = parameter("roelands_z")
_ROELANDS_PRESSURE = parameter("roelands_pressure")

VISCOSITY_LAWS = {
    "roelands": Law(
        roelands, (_ALPHA, _ROELANDS_Z, _ROELANDS_PRESSURE), warnings=_roelands_warnings, hint=_roelands_hint
    ),
    "barus": Law(barus, (_ALPHA,), warnings=_barus_warnings),
    "modulus": MODULUS,
    "yasutomi": YASUTOMI,
    "doolittle": DOOLITTLE,
    "constant": Law(constant_viscosity),
}


# Pressures among which the one is sought that raises the viscosity e times [Pa].
_SOUGHT = np.geomspace(1e5, 1e10, 101)

# Ends of the intervals of the quadrature, over the pressure that raises the viscosity e times. The last one
# is about 10 GPa for an oil: laws that saturate would never end.
_ENDS = np.concatenate([np.linspace(0.0, 40.0, 41), np.geomspace(40.0, 200.0, 17)[1:]])

# Places and weights of Gauss-Legendre quadrature with 8 nodes in each interval, over the same pressure.
_NODES, _OF_NODES = np.polynomial.legendre.leggauss(8)
_PLACES = np.add(0.5 * (_ENDS[1:] + _ENDS[:-1]), np.multiply.outer(_NODES, 0.5 * np.diff(_ENDS))).T.ravel()
_WEIGHTS = np.outer(0.5 * np.diff(_ENDS), _OF_NODES).ravel()

# Largest number of pressures times points at which the quadrature calls a law at once; it fits the cache.
_AT_ONCE = 2**15


def initial_alpha(law: PressureLaw) -> Numbers:
    """Pressure-viscosity coefficient alpha at zero pressure, the slope of ln(eta), in 1/Pa. ``law``,
    ln(eta/eta0) and its derivative by pressure [1/Pa], as a function of the pressure [Pa]. Returns a float,
    or an array of shape (...) for a law whose parameters have this shape.

    Examples
    --------
    >>> from ehlectric.lubricant.viscosity import barus
    >>> initial_alpha(lambda pressure: barus(pressure, pressure_viscosity_coefficient=2e-8))
    2e-08
    """
    return as_float(law(np.zeros(()))[1])


def reciprocal_asymptotic_alpha(law: PressureLaw) -> Numbers:
    """Reciprocal asymptotic pressure-viscosity coefficient alpha*, in 1/Pa.

    alpha* = 1/Int_0^inf eta(0)/eta(p) dp, which film formulas take.

    ``law``, ln(eta/eta0) and its derivative by pressure [1/Pa], as a function of the pressure [Pa]. Its
    parameters are floats, or arrays of shape (...); then it is called with pressures of shape (k, ...).
    Returns coefficient alpha* [1/Pa], a float or an array of shape (...); zero for a viscosity that does not
    rise with pressure, and NaN for a law that has no value.

    S. Bair, High-Pressure Rheology for Quantitative Elastohydrodynamics, Elsevier, 2007, after Blok (1963).
    The integral ends at about 200 times the pressure that raises the viscosity e times, about 10 GPa, because
    laws that saturate or are capped have no finite integral. There the integrand of an oil is below 1e-8.

    Examples
    --------
    >>> from ehlectric.lubricant.viscosity import barus
    >>> round(reciprocal_asymptotic_alpha(lambda p: barus(p, pressure_viscosity_coefficient=2e-8)) * 1e9, 9)
    20.0
    """
    scale = _scale(law)
    rises = scale != math.inf
    return as_float(rises / _integral(law, np.where(rises, scale, 1.0)))


def unfinished_share(law: PressureLaw) -> Numbers:
    """Return the largest share that another pressure range of equal length would add to the alpha* integral.
    ``law``, ln(eta/eta0) and its derivative by pressure [1/Pa], as a function of the pressure [Pa]. Returns
    share, dimensionless, a float or an array of shape (...) as ``reciprocal_asymptotic_alpha`` does; far
    below 1e-4 for an oil.

    Examples
    --------
    >>> from ehlectric.lubricant.viscosity import barus
    >>> unfinished_share(lambda p: barus(p, pressure_viscosity_coefficient=2e-8)) < 1e-12
    True
    """
    scale = _scale(law)
    rises = scale != math.inf
    scale = np.where(rises, scale, 1.0)
    end = scale * _ENDS[-1]
    left = end * np.exp(-np.asarray(law(end[np.newaxis])[0], dtype=float)[0])
    return as_float(rises * left / _integral(law, scale))


def _scale(law: PressureLaw) -> Array:
    """Pressure that raises the viscosity about e times [Pa], shape (...); infinite if it does not rise."""
    axes = np.ndim(law(np.zeros(()))[0]) if getattr(law, "many", True) else 0
    exponent = np.asarray(law(_SOUGHT.reshape(-1, *[1] * axes))[0], dtype=float)
    above = exponent >= 1.0
    scale, reached = _SOUGHT[above.argmax(axis=0)], above.any(axis=0)
    if reached.all():
        return np.asarray(scale)
    last = exponent[-1]
    rises = last > 0.0
    slow = np.where(rises, _SOUGHT[-1] / np.where(rises, last, 1.0), math.inf)
    return np.where(np.isnan(last), math.nan, np.where(reached, scale, slow))


def _integral(law: PressureLaw, scale: Array) -> Array:
    """Integral of eta(0)/eta(p) over pressure [Pa], shape (...), by Gauss-Legendre quadrature over the
    pressure that raises the viscosity e times [Pa], shape (...).
    """
    total, step = np.zeros(scale.size), max(1, _AT_ONCE // scale.size)
    for k in range(0, _PLACES.size, step):
        pressure = np.multiply.outer(_PLACES[k : k + step], scale)
        exponent = np.reshape(law(pressure)[0], (-1, scale.size))
        total += _WEIGHTS[k : k + step] @ np.exp(-exponent)
    return total.reshape(scale.shape) * scale
