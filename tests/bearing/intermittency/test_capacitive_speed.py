"""Speed from which a bearing is capacitive."""

import pytest

from ehlectric.bearing.bearing_touching import CAPACITIVE
from ehlectric.bearing.result import solve_bearing
from tests.bearing.intermittency.test_duty import THIN
from tests.helpers.bearings import BALLS, bearing_case, numbers_of


def result(**changes):
    return solve_bearing(bearing_case(BALLS, **(THIN | changes)), workers=1)


@pytest.mark.slow
@pytest.mark.parametrize("speed", ["1000 rpm", "4000 rpm"])
def test_the_bearing_becomes_capacitive_there(speed):
    """From below and from above; the bearing at that speed, solved again, is at the limit."""
    found = result(bearing__inner_speed=speed)
    at = numbers_of(result(bearing__inner_speed=found.capacitive_speed))["bearing"]
    assert at["contact_time_share"] == pytest.approx(CAPACITIVE, rel=0.03, abs=0.0)
    assert at["lambda_ratio"] >= 0.99
    below, above = (
        numbers_of(result(bearing__inner_speed=found.capacitive_speed * part))["bearing"][
            "electrical_behaviour"
        ]
        for part in (0.97, 1.03)
    )
    assert (below, above) == ("intermittent", "capacitive")
    assert found.summary()["margin"]["capacitive_speed"] == found.capacitive_speed


@pytest.mark.slow
def test_no_such_speed():
    coating = {"ring": "outer", "thickness": "200 um", "relative_permittivity": 9.0, "area": "45 cm^2"}
    for changes in (
        {"bearing__element_material": "silicon-nitride"},
        {"bearing__coating": coating},
        {"bearing__composite_rq": "10 um"},
        {"bearing__composite_rq": "0.01 nm"},
    ):
        assert result(**changes).capacitive_speed is None
