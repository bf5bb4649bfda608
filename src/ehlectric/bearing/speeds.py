"""Bearing at several shaft speeds, with contacts by formula."""

from __future__ import annotations

from typing import Any

import numpy as np

from ehlectric.bearing.by_formula import formula_case
from ehlectric.bearing.margin.critical_speed import LEAST, MOST
from ehlectric.bearing.solving.contacts_and_circuit import solution_of
from ehlectric.bearing.summary import summary_of
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.cases.units import rpm
from ehlectric.errors import InputError, ResultWarning

# Number of speeds in a geometric series.
COUNT = 9


def over_speed(
    case: BearingCase, count: int = COUNT
) -> tuple[list[tuple[float, dict[str, Any]]], list[ResultWarning]]:
    """Summaries of a bearing at speeds around that of its case, with contacts by formula.

    Parameters
    ----------
    case : BearingCase
        Case of the bearing; the temperature is the same at all speeds.
    count : int
        Number of speeds, from a tenth of the case's speed to four times this speed.

    Returns
    -------
    points : list of (float, dict)
        Speeds of the inner ring [rad/s] with their summaries.
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
    changed, refused = formula_case(case)
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
            solution = solution_of(changed.replace({"bearing.inner_speed": speed}))
        except InputError as error:
            text = f"figures over speed leave out {rpm(speed):.4g} rpm: {error}"
            left_out.append(ResultWarning("speed-left-out", text))
        else:
            points.append((speed, summary_of(solution)))
    return points, left_out
