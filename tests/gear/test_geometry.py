"""Geometry of gear pairs and their paths of contact."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import ehlectric
from ehlectric.errors import InputError
from ehlectric.gear.contact_path import contact_path
from ehlectric.gear.geometry import Drawing, gear_pair, involute, pressure_angle
from tests.gear.pairs import FIRST_STAGE, FZG_A, FZG_C, SECOND_STAGE, case_of
from tests.helpers.each import each


@given(st.floats(1e-6, 1.5))
def test_the_pressure_angle_inverts_the_involute(angle):
    assert pressure_angle(involute(angle)) == pytest.approx(angle, rel=1e-9)


def test_the_pitch_point_of_the_fzg_gears():
    """ISO 14635-1 prints 22.44 degrees, and working diameters of 73.2 and 109.8 mm."""
    pair = gear_pair(FZG_A)
    assert math.degrees(pair.working_pressure_angle) == pytest.approx(22.44, abs=0.01)
    assert pair.working_diameter == pytest.approx((73.2e-3, 109.8e-3), rel=1e-12)


def test_the_path_of_fzg_type_c_is_that_of_another_program():
    """GEARpie (Universidade do Porto) reports AB 5.81, AC 9.50, AD 13.28, AE 19.10 and T1T2 34.93 mm."""
    path = contact_path(gear_pair(FZG_C))
    lengths = [1e3 * (path.points[point] - path.start) for point in "BCDE"]
    assert lengths == pytest.approx([5.81, 9.50, 13.28, 19.10], abs=0.005)
    assert 1e3 * path.tangent_length == pytest.approx(34.93, abs=0.005)


# Places g of A to E, reduced radii there and T1T2 [mm], working pressure angle [degree] and transverse
# contact ratio, which a separate program computed.
COMPUTED = {
    "FZG C": (
        FZG_C,
        (4.47230, 10.28480, 13.97008, 17.75689, 23.56939),
        (3.89960, 7.25612, 8.38205, 8.72882, 7.66351),
        (34.92521, 22.43879, 1.43754),
    ),
    "FZG A": (FZG_A, (10.65239, 15.44921, 13.97008, 23.93698, 28.73380), None, (34.92521, 22.43879, 1.36108)),
    "first stage": (
        FIRST_STAGE,
        (5.18586, None, 8.34972, None, 13.21617),
        (4.75369, None, 6.77289, None, 8.57545),
        (None, 22.05827, 1.42655),
    ),
    "second stage": (
        SECOND_STAGE,
        (4.14006, None, 9.25647, None, 15.66471),
        (3.92685, None, 7.67554, None, 10.64880),
        (None, 21.64752, 1.49425),
    ),
}


@pytest.mark.parametrize("name", COMPUTED)
def test_paths_of_a_separate_program(name):
    """All numbers to the five decimals of that program."""
    drawing, places, radii, (tangent, angle, ratio) = COMPUTED[name]
    pair = gear_pair(drawing)
    path = contact_path(pair)
    g = np.array(list(path.points.values()))
    rows = [(1e3 * g, places), (1e3 * path.reduced_radius(g), radii or [None] * 5)]
    rows += [
        ([1e3 * path.tangent_length], [tangent]),
        ([math.degrees(pair.working_pressure_angle)], [angle]),
        ([path.contact_ratio], [ratio]),
    ]
    for values, expected in rows:
        for value, number in zip(values, expected, strict=True):
            assert number is None or value == pytest.approx(number, abs=6e-6)


def test_speeds_of_a_separate_program():
    """Both flanks of FZG type C at A to E [m/s], at 2170 rpm."""
    pair = gear_pair(FZG_C)
    path = contact_path(pair)
    first, second = path.speeds(np.array(list(path.points.values())), 2170.0 * math.pi / 30.0, pair.ratio)
    assert first == pytest.approx([1.01629, 2.33714, 3.17459, 4.03511, 5.35595], abs=6e-6)
    assert second == pytest.approx([4.61345, 3.73289, 3.17459, 2.60091, 1.72034], abs=6e-6)


def involute_curve(base_radius, start):
    """Points of an involute around the origin that begins at an angle [rad] on its base circle."""
    roll = np.linspace(0.0, 1.5, 300_001)
    return base_radius * np.exp(1j * (start + roll)) * (1.0 - 1j * roll)


@pytest.mark.parametrize("drawing", [FZG_A, FZG_C])
@pytest.mark.parametrize("start", [-0.2, -0.05, 0.1])
def test_involutes_drawn_as_curves_touch_on_the_path(drawing, start):
    """Gear 2 is turned until its curve touches the pinion, where the angle is least. Its distances
    along both tangents of the base circles add up to T1T2, and the pinion's one is the place g.
    """
    pair = gear_pair(drawing)
    path = contact_path(pair)
    rb1, rb2 = (0.5 * diameter for diameter in pair.base_diameter)
    first = involute_curve(rb1, start)
    second = involute_curve(rb2, 0.0)
    from_centre_2 = pair.centre_distance - first
    turned = np.angle(from_centre_2) - np.interp(np.abs(from_centre_2), np.abs(second), np.angle(second))
    reached = (np.abs(from_centre_2) > 1.0001 * rb2) & (np.abs(first) > 1.0001 * rb1)
    touching = np.flatnonzero(reached)[np.argmax(turned[reached])]
    g = math.sqrt(abs(first[touching]) ** 2 - rb1**2)
    rest = math.sqrt(abs(from_centre_2[touching]) ** 2 - rb2**2)
    assert g + rest == pytest.approx(path.tangent_length, rel=2e-4)
    assert rest == pytest.approx(path.transverse_radii(g)[1], rel=5e-4)


@pytest.mark.parametrize("drawing", [FZG_A, FZG_C, FIRST_STAGE, SECOND_STAGE])
def test_both_flanks_have_one_normal_speed_and_roll_at_the_pitch_point(drawing):
    pair = gear_pair(drawing)
    path = contact_path(pair)
    first, second = path.speeds(path.pitch_point, 100.0, pair.ratio)
    assert first == pytest.approx(second, rel=1e-12)
    # Sliding is the sum of both angular speeds times the distance from the pitch point.
    for place in (path.start, path.end):
        first, second = path.speeds(place, 100.0, pair.ratio)
        expected = (100.0 + 100.0 / pair.ratio) * (place - path.pitch_point)
        assert first - second == pytest.approx(expected, rel=1e-12)


def test_shifts_and_distances_follow_from_each_other():
    """The sum of the shifts that a centre distance needs gives this centre distance."""
    pair = gear_pair(FIRST_STAGE)
    again = gear_pair(replace(FIRST_STAGE, centre_distance=None, profile_shift=pair.profile_shift))
    assert again.centre_distance == pytest.approx(87e-3, rel=1e-12)


def test_backlash_is_measured_along_the_line_of_action():
    """A centre distance that is larger by da gives 2 da sin alpha_w of backlash to first order."""
    larger = replace(FZG_C, centre_distance=91.5e-3 + 50e-6)
    pair = gear_pair(larger)
    assert pair.normal_backlash == pytest.approx(
        2.0 * 50e-6 * math.sin(pair.working_pressure_angle), rel=0.05
    )
    assert gear_pair(FZG_C).normal_backlash is None


def test_helix_to_zero_is_the_spur_pair():
    spur, helical = (contact_path(gear_pair(replace(FZG_C, helix_angle=angle))) for angle in (0.0, 1e-6))
    for one, other in zip(spur.points.values(), helical.points.values(), strict=True):
        assert one == pytest.approx(other, rel=1e-9)


def test_a_wheel_of_many_teeth_is_a_rack():
    """A rack moves along its pitch line: v_2 = omega r_w sin alpha at all places, and its flank is plane."""
    teeth = 2_000_000
    drawing = replace(
        FZG_C, teeth=(30, teeth), centre_distance=None, profile_shift=(0.0, 0.0), tip_diameter=(None, None)
    )
    pair = gear_pair(drawing)
    path = contact_path(pair)
    for place in (path.start, path.end):
        _, second = path.speeds(place, 10.0, pair.ratio)
        assert second == pytest.approx(10.0 * 67.5e-3 * math.sin(20.0 * math.pi / 180.0), rel=1e-4)
        assert path.reduced_radius(place) == pytest.approx(place, rel=1e-4)


def test_a_ring_has_a_concave_flank():
    """In a ring the reduced radius is 1/(1/rho_1 - 1/abs(rho_2)), larger than the pinion's."""
    drawing = replace(
        FZG_C, teeth=(20, -60), centre_distance=None, profile_shift=(0.0, 0.0), tip_diameter=(98e-3, 264e-3)
    )
    pair = gear_pair(drawing)
    path = contact_path(pair)
    first, second = path.transverse_radii(path.pitch_point)
    assert second < 0.0
    assert path.reduced_radius(path.pitch_point) == pytest.approx(
        1.0 / (1.0 / first + 1.0 / second), rel=1e-12
    )
    assert path.reduced_radius(path.pitch_point) > first
    assert pair.centre_distance == pytest.approx(-0.5 * (60 - 20) * 4.5e-3, rel=1e-12)


