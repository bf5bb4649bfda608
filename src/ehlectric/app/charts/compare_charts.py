"""Figures of two cases side by side: films over the position of the elements, voltages over the speed, and
voltage ratios of axles.

They are built in the process of the server, so that nothing here loads NumPy.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from ehlectric.app.view_models import Film, Side
from ehlectric.quantities.palette import AMBER, BLUE, GREY
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
            at = {"x": [curve.at_case[0]], "y": [curve.at_case[1]], "mode": "markers+text", "text": [name]}
            look = {"marker": {"color": colour, "size": 11}, "textposition": "top left", "showlegend": False}
            traces.append({"type": "scatter", **at, **look, "hovertemplate": hover})
    log = _log_axis()
    layout = {
        "xaxis": {"title": {"text": "speed of the inner ring [rpm]"}, **log},
        "yaxis": {"title": {"text": "voltage [V]"}, **log},
        "margin": {"l": 62, "r": 16, "t": 16, "b": 50},
        "legend": {"orientation": "h", "x": 0.0, "xanchor": "left", "y": -0.2, "yanchor": "top"},
    }
    return _figure(traces, 400, layout)


def _log_axis(digits: Sequence[int] = (1, 2, 5)) -> dict[str, Any]:
    """Logarithmic axis with ticks at some digits of each decade."""
    ticks = [digit * 10.0**power for power in range(-6, 10) for digit in digits]
    texts = [readable(tick, 6) for tick in ticks]
    return {"type": "log", "tickmode": "array", "tickvals": ticks, "ticktext": texts}


def ratios(sides: Sequence[Side]) -> dict[str, Any]:
    """Voltages of the elements of both axles divided by their breakdown voltages, which are at 1. Returns
    figure for Plotly.
    """
    values = [dict(side.ratios) for side in sides]
    names = [*dict.fromkeys(name for table in values for name in table)]
    traces = [
        {
            "type": "bar",
            "orientation": "h",
            "name": name,
            "x": [table[element] for element in names if element in table],
            "y": [element for element in names if element in table],
            "marker": {"color": colour},
            "hovertemplate": f"{name}, %{{y}}: %{{x:,.3~r}}<extra></extra>",
        }
        for name, colour, table in zip(("A", "B"), (_FIRST, _SECOND), values, strict=True)
    ]
    limit = {"type": "line", "x0": 1.0, "x1": 1.0, "yref": "paper", "y0": 0.0, "y1": 1.0}
    ends = [1.0, *(value for table in values for value in table.values())]
    low, high = min(ends) / _BEYOND, max(ends) * _BEYOND
    layout = {
        "xaxis": {
            "title": {"text": "U / V_b"},
            **_log_axis((1, 3)),
            "range": [math.log10(low), math.log10(high)],
        },
        "yaxis": {"autorange": "reversed", "type": "category", "automargin": True},
        "shapes": [limit | {"line": {"color": GREY, "width": 2, "dash": "dash"}}],
        "legend": {"orientation": "h", "x": 0.0, "xanchor": "left", "y": 1.02, "yanchor": "bottom"},
        "bargap": 0.3,
    }
    return _figure(traces, 120 + 46 * max(1, len(names)), layout)


# Factor between the ends of an axis and its values.
_BEYOND = 1.6


def films(sides: Sequence[Side]) -> dict[str, Any]:
    """Minimum films over the position of the elements, of A and B. Elements without load, or with less than
    2 % of the largest load of their case, are crosses at the rim: their gaps would hide the films of the
    others. Returns polar figure for Plotly, in micrometres and degrees.
    """
    # Both crosses are visible at one place.
    looks = ("A", _FIRST, "circle", "x-thin"), ("B", _SECOND, "square", "cross-thin")
    loaded = [
        [_films_of(film, side, name, colour, symbol) for film in side.films]
        for side, (name, colour, symbol, _) in zip(sides, looks, strict=False)
    ]
    low, high, log = _radius([radius for marks in loaded for mark in marks for radius in mark["r"]])
    traces: list[dict[str, Any]] = []
    for side, marks, (name, colour, _, cross) in zip(sides, loaded, looks, strict=False):
        traces += [*marks, _at_rim(side, name, colour, high, cross=cross)]
    radial: dict[str, Any] = {"angle": 90.0, "tickangle": 0}
    if log:
        radial |= {"range": [math.log10(low), math.log10(high)], **_log_axis()}
    else:
        radial |= {"range": [low, high], "nticks": 4}
    polar = {
        "radialaxis": radial,
        "angularaxis": {"rotation": -90.0, "direction": "counterclockwise", "ticksuffix": "°"},
        "bgcolor": "rgba(0,0,0,0)",
    }
    layout = {
        "polar": polar,
        "margin": {"l": 42, "r": 42, "t": 30, "b": 45},
        "legend": {"orientation": "h", "x": 0.5, "xanchor": "center", "y": -0.12},
    }
    return _figure([trace for trace in traces if trace["theta"]], 470, layout)


# Share of the largest load below which the film of an element is not drawn, and ratio of two films above
# which the radial axis is logarithmic.
_LIGHT, _WIDE = 0.02, 10.0


def _is_loaded(side: Side, load: float) -> bool:
    """Whether an element has at least a share ``_LIGHT`` of the largest load of its case."""
    return load > 0.0 and load >= _LIGHT * max(value for film in side.films for value in film.load)


def _radius(values: Sequence[float]) -> tuple[float, float, bool]:
    """Ends of the radial axis over positive values, and whether it is logarithmic.

    Examples
    --------
    >>> _radius([0.2, 0.4]), _radius([1.0, 20.0])
    ((0.0, 0.48, False), (0.8, 24.0, True))
    """
    low, high = min(values), 1.2 * max(values)
    return (0.8 * low, high, True) if max(values) > _WIDE * low else (0.0, high, False)


def _films_of(film: Film, side: Side, name: str, colour: str, symbol: str) -> dict[str, Any]:
    """Marks of the films of the loaded elements of a ring."""
    kept = [k for k, load in enumerate(film.load) if _is_loaded(side, load)]
    whole = f"{name}, {film.ring} ring"
    outer = film.ring == "outer"
    return {
        "type": "scatterpolar",
        "mode": "markers",
        "name": whole,
        "theta": [film.position[k] for k in kept],
        "r": [1e6 * film.thickness[k] for k in kept],
        "marker": {"color": colour, "size": 9, "symbol": f"{symbol}-open" if outer else symbol},
        "hovertemplate": f"{whole}<br>%{{theta:.0f}}°: %{{r:,.4~r}} µm<extra></extra>",
    }


def _at_rim(side: Side, name: str, colour: str, rim: float, *, cross: str) -> dict[str, Any]:
    """Crosses at the rim [µm] at the elements with little or no load at either ring."""
    light = [
        (position, f"{film.ring} ring, {readable(load, 2)} N: {readable(1e6 * thickness, 3)} µm")
        for film in side.films
        for position, thickness, load in zip(film.position, film.thickness, film.load, strict=True)
        if not _is_loaded(side, load)
    ]
    return {
        "type": "scatterpolar",
        "mode": "markers",
        "name": f"{name}, below {100.0 * _LIGHT:g} % of the load",
        "theta": [position for position, _ in light],
        "r": [rim] * len(light),
        "customdata": [words for _, words in light],
        "marker": {"color": colour, "size": 10, "symbol": cross, "line": {"color": colour, "width": 2}},
        "cliponaxis": False,
        "hovertemplate": f"{name}, %{{customdata}}<br>%{{theta:.0f}}°<extra></extra>",
    }


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
