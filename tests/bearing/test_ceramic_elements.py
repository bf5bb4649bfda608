"""Ceramic elements: voltage by the divider, field by the charge of a disc, and the verdict."""

import math

import pytest

from ehlectric.bearing.result import solve_bearing
from ehlectric.quantities.result_bounds import bearing_bounds
from ehlectric.quantities.results import BEARING_BOOK
from tests.helpers.bearings import BALLS, bearing_case
from tests.helpers.each import each

MATERIAL = {"bearing__element_material": "silicon-nitride"}
GIVEN = MATERIAL | {"bearing__element_capacitance": "5 pF"}
COATING = {"ring": "outer", "thickness": "200 um", "relative_permittivity": 9.0, "area": "45 cm^2"}


def solved(**changes):
    return solve_bearing(bearing_case(BALLS, contacts="formula", **changes), workers=1)


def totals(**changes):
    return solved(**changes).summary(probable=False)["bearing"]


@each("changes, expected", [
    (GIVEN, 300.0 * 20.0 / (20.0 + 1000.0 + 2.0 * 45.0)),
    (MATERIAL, 300.0 * 20.0 / (20.0 + 1000.0)),
    (MATERIAL | {"motor__second_bearing_capacitance": "80 pF"}, 300.0 * 20.0 / (20.0 + 1000.0 + 80.0)),
    (MATERIAL | {"bearing__parallel_capacitance": "30 pF"}, 300.0 * 20.0 / (20.0 + 1000.0 + 2.0 * 30.0)),
])  # fmt: skip
def test_the_voltage_on_an_element_is_that_of_the_divider(changes, expected):
    """Nine elements of 5 pF; without their capacitance the voltage of a bearing without any is a bound."""
    assert totals(**changes)["element_voltage"] == pytest.approx(expected, rel=1e-12)


def test_a_coating_takes_its_share_of_the_voltage():
    coating = 8.8541878128e-12 * 9.0 * 45e-4 / 200e-6
    share = coating / (coating + 45e-12)
    both = coating * 45e-12 / (coating + 45e-12)
    expected = share * 300.0 * 20e-12 / (1020e-12 + 2.0 * both)
    assert totals(**GIVEN, bearing__coating=COATING)["element_voltage"] == pytest.approx(expected, rel=1e-9)


def test_the_field_is_that_below_a_disc_with_the_whole_voltage():
    """The charge of a disc on a half-space is 4 eps b V, spread over its area pi b^2."""
    found = solved(**GIVEN).summary(probable=False)
    own, rows = found["bearing"], [row for row in found["contacts"] if row["solved"]]
    most = [
        max((r for r in rows if r["ring"] == ring), key=lambda r: r["load"]) for ring in ("inner", "outer")
    ]
    b = min(min(row["semi_axis_x"], row["semi_axis_y"]) for row in most)
    per_volt = 4.0 * b / (math.pi * b**2)
    assert own["element_field"] == pytest.approx(per_volt * own["element_voltage"], rel=1e-12)
    assert own["element_breakdown"] == pytest.approx(18e6 / per_volt, rel=1e-12)
    assert own["element_margin"] == pytest.approx(
        own["element_breakdown"] / own["element_voltage"], rel=1e-12
    )
    # Far above the mean field across the ball.
    assert per_volt > 10.0 / 11.906e-3


def test_the_voltage_is_a_bound_without_a_capacitance():
    signs = [bearing_bounds(BEARING_BOOK, solved(**one).summary(probable=False)) for one in (GIVEN, MATERIAL)]
    assert ["bearing.element_voltage" in one for one in signs] == [False, True]
    assert all(one["bearing.element_field"] == "≤" for one in signs)
    assert all(one["bearing.element_breakdown"] == "≥" for one in signs)


@pytest.mark.slow
@pytest.mark.gate
def test_conducting_elements_have_none_of_these_numbers():
    own = totals()
    assert {own[f"element_{name}"] for name in ("voltage", "field", "breakdown", "margin")} == {None}


def test_the_verdict_says_what_an_element_must_insulate_and_what_it_can():
    verdict, own = solved(**GIVEN).verdict, totals(**GIVEN)
    assert verdict.level == "green"
    assert f"must insulate {own['element_voltage']:.3g} V at 3000 rpm" in verdict.text
    assert f"at most {1e-6 * own['element_field']:.2g} V/µm" in verdict.text
    # 18 V/um of the library, within the fifth by which a strength without a range may be wrong.
    assert "14.4 to 21.6 V/µm" in verdict.text
    assert "IEC 60672" in verdict.text
    assert "insulate at most" in solved(**MATERIAL).verdict.text


def test_a_voltage_near_the_strength_is_in_doubt():
    """The strength may be a fifth lower: from four fifths of the breakdown voltage on nothing is sure."""
    own = totals(**GIVEN)
    levels = []
    for part in (0.79, 0.81):
        volts = 300.0 * part * own["element_margin"]
        levels.append(solved(**GIVEN, motor__common_mode_voltage=volts).verdict.level)
    assert levels == ["green", "yellow"]
