"""Points without a result: bounds of the probability of breakdown in verdict, table, warning and summary."""

import numpy as np
import pytest

from ehlectric import BearingCase, solve_bearing
from ehlectric.app.compute.bearing_answers import deciding, whole_quick_answer
from ehlectric.bearing.uncertain_inputs import changes_of
from ehlectric.discharge.breakdown_rule import UNLIKELY, Chance
from ehlectric.quantities.verdict import Verdict
from ehlectric.report.report_facts import part_of
from ehlectric.tables.bearing_tables import total_rows
from tests.helpers.each import each

# Temperature above which the oil has no values [K].
HOTTEST = 391.15

CASE = {
    "contacts": "atlas",
    "bearing": {
        "base": "6208",
        "radial_clearance": "10 um",
        "radial_load": "1800 N",
        "axial_load": "300 N",
        "inner_speed": "9000 rpm",
        "temperature": "116 degC",
        "composite_rq": "0.01 um",
    },
    "lubricant": {
        "base": "paper",
        "temperature_range": [233.15, HOTTEST],
        "temperature": {
            "kinematic_viscosity_40": "10 mm^2/s",
            "kinematic_viscosity_100": "2.6 mm^2/s",
            "density_15": "850 kg/m^3",
            "thermal_conductivity": "0.137 W/m/K",
        },
    },
    "discharge": {"dielectric_strength": "15 V/um"},
    "motor": {
        "common_mode_voltage": "300 V",
        "winding_rotor_capacitance": "8.3 pF",
        "rotor_frame_capacitance": "1 nF",
    },
}


@pytest.fixture(scope="module")
def result():
    return solve_bearing(BearingCase.from_dict(CASE), workers=1)


def unknown_share(case):
    """Part of the range of the temperature beyond the range of the oil."""
    (temperature,) = (one for one in changes_of(case) if one.key == "bearing.temperature")
    first, last = temperature.ends
    return (last - HOTTEST) / (last - first)


@pytest.mark.slow
@pytest.mark.gate
def test_points_without_a_result_lie_between_bounds(result):
    """The hot 40 % of the points have no viscosity: any part of them may break down."""
    summary = result.summary()
    found = summary["uncertainty"]
    failed, samples = found["failed"], found["samples"]
    assert failed / samples == pytest.approx(unknown_share(result.case), abs=0.01)
    broken = np.count_nonzero(result.uncertainty.margins < 1.0)
    low, high = found["breakdown_probability_low"], found["breakdown_probability_high"]
    assert (low, high) == pytest.approx((broken / samples, (broken + failed) / samples))
    assert low < found["breakdown_probability"] < high
    # Random points with the logarithm of the margin continued over the temperature: 32.5 %, median 1.20.
    assert low < 0.325 < high
    assert found["margin_median"] < 1.20
    assert (found["margin_low"], found["margin_high"]) == (0.0, None)
    assert "probability-bounded" in summary["warning_codes"]
    (text,) = (one for one in summary["warnings"] if one.startswith(f"{failed} of {samples} points"))
    assert "lubricant.temperature_range" in text
    assert f"between {100.0 * low:.3g} and {100.0 * high:.3g} %" in text


@pytest.mark.slow
def test_verdict_table_and_page_state_the_bounds(result):
    verdict, summary = result.verdict, result.summary()
    low, high = result.uncertainty.bounds
    ends = f"between {100.0 * low:.2g} and {100.0 * high:.2g} %"
    assert f"The probability of breakdown is {ends}: " in verdict.text
    assert (verdict.level, verdict.lead) == ("yellow", "Breakdown possible")
    rows = {row.key: row for row in total_rows(summary)}
    row = rows["uncertainty.breakdown_probability"]
    assert row.text.startswith(f"{100.0 * low:.2g} to {100.0 * high:.2g} %")
    assert rows["uncertainty.margin_range"].value == "not known"
    facts = deciding(summary, probable=True)
    assert dict(facts.facts)["probability of breakdown"] == row.amount
    assert facts.gauge.interval is None
    assert facts.gauge.value == summary["bearing"]["margin"]
    answer = whole_quick_answer(CASE)
    assert answer.verdict.text == verdict.text
    assert "probability-bounded" in {warning.code for warning in answer.warnings}
    assert "probability-bounded" in {
        warning.code for warning in part_of(result, summary, kind="", command="", numbers=()).warnings
    }


@each(
    ("broken", "whole", "failed", "level", "lead"),
    [
        (0, 100, 0, "green", "No breakdown expected"),
        (0, 96, 4, "green", "No breakdown expected"),
        (0, 94, 6, "yellow", "Breakdown possible"),
        (20, 20, 60, "yellow", "Breakdown possible"),
        (60, 0, 40, "yellow", "Breakdown likely"),
        (96, 0, 4, "red", "Breakdown expected"),
        (94, 0, 6, "yellow", "Breakdown likely"),
        (100, 0, 0, "red", "Breakdown expected"),
    ],
)
def test_the_level_follows_the_bounds(broken, whole, failed, level, lead):
    chance = Chance.of(np.repeat([0.5, 2.0], [broken, whole]), failed)
    assert (chance.level, Verdict(chance.level, chance.code).lead) == (level, lead)
    low, high = chance.bounds
    assert (low, high) == pytest.approx((broken / 100.0, (broken + failed) / 100.0))


def test_a_quantile_is_a_bound():
    """Of 100 points, 10 are not known: a tenth of the margins may be any number."""
    margins = np.linspace(1.0, 2.0, 90)
    chance = Chance.of(margins, failed=10)
    assert (chance.low, chance.high) == (0.0, np.inf)
    assert chance.median == pytest.approx(np.sort([*np.zeros(10), *margins])[[49, 50]].mean())
    few = Chance.of(np.linspace(1.0, 2.0, 98), failed=2)
    assert few.low < Chance.of(np.linspace(1.0, 2.0, 98)).low
    assert few.high > Chance.of(np.linspace(1.0, 2.0, 98)).high
    assert few.failed / few.samples < UNLIKELY


@pytest.mark.slow
def test_points_with_films_above_a_ball_have_no_result():
    """An oil of a low viscosity index near -20 degC: films of light balls are thicker than the balls."""
    oil = {"kinematic_viscosity_40": "100 mm^2/s", "kinematic_viscosity_100": "5.8 mm^2/s"}
    bearing = {
        "radial_load": "750 N",
        "axial_load": "125 N",
        "inner_speed": "83 rpm",
        "temperature": "-11 degC",
    }
    lubricant = CASE["lubricant"] | {"temperature": CASE["lubricant"]["temperature"] | oil}
    case = BearingCase.from_dict(CASE | {"bearing": CASE["bearing"] | bearing, "lubricant": lubricant})
    found = solve_bearing(case, workers=1)
    low, high = found.uncertainty.bounds
    assert found.uncertainty.failed > 0
    assert high - low == pytest.approx(found.uncertainty.failed / found.uncertainty.samples)
    assert found.verdict.level == "yellow"
