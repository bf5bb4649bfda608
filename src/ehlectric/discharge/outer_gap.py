"""Capacitance of the gap between two bodies, outside the domain of the solved film. SI units.

The bodies have circular profiles: ball, roller, disc, plane, groove. The surface of a body is a circular arc
across entrainment, with the curvature 1/ry, that turns about an axis parallel to y, at the distance rx from
the contact. It is a ball for rx = ry, a cylinder for 1/ry = 0, a plane for 1/rx = 1/ry = 0, and otherwise
part of a torus, such as a crowned roller or the groove of a raceway. A curvature is negative for a concave
body.

A point Q of the near body is given by its arcs s along and t across entrainment from the contact, and z is
its height towards the far body, whose nearest point at s = t = 0 is at z = gap. The gap at Q is its distance
from the far body, along the far body's normal. All formulas are written with curvatures instead of radii, so
that a plane needs no large number and no difference of large numbers occurs.

The gap is the gap of the undeflected bodies, opened by the deflection under the Hertz pressure. A constant is
added with which the gap continues the film at the edge of its domain. ``points`` and ``charge_density`` give
the charge on the near body. It is integrated from the edge of the domain to where the normal of the near body
is tangent to the far body: to r = R for a ball of radius R on a plane.

The model neglects what lies beyond: the rear half of the far body, the field lines from its front half that
meet the near body beyond this end, and the field to anything else than the two bodies. For a ball that stands
free above an infinite plane, the neglected part is 16.5 eps0 eps R at any small gap: 1.5 pF in air for a
radius of 10 mm.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ehlectric.arrays import Array
from ehlectric.constants import EPSILON_0
from ehlectric.formulas.capacitances import charge_density, matched_offset, stretched
from ehlectric.formulas.hertz import DryContact, line_opening, point_deflection


@dataclass(frozen=True)
class Body:
    """Curvatures of one body at the contact [1/m], positive for a convex body and zero for a plane."""

    # along and across: curvature 1/rx along and 1/ry across entrainment [1/m].
    along: float
    across: float


@dataclass(frozen=True)
class Bodies:
    """Two bodies that face each other across a thin gap."""

    # Body whose end is the end of the gap: the one of larger curvature along entrainment, which is convex.
    far: Body
    near: Body  # other body, on whose surface the charge is integrated

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
    """Points of the near body, and the gap there."""

    gap: Array  # distance from the far body, along the normal of the far body [m], shape (...)
    tilt: Array  # angle between that normal and the normal of the near body [rad], shape (...)
    # far and near: sum of the principal curvatures of the far and of the near body, positive where the centre
    # lies beyond the far body [1/m], shape (...).
    far: Array
    near: Array
    bend: Array  # curvature of the far body in the direction in which both normals differ [1/m], shape (...)
    stretch: Array  # area of the surface over ds dt, dimensionless, shape (...)

    def density(self, opening: Array | float = 0.0, coating: float = 0.0) -> Array:
        """Charge density on the near body over eps0 eps V [1/m]. ``opening``, distance by which deflection
        and film open the gap further [m], shape (...); ``coating``, thickness of a coating over its relative
        permittivity, times the permittivity of the medium in the gap [m].
        """
        return charge_density(self.gap + opening + coating, self.tilt, self.far, self.near)

    @property
    def facing(self) -> Array:
        """Positive where the point faces the far body, zero where its normal is tangent to the far body."""
        facing: Array = 1.0 - np.sin(self.tilt) * (1.0 + self.bend * self.gap)
        return np.where(self.tilt < 0.5 * np.pi, facing, -1.0)


def points(bodies: Bodies, gap: float, s: Array, t: Array) -> Points:
    """Gap, angle between the normals, and curvatures at points of the near body. ``gap``, gap at s = t = 0
    [m]; it may be negative for bodies that are pressed together; ``s`` and ``t``, arcs from the contact on
    the near body, along and across entrainment [m]. Returns gap and geometry at the points, shape (...).

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
    sine = np.sqrt(sum(part**2 for part in np.cross(away, normal, axis=0)))
    # Curvature of the far body along its circles of revolution, at the foot of the distance.
    drop = far.across * (y / (1.0 + far.across * distance)) ** 2 / (1.0 + np.maximum(within, 0.0))
    turning = far.along * within / (1.0 - far.along * drop)
    leaning = np.asarray(away[0]) ** 2 / np.maximum(away[0] ** 2 + across**2, np.finfo(float).tiny)
    bend = leaning * turning + (1.0 - leaning) * far.across
    near_sum = -near.across - near.along * np.cos(psi) / stretch
    return Points(distance, np.arctan2(sine, cosine), turning + far.across, near_sum, bend, np.abs(stretch))


