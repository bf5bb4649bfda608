"""Properties of the oil across the film: nodes over zeta = z/h, and the values that a temperature gives."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache, cached_property
from typing import Protocol

import numpy as np

from ehlectric.arrays import Array
from ehlectric.film.mesh import Mesh
from ehlectric.formulas.polynomials import (
    derivative_matrix,
    gauss_legendre,
    interpolation,
    lobatto_nodes,
    lobatto_weights,
)

# Number of Gauss points across the film. If the stress changes by 200 Eyring stresses across the film, the
# flux is accurate to 2e-8, where it changes by 500 to 2e-3.
_POINTS = 32


@dataclass(frozen=True)
class Across:
    """Polynomial across the film, on Gauss-Lobatto nodes zeta from surface 1 (zeta = 0) to 2 (zeta = 1)."""

    # zeta and weights: nodes and weights of the quadrature from 0 to 1, shape (nz,).
    zeta: Array
    weights: Array
    # Matrix of the integral from 0 to each node, exact for the polynomial through the nodes, shape (nz, nz).
    cumulative: Array
    derivative: Array  # matrix of the derivative by zeta at the nodes, shape (nz, nz)

    @classmethod
    @cache
    def of(cls, degree: int) -> Across:
        """Nodes and weights of a polynomial degree, at least 2.

        Examples
        --------
        The integral of zeta^2 from zero to each node:

        >>> across = Across.of(4)
        >>> bool(np.allclose(across.cumulative @ across.zeta**2, across.zeta**3 / 3.0))
        True
        """
        zeta = lobatto_nodes(degree)
        return cls(zeta, lobatto_weights(zeta), integrals(zeta, zeta), derivative_matrix(zeta))

    @cached_property
    def conduction(self) -> Array:
        """Integrals of phi_i' phi_j' from each node's value of the conductivity, shape (nz, nz nz)."""
        slope = self.derivative
        products = self.weights[:, np.newaxis, np.newaxis] * slope[:, :, np.newaxis] * slope[:, np.newaxis]
        return np.asarray(products.reshape(self.zeta.size, -1))

    @cached_property
    def convection(self) -> Array:
        """Rows of the derivative at each node, from the node's flow across the film, shape (nz, nz nz)."""
        nodes = np.arange(self.zeta.size)
        rows = np.zeros((nodes.size, nodes.size, nodes.size))
        rows[nodes, nodes] = self.derivative
        return rows.reshape(nodes.size, -1)

    def at(self, zeta: Array) -> Array:
        """Matrix of the interpolation from the nodes to other positions ``zeta`` (n,), shape (n, nz)."""
        return interpolation(self.zeta, zeta)


def integrals(nodes: Array, ends: Array) -> Array:
    """Integrals from 0 to each of ``ends`` (n,) of the Lagrange polynomials of ``nodes`` (m,), (n, m)."""
    points, weights = gauss_legendre(nodes.size // 2 + 1)
    return np.stack([0.5 * end * weights @ interpolation(nodes, 0.5 * end * (1.0 + points)) for end in ends])


@dataclass(frozen=True)
class Quadrature:
    """Gauss points across the film."""

    # offset and weights: positions zeta - 1/2 and weights, shape (nq,).
    offset: Array
    weights: Array

    @classmethod
    @cache
    def gauss(cls, number: int = _POINTS) -> Quadrature:
        """Gauss-Legendre points of the flow across the film."""
        points, weights = gauss_legendre(number)
        return cls(0.5 * points, 0.5 * weights)


# Gauss points that are enough for any column.
GAUSS = Quadrature.gauss()


@cache
def to_points(degree: int, number: int = _POINTS) -> tuple[Array, Array]:
    """Matrices from the nodes of ``Across.of(degree)`` to some Gauss points, each of shape (nq, nz). Returns
    ``values``, interpolation, shape (nq, nz); ``below``, integral of the values from zeta = 0 to the point,
    less half the integral over the film, shape (nq, nz).
    """
    across, quadrature = Across.of(degree), Quadrature.gauss(number)
    zeta = quadrature.offset + 0.5
    below = integrals(across.zeta, zeta) - 0.5 * across.weights
    return across.at(zeta), below


def over_columns(values: Array, like: Array) -> Array:
    """Values over zeta (nq,) with axes for the columns of an array ``like``, shape (nq, 1, ...)."""
    return values.reshape((-1,) + (1,) * like.ndim)


@dataclass(frozen=True)
class Properties:
    """Viscosity and density of the oil across the film, each of shape (nz, nx, ny)."""

    # log_ratio and log_ratio_p: ln of the viscosity divided by the viscosity of ``Fluid.log_viscosity``, and
    # its derivative by P.
    log_ratio: Array
    log_ratio_p: Array
    density: Array
    density_p: Array


class Profile(Protocol):
    """Temperature across the film, which the flow takes as fixed, with the properties of the oil at it."""

    @property
    def across(self) -> Across:
        """Nodes across the film."""
        ...

    def __call__(self, pressure: Array, mesh: Mesh) -> Properties:
        """Properties at a pressure P (nx, ny), not below ambient, on any mesh of the same contact.

        The flow is also computed on coarser grids and on strips of the grid.
        """
        ...
