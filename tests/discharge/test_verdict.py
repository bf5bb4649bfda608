"""Verdicts on contacts: levels, words, and that doubt leaves no green one."""

import dataclasses

import pytest

from ehlectric import Case, solve
from ehlectric.cases.discharge_inputs import Discharge
from ehlectric.discharge.film_breakdown import Breakdown
from ehlectric.discharge.film_verdict import contact_verdict, weibull_part
from ehlectric.quantities.result_warnings import ResultWarning
from ehlectric.readable import ratio_text
from tests.helpers.each import each

CONSTANT = Discharge.from_dict({"dielectric_strength": "15 V/um"})
WEIBULL = {"scale": "15 V/um", "shape": 10, "reference_area": "1 mm^2"}
CONTACT = {
    "contact": {
        "reduced_radius": "14.1 mm", "reduced_modulus": "226 GPa", "load_per_length": "0.4 MN/m",
        "entrainment_speed": "4 m/s",
    },
    "lubricant": {"base": "paper"},
    "grid": {"nodes": 801},
}  # fmt: skip


def of_margin(margin, voltage=8.0):
    at = margin * voltage
    return Breakdown("constant", 15e6, at, None, None, margin, float(margin <= 1.0))


def verdict(
    margin, *, discharge=CONSTANT, voltage=8.0, warnings=(), error=0.0, flooded=True, low=None, high=None
):
    found = dataclasses.replace(
        of_margin(margin, voltage), breakdown_voltage_low=low, breakdown_voltage_high=high
    )
    return contact_verdict(discharge, found, voltage, warnings=warnings, error=error, flooded=flooded)


def contact(**tables):
    return solve(Case.from_dict(CONTACT | tables))


def test_words_of_a_contact_that_holds_its_voltage():
    for flooded in (True, False):
        text = verdict(1.3, flooded=flooded).text
        numbers = ("No breakdown expected: ", " 8 V", " 10.4 V", "(margin 1.30)", "15 V/µm is an input")
        assert [number for number in numbers if number not in text] == []
        assert ("Upper bound: isothermal, fully flooded" in text) == flooded
    heading, voltages, *_ = str(verdict(1.3)).splitlines()
    assert heading.startswith("No breakdown expected")
    assert " ".join(voltages.split()) == "voltages applied 8 V, breakdown 10.4 V, margin 1.30"


@each(
    "margin, error, level, lead",
    [
        (1.25, 0.0, "green", "No breakdown expected"),
        (0.8, 0.0, "red", "Breakdown expected"),
        (1.02, 0.03, "yellow", "Breakdown possible"),
        (0.99, 0.03, "yellow", "Breakdown likely"),
        (1.3, 0.03, "green", "No breakdown expected"),
        (1.24, 0.0, "yellow", "Breakdown possible"),
        (1.0, 0.0, "yellow", "Breakdown possible"),
        (0.84, 0.0, "yellow", "Breakdown likely"),
    ],
)
def test_levels_with_the_error_of_the_film(margin, error, level, lead):
    found = verdict(margin, error=error)
    assert (found.level, found.margin) == (level, margin)
    assert found.text.startswith(f"{lead}: ")
    assert ("off on this grid" in found.text) == (level == "yellow" and error > 0.0)


def test_a_margin_just_below_one_is_not_rounded_to_one():
    assert "(margin 0.9981)" in verdict(0.9981).text


def test_a_strength_that_differs_by_20_percent_is_said():
    for margin, parts in (
        (1.196, ("12 V/µm", "20 % lower", " 0.96")),
        (0.9, ("18 V/µm", "20 % higher", " 1.08")),
    ):
        assert [part for part in parts if part not in verdict(margin).text] == []
    table = Discharge.from_dict(
        {"strength_table": {"pressure": ["0 GPa", "2 GPa"], "strength": ["15 V/um", "25 V/um"]}}
    )
    assert "20 % lower the margin is 0.88" in verdict(1.1, discharge=table).text


