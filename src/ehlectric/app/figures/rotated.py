"""Film thickness of a point contact as a surface that can be rotated, coloured by the field."""

from __future__ import annotations

from typing import Any

import numpy as np

from ehlectric.app.answers.figure import Shown
from ehlectric.app.figures.lengths import Lengths, is_turned, main_numbers
from ehlectric.app.figures.look import FIELD_COLOURS, INK, Plot, kept_nodes, plot, values
from ehlectric.contact.results import PointResult
from ehlectric.figures.contact.profiles import field_scale, film_scale
from ehlectric.quantities.units import unit_for

# Largest number of nodes along an axis of the surface.
_MOST = 129


def film_surface(result: PointResult) -> Shown:
    """Film thickness as a surface over the columns of the field, coloured by the field."""
    lengths, field = Lengths.of(result), result.field
    to_h, film_unit = unit_for(film_scale(result), "m")
    to_e, unit = unit_for(field_scale(result), "V/m")
    gap, most = field.z[:, :, -1] - field.z[:, :, 0], np.max(field.strength, axis=-1)
    extremes = [np.unravel_index(np.argmin(gap), gap.shape), np.unravel_index(np.argmax(most), most.shape)]
    kept = [kept_nodes(size, _MOST, [int(one[k]) for one in extremes]) for k, size in enumerate(gap.shape)]
    x, y = lengths.factor * field.x[kept[0]], lengths.factor * field.y[kept[1]]
    height, colour = to_h * gap[np.ix_(*kept)].T, to_e * most[np.ix_(*kept)].T
    inside = result.zones["hertz"](field.x[:, np.newaxis], field.y)
    low = to_e * float(np.min(most[inside])) if inside.any() else 0.0
    surface = {
        "type": "surface",
        "x": values(x),
        "y": values(y),
        "z": values(height, 6),
        "surfacecolor": values(colour, 6),
        "cmin": low,
        "cmax": to_e * field_scale(result),
        "colorscale": FIELD_COLOURS,
        "colorbar": {"title": {"text": f"field<br>{unit}"}, "thickness": 12, "len": 0.7},
        "hovertemplate": f"x = %{{x:.4g}} {lengths.unit}<br>y = %{{y:.4g}} {lengths.unit}<br>"
        f"film %{{z:.4g}} {film_unit}<br>field %{{surfacecolor:.4g}} {unit}<extra></extra>",
        "lighting": {"ambient": 0.75, "diffuse": 0.5, "specular": 0.1},
    }
    thinner = gap.size > height.size
    nodes = f"{gap.shape[0]} x {gap.shape[1]}"
    told = f"{height.shape[1]} x {height.shape[0]} of {nodes} nodes" if thinner else f"all {nodes} nodes"
    marks = _points(result, lengths, to_h, to_e)
    return Shown(
        "surface",
        "Film thickness, coloured by the field",
        f"Surface of the film thickness in {film_unit}, coloured by the maximum field in {unit}. "
        f"It can be rotated. {main_numbers(result)}",
        plot([surface, *marks], height=470, **_scene(result, lengths, film_unit)),
        f"Drag to rotate, scroll to come nearer. Drawn: {told} of the field, with those of the smallest film "
        "and of the largest field; each value is a node's own.",
    )


def _points(result: PointResult, lengths: Lengths, to_h: float, to_e: float) -> list[dict[str, Any]]:
    """Pins at the minimum film and at the maximum field: the surface does not bury their heads.

    They have different lengths, as both may be at the same place.
    """
    film, field = result.film, result.field
    units = unit_for(film_scale(result), "m")[1], unit_for(field_scale(result), "V/m")[1]
    gap = field.z[:, :, -1] - field.z[:, :, 0]
    i, j = np.unravel_index(np.argmax(np.max(field.strength, axis=-1)), gap.shape)
    least = (*film.minimum_position, film.minimum_thickness)
    largest = (float(field.x[i]), float(field.y[j]), float(gap[i, j]))
    names = (
        f"minimum film, {to_h * film.minimum_thickness:.4g} {units[0]}",
        f"maximum field, {to_e * field.max_strength:.4g} {units[1]}",
    )
    looks = (("#00a0ff", "circle"), ("#00b386", "diamond"))
    return [
        {
            "type": "scatter3d",
            "mode": "lines+markers",
            "x": [lengths.factor * at[0]] * 2,
            "y": [lengths.factor * at[1]] * 2,
            "z": [to_h * at[2], to_h * at[2] + part * _top(result)],
            "line": {"color": colour, "width": 5},
            "marker": {"color": colour, "symbol": symbol, "size": [0, 6], "opacity": 1},
            "name": name,
            "hovertemplate": f"{name}<extra></extra>",
        }
        for at, name, (colour, symbol), part in zip((least, largest), names, looks, (0.25, 0.45), strict=True)
    ]


def _top(result: PointResult) -> float:
    """End of the axis of heights, in their unit; the film is far thicker around the contact."""
    film = result.film
    return 1.8 * unit_for(film_scale(result), "m")[0] * max(film.central_thickness, film.mean_thickness)


def _scene(result: PointResult, lengths: Lengths, unit: str) -> Plot:
    """Axes of the surface, cut off where the film is far thicker than in the middle."""
    ratio = min(1.8, max(0.6, result.conditions.ratio))
    look = {
        "color": INK,
        "gridcolor": INK,
        "linecolor": INK,
        "showline": True,
        "showbackground": False,
        "tickfont": {"size": 12},
    }
    # A long contact is seen from the inlet, with its long axis across the page.
    eye = {"x": -1.9, "y": -0.5, "z": 1.5} if is_turned(result) else {"x": -0.95, "y": -1.6, "z": 1.5}
    return {
        "scene": {
            "xaxis": {"title": {"text": f"x [{lengths.unit}]"}, **look},
            "yaxis": {"title": {"text": f"y [{lengths.unit}]"}, **look},
            "zaxis": {"title": {"text": f"film [{unit}]"}, "range": [0.0, _top(result)], **look},
            "aspectmode": "manual",
            "aspectratio": {"x": ratio**-0.5, "y": ratio**0.5, "z": 0.45},
            "camera": {"eye": eye, "center": {"x": 0.0, "y": 0.0, "z": -0.12}},
            "uirevision": "same",
        },
        "margin": {"l": 0, "r": 0, "t": 30, "b": 0},
    }
