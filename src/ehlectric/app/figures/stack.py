"""Panels of figures that are data, drawn by Plotly above each other, with one axis along which they zoom."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from ehlectric.app.figures.look import Plot, axis, log_ticks, plot, thinned, values, vertical
from ehlectric.arrays import Array, Mask
from ehlectric.figures.data import Along, Area, Curve, Panel, Upright
from ehlectric.quantities.palette import MIDDLE_GREY, faint

# Height of a panel, and gap between panels as a part of the height of the figure [px].
_PANEL, _GAP = 190, 0.05

# Text before the signs of the axes; Plotly numbers axes from the second on. Behind them, those of the hidden
# axes from 0 to 1 over each panel.
_AXES, _HIDDEN = ("y", "y2", "y3", "y4"), ("y11", "y12", "y13", "y14")

# Pixels of a line that is a point wide, and largest number of intervals of a curve whose extremes are kept.
_PIXELS, _INTERVALS = 5.0 / 3.0, 1500


def stack(along: Along, panels: Sequence[Panel], *, converged: bool = True, **more: Any) -> Plot:
    """Figure with at most four panels, in which the pointer shows the values of all of them at one position.

    Of a result that did not converge, all curves are grey, and words across the figure say so; ``more`` are
    further keys of the layout.
    """
    layout: dict[str, Any] = {
        "xaxis": axis(
            f"{along.name} [{along.unit}]",
            anchor=_AXES[len(panels) - 1],
            unifiedhovertitle={"text": f"{along.name} = %{{x:.5g}} {along.unit}"},
            **({"range": list(along.window)} if along.window else {}),
            **log_ticks(log=along.log),
        ),
        "hovermode": "x unified",
        "hoversubplots": "axis",
        "hoverdistance": 30,
        "shapes": [vertical(edge, layer="below") for edge in along.edges],
        "height": _PANEL * len(panels) + 110,
    }
    share = (1.0 - _GAP * (len(panels) - 1)) / len(panels)
    data: list[Plot] = []
    for number, panel in enumerate(panels):
        top, name, hidden = 1.0 - number * (share + _GAP), _AXES[number], _HIDDEN[number]
        domain = {"domain": [max(0.0, top - share), top], "anchor": "x"}
        ends = {} if panel.log else {"range": [panel.bottom, panel.top]}
        title = f"{panel.title}{'<br>' if len(panels) > 1 else ' '}[{panel.unit}]"
        layout["yaxis" + name[1:]] = axis(title, **domain, **ends, **log_ticks(log=panel.log))
        for area in panel.areas:
            data += _shaded(area, name, hidden)
        data += [_trace(curve, panel, name, converged=converged) for curve in panel.curves]
        data += [_upright(line, hidden) for line in panel.uprights]
        if panel.areas or panel.uprights:
            whole = {"overlaying": name, "range": [0.0, 1.0], "visible": False, "fixedrange": True}
            layout["yaxis" + hidden[1:]] = whole | domain
    return plot(data, converged=converged, **layout | more)


def _trace(curve: Curve, panel: Panel, axis_name: str, *, converged: bool) -> Plot:
    colour = curve.colour if converged else MIDDLE_GREY
    kept = thinned([curve.y], _INTERVALS)
    trace: Plot = {
        "type": "scatter",
        "x": values(curve.x[kept]),
        "y": values(curve.y[kept]),
        "yaxis": axis_name,
        "name": curve.name,
        "showlegend": bool(curve.name),
    }
    if curve.marker:
        marker: Plot = {"color": colour, "size": 6}
        if curve.marker == "ring":
            marker = {"color": "rgba(0,0,0,0)", "size": 9, "line": {"color": colour, "width": 2}}
        if curve.marker == "star":
            marker |= {"symbol": "star", "size": 15, "line": {"color": "white", "width": 1}}
        trace |= {"mode": "markers", "marker": marker}
    else:
        line = {"color": colour, "dash": curve.dash, "width": _PIXELS * curve.width}
        trace |= {"mode": "lines", "line": line}
    # The name of a single mark has its value.
    if not curve.name or curve.x.size == 1:
        return trace | {"hoverinfo": "skip"}
    return trace | {"hovertemplate": f"%{{y:.4g}} {panel.unit}<extra>{curve.name}</extra>"}


def _shaded(area: Area, axis_name: str, hidden: str) -> Iterator[Plot]:
    """Outlines of the spans of an area, filled; the first one is in the legend."""
    look: Plot = {"fillcolor": faint(area.colour, area.opacity)}
    if area.hatched:
        look["fillpattern"] = {"shape": "/", "size": 8, "fgcolor": area.colour, "fgopacity": 0.5}
        look["fillpattern"]["bgcolor"] = look["fillcolor"]
    for k, span in enumerate(_spans(area.within)):
        x = area.x[span]
        low, high = (np.zeros_like(x), np.ones_like(x)) if area.ends is None else area.ends
        if area.ends is not None:
            low, high = low[span], high[span]
        yield {
            "type": "scatter",
            "mode": "lines",
            "x": values(_around(x, x)),
            "y": values(_around(low, high)),
            "yaxis": hidden if area.ends is None else axis_name,
            "fill": "toself",
            "line": {"width": 0},
            "hoverinfo": "skip",
            "name": area.name,
            "showlegend": bool(area.name) and k == 0,
            **look,
        }


def _spans(within: Mask) -> Iterator[slice]:
    """Nodes of the intervals in which a condition holds."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], within, [False]])))
    for begin, end in zip(edges[::2], edges[1::2], strict=True):
        yield slice(int(begin), int(end))


def _around(low: Array, high: Array) -> Array:
    return np.concatenate([low, high[::-1], low[:1]])


def _upright(line: Upright, hidden: str) -> Plot:
    return {
        "type": "scatter",
        "mode": "lines",
        "x": values([line.at] * 2),
        "y": [0.0, 1.0],
        "yaxis": hidden,
        "name": line.name,
        "line": {"color": line.colour, "width": 2.0, "dash": line.dash},
        "hoverinfo": "skip",
    }


def names_of(panels: Sequence[Panel]) -> Iterator[str]:
    """Names of the quantities of panels, for a text that says what a figure shows."""
    for panel in panels:
        yield f"{panel.title} in {panel.unit}"
