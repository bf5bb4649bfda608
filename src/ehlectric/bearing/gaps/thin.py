"""Charge between two conductors a thin gap apart, to the next order, and nodes to integrate it over.

A gap h(x, y) over a plane holds the charge density (eps0 eps V)/h. Where it opens as that of a ball does,
h = rho^2/(2 r), the next order is not small against it: it is of the same size all over the tail, and so adds
some percent to the capacitance of a ball. Expanding the potential in powers of the slope, V(z)/V = z/h +
(z^3 - z h^2) h (1/h)_xx/6 ..., gives (1 + abs(grad h)^2/3 - h lap h/6)/h on the plane. Written with the
distance delta along the normal of the far surface, the angle beta between both normals there and the sums of
their principal curvatures, and carried over to two curved surfaces by the concentric spheres, it is

    (sin(beta)/beta)/delta - k_far/6 - k_near/3,

on the near surface, a curvature being positive where its centre lies beyond the far surface. It is exact for
a wedge, and to this order for concentric spheres and cylinders; for a sphere or a cylinder over a plane
tests hold it to the exact charge.
"""

from __future__ import annotations

from functools import cache

import numpy as np
from numpy.typing import ArrayLike

from ehlectric.arrays import Array


def charge_density(gap: ArrayLike, tilt: ArrayLike, far: ArrayLike, near: ArrayLike) -> Array:
    """Charge on the near one of two surfaces over eps0 eps V, to the next order of a thin gap.

    Parameters
    ----------
    gap : array_like, shape (...)
        delta, from a point of the near surface along the normal of the far one [m].
    tilt : array_like, shape (...)
        beta, between that normal and the one of the near surface at the point [rad], from 0 to below pi.
    far, near : array_like, shape (...)
        Sums of the two principal curvatures [1/m], positive where the centre lies beyond the far surface:
        2/r for a ball and its concave shell.

    Returns
    -------
    ndarray, shape (...)
        [1/m].

    Examples
    --------
    The outer one of concentric spheres of 10 and 10.1 mm holds (r/(r + h))/h, and this up to (h/r)^2:

    >>> exact = 10e-3 / 10.1e-3 / 0.1e-3
    >>> abs(float(charge_density(1e-4, 0.0, 2 / 10e-3, 2 / 10.1e-3)) / exact - 1.0) < 1e-4
    True
    """
    delta, beta, outer, own = (np.asarray(given, dtype=float) for given in (gap, tilt, far, near))
    density: Array = np.sinc(beta / np.pi) / delta - outer / 6.0 - own / 3.0
    return density


@cache
def _gauss(nodes: int) -> tuple[Array, Array]:
    # On 0 to 1.
    x, weights = np.polynomial.legendre.leggauss(nodes)
    return 0.5 * (x + 1.0), 0.5 * weights


def stretched(start: ArrayLike, end: ArrayLike, scale: ArrayLike, nodes: int) -> tuple[Array, Array]:
    """Nodes and weights of an integral from ``start`` to ``end`` of what varies as 1/(scale^2 + x^2) does.

    Gauss and Legendre's in t, x = scale sinh(t): the poles at x = +- i scale, however near, are then a
    distance pi/2 from the path, whose length grows only as the logarithm of the end over the scale.

    Parameters
    ----------
    start, end, scale : array_like, shapes that broadcast to (...)
        Of x, in one unit; ``scale`` positive.
    nodes : int
        Number of nodes.

    Returns
    -------
    x, weights : ndarray, shape (..., nodes)
        In the unit of ``start``.

    Examples
    --------
    A narrow peak and its wide feet, of which the integral is atan(1e6):

    >>> x, weights = stretched(0.0, 1.0, 1e-6, 40)
    >>> bool(np.isclose(1e-6 * np.sum(weights / (1e-12 + x**2)), np.arctan(1e6), rtol=1e-10))
    True
    """
    t, weights = _gauss(nodes)
    scale = np.asarray(scale, dtype=float)[..., np.newaxis]
    first, last = (np.arcsinh(np.asarray(at, dtype=float)[..., np.newaxis] / scale) for at in (start, end))
    at = first + (last - first) * t
    return scale * np.sinh(at), (last - first) * weights * scale * np.cosh(at)
