"""Figures of a sweep: every state of a point is drawn as what it is, and pages have the numbers of files."""

import json

import numpy as np
import pytest
from matplotlib.figure import Figure

from ehlectric.app.charts.plotly_panels import STRIP_AXIS, plain
from ehlectric.app.compute.sweep_answers import view_of
from ehlectric.app.pages.sweep_page import chosen_trace
from ehlectric.figures.sweep_lines import value_lines
from ehlectric.figures.sweep_maps import draw_map, value_map
from ehlectric.figures.sweep_panels import lines_panel, map_panel
from ehlectric.sweep.slices import select_slice, whole
from tests.figures.sweep.test_save import VALUE, curves, line_of_breakdown
from tests.helpers.each import each
from tests.helpers.sweep_models import LOAD, POTENTIAL, SPEED, breakdown, doubtful_where, grid

SPEEDS, LOADS = (0.5, 1.0, 2.0, 4.0), (2e5, 5e5)

# State of the third of four speeds, and its name in legends.
STATES = {
    "failed": "1 failed",
    "not converged": "1 not converged",
    "do not use": "1 must not be used",
    "no value": "1 without this value",
    "open": "1 not tried yet",
}


def swept(state="", loads=(2e5,)):
    """Breakdown voltages over the speed; at 2 m/s and the first load the point has the state."""

    def wrong(inputs):
        return inputs[SPEED] == 2.0 and inputs.get(LOAD, loads[0]) == loads[0]

    def model(inputs):
        return {"film": {}} if state == "no value" and wrong(inputs) else breakdown(inputs)

    severe = doubtful_where(wrong, model) if state == "do not use" else model
    status = state if state in ("failed", "not converged", "open") else "solved"
    axes = {SPEED: SPEEDS} | ({LOAD: loads} if len(loads) > 1 else {})
    return grid(axes, severe, status=lambda inputs: status if wrong(inputs) else "solved")


def traces(results, value=VALUE, **keys):
    data = view_of(results, value).figure["data"]
    return [trace for trace in data if all(trace.get(key) == one for key, one in keys.items())]


@each("loads", [(2e5,), LOADS])
@each("state", list(STATES))
def test_points_without_a_number_are_marked_and_never_coloured(loads, state):
    results = swept(state, loads)
    view = view_of(results, VALUE)
    json.dumps(view.figure, allow_nan=False)
    number = 2 * len(loads)
    assert [point.number for point in view.chart.points if point.value is None] == [number]
    (marked,) = traces(results, name=STATES[state])
    assert marked["x"] == [2.0]
    assert marked["y"] == [0.2] if len(loads) > 1 else marked["yaxis"] == STRIP_AXIS
    if len(loads) > 1:
        (solved,) = traces(results, colorscale="Viridis")
        drawn = [value for column in zip(*solved["z"], strict=True) for value in column]
        # The pointer reaches the cells with a value, and the grey ones.
        parts = [trace for trace in view.figure["data"] if "customdata" in trace]
        seen = [
            zip(*(np.ravel(part[key]) for key in ("customdata", "text", "z")), strict=True) for part in parts
        ]
        texts = {n: text for part in seen for n, text, z in part if z is not None}
    else:
        (dots,) = traces(results, name="3 points")
        known = dict(zip(dots["x"], dots["y"], strict=True))
        drawn = [known.get(speed) for speed in SPEEDS]
        seen = [trace for trace in view.figure["data"] if "customdata" in trace]
        texts = {n: text for part in seen for n, text in zip(part["customdata"], part["text"], strict=True)}
    expected = results.values(VALUE)
    for k, value in enumerate(drawn):
        assert value is None if k == number else value == pytest.approx(expected[k], rel=1e-6)
    assert sorted(texts) == list(range(len(results.points)))
    assert state in texts[number]
    assert f"Breakdown voltage: {expected[0]:.4g} V" in texts[0]


def test_texts_at_the_pointer_make_no_html():
    results = grid({SPEED: (1.0, 2.0)}, status=lambda _: "failed")
    view = view_of(results, "<b>")
    assert "<b>" not in json.dumps(view.figure["data"]).replace("<br>", "")


def test_second_input_varies_fastest():
    results = grid({SPEED: (10.0, 20.0), LOAD: (1e6, 2e6, 3e6)})
    (coloured,) = traces(results, colorscale="Viridis")
    assert coloured["customdata"] == [[0, 3], [1, 4], [2, 5]]
    expected = results.values(VALUE).reshape(2, 3).T
    np.testing.assert_allclose(coloured["z"], expected, rtol=1e-6)
    chart = view_of(results, VALUE).chart
    assert chart.shape == (2, 3)
    assert (chosen_trace(chart, 4)["x"], chosen_trace(chart, 4)["y"]) == ([20.0], [2.0])
    assert chosen_trace(chart, None)["x"] == []


