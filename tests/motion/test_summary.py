"""What is said of a run: statistics of made-up fields against values by hand, and JSON without a NaN."""

import json
from dataclasses import replace

import numpy as np
import pytest
import xarray as xr

from ehlectric import Case
from ehlectric.contact.conditions import resolve, resolve_point
from ehlectric.figures.figure_names import MOTION_FIGURE_FILES
from ehlectric.figures.result_figures import save_figures
from ehlectric.motion import moving_contact
from ehlectric.motion.run import run_motion
from ehlectric.motion.stored_run import MotionRun, read_motion, time_above
from ehlectric.motion.summary import (
    SCHEMA,
    coincident_instant,
    counted,
    estimated,
    local_maxima,
    summary_of,
)
from tests.helpers.each import each
from tests.helpers.moving_cases import LINE, POINT, moving


def conditions_of(case):
    return resolve_point(case) if case.contact.geometry == "point" else resolve(case)


def schedule_of(case):
    return moving_contact.schedule_of(case, conditions_of(case))


def made(case, *, times, x=None, y=None, frame_times=None, complete=True, stationary=None, **values):
    """A dataset as ``read_motion`` gives it, with values that are given and else ones; times of T.

    Positions in half-widths; ``steps_`` before a name gives those of all steps.
    """
    times_of, b = schedule_of(case), conditions_of(case).half_width
    scale = times_of.time
    times = np.asarray(times, dtype=float)
    frame_times = times if frame_times is None else np.asarray(frame_times, dtype=float)
    x = np.linspace(-4.0, 2.0, 7) if x is None else np.asarray(x, dtype=float)
    axes = {"x": x} if y is None else {"x": x, "y": np.asarray(y, dtype=float)}
    nodes = tuple(axes)
    found = {
        "time": ("step", times * scale),
        "frame_time": ("frame", frame_times * scale),
        "frame_step": ("frame", np.searchsorted(times, frame_times)),
    }
    of_steps = ["minimum_thickness", "minimum_x", "max_pressure", "thin_gap_strength"]
    of_steps += ["newton_iterations", "krylov_iterations", "halvings"]
    of_frames = ["max_strength", "max_strength_x", "capacitance"]
    if y is not None:
        of_steps, of_frames = [*of_steps, "minimum_y"], [*of_frames, "max_strength_y"]
    for names, dimension, size in ((of_steps, "step", times.size), (of_frames, "frame", frame_times.size)):
        for name in names:
            found[name] = dimension, np.asarray(values.pop(name, np.ones(size)), dtype=float)
    shape = (frame_times.size, *(axis.size for axis in axes.values()))
    for name in ("pressure", "thickness", "strength"):
        maps = np.asarray(values.pop(name, np.ones(shape)), dtype=np.float32)
        found[name] = ("frame", *nodes), maps
    for name, held in (stationary or {}).items():
        found[f"stationary_{name}"] = nodes, np.asarray(held, dtype=float)
    assert not values
    attributes = {
        "case": case.to_toml(),
        "version": "1.2.3",
        "complete": int(complete),
        "warnings": json.dumps(["mind"]),
        "warning_codes": json.dumps(["tunnelling"]),
        "stationary": json.dumps({"minimum_thickness": 3e-7} if stationary else None),
        "rough": "[]",
        "seconds": 2.5,
        "covered_from": times_of.covered * scale,
    }
    return xr.Dataset(found, {name: b * axis for name, axis in axes.items()}, attributes)


@each(
    "values, level, part",
    [
        # Up and down: above half of the top in the middle half.
        ([0.0, 1.0, 0.0], 0.5, 0.5),
        ([0.0, 1.0, 0.0], 0.9, 0.1),
        ([0.0, 1.0, 1.0], 0.75, 0.625),
        ([1.0, 1.0, 1.0], 0.9, 1.0),
        ([1.0, 1.0, 1.0], 1.0, 0.0),
        ([0.0, 0.0, 0.0], 0.1, 0.0),
        ([2.0, 3.0, 4.0], 0.5, 1.0),
        ([4.0], 3.0, 1.0),
        ([3.0], 3.0, 0.0),
    ],
)
def test_part_of_the_time_above_a_level(values, level, part):
    assert time_above(np.arange(len(values), dtype=float), np.array(values), level) == pytest.approx(part)


