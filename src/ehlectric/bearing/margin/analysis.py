"""Analysis of the margin of a solved bearing: critical speed, effects of its inputs, and range."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any

from ehlectric.bearing.breakdown import breakdown_of
from ehlectric.bearing.margin.critical_speed import SpeedRange, speed_range
from ehlectric.bearing.margin.quick_margins import QuickMargins
from ehlectric.bearing.margin.sensitivity import Effect, effects_of
from ehlectric.bearing.margin.uncertainty import margin_range
from ehlectric.bearing.shaft_voltage import margin as margin_of
from ehlectric.bearing.shaft_voltage import shaft_voltage
from ehlectric.bearing.solution import BearingSolution
from ehlectric.errors import InputError


@dataclass(frozen=True)
class MarginAnalysis:
    """Analysis of the margin (first breakdown / shaft voltage) of a bearing.

    Attributes
    ----------
    margin : float or None
        Margin of the bearing, dimensionless; None where it has no breakdown voltage or no shaft voltage.
    speeds : SpeedRange or None
        Critical speed and the range of speeds that was looked at; None where it could not be computed.
    low, high : float or None
        Margin with all inputs of ``ranges`` at their unfavourable and at their favourable ends; None without
        ranges. ``low`` is 0 where the surfaces touch.
    effects : tuple of Effect
        Effects of single inputs on the margin, the largest first.
    left_out : tuple of str
        What could not be computed, and why.
    """

    margin: float | None = None
    speeds: SpeedRange | None = None
    low: float | None = None
    high: float | None = None
    effects: tuple[Effect, ...] = ()
    left_out: tuple[str, ...] = ()

    @property
    def critical_speed(self) -> float | None:
        """Speed of the inner ring below which breakdown is expected [rad/s]; None where there is none."""
        return None if self.speeds is None else self.speeds.critical

    def summary(self) -> dict[str, Any]:
        """Values as in the table ``margin`` of summary.json, SI units, without the level of the verdict."""
        speeds = self.speeds
        return {
            "critical_speed": self.critical_speed,
            "upper_critical_speed": None if speeds is None else speeds.upper,
            "touching_speed": None if speeds is None else speeds.touching,
            "lowest_speed": None if speeds is None else speeds.lowest,
            "highest_speed": None if speeds is None else speeds.highest,
            "low": self.low,
            "high": self.high,
            "effects": [asdict(effect) for effect in self.effects],
            "left_out": list(self.left_out),
        }


def analyse_margin(solution: BearingSolution) -> MarginAnalysis:
    """Analyse the margin of a solved bearing.

    The analysis solves some twenty bearings with contacts from the atlas, which takes a few seconds at most.

    Parameters
    ----------
    solution : BearingSolution
        Solved bearing.

    Returns
    -------
    MarginAnalysis
        Without values where the bearing has no margin, or where its films must not be used.
    """
    breakdown = breakdown_of(solution)
    margin = None if breakdown is None else margin_of(breakdown.shaft_first_break, shaft_voltage(solution))
    if margin is None or not solution.converged:
        return MarginAnalysis(margin)
    try:
        margins = QuickMargins.of(solution)
    except InputError as error:
        return MarginAnalysis(margin, left_out=(f"margins at other inputs: {error}",))
    effects, left_out = effects_of(margins, margin)
    speeds, interval = speed_range(margins), None
    left_out += speeds.left_out
    try:
        interval = margin_range(margins, margin, effects)
    except InputError as error:
        left_out += (f"range of the margin: {error}",)
    low, high = interval or (None, None)
    return MarginAnalysis(margin, speeds, low, high, effects, left_out)
