"""Verdicts on bearings: what is expected, and that nothing reads as safe which is not."""

import dataclasses

import pytest

from ehlectric.bearing.margin import MarginAnalysis, SpeedRange
from ehlectric.bearing.result import BearingResult, solve_bearing
from ehlectric.bearing.ring_contacts import ContactCurve
from ehlectric.bearing.solution import lambda_ratio
from ehlectric.bearing.summary import summary_of
from ehlectric.bearing.verdict_rule import bearing_verdict
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.quantities.result_warnings import ResultWarning
from tests.helpers.bearings import BALLS, ROLLERS, bearing_case
from tests.helpers.places import EXAMPLES

NO_SPEEDS = SpeedRange(31.4159265, 1256.637, (144.5,), None, (), above=True, minimum=0.4)


def solved(**changes):
    return solve_bearing(bearing_case(BALLS, contacts="formula", **changes), workers=1)


@pytest.fixture(scope="module")
def balls():
    return solved()


def as_solved(result, *, error=0.0, converged=True, warnings=()):
    """The same bearing as though its contacts had been solved, with an error, a state and warnings."""

    def curve(one):
        changes = {"error": error, "converged": converged, "warnings": tuple(warnings)}
        return ContactCurve.of([dataclasses.replace(contact, **changes) for contact in one.solutions])

    solution = result.solution
    case = solution.case.model_copy(update={"contacts": "solved"})
    curves = {name: curve(getattr(solution, name)) for name in ("inner_curve", "outer_curve")}
    return BearingResult(dataclasses.replace(solution, case=case, **curves))


def judged(result, **analysis):
    margin = result.breaks()["margin"]
    return bearing_verdict(result.solution, MarginAnalysis(margin, NO_SPEEDS, **analysis))


@pytest.mark.slow
def test_a_bearing_that_holds_its_voltage():
    """All of the numbers are those of its summary."""
    result = solved(motor__common_mode_voltage=60.0)
    verdict, found = result.verdict, result.summary()
    assert verdict.level == found["margin"]["level"] == "green"
    assert found["verdict"] == verdict.text
    assert list(found).index("verdict") == list(found).index("warning_codes") + 1
    totals = found["bearing"]
    assert verdict.margin == totals["margin"]
    numbers = [f"{totals['shaft_voltage']:.3g} V", f"{totals['first_break']:.3g} V", "3000 rpm", "70 °C"]
    numbers += [f"margin {totals['margin']:.2f}", "15 V/µm"]
    assert [number for number in numbers if number not in verdict.text] == []
    assert verdict.text.startswith("No breakdown expected: ")
    assert "breakdown-expected" not in found["warning_codes"]


def test_a_margin_below_one_is_red_and_a_warning():
    """Solved contacts decide; those by formula may be 30 % off, and a margin of 0.8 with them is yellow."""
    slow = solved(bearing__inner_speed="970 rpm")
    assert 1.0 / 1.3 < slow.breaks()["margin"] < 1.0 / 1.2
    found = judged(slow)
    assert (found.level, found.text[:17]) == ("yellow", "Breakdown likely:")
    (warning,) = (one for one in slow.warnings if one.code == "breakdown-expected")
    assert warning.severity == "warning"
    assert f"margin {slow.breaks()['margin']:.2f}" in str(warning)
    red = judged(as_solved(slow))
    assert (red.level, red.text[:19]) == ("red", "Breakdown expected:")


def test_films_by_formula_decide_only_beyond_their_error(balls):
    margin = balls.breaks()["margin"]
    for voltage, level in ((1.31, "green"), (1.29, "yellow"), (1 / 1.29, "yellow"), (1 / 1.31, "red")):
        common = 300.0 * margin / voltage
        assert judged(solved(motor__common_mode_voltage=common)).level == level
    # With solved films the same margins are beyond doubt.
    near = as_solved(solved(motor__common_mode_voltage=300.0 * margin / 1.3))
    assert judged(near).level == "green"
    assert judged(as_solved(near, error=0.25)).level == "yellow"
    assert "25 %" in judged(as_solved(near, error=0.25)).text


def test_a_strength_that_is_not_stated_may_differ_by_20_percent(balls):
    """0.8*1.2 = 0.96 is below 1 and 1.2*0.9 = 1.08 above it; a range that is stated takes its place."""
    margin = balls.breaks()["margin"]
    for value, lead, end in ((1.2, "Breakdown possible", "0.96"), (0.9, "Breakdown likely", "1.08")):
        changes = {"motor__common_mode_voltage": 300.0 * margin / value}
        found = judged(as_solved(solved(**changes)))
        assert (found.level, found.text.partition(":")[0]) == ("yellow", lead)
        assert f" {end}." in found.text
        ranges = {"discharge.dielectric_strength": ["14.9 V/um", "15.1 V/um"]}
        known = judged(as_solved(solved(ranges=ranges, **changes)), low=value, high=value)
        assert known.level == ("green" if value > 1.0 else "red")


