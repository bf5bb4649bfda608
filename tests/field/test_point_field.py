"""The field of point contacts against exact fields, the line contact's, and its observed orders."""

from itertools import product

import numpy as np
import pytest
import sympy
from scipy.constants import epsilon_0

from ehlectric.field.line_field import solve_field
from ehlectric.field.point_field import solve_point_field
from ehlectric.field.poisson import Across, FieldProblem
from ehlectric.field.poisson_3d import PointFieldProblem
from ehlectric.formulas.polynomials import lobatto_nodes
from tests.field.exact_fields import (
    egg_crate_wall,
    near,
    sinusoidal_wall,
    sphere_images,
    sphere_plane_capacitance,
    sphere_plane_charge,
    sphere_potential,
)
from tests.helpers.gate import gated

pytestmark = pytest.mark.convergence

GAP = 1e-6
RADIUS = 5e-3


def test_images_of_the_sphere():
    """The sum of the images, on the plane as a whole, is the series of the bispherical coordinates."""
    for gap, printed in [(1e-6, 2.8832e-12), (1e-4, 1.6140e-12)]:
        total = sphere_plane_capacitance(RADIUS, gap)
        assert total == near(printed, 5e-5)  # to a unit of the last printed digit
        assert np.sum(sphere_images(RADIUS, gap)[1]) == near(total, 1e-12)


def sphere_over_plane(columns, gap, *, degree=8):
    """A quarter of both: the plane is surface 2, and on the outer faces the potential is the exact one.

    Columns are graded by the scale of the gap. The range is a little wider than the disc of r/2.
    """
    reach, scale = 0.52 * RADIUS, np.sqrt(2 * gap * RADIUS)
    x = scale * np.sinh(np.linspace(0, np.arcsinh(reach / scale), columns))
    rho = np.hypot(x[:, np.newaxis], x)
    lower = np.sqrt(RADIUS**2 - rho**2) - RADIUS - gap
    depth = -lower[:, -1, np.newaxis] * (1 - lobatto_nodes(degree))
    face = sphere_potential(rho[:, -1, np.newaxis], depth, RADIUS, gap)
    field = solve_point_field(
        PointFieldProblem(
            x, x, lower, 0 * lower, 1 + 0 * lower, 1.0, 0.0, degree=degree,
            side_potentials=(None, face, None, face),
        )
    )  # fmt: skip
    disc = 4 * field.capacitance_of(lambda x, y: np.hypot(x, y) < RADIUS / 2)
    exact = sphere_potential(x[:, np.newaxis], -field.z[:, 0], RADIUS, gap)
    return field, disc, np.max(np.abs(field.potential[:, 0] - exact))


# The charges within r/2 by the series of images, printed in the design.
@pytest.mark.slow
@pytest.mark.gate
@pytest.mark.parametrize(("gap", "printed"), [(1e-6, 1.7854e-12), (1e-4, 5.4641e-13)])
def test_sphere_over_plane(slope, gap, printed):
    exact = sphere_plane_charge(RADIUS / 2, RADIUS, gap)
    assert exact == near(printed, 5e-5)
    columns = np.array([17, 33, 65])
    charges, potentials = [], []
    for n in columns:
        field, disc, error = sphere_over_plane(n, gap)
        charges.append(abs(disc / exact - 1))
        potentials.append(error)
        assert field.iterations <= 20
    assert charges[-1] < 1e-3
    assert slope(1 / (columns - 1), charges) > 1.7
    assert slope(1 / (columns - 1), potentials) == pytest.approx(2.0, abs=0.4)


def sinusoidal_field(amplitude, qx, qy, columns, degree=10):
    """Half a wavelength either way with the crest of the upper wall at x = y = 0; symmetry does the rest."""
    x, y = (np.linspace(0, np.pi / q, columns) if q else np.linspace(0, 3 * GAP, 3) for q in (qx, qy))
    upper = GAP - amplitude * np.cos(qx * x[:, np.newaxis]) * np.cos(qy * y)
    return solve_point_field(
        PointFieldProblem(x, y, 0 * upper, upper, 1 + 0 * upper, 0.0, 1.0, degree=degree)
    )


