"""Film solution in SI units, shared by line and point contacts: nodal values, status and residuals."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ehlectric.arrays import Array, Mask
from ehlectric.film.accuracy.adaptive import coarser_solutions
from ehlectric.film.accuracy.max_pressure import max_pressure_error
from ehlectric.film.accuracy.rough_film import rough_film_error
from ehlectric.film.estimates import inlet_deficit
from ehlectric.film.mesh import Mesh
from ehlectric.film.problem import FilmProblem, Scales
from ehlectric.film.state import GridSolution, NewtonStep, State, Status, film_touches
from ehlectric.runtime.threads import one_blas_thread
from ehlectric.runtime.values import Values


@dataclass(frozen=True, eq=False, repr=False)
class FilmSolution(Values):
    """Lubricant film of a line or a point contact in SI units, with its status and residuals.

    Nodal values have the shape (nx,) in a line contact and (nx, ny) in a point contact.

    Attributes
    ----------
    x : ndarray, shape (nx,)
        Positions of the nodes along entrainment [m].
    pressure, thickness : ndarray
        Pressure [Pa] and film thickness [m].
    deflection : ndarray
        Elastic deflection [m], by which the pressure opens the gap. In a line contact it is known up to a
        constant.
    density : ndarray
        Density over the density at zero pressure, dimensionless.
    cavitated : ndarray of bool
        Nodes at ambient pressure: those where the film is cavitated, and those on the edges of the domain.
    scales : Scales
        Length b [m], pressure p_h [Pa] and thickness b^2/R [m] that made the problem dimensionless.
    status : str
        Outcome of the iteration. "converged": the residual is below the tolerance. "stalled": it is still
        above the tolerance after the largest number of steps. "diverged": the iteration ended at an invalid
        iterate. "film collapsed": the film did not converge and is thinner somewhere than 1 % of its central
        thickness.
    load_residual : float
        abs(load carried/load applied - 1), dimensionless.
    reynolds_residual : ndarray or None
        Residual of the Reynolds equation, scaled to a pressure over p_h. It is zero in the full film and not
        negative where the film is cavitated. None for an instant of a transient film.
    residual : float or None
        Largest scaled residual of all equations, a pressure over p_h. None for an instant of a transient
        film.
    newton_iterations : int or None
        Number of Newton steps on the finest grid. None for an instant of a transient film.
    steps : tuple of NewtonStep
        Newton steps on all grids, in their order.
    discretisation_error : float or None
        Estimate of the relative error of the minimum or the central film thickness, whichever is larger. None
        if there is no estimate.
    inlet_deficit : float or None
        Share of the reduced pressure that is missing because it would build up upstream of the domain. None
        for an instant of a transient film.
    max_pressure_error : float or None
        Estimate of the relative error of the maximum pressure; above about 0.3 the grid does not resolve the
        highest peak of the pressure. None if there is no estimate.
    """

    x: Array
    pressure: Array
    thickness: Array
    deflection: Array
    density: Array
    cavitated: Mask
    scales: Scales
    status: Status
    load_residual: float
    reynolds_residual: Array | None = None
    residual: float | None = None
    newton_iterations: int | None = None
    steps: tuple[NewtonStep, ...] = ()
    discretisation_error: float | None = None
    inlet_deficit: float | None = None
    max_pressure_error: float | None = None

    @property
    def converged(self) -> bool:
        """Whether the residual is below the tolerance."""
        return self.status == "converged"

    @property
    def minimum_thickness(self) -> float:
        """Smallest film thickness at the nodes [m]."""
        return float(np.min(self.thickness))

    @property
    def max_pressure(self) -> float:
        """Largest pressure at the nodes [Pa]."""
        return float(np.max(self.pressure))


@contextmanager
def quiet_solution() -> Iterator[None]:
    """Context manager for a solution: one BLAS thread, and no floating-point warnings.

    The warnings are off because intermediate iterates may overflow.
    """
    with one_blas_thread(), np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        yield


# Function that brings nodal values (nx, ny) into their shape in the film: (nx,), or a whole map.
Shaped = Callable[[NDArray[Any]], NDArray[Any]]


def stationary_film(problem: FilmProblem, solutions: list[GridSolution], shaped: Shaped) -> FilmSolution:
    """Stationary film in SI units from the dimensionless solutions on all grids.

    Parameters
    ----------
    problem : FilmProblem
        Dimensionless problem of the contact.
    solutions : list of GridSolution
        Solutions that ``nested_iteration`` returns; the last is that on the finest grid.
    shaped : callable
        Function that brings nodal values (nx, ny) into their shape in the film.

    Returns
    -------
    FilmSolution
        Film on the finest grid, with residuals, Newton steps and error estimates.
    """
    finest, scales = solutions[-1], problem.scales
    state, final, level = finest.state, finest.final, finest.level
    steps = tuple(step for solution in solutions for step in solution.steps)
    mass = final.coefficients.density * state.thickness
    coarser = coarser_solutions(problem, solutions)
    return FilmSolution(
        x=scales.length * level.mesh.x,
        pressure=shaped(pressure_of(scales, state, final.full_film)),
        thickness=shaped(scales.thickness * state.thickness),
        deflection=shaped(scales.thickness * level.deflection(state.pressure)),
        density=shaped(final.coefficients.density),
        cavitated=shaped(~final.full_film),
        scales=scales,
        status=film_status(finest.status, level.mesh, state.thickness),
        load_residual=abs(final.load) / level.load,
        reynolds_residual=shaped(final.scaled),
        residual=final.norm,
        newton_iterations=sum(step.nodes == problem.nodes for step in steps),
        steps=steps,
        discretisation_error=rough_film_error(problem, finest, coarser),
        inlet_deficit=inlet_deficit(problem.fluid, problem.geometry, level.mesh, state.pressure, mass),
        max_pressure_error=max_pressure_error(finest, coarser[0] if coarser else None),
    )


def pressure_of(scales: Scales, state: State, full_film: Mask) -> Array:
    """Pressure of a state [Pa], shape (nx, ny), nowhere below ambient.

    ``full_film`` marks the nodes with a full film; the pressure at all other nodes is ambient.
    """
    pressure = np.maximum(scales.pressure * state.pressure, scales.ambient_pressure)
    return np.where(full_film, pressure, scales.ambient_pressure)


def film_status(status: Status, mesh: Mesh, thickness: Array) -> Status:
    """Status of a film from the status of its iteration and its thickness (nx, ny) in any unit.

    It is "film collapsed" if the film did not converge and is thinner somewhere than 1 % of its central
    thickness. Otherwise it is the status of the iteration.
    """
    if status != "converged" and film_touches(mesh, thickness):
        return "film collapsed"
    return status
