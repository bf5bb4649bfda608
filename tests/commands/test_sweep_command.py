"""The sweep command as a user types it: its options, what it prints, and every way it may be stopped."""

import csv
import os
import random
import re
import signal
import sqlite3
import subprocess
import sys
import time
from collections import Counter
from contextlib import closing

import pytest
import xarray as xr

from ehlectric import read_sweep
from ehlectric.quantities.result_warnings import CODES
from tests.commands.conftest import CASE
from tests.commands.test_reproduce import children, gone
from tests.helpers.commands import Begun
from tests.helpers.dask import Dask
from tests.helpers.each import each
from tests.helpers.places import EXAMPLES
from tests.helpers.processes import wait_until, workers_of

SWEEP = """\
case = "case.toml"
[vary]
contact.entrainment_speed = ["1 m/s", "2 m/s"]
contact.max_hertz_pressure = { from = "0.5 GPa", to = "1 GPa", count = 2 }
"""
# Many points that take a moment each: far more than are solved before a test stops them.
LONG = """\
case = "case.toml"
[vary]
contact.entrainment_speed = { from = "0.5 m/s", to = "8 m/s", count = 12, spacing = "log" }
contact.max_hertz_pressure = { from = "0.5 GPa", to = "2 GPa", count = 100 }
"""


@pytest.fixture
def swept(tmp_path, case_file):
    """Writes a sweep file beside its case."""
    case_file.write_text(CASE.replace("801", "257"))

    def write(text):
        (tmp_path / "sweep.toml").write_text(text)
        return "sweep.toml"

    return write


def rows_of(folder):
    with (folder / "sweep.csv").open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def told_of(rows, doubtful):
    """What is said on stderr of the kinds of warnings of solved points, and of those not to be used."""
    text, solved = "", [row for row in rows if row["status"] == "solved"]
    counts = Counter(code for row in solved for code in row["warning_codes"].split("; ") if code)
    for code, count in sorted(counts.items(), key=lambda kind: (CODES[kind[0]].severity == "note", -kind[1])):
        kind = "note" if CODES[code].severity == "note" else "warning"
        meaning = CODES[code].meaning
        text += f"{kind}: {code} at {count} of {len(solved)} solved points: "
        action = "No action is needed." if kind == "note" else "Check the warnings of these points."
        text += f"{meaning[0].lower()}{meaning[1:]} {action}\n"
    if doubtful:
        text += f"warning: the film must not be used at {doubtful} of {len(solved)} solved points. "
        text += "Maps and lines omit these points. Check the warnings of these points.\n"
    return text


def failures(stderr):
    """What is on stderr in addition to warnings of solved points, the note on their domains, and progress."""
    known = re.compile(
        r" of \d+ solved points[:.] |^note: the inlet of the domain is at |^\d+ of \d+ points, .* left$"
    )
    return "".join(line for line in stderr.splitlines(True) if not known.search(line.rstrip("\n")))


def saved(folder):
    """Points that are saved, by their keys."""
    # Not read-only: what a kill left half written is taken back by whoever opens the file next.
    with closing(sqlite3.connect(f"file:{folder}/sweep.sqlite?mode=rw", uri=True, timeout=30.0)) as file:
        return dict(file.execute("SELECT key, summary FROM results"))


@pytest.mark.slow
@pytest.mark.gate
def test_a_sweep_is_solved_saved_and_told(ehlectric, tmp_path, swept):
    done = ehlectric("sweep", swept(SWEEP), "-o", "out", "--workers", 1)
    rows = rows_of(tmp_path / "out")
    # 257 nodes are few: points have warnings, and they are told.
    warned = sum(row["warnings"] != "" for row in rows)
    doubtful = sum("do not use" in row["warnings"] for row in rows)
    assert (done.returncode, done.stderr) == (0, told_of(rows, doubtful))
    assert 0 < warned <= 4
    assert done.stdout.split()[:5] == ["points", "solved", "4", "of", "4"]
    assert done.stdout.splitlines()[-2:] == ["written to out:", "  sweep.csv, sweep.parquet, sweep.nc"]
    assert [row["contact.entrainment_speed [m/s]"] for row in rows] == ["1.0", "1.0", "2.0", "2.0"]
    with xr.open_dataset(tmp_path / "out" / "sweep.nc") as file:
        assert dict(file.sizes) == {"contact.entrainment_speed": 2, "contact.max_hertz_pressure": 2}
        # More speed, thicker film; more load, a thinner one.
        thickness = file["film.minimum_thickness"].values
    assert (thickness[1] > thickness[0]).all()
    assert (thickness[:, 1] < thickness[:, 0]).all()


