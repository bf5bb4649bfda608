"""Film of any contact in SI units: its nodal values, its status, and how it was obtained."""

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
from ehlectric.film.problem import FilmProblem, Scales
from ehlectric.film.state import GridSolution, NewtonStep, State, Status
from ehlectric.runtime.threads import one_blas_thread

# Gaps below this part of the central film thickness, in a film that did not converge, count as collapsed.
COLLAPSED = 1e-2


@dataclass(frozen=True)
class FilmSolution:
    """Film in SI units with how it was obtained: the part that line and point contacts share.

    Nodal values have the shape (nx,) in a line contact and (nx, ny) in a point contact.

    Attributes
    ----------
    x : ndarray, shape (nx,)
        Position along entrainment [m].
    pressure, thickness, deflection : ndarray
        Pressure [Pa], film thickness [m], and the gap opened by the pressure [m] up to a rigid displacement.
    density : ndarray
        Density over that at zero pressure, dimensionless.
    cavitated : ndarray of bool
        Where the pressure is held at ambient; includes the nodes at the edges of the domain.
    scales : Scales
        Length b [m], pressure p_h [Pa] and thickness b^2/R [m] that made the problem dimensionless.
    status : str
        "converged"; "stalled" (residual above the tolerance at the last step allowed); "diverged"; or
        "film collapsed": not converged, with gaps below a hundredth of the central film.
    load_residual : float
        abs(load carried/load applied - 1), dimensionless.
    reynolds_residual : ndarray or None
        d(rho H)/dX - d/dX(eps dP/dX) in units of P: zero in the full film, not negative where it cavitates.
        None for an instant of a transient film.
    residual : float or None
        Largest scaled residual. None for an instant of a transient film.
    newton_iterations : int or None
        On the finest grid; ``steps`` has those of all grids. None for an instant of a transient film.
    steps : tuple of NewtonStep
        History of the iteration on all grids.
    discretisation_error : float or None
        Richardson's estimate, relative: the larger of that of the minimum and the central thickness.
        None where there is no estimate.
    inlet_deficit : float or None
        Share of the reduced pressure that would be built up before the domain begins. None for an instant of
        a transient film.
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

    @property
    def converged(self) -> bool:
        """Whether the residual is below the tolerance."""
        return self.status == "converged"

    @property
    def minimum_thickness(self) -> float:
        """Film thickness of the lowest node [m]."""
        return float(np.min(self.thickness))

    @property
    def max_pressure(self) -> float:
        """Largest pressure of a node [Pa]."""
        return float(np.max(self.pressure))


@contextmanager
def quiet_solution() -> Iterator[None]:
    """Context of a solution: one BLAS thread, and no floating-point warnings, as iterates may overflow."""
    with one_blas_thread(), np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        yield


# Nodal values (nx, ny) in the shape that they have in a film.
Shaped = Callable[[NDArray[Any]], NDArray[Any]]


def stationary_film(problem: FilmProblem, solutions: list[GridSolution], shaped: Shaped) -> FilmSolution:
    """Stationary film of the finest grid in SI units.

    Parameters
    ----------
    problem : FilmProblem
        The contact, dimensionless.
    solutions : list of GridSolution
        From the coarsest grid to the finest, as ``nested_iteration`` gives them.
    shaped : callable
        Nodal values (nx, ny) in the shape that they have in the film.

    Returns
    -------
    FilmSolution
        With its residuals, its history and its error estimates.
    """
    finest, scales = solutions[-1], problem.scales
    state, final, level = finest.state, finest.final, finest.level
    steps = tuple(step for solution in solutions for step in solution.steps)
    mass = final.coefficients.density * state.thickness
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
        discretisation_error=discretisation_error(problem, finest, _comparable(problem, solutions)),
        inlet_deficit=inlet_deficit(problem.fluid, problem.geometry, level.mesh, state.pressure, mass),
    )


def _comparable(problem: FilmProblem, solutions: list[GridSolution]) -> GridSolution | None:
    """Solution on the next coarser grid, where it is of the same surfaces and so gives an error estimate."""
    if any(g.status == "converged" and g.level.nodes == problem.nodes for g in solutions[:-1]):
        # The roughness was raised in steps on the finest grid; the coarser film belongs to other surfaces.
        return None
    return next((g for g in reversed(solutions) if g.level.nodes < problem.nodes), None)


def pressure_of(scales: Scales, state: State, free: Mask) -> Array:
    """Pressure of a state [Pa], shape (nx, ny): ambient where it is held, and nowhere below."""
    pressure = np.maximum(scales.pressure * state.pressure, scales.ambient_pressure)
    return np.where(free, pressure, scales.ambient_pressure)


def film_status(status: Status, mesh: Mesh, thickness: Array) -> Status:
    """Status of a film of thickness (nx, ny) [any unit].

    "film collapsed" where an unconverged film is somewhere thinner than a hundredth of its central thickness,
    otherwise the status of its iteration.
    """
    if status != "converged" and float(np.min(thickness)) < COLLAPSED * at_centre(mesh, thickness):
        return "film collapsed"
    return status
