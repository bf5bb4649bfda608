"""Two commands on one folder: the second is refused, and nothing of the first is touched."""

import json
import signal
import subprocess
import sys
import time
from pathlib import Path
from threading import Event, Thread

import numpy as np
import pytest
from typer.testing import CliRunner

import ehlectric as package
from ehlectric import InputError
from ehlectric.commands.command_line import app
from ehlectric.runtime import folders
from ehlectric.runtime.folders import FIGURE_LOCK, RESULT_LOCK, alone_in
from tests.commands.conftest import CASE
from tests.commands.test_moving_run import LONG, begun
from tests.helpers.commands import Begun, run_command
from tests.helpers.each import each
from tests.helpers.gate import gated
from tests.helpers.places import EXAMPLES
from tests.helpers.processes import wait_until

SMALL = CASE.replace("801", "257")
SWEEP = """\
case = "case.toml"
[vary]
"contact.entrainment_speed" = ["1 m/s", "2 m/s"]
"""
REFUSED = "{}: is being written to by another ehlectric; expected a folder of its own"
MAP = ("--x", "contact.entrainment_speed", "--value", "film.minimum_thickness")


@pytest.fixture
def held(monkeypatch):
    """Holds locks of a folder in a thread of its own, as another process would."""
    monkeypatch.setitem(folders._PATIENCE, FIGURE_LOCK, 0.1)
    ended, threads = Event(), []

    def hold(folder, *locks):
        holding = Event()

        def keep():
            with alone_in(folder, locks=locks):
                holding.set()
                ended.wait()

        threads.append(Thread(target=keep))
        threads[-1].start()
        assert holding.wait(60.0)

    yield hold
    ended.set()
    for thread in threads:
        thread.join()


@pytest.fixture(scope="module")
def stored(tmp_path_factory):
    """Folder with input files and a result."""
    folder = tmp_path_factory.mktemp("stored")
    (folder / "case.toml").write_text(SMALL)
    (folder / "sweep.toml").write_text(SWEEP)
    (folder / "moving.toml").write_text(LONG)
    package.save(package.solve(folder / "case.toml"), folder / "result")
    return folder


BEARING = ("bearing", EXAMPLES / "bearing_6208.toml", "--contacts", "formula")
SURFACE = ("surface", EXAMPLES / "surfaces" / "dektak-1.csv")


@pytest.mark.slow
@each(
    "lock, words",
    [
        (RESULT_LOCK, ("run", "case.toml")),
        (FIGURE_LOCK, ("run", "case.toml")),
        (RESULT_LOCK, ("run", "moving.toml")),
        (FIGURE_LOCK, ("run", "moving.toml")),
        (RESULT_LOCK, BEARING),
        (RESULT_LOCK, ("sweep", "sweep.toml")),
        (RESULT_LOCK, ("reproduce", "--figure", "2")),
        (FIGURE_LOCK, ("plot", "result")),
        (FIGURE_LOCK, SURFACE),
    ],
)
def test_a_command_is_refused(stored, tmp_path_factory, monkeypatch, held, lock, words):
    monkeypatch.chdir(stored)
    out = tmp_path_factory.mktemp("out")
    held(out, lock)
    before = sorted(path.name for path in out.iterdir())
    done = CliRunner().invoke(app, [*map(str, words), "-o", f"{out}/"])
    assert (done.exit_code, done.stdout) == (2, "")
    assert done.stderr == f"error: {REFUSED.format(out)}\n"
    assert sorted(path.name for path in out.iterdir()) == before


def test_saving_in_python_is_refused(stored, tmp_path, held):
    held(tmp_path, RESULT_LOCK, FIGURE_LOCK)
    result = package.load(stored / "result")
    for write in (package.save, package.save_figures):
        with pytest.raises(InputError) as told:
            write(result, tmp_path)
        assert str(told.value) == REFUSED.format(tmp_path)


@pytest.mark.slow
def test_a_map_is_drawn_while_a_sweep_runs_and_two_maps_wait(stored, tmp_path, monkeypatch, held):
    monkeypatch.chdir(stored)
    sweep = package.run_sweep(stored / "sweep.toml", tmp_path, workers=1)
    assert all(point.solved for point in sweep.points)
    held(tmp_path, RESULT_LOCK)
    done = CliRunner().invoke(app, ["map", str(tmp_path), *MAP])
    assert done.exit_code == 0, done.output
    held(tmp_path, FIGURE_LOCK)
    done = CliRunner().invoke(app, ["map", str(tmp_path), *MAP])
    assert (done.exit_code, done.stderr) == (2, f"error: {REFUSED.format(tmp_path)}\n")


