"""Margin against breakdown: critical speed, sensitivity, uncertainty, and the verdict on a bearing."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, field, replace
from itertools import pairwise
from typing import Any

import numpy as np
from scipy.optimize import brentq

from ehlectric.bearing.bearing_discharges import (
    Breakdown,
    breakdown_of,
    first_margin,
    leakage_flags,
    shaft_leakage,
    shaft_voltage,
)
from ehlectric.bearing.bearing_touching import duty_of, time_text
from ehlectric.bearing.film_factor import supply_words
from ehlectric.bearing.impedance import film_share, shaft_path
from ehlectric.bearing.input_changes import (
    Change,
    changes_of,
    proportional_to_strength,
    temperature_is_unused,
)
from ehlectric.bearing.quick_contacts import formula_factor, is_quick, quick_case
from ehlectric.bearing.solution import (
    CONDUCTING,
    PARTIAL,
    BearingSolution,
    error_text,
    film_error,
    insulating,
    lambda_ratio,
    lambda_text,
    lubrication,
)
from ehlectric.bearing.solving import quick_solution
from ehlectric.bearing.warnings import bearing_warnings
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.cases.defaults import HOW
from ehlectric.discharge.film_verdict import (
    UNLIKELY,
    Chance,
    Level,
    Verdict,
    assumption_of,
    doubts_of,
    lead_of,
    level_of,
    ratio_text,
    strength_doubt,
    strength_interval,
    unusable,
    weibull_part,
)
from ehlectric.errors import InputError, raised
from ehlectric.quantities.formats import amount
from ehlectric.quantities.units import rpm, rpm_text

# Tables and keys on which neither films nor breakdown voltages of contacts depend.
_NOT_IN_FILMS = (
    "motor.",
    "discharge.conductivity",
    "bearing.composite_rq",
    "bearing.summits",
    "bearing.contact_resistance",
    "bearing.fill",
    "bearing.parallel_capacitance",
    "bearing.coating",
)

# Tables and keys that no solution uses.
_UNUSED = ("title", "ranges")

# Inputs of strength laws that contacts without a solved field replace by a constant strength.
_NOT_QUICK = ("discharge.weibull.shape", "discharge.weibull.reference_area")


@dataclass(frozen=True)
class MarginPoint:
    """Margin and lambda ratio of a bearing."""

    margin: float  # first breakdown / shaft voltage, dimensionless; 0 where the surfaces touch and conduct
    lambda_ratio: float  # minimum film thickness / composite roughness, dimensionless


@dataclass(frozen=True)
class QuickMargins:
    """Margins of one bearing at changed inputs.

    A Weibull law and a strength table over pressure need the field in the whole film, which formulas do not
    have. A constant strength replaces them here: it cancels in the ratio of two margins of the same strength.
    """

    case: BearingCase
    own: MarginPoint  # margin and lambda ratio of the solution
    # margin_factor and lambda_factor: margin and lambda ratio of the solution divided by those of quick
    # contacts, dimensionless.
    margin_factor: float
    lambda_factor: float
    quick: BearingSolution = field(repr=False)  # solution with quick contacts at the inputs of the case

    @classmethod
    def of(cls, solution: BearingSolution) -> QuickMargins:
        """Margins by quick contacts, scaled to those of a solution. Raises InputError where the solution has
        no margin, or the formulas have none for the same inputs.
        """
        own, quick = MarginPoint(_margin_of(solution), lambda_ratio(solution)), _solved(solution.case)
        point = _point(quick)
        if point.margin == 0.0:
            text = "without solved contacts the surfaces touch already in the case itself"
            raise InputError.worded(None, text)
        ratios = own.margin / point.margin, own.lambda_ratio / point.lambda_ratio
        return cls(solution.case, own, *ratios, quick)

    @staticmethod
    def is_quick(key: str) -> bool:
        """Whether an input has an effect on contacts that are not solved."""
        return key not in _NOT_QUICK

    def at(self, changes: Mapping[str, Any]) -> MarginPoint:
        """Margin and lambda ratio with changed inputs, scaled to the solution. Returns scaled values; the
        margin is 0 where the surfaces touch. Raises InputError where the changed inputs make no valid case,
        or one that needs solved contacts.
        """
        for key in changes:
            if not self.is_quick(key):
                raise InputError.worded(key, "has an effect that only solved contacts have")
        case = self.case.replace(changes)
        same_films = all(key.startswith(_NOT_IN_FILMS) for key in changes)
        point = _point(replace(self.quick, case=case) if same_films else _solved(case))
        ratio = self.lambda_factor * point.lambda_ratio
        return MarginPoint(self.margin_factor * point.margin, ratio)


def _solved(case: BearingCase) -> BearingSolution:
    """Solution of a case with quick contacts, with a constant strength where they need one."""
    quick, refused = quick_case(case, constant=True)
    if quick is None:
        assert refused is not None
        raise refused
    return quick_solution(quick, without_effect=(*_NOT_IN_FILMS, *_UNUSED))


def _point(solution: BearingSolution) -> MarginPoint:
    """Margin and lambda ratio of a solution with quick contacts."""
    return MarginPoint(_margin_of(solution) if insulating(solution) else 0.0, lambda_ratio(solution))


def _margin_of(solution: BearingSolution) -> float:
    """Margin of a solution; raises an InputError where it has none."""
    found: float | None = first_margin(solution)
    if found is None:
        raise InputError.worded(None, "the bearing has no margin")
    return found


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
    """Margin of a bearing over its shaft speed, at one temperature."""

    # lowest and highest: ends of the range of speeds that have a result [rad/s].
    lowest: float
    highest: float
    crossings: tuple[float, ...]  # speeds at which the margin crosses 1 [rad/s], in increasing order
    # Speed below which the surfaces touch [rad/s]; None where they do not touch in the range.
    touching: float | None
    # Intervals of speed in which surfaces may touch, because their lambda ratio is below 3 [rad/s]; None in
    # place of an end of the range.
    partial: Intervals
    above: bool  # whether the margin at the highest speed is at least 1
    # Smallest margin that was computed, dimensionless, where surfaces do not touch; None where all touch.
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
    """Speeds at which the margin of a bearing crosses 1, from a tenth of the speed of the case to four times
    it.

    The temperature is that of the case at all speeds. The margin rises with the speed. Only with inlet shear
    heating or a supply by rule it falls again at high speed; more speeds are computed then.
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