def test_the_sentence_of_the_critical_speed_is_about_the_margin_at_every_level(balls):
    """144.5 rad/s are 1380 rpm. Only the first words of a verdict say how likely a breakdown is."""
    for found in (judged(balls), judged(balls, low=0.9, high=2.0)):
        assert " Below about 1380 rpm the margin is below 1. " in found.text
        assert "breakdown is" not in found.text
    alone = SpeedRange(300.0, 300.0, (), None, (), above=True, minimum=1.5)
    margin = balls.breaks()["margin"]
    assert "at all speeds" not in bearing_verdict(balls.solution, MarginAnalysis(margin, alone)).text


@pytest.mark.slow
def test_rollers_by_formula_may_be_40_percent_off():
    """A margin of 1.35 is beyond the error of balls, and within that of rollers."""
    rollers = solve_bearing(bearing_case(ROLLERS, contacts="formula"), workers=1)
    common = rollers.case.motor.common_mode_voltage * rollers.breaks()["margin"] / 1.35
    near = solve_bearing(rollers.case.replace({"motor.common_mode_voltage": common}), workers=1)
    assert near.verdict.level == "yellow"
    assert "40 %" in near.verdict.text
    assert any("40 %" in str(one) for one in near.warnings)


@pytest.mark.parametrize(
    ("value", "low", "high", "told"),
    [
        # 30 % of the film takes 1.2 across 1, and neither 25 nor the end of its range below 1.
        (1.2, None, None, True),
        (25.0, None, None, False),
        (25.0, 0.5, 40.0, False),
        # The range alone is above 1, and not within 30 %.
        (2.0, 1.2, 3.0, True),
    ],
)
def test_the_accuracy_of_films_is_told_only_where_it_decides(balls, value, low, high, told):
    voltage = 300.0 * balls.breaks()["margin"] / value
    rough = solved(motor__common_mode_voltage=voltage, bearing__composite_rq="0.1 um")
    found = judged(rough, low=low, high=high)
    assert found.level == "yellow", "the surfaces may touch"
    assert ("confirm with solved contacts" in found.text) is told


def test_a_stated_range_across_one_is_yellow(balls):
    result = as_solved(balls)
    assert judged(result, low=1.1, high=2.0).level == "green"
    verdict = judged(result, low=0.9, high=2.0)
    assert (verdict.level, verdict.text[:19]) == ("yellow", "Breakdown possible:")
    assert "0.90 to 2.00" in verdict.text


@pytest.mark.parametrize(
    ("error", "converged", "code"),
    [
        (0.0, False, "not-converged"),
        (0.3, True, "grid-far-too-coarse"),
        (None, True, "coarser-grid-unsolved"),
    ],
)
def test_numbers_that_must_not_be_used_have_no_verdict(balls, error, converged, code):
    warned = as_solved(balls, error=error, converged=converged, warnings=(ResultWarning(code, "no use"),))
    silent = [as_solved(balls, converged=False)] if not converged else []
    for result in (warned, *silent):
        verdict = judged(result)
        assert verdict.level == "grey"
        assert verdict.margin is None


def test_a_doubt_leaves_no_green_verdict(balls):
    text = "the largest field is at an edge"
    verdict = judged(as_solved(balls, warnings=(ResultWarning("field-range-too-narrow", text),)))
    assert verdict.level == "yellow"
    partial = judged(as_solved(solved(bearing__composite_rq="0.1 um")))
    assert partial.level == "yellow"
    assert "lambda ratio " in partial.text


def test_surfaces_that_touch_do_not_read_as_safe():
    verdict = solved(bearing__inner_speed="30 rpm").verdict
    assert verdict.level == "red"
    assert verdict.text.startswith("Discharges expected: ")
    assert verdict.text.endswith(
        "The probability of breakdown, which includes frequent asperity contact, is above 99.25 %."
    )
    assert [part for part in ("30 rpm", "70 °C", "lambda ratio 0.") if part not in verdict.text] == []
    assert verdict.margin is None
    unknown = solved(bearing__inner_speed="30 rpm", motor=None).verdict
    assert (unknown.level, unknown.lead) == ("yellow", "Discharges likely")
    assert unknown.text.partition(": ")[2] in verdict.text


@pytest.mark.slow
@pytest.mark.gate
def test_a_thinner_film_has_no_milder_verdict():
    """The level does not fall from speed to speed, across a margin of 1 and a lambda ratio of 1."""
    case = BearingCase.from_toml(EXAMPLES / "bearing_6208.toml").replace({"contacts": "formula"})
    levels, ratios = [], []
    for n in (6000, 3000, 1800, 1400, 400, 200, 150, 100, 60):
        result = solve_bearing(case.replace({"bearing.inner_speed": f"{n} rpm"}), workers=1)
        # The verdict depends on the analysis where there is a margin; without ranges its speeds are enough.
        levels.append(bearing_verdict(result.solution, MarginAnalysis(result.breaks()["margin"])).level)
        ratios.append(lambda_ratio(result.solution))
    ranks = [("green", "yellow", "red").index(level) for level in levels]
    assert ranks == sorted(ranks)
    assert set(ranks) == {0, 1, 2}
    assert min(ratios) < 0.5
    assert sum(ratio < 1.0 for ratio in ratios) == 3


