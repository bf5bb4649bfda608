"""Load sharing: equilibrium, limits and closed solutions."""

from dataclasses import replace

import numpy as np
import pytest
from benchmarks.greenwood_tripp import greenwood_tripp
from benchmarks.load_sharing import film_under_share, load_sharing, mean_gap
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy import optimize

from ehlectric.formulas.asperities import Summits

ROUGH = Summits(density=2e11, radius=2e-6, height_deviation=100e-9)


def pressure(separation):
    return greenwood_tripp(separation, ROUGH, 226e9).pressure


@settings(max_examples=20)
@given(st.lists(st.floats(1e-9, 1e-6), min_size=1, max_size=3), st.floats(0.05, 0.3), st.booleans())
def test_both_parts_carry_the_load_in_one_gap(films, exponent, displaced):
    thickness = film_under_share(films, exponent)
    found = load_sharing(thickness, pressure, 1e9, roughness=1e-7, displaced_plane=displaced)
    # The film's share has no more digits than 1 - phi.
    digits = 1e-12 + 1e-14 / (1.0 - found.asperity_share.max())
    np.testing.assert_allclose(pressure(found.separation), found.asperity_share * 1e9, rtol=digits)
    np.testing.assert_allclose(found.gap, thickness(1.0 - found.asperity_share), rtol=1e-12)
    gap = mean_gap(found.separation, 1e-7) if displaced else found.separation
    np.testing.assert_allclose(gap, found.gap, rtol=1e-8)


def test_exponential_asperities_under_a_film_without_load():
    """A film that the load does not change: the share follows without iteration."""
    films = np.array([1e-8, 1e-7, 3e-7])
    found = load_sharing(
        film_under_share(films, 0.0),
        lambda d: 5e8 * np.exp(-d / 1e-7),
        1e9,
        roughness=1e-7,
        displaced_plane=False,
    )
    np.testing.assert_allclose(found.asperity_share, 0.5 * np.exp(-films / 1e-7), rtol=1e-12)
    np.testing.assert_array_equal(found.gap, films)


def test_one_share_by_another_solver():
    def excess(share):
        return 2e8 * np.exp(-2e-7 / 1e-7 * (1.0 - share) ** -0.5) - share * 1e8

    exact = optimize.brentq(excess, 0.0, 1.0 - 1e-9, xtol=1e-15)
    found = load_sharing(
        film_under_share(2e-7, 0.5),
        lambda d: 2e8 * np.exp(-d / 1e-7),
        1e8,
        roughness=1e-7,
        displaced_plane=False,
    )
    assert float(found.asperity_share) == pytest.approx(exact, rel=1e-10)
    assert found.asperity_share.shape == ()


def test_limits_of_film_and_load():
    thickness = film_under_share(np.array([1e-12, 1e-6]), 0.14)
    found = load_sharing(thickness, pressure, np.array([1e5, 1e9]), roughness=1e-7)
    assert found.asperity_share[0] > 0.99  # no film and a small load: the asperities carry it
    assert found.asperity_share[1] < 1e-12  # ten roughnesses of film
    assert found.gap[1] == pytest.approx(1e-6)


def test_share_falls_with_the_film():
    films = np.geomspace(1e-9, 1e-6, 30)
    shares = load_sharing(film_under_share(films, 0.14), pressure, 1e9, roughness=1e-7).asperity_share
    assert np.all(np.diff(shares) < 0.0)


def test_asperities_that_carry_more_than_the_load():
    found = load_sharing(film_under_share(1e-9, 0.0), lambda d: 1e10 + 0 * d, 1e9, roughness=1e-7)
    assert float(found.asperity_share) == 1.0


def test_worn_summits_carry_nothing_above_their_height():
    worn = replace(ROUGH, highest=2.0)
    found = load_sharing(
        film_under_share(np.array([1e-7, 3e-7]), 0.14),
        lambda d: greenwood_tripp(d, worn, 226e9).pressure,
        1e9,
        roughness=1e-7,
    )
    assert found.asperity_share[0] > 1e-3
    assert found.asperity_share[1] == 0.0
    assert found.gap[1] == 3e-7
