"""Compiled functions on the disk belong to the sources of all functions that they call."""

import errno
import json
import os
import subprocess
import sys
from pathlib import Path

import numba
import pytest

from ehlectric.drive.discharges import compiled, event_loop
from ehlectric.drive.discharges.compiled import contents_of

SOURCE = Path(compiled.__file__).parent.parent


def test_a_change_in_any_file_is_another_folder(tmp_path):
    for name in ("a.py", "b.py"):
        (tmp_path / name).write_text("one = 1\n")
    before = contents_of(tmp_path)
    assert contents_of(tmp_path) == before
    (tmp_path / "b.py").write_text("one = 2\n")
    assert contents_of(tmp_path) != before


def test_the_folder_is_that_of_the_sources():
    folder = Path(event_loop.advance.stats.cache_path)
    assert f"compiled-{contents_of(SOURCE)}" in folder.parts
    assert contents_of(SOURCE) not in str(numba.config.CACHE_DIR)


@pytest.mark.slow
def test_a_folder_of_the_user_is_kept(tmp_path):
    code = (
        "import numba; from ehlectric.drive.discharges import event_loop;"
        "print(event_loop.advance.stats.cache_path, numba.config.CACHE_DIR, sep='\\n')"
    )
    environment = {"NUMBA_CACHE_DIR": str(tmp_path), "PYTHONPATH": str(SOURCE.parents[1])}
    done = subprocess.run([sys.executable, "-c", code], env=environment, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    at, after = done.stdout.splitlines()
    assert Path(at).is_relative_to(tmp_path / f"compiled-{contents_of(SOURCE)}")
    assert after == str(tmp_path)


def test_without_a_folder_functions_are_compiled_and_it_is_logged_once(monkeypatch, caplog, tmp_path):
    """A file in place of each folder holds for root as well."""
    (tmp_path / "file").touch()
    monkeypatch.setattr(compiled, "_bases", lambda _: iter([tmp_path / "file"]))
    for cached in (compiled._folder, compiled._not_kept):
        cached.cache_clear()
    told = []
    try:
        for _ in range(2):
            double = compiled.compiled(lambda x: 2.0 * x)
            compiled.compile_for(double, (1.5,), told.append)
            compiled.compile_for(double, (1.5,), told.append)
            assert double(1.5) == 3.0
    finally:
        for cached in (compiled._folder, compiled._not_kept):
            cached.cache_clear()
    assert len(told) == 2
    assert [(record.name, record.levelname) for record in caplog.records] == [
        ("ehlectric.machine", "WARNING")
    ]
    assert "NUMBA_CACHE_DIR" in caplog.text


def test_a_full_disk_costs_no_simulation(monkeypatch, caplog):
    compiled._not_kept.cache_clear()
    double = compiled.compiled(lambda x: 2.0 * x)

    def full(*_):
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr(double._cache, "save_overload", full)
    compiled.compile_for(double, (1.5,), lambda _: None)
    assert double(1.5) == 3.0
    assert os.strerror(errno.ENOSPC) in caplog.text


def test_a_user_without_a_home_has_the_other_folders(monkeypatch):
    def none():
        raise RuntimeError

    monkeypatch.setattr(Path, "home", none)
    assert list(compiled._bases("")) == [SOURCE / "discharges" / "__pycache__"]


SHORT = """
import json, sys
from pathlib import Path
from ehlectric import DriveCase, example, solve
case = DriveCase.from_toml(example("drive")).replace({"drive.duration": "0.2 ms"})
print(json.dumps(solve(case, workers=1).summary()))
"""


@pytest.mark.slow
def test_a_simulation_that_is_not_compiled():
    """The order of sums differs from that of compiled functions, and nothing else."""
    found = {}
    for disabled in ("0", "1"):
        environment = os.environ | {"NUMBA_DISABLE_JIT": disabled}
        command = [sys.executable, "-W", "error", "-c", SHORT]
        done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stderr
        found[disabled] = json.loads(done.stdout)
    for end in ("drive_end", "non_drive_end"):
        quick, slow = (found[disabled][end] for disabled in ("0", "1"))
        assert slow["events"] == quick["events"]
        assert slow["rms_voltage"] == pytest.approx(quick["rms_voltage"], rel=1e-9)
        assert slow["energy_mean"] == pytest.approx(quick["energy_mean"], rel=1e-9)
