"""Amplitude reduction of waves, and of surfaces by their waves."""

import numpy as np
import pytest
from benchmarks.flattened_waves import flattened, line_amplitude_ratio, point_amplitude_ratio
from hypothesis import given
from hypothesis import strategies as st

from ehlectric.formulas.asperities import map_moments, profile_moments
from ehlectric.surfaces import generated_maps, generated_profiles
from tests.helpers.places import ROOT

RATIOS = [line_amplitude_ratio, point_amplitude_ratio]


@pytest.mark.parametrize("ratio", RATIOS)
@given(st.floats(10.0, 1e4), st.floats(1.0, 30.0))
def test_long_waves_are_flattened_more(ratio, m, l):  # noqa: E741
    found = ratio(np.geomspace(1e-9, 1e-2, 50), 1e-4, m, l)
    assert np.all(np.diff(found) < 0.0)
    assert found[0] > 0.98
    assert float(ratio(np.inf, 1e-4, m, l)) == 0.0


def test_solved_waves_of_line_contacts():
    """Waves solved with this program: the fit is close up to ratios of 0.5, and too small above."""
    waves = np.genfromtxt(
        ROOT / "docs" / "data" / "amplitude_reduction.csv", delimiter=",", names=True, skip_header=3
    )
    fit = line_amplitude_ratio(waves["wavelength"], 1.0, waves["moes_m"], waves["moes_l"])
    flat = waves["ratio"] <= 0.5
    assert flat.sum() >= 10
    np.testing.assert_allclose(fit[flat], waves["ratio"][flat], atol=0.05)
    above = waves["ratio"][~flat] - fit[~flat]
    assert np.all((above > 0.0) & (above < 0.2))


@pytest.mark.parametrize("shape", [(64,), (40, 50)])
def test_no_reduction_gives_the_heights_back(shape):
    heights = np.random.default_rng(1).standard_normal(shape)
    np.testing.assert_allclose(flattened(heights, 1e-6, np.ones_like), heights - heights.mean(), atol=1e-12)


def test_oblique_wave_of_a_map():
    """A product of cosines has the wave number of both together."""
    x, y = np.arange(60) + 0.5, np.arange(80) + 0.5
    heights = np.outer(np.cos(2 * np.pi * x / 30), np.cos(2 * np.pi * y / 20))
    seen = []

    def ratio(wavelength):
        seen.append(wavelength)
        return np.where(np.abs(wavelength * np.hypot(1 / 30e-6, 1 / 40e-6) - 1.0) < 1e-9, 0.25, 0.0)

    np.testing.assert_allclose(flattened(heights, (1e-6, 2e-6), ratio), 0.25 * heights, atol=1e-12)
    assert np.isinf(seen[0][0, 0])


@given(st.integers(0, 50), st.floats(0.1, 10.0))
def test_linear_in_the_heights(seed, factor):
    heights = np.random.default_rng(seed).standard_normal(50)

    def ratio(wavelength):
        return line_amplitude_ratio(wavelength, 1e-5, 100.0, 10.0)

    found = flattened(factor * heights, 1e-6, ratio)
    np.testing.assert_allclose(found, factor * flattened(heights, 1e-6, ratio), rtol=1e-9, atol=1e-12)
    np.testing.assert_allclose(flattened(heights[::-1], 1e-6, ratio)[::-1] * factor, found, atol=1e-9)


def test_flattening_takes_height_and_leaves_curvature():
    """Long waves carry the height, short ones the curvature: m0 falls far more than m4."""
    made = generated_profiles.self_affine(
        rq=1e-7, hurst=0.8, rolloff_wavelength=1e-4, length=0.02, seed=1, shortest=2e-6
    )
    deformed = flattened(made.heights, made.spacing, lambda w: line_amplitude_ratio(w, 1e-4, 300.0, 10.0))
    one, two = (profile_moments(z, made.spacing) for z in (made.heights, deformed))
    assert two.m0 / one.m0 < 0.25
    assert two.m4 / one.m4 > 0.75
    assert two.m0 < one.m0
    assert two.m2 < one.m2
    assert two.m4 < one.m4


def test_map_of_one_wavelength():
    """All waves are short or all are long: the moments follow with the square of the ratio."""
    made = generated_maps.gaussian(rq=1e-7, correlation_length=1e-5, reach_x=3e-4, reach_y=3e-4, seed=1)
    spacing = (made.spacing_x, made.spacing_y)
    deformed = flattened(made.heights, spacing, lambda w: np.full_like(w, 0.3))
    one, two = (map_moments(z, *spacing).isotropic for z in (made.heights, deformed))
    for before, after in ((one.m0, two.m0), (one.m2, two.m2), (one.m4, two.m4)):
        assert after == pytest.approx(0.09 * before, rel=1e-9)
