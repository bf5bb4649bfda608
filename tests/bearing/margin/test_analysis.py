"""Critical speed, effects and range of the margin of bearings, from limits and by solving again."""

import dataclasses
import math
import re

import pytest

from ehlectric import load
from ehlectric.bearing.margin import (
    Effect,
    MarginAnalysis,
    QuickMargins,
    SpeedRange,
    speed_range,
)
from ehlectric.bearing.result import solve_bearing
from ehlectric.bearing.run import save
from ehlectric.bearing.uncertain_inputs import OF_TABLE
from ehlectric.bearing.verdict_rule import bearing_verdict
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.errors import InputError
from ehlectric.quantities.formats import rpm_text
from ehlectric.readable import ratio_text
from tests.helpers.bearings import BALLS, ROLLERS, bearing_case, numbers_of
from tests.helpers.each import each
from tests.helpers.places import EXAMPLES

FORMULA = {"contacts": "formula"}
ANGULAR = {
    "bearing__kind": "angular-contact ball",
    "bearing__radial_clearance": None,
    "bearing__contact_angle": "25 deg",
    "bearing__axial_load": "2 kN",
}
STRENGTH, TEMPERATURE = "discharge.dielectric_strength", "bearing.temperature"


def solved(tables=BALLS, **changes):
    return solve_bearing(bearing_case(tables, **(FORMULA | changes)), workers=1)


@pytest.fixture(scope="module")
def balls():
    return solved()


@pytest.fixture(scope="module")
def rollers():
    return solved(ROLLERS)


def margin_at(result, **changes):
    """Margin of the same bearing solved again, by formula."""
    found = solve_bearing(result.case.replace(changes), workers=1).breaks()["margin"]
    assert found is not None
    return found


def effect(result, key):
    (found,) = (one for one in result.margin_analysis.effects if one.key == key)
    return found


@pytest.mark.slow
@pytest.mark.parametrize("name", ["balls", "rollers"])
def test_the_margin_at_the_critical_speed_is_one(request, name):
    """Solved again at that speed at eight positions of the cage, where the analysis has two."""
    result = request.getfixturevalue(name)
    critical = result.margin_analysis.critical_speed
    assert margin_at(result, **{"bearing.inner_speed": critical}) == pytest.approx(1.0, abs=1e-2)
    assert margin_at(result, **{"bearing.inner_speed": 0.95 * critical}) < 1.0
    assert margin_at(result, **{"bearing.inner_speed": 1.05 * critical}) > 1.0


@pytest.mark.slow
def test_the_critical_speed_does_not_depend_on_the_speed_of_the_file(balls):
    """From below, where the margin is less than 1, it is the same speed."""
    slower = solved(bearing__inner_speed="1000 rpm")
    assert slower.breaks()["margin"] < 1.0 < balls.breaks()["margin"]
    own, other = (result.margin_analysis.critical_speed for result in (balls, slower))
    assert other == pytest.approx(own, rel=5e-3)


@pytest.mark.slow
def test_films_are_scaled_to_those_of_the_solution(balls):
    """Solved films that are 20 % thinner have a critical speed that is higher by about 0.8^(-1/0.67)."""
    states = [
        dataclasses.replace(
            position,
            **{
                name: dataclasses.replace(
                    ring,
                    values=dataclasses.replace(
                        ring.values, breakdown_voltage=0.8 * ring.values.breakdown_voltage
                    ),
                )
                for name, ring in (("inner", position.inner), ("outer", position.outer))
            },
        )
        for position in balls.solution.positions
    ]
    thin = type(balls)(dataclasses.replace(balls.solution, positions=tuple(states)))
    assert thin.breaks()["margin"] == pytest.approx(0.8 * balls.breaks()["margin"], rel=1e-12)
    ratio = thin.margin_analysis.critical_speed / balls.margin_analysis.critical_speed
    # The shaft voltage rises a little with speed, too: the margin has a smaller exponent than the film.
    assert 0.8 ** (-1.0 / 0.67) < ratio < 0.8 ** (-1.0 / 0.5)


