"""Nonlinear elimination of the pressure spike: solution on the few nodes around it, with all others fixed.

The pressure spike is a jump over two or three nodes on every grid. Between these nodes the viscosity changes
by orders of magnitude. An initial guess that is interpolated from a coarser grid is accurate everywhere else.
At the jump it is not, and Newton's method for the whole film then takes many small steps. A separate solution
at the nodes of the jump before each Newton step prevents this.

The method is the nonlinear elimination of X.-C. Cai and X. Li, SIAM J. Sci. Comput. 33 (2011) 746,
doi:10.1137/080736272, with one window around the largest residual.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy

from ehlectric.arrays import Array, Mask
from ehlectric.film.face_flow import Flow, Fluid, flow
from ehlectric.film.gap import Gap
from ehlectric.film.mesh import Mesh
from ehlectric.film.reynolds import Stencil, linearise, residual

# Scaled residual above which a node counts as strongly nonlinear.
_THRESHOLD = 0.02

# Nodes of the window on each side of the largest residual: ten times the width of the jump.
_HALF_WINDOW = 20

# Width of the margin next to the window, in nodes: its equations contain two nodes upstream and one
# downstream.
_MARGIN = 2

# Largest number of Newton steps for the nodes of the window.
_MAX_ITERATIONS = 30

# Limits of one Newton step: largest change of P, and smallest fraction of every gap that remains. Larger
# steps leave the basin of convergence at the spike of light contacts; smaller steps only take more of them.
_PRESSURE_STEP, _GAP_STEP = 0.3, 0.3


@dataclass(frozen=True)
class _Window:
    """Window of nodes along one line, whose pressures are solved separately, with a margin of fixed nodes.

    Window and margin together are the strip.
    """

    strip: slice  # nodes of the strip along x on the grid
    inner: slice  # nodes of the window within the strip
    column: int  # index of the line across entrainment
    # Derivative of H at the n nodes of the strip by P at the m nodes of the window, shape (n, m).
    influence: Array
    wedge: Stencil  # operator of the wedge term on the strip
    source: Array  # right side of the Reynolds equation on the strip, shape (n, 1)
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
        """Values on the strip, shape (n, 1), from values on the whole grid (nx, ny)."""
        return values[self.strip, self.column : self.column + 1]

    def residual(self, at_faces: Flow, thickness: Array) -> Array:
        """Reynolds residual at the nodes of the window, shape (m,)."""
        r = residual(at_faces, self.wedge, thickness, self.mesh) - self.source
        return r[self.inner, 0]

    def jacobian(self, at_faces: Flow, thickness: Array) -> Array:
        """Derivative of the residual at the nodes of the window by P at these nodes, shape (m, m)."""
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
) -> Array | None:
    """Pressure of a line contact after a separate solution at the nodes around the largest residual.

    ``fluid``, lubricant over dimensionless pressure; ``pressure``, ``full_film`` and ``scaled_residual``,
    state of the film: P, the mask of nodes with a full film, and the residual as a pressure over p_h,
    shape (nx, ny). Returns pressure P, shape (nx, ny); None if no node is strongly nonlinear, or if the
    separate solution did not converge.
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
        # Rows are scaled by their largest entry, as their coefficients span many orders of magnitude.
        rows = 1.0 / np.max(np.abs(jacobian), axis=1)
        norm = float(np.max(np.abs(rows * r)))
        if not np.isfinite(norm):
            return None
        if norm < 1e-2 * _THRESHOLD:
            relaxed: Array = pressure.copy()
            relaxed[window.strip, window.column] = p[:, 0]
            return relaxed
        dp = np.zeros((window.inner.stop - window.inner.start, 1))
        *_, step, singular = scipy.linalg.lapack.dgesv(rows[:, np.newaxis] * jacobian, -rows * r)
        if singular:
            return None
        dp[unknown, 0] = step
        dh = window.influence @ dp
        length = step_length(h, dp, dh)
        p[window.inner] += length * dp
        h += length * dh
    return None


def step_length(thickness: Array, dp: Array, dh: Array) -> float:
    """Fraction of a full Newton step that keeps the changes of P and H (nx, ny) within their limits."""
    length = min(1.0, _PRESSURE_STEP / max(float(np.max(np.abs(dp))), 1e-300))
    closing = dh < 0.0
    if closing.any():
        length = min(length, float(np.min((_GAP_STEP - 1.0) * thickness[closing] / dh[closing])))
    return length
