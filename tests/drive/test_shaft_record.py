"""Records of the shaft voltage: closed forms, and records of the simulation with known discharges."""

import math

import numpy as np
import pandas as pd
import pytest

from ehlectric import DriveCase, InputError, solve_drive
from ehlectric.cases.measured_inputs import ShaftFile
from ehlectric.drive.drive_record import ON, VOLTAGE
from ehlectric.drive.shaft_record import _half_sample_mode, measured_shaft, shaft_record
from tests.helpers.places import EXAMPLES

STEP = 1e-7
TIME = STEP * np.arange(100_000)
SINE = 10.0 * np.sin(2.0 * math.pi * 1e3 * TIME)


def dropped(places):
    """Sine of 10 V that falls to 0 V at once at some samples, and goes on from there."""
    offset = np.zeros_like(SINE)
    for place in places:
        offset[place:] = SINE[place]
    return SINE - offset


@pytest.mark.parametrize("noise", [0.0, 0.05])
def test_a_sine_without_discharges(noise):
    values = SINE + np.random.default_rng(1).normal(0.0, noise, SINE.size) if noise else SINE
    record = shaft_record(values, STEP, gain=0.02)
    assert record.times.size == 0
    assert record.peak.value == pytest.approx(10.0, abs=3.0 * noise + 1e-5)
    assert record.peak.uncertainty == pytest.approx(math.hypot(0.2, noise), rel=0.05)
    assert record.rms.value == pytest.approx(10.0 / math.sqrt(2.0), rel=1e-3)
    # The upper bound of 95 % of no event in a time T is -ln(0.025)/T.
    assert record.rate.value == 0.0
    assert record.rate.uncertainty == pytest.approx(-math.log(0.025) / (2.0 * 1.96 * 0.01), rel=1e-6)
    assert record.breakdown is None


@pytest.mark.parametrize("noise", [0.0, 0.05])
def test_a_sine_that_falls_at_known_times(noise):
    """Between two falls the voltage is the change of the sine since the first one."""
    rng = np.random.default_rng(2)
    places = np.sort(2500 + 5000 * np.arange(19) + rng.integers(-800, 800, 19))
    before = np.abs(dropped([])[places] - np.append([0.0], SINE[places[:-1]]))
    values = dropped(places) + (rng.normal(0.0, noise, SINE.size) if noise else 0.0)
    record = shaft_record(values, STEP)
    np.testing.assert_allclose(record.times, STEP * places, atol=2.5 * STEP)
    np.testing.assert_allclose(record.voltages, before, atol=0.01 + 4.0 * noise)
    assert record.rate.value == pytest.approx(19 / 0.01)
    assert record.rate.uncertainty >= 0.9 * math.sqrt(19.0) / 0.01
    assert record.breakdown.value == pytest.approx(np.quantile(before, 1.0 - math.exp(-1.0)), rel=0.03)
    assert record.peak is None


def test_edges_are_no_discharges():
    """A shaft voltage that follows the common-mode voltage, also back to zero, has no discharge."""
    levels = np.tile([0.0, 1.0, 2.0, 3.0, 2.0, 1.0], 50)
    times = np.arange(0.0, 300e-6, 1e-8)
    common_mode = np.interp(
        times, np.ravel([[k * 1e-6, k * 1e-6 + 0.9e-6] for k in range(300)]), levels.repeat(2)
    )
    noise = np.random.default_rng(3).normal(0.0, 0.01, times.size)
    record = shaft_record(5.0 * common_mode + noise, 1e-8, 100.0 * common_mode, gain=0.01)
    assert record.times.size == 0
    assert record.ratio.value == pytest.approx(0.05, rel=5e-3)
    assert record.ratio.uncertainty >= math.sqrt(2.0) * 0.01 * 0.05
    assert "shaft_voltage" not in record.measured()
    assert record.peak.value == pytest.approx(15.0, rel=5e-3)
    assert shaft_record(5.0 * common_mode + noise, 1e-8).times.size == 0


def test_samples_that_are_too_slow_give_no_number_of_discharges():
    """Edges within one sample look like discharges."""
    steps = np.random.default_rng(4).choice([-1.0, 0.0, 1.0], 400).repeat(10) * 8.0
    record = shaft_record(steps, 1e-6)
    assert record.slow
    assert record.rate is None
    assert record.breakdown is None
    assert list(record.measured()) == ["shaft_voltage_rms"]


def inverter(step, samples):
    """Common-mode voltage of an inverter with edges of 250 ns [V]."""
    times = step * np.arange(samples)
    carrier = 2.0 * np.abs(2.0 * ((times * 40e3) % 1.0) - 1.0) - 1.0
    phases = [0.9 * np.cos(2.0 * math.pi * (100.0 * times - k / 3.0) + 0.3) for k in range(3)]
    middle = 0.5 * (np.max(phases, axis=0) + np.min(phases, axis=0))
    legs = sum(np.where(phase - middle > carrier, 280.0, -280.0) for phase in phases) / 3.0
    return np.convolve(np.append(np.full(4, legs[0]), legs), np.full(5, 0.2), "valid")


