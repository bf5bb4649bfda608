"""Two rows adjusted against each other: symmetry, limits, a catalogue rule and a separate solution."""

import math

import numpy as np
import pytest
import scipy

from ehlectric import AxleCase, BearingCase, InputError
from ehlectric.axle.adjusted_rows import AdjustedRows
from ehlectric.axle.solution import loads_on_shafts, solve_elements
from ehlectric.bearing import InclinedRow, resolve_bearing
from ehlectric.bearing.preparation import equilibria_of
from ehlectric.cases.axle_inputs import Adjustment
from ehlectric.cases.bearing_inputs import Bearing
from tests.axle.axles import two_stages
from tests.helpers.each import each

ANGLE, ROLLERS, LENGTH, DIAMETER, PITCH = math.radians(14.0), 17, 15e-3, 8.9e-3, 53.5e-3
TAPERED = {
    "kind": "tapered roller",
    "elements": ROLLERS,
    "element_diameter": DIAMETER,
    "pitch_diameter": PITCH,
    "roller_length": LENGTH,
    "contact_angle": ANGLE,
    "profile": "none",
}
ANGULAR = {"base": "7207 B"}


# Speed at which centrifugal forces are negligible [rad/s].
SLOW = 1.0


def row(**bearing):
    table = {"radial_load": 1e3, "axial_load": 1e3, "inner_speed": SLOW, "temperature": 350.0}
    return InclinedRow.of(Bearing.from_dict(table | {"composite_rq": 6e-8} | bearing))


def rows(bearing, *, ascending=True, **adjustment):
    """Two rows that are alike."""
    return AdjustedRows((row(**bearing), row(**bearing)), Adjustment.from_dict(adjustment), ascending)


def shared(pair, radial, axial, speed=SLOW):
    """Axial forces on both rows of one shaft, and whether they are unloaded."""
    share = pair.share(radial, axial, speed)
    return tuple(share.forces[:, 0]), tuple(share.unloaded[:, 0])


@pytest.mark.parametrize("bearing", [TAPERED, ANGULAR])
@pytest.mark.parametrize("adjustment", [{"axial_play": 0.0}, {"axial_play": 2e-5}, {"preload": 700.0}])
def test_equal_rows_without_axial_force_share_equally(bearing, adjustment):
    """By symmetry, and face to face the row at the smaller z is pressed towards -z."""
    (first, second), _ = shared(rows(bearing, arrangement="X", **adjustment), (1500.0, 1500.0), 0.0)
    assert first == pytest.approx(-second, rel=1e-8)
    assert first < 0.0


@pytest.mark.parametrize("bearing", [TAPERED, ANGULAR])
@pytest.mark.parametrize("preload", [0.0, 800.0])
def test_the_preload_is_the_axial_load_without_other_loads(bearing, preload):
    forces, _ = shared(rows(bearing, preload=preload), (0.0, 0.0), 0.0)
    assert forces == pytest.approx((-preload, preload), rel=1e-6, abs=1e-6)


def test_a_large_axial_force_unloads_a_row():
    """The row that is not pressed keeps the axial load F_r tan a/cos(180 deg/Z) that a radial load on two
    rollers needs; balls in the bottoms of their grooves need none.
    """
    for bearing, least in (
        (TAPERED, 1000.0 * math.tan(ANGLE) / math.cos(math.pi / ROLLERS)),
        (ANGULAR, 0.0),
    ):
        pair = rows(bearing, arrangement="O", axial_play=1e-3)
        forces, unloaded = shared(pair, (1000.0, 1000.0), 5000.0)
        assert forces == pytest.approx((5000.0 + least, -least), rel=1e-5, abs=1e-2)
        assert unloaded == (False, True)


def test_rows_that_just_touch_follow_the_rule_of_catalogues():
    """With half of the rollers loaded, F_a = 1.26 F_r tan a; the rule of catalogues, 0.5 F_r/Y with
    Y = 0.4 cot a, is 1.25 F_r tan a. 1.26 is J_a/J_r of Sjovall's integrals at 0.5, here sums over rollers.
    """
    (_, force), _ = shared(rows(TAPERED, arrangement="X", axial_play=0.0), (1500.0, 1500.0), 0.0)
    psi = 2.0 * math.pi * np.arange(ROLLERS) / ROLLERS
    loads = np.maximum(0.0, np.cos(psi)) ** (10.0 / 9.0)
    assert force == pytest.approx(1500.0 * math.tan(ANGLE) * np.sum(loads) / (loads @ np.cos(psi)), rel=1e-6)
    assert force == pytest.approx(0.5 * 1500.0 / (0.4 / math.tan(ANGLE)), rel=0.03)


