"""Areal filter, form, statistics, voids and continuation of maps against exact values."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ehlectric import InputError
from ehlectric.surfaces.maps import Map, filled, processed_map, statistics, trimmed, waviness, without_form
from ehlectric.surfaces.profiles import Processing, Profile
from ehlectric.surfaces.profiles import processed as of_profile
from ehlectric.surfaces.rough_surfaces import continued_map
from tests.helpers.each import each

CUTOFF = 20e-6
DX, DY = 0.5e-6, 0.7e-6


def mapped(function, nx=241, ny=181, dx=DX, dy=DY):
    """A map of a function of (x, y)."""
    points = Map(dx, dy, np.empty((nx, ny)))
    return points.with_heights(function(points.x[:, np.newaxis], points.y) + np.zeros((nx, ny)))


def level(height):
    return lambda x, y: height + 0.0 * x * y


@each("direction", [0.0, 90.0, 45.0, 160.0])
@each("ratio", np.geomspace(0.3, 3.0, 9))
def test_filter_transmits_as_the_standard_says(ratio, direction):
    """exp(-pi (alpha cutoff/wavelength)^2), one half at the cutoff, whatever the direction (ISO 16610-61)."""
    q = 2 * np.pi / (ratio * CUTOFF) * np.exp(1j * np.deg2rad(direction))
    surface = mapped(lambda x, y: np.cos(q.real * x + q.imag * y))
    exact = 0.5 ** ((1 / ratio) ** 2)
    assert waviness(surface, CUTOFF).heights[120, 90] == pytest.approx(exact, abs=5e-3 * max(exact, 0.01))


def test_filter_keeps_what_is_constant():
    np.testing.assert_allclose(waviness(mapped(level(3.0)), CUTOFF).heights, 3.0, rtol=1e-12)


@each("cutoff", [4 * DX, 3.9 * DY, 126.1e-6, 1e-2])
def test_cutoffs_that_cannot_be(cutoff):
    """Four of the wider spacings at the least, the shorter side at the most: 180 times 0.7 um."""
    with pytest.raises(InputError, match="cutoff: got"):
        waviness(mapped(level(0.0)), cutoff)
    waviness(mapped(level(0.0)), 4.001 * DY)
    waviness(mapped(level(0.0)), 119.9e-6)


@pytest.mark.slow
@given(st.lists(st.floats(-1.0, 1.0), min_size=6, max_size=6))
def test_form_removal_is_exact_for_its_own_form(coefficients):
    c, length = coefficients, 1e-4
    terms = {"mean": 1, "line": 3, "parabola": 6}
    for form, n in terms.items():

        def quadric(x, y, n=n):
            x, y = x / length, y / length
            return sum(a * b for a, b in zip(c[:n], (1.0, x, y, x * x, x * y, y * y), strict=False))

        left = without_form(mapped(quadric, 41, 33), form)
        np.testing.assert_allclose(left.heights, 0.0, atol=1e-12)


def test_form_is_that_of_least_squares():
    """Against the normal equations of all points, and a cubic is left alone by a quadric but for its fit."""
    z = np.random.default_rng(1).standard_normal((40, 27))
    surface = Map(1e-6, 3e-6, z)
    x, y = (axis.ravel() / 1e-5 for axis in np.meshgrid(surface.x, surface.y, indexing="ij"))
    for form, terms in (("line", [x**0, x, y]), ("parabola", [x**0, x, y, x * x, x * y, y * y])):
        fit = np.linalg.lstsq(np.column_stack(terms), z.ravel(), rcond=None)[0] @ terms
        np.testing.assert_allclose(without_form(surface, form).heights, z - fit.reshape(z.shape), atol=1e-12)


def test_statistics_of_crossed_waves():
    """sin(p x) sin(q y): Sq = a/2, Sa = (2/pi)^2 a, Ssk = 0, Sku = 9/4, rms slope a sqrt(p^2 + q^2)/2.

    Differences of neighbours see 2 sin(p d/2)/d in place of p.
    """
    a, nx, ny = 1e-7, 1600, 1500
    p, q = 2 * np.pi / (40 * DX), 2 * np.pi / (50 * DY)
    x, y = DX * np.arange(nx)[:, np.newaxis], DY * np.arange(ny)
    s = statistics(Map(DX, DY, a * np.sin(p * x) * np.sin(q * y)))
    assert s.sq == pytest.approx(a / 2, rel=1e-9, abs=0.0)
    assert s.sa == pytest.approx((2 / np.pi) ** 2 * a, rel=5e-3, abs=0.0)
    assert s.ssk == pytest.approx(0.0, abs=1e-9)
    assert s.sku == pytest.approx(2.25, rel=1e-9, abs=0.0)
    seen = 2 * np.sin(p * DX / 2) / DX, 2 * np.sin(q * DY / 2) / DY
    assert s.rms_slope == pytest.approx(a * np.hypot(*seen) / 2, rel=2e-3, abs=0.0)
    assert s.largest_slope == pytest.approx(a * max(seen), rel=5e-3, abs=0.0)
    # The autocorrelation cos(p d) falls to 1/e at acos(1/e)/p; a lag leaves some thirty periods, not whole.
    assert s.correlation_length_x == pytest.approx(np.arccos(1 / np.e) / p, rel=0.02, abs=0.0)
    assert s.correlation_length_y == pytest.approx(np.arccos(1 / np.e) / q, rel=0.02, abs=0.0)


@each("direction", [0.0, 30.0, 90.0, 135.0])
def test_the_shortest_correlation_length_lies_across_the_ridges(direction):
    """Of a plane wave: acos(1/e)/q across its ridges, longer by the cosine along the axes."""
    q = 2 * np.pi / 12e-6
    c, s = np.cos(np.deg2rad(direction)), np.sin(np.deg2rad(direction))
    found = statistics(mapped(lambda x, y: np.sin(q * (c * x + s * y)), 600, 500))
    across = np.arccos(1 / np.e) / q
    assert found.correlation_length == pytest.approx(across, rel=0.02, abs=0.0)
    if abs(c * s) > 1e-9:
        assert found.correlation_length_x == pytest.approx(across / abs(c), rel=0.03, abs=0.0)
        assert found.correlation_length_y == pytest.approx(across / abs(s), rel=0.03, abs=0.0)


def test_a_flat_map_has_no_roughness():
    flat = mapped(level(0.1), 40, 30)
    s = statistics(without_form(flat, "parabola"))
    assert max(s.sq, s.sa) < 1e-15
    s = statistics(Map(DX, DY, np.zeros((40, 30))))
    assert (s.sq, s.ssk, s.sku, s.correlation_length_x) == (0.0, 0.0, 0.0, 39 * DX)
    with pytest.raises(InputError, match=r"rescale_rq: .*flat"):
        processed_map(flat, Processing("mean", rescale_rq=1e-8))


def test_smallest_maps_have_statistics():
    s = statistics(Map(1e-6, 1e-6, np.array([[0.0, 1e-7], [0.0, 1e-7]])))
    assert (s.sq, s.sku, s.rms_slope) == pytest.approx((5e-8, 1.0, 0.1))
    assert all(np.isfinite(list(vars(s).values())))


def test_steps_are_those_of_a_profile():
    """Ridges along y go through every step as their profile does, where no step looks at the sides."""
    z = 1e-7 * np.random.default_rng(0).standard_normal(900).cumsum() / 10
    steps = Processing("parabola", 80e-6, 10e-6, None, 5e-8, 6e-8)
    profiles = of_profile(Profile(1e-6, z), steps)
    maps = processed_map(Map(1e-6, 2e-6, np.repeat(z[:, np.newaxis], 120, axis=1)), steps)
    assert [name for name, _ in maps] == [name for name, _ in profiles]
    for (_, surface), (_, profile) in zip(maps, profiles, strict=True):
        expected = np.broadcast_to(profile.heights[:, np.newaxis], surface.heights.shape)
        np.testing.assert_allclose(surface.heights, expected, rtol=0.0, atol=1e-15)
    assert maps[4][1].heights.shape == (900 - 80, 120 - 40)


def test_trim_that_leaves_nothing():
    with pytest.raises(InputError, match=r" 1 x 9 .* 241 x 181"):
        trimmed(mapped(level(0.0)), 60.2e-6)


@pytest.mark.parametrize("seed", range(3))
def test_voids_are_filled_by_a_harmonic_function(seed):
    """x^2 - y^2 and x y have no Laplacian, true or discrete: inner voids give them back."""
    random = np.random.default_rng(seed)
    surface = mapped(lambda x, y: 0.1 + 1e3 * (x * x - y * y) + 700 * x * y + 0.02 * x, 90, 70)
    holed = surface.heights.copy()
    inner = holed[1:-1, 1:-1]
    inner[random.random(inner.shape) < 0.1] = np.nan
    inner[20:45, 10:30] = np.nan
    found = filled(holed, DX, DY)
    np.testing.assert_array_equal(found[np.isfinite(holed)], surface.heights[np.isfinite(holed)])
    np.testing.assert_allclose(found, surface.heights, rtol=0.0, atol=1e-7 * np.ptp(surface.heights))


def test_voids_at_the_side_stay_within_the_heights_around_them():
    z = np.random.default_rng(0).random((30, 30))
    holed = z.copy()
    holed[:6, 4:20] = holed[25:, 25:] = np.nan
    found = filled(holed, 1.0, 2.0)
    assert np.isfinite(found).all()
    assert np.nanmin(holed) <= found.min() <= found.max() <= np.nanmax(holed)


@pytest.mark.parametrize("extend", ["mirror", "repeat", "flat"])
def test_continued_maps_have_no_step(extend):
    random = np.random.default_rng(4)
    surface = Map(1e-6, 2e-6, 1e-8 * random.standard_normal((150, 90)).cumsum(axis=0).cumsum(axis=1) / 10)
    height = continued_map(surface, extend)
    inner = np.ix_(range(40, 110), range(20, 70))
    here = height(surface.x[:, np.newaxis] + 0 * surface.y, surface.y + 0 * surface.x[:, np.newaxis])
    np.testing.assert_allclose(here[inner], surface.heights[inner], rtol=0.0, atol=1e-18)
    along = np.linspace(-3.1e-4, 3.1e-4, 8001)
    within = np.linspace(-5e-5, 5e-5, 1291)
    for start in (-3e-5, 0.0, 5.7e-5):
        inside = max(
            np.max(np.abs(np.diff(height(within, np.full_like(within, start))))),
            np.max(np.abs(np.diff(height(np.full_like(within, start), within)))),
        )
        for path in (
            (along, np.full_like(along, start)),
            (np.full_like(along, start), along),
            (along, along),
        ):
            # Along the diagonal both differ; blending over 5 % may be steeper than what is blended.
            assert np.max(np.abs(np.diff(height(*path)))) < 6.0 * inside


def test_continued_maps_are_what_they_are_called():
    surface = mapped(lambda x, y: np.cos(1e5 * x + 1) * np.sin(8e4 * y), 101, 81)
    lx, ly = surface.length_x, surface.length_y
    x, y = np.random.default_rng(0).uniform(-0.5, 0.5, (2, 500))
    mirror, repeat, flat = (continued_map(surface, extend) for extend in ("mirror", "repeat", "flat"))
    reflected = mirror((1 - x) * lx, (-1 - y) * ly)
    np.testing.assert_allclose(reflected, mirror(x * lx, y * ly), rtol=0.0, atol=1e-12)
    np.testing.assert_allclose(
        repeat((x + 3) * lx, (y - 2) * ly), repeat(x * lx, y * ly), rtol=0.0, atol=1e-12
    )
    outside = np.array([0.5001, -0.7, 0.0, 9.0]), np.array([0.0, 0.3, -0.501, 9.0])
    assert np.all(flat(outside[0] * lx, outside[1] * ly) == 0.0)
    # A cubic spline between the points: (q d)^4/384 of a wave; the sides are felt 0.27 times less a point.
    middle = (np.abs(x) < 0.3) & (np.abs(y) < 0.3)
    exact = np.cos(1e5 * x * lx + 1) * np.sin(8e4 * y * ly)
    error = np.abs(mirror(x * lx, y * ly) - exact)[middle]
    assert np.max(error) < 4 * (1e5 * DX) ** 4 / 384 + 4 * (8e4 * DY) ** 4 / 384
