"""Verdicts on a drive with one hybrid bearing whose capacitance is not known."""

import pytest

from ehlectric import DriveCase, solve_drive
from ehlectric.drive.preparation import prepare
from ehlectric.drive.quick_estimate import expected
from ehlectric.drive.summary import checked_summary
from tests.helpers.places import EXAMPLES

CERAMIC = {"drive_end.bearing.element_material": "silicon-nitride"}
BOTH = CERAMIC | {"non_drive_end.bearing.element_material": "silicon-nitride"}
KNOWN = CERAMIC | {"drive_end.bearing.element_capacitance": "5 pF"}


def case(changes, strength):
    ends = ("drive_end", "non_drive_end")
    strengths = {f"{end}.discharge.dielectric_strength": strength for end in ends}
    short = {"drive.duration": "2 ms", "breakdown.weibull_shape": 50, **changes, **strengths}
    return DriveCase.from_toml(EXAMPLES / "drive.toml").replace(short, remedies=[])


@pytest.mark.parametrize(
    ("changes", "strength", "level"),
    [
        ({}, "400 V/um", "green"),
        # The voltage of the steel end is a lower bound, so that green is not certain, and red stays red.
        (CERAMIC, "400 V/um", "yellow"),
        (CERAMIC, "5 V/um", "red"),
        (KNOWN, "400 V/um", "green"),
        (BOTH, "400 V/um", "green"),
    ],
)
def test_a_voltage_that_is_a_lower_bound_is_no_green_answer(changes, strength, level):
    drive = case(changes, strength)
    for verdict in (expected(drive, checked_summary(prepare(drive))), solve_drive(drive).verdict):
        assert verdict.level == level
        assert level != "yellow" or "The capacitance of a bearing" in verdict.text