def _distance(curvature: float, height: Array, sideways: Array) -> Array:
    """Distance of a point from a circle: ``height`` above its top, and ``sideways`` from there [m]."""
    twice = curvature * (height**2 + sideways**2)
    distance: Array = (2.0 * height + twice) / (1.0 + np.sqrt(1.0 + curvature * (2.0 * height + twice)))
    return distance


# Quadrature nodes along each edge of the domain and outwards; tests check an accuracy of 1e-4.
_ALONG_EDGE, _OUTWARDS = 32, 40

# Steps in which the end of the gap is looked for before it is found by bisection, and bisections.
_STEPS, _BISECTIONS = 48, 48

# Largest distance from the contact at which the end of the gap is looked for, in radii of the far body.
_FARTHEST = 4.0

_TINY = float(np.finfo(float).tiny)

Domain = tuple[float, float, float]


@dataclass(frozen=True)
class Outside:
    """Gap outside the film's domain, at the nodes of a quadrature."""

    at: Points  # rigid gap and geometry at the nodes, arrays of shape (n,)
    opening: Array  # distance by which deflection and film open the gap [m], shape (n,)
    area: Array  # area of the near body that belongs to each node [m^2], shape (n,)
    radius: Array  # distance of the nodes from the contact [m], shape (n,)

    def capacitances(self, relative_permittivity: float, coating: float = 0.0) -> Array:
        """Capacitance of each node [F], shape (n,). ``relative_permittivity``, relative permittivity of the
        medium in the gap, dimensionless; ``coating``, thickness of a coating over its relative permittivity
        [m].
        """
        density = self.at.density(self.opening, relative_permittivity * coating)
        capacitances: Array = EPSILON_0 * relative_permittivity * density * self.area
        return capacitances


def around_point(
    bodies: Bodies,
    dry: DryContact,
    modulus: float,
    film: tuple[Array, Array, Array],
    *,
    width: float | None = None,
    ring: tuple[float, float] = (0.0, np.inf),
) -> tuple[Outside, float]:
    """Gap around the film of a point contact.

    ``modulus`` is E' [Pa], with 2/E' = (1 - nu1^2)/E1 + (1 - nu2^2)/E2. ``film`` has the nodes x (nx,) and
    y (ny,) and the thickness (nx, ny) [m]. ``width`` is the width of the bodies across entrainment, at which
    the gap ends, and ``ring`` bounds the distance from the contact [m]. The second result is the largest
    relative difference between film thickness and gap at the edge of the domain.
    """
    x, y, thickness = film
    rim = np.ones_like(thickness, dtype=bool)
    rim[1:-1, 1:-1] = False
    at, edge = np.meshgrid(x, y, indexing="ij"), thickness[rim]
    place = at[0][rim], at[1][rim]
    opened = point_deflection(*place, dry, modulus)
    missing = edge - opened
    solution = matched_offset(lambda gap: missing - points(bodies, float(gap[0]), *place).gap, edge)
    offset, mismatch = (float(value) for value in solution)
    domain = float(x[0]), float(x[-1]), float(max(-y[0], y[-1]))
    s, t, area = (part.ravel() for part in _rays(bodies, offset, domain, width, ring))
    return (
        Outside(
            at=(there := points(bodies, offset, s, t)),
            opening=point_deflection(s, t, dry, modulus),
            area=area * there.stretch,
            radius=np.hypot(s, t),
        ),
        mismatch,
    )


