"""Estimated errors of runs against their errors by a grid and steps four times as fine."""

from itertools import product

import numpy as np
import pytest

from ehlectric.motion.moving_contact import TransientContact
from ehlectric.motion.run import run_motion
from ehlectric.motion.stored_run import MotionRun, read_motion
from ehlectric.motion.summary import run_errors
from tests.helpers.gate import gated
from tests.helpers.moving_cases import LINE, POINT, moving
from tests.helpers.share import share

pytestmark = pytest.mark.convergence

WAVE = {"surface": 1, "generator": "sinusoid", "amplitude": "60 nm", "wavelength": "100 um"}
PIT = {"surface": 1, "generator": "pit", "depth": "100 nm", "width": "90 um"}
SURFACES = {"wave": WAVE, "pit": PIT}


def run_of(case, refined, folder):
    """Run of a case on a grid that is finer by a factor, with as many times as many steps."""
    schedule = TransientContact.of(case).schedule
    motion = {
        "motion.passes": None,
        "motion.duration": schedule.end * schedule.time,
        "motion.steps": refined * schedule.steps,
        "motion.record": 2,
    }
    nodes = refined * (case.grid.nodes - 1) + 1
    fine = case.replace({"grid.nodes": nodes, **motion})
    return MotionRun.of(read_motion(run_motion(fine, folder / str(refined))))


def true_error(run, reference, refined, *, order):
    """Larger of the errors of the minimum over time and of the central film, extrapolated."""
    left = 1.0 / (1.0 - refined**-order)
    minimum = float(np.min(run.values("minimum_thickness")))
    of_minimum = abs(minimum / float(np.min(reference.values("lowest_thickness"))) - 1.0)
    central, better = run.values("central_thickness"), reference.values("central_thickness")[::refined]
    return left * max(of_minimum, float(np.max(np.abs(central / better - 1.0))))


@pytest.mark.slow
@pytest.mark.parametrize(
    ("surface", "ratio"), gated(share(list(product(SURFACES, [0.0, 1.0, -1.0, 2.0])), 3), ("wave", 0.0))
)
def test_the_error_of_a_line_contact_is_estimated(surface, ratio, tmp_path):
    """Waves of 17 nodes; the estimate is above the error, and not above thirty times the error."""
    changes = {"grid.nodes": 129, "contact.slide_to_roll_ratio": ratio}
    case = moving(LINE, changes, roughness=[SURFACES[surface]], motion={"passes": 1.2})
    run = run_of(case, 1, tmp_path)
    error = true_error(run, run_of(case, 4, tmp_path), 4, order=2.0)
    assert error < run_errors(run).largest < 30.0 * error


@pytest.mark.slow
@pytest.mark.parametrize("ratio", share([1.0, 0.0, -0.5], 2))
def test_the_error_of_a_point_contact_is_estimated(ratio, tmp_path):
    case = moving(POINT, {"contact.slide_to_roll_ratio": ratio}, roughness=[PIT])
    run = run_of(case, 1, tmp_path)
    error = true_error(run, run_of(case, 2, tmp_path), 2, order=2.0)
    assert error < run_errors(run).largest < 30.0 * error
