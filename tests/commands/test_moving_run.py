"""Moving roughness as a user runs it: what is printed and written, refused, stopped and gone on with."""

import json
import os
import random
import re
import signal
import sqlite3
import subprocess
import time
from contextlib import closing

import numpy as np
import pytest

from ehlectric.errors import ConvergenceError
from ehlectric.figures.figure_names import MOTION_FIGURE_FILES
from ehlectric.film.unsteady import UnsteadyFilm
from ehlectric.motion.stored_run import MotionRun, read_motion
from tests.helpers.commands import COMMAND, Begun, run_command
from tests.helpers.each import each
from tests.helpers.processes import PATIENCE, wait_until

CASE = """\
title = "Bump"
[contact]
reduced_radius = "14.1 mm"
reduced_modulus = "226 GPa"
max_hertz_pressure = "0.5 GPa"
entrainment_speed = "4 m/s"
[lubricant]
base = "paper"
[[roughness]]
surface = 1
generator = "asperity"
height = "50 nm"
width = "60 um"
[grid]
nodes = 65
field_degree = 2
[motion]
passes = 0.375
steps = 12
record = 4
"""
# Five hundred instants, a hundredth of a second each, or so.
LONG = CASE.replace("passes = 0.375\nsteps = 12\nrecord = 4", "passes = 20.0\nrecord = 400")
STEPS = 20 * 64
POINT = CASE.replace('reduced_radius = "14.1 mm"', 'geometry = "point"\nradius_x = 0.01\nradius_y = 0.01')


@pytest.fixture
def case_file(tmp_path):
    path = tmp_path / "case.toml"
    path.write_text(CASE)
    return path


def files(folder):
    return sorted(path.name for path in folder.iterdir())


@pytest.mark.slow
def test_a_moving_case_is_solved_written_and_told(ehlectric, tmp_path, case_file):
    done = ehlectric("run", case_file, "-o", "out", "--no-plots")
    assert done.returncode == 0
    assert done.stdout.splitlines()[-1] == "  summary.json, motion.nc"
    assert files(tmp_path / "out") == ["motion.nc", "summary.json"]
    summary = json.loads((tmp_path / "out" / "summary.json").read_text())
    assert (summary["schema"], summary["converged"], summary["title"]) == ("ehlectric.motion/1", True, "Bump")
    assert done.stderr == "".join(f"warning: {text}\n" for text in summary["warnings"])
    rows = dict(re.split(r" {2,}", line.strip()) for line in done.stdout.splitlines() if "  " in line.strip())
    dataset = read_motion(tmp_path / "out")
    assert dict(dataset.sizes) == {"x": 65, "step": 13, "frame": 4}
    told = {
        "duration of the motion": (summary["motion"]["duration"] * 1e3, "ms, 12 time steps"),
        "minimum film, moving roughness": (float(dataset["minimum_thickness"].min()) * 1e6, "µm at "),
        "maximum pressure, moving roughness": (float(dataset["max_pressure"].max()) / 1e9, "GPa"),
        "maximum field, moving roughness": (float(dataset["max_strength"].max()) / 1e6, "V/µm at "),
        "voltage across the film": (2.0, "V"),
    }
    for name, (value, unit) in told.items():
        # Real films are thinner, and have higher fields.
        assert rows[name].startswith("≥ ") == ("field" in name)
        number, _, rest = rows[name].removeprefix("≥ ").partition(" ")
        assert float(number) == pytest.approx(value, rel=1e-3)
        assert rest.startswith(unit)


@pytest.mark.slow
@pytest.mark.gate
def test_options_of_what_is_printed_and_a_run_is_drawn_again(typed, tmp_path, case_file):
    quiet = typed("run", case_file, "-o", "out", "--no-plots", "-q")
    assert (quiet.returncode, quiet.stdout, quiet.stderr) == (0, "", "")
    shown = typed("run", case_file, "-o", "out", "--no-plots", "-q", "--json")
    assert (shown.returncode, shown.stderr) == (0, "")
    assert json.loads(shown.stdout) == json.loads((tmp_path / "out" / "summary.json").read_text())
    done = typed("plot", "out/motion.nc", "-o", "figures")
    assert done.returncode == 0, done.stderr
    drawn = {path.name for path in (tmp_path / "figures").iterdir()}
    assert {"motion_history.png", "motion_maps.png"} <= drawn <= set(MOTION_FIGURE_FILES)


