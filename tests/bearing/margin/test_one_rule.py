"""Level, first words, regime and probability of random bearings of every kind never contradict each other."""

import math
import random
import re

import pytest

from ehlectric import BearingCase, solve_bearing
from ehlectric.bearing.margin import MarginAnalysis, QuickMargins
from ehlectric.bearing.summary import summary_of
from ehlectric.bearing.uncertainty import has_chance, uncertainty_of
from ehlectric.bearing.verdict_rule import bearing_verdict
from ehlectric.errors import InputError
from ehlectric.quantities.lubrication_states import is_shorted
from ehlectric.readable import chance_text
from ehlectric.runtime.files import plain
from ehlectric.tables.bearing_tables import total_rows
from tests.helpers.places import EXAMPLES

# Designation, radial and axial load [N] of a bearing of each kind.
KINDS = {
    "deep-groove ball": ("6208", 1800.0, 300.0),
    "angular-contact ball": ("7210 BEP", 2000.0, 1500.0),
    "four-point contact ball": ("QJ 208", 500.0, 2000.0),
    "cylindrical roller": ("NU 208", 4000.0, 0.0),
    "tapered roller": ("32208", 4000.0, 2000.0),
    "needle roller": ("HK 2020", 2000.0, 0.0),
    "thrust ball": ("51208", 0.0, 3000.0),
    "thrust needle roller": ("AXK 2542", 0.0, 3000.0),
}

# First words and colours by the probability of breakdown, from its smallest to its largest value.
RULE = {
    "No breakdown expected": ("green", 0.0, 0.05),
    "Breakdown not known": ("yellow", 0.0, 0.05),
    "Breakdown possible": ("yellow", 0.05, 0.5),
    "Breakdown likely": ("yellow", 0.5, 0.95),
    "Breakdown expected": ("red", 0.95, 1.0),
}
TOUCHING = {
    "Discharges possible": ("yellow", 0.0, 0.5),
    "Discharges likely": ("red", 0.5, 0.95),
    "Discharges expected": ("red", 0.95, 1.0),
}


def drawn(kind, draw):
    """Bearing of a kind with random speed, temperature, loads, roughness and voltage."""
    base, radial, axial = KINDS[kind]
    factor = draw.uniform(0.3, 2.0)
    bearing = {
        "base": base,
        "radial_load": factor * radial,
        "inner_speed": f"{10.0 ** draw.uniform(1.5, 3.9)} rpm",
        "temperature": f"{draw.uniform(-15.0, 105.0)} degC",
        "composite_rq": f"{10.0 ** draw.uniform(-2.0, -0.4)} um",
        "summit_height": draw.choice([0.0, 2.0, 2.0, 3.0]),
    }
    if axial:
        bearing["axial_load"] = factor * axial
    if kind == "cylindrical roller":
        bearing["profile"] = "logarithmic"
    if draw.random() < 0.2:
        bearing["coating"] = "alumina"
    if draw.random() < 0.1:
        bearing["element_material"] = "silicon-nitride"
    if not kind.startswith("thrust") and kind not in ("tapered roller", "angular-contact ball"):
        bearing["radial_clearance"] = f"{draw.uniform(5.0, 30.0)} um"
    return {
        "contacts": draw.choice(["atlas", "atlas", "formula"]),
        "bearing": bearing,
        "lubricant": {
            "base": "paper",
            "temperature": {
                "kinematic_viscosity_40": f"{draw.choice([32.0, 46.0, 100.0])} mm^2/s",
                "kinematic_viscosity_100": f"{draw.uniform(5.5, 6.5)} mm^2/s",
                "density_15": "870 kg/m^3",
                "thermal_conductivity": "0.137 W/m/K",
            },
        },
        "discharge": {"dielectric_strength": "15 V/um"},
        "motor": {
            "common_mode_voltage": f"{10.0 ** draw.uniform(0.5, 3.0)} V",
            "winding_rotor_capacitance": "20 pF",
            "rotor_frame_capacitance": "1 nF",
        },
    }


def check(table, samples=64):
    """Compare verdict, table and probability of one bearing; False if the case has no solution."""
    try:
        solution = solve_bearing(BearingCase.from_dict(table), workers=1).solution
    except InputError:
        return False
    chance, summary = None, summary_of(solution)
    if has_chance(solution):
        found = uncertainty_of(solution, QuickMargins.of(solution), samples=samples)
        chance, summary["uncertainty"] = found.chance, plain(found.summary())
    verdict = bearing_verdict(solution, MarginAnalysis(), chance)
    rows = {row.key: row for row in total_rows(summary) if row.key}
    check_texts(verdict, rows.values(), summary)
    check_regime(verdict, rows.get("bearing.electrical_behaviour"), summary)
    assert verdict.heading.startswith(verdict.lead)
    if chance is None:
        assert verdict.level in ("grey", "green", "yellow")
        return True
    low, high = chance.bounds
    touching = is_shorted(summary)
    at_times = verdict.lead == "Discharges possible" and not touching
    level, least, most = (TOUCHING if touching or at_times else RULE)[verdict.lead]
    if at_times:
        most = 0.05
    assert verdict.level == level
    assert (low <= most and high >= least) if chance.failed else least <= chance.probability <= most
    if not chance.failed:
        assert chance_text(chance.probability, chance.error) in verdict.text
    return True


