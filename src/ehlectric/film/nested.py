"""Nested iteration for the film: the initial guess on every grid is the solution on the next coarser grid.

If the iteration does not converge from this guess, it starts again from the Hertz pressure. If a rough
contact still does not converge, its roughness is raised from zero in steps (continuation).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
from scipy.interpolate import PchipInterpolator

from ehlectric.arrays import Array
from ehlectric.film.deflection import Geometry
from ehlectric.film.levels import Level, hierarchy
from ehlectric.film.mesh import Mesh, at_centre
from ehlectric.film.newton import assess, newton
from ehlectric.film.problem import FilmProblem
from ehlectric.film.reynolds import wedge_stencil
from ehlectric.film.state import GridSolution, Progress, State, film_touches

# Tolerance of the residual on the coarser grids, far below their discretisation error.
NESTED_TOLERANCE = 1e-6

# The nested iteration starts on the coarsest grid with at least this many nodes along x, in a line and in a
# point contact. A quarter of the nodes would not resolve a thin film.
FIRST_GRID = 101
_FIRST_GRID_POINT = 33

# Largest number of nodes of a line contact whose linear systems are solved directly, without coarser grids:
# the factorisation then takes less time than the cycles.
_DIRECT = 401

# Largest number of nodes of a smooth line contact whose grids are kept for the next contact, and number of
# such grids, which take about 10 MB at most.
_MOST_KEPT, _GRIDS_KEPT = 3201, 12

# Residual of the film of first order that a line contact starts from: the Newton steps below it change less
# than the order of the wedge term does.
_WARM_TOLERANCE = 1e-2

# Continuation in roughness height: first and smallest increment as fractions of the full height, and the
# tolerance of the intermediate films.
_FIRST_RISE = 0.2
_LEAST_RISE = 0.01
_RISE_TOLERANCE = 1e-3

# Smallest grids, in a line and in a point contact, that show whether a rough film collapses; and the part of
# the roughness below which a film that collapses there is not tried on finer grids. Films that collapsed at
# half of the roughness on the coarse grid converged on finer ones.
_TRIAL_GRID = 801
_TRIAL_GRID_POINT = 65
_HOPELESS = 0.2


def nested_iteration(
    problem: FilmProblem, progress: Progress | None, known: Sequence[GridSolution] = ()
) -> list[GridSolution]:
    """Solve the film on a sequence of grids, from coarse to fine.

    Parameters
    ----------
    problem : FilmProblem
        Dimensionless problem of the contact.
    progress : callable or None
        Function that is called with (nodes, Newton step, residual) before every Newton step.
    known : sequence of GridSolution
        Solutions on the coarser grids of the same problem, as this function returns them.

    Returns
    -------
    list of GridSolution
        All solutions in the order in which they were computed, after the known ones. The last one is the
        solution of ``problem`` on its own grid, with its status. No error is raised if it did not converge.

    Notes
    -----
    If the solution on a grid does not converge, this grid and the next finer grid start from the Hertz
    pressure. If a rough film does not converge on a coarse grid either way, its roughness is raised in steps
    on this grid. Where the film then collapses at less than a fifth of the roughness, the finer grids are
    left out: the iteration ends with a collapsed film.
    """
    solutions = list(known)
    tried = problem.added_gap is None or bool(known)
    for levels in reversed(_grids(problem, solved=known[-1].level.nodes if known else 0)):
        best = None
        if solutions and solutions[-1].status == "converged":
            best = _from_coarser(problem, levels, solutions[-1], progress)
        # A solution that nearly converged does not start again.
        if best is None or best.final.norm > NESTED_TOLERANCE:
            *warm_up, restarted = _from_hertz(problem, levels, progress)
            solutions.extend(warm_up)
            attempts = [restarted] if best is None else [restarted, best]
            *others, best = sorted(attempts, key=lambda solution: -solution.final.norm)
            solutions.extend(others)
        solutions.append(best)
        if not tried and _is_trial_grid(problem, best):
            tried = True
            raised = _raise_roughness(_on_grid(problem, levels[0].mesh), progress)
            solutions += raised.solutions
            if raised.collapses:
                return [*solutions, _collapsed(problem, raised.solutions[-1])]
    if problem.added_gap is not None and solutions[-1].final.norm > NESTED_TOLERANCE:
        solutions += _raise_roughness(problem, progress).solutions
    return solutions


def accurate_film(problem: FilmProblem, nodes: int, start: State) -> GridSolution:
    """Solution with the wedge term and the flow of the highest order, from a solution of first order.

    Parameters
    ----------
    problem : FilmProblem
        Dimensionless problem of the contact.
    nodes : int
        Number of nodes along x: that of the problem or that of the next coarser grid.
    start : State
        Initial guess on this grid.

    Returns
    -------
    GridSolution
        Last iterate on the grid with ``nodes`` nodes. Its tolerance is that of the coarser grids of the
        nested iteration.
    """
    width = problem.width
    if width is not None and nodes != problem.nodes:
        width = width.coarser()
    posed = replace(
        problem,
        fluid=replace(problem.fluid, flow="newtonian"),
        nodes=nodes,
        width=width,
        wedge_order=3,
        tolerance=NESTED_TOLERANCE,
    )
    levels = levels_of(posed, roughness=1.0)
    return _solve_grid(posed, levels, start, None, spike=True)


def _grids(problem: FilmProblem, *, solved: int) -> list[list[Level]]:
    """Grids of the nested iteration from the finest on, each with the coarser grids of its preconditioner.

    Grids of at most ``solved`` nodes along x are left out. If none is solved, there are at least two grids,
    for the error estimate. Each has half the intervals of the grid before, along both axes. The grids of a
    preconditioner may have half the intervals along one axis only.
    """
    least = FIRST_GRID if problem.width is None else _FIRST_GRID_POINT
    grids = [levels_of(problem, roughness=1.0)]
    while (len(grids) < 2 and not solved) or problem.nodes // 2 + 1 >= max(least, solved + 1):
        width = None if problem.width is None else problem.width.coarser()
        problem = replace(problem, nodes=problem.nodes // 2 + 1, width=width)
        coarser = grids[-1][1:]
        shape = Mesh.over(problem.nodes, problem.inlet, problem.outlet, width).shape
        known = len(coarser) > 0 and coarser[0].mesh.shape == shape
        grids.append(coarser if known else levels_of(problem, roughness=1.0))
    return grids


def levels_of(problem: FilmProblem, *, roughness: float = 1.0) -> list[Level]:
    """Grids of a problem, from the finest on, with its roughness multiplied by a factor ``roughness``."""
    added, geometry = problem.added_gap, problem.geometry
    if added is not None:
        smooth = geometry.dry_gap
        geometry = replace(geometry, dry_gap=lambda x, y: smooth(x, y) + roughness * added(x, y))
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
    return [replace(levels[0], edge_excess=problem.edge_excess(levels[0].mesh)), *levels[1:]]


@lru_cache(maxsize=_GRIDS_KEPT)
def _line_levels(
    nodes: int, inlet: float, outlet: float, geometry: Geometry, wedge_order: int
) -> tuple[Level, ...]:
    """Grids of a smooth line contact, which are the same for all contacts on as many nodes."""
    return tuple(hierarchy(nodes, inlet=inlet, outlet=outlet, geometry=geometry, wedge_order=wedge_order))


def _is_trial_grid(problem: FilmProblem, solution: GridSolution) -> bool:
    """Whether a rough film failed on a grid that is coarse, but fine enough to show that it collapses."""
    nodes = solution.level.nodes
    least = _TRIAL_GRID if problem.width is None else _TRIAL_GRID_POINT
    return least <= nodes < problem.nodes and solution.final.norm > NESTED_TOLERANCE


def _on_grid(problem: FilmProblem, mesh: Mesh) -> FilmProblem:
    """Film problem on another grid of the nested iteration."""
    width = problem.width
    while width is not None and width.y.size > mesh.y.size:
        width = width.coarser()
    return replace(problem, nodes=mesh.x.size, width=width)


def _collapsed(problem: FilmProblem, coarse: GridSolution) -> GridSolution:
    """Solution of a collapsed film on the finest grid, interpolated from a coarser grid.

    The film is lifted until a thousandth of its central thickness is left where the surfaces would touch.
    """
    level = levels_of(problem, roughness=1.0)[0]
    state = _interpolated(level, coarse)
    centre, least = at_centre(level.mesh, state.thickness), float(state.thickness.min())
    # With a lift of d, least + d is a thousandth of centre + d.
    state = State.of(level, state.pressure, state.h00 + (1e-3 * centre - least) / (1.0 - 1e-3))
    return GridSolution(level, state, assess(problem.fluid, level, state), (), "diverged")


@dataclass(frozen=True)
class _Raised:
    """Solutions with raised roughness, and the largest part of the roughness at which the film converged.

    The part is None if the smooth film did not converge.
    """

    solutions: list[GridSolution]
    part: float | None

    @property
    def collapses(self) -> bool:
        """Whether the film gets too thin far below the full roughness, although the smooth film converged."""
        last = self.solutions[-1]
        touches = film_touches(last.level.mesh, last.state.thickness)
        return self.part is not None and self.part < _HOPELESS and touches


def _raise_roughness(problem: FilmProblem, progress: Progress | None) -> _Raised:
    """Solutions with the roughness raised in steps from zero to its full height (continuation).

    The first solutions are those of smooth surfaces. Each converged solution is the initial guess of the
    next. An increment that does not converge is halved. The continuation ends if the smallest increment does
    not converge; the last solution is then not converged.
    """
    solutions = nested_iteration(replace(problem, added_gap=None), progress)
    best, reached, step = solutions[-1], 0.0, _FIRST_RISE
    while best.status == "converged" and reached < 1.0:
        part = min(1.0, reached + step)
        levels = levels_of(problem, roughness=part)
        start = State.of(levels[0], best.state.pressure, best.state.h00)
        start = start.lifted(0.3 * float(best.state.thickness.min()))
        solution = _solve_grid(
            problem if part == 1.0 else replace(problem, tolerance=_RISE_TOLERANCE),
            levels,
            start,
            progress,
            spike=True,
        )
        if solution.status == "converged":
            best, reached, step = solution, part, 1.5 * step
        elif step > _LEAST_RISE:
            step *= 0.5
            continue
        solutions.append(solution)
        if solution.status != "converged":
            break
    smooth = best.status == "converged" or reached > 0.0
    return _Raised(solutions, reached if smooth else None)


def _solve_grid(
    problem: FilmProblem,
    levels: list[Level],
    state: State,
    progress: Progress | None,
    *,
    spike: bool,
) -> GridSolution:
    """Solve the film equations on the first of ``levels`` from the initial guess ``state``.

    The tolerance is that of the problem on its own grid, and larger on coarser grids. ``spike`` tells whether
    to solve the nodes of the pressure spike separately.
    """
    finest = levels[0].nodes == problem.nodes
    direct = problem.width is None and levels[0].nodes <= _DIRECT
    return newton(
        problem.fluid,
        levels[:1] if direct else levels,
        state,
        tolerance=problem.tolerance if finest else max(problem.tolerance, NESTED_TOLERANCE),
        max_iterations=problem.max_iterations,
        # The residual of an interpolated film may be small although the film is that of the coarser grid.
        min_iterations=1,
        progress=progress,
        # The spike of a point contact is a ridge, of which no single line can be solved separately.
        eliminate_spike=spike and problem.width is None,
    )


def _from_coarser(
    problem: FilmProblem, levels: list[Level], coarse: GridSolution, progress: Progress | None
) -> GridSolution:
    """Solve the film equations with the solution on the next coarser grid as initial guess.

    The coarse solution is interpolated by a monotone cubic, which is smooth and does not overshoot.
    """
    state = _interpolated(levels[0], coarse)
    state = state.lifted(0.5 * float(coarse.state.thickness.min()))
    return _solve_grid(problem, levels, state, progress, spike=True)


def _interpolated(level: Level, coarse: GridSolution) -> State:
    """State on a grid with the pressure of a coarser grid, interpolated by a monotone cubic."""
    of = coarse.level.mesh
    if level.nodes == 2 * of.x.size - 1:
        pressure = halved(coarse.state.pressure)
    else:
        pressure = PchipInterpolator(of.x, coarse.state.pressure, axis=0)(level.mesh.x)
    if of.y.size > 1:
        pressure = PchipInterpolator(of.whole_y, of.mirrored(pressure), axis=1)(level.mesh.y)
    return State.of(level, pressure, coarse.state.h00)


def halved(values: Array) -> Array:
    """Values along the first axis at the nodes of a uniform grid and half-way between them.

    Parameters
    ----------
    values : ndarray, shape (n, ny)
        Values at the nodes, n > 2.

    Returns
    -------
    ndarray, shape (2 n - 1, ny)
        Values of the monotone cubic of ``scipy.interpolate.PchipInterpolator``.

    Notes
    -----
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
    for end, near, next_one in ((0, rises[0], rises[1]), (-1, rises[-1], rises[-2])):
        slope = 1.5 * near - 0.5 * next_one
        slope = np.where((near * next_one < 0.0) & (np.abs(slope) > 3.0 * np.abs(near)), 3.0 * near, slope)
        slopes[end] = np.where(slope * near > 0.0, slope, 0.0)
    fine = np.empty((2 * len(values) - 1, *values.shape[1:]))
    fine[::2] = values
    fine[1::2] = 0.5 * (values[1:] + values[:-1]) + 0.125 * (slopes[:-1] - slopes[1:])
    return fine


def _from_hertz(
    problem: FilmProblem, levels: list[Level], progress: Progress | None
) -> Iterator[GridSolution]:
    """Solutions with the Hertz pressure as initial guess.

    The first solution has the wedge term of first order, which is monotone and converges from a worse initial
    guess. It is the initial guess of the second solution, which has the wedge term of the problem.
    """
    level = levels[0]
    hertz = problem.geometry.dry_pressure(level.mesh.x, level.mesh.y)
    state = State.of(level, np.maximum(hertz, problem.fluid.ambient_pressure), 0.0)
    centre = at_centre(level.mesh, state.thickness)
    state = State.of(level, state.pressure, problem.thickness_guess - centre)
    state = state.lifted(0.5 * problem.thickness_guess)
    if problem.wedge_order > 1:
        monotone = [
            replace(level, wedge=wedge_stencil(level.mesh.shape, level.mesh.dx, order=1)) for level in levels
        ]
        loosely = problem
        if problem.width is None:
            loosely = replace(problem, tolerance=max(problem.tolerance, _WARM_TOLERANCE))
        start = _solve_grid(loosely, monotone, state, progress, spike=False)
        yield start
        state = start.state if start.status == "converged" else state
    yield _solve_grid(problem, levels, state, progress, spike=False)
