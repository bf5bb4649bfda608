"""Rows of a bearing: each column is true by itself, bounds have their sign, and failures come first."""

import re

import pytest

from ehlectric import BearingCase, solve
from ehlectric.tables.bearing_tables import (
    _alpha_star,
    _viscosity_ratio,
    films_table,
    loads_table,
    total_rows,
)
from tests.helpers.bearings import BALLS, bearing_case, changed

# A unit at the end of a value, and at the beginning of a note.
VALUE, NOTE = re.compile(r"\d (?:%|[µnpmk]?[smJFVN]|rpm|A/mm²)$"), re.compile(r"^(?:rpm|A/mm²|%)")


def summary_of(tables=BALLS, **changes):
    return solve(bearing_case(tables, contacts="formula", **changes)).summary()


def rows(summary):
    return {row.key: row for row in total_rows(summary)}


@pytest.fixture(scope="module")
def steel():
    """Summary of steel balls, with all that a discharge costs."""
    return summary_of(discharge__peak_current="1 A", bearing__inner_speed="1500 rpm")


@pytest.mark.slow
def test_values_and_notes_have_no_units(steel):
    """Value, unit and note are columns of a report."""
    for row in total_rows(steel):
        assert not VALUE.search(row.shown), row
        assert not NOTE.search(row.note), row
    assert rows(steel)["bearing.relaxation_time"].unit == "s"
    assert rows(steel)["bearing.current_density"].unit == "A/mm²"
    assert rows(steel)["margin.asperity_contact_speed"].unit == "rpm"


@pytest.mark.slow
def test_voltages_are_upper_and_fields_lower_bounds(steel):
    found = rows(steel)
    at_most = {key for key, row in found.items() if row.bound == "≤"}
    assert {
        "bearing.first_break", "bearing.ring_to_ring_breakdown", "bearing.breakdown_energy", "bearing.margin",
        "margin.effects.bearing.temperature", "bearing.lambda_ratio", "bearing.minimum_thickness",
    } <= at_most  # fmt: skip
    assert not {"bearing.capacitance", "bearing.shaft_voltage", "bearing.discharge_energy"} & at_most
    at_least = {key for key, row in found.items() if row.bound == "≥"}
    # A thinner film has a higher field, and it breaks down and touches at higher speeds.
    assert at_least == {
        *("bearing.strength_per_volt", "bearing.max_strength"),
        *("margin.critical_speed", "margin.asperity_contact_speed", "margin.capacitive_speed"),
    }
    value = f"{steel['bearing']['first_break']:.4g} V"
    assert found["bearing.first_break"].text.startswith(f"≤ {value}")
    heads = [str(column.header) for column in films_table(steel).columns]
    assert [re.findall(r"[≤≥]|\[.*\]", head) for head in heads if "≤" in head or "≥" in head] == [
        ["≥", "[V/µm]"],
        ["≤", "[V]"],
    ]


def test_the_capacitance_of_ceramic_elements_is_an_upper_bound():
    found = rows(summary_of(bearing__element_material="silicon-nitride"))
    assert found["bearing.capacitance"].bound == "≤"
    known = rows(
        summary_of(bearing__element_material="silicon-nitride", bearing__element_capacitance="10 pF")
    )
    assert known["bearing.capacitance"].bound == ""


@pytest.mark.slow
def test_a_shaft_that_discharges_through_the_oil_has_a_lower_voltage():
    found = rows(summary_of(discharge__conductivity="1 uS/m", motor__switching_frequency="10 kHz"))
    assert found["bearing.shaft_voltage"].bound == "≤"
    assert found["bearing.max_strength"].bound == ""
    assert found["margin.critical_speed"].bound == ""
    assert found["bearing.strength_per_volt"].bound == "≥"


def test_what_is_not_computed_says_so_in_the_column_of_values():
    found = rows(summary_of(bearing__inner_speed="30 rpm", discharge__dielectric_strength="15 V/um"))
    for name in ("bearing.meter_capacitance", "bearing.first_break"):
        assert found[name].shown == "not computed"
        assert not re.match(r"\W*(computed|given)", found[name].note)
        assert found[name].bound == ""
    assert found["bearing.first_break"].alarm
    assert found["bearing.parallel_capacitance"].shown == "not given"


@pytest.mark.slow
def test_a_parallel_capacitance_of_zero_is_given():
    found = rows(summary_of(bearing__parallel_capacitance="0 pF"))
    assert found["bearing.parallel_capacitance"].text.startswith("0 pF")


@pytest.mark.slow
def test_films_that_are_not_converged_are_said_first(steel):
    first, *others = total_rows({**steel, "converged": False})
    assert (first.name, first.alarm, first.shown) == ("NOT CONVERGED", True, "")
    assert others == total_rows(steel)


@pytest.mark.slow
def test_the_pressure_viscosity_coefficient_is_that_of_the_film_formulas(steel):
    row = rows(steel)["lubricant.alpha_star"]
    assert row.value == steel["lubricant"]["alpha_star"]
    assert f"α = {steel['lubricant']['pressure_viscosity_coefficient'] * 1e9:.4g} 1/GPa" in row.note


@pytest.mark.slow
def test_angles_have_no_negative_zero():
    summary = solve(BearingCase.from_dict(changed(BALLS, contacts="formula"))).summary()
    for row in summary["contacts"]:
        row["contact_angle"] = -1e-5
    (angles,) = (column for column in loads_table(summary).columns if "angle" in str(column.header))
    assert set(map(str, angles.cells)) == {"0.0"}


@pytest.mark.slow
def test_a_second_bearing_that_is_taken_as_equal_is_named(steel):
    assert "equal second bearing" in rows(steel)["bearing.shaft_voltage"].note
    given = summary_of(motor__second_bearing_capacitance="200 pF")
    assert "second bearing" not in rows(given)["bearing.shaft_voltage"].note


def test_notes_have_the_pressure_viscosity_coefficient_and_the_viscosity_in_their_units():
    """By hand: 22e-9 1/Pa, and 2.5 times 12e-6 m^2/s."""
    assert "α = 22 1/GPa" in _alpha_star({"lubricant": {"pressure_viscosity_coefficient": 22e-9}})
    shown = _viscosity_ratio({"life": {"viscosity_ratio": 2.5, "rated_viscosity": 12e-6}})
    assert shown.value == 2.5
    assert "ν = 30 mm²/s" in shown.note