# Along x, along y, a crate of squares and one of oblongs; wavelengths from 60 to 2 gaps.
@pytest.mark.slow
@pytest.mark.parametrize(
    "wave",
    [
        pytest.param((0.1, 0), marks=pytest.mark.gate),
        (0, 0.1),
        (1, 0),
        pytest.param((0, 3), marks=pytest.mark.gate),
        (0.1, 0.1),
        (1, 1),
        (1.5, 0.5),
    ],
)
def test_sinusoidal_wall_to_its_next_order(slope, wave):
    """The formulas are of second order in A/h, so the difference is of third; of fourth for C."""
    qx, qy = np.array(wave) / GAP
    columns = 129 if qx and qy else 1601
    ratios = np.array([0.04, 0.08, 0.16]) if qx and qy else np.array([0.02, 0.04, 0.08])
    differences = []
    for ratio in ratios:
        field = sinusoidal_field(ratio * GAP, qx, qy, columns)
        if qx and qy:
            exact = egg_crate_wall(ratio * GAP, qx, qy, GAP)
        else:
            exact = sinusoidal_wall(ratio * GAP, qx + qy, GAP)
        plates = epsilon_0 * field.x[-1] * field.y[-1] / GAP
        strengths = np.array([field.surface_2_strength[0, 0], field.surface_1_strength[0, 0]]) * GAP
        computed = np.append(strengths, field.capacitance / plates)
        differences.append(np.abs(computed / exact - 1))
        assert field.max_strength_wall == "surface 2"
        x, y = field.max_strength_position
        assert np.cos(qx * x) * np.cos(qy * y) == pytest.approx(1.0)  # a crest
    crest, flat, capacitance = np.transpose(differences)
    assert crest[0] < 30 * ratios[0] ** 3
    assert flat[0] < 30 * ratios[0] ** 3
    assert slope(ratios, crest) == pytest.approx(3.0, abs=0.4)
    assert slope(ratios, flat) == pytest.approx(3.0, abs=0.4)
    assert slope(ratios, capacitance) == pytest.approx(4.0, abs=0.4)


def line_problem(degree=6):
    """A line contact with everything: uneven columns, layers, charge and given potentials at its ends."""
    x = 4e-6 * np.sinh(np.linspace(-1.5, 1.5, 41))
    s = lobatto_nodes(degree)
    lower, upper = -2e-7 * np.cos(4e5 * x), 8e-7 + 3e-7 * np.sin(3e5 * x)
    ends = tuple(-1 + 3 * s + level * s * (1 - s) for level in (0.1, -0.2))
    return FieldProblem(
        x, lower, upper, 2.4 + np.outer(np.cos(2e5 * x), s), -1.0, 2.0, degree=degree,
        charge_density=40 * np.outer(np.sin(3e5 * x), 1 + s), end_potentials=ends,
    )  # fmt: skip


@pytest.mark.parametrize("along_x", [True, False])
def test_what_does_not_change_along_y_is_a_line_contact(along_x):
    problem = line_problem()
    line = solve_field(problem)
    y = np.array([0.0, 0.3e-6, 1.1e-6, 3e-6, 20e-6])
    turn = (lambda v: v) if along_x else (lambda v: np.swapaxes(v, 0, 1))

    def extended(values):
        return turn(np.repeat(np.asarray(values)[:, np.newaxis], y.size, axis=1))

    faces = tuple(np.tile(end, (y.size, 1)) for end in problem.end_potentials)
    field = solve_point_field(
        PointFieldProblem(
            *((problem.x, y) if along_x else (y, problem.x)),
            *(extended(v) for v in (problem.lower, problem.upper, problem.permittivity)),
            problem.potential_1, problem.potential_2,
            charge_density=extended(problem.charge_density),
            side_potentials=(*faces, None, None) if along_x else (None, None, *faces),
        )
    )  # fmt: skip
    width = y[-1]
    for name in ("capacitance", "capacitance_by_charge", "thin_gap_capacitance"):
        assert getattr(field, name) == near(width * getattr(line, name), 1e-9)
    scale = 1e-9 * line.max_strength
    components = (field.field_x, field.field_y) if along_x else (field.field_y, field.field_x)
    np.testing.assert_allclose(components[0], extended(line.field_x), rtol=0, atol=scale)
    np.testing.assert_allclose(components[1], 0.0, atol=scale)
    np.testing.assert_allclose(field.field_z, extended(line.field_y), rtol=0, atol=scale)
    for name in ("strength", "middle_strength"):
        np.testing.assert_allclose(getattr(field, name), extended(getattr(line, name)), rtol=0, atol=scale)
    np.testing.assert_allclose(field.potential, extended(line.potential), rtol=0, atol=1e-9)
    assert field.max_strength_wall == line.max_strength_wall
    # The high field of the line reaches as far as the strip is wide; the area takes cells as linear, too.
    assert field.high_field_area == near(width * line.high_field_width, 1e-9)


def manufactured():
    """Potential, permittivity and the charge that belongs to them, on walls curved both ways."""
    x, y, z = sympy.symbols("x y z")
    lower = -sympy.Rational(1, 5) * sympy.cos(x + y)
    upper = 1 + sympy.Rational(3, 10) * sympy.sin(2 * x) * sympy.cos(y)
    s = (z - lower) / (upper - lower)
    potential = s + sympy.sin(sympy.pi * s) * sympy.cos(x - y / 2) / 2
    permittivity = 2 + sympy.sin(x) * sympy.cos(y) * s + s**2
    charge = -sum(sympy.diff(permittivity * sympy.diff(potential, v), v) for v in (x, y, z))
    fields = [-sympy.diff(potential, v) for v in (x, y, z)]
    names = ("lower", "upper", "potential", "permittivity", "charge", "ex", "ey", "ez")
    expressions = (lower, upper, potential, permittivity, charge, *fields)
    return {
        name: sympy.lambdify((x, y, z), e, "numpy", cse=True)
        for name, e in zip(names, expressions, strict=True)
    }