@pytest.mark.slow
def test_a_point_contact_is_run_too(ehlectric, tmp_path, case_file):
    case_file.write_text(POINT)
    done = ehlectric("run", case_file, "-o", "out", "--no-plots")
    assert done.returncode == 0, done.stderr
    summary = json.loads((tmp_path / "out" / "summary.json").read_text())
    assert len(summary["film"]["minimum_position"]) == len(summary["field"]["max_strength_position"]) == 2


PASSES = "passes = 0.375\n"
ROUGH = CASE[CASE.index("[[roughness]]") : CASE.index("[grid]")]
# What is changed in the case, the key that the line begins with, and what it names.
BAD = [
    ((PASSES, PASSES + 'duration = "1 ms"\n'), "motion.passes", ["duration"]),
    ((PASSES, ""), "motion.passes", ["missing", "duration"]),
    ((PASSES, 'duration = "1 m"\n'), "motion.duration", ["'1 m'", "unit"]),
    (("record = 4", "record = 1"), "motion.record", ["got 1", "2 to 100000"]),
    (("steps = 12", "steps = 2"), "motion.steps", ["got 2", "12 grid spacings"]),
    ((ROUGH, ""), "motion", ["rough"]),
    (("nodes = 65", 'nodes = 65\nwedge = "first-order"'), "grid.wedge", ["'first-order'", "motion"]),
    (("nodes = 65", "nodes = 65\nrefine = 0.1"), "grid.refine", ["[motion]"]),
    (("[lubricant]", "slide_to_roll_ratio = -2.0\n[lubricant]"), "motion", ["at rest"]),
]


@pytest.mark.slow
@each("command", ["run", "check"])
@each("change, key, names", BAD)
def test_wrong_input_is_one_line_before_anything_is_made(
    typed, tmp_path, case_file, command, change, key, names
):
    assert change[0] in CASE
    case_file.write_text(CASE.replace(*change))
    done = typed(command, case_file, *(["-o", "out"] if command == "run" else []))
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.startswith(f"error: {key}: ")
    assert [name for name in names if name not in done.stderr] == []
    assert done.stderr.count("\n") == 1
    assert files(tmp_path) == ["case.toml"]


def test_a_moving_case_is_checked(typed, case_file):
    """Twelve steps of two grid spacings, of which four instants are kept, at 4 m/s."""
    done = typed("check", case_file, "--json")
    assert done.returncode == 0
    found = json.loads(done.stdout)
    # b = 4 R p_h/E'.
    assert found["hertz"]["half_width"] == pytest.approx(4 * 14.1e-3 * 0.5e9 / 226e9)
    motion = found["motion"]
    assert (motion["steps"], motion["courant"], motion["frames"]) == (12, 2.0, 4)
    assert (motion["speed_ratio_1"], motion["speed_ratio_2"]) == (1.0, 1.0)
    assert (motion["covered_from"], motion["coincident"]) == (None, None)
    told = typed("check", case_file).stdout
    assert "ms, 12 time steps" in told
    assert "speed of rough surface 1" in told


@pytest.mark.slow
def test_a_run_that_was_stopped_behind_its_last_step_is_summed_up(typed, tmp_path, case_file):
    """Its file is whole, its summary is missing: nothing is solved again; with the summary there, all is."""
    assert typed("run", case_file, "-o", "out", "--no-plots", "-q").returncode == 0
    first = (tmp_path / "out/motion.nc").read_bytes()
    summary = (tmp_path / "out/summary.json").read_text()
    (tmp_path / "out/summary.json").unlink()
    assert typed("run", case_file, "-o", "out", "--no-plots", "-q").returncode == 0
    assert (tmp_path / "out/motion.nc").read_bytes() == first
    assert (tmp_path / "out/summary.json").read_text() == summary
    assert typed("run", case_file, "-o", "out", "--no-plots", "-q").returncode == 0
    assert (tmp_path / "out/motion.nc").read_bytes() != first


