"""The field solver against exact fields and its observed orders."""

import numpy as np
import pytest
import sympy
from scipy.constants import epsilon_0

from ehlectric.field.line_field import solve_field
from ehlectric.field.poisson import FieldProblem
from ehlectric.formulas.polynomials import lobatto_nodes
from tests.field.exact_fields import (
    cylinder_plane_charge,
    cylinder_potential,
    sinusoidal_wall,
    sphere_plane_charge,
    sphere_potential,
)

pytestmark = pytest.mark.convergence

GAP = 1e-6


def sinusoidal_field(amplitude, wavenumber, columns=6401, degree=12):
    """One wavelength with the crest of the upper wall in the middle column."""
    x = np.linspace(-np.pi / wavenumber, np.pi / wavenumber, columns)
    upper = GAP - amplitude * np.cos(wavenumber * x)
    return solve_field(FieldProblem(x, 0 * x, upper, 1 + 0 * x, 0.0, 1.0, degree=degree))


@pytest.mark.slow
@pytest.mark.parametrize("qh", [0.01, 0.03, 0.1, 0.3, 1.0, 3.0])
def test_sinusoidal_wall_to_its_next_order(slope, qh):
    """The formulas are of second order in A/h, so the difference is of third; of fourth for C."""
    ratios = np.array([0.01, 0.02, 0.04])
    differences = {"crest": [], "flat": [], "capacitance": []}
    for ratio in ratios:
        amplitude, wavenumber = ratio * GAP, qh / GAP
        field = sinusoidal_field(amplitude, wavenumber)
        crest, flat, capacitance = sinusoidal_wall(amplitude, wavenumber, GAP)
        middle = field.x.size // 2
        plates = epsilon_0 * (field.x[-1] - field.x[0]) / GAP
        differences["crest"].append(abs(field.strength[middle, -1] * GAP / crest - 1))
        differences["flat"].append(abs(field.strength[middle, 0] * GAP / flat - 1))
        differences["capacitance"].append(abs(field.capacitance / plates / capacitance - 1))
    assert differences["crest"][0] < 30 * ratios[0] ** 3
    assert differences["flat"][0] < 30 * ratios[0] ** 3
    assert slope(ratios, differences["crest"]) == pytest.approx(3.0, abs=0.35)
    assert slope(ratios, differences["flat"]) == pytest.approx(3.0, abs=0.35)
    assert slope(ratios, differences["capacitance"]) == pytest.approx(4.0, abs=0.35)


def cylinder_over_plane(columns, *, radius=5e-3, gap=GAP, degree=8):
    """Charge of the plane within r/2 and the exact one; columns graded by the potential's own scale."""
    reach, focus = 0.5 * radius, np.sqrt(gap**2 + 2 * gap * radius)
    x = focus * np.sinh(np.linspace(-1, 1, columns) * np.arcsinh(reach / focus))
    upper = gap + radius - np.sqrt(radius**2 - x**2)
    end = cylinder_potential(reach, upper[-1] * lobatto_nodes(degree), radius, gap)
    problem = FieldProblem(x, 0 * x, upper, 1 + 0 * x, 0.0, 1.0, degree=degree, end_potentials=(end, end))
    field = solve_field(problem)
    charge = np.trapezoid(epsilon_0 * field.strength[:, 0], x)
    return charge, cylinder_plane_charge(reach, radius, gap)


def test_cylinder_over_plane(slope):
    """2.7109 nF/m for r = 5 mm and h = 1 um: the image charges' own closed form."""
    columns = np.array([401, 801, 1601, 3201])
    errors = []
    for n in columns:
        charge, exact = cylinder_over_plane(n)
        assert exact == pytest.approx(2.7109e-9, rel=2e-5, abs=0.0)
        errors.append(abs(charge / exact - 1))
    assert errors[-1] < 2e-6
    assert slope(1 / (columns - 1), errors) == pytest.approx(2.0, abs=0.2)


def sphere_over_plane(columns, *, radius=5e-3, gap=GAP, degree=8):
    """As the cylinder; around an axis the planar problem has the permittivity 2 pi rho."""
    reach, scale = 0.5 * radius, np.sqrt(2 * gap * radius)
    rho = scale * np.sinh(np.linspace(0, np.arcsinh(reach / scale), columns))
    upper = gap + radius - np.sqrt(radius**2 - rho**2)
    end = sphere_potential(reach, upper[-1] * lobatto_nodes(degree), radius, gap)
    axis = sphere_potential(0.0, gap * lobatto_nodes(degree), radius, gap)
    weight = 2 * np.pi * np.maximum(rho, 1e-20)  # a permittivity is positive, on the axis too
    problem = FieldProblem(rho, 0 * rho, upper, weight, 0.0, 1.0, degree=degree, end_potentials=(axis, end))
    field = solve_field(problem)
    charge = np.trapezoid(epsilon_0 * weight * field.strength[:, 0], rho)
    return charge, sphere_plane_charge(reach, radius, gap)