PLAIN = {"centre_distance": None, "profile_shift": (0.0, 0.0), "tip_diameter": (None, None)}
BAD = {
    "overlap": ({"centre_distance": 91e-3}, "the teeth would overlap"),
    "base circles": ({"centre_distance": 80e-3}, "base circles would touch"),
    "no shift": ({"profile_shift": (None, None)}, "the sum of both is"),
    "one shift": ({"centre_distance": None, "profile_shift": (0.2, None)}, "both profile shifts"),
    "pointed": ({"tip_diameter": (105e-3, 118e-3)}, "pointed teeth"),
    # d + 2 m (1 + x) = 72 + 9*1.1817 mm
    "no involute": ({"tip_diameter": (60e-3, 118e-3)}, "base circle.* 82.635 mm with 16 teeth"),
    "undercut": ({**PLAIN, "teeth": (8, 32)}, "base circle of gear 1"),
    "no contact": ({"tip_diameter": (76e-3, 113e-3)}, "no pair of teeth"),
    "backlash": ({"centre_distance": 91.6e-3, "normal_backlash": 1e-6}, "at least"),
    "ring": ({"teeth": (24, -24)}, "more teeth than"),
}


@pytest.mark.parametrize("name", BAD)
def test_impossible_drawings_are_refused_with_the_reason(name):
    changes, reason = BAD[name]
    with pytest.raises(InputError, match=reason):
        contact_path(gear_pair(replace(FZG_C, **changes)))


