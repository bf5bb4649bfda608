"""Quantities of a drive between simulated drives, by their units."""

import numpy as np
import pytest

from ehlectric.bearing import MOTOR
from ehlectric.drive.measurable import DriveModel, _Nodes
from tests.helpers.drives import small_drive
from tests.helpers.each import each

PATHS = "winding_rotor", "rotor_frame"


@each("quantities", ["at", "errors"])
def test_a_voltage_is_its_part_of_the_shaft_voltage(quantities):
    """Nodes have the rms voltage as a part of the peak: at another peak it and its error are as many times
    larger, and the discharges remain. Of equal nodes the error is zero, of others it is not.
    """
    places = np.linspace(0.0, 1.0, 16)[:, np.newaxis]
    nodes = _Nodes.of(
        places, np.stack([0.3 + 0.1 * np.cos(40.0 * places[:, 0]), 50.0 * places[:, 0] ** 2], 1)
    )
    shaft = np.array([[4.0, 4.0, 4.0]])
    at = np.array([[[0.2], [0.5], [0.9]]])
    low, high = (getattr(nodes, quantities)(at, factor * shaft) for factor in (1.0, 5.0))
    assert np.all(low["shaft_voltage_rms"] > 0.0)
    assert high["shaft_voltage_rms"] == pytest.approx(5.0 * low["shaft_voltage_rms"], rel=1e-12)
    assert high["discharge_rate"] == pytest.approx(low["discharge_rate"], rel=1e-12)


def test_voltages_of_the_divider_vanish_where_a_bearing_touches():
    """C_wr/(C_wr + C_rf + C_1 + C_2) of the peak; the margin is the smaller breakdown voltage over it."""
    model = DriveModel.of(small_drive())
    winding, frame = (model.case.circuit.capacitances[f"{name}_capacitance"] for name in PATHS)
    capacitances, limits = (3e-10, 2e-10), ([20.0, 0.0, 9.0], [5.0, 8.0, 0.0])
    ends = [
        {"shaft_capacitance": np.full((3, 1), capacitance), "breakdown_voltage": np.array([limit]).T}
        for capacitance, limit in zip(capacitances, limits, strict=True)
    ]
    found = model._circuit(np.full((3, len(model.inputs)), 0.5), ends, np.array([280.0]))
    ratio = winding / (winding + frame + sum(capacitances))
    expected = {
        "bearing_voltage_ratio": ratio,
        "shaft_voltage": 280.0 * ratio,
        "margin": 5.0 / (280.0 * ratio),
    }
    for name, value in expected.items():
        assert found[name][:, 0] == pytest.approx([value, 0.0, 0.0], rel=1e-12)


def test_ranges_of_capacitances_lie_around_the_values_of_the_case():
    """Both ends are as far from the value, and half of the range is the part of it that judgement gives."""
    model = DriveModel.of(small_drive())
    capacitances = model.case.circuit.capacitances
    ends = {entry.name.key: entry.ends for entry in model.inputs if entry.name.key.startswith("circuit.")}
    assert set(ends) == {f"circuit.{name}_capacitance" for name in PATHS}
    for key, (low, high) in ends.items():
        value = capacitances[key.removeprefix("circuit.")]
        assert (0.5 * (low + high), 0.5 * (high - low)) == pytest.approx((value, MOTOR * value), rel=1e-12)
