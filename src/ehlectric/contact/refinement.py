"""Grid refinement: the intervals of the grid are doubled until the error of the film is small enough."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ehlectric.cases.grid import Grid
from ehlectric.contact.memory import check_grid
from ehlectric.contact.setup import Setup
from ehlectric.errors import InputError, ResultWarning
from ehlectric.film.accuracy.adaptive import UNKNOWN
from ehlectric.film.line import Film
from ehlectric.film.point import PointFilm
from ehlectric.film.problem import FilmProblem, OnGrid
from ehlectric.film.thermal.physics import Physics

# How often the intervals of a grid are doubled at the most, with smooth and with rough surfaces. A film whose
# estimate does not fall, such as one under white noise, would take them up to the memory of the machine.
_MOST_DOUBLED = {"line": 8, "point": 5}
_MOST_DOUBLED_ROUGH = {"line": 3, "point": 2}


@dataclass(frozen=True)
class Refined:
    """Film of the last grid of a refinement, and the setup with this grid.

    Attributes
    ----------
    film : Film or PointFilm
        Film on the last grid.
    first, setup : Setup
        Setup with the first grid and with the last one, which have no target.
    seconds : float
        Time taken to solve the films on all grids [s].
    warnings : tuple of ResultWarning
        A warning if the target error was not reached.
    """

    film: Any
    first: Setup
    setup: Setup
    seconds: float
    warnings: tuple[ResultWarning, ...]


def refined(
    setup: Setup,
    geometry: str,
    problem_of: Callable[[Setup], FilmProblem],
    solved: Callable[[FilmProblem], Film | PointFilm],
    on_grid: OnGrid | None = None,
) -> Refined:
    """Solve a film, and refine its grid until the discretisation error is below ``grid.target``.

    The film is solved on one grid only if the grid has no target.

    Parameters
    ----------
    setup : Setup
        Setup with the first grid.
    geometry : str
        Geometry of the contact, "line" or "point".
    problem_of : callable
        Function that makes the film problem: setup -> problem.
    solved : callable
        Function that solves the film and refines its grid: problem -> film.
    on_grid : callable, optional
        Function that is called after each grid: grid, discretisation error or None -> None.

    Returns
    -------
    Refined
        Film of the last grid, with a warning if the target error was not reached. The intervals of a line
        contact's grid are doubled at most eight times, those of a point contact's five times; with rough
        surfaces three times and twice.
    """
    started, target = time.perf_counter(), setup.grid.target
    first = replace(setup, grid=_fixed(setup.first_grid))
    problem = problem_of(first)
    if target is None:
        return Refined(solved(problem), first, first, time.perf_counter() - started, ())
    grids, refusal = finer_grids(setup, geometry, problem.physics)
    film = solved(replace(problem, target_error=target, most_nodes=grids[-1].nodes_along, on_grid=on_grid))
    closest = (film.x[-1] - film.x[0]) / float(np.min(np.diff(film.x)))
    grid = min(grids, key=lambda grid: abs(grid.nodes_along - 1 - closest))
    warnings: tuple[ResultWarning, ...] = ()
    if film.discretisation_error is None or film.discretisation_error > target:
        unknown = f"the error is unknown on {UNKNOWN} grids in succession"
        why = refusal if grid is grids[-1] else unknown
        warnings = (_not_reached("refine" if setup.grid.refine else "error", target, grid, why),)
    return Refined(film, first, replace(first, grid=grid), time.perf_counter() - started, warnings)


def finer_grids(setup: Setup, geometry: str, physics: Physics | None) -> tuple[list[Grid], str]:
    """Grids of a refinement from the first one up to the last one that is allowed, and why it is the last.

    Parameters
    ----------
    setup : Setup
        Setup of the contact.
    geometry : str
        Geometry of the contact, "line" or "point".
    physics : Physics or None
        Rheology and heat of the film, which need memory.

    Returns
    -------
    list of Grid, str
        Grids, each with twice as many intervals as the grid before, and the reason why there is no finer one.
    """
    heat = None if physics is None else "sheared" if physics.thermal is None else "thermal"
    grids, rough = [_fixed(setup.first_grid)], bool(setup.roughness)
    most = (_MOST_DOUBLED_ROUGH if rough else _MOST_DOUBLED)[geometry]
    while True:
        if len(grids) > most:
            kind = "rough" if rough else "smooth"
            return grids, f"a {kind} contact is refined {most} times at the most; begin with more grid.nodes"
        try:
            finer = _doubled(grids[-1])
            check_grid(geometry, finer, rough=rough, heat=heat)
        except InputError as error:
            return grids, str(error)
        if setup.grid.most_nodes is not None and finer.nodes_along > setup.grid.most_nodes:
            return grids, f"the next grid has {finer.nodes_along} nodes, more than grid.most_nodes"
        grids.append(finer)


def _fixed(grid: Grid) -> Grid:
    """Grid with the same nodes that is not refined."""
    return grid.model_copy(update={"refine": None, "error": None, "most_nodes": None})


def _not_reached(key: str, target: float, grid: Grid, reason: str) -> ResultWarning:
    reached = f"an error of {100 * target:g} % was not reached with {grid.nodes_along} nodes"
    return ResultWarning("refine-not-reached", f"grid.{key}: {reached}; {reason}")


def _doubled(grid: Grid) -> Grid:
    """Grid with twice as many intervals.

    Raises an InputError if the finer grid exceeds the bounds of a case.
    """
    table = grid.model_dump(mode="json", exclude_none=True)
    table |= {key: 2 * table[key] - 1 for key in ("nodes", "nodes_y") if key in table}
    try:
        return Grid.from_dict(table)
    except InputError as error:
        raise error.under("grid") from None
