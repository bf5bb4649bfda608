"""Figures of a line contact: each function draws one result on axes; none of them solves anything."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.ticker import MaxNLocator

from ehlectric.arrays import Array, Mask
from ehlectric.contact.results import Result
from ehlectric.figures.contact.breakdown import breakdown_figures_of, limit_line
from ehlectric.figures.contact.findings import cut_offs, disagreement, per_cent, strength_limit
from ehlectric.figures.contact.heat import heat_figures_of
from ehlectric.figures.contact.line_maps import field_strength
from ehlectric.figures.contact.meter import meter_figures_of
from ehlectric.figures.contact.panels import enlarged_below, stacked_panels
from ehlectric.figures.contact.spots import spots_figures_of
from ehlectric.figures.lengths import LENGTH_AXIS, in_half_widths, label_position, length_axis
from ehlectric.figures.names import ROUGHNESS_FIGURE
from ehlectric.figures.style import BLUE, GREEN, GREY, ORANGE, axes_or_new, legend_above
from ehlectric.formulas.hertz_line import line_pressure
from ehlectric.quantities.units import unit_for


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
    # Dashes tell the lines apart without colours too.
    lines = ax.plot(x, factor * hertz, color=GREY, ls=":", lw=1.0, label="Hertz pressure")
    lines += ax.plot(x, factor * film.pressure, color=BLUE, zorder=2.5, label="pressure")
    ax.set_xlim(*_window(x))
    label_position(result, ax)
    ax.set_ylabel(f"pressure $p$ [{unit}]", color=BLUE)
    twin = ax.twinx()
    to_pressure = factor
    factor, unit = unit_for(film.central_thickness, "m")
    lines += twin.plot(x, factor * film.thickness, color=ORANGE, ls=_FILM, label="film thickness")
    if film.film_fraction is not None:
        oil = factor * film.film_fraction * film.thickness
        lines += twin.plot(x, oil, color=ORANGE, lw=0.8, label="layer of oil")
    if result.smooth:
        # Wide and behind the rough curves, so that neither hides the other.
        ax.plot(x, to_pressure * result.smooth.pressure, **_SMOOTH)
        smooth = factor * result.smooth.thickness
        lines += twin.plot(x, smooth, label="both, smooth surfaces", **_SMOOTH)
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


# Dashes of the film thickness, and look of smooth surfaces behind rough ones.
_FILM = (0, (5.0, 1.5))
_SMOOTH: dict[str, Any] = {"color": "0.75", "lw": 2.6, "zorder": 1.5}


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
    ax.plot(x, -factor * heights, color="#9ccbe8", lw=1.6, label="if not flattened")
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
        dielectric strength is a line, if the case has one. Where walls and mid-film agree within a per cent,
        they are one line. Of a rough contact, only the field strengths of the Hertz zone are shown.
    """
    ax = axes_or_new(ax)
    field = result.field
    x = in_half_widths(result, field.x)
    factor, unit = unit_for(field.max_strength, "V/m")
    zone = in_half_widths(result, np.array(field.high_field_zone))
    width, length = unit_for(field.high_field_width, "m", least=1.0)
    label = f"above 95 % of maximum, {width * field.high_field_width:.3g} {length} wide"
    shaded = ax.axvspan(zone[0], zone[1], color=GREEN, alpha=0.25, lw=0.0, label=label)
    strengths = factor * np.stack(_strengths(result))
    lines = _sections(ax, x, field.inner, strengths, rough=bool(result.rough), apart=disagreement(result))
    if result.smooth:
        smooth = factor * result.smooth.middle_strength
        look: dict[str, Any] = {"color": "black", "lw": 1.1, "ls": (0, (3.0, 1.5)), "zorder": 4.0}
        lines += ax.plot(x, smooth, label="mid-film, smooth surfaces", **look)
    ax.set(ylabel=rf"field strength $|E|$ [{unit}]", xlim=(x[0], x[-1]))
    label_position(result, ax)
    top = factor * field.max_strength
    limit = strength_limit(result)
    if limit is not None:
        top = max(top, limit_line(ax, x, factor * limit, top, unit))
    low = 0.0
    hertz = np.abs(x) <= 1.0
    if result.rough and np.any(hertz):
        low = float(np.min(strengths[:, hertz]))
        low = max(0.0, low - 0.1 * (top - low))
    ax.set_ylim(low, top + 0.08 * (top - low))
    scale = result.strength_scale / factor
    right = ax.secondary_yaxis(
        "right", functions=(lambda e: np.asarray(e) * scale, lambda e: np.asarray(e) / scale)
    )
    right.set_ylabel(r"dimensionless, $|E|\,h_\mathrm{min}/V_{12}$")
    legend_above(ax, [*lines, shaded])
    return ax


