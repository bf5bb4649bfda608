"""Films of a ball on glass against those of another program, on its grid and by default."""

import numpy as np
import pandas as pd
import pytest

from ehlectric import Case, solve
from tests.helpers.places import PUBLISHED

pytestmark = pytest.mark.published

FILMS = pd.read_csv(PUBLISHED / "independent_balls.csv", comment="#", index_col="film")
OTHERS = [name for name in FILMS.index if name != "ti_006"]


def contact(name, grid=None):
    """Case of one of the films."""
    row = FILMS.loc[name]
    alpha, pressure = 1e-9 * row.alpha, 0.196e9
    lubricant = {
        "viscosity": row.viscosity,
        "pressure_viscosity_coefficient": alpha,
        "viscosity_law": "roelands",
        "roelands_pressure": pressure,
        "roelands_z": alpha * pressure / (np.log(row.viscosity) + 9.67),
        "density_law": "dowson-higginson",
        "density_c1": 0.59e9,
        "density_c2": 1.34,
        "relative_permittivity": 2.2,
    }
    ball = {
        "geometry": "point",
        "radius_x": 0.01268,
        "radius_y": 0.01268,
        "reduced_modulus": 123.8782e9,
        "load": row.load,
        "entrainment_speed": row.speed,
    }
    return Case.from_dict({"contact": ball, "lubricant": lubricant} | ({"grid": grid} if grid else {}))


@pytest.mark.slow
def test_film_of_another_program_on_its_grid():
    """To 0.3 %, with the largest pressure to 0.1 %: both have the first-order wedge on 769 x 769 nodes."""
    grid = {"nodes": 769, "nodes_y": 769, "inlet": -4.0, "outlet": 2.0, "side": 3.0, "wedge": "first-order"}
    result, row = solve(contact("ti_006", grid)), FILMS.loc["ti_006"]
    film = result.film
    assert film.converged
    assert film.central_thickness == pytest.approx(1e-9 * row.h_0, rel=3e-3)
    assert film.minimum_thickness == pytest.approx(1e-9 * row.h_min, rel=3e-3)
    assert film.max_pressure == pytest.approx(row.p_max * result.conditions.max_pressure, rel=1e-3)


@pytest.mark.slow
@pytest.mark.gate
@pytest.mark.parametrize("name", OTHERS)
def test_films_of_another_program_are_thicker_than_ours_by_their_first_order_wedge(name):
    """By 0 to 1.2 %, as its first-order wedge makes films too thick."""
    film = solve(contact(name)).film
    assert film.converged
    assert 1.0 <= 1e-9 * FILMS.loc[name].h_min / film.minimum_thickness <= 1.012
