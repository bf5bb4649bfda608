"""Figures of a line contact: pressure, film, field, and maps of the field in the film."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Patch
from matplotlib.ticker import MaxNLocator

from ehlectric.arrays import Array
from ehlectric.contact import Result
from ehlectric.figures.contact_curves import (
    enlarged_below,
    limit_line,
    stacked_panels,
)
from ehlectric.figures.contact_findings import cut_offs, disagreement, per_cent, strength_limit
from ehlectric.figures.contact_maps import round_levels
from ehlectric.figures.contact_profiles import Line, field_scale, film_thickness, pressure, shown_range
from ehlectric.figures.contact_profiles import field_strength as strength_panel
from ehlectric.figures.data import Curve
from ehlectric.figures.draw import draw_curves
from ehlectric.figures.film_section import MAXIMUM, draw_section, fill_section
from ehlectric.figures.style import (
    BAR,
    LENGTH_AXIS,
    axes_or_new,
    figure_of,
    fitted_label,
    in_half_widths,
    label_position,
    legend_above,
    length_axis,
    text_colour,
)
from ehlectric.quantities.palette import BLUE, BODY, GREEN, GREY, ON_MAP, ORANGE, OUT_OF_RANGE, PALE_BLUE
from ehlectric.quantities.units import unit_for
from ehlectric.readable import readable


def potential(result: Result, ax: Axes | None = None) -> Axes:
    """Draw a map of the electric potential in the film, with ten equipotential lines. Returns axes with the
    map, and a colour bar next to them.
    """
    field, electric = result.field, result.case.electric
    low, high = sorted((electric.potential_1, electric.potential_2))
    ticks = np.linspace(low, high, 5)
    ax = _map(result, field.potential, ax, label="potential $V$ [V]", limits=(low, high), ticks=ticks)
    x, y = _mesh(result)
    lines = np.linspace(low, high, 12)[1:-1]
    ax.contour(x, y, field.potential, lines, colors=ON_MAP, linewidths=0.4, linestyles="-")
    return ax


def field_strength(result: Result, ax: Axes | None = None, *, largest: float | None = None) -> Axes:
    """Draw a map of the field strength in the film, and enlarged around its maximum, which is marked.
    With ``largest``, the dimensionless field strength abs(E) h_min/V12 is drawn from 0 to this value.

    The dimensionless field strength is drawn as Figures 5 and 6 of Morris et al. (2022),
    doi:10.3390/lubricants10050087.
    """
    field = result.field
    if largest is not None:
        return _dimensionless(result, ax, largest)
    factor, unit = unit_for(field.max_strength, "V/m")
    inside = np.abs(field.x) <= result.conditions.half_width
    low = float(np.min(field.strength[inside])) if np.any(inside) else 0.0
    levels = round_levels(factor * low, factor * field.max_strength, 8)
    limits = (float(levels[0]), factor * field.max_strength)
    strength = factor * field.strength
    label = f"field strength $|E|$ [{unit}]"
    ticks = levels[levels <= limits[1]]
    ax, *below = [ax] if ax is not None else stacked_panels((6.3, 5.4))
    _map(result, strength, ax, label=label, limits=limits, ticks=ticks, under=True)
    handles = [Patch(facecolor=BODY, label="surfaces")]
    if limits[0] > 0.0:
        handles.insert(0, Patch(facecolor=OUT_OF_RANGE, label=f"film below {readable(limits[0], 4)} {unit}"))
    handles += [_zoom(result, (ax, panel), strength, limits) for panel in below]
    x, y = _mesh(result)
    k, j = np.unravel_index(np.argmax(strength), strength.shape)
    for axes in (ax, *below):
        axes.plot(x[k, 0], y[k, j], **MAXIMUM)
    legend_above(ax, handles, columns=3)
    return ax


def _dimensionless(result: Result, ax: Axes | None, largest: float) -> Axes:
    """Draw a map of abs(E) h_min/V12 from 0 to ``largest``."""
    scale = result.strength_scale
    nice = np.asarray(MaxNLocator(6).tick_values(0.0, largest))
    ticks = nice[(nice >= 0.0) & (nice <= largest)]
    label = r"field strength $|E|\,h_\mathrm{min}/V_{12}$"
    ax = _map(result, scale * result.field.strength, ax, label=label, limits=(0.0, largest), ticks=ticks)
    factor, unit = unit_for(1.0 / scale, "V/m")
    ax.set_title(rf"$V_{{12}}/h_\mathrm{{min}}$ = {readable(factor / scale)} {unit}", loc="right")
    return ax


def _zoom(result: Result, panels: tuple[Axes, Axes], values: Array, limits: tuple[float, float]) -> Patch:
    """Draw the surroundings of the maximum enlarged on the lower panel, and return their legend entry."""
    above, below = panels
    x, y = _mesh(result)
    k = int(np.argmax(np.max(values, axis=1)))
    half = 0.06 if not result.rough else 0.03
    ends = float(x[k, 0]) - half, float(x[k, 0]) + half
    fill_section(below, x[:, 0], y, values, limits=limits, under=True)
    below.set_facecolor(BODY)
    near = y[(x[:, 0] >= ends[0]) & (x[:, 0] <= ends[1])]
    room = 0.12 * float(np.ptp(near))
    below.set_xlim(*ends)
    below.set_ylim(float(np.min(near)) - room, float(np.max(near)) + room)
    below.set_ylabel(above.get_ylabel())
    label_position(result, below)
    return enlarged_below(above, ends, framed=True)


def _mesh(result: Result) -> tuple[Array, Array]:
    """Position x/b and height of the field's nodes, both (nx, ns); the height in the unit of its axis."""
    field = result.field
    factor, _ = unit_for(result.film.central_thickness, "m")
    x = np.broadcast_to(in_half_widths(result, field.x)[:, np.newaxis], field.y.shape)
    return x, factor * field.y