@pytest.mark.slow
def test_points_that_failed_are_counted_without_a_table_too(ehlectric, tmp_path, swept):
    """Where the field range is narrow, 65 nodes have too few columns for it: two points of four."""
    text = SWEEP.replace(', "2 m/s"', "") + "grid.nodes = [257, 65]\ngrid.field_range = [[-0.5, 0.5]]\n"
    done = ehlectric("sweep", swept(text), "-o", "out", "--workers", 1, "-q")
    rows = rows_of(tmp_path / "out")
    assert [row["status"] for row in rows].count("failed") == 2
    doubtful = sum("do not use" in row["warnings"] for row in rows)
    also = f', {doubtful} solved but "do not use"' if doubtful else ""
    expected = f"warning: of 4 points 2 failed{also}; sweep.csv says why\n"
    assert (done.returncode, done.stdout, done.stderr) == (0, "", expected)


@pytest.mark.slow
def test_points_that_failed_are_counted_by_their_reason(ehlectric, tmp_path, swept):
    text = SWEEP + "grid.nodes = [257, 65]\ngrid.outlet = [2.0, 9.0]\nsolver.max_iterations = [30]\n"
    done = ehlectric("sweep", swept(text), "-o", "out", "--workers", 1)
    assert (done.returncode, failures(done.stderr)) == (0, "")
    counts = {row["status"]: 0 for row in rows_of(tmp_path / "out")}
    for row in rows_of(tmp_path / "out"):
        counts[row["status"]] += 1
    # 13 half-widths take 105 nodes at least: four points have 65.
    assert counts["failed"] == 4
    assert "4 points grid.nodes: got 65 over 13 half-widths; expected at least 105" in " ".join(
        done.stdout.split()
    )


@pytest.mark.slow
@pytest.mark.gate
def test_where_none_is_solved_the_status_is_3(ehlectric, tmp_path, swept):
    done = ehlectric("sweep", swept(SWEEP + "solver.max_iterations = [1]\n"), "-o", "out", "--workers", 1)
    assert (done.returncode, failures(done.stderr)) == (3, "error: none of 4 points was solved\n")
    assert [row["status"] for row in rows_of(tmp_path / "out")] == ["not converged"] * 4


@each(
    "option, value, name",
    [("--workers", "9" * 5000, "'9999999999"), ("--scheduler", "nonsense", "'nonsense'")],
)
def test_wrong_options_are_one_short_line(ehlectric, tmp_path, swept, option, value, name):
    done = ehlectric("sweep", swept(SWEEP), "-o", "out", option, value)
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.startswith("error: ")
    assert option.removeprefix("--") in done.stderr
    assert name in done.stderr
    assert done.stderr.count("\n") == 1
    assert len(done.stderr) < 500
    assert not (tmp_path / "out").exists()


@pytest.mark.slow
def test_a_scheduler_that_nobody_is(ehlectric, swept):
    done = ehlectric("sweep", swept(SWEEP), "-o", "out", "--scheduler", "tcp://127.0.0.1:1")
    assert (done.returncode, done.stderr.count("\n")) == (2, 1)
    for part in ("error: scheduler: ", "'tcp://127.0.0.1:1'", "8 s"):
        assert part in done.stderr


def told(count):
    """What is said of a long sweep that is stopped."""
    return f"{count} of 1200 points are saved in out; the same command resumes the sweep\n"


def begun(folder, *options, points=1, group=False):
    """A long sweep with some points saved, still running."""
    process = Begun("sweep", "sweep.toml", "-o", "out", *options, cwd=folder, group=group)
    wait_for_points(folder / "out", points, process)
    return process


def wait_for_points(folder, points, process):
    def enough():
        assert process.poll() is None, process.communicate()
        try:
            return (folder / "sweep.sqlite").exists() and len(saved(folder)) >= points
        except sqlite3.OperationalError:
            return False  # its tables are being made

    assert wait_until(enough, every=0.02), "nothing is saved"


