"""Density laws of the lubricant: density over that at zero pressure and the same temperature."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ehlectric.arrays import Array
from ehlectric.errors import InputError
from ehlectric.lubricant.equation_of_state import MURNAGHAN, TAIT
from ehlectric.lubricant.law import Law, Parameter, refused


def dowson_higginson(
    pressure: ArrayLike, temperature: ArrayLike | None = None, *, density_c1: float, density_c2: float
) -> tuple[Array, Array]:
    """Density ratio after Dowson and Higginson, and its derivative by pressure.

    rho/rho0 = (C1 + C2 p)/(C1 + p), with the density rho0 at zero pressure.

    Parameters
    ----------
    pressure : array_like, shape (...)
        Pressure p [Pa], >= 0.
    temperature : array_like, optional
        Temperature [K]. The law is isothermal and ignores it.
    density_c1 : float
        Constant C1 [Pa].
    density_c2 : float
        Constant C2, the density ratio at infinite pressure, dimensionless.

    Returns
    -------
    ratio, slope : ndarray, shape (...)
        Density ratio rho/rho0, dimensionless, and its derivative by pressure [1/Pa].

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


def dowson_higginson_pressure(
    density_ratio: ArrayLike, temperature: ArrayLike | None = None, *, density_c1: float, density_c2: float
) -> Array:
    """Pressure [Pa] of a density ratio after Dowson and Higginson; the inverse of ``dowson_higginson``.

    Parameters
    ----------
    density_ratio : array_like, shape (...)
        Density over that at zero pressure, dimensionless, from 1 to below C2.
    temperature : array_like, optional
        Temperature [K]. The law is isothermal and ignores it.
    density_c1, density_c2 : float
        Parameters of ``dowson_higginson``.

    Raises
    ------
    InputError
        If no pressure has the density ratio.

    Examples
    --------
    >>> round(float(dowson_higginson_pressure(1.2138, density_c1=0.59e9, density_c2=1.34)) / 1e9, 2)
    1.0
    """
    ratio = np.asarray(density_ratio, dtype=float)
    if wrong := refused(ratio, (ratio >= 1.0) & (ratio < density_c2), ""):
        raise InputError(
            "density_ratio",
            got=f"{wrong};",
            takes=f"from 1 to below {density_c2:g}, the range of density_law 'dowson-higginson'",
        )
    return density_c1 * (ratio - 1.0) / (density_c2 - ratio)


def incompressible(pressure: ArrayLike, temperature: ArrayLike | None = None) -> tuple[Array, Array]:
    """Density ratio of an incompressible lubricant, which is one, and its derivative, which is zero.

    Parameters
    ----------
    pressure : array_like, shape (...)
        Pressure [Pa].
    temperature : array_like, optional
        Temperature [K]. The law is isothermal and ignores it.

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


_C1 = Parameter(
    "density_c1",
    "Pa",
    title="Dowson and Higginson's first constant",
    symbol="$C_1$",
    meaning="$C_1$ of Dowson and Higginson",
    least=1e7,
    most=1e11,
    reason="an oil has 0.59 GPa",
)
_C2 = Parameter(
    "density_c2",
    "",
    title="Dowson and Higginson's second constant",
    symbol="$C_2$",
    meaning="$C_2$ of Dowson and Higginson",
    least=1.0,
    most=3.0,
    reason="the density ratio at unlimited pressure",
)

DENSITY_LAWS = {
    "dowson-higginson": Law(dowson_higginson, (_C1, _C2), inverse=dowson_higginson_pressure),
    "incompressible": Law(incompressible),
    "tait": TAIT,
    "murnaghan": MURNAGHAN,
}
