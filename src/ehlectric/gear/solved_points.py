"""Films that are solved at the points of the path of contact, by which the films of the atlas are corrected.

A line contact is solved with the load that passes each of A, B, C, D and E, the other load at B and D of a
spur pair, both sides of C, and the place of the smallest film. If the oil has all thermal properties, the
film is solved with heat and sliding, on flanks at their temperature, of an oil that enters at this
temperature; it shears as an Eyring fluid if the lubricant has an Eyring stress. Otherwise the film is
isothermal, and has the factor of inlet shear heating.

Ratios of solved films and films of the atlas, and the friction of the solved films, are interpolated along
the path of contact by monotone cubic curves.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from ehlectric.cases.case import Case
from ehlectric.cases.gear_case import GearCase
from ehlectric.cases.grid_inputs import Grid
from ehlectric.contact import line_conditions, solve, solve_contact
from ehlectric.errors import ConvergenceError
from ehlectric.formulas.monotone_cubic import MonotoneCubic
from ehlectric.gear.flank_films import FlankFilms, Flanks, without_heat

# Relative error of the solved films that the grid is refined to.
_ERROR = 0.01

# Distance of places that are one place [m].
_CLOSE = 1e-9


@dataclass(frozen=True)
class SolvedFilm:
    """Solved film at a place of the path of contact, with heat or with the factor of inlet shear heating."""

    central: float  # central film thickness [m]
    minimum: float  # minimum film thickness [m]
    heat_factor: float  # film thickness / isothermal film thickness, dimensionless
    # Traction coefficient, positive where the flank of gear 1 is faster; NaN of an isothermal film.
    traction: float
    error: float  # estimated relative error


@dataclass(frozen=True)
class Correction:
    """Ratios of solved films and films of the atlas over the path of contact."""

    curves: MonotoneCubic  # ratios of central and minimum films, heat factor and traction over g
    error: float  # largest estimated relative error of the solved films

    def applied(self, films: FlankFilms) -> FlankFilms:
        """Films of the atlas that are corrected by the solved films."""
        places = films.places.ravel()
        central, minimum, heat, traction = np.reshape(self.curves(places), (4, *films.places.shape))
        without = np.isnan(films.minimum)
        return replace(
            films,
            central=films.central * central,
            minimum=films.minimum * minimum,
            heat_factor=np.where(without, np.nan, heat),
            friction=np.where(without, np.nan, np.abs(traction)),
            error=np.where(without, np.nan, self.error),
        )


def solved_correction(case: GearCase, flanks: Flanks, atlas: FlankFilms) -> Correction:
    """Solve the films at the places of films of the atlas, shape (n,). Raises ConvergenceError where a film
    does not converge.
    """
    first = np.unique(np.round(atlas.places / _CLOSE), return_index=True)[1]
    films = atlas.some(first)
    solved = list(_solved(case, flanks, films))
    rows = [
        np.array([each.central for each in solved]) / films.central,
        np.array([each.minimum for each in solved]) / films.minimum,
        np.array([each.heat_factor for each in solved]),
        np.array([each.traction for each in solved]),
    ]
    return Correction(MonotoneCubic(films.places, np.stack(rows)), max(each.error for each in solved))


def _solved(case: GearCase, flanks: Flanks, films: FlankFilms) -> Iterator[SolvedFilm]:
    """Solve the films at the places of films of the atlas, arrays of shape (n,)."""
    solved_film = _isothermal if without_heat(case, flanks.temperature) else _heated
    for k, place in enumerate(films.places.tolist()):
        try:
            yield solved_film(case, flanks, films, k)
        except ConvergenceError as error:
            raise ConvergenceError(f"{error}, at {1e3 * place:.4g} mm of the path of contact") from None


def _isothermal(case: GearCase, flanks: Flanks, films: FlankFilms, k: int) -> SolvedFilm:
    """Isothermal film at the place k, with the factor of inlet shear heating."""
    oil = case.lubricant.at(flanks.temperature, "gear.operation.bulk_temperature")
    conditions = line_conditions(
        oil,
        reduced_radius=float(films.reduced_radius[k]),
        reduced_modulus=flanks.modulus,
        load_per_length=float(films.load[k]),
        entrainment_speed=float(films.mean_speed[k]),
    )
    grid = Grid.from_dict({"error": _ERROR})
    film = solve_contact(conditions, oil, grid=grid, require_convergence=True).film
    heat, error = float(films.heat_factor[k]), film.discretisation_error
    return SolvedFilm(
        central=heat * film.central_thickness,
        minimum=heat * film.minimum_thickness,
        heat_factor=heat,
        traction=np.nan,
        error=_ERROR if error is None else error,
    )


def _heated(case: GearCase, flanks: Flanks, films: FlankFilms, k: int) -> SolvedFilm:
    """Film with heat and sliding at the place k."""
    film = solve(_contact_case(case, flanks, films, k), require_convergence=True).film
    heated, error = film.heated, film.discretisation_error
    assert heated is not None and heated.traction_coefficient is not None
    if heated.isothermal_central_thickness is None:
        raise ConvergenceError("isothermal film")
    return SolvedFilm(
        central=film.central_thickness,
        minimum=film.minimum_thickness,
        heat_factor=film.central_thickness / heated.isothermal_central_thickness,
        traction=heated.traction_coefficient,
        error=_ERROR if error is None else error,
    )


def _contact_case(case: GearCase, flanks: Flanks, films: FlankFilms, k: int) -> Case:
    """Case of the line contact at the place k, with heat and sliding."""
    body = {"material": case.gear.material}
    rheology = "newtonian" if case.lubricant.eyring_stress is None else "eyring"
    return Case.from_dict(
        {
            "contact": {
                "geometry": "line",
                "reduced_radius": float(films.reduced_radius[k]),
                "reduced_modulus": flanks.modulus,
                "load_per_length": float(films.load[k]),
                "entrainment_speed": float(films.mean_speed[k]),
                "slide_to_roll_ratio": float(films.slide_to_roll_ratio[k]),
                "temperature": flanks.temperature,
                "body_1": body,
                "body_2": body,
            },
            "lubricant": case.to_dict()["lubricant"],
            "film": {"thermal": True, "rheology": rheology},
            "grid": {"error": _ERROR},
        }
    )
