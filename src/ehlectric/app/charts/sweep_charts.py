"""Figures of a sweep: a map over two inputs, or a line over one, as data for Plotly."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from functools import lru_cache
from html import escape
from textwrap import wrap
from typing import Any

from ehlectric.app.view_models import Axis, Chart, ChartPoint, PointState
from ehlectric.quantities.palette import AMBER, BLUE, MIDDLE_GREY, ORANGE
from ehlectric.readable import readable

# Colours of no value are greys, so that they are never read as numbers. Every state has a marker too.
_MARKERS: Mapping[PointState, tuple[str, str, str]] = {
    "failed": ("x", ORANGE, "refused or failed"),
    "not converged": ("diamond-open", ORANGE, "not converged: no value drawn"),
    "do not use": ("triangle-up-open", AMBER, "solved, but do not use"),
    "no value": ("circle-open", AMBER, "solved, no such number"),
    "open": ("circle", "#999999", "not solved yet"),
}

# Ratio of the largest to the smallest value above which colours follow the logarithm.
_WIDE = 30.0

# Longest line where the pointer is [characters].
_LINE = 60

# Number of points up to which markers are large.
_FEW = 400

_SELECTED = "chosen point"

# Keys of a trace without a bar of colours and without a text at the pointer.
_SILENT: Mapping[str, Any] = {"showscale": False, "hoverinfo": "skip"}


def figure_of(chart: Chart, chosen: int | None = None) -> dict[str, Any]:
    """Figure of a sweep: a map over two inputs, a line over one. Returns data, layout and settings for
    Plotly.
    """
    traces = _map(chart) if chart.y is not None else _line(chart)
    return {
        "data": [*traces, chosen_trace(chart, chosen)],
        "layout": _layout(chart),
        "config": {"displaylogo": False, "responsive": True, "scrollZoom": False},
    }


def chosen_trace(chart: Chart, chosen: int | None) -> dict[str, Any]:
    """Trace that marks the chosen point; without one it is empty."""
    some = [] if chosen is None else [chart.points[chosen]]
    look = {"symbol": "square-open", "size": 16, "color": ORANGE, "line": {"width": 3}}
    below = chart.y is None and any(point.value is None for point in some)
    return _dots(chart, some, _SELECTED, look, below=below) | {"hoverinfo": "skip", "showlegend": False}


def place(chart: Chart, number: int) -> tuple[int, int]:
    """Positions of a point along the two axes; 0 for the second where there is none.

    The values of the second input vary fastest.
    """
    return divmod(number, len(chart.y.values) if chart.y is not None else 1)


def _map(chart: Chart) -> list[dict[str, Any]]:
    traces = [_cells(chart)]
    if values := _known(chart):
        log = _is_wide(values)
        traces.append(_coloured(chart, values, log=log))
        # Lines of equal value between a few solved points would move with every further one.
        whole = not any(point.state == "open" for point in chart.points)
        traces += [_levels(chart)] if whole and not log else []
        traces += [*_critical(chart), *_below(chart)]
    return traces + _states(chart)


def _known(chart: Chart) -> list[float]:
    """Values of the points that have one."""
    return [point.value for point in chart.points if point.value is not None]


def _is_wide(values: Sequence[float]) -> bool:
    """Whether colours, or the axis of the values, follow the logarithm."""
    return bool(values) and min(values) > 0.0 and max(values) > _WIDE * min(values)


def _cells(chart: Chart) -> dict[str, Any]:
    """Grey cells of points that were tried and have no number to draw."""
    tried = [None if point.state in ("solved", "open") else 1.0 for point in chart.points]
    return {
        "type": "heatmap",
        **_axes_of_cells(chart),
        "z": _grid(chart, tried),
        "colorscale": [[0.0, MIDDLE_GREY], [1.0, MIDDLE_GREY]],
        "opacity": 0.35,
        **_SILENT,
    }


def _coloured(chart: Chart, values: Sequence[float], *, log: bool) -> dict[str, Any]:
    bar: dict[str, Any] = {
        "title": {"text": chart.title, "side": "right"},
        "thickness": 14,
        "outlinewidth": 0,
    }
    if log:
        ticks = _ticks(min(values), max(values))
        bar |= {
            "tickvals": [math.log10(tick) for tick in ticks],
            "ticktext": [readable(t, 4) for t in ticks],
        }
    return {
        "type": "heatmap",
        **_axes_of_cells(chart),
        "z": _grid(chart, [_log(point.value) if log else point.value for point in chart.points]),
        "text": _grid(chart, [_hover(point) for point in chart.points]),
        "customdata": _grid(chart, [point.number for point in chart.points]),
        "hovertemplate": "%{text}<extra></extra>",
        "hoverongaps": False,
        "colorscale": "Viridis",
        "colorbar": bar,
        "name": chart.title,
    }


def _levels(chart: Chart) -> dict[str, Any]:
    """Lines of equal value with their numbers."""
    return {
        "type": "contour",
        **_axes_of_cells(chart),
        "z": _grid(chart, [point.value for point in chart.points]),
        "contours": {
            "coloring": "none",
            "showlabels": True,
            "labelfont": {"color": "#ffffff", "size": 11},
            "labelformat": ".4~g",
        },
        "line": {"color": "rgba(255,255,255,0.75)", "width": 1},
        "autocontour": True,
        "ncontours": 8,
        "connectgaps": False,
        "showlegend": False,
        **_SILENT,
    }


def _critical(chart: Chart) -> list[dict[str, Any]]:
    """Line along which the margin is 1, red within white; none where the margin does not cross 1."""
    margins = [point.margin for point in chart.points if point.margin is not None]
    if not margins or not min(margins) < 1.0 < max(margins):
        return []
    line: dict[str, Any] = {
        "type": "contour",
        **_axes_of_cells(chart),
        # By logarithms, as margins are nearly powers of speed and load.
        "z": _grid(chart, [_log(point.margin) for point in chart.points]),
        "contours": {"coloring": "none", "start": 0.0, "end": 0.0, "size": 1.0},
        "autocontour": False,
        "connectgaps": False,
        **_SILENT,
    }
    halo = line | {"line": {"color": "#ffffff", "width": 6}, "showlegend": False}
    return [
        halo,
        line | {"line": {"color": ORANGE, "width": 3}, "showlegend": True, "name": chart.critical},
    ]


def _below(chart: Chart) -> list[dict[str, Any]]:
    """Markers of the points whose margin is below 1, so that the side of the line is told."""
    some = [point for point in chart.points if point.margin is not None and point.margin < 1.0]
    if not some:
        return []
    edge = {"width": 1, "color": "#000000"}
    size = 8 if len(chart.points) <= _FEW else 4
    look = {"symbol": "triangle-down", "size": size, "color": "#ffffff", "line": edge}
    # The pointer reaches the cell below.
    dots = _dots(chart, some, "margin below 1: breakdown expected", look, below=False)
    return [{key: value for key, value in dots.items() if key != "text"} | {"hoverinfo": "skip"}]


def _line(chart: Chart) -> list[dict[str, Any]]:
    solved = {
        "type": "scatter",
        "mode": "lines+markers",
        "x": list(chart.x.values),
        "y": [point.value for point in chart.points],
        "text": [_hover(point) for point in chart.points],
        "customdata": [point.number for point in chart.points],
        "hovertemplate": "%{text}<extra></extra>",
        "connectgaps": False,
        "line": {"color": BLUE, "width": 2},
        "marker": {"size": 8},
        "name": chart.title,
    }
    voltages = [point.voltage for point in chart.points]
    traces: list[dict[str, Any]] = [solved]
    if any(voltage is not None for voltage in voltages):
        dashed = {"color": ORANGE, "width": 2, "dash": "dash"}
        applied = {"type": "scatter", "mode": "lines", "x": list(chart.x.values), "y": voltages}
        traces.append(applied | {"line": dashed, "name": chart.voltage, "hoverinfo": "y"})
    return traces + _states(chart)


def _states(chart: Chart) -> list[dict[str, Any]]:
    """Markers of the points without a number to draw, a trace for each state."""
    traces = []
    for state, (symbol, colour, name) in _MARKERS.items():
        some = [point for point in chart.points if point.state == state]
        if some:
            size = 4 if state == "open" else 9
            look = {"symbol": symbol, "color": colour, "size": size, "line": {"width": 2, "color": colour}}
            traces.append(_dots(chart, some, name, look, below=chart.y is None))
    return traces


def _dots(
    chart: Chart, points: Sequence[ChartPoint], name: str, look: Mapping[str, Any], *, below: bool
) -> dict[str, Any]:
    """Points as markers: at their place on a map; on a line at their value, or below at the axis."""
    places = [place(chart, point.number) for point in points]
    if chart.y is not None:
        ys: list[Any] = [chart.y.values[j] for _, j in places]
    else:
        ys = [0.04 if below else point.value for point in points]
    return {
        "type": "scatter",
        "mode": "markers",
        "x": [chart.x.values[i] for i, _ in places],
        "y": ys,
        "yaxis": "y2" if below else "y",
        "text": [_hover(point) for point in points],
        "customdata": [point.number for point in points],
        "hovertemplate": "%{text}<extra></extra>",
        "marker": dict(look),
        "name": name,
        "showlegend": True,
    }


def _layout(chart: Chart) -> dict[str, Any]:
    layout: dict[str, Any] = {
        "paper_bgcolor": "rgba(0,0,0,0)",
        "plot_bgcolor": "rgba(0,0,0,0)",
        # The buttons of the figure stand above the map, and not on the title of its colours.
        "margin": {"l": 60, "r": 10, "t": 40, "b": 50},
        "xaxis": _axis(chart.x),
        "yaxis": _axis(chart.y) if chart.y is not None else {"title": {"text": chart.title}},
        "legend": {"orientation": "h", "x": 0.0, "y": -0.22, "yanchor": "top"},
        "hoverlabel": {"align": "left"},
        "hovermode": "closest",
        "uirevision": "same",
        "autosize": True,
    }
    if chart.y is None:
        if _is_wide(_known(chart)):
            layout["yaxis"]["type"] = "log"
        layout["yaxis"]["zeroline"] = False
        layout["yaxis2"] = {"range": [0.0, 1.0], "overlaying": "y", "visible": False, "fixedrange": True}
    return layout


def _axis(axis: Axis) -> dict[str, Any]:
    kind = "log" if axis.log else "linear"
    about: dict[str, Any] = {
        "title": {"text": axis.title},
        "type": kind,
        "zeroline": False,
        "automargin": True,
    }
    if axis.log and min(axis.values) > 0.0:
        ticks = _ticks(min(axis.values), max(axis.values))
        about |= {
            "tickmode": "array",
            "tickvals": ticks,
            "ticktext": [readable(tick, 6) for tick in ticks],
        }
    return about


def _axes_of_cells(chart: Chart) -> dict[str, Any]:
    return {"x": list(chart.x.values), "y": list(chart.y.values) if chart.y is not None else [0.0]}


def _grid(chart: Chart, values: Sequence[Any]) -> list[list[Any]]:
    """Values of the points in rows of the second input."""
    rows = len(chart.y.values) if chart.y is not None else 1
    return [list(values[row::rows]) for row in range(rows)]


def _hover(point: ChartPoint) -> str:
    return "<br>".join(map(_folded, point.texts))


@lru_cache(maxsize=4096)
def _folded(text: str) -> str:
    """Text in lines; many points have the same warnings."""
    return "<br>".join(escape(line, quote=False) for line in wrap(text, _LINE))


def _log(value: float | None) -> float | None:
    return math.log10(value) if value is not None and value > 0.0 else None


def _ticks(low: float, high: float) -> list[float]:
    """Numbers 1, 2 and 5 of each decade within two ends; over many decades only 1."""
    decades = range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)
    parts = (1.0, 2.0, 5.0) if len(decades) <= 4 else (1.0,)
    found = [float(f"{part * 10.0**decade:.3g}") for decade in decades for part in parts]
    within = [tick for tick in found if low * 0.999 <= tick <= high * 1.001]
    return within if len(within) > 1 else [low, high]
