"""Grids of point contacts: nodes, weights, mirror images, and the transfers between them."""

import itertools

import numpy as np
import pytest

from ehlectric.film.deflection import LINE, point_geometry
from ehlectric.film.levels import COARSEST_POINT, NEARER, Transfer, hierarchy
from ehlectric.film.mesh import Mesh, Width, at_centre
from tests.helpers.each import each

CIRCLE = point_geometry(radius_ratio=1.0, ellipse_ratio=1.0, compliance=2.0 / np.pi**2)
INLET, OUTLET, SIDE = -4.5, 1.5, 3.0
EITHER = each("symmetric", [True, False])


def mesh_of(nodes, nodes_y, *, symmetric):
    return Mesh.over(nodes, INLET, OUTLET, Width(nodes_y, SIDE, symmetric=symmetric))


@each("nodes_y", [7, 8, 33, 34])
@EITHER
def test_nodes_are_equidistant_from_side_to_side(nodes_y, symmetric):
    mesh = mesh_of(20, nodes_y, symmetric=symmetric)
    np.testing.assert_allclose(mesh.whole_y, np.linspace(-SIDE, SIDE, nodes_y), atol=1e-14)
    assert mesh.dy == pytest.approx(2.0 * SIDE / (nodes_y - 1))
    assert mesh.dx == pytest.approx(6.0 / 19)
    # An even number has no node on the line of symmetry.
    assert mesh.symmetric == (symmetric and nodes_y % 2 == 1)
    assert (mesh.y[0] == 0.0) == mesh.symmetric


@each("nodes_y", [7, 8])
@EITHER
def test_weights_integrate_what_is_linear(nodes_y, symmetric):
    """Over both halves: of 1 + 2 X + 3 abs(Y) where a node lies at the kink, else of 1 + 2 X + 3 Y + X Y."""
    mesh = mesh_of(20, nodes_y, symmetric=symmetric)
    x, y = mesh.x[:, np.newaxis], mesh.y
    area, mean_x = 6.0 * 2.0 * SIDE, 0.5 * (INLET + OUTLET)
    assert mesh.weights.sum() == pytest.approx(area, rel=1e-13, abs=0.0)
    assert np.sum(mesh.weights * (1.0 + 2.0 * x)) == pytest.approx(
        area * (1.0 + 2.0 * mean_x), rel=1e-13, abs=0.0
    )
    if mesh.symmetric:
        assert np.sum(mesh.weights * y) == pytest.approx(area * 0.5 * SIDE, rel=1e-13, abs=0.0)
    else:
        assert abs(np.sum(mesh.weights * y * (3.0 + x))) < 1e-12


def test_weights_of_a_half_are_those_of_the_whole():
    half, whole = (mesh_of(11, 9, symmetric=s) for s in (True, False))
    values = np.random.default_rng(1).random(half.shape)
    expected = np.sum(whole.weights * half.mirrored(values))
    assert np.sum(half.weights * values) == pytest.approx(expected, rel=1e-13, abs=0.0)
    assert mesh_of(11, 9, symmetric=True).weights_across[[0, -1]] == pytest.approx([half.dy, half.dy])
    line = Mesh.over(11, INLET, OUTLET)
    assert (line.weights.shape, line.dy, line.inner.sum()) == ((11, 1), None, 9)


def test_mirror_image():
    half = mesh_of(5, 7, symmetric=True)
    values = np.arange(20).reshape(5, 4)
    whole = half.mirrored(values)
    np.testing.assert_array_equal(whole[0], [3, 2, 1, 0, 1, 2, 3])
    np.testing.assert_array_equal(whole, whole[:, ::-1])
    assert half.mirrored(values > 3).dtype == bool
    full = mesh_of(5, 7, symmetric=False)
    assert full.mirrored(whole) is whole


def test_inner_nodes():
    """All but the edges; the line of symmetry is none."""
    half, whole = (mesh_of(6, 7, symmetric=s) for s in (True, False))
    np.testing.assert_array_equal(half.mirrored(half.inner), whole.inner)
    expected = np.zeros((6, 7), dtype=bool)
    expected[1:-1, 1:-1] = True
    np.testing.assert_array_equal(whole.inner, expected)


@each("nodes_y", [9, 10])
@EITHER
def test_value_at_the_centre(nodes_y, symmetric):
    """By linear interpolation, which is exact for 3 + 2 X + abs(Y) where Y = 0 is a node."""
    mesh = mesh_of(8, nodes_y, symmetric=symmetric)
    slope = 1.0 if nodes_y % 2 else 0.0
    values = 3.0 + 2.0 * mesh.x[:, np.newaxis] + slope * np.abs(mesh.y)
    assert at_centre(mesh, values) == pytest.approx(3.0, rel=1e-13, abs=0.0)


