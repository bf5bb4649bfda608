"""Figures of a line contact: each function draws one result on axes; none of them solves anything."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from matplotlib.axes import Axes
from matplotlib.ticker import MaxNLocator

from ehlectric.arrays import Array
from ehlectric.cases.quantity import unit_for
from ehlectric.contact.results import Result
from ehlectric.figures.names import ROUGHNESS_FIGURE
from ehlectric.figures.section import draw_section
from ehlectric.figures.style import (
    BLUE,
    GREEN,
    GREY,
    ORANGE,
    axes_or_new,
    figure_of,
    in_half_widths,
    label_position,
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
        Axes of the pressure; the film thickness is on a twin of them, with an axis on the right.
    """
    ax = axes_or_new(ax)
    film, conditions = result.film, result.conditions
    x = in_half_widths(result, film.x)
    largest = max(film.max_pressure, conditions.max_pressure)
    factor, unit = unit_for(largest, "Pa")
    hertz = conditions.max_pressure * line_pressure(x)
    lines = ax.plot(x, factor * hertz, color=GREY, ls="--", lw=0.8, label="Hertz pressure")
    lines += ax.plot(x, factor * film.pressure, color=BLUE, label="pressure")
    ax.set_xlim(max(x[0], -2.0), min(x[-1], 1.5))
    label_position(result, ax)
    ax.set_ylabel(f"pressure $p$ [{unit}]", color=BLUE)
    ax.set_ylim(0.0, 1.6 * factor * largest)
    twin = ax.twinx()
    to_pressure = factor
    factor, unit = unit_for(film.central_thickness, "m")
    lines += twin.plot(x, factor * film.thickness, color=ORANGE, label="film thickness")
    if result.smooth:
        ax.plot(x, to_pressure * result.smooth.pressure, color="black", lw=0.9, ls=":")
        smooth = factor * result.smooth.thickness
        lines += twin.plot(x, smooth, color="black", lw=0.9, ls=":", label="both, smooth surfaces")
    minimum, position = factor * film.minimum_thickness, film.minimum_position / conditions.half_width
    ax.set_title(rf"$h_\mathrm{{min}}$ = {minimum:.3g} {unit} at $x/b$ = {position:.3f}", loc="right")
    twin.set_ylabel(f"film thickness $h$ [{unit}]", color=ORANGE)
    twin.set_ylim(0.0, 5.0 * factor * film.central_thickness)
    # Every contact leaves room for the legend above the Hertz pressure, between the flanks of the film.
    centre = (0.0 - ax.get_xlim()[0]) / (ax.get_xlim()[1] - ax.get_xlim()[0])
    ax.legend(handles=lines, loc="center", bbox_to_anchor=(centre, 0.82), frameon=False)
    return ax


def potential(result: Result, ax: Axes | None = None) -> Axes:
    """Draw a map of the electric potential in the film, with ten equipotential lines.

    Parameters
    ----------
    result : Result
        Result of a line contact.
    ax : Axes, optional
        Axes to draw on; axes of a new figure if omitted.

    Returns
    -------
    Axes
        Axes with the map, and a colour bar beside them.
    """
    field, electric = result.field, result.case.electric
    low, high = sorted((electric.potential_1, electric.potential_2))
    ticks = np.linspace(low, high, 5)
    ax = _map(result, field.potential, ax, label="potential $V$ [V]", limits=(low, high), ticks=ticks)
    x, y = _mesh(result)
    lines = np.linspace(low, high, 12)[1:-1]
    ax.contour(x, y, field.potential, lines, colors="white", linewidths=0.4, linestyles="-")
    return ax


