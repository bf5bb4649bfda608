"""Quantities of a drive between simulated drives, by their units."""

import numpy as np
import pytest

from ehlectric.drive.measurable import _Nodes
from tests.helpers.each import each


@each("quantities", ["at", "errors"])
def test_a_voltage_is_its_part_of_the_shaft_voltage(quantities):
    """Nodes have the rms voltage as a part of the peak: at another peak it and its error are as many times
    larger, and the discharges remain. Of equal nodes the error is zero, of others it is not.
    """
    places = np.linspace(0.0, 1.0, 16)[:, np.newaxis]
    nodes = _Nodes.of(
        places, np.stack([0.3 + 0.1 * np.cos(40.0 * places[:, 0]), 50.0 * places[:, 0] ** 2], 1)
    )
    shaft = np.array([[4.0, 4.0, 4.0]])
    at = np.array([[[0.2], [0.5], [0.9]]])
    low, high = (getattr(nodes, quantities)(at, factor * shaft) for factor in (1.0, 5.0))
    assert np.all(low["shaft_voltage_rms"] > 0.0)
    assert high["shaft_voltage_rms"] == pytest.approx(5.0 * low["shaft_voltage_rms"], rel=1e-12)
    assert high["discharge_rate"] == pytest.approx(low["discharge_rate"], rel=1e-12)
