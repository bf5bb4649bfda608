"""Share of the load that asperities carry, against lambda: published fits by name.

Lambda is the film thickness over the composite roughness sqrt(Rq1^2 + Rq2^2) of the undeformed surfaces.
The fits agree within a factor of two below lambda 1.5 and differ by orders of magnitude above 2.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import ArrayLike
from scipy import optimize, special

from ehlectric.arrays import Array


@dataclass(frozen=True)
class ShareLaw:
    """Fit of the asperity load share over lambda, an entry of ``LOAD_SHARE``.

    Attributes
    ----------
    name : str
        Name in tables and figures.
    share : callable
        Function of lambda, array_like of shape (...), that returns the share from 0 to 1, shape (...). It
        raises ``ValueError`` for a negative lambda.
    source : str
        Publication, and how far it is confirmed.

    Examples
    --------
    >>> round(float(LOAD_SHARE["clarke"].share(1.0)), 3)
    0.157
    """

    name: str
    share: Callable[[ArrayLike], Array]
    source: str


def contact_probability(film_parameter: ArrayLike) -> Array:
    """Share of time in which a lubricated contact conducts, 1 - erf(lambda), after Clarke et al.

    Parameters
    ----------
    film_parameter : array_like, shape (...)
        Lambda, central film thickness over composite roughness, dimensionless, >= 0.

    Returns
    -------
    ndarray, shape (...)
        Share of time with metallic contact, dimensionless, from 1 at no film to 0.

    Raises
    ------
    ValueError
        If a lambda is negative.

    Notes
    -----
    Clarke et al. fitted electrical contact resistances of discs; it is quoted after Arana. Contact begins
    below lambda = 2 and rises steeply below 1. The fit is of one test rig: area of the contact, speed and
    spacing of the asperities are not in it, whereas they are in ``intermittency.contact_time_share``.

    Examples
    --------
    >>> contact_probability([0.0, 1.0, 2.0]).round(4).tolist()
    [1.0, 0.1573, 0.0047]
    """
    probability: Array = np.asarray(special.erfc(_checked(film_parameter)))
    return probability


def patir_cheng(film_parameter: ArrayLike) -> Array:
    """Asperity load share exp(-1.8 lambda^1.2), a fit to the model of Patir and Cheng.

    Parameters
    ----------
    film_parameter : array_like, shape (...)
        Lambda, dimensionless, >= 0.

    Returns
    -------
    ndarray, shape (...)
        Asperity load share, dimensionless, from 0 to 1.

    Raises
    ------
    ValueError
        If a lambda is negative.

    Examples
    --------
    >>> round(float(patir_cheng(1.0)), 3)
    0.165
    """
    share: Array = np.exp(-1.8 * _checked(film_parameter) ** 1.2)
    return share


def zhou_hoeprich(film_parameter: ArrayLike) -> Array:
    """Asperity load share exp(-2.32 lambda^0.97) of roller raceways after Zhou and Hoeprich.

    The constants are those of the raceway of a tapered roller bearing 32216. A 32208 has 2.1 and 0.85.

    Parameters
    ----------
    film_parameter : array_like, shape (...)
        Lambda, dimensionless, >= 0.

    Returns
    -------
    ndarray, shape (...)
        Asperity load share, dimensionless, from 0 to 1.

    Raises
    ------
    ValueError
        If a lambda is negative.

    Examples
    --------
    >>> round(float(zhou_hoeprich(1.0)), 3)
    0.098
    """
    share: Array = np.exp(-2.32 * _checked(film_parameter) ** 0.97)
    return share


def johnson_fit(film_parameter: ArrayLike) -> Array:
    """Asperity load share 1 - 1.21 lambda^0.64/(1 + 0.37 lambda^1.26), of the type of Johnson.

    The fraction reaches one near lambda = 2. Beyond, the expression becomes negative and then rises again:
    it is no fit there, and the share is zero.

    Parameters
    ----------
    film_parameter : array_like, shape (...)
        Lambda, dimensionless, >= 0.

    Returns
    -------
    ndarray, shape (...)
        Asperity load share, dimensionless, from 1 to 0.

    Raises
    ------
    ValueError
        If a lambda is negative.

    Examples
    --------
    >>> johnson_fit([1.0, 3.0]).round(3).tolist()
    [0.117, 0.0]
    """
    at = _checked(film_parameter)
    share: Array = np.where(at < johnson_end(), 1.0 - _johnson_fraction(at), 0.0)
    return share


@cache
def johnson_end() -> float:
    """Lambda at which the Johnson-type fit reaches zero and its range ends, dimensionless."""
    return float(optimize.brentq(lambda at: float(1.0 - _johnson_fraction(at)), 1.0, 2.3))


def _johnson_fraction(film_parameter: Array | float) -> Array | float:
    return 1.21 * film_parameter**0.64 / (1.0 + 0.37 * film_parameter**1.26)


def _checked(film_parameter: ArrayLike) -> Array:
    at = np.asarray(film_parameter, dtype=float)
    if not np.all(at >= 0.0):
        raise ValueError("lambda is a film thickness over a roughness, at least 0")
    return at


# Fits by name. Measurements and models of different contacts are in them: take their spread as the error.
LOAD_SHARE: dict[str, ShareLaw] = {
    "clarke": ShareLaw(
        "Clarke et al.",
        contact_probability,
        "Clarke et al., from electrical contact resistance of discs, as quoted by Arana; taken as load share",
    ),
    "patir_cheng": ShareLaw(
        "Patir-Cheng",
        patir_cheng,
        "fit to N. Patir and H. S. Cheng, J. Lubr. Technol. 100 (1978) 12-17, as quoted by Matsuyama",
    ),
    "zhou_hoeprich": ShareLaw(
        "Zhou-Hoeprich",
        zhou_hoeprich,
        "R. S. Zhou and M. R. Hoeprich, J. Tribol. 113 (1991) 590-597, constants quoted by Wingertszahn "
        "(2023) for a 32216; volume and pages from memory",
    ),
    "johnson": ShareLaw(
        "Johnson type",
        johnson_fit,
        "quoted as of the type of Johnson, Greenwood and Poon, Wear 19 (1972) 91-108; author of the fit "
        "not confirmed",
    ),
}


def load_shares(film_parameter: ArrayLike) -> dict[str, Array]:
    """Asperity load shares of every fit of ``LOAD_SHARE`` at the same lambda; their spread is their error.

    Parameters
    ----------
    film_parameter : array_like, shape (...)
        Lambda, dimensionless, >= 0.

    Returns
    -------
    dict of str to ndarray, shape (...)
        Asperity load share by key of the fit, dimensionless, from 0 to 1.

    Raises
    ------
    ValueError
        If a lambda is negative.

    Examples
    --------
    >>> {name: round(float(share), 2) for name, share in load_shares(0.5).items()}
    {'clarke': 0.48, 'patir_cheng': 0.46, 'zhou_hoeprich': 0.31, 'johnson': 0.33}
    """
    return {name: law.share(film_parameter) for name, law in LOAD_SHARE.items()}
