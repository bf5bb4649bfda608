"""Gap between whole bodies around a film: against exact charges, the gaps of bearings, and its own laws."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.constants import epsilon_0
from scipy.integrate import quad

from ehlectric.bearing.gaps import (
    Raceway,
    RollerRaceway,
    match_film,
    outside_capacitance,
    roller_capacitance,
    roller_tails,
)
from ehlectric.discharge import outer_gap as gaps
from ehlectric.discharge.outer_gap import Bodies, Body, around_line, around_point, points
from ehlectric.formulas.hertz import dry_contact, line_opening, point_deflection, reduced_radius

R, E = 9.525e-3, 230.77e9
PLANE, BALL = Body(0.0, 0.0), Body(1.0 / R, 1.0 / R)
ON_PLANE = Bodies.of(BALL, PLANE)


def image_charges(gap):
    """Charges of a ball at 1 V over a plane at 0 V, by images, and their heights."""
    a = np.arccosh(1.0 + gap / R)
    n = np.arange(1, int(60.0 / a) + 2)
    return 4.0 * np.pi * epsilon_0 * R * np.sinh(a) / np.sinh(n * a), R * np.sinh(a) / np.tanh(n * a)


def charge_within(gap, radius):
    charge, height = image_charges(gap)
    return float(np.sum(charge * (1.0 - height / np.hypot(radius, height))))


def rigid_ring(bodies, gap, inner, outer=np.inf, width=None):
    """Capacitance of rigid bodies outside a circle, which the rays of a smaller square pass."""
    square = inner / 1.5
    s, t, area = (
        p.ravel() for p in gaps._rays(bodies, gap, (-square, square, square), width, (inner, outer))
    )
    at = points(bodies, gap, s, t)
    return epsilon_0 * float(np.sum(at.density() * area * at.stretch))


@pytest.mark.parametrize("gap", [1e-7, 1e-5, 1e-4])
def test_ball_on_a_plane_by_images(gap):
    exact = charge_within(gap, R) - charge_within(gap, 6e-4)
    assert rigid_ring(ON_PLANE, gap, 6e-4) == pytest.approx(exact, rel=3.2e-3)


@pytest.mark.parametrize("gap", [1e-7, 1e-5])
def test_what_is_left_out_of_a_free_ball(gap):
    rest = float(np.sum(image_charges(gap)[0])) - charge_within(gap, R)
    assert rest / (epsilon_0 * R) == pytest.approx(16.54, abs=0.01)


def test_balls_of_the_same_size_are_twice_a_ball_on_their_plane_of_symmetry():
    """Half the gap in series: in the thin gap the capacitance is half that of a ball on the plane."""
    pair = rigid_ring(Bodies.of(BALL, BALL), 2e-6, 6e-4, 2e-3)
    plane = rigid_ring(ON_PLANE, 1e-6, 6e-4, 2e-3)
    assert pair == pytest.approx(0.5 * plane, rel=0.01)


def test_cylinder_on_a_plane_by_bipolar_coordinates():
    """Exact charge of a plane under a cylinder: q (2/pi) atan(x/c) with c = sqrt((R + h)^2 - R^2)."""
    gap, start = 1e-5, 5e-4
    bodies = Bodies.of(Body(1.0 / R, 0.0), PLANE)
    c = np.sqrt((R + gap) ** 2 - R**2)
    total = 2.0 * np.pi * epsilon_0 / np.arccosh(1.0 + gap / R)
    exact = total / np.pi * 2.0 * (np.arctan(R / c) - np.arctan(start / c))
    x = np.array([-start, start])
    half_width = 1e-9  # no load, so that the deflection is nil
    film = points(bodies, gap, np.abs(x), np.zeros(2)).gap
    found = around_line(bodies, half_width, R, (x, film), length=1.0).capacitances(1.0)
    assert np.sum(found) == pytest.approx(exact, rel=4e-3)


@pytest.mark.parametrize("outer", [False, True])
def test_line_is_that_of_a_roller_in_a_bearing(outer):
    race, near = RollerRaceway(5.5e-3, 27.25e-3, outer=outer), (-1.0 if outer else 1.0) / 27.25e-3
    ends, films = (-4e-4, 2e-4), (1e-5, 2e-6)
    bodies = Bodies.of(Body(near, 0.0), Body(1.0 / 5.5e-3, 0.0))
    film = np.array(ends), np.array(films)
    found = around_line(bodies, 1e-4, reduced_radius(5.5e-3, 1.0 / near), film, length=0.01)
    exact = 0.01 * sum(roller_tails(race, 1e-4, ends, films, 2.2))
    assert np.sum(found.capacitances(2.2)) == pytest.approx(exact, rel=1e-12)


def dry_film(bodies, dry, modulus, domain, thickness=3e-7, nodes=(61, 51)):
    inlet, outlet, side = domain
    x, y = np.linspace(inlet, outlet, nodes[0]), np.linspace(-side, side, nodes[1])
    at = np.meshgrid(x, y, indexing="ij")
    gap = points(bodies, 0.0, *at).gap + point_deflection(*at, dry, modulus)
    return x, y, gap - dry.approach + thickness


@pytest.mark.parametrize("outer", [False, True])
def test_ball_in_a_groove_is_that_of_a_bearing(outer):
    """The bearing keeps the pitch circle, the contact the radius of the raceway: 0.3 % apart."""
    diameter, pitch, osculation = 11.906e-3, 60e-3, 0.52
    race = Raceway.of(diameter, pitch, osculation, 0.2, outer=outer)
    along = -0.5 * (pitch + diameter) if outer else 0.5 * (pitch - diameter)
    bodies = Bodies.of(
        Body(2.0 / diameter, 2.0 / diameter), Body(1.0 / along, -1.0 / (osculation * diameter))
    )
    radii = [1.0 / (2.0 / diameter + k) for k in (bodies.near.along, bodies.near.across)]
    dry = dry_contact(800.0, *radii, 226e9)
    domain = -4.5 * dry.semi_axis_x, 1.5 * dry.semi_axis_x, 1.7 * dry.semi_axis_y
    film = dry_film(bodies, dry, 226e9, domain)
    x, y = np.meshgrid(*film[:2], indexing="ij")
    rim = np.ones_like(film[2], dtype=bool)
    rim[1:-1, 1:-1] = False
    matched = match_film(race, dry, 226e9, x=x[rim], y=y[rim], thickness=film[2][rim])
    exact = outside_capacitance(race, matched, domain)
    width = 2.0 * osculation * diameter * np.sin(race.shoulder_angle)
    outside, mismatch = around_point(bodies, dry, 226e9, film, width=width)
    assert np.sum(outside.capacitances(1.0)) == pytest.approx(exact, rel=3e-3)
    assert mismatch < 1e-6 + 2.0 * matched.mismatch


def test_outside_of_a_larger_domain_is_less_by_the_gap_between_both():
    dry = dry_contact(20.0, R, R, E)
    b = dry.semi_axis_x
    small, large = (dry_film(ON_PLANE, dry, E, (-k * b, k * b, k * b), nodes=(201, 201)) for k in (3.0, 5.0))
    found = [
        float(np.sum(around_point(ON_PLANE, dry, E, film)[0].capacitances(1.0))) for film in (small, large)
    ]
    x, y, gap = large
    between = np.where((abs(x)[:, np.newaxis] > 3.0 * b) | (abs(y) > 3.0 * b), epsilon_0 / gap, 0.0)
    assert found[0] - found[1] == pytest.approx(np.trapezoid(np.trapezoid(between, y), x), rel=0.02)


def test_parts_between_circles_add_up_and_nodes_are_enough(monkeypatch):
    dry = dry_contact(20.0, R, R, E)
    b = dry.semi_axis_x
    film = dry_film(ON_PLANE, dry, E, (-4.5 * b, 3.0 * b, 3.0 * b))

    def capacitance(ring):
        return float(np.sum(around_point(ON_PLANE, dry, E, film, ring=ring)[0].capacitances(1.0)))

    whole = capacitance((0.0, np.inf))
    parts = capacitance((0.0, 4.0 * b)), capacitance((4.0 * b, 2e-3)), capacitance((2e-3, np.inf))
    assert sum(parts) == pytest.approx(whole, rel=2e-3)
    monkeypatch.setattr(gaps, "_ALONG_EDGE", 64)
    monkeypatch.setattr(gaps, "_OUTWARDS", 80)
    assert capacitance((0.0, np.inf)) == pytest.approx(whole, rel=1e-4)


def test_coating_is_in_series_place_by_place():
    dry = dry_contact(20.0, R, R, E)
    b = dry.semi_axis_x
    film = dry_film(ON_PLANE, dry, E, (-4.5 * b, 3.0 * b, 3.0 * b))
    outside, _ = around_point(ON_PLANE, dry, E, film)
    thin, thick = (np.sum(outside.capacitances(2.0, coating)) for coating in (1e-9, 2e-5))
    assert thin == pytest.approx(np.sum(outside.capacitances(2.0)), rel=1e-3)
    # Less than without the coating, and more than that of a lumped capacitor of the same thickness in series.
    assert 0.7 * thin < thick < thin


def test_width_ends_the_gap_of_a_crowned_roller():
    """A crown of 0.5 m is nearly a cylinder at each place of its width, with its gap and radius there."""
    radius, crown = 5e-3, 0.5
    roller = Bodies.of(Body(1.0 / radius, 1.0 / crown), PLANE)
    narrow, wide = (rigid_ring(roller, 1e-6, 4e-4, width=width) for width in (8e-3, 16e-3))

    def per_length(y):
        lower = 0.5 * y**2 / crown
        return roller_capacitance(RollerRaceway(radius - lower, 1e4, outer=False), 1e-6 + lower)

    exact = 2.0 * quad(per_length, 4e-3, 8e-3)[0]
    assert wide - narrow == pytest.approx(exact, rel=1e-4)


def test_opening_of_a_line_is_flat_within_the_contact():
    x = np.linspace(-1e-4, 1e-4, 5)
    gap = 0.5 * x**2 / R + line_opening(x, 2e-4, R)
    np.testing.assert_allclose(gap, 0.0, atol=1e-18)
