"""The electric field in the gap of a point contact: strength, capacitance and its map, area of high field."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from scipy.constants import epsilon_0

from ehlectric.arrays import Array, Mask
from ehlectric.errors import InputError
from ehlectric.field.poisson import Across, mean_permittivity
from ehlectric.field.poisson_3d import PointFieldProblem, PotentialSolver, by_node
from ehlectric.field.strength import GapField
from ehlectric.field.zones import HIGH_FIELD, Zone, area_above, node_areas, zone_areas
from ehlectric.runtime.threads import one_blas_thread


@dataclass(frozen=True)
class PointField(GapField):
    """Potential and field strength between the walls in three dimensions, SI units.

    Attributes
    ----------
    x, y, s : ndarray, shapes (nx,), (ny,), (ns,)
        Positions along the gap [m] and fraction of the gap from the lower wall.
    z, permittivity, potential : ndarray, shape (nx, ny, ns)
        Height [m], relative permittivity, potential [V].
    field_x, field_y, field_z, strength : ndarray, shape (nx, ny, ns)
        Components of E = -grad V and its magnitude [V/m].
    middle_strength : ndarray, shape (nx, ny)
        abs(E) at s = 1/2 [V/m].
    thin_gap_strength : ndarray, shape (nx, ny)
        voltage/h(x, y) [V/m].
    capacitance, capacitance_by_charge : float
        From the energy of the field and from the charge of wall 2 [F]; without the free charge. They agree
        unless side faces have given potentials.
    thin_gap_capacitance : float
        Integral of eps0 eps/h [F].
    capacitance_density : ndarray, shape (nx, ny)
        Charge of wall 2 by voltage and area of the map [F/m^2]: that of each node over its part of the map,
        so that the sum over ``node_areas`` is ``capacitance_by_charge``.
    iterations : int
        Of the conjugate gradients, without the free charge.
    """

    x: Array
    y: Array
    s: Array
    z: Array
    permittivity: Array
    potential: Array
    field_x: Array
    field_y: Array
    field_z: Array
    strength: Array
    middle_strength: Array
    thin_gap_strength: Array
    voltage: float
    capacitance: float
    capacitance_by_charge: float
    thin_gap_capacitance: float
    capacitance_density: Array
    iterations: int

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
        """Columns more than three gaps from the side faces, which disturb the field, shape (nx, ny)."""
        far = 3.0 * self.voltage / self.thin_gap_strength
        x, y = self.x[:, np.newaxis], self.y
        along_x = (x > x[0] + far[0]) & (x < x[-1] - far[-1])
        along_y = (y > y[0] + far[:, :1]) & (y < y[-1] - far[:, -1:])
        inner: Mask = along_x & along_y
        return inner

    @property
    def high_field_area(self) -> float:
        """Area where the mid-film abs(E) is at least 95 % of its maximum, all lobes together, finer than the
        cells [m^2].
        """
        level = HIGH_FIELD * float(np.max(self.middle_strength))
        return area_above(self.x, self.y, self.middle_strength, level)

    @property
    def node_areas(self) -> Array:
        """Area of each node's part of the map [m^2], shape (nx, ny)."""
        return node_areas(self.x, self.y)

    def capacitance_of(self, zone: Zone) -> float:
        """Capacitance of a part of the map.

        Parameters
        ----------
        zone : callable
            Whether the points of two arrays x, y [m] are inside. Cells on its boundary are divided.

        Returns
        -------
        float
            Charge of wall 2 inside by voltage [F]. Zones that share out the map add up to
            ``capacitance_by_charge`` to rounding.
        """
        return float(np.vdot(zone_areas(self.x, self.y, zone), self.capacitance_density))

    def mirrored(self) -> PointField:
        """The field on both sides of a plane of symmetry, of one solved for y >= 0 without flux at y = 0.

        Returns
        -------
        PointField
            The whole: 2 ny - 1 columns along y and twice the capacitances.

        Raises
        ------
        InputError
            Where y does not start at 0.
        """
        if self.y[0] != 0.0:
            raise InputError("y", got=f"a field from {self.y[0]:g} m on;", takes="one that starts at y = 0")

        def both(values: Array, sign: float = 1.0) -> Array:
            return np.concatenate([sign * values[:, :0:-1], values], axis=1)

        # On the plane itself nothing points across it, which differences to one side give but nearly.
        field_y = self.field_y.copy()
        field_y[:, 0] = 0.0
        field_x, field_y, field_z = both(self.field_x), both(field_y, -1.0), both(self.field_z)
        return replace(
            self,
            y=np.concatenate([-self.y[:0:-1], self.y]),
            z=both(self.z),
            permittivity=both(self.permittivity),
            potential=both(self.potential),
            field_x=field_x,
            field_y=field_y,
            field_z=field_z,
            strength=_magnitude(field_x, field_y, field_z),
            middle_strength=_middle(field_x, field_y, field_z),
            thin_gap_strength=both(self.thin_gap_strength),
            capacitance=2.0 * self.capacitance,
            capacitance_by_charge=2.0 * self.capacitance_by_charge,
            thin_gap_capacitance=2.0 * self.thin_gap_capacitance,
            capacitance_density=both(self.capacitance_density),
        )


