"""Figures of a line contact: pressure, film, field, heat and touching spots over the position, for a page."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from ehlectric.app.charts.plotly_panels import (
    FIELD_COLOURS,
    Indices,
    Plot,
    kept_nodes,
    names_of,
    plot,
    scatter,
    stack,
    thinned,
    values,
)
from ehlectric.app.charts.plotly_panels import axis as plot_axis
from ehlectric.app.view_models import Figure
from ehlectric.arrays import Array
from ehlectric.contact import PointResult, Result
from ehlectric.figures.contact_profiles import (
    BEFORE,
    BEHIND,
    SPOTS,
    Line,
    field_scale,
    field_strength,
    film_scale,
    film_thickness,
    heat,
    pressure,
    touches,
)
from ehlectric.figures.data import Along
from ehlectric.film import pressure_error_text
from ehlectric.quantities.palette import ORANGE
from ehlectric.quantities.units import unit_for
from ehlectric.readable import readable


@dataclass(frozen=True)
class Lengths:
    """Unit of lengths along the surfaces of a contact."""

    factor: float
    unit: str

    @classmethod
    def of(cls, result: Result | PointResult) -> Lengths:
        """Unit that suits the half-width of a contact, or its semi-axis along entrainment."""
        return cls(*unit_for(result.conditions.half_width, "m", least=1.0))


def main_numbers(result: Result | PointResult) -> str:
    """Sentence with minimum film, maximum pressure and maximum field of a solved contact."""
    film = result.film
    least = "Asperities are in contact: minimum film" if touches(result) else "Minimum film"
    to_h, length = unit_for(film_scale(result), "m")
    to_p, pressure = unit_for(film.max_pressure, "Pa")
    error = pressure_error_text(film.max_pressure_error)
    doubt = f" ({error})" if error else ""
    to_e, strength = unit_for(result.field.max_strength, "V/m")
    return (
        f"{least} {readable(to_h * film.minimum_thickness, 4)} {length}, maximum pressure "
        f"{readable(to_p * film.max_pressure, 4)} {pressure}{doubt}, maximum field "
        f"{readable(to_e * result.field.max_strength, 4)} {strength}."
    )


# Sentence on a scale of the field that excludes the spots.
BEYOND = "The scale of the field ends below the field in the spots."

# Largest number of marks of spots on a map.
_MARKS = 2000


def spot_position(result: PointResult) -> tuple[float, float]:
    """Point [m] through which cuts go at first: highest pressure of asperities, or the minimum film."""
    film = result.film
    if film.contact_pressure is None or not touches(result):
        return film.minimum_position
    i, j = np.unravel_index(np.argmax(film.contact_pressure), film.contact_pressure.shape)
    return float(film.x[i]), float(film.y[j])


def spot_marks(result: PointResult, factor: float, *, turned: bool) -> list[Plot]:
    """Marks at the nodes of a map at which the surfaces touch; at most 2000, spread evenly."""
    if not touches(result):
        return []
    i, j = np.nonzero(result.film.contact)
    kept = kept_nodes(i.size, _MARKS)
    x, y = (factor * axis[at[kept]] for axis, at in zip(result.film.axes, (i, j), strict=True))
    marker = {"symbol": "square", "size": 4, "color": ORANGE}
    drawn = (y, x) if turned else (x, y)
    return [scatter(*drawn, marker=marker, name=SPOTS, showlegend=True)]


def mark(x: float, y: float, name: str) -> Plot:
    """Cross at the place of an extreme, whose value is in its name."""
    marker = {"symbol": "x-thin", "size": 11, "line": {"color": ORANGE, "width": 3}}
    return scatter([x], [y], marker=marker, name=name, showlegend=True)


def spots_text(result: Result | PointResult) -> str:
    """Sentence below a figure about spots; empty where the surfaces do not touch."""
    if not touches(result):
        return ""
    least = result.film.minimum_thickness
    factor, unit = unit_for(least, "m")
    return f"At the contact spots the film is the boundary film of {readable(factor * least)} {unit}."


# Largest number of columns of the map, and its rows.
_COLUMNS, _ROWS = 300, 90

# Number of lines of equal potential between the potentials of the surfaces.
_POTENTIALS = 9


def line_figures(result: Result) -> dict[str, Figure]:
    """Figures of a line contact by name: pressure, film and field over the position ("profiles"), and the map
    of the field in the film ("section").
    """
    film = result.film
    if not (np.isfinite(film.thickness).all() and np.isfinite(film.pressure).all()):
        return {}
    section = {"section": _section(result)} if result.converged else {}
    return {"profiles": _profiles(result)} | section


# Layout of a figure whose legend of long names stands below it.
_BELOW: dict[str, Any] = {
    "margin": {"l": 62, "r": 16, "t": 16, "b": 50},
    "legend": {"orientation": "h", "x": 0.0, "xanchor": "left", "y": -0.14, "yanchor": "top"},
}


def _profiles(result: Result) -> Figure:
    film, conditions = result.film, result.conditions
    lengths = Lengths.of(result)
    factor, unit = lengths.factor, lengths.unit
    b = factor * conditions.half_width
    window = max(factor * float(film.x[0]), BEFORE * b), min(factor * float(film.x[-1]), BEHIND * b)
    along = Along("x", unit, window, (-b, b))
    line = Line.through(result, factor)
    panels = [pressure(line), film_thickness(line)]
    if result.converged:
        panels += [field_strength(line), *heat(line)]
    sentence = f"Over x in {unit}: {', '.join(names_of(panels))}."
    notes = (
        f"Oil enters on the left. Dashed lines: edges of the Hertzian contact, x = ±{readable(b, 4)} {unit}.",
        spots_text(result),
        BEYOND if result.converged and touches(result) else "",
    )
    return Figure(
        "Pressure, film and field along entrainment",
        f"{sentence} {main_numbers(result)}"
        if result.converged
        else f"{sentence} The film did not converge.",
        stack(along, panels, converged=result.converged, **_BELOW),
        caption=" ".join(filter(None, notes)),
    )


def _section(result: Result) -> Figure:
    """Map of the field in the film, over position and height."""
    field, conditions = result.field, result.conditions
    to_x, unit = (lengths := Lengths.of(result)).factor, lengths.unit
    scale = field_scale(result)
    to_z, height = unit_for(film_scale(result), "m")
    to_e, strength = unit_for(scale, "V/m")
    most = np.max(field.strength, axis=1)
    kept = thinned([most], _COLUMNS // 2)
    x, walls = to_x * field.x[kept], to_z * field.y[kept]
    z = np.linspace(float(walls.min()), float(walls.max()), _ROWS)
    inside = np.abs(field.x) <= conditions.half_width
    low = float(np.min(most[inside])) if inside.any() else 0.0
    k, j = np.unravel_index(np.argmax(field.strength), field.strength.shape)
    heat = {
        "type": "heatmap",
        "x": values(x),
        "y": values(z),
        "z": values(_rows(z, walls, to_e * field.strength[kept]), 4),
        "zmin": to_e * low,
        "zmax": to_e * scale,
        "colorscale": FIELD_COLOURS,
        "colorbar": {"title": {"text": strength}, "thickness": 12},
        "hovertemplate": f"x = %{{x:,.5~r}} {unit}<br>height %{{y:,.4~r}} {height}<br>"
        f"field %{{z:,.4~r}} {strength}<extra></extra>",
        "hoverongaps": False,
    }
    name = f"maximum, {readable(to_e * field.max_strength, 4)} {strength}"
    cross = mark(to_x * field.x[k], to_z * field.y[k, j], name)
    traces = [heat, *_bodies(x, walls), _potentials(result, kept, to_x, to_z), cross]
    return Figure(
        "Field in the film",
        f"Map of the field strength in {strength} in the film, over x in {unit} and height in {height}. "
        f"{main_numbers(result)}",
        plot(
            traces,
            height=420,
            xaxis=plot_axis(f"x [{unit}]"),
            yaxis=plot_axis(f"height [{height}]", range=[float(z[0]), float(z[-1])]),
            hovermode="closest",
        ),
        caption=f"Heights are stretched. The colours begin at the smallest field of the Hertzian contact, "
        f"{readable(to_e * low)} {strength}. Values between nodes are interpolated; the maximum is a "
        "node's own." + (f" {BEYOND}" if touches(result) else ""),
    )


def _rows(z: Array, walls: Array, strength: Array) -> Array:
    """Values at heights z in every column, (rows, columns); nan in the bodies, except a row at the walls."""
    step = float(z[1] - z[0])
    rows = np.full((z.size, walls.shape[0]), np.nan)
    for k, (heights, along) in enumerate(zip(walls, strength, strict=True)):
        near = (z >= heights[0] - step) & (z <= heights[-1] + step)
        rows[near, k] = np.interp(z[near], heights, along)
    return rows


def _bodies(x: Array, walls: Array) -> Iterator[Plot]:
    """Filled bodies below and above the film."""
    low, high = float(walls.min()), float(walls.max())
    far = high - low
    for name, wall, end in (("surface 1", walls[:, 0], low - far), ("surface 2", walls[:, -1], high + far)):
        yield scatter(
            [x[0], *x, x[-1]],
            [end, *wall, end],
            fill="toself",
            fillcolor="#a8afb8",
            line={"color": "#59636e", "width": 1},
            name=name,
            showlegend=False,
        )


def _potentials(result: Result, kept: Indices, to_x: float, to_z: float) -> Plot:
    """Lines of equal potential, one after another in one trace."""
    field, electric = result.field, result.case.electric
    levels = np.linspace(electric.potential_1, electric.potential_2, _POTENTIALS + 2)[1:-1]
    sign = 1.0 if levels[-1] > levels[0] else -1.0
    heights = to_z * np.array([np.interp(sign * levels, sign * field.potential[k], field.y[k]) for k in kept])
    gap = np.full((1, _POTENTIALS), np.nan)
    y = np.concatenate([heights, gap]).T.ravel()
    x = np.tile(np.append(to_x * field.x[kept], np.nan), _POTENTIALS)
    step = abs(float(levels[1] - levels[0]))
    return scatter(
        x,
        y,
        digits=(5, 4),
        # Seen on the colours of the field, and in the legend on a light and on a dark page.
        line={"color": "#1098ad", "width": 1},
        name=f"equal potential, every {readable(step)} V",
        visible="legendonly",
    )
