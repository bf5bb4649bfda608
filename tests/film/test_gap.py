"""The gap under a pressure and its derivatives: entries, blocks and matrix are those of one operator."""

import numpy as np
import pytest

from ehlectric.film.deflection import LINE, point_geometry
from ehlectric.film.gap import Gap
from ehlectric.film.levels import hierarchy
from ehlectric.film.mesh import Width


def line():
    return hierarchy(65, inlet=-3.0, outlet=2.0, geometry=LINE, wedge_order=2)[0]


def point(*, symmetric):
    geometry = point_geometry(radius_ratio=1.0, ellipse_ratio=1.0, compliance=2.0 / np.pi**2)
    width = Width(15, 2.0, symmetric=symmetric)
    return hierarchy(17, inlet=-3.0, outlet=2.0, geometry=geometry, wedge_order=2, width=width)[0]


LEVELS = pytest.mark.parametrize("level", [line(), point(symmetric=True), point(symmetric=False)])


@LEVELS
def test_changes_are_those_of_the_gap_and_its_load(level):
    """The gap and the load are linear in P and H00; so a change is exact."""
    random = np.random.default_rng(4)
    pressure, dp = random.random(level.mesh.shape), random.standard_normal(level.mesh.shape)
    before, after = Gap.of(level, pressure, 0.1), Gap.of(level, pressure + dp, 0.4)
    dh, load = before.change(dp, 0.3)
    np.testing.assert_allclose(after.thickness - before.thickness, dh, rtol=1e-12, atol=1e-12)
    assert after.load(pressure + dp) - before.load(pressure) == pytest.approx(load, rel=1e-11)
    assert np.vdot(before.level.weights, dp) == pytest.approx(load, rel=1e-12)


@LEVELS
def test_matrix_is_the_derivative(level):
    gap = Gap.of(level, np.zeros(level.mesh.shape), 0.0)
    dp = np.random.default_rng(5).standard_normal(level.mesh.shape)
    dh, _ = gap.change(dp, 0.0)
    np.testing.assert_allclose(
        (gap.level.deflection.matrix @ dp.ravel()).reshape(dp.shape), dh, rtol=1e-10, atol=1e-12
    )


def test_entries_and_blocks_are_parts_of_the_matrix():
    gap = Gap.of(line(), np.zeros((65, 1)), 0.0)
    matrix = gap.level.deflection.matrix
    assert [gap.along(k) for k in (-3, 0, 7)] == [matrix[20, 17], matrix[20, 20], matrix[20, 27]]
    np.testing.assert_array_equal(gap.block(slice(10, 25), slice(2, 9)), matrix[10:25, 12:19])


def test_elastic_weight_is_the_diagonal_of_the_wedge_term_less_its_neighbour():
    """What a dipole of pressure does to the first-order wedge term at its own node."""
    level = hierarchy(65, inlet=-3.0, outlet=2.0, geometry=LINE, wedge_order=1)[0]
    gap = Gap.of(level, np.zeros((65, 1)), 0.0)
    single = np.zeros((65, 1))
    single[30] = 1.0
    change = level.wedge(gap.change(single, 0.0)[0])[30, 0]
    assert gap.elastic_weight(np.ones((65, 1)))[30, 0] == pytest.approx(change, rel=1e-9)
