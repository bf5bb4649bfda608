"""Figures of a bearing around its shaft and over its speed, for a page."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ehlectric.app.charts.plotly_panels import Plot, axis, log_ticks, plot, scatter, stack
from ehlectric.bearing import (
    CONDUCTING,
    PARTIAL,
    Curves,
    Speed,
    Speeds,
    curves_of,
    listed,
    regime,
    touches,
    touching_ratio,
)
from ehlectric.cases.defaults import OF_CONTACTS
from ehlectric.figures.data import Panel, Upright, is_wide
from ehlectric.figures.speed_panels import breakdown_panel, capacitance_panel, speed_axis
from ehlectric.quantities.formats import rpm_text, speed_text
from ehlectric.quantities.palette import AMBER, BLUE, MIDDLE_GREY
from ehlectric.quantities.units import rpm
from ehlectric.readable import readable

# A circle of a lambda ratio is left out where the smallest film is above this many times its thickness.
_FAR = 4.0

# Height of a figure around the shaft [px].
_HEIGHT = 420

# Colour, width of the line and marker of each ring: the inner one is drawn over the wider line of the outer.
_LOOKS: Mapping[str, tuple[str, float, str]] = {
    "outer": (AMBER, 4.0, "square"),
    "inner": (BLUE, 2.0, "circle"),
}

# Layout of a figure over the speed: its legend of long names stands below it.
_LAYOUT: dict[str, Any] = {
    "height": 460,
    "margin": {"l": 62, "r": 16, "t": 16, "b": 50},
    "legend": {"orientation": "h", "x": 0.0, "xanchor": "left", "y": -0.27, "yanchor": "top"},
}

# Heads of the table over the speed.
SPEED_HEADS = (
    "speed [rpm]",
    "λ",
    "C, air [pF]",
    "C, oil [pF]",
    "first breakdown [V]",
    "shaft voltage [V]",
    "margin",
    "lubrication",
)


def shown_over(values: list[float]) -> tuple[float, float]:
    """Ends of a radius over positive values: from 0 or, on a logarithmic one, from below the smallest."""
    return (0.8 * min(values), 1.2 * max(values)) if is_wide(np.array(values)) else (0.0, 1.08 * max(values))


def polar_layout(ends: tuple[float, float], *, radial: bool = True) -> Plot:
    """Layout of a polar figure with the radial load at the bottom; logarithmic unless it begins at 0."""
    log = ends[0] > 0.0
    limits = [math.log10(end) for end in ends] if log else list(ends)
    around = axis(rotation=270, direction="counterclockwise", tickmode="array")
    around |= {
        "tickvals": list(range(0, 360, 45)),
        "ticktext": ["0° (load)" if radial else "0°", *(f"{angle}°" for angle in range(45, 360, 45))],
    }
    out = axis(range=limits, angle=90, tickangle=90, nticks=5) | log_ticks(log=log)
    # Polar axes lack this key.
    del around["automargin"], out["automargin"]
    return {
        "margin": {"l": 40, "r": 40, "t": 30, "b": 40},
        "legend": {"orientation": "h", "x": 0.5, "xanchor": "center", "y": -0.12, "yanchor": "top"},
        "polar": {
            "bgcolor": "rgba(0,0,0,0)",
            "angularaxis": around,
            "radialaxis": out,
        },
    }


@dataclass(frozen=True)
class Around:
    """Contacts of all elements with one ring, at all positions of the cage."""

    # Angles from the load line, in ascending order in each row, all rows one after the other [rad].
    angle: Sequence[float]
    # load and film: load [N] and minimum film thickness [m], or the gap of a contact without load.
    load: Sequence[float]
    film: Sequence[float]
    loaded: Sequence[bool]
    rows: int = 1  # rows of elements, or diagonals of a four-point contact bearing


def load_figure(
    rows: Sequence[Mapping[str, Any]], around: Mapping[str, Around], *, radial: bool = True
) -> Plot:
    """Figure of the loads of the contacts with both rings; the radial load on the inner ring points down."""
    data = []
    for name in _LOOKS:
        marks = [row for row in rows if row["ring"] == name]
        data.append(_line(name, around[name].angle, around[name].load, around[name].rows))
        data.append(_marks(name, marks, [row["load"] for row in marks], "load", "N"))
    largest = max(max(ring.load) for ring in around.values())
    return plot(data, height=_HEIGHT, **polar_layout((0.0, 1.08 * largest), radial=radial))


def film_figure(
    rows: Sequence[Mapping[str, Any]],
    around: Mapping[str, Around],
    roughness: float,
    *,
    summit_height: float = 0.0,
    radial: bool = True,
) -> Plot:
    """Figure of the minimum films of the loaded contacts with both rings around the shaft.

    The circles of lambda ratios are those of the combined root-mean-square roughness [m]; ``summit_height``
    is that of the highest summits over it. Contacts without load have a gap instead of a film, and are left
    out.
    """
    touching = float(touching_ratio(summit_height))
    films = [
        film
        for ring in around.values()
        for film, on in zip(ring.film, ring.loaded, strict=True)
        if on and math.isfinite(film)
    ]
    limits = {touching: "touch at times", max(PARTIAL, touching): "may touch"}
    if touching == CONDUCTING:
        limits[touching] = "touch"
    ratios = [ratio for ratio in limits if min(films) < _FAR * ratio * roughness]
    everything = [1e6 * film for film in [*films, *(ratio * roughness for ratio in ratios)]]
    data = [
        _circle(ratio, 1e6 * ratio * roughness, limits[ratio], "dot" if ratio == touching else "dash")
        for ratio in ratios
    ]
    for name in _LOOKS:
        ring = around[name]
        values = np.where(ring.loaded, 1e6 * np.array(ring.film), np.nan).tolist()
        data.append(_line(name, ring.angle, values, ring.rows))
        marks = [row for row in rows if row["ring"] == name and row["solved"]]
        data.append(_marks(name, marks, [1e6 * row["minimum_thickness"] for row in marks], "h_min", "µm"))
    layout = polar_layout(shown_over(everything), radial=radial)
    return plot(data, height=_HEIGHT, **layout)


def _line(name: str, angle: Sequence[float], values: Sequence[float], rows: int = 1) -> Plot:
    """Closed line of a ring around the shaft, one for each of its rows."""
    color, width, _ = _LOOKS[name]
    look: Plot = {"line": {"color": color, "width": width}, "showlegend": False}
    theta: list[float] = []
    radius: list[float] = []
    for part, row in zip(np.split(np.degrees(angle), rows), np.split(np.asarray(values), rows), strict=True):
        theta += [*part.tolist(), part[0] + 360.0, math.nan]
        radius += [*row.tolist(), row[0], math.nan]
    return scatter(theta[:-1], radius[:-1], polar=True, **look)


def _marks(name: str, rows: Sequence[Mapping[str, Any]], values: list[float], symbol: str, unit: str) -> Plot:
    """Marks of the contacts of a ring, with the cage at its first position."""
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
        f"{symbol} = %{{r:,.4~r}} {unit}<extra></extra>",
        "cliponaxis": False,
    }


def _circle(ratio: float, radius: float, words: str, dash: str) -> Plot:
    """Circle of a lambda ratio, with its film thickness [µm] and what surfaces do inside, in words."""
    return scatter(
        range(0, 361, 5),
        [radius] * 73,
        hover=f"λ = {ratio:g}<br>h = {readable(radius, 4)} µm",
        polar=True,
        line={"color": MIDDLE_GREY, "width": 1.5, "dash": dash},
        name=f"λ = {ratio:g}: surfaces {words} inside",
    )


@dataclass(frozen=True)
class OverSpeed:
    """Bearing over its speed: quick points, the bearing itself, and curves scaled to it."""

    points: Speeds
    at_case: Speed
    curves: Curves

    @classmethod
    def of(cls, points: Speeds, at_case: Speed) -> OverSpeed:
        """Curves through points, scaled to the bearing itself."""
        return cls(points, at_case, curves_of(points, at_case))

    @property
    def contacts(self) -> str:
        """Contacts of the points, in words."""
        return OF_CONTACTS[self.points[0][1]["bearing"]["contacts"]]


def breakdown_figure(over: OverSpeed) -> Plot:
    """First and ring-to-ring breakdown over the speed, with the shaft voltage."""
    return _figure(over, breakdown_panel(over.points, over.curves, over.at_case))


def capacitance_figure(over: OverSpeed) -> Plot:
    """Capacitance over the speed, with its range from air to oil around the films."""
    return _figure(over, capacitance_panel(over.points, over.curves, over.at_case))


def _figure(over: OverSpeed, panel: Panel) -> Plot:
    """Panel with a line at the speed of the bearing itself."""
    at = over.at_case[0]
    case_line = Upright(f"speed of this case, {speed_text(at)}", rpm(at), MIDDLE_GREY)
    return stack(speed_axis(over.curves), [replace(panel, uprights=(*panel.uprights, case_line))], **_LAYOUT)


def speed_rows(over: OverSpeed) -> list[tuple[str, ...]]:
    """Cells of the table over the speed, a row for each speed that is listed."""
    rows = []
    for speed, summary in listed(over.points, over.at_case[0]):
        place = int(np.searchsorted(over.curves.speed, speed))
        first, shaft, lambda_ratio, *capacitances = (
            float(over.curves[key][place])
            for key in ("first_break", "shaft_voltage", "lambda_ratio", "capacitance_air", "capacitance_oil")
        )
        ratio = first / shaft if math.isfinite(first) and math.isfinite(shaft) else math.nan
        rows.append(
            (
                rpm_text(speed),
                readable(lambda_ratio),
                *(readable(1e12 * value, 4) for value in capacitances),
                *(readable(value, 4) if math.isfinite(value) else "none" for value in (first, shaft, ratio)),
                _state(lambda_ratio, summary["bearing"]["lubrication"], over.curves.summit_height),
            )
        )
    return rows


def _state(lambda_ratio: float, quick: str, summit_height: float) -> str:
    """State of lubrication at a scaled lambda ratio; ``quick`` is that of the quick ratio."""
    if not math.isfinite(lambda_ratio):
        return quick
    if touches(lambda_ratio, summit_height) and quick != "touching":
        return "conducting"
    return str(regime(lambda_ratio, summit_height))
