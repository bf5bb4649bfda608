"""Viscosity of the lubricant over pressure: pure functions."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from ehlectric.arrays import Array
from ehlectric.lubricant.law import Law

# Roelands' reduced form of the viscosity at zero pressure, ln(eta0) + 9.67, with eta0 in Pa s.
ROELANDS_CONSTANT = 9.67


def roelands_exponent(
    viscosity: float, pressure_viscosity_coefficient: float, roelands_pressure: float
) -> float:
    """Exponent z that belongs to a viscosity and its slope, z = alpha p0/(ln eta0 + 9.67).

    Parameters
    ----------
    viscosity : float
        eta0 at zero pressure [Pa s].
    pressure_viscosity_coefficient, roelands_pressure : float
        alpha [1/Pa] and p0 [Pa].

    Returns
    -------
    float
        Dimensionless; infinite where the viscosity is below that of Roelands' pole, 6.3e-5 Pa s.

    Notes
    -----
    C. J. A. Roelands, Correlational aspects of the viscosity-temperature-pressure relationship of
    lubricating oils, thesis, Delft, 1966.

    Examples
    --------
    >>> round(roelands_exponent(0.04, 22e-9, 0.198e9), 3)
    0.675
    """
    reduced = math.log(viscosity) + ROELANDS_CONSTANT
    return pressure_viscosity_coefficient * roelands_pressure / reduced if reduced > 0.0 else math.inf


def roelands(
    pressure: ArrayLike,
    *,
    pressure_viscosity_coefficient: float,
    roelands_z: float,
    roelands_pressure: float,
) -> tuple[Array, Array]:
    """Logarithm of the relative viscosity after Roelands, and its derivative.

    ln(eta/eta0) = (alpha p0/z) ((1 + p/p0)^z - 1)

    Parameters
    ----------
    pressure : array_like, shape (...)
        Pressure p [Pa], >= 0.
    pressure_viscosity_coefficient : float
        alpha, the slope of ln eta at p = 0 [1/Pa].
    roelands_z : float
        Exponent z, dimensionless.
    roelands_pressure : float
        Constant p0 [Pa].

    Returns
    -------
    exponent, slope : ndarray, shape (...)
        ln(eta/eta0), dimensionless, and its derivative [1/Pa].

    Notes
    -----
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


def barus(pressure: ArrayLike, *, pressure_viscosity_coefficient: float) -> tuple[Array, Array]:
    """Logarithm of the relative viscosity after Barus, and its derivative.

    ln(eta/eta0) = alpha p

    Parameters
    ----------
    pressure : array_like, shape (...)
        Pressure p [Pa], >= 0.
    pressure_viscosity_coefficient : float
        alpha [1/Pa].

    Returns
    -------
    exponent, slope : ndarray, shape (...)
        ln(eta/eta0), dimensionless, and its derivative [1/Pa].

    Notes
    -----
    C. Barus, Am. J. Sci. 45 (1893) 87, doi:10.2475/ajs.s3-45.266.87. Above some 0.5 GPa it overstates the
    viscosity by orders of magnitude.

    Examples
    --------
    >>> float(barus(1e9, pressure_viscosity_coefficient=22e-9)[0])
    22.0
    """
    p = np.asarray(pressure, dtype=float)
    return pressure_viscosity_coefficient * p, np.full_like(p, pressure_viscosity_coefficient)


def constant_viscosity(pressure: ArrayLike) -> tuple[Array, Array]:
    """Logarithm of the relative viscosity of an isoviscous lubricant, and its derivative: zeros.

    Parameters
    ----------
    pressure : array_like, shape (...)
        Pressure [Pa].

    Returns
    -------
    exponent, slope : ndarray, shape (...)
        Zeros, dimensionless and [1/Pa].

    Examples
    --------
    >>> float(constant_viscosity(1e9)[0])
    0.0
    """
    p = np.asarray(pressure, dtype=float)
    return np.zeros_like(p), np.zeros_like(p)


VISCOSITY_LAWS = {
    "roelands": Law(roelands, ("pressure_viscosity_coefficient", "roelands_z", "roelands_pressure")),
    "barus": Law(barus, ("pressure_viscosity_coefficient",)),
    "constant": Law(constant_viscosity, ()),
}