def test_line_of_margin_one_is_drawn_only_where_the_margin_crosses_it():
    """At 5 V, V_b = 10 V (u/(4 m/s))^0.7 (w/(1 MN/m))^-0.1 is below it at the two slowest speeds."""
    across = grid({SPEED: SPEEDS, LOAD: (1e6, 2e6)})
    assert len(traces(across, name="margin 1 at 5 V")) == 1
    (below,) = traces(across, name="margin below 1: breakdown expected")
    assert list(zip(below["x"], below["y"], strict=True)) == [(0.5, 1.0), (0.5, 2.0), (1.0, 1.0), (1.0, 2.0)]
    above = grid({SPEED: (4.0, 8.0), LOAD: (1e6, 2e6)})
    assert not traces(above, name="margin 1 at 5 V")
    assert not traces(above, name="margin below 1: breakdown expected")


def test_values_over_decades_have_colours_by_logarithm_and_a_bar_with_their_numbers():
    def model(inputs):
        return {"film": {"minimum_thickness": 1e-6 * inputs[SPEED]}}

    results = grid({SPEED: (1.0, 10.0, 100.0, 1000.0), LOAD: LOADS}, model)
    (coloured,) = traces(results, "film.minimum_thickness", colorscale="Viridis")
    np.testing.assert_allclose(coloured["z"][0], [-3.0, -2.0, -1.0, 0.0], atol=1e-9)
    assert coloured["colorbar"]["title"]["text"] == "minimum film thickness [mm]"
    assert coloured["colorbar"]["ticktext"][0] == "0.001"
    assert coloured["colorbar"]["ticktext"][-1] == "1"


def test_logarithmic_axis_has_round_ticks():
    layout = view_of(grid({SPEED: (10.0, 20.0, 40.0, 80.0), LOAD: LOADS}), VALUE).figure["layout"]
    assert layout["xaxis"]["type"] == "log"
    assert layout["xaxis"]["tickvals"] == [10.0, 20.0, 50.0]


def test_a_map_has_the_same_numbers_in_files_and_on_pages():
    """Values, names, units and the line on which the margin is 1."""
    results = grid({SPEED: SPEEDS, LOAD: (2e5, 5e5, 2e6)})
    panel = map_panel(results, select_slice(results, SPEED, LOAD, VALUE))
    np.testing.assert_allclose(panel.values, results.values(VALUE))
    ax, view = value_map(results, SPEED, LOAD, VALUE), view_of(results, VALUE)
    layout = view.figure["layout"]
    (coloured,) = traces(results, colorscale="Viridis")
    for along, file, page in (
        (panel.axes[0], ax.get_xlabel(), layout["xaxis"]["title"]["text"]),
        (panel.axes[1], ax.get_ylabel(), layout["yaxis"]["title"]["text"]),
        (panel, ax.child_axes[0].get_ylabel(), coloured["colorbar"]["title"]["text"]),
    ):
        name = along.title if along is panel else along.name
        assert file == f"{name} [{along.unit}]"
        assert page == plain(name, along.unit)
    assert coloured["colorbar"]["title"]["text"] == "breakdown voltage [V]"
    (line,) = traces(results, name="margin 1 at 5 V")
    margins = 10.0 ** np.array(line["z"], dtype=float)
    speeds, loads = np.meshgrid(line["x"], line["y"])
    np.testing.assert_allclose(margins, 2.0 * (speeds / 4.0) ** 0.7 * loads**-0.1, rtol=1e-4)
    # The line of the file goes through the margins of the page.
    for x, y in line_of_breakdown(ax)[::7]:
        assert 2.0 * (x / 4.0) ** 0.7 * y**-0.1 == pytest.approx(1.0, rel=2e-3)
    again = Figure().subplots()
    draw_map(panel, again)
    assert [t.get_text() for t in again.get_legend().texts] == [t.get_text() for t in ax.get_legend().texts]


def test_a_line_has_the_same_numbers_in_files_and_on_pages():
    """Between the points too, and the applied voltage, V_2 + 1 V."""
    results = grid({POTENTIAL: (1.0, 2.0, 4.0)})
    along, panel = lines_panel(results, select_slice(results, POTENTIAL, None, VALUE))
    ax, layout = value_lines(results, POTENTIAL, None, VALUE), view_of(results, VALUE).figure["layout"]
    assert ax.get_xlabel() == f"{along.name} [{along.unit}]"
    assert layout["xaxis"]["title"]["text"] == plain(along.name, along.unit) == "potential of surface 2 [V]"
    assert ax.get_ylabel() == f"{panel.title} [{panel.unit}]"
    assert layout["yaxis"]["title"]["text"] == plain(panel.title, panel.unit) == "breakdown voltage [V]"
    (page,) = traces(results, name="applied voltage 2 to 5 V")
    (file,) = curves(ax, "--")
    np.testing.assert_allclose(page["x"], file.get_xdata(), rtol=1e-6)
    np.testing.assert_allclose(page["y"], np.array(page["x"]) + 1.0, rtol=1e-6)
    np.testing.assert_allclose(page["y"], file.get_ydata(), rtol=1e-6)


def test_where_nothing_is_solved_there_is_a_map_of_open_points():
    results = grid({SPEED: SPEEDS, LOAD: LOADS}, status=lambda _: "open")
    assert not np.any(np.isfinite(whole(results, VALUE).values))
    (marked,) = traces(results, name="8 not tried yet")
    assert len(marked["x"]) == 8
    assert not traces(results, colorscale="Viridis")
    assert traces(grid({SPEED: SPEEDS}, status=lambda _: "open"), name="4 not tried yet")
