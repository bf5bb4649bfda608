"""Moving and stationary roughness compared: film, pressure and field along entrainment."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from ehlectric.arrays import Array
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
from ehlectric.figures.style import axes_or_new, legend_above
from ehlectric.motion.stored_run import MotionRun, coincident_frame
from ehlectric.quantities.palette import BLUE, GREY, ORANGE
from ehlectric.quantities.units import unit_for


def film_beside(run: MotionRun, ax: Axes | None = None) -> Axes:
    """Draw the film thickness with moving and with stationary roughness, and before the motion.

    Parameters
    ----------
    run : MotionRun
        Run with a recorded instant of largest difference.
    ax : Axes, optional
        Axes to draw on; axes of a new figure if omitted.

    Returns
    -------
    Axes
        Axes whose range fits the film in the Hertz zone; outside the zone the film is thicker.
    """
    ax, lines = _three(run, ax, "thickness", film_unit(run), ("film thickness $h$", "min.", np.nanmin))
    ax.set_ylim(*fitted(*(in_contact(run, line) for line in lines)))
    return ax


def pressure_beside(run: MotionRun, ax: Axes | None = None) -> Axes:
    """Draw the pressure with moving and with stationary roughness, and before the motion.

    Parameters
    ----------
    run : MotionRun
        Run with a recorded instant of largest difference.
    ax : Axes, optional
        Axes to draw on; axes of a new figure if omitted.

    Returns
    -------
    Axes
        Axes whose range begins at zero pressure.
    """
    unit = unit_for(max(_extremes(run, "pressure", np.nanmax)), "Pa")
    ax, lines = _three(run, ax, "pressure", unit, ("pressure $p$", "max.", np.nanmax))
    ax.set_ylim(0.0, 1.06 * max(float(np.max(line)) for line in lines))
    return ax


def field_beside(run: MotionRun, ax: Axes | None = None) -> Axes:
    """Draw the field strength with moving and with stationary roughness, and before the motion.

    Parameters
    ----------
    run : MotionRun
        Run with a recorded instant of largest difference.
    ax : Axes, optional
        Axes to draw on; axes of a new figure if omitted.

    Returns
    -------
    Axes
        Axes whose range fits the field in the Hertz zone; outside the zone the field is smaller.
    """
    ax, lines = _three(run, ax, "strength", field_unit(run), ("field $|E|$", "max.", np.nanmax))
    ax.set_ylim(*fitted(*(in_contact(run, line) for line in lines)))
    return ax


def roughness_at(
    run: MotionRun,
    frame: int,
    ax: Axes | None = None,
    *,
    unit: Unit | None = None,
    stationary: int | None = None,
) -> Axes:
    """Draw the heights of the rough surfaces along entrainment at a recorded instant.

    Parameters
    ----------
    run : MotionRun
        Run to draw.
    frame : int
        Number of the recorded instant.
    ax : Axes, optional
        Axes to draw on; axes of a new figure if omitted.
    unit : (float, str), optional
        Factor and unit of the heights; by default they suit the heights at this instant.
    stationary : int, optional
        Number of the instant at which the surfaces are where stationary roughness is, to draw them too.

    Returns
    -------
    Axes
        Axes with the same range of x as the axes of the film. Peaks of both surfaces point up.
    """
    ax = axes_or_new(ax)
    heights = {k: run.along(f"roughness_{k}", frame) for k in run.speeds}
    factor, name = unit or height_unit(np.stack(list(heights.values())))
    for k, colour, style in ((1, "black", "-"), (2, GREY, "--")):
        if k in heights:
            ax.plot(run.x, factor * heights[k], color=colour, ls=style, lw=0.8, label=f"surface {k}")
            if stationary is not None:
                still, label = run.along(f"roughness_{k}", stationary), f"surface {k}, stationary"
                ax.plot(run.x, factor * still, color=ORANGE, ls=style, lw=0.8, alpha=0.8, label=label)
    ax.set(xlim=shown_range(run), ylabel=f"roughness [{name}]")
    along_label(run, ax)
    legend_above(ax)
    return ax


def compared_frame(run: MotionRun) -> int | None:
    """Recorded instant whose minimum film differs most from that of stationary roughness.

    Instants before the roughness fills the contact do not count, unless the run ends before.

    Returns
    -------
    int or None
        Number of the instant; None without a film of stationary roughness, and where the run does not reach
        the instant at which the surfaces are at their positions in the case.
    """
    if coincident_frame(run) is None:
        return None
    still = float(np.min(run.values("stationary_thickness")))
    nodes = tuple(range(1, run.dataset["thickness"].ndim))
    films = np.min(run.values("thickness"), axis=nodes)
    counted = np.flatnonzero(run.frame_time >= run.field_history.settled_from)
    counted = counted if counted.size else np.arange(run.frames)
    return int(counted[np.argmax(np.abs(films[counted] - still))])


def instant_text(run: MotionRun) -> str:
    """Text: time of the drawn instant, and that stationary roughness is at its position in the case."""
    frame = compared_frame(run)
    assert frame is not None
    factor, unit = time_unit(run)
    return (
        f"at t = {factor * run.frame_time[frame]:.4g} {unit}, where the minimum films differ most; "
        "stationary roughness is at its position in the case"
    )


def _extremes(run: MotionRun, name: str, of: Callable[[Array], Any]) -> list[float]:
    """Extreme of a variable over all nodes: with moving and stationary roughness, and before the motion."""
    frame = compared_frame(run)
    maps = [run.dataset[name].isel(frame=frame), run.dataset[f"stationary_{name}"]]
    maps.append(run.dataset[name].isel(frame=0))
    return [float(of(values.values)) for values in maps]


def _three(
    run: MotionRun,
    ax: Axes | None,
    name: str,
    unit: Unit,
    texts: tuple[str, str, Callable[[Array], Any]],
) -> tuple[Axes, list[Array]]:
    """Draw a variable along entrainment: with moving and stationary roughness, and before the motion.

    ``texts`` has the label of the axis, the name of the extreme value in the legend, and the function that
    computes this value.
    """
    ax, (factor, suffix), (label, kind, extreme) = axes_or_new(ax), unit, texts
    lines = [run.along(name, compared_frame(run)), run.along(f"stationary_{name}"), run.along(name, 0)]
    looks = (
        ("moving", f"{kind} ", BLUE, "-"),
        ("stationary", f"{kind} ", ORANGE, "--"),
        ("before the motion", f"{kind} ", "black", ":"),
    )
    drawn = [factor * line for line in lines]
    extremes = _extremes(run, name, extreme)
    for line, value, (when, what, colour, style) in zip(drawn, extremes, looks, strict=True):
        entry = f"{when}, {what}{factor * value:.3g} {suffix}"
        ax.plot(run.x, line, color=colour, ls=style, lw=1.0, label=entry)
    ax.set_xlim(*shown_range(run))
    ax.set_ylabel(f"{label} [{suffix}]")
    along_label(run, ax)
    legend_above(ax, columns=3)
    return ax, drawn
