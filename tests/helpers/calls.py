"""Functions that worker processes of the app call in tests."""

import os
import signal
import subprocess
import sys
import time

import numpy as np

from ehlectric.errors import InputError


def double(number):
    return 2 * number


def wait(seconds, *_):
    time.sleep(seconds)
    return seconds


def refuse(*_):
    raise InputError("bearing.radial_load", got="-1 N", takes="above 0 N")


def fail(*_):
    raise KeyError("an error of the program")


def make_unpicklable(*_):
    return lambda: 0


def die(*_):
    os.kill(os.getpid(), signal.SIGKILL)


def allocate(size, *_):
    return float(np.ones(int(size / 8)).sum())


def count_up(number, progress):
    for done in range(number):
        progress(done, number, "points")
    return number


def own_pid(*_):
    return os.getpid()


def start_child(path, _progress):
    """Start a child, write down its number and that of this process, and wait for it."""
    child = subprocess.Popen([sys.executable, "-c", "import time; time.sleep(600)"])
    path.write_text(f"{os.getpid()} {child.pid}")
    child.wait()