@pytest.mark.slow
def test_a_folder_holds_one_result(typed, tmp_path, case_file):
    """Of what is at rest or of what moves: the other one's files go, but not those of others."""
    still = tmp_path / "still.toml"
    still.write_text(CASE[: CASE.index("[motion]")])
    out = tmp_path / "out"
    assert typed("run", still, "-o", out, "--no-plots", "-q").returncode == 0
    (out / "film.png").write_text("of the film at rest")
    (out / "notes.txt").write_text("mine")
    at_rest = ["film.csv", "notes.txt", "result.nc", "summary.json"]
    assert files(out) == sorted([*at_rest, "film.png"])
    assert typed("run", case_file, "-o", out, "--no-plots", "-q").returncode == 0
    assert files(out) == ["motion.nc", "notes.txt", "summary.json"]
    # The run may have taken hours: it is not replaced, and its files stay.
    (out / "motion_maps.png").write_text("of what moves")
    refused = typed("run", still, "-o", out, "--no-plots", "-q")
    assert refused.returncode == 2
    assert refused.stderr.startswith(f"error: {out}: has 12 saved steps ")
    assert "motion.nc" in refused.stderr
    assert files(out) == ["motion.nc", "motion_maps.png", "notes.txt", "summary.json"]
    (out / "motion.nc").unlink()
    assert typed("run", still, "-o", out, "--no-plots", "-q").returncode == 0
    assert files(out) == at_rest


@pytest.mark.slow
def test_a_step_that_is_not_solved(typed, tmp_path, monkeypatch, case_file):
    """What was found before is summed up all the same; the same command goes on, and fails again."""
    advance, done_before = UnsteadyFilm.advance, []

    def failing(self, history, step):
        if history.now.time > 1.1:
            raise ConvergenceError("film not found at T = 1.3125")
        # The coarse run has steps twice as long.
        if step < 0.3:
            done_before.append(history.now.time)
        return advance(self, history, step)

    monkeypatch.setattr(UnsteadyFilm, "advance", failing)
    for steps in (6, 2):
        done = typed("run", case_file, "-o", "out", "--no-plots")
        assert done.returncode == 3
        assert done.stderr.splitlines()[-1] == (
            "error: not converged: step 7 of 12: film not found at T = 1.3125"
        )
        assert done.stdout.splitlines()[-1] == "  summary.json, motion.nc"
        summary = json.loads((tmp_path / "out" / "summary.json").read_text())
        assert (summary["converged"], summary["motion"]["steps_done"]) == (False, 4)
        assert len(done_before) == steps
        done_before.clear()


def test_a_film_before_the_motion_that_is_not_found(typed, tmp_path, case_file):
    case_file.write_text(CASE + "[solver]\nmax_iterations = 1\n")
    done = typed("run", case_file, "-o", "out", "--no-plots")
    assert (done.returncode, done.stdout) == (3, "")
    assert done.stderr.startswith("error: not converged: film before the motion, ")
    assert done.stderr.count("\n") == 1
    assert not (tmp_path / "out").exists()


def begun(folder, frames=3, text=LONG):
    """A long run with some instants kept, still running."""
    (folder / "case.toml").write_text(text)
    process = Begun("run", "case.toml", "-o", "out", "--no-plots", cwd=folder)

    def enough():
        assert process.poll() is None, process.communicate()
        return kept(folder) >= frames

    assert wait_until(enough), "nothing is kept"
    return process


def kept(folder):
    """Instants in the journal of a run, 0 where there is none yet."""
    path = folder / "out" / "motion.sqlite"
    if not path.is_file():
        return 0
    with closing(sqlite3.connect(path)) as file:
        try:
            return int(file.execute("SELECT count(*) FROM instants").fetchone()[0])
        except sqlite3.OperationalError:
            return 0


