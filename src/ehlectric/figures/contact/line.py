"""Figures of a result: each function draws on the axes it is given, and solves nothing."""

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
    """Pressure and film thickness over X around the contact, the Hertz pressure behind them.

    Parameters
    ----------
    result : Result
        What to draw.
    ax : Axes, optional
        Where to; new axes otherwise.

    Returns
    -------
    Axes
        Those of the pressure; the film is on a twin.
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
    # Over the dome of the pressure and between the flanks of the film there is room in any contact.
    centre = (0.0 - ax.get_xlim()[0]) / (ax.get_xlim()[1] - ax.get_xlim()[0])
    ax.legend(handles=lines, loc="center", bbox_to_anchor=(centre, 0.82), frameon=False)
    return ax


def potential(result: Result, ax: Axes | None = None) -> Axes:
    """Map of the electric potential in the film, with ten equipotential lines.

    Parameters
    ----------
    result : Result
        What to draw.
    ax : Axes, optional
        Where to; new axes otherwise.

    Returns
    -------
    Axes
        With a colour bar beside them.
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
    """Map of the dimensionless field strength in the film, abs(E) h_min/V12.

    Parameters
    ----------
    result : Result
        What to draw.
    ax : Axes, optional
        Where to; new axes otherwise.
    largest : float, optional
        End of the colours; that of the largest field otherwise.

    Returns
    -------
    Axes
        With a colour bar beside them.

    Notes
    -----
    As Figures 5 and 6 of Morris et al. (2022), doi:10.3390/lubricants10050087.
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
    """x/b and height at the nodes of the field, the height in the unit of the film's axis."""
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
    """Field strength at mid-film and on both walls over X, the high-field zone of mid-film shaded.

    Parameters
    ----------
    result : Result
        What to draw.
    ax : Axes, optional
        Where to; new axes otherwise.

    Returns
    -------
    Axes
        Dimensional on the left, dimensionless on the right.
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
    # The end faces disturb the field over some gaps.
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
    """Deviation of the field strength from the thin-gap estimate V12/h over X.

    Parameters
    ----------
    result : Result
        What to draw.
    ax : Axes, optional
        Where to; new axes otherwise.

    Returns
    -------
    Axes
        In per mille of V12/h, without the ends of the range: their faces disturb the field over some gaps.
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
    """Roughness of both surfaces over X as the film sees it, peaks up for either.

    Parameters
    ----------
    result : Result
        What to draw.
    ax : Axes, optional
        Where to; new axes otherwise.

    Returns
    -------
    Axes
        Of the same range of X as the film's figure.
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
    """The figures of a result by the names of their files."""
    return FIGURES | ({ROUGHNESS_FIGURE: roughness} if np.any(result.roughness) else {})
