"""Deflection of a half-space under point contacts: coefficients, operators, and the Hertz pressure."""

import numpy as np
import pytest
from scipy.integrate import dblquad, quad

from ehlectric.contact.conditions import resolve_point
from ehlectric.contact.problems import geometry_of
from ehlectric.film.deflection import Deflection, point_geometry, point_influence
from ehlectric.film.mesh import Mesh, Width
from ehlectric.formulas.hertz import dry_contact
from tests.cases.test_point_case import point
from tests.formulas.hertz_point import potential_outside, radii_ratio
from tests.helpers.each import each

pytestmark = pytest.mark.convergence

DX, DY = 0.1, 0.3
CELLS = [(1, 0), (0, 1), (1, 1), (2, 1), (7, 3), (60, 0), (0, 60), (55, 44)]


@each("cell", CELLS)
def test_love_against_quadrature(cell):
    k, m = cell
    total, _ = dblquad(
        lambda y, x: 1.0 / np.hypot(x, y),
        (k - 0.5) * DX,
        (k + 0.5) * DX,
        (m - 0.5) * DY,
        (m + 0.5) * DY,
        epsabs=0.0,
        epsrel=1e-11,
    )
    found = point_influence((61, 61), DX, DY)[k, m]
    assert found == pytest.approx(total, rel=1e-10, abs=0.0)


def test_love_under_its_own_cell():
    """In polar coordinates 1/r drops out and the distance of the edge is left, of four times a quarter."""
    a, b = 0.5 * DX, 0.5 * DY
    edge = quad(lambda t: min(a / np.cos(t), b / np.sin(t)), 1e-300, np.pi / 2, points=[np.arctan2(b, a)])
    assert point_influence((1, 1), DX, DY)[0, 0] == pytest.approx(4.0 * edge[0], rel=1e-12, abs=0.0)


def test_love_far_away_is_a_point():
    """The next term of a square cell is dX^2/24 times the Laplacian of 1/r, which is 1/r^3."""
    aside = np.array([0, 900, 2000])
    far = point_influence((2001, 2001), DX, DX)[2000, aside]
    cells = np.hypot(2000, aside)
    np.testing.assert_allclose(far * cells / DX - 1.0, 1.0 / (24.0 * cells**2), atol=1e-9)


@each("ny", [9, 10, 33])
@each("nx", [16, 21])
def test_half_of_the_operator_is_the_whole_one(nx, ny):
    """On a pressure that is its mirror image, by transforms and as a dense matrix."""
    geometry = point_geometry(radius_ratio=0.5, ellipse_ratio=1.5, compliance=0.3)
    mesh = Mesh.over(nx, -2.0, 1.0, Width(2 * ny - 1, 2.0))
    whole = Mesh.over(nx, -2.0, 1.0, Width(2 * ny - 1, 2.0, symmetric=False))
    assert mesh.shape == (nx, ny)
    assert whole.shape == (nx, 2 * ny - 1)
    half = np.random.default_rng(ny).random(mesh.shape)
    expected = Deflection.on(whole, geometry)(mesh.mirrored(half))
    np.testing.assert_allclose(expected, expected[:, ::-1], rtol=1e-12)
    operator = Deflection.on(mesh, geometry)
    np.testing.assert_allclose(operator(half), expected[:, ny - 1 :], rtol=1e-12)
    by_matrix = (operator.matrix @ half.ravel()).reshape(mesh.shape)
    np.testing.assert_allclose(by_matrix, expected[:, ny - 1 :], rtol=1e-12)


def test_whole_operator_is_the_sum_over_cells():
    geometry = point_geometry(radius_ratio=1.0, ellipse_ratio=1.0, compliance=0.2)
    mesh = Mesh.over(12, -2.0, 1.0, Width(7, 2.0, symmetric=False))
    pressure = np.random.default_rng(2).random(mesh.shape)
    influence = 0.2 * point_influence(mesh.shape, mesh.dx, mesh.dy)
    direct = np.zeros(mesh.shape)
    for i, j in np.ndindex(*mesh.shape):
        for k, m in np.ndindex(*mesh.shape):
            direct[i, j] += influence[abs(i - k), abs(j - m)] * pressure[k, m]
    operator = Deflection.on(mesh, geometry)
    np.testing.assert_allclose(operator(pressure), direct, rtol=1e-12)
    np.testing.assert_allclose((operator.matrix @ pressure.ravel()), direct.ravel(), rtol=1e-12)


