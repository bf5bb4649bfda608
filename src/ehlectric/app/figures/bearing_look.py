"""Look of the figures of a bearing: colours that the colour blind tell apart, axes and scales."""

from __future__ import annotations

import math
from collections.abc import Iterable

from ehlectric.app.figures.look import Plot, axis

# Ratio of the largest to the smallest value from which on an axis is logarithmic.
_WIDE = 20.0


def is_wide(values: Iterable[float]) -> bool:
    """Whether positive values differ so much that their axis is logarithmic.

    Examples
    --------
    >>> is_wide([1.0, 5.0]), is_wide([1.0, 50.0]), is_wide([])
    (False, True, False)
    """
    known = [value for value in values if math.isfinite(value) and value > 0.0]
    return bool(known) and max(known) > _WIDE * min(known)


def shown_over(values: list[float]) -> tuple[float, float]:
    """Ends of a radius over positive values: from 0 or, on a logarithmic one, from below the smallest."""
    return (0.8 * min(values), 1.2 * max(values)) if is_wide(values) else (0.0, 1.08 * max(values))


def polar_layout(ends: tuple[float, float], *, radial: bool = True) -> Plot:
    """Layout of a polar figure with the radial load at the bottom; logarithmic unless it begins at 0."""
    log = ends[0] > 0.0
    limits = [math.log10(end) for end in ends] if log else list(ends)
    around = axis(rotation=270, direction="counterclockwise", tickmode="array", automargin=False)
    around |= {
        "tickvals": list(range(0, 360, 45)),
        "ticktext": ["0° (load)" if radial else "0°", *(f"{angle}°" for angle in range(45, 360, 45))],
    }
    out = axis(type="log" if log else "linear", range=limits, angle=90, tickangle=90, nticks=5)
    return {
        "margin": {"l": 40, "r": 40, "t": 30, "b": 40},
        "legend": {"orientation": "h", "x": 0.5, "xanchor": "center", "y": -0.12, "yanchor": "top"},
        "polar": {
            "bgcolor": "rgba(0,0,0,0)",
            "angularaxis": _without(around, "automargin"),
            "radialaxis": _without(out | _ticks(log=log), "automargin"),
        },
    }


def speed_layout(title: str, values: list[float], speeds: list[float]) -> Plot:
    """Layout of a figure over the speed [rpm], with a hidden axis from 0 to 1 for marks of speeds."""
    log, wide = is_wide(values), is_wide(speeds)
    known = [value for value in values if math.isfinite(value)]
    upright = axis(title, type="log" if log else "linear", **_ticks(log=log))
    if known and not log:
        upright["range"] = [0.0, 1.1 * max(known)]
    along = axis("speed of the inner ring [rpm]", type="log" if wide else "linear")
    return {
        "margin": {"l": 62, "r": 16, "t": 16, "b": 50},
        "legend": {"orientation": "h", "x": 0.0, "xanchor": "left", "y": -0.2, "yanchor": "top"},
        "hovermode": "closest",
        "xaxis": along | _ticks(log=wide),
        "yaxis": upright,
        "yaxis2": {"overlaying": "y", "range": [0.0, 1.0], "visible": False, "fixedrange": True},
    }


def _ticks(*, log: bool) -> Plot:
    """Ticks of a logarithmic axis, whose numbers are written in full; those of Plotly for others."""
    if not log:
        return {}
    ticks = [digit * 10.0**power for power in range(-6, 10) for digit in (1.0, 2.0, 5.0)]
    return {"tickmode": "array", "tickvals": ticks, "ticktext": [f"{tick:.12g}" for tick in ticks]}


def _without(table: Plot, key: str) -> Plot:
    """Axis without a key, which polar axes lack."""
    return {name: value for name, value in table.items() if name != key}