def test_time_counts_by_its_length():
    """Three seconds at the top, one falling from it, half of that above the half."""
    time = np.array([0.0, 3.0, 4.0, 8.0])
    assert time_above(time, np.array([2.0, 2.0, 0.0, 0.0]), 1.0) == pytest.approx(3.5 / 8.0)


# All lies as the case has it after T = 6, and from then on the Hertz zone is covered.
CASE = moving(LINE, motion={"passes": 2.0})
POINT_CASE = moving(POINT, motion={"passes": 2.0})


def test_instants_count_from_when_the_contact_is_covered():
    times = np.array([0.0, 3.0, 5.9, 6.01, 9.0, 12.0])
    assert counted(MotionRun.of(made(CASE, times=times))).tolist() == [False, False, False, True, True, True]
    # Fewer than two are no statistics, nor where it is never covered: then all count.
    assert counted(MotionRun.of(made(CASE, times=times[:4]))).tolist() == [True] * 4
    assert counted(MotionRun.of(made(CASE, times=times[:5]))).tolist() == [False, False, False, True, True]
    short = moving(LINE, motion={"passes": 0.9})
    assert counted(MotionRun.of(made(short, times=[0.0, 5.0]))).tolist() == [True, True]


def test_local_maxima_of_a_line():
    """Larger than both beside, within the Hertz zone, each instant for itself."""
    x = np.linspace(-1.5, 1.5, 13)
    nan = np.nan
    first = [nan, 9.0, 1.0, 5.0, 2.0, 3.0, 1.0, 4.0, 4.0, 1.0, 2.0, 3.0, nan]
    # The first and last node in the zone, at -0.75 and 0.75: peaks there look at the nodes beyond it.
    second = [nan, 1.0, 1.0, 7.0, 2.0, 6.0, 1.0, 1.0, 1.0, 8.0, 2.0, 9.0, nan]
    hidden = [99.0] * 13
    strength = np.array([first, hidden, second])
    dataset = made(CASE, times=[0.0, 1.0, 2.0], x=x, strength=strength)
    found = local_maxima(MotionRun.of(dataset), np.array([True, False, True]))
    # Not the plateau of two 4.0, nor 9.0 and 3.0 outside.
    assert sorted(found) == [3.0, 5.0, 6.0, 7.0, 8.0]
    assert local_maxima(MotionRun.of(dataset), np.array([False, True, False])).size == 0


def test_an_error_of_the_field_that_is_unknown_at_an_instant_is_a_warning():
    dataset = made(CASE, times=[0.0, 1.0, 2.0, 3.0])

    def unresolved(errors):
        found = summary_of(dataset.assign(max_strength_error=("frame", errors)))
        texts = zip(found["warning_codes"], found["warnings"], strict=True)
        return found["field"]["max_strength_error"], [
            text for code, text in texts if code == "field-unresolved"
        ]

    assert unresolved([0.001, 0.002, 0.0, 0.0]) == (0.002, [])
    error, (text,) = unresolved([0.001, np.nan, 0.0, 0.0])
    assert error is None
    assert "is not known at 1 of 4 recorded instants" in text
    error, texts = unresolved([0.031, np.nan, np.nan, 0.0])
    assert error is None
    assert "is estimated at 3.1 %" in texts[0]
    assert "is not known at 2 of 4 recorded instants" in texts[1]


def test_a_maximum_beside_the_zone_hides_what_is_lower_in_it():
    x = np.array([-1.5, -1.0, -0.5, 0.0, 0.5, 1.0, 1.5])
    strength = [[1.0, 9.0, 8.0, 1.0, 2.0, 1.0, 5.0]]
    found = local_maxima(MotionRun.of(made(CASE, times=[0.0], x=x, strength=strength)), np.array([True]))
    assert found.tolist() == [2.0]