@pytest.mark.slow
@pytest.mark.parametrize("number", [signal.SIGINT, pytest.param(signal.SIGTERM, marks=pytest.mark.gate)])
def test_a_sweep_that_is_stopped_says_what_is_saved(tmp_path, swept, number):
    swept(LONG)
    process = begun(tmp_path, "--workers", "1", group=True)
    workers = children(process.pid)
    assert workers
    os.killpg(process.pid, number) if number == signal.SIGINT else process.send_signal(number)
    out, errors = process.communicate()
    assert (process.returncode, out) == (128 + number, "")
    count = len(saved(tmp_path / "out"))
    # A slow machine prints its progress before.
    assert errors.endswith("interrupted; " + told(count))
    assert gone(workers)
    assert sorted(path.name for path in (tmp_path / "out").iterdir()) == ["sweep.sqlite"]


@pytest.mark.slow
def test_a_second_sweep_in_the_same_folder_is_refused(ehlectric, tmp_path, swept):
    swept(LONG)
    process = begun(tmp_path, "--workers", "1")
    second = ehlectric("sweep", "sweep.toml", "-o", "out")
    assert (second.returncode, second.stdout) == (2, "")
    line = "error: out: is being written to by another ehlectric; expected a folder of its own\n"
    assert second.stderr == line
    assert process.poll() is None
    process.terminate()
    process.communicate()


@pytest.mark.slow
def test_no_row_is_lost_or_doubled_by_kills(ehlectric, tmp_path, swept):
    """Ten times kill -9 at a random moment: rows only become more, and the workers go too."""
    swept(LONG)
    number = 12 * 100
    moment, rows = random.Random(5), {}
    for turn in range(10):
        # Half of them while points are saved, half while all is being made ready.
        process = begun(tmp_path, "--workers", "2", points=len(rows) + 1 if turn % 2 else len(rows))
        time.sleep(moment.uniform(0.0, 0.2))
        workers = children(process.pid)
        before = saved(tmp_path / "out")
        process.kill()
        process.communicate()
        after = saved(tmp_path / "out")
        assert rows.items() <= before.items() <= after.items()
        assert gone(workers)
        rows = after
    assert 5 <= len(rows) < number
    done = ehlectric("sweep", "sweep.toml", "-o", "out")
    assert done.returncode == 0, done.stderr
    final = saved(tmp_path / "out")
    assert rows.items() <= final.items()
    assert len(final) == number
    assert [point.status for point in read_sweep(tmp_path / "out").points] == ["solved"] * number
    assert [row["number"] for row in rows_of(tmp_path / "out")] == [str(k) for k in range(number)]


@pytest.mark.slow
def test_a_worker_that_is_killed_costs_no_point(tmp_path, case_file, swept):
    swept(LONG.replace("count = 100", "count = 12"))
    # Each point takes so long that the workers cannot have solved all others when the first one is seen.
    case_file.write_text(CASE.replace("801", "4097"))
    process = begun(tmp_path, "--workers", "2", "-q")
    os.kill(workers_of(process.pid)[0], signal.SIGKILL)
    _, errors = process.communicate()
    assert (process.returncode, failures(errors)) == (0, "")
    assert [point.status for point in read_sweep(tmp_path / "out").points] == ["solved"] * 144


@pytest.mark.slow
def test_the_example_and_again(ehlectric, tmp_path):
    done = ehlectric("sweep", EXAMPLES / "sweep.toml", "-o", "out")
    assert (done.returncode, failures(done.stderr)) == (0, "")
    rows = rows_of(tmp_path / "out")
    assert [row["status"] for row in rows] == ["solved"] * 30
    again = ehlectric("sweep", EXAMPLES / "sweep.toml", "-o", "out", "-q")
    assert (again.returncode, again.stdout, again.stderr) == (0, "", "")
    assert rows_of(tmp_path / "out") == rows


@pytest.fixture
def dask(tmp_path):
    """Cluster without processes, which end with the test."""
    with Dask(tmp_path) as cluster:
        yield cluster


@pytest.fixture
def scheduler(dask):
    """Process of a scheduler without workers, and its address."""
    return dask.scheduler()


@pytest.fixture
def cluster(dask, scheduler):
    """Address and process of a scheduler that has a worker, both started by their own commands."""
    process, where = scheduler
    dask.worker(where)
    return where, process


@pytest.mark.slow
@pytest.mark.gate
def test_a_worker_without_the_package_ends_the_sweep(ehlectric, swept, dask, scheduler):
    dask.worker_without_package(scheduler[1])
    done = ehlectric("sweep", swept(SWEEP), "-o", "out", "--scheduler", scheduler[1])
    assert done.returncode == 3
    (line,) = failures(done.stderr).splitlines()
    assert "not on this machine" in line


