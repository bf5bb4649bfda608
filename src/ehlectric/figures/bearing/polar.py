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

from ehlectric.arrays import Array
from ehlectric.bearing.result import BearingResult
from ehlectric.bearing.solution import CONDUCTING, PARTIAL, RingState
from ehlectric.cases.quantity import unit_for
from ehlectric.figures.axes import is_wide, round_numbers
from ehlectric.figures.style import BLUE, GREY, ORANGE

# Name, colour, width of line and size of marks: inner over outer, whose loads are nearly the same.
_RINGS = (("inner", BLUE, 1.1, 4.0), ("outer", ORANGE, 2.2, 6.5))

# Radius of the circle of no load, or of the least film, over that of the largest.
_CORE = 0.3

# Least film over that of a lambda whose circle is shown no more.
_FAR = 4.0

# More round numbers than these along a logarithmic radius leave powers of ten alone.
_MOST_TICKS = 7


def new_polar(columns: int, size: tuple[float, float]) -> list[Axes]:
    """Polar axes of a new figure of a size in inches, beside each other."""
    figure = Figure(figsize=size)
    FigureCanvasAgg(figure)
    return list(figure.subplots(1, columns, squeeze=False, subplot_kw={"projection": "polar"}).ravel())


def load_around(result: BearingResult, ax: Axes | None = None) -> Axes:
    """Load of both contacts of the elements over the angle.

    Parameters
    ----------
    result : BearingResult
        What to draw.
    ax : Axes, optional
        Polar ones; new axes otherwise.

    Returns
    -------
    Axes
        The radial load on the inner ring points down. Marks are the elements at the cage's first position,
        lines go through all of its positions.
    """
    ax = _polar_or_new(result, ax)
    states = [(position.inner, position.outer) for position in result.solution.positions]
    largest = max(float(np.max(race.load)) for pair in states for race in pair)
    factor, unit = unit_for(largest, "N", least=1.0)
    for k, ring in reversed(list(enumerate(_RINGS))):
        races = [pair[k] for pair in states]
        _ring(result, ax, ring, races, [factor * race.load for race in races], at_rest="not loaded")
    _radius(ax, np.array([0.0, factor * largest]), _between(result), log=False)
    ax.set_title(f"contact load [{unit}]")
    _legend_below(ax)
    return ax


def film_around(result: BearingResult, ax: Axes | None = None) -> Axes:
    """Minimum film of both contacts of the elements over the angle, and the gaps of those without load.

    Parameters
    ----------
    result : BearingResult
        What to draw.
    ax : Axes, optional
        Polar ones; new axes otherwise.

    Returns
    -------
    Axes
        As those of ``load_around``; films that differ widely have a logarithmic radius. Circles show where
        lambda is 1, below which the surfaces touch, and 3.
    """
    ax = _polar_or_new(result, ax)
    states = [(position.inner, position.outer) for position in result.solution.positions]
    rq = result.solution.case.bearing.composite_rq
    films = np.concatenate([race.values.minimum_thickness for pair in states for race in pair])
    # Gaps without load may be next to nothing, or far above the films.
    thinnest = min(
        float(np.min(race.values.minimum_thickness[race.solved])) for pair in states for race in pair
    )
    factor, unit = unit_for(thinnest, "m")
    # Circles far below the films would leave them little room.
    ratios = [ratio for ratio in (CONDUCTING, PARTIAL) if films.min() < _FAR * ratio * rq]
    everything = factor * np.concatenate([films, rq * np.array(ratios)])
    angles = np.linspace(0.0, 2.0 * np.pi, 181)
    for ratio in ratios:
        line = ":" if ratio == CONDUCTING else "--"
        label = rf"$\lambda$ = {ratio:g}"
        ax.plot(angles, np.full_like(angles, factor * ratio * rq), color=GREY, lw=0.9, ls=line, label=label)
    for k, ring in reversed(list(enumerate(_RINGS))):
        races = [pair[k] for pair in states]
        values = [factor * race.values.minimum_thickness for race in races]
        _ring(result, ax, ring, races, values, at_rest="not loaded: gap")
    _radius(ax, everything, _between(result), log=is_wide(everything))
    ax.set_title(f"minimum film $h_\\mathrm{{min}}$ [{unit}]")
    _legend_below(ax)
    return ax


def _polar_or_new(result: BearingResult, ax: Axes | None) -> PolarAxes:
    found = new_polar(1, (3.6, 4.2))[0] if ax is None else ax
    assert isinstance(found, PolarAxes)
    found.set_theta_zero_location("S")
    angles = np.arange(0, 360, 45)
    # Seen so that the load points down.
    load = "radial load, 0°" if result.solution.case.bearing.radial_load else "0°"
    found.set_thetagrids(angles, [load, *(f"{angle}°" for angle in angles[1:])])
    found.grid(color="0.85", lw=0.6)
    return found


def _ring(
    result: BearingResult,
    ax: Axes,
    ring: tuple[str, str, float, float],
    races: Sequence[RingState],
    values: Sequence[Array],
    *,
    at_rest: str,
) -> None:
    """Contacts with one ring: lines through all positions of the cage, marks at the first."""
    name, color, width, size = ring
    angles = [position.equilibrium.position for position in result.solution.positions]
    order = np.argsort(np.concatenate(angles))
    order = np.append(order, order[0])
    angle = np.concatenate(angles)[order]
    angle[-1] += 2.0 * np.pi
    along, loaded = np.concatenate(values)[order], np.concatenate([race.solved for race in races])[order]
    ax.plot(angle, np.where(loaded, along, np.nan), color=color, lw=width)
    ax.plot(angle, np.where(loaded, np.nan, along), color=color, lw=width, ls=":")
    marks: dict[str, Any] = {"ls": "none", "marker": "o", "ms": size, "color": color, "clip_on": False}
    on = races[0].solved
    ax.plot(angles[0][on], values[0][on], label=f"{name} contact", zorder=4.0, **marks)
    if not np.all(on):
        hollow = marks | {"mfc": "white", "label": f"{name}, {at_rest}", "zorder": 4.0}
        ax.plot(angles[0][~on], values[0][~on], **hollow)


def _between(result: BearingResult) -> float:
    """Angle near the top, halfway between two elements at the cage's first position: no mark is there."""
    at = np.sort(np.mod(result.solution.positions[0].equilibrium.position, 2.0 * np.pi))
    halfway = 0.5 * (at + np.append(at[1:], at[0] + 2.0 * np.pi))
    return float(halfway[np.argmin(np.abs(halfway - np.pi))])


def _radius(ax: Axes, values: Array, at: float, *, log: bool) -> None:
    """Radius from a circle of some size, so that elements there stand apart; few ticks, named at an angle."""
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
    # Written over the lines, which own labels of an axis are not.
    edge = [withStroke(linewidth=2.4, foreground="white")]
    for tick in ticks:
        where: dict[str, Any] = {"ha": "center", "va": "center", "fontsize": 7.5, "zorder": 6.0}
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
