"""Frames of an animation of a transient line contact: film, pressure, field and roughness over x."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from ehlectric.arrays import Array
from ehlectric.figures.motion.beside import roughness_at
from ehlectric.figures.motion.panels import (
    field_unit,
    film_unit,
    fitted,
    height_unit,
    in_contact,
    name_run,
    share_below,
    shown_range,
    time_unit,
)
from ehlectric.figures.style import figure_of, new_panels
from ehlectric.motion.stored_run import MotionRun
from ehlectric.quantities.palette import BLUE, BODY, OIL, ORANGE
from ehlectric.quantities.units import unit_for

# Size of a frame [inches].
_SIZE = (5.2, 6.6)


@dataclass(frozen=True)
class Frames:
    """Figure of a transient run that can show any of its recorded instants.

    Attributes
    ----------
    figure : Figure
        Figure, which first shows the first recorded instant.
    show : callable
        Function of the number of a recorded instant, which makes the figure show this instant.
    colours : tuple of str
        Names of the colour maps in the figure.
    """

    figure: Figure
    show: Callable[[int], None]
    colours: tuple[str, ...] = ()


def time_text(run: MotionRun, frame: int) -> str:
    """Text: time of a recorded instant, with enough digits to distinguish it from the next one."""
    factor, unit = time_unit(run)
    times = factor * run.frame_time
    apart = float(np.min(np.diff(times))) if run.frames > 1 else float(times[0])
    places = max(0, math.ceil(-math.log10(apart))) if apart > 0.0 else 0
    return f"$t$ = {times[frame]:.{places}f} {unit}"


def line_frames(run: MotionRun) -> Frames:
    """Draw film, pressure, field and roughness over x; dotted lines show the values before the motion.

    Parameters
    ----------
    run : MotionRun
        Run of a line contact.

    Returns
    -------
    Frames
        Frames that show the first recorded instant.
    """
    axes = new_panels(4, 1, _SIZE)
    parts = [_film(run, axes[0]), _pressure(run, axes[1]), _field(run, axes[2]), _roughness(run, axes[3])]
    for ax in axes:
        ax.set_xlim(*shown_range(run))
    share_below(axes)
    name_run(axes[0], run)
    handles = [
        Patch(facecolor=OIL, label="oil"),
        Patch(facecolor=BODY, label="steel"),
        Line2D([], [], color="black", lw=0.9, ls=":", label="before the motion"),
        Line2D([], [], color=ORANGE, ls="none", marker="o", ms=4.0, label="maximum"),
    ]
    figure_of(axes[0]).legend(handles=handles, loc="outside lower left", ncols=4, frameon=False)

    def show(frame: int) -> None:
        for part in parts:
            part(frame)
        axes[0].set_title(time_text(run, frame), loc="right")

    show(0)
    return Frames(figure_of(axes[0]), show)


def _film(run: MotionRun, ax: Axes) -> Callable[[int], None]:
    """Draw the gap filled with oil; a dotted line shows the film before the motion."""
    factor, unit = film_unit(run)
    thickness = factor * run.along("thickness")
    low, high = fitted(in_contact(run, thickness))
    ax.set(ylabel=f"film $h$ [{unit}]", ylim=(low, high), facecolor=BODY)
    ax.plot(run.x, thickness[0], color="black", lw=0.9, ls=":")
    (line,) = ax.plot(run.x, thickness[0], color="black")
    filled = [ax.fill_between(run.x, low, thickness[0], color=OIL, lw=0.0, zorder=0.5)]

    def show(frame: int) -> None:
        line.set_ydata(thickness[frame])
        filled.pop().remove()
        filled.append(ax.fill_between(run.x, low, thickness[frame], color=OIL, lw=0.0, zorder=0.5))

    return show


def _pressure(run: MotionRun, ax: Axes) -> Callable[[int], None]:
    pressure = run.along("pressure")
    factor, unit = unit_for(float(np.max(pressure)), "Pa")
    ax.set(ylabel=f"pressure $p$ [{unit}]", ylim=(0.0, 1.06 * factor * float(np.max(pressure))))
    return _curve(run, ax, factor * pressure)


def _field(run: MotionRun, ax: Axes) -> Callable[[int], None]:
    """Draw the field strength and mark its maximum."""
    factor, unit = field_unit(run)
    strength, largest = factor * run.along("strength"), factor * run.values("max_strength")
    ax.set(ylabel=f"field $|E|$ [{unit}]", ylim=fitted(in_contact(run, strength), largest))
    curve = _curve(run, ax, strength)
    at = run.values("max_strength_x") / run.conditions.half_width
    (dot,) = ax.plot(at[:1], largest[:1], ls="none", marker="o", ms=4.0, color=ORANGE, clip_on=False)

    def show(frame: int) -> None:
        curve(frame)
        dot.set_data([at[frame]], [largest[frame]])
        ax.set_title(f"maximum {largest[frame]:#.3g} {unit}", loc="right", color=ORANGE)

    return show


def _curve(run: MotionRun, ax: Axes, values: Array) -> Callable[[int], None]:
    """Draw values, shape (frames, nx), at an instant; a dotted line shows them before the motion."""
    ax.plot(run.x, values[0], color="black", lw=0.9, ls=":")
    (line,) = ax.plot(run.x, values[0], color=BLUE)
    return lambda frame: line.set_ydata(values[frame])


def _roughness(run: MotionRun, ax: Axes) -> Callable[[int], None]:
    """Draw the heights of the rough surfaces."""
    heights = np.stack([run.along(f"roughness_{k}") for k in run.speeds])
    factor, _ = height_unit(heights)
    roughness_at(run, 0, ax, unit=height_unit(heights))
    ax.set_ylim(*fitted(factor * heights))
    lines = ax.get_lines()

    def show(frame: int) -> None:
        for line, values in zip(lines, heights, strict=True):
            line.set_ydata(factor * values[frame])

    return show