@pytest.mark.slow
def test_a_sweep_that_waits_for_workers_is_stopped(tmp_path, swept, scheduler):
    swept(SWEEP)
    process = Begun("sweep", "sweep.toml", "-o", "out", "--scheduler", scheduler[1], cwd=tmp_path)
    assert wait_until(lambda: "no workers" in process.errors())
    process.terminate()
    process.communicate()
    assert process.returncode == 128 + signal.SIGTERM


@pytest.mark.slow
def test_a_scheduler_that_dies_loses_nothing(ehlectric, tmp_path, swept, cluster):
    swept(LONG)
    address, scheduler = cluster
    process = begun(tmp_path, "--scheduler", address, points=5)
    scheduler.kill()
    scheduler.wait()
    out, errors = process.communicate()
    assert (process.returncode, out) == (3, "")
    rows = saved(tmp_path / "out")
    assert len(rows) >= 5
    assert errors.startswith("error: the workers were lost: ")
    assert errors.endswith("; " + told(len(rows)))
    assert errors.count("\n") == 1
    # Without the cluster, on this machine; without its progress, which is told where it takes long.
    done = ehlectric("sweep", "sweep.toml", "-o", "out", "--quiet")
    assert (done.returncode, failures(done.stderr)) == (0, "")
    assert rows.items() <= saved(tmp_path / "out").items()
    assert [point.status for point in read_sweep(tmp_path / "out").points] == ["solved"] * 1200


@pytest.mark.slow
def test_a_cluster_started_by_its_own_commands(ehlectric, tmp_path, swept, cluster):
    done = ehlectric("sweep", swept(SWEEP), "-o", "out", "--scheduler", cluster[0])
    assert (done.returncode, failures(done.stderr)) == (0, "")
    assert [row["status"] for row in rows_of(tmp_path / "out")] == ["solved"] * 4


@pytest.mark.slow
def test_a_local_cluster_from_python(tmp_path, swept):
    """As a script has it: a LocalCluster, its executor, and nothing left behind or warned of."""
    swept(SWEEP)
    script = tmp_path / "script.py"
    script.write_text(
        "from distributed import Client, LocalCluster\n"
        "import ehlectric\n"
        "if __name__ == '__main__':\n"
        "    sweep = ehlectric.Sweep.from_toml('sweep.toml')\n"
        "    with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=':0',\n"
        "                      silence_logs=50) as cluster:\n"
        "        with Client(cluster) as client, client.get_executor() as executor:\n"
        "            results = ehlectric.run_sweep(sweep, 'out', executor)\n"
        "    print([point.status for point in results.points])\n"
    )
    done = subprocess.run([sys.executable, script], cwd=tmp_path, capture_output=True, text=True, timeout=600)
    assert (done.returncode, failures(done.stderr)) == (0, "")
    assert done.stdout == f"{['solved'] * 4}\n"


@pytest.mark.slow
def test_a_script_without_a_main_guard_sweeps(tmp_path, swept):
    swept(SWEEP)
    script = tmp_path / "script.py"
    script.write_text("import ehlectric\nprint('run')\nehlectric.run_sweep('sweep.toml', 'out', workers=2)\n")
    done = subprocess.run([sys.executable, script], cwd=tmp_path, capture_output=True, text=True, timeout=600)
    assert (done.returncode, done.stdout, failures(done.stderr)) == (0, "run\n", "")
    assert {point.status for point in read_sweep(tmp_path / "out").points} == {"solved"}


@pytest.mark.slow
def test_a_former_key_is_drawn_with_one_line_that_names_its_successor(ehlectric, tmp_path):
    case = (EXAMPLES / "bearing_6208.toml").as_posix()
    speeds = '"bearing.inner_speed" = ["2000 rpm", "3000 rpm"]'
    (tmp_path / "speeds.toml").write_text(
        f'case = "{case}"\n[vary]\n"contacts" = ["atlas"]\n{speeds}\n', "utf-8"
    )
    assert ehlectric("sweep", "speeds.toml", "-o", "out").returncode == 0
    done = ehlectric("map", "out", "--x", "bearing.inner_speed", "--value", "bearing.through_breakdown")
    assert done.returncode == 0
    line = "warning: bearing.through_breakdown is deprecated; use bearing.ring_to_ring_breakdown\n"
    assert done.stderr.count(line) == 1
    assert "lines_bearing.through_breakdown.png" in done.stdout
