"""Films that are solved at the points of the path of contact, by which the films of the atlas are corrected.

A line contact is solved, isothermal and with the load that passes each of A, B, C, D and E, and the place of
the smallest film. The ratio of solved film and film of the atlas, interpolated linearly along the path of
contact, is a factor on all films.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from ehlectric.arrays import Array
from ehlectric.cases.grid_inputs import Grid
from ehlectric.contact import line_conditions, solve_contact
from ehlectric.errors import ConvergenceError
from ehlectric.gear.flank_films import FlankFilms, Flanks, flank_films

# Relative error of the solved films that the grid is refined to.
_ERROR = 0.01


@dataclass(frozen=True)
class SolvedPoint:
    """Solved film at a place of the path of contact."""

    place: float  # g [m]
    central: float  # isothermal central film thickness [m]
    minimum: float  # isothermal minimum film thickness [m]
    error: float  # estimated relative error


def solve_points(flanks: Flanks, places: Array, load: Array) -> Iterator[SolvedPoint]:
    """Solve the films at places g [m] under line loads [N/m], arrays of shape (n,). Raises ConvergenceError
    where a film does not converge.
    """
    films = flank_films(flanks, places, load)
    for k, place in enumerate(places.tolist()):
        conditions = line_conditions(
            flanks.oil,
            reduced_radius=float(films.reduced_radius[k]),
            reduced_modulus=flanks.modulus,
            load_per_length=float(load[k]),
            entrainment_speed=float(films.mean_speed[k]),
        )
        result = solve_contact(conditions, flanks.oil, grid=Grid.from_dict({"error": _ERROR}))
        if not result.converged:
            raise ConvergenceError(f"the film at {1e3 * place:.4g} mm of the path of contact")
        film = result.film
        error = film.discretisation_error
        yield SolvedPoint(
            place, film.central_thickness, film.minimum_thickness, _ERROR if error is None else error
        )


def corrected(films: FlankFilms, atlas: FlankFilms, points: list[SolvedPoint]) -> FlankFilms:
    """Films times the ratios of solved films and films of the atlas at the same places, ``atlas``."""
    order = np.argsort([point.place for point in points])
    places = np.array([points[k].place for k in order])
    central = np.array([points[k].central for k in order]) / (atlas.central / atlas.heat_factor)[order]
    minimum = np.array([points[k].minimum for k in order]) / (atlas.minimum / atlas.heat_factor)[order]
    worst = max(point.error for point in points)
    return replace(
        films,
        central=films.central * np.interp(films.places, places, central),
        minimum=films.minimum * np.interp(films.places, places, minimum),
        error=np.where(np.isnan(films.minimum), np.nan, worst),
    )
