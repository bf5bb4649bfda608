"""Flooded and starved films on grids that are refined until the estimate of the error is small enough."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from ehlectric.arrays import Array, Mask
from ehlectric.film.far_field import side_deficit
from ehlectric.film.film_errors import (
    LEAST_UNSEEN,
    UNSEEN,
    expected_error,
    richardson,
    rough_film_error,
    upstream_deficits,
)
from ehlectric.film.mesh import Mesh, at_centre
from ehlectric.film.nested import filled_on, grid_problem, levels_of, nested_iteration, open_state
from ehlectric.film.newton import EarlyEnd, GridSolution, Guess, Progress
from ehlectric.film.patch import Patch
from ehlectric.film.problem import FilmProblem, OilSupply
from ehlectric.film.starved_solver import (
    StarvedProblem,
    at_centre_line,
    film_of_ratio,
    forms_again,
    isothermal,
    taken_layer,
)
from ehlectric.quantities.field_metadata import number

# Number of successive grids without an error estimate after which refinement stops. Each grid takes several
# times as long as the grid before.
UNKNOWN = 3

# Residual at which the film of a smooth point contact ends if it is only a start on the next grid; the
# largest residual divided by the target of the error; and the smallest relative excess of its error over the
# target. A residual of 1e-4 leaves an error of 5e-4 at most (validation/error_estimates.md).
_EARLY_TOLERANCE, _EARLY_PART, _CLEAR = 1e-4, 1e-2, 0.05


@dataclass(frozen=True)
class RefinedSolution:
    """Solution of a film on its last grid, which may be a patch of a coarser grid over the whole domain."""

    problem: FilmProblem
    solutions: list[GridSolution]  # solutions on all grids, as ``nested_iteration`` returns them
    patch: Patch | None = None  # patch that the last grid covers; None if it covers the whole domain

    @property
    def last(self) -> GridSolution:
        """Solution on the last grid."""
        return self.solutions[-1]

    @property
    def whole(self) -> GridSolution:
        """Solution on the last grid over the whole domain."""
        return self.last if self.patch is None else self.patch.coarse

    @property
    def whole_problem(self) -> FilmProblem:
        """Problem over the whole domain; the problem of a patch uses the domain and the load of the patch."""
        return self.problem if self.patch is None else self.patch.problem

    @property
    def fraction(self) -> Array | None:
        """Part of the gap that oil fills on the last grid, shape (nx, ny); None if it is not carried."""
        return self.last.fraction

    @cached_property
    def error(self) -> float | None:
        """Relative discretisation error, estimated from the last grids; None if unknown.

        A grid that is far too coarse has a film of its own, of which successive grids differ little. The
        estimate is then at least 0.5.
        """
        error = rough_film_error(self.problem, self.last, self.coarser)
        times = 1 if self.patch is None else self.patch.times(self.last.level.mesh)
        expected = expected_error(self.whole_problem, times)
        if error is not None and expected is not None and expected > UNSEEN:
            return max(error, LEAST_UNSEEN)
        return error

    @property
    def makes_oil(self) -> bool:
        """Whether the last film converged with cavities that count as full, and forms again behind one."""
        last = self.last
        counted_full = last.status == "converged" and last.content is None
        return counted_full and self.problem.added_gap is not None and forms_again(last.final.full_film)

    @cached_property
    def coarser(self) -> list[GridSolution]:
        """Last solutions on the coarser grids for the same surfaces, from the finest on."""
        if any(g.status == "converged" and _alike(g, self.last) for g in self.solutions[:-1]):
            # The roughness was raised in steps on the finest grid, so the film of the coarser grid belongs to
            # other surfaces.
            return []
        coarser = [self.last]
        for solution in reversed(self.solutions):
            if solution.level.mesh.dx > 1.1 * coarser[-1].level.mesh.dx:
                coarser.append(solution)
        return coarser[1:]


def refined_solution(problem: FilmProblem, progress: Progress | None) -> RefinedSolution:
    """Solve the film, and refine its grid until the discretisation error is below the target of the problem.

    The spacings are halved along both axes, in a point contact only on a patch where its film is decided.
    The refinement ends below the target, where surfaces touch, at ``most_nodes`` over the whole domain,
    after three grids in succession whose error is unknown because a film did not converge, or before the
    first grid on which no film conserves its oil.
    """
    target, unknown, times = problem.target_error, 0, 1
    ends = _early_end(problem, None, unknown) if 2 * problem.nodes - 1 <= problem.most_nodes else None
    refined = RefinedSolution(problem, nested_iteration(problem, progress, early_end=ends))
    while target is not None:
        error, times = refined.error, 2 * times
        problem.tell(refined.last.level.mesh, error)
        unknown = unknown + 1 if error is None else 0
        if (error is not None and error <= target) or unknown >= UNKNOWN:
            break
        if times * (problem.nodes - 1) + 1 > problem.most_nodes:
            break
        # A finer grid has other spots of a rough contact. A smooth one may touch on a coarse grid only.
        if refined.last.touches and problem.added_gap is not None:
            break
        posed, patch = finer_problem(refined)
        last = 2 * times * (problem.nodes - 1) + 1 > problem.most_nodes
        ends = None if last else _early_end(posed, patch, unknown)
        finer = RefinedSolution(posed, nested_iteration(posed, progress, refined.solutions, ends), patch)
        # A finer film that makes oil is worse than one that conserves it on fewer nodes.
        if finer.makes_oil and not refined.makes_oil:
            break
        refined = finer
    return refined


def _early_end(problem: FilmProblem, patch: Patch | None, unknown: int) -> EarlyEnd | None:
    """Rule by which the film of a smooth point contact on a grid is only a start on the next grid: its error
    is above the target. None for other contacts, without a target, and for the first order, whose error
    estimate takes two more films.

    The error is unknown on the last ``unknown`` grids. More nodes must be allowed.
    """
    target = problem.target_error
    smooth_point = problem.width is not None and problem.added_gap is None
    if target is None or not smooth_point or problem.wedge_order == 1:
        return None

    def is_followed(solutions: list[GridSolution]) -> bool:
        film = solutions[-1]
        # A film that seems to form again behind a cavity may not do so once it is accurate.
        if film.level.nodes < problem.nodes or forms_again(film.final.full_film):
            return False
        error = RefinedSolution(problem, solutions, patch).error
        return if_unknown if error is None else error > (1.0 + _CLEAR) * target

    if_unknown = unknown + 1 < UNKNOWN
    return EarlyEnd(min(_EARLY_TOLERANCE, _EARLY_PART * target), is_followed, if_unknown)


def finer_problem(refined: RefinedSolution) -> tuple[FilmProblem, Patch | None]:
    """Problem with half of the spacings of a solution, on a patch where there is one."""
    patch = refined.patch
    if patch is None and refined.error is not None:
        patch = Patch.around(refined.problem, refined.last)
    if patch is None:
        return refined.problem.doubled(), None
    return patch.refined(2 * patch.times(refined.last.level.mesh)), patch


def _alike(solution: GridSolution, other: GridSolution) -> bool:
    """Whether two solutions have the same grid."""
    return (
        solution.level.mesh.shape == other.level.mesh.shape and solution.level.mesh.dx == other.level.mesh.dx
    )


# Largest number of times that the grid of a point contact is refined, over the whole domain.
_MOST_REFINED_POINT = 2

# Multiple of the largest number of Newton steps of a flooded film: where the meniscus moves upstream, it does
# so by few nodes in each step.
_MORE = 3

# Relative excess of the flow of a flooded film over its supply that is rounding.
_ROUNDING = 1e-9


@dataclass(frozen=True)
class Starvation:
    """Supply of oil of a solved film, and its flooded film, SI units."""

    # Thickness of the layer of oil on both surfaces together, on the line y = 0 [m]. None for the flooded
    # film of a point contact that was asked for by its ratio of 1: the least layer that floods it depends on
    # the domain.
    oil_layer: float | None = field(metadata=number())
    # Central film thickness divided by the central thickness of the flooded film; None if the flooded film
    # did not converge.
    film_ratio: float | None = field(metadata=number())
    # Position of the first node on the line y = 0 that oil fills [m]; None if the film is flooded, or if oil
    # fills the gap at the inlet edge on this line.
    meniscus: float | None = field(metadata=number())
    # flooded_minimum_thickness and flooded_central_thickness: minimum and central film thickness of the
    # flooded film on the same grid [m]; None if it did not converge.
    flooded_minimum_thickness: float | None = field(metadata=number())
    flooded_central_thickness: float | None = field(metadata=number())
    # flooded_inlet_deficit and flooded_side_deficit: shares of the reduced pressure of the flooded film that
    # are missing because the domain is too small. None if the film did not converge; a line contact has none
    # at its sides.
    flooded_inlet_deficit: float | None = field(default=None, metadata=number())
    flooded_side_deficit: float | None = field(default=None, metadata=number())


@dataclass(frozen=True)
class StarvedSolution(RefinedSolution):
    """Starved film on its last grid, with those on the coarser ones and the flooded film."""

    flooded: GridSolution | None = None
    # Thickness H of the layer of oil at the lines of the last grid; None where it is not known, shape (ny,).
    layer: Array | None = None

    @cached_property
    def error(self) -> float | None:
        """Relative discretisation error, estimated from the last grids; None if unknown.

        The position of the meniscus is known to a node, which in a point contact changes the film.
        """
        order = self.problem.wedge_order
        if not self.starved:
            return rough_film_error(self.problem, self.last, self.coarser)
        error = rough_film_error(replace(self.problem, wedge_order=max(2, order)), self.last, self.coarser)
        if error is None or (self.problem.width is None and order > 1):
            return error
        films = [(grid.level.mesh, grid.state.thickness) for grid in (self.last, self.coarser[0])]
        return max(error, richardson(films[0], films[1], order=1))

    @property
    def starved(self) -> bool:
        """Whether the flooded film needs more oil than there is."""
        return self.last is not self.flooded

    @property
    def fraction(self) -> Array | None:
        """Part of the gap that oil fills, shape (nx, ny); None for a flooded film."""
        return self.last.fraction if self.starved else None

    @property
    def by_ratio(self) -> bool:
        """Whether the film is asked for as a part of the flooded one, which it depends on."""
        return self.problem.supply is not None and self.problem.supply.film_ratio is not None

    @property
    def inlet_deficit(self) -> float:
        """Share of the reduced pressure missing upstream: of the flooded film if it sets the film.

        No pressure builds up upstream of a meniscus.
        """
        if not self.by_ratio and self._meniscus is not None:
            return 0.0
        return self._inlet_deficit(self._decisive)

    @property
    def side_deficit(self) -> float:
        """Share of the reduced pressure missing at the sides: of the flooded film if it sets the film.

        No pressure is cut off if no node next to the sides of the domain is filled.
        """
        filled = self._filled
        if not self.by_ratio and filled is not None and not np.any(filled[:, -2]):
            return 0.0
        return self._side_deficit(self._decisive)

    @property
    def starvation(self) -> Starvation:
        """Supply of oil and flooded film in SI units."""
        assert self.flooded is not None
        scales, mesh, flooded = self.problem.scales, self.last.level.mesh, self.flooded
        layer = None if self.layer is None else scales.thickness * at_centre_line(self.last.level, self.layer)
        meniscus = None if self._meniscus is None else scales.length * self._meniscus
        if flooded.status != "converged":
            return Starvation(layer, None, meniscus, None, None)
        thickness = flooded.state.thickness
        return Starvation(
            oil_layer=layer,
            film_ratio=at_centre(mesh, self.last.state.thickness) / at_centre(mesh, thickness),
            meniscus=meniscus,
            flooded_minimum_thickness=scales.thickness * float(np.min(thickness)),
            flooded_central_thickness=scales.thickness * at_centre(mesh, thickness),
            flooded_inlet_deficit=self._inlet_deficit(flooded),
            flooded_side_deficit=None if self.problem.width is None else self._side_deficit(flooded),
        )

    @property
    def _meniscus(self) -> float | None:
        """Position X of the meniscus on the line Y = 0."""
        filled = self._filled
        return None if filled is None else meniscus_of(self.last.level.mesh, filled)

    @property
    def _filled(self) -> Mask | None:
        """Nodes that oil fills in a starved film, shape (nx, ny); None for a flooded one."""
        content = self.last.content
        return content.filled if self.starved and content is not None else None

    @property
    def _decisive(self) -> GridSolution:
        """Film whose domain must be large enough."""
        return self.flooded if self.by_ratio and self.flooded is not None else self.last

    def _inlet_deficit(self, grid: GridSolution) -> float:
        mass = grid.final.coefficients.density * grid.state.thickness
        of = self.problem
        return upstream_deficits(of.fluid, of.geometry, grid.level.mesh, grid.state.pressure, mass)[0]

    def _side_deficit(self, grid: GridSolution) -> float:
        return side_deficit(self.problem, grid.level.mesh, grid.state.pressure, grid.state.thickness)


def meniscus_of(mesh: Mesh, filled: Mask) -> float | None:
    """Position X of the first node on the line Y = 0 that oil fills; None if that is on the inlet edge."""
    line = filled[:, int(np.argmin(np.abs(mesh.y)))]
    first = int(np.argmax(line))
    return float(mesh.x[first]) if first > 0 else None


def film_method(problem: FilmProblem) -> Callable[[FilmProblem, Progress | None], RefinedSolution]:
    """Function that solves the film of a problem, flooded or with a given supply of oil."""
    return refined_solution if problem.supply is None else starved_solution


def starved_solution(problem: FilmProblem, progress: Progress | None) -> StarvedSolution:
    """Solve the film of a problem with a supply of oil, and refine its grid until the error is below the
    target.

    The flooded film is solved on each grid first. The grid is refined over the whole domain, the grid of a
    point contact at most twice.
    """
    supply = problem.supply
    assert supply is not None
    flooded = nested_iteration(problem, progress)
    starved = starved_on_grids(_isothermal_grids(problem, flooded, 0, progress), supply)
    target, doubled, unknown = problem.target_error, 0, 0
    problem.tell(starved.last.level.mesh, starved.error)
    while target is not None and (starved.error is None or starved.error > target):
        doubled, unknown = doubled + 1, unknown + 1 if starved.error is None else 0
        if unknown >= UNKNOWN:
            break
        if problem.width is not None and doubled > _MOST_REFINED_POINT:
            break
        finer = problem.doubled()
        if finer.nodes > problem.most_nodes or starved.last.status != "converged":
            break
        problem, flooded = finer, nested_iteration(finer, progress, flooded)
        grids = _isothermal_grids(problem, flooded, starved.last.level.nodes, progress)
        starved = starved_on_grids(grids, supply, starved.solutions, starved.layer)
        problem.tell(starved.last.level.mesh, starved.error)
    return starved


def starved_on_grids(
    grids: Sequence[StarvedProblem],
    supply: OilSupply,
    known: Sequence[GridSolution] = (),
    layer: Array | None = None,
) -> StarvedSolution:
    """Starved film on grids that are finer than the grids of the known films, from the coarsest on.

    ``layer`` (ny,) is the layer of oil on the finest known grid.
    """
    solutions = list(known)
    for starved in grids:
        near, last = None, solutions[-1] if solutions else None
        if last is not None and last.status == "converged" and last.content is not None:
            filled = filled_on(starved.level.mesh, last.level.mesh, last.content.filled)
            near = Guess(open_state(starved.level, last), filled, last)
        layer, film = _layer_and_film(starved, supply, near, layer)
        solutions.append(starved.flooded if film is None else film)
    return StarvedSolution(grids[-1].problem, solutions, flooded=grids[-1].flooded, layer=layer)


def _isothermal_grids(
    problem: FilmProblem, flooded: list[GridSolution], coarsest: int, progress: Progress | None
) -> list[StarvedProblem]:
    """Starved films without heat on each grid with more nodes than ``coarsest``, from the coarsest on."""
    by_nodes, finest = {solution.level.nodes: solution for solution in flooded}, problem.nodes
    grids = []
    while problem.nodes in by_nodes and problem.nodes > coarsest:
        posed = grid_problem(
            problem, levels_of(problem), progress, finest=problem.nodes == finest, times=_MORE
        )
        grids.append(StarvedProblem(problem, posed, by_nodes[problem.nodes], isothermal(posed)))
        problem = problem.halved()
    return grids[::-1]


def _layer_and_film(
    starved: StarvedProblem, supply: OilSupply, near: Guess | None, last: Array | None
) -> tuple[Array | None, GridSolution | None]:
    """Layer of oil on a grid and its film; None where the flooded film needs no more oil than there is."""
    if supply.layer is None:
        assert supply.film_ratio is not None
        return film_of_ratio(starved, supply.film_ratio, near, last)
    layer = supply.layer(starved.level.mesh.y)
    return layer, None if is_flooded(starved, layer) else starved.solved(layer, near)


def is_flooded(starved: StarvedProblem, layer: Array) -> bool:
    """Whether the flooded film takes no more oil at any line than a layer (ny,) supplies."""
    if starved.flooded.status != "converged":
        return False
    enough = layer >= (1.0 - _ROUNDING) * taken_layer(starved)
    return bool(np.all(enough, where=starved.level.mesh.inner[1]))
