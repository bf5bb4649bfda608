"""Viscosity laws of the lubricant over pressure and temperature, their pressure-viscosity coefficients,
and glass.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from ehlectric.arrays import Array
from ehlectric.errors import ResultWarning
from ehlectric.lubricant.doolittle import DOOLITTLE
from ehlectric.lubricant.law import Derivation, Law, PressureLaw, parameter
from ehlectric.lubricant.modulus import MODULUS
from ehlectric.lubricant.yasutomi import YASUTOMI

# Constant of Roelands' law in ln(eta0) + 9.67, with the viscosity eta0 at zero pressure in Pa s.
ROELANDS_CONSTANT = 9.67


def roelands_exponent(
    viscosity: float, pressure_viscosity_coefficient: float, roelands_pressure: float
) -> float:
    """Exponent z of Roelands' law from viscosity and pressure-viscosity coefficient.

    z = alpha p0/(ln eta0 + 9.67), with eta0 in Pa s.

    ``viscosity``, viscosity eta0 at zero pressure [Pa s]; ``pressure_viscosity_coefficient``, slope alpha of
    ln eta at zero pressure [1/Pa]; ``roelands_pressure``, constant p0 [Pa]. Returns exponent z,
    dimensionless; infinite for a viscosity below the pole of the relation at 6.3e-5 Pa s.

    C. J. A. Roelands, Correlational aspects of the viscosity-temperature-pressure relationship of
    lubricating oils, thesis, Delft, 1966.

    Examples
    --------
    >>> round(roelands_exponent(0.04, 22e-9, 0.198e9), 3)
    0.675
    """
    reduced = math.log(viscosity) + ROELANDS_CONSTANT
    return pressure_viscosity_coefficient * roelands_pressure / reduced if reduced > 0.0 else math.inf


def roelands_alpha(viscosity: float, roelands_z: float, roelands_pressure: float) -> float:
    """Pressure-viscosity coefficient of Roelands' law from the viscosity at a temperature.

    alpha = z (ln eta0 + 9.67)/p0, with eta0 in Pa s.

    ``viscosity``, viscosity eta0 at zero pressure and at this temperature [Pa s]; ``roelands_z``, exponent z,
    dimensionless; it hardly changes with temperature; ``roelands_pressure``, constant p0 [Pa]. Returns
    pressure-viscosity coefficient alpha [1/Pa].

    C. J. A. Roelands, Correlational aspects of the viscosity-temperature-pressure relationship of
    lubricating oils, thesis, Delft, 1966.

    Examples
    --------
    >>> round(roelands_alpha(0.04, 0.67, 0.198e9) * 1e9, 2)
    21.83
    """
    return roelands_z * (math.log(viscosity) + ROELANDS_CONSTANT) / roelands_pressure


def roelands(
    pressure: ArrayLike,
    temperature: ArrayLike | None = None,
    *,
    pressure_viscosity_coefficient: float,
    roelands_z: float,
    roelands_pressure: float,
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
    exponent = pressure_viscosity_coefficient * roelands_pressure / roelands_z * (ratio**roelands_z - 1.0)
    return exponent, pressure_viscosity_coefficient * ratio ** (roelands_z - 1.0)


def barus(
    pressure: ArrayLike, temperature: ArrayLike | None = None, *, pressure_viscosity_coefficient: float
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
    return pressure_viscosity_coefficient * p, np.full_like(p, pressure_viscosity_coefficient)


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
    z = roelands_exponent(viscosity, **others)
    if abs(z / roelands_z - 1.0) > 0.1:
        yield ResultWarning.of("roelands-z", given=roelands_z, relation=z)


def _roelands_hint(viscosity: float, given: Mapping[str, float]) -> str:
    """Text with the exponent of Roelands' relation, if the exponent is the only missing parameter."""
    if given.keys() != {"pressure_viscosity_coefficient", "roelands_pressure"}:
        return ""
    z = roelands_exponent(viscosity, **given)
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


_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(8)