def _map(
    result: Result,
    values: Array,
    ax: Axes | None,
    *,
    label: str,
    limits: tuple[float, float],
    ticks: Array,
    under: bool = False,
) -> Axes:
    """Draw a map of values (nx, ns) in the film, with its axis labels and colour bar.

    Values below the limits are grey where ``under`` is set.
    """
    ax = axes_or_new(ax)
    x, y = _mesh(result)
    electric = result.case.electric
    potentials = (electric.potential_1, electric.potential_2)
    factor, unit = unit_for(result.film.central_thickness, "m")
    units = (result.conditions.half_width, 1.0 / factor)
    filled = draw_section(
        ax, x[:, 0], y, values, limits=limits, potentials=potentials, under=under, units=units
    )
    ax.set_ylabel(f"height $y$ [{unit}]")
    label_position(result, ax)
    # Next to the axes themselves, a wide legend above them does not push the bar away.
    place: dict[str, Any] = {"cax": ax.inset_axes(BAR)} if under else {"ax": ax, "pad": 0.02}
    bar = figure_of(ax).colorbar(filled, label=fitted_label(ax, label, along=False), **place)
    bar.set_ticks(list(ticks))
    return ax


def pressure_and_film(result: Result, ax: Axes | None = None) -> Axes:
    """Draw pressure and film thickness over x/b around the contact, with the Hertz pressure behind them.

    Returns axes of the pressure; the film thickness is on a twin of them, with an axis on the right; both
    axes have their ticks at the same heights. The minimum film is marked.
    """
    ax, line = axes_or_new(ax), _line(result)
    above, below = pressure(line), film_thickness(line)
    lines = draw_curves(above.curves, ax)
    ax.set_xlim(*shown_range(line.x))
    label_position(result, ax)
    ax.set_ylabel(f"pressure $p$ [{above.unit}]", color=BLUE)
    twin = ax.twinx()
    # Dashes also distinguish the curves of both axes without colours.
    dashed = [
        replace(curve, dash="longdash") if curve.name == "film thickness" else curve for curve in below.curves
    ]
    lines += draw_curves(dashed, twin)
    twin.set_ylabel(f"film thickness $h$ [{below.unit}]", color=text_colour(ORANGE))
    _align(ax, twin, above.top, below.top / 3.0)
    length_axis(result, ax)
    legend_above(ax, lines, 4 if len(lines) < 5 else 3, lift=LENGTH_AXIS)
    return ax


def _line(result: Result) -> Line:
    """Line contact over x/b."""
    return Line.through(result, 1.0 / result.conditions.half_width)


