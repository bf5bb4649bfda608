"""Figures of a sweep: a map over two inputs, or a line over one, with its points at the pointer."""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from html import escape
from textwrap import wrap

from ehlectric.app.charts.plotly_panels import Plot, map_plot, stack
from ehlectric.app.view_models import ChartPoint
from ehlectric.figures.data import Along, MapPanel, Panel

# Longest line where the pointer is [characters].
_LINE = 60

# Layout of both figures: a legend of long names stands below them.
_LAYOUT: Plot = {
    "font": {"size": 12},
    "margin": {"l": 62, "r": 12, "t": 30, "b": 40},
    "legend": {"orientation": "h", "x": 0.0, "xanchor": "left", "y": -0.2, "yanchor": "top"},
}


def map_figure(panel: MapPanel, points: Sequence[ChartPoint]) -> Plot:
    """Figure of a map, whose cells have the texts and the numbers of its points."""
    return map_plot(panel, [_hover(point) for point in points], **_LAYOUT)


def line_figure(along: Along, panel: Panel, points: Sequence[ChartPoint]) -> Plot:
    """Figure of a line; marks that nobody sees have the texts and the numbers of its points."""
    figure = stack(along, [panel], height=430, hovermode="closest", **_LAYOUT)
    for trace in figure["data"]:
        trace.pop("hovertemplate", None)
        trace["hoverinfo"] = "skip"
    for name in dict.fromkeys(point.axis for point in points):
        there = [point for point in points if point.axis == name]
        seen = {"text": [_hover(point) for point in there], "hovertemplate": "%{text}<extra></extra>"}
        marks = {"type": "scatter", "mode": "markers", "yaxis": name, "marker": {"size": 14, "opacity": 0.0}}
        at = {"x": [point.place[0] for point in there], "y": [point.place[1] for point in there]}
        numbers = {"customdata": [point.number for point in there], "showlegend": False}
        figure["data"].append(marks | at | seen | numbers)
    return figure


def _hover(point: ChartPoint) -> str:
    return "<br>".join(map(_folded, point.texts))


@lru_cache(maxsize=4096)
def _folded(text: str) -> str:
    """Text in lines; many points have the same warnings."""
    return "<br>".join(escape(line, quote=False) for line in wrap(text, _LINE))
