"""Solved drives: what is measured, and what measured sources do."""

import numpy as np
import pytest

from ehlectric import InputError
from ehlectric.bearing.result import solve_bearing
from ehlectric.cases.drive_case import DriveCase
from ehlectric.drive.drive_bearings import bearing_element
from ehlectric.drive.drive_record import FILM, OFF, ON
from ehlectric.drive.netlist import equivalent_of
from ehlectric.drive.preparation import prepare
from ehlectric.drive.result import _parts, solve_drive
from ehlectric.drive.solver import solve
from ehlectric.drive.warnings import bearing_warnings
from ehlectric.quantities.inputs import ENDS
from tests.cases.test_drive import TABLE
from tests.helpers.drives import small_drive
from tests.helpers.places import EXAMPLES


@pytest.fixture(scope="module")
def case():
    from ehlectric import BearingCase

    bearing = BearingCase.from_toml(EXAMPLES / "bearing_6208.toml").replace({"contacts": "formula"})
    return DriveCase.from_dict({**TABLE, "drive_end": bearing.to_dict()})


@pytest.mark.slow
@pytest.mark.gate
@pytest.mark.parametrize("fundamental", [50.0, 60.0, 61.7])
def test_all_of_the_duration_is_measured(case, fundamental):
    """Also where the carrier has no whole number of periods in one of the fundamental."""
    duration = 0.03
    record = solve(
        case.replace({"source.fundamental_frequency": fundamental, "drive.duration": duration}), workers=1
    ).record
    assert np.sum(record.histogram, axis=1) == pytest.approx(np.full(2, duration), rel=1e-9)
    assert np.all((record.events[:, 0] >= 0.0) & (record.events[:, 0] <= duration))
    assert np.sum(record.counts) == len(record.events)


def test_a_measured_square_wave_is_the_computed_one(case, square):
    """Voltage across the films of a strong oil: that of the divider."""
    strong = case.replace({"bearings.discharge.dielectric_strength": "190 V/um"})
    solution = solve(measured(strong, square), workers=1)
    assert solution.highest_source == 200.0
    assert solution.record.duration == pytest.approx(2e-4)
    # The divider is that of the first position of the elements, which move on while the voltage rests.
    spread = np.ptp(solution.elements[0].capacitance) / solution.elements[0].mean_capacitance
    assert solution.record.peak == pytest.approx(200.0 * np.array(solution.divider), rel=1e-3 + spread)
    assert spread < 0.02
    assert len(solution.record.events) == 0


def test_the_spectrum_of_a_measured_square_wave_has_its_harmonics(case, square):
    """Four periods in 200 us: lines of 4/(pi n) of 200 V times the divider, and Parseval's equation."""
    strong = case.replace({"bearings.discharge.dielectric_strength": "190 V/um"})
    result = solve_drive(measured(strong, square), workers=1)
    table = result.spectrum()
    assert table.attrs["units"] == {"frequency": "Hz", "shaft_voltage": "V"}
    amplitude = table.set_index(table["frequency"].round())["shaft_voltage"]
    n = np.array([1, 3, 5, 7, 9])
    level = 200.0 * result.solution.divider[0]
    assert amplitude[20e3 * n].to_numpy() == pytest.approx(4.0 * level / (np.pi * n), rel=0.02)
    total = amplitude[0.0] ** 2 + 0.5 * np.sum(np.square(amplitude[1:]))
    summary = result.summary()
    assert np.sqrt(total) == pytest.approx(summary["drive_end"]["rms_voltage"], rel=2e-3)
    assert np.diff(table["frequency"]) == pytest.approx(1.0 / summary["drive"]["duration"])


