"""A roller and its race against the exact field of two circles, and the tails of a film."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.constants import epsilon_0
from scipy.integrate import quad

from ehlectric.bearing.gaps import RollerRaceway, roller_capacitance, roller_tails
from ehlectric.formulas.hertz import line_gap, reduced_radius
from tests.helpers.each import each

ROLLER, INNER, OUTER = 5.5e-3, 27.25e-3, 38.25e-3  # nearly an NU 208
RACES = [RollerRaceway(ROLLER, INNER, outer=False), RollerRaceway(ROLLER, OUTER, outer=True)]


def exact(race, gap, phi):
    """Charge of the race from -phi to phi over eps0 V, in bipolar coordinates about the two limiting points.

    They are u and R^2/u, and inverse to each other in the roller's circle too. Potential and flux are the
    real and the imaginary part of ln((z - u)/(z - R^2/u)).
    """
    r, big, s = race.roller_radius, race.race_radius, 1.0 if race.outer else -1.0
    centre = big - s * (r + gap)
    # (R - centre)^2 - r^2 without a difference of like numbers.
    product = gap * (gap + 2.0 * r)
    total = 2.0 * big + product / centre
    half = 0.5 * np.sqrt(product / centre * (total + 2.0 * big))
    u = 0.5 * total + half
    z = big * np.exp(1j * phi)
    turned = np.angle((z - u) / (z - big**2 / u)) - np.angle((big - u) / (big - big**2 / u))
    # acosh(1 + x) of the potential between the circles.
    x = gap * (gap + 2.0 * (r - s * big)) / (2.0 * r * big) * -s
    return 2.0 * abs((turned + np.pi) % (2.0 * np.pi) - np.pi) / np.log1p(x + np.sqrt(x * (x + 2.0)))


def test_exact_charge_of_all_of_the_race():
    """The charge of the whole circle is the textbook capacitance 2 pi/acosh((c^2 - R^2 - r^2)/(2 r R))."""
    for race in RACES:
        gap = 1e-4
        c = race.pitch_radius(gap)
        cosh = abs(c**2 - race.race_radius**2 - ROLLER**2) / (2.0 * ROLLER * race.race_radius)
        # Half of the flux is within pi on either side.
        assert exact(race, gap, np.pi * (1.0 - 1e-12)) == pytest.approx(
            2.0 * np.pi / np.arccosh(cosh), rel=1e-9, abs=0.0
        )


@each("race", RACES)
@each("gap", [1e-9, 1e-7, 1e-6, 1e-5, 1e-4])
def test_exact_circles(race, gap):
    """What the next order misses is all at the ends, where the gap is 0.4 radii: it does not grow with C."""
    phi = np.arcsin(ROLLER / race.pitch_radius(gap))
    found = roller_capacitance(race, gap) / epsilon_0
    assert found == pytest.approx(exact(race, gap, phi), rel=0.0, abs=0.015)


@pytest.mark.parametrize("race", RACES)
def test_order_of_what_is_left_out(race):
    """The density misses a term of delta/r^2, so that to x it adds up to x^3."""
    sines, gap = np.array([0.4, 0.2, 0.1]), 1e-8
    phi = np.arcsin(ROLLER * sines / race.pitch_radius(gap))
    found = [roller_capacitance(race, gap, obliquity=float(np.arcsin(sine))) for sine in sines]
    errors = np.array(found) / epsilon_0 - [exact(race, gap, end) for end in phi]
    assert np.log2(np.abs(errors[:-1] / errors[1:])) == pytest.approx([3.0, 3.0], abs=0.3)


@pytest.mark.parametrize("race", RACES)
def test_quadrature(race):
    """The same integral by adaptive quadrature of the vectors between race and roller."""
    s = 1.0 if race.outer else -1.0
    for gap in (1e-6, 1e-4):
        centre = np.array([race.pitch_radius(gap), 0.0])

        def density(phi, centre=centre):
            normal = np.array([np.cos(phi), np.sin(phi)])
            away = race.race_radius * normal - centre
            far = np.linalg.norm(away)
            beta = np.arccos(min(1.0, s * away @ normal / far))
            return (
                np.sinc(beta / np.pi) / (far - ROLLER) - 1.0 / (6.0 * ROLLER) - s / (3.0 * race.race_radius)
            )

        end = np.arcsin(ROLLER / centre[0])
        whole = (
            2.0 * race.race_radius * quad(density, 0.0, end, epsrel=1e-10, points=[1e-3, 1e-2], limit=200)[0]
        )
        assert roller_capacitance(race, gap) == pytest.approx(epsilon_0 * whole, rel=1e-8, abs=0.0)


def tails_by_quadrature(race, b, x0, film):
    """Integral of 1/h dx over one tail of the true circles, h by heights over the tangent of the contact."""
    s = 1.0 if race.outer else -1.0
    radius = reduced_radius(ROLLER, -s * race.race_radius)

    def gap(x):
        circles = (
            ROLLER - np.sqrt(ROLLER**2 - x**2) - s * (race.race_radius - np.sqrt(race.race_radius**2 - x**2))
        )
        return circles + b**2 / radius * float(line_gap(x / b)) - 0.5 * x**2 / radius

    return quad(lambda x: 1.0 / (film + gap(x) - gap(x0)), x0, 0.2 * ROLLER, epsrel=1e-10)[0]


@pytest.mark.parametrize("race", RACES)
def test_tails_of_a_loaded_contact(race):
    """The thin gap of the heights up to 0.2 r, where the next order adds less than 1 %."""
    b, film = 1.5e-4, 2.1e-5
    for x0, found in zip((6e-4, 4e-4), roller_tails(race, b, (-6e-4, 4e-4), (film, film)), strict=True):
        near = found - rest(race, b, x0, film)
        by_hand = epsilon_0 * tails_by_quadrature(race, b, x0, film)
        assert near == pytest.approx(by_hand, rel=0.01, abs=0.0)


def rest(race, b, x0, film):
    # Beyond x = 0.2 r: the difference of the tails to there and to the end.
    phi = 0.2 * ROLLER / race.race_radius
    oblique = np.arcsin(np.sin(phi) * race.pitch_radius(0.0) / ROLLER)
    ends = ((-x0, x0), (film, film))
    return roller_tails(race, b, *ends)[0] - roller_tails(race, b, *ends, obliquity=oblique)[0]


@pytest.mark.parametrize("race", RACES)
def test_tails_of_a_line_contact(race):
    """By hand 2 eps0 R (1/x0 - 1/x1) of h = x^2/(2 R), R = 4.577 and 6.424 mm, x0 = 0.4 mm, to x1 = r/2.

    The true circle is closer than its parabola by x^2/(4 r^2) at the end, the next order adds as much.
    """
    radius = reduced_radius(ROLLER, (-1.0 if race.outer else 1.0) * race.race_radius)
    x0 = 4e-4
    obliquity = np.arcsin(np.sin(0.5 * ROLLER / race.race_radius) * race.pitch_radius(0.0) / ROLLER)
    # A small half-width leaves the parabola; the film continues it.
    tail, _ = roller_tails(race, 1e-7, (-x0, x0), (x0**2 / (2 * radius),) * 2, obliquity=obliquity)
    assert tail == pytest.approx(2.0 * epsilon_0 * radius * (1.0 / x0 - 2.0 / ROLLER), rel=0.02, abs=0.0)


def test_rigid_tails_and_middle_add_up():
    """Of a rigid roller both tails are the whole less the exact charge of the middle."""
    for race in RACES:
        radius = reduced_radius(ROLLER, (-1.0 if race.outer else 1.0) * race.race_radius)
        gap, x0 = 1e-6, 4e-4
        tails = roller_tails(race, 1e-7, (-x0, x0), (gap + x0**2 / (2 * radius),) * 2)
        middle = epsilon_0 * exact(race, gap, x0 / race.race_radius)
        # The film ends where a parabola does, which is 1 part in 1000 of the tails off at x0.
        assert sum(tails) + middle == pytest.approx(roller_capacitance(race, gap), rel=1e-4, abs=0.0)


def test_tails_are_linear_in_the_permittivity():
    for race in RACES:
        ends = (-6e-4, 4e-4), (4e-5, 2e-5)
        air, oil = roller_tails(race, 1e-4, *ends), roller_tails(race, 1e-4, *ends, 2.4)
        assert oil == pytest.approx([2.4 * tail for tail in air], rel=1e-14, abs=0.0)


def test_no_tail_beyond_the_roller():
    assert roller_tails(RACES[0], 1e-3, (-8e-3, 8e-3), (8e-3, 8e-3)) == (0.0, 0.0)


@pytest.mark.slow
@given(
    gap=st.floats(1e-9, 5e-5),
    factor=st.floats(1.01, 10.0),
    size=st.floats(1e-2, 1e2),
    permittivity=st.floats(1.0, 10.0),
)
def test_laws(gap, factor, size, permittivity):
    """Falls with the gap, is larger at the outer ring, the same per length at any size, and linear in eps."""
    by_ring = []
    for race in RACES:
        one = roller_capacitance(race, gap)
        assert roller_capacitance(race, factor * gap) < one
        larger = RollerRaceway(size * ROLLER, size * race.race_radius, race.outer)
        assert roller_capacitance(larger, size * gap) == pytest.approx(one, rel=1e-10, abs=0.0)
        assert roller_capacitance(race, gap, permittivity) == pytest.approx(
            permittivity * one, rel=1e-14, abs=0.0
        )
        assert roller_capacitance(race, gap, obliquity=np.pi / 4) < one
        by_ring.append(one)
    assert by_ring[1] > by_ring[0]
