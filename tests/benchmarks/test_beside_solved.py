"""Comparison of statistical models with solved contacts: its helpers, and its tables in the documentation."""

import numpy as np
import pytest
from benchmarks.asperity_models import Compared, Surface, load_line, one_rough, time_line, two_rough
from benchmarks.moving_asperities import POSED, standard_error, stored
from docs import pages

from ehlectric.formulas.asperities import SpectralMoments

MOMENTS = SpectralMoments(m0=1e-14, m2=2.2e-5, m4=1.5e5)


def test_error_of_a_mean_counts_values_that_depend_on_each_other_once():
    """Thirty values in groups of ten equal ones tell as much as three."""
    groups = np.array([1.0, 4.0, 7.0])
    expected = np.std(groups, ddof=1) / np.sqrt(3.0)
    assert standard_error(np.repeat(groups, 10), 3) == pytest.approx(expected)
    assert np.isnan(standard_error(groups, 1))


@pytest.mark.parametrize("ratio", [1.0, 2.0, 3.0])
def test_one_surface_stands_for_two(ratio):
    """Greenwood and Tripp: two rough surfaces touch about as one with the roughness of both and a flat."""
    gap = ratio * MOMENTS.rq
    one, two = one_rough(MOMENTS, gap, 226e9), two_rough(MOMENTS, gap, 226e9)
    assert 0.5 < two.pressure / one.pressure < 1.5
    assert 0.5 < two.spots_per_area / one.spots_per_area < 1.5


def test_documentation_has_the_stored_contacts():
    """No contact is missing, and lines of the page are those of the data, with models computed now."""
    rows = stored()
    assert [row.posed for row in rows] == list(POSED)
    page = pages.page("mixed_lubrication.md")
    for row in (rows[4], rows[-2]):
        each = Compared(row, Surface.of(row.posed))
        assert load_line(each) in page
        assert time_line(each) in page