@pytest.mark.slow
@pytest.mark.parametrize(
    "number", [signal.SIGTERM, pytest.param(signal.SIGINT, marks=pytest.mark.gate), signal.SIGHUP]
)
def test_a_run_that_is_stopped_says_what_is_saved_and_goes_on(tmp_path, number):
    process = begun(tmp_path)
    process.send_signal(number)
    out, errors = process.communicate()
    assert (process.returncode, out) == (128 + number, "")
    found = read_motion(tmp_path / "out")
    steps, frames = found.sizes["step"] - 1, found.sizes["frame"]
    assert steps > 0
    assert errors == (
        f"interrupted; {steps} of {STEPS} steps are saved in out; the same command resumes the run\n"
    )
    assert files(tmp_path / "out") == ["motion.nc", "motion.sqlite"]
    again = begun(tmp_path, frames + 1)
    again.send_signal(number)
    assert again.communicate()[1].startswith("interrupted; ")
    more = read_motion(tmp_path / "out")
    # Without a gap: each step once, in equal times.
    assert more.sizes["step"] - 1 > steps
    np.testing.assert_allclose(np.diff(more["time"]), more["time"][1], rtol=1e-9)
    assert more["minimum_thickness"].values.min() > 1e-7


@pytest.mark.slow
@pytest.mark.skipif(not hasattr(signal, "SIGHUP"), reason="Windows closes its terminals otherwise")
def test_a_run_after_nohup_outlives_its_terminal(tmp_path):
    (tmp_path / "case.toml").write_text(LONG)
    words = ["nohup", COMMAND, "run", "case.toml", "-o", "out", "--no-plots"]
    with subprocess.Popen(
        words, cwd=tmp_path, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
    ) as process:
        assert wait_until(lambda: kept(tmp_path) >= 2)
        process.send_signal(signal.SIGHUP)
        saved = kept(tmp_path)
        assert wait_until(lambda: kept(tmp_path) > saved + 1)
        process.send_signal(signal.SIGTERM)
        assert process.wait(PATIENCE) == 128 + signal.SIGTERM


def test_stopped_before_anything_is_kept(typed, monkeypatch, case_file):
    from ehlectric.motion import run as motion_run

    def stopping(*_, **__):
        raise SystemExit(128 + signal.SIGTERM)

    monkeypatch.setattr(motion_run, "_begin", stopping)
    done = typed("run", case_file, "-o", "out", "--no-plots", "-q")
    assert (done.returncode, done.stdout) == (143, "")
    assert done.stderr == ("interrupted; 0 of 12 steps are saved in out; the same command resumes the run\n")


@pytest.mark.slow
def test_kills_lose_nothing_that_was_kept(tmp_path):
    """Twice kill -9 at a random moment: it goes on, and ends as it would have."""
    moment, steps = random.Random(3), 0
    for _ in range(2):
        process = begun(tmp_path, kept(tmp_path) + 1, LONG.replace("20.0", "3.0"))
        time.sleep(moment.uniform(0.0, 0.3))
        os.kill(process.pid, signal.SIGKILL)
        process.communicate()
        found = read_motion(tmp_path / "out")
        assert found.sizes["step"] - 1 >= steps
        steps = found.sizes["step"] - 1
        schedule = MotionRun.of(found).schedule
        expected = schedule.step * schedule.time * np.arange(steps + 1)
        np.testing.assert_allclose(found["time"], expected, rtol=1e-9)
    done = run_command("run", "case.toml", "-o", "out", "--no-plots", cwd=tmp_path)
    assert done.returncode == 0
    assert "Traceback" not in done.stderr
    whole = run_command("run", "case.toml", "-o", "whole", "--no-plots", "-q", cwd=tmp_path)
    assert whole.returncode == 0
    killed, expected = read_motion(tmp_path / "out"), read_motion(tmp_path / "whole")
    for name in expected.variables:
        np.testing.assert_array_equal(killed[name].values, expected[name].values, err_msg=str(name))
