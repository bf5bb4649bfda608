"""Figures of cuts through a point contact: pressure, film and field over x or y, and sections of the film."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.legend_handler import HandlerTuple
from matplotlib.lines import Line2D

from ehlectric.arrays import Array
from ehlectric.contact.results import PointResult
from ehlectric.figures.contact.breakdown import limit_line
from ehlectric.figures.contact.findings import strength_limit
from ehlectric.figures.contact.maps import film_unit, film_window, round_levels
from ehlectric.figures.contact.profiles import Cut
from ehlectric.figures.lengths import label_position
from ehlectric.figures.section import draw_section
from ehlectric.figures.style import axes_or_new, figure_of, legend_above, new_panels
from ehlectric.quantities.palette import BLUE, GREY, ORANGE
from ehlectric.quantities.units import unit_for

# Colour and dashes of the cut through the centre, and of the cut through the minimum film or maximum field.
_LOOKS = ((BLUE, "-"), (ORANGE, (0, (4.0, 1.2))))


def pressure_cut(result: PointResult, ax: Axes | None = None, *, along: str = "x") -> Axes:
    """Draw the pressure on two cuts, through the centre and through the minimum film, and the Hertz pressure.

    Parameters
    ----------
    result : PointResult
        Result of a point contact.
    ax : Axes, optional
        Axes to draw on; axes of a new figure if omitted.
    along : str
        Direction of the cuts: "x", along entrainment, or "y", across it.

    Returns
    -------
    Axes
        Axes with the pressure over x/b or y/b, and a legend above them.
    """
    ax = axes_or_new(ax)
    film, conditions = result.film, result.conditions
    factor, unit = unit_for(film.max_pressure, "Pa")
    across = np.linspace(-1.0, 1.0, 401)
    hertz = factor * conditions.max_pressure * np.sqrt(1.0 - across**2)
    lines = ax.plot(
        _semi_axis(result, along) * across, hertz, color=GREY, ls=":", lw=0.9, label="Hertz pressure, centre"
    )
    lines += _film_lines(result, ax, along, factor * film.pressure)
    ax.set_ylabel(f"pressure $p$ [{unit}]")
    ax.set_ylim(0.0, 1.05 * factor * max(film.max_pressure, conditions.max_pressure))
    legend_above(ax, lines, 1)
    return ax


def film_cut(result: PointResult, ax: Axes | None = None, *, along: str = "x") -> Axes:
    """Draw the film thickness on two cuts, through the centre and through the minimum film.

    Parameters
    ----------
    result : PointResult
        Result of a point contact.
    ax : Axes, optional
        Axes to draw on; axes of a new figure if omitted.
    along : str
        Direction of the cuts: "x", along entrainment, or "y", across it.

    Returns
    -------
    Axes
        Axes with the film up to twice the central or the mean film thickness, whichever is larger. A dotted
        line shows the film with smooth surfaces, if it was solved for a rough contact.
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
    ax.set_ylabel(f"film thickness $h$ [{unit}]")
    ax.set_ylim(0.0, 2.0 * factor * max(film.central_thickness, film.mean_thickness))
    return ax


def field_cut(result: PointResult, ax: Axes | None = None, *, along: str = "x") -> Axes:
    """Draw the field strength at mid-film on two cuts, through the centre and through the maximum field.

    Parameters
    ----------
    result : PointResult
        Result of a point contact.
    ax : Axes, optional
        Axes to draw on; axes of a new figure if omitted.
    along : str
        Direction of the cuts: "x", along entrainment, or "y", across it.

    Returns
    -------
    Axes
        Axes with the field strength as lines, and the thin-gap estimate V12/h as wide bands behind them. The
        ends of the field domain are left out, because its side faces disturb the field there.
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
    ax.set_ylabel(f"mid-film field $|E|$ [{unit}]")
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
    """Draw pressure, film and field on cuts along entrainment (left) and across it (right).

    The cuts run through the centre and through the minimum film, or for the field through its maximum.

    Parameters
    ----------
    result : PointResult
        Result of a point contact.
    axes : sequence of Axes, optional
        Six axes to draw on, in three rows of two; axes of a new figure if omitted.

    Returns
    -------
    Axes
        The first axes, with the pressure along entrainment.
    """
    axes = new_panels(3, 2, (7.0, 6.6)) if axes is None else axes
    for number, draw in enumerate((pressure_cut, film_cut, field_cut)):
        for along, ax, window in zip("xy", axes[2 * number :], film_window(result), strict=False):
            draw(result, ax, along=along)
            ax.set_xlim(*window)
            label_position(result, ax, along)
            ax.label_outer()
    return axes[0]


def field_section(result: PointResult, ax: Axes | None = None, *, along: str = "x") -> Axes:
    """Draw a section of the film through the maximum field: field strength as colours, and equipotentials.

    Parameters
    ----------
    result : PointResult
        Result of a point contact.
    ax : Axes, optional
        Axes to draw on; axes of a new figure if omitted.
    along : str
        Direction of the section: "x", along entrainment, or "y", across it.

    Returns
    -------
    Axes
        Axes with the section and a colour bar. Heights are measured from the middle between the smooth
        surfaces, because the middle surface itself is curved if the two bodies are unequal.
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
        colors="black",
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

    Parameters
    ----------
    result : PointResult
        Result of a point contact.
    axes : sequence of Axes, optional
        Two axes to draw on; axes of a new figure if omitted.

    Returns
    -------
    Axes
        The first axes, with the section along entrainment.
    """
    axes = new_panels(2, 1, (6.3, 5.6)) if axes is None else axes
    for ax, along in zip(axes, "xy", strict=True):
        field_section(result, ax, along=along)
    highest = max(ax.get_ylim()[1] for ax in axes)
    lowest = min(ax.get_ylim()[0] for ax in axes)
    for ax in axes:
        ax.set_ylim(lowest, highest)
    return axes[0]
