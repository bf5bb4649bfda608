"""Nested iteration for the film: the initial guess on every grid is the solution on the next coarser grid.

If the iteration does not converge from this guess, it starts again from the Hertz pressure. If it still does
not converge, or if the film is thinner somewhere than the boundary film, the surfaces touch, and
``film.touching_solver`` solves the film with the nodes where they do.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import lru_cache, partial
from typing import TYPE_CHECKING

import numpy as np

from ehlectric.arrays import Array, Mask
from ehlectric.film.deflection import Geometry
from ehlectric.film.dry_contact import relieved
from ehlectric.film.levels import Level, hierarchy
from ehlectric.film.mesh import Mesh, at_centre, on_mesh
from ehlectric.film.newton import EarlyEnd, GridProblem, GridSolution, Guess, Progress, State, newton
from ehlectric.film.oil_content import SCHEMES, USUAL
from ehlectric.film.problem import FilmProblem
from ehlectric.film.reynolds import wedge_stencil
from ehlectric.film.starved_solver import conserving_film, forms_again, with_inlet
from ehlectric.formulas.monotone_cubic import along_axis

if TYPE_CHECKING:
    from ehlectric.film.touching_solver import Conserving

# Tolerance of the residual on the coarser grids, far below their discretisation error.
NESTED_TOLERANCE = 1e-6

# The nested iteration starts on the coarsest grid with at least this many nodes along x, in a line and in a
# point contact. A quarter of the nodes would not resolve a thin film.
FIRST_GRID = 101
_FIRST_GRID_POINT = 33

# Largest number of nodes of a line contact whose linear systems are solved directly, without coarser grids:
# the factorisation then takes less time than the cycles.
DIRECT = 401

# Largest number of nodes of a smooth line contact whose grids are kept for the next contact, and number of
# such grids, which take about 10 MB at most.
_MOST_KEPT, _GRIDS_KEPT = 3201, 12

# Residual of the film of first order that a line and a point contact start from: the Newton steps below it
# change less than the order of the wedge term does.
_WARM_TOLERANCE, _WARM_TOLERANCE_POINT = 1e-2, 1e-3

# Multiple of the boundary film above which a smooth film that did not converge is not taken to be pierced.
_THICK = 10.0

# Multiple of the largest number of Newton steps of a film that conserves the mass of the oil in its cavities,
# whose ends move by few nodes in each step.
_CONSERVING = 3

# Multiple of the largest number of Newton steps from each start of a film whose surfaces may touch, on the
# finest grid and on the coarser ones.
_MIXED, _MIXED_COARSE = 6, 2

# Residual of a film whose surfaces may touch on the grids that enter no error estimate: its spots are not the
# spots of the next grid.
_START_TOLERANCE = 1e-3

# Multiple of the largest number of Newton steps of a smooth film from a coarser grid. The ridge of its
# pressure spike may take many steps to its place on the finer grid, and a restart takes more.
_FROM_COARSER = 2


def nested_iteration(
    problem: FilmProblem,
    progress: Progress | None,
    known: Sequence[GridSolution] = (),
    early_end: EarlyEnd | None = None,
) -> list[GridSolution]:
    """Solve the film on a sequence of grids, from coarse to fine. Returns all solutions in the order in which
    they were computed, after the known ones. Films of surfaces apart may end early by the rule ``early_end``.

    If the solution on a grid does not converge, this grid and the next finer grid start from the Hertz
    pressure. If the surfaces touch on a grid, the next finer grid starts from this film at once.
    """
    solutions = list(known)
    for levels in reversed(_grids(problem, solved=known[-1].level.nodes if known else 0)):
        coarse = solutions[-1] if solutions and solutions[-1].status == "converged" else None
        here = None if early_end is None else replace(early_end, coarser=tuple(solutions))
        grids = _full_film(problem, levels, coarse, progress, here)
        best = grids[-1] if grids else None
        solutions.extend(grids)
        if problem.boundary_film > 0.0 and (best is None or _is_pierced(problem, best)):
            solutions.extend(_mixed(problem, levels, coarse, best, progress))
    return solutions


def mixed_from_dry(problem: FilmProblem, levels: list[Level]) -> list[GridSolution]:
    """Solutions on the first of ``levels`` only, from the dry contact, the best one last."""
    return _mixed(problem, levels, None, None, None)


def _full_film(
    problem: FilmProblem,
    levels: list[Level],
    coarse: GridSolution | None,
    progress: Progress | None,
    early_end: EarlyEnd | None,
) -> list[GridSolution]:
    """Solutions on one grid with surfaces apart, the best one last.

    ``coarse`` is the converged solution on the next coarser grid, if there is one. There are none where the
    surfaces touch on this grid.
    """
    # Where rough surfaces may touch, a dry contact is a better start than the Hertz pressure.
    rough = problem.added_gap is not None and problem.boundary_film > 0.0
    grids: list[GridSolution] = []
    best = None
    if coarse is not None and not coarse.touches:
        state = open_state(levels[0], coarse)
        if coarse.fraction is not None:
            filled = filled_on(levels[0].mesh, coarse.level.mesh, with_inlet(coarse.final.full_film))
            conserved = _conserving(problem, levels, (state, filled), progress)
            if conserved.status == "converged" and forms_again(conserved.final.full_film):
                return [conserved]
            # A second converged solution on this grid would be taken for one of other surfaces.
            grids = [] if conserved.status == "converged" else [conserved]
        times = 1 if rough else _FROM_COARSER
        best = _newton_on(problem, levels, progress, spike=True, early_end=early_end, times=times)(state)
    # A solution that nearly converged does not start again.
    if coarse is None or (not rough and (best is None or _is_missed(best))):
        state = _hertz_state(problem, levels[0])
        for solve in _restarts(problem, levels, progress, early_end):
            grids.append(solve(state))
            if rough and grids[-1].status == "diverged" and len(grids) == 1:
                # The surfaces touch.
                return grids
            state = grids[-1].state if grids[-1].status == "converged" else state
        attempts = [grids.pop()] if best is None else [grids.pop(), best]
        *others, best = sorted(attempts, key=lambda solution: -solution.final.norm)
        grids.extend(others)
    return grids if best is None else _conserved(problem, levels, [*grids, best], progress)


def _conserved(
    problem: FilmProblem, levels: list[Level], grids: list[GridSolution], progress: Progress | None
) -> list[GridSolution]:
    """Solutions on one grid, the best one last, with a solution that conserves the mass of the oil in
    cavities if the last film forms again behind a cavity, or if a rough one did not converge.
    """
    best = grids[-1]
    missed = best.status != "converged" and problem.added_gap is not None
    if missed or (best.status == "converged" and forms_again(best.final.full_film)):
        start = best.state, best.final.full_film
        times = 1 if missed else _CONSERVING
        grids = _replaced(grids, _conserving(problem, levels, start, progress, times=times))
        if missed and grids[-1].status == "converged" and not forms_again(grids[-1].final.full_film):
            # Nothing forms again, so that the film of the other scheme is close.
            other = _newton_on(problem, levels, progress, spike=True)(grids[-1].state)
            grids = _replaced(grids, other)
    return grids


def _conserving(
    problem: FilmProblem,
    levels: list[Level],
    start: tuple[State, Mask],
    progress: Progress | None,
    times: int = _CONSERVING,
) -> GridSolution:
    """Solution on one grid that conserves the mass of the oil in cavities.

    ``times`` multiplies the largest number of Newton steps of a film.
    """
    posed = grid_problem(problem, levels, progress, times=times)
    return conserving_film(posed, start, problem.wedge_order)


def _is_pierced(problem: FilmProblem, solution: GridSolution) -> bool:
    """Whether the surfaces may touch: a film thinner than the boundary film, or one that has no solution.

    A smooth film that is still thick may only need more Newton steps.
    """
    thinnest = float(solution.state.thickness.min())
    if thinnest < problem.boundary_film:
        return True
    thick = problem.added_gap is None and solution.status == "stalled"
    return _is_missed(solution) and not (thick and thinnest > _THICK * problem.boundary_film)


def _is_missed(solution: GridSolution) -> bool:
    """Whether an iteration missed its tolerance by far."""
    return solution.status != "converged" and solution.final.norm > NESTED_TOLERANCE


def _mixed(
    problem: FilmProblem,
    levels: list[Level],
    coarse: GridSolution | None,
    full_film: GridSolution | None,
    progress: Progress | None,
) -> list[GridSolution]:
    """Solutions with surfaces that may touch, the best one last, from a converged solution first.

    The last one carries the oil through its cavities if it forms again behind one.
    """
    # late: surfaces that are apart do not need it
    from ehlectric.film.touching_solver import Conserving, guess_of, touching_films

    level, near = levels[0], None
    if full_film is not None and full_film.status == "converged":
        near = full_film.state
    elif coarse is not None:
        near = interpolated_state(level, coarse)
    finest = level.nodes == problem.nodes
    posed = grid_problem(problem, levels, progress, times=_MIXED if finest else _MIXED_COARSE)
    # A film whose surfaces touch needs all grids.
    posed = replace(posed, levels=levels)
    # The film of the grid with half the intervals enters the error estimate.
    if 2 * level.nodes < problem.nodes:
        posed = replace(posed, tolerance=_START_TOLERANCE, only_start=True)
    conserving = Conserving(posed, problem.wedge_order)
    grids: list[GridSolution] = []
    from_coarse = None
    if near is not None and near.touching.any() and coarse is not None and coarse.fraction is not None:
        filled = filled_on(level.mesh, coarse.level.mesh, with_inlet(coarse.final.full_film))
        from_coarse = Guess(near, filled)
        grids.extend(conserving.films([(from_coarse, USUAL)]))
        if grids[-1].status == "converged":
            return [*grids[:-1], _apart(problem, levels, grids[-1], progress)]
    dry = np.broadcast_to(problem.geometry.dry_pressure(level.mesh.x, level.mesh.y), level.mesh.shape)
    if not np.any(dry):
        # The dry contact lies between two nodes of this grid.
        return grids
    counted_full = touching_films(
        posed,
        dry,
        film_guess=problem.thickness_guess,
        near=near,
        thorough=finest,
    )
    grids.extend(sorted(counted_full, key=lambda solution: -solution.final.norm))
    full = grids[-1]
    if full.status != "converged" or not forms_again(full.final.full_film):
        return grids
    *others, best = _carrying(conserving, guess_of(full), from_coarse, finest=finest)
    if best.status == "converged":
        return _replaced([*others, *grids], _apart(problem, levels, best, progress))
    # A film that creates oil is better than none; a warning reports it.
    return [*others, best, *grids]


def _carrying(
    conserving: Conserving, counted_full: Guess, from_coarse: Guess | None, *, finest: bool
) -> list[GridSolution]:
    """Films that carry the oil through their cavities, the best one last, and only this one converged.

    ``counted_full`` is the film on the same grid that counts its cavities as full. If there is a film
    ``from_coarse``, the usual scheme did not converge from it. Films of simpler schemes are better starts
    then, and the usual scheme follows them. From ``counted_full`` it starts last.
    """
    if from_coarse is None:
        return conserving.films([(counted_full, scheme) for scheme in SCHEMES])
    starts = [counted_full, from_coarse] if finest else [counted_full]
    *others, best = conserving.films([(start, scheme) for start in starts for scheme in SCHEMES[1:]])
    content = best.content
    enough = content is not None and (conserving.problem.only_start or content.supply.scheme == USUAL)
    if best.status == "converged" and enough:
        return [*others, best]
    *_, usual = conserving.films([(counted_full, USUAL)])
    if usual.status == "converged":
        return [*others, replace(usual, steps=best.steps + usual.steps)]
    return [*others, usual, best]


def _apart(
    problem: FilmProblem, levels: list[Level], film: GridSolution, progress: Progress | None
) -> GridSolution:
    """Film with the equations of surfaces apart, if a film of surfaces that may touch has no contact.

    Where the gap closes steeply, the mass at a face differs between the two. The film of surfaces apart is
    more accurate, and any other start leads to it.
    """
    if film.touches:
        return film
    start = film.state, with_inlet(film.final.full_film)
    apart = _conserving(problem, levels, start, progress, times=1)
    if apart.status != "converged" or float(apart.state.thickness.min()) < problem.boundary_film:
        return film
    return replace(apart, steps=film.steps + apart.steps)


def _replaced(grids: list[GridSolution], better: GridSolution) -> list[GridSolution]:
    """Solutions on one grid with a better one that takes the place of the last one.

    Of two converged solutions on a grid the first would be taken for one of other surfaces.
    """
    if better.status != "converged" or grids[-1].status != "converged":
        return [*grids, better]
    return [*grids[:-1], replace(better, steps=grids[-1].steps + better.steps)]


def accurate_film(problem: FilmProblem, nodes: int, start: State) -> GridSolution:
    """Solution with the wedge term and the flow of the highest order, from a solution of first order. Returns
    last iterate on the grid with ``nodes`` nodes; its tolerance equals the tolerance of the coarser grids of
    the nested iteration.
    """
    fluid = problem.fluid
    # All laws by name are laws of a Newtonian fluid. The law of a sheared oil stays.
    if isinstance(fluid.flow, str):
        fluid = replace(fluid, flow="newtonian")
    posed = problem if nodes == problem.nodes else problem.halved()
    posed = replace(posed, fluid=fluid, nodes=nodes, wedge_order=3, tolerance=NESTED_TOLERANCE)
    return _newton_on(posed, levels_of(posed), None, spike=True)(start)


def _grids(problem: FilmProblem, *, solved: int) -> list[list[Level]]:
    """Grids of the nested iteration from the finest on, each with the coarser grids of its preconditioner.

    Grids of at most ``solved`` nodes along x are skipped. If none is solved, there are at least two grids,
    for the error estimate. Each has half the intervals of the grid before, along both axes. The grids of a
    preconditioner may have half the intervals along one axis only.
    """
    least = FIRST_GRID if problem.width is None else _FIRST_GRID_POINT
    grids = [levels_of(problem)]
    while (len(grids) < 2 and not solved) or problem.nodes // 2 + 1 >= max(least, solved + 1):
        problem = problem.halved()
        coarser = grids[-1][1:]
        shape = Mesh.over(problem.nodes, problem.inlet, problem.outlet, problem.width).shape
        known = len(coarser) > 0 and coarser[0].mesh.shape == shape
        grids.append(coarser if known else levels_of(problem))
    return grids


def grid_problem(
    problem: FilmProblem,
    levels: list[Level],
    progress: Progress | None,
    *,
    finest: bool | None = None,
    times: int = 1,
) -> GridProblem:
    """Film to be solved on the first of ``levels``, with ``times`` the number of Newton steps of the problem.

    The finest grid has the tolerance of the problem; coarser grids have a larger one. ``finest`` says whether
    this is the finest grid; by default, the grid with the problem's number of nodes is. A small line contact
    is solved directly, without coarser grids.
    """
    finest = levels[0].nodes == problem.nodes if finest is None else finest
    tolerance = problem.tolerance if finest else max(problem.tolerance, NESTED_TOLERANCE)
    direct = levels[0].mesh.dy is None and levels[0].nodes <= DIRECT
    grids = levels[:1] if direct else levels
    most = times * problem.max_iterations
    return GridProblem(problem.fluid, grids, tolerance, most, progress, problem.asperities)


def levels_of(problem: FilmProblem) -> list[Level]:
    """Grids of a problem, from the finest on."""
    added, geometry = problem.added_gap, problem.geometry
    if added is not None:
        smooth = geometry.dry_gap
        geometry = replace(geometry, dry_gap=lambda x, y: smooth(x, y) + added(x, y))
    if added is None and problem.width is None and problem.source is None and problem.nodes <= _MOST_KEPT:
        levels = list(
            _line_levels(problem.nodes, problem.inlet, problem.outlet, geometry, problem.wedge_order)
        )
    else:
        levels = hierarchy(
            problem.nodes,
            inlet=problem.inlet,
            outlet=problem.outlet,
            geometry=geometry,
            wedge_order=problem.wedge_order,
            width=problem.width,
            source=problem.source,
        )
    if problem.edge_pressure is None:
        return levels
    load = geometry.load - problem.outside_load
    return [replace(level, load=load, edge_excess=problem.edge_excess(level.mesh)) for level in levels]


@lru_cache(maxsize=_GRIDS_KEPT)
def _line_levels(
    nodes: int, inlet: float, outlet: float, geometry: Geometry, wedge_order: int
) -> tuple[Level, ...]:
    """Grids of a smooth line contact; contacts on equally many nodes share them."""
    return tuple(hierarchy(nodes, inlet=inlet, outlet=outlet, geometry=geometry, wedge_order=wedge_order))


def _newton_on(
    problem: FilmProblem,
    levels: list[Level],
    progress: Progress | None,
    *,
    spike: bool,
    early_end: EarlyEnd | None = None,
    times: int = 1,
) -> Callable[[State], GridSolution]:
    """Newton's method for the film equations on the first of ``levels``: a function of the initial guess.

    The tolerance is the problem's tolerance on its own grid, and larger on coarser grids. ``spike`` is
    whether to solve the nodes of the pressure spike separately, ``early_end`` the rule by which the iteration
    may end early, and ``times`` multiplies the largest number of Newton steps.
    """
    return partial(
        newton,
        replace(grid_problem(problem, levels, progress, times=times), early_end=early_end),
        # The residual of an interpolated film may be small although the film is still the film of the coarser
        # grid.
        min_iterations=1,
        # The spike of a point contact is a ridge, of which no single line can be solved separately.
        eliminate_spike=spike and problem.width is None,
    )


def interpolated_state(level: Level, coarse: GridSolution) -> State:
    """State on a grid with the pressure of a solution on a coarser grid, interpolated by a monotone cubic."""
    pressure = _finer(level, coarse.level.mesh, coarse.state.pressure)
    if not coarse.touches:
        return State.of(level, pressure, coarse.state.h00)
    contact = np.asarray(coarse.state.contact_pressure)
    contact = np.clip(_finer(level, coarse.level.mesh, contact), 0.0, pressure)
    return State.of(level, pressure, coarse.state.h00, contact)


def open_state(level: Level, coarse: GridSolution) -> State:
    """State on a grid with the pressure of a coarser solution and without contact.

    Its thinnest gap is at least half of the thinnest gap of the coarser solution.
    """
    return interpolated_state(level, coarse).lifted(0.5 * float(coarse.state.thickness.min()))


def state_with_spots(level: Level, coarse: GridSolution, boundary_film: float) -> State:
    """State on a grid with the pressure of a coarser solution, and with its spots if its surfaces touch.

    The asperities of a point contact that this pressure pushes through the other surface are flattened first.
    """
    if not coarse.touches:
        return open_state(level, coarse)
    state = interpolated_state(level, coarse)
    return state if level.mesh.dy is None else relieved(level, state, boundary_film)


def changed_state(
    fine: GridSolution, before: GridSolution, after: GridSolution, boundary_film: float
) -> State:
    """State of a film on its grid, changed as another film differs from it on a coarser grid.

    ``fine`` and ``before`` are one film on both grids, and ``after`` is the other one. Spots that the coarser
    grid does not resolve remain.
    """
    level, coarse = fine.level, before.level.mesh

    def changed(of: Array | float, first: Array | float, last: Array | float) -> Array:
        rise = _finer(level, coarse, np.broadcast_to(np.asarray(last) - np.asarray(first), coarse.shape))
        return np.maximum(of + rise, 0.0)

    films = [each.state for each in (fine, before, after)]
    pressure = changed(*(state.pressure for state in films))
    contact = np.minimum(changed(*(state.contact_pressure for state in films)), pressure)
    h00 = films[0].h00 + films[2].h00 - films[1].h00
    return relieved(level, State.of(level, pressure, h00, contact), boundary_film)


def filled_on(mesh: Mesh, coarse: Mesh, filled: Mask) -> Mask:
    """Filled nodes on a mesh, from those on a coarser mesh of the same domain by linear interpolation."""
    return on_mesh(filled.astype(float), coarse, mesh) > 0.5


def _finer(level: Level, of: Mesh, values: Array) -> Array:
    """Nodal values on a grid from those on a coarser mesh, interpolated by a monotone cubic."""
    if level.nodes == 2 * of.x.size - 1:
        finer = halved(values)
    else:
        finer = along_axis(of.x, values, level.mesh.x, axis=0)
    whole = of.mirrored(finer)
    if whole.shape[1] > 1 and level.mesh.whole_y.size == 2 * whole.shape[1] - 1:
        finer = halved(whole.T).T[:, -level.mesh.y.size :]
    elif of.y.size > 1:
        finer = along_axis(of.whole_y, whole, level.mesh.y, axis=1)
    return finer


def halved(values: Array) -> Array:
    """Values along the first axis at the nodes of a uniform grid and half-way between them. ``values``,
    values at the nodes, n > 2, shape (n, ny). Returns values of the monotone cubic of
    ``scipy.interpolate.PchipInterpolator``, shape (2 n - 1, ny).

    F. N. Fritsch and J. Butland, SIAM J. Sci. Stat. Comput. 5 (1984) 300, doi:10.1137/0905021: the slope at a
    node is the harmonic mean of the slopes on both sides, and zero between slopes of different signs.

    Examples
    --------
    >>> halved(np.array([[0.0], [0.5], [2.0]]))[:, 0].tolist()
    [0.0, 0.15625, 0.5, 1.09375, 2.0]
    """
    rises = np.diff(values, axis=0)
    before, after = rises[:-1], rises[1:]
    slopes = np.empty_like(values)
    product = before * after
    alike = product > 0.0
    slopes[1:-1] = np.divide(2.0 * product, before + after, out=np.zeros_like(product), where=alike)
    for end, near, far in ((0, rises[0], rises[1]), (-1, rises[-1], rises[-2])):
        slope = 1.5 * near - 0.5 * far
        slope = np.where((near * far < 0.0) & (np.abs(slope) > 3.0 * np.abs(near)), 3.0 * near, slope)
        slopes[end] = np.where(slope * near > 0.0, slope, 0.0)
    fine = np.empty((2 * len(values) - 1, *values.shape[1:]))
    fine[::2] = values
    fine[1::2] = 0.5 * (values[1:] + values[:-1]) + 0.125 * (slopes[:-1] - slopes[1:])
    return fine


def _hertz_state(problem: FilmProblem, level: Level) -> State:
    """State on a grid with the Hertz pressure, and a gap as thick as the guess of the problem."""
    hertz = problem.geometry.dry_pressure(level.mesh.x, level.mesh.y)
    state = State.of(level, np.maximum(hertz, problem.fluid.ambient_pressure), 0.0)
    centre = at_centre(level.mesh, state.thickness)
    state = State.of(level, state.pressure, problem.thickness_guess - centre)
    return state.lifted(0.5 * problem.thickness_guess)


def _restarts(
    problem: FilmProblem, levels: list[Level], progress: Progress | None, early_end: EarlyEnd | None
) -> list[Callable[[State], GridSolution]]:
    """Newton's method for a restart from the Hertz pressure, in the order of the solutions.

    The first solution has the wedge term of first order, which is monotone and converges from a worse initial
    guess. It is the initial guess of the second solution, which has the wedge term of the problem.
    """
    ends = early_end if early_end is not None and early_end.if_unknown else None
    last = _newton_on(problem, levels, progress, spike=False, early_end=ends)
    if problem.wedge_order == 1:
        return [last]
    monotone = [
        replace(level, wedge=wedge_stencil(level.mesh.shape, level.mesh.dx, order=1)) for level in levels
    ]
    warm = _WARM_TOLERANCE if problem.width is None else _WARM_TOLERANCE_POINT
    loosely = replace(problem, tolerance=max(problem.tolerance, warm))
    return [_newton_on(loosely, monotone, progress, spike=False), last]