def check_texts(verdict, rows, summary):
    """No text contains a number that is none."""
    texts = [verdict.text, *(row.text for row in rows), *summary["warnings"]]
    assert [text for text in texts if re.search(r"\b(nan|inf|None)\b", text)] == []


def check_regime(verdict, row, summary):
    """The verdict states the regime and the share of time of the table, or none."""
    regime = summary["bearing"]["electrical_behaviour"]
    named = set(re.findall(r"\b(capacitive|intermittent|resistive)\b", verdict.text))
    assert named <= {regime}
    if row is not None and named:
        assert row.value == regime
        (share,) = set(re.findall(r"contacts short it ([^,.;]*(?:\.\d+)?[^,.;]*of the time)", verdict.text))
        assert share in row.note
    elif is_shorted(summary) and verdict.level != "grey":
        assert "insulates" in verdict.text
        assert summary["bearing"]["contact_time_share"] == 0.0


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
def test_verdict_table_and_probability_agree(kind):
    draw = random.Random(f"one rule of a {kind}")
    assert sum(check(drawn(kind, draw)) for _ in range(3)) >= 2


def test_a_roller_bearing_whose_contacts_short_it_nearly_always_is_resistive():
    """The word of the table, and its share of time."""
    table = drawn("cylindrical roller", random.Random(1))
    table["bearing"] |= {"inner_speed": "20 rpm", "temperature": "90 degC", "composite_rq": "0.4 um"}
    table["bearing"] |= {"element_material": "steel", "summit_height": 2.0}
    table["bearing"].pop("coating", None)
    solution = solve_bearing(BearingCase.from_dict(table), workers=1).solution
    summary = summary_of(solution)
    assert summary["bearing"]["electrical_behaviour"] == "resistive"
    verdict = bearing_verdict(solution, MarginAnalysis())
    assert "the bearing is resistive" in verdict.text
    check_regime(
        verdict, {row.key: row for row in total_rows(summary)}["bearing.electrical_behaviour"], summary
    )


@pytest.mark.slow
@pytest.mark.gate
def test_an_extrapolated_viscosity_is_not_called_a_possible_breakdown():
    """At -10 degC the probability is below a per mille: breakdown is not known, and not called possible."""
    case = BearingCase.from_toml(EXAMPLES / "bearing_6208.toml").replace(
        {"contacts": "atlas", "bearing.temperature": "-10 degC"}
    )
    result = solve_bearing(case, workers=1)
    assert result.uncertainty.probability < 0.001
    verdict = result.verdict
    assert (verdict.level, verdict.lead) == ("yellow", "Breakdown not known")
    assert "The viscosity is extrapolated to below 0 °C." in verdict.text
    assert "The probability of breakdown, which does not contain this, is below 0.75 %" in verdict.text
    rows = {row.key: row.text for row in total_rows(result.summary())}
    assert rows["uncertainty.breakdown_probability"] == "below 0.75 %"
    assert math.isfinite(result.margin)


@pytest.mark.slow
def test_a_margin_just_below_one_is_a_possible_breakdown_in_every_sentence():
    """A 32208 with a margin of 0.98, which breaks down in about half of all cases."""
    tapered = {"base": "32208", "radial_load": "4 kN", "axial_load": "1.5 kN", "inner_speed": "3000 rpm"}
    tapered |= {"composite_rq": "0.09 um", "temperature": "70 degC"}
    case = BearingCase.from_toml(EXAMPLES / "bearing_6208.toml").to_dict()
    result = solve_bearing(BearingCase.from_dict(case | {"bearing": tapered, "contacts": "atlas"}), workers=1)
    assert 0.95 < result.margin < 1.0
    verdict = result.verdict
    likely = result.uncertainty.probability > 0.5
    assert verdict.lead == ("Breakdown likely" if likely else "Breakdown possible")
    assert re.search(r"Below about 30[0-9]{2} rpm the margin is below 1\.", verdict.text)
    (told,) = (str(one) for one in result.warnings if one.code == "breakdown-expected")
    for text in (verdict.text.removeprefix(verdict.lead), told):
        assert re.findall(r"breakdown is (?:likely|expected|possible)", text, re.IGNORECASE) == []
