"""Figures of transient contacts: history, maps over position and time, and moving compared with stationary
roughness.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib import colormaps
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from ehlectric.arrays import Array, Mask
from ehlectric.contact import share_text
from ehlectric.figures.contact_maps import round_levels
from ehlectric.figures.contact_profiles import shown_range
from ehlectric.figures.motion_panels import (
    Unit,
    along_label,
    field_unit,
    film_unit,
    fitted,
    height_unit,
    in_contact,
    in_unit,
    name_run,
    time_unit,
)
from ehlectric.figures.style import (
    axes_or_new,
    drawing_of,
    figure_of,
    fitted_label,
    legend_above,
    new_panels,
    share_below,
)
from ehlectric.figures.style import style as figure_style
from ehlectric.figures.tones import Outline
from ehlectric.motion.motion_touching import TouchHistory
from ehlectric.motion.stored_run import NEAR_MAXIMUM, MotionRun, coincident_frame, intervals_above
from ehlectric.quantities.palette import BLUE, BODY, GREEN, GREY, MAP_EDGE, ON_MAP, ORANGE, OUT_OF_RANGE
from ehlectric.quantities.units import unit_for
from ehlectric.readable import readable

# A film that differs by less than this part from the film of stationary roughness is as thick.
_SAME = 0.005


def of_history(run: MotionRun) -> str:
    """Sentence: minimum film once the roughness fills the contact, compared with stationary roughness.

    Of a run whose surfaces touch, it says how long, and what asperities carry.
    """
    touching = TouchHistory.of(run)
    if touching is not None:
        share = share_text(touching.mean_share, touching.coarser)
        time = f"{readable(100.0 * touching.time_share)} % of the time"
        return f"Asperities are in contact {time}, and carry {share} % of the load on average"
    unit = film_unit(run)
    least = float(run.values("minimum_thickness")[settled_steps(run)].min())
    text = f"Minimum film {in_unit(least, unit)}"
    if "stationary_thickness" not in run.dataset:
        return text
    still = float(np.min(run.values("stationary_thickness")))
    return f"{text}, {thinner(least, still)} ({in_unit(still, unit)})"


def field_line(run: MotionRun) -> str:
    """Line: that the field is always near its maximum, where shading would show nothing; else empty."""
    if not always_near_maximum(run):
        return ""
    level = in_unit(run.field_history.near_maximum, field_unit(run))
    return f"maximum field always above {100.0 * NEAR_MAXIMUM:g} % of its largest value ({level})"


def always_near_maximum(run: MotionRun) -> bool:
    """Whether the field is above 90 % of its maximum all the time that counts."""
    return run.field_history.share_near_maximum > 0.995


def settled_steps(run: MotionRun) -> Mask:
    """Mask of the steps from which the roughness fills the contact; all steps of a run that ends before."""
    late: Mask = run.values("time") >= run.field_history.settled_from
    return late if np.any(late) else np.ones_like(late)


def thinner(moving: float, still: float) -> str:
    """Text: how much a minimum film is thinner or thicker than the minimum film of stationary roughness.

    Examples
    --------
    >>> thinner(0.93, 1.0)
    '7 % thinner than with stationary roughness'
    >>> thinner(1.001, 1.0)
    'as thick as with stationary roughness'
    """
    part = moving / still - 1.0
    if abs(part) < _SAME:
        return "as thick as with stationary roughness"
    more = "thinner" if part < 0.0 else "thicker"
    return f"{readable(100.0 * abs(part), 2)} % {more} than with stationary roughness"


def of_maps(run: MotionRun) -> str:
    """Sentence: minimum film and maximum field of the run, with the times at which they occur."""
    film, strength = run.values("minimum_thickness"), run.values("max_strength")
    in_time = time_unit(run)
    at_film = in_unit(float(run.values("time")[np.argmin(film)]), in_time)
    at_field = in_unit(float(run.frame_time[np.argmax(strength)]), in_time)
    text = f"Minimum film {in_unit(float(film.min()), film_unit(run))} at t = {at_film}, "
    return text + f"maximum field {in_unit(float(strength.max()), field_unit(run))} at t = {at_field}"


def of_comparison(run: MotionRun, frame: int) -> str:
    """Sentence: minimum film at an instant, compared with stationary roughness."""
    unit = film_unit(run)
    moving = float(np.min(run.dataset["thickness"].isel(frame=frame).values))
    still = float(np.min(run.values("stationary_thickness")))
    return f"Minimum film {in_unit(moving, unit)} moving, {thinner(moving, still)} ({in_unit(still, unit)})"


# The film has changed where it differs from the film before the motion by more than this part of its range;
# the time before is not drawn if it is longer than this part of the run.
_CHANGE, _WAITING = 0.02, 0.15

# Distance that counts as another place [half-widths].
_MOVED = 0.02


def least_film(run: MotionRun, ax: Axes | None = None) -> Axes:
    """Draw the minimum film thickness over time, and compare it with stationary roughness."""
    ax = axes_or_new(ax)
    factor, unit = film_unit(run)
    thickness = factor * run.values("minimum_thickness")
    ax.plot(_times(run, "time"), thickness, color=BLUE, lw=0.9, label="at every step")
    before = f"before the motion, {readable(thickness[0])} {unit}"
    ax.axhline(thickness[0], color="black", lw=0.9, ls=":", label=before)
    shown = [thickness]
    if "stationary_thickness" in run.dataset:
        still = factor * float(np.min(run.values("stationary_thickness")))
        ax.axhline(
            still, color=ORANGE, lw=0.9, ls="--", label=f"stationary roughness, {readable(still)} {unit}"
        )
        shown.append(np.array([still]))
    ax.set(ylabel=rf"minimum film $h_\mathrm{{min}}$ [{unit}]", ylim=fitted(*shown))
    _over_time(run, ax)
    legend_above(ax)
    return ax


def largest_field(run: MotionRun, ax: Axes | None = None) -> Axes:
    """Draw the largest field strength over time, with its value for stationary roughness. Returns axes over
    time, with the voltage divided by the minimum film thickness at every step.
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
    handles: list[Any] = [dots, thin]
    shown = [strength, estimate]
    if not always_near_maximum(run):
        handles.append(_high(run, ax))
    if "stationary_strength" in run.dataset:
        still = factor * float(np.nanmax(run.values("stationary_strength")))
        label = f"stationary roughness, {readable(still)} {unit}"
        handles.append(ax.axhline(still, color=ORANGE, lw=0.9, ls="--", label=label))
        shown.append(np.array([still]))
    ax.set(ylabel=rf"maximum field $|E|$ [{unit}]", ylim=fitted(*shown))
    _over_time(run, ax)
    legend_above(ax, handles)
    return ax