@dataclass(frozen=True)
class Effect:
    """Effect of one input on the margin, all others as in the case."""

    key: str  # dotted key of the input; for the load that of the larger component, where both change together
    label: str
    # low_input and high_input: smaller and larger value of the input, SI units.
    low_input: float
    high_input: float
    # low_margin and high_margin: margin at these values, dimensionless; 0 where the surfaces touch.
    low_margin: float
    high_margin: float

    @property
    def size(self) -> float:
        """Size of the effect: logarithm of the ratio of both margins; infinite where one of them is 0."""
        low, high = sorted((self.low_margin, self.high_margin))
        return math.inf if low <= 0.0 else math.log(high / low)


def effects_of(margins: QuickMargins, margin: float) -> tuple[tuple[Effect, ...], tuple[str, ...]]:
    """Effects of strength, temperature, clearance, load, motor and all inputs with a range on the margin.

    ``margin`` is that of the bearing, dimensionless. A range of the file replaces the usual change of an
    input. Returns the effects, the largest first, and texts about inputs whose effect could not be computed.
    """
    effects, left_out = [], []
    if temperature_is_unused(margins.case):
        left_out.append("temperature: without effect, because lubricant.viscosity is given")
    for change in changes_of(margins.case):
        try:
            low, high = (_margin(margins, margin, change, end) for end in change.ends)
        except InputError as error:
            left_out.append(f"{change.label}: {error}")
        else:
            effects.append(Effect(change.key, change.label, *change.ends, low, high))
    effects.sort(key=lambda effect: -effect.size)
    return tuple(effects), tuple(left_out)


def _margin(margins: QuickMargins, margin: float, change: Change, end: float) -> float:
    """Margin with one changed input."""
    if proportional_to_strength(change.key):
        return margin * end / change.value(margins.case)
    return margins.at(change.changes(margins.case, end)).margin


