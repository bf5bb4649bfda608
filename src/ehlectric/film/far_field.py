"""Oil around the domain of a point contact: its pressure on the edges, its load, and what a film loses
without them.

Far from a contact the pressure is low and the gap a parabola. The Reynolds equation for constant density and
viscosity then has an exact solution without cavitation (P. Kapitza, Zh. Tekh. Fiz. 25 (1955) 747),

    P = -lambda X/((3 + 2 k) H^2),   H = H0 + X^2/2 + k Y^2/2,   k = Rx/Ry, X < 0.

It falls with the cube of the distance, and the load that it carries beyond a distance falls with the distance
only. A domain at whose edges the oil is at ambient pressure therefore makes the film of a lightly loaded
contact too thin.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from ehlectric.arrays import Array, Numbers, as_float

if TYPE_CHECKING:
    from ehlectric.film.mesh import Mesh
    from ehlectric.film.problem import FilmProblem

# Load that is missing in the whole contact divided by the part of it outside of the domain. Inside, the
# pressure is lower by about the pressure of the edges. With 79 contacts, loads N from 2.5 to 200, L from 0.5
# to 25 and ratios of the semi-axes from 0.5 to 8, on domains that end at 2 to 90 semi-axes, it was 1 to 2.
_WHOLE_LOAD = 2.0

# Largest share of the load outside of a domain with a far field.
MOST_OUTSIDE = 0.5

# What the far field leaves of the missing shares: of the reduced pressure, and of the load, where it is this
# number times the square of the share. The far field knows neither the deflection at the edges nor the film
# exactly. The loss of the same 79 contacts did not exceed the estimate.
_LEFT_OF_PRESSURE, _LEFT_OF_LOAD = 0.4, 0.35


def with_far_field(problem: FilmProblem) -> FilmProblem:
    """Problem of a flooded point contact whose oil outside of the domain carries its part of the load.

    The edges of the domain have the pressure of that oil. Its deflection of the surfaces is neglected. A
    problem stays as it is where more than half of the load would lie outside.
    """
    outside = load_outside(problem)
    if outside > MOST_OUTSIDE:
        return problem
    ratio, fluid, film = problem.geometry.radius_ratio, problem.fluid, problem.thickness_guess

    def pressure(x: Array, y: Array) -> Array:
        gap = film + 0.5 * (x[:, np.newaxis] ** 2 + ratio * y**2)
        return fluid.ambient_pressure + _slope(problem) * np.maximum(-x, 0.0)[:, np.newaxis] / gap**2

    return replace(problem, edge_pressure=pressure, outside_load=outside * problem.geometry.load)


def _slope(problem: FilmProblem) -> float:
    """Pressure of the far field times H^2/-X, dimensionless."""
    return problem.fluid.velocity_parameter / (3.0 + 2.0 * problem.geometry.radius_ratio)


def load_outside(problem: FilmProblem) -> float:
    """Load that oil would carry upstream of the domain of a point contact and at its sides, divided by its
    load.
    """
    assert problem.width is not None
    missing = missing_load(
        problem.geometry.radius_ratio,
        (-problem.inlet, problem.width.side),
        problem.fluid.velocity_parameter,
    )
    return float(missing / problem.geometry.load)


def missing_load(ratio: Numbers, domain: tuple[Numbers, Numbers], velocity_parameter: Numbers) -> Numbers:
    """Load of ``load_outside`` without its division by the load of the contact, dimensionless.

    ``ratio``, k = Rx/Ry; ``domain``, length of the inlet and half of the width of the domain in b; all of
    shape (...).

    The pressure of the far field of touching bodies is integrated over the half-plane X < 0 outside of the
    domain. With the angle t from the inlet in the plane of X and sqrt(k) Y, and R(t) from the centre to the
    edge of the domain, it is 4 lambda/((3 + 2 k) sqrt(k)) times the integral of cos(t)/R(t). Rays up to the
    angle T of the corner end at the inlet, R = A/cos(t), and the others at the sides, R = S/sin(t): the
    integral is (T + sin(2 T)/2)/A + cos(T)^2/S.

    Examples
    --------
    A domain that is endless across has 2 pi lambda/(5 A) ahead of it, for k = 1:

    >>> round(missing_load(1.0, (5.0, 1e6), 0.1) / (2.0 * np.pi * 0.1 / 25.0), 5)
    1.0
    """
    inlet, side = domain[0], np.sqrt(ratio) * domain[1]
    corner = np.arctan2(side, inlet)
    integral = (corner + 0.5 * np.sin(2.0 * corner)) / inlet + np.cos(corner) ** 2 / side
    return as_float(4.0 * velocity_parameter / ((3.0 + 2.0 * ratio) * np.sqrt(ratio)) * integral)


def lost_by_load(missing: Numbers, exponent: Numbers) -> Numbers:
    """Relative loss of the film of a point contact, dimensionless.

    ``missing``, share of ``load_outside`` that the film does without; ``exponent``, with which the film falls
    over the load: 2 for rigid bodies and constant viscosity, about 0.1 for heavy loads.

    Examples
    --------
    >>> round(lost_by_load(0.001, 2.0), 5)
    0.00399
    """
    return as_float(-np.expm1(-_WHOLE_LOAD * exponent * missing))


def left_of_load(share: Numbers) -> Numbers:
    """Share of the load that a film with its far field does without, from the share that ``load_outside``
    returns.
    """
    return _LEFT_OF_LOAD * share**2


def load_deficit(problem: FilmProblem) -> float:
    """Share of the load that the film of a point contact does without, from 0 on."""
    share = load_outside(problem)
    return float(left_of_load(share)) if problem.outside_load else share


def pressure_deficit(problem: FilmProblem, share: float) -> float:
    """Share of the reduced pressure that is missing at an edge, less what the far field adds."""
    return _LEFT_OF_PRESSURE * share if problem.outside_load else share


def side_deficit(problem: FilmProblem, mesh: Mesh, pressure: Array, thickness: Array) -> float:
    """Share of the reduced pressure that is missing at the sides of the domain.
    ``pressure`` and ``thickness``, pressure P and film thickness H, dimensionless, shape (nx, ny). Returns
    share of the reduced pressure, from 0 to 1; 0 for an invalid iterate.

    The largest pressure of the far field on the sides is compared with the largest reduced pressure, the
    integral of dP/eta, on the line Y = 0.
    """
    from ehlectric.film.film_errors import reduced_pressure  # late: bearings of the atlas do not need it

    if not np.all(np.isfinite(pressure)):
        return 0.0
    inside = reduced_pressure(problem.fluid, pressure[:, int(np.argmin(np.abs(mesh.y)))])
    outside = _slope(problem) * float(np.max(np.maximum(-mesh.x, 0.0) / thickness[:, -1] ** 2))
    return pressure_deficit(problem, outside / (outside + inside))
