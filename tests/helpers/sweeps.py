"""Small sweeps, and a solver of points that can die or be slow."""

import os
import signal
import time

from ehlectric import Case
from ehlectric.sweep.engine import solve_point
from ehlectric.sweep.sweep_inputs import Sweep
from tests.conftest import PAPER_CONTACT

SPEED, LOAD, NODES = "contact.entrainment_speed", "contact.load_per_length", "grid.nodes"
PRESSURE = "contact.max_hertz_pressure"

# On 129 nodes a point takes some hundredths of a second; the film is coarse but converged.
TABLE = {"contact": PAPER_CONTACT, "lubricant": {"base": "paper"}, "grid": {"nodes": 129}}
CASE = Case.from_dict(TABLE)

# A point with so many nodes kills the process that solves it.
DEADLY = 131
# A point with so many nodes takes half a second longer.
SLOW = 133


def sweep_over(vary, **keys):
    return Sweep.from_dict({"case": CASE, "vary": vary} | keys)


def speeds(count):
    return sweep_over({SPEED: [1.0 + k for k in range(count)]})


def solve_or_die(table):
    """Solve a point by ``solve_point``; DEADLY nodes kill the process, SLOW nodes delay it."""
    if table["grid"]["nodes"] == DEADLY:
        os.kill(os.getpid(), signal.SIGKILL)
    if table["grid"]["nodes"] == SLOW:
        time.sleep(0.5)
    return solve_point(table)
