"""The lubricant film of a loaded contact in SI units, with its status and its error estimate."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ehlectric.elastic import Geometry
from ehlectric.mesh import Mesh, at_centre
from ehlectric.nested import FilmProblem, Scales, nested_iteration
from ehlectric.newton import GridSolution, NewtonStep, Progress, State, Status
from ehlectric.reynolds import Fluid
from ehlectric.threads import one_blas_thread
from ehlectric.typing import Array, Mask

# Part of the central film below which a gap that was not solved for is no film.
COLLAPSED = 1e-2

# Least observed order of the minimum film, of a scheme of second order.
MINIMUM_ORDER = 1.25


@dataclass(frozen=True)
class Film:
    """Film of a line contact in SI units, with how it was obtained.

    Attributes
    ----------
    x, pressure, thickness, deflection : ndarray, shape (nx,)
        Position along entrainment [m], pressure [Pa], film thickness [m], and the gap opened by the
        pressure [m] up to a rigid displacement.
    density : ndarray, shape (nx,)
        Density over that at zero pressure, dimensionless.
    cavitated : ndarray of bool, shape (nx,)
        Where the pressure is held at ambient; includes the two end nodes.
    reynolds_residual : ndarray, shape (nx,)
        d(rho H)/dX - d/dX(eps dP/dX) in units of P: zero in the full film, not negative where it
        cavitates.
    status : str
        "converged"; "stalled" (residual above the tolerance at the last step allowed); "diverged"; or
        "film collapsed": not converged, with gaps below a hundredth of the central film.
    residual, load_residual : float
        Largest scaled residual, and abs(integral P dX/(pi/2) - 1).
    newton_iterations : int
        On the finest grid. ``steps`` has those of all grids.
    discretisation_error : float or None
        Richardson's estimate, relative: the larger of that of the minimum and the central thickness.
    inlet_deficit : float
        Share of the reduced pressure that would be built up before the domain begins.
    """

    x: Array
    pressure: Array
    thickness: Array
    deflection: Array
    density: Array
    cavitated: Mask
    reynolds_residual: Array
    scales: Scales
    status: Status
    residual: float
    load_residual: float
    newton_iterations: int
    steps: tuple[NewtonStep, ...]
    discretisation_error: float | None
    inlet_deficit: float

    @property
    def converged(self) -> bool:
        """Whether the residual is below the tolerance."""
        return self.status == "converged"

    @property
    def minimum_thickness(self) -> float:
        """Film thickness of the lowest node [m]."""
        return float(np.min(self.thickness))

    @property
    def minimum_position(self) -> float:
        """Position of the lowest node [m]."""
        return float(self.x[np.argmin(self.thickness)])

    @property
    def central_thickness(self) -> float:
        """Film thickness at x = 0, interpolated [m]."""
        return float(np.interp(0.0, self.x, self.thickness))

    @property
    def mean_thickness(self) -> float:
        """Mean film thickness over the Hertz zone, by the trapezoidal rule [m]."""
        b = self.scales.length
        inside = np.abs(self.x) < b
        x = np.concatenate([[-b], self.x[inside], [b]])
        return float(np.trapezoid(np.interp(x, self.x, self.thickness), x) / (2.0 * b))

    @property
    def max_pressure(self) -> float:
        """Largest pressure of a node [Pa]."""
        return float(np.max(self.pressure))

    @property
    def collapsed_positions(self) -> Array:
        """Where a film that was not found has gaps below a hundredth of the central one [m]."""
        if self.status != "film collapsed":
            return np.empty(0)
        return self.x[self.thickness < COLLAPSED * self.central_thickness]

    @property
    def cavitates(self) -> bool:
        """Whether the film cavitates before the domain ends, behind its minimum and its largest pressure.

        Not only at its end: waves of a rough surface refill pockets of a cavitated outlet.
        """
        behind = max(int(np.argmin(self.thickness)), int(np.argmax(self.pressure)))
        return bool(np.any(self.cavitated[behind:-1]))


def solve_film(problem: FilmProblem, *, progress: Progress | None = None) -> Film:
    """Solve the Reynolds, film and load equations of a line contact.

    Parameters
    ----------
    problem : FilmProblem
        The contact, dimensionless.
    progress : callable, optional
        Called with (nodes, Newton step, residual) before every Newton step.

    Returns
    -------
    Film
        Whatever was reached, with its status: nothing is raised where it is not a solution.

    Notes
    -----
    Eqs. (1) to (13) of Morris et al. (2022), doi:10.3390/lubricants10050087, and the complementarity
    condition for cavitation that they leave out. The nested iteration is that of full multigrid: every
    grid starts from the solution on the next coarser.

    Examples
    --------
    >>> import numpy as np
    >>> incompressible = lambda p: (np.ones_like(p), np.zeros_like(p))
    >>> isoviscous = lambda p: (np.zeros_like(p), np.zeros_like(p))
    >>> fluid = Fluid(incompressible, isoviscous, velocity_parameter=0.01, ambient_pressure=0.0)
    >>> solve_film(FilmProblem(fluid, 401, -4.0, 2.0, thickness_guess=0.1)).status
    'converged'
    """
    with quiet_solution():
        solutions = nested_iteration(problem, progress)
        return Film(**found(problem, solutions, lambda values: values[:, 0]))


@contextmanager
def quiet_solution() -> Iterator[None]:
    """Context of a solution: one BLAS thread, and no word about numbers an iterate leaves on its way."""
    with one_blas_thread(), np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        yield


def found(
    problem: FilmProblem, solutions: list[GridSolution], shaped: Callable[[NDArray[Any]], NDArray[Any]]
) -> dict[str, Any]:
    """What every film has, of the finest grid, in SI units.

    ``shaped`` gives nodal values (nx, ny) the shape they have in the film.
    """
    finest, scales = solutions[-1], problem.scales
    coarser = next((g for g in reversed(solutions) if g.level.nodes < problem.nodes), None)
    if any(g.status == "converged" and g.level.nodes == problem.nodes for g in solutions[:-1]):
        # The way led over other films on this grid: the coarser one is not of the same surfaces.
        coarser = None
    state, final, level = finest.state, finest.final, finest.level
    steps = tuple(step for solution in solutions for step in solution.steps)
    mass = final.coefficients.density * state.thickness
    return {
        "x": scales.length * level.mesh.x,
        "pressure": shaped(pressure_of(scales, state, final.free)),
        "thickness": shaped(scales.thickness * state.thickness),
        "deflection": shaped(scales.thickness * level.deflection(state.pressure)),
        "density": shaped(final.coefficients.density),
        "cavitated": shaped(~final.free),
        "reynolds_residual": shaped(final.scaled),
        "scales": scales,
        "status": film_status(finest.status, level.mesh, state.thickness),
        "residual": final.norm,
        "load_residual": abs(final.load) / level.load,
        "newton_iterations": sum(step.nodes == problem.nodes for step in steps),
        "steps": steps,
        "discretisation_error": _discretisation_error(problem, finest, coarser),
        "inlet_deficit": inlet_deficit(problem.fluid, problem.geometry, level.mesh, state.pressure, mass),
    }


def pressure_of(scales: Scales, state: State, free: Mask) -> Array:
    """Pressure of a state [Pa], shape (nx, ny): ambient where it is held, and nowhere below."""
    pressure = np.maximum(scales.pressure * state.pressure, scales.ambient_pressure)
    return np.where(free, pressure, scales.ambient_pressure)


def film_status(status: Status, mesh: Mesh, thickness: Array) -> Status:
    """Status, told apart where a film that was not found has a place without one; thickness (nx, ny)."""
    if status != "converged" and float(np.min(thickness)) < COLLAPSED * at_centre(mesh, thickness):
        return "film collapsed"
    return status


def richardson(fine: tuple[Mesh, Array], coarse: tuple[Mesh, Array], *, order: int) -> float:
    """Richardson's estimate of the discretisation error of a film.

    Parameters
    ----------
    fine, coarse : pair of Mesh and ndarray
        Nodes and film thickness (nx, ny) on two grids over one domain, in any unit.
    order : int
        Of the discretisation.

    Returns
    -------
    float
        The larger relative error of the minimum and the central thickness.

    Notes
    -----
    The minimum lies at the constriction, where the pressure gradient jumps: with a scheme of second order it
    converges with observed orders from 1.25 up, and is taken to do so with the least of them.

    Examples
    --------
    >>> import numpy as np
    >>> fine, coarse = Mesh.over(5, -1.0, 1.0), Mesh.over(3, -1.0, 1.0)
    >>> round(richardson((fine, np.full((5, 1), 1.01)), (coarse, np.full((3, 1), 1.02)), order=1) * 1.01, 3)
    0.01
    """
    gains = (coarse[0].dx / fine[0].dx) ** np.array([min(order, MINIMUM_ORDER), order]) - 1.0
    on_fine, on_coarse = (np.array([np.min(h), at_centre(mesh, h)]) for mesh, h in (fine, coarse))
    return float(np.max(np.abs(on_fine - on_coarse) / (gains * on_fine)))


def _discretisation_error(
    problem: FilmProblem, fine: GridSolution, coarse: GridSolution | None
) -> float | None:
    if coarse is None or fine.status != "converged" or coarse.status != "converged":
        return None
    of_fine, of_coarse = ((g.level.mesh, g.state.thickness) for g in (fine, coarse))
    return richardson(of_fine, of_coarse, order=problem.order)


def inlet_deficit(fluid: Fluid, geometry: Geometry, mesh: Mesh, pressure: Array, mass: Array) -> float:
    """Share of the reduced pressure that would be built up before the domain begins.

    On the line Y = 0, of pressure P and mass rho H (nx, ny), dimensionless. The Reynolds equation integrated
    once, dP/dX = eta lambda (rho H - q)/(rho H^3) with the flow q, builds up the reduced pressure, the
    integral of dP/eta. Before the inlet P is about ambient and H about a parabola. Where oil also flows off
    to the sides, between H = X^2/2 + (Rx/Ry) Y^2/2, the pressure is that of a line contact over
    1 + (2/3) Rx/Ry (P. Kapitza, Zh. Tekh. Fiz. 25 (1955) 747).
    """
    if not (np.all(np.isfinite(pressure)) and np.all(mass > 0.0)):
        return 0.0
    middle = int(np.argmin(np.abs(mesh.y)))
    x, pressure, mass = mesh.x, pressure[:, middle], mass[:, middle]
    flow = float(mass[np.argmax(pressure)])
    fluidity = np.exp(-fluid.log_viscosity(np.maximum(pressure, fluid.ambient_pressure))[0])
    increments = 0.5 * (fluidity[1:] + fluidity[:-1]) * np.diff(pressure)
    inside = float(np.max(np.cumsum(increments)))
    # With X = inlet/t, 0 < t < 1, the integrand is smooth, about t^2.
    points, weights = np.polynomial.legendre.leggauss(40)
    t = 0.5 * (points + 1.0)
    gap = float(mass[0]) + 0.5 * float(x[0]) ** 2 * (1.0 / t**2 - 1.0)
    gradient = fluid.velocity_parameter * (gap - flow) / gap**3
    before = float(np.sum(0.5 * weights * gradient * abs(float(x[0])) / t**2))
    before /= 1.0 + 2.0 * geometry.radius_ratio / 3.0
    return before / (before + inside) if before > 0.0 else 0.0
