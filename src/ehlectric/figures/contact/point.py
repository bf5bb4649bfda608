"""Figures of a point contact: each function draws one result on axes; none of them solves anything."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from ehlectric.arrays import Array, Mask
from ehlectric.cases.quantity import unit_for
from ehlectric.contact.results import PointResult
from ehlectric.field.zones import HIGH_FIELD
from ehlectric.figures.contact.cuts import cuts, field_sections
from ehlectric.figures.contact.maps import (
    Range,
    colour_bar,
    draw_map,
    entrainment,
    extreme_positions,
    field_window,
    film_unit,
    film_window,
    hertz_ellipse,
    legend_line,
    map_panels,
    mark,
    on_low_page,
    on_page,
    panel_name,
    round_levels,
)
from ehlectric.figures.names import ROUGHNESS_FIGURE
from ehlectric.figures.style import GREY, legend_above

SECTIONS = ("surface 1", "mid-film", "surface 2")

# Part of the Hertz ellipse [%], near the inlet, whose film is thicker than the end of the colour scale.
_THICKER = 2.0

# Part of the nodes [%] whose values lie beyond either end of the colour scale, in maps of the deviation from
# the thin-gap estimate and of heights of the roughness.
_DEVIATIONS_BEYOND, _HEIGHTS_BEYOND = 0.5, 0.1

# Part of the largest pressure above which no lines are drawn: at the pressure ridge they would be too dense.
_BELOW_RIDGE = 0.75
_CAVITATED = "#e3e6ea"


def film_map(result: PointResult, ax: Axes | None = None) -> Axes:
    """Draw a map of the film thickness with lines of equal thickness, as in an interferogram.

    Parameters
    ----------
    result : PointResult
        Result of a point contact.
    ax : Axes, optional
        Axes to draw on; axes of a new figure if omitted.

    Returns
    -------
    Axes
        Axes with the map. The colour bar covers the films inside the Hertz ellipse; around it the film is
        thicker than the end of the bar. Rough films have no lines of equal thickness.
    """
    film, window = result.film, film_window(result)
    ax = map_panels(result, 1, window, rows=1)[0] if ax is None else ax
    factor, unit = film_unit(result)
    thickness = factor * film.thickness
    inside = result.zones["hertz"](film.x[:, np.newaxis], film.y)
    highest = float(np.percentile(thickness[inside], 100.0 - _THICKER))
    levels = round_levels(factor * film.minimum_thickness, highest, 12)
    limits = (float(levels[0]), float(levels[-1]))
    at = (film.x, film.y)
    mesh = draw_map(result, ax, at, thickness, colours="viridis", limits=limits, window=window)
    label = f"film thickness $h$ [{unit}]"
    bar = colour_bar(result, mesh, [ax], label, window=window, ticks=levels, extend="max")
    ellipse = hertz_ellipse(result, ax)
    if not result.rough:
        lines = ax.contour(*on_page(result, *at), thickness, levels, colors="black", linewidths=0.5)
        # Around the ellipse the gap widens so fast that the lines would merge to a black band.
        lines.set_clip_path(ellipse)
        bar.add_lines(lines)
    minimum = f"minimum, {factor * film.minimum_thickness:.3g} {unit}"
    lowest = mark(result, ax, extreme_positions(*at, -film.thickness), minimum)
    legend_above(ax, [legend_line(ellipse), lowest])
    entrainment(result, ax)
    return ax


def pressure_map(result: PointResult, ax: Axes | None = None) -> Axes:
    """Draw a map of the pressure with lines of equal pressure, and the cavitated region hatched.

    Parameters
    ----------
    result : PointResult
        Result of a point contact.
    ax : Axes, optional
        Axes to draw on; axes of a new figure if omitted.

    Returns
    -------
    Axes
        Axes with the map, and a colour bar beside them.
    """
    film, window = result.film, film_window(result)
    ax = map_panels(result, 1, window, rows=1)[0] if ax is None else ax
    factor, unit = unit_for(film.max_pressure, "Pa")
    pressure = factor * film.pressure
    at = (film.x, film.y)
    limits = (0.0, factor * film.max_pressure)
    mesh = draw_map(result, ax, at, pressure, colours="magma", limits=limits, window=window)
    levels = round_levels(*limits, 10)
    bar = colour_bar(result, mesh, [ax], f"pressure $p$ [{unit}]", window=window, ticks=levels)
    if not result.rough:
        inner = levels[(levels > 0.0) & (levels < _BELOW_RIDGE * limits[1])]
        bar.add_lines(
            ax.contour(*on_page(result, *at), pressure, inner, colors="white", linewidths=0.4, alpha=0.6)
        )
    cavitated = _cavitated(result, ax)
    highest = f"maximum, {factor * film.max_pressure:.3g} {unit}"
    peak = mark(result, ax, extreme_positions(*at, film.pressure), highest)
    legend_above(ax, [legend_line(hertz_ellipse(result, ax, "white")), peak, cavitated], 3)
    entrainment(result, ax, ink="white")
    return ax


def _cavitated(result: PointResult, ax: Axes) -> Patch:
    """Hatch the cavitated region, where the pressure is ambient, and return its legend entry.

    The boundary nodes of the domain are at ambient pressure in any case. They are hatched where the node
    beside them, one row inside, cavitates.
    """
    film = result.film
    cavitated = np.pad(film.cavitated[1:-1, 1:-1], 1, mode="edge").astype(float)
    if np.any(cavitated):
        where = on_page(result, film.x, film.y)
        area = ax.contourf(*where, cavitated, [0.5, 1.5], colors=[_CAVITATED], hatches=["////"])
        area.set(edgecolor=GREY, linewidth=0.0)
    return Patch(label="cavitated", hatch="////", facecolor=_CAVITATED, edgecolor=GREY, linewidth=0.0)


def field_map(result: PointResult, ax: Axes | None = None, *, section: str = "mid-film") -> Axes:
    """Draw a map of the field strength on a wall or at mid-film, with the zone of high field and the maximum.

    Parameters
    ----------
    result : PointResult
        Result of a point contact.
    ax : Axes, optional
        Axes to draw on; axes of a new figure if omitted.
    section : str
        Section of the film that is drawn: "mid-film", "surface 1" or "surface 2".

    Returns
    -------
    Axes
        Axes with the map and its colour bar, which ends at the largest field of all three sections.
    """
    field, window = result.field, field_window(result)
    columns = 3 if on_low_page(result, 1, window) else 2
    ax = map_panels(result, 1, window, rows=4 - columns)[0] if ax is None else ax
    factor, unit = unit_for(field.max_strength, "V/m")
    strength = _strength(result, section)
    at = (field.x, field.y)
    limits = (0.0, factor * field.max_strength)
    mesh = draw_map(result, ax, at, factor * strength, colours="inferno", limits=limits, window=window)
    label = rf"$|E|$, {section} [{unit}]"
    colour_bar(result, mesh, [ax], label, window=window, ticks=round_levels(*limits, 8))
    level = HIGH_FIELD * float(np.max(strength))
    if np.min(strength) < level:
        ax.contour(*on_page(result, *at), strength, [level], colors="#00e5ff", linewidths=0.9)
    handles = [
        legend_line(hertz_ellipse(result, ax, "white")),
        Line2D([], [], color="#00b8d4", lw=0.9, label=f"{100.0 * HIGH_FIELD:g} % of the maximum"),
    ]
    where = f", {field.max_strength_wall}" if result.rough else ""
    largest = f"largest, {factor * field.max_strength:.3g} {unit}{where}"
    handles.append(mark(result, ax, _largest(result), largest))
    legend_above(ax, handles, columns)
    entrainment(result, ax, ink="white")
    return ax


def _strength(result: PointResult, section: str) -> Array:
    """Field strength abs(E) on a wall or at mid-film [V/m], shape (nx, ny)."""
    field = result.field
    strengths = (field.surface_1_strength, field.middle_strength, field.surface_2_strength)
    return strengths[SECTIONS.index(section)]


def _largest(result: PointResult) -> Array:
    """Positions x, y of the largest field on the walls and at mid-film [m], shape (n, 2)."""
    field = result.field
    return extreme_positions(field.x, field.y, _strength(result, field.max_strength_wall))


def field_deviation(result: PointResult, axes: Sequence[Axes] | None = None) -> Axes:
    """Draw three maps of the deviation of the field strength from the thin-gap estimate V12/h.

    The maps are of both walls and of mid-film.

    Parameters
    ----------
    result : PointResult
        Result of a point contact.
    axes : sequence of Axes, optional
        Three axes to draw on; axes of a new figure if omitted.

    Returns
    -------
    Axes
        The first axes. The deviations are in per mille of V12/h, and shown inside the Hertz ellipse only:
        near the side faces of the field domain, the faces disturb the field.
    """
    field, window = result.field, field_window(result)
    panels = {name: 1e3 * (_strength(result, name) / field.thin_gap_strength - 1.0) for name in SECTIONS}
    inside = result.zones["hertz"](field.x[:, np.newaxis], field.y)
    ends = _ends(panels, field.inner & inside, _DEVIATIONS_BEYOND)
    label = r"$|E|\,h/V_{12} - 1$ [‰]"
    at = (field.x, field.y)
    return _compared(result, axes, at, panels, window=window, ends=ends, label=label, clipped=True)


def roughness(result: PointResult, axes: Sequence[Axes] | None = None) -> Axes:
    """Draw maps of the sum of the roughness of both surfaces, and of the change it makes to the film.

    Parameters
    ----------
    result : PointResult
        Result of a point contact.
    axes : sequence of Axes, optional
        Two axes to draw on, or one if the smooth contact was not solved; axes of a new figure if omitted.

    Returns
    -------
    Axes
        The first axes, with the heights; peaks of either surface are positive. The second axes have the rough
        film minus the smooth film, with the same colours. If the contact does not flatten the roughness, this
        change is the height with its sign reversed. The second map is left out if the smooth contact was
        not solved.
    """
    window, film, heights = film_window(result), result.film, result.roughness.sum(axis=0)
    factor, unit = unit_for(float(np.max(np.abs(heights))), "m", least=1.0)
    panels = {"roughness $z_1 + z_2$": factor * heights}
    if result.smooth is not None:
        change = factor * (film.thickness - result.smooth.thickness)
        panels[r"change of the film, $h - h_\mathrm{smooth}$"] = change
    b, at = result.conditions.semi_axis_x, (film.x, film.y)
    along, across = ((x / b >= low) & (x / b <= high) for x, (low, high) in zip(at, window, strict=True))
    ends = _ends(panels, np.outer(along, across), _HEIGHTS_BEYOND)
    label = f"height, change of the film [{unit}]" if len(panels) == 2 else f"height [{unit}]"
    first = _compared(result, axes, at, panels, window=window, ends=ends, label=label)
    entrainment(result, first)
    return first


def _ends(panels: Mapping[str, Array], region: Mask, beyond: float) -> Range:
    """Ends of the colours of several maps, so that ``beyond`` per cent of the nodes lie beyond either end.

    Nodes of ``region`` count, or all nodes if it is empty.
    """
    region = region if np.any(region) else np.ones_like(region)
    values = np.concatenate([panel[region] for panel in panels.values()])
    low, high = np.percentile(values, [beyond, 100.0 - beyond])
    return float(low), float(high)


def _compared(
    result: PointResult,
    axes: Sequence[Axes] | None,
    position: tuple[Array, Array],
    panels: Mapping[str, Array],
    *,
    window: tuple[Range, Range],
    ends: Range,
    label: str,
    clipped: bool = False,
) -> Axes:
    """Draw maps with the same colours and one colour bar, inside the Hertz ellipse only if ``clipped``."""
    number = len(panels)
    axes = map_panels(result, number, window) if axes is None else axes
    look: dict[str, Any] = {"colours": "viridis", "limits": ends, "window": window, "number": number}
    for ax, (name, values) in zip(axes, panels.items(), strict=True):
        mesh = draw_map(result, ax, position, values, **look)
        ellipse = hertz_ellipse(result, ax)
        if clipped:
            mesh.set_clip_path(ellipse)
        panel_name(ax, name)
        ax.label_outer()
    colour_bar(result, mesh, axes, label, window=window, ticks=round_levels(*ends, 8), extend="both")
    return axes[0]


POINT_FIGURES: dict[str, Callable[..., Axes]] = {
    "film_map.png": film_map,
    "pressure_map.png": pressure_map,
    "field_map.png": field_map,
    "field_deviation.png": field_deviation,
    "field_sections.png": field_sections,
    "cuts.png": cuts,
}


def point_figures_of(result: PointResult) -> dict[str, Callable[..., Axes]]:
    """Functions that draw the figures of a point contact, by file name."""
    return POINT_FIGURES | ({ROUGHNESS_FIGURE: roughness} if np.any(result.roughness) else {})
