"""Units, titles, ranges of axes and stacked panels in the figures of transient contacts."""

from __future__ import annotations

import textwrap

import numpy as np
from matplotlib.axes import Axes

from ehlectric.arrays import Array
from ehlectric.contact import surface_ratios
from ehlectric.figures.style import label_position, name_over
from ehlectric.motion.stored_run import MotionRun
from ehlectric.quantities.units import unit_for
from ehlectric.readable import readable

# By the kind of contact: the smallest number that a film thickness may have in its unit, and the line along
# which values are drawn. Films of point contacts are measured by interferometry and stated in nanometres.
_LEAST_FILM = {"line": 0.1, "point": 1.0}
_ALONG = {"line": "", "point": "on $y$ = 0, "}
Unit = tuple[float, str]


def time_unit(run: MotionRun) -> Unit:
    """Factor from seconds to the unit of times, and this unit."""
    return unit_for(float(run.values("time")[-1]), "s")


def film_unit(run: MotionRun) -> Unit:
    """Factor from metres to the unit of film thicknesses, and this unit."""
    # Rounded, so that a film of 1 nm less the rounding error is not one of 1000 pm.
    first = float(f"{run.values('minimum_thickness')[0]:.3g}")
    return unit_for(first, "m", least=_LEAST_FILM[run.kind.name])


def field_unit(run: MotionRun) -> Unit:
    """Factor from V/m to the unit of field strengths, and this unit."""
    return unit_for(float(np.max(run.values("max_strength"))), "V/m")


def height_unit(heights: Array) -> Unit:
    """Factor from metres to the unit of heights, and this unit; nanometres if all heights are zero."""
    return unit_for(float(np.max(np.abs(heights), initial=1e-9)), "m", least=1.0)


def in_contact(run: MotionRun, values: Array) -> Array:
    """Finite values in the Hertz zone, from values of shape (..., nx).

    If the zone has no finite values, all finite values are returned.
    """
    inside = values[..., np.abs(run.x) <= 1.0]
    finite = inside[np.isfinite(inside)]
    return finite if finite.size else values[np.isfinite(values)]


def fitted(*values: Array, least: float = 0.0) -> tuple[float, float]:
    """Ends of an axis with room around all finite values; they are at least ``least`` apart."""
    low, high = (float(of([of(part) for part in values])) for of in (np.nanmin, np.nanmax))
    room = max(0.08 * (high - low), 0.5 * (least - (high - low)), 1e-3 * max(abs(low), abs(high)))
    return low - room, high + room


def along_label(run: MotionRun, ax: Axes) -> None:
    """Label the axis of positions along entrainment, with the length of the half-width."""
    label_position(run, ax, line=_ALONG[run.kind.name])


def speed_text(run: MotionRun) -> str:
    """Text: speeds of the surfaces, or their common speed, and the numbers of the rough surfaces."""
    mean, slide = run.conditions.entrainment_speed, run.conditions.slide_to_roll_ratio
    rough = " and ".join(str(k) for k in run.speeds)
    what = f"surface {rough} rough" if len(run.speeds) == 1 else f"surfaces {rough} rough"
    if abs(slide) < 2e-9:
        return f"pure rolling at {readable(mean, 4)} m/s, {what}"
    first, second = (readable(mean * ratio, 4).replace("-", "−") for ratio in surface_ratios(slide))
    return f"surface 1 at {first} m/s, surface 2 at {second} m/s, {what}"


def name_run(ax: Axes, run: MotionRun, finding: str = "", more: str = "") -> None:
    """Draw a title: what the figure shows, the title of the case, the speeds, and ``more``.

    Of a run that is not complete, it begins with the time at which the run ends, in red.
    """
    title = textwrap.shorten(str(run.dataset.attrs.get("title", "")), 70, placeholder=" ...")
    lines = [finding, title, speed_text(run), more]
    if not run.complete:
        factor, unit = time_unit(run)
        lines = [f"NOT COMPLETE, ends at {readable(factor * run.values('time')[-1], 4)} {unit}", *lines]
    name_over(ax, "\n".join(filter(None, lines)), converged=run.complete)


def in_unit(value: float, unit: Unit) -> str:
    """Text: an SI value with three digits in a unit.

    Examples
    --------
    >>> in_unit(6.918e-7, (1e6, "µm"))
    '0.692 µm'
    """
    return f"{readable(unit[0] * value)} {unit[1]}"
