"""Duty cycles of gear pairs: each row is the mesh alone at its inputs, shares and energies follow from
durations by hand, and what is stored comes back."""

import json
import math

import numpy as np
import pytest

from ehlectric import GearCase, load, save, solve_gear
from ehlectric.bearing import SAMPLES_OF_ROW, duty_points
from ehlectric.errors import InputError
from ehlectric.gear.mesh_duty import run_mesh_duty
from ehlectric.gear.uncertainty import uncertainty_of
from ehlectric.quantities.units import RPM
from ehlectric.runs.preview import preview_of
from tests.helpers.places import EXAMPLES

HEADS = "time [s],speed [rpm],torque [N m],temperature [degC],voltage [V]"

# Standstill; conducting; driving, coasting and backing up with thick films; inverter off; no torque.
ROWS = """\
0,0,50,60,5
10,50,120,80,5
20,9000,20,50,5
30,9000,-20,50,5
40,-9000,-20,50,5
60,12000,30,70,0
100,6000,0,70,5
"""
# Half of the intervals on both sides.
DURATIONS = np.array([5.0, 10.0, 10.0, 10.0, 15.0, 30.0, 20.0])


def case_of(folder, rows=ROWS, heads=HEADS, changes=None):
    """Helical pair of the examples with a cycle of rows."""
    (folder / "cycle.csv").write_text(f"{heads}\n{rows}")
    case = GearCase.from_toml(EXAMPLES / "gear_pair.toml")
    return case.replace({"duty.file": str(folder / "cycle.csv"), **(changes or {})})


@pytest.fixture(scope="module")
def case(tmp_path_factory):
    return case_of(tmp_path_factory.mktemp("cycle"))


@pytest.fixture(scope="module")
def duty(case):
    return run_mesh_duty(case)


def at_row(case, rows, k):
    """Gear pair alone at the inputs of a row; its flanks are 5 K warmer than the oil."""
    torque, speed = float(rows.torque[k]), float(rows.speed[k])
    changes = {
        "pinion_torque": math.copysign(torque, torque * speed),
        "pinion_speed": abs(speed),
        "oil_temperature": float(rows.temperature[k]),
        "bulk_temperature": float(rows.temperature[k]) + 5.0,
    }
    alone = case.model_copy(update={"duty": None})
    return solve_gear(alone.replace({f"gear.operation.{key}": value for key, value in changes.items()}))


def test_each_row_is_the_gear_pair_alone(case, duty):
    rows = duty.rows
    for k in range(1, 6):
        alone = at_row(case, rows, k)
        summary = alone.summary() if k == 1 else None
        mesh = alone.solution
        assert rows.lambda_ratio[k] == pytest.approx(mesh.films.minimum[mesh.thinnest] / mesh.rq, rel=1e-7)
        assert rows.capacitance[k] == pytest.approx(mesh.loads.mean(mesh.capacitance), rel=1e-7)
        assert rows.loss[k] == pytest.approx(0.03 * mesh.sliding_power, rel=1e-7)
        share = mesh.loads.mean(mesh.contact_time_share())
        assert rows.contact_time_share[k] == pytest.approx(share, rel=1e-6, abs=1e-15)
        if summary is not None:
            assert summary["mesh"]["state"] == "conducts"
            assert np.isnan(rows.breakdown_voltage[k])
        else:
            least = float(np.min(mesh.breakdown_voltage))
            assert rows.breakdown_voltage[k] == pytest.approx(least, rel=1e-7)
        expected = None if k == 5 else alone.margin
        assert np.isnan(rows.margin[k]) if expected is None else rows.margin[k] == pytest.approx(expected)


def test_a_film_does_not_depend_on_the_gear_that_drives(case, duty):
    """Coasting loads the other flanks, which are equal; ``gear`` says the same of the sign of its torque."""
    rows = duty.rows
    assert rows.lambda_ratio[2] == rows.lambda_ratio[3] == rows.lambda_ratio[4]
    alone = case.model_copy(update={"duty": None})
    ratios = [
        solve_gear(alone.replace({"gear.operation.pinion_torque": torque}), probable=False).summary()["mesh"]
        for torque in (20.0, -20.0)
    ]
    assert ratios[0] == ratios[1]


def test_shares_and_energies_are_those_of_the_durations(duty):
    found, rows = duty.summary(), duty.rows
    assert rows.duration.tolist() == DURATIONS.tolist()
    assert found["standstill_share"] == pytest.approx(0.05)
    assert found["conducting_share"] == pytest.approx(0.1)
    assert found["left_out_share"] == pytest.approx(0.2)
    names = ("standstill", "conducting", "conducting_at_times", "insulating", "left_out")
    assert sum(found[f"{name}_share"] for name in names) == pytest.approx(1.0)
    speed = np.array([0.0, 50.0, 9000.0, 9000.0, 9000.0, 12000.0, 6000.0]) * RPM
    torque = np.array([50.0, 120.0, 20.0, 20.0, 20.0, 30.0, 0.0])
    assert found["energy"] == pytest.approx(float(np.sum(speed * torque * DURATIONS)))
    known = np.isfinite(rows.loss)
    assert found["loss_energy"] == pytest.approx(float(rows.loss[known] @ DURATIONS[known]))
    assert found["loss_share"] == pytest.approx(found["loss_energy"] / found["energy"])
    # Summits touch in the row with the inverter off.
    volts = rows.breakdown_voltage[2:5]
    assert rows.breakdown_voltage[5] == 0.0
    assert found["breakdown_voltage_mean"] == pytest.approx(float(np.average(volts, weights=DURATIONS[2:5])))
    worst = int(np.nanargmin(rows.margin))
    assert found["deciding_time"] == rows.time[worst]
    assert found["deciding_torque"] == rows.torque[worst]


