"""Film solution in SI units, shared by line and point contacts: nodal values, status and residuals."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, get_args

import numpy as np
from numpy.typing import NDArray

from ehlectric.arrays import Array, Mask
from ehlectric.film.far_field import load_deficit, pressure_deficit
from ehlectric.film.film_errors import max_pressure_error, upstream_deficits
from ehlectric.film.film_solver import RefinedSolution, Starvation, StarvedSolution
from ehlectric.film.hot_oil import HeatedFilm
from ehlectric.film.mesh import Mesh, at_centre
from ehlectric.film.newton import COLLAPSED, GridSolution, NewtonStep, State, Status
from ehlectric.film.problem import Scales
from ehlectric.film.starved_solver import oil_fraction
from ehlectric.quantities.field_metadata import number, stored
from ehlectric.runtime.display import Values

# Long names of nodal values in files of results.
_DEFLECTION = "gap opened by the pressure, up to a rigid displacement"
_DENSITY = "density / density at zero pressure"
_CONTACT_PRESSURE = "part of the pressure that asperities carry"
_CAVITATED = "pressure held at ambient"
_FRACTION = "part of the gap that oil fills"
_REYNOLDS_RESIDUAL = "residual of the Reynolds equation in units of p/p_h"


@dataclass(frozen=True, eq=False, repr=False)
class FilmSolution(Values):
    """Lubricant film of a line or a point contact in SI units, with its status and residuals.

    Nodal values have the shape (nx,) in a line contact and (nx, ny) in a point contact.
    """

    # Positions of the nodes along entrainment [m], shape (nx,).
    x: Array = field(metadata=stored("x", "m", "increasing", "position along entrainment"))
    # pressure and thickness: pressure [Pa] and film thickness [m].
    pressure: Array = field(metadata=stored("nodes", "Pa", "not negative", "pressure"))
    thickness: Array = field(metadata=stored("nodes", "m", "positive", "film thickness"))
    # Elastic deflection [m], by which the pressure opens the gap. In a line contact it is known up to a
    # constant.
    deflection: Array = field(metadata=stored("nodes", "m", "finite", _DEFLECTION))
    # Density over the density at zero pressure, dimensionless.
    density: Array = field(metadata=stored("nodes", "1", "positive", _DENSITY))
    # Nodes at ambient pressure: those where the film is cavitated, and those on the edges of the domain.
    cavitated: Mask = field(metadata=stored("nodes", "1", "0 or 1", _CAVITATED, dtype="i1"))
    # Length b [m], pressure p_h [Pa] and thickness b^2/R [m] that made the problem dimensionless.
    scales: Scales
    status: Status = field(metadata=number(get_args(Status)))
    # abs(load carried/load applied - 1), dimensionless.
    load_residual: float = field(metadata=number("finite"))
    # Part of the pressure [Pa] that asperities carry where the surfaces touch, zero elsewhere. None where the
    # surfaces do not touch.
    contact_pressure: Array | None = field(
        default=None, metadata=stored("nodes", "Pa", "finite", _CONTACT_PRESSURE, needed=False)
    )
    # Residual of the Reynolds equation, scaled to a pressure over p_h. It is zero in the full film and not
    # negative where the film is cavitated. None for an instant of a transient film.
    reynolds_residual: Array | None = field(
        default=None, metadata=stored("nodes", "1", "finite", _REYNOLDS_RESIDUAL)
    )
    # Largest scaled residual of all equations, a pressure over p_h. None for an instant of a transient film.
    residual: float | None = field(default=None, metadata=number("not negative"))
    # Number of Newton steps on the finest grid. None for an instant of a transient film.
    newton_iterations: int | None = field(default=None, metadata=number("whole"))
    steps: tuple[NewtonStep, ...] = ()
    # Estimate of the relative error of the minimum or the central film thickness, whichever is larger. None
    # if there is no estimate.
    discretisation_error: float | None = field(default=None, metadata=number())
    # Share of the reduced pressure that is missing because it would build up upstream of the domain. None for
    # an instant of a transient film.
    inlet_deficit: float | None = field(default=None, metadata=number())
    # Share of the load that is missing as oil would carry it outside of the domain; with the oil around the
    # domain of a point contact, what is not known of its load. None of starved films.
    load_deficit: float | None = field(default=None, metadata=number())
    # Estimate of the relative error of the maximum pressure; above about 0.3 the grid does not resolve the
    # highest peak of the pressure. None if there is no estimate.
    max_pressure_error: float | None = field(default=None, metadata=number())
    # Part of the gap that oil fills, 0 to 1. None of a flooded film that does not form again behind a cavity.
    film_fraction: Array | None = field(
        default=None, metadata=stored("nodes", "1", "0 to 1", _FRACTION, needed=False)
    )
    # Largest amount of oil that appears or is lost up to any position along entrainment, divided by the mean
    # flow through the Hertz zone. None of a film without mass-conserving cavitation.
    mass_residual: float | None = field(default=None, metadata=number())
    # Supply of oil, meniscus and flooded film. None where the supply of oil is not given.
    starvation: Starvation | None = None
    # Temperature, shear stress, traction and power loss; None of an isothermal Newtonian film.
    heated: HeatedFilm | None = None

    @property
    def temperature(self) -> Array | None:
        """Temperature at mid-film [K] at the nodes; None of an isothermal film."""
        return None if self.heated is None else self.heated.mid_temperature

    @property
    def converged(self) -> bool:
        """Whether the residual is below the tolerance."""
        return self.status == "converged"

    @property
    def contact(self) -> Mask:
        """Nodes where the surfaces touch, as a mask of the shape of the film."""
        if self.contact_pressure is None:
            return np.zeros(self.thickness.shape, dtype=bool)
        return self.contact_pressure > 0.0

    @property
    def minimum_thickness(self) -> float:
        """Smallest film thickness at the nodes [m]."""
        return float(np.min(self.thickness))

    @property
    def max_pressure(self) -> float:
        """Largest pressure at the nodes [Pa]."""
        return float(np.max(self.pressure))


# Function that brings nodal values (nx, ny) into their shape in the film: (nx,), or a whole map.
Shaped = Callable[[NDArray[Any]], NDArray[Any]]


def stationary_film(refined: RefinedSolution, shaped: Shaped) -> FilmSolution:
    """Stationary film in SI units from the dimensionless solutions on all grids. Returns film on the finest
    grid, with residuals, Newton steps and error estimates.
    """
    finest, scales, coarser = refined.last, refined.problem.scales, refined.coarser
    steps = tuple(step for solution in refined.solutions for step in solution.steps)
    inlet, load = _deficits(refined)
    x, values = _nodal(refined, shaped)
    touching, fraction = values.pop("contact_pressure"), values.pop("film_fraction", None)
    return FilmSolution(
        x=scales.length * x,
        **values,
        contact_pressure=touching if finest.touches else None,
        scales=scales,
        status=film_status(finest.status, finest.level.mesh, finest.state.thickness),
        load_residual=abs(finest.final.load) / finest.level.load,
        residual=finest.final.norm,
        newton_iterations=sum(
            len(each.steps) for each in refined.solutions if each.level.mesh.dx == finest.level.mesh.dx
        ),
        steps=steps,
        discretisation_error=refined.error,
        inlet_deficit=inlet,
        load_deficit=load,
        max_pressure_error=max_pressure_error(finest, coarser[0] if coarser else None),
        film_fraction=fraction,
        mass_residual=None if refined.fraction is None else mass_residual(refined),
        starvation=refined.starvation if isinstance(refined, StarvedSolution) else None,
    )


def _deficits(refined: RefinedSolution) -> tuple[float, float | None]:
    """Shares of pressure and load that the domain cuts off; the load of a starved film is not known."""
    if isinstance(refined, StarvedSolution):
        return refined.inlet_deficit, None
    problem, level, state = refined.whole_problem, refined.whole.level, refined.whole.state
    mass = refined.whole.final.coefficients.density * state.thickness
    upstream, load = upstream_deficits(problem.fluid, problem.geometry, level.mesh, state.pressure, mass)
    if problem.width is None:
        return upstream, load
    return pressure_deficit(problem, upstream), load_deficit(problem)


def mass_residual(refined: RefinedSolution) -> float:
    """Oil that a film makes or loses up to any position along entrainment, over the flow of its Hertz zone.

    The residual of the Reynolds equation is the oil that leaves a node in excess of what enters it.
    """
    last, mesh = refined.last, refined.last.level.mesh
    zone = refined.problem.geometry.dry_pressure(mesh.x, mesh.y) > 0.0
    mass = last.final.coefficients.density * last.state.thickness
    width = float(np.max(np.sum(np.broadcast_to(zone, mesh.shape) * mesh.weights, axis=1))) / mesh.dx
    made = np.where(last.final.full_film, last.final.reynolds, 0.0) * mesh.weights
    flows = np.cumsum(np.sum(made, axis=1))
    return float(np.max(np.abs(flows)) / (np.mean(mass[np.broadcast_to(zone, mesh.shape)]) * width))


def _nodal(refined: RefinedSolution, shaped: Shaped) -> tuple[Array, dict[str, Any]]:
    """Positions X along entrainment, and nodal values of the film by the names of its attributes."""
    scales, finest, patch = refined.problem.scales, refined.last, refined.patch
    if patch is None:
        values = _values(scales, finest, 0.0)
        if refined.fraction is not None:
            values["film_fraction"] = refined.fraction
        return finest.level.mesh.x, {name: shaped(each) for name, each in values.items()}
    mesh = finest.level.mesh
    joined = patch.join(mesh)
    outer = patch.outer_deflection(patch.times(mesh))(mesh.x, mesh.y)
    fine = _values(scales, finest, outer)
    coarse = _values(scales, patch.coarse, 0.0)
    if refined.fraction is not None:
        coarse["film_fraction"] = oil_fraction(patch.coarse, refined.problem.wedge_order)
        fine["film_fraction"] = refined.fraction
    added = patch.problem.added_gap
    if added is None:
        return joined.x, {name: joined(coarse[name], fine[name]) for name in fine}
    least = min(float(np.min(values["thickness"])) for values in (coarse, fine))
    # The film without roughness is smooth enough to be interpolated between the coarse nodes.
    for values, on in ((coarse, patch.coarse.level.mesh), (fine, mesh)):
        values["thickness"] = values["thickness"] - scales.thickness * added(on.x, on.y)
    nodal = {name: joined(coarse[name], fine[name]) for name in fine}
    nodal["thickness"] += scales.thickness * added(joined.x, joined.y)
    # Roughness between the coarse nodes makes no gap that neither grid has.
    nodal["thickness"] = np.maximum(nodal["thickness"], least)
    return joined.x, nodal


def _values(scales: Scales, solution: GridSolution, outer: Array | float) -> dict[str, NDArray[Any]]:
    """Nodal values of a solution (nx, ny) by their names; ``outer`` is the deflection from outside."""
    state, final = solution.state, solution.final
    return {
        "pressure": pressure_of(scales, state, final.full_film),
        "thickness": scales.thickness * state.thickness,
        "deflection": scales.thickness * (solution.level.deflection(state.pressure) + outer),
        "density": final.coefficients.density,
        "cavitated": ~final.full_film & ~state.touching,
        "contact_pressure": scales.pressure * np.broadcast_to(state.contact_pressure, state.pressure.shape),
        "reynolds_residual": final.scaled,
    }


def pressure_of(scales: Scales, state: State, full_film: Mask) -> Array:
    """Pressure of a state [Pa], shape (nx, ny), nowhere below ambient.

    ``full_film`` marks the nodes with a full film; where there is none and the surfaces do not touch, the
    pressure is ambient.
    """
    pressure = np.maximum(scales.pressure * state.pressure, scales.ambient_pressure)
    return np.where(full_film | state.touching, pressure, scales.ambient_pressure)


def film_status(status: Status, mesh: Mesh, thickness: Array) -> Status:
    """Status of a film from the status of its iteration and its thickness (nx, ny) in any unit.

    It is "film collapsed" if the film did not converge and is thinner somewhere than 1 % of its central
    thickness. Otherwise it is the status of the iteration.
    """
    collapsed = float(np.min(thickness)) < COLLAPSED * at_centre(mesh, thickness)
    return "film collapsed" if collapsed and status != "converged" else status
