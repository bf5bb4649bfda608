"""Figures of an axle for its page: voltages of all elements over their breakdown voltages."""

from __future__ import annotations

import math

from ehlectric.app.charts.plotly_panels import INK, axis, log_ticks, plot
from ehlectric.app.view_models import Figure
from ehlectric.axle import AxleResult
from ehlectric.quantities.palette import BLUE, ORANGE
from ehlectric.readable import readable

# Height of a row, and of what surrounds the rows [px].
_ROW, _REST = 34, 110

# Part of the axis at its ends.
_ROOM = 1.6


def ratios_figure(result: AxleResult) -> Figure:
    """Bar of each element with a breakdown voltage, the first element on top; a line extends between the
    values for all meshes conducting and no mesh conducting.
    """
    solution = result.solution
    ratios = {name: ratio for name, ratio in solution.ranking() if ratio > 0.0}
    bounds = [dict(solution.ranking(conduction)) for conduction in ("always", "never")]
    names = list(ratios)
    labels = {name: f"{name}: {readable(ratios[name], 3)}" for name in names}
    positive = [value for table in (ratios, *bounds) for value in table.values() if value > 0.0]
    ends = (min([*positive, 1.0]) / _ROOM, max([*positive, 1.0]) * _ROOM)
    data = [
        {
            "type": "bar",
            "orientation": "h",
            "x": [float(f"{value:.4g}") for value in ratios.values()],
            "y": [*labels.values()],
            "marker": {"color": [ORANGE, *[BLUE] * (len(names) - 1)]},
            "hovertemplate": "%{y}<extra></extra>",
        }
    ]
    for name in names:
        both = [table[name] for table in bounds if table.get(name, 0.0) > 0.0]
        if len(both) == 2:
            data.append(
                {
                    "type": "scatter",
                    "mode": "lines+markers",
                    "x": both,
                    "y": [labels[name]] * 2,
                    "line": {"color": INK, "width": 2},
                    "marker": {"symbol": "line-ns-open", "size": 9, "color": INK},
                    "hoverinfo": "skip",
                }
            )
    limit = {"type": "line", "x0": 1.0, "x1": 1.0, "yref": "paper", "y0": 0.0, "y1": 1.0}
    first = f"{names[0]} first, {readable(ratios[names[0]])}" if names else "no element has a voltage"
    return Figure(
        "Voltage after an edge / breakdown voltage",
        f"Bar of each bearing and mesh: {first}.",
        plot(
            data,
            height=_REST + _ROW * max(1, len(names)),
            showlegend=False,
            xaxis=axis("U / V_b")
            | log_ticks(log=True, ends=ends)
            | {"range": [math.log10(end) for end in ends]},
            yaxis=axis() | {"autorange": "reversed", "type": "category"},
            shapes=[limit | {"line": {"color": INK, "width": 1, "dash": "dash"}}],
            bargap=0.35,
        ),
        caption="Above 1 the element breaks down. A line extends between the values for all meshes conducting"
        " and no mesh conducting.",
    )
