"""Figures of a bearing over its speed: breakdown voltage with shaft voltage, and capacitance."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np

from ehlectric.app.figures.bearing_look import speed_layout
from ehlectric.app.figures.look import BLUE, GREEN, GREY, ORANGE, RED, Plot, plot, values
from ehlectric.arrays import Array, Mask
from ehlectric.bearing.solution import CONDUCTING, PARTIAL
from ehlectric.cases.bearings.ways import OF_CONTACTS
from ehlectric.figures.bearing.curves import (
    RPM,
    Curves,
    Speed,
    Speeds,
    critical_speed_of,
    curves_of,
    nearly_equal,
    value_of,
)
from ehlectric.quantities.units import rpm_text

# Height of a figure [px].
_HEIGHT = 440


@dataclass(frozen=True)
class OverSpeed:
    """Bearing over its speed.

    Attributes
    ----------
    points : sequence of (float, dict)
        Speeds of the inner ring [rad/s] with their summaries.
    own : (float, dict)
        Speed and summary of the bearing itself.
    curves : Curves
        Curves through the points, scaled to the bearing itself.
    level : str
        Level of the verdict, which is no surer at other speeds.
    """

    points: Speeds
    own: Speed
    curves: Curves
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
    """First and ring-to-ring breakdown over the speed, with the shaft voltage.

    Parameters
    ----------
    over : OverSpeed
        Bearing over its speed.

    Returns
    -------
    dict
        Figure of Plotly. Speeds with a lambda ratio below 1 have no voltages, and are hatched.
    """
    curves = over.curves
    first, through, shaft = (curves[key] for key in ("first_break", "through_breakdown", "shaft_voltage"))
    one = nearly_equal(first, through)
    lines = [("first breakdown" if not one else "first and ring-to-ring breakdown", "first_break", BLUE, "")]
    lines += [] if one else [("ring-to-ring breakdown", "through_breakdown", GREEN, "dash")]
    lines += [("shaft voltage", "shaft_voltage", ORANGE, "dashdot")]
    data = [*_touching(curves), *_danger(over)]
    for name, key, color, dash in lines:
        data += _curve(curves, key, 1.0, "V", {"name": name, "color": color, "dash": dash or "solid"})
    everything = [*first, *through, *shaft]
    data += _critical(over)
    data += _own(over, value_of(over.own[1], "first_break"), "first breakdown", "V")
    layout = speed_layout("voltage [V]", list(map(float, everything)), _rpm(curves))
    return plot(data, height=_HEIGHT, **layout)


def capacitance_figure(over: OverSpeed) -> Plot:
    """Capacitance over the speed, with its range from air to oil around the films.

    Parameters
    ----------
    over : OverSpeed
        Bearing over its speed.

    Returns
    -------
    dict
        Figure of Plotly, in picofarads.
    """
    curves = over.curves
    air, oil = ({"name": f"{name} around the films"} for name in ("air", "oil"))
    band = {"fill": "tonexty", "fillcolor": "rgba(0,114,178,0.15)"}
    data = [
        *_touching(curves),
        *_curve(curves, "capacitance_air", 1e12, "pF", {**air, "color": BLUE, "dash": "dot"}, marks=False),
        *_curve(
            curves, "capacitance_oil", 1e12, "pF", {**oil, "color": BLUE, "dash": "dash"}, marks=False, **band
        ),
        *_curve(curves, "capacitance", 1e12, "pF", {"name": "this bearing", "color": BLUE, "dash": "solid"}),
        *_own(over, over.own[1]["bearing"]["capacitance"], "capacitance", "pF", 1e12),
    ]
    everything = [1e12 * float(value) for key in ("air", "oil") for value in curves[f"capacitance_{key}"]]
    return plot(data, height=_HEIGHT, **speed_layout("capacitance [pF]", everything, _rpm(curves)))


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


def _rpm(curves: Curves) -> list[float]:
    return [float(value) for value in curves.speed * RPM]


def _curve(
    curves: Curves,
    key: str,
    factor: float,
    unit: str,
    look: dict[str, str],
    *,
    marks: bool = True,
    **more: Any,
) -> list[Plot]:
    """Line between the speeds and markers at them; none where no speed has a value."""
    if not np.any(np.isfinite(curves[key])):
        return []
    speed, between = curves.between(key)
    name = look["name"]
    hover = f"{name}: %{{y:.4g}} {unit}<br>at %{{x:.4g}} rpm<extra></extra>"
    line = {
        "type": "scatter",
        "mode": "lines",
        "x": values(speed * RPM),
        "y": values(factor * between),
        "name": name,
        "line": {"color": look["color"], "width": 2.0, "dash": look["dash"]},
        "hovertemplate": hover,
        **more,
    }
    at = {
        "type": "scatter",
        "mode": "markers",
        "x": values(curves.speed * RPM),
        "y": values(factor * curves[key]),
        "marker": {"color": look["color"], "size": 7},
        "hovertemplate": hover,
        "showlegend": False,
        "name": name,
    }
    return [line, at] if marks else [line]


def _touching(curves: Curves) -> list[Plot]:
    """Hatched speeds with a lambda ratio below 1, and grey ones with a ratio from 1 to 3."""
    speed, ratio = curves.between("lambda_ratio")
    kinds: tuple[tuple[float, float, str, Plot], ...] = (
        (
            0.0,
            CONDUCTING,
            "λ < 1: surfaces touch, no voltage",
            {
                "fillcolor": "rgba(119,119,119,0.25)",
                "fillpattern": {
                    "shape": "/",
                    "fgcolor": GREY,
                    "bgcolor": "rgba(119,119,119,0.12)",
                    "size": 8,
                },
            },
        ),
        (CONDUCTING, PARTIAL, "λ 1 to 3: they may touch", {"fillcolor": "rgba(119,119,119,0.12)"}),
    )
    found = []
    for low, high, name, look in kinds:
        within = (ratio >= low) & (ratio < high)
        # Up to the next node, so that no gap is left between both.
        within[1:] |= within[:-1] & np.isfinite(ratio[1:])
        found += [
            {**_box(begin, end), "name": name, "showlegend": k == 0, **look}
            for k, (begin, end) in enumerate(_spans(speed * RPM, within))
        ]
    return found


def _danger(over: OverSpeed) -> list[Plot]:
    """Speeds at which the shaft voltage is above the first breakdown."""
    curves = over.curves
    speed, first = curves.between("first_break")
    _, shaft = curves.between("shaft_voltage")
    return [
        {
            **_box(begin, end),
            "name": f"breakdown {'likely' if over.level == 'yellow' else 'expected'}",
            "showlegend": k == 0,
            "fillcolor": "rgba(213,94,0,0.16)",
        }
        for k, (begin, end) in enumerate(_spans(speed * RPM, shaft > first))
    ]


def _spans(speed: Array, within: Mask) -> Iterable[tuple[float, float]]:
    """Ends of the intervals of speed in which a condition holds."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], within, [False]])))
    for begin, end in zip(edges[::2], edges[1::2], strict=True):
        yield float(speed[begin]), float(speed[end - 1])


