"""Figures of a point contact: each function draws one result on axes; none of them solves anything."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from ehlectric.arrays import Array, Mask
from ehlectric.contact.results import PointResult
from ehlectric.field.zones import HIGH_FIELD
from ehlectric.figures.contact.breakdown import breakdown_figures_of
from ehlectric.figures.contact.cuts import cuts, field_sections
from ehlectric.figures.contact.findings import has_spike
from ehlectric.figures.contact.heat import heat_figures_of
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
    say,
)
from ehlectric.figures.contact.meter import meter_figures_of
from ehlectric.figures.contact.refined import refined, smoothed
from ehlectric.figures.contact.spots import spots_figures_of
from ehlectric.figures.names import ROUGHNESS_FIGURE
from ehlectric.figures.style import legend_above
from ehlectric.quantities.palette import GREY, OUT_OF_RANGE
from ehlectric.quantities.units import unit_for

SECTIONS = ("surface 1", "mid-film", "surface 2")

# Part of the Hertz ellipse [%], near the inlet, whose film is thicker than the end of the colour scale.
_THICKER = 2.0

# Part of the nodes [%] whose values lie beyond either end of the colour scale, in maps of the deviation from
# the thin-gap estimate and of heights of the roughness.
_DEVIATIONS_BEYOND, _HEIGHTS_BEYOND = 0.5, 0.1

# Part of the range of the colours by which the deviations of two walls may differ to share a map.
_ALIKE = 0.05

# Part of the Hertz pressure above which no lines are drawn: at the pressure ridge they would be too dense.
_BELOW_RIDGE = 0.95
_CAVITATED = "#e3e6ea"


def film_map(result: PointResult, ax: Axes | None = None) -> Axes:
    """Draw a map of the film thickness with lines of equal thickness, and mark the minimum.

    Parameters
    ----------
    result : PointResult
        Result of a point contact.
    ax : Axes, optional
        Axes to draw on; axes of a new figure if omitted.

    Returns
    -------
    Axes
        Axes with the map. The colours cover the films inside the Hertz ellipse; the thicker film around it is
        grey. Rough films have no lines of equal thickness.
    """
    film, window = result.film, film_window(result)
    ax = map_panels(result, 1, window, rows=1)[0] if ax is None else ax
    factor, unit = film_unit(result)
    inside = result.zones["hertz"](film.x[:, np.newaxis], film.y)
    highest = factor * float(np.percentile(film.thickness[inside], 100.0 - _THICKER))
    number = 6 if on_low_page(result, 1, window) else 10
    levels = round_levels(factor * film.minimum_thickness, highest, number)
    limits = (float(levels[0]), float(levels[-1]))
    nodes = (film.x, film.y)
    at, thickness = refined(nodes, factor * film.thickness, _in_metres(result, window))
    colours = colormaps["viridis"].with_extremes(over=OUT_OF_RANGE)
    mesh = draw_map(result, ax, at, thickness, colours=colours, limits=limits, window=window)
    label = f"film thickness $h$ [{unit}], thicker: grey"
    bar = colour_bar(result, mesh, [ax], label, window=window, ticks=levels, extend="max")
    ellipse = hertz_ellipse(result, ax)
    if not result.rough:
        lines = ax.contour(*on_page(result, *at), thickness, levels, colors="black", linewidths=0.5)
        # Around the ellipse the gap widens so fast that the lines would merge to a black band.
        lines.set_clip_path(ellipse)
        bar.add_lines(lines)
    lowest = mark(result, ax, extreme_positions(*nodes, -film.thickness), "minimum film")
    say(
        result,
        ax,
        extreme_positions(*nodes, -film.thickness),
        f"{factor * film.minimum_thickness:.3g} {unit}",
    )
    legend_above(ax, [legend_line(ellipse), lowest])
    entrainment(result, ax)
    return ax


def _in_metres(result: PointResult, window: tuple[Range, Range]) -> tuple[Range, Range]:
    """Ranges of x and y [m] of ranges of x/b and y/b."""
    b = result.conditions.semi_axis_x
    (left, right), (low, high) = window
    return (b * left, b * right), (b * low, b * high)


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
        Axes with the map, and a colour bar beside them. Where the pressure spike is the maximum, the colours
        are smoothed over one spacing of the nodes; the marked value is not.
    """
    film, window = result.film, film_window(result)
    ax = map_panels(result, 1, window, rows=1)[0] if ax is None else ax
    hertz = result.conditions.max_pressure
    factor, unit = unit_for(max(film.max_pressure, hertz), "Pa")
    nodes = (film.x, film.y)
    # The pressure spike is hardly wider than the grid, so that its nodes would look like a string of pearls.
    spike = has_spike(result)
    drawn = smoothed(film.pressure) if spike else film.pressure
    at, pressure = refined(nodes, factor * drawn, _in_metres(result, window))
    limits = (0.0, factor * max(float(np.max(drawn)), hertz))
    pressure = np.clip(pressure, *limits)
    mesh = draw_map(result, ax, at, pressure, colours="magma", limits=limits, window=window)
    levels = round_levels(*limits, 10)
    bar = colour_bar(result, mesh, [ax], f"pressure $p$ [{unit}]", window=window, ticks=levels)
    if not result.rough:
        inner = levels[(levels > 0.0) & (levels < _BELOW_RIDGE * factor * hertz)]
        bar.add_lines(
            ax.contour(*on_page(result, *at), pressure, inner, colors="white", linewidths=0.4, alpha=0.6)
        )
    cavitated = _cavitated(result, ax)
    position = extreme_positions(*nodes, film.pressure)
    peak = mark(result, ax, position, "maximum on this grid" if spike else "maximum")
    say(result, ax, position, f"{factor * film.max_pressure:.3g} {unit}")
    legend_above(ax, [legend_line(hertz_ellipse(result, ax, "white")), peak, cavitated], 3)
    entrainment(result, ax, ink="white")
    return ax