def margin_range(
    margins: QuickMargins, margin: float, effects: Iterable[Effect]
) -> tuple[float, float] | None:
    """Margin with all inputs of ``ranges`` at their unfavourable ends, and at their favourable ends; None
    without.

    The ends are found one input at a time, and then taken together: 2n + 2 bearings with quick contacts for n
    ranges. The range is wider than an interval of confidence, because all inputs are seldom at their worst at
    once. The smallest margin is 0 where the surfaces touch. Raises InputError where a range has no effect on
    quick contacts, or one of both cases cannot be computed.
    """
    by_key = {effect.key: effect for effect in effects}
    ranges = margins.case.ranges or ()
    if not ranges:
        return None
    worst: dict[str, float] = {}
    best: dict[str, float] = {}
    for one in ranges:
        effect = by_key.get(one.key)
        if effect is None:
            raise InputError.worded(f"ranges.{one.key}", "its ends have no margin without solved contacts")
        ends = {one.low: effect.low_margin, one.high: effect.high_margin}
        # The value of the case counts as well, as it may lie outside of its range or at the top of a curve.
        low, high = min(ends, key=ends.__getitem__), max(ends, key=ends.__getitem__)
        if ends[low] < margin:
            worst[one.key] = low
        if ends[high] > margin:
            best[one.key] = high
    lowest, highest = (margins.at(changes).margin if changes else margin for changes in (worst, best))
    return min(lowest, margin), max(highest, margin)


@dataclass(frozen=True)
class MarginAnalysis:
    """Analysis of the margin (first breakdown / shaft voltage) of a bearing."""

    # Margin of the bearing, dimensionless; None where it has no breakdown voltage or no shaft voltage.
    margin: float | None = None
    # Critical speed and the range of speeds that was looked at; None where it could not be computed.
    speeds: SpeedRange | None = None
    # low and high: margin with all inputs of ``ranges`` at their unfavourable and at their favourable ends;
    # None without ranges. ``low`` is 0 where the surfaces touch.
    low: float | None = None
    high: float | None = None
    effects: tuple[Effect, ...] = ()  # effects of single inputs on the margin, the largest first
    left_out: tuple[str, ...] = ()  # what could not be computed, and why

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
    """Analyse the margin of a solved bearing, by some twenty bearings with quick contacts, in a few seconds.

    The analysis has no values where the bearing has no margin, or its films must not be used.
    """
    margin = first_margin(solution)
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


# Sentence about contacts of asperities, without its full stop.
_OPENING = "Contacts discharge at a low voltage as they open"


def bearing_verdict(
    solution: BearingSolution, analysis: MarginAnalysis, chance: Chance | None = None
) -> Verdict:
    """Verdict on a solved bearing; grey where the numbers must not be used, for ceramic elements, and without
    a strength or a shaft voltage.

    The level follows the probability of breakdown, ``chance``, where it is known. Otherwise the margin may
    lie anywhere between its values at the ends of the stated ranges. Estimated errors of films
    widen this interval, and ``formula_factor`` for contacts by formula. With a Weibull law its lower end is
    that at a probability of 5 %. Without a stated range of the strength, a margin that a change of the
    strength by 20 % takes across 1 is yellow, too.
    """
    warnings = bearing_warnings(solution)
    refused = unusable(warnings)
    if refused or not solution.converged:
        return Verdict("grey", refused or "No verdict: a contact of the bearing is not converged.")
    state = lubrication(solution)
    if solution.conditions.ceramic:
        touching = f" Surfaces touch (lambda ratio {lambda_text(solution)})." if state == "touching" else ""
        return Verdict(
            "grey",
            "No verdict: the ceramic elements insulate, and their own breakdown is not computed." + touching,
        )
    if state == "conducting":
        # A thinner film than one that breaks down is not safer.
        return Verdict(
            "yellow" if solution.case.motor is None else "red",
            f"Discharges likely: surfaces touch {_at(solution)} (lambda ratio {lambda_text(solution)}), "
            f"and contacts are intermittent; they short the bearing {_time(solution)}. {_OPENING}, and no "
            "voltage is computed for that. This is no protection: current passes, and arcs are likely.",
        )
    breakdown, shaft = breakdown_of(solution), shaft_voltage(solution)
    if breakdown is None:
        known = "" if shaft is None else f" The shaft voltage is {shaft:.3g} V {_at(solution)}."
        return Verdict("grey", f"No verdict: no dielectric strength given, no breakdown voltage.{known}")
    first = f"first breakdown at {breakdown.shaft_first_break:.3g} V"
    if shaft is None:
        return Verdict(
            "grey",
            f"No verdict: {first} {_at(solution)}, but no shaft voltage is known without [motor]. "
            + _assumptions(solution),
        )
    return _judged(solution, analysis, breakdown, shaft, doubts_of(warnings), chance)