def test_local_maxima_of_a_point_look_at_eight_neighbours():
    x, y = np.linspace(-1.2, 1.2, 7), np.linspace(-1.2, 1.2, 7)
    strength = np.ones((1, 7, 7))
    strength[0, 2, 2] = 5.0
    strength[0, 3, 3] = 4.0  # lower than its diagonal neighbour
    strength[0, 4, 4] = 3.0  # and this lower than that
    strength[0, 2, 5] = 6.0
    strength[0, 0, 0] = 9.0  # a corner, outside the circle
    strength[0, 5, 5] = 8.0  # hypot(0.8, 0.8) is outside too
    dataset = made(POINT_CASE, times=[0.0], x=x, y=y, strength=strength)
    assert sorted(local_maxima(MotionRun.of(dataset), np.array([True]))) == [5.0, 6.0]
    # Each instant for itself: a higher one before hides nothing.
    both = made(POINT_CASE, times=[0.0, 1.0], x=x, y=y, strength=np.concatenate([10.0 * strength, strength]))
    assert sorted(local_maxima(MotionRun.of(both), np.array([True, True]))) == [5.0, 6.0, 50.0, 60.0]


def test_the_zone_of_an_ellipse_is_its_own():
    """The radius across is five times that along: the semi-axis across is longer, and places in it count."""
    wide = {"radius_x": "10 mm", "radius_y": "50 mm"}
    case = moving(POINT, contact=POINT["contact"] | wide, grid={"nodes": 65, "nodes_y": 65})
    conditions = resolve_point(case)
    ratio = conditions.semi_axis_y / conditions.half_width
    assert 2.0 < ratio < 5.0
    y = np.array([-1.1, -0.9, 0.0, 0.9, 1.1]) * ratio
    strength = np.ones((1, 3, 5))
    strength[0, 1, 1] = 5.0
    strength[0, 1, 4] = 6.0
    dataset = made(case, times=[0.0], x=[-0.5, 0.0, 0.5], y=y, strength=strength)
    assert local_maxima(MotionRun.of(dataset), np.array([True])).tolist() == [5.0]


def test_quantiles_of_local_maxima_and_the_time_above_90_percent():
    """21 maxima of 1 to 21: 5 %, a half and 95 % of the way from the first to the last are 2, 11 and 20."""
    x = np.linspace(-0.99, 0.99, 43)
    strength = np.zeros(43)
    strength[1:-1:2] = np.random.default_rng(1).permutation(np.arange(1.0, 22.0))
    maps = np.stack([np.full(43, 50.0), np.zeros(43), strength])
    # The first, at T = 0, is before the contact is covered. From T = 8 to 12 from 10 V/m to 20: 90 % is 18.
    dataset = made(
        CASE,
        times=[0.0, 8.0, 12.0],
        x=x,
        strength=maps,
        max_strength=[30.0, 10.0, 20.0],
        max_strength_x=[1e-5, 2e-5, 3e-5],
        capacitance=[9.0, 2.0, 3.0],
        thin_gap_strength=[1.0, 40.0, 2.0],
    )
    field = summary_of(dataset)["field"]
    scale = schedule_of(CASE).time
    assert field["local_maxima"] == 21
    assert field["local_maxima_quantiles"] == pytest.approx([2.0, 11.0, 20.0])
    assert field["share_above_90"] == pytest.approx(0.2)
    assert field["time_above_90"] == pytest.approx(0.8 * scale)
    assert (field["capacitance_mean"], field["capacitance_least"], field["capacitance_largest"]) == (
        2.5,
        2.0,
        3.0,
    )
    # The largest of all is before, and is told all the same.
    assert (field["before"], field["max_strength"], field["max_strength_time"]) == (30.0, 30.0, 0.0)
    assert (field["max_strength_position"], field["max_thin_gap_strength"]) == (1e-5, 40.0)
    assert field["voltage"] == 2.0


def test_no_local_maximum_has_no_quantiles():
    field = summary_of(made(CASE, times=[0.0, 1.0]))["field"]
    assert (field["local_maxima"], field["local_maxima_quantiles"]) == (0, None)