def _high(run: MotionRun, ax: Axes) -> tuple[Artist, Artist]:
    """Draw the level above which the field is near its maximum, and shade the time above it. Returns both for
    one entry of the legend.
    """
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
    text += f" from {readable(in_time * settled)} {unit} on" if settled else ""
    line = ax.axhline(factor * level, color=GREEN, lw=0.9, ls="--", label=text)
    return Patch(facecolor=(GREEN, 0.25)), line


def asperities(run: MotionRun, ax: Axes | None = None) -> Axes:
    """Draw the shares of asperities in the load and of the real contact in the Hertz zone over time."""
    ax = axes_or_new(ax)
    touching = TouchHistory.of(run)
    assert touching is not None
    time, load, area = _times(run, "time"), 100.0 * touching.load_share, 100.0 * touching.area_share
    touch = f"{readable(100.0 * touching.time_share)} % of {touching.steps} time steps"
    share = share_text(touching.mean_share, touching.coarser)
    ax.plot(time, load, color=BLUE, lw=0.9, label=f"load of asperities, mean {share} %")
    ax.plot(time, area, color=ORANGE, lw=0.9, label=f"real contact area, contact at {touch}")
    ax.set(ylabel="share [%]", ylim=fitted(load, area))
    _over_time(run, ax)
    legend_above(ax)
    return ax


