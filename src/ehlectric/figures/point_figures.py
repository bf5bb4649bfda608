"""Figures of a point contact: maps of film, pressure and field, and cuts through them."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.legend_handler import HandlerTuple
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from ehlectric.arrays import Array, Mask
from ehlectric.contact import PointResult
from ehlectric.field import HIGH_FIELD
from ehlectric.figures.contact_curves import limit_line
from ehlectric.figures.contact_findings import has_spike, strength_limit
from ehlectric.figures.contact_maps import (
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
    refined,
    round_levels,
    say,
    smoothed,
)
from ehlectric.figures.contact_profiles import Cut
from ehlectric.figures.film_section import draw_section
from ehlectric.figures.style import (
    axes_or_new,
    figure_of,
    fitted_label,
    label_position,
    legend_above,
    new_panels,
    side_by_side,
)
from ehlectric.quantities.palette import BLUE, CAVITATED, GREY, MAP_EDGE, ON_MAP, ORANGE, OUT_OF_RANGE
from ehlectric.quantities.units import unit_for
from ehlectric.readable import readable

# Colour and dashes of the cut through the centre, and of the cut through the minimum film or maximum field.
_LOOKS = ((BLUE, "-"), (ORANGE, (0, (4.0, 1.2))))


def pressure_cut(result: PointResult, ax: Axes | None = None, *, along: str = "x") -> Axes:
    """Draw the pressure on two cuts, through the centre and through the minimum film, and the Hertz pressure.
    Returns axes with the pressure over x/b or y/b, and a legend above them.
    """
    ax = axes_or_new(ax)
    film, conditions = result.film, result.conditions
    factor, unit = unit_for(film.max_pressure, "Pa")
    across = np.linspace(-1.0, 1.0, 401)
    hertz = factor * conditions.max_pressure * np.sqrt(1.0 - across**2)
    label = "Hertzian pressure, centre"
    lines = ax.plot(_semi_axis(result, along) * across, hertz, color=GREY, ls=":", lw=0.9, label=label)
    lines += _film_lines(result, ax, along, factor * film.pressure)
    ax.set_ylabel(fitted_label(ax, f"pressure $p$ [{unit}]", along=False))
    ax.set_ylim(0.0, 1.05 * factor * max(film.max_pressure, conditions.max_pressure))
    legend_above(ax, lines, 1)
    return ax


def film_cut(result: PointResult, ax: Axes | None = None, *, along: str = "x") -> Axes:
    """Draw the film thickness on two cuts, through the centre and through the minimum film.

    Returns axes with the film up to twice the central or the mean film thickness, whichever is larger; a
    dotted line shows the film with smooth surfaces, if it was solved for a rough contact.
    """
    ax, film = axes_or_new(ax), result.film
    factor, unit = film_unit(result)
    if result.smooth is not None:
        for cut in _film_cuts(result, along):
            smooth = factor * cut.of(result.smooth.thickness)
            (line,) = ax.plot(_axis(result, along), smooth, color="black", lw=0.9, ls=":")
        line.set_label("smooth surfaces")
        legend_above(ax, [line])
    _film_lines(result, ax, along, factor * film.thickness)
    ax.set_ylabel(fitted_label(ax, f"film thickness $h$ [{unit}]", along=False))
    ax.set_ylim(0.0, 2.0 * factor * max(film.central_thickness, film.mean_thickness))
    return ax


def field_cut(result: PointResult, ax: Axes | None = None, *, along: str = "x") -> Axes:
    """Draw the field strength at mid-film on two cuts, through the centre and through the maximum field.
    Returns axes with the field strength as lines, and the thin-gap estimate V12/h as wide bands behind them.
    """
    ax, field = axes_or_new(ax), result.field
    factor, unit = unit_for(field.max_strength, "V/m")
    places = ((0.0, 0.0), field.max_strength_position)
    at = (field.x if along == "x" else field.y) / result.conditions.semi_axis_x
    lines, bands = [], []
    for name, place, (color, line) in zip(("centre", "maximum field"), places, _LOOKS, strict=True):
        cut = Cut.near(along, place, field.x, field.y)
        away = cut.away(field)
        thin = factor * cut.of(field.thin_gap_strength)[away]
        bands += ax.plot(at[away], thin, color=color, lw=4.0, alpha=0.25)
        label = f"{name}, {cut.name(result)}"
        lines += ax.plot(
            at[away], factor * cut.of(field.middle_strength)[away], color=color, ls=line, label=label
        )
    entries = {line: str(line.get_label()) for line in lines}
    top, limit = factor * field.max_strength, strength_limit(result)
    if limit is not None:
        cut = Cut.near(along, field.max_strength_position, field.x, field.y)
        top = max(top, limit_line(ax, at, factor * cut.of(limit), top, unit))
    legend_above(
        ax,
        [*entries, tuple(bands)],
        1,
        labels=[*entries.values(), "thin-gap estimates $V_{12}/h$"],
        handler_map={tuple: HandlerTuple(ndivide=None)},
    )
    ax.set_ylabel(fitted_label(ax, f"mid-film field $|E|$ [{unit}]", along=False))
    ax.set_ylim(0.0, 1.08 * top)
    return ax


def _axis(result: PointResult, along: str) -> Array:
    """Positions of the film's nodes along a cut, as x/b or y/b."""
    film = result.film
    at: Array = (film.x if along == "x" else film.y) / result.conditions.semi_axis_x
    return at


