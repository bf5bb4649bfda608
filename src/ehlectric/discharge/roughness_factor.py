"""Factor by which roughness raises the capacitance of a film: the mean of 1/gap times the film thickness.

The combined heights z of both surfaces have a Gaussian distribution with the root-mean-square height Rq.
The gap at a place is g = h + z, where h is the mean film thickness. The capacitance of a thin film is the
mean of eps/g. It is larger than eps/h, because a thin place adds more than a thick place takes away.

A place with a gap below a small ``touching`` gap belongs to an asperity in contact. It is a conductor, not a
capacitor, and is left out. Without this limit the mean would be infinite, because the distribution has places
with any small gap.
"""

from __future__ import annotations

from functools import cache

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import dawsn

from ehlectric.arrays import Array
from ehlectric.errors import InputError, shown

# Gap over Rq below which two surfaces are taken to touch. No source has this number: it is an assumption.
TOUCHING = 0.05

# Film thickness over Rq below which the factor depends on TOUCHING by about 0.12 for a factor of e.
LEAST_RATIO = 2.0

# Film thickness over Rq above which the touching places do not change the factor in double precision.
_FAR = 9.0

# Heights that count, in Rq, and quadrature nodes in the logarithm of the gap: accurate to 1e-10.
_HEIGHTS, _NODES = 9.0, 100


def roughness_factor(film_ratio: ArrayLike, *, touching: float = TOUCHING) -> Array:
    """Capacitance of a rough film over that of a smooth film of the same mean thickness.

    Parameters
    ----------
    film_ratio : array_like, shape (...)
        Mean film thickness h over the combined root-mean-square height Rq of both surfaces, dimensionless,
        positive. It is infinite for smooth surfaces.
    touching : float
        Gap over Rq below which the surfaces touch, dimensionless, above 0 and below 1.

    Returns
    -------
    ndarray, shape (...)
        Factor, dimensionless. It is 1 + (Rq/h)^2 for a film that is thick compared to the roughness.

    Raises
    ------
    InputError
        Where a ratio is not positive, or ``touching`` is out of range.

    Notes
    -----
    The factor is the integral of (h/g) phi((g - h)/Rq)/Rq dg over all gaps g above ``touching`` Rq, with the
    standard normal density phi. Above h/Rq = 9 it is sqrt(2) (h/Rq) D(h/(sqrt(2) Rq)), the principal value
    of the integral over all gaps, with Dawson's integral D.

    The derivative of the factor by ln(touching) is -(h/Rq) phi(h/Rq): -0.01 at h/Rq = 3, -0.11 at 2 and -0.24
    at 1. Below ``LEAST_RATIO`` the factor is therefore an order of magnitude only. The heights are those in
    the loaded contact. A film under high pressure flattens long waves of the roughness, so the factor with
    the Rq of unloaded surfaces is an upper estimate.

    Examples
    --------
    A film of five times Rq, and the limit for thick films:

    >>> round(float(roughness_factor(5.0)), 4), 1.0 + 1.0 / 5.0**2
    (1.0462, 1.04)
    """
    ratio = np.asarray(film_ratio, dtype=float)
    if not np.all(ratio > 0.0):
        raise InputError("film_ratio", got=shown(film_ratio), takes="ratios h/Rq above 0")
    if not 0.0 < touching < 1.0:
        raise InputError("touching", got=shown(touching), takes="a gap over Rq above 0 and below 1")
    near = np.minimum(ratio, _FAR)
    first, last = np.log(touching), np.log(near + _HEIGHTS)
    thin = np.zeros_like(near)
    # One node after another, so that maps of a film need no memory for all nodes at once.
    for node, weight in zip(*_gauss(), strict=True):
        gap = np.exp(first + 0.5 * (last - first) * (node + 1.0))
        thin += weight * np.exp(-0.5 * (gap - near) ** 2)
    thin *= near * 0.5 * (last - first) / np.sqrt(2.0 * np.pi)
    # Dawson's integral at an infinite argument times that argument is not defined; its limit is reached here.
    far = np.clip(ratio, _FAR, 1e8) / np.sqrt(2.0)
    factor: Array = np.where(ratio < _FAR, thin, 2.0 * far * dawsn(far))
    return factor


@cache
def _gauss() -> tuple[Array, Array]:
    """Nodes and weights of Gauss-Legendre quadrature on the interval from -1 to 1."""
    nodes, weights = np.polynomial.legendre.leggauss(_NODES)
    return nodes, weights
