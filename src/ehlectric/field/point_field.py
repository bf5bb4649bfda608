"""Electric field in the gap of a point contact: strength, capacitance and the area of high field."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from ehlectric.arrays import Array, Mask
from ehlectric.constants import EPSILON_0
from ehlectric.errors import InputError
from ehlectric.field.field_accuracy import GapField, with_error
from ehlectric.field.poisson import Across, mean_permittivity
from ehlectric.field.poisson_3d import PointFieldProblem, PotentialSolver, by_node
from ehlectric.field.zones import (
    HIGH_FIELD,
    Zone,
    area_above,
    contact_zones,
    lobe_above,
    node_areas,
    zone_areas,
)
from ehlectric.quantities.field_metadata import number, stored
from ehlectric.runtime.threads import one_blas_thread

# Long name of ``y`` in files of results.
_POSITION = "position across entrainment, columns of the field"


@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class PointField(GapField):
    """Electric potential and field strength in the gap of a point contact, in SI units.

    The class adds the attributes below to the attributes of ``GapField``, whose columns have the shape (nx,
    ny).
    """

    # Positions across the gap [m], shape (ny,).
    y: Array = field(metadata=stored("y_field", "m", "increasing", _POSITION, name="y_field"))
    # z and field_z: height [m], and component of E across the gap [V/m], shape (nx, ny, ns).
    z: Array = field(metadata=stored("columns s", "m", "increasing", "height"))
    field_z: Array = field(metadata=stored("columns s", "V/m", "finite", "electric field along z"))
    # Number of conjugate-gradient iterations for the potential without free charge.
    iterations: int = field(metadata=number())

    @property
    def axes(self) -> tuple[Array, ...]:
        """Positions of the columns along and across entrainment [m]."""
        return self.x, self.y

    def extent_above(self, values: Array, level: float) -> float:
        """Area of the lobe around the maximum where ``values`` (nx, ny) are at least ``level`` [m^2]."""
        return lobe_above(self.x, self.y, values, level)

    @property
    def surface_1_strength(self) -> Array:
        """abs(E) on the lower wall [V/m], shape (nx, ny)."""
        return self.strength[:, :, 0]

    @property
    def surface_2_strength(self) -> Array:
        """abs(E) on the upper wall [V/m], shape (nx, ny)."""
        return self.strength[:, :, -1]

    @property
    def max_strength_position(self) -> tuple[float, float]:
        """Position x, y of the largest abs(E) [m]."""
        _, i, j = np.unravel_index(np.argmax(self._sections), self._sections.shape)
        return float(self.x[i]), float(self.y[j])

    @property
    def inner(self) -> Mask:
        """Mask of the columns that are more than three gaps away from the side faces, shape (nx, ny).

        Closer to a side face, the face disturbs the field.
        """
        far = 3.0 * self.voltage / self.thin_gap_strength
        x, y = self.x[:, np.newaxis], self.y
        along_x = (x > x[0] + far[0]) & (x < x[-1] - far[-1])
        along_y = (y > y[0] + far[:, :1]) & (y < y[-1] - far[:, -1:])
        inner: Mask = along_x & along_y
        return inner if inner.any() else np.ones_like(inner)  # a range of few gaps has none

    @property
    def high_field_area(self) -> float:
        """Area where the mid-film abs(E) is at least 95 % of its maximum [m^2], all lobes together.

        It is interpolated within the cells.
        """
        level = HIGH_FIELD * float(np.max(self.middle_strength))
        return area_above(self.x, self.y, self.middle_strength, level)

    def capacitance_of(self, zone: Zone) -> float:
        """Capacitance of a part of the map. ``zone``, function of two arrays x, y [m] that returns which
        points are inside. Returns charge of wall 2 inside the zone, divided by the voltage [F].
        """
        return float(np.vdot(zone_areas(self.x, self.y, zone), self.capacitance_density))

    def capacitance_by_zone(self, semi_axis_x: float, semi_axis_y: float) -> dict[str, float]:
        """Capacitance of the Hertz ellipse, the inlet, the outlet and the sides of the contact [F].

        The zones are ``contact_zones`` of a Hertz ellipse with these semi-axes [m].
        """
        zones = contact_zones(semi_axis_x, semi_axis_y)
        return {name: self.capacitance_of(zone) for name, zone in zones.items()}

    def mirrored(self) -> PointField:
        """Field of the whole contact, from the field of its half y >= 0 and the mirror image of that half.

        The half must have been solved without flux through the plane of symmetry y = 0.

        Returns field on 2 ny - 1 columns along y, with twice the capacitances. Raises InputError if y does
        not start at 0.
        """
        if self.y[0] != 0.0:
            raise InputError("y", got=f"a field from {self.y[0]:g} m on;", takes="one that starts at y = 0")

        def both(values: Array, sign: float = 1.0) -> Array:
            return np.concatenate([sign * values[:, :0:-1], values], axis=1)

        # On the plane of symmetry E_y vanishes; one-sided differences give zero only approximately.
        field_y = self.field_y.copy()
        field_y[:, 0] = 0.0
        field_x, field_y, field_z = both(self.field_x), both(field_y, -1.0), both(self.field_z)
        alike = ("z", "permittivity", "potential", "thin_gap_strength", "capacitance_density")
        whole: dict[str, Any] = {name: both(getattr(self, name)) for name in alike}
        for name in ("capacitance", "capacitance_by_charge", "thin_gap_capacitance"):
            whole[name] = 2.0 * getattr(self, name)
        return replace(
            self,
            y=np.concatenate([-self.y[:0:-1], self.y]),
            **whole,
            field_x=field_x,
            field_y=field_y,
            field_z=field_z,
            strength=_magnitude(field_x, field_y, field_z),
            middle_strength=_middle(field_x, field_y, field_z),
        )


def solve_point_field(problem: PointFieldProblem) -> PointField:
    """Solve Poisson's equation between the two conducting walls of a point contact. Returns potential, field
    strength and capacitance. Raises InputError if there are fewer than three columns along x or y;
    ConvergenceError if the conjugate gradients do not converge.

    Eq. (15) of Morris et al. (2022), doi:10.3390/lubricants10050087, with the third dimension added and
    prescribed potentials of the walls (Dirichlet conditions). The charge of a wall is the residual at its
    nodes. With this definition, energy and charge give the same capacitance.

    The error of the largest field is estimated by ``field.field_accuracy``. If the polynomial degree
    makes it larger than 0.5 %, the field is solved once more with a degree of at most ``most_degree``.

    Examples
    --------
    A plate capacitor, 1 mm square and with a gap of 1 um, has the capacitance eps0 times 1 m:

    >>> import numpy as np
    >>> x = np.linspace(0.0, 1e-3, 11)
    >>> flat = np.zeros((11, 11))
    >>> plates = PointFieldProblem(x, x, flat, flat + 1e-6, flat + 1.0, 0.0, 1.0)
    >>> round(solve_point_field(plates).capacitance * 1e12, 6)
    8.854188
    """
    if min(problem.lower.shape) < 3:
        raise InputError("x, y", got=f"{problem.lower.shape} columns;", takes="at least 3 either way")
    return with_error(problem, _solved)


def _solved(problem: PointFieldProblem) -> PointField:
    """Field of a problem at its own degree, without an error estimate."""
    voltage = problem.potential_2 - problem.potential_1
    with one_blas_thread():
        solver = PotentialSolver(problem)
        # Potentials are relative to wall 1: a large common potential would cost digits of the field.
        without_charge, iterations = solver.solve()
        potential = without_charge
        if problem.charge_density is not None:
            potential, _ = solver.solve(solver.quadrature.charge(problem.charge_density))
        charges = solver.operator(without_charge)[:, :, -1]
        energy = solver.quadrature.energy(without_charge)
        return _field(
            problem,
            potential,
            capacitance=EPSILON_0 * energy / voltage**2,
            charges=EPSILON_0 / voltage * charges,
            iterations=iterations,
        )


def _field(
    problem: PointFieldProblem, potential: Array, *, capacitance: float, charges: Array, iterations: int
) -> PointField:
    """Field of a potential relative to wall 1 [V], by differentiation, with the estimates for a thin gap.

    ``capacitance`` [F] follows from the energy. ``charges`` (nx, ny) are the charges of the nodes of wall 2
    over the voltage [F].
    """
    across = Across.of_degree(problem.degree)
    x, y, s = problem.x, problem.y, across.nodes
    gap = problem.upper - problem.lower
    by_s = potential @ across.derivative.T / gap[:, :, np.newaxis]
    components = []
    for axis, at in enumerate((x, y)):
        slope = np.gradient(problem.lower, at, axis=axis, edge_order=2)[:, :, np.newaxis] + (
            np.gradient(gap, at, axis=axis, edge_order=2)[:, :, np.newaxis] * s
        )
        components.append(slope * by_s - np.gradient(potential, at, axis=axis, edge_order=2))
    field_x, field_y = components
    permittivity = np.broadcast_to(by_node(problem.permittivity), potential.shape).copy()
    voltage = abs(problem.potential_2 - problem.potential_1)
    areas = node_areas(x, y)
    return PointField(
        x=x,
        y=y,
        s=s,
        z=problem.lower[:, :, np.newaxis] + gap[:, :, np.newaxis] * s,
        permittivity=permittivity,
        potential=problem.potential_1 + potential,
        field_x=field_x,
        field_y=field_y,
        field_z=-by_s,
        strength=_magnitude(field_x, field_y, by_s),
        middle_strength=_middle(field_x, field_y, by_s),
        thin_gap_strength=voltage / gap,
        voltage=voltage,
        capacitance=capacitance,
        capacitance_by_charge=float(np.sum(charges)),
        thin_gap_capacitance=float(np.vdot(EPSILON_0 * mean_permittivity(permittivity) / gap, areas)),
        capacitance_density=charges / areas,
        iterations=iterations,
    )


def _magnitude(*components: Array) -> Array:
    square = components[0] ** 2
    for component in components[1:]:
        square += component**2
    return np.sqrt(square, out=square)


def _middle(*components: Array) -> Array:
    """Magnitude of a vector at s = 1/2, from its components at the nodes (nx, ny, ns)."""
    at_middle = Across.of_degree(components[0].shape[2] - 1).at_middle
    return _magnitude(*(component @ at_middle for component in components))
