"""Polar figures of a bearing: load and film of its contacts around the shaft."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.patheffects import withStroke
from matplotlib.projections.polar import PolarAxes
from matplotlib.ticker import FixedLocator, NullLocator

from ehlectric.arrays import Array, Mask
from ehlectric.bearing.result import BearingResult
from ehlectric.bearing.solution import CONDUCTING, PARTIAL, RingState
from ehlectric.figures.axes import round_numbers
from ehlectric.figures.data import is_wide
from ehlectric.figures.style import page_size
from ehlectric.quantities.palette import BLUE, GREY, ORANGE
from ehlectric.quantities.units import unit_for

# Name of each ring, with colour, line width and size of markers. The loads of both rings are nearly equal, so
# the line of the inner ring is drawn last, over the wider line of the outer ring.
_RINGS = (("inner", BLUE, 1.1, 4.0), ("outer", ORANGE, 2.2, 6.5))

# Radius of the inner circle, at which the scale begins, over the radius of the outer circle.
_CORE = 0.3

# The circle of a lambda ratio is shown if the smallest film is below this many times its film thickness.
_FAR = 4.0

# With more round numbers than this along a logarithmic radius, only powers of ten have ticks.
_MOST_TICKS = 7


def new_polar(columns: int, size: tuple[float, float]) -> list[Axes]:
    """Polar axes side by side in a new figure, whose size on the screen is in inches."""
    figure = Figure(figsize=page_size(size))
    FigureCanvasAgg(figure)
    return list(figure.subplots(1, columns, squeeze=False, subplot_kw={"projection": "polar"}).ravel())


def load_around(result: BearingResult, ax: Axes | None = None) -> Axes:
    """Draw the load of both contacts of the elements around the shaft.

    Parameters
    ----------
    result : BearingResult
        Result of the bearing to draw.
    ax : Axes, optional
        Polar axes to draw on; axes of a new figure if omitted.

    Returns
    -------
    Axes
        Polar axes on which the radial load on the inner ring points down. Markers show the elements at the
        first position of the cage, and lines connect the elements at all positions.
    """
    ax = _polar_or_new(result, ax)
    states = [(position.inner, position.outer) for position in result.solution.positions]
    largest = max(float(np.max(race.load)) for pair in states for race in pair)
    factor, unit = unit_for(largest, "N", least=1.0)
    for k, ring in reversed(list(enumerate(_RINGS))):
        races = [pair[k] for pair in states]
        _ring(result, ax, ring, races, [factor * race.load for race in races], at_rest="unloaded")
    _radius(ax, np.array([0.0, factor * largest]), _between(result), log=False)
    ax.set_title(f"contact load [{unit}]")
    _legend_below(ax)
    return ax


def film_around(result: BearingResult, ax: Axes | None = None) -> Axes:
    """Draw the minimum film thickness of the loaded contacts of the elements around the shaft.

    Parameters
    ----------
    result : BearingResult
        Result of the bearing to draw.
    ax : Axes, optional
        Polar axes to draw on; axes of a new figure if omitted.

    Returns
    -------
    Axes
        Polar axes on which the radial load points down. Sectors in which a ring does not load the elements
        are shaded: there is a gap in place of a film, which the legend states. Circles show the film
        thicknesses at lambda
        ratios of 1, below which surfaces touch, and 3. The radius is logarithmic if films differ widely.
    """
    ax = _polar_or_new(result, ax)
    states = [(position.inner, position.outer) for position in result.solution.positions]
    rq = result.solution.case.bearing.composite_rq
    films = np.concatenate([race.values.minimum_thickness[race.solved] for pair in states for race in pair])
    factor, unit = unit_for(float(films.min()), "m")
    # Circles far below the films are left out, because they would leave little room for the films.
    ratios = [ratio for ratio in (CONDUCTING, PARTIAL) if films.min() < _FAR * ratio * rq]
    everything = factor * np.concatenate([films, rq * np.array(ratios)])
    angles = np.linspace(0.0, 2.0 * np.pi, 181)
    for ratio in ratios:
        line = ":" if ratio == CONDUCTING else "--"
        label = rf"$\lambda$ = {ratio:g}"
        ax.plot(angles, np.full_like(angles, factor * ratio * rq), color=GREY, lw=0.9, ls=line, label=label)
    for k, ring in reversed(list(enumerate(_RINGS))):
        races = [pair[k] for pair in states]
        values = [np.where(race.solved, factor * race.values.minimum_thickness, np.nan) for race in races]
        _ring(result, ax, ring, races, values)
    _radius(ax, everything, _between(result), log=is_wide(everything))
    for k, ring in enumerate(_RINGS):
        _unloaded(result, ax, ring, [pair[k] for pair in states])
    ax.set_title(f"minimum film $h_\\mathrm{{min}}$ [{unit}]")
    _legend_below(ax)
    return ax


def _unloaded(
    result: BearingResult, ax: Axes, ring: tuple[str, str, float, float], races: Sequence[RingState]
) -> None:
    """Shade the sector in which no element is loaded by a ring, and name it in the legend with the gap."""
    name, color, *_ = ring
    angle, loaded = _around(result, [race.solved for race in races])
    if np.all(loaded):
        return
    gaps = np.concatenate([race.values.minimum_thickness[~race.solved] for race in races])
    factor, unit = unit_for(float(gaps.max()), "m")
    low, high = ax.get_ylim()
    edges = 0.5 * (angle + np.append(angle[1:], angle[0] + 2.0 * np.pi))
    before = np.append(edges[-1] - 2.0 * np.pi, edges[:-1])
    for begin, end in zip(before[~loaded], edges[~loaded], strict=True):
        ax.fill_between([begin, end], low, high, color=color, alpha=0.10, lw=0.0, zorder=0.5)
    text = f"{name} unloaded: gap to {factor * gaps.max():.2g} {unit}"
    ax.fill_between([], [], [], color=color, alpha=0.10, lw=0.0, label=text)


def _around(result: BearingResult, values: Sequence[Array | Mask]) -> tuple[Array, Any]:
    """Angles of all elements at all positions of the cage from 0 to 2 pi, and values in their order."""
    angles = np.mod(np.concatenate([p.equilibrium.position for p in result.solution.positions]), 2.0 * np.pi)
    order = np.argsort(angles, kind="stable")
    return angles[order], np.concatenate(values)[order]


def _polar_or_new(result: BearingResult, ax: Axes | None) -> PolarAxes:
    polar = new_polar(1, (3.6, 4.2))[0] if ax is None else ax
    assert isinstance(polar, PolarAxes)
    # The radial load points down.
    polar.set_theta_zero_location("S")
    angles = np.arange(0, 360, 45)
    load = "radial load, 0°" if result.solution.case.bearing.radial_load else "0°"
    polar.set_thetagrids(angles, [load, *(f"{angle}°" for angle in angles[1:])])
    polar.grid(color="0.85", lw=0.6)
    return polar


def _ring(
    result: BearingResult,
    ax: Axes,
    ring: tuple[str, str, float, float],
    races: Sequence[RingState],
    values: Sequence[Array],
    *,
    at_rest: str = "",
) -> None:
    """Draw the contacts with one ring: lines over all positions of the cage, markers at the first one.

    Contacts without load have hollow markers called ``at_rest``, and a dotted line.
    """
    name, color, width, size = ring
    angle, along = _around(result, values)
    _, loaded = _around(result, [race.solved for race in races])
    angle, along = np.append(angle, angle[0] + 2.0 * np.pi), np.append(along, along[0])
    loaded = np.append(loaded, loaded[0])
    ax.plot(angle, np.where(loaded, along, np.nan), color=color, lw=width)
    ax.plot(angle, np.where(loaded, np.nan, along), color=color, lw=width, ls=":")
    marks: dict[str, Any] = {"ls": "none", "marker": "o", "ms": size, "color": color, "clip_on": False}
    on, at = races[0].solved, result.solution.positions[0].equilibrium.position
    ax.plot(at[on], values[0][on], label=f"{name} contact", zorder=4.0, **marks)
    if at_rest and not np.all(on):
        hollow = marks | {"mfc": "white", "label": f"{name}, {at_rest}", "zorder": 4.0}
        ax.plot(at[~on], values[0][~on], **hollow)


def _between(result: BearingResult) -> float:
    """Angle near the top, halfway between two elements at the first position of the cage [rad]."""
    at = np.sort(np.mod(result.solution.positions[0].equilibrium.position, 2.0 * np.pi))
    halfway = 0.5 * (at + np.append(at[1:], at[0] + 2.0 * np.pi))
    return float(halfway[np.argmin(np.abs(halfway - np.pi))])


def _radius(ax: Axes, values: Array, at: float, *, log: bool) -> None:
    """Scale the radius from an inner circle outwards, and write a few numbers along an angle [rad]."""
    assert isinstance(ax, PolarAxes)
    low, high = float(np.min(values)), float(np.max(values))
    if log:
        ax.set_rscale("log")
        low, high = 0.8 * low, 1.2 * high
        ticks = round_numbers(low, high)
        if ticks.size > _MOST_TICKS:
            ticks = np.array([tick for tick in ticks if math.isclose(math.log10(tick) % 1.0, 0.0)])
        origin = low * (low / high) ** (_CORE / (1.0 - _CORE))
    else:
        low, high = 0.0, 1.06 * high
        step = 10.0 ** math.floor(math.log10(high))
        step *= next(part for part in (0.2, 0.5, 1.0, 2.0) if high <= 5.0 * part * step)
        ticks = np.arange(0.0, high, step)
        origin = -high * _CORE / (1.0 - _CORE)
    ax.set_rlim(low, high)
    ax.set_rorigin(origin)
    ax.yaxis.set_major_locator(FixedLocator(list(ticks)))
    ax.yaxis.set_minor_locator(NullLocator())
    ax.tick_params(axis="y", labelleft=False)
    # Labels of an axis would lie below the lines: these texts lie above them.
    edge = [withStroke(linewidth=2.4, foreground="white")]
    for tick in ticks:
        where: dict[str, Any] = {"ha": "center", "va": "center", "fontsize": "small", "zorder": 6.0}
        ax.text(at, tick, f"{tick:g}", path_effects=edge, **where)


def _legend_below(ax: Axes) -> None:
    handles, labels = ax.get_legend_handles_labels()
    order = sorted(range(len(labels)), key=lambda k: ("inner" not in labels[k], "outer" not in labels[k], k))
    ax.legend(
        handles=[handles[k] for k in order],
        loc="upper center",
        bbox_to_anchor=(0.5, -0.1),
        ncols=2,
        frameon=False,
        columnspacing=1.4,
    )
