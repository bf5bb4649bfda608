"""Relaxation of the paper's film equations on one grid, and their solution on the coarsest grid.

The relaxation changes single pressures (Gauss-Seidel) where eps/dX^2 is large against 1/dX, and dipoles of
pressures where it is small, all along the line together. On the coarsest grid H00 is computed by eq. (19).
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import scipy

from ehlectric.arrays import Array, Mask
from ehlectric.paper.film_equations import NEIGHBOURS, Coefficients, FilmEquations, Iterate

# Number of neighbours on each side of a node whose unknowns a relaxation couples to the unknown of the node.
HALF_BAND = 6

# Largest change of a pressure P in one relaxation.
CHANGE = 0.1

# Damping factor c of eq. (19). It is negative: H00 must be lowered if the pressure carries too little
# load. The dimensionless load of a Hertz contact falls by 4.5 when its H00 is raised by 1.
LOAD_DAMPING = -0.2

# On the coarsest grid of a cycle: Newton steps for P at a fixed H00, and changes of H00.
COARSE_STEPS, LOAD_STEPS = 2, 3


def relax(equations: FilmEquations, at: Iterate) -> Iterate:
    """Relax the pressure of all nodes together, once, at a fixed H00.

    Where eps/dX^2 is large against 1/dX, the unknowns are changes of single pressures. Elsewhere they are
    dipoles, +1 at a node and -1 at the node before. All unknowns are solved for together, each coupled to six
    neighbours on each side, because relaxation node by node stalls at the pressure spike.

    Returns new iterate, with no pressure below ambient.
    """
    c = equations.coefficients(at)
    residual = equations.residual(at, c)
    free = equations.free(at, residual)
    dipole = free & (equations.poiseuille(c) < 1.0 / equations.dx)
    dipole[1:] &= free[:-1]
    band = _band(equations, equations.derivatives(at, c), free, dipole)
    unknown = _solve_band(band, np.where(free, residual, 0.0))
    change = unknown.copy()
    change[:-1] -= np.where(dipole[1:], unknown[1:], 0.0)
    return _moved(equations, at, np.clip(change, -CHANGE, CHANGE))


def _band(equations: FilmEquations, derivatives: tuple[Array, Array], free: Mask, dipole: Mask) -> Array:
    """Band matrix of the derivatives of L by the unknowns of a relaxation, in LAPACK's storage.

    Cavitated nodes have a 1 on the diagonal, so that they do not change.
    """
    n = equations.x.size
    by_p, by_h = derivatives

    def diagonal(offset: int) -> Array:
        """Derivative dL_i/dP_(i + offset) with the deflection included, shape (n,)."""
        whole = np.zeros(n)
        for row, node in enumerate(NEIGHBOURS):
            whole += by_h[row] * equations.kernel[abs(offset - node)]
            if node == offset:
                whole += by_p[row]
        return whole

    band = np.zeros((2 * HALF_BAND + 1, n))
    before = diagonal(-HALF_BAND - 1)
    for offset in range(-HALF_BAND, HALF_BAND + 1):
        rows = slice(max(0, -offset), min(n, n - offset))
        columns = slice(max(0, offset), min(n, n + offset))
        here = diagonal(offset)
        entries = here[rows] - np.where(dipole[columns], before[rows], 0.0)
        band[HALF_BAND - offset, columns] = np.where(free[rows] & free[columns], entries, 0.0)
        before = here
    band[HALF_BAND, ~free] = 1.0
    return band


def _solve_band(band: Array, right: Array) -> Array:
    """Solution of a banded linear system; NaN if the matrix is singular or not finite."""
    if not np.all(np.isfinite(band)):
        return np.full_like(right, np.nan)
    try:
        solution: Array = scipy.linalg.solve_banded((HALF_BAND, HALF_BAND), band, right, check_finite=False)
    except np.linalg.LinAlgError:
        return np.full_like(right, np.nan)
    return solution


def _moved(equations: FilmEquations, at: Iterate, change: Array) -> Iterate:
    """Add a change to the pressures, with none below ambient and the two ends fixed."""
    change[0] = change[-1] = 0.0
    return replace(at, pressure=np.maximum(at.pressure + change, equations.fluid.ambient_pressure))


def solve_coarsest(equations: FilmEquations, at: Iterate) -> Iterate:
    """Solve on the coarsest grid, in turn for the pressure by Newton's method and for H00 by eq. (19)."""
    for _ in range(LOAD_STEPS):
        for _ in range(COARSE_STEPS):
            at = newton_step(equations, at)
        missing = equations.load - equations.carried(at.pressure)
        at = replace(at, h00=at.h00 + LOAD_DAMPING * missing)
    return at


def newton_step(equations: FilmEquations, at: Iterate) -> Iterate:
    """Make one step of Newton's method for the pressure at a fixed H00, with the dense Jacobian."""
    c = equations.coefficients(at)
    residual = equations.residual(at, c)
    free = equations.free(at, residual)
    jacobian = whole_jacobian(equations, equations.derivatives(at, c))[np.ix_(free, free)]
    change = np.zeros_like(residual)
    if np.all(np.isfinite(jacobian)):
        change[free] = np.linalg.solve(jacobian, residual[free])
    return _moved(equations, at, _limited(equations, c, change))


def whole_jacobian(equations: FilmEquations, derivatives: tuple[Array, Array]) -> Array:
    """Dense derivative dL/dP with the deflection included, shape (n, n); the first and last rows are zero."""
    by_p, by_h = derivatives
    return _dense(by_p) + _dense(by_h) @ equations.kernel_matrix


def _dense(rows: Array) -> Array:
    """Dense matrix (n, n) of derivatives by the nodes of NEIGHBOURS, shape (4, n)."""
    n = rows.shape[1]
    matrix = np.zeros((n, n))
    for row, node in zip(rows, NEIGHBOURS, strict=True):
        matrix += np.diag(row[max(0, -node) : n - max(0, node)], node)
    return matrix


def _limited(equations: FilmEquations, c: Coefficients, change: Array) -> Array:
    """Shorten a Newton step: no P changes by more than 0.3, and no H falls below 0.3 of its value."""
    gap = equations.deflection(change)
    closing = np.max(np.maximum(-gap, 0.0) / (0.7 * c.thickness))
    longest = max(1.0, float(np.max(np.abs(change))) / 0.3, float(closing))
    return change / longest
