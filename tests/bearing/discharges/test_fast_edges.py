"""Capacitive current at fast edges, and the warning of low current densities."""

import pytest

from ehlectric.bearing.bearing_discharges import WHITE_ETCHING
from ehlectric.bearing.result import solve_bearing
from tests.helpers.bearings import BALLS, bearing_case


def summary(**changes):
    case = bearing_case(BALLS, contacts="atlas", **changes)
    return solve_bearing(case, workers=1).summary(probable=False)


@pytest.mark.slow
def test_current_at_an_edge():
    """i = C BVR dv/dt: 228.4 pF, 1.354 % and 20 V/ns would make 61.9 mA."""
    own = summary(motor__voltage_slope="20 V/ns")["bearing"]
    expected = own["shaft_capacitance"] * own["bearing_voltage_ratio"] * 20e9
    assert own["edge_current"] == pytest.approx(expected, rel=1e-12)
    assert summary()["bearing"]["edge_current"] is None


@pytest.mark.slow
@pytest.mark.parametrize(("current", "warned"), [("0.1 mA", True), ("100 mA", False)])
def test_low_current_densities_are_warned_of(current, warned):
    found = summary(discharge__peak_current=current)
    assert (found["bearing"]["current_density"] < WHITE_ETCHING) == warned
    assert ("white-etching" in found["warning_codes"]) == warned
