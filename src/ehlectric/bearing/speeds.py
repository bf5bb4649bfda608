"""Bearing at several shaft speeds, without solving its contacts."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from ehlectric.bearing.margin.critical_speed import LEAST, MOST
from ehlectric.bearing.over_speed import Speed
from ehlectric.bearing.quick.ways import quick_case
from ehlectric.bearing.solution import CONDUCTING
from ehlectric.bearing.solving.contacts_and_circuit import solution_of
from ehlectric.bearing.summary import summary_of
from ehlectric.cases.bearings.case import BearingCase
from ehlectric.errors import InputError, ResultWarning
from ehlectric.quantities.units import rpm

# Number of speeds in a geometric series.
COUNT = 9

# Logarithm of the lambda ratio that is looked for where surfaces part, and how often it is.
_ABOVE, _TRIES = 1e-3, 4


def over_speed(case: BearingCase, count: int = COUNT) -> tuple[list[Speed], list[ResultWarning]]:
    """Summaries of a bearing at speeds around that of its case, with contacts from the atlas.

    Parameters
    ----------
    case : BearingCase
        Case of the bearing, whose contacts stay by formula where they are. The temperature is the same at
        all speeds.
    count : int
        Number of speeds, from a tenth of the case's speed to four times this speed.

    Returns
    -------
    points : list of (float, dict)
        Speeds of the inner ring [rad/s] with their summaries, in increasing order. Where the lambda ratio
        rises through 1 between two of them, one more lies there: the lowest speed that has voltages.
    left_out : list of ResultWarning
        Warnings of what could not be computed, and why: single speeds, breakdown voltages, or everything.

    Examples
    --------
    The capacitance falls with the speed, because the films become thicker:

    >>> case = BearingCase.from_dict(
    ...     {
    ...         "bearing": {
    ...             "base": "6208", "radial_clearance": "10 um", "element_material": "steel",
    ...             "ring_material": "steel", "radial_load": "1 kN", "inner_speed": "1000 rpm",
    ...             "temperature": "70 degC", "composite_rq": "0.03 um", "fill": "oil", "film_factor": "none",
    ...         },
    ...         "lubricant": {"base": "paper", "viscosity": "20 mPa s"},
    ...     }
    ... )
    >>> points, left_out = over_speed(case, count=2)
    >>> slow, fast = points[0][1]["bearing"], points[-1][1]["bearing"]
    >>> slow["capacitance"] > fast["capacitance"], left_out
    (True, [])
    """
    changed, refused = quick_case(case)
    left_out = []
    if refused is not None:
        text = f"figures over speed are incomplete: {refused}"
        left_out.append(ResultWarning("speed-left-out", text))
    if changed is None:
        return [], left_out
    points = []
    for part in np.geomspace(LEAST, MOST, count):
        speed = case.bearing.inner_speed * float(part)
        try:
            points.append(_point(changed, speed))
        except InputError as error:
            text = f"figures over speed leave out {rpm(speed):.4g} rpm: {error}"
            left_out.append(ResultWarning("speed-left-out", text))
    touch = [k for k, (_, summary) in enumerate(points) if _is_conducting(summary)]
    if touch and touch[-1] + 1 < len(points):
        low, high = points[touch[-1] : touch[-1] + 2]
        parted = _parted(changed, low, high)
        points[touch[-1] + 1 : touch[-1] + 1] = [] if parted is None else [parted]
    return points, left_out


def _point(case: BearingCase, speed: float) -> Speed:
    """Speed [rad/s] with the summary of a bearing at it."""
    return speed, summary_of(solution_of(case.replace({"bearing.inner_speed": speed})))


def _is_conducting(summary: dict[str, Any]) -> bool:
    """Whether the surfaces touch, so that no voltage is computed."""
    return bool(summary["bearing"]["lubrication"] == "conducting")


def _parted(case: BearingCase, low: Speed, high: Speed) -> Speed | None:
    """Point just above a lambda ratio of 1 between two speeds on either side of it; None where not found.

    Between two speeds the lambda ratio is nearly a power of the speed.
    """
    for _ in range(_TRIES):
        ratios = [math.log(summary["bearing"]["lambda_ratio"] / CONDUCTING) for _, summary in (low, high)]
        part = (_ABOVE - ratios[0]) / (ratios[1] - ratios[0])
        found = _point(case, low[0] * (high[0] / low[0]) ** part)
        if not _is_conducting(found[1]):
            return found
        low = found
    return None