def _cavitated(result: PointResult, ax: Axes) -> Patch:
    """Hatch the cavitated region, where the pressure is ambient, and return its legend entry.

    The edge of the region is drawn without the steps of the grid, less than a node away from them. The
    boundary nodes of the domain are at ambient pressure in any case. They are hatched where the node beside
    them, one row inside, cavitates.
    """
    film = result.film
    cavitated = np.pad(film.cavitated[1:-1, 1:-1], 1, mode="edge")
    if np.any(cavitated):
        window = _in_metres(result, film_window(result))
        at, share = refined((film.x, film.y), smoothed(cavitated.astype(float)), window)
        area = ax.contourf(*on_page(result, *at), share, [0.5, 1.5], colors=[_CAVITATED], hatches=["////"])
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
    ax = map_panels(result, 1, window, rows=1)[0] if ax is None else ax
    factor, unit = unit_for(field.max_strength, "V/m")
    strength = _strength(result, section)
    at = (field.x, field.y)
    limits = (0.0, factor * field.max_strength)
    mesh = draw_map(result, ax, at, factor * strength, colours="inferno", limits=limits, window=window)
    label = rf"field strength $|E|$, {section} [{unit}]"
    colour_bar(result, mesh, [ax], label, window=window, ticks=round_levels(*limits, 8))
    level = HIGH_FIELD * float(np.max(strength))
    if np.min(strength) < level:
        ax.contour(*on_page(result, *at), strength, [level], colors="#00e5ff", linewidths=0.9)
    where = f", {field.max_strength_wall}" if result.rough else ""
    handles = [
        legend_line(hertz_ellipse(result, ax, "white")),
        Line2D([], [], color="#00b8d4", lw=0.9, label=f"{100.0 * HIGH_FIELD:g} % of the maximum"),
        mark(result, ax, _largest(result), f"maximum{where}"),
    ]
    say(result, ax, _largest(result), f"{factor * field.max_strength:.3g} {unit}")
    legend_above(ax, handles, 3)
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
    """Draw maps of the deviation of the field strength from the thin-gap estimate V12/h.

    The maps are of both walls and of mid-film; one map serves both walls where they are alike.

    Parameters
    ----------
    result : PointResult
        Result of a point contact.
    axes : sequence of Axes, optional
        Three axes to draw on; axes of a new figure if omitted.

    Returns
    -------
    Axes
        The first axes. The deviations are in per mille of V12/h, with zero in white, and shown inside the
        Hertz ellipse only: near the side faces of the field domain, the faces disturb the field.
    """
    field, window = result.field, field_window(result)
    panels = {name: 1e3 * (_strength(result, name) / field.thin_gap_strength - 1.0) for name in SECTIONS}
    inside = result.zones["hertz"](field.x[:, np.newaxis], field.y)
    region = field.inner & inside
    ends = _ends(panels, region, _DEVIATIONS_BEYOND)
    first, middle, second = panels.values()
    apart = np.abs(first - second)[region if np.any(region) else ...]
    if axes is None and np.percentile(apart, 100.0 - _DEVIATIONS_BEYOND) < _ALIKE * ends[1]:
        panels = {"surface 1, and 2 alike": first, "mid-film": middle}
    label = "deviation of the field from $V_{12}/h$ [‰]"
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
    """Ends of the colours of several maps, equally far from zero.

    ``beyond`` per cent of the nodes lie beyond either end. Nodes of ``region`` count, or all nodes if it is
    empty.
    """
    region = region if np.any(region) else np.ones_like(region)
    values = np.concatenate([panel[region] for panel in panels.values()])
    end = float(np.max(np.abs(np.percentile(values, [beyond, 100.0 - beyond]))))
    return -end, end


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
    look: dict[str, Any] = {"colours": "RdBu_r", "limits": ends, "window": window, "number": number}
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
    rough = {ROUGHNESS_FIGURE: roughness} if np.any(result.roughness) else {}
    return (
        POINT_FIGURES
        | rough
        | heat_figures_of(result)
        | breakdown_figures_of(result)
        | meter_figures_of(result)
        | spots_figures_of(result)
    )