@pytest.mark.slow
def test_a_second_moving_run_does_not_touch_the_first(tmp_path):
    """Neither its motion.nc nor its steps; a kill releases the folder, and the run is resumed."""
    process = begun(tmp_path, text=LONG.replace("passes = 20.0\nrecord = 400", "passes = 8.0\nrecord = 100"))
    # It is held, so that it still has the folder when the second command comes, on a busy machine too.
    process.send_signal(signal.SIGSTOP)
    second = ("run", "case.toml", "-o", "out", "--no-plots")
    done = run_command(*second, cwd=tmp_path)
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr == f"error: {REFUSED.format('out')}\n"
    assert process.poll() is None
    process.send_signal(signal.SIGKILL)
    process.communicate()
    saved = package.read_motion(tmp_path / "out")["thickness"].values
    assert run_command(*second, cwd=tmp_path).returncode == 0
    found = package.read_motion(tmp_path / "out")
    assert found.attrs["complete"] == 1
    np.testing.assert_array_equal(found["thickness"].values[: len(saved)], saved)
    assert sorted(path.name for path in (tmp_path / "out").iterdir()) == ["motion.nc", "summary.json"]


def holder_of(lock):
    """Number of the process that has locked a file; None while there is none."""
    try:
        file = str(lock.stat().st_ino)
    except FileNotFoundError:
        return None
    rows = [line.split() for line in Path("/proc/locks").read_text().splitlines()]
    return next((int(row[4]) for row in rows if row[1] == "FLOCK" and row[5].endswith(f":{file}")), None)


TWO = """
[contact]
reduced_radius = "14.1 mm"
reduced_modulus = "226 GPa"
max_hertz_pressure = "{} GPa"
entrainment_speed = "2 m/s"
[lubricant]
base = "paper"
[grid]
nodes = 12801
"""


@pytest.mark.slow
@pytest.mark.gate
def test_two_runs_at_once_leave_one_result(tmp_path):
    """Whichever comes second is refused: summary and arrays are of one case."""
    for name, pressure in (("a", 1.0), ("b", 0.8)):
        (tmp_path / f"{name}.toml").write_text(TWO.format(pressure))
    processes = {}
    for name in "ab":
        command = [sys.executable, "-m", "ehlectric", "run", f"{name}.toml", "-o", "out", "-q", "--no-plots"]
        processes[name] = subprocess.Popen(command, cwd=tmp_path, stderr=subprocess.PIPE, text=True)
    # That which has the folder is held until the other one has come.
    assert wait_until(lambda: holder_of(tmp_path / "out" / RESULT_LOCK))
    (held,) = [
        process for process in processes.values() if process.pid == holder_of(tmp_path / "out" / RESULT_LOCK)
    ]
    held.send_signal(signal.SIGSTOP)
    (other,) = [process for process in processes.values() if process is not held]
    assert wait_until(lambda: other.poll() is not None)
    held.send_signal(signal.SIGCONT)
    errors = {name: process.communicate(timeout=300)[1] for name, process in processes.items()}
    ended = {process.returncode for process in processes.values()}
    assert ended == {0, 2}, errors
    (first,) = [name for name, process in processes.items() if not process.returncode]
    result = package.load(tmp_path / "out")
    expected = package.Case.from_toml(tmp_path / f"{first}.toml")
    assert result.case == expected
    assert json.loads((tmp_path / "out" / "summary.json").read_text()) == result.summary()
    assert sorted(path.name for path in (tmp_path / "out").iterdir()) == [
        "film.csv",
        "result.nc",
        "summary.json",
    ]


@pytest.mark.slow
@pytest.mark.parametrize("seed", gated(range(3), 1))
def test_what_a_kill_leaves_is_gone_after_the_next_run(tmp_path, seed):
    """A run that is killed at any moment leaves no hidden file behind the next one."""
    (tmp_path / "case.toml").write_text(SMALL)
    command, out = ("run", "case.toml", "-o", "out", "-q"), tmp_path / "out"
    process = Begun(*command, cwd=tmp_path)
    assert wait_until(lambda: out.exists() or process.poll() is not None)
    time.sleep(0.4 * seed)
    process.kill()
    process.communicate()
    assert run_command(*command, cwd=tmp_path).returncode == 0
    assert not [path.name for path in out.iterdir() if path.name.startswith(".")]
