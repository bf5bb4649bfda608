"""Nonlinear elimination: the film equations solved on a few nodes, with all others held.

The pressure spike is a jump over two or three nodes on every grid, and between them the viscosity
changes by orders of magnitude. A coarse solution carried to a finer grid is right everywhere else; the
jump makes global Newton steps small and many. Solving those nodes by themselves first removes it.

The method is nonlinear elimination as in X.-C. Cai and X. Li, SIAM J. Sci. Comput. 33 (2011) 746,
doi:10.1137/080736272, with one window around the largest residual.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.linalg import lapack, toeplitz

from ehlectric.arrays import Array, Mask
from ehlectric.film.levels import Level
from ehlectric.film.mesh import Mesh
from ehlectric.film.reynolds import Coefficients, Fluid, Stencil, evaluate, linearise, residual

# Scaled residual above which a node counts as strongly nonlinear.
THRESHOLD = 0.02

# Nodes of the window on each side of the largest residual: ten times the width of the jump.
HALF_WINDOW = 20

# Neighbours outside the window that its equations read: two upstream, one downstream.
MARGIN = 2
MAX_ITERATIONS = 30


@dataclass(frozen=True)
class _Window:
    """The nodes solved for, and the strip of held neighbours around them."""

    strip: slice
    inner: slice  # within the strip
    column: int
    influence: Array  # change of H on the strip by P in the window
    wedge: Stencil
    source: Array  # on the strip
    mesh: Mesh

    @classmethod
    def around(cls, level: Level, node: int, column: int) -> _Window:
        nx = level.nodes
        start, stop = max(1, node - HALF_WINDOW), min(nx - 1, node + HALF_WINDOW + 1)
        strip = slice(max(0, start - MARGIN), min(nx, stop + MARGIN))
        inner = slice(start - strip.start, stop - strip.start)
        kernel = toeplitz(level.deflection.influence[: strip.stop - strip.start, 0])
        wedge = Stencil(level.wedge.coefficients[:, strip, column : column + 1])
        source = level.source[strip, column : column + 1]
        mesh = Mesh(level.mesh.x[strip], level.mesh.y[:1])
        return cls(strip, inner, column, kernel[:, inner], wedge, source, mesh)

    def cut(self, values: Array) -> Array:
        """The strip out of a whole grid, shape (n, 1)."""
        return values[self.strip, self.column : self.column + 1]

    def residual(self, coefficients: Coefficients, pressure: Array, thickness: Array) -> Array:
        """Reynolds residual at the nodes of the window."""
        r = residual(coefficients, self.wedge, pressure, thickness, self.mesh) - self.source
        return r[self.inner, 0]

    def jacobian(self, coefficients: Coefficients, pressure: Array, thickness: Array) -> Array:
        """dr/dP among the nodes of the window."""
        by_p, by_h = linearise(coefficients, self.wedge, pressure, thickness, self.mesh)
        whole = by_p.matrix()[:, self.inner] + by_h.matrix() @ self.influence
        return whole[self.inner]


def relax_spike(
    fluid: Fluid,
    level: Level,
    *,
    pressure: Array,
    thickness: Array,
    free: Mask,
    scaled_residual: Array,
    pressure_step: float,
    gap_step: float,
) -> Array | None:
    """Pressure with the nodes around the largest residual solved for, or None.

    Parameters
    ----------
    fluid, level : Fluid, Level
        The problem and the grid.
    pressure, thickness, free, scaled_residual : ndarray, shape (nx, ny)
        The state, its free nodes and its residual in units of pressure, all dimensionless.
    pressure_step, gap_step : float
        Limits of one Newton step, as for the whole film.

    Returns
    -------
    ndarray, shape (nx, ny), or None
        None where no node is strongly nonlinear or the small problem was not solved: the caller goes
        on from the state it has.
    """
    magnitude = np.abs(scaled_residual)
    node, column = np.unravel_index(int(np.argmax(magnitude)), magnitude.shape)
    if not magnitude[node, column] > THRESHOLD:
        return None
    window = _Window.around(level, int(node), int(column))
    unknown = np.flatnonzero(free[window.strip, window.column][window.inner])
    p, h = window.cut(pressure).copy(), window.cut(thickness).copy()
    for _ in range(MAX_ITERATIONS):
        coefficients = evaluate(fluid, p, h)
        r = window.residual(coefficients, p, h)[unknown]
        jacobian = window.jacobian(coefficients, p, h)[np.ix_(unknown, unknown)]
        # Rows scaled by their largest entry: their coefficients span many orders of magnitude.
        rows = 1.0 / np.max(np.abs(jacobian), axis=1)
        norm = float(np.max(np.abs(rows * r)))
        if not np.isfinite(norm):
            return None
        if norm < 1e-2 * THRESHOLD:
            relaxed: Array = pressure.copy()
            relaxed[window.strip, window.column] = p[:, 0]
            return relaxed
        dp = np.zeros((window.inner.stop - window.inner.start, 1))
        *_, step, singular = lapack.dgesv(rows[:, np.newaxis] * jacobian, -rows * r)
        if singular:
            return None
        dp[unknown, 0] = step
        dh = window.influence @ dp
        length = step_length(h, dp, dh, pressure_step=pressure_step, gap_step=gap_step)
        p[window.inner] += length * dp
        h += length * dh
    return None


def step_length(thickness: Array, dp: Array, dh: Array, *, pressure_step: float, gap_step: float) -> float:
    """Largest step in (0, 1] that changes no pressure by more than ``pressure_step`` and leaves every
    gap at least ``gap_step`` of itself.
    """
    length = min(1.0, pressure_step / max(float(np.max(np.abs(dp))), 1e-300))
    closing = dh < 0.0
    if closing.any():
        length = min(length, float(np.min((gap_step - 1.0) * thickness[closing] / dh[closing])))
    return length
