"""Factor of the capacitance by roughness: against samples of a rough gap, its limits, and what touches."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.stats import norm

from ehlectric.discharge.film_capacitance import LEAST_RATIO, TOUCHING, roughness_factor
from ehlectric.errors import InputError
from tests.helpers.each import each


@pytest.fixture(scope="module")
def heights():
    """Heights at equal steps of probability, that is the quantiles of the distribution."""
    return norm.ppf((np.arange(2_000_000) + 0.5) / 2_000_000)


@each("ratio", [0.5, 1.0, 2.0, 3.0, 6.0, 12.0])
def test_factor_is_the_mean_over_a_gaussian_gap(heights, ratio):
    gap = ratio + heights
    rough = np.mean(np.where(gap > TOUCHING, ratio / np.where(gap > TOUCHING, gap, 1.0), 0.0))
    assert float(roughness_factor(ratio)) == pytest.approx(rough, rel=2e-5)


def test_factor_of_a_thick_film_is_one_plus_the_square_of_rq_over_h():
    ratios = np.array([20.0, 40.0, 80.0])
    excess = (roughness_factor(ratios) - 1.0) * ratios**2
    # The next term of the series is 3 (Rq/h)^4.
    np.testing.assert_allclose(excess, 1.0 + 3.0 / ratios**2, rtol=1e-4)
    assert roughness_factor(np.inf) == 1.0


def test_factor_is_continuous_where_its_formula_changes():
    below, above = roughness_factor([9.0 - 1e-9, 9.0])
    assert below == pytest.approx(above, rel=1e-10)


def test_what_counts_as_touching_matters_little_above_the_least_ratio():
    low, high = (roughness_factor([1.0, LEAST_RATIO, 3.0], touching=TOUCHING * e) for e in (1.0, np.e))
    np.testing.assert_allclose(low - high, [0.26, 0.13, 0.017], rtol=0.03)
    assert (low - high)[1] < 0.15


@each(
    "ratio, touching, key",
    [(0.0, 0.05, "film_ratio"), (np.nan, 0.05, "film_ratio"), (2.0, 0.0, "touching"), (2.0, 1.0, "touching")],
)
def test_ratios_without_a_meaning_are_refused(ratio, touching, key):
    with pytest.raises(InputError, match=key):
        roughness_factor(ratio, touching=touching)