@pytest.mark.parametrize(("bearing", "angle"), [(TAPERED, ANGLE), (ANGULAR, None)])
@pytest.mark.parametrize("speed", [SLOW, 900.0])
def test_equal_rows_agree_with_a_pair_at_one_place(bearing, angle, speed):
    """Without an axial force both rows of a pair have half of its radial load, and one displacement."""
    table = {
        "contacts": "atlas",
        "bearing": {
            "radial_load": "3 kN",
            "inner_speed": speed,
            "temperature": "80 degC",
            "composite_rq": "0.06 um",
            "pair": {"arrangement": "O", "preload": "700 N"},
            **bearing,
        },
        "lubricant": {"base": "fva-3"},
    }
    (at,) = equilibria_of(resolve_bearing(BearingCase.from_dict(table)), 1)
    angles = at.inner_angle if angle is None else np.full_like(at.inner_load, angle)
    first = np.split(at.inner_load * np.sin(np.abs(angles)), 2)[0]
    (_, force), _ = shared(rows(bearing, preload=700.0), (1500.0, 1500.0), 0.0, speed)
    assert force == pytest.approx(np.sum(first), rel=1e-4)


def stiffness():
    """35 948 L^(8/9) N/mm^(10/9) of ISO 16281 in SI units, steel of 206 GPa in its standard modulus."""
    from ehlectric.formulas.hertz import body_compliance, reduced_modulus

    steel = reduced_modulus(body_compliance(206e9, 0.3), body_compliance(206e9, 0.3))
    return 35948.0e6 * LENGTH ** (8.0 / 9.0) * row(**TAPERED).modulus / steel


def axial_load(approach, radial):
    """Axial load of a row of rollers at an axial approach under a radial load, from Q = c d^(10/9)."""
    psi = 2.0 * math.pi * np.arange(ROLLERS) / ROLLERS
    sine, cosine = math.sin(ANGLE), math.cos(ANGLE)

    def loads(shift):
        depth = shift * np.cos(psi) * cosine + approach * sine
        return stiffness() * np.maximum(0.0, depth) ** (10.0 / 9.0)

    shift = scipy.optimize.brentq(lambda x: cosine * loads(x) @ np.cos(psi) - radial, 0.0, 1e-3, xtol=1e-16)
    return sine * np.sum(loads(shift))


@pytest.mark.reference
@pytest.mark.parametrize("axial", [-1500.0, 0.0, 600.0])
@pytest.mark.parametrize("total", [-2e-5, 0.0, 1.5e-5])
def test_the_place_of_the_shaft_solves_both_rows(axial, total):
    """The same unknown by a separate program: the place of the shaft instead of a force."""
    radial = (1200.0, 2500.0)

    def excess(place):
        first, second = axial_load(place, radial[0]), axial_load(total - place, radial[1])
        return first - second - axial

    place = scipy.optimize.brentq(excess, -6e-5, 6e-5, xtol=1e-15)
    play = {"axial_play": -total}
    if total > 0.0:
        # Each row approaches half of the sum at rest.
        sine = math.sin(ANGLE)
        play = {"preload": ROLLERS * stiffness() * (0.5 * total * sine) ** (10.0 / 9.0) * sine}
    forces, _ = shared(rows(TAPERED, arrangement="O", **play), radial, axial)
    expected = axial_load(place, radial[0]), -axial_load(total - place, radial[1])
    assert forces == pytest.approx(expected, rel=2e-6)


def test_many_shafts_have_the_shares_of_each():
    """Also with loads at which a row is unloaded."""
    pair = rows(TAPERED, arrangement="X", axial_play=1e-5)
    first, second = np.array([1500.0, 200.0, 0.0, 900.0]), np.array([800.0, 900.0, 50.0, 900.0])
    axial, speed = np.array([0.0, -700.0, 9e3, 1.0]), np.array([1.0, 100.0, 200.0, 300.0])
    many = pair.share((first, second), axial, speed)
    for place in range(4):
        forces, unloaded = shared(pair, (first[place], second[place]), axial[place], speed[place])
        assert tuple(many.forces[:, place]) == pytest.approx(forces, rel=1e-8, abs=1e-9)
        assert tuple(many.unloaded[:, place]) == unloaded


