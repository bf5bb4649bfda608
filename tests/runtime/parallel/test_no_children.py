"""Everything is solved in the calling process where it may have no children."""

import errno
import multiprocessing
import os
import threading
import tomllib
from functools import partial

import pytest

import ehlectric
from ehlectric.runtime.spawning import Process
from ehlectric.runtime.tasks import run_all
from tests.commands.conftest import CASE

SPEEDS = ("1 m/s", "2 m/s")
TABLES = tomllib.loads(CASE.replace("801", "257"))
SWEEP = {"case": TABLES, "vary": {"contact.entrainment_speed": list(SPEEDS)}}


def in_a_worker(function, *values):
    """Value of a function in a worker of a pool, which is daemonic as the workers of Celery and Airflow."""
    with multiprocessing.get_context("fork").Pool(1) as pool:
        return pool.apply(function, values)


def where(number):
    return number, os.getpid()


def tasks_here():
    found = {}
    run_all([partial(where, number) for number in range(3)], found.__setitem__, limit=2)
    return [found[number] == (number, os.getpid()) for number in range(3)]


ONLY_POSIX = pytest.mark.skipif(os.name == "nt", reason="Windows forks no processes")


@ONLY_POSIX
def test_tasks_in_a_daemonic_process():
    assert in_a_worker(tasks_here) == [True, True, True]


@ONLY_POSIX
def test_tasks_in_a_thread_of_a_daemonic_process():
    found = []
    thread = threading.Thread(target=lambda: found.append(in_a_worker(tasks_here)))
    thread.start()
    thread.join()
    assert found == [[True, True, True]]


def refuse(*_, **__):
    raise OSError(errno.EAGAIN, os.strerror(errno.EAGAIN))


@pytest.mark.parametrize("what", ["processes", "threads", "semaphores"])
def test_tasks_where_no_process_can_be_started(monkeypatch, what):
    """As under ``ulimit -u``, and in services without shared memory."""
    if what == "processes":
        monkeypatch.setattr(Process, "start", refuse)
    elif what == "threads":
        text = "can't start new thread"
        monkeypatch.setattr(threading.Thread, "start", lambda _: (_ for _ in ()).throw(RuntimeError(text)))
    else:
        text = "This platform lacks a functioning sem_open implementation"
        monkeypatch.setattr(
            "concurrent.futures.process._check_system_limits",
            lambda: (_ for _ in ()).throw(NotImplementedError(text)),
        )
    assert tasks_here() == [True, True, True]


def films(folder):
    case = ehlectric.Case.from_dict(TABLES)
    cases = [case.replace({"contact.entrainment_speed": speed}) for speed in SPEEDS]
    many = sorted(ehlectric.solve_many(cases, workers=2), key=lambda one: one.number)
    swept = ehlectric.run_sweep(SWEEP, folder, workers=2)
    return (
        [one.result.film.minimum_thickness for one in many],
        [point.summary["film"]["minimum_thickness"] for point in swept.points],
    )


@pytest.mark.slow
@ONLY_POSIX
def test_many_cases_and_a_sweep_in_a_daemonic_process(tmp_path):
    """The same films as in processes of their own."""
    there, here = in_a_worker(films, tmp_path / "there"), films(tmp_path / "here")
    assert there == here
    assert there[0] == there[1]
    # The exponent of the speed in a line film is 0.6 to 0.7.
    assert 2.0**0.6 < there[0][1] / there[0][0] < 2.0**0.75


def margin():
    case = ehlectric.BearingCase.from_toml(ehlectric.example("bearing_6208"))
    return ehlectric.solve(case.replace({"bearing.inner_speed": "3000 rpm"})).margin


@pytest.mark.slow
@ONLY_POSIX
def test_a_bearing_in_a_daemonic_process():
    """The contacts are solved with the default number of workers, which is above 1 on most machines."""
    # Margin of the same bearing with contacts from the atlas, whose films may be wrong by 4.7 %.
    case = ehlectric.BearingCase.from_toml(ehlectric.example("bearing_6208"))
    quick = ehlectric.solve(case.replace({"bearing.inner_speed": "3000 rpm", "contacts": "atlas"})).margin
    assert in_a_worker(margin) == pytest.approx(quick, rel=0.05)
