"""Figures of two cases side by side: changes of the results, and films over the position of the elements.

They are built in the process of the server, so that nothing here loads NumPy.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

from ehlectric.app.answers import Effect, Side
from ehlectric.quantities.palette import AMBER, BLUE

# Colours of both cases.
_FIRST, _SECOND = BLUE, AMBER

# Largest change that is drawn [%]; a longer bar is cut, and its name has the number.
_LONGEST = 200.0


def changes(effects: Iterable[Effect]) -> dict[str, Any]:
    """Bars of the changes of results from A to B [%]. Returns figure for Plotly."""
    rows = [effect for effect in effects if effect.change is not None][::-1]
    values = [effect.change or 0.0 for effect in rows]
    # The change stands below the name, where no narrow screen cuts it.
    short = [effect.either.name.partition(" (")[0] for effect in rows]
    whole = [effect.either.name.replace(" (", "<br>(") for effect in rows]
    names = [
        f"{name if short.count(name) == 1 else full}<br>{effect.words}"
        for name, full, effect in zip(short, whole, rows, strict=True)
    ]
    bars = {
        "type": "bar",
        "orientation": "h",
        "y": names,
        "x": [min(_LONGEST, max(-_LONGEST, value)) for value in values],
        "customdata": [
            [effect.first.shown if effect.first else "", effect.second.shown if effect.second else ""]
            for effect in rows
        ],
        "hovertemplate": "%{y}<br>A: %{customdata[0]}<br>B: %{customdata[1]}<extra></extra>",
        "marker": {"color": [_SECOND if value > 0.0 else _FIRST for value in values]},
    }
    reach = 1.05 * max([10.0, *(min(_LONGEST, abs(value)) for value in values)])
    layout = {
        "xaxis": {"title": {"text": "change from A to B [%]"}, "range": [-reach, reach], "zeroline": True},
        "yaxis": {"automargin": True, "fixedrange": True, "ticks": ""},
        "showlegend": False,
        "bargap": 0.4,
    }
    return _figure([bars], 70 + 40 * len(rows), layout)


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
            "hovertemplate": f"{name}, {film.ring} ring<br>%{{theta:.0f}}°: %{{r:.4g}} µm<extra></extra>",
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
