"""Look of the figures of a bearing: colours that the colour blind tell apart, axes and scales."""

from __future__ import annotations

import math

import numpy as np

from ehlectric.app.figures.look import Plot, axis, log_ticks
from ehlectric.figures.data import is_wide


def shown_over(values: list[float]) -> tuple[float, float]:
    """Ends of a radius over positive values: from 0 or, on a logarithmic one, from below the smallest."""
    return (0.8 * min(values), 1.2 * max(values)) if is_wide(np.array(values)) else (0.0, 1.08 * max(values))


def polar_layout(ends: tuple[float, float], *, radial: bool = True) -> Plot:
    """Layout of a polar figure with the radial load at the bottom; logarithmic unless it begins at 0."""
    log = ends[0] > 0.0
    limits = [math.log10(end) for end in ends] if log else list(ends)
    around = axis(rotation=270, direction="counterclockwise", tickmode="array", automargin=False)
    around |= {
        "tickvals": list(range(0, 360, 45)),
        "ticktext": ["0° (load)" if radial else "0°", *(f"{angle}°" for angle in range(45, 360, 45))],
    }
    out = axis(range=limits, angle=90, tickangle=90, nticks=5)
    return {
        "margin": {"l": 40, "r": 40, "t": 30, "b": 40},
        "legend": {"orientation": "h", "x": 0.5, "xanchor": "center", "y": -0.12, "yanchor": "top"},
        "polar": {
            "bgcolor": "rgba(0,0,0,0)",
            "angularaxis": _without(around, "automargin"),
            "radialaxis": _without(out | log_ticks(log=log), "automargin"),
        },
    }


def _without(table: Plot, key: str) -> Plot:
    """Axis without a key, which polar axes lack."""
    return {name: value for name, value in table.items() if name != key}
