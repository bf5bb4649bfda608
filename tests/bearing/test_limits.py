"""Duties that no bearing has, and what is warned of, against grooves, films and weights by hand."""

import math

import numpy as np
import pytest

from ehlectric import ConvergenceError, InputError
from ehlectric.bearing.loads.ball_loads import ball_equilibrium
from ehlectric.bearing.loads.ring import Operation
from ehlectric.bearing.preparation import (
    check_film,
    check_shoulders,
    equilibria_of,
    resolve_bearing,
    shoulder_angle,
)
from ehlectric.bearing.result import check_bearing, solve_bearing
from ehlectric.bearing.ring_contacts import RollerContact
from tests.helpers.bearings import BALLS, BALLS_IN_SI, ROLLERS, bearing_case, ring_of
from tests.helpers.each import each

ANGULAR = {
    "bearing__kind": "angular-contact ball",
    "bearing__contact_angle": "40 deg",
    "bearing__radial_clearance": None,
}
VG_460 = {
    "lubricant__temperature__kinematic_viscosity_40": "460 mm^2/s",
    "lubricant__temperature__kinematic_viscosity_100": "30 mm^2/s",
}


def by_formula(tables, **changes):
    return solve_bearing(bearing_case(tables, contacts="formula", **changes))


def refusal(tables, **changes):
    """The line that both the check and the solution refuse a bearing with, its contacts solved or not."""
    texts = set()
    for contacts in ("formula", "solved"):
        case = bearing_case(tables, contacts=contacts, **changes)
        for refused in (check_bearing, solve_bearing):
            with pytest.raises(InputError) as found:
                refused(case)
            texts.add(str(found.value))
    assert len(texts) == 1
    return texts.pop()


def about(result, word):
    return [text for text in map(str, result.warnings) if word in text]


@each("radial, axial", [(1e-30, 0.0), (1e-6, 1e-4), (1e-4, 1e-4), (0.06, 0.0)])
def test_a_load_is_more_than_the_weight_of_a_ball(radial, axial):
    """A steel ball of 11.906 mm: 7830 kg/m^3 pi D^3/6 9.807 m/s^2 = 0.0679 N."""
    text = refusal(BALLS, bearing__radial_load=radial, bearing__axial_load=axial)
    assert text.startswith("bearing.radial_load: ")
    assert "0.068 N" in text


@pytest.mark.parametrize("load", [0.07, 1.0])
def test_light_loads_balance_beside_the_centrifugal_force(load):
    """The rings' balance again from the contacts, to 1e-9 of F_c = 3.3 N and the load."""
    case = bearing_case(BALLS, bearing__radial_load=load, bearing__axial_load=0.0)
    for at in equilibria_of(resolve_bearing(case), 8):
        lifted = at.inner_load * np.cos(at.inner_angle) * np.cos(at.position)
        assert np.sum(lifted) == pytest.approx(load, abs=1e-9 * (load + at.centrifugal_force))
        assert at.residual < 1e-9
        assert at.centrifugal_force > 3.0


def test_a_load_of_next_to_nothing_has_no_balance():
    """From Python, where nothing is refused before: no error of division."""
    geometry = resolve_bearing(bearing_case(BALLS)).geometry
    try:
        state = ball_equilibrium(
            geometry, Operation(radial_load=1e-30, axial_load=0.0, inner_speed=314.0), 226e9, 7800.0
        )
    except ConvergenceError:
        return
    assert state.residual < 1e-9


@pytest.mark.parametrize("temperature", ["-70 degC", "-30 degC"])
def test_films_without_room_are_refused(temperature):
    """A tenth of (0.52 - 0.5) 11.906 mm is 23.8 um."""
    text = refusal(BALLS, bearing__temperature=temperature)
    assert text.startswith("bearing: ")
    assert "inner film" in text
    assert "23.8 um" in text
    assert refusal(BALLS, **VG_460, bearing__temperature="0 degC", bearing__inner_speed="10000 rpm")


def test_a_roller_is_a_parabola_as_far_as_its_film_builds_up():
    """sqrt(2 R h) = 0.1 r: of 5.5 mm on 24.5 mm, R = 4.4917 mm, 33.7 um."""
    ring = ring_of(bearing_case(ROLLERS), speed=4.55)
    for load in (0.2, 0.3, 0.5):
        # Of rigid bodies without a pressure-viscosity effect (Martin), h = 4.896 eta u R L/Q.
        film = 4.896 * ring.conditions.oil.viscosity * 4.55 * 4.4917e-3 * 0.01 / load
        if film > 33.7e-6:
            with pytest.raises(InputError, match=r" 33\.7 um"):
                check_film(RollerContact(ring, load))
        else:
            check_film(RollerContact(ring, load))


