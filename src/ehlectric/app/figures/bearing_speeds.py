"""Figures of a bearing over its speed: breakdown voltage with shaft voltage, and capacitance."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any

from ehlectric.app.figures.look import Plot
from ehlectric.app.figures.stack import stack
from ehlectric.bearing.over_speed import Curves, Speed, Speeds, curves_of
from ehlectric.bearing.solution import CONDUCTING, PARTIAL
from ehlectric.cases.bearings.ways import OF_CONTACTS
from ehlectric.figures.bearing.speed_panels import breakdown_panel, capacitance_panel, speed_axis
from ehlectric.figures.data import Panel, Upright
from ehlectric.quantities.palette import MIDDLE_GREY
from ehlectric.quantities.units import rpm, rpm_text

# Layout of a figure: its legend of long names stands below it.
_LAYOUT: dict[str, Any] = {
    "height": 440,
    "margin": {"l": 62, "r": 16, "t": 16, "b": 50},
    "legend": {"orientation": "h", "x": 0.0, "xanchor": "left", "y": -0.2, "yanchor": "top"},
}


@dataclass(frozen=True)
class OverSpeed:
    """Bearing over its speed: quick points, the bearing itself, and curves scaled to it."""

    points: Speeds
    own: Speed
    curves: Curves
    # Level of the verdict, which is no surer at other speeds.
    level: str = ""

    @classmethod
    def of(cls, points: Speeds, own: Speed, *, level: str = "") -> OverSpeed:
        """Curves through points, scaled to the bearing itself."""
        return cls(points, own, curves_of(points, own), level)

    @property
    def contacts(self) -> str:
        """Contacts of the points, in words."""
        return OF_CONTACTS[self.points[0][1]["bearing"]["contacts"]]


def breakdown_figure(over: OverSpeed) -> Plot:
    """First and ring-to-ring breakdown over the speed, with the shaft voltage."""
    likely = "likely" if over.level == "yellow" else "expected"
    return _figure(over, breakdown_panel(over.points, over.curves, over.own, likely=likely))


def capacitance_figure(over: OverSpeed) -> Plot:
    """Capacitance over the speed, with its range from air to oil around the films."""
    return _figure(over, capacitance_panel(over.points, over.curves, over.own))


def _figure(over: OverSpeed, panel: Panel) -> Plot:
    """Panel with a line at the speed of the bearing itself."""
    at = over.own[0]
    own = Upright(f"speed of this case, {rpm_text(at)} rpm", rpm(at), MIDDLE_GREY)
    return stack(speed_axis(over.curves), [replace(panel, uprights=(*panel.uprights, own))], **_LAYOUT)


def speed_rows(over: OverSpeed) -> list[tuple[str, ...]]:
    """Cells of the table over the speed, a row for each speed."""
    rows = []
    for k, (speed, summary) in enumerate(sorted(over.points, key=lambda point: point[0])):
        first, shaft = (float(over.curves[key][k]) for key in ("first_break", "shaft_voltage"))
        ratio = first / shaft if math.isfinite(first) and math.isfinite(shaft) else math.nan
        lambda_ratio = float(over.curves["lambda_ratio"][k])
        capacitances = (1e12 * float(over.curves[f"capacitance_{key}"][k]) for key in ("air", "oil"))
        rows.append(
            (
                rpm_text(speed),
                f"{lambda_ratio:.3g}",
                *(f"{value:.4g}" for value in capacitances),
                *(f"{value:.4g}" if math.isfinite(value) else "none" for value in (first, shaft, ratio)),
                _state(lambda_ratio, summary["bearing"]["lubrication"]),
            )
        )
    return rows


def _state(lambda_ratio: float, quick: str) -> str:
    """State of lubrication at a scaled lambda ratio; ``quick`` is that of the quick ratio."""
    if not math.isfinite(lambda_ratio):
        return quick
    if lambda_ratio < CONDUCTING:
        return "touching" if quick == "touching" else "conducting"
    return "partial film" if lambda_ratio < PARTIAL else "full film"


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