def test_a_weibull_law_counts_at_five_percent():
    """Probability of a voltage v: 1 - exp(-(v/V)^m); at 5 % v/V = 0.0513^(1/10) = 0.743."""
    law = Discharge.from_dict({"weibull": WEIBULL, "length": "10 mm"})
    part, most = weibull_part(10.0, 0.05), weibull_part(10.0, 0.95)
    assert part == pytest.approx(0.743, abs=5e-4)
    for margin, level in ((1.3, "yellow"), (1.4, "green"), (0.8, "red")):
        at = 8.0 * margin
        found = verdict(margin, discharge=law, low=part * at, high=most * at)
        assert found.level == level
        ends = ratio_text(part * margin), ratio_text(most * margin)
        assert f"(margin {margin:.2f}, {ends[0]} to {ends[1]})" in found.text
        assert "63.2 %" in found.text
        assert "Weibull law" in found.text


@pytest.mark.parametrize("code", ["not-converged", "grid-far-too-coarse", "inlet-far-too-short"])
def test_numbers_that_must_not_be_used_have_no_verdict(code):
    for margin in (0.5, 2.0):
        found = verdict(margin, warnings=(ResultWarning(code, "do not use it"),))
        assert (found.level, found.margin) == ("grey", None)


@each(
    "code",
    ["surfaces-touch", "tunnelling", "error-unknown", "field-range-too-narrow", "estimated-alpha"],
)
def test_a_doubt_leaves_no_green_verdict(code):
    warned = (ResultWarning(code, "somewhere"),)
    assert verdict(2.0, warnings=warned).level == "yellow"
    assert verdict(2.0, warnings=(ResultWarning("regime", "a regime"),)).level == "green"
    assert verdict(0.5, warnings=warned).level == "red"


def test_contacts_have_a_verdict_only_with_a_discharge():
    plain = contact()
    assert plain.verdict is None
    assert "verdict" not in plain.summary()
    bare = contact(discharge={"conductivity": "1 pS/m"})
    assert bare.verdict.level == "grey"
    assert "no dielectric strength" in bare.verdict.text


def test_a_solved_contact_below_one_is_warned_of():
    """Strengths with which the film breaks down at half and at twice the applied 2 V."""
    film = contact().film.minimum_thickness
    for factor, level in ((0.5, "red"), (2.0, "green")):
        result = contact(discharge={"dielectric_strength": factor * 2.0 / film})
        found = result.summary()
        assert result.verdict.level == level
        assert result.verdict.margin == pytest.approx(factor, rel=1e-3)
        names = list(found)
        assert names.index("verdict") == names.index("warning_codes") + 1
        assert found["verdict"] == result.verdict.text
        warned = [warning for warning in result.warnings if warning.code == "breakdown-expected"]
        assert len(warned) == (factor < 1.0)
        for warning in warned:
            assert warning.severity == "warning"
            assert "applied voltage 2 V" in str(warning)
            assert warning.code == "breakdown-expected"


def test_a_film_that_is_no_solution_has_no_verdict():
    result = contact(
        discharge={"dielectric_strength": "1 kV/um"}, solver={"max_iterations": 1, "tolerance": 1e-11}
    )
    assert not result.converged
    assert result.verdict.level == "grey"
    assert "breakdown-expected" not in {warning.code for warning in result.warnings}


def test_a_voltage_that_is_not_given_is_stated():
    """The default potentials are -1 and 1 V, so that 2 V lie across the film."""
    tables = {
        "contact": {"reduced_radius": "14.1 mm", "reduced_modulus": "226 GPa", "entrainment_speed": 4.0}
        | {"max_hertz_pressure": "1 GPa"},
        "lubricant": {"base": "paper"},
        "discharge": {"dielectric_strength": "15 V/um"},
        "grid": {"nodes": 257},
    }
    verdict = solve(Case.from_dict(tables)).verdict
    assert "2 V between the surfaces is the default" in verdict.text
    given = solve(Case.from_dict(tables | {"electric": {"potential_2": "3 V"}})).verdict
    assert "default-voltage" not in [one.code for one in given.assumptions]