@pytest.mark.parametrize(("temperature", "warned"), [("20 degC", True), ("70 degC", False)])
def test_films_that_take_up_the_clearance_are_warned_of(temperature, warned):
    """A third of 10 um; the films again from the rows of the ball on the load line."""
    result = by_formula(BALLS, **VG_460, bearing__temperature=temperature)
    films = sum(row["central_thickness"] for row in result.contacts()[:2])
    assert (films > 10e-6 / 3.0) == warned
    texts = about(result, "clearance")
    assert len(texts) == warned
    if warned:
        assert f"{1e6 * films:.2g} µm" in texts[0]
        assert " 10 µm" in texts[0]


def test_films_of_preloaded_elements_stand_beside_their_approach():
    changes = {"bearing__radial_clearance": "-2 um", "bearing__radial_load": "1 kN"}
    changes |= {"bearing__axial_load": 0.0}
    thick = by_formula(BALLS, **VG_460, bearing__temperature="20 degC", **changes)
    assert len(about(thick, "elastic approach")) == 1
    assert not about(by_formula(BALLS, **changes), "elastic approach")


def test_the_shoulder_is_as_high_as_it_says():
    """H = f D (1 - cos) of the angle is shoulder_height D."""
    bearing = bearing_case(BALLS, bearing__outer_groove=0.53, bearing__shoulder_height=0.19).bearing
    for inner, groove in ((True, 0.52), (False, 0.53)):
        angle = shoulder_angle(bearing, inner=inner)
        assert groove * (1.0 - math.cos(angle)) == pytest.approx(0.19, rel=1e-12, abs=0.0)


@pytest.mark.parametrize(
    ("changes", "rings"),
    [
        (ANGULAR | {"bearing__radial_load": "3 kN", "bearing__axial_load": "10 kN"}, 2),
        ({"bearing__shoulder_height": 0.01}, 2),
        ({}, 0),
        (ANGULAR | {"bearing__radial_load": 0.0, "bearing__axial_load": "100 N"}, 0),
    ],
)
def test_ellipses_over_the_shoulder_are_warned_of(changes, rings):
    """Angle and half of the ellipse over f D, from the rows, beside arccos(1 - H/f)."""
    result = by_formula(BALLS, **changes)
    texts = about(result, "shoulder")
    assert len(texts) == rings
    end = math.acos(1.0 - changes.get("bearing__shoulder_height", 0.2) / 0.52)
    rows = [row for row in result.contacts() if row["load"] > 0.0]
    over = {
        row["ring"] for row in rows if row["contact_angle"] + row["semi_axis_y"] / (0.52 * 11.906e-3) > end
    }
    assert over == {text.split()[0] for text in texts}


def test_contacts_beyond_the_shoulder_are_refused():
    """Balls pressed up by an axial load alone: all at the same angle, which is the refusal's."""
    changes = ANGULAR | {"bearing__radial_load": 0.0, "bearing__axial_load": "10 kN"}
    angle = by_formula(BALLS, **changes).contacts()[0]["contact_angle"]
    height = 0.52 * (1.0 - math.cos(angle))
    text = refusal(BALLS, **changes, bearing__shoulder_height=0.98 * height)
    assert text.startswith("bearing.shoulder_height: ")
    # The angle differs between the points of a sweep, so the text has no angle of a contact.
    assert f" {math.degrees(angle):.1f} deg" not in text
    by_formula(BALLS, **changes, bearing__shoulder_height=1.02 * height)


def shoulder_error(**changes):
    """Refusal of a 7208 B, whose shoulder ends 66 degrees above the bottom of the inner groove."""
    table = BALLS_IN_SI | {"base": "7208-b", "element_material": "steel", "ring_material": "steel"}
    table.pop("radial_clearance")
    case = bearing_case({**BALLS, "bearing": table | changes}, contacts="formula")
    conditions = resolve_bearing(case)
    try:
        check_shoulders(conditions, equilibria_of(conditions, 8))
    except InputError as error:
        return error
    return None


FAST, HEAVY = {"inner_speed": 733.0, "axial_load": 1000.0}, {"radial_load": 0.0, "shoulder_height": 0.15}


def test_a_fast_bearing_needs_more_axial_load():
    """Centrifugal force raises inner contact angles most at small axial loads (T. A. Harris)."""
    error = shoulder_error(**FAST)
    assert "inner groove" in error.text
    assert "more axial load" in error.takes
    assert "less axial load" not in error.takes
    assert "a lower speed" in error.takes
    assert shoulder_error(**FAST | {"axial_load": 2000.0}) is None


def test_a_slow_bearing_needs_less_axial_load():
    """An axial load raises the contact angles of a ball bearing at rest."""
    error = shoulder_error(**HEAVY, inner_speed=10.0, axial_load=40e3)
    assert "less axial load" in error.takes
    assert "more axial load" not in error.takes
    assert "speed" not in error.takes
    assert shoulder_error(**HEAVY, inner_speed=10.0, axial_load=4e3) is None


def test_points_beyond_the_shoulder_have_one_reason():
    """The largest angle of a contact, which differs, is a value of the error."""
    errors = [shoulder_error(**FAST | {"axial_load": load}) for load in (1000.0, 1005.0, 1010.0)]
    assert len({str(error) for error in errors}) == 1
    assert len({error.got for error in errors}) == 3
