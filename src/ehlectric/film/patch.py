"""Fine patch of a point contact's grid, where the film is decided, inside a coarse grid of the whole
domain.

The film is decided in the inlet zone, at the constriction and in the side lobes. Outside, the pressure is low
and smooth. A coarse film gives the pressure outside the patch, which stays as it is: its deflection is a
known gap in the patch, its load is taken off, and its pressure is kept on the edges of the patch. Inside the
patch the film equations are solved as in a whole domain.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ehlectric.arrays import Array
from ehlectric.film.mesh import Mesh, at_centre
from ehlectric.film.newton import GridSolution
from ehlectric.film.problem import FilmProblem
from ehlectric.formulas.monotone_cubic import along_axis

# Distances of the patch's edges from the dry contact, in semi-axes along entrainment: ahead of it, behind it
# and at its sides; and these distances in lengths sqrt(2 H) over which the pressure of a thick film builds
# up.
AHEAD, _AHEAD_THICK = 0.7, 1.0
_BEHIND, _ACROSS = (0.3, 0.5), (0.5, 1.0)

# Largest part of the domain that a patch may cover. A larger one saves too little.
_LARGEST = 0.6

# Function of X (nx,) and Y (ny,) -> nodal values (nx, ny).
OnGrid = Callable[[Array, Array], Array]


@dataclass(frozen=True)
class Patch:
    """Patch of a coarse grid, whose edges are lines of this grid."""

    problem: FilmProblem  # problem of the whole domain on the coarse grid
    coarse: GridSolution
    # rows and lines: first and last node of the patch along x, and across entrainment on the coarse mesh.
    rows: tuple[int, int]
    lines: tuple[int, int]

    @classmethod
    def around(cls, problem: FilmProblem, coarse: GridSolution, *, ahead: float = AHEAD) -> Patch | None:
        """Patch where the film of a point contact is decided; None where it would fill the domain.

        It reaches at least ``ahead`` semi-axes along entrainment ahead of the dry contact.
        """
        if problem.width is None or coarse.status != "converged":
            return None
        mesh = coarse.level.mesh
        inlet, outlet, side = edges(problem, at_centre(mesh, coarse.state.thickness), ahead=ahead)
        rows = _nearest(mesh.x, inlet), _nearest(mesh.x, outlet)
        last = _nearest(mesh.y, side)
        lines = 0 if mesh.symmetric else mesh.y.size - 1 - last, last
        part = (rows[1] - rows[0]) * (lines[1] - lines[0]) / ((mesh.x.size - 1) * (mesh.y.size - 1))
        return cls(problem, coarse, rows, lines) if part <= _LARGEST else None

    @property
    def ends(self) -> tuple[float, float, float]:
        """Ends of the patch X of inlet and outlet, and largest Y."""
        mesh = self.coarse.level.mesh
        return float(mesh.x[self.rows[0]]), float(mesh.x[self.rows[1]]), float(mesh.y[self.lines[1]])

    @property
    def nodes(self) -> tuple[slice, slice]:
        """Nodes of the coarse mesh that the patch has, along x and across entrainment."""
        return slice(self.rows[0], self.rows[1] + 1), slice(self.lines[0], self.lines[1] + 1)

    def times(self, fine: Mesh) -> int:
        """Whole number of spacings of a fine mesh in one of the coarse grid."""
        return round(self.coarse.level.mesh.dx / fine.dx)

    def refined(self, times: int) -> FilmProblem:
        """Problem of the patch with spacings of the coarse grid divided by ``times``."""
        inlet, outlet, side = self.ends
        whole, width = self.problem, self.problem.width
        assert width is not None
        lines = self.lines[1] - self.lines[0]
        halved = self.coarse.level.mesh.symmetric
        dry, outer = whole.geometry.dry_gap, self.outer_deflection(times)
        pressure = self._spline(self.coarse.state.pressure)
        ambient = whole.fluid.ambient_pressure
        geometry = replace(
            whole.geometry,
            dry_gap=lambda x, y: dry(x, y) + outer(x, y),
            load=whole.geometry.load - self._outer_load(),
        )
        return replace(
            whole,
            nodes=(self.rows[1] - self.rows[0]) * times + 1,
            inlet=inlet,
            outlet=outlet,
            width=replace(
                width, nodes=(2 * lines if halved else lines) * times + 1, side=side, symmetric=halved
            ),
            geometry=geometry,
            edge_pressure=lambda x, y: np.maximum(pressure(x, y), ambient),
        )

    def outer_deflection(self, times: int) -> OnGrid:
        """Deflection by the pressure outside the patch.

        The cells of the nodes on the edges of the patch reach half a spacing beyond it. That half of a fine
        cell is taken off the coarse cells that are outside.
        """
        return self._spline(self.coarse.level.deflection(self._outer_pressure(0.5 + 0.5 / times)))

    def _outer_load(self) -> float:
        return float(np.vdot(self.coarse.level.weights, self._outer_pressure(0.5)))

    def _outer_pressure(self, at_edge: float) -> Array:
        return self.coarse.state.pressure * self.outside(at_edge)

    def outside(self, at_edge: float) -> Array:
        """Part of each coarse node outside the patch, to which the part ``at_edge`` of its edges belongs."""
        mesh = self.coarse.level.mesh
        along = _part(mesh.x.size, self.rows, (at_edge, at_edge))
        across = _part(mesh.y.size, self.lines, (1.0 if mesh.symmetric else at_edge, at_edge))
        return np.asarray(1.0 - along[:, np.newaxis] * across)

    def _spline(self, values: Array) -> OnGrid:
        mesh = self.coarse.level.mesh
        nodal = mesh.mirrored(values)[..., np.newaxis]
        # late: line contacts do not need it
        from ehlectric.formulas.tensor_spline import TensorSpline

        spline = TensorSpline.through((mesh.x, mesh.whole_y), nodal)
        return lambda x, y: spline.on_grid((x, y))[..., 0]

    def join(self, fine: Mesh) -> Joined:
        """Grid of the whole domain with the nodes of a fine mesh inside the patch."""
        coarse, (first, last) = self.coarse.level.mesh, self.rows
        side = self.ends[2]
        outside = coarse.whole_y[coarse.whole_y >= side - 1e-9]
        return Joined(
            coarse=coarse,
            fine=fine,
            x=np.concatenate([coarse.x[: first + 1], fine.x[1:-1], coarse.x[last:]]),
            y=np.concatenate([-outside[::-1], fine.whole_y[1:-1], outside]),
            first=(first + 1, outside.size),
        )


@dataclass(frozen=True)
class Joined:
    """Grid of the whole domain with fine nodes inside a patch, coarse ones outside."""

    # coarse and fine: mesh of the whole domain and of the patch.
    coarse: Mesh
    fine: Mesh
    # x and y: positions of all nodes, from side to side, shapes (nx,).
    x: Array
    y: Array
    first: tuple[int, int]  # indices of the first node inside the patch, along x and y

    def __call__(self, coarse: NDArray[Any], fine: NDArray[Any]) -> NDArray[Any]:
        """Nodal values (nx, ny) from those on both meshes.

        Outside the patch the coarse values are interpolated; flags are taken from the nearest coarse node.
        """
        mesh, values = self.coarse, self.coarse.mirrored(coarse)
        if values.dtype == bool:
            whole: NDArray[Any] = values[
                np.ix_(_nearest_each(mesh.x, self.x), _nearest_each(mesh.whole_y, self.y))
            ]
        else:
            whole = self._interpolated(values)
        inside = self.fine.mirrored(fine)[1:-1, 1:-1]
        i, j = self.first
        whole[i : i + inside.shape[0], j : j + inside.shape[1]] = inside
        return whole

    def _interpolated(self, values: Array) -> Array:
        """Nodal values (nx, ny) outside the patch, from those on the whole coarse mesh; not set inside.

        The lines outside the patch are lines of the coarse mesh, so that only values between them along the
        other axis are interpolated.
        """
        mesh, (i, j) = self.coarse, self.first
        behind = len(self.x) - (self.fine.x.size - 2) - i
        whole = np.empty((self.x.size, self.y.size))
        rows, lines = _ends(i, behind), _ends(j, j)
        # Both halves of a symmetric film are equal to the last digit.
        half = self.y[self.y.size // 2 :] if mesh.symmetric else self.y
        for here in rows:
            whole[here] = mesh.mirrored(along_axis(mesh.whole_y, values[here], half, axis=1))
        for here in lines:
            whole[:, here] = along_axis(mesh.x, values[:, here], self.x, axis=0)
        # The interpolation is monotone: only its rounding leaves the range of the values.
        least, most = np.min(values), np.max(values)
        for part in (*(whole[here] for here in rows), *(whole[:, here] for here in lines)):
            np.clip(part, least, most, out=part)
        return whole


def edges(problem: FilmProblem, thickness: float, *, ahead: float = AHEAD) -> tuple[float, float, float]:
    """Edges of the patch around a film with a central thickness H: X of inlet and outlet, and largest Y."""
    length = np.sqrt(2.0 * max(thickness, 0.0))
    ratio = 1.5 * problem.geometry.load / np.pi
    before, behind, across = (
        max(least, part * length) for least, part in ((ahead, _AHEAD_THICK), _BEHIND, _ACROSS)
    )
    return -1.0 - before, 1.0 + behind, ratio + across * max(1.0, ratio)


def part_of_domain(problem: FilmProblem, thickness: float) -> float:
    """Part of the domain that is solved on fine grids around a film with a central thickness H, up to 1."""
    assert problem.width is not None
    inlet, outlet, side = edges(problem, thickness)
    along = min(outlet, problem.outlet) - max(inlet, problem.inlet)
    part = along * min(side / problem.width.side, 1.0) / (problem.outlet - problem.inlet)
    return part if part <= _LARGEST else 1.0


def _ends(first: int, last: int) -> tuple[slice, slice]:
    """Slices of a number of the first and of the last entries along an axis."""
    return slice(None, first), slice(-last, None)


def _nearest_each(nodes: Array, positions: Array) -> NDArray[np.int64]:
    """Index of the node nearest to each position, the smaller one half-way between two."""
    return np.asarray(np.searchsorted(0.5 * (nodes[1:] + nodes[:-1]), positions))


def _nearest(nodes: Array, position: float) -> int:
    return int(np.argmin(np.abs(nodes - position)))


def _part(size: int, ends: tuple[int, int], at_ends: tuple[float, float]) -> Array:
    """Part of each node that belongs to the patch: one inside, ``at_ends`` at its two ends, zero outside."""
    part = np.zeros(size)
    part[ends[0] : ends[1] + 1] = 1.0
    part[ends[0]], part[ends[1]] = at_ends
    return part