def _box(begin: float, end: float) -> Plot:
    """Area over all heights between two speeds [rpm]."""
    return {
        "type": "scatter",
        "mode": "lines",
        "x": values([begin, end, end, begin, begin]),
        "y": [0.0, 0.0, 1.0, 1.0, 0.0],
        "yaxis": "y2",
        "fill": "toself",
        "line": {"width": 0},
        "hoverinfo": "skip",
    }


def _critical(over: OverSpeed) -> list[Plot]:
    """Line at the speed below which breakdown is expected."""
    critical = critical_speed_of(over.curves)
    if critical is None:
        return []
    name = f"critical speed {rpm_text(critical)} rpm"
    return [_upright(critical, name, {"color": RED, "width": 2.0, "dash": "dot"})]


def _own(over: OverSpeed, value: float | None, what: str, unit: str, factor: float = 1.0) -> list[Plot]:
    """Line at the own speed of the bearing, and a star at its value."""
    speed = over.own[0]
    at = f"{rpm_text(speed)} rpm"
    line = _upright(speed, f"speed of this case, {at}", {"color": GREY, "width": 1.5})
    if value is None:
        return [line]
    star = {
        "type": "scatter",
        "mode": "markers",
        "x": values([speed * RPM]),
        "y": values([factor * value]),
        "marker": {"symbol": "star", "size": 15, "color": BLUE, "line": {"color": "white", "width": 1}},
        "name": f"{what} at {at}",
        "hovertemplate": f"{what} {factor * value:.4g} {unit}<br>at {at}<extra></extra>",
        "showlegend": False,
    }
    return [line, star]


def _upright(speed: float, name: str, line: Plot) -> Plot:
    """Line over all heights at a speed [rad/s]."""
    return {
        "type": "scatter",
        "mode": "lines",
        "x": values([speed * RPM] * 2),
        "y": [0.0, 1.0],
        "yaxis": "y2",
        "name": name,
        "line": line,
        "hoverinfo": "name",
    }