def test_film_over_time():
    dataset = made(
        CASE,
        times=[0.0, 1.0, 2.0, 3.0],
        frame_times=[0.0, 3.0],
        minimum_thickness=[4e-7, 3e-7, 1e-7, 2e-7],
        minimum_x=[1e-5, 2e-5, 3e-5, 4e-5],
        max_pressure=[1e9, 5e9, 3e9, 4e9],
    )
    scale = schedule_of(CASE).time
    assert summary_of(dataset)["film"] == {
        "before": 4e-7,
        "minimum_thickness": 1e-7,
        "minimum_time": pytest.approx(2.0 * scale),
        "minimum_position": 3e-5,
        "max_pressure": 5e9,
        "max_pressure_time": pytest.approx(scale),
        "discretisation_error": None,  # a run of an earlier version, which has no coarse run
        "minimum_thickness_error": None,
        "central_thickness_error": None,
    }


def test_places_of_a_point_contact_are_pairs():
    dataset = made(
        POINT_CASE,
        times=[0.0, 1.0],
        y=np.linspace(-3.0, 3.0, 3),
        minimum_thickness=[2e-7, 1e-7],
        minimum_x=[1.0, 2.0],
        minimum_y=[3.0, 4.0],
        max_strength=[7.0, 6.0],
        max_strength_x=[5.0, 6.0],
        max_strength_y=[7.0, 8.0],
    )
    summary = summary_of(dataset)
    assert summary["film"]["minimum_position"] == [2.0, 4.0]
    assert summary["field"]["max_strength_position"] == [5.0, 7.0]


def test_the_course_and_what_it_took():
    case = moving(LINE, {"contact.slide_to_roll_ratio": 1.0}, motion={"passes": 2.0, "steps": 64})
    dataset = made(
        case,
        times=[0.0, 0.1875, 0.375],
        frame_times=[0.0, 0.375],
        newton_iterations=[0.0, 3.0, 4.0],
        krylov_iterations=[0.0, 6.0, 9.0],
        halvings=[0.0, 1.0, 1.0],
        complete=False,
    )
    summary = summary_of(dataset)
    scale = schedule_of(case).time
    assert summary["motion"] == {
        "duration": pytest.approx(12.0 * scale),
        "steps": 64,
        "steps_done": 2,
        "courant": pytest.approx(2.0),
        "frames": 2,
        "speed_ratio_1": 1.5,
        "speed_ratio_2": 0.5,
        # Of surface 1, which is rough: 6/1.5 half-widths.
        "covered_from": pytest.approx(4.0 * scale),
        "coincident": pytest.approx(4.0 * scale),
        "newton_per_step": 3.5,
        "krylov_per_step": 7.5,
        "halvings": 2,
    }
    assert (summary["schema"], summary["version"], summary["converged"]) == (SCHEMA, "1.2.3", False)
    mind, halved = summary["warnings"]
    assert (mind, summary["rough"], summary["seconds"]) == ("mind", [], 2.5)
    assert summary["warning_codes"] == ["tunnelling", "steps-halved"]
    assert halved.startswith("2 time steps did not converge and were halved, 2 times in total")
    assert summary["inputs"] == case.to_dict()
    assert (summary["stationary"], summary["beside_stationary"], summary["discharge"]) == (None, None, None)


def test_breakdown_over_time():
    """15 V/um in a film whose field is 5 V/um at 2 V: it withstands 6 V."""
    case = CASE.replace({"discharge.dielectric_strength": "15 V/um"})
    strength = [3.75e6, 6e6, 3e6, 2.5e6, 2e6]
    times = [0.0, 2.0, 7.0, 8.0, 9.0]
    found = summary_of(made(case, times=times, max_strength=strength))["discharge"]
    assert found == {
        "breakdown_voltage": pytest.approx(5.0),
        "breakdown_time": pytest.approx(2.0 * schedule_of(case).time),
        "breakdown_voltage_before": pytest.approx(8.0),
        # Of 10, 12 and 15 V, since the contact is covered.
        "breakdown_voltage_median": pytest.approx(12.0),
        "margin": pytest.approx(2.5),
        "breakdown_field_error": None,
    }


def test_a_strength_that_varies_over_the_film_is_not_judged():
    table = {"pressure": ["0 GPa", "1 GPa"], "strength": ["15 V/um", "25 V/um"]}
    for discharge in ({"strength_table": table}, {"conductivity": 1e-12}):
        case = moving(LINE, motion={"passes": 2.0}, discharge=discharge)
        assert summary_of(made(case, times=[0.0, 1.0]))["discharge"] is None