def around_line(
    bodies: Bodies,
    half_width: float,
    reduced_radius: float,
    film: tuple[Array, Array],
    *,
    length: float,
    ring: tuple[float, float] = (0.0, np.inf),
) -> Outside:
    """Gap before and behind the film of a line contact.

    ``half_width`` and ``reduced_radius`` belong to the dry contact [m]. ``film`` has the nodes and the
    thickness [m], both (nx,). ``length`` is the length of the contact across entrainment, and ``ring`` bounds
    the distance from the contact [m].
    """
    x, thickness = film
    starts = np.abs([x[0], x[-1]])
    ends = starts * _end(bodies, 0.0, starts, np.zeros(2))
    first, last = np.clip(starts, *ring), np.clip(ends, *ring)
    s, weights = stretched(first, np.maximum(first, last), starts, _OUTWARDS)
    # With this constant at each end the gap continues the film.
    edge = points(bodies, 0.0, starts, np.zeros(2)).gap + line_opening(starts, half_width, reduced_radius)
    offset = (np.array([thickness[0], thickness[-1]]) - edge)[:, np.newaxis]
    there = points(bodies, 0.0, s.ravel(), np.zeros(s.size))
    return Outside(
        at=there,
        opening=(line_opening(s, half_width, reduced_radius) + offset).ravel(),
        area=length * weights.ravel() * there.stretch,
        radius=s.ravel(),
    )


def _rays(
    bodies: Bodies, offset: float, domain: Domain, width: float | None, ring: tuple[float, float]
) -> tuple[Array, Array, Array]:
    """Nodes (s, t) outside a rectangle, and ds dt of each; rays go outwards from nodes along its edges.

    Both halves, y > 0 and y < 0, are equal, so the nodes of one half count twice.
    """
    inlet, outlet, side = domain
    unit, weights = stretched(0.0, 1.0, 1.0, _ALONG_EDGE)
    rays = []
    # A point of the edge and the edge's direction, times its length.
    for x, y, dx, dy in (
        (outlet, 0.0, 0.0, side),
        (outlet, side, -outlet, 0.0),
        (0.0, side, inlet, 0.0),
        (inlet, side, 0.0, -side),
    ):
        s, t = x + dx * unit, y + dy * unit
        rays.append((s, t, np.abs(s * dy - t * dx) * weights))
    s, t, across = (np.concatenate(part) for part in zip(*rays, strict=True))
    distance = np.hypot(s, t)
    end = _end(bodies, offset, s, t, width)
    first, last = (np.clip(part, ring[0] / distance, ring[1] / distance) for part in (1.0, end))
    out, outwards = stretched(first, np.maximum(first, last), 1.0, _OUTWARDS)
    area = 2.0 * across[:, np.newaxis] * outwards * out
    return s[:, np.newaxis] * out, t[:, np.newaxis] * out, area


def _end(bodies: Bodies, offset: float, s: Array, t: Array, width: float | None = None) -> Array:
    """Factor by which each ray through (s, t) is longer at the end of the gap; 1 if it ends before (s, t)."""
    most = _FARTHEST / bodies.far.along / np.hypot(s, t)
    for curvature, arc in ((bodies.near.along, s), (bodies.near.across, t)):
        most = np.minimum(most, 0.5 * np.pi / np.maximum(np.abs(curvature * arc), _TINY))
    if width is not None:
        bent = 0.5 * width * bodies.near.across
        half = 0.5 * width * float(np.arcsin(np.clip(bent, -1.0, 1.0)) / bent if bent else 1.0)
        most = np.minimum(most, half / np.maximum(np.abs(t), _TINY))
    most = np.maximum(1.0, most)
    low, high = np.ones_like(most), most
    for share in np.linspace(1.0, 0.0, _STEPS, endpoint=False):
        at = most**share
        high = np.where(points(bodies, offset, at * s, at * t).facing < 0.0, at, high)
    for _ in range(_BISECTIONS):
        middle = 0.5 * (low + high)
        facing = points(bodies, offset, middle * s, middle * t).facing >= 0.0
        low, high = np.where(facing, middle, low), np.where(facing, high, middle)
    return high
