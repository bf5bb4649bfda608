"""Error estimates of random rough line contacts against films on four to sixteen times as many nodes."""

import numpy as np
import pytest
from benchmarks.rough_estimates import drawn, estimates

from tests.helpers.places import DEKTAK


@pytest.mark.slow
def test_estimates_of_random_rough_contacts_are_seldom_exceeded():
    """Waves, Gaussian, self-affine and measured profiles, at random loads and speeds."""
    rows = [
        row
        for number in range(20)
        for row in estimates(drawn(np.random.default_rng([11, number]), "line", DEKTAK.parent))
    ]
    assert len(rows) > 50
    names = vars(rows[0])
    column = {name: np.array([getattr(row, name) for row in rows]) for name in names}
    ratio = column["true_film"] / column["film"]
    assert np.mean(ratio > 1.0) <= 0.1
    assert np.max(ratio) < 2.0
    assert np.median(1.0 / ratio) < 4.0
    # The set is one in which the difference of the two minima does not do.
    assert np.mean(column["true_film"] > column["two_minima"]) > 0.2
    assert np.mean(column["true_pressure"] > column["pressure"]) <= 0.1
