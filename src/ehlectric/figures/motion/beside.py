"""Roughness that moves beside the same roughness held still: film, pressure and field along entrainment."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from ehlectric.arrays import Array
from ehlectric.cases.quantity import unit_for
from ehlectric.figures.motion.panels import (
    Unit,
    along_label,
    field_unit,
    film_unit,
    fitted,
    height_unit,
    in_contact,
    shown_range,
    time_unit,
)
from ehlectric.figures.style import BLUE, GREY, ORANGE, axes_or_new, legend_above
from ehlectric.motion.record import MotionRun, coincident_frame

# Parts of a half-width that roughness may be from where the case has it without a word.
_SAME_PLACE = 1e-6


def film_beside(run: MotionRun, ax: Axes | None = None) -> Axes:
    """Film thickness with the roughness moving and held still, and before the motion.

    Parameters
    ----------
    run : MotionRun
        With an instant at which the surfaces lie as the case has them.
    ax : Axes, optional
        Where to; new axes otherwise.

    Returns
    -------
    Axes
        Of the films in the Hertz zone: those around it are thicker.
    """
    ax, lines = _three(run, ax, "thickness", film_unit(run), ("film thickness $h$", "least", np.nanmin))
    ax.set_ylim(*fitted(*(in_contact(run, line) for line in lines)))
    return ax


def pressure_beside(run: MotionRun, ax: Axes | None = None) -> Axes:
    """Pressure with the roughness moving and held still, and before the motion.

    Parameters
    ----------
    run : MotionRun
        With an instant at which the surfaces lie as the case has them.
    ax : Axes, optional
        Where to; new axes otherwise.

    Returns
    -------
    Axes
        From no pressure.
    """
    unit = unit_for(max(_extremes(run, "pressure", np.nanmax)), "Pa")
    ax, lines = _three(run, ax, "pressure", unit, ("pressure $p$", "largest", np.nanmax))
    ax.set_ylim(0.0, 1.06 * max(float(np.max(line)) for line in lines))
    return ax


def field_beside(run: MotionRun, ax: Axes | None = None) -> Axes:
    """Largest field strength of the column with the roughness moving and held still, and before the motion.

    Parameters
    ----------
    run : MotionRun
        With an instant at which the surfaces lie as the case has them.
    ax : Axes, optional
        Where to; new axes otherwise.

    Returns
    -------
    Axes
        Of the fields in the Hertz zone: those around it are smaller.
    """
    ax, lines = _three(run, ax, "strength", field_unit(run), ("field $|E|$", "largest", np.nanmax))
    ax.set_ylim(*fitted(*(in_contact(run, line) for line in lines)))
    return ax


def roughness_at(run: MotionRun, frame: int, ax: Axes | None = None, *, unit: Unit | None = None) -> Axes:
    """Heights of the rough surfaces along entrainment at a recorded instant, peaks up for either.

    Parameters
    ----------
    run : MotionRun
        What to draw.
    frame : int
        Which of its instants.
    ax : Axes, optional
        Where to; new axes otherwise.
    unit : (float, str), optional
        Factor and unit of the heights; those that suit this instant otherwise.

    Returns
    -------
    Axes
        Of the same range as the film.
    """
    ax = axes_or_new(ax)
    heights = {k: run.along(f"roughness_{k}", frame) for k in run.speeds}
    factor, name = unit or height_unit(np.stack(list(heights.values())))
    for k, colour, style in ((1, "black", "-"), (2, GREY, "--")):
        if k in heights:
            ax.plot(run.x, factor * heights[k], color=colour, ls=style, lw=0.8, label=f"surface {k}")
    ax.set(xlim=shown_range(run), ylabel=f"roughness [{name}]")
    along_label(run, ax)
    legend_above(ax)
    return ax


def coincidence_text(run: MotionRun) -> str:
    """When the surfaces lie as the case has them, and how far they are from it at the instant drawn."""
    frame = coincident_frame(run)
    assert frame is not None
    factor, unit = time_unit(run)
    text = f"at t = {factor * run.frame_time[frame]:.4g} {unit}"
    speed = max((abs(speed) for speed in run.speeds.values()), default=0.0)
    late = speed * (run.frame_time[frame] - run.moment("coincident"))
    if abs(late) <= _SAME_PLACE * run.conditions.half_width:
        return f"{text}, when the roughness lies as it is held still"
    factor, unit = unit_for(abs(late), "m", least=1.0)
    how = "past" if late > 0.0 else "short of"
    return f"{text}, the roughness {factor * abs(late):.3g} {unit} {how} where it is held still"


def _extremes(run: MotionRun, name: str, of: Callable[[Array], Any]) -> list[float]:
    """An extreme of a variable on all nodes: moving, held still and before the motion."""
    frame = coincident_frame(run)
    found = [run.dataset[name].isel(frame=frame), run.dataset[f"stationary_{name}"]]
    found.append(run.dataset[name].isel(frame=0))
    return [float(of(values.values)) for values in found]


def _three(
    run: MotionRun,
    ax: Axes | None,
    name: str,
    unit: Unit,
    said: tuple[str, str, Callable[[Array], Any]],
) -> tuple[Axes, list[Array]]:
    """Lines along entrainment of a variable: moving, held still and before the motion.

    ``said`` is what the axis calls it, and what the legend calls which extreme of it.
    """
    ax, (factor, suffix), (label, kind, extreme) = axes_or_new(ax), unit, said
    lines = [run.along(name, coincident_frame(run)), run.along(f"stationary_{name}"), run.along(name, 0)]
    looks = (
        ("moving", f"{kind} ", BLUE, "-"),
        ("held still", "", ORANGE, "--"),
        ("before the motion", "", "black", ":"),
    )
    drawn = [factor * line for line in lines]
    extremes = _extremes(run, name, extreme)
    for line, value, (when, what, colour, style) in zip(drawn, extremes, looks, strict=True):
        told = f"{when}, {what}{factor * value:.3g} {suffix}"
        ax.plot(run.x, line, color=colour, ls=style, lw=1.0, label=told)
    ax.set_xlim(*shown_range(run))
    ax.set_ylabel(f"{label} [{suffix}]")
    along_label(run, ax)
    legend_above(ax, columns=3)
    return ax, drawn
