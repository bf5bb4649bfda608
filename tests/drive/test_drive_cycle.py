"""Duty cycle of a drive: expected discharges over time against sums over all rows, limits by hand, files."""

import json
from types import SimpleNamespace
from unittest import mock

import numpy as np
import pytest

from ehlectric import DriveCase, figure_names, load, solve_drive
from ehlectric import figure as draw
from ehlectric.cases.duty_inputs import read_cycle
from ehlectric.drive.drive_cycle import MOST_TIME, SIMULATED, run_drive_cycle
from ehlectric.drive.drive_record import COLUMNS, ENERGY
from ehlectric.drive.run import save
from ehlectric.drive.solver import solve
from ehlectric.errors import InputError
from ehlectric.quantities.inputs import ENDS
from ehlectric.quantities.results import DRIVE_KEYS
from ehlectric.quantities.units import RPM
from ehlectric.readable import readable
from ehlectric.tables.drive_tables import drive_rows
from tests.helpers.drives import small_drive
from tests.helpers.titles import title_of

PEAK = 280.0  # of the source of the example [V]

# A start, a stretch of rising speed and a stop.
SPEEDS = [0.0, *np.linspace(1500.0, 4500.0, 57), 3000.0, 0.0]


def cycle_of(folder, speeds=SPEEDS, head="time [s],speed [rpm]", *columns):
    file = folder / "cycle.csv"
    rows = zip(range(len(speeds)), speeds, *columns, strict=True)
    file.write_text("\n".join([head, *(",".join(map(str, row)) for row in rows)]) + "\n")
    return small_drive(**{"bearings.bearing.contact_resistance": "10 ohm"}).replace(duty={"file": str(file)})


def as_record(case, rates, powers):
    """Simulation with given numbers of discharges [1/s] and powers [W] of both bearings."""
    counts = np.round(np.array(rates) * case.drive.duration)[:, np.newaxis]
    sums = np.zeros((2, COLUMNS))
    sums[:, ENERGY] = np.array(powers) * case.drive.duration
    return SimpleNamespace(record=SimpleNamespace(counts=counts, sums=sums, duration=case.drive.duration))


def by_speed(case):
    """Smooth law in place of a simulation: 1e5 discharges a second at 1000 rpm, falling with the speed."""
    rate = 1e5 * (1000.0 * RPM / case.drive.speed) ** 2
    return as_record(case, [rate, 2.0 * rate], [1e-8 * rate, 3e-8 * rate])


@pytest.mark.slow
def test_both_bearings_have_a_life_of_the_cycle(tmp_path):
    """Rows at one load: the basic life is the life at the mean speed. The ends differ in their ratings."""
    case = cycle_of(tmp_path)
    ratings = dict(zip(ENDS, (20e3, 40e3), strict=True))
    lives = {
        f"{end}.bearing.life": {"contamination_factor": 0.5, "dynamic_rating": rating}
        for end, rating in ratings.items()
    }
    loads = {"bearings.bearing.radial_load": 1000.0, "bearings.bearing.axial_load": 0.0}
    duty = run_drive_cycle(case.replace(lives | loads), PEAK, by_speed)
    time = np.full(len(SPEEDS), 1.0)
    time[[0, -1]] = 0.5
    turns = float(time @ np.array(SPEEDS)) / 60.0 / float(np.sum(time))
    for b, rating in enumerate(ratings.values()):
        found = duty.end_summary(b)
        assert found["duty_basic_life"] == pytest.approx((rating / 1000.0) ** 3 * 1e6 / turns, rel=1e-9)
        assert found["duty_mean_speed"] == pytest.approx(2.0 * np.pi * turns, rel=1e-9)
        assert found["duty_reference_modified_life"] is not None