def solve_point_field(problem: PointFieldProblem) -> PointField:
    """Solve the Poisson problem between two conducting walls in three dimensions.

    Parameters
    ----------
    problem : PointFieldProblem
        Geometry, permittivity, potentials and charge, SI units.

    Returns
    -------
    PointField
        Potential, field and what follows from them.

    Raises
    ------
    InputError
        Where there are fewer than three columns either way.
    ConvergenceError
        Where the conjugate gradients do not converge: slopes of the walls far above one.

    Notes
    -----
    Eq. (15) of Morris et al. (2022), doi:10.3390/lubricants10050087, with z added and Dirichlet walls. The
    charge of a wall is the residual of its nodes, so that energy and charge give one capacitance.

    Examples
    --------
    A plate capacitor, 1 mm square with a gap of 1 um: eps0 times a metre.

    >>> import numpy as np
    >>> x = np.linspace(0.0, 1e-3, 11)
    >>> flat = np.zeros((11, 11))
    >>> plates = PointFieldProblem(x, x, flat, flat + 1e-6, flat + 1.0, 0.0, 1.0)
    >>> round(solve_point_field(plates).capacitance * 1e12, 6)
    8.854188
    """
    if min(problem.lower.shape) < 3:
        raise InputError("x, y", got=f"{problem.lower.shape} columns;", takes="at least 3 either way")
    voltage = problem.potential_2 - problem.potential_1
    with one_blas_thread():
        solver = PotentialSolver(problem)
        # Relative to wall 1: a large common potential must not cost digits of the field.
        free, iterations = solver.solve()
        potential = free
        if problem.charge_density is not None:
            potential, _ = solver.solve(solver.quadrature.charge(problem.charge_density))
        charges = solver.operator(free)[:, :, -1]
        energy = solver.quadrature.energy(free)
        return _field(
            problem,
            potential,
            capacitance=epsilon_0 * energy / voltage**2,
            charges=epsilon_0 / voltage * charges,
            iterations=iterations,
        )


def _field(
    problem: PointFieldProblem, potential: Array, *, capacitance: float, charges: Array, iterations: int
) -> PointField:
    """Field strength by differentiation of a potential above wall 1, and the thin-gap estimates.

    ``charges`` are those of the nodes of wall 2 by voltage [F].
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
        thin_gap_capacitance=float(np.vdot(epsilon_0 * mean_permittivity(permittivity) / gap, areas)),
        capacitance_density=charges / areas,
        iterations=iterations,
    )


def _magnitude(*components: Array) -> Array:
    square = components[0] ** 2
    for component in components[1:]:
        square += component**2
    return np.sqrt(square, out=square)


def _middle(*components: Array) -> Array:
    """Magnitude at s = 1/2, of components at the nodes."""
    at_middle = Across.of_degree(components[0].shape[2] - 1).at_middle
    return _magnitude(*(component @ at_middle for component in components))
