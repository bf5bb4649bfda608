"""Filter, form, statistics and generators against exact values."""

from functools import partial

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ehlectric import InputError
from ehlectric.contact.conditions import resolve
from ehlectric.contact.problems import domain_of
from ehlectric.surfaces import generated_profiles as generators
from ehlectric.surfaces.profiles import (
    Processing,
    Profile,
    processed,
    statistics,
    trimmed,
    waviness,
    without_form,
)
from ehlectric.surfaces.rough_surfaces import continued, rough_surfaces
from tests.helpers.each import each

CUTOFF = 80e-6


@each("ratio", np.geomspace(0.3, 3.0, 9))
def test_filter_transmits_as_the_standard_says(ratio):
    """exp(-pi (alpha cutoff/wavelength)^2), alpha^2 = ln 2/pi: one half at the cutoff (ISO 16610-21)."""
    wavelength = ratio * CUTOFF
    spacing = 0.5e-6
    profile = Profile(spacing, np.empty(4001))
    profile = Profile(spacing, np.cos(2 * np.pi * profile.x / wavelength))
    exact = 0.5 ** ((CUTOFF / wavelength) ** 2)
    assert waviness(profile, CUTOFF).heights[2000] == pytest.approx(exact, abs=5e-3 * max(exact, 0.01))


def test_filter_keeps_what_is_constant():
    flat = waviness(Profile(1e-6, np.full(200, 3.0)), CUTOFF).heights
    np.testing.assert_allclose(flat, 3.0, rtol=1e-12)


@given(st.lists(st.floats(-1.0, 1.0), min_size=3, max_size=3))
def test_form_removal_is_exact_for_its_own_form(coefficients):
    profile = Profile(1e-6, np.empty(101))
    t = profile.x / 1e-4
    for degree, form in enumerate(("mean", "line", "parabola")):
        heights = np.polynomial.polynomial.polyval(t, coefficients[: degree + 1])
        left = without_form(Profile(1e-6, heights), form)
        np.testing.assert_allclose(left.heights, 0.0, atol=1e-12)


def test_statistics_of_a_sine():
    """Rq = a/sqrt 2, Ra = 2 a/pi, Rsk = 0, Rku = 3/2, rms slope a q/sqrt 2."""
    spacing, wavelength, amplitude = 1e-7, 1e-4, 1e-7
    x = spacing * np.arange(10_000)
    s = statistics(Profile(spacing, amplitude * np.sin(2 * np.pi * x / wavelength)))
    assert s.rq == pytest.approx(amplitude / np.sqrt(2), rel=1e-6, abs=0.0)
    assert s.ra == pytest.approx(2 * amplitude / np.pi, rel=1e-4, abs=0.0)
    assert s.rsk == pytest.approx(0.0, abs=1e-9)
    assert s.rku == pytest.approx(1.5, rel=1e-6, abs=0.0)
    slope = 2 * np.pi * amplitude / wavelength
    assert s.rms_slope == pytest.approx(slope / np.sqrt(2), rel=1e-3, abs=0.0)
    assert s.largest_slope == pytest.approx(slope, rel=1e-3, abs=0.0)


def test_steps_come_in_order_and_trim_by_half_a_cutoff():
    profile = Profile(1e-6, 1e-7 * np.random.default_rng(0).standard_normal(2000))
    steps = processed(profile, Processing("line", 80e-6, 10e-6, None, 5e-8, 6e-8))
    assert [name.split(":")[0] for name, _ in steps] == [
        "as read", "form", "cutoff_long", "cutoff_short", "trim", "rescale_rq", "truncate",
    ]  # fmt: skip
    assert steps[4][1].heights.size == 2000 - 2 * 40
    assert statistics(steps[5][1]).rq == pytest.approx(5e-8, rel=1e-9, abs=0.0)
    assert np.max(np.abs(steps[6][1].heights)) == 6e-8


@pytest.mark.parametrize("form", ["none", "mean", "parabola"])
def test_flat_profile_has_no_roughness_to_rescale(form):
    steps = Processing(form, None, None, None, 5e-8, None)
    with pytest.raises(InputError, match="rescale_rq: got a flat surface"):
        processed(Profile(1e-6, np.full(100, 0.1)), steps)


