"""Contacts of balls with grooves: stiffness over the contact angle, and load over the approach; SI units.

The stiffness K of Q = K delta^(3/2) follows from the exact Hertz ellipse. It is proportional to E' sqrt(D),
and depends beyond that only on the diameter ratio D/d_m, the osculation of the groove and the contact angle.
It is therefore interpolated over the contact angle once for each geometry, with E' and D of 1.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.polynomial.chebyshev import chebpts1, chebvander

from ehlectric.arrays import Array, Numbers, as_float
from ehlectric.bearing.loads.geometry import BallBearing
from ehlectric.formulas.hertz import dry_contact

# Degree of the polynomial of log K. K changes smoothly, by a few percent over all angles: the relative error
# is below 1e-11, except where a handful of balls fill their pitch circle.
_DEGREE = 24

# Terms of the polynomial below this are dropped: less than the rounding error of log K.
_SMALL = 1e-15

_TINY = np.finfo(float).tiny


def contact_stiffness(bearing: BallBearing, modulus: Numbers, angle: Numbers, *, inner: bool) -> Numbers:
    """Stiffness K of Q = K delta^(3/2), from the exact Hertz ellipse of a ball and a ring. ``modulus``,
    reduced modulus E' of ball and ring [Pa], with 2/E' = (1 - nu1^2)/E1 + (1 - nu2^2)/E2; ``angle`` [rad];
    shape (...). Returns stiffness K [N/m^(3/2)], shape (...).

    Examples
    --------
    Approach in micrometres under a load of 870 N:

    >>> bearing = BallBearing(9, 11.906e-3, 60e-3, 0.52, 0.52, radial_clearance=10e-6)
    >>> k = contact_stiffness(bearing, 226e9, 0.0, inner=True)
    >>> round(1e6 * (870.0 / k) ** (2 / 3), 2)
    9.24
    """
    radii = bearing.radii(angle, inner=inner)
    return as_float(dry_contact(1.0, radii.radius_x, radii.radius_y, modulus).approach ** -1.5)


def _interpolated(ratio: Array, inner_groove: Array, outer_groove: Array) -> Array:
    """Coefficients of ln K of both contacts, for D and E' of 1, shape (2, _DEGREE + 1, n).

    ``ratio`` is D/d_m; the arguments have the shape (n,).
    """
    nodes = chebpts1(_DEGREE + 1)
    bearing = BallBearing(3, 1.0, 1.0 / ratio, inner_groove, outer_groove, 0.0)
    angles = np.arccos(0.5 * (nodes + 1.0))[:, np.newaxis]
    stiffness = np.array([contact_stiffness(bearing, 1.0, angles, inner=inner) for inner in (True, False)])
    weights = chebvander(nodes, _DEGREE) / (0.5 * (_DEGREE + 1))
    weights[:, 0] *= 0.5
    return np.asarray(weights.T @ np.log(stiffness))


@lru_cache(maxsize=32)
def _of_ratio(ratio: float, inner_groove: float, outer_groove: float) -> Array:
    return _interpolated(*(np.array([value]) for value in (ratio, inner_groove, outer_groove)))


def stiffness_laws(bearing: BallBearing, modulus: Numbers) -> tuple[Array, Array]:
    """Chebyshev coefficients of ln K of the inner and the outer contact over 2 cos a - 1, a from 0 to 90 deg.

    ``modulus`` is the reduced modulus E' of ball and ring [Pa], shape (...); K has the unit N/m^(3/2).
    Returns two arrays of shape (..., 25); ``...`` is the shape of the modulus and of the dimensions that K
    depends on: ball and pitch diameter, and both grooves.
    """
    shapes = (bearing.ball_diameter / bearing.pitch_diameter, bearing.inner_groove, bearing.outer_groove)
    if all(np.ndim(value) == 0 for value in shapes):
        laws = _of_ratio(*map(float, shapes))[..., 0]
    else:
        columns = np.stack(np.broadcast_arrays(*shapes), axis=-1)
        distinct, where = np.unique(columns.reshape(-1, 3), axis=0, return_inverse=True)
        laws = np.moveaxis(_interpolated(*distinct.T)[..., where.reshape(columns.shape[:-1])], 1, -1)
    size = np.log(modulus * np.sqrt(bearing.ball_diameter))
    inner, outer = (
        np.array(np.broadcast_to(law, (*np.broadcast_shapes(law.shape[:-1], size.shape), law.shape[-1])))
        for law in laws
    )
    for law in (inner, outer):
        law[..., 0] += size
    return inner, outer


def stiffness_at(laws: Array, cosine: Array) -> Array:
    """Stiffness K of contacts with a cosine of their angle, shape (...) [N/m^(3/2)].

    ``laws``, Chebyshev coefficients of ln K, shape (m, ...) with a leading axis for their number.
    """
    twice = 4.0 * cosine - 2.0
    last = before = np.zeros_like(twice)
    # Clenshaw's recurrence.
    for law in laws[:0:-1]:
        last, before = twice * last - before + law, last
    return np.asarray(np.exp(0.5 * twice * last - before + laws[0]))


def significant(laws: Array) -> Array:
    """Coefficients of shape (m, ...) up to the last that changes ln K of any point."""
    sizes = np.max(np.abs(laws), axis=tuple(range(1, laws.ndim)))
    return laws[: 1 + int(np.flatnonzero(sizes > _SMALL)[-1])]


@dataclass(frozen=True)
class Contacts:
    """Contacts of balls with grooves, shape (...)."""

    # Sine and cosine of the contact angle: axial and radial component of the unit vector n from the centre of
    # the outer groove to the ball, or from the ball to the centre of the inner groove.
    sine: Array
    cosine: Array
    # Elastic approach [m]; where the ball does not touch, it is negative, the gap with a minus sign.
    depth: Array
    load: Array  # load Q [N]
    # along and across: derivative of the force Q n along and across n, by the vector between the centres of
    # ball and groove [N/m].
    along: Array
    across: Array

    def of(self, chosen: Any) -> Contacts:
        """Contacts at an index."""
        return Contacts(*(value[chosen] for value in vars(self).values()))

    @property
    def components(self) -> tuple[Array, Array]:
        """Axial and radial component of the contact force Q n [N]."""
        return self.load * self.sine, self.load * self.cosine

    @property
    def normal(self) -> Array:
        """Unit vector n, axial and radial component, shape (..., 2)."""
        return np.stack([self.sine, self.cosine], axis=-1)

    @property
    def force(self) -> Array:
        """Contact force Q n, axial and radial component, shape (..., 2) [N]."""
        return self.load[..., np.newaxis] * self.normal

    @property
    def tangent(self) -> tuple[Array, Array, Array]:
        """Derivative of the force: axial by axial, axial by radial and radial by radial component [N/m]."""
        more = self.along - self.across
        return (
            self.across + more * self.sine**2,
            more * self.sine * self.cosine,
            self.across + more * self.cosine**2,
        )


@dataclass(frozen=True)
class Spans:
    """Vectors between the centres of balls and grooves, shape (...)."""

    axial: Array  # axial component [m]
    radial: Array  # radial component [m]; beyond 90 deg, where it is negative, the groove is a plane wall
    length: Array  # length that counts for the contact [m]

    @classmethod
    def of(cls, axial: Array, radial: Array) -> Spans:
        """Spans with their components [m]."""
        return cls(axial, radial, np.sqrt(axial**2 + np.maximum(radial, 0.0) ** 2))

    @property
    def direction(self) -> tuple[Array, Array]:
        """Sine and cosine of the contact angle."""
        # Coinciding centres define no direction, but have no force either.
        over = 1.0 / np.maximum(self.length, _TINY)
        return self.axial * over, np.maximum(self.radial, 0.0) * over

    def contacts(self, offset: Numbers, laws: Array) -> Contacts:
        """Contacts with the stiffness at their angle.

        ``offset``, length at first touch [m]; ``laws``, coefficients of ln K, shape (m, ...).
        """
        sine, cosine = self.direction
        return self._loaded(offset, stiffness_at(laws, cosine), sine, cosine)

    def stiff_contacts(self, offset: Numbers, stiffness: Numbers) -> Contacts:
        """Contacts with a length at first touch [m] and a stiffness K [N/m^(3/2)]."""
        return self._loaded(offset, stiffness, *self.direction)

    def _loaded(self, offset: Numbers, stiffness: Numbers, sine: Array, cosine: Array) -> Contacts:
        depth = self.length - offset
        pressed = np.maximum(depth, 0.0)
        secant = stiffness * np.sqrt(pressed)
        load = secant * pressed
        across = load / np.maximum(self.length, offset) * (self.radial > 0.0)
        return Contacts(sine, cosine, depth, load, 1.5 * secant, across)