# Pressures among which the one is sought that raises the viscosity e times [Pa].
_SOUGHT = np.geomspace(1e5, 1e10, 101)

# Ends of the intervals of the quadrature, over the pressure that raises the viscosity e times. The last one
# is about 10 GPa for an oil: laws that saturate would never end.
_ENDS = np.concatenate([np.linspace(0.0, 40.0, 41), np.geomspace(40.0, 200.0, 17)[1:]])


def initial_alpha(law: PressureLaw) -> float:
    """Pressure-viscosity coefficient alpha at zero pressure, the slope of ln(eta), in 1/Pa. ``law``,
    ln(eta/eta0) and its derivative by pressure [1/Pa], as a function of the pressure [Pa].

    Examples
    --------
    >>> from ehlectric.lubricant.viscosity import barus
    >>> initial_alpha(lambda pressure: barus(pressure, pressure_viscosity_coefficient=2e-8))
    2e-08
    """
    return float(law(np.zeros(1))[1][0])


def reciprocal_asymptotic_alpha(law: PressureLaw) -> float:
    """Reciprocal asymptotic pressure-viscosity coefficient alpha*, in 1/Pa.

    alpha* = 1/Int_0^inf eta(0)/eta(p) dp, which film formulas take.

    ``law``, ln(eta/eta0) and its derivative by pressure [1/Pa], as a function of the pressure [Pa]. Returns
    coefficient alpha* [1/Pa]; zero for a viscosity that does not rise with pressure.

    S. Bair, High-Pressure Rheology for Quantitative Elastohydrodynamics, Elsevier, 2007, after Blok (1963).
    The integral ends at some 200 times the pressure that raises the viscosity e times, about 10 GPa, because
    laws that saturate or are capped have no finite integral. There the integrand of an oil is below 1e-8.

    Examples
    --------
    >>> from ehlectric.lubricant.viscosity import barus
    >>> round(reciprocal_asymptotic_alpha(lambda p: barus(p, pressure_viscosity_coefficient=2e-8)) * 1e9, 9)
    20.0
    """
    scale = _scale(law)
    return 0.0 if scale == math.inf else 1.0 / _integral(law, scale * _ENDS)


def unfinished_share(law: PressureLaw) -> float:
    """Share of the integral of alpha* that a further range of pressure of the same length would add, at most.
    ``law``, ln(eta/eta0) and its derivative by pressure [1/Pa], as a function of the pressure [Pa]. Returns
    share, dimensionless; far below 1e-4 for an oil.

    Examples
    --------
    >>> from ehlectric.lubricant.viscosity import barus
    >>> unfinished_share(lambda p: barus(p, pressure_viscosity_coefficient=2e-8)) < 1e-12
    True
    """
    scale = _scale(law)
    if scale == math.inf:
        return 0.0
    end = scale * _ENDS[-1:]
    return float(end[0] * np.exp(-np.asarray(law(end)[0], dtype=float)[0]) * reciprocal_asymptotic_alpha(law))


def _scale(law: PressureLaw) -> float:
    """Pressure that raises the viscosity about e times [Pa]; infinite if the viscosity does not rise."""
    exponent = np.asarray(law(_SOUGHT)[0], dtype=float)
    above = np.flatnonzero(exponent >= 1.0)
    if above.size:
        return float(_SOUGHT[above[0]])
    return float(_SOUGHT[-1] / exponent[-1]) if exponent[-1] > 0.0 else math.inf


def _integral(law: PressureLaw, ends: Array) -> float:
    """Integral of eta(0)/eta(p) over pressure [Pa], by Gauss-Legendre quadrature between the ends [Pa]."""
    middle, half = 0.5 * (ends[1:] + ends[:-1]), 0.5 * np.diff(ends)
    pressure = middle[:, np.newaxis] + half[:, np.newaxis] * _NODES
    exponent = np.reshape(law(pressure.ravel())[0], pressure.shape)
    return float(half @ (np.exp(-exponent) @ _WEIGHTS))
