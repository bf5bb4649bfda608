"""Figures of a line contact: each function draws one result on axes; none of them solves anything."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.ticker import MaxNLocator

from ehlectric.arrays import Array, Mask
from ehlectric.cases.quantity import unit_for
from ehlectric.contact.results import Result
from ehlectric.figures.contact.breakdown import breakdown_figures_of, limit_line
from ehlectric.figures.contact.findings import cut_offs, strength_limit
from ehlectric.figures.contact.line_maps import field_strength
from ehlectric.figures.names import ROUGHNESS_FIGURE
from ehlectric.figures.style import (
    BLUE,
    GREEN,
    GREY,
    LENGTH_AXIS,
    ORANGE,
    axes_or_new,
    in_half_widths,
    label_position,
    legend_above,
    length_axis,
    new_panels,
)
from ehlectric.formulas.hertz_line import line_pressure


def pressure_and_film(result: Result, ax: Axes | None = None) -> Axes:
    """Draw pressure and film thickness over x/b around the contact, with the Hertz pressure behind them.

    Parameters
    ----------
    result : Result
        Result of a line contact.
    ax : Axes, optional
        Axes to draw on; axes of a new figure if omitted.

    Returns
    -------
    Axes
        Axes of the pressure; the film thickness is on a twin of them, with an axis on the right. Both axes
        have their ticks at the same heights. The minimum film is marked.
    """
    ax = axes_or_new(ax)
    film, conditions = result.film, result.conditions
    x = in_half_widths(result, film.x)
    largest = max(film.max_pressure, conditions.max_pressure)
    factor, unit = unit_for(largest, "Pa")
    hertz = conditions.max_pressure * line_pressure(x)
    lines = ax.plot(x, factor * hertz, color=GREY, ls="--", lw=0.8, label="Hertz pressure")
    lines += ax.plot(x, factor * film.pressure, color=BLUE, label="pressure")
    ax.set_xlim(*_window(x))
    label_position(result, ax)
    ax.set_ylabel(f"pressure $p$ [{unit}]", color=BLUE)
    twin = ax.twinx()
    to_pressure = factor
    factor, unit = unit_for(film.central_thickness, "m")
    lines += twin.plot(x, factor * film.thickness, color=ORANGE, label="film thickness")
    if result.smooth:
        ax.plot(x, to_pressure * result.smooth.pressure, color="black", lw=0.9, ls=":")
        smooth = factor * result.smooth.thickness
        lines += twin.plot(x, smooth, color="black", lw=0.9, ls=":", label="both, smooth surfaces")
    twin.set_ylabel(f"film thickness $h$ [{unit}]", color=ORANGE)
    _align(ax, twin, to_pressure * largest, factor * film.central_thickness)
    minimum, position = factor * film.minimum_thickness, film.minimum_position / conditions.half_width
    lines += twin.plot(
        position,
        minimum,
        ls="none",
        marker="o",
        ms=4.0,
        mfc="white",
        color=ORANGE,
        label=f"minimum film, {minimum:.3g} {unit}",
    )
    length_axis(result, ax)
    legend_above(ax, lines, 4 if len(lines) < 5 else 3, lift=LENGTH_AXIS)
    return ax


def _window(x: Array) -> tuple[float, float]:
    """Range of x/b around the contact that figures of the film show, within the domain."""
    return max(float(x[0]), -2.0), min(float(x[-1]), 1.5)


def _align(ax: Axes, twin: Axes, pressure: float, film: float) -> None:
    """Give two axes from 0 as many ticks, at the same heights, and a grid through them.

    The film in the centre lies in the lowest quarter, so that its flanks leave the contact on both sides of
    the pressure.
    """
    ticks = np.asarray(MaxNLocator(6, steps=[1, 2, 2.5, 5, 10]).tick_values(0.0, 1.04 * pressure))
    intervals = ticks.size - 1
    steps = np.array([1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 10.0])
    least = 4.0 * film / intervals
    decade = 10.0 ** np.floor(np.log10(least))
    step = decade * float(steps[np.searchsorted(steps, least / decade * (1.0 - 1e-9))])
    for axes, values in ((ax, ticks), (twin, step * np.arange(intervals + 1))):
        axes.set_ylim(0.0, values[-1])
        axes.set_yticks(values)
    ax.grid(axis="y", lw=0.4, color="0.88")
    ax.set_axisbelow(True)


def film_change(result: Result, ax: Axes | None = None) -> Axes:
    """Draw the change that the roughness makes to the film: rough film minus smooth film over x/b.

    Parameters
    ----------
    result : Result
        Result of a rough line contact that was also solved with smooth surfaces.
    ax : Axes, optional
        Axes to draw on; axes of a new figure if omitted.

    Returns
    -------
    Axes
        Axes with the change of the film, and the change that undeformed roughness would make to it.
    """
    ax = axes_or_new(ax)
    assert result.smooth is not None
    film, x = result.film, in_half_widths(result, result.film.x)
    change, heights = film.thickness - result.smooth.thickness, result.roughness.sum(axis=0)
    shown = (x >= _window(x)[0]) & (x <= _window(x)[1])
    factor, unit = unit_for(float(np.max(np.abs(np.stack([change, heights])[:, shown]))), "m", least=1.0)
    ax.plot(x, -factor * heights, color="#9ccbe8", lw=1.0, label="if not flattened")
    ax.plot(x, factor * change, color=ORANGE, lw=0.8, label="rough − smooth film")
    ax.set_xlim(*_window(x))
    ax.set_ylabel(f"change of film [{unit}]")
    label_position(result, ax)
    legend_above(ax, columns=2)
    return ax


def film(result: Result, ax: Axes | None = None) -> Axes:
    """Draw pressure and film; below them, the change by roughness where the smooth contact was solved too.

    Parameters
    ----------
    result : Result
        Result of a line contact.
    ax : Axes, optional
        Axes to draw pressure and film on; axes of a new figure, with both panels, if omitted.

    Returns
    -------
    Axes
        Axes of the pressure.
    """
    if ax is not None or result.smooth is None:
        return pressure_and_film(result, ax)
    above, below = new_panels(2, 1, (6.3, 5.2))
    gridspec = above.get_gridspec()
    assert gridspec is not None
    gridspec.set_height_ratios([3.0, 2.0])
    pressure_and_film(result, above)
    film_change(result, below)
    return above


def field_profiles(result: Result, ax: Axes | None = None) -> Axes:
    """Draw the field strength at mid-film and on both walls over x/b, with the zone of high field shaded.

    The zone of high field is where the field at mid-film is above 95 % of its maximum.

    Parameters
    ----------
    result : Result
        Result of a line contact.
    ax : Axes, optional
        Axes to draw on; axes of a new figure if omitted.

    Returns
    -------
    Axes
        Axes with the field strength in V/m, prefixed, on the left, and abs(E) h_min/V12 on the right. The
        dielectric strength is a line, if the case has one.
    """
    ax = axes_or_new(ax)
    field = result.field
    x = in_half_widths(result, field.x)
    factor, unit = unit_for(field.max_strength, "V/m")
    zone = in_half_widths(result, np.array(field.high_field_zone))
    width, length = unit_for(field.high_field_width, "m", least=1.0)
    label = f"above 95 % of maximum, {width * field.high_field_width:.3g} {length} wide"
    shaded = ax.axvspan(zone[0], zone[1], color=GREEN, alpha=0.25, lw=0.0, label=label)
    lines = _sections(ax, x, field.inner, factor * np.stack(_strengths(result)), rough=bool(result.rough))
    if result.smooth:
        smooth = factor * result.smooth.middle_strength
        lines += ax.plot(x, smooth, color=GREY, lw=1.2, ls=":", label="mid-film, smooth surfaces")
    ax.set(ylabel=rf"field strength $|E|$ [{unit}]", xlim=(x[0], x[-1]))
    label_position(result, ax)
    top = factor * field.max_strength
    limit = strength_limit(result)
    if limit is not None:
        top = max(top, limit_line(ax, x, factor * limit, top, unit))
    ax.set_ylim(0.0, 1.08 * top)
    scale = result.strength_scale / factor
    right = ax.secondary_yaxis(
        "right", functions=(lambda e: np.asarray(e) * scale, lambda e: np.asarray(e) / scale)
    )
    right.set_ylabel(r"dimensionless, $|E|\,h_\mathrm{min}/V_{12}$")
    ax.legend(handles=[*lines, shaded], loc="lower center", frameon=False)
    return ax


def _strengths(result: Result) -> tuple[Array, Array, Array]:
    """Field strength on both walls and at mid-film [V/m], each (nx,)."""
    field = result.field
    return field.strength[:, 0], field.strength[:, -1], field.middle_strength


def _sections(ax: Axes, x: Array, on: Mask, values: Array, *, rough: bool) -> list[Line2D]:
    """Draw values (3, nx) on both walls and at mid-film over x/b, where the mask is True.

    Close to the end faces of the field domain, the faces disturb the field.
    """
    # Lines that coincide are drawn one in the other, so that all of them can be seen.
    looks = (
        ("surface 1", BLUE, "-", 1.8 if rough else 2.4),
        ("surface 2", ORANGE, "-" if rough else "--", 1.0 if rough else 1.6),
        ("mid-film", "black", "-", 0.4 if rough else 0.8),
    )
    lines: list[Line2D] = []
    for (label, color, dashes, width), along in zip(looks, values, strict=True):
        lines += ax.plot(x[on], along[on], color=color, ls=dashes, lw=width, label=label)
    return lines


def field_deviation(result: Result, ax: Axes | None = None) -> Axes:
    """Draw the deviation of the field strength from the thin-gap estimate V12/h over x/b.

    Parameters
    ----------
    result : Result
        Result of a line contact.
    ax : Axes, optional
        Axes to draw on; axes of a new figure if omitted.

    Returns
    -------
    Axes
        Axes with the deviations in per mille of V12/h, on both walls and at mid-film, and an inset around the
        largest of them. The ends of the field domain are left out: within some gap heights, the end faces
        disturb the field.
    """
    ax = axes_or_new(ax)
    field = result.field
    x, on = in_half_widths(result, field.x), field.inner
    values = 1e3 * (np.stack(_strengths(result)) / field.thin_gap_strength - 1.0)
    _sections(ax, x, on, values, rough=bool(result.rough))
    ax.axhline(0.0, color=GREY, lw=0.5, zorder=0.5)
    ax.set(ylabel="deviation of the field from $V_{12}/h$ [‰]", xlim=(x[0], x[-1]))
    label_position(result, ax)
    legend_above(ax, columns=3)
    inner = np.where(on, values, 0.0)
    _, k = np.unravel_index(np.argmax(np.abs(inner)), inner.shape)
    low, high = float(inner.min()), float(inner.max())
    # Room for the inset on the side of zero that has the larger deviations, away from the largest one.
    side, end = (-1.0, low) if -low > high else (1.0, high)
    margin = 0.1 * (high - low) or 1.0
    ax.set_ylim(min(low, side * 0.4 * abs(end)) - margin, max(high, side * 0.4 * abs(end)) + margin)
    left = 0.1 if x[k] > 0.0 else 0.45
    inset = ax.inset_axes((left, 0.08 if side < 0.0 else 0.58, 0.45, 0.34))
    _sections(inset, x, on, values, rough=bool(result.rough))
    inset.set_xlim(x[k] - 0.03, x[k] + 0.03)
    inset.set_ylim(low - margin, high + margin)
    inset.tick_params(labelsize=7.0)
    inset.locator_params(nbins=4)
    inset.axhline(0.0, color=GREY, lw=0.5, zorder=0.5)
    ax.indicate_inset_zoom(inset, edgecolor=GREY, lw=0.6)
    return ax


def roughness(result: Result, ax: Axes | None = None) -> Axes:
    """Draw the roughness of both surfaces over x/b, as the film solver uses it.

    Peaks, which make the film thinner, point up for both surfaces. Where the case cuts off the heights, both
    ends are drawn.

    Parameters
    ----------
    result : Result
        Result of a line contact.
    ax : Axes, optional
        Axes to draw on; axes of a new figure if omitted.

    Returns
    -------
    Axes
        Axes over the range of x/b of the figure of pressure and film thickness.
    """
    ax = axes_or_new(ax)
    x = in_half_widths(result, result.film.x)
    factor, unit = unit_for(float(np.max(np.abs(result.roughness))), "m", least=1.0)
    statistics = result.roughness_statistics
    cut = cut_offs(result)
    for k, rq, color in ((1, statistics.rq_1, BLUE), (2, statistics.rq_2, ORANGE)):
        heights = result.roughness[k - 1]
        if np.any(heights):
            label = f"surface {k}, Rq = {factor * rq:.3g} {unit} in the contact"
            ax.plot(x, factor * heights, color=color, lw=0.7, label=label)
        if k in cut:
            label = f"heights cut off at ±{factor * cut[k]:.3g} {unit}"
            for end in (-cut[k], cut[k]):
                ax.axhline(factor * end, color=color, lw=0.7, ls=":", label=label)
                label = "_again"
    ax.set_xlim(*_window(x))
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


def figures_of(result: Result) -> dict[str, Callable[..., Axes]]:
    """Functions that draw the figures of a line contact, by file name."""
    rough = {ROUGHNESS_FIGURE: roughness} if np.any(result.roughness) else {}
    return FIGURES | rough | breakdown_figures_of(result)
