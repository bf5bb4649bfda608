"""Made maps: their variance, correlation, spectrum and shapes against theory, and one seed one surface."""

from functools import partial
from itertools import pairwise

import numpy as np
import pytest

from ehlectric import InputError
from ehlectric.surfaces import generated_maps as map_generators
from ehlectric.surfaces import generated_profiles as generators
from ehlectric.surfaces.maps import statistics

X = np.linspace(-4e-5, 3e-5, 71)

GAUSSIAN = partial(map_generators.gaussian, rq=1e-8, correlation_length=5e-6)
RIDGES = partial(GAUSSIAN, correlation_length_y=2e-5)
SELF_AFFINE = partial(map_generators.self_affine, rq=1e-8, hurst=0.6, rolloff_wavelength=2e-5, shortest=2e-6)


@pytest.mark.slow
@pytest.mark.parametrize(("make", "across"), [(GAUSSIAN, 5e-6), (RIDGES, 2e-5)], ids=["round", "ridges"])
def test_gaussian_maps_are_as_asked(make, across):
    """Rq is that of all such maps: the integral of the squared autocorrelation is pi lx ly/2, so that a map
    of the area A has A/(that) independent heights, and one of n is within 1/sqrt(2 n) of it."""
    one, same, other = (make(reach_x=6e-4, reach_y=5e-4, seed=seed) for seed in (1, 1, 2))
    np.testing.assert_array_equal(one.heights, same.heights)
    n = one.length_x * one.length_y / (0.5 * np.pi * 5e-6 * across)
    assert np.corrcoef(one.heights.ravel(), other.heights.ravel())[0, 1] == pytest.approx(0.0, abs=4 / n**0.5)
    assert np.sqrt(np.mean(one.heights**2)) == pytest.approx(1e-8, rel=4 / np.sqrt(2 * n))
    s = statistics(one)
    assert s.correlation_length_x == pytest.approx(5e-6, rel=0.04, abs=0.0)
    assert s.correlation_length_y == pytest.approx(across, rel=0.04, abs=0.0)
    assert s.correlation_length == pytest.approx(5e-6, rel=0.04, abs=0.0)
    assert s.sku == pytest.approx(3.0, abs=4 * np.sqrt(24 / n))
    # The curvature of the autocorrelation at zero gives the slopes, sqrt(2) rq/l along either axis; the
    # difference of neighbours, an eighth of l apart, sees 0.996 of it.
    exact = np.sqrt(2) * 1e-8 * np.hypot(1 / 5e-6, 1 / across)
    assert s.rms_slope == pytest.approx(exact, rel=4 / np.sqrt(2 * n) + 0.005)


@pytest.mark.slow
def test_many_small_maps_have_the_variance_of_theory():
    """What a single point has over 200 seeds: within four standard errors, 1/sqrt(2 n) each."""
    for make in (GAUSSIAN, partial(SELF_AFFINE, shortest=4e-6)):
        heights = [make(reach_x=0.0, reach_y=0.0, seed=seed).heights[0, 0] for seed in range(200)]
        assert np.sqrt(np.mean(np.square(heights))) == pytest.approx(1e-8, rel=4 / np.sqrt(400))


@pytest.mark.slow
@pytest.mark.parametrize("hurst", [0.3, 0.8])
def test_self_affine_spectrum_has_its_slope(hurst):
    """The power falls as q^(-2 - 2 hurst) between roll-off and the shortest wave, alike in all directions."""
    made = SELF_AFFINE(hurst=hurst, reach_x=2.5e-4, reach_y=2e-4, seed=3)
    z = made.heights
    power = np.abs(np.fft.fft2(z * np.outer(*(np.hanning(n) for n in z.shape)))) ** 2
    qx, qy = (np.fft.fftfreq(n, d) for n, d in zip(z.shape, (made.spacing_x, made.spacing_y), strict=True))
    q = np.hypot(qx[:, np.newaxis], qy)
    edges = np.geomspace(1.2 / 2e-5, 0.95 / 2e-6, 9)
    steep = np.abs(qx[:, np.newaxis]) > np.abs(qy) + 0 * q
    for part in (q > 0, steep, ~steep):
        mean = [np.mean(power[part & (q >= a) & (q < b)]) for a, b in pairwise(edges)]
        slope = np.polyfit(np.log(np.sqrt(edges[1:] * edges[:-1])), np.log(mean), 1)[0]
        assert slope == pytest.approx(-2 - 2 * hurst, abs=0.1)
    # Flat below the roll-off: as much power an area of the (qx, qy) plane in either half of it.
    low = [np.mean(power[(q >= a / 2e-5) & (q < b / 2e-5)]) for a, b in ((0.15, 0.5), (0.5, 0.8))]
    assert low[0] == pytest.approx(low[1], rel=0.3, abs=0.0)
    assert np.max(power[q > 1.1 / 2e-6]) < 1e-4 * mean[-1]