@pytest.fixture(scope="module")
def exact():
    return manufactured()


def manufactured_field(exact, columns, degree):
    """The field, and positions of its nodes: x from 0 to 2 and y from 0 to 1.5, uneven."""
    x = np.linspace(0, 1, columns)
    x, y = 2 * x - 0.2 * np.sin(2 * np.pi * x), 1.5 * x**1.3
    flat = np.meshgrid(x, y, indexing="ij")
    lower, upper = (exact[name](*flat, 0.0) for name in ("lower", "upper"))
    z = lower[:, :, np.newaxis] + (upper - lower)[:, :, np.newaxis] * lobatto_nodes(degree)
    at = (*(v[:, :, np.newaxis] + 0 * z for v in flat), z)
    potential = exact["potential"](*at)
    field = solve_point_field(
        PointFieldProblem(
            x, y, lower, upper, exact["permittivity"](*at), 0.0, 1.0, degree=degree,
            charge_density=epsilon_0 * exact["charge"](*at),
            side_potentials=(potential[0], potential[-1], potential[:, 0], potential[:, -1]),
        )
    )  # fmt: skip
    return field, at


@pytest.mark.slow
@pytest.mark.gate
def test_manufactured_solution_along_the_gap(exact, slope):
    """Second order in the spacing of the columns, for the potential and for each component of the field."""
    columns = np.array([13, 25, 49, 97])
    errors = []
    for n in columns:
        field, at = manufactured_field(exact, n, 9)
        computed = (field.potential, field.field_x, field.field_y, field.field_z)
        names = ("potential", "ex", "ey", "ez")
        errors.append([np.max(np.abs(c - exact[name](*at))) for c, name in zip(computed, names, strict=True)])
    for component in np.transpose(errors):
        assert slope(1 / (columns[1:] - 1), component[1:]) == pytest.approx(2.0, abs=0.3)


@pytest.mark.slow
@pytest.mark.gate
def test_manufactured_solution_across_the_gap(exact):
    """Exponential: every two degrees come a decade nearer to what the same columns give in the limit."""

    def middle(degree):
        field, _ = manufactured_field(exact, 17, degree)
        return field.potential @ Across.of_degree(degree).at_middle

    limit = middle(16)
    errors = np.array([np.max(np.abs(middle(degree) - limit)) for degree in (2, 4, 6, 8, 10)])
    assert np.all(errors[1:] < 0.1 * errors[:-1])


def rough_gap(columns, ratio, *, spacing=1e-6, slope_of_walls=0.3):
    """Walls of waves of all lengths from the range to four columns, the gap ``ratio`` spacings wide."""
    rng = np.random.default_rng(3)
    x = spacing * np.arange(columns)
    gap, reach = ratio * spacing, x[-1]
    waves = np.zeros((2, columns, columns))
    for number in 2 ** np.arange(int(np.log2(columns // 4)) + 1):
        for surface in (0, 1):
            phase = rng.uniform(0, 2 * np.pi, 2)
            along_x, along_y = (np.cos(np.pi * number * x / reach + p) for p in phase)
            waves[surface] += np.outer(along_x, along_y) / number
    steepest = max(np.max(np.abs(np.gradient(w, spacing, axis=a))) for w in waves for a in (0, 1))
    waves *= min(slope_of_walls / steepest, 0.4 * gap / np.max(np.abs(waves)))
    return PointFieldProblem(x, x, waves[0], gap + waves[1], 2.4 + 0 * waves[0], -1.0, 1.0)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("ratio", "columns"),
    gated(product([0.01, 0.1, 0.3, 1, 3, 10, 50], [65, 129]), (0.1, 65), (10, 65)),
)
def test_iterations_are_bounded_from_thin_to_thick_gaps(ratio, columns):
    field = solve_point_field(rough_gap(columns, ratio))
    assert field.iterations <= 20
    assert field.capacitance_by_charge == near(field.capacitance, 1e-8)


@pytest.mark.slow
@pytest.mark.parametrize("ratio", [1, 50, 2000])
def test_iterations_on_stretched_columns(ratio):
    """Columns 25 times longer along one axis than along the other, the gap up to 80 times wider than both."""
    problem = rough_gap(129, ratio)
    for stretch_x, stretch_y in ((25, 1), (1, 25)):
        stretched = PointFieldProblem(
            stretch_x * problem.x, stretch_y * problem.y, problem.lower, problem.upper,
            problem.permittivity, -1.0, 1.0,
        )  # fmt: skip
        assert solve_point_field(stretched).iterations <= 20