def _align(ax: Axes, twin: Axes, pressure: float, film: float) -> None:
    """Give two axes from 0 as many ticks, at the same heights, and a grid through them.

    The film in the centre lies in the lowest quarter, so that its flanks leave the contact on both sides of
    the pressure.
    """
    ticks = np.asarray(MaxNLocator(6, steps=[1, 2, 2.5, 5, 10]).tick_values(0.0, pressure))
    intervals = ticks.size - 1
    steps = np.array([1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 10.0])
    least = 4.0 * film / intervals
    decade = 10.0 ** np.floor(np.log10(least))
    step = decade * float(steps[np.searchsorted(steps, least / decade * (1.0 - 1e-9))])
    for axes, values in ((ax, ticks), (twin, step * np.arange(intervals + 1))):
        axes.set_ylim(0.0, values[-1])
        axes.set_yticks(values)
    ax.grid(axis="y", lw=0.4)
    ax.set_axisbelow(True)


def film_change(result: Result, ax: Axes | None = None) -> Axes:
    """Draw the change that the roughness makes to the film: rough film minus smooth film over x/b. Returns
    axes with the change of the film, and the change that undeformed roughness would make to it.
    """
    ax = axes_or_new(ax)
    assert result.smooth is not None
    film, x = result.film, in_half_widths(result, result.film.x)
    change, heights = film.thickness - result.smooth.thickness, result.roughness.sum(axis=0)
    left, right = shown_range(x)
    shown = (x >= left) & (x <= right)
    factor, unit = unit_for(float(np.max(np.abs(np.stack([change, heights])[:, shown]))), "m", least=1.0)
    ax.plot(x, -factor * heights, color=PALE_BLUE, lw=1.6, label="if not flattened")
    ax.plot(x, factor * change, color=ORANGE, lw=0.8, label="rough − smooth film")
    ax.set_xlim(*shown_range(x))
    ax.set_ylabel(f"change of film [{unit}]")
    label_position(result, ax)
    legend_above(ax, columns=2)
    return ax


def film(result: Result, ax: Axes | None = None) -> Axes:
    """Draw pressure and film; below them, the change by roughness if the smooth contact was also solved.
    ``ax``, axes to draw pressure and film on; axes of a new figure, with both panels, if omitted.
    """
    if ax is not None or result.smooth is None:
        return pressure_and_film(result, ax)
    above, below = stacked_panels((6.3, 5.2))
    pressure_and_film(result, above)
    film_change(result, below)
    return above


# Relative difference below which the fields of walls and mid-film are one line, and part of the range of
# their values below which both walls are.
_EQUAL, _ALIKE = 1e-2, 1e-2


def field_profiles(result: Result, ax: Axes | None = None) -> Axes:
    """Draw the field strength at mid-film and on both walls over x/b, with the zone of high field shaded.

    The zone of high field is where the field at mid-film is above 95 % of its maximum.

    Returns axes with the field strength in V/m, prefixed, on the left, and abs(E) h_min/V12 on the right.
    """
    ax, field, panel = axes_or_new(ax), result.field, strength_panel(_line(result))
    zone = in_half_widths(result, np.array(field.high_field_zone))
    width, length = unit_for(field.high_field_width, "m", least=1.0)
    label = f"above 95 % of maximum, {readable(width * field.high_field_width)} {length} wide"
    shaded = ax.axvspan(zone[0], zone[1], color=GREEN, alpha=0.25, lw=0.0, label=label)
    smooth = [curve for curve in panel.curves if "smooth" in curve.name]
    sections = panel.curves[:3]
    lines = draw_curves([*_merged(sections, disagreement(result)), *smooth], ax)
    x = in_half_widths(result, field.x)
    ax.set(ylabel=rf"field strength $|E|$ [{panel.unit}]", xlim=(x[0], x[-1]))
    label_position(result, ax)
    factor = unit_for(field_scale(result), "V/m")[0]
    low, top = 0.0, factor * field.max_strength
    limit = strength_limit(result)
    if limit is not None:
        top = max(top, limit_line(ax, x, factor * limit, top, panel.unit))
    hertz = np.abs(sections[0].x) <= 1.0
    if result.rough and np.any(hertz):
        low = min(float(np.min(curve.y[hertz])) for curve in sections)
        low = max(0.0, low - 0.1 * (top - low))
    ax.set_ylim(low, top + 0.08 * (top - low))
    scale = result.strength_scale / factor
    right = ax.secondary_yaxis(
        "right", functions=(lambda e: np.asarray(e) * scale, lambda e: np.asarray(e) / scale)
    )
    right.set_ylabel(r"dimensionless, $|E|\,h_\mathrm{min}/V_{12}$")
    legend_above(ax, [*lines, shaded])
    return ax