HELD = {
    "thickness": [9.0, 9.0, 9.0, 4.0, 3.0, 0.5, 9.0],
    "pressure": [0.0, 0.0, 0.0, 2.0, 1.0, 99.0, 0.0],
    "strength": [np.nan, np.nan, 7.0, 5.0, 6.0, 70.0, np.nan],
}
X = [-4.0, -2.0, -1.0, -0.5, 0.5, 1.0, 2.0]


def beside(**changes):
    """Moving and held still at T = 6, of which the two nodes at -0.5 and 0.5 lie in the Hertz zone."""
    maps = {name: np.ones((3, 7)) for name in HELD}
    maps["thickness"][1] = [0.0, 0.0, 0.0, 2.0, 2.5, 0.0, 0.0]
    maps["pressure"][1] = [9.0, 9.0, 9.0, 5.0, 1.0, 9.0, 9.0]
    maps["strength"][1] = [np.nan, np.nan, 9.0, 8.0, 2.0, 9.0, np.nan]
    return made(CASE, times=[0.0, 6.0, 12.0], x=X, **{"stationary": HELD} | maps | changes)


def test_beside_the_same_roughness_held_still():
    found = summary_of(beside())["beside_stationary"]
    assert found == {
        "time": pytest.approx(6.0 * schedule_of(CASE).time),
        "minimum_thickness": 2.0,
        "minimum_thickness_stationary": 3.0,
        "thickness_rms_difference": pytest.approx(np.sqrt((2.0**2 + 0.5**2) / 2.0)),
        "thickness_largest_difference": 2.0,
        "maximum_pressure": 5.0,
        "maximum_pressure_stationary": 2.0,
        "pressure_rms_difference": pytest.approx(np.sqrt(4.5)),
        "pressure_largest_difference": 3.0,
        "maximum_strength": 8.0,
        "maximum_strength_stationary": 6.0,
        "strength_rms_difference": pytest.approx(np.sqrt((3.0**2 + 4.0**2) / 2.0)),
        "strength_largest_difference": 4.0,
    }


def test_a_field_range_beside_the_hertz_zone_leaves_its_strength_out():
    nowhere = HELD | {"strength": [np.nan] * 3 + [np.nan, np.nan] + [70.0, np.nan]}
    dataset = beside(stationary=nowhere)
    summary = summary_of(dataset)
    assert summary["beside_stationary"]["minimum_thickness"] == 2.0
    names = ("maximum_strength", "maximum_strength_stationary", "strength_rms_difference")
    for name in (*names, "strength_largest_difference"):
        assert summary["beside_stationary"][name] is None
    assert "NaN" not in json.dumps(summary, allow_nan=False)


def test_what_was_kept_near_the_time_at_which_all_lies_alike():
    step = schedule_of(CASE).step
    for away, number in ((0.0, 1), (0.5, 1), (-0.5, 1), (0.7, None), (-0.7, None)):
        dataset = made(CASE, times=[0.0, 6.0 + away * step, 12.0], x=X, stationary=HELD)
        assert coincident_instant(MotionRun.of(dataset)) == number
    # Not held still, or never alike.
    assert coincident_instant(MotionRun.of(made(CASE, times=[0.0, 6.0, 12.0]))) is None
    sliding = moving(
        LINE,
        {"contact.slide_to_roll_ratio": 1.0},
        roughness=[LINE["roughness"][0], LINE["roughness"][0] | {"surface": 2}],
        motion={"passes": 2.0},
    )
    dataset = made(sliding, times=[0.0, 6.0, 12.0], x=X, stationary=HELD)
    assert coincident_instant(MotionRun.of(dataset)) is None
    assert summary_of(dataset)["beside_stationary"] is None


@each("passes", [0.5, 2.0])
@each("table", [LINE, POINT])
def test_json_has_no_nan(table, passes):
    """Nor where times are infinite, one instant alone is there, or strengths lie outside the field range."""
    case = moving(table, motion={"passes": passes})
    y = np.linspace(-3.0, 3.0, 7) if table is POINT else None
    for times in ([0.0], [0.0, 1.0]):
        strength = np.full((len(times), 7) if y is None else (len(times), 7, 7), np.nan)
        summary = summary_of(made(case, times=times, y=y, strength=strength, complete=False))
        text = json.dumps(summary, allow_nan=False)
        assert json.loads(text) == summary
        assert (summary["motion"]["covered_from"] is None) == (passes < 1.0)
        assert (summary["motion"]["coincident"] is None) == (passes < 1.0)
    assert summary["field"]["local_maxima"] == 0


