"""Density of the lubricant over pressure: pure functions."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ehlectric.arrays import Array
from ehlectric.lubricant.law import Law


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


DENSITY_LAWS = {
    "dowson-higginson": Law(dowson_higginson, ("density_c1", "density_c2")),
    "incompressible": Law(incompressible, ()),
}
