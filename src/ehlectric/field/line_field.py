"""Electric field in the gap of a line contact: strength, capacitance and the zone of high field."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from ehlectric.arrays import Array, Mask
from ehlectric.constants import EPSILON_0
from ehlectric.field.field_accuracy import GapField, with_error
from ehlectric.field.poisson import (
    Across,
    BandedSolver,
    Elements,
    FieldProblem,
    Quadrature,
    mean_permittivity,
    nodal_values,
)
from ehlectric.field.zones import HIGH_FIELD, interval_above, line_zone_areas, part_widths
from ehlectric.formulas.polynomials import interpolation
from ehlectric.quantities.field_metadata import stored
from ehlectric.runtime.threads import one_blas_thread


@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class Field(GapField):
    """Electric potential and field strength in the gap of a line contact, in SI units.

    The class adds the attribute below to the attributes of ``GapField``, whose columns have the shape (nx,).
    """

    y: Array = field(metadata=stored("x_field s", "m", "increasing", "height"))  # height [m], shape (nx, ns)
    capacitance_density: Array = field(
        metadata=stored("columns", "F/m^2", "finite", "capacitance per length and width")
    )

    @property
    def axes(self) -> tuple[Array, ...]:
        """Positions of the columns along entrainment [m], as a tuple with one array."""
        return (self.x,)

    def extent_above(self, values: Array, level: float) -> float:
        """Width of the interval around the maximum where ``values`` (nx,) are at least ``level`` [m]."""
        start, stop = interval_above(self.x, values, level)
        return stop - start

    def capacitance_by_zone(self, half_width: float) -> dict[str, float]:
        """Capacitance per length of the Hertz zone, the inlet and the outlet [F/m].

        The Hertz zone is abs(x) <= ``half_width`` [m].
        """
        weights = line_zone_areas(self.axes, half_width)
        return {name: float(np.vdot(widths, self.capacitance_density)) for name, widths in weights.items()}

    @property
    def max_strength_position(self) -> float:
        """Position of the largest abs(E) [m]."""
        return float(self.x[np.argmax(self.column_strength)])

    @property
    def inner(self) -> Mask:
        """Mask of the columns that are more than three gaps away from both ends, shape (nx,).

        Closer to an end, the end face disturbs the field.
        """
        gap = self.voltage / self.thin_gap_strength
        inner: Mask = (self.x > self.x[0] + 3.0 * gap[0]) & (self.x < self.x[-1] - 3.0 * gap[-1])
        return inner if inner.any() else np.ones_like(inner)  # a range of few gaps has none

    @property
    def high_field_zone(self) -> tuple[float, float]:
        """Ends of the high-field zone [m], interpolated between nodes.

        The zone is the contiguous interval around the maximum of the mid-film abs(E) where the mid-film
        abs(E) is at least 95 % of this maximum.
        """
        level = HIGH_FIELD * float(np.max(self.middle_strength))
        return interval_above(self.x, self.middle_strength, level)

    @property
    def high_field_width(self) -> float:
        """Width of the high-field zone [m]."""
        start, stop = self.high_field_zone
        return stop - start

    def strength_at(self, height: float) -> Array:
        """Field strength along a straight line of constant height. ``height``, position y of the line [m].
        Returns abs(E) [V/m]; NaN where the line is outside the gap, shape (nx,).
        """
        lower, upper = self.y[:, 0], self.y[:, -1]
        basis = interpolation(self.s, (height - lower) / (upper - lower))
        strength = np.hypot(np.sum(basis * self.field_x, axis=1), np.sum(basis * self.field_y, axis=1))
        return np.where((lower <= height) & (height <= upper), strength, np.nan)


def solve_field(problem: FieldProblem) -> Field:
    """Solve Poisson's equation between the two conducting walls of a line contact. Returns potential, field
    strength and capacitance.

    Eq. (15) of Morris et al. (2022), doi:10.3390/lubricants10050087, with prescribed potentials of the walls
    (Dirichlet conditions). The charge of a wall is the residual at its nodes. With this definition, energy
    and charge give the same capacitance.

    The error of the largest field is estimated by ``field.field_accuracy``. If the polynomial degree
    makes it larger than 0.5 %, the field is solved once more with a degree of at most ``most_degree``.

    Examples
    --------
    A plate capacitor, 1 mm wide and with a gap of 1 um, has the capacitance per length 1000 eps0:

    >>> import numpy as np
    >>> x = np.linspace(0.0, 1e-3, 11)
    >>> plates = FieldProblem(x, 0.0 * x, 0.0 * x + 1e-6, 1.0 + 0.0 * x, 0.0, 1.0)
    >>> round(solve_field(plates).capacitance * 1e9, 6)
    8.854188
    """
    return with_error(problem, _field)


def _field(problem: FieldProblem) -> Field:
    """Field of a problem at its own degree, without an error estimate."""
    voltage = problem.potential_2 - problem.potential_1
    with one_blas_thread():
        quadrature = Quadrature.of(problem)
        elements = quadrature.elements()
        solver = BandedSolver(elements, fixed_ends=problem.end_potentials is not None)
        # Potentials are relative to wall 1: a large common potential would cost digits of the field.
        lifted = _lift(problem, quadrature.across.nodes)
        without_charge = _solve(solver, elements, lifted, np.zeros_like(lifted))
        potential = without_charge
        if problem.charge_density is not None:
            load = quadrature.charge(problem.charge_density)
            potential = _solve(solver, elements, lifted, load)
    charges = EPSILON_0 * elements.apply(without_charge)[:, -1]
    return field_from_potential(
        problem,
        potential,
        capacitance=EPSILON_0 * quadrature.energy(without_charge) / voltage**2,
        capacitance_density=charges / voltage / part_widths(problem.x, -np.inf, np.inf),
    )


def _lift(problem: FieldProblem, s: Array) -> Array:
    """Potential relative to wall 1 that fulfils the boundary conditions [V], shape (nx, ns).

    It is linear across the gap, except on end faces with a prescribed potential.
    """
    linear = (problem.potential_2 - problem.potential_1) * s
    lifted = np.repeat(linear[np.newaxis], problem.x.size, axis=0)
    if problem.end_potentials is not None:
        left, right = problem.end_potentials
        lifted[0, 1:-1] = left[1:-1] - problem.potential_1
        lifted[-1, 1:-1] = right[1:-1] - problem.potential_1
    return lifted


def _solve(solver: BandedSolver, elements: Elements, lifted: Array, load: Array) -> Array:
    """Nodal potential relative to wall 1 with the boundary values of ``lifted`` [V], shape (nx, ns)."""
    potential = lifted.copy()
    potential[:, 1:-1] += solver((load - elements.apply(lifted))[:, 1:-1])
    return potential


def field_from_potential(
    problem: FieldProblem, potential: Array, *, capacitance: float, capacitance_density: Array
) -> Field:
    """Field strength of a potential by differentiation, with the estimates for a thin gap.

    ``potential``, potential relative to wall 1 at the nodes [V], shape (nx, degree + 1); ``capacitance``,
    capacitance per length from the energy of the field [F/m]; ``capacitance_density``, charge of wall 2 per
    area and voltage [F/m^2], shape (nx,).
    """
    across = Across.of_degree(problem.degree)
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
    permittivity = nodal_values(problem.permittivity, s.size)
    return Field(
        x=x,
        s=s,
        y=problem.lower[:, np.newaxis] + gap[:, np.newaxis] * s,
        permittivity=permittivity,
        potential=problem.potential_1 + potential,
        field_x=field_x,
        field_y=field_y,
        strength=np.hypot(field_x, field_y),
        middle_strength=middle,
        thin_gap_strength=voltage / gap,
        voltage=voltage,
        capacitance=capacitance,
        capacitance_by_charge=float(np.trapezoid(capacitance_density, x)),
        thin_gap_capacitance=float(np.trapezoid(EPSILON_0 * mean_permittivity(permittivity) / gap, x)),
        capacitance_density=capacitance_density,
    )