@pytest.mark.slow
@pytest.mark.gate
def test_sums_are_those_of_a_law_that_is_known(tmp_path):
    """The sum over the rows by hand is within the stated interval, which is narrow for a smooth law."""
    duty = run_drive_cycle(cycle_of(tmp_path), PEAK, by_speed)
    time = np.full(len(SPEEDS), 1.0)
    time[[0, -1]] = 0.5
    turns = np.array(SPEEDS) > 0.0
    exact = float(np.sum(time[turns] * 1e5 * (1000.0 / np.array(SPEEDS)[turns]) ** 2))
    for factor, found in zip((1.0, 2.0), duty.discharges, strict=True):
        assert found.low < factor * exact < found.high
        assert found.high - found.low < 0.02 * factor * exact
        assert found.value == pytest.approx(factor * exact, rel=1e-2)
    assert [one.value for one in duty.energy] == pytest.approx([1e-8 * exact, 3e-8 * exact], rel=1e-2)
    assert duty.points == SIMULATED


@pytest.mark.slow
def test_interval_covers_a_law_with_noise(tmp_path):
    """The interval of 95 % misses the sum for at most three of ten seeds: more has a probability of 0.1 %."""
    case = cycle_of(tmp_path)
    time = np.full(len(SPEEDS), 1.0)
    time[[0, -1]] = 0.5
    turns = np.array(SPEEDS) > 0.0
    exact = float(np.sum(time[turns] * 1e5 * (1000.0 / np.array(SPEEDS)[turns]) ** 2))
    missed = 0
    for seed in range(10):
        noise = np.random.default_rng(seed)

        def scattered(one, noise=noise):
            rate = 1e5 * (1000.0 * RPM / one.drive.speed) ** 2 * (1.0 + 0.5 * noise.standard_normal())
            return as_record(one, [max(rate, 0.0)] * 2, [1e-9] * 2)

        found = run_drive_cycle(case.replace({"drive.seed": seed}), PEAK, scattered).discharges[0]
        missed += not found.low < exact < found.high
    assert missed <= 3


@pytest.mark.slow
@pytest.mark.gate
def test_a_standstill_and_a_source_that_is_off_have_no_discharges(tmp_path):
    head = "time [s],speed [rpm],common-mode voltage [V]"
    case = cycle_of(tmp_path, [0.0, 3000.0, 3000.0, 3000.0], head, [280.0, 280.0, 0.0, 140.0])
    rows = run_drive_cycle(case, PEAK, by_speed).rows
    assert rows.discharge_rate[[0, 2]].tolist() == [[0.0, 0.0]] * 2
    assert np.all(rows.discharge_rate[[1, 3]] > 0.0)
    assert rows.common_mode_voltage.tolist() == [280.0, 280.0, 0.0, 140.0]


def test_rows_are_simulated_at_their_inputs(tmp_path):
    seen = []

    def solved(case):
        seen.append(case)
        return by_speed(case)

    head = "time [s],speed [rpm],common-mode voltage [V],temperature [degC],radial load [N]"
    columns = [140.0, 140.0], [50.0, 50.0], [900.0, 900.0]
    run_drive_cycle(cycle_of(tmp_path, [-3000.0, -3000.0], head, *columns), PEAK, solved)
    one = seen[0]
    assert one.drive.speed == pytest.approx(3000.0 * RPM)
    assert one.drive.temperature == pytest.approx(323.15)
    assert one.source.dc_link == pytest.approx(0.5 * 560.0)
    assert [bearing.bearing.radial_load for bearing in one.bearings] == [900.0, 900.0]
    assert one.duty is None
    assert len({case.drive.seed for case in seen}) == SIMULATED
    # Whole periods of the fundamental of 100 Hz.
    assert one.drive.duration == pytest.approx(0.02)


def test_slow_rows_are_simulated_for_a_limited_time(tmp_path):
    case = cycle_of(tmp_path, [20.0, 20.0])
    times = []
    run_drive_cycle(case, PEAK, lambda one: times.append(one.drive.duration) or by_speed(one))
    assert set(times) == {MOST_TIME}


@pytest.mark.slow
@pytest.mark.gate
def test_no_discharge_is_bounded_by_the_simulated_time(tmp_path):
    """None in T seconds: below 3.689/T at 95 %, as exp(-3.689) = 2.5 %; their energy has no bound."""
    duty = run_drive_cycle(cycle_of(tmp_path), PEAK, lambda case: as_record(case, [0.0] * 2, [0.0] * 2))
    turning = float(np.sum(duty.rows.duration[duty.rows.speed > 0.0]))
    for found in duty.discharges:
        assert (found.value, found.low) == (0.0, 0.0)
        assert found.high == pytest.approx(3.68888 * turning / duty.simulated, rel=1e-5)
    assert [one.high for one in duty.energy] == [None, None]


