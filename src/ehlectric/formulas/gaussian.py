"""Integrals of exp(-x^2) of arrays: complementary error function, normal distribution, Dawson's integral.

``scipy.special`` computes the same functions, but takes a quarter of a second to load.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from ehlectric.arrays import Array

# Spacing of the terms of Dawson's integral, at which its error is exp(-(pi/(2 h))^2) = 2e-27, and the terms
# on each side of the argument, beyond which they are below 1e-16.
_SPACING, _TERMS = 0.2, 18

# Argument beyond which three terms of the asymptotic series of Dawson's integral are exact to the last digit.
_LARGE = 1e3


def erfc(x: ArrayLike) -> Array:
    """Complementary error function 1 - erf(x), shape (...).

    Examples
    --------
    >>> erfc([0.0, 1.0]).round(7).tolist()
    [1.0, 0.1572992]
    """
    at = np.asarray(x, dtype=float)
    return np.fromiter(map(math.erfc, at.ravel().tolist()), float, at.size).reshape(at.shape)


def normal_share(x: ArrayLike) -> Array:
    """Share of a normal distribution below x standard deviations above its mean, shape (...).

    Examples
    --------
    >>> float(normal_share(0.0))
    0.5
    """
    return 0.5 * erfc(-math.sqrt(0.5) * np.asarray(x, dtype=float))


def dawson(x: ArrayLike) -> Array:
    """Dawson's integral exp(-x^2) int_0^x exp(t^2) dt of arguments above 0.1, shape (...).

    G. B. Rybicki, Comput. Phys. 3 (1989) 85, doi:10.1063/1.4822832: the sum of exp(-(x - n h)^2)/n over
    odd n, divided by sqrt(pi).

    Examples
    --------
    >>> round(float(dawson(1.0)), 12)
    0.538079506913
    """
    given = np.asarray(x, dtype=float)
    at = np.minimum(given, _LARGE)[..., np.newaxis]
    nearest = 2.0 * np.round(0.5 * at / _SPACING)
    odd = np.arange(1 - 2 * _TERMS, 2 * _TERMS, 2)
    distance = at - nearest * _SPACING - odd * _SPACING
    values = np.sum(np.exp(-(distance**2)) / (nearest + odd), axis=-1) / math.sqrt(math.pi)
    small = 0.5 / np.maximum(given, _LARGE) ** 2
    far = (1.0 + small * (1.0 + 3.0 * small)) / (2.0 * given)
    return np.asarray(np.where(given < _LARGE, values, far))
