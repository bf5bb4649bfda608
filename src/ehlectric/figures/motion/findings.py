"""Findings of the figures of a transient contact, one sentence each."""

from __future__ import annotations

import numpy as np

from ehlectric.arrays import Mask
from ehlectric.contact.spots.warnings import share_text
from ehlectric.figures.motion.panels import field_unit, film_unit, in_unit, time_unit
from ehlectric.motion.asperities import TouchHistory
from ehlectric.motion.field_history import NEAR_MAXIMUM
from ehlectric.motion.stored_run import MotionRun

# A film that differs by less than this part from that of stationary roughness is as thick.
_SAME = 0.005


def of_history(run: MotionRun) -> str:
    """Sentence: minimum film once the roughness fills the contact, compared with stationary roughness.

    Of a run whose surfaces touch, it says how long, and what asperities carry.
    """
    touching = TouchHistory.of(run)
    if touching is not None:
        share = share_text(touching.mean_share, touching.coarser)
        time = f"{100.0 * touching.time_share:.3g} % of the time"
        return f"The surfaces touch {time}, asperities carry {share} % of the load on average"
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
    """Text: how much a minimum film is thinner or thicker than that of stationary roughness.

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
    return (
        f"{100.0 * abs(part):.2g} % {'thinner' if part < 0.0 else 'thicker'} than with stationary roughness"
    )


def of_maps(run: MotionRun) -> str:
    """Sentence: minimum film and maximum field of the run, with the times at which they occur."""
    film, strength = run.values("minimum_thickness"), run.values("max_strength")
    in_time = time_unit(run)
    at_film = in_unit(float(run.values("time")[np.argmin(film)]), in_time)
    at_field = in_unit(float(run.frame_time[np.argmax(strength)]), in_time)
    text = f"Minimum film {in_unit(float(film.min()), film_unit(run))} at t = {at_film}, "
    return text + f"maximum field {in_unit(float(strength.max()), field_unit(run))} at t = {at_field}"


def of_comparison(run: MotionRun, frame: int) -> str:
    """Sentence: minimum film at an instant, compared with that of stationary roughness."""
    unit = film_unit(run)
    moving = float(np.min(run.dataset["thickness"].isel(frame=frame).values))
    still = float(np.min(run.values("stationary_thickness")))
    return f"Minimum film {in_unit(moving, unit)} moving, {thinner(moving, still)} ({in_unit(still, unit)})"
