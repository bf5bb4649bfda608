"""What a bearing's rings give to formulas and gaps: radii, raceways and films that are made by hand."""

import math

import numpy as np
import pytest

from ehlectric.bearing.gaps import (
    LoadedContact,
    Raceway,
    RollerRaceway,
    groove_capacitance,
    groove_gap,
    outside_capacitance,
    roller_capacitance,
    roller_tails,
)
from ehlectric.bearing.ring_contacts import (
    BallContact,
    RollerContact,
)
from ehlectric.formulas.hertz import dry_contact, point_deflection
from tests.helpers.bearings import BALLS, ROLLERS, bearing_case, changed, rigid_capacitance, ring_of
from tests.helpers.each import each
from tests.helpers.oils import alpha_star

D, PITCH = 11.906e-3, 60e-3
MODULUS = 208e9 / (1.0 - 0.3**2)
VISCOSITY = 14.847e-6 * 838.90
ALPHA = alpha_star(0.67 * (math.log(VISCOSITY) + 9.67) / 0.198e9)
UNLIKE = changed(BALLS, bearing__outer_groove=0.53)
RINGS = [(True, 0.52, 1.0), (False, 0.53, -1.0)]


def of(tables, *, inner, angle=0.0):
    return ring_of(bearing_case(tables), inner=inner, angle=angle, speed=4.5)


def radii(groove, sign, angle):
    """Harris: 1/Rx = 2/D +- 2 cos a/(d_m -+ D cos a), upper signs inside, and 1/Ry = 2/D - 1/(f D)."""
    rolling = 2.0 / D + sign * 2.0 * math.cos(angle) / (PITCH - sign * D * math.cos(angle))
    return 1.0 / rolling, 1.0 / (2.0 / D - 1.0 / (groove * D))


@pytest.mark.parametrize(("inner", "groove", "sign"), RINGS)
def test_balls_contacts_by_hand(inner, groove, sign):
    """Radii, modulus of steel, and oil of 70 degC; the raceway's arc ends arccos(1 - 0.2/f) up the groove."""
    ring = of(UNLIKE, inner=inner, angle=0.3)
    contact, raceway = BallContact(ring, 600.0).conditions.contact, ring.raceway
    rx, ry = radii(groove, sign, 0.3)
    found = [contact.radius_x, contact.radius_y, contact.reduced_modulus, contact.load]
    assert found == pytest.approx([rx, ry, MODULUS, 600.0], rel=1e-12, abs=0.0)
    found = [contact.entrainment_speed, contact.viscosity, contact.pressure_viscosity_coefficient]
    assert found == pytest.approx([4.5, VISCOSITY, ALPHA], rel=1e-4, abs=0.0)
    shoulder = math.acos(1.0 - 0.2 / groove)
    lengths = [raceway.ball_radius, raceway.groove_radius, raceway.pitch_radius, raceway.shoulder_angle]
    assert lengths == pytest.approx([0.5 * D, groove * D, 0.5 * PITCH, shoulder], rel=1e-12, abs=0.0)
    assert (raceway.contact_angle, raceway.outer) == (0.3, not inner)


@pytest.mark.parametrize(("inner", "race_radius"), [(True, 24.5e-3), (False, -35.5e-3)])
def test_rollers_contacts_by_hand(inner, race_radius):
    """1/R of 5.5 mm and (60 -+ 11)/2 mm; 1200 N on 10 mm."""
    contact = RollerContact(of(ROLLERS, inner=inner), 1200.0).conditions.contact
    reduced = 1.0 / (1.0 / 5.5e-3 + 1.0 / race_radius)
    found = [contact.reduced_radius, contact.reduced_modulus, contact.load_per_length]
    assert found == pytest.approx([reduced, MODULUS, 120e3], rel=1e-12, abs=0.0)
    found = [contact.entrainment_speed, contact.viscosity, contact.pressure_viscosity_coefficient]
    assert found == pytest.approx([4.5, VISCOSITY, ALPHA], rel=1e-4, abs=0.0)


@each("inner, groove, sign", RINGS)
@each("angle", [0.0, 0.3])
def test_around_a_balls_film(inner, groove, sign, angle):
    """Of a film that is the deformed gap itself nothing is missed, and what is around it is that gap's."""
    ring = of(UNLIKE, inner=inner, angle=angle)
    raceway = Raceway.of(D, PITCH, groove, 0.2, outer=not inner, contact_angle=angle)
    dry = dry_contact(600.0, *radii(groove, sign, angle), MODULUS)
    b, a = dry.semi_axis_x, dry.semi_axis_y
    x, y = np.linspace(-4.0 * b, 1.5 * b, 45), np.linspace(-1.6 * a, 1.6 * a, 31)
    offset = 3e-7 - dry.approach
    at = np.meshgrid(x, y, indexing="ij")
    film = groove_gap(raceway, offset, *at) + point_deflection(*at, dry, MODULUS)
    # Within its edge a film may be anything.
    film[1:-1, 1:-1] = 3e-7
    found, mismatch = BallContact(ring, 600.0).around((x, y), film)
    expected = outside_capacitance(raceway, LoadedContact(dry, MODULUS, offset, 0.0), (x[0], x[-1], y[-1]))
    assert mismatch < 1e-9
    assert found == pytest.approx(expected, rel=1e-9, abs=0.0)


@pytest.mark.parametrize(("inner", "race_radius"), [(True, 24.5e-3), (False, 35.5e-3)])
def test_around_a_rollers_film(inner, race_radius):
    """Tails of 10 mm length from both ends, of which the inlet is further out."""
    b, x = 1e-4, np.linspace(-4e-4, 2e-4, 7)
    film = 5e-7 + 1e-5 * (x / 4e-4) ** 2
    tails = roller_tails(
        RollerRaceway(5.5e-3, race_radius, not inner), b, (-4e-4, 2e-4), (5e-7 + 1e-5, 5e-7 + 2.5e-6)
    )
    ring = of(ROLLERS, inner=inner)
    load = np.pi * MODULUS * 10e-3 * b**2 / (8.0 * ring.radii.radius_x)
    found, _ = RollerContact(ring, load).around((x,), film)
    assert found == pytest.approx(10e-3 * sum(tails), rel=1e-12, abs=0.0)


@pytest.mark.parametrize(("inner", "groove", "sign"), RINGS)
def test_rigid_bodies_apart(inner, groove, sign):
    """Balls in grooves at their contact angle, and rollers on races of (60 -+ 11)/2 mm, 10 mm long."""
    raceway = Raceway.of(D, PITCH, groove, 0.2, outer=not inner, contact_angle=0.3)
    found = rigid_capacitance(of(UNLIKE, inner=inner, angle=0.3), 5e-6)
    assert found == pytest.approx(groove_capacitance(raceway, 5e-6), rel=1e-12, abs=0.0)
    race = RollerRaceway(5.5e-3, 0.5 * (60e-3 - sign * 11e-3), outer=not inner)
    found = rigid_capacitance(of(ROLLERS, inner=inner), 5e-6)
    assert found == pytest.approx(10e-3 * roller_capacitance(race, 5e-6), rel=1e-12, abs=0.0)