@pytest.mark.slow
@pytest.mark.gate
def test_rows_that_cannot_be_simulated_are_left_out_and_named(tmp_path):
    def refusing(case):
        if case.drive.speed > 3000.0 * RPM:
            raise InputError("breakdown.extinction_current", got="10 A", takes="less")
        return by_speed(case)

    duty = run_drive_cycle(cycle_of(tmp_path), PEAK, refusing)
    left_out = ~duty.rows.known
    assert np.all(duty.rows.speed[left_out] > 2900.0 * RPM)
    assert duty.summary()["left_out_share"] == pytest.approx(0.5, abs=0.1)
    # Any number of discharges is possible in the other half of the time.
    assert all(one.low > 0.0 and one.high is None for one in duty.discharges)
    assert any("lower bounds" in str(warning) for warning in duty.warnings)
    (warning,) = [one for one in duty.warnings if one.code == "duty-left-out"]
    assert "breakdown.extinction_current: got 10 A" in warning.text
    assert all(one.value > 0.0 for one in duty.discharges)

    def never(_):
        raise InputError("drive.speed", got="it", takes="another")

    with pytest.raises(InputError, match=r"duty: no row can be simulated: drive\.speed: got it"):
        run_drive_cycle(cycle_of(tmp_path), PEAK, never)


def test_stretches_are_those_above_the_mean(tmp_path):
    duty = run_drive_cycle(cycle_of(tmp_path), PEAK, by_speed)
    worst = duty.stretches[0]
    assert worst.discharges == max(one.discharges for one in duty.stretches)
    rows, within = duty.rows, (duty.rows.time > worst.start) & (duty.rows.time < worst.end)
    rate = np.sum(rows.discharge_rate, axis=1)
    assert np.all(rate[within] > np.average(rate, weights=rows.duration))
    assert worst.discharges == pytest.approx(np.sum((rate * rows.duration)[within]))


@pytest.fixture(scope="module")
def solved(tmp_path_factory):
    """A short cycle that is solved as a user does, with fewer simulated rows."""
    folder = tmp_path_factory.mktemp("drive_cycle")
    with mock.patch("ehlectric.drive.drive_cycle.SIMULATED", 12):
        return folder, solve_drive(cycle_of(folder, [0.0, 1500.0, 3000.0, 3000.0]), workers=1)


@pytest.mark.slow
def test_a_solved_cycle_agrees_with_every_row_simulated_alone(solved):
    """Independent sum: each row with its own long simulation, other random numbers."""
    _, result = solved
    plain = result.case.model_copy(update={"duty": None})
    rates = {}
    for speed in (1500.0, 3000.0):
        record = solve(
            plain.replace({"drive.speed": f"{speed} rpm", "drive.seed": 77, "drive.duration": 0.2})
        ).record
        rates[speed] = np.sum(record.counts, axis=1) / record.duration
    expected = rates[1500.0] + 1.5 * rates[3000.0]
    for b, found in enumerate(result.duty.discharges):
        scatter = 4.0 * np.sqrt(expected[b] * 1.5 / 0.2)  # of the simulations that are compared
        assert found.low - scatter < expected[b] < found.high + scatter


