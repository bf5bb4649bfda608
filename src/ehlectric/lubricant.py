"""Viscosity, density and permittivity of the lubricant: pure functions of pressure.

Viscosity laws give ln(eta/eta0) and its derivative in pressure, density laws rho/rho0 and its
derivative: what Newton's method needs, and finite at any pressure. A law is chosen by its name from one
of the tables at the end of the file.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ehlectric.errors import InputError
from ehlectric.typing import Array

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


def dowson_higginson(pressure: ArrayLike, *, density_c1: float, density_c2: float) -> tuple[Array, Array]:
    """Density ratio after Dowson and Higginson, and its derivative.

    rho/rho0 = (C1 + C2 p)/(C1 + p)

    Parameters
    ----------
    pressure : array_like, shape (...)
        Pressure p [Pa], >= 0.
    density_c1 : float
        C1 [Pa].
    density_c2 : float
        C2, the ratio at unlimited pressure, dimensionless.

    Returns
    -------
    ratio, slope : ndarray, shape (...)
        rho/rho0, dimensionless, and its derivative [1/Pa].

    Notes
    -----
    Eq. (12) of Morris et al. (2022), doi:10.3390/lubricants10050087.

    Examples
    --------
    >>> round(float(dowson_higginson(1e9, density_c1=0.59e9, density_c2=1.34)[0]), 4)
    1.2138
    """
    p = np.asarray(pressure, dtype=float)
    total = density_c1 + p
    return (density_c1 + density_c2 * p) / total, (density_c2 - 1.0) * density_c1 / total**2


def incompressible(pressure: ArrayLike) -> tuple[Array, Array]:
    """Density ratio of an incompressible lubricant, and its derivative: ones and zeros.

    Parameters
    ----------
    pressure : array_like, shape (...)
        Pressure [Pa].

    Returns
    -------
    ratio, slope : ndarray, shape (...)
        Ones, dimensionless, and zeros [1/Pa].

    Examples
    --------
    >>> float(incompressible(1e9)[0])
    1.0
    """
    p = np.asarray(pressure, dtype=float)
    return np.ones_like(p), np.zeros_like(p)


def clausius_mossotti(density_ratio: ArrayLike, *, relative_permittivity: float) -> Array:
    """Relative permittivity of a compressed dielectric liquid.

    eps = (eps_r + 2 + 2 (eps_r - 1) rho)/(eps_r + 2 - (eps_r - 1) rho)

    Parameters
    ----------
    density_ratio : array_like, shape (...)
        rho/rho0, dimensionless, > 0.
    relative_permittivity : float
        eps_r at the reference density, dimensionless, >= 1.

    Returns
    -------
    ndarray, shape (...)
        Relative permittivity, dimensionless.

    Raises
    ------
    InputError
        Where the density reaches the pole of the law, (eps_r + 2)/(eps_r - 1).

    Notes
    -----
    Eq. (14) of Morris et al. (2022), doi:10.3390/lubricants10050087. The law is for molecules without a
    dipole moment; polar liquids need a constant.

    Examples
    --------
    >>> round(float(clausius_mossotti(1.2138, relative_permittivity=2.4)), 3)
    2.888
    """
    rho = np.asarray(density_ratio, dtype=float)
    denominator = relative_permittivity + 2.0 - (relative_permittivity - 1.0) * rho
    if np.any(denominator <= 0.0):
        raise InputError(
            "lubricant.permittivity_law: 'clausius-mossotti' has a pole at the density ratio "
            f"{(relative_permittivity + 2.0) / (relative_permittivity - 1.0):.4g}, and the film reaches "
            f"{np.max(rho):.4g}; a polar liquid takes 'constant'"
        )
    return (relative_permittivity + 2.0 + 2.0 * (relative_permittivity - 1.0) * rho) / denominator


def constant_permittivity(density_ratio: ArrayLike, *, relative_permittivity: float) -> Array:
    """Relative permittivity that does not change with density.

    Parameters
    ----------
    density_ratio : array_like, shape (...)
        rho/rho0, dimensionless.
    relative_permittivity : float
        eps_r, dimensionless.

    Returns
    -------
    ndarray, shape (...)
        Relative permittivity, dimensionless.

    Examples
    --------
    >>> float(constant_permittivity(1.2, relative_permittivity=2.4))
    2.4
    """
    return np.full_like(np.asarray(density_ratio, dtype=float), relative_permittivity)


@dataclass(frozen=True)
class Law:
    """A law and the names of the parameters it takes, which are those of the case file."""

    function: Callable[..., Any]
    parameters: tuple[str, ...]


VISCOSITY_LAWS = {
    "roelands": Law(roelands, ("pressure_viscosity_coefficient", "roelands_z", "roelands_pressure")),
    "barus": Law(barus, ("pressure_viscosity_coefficient",)),
    "constant": Law(constant_viscosity, ()),
}
DENSITY_LAWS = {
    "dowson-higginson": Law(dowson_higginson, ("density_c1", "density_c2")),
    "incompressible": Law(incompressible, ()),
}
PERMITTIVITY_LAWS = {
    "clausius-mossotti": Law(clausius_mossotti, ("relative_permittivity",)),
    "constant": Law(constant_permittivity, ("relative_permittivity",)),
}
