"""Resistance of spots: published numbers, limits, and clusters over a disc."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ehlectric.formulas.asperities import (
    cluster_resistance,
    film_resistance,
    greenwood_cluster,
    holm_resistance,
    sharvin_resistance,
    spot_resistance,
)

STEEL = 2.2e-7


def disc(count, radius):
    """Points of equal density over a disc: a sunflower."""
    k = np.arange(count) + 0.5
    angle = np.pi * (1.0 + np.sqrt(5.0)) * k
    return radius * np.sqrt(k / count)[:, np.newaxis] * np.column_stack([np.cos(angle), np.sin(angle)])


def test_one_spot_of_bearing_steel():
    radii = np.array([0.1, 0.5, 1.0, 5.0]) * 1e-6
    exact = [1.1, 0.22, 0.11, 0.022]
    np.testing.assert_allclose(holm_resistance(radii, STEEL), exact, rtol=1e-12)
    np.testing.assert_allclose(spot_resistance(radii, STEEL), exact, rtol=1e-12)
    for radius, resistance in zip(radii, exact, strict=True):
        assert greenwood_cluster([[3.0, 4.0]], [radius], STEEL) == pytest.approx(resistance, rel=1e-12)
        assert cluster_resistance([[3.0, 4.0]], [radius], STEEL) == pytest.approx(resistance, rel=1e-12)


def test_two_spots():
    spots = [1e-6, 1e-6]
    for cluster in (greenwood_cluster, cluster_resistance):
        assert cluster([[0.0, 0.0], [1.0, 0.0]], spots, STEEL) == pytest.approx(0.055, rel=1e-5)
        near = cluster([[0.0, 0.0], [4e-6, 0.0]], spots, STEEL)
        assert near == pytest.approx(0.055 + STEEL / (2.0 * np.pi * 4e-6), rel=1e-12)


@pytest.mark.slow
@pytest.mark.gate
def test_many_spots_over_a_disc():
    """Equal voltages: the resistance of the disc, rho/(2 alpha). Equal currents: 32/(3 pi^2) of it."""
    count, alpha = 2500, 1e-4
    at, a = disc(count, alpha), np.full(count, 1e-6 / 2.5)
    own = STEEL / (2.0 * np.sum(a))
    whole = STEEL / (2.0 * alpha)
    assert cluster_resistance(at, a, STEEL) - own == pytest.approx(whole, rel=0.05)
    assert greenwood_cluster(at, a, STEEL) - own == pytest.approx(32.0 / (3.0 * np.pi**2) * whole, rel=0.03)


@given(st.integers(0, 1000), st.integers(2, 30))
def test_bounds_of_a_cluster(seed, count):
    rng = np.random.default_rng(seed)
    side = int(np.ceil(np.sqrt(count)))
    grid = np.stack(np.meshgrid(np.arange(side), np.arange(side)), axis=-1).reshape(-1, 2)[:count]
    a = rng.uniform(0.05, 0.3, count) * 1e-6
    at = (grid + rng.uniform(-0.15, 0.15, grid.shape)) * 1e-6
    solved, greenwood = cluster_resistance(at, a, STEEL), greenwood_cluster(at, a, STEEL)
    parallel = STEEL / (2.0 * np.sum(a))
    assert parallel < solved <= greenwood * (1.0 + 1e-12)
    assert solved < float(holm_resistance(a.max(), STEEL))
    # Twice all lengths: half the resistance.
    assert cluster_resistance(2 * at, 2 * a, STEEL) == pytest.approx(0.5 * solved, rel=1e-9)
    assert greenwood_cluster(2 * at, 2 * a, STEEL) == pytest.approx(0.5 * greenwood, rel=1e-9)


def test_rows_of_a_large_cluster():
    at, a = disc(1300, 1e-4), np.linspace(1e-7, 5e-7, 1300)
    inverse = 1.0 / (np.hypot(*(at[:, np.newaxis] - at).T) + np.diag(np.full(1300, np.inf)))
    exact = STEEL / (2 * a.sum()) + STEEL / np.pi * (a @ inverse @ a) / a.sum() ** 2
    assert greenwood_cluster(at, a, STEEL) == pytest.approx(exact, rel=1e-10)


def test_small_spots():
    """A spot far below the mean free path has Sharvin's resistance; in between it is near the sum."""
    path = 2e-9
    tiny = float(spot_resistance(path / 1e4, STEEL, path))
    assert tiny == pytest.approx(float(sharvin_resistance(path / 1e4, STEEL, path)), rel=1e-4)
    radii = path / np.geomspace(1e-3, 1e3, 200)
    plain = holm_resistance(radii, STEEL) + sharvin_resistance(radii, STEEL, path)
    below = 1.0 - spot_resistance(radii, STEEL, path) / plain
    assert 0.10 < below.max() < 0.12
    assert below.min() > 0.0
    # Both parts are equal where 8 l = 3 pi a.
    same = 8.0 * path / (3.0 * np.pi)
    assert float(sharvin_resistance(same, STEEL, path)) == pytest.approx(float(holm_resistance(same, STEEL)))


def test_film_over_the_spots():
    assert film_resistance([1e-12, 2e-12], 5e-9).tolist() == [5e3, 2.5e3]