def _semi_axis(result: PointResult, along: str) -> float:
    """Semi-axis of the Hertz ellipse along a cut, divided by the semi-axis b along entrainment."""
    return 1.0 if along == "x" else result.conditions.ratio


def _film_cuts(result: PointResult, along: str) -> list[Cut]:
    """Cuts through the centre and through the minimum film."""
    film = result.film
    return [Cut.near(along, at, film.x, film.y) for at in ((0.0, 0.0), film.minimum_position)]


def _film_lines(result: PointResult, ax: Axes, along: str, values: Array) -> list[Line2D]:
    """Draw values (nx, ny) at the film's nodes on the cuts through the centre and the minimum film."""
    lines: list[Line2D] = []
    for cut, name, (color, line) in zip(
        _film_cuts(result, along), ("centre", "minimum film"), _LOOKS, strict=True
    ):
        label = f"{name}, {cut.name(result)}"
        lines += ax.plot(_axis(result, along), cut.of(values), color=color, ls=line, label=label)
    return lines


def cuts(result: PointResult, axes: Sequence[Axes] | None = None) -> Axes:
    """Draw pressure, film and field on cuts along entrainment (left) and across it (right); in a journal, the
    cuts across entrainment stand below the others.

    The cuts run through the centre and through the minimum film, or for the field through its maximum.

    Returns the first axes, with the pressure along entrainment.
    """
    axes = new_panels(3, 2, (7.0, 6.6)) if axes is None else axes
    two_columns = side_by_side(axes[0]) > 1
    for side, (along, window) in enumerate(zip("xy", film_window(result), strict=True)):
        for row, draw in enumerate((pressure_cut, film_cut, field_cut)):
            ax = axes[2 * row + side if two_columns else 3 * side + row]
            draw(result, ax, along=along)
            ax.set_xlim(*window)
            if row == 2:
                label_position(result, ax, along)
            ax.tick_params(labelbottom=row == 2)
            if two_columns:
                ax.label_outer()
    return axes[0]


def field_section(result: PointResult, ax: Axes | None = None, *, along: str = "x") -> Axes:
    """Draw a section of the film through the maximum field: field strength as colours, and equipotentials.
    Returns axes with the section and a colour bar.
    """
    ax, field, electric = axes_or_new(ax), result.field, result.case.electric
    cut = Cut.near(along, field.max_strength_position, field.x, field.y)
    away = cut.away(field)
    at = (field.x if along == "x" else field.y)[away] / result.conditions.semi_axis_x
    factor, unit = film_unit(result)
    strength_factor, strength_unit = unit_for(field.max_strength, "V/m")
    heights = factor * _levelled(result, cut)[away]
    filled = draw_section(
        ax,
        at,
        heights,
        strength_factor * cut.of(field.strength)[away],
        limits=(0.0, strength_factor * field.max_strength),
        potentials=(electric.potential_1, electric.potential_2),
        units=(result.conditions.semi_axis_x, 1.0 / factor),
    )
    low, high = sorted((electric.potential_1, electric.potential_2))
    ax.contour(
        np.broadcast_to(at[:, np.newaxis], heights.shape),
        heights,
        cut.of(field.potential)[away],
        np.linspace(low, high, 12)[1:-1],
        colors=MAP_EDGE,
        linewidths=0.4,
        alpha=0.6,
        linestyles="-",
    )
    ax.set_ylabel(f"height $z$ [{unit}]")
    label_position(result, ax, along)
    way = "along" if along == "x" else "across"
    ax.set_title(f"section {way} entrainment at {cut.name(result)}", loc="right")
    bar = figure_of(ax).colorbar(filled, ax=ax, label=f"$|E|$ [{strength_unit}]", pad=0.02)
    ticks = round_levels(0.0, strength_factor * field.max_strength, 6)
    bar.set_ticks(list(ticks[ticks <= strength_factor * field.max_strength]))
    return ax


def _levelled(result: PointResult, cut: Cut) -> Array:
    """Heights of the nodes on a cut above the middle between the smooth surfaces [m], shape (n, ns)."""
    field, film = result.field, result.film
    z = cut.of(field.z)
    middle = 0.5 * (z[:, :1] + z[:, -1:])
    nodes, fixed = (film.x, film.y) if cut.along == "x" else (film.y, film.x)
    index = int(np.argmin(np.abs(fixed - cut.position)))
    uneven = 0.5 * (result.roughness[0] - result.roughness[1])
    line = uneven[:, index] if cut.along == "x" else uneven[index]
    at = field.x if cut.along == "x" else field.y
    levelled: Array = z - middle + np.interp(at, nodes, line)[:, np.newaxis]
    return levelled


