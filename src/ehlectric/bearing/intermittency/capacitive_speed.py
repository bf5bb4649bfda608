"""Speed from which a bearing is capacitive: its films separate the surfaces nearly all of the time."""

from __future__ import annotations

import math

from scipy.optimize import brentq

from ehlectric.bearing.intermittency.duty import CAPACITIVE, duty_of
from ehlectric.bearing.quick.ways import quick_case
from ehlectric.bearing.solution import CONDUCTING, BearingSolution, lambda_ratio
from ehlectric.bearing.solving.remembered import quick_solution
from ehlectric.errors import InputError

# Factor between the speeds that are looked at, their number in each direction from that of the case, and the
# tolerance of the logarithm of the speed: 0.2 %.
_STEP, _STEPS, _TOLERANCE = 3.0, 3, 2e-3

# Least share of time whose logarithm is taken; far below any speed that is looked for.
_LEAST = 1e-12


def capacitive_speed(solution: BearingSolution) -> float | None:
    """Speed of the inner ring from which a bearing is capacitive at its temperature.

    Parameters
    ----------
    solution : BearingSolution
        Solved bearing.

    Returns
    -------
    float or None
        Speed [rad/s] at which the bearing becomes capacitive: it conducts ``CAPACITIVE`` of the time, or its
        least lambda ratio is 1 if that speed is higher. Of a bearing that is capacitive it is the next lower
        one, of another the next higher one. None where there is none from a 27th to 27 times the speed of the
        case; for ceramic elements and coatings, which insulate at any speed; for an oil that no quick way
        describes; and where a film of the solution is not converged.

    Notes
    -----
    Films at other speeds are from the atlas, or by formula where the contacts of the case are, and are
    scaled to the least lambda ratio of the solution at its own speed. The temperature is that of the case at
    all speeds.
    """
    case = solution.case
    if solution.conditions.ceramic or case.bearing.coating is not None or not solution.converged:
        return None
    quick, _ = quick_case(case)
    if quick is None:
        return None
    own, start = math.log(case.bearing.inner_speed), quick_solution(quick)
    scale = lambda_ratio(solution) / lambda_ratio(start)

    known: dict[float, float] = {}

    def excess(log: float) -> float:
        if log not in known:
            known[log] = found(log)
        return known[log]

    def found(log: float) -> float:
        """How far the bearing is beyond both limits, by logarithms; negative where it is not capacitive."""
        changed = quick.replace({"bearing.inner_speed": math.exp(log)})
        at = start if log == own else quick_solution(changed)
        share = duty_of(at, film_scale=scale).contact_time_share
        room = math.log(scale * lambda_ratio(at) / CONDUCTING)
        return min(math.log(CAPACITIVE / max(share, _LEAST)), room)

    first = excess(own)
    step = math.log(_STEP) if first < 0.0 else -math.log(_STEP)
    for k in range(_STEPS):
        ends = own + k * step, own + (k + 1) * step
        try:
            beyond = excess(ends[1])
        except InputError:
            # The bearing has no equilibrium or no film at this speed, nor beyond it.
            return None
        if (beyond < 0.0) != (first < 0.0):
            return math.exp(float(brentq(excess, min(ends), max(ends), xtol=_TOLERANCE)))
    return None