@pytest.mark.slow
def test_a_run_is_told_as_it_was_solved(tmp_path):
    """One pass in sixteen steps: what it says of the bump, moving and held still, is that of its maps."""
    case = moving(LINE, motion={"passes": 1.0, "steps": 16, "record": 2})
    run_motion(case, tmp_path)
    dataset = read_motion(tmp_path)
    summary = summary_of(dataset)
    assert json.dumps(summary, allow_nan=False)
    assert summary["converged"]
    assert summary["motion"]["steps_done"] == 16
    found, held = summary["beside_stationary"], summary["stationary"]
    assert found["time"] == dataset["frame_time"].values[-1]
    # The thinnest film, the highest pressure and the strongest field lie in the Hertz zone.
    assert found["minimum_thickness_stationary"] == pytest.approx(held["minimum_thickness"], rel=1e-12)
    assert found["maximum_pressure_stationary"] == pytest.approx(held["max_pressure"], rel=1e-12)
    assert found["maximum_strength_stationary"] == pytest.approx(held["max_strength"], rel=1e-6)
    assert found["minimum_thickness"] == pytest.approx(dataset["minimum_thickness"].values[-1], rel=1e-6)
    assert held["capacitance"] == pytest.approx(summary["field"]["capacitance_mean"], rel=0.1)
    assert summary["film"]["before"] == dataset["minimum_thickness"].values[0]
    assert [surface["surface"] for surface in summary["rough"]] == [1]


@pytest.mark.slow
@pytest.mark.parametrize("table", [LINE, POINT], ids=["line", "point"])
def test_a_stored_run_needs_no_surface_file(tmp_path, table):
    """Reading, summary and figures work after the file of the profile is deleted."""
    profile = tmp_path / "profile.csv"
    x = 5e-6 * np.arange(400)
    np.savetxt(profile, np.column_stack([x, 1e-8 * np.sin(x / 3e-5)]), delimiter=",")
    rough = {"surface": 1, "file": str(profile), "x_unit": "m", "z_unit": "m"}
    case = moving(table, roughness=[rough], motion={"passes": 0.25, "steps": 2, "record": 2})
    run_motion(case, tmp_path)
    before = summary_of(read_motion(tmp_path))
    assert before["motion"]["steps_done"] == 2
    profile.unlink()
    dataset = read_motion(tmp_path)
    assert summary_of(dataset) == before
    assert [file.name for file in save_figures(dataset, tmp_path)] == list(MOTION_FIGURE_FILES[:2])


def test_a_summary_parses_and_resolves_its_case_once(monkeypatch):
    dataset, calls = beside(), []
    parse, resolves = Case.from_dict.__func__, moving_contact.LINE.contact.resolve

    def parsed(cls, *values):
        calls.append("parsed")
        return parse(cls, *values)

    def resolved(case):
        calls.append("resolved")
        return resolves(case)

    monkeypatch.setattr(Case, "from_dict", classmethod(parsed))
    stationary = replace(moving_contact.LINE.contact, resolve=resolved)
    monkeypatch.setitem(moving_contact.KINDS, "line", replace(moving_contact.LINE, contact=stationary))
    assert summary_of(dataset)["beside_stationary"] is not None
    assert calls == ["parsed", "resolved"]


def test_estimated_errors_do_not_depend_on_the_unit_of_the_films():
    fine, coarse = np.array([3.0, 2.0, 2.2]), np.array([2.9, 2.1, 2.15])
    one, other = (
        estimated((unit * fine, unit * coarse), (unit * fine[::-1], unit * coarse), unit * 2.05)
        for unit in (1.0, 1e-7)
    )
    assert one.minimum > 0.01
    assert (other.minimum, other.central) == pytest.approx((one.minimum, one.central), rel=1e-9)
