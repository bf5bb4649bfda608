"""Maps of the field in the film of a line contact: potential and field strength."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Patch
from matplotlib.ticker import MaxNLocator

from ehlectric.arrays import Array
from ehlectric.contact.results import Result
from ehlectric.figures.axes import BAR
from ehlectric.figures.contact.maps import round_levels
from ehlectric.figures.contact.panels import enlarged_below, stacked_panels
from ehlectric.figures.lengths import in_half_widths, label_position
from ehlectric.figures.section import MAXIMUM, draw_section, section_part
from ehlectric.figures.style import axes_or_new, figure_of, legend_above
from ehlectric.quantities.palette import BODY, OUT_OF_RANGE
from ehlectric.quantities.units import unit_for


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
    """Draw a map of the field strength in the film, and enlarged around its maximum, which is marked.

    Parameters
    ----------
    result : Result
        Result of a line contact.
    ax : Axes, optional
        Axes to draw on; axes of a new figure if omitted.
    largest : float, optional
        Draws the dimensionless field strength abs(E) h_min/V12 instead, from 0 to this value.

    Returns
    -------
    Axes
        Axes with the map, and a colour bar beside them. The colours span the field strengths inside the
        Hertz zone; smaller ones are grey. In a new figure, a second panel enlarges the film around the
        maximum.

    Notes
    -----
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
        handles.insert(0, Patch(facecolor=OUT_OF_RANGE, label=f"film below {limits[0]:.4g} {unit}"))
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
    ax.set_title(rf"$V_{{12}}/h_\mathrm{{min}}$ = {factor / scale:.3g} {unit}", loc="right")
    return ax


def _zoom(result: Result, panels: tuple[Axes, Axes], values: Array, limits: tuple[float, float]) -> Patch:
    """Draw the surroundings of the maximum enlarged on the lower panel, and return their legend entry."""
    above, below = panels
    x, y = _mesh(result)
    k = int(np.argmax(np.max(values, axis=1)))
    half = 0.06 if not result.rough else 0.03
    ends = float(x[k, 0]) - half, float(x[k, 0]) + half
    section_part(below, x[:, 0], y, values, limits=limits, under=True)
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
    # Beside the axes themselves, a wide legend above them does not push the bar away.
    place: dict[str, Any] = {"cax": ax.inset_axes(BAR)} if under else {"ax": ax, "pad": 0.02}
    bar = figure_of(ax).colorbar(filled, label=label, **place)
    bar.set_ticks(list(ticks))
    return ax
