"""Where cavitation is decided: the complementarity condition of a solved film, and what decides it."""

import numpy as np

from ehlectric.film.cavitation import full_film_nodes
from ehlectric.film.nested import nested_iteration
from ehlectric.film.newton import assess
from tests.film import exact_film as exact


def decided(excess, residual, *, thickness=1.0, inner=True):
    values = (np.atleast_1d(np.asarray(value, dtype=float)) for value in (excess, residual))
    full = full_film_nodes(
        *values,
        poiseuille=np.array([1e-3]),
        rate=1.0,
        thickness=np.array([thickness]),
        inner=np.array([inner]),
    )
    return bool(full[0])


def test_pressure_against_the_residual():
    """A pressure above ambient resists a small residual, not a large one; 1/c is 20 H here."""
    assert decided(0.1, 1.9)
    assert not decided(0.1, 2.1)
    assert not decided(0.1, 1.9, thickness=0.5)
    assert decided(-0.1, -2.1)
    assert not decided(-0.1, -1.9)


def test_edges_of_the_domain_are_at_ambient_pressure():
    assert not decided(1.0, -1.0, inner=False)


def test_solved_film_fulfils_the_complementarity_condition():
    """P >= P_amb and r = 0 in the full film; P = P_amb and r >= 0 at the cavitated nodes."""
    problem = exact.problem(401, wedge_order=2)
    solution = nested_iteration(problem, None)[-1]
    full, excess = solution.final.full_film, solution.state.pressure - problem.fluid.ambient_pressure
    cavitated = ~full & solution.level.mesh.inner
    assert np.all(excess[full] >= -1e-9)
    assert np.max(np.abs(solution.final.scaled[full])) < 1e-9
    assert np.all(np.abs(excess[cavitated]) < 1e-9)
    assert np.all(solution.final.reynolds[cavitated] >= -1e-9)
    again = assess(problem.fluid, solution.level, solution.state)
    np.testing.assert_array_equal(again.full_film, full)
