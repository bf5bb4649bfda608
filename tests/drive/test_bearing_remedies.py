"""Remedies at a single bearing: by hand, at their limits, and as the simulation of the drive has them."""

import math

import pytest

from ehlectric.bearing.result import solve_bearing
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.cases.drive_case import DriveCase
from ehlectric.drive.bearing_remedies import (
    EDGE,
    at_shaft_voltage,
    grounded_verdict,
    grounded_voltage,
    with_remedy,
)
from ehlectric.drive.result import solve_drive
from tests.helpers.drives import small_drive
from tests.helpers.each import each
from tests.helpers.places import EXAMPLES

EPS0 = 8.8541878128e-12
COATED = {
    "bearings.bearing.coating.base": "schaeffler-j20aa",
    "bearings.bearing.coating.relative_permittivity": 9.0,
}
HYBRID = {
    "bearings.bearing.element_material": "silicon-nitride",
    "bearings.bearing.element_capacitance": "5 pF",
}


@pytest.fixture(scope="module")
def case():
    return BearingCase.from_toml(EXAMPLES / "bearing_6208.toml").replace({"contacts": "formula"})


@pytest.fixture(scope="module")
def now(case):
    return solve_bearing(case, workers=1)


def totals(case, changes):
    return solve_bearing(with_remedy(case, changes), workers=1).summary(probable=False)["bearing"]


@pytest.mark.slow
def test_a_coating_in_series_takes_its_share(case, now):
    """On the 80 mm x 18 mm of the outer ring, 200 um of a permittivity of 9."""
    own, found = now.summary(probable=False)["bearing"], totals(case, COATED)
    films = own["capacitance"]
    coating = EPS0 * 9.0 * math.pi * 80e-3 * 18e-3 / 200e-6
    whole = films * coating / (films + coating)
    shaft = 300.0 * 20e-12 / (1020e-12 + 2.0 * whole)
    assert found["shaft_voltage"] == pytest.approx(shaft, rel=1e-9)
    assert found["coating_share"] == pytest.approx(films / (films + coating), rel=1e-9)
    assert found["film_voltage"] == pytest.approx(shaft * coating / (films + coating), rel=1e-9)
    assert found["first_break"] == pytest.approx(own["first_break"], rel=1e-12), "the films are the same"


def test_ceramic_elements_have_the_voltage_of_the_shaft_and_no_breakdown(case):
    found = totals(case, HYBRID)
    assert found["first_break"] is found["margin"] is None
    assert (
        found["element_voltage"] == found["shaft_voltage"] == pytest.approx(300.0 * 20.0 / 1110.0, rel=1e-12)
    )


def test_other_oil_is_that_of_the_library_alone(case):
    changed = with_remedy(case, {"bearings.lubricant.base": "fva-3"})
    assert changed.lubricant.base == "fva-3"
    assert changed.lubricant.temperature is None, "the data sheet was that of the other oil"


def test_changes_of_the_circuit_leave_the_bearing(case):
    assert with_remedy(case, {"circuit.grounding_ring_resistance": "1 ohm"}) is case


def test_a_ring_is_a_high_pass_with_the_winding(now):
    """The response of R C to a ramp, and its limits: all of the current, and the divider alone."""
    films = now.capacitance()
    c, edge, rise = 1020e-12 + 2.0 * films, EDGE * 300.0, 1e-7
    ring = 50.0
    slow = ring * c
    expected = ring * 20e-12 * edge / rise * (1.0 - math.exp(-rise / slow))
    assert grounded_voltage(now.solution, ring, rise) == pytest.approx(expected, rel=1e-9)
    assert grounded_voltage(now.solution, 1e-3, rise) == pytest.approx(1e-3 * 20e-12 * edge / rise, rel=1e-6)
    assert grounded_voltage(now.solution, 1e9, rise) == pytest.approx(EDGE * now.shaft_voltage, rel=1e-4)


def test_without_a_motor_a_ring_has_no_voltage(case):
    bare = solve_bearing(case.replace({"motor": None}), workers=1)
    assert grounded_voltage(bare.solution, 1.0, 1e-7) is None


@pytest.mark.slow
@pytest.mark.gate
def test_margins_follow_the_shaft_voltage(now):
    summary = now.summary(probable=False)
    found = at_shaft_voltage(summary, 0.5 * summary["bearing"]["shaft_voltage"])
    own, other = summary["bearing"], found["bearing"]
    assert other["margin"] == pytest.approx(2.0 * own["margin"], rel=1e-12)
    assert other["margin"] == pytest.approx(other["shaft_first_break"] / other["shaft_voltage"], rel=1e-12)
    assert other["film_voltage"] == pytest.approx(0.5 * own["film_voltage"], rel=1e-12)
    assert "margin" not in found, "its critical speed is that of the other voltage"


@each("margin, level", [(1.3, "green"), (1.1, "yellow"), (0.9, "yellow"), (0.7, "red"), (None, "grey")])
def test_the_verdict_on_a_ring_takes_the_strength_as_uncertain(margin, level):
    assert grounded_verdict(margin).level == level


def simulated(remedy, circuit):
    """Bearing of a small drive with a remedy: its simulation, and the same bearing with that motor."""
    drive = small_drive(**{f"circuit.{key}": value for key, value in circuit.items()})
    result = solve_drive(drive.replace(remedy))
    motor = {"common_mode_voltage": f"{0.5 * drive.source.dc_link} V", **circuit}
    tables = {**drive.bearings[0].to_dict(), "motor": motor}
    return result.summary()["drive_end"], BearingCase.from_dict(tables), drive


CIRCUIT = {"winding_rotor_capacitance": "50 pF", "rotor_frame_capacitance": "500 pF"}


@pytest.mark.slow
def test_a_ring_is_as_its_simulation_says():
    ring = {"circuit.grounding_ring_resistance": "1 ohm"}
    end, case, drive = simulated(ring, CIRCUIT)
    bearing = solve_bearing(case, workers=1)
    voltage = grounded_voltage(bearing.solution, 1.0, drive.source.rise_time)
    assert end["peak_voltage"] == pytest.approx(voltage, rel=0.02)
    assert end["events"] == 0


@pytest.mark.slow
@pytest.mark.parametrize("remedy", [HYBRID, COATED])
def test_elements_and_coatings_have_the_voltage_of_the_drive(remedy):
    """The divider of the drive at the peak of its source is that of the bearing.

    That of the drive has the elements at their first position, that of the bearing has their mean.
    """
    end, case, drive = simulated(remedy, CIRCUIT)
    peak = 0.5 * drive.source.dc_link
    assert end["voltage_ratio"] * peak == pytest.approx(totals(case, remedy)["film_voltage"], rel=1e-2)


@pytest.mark.slow
def test_ceramic_elements_never_discharge_in_the_simulation():
    end, case, _ = simulated(HYBRID, CIRCUIT)
    assert end["events"] == 0
    assert end["peak_voltage"] == pytest.approx(totals(case, HYBRID)["element_voltage"], rel=0.02)


def test_an_edge_is_a_third_of_the_dc_link():
    """Over the largest voltage of the modulation of the example, half of the link."""
    from ehlectric.drive.inverter import steps_of

    source = DriveCase.from_toml(EXAMPLES / "drive.toml").running_source
    start, intervals = steps_of(source, 1e-3)
    steps = [step for one in intervals for step in one.step]
    assert max(map(abs, steps)) / abs(start) == pytest.approx(EDGE, rel=1e-12)