@pytest.mark.slow
def test_without_a_crossing_there_is_no_critical_speed():
    """Far above and far below: 300 V/um is beyond any oil, and 1 V/um is less than a gas withstands."""
    safe, broken = (solved(discharge__dielectric_strength=f"{e} V/um") for e in (300, 1))
    for result, above in ((safe, True), (broken, False)):
        speeds = result.margin_analysis.speeds
        assert speeds.critical is None
        assert speeds.above is above
    own = safe.case.bearing.inner_speed
    assert safe.margin_analysis.speeds.lowest == pytest.approx(0.1 * own)
    assert safe.margin_analysis.speeds.highest == pytest.approx(4.0 * own)
    least = ratio_text(safe.margin_analysis.speeds.minimum)
    assert least in safe.verdict.text
    assert "300 to 12\xa0000 rpm" in safe.verdict.text
    slowest = margin_at(safe, **{"bearing.inner_speed": 0.1 * own})
    assert float(least) == pytest.approx(slowest, rel=5e-3)
    assert "300 to 12\xa0000 rpm" in broken.verdict.text


@pytest.mark.slow
def test_speeds_with_a_partial_film_are_said():
    """The verdict names the speed of a lambda ratio of 3, below which surfaces may touch."""
    safe = solved(discharge__dielectric_strength="300 V/um")
    ((_, speed),) = safe.margin_analysis.speeds.partial
    at = {"bearing.inner_speed": speed}
    found = numbers_of(solve_bearing(safe.case.replace(at), workers=1))["bearing"]["lambda_ratio"]
    assert found == pytest.approx(3.0, abs=0.02)
    assert f"Below about {rpm_text(speed)} rpm" in safe.verdict.text


def said_of_speeds(rpm):
    """Verdict on the example with smooth films at a speed [rpm], and the speeds of its analysis."""
    case = BearingCase.from_toml(EXAMPLES / "bearing_6208.toml")
    changes = {"contacts": "formula", "bearing.inner_speed": f"{rpm} rpm", "bearing.summit_height": 0.0}
    result = solve_bearing(case.replace(changes), workers=1)
    speeds = speed_range(QuickMargins.of(result.solution))
    analysis = MarginAnalysis(result.breaks()["margin"], speeds)
    return result, speeds, bearing_verdict(result.solution, analysis).text


@pytest.mark.slow
def test_the_speed_below_which_surfaces_may_touch_is_that_of_a_lambda_ratio_of_three():
    """From a lambda ratio of 1.2, of 1.6 and of 3.8; at 200 rpm it is beyond the range of 20 to 800 rpm."""
    for n in (270, 400, 1400):
        result, _, text = said_of_speeds(n)
        found = re.search(r"Below about (\d+) rpm lubrication is mixed", text)
        at = {"bearing.inner_speed": f"{found[1]} rpm"}
        ratio = numbers_of(solve_bearing(result.case.replace(at), workers=1))["bearing"]["lambda_ratio"]
        # The film grows with the speed to the power of about 0.67: 2 % of the speed are 1.3 % of it.
        assert ratio == pytest.approx(3.0, rel=0.013)
    _, speeds, text = said_of_speeds(200)
    assert speeds.partial == ((None, None),)
    assert text.count(f"{rpm_text(speeds.touching)} to 800 rpm") == 2


@pytest.fixture(scope="module")
def sheared():
    changes = {
        "contacts": "formula",
        "bearing.film_factor": "inlet-shear",
        "bearing.temperature": "20 degC",
        "discharge.dielectric_strength": "2.4 V/um",
        "lubricant.temperature.thermal_conductivity": "0.14 W/m/K",
    }
    case = BearingCase.from_toml(EXAMPLES / "bearing_6208.toml").replace(changes)
    speeds = (9000, 36000)
    return {n: solve_bearing(case.replace({"bearing.inner_speed": f"{n} rpm"}), workers=1) for n in speeds}