def test_the_involute_begins_where_the_tip_of_the_rack_cut_it():
    """A rack with a straight flank to one module below its datum line makes a gear. The normal of its last
    straight point passes the pitch point when the gear touches it there.
    """
    pair = gear_pair(FZG_C)
    radius, angle, module = 0.5 * pair.reference_diameter[0], pair.transverse_pressure_angle, 4.5e-3
    # Depth of the last straight point below the pitch line of the rack, which the shift moves outwards.
    depth = (1.0 - 0.1817) * module
    along = depth / math.sin(angle)
    # The line of action passes the pitch point; its tangent point on the base circle is r sin(alpha) away.
    assert pair.form_curvature[0] == pytest.approx(radius * math.sin(angle) - along, rel=1e-12)
    point = np.array([radius - depth, along * math.cos(angle)])
    base = radius * math.cos(angle)
    assert math.sqrt(point @ point - base**2) == pytest.approx(pair.form_curvature[0], rel=1e-12)


@pytest.mark.parametrize(("tip", "warned"), [("138.9 mm", False), ("139.9 mm", True)])
def test_contact_in_the_fillet_is_a_warning(tip, warned):
    """Spur pair of 21 and 44 teeth of 3 mm: the involute of the pinion begins at a curvature of 4.2 mm."""
    changes = {
        "gear.normal_module": "3 mm",
        "gear.teeth": [21, 44],
        "gear.centre_distance": "98.5 mm",
        "gear.profile_shift": [0.25],
        "gear.face_width": "20 mm",
        "gear.tip_diameter": ["70.2 mm", tip],
    }
    result = ehlectric.solve_gear(case_of().replace(changes), probable=False)
    texts = [str(each) for each in result.warnings if each.code == "contact-in-fillet"]
    assert bool(texts) is warned
    if warned:
        assert "from 4.19 mm" in texts[0] or "from 4.20 mm" in texts[0]


@each("larger", [20e-6, 100e-6, 0.3e-3])
def test_the_backlash_that_follows_from_other_numbers_may_be_given(larger):
    drawing = replace(FZG_C, centre_distance=FZG_C.centre_distance + larger)
    backlash = gear_pair(drawing).normal_backlash
    assert gear_pair(replace(drawing, normal_backlash=backlash)).normal_backlash == backlash
    with pytest.raises(InputError, match="normal_backlash"):
        gear_pair(replace(drawing, normal_backlash=0.5 * backlash))


@pytest.mark.parametrize("shift", [1.0, 0.5, 0.1, 0.0, -0.5])
def test_a_ring_needs_a_smaller_sum_of_shifts(shift):
    """inv alpha_w = inv alpha - 2 x tan alpha/8 of 16 and -24 teeth is negative above x = 0.1638."""
    drawing = Drawing(3e-3, (16, -24), math.radians(20.0), 0.0, 18e-3, None, (0.0, shift), (54e-3, 69.4e-3))
    if shift > 0.1638:
        with pytest.raises(InputError, match=r"a smaller sum of both.*positive towards the axis"):
            gear_pair(drawing)
    else:
        assert gear_pair(drawing).working_pressure_angle > 0.0
