"""Permittivity laws of the lubricant: relative permittivity over density ratio and temperature."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ehlectric.arrays import Array
from ehlectric.errors import InputError
from ehlectric.lubricant.law import Law, Parameter


def clausius_mossotti(
    density_ratio: ArrayLike, temperature: ArrayLike | None = None, *, relative_permittivity: float
) -> Array:
    """Relative permittivity of a compressed dielectric liquid after Clausius and Mossotti.

    eps = (eps_r + 2 + 2 (eps_r - 1) rho/rho0)/(eps_r + 2 - (eps_r - 1) rho/rho0)

    Parameters
    ----------
    density_ratio : array_like, shape (...)
        Density over the density at zero pressure, rho/rho0, dimensionless, > 0.
    temperature : array_like, optional
        Temperature [K]. The law ignores it: temperature acts through the density.
    relative_permittivity : float
        Relative permittivity eps_r at the density rho0, dimensionless, >= 1.

    Returns
    -------
    ndarray, shape (...)
        Relative permittivity, dimensionless.

    Raises
    ------
    InputError
        If the density ratio reaches the pole of the law, (eps_r + 2)/(eps_r - 1).

    Notes
    -----
    Eq. (14) of Morris et al. (2022), doi:10.3390/lubricants10050087. The law holds for molecules without a
    dipole moment. For polar liquids use ``constant_permittivity``.

    Examples
    --------
    >>> round(float(clausius_mossotti(1.2138, relative_permittivity=2.4)), 3)
    2.888
    """
    rho = np.asarray(density_ratio, dtype=float)
    denominator = relative_permittivity + 2.0 - (relative_permittivity - 1.0) * rho
    if np.any(denominator <= 0.0):
        raise InputError.worded(
            "lubricant.permittivity_law",
            "'clausius-mossotti' has a pole at the density ratio "
            f"{(relative_permittivity + 2.0) / (relative_permittivity - 1.0):.4g}, and the film "
            f"reaches {np.max(rho):.4g}; a polar liquid takes 'constant'",
            takes="'constant'",
        )
    return (relative_permittivity + 2.0 + 2.0 * (relative_permittivity - 1.0) * rho) / denominator


def constant_permittivity(
    density_ratio: ArrayLike, temperature: ArrayLike | None = None, *, relative_permittivity: float
) -> Array:
    """Relative permittivity that does not change with density.

    Parameters
    ----------
    density_ratio : array_like, shape (...)
        Density over the density at zero pressure, rho/rho0, dimensionless. The law uses only its shape.
    temperature : array_like, optional
        Temperature [K]. The law is isothermal and ignores it.
    relative_permittivity : float
        Relative permittivity eps_r, dimensionless.

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


RELATIVE_PERMITTIVITY = Parameter(
    "relative_permittivity",
    "",
    least=1.0,
    most=1e3,
    reason="vacuum has 1, oils 2 to 5, water 80",
)

PERMITTIVITY_LAWS = {
    "clausius-mossotti": Law(clausius_mossotti, (RELATIVE_PERMITTIVITY,)),
    "constant": Law(constant_permittivity, (RELATIVE_PERMITTIVITY,)),
}
