"""Capacitive divider of a motor with its bearings, against the quotient of capacitances."""

import numpy as np
import pytest

from ehlectric.bearing.circuit import Path
from ehlectric.drive.network import machine
from tests.helpers.drives import capacitive_divider, element, motor
from tests.helpers.each import each

INDUCTANCES = (
    {},
    {"common_mode_inductance": "1 mH", "common_mode_resistance": "2 ohm"},
    {"ground_inductance": "1 uH"},
    {"ground_inductance": "1 uH", "frame_earth_capacitance": "10 nF", "cable_capacitance": "1 nF"},
)


@each("keys", INDUCTANCES)
def test_divider_is_that_of_the_capacitances(keys):
    """C_wr/(C_wr + C_rf + C_DE + C_NDE), whatever lies before the winding."""
    circuit, bearings = motor(**keys), [element(300e-12), element(200e-12)]
    share = 50.0 / (50.0 + 500.0 + 300.0 + 200.0)
    assert capacitive_divider(circuit, bearings) == pytest.approx((share, share), rel=1e-12)


@each("keys", INDUCTANCES)
def test_a_coating_takes_its_part(keys):
    """Films of 300 pF in series with a coating of 600 pF: 200 pF, of whose voltage they have two thirds."""
    circuit = motor(**keys)
    bearings = [element(300e-12, path=Path(coating=600e-12)), element(200e-12)]
    share = 50.0 / (50.0 + 500.0 + 200.0 + 200.0)
    assert capacitive_divider(circuit, bearings) == pytest.approx((share * 2.0 / 3.0, share), rel=1e-12)


def test_inductances_without_a_capacitance_between_them_are_in_series():
    """Poles of L p^2 + R p + 1/C with L = 3 + 2 uH and C = C_wf + C_wr C_rf/(C_wr + C_rf)."""
    keys = {"ground_inductance": "2 uH", "ground_resistance": "1 ohm"}
    circuit = motor(common_mode_inductance="3 uH", common_mode_resistance="4 ohm", **keys)
    capacitance = 5e-9 + 50e-12 * 500e-12 / 550e-12
    poles = np.roots([5e-6, 5.0, 1.0 / capacitance])
    rates = np.linalg.eigvals(machine(circuit, "rotor").equations.rates)
    assert sorted(rates[np.abs(rates) > 1.0].imag) == pytest.approx(sorted(poles.imag), rel=1e-9)
    assert np.max(rates.real[np.abs(rates) > 1.0]) == pytest.approx(poles[0].real, rel=1e-9)
