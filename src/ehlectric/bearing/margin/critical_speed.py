"""Speeds of a bearing at which its margin crosses 1, and below which its surfaces touch."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from scipy.optimize import brentq

from ehlectric.bearing.margin.quick_margins import MarginPoint, QuickMargins
from ehlectric.bearing.solution import CONDUCTING, PARTIAL
from ehlectric.errors import InputError
from ehlectric.quantities.units import rpm

# Smallest and largest speed that are looked at, divided by the speed of the case.
LEAST, MOST = 0.1, 4.0

# Speeds beside that of the case at which margins are computed, divided by it, and the tolerance of the
# logarithm of the critical speed: 0.2 % of the speed.
_PARTS, _TOLERANCE = (LEAST, 0.3, 2.0, MOST), 2e-3

# The same where the margin is not monotonic: heating by shear in the inlet makes films thinner at high speed.
_FINE_PARTS = tuple(float(part) for part in np.geomspace(LEAST, MOST, 14))


# Intervals of speed [rad/s]; None in place of an end of the range of speeds.
Intervals = tuple[tuple[float | None, float | None], ...]


@dataclass(frozen=True)
class SpeedRange:
    """Margin of a bearing over its shaft speed, at one temperature.

    Attributes
    ----------
    lowest, highest : float
        Ends of the range of speeds that have a result [rad/s].
    crossings : tuple of float
        Speeds at which the margin crosses 1 [rad/s], in increasing order.
    touching : float or None
        Speed below which the surfaces touch [rad/s]; None where they do not touch in the range.
    partial : tuple of (float or None, float or None)
        Intervals of speed in which surfaces may touch, because their lambda ratio is below 3 [rad/s]; None
        in place of an end of the range.
    above : bool
        Whether the margin at the highest speed is at least 1.
    minimum : float or None
        Smallest margin that was computed, dimensionless, where surfaces do not touch; None where all touch.
    left_out : tuple of str
        Speeds that have no result, and why.
    """

    lowest: float
    highest: float
    crossings: tuple[float, ...]
    touching: float | None
    partial: Intervals
    above: bool
    minimum: float | None
    left_out: tuple[str, ...] = ()

    @property
    def broken(self) -> Intervals:
        """Intervals of speed with a margin below 1 [rad/s]; None in place of an end of the range.

        Examples
        --------
        A margin that rises through 1 at 100 rad/s and falls through it at 900 rad/s:

        >>> SpeedRange(10.0, 1e3, (100.0, 900.0), None, (), above=False, minimum=0.5).broken
        ((None, 100.0), (900.0, None))
        """
        return _below(self.crossings, above=self.above)

    @property
    def critical(self) -> float | None:
        """Highest speed at which the margin rises through 1 [rad/s]; None where there is none."""
        return max((high for _, high in self.broken if high is not None), default=None)

    @property
    def upper(self) -> float | None:
        """Speed above which the margin is below 1 up to the highest speed [rad/s], or None."""
        return self.crossings[-1] if self.crossings and not self.above else None


def speed_range(margins: QuickMargins) -> SpeedRange:
    """Find the speeds at which the margin of a bearing crosses 1.

    Parameters
    ----------
    margins : QuickMargins
        Margins of the bearing at changed inputs.

    Returns
    -------
    SpeedRange
        Speeds from a tenth of the case's speed to four times this speed.

    Notes
    -----
    The temperature is that of the case at all speeds. The margin rises with the speed. Only with inlet
    shear heating or a supply by rule it falls again at high speed; more speeds are computed then.
    """
    own = math.log(margins.case.bearing.inner_speed)
    known = {own: margins.own}
    left_out = []

    def at(log: float) -> MarginPoint:
        if log not in known:
            known[log] = margins.at({"bearing.inner_speed": math.exp(log)})
        return known[log]

    bearing = margins.case.bearing
    falls = bearing.heated or bearing.by_supply_rule
    for part in _FINE_PARTS if falls else _PARTS:
        try:
            at(own + math.log(part))
        except InputError as error:
            left_out.append(f"speed {rpm(math.exp(own) * part):.4g} rpm: {error}")
    logs = sorted(known)
    lowest, highest = logs[0], logs[-1]
    touching = _last_rise(logs, lambda log: at(log).lambda_ratio - CONDUCTING)
    parted = _crossings(logs, lambda log: math.log(at(log).lambda_ratio / PARTIAL))
    separated = at(highest).lambda_ratio >= PARTIAL
    if touching is not None:
        # At the crossing itself the surfaces may touch by rounding.
        logs = [touching + _TOLERANCE, *(log for log in logs if log > touching + _TOLERANCE)]
    # The surfaces may still touch with contacts from the atlas where the scaled lambda ratio is above 1.
    logs = [log for log in logs if at(log).margin > 0.0]
    crossings = _crossings(logs, lambda log: math.log(at(log).margin))
    return SpeedRange(
        math.exp(lowest),
        math.exp(highest),
        tuple(math.exp(log) for log in crossings),
        None if touching is None else math.exp(touching),
        _below([math.exp(log) for log in parted], above=separated),
        at(highest).margin >= 1.0,
        min((at(log).margin for log in logs), default=None),
        tuple(left_out),
    )


def _below(crossings: Sequence[float], *, above: bool) -> Intervals:
    """Intervals of speed with a value below a limit: its crossings, and its side at the highest speed."""
    ends: list[float | None] = [*crossings]
    if not above:
        ends.append(None)
    if len(ends) % 2:
        ends.insert(0, None)
    return tuple(zip(ends[::2], ends[1::2], strict=True))


def _last_rise(logs: list[float], value: Callable[[float], float]) -> float | None:
    """Highest logarithm of a speed at which a value rises through 0; None where there is none."""
    rises = [(low, high) for low, high in pairwise(logs) if value(low) < 0.0 <= value(high)]
    return _crossings(list(rises[-1]), value)[0] if rises else None


def _crossings(logs: list[float], value: Callable[[float], float]) -> list[float]:
    """Logarithms of the speeds at which a value changes its sign, in increasing order."""
    return [
        float(brentq(value, low, high, xtol=_TOLERANCE))
        for low, high in pairwise(logs)
        if (value(low) < 0.0) != (value(high) < 0.0)
    ]