RATIOS = (1.0, 4.0, 0.25)


def dry(ratio):
    """Conditions of a dry contact over an ellipse of this ratio, and its exact approach over b^2/Rx."""
    ry = 0.01 * radii_ratio(ratio)
    conditions = resolve_point(point({"radius_y": ry}))
    assert conditions.ratio == pytest.approx(ratio, rel=1e-10, abs=0.0)
    approach = dry_contact(conditions.load, 0.01, ry, conditions.reduced_modulus).approach
    return conditions, approach / conditions.thickness_scale


def lifted_by_hertz(conditions, nodes):
    """Nodes, and deflection plus parabola of the Hertz pressure over abs(X) <= 2, abs(Y) <= 2 k."""
    geometry = geometry_of(conditions)
    mesh = Mesh.over(nodes, -2.0, 2.0, Width(nodes, 2.0 * conditions.ratio))
    gap = Deflection.on(mesh, geometry)(geometry.dry_pressure(mesh.x, mesh.y))
    return mesh, gap + geometry.dry_gap(mesh.x, mesh.y)


@pytest.mark.parametrize("ratio", RATIOS)
def test_hertz_pressure_flattens_the_bodies(slope, ratio):
    """Inside, the sum is the approach; order about 1.5: the pressure has a square-root edge."""
    conditions, approach = dry(ratio)
    nodes, errors = np.array([65, 129, 257, 513]), []
    for n in nodes:
        mesh, gap = lifted_by_hertz(conditions, n)
        inside = np.hypot(mesh.x[:, np.newaxis], mesh.y / conditions.ratio) < 0.9
        errors.append(np.sqrt(np.mean((gap[inside] / approach - 1.0) ** 2)))
    assert errors[-1] < 1e-4
    assert 1.3 < slope(1.0 / (nodes - 1), errors) < 2.1


def test_outside_of_a_circle_is_johnsons():
    """Johnson, eq. (3.42a): pi/2 ((2 - r^2) asin(1/r) + sqrt(r^2 - 1)) for p_0 = a = 1."""
    for r in (1.01, 1.5, 3.0):
        johnson = 0.5 * np.pi * ((2.0 - r**2) * np.arcsin(1.0 / r) + np.sqrt(r**2 - 1.0))
        assert potential_outside(0.6 * r, 0.8 * r, 1.0) == pytest.approx(johnson, rel=1e-10, abs=0.0)


@pytest.mark.parametrize("ratio", RATIOS)
def test_gap_outside_the_hertz_contact(ratio):
    conditions, _ = dry(ratio)
    geometry = geometry_of(conditions)
    mesh = Mesh.over(257, -2.0, 2.0, Width(257, 2.0 * conditions.ratio))
    opened = Deflection.on(mesh, geometry)(geometry.dry_pressure(mesh.x, mesh.y))
    # 2 p_h Rx/(pi E' b) of the integral of P/r.
    factor = 2.0 * conditions.max_pressure * 0.01 / (np.pi * 226e9 * conditions.semi_axis_x)
    for i, j in ((0, 0), (0, 128), (128, 110), (256, 60), (200, 80), (30, 100)):
        x, y = mesh.x[i], mesh.y[j]
        assert np.hypot(x, y / conditions.ratio) > 1.05
        expected = factor * potential_outside(x, y, conditions.ratio)
        assert opened[i, j] == pytest.approx(expected, rel=2e-4, abs=0.0)


def test_circle_has_the_factor_of_the_theory():
    """2 p_h R/(pi E' a) is 2/pi^2 for a circle, whatever its load."""
    conditions, approach = dry(1.0)
    mesh = Mesh.over(9, -1.0, 1.0, Width(9, 1.0))
    ours = geometry_of(conditions).influence(mesh.shape, mesh.dx, mesh.dy)
    np.testing.assert_allclose(ours, 2.0 / np.pi**2 * point_influence(mesh.shape, mesh.dx, mesh.dy))
    assert approach == pytest.approx(1.0, rel=1e-12, abs=0.0)
