"""Film of a contact on its own grid, or on the first of twice as many intervals that is fine enough."""

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

# Grids in succession on which nothing becomes known of the error, after which refining is given up: each
# takes several times as long as the one before.
_UNKNOWN = 3


@dataclass(frozen=True)
class Refined:
    """A film with the setup it was solved on.

    Attributes
    ----------
    film : Film or PointFilm
        Of the last grid.
    setup : Setup
        With that grid, which asks for no further refinement.
    seconds : float
        Time that all grids took [s].
    warnings : tuple of ResultWarning
        Warnings about refinement.
    """

    film: Any
    setup: Setup
    seconds: float
    warnings: tuple[ResultWarning, ...]


def refined(setup: Setup, geometry: str, solved: Callable[[Setup], Film | PointFilm]) -> Refined:
    """Film whose discretisation error is below ``grid.refine``, where a grid gives it.

    Parameters
    ----------
    setup : Setup
        With the first grid.
    geometry : str
        Of the contact, "line" or "point".
    solved : callable
        Film on the grid of a setup.

    Returns
    -------
    Refined
        The last film, with a warning where the error was not reached.
    """
    started, target = time.perf_counter(), setup.grid.refine
    warnings: tuple[ResultWarning, ...] = ()
    at = replace(setup, grid=setup.grid.model_copy(update={"refine": None}))
    errors: list[float | None] = []
    film = solved(at)
    while target is not None and not _within(film, target):
        errors.append(film.discretisation_error)
        if len(errors) >= _UNKNOWN and not any(errors[-_UNKNOWN:]):
            unknown = f"nothing is known of its error on {_UNKNOWN} grids in succession"
            warnings = (_not_reached(target, at.grid, unknown),)
            break
        try:
            finer = _doubled(at.grid)
            check_grid(geometry, finer, rough=bool(setup.roughness))
        except InputError as error:
            warnings = (_not_reached(target, at.grid, str(error)),)
            break
        at = replace(at, grid=finer)
        film = solved(at)
    return Refined(film, at, time.perf_counter() - started, warnings)


def _not_reached(target: float, grid: Grid, reason: str) -> ResultWarning:
    text = f"grid.refine: {100 * target:g} % was not reached with {grid.nodes} nodes; {reason}"
    return ResultWarning("refine-not-reached", text)


def _doubled(grid: Grid) -> Grid:
    """Grid with twice as many intervals, where a case takes it."""
    table = grid.model_dump(mode="json", exclude_none=True)
    table |= {key: 2 * table[key] - 1 for key in ("nodes", "nodes_y") if key in table}
    try:
        return Grid.from_dict(table)
    except InputError as error:
        raise error.under("grid") from None


def _within(film: Film | PointFilm, target: float) -> bool:
    """Whether a film's discretisation error is known to be below a target."""
    return film.discretisation_error is not None and film.discretisation_error <= target
