"""A point contact against independently computed films and a published formula."""

from dataclasses import replace

import numpy as np
import pandas as pd
import pytest

from ehlectric import Case, solve
from ehlectric.formulas.film_point import hamrock_dowson
from tests.helpers.gate import gated
from tests.helpers.places import EXAMPLES, PUBLISHED

pytestmark = pytest.mark.published

MICRO = 1e-6
FILMS = pd.read_csv(PUBLISHED / "point_contact_films.csv", comment="#", dtype=str)
FILMS = {row.nodes: (float(row.h_min) * MICRO, float(row.h_0) * MICRO) for row in FILMS.itertuples()}
EXTRAPOLATED = FILMS.pop("extrapolated")
NODES = [int(nodes) for nodes in FILMS]


@pytest.fixture(scope="module")
def solved():
    """Solutions by nodes and wedge, each computed once."""
    case, results = Case.from_toml(EXAMPLES / "ball_contact.toml"), {}

    def solution(nodes, wedge):
        key = (nodes, wedge)
        if key not in results:
            results[key] = solve(case.replace({"grid.nodes": nodes, "grid.wedge": wedge}))
        return results[key]

    return solution


def off(film, expected):
    """Relative differences of the minimum and the central film."""
    found = np.array([film.minimum_thickness, film.central_thickness])
    return found / np.array(expected) - 1.0


@pytest.mark.slow
@pytest.mark.parametrize("nodes", gated(NODES, 257))
def test_first_order_film_agrees_with_independent_computation(solved, nodes):
    film = solved(nodes, "first-order").film
    assert film.converged
    assert np.max(np.abs(off(film, FILMS[str(nodes)]))) < 1e-3


@pytest.mark.slow
def test_second_order_film_is_near_the_extrapolated_one(solved):
    assert np.max(np.abs(off(solved(257, "second-order").film, EXTRAPOLATED))) < 7e-3


@pytest.mark.slow
@pytest.mark.gate
@pytest.mark.parametrize("wedge", ["first-order", "second-order"])
@pytest.mark.parametrize("nodes", NODES)
def test_error_estimate_is_the_true_error(solved, nodes, wedge):
    """Within a factor 3 of the distance from the extrapolated film, which is rounded to 0.001 um."""
    film = solved(nodes, wedge).film
    true, rounding = np.max(np.abs(off(film, EXTRAPOLATED))), 0.0005 / 0.272
    assert (true - rounding) / 3.0 < film.discretisation_error < 3.0 * (true + rounding)


@pytest.mark.slow
@pytest.mark.gate
def test_film_formulas(solved):
    """Hamrock-Dowson gives 0.251 and 0.438 um; their fits are within 10 % of this film."""
    result = solved(257, "second-order")
    # The independent computation took the slope alpha of the viscosity, not alpha*.
    by_slope = replace(result.conditions.contact, pressure_viscosity_coefficient=result.case.oil.alpha)
    formula = hamrock_dowson(by_slope)
    assert formula.minimum_thickness == pytest.approx(0.251 * MICRO, abs=0.0005 * MICRO)
    assert formula.central_thickness == pytest.approx(0.438 * MICRO, abs=0.0005 * MICRO)
    expected = (formula.minimum_thickness, formula.central_thickness)
    assert np.max(np.abs(off(result.film, expected))) < 0.1


@pytest.mark.slow
@pytest.mark.gate
@pytest.mark.parametrize("wedge", ["first-order", "second-order"])
@pytest.mark.parametrize("nodes", [129])
def test_solution_meets_its_equations(solved, nodes, wedge):
    film = solved(nodes, wedge).film
    assert film.load_residual < 1e-10
    assert film.residual <= 1e-9
    ambient = 1e5
    assert np.all(film.pressure >= ambient)
    assert np.all(film.pressure[film.cavitated] == ambient)
    full = ~film.cavitated
    assert np.max(np.abs(film.reynolds_residual[full])) <= 1e-9
    assert np.min(film.reynolds_residual[film.cavitated]) > -1e-9
    assert film.cavitates
    np.testing.assert_array_equal(film.thickness, film.thickness[:, ::-1])


@pytest.mark.slow
@pytest.mark.gate
def test_horseshoe(solved):
    """The film is thinnest at the two sides, not at the exit, and the field largest there: V12/h_min."""
    result = solved(257, "second-order")
    film, conditions = result.film, result.conditions
    x, y = np.array(film.minimum_position) / conditions.semi_axis_x
    assert 0.0 < x < 0.6
    assert 0.6 < abs(y) < 0.95
    assert result.max_dimensionless == pytest.approx(1.0, abs=1e-3)
    at = result.field.max_strength_position
    assert at[0] == pytest.approx(film.minimum_position[0], abs=1e-9)
    assert abs(at[1]) == pytest.approx(abs(film.minimum_position[1]), abs=1e-9)
    # On the line y = 0 the constriction at the exit is shallower than the side lobes.
    middle = film.thickness[:, film.y.size // 2]
    lobe = film.minimum_thickness
    assert 1.1 * lobe < np.min(middle) < 0.95 * film.central_thickness
