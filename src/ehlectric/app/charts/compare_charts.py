"""Figures of two cases side by side: voltages over the speed, and films over the position of the elements.

They are built in the process of the server, so that nothing here loads NumPy.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from ehlectric.app.answers import Side
from ehlectric.quantities.palette import AMBER, BLUE
from ehlectric.readable import readable

# Colours of both cases.
_FIRST, _SECOND = BLUE, AMBER


def over_speed(sides: Sequence[Side]) -> dict[str, Any]:
    """Voltages of A and B over the speed; breakdown is expected where a first breakdown lies below its shaft
    voltage. Returns figure for Plotly [rpm, V].
    """
    looks = (("A", _FIRST, 6), ("B", _SECOND, 2.5))
    traces: list[dict[str, Any]] = []
    for side, (name, colour, width) in zip(sides, looks, strict=True):
        for curve, dash in zip(side.voltages, ("solid", "dash"), strict=False):
            whole = f"{name}, {curve.name}"
            over = {"x": list(curve.speed), "y": list(curve.voltage), "name": whole, "mode": "lines"}
            line = {"color": colour, "width": width, "dash": dash}
            hover = f"{whole}<br>%{{x:.0f}} rpm: %{{y:,.3~r}} V<extra></extra>"
            traces.append({"type": "scatter", **over, "line": line, "hovertemplate": hover})
            at = {"x": [curve.own[0]], "y": [curve.own[1]], "mode": "markers+text", "text": [name]}
            look = {"marker": {"color": colour, "size": 11}, "textposition": "top left", "showlegend": False}
            traces.append({"type": "scatter", **at, **look, "hovertemplate": hover})
    ticks = [digit * 10.0**power for power in range(-6, 10) for digit in (1, 2, 5)]
    log = {"type": "log", "tickmode": "array", "tickvals": ticks, "ticktext": [readable(t, 6) for t in ticks]}
    layout = {
        "xaxis": {"title": {"text": "speed of the inner ring [rpm]"}, **log},
        "yaxis": {"title": {"text": "voltage [V]"}, **log},
        "margin": {"l": 62, "r": 16, "t": 16, "b": 50},
        "legend": {"orientation": "h", "x": 0.0, "xanchor": "left", "y": -0.2, "yanchor": "top"},
    }
    return _figure(traces, 400, layout)


def films(sides: Sequence[Side]) -> dict[str, Any]:
    """Minimum film of every loaded contact over the position of its element, of A and B. Returns polar figure
    for Plotly, in micrometres and degrees.
    """
    traces = [
        {
            "type": "scatterpolar",
            "mode": "markers",
            "name": f"{name}, {film.ring} ring",
            "theta": list(film.position),
            "r": [1e6 * thickness for thickness in film.thickness],
            "marker": {
                "color": colour,
                "size": 9,
                "symbol": f"{symbol}-open" if film.ring == "outer" else symbol,
            },
            "hovertemplate": f"{name}, {film.ring} ring<br>%{{theta:.0f}}°: %{{r:,.4~r}} µm<extra></extra>",
        }
        for side, name, colour, symbol in zip(
            sides, "AB", (_FIRST, _SECOND), ("circle", "square"), strict=False
        )
        for film in side.films
    ]
    polar = {
        "radialaxis": {"rangemode": "tozero", "angle": 90.0, "tickangle": 0, "nticks": 4},
        "angularaxis": {"rotation": -90.0, "direction": "counterclockwise", "ticksuffix": "°"},
        "bgcolor": "rgba(0,0,0,0)",
    }
    layout = {
        "polar": polar,
        "margin": {"l": 42, "r": 42, "t": 30, "b": 45},
        "legend": {"orientation": "h", "x": 0.5, "xanchor": "center", "y": -0.12},
    }
    return _figure(traces, 430, layout)


def _figure(data: list[dict[str, Any]], height: int, layout: dict[str, Any]) -> dict[str, Any]:
    """Figure for Plotly of a height [px], with the look of the page."""
    look = {
        "height": height,
        "margin": {"l": 20, "r": 20, "t": 20, "b": 45},
        "paper_bgcolor": "rgba(0,0,0,0)",
        "plot_bgcolor": "rgba(0,0,0,0)",
        "font": {"size": 13},
        "uirevision": "same",
    }
    buttons = {"format": "svg", "filename": "ehlectric-compare"}
    config = {"displaylogo": False, "responsive": True, "toImageButtonOptions": buttons}
    return {"data": data, "layout": look | layout, "config": config}
