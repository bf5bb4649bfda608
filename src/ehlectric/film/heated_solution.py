"""Film of a contact with heat and shear thinning, and its isothermal Newtonian film on the same grids.

Both films are solved over the whole domain. The grid of a point contact is then refined on a patch, as in
``film.film_solver``. On the patch the film has the temperature of the finest grid over the whole domain: the
temperature varies over longer distances than the film, and its error is stated next to it.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ehlectric.arrays import Array
from ehlectric.film.across_film import Across
from ehlectric.film.energy_equation import FrozenTemperature, energy_imbalance
from ehlectric.film.film_errors import key_thicknesses
from ehlectric.film.film_solver import (
    RefinedSolution,
    StarvedSolution,
    film_method,
    finer_problem,
    starved_on_grids,
    starved_solution,
)
from ehlectric.film.heated_film import (
    CARRYING,
    MOST_LOOPS,
    HeatedGrid,
    OuterIteration,
    changed_heat,
    finer_heat,
    heated_on_grids,
    iteration_on,
    rise_error,
    start_of,
)
from ehlectric.film.hot_oil import HeatedFilm, Physics
from ehlectric.film.nested import (
    NESTED_TOLERANCE,
    changed_state,
    filled_on,
    grid_problem,
    levels_of,
    nested_iteration,
)
from ehlectric.film.newton import GridSolution, Guess, Progress, Status
from ehlectric.film.oil_content import Carried, Supply
from ehlectric.film.patch import part_of_domain
from ehlectric.film.problem import FilmProblem
from ehlectric.film.shear_flow import Traction, traction
from ehlectric.film.starved_solver import FIRST_DAMPING, Solver, StarvedProblem, isothermal, with_inlet
from ehlectric.runtime.threads import quiet_solution

# Part of its heat that a film may make or lose by its grid. If it is more, film and temperature do not
# belong together, even if both no longer change.
_MOST_IMBALANCE = 0.1

# Newton steps on a grid after which no further guess is tried for a starved film, on the finest grid and on
# coarser ones, whose film is only a guess: 900 steps take about a minute on 65 x 65 nodes.
_MOST_STEPS, _MOST_STEPS_OF_GUESS = 900, 300

# The same number of a film that has a single guess.
_SINGLE = 0

# Smallest number of nodes along x of a grid whose spots are near the spots of the next finer grid.
_LEAST_OF_SPOTS = 65

# Largest number of nodes for a film with shear or heat at a known temperature, and for one with its own
# temperature: each takes about a minute on one core.
_MOST_FROZEN, _MOST_WHOLE = 150_000.0, 40_000.0


@dataclass(frozen=True)
class HeatedRefinement(RefinedSolution):
    """Film with heat on its last grid, a patch whose temperature belongs to a coarser grid."""

    # Relative change of the film by the temperature of the next coarser grid.
    of_temperature: float = 0.0

    @cached_property
    def error(self) -> float | None:
        """Relative discretisation error of the film on its patch, with its temperature; None if unknown."""
        error = RefinedSolution(self.problem, self.solutions, self.patch).error
        return None if error is None else error + self.of_temperature


@dataclass(frozen=True, eq=False)
class HeatedNodes:
    """Nodal values of heat and shear on one grid."""

    # Temperature [K] at the nodes across the film; None for an isothermal film, shape (nz, nx, ny).
    temperature: Array | None
    mid_temperature: Array | None  # temperature at mid-film [K], shape (nx, ny)
    shear_stress: Array  # shear stress along x at mid-film [Pa], shape (nx, ny)


@dataclass(frozen=True, eq=False)
class HeatedSolution(HeatedNodes):
    """Film with heat or shear thinning, and the film without both, with nodal values on the last grid."""

    refined: RefinedSolution  # film with heat and shear thinning on all of its grids
    simple: RefinedSolution  # isothermal Newtonian film on all of its grids
    # Nodal values over the whole domain where the last grid is a patch; None where it is the whole domain.
    outside: HeatedNodes | None
    zeta: Array  # positions z/h of the nodes across the film, shape (nz,)
    # max_temperature_rise and temperature_rise_error: largest rise of the mid-film temperature above the
    # temperature of the oil that enters [K], and the estimate of its error (``rise_error``).
    max_temperature_rise: float | None
    temperature_rise_error: float | None
    traction_coefficient: float
    rolling_coefficient: float
    power_loss: float  # friction power, [W/m] in a line and [W] in a point contact
    # Heat of the film that the bodies and the oil do not take up, over all heat.
    energy_imbalance: float | None
    outer_iterations: int  # number of outer loops on all grids
    status: Status  # "converged", "stalled" or "diverged"


def solve_heated_film(problem: FilmProblem, progress: Progress | None = None) -> HeatedSolution:
    """Solve the film with the physics of its problem, and the isothermal Newtonian film. Returns both films,
    the temperature, and the friction.

    Both films have the grid on which their discretisation error is below the ``target_error`` of the problem,
    or the finest one that heat or shear may have. A Newtonian oil without heat has one film. In a point
    contact, the lines along x do not heat one another through the bodies, so that a body with a Peclet number
    below about five gets too hot.
    """
    assert problem.physics is not None
    with quiet_solution():
        if problem.physics.plain:
            cold = replace(problem, physics=None)
            simple = film_method(cold)(cold, progress)
            return _solution(simple, _with_shear(simple, problem.physics))
        return _solution(*heated_solution(problem, progress, order=3))


def _with_shear(simple: RefinedSolution, physics: Physics) -> RefinedSolution:
    """Isothermal Newtonian film with the iteration that gives the shear of its last grids."""

    def sheared(grid: GridSolution, problem: FilmProblem) -> HeatedGrid:
        iteration = iteration_on(replace(problem, physics=physics), finer=0, progress=None)
        law = iteration.flow(grid.state, None)
        return HeatedGrid(**vars(grid), iteration=iteration, heat=None, law=law)

    last, patch = sheared(simple.last, simple.problem), simple.patch
    refined = replace(simple, solutions=[*simple.solutions[:-1], last])
    if patch is not None:
        coarse = sheared(patch.coarse, patch.problem)
        return replace(refined, patch=replace(patch, coarse=coarse))
    if isinstance(refined, StarvedSolution) and refined.flooded is simple.last:
        return replace(refined, flooded=last)
    return refined


def heated_solution(
    problem: FilmProblem, progress: Progress | None, *, order: int
) -> tuple[RefinedSolution, RefinedSolution]:
    """Isothermal Newtonian film of a problem, and its film with heat or shear on the same grids.

    The film is flooded first, and then has its supply of oil. If the supply is a layer, the flooded film is
    only a guess, and may be missed. ``order`` is the order of the wedge term.
    """
    if _layer_on_spots(problem) and (quick := _from_coarser_grid(problem, progress, order)):
        return quick
    cold = replace(problem, physics=None, most_nodes=_most_nodes(problem))
    simple = film_method(cold)(cold, progress)
    finest = _on(simple.problem if simple.patch is None else problem, simple.whole, problem, order)
    starts = simple.solutions if simple.patch is None else [simple.whole]
    if isinstance(simple, StarvedSolution) and simple.flooded is not None:
        starts = [simple.flooded]
    layered = problem.supply is not None and problem.supply.layer is not None
    if problem.supply is not None and problem.width is not None:
        # The first grid has the temperature, also if a flooded film is refined on a patch.
        while finest.nodes > problem.nodes:
            finest = finest.halved()
    grids = heated_on_grids(finest, starts, progress, careful=False, every=layered)
    if not (layered or all(grid.status == "converged" for grid in grids)):
        # Very hot films take more grids and more exact loops.
        grids = heated_on_grids(finest, starts, progress, careful=True)
    if isinstance(simple, StarvedSolution):
        return _starved(simple, finest, grids, progress)
    if simple.patch is None or grids[-1].status != "converged":
        return _until(simple, simple.whole), RefinedSolution(finest, list(grids))
    return _refined_together(simple, finest, grids, progress)


def _layer_on_spots(problem: FilmProblem) -> bool:
    """Whether rough surfaces of a hot point contact with a layer of oil may touch on its only grid, and on
    the next coarser one.
    """
    hot = problem.physics is not None and problem.physics.thermal is not None
    layered = problem.supply is not None and problem.supply.layer is not None
    rough = problem.added_gap is not None and problem.boundary_film > 0.0
    fine = problem.nodes >= 2 * _LEAST_OF_SPOTS - 1 and problem.target_error is None
    return hot and layered and rough and problem.width is not None and fine


def _from_coarser_grid(
    problem: FilmProblem, progress: Progress | None, order: int
) -> tuple[RefinedSolution, RefinedSolution] | None:
    """Starved film without and with heat whose surfaces touch, from both films on the next coarser grid.

    On the finest grid the film with heat comes first, and the film without heat starts from it: without
    another film on this grid it takes longer than the film with heat. None if the surfaces do not touch on
    the coarser grid, or if a film with heat is missed.
    """
    supply, cold = problem.supply, replace(problem, physics=None)
    assert supply is not None and supply.layer is not None
    half = replace(cold.halved(), tolerance=max(problem.tolerance, NESTED_TOLERANCE), on_grid=None)
    simple = starved_solution(half, progress)
    if simple.flooded is None or not (simple.last.status == "converged" and simple.last.touches):
        return None
    finest, starts = replace(problem, wedge_order=order), [simple.flooded]
    *coarser, flooded = heated_on_grids(finest, starts, progress, careful=False, every=True, quick=True)
    refined = starved_on_grids(_with_supplies(coarser, simple), supply)
    warm, mass = refined.last, problem.fluid.ambient_density * supply.layer(flooded.level.mesh.y)
    if not (
        isinstance(warm, HeatedGrid) and warm.status == flooded.status == "converged" and refined.starved
    ):
        return None
    guess = _changed(flooded, coarser[-1], warm, mass)
    last = replace(_with_supply(flooded, guess), most_steps=_SINGLE)
    refined = starved_on_grids([last], supply, refined.solutions, refined.layer)
    hot = refined.last
    if hot.status != "converged" or hot.content is None or not refined.starved:
        return None
    simple = _isothermal_from(hot, cold, simple, flooded, progress)
    problem.tell(simple.last.level.mesh, simple.error)
    return simple, refined


def _isothermal_from(
    hot: GridSolution,
    cold: FilmProblem,
    coarse: StarvedSolution,
    flooded: GridSolution,
    progress: Progress | None,
) -> StarvedSolution:
    """Starved film without heat, the solution of ``cold``, from the film with heat on the same grid.

    ``coarse`` contains the films without heat on the coarser grids, and ``flooded`` is a flooded film on this
    grid.
    """
    content, supply = hot.content, cold.supply
    assert content is not None
    assert supply is not None
    posed = grid_problem(cold, levels_of(cold), progress, times=CARRYING)
    # The temperature is far from the temperature of the guess.
    solver = isothermal(posed, full_order=False, first_damping=FIRST_DAMPING)
    # The film without heat is a comparison: a scheme that converges more often is close enough.
    schemes = (content.supply.scheme.simpler, content.supply.scheme)
    for scheme in (each for each in schemes if each is not None):
        known = replace(hot, content=replace(content, supply=replace(content.supply, scheme=scheme)))
        last = StarvedProblem(cold, posed, flooded, solver, known=known, near_only=True, most_steps=_SINGLE)
        simple = starved_on_grids([last], supply, coarse.solutions, coarse.layer)
        if simple.last.status == "converged":
            break
    return simple


def _changed(fine: HeatedGrid, before: HeatedGrid, after: HeatedGrid, mass: Array) -> HeatedGrid:
    """Guess on a grid: a film, changed as another film differs from it on the next coarser grid.

    ``fine`` and ``before`` are one film on both grids; ``after`` is a starved film on the coarser one, and
    ``mass`` (ny,) the mass of its layer of oil on the finer one.
    """
    assert after.content is not None
    mesh, coarse, problem = fine.level.mesh, after.level.mesh, fine.iteration.problem
    first, last = (filled_on(mesh, coarse, with_inlet(film.final.full_film)) for film in (before, after))
    filled = np.where(first == last, with_inlet(fine.final.full_film), last)
    supply = Supply(mass, problem.wedge_order, scheme=after.content.supply.scheme)
    state = changed_state(fine, before, after, problem.boundary_film)
    guess = replace(fine, state=state, content=Carried(supply, filled))
    assert fine.heat is not None and before.heat is not None and after.heat is not None
    return replace(guess, heat=changed_heat(fine.heat, before.heat, after.heat, (before.level, fine.level)))


def is_too_fine(problem: FilmProblem, times: int) -> bool:
    """Whether a grid with the spacings of a problem divided by ``times`` takes minutes for heat or shear.

    Grids of line contacts never do. Grids of films that their shear does not change never do either.
    """
    width, physics = problem.width, problem.physics
    if width is None or physics is None or physics.plain or times == 1:
        return False
    nodes = times**2 * (problem.nodes - 1) * (width.y.size - 1)
    if problem.supply is not None:
        return nodes > _MOST_FROZEN
    part = part_of_domain(problem, problem.thickness_guess)
    return part * nodes > (_MOST_FROZEN if part < 1.0 else _MOST_WHOLE)


def _most_nodes(problem: FilmProblem) -> int:
    """Most nodes along x, over the whole domain, of the grids of a film with heat or shear."""
    times = 1
    while times * (problem.nodes - 1) < problem.most_nodes and not is_too_fine(problem, 2 * times):
        times *= 2
    return min(problem.most_nodes, times * (problem.nodes - 1) + 1)


def _until(simple: RefinedSolution, last: GridSolution) -> RefinedSolution:
    """Film whose last grid has the spacing of another one, and not a smaller one."""
    patch, dx = simple.patch, last.level.mesh.dx
    if patch is None:
        return simple
    kept = [each for each in simple.solutions if each.level.mesh.dx > 0.9 * dx]
    times = patch.times(last.level.mesh)
    if times == 1:
        return RefinedSolution(patch.problem, kept)
    return RefinedSolution(patch.refined(times), kept, patch)


def _refined_together(
    simple: RefinedSolution, problem: FilmProblem, whole: list[HeatedGrid], progress: Progress | None
) -> tuple[RefinedSolution, RefinedSolution]:
    """Film without and with heat or shear on a patch, refined until the error of both is small enough.

    ``whole``, films with heat or shear on grids over the whole domain; ``problem``, problem of the last one.
    """
    assert simple.patch is not None
    grids, patch = list(whole), replace(simple.patch, problem=problem, coarse=whole[-1])
    frozen, of_temperature = _frozen(whole[-1]), _of_temperature(whole)
    refined, times = RefinedSolution(problem, list(whole)), 2
    while times <= simple.patch.times(simple.last.level.mesh):
        grid = _on_grid(patch.refined(times), grids, simple, frozen, progress)
        if grid.status != "converged":
            break
        grids.append(grid)
        refined = HeatedRefinement(patch.refined(times), list(grids), patch, of_temperature)
        times *= 2
        small = refined.error is not None and refined.error <= (problem.target_error or 0.0)
        if times > simple.patch.times(simple.last.level.mesh) and not small:
            if times * (problem.nodes - 1) + 1 > _most_nodes(problem):
                break
            posed, on = finer_problem(simple)
            finer = RefinedSolution(posed, nested_iteration(posed, progress, simple.solutions), on)
            if finer.last.status == "converged":
                simple = finer
    return _until(simple, refined.last), refined


def _on_grid(
    posed: FilmProblem,
    grids: list[HeatedGrid],
    simple: RefinedSolution,
    frozen: FrozenTemperature | None,
    progress: Progress | None,
) -> HeatedGrid:
    """Film with heat or shear on a finer grid, at the temperature of a coarser one.

    The initial guess is the film with heat on the next coarser grid, or else the film without heat.
    """
    iteration = replace(iteration_on(posed, finer=0, progress=progress), frozen=frozen)
    tried: list[HeatedGrid] = []
    for known in (grids, []):
        state, _, filled = start_of(iteration, simple.solutions, known)
        tried.append(iteration(state, None, spike=False, filled=filled))
        if tried[-1].status == "converged":
            return tried[-1]
    return tried[0]


def _frozen(grid: HeatedGrid) -> FrozenTemperature | None:
    """Temperature of a film for grids with smaller spacings; None of a film without heat."""
    profile = grid.iteration.flow(grid.state, grid.heat).profile
    return profile if isinstance(profile, FrozenTemperature) else None


def _of_temperature(grids: list[HeatedGrid]) -> float:
    """Relative change of the film on the last grid by the temperature of the next coarser one."""
    if len(grids) < 2 or grids[-2].status != "converged":
        return 0.0
    fine, frozen = grids[-1], _frozen(grids[-2])
    if frozen is None:
        return 0.0
    other = replace(fine.iteration, frozen=frozen)(fine.state, None, spike=False, filled=fine.filled)
    if other.status != "converged":
        return 0.0
    films = [key_thicknesses(grid.level.mesh, grid.state.thickness) for grid in (fine, other)]
    return float(np.max(np.abs(films[1] / films[0] - 1.0)))


def _starved(
    simple: StarvedSolution, problem: FilmProblem, hot_grids: list[HeatedGrid], progress: Progress | None
) -> tuple[RefinedSolution, StarvedSolution]:
    """Starved film without and with heat or shear, on the grids of the film without.

    ``hot_grids``, flooded films with heat or shear on all grids up to the grid of the ``problem``. On finer
    grids the films keep their temperatures.
    """
    assert problem.supply is not None
    refined = starved_on_grids(_with_supplies(hot_grids, simple), problem.supply)
    warm, flooded = refined.last, list(hot_grids)
    while problem.nodes < simple.problem.nodes:
        finer = None
        if isinstance(warm, HeatedGrid) and refined.last.status == "converged":
            posed = problem.doubled()
            flooded.append(_on_grid(posed, flooded, simple, _frozen(hot_grids[-1]), progress))
            starved = _with_supplies(flooded[-1:], simple, _frozen(warm))
            finer = starved_on_grids(starved, problem.supply, refined.solutions, refined.layer)
        if finer is None or finer.last.status != "converged":
            # The last grid with both films counts.
            coarser = replace(problem, physics=None, target_error=None)
            return film_method(coarser)(coarser, progress), refined
        problem, refined = posed, finer
    return simple, refined


def _with_supplies(
    flooded: list[HeatedGrid], simple: StarvedSolution, frozen: FrozenTemperature | None = None
) -> list[StarvedProblem]:
    """Starved films with heat to be solved on the grids of flooded films, see ``_with_supply``.

    ``simple`` contains the starved films without heat.
    """
    cold = {film.level.mesh.shape: film for film in simple.solutions}
    return [_with_supply(grid, cold.get(grid.level.mesh.shape), frozen) for grid in flooded]


def _with_supply(
    flooded: HeatedGrid, cold: GridSolution | None, frozen: FrozenTemperature | None = None
) -> StarvedProblem:
    """Starved film with heat to be solved on the grid of a flooded film. ``cold`` is the starved film without
    heat on this grid: guesses that are further away may take minutes to fail. ``frozen`` is the temperature
    of a coarser grid that the film keeps.
    """
    iteration = replace(flooded.iteration, most_loops=MOST_LOOPS, frozen=frozen)
    hot = iteration.physics.thermal is not None
    return StarvedProblem(
        iteration.problem,
        iteration.posed,
        flooded,
        _solver(iteration),
        known=cold,
        near_only=True,
        most_steps=_MOST_STEPS if iteration.finer == 0 else _MOST_STEPS_OF_GUESS,
        careful=_solver(replace(iteration, careful=True)) if hot and frozen is None else None,
    )


def _solver(iteration: OuterIteration) -> Solver:
    """Solver of starved films with heat on the grid of an iteration."""

    def film(guess: Guess, supply: Supply) -> HeatedGrid:
        before, heat = guess.of, None
        # A film without heat has the temperature of the oil that enters, and its pressure belongs to it.
        if isinstance(before, HeatedGrid) and before.status == "converged" and before.heat is not None:
            heat = finer_heat(before.heat, before.level, iteration.level)
        return replace(iteration, supply=supply)(guess.state, heat, spike=False, filled=guess.filled)

    return film


def _on(posed: FilmProblem, whole: GridSolution, problem: FilmProblem, order: int) -> FilmProblem:
    """Problem with heat on the grid of the isothermal film over the whole domain."""
    mesh, width = whole.level.mesh, posed.width
    if width is not None:
        across = mesh.whole_y.size if mesh.symmetric else mesh.y.size
        width = replace(width, nodes=across)
    return replace(posed, nodes=mesh.x.size, width=width, physics=problem.physics, wedge_order=order)


def _solution(simple: RefinedSolution, refined: RefinedSolution) -> HeatedSolution:
    """Results of the film on its finest grid, and outside of it where this is a patch."""
    hot_grids = [grid for grid in refined.solutions if isinstance(grid, HeatedGrid)]
    last, whole = hot_grids[-1], refined.whole
    assert isinstance(whole, HeatedGrid)
    problem, physics = last.iteration.problem, last.iteration.physics
    patch, scales = refined.patch, problem.scales
    inside, friction = _nodes_and_friction(last, whole.level.load, 1.0)
    outside = None
    if patch is not None:
        outside, further = _nodes_and_friction(whole, whole.level.load, patch.outside(0.5))
        friction += further
    load = scales.pressure * scales.length ** (1 if problem.width is None else 2) * whole.level.load
    status, imbalance, error = last.status, None, None
    warm = [grid for grid in hot_grids if grid.iteration.frozen is None]
    heat, iteration = warm[-1].heat, warm[-1].iteration
    if heat is not None and physics.thermal is not None:
        stream = iteration.stream(warm[-1], heat, warm[-1].law)
        imbalance = energy_imbalance(stream, heat, physics.thermal.inlet_temperature)
        if status == "converged" and imbalance > _MOST_IMBALANCE:
            status = "stalled"
        error = rise_error(warm)
        if error is not None and last.largest_rise is not None and warm[-1].largest_rise is not None:
            error += abs(last.largest_rise - warm[-1].largest_rise)
    return HeatedSolution(
        **vars(inside),
        refined=refined,
        simple=simple,
        outside=outside,
        zeta=Across.of(last.iteration.degree).zeta,
        max_temperature_rise=last.largest_rise,
        temperature_rise_error=error,
        traction_coefficient=friction.sliding,
        rolling_coefficient=friction.rolling,
        power_loss=friction.power_loss(
            load,
            entrainment_speed=physics.mean_speed,
            slide_to_roll_ratio=physics.slide_to_roll_ratio,
        ),
        energy_imbalance=imbalance,
        outer_iterations=sum(grid.loops for grid in hot_grids),
        status=status,
    )


def _nodes_and_friction(grid: HeatedGrid, load: float, part: Array | float) -> tuple[HeatedNodes, Traction]:
    """Nodal values of heat and shear on a grid, and the traction over a ``part`` of its nodes (nx, ny).

    ``load`` is the dimensionless load of the whole contact.
    """
    iteration, state = grid.iteration, grid.state
    columns = iteration.columns(grid, grid.law)
    # Friction coefficients of asperities stand for the oil where these carry the load.
    sheared = iteration.filled(grid) * state.oil_share
    friction = traction(
        columns,
        state.thickness,
        iteration.level.mesh,
        load=load,
        stress_ratio=iteration.stress_scale / iteration.problem.scales.pressure,
        filled=sheared,
        part=part,
    )
    return HeatedNodes(
        temperature=None if grid.heat is None else grid.heat.temperature,
        mid_temperature=grid.middle,
        shear_stress=iteration.stress_scale * columns.middle[0] * sheared,
    ), friction


def heated_result(
    solution: HeatedSolution,
    shaped: Callable[[NDArray[Any]], NDArray[Any]],
    *,
    status: Status,
    minimum_thickness: float | None,
    central_thickness: float | None,
) -> HeatedFilm:
    """Heat and shear of a solution, at the nodes of the whole domain. ``minimum_thickness`` and
    ``central_thickness``, film thicknesses without heat and shear [m]; None if the film without them did not
    converge. Returns nodal values and totals, SI units.
    """
    last, patch = solution.refined.last, solution.refined.patch
    assert isinstance(last, HeatedGrid)
    physics, outside = last.iteration.physics, solution.outside
    joined = None if patch is None else patch.join(last.level.mesh)

    def whole(inside: Array, coarse: Array | None) -> Array:
        return shaped(inside) if joined is None or coarse is None else joined(coarse, inside)

    stress = whole(solution.shear_stress, None if outside is None else outside.shear_stress)
    middle = None if outside is None else outside.mid_temperature
    converged = status == "converged"
    rows, bodies = solution.temperature, () if physics.thermal is None else physics.thermal.bodies
    coarse = [None] * len(rows if rows is not None else ())
    if outside is not None and outside.temperature is not None:
        coarse = list(outside.temperature)
    # Equal surfaces drag none of each other. The iteration leaves a stress of its tolerance.
    alike = physics.slide_to_roll_ratio == 0.0 and len(set(bodies)) <= 1
    return HeatedFilm(
        rheology=physics.rheology.name,
        # A slide-to-roll ratio is positive where surface 1 is the faster one.
        shear_stress=-stress,
        traction_coefficient=(0.0 if alike else -solution.traction_coefficient) if converged else None,
        rolling_coefficient=solution.rolling_coefficient if converged else None,
        power_loss=solution.power_loss if converged else None,
        isothermal_minimum_thickness=minimum_thickness,
        isothermal_central_thickness=central_thickness,
        outer_iterations=solution.outer_iterations,
        zeta=None if rows is None else solution.zeta,
        temperature=None
        if rows is None
        else np.stack([whole(*row) for row in zip(rows, coarse, strict=True)]),
        mid_temperature=None if solution.mid_temperature is None else whole(solution.mid_temperature, middle),
        max_temperature_rise=solution.max_temperature_rise,
        temperature_rise_error=solution.temperature_rise_error,
        energy_imbalance=solution.energy_imbalance,
        unsettled=None if last.unsettled is None else (last.unsettled.change, *last.unsettled.place),
    )
