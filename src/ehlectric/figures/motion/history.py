"""History of a transient contact: smallest film, largest field strength and their positions over time."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D

from ehlectric.arrays import Array
from ehlectric.contact.spots.warnings import share_text
from ehlectric.figures.motion.findings import always_near_maximum
from ehlectric.figures.motion.panels import field_unit, film_unit, fitted, time_unit
from ehlectric.figures.style import axes_or_new, legend_above
from ehlectric.motion.asperities import TouchHistory
from ehlectric.motion.field_history import NEAR_MAXIMUM, intervals_above
from ehlectric.motion.stored_run import MotionRun
from ehlectric.quantities.palette import BLUE, GREEN, GREY, ORANGE

# The film has changed where it differs from that before the motion by more than this part of its range; the
# time before is left out if it is longer than this part of the run.
_CHANGE, _WAITING = 0.02, 0.15

# Distance that counts as another place [half-widths].
_MOVED = 0.02


def least_film(run: MotionRun, ax: Axes | None = None) -> Axes:
    """Draw the minimum film thickness over time, and compare it with stationary roughness.

    Parameters
    ----------
    run : MotionRun
        Run to draw.
    ax : Axes, optional
        Axes to draw on; axes of a new figure if omitted.

    Returns
    -------
    Axes
        Axes over time. Horizontal lines show the value before the motion, and with stationary roughness.
    """
    ax = axes_or_new(ax)
    factor, unit = film_unit(run)
    thickness = factor * run.values("minimum_thickness")
    ax.plot(_times(run, "time"), thickness, color=BLUE, lw=0.9, label="at every step")
    before = f"before the motion, {thickness[0]:.3g} {unit}"
    ax.axhline(thickness[0], color="black", lw=0.9, ls=":", label=before)
    shown = [thickness]
    if "stationary_thickness" in run.dataset:
        still = factor * float(np.min(run.values("stationary_thickness")))
        ax.axhline(still, color=ORANGE, lw=0.9, ls="--", label=f"stationary roughness, {still:.3g} {unit}")
        shown.append(np.array([still]))
    ax.set(ylabel=rf"minimum film $h_\mathrm{{min}}$ [{unit}]", ylim=fitted(*shown))
    _over_time(run, ax)
    legend_above(ax)
    return ax


def largest_field(run: MotionRun, ax: Axes | None = None) -> Axes:
    """Draw the largest field strength over time, with its value for stationary roughness.

    Parameters
    ----------
    run : MotionRun
        Run to draw.
    ax : Axes, optional
        Axes to draw on; axes of a new figure if omitted.

    Returns
    -------
    Axes
        Axes over time, with the voltage divided by the minimum film thickness at every step. Times at which
        the field is above 90 % of its maximum are shaded (see ``FieldHistory``), unless they are all times.
    """
    ax = axes_or_new(ax)
    factor, unit = field_unit(run)
    strength = factor * run.values("max_strength")
    estimate = factor * run.values("thin_gap_strength")
    (thin,) = ax.plot(_times(run, "time"), estimate, color=GREY, lw=0.6)
    thin.set_label(r"$V_{12}/h_\mathrm{min}$ at every step")
    # Dots, because a line between few instants would show values that were not computed.
    size = 2.4 if run.frames <= 400 else 1.4
    (dots,) = ax.plot(
        _times(run, "frame_time"), strength, color=BLUE, ls="none", marker="o", ms=size, mew=0.0
    )
    dots.set_label(f"solved at {run.frames} instants")
    handles, shown = [dots, thin], [strength, estimate]
    if not always_near_maximum(run):
        handles.append(_high(run, ax))
    if "stationary_strength" in run.dataset:
        still = factor * float(np.nanmax(run.values("stationary_strength")))
        label = f"stationary roughness, {still:.3g} {unit}"
        handles.append(ax.axhline(still, color=ORANGE, lw=0.9, ls="--", label=label))
        shown.append(np.array([still]))
    ax.set(ylabel=rf"maximum field $|E|$ [{unit}]", ylim=fitted(*shown))
    _over_time(run, ax)
    legend_above(ax, handles)
    return ax


def _high(run: MotionRun, ax: Axes) -> Line2D:
    """Draw the level above which the field is near its maximum, and shade the time above it."""
    factor, _ = field_unit(run)
    in_time, unit = time_unit(run)
    history = run.field_history
    level = history.near_maximum
    spans = intervals_above(history.time, history.strength, level)
    bars = [(in_time * start, in_time * (end - start)) for start, end in spans]
    whole = ax.get_xaxis_transform()
    ax.broken_barh(bars, (0.0, 1.0), transform=whole, color=GREEN, alpha=0.25, lw=0.0, zorder=0.5)
    settled, share = history.settled_from, 100.0 * history.share_near_maximum
    text = f"{100.0 * NEAR_MAXIMUM:g} % of the maximum: above it {share:.0f} % of the time"
    text += f" from {in_time * settled:.3g} {unit} on" if settled else ""
    return ax.axhline(factor * level, color=GREEN, lw=0.9, ls="--", label=text)


def asperities(run: MotionRun, ax: Axes | None = None) -> Axes:
    """Draw the shares of asperities in the load and of the real contact in the Hertz zone over time.

    Parameters
    ----------
    run : MotionRun
        Run to draw, whose surfaces touch at one time step or more.
    ax : Axes, optional
        Axes to draw on; axes of a new figure if omitted.

    Returns
    -------
    Axes
        Axes over time. The legend states the mean load share, and for which share of the time steps the
        surfaces touch.
    """
    ax = axes_or_new(ax)
    found = TouchHistory.of(run)
    assert found is not None
    time, load, area = _times(run, "time"), 100.0 * found.load_share, 100.0 * found.area_share
    touch = f"{100.0 * found.time_share:.3g} % of {found.steps} time steps"
    share = share_text(found.mean_share, found.coarser)
    ax.plot(time, load, color=BLUE, lw=0.9, label=f"load of asperities, mean {share} %")
    ax.plot(time, area, color=ORANGE, lw=0.9, label=f"real contact area, touching at {touch}")
    ax.set(ylabel="share [%]", ylim=fitted(load, area))
    _over_time(run, ax)
    legend_above(ax)
    return ax


def places(run: MotionRun, ax: Axes | None = None) -> Axes:
    """Draw where the field is strongest and where the film is thinnest over time.

    Parameters
    ----------
    run : MotionRun
        Run to draw.
    ax : Axes, optional
        Axes to draw on; axes of a new figure if omitted.

    Returns
    -------
    Axes
        Axes over time; for a point contact also with the position across entrainment.
    """
    ax = axes_or_new(ax)
    b = run.conditions.half_width
    time, frames = _times(run, "time"), _times(run, "frame_time")
    least = run.values("minimum_x") / b
    ax.plot(time, least, color=GREY, ls="none", marker="o", ms=1.0, mew=0.0)
    largest = run.values("max_strength_x") / b
    ax.plot(frames, largest, color=BLUE, ls="none", marker="o", ms=2.4, mew=0.0, label="maximum field")
    # A dotted line stands for the dots in the legend, where they would be too small.
    ax.plot([], [], color=GREY, ls=":", label="minimum film, every step")
    name, shown = "$x/b$", [least, largest]
    if "max_strength_y" in run.dataset:
        across = np.abs(run.values("max_strength_y")) / b
        ax.plot(frames, across, color=ORANGE, ls="none", marker="x", ms=3.0, label="maximum field, $|y|/b$")
        name, shown = "$x/b$, $|y|/b$", [*shown, across]
    ax.set(ylabel=f"place {name}", ylim=fitted(*shown, least=0.5))
    legend_above(ax, columns=3)
    _over_time(run, ax)
    return ax


def waiting_time(run: MotionRun) -> float:
    """Time in which the roughness approaches and the minimum film does not change [s]; 0 if it is short.

    A twentieth of the run is left of it, so that the film before the motion is seen.
    """
    time, film = run.values("time"), run.values("minimum_thickness")
    changed = np.flatnonzero(np.abs(film - film[0]) > _CHANGE * np.ptp(film))
    if not changed.size:
        return 0.0
    waited = float(time[changed[0]]) - 0.05 * float(time[-1])
    return waited if waited > _WAITING * float(time[-1]) else 0.0


def places_vary(run: MotionRun) -> bool:
    """Whether the place of the maximum field or the minimum film varies by a fiftieth of the half-width."""
    b = run.conditions.half_width
    names = [name for name in ("minimum_x", "max_strength_x", "max_strength_y") if name in run.dataset]
    return any(float(np.ptp(run.values(name))) > _MOVED * b for name in names)


def _times(run: MotionRun, name: str) -> Array:
    factor, _ = time_unit(run)
    return factor * run.values(name)


def _over_time(run: MotionRun, ax: Axes) -> None:
    """Label the axis of time, and mark the time from which the roughness fills the contact."""
    factor, unit = time_unit(run)
    start = waiting_time(run)
    left_out = f", film unchanged before {factor * start:.3g} {unit}" if start else ""
    end = factor * float(run.values("time")[-1]) or 1.0
    ax.set(xlabel=f"time $t$ [{unit}]{left_out}", xlim=(factor * start, end))
    if settled := run.field_history.settled_from:
        covered = factor * settled
        label = f"contact covered from {covered:.3g} {unit} on"
        ax.axvline(covered, color="black", lw=0.7, ls=(0, (6.0, 3.0)), label=label)
