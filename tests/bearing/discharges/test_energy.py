"""Energy of a discharge through a bearing, its pit, and the current density, by hand."""

import math

import pytest

from ehlectric import load
from ehlectric.bearing.result import solve_bearing
from ehlectric.bearing.run import save
from ehlectric.bearing.summary import summary_of
from ehlectric.errors import InputError
from tests.helpers.bearings import BALLS, ROLLERS, bearing_case

PIT = {"efficiency": 0.2, "melting_energy": "10 GJ/m^3"}


def solved(tables=BALLS, **changes):
    return solve_bearing(bearing_case(tables, contacts="formula", **changes), workers=1)


def totals(result):
    return summary_of(result.solution)["bearing"]


@pytest.fixture(scope="module")
def driven():
    return solved(discharge__pit=PIT, discharge__peak_current="0.5 A")


def test_a_discharge_empties_everything_at_the_shaft(driven):
    """20 pF of the winding, 1 nF of the frame and two bearings; C V^2/2 and a hemisphere by hand."""
    found = totals(driven)
    total = 20e-12 + 1e-9 + 2.0 * found["capacitance"]
    assert found["discharged_capacitance"] == pytest.approx(total, rel=1e-12)
    shaft, first = found["shaft_voltage"], found["first_break"]
    assert found["bearing_energy"] == pytest.approx(0.5 * found["capacitance"] * shaft**2, rel=1e-12)
    assert found["discharge_energy"] == pytest.approx(0.5 * total * shaft**2, rel=1e-12)
    assert found["breakdown_energy"] == pytest.approx(0.5 * total * first**2, rel=1e-12)
    # Melted volume: 0.2 E/(1e10 J/m^3), of a hemisphere of diameter d: pi d^3/12.
    volume = 0.2 * found["discharge_energy"] / 1e10
    assert found["pit_volume"] == pytest.approx(volume, rel=1e-12)
    assert math.pi * found["pit_diameter"] ** 3 / 12.0 == pytest.approx(volume, rel=1e-12)
    ratio = found["breakdown_pit_diameter"] / found["pit_diameter"]
    assert ratio == pytest.approx((first / shaft) ** (2.0 / 3.0), rel=1e-12)


@pytest.mark.parametrize(("tables", "factor"), [(BALLS, math.pi), (ROLLERS, 4.0)])
def test_the_current_density_is_that_of_the_smaller_contacts(tables, factor):
    """Ellipses pi a b of balls, rectangles 2 b times the length of rollers."""
    result = solved(tables, discharge__peak_current="2 A")
    areas = {"inner": {}, "outer": {}}
    for row in result.contacts():
        axes = row["semi_axis_x"] or 0.0, row["semi_axis_y"] or 0.0
        areas[row["ring"]][row["element"]] = factor * axes[0] * axes[1]
    smaller = [min(areas["inner"][k], areas["outer"][k]) for k in areas["inner"]]
    found = totals(result)
    assert found["hertz_area"] == pytest.approx(sum(smaller), rel=1e-12)
    assert found["current_density"] == pytest.approx(2.0 / sum(smaller), rel=1e-12)
    assert found["element_current_density"] == pytest.approx(2.0 / max(smaller), rel=1e-12)
    assert found["current_density_limits"] == [1e5, 3e5, 8e5]


def test_a_current_density_above_the_limits_is_a_warning(driven):
    """0.5 A over about 2 mm^2 is above 0.1 A/mm^2; 1 mA is not."""
    (warning,) = (one for one in driven.warnings if one.code == "current-density-high")
    density = totals(driven)["current_density"]
    assert f"{1e-6 * density:.3g} A/mm²" in warning.text
    above = sum(density > limit for limit in (1e5, 3e5, 8e5))
    assert f"above {above} of" in warning.text
    assert "0.1, 0.3 and 0.8 A/mm²" in warning.text
    low = solved(discharge__peak_current="1 mA")
    assert "current-density-high" not in {one.code for one in low.warnings}


def test_without_a_motor_the_external_capacitance_is_emptied():
    result = solved(motor=None, discharge__external_capacitance="0.5 nF", discharge__pit=PIT)
    found = totals(result)
    total = 0.5e-9 + found["capacitance"]
    assert found["discharged_capacitance"] == pytest.approx(total, rel=1e-12)
    assert found["breakdown_energy"] == pytest.approx(0.5 * total * found["first_break"] ** 2, rel=1e-12)
    assert found["discharge_energy"] is found["pit_diameter"] is None
    assert found["breakdown_pit_diameter"] > 0.0


def test_where_no_voltage_is_known_there_is_no_energy():
    for changes in ({"bearing__composite_rq": "0.3 um"}, {"bearing__element_material": "silicon-nitride"}):
        found = totals(solved(discharge__pit=PIT, discharge__peak_current="0.5 A", **changes))
        keys = ("discharged_capacitance", "bearing_energy", "discharge_energy", "breakdown_energy")
        assert {found[key] for key in (*keys, "pit_volume", "pit_diameter")} == {None}
        assert found["current_density"] > 0.0


@pytest.mark.parametrize(
    ("changes", "line"),
    [
        ({"discharge__external_capacitance": "1 nF"}, r"1e-09 F.*\[motor\]"),
        ({"discharge__pit": PIT, "motor": None}, "pit"),
    ],
)
def test_one_table_says_what_is_connected(changes, line):
    with pytest.raises(InputError, match=rf"^discharge\.external_capacitance: .*{line}"):
        bearing_case(BALLS, **changes)


@pytest.mark.slow
def test_a_stored_bearing_has_the_same_energies(driven, tmp_path):
    save(driven, tmp_path)
    again = load(tmp_path / "bearing.nc")
    assert totals(again) == totals(driven)