@pytest.fixture(scope="module", params=["25 V/um", "60 V/um"])
def simulated(request, tmp_path_factory):
    """Drive with a ceramic bearing at one end, at which only the other one discharges, over 200 us."""
    path = tmp_path_factory.mktemp("scope") / "common_mode.csv"
    rows = (f"{5e-8 * k:.8f},{volts:.3f}" for k, volts in enumerate(inverter(5e-8, 4000)))
    path.write_text("time [s],voltage [V]\n" + "\n".join(rows) + "\n", "utf-8")
    table = DriveCase.from_toml(EXAMPLES / "drive.toml").to_dict()
    table["drive"] = {"speed": table["drive"]["speed"], "contacts": "formula", "seed": 3}
    case = DriveCase.from_dict({**table, "source": {"file": str(path)}, "remedies": []}).replace(
        {
            "drive_end.discharge.dielectric_strength": request.param,
            "non_drive_end.bearing.element_material": "silicon-nitride",
            "non_drive_end.bearing.element_capacitance": "5 pF",
        }
    )
    return solve_drive(case, workers=1)


@pytest.mark.slow
@pytest.mark.parametrize("step", [4e-9, 1e-8, 4e-8])
def test_discharges_of_a_simulated_drive_are_counted(simulated, step):
    """The record has 8 bits and noise; the simulation states the discharges and the divider."""
    record, rng = simulated.solution.record, np.random.default_rng(5)
    trace, (divider, _) = record.trace, simulated.solution.divider
    times = np.arange(trace[0, 0], trace[-1, 0], step)
    source, shaft = (np.interp(times, trace[:, 0], trace[:, column]) for column in (1, 2))
    shaft = np.round((shaft + rng.normal(0.0, 0.03, times.size)) / 0.1) * 0.1
    source = np.round((source + rng.normal(0.0, 1.5, times.size)) / 4.0) * 4.0
    found = shaft_record(shaft, step, source, gain=0.0)
    events = record.events[(record.events[:, ON] > times[0]) & (record.events[:, ON] < times[-1])]
    voltages = np.abs(events[:, VOLTAGE])
    assert voltages.size >= 15
    assert found.times.size == np.count_nonzero(voltages > found.threshold)
    assert found.ratio.value == pytest.approx(divider, abs=2.0 * found.ratio.uncertainty)
    assert found.ratio.uncertainty < 0.04 * divider
    turned = shaft_record(-shaft, step, source, gain=0.0)
    assert (found.inverted, turned.inverted) == (False, True)
    assert turned.times.tolist() == found.times.tolist()
    exact = np.quantile(voltages, 1.0 - math.exp(-1.0))
    assert found.breakdown.value == pytest.approx(exact, abs=2.0 * found.breakdown.uncertainty)


@pytest.mark.parametrize("noise", [0.2, 0.7, 1.5])
def test_a_ratio_is_that_of_the_record_or_none_under_noise(noise):
    """0.0405 without noise; edges change the voltage by 7.6 V. No correct probe is called inverted."""
    path = EXAMPLES / "measurements" / "shaft_voltage.csv"
    time, source, shaft = pd.read_csv(path, skiprows=3, names=["time", "CH1", "CH2"]).to_numpy().T
    for seed in range(6):
        noisy = shaft + np.random.default_rng(seed).normal(0.0, noise, shaft.size)
        found, turned = (shaft_record(sign * noisy, time[1] - time[0], source) for sign in (1.0, -1.0))
        assert (found.inverted, found.ratio is None) == (False, noise > 0.5)
        if found.ratio is not None:
            assert found.ratio.value == pytest.approx(0.0405, abs=found.ratio.uncertainty)
            assert turned.inverted


@pytest.mark.parametrize("column", ["CH1", "CH2"])
def test_an_inverted_probe_is_turned(tmp_path, column):
    """With either probe inverted, all quantities are those of the record with correct probes."""
    path = EXAMPLES / "measurements" / "shaft_voltage.csv"
    table = pd.read_csv(path, skiprows=3, names=["time (s)", "CH1", "CH2"], dtype={"time (s)": str})
    table[column] *= -1.0
    table.rename(columns={"CH1": "CH1 (V)", "CH2": "CH2 (V)"}).to_csv(tmp_path / "inverted.csv", index=False)
    (known, notes), (found, warnings) = (
        measured_shaft(ShaftFile(file=str(file), column="CH2", common_mode_column="CH1"))
        for file in (path, tmp_path / "inverted.csv")
    )
    assert {name: one.value for name, one in found.items()} == pytest.approx(
        {name: one.value for name, one in known.items()}
    )
    (note,) = [one.text for one in warnings if "wrong way round" in one.text]
    assert f"ratio -{known['bearing_voltage_ratio'].value:.3g} " in note
    assert len(warnings) == len(notes) + 1


def test_wrong_columns_and_files_are_named(tmp_path):
    path = EXAMPLES / "measurements" / "shaft_voltage.csv"
    with pytest.raises(InputError, match=r"^measured\.shaft_record\.column: missing.*CH1.*CH2"):
        measured_shaft(ShaftFile(file=str(path)))
    with pytest.raises(InputError, match=r"^measured\.shaft_record\.file"):
        measured_shaft(ShaftFile(file=str(tmp_path / "none.csv")))
    with pytest.raises(InputError, match="common_mode"):
        shaft_record(SINE, STEP, SINE[1:])


def test_the_mode_is_the_middle_of_the_densest_half_of_the_densest_half():
    """By hand: of seven values the four from 5 to 8.1, of these the two 5 and 6, whose mean is 5.5."""
    assert _half_sample_mode(np.array([0.0, 0.5, 5.0, 6.0, 7.0, 8.1, 9.3])) == 5.5
    assert _half_sample_mode(np.array([0.0, 1.0, 4.0, 4.5, 9.0])) == 4.25
