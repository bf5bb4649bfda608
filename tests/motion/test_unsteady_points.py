"""The film of a point contact in time: observed order, what stands still, and how wide ridges do as lines."""

from dataclasses import replace

import numpy as np
import pytest

from ehlectric import Case
from ehlectric.contact.conditions import resolve_point
from ehlectric.contact.problems import point_film_problem
from tests.helpers.transient_films import last, ridge, steady

pytestmark = pytest.mark.convergence

# A ball on a plane, 20 N and 2 m/s, as among the examples.
BALL = {
    "contact": {
        "geometry": "point",
        "radius_x": "10 mm",
        "radius_y": "10 mm",
        "reduced_modulus": "226 GPa",
        "load": "20 N",
        "entrainment_speed": "2 m/s",
    },
    "lubricant": {"base": "paper"},
    "grid": {"inlet": -4.5, "outlet": 1.5, "side": 3.0},
}


def problem_of(nodes):
    case = Case.from_dict(BALL).replace({"grid.nodes": nodes})
    return replace(point_film_problem(case, resolve_point(case)), wedge_order=2)


@pytest.mark.slow
@pytest.mark.gate
def test_a_steady_film_stays():
    """With steps of one spacing the time steps are the steady scheme."""
    problem = problem_of(65)
    start = steady(problem)
    now = last(problem, ridge(0.0, 1.0, 0.0), start.level.mesh.dx, 10, start=start)
    np.testing.assert_allclose(now.state.thickness, start.state.thickness, rtol=0.0, atol=1e-9)
    np.testing.assert_allclose(now.state.pressure, start.state.pressure, rtol=0.0, atol=1e-8)


@pytest.mark.slow
def test_order_in_time():
    """On one grid, steps of 4, 2 and 1 spacings while a broad ridge comes to the centre."""
    problem, n = problem_of(65), 64
    start = steady(problem)
    inside = np.hypot(start.level.mesh.x[:, np.newaxis], start.level.mesh.y) < 0.6
    films = []
    for courant in (4, 2, 1):
        step, steps = 6.0 * courant / n, n // (2 * courant)
        now = last(problem, ridge(0.05, 0.6, -step * steps), step, steps, start=start)
        films.append(now.state.thickness[inside])
    differences = np.max(np.abs(np.diff(films, axis=0)), axis=1)
    assert np.log2(differences[0] / differences[1]) == pytest.approx(2.0, abs=0.3)
