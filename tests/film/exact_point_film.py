"""A film of a point contact chosen freely, and the added gap and the source that make it the exact solution.

With t and s from -1 to 1 along and across the domain the pressure is P = c (1 - t^2)^2 (1 + t/4) (1 - s^2)^2
(1 + q s): zero at the edges and a polynomial between them. Its deflection, the integral of P/r, is taken by
quadrature to rounding: seen from the node at hand the domain is eight triangles of height a, in each of
which, with u = a p and v = a p sinh(q), the integral of P/r du dv is that of a P dp dq, of a polynomial in p
and an entire function of q.
"""

from dataclasses import dataclass
from functools import cache

import numpy as np
import sympy

from ehlectric.film.deflection import point_geometry
from ehlectric.film.face_flow import Fluid
from ehlectric.film.mesh import Width
from ehlectric.film.problem import FilmProblem
from ehlectric.lubricant.density import dowson_higginson
from ehlectric.lubricant.viscosity import roelands

INLET, OUTLET, SIDE = -1.9, 1.3, 1.8
MIDDLE, HALF = 0.5 * (INLET + OUTLET), 0.5 * (OUTLET - INLET)
H00 = -0.35
VELOCITY_PARAMETER = 0.05
SKEW_ALONG = 0.25
RADIUS_RATIO, ELLIPSE_RATIO, COMPLIANCE = 0.6, 1.3, 0.18
LOAD = 2.0 * np.pi / 3.0 * ELLIPSE_RATIO

# The paper's lubricant at the Hertz pressure 0.7 GPa.
_P_H = 0.7e9
VISCOSITY = {
    "pressure_viscosity_coefficient": 22e-9 * _P_H,
    "roelands_z": 0.67,
    "roelands_pressure": 0.198e9 / _P_H,
}
DENSITY = {"density_c1": 0.59e9 / _P_H, "density_c2": 1.34}

# The skew parts are odd and carry no load; (1 - t^2)^2 integrates to 16/15.
SCALE = LOAD / (HALF * SIDE * (16.0 / 15.0) ** 2)

# Enough for the tenth power of p, and for e^(10 q) as far as the flattest triangle of 513 nodes asks.
_P_POINTS, _Q_POINTS = 8, 32


def _polynomial(x, y, skew):
    """P, of numbers or symbols."""
    t, s = (x - MIDDLE) / HALF, y / SIDE
    return SCALE * ((1 - t**2) * (1 - s**2)) ** 2 * (1 + SKEW_ALONG * t) * (1 + skew * s)


@cache
def _expressions(skew):
    """H and the source as functions of x and y."""
    x, y = sympy.symbols("x y")
    pressure = _polynomial(x, y, skew)
    # A paraboloid that closes towards the exit, with a constriction there that bends back at the sides.
    bend = x - 0.7 + y**2 / 5
    parabola = ((x - 0.2) ** 2 + 0.7 * (y - 0.3 * skew) ** 2) / 10
    thickness = 0.15 + parabola - 0.03 * sympy.exp(-4 * bend**2 - y**2) * (1 + skew * y)
    c1, c2 = DENSITY["density_c1"], DENSITY["density_c2"]
    density = (c1 + c2 * pressure) / (c1 + pressure)
    alpha, z, p0 = VISCOSITY.values()
    viscosity = sympy.exp(alpha * p0 / z * ((1 + pressure / p0) ** z - 1))
    eps = density * thickness**3 / (viscosity * VELOCITY_PARAMETER)
    source = sympy.diff(density * thickness, x)
    for along in (x, y):
        source -= sympy.diff(eps * sympy.diff(pressure, along), along)
    return [sympy.lambdify((x, y), expression, cse=True) for expression in (thickness, source)]


@dataclass(frozen=True)
class ManufacturedFilm:
    """The film whose halves differ by ``skew``; without it they are mirror images.

    Its methods take the nodes x (nx,) and y (ny,) of a grid.
    """

    skew: float = 0.0

    def pressure(self, x, y):
        """P, shape (nx, ny)."""
        return _polynomial(x[:, np.newaxis], y, self.skew)

    def thickness(self, x, y):
        """H, shape (nx, ny)."""
        return _expressions(self.skew)[0](x[:, np.newaxis], y)

    def source(self, x, y):
        """Right side of the Reynolds equation, shape (nx, ny)."""
        return _expressions(self.skew)[1](x[:, np.newaxis], y)

    def deflection(self, x, y):
        """Gap opened by the pressure, shape (nx, ny)."""
        return COMPLIANCE * np.array([self._potential(at, y) for at in x])

    def _potential(self, x, y):
        """Integral of P/r on one line across, of x and y (ny,)."""
        y = y[:, np.newaxis, np.newaxis]
        total = np.zeros(y.shape)
        for sign_x, along in ((1.0, OUTLET - x), (-1.0, x - INLET)):
            for sign_y, across in ((1.0, SIDE - y), (-1.0, y + SIDE)):
                for swapped in (False, True):
                    high, wide = (across, along) if swapped else (along, across)
                    u, v, weights = _triangle(np.broadcast_to(high, y.shape), wide)
                    dx, dy = (v, u) if swapped else (u, v)
                    values = _polynomial(x + sign_x * dx, y + sign_y * dy, self.skew)
                    total += (weights * values).sum(axis=(1, 2), keepdims=True)
        return total[:, 0, 0]

    def _added_gap(self, x, y):
        dry = 0.5 * x[:, np.newaxis] ** 2 + 0.5 * RADIUS_RATIO * y**2
        return self.thickness(x, y) - H00 - dry - self.deflection(x, y)

    def problem(self, nodes, nodes_y, *, wedge_order, symmetric=None):
        """The film problem whose exact solution this is, on the half that is solved for or on the whole."""
        return FilmProblem(
            Fluid(
                density=lambda p: dowson_higginson(p, **DENSITY),
                log_viscosity=lambda p: roelands(p, **VISCOSITY),
                velocity_parameter=VELOCITY_PARAMETER,
                ambient_pressure=0.0,
            ),
            nodes,
            inlet=INLET,
            outlet=OUTLET,
            thickness_guess=0.15,
            wedge_order=wedge_order,
            geometry=point_geometry(
                radius_ratio=RADIUS_RATIO, ellipse_ratio=ELLIPSE_RATIO, compliance=COMPLIANCE
            ),
            width=Width(nodes_y, SIDE, symmetric=self.skew == 0.0 if symmetric is None else symmetric),
            added_gap=self._added_gap,
            source=self.source,
        )


def _triangle(high, wide):
    """Points and weights of the integral of f(u, v)/r over 0 < u < high, 0 < v < u wide/high.

    At an edge of the domain the triangles along it have no height, and no weight.
    """
    p, p_weights = _gauss(_P_POINTS)
    q, q_weights = _gauss(_Q_POINTS)
    most = np.where(high > 0.0, np.arcsinh(wide / np.where(high > 0.0, high, 1.0)), 0.0)
    u = high * p[:, np.newaxis]
    v = u * np.sinh(most * q)
    return u, v, high * most * p_weights[:, np.newaxis] * q_weights


def _gauss(points):
    """Gauss-Legendre nodes and weights over [0, 1]."""
    nodes, weights = np.polynomial.legendre.leggauss(points)
    return 0.5 * (nodes + 1.0), 0.5 * weights
