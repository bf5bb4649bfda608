"""Commands that run out of memory, or whose worker processes are killed: one line, and nothing lost."""

import json
import os
import resource
import signal
import subprocess
import sys
import time
from contextlib import suppress
from pathlib import Path

import pytest
from typer.testing import CliRunner

from ehlectric import load
from ehlectric.commands.command_line import app
from tests.conftest import PAPER_CONTACT
from tests.helpers.bearings import ROLLERS, bearing_case
from tests.helpers.sweeps import CASE

RUN = [sys.executable, "-m", "ehlectric"]


def limited(megabytes, *arguments, folder):
    """Run a command with a limit of its address space."""
    limit = megabytes * 1_000_000
    return subprocess.run(
        [*RUN, *map(str, arguments)],
        cwd=folder,
        capture_output=True,
        text=True,
        timeout=900,
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (limit, limit)),
    )


def written(folder):
    return sorted(str(path.relative_to(folder)) for path in folder.rglob("*") if path.is_file())


@pytest.mark.slow
def test_a_grid_that_the_limit_of_the_shell_leaves_no_room_for(tmp_path):
    (tmp_path / "case.toml").write_text(CASE.replace({"grid.nodes": 1_000_001}).to_toml(), encoding="utf-8")
    done = limited(1600, "run", "case.toml", folder=tmp_path)
    assert done.returncode == 2, done.stderr
    assert done.stderr.startswith("error: grid.nodes: got 1000001 with field_degree")
    assert "what ulimit leaves to this process" in done.stderr
    assert done.stderr.count("\n") == 1
    assert written(tmp_path) == ["case.toml"]


@pytest.mark.parametrize(
    ("where", "status"),
    [("ehlectric.cases.case.Case.of_file", 2), ("ehlectric.contact.run.solve", 3)],
)
def test_memory_that_runs_out_in_a_run(tmp_path, monkeypatch, where, status):
    """2 while the file is read, 3 once it is being solved."""

    def fails(*_given, **_options):
        raise MemoryError("Unable to allocate 5 GiB")

    monkeypatch.setattr(where, fails)
    (tmp_path / "case.toml").write_text(CASE.to_toml(), encoding="utf-8")
    done = CliRunner().invoke(app, ["run", str(tmp_path / "case.toml"), "-o", str(tmp_path / "out")])
    assert done.exit_code == status
    assert done.stderr.startswith("error: out of memory: Unable to allocate 5 GiB; available are ")
    assert done.stderr.count("\n") == 1


@pytest.mark.slow
def test_memory_that_runs_out_in_a_sweep_says_what_is_saved(tmp_path, monkeypatch):
    def fails(*_given, **_options):
        raise MemoryError

    monkeypatch.setattr("ehlectric.sweep.run.write_tables", fails)
    contact = PAPER_CONTACT | {"entrainment_speed": 2.0}
    (tmp_path / "case.toml").write_text(CASE.replace({"contact": contact}).to_toml(), encoding="utf-8")
    text = 'case = "case.toml"\n[vary]\n"grid.nodes" = [129, 131]\n'
    (tmp_path / "sweep.toml").write_text(text, encoding="utf-8")
    out = tmp_path / "out"
    done = CliRunner().invoke(app, ["sweep", str(tmp_path / "sweep.toml"), "-o", str(out), "--workers", "1"])
    assert done.exit_code == 3, done.stderr
    assert done.stderr.startswith("error: out of memory; available are ")
    assert f"2 of 2 points are saved in {out}; the same command resumes the sweep" in done.stderr


def workers_of(pid):
    """Processes of multiprocessing that a process has started, and their times on the processor [s]."""
    found = {}
    for folder in Path("/proc").glob("[0-9]*"):
        try:
            fields = (folder / "stat").read_text(encoding="utf-8").rsplit(")", 1)[1].split()
            if int(fields[1]) == pid and b"spawn_main" in (folder / "cmdline").read_bytes():
                found[int(folder.name)] = sum(map(int, fields[11:13])) / os.sysconf("SC_CLK_TCK")
        except (OSError, IndexError):
            continue
    return found


def killing(folder, *arguments, times):
    """Run a command, and kill so many of its workers, each as soon as it has begun."""
    process = subprocess.Popen(
        [*RUN, *arguments], cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )
    killed = set()
    while process.poll() is None and len(killed) < times:
        for pid, seconds in workers_of(process.pid).items():
            # The empty call that each worker answers first takes 0.1 s, up to 0.2 s on a busy machine; a task
            # takes more than 1 s, as it imports what it computes with.
            if seconds > 0.4 and pid not in killed and len(killed) < times:
                with suppress(ProcessLookupError):
                    os.kill(pid, signal.SIGKILL)
                killed.add(pid)
        time.sleep(0.005)
    out, err = process.communicate(timeout=900)
    return process.returncode, out, err, len(killed)


@pytest.mark.slow
@pytest.mark.skipif(not Path("/proc/self/stat").exists(), reason="workers are found in /proc")
@pytest.mark.parametrize("times", [1, 1000])
def test_a_worker_of_a_bearing_is_killed(tmp_path, times):
    """Once: the contact is solved again. Always: one line, and an earlier result stays as it is."""
    case = bearing_case(ROLLERS, contacts="solved")
    (tmp_path / "bearing.toml").write_text(case.to_toml(), encoding="utf-8")
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / "summary.json").write_text("{}", encoding="utf-8")
    status, _, err, killed = killing(
        tmp_path, "bearing", "bearing.toml", "-o", "out", "--no-plots", "-q", times=times
    )
    assert killed >= min(times, 2), err
    if times == 1:
        assert (status, err) == (0, "")
        assert load(tmp_path / "out" / "bearing.nc").converged
        assert json.loads((tmp_path / "out" / "summary.json").read_text(encoding="utf-8"))["converged"]
        return
    assert status == 3
    assert err.startswith("error: a contact was not solved: its process was killed 4 times")
    assert err.count("\n") == 1
    assert written(tmp_path) == ["bearing.toml", "out/summary.json"]


@pytest.mark.slow
@pytest.mark.skipif(not Path("/proc/self/stat").exists(), reason="workers are found in /proc")
@pytest.mark.parametrize("times", [1, 1000])
def test_a_worker_of_the_study_is_killed(tmp_path, times):
    status, _, err, killed = killing(tmp_path, "reproduce", "--figure", "7", "-q", times=times)
    assert killed >= min(times, 2), err
    if times == 1:
        assert (status, err) == (0, "")
        assert written(tmp_path) == ["reproduced/figure_7.png"]
        return
    assert status == 3
    assert err.startswith("error: a contact was not solved: its process was killed 4 times")
    assert err.count("\n") == 1
    assert written(tmp_path) == []