# The charges within r/2, 1.7854e-12 F at 1 um and 5.4641e-13 F at 100 um, by the series of images.
@pytest.mark.parametrize(("gap", "printed"), [(1e-6, 1.7854e-12), (1e-4, 5.4641e-13)])
def test_sphere_over_plane(slope, gap, printed):
    columns = np.array([201, 401, 801, 1601])
    errors = []
    for n in columns:
        charge, exact = sphere_over_plane(n, gap=gap)
        assert exact == pytest.approx(printed, rel=5e-5, abs=0.0)
        errors.append(abs(charge / exact - 1))
    assert errors[-1] < 1e-5
    assert slope(1 / (columns - 1), errors) == pytest.approx(2.0, abs=0.2)


def test_energy_and_charge_agree(paper_result):
    field = paper_result.field
    assert field.capacitance_by_charge == pytest.approx(field.capacitance, rel=1e-8, abs=0.0)
    # The charge integrated over the wall, as a second reckoning: eps0 eps E_n dx with its slope.
    lower = field.y[:, 0]
    line = np.hypot(1.0, np.gradient(lower, field.x))
    charge = np.trapezoid(epsilon_0 * field.permittivity[:, 0] * field.strength[:, 0] * line, field.x)
    assert charge / field.voltage == pytest.approx(field.capacitance, rel=1e-4, abs=0.0)


def test_capacitance_does_not_depend_on_the_degree(paper_case):
    from ehlectric import solve

    low, high = (solve(paper_case.replace({"grid.field_degree": p})).field.capacitance for p in (5, 8))
    assert low == pytest.approx(high, rel=1e-8, abs=0.0)


def manufactured():
    """Potential, permittivity and the charge that belongs to them, on curved walls."""
    x, y = sympy.symbols("x y")
    lower = -sympy.Rational(1, 5) * sympy.cos(x)
    upper = 1 + sympy.Rational(3, 10) * sympy.sin(2 * x)
    s = (y - lower) / (upper - lower)
    potential = s + sympy.sin(sympy.pi * s) * sympy.cos(x) / 2
    permittivity = 2 + sympy.sin(x) * s + s**2
    flux = [permittivity * sympy.diff(potential, v) for v in (x, y)]
    charge = -sum(sympy.diff(f, v) for f, v in zip(flux, (x, y), strict=True))
    names = ("lower", "upper", "potential", "permittivity", "charge", "ex", "ey")
    fields = [-sympy.diff(potential, v) for v in (x, y)]
    expressions = (lower, upper, potential, permittivity, charge, *fields)
    return {name: sympy.lambdify((x, y), e, "numpy") for name, e in zip(names, expressions, strict=True)}


def manufactured_errors(exact, columns, degree):
    x = np.linspace(0.0, 3.0, columns)
    lower, upper = exact["lower"](x, 0.0), exact["upper"](x, 0.0)
    y = lower[:, np.newaxis] + (upper - lower)[:, np.newaxis] * lobatto_nodes(degree)
    at = x[:, np.newaxis] + 0 * y
    potential = exact["potential"](at, y)
    problem = FieldProblem(
        x, lower, upper, exact["permittivity"](at, y), 0.0, 1.0, degree=degree,
        charge_density=epsilon_0 * exact["charge"](at, y),
        end_potentials=(potential[0], potential[-1]),
    )  # fmt: skip
    field = solve_field(problem)
    strength = np.hypot(exact["ex"](at, y), exact["ey"](at, y))
    return np.max(np.abs(field.potential - potential)), np.max(np.abs(field.strength - strength))


def test_manufactured_solution_along_the_gap(slope):
    """Second order in the column spacing, for the potential and for the field strength."""
    exact = manufactured()
    columns = np.array([41, 81, 161, 321])
    errors = np.array([manufactured_errors(exact, n, 10) for n in columns])
    spacing = 1 / (columns - 1)
    assert slope(spacing, errors[:, 0]) == pytest.approx(2.0, abs=0.15)
    assert slope(spacing, errors[:, 1]) == pytest.approx(2.0, abs=0.25)


def test_manufactured_solution_across_the_gap():
    """Exponential: every two degrees gain more than a decade, until the error of the columns is left."""
    exact = manufactured()
    errors = np.array([manufactured_errors(exact, 2561, degree)[0] for degree in (2, 4, 6, 8)])
    assert np.all(errors[1:] < 0.1 * errors[:-1])
