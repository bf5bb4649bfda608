"""Scrambled Sobol points against the points of SciPy, which is an independent program, and their balance."""

import numpy as np
import pytest
from scipy.stats import qmc

from ehlectric.formulas.sobol import sobol_points


@pytest.mark.parametrize(
    ("width", "number", "seed"), [(1, 1, 0), (1, 2, 3), (9, 2048, 1), (40, 100, 7), (700, 64, 5)]
)
@pytest.mark.filterwarnings("ignore:The balance properties of Sobol")
def test_points_are_the_points_of_scipy(width, number, seed):
    expected = qmc.Sobol(width, seed=seed).random(number)
    np.testing.assert_array_equal(sobol_points(width, number, seed), expected)


def test_each_interval_of_each_dimension_has_one_point():
    points = sobol_points(50, 256, seed=11)
    cells = np.sort(np.floor(256 * points).astype(int), axis=0)
    np.testing.assert_array_equal(cells, np.tile(np.arange(256)[:, np.newaxis], 50))


def test_more_dimensions_than_direction_numbers_are_refused():
    with pytest.raises(ValueError, match="701 dimensions: there are direction numbers for 700"):
        sobol_points(701, 2, seed=0)
