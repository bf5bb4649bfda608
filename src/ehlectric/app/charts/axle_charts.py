"""Figures of an axle for its page: voltages of all elements over their breakdown voltages."""

from __future__ import annotations

import math

from ehlectric.app.charts.plotly_panels import INK, axis, log_ticks, plot, stack
from ehlectric.app.view_models import Figure, Table
from ehlectric.axle import CONDUCTIONS, AxleResult
from ehlectric.errors import printable
from ehlectric.figures.axle_discharges import discharge_panels, discharges_finding
from ehlectric.quantities.lubrication_states import TOUCHES
from ehlectric.quantities.palette import BLUE, ORANGE
from ehlectric.quantities.rows import Summary
from ehlectric.readable import readable

# Height of a row, and of what surrounds the rows [px].
_ROW, _REST = 34, 110

# Factors to the ends of the axes of ratios and of rates.
_ROOM, _WIDER = 1.6, 3.0

# Largest number of panels of a figure over time.
_PANELS = 4


def simulated_figures(result: AxleResult, summary: Summary) -> dict[str, Figure]:
    """Figures of the discharges of an axle over time; none without a simulated time."""
    if result.discharges is None:
        return {}
    figures = {"rates": _rates_figure(result, summary["simulation"])}
    if len(result.discharges.record.trace) > 1:
        figures["shaft-voltages"] = _voltages_figure(result)
    return figures


def _rates_figure(result: AxleResult, simulation: Summary) -> Figure:
    """Discharges per second of all elements, with bounds of 95 %; an upper bound without a discharge."""
    rows = sorted(simulation["elements"], key=lambda row: -float(row["events_per_second"]))
    names = [printable(row["element"]) for row in rows]
    values = [row["events_per_second"] or row["events_per_second_high"] for row in rows]
    lows = [
        value - row["events_per_second_low"] if row["events"] else 0.0
        for value, row in zip(values, rows, strict=True)
    ]
    highs = [row["events_per_second_high"] - value for value, row in zip(values, rows, strict=True)]
    texts = [_rate_text(row) for row in rows]
    trace = {
        "type": "scatter",
        "mode": "markers",
        "x": values,
        "y": names,
        "text": texts,
        "marker": {
            "color": BLUE,
            "size": 10,
            "symbol": ["circle" if row["events"] else "triangle-left-open" for row in rows],
        },
        "error_x": {"type": "data", "symmetric": False, "array": highs, "arrayminus": lows, "color": INK},
        "hovertemplate": "%{y}: %{text}<extra></extra>",
    }
    ends = (min(values, default=1.0) / _WIDER, max(values, default=1.0) * _WIDER)
    finding = discharges_finding(result)
    return Figure(
        "Discharges per second",
        f"Discharges per second of each bearing and mesh. {finding}.",
        plot(
            [trace],
            height=_REST + _ROW * max(1, len(rows)),
            showlegend=False,
            xaxis=axis("discharges per second")
            | log_ticks(log=True, ends=ends)
            | {"range": [math.log10(end) for end in ends]},
            yaxis=axis() | {"autorange": "reversed", "type": "category"},
        ),
        Table(
            "Discharges per second with bounds of 95 %", ("", "1/s"), tuple(zip(names, texts, strict=True))
        ),
        f"{finding}. Bars are bounds of 95 %; an open triangle is an upper bound without a discharge.",
    )


def _rate_text(row: Summary) -> str:
    """Text of a rate with its bounds of 95 %."""
    rate, low, high = (readable(row[f"events_per_second{end}"], 3) for end in ("", "_low", "_high"))
    return f"{rate} ({low} to {high})" if row["events"] else f"none (below {high})"


def _voltages_figure(result: AxleResult) -> Figure:
    """Voltages of the source and of shafts over a short time, with marks for discharges."""
    along, panels = discharge_panels(result)
    shown = panels[:_PANELS]
    names = ", ".join(panel.title for panel in shown)
    made = stack(along, shown)
    others = " The downloaded figure contains all shafts." if len(panels) > len(shown) else ""
    titles = {panel.title for panel in shown}
    for trace in made["data"]:
        trace["showlegend"] = trace["showlegend"] and trace["name"] not in titles
    return Figure(
        "Voltages over a short time",
        f"Voltages of {names} over a short time around a discharge. {discharges_finding(result)}.",
        made,
        caption="Circles above a voltage mark discharges when they begin, in a row for each bearing and "
        f"mesh.{others}",
    )


def ratios_figure(result: AxleResult) -> Figure:
    """Bar of each element that can discharge, the first element on top; a line extends to the values for all
    meshes conducting and no mesh conducting. Hatched bars without an end belong to summits that touch.
    """
    solution = result.solution
    ranking = dict(solution.discharging())
    ratios, *bounds = (solution.ratios(conduction) for conduction in CONDUCTIONS)
    names = list(ranking)
    summits = {name: name not in solution.breakdown_voltages for name in names}
    texts = {name: TOUCHES if summits[name] else readable(ratio, 3) for name, ratio in ranking.items()}
    labels = {name: f"{name}: {text}" for name, text in texts.items()}
    positive = [value for table in (ratios, *bounds) for value in table.values() if value > 0.0]
    ends = (min([*positive, 1.0]) / _ROOM, max([*positive, 1.0]) * _ROOM)
    data = [
        {
            "type": "bar",
            "orientation": "h",
            "x": [float(f"{min(value, ends[1]):.4g}") for value in ranking.values()],
            "y": [*labels.values()],
            "marker": {
                "color": [ORANGE, *[BLUE] * (len(names) - 1)],
                "pattern": {"shape": ["/" if summits[name] else "" for name in names]},
            },
            "hovertemplate": "%{y}<extra></extra>",
        }
    ]
    lines = solution.ratio_ends()
    for name in names:
        if name in lines:
            data.append(
                {
                    "type": "scatter",
                    "mode": "lines+markers",
                    "x": [*lines[name]],
                    "y": [labels[name]] * 2,
                    "line": {"color": INK, "width": 2},
                    "marker": {"symbol": "line-ns-open", "size": 9, "color": INK},
                    "hoverinfo": "skip",
                }
            )
    touching = " Hatched bars: summits touch." if math.inf in ranking.values() else ""
    limit = {"type": "line", "x0": 1.0, "x1": 1.0, "yref": "paper", "y0": 0.0, "y1": 1.0}
    first = f"{names[0]} first, {texts[names[0]]}" if names else "no element has a voltage"
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
        caption=f"Above 1 the element breaks down.{touching} A line extends to the values for all "
        "meshes conducting and no mesh conducting.",
    )
