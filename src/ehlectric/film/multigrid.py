"""V-cycle over all grids that preconditions the Newton steps of the film, with line relaxation.

One V-cycle solves J (dP, dH00) = (r, load) approximately, with the Jacobian J. The residual is restricted to
the coarsest grid, where a dense factorisation solves the system. Each finer grid adds one line relaxation
after the coarse-grid correction.

Line relaxation changes all nodes of a line along x at once, with the band of the Jacobian around its
diagonal. If the deflection dominates the Jacobian, an unknown is not the pressure of one node but a dipole
or a second difference of pressures. Its deflection decays faster with distance
(``ehlectric.film.levels.Distribution``).

In a point contact the relaxation complements the coarser grids: it reduces changes that differ from line to
line even if they are smooth along the lines, and it leaves most of a change that is smooth along both axes.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
import scipy
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import NDArray

from ehlectric.arrays import Array, Mask
from ehlectric.film.face_flow import Flow, Fluid, flow
from ehlectric.film.gap import Gap
from ehlectric.film.levels import Distribution, Level
from ehlectric.film.reynolds import ALONG, OFFSETS, Stencil, lateral_change, linearise, poiseuille_weight

# Half-bandwidth of the line relaxation. The part of the kernel beyond the band is neglected; it decays as
# 1/distance^2. With 6 a V-cycle reduces the error by a factor of 3 to 12, and 10 gains little.
_HALF_BAND = 6

# Half-bandwidth for a point contact. With 14, GMRES needs as many iterations.
_HALF_BAND_POINT = 10

# Entries of the band matrices of lines that are set up together: few enough for the processor's cache.
_BLOCK = 2**18


@dataclass(frozen=True)
class LineRelaxation:
    """One relaxation of all lines along x: first every second line, then the lines between them."""

    by_p: Stencil  # derivative of the Reynolds residual by P at fixed H
    full_film: Mask  # nodes whose pressure changes, shape (nx, ny)
    distributed: Mask  # nodes whose unknown is distributed over several nodes, shape (nx, ny)
    # Offsets of the other nodes over which an unknown is distributed, each with its part.
    neighbours: Distribution
    half_band: int  # number of nodes on each side whose influence is kept
    # For each of the two sets of lines: blocks of lines, each with the LU factors and pivots of the transpose
    # of the common band matrix of its lines.
    factors: tuple[tuple[tuple[slice, Array, Array], ...], ...]

    @classmethod
    def of(
        cls, gap: Gap, stencils: tuple[Stencil, Stencil], full_film: Mask, distributed: Mask
    ) -> LineRelaxation:
        """Line relaxation with a Jacobian, from the derivatives of the residual by P and by H.

        ``full_film`` and ``distributed`` are masks of nodes (nx, ny).
        """
        band, (nx, ny) = half_band(gap.level), full_film.shape
        lines = 2 * max(1, _BLOCK // (nx * (3 * band + 1)))
        factors = tuple(
            tuple(
                _factors(gap, stencils, full_film, distributed, slice(block, min(block + lines, ny), 2))
                for block in range(first, ny, lines)
            )
            for first in range(min(2, ny))
        )
        return cls(stencils[0], full_film, distributed, _neighbours(gap.level), band, factors)

    def __call__(self, r: Array) -> Array:
        """Change dP (nx, ny) that solves (band of the Jacobian) dP = r at the full-film nodes.

        The second set of lines includes the flow across entrainment that the change of the first set causes.
        """
        dp = np.zeros_like(r)
        for number, blocks in enumerate(self.factors):
            if number:
                r = r - self.by_p.add_across(dp, np.zeros_like(r))
            for lines, lu, pivots in blocks:
                right = r[:, lines].T.reshape(-1).astype(lu.dtype)
                solved = scipy.linalg.lapack.sgbtrs if lu.dtype == np.float32 else scipy.linalg.lapack.dgbtrs
                solution, _ = solved(lu, self.half_band, self.half_band, right, pivots, trans=1)
                unknown = solution.reshape(-1, r.shape[0]).T
                dp[:, lines] = unknown
                _share(np.where(self.distributed[:, lines], unknown, 0.0), self.neighbours, dp[:, lines])
            dp[~self.full_film] = 0.0
        return dp


def _factors(
    gap: Gap, stencils: tuple[Stencil, Stencil], full_film: Mask, distributed: Mask, lines: slice
) -> tuple[slice, Array, Array]:
    """Lines, and the LU factors and pivots of the transpose of their common band matrix.

    ``stencils`` and the masks (nx, ny) cover all lines.
    """
    band = half_band(gap.level)
    by_p, by_h = (Stencil(part.coefficients[:ALONG, :, lines]) for part in stencils)
    rows = _rows(gap, (by_p, by_h), distributed[:, lines], band)
    rows[~full_film[:, lines].T, 2 * band] = 1.0
    factorised = scipy.linalg.lapack.sgbtrf if rows.dtype == np.float32 else scipy.linalg.lapack.dgbtrf
    # The rows of the matrix are the columns of its transpose, which LAPACK factorises.
    lu, pivots, _ = factorised(rows.reshape(-1, 3 * band + 1).T, band, band, overwrite_ab=1)
    return lines, lu, pivots


def half_band(level: Level) -> int:
    """Half-bandwidth of the line relaxation on a grid, in nodes.

    It is limited by the number of nodes along x, which may be small on coarse grids of wide contacts: the
    rows reach one node beyond the band, and the wedge term two more.
    """
    return min(_HALF_BAND if level.mesh.dy is None else _HALF_BAND_POINT, level.nodes - 4)


def preconditioner_type(level: Level) -> type[np.floating[Any]]:
    """Type of the numbers of a preconditioner: single precision halves the work in a point contact.

    GMRES needs no more of it, as its own products are of double precision. Next to the spike of a line
    contact the coefficients differ by too many orders of magnitude.
    """
    return np.float64 if level.mesh.dy is None else np.float32


def distributed_nodes(level: Level, poiseuille: Array, full_film: Mask) -> Mask:
    """Mask of the nodes whose unknown is distributed, where eps/dX^2 is small and the deflection dominates.

    ``poiseuille`` (nx, ny) is the diagonal of the Poiseuille term. An unknown is only distributed over nodes
    with a full film.
    """
    distributed = full_film & (poiseuille < level.rate)
    for offset, _ in _neighbours(level):
        here, there = _shifted(offset)
        distributed[here] &= full_film[there]
    return distributed


def _neighbours(level: Level) -> Distribution:
    """Offsets of the other nodes over which an unknown is distributed, each with its part."""
    return tuple(part for part in level.distribution if part[0])


def _share(unknown: NDArray[Any], neighbours: Distribution, pressure: Array) -> None:
    """Add the parts of distributed unknowns (nx, n) at other nodes of their lines to a pressure (nx, n)."""
    for offset, part in neighbours:
        here, there = _shifted(offset)
        pressure[there] += part * unknown[here]


def _shifted(offset: int) -> tuple[slice, slice]:
    """Slices along x of the nodes that have a neighbour at this offset, and of these neighbours."""
    if offset < 0:
        return slice(-offset, None), slice(None, offset)
    return slice(None, -offset), slice(offset, None)


def _rows(gap: Gap, stencils: tuple[Stencil, Stencil], distributed: Mask, band: int) -> Array:
    """Rows of the band of the Jacobian for the distributed unknowns of lines, shape (ny, nx, 3 band + 1).

    ``stencils`` have the neighbours along the lines only. The diagonal has the index 2 band. The first
    ``band`` entries are space for the factorisation.
    """
    nx, ny = distributed.shape
    offsets = np.arange(-band - 1, band + 2)
    steps = np.array([step for step, _ in OFFSETS[:ALONG]])
    kind = preconditioner_type(gap.level)
    by_p, by_h = (np.ascontiguousarray(part.coefficients.transpose(2, 1, 0), dtype=kind) for part in stencils)
    # Derivatives by P of all nodes within the band and one beyond, and of these by the flow at fixed H.
    nodal = by_h @ gap.along(steps[:, np.newaxis] - offsets).astype(kind)
    nodal[..., steps[0] + band + 1 : steps[-1] + band + 2] += by_p
    rows = np.empty((ny, nx, 3 * band + 1), dtype=kind)
    rows[..., :band] = 0.0
    kept, inner = rows[..., band:], slice(1, -1)
    # An unknown next to node i, at i + offset, also changes P of the nodes over which it is distributed.
    padded = np.zeros((ny, nx + 2 * band), dtype=kind)
    padded[:, band:-band] = distributed.T
    kept[...] = 0.0
    for offset, share in _neighbours(gap.level):
        kept += share * nodal[..., inner.start + offset : inner.stop + offset or None]
    within = sliding_window_view(padded, 2 * band + 1, axis=1)
    kept *= within
    kept += nodal[..., inner]
    if gap.level.mesh.dy is not None:
        beyond = _row_sums(gap, stencils, distributed) - np.einsum("jik,jik->ij", kept, within)
        kept[..., band] += np.where(distributed, beyond, 0.0).T
    # The matrix ends with the line.
    for k in range(band):
        kept[:, k, : band - k] = 0.0
        kept[:, nx - 1 - k, band + 1 + k :] = 0.0
    return rows


def _row_sums(gap: Gap, stencils: tuple[Stencil, Stencil], distributed: Mask) -> Array:
    """Rows (nx, ny) of the Jacobian of a line times ones for its distributed unknowns, without a limit of the
    band.

    The rows beyond the band fall as 1/distance^3 in a point contact. Their sum is small, but a change that is
    smooth along a line makes all rows small: without the sum, the relaxation would leave most of a pressure
    that differs from line to line only.
    """
    pressure = distributed.astype(float)
    _share(distributed, _neighbours(gap.level), pressure)
    by_p, by_h = stencils
    return by_p(pressure) + by_h(gap.level.deflection.of_lines(pressure))


# Change of ln eps between neighbours above which a coarser grid cannot resolve the solution.
_UNRESOLVED = 1.5

# Largest change of ln eps at any node up to which a preconditioner is kept, and up to which its coarser grids
# are kept. Up to 2, and up to 3 on the coarser grids, it costs no more GMRES iterations than a new one.
_ALIKE, _ALIKE_COARSE = 0.6, 3.0

# Nodes divided by the lines along x that may cavitate anew or no longer, for the coarser grids to be kept.
_FEW_MOVED = 0.25

# Steps along x to the nodes that a row of a stencil couples.
_STEPS = tuple(step for step, _ in OFFSETS[:ALONG])

# Diagonal of the Poiseuille term over the diagonal of the wedge term below which the relaxation leaves smooth
# changes to the coarser grids, and the part of them that it leaves. If it left none, the cycle of a contact
# with hundreds of nodes in its Hertz zone would diverge. At nodes with a free flow its smooth changes help.
_ELASTIC, _SMOOTH = 0.1, 0.8

# Fraction of the residual below which one cycle on a coarser grid is enough, and no second cycle follows.
_ENOUGH = 0.1


@dataclass(frozen=True)
class Linearised:
    """Jacobian of the film equations on one grid, as a linear operator on its full-film nodes.

    The pressure of cavitated nodes does not change: dP must be zero there, and the solvers return zero there.
    """

    gap: Gap
    # by_p and by_h: derivatives of the Reynolds residual by P at fixed H and by H at fixed P; zero at
    # cavitated nodes.
    by_p: Stencil
    by_h: Stencil
    full_film: Mask  # nodes with a full film, shape (nx, ny)
    poiseuille: Array  # diagonal of the Poiseuille term, shape (nx, ny)
    # scale and unscale: reciprocal of the diagonal of the Reynolds equation, and the diagonal; both zero at
    # cavitated nodes, shape (nx, ny).
    scale: Array
    unscale: Array
    resolved: Mask  # nodes whose residual is passed to the coarser grids, shape (nx, ny)
    log_viscosity: Array  # ln(eta/eta_0) at the state, shape (nx, ny)
    # Flow with derivatives by the gradients along the other axis, which the stencils lack; None without them.
    lateral: Flow | None = None
    # Similar Jacobian at an older state, whose line relaxation or factors are used instead of new ones.
    kept: Linearised | None = None

    @classmethod
    def of(cls, gap: Gap, at_faces: Flow, full_film: Mask) -> Linearised:
        """Jacobian at a state, from its gap, its flow and its full-film nodes (nx, ny)."""
        by_p, by_h = linearise(at_faces, gap.level.wedge, gap.thickness, gap.level.mesh)
        stencils = by_p.on_rows(full_film), by_h.on_rows(full_film)
        jacobian = cls.of_stencils(gap, stencils, at_faces, full_film)
        return jacobian if at_faces.along.by_lateral is None else replace(jacobian, lateral=at_faces)

    @classmethod
    def of_stencils(
        cls,
        gap: Gap,
        stencils: tuple[Stencil, Stencil],
        at_faces: Flow,
        full_film: Mask,
        contact: Mask | bool = False,  # noqa: FBT001, FBT002
    ) -> Linearised:
        """Jacobian from its stencils by P and by H, whose rows are zero where P does not change.

        At the nodes in ``contact`` (nx, ny) no pressure drives oil, and the density counts as one.
        """
        k = at_faces.coefficients
        poiseuille = np.where(contact, 0.0, poiseuille_weight(at_faces, gap.level.mesh))
        diagonal = poiseuille + gap.elastic_weight(np.where(contact, 1.0, k.density))
        return cls(
            gap=gap,
            by_p=stencils[0],
            by_h=stencils[1],
            full_film=full_film,
            poiseuille=poiseuille,
            scale=np.divide(1.0, diagonal, out=np.zeros(full_film.shape), where=full_film),
            unscale=np.where(full_film, diagonal, 0.0),
            resolved=resolved_nodes(gap.level, k.eps, full_film),
            log_viscosity=k.log_viscosity,
        )

    @property
    def level(self) -> Level:
        """Grid of the Jacobian."""
        return self.gap.level

    def __call__(self, dp: Array, dh00: float) -> tuple[Array, float]:
        """Change of the Reynolds residual (nx, ny) and of the load for changes dP (nx, ny) and dH00."""
        change, load = self._by_stencils(dp, dh00)
        if self.lateral is not None:
            change += np.where(self.full_film, lateral_change(self.lateral, dp, self.level.mesh), 0.0)
        return change, load

    def _by_stencils(self, dp: Array, dh00: float) -> tuple[Array, float]:
        """Change of residual (nx, ny) and load without the derivatives beyond the stencils."""
        dh, load = self.gap.change(dp, dh00)
        return self.by_p(dp) + self.by_h(dh), load

    def image(self, change: Array, *, rough: bool = False) -> Array:
        """Change of scaled residual and load, as one vector, for a change of P and H00, as one vector.

        It is exact, or ``rough`` to the precision of a preconditioner.
        """
        product = self.roughly if rough else self
        r, load = product(change[:-1].reshape(self.full_film.shape), float(change[-1]))
        return np.append(self.scale * r, load)

    def roughly(self, dp: Array, dh00: float) -> tuple[Array, float]:
        """Change of residual (nx, ny) and load as by a call, to the precision of a preconditioner and without
        the derivatives beyond the stencils.
        """
        return self._by_stencils(dp.astype(preconditioner_type(self.level)), dh00)

    @cached_property
    def elastic(self) -> Mask:
        """Mask of the nodes with a full film whose pressure drives almost no oil, shape (nx, ny)."""
        return self.full_film & (self.poiseuille < _ELASTIC * self.level.rate)

    @cached_property
    def relax(self) -> LineRelaxation:
        """Line relaxation with this Jacobian, a function r (nx, ny) -> dP (nx, ny)."""
        if self.kept is not None:
            return self.kept.relax
        distributed = distributed_nodes(self.level, self.poiseuille, self.full_film)
        return LineRelaxation.of(self.gap, (self.by_p, self.by_h), self.full_film, distributed)

    @cached_property
    def solve_dense(self) -> DenseSolver:
        """Direct solver with this Jacobian for the coarsest grid, a function (r, load) -> (dP, dH00)."""
        if self.kept is not None:
            return self.kept.solve_dense
        return DenseSolver.of(self.gap, self.by_p, self.by_h, self.full_film)


@dataclass(frozen=True)
class DenseSolver:
    """Direct solver for the Jacobian of a grid and the balance of load, by a dense LU factorisation."""

    full_film: Mask  # nodes whose pressure changes; the change at all others is zero, shape (nx, ny)
    part: slice  # nodes from the first one with a full film to the last one, of all nodes with y fastest
    # factors and pivots: LU factorisation of the transposed matrix of these nodes and of the balance of load.
    factors: Array
    pivots: Array

    @classmethod
    def of(cls, gap: Gap, by_p: Stencil, by_h: Stencil, full_film: Mask) -> DenseSolver:
        """Factorise the Jacobian, from the derivatives of the residual by P and by H.

        The rows of the derivatives must be zero at cavitated nodes.
        """
        # Nodes before and behind the full film, as in a cavitated outlet, are skipped.
        free = np.flatnonzero(full_film)
        part = slice(int(free[0]), int(free[-1]) + 1) if free.size else slice(0, 1)
        n = part.stop - part.start
        matrix = np.zeros((n + 1, n + 1))
        if full_film.shape[1] == 1:
            _fill_of_line(matrix, gap, by_p, by_h, part)
        else:
            matrix[:n, :n] = (by_p.matrix() + by_h.times(gap.level.deflection.matrix))[part, part]
        matrix[:n, n] = by_h.coefficients.sum(axis=0).ravel()[part]
        matrix[n, :n] = np.where(full_film, gap.level.weights, 0.0).ravel()[part]
        cavitated = np.flatnonzero(~full_film.ravel()[part])
        matrix[cavitated, cavitated] = 1.0
        # LAPACK takes columns, which are the rows of the transposed matrix here: nothing is copied.
        factors, pivots, _ = scipy.linalg.lapack.dgetrf(matrix.T, overwrite_a=1)
        return cls(full_film, part, factors, pivots)

    def __call__(self, r: Array, load: float) -> tuple[Array, float]:
        """Solution dP (nx, ny) and dH00 for the right side r (nx, ny) and ``load``."""
        right = np.append(np.where(self.full_film, r, 0.0).ravel()[self.part], load)
        solution, _ = scipy.linalg.lapack.dgetrs(self.factors, self.pivots, right, trans=1, overwrite_b=1)
        dp = np.zeros(r.size)
        dp[self.part] = solution[:-1]
        return np.where(self.full_film, dp.reshape(r.shape), 0.0), float(solution[-1])


def _fill_of_line(matrix: Array, gap: Gap, by_p: Stencil, by_h: Stencil, part: slice) -> None:
    """Write the Jacobian of some nodes of a line contact by the pressures of these nodes into ``matrix``.

    ``matrix`` has one more row and column than there are nodes. The derivatives of H depend on the distance
    of the nodes only. All rows over this distance are one product of matrices, and the Jacobian is a view of
    it whose rows begin one distance further left from row to row.
    """
    n, nodes = len(matrix) - 1, gap.level.nodes
    kernel = gap.level.deflection.shifted(_STEPS)[:, nodes - n : nodes + n - 1]
    over_distance = (by_h.coefficients[:ALONG, part, 0].T @ kernel).reshape(-1)
    if n == 1:
        matrix[0, 0] = over_distance[0]
    else:
        matrix[:n, :n] = over_distance[n - 1 : n - 1 + n * (2 * n - 2)].reshape(n, 2 * n - 2)[:, :n]
    flat = matrix.reshape(-1)
    for row, step in zip(by_p.coefficients[:ALONG, part, 0], _STEPS, strict=True):
        first, count = max(0, -step), n - abs(step)
        if count > 0:
            start = first * (n + 2) + step
            flat[start : start + count * (n + 2) : n + 2] += row[first : first + count]


def resolved_nodes(level: Level, eps: Array, full_film: Mask) -> Mask:
    """Mask of the nodes whose residual is passed to the coarser grids.

    Next to the pressure spike of a line contact eps changes by orders of magnitude from node to node. There
    only the relaxation acts, which is almost exact.
    """
    resolved = full_film.copy()
    if level.mesh.dy is None:
        steep = np.abs(np.diff(np.log(eps), axis=0)) > _UNRESOLVED
        resolved[1:] &= ~steep
        resolved[:-1] &= ~steep
    return resolved


def linearise_levels(
    levels: list[Level],
    fluid: Fluid,
    at_faces: Flow,
    *,
    pressure: Array,
    thickness: Array,
    full_film: Mask,
) -> list[Linearised]:
    """Jacobian on every grid, at the state of the finest grid and at its injection on the coarser grids.
    ``fluid``, lubricant over dimensionless pressure; ``pressure``, ``thickness`` and ``full_film``, state on
    the finest grid: P, H and the nodes with a full film, shape (nx, ny). Returns Jacobians in the order of
    ``levels``.
    """
    jacobians = [Linearised.of(Gap(levels[0], thickness), at_faces, full_film)]
    for level in levels[1:]:
        pressure = level.inject(pressure)
        thickness = level.inject(thickness)
        full_film = level.inside(full_film)
        at_faces = flow(fluid, pressure, thickness, level.mesh)
        jacobians.append(Linearised.of(Gap(level, thickness), at_faces, full_film))
    return jacobians


def with_kept_preconditioner(
    jacobians: list[Linearised], at_faces: Flow, thickness: Array, full_film: Mask
) -> list[Linearised] | None:
    """Jacobian at a new state with the coarser grids and, if the same nodes are cavitated, the line
    relaxation of an older state. ``thickness`` and ``full_film``, film thickness H and full-film nodes of the
    new state, shape (nx, ny). Returns None where the states differ too much for the older preconditioner.
    Other nodes are cavitated at the most in a point contact, and there only few.
    """
    if not jacobians:
        return None
    last, *coarser = jacobians
    old, log_viscosity = last.kept or last, at_faces.coefficients.log_viscosity
    moved = np.count_nonzero(old.full_film != full_film)
    relaxed = moved == 0 and _change(old, thickness, log_viscosity) < _ALIKE
    if not relaxed:
        # The coarser grids of a point contact barely depend on a few nodes at the edge of the full film.
        if last.level.mesh.dy is None or not coarser or moved > _FEW_MOVED * full_film.shape[1]:
            return None
        level = coarser[0].level
        if not _change(coarser[0], level.inject(thickness), level.inject(log_viscosity)) < _ALIKE_COARSE:
            return None
    new = Linearised.of(Gap(old.level, thickness), at_faces, full_film)
    return [replace(new, kept=old) if relaxed else new, *coarser]


def _change(old: Linearised, thickness: Array, log_viscosity: Array) -> float:
    """Largest change of ln eps at any node, between the state of a Jacobian and another state."""
    thinner = np.abs(np.log(thickness / old.gap.thickness))
    thicker = np.abs(log_viscosity - old.log_viscosity)
    return float(np.max((thicker + 3.0 * thinner)[old.full_film], initial=0.0))


def v_cycle(jacobians: list[Linearised], r: Array, load: float) -> tuple[Array, float]:
    """One V-cycle: approximate solution of J (dP, dH00) = (r, load) on the full-film nodes. ``r``, right side
    of the Reynolds equation, dimensionless, shape (nx, ny). Returns ``dp``, change of P on the finest grid,
    zero at cavitated nodes, shape (nx, ny); ``dh00``, change of H00.
    """
    finest, *coarser = jacobians
    if not coarser:
        return finest.solve_dense(r, load)
    level = coarser[0].level
    restricted = level.restrict(np.where(finest.resolved, r, 0.0))
    if len(coarser) == 1 or level.mesh.dy is None:
        coarse_dp, dh00 = v_cycle(coarser, restricted, load)
    else:
        coarse_dp, dh00 = _two_cycles(coarser, restricted, load)
    dp = np.where(finest.full_film, level.prolong(coarse_dp), 0.0)
    change, _ = finest.roughly(dp, dh00)
    return dp + _relaxed(finest, level, r - change), dh00


def _relaxed(finest: Linearised, coarser: Level, r: Array) -> Array:
    """Change dP (nx, ny) by the relaxation of a residual, in a point contact with little of its smooth part.

    The relaxation of a line neglects the deflection by all other lines. Of a change that is smooth along and
    across the lines it makes many times too much, and the next coarser grid has already made it. The smooth
    part is what remains of the change if it is transferred to that grid and back.
    """
    change = finest.relax(r)
    if coarser.averaged is None:
        return change
    return change - np.where(finest.elastic, _SMOOTH * coarser.prolong(coarser.averaged(change)), 0.0)


def cycled(jacobians: list[Linearised], image: Array) -> Array:
    """One V-cycle with vectors: from a scaled residual and load to a change of P and H00."""
    unscale = jacobians[0].unscale
    dp, dh00 = v_cycle(jacobians, unscale * image[:-1].reshape(unscale.shape), float(image[-1]))
    return np.append(dp, dh00)


def _two_cycles(jacobians: list[Linearised], r: Array, load: float) -> tuple[Array, float]:
    """Two V-cycles, combined so that the norm of the scaled residual becomes smallest.

    Along the ridge of pressure at the exit of a point contact, the correction of a coarser grid is too large,
    by a factor that grows from grid to grid. The combination finds the best multiple of the correction. This
    is the K-cycle of Y. Notay and P. S. Vassilevski, Numer. Linear Algebra Appl. 15 (2008) 473,
    doi:10.1002/nla.542.
    """
    finest = jacobians[0]
    right = np.append(finest.scale * r, load)
    first = cycled(jacobians, right)
    image = finest.image(first, rough=True)
    square = np.vdot(image, image)
    change, left = _best_multiple(first, image, right)
    if np.linalg.norm(left) > _ENOUGH * np.linalg.norm(right):
        second = cycled(jacobians, left)
        next_image = finest.image(second, rough=True)
        # The second image is made orthogonal to the first, so that both have their best multiple.
        part = np.vdot(image, next_image) / square if square > 0.0 else 0.0
        added, _ = _best_multiple(second - part * first, next_image - part * image, left)
        change = change + added
    return change[:-1].reshape(r.shape), float(change[-1])


def _best_multiple(change: Array, image: Array, right: Array) -> tuple[Array, Array]:
    """Multiple of a change whose image is nearest to the right side, and what is left of the right side."""
    square = np.vdot(image, image)
    part = np.vdot(image, right) / square if square > 0.0 else 0.0
    return part * change, right - part * image
