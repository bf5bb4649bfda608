"""Films of many rough contacts whose surfaces may touch: how many converge."""

from itertools import product

import numpy as np
import pytest
from benchmarks.mixed import surfaces
from benchmarks.mixed_store import composite_roughness

from tests.helpers.gate import gated
from tests.helpers.mixed_films import at_film, gaussian, mixed_film, rough_line, rough_point, sinusoid
from tests.helpers.share import share, share_of

pytestmark = pytest.mark.convergence

LINES = surfaces(point=False)
POINTS = surfaces(point=True)


def at_lambda(case, ratio):
    return mixed_film(at_film(case, ratio * composite_roughness(case)))


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "nodes"), [("gaussian 400 nm", 3201), ("sinusoid 140 nm", 1601), ("asperity 200 nm", 1601)]
)
def test_line_with_a_thin_film(name, nodes):
    """Where the film of the formula is 3 % of the roughness, ridges float on grids that resolve them.

    On 801 nodes most of the load is on asperities. Of the Gaussian surface asperities have 6 % of the load on
    1601 nodes, 16 % on 2401 and 2 % on 3201: a warning says that the share is not resolved.
    """
    film = at_lambda(rough_line(LINES[name], nodes=nodes), 0.03)
    assert film.converged
    assert film.share < 0.05


@pytest.mark.slow
@pytest.mark.parametrize(("name", "ratio"), [("gaussian 100 nm", 0.1), ("asperity 100 nm", 0.3)])
def test_point_with_a_thin_film(name, ratio):
    film = at_lambda(rough_point(POINTS[name]), ratio)
    assert film.converged
    assert film.share < 0.4


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "ratio"), gated(share(list(product(LINES, [3.0, 1.0, 0.3])), 2), ("gaussian 100 nm", 1.0))
)
def test_lines_of_every_surface(name, ratio):
    """Made and measured surfaces on 3201 nodes, down to a film of a third of the roughness."""
    film = at_lambda(rough_line(LINES[name], nodes=3201), ratio)
    assert film.converged
    assert film.oil[0] < 1e-4
    assert film.share < 0.1


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "ratio"), gated([("gaussian 400 nm", 1.0), ("sinusoid 140 nm", 1.0)], ("gaussian 400 nm", 1.0))
)
def test_films_that_conserve_their_oil_agree_on_fine_grids(name, ratio):
    """A film whose cavities count as full is twice as thick over the Gaussian surface."""
    films = [at_lambda(rough_line(LINES[name], nodes=nodes), ratio) for nodes in (801, 1601, 3201)]
    means = []
    for film in films:
        assert film.converged
        assert film.last.content is not None
        means.append(float(np.mean(film.gap[film.zone])))
    assert means[0] == pytest.approx(means[2], rel=0.015, abs=0.0)
    assert means[1] == pytest.approx(means[2], rel=0.006, abs=0.0)


@pytest.mark.slow
@pytest.mark.parametrize(("name", "ratio"), share(list(product(POINTS, [1.0, 0.3, 0.1])), 2))
def test_points_of_every_surface(name, ratio):
    film = at_lambda(rough_point(POINTS[name]), ratio)
    assert film.converged
    assert film.oil[0] < 1e-4


def drawn(rng):
    """Random rough line contact from hardly any film to a thick one."""
    height, wave = rng.uniform(30e-9, 300e-9), rng.uniform(10e-6, 60e-6)
    table = gaussian(height, wave, seed=int(rng.integers(1000)))
    if rng.random() < 0.5:
        table = sinusoid(height, 2.0 * wave, phase=float(rng.uniform(0.0, 6.0)))
    speed, boundary_film = 10.0 ** rng.uniform(-4.0, 0.5), 10.0 ** rng.uniform(-9.3, -8.3)
    return rough_line(table, nodes=201, speed=speed, boundary_film=boundary_film)


@pytest.mark.slow
def test_random_lines_converge():
    """All but 5 % of a hundred, or of twenty, of which more than a third touch."""
    rng = np.random.default_rng(20)
    films = [mixed_film(drawn(rng)) for _ in range(share_of(100, 5))]
    assert np.mean([film.converged for film in films]) >= 0.95
    assert np.mean([film.touching.any() for film in films]) > 0.33