@pytest.mark.slow
def test_a_margin_that_falls_at_high_speed_has_two_critical_speeds(sheared):
    """Inlet shear heating: the margin is below 1 on both sides of a band, from whichever speed one looks."""
    for result in sheared.values():
        speeds = result.margin_analysis.speeds
        for at in (speeds.critical, speeds.upper):
            assert margin_at(result, **{"bearing.inner_speed": at}) == pytest.approx(1.0, abs=1e-2)
        assert speeds.critical < speeds.upper
        for end in (speeds.critical, speeds.upper):
            assert f" {rpm_text(end)} rpm" in result.verdict.text
        assert "rpm the margin is below 1." in result.verdict.text
        assert result.margin_analysis.summary()["upper_critical_speed"] == speeds.upper
    inside = (speeds.critical * speeds.upper) ** 0.5
    assert margin_at(sheared[9000], **{"bearing.inner_speed": inside}) > 1.0
    own = sheared[9000].margin_analysis
    assert own.critical_speed == pytest.approx(speeds.critical, rel=0.01)


@each(
    "crossings, above, broken, critical, upper",
    [
        ((), True, (), None, None),
        ((), False, ((None, None),), None, None),
        ((2.0,), True, ((None, 2.0),), 2.0, None),
        ((2.0,), False, ((2.0, None),), None, 2.0),
        ((2.0, 5.0), True, ((2.0, 5.0),), 5.0, None),
        ((2.0, 5.0), False, ((None, 2.0), (5.0, None)), 2.0, 5.0),
    ],
)
def test_intervals_with_a_margin_below_one(crossings, above, broken, critical, upper):
    speeds = SpeedRange(1.0, 10.0, crossings, None, (), above, 0.5)
    assert (speeds.broken, speeds.critical, speeds.upper) == (broken, critical, upper)


@pytest.mark.slow
def test_a_whole_number_has_a_range():
    """Nine balls, or eight to ten: all effects and speeds are still computed."""
    result = solved(ranges={"bearing.elements": [8, 10]})
    analysis = result.margin_analysis
    assert analysis.left_out == ()
    found = effect(result, "bearing.elements")
    assert (found.low_input, found.high_input) == (8, 10)
    fewer = margin_at(solved(), **{"bearing.elements": 8})
    assert found.low_margin == pytest.approx(fewer, rel=1e-2)
    assert analysis.critical_speed is not None


@pytest.mark.slow
def test_the_limits_of_a_class_and_of_a_grade_are_those_of_their_standards():
    """ISO 5753-1, bore above 24 to 30 mm: C3 is 13 to 28 um. ISO 3448: VG 46 is 41.4 to 50.6 mm^2/s."""
    oil = {"iso_vg": 46, "viscosity_index": 100, "density_15": "870 kg/m^3"}
    result = solved(
        bearing__radial_clearance=None, bearing__clearance_class="C3", bearing__bore="25 mm",
        lubricant={"base": "paper", "temperature": oil},
    )  # fmt: skip
    clearance = effect(result, "bearing.radial_clearance")
    assert (clearance.low_input, clearance.high_input) == (pytest.approx(13e-6), pytest.approx(28e-6))
    grade = effect(result, "lubricant.temperature.kinematic_viscosity_40")
    assert (grade.low_input, grade.high_input) == (pytest.approx(41.4e-6), pytest.approx(50.6e-6))
    thick = {"lubricant.temperature.kinematic_viscosity_40": 50.6e-6}
    assert margin_at(result, **thick) == pytest.approx(grade.high_margin, rel=2e-3)


@pytest.mark.slow
def test_surfaces_that_touch_at_low_speed_are_said():
    """At the touching speed lambda is 1; just above it the margin is that of a film of one roughness."""
    rough = solved(bearing__composite_rq="0.1 um", discharge__dielectric_strength="100 V/um")
    speeds = rough.margin_analysis.speeds
    assert speeds.critical is None
    at = {"bearing.inner_speed": speeds.touching}
    found = numbers_of(solve_bearing(rough.case.replace(at), workers=1))["bearing"]["lambda_ratio"]
    assert found == pytest.approx(1.0, abs=5e-3)
    assert f"{0.1 * 3000:.0f} to" not in rough.verdict.text


