"""The equation of one time step with a layer of oil: what is carried, where the order falls, what is kept."""

import numpy as np
import pytest

from ehlectric.film.deflection import LINE
from ehlectric.film.levels import hierarchy
from ehlectric.film.unsteady import Oil, carried, step_levels, sums, supplied_step_levels
from tests.helpers.each import each

NODES = 101


@pytest.fixture
def levels():
    return hierarchy(NODES, inlet=-3.0, outlet=2.0, geometry=LINE, wedge_order=2)


def oil(mass, filled):
    return Oil(np.asarray(mass, dtype=float)[:, np.newaxis], np.asarray(filled)[:, np.newaxis])


def mixed(seed=0):
    """Oil of random masses, with a cavitated inlet and a cavitated outlet."""
    number = np.arange(NODES)
    return oil(np.random.default_rng(seed).uniform(0.1, 1.0, NODES), (number > 30) & (number < 70))


@each("distance", [0.0, 0.3, 1.0, 1.7, 3.0])
def test_where_all_is_filled_the_values_are_those_of_the_flooded_scheme(distance):
    all_filled = oil(np.cos(np.linspace(-3.0, 2.0, NODES)), np.ones(NODES, dtype=bool))
    expected = carried(all_filled.mass, distance)[:-1]
    np.testing.assert_allclose(all_filled.at_feet(distance)[:-1], expected, rtol=1e-13)


@pytest.mark.parametrize("ratio", [0.5, 1.0, 2.0])
def test_where_all_is_filled_the_equation_is_that_of_the_flooded_scheme(levels, ratio):
    """Steps of whole spacings, as the two schemes interpolate the earlier mass once and twice."""
    mesh = levels[0].mesh
    x, filled = mesh.x, np.ones(NODES, dtype=bool)
    instants = oil(np.cos(x), filled), oil(np.cos(x + 0.1), filled)
    steps = 2.0 * ratio * mesh.dx, 2.0 * mesh.dx
    gap = np.zeros(mesh.shape)
    found = supplied_step_levels(levels, instants, steps, gap)[0]
    expected = step_levels(levels, (instants[0].mass, instants[1].mass), steps, gap)[0]
    np.testing.assert_allclose(found.wedge.coefficients, expected.wedge.coefficients, rtol=1e-12)
    # Where the first foot lies upstream of the edge, the flooded mass is a parabola in both.
    behind = slice(round(sum(steps) / mesh.dx), None)
    np.testing.assert_allclose(found.source[behind], expected.source[behind], rtol=1e-10)


@pytest.mark.parametrize("distance", [0.25, 0.5, 0.9])
def test_the_sum_changes_by_what_crosses_the_ends_alone(distance):
    """Half of the layer at the edge enters, and as much of the last node leaves, linear at both ends."""
    there = mixed()
    after = there.at_feet(distance)
    change = np.sum(after[1:]) - np.sum(there.mass[1:])
    assert change == pytest.approx(distance * (there.mass[0, 0] - there.mass[-1, 0]), abs=1e-12)


@pytest.mark.parametrize("distance", [0.2, 0.5, 1.4])
def test_nothing_overshoots_beside_a_meniscus(distance):
    """From a layer of 0.1 to a full gap of 1: all values lie between them."""
    number = np.arange(NODES)
    there = oil(np.where(number > 30, 1.0, 0.1), number > 30)
    after = there.at_feet(distance)
    assert np.min(after) >= 0.1 - 1e-13
    assert np.max(after) <= 1.0 + 1e-13


def test_feet_are_filled_where_all_their_nodes_are():
    number = np.arange(NODES)
    there = oil(np.ones(NODES), number >= 30)
    for distance, first in ((0.0, 30), (1.0, 31), (0.5, 32), (2.5, 34)):
        filled = there.filled_feet(distance)[:, 0]
        assert np.flatnonzero(filled)[0] == first
        assert np.all(filled[first:])


def test_the_order_falls_where_the_foot_is_not_filled(levels):
    """Equal steps of a spacing: 3/2 of the mass behind a filled foot, the mass itself behind another.

    At the first filled node half of the difference to the next node is known from the last instant.
    """
    mesh = levels[0].mesh
    there = mixed()
    level = supplied_step_levels(levels, (there, there), (mesh.dx, mesh.dx), np.zeros(mesh.shape))[0]
    rates = mesh.dx * level.wedge.coefficients[2, 1:-1, 0]
    np.testing.assert_allclose(rates, np.where(there.filled[:-2, 0], 1.5, 1.0), rtol=1e-12)
    np.testing.assert_array_equal(np.flatnonzero(there.first), 31)
    arrived = there.at_feet(1.0, sums(there, there, 1.0, 1.0))
    known = arrived[31] - 0.5 * (there.mass[32] - there.mass[31])
    np.testing.assert_allclose(mesh.dx * level.source[31], known, rtol=1e-12)


def test_the_sum_of_mass_and_difference_is_what_the_step_before_solved():
    """Without flow by pressure, the row of a step and the sum that the next step starts from agree."""
    before, number = mixed(), np.arange(NODES)
    feet, filled = before.at_feet(1.0), before.filled_feet(1.0)
    flow = sums(before, before, 1.0, 1.0)
    arrived = before.at_feet(1.0, flow)
    # Rows of the next instant: 3/2 m - 1/2 m of the foot, or m, is the sum that arrives; at the first filled
    # node, m and half of the difference to the node behind it.
    mass = np.where(filled, (arrived + 0.5 * feet) / 1.5, arrived)
    mass[31] = arrived[31] - 0.5 * (before.mass[32] - before.mass[31])
    now = Oil(mass, (number > 31)[:, np.newaxis] & (number < 70)[:, np.newaxis])
    np.testing.assert_allclose(sums(now, before, 1.0, 1.0)[1:], arrived[1:], rtol=1e-12)