def places(run: MotionRun, ax: Axes | None = None) -> Axes:
    """Draw where the field is strongest and where the film is thinnest over time. Returns axes over time; for
    a point contact also with the position across entrainment.
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
    left_out = f", film unchanged before {readable(factor * start)} {unit}" if start else ""
    end = factor * float(run.values("time")[-1]) or 1.0
    ax.set(xlabel=f"time $t$ [{unit}]{left_out}", xlim=(factor * start, end))
    if settled := run.field_history.settled_from:
        covered = factor * settled
        label = f"contact covered from {readable(covered)} {unit} on"
        ax.axvline(covered, color="black", lw=0.7, ls=(0, (6.0, 3.0)), label=label)


# The maps show x from -1.5 to 1.5 [half-widths]: beyond it the field is not solved, or changes little.
_REACH = 1.5

# Times at which the lines of the speeds cross x = 0, over the duration of the run.
_CROSSINGS = (0.35, 0.75)

# Part of the values in the Hertz zone that may lie beyond the open end of the colour bar [per cent].
_BEYOND = 5.0
_SIZE = (7.2, 5.4)


def film_map(run: MotionRun, ax: Axes | None = None) -> Axes:
    """Draw the film thickness over position and time. Returns axes with a colour bar that fits the Hertz
    zone; thicker films, as in the inlet, are grey.
    """
    factor, unit = film_unit(run)
    values = factor * run.along("thickness")
    inside = in_contact(run, values)
    limits = (float(np.min(inside)), float(np.percentile(inside, 100.0 - _BEYOND)))
    label = f"film thickness $h$ [{unit}]"
    return _map(run, values, ax, label=label, limits=limits, colours="viridis", extend="max")


def pressure_map(run: MotionRun, ax: Axes | None = None) -> Axes:
    """Draw the pressure over position and time. Returns axes with a colour bar up to the largest pressure."""
    values = run.along("pressure")
    factor, unit = unit_for(float(np.max(values)), "Pa")
    limits = (0.0, factor * float(np.max(values)))
    label = f"pressure $p$ [{unit}]"
    return _map(run, factor * values, ax, label=label, limits=limits, colours="magma", extend="neither")


def field_map(run: MotionRun, ax: Axes | None = None) -> Axes:
    """Draw the largest field strength across the film over position and time. Returns axes with a colour bar
    that fits the Hertz zone; weaker fields are grey, and light grey where the field was not solved.
    """
    factor, unit = field_unit(run)
    values = factor * run.along("strength")
    inside = in_contact(run, values)
    limits = (float(np.percentile(inside, _BEYOND)), float(np.nanmax(values)))
    label = f"field strength $|E|$ [{unit}]"
    return _map(run, values, ax, label=label, limits=limits, colours="inferno", extend="min")


def map_figure(run: MotionRun) -> Axes:
    """Draw film, pressure and field over position and time side by side, with lines of the speeds. ``run``,
    run with at least two recorded instants. Returns first of the three panels.
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
    figure_of(ax).colorbar(
        mesh,
        ax=ax,
        location="bottom",
        label=fitted_label(ax, label, along=True),
        ticks=ticks,
        extend=extend,
        pad=0.02,
    )
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
    edge = [Outline(1.8, MAP_EDGE, 0.6)]
    plain: dict[str, Any] = {"color": ON_MAP, "lw": 0.8, "path_effects": edge}
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
    travel = f"{readable(factor * fastest * apart)} {unit}"
    return f"{run.frames} recorded instants, at most {travel} of travel between two of them"


def compared_film(run: MotionRun, ax: Axes | None = None) -> Axes:
    """Draw the film thickness with moving and with stationary roughness, and before the motion. Returns axes
    whose range fits the film in the Hertz zone; outside the zone the film is thicker.
    """
    ax, lines = _three(run, ax, "thickness", film_unit(run), ("film thickness $h$", "min.", np.nanmin))
    ax.set_ylim(*fitted(*(in_contact(run, line) for line in lines)))
    return ax


def compared_pressure(run: MotionRun, ax: Axes | None = None) -> Axes:
    """Draw the pressure with moving and with stationary roughness, and before the motion. Returns axes whose
    range begins at zero pressure.
    """
    unit = unit_for(max(_extremes(run, "pressure", np.nanmax)), "Pa")
    ax, lines = _three(run, ax, "pressure", unit, ("pressure $p$", "max.", np.nanmax))
    ax.set_ylim(0.0, 1.06 * max(float(np.max(line)) for line in lines))
    return ax


