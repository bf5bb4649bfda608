"""Figures of a sweep: every state of a point is drawn as what it is."""

import json

from ehlectric.app.charts.sweep_charts import chosen_trace, figure_of, place
from ehlectric.app.view_models import Axis, Chart, ChartPoint
from tests.helpers.each import each

STATES = ("failed", "not converged", "do not use", "no value", "open")


def chart(values, margins=None, *, rows=1, log=False):
    """Chart of values in the order of the design; a text is a state without a value."""
    margins = margins or [None] * len(values)
    points = tuple(
        ChartPoint(k, value, (f"point {k}", "why < this"))
        if isinstance(value, str)
        else ChartPoint(k, "solved", (f"point {k}",), value, margin)
        for k, (value, margin) in enumerate(zip(values, margins, strict=True))
    )
    columns = len(values) // rows
    x = Axis("speed [rpm]", tuple(10.0 * 2.0**k for k in range(columns)), log=log)
    y = Axis("load [N]", tuple(1.0 + k for k in range(rows))) if rows > 1 else None
    return Chart(x, y, "breakdown voltage [V]", "margin 1", "applied voltage", points)


def traces(chart, **wanted):
    data = figure_of(chart)["data"]
    return [trace for trace in data if all(trace.get(key) == value for key, value in wanted.items())]


@each("rows", [1, 2])
@each("state", STATES)
def test_points_without_a_number_are_marked_and_never_coloured(rows, state):
    drawn = chart([1.0, 2.0, state, 4.0], rows=rows)
    json.dumps(figure_of(drawn), allow_nan=False)
    (marked,) = [trace for trace in traces(drawn, mode="markers") if trace["customdata"] == [2]]
    assert marked["text"] == ["point 2<br>why &lt; this"]
    (solved,) = traces(drawn, colorscale="Viridis") if rows == 2 else traces(drawn, mode="lines+markers")
    numbers = zip(*solved["z"], strict=True) if rows == 2 else [solved["y"]]
    assert [value for column in numbers for value in column] == [1.0, 2.0, None, 4.0]


def test_second_input_varies_fastest():
    drawn = chart([1.0, 2.0, 3.0, 4.0, 5.0, 6.0], rows=3)
    (coloured,) = traces(drawn, colorscale="Viridis")
    assert coloured["z"] == [[1.0, 4.0], [2.0, 5.0], [3.0, 6.0]]
    assert [place(drawn, number) for number in range(4)] == [(0, 0), (0, 1), (0, 2), (1, 0)]
    assert chosen_trace(drawn, 4)["x"] == [20.0]
    assert chosen_trace(drawn, 4)["y"] == [2.0]
    assert chosen_trace(drawn, None)["x"] == []


def test_line_of_margin_one_is_drawn_only_where_the_margin_crosses_it():
    across = chart([1.0, 2.0, 3.0, 4.0], [0.5, 0.8, 1.5, 2.0], rows=2)
    above = chart([1.0, 2.0, 3.0, 4.0], [1.1, 1.2, 1.5, 2.0], rows=2)
    assert len(traces(across, name="margin 1")) == 1
    (below,) = traces(across, name="margin below 1: breakdown expected")
    assert below["customdata"] == [0, 1]
    assert not traces(above, name="margin 1")
    assert not traces(above, name="margin below 1: breakdown expected")


def test_values_over_decades_have_colours_by_logarithm_and_a_bar_with_their_numbers():
    (coloured,) = traces(chart([1.0, 10.0, 100.0, 1000.0], rows=2), colorscale="Viridis")
    assert coloured["z"] == [[0.0, 2.0], [1.0, 3.0]]
    assert coloured["colorbar"]["ticktext"][0] == "1"
    assert coloured["colorbar"]["ticktext"][-1] == "1000"


def test_logarithmic_axis_has_round_ticks():
    layout = figure_of(chart([1.0, 2.0, 3.0, 4.0], log=True))["layout"]
    assert layout["xaxis"]["type"] == "log"
    assert layout["xaxis"]["tickvals"] == [10.0, 20.0, 50.0]
