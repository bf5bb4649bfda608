"""Numbers outside of their physical bounds leave no solver: the point has an error with the reason."""

from dataclasses import replace

import numpy as np
import pytest

from ehlectric import evaluate, solve_bearing
from ehlectric.bearing.many_points import solved_parts
from ehlectric.bearing.physical_bounds import check_bounds, outside_bounds
from ehlectric.discharge.discharge_laws import MOST_MARGIN
from ehlectric.errors import ConvergenceError, InputError
from tests.helpers.bearings import ROLLERS, bearing_case
from tests.helpers.each import each


def of_two_points():
    """Solution of two points of operation."""
    case = bearing_case(ROLLERS, contacts="formula").with_arrays({"bearing.radial_load": [3e3, 4e3]})
    (part,) = solved_parts(case)
    return part.solution


def with_values(solution, **changed):
    """Solution whose inner contacts have other values at the first position of the cage."""
    first, *others = solution.positions
    values = replace(first.inner.values, **changed)
    first = replace(first, inner=replace(first.inner, values=values))
    return replace(solution, positions=(first, *others))


def scaled(solution, name, factors):
    """Values of the inner contacts of two points, times a factor for each point."""
    return getattr(solution.positions[0].inner.values, name) * np.array(factors)[:, np.newaxis]


def test_a_bearing_is_within_its_bounds():
    assert outside_bounds(of_two_points()).tolist() == [False, False]


@each(("name", "factor"), [("central_thickness", 1e5), ("inside", 1e3)])
def test_a_film_above_the_gap_and_a_capacitance_above_a_plate(name, factor):
    solution = of_two_points()
    wrong = with_values(solution, **{name: scaled(solution, name, [1.0, factor])})
    assert outside_bounds(wrong).tolist() == [False, True]


@each(
    ("name", "factor", "text"),
    [
        ("central_thickness", 1e5, "above the radius of its elements"),
        ("inside", 1e3, "a plate at its minimum"),
    ],
)
def test_the_reason_of_a_single_bearing(name, factor, text):
    solution = solve_bearing(bearing_case(ROLLERS, contacts="formula"), workers=1).solution
    value = factor * getattr(solution.positions[0].inner.values, name)
    with pytest.raises(ConvergenceError, match=text):
        check_bounds(with_values(solution, **{name: value}))


@each(
    ("name", "text"),
    [
        ("inside", "the capacitance of the bearing has no value"),
        ("breakdown_voltage", "the breakdown voltage of the bearing has no value"),
        ("minimum_thickness", "the minimum film of the bearing has no value"),
    ],
)
def test_a_main_number_without_a_value_is_no_result(name, text):
    """It is refused at one of two points, and for a single bearing."""
    both = of_two_points()
    wrong = with_values(both, **{name: scaled(both, name, [1.0, np.nan])})
    assert outside_bounds(wrong).tolist() == [False, True]
    solution = solve_bearing(bearing_case(ROLLERS, contacts="formula"), workers=1).solution
    values = getattr(solution.positions[0].inner.values, name)
    wrong = with_values(solution, **{name: np.where(np.arange(values.size) == 0, np.nan, values)})
    with pytest.raises(ConvergenceError, match=text):
        check_bounds(wrong)


def test_a_margin_of_a_million():
    """The margin is in inverse proportion to the common-mode voltage."""
    case = bearing_case(ROLLERS, contacts="formula")
    margin, volts = solve_bearing(case, workers=1).margin, case.motor.common_mode_voltage
    given = {"motor.common_mode_voltage": [volts * margin / MOST_MARGIN * part for part in (1.01, 0.99)]}
    found = evaluate(case, given)
    assert found["converged"].values.tolist() == [True, False]
    assert found["bearing.margin"].values[0] == pytest.approx(MOST_MARGIN / 1.01, rel=1e-8)
    with pytest.raises(InputError, match=r"motor\.common_mode_voltage: got a margin") as caught:
        solve_bearing(case.replace({key: values[1] for key, values in given.items()}), workers=1)
    assert found["reason"].values[1] == str(caught.value)
    assert np.isnan(found["bearing.capacitance"].values[1])
