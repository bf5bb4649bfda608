"""The electric field in the gap between two conductors: the Poisson problem in mapped coordinates.

div(eps grad V) = -rho_q/eps0 between y1(x) and y2(x), with s = (y - y1)/h, so that both walls are grid
lines. Galerkin: linear elements along x, one polynomial of a few degrees across the gap on
Gauss-Lobatto-Legendre nodes. The matrix is symmetric, banded and solved directly.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import numpy as np
from scipy.constants import epsilon_0
from scipy.linalg import cho_solve_banded, cholesky_banded
from scipy.special import eval_legendre, roots_jacobi

from ehlectric.threads import one_blas_thread
from ehlectric.typing import Array

# Two Gauss points along an element: exact for the products of linear shape functions and geometry.
_GAUSS = np.array([0.5 - 0.5 / np.sqrt(3.0), 0.5 + 0.5 / np.sqrt(3.0)])

# The zone of high field is where the field is at least this part of its maximum.
HIGH_FIELD = 0.95


def lobatto_nodes(degree: int) -> Array:
    """Gauss-Lobatto-Legendre nodes on [0, 1], ascending, shape (degree + 1,).

    Examples
    --------
    >>> [float(s) for s in lobatto_nodes(2)]
    [0.0, 0.5, 1.0]
    """
    interior = roots_jacobi(degree - 1, 1.0, 1.0)[0] if degree > 1 else np.empty(0)
    return 0.5 * (1.0 + np.concatenate([[-1.0], interior, [1.0]]))


@dataclass(frozen=True)
class _Across:
    """Nodes, weights and differentiation across the gap, and the element matrices made of them."""

    nodes: Array  # (ns,)
    weights: Array  # (ns,)
    derivative: Array  # (ns, ns), d/ds at the nodes
    at_middle: Array  # (ns,), interpolation to s = 1/2
    slope: Array  # (ns, ns, ns): by quadrature point, product of two derivatives
    mixed: Array  # value of the first times derivative of the second
    mass: Array  # product of two values

    @classmethod
    @cache
    def of_degree(cls, degree: int) -> _Across:
        s = lobatto_nodes(degree)
        t = 2.0 * s - 1.0
        weights = 1.0 / (degree * (degree + 1) * eval_legendre(degree, t) ** 2)
        difference = s[:, np.newaxis] - s + np.eye(s.size)
        barycentric = 1.0 / np.prod(difference, axis=1)
        derivative = barycentric / barycentric[:, np.newaxis] / difference
        np.fill_diagonal(derivative, 0.0)
        np.fill_diagonal(derivative, -derivative.sum(axis=1))
        at_middle = np.array(
            [np.prod((0.5 - np.delete(s, k)) / (s[k] - np.delete(s, k))) for k in range(s.size)]
        )
        values = np.eye(s.size)
        return cls(
            nodes=s,
            weights=weights,
            derivative=derivative,
            at_middle=at_middle,
            slope=np.einsum("qk,ql->qkl", derivative, derivative),
            mixed=np.einsum("qk,ql->qkl", values, derivative),
            mass=np.einsum("qk,ql->qkl", values, values),
        )


@dataclass(frozen=True)
class FieldProblem:
    """Two conductors and what is between them.

    Parameters
    ----------
    x : ndarray, shape (nx,)
        Positions along the gap [m], increasing, any spacing.
    lower, upper : ndarray, shape (nx,)
        Surfaces y1(x) < y2(x) [m], at ``potential_1`` and ``potential_2``.
    permittivity : ndarray, shape (nx,) or (nx, degree + 1)
        Relative permittivity, uniform across the gap or at its nodes.
    potential_1, potential_2 : float
        Potentials of the walls [V], different.
    degree : int
        Polynomial degree across the gap, at least 2.
    charge_density : ndarray, shape (nx, degree + 1), optional
        Free charge in the gap [C/m^3], at the nodes s = ``lobatto_nodes(degree)``.
    end_potentials : pair of ndarray, shape (degree + 1,), optional
        Potential on the end faces [V]; without it no flux leaves there.
    """

    x: Array
    lower: Array
    upper: Array
    permittivity: Array
    potential_1: float
    potential_2: float
    degree: int = 6
    charge_density: Array | None = None
    end_potentials: tuple[Array, Array] | None = None


@dataclass(frozen=True)
class Field:
    """Potential and field strength between the walls, SI units.

    Attributes
    ----------
    x, s : ndarray, shapes (nx,), (ns,)
        Position along the gap [m] and fraction of the gap from the lower wall.
    y, potential, field_x, field_y, strength : ndarray, shape (nx, ns)
        Height [m], potential [V], components of E = -grad V and its magnitude [V/m].
    middle_strength : ndarray, shape (nx,)
        abs(E) at s = 1/2 [V/m].
    thin_gap_strength : ndarray, shape (nx,)
        voltage/h(x) [V/m].
    capacitance, capacitance_by_charge : float
        Per length, from the energy of the field and from the charge of a wall [F/m]; without the free
        charge.
    thin_gap_capacitance : float
        Integral of eps0 eps/h [F/m].
    """

    x: Array
    s: Array
    y: Array
    permittivity: Array
    potential: Array
    field_x: Array
    field_y: Array
    strength: Array
    middle_strength: Array
    thin_gap_strength: Array
    voltage: float
    capacitance: float
    capacitance_by_charge: float
    thin_gap_capacitance: float

    @property
    def max_strength(self) -> float:
        """Largest abs(E) on either wall or mid-film [V/m]."""
        return float(np.max(self._sections))

    @property
    def max_strength_position(self) -> float:
        """Position of the largest abs(E) [m]."""
        return float(self.x[np.argmax(np.max(self._sections, axis=0))])

    @property
    def _sections(self) -> Array:
        return np.stack([self.strength[:, 0], self.middle_strength, self.strength[:, -1]])

    @property
    def thin_gap_error(self) -> float:
        """(max_strength - voltage/h_min)/max_strength."""
        return 1.0 - float(np.max(self.thin_gap_strength)) / self.max_strength

    @property
    def high_field_zone(self) -> tuple[float, float]:
        """Ends of the contiguous interval around its maximum where the mid-film abs(E) is at least
        95 % of that maximum [m], interpolated between nodes.
        """
        level = HIGH_FIELD * float(np.max(self.middle_strength))
        peak = int(np.argmax(self.middle_strength))
        below = np.flatnonzero(self.middle_strength < level)
        left, right = below[below < peak], below[below > peak]
        start = self._crossing(left[-1], left[-1] + 1, level) if left.size else self.x[0]
        stop = self._crossing(right[0], right[0] - 1, level) if right.size else self.x[-1]
        return float(start), float(stop)

    def _crossing(self, outside: int, inside: int, level: float) -> float:
        e, x = self.middle_strength, self.x
        share = (level - e[outside]) / (e[inside] - e[outside])
        return float(x[outside] + share * (x[inside] - x[outside]))

    @property
    def high_field_width(self) -> float:
        """Width of the high-field zone [m]."""
        start, stop = self.high_field_zone
        return stop - start


@dataclass(frozen=True)
class _Elements:
    """Element matrices between the two columns of every element, each (nx - 1, ns, ns)."""

    left: Array
    cross: Array  # rows of the left column, columns of the right
    right: Array

    def apply(self, v: Array) -> Array:
        """The assembled operator times nodal values (nx, ns)."""
        a, b = v[:-1], v[1:]
        product = np.zeros_like(v)
        product[:-1] += _rows(self.left, a) + _rows(self.cross, b)
        product[1:] += _rows(np.swapaxes(self.cross, 1, 2), a) + _rows(self.right, b)
        return product


def _rows(matrices: Array, vectors: Array) -> Array:
    product: Array = np.matmul(matrices, vectors[:, :, np.newaxis])[:, :, 0]
    return product


@dataclass(frozen=True)
class _Quadrature:
    """Geometry and permittivity at the quadrature points of the elements."""

    across: _Across
    dx: Array  # (ne,)
    shapes: Array  # (2 nodes, 2 Gauss points)
    gap: Array  # (ne, 2 Gauss points)
    slope: Array  # (ne, ns), dy/dx at fixed s
    permittivity: Array  # (ne, 2 Gauss points, ns)

    @classmethod
    def of(cls, problem: FieldProblem) -> _Quadrature:
        across = _Across.of_degree(problem.degree)
        dx = np.diff(problem.x)
        gap = problem.upper - problem.lower
        slope = (np.diff(problem.lower)[:, np.newaxis] + np.diff(gap)[:, np.newaxis] * across.nodes) / dx[
            :, np.newaxis
        ]
        shapes = np.stack([1.0 - _GAUSS, _GAUSS])
        nodal = _nodal(problem.permittivity, across.nodes.size)
        return cls(
            across=across,
            dx=dx,
            shapes=shapes,
            gap=np.stack([gap[:-1], gap[1:]], axis=1) @ shapes,
            slope=slope,
            permittivity=np.einsum("aeq,ag->egq", np.stack([nodal[:-1], nodal[1:]]), shapes),
        )

    def elements(self) -> _Elements:
        """Element matrices of the integral of eps grad W . grad V over x and y.

        With the slope m of the lines of constant s, grad = (d/dx - (m/h) d/ds, (1/h) d/ds) and
        dx dy = h dx ds.
        """
        return _Elements(self._matrix(0, 0), self._matrix(0, 1), self._matrix(1, 1))

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
        """Right side of a charge density (nx, ns): the integral of W rho_q/eps0."""
        load = np.zeros_like(density)
        pair = np.stack([density[:-1], density[1:]])
        at_points = np.einsum("aeq,ag->egq", pair, self.shapes) * self.gap[:, :, np.newaxis]
        half = 0.5 * self.dx[:, np.newaxis] * self.across.weights / epsilon_0
        load[:-1] += half * np.einsum("egq,g->eq", at_points, self.shapes[0])
        load[1:] += half * np.einsum("egq,g->eq", at_points, self.shapes[1])
        return load

    def energy(self, v: Array) -> float:
        """Integral of eps abs(grad V)^2, from the gradients at the quadrature points [V^2]."""
        derivative = v @ self.across.derivative.T
        total = 0.0
        along = np.diff(v, axis=0) / self.dx[:, np.newaxis]
        for g in range(_GAUSS.size):
            h = self.gap[:, g, np.newaxis]
            ds = self.shapes[0, g] * derivative[:-1] + self.shapes[1, g] * derivative[1:]
            square = (along - self.slope / h * ds) ** 2 + (ds / h) ** 2
            cell = 0.5 * self.dx[:, np.newaxis] * self.across.weights * h
            total += float(np.sum(cell * self.permittivity[:, g] * square))
        return total


def _nodal(values: Array, ns: int) -> Array:
    """Values at the nodes (nx, ns), of values by column or by node."""
    return values if values.ndim == 2 else np.repeat(values[:, np.newaxis], ns, axis=1)


class _Solver:
    """Banded Cholesky factors of the interior unknowns, ordered column by column."""

    def __init__(self, elements: _Elements, *, fixed_ends: bool) -> None:
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
        self.factor = cholesky_banded(
            band.reshape(2 * ns, columns * ns), lower=True, overwrite_ab=True, check_finite=False
        )

    def __call__(self, right: Array) -> Array:
        """Interior values (nx, ns) with the assembled operator times them equal to ``right``."""
        r = right.copy()
        if self.fixed_ends:
            r[[0, -1]] = 0.0
        solution = cho_solve_banded((self.factor, True), r.reshape(-1), check_finite=False)
        return solution.reshape(self.columns, self.ns)


def solve_field(problem: FieldProblem) -> Field:
    """Solve the Poisson problem between two conducting walls.

    Parameters
    ----------
    problem : FieldProblem
        Geometry, permittivity, potentials and charge, SI units.

    Returns
    -------
    Field
        Potential, field and what follows from them.

    Notes
    -----
    Eq. (15) of Morris et al. (2022), doi:10.3390/lubricants10050087, with Dirichlet walls. The charge of
    a wall is the residual of its nodes, so that energy and charge give one capacitance.

    Examples
    --------
    A plate capacitor, 1 mm wide with a gap of 1 um: eps0 times a thousand.

    >>> import numpy as np
    >>> x = np.linspace(0.0, 1e-3, 11)
    >>> plates = FieldProblem(x, 0.0 * x, 0.0 * x + 1e-6, 1.0 + 0.0 * x, 0.0, 1.0)
    >>> round(solve_field(plates).capacitance * 1e9, 6)
    8.854188
    """
    with one_blas_thread():
        quadrature = _Quadrature.of(problem)
        elements = quadrature.elements()
        solver = _Solver(elements, fixed_ends=problem.end_potentials is not None)
        lifted = _lift(problem, quadrature.across.nodes)
        free = _solve(solver, elements, lifted, np.zeros_like(lifted))
        potential = free
        if problem.charge_density is not None:
            load = quadrature.charge(problem.charge_density)
            potential = _solve(solver, elements, lifted, load)
    voltage = problem.potential_2 - problem.potential_1
    charge = epsilon_0 * float(np.sum(elements.apply(free)[:, -1]))
    return _field(
        problem,
        potential,
        capacitance=epsilon_0 * quadrature.energy(free) / voltage**2,
        capacitance_by_charge=charge / voltage,
    )


def _lift(problem: FieldProblem, s: Array) -> Array:
    """Potential that meets the boundary conditions: linear across, or given on the end faces."""
    v1, v2 = problem.potential_1, problem.potential_2
    lifted = np.repeat((v1 + (v2 - v1) * s)[np.newaxis], problem.x.size, axis=0)
    if problem.end_potentials is not None:
        lifted[0, 1:-1], lifted[-1, 1:-1] = (end[1:-1] for end in problem.end_potentials)
    return lifted


def _solve(solver: _Solver, elements: _Elements, lifted: Array, load: Array) -> Array:
    """Nodal potential with the boundary values of ``lifted``."""
    potential = lifted.copy()
    potential[:, 1:-1] += solver((load - elements.apply(lifted))[:, 1:-1])
    return potential


def _field(
    problem: FieldProblem, potential: Array, *, capacitance: float, capacitance_by_charge: float
) -> Field:
    """Field strength by differentiation of the potential, and the thin-gap estimates."""
    across = _Across.of_degree(problem.degree)
    x, s = problem.x, across.nodes
    gap = problem.upper - problem.lower
    slope = np.gradient(problem.lower, x, edge_order=2)[:, np.newaxis] + (
        np.gradient(gap, x, edge_order=2)[:, np.newaxis] * s
    )
    by_s = potential @ across.derivative.T / gap[:, np.newaxis]
    field_y = -by_s
    field_x = slope * by_s - np.gradient(potential, x, axis=0, edge_order=2)
    voltage = abs(problem.potential_2 - problem.potential_1)
    middle = np.hypot(field_x @ across.at_middle, field_y @ across.at_middle)
    permittivity = _nodal(problem.permittivity, s.size)
    # Layers of different permittivity are in series: their reciprocals average across the gap.
    mean = 1.0 / ((1.0 / permittivity) @ across.weights)
    return Field(
        x=x,
        s=s,
        y=problem.lower[:, np.newaxis] + gap[:, np.newaxis] * s,
        permittivity=permittivity,
        potential=potential,
        field_x=field_x,
        field_y=field_y,
        strength=np.hypot(field_x, field_y),
        middle_strength=middle,
        thin_gap_strength=voltage / gap,
        voltage=voltage,
        capacitance=capacitance,
        capacitance_by_charge=capacitance_by_charge,
        thin_gap_capacitance=float(np.trapezoid(epsilon_0 * mean / gap, x)),
    )
