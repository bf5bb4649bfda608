"""Duty cycles: each row is the bearing alone at its inputs, shares follow from durations by hand, and what is
stored comes back."""

import json
from pathlib import Path

import numpy as np
import pytest

from ehlectric import load, solve_bearing
from ehlectric.bearing import duty_points
from ehlectric.bearing.cycle_rows import STATES
from ehlectric.bearing.duty_cycle import check_duty, run_duty
from ehlectric.bearing.duty_points import values_at
from ehlectric.bearing.many_points import solved_parts
from ehlectric.bearing.many_uncertainties import spreads_of
from ehlectric.bearing.margin_cycle import SAMPLES_OF_ROW
from ehlectric.bearing.run import solve_to_folder
from ehlectric.bearing.solution import lambda_ratio
from ehlectric.bearing.uncertainty import SEED, spread_of_result
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.cases.drive_case import DriveCase
from ehlectric.errors import InputError
from ehlectric.quantities.units import RPM
from ehlectric.sweep.engine import case_key
from tests.bearing.duty.wltc_duty import FILE, text, vehicle_speeds
from tests.helpers.bearings import BALLS
from tests.helpers.each import each
from tests.helpers.places import EXAMPLES

HEADS = "time [s],speed [rpm],radial load [N],temperature [degC],common-mode voltage [V]"

# Speed, load, temperature and voltage of rows that stand still, touch, have a partial and a full film.
ROWS = """\
0,0,1800,70,300
10,0.05,1800,70,300
20,40,1800,90,300
30,400,2500,80,250
40,-3000,1200,60,500
60,3000,1200,60,0
100,6000,900,40,300
"""


def case_of(folder, rows=ROWS, heads=HEADS, **tables):
    """Ball bearing with contacts by formula, and a cycle of rows."""
    (folder / "cycle.csv").write_text(f"{heads}\n{rows}")
    return BearingCase.from_dict(
        {**BALLS, "contacts": "formula", "duty": {"file": str(folder / "cycle.csv")}, **tables}
    )


@pytest.fixture(scope="module")
def case(tmp_path_factory):
    return case_of(tmp_path_factory.mktemp("cycle"))


@pytest.fixture(scope="module")
def duty(case):
    return run_duty(case)


def at_row(case, rows, k):
    """Bearing alone at the inputs of a row."""
    return solve_bearing(
        case.replace(
            {
                "bearing.inner_speed": abs(float(rows.speed[k])),
                "bearing.radial_load": float(rows.radial_load[k]),
                "bearing.temperature": float(rows.temperature[k]),
                "motor.common_mode_voltage": float(rows.common_mode_voltage[k]),
            }
        )
    )


@pytest.mark.slow
@pytest.mark.gate
def test_each_row_is_the_bearing_alone(case, duty):
    rows = duty.rows
    for k in (2, 3, 4, 6):
        alone = at_row(case, rows, k)
        assert rows.lambda_ratio[k] == pytest.approx(lambda_ratio(alone.solution), rel=1e-8)
        assert rows.capacitance[k] == pytest.approx(alone.capacitance(), rel=1e-8)
        expected = (alone.margin, alone.shaft_voltage, alone.breaks()["first_break"])
        for name, value in zip(("margin", "shaft_voltage", "first_break"), expected, strict=True):
            found = getattr(rows, name)[k]
            assert np.isnan(found) if value is None else found == pytest.approx(value, rel=1e-8)


@pytest.mark.slow
@pytest.mark.gate
def test_states_follow_from_speed_and_lambda_ratio(duty):
    states = [STATES[int(state)] for state in duty.rows.state]
    assert states[:3] == ["standstill", "standstill", "touching"]
    ratio = duty.rows.lambda_ratio[3:]
    assert (
        states[3:]
        == np.select([ratio < 1.0, ratio < 3.0], ["touching", "partial film"], "full film").tolist()
    )
    assert {"partial film", "full film"} <= set(states)


@pytest.mark.slow
@pytest.mark.gate
def test_shares_are_those_of_the_durations(duty):
    # Half of the intervals on both sides: 5, 10, 10, 10, 15, 30 and 20 s of 100 s.
    durations = np.array([5.0, 10.0, 10.0, 10.0, 15.0, 30.0, 20.0])
    assert duty.rows.duration.tolist() == durations.tolist()
    found = duty.summary()
    assert found["duration"] == 100.0
    assert found["standstill_share"] == pytest.approx(0.15)
    assert found["asperity_contact_share"] == pytest.approx(0.1)
    low = np.nan_to_num(duty.rows.margin, nan=np.inf) < 1.0
    assert found["low_margin_share"] == pytest.approx(durations[low].sum() / 100.0)
    names = ("standstill", "asperity_contact", "mixed_lubrication", "full_film", "left_out")
    assert sum(found[f"{name}_share"] for name in names) == pytest.approx(1.0)


