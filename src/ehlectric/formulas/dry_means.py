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

# Nodes and weights on 0 to 1 of an integral to far away, and the logarithm of the last place over the first.
_FAR_NODES, _FAR_WEIGHTS = (0.5 * values for values in np.polynomial.legendre.leggauss(96))
_FAR_NODES, _FAR = _FAR_NODES + 0.5, 17.0

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


def wedge_beyond(middle: Array, end: float) -> Array:
    """Integral of dx/gap from an end, outside of the Hertz zone of line contacts, to infinity, in R/b.

    ``middle``, constant part of the gap [b^2/R], shape (...); ``end``, place in half-widths b. The bodies are
    parabolas.

    Examples
    --------
    Both parts of the gap outside of the zone add up to the gap from its edge to another end:

    >>> one, other = (wedge_integral(np.ones(1), end) + wedge_beyond(np.ones(1), end) for end in (2.0, 4.0))
    >>> bool(np.isclose(one, other, rtol=1e-5)[0])
    True
    """
    # Places that grow by a factor from node to node: the gap has one scale, the root of the constant part.
    at = abs(end) * np.exp(_FAR * _FAR_NODES)
    weights = at * _FAR * _FAR_WEIGHTS
    return np.asarray(np.sum(weights / (middle[..., np.newaxis] + line_gap(at)), axis=-1))
