"""Figures of a bearing around its shaft: loads and films of the contacts of all elements."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from ehlectric.app.figures.bearing_look import polar_layout, shown_over
from ehlectric.app.figures.look import Plot, plot
from ehlectric.quantities.palette import AMBER, BLUE, MIDDLE_GREY

# Lambda ratios below which surfaces touch, and below which they touch at times.
_RATIOS = (1.0, 3.0)

# A circle of a lambda ratio is left out where the smallest film is above this many times its thickness.
_FAR = 4.0

# Height of a figure [px].
_HEIGHT = 420

# Colour, width of the line and marker of each ring: the inner one is drawn over the wider line of the outer.
_LOOKS: Mapping[str, tuple[str, float, str]] = {
    "outer": (AMBER, 4.0, "square"),
    "inner": (BLUE, 2.0, "circle"),
}


@dataclass(frozen=True)
class Around:
    """Contacts of all elements with one ring, at all positions of the cage.

    Attributes
    ----------
    angle : sequence of float
        Angles from the load line, in ascending order [rad].
    load, film : sequence of float
        Load [N] and minimum film thickness [m], or the gap of a contact without load.
    loaded : sequence of bool
        Whether a contact is loaded.
    """

    angle: Sequence[float]
    load: Sequence[float]
    film: Sequence[float]
    loaded: Sequence[bool]


def load_figure(
    rows: Sequence[Mapping[str, Any]], around: Mapping[str, Around], *, radial: bool = True
) -> Plot:
    """Loads of the contacts with both rings around the shaft.

    Parameters
    ----------
    rows : sequence of mapping
        Rows of the table of contacts, SI units.
    around : mapping of str to Around
        Contacts at all positions of the cage, of "inner" and "outer".
    radial : bool
        Whether a radial load acts, whose line is marked.

    Returns
    -------
    dict
        Figure of Plotly, in which the radial load on the inner ring points down.
    """
    data = []
    for name in _LOOKS:
        ring = around[name]
        data.append(_line(name, ring.angle, list(ring.load)))
        marks = [row for row in rows if row["ring"] == name]
        values = [row["load"] for row in marks]
        data.append(_marks(name, marks, values, "load", "N"))
    largest = max(max(ring.load) for ring in around.values())
    return plot(data, height=_HEIGHT, **polar_layout((0.0, 1.08 * largest), radial=radial))


def film_figure(
    rows: Sequence[Mapping[str, Any]],
    around: Mapping[str, Around],
    roughness: float,
    *,
    radial: bool = True,
) -> Plot:
    """Minimum films of the loaded contacts with both rings around the shaft.

    Parameters
    ----------
    rows, around, radial
        As for ``load_figure``.
    roughness : float
        Combined root-mean-square height of both surfaces [m], for the circles of lambda ratios.

    Returns
    -------
    dict
        Figure of Plotly. Contacts without load have a gap instead of a film, and are left out.
    """
    films = [
        film
        for ring in around.values()
        for film, on in zip(ring.film, ring.loaded, strict=True)
        if on and math.isfinite(film)
    ]
    ratios = [ratio for ratio in _RATIOS if min(films) < _FAR * ratio * roughness]
    everything = [1e6 * film for film in [*films, *(ratio * roughness for ratio in ratios)]]
    data = [_circle(ratio, 1e6 * ratio * roughness) for ratio in ratios]
    for name in _LOOKS:
        ring = around[name]
        values = [1e6 * film if on else None for film, on in zip(ring.film, ring.loaded, strict=True)]
        data.append(_line(name, ring.angle, values))
        marks = [row for row in rows if row["ring"] == name and row["solved"]]
        data.append(_marks(name, marks, [1e6 * row["minimum_thickness"] for row in marks], "h_min", "µm"))
    layout = polar_layout(shown_over(everything), radial=radial)
    return plot(data, height=_HEIGHT, **layout)


def _line(name: str, angle: Sequence[float], values: list[float | None] | list[float]) -> Plot:
    color, width, _ = _LOOKS[name]
    degrees = [math.degrees(one) for one in angle]
    return {
        "type": "scatterpolar",
        "mode": "lines",
        "theta": [*degrees, degrees[0] + 360.0],
        "r": [*values, values[0]],
        "line": {"color": color, "width": width},
        "hoverinfo": "skip",
        "showlegend": False,
    }


def _marks(name: str, rows: Sequence[Mapping[str, Any]], values: list[float], symbol: str, unit: str) -> Plot:
    color, width, marker = _LOOKS[name]
    return {
        "type": "scatterpolar",
        "mode": "markers",
        "theta": [math.degrees(row["position"]) for row in rows],
        "r": values,
        "customdata": [row["element"] for row in rows],
        "name": f"{name} ring",
        "marker": {"color": color, "size": 7.0 + width, "symbol": marker},
        "hovertemplate": f"{name} contact of element %{{customdata}}<br>at %{{theta:.0f}}°<br>"
        f"{symbol} = %{{r:.4g}} {unit}<extra></extra>",
        "cliponaxis": False,
    }


def _circle(ratio: float, radius: float) -> Plot:
    words = "surfaces touch inside" if ratio == _RATIOS[0] else "surfaces may touch inside"
    return {
        "type": "scatterpolar",
        "mode": "lines",
        "theta": list(range(0, 361, 5)),
        "r": [radius] * 73,
        "line": {"color": MIDDLE_GREY, "width": 1.5, "dash": "dot" if ratio == _RATIOS[0] else "dash"},
        "name": f"λ = {ratio:g}: {words}",
        "hovertemplate": f"λ = {ratio:g}<br>h = {radius:.4g} µm<extra></extra>",
    }
