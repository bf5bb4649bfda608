"""Figures of a rough surface after a processing step: a line of a profile, or a map of heights."""

from __future__ import annotations

from typing import Any

import numpy as np

from ehlectric.app.charts.plotly_panels import (
    FILM_COLOURS,
    NARROW,
    axis,
    coarser,
    plot,
    scatter,
    thinned,
    values,
)
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
    trace = scatter(
        along * x[chosen],
        factor * heights[chosen],
        digits=(6, 5),
        hover=f"x %{{x}} {length}<br>height %{{y}} {unit}",
        line={"color": BLUE, "width": 1},
        showlegend=False,
    )
    return plot(
        [trace],
        height=_HEIGHT,
        margin=NARROW,
        xaxis=axis(f"x [{length}]", zeroline=False),
        yaxis=axis(f"height [{unit}]"),
    )


def map_figure(surface: Map, voids: Array | None = None) -> dict[str, Any]:
    """Figure of the heights of a map about their mean as colours.

    ``voids``, shape (nx, ny), are points without data in the file, which are left blank.
    """
    heights = surface.heights - np.mean(surface.heights)
    low, high = (float(value) for value in np.percentile(heights, [_BEYOND, 100.0 - _BEYOND]))
    if voids is not None:
        heights = np.where(voids, np.nan, heights)
    pixels, block = coarser(heights)
    along, length = unit_for(0.5 * max(surface.length_x, surface.length_y), "m")
    factor, unit = unit_for(max(-low, high, 1e-12), "m", least=1.0)
    trace = {
        "type": "heatmap",
        **_axis("x", surface.x, block[0], along),
        **_axis("y", surface.y, block[1], along),
        "z": values(factor * pixels.T, 4),
        "zmin": factor * low,
        "zmax": factor * high,
        "colorscale": FILM_COLOURS,
        "colorbar": {"title": {"text": f"height [{unit}]", "side": "right"}, "thickness": 12, "len": 1.0},
        "hovertemplate": f"x %{{x:,.5~r}} {length}<br>y %{{y:,.5~r}} {length}<br>height %{{z}} {unit}"
        "<extra></extra>",
    }
    return plot(
        [trace],
        height=_HEIGHT,
        margin=NARROW,
        xaxis=axis(f"x [{length}]", zeroline=False, constrain="domain", showgrid=False),
        yaxis=axis(f"y [{length}]", zeroline=False, constrain="domain", showgrid=False, scaleanchor="x"),
    )


def _axis(name: str, places: Array, block: int, factor: float) -> dict[str, float]:
    """Position of the first pixel along an axis, in the middle of its block, and distance between pixels."""
    step = float(places[1] - places[0]) if places.size > 1 else 1.0
    first = float(places[0]) + 0.5 * (block - 1) * step
    return {f"{name}0": factor * first, f"d{name}": factor * block * step}
