"""Oil in the spots of surfaces that touch: it follows from the gap, and takes few steps of the whole film."""

from dataclasses import replace

import numpy as np
import pytest

from ehlectric.film.touching_film import assess_touching, with_oil_step
from ehlectric.film.touching_newton import is_solved
from tests.film.test_one_solution import from_dry, rounded
from tests.helpers.mixed_films import gaussian, mixed_film, posed, rough_line, rough_point

# At these speeds [m/s] the film of smooth surfaces is a thirtieth of the roughness.
NEARLY_DRY, SPEED = gaussian(50e-9, 20e-6, seed=4), 1.832e-4
BALL = rough_point(gaussian(50e-9, 30e-6), speed=6.725e-4)


def test_ends_of_cavities_move_through_spots_without_steps_of_the_whole_film():
    """Ends of cavities cross hundreds of nodes in contact, one after the other."""
    shares = []
    for nodes in (1601, 3201):
        film = mixed_film(rough_line(NEARLY_DRY, nodes=nodes, speed=SPEED))
        assert film.converged
        assert film.last.content is not None
        assert film.touching.sum() > nodes / 8
        assert film.steps < 25
        shares.append(film.share)
    assert shares[0] == pytest.approx(shares[1], rel=0.02)


def test_oil_of_spots_is_solved_at_a_given_gap():
    """From another pressure of the oil in the spots, steps of the oil alone lead back to the film."""
    film = mixed_film(rough_line(NEARLY_DRY, nodes=801, speed=SPEED))
    level, fluid, asperities = film.last.level, film.problem.fluid, film.problem.asperities
    state, carried = film.last.state, film.last.content
    contact = film.touching
    random = np.random.default_rng(1)
    ambient = fluid.ambient_pressure
    factor = np.where(contact, 1.0 + 0.1 * random.random(contact.shape), 1.0)
    oil = np.minimum(ambient + factor * (film.oil_pressure - ambient), state.pressure)
    moved = replace(state, contact_pressure=state.pressure - oil)
    now = assess_touching(fluid, level, moved, asperities, carried)
    assert not is_solved(now, film.problem.tolerance)
    for _ in range(30):
        moved = with_oil_step(fluid, level, moved, now)
        now = assess_touching(fluid, level, moved, asperities, now.carried)
    assert is_solved(now, film.problem.tolerance)
    np.testing.assert_allclose(moved.oil_pressure, film.oil_pressure, atol=1e-6)


def test_oil_of_cavities_that_count_as_full_stays():
    """Without oil in its cavities, the oil of a film is not solved by itself."""
    film = mixed_film(rough_line(NEARLY_DRY, nodes=801, speed=SPEED))
    problem, state = film.problem, film.last.state
    now = assess_touching(problem.fluid, film.last.level, state, problem.asperities)
    assert now.carried is None
    assert with_oil_step(problem.fluid, film.last.level, state, now) is state


@pytest.mark.slow
@pytest.mark.gate
def test_a_ball_with_hardly_any_oil_has_one_film():
    """Balances of single nodes in its spots have minima, beside which Newton's method alternates."""
    problem = posed(BALL)
    usual = mixed_film(problem)
    assert usual.converged
    assert usual.last.content.supply.scheme.continuous
    for film in (from_dry(problem), mixed_film(rounded(problem))):
        assert film.converged
        assert film.share == pytest.approx(usual.share, rel=1e-6)
        np.testing.assert_allclose(film.gap, usual.gap, rtol=1e-5)
