"""Figures of a rough surface after a processing step: a line of a profile, or a map of heights."""

from __future__ import annotations

from typing import Any

import numpy as np

from ehlectric.app.figures.charts import axis, coarser, plot, thinned, values
from ehlectric.arrays import Array
from ehlectric.quantities.palette import BLUE
from ehlectric.quantities.units import unit_for
from ehlectric.surfaces.maps import Map
from ehlectric.surfaces.profiles import Profile

# Largest number of pieces of a line, each drawn by its lowest and its highest point, and height of a figure
# [px].
_PIECES, _HEIGHT = 1000, 250

# Part of the heights of a map [%] beyond either end of its colours, so that a grain of dust does not take
# all colours.
_BEYOND = 0.1


def profile_figure(profile: Profile) -> dict[str, Any]:
    """Figure of the heights of a profile about their mean.

    A profile of many points is drawn by the lowest and the highest point of equal pieces.
    """
    return line_figure(profile.x, profile.heights - np.mean(profile.heights))


def line_figure(x: Array, heights: Array) -> dict[str, Any]:
    """Figure of heights (n,) [m] over positions (n,) [m]."""
    chosen = thinned([heights], _PIECES)
    along, length = unit_for(float(np.max(np.abs(x))), "m")
    factor, unit = unit_for(float(np.max(np.abs(heights))), "m", least=1.0)
    trace = {
        "type": "scatter",
        "mode": "lines",
        "x": values(along * x[chosen], 6),
        "y": values(factor * heights[chosen], 5),
        "line": {"color": BLUE, "width": 1},
        "hovertemplate": f"x %{{x}} {length}<br>height %{{y}} {unit}<extra></extra>",
        "showlegend": False,
    }
    return plot(
        [trace],
        height=_HEIGHT,
        margin=_MARGIN,
        xaxis=axis(f"x [{length}]", zeroline=False),
        yaxis=axis(f"height [{unit}]"),
    )


def map_figure(surface: Map, voids: Array | None = None) -> dict[str, Any]:
    """Figure of the heights of a map about their mean as colours. ``voids``, points without data in the file,
    which are left blank, shape (nx, ny).
    """
    heights = surface.heights - np.mean(surface.heights)
    low, high = (float(value) for value in np.percentile(heights, [_BEYOND, 100.0 - _BEYOND]))
    if voids is not None:
        heights = np.where(voids, np.nan, heights)
    pixels, block = coarser(heights)
    along, length = unit_for(0.5 * max(surface.length_x, surface.length_y), "m")
    factor, unit = unit_for(max(-low, high, 1e-12), "m", least=1.0)
    axes = {
        name: {f"{name}0": at[0], f"d{name}": at[1]}
        for name, at in {
            "x": _axis(surface.x, block[0], along),
            "y": _axis(surface.y, block[1], along),
        }.items()
    }
    trace = {
        "type": "heatmap",
        **axes["x"],
        **axes["y"],
        "z": values(factor * pixels.T, 4),
        "zmin": factor * low,
        "zmax": factor * high,
        "colorscale": "Viridis",
        "colorbar": {"title": {"text": f"height [{unit}]", "side": "right"}, "thickness": 12, "len": 1.0},
        "hovertemplate": f"x %{{x:.5g}} {length}<br>y %{{y:.5g}} {length}<br>height %{{z}} {unit}"
        "<extra></extra>",
    }
    return plot(
        [trace],
        height=_HEIGHT,
        margin=_MARGIN,
        xaxis=axis(f"x [{length}]", zeroline=False, constrain="domain", showgrid=False),
        yaxis=axis(f"y [{length}]", zeroline=False, constrain="domain", showgrid=False, scaleanchor="x"),
    )


_MARGIN = {"l": 8, "r": 8, "t": 8, "b": 8}


def _axis(places: Array, block: int, factor: float) -> tuple[float, float]:
    """Place of the middle of the first pixel along an axis, and distance between pixels."""
    step = float(places[1] - places[0]) if places.size > 1 else 1.0
    return factor * (float(places[0]) + 0.5 * (block - 1) * step), factor * block * step
