"""Lines of a sweep of bearings between its points, against bearings at 200 random places."""

from dataclasses import replace

import matplotlib as mpl
import numpy as np
import pytest

from ehlectric import Sweep, run_sweep
from ehlectric.bearing.many_points import columns_of
from ehlectric.figures.sweep_lines import value_lines
from ehlectric.figures.sweep_panels import LinePath, lines_of
from ehlectric.sweep.computed_lines import computed_line
from ehlectric.sweep.slices import select_slice
from tests.bearing.curves.test_computed_curves import SPEED, random_between, rollers

mpl.use("Agg")

TEMPERATURE = "bearing.temperature"
VALUES = (
    "bearing.capacitance",
    "bearing.first_break",
    "bearing.ring_to_ring_breakdown",
    "bearing.lambda_ratio",
)


@pytest.fixture(scope="module")
def results(tmp_path_factory):
    """Seven speeds, at some of which the summits touch, and two temperatures."""
    vary = {
        SPEED: {"from": "300 rpm", "to": "6000 rpm", "count": 7, "spacing": "log"},
        TEMPERATURE: ["60 degC", "75 degC"],
    }
    sweep = Sweep.from_dict({"case": rollers(), "vary": vary})
    return run_sweep(sweep, tmp_path_factory.mktemp("lines"), workers=1)


@pytest.mark.slow
@pytest.mark.parametrize("value", VALUES)
def test_lines_of_quick_bearings_are_the_bearings_between_the_points(results, value):
    selection = select_slice(results, SPEED, TEMPERATURE, value)
    path = LinePath(results, selection, True, False)
    for line in lines_of(results, selection)[0]:
        x, drawn = path.values(line)
        speeds = random_between(x[0], x[-1])
        case = results.case.replace({TEMPERATURE: line.value})
        direct = columns_of(case.with_arrays({SPEED: speeds})).values[value]
        between = np.exp(np.interp(np.log(speeds), np.log(x), np.log(drawn)))
        known = np.isfinite(direct) & np.isfinite(between)
        assert np.count_nonzero(np.isfinite(direct) != np.isfinite(between)) <= 1
        error = np.abs(between - direct)[known]
        assert np.all(error < 0.01 * direct[known] + 3e-3 * np.max(direct[known]))
        points = [point.inputs[SPEED] for point in results.points if point.inputs[TEMPERATURE] == line.value]
        assert set(np.round(points, 9)) <= set(np.round(x, 9))
    value_lines(results, SPEED, TEMPERATURE, value)


@pytest.mark.slow
def test_lines_of_other_points_are_interpolated(results):
    """Numbers of another version, a point without a result, and contacts that are solved."""
    selection = select_slice(results, SPEED, TEMPERATURE, "bearing.capacitance")
    (_, numbers), _ = selection.series()
    how = {"log_x": True, "log": True}
    assert computed_line(results, selection, numbers, **how) is not None
    changed = replace(selection, values=1.01 * selection.values)
    assert computed_line(results, changed, numbers, **how) is None
    failed = replace(selection.points[0], status="failed", summary=None)
    points = (failed, *selection.points[1:])
    assert computed_line(results, replace(selection, points=points), numbers, **how) is None
    solved = replace(results, case=results.case.replace({"contacts": "solved"}))
    assert computed_line(solved, selection, numbers, **how) is None