def test_the_margin_is_proportional_to_the_strength(balls):
    found = effect(balls, STRENGTH)
    margin = balls.breaks()["margin"]
    assert (found.low_input, found.high_input) == (pytest.approx(12e6), pytest.approx(18e6))
    assert (found.low_margin, found.high_margin) == (pytest.approx(0.8 * margin), pytest.approx(1.2 * margin))
    assert margin_at(balls, **{STRENGTH: 30e6}) == pytest.approx(2.0 * margin, rel=1e-9)


def test_effects_are_those_of_bearings_solved_again(balls):
    """Two positions of the cage in place of eight hardly matter, because only ratios of margins are used."""
    found = effect(balls, TEMPERATURE)
    for end, margin in ((found.low_input, found.low_margin), (found.high_input, found.high_margin)):
        assert margin_at(balls, **{TEMPERATURE: end}) == pytest.approx(margin, rel=2e-3)
    assert found.low_input == pytest.approx(333.15)
    # A warmer oil is thinner, and so is its film.
    assert found.high_margin < balls.breaks()["margin"] < found.low_margin


@pytest.mark.slow
def test_the_load_acts_on_the_film_and_on_the_shaft_voltage(balls):
    """A load makes the film thinner, and the capacitance larger, which takes voltage from the shaft.

    Coupled to the winding by far more than its bearings hold, the shaft has all of the voltage, and only the
    film counts.
    """
    found = effect(balls, "bearing.radial_load")
    assert found.low_input == pytest.approx(1440.0)
    both = {"bearing.radial_load": 1440.0, "bearing.axial_load": 240.0}
    assert margin_at(balls, **both) == pytest.approx(found.low_margin, rel=2e-3)
    stiff = solved(motor__winding_rotor_capacitance="1 mF")
    alone = effect(stiff, "bearing.radial_load")
    assert alone.low_margin > stiff.breaks()["margin"] > alone.high_margin


def test_effects_are_sorted_by_size(balls):
    sizes = [abs(math.log(one.high_margin / one.low_margin)) for one in balls.margin_analysis.effects]
    assert len(sizes) == 6
    assert sizes == sorted(sizes, reverse=True)
    touching = Effect("bearing.temperature", "temperature", 330.0, 350.0, 1.2, 0.0)
    assert touching.size == math.inf


@pytest.mark.slow
def test_inputs_of_each_kind_of_bearing(rollers):
    """Rollers and balls have a clearance, angular-contact bearings a contact angle in its place."""
    keys = {one.key for one in rollers.margin_analysis.effects}
    motor = {f"motor.{name}_capacitance" for name in ("winding_rotor", "rotor_frame")}
    assert keys == motor | {STRENGTH, TEMPERATURE, "bearing.radial_clearance", "bearing.radial_load"}
    found = effect(solved(**ANGULAR), "bearing.contact_angle")
    assert (math.degrees(found.low_input), math.degrees(found.high_input)) == pytest.approx((20.0, 30.0))


@pytest.mark.slow
def test_a_small_clearance_stays_positive():
    found = effect(solved(bearing__radial_clearance="4 um"), "bearing.radial_clearance")
    assert (found.low_input, found.high_input) == (pytest.approx(2e-6), pytest.approx(6e-6))


@pytest.mark.slow
def test_a_temperature_without_effect_is_said():
    oil = {"base": "paper", "viscosity": "12 mPa s"}
    analysis = solved(lubricant=oil).margin_analysis
    assert TEMPERATURE not in {one.key for one in analysis.effects}
    assert any("temperature" in text and "viscosity" in text for text in analysis.left_out)
    assert analysis.critical_speed is not None


@pytest.mark.slow
def test_a_strength_over_temperature_counts_and_its_ends_are_said():
    """At 10 K more the table ends: this effect has no result, and that is said."""
    table = {"temperature": ["20 degC", "75 degC"], "strength": ["20 V/um", "14.5 V/um"]}
    result = solved(discharge={"strength_table": table})
    analysis = result.margin_analysis
    assert any("bearing.temperature: " in text and "353.15 K" in text for text in analysis.left_out)
    assert effect(result, OF_TABLE).high_margin == pytest.approx(1.2 * result.breaks()["margin"])


