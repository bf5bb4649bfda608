"""Contacts by formula against printed film formulas, Hertz's gap and laws of the oil, summed otherwise."""

import math

import numpy as np
import pytest
from scipy.constants import epsilon_0
from scipy.integrate import quad
from scipy.special import ellipe, ellipk

from ehlectric.bearing.gaps import LoadedContact, Raceway, RollerRaceway, outside_capacitance, roller_tails
from ehlectric.formulas.hertz import DryContact, point_deflection
from tests.helpers.bearings import (
    BALLS,
    ROLLERS,
    bearing_case,
    changed,
    formula_contact,
    rigid_capacitance,
    ring_of,
    solve_contact,
)
from tests.helpers.each import each
from tests.helpers.oils import alpha_star

D, PITCH, LENGTH = 11.906e-3, 60e-3, 10e-3
ROLLER = 11e-3
# Grooves that differ, so that one cannot stand for the other.
UNLIKE = changed(BALLS, bearing__outer_groove=0.53)
MODULUS = 208e9 / (1.0 - 0.3**2)
VISCOSITY = 14.847e-6 * 838.90
ALPHA = alpha_star(0.67 * (math.log(VISCOSITY) + 9.67) / 0.198e9)
SPEED = 4.5


def by_formula(tables, load, *, inner, angle=0.0, **changes):
    case = bearing_case(tables, **changes)
    return formula_contact(ring_of(case, inner=inner, angle=angle, speed=SPEED), load)


def permittivity(pressure):
    """Clausius and Mossotti with Dowson and Higginson's density, 0.59 GPa and 1.34; 2.4 at no pressure."""
    ratio = (0.59e9 + 1.34 * pressure) / (0.59e9 + pressure) * (2.4 - 1.0) / (2.4 + 2.0)
    return (1.0 + 2.0 * ratio) / (1.0 - ratio)


def ellipse(load, rx, ry):
    """Semi-axes along and across, pressure and approach by Johnson's (4.26) with complete integrals.

    E* = E'/2; both equations of a long ellipse across, solved for its ratio by bisection.
    """
    low, high = 1.0 + 1e-9, 1e3
    for _ in range(200):
        k = math.sqrt(low * high)
        m = 1.0 - k**-2
        if (k**2 * ellipe(m) - ellipk(m)) / (ellipk(m) - ellipe(m)) < ry / rx:
            low = k
        else:
            high = k
    # 1/(2 Ry) = (p b/(E* m a^2)) (K - E) with p = 3 F/(2 pi a b).
    a = (2.0 * ry * 1.5 * load / np.pi / (0.5 * MODULUS * m) * (ellipk(m) - ellipe(m))) ** (1.0 / 3.0)
    pressure = 1.5 * load / (np.pi * a * a / k)
    return a / k, a, pressure, pressure * (a / k) * ellipk(m) / (0.5 * MODULUS)


def radii(*, inner, angle):
    """Of Harris: 1/Rx = 2/D +- 2 cos a/(d_m -+ D cos a) and 1/Ry = 2/D - 1/(f D)."""
    sign, groove, c = (1.0, 0.52, math.cos(angle)) if inner else (-1.0, 0.53, math.cos(angle))
    return (
        1.0 / (2.0 / D + sign * 2.0 * c / (PITCH - sign * D * c)),
        1.0 / (2.0 / D - 1.0 / (groove * D)),
    )


def chittenden(load, rx, ry):
    """Minimum and central film, as printed in their paper of 1985."""
    u, g, w = VISCOSITY * SPEED / (MODULUS * rx), ALPHA * MODULUS, load / (MODULUS * rx**2)
    common, sides = rx * u**0.68 * g**0.49 * w**-0.073, (ry / rx) ** (2.0 / 3.0)
    return (
        3.68 * common * (1.0 - math.exp(-0.67 * sides)),
        4.31 * common * (1.0 - math.exp(-1.23 * sides)),
    )


def gauss(ends, count):
    """Nodes and weights between each two of some ends."""
    t, w = np.polynomial.legendre.leggauss(count)
    half, middle = 0.5 * np.diff(ends), 0.5 * (np.array(ends[1:]) + np.array(ends[:-1]))
    return (middle[:, None] + half[:, None] * t).ravel(), (half[:, None] * w).ravel()


@each("inner", [True, False])
@each("angle", [0.0, 0.4])
def test_a_ball(inner, angle):
    """Hertz's numbers by Johnson, films as printed, the sums of dA/h by Gauss over the halves of the domain.

    The nodes beside the edge of the ellipse, where the gap begins, make these sums a ten-thousandth off.
    """
    load = 600.0
    found = by_formula(UNLIKE, load, inner=inner, angle=angle)
    rx, ry = radii(inner=inner, angle=angle)
    b, a, pressure, approach = ellipse(load, rx, ry)
    least, central = chittenden(load, rx, ry)
    assert found.values.semi_axis_x == pytest.approx(b, rel=1e-9, abs=0.0)
    assert found.values.semi_axis_y == pytest.approx(a, rel=1e-9, abs=0.0)
    assert found.values.max_pressure == pytest.approx(pressure, rel=1e-9, abs=0.0)
    assert found.values.minimum_thickness == pytest.approx(least, rel=1e-4, abs=0.0)
    assert found.values.central_thickness == pytest.approx(central, rel=1e-4, abs=0.0)
    assert found.values.breakdown_voltage == pytest.approx(15e6 * least, rel=1e-4, abs=0.0)
    assert found.values.strength_per_volt == pytest.approx(1.0 / least, rel=1e-4, abs=0.0)
    assert found.values.plate == pytest.approx(epsilon_0 * 2.4 * np.pi * a * b / central, rel=1e-4, abs=0.0)

    side = 1.6 * a + 1.4 * b
    (x, wx), (y, wy) = gauss([-4.5 * b, -b, b, 1.5 * b], 80), gauss([0.0, a, side], 80)
    dry = DryContact(b, a, pressure, approach)
    bodies = x[:, None] ** 2 / (2.0 * rx) + y**2 / (2.0 * ry) - approach
    gap = central + np.maximum(0.0, bodies + point_deflection(x[:, None], y, dry, MODULUS))
    hertz = pressure * np.sqrt(np.maximum(0.0, 1.0 - (x[:, None] / b) ** 2 - (y / a) ** 2))
    inside = 2.0 * epsilon_0 * wx @ (permittivity(hertz) / gap) @ wy
    assert found.values.inside == pytest.approx(inside, rel=2e-4, abs=0.0)

    # The rigid bodies approach, less the film, and are bent open: but for the parabolas' error at the edge.
    raceway = Raceway.of(D, PITCH, 0.52 if inner else 0.53, 0.2, outer=not inner, contact_angle=angle)
    matched = LoadedContact(dry, MODULUS, central - approach, 0.0)
    outside = outside_capacitance(raceway, matched, (-4.5 * b, 1.5 * b, side))
    assert found.values.outside_air == pytest.approx(outside, rel=0.03, abs=0.0)
    assert found.values.outside_oil == pytest.approx(2.4 * found.values.outside_air, rel=1e-12, abs=0.0)
    assert 0.0 < found.mismatch < 0.05


