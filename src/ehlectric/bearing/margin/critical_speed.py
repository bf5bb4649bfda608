"""Critical speed of a bearing, below which breakdown is expected."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise

from scipy.optimize import brentq

from ehlectric.bearing.margin.formula_margins import FormulaMargins, FormulaPoint
from ehlectric.bearing.solution import CONDUCTING
from ehlectric.errors import InputError

# Smallest and largest speed that are looked at, divided by the speed of the case.
LEAST, MOST = 0.1, 4.0

# Speeds beside that of the case at which margins are computed, divided by it, and the tolerance of the
# logarithm of the critical speed: 0.2 % of the speed.
_PARTS, _TOLERANCE = (LEAST, 0.3, 2.0, MOST), 2e-3


@dataclass(frozen=True)
class SpeedRange:
    """Margin of a bearing over its shaft speed, at one temperature.

    Attributes
    ----------
    lowest, highest : float
        Ends of the range of speeds that have a result [rad/s].
    critical : float or None
        Speed at which the margin is 1, below which it is smaller [rad/s]; None where there is no such speed.
    touching : float or None
        Speed below which the surfaces touch [rad/s]; None where they do not touch in the range.
    above : bool
        Whether the margin at the highest speed is at least 1.
    left_out : tuple of str
        Speeds that have no result, and why.
    """

    lowest: float
    highest: float
    critical: float | None
    touching: float | None
    above: bool
    left_out: tuple[str, ...] = ()


def speed_range(margins: FormulaMargins) -> SpeedRange:
    """Find the critical speed of a bearing.

    Parameters
    ----------
    margins : FormulaMargins
        Margins of the bearing at changed inputs.

    Returns
    -------
    SpeedRange
        Critical speed, from a tenth of the case's speed to four times this speed.

    Notes
    -----
    The temperature is that of the case at all speeds. Where the margin crosses 1 more than once, the highest
    of these speeds counts: breakdown is expected somewhere below it.
    """
    own = math.log(margins.case.bearing.inner_speed)
    known = {own: margins.own}
    left_out = []

    def at(log: float) -> FormulaPoint:
        if log not in known:
            known[log] = margins.at({"bearing.inner_speed": math.exp(log)})
        return known[log]

    for part in _PARTS:
        try:
            at(own + math.log(part))
        except InputError as error:
            speed = math.exp(own) * part * 30.0 / math.pi
            left_out.append(f"speed {speed:.4g} rpm: {error}")
    logs = sorted(known)
    lowest, highest = logs[0], logs[-1]
    touching = _crossing(logs, lambda log: at(log).lambda_ratio - CONDUCTING)
    if touching is not None:
        # At the crossing itself the surfaces may touch by rounding.
        logs = [touching + _TOLERANCE, *(log for log in logs if log > touching + _TOLERANCE)]
    # The surfaces may still touch by formula where the scaled lambda ratio is above 1.
    logs = [log for log in logs if at(log).margin > 0.0]
    critical = _crossing(logs, lambda log: math.log(at(log).margin))
    return SpeedRange(
        math.exp(lowest),
        math.exp(highest),
        None if critical is None else math.exp(critical),
        None if touching is None else math.exp(touching),
        at(highest).margin >= 1.0,
        tuple(left_out),
    )


def _crossing(logs: list[float], value: Callable[[float], float]) -> float | None:
    """Highest logarithm of a speed at which a value rises through 0; None where there is none."""
    for low, high in reversed(list(pairwise(logs))):
        if value(low) < 0.0 <= value(high):
            found: float = brentq(value, low, high, xtol=_TOLERANCE)
            return found
    return None