def _strengths(result: Result) -> tuple[Array, Array, Array]:
    """Field strength on both walls and at mid-film [V/m], each (nx,)."""
    field = result.field
    return field.strength[:, 0], field.strength[:, -1], field.middle_strength


def _sections(
    ax: Axes, x: Array, on: Mask, values: Array, *, rough: bool, apart: float = np.inf, marker: str = ""
) -> list[Line2D]:
    """Draw values (3, nx) on both walls and at mid-film over x/b, where the mask is True.

    Close to the end faces of the field domain, the faces disturb the field. Where the values of all three are
    at most a per cent ``apart``, they are one line, and so are those of walls that are alike.
    """
    looks = [
        ("surface 1", BLUE, "-", 1.2 if rough else 1.6),
        ("surface 2", ORANGE, "-", 0.9),
        ("mid-film", GREEN if rough else "black", "-", 0.6 if rough else 0.8),
    ]
    if apart < _EQUAL:
        looks = [(f"walls and mid-film, equal within {per_cent(apart)}", BLUE, "-", 1.2)]
        values = values[2:]
    elif np.allclose(values[0][on], values[1][on], rtol=0.0, atol=_ALIKE * float(np.ptp(values[:, on]))):
        looks, values = [("both walls", *looks[0][1:]), looks[2]], values[1:]
    lines: list[Line2D] = []
    for (label, color, dashes, width), along in zip(looks, values, strict=True):
        look: dict[str, Any] = {"color": color, "ls": dashes, "lw": width, "marker": marker, "ms": 2.5}
        lines += ax.plot(x[on], along[on], label=label, **look)
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
        Axes with the deviations in per mille of V12/h, on both walls and at mid-film. Below them, in a new
        figure, a second panel shows the surroundings of the largest. The ends of the field domain are left
        out: within some gap heights, the end faces disturb the field.
    """
    if ax is not None:
        return _deviations(result, ax)
    above, below = stacked_panels((6.3, 5.2))
    _deviations(result, above)
    _deviations(result, below, marker=".")
    x, on = in_half_widths(result, result.field.x), result.field.inner
    deviations = np.where(on, np.abs(_from_thin_gap(result)), 0.0)
    k = int(np.argmax(np.max(deviations, axis=0)))
    ends = x[k] - _AROUND, x[k] + _AROUND
    below.set_xlim(*ends)
    shown = _from_thin_gap(result)[:, on & (x >= ends[0]) & (x <= ends[1])]
    room = 0.08 * float(np.ptp(shown)) or 1.0
    below.set_ylim(float(shown.min()) - room, float(shown.max()) + room)
    enlarged_below(above, ends)
    legend_above(above, columns=3)
    return above


# Half of the range of x/b that an enlargement shows.
_AROUND = 0.03


def _from_thin_gap(result: Result) -> Array:
    """Deviations of the field from V12/h on both walls and at mid-film [‰], (3, nx)."""
    deviations: Array = 1e3 * (np.stack(_strengths(result)) / result.field.thin_gap_strength - 1.0)
    return deviations


def _deviations(result: Result, ax: Axes, marker: str = "") -> Axes:
    """Draw the deviations of the field from V12/h over x/b."""
    field = result.field
    x, on = in_half_widths(result, field.x), field.inner
    _sections(ax, x, on, _from_thin_gap(result), rough=bool(result.rough), marker=marker)
    ax.axhline(0.0, color=GREY, lw=0.5, zorder=0.5)
    ax.set(ylabel="deviation of the field\nfrom $V_{12}/h$ [‰]", xlim=(x[0], x[-1]))
    label_position(result, ax)
    if not marker:
        legend_above(ax, columns=3)
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
    more = heat_figures_of(result) | breakdown_figures_of(result) | meter_figures_of(result)
    return FIGURES | rough | more | spots_figures_of(result)
