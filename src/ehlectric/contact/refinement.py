"""Grid refinement: the intervals of the grid are doubled until the error of the film is small enough."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

from ehlectric.cases.grid import Grid
from ehlectric.contact.memory import check_grid
from ehlectric.contact.setup import Setup
from ehlectric.errors import InputError, ResultWarning
from ehlectric.film.line import Film
from ehlectric.film.point import PointFilm

# Number of successive grids without an error estimate after which refinement stops. Each grid takes several
# times as long as the grid before.
_UNKNOWN = 3


@dataclass(frozen=True)
class Refined:
    """Film of the last grid of a refinement, and the setup with this grid.

    Attributes
    ----------
    film : Film or PointFilm
        Film on the last grid.
    setup : Setup
        Setup with the last grid; its ``grid.refine`` is None.
    seconds : float
        Time taken to solve the films on all grids [s].
    warnings : tuple of ResultWarning
        A warning if the target error was not reached.
    """

    film: Any
    setup: Setup
    seconds: float
    warnings: tuple[ResultWarning, ...]


def refined(setup: Setup, geometry: str, solved: Callable[[Setup], Film | PointFilm]) -> Refined:
    """Solve a film, and refine its grid until the discretisation error is below ``grid.refine``.

    The film is solved on one grid only if ``grid.refine`` is None.

    Parameters
    ----------
    setup : Setup
        Setup with the first grid.
    geometry : str
        Geometry of the contact, "line" or "point".
    solved : callable
        Function that solves the film: setup -> film.

    Returns
    -------
    Refined
        Film of the last grid, with a warning if the target error was not reached.
    """
    started, target = time.perf_counter(), setup.grid.refine
    warnings: tuple[ResultWarning, ...] = ()
    current = replace(setup, grid=setup.grid.model_copy(update={"refine": None}))
    errors: list[float | None] = []
    film = solved(current)
    while target is not None and not _within(film, target):
        errors.append(film.discretisation_error)
        if len(errors) >= _UNKNOWN and not any(errors[-_UNKNOWN:]):
            unknown = f"the error is unknown on {_UNKNOWN} grids in succession"
            warnings = (_not_reached(target, current.grid, unknown),)
            break
        try:
            finer = _doubled(current.grid)
            check_grid(geometry, finer, rough=bool(setup.roughness))
        except InputError as error:
            warnings = (_not_reached(target, current.grid, str(error)),)
            break
        current = replace(current, grid=finer)
        film = solved(current)
    return Refined(film, current, time.perf_counter() - started, warnings)


def _not_reached(target: float, grid: Grid, reason: str) -> ResultWarning:
    text = f"grid.refine: an error of {100 * target:g} % was not reached with {grid.nodes} nodes; {reason}"
    return ResultWarning("refine-not-reached", text)


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


def _within(film: Film | PointFilm, target: float) -> bool:
    """Whether the discretisation error of a film is known and at most the target."""
    return film.discretisation_error is not None and film.discretisation_error <= target
