"""Poisson's equation in the gap of a line contact, discretised in coordinates that follow the walls.

div(eps grad V) = -rho_q/eps0 is solved between the walls y1(x) and y2(x). With the coordinate s = (y - y1)/h
both walls are grid lines. The Galerkin method takes linear elements along x and one polynomial across the
gap, on Gauss-Lobatto-Legendre nodes. The matrix is symmetric and banded, and is factorised directly.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import numpy as np
import scipy

from ehlectric.arrays import Array
from ehlectric.constants import EPSILON_0
from ehlectric.formulas.polynomials import derivative_matrix, interpolation, lobatto_nodes, lobatto_weights

# Two Gauss points along an element: more points would not raise the order of linear elements.
GAUSS = np.array([0.5 - 0.5 / np.sqrt(3.0), 0.5 + 0.5 / np.sqrt(3.0)])


@dataclass(frozen=True)
class Across:
    """Polynomial across the gap: nodes, quadrature weights, differentiation and element matrices."""

    # nodes and weights: Gauss-Lobatto-Legendre nodes s on [0, 1], and the weights of their quadrature,
    # shape (ns,).
    nodes: Array
    weights: Array
    derivative: Array  # matrix of d/ds at the nodes, shape (ns, ns)
    at_middle: Array  # weights of the interpolation to s = 1/2, shape (ns,)
    # slope, mixed and mass: products of two shape functions at each quadrature point, the first axis: both
    # differentiated, the second differentiated, none differentiated, shape (ns, ns, ns).
    slope: Array
    mixed: Array
    mass: Array

    @classmethod
    @cache
    def of_degree(cls, degree: int) -> Across:
        """Nodes, weights and matrices of a polynomial degree, computed once per degree."""
        s = lobatto_nodes(degree)
        values, derivative = np.eye(s.size), derivative_matrix(s)
        return cls(
            nodes=s,
            weights=lobatto_weights(s),
            derivative=derivative,
            at_middle=interpolation(s, np.array([0.5]))[0],
            slope=np.einsum("qk,ql->qkl", derivative, derivative),
            mixed=np.einsum("qk,ql->qkl", values, derivative),
            mass=np.einsum("qk,ql->qkl", values, values),
        )


@dataclass(frozen=True)
class FieldProblem:
    """Problem of the electric field between the two conducting walls of a line contact, in SI units.

    ``x``, positions along the gap [m], increasing, any spacing, shape (nx,); ``lower`` and ``upper``, heights
    y1(x) < y2(x) of the walls [m], shape (nx,); ``permittivity``, relative permittivity, one value per column
    or one per node, shape (nx,) or (nx, degree + 1); ``potential_1`` and ``potential_2``, potentials of the
    walls [V]; they must differ; ``degree``, polynomial degree across the gap, at least 2; ``most_degree``,
    degree up to which ``solve_field`` may raise the degree, where the largest field would else be more than
    0.5 % off; ``degree`` by default; ``charge_density``, density of free charge [C/m^3] at the nodes s =
    ``lobatto_nodes(degree)``; no charge by default, shape (nx, degree + 1); ``end_potentials``, potentials on
    the end faces x[0] and x[-1] [V], shape (degree + 1,).
    """

    x: Array
    lower: Array
    upper: Array
    permittivity: Array
    potential_1: float
    potential_2: float
    degree: int = 6
    most_degree: int | None = None
    charge_density: Array | None = None
    end_potentials: tuple[Array, Array] | None = None

    @property
    def positions(self) -> dict[str, Array]:
        """Positions of the columns [m], by the name of their axis."""
        return {"x": self.x}

    @property
    def plain(self) -> bool:
        """Whether the permittivity is constant across the gap, and only the walls have given potentials."""
        prescribed = self.charge_density is not None or self.end_potentials is not None
        return self.permittivity.ndim == self.lower.ndim and not prescribed


@dataclass(frozen=True)
class Elements:
    """Element matrices, one set per element between two neighbouring columns of nodes."""

    # left and right: coupling of the left column, or of the right column, with itself,
    # shape (nx - 1, ns, ns).
    left: Array
    cross: Array  # coupling of the left column (rows) with the right column (columns), shape (nx - 1, ns, ns)
    right: Array

    def apply(self, v: Array) -> Array:
        """Product of the assembled matrix and nodal values (nx, ns), shape (nx, ns)."""
        a, b = v[:-1], v[1:]
        product = np.zeros_like(v)
        product[:-1] += _rows(self.left, a) + _rows(self.cross, b)
        product[1:] += _rows(np.swapaxes(self.cross, 1, 2), a) + _rows(self.right, b)
        return product


def _rows(matrices: Array, vectors: Array) -> Array:
    product: Array = np.matmul(matrices, vectors[:, :, np.newaxis])[:, :, 0]
    return product


@dataclass(frozen=True)
class Quadrature:
    """Geometry and permittivity at the quadrature points of the ne = nx - 1 elements."""

    across: Across
    dx: Array  # lengths of the elements [m], shape (ne,)
    # Linear shape functions of the two columns (rows) at the two Gauss points (columns), shape (2, 2).
    shapes: Array
    gap: Array  # gap at the Gauss points [m], shape (ne, 2)
    slope: Array  # slope dy/dx of the lines of constant s, shape (ne, ns)
    permittivity: Array  # relative permittivity at the Gauss points, shape (ne, 2, ns)

    @classmethod
    def of(cls, problem: FieldProblem) -> Quadrature:
        """Quadrature of a field problem."""
        across = Across.of_degree(problem.degree)
        dx = np.diff(problem.x)
        gap = problem.upper - problem.lower
        slope = (np.diff(problem.lower)[:, np.newaxis] + np.diff(gap)[:, np.newaxis] * across.nodes) / dx[
            :, np.newaxis
        ]
        shapes = np.stack([1.0 - GAUSS, GAUSS])
        nodal = nodal_values(problem.permittivity, across.nodes.size)
        return cls(
            across=across,
            dx=dx,
            shapes=shapes,
            gap=np.stack([gap[:-1], gap[1:]], axis=1) @ shapes,
            slope=slope,
            permittivity=np.einsum("aeq,ag->egq", np.stack([nodal[:-1], nodal[1:]]), shapes),
        )

    def elements(self) -> Elements:
        """Element matrices of the integral of eps grad W . grad V over x and y, with test functions W.

        With the slope m of the lines of constant s, grad = (d/dx - (m/h) d/ds, (1/h) d/ds) and
        dx dy = h dx ds.
        """
        return Elements(self._matrix(0, 0), self._matrix(0, 1), self._matrix(1, 1))

    def _matrix(self, a: int, b: int) -> Array:
        across, shapes = self.across, self.shapes
        sign = (-1.0, 1.0)
        half = 0.5 * self.dx[:, np.newaxis] * across.weights
        eps_a = half * np.einsum("egq,g->eq", self.permittivity, shapes[a])
        eps_b = half * np.einsum("egq,g->eq", self.permittivity, shapes[b])
        eps_h = half * np.einsum("egq,eg->eq", self.permittivity, self.gap)
        eps_ab = half * np.einsum("egq,eg->eq", self.permittivity, shapes[a] * shapes[b] / self.gap)
        per_dx = 1.0 / self.dx[:, np.newaxis]
        coefficients = np.concatenate(
            [
                eps_ab * (1.0 + self.slope**2),
                -sign[a] * per_dx * self.slope * eps_b,
                -sign[b] * per_dx * self.slope * eps_a,
                sign[a] * sign[b] * per_dx**2 * eps_h,
            ],
            axis=1,
        )
        ns = across.nodes.size
        reference = np.concatenate([across.slope, across.mixed, np.swapaxes(across.mixed, 1, 2), across.mass])
        matrix: Array = (coefficients @ reference.reshape(4 * ns, ns * ns)).reshape(-1, ns, ns)
        return matrix

    def charge(self, density: Array) -> Array:
        """Integral of W rho_q/eps0 [V], the right side for a charge density (nx, ns) [C/m^3]."""
        load = np.zeros_like(density)
        pair = np.stack([density[:-1], density[1:]])
        at_points = np.einsum("aeq,ag->egq", pair, self.shapes) * self.gap[:, :, np.newaxis]
        half = 0.5 * self.dx[:, np.newaxis] * self.across.weights / EPSILON_0
        load[:-1] += half * np.einsum("egq,g->eq", at_points, self.shapes[0])
        load[1:] += half * np.einsum("egq,g->eq", at_points, self.shapes[1])
        return load

    def energy(self, v: Array) -> float:
        """Integral of eps abs(grad V)^2 over x and y [V^2], for nodal potentials V (nx, ns) [V].

        It is computed from the gradients at the quadrature points.
        """
        derivative = v @ self.across.derivative.T
        total = 0.0
        along = np.diff(v, axis=0) / self.dx[:, np.newaxis]
        for g in range(GAUSS.size):
            h = self.gap[:, g, np.newaxis]
            ds = self.shapes[0, g] * derivative[:-1] + self.shapes[1, g] * derivative[1:]
            square = (along - self.slope / h * ds) ** 2 + (ds / h) ** 2
            cell = 0.5 * self.dx[:, np.newaxis] * self.across.weights * h
            total += float(np.sum(cell * self.permittivity[:, g] * square))
        return total


def nodal_values(values: Array, ns: int) -> Array:
    """Values at the nodes, shape (nx, ns), from values per column (nx,) or per node (nx, ns)."""
    return values if values.ndim == 2 else np.repeat(values[:, np.newaxis], ns, axis=1)


def mean_permittivity(permittivity: Array) -> Array:
    """Mean relative permittivity across a gap, shape (...), from the values at its nodes (..., ns).

    It is the harmonic mean, as layers of different permittivity are in series.
    """
    return 1.0 / ((1.0 / permittivity) @ Across.of_degree(permittivity.shape[-1] - 1).weights)


class BandedSolver:
    """Direct solver for the potential at the interior nodes, by a banded Cholesky factorisation."""

    def __init__(self, elements: Elements, *, fixed_ends: bool) -> None:
        inner = slice(1, -1)
        columns, ns = elements.left.shape[0] + 1, elements.left.shape[1] - 2
        diagonal = np.zeros((columns, ns, ns))
        diagonal[:-1] += elements.left[:, inner, inner]
        diagonal[1:] += elements.right[:, inner, inner]
        below = np.swapaxes(elements.cross[:, inner, inner], 1, 2).copy()
        if fixed_ends:
            diagonal[[0, -1]] = np.eye(ns)
            below[[0, -1]] = 0.0
        self.columns, self.ns, self.fixed_ends = columns, ns, fixed_ends
        band = np.zeros((2 * ns, columns, ns))
        for k in range(ns):
            for row in range(ns):
                if row >= k:
                    band[row - k, :, k] = diagonal[:, row, k]
                band[ns + row - k, :-1, k] = below[:, row, k]
        self.factor = scipy.linalg.cholesky_banded(
            band.reshape(2 * ns, columns * ns), lower=True, overwrite_ab=True, check_finite=False
        )

    def __call__(self, right: Array) -> Array:
        """Solution of the assembled system with the right side ``right``, both of shape (nx, degree - 1).

        It is zero in the end columns where these are fixed.
        """
        r = right.copy()
        if self.fixed_ends:
            r[[0, -1]] = 0.0
        solution = scipy.linalg.cho_solve_banded((self.factor, True), r.reshape(-1), check_finite=False)
        return solution.reshape(self.columns, self.ns)
