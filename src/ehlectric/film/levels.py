"""Grids of a film from the finest to the coarsest, each with its operators and its transfers to the next."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import TypeAlias

import numpy as np
from scipy import sparse

from ehlectric.arrays import Array
from ehlectric.film.deflection import Deflection, Geometry
from ehlectric.film.mesh import Mesh, Width
from ehlectric.film.reynolds import Stencil, wedge_stencil

# The hierarchy ends at the first grid of at most this many nodes, of line and of point contacts: the dense
# solve there costs less than one more grid.
COARSEST = 101
COARSEST_POINT = 600

# Distance of neighbours along entrainment over that across above which the next coarser grid has fewer lines
# alone.
NEARER = 1.5


def interpolation(coarse: int, fine: int) -> sparse.csr_array:
    """Linear interpolation between two uniform grids over one interval, shape (fine, coarse)."""
    numerator = np.arange(fine) * (coarse - 1)
    left = np.minimum(numerator // (fine - 1), coarse - 2)
    weight = numerator / (fine - 1) - left
    rows = np.repeat(np.arange(fine), 2)
    columns = np.stack([left, left + 1], axis=1).ravel()
    values = np.stack([1.0 - weight, weight], axis=1).ravel()
    matrix = sparse.csr_array((values, (rows, columns)), shape=(fine, coarse))
    matrix.eliminate_zeros()
    return matrix


@dataclass(frozen=True)
class Transfer:
    """Linear interpolation between two grids, along and across entrainment."""

    along: sparse.csr_array
    across: sparse.csr_array | None

    @classmethod
    def between(cls, coarse: Mesh, fine: Mesh) -> Transfer:
        """From a coarse mesh to a fine one, or back, over one domain."""
        across = None if coarse.y.size == 1 else interpolation(coarse.y.size, fine.y.size)
        return cls(interpolation(coarse.x.size, fine.x.size), across)

    def averaging(self, coarse: Mesh, fine: Mesh) -> Transfer:
        """Full weighting from the fine mesh to the coarse one: the adjoint of this under their integrals."""
        across = None
        if self.across is not None:
            across = _adjoint(self.across, coarse.weights_across, fine.weights_across)
        return Transfer(_adjoint(self.along, coarse.weights_along, fine.weights_along), across)

    def __call__(self, values: Array) -> Array:
        """Values (nx, ny) on the other mesh."""
        moved: Array = self.along @ values
        return moved if self.across is None else (self.across @ moved.T).T


def _adjoint(matrix: sparse.csr_array, coarse: Array, fine: Array) -> sparse.csr_array:
    return sparse.csr_array(matrix.T.multiply(fine).multiply(1.0 / coarse[:, np.newaxis]))


# What a distributed unknown adds to the pressures of its line: (offset, part) of its own node and of others.
# A steady film is opened by the first difference of the deflection, which acts like 1/(i - j - 1/2): on
# dipoles it acts like 1/(i - j)^2 and is diagonally dominant. In time it is the deflection itself that acts,
# like a logarithm, and second differences do to that what dipoles do to its difference.
Distribution: TypeAlias = tuple[tuple[int, float], ...]
DIPOLE: Distribution = ((0, 1.0), (-1, -1.0))
SECOND_DIFFERENCE: Distribution = ((0, 1.0), (-1, -0.5), (1, -0.5))


@dataclass(frozen=True)
class Level:
    """One grid: nodes, quadrature weights, operators, and the transfers to and from the next finer.

    The finest grid has no finer one, and no transfers. ``wedge`` acts on the mass rho H: upstream along x, or
    in time on the mass at the node itself; ``rate`` is about its coefficient, and ``distribution`` what suits
    it.
    """

    mesh: Mesh
    weights: Array  # (nx, ny), trapezoidal
    deflection: Deflection
    dry_gap: Array  # (nx, ny)
    load: float
    wedge: Stencil
    rate: float  # 1/dX, or in time 1/dT
    source: Array  # (nx, ny), right side of the Reynolds equation, zero on the edges
    to_finer: Transfer | None
    from_finer: Transfer | None
    averaged: Transfer | None  # of residuals, from the next finer
    distribution: Distribution = DIPOLE

    @property
    def nodes(self) -> int:
        """Number of nodes along x."""
        return self.mesh.x.size

    def inject(self, values: Array) -> Array:
        """Values of the next finer grid at the nodes of this one."""
        assert self.from_finer is not None
        return self.from_finer(values)

    def prolong(self, values: Array) -> Array:
        """Values of this grid, linearly interpolated to the next finer one."""
        assert self.to_finer is not None
        return self.to_finer(values)

    def restrict(self, residual: Array) -> Array:
        """A residual of the next finer grid on this one.

        That of a line contact is injected: beside the pressure spike neighbouring rows differ by orders of
        magnitude, and an average hands the small ones the error of the large. In a point contact neighbouring
        lines hardly feel each other in the Hertz zone, and what differs between them must be averaged out.
        """
        if self.averaged is None:
            return self.inject(residual)
        return self.averaged(residual)

    @cached_property
    def deflection_matrix(self) -> Array:
        """The dense deflection operator, for the coarsest grid alone."""
        return self.deflection.matrix()


def hierarchy(
    nodes: int,
    *,
    inlet: float,
    outlet: float,
    geometry: Geometry,
    second_order: bool,
    width: Width | None = None,
    source: Callable[[Array, Array], Array] | None = None,
) -> list[Level]:
    """Grids from the finest to the coarsest, each with half the intervals of the one before.

    An odd number of intervals is halved upwards; such grids share only their end nodes, and the
    transfers interpolate. There are always two grids at least.
    """
    meshes = _meshes(nodes, inlet, outlet, width)
    levels = []
    for k, mesh in enumerate(meshes):
        right = np.zeros(mesh.shape)
        if source is not None:
            right[mesh.inner] = source(mesh.x, mesh.y)[mesh.inner]
        up = Transfer.between(mesh, meshes[k - 1]) if k else None
        levels.append(
            Level(
                mesh=mesh,
                weights=mesh.weights,
                deflection=Deflection.on(mesh, geometry),
                dry_gap=geometry.dry_gap(mesh.x, mesh.y),
                load=geometry.load,
                wedge=wedge_stencil(mesh.shape, mesh.dx, second_order=second_order),
                rate=1.0 / mesh.dx,
                source=right,
                to_finer=up,
                from_finer=Transfer.between(meshes[k - 1], mesh) if k else None,
                averaged=up.averaging(mesh, meshes[k - 1]) if up and mesh.dy is not None else None,
            )
        )
    return levels


def _meshes(nodes: int, inlet: float, outlet: float, width: Width | None) -> list[Mesh]:
    meshes = [Mesh.over(nodes, inlet, outlet, width)]
    coarsest = COARSEST if width is None else COARSEST_POINT
    while meshes[-1].weights.size > coarsest or len(meshes) < 2:
        mesh = meshes[-1]
        # Relaxed along x alone, nodes much nearer to each other across come first.
        if mesh.dy is None or mesh.dx <= NEARER * mesh.dy:
            nodes = nodes // 2 + 1
        if width is not None:
            width = width.coarser()
        meshes.append(Mesh.over(nodes, inlet, outlet, width))
    return meshes
