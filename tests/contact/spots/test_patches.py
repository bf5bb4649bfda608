"""Spots of a mask, against areas of discs and strips that are known."""

import numpy as np
import pytest

from ehlectric.contact.touching import Spots, weighted_percentiles


def disc(nodes, *centres, radius=0.2):
    axis = np.linspace(-1.0, 1.0, nodes)
    x, y = np.meshgrid(axis, axis, indexing="ij")
    mask = np.zeros(x.shape, dtype=bool)
    for cx, cy in centres:
        mask |= (x - cx) ** 2 + (y - cy) ** 2 < radius**2
    return (axis, axis), mask


@pytest.mark.parametrize("nodes", [41, 81, 321])
def test_areas_of_discs_are_within_the_error_of_the_edge(nodes):
    centres = [(-0.5, -0.3), (0.4, 0.45)]
    axes, mask = disc(nodes, *centres)
    spots = Spots.of(axes, mask, 3.0 * mask)
    exact = 2.0 * np.pi * 0.2**2
    assert spots.number == 2
    assert abs(spots.area - exact) < spots.edge
    # The perimeter of a staircase around a disc is that of the square around it, whatever the grid.
    assert spots.edge == pytest.approx(2.0 * 8.0 * 0.2 * (axes[0][1] - axes[0][0]) / 2.0, rel=0.15)
    assert spots.radii == pytest.approx(0.2, rel=0.1)
    assert spots.positions == pytest.approx(np.array(centres), abs=0.02)
    assert np.sum(spots.loads) == pytest.approx(3.0 * spots.area)


def test_neighbours_along_a_diagonal_are_two_spots():
    axes, mask = (np.arange(4.0), np.arange(4.0)), np.zeros((4, 4), dtype=bool)
    mask[1, 1] = mask[2, 2] = True
    assert Spots.of(axes, mask, 1.0 * mask).number == 2
    mask[1, 2] = True
    assert Spots.of(axes, mask, 1.0 * mask).number == 1


def test_spots_of_a_line_are_strips():
    x = np.linspace(0.0, 1.0, 101)
    mask = ((x > 0.195) & (x < 0.305)) | ((x > 0.695) & (x < 0.705))
    spots = Spots.of((x,), mask, np.where(mask, 5.0, 0.0))
    assert spots.nodes.tolist() == [11, 1]
    assert spots.areas == pytest.approx([0.11, 0.01])
    assert spots.positions[:, 0] == pytest.approx([0.25, 0.70])
    # Each strip has two ends, each known to half a spacing.
    assert spots.edge == pytest.approx(0.02)


def test_nothing_touches():
    spots = Spots.of((np.arange(3.0),), np.zeros(3, dtype=bool), np.zeros(3))
    assert (spots.number, spots.area, spots.edge, spots.relative_edge) == (0, 0.0, 0.0, None)


def test_percentiles_of_equal_weights_are_those_of_numpy():
    values = np.random.default_rng(1).normal(size=1000)
    shares = [0.01, 0.25, 0.5, 0.95]
    found = weighted_percentiles(values, np.ones(1000), shares)
    assert found == pytest.approx(np.quantile(values, shares, method="inverted_cdf"))
    doubled = weighted_percentiles(np.tile(values, (2, 1)), np.full((2, 1000), 0.5), shares)
    assert doubled.tolist() == found.tolist()
