"""What the figures of roughness that moves share: units, titles, panels below each other, ranges."""

from __future__ import annotations

import textwrap
from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes

from ehlectric.arrays import Array
from ehlectric.cases.quantity import unit_for
from ehlectric.contact.bodies import surface_ratios
from ehlectric.figures.style import figure_of, name_over
from ehlectric.motion.record import MotionRun

# Shown of the domain, in half-widths: around the contact, as in the figures of one at rest.
_BEFORE, _BEHIND = -2.0, 1.5

# Smallest value of a film thickness that is drawn in a unit, and the line along which maps are drawn, by the
# kind of contact: films of interferograms are in nanometres.
_LEAST_FILM = {"line": 0.1, "point": 1.0}
_ALONG = {"line": "", "point": "on $y$ = 0, "}
Unit = tuple[float, str]


def time_unit(run: MotionRun) -> Unit:
    """Factor and unit of times."""
    return unit_for(float(run.values("time")[-1]), "s")


def film_unit(run: MotionRun) -> Unit:
    """Factor and unit of film thicknesses; those of interferograms are in nanometres."""
    return unit_for(float(run.values("minimum_thickness")[0]), "m", least=_LEAST_FILM[run.kind.name])


def field_unit(run: MotionRun) -> Unit:
    """Factor and unit of field strengths."""
    return unit_for(float(np.max(run.values("max_strength"))), "V/m")


def height_unit(heights: Array) -> Unit:
    """Factor and unit of heights of roughness, in nanometres where there are none."""
    return unit_for(float(np.max(np.abs(heights), initial=1e-9)), "m", least=1.0)


def shown_range(run: MotionRun) -> tuple[float, float]:
    """Ends of an axis of x in half-widths, within the domain."""
    return max(float(run.x[0]), _BEFORE), min(float(run.x[-1]), _BEHIND)


def in_contact(run: MotionRun, values: Array) -> Array:
    """Those of values (..., nx) that are finite in the Hertz zone, or anywhere where none are there."""
    inside = values[..., np.abs(run.x) <= 1.0]
    found = inside[np.isfinite(inside)]
    return found if found.size else values[np.isfinite(values)]


def fitted(*values: Array, least: float = 0.0) -> tuple[float, float]:
    """Ends of an axis, at least so far apart, that leave room around values, those that are finite."""
    low, high = (float(of([of(part) for part in values])) for of in (np.nanmin, np.nanmax))
    room = max(0.08 * (high - low), 0.5 * (least - (high - low)), 1e-3 * max(abs(low), abs(high)))
    return low - room, high + room


def along_label(run: MotionRun, ax: Axes) -> None:
    """Label of an axis of positions along entrainment: on which line, and how long the half-width is."""
    b = run.conditions.half_width
    factor, unit = unit_for(b, "m", least=1.0)
    line = _ALONG[run.kind.name]
    ax.set_xlabel(f"$x/b$   ({line}$b$ = {factor * b:.4g} {unit})")


def share_below(axes: Sequence[Axes]) -> None:
    """Panels below each other have the label of their common axis once."""
    for ax in axes[:-1]:
        ax.set_xlabel("")
        ax.tick_params(labelbottom=False)
    figure_of(axes[0]).align_ylabels(axes)


def speed_text(run: MotionRun) -> str:
    """How fast the surfaces move, and which of them are rough.

    Surfaces at one speed are said together.
    """
    mean, slide = run.conditions.entrainment_speed, run.conditions.slide_to_roll_ratio
    rough = " and ".join(str(k) for k in run.speeds)
    what = f"surface {rough} rough" if len(run.speeds) == 1 else f"surfaces {rough} rough"
    if abs(slide) < 2e-9:
        return f"pure rolling at {mean:.4g} m/s, {what}"
    first, second = (f"{mean * ratio:.4g}".replace("-", "−") for ratio in surface_ratios(slide))
    return f"surface 1 at {first} m/s, surface 2 at {second} m/s, {what}"


def name_run(ax: Axes, run: MotionRun, more: str = "") -> None:
    """Title over all panels: of the case, and how its surfaces move; in red where it stopped on its way."""
    title = textwrap.shorten(str(run.dataset.attrs.get("title", "")), 70, placeholder=" ...")
    if not run.complete:
        factor, unit = time_unit(run)
        title = f"NOT COMPLETE, ends at {factor * run.values('time')[-1]:.4g} {unit}\n{title}".rstrip()
    name_over(ax, "\n".join(filter(None, [title, speed_text(run), more])), converged=run.complete)