def _merged(sections: Sequence[Curve], apart: float = np.inf) -> list[Curve]:
    """Curves of walls and mid-film: one where they are at most a per cent ``apart``, two of equal walls."""
    first, second, middle = sections
    if apart < _EQUAL:
        name = f"walls and mid-film, equal within {per_cent(apart)}"
        return [replace(first, name=name, y=middle.y, width=1.2)]
    range_ = float(np.ptp([curve.y for curve in sections]))
    if np.allclose(first.y, second.y, rtol=0.0, atol=_ALIKE * range_):
        return [replace(first, name="field at both walls", width=1.2), middle]
    return list(sections)


def field_deviation(result: Result, ax: Axes | None = None) -> Axes:
    """Draw the deviation of the field strength from the thin-gap estimate V12/h over x/b. Returns axes with
    the deviations in per mille of V12/h, on both walls and at mid-film.
    """
    if ax is not None:
        _deviations(result, ax)
        legend_above(ax, columns=3)
        return ax
    above, below = stacked_panels((6.3, 5.2))
    _deviations(result, above)
    _deviations(result, below)
    sections = _from_thin_gap(result)
    x, deviations = sections[0].x, np.stack([curve.y for curve in sections])
    at = x[int(np.argmax(np.max(np.abs(deviations), axis=0)))]
    ends = at - _AROUND, at + _AROUND
    below.set_xlim(*ends)
    shown = deviations[:, (x >= ends[0]) & (x <= ends[1])]
    room = 0.08 * float(np.ptp(shown)) or 1.0
    below.set_ylim(float(shown.min()) - room, float(shown.max()) + room)
    for line in below.get_lines():
        line.set(marker=".", markersize=2.5)
    enlarged_below(above, ends)
    legend_above(above, columns=3)
    return above


# Half of the range of x/b that an enlargement shows.
_AROUND = 0.03


def _from_thin_gap(result: Result) -> list[Curve]:
    """Deviations of the field from V12/h on both walls and at mid-film [‰], where the end faces are far."""
    factor, thin = unit_for(field_scale(result), "V/m")[0], result.field.thin_gap_strength[result.field.inner]
    sections = strength_panel(_line(result)).curves[:3]
    return [replace(curve, y=1e3 * (curve.y / (factor * thin) - 1.0)) for curve in sections]


def _deviations(result: Result, ax: Axes) -> None:
    """Draw the deviations of the field from V12/h over x/b."""
    x = in_half_widths(result, result.field.x)
    draw_curves(_merged(_from_thin_gap(result)), ax)
    ax.axhline(0.0, color=GREY, lw=0.5, zorder=0.5)
    ax.set(ylabel="deviation of the field\nfrom $V_{12}/h$ [‰]", xlim=(x[0], x[-1]))
    label_position(result, ax)


def roughness(result: Result, ax: Axes | None = None) -> Axes:
    """Draw the roughness of both surfaces over x/b, as the film solver uses it.

    Peaks, which make the film thinner, point up for both surfaces. If the case cuts off the heights, both
    ends are drawn.

    Returns axes over the range of x/b of the figure of pressure and film thickness.
    """
    ax = axes_or_new(ax)
    x = in_half_widths(result, result.film.x)
    factor, unit = unit_for(float(np.max(np.abs(result.roughness))), "m", least=1.0)
    statistics = result.roughness_statistics
    cut = cut_offs(result)
    for k, rq, color in ((1, statistics.rq_1, BLUE), (2, statistics.rq_2, ORANGE)):
        heights = result.roughness[k - 1]
        if np.any(heights):
            label = f"surface {k}, Rq = {readable(factor * rq)} {unit} in the contact"
            ax.plot(x, factor * heights, color=color, lw=0.7, label=label)
        if k in cut:
            label = f"heights cut off at ±{readable(factor * cut[k])} {unit}"
            for end in (-cut[k], cut[k]):
                ax.axhline(factor * end, color=color, lw=0.7, ls=":", label=label)
                label = "_again"
    ax.set_xlim(*shown_range(x))
    label_position(result, ax)
    length_axis(result, ax)
    ax.margins(y=0.08)
    ax.set_ylabel(f"height [{unit}]")
    legend_above(ax, lift=LENGTH_AXIS)
    return ax


FIGURES: dict[str, Callable[..., Axes]] = {
    "film.png": film,
    "field_strength.png": field_strength,
    "field_profiles.png": field_profiles,
    "field_deviation.png": field_deviation,
}