@pytest.mark.slow
def test_the_probability_of_each_row_is_that_of_its_bearing(case, duty):
    """The probability of the cycle is their mean over the time. Touching rows have a probability, and rows
    with the inverter off have one of 0.
    """
    rows = duty.rows
    known = np.flatnonzero(np.isfinite(rows.breakdown_probability))
    assert known.tolist() == [2, 3, 4, 5, 6]
    assert rows.breakdown_probability[5] == 0.0
    for k in (2, 3, 4, 6):
        alone = at_row(case, rows, k)
        found = spread_of_result(alone.solution, SAMPLES_OF_ROW, SEED)
        assert rows.breakdown_probability[k] == pytest.approx(found.probability, abs=1e-9)
    parts = rows.breakdown_probability[known] * rows.duration[known]
    assert duty.summary()["breakdown_probability"] == pytest.approx(np.sum(parts) / 100.0)


@pytest.mark.slow
def test_probabilities_between_rows_are_near_those_of_more_samples():
    """32 rows of the WLTC with 128 samples each, against 60 other rows with 2048 samples of another seed."""
    case = BearingCase.from_toml(EXAMPLES / "duty_wltc.toml")
    rows = run_duty(case).rows
    drawn = np.random.default_rng(5).choice(np.flatnonzero(np.isfinite(rows.margin)), 60, replace=False)
    columns = {"inner_speed": "speed", "radial_load": "radial_load", "temperature": "temperature"}
    arrays = {f"bearing.{key}": getattr(rows, name)[drawn] for key, name in columns.items()}
    exact = np.empty(60)
    for part in solved_parts(case.with_arrays(arrays)):
        exact[part.points] = [one.probability for one in spreads_of(part.solution, 2048, 9)]
    off = rows.breakdown_probability[drawn] - exact
    assert abs(np.mean(off)) < 0.03
    assert np.std(off) < 0.05


def test_an_inverter_that_is_off_leaves_no_voltage(duty):
    assert duty.rows.shaft_voltage[5] == 0.0
    assert np.isnan(duty.rows.margin[5])
    assert duty.rows.lambda_ratio[5] == pytest.approx(duty.rows.lambda_ratio[4], rel=1e-12)


def test_an_inverter_of_almost_no_voltage_is_off(tmp_path):
    """The second voltage would give a margin of 1e8."""
    rows, heads = "0,3000,300\n1,3000,1e-6\n", "time [s],speed [rpm],common-mode voltage [V]"
    duty = run_duty(case_of(tmp_path, rows, heads))
    assert duty.rows.margin[0] < 10.0
    assert np.isnan(duty.rows.margin[1])
    assert duty.rows.lambda_ratio[1] == duty.rows.lambda_ratio[0]


@pytest.mark.slow
def test_a_load_along_the_axis_beside_others_across_it(tmp_path):
    """All balls carry one load in one of the rows, and in the other each carries its own."""
    rows, heads = "0,1000,300\n1,0,300\n2,0.2,300\n", "time [s],radial load [N],axial load [N]"
    case = case_of(tmp_path, rows, heads)
    rows = run_duty(case).rows
    for k in range(3):
        changes = {f"bearing.{name}": float(getattr(rows, name)[k]) for name in ("radial_load", "axial_load")}
        alone = solve_bearing(case.replace(changes))
        assert rows.capacitance[k] == pytest.approx(alone.capacitance(), rel=1e-8)
        assert rows.margin[k] == pytest.approx(alone.margin, rel=1e-8)
        assert rows.lambda_ratio[k] == pytest.approx(lambda_ratio(alone.solution), rel=1e-8)


@pytest.mark.slow
@pytest.mark.gate
def test_rings_keep_their_difference_from_the_oil(tmp_path):
    rows = "0,70\n1,90\n"
    bearing = BALLS["bearing"] | {"inner_ring_temperature": "85 degC"}
    case = case_of(tmp_path, rows, "time [s],temperature [degC]", bearing=bearing)
    warm = case.replace({"bearing.temperature": "90 degC", "bearing.inner_ring_temperature": "105 degC"})
    expected = [lambda_ratio(solve_bearing(one).solution) for one in (case, warm)]
    assert run_duty(case).rows.lambda_ratio == pytest.approx(expected, rel=1e-8)


