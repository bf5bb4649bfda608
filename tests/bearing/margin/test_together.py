"""Bearings at many changed inputs or speeds that are solved together, against each of them by itself."""

import json
import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import brentq

from ehlectric.bearing.bearing_touching import CAPACITIVE, duty_of
from ehlectric.bearing.margin import MarginPoint, QuickMargins, speed_range
from ehlectric.bearing.perturbed_bearings import PARTS, Sampled, alike, over_parts
from ehlectric.bearing.quick_contacts import quick_case
from ehlectric.bearing.result import solve_bearing
from ehlectric.bearing.solution import lambda_ratio
from ehlectric.bearing.solving import quick_solution
from ehlectric.bearing.speed_curves import listed, over_speed
from ehlectric.errors import InputError
from ehlectric.quantities.lubrication_states import BOUNDARY_LIMIT, FULL_FILM_LIMIT
from tests.bearing.intermittency.test_duty import THIN
from tests.helpers.bearings import BALLS, ROLLERS, bearing_case

SPEED = "bearing.inner_speed"
CHANGES = (
    {"bearing.temperature": 333.15},
    {"bearing.radial_load": 1440.0},
    {"bearing.radial_clearance": 5e-6},
    {"bearing.elements": 8},
    {"bearing.inner_speed": 1e-3},  # the surfaces touch
    {"bearing.composite_rq": 6e-8},
    {"motor.rotor_frame_capacitance": 5e-10},
    {"bearing.radial_load": 1e-9, "bearing.axial_load": 0.0},  # below the weight of an element
    {"bearing.radial_load": -1.0},
)


@pytest.fixture(scope="module", params=[("formula", BALLS), ("atlas", BALLS), ("atlas", ROLLERS)])
def margins(request):
    way, tables = request.param
    return QuickMargins.of(solve_bearing(bearing_case(tables, contacts=way), workers=1).solution)


@pytest.mark.slow
def test_margins_together_are_those_of_each(margins):
    """Every change alone is solved by itself; errors have the same words."""
    together = margins.at_all(CHANGES)
    assert [type(one) for one in together[-2:]] == [InputError, InputError]
    assert together[4].margin == 0.0
    for change, found in zip(CHANGES, together, strict=True):
        if isinstance(found, InputError):
            with pytest.raises(InputError) as told:
                margins.at(change)
            assert str(told.value) == str(found)
            continue
        own = margins.at(change)
        assert isinstance(found, MarginPoint)
        assert found.margin == pytest.approx(own.margin, rel=1e-9)
        assert found.lambda_ratio == pytest.approx(own.lambda_ratio, rel=1e-9)


@pytest.mark.slow
@pytest.mark.gate
def test_margins_over_the_speed_are_those_of_single_bearings(margins):
    """A single bearing has floats, and its own path through the equilibrium and the contacts."""
    speeds = margins.case.bearing.inner_speed * np.array([0.5, 1.0, 2.0])
    margin, ratio = margins.at_speeds(speeds)
    quick, _ = quick_case(margins.case, constant=True)
    for k, speed in enumerate(speeds.tolist()):
        solution = quick_solution(quick.replace({SPEED: speed}))
        own = margins.lambda_factor * lambda_ratio(solution)
        assert ratio[k] == pytest.approx(own, rel=1e-9)
    assert (margin[1], ratio[1]) == pytest.approx(
        (margins.solved.margin, margins.solved.lambda_ratio), rel=1e-9
    )


@pytest.mark.slow
def test_crossings_are_those_of_a_search_by_single_bearings(margins):
    """Brent's method to 1e-6 of the speed, one bearing after the other; 0.2 % is what is stated."""
    found, own = speed_range(margins), margins.case.bearing.inner_speed

    def of(value):
        logs = math.log(0.1 * own), math.log(4.0 * own)
        return math.exp(brentq(lambda log: value(margins.at({SPEED: math.exp(log)})), *logs, xtol=1e-6))

    (crossing,), ((_, parted),) = found.crossings, found.partial
    assert crossing == pytest.approx(of(lambda at: math.log(max(at.margin, 1e-9))), rel=2e-4)
    assert parted == pytest.approx(of(lambda at: at.lambda_ratio - FULL_FILM_LIMIT), rel=2e-4)