@pytest.mark.slow
@pytest.mark.gate
@pytest.mark.parametrize("nodes", [65, 66, 100, 129])
@pytest.mark.parametrize("nodes_y", [65, 66, 67, 68, 129, 130])
@EITHER
def test_every_grid_covers_the_same_domain(nodes, nodes_y, symmetric):
    """The same half or the whole, with half as many intervals each; interpolation moves no node."""
    width = Width(nodes_y, SIDE, symmetric=symmetric)
    levels = hierarchy(nodes, inlet=INLET, outlet=OUTLET, geometry=CIRCLE, wedge_order=2, width=width)
    assert len(levels) >= 2
    assert levels[-1].weights.size <= COARSEST_POINT
    for level in levels:
        mesh = level.mesh
        assert (mesh.x[0], mesh.x[-1], mesh.y[-1]) == (INLET, OUTLET, SIDE)
        assert mesh.y[0] == levels[0].mesh.y[0]
        assert mesh.symmetric == levels[0].mesh.symmetric
        assert level.weights.sum() == pytest.approx(36.0, rel=1e-12, abs=0.0)
    for fine, coarse in itertools.pairwise(levels):
        # Where the lines are much nearer to each other than the nodes on them, there are fewer lines alone.
        lines_alone = fine.mesh.dx > NEARER * fine.mesh.dy
        assert coarse.nodes == (fine.nodes if lines_alone else fine.nodes // 2 + 1)
        assert coarse.mesh.y.size - 1 == fine.mesh.y.size // 2
        for one, other, move in ((coarse, fine, coarse.prolong), (fine, coarse, coarse.inject)):
            of, onto = one.mesh, other.mesh
            moved = move(of.x[:, np.newaxis] * (1.0 + 0.0 * of.y) + 10.0 * of.y)
            np.testing.assert_allclose(moved, onto.x[:, np.newaxis] + 10.0 * onto.y, atol=1e-12)


def test_narrow_domains_keep_their_nodes_along_entrainment_at_first():
    """Six long, 0.6 wide and as many nodes either way: dX is ten dY, five, 2.5 and 1.25 of them."""
    width = Width(257, 0.3)
    levels = hierarchy(257, inlet=-4.5, outlet=1.5, geometry=CIRCLE, wedge_order=2, width=width)
    assert [level.mesh.shape for level in levels[:5]] == [
        (257, 129),
        (257, 65),
        (257, 33),
        (257, 17),
        (129, 9),
    ]


SHAPES = [(33, 17, 17, 9), (34, 17, 18, 9), (33, 18, 17, 10), (40, 31, 21, 17)]


def transfer(nodes, nodes_y, coarse_nodes, coarse_nodes_y, *, symmetric):
    coarse, fine = (
        mesh_of(*shape, symmetric=symmetric) for shape in ((coarse_nodes, coarse_nodes_y), (nodes, nodes_y))
    )
    up = Transfer.between(coarse, fine)
    return coarse, fine, up, up.averaging(coarse, fine)


@each("shape", SHAPES)
def test_averaging_is_the_adjoint_of_interpolation(shape):
    """Under the integrals over the two grids, so that averages keep the integral."""
    coarse, fine, up, down = transfer(*shape, symmetric=False)
    random = np.random.default_rng(4)
    on_fine, on_coarse = random.random(fine.shape), random.random(coarse.shape)
    expected = np.sum(fine.weights * on_fine * up(on_coarse))
    assert np.sum(coarse.weights * down(on_fine) * on_coarse) == pytest.approx(expected, rel=1e-12, abs=0.0)
    kept = np.sum(fine.weights * on_fine)
    assert np.sum(coarse.weights * down(on_fine)) == pytest.approx(kept, rel=1e-12, abs=0.0)


def test_averaging_on_half_of_a_contact_is_that_on_the_whole():
    coarse, fine, _, down = transfer(33, 33, 17, 17, symmetric=True)
    *_, of_whole = transfer(33, 33, 17, 17, symmetric=False)
    values = np.random.default_rng(5).random(fine.shape)
    np.testing.assert_allclose(
        coarse.mirrored(down(values)), of_whole(fine.mirrored(values)), rtol=1e-12, atol=1e-14
    )


@each("shape, symmetric", [*((s, False) for s in SHAPES), ((33, 17, 17, 9), True)])
def test_averaging_keeps_constants(shape, symmetric):
    """Exactly where every second node is a coarse one, else within the shift of the nodes."""
    _, fine, _, down = transfer(*shape, symmetric=symmetric)
    nested = shape == (33, 17, 17, 9)
    averaged = down(np.ones(fine.shape))
    assert np.max(np.abs(averaged - 1.0)) < (1e-13 if nested else 0.3)


def test_line_contacts_inject_their_residuals():
    fine, coarse = hierarchy(201, inlet=-4.0, outlet=2.0, geometry=LINE, wedge_order=2)
    values = np.random.default_rng(6).random(fine.mesh.shape)
    np.testing.assert_allclose(coarse.restrict(values), values[::2], rtol=1e-13)