def test_filter_at_its_shortest_cutoff():
    """Four spacings: the sampled Gaussian still passes one half; at two it would pass 0.89."""
    profile = Profile(1e-6, np.cos(0.5 * np.pi * np.arange(-200, 201)))
    assert waviness(profile, 4e-6).heights[200] == pytest.approx(0.5, abs=5e-3)


def test_means_are_taken_out_with_any_form():
    """Of all the points, and of what a trim leaves: a line fitted to a step is none of its parts' own."""
    heights = np.where(np.arange(400) < 100, 3e-7, 1e-7) + 0.1
    for form in ("mean", "line", "parabola"):
        steps = processed(Profile(1e-6, heights), Processing(form, trim=60e-6))
        for _, profile in steps[1:]:
            assert np.mean(profile.heights) == pytest.approx(0.0, abs=1e-15)


@pytest.mark.parametrize("cutoff", [1e-6, 3.9e-6, 1e-2])
def test_cutoffs_that_cannot_be(cutoff):
    with pytest.raises(InputError, match="cutoff: got"):
        waviness(Profile(1e-6, np.zeros(200)), cutoff)


def test_trim_that_leaves_nothing():
    with pytest.raises(InputError, match="leaves 0 of 100 points"):
        trimmed(Profile(1e-6, np.zeros(100)), 60e-6)


@pytest.mark.slow
def test_random_profiles_are_reproducible_and_as_asked():
    """Rq is that of all such profiles: one of n independent lengths is within 1/sqrt(2 n) of it.

    The squared autocorrelation exp(-2 (d/l)^2) has the integral l sqrt(pi/2): that is one of these lengths.
    """
    made = {"rq": 1e-8, "correlation_length": 5e-6, "length": 0.5}
    one, same, other = (generators.gaussian(seed=seed, **made) for seed in (1, 1, 2))
    np.testing.assert_array_equal(one.heights, same.heights)
    assert np.corrcoef(one.heights, other.heights)[0, 1] == pytest.approx(0.0, abs=0.02)
    s = statistics(one)
    spread = np.sqrt(5e-6 * np.sqrt(np.pi / 2) / 0.5 / 2)
    assert s.rq == pytest.approx(1e-8, rel=4 * spread, abs=0.0)
    assert s.correlation_length == pytest.approx(5e-6, rel=0.02, abs=0.0)
    assert s.rku == pytest.approx(3.0, abs=0.1)
    # The curvature of the autocorrelation at zero gives the slope, sqrt(2) rq/l.
    assert s.rms_slope == pytest.approx(np.sqrt(2) * 1e-8 / 5e-6, rel=0.02, abs=0.0)


