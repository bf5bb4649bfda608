"""Figures of a bearing around its shaft and over its speed, for a page."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ehlectric.app.charts.plotly_panels import Plot, axis, axis_range, log_ticks, plot, polar_traces, stack
from ehlectric.bearing import (
    Curves,
    Speed,
    Speeds,
    curves_of,
    listed,
    lubrication_state,
)
from ehlectric.cases.defaults import OF_CONTACTS
from ehlectric.figures.data import Panel, Upright
from ehlectric.figures.speed_panels import breakdown_panel, capacitance_panel, speed_axis
from ehlectric.quantities.formats import rpm_text, speed_text
from ehlectric.quantities.palette import MIDDLE_GREY
from ehlectric.quantities.units import rpm
from ehlectric.readable import readable

# Height of a figure around the shaft [px].
_HEIGHT = 420

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


def ring_figure(panel: Panel, *, radial: bool) -> Plot:
    """Figure around the shaft; a ``radial`` load on the inner ring points down."""
    assert panel.ends is not None
    around = axis(rotation=270, direction="counterclockwise", tickmode="array")
    around |= {
        "tickvals": list(range(0, 360, 45)),
        "ticktext": ["0° (load)" if radial else "0°", *(f"{angle}°" for angle in range(45, 360, 45))],
    }
    out = axis(**axis_range(panel.ends, log=panel.log), angle=90, tickangle=90, nticks=5)
    out |= log_ticks(log=panel.log, ends=panel.ends)
    # Polar axes lack this key.
    del around["automargin"], out["automargin"]
    return plot(
        polar_traces(panel),
        height=_HEIGHT,
        margin={"l": 40, "r": 40, "t": 30, "b": 40},
        legend={"orientation": "h", "x": 0.5, "xanchor": "center", "y": -0.12, "yanchor": "top"},
        polar={"bgcolor": "rgba(0,0,0,0)", "angularaxis": around, "radialaxis": out},
    )


@dataclass(frozen=True)
class OverSpeed:
    """Bearing over its speed: estimated points, the bearing itself, and curves scaled to it."""

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
                _state(lambda_ratio, summary["bearing"]["lubrication_state"], over.curves.summit_height),
            )
        )
    return rows


def _state(lambda_ratio: float, quick: str, summit_height: float) -> str:
    """State of lubrication at a scaled lambda ratio; ``quick`` is the state at the estimated ratio."""
    if not math.isfinite(lambda_ratio):
        return quick
    return str(lubrication_state(lambda_ratio, summit_height))
