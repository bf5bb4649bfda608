"""Nonlinear elimination at the pressure spike: the film equations solved on a few nodes, all others fixed.

The pressure spike is a jump over two or three nodes on every grid, and between these nodes the viscosity
changes by orders of magnitude. A solution interpolated from a coarser grid is accurate everywhere else. The
jump makes global Newton steps small and many. Solving its nodes separately first removes it.

The method is nonlinear elimination as in X.-C. Cai and X. Li, SIAM J. Sci. Comput. 33 (2011) 746,
doi:10.1137/080736272, with one window around the largest residual.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.linalg import lapack

from ehlectric.arrays import Array, Mask
from ehlectric.film.flow import Flow, Fluid, flow
from ehlectric.film.gap import Gap
from ehlectric.film.mesh import Mesh
from ehlectric.film.reynolds import Stencil, linearise, residual

# Scaled residual above which a node counts as strongly nonlinear.
_THRESHOLD = 0.02

# Nodes on each side of the largest residual: ten times the width of the jump.
_HALF_WINDOW = 20

# Neighbours outside the window that its equations read: two upstream, one downstream.
_MARGIN = 2
_MAX_ITERATIONS = 30


@dataclass(frozen=True)
class _Window:
    """Nodes that are solved for, and the strip of fixed neighbours around them.

    ``strip`` and ``column`` are places on the grid, ``inner`` the window within the strip. ``influence`` is
    the derivative of H on the strip by P in the window; ``source`` and the stencil are those of the strip.
    """

    strip: slice
    inner: slice
    column: int
    influence: Array
    wedge: Stencil
    source: Array
    mesh: Mesh

    @classmethod
    def around(cls, gap: Gap, node: int, column: int) -> _Window:
        """Window around a node of one line along x."""
        level = gap.level
        nx = level.nodes
        start, stop = max(1, node - _HALF_WINDOW), min(nx - 1, node + _HALF_WINDOW + 1)
        strip = slice(max(0, start - _MARGIN), min(nx, stop + _MARGIN))
        inner = slice(start - strip.start, stop - strip.start)
        wedge = Stencil(level.wedge.coefficients[:, strip, column : column + 1])
        source = level.source[strip, column : column + 1]
        mesh = Mesh(level.mesh.x[strip], level.mesh.y[:1])
        return cls(strip, inner, column, gap.block(strip, inner), wedge, source, mesh)

    def cut(self, values: Array) -> Array:
        """Values of a whole grid (nx, ny) on the strip, shape (n, 1)."""
        return values[self.strip, self.column : self.column + 1]

    def residual(self, at_faces: Flow, thickness: Array) -> Array:
        """Reynolds residual at the nodes of the window."""
        r = residual(at_faces, self.wedge, thickness, self.mesh) - self.source
        return r[self.inner, 0]

    def jacobian(self, at_faces: Flow, thickness: Array) -> Array:
        """Derivative of the residual by P among the nodes of the window."""
        by_p, by_h = linearise(at_faces, self.wedge, thickness, self.mesh)
        whole = by_p.matrix()[:, self.inner] + by_h.matrix() @ self.influence
        return whole[self.inner]


def relax_spike(
    fluid: Fluid,
    gap: Gap,
    *,
    pressure: Array,
    full_film: Mask,
    scaled_residual: Array,
    pressure_step: float,
    gap_step: float,
) -> Array | None:
    """Pressure after solving the nodes around the largest residual of a line contact separately.

    Parameters
    ----------
    fluid : Fluid
        Lubricant over dimensionless pressure.
    gap : Gap
        Gap of the state.
    pressure, full_film, scaled_residual : ndarray, shape (nx, ny)
        State: P, the nodes with a full film, and the residual as a pressure over p_h.
    pressure_step, gap_step : float
        Limits of one Newton step, as for the whole film (``step_length``).

    Returns
    -------
    ndarray, shape (nx, ny), or None
        None where no node is strongly nonlinear or the small problem was not solved: the caller continues
        with the state it has.
    """
    magnitude = np.abs(scaled_residual)
    node, column = np.unravel_index(int(np.argmax(magnitude)), magnitude.shape)
    if not magnitude[node, column] > _THRESHOLD:
        return None
    window = _Window.around(gap, int(node), int(column))
    unknown = np.flatnonzero(full_film[window.strip, window.column][window.inner])
    p, h = window.cut(pressure).copy(), window.cut(gap.thickness).copy()
    for _ in range(_MAX_ITERATIONS):
        at_faces = flow(fluid, p, h, window.mesh)
        r = window.residual(at_faces, h)[unknown]
        jacobian = window.jacobian(at_faces, h)[np.ix_(unknown, unknown)]
        # Rows scaled by their largest entry: their coefficients span many orders of magnitude.
        rows = 1.0 / np.max(np.abs(jacobian), axis=1)
        norm = float(np.max(np.abs(rows * r)))
        if not np.isfinite(norm):
            return None
        if norm < 1e-2 * _THRESHOLD:
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
    """Largest step in (0, 1] along (dP, dH) that keeps within the limits of one Newton step.

    Parameters
    ----------
    thickness, dp, dh : ndarray, shape (nx, ny)
        H and the changes of P and H of a full step, dimensionless.
    pressure_step : float
        Largest change of P at any node.
    gap_step : float
        Part of every gap that is left at least.

    Returns
    -------
    float
        Length of the step.
    """
    length = min(1.0, pressure_step / max(float(np.max(np.abs(dp))), 1e-300))
    closing = dh < 0.0
    if closing.any():
        length = min(length, float(np.min((gap_step - 1.0) * thickness[closing] / dh[closing])))
    return length
