"""Charge density on two conductors with a thin gap between them, quadrature nodes, and fit to a film.

On a plane below a conductor at the voltage V and the gap h(x, y), the charge density is (eps0 eps V)/h to
leading order. For the gap of a ball, h = rho^2/(2 r), the next order is constant over the whole tail. It adds
some percent to the capacitance of a ball and is therefore included. Expanding the potential in powers of the
slope, V(z)/V = z/h + z (h^2 - z^2) lap(1/h)/6 + ..., gives (1 + abs(grad h)^2/3 - h lap h/6)/h on the plane.
Let delta be the distance along the normal of the far surface, beta the angle between both normals there, and
k_far and k_near the sums of the principal curvatures of both surfaces. On the near surface the charge density
over eps0 eps V is then

    (sin(beta)/beta)/delta - k_far/6 - k_near/3.

A curvature is positive where its centre lies beyond the far surface. Concentric spheres extend the formula
from a plane to a curved near surface. The formula is exact for a wedge, and exact to this order for
concentric spheres and cylinders. For a sphere or a cylinder over a plane, tests compare it with the exact
charge.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache

import numpy as np
from numpy.typing import ArrayLike

from ehlectric.arrays import Array

# Change of the offset of a gap over the smallest film thickness at which it fits.
_SETTLED = 1e-12


def charge_density(gap: ArrayLike, tilt: ArrayLike, far: ArrayLike, near: ArrayLike) -> Array:
    """Charge density on the near one of two conducting surfaces, divided by eps0 eps V.

    Parameters
    ----------
    gap : array_like, shape (...)
        Distance delta from a point of the near surface along the normal of the far surface [m].
    tilt : array_like, shape (...)
        Angle beta between this normal and the normal of the near surface at the point, from 0 to below pi
        [rad].
    far, near : array_like, shape (...)
        Sum of the two principal curvatures of the far and of the near surface [1/m]. It is positive where the
        centre lies beyond the far surface, for example 2/r for a ball and 2/(r + h) for a shell around it.

    Returns
    -------
    ndarray, shape (...)
        Charge density over eps0 eps V [1/m].

    Examples
    --------
    For concentric spheres of 10 and 10.1 mm, the exact value on the outer one is (r/(r + h))/h. The formula
    agrees with it up to terms of (h/r)^2:

    >>> exact = 10e-3 / 10.1e-3 / 0.1e-3
    >>> abs(float(charge_density(1e-4, 0.0, 2 / 10e-3, 2 / 10.1e-3)) / exact - 1.0) < 1e-4
    True
    """
    delta, beta, outer, own = (np.asarray(values, dtype=float) for values in (gap, tilt, far, near))
    density: Array = np.sinc(beta / np.pi) / delta - outer / 6.0 - own / 3.0
    return density


@cache
def _gauss(nodes: int) -> tuple[Array, Array]:
    """Nodes and weights of Gauss-Legendre quadrature on the interval from 0 to 1."""
    x, weights = np.polynomial.legendre.leggauss(nodes)
    return 0.5 * (x + 1.0), 0.5 * weights


def stretched(start: ArrayLike, end: ArrayLike, scale: ArrayLike, nodes: int) -> tuple[Array, Array]:
    """Quadrature nodes and weights from ``start`` to ``end`` for a function similar to 1/(scale^2 + x^2).

    Gauss-Legendre quadrature in t, with x = scale sinh(t). The poles at x = +- i scale are then at a distance
    of pi/2 from the path of integration, however small the scale is. The length of the path grows only with
    the logarithm of the end over the scale.

    Parameters
    ----------
    start, end, scale : array_like, shapes that broadcast to (...)
        Ends of the integral, and distance over which the function changes, in the unit of x. ``scale`` is
        positive.
    nodes : int
        Number of nodes.

    Returns
    -------
    x, weights : ndarray, shape (..., nodes)
        Nodes and weights, in the unit of x.

    Examples
    --------
    A narrow peak with wide tails, whose integral is atan(1e6):

    >>> x, weights = stretched(0.0, 1.0, 1e-6, 40)
    >>> bool(np.isclose(1e-6 * np.sum(weights / (1e-12 + x**2)), np.arctan(1e6), rtol=1e-10))
    True
    """
    t, weights = _gauss(nodes)
    scale = np.asarray(scale, dtype=float)[..., np.newaxis]
    first, last = (np.arcsinh(np.asarray(at, dtype=float)[..., np.newaxis] / scale) for at in (start, end))
    at = first + (last - first) * t
    return scale * np.sinh(at), (last - first) * weights * scale * np.cosh(at)


def matched_offset(missing: Callable[[Array], Array], thickness: Array) -> tuple[Array, Array]:
    """Offset of a gap with which it continues a film along the edge of the film's domain.

    With this offset the error of 1/h adds up to zero over the edge. The gap need not fit at every point.
    Several films are matched at once.

    Parameters
    ----------
    missing : callable
        Function that gives, for offsets of shape (..., 1) [m], the film thickness less the gap at each point
        of the edge, shape (..., n) [m]. The gap grows with the offset, at a small angle to it.
    thickness : ndarray, shape (..., n)
        Film thickness at the points [m].

    Returns
    -------
    offset : ndarray, shape (...)
        Offset [m].
    mismatch : ndarray, shape (...)
        Largest difference between film thickness and gap over the film thickness, dimensionless.

    Examples
    --------
    A gap that is 1 um too small at one point and 3 um too small at another of the same film thickness:

    >>> film, gap = np.array([5e-6, 5e-6]), np.array([4e-6, 2e-6])
    >>> offset, mismatch = matched_offset(lambda offset: film - gap - offset, film)
    >>> round(float(offset) * 1e6, 3), round(float(mismatch), 3)
    (2.0, 0.2)
    """
    weights = thickness**-2.0 / np.sum(thickness**-2.0, axis=-1, keepdims=True)
    enough = _SETTLED * np.min(thickness, axis=-1)
    offset = step = before = np.zeros(thickness.shape[:-1])
    for _ in range(12):
        left = missing(offset[..., np.newaxis])
        error = np.sum(weights * left, axis=-1)
        settled = np.abs(error) <= enough
        if np.all(settled):
            break
        # Secant method. The gap changes with the offset by the cosine of an angle that is small over the
        # film's domain, so that the first step is nearly right.
        slope = np.divide(error - before, step, out=np.full(step.shape, -1.0), where=step != 0.0)
        before, step = error, np.where(settled, 0.0, -error / slope)
        offset = offset + step
    return offset, np.max(np.abs(left) / thickness, axis=-1)
