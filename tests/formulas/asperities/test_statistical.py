"""Models of Greenwood: factors by Hertz contacts of drawn summits, limits, and dependence on separation."""

from dataclasses import replace

import numpy as np
import pytest
from benchmarks.greenwood_tripp import greenwood_tripp
from hypothesis import given
from hypothesis import strategies as st
from scipy import integrate, ndimage, stats

from ehlectric.formulas.asperities import Summits, greenwood_williamson, map_moments, summit_separation
from ehlectric.surfaces import generated_maps

MODELS = {"greenwood_tripp": greenwood_tripp, "greenwood_williamson": greenwood_williamson}

ROUGH = Summits(density=2e11, radius=2e-6, height_deviation=100e-9)
MODULUS = 226e9
BODY = 0.5 * MODULUS  # E* of the formulas by Hertz


def hertz(overlap, radius):
    """Load, area and number of the contacts of caps that overlap."""
    pressed = np.maximum(overlap, 0.0)
    load = 4.0 / 3.0 * BODY * np.sqrt(radius) * pressed**1.5
    return np.array([load, np.pi * radius * pressed, np.asarray(overlap > 0.0, dtype=float)])


def parts(contact):
    return np.array([contact.pressure, contact.area_fraction, contact.spots_per_area])


@pytest.mark.parametrize("level", [0.0, 1.0, 2.5])
def test_rough_against_flat_is_a_sum_of_hertz_contacts(level):
    """Heights at the middles of small classes, each cap pressed by the flat."""
    edges = np.linspace(-9.0, 9.0, 360_001)
    share = np.diff(stats.norm.cdf(-edges[::-1]))[::-1]
    heights = ROUGH.height_deviation * 0.5 * (edges[1:] + edges[:-1])
    each = hertz(heights - level * ROUGH.height_deviation, ROUGH.radius)
    expected = ROUGH.density * each @ share
    found = parts(greenwood_williamson(level * ROUGH.height_deviation, ROUGH, MODULUS))
    assert found == pytest.approx(expected, rel=1e-6)


@pytest.mark.slow
@pytest.mark.parametrize("level", [0.0, 1.0, 2.5])
def test_two_rough_surfaces_are_an_integral_over_the_offset(level):
    """Caps at the offset r overlap less by r^2/(4 beta) and have the reduced radius beta/2."""
    sigma, beta, n = ROUGH.height_deviation, ROUGH.radius, ROUGH.density
    for part, found in enumerate(parts(greenwood_tripp(level * sigma, ROUGH, MODULUS))):

        def at_offset(r, part=part):
            lowest = level + r**2 / (4.0 * beta * sigma)

            def at_height(s):
                overlap = max(s - lowest, 1e-300)
                return float(hertz(overlap * sigma, 0.5 * beta)[part]) * stats.norm.pdf(s)

            return 2.0 * np.pi * r * n**2 * integrate.quad(at_height, lowest, lowest + 9.0, limit=200)[0]

        farthest = np.sqrt(4.0 * beta * sigma * 7.0)
        expected = integrate.quad(at_offset, 0.0, farthest, epsrel=1e-7, limit=100)[0]
        assert float(found) == pytest.approx(expected, rel=1e-5)


@pytest.mark.slow
@pytest.mark.parametrize("model", MODELS.values(), ids=MODELS)
@given(levels=st.lists(st.integers(-200, 800).map(lambda k: k / 100), min_size=2, max_size=6, unique=True))
def test_contact_falls_with_separation(model, levels):
    found = model(np.sort(levels) * ROUGH.height_deviation, ROUGH, MODULUS)
    for values in parts(found):
        assert np.all(values > 0.0)
        assert np.all(np.diff(values) < 0.0)


@pytest.mark.parametrize(("model", "power"), [(greenwood_tripp, 1.0), (greenwood_williamson, 0.0)])
@given(scale=st.floats(0.1, 10.0))
def test_scale_of_heights_and_lengths(model, power, scale):
    """Twice all lengths: the same pressure and area, a quarter of the spots per area."""
    larger = Summits(
        density=ROUGH.density / scale**2,
        radius=ROUGH.radius * scale,
        height_deviation=ROUGH.height_deviation * scale,
    )
    one, other = model(1e-7, ROUGH, MODULUS), model(1e-7 * scale, larger, MODULUS)
    assert float(other.pressure) == pytest.approx(float(one.pressure), rel=1e-10)
    assert float(other.area_fraction) == pytest.approx(float(one.area_fraction), rel=1e-10)
    assert float(other.spots_per_area) == pytest.approx(float(one.spots_per_area) / scale**2, rel=1e-10)
    # Pairs of caps meet with the square of the density, caps and a flat with the density.
    denser = Summits(
        density=ROUGH.density * scale, radius=ROUGH.radius, height_deviation=ROUGH.height_deviation
    )
    ratio = float(model(1e-7, denser, MODULUS).pressure / one.pressure)
    assert ratio == pytest.approx(scale ** (1.0 + power), rel=1e-10)


def test_pressure_over_area_hardly_depends_on_separation():
    """The finding of Greenwood and Williamson: real area grows in proportion to load."""
    found = greenwood_williamson(np.array([1.0, 3.0]) * ROUGH.height_deviation, ROUGH, MODULUS)
    real = found.pressure / found.area_fraction
    assert found.pressure[0] / found.pressure[1] > 100.0
    assert real[0] / real[1] < 1.4


@pytest.mark.parametrize("model", MODELS.values(), ids=MODELS)
def test_nothing_touches_above_the_highest_summit(model):
    worn = replace(ROUGH, highest=2.0)
    above, below = (parts(model(level * ROUGH.height_deviation, worn, MODULUS)) for level in (2.01, 1.0))
    assert np.all(above == 0.0)
    assert np.all((below > 0.0) & (below <= parts(model(ROUGH.height_deviation, ROUGH, MODULUS))))


def test_summits_lie_above_the_mean_plane():
    lifted = 5e-7 - summit_separation([5e-7, 5e-7], 1e-7, np.array([4.0 / np.pi * 4.0, 1e12]))
    np.testing.assert_allclose(lifted, [1e-7, 0.0], atol=1e-12)


def test_spots_of_a_generated_map():
    """Peaks of a map above a plane, in number those of Greenwood and Williamson; below they merge."""
    made = generated_maps.gaussian(rq=1e-7, correlation_length=1e-5, reach_x=8e-4, reach_y=8e-4, seed=2)
    z, d = made.heights - made.heights.mean(), made.spacing_x
    peaks = np.where(z == ndimage.maximum_filter(z, 3), z, -np.inf)[1:-1, 1:-1]
    area = peaks.size * d**2
    moments = map_moments(z, d, d).isotropic
    for level, tolerance in ((1.0, 0.04), (2.0, 0.06), (2.5, 0.1), (3.0, 0.25)):
        height = level * moments.rq
        separation = summit_separation(height, moments.rq, moments.bandwidth)
        expected = float(greenwood_williamson(separation, moments.summits(), MODULUS).spots_per_area) * area
        assert np.sum(peaks > height) == pytest.approx(expected, rel=tolerance)
        patches = ndimage.label(z > height)[1]
        assert patches == pytest.approx(expected, rel=0.1) if level >= 2.0 else patches < 0.8 * expected