def field_strength(result: Result, ax: Axes | None = None, *, largest: float | None = None) -> Axes:
    """Draw a map of the dimensionless field strength in the film, abs(E) h_min/V12.

    Parameters
    ----------
    result : Result
        Result of a line contact.
    ax : Axes, optional
        Axes to draw on; axes of a new figure if omitted.
    largest : float, optional
        Value of abs(E) h_min/V12 at the end of the colour scale; its maximum in the film if omitted.

    Returns
    -------
    Axes
        Axes with the map, and a colour bar beside them.

    Notes
    -----
    Drawn as Figures 5 and 6 of Morris et al. (2022), doi:10.3390/lubricants10050087.
    """
    field = result.field
    scale = result.strength_scale
    label = r"field strength $|E|\,h_\mathrm{min}/V_{12}$"
    limits = (0.0, largest or float(scale * np.max(field.strength)))
    nice = np.asarray(MaxNLocator(6).tick_values(*limits))
    ticks = nice[(nice >= limits[0]) & (nice <= limits[1])]
    ax = _map(result, scale * field.strength, ax, label=label, limits=limits, ticks=ticks)
    factor, unit = unit_for(1.0 / scale, "V/m")
    ax.set_title(rf"$V_{{12}}/h_\mathrm{{min}}$ = {factor / scale:.3g} {unit}", loc="right")
    return ax


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
) -> Axes:
    """Draw a map of values (nx, ns) in the film, with its axis labels and colour bar."""
    ax = axes_or_new(ax)
    x, y = _mesh(result)
    _, unit = unit_for(result.film.central_thickness, "m")
    electric = result.case.electric
    potentials = (electric.potential_1, electric.potential_2)
    filled = draw_section(ax, x[:, 0], y, values, limits=limits, potentials=potentials)
    ax.set_ylabel(f"height $y$ [{unit}]")
    label_position(result, ax)
    bar = figure_of(ax).colorbar(filled, ax=ax, label=label, pad=0.02)
    bar.set_ticks(list(ticks))
    return ax


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
        Axes with the field strength in V/m, prefixed, on the left, and abs(E) h_min/V12 on the right.
    """
    ax = axes_or_new(ax)
    field = result.field
    x = in_half_widths(result, field.x)
    factor, unit = unit_for(field.max_strength, "V/m")
    zone = in_half_widths(result, np.array(field.high_field_zone))
    width, length = unit_for(field.high_field_width, "m", least=1.0)
    label = f"mid-film above 95 % of its maximum: {width * field.high_field_width:.3g} {length} wide"
    ax.axvspan(zone[0], zone[1], color=GREEN, alpha=0.25, lw=0.0, label=label)
    thin = 0.4 if result.rough else 1.0
    # Within some gap heights of the end faces of the field domain, the faces disturb the field.
    on = field.inner
    ax.plot(x[on], factor * field.strength[on, 0], color=BLUE, lw=2.4 * thin, label="surface 1")
    ax.plot(x[on], factor * field.strength[on, -1], color=ORANGE, ls="--", lw=1.6 * thin, label="surface 2")
    ax.plot(x[on], factor * field.middle_strength[on], color="black", lw=0.8, label="mid-film")
    if result.smooth:
        smooth = factor * result.smooth.middle_strength
        ax.plot(x, smooth, color=GREY, lw=1.2, ls=":", label="mid-film, smooth surfaces")
    ax.set(ylabel=rf"field strength $|E|$ [{unit}]", xlim=(x[0], x[-1]))
    label_position(result, ax)
    ax.set_ylim(0.0, 1.08 * factor * field.max_strength)
    scale = result.strength_scale / factor
    right = ax.secondary_yaxis(
        "right", functions=(lambda e: np.asarray(e) * scale, lambda e: np.asarray(e) / scale)
    )
    right.set_ylabel(r"$|E|\,h_\mathrm{min}/V_{12}$")
    ax.legend(loc="lower center", frameon=False)
    return ax


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
        Axes with the deviations in per mille of V12/h, on both walls and at mid-film. The ends of the field
        domain are left out: within some gap heights, the end faces disturb the field.
    """
    ax = axes_or_new(ax)
    field = result.field
    x = in_half_widths(result, field.x)
    sections = (
        ("surface 1", field.strength[:, 0], BLUE, "-", 2.4),
        ("surface 2", field.strength[:, -1], ORANGE, "--", 1.6),
        ("mid-film", field.middle_strength, "black", "-", 0.8),
    )
    thin = 0.4 if result.rough else 1.0
    for label, strength, color, line, width in sections:
        deviation = 1e3 * (strength / field.thin_gap_strength - 1.0)
        ax.plot(x[field.inner], deviation[field.inner], color=color, ls=line, lw=thin * width, label=label)
    ax.set(ylabel=r"$|E|\,h/V_{12} - 1$ [‰]", xlim=(x[0], x[-1]))
    label_position(result, ax)
    ax.margins(y=0.1)
    ax.legend(loc="best", frameon=False)
    return ax


def roughness(result: Result, ax: Axes | None = None) -> Axes:
    """Draw the roughness of both surfaces over x/b, as the film solver uses it.

    Peaks, which make the film thinner, point up for both surfaces.

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
    for k, rq, color in ((1, statistics.rq_1, BLUE), (2, statistics.rq_2, ORANGE)):
        heights = result.roughness[k - 1]
        if np.any(heights):
            label = f"surface {k}, Rq = {factor * rq:.3g} {unit} within $|x/b| \\leq 1$"
            ax.plot(x, factor * heights, color=color, lw=0.7, label=label)
    ax.set_xlim(max(x[0], -2.0), min(x[-1], 1.5))
    label_position(result, ax)
    ax.set_ylabel(f"height [{unit}]")
    low, high = ax.get_ylim()
    ax.set_ylim(low, high + 0.25 * (high - low))
    ax.legend(loc="upper left", frameon=False, ncols=2)
    return ax


FIGURES: dict[str, Callable[..., Axes]] = {
    "film.png": pressure_and_film,
    "potential.png": potential,
    "field_strength.png": field_strength,
    "field_profiles.png": field_profiles,
    "field_deviation.png": field_deviation,
}


def figures_of(result: Result) -> dict[str, Callable[..., Axes]]:
    """Functions that draw the figures of a line contact, by file name."""
    return FIGURES | ({ROUGHNESS_FIGURE: roughness} if np.any(result.roughness) else {})
