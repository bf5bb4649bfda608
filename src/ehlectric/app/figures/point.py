"""Figures of a point contact: maps of film, pressure and field, with the surface of the film."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ehlectric.app.answers.contact import Reach
from ehlectric.app.answers.figure import Shown
from ehlectric.app.figures.lengths import BEFORE, BEHIND, Lengths, is_turned
from ehlectric.app.figures.look import (
    FIELD_COLOURS,
    FILM_COLOURS,
    PRESSURE_COLOURS,
    Indices,
    Plot,
    axis,
    kept_nodes,
    plot,
    values,
)
from ehlectric.app.figures.rotated import film_surface
from ehlectric.app.figures.touching import BEYOND, spot_marks, spot_position, told_of_spots
from ehlectric.arrays import Array
from ehlectric.contact.results import PointResult
from ehlectric.figures.contact.profiles import SPOTS, field_scale, film_scale, touches
from ehlectric.quantities.palette import ORANGE
from ehlectric.quantities.units import unit_for

# Largest number of nodes along an axis of a map.
_MAP = 141

# Part of the dry contact [%] whose film is above the end of the colours.
_THICKER = 2.0


def reach_of(result: PointResult) -> Reach:
    """Range of the points through which the contact can be cut, with the minimum film as the first."""
    lengths, field = Lengths.of(result), result.field
    ends = [tuple(lengths.factor * float(axis[end]) for end in (0, -1)) for axis in (field.x, field.y)]
    x, y = (lengths.factor * at for at in spot_position(result))
    turned, first = (
        is_turned(result),
        "the spot of the highest pressure" if touches(result) else "the smallest film",
    )
    return Reach((ends[0][0], ends[0][1]), (ends[1][0], ends[1][1]), (x, y), lengths.unit, turned, first)


def point_figures(result: PointResult) -> tuple[Shown, ...]:
    """Figures of a point contact.

    Parameters
    ----------
    result : PointResult
        Result of ``solve``.

    Returns
    -------
    tuple of Shown
        Maps of film, pressure and field, and the film as a surface coloured by the field. A film that did
        not converge has the maps of film and pressure only, in grey and with words across them; one with
        values that are no numbers has none.
    """
    film = result.film
    if not (np.isfinite(film.thickness).all() and np.isfinite(film.pressure).all()):
        return ()
    maps = (_film_map(result), _pressure_map(result))
    return maps if not result.converged else (*maps, _field_map(result), film_surface(result))


@dataclass(frozen=True)
class _Map:
    name: str
    title: str
    unit: str
    x: Array
    y: Array
    values: Array
    limits: tuple[float, float]
    colours: Any
    # Legend of the marked extreme; empty for a map of spots, which are marked in its place.
    marked: str
    mark: tuple[float, float]
    caption: str


def _film_map(result: PointResult) -> Shown:
    film = result.film
    factor, unit = unit_for(film_scale(result), "m")
    inside = result.zones["hertz"](film.x[:, np.newaxis], film.y)
    highest = factor * float(np.percentile(film.thickness[inside], 100.0 - _THICKER))
    least = factor * film.minimum_thickness
    x, y = film.minimum_position
    return _drawn(
        result,
        _Map(
            "film-map",
            "Film thickness",
            unit,
            film.x,
            film.y,
            factor * film.thickness,
            (least, max(highest, 1.001 * least)),
            FILM_COLOURS,
            "" if touches(result) else f"minimum film, {least:.4g} {unit}",
            (x, y),
            f"Film above {highest:.3g} {unit} has the last colour. {told_of_spots(result)}".strip(),
        ),
    )


def _pressure_map(result: PointResult) -> Shown:
    film = result.film
    factor, unit = unit_for(film.max_pressure, "Pa")
    i, j = np.unravel_index(np.argmax(film.pressure), film.pressure.shape)
    most = factor * film.max_pressure
    name, mark = f"maximum pressure, {most:.4g} {unit}", (float(film.x[i]), float(film.y[j]))
    return _drawn(
        result,
        _Map(
            "pressure-map",
            "Pressure",
            unit,
            film.x,
            film.y,
            factor * film.pressure,
            (0.0, most),
            PRESSURE_COLOURS,
            name,
            mark,
            "",
        ),
    )


def _field_map(result: PointResult) -> Shown:
    field = result.field
    scale = field_scale(result)
    factor, unit = unit_for(scale, "V/m")
    most = np.max(field.strength, axis=-1)
    inside = result.zones["hertz"](field.x[:, np.newaxis], field.y)
    low = factor * float(np.min(most[inside])) if inside.any() else 0.0
    x, y = field.max_strength_position
    return _drawn(
        result,
        _Map(
            "field-map",
            "Maximum field across the film",
            unit,
            field.x,
            field.y,
            factor * most,
            (low, factor * scale),
            FIELD_COLOURS,
            "" if touches(result) else f"maximum field, {factor * field.max_strength:.4g} {unit}",
            (x, y),
            f"Field below {low:.3g} {unit}, outside of the dry contact, has the first colour."
            + (f" {BEYOND}" if touches(result) else ""),
        ),
    )


def _drawn(result: PointResult, what: _Map) -> Shown:
    """Map with lines of equal values, the edge of the dry contact, its extreme and the lines of the cuts."""
    lengths, turned = Lengths.of(result), is_turned(result)
    kept = [_window(result, axis_, k, what) for k, axis_ in enumerate((what.x, what.y))]
    x, y = (lengths.factor * axis_[one] for axis_, one in zip((what.x, what.y), kept, strict=True))
    inside = what.values[np.ix_(*kept)]
    low, high = what.limits
    across, down, drawn = (y, x, inside) if turned else (x, y, inside.T)
    names = ("y", "x") if turned else ("x", "y")
    at = [lengths.factor * place for place in what.mark]
    across_at, down_at = reversed(at) if turned else at
    trace = {
        "type": "contour",
        "x": values(across),
        "y": values(down),
        "z": values(drawn, 5),
        "zmin": low,
        "zmax": high,
        "colorscale": what.colours if result.converged else "Greys",
        "contours": {"coloring": "heatmap", **_levels(low, high)},
        "line": {"width": 0.6, "color": "rgba(255,255,255,0.55)"},
        "colorbar": {"title": {"text": what.unit}, "thickness": 12},
        "hovertemplate": f"{names[0]} = %{{x:.4g}} {lengths.unit}<br>{names[1]} = %{{y:.4g}} {lengths.unit}"
        f"<br>{what.title.lower()} %{{z:.4g}} {what.unit}<extra></extra>",
    }
    name = what.marked
    marked = {"x": [float(across_at)], "y": [float(down_at)], "name": name, "hoverinfo": "skip"}
    marker = {"symbol": "x-thin", "size": 11, "line": {"color": ORANGE, "width": 3}}
    mark = {"type": "scatter", "mode": "markers", "marker": marker, "showlegend": True, **marked}
    marks = [*spot_marks(result, lengths.factor, turned=turned), *([mark] if name else [])]
    figure = plot(
        [trace, *marks] if result.converged else [trace],
        height=_height(across, down),
        converged=result.converged,
        shapes=_shapes(result, lengths),
        **_plane(result, names, lengths, (across, down)),
    )
    extreme = name or f"{SPOTS} at the marked nodes"
    said = f": {extreme}. A click, or the sliders below, choose the point of the cuts."
    if not result.converged:
        said = ". The film did not converge."
    return Shown(
        what.name,
        what.title,
        f"Map of the {what.title.lower()} in {what.unit} over x and y in {lengths.unit}{said}",
        figure,
        " ".join(filter(None, ["Dashed: edge of the dry contact.", what.caption, _entrainment(result)])),
    )


def _plane(result: PointResult, names: tuple[str, str], lengths: Lengths, ends: Sequence[Array]) -> Plot:
    """Layout of both axes of a map: equal scales, unless the contact is so long that it would be a line."""
    stretch = _stretch(*ends)
    vertical = [float(ends[1][0]), float(ends[1][-1])]
    note = "" if stretch == 1.0 else f", stretched {stretch:g} times"
    return {
        "xaxis": axis(f"{names[0]} [{lengths.unit}]", constrain="domain"),
        "yaxis": axis(
            f"{names[1]} [{lengths.unit}]{note}",
            range=vertical[::-1] if is_turned(result) else vertical,
            scaleanchor="x",
            scaleratio=stretch,
            constrain="domain",
        ),
        "hovermode": "closest",
        "margin": {"l": 62, "r": 8, "t": 36, "b": 48},
    }


def _stretch(across: Array, down: Array) -> float:
    """Factor by which the axis down the page is stretched."""
    return max(1.0, float(np.round(0.45 * np.ptp(across) / np.ptp(down))))


def _height(across: Array, down: Array) -> int:
    """Height of a map of usual width [px]."""
    shape = _stretch(across, down) * float(np.ptp(down) / np.ptp(across))
    return int(min(420.0, 150.0 + 280.0 * shape))


def _entrainment(result: PointResult) -> str:
    return "Oil enters from above." if is_turned(result) else "Oil enters from the left."


def _window(result: PointResult, nodes: Array, number: int, what: _Map) -> Indices:
    """Indices of the nodes of an axis that a map has, with the row of the marked extreme."""
    conditions = result.conditions
    b, ratio = conditions.semi_axis_x, conditions.ratio
    side = ratio + 0.6 * float(np.sqrt(ratio))
    low, high = (BEFORE, BEHIND) if number == 0 else (-side, side)
    first, last = np.searchsorted(nodes, [low * b, high * b * (1.0 + 1e-9)])
    extreme = int(np.argmin(np.abs(nodes - what.mark[number])))
    first, last = min(int(first), extreme), max(int(last), extreme + 1)
    return first + kept_nodes(last - first, _MAP, [extreme - first])


def _levels(low: float, high: float) -> dict[str, float]:
    """About ten round levels of the lines of a map."""
    raw = max(high - low, 1e-9 * abs(high), 1e-300) / 10.0
    decade = 10.0 ** float(np.floor(np.log10(raw)))
    step = decade * next(size for size in (1.0, 2.0, 5.0, 10.0) if size * decade >= raw * (1.0 - 1e-9))
    return {"start": step * float(np.ceil(low / step)), "end": high, "size": step}


def _shapes(result: PointResult, lengths: Lengths) -> list[dict[str, Any]]:
    """Edge of the dry contact, and the lines of the cuts, the third and the fourth."""
    b, a = (lengths.factor * length for length in result.conditions.semi_axes)
    at = [lengths.factor * place for place in spot_position(result)]
    (across, down), (across_at, down_at) = ((a, b), at[::-1]) if is_turned(result) else ((b, a), at)
    cut = {"color": ORANGE, "width": 1}
    ellipse = {"type": "circle", "x0": -across, "x1": across, "y0": -down, "y1": down}
    # White dashes on black are seen on every colour.
    edges = [
        ellipse | {"line": {"color": "rgba(0,0,0,0.6)", "width": 2.5}},
        ellipse | {"line": {"color": "#ffffff", "width": 1.5, "dash": "dash"}},
    ]
    level = {"type": "line", "xref": "x domain", "x0": 0, "x1": 1, "y0": down_at, "y1": down_at, "line": cut}
    upright = {"type": "line", "yref": "y domain", "y0": 0, "y1": 1, "x0": across_at, "x1": across_at}
    return [*edges, level, upright | {"line": cut}] if result.converged else edges
