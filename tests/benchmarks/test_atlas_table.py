"""Nodes of the atlas that are filled from their neighbours, and the nodes that are solved."""

import numpy as np
import pytest
from benchmarks.atlas_nodes import LINES, POINTS, groups_of
from benchmarks.atlas_table import extend, fill_between, fill_beyond

AXES = [np.linspace(0.0, 2.0, 5), np.linspace(0.0, 3.0, 9)]


def sampled(function):
    """Values on the axes with one number for each node, their errors, and a mask with all nodes solved."""
    x, y = np.meshgrid(*AXES, indexing="ij")
    values = function(x, y)[..., np.newaxis]
    return values, np.full_like(values, 0.01), np.ones(x.shape, dtype=bool)


def test_nodes_between_lie_on_a_cubic_spline():
    exact, errors, solved = sampled(lambda x, y: x + y**3 - 2.0 * y)
    solved[:, 1::2] = False
    values = np.where(solved[..., np.newaxis], exact, 0.0)
    fill_between(values, errors, solved, AXES)
    np.testing.assert_allclose(values, exact, atol=1e-12)
    assert solved.all()
    assert np.min(errors) == pytest.approx(0.01)


def test_error_of_nodes_between_covers_what_the_spline_misses():
    exact, errors, solved = sampled(lambda x, y: np.sin(1.6 * y) + x)
    solved[:, 1::2] = False
    values = np.where(solved[..., np.newaxis], exact, 0.0)
    errors[:] = 0.0
    fill_between(values, errors, solved, AXES)
    missed = np.abs(values - exact)[:, 1::2]
    assert np.max(missed) > 0.01
    assert np.all(missed <= errors[:, 1::2])


def test_lines_with_few_solved_nodes_and_their_ends_stay():
    values, errors, solved = sampled(lambda x, y: x * y)
    solved[:] = False
    solved[0, [2, 4]] = True
    solved[1, [2, 4, 6]] = True
    fill_between(values, errors, solved, AXES)
    assert np.flatnonzero(solved[0]).tolist() == [2, 4]
    assert np.flatnonzero(solved[1]).tolist() == [2, 3, 4, 5, 6]


def test_wanted_nodes_beyond_the_last_are_extrapolated_with_a_larger_error():
    exact, errors, solved = sampled(lambda x, y: x + 0.2 * y**2)
    solved[:, 7:] = False
    solved[:, :2] = False
    wanted = np.ones_like(solved)
    wanted[:, 8] = False
    values = np.where(solved[..., np.newaxis], exact, 0.0)
    extend(values, errors, solved, wanted, AXES)
    np.testing.assert_allclose(values[:, 7], exact[:, 7])
    assert np.all(errors[:, 7] > 0.01)
    assert solved[:, 7].all()
    assert not solved[:, [0, 1, 8]].any()


def test_all_other_nodes_get_a_value_and_stay_unsolved():
    exact, _, solved = sampled(lambda x, y: 1.0 + x + 2.0 * y)
    solved[:, 6:] = False
    solved[3:] = False
    values = np.where(solved[..., np.newaxis], exact, np.nan)
    fill_beyond(values, solved, AXES)
    np.testing.assert_allclose(values, exact)
    assert not solved[3:].any()


@pytest.mark.parametrize("axes", [POINTS, LINES])
def test_a_contact_is_found_at_its_node(axes):
    at = tuple(size // 2 for size in axes.shape)
    assert axes.at(axes.groups(at)) == at
    assert axes.at(groups_of(37.0, 11.0, 3.0 if axes is POINTS else None)) is None


def test_balls_of_bearings_are_solved_first_and_no_node_twice():
    order = POINTS.order()
    assert len(set(order)) == len(order)
    first = [POINTS.groups(at) for at in order[:60]]
    assert {round(groups.ratio, 6) for groups in first} <= {4.5, 9.5}
    assert LINES.order() == sorted(np.ndindex(*LINES.shape))