@pytest.mark.slow
def test_self_affine_spectrum_has_its_slope():
    """The power spectrum falls as q^(-1 - 2 hurst) between roll-off and the shortest wave."""
    hurst = 0.7
    profile = generators.self_affine(
        rq=1e-8, hurst=hurst, rolloff_wavelength=1e-4, length=0.5, seed=3, shortest=1e-6
    )
    assert statistics(profile).rq == pytest.approx(1e-8, rel=0.02, abs=0.0)
    # Averaged over pieces, with Hann's window.
    pieces = profile.heights[: profile.heights.size // 8192 * 8192].reshape(-1, 8192) * np.hanning(8192)
    power = np.mean(np.abs(np.fft.rfft(pieces, axis=1)) ** 2, axis=0)
    q = np.fft.rfftfreq(8192, profile.spacing)
    band = (q > 3e4) & (q < 8e5)
    slope = np.polyfit(np.log(q[band]), np.log(power[band]), 1)[0]
    assert slope == pytest.approx(-1 - 2 * hurst, abs=0.02)
    assert np.max(power[q > 1.05e6]) < 1e-6 * power[np.argmin(np.abs(q - 0.95e6))]


@pytest.mark.parametrize(
    "make",
    [
        partial(generators.gaussian, rq=1e-8, correlation_length=5e-6, seed=7),
        partial(generators.self_affine, rq=1e-8, hurst=0.3, rolloff_wavelength=5e-5, shortest=1e-6, seed=7),
    ],
)
def test_longer_profiles_are_the_same_in_their_middle(make):
    short, long = make(length=1e-3), make(length=3.3e-3)
    extra = (long.heights.size - short.heights.size) // 2
    middle = long.heights[extra : extra + short.heights.size]
    np.testing.assert_allclose(middle, short.heights, rtol=0.0, atol=1e-20)
    np.testing.assert_allclose(short.x, long.x[extra : extra + short.heights.size], rtol=0.0, atol=1e-15)


def test_too_many_points_are_refused_before_they_are_made():
    with pytest.raises(InputError, match=r"correlation_length: asks for 1.6e\+07 points"):
        generators.gaussian(rq=1e-8, correlation_length=1e-9, length=1e-3, seed=1)
    made = {"rq": 1e-8, "hurst": 0.5, "length": 1e-3, "seed": 1}
    with pytest.raises(InputError, match="shortest_wavelength: asks for"):
        generators.self_affine(rolloff_wavelength=1e-4, shortest=1e-10, **made)
    with pytest.raises(InputError, match="shortest_wavelength: asks for"):
        generators.self_affine(rolloff_wavelength=1.0, shortest=1e-9, **made)


@pytest.mark.parametrize("shortest", [None, 2e-6])
def test_self_affine_surface_of_a_case(paper_case, shortest):
    """As rough as asked, further than the domain, and no wave below the shortest, by default a hundredth.

    The variance over n roll-off wavelengths is known to some sqrt(2/n): here n is 40.
    """
    asked = {"generator": "self-affine", "rq": 2e-8, "hurst": 0.8, "rolloff_wavelength": 1e-4, "seed": 5}
    asked |= {} if shortest is None else {"shortest_wavelength": shortest}
    case = paper_case.replace(roughness=[{"surface": 2} | asked])
    (surface,) = rough_surfaces(case.roughness, domain_of(case, resolve(case)))
    _, profile = surface.steps[-1]
    assert surface.surface == 2
    assert 2 * 4 * 499.4e-6 < profile.length < 1.05 * 2 * 4 * 499.4e-6
    assert statistics(profile).rq == pytest.approx(2e-8, rel=0.5 * np.sqrt(2 / 40) * 3)
    power = np.abs(np.fft.rfft(profile.heights * np.hanning(profile.heights.size))) ** 2
    q = np.fft.rfftfreq(profile.heights.size, profile.spacing)
    cut = 1.0 / (shortest or 1e-6)
    assert np.max(power[q > 1.05 * cut]) < 1e-11 * np.max(power)
    assert np.max(power[(q > 0.9 * cut) & (q < cut)]) > 1e-9 * np.max(power)


def test_shapes():
    assert generators.sinusoid(0.0, amplitude=1.0, wavelength=2.0, phase=np.pi / 2) == pytest.approx(1.0)
    assert generators.asperity(3.0, height=2.0, width=1.0, position=2.5) == pytest.approx(1.0)
    pit = {"depth": 1.0, "width": 2.0, "rim": 0.25, "position": 5.0}
    assert generators.pit(5.0, **pit) == pytest.approx(-1.0, abs=1e-4)
    assert generators.pit(np.array([3.0, 7.0]), **pit) == pytest.approx([0.25 - 2**-4] * 2, abs=1e-6)


@pytest.mark.parametrize("extend", ["mirror", "repeat", "flat"])
def test_continued_profiles_have_no_step(extend):
    profile = Profile(1e-6, 1e-7 * np.cumsum(np.random.default_rng(4).standard_normal(400)) / 10)
    height = continued(profile, extend)
    fine = np.linspace(-1.2e-3, 1.2e-3, 48_001)
    steps = np.abs(np.diff(height(fine)))
    inside = np.abs(np.diff(height(np.linspace(-1.5e-4, 1.5e-4, 6001))))
    assert np.max(steps) < 2.0 * np.max(inside)
    middle = profile.x[100:300]
    np.testing.assert_allclose(height(middle), profile.heights[100:300], atol=1e-18)
    if extend == "flat":
        assert np.all(height(np.array([-3e-4, 3e-4])) == 0.0)


def test_a_repeated_profile_has_the_mean_of_both_ends_at_its_joint():
    profile = Profile(1e-6, 1e-7 * np.random.default_rng(5).standard_normal(200))
    ends = 0.5 * (profile.heights[0] + profile.heights[-1])
    assert continued(profile, "repeat")(0.5 * profile.length) == pytest.approx(ends, rel=1e-6)