def _judged(
    solution: BearingSolution,
    analysis: MarginAnalysis,
    breakdown: Breakdown,
    shaft: float,
    warned: Iterable[str],
    chance: Chance | None,
) -> Verdict:
    """Verdict on a bearing with a margin; ``warned`` are sentences of warnings that make it doubtful."""
    margin = breakdown.shaft_first_break / shaft
    doubts = [*_doubts(solution, analysis, margin), *warned]
    if chance is None:
        level, lead, reasons, interval = _by_ends(solution, analysis, margin, doubts)
    else:
        level, lead, reasons, interval = chance.level, chance.lead, [*doubts, chance.sentence], ""
        reasons += _widths(solution, analysis, margin)
        if doubts and level == "green":
            level, lead = "yellow", "Breakdown possible"
    text = (
        f"{lead}: shaft voltage {shaft:.3g} V, first breakdown at "
        f"{breakdown.shaft_first_break:.3g} V (margin {ratio_text(margin)}{interval}) {_at(solution)}."
    )
    speeds = list(_speeds(analysis.speeds, level))
    shares, leaks = _coating(solution, shaft), _leaks(solution)
    sentences = filter(None, [text, shares, *speeds, *reasons, leaks, _assumptions(solution)])
    return Verdict(level, " ".join(sentences), margin)


def _by_ends(
    solution: BearingSolution, analysis: MarginAnalysis, margin: float, doubts: Sequence[str]
) -> tuple[Level, str, list[str], str]:
    """Level, first words, reasons and interval of a verdict from the smallest and the largest margin."""
    reasons = [*doubts]
    low, high = _widened(solution, *_stated(solution, analysis, margin))
    # Without a stated range of the strength a usual one counts.
    strength = not any(one.key.startswith("discharge.") for one in solution.case.ranges or ())
    if strength:
        weakest, strongest = strength_interval(margin)
        low, high = min(low, weakest), max(high, strongest)
    level = level_of(low, high)
    if doubts and level == "green":
        level = "yellow"
    if strength:
        reasons += filter(None, [strength_doubt(solution.case.discharge, margin)])
    reasons += _widths(solution, analysis, margin)
    interval = ""
    if analysis.low is not None and analysis.high is not None:
        interval = (
            f", {ratio_text(analysis.low)} to {ratio_text(analysis.high)} within the stated ranges of inputs"
        )
    return level, lead_of(level, margin), reasons, interval


def _coating(solution: BearingSolution, shaft: float) -> str:
    """Sentence about the share of a coating in the shaft voltage [V]; empty without one."""
    share = film_share(solution)
    if share is None or not shaft_path(solution).coated:
        return ""
    return (
        f"Of the shaft voltage {share * shaft:.3g} V ({100.0 * share:.3g} %) are across the films at high "
        "frequency, and the coating has the rest."
    )


def _leaks(solution: BearingSolution) -> str:
    """Sentence about films that discharge through the oil within a period; empty where they do not."""
    found = shaft_leakage(solution)
    if found is None or not any(raised(leakage_flags(solution))):
        return ""
    motor = solution.case.motor
    frequency = None if motor is None else motor.switching_frequency
    period = "the period of a common PWM inverter"
    if frequency is not None:
        period = f"one PWM period of {amount(1.0 / frequency, 's')}"
    time = amount(found.film_time_constant, "s")
    return (
        f"The film discharges through the oil within {period} (time constant {time}): its voltage is an "
        "upper bound."
    )


def _stated(solution: BearingSolution, analysis: MarginAnalysis, margin: float) -> tuple[float, float]:
    """Smallest and largest margin within the stated ranges, the smallest at 5 % of a Weibull law."""
    low = margin if analysis.low is None else analysis.low
    high = margin if analysis.high is None else analysis.high
    weibull = solution.case.discharge.weibull
    return low if weibull is None else low * weibull_part(weibull.shape, UNLIKELY), high


def _widened(solution: BearingSolution, low: float, high: float) -> tuple[float, float]:
    """Interval of margins, widened by the accuracy of the films."""
    if solution.case.contacts == "formula":
        factor = formula_factor(solution.case.bearing.kind)
        return low / factor, high * factor
    off = film_error(solution)
    return low * (1.0 - off), high * (1.0 + off)


def _doubts(solution: BearingSolution, analysis: MarginAnalysis, margin: float) -> Iterator[str]:
    """Sentences for which the margin may be lower than it is computed to be."""
    if lubrication(solution) == "partial film" or duty_of(solution).regime != "capacitive":
        yield (
            f"Surfaces may touch at times (lambda ratio {lambda_text(solution)}), and contacts are "
            f"intermittent: voltages are upper bounds. {_OPENING}, which is not computed. An element touches "
            f"both rings {_time(solution)}."
        )
    if solution.case.ranges and analysis.low is None:
        yield "The range of the margin could not be computed from the stated ranges of inputs."
    if analysis.low == 0.0:
        yield "At the unfavourable ends of the stated ranges the surfaces touch."
    weibull = solution.case.discharge.weibull
    if weibull is not None:
        unlikely = margin * weibull_part(weibull.shape, UNLIKELY)
        text = f"The margin is for a probability of 63.2 %; at 5 % it is {ratio_text(unlikely)}."
        if unlikely < 1.0:
            yield text


