"""The lubricant film of a loaded contact in SI units, with its status and its error estimate."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ehlectric.arrays import Array, Mask
from ehlectric.film.estimates import discretisation_error, inlet_deficit
from ehlectric.film.mesh import Mesh, at_centre
from ehlectric.film.nested import nested_iteration
from ehlectric.film.problem import FilmProblem, Scales
from ehlectric.film.state import GridSolution, NewtonStep, Progress, State, Status
from ehlectric.runtime.threads import one_blas_thread

# Part of the central film below which a gap that was not solved for is no film.
COLLAPSED = 1e-2


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
    >>> from ehlectric.film.flow import Fluid
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
        "pressure": shaped(pressure_of(scales, state, final.full_film)),
        "thickness": shaped(scales.thickness * state.thickness),
        "deflection": shaped(scales.thickness * level.deflection(state.pressure)),
        "density": shaped(final.coefficients.density),
        "cavitated": shaped(~final.full_film),
        "reynolds_residual": shaped(final.scaled),
        "scales": scales,
        "status": film_status(finest.status, level.mesh, state.thickness),
        "residual": final.norm,
        "load_residual": abs(final.load) / level.load,
        "newton_iterations": sum(step.nodes == problem.nodes for step in steps),
        "steps": steps,
        "discretisation_error": discretisation_error(problem, finest, coarser),
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