def test_a_row_whose_summits_touch_decides(tmp_path):
    """At 30 N m summits touch and have no margin; at 0.05 N m the film is thick."""
    duty = run_mesh_duty(case_of(tmp_path, "0,3000,30,80,5\n10,3000,0.05,80,5\n", HEADS), probable=False)
    found = duty.summary()
    assert duty.rows.touching.tolist() == [True, False]
    assert (found["deciding_time"], found["deciding_torque"]) == (0.0, 30.0)
    assert found["least_margin"] > 5.0


def test_a_cycle_without_any_result_says_so(tmp_path):
    duty = run_mesh_duty(case_of(tmp_path, "0,3000,0,80,5\n10,3000,0,80,5\n", HEADS), probable=False)
    assert duty.statement.code == "cycle-not-computed"


def test_a_row_without_torque_is_left_out_with_its_line(duty):
    (warning,) = (each for each in duty.warnings if each.code == "duty-left-out")
    assert "Line 8" in str(warning)
    assert "pinion_torque" in str(warning)


def test_the_probability_of_each_row_is_that_of_its_mesh(case, duty):
    rows = duty.rows
    assert rows.breakdown_probability[1] == 0.0  # it conducts
    assert rows.breakdown_probability[5] == 0.0  # the inverter is off
    assert np.isnan(rows.breakdown_probability[[0, 6]]).all()
    for k in (2, 3):
        alone = uncertainty_of(at_row(case, rows, k).solution, samples=SAMPLES_OF_ROW)
        assert rows.breakdown_probability[k] == pytest.approx(alone.probability, abs=1e-9)
    # The row without a result gives bounds of the mean.
    found = duty.summary()
    assert found["breakdown_probability_high"] - found["breakdown_probability_low"] == pytest.approx(0.2)


def test_interpolated_points_are_near_solved_ones(tmp_path, monkeypatch):
    """600 rows of driving and coasting; V_b follows from the lambda ratio in closed form."""
    time = np.arange(600.0)
    speed, torque = 6000.0 + 3000.0 * np.sin(0.02 * time), 60.0 * np.sin(0.013 * time) + 3.0
    lines = zip(time, speed, torque, 60.0 + 0.02 * time, strict=True)
    rows = "".join(f"{t:.0f},{n:.1f},{m:.2f},{c:.2f}\n" for t, n, m, c in lines)
    long = case_of(tmp_path, rows, "time [s],speed [rpm],torque [N m],temperature [degC]")
    exact = run_mesh_duty(long, probable=False)
    monkeypatch.setattr(duty_points, "MOST_SOLVED", 500)
    monkeypatch.setattr(duty_points, "_COMPARED", 40)
    found = run_mesh_duty(long, probable=False)
    assert found.points != exact.points
    assert found.interpolation_error < 0.05
    assert np.nanmax(np.abs(found.rows.lambda_ratio / exact.rows.lambda_ratio - 1.0)) < 0.05
    strength, gear = 15e6, long.gear
    height = np.maximum(found.rows.lambda_ratio - gear.summit_height, 0.0) * gear.rq
    conducts = np.isnan(found.rows.breakdown_voltage)
    volts = np.where(conducts, np.nan, strength * height)
    assert found.rows.breakdown_voltage == pytest.approx(volts, rel=1e-7, abs=1e-12, nan_ok=True)
    assert np.mean(found.rows.state == exact.rows.state) > 0.97


def test_files_of_a_cycle(case, tmp_path):
    result = solve_gear(case)
    files = save(result, tmp_path)
    assert "duty.csv" in [file.name for file in files]
    again = load(tmp_path)
    assert again.stored_duty == result.duty
    assert again.summary() == result.summary()
    heads, *lines = (tmp_path / "duty.csv").read_text("utf-8").splitlines()
    assert heads.startswith("time [s],duration [s],torque [N m],speed [rad/s]")
    assert heads.endswith(",mesh_state")
    assert [line.rpartition(",")[2] for line in lines[:2]] == ["standstill", "conducts"]
    assert len(lines) == 7
    # Summits that touch have no breakdown voltage, in the file as in the table.
    column = [line.split(",")[heads.split(",").index("breakdown_voltage [V]")] for line in lines]
    touching = (result.duty.rows.breakdown_voltage == 0.0).tolist()
    assert any(touching)
    assert [text == "" for text, touches in zip(column, touching, strict=True) if touches] == [True] * sum(
        touching
    )
    assert all(float(text) > 0.0 for text in column if text)
    table = json.loads((tmp_path / "summary.json").read_text("utf-8"))["duty"]
    assert table["rows"] == 7


def test_the_flanks_may_have_a_column(tmp_path):
    """A column for the flanks replaces the difference from the oil."""
    rows = "0,9000,20,55\n10,9000,20,75\n"
    heads = "time [s],speed [rpm],torque [N m],flank temperature [degC]"
    found = run_mesh_duty(case_of(tmp_path, rows, heads), probable=False).rows
    by_oil = case_of(tmp_path, rows.replace(",55", ",50").replace(",75", ",70"), HEADS.rpartition(",")[0])
    expected = run_mesh_duty(by_oil, probable=False).rows
    assert found.lambda_ratio.tolist() == pytest.approx(expected.lambda_ratio.tolist(), rel=1e-7)
    assert found.flank_temperature.tolist() == [328.15, 348.15]


def test_check_reads_the_file_and_computes_no_cycle(case, tmp_path):
    shown = preview_of(case)
    assert "duty cycle" in [row.name for row in shown.rows]
    assert "duty" not in shown.summary
    with pytest.raises(InputError, match="time"):
        preview_of(case_of(tmp_path, "9000,5\n9000,6\n", "speed [rpm],torque [N m]"))
