"""Expected discretisation error of point contacts against the errors that the solver states on its grids."""

import csv
import math
from dataclasses import replace

import numpy as np
import pytest

from ehlectric.film.deflection import point_geometry
from ehlectric.film.face_flow import Fluid
from ehlectric.film.film_errors import UNSEEN, expected_error, expected_nodes
from ehlectric.film.mesh import Width
from ehlectric.film.problem import FilmProblem, OilSupply
from tests.helpers.places import ROOT

# Stated errors below it are not of interest: estimates of some grids vanish by chance.
LEAST = 1.5e-3


def stated():
    with (ROOT / "benchmarks/data/reachable_errors.csv").open(encoding="utf-8") as file:
        lines = (line for line in file if not line.startswith("#"))
        return [{key: float(value or "nan") for key, value in row.items()} for row in csv.DictReader(lines)]


def posed(row):
    """Problem with the film, the ellipse and the first grid of a row."""
    ratio = row["ellipse_ratio"]
    return FilmProblem(
        Fluid(lambda p: (p, p), lambda p: (p, p), velocity_parameter=1.0, ambient_pressure=0.0),
        nodes=int(row["intervals"]) + 1,
        inlet=-4.5,
        outlet=1.5,
        thickness_guess=row["formula_film"],
        wedge_order=3,
        geometry=point_geometry(radius_ratio=1.0, ellipse_ratio=ratio, compliance=1.0),
        width=Width(nodes=int(row["intervals"]) + 1, side=3.0 * ratio),
    )


def test_expected_errors_are_those_that_the_solver_states():
    """Within a factor of two in nine of ten grids that see their film."""
    rows = [row for row in stated() if row["error"] > LEAST and expected_error(posed(row)) <= UNSEEN]
    factors = np.array([expected_error(posed(row)) / row["error"] for row in rows])
    assert len({row["contact"] for row in rows}) >= 10
    assert len(rows) >= 20
    assert np.mean(np.abs(np.log2(factors)) <= 1.0) >= 0.9
    # The table is not one of a single film: errors and films are spread over decades.
    for key, decades in (("error", 2.0), ("formula_film", 2.0)):
        values = [row[key] for row in rows]
        assert math.log10(max(values) / min(values)) > decades


def test_errors_of_other_contacts_are_not_expected():
    problem = posed(stated()[0])
    assert expected_error(problem) > 0.0
    for changes in (
        {"width": None},
        {"wedge_order": 2},
        {"added_gap": lambda x, _: x},
        {"boundary_film": problem.thickness_guess},
    ):
        assert expected_error(replace(problem, **changes)) is None


def test_nodes_of_a_thin_film_are_those_of_its_patch():
    """A quarter to a half of the domain; the grid of a film of which nothing is known covers all of it."""
    problem = replace(posed(stated()[0]), thickness_guess=0.05)
    whole = expected_nodes(problem)
    assert expected_nodes(problem, 2) == pytest.approx(4.0 * 0.4 * whole, rel=0.4)
    assert expected_nodes(replace(problem, thickness_guess=1e-4), 2) == pytest.approx(4.0 * whole)


@pytest.mark.parametrize("times", [1, 2, 4])
def test_nodes_of_a_whole_grid_are_the_intervals_of_its_mesh(times):
    """An error that is not known before needs the whole domain on each grid: as many times as many intervals
    along and across.
    """
    problem = replace(posed(stated()[0]), supply=OilSupply(film_ratio=0.5))
    fine = replace(problem.width, nodes=times * (problem.width.nodes - 1) + 1)
    cells = times * (problem.nodes - 1) * (fine.y.size - 1)
    assert expected_nodes(problem, times) == pytest.approx(cells)
