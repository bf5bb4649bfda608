"""Reduction of an elastohydrodynamic film by the heat of shear in its inlet, by published formulas."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ehlectric.arrays import Array


def inlet_shear_factor(viscosity: float, slope: float, speed: float, conductivity: float) -> float:
    """Reduction factor of the central film thickness due to shear heating in the inlet, in pure rolling.

    Parameters
    ----------
    viscosity : float
        Viscosity eta0 at the inlet temperature [Pa s].
    slope : float
        Temperature coefficient of viscosity beta = -d ln(eta0)/dT [1/K].
    speed : float
        Mean speed u of both surfaces [m/s].
    conductivity : float
        Thermal conductivity k of the oil [W/(m K)].

    Returns
    -------
    float
        Central film thickness over the isothermal one, from 0 to 1, by ``wilson_sheu`` with the thermal
        loading parameter L = eta0 beta u^2/k.

    Notes
    -----
    The formula was derived for the inlet of a line contact; it is used for elliptical contacts too. Of the
    three formulas of this module it is the nearest to solved films in pure rolling.

    Examples
    --------
    >>> round(inlet_shear_factor(0.0125, 0.0309, 15.1, 0.14), 3)
    0.848
    """
    return float(wilson_sheu(viscosity * slope * speed**2 / conductivity))


def wilson_sheu(loading: ArrayLike, slide_to_roll_ratio: ArrayLike = 0.0) -> Array:
    """Film reduction after Wilson and Sheu, 1/(1 + 0.241 (1 + 14.8 S^0.83) L^0.64).

    Parameters
    ----------
    loading : array_like, shape (...)
        Thermal loading parameter L = eta0 beta u^2/k with the mean speed u of both surfaces, dimensionless.
    slide_to_roll_ratio : array_like, optional
        Slide-to-roll ratio S, difference of both speeds over their mean, >= 0.

    Returns
    -------
    ndarray, shape (...)
        Central film thickness over the isothermal one, dimensionless.

    Notes
    -----
    W. R. D. Wilson and S. Sheu, Effect of inlet shear heating due to sliding on elastohydrodynamic film
    thickness, ASME J. Lubr. Technol. 105 (1983) 187-195, doi:10.1115/1.3254558. Solved films contradict the
    term of sliding.

    Examples
    --------
    >>> round(float(wilson_sheu(1.0)), 4)
    0.8058
    """
    slip = 1.0 + 14.8 * np.asarray(slide_to_roll_ratio, dtype=float) ** 0.83
    return np.asarray(1.0 / (1.0 + 0.241 * slip * np.asarray(loading, dtype=float) ** 0.64))


def murch_wilson(loading: ArrayLike) -> Array:
    """Film reduction in pure rolling after Murch and Wilson, 3.94/(3.94 + L^0.62).

    Parameters
    ----------
    loading : array_like, shape (...)
        Thermal loading parameter L = eta0 beta u^2/k, dimensionless.

    Returns
    -------
    ndarray, shape (...)
        Central film thickness over the isothermal one, dimensionless.

    Notes
    -----
    L. E. Murch and W. R. D. Wilson, ASME J. Lubr. Technol. 97 (1975) 212.

    Examples
    --------
    >>> round(float(murch_wilson(1.0)), 4)
    0.7976
    """
    return np.asarray(3.94 / (3.94 + np.asarray(loading, dtype=float) ** 0.62))


def gupta(loading: ArrayLike, pressure_ratio: ArrayLike, slide_to_roll_ratio: ArrayLike = 0.0) -> Array:
    """Film reduction after Gupta, Cheng, Zhu, Forster and Schrand.

    (1 - 13.2 (p_h/E') L^0.42)/(1 + 0.213 (1 + 2.23 S^0.83) L^0.64)

    Parameters
    ----------
    loading : array_like, shape (...)
        Thermal loading parameter L = eta0 beta u^2/k, dimensionless.
    pressure_ratio : array_like, shape (...)
        Hertz pressure over the reduced modulus, p_h/E', dimensionless.
    slide_to_roll_ratio : array_like, optional
        Slide-to-roll ratio S, >= 0.

    Returns
    -------
    ndarray, shape (...)
        Film thickness over the isothermal one, dimensionless; below 0 where the formula does not hold.

    Notes
    -----
    Tribol. Trans. 35 (1992) 269, doi:10.1080/10402009208982117.

    Examples
    --------
    >>> round(float(gupta(1.0, 0.004)), 4)
    0.7809
    """
    load = np.asarray(loading, dtype=float)
    slip = 1.0 + 2.23 * np.asarray(slide_to_roll_ratio, dtype=float) ** 0.83
    pressed = 1.0 - 13.2 * np.asarray(pressure_ratio, dtype=float) * load**0.42
    return np.asarray(pressed / (1.0 + 0.213 * slip * load**0.64))