@pytest.mark.parametrize("inner", [True, False])
def test_a_roller(inner):
    """Hertz's line and Pan and Hamrock's films by hand, the sum of dx/h by adaptive quadrature."""
    load = 1200.0
    found = by_formula(ROLLERS, load, inner=inner)
    sign = 1.0 if inner else -1.0
    race = 0.5 * (PITCH - sign * ROLLER)
    radius = 1.0 / (2.0 / ROLLER + sign / race)
    w = load / LENGTH
    b = math.sqrt(8.0 * w * radius / (np.pi * MODULUS))
    highest = 2.0 * w / (np.pi * b)
    u, g, weight = VISCOSITY * SPEED / (MODULUS * radius), ALPHA * MODULUS, w / (MODULUS * radius)
    least = 1.714 * radius * u**0.694 * g**0.568 * weight**-0.128
    central = 2.922 * radius * u**0.692 * g**0.470 * weight**-0.166
    assert found.values.semi_axis_x == pytest.approx(b, rel=1e-12, abs=0.0)
    assert found.values.semi_axis_y == pytest.approx(0.5 * LENGTH, rel=1e-12, abs=0.0)
    assert found.values.max_pressure == pytest.approx(highest, rel=1e-12, abs=0.0)
    assert found.values.minimum_thickness == pytest.approx(least, rel=1e-4, abs=0.0)
    assert found.values.central_thickness == pytest.approx(central, rel=1e-4, abs=0.0)
    assert found.values.breakdown_voltage == pytest.approx(15e6 * least, rel=1e-4, abs=0.0)
    assert found.values.strength_per_volt == pytest.approx(1.0 / least, rel=1e-4, abs=0.0)
    plate = epsilon_0 * 2.4 * 2.0 * b * LENGTH / central
    assert found.values.plate == pytest.approx(plate, rel=1e-4, abs=0.0)

    def density(x):
        """eps_r/h of the Hertz contact a central film apart."""
        outside = max(1.0, abs(x))
        root = math.sqrt(outside**2 - 1.0)
        opened = 0.5 * b**2 / radius * (outside * root - math.log(outside + root))
        return permittivity(highest * math.sqrt(max(0.0, 1.0 - x**2))) / (central + opened)

    inside = LENGTH * epsilon_0 * b * quad(density, -4.0, 2.0, points=[-1.0, 1.0], limit=200)[0]
    assert found.values.inside == pytest.approx(inside, rel=1e-4, abs=0.0)
    gaps = tuple(2.4 / density(x) for x in (-4.0, 2.0))
    tails = roller_tails(RollerRaceway(0.5 * ROLLER, race, not inner), b, (-4.0 * b, 2.0 * b), gaps)
    assert found.values.outside_air == pytest.approx(LENGTH * sum(tails), rel=1e-4, abs=0.0)
    assert found.values.outside_oil == pytest.approx(2.4 * found.values.outside_air, rel=1e-12, abs=0.0)


def test_a_rollers_formula_beside_its_solution():
    """Within the 30 % that its docstring grants the formula's films, and so what goes with their inverse."""
    case = bearing_case(ROLLERS)
    formula = by_formula(ROLLERS, 1500.0, inner=True)
    solved = solve_contact(ring_of(case, speed=SPEED), 1500.0, case.solver.model_dump())
    for name in ("minimum_thickness", "central_thickness", "inside", "plate", "breakdown_voltage"):
        assert getattr(formula.values, name) == pytest.approx(getattr(solved.values, name), rel=0.3), name


@pytest.mark.parametrize("inner", [True, False])
def test_a_ball_that_hardly_presses_is_nearly_a_rigid_one(inner):
    """At 0.05 N a film of 0.6 um is ten times the approach: the capacitance is that of rigid bodies apart."""
    case = bearing_case(UNLIKE)
    found = by_formula(UNLIKE, 0.05, inner=inner)
    rigid = rigid_capacitance(ring_of(case, inner=inner, speed=SPEED), found.values.central_thickness)
    assert found.values.inside + found.values.outside_oil == pytest.approx(2.4 * rigid, rel=0.05)


def test_without_a_strength_nothing_breaks_by_formula():
    for tables in (BALLS, ROLLERS):
        assert by_formula(tables, 500.0, inner=True, discharge=None).values.breakdown_voltage == np.inf
