"""Figures of a point contact for a page: maps and cuts of film, pressure and field, and a surface."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ehlectric.app.charts.line_charts import (
    BEYOND,
    Lengths,
    main_numbers,
    mark,
    spot_marks,
    spot_position,
    spots_text,
)
from ehlectric.app.charts.plotly_panels import (
    FIELD_COLOURS,
    FILM_COLOURS,
    INK,
    PRESSURE_COLOURS,
    Indices,
    Plot,
    axis,
    kept_nodes,
    names_of,
    plot,
    stack,
    values,
)
from ehlectric.app.view_models import Figure, Reach
from ehlectric.arrays import Array
from ehlectric.contact import PointResult
from ehlectric.figures.contact_profiles import (
    BEFORE,
    BEHIND,
    SPOTS,
    Line,
    field_scale,
    field_strength,
    film_scale,
    film_thickness,
    is_turned,
    pressure,
    touches,
)
from ehlectric.figures.data import Along
from ehlectric.film import pressure_error_text
from ehlectric.quantities.palette import ORANGE
from ehlectric.quantities.units import unit_for
from ehlectric.readable import readable

# Largest number of nodes along an axis of the surface, and of a map.
_MOST, _MAP = 129, 141

# Part of the Hertzian contact [%] whose film is above the end of the colours.
_THICKER = 2.0


def film_surface(result: PointResult) -> Figure:
    """Film thickness as a surface over the columns of the field, coloured by the field."""
    lengths, field = Lengths.of(result), result.field
    to_h, film_unit = unit_for(film_scale(result), "m")
    to_e, unit = unit_for(field_scale(result), "V/m")
    gap, most = field.z[:, :, -1] - field.z[:, :, 0], np.max(field.strength, axis=-1)
    extremes = [np.unravel_index(np.argmin(gap), gap.shape), np.unravel_index(np.argmax(most), most.shape)]
    kept = [kept_nodes(size, _MOST, [int(node[k]) for node in extremes]) for k, size in enumerate(gap.shape)]
    x, y = lengths.factor * field.x[kept[0]], lengths.factor * field.y[kept[1]]
    height, colour = to_h * gap[np.ix_(*kept)].T, to_e * most[np.ix_(*kept)].T
    surface = {
        "type": "surface",
        "x": values(x),
        "y": values(y),
        "z": values(height, 6),
        "surfacecolor": values(colour, 6),
        "cmin": to_e * _least_field(result),
        "cmax": to_e * field_scale(result),
        "colorscale": FIELD_COLOURS,
        "colorbar": {"title": {"text": f"field<br>{unit}"}, "thickness": 12, "len": 0.7},
        "hovertemplate": f"x = %{{x:,.4~r}} {lengths.unit}<br>y = %{{y:,.4~r}} {lengths.unit}<br>"
        f"film %{{z:,.4~r}} {film_unit}<br>field %{{surfacecolor:,.4~r}} {unit}<extra></extra>",
        "lighting": {"ambient": 0.75, "diffuse": 0.5, "specular": 0.1},
    }
    nodes = f"{gap.shape[0]} x {gap.shape[1]} nodes"
    some = f"{height.shape[1]} x {height.shape[0]} of" if gap.size > height.size else "all"
    return Figure(
        "Film thickness, coloured by the field",
        f"Surface of the film thickness in {film_unit}, coloured by the maximum field in {unit}. "
        f"It can be rotated. {main_numbers(result)}",
        plot([surface, *_pins(result, lengths)], height=470, **_scene(result, lengths, film_unit)),
        caption=f"Drag to rotate, scroll to come nearer. Drawn: {some} {nodes} of the field, with "
        "the smallest film and the largest field; each value is a node's own.",
    )


def _least_field(result: PointResult) -> float:
    """Smallest field of the Hertzian contact, at its largest across the film [V/m]."""
    field = result.field
    inside = result.zones["hertz"](field.x[:, np.newaxis], field.y)
    return float(np.min(np.max(field.strength, axis=-1)[inside])) if inside.any() else 0.0


def _pins(result: PointResult, lengths: Lengths) -> list[Plot]:
    """Pins at the minimum film and at the maximum field: the surface does not bury their heads.

    They have different lengths, as both may be at the same place.
    """
    film, field = result.film, result.field
    (to_h, height), (to_e, strength) = unit_for(film_scale(result), "m"), unit_for(field_scale(result), "V/m")
    gap = field.z[:, :, -1] - field.z[:, :, 0]
    i, j = np.unravel_index(np.argmax(np.max(field.strength, axis=-1)), gap.shape)
    least = (*film.minimum_position, film.minimum_thickness)
    largest = (float(field.x[i]), float(field.y[j]), float(gap[i, j]))
    names = (
        f"minimum film, {readable(to_h * film.minimum_thickness, 4)} {height}",
        f"maximum field, {readable(to_e * field.max_strength, 4)} {strength}",
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
    x, y = (-1.9, -0.5) if is_turned(result.conditions) else (-0.95, -1.6)
    return {
        "scene": {
            "xaxis": {"title": {"text": f"x [{lengths.unit}]"}, **look},
            "yaxis": {"title": {"text": f"y [{lengths.unit}]"}, **look},
            "zaxis": {"title": {"text": f"film [{unit}]"}, "range": [0.0, _top(result)], **look},
            "aspectmode": "manual",
            "aspectratio": {"x": ratio**-0.5, "y": ratio**0.5, "z": 0.45},
            "camera": {"eye": {"x": x, "y": y, "z": 1.5}, "center": {"x": 0.0, "y": 0.0, "z": -0.12}},
            "uirevision": "same",
        },
        "margin": {"l": 0, "r": 0, "t": 30, "b": 0},
    }


def point_cuts(result: PointResult, x: float, y: float) -> dict[str, Figure]:
    """Pressure, film and field along x and along y through the nodes nearest to a point (x, y) [m]."""
    return {f"cut-{along}": _cut(result, along, y if along == "x" else x) for along in ("x", "y")}


def _cut(result: PointResult, along: str, at: float) -> Figure:
    lengths, conditions, first = Lengths.of(result), result.conditions, along == "x"
    line = Line.through(result, lengths.factor, along, at)
    assert line.film_cut is not None
    place = line.film_cut.position
    panels = [pressure(line), film_thickness(line), field_strength(line)]
    semi = lengths.factor * conditions.semi_axes[0 if first else 1]
    edge = _edge(semi, place / conditions.semi_axes[1 if first else 0])
    window = (BEFORE * semi, BEHIND * semi) if first else (-1.5 * semi, 1.5 * semi)
    window = max(window[0], float(line.x[0])), min(window[1], float(line.x[-1]))
    title = (
        f"Cut along {along} at {'y' if first else 'x'} = {readable(lengths.factor * place, 4)} {lengths.unit}"
    )
    if edge is None:
        caption = "This cut is outside of the Hertzian contact."
    else:
        caption = (
            f"Dashed lines: edges of the Hertzian contact on this cut, {along} = ±{readable(edge, 4)} "
            f"{lengths.unit}."
        )
    return Figure(
        title,
        f"{title}. Over {along} in {lengths.unit}: {', '.join(names_of(panels))}.",
        stack(Along(along, lengths.unit, window, () if edge is None else (-edge, edge)), panels),
        caption=f"{caption} {BEYOND}" if touches(result) else caption,
    )


def _edge(semi: float, off: float) -> float | None:
    """Half-length of a chord of the Hertzian contact, ``off`` semi-axes from its middle; None outside."""
    return semi * math.sqrt(1.0 - off**2) if abs(off) < 1.0 else None


def reach_of(result: PointResult) -> Reach:
    """Range of the points through which the contact can be cut, with the minimum film as the first."""
    lengths, field = Lengths.of(result), result.field
    ends = [
        (lengths.factor * float(nodes[0]), lengths.factor * float(nodes[-1])) for nodes in (field.x, field.y)
    ]
    x, y = (lengths.factor * at for at in spot_position(result))
    first = "the spot of the highest pressure" if touches(result) else "the smallest film"
    return Reach(ends[0], ends[1], (x, y), lengths.unit, is_turned(result.conditions), first)


def point_figures(result: PointResult) -> dict[str, Figure]:
    """Figures of a point contact by name: its film as a surface, and maps of film, pressure and field."""
    film = result.film
    if not (np.isfinite(film.thickness).all() and np.isfinite(film.pressure).all()):
        return {}
    maps = {"film-map": _film_map(result), "pressure-map": _pressure_map(result)}
    if result.converged:
        maps["field-map"] = _field_map(result)
    surface = {"surface": film_surface(result)} if result.converged else {}
    return surface | {name: _drawn(result, shown_map) for name, shown_map in maps.items()}


@dataclass(frozen=True)
class _Map:
    """Map over x and y: values with their unit, the ends of its colours, and its marked extreme."""

    title: str
    axes: tuple[Array, Array]
    values: Array
    unit: str
    limits: tuple[float, float]
    colours: Any
    mark: tuple[float, float]
    # Legend of the marked extreme; empty for a map of spots, which are marked instead.
    marked: str
    caption: str = ""


def _film_map(result: PointResult) -> _Map:
    film = result.film
    factor, unit = unit_for(film_scale(result), "m")
    inside = result.zones["hertz"](film.x[:, np.newaxis], film.y)
    highest = factor * float(np.percentile(film.thickness[inside], 100.0 - _THICKER))
    least = factor * film.minimum_thickness
    return _Map(
        title="Film thickness",
        axes=(film.x, film.y),
        values=factor * film.thickness,
        unit=unit,
        limits=(least, max(highest, 1.001 * least)),
        colours=FILM_COLOURS,
        mark=film.minimum_position,
        marked="" if touches(result) else f"minimum film, {readable(least, 4)} {unit}",
        caption=f"Film above {readable(highest)} {unit} has the last colour. {spots_text(result)}".strip(),
    )


def _pressure_map(result: PointResult) -> _Map:
    film = result.film
    factor, unit = unit_for(film.max_pressure, "Pa")
    i, j = np.unravel_index(np.argmax(film.pressure), film.pressure.shape)
    most, error = factor * film.max_pressure, pressure_error_text(film.max_pressure_error)
    return _Map(
        title="Pressure",
        axes=(film.x, film.y),
        values=factor * film.pressure,
        unit=unit,
        limits=(0.0, most),
        colours=PRESSURE_COLOURS,
        mark=(float(film.x[i]), float(film.y[j])),
        marked=", ".join(filter(None, [f"maximum pressure, {readable(most, 4)} {unit}", error])),
    )


def _field_map(result: PointResult) -> _Map:
    field = result.field
    scale = field_scale(result)
    factor, unit = unit_for(scale, "V/m")
    low = factor * _least_field(result)
    below = f"Field below {readable(low)} {unit}, outside of the Hertzian contact, has the first colour."
    beyond = BEYOND if touches(result) else ""
    return _Map(
        title="Maximum field across the film",
        axes=(field.x, field.y),
        values=factor * np.max(field.strength, axis=-1),
        unit=unit,
        limits=(low, factor * scale),
        colours=FIELD_COLOURS,
        mark=field.max_strength_position,
        marked="" if touches(result) else f"maximum field, {readable(factor * field.max_strength, 4)} {unit}",
        caption=f"{below} {beyond}".strip(),
    )


def _drawn(result: PointResult, what: _Map) -> Figure:
    """Map with contour lines, the edge of the Hertzian contact, the extreme and the lines of the cuts."""
    lengths, turned = Lengths.of(result), is_turned(result.conditions)
    kept = [_window(result, axis_, k, what.mark[k]) for k, axis_ in enumerate(what.axes)]
    x, y = (lengths.factor * axis_[nodes] for axis_, nodes in zip(what.axes, kept, strict=True))
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
        "hovertemplate": f"{names[0]} = %{{x:,.4~r}} {lengths.unit}<br>"
        f"{names[1]} = %{{y:,.4~r}} {lengths.unit}<br>"
        f"{what.title.lower()} %{{z:,.4~r}} {what.unit}<extra></extra>",
    }
    name = what.marked
    cross = [mark(across_at, down_at, name)] if name else []
    marks = [*spot_marks(result, lengths.factor, turned=turned), *cross]
    figure = plot(
        [trace, *marks] if result.converged else [trace],
        height=_height(across, down),
        converged=result.converged,
        shapes=_shapes(result, lengths),
        **_plane(result, names, lengths, (across, down)),
    )
    entrainment = f"Oil enters from {'above' if turned else 'the left'}."
    extreme = name or f"{SPOTS} at the marked nodes"
    said = f": {extreme}. A click, or the sliders below, choose the point of the cuts."
    if not result.converged:
        said = ". The film did not converge."
    return Figure(
        what.title,
        f"Map of the {what.title.lower()} in {what.unit} over x and y in {lengths.unit}{said}",
        figure,
        caption=" ".join(filter(None, ["Dashed: edge of the Hertzian contact.", what.caption, entrainment])),
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
            range=vertical[::-1] if is_turned(result.conditions) else vertical,
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


def _window(result: PointResult, nodes: Array, number: int, mark_at: float) -> Indices:
    """Indices of the nodes of an axis that a map has, with the row of the marked extreme."""
    conditions = result.conditions
    b, ratio = conditions.semi_axis_x, conditions.ratio
    side = ratio + 0.6 * float(np.sqrt(ratio))
    low, high = (BEFORE, BEHIND) if number == 0 else (-side, side)
    first, last = np.searchsorted(nodes, [low * b, high * b * (1.0 + 1e-9)])
    extreme = int(np.argmin(np.abs(nodes - mark_at)))
    first, last = min(int(first), extreme), max(int(last), extreme + 1)
    return first + kept_nodes(last - first, _MAP, [extreme - first])


def _levels(low: float, high: float) -> dict[str, float]:
    """About ten round levels of the lines of a map."""
    raw = max(high - low, 1e-9 * abs(high), 1e-300) / 10.0
    decade = 10.0 ** float(np.floor(np.log10(raw)))
    step = decade * next(size for size in (1.0, 2.0, 5.0, 10.0) if size * decade >= raw * (1.0 - 1e-9))
    return {"start": step * float(np.ceil(low / step)), "end": high, "size": step}


def _shapes(result: PointResult, lengths: Lengths) -> list[Plot]:
    """Edge of the Hertzian contact, and the lines of the cuts, the third and the fourth."""
    b, a = (lengths.factor * length for length in result.conditions.semi_axes)
    at = [lengths.factor * place for place in spot_position(result)]
    turned = is_turned(result.conditions)
    (across, down), (across_at, down_at) = ((a, b), at[::-1]) if turned else ((b, a), at)
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