def test_a_stretch_lies_between_the_rows_around_it(tmp_path):
    speeds = [6000, 6000, 900, 700, 900, 6000, 6000]
    rows = "".join(f"{10 * k},{speed}\n" for k, speed in enumerate(speeds))
    case = case_of(tmp_path, rows, "time [s],speed [rpm]", motor=None)
    duty = run_duty(case)
    (stretch,) = duty.stretches
    assert (stretch.start, stretch.end, stretch.time) == (15.0, 45.0, 30.0)
    assert stretch.least_margin is None
    assert stretch.lambda_ratio == duty.rows.lambda_ratio.min() < 3.0
    assert stretch.why.startswith("at speed 700 rpm (")


@pytest.mark.slow
@pytest.mark.gate
def test_the_reason_of_a_stretch_is_the_input_that_raises_the_margin(tmp_path):
    # The speed hardly changes, and the voltage is ten times its usual value for a while.
    volts = [60, 60, 60, 600, 60, 60]
    rows = "".join(f"{k},{3000 + k},{volt}\n" for k, volt in enumerate(volts))
    case = case_of(tmp_path, rows, "time [s],speed [rpm],common-mode voltage [V]")
    (stretch,) = run_duty(case).stretches
    assert (stretch.start, stretch.end) == (2.5, 3.5)
    assert stretch.least_margin < 1.0
    assert stretch.why.startswith("at common-mode voltage 600 V (")


@pytest.mark.slow
@pytest.mark.gate
def test_at_most_ten_stretches_the_worst_first(tmp_path):
    speeds = np.where(np.arange(40) % 3 == 1, 500.0 + np.arange(40), 6000.0)
    rows = "".join(f"{k},{speed}\n" for k, speed in enumerate(speeds))
    duty = run_duty(case_of(tmp_path, rows, "time [s],speed [rpm]", motor=None))
    worst = [stretch.lambda_ratio for stretch in duty.stretches]
    assert len(worst) == 10
    assert worst == sorted(worst)
    assert worst[0] == np.min(duty.rows.lambda_ratio)


@pytest.mark.slow
@pytest.mark.gate
def test_equal_points_are_computed_once(tmp_path):
    rows = "".join(f"{k},{1000 * (k % 3)}\n" for k in range(30))
    assert run_duty(case_of(tmp_path, rows, "time [s],speed [rpm]")).points == 2


@pytest.mark.slow
def test_interpolation_holds_its_error(case, monkeypatch):
    rng = np.random.default_rng(5)
    speed, load = 2.0 * np.pi * rng.uniform(10.0, 100.0, 900), rng.uniform(500.0, 3000.0, 900)
    inputs = {"bearing.inner_speed": speed, "bearing.radial_load": load}
    exact = values_at(case, inputs)
    monkeypatch.setattr(duty_points, "MOST_SOLVED", 500)
    found = values_at(case, inputs)
    assert exact.error is None
    assert found.solved <= 500
    assert 0.0 < found.error < 0.02
    for name in ("lambda_ratio", "margin"):
        error = np.abs(found.values[name] / exact.values[name] - 1.0)
        # 256 of the 900 points were compared.
        assert np.nanmax(error) < 3.0 * found.error


REFUSED = [
    ("1,3000\n0,3000\n", "time [s],speed [rpm]", "line 3"),
    ("0,3000\n", "time [s],speed [rpm]", "one row"),
    ("3000\n3000\n", "speed [rpm]", "time"),
    ("0\n1\n", "time [s]", "no column but the time"),
    ("0,3000,100\n1,3000,0\n", "time [s],speed [rpm],radial load [N]", "line 3"),
    ("0,3000\n1,-3e9\n", "time [s],speed [rpm]", "line 3"),
    ("0,3000\n1,3000\n", "time [s],speed", "has no unit"),
    ("0,3000\n1,3000\n", "time [s],speed [m/s]", "rpm"),
    ("0,100\n1,80\n", "time [s],speed [%]", "column 'speed [%]': has the unit '%'"),
    ("0,100\n1,80\n", "time [s],radial load [%]", "values in N"),
]


@each("rows, heads, part", REFUSED)
def test_wrong_cycles_are_refused(rows, heads, part, tmp_path):
    bearing = BALLS["bearing"] | {"axial_load": 0.0}
    case = case_of(tmp_path, rows, heads, bearing=bearing)
    with pytest.raises(InputError) as error:
        check_duty(case)
    assert "cycle.csv" in str(error.value)
    assert part in str(error.value)


