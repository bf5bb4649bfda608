"""Netlists of whole drives, simulated by ngspice, beside the divider and the simulation of the drive."""

import numpy as np
import pytest

from ehlectric import DriveCase, InputError, write_drive_netlist
from ehlectric.bearing.result import solve_bearing
from ehlectric.drive.discharges.films_and_source import Segments
from ehlectric.drive.drive_bearings import bearing_element
from ehlectric.drive.drive_netlist_files import drive_netlist
from ehlectric.drive.inverter import steps_of
from ehlectric.drive.source_pieces import edges
from tests.helpers.drives import arc, capacitive_divider, march, small_drive
from tests.helpers.ngspice import run_netlist

STRONG = {"bearings.discharge.dielectric_strength": "190 V/um"}
PATHS = {
    "circuit.common_mode_inductance": "20 uH",
    "circuit.common_mode_resistance": "50 ohm",
    "circuit.ground_inductance": "2 uH",
    "circuit.ground_resistance": "10 ohm",
    "circuit.cable_capacitance": "1 nF",
    "circuit.frame_earth_capacitance": "300 pF",
}


def simulated(case, folder):
    """Numbers that ngspice measures in the bench of a drive."""
    files = write_drive_netlist(case, folder / "bearings.lib", bench=folder / "bench.cir", workers=1)
    assert [file.name for file in files] == ["bearings.lib", "bench.cir"]
    return run_netlist(folder / "bench.cir")


def still(case):
    """Bearings of a drive as elements of the circuit, which stay at their mean capacitance."""
    found = []
    for one in case.bearings:
        whole = bearing_element(solve_bearing(one, workers=1), case.breakdown)
        whole.capacitance[:] = whole.mean_capacitance
        found.append(whole)
    return found


@pytest.mark.slow
@pytest.mark.parametrize("modulation", ["space-vector", "six-step"])
def test_without_breakdown_the_shaft_has_the_voltage_of_the_divider(modulation, tmp_path):
    """From peak to peak: the DC link, or a third of it in six-step operation, over the capacitances."""
    case = small_drive(**STRONG)
    if modulation == "six-step":
        table = case.to_dict()
        source = {"dc_link": 560.0, "modulation": modulation, "fundamental_frequency": 1e3, "rise_time": 1e-7}
        case = DriveCase.from_dict({**table, "source": source})
    found = simulated(case, tmp_path)
    swing = 560.0 if modulation == "space-vector" else 560.0 / 3.0
    assert found["winding_peak_to_peak"] == pytest.approx(swing, rel=1e-6)
    ratio = capacitive_divider(case.circuit, still(case))[0]
    assert found["shaft_peak_to_peak"] == pytest.approx(ratio * swing, rel=1e-3)


@pytest.mark.slow
def test_inductances_and_cable_are_those_of_the_simulation(tmp_path):
    """Largest and smallest voltage with ringing, after a rest that is longer than all of it."""
    case = small_drive(**STRONG, **PATHS)
    found = simulated(case, tmp_path)
    source = case.running_source
    start, intervals = steps_of(source, 4.0 / source.switching_frequency)
    rest = Segments(
        np.array([1e-6, 1e-3]), np.array([0.0, start]), np.array([start / 1e-6, 0.0]), np.zeros(2, complex)
    )
    record = march(
        case.circuit,
        still(case),
        arc(),
        [rest, *edges(start, intervals, source.rise_time)],
        highest=60.0,
        trace=np.inf,
    )
    times, voltage = record.trace[:, 0], record.trace[:, 2]
    after = voltage[times > 0.9e-3]
    assert np.ptp(after) == pytest.approx(found["shaft_peak_to_peak"], rel=2e-3)


@pytest.mark.slow
def test_the_arc_of_the_drive_discharges_each_bearing_by_itself(tmp_path):
    """Different bearings have subcircuits of their own; the current of the weaker one is that of its arc."""
    case = small_drive(**{"non_drive_end.discharge.dielectric_strength": "190 V/um"})
    found = simulated(case, tmp_path)
    text = (tmp_path / "bearings.lib").read_text()
    assert text.count(".subckt") == 2
    assert ".subckt bearing_6208_drive_end shaft housing" in text
    netlist = drive_netlist(case, workers=1)
    threshold, own = netlist.bearings[0].default.threshold, netlist.bearings[0].default.capacitance
    assert max(found["shaft_highest"], -found["shaft_lowest"]) == pytest.approx(threshold, rel=0.05)
    peak = max(found["drive_end_current_highest"], -found["drive_end_current_lowest"])
    # What the films hold themselves does not flow through the leads of their bearing. The arc decays within
    # 10 ns, of which the steps of 5 ns at most miss some per cent of the peak.
    others = 1.0 - own / (550e-12 + own + netlist.bearings[1].default.capacitance)
    assert peak == pytest.approx(others * threshold / case.breakdown.arc_resistance, rel=0.05)
    charging = max(found["non_drive_end_current_highest"], -found["non_drive_end_current_lowest"])
    assert charging < 0.6 * peak


@pytest.mark.slow
def test_a_measured_voltage_is_the_source_of_the_bench(tmp_path):
    rows = [f"{k * 1e-7:.7e},{200.0 if k // 50 % 2 else -200.0}" for k in range(400)]
    (tmp_path / "scope.csv").write_text("time (s),voltage (V)\n" + "\n".join(rows) + "\n")
    table = small_drive(**STRONG).to_dict()
    case = DriveCase.from_dict({**table, "source": {"file": str(tmp_path / "scope.csv")}})
    found = simulated(case, tmp_path)
    assert found["winding_peak_to_peak"] == pytest.approx(400.0, rel=1e-6)
    ratio = capacitive_divider(case.circuit, still(case))[0]
    assert found["shaft_peak_to_peak"] == pytest.approx(400.0 * ratio, rel=1e-3)


@pytest.mark.parametrize(
    ("changes", "key"),
    [
        ({"breakdown.extinction_current": "10 A"}, "breakdown.extinction_current"),
        ({"breakdown.extinction_voltage": "100 V"}, "breakdown.extinction_voltage"),
        ({"drive.speed": "50 rpm"}, "drive_end.bearing.contact_resistance"),
    ],
)
def test_what_a_bearing_lacks_is_told_by_the_key_of_the_drive(changes, key, tmp_path):
    with pytest.raises(InputError) as error:
        write_drive_netlist(small_drive(**changes), tmp_path / "bearings.lib", workers=1)
    assert error.value.key == key
    assert not list(tmp_path.iterdir())
