"""Tasks in processes: one whose process dies or that finds too little memory is run again, alone."""

import gc
import os
import signal
import struct
import time
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from multiprocessing.queues import SimpleQueue
from pathlib import Path

import pytest

from ehlectric.errors import InputError, LostError
from ehlectric.runtime.tasks import run_all
from ehlectric.runtime.worker_processes import processes
from tests.helpers.processes import alive, wait_until


def marked(folder, text, act, times=1):
    """Act in the first processes that come here, and count the processes that come."""
    count = len(list(Path(folder).glob(f"{text}-*")))
    Path(folder, f"{text}-{os.getpid()}-{count}").touch()
    if count < times:
        act()
    return text


def die():
    os.kill(os.getpid(), signal.SIGKILL)


def begin_to_send():
    """Send the size of a result and its first bytes, as a process does that is ended then."""
    (results,) = [each for each in gc.get_objects() if isinstance(each, SimpleQueue)]
    os.write(results._writer.fileno(), struct.pack("!i", 1_000_000) + b"first")


def send_in_part_and_die():
    begin_to_send()
    die()


def send_in_part_and_stay(path):
    begin_to_send()
    Path(path).touch()
    time.sleep(600.0)


def refuse_after(folder, text):
    """Fail once another task has begun."""
    assert wait_until(lambda: any(Path(folder).glob(f"{text}-*")))
    divmod(1, 0)


def starve():
    raise MemoryError("Unable to allocate 5 GiB")


def starve_always():
    starve()


def test_tasks_run_in_processes_of_their_own():
    found = {}
    run_all([partial(pow, 2, n) for n in range(5)], found.__setitem__, limit=2)
    assert found == {n: 2**n for n in range(5)}


SENDS = pytest.mark.skipif(os.name == "nt", reason="pipes of Windows have messages, which are sent whole")


@pytest.mark.parametrize(
    "act", [die, starve, pytest.param(send_in_part_and_die, marks=[SENDS, pytest.mark.slow])]
)
def test_a_task_that_fails_once_is_run_again(tmp_path, act):
    found = {}
    tasks = [partial(marked, tmp_path, "a", act), partial(divmod, 7, 2), partial(divmod, 9, 2)]
    run_all(tasks, found.__setitem__, limit=2)
    assert found == {0: "a", 1: (3, 1), 2: (4, 1)}
    runs = list(tmp_path.glob("a-*"))
    assert len(runs) == 2


@pytest.mark.slow
def test_further_kills_cost_no_result(tmp_path):
    found = {}
    tasks = [partial(divmod, 9, 2), partial(marked, tmp_path, "a", die, times=3), partial(divmod, 7, 2)]
    run_all(tasks, found.__setitem__, limit=2)
    assert found == {0: (4, 1), 1: "a", 2: (3, 1)}
    assert len(list(tmp_path.glob("a-*"))) == 4


@pytest.mark.slow
def test_a_task_that_kills_every_process_is_lost():
    with pytest.raises(LostError, match=r"killed 4 times") as error:
        run_all([die], lambda _number, _result: None, limit=1, what="contact")
    assert "\n" not in str(error.value)


@pytest.mark.slow
def test_errors_of_tasks_are_raised_here():
    with pytest.raises(MemoryError, match="5 GiB"):
        run_all([starve_always], lambda _number, _result: None, limit=1)
    with pytest.raises(ZeroDivisionError) as error:
        run_all([partial(divmod, 1, 0)], lambda _number, _result: None, limit=1)
    assert "in _attempt" in error.value.__notes__[0]  # where it came from, in the other process
    with pytest.raises(InputError, match="width: got 1; expected 2") as told:
        run_all([partial(refuse, 1)], lambda _number, _result: None, limit=1)
    assert not getattr(told.value, "__notes__", [])


def refuse(width):
    raise InputError("width", got=width, takes="2")


@pytest.mark.slow
def test_the_processes_end_with_an_error(tmp_path):
    """The other tasks are not waited for."""
    found = {}
    tasks = [
        partial(marked, tmp_path, "a", partial(time.sleep, 600.0)),
        partial(refuse_after, tmp_path, "a"),
    ]
    with pytest.raises(ZeroDivisionError):
        run_all(tasks, found.__setitem__, limit=2)
    assert found == {}
    (mark,) = tmp_path.glob("a-*")
    assert wait_until(lambda: not alive(int(mark.name.split("-")[1])))


@SENDS
def test_the_processes_end_while_one_sends_its_result(tmp_path):
    def left():
        with processes(1) as crew:
            crew.submit(send_in_part_and_stay, tmp_path / "sent")
            assert wait_until((tmp_path / "sent").exists)
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        left()


def test_a_run_that_is_stopped_leaves_no_error_of_its_threads(monkeypatch, capfd):
    """Where tasks wait for a process, and the thread of the pool sees first that the processes have ended."""
    shutdown, broken = ProcessPoolExecutor.shutdown, []

    def late(pool, **options):
        broken.append(wait_until(lambda: pool._broken))
        shutdown(pool, **options)

    monkeypatch.setattr(ProcessPoolExecutor, "shutdown", late)
    tasks = [partial(divmod, 1, 0), *[partial(time.sleep, 600.0)] * 8]
    with pytest.raises(ZeroDivisionError):
        run_all(tasks, lambda _number, _result: None, limit=2)
    assert broken == [True]
    assert "Traceback" not in capfd.readouterr().err
