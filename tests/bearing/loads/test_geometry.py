"""Bearing geometry against Harris' closed forms and the geometry by hand."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from ehlectric import InputError
from ehlectric.bearing.loads.geometry import BallBearing, RollerBearing
from tests.helpers.each import each

BALLS = {
    "elements": 9,
    "ball_diameter": 11.906e-3,
    "pitch_diameter": 60e-3,
    "inner_groove": 0.52,
    "outer_groove": 0.53,
}
ROLLERS = {
    "elements": 14,
    "roller_diameter": 11e-3,
    "pitch_diameter": 60e-3,
    "roller_length": 11e-3,
    "radial_clearance": 20e-6,
}


def balls(**other):
    return BallBearing(**(BALLS | {"radial_clearance": 10e-6} | other))


def test_lengths_by_hand():
    """A = 0.05 D; sin^2 a0 = 1 - (1 - P/2A)^2, so that the endplay 2 A sin a0 is sqrt(4 P A - P^2)."""
    bearing = balls()
    a = 0.05 * 11.906e-3
    assert bearing.groove_distance == pytest.approx(a, rel=1e-14, abs=0.0)
    assert math.cos(bearing.free_angle) == pytest.approx(1.0 - 10e-6 / (2.0 * a), rel=1e-14, abs=0.0)
    assert bearing.endplay == pytest.approx(math.sqrt(4 * 10e-6 * a - 1e-10), rel=1e-12, abs=0.0)
    assert bearing.radial_distance == pytest.approx(a - 5e-6, rel=1e-14, abs=0.0)
    assert bearing.element_mass(7800.0) == pytest.approx(7800.0 * 4 / 3 * math.pi * 5.953e-3**3, rel=1e-14)


@given(angle=st.floats(0.01, 1.5))
def test_clearance_and_free_angle_are_each_others_inverse(angle):
    given_angle = BallBearing(**BALLS, contact_angle=angle)
    back = balls(radial_clearance=given_angle.clearance)
    assert back.free_angle == pytest.approx(angle, rel=1e-12, abs=0.0)
    assert back.radial_distance == pytest.approx(given_angle.radial_distance, rel=1e-12, abs=0.0)
    assert back.inner_centre_radius == pytest.approx(
        30e-3 + 0.02 * 11.906e-3 * math.cos(angle), rel=1e-12, abs=0.0
    )


def test_preload_has_no_free_angle():
    bearing = balls(radial_clearance=-4e-6)
    assert bearing.free_angle == 0.0
    assert bearing.endplay == 0.0
    assert bearing.radial_distance == pytest.approx(bearing.groove_distance + 2e-6, rel=1e-12, abs=0.0)


@given(angle=st.floats(-1.5, 1.5))
def test_curvature_sums_of_harris(angle):
    """Sum of curvatures (4 - 1/f + 2 g/(1 - g))/D at the inner, (4 - 1/f - 2 g/(1 + g))/D at the outer."""
    bearing = balls()
    d, gamma = 11.906e-3, 11.906 / 60 * math.cos(angle)
    for inner, groove, rolling in (
        (True, 0.52, 2.0 * gamma / (1.0 - gamma)),
        (False, 0.53, -2.0 * gamma / (1.0 + gamma)),
    ):
        radii = bearing.radii(angle, inner=inner)
        total = 1.0 / radii.radius_x + 1.0 / radii.radius_y
        assert total == pytest.approx((4.0 - 1.0 / groove + rolling) / d, rel=1e-12, abs=0.0)
        assert radii.ring_y == -groove * d
        assert radii.radius_y > radii.radius_x > 0.0


def test_race_at_90_degrees_is_flat_in_the_rolling_direction():
    radii = balls().radii(math.pi / 2.0, inner=True)
    assert radii.radius_x == pytest.approx(11.906e-3 / 2, rel=1e-12, abs=0.0)


def test_rollers_touch_their_races_in_lines():
    """1/R = 2/D + 2/(d_m - D) inside, 2/D - 2/(d_m + D) outside."""
    bearing = RollerBearing(**ROLLERS)
    for inner, race in ((True, 49e-3 / 2), (False, -71e-3 / 2)):
        radii = bearing.radii(inner=inner)
        assert radii.radius_x == pytest.approx(1.0 / (1.0 / 5.5e-3 + 1.0 / race), rel=1e-12, abs=0.0)
        assert math.isinf(radii.radius_y)
    assert bearing.element_mass(7800.0) == pytest.approx(7800 * math.pi * 5.5e-3**2 * 11e-3, rel=1e-14)


@pytest.mark.parametrize(("length", "depth"), [(11e-3, 0.00035), (27e-3, 0.00035), (40e-3, 0.0005)])
def test_relief_of_the_logarithmic_profile(length, depth):
    """Where the argument of the logarithm is e the relief is its factor times D; straight in the middle."""
    bearing = RollerBearing(**(ROLLERS | {"roller_length": length}))
    end = min(length, 27.5e-3) / 2.0
    unit = length / 2.0 - end + end * math.sqrt(1.0 - 1.0 / math.e)
    relief = bearing.relief([-unit, 0.0, unit, length / 2.0 - end])
    np.testing.assert_allclose(relief, [depth * 11e-3, 0.0, depth * 11e-3, 0.0], rtol=1e-12, atol=1e-18)
    x = np.linspace(0.0, 0.499 * length, 200)
    assert np.all(np.diff(bearing.relief(x)) >= 0.0)
    assert not RollerBearing(**(ROLLERS | {"profile": "none"})).relief(x).any()


@each(
    "other, message",
    [
        ({"elements": 16}, r"elements: .* 16.* 3 to 15"),
        ({"elements": 2}, r"elements: .* 2;.* 3 to 15"),
        ({"pitch_diameter": 12e-3}, r"pitch_diameter: .* 0\.012 m"),
        ({"pitch_diameter": 11e-3}, r"pitch_diameter: .* 0\.011 m"),
        ({"inner_groove": 0.5}, r"inner_groove: .* 0\.5;.* 0\.5"),
        ({"outer_groove": 1.5}, r"outer_groove: .* 1\.5"),
        ({"contact_angle": 0.3}, r"radial_clearance, contact_angle: "),
        ({"radial_clearance": None}, r"radial_clearance, contact_angle: "),
        ({"radial_clearance": None, "contact_angle": 1.6}, r"contact_angle: .* 1\.6 rad"),
        ({"radial_clearance": 1.2e-3}, r"radial_clearance: .* 0\.0012 m.* 0\.0011906 m"),
    ],
)
def test_what_is_no_ball_bearing(other, message):
    with pytest.raises(InputError, match=f"^{message}") as caught:
        balls(**other)
    assert "\n" not in str(caught.value)


def test_what_is_no_roller_bearing():
    with pytest.raises(InputError, match=r"profile: .*'crowned'.*none, logarithmic"):
        RollerBearing(**(ROLLERS | {"profile": "crowned"}))
    with pytest.raises(InputError, match=r"elements: .* 40"):
        RollerBearing(**(ROLLERS | {"elements": 40}))


def test_elements_that_just_fit():
    """Six circles around one of the same size: d_m = 2 D."""
    assert balls(elements=6, pitch_diameter=2.0000001 * 11.906e-3).elements == 6
    with pytest.raises(InputError, match=r"elements: .* 3 to 5"):
        balls(elements=6, pitch_diameter=1.9999999 * 11.906e-3)