@pytest.mark.slow
@pytest.mark.parametrize("make", [GAUSSIAN, RIDGES, SELF_AFFINE], ids=["round", "ridges", "self-affine"])
@pytest.mark.parametrize("reach", [(3e-4, 1.1e-4), (1.5e-4, 3.3e-4)])
def test_larger_maps_are_the_same_in_their_middle(make, reach):
    small, large = make(reach_x=1e-4, reach_y=8e-5, seed=7), make(reach_x=reach[0], reach_y=reach[1], seed=7)
    first = [(m - n) // 2 for n, m in zip(small.heights.shape, large.heights.shape, strict=True)]
    kept = tuple(slice(k, k + n) for k, n in zip(first, small.heights.shape, strict=True))
    np.testing.assert_allclose(large.heights[kept], small.heights, rtol=0.0, atol=1e-12 * 1e-8)
    np.testing.assert_allclose(large.x[kept[0]], small.x, rtol=0.0, atol=1e-15)
    np.testing.assert_allclose(large.y[kept[1]], small.y, rtol=0.0, atol=1e-15)


def test_other_seeds_and_places_are_other_surfaces():
    """No tile of noise is another's copy, whatever the signs of its place."""
    tiles = [map_generators._tile(i, j, seed) for i in (-2, -1, 0, 1) for j in (-1, 0, 2) for seed in (0, 1)]
    correlation = np.corrcoef([tile.ravel() for tile in tiles]) - np.eye(len(tiles))
    assert np.max(np.abs(correlation)) < 5 / map_generators._TILE


def test_shapes_cut_through_their_middle_are_those_of_profiles():
    pit = {"depth": 2e-8, "width": 1e-5, "rim": 4e-9}
    for name, values in (("pit", pit), ("asperity", {"height": 2e-8, "width": 1e-5})):
        there = {"position": 4e-6, "position_y": -7e-6}
        of_map = getattr(map_generators, name)
        expected = getattr(generators, name)(X, **values, position=4e-6)
        np.testing.assert_allclose(of_map(X, -7e-6, **values, **there), expected, rtol=0.0, atol=1e-22)
        # Round: the same at the same distance, in whatever direction.
        turned = of_map(4e-6 + (X - 4e-6) * 0.6, -7e-6 + (X - 4e-6) * 0.8, **values, **there)
        np.testing.assert_allclose(turned, expected, rtol=0.0, atol=1e-22)


def test_a_sinusoid_runs_along_its_orientation():
    """Counter-clockwise from the x axis: the crests lie on x cos 30 + y sin 30 = wavelength/4."""
    wave = partial(map_generators.sinusoid, amplitude=1e-8, wavelength=2e-5)
    np.testing.assert_array_equal(
        wave(X, 3e-6, phase=0.4), generators.sinusoid(X, amplitude=1e-8, wavelength=2e-5, phase=0.4)
    )
    c, s = np.cos(np.pi / 6), np.sin(np.pi / 6)
    crest = 5e-6 * c - X * s, 5e-6 * s + X * c
    np.testing.assert_allclose(wave(*crest, orientation=30.0), 1e-8, rtol=1e-12)
    np.testing.assert_allclose(wave(0.0, X, orientation=90.0), wave(X, 0.0), rtol=0.0, atol=1e-22)


def test_too_many_points_are_refused_before_they_are_made():
    with pytest.raises(InputError, match=r"correlation_length: .* 1606\d x 1606\d "):
        GAUSSIAN(correlation_length=1e-6, reach_x=1e-3, reach_y=1e-3, seed=1)
    for shortest, reach in ((1e-8, 1e-4), (1e-6, 1e-3)):
        with pytest.raises(InputError, match="shortest_wavelength: ") as caught:
            SELF_AFFINE(shortest=shortest, reach_x=reach, reach_y=reach, seed=1)
        assert "\n" not in str(caught.value)