@pytest.fixture
def square(tmp_path):
    """File of a square wave of 400 V from peak to peak that begins at its low level."""
    times = np.arange(2001) * 1e-7
    volts = np.where((np.arange(2001) // 250) % 2 == 0, -200.0, 200.0)
    rows = "".join(f"{t:.9e},{v:.6f}\n" for t, v in zip(times, volts, strict=True))
    (tmp_path / "scope.csv").write_text("time (s),voltage (V)\n" + rows)
    return tmp_path / "scope.csv"


def measured(case, path, **source):
    """Drive with the source of a file."""
    return DriveCase.from_dict({**case.to_dict(), "source": {"file": str(path), **source}})


def test_the_step_from_rest_to_a_measured_voltage_is_no_discharge(case, square):
    """The voltage lies there before the record begins: the first discharge is at its first edge."""
    weak = case.replace({"bearings.discharge.dielectric_strength": "20 V/um"})
    record = solve(measured(weak, square), workers=1).record
    assert np.sum(record.counts) >= 7
    assert np.min(record.events[:, ON]) == pytest.approx(25e-6, rel=0.01)


def test_a_resampled_source_is_judged_by_its_own_edges(case, square):
    """Eight samples of 100 ns are one of 800 ns: the warning tells the interval that is simulated."""
    told = solve(measured(case, square, resample="0.8 us"), workers=1).prior_warnings
    unresolved = [str(one) for one in told if one.code == "edges-unresolved"]
    assert len(unresolved) == 1
    assert " 8e-07 s" in unresolved[0]
    with pytest.raises(InputError, match=r"^source\.resample: .* 1e-08 s.* 1e-07 s"):
        solve(measured(case, square, resample="10 ns"), workers=1)


def test_extinction_above_breakdown_is_refused_at_the_key_that_is_given(case):
    for key, value in (("extinction_current", "20 A"), ("extinction_voltage", "200 V")):
        with pytest.raises(InputError, match="drive_end") as error:
            solve(case.replace({f"breakdown.{key}": value}), workers=1)
        assert error.value.key == f"breakdown.{key}"
    hotter = {"title": "hotter", "changes": {"breakdown.extinction_current": "20 A"}}
    with pytest.raises(InputError, match=r"^remedies\.1\.changes\.breakdown\.extinction_current: "):
        solve_drive(case.replace({"drive.duration": "0.1 ms"}, remedies=[hotter]), workers=1)


@pytest.mark.slow
def test_an_inductance_without_resistance_is_told(case):
    """5 mH and the 5.05 nF behind it, of winding and of winding and rotor in series."""
    quick = case.replace(
        {
            "circuit.common_mode_inductance": "5 mH",
            "circuit.winding_frame_capacitance": "5 nF",
            "drive.duration": "1 ms",
        }
    )
    told = [str(one) for one in solve_drive(quick, workers=1).warnings if one.code == "circuit-undamped"]
    assert len(told) == 1
    assert "31.7 kHz" in told[0]
    assert "above 10 000" in told[0]
    assert "circuit.common_mode_resistance" in told[0]
    damped = solve_drive(quick.replace({"circuit.common_mode_resistance": "100 ohm"}), workers=1)
    assert "circuit-undamped" not in [one.code for one in damped.warnings]


@pytest.mark.slow
def test_the_scatter_of_the_drive_file_is_before_that_of_the_bearing_file(case):
    """As a sweep over the shape asks for."""
    law = {"shape": 10.0, "reference_area": "1 mm^2", "scale": "20 V/um"}
    keys = {f"discharge.weibull.{key}": value for key, value in law.items()}
    bearing = case.drive_end.replace({**keys, "contacts": "solved"})
    result = solve_bearing(bearing, workers=2)
    for given, shape in ((None, 10.0), (5.0, 5.0)):
        breakdown = case.breakdown.model_copy(update={"weibull_shape": given})
        assert bearing_element(result, breakdown).shape == shape


def test_closed_films_conduct_as_those_of_the_netlist(case):
    """Mean over time of the conductance by asperities: that of the resistor in the circuit of the bearing."""
    slow = case.replace(
        {"drive.speed": "50 rpm", "bearings.bearing.contact_resistance": "1 ohm", "drive.duration": "1 ms"}
    )
    solution = solve(slow, workers=1)
    one = solution.elements[0]
    assert 0.0 < one.touching <= 1.0
    # Several elements are closed at a time, each with two contacts of 1 ohm.
    assert one.touch_resistance < 2.0
    mean = one.touching / one.touch_resistance
    equivalent = equivalent_of(solution.bearings[0].solution)
    assert equivalent.state == "metal"
    assert 1.0 / mean == pytest.approx(equivalent.resistance, rel=1e-9)


def test_time_with_a_burning_arc_is_that_of_the_discharges(case):
    """Up to those that burn at the begin and at the end."""
    weak = case.replace({"bearings.discharge.dielectric_strength": "5 V/um", "drive.duration": "3 ms"})
    record = solve(weak, workers=1).record
    for b in range(2):
        own = record.events[record.events[:, FILM] == b]
        lasting = own[:, OFF] - own[:, ON]
        assert len(own) > 10
        assert record.burning[b] == pytest.approx(np.sum(lasting), abs=2.0 * np.max(lasting))


def test_an_arc_that_never_recovers_is_told(case):
    """Edges feed it again before its film insulates: there are hardly any discharges to be counted."""
    weak = {"bearings.discharge.dielectric_strength": "5 V/um", "drive.duration": "3 ms"}
    result = solve_drive(case.replace({**weak, "breakdown.recovery_time": "1 ms"}), workers=1)
    shares = [result.summary()[end]["burning_time_share"] for end in ENDS]
    assert max(shares) == pytest.approx(1.0, abs=0.05)
    assert result.summary()["drive"]["events"] < 10
    assert "arc-burns-on" in [warning.code for warning in result.warnings]


def test_surfaces_that_touch_are_told_as_a_drive_takes_them(case):
    """It computes discharges of bearings that touch, where the bearing alone has no breakdown voltage."""
    changes = {"drive.speed": "50 rpm", "bearings.bearing.contact_resistance": "1 ohm"}
    ready = prepare(case.replace(changes), workers=1)
    told = {one.code: str(one) for one in ready.bearings[0].warnings}
    found = {one.code: str(one) for one in bearing_warnings(ready.bearings)}
    assert set(found) == set(told)
    assert found["touching"] != told["touching"]


@pytest.mark.slow
@pytest.mark.gate
@pytest.mark.parametrize(("rise", "together"), [("5 ns", True), ("100 ns", False)])
def test_fast_edges_discharge_both_ends_at_once(rise, together):
    """An arc of 10 ohm drains the 1 nF of the shaft in 10 ns: the other film is reached before, or never."""
    drive = small_drive(**{"source.rise_time": rise, "drive.temperature": "80 degC"})
    codes = {one.code for one in solve_drive(drive, workers=1).warnings}
    assert ("both-ends-discharge" in codes) is together


def test_the_progress_of_several_simulations_is_a_part_of_the_whole():
    """Two drives: the second begins at 50 %, and is half done at 75 %."""
    reported = []
    first, second = _parts(lambda done, of, text: reported.append((done, of, text)), 2)
    first(50, 100, "a")
    second(0, 100, "b")
    second(50, 100, "c")
    assert reported == [(25, 100, "a"), (50, 100, "b"), (75, 100, "c")]