@pytest.mark.slow
@pytest.mark.gate
def test_ceramic_elements_insulate_also_where_surfaces_touch():
    slow = solved(bearing__element_material="silicon-nitride", bearing__inner_speed="30 rpm").verdict
    assert slow.level == "green"
    assert "lambda ratio 0." in slow.text


def test_ceramic_elements_without_a_motor_have_no_voltage_to_insulate():
    verdict = solved(bearing__element_material="silicon-nitride", motor=None).verdict
    assert verdict.level == "grey"
    assert "[motor]" in verdict.text
    assert "insulates at least" in verdict.text


def test_without_a_strength_one_line_says_so():
    result = solved(discharge=None)
    assert result.verdict.level == "grey"
    assert f"{result.shaft_voltage:.3g} V at 3000 rpm" in result.verdict.text
    assert " V at 3000 rpm" not in solved(discharge=None, motor=None).verdict.text


def test_without_a_motor_the_voltage_is_said_that_it_withstands(balls):
    verdict = solved(motor=None).verdict
    assert verdict.level == "grey"
    assert f"{balls.breaks()['first_break']:.3g} V at 3000 rpm" in verdict.text
    assert "[motor]" in verdict.text


def test_a_film_factor_is_said(balls):
    grease = judged(solved(bearing__film_factor=0.7))
    assert "film factor 0.7" in grease.text
    assert "15 V/µm" in grease.text
    oil = "lubricant__temperature__thermal_conductivity"
    sheared = judged(solved(bearing__film_factor="inlet-shear", **{oil: "0.14 W/m/K"}))
    assert "inlet shear heating" in sheared.text
    assert sheared.margin < balls.breaks()["margin"]


@pytest.mark.slow
def test_across_a_lambda_ratio_of_one_nothing_turns_safe():
    """A little rougher, and the first breakdown is gone: the verdict says what happens, and how likely it is.

    It is red where the probability of breakdown is above 95 %, as without touching surfaces.
    """
    above, below, rough = (solved(bearing__composite_rq=rq) for rq in ("0.18 um", "0.2 um", "0.5 um"))
    ratios = [lambda_ratio(one.solution) for one in (above, below, rough)]
    assert ratios[0] > 1.0 > ratios[1] > ratios[2]
    assert above.breaks()["first_break"] == pytest.approx(solved().breaks()["first_break"], rel=1e-12)
    assert below.breaks()["first_break"] is None
    assert [one.verdict.level for one in (above, below, rough)] == ["yellow", "yellow", "red"]
    assert [one.verdict.text[:19] for one in (below, rough)] == ["Discharges likely: ", "Discharges expected"]
    for code, result in (("partial-film", above), ("touching", below)):
        assert [one.code for one in result.warnings].count(code) == 1
    heavy, light = (
        [row for row in below.contacts() if (row["load"] > 4.0) == pressed] for pressed in (True, False)
    )
    assert {row["lubrication_state"] for row in heavy} == {"boundary lubrication", "mixed lubrication"}
    # Balls outside the load zone have only their centrifugal force of 3.3 N and thick films.
    assert {(row["ring"], row["lubrication_state"]) for row in light} == {
        ("inner", "gap"),
        ("outer", "full film"),
    }


@pytest.mark.slow
def test_a_field_beyond_any_liquid_is_a_warning():
    """100 kV of common mode: more than 3300 V/um in the film, above its strength and above 1000 V/um."""
    result = solved(motor__common_mode_voltage="100 kV")
    field = summary_of(result.solution)["bearing"]["max_strength"]
    assert field > 3.3e9
    texts = {one.code: one.text for one in result.warnings}
    for code in ("breakdown-expected", "field-above-insulators"):
        assert f"{float(f'{field / 1e6:.3g}'):.0f} V/µm" in texts[code]
    assert "strength-above-liquids" not in texts
    strong = solved(discharge__dielectric_strength="3300 V/um")
    assert "strength-above-liquids" in {one.code for one in strong.warnings}
    assert strong.verdict.level == "yellow"


@pytest.mark.slow
@pytest.mark.parametrize("changes", [{}, {"bearing__element_material": "silicon-nitride"}])
def test_an_equal_second_bearing_is_an_assumption(changes):
    """The voltage of a shaft depends on both of its bearings, and the file describes one of them."""
    given = {"motor__second_bearing_capacitance": "200 pF"}
    assumed, known, alone = (
        solved(**changes, **others).verdict.text for others in ({}, given, {"motor": None})
    )
    assert "second bearing of the shaft is taken as equal" in assumed
    assert "ehlectric drive" in assumed
    assert "second bearing" not in known
    assert "second bearing" not in alone
