"""Means over the pressure of dry Hertz contacts, and integrals over the gap next to line contacts."""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache

import numpy as np

from ehlectric.arrays import Array
from ehlectric.formulas.hertz import line_gap

# Pressures of a dry contact divided by its maximum, and the parts of its area that have them. Of an ellipse
# the part with ratios up to t is t^2; of a strip the ratio is the cosine of an angle whose sine is the place.
_RATIO, _WEIGHT = np.polynomial.legendre.leggauss(24)
ELLIPSE = 0.5 * (_RATIO + 1.0), 0.5 * (_RATIO + 1.0) * _WEIGHT
STRIP = np.sqrt(1.0 - _RATIO**2), 0.5 * _WEIGHT

# Nodes and weights on 0 to 1 with which the gap outside the Hertz area is integrated. The integrals are
# within 1e-4 of the integrals with three times as many nodes.
_NODES, _WEIGHTS = (0.5 * values for values in np.polynomial.legendre.leggauss(32))
_NODES = _NODES + 0.5

# Numbers that are computed together: few enough for the processor's cache.
_TOGETHER = 32768


def pressure_mean(area: tuple[Array, Array], law: Callable[[Array], Array], max_pressure: Array) -> Array:
    """Mean over the Hertz area of a number that depends on the Hertz pressure [Pa], shape (...).

    ``area``, ``ELLIPSE`` or ``STRIP``; ``law``, number at pressures [Pa] of any shape; ``max_pressure`` of
    the contacts [Pa], shape (...).

    Examples
    --------
    The mean pressure of a strip is pi/4 of its maximum, and of an ellipse 2/3:

    >>> [round(float(pressure_mean(area, lambda p: p, np.ones(1))[0]), 4) for area in (STRIP, ELLIPSE)]
    [0.7854, 0.6667]
    """
    ratio, weights = area
    step = max(1, _TOGETHER // max(1, max_pressure.size))
    total = np.zeros_like(max_pressure)
    for start in range(0, ratio.size, step):
        part = slice(start, start + step)
        # A product of matrices would start threads.
        total += np.einsum("k,k...->...", weights[part], law(np.multiply.outer(ratio[part], max_pressure)))
    return total


@lru_cache(maxsize=4)
def _wedge(end: float) -> tuple[Array, Array]:
    """Weights, and dry gaps from the edge of a Hertz zone to an end, with lengths in b and gaps in b^2/R.

    Nodes are dense at the edge of the zone, where the gap begins with a power of 1.5.
    """
    length = abs(end) - 1.0
    return length * 3.0 * _NODES**2 * _WEIGHTS, line_gap(1.0 + length * _NODES**3)


def wedge_integral(middle: Array, end: float) -> Array:
    """Integral of dx/gap from the edge of the Hertz zone of line contacts to an end, in R/b.

    ``middle``, constant part of the gap [b^2/R], shape (...); ``end``, place in half-widths b.
    """
    weights, gap = _wedge(end)
    return np.asarray(np.sum(weights / (middle[..., np.newaxis] + gap), axis=-1))
