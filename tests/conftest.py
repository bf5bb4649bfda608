"""Fixtures shared by all tests."""

import signal

import numpy as np
import pytest
from hypothesis import HealthCheck, settings

from ehlectric import Case, solve
from tests.helpers.share import THOROUGH

# Jobs in the background of a shell may have interrupts ignored, which commands under test would inherit.
if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)

# By default pytest.approx also allows 1e-12 in any unit, which is more than a capacitance in farads.
type(pytest.approx(0.0)).DEFAULT_ABSOLUTE_TOLERANCE = 0.0

# How long an example takes depends on what else the machine does. A run draws the same examples each time, so
# that it fails for what was changed; a thorough one draws others.
settings.register_profile(
    "repeated", deadline=None, derandomize=not THOROUGH, suppress_health_check=[HealthCheck.too_slow]
)
settings.load_profile("repeated")

PAPER_CONTACT = {
    "reduced_radius": "14.1 mm",
    "reduced_modulus": "226 GPa",
    "load_per_length": "1.57 MN/m",
    "entrainment_speed": "4 m/s",
}


@pytest.fixture(scope="session")
def paper_case():
    """First row of the paper's Table 3, on a grid of given nodes."""
    tables = {"contact": PAPER_CONTACT, "lubricant": {"base": "paper"}, "grid": {"nodes": 3201}}
    return Case.from_dict(tables)


@pytest.fixture(scope="session")
def paper_result(paper_case):
    return solve(paper_case)


@pytest.fixture(scope="session")
def slope():
    """Observed order: slope of log error against log spacing, by least squares."""

    def fit(spacings, errors):
        return np.polyfit(np.log(spacings), np.log(errors), 1)[0]

    return fit
