"""Gap between two bodies with circular profiles: ball, roller, disc, plane, groove. SI units.

The surface of a body is a circular arc across entrainment, with the curvature 1/ry, that turns about an axis
parallel to y, at the distance rx from the contact. It is a ball for rx = ry, a cylinder for 1/ry = 0, a plane
for 1/rx = 1/ry = 0, and otherwise part of a torus, such as a crowned roller or the groove of a raceway. A
curvature is negative for a concave body.

A point Q of the near body is given by its arcs s along and t across entrainment from the contact, and z is
its height towards the far body, whose nearest point at s = t = 0 is at z = gap. The gap at Q is its distance
from the far body, along the far body's normal. All formulas are written with curvatures instead of radii, so
that a plane needs no large number and no difference of large numbers occurs.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ehlectric.arrays import Array
from ehlectric.formulas.thin_gap import charge_density


@dataclass(frozen=True)
class Body:
    """Curvatures of one body at the contact [1/m], positive for a convex body and zero for a plane.

    Attributes
    ----------
    along, across : float
        Curvature 1/rx along and 1/ry across entrainment [1/m].
    """

    along: float
    across: float


@dataclass(frozen=True)
class Bodies:
    """Two bodies that face each other across a thin gap.

    Attributes
    ----------
    far : Body
        Body whose end is the end of the gap: the one of larger curvature along entrainment, which is convex.
    near : Body
        Other body, on whose surface the charge is integrated.
    """

    far: Body
    near: Body

    @classmethod
    def of(cls, first: Body, second: Body) -> Bodies:
        """Pair of two bodies in either order.

        Examples
        --------
        >>> plane, ball = Body(0.0, 0.0), Body(100.0, 100.0)
        >>> Bodies.of(plane, ball) == Bodies.of(ball, plane) == Bodies(ball, plane)
        True
        """
        far, near = sorted((first, second), key=lambda body: (body.along, body.across), reverse=True)
        return cls(far, near)


@dataclass(frozen=True)
class Points:
    """Points of the near body, and the gap there.

    Attributes
    ----------
    gap : ndarray, shape (...)
        Distance from the far body, along the normal of the far body [m].
    tilt : ndarray, shape (...)
        Angle between that normal and the normal of the near body [rad].
    far, near : ndarray, shape (...)
        Sum of the principal curvatures of the far and of the near body, positive where the centre lies beyond
        the far body [1/m].
    bend : ndarray, shape (...)
        Curvature of the far body in the direction in which both normals differ [1/m].
    stretch : ndarray, shape (...)
        Area of the surface over ds dt, dimensionless.
    """

    gap: Array
    tilt: Array
    far: Array
    near: Array
    bend: Array
    stretch: Array

    def density(self, opening: Array | float = 0.0, coating: float = 0.0) -> Array:
        """Charge density on the near body over eps0 eps V [1/m].

        Parameters
        ----------
        opening : array_like, shape (...)
            Distance by which deflection and film open the gap further [m].
        coating : float
            Thickness of a coating over its relative permittivity, times that of the medium in the gap [m].
        """
        return charge_density(self.gap + opening + coating, self.tilt, self.far, self.near)

    @property
    def facing(self) -> Array:
        """Positive where the point faces the far body, zero where its normal is tangent to the far body."""
        facing: Array = 1.0 - np.sin(self.tilt) * (1.0 + self.bend * self.gap)
        return np.where(self.tilt < 0.5 * np.pi, facing, -1.0)


def points(bodies: Bodies, gap: float, s: Array, t: Array) -> Points:
    """Gap, angle between the normals, and curvatures at points of the near body.

    Parameters
    ----------
    bodies : Bodies
        Both bodies.
    gap : float
        Gap at s = t = 0 [m]; it may be negative for bodies that are pressed together.
    s, t : ndarray, shapes that broadcast to (...)
        Arcs from the contact on the near body, along and across entrainment [m].

    Returns
    -------
    Points
        Gap and geometry at the points, shape (...).

    Examples
    --------
    A ball of 10 mm radius on a plane, 6 mm from the contact and with a gap of 1 um there: the gap in
    micrometres, which is sqrt(rho^2 + (r + h)^2) - r.

    >>> at = points(Bodies(Body(100.0, 100.0), Body(0.0, 0.0)), 1e-6, np.array(6e-3), np.array(0.0))
    >>> round(float(at.gap) * 1e6, 3), round(float(np.hypot(6e-3, 10.001e-3) - 10e-3) * 1e6, 3)
    (1662.761, 1662.761)
    """
    far, near = bodies.far, bodies.near
    s, t = np.broadcast_arrays(np.asarray(s, dtype=float), np.asarray(t, dtype=float))
    # Position of Q and normal of the near body there, which points to the far body.
    psi, phi = near.across * t, near.along * s
    profile = -0.5 * near.across * (t * np.sinc(0.5 * psi / np.pi)) ** 2
    stretch = 1.0 + near.along * profile
    x, y = stretch * s * np.sinc(phi / np.pi), t * np.sinc(psi / np.pi)
    z = profile * np.cos(phi) - 0.5 * near.along * (s * np.sinc(0.5 * phi / np.pi)) ** 2
    normal = (np.sin(phi) * np.cos(psi), np.sin(psi), np.cos(phi) * np.cos(psi))
    # Radial distance from the axis of the far body, less its radius, and then distance from its profile.
    below = gap - z
    radial = _distance(far.along, below, x)
    distance = _distance(far.across, radial, y)
    # Unit vector from the far body to Q, along the normal of the far body.
    across = far.across * y / (1.0 + far.across * distance)
    within = (1.0 + far.across * radial) / (1.0 + far.across * distance)
    scale = within / (1.0 + far.along * radial)
    away = (scale * far.along * x, across, -scale * (1.0 + far.along * below))
    cosine = -sum(a * n for a, n in zip(away, normal, strict=True))
    sine = np.sqrt(sum(part**2 for part in _cross(away, normal)))
    # Curvature of the far body along its circles of revolution, at the foot of the distance.
    drop = far.across * (y / (1.0 + far.across * distance)) ** 2 / (1.0 + np.maximum(within, 0.0))
    turning = far.along * within / (1.0 - far.along * drop)
    leaning = np.asarray(away[0]) ** 2 / np.maximum(away[0] ** 2 + across**2, np.finfo(float).tiny)
    bend = leaning * turning + (1.0 - leaning) * far.across
    own = -near.across - near.along * np.cos(psi) / stretch
    return Points(distance, np.arctan2(sine, cosine), turning + far.across, own, bend, np.abs(stretch))


def _distance(curvature: float, height: Array, sideways: Array) -> Array:
    """Distance of a point from a circle: ``height`` above its top, and ``sideways`` from there [m]."""
    twice = curvature * (height**2 + sideways**2)
    distance: Array = (2.0 * height + twice) / (1.0 + np.sqrt(1.0 + curvature * (2.0 * height + twice)))
    return distance


def _cross(a: tuple[Array, ...], b: tuple[Array, ...]) -> tuple[Array, ...]:
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])
