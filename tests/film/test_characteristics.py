"""The equation of one time step: what is carried, and grids that stay as they were given."""

import numpy as np
import pytest

from ehlectric.film.deflection import LINE
from ehlectric.film.levels import hierarchy
from ehlectric.film.unsteady import carried, step_levels


@pytest.fixture
def levels():
    return hierarchy(101, inlet=-3.0, outlet=2.0, geometry=LINE, wedge_order=2)


def test_one_spacing_a_step_is_the_upstream_difference_of_second_order(levels):
    """A mass that stays: the terms of a time step are those of the stationary wedge term."""
    level = levels[0]
    mass = np.cos(level.mesh.x)[:, np.newaxis]
    step = level.mesh.dx
    new = step_levels(levels, (mass, mass), (step, step), np.zeros(level.mesh.shape))[0]
    np.testing.assert_allclose((new.wedge(mass) - new.source)[2:-1], level.wedge(mass)[2:-1], atol=1e-11)


@pytest.mark.parametrize("ratio", [0.5, 1.0, 2.0])
def test_derivative_along_the_lines_is_exact_for_parabolas(levels, ratio):
    """rho H = (X - T)^2 T: its derivative along X - T is (X - T)^2, whatever the last two steps."""
    mesh = levels[0].mesh
    x = mesh.x[:, np.newaxis]
    last = 2.0 * mesh.dx
    step = ratio * last
    now, before = ((x - t) ** 2 * t for t in (0.0, -last))
    new = step_levels(levels, (now, before), (step, last), np.zeros(mesh.shape))[0]
    derivative = new.wedge((x - step) ** 2 * step) - new.source
    inside = slice(round((step + last) / mesh.dx), -1)
    np.testing.assert_allclose(derivative[inside], ((x - step) ** 2)[inside], rtol=1e-9, atol=1e-9)


def test_given_grids_are_not_written_to(levels):
    """Two steps from the same grids have the same equations."""
    mass, nothing = np.ones(levels[0].mesh.shape), np.zeros(levels[0].mesh.shape)
    wedges = [level.wedge.coefficients.copy() for level in levels]
    first = step_levels(levels, (mass, mass), (0.1, 0.1), nothing)
    rates = [level.wedge.coefficients.copy() for level in first]
    step_levels(levels, (mass, mass), (0.05, 0.1), nothing + 0.3)
    for level, kept in zip((*levels, *first), (*wedges, *rates), strict=True):
        np.testing.assert_array_equal(level.wedge.coefficients, kept)
    assert np.all(first[0].dry_gap == levels[0].dry_gap)


def test_carried_by_a_fraction_is_exact_for_cubics():
    x = np.arange(20.0)[:, np.newaxis]
    moved = carried(x**3, 2.3)
    np.testing.assert_allclose(moved[4:], (x[4:] - 2.3) ** 3, rtol=1e-12)
