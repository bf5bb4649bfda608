"""Spectral moments of surfaces with a known spectrum, and summits counted on generated maps."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import integrate

from ehlectric.formulas.asperities import SpectralMoments, map_moments, profile_moments
from ehlectric.surfaces import generated_maps, generated_profiles
from tests.helpers.spectra import periodic_moments

LENGTH = 1e-5


def values(moments):
    return np.array([moments.m0, moments.m2, moments.m4])


def sampled(covariance, interval):
    """Moments that differences at an interval give for an autocovariance."""
    zero, one, two = (covariance(k * interval) for k in range(3))
    return np.array([zero, 2 * (zero - one) / interval**2, (6 * zero - 8 * one + 2 * two) / interval**4])


def bell(distance):
    """Autocovariance of the Gaussian surfaces of the generators, with Rq = 1."""
    return np.exp(-((distance / LENGTH) ** 2))


@pytest.mark.parametrize("step", [1, 3, 10])
def test_sinusoid(step):
    """A wave has its slope times sin(q d/2)/(q d/2)."""
    wavelength, spacing, amplitude = 1e-4, 1e-6, 2e-7
    x = spacing * np.arange(20_000)
    q = 2 * np.pi / wavelength
    found = profile_moments(amplitude * np.sin(q * x), spacing, step * spacing)
    slope = 2.0 * np.sin(0.5 * q * step * spacing) / (step * spacing)
    assert values(found) == pytest.approx(0.5 * amplitude**2 * slope ** np.array([0, 2, 4]), rel=2e-3)
    assert found.bandwidth == pytest.approx(1.0, rel=5e-3)


@given(
    st.lists(st.tuples(st.integers(1, 60), st.floats(1e-9, 1e-7)), min_size=1, max_size=5),
    st.floats(1e-8, 1e-5),
)
def test_spectrum_of_waves(waves, spacing):
    """Waves with whole numbers of periods: every moment to rounding, up to the cutoff."""
    amplitudes = {}
    for number, amplitude in waves:
        amplitudes[number] = amplitudes.get(number, 0.0) + amplitude
    x = spacing * np.arange(200)
    span = spacing * 200
    heights = 1e-6 + sum(a * np.cos(2 * np.pi * k * x / span) for k, a in amplitudes.items())

    def exact(last):
        q = np.array([2 * np.pi * k / span for k in amplitudes if k <= last])
        power = np.array([0.5 * a**2 for k, a in amplitudes.items() if k <= last])
        return np.array([np.sum(power * q**n) for n in (0, 2, 4)])

    found = periodic_moments(heights, spacing)
    np.testing.assert_allclose(values(found), exact(200), rtol=1e-6)
    cut = values(periodic_moments(heights, spacing, span / 30))
    assert np.all(np.abs(cut - exact(30)) <= 1e-9 * exact(200))


def test_gaussian_profile():
    made = generated_profiles.gaussian(rq=1e-7, correlation_length=LENGTH, length=3000 * LENGTH, seed=3)
    for interval in (made.spacing, 4 * made.spacing, LENGTH):
        found = values(profile_moments(made.heights, made.spacing, interval))
        np.testing.assert_allclose(found, 1e-14 * sampled(bell, interval), rtol=0.06)


def gaussian_map(seed=1):
    return generated_maps.gaussian(
        rq=1e-7, correlation_length=LENGTH, reach_x=50 * LENGTH, reach_y=50 * LENGTH, seed=seed
    )


def test_gaussian_map():
    made = gaussian_map()
    found = map_moments(made.heights, made.spacing_x, made.spacing_y)
    exact = 1e-14 * sampled(bell, made.spacing_x)
    np.testing.assert_allclose(values(found.isotropic), exact, rtol=0.04)
    assert found.slope_ratio == pytest.approx(1.0, abs=0.03)
    # Without sampling, m2 = 2 Rq^2/l^2, m4 = 12 Rq^2/l^4 and alpha = 3; the spectrum of the map has them.
    spectral = periodic_moments(made.heights, (made.spacing_x, made.spacing_y), LENGTH)
    limit = 1e-14 * np.array([1.0, 2.0 / LENGTH**2, 12.0 / LENGTH**4])
    np.testing.assert_allclose(values(spectral), limit, rtol=0.05)


def test_summits_of_a_gaussian_map():
    """Counted points that are higher than their eight neighbours."""
    made = gaussian_map(2)
    z, d = made.heights, made.spacing_x
    inner = z[1:-1, 1:-1]
    around = [
        z[1 + i : z.shape[0] - 1 + i, 1 + j : z.shape[1] - 1 + j]
        for i in (-1, 0, 1)
        for j in (-1, 0, 1)
        if i or j
    ]
    peak = np.all([inner > each for each in around], axis=0)
    moments = map_moments(z, d, d).isotropic
    summits = moments.summits()
    assert peak.sum() / (inner.size * d**2) == pytest.approx(summits.density, rel=0.05)
    heights = inner[peak] - z.mean()
    assert np.std(heights) == pytest.approx(summits.height_deviation, rel=0.04)
    assert heights.mean() == pytest.approx(4.0 * moments.rq / np.sqrt(np.pi * moments.bandwidth), rel=0.03)
    bent = (z[:-2, 1:-1] + z[2:, 1:-1] + z[1:-1, :-2] + z[1:-1, 2:] - 4 * inner)[peak] / (2 * d**2)
    assert -1.0 / bent.mean() == pytest.approx(summits.radius, rel=0.05)


def test_constants_of_the_summits():
    """Nayak's density, curvature and variance by integrals over the curvatures of a Gaussian surface.

    With m4 = 1 the sum s of both curvatures has the variance 8/3, and the determinant of the
    curvatures is s^2/4 - r^2, where r^2 is exponential with the mean c = 2/3. A summit has s > 2 r.
    """
    c = 2.0 / 3.0

    def moment(order):
        def integrand(s):
            determinant = s**2 / 4 - c * (1.0 - np.exp(-(s**2) / (4 * c)))
            return s**order * determinant * np.exp(-(s**2) * 3.0 / 16.0) / np.sqrt(2 * np.pi * 8.0 / 3.0)

        return integrate.quad(integrand, 0.0, 30.0, epsabs=1e-13)[0]

    number = moment(0)
    mean = moment(1) / number
    variance = moment(2) / number - mean**2
    for m0, m2 in ((10.0, 1.0), (2.0, 1.0), (3.0, 0.5)):
        moments = SpectralMoments(m0, m2, 1.0)
        summits = moments.summits()
        assert summits.density == pytest.approx(number / (2 * np.pi * m2), rel=1e-8)
        assert summits.radius == pytest.approx(2.0 / mean, rel=1e-8)
        # The height follows the curvature with the slope 3 m2/(4 m4), and scatters about it.
        alpha = moments.bandwidth
        exact = m0 * (1.0 - 1.5 / alpha) + (0.75 * m2) ** 2 * variance
        assert summits.height_deviation**2 == pytest.approx(exact, rel=2e-4)
        assert 0.75 * m2 * mean == pytest.approx(4.0 * np.sqrt(m0 / (np.pi * alpha)), rel=1e-8)


@given(st.floats(1e-3, 1e3), st.floats(1e-3, 1e3), st.integers(0, 100))
def test_scales(height, length, seed):
    heights = np.random.default_rng(seed).standard_normal((40, 50))
    one = map_moments(heights, 1.0, 1.0, 2.0).isotropic
    other = map_moments(height * heights, length, length, 2.0 * length).isotropic
    factors = height**2 / length ** np.array([0, 2, 4])
    np.testing.assert_allclose(values(other), factors * values(one), rtol=1e-9)
    assert other.bandwidth == pytest.approx(one.bandwidth, rel=1e-9)


def test_self_affine_moments_have_no_limit():
    """Between roll-off and shortest wave m2 grows with the interval to 2 H - 2, m4 to 2 H - 4."""
    made = generated_profiles.self_affine(
        rq=1e-7, hurst=0.8, rolloff_wavelength=1e-3, length=0.2, seed=4, shortest=1e-6
    )
    fine, coarse = (profile_moments(made.heights, made.spacing, d) for d in (8e-6, 16e-6))
    assert coarse.m2 / fine.m2 == pytest.approx(2.0**-0.4, rel=0.1)
    assert coarse.m4 / fine.m4 == pytest.approx(2.0**-2.4, rel=0.1)
    assert fine.summits().density > 2.0 * coarse.summits().density


def test_moments_of_two_surfaces_add_up():
    profiles = [
        generated_profiles.gaussian(rq=rq, correlation_length=LENGTH, length=2000 * LENGTH, seed=seed)
        for rq, seed in ((1e-7, 1), (2e-7, 2))
    ]
    one, two = (profile_moments(each.heights, each.spacing) for each in profiles)
    gap = profile_moments(profiles[0].heights - profiles[1].heights, profiles[0].spacing)
    np.testing.assert_allclose(values(one + two), values(gap), rtol=0.05)


def test_lay():
    """Grooves along x are steep along y only."""
    made = generated_maps.gaussian(
        rq=1e-7, correlation_length=8 * LENGTH, correlation_length_y=LENGTH,
        reach_x=200 * LENGTH, reach_y=25 * LENGTH, seed=5,
    )  # fmt: skip
    found = map_moments(made.heights, made.spacing_x, made.spacing_y)
    assert found.slope_ratio == pytest.approx(1.0 / 8.0, rel=0.05)
    assert found.isotropic.m2 == pytest.approx(np.sqrt(found.along_x.m2 * found.along_y.m2))


def test_rounded_heights_add_what_is_stated():
    smooth = generated_profiles.gaussian(rq=1e-6, correlation_length=LENGTH, length=2000 * LENGTH, seed=6)
    step, d = 2e-8, smooth.spacing
    shaken = smooth.heights + step * np.random.default_rng(1).uniform(-0.5, 0.5, smooth.heights.size)
    one, other = (profile_moments(each, d) for each in (smooth.heights, shaken))
    assert other.m2 - one.m2 == pytest.approx(step**2 / (6 * d**2), rel=0.2)
    assert other.m4 - one.m4 == pytest.approx(step**2 / (2 * d**4), rel=0.1)


def test_no_summits_of_flat_and_sinusoidal_surfaces():
    for heights in (np.zeros(100), np.sin(2 * np.pi * np.arange(1000) / 100)):
        with pytest.raises(ValueError, match="bandwidth"):
            profile_moments(heights, 1e-6).summits()
    assert np.isnan(profile_moments(np.zeros(100), 1e-6).bandwidth)
    assert np.isnan(map_moments(np.zeros((30, 30)), 1e-6, 1e-6).slope_ratio)


def test_too_few_points():
    with pytest.raises(ValueError, match="fewer than"):
        profile_moments(np.zeros(80), 1e-6, 1e-5)