@pytest.mark.slow
def test_the_range_of_the_margin_takes_all_unfavourable_ends(balls):
    ranges = {STRENGTH: ["10 V/um", "20 V/um"], TEMPERATURE: ["60 degC", "80 degC"]}
    analysis = solved(ranges=ranges).margin_analysis
    worst = margin_at(balls, **{STRENGTH: 10e6, TEMPERATURE: 353.15})
    best = margin_at(balls, **{STRENGTH: 20e6, TEMPERATURE: 333.15})
    assert (analysis.low, analysis.high) == (pytest.approx(worst, rel=2e-3), pytest.approx(best, rel=2e-3))
    (strength,) = (one for one in analysis.effects if one.key == STRENGTH)
    assert (strength.low_input, strength.high_input) == (10e6, 20e6)
    assert (balls.margin_analysis.low, balls.margin_analysis.high) == (None, None)


@pytest.mark.slow
def test_a_narrow_range_leaves_the_margin():
    result = solved(ranges={"motor.common_mode_voltage": [299.9999, 300.0001], STRENGTH: [15e6, 15.000001e6]})
    analysis, margin = result.margin_analysis, result.breaks()["margin"]
    assert (analysis.low, analysis.high) == (pytest.approx(margin, rel=1e-6), pytest.approx(margin, rel=1e-6))
    assert analysis.low <= margin <= analysis.high


@pytest.mark.slow
def test_a_range_that_formulas_cannot_follow_is_said(balls):
    """The shape of a Weibull law has no part in a formula; a rough end of a range leaves no film at all."""
    margins = QuickMargins.of(balls.solution)
    with pytest.raises(InputError, match=r"^discharge\.weibull\.shape: "):
        margins.at({"discharge.weibull.shape": 5.0})
    result = solved(
        discharge__dielectric_strength="100 V/um", ranges={"bearing.composite_rq": ["0.02 um", "50 um"]}
    )
    assert result.margin_analysis.low == 0.0
    # Nearly all of the range leaves no film.
    assert result.verdict.level == "red"


def test_without_a_margin_there_is_no_analysis():
    for changes in (
        {"motor": None},
        {"discharge__dielectric_strength": None},
        {"bearing__element_material": "silicon-nitride"},
        {"bearing__inner_speed": "30 rpm"},
    ):
        analysis = solved(**changes).margin_analysis
        assert analysis.critical_speed is None
        assert analysis.effects == ()


@pytest.mark.slow
def test_a_stored_bearing_has_the_same_analysis_and_verdict(balls, tmp_path):
    save(balls, tmp_path)
    stored = load(tmp_path / "bearing.nc")
    assert stored.margin_analysis == balls.margin_analysis
    assert stored.verdict == balls.verdict
    assert stored.summary() == balls.summary()


def test_the_motor_divides_the_voltage(balls):
    """The shaft voltage is that of the divider, C_wr/(C_wr + C_rf + 2 C_b); the breakdown voltage stays."""
    motor, own = balls.case.motor, balls.capacitance()
    effect = next(one for one in balls.margin_analysis.effects if "winding" in one.key)
    assert (effect.low_input, effect.high_input) == (10e-12, 30e-12)

    def shaft(winding):
        return winding / (winding + motor.rotor_frame_capacitance + 2.0 * own)

    for winding, margin in ((10e-12, effect.low_margin), (30e-12, effect.high_margin)):
        expected = balls.margin_analysis.margin * shaft(20e-12) / shaft(winding)
        assert margin == pytest.approx(expected, rel=2e-3, abs=0.0)


def test_inputs_beside_the_films_solve_no_bearing_again(balls, monkeypatch):
    """A motor divides another voltage, and roughness another film: the margins are those of new solutions."""
    margins = QuickMargins.of(balls.solution)
    changes = {"motor.rotor_frame_capacitance": 5e-10}, {"bearing.composite_rq": 6e-8}
    again = [margin_at(balls, **one) for one in changes]
    with monkeypatch.context() as patched:
        patched.delattr("ehlectric.bearing.margin.quick_solution")
        found = [margins.at(one) for one in changes]
    assert [one.margin for one in found] == pytest.approx(again, rel=1e-3)
    assert found[1].lambda_ratio == pytest.approx(0.5 * margins.solved.lambda_ratio, rel=1e-12)