def test_pressure_centres():
    """(d_m/2) tan a outside of both rows or between them; the order of the rows in the file is free."""
    distance = 0.5 * PITCH * math.tan(ANGLE)
    for places in ((0.0, 0.11), (0.11, 0.0)):
        ascending = places[0] == 0.0
        sign = 1.0 if ascending else -1.0
        pairs = (rows(TAPERED, ascending=ascending, arrangement=way, preload=0.0) for way in "OX")
        outside, between = (pair.pressure_centres(places) for pair in pairs)
        assert outside == pytest.approx((places[0] - sign * distance, places[1] + sign * distance))
        assert between == pytest.approx((places[0] + sign * distance, places[1] - sign * distance))
    with pytest.raises(InputError, match="pressure centres"):
        rows(TAPERED, preload=0.0).pressure_centres((0.0, 0.01))


def axle(base="32207", **adjustment):
    """E-axle of the examples with two adjusted bearings on its intermediate shaft."""
    table = two_stages().to_dict()
    table["bearing"] = [
        {"shaft": "intermediate", "at": row["at"], "base": base, "composite_rq": 3e-8}
        if row["shaft"] == "intermediate"
        else row
        for row in table["bearing"]
    ]
    if adjustment:
        table["shaft"][1]["adjustment"] = adjustment
    return table


@pytest.mark.parametrize("base", ["32207", "7207 B"])
@pytest.mark.parametrize("torque", [30.0, -30.0])
def test_adjusted_bearings_of_an_axle_balance_the_forces_of_its_meshes(base, torque):
    """The shares add up to the axial force of the helical gears, 2535.397 N at 150 N m, with both signs."""
    table = axle(base, arrangement="X", axial_play="10 um")
    table["drive"]["torque"] = torque
    loads = loads_on_shafts(AxleCase.from_dict(table))["intermediate"]
    assert sum(loads.shares) == pytest.approx(-2535.397 * torque / 150.0, rel=2e-6)
    assert loads.shares[0] < 0.0 < loads.shares[1]


def test_an_axle_with_tapered_bearings_is_solved():
    """An assumed adjustment is a note; the elements carry the shares along z."""
    axles = [AxleCase.from_dict(axle(**words)) for words in ({}, {"arrangement": "X", "axial_play": 0.0})]
    assumed, given = (solve_elements(case) for case in axles)
    assert [element.axial_load for element in assumed.elements] == [
        element.axial_load for element in given.elements
    ]
    shares = loads_on_shafts(axles[0])["intermediate"].shares
    assert tuple(element.axial_load for element in given.elements[2:4]) == shares
    codes = [[warning.code for warning in solution.warnings] for solution in (assumed, given)]
    assert "adjustment-assumed" in codes[0]
    assert "adjustment-assumed" not in codes[1]


def _rows(change):
    """Change of the bearings of the intermediate shaft."""

    def changed(table):
        for number in (2, 3):
            table["bearing"][number] |= change(number - 2)

    return changed


@each(
    "change, key, words",
    [
        (
            _rows(lambda number: {"base": ("32207", "6207")[number]}),
            "bearing.4.base",
            "tapered roller and deep",
        ),
        (_rows(lambda number: {"base": ("32207", "7207 B")[number]}), "bearing.4.base", "one kind"),
        (_rows(lambda number: {"locating": number == 0}), "bearing.3.locating", "both carry"),
        (
            lambda table: table["shaft"][1].update(adjustment={"arrangement": "X"}),
            "shaft.2.adjustment.preload",
            "axial_play",
        ),
        (
            lambda table: table["shaft"][1].update(adjustment={"preload": 1.0, "axial_play": 1e-6}),
            "shaft.2.adjustment.preload",
            "together",
        ),
        (
            lambda table: table["shaft"][0].update(adjustment={"preload": 1.0}),
            "shaft.1.adjustment",
            "deep-groove",
        ),
        (
            lambda table: table["shaft"][1].update(adjustment={"arrangement": "T", "preload": 1.0}),
            "shaft.2.adjustment.arrangement",
            "'O'",
        ),
    ],
)
def test_rows_that_cannot_be_adjusted_are_refused(change, key, words):
    table = axle()
    change(table)
    with pytest.raises(InputError) as refused:
        AxleCase.from_dict(table)
    assert refused.value.key == key
    assert words in str(refused.value)