def compared_field(run: MotionRun, ax: Axes | None = None) -> Axes:
    """Draw the field strength with moving and with stationary roughness, and before the motion. Returns axes
    whose range fits the field in the Hertz zone; outside the zone the field is smaller.
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

    ``stationary``, number of the instant at which the surfaces are where stationary roughness is, to draw
    them as well. Returns axes with the range of x of the axes of the film; peaks of both surfaces point up.
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
    ax.set(xlim=shown_range(run.x), ylabel=f"roughness [{name}]")
    along_label(run, ax)
    legend_above(ax)
    return ax


def compared_frame(run: MotionRun) -> int | None:
    """Recorded instant whose minimum film differs most from the minimum film of stationary roughness.

    Instants before the roughness fills the contact do not count, unless the run ends before.

    Returns number of the instant; None without a film of stationary roughness, and where the run does not
    reach the instant at which the surfaces are at their positions in the case.
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
        f"at t = {readable(factor * run.frame_time[frame], 4)} {unit}, where the minimum films differ most; "
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
    looks = (("moving", BLUE, "-"), ("stationary", ORANGE, "--"), ("before the motion", "black", ":"))
    drawn = [factor * line for line in lines]
    extremes = _extremes(run, name, extreme)
    for line, value, (when, colour, style) in zip(drawn, extremes, looks, strict=True):
        entry = f"{when}, {kind} {readable(factor * value)} {suffix}"
        ax.plot(run.x, line, color=colour, ls=style, lw=1.0, label=entry)
    ax.set_xlim(*shown_range(run.x))
    ax.set_ylabel(f"{label} [{suffix}]")
    along_label(run, ax)
    legend_above(ax, columns=3)
    return ax, drawn


# Width of stacked panels, height of each of them, and height of the title above them [inches].
_WIDTH, _HEIGHT, _TITLE = 7.2, 2.1, 0.75


def history(run: MotionRun) -> Axes:
    """Draw minimum film thickness, maximum field strength and their places over time, and asperities. Returns
    the first of three panels, or of two where the places do not change; one more where surfaces touch.
    """
    touching = (asperities,) if TouchHistory.of(run) is not None else ()
    panels = (least_film, *touching, largest_field, *((places,) if places_vary(run) else ()))
    axes = _stack(len(panels))
    for draw, ax in zip(panels, axes, strict=True):
        draw(run, ax)
    share_below(axes)
    name_run(axes[0], run, of_history(run), field_line(run))
    return axes[0]


def maps(run: MotionRun) -> Axes:
    """Draw film, pressure and field over position and time. ``run``, a run with at least two recorded
    instants. Returns the first of three panels.
    """
    ax = map_figure(run)
    name_run(ax, run, of_maps(run), sampling_text(run))
    return ax


def comparison_with_stationary(run: MotionRun) -> Axes:
    """Compare moving with stationary roughness at the instant of the largest difference in minimum film.
    Returns the first of four panels: film, pressure, field and roughness.
    """
    axes = _stack(4)
    for draw, ax in zip((compared_film, compared_pressure, compared_field), axes[:3], strict=True):
        draw(run, ax)
    frame = compared_frame(run)
    assert frame is not None
    roughness_at(run, frame, axes[3], stationary=coincident_frame(run))
    share_below(axes)
    name_run(axes[0], run, of_comparison(run, frame), instant_text(run))
    return axes[0]


FIGURES: Mapping[str, Callable[[MotionRun], Axes]] = {
    "motion_history.png": history,
    "motion_maps.png": maps,
    "motion_beside_stationary.png": comparison_with_stationary,
}


def drawings_of(run: MotionRun) -> dict[str, Callable[[MotionRun], Axes]]:
    """Functions that draw the figures of a transient run, by the names of their files.

    There are no maps where a single instant is recorded, and no comparison with stationary roughness where
    its film is missing or the surfaces never lie where the case puts them.
    """
    empty = [maps] if run.frames < 2 else []
    empty += [comparison_with_stationary] if coincident_frame(run) is None else []
    return {name: draw for name, draw in FIGURES.items() if draw not in empty}


def figure(run: MotionRun, name: str) -> Figure:
    """Figure of a transient run. Raises InputError where the run has no figure of this name."""
    draw = drawing_of(drawings_of(run), name)
    with figure_style():
        return figure_of(draw(run))


def _stack(panels: int) -> Sequence[Axes]:
    """Axes of panels below each other."""
    return new_panels(panels, 1, (_WIDTH, _HEIGHT * panels + _TITLE))
