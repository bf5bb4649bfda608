"""Hierarchy of grids for the film equations, with their operators and the transfers between them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from typing import TypeAlias

import numpy as np
import scipy

from ehlectric.arrays import Array, Mask
from ehlectric.film.deflection import Deflection, Geometry
from ehlectric.film.mesh import Mesh, Width
from ehlectric.film.reynolds import Stencil, wedge_stencil
from ehlectric.formulas.polynomials import linear_interpolation

# The hierarchy ends at the first grid with at most this many nodes, in a line and in a point contact. The
# dense solve on this grid costs less than one more grid.
COARSEST = 201
COARSEST_POINT = 600

# Line contacts with more nodes than the first number end at the second one: the dense solve is then a small
# part of a cycle, and an exact solution on 201 nodes overshoots more next to the pressure spike.
_LARGE, _COARSEST_OF_LARGE = 10_000, 101

# Ratio dX/dY of the grid spacings above which the next coarser grid has fewer nodes across entrainment only.
NEARER = 1.5


def interpolation(coarse: int, fine: int) -> scipy.sparse.csr_array:
    """Linear interpolation between two uniform grids over one interval. Returns matrix of the interpolation;
    its rows sum to one, shape (fine, coarse).
    """
    numerator = np.arange(fine) * (coarse - 1)
    left = np.minimum(numerator // (fine - 1), coarse - 2)
    weight = numerator / (fine - 1) - left
    return linear_interpolation(left, weight, coarse)


@dataclass(frozen=True)
class Transfer:
    """Linear transfer of nodal values from one grid to another."""

    along: scipy.sparse.csr_array
    across: scipy.sparse.csr_array | None  # matrix of the transfer along y; None for a line contact

    @classmethod
    def between(cls, coarse: Mesh, fine: Mesh) -> Transfer:
        """Linear interpolation from the mesh ``coarse`` to the mesh ``fine``; either may be the finer one."""
        across = None if coarse.y.size == 1 else interpolation(coarse.y.size, fine.y.size)
        return cls(interpolation(coarse.x.size, fine.x.size), across)

    def averaging(self, coarse: Mesh, fine: Mesh) -> Transfer:
        """Full weighting from the fine to the coarse mesh: the adjoint of this interpolation.

        The inner products of the adjoint are the integrals over the two meshes.
        """
        across = None
        if self.across is not None:
            across = _adjoint(self.across, coarse.weights_across, fine.weights_across)
        return Transfer(_adjoint(self.along, coarse.weights_along, fine.weights_along), across)

    def __call__(self, values: Array) -> Array:
        """Transfer values (nx, ny) to the other mesh."""
        moved: Array = self.along @ values
        return moved if self.across is None else (self.across @ moved.T).T


def _adjoint(matrix: scipy.sparse.csr_array, coarse: Array, fine: Array) -> scipy.sparse.csr_array:
    return scipy.sparse.csr_array(matrix.T.multiply(fine).multiply(1.0 / coarse[:, np.newaxis]))


# Distribution of one unknown of the line relaxation over the pressures of its line: (offset of a node, part).
# The wedge term of a stationary film contains the first difference of the deflection, whose kernel decays as
# 1/(i - j - 1/2). With dipoles as unknowns the kernel decays as 1/(i - j)^2 and is diagonally dominant. The
# wedge term of a transient film contains the deflection itself, whose kernel is a logarithm. With second
# differences as unknowns it decays in the same way.
Distribution: TypeAlias = tuple[tuple[int, float], ...]
DIPOLE: Distribution = ((0, 1.0), (-1, -1.0))
SECOND_DIFFERENCE: Distribution = ((0, 1.0), (-1, -0.5), (1, -0.5))


@dataclass(frozen=True)
class Level:
    """One grid of the hierarchy, with its operators and its transfers."""

    mesh: Mesh
    weights: Array  # trapezoidal weights of the integral over the contact, shape (nx, ny)
    deflection: Deflection
    dry_gap: Array  # gap of the undeformed surfaces, with their roughness, shape (nx, ny)
    load: float  # dimensionless load of the contact, the integral of P
    wedge: Stencil  # operator of the wedge term on the mass rho H
    rate: float  # size of the coefficient of the wedge term: 1/dX, or about 1/dT for a transient film
    source: Array  # right side of the Reynolds equation, zero on the edges, shape (nx, ny)
    # to_finer and from_finer: interpolation to and from the next finer grid; None for the finest.
    to_finer: Transfer | None
    from_finer: Transfer | None
    # Full weighting of residuals of the next finer grid; None for the finest and for line contacts.
    averaged: Transfer | None
    # Distribution of one unknown of the line relaxation over the nodes of its line: (offset, part).
    distribution: Distribution = DIPOLE
    # Pressure above ambient on the edges of the domain, zero inside, shape (nx, ny).
    edge_excess: Array | float = 0.0

    @property
    def nodes(self) -> int:
        """Number of nodes along x."""
        return self.mesh.x.size

    def inject(self, values: Array) -> Array:
        """Interpolate values (nx, ny) of the next finer grid to the nodes of this grid."""
        assert self.from_finer is not None
        return self.from_finer(values)

    def inside(self, nodes: Mask) -> Mask:
        """Nodes of this grid inside a mask (nx, ny) of the next finer grid; none that lies on its border."""
        return self.inject(nodes.astype(float)) > 1.0 - 1e-9

    def prolong(self, values: Array) -> Array:
        """Interpolate values (nx, ny) of this grid linearly to the nodes of the next finer grid."""
        assert self.to_finer is not None
        return self.to_finer(values)

    def restrict(self, residual: Array) -> Array:
        """Transfer a residual (nx, ny) of the next finer grid to this grid.

        In a line contact the residual is injected. Next to the pressure spike neighbouring rows differ by
        orders of magnitude, and an average would add the errors of large rows to small rows. In a point
        contact the residual is averaged. Neighbouring lines are coupled weakly in the Hertz zone, so that
        their residuals may differ.
        """
        if self.averaged is None:
            return self.inject(residual)
        return self.averaged(residual)


def hierarchy(
    nodes: int,
    *,
    inlet: float,
    outlet: float,
    geometry: Geometry,
    wedge_order: int,
    width: Width | None = None,
    source: Callable[[Array, Array], Array] | None = None,
) -> list[Level]:
    """Grids of a contact from the finest to the coarsest, each with half the intervals of the grid before.
    ``source``, right side of the Reynolds equation: function of X (nx,) and Y (ny,) -> (nx, ny); zero by
    default. Returns at least two grids.

    Half of an odd number of intervals is rounded up. Two such grids share only their end nodes, and the
    transfers interpolate at all others.
    """
    _keep_freed_memory()
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
                wedge=wedge_stencil(mesh.shape, mesh.dx, order=wedge_order),
                rate=1.0 / mesh.dx,
                source=right,
                to_finer=up,
                from_finer=Transfer.between(meshes[k - 1], mesh) if k else None,
                averaged=up.averaging(mesh, meshes[k - 1]) if up and mesh.dy is not None else None,
            )
        )
    return levels


@cache
def _keep_freed_memory() -> None:
    """Let the C library keep up to 64 MB of freed memory for the next arrays of this process.

    glibc returns freed memory to the system above twice the size of the largest array that was freed so far,
    up to 32 MB. The arrays of a Newton step would be returned and requested again all the time, which takes
    a sixth of the time of a point contact. The pages of this array are not touched, so it costs nothing.
    """
    np.empty(2**22 - 2**13)


def _meshes(nodes: int, inlet: float, outlet: float, width: Width | None) -> list[Mesh]:
    """Meshes of the hierarchy, from the finest to the coarsest."""
    meshes = [Mesh.over(nodes, inlet, outlet, width)]
    coarsest = COARSEST_POINT
    if width is None:
        coarsest = COARSEST if nodes <= _LARGE else _COARSEST_OF_LARGE
    while meshes[-1].weights.size > coarsest or len(meshes) < 2:
        mesh = meshes[-1]
        # Only lines along x are relaxed. If the nodes across are much closer, only the y axis is
        # coarsened.
        if mesh.dy is None or mesh.dx <= NEARER * mesh.dy:
            nodes = nodes // 2 + 1
        if width is not None:
            width = width.coarser()
        meshes.append(Mesh.over(nodes, inlet, outlet, width))
    return meshes
