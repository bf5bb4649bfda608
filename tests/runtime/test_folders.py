"""One command at a time writes into a folder."""

import logging
import signal
import subprocess
import sys
import time
from threading import Thread

import pytest

from ehlectric import InputError
from ehlectric.runtime import folders
from ehlectric.runtime.folders import FIGURE_LOCK, RESULT_LOCK, alone_in
from tests.helpers.processes import PATIENCE

HOLD = """
import sys, time
from pathlib import Path
from ehlectric.runtime.folders import alone_in
from ehlectric.runtime.files import whole
with alone_in(sys.argv[1], locks=sys.argv[2:]) as folder, whole(folder / "film.png"):
    print("held", flush=True)
    time.sleep(600)
"""


@pytest.fixture
def holder(tmp_path):
    """Another process that holds locks of the folder of the test, and writes into it."""
    processes = []

    def hold(*locks):
        command = [sys.executable, "-c", HOLD, tmp_path, *locks]
        processes.append(subprocess.Popen(command, stdout=subprocess.PIPE, text=True))
        assert processes[-1].stdout.readline() == "held\n"
        return processes[-1]

    yield hold
    for process in processes:
        process.kill()
        process.communicate()


@pytest.fixture(autouse=True)
def impatient(monkeypatch):
    monkeypatch.setitem(folders._PATIENCE, FIGURE_LOCK, 0.1)


def refused(folder, *locks):
    with pytest.raises(InputError) as told, alone_in(folder, locks=locks):
        pass
    assert str(told.value) == (
        f"{folder}: is being written to by another ehlectric; expected a folder of its own"
    )


def test_a_second_process_is_refused_until_the_first_is_killed(tmp_path, holder):
    process = holder(RESULT_LOCK, FIGURE_LOCK)
    before = sorted(path.name for path in tmp_path.iterdir())
    for locks in ([RESULT_LOCK], [FIGURE_LOCK], [RESULT_LOCK, FIGURE_LOCK]):
        refused(tmp_path, *locks)
    assert sorted(path.name for path in tmp_path.iterdir()) == before
    process.send_signal(signal.SIGKILL)
    process.wait()
    with alone_in(tmp_path) as folder:
        # What it left is gone: its hidden file; its locks are those of this process.
        assert sorted(path.name for path in folder.iterdir()) == sorted([RESULT_LOCK, FIGURE_LOCK])
    assert not list(tmp_path.iterdir())


def test_figures_may_be_drawn_while_points_are_solved(tmp_path, holder):
    holder(RESULT_LOCK)
    hidden = [path.name for path in tmp_path.glob(".ehlectric-*")]
    with alone_in(tmp_path, locks=[FIGURE_LOCK]):
        # The file that the other process writes stays.
        assert [path.name for path in tmp_path.glob(".ehlectric-*") if path.name != FIGURE_LOCK] == hidden
    refused(tmp_path, RESULT_LOCK)


def test_a_command_that_draws_is_waited_for(tmp_path, holder, monkeypatch):
    monkeypatch.setitem(folders._PATIENCE, FIGURE_LOCK, PATIENCE)
    process, waited, sleep = holder(FIGURE_LOCK), [], time.sleep

    def kill_and_sleep(seconds):
        """The other process ends once it is waited for."""
        waited.append(seconds)
        process.kill()
        sleep(seconds)

    monkeypatch.setattr(folders.time, "sleep", kill_and_sleep)
    with alone_in(tmp_path, locks=[FIGURE_LOCK]):
        assert waited
        assert process.wait() == -signal.SIGKILL


def test_another_thread_is_refused_and_the_same_call_is_not(tmp_path):
    with alone_in(tmp_path), alone_in(tmp_path / "." / "", locks=[RESULT_LOCK]):
        thread = Thread(target=refused, args=(tmp_path, RESULT_LOCK))
        thread.start()
        thread.join()
    with alone_in(tmp_path, ["film.png"]):
        pass
    assert not list(tmp_path.iterdir())


def test_folders_that_were_made_for_nothing_are_removed(tmp_path):
    def fail(write):
        with alone_in(tmp_path / "new" / "deep") as folder:
            assert folder.is_dir()
            if write:
                (folder / "film.csv").touch()
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        fail(write=False)
    assert not list(tmp_path.iterdir())
    with pytest.raises(KeyboardInterrupt):
        fail(write=True)
    assert [path.name for path in (tmp_path / "new" / "deep").iterdir()] == ["film.csv"]


def test_a_file_system_without_locks_is_told_and_used(tmp_path, monkeypatch, caplog):
    monkeypatch.setattr(folders, "try_lock", lambda _: "none")
    with caplog.at_level(logging.WARNING, "ehlectric"), alone_in(tmp_path, locks=[RESULT_LOCK]):
        pass
    assert caplog.messages == [f"{tmp_path}: has no locks; only one command at a time may write into it"]
    assert not list(tmp_path.iterdir())


COUNT = """
import sys
from pathlib import Path
from ehlectric.runtime import folders
folders._PATIENCE[folders.FIGURE_LOCK], folders._AGAIN = 600.0, 1e-4
for _ in range(200):
    with folders.alone_in(sys.argv[1], locks=[folders.FIGURE_LOCK]):
        count = Path(sys.argv[2])
        count.write_text(str(int(count.read_text()) + 1))
"""


@pytest.mark.slow
def test_the_file_of_a_lock_is_removed_without_a_race(tmp_path):
    """Four processes count to 800, each 200 times alone."""
    folder, count = tmp_path / "out", tmp_path / "count"
    folder.mkdir()
    count.write_text("0")
    command = [sys.executable, "-c", COUNT, folder, count]
    processes = [subprocess.Popen(command) for _ in range(4)]
    assert [process.wait() for process in processes] == [0] * 4
    assert count.read_text() == "800"
    assert not list(folder.iterdir())