def _widths(solution: BearingSolution, analysis: MarginAnalysis, margin: float) -> Iterator[str]:
    """Sentence about the accuracy of the films, where it takes the margin or its stated range across 1."""
    intervals = ((margin, margin), _stated(solution, analysis, margin))
    if not any(
        level_of(*ends) != "yellow" and level_of(*_widened(solution, *ends)) == "yellow" for ends in intervals
    ):
        return
    if is_quick(solution.case):
        how = HOW[solution.case.contacts]
        yield f"Films {how} may be {error_text(solution)} off: solved contacts decide."
    elif film_error(solution) > 0.0:
        yield f"Films may be {error_text(solution)} off."


def _speeds(speeds: SpeedRange | None, level: Level) -> Iterator[str]:
    """Sentences about the speeds at which breakdown is expected; none where no other speed was computed."""
    if speeds is None or speeds.lowest >= speeds.highest:
        return
    lowest, highest = max(speeds.lowest, speeds.touching or 0.0), speeds.highest
    within = f"at all speeds computed, {rpm_text(lowest)} to {rpm_text(highest)} rpm"
    if speeds.crossings:
        # A verdict that is not sure at the speed of the case is not sure at others.
        word = "likely" if level == "yellow" else "expected"
        yield f"{_intervals(speeds.broken)} breakdown is {word}."
    elif not speeds.above:
        yield f"The margin is below 1 {within}."
    elif speeds.minimum is not None:
        yield f"The margin is at least {ratio_text(speeds.minimum)} {within}."
    if speeds.partial == ((None, None),):
        yield f"Surfaces may touch, and discharge as they part, {within}."
    elif speeds.partial:
        yield f"{_intervals(speeds.partial)} surfaces may touch, and discharge as they part."
    if speeds.touching is not None:
        yield (
            f"Below about {rpm_text(speeds.touching)} rpm the surfaces touch: contacts open and close, "
            "discharges are likely, and no voltage is computed."
        )


def _intervals(ranges: Intervals) -> str:
    """Start of a sentence with intervals of speed [rad/s]."""
    where = " and ".join(_interval(low, high) for low, high in ranges)
    return f"{where[0].upper()}{where[1:]}"


def _interval(low: float | None, high: float | None) -> str:
    """Clause with an interval of speed [rad/s], whose open ends are those of all speeds computed."""
    if low is None:
        return f"below about {rpm_text(high or 0.0)} rpm"
    if high is None:
        return f"above about {rpm_text(low)} rpm"
    return f"between about {rpm_text(low)} and {rpm_text(high)} rpm"


def _time(solution: BearingSolution) -> str:
    """Share of time in which an element touches both rings, as text."""
    return time_text(duty_of(solution).touching_time_share)


def _at(solution: BearingSolution) -> str:
    """Speed and temperature of a bearing as text."""
    bearing = solution.case.bearing
    speed, temperature = rpm(bearing.inner_speed), bearing.oil_temperature - 273.15
    return f"at {float(f'{speed:.4g}'):g} rpm, {float(f'{temperature:.3g}'):g} °C"


def _assumptions(solution: BearingSolution) -> str:
    """Sentence about the assumptions behind the breakdown voltage."""
    case, factor = solution.case, solution.conditions.film_factor
    films = f"smooth film with the given film factor {factor:.3g}, which alone stands for starvation and heat"
    if factor == 1.0:
        films = "isothermal, fully flooded, smooth film"
    elif case.bearing.supply != "flooded":
        films = f"smooth film with {supply_words(solution)}"
    elif case.bearing.film_factor == "inlet-shear":
        films = "fully flooded, smooth film with inlet shear heating"
    elif case.bearing.film_factor == "solved":
        films = "fully flooded, smooth film with the solved heat of pure rolling"
    stated = {one.key: (one.low, one.high) for one in case.ranges or ()}
    clause = assumption_of(case.discharge, stated.get("discharge.dielectric_strength"))
    return f"{'Upper bound' if case.bearing.isothermal else 'Best estimate'}: {films}; {clause}."
