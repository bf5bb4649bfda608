"""Critical speed of a bearing, below which breakdown is expected."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from scipy.optimize import brentq

from ehlectric.bearing.margin.formula_margins import FormulaMargins, FormulaPoint
from ehlectric.bearing.solution import CONDUCTING
from ehlectric.errors import InputError

# Smallest and largest speed that are looked at, divided by the speed of the case.
LEAST, MOST = 0.1, 4.0

# Speeds beside that of the case at which margins are computed, divided by it, and the tolerance of the
# logarithm of the critical speed: 0.2 % of the speed.
_PARTS, _TOLERANCE = (LEAST, 0.25, 0.6, 1.0, 2.0, MOST), 2e-3


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

    Raises
    ------
    InputError
        Where no speed has a result.

    Notes
    -----
    The temperature is that of the case at all speeds. Where the margin crosses 1 more than once, the highest
    of these speeds counts: breakdown is expected somewhere below it.
    """
    own = margins.case.bearing.inner_speed
    known: dict[float, FormulaPoint] = {}
    left_out = []

    def at(speed: float) -> FormulaPoint:
        if speed not in known:
            known[speed] = margins.at({"bearing.inner_speed": speed})
        return known[speed]

    speeds = []
    for part in _PARTS:
        try:
            at(part * own)
        except InputError as error:
            left_out.append(f"speed {part * own * 30.0 / math.pi:.4g} rpm: {error}")
        else:
            speeds.append(part * own)
    if not speeds:
        raise InputError.worded(None, "; ".join(left_out))
    touching = _crossing(speeds, lambda speed: at(speed).lambda_ratio - CONDUCTING)
    if touching is not None:
        # At the crossing itself the surfaces may touch by rounding.
        speeds = [touching * (1.0 + 2.0 * _TOLERANCE), *(speed for speed in speeds if speed > touching)]
    insulated = [speed for speed in speeds if at(speed).margin > 0.0]
    critical = _crossing(insulated, lambda speed: math.log(max(at(speed).margin, 1e-300)))
    lowest, highest = min(known), max(known)
    return SpeedRange(lowest, highest, critical, touching, at(highest).margin >= 1.0, tuple(left_out))


def _crossing(speeds: list[float], value: Callable[[float], float]) -> float | None:
    """Highest speed at which a value rises from below 0 to above 0; None where there is none."""
    for low, high in reversed(list(pairwise(speeds))):
        if value(low) < 0.0 <= value(high):
            found: float = brentq(lambda log: value(float(np.exp(log))), math.log(low), math.log(high),
                                  xtol=_TOLERANCE)  # fmt: skip
            return math.exp(found)
    return None
