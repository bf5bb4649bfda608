"""Baselines for the solvers: dense Newton for the film, SuperLU for the field."""

from __future__ import annotations

from functools import partial
from unittest.mock import patch

import numpy as np
from scipy import sparse
from scipy.constants import epsilon_0
from scipy.linalg import lu_factor, lu_solve
from scipy.sparse.linalg import splu

from ehlectric.arrays import Array
from ehlectric.field.poisson import FieldProblem
from ehlectric.film import isothermal_film, newton
from ehlectric.film.face_flow import Fluid
from ehlectric.film.isothermal_film import Film, solve_film
from ehlectric.film.multigrid import Linearised
from ehlectric.film.newton import Residual, State
from ehlectric.film.problem import FilmProblem

# Overflows of intermediate iterates are no warnings, as within ``quiet_solution``.
_ON_ALL_THREADS = partial(np.errstate, over="ignore", invalid="ignore", divide="ignore")


def dense_direction(
    fluid: Fluid,
    jacobians: list[Linearised],
    state: State,
    now: Residual,
    tolerance: float,  # noqa: ARG001  # as of the function that it replaces; LAPACK solves to rounding
) -> tuple[Array, float, int]:
    """Newton direction by LAPACK: the whole Jacobian is assembled and factorised."""
    jacobian = jacobians[0]
    level, n = jacobian.level, state.pressure.size
    resting = fluid.ambient_pressure + level.edge_excess
    to_ambient = np.where(now.full_film, 0.0, resting - state.pressure)
    change, load = jacobian(to_ambient, 0.0)
    matrix = np.zeros((n + 1, n + 1))
    matrix[:n, :n] = jacobian.by_p.matrix() + jacobian.by_h.times(level.deflection.matrix)
    matrix[:n, n] = jacobian.by_h.coefficients.sum(axis=0).ravel()
    matrix[n, :n] = np.where(now.full_film, level.weights, 0.0).ravel()
    cavitated = np.flatnonzero(~now.full_film)
    matrix[cavitated, cavitated] = 1.0
    right = np.append(np.where(now.full_film, -now.reynolds - change, 0.0), now.load - load)
    solution = lu_solve(lu_factor(matrix, overwrite_a=True, check_finite=False), right)
    change_inside = np.where(now.full_film, solution[:n].reshape(state.pressure.shape), 0.0)
    return to_ambient + change_inside, float(solution[n]), 0


def solve_film_densely(problem: FilmProblem) -> Film:
    """``solve_film`` with every linear system solved by LAPACK on all threads."""
    dense = patch.object(newton, newton._direction.__name__, dense_direction)
    with dense, patch.object(isothermal_film, "quiet_solution", _ON_ALL_THREADS):
        return solve_film(problem)


def capacitance_by_superlu(problem: FieldProblem, across: int = 65) -> float:
    """Capacitance per length [F/m] by linear elements on nx x ``across`` nodes and a sparse LU.

    Four-node elements on the mapped grid, integrated at 2 x 2 Gauss points.
    """
    nx = problem.x.size
    s = np.linspace(0.0, 1.0, across)
    gap = problem.upper - problem.lower
    dx, ds = np.diff(problem.x)[:, np.newaxis], s[1] - s[0]
    numbers = np.arange(nx * across).reshape(nx, across)
    corners = np.stack([numbers[:-1, :-1], numbers[1:, :-1], numbers[:-1, 1:], numbers[1:, 1:]], axis=-1)
    matrix = np.zeros((nx - 1, across - 1, 4, 4))
    points = np.array([0.5 - np.sqrt(3.0) / 6.0, 0.5 + np.sqrt(3.0) / 6.0])
    for u in points:
        h = ((1 - u) * gap[:-1] + u * gap[1:])[:, np.newaxis]
        eps = ((1 - u) * problem.permittivity[:-1] + u * problem.permittivity[1:])[:, np.newaxis]
        for v in points:
            slope = (np.diff(problem.lower) + np.diff(gap) * (s[:-1] + v * ds)[:, np.newaxis]).T / dx
            by_x = np.array([-(1 - v), 1 - v, -v, v]) / dx[:, :, np.newaxis]
            by_s = np.array([-(1 - u), -u, 1 - u, u]) / ds
            gradient_x = by_x - (slope / h)[:, :, np.newaxis] * by_s
            gradient_y = by_s / h[:, :, np.newaxis]
            weight = (0.25 * eps * h * dx * ds)[:, :, np.newaxis, np.newaxis]
            for g in (gradient_x, np.broadcast_to(gradient_y, gradient_x.shape)):
                matrix += weight * g[:, :, :, np.newaxis] * g[:, :, np.newaxis, :]
    rows = np.broadcast_to(corners[:, :, :, np.newaxis], matrix.shape)
    columns = np.broadcast_to(corners[:, :, np.newaxis, :], matrix.shape)
    stiffness = sparse.csc_array(
        (matrix.ravel(), (rows.ravel(), columns.ravel())), shape=(nx * across, nx * across)
    )
    wall = np.concatenate([numbers[:, 0], numbers[:, -1]])
    inner = numbers[:, 1:-1].ravel()
    v = np.zeros(nx * across)
    v[numbers[:, -1]] = 1.0
    v[inner] = splu(stiffness[inner][:, inner].tocsc()).solve(-(stiffness[inner][:, wall] @ v[wall]))
    return float(epsilon_0 * v @ (stiffness @ v))
