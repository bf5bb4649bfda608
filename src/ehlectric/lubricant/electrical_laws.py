"""Relative permittivity of an oil over density and temperature, and its electrical conductivity over
temperature.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ehlectric.arrays import Array, Numbers
from ehlectric.constants import GAS_CONSTANT
from ehlectric.errors import InputError
from ehlectric.lubricant.law import Law, parameter, parameters_of, required


def clausius_mossotti(
    density_ratio: ArrayLike, temperature: ArrayLike | None = None, *, relative_permittivity: Numbers
) -> Array:
    """Relative permittivity of a compressed dielectric liquid after Clausius and Mossotti.

    eps = (eps_r + 2 + 2 (eps_r - 1) rho/rho0)/(eps_r + 2 - (eps_r - 1) rho/rho0)

    ``density_ratio``, density over the density at zero pressure, rho/rho0, dimensionless, > 0, shape (...);
    ``temperature`` [K]; ``relative_permittivity``, relative permittivity eps_r at the density rho0,
    dimensionless, >= 1. Returns relative permittivity, dimensionless, shape (...). Raises InputError if the
    density ratio reaches the pole of the law, (eps_r + 2)/(eps_r - 1). An array of permittivities belongs to
    many points, of which those beyond the pole have NaN.

    Eq. (14) of Morris et al. (2022), doi:10.3390/lubricants10050087. The law holds for molecules without a
    dipole moment. For polar liquids use ``constant_permittivity``.

    Examples
    --------
    >>> round(float(clausius_mossotti(1.2138, relative_permittivity=2.4)), 3)
    2.888
    """
    rho = np.asarray(density_ratio, dtype=float)
    denominator = relative_permittivity + 2.0 - (relative_permittivity - 1.0) * rho
    beyond = denominator <= 0.0
    if np.ndim(relative_permittivity):
        denominator = np.where(beyond, np.nan, denominator)
    elif np.any(beyond):
        raise InputError.worded(
            "lubricant.permittivity_law",
            "'clausius-mossotti' has a pole at the density ratio "
            f"{(relative_permittivity + 2.0) / (relative_permittivity - 1.0):.4g}, and the film "
            f"reaches {np.max(rho):.4g}; a polar liquid takes 'constant'",
            takes="'constant'",
        )
    permittivity: Array = (
        relative_permittivity + 2.0 + 2.0 * (relative_permittivity - 1.0) * rho
    ) / denominator
    return permittivity


def constant_permittivity(
    density_ratio: ArrayLike, temperature: ArrayLike | None = None, *, relative_permittivity: Numbers
) -> Array:
    """Relative permittivity that does not change with density. ``density_ratio``, density over the density at
    zero pressure, rho/rho0, dimensionless, shape (...); ``temperature`` [K]; ``relative_permittivity``,
    relative permittivity eps_r, dimensionless. Returns relative permittivity, dimensionless, shape (...).

    Examples
    --------
    >>> float(constant_permittivity(1.2, relative_permittivity=2.4))
    2.4
    """
    return np.asarray(np.zeros(np.shape(density_ratio)) + relative_permittivity)


RELATIVE_PERMITTIVITY = parameter("relative_permittivity")

PERMITTIVITY_LAWS = {
    "clausius-mossotti": Law(clausius_mossotti, parameters_of(clausius_mossotti)),
    "constant": Law(constant_permittivity, parameters_of(constant_permittivity)),
}


def constant_conductivity(temperature: ArrayLike | None = None, *, conductivity: Numbers) -> Array:
    """Electrical conductivity that does not change with temperature. ``temperature`` [K], shape (...);
    ``conductivity``, electrical conductivity sigma [S/m]. Returns electrical conductivity [S/m], shape (...).

    Examples
    --------
    >>> float(constant_conductivity(333.15, conductivity=1e-12))
    1e-12
    """
    return np.asarray(np.zeros(np.shape(0.0 if temperature is None else temperature)) + conductivity)


def arrhenius(
    temperature: ArrayLike | None,
    *,
    conductivity: Numbers,
    conductivity_activation: Numbers,
    conductivity_temperature: Numbers,
) -> Array:
    """Electrical conductivity after Arrhenius, sigma = sigma_ref exp(-(E/R)(1/T - 1/T_ref)).

    ``temperature`` [K], shape (...); ``conductivity``, electrical conductivity sigma_ref at the temperature
    T_ref [S/m]; ``conductivity_activation``, activation energy E [J/mol]; ``conductivity_temperature``,
    temperature T_ref of the given conductivity [K]. Returns electrical conductivity sigma [S/m], shape (...).
    Raises InputError if the temperature is missing.

    S. Arrhenius, Z. Phys. Chem. 4 (1889) 226, doi:10.1515/zpch-1889-0416, with the gas constant
    R = 8.314 J/(mol K). Ions of a dissociated additive are created and move by thermal activation.

    Examples
    --------
    >>> oil = dict(conductivity=1e-10, conductivity_activation=5e4, conductivity_temperature=313.15)
    >>> round(float(arrhenius(373.15, **oil)) * 1e9, 2)
    2.19
    """
    at = required(temperature, "conductivity_law 'arrhenius'")
    return np.asarray(
        conductivity
        * np.exp(-conductivity_activation / GAS_CONSTANT * (1.0 / at - 1.0 / conductivity_temperature))
    )


CONDUCTIVITY = parameter("conductivity")

CONDUCTIVITY_LAWS = {
    "constant": Law(constant_conductivity, parameters_of(constant_conductivity)),
    "arrhenius": Law(
        arrhenius,
        parameters_of(arrhenius),
        needs_temperature=True,
    ),
}
