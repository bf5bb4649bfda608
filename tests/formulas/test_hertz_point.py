"""The dry ellipse against Johnson's closed forms, quadrature of its own pressure, and its limits."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad
from scipy.special import ellipe, ellipk

from ehlectric.formulas import hertz
from ehlectric.formulas.hertz import axis_ratio, dry_contact, point_deflection, point_load, point_pressure
from tests.helpers.each import each

E = 226e9
ratios = st.floats(1e-3, 1e3)
radius = st.floats(1e-3, 1.0)


def test_circle_by_hand():
    """a^3 = 3 F R/(2 E') = 3 20 0.01/(2 226e9): a = 109.9 um; p_h = 3 F/(2 pi a^2), approach a^2/R."""
    contact = dry_contact(20.0, 0.01, 0.01, E)
    a = (3 * 20.0 * 0.01 / (2 * E)) ** (1 / 3)
    assert a == pytest.approx(109.9e-6, rel=1e-4, abs=0.0)
    assert contact.semi_axis_x == pytest.approx(a, rel=1e-14, abs=0.0)
    assert contact.semi_axis_y == contact.semi_axis_x
    assert contact.max_pressure == pytest.approx(3 * 20.0 / (2 * np.pi * a**2), rel=1e-14, abs=0.0)
    assert contact.approach == pytest.approx(a**2 / 0.01, rel=1e-13, abs=0.0)


@each("radii_ratio", [1e-4, 1e-3, 0.03, 0.5, 0.999, 1.001, 2.0, 30.0, 1e3, 1e5])
def test_johnsons_closed_forms(radii_ratio):
    """Johnson, eqs. (4.26) to (4.28): long semi-axis a, short b, E* = E'/2, e^2 = 1 - (b/a)^2."""
    contact = dry_contact(20.0, 0.01, 0.01 * radii_ratio, E)
    b, a = sorted([contact.semi_axis_x, contact.semi_axis_y])
    short, long = sorted([0.01, 0.01 * radii_ratio])
    m, q = 1.0 - (b / a) ** 2, contact.max_pressure / (0.5 * E)
    first, second = ellipk(m), ellipe(m)
    # Of the difference that (4.26) takes at a nearly round ellipse some digits are lost.
    rel = 1e-11 / min(m, 1.0) + 1e-12
    assert 1.0 / (2.0 * long) == pytest.approx(q * b / (m * a**2) * (first - second), rel=rel, abs=0.0)
    assert 1.0 / (2.0 * short) == pytest.approx(
        q * b / (m * a**2) * ((a / b) ** 2 * second - first), rel=rel, abs=0.0
    )
    assert contact.approach == pytest.approx(q * b * first, rel=1e-12, abs=0.0)
    assert 2.0 / 3.0 * np.pi * a * b * contact.max_pressure == pytest.approx(20.0, rel=1e-12, abs=0.0)


def deflection(x, y, a, b):
    """Integral of sqrt(1 - (x/a)^2 - (y/b)^2)/r over the ellipse, polar about a point inside."""
    angles = 2.0 * np.pi * np.arange(4000) / 4000
    c, s = np.cos(angles), np.sin(angles)
    # Along a ray of length r the root is of 1 - (x/a)^2 - (y/b)^2 - 2 p r - q r^2.
    q, p = (c / a) ** 2 + (s / b) ** 2, x * c / a**2 + y * s / b**2
    inside = 1.0 - (x / a) ** 2 - (y / b) ** 2
    end = (-p + np.sqrt(p**2 + q * inside)) / q
    nodes, weights = np.polynomial.legendre.leggauss(80)
    # r = end (1 - t^2) takes the root out of the end of the ray.
    t, w = 0.5 * (nodes + 1.0), 0.5 * weights
    r = end[:, None] * (1.0 - t**2)
    root = np.sqrt(np.maximum(0.0, inside - 2.0 * p[:, None] * r - q[:, None] * r**2))
    return float(np.mean(end * (root * 2.0 * t * w).sum(axis=1)) * 2.0 * np.pi)


@pytest.mark.parametrize("axes", [1.0, 4.0, 12.0, 0.2])
def test_deflection_and_parabola_add_up_to_the_approach(axes):
    """Inside the bodies touch: (2/(pi E')) int p/r dA + x^2/(2 Rx) + y^2/(2 Ry) is the approach."""
    from scipy.optimize import brentq

    ry = 0.01 * brentq(lambda r: axis_ratio(1.0, r) - axes, 1e-2, 1e3)
    contact = dry_contact(20.0, 0.01, ry, E)
    a, b = contact.semi_axis_x, contact.semi_axis_y
    assert b / a == pytest.approx(axes, rel=1e-10, abs=0.0)
    for u, v in ((0.0, 0.0), (0.5, 0.0), (0.9, 0.0), (0.0, 0.5), (0.0, 0.9), (0.5, 0.6)):
        x, y = u * a, v * b
        lifted = 2.0 / (np.pi * E) * contact.max_pressure * deflection(x, y, a, b)
        gap = lifted + x**2 / 0.02 + y**2 / (2.0 * ry) - contact.approach
        assert abs(gap) < 1e-6 * contact.approach


@each("radii_ratio", [1.0, 3.0, 10.0, 30.0])
def test_hamrock_and_brewes_fit(radii_ratio):
    """k = (Ry/Rx)^(2/pi), good to a few percent; J. Lubr. Technol. 105 (1983) 171-177."""
    assert axis_ratio(1.0, radii_ratio) == pytest.approx(radii_ratio ** (2 / np.pi), rel=0.05, abs=0.0)


def test_long_ellipses_tend_to_the_line():
    """In the middle of a long ellipse the load per length is 3 F/(4 a); the error falls with (b/a)^2 ln."""
    errors = []
    for radii_ratio in (1e2, 1e4):
        contact = dry_contact(20.0, 0.01, 0.01 * radii_ratio, E)
        w = 0.75 * 20.0 / contact.semi_axis_y
        errors.append(
            abs(hertz.line_half_width(load_per_length=w, radius=0.01, modulus=E) / contact.semi_axis_x - 1.0)
        )
        assert hertz.line_max_pressure(load_per_length=w, radius=0.01, modulus=E) == pytest.approx(
            contact.max_pressure, rel=2 * errors[-1], abs=0.0
        )
    assert errors[0] < 0.02
    assert errors[1] < 0.02 * errors[0]


@given(rx=radius, ratio=ratios, load=st.floats(1e-3, 1e6), factor=st.floats(1e-2, 1e2))
def test_scaling_laws(rx, ratio, load, factor):
    """Lengths go with the cube root of load and radius, p_h with that of the load."""
    one, other = dry_contact(load, rx, rx * ratio, E), dry_contact(factor * load, rx, rx * ratio, E)
    third = factor ** (1 / 3)
    assert other.semi_axis_x == pytest.approx(third * one.semi_axis_x, rel=1e-12, abs=0.0)
    assert other.max_pressure == pytest.approx(third * one.max_pressure, rel=1e-12, abs=0.0)
    assert other.approach == pytest.approx(third**2 * one.approach, rel=1e-12, abs=0.0)
    wide = dry_contact(load, factor * rx, factor * rx * ratio, E)
    assert wide.semi_axis_y == pytest.approx(third * one.semi_axis_y, rel=1e-10, abs=0.0)
    assert point_load(one.max_pressure, rx, rx * ratio, E) == pytest.approx(load, rel=1e-12, abs=0.0)


@given(ratio=ratios)
def test_axes_may_be_swapped(ratio):
    assert axis_ratio(1.0, ratio) * axis_ratio(ratio, 1.0) == pytest.approx(1.0, rel=1e-12, abs=0.0)
    one, other = dry_contact(1.0, 0.01, 0.01 * ratio, E), dry_contact(1.0, 0.01 * ratio, 0.01, E)
    assert (one.semi_axis_x, one.max_pressure) == pytest.approx(
        (other.semi_axis_y, other.max_pressure), rel=1e-12, abs=0.0
    )


@each("small", [1e-16, 1e-12, 1e-9, 0.9e-6, 1.1e-6, 1e-4])
def test_no_step_at_the_circle(small):
    """Near the circle k = (Ry/Rx)^(2/3), to second order in the logarithm (Johnson, section 4.2)."""
    for sign in (-1.0, 1.0):
        k = axis_ratio(1.0, float(np.exp(sign * small)))
        assert np.log(k) == pytest.approx(2.0 / 3.0 * sign * small, rel=1e-6, abs=3e-16)


def test_pressure_carries_the_load():
    x, y = np.linspace(-1.0, 1.0, 801), np.linspace(-3.0, 3.0, 801)
    p = point_pressure(x[:, None], y, 3.0)
    assert np.trapezoid(np.trapezoid(p, y), x) == pytest.approx(2.0 * np.pi, rel=1e-4, abs=0.0)
    assert hertz.point_pressure(1.0, 1.0, 3.0) == 0.0


def test_deflection_around_the_ellipse():
    """(2/(pi E')) int p/r outside the ellipse by quadrature over it; radii sin(t) take the root's end out."""
    contact = dry_contact(600.0, 5e-3, 0.15, E)
    b, a = contact.semi_axis_x, contact.semi_axis_y

    def lifted(x, y):
        def inner(angle):
            def part(t):
                rho = np.sin(t)
                away = np.hypot(x - b * rho * np.cos(angle), y - a * rho * np.sin(angle))
                return np.cos(t) ** 2 * rho / away

            return quad(part, 0.0, 0.5 * np.pi, epsrel=1e-8)[0]

        angles = 2.0 * np.pi * (np.arange(400) + 0.5) / 400
        return (
            2.0
            / (np.pi * E)
            * contact.max_pressure
            * a
            * b
            * 2.0
            * np.pi
            * np.mean([inner(t) for t in angles])
        )

    for x, y in ((1.5 * b, 0.0), (0.0, 1.3 * a), (-4.0 * b, 1.6 * a)):
        assert point_deflection(x, y, contact, E) == pytest.approx(lifted(x, y), rel=1e-6, abs=0.0)


def test_deflection_has_no_step_at_the_rim():
    """Inside, deflection and parabolas add up to the approach; just outside the gap grows from nothing."""
    contact = dry_contact(600.0, 5e-3, 0.15, E)
    b, a = contact.semi_axis_x, contact.semi_axis_y
    for angle in (0.0, 0.3, 1.2, 0.5 * np.pi):
        for part, below in ((0.0, 1e-12), (0.7, 1e-12), (1.0, 1e-12), (1.0 + 1e-6, 1e-6)):
            x, y = part * b * np.cos(angle), part * a * np.sin(angle)
            gap = point_deflection(x, y, contact, E) + x**2 / 0.01 + y**2 / 0.3 - contact.approach
            assert abs(gap) < below * contact.approach