@pytest.mark.slow
def test_the_capacitive_speed_is_that_of_a_search_by_single_bearings():
    """Brent's method on the share of time with contact of whole single bearings, at two cage positions."""
    result = solve_bearing(bearing_case(BALLS, **THIN), workers=1)
    quick, _ = quick_case(result.case)
    scale = lambda_ratio(result.solution) / lambda_ratio(quick_solution(quick))

    def excess(log):
        at = quick_solution(quick.replace({SPEED: math.exp(log)}))
        share = duty_of(at, film_scale=scale).contact_time_share
        return min(
            math.log(CAPACITIVE / max(share, 1e-12)), math.log(scale * lambda_ratio(at) / BOUNDARY_LIMIT)
        )

    own = math.log(result.case.bearing.inner_speed)
    expected = math.exp(brentq(excess, own - math.log(27.0), own + math.log(27.0), xtol=1e-6))
    assert result.capacitive_speed == pytest.approx(expected, rel=2e-3)


def test_inputs_that_are_no_quantities_stand_apart():
    """A number of elements is the same for all points of a case with arrays; loads are not."""
    case = bearing_case(BALLS, contacts="formula")
    changes = ({"bearing.radial_load": 900.0}, {"bearing.elements": 8}, {"bearing.radial_load": 1200.0})
    groups = {tuple(places.tolist()): one for places, one in alike([case.replace(one) for one in changes])}
    assert sorted(groups) == [(0, 2), (1,)]
    assert groups[0, 2].bearing.radial_load.tolist() == [900.0, 1200.0]


@pytest.mark.slow
@pytest.mark.gate
def test_no_array_is_left_in_a_summary():
    """Every number of a whole answer is a number of Python, which JSON has."""
    result = solve_bearing(bearing_case(BALLS, contacts="formula", ranges={SPEED: ["2500 rpm", "3500 rpm"]}))
    summary = result.summary()
    assert json.loads(json.dumps(summary, allow_nan=False)) == summary
    assert {type(one) for one in summary["margin"].values()} <= {float, str, list, type(None)}


@pytest.mark.slow
def test_numbers_over_the_speed_are_those_of_whole_bearings():
    """Whole bearings have eight cage positions and more loads; 1e-3 is what is stated."""
    case = bearing_case(BALLS, contacts="formula")
    points, left_out = over_speed(case)
    assert not left_out
    points = listed(points, case.bearing.inner_speed)
    assert [speed / case.bearing.inner_speed for speed, _ in points] == pytest.approx(PARTS)
    for speed, summary in (points[0], points[8], points[-1]):
        own = solve_bearing(case.replace({SPEED: speed}), workers=1).summary()
        for key in ("capacitance", "capacitance_air", "lambda_ratio", "shaft_voltage", "first_break"):
            assert summary["bearing"][key] == pytest.approx(own["bearing"][key], rel=1e-3, nan_ok=True)
        assert summary["bearing"]["lubrication_state"] == own["bearing"]["lubrication_state"]
        assert summary["inputs"]["bearing"]["inner_speed"] == speed


def test_the_series_over_the_speed_is_solved_once(monkeypatch):
    """Inputs on which films do not depend, as those of the motor, take their own values all the same."""
    case, _ = quick_case(bearing_case(BALLS, contacts="formula"))
    over_parts(case)
    with monkeypatch.context() as patched:
        patched.delattr("ehlectric.bearing.perturbed_bearings.solved_parts")
        _, several = over_parts(case.replace({"motor.common_mode_voltage": 123.0}))
    assert several.parts[0].solution.case.motor.common_mode_voltage == 123.0
    assert replace(several, parts=()).size == len(PARTS)


def sampled(function, count=14):
    """A function of one quantity, sampled from -1 to 1."""
    log = np.linspace(-1.0, 1.0, count)
    return Sampled(lambda at: function(at)[np.newaxis], log, function(log)[np.newaxis])


@pytest.mark.parametrize(
    ("function", "expected", "error"),
    [
        (lambda x: np.sinh(x - 0.1234), 0.1234, 1e-7),
        (lambda x: np.where(x < 0.5, x - 0.501, 20.0 * (x - 0.5) - 0.001), 0.50005, 2e-3),  # a kink
        (lambda x: np.where(x < 0.3, -1.0, 2.0), 0.3, 2e-3),  # a jump
    ],
)
def test_a_crossing_is_bracketed(function, expected, error):
    one = sampled(function)
    one.refine()
    (found,) = one.crossings(0)
    assert found == pytest.approx(expected, abs=error)
    (k,) = one.brackets(0)
    assert one.log[k + 1] - one.log[k] <= 2e-3


def test_missing_values_have_no_crossing():
    one = sampled(lambda x: np.where(np.abs(x) < 0.5, np.nan, x))
    one.refine()
    assert one.crossings(0) == []