def field_sections(result: PointResult, axes: Sequence[Axes] | None = None) -> Axes:
    """Draw two sections of the film through the maximum field, along entrainment and across it.

    The colours show the field strength. Both sections have the same scale of heights.

    Returns the first axes, with the section along entrainment.
    """
    axes = new_panels(2, 1, (6.3, 5.6)) if axes is None else axes
    for ax, along in zip(axes, "xy", strict=True):
        field_section(result, ax, along=along)
    highest = max(ax.get_ylim()[1] for ax in axes)
    lowest = min(ax.get_ylim()[0] for ax in axes)
    for ax in axes:
        ax.set_ylim(lowest, highest)
    return axes[0]


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


def film_map(result: PointResult, ax: Axes | None = None) -> Axes:
    """Draw a map of the film thickness with lines of equal thickness, and mark the minimum."""
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
        lines = ax.contour(*on_page(result, *at), thickness, levels, colors=MAP_EDGE, linewidths=0.5)
        # Around the ellipse the gap widens so fast that the lines would merge to a black band.
        lines.set_clip_path(ellipse)
        bar.add_lines(lines)
    lowest = mark(result, ax, extreme_positions(*nodes, -film.thickness), "minimum film")
    say(
        result,
        ax,
        extreme_positions(*nodes, -film.thickness),
        f"{readable(factor * film.minimum_thickness)} {unit}",
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
    """Draw a map of the pressure with lines of equal pressure, and the cavitated region hatched. Returns axes
    with the map, and a colour bar next to them.
    """
    film, window = result.film, film_window(result)
    ax = map_panels(result, 1, window, rows=1)[0] if ax is None else ax
    hertz = result.conditions.max_pressure
    factor, unit = unit_for(max(film.max_pressure, hertz), "Pa")
    nodes = (film.x, film.y)
    # The pressure spike is little wider than the grid spacing, so that its nodes would look like a string of
    # pearls.
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
            ax.contour(*on_page(result, *at), pressure, inner, colors=ON_MAP, linewidths=0.4, alpha=0.6)
        )
    cavitated = _cavitated(result, ax)
    position = extreme_positions(*nodes, film.pressure)
    peak = mark(result, ax, position, "maximum on this grid" if spike else "maximum")
    say(result, ax, position, f"{readable(factor * film.max_pressure)} {unit}")
    legend_above(ax, [legend_line(hertz_ellipse(result, ax, ON_MAP)), peak, cavitated], 3)
    entrainment(result, ax, ink=ON_MAP)
    return ax


def _cavitated(result: PointResult, ax: Axes) -> Patch:
    """Hatch the cavitated region, where the pressure is ambient, and return its legend entry.

    The edge of the region is drawn without the steps of the grid, less than a node away from them. The
    boundary nodes of the domain are at ambient pressure in any case. They are hatched where the node next to
    them, one row inside, cavitates.
    """
    film = result.film
    cavitated = np.pad(film.cavitated[1:-1, 1:-1], 1, mode="edge")
    if np.any(cavitated):
        window = _in_metres(result, film_window(result))
        at, share = refined((film.x, film.y), smoothed(cavitated.astype(float)), window)
        area = ax.contourf(*on_page(result, *at), share, [0.5, 1.5], colors=[CAVITATED], hatches=["////"])
        area.set(edgecolor=GREY, linewidth=0.0)
    return Patch(label="cavitated", hatch="////", facecolor=CAVITATED, edgecolor=GREY, linewidth=0.0)


def field_map(result: PointResult, ax: Axes | None = None, *, section: str = "mid-film") -> Axes:
    """Draw a map of the field strength on a wall or at mid-film, with the zone of high field and the maximum.
    Returns axes with the map and its colour bar, which ends at the largest field of all three sections.
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
        legend_line(hertz_ellipse(result, ax, ON_MAP)),
        Line2D([], [], color="#00b8d4", lw=0.9, label=f"{100.0 * HIGH_FIELD:g} % of the maximum"),
        mark(result, ax, _largest(result), f"maximum{where}"),
    ]
    say(result, ax, _largest(result), f"{readable(factor * field.max_strength)} {unit}")
    # Above the uppermost number of the colour bar.
    legend_above(ax, handles, 3, lift=4.0)
    entrainment(result, ax, ink=ON_MAP)
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
    """Draw maps of the summed roughness of both surfaces, and of the film change due to it. Returns the first
    axes, with the heights; peaks of either surface are positive.
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


FIGURES: dict[str, Callable[..., Axes]] = {
    "film_map.png": film_map,
    "pressure_map.png": pressure_map,
    "field_map.png": field_map,
    "field_deviation.png": field_deviation,
    "field_sections.png": field_sections,
    "cuts.png": cuts,
}