@pytest.mark.slow
def test_summary_and_files(solved, tmp_path):
    _, result = solved
    summary = json.loads(json.dumps(result.summary()))
    assert summary["duty"]["rows"] == 4
    assert summary["duty"]["discharges"] == sum(summary[end]["duty_discharges"] for end in ENDS)
    assert summary["duty"]["standstill_share"] == pytest.approx(0.5 / 3.0)
    parts = {"duty": "duty.", **{end: f"{end}.duty_" for end in ENDS}}
    for table, prefix in parts.items():
        keys = {f"{table}.{key}" for key in summary[table] if f"{table}.{key}".startswith(prefix)}
        listed = {
            key for key in DRIVE_KEYS if key.startswith(prefix) and not key.startswith("duty.stretches.")
        }
        assert keys == listed
    assert {f"duty.stretches.{key}" for key in summary["duty"]["stretches"][0]} == {
        key for key in DRIVE_KEYS if key.startswith("duty.stretches.")
    }
    save(result, tmp_path)
    head, *rows = (tmp_path / "duty.csv").read_text().splitlines()
    assert "drive_end.discharge_rate [1/s]" in head.split(",")
    assert len(rows) == 4
    assert rows[0].startswith("0.0,0.5,0.0,")
    loaded = load(tmp_path)
    assert loaded.duty == result.duty
    assert loaded.summary()["duty"] == result.summary()["duty"]


@pytest.mark.slow
def test_figure_and_tables(solved):
    _, result = solved
    assert "drive_duty" in figure_names(result)
    figure = draw(result, "drive_duty")
    assert title_of(figure)[0].startswith("Expected discharges over the cycle: ")
    speed, _, rates = figure.axes
    assert speed.lines[-1].get_ydata() == pytest.approx([0.0, 1500.0, 3000.0, 3000.0])
    found = [line.get_ydata() for line in rates.lines]
    assert np.array_equal(np.transpose(found), result.duty.rows.discharge_rate)
    rows = {row.key: row.text for row in drive_rows(result.summary())}
    assert rows["duty.standstill_share"] == "16.7 %"
    low, high = (result.duty.discharges[0].low, result.duty.discharges[0].high)
    assert rows["drive_end.duty_discharges_range"] == f"{readable(low)} to {readable(high)}"
    assert rows["duty.stretches.0.discharges"].endswith("rpm")


def test_a_drive_without_a_cycle_has_none():
    result = solve_drive(small_drive(), workers=1)
    assert result.duty is None
    assert "duty" not in result.summary()
    assert not any(key.startswith("duty") for key in result.summary()["drive_end"])


def test_a_bad_cycle_is_refused_before_anything_is_solved(tmp_path):
    case = cycle_of(tmp_path)
    (tmp_path / "cycle.csv").write_text("time [s],speed\n0,1\n1,2\n")
    with pytest.raises(InputError, match=r"column 'speed': has no unit"):
        solve_drive(case)
    case = cycle_of(
        tmp_path, [0.0, 10.0], "time [s],speed [rpm],radial load [N],axial load [N]", [1, 0], [1, 0]
    )
    with pytest.raises(InputError, match=r"line 3: got a speed without a load"):
        solve_drive(case)


def test_the_file_is_found_beside_that_of_the_drive(tmp_path):
    (tmp_path / "drive.toml").write_text(small_drive().replace(duty={"file": "a/cycle.csv"}).to_toml())
    assert DriveCase.from_toml(tmp_path / "drive.toml").duty.file == str(tmp_path / "a" / "cycle.csv")


@pytest.mark.slow
def test_the_example_agrees_with_the_simulation_of_150_random_rows():
    from tests.helpers.places import EXAMPLES

    case = DriveCase.from_toml(EXAMPLES / "duty_drive.toml")
    cycle = read_cycle(case.duty)
    duty = run_drive_cycle(case, 200.0, solve)
    turning = np.flatnonzero(cycle.values["speed"] > 0.0)
    drawn = np.random.default_rng(11).choice(turning, 150)
    rates = []
    for place in drawn.tolist():
        at = {f"drive.{name}": float(cycle.values[name][place]) for name in ("speed", "temperature")}
        at |= {
            "bearings.bearing.radial_load": float(cycle.values["radial_load"][place]),
            "drive.duration": 0.05,
        }
        record = solve(case.model_copy(update={"duty": None}).replace(at | {"drive.seed": place})).record
        rates.append(np.sum(record.counts) / record.duration)
    expected = turning.size * np.mean(rates)
    error = 1.96 * turning.size * np.std(rates, ddof=1) / np.sqrt(len(rates))
    own = sum(one.high - one.low for one in duty.discharges) / 2.0
    assert abs(sum(one.value for one in duty.discharges) - expected) < np.hypot(error, own)