def test_a_voltage_needs_a_motor(tmp_path):
    case = case_of(tmp_path, "0,100\n1,100\n", "time [s],common-mode voltage [V]", motor=None)
    with pytest.raises(InputError, match=r"expected \[motor\]"):
        run_duty(case)


def test_a_strength_that_needs_solved_contacts_leaves_no_margin(tmp_path):
    discharge = {"weibull": {"scale": "15 V/um", "shape": 10, "reference_area": "1 mm^2"}}
    case = case_of(
        tmp_path, "0,3000\n1,2000\n", "time [s],speed [rpm]", discharge=discharge, contacts="solved"
    )
    duty = run_duty(case)
    assert [warning.code for warning in duty.warnings] == ["duty-without-margin"]
    assert duty.summary()["low_margin_share"] is None
    assert duty.contacts == "atlas"


def test_a_cycle_at_a_standstill(tmp_path):
    duty = run_duty(case_of(tmp_path, "0,0\n1,0\n", "time [s],speed [rpm]"))
    assert duty.summary()["standstill_share"] == 1.0
    assert duty.points == 0
    assert duty.stretches == ()
    assert duty.summary()["least_margin"] is None


def test_ceramic_elements_have_states_and_no_margin(tmp_path):
    bearing = BALLS["bearing"] | {"element_material": "silicon-nitride"}
    case = case_of(tmp_path, "0,3000\n1,200\n", "time [s],speed [rpm]", bearing=bearing)
    found = run_duty(case).summary()
    assert found["low_margin_share"] is None
    assert found["left_out_share"] == 0.0


@pytest.mark.slow
def test_files_of_a_cycle(case, duty, tmp_path):
    outcome = solve_to_folder(case, tmp_path / "out")
    summary = json.loads((tmp_path / "out" / "summary.json").read_text())
    # The file also contains former keys.
    assert {key: summary["duty"][key] for key in duty.summary()} == json.loads(json.dumps(duty.summary()))
    assert 0.0 < summary["duty"]["breakdown_probability"] < 1.0
    lines = (tmp_path / "out" / "duty.csv").read_text().splitlines()
    assert lines[0].startswith("time [s],duration [s],speed [rad/s],radial_load [N]")
    assert lines[1].endswith(",standstill")
    assert len(lines) == 8
    Path(case.duty.file).rename(tmp_path / "moved.csv")
    try:
        again = load(tmp_path / "out")
        assert again.duty == outcome.result.duty == duty
    finally:
        (tmp_path / "moved.csv").rename(case.duty.file)


@pytest.mark.slow
@pytest.mark.gate
def test_a_bearing_without_a_cycle_has_no_table():
    result = solve_bearing(BearingCase.from_dict({**BALLS, "contacts": "formula"}))
    assert result.duty is None
    assert "duty" not in result.summary()


def test_names_of_files_are_relative_to_the_bearing_file(case, tmp_path):
    (tmp_path / "bearing.toml").write_text(case.replace({"duty.file": "a/cycle.csv"}).to_toml())
    assert BearingCase.from_toml(tmp_path / "bearing.toml").duty.file == str(tmp_path / "a" / "cycle.csv")


def test_sweeps_and_drives_leave_the_cycle_out(case):
    assert case_key(case) == case_key(case.model_copy(update={"duty": None}))
    drive = DriveCase.from_toml(EXAMPLES / "drive.toml")
    with_duty = drive.model_copy(update={"drive_end": case, "non_drive_end": case})
    assert [one.duty for one in with_duty.bearings] == [None, None]


def test_the_example_is_the_wltc_of_class_3b():
    # UN Global Technical Regulation No. 15: 1800 s, 23266 m, 131.3 km/h; stops of 235 rows.
    speeds = vehicle_speeds()
    assert speeds.size == 1801
    assert speeds.max() == 131.3
    assert np.sum(speeds) / 3.6 == pytest.approx(23266.0, abs=1.0)
    assert np.count_nonzero(speeds == 0.0) == 235
    assert FILE.read_text(encoding="utf-8") == text(speeds)


@pytest.mark.slow
def test_the_example_over_its_cycle():
    case = BearingCase.from_toml(EXAMPLES / "duty_wltc.toml")
    duty = run_duty(case)
    rows = duty.rows
    # The motor turns 9 times as fast as wheels of 0.317 m.
    assert rows.speed.max() == pytest.approx(131.3 / 3.6 / 0.317 * 9.0, abs=0.1 * RPM)
    assert duty.summary()["standstill_share"] == pytest.approx(234.0 / 1800.0, abs=0.001)
    assert duty.points < 1801
    assert duty.interpolation_error is None
    assert len(duty.stretches) == 10
