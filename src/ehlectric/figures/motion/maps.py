"""Maps of a transient contact over position and time: film, pressure and field along entrainment."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib import colormaps
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.patheffects import withStroke

from ehlectric.arrays import Array
from ehlectric.figures.contact.maps import round_levels
from ehlectric.figures.motion.panels import along_label, field_unit, film_unit, in_contact, time_unit
from ehlectric.figures.style import axes_or_new, figure_of, new_panels
from ehlectric.motion.stored_run import MotionRun
from ehlectric.quantities.palette import BODY, OUT_OF_RANGE
from ehlectric.quantities.units import unit_for

# The maps show x from -1.5 to 1.5 [half-widths]: beyond it the field is not solved, or hardly changes.
_REACH = 1.5

# Times at which the lines of the speeds cross x = 0, over the duration of the run.
_CROSSINGS = (0.35, 0.75)

# Part of the values in the Hertz zone that may lie beyond the open end of the colour bar [per cent].
_BEYOND = 5.0
_SIZE = (7.2, 5.4)


def film_map(run: MotionRun, ax: Axes | None = None) -> Axes:
    """Draw the film thickness over position and time.

    Parameters
    ----------
    run : MotionRun
        Run to draw.
    ax : Axes, optional
        Axes to draw on; axes of a new figure if omitted.

    Returns
    -------
    Axes
        Axes with a colour bar that fits the Hertz zone; thicker films, as in the inlet, are grey.
    """
    factor, unit = film_unit(run)
    values = factor * run.along("thickness")
    inside = in_contact(run, values)
    limits = (float(np.min(inside)), float(np.percentile(inside, 100.0 - _BEYOND)))
    label = f"film thickness $h$ [{unit}]"
    return _map(run, values, ax, label=label, limits=limits, colours="viridis", extend="max")


def pressure_map(run: MotionRun, ax: Axes | None = None) -> Axes:
    """Draw the pressure over position and time.

    Parameters
    ----------
    run : MotionRun
        Run to draw.
    ax : Axes, optional
        Axes to draw on; axes of a new figure if omitted.

    Returns
    -------
    Axes
        Axes with a colour bar up to the largest pressure.
    """
    values = run.along("pressure")
    factor, unit = unit_for(float(np.max(values)), "Pa")
    limits = (0.0, factor * float(np.max(values)))
    label = f"pressure $p$ [{unit}]"
    return _map(run, factor * values, ax, label=label, limits=limits, colours="magma", extend="neither")


def field_map(run: MotionRun, ax: Axes | None = None) -> Axes:
    """Draw the largest field strength across the film over position and time.

    Parameters
    ----------
    run : MotionRun
        Run to draw.
    ax : Axes, optional
        Axes to draw on; axes of a new figure if omitted.

    Returns
    -------
    Axes
        Axes with a colour bar that fits the Hertz zone; weaker fields are grey, and light grey where the
        field was not solved.
    """
    factor, unit = field_unit(run)
    values = factor * run.along("strength")
    inside = in_contact(run, values)
    limits = (float(np.percentile(inside, _BEYOND)), float(np.nanmax(values)))
    label = f"field strength $|E|$ [{unit}]"
    return _map(run, values, ax, label=label, limits=limits, colours="inferno", extend="min")


def map_figure(run: MotionRun) -> Axes:
    """Draw film, pressure and field over position and time side by side, with lines of the speeds.

    Parameters
    ----------
    run : MotionRun
        Run with at least two recorded instants.

    Returns
    -------
    Axes
        First of the three panels.
    """
    axes = new_panels(1, 3, _SIZE)
    for draw, ax in zip((film_map, pressure_map, field_map), axes, strict=True):
        draw(run, ax)
    for ax in axes[1:]:
        ax.set_ylabel("")
        ax.tick_params(labelleft=False)
    for ax in axes[::2]:
        ax.set_xlabel("$x/b$")
    figure_of(axes[0]).legend(handles=_handles(run), loc="outside lower left", ncols=4, frameon=False)
    return axes[0]


def _map(
    run: MotionRun,
    values: Array,
    ax: Axes | None,
    *,
    label: str,
    limits: tuple[float, float],
    colours: str,
    extend: str,
) -> Axes:
    """Draw values, shape (frames, nx), as colours, with the axis of time pointing up."""
    ax = axes_or_new(ax)
    factor, unit = time_unit(run)
    shown = np.flatnonzero(np.abs(run.x) <= _REACH)
    ax.set_facecolor(BODY)
    mesh = ax.pcolormesh(
        run.x[shown],
        factor * run.frame_time,
        np.ma.masked_invalid(values[:, shown]),
        shading="nearest",
        cmap=colormaps[colours].with_extremes(under=OUT_OF_RANGE, over=OUT_OF_RANGE),
        vmin=limits[0],
        vmax=limits[1],
        rasterized=True,
    )
    times = factor * run.frame_time
    ax.set(ylabel=f"time $t$ [{unit}]", xlim=run.x[shown[[0, -1]]], ylim=(times[0], times[-1]))
    along_label(run, ax)
    ticks = round_levels(*limits, 5)
    ticks = ticks[(ticks >= limits[0]) & (ticks <= limits[1])]
    figure_of(ax).colorbar(mesh, ax=ax, location="bottom", label=label, ticks=ticks, extend=extend, pad=0.02)
    for speed, look in _speeds(run):
        for part in _CROSSINGS:
            at = part * factor * run.frame_time[-1]
            # Time per half-width of travel; the line of a surface at rest is vertical.
            slope = np.inf if speed == 0.0 else factor * run.conditions.half_width / speed
            ax.axline((0.0, at), slope=slope, **look)
    return ax


def _speeds(run: MotionRun) -> list[tuple[float, dict[str, Any]]]:
    """Mean speed, and speeds of rough surfaces that differ from it [m/s], with the styles of their lines."""
    mean = run.conditions.entrainment_speed
    edge = [withStroke(linewidth=1.8, foreground="black", alpha=0.6)]
    plain: dict[str, Any] = {"color": "white", "lw": 0.8, "path_effects": edge}
    same = [k for k, speed in run.speeds.items() if abs(speed - mean) <= 1e-9 * mean]
    name = ", also of both surfaces" if len(same) == 2 else f", also of surface {same[0]}" if same else ""
    speeds = [(mean, {"ls": "--", "label": f"mean speed{name}", **plain})]
    looks = {1: "-", 2: ":"}
    for k, speed in run.speeds.items():
        if k not in same:
            speeds.append((speed, {"ls": looks[k], "label": f"speed of surface {k}", **plain}))
    return speeds


def _handles(run: MotionRun) -> list[Artist]:
    """Entries of the legend, in colours that are visible on white."""
    handles: list[Artist] = [
        Line2D([], [], color="black", lw=0.9, ls=look["ls"], label=look["label"]) for _, look in _speeds(run)
    ]
    strength = run.along("strength", 0)[np.abs(run.x) <= _REACH]
    if not np.all(np.isfinite(strength)):
        handles.append(Patch(facecolor=BODY, label="field not solved"))
    handles.append(Patch(facecolor=OUT_OF_RANGE, label="outside the colour bar"))
    return handles


def sampling_text(run: MotionRun) -> str:
    """Text: number of recorded instants, and distance travelled between two, which blurs short waves."""
    apart = float(np.max(np.diff(run.frame_time)))
    fastest = max(run.conditions.entrainment_speed, *(abs(speed) for speed in run.speeds.values()))
    factor, unit = unit_for(fastest * apart, "m", least=1.0)
    travel = f"{factor * fastest * apart:.3g} {unit}"
    return f"{run.frames} recorded instants, at most {travel} of travel between two of them"
