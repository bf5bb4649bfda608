"""Margin against breakdown: critical speed, sensitivity, uncertainty, and the verdict on a bearing."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, field, replace
from functools import partial
from typing import Any

import numpy as np

from ehlectric.arrays import Array, Numbers
from ehlectric.bearing.bearing_discharges import (
    Breakdown,
    breakdown_of,
    first_margin,
    leakage_flags,
    margin_apart,
    margin_with_films,
    shaft_leakage,
    shaft_voltage,
    with_films_scaled,
)
from ehlectric.bearing.bearing_touching import duty_of, regime_clause
from ehlectric.bearing.ceramic_elements import element_breakdown, element_field, element_voltage
from ehlectric.bearing.changed_bearings import (
    OWN,
    PARTS,
    Sampled,
    Several,
    alike,
    at_speeds,
    log_of,
    over_parts,
    solve_several,
)
from ehlectric.bearing.film_factor import supply_words
from ehlectric.bearing.impedance import film_share, shaft_path
from ehlectric.bearing.input_changes import (
    Change,
    changes_of,
    proportional_to_strength,
    temperature_is_unused,
)
from ehlectric.bearing.quick_contacts import formula_factor, is_quick, required_quick_case
from ehlectric.bearing.solution import (
    CONDUCTING,
    PARTIAL,
    BearingSolution,
    capacitance_is_bound,
    error_text,
    film_error,
    insulating,
    lambda_ratio,
    lambda_text,
    lubrication,
    touching_ratio,
)
from ehlectric.bearing.solving import NOT_IN_FILMS, quick_solution
from ehlectric.bearing.warnings import bearing_warnings
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.cases.defaults import HOW
from ehlectric.discharge.breakdown_rule import (
    STRENGTH_UNKNOWN,
    UNLIKELY,
    Chance,
    Level,
    doubted,
    lead_of,
    level_of,
    ratio_text,
    strength_interval,
    touching_rule,
)
from ehlectric.discharge.film_verdict import (
    Verdict,
    doubts_of,
    strength_clause,
    strength_doubt,
    unusable,
    weibull_part,
)
from ehlectric.errors import InputError, raised
from ehlectric.quantities.formats import amount, rpm_text
from ehlectric.quantities.units import rpm
from ehlectric.readable import readable

# Inputs of strength laws that only solved contacts have: others replace them by a constant strength.
ONLY_SOLVED = ("discharge.weibull.shape", "discharge.weibull.reference_area")


# Reason for which a bearing with a margin has none at changed inputs.
TOUCHING_ALREADY = "without solved contacts the surfaces touch already in the case itself"


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
    # margin_factor and lambda_factor: margin and lambda ratio of the solution divided by those of bearings
    # that are solved together, dimensionless. Their films are taken to be ``lambda_factor`` times as thick.
    margin_factor: float
    lambda_factor: float
    quick_case: BearingCase = field(repr=False)  # case with quick contacts, whose films are scaled
    quick: BearingSolution = field(repr=False)  # solution with quick contacts at the inputs of the case
    quick_scale: float  # lambda ratio of the solution divided by that of ``quick``, dimensionless
    # Margin of the solution divided by that of ``quick`` with films so much thicker, dimensionless.
    quick_factor: float

    @classmethod
    def of(cls, solution: BearingSolution) -> QuickMargins:
        """Margins by quick contacts, scaled to those of a solution. Raises InputError where the solution has
        no margin, or the formulas have none for the same inputs.

        If the surfaces touch, the margins of much thicker films are compared instead.
        """
        touching = not np.any(insulating(solution))
        margin = 0.0 if touching else _margin_of(solution)
        own = MarginPoint(margin, lambda_ratio(solution))
        case = _quick(solution.case)
        _, several = over_parts(case)
        if OWN in several.reasons:
            raise InputError.worded(None, several.reasons[OWN])
        ratio = several.columns(lambda at: (lambda_ratio(at),), 1)[0, OWN]
        quick = solution if is_quick(solution.case) else quick_solution(case)
        scale, quick_scale = float(own.lambda_ratio / ratio), float(own.lambda_ratio / lambda_ratio(quick))
        case = with_films_scaled(case, scale)
        scaled = replace(quick, case=with_films_scaled(quick.case, quick_scale))
        if touching:
            margin = _known(margin_apart(solution))
            coarse = over_parts(case)[1].columns(lambda at: (margin_apart(at),), 1)[0, OWN]
            whole = _known(margin_apart(scaled))
        else:
            coarse = over_parts(case)[1].columns(margin_and_lambda, 2)[0, OWN]
            whole = margin_and_lambda(scaled)[0]
        if not coarse * whole:
            raise InputError.worded(None, TOUCHING_ALREADY)
        factor, quick_factor = float(margin / coarse), float(margin / whole)
        return cls(solution.case, own, factor, scale, case, quick, quick_scale, quick_factor)

    def at(self, changes: Mapping[str, Any]) -> MarginPoint:
        """Margin and lambda ratio with changed inputs, scaled to the solution. Returns scaled values; the
        margin is 0 where the surfaces touch. Raises InputError where the changed inputs make no valid case,
        or one that needs solved contacts.
        """
        (found,) = self.at_all([changes])
        if isinstance(found, InputError):
            raise found
        return found

    def at_all(self, changes: Sequence[Mapping[str, Any]]) -> list[MarginPoint | InputError]:
        """Margins and lambda ratios at several changes of the inputs, which are solved together.

        Returns for each change what ``at`` returns, or the error that it raises.
        """
        found: dict[int, MarginPoint | InputError] = {}
        films: dict[int, BearingCase] = {}
        others: dict[int, BearingCase] = {}
        for place, one in enumerate(changes):
            try:
                case = self._changed(one)
                if all(key.startswith(NOT_IN_FILMS) for key in one):
                    others[place] = case
                else:
                    films[place] = _quick(case)
            except InputError as error:
                found[place] = error
        for known, solve in ((others, self._beside_films), (films, self._with_films)):
            for places, case in alike(list(known.values())):
                own = np.array(list(known))[places].tolist()
                try:
                    found |= zip(own, solve(case), strict=True)
                except InputError as error:
                    found |= dict.fromkeys(own, error)
        return [found[place] for place in range(len(changes))]

    def _beside_films(self, case: BearingCase) -> list[MarginPoint | InputError]:
        """Points of a case with arrays on which the films do not depend."""
        margin, _ = margin_and_lambda(replace(self.quick, case=with_films_scaled(case, self.quick_scale)))
        ratio = self.own.lambda_ratio * self.case.bearing.composite_rq / case.bearing.composite_rq
        columns = self.quick_factor * margin, ratio, np.ones(case.shape)
        return [MarginPoint(*one) for one in np.stack(np.broadcast_arrays(*columns)[:2], axis=-1).tolist()]

    def _with_films(self, case: BearingCase) -> list[MarginPoint | InputError]:
        """Points of a case with arrays, whose films are solved."""
        several = solve_several(with_films_scaled(case, self.lambda_factor))
        points = [MarginPoint(*one) for one in self._scaled(several).T.tolist()]
        return [
            InputError.worded(None, several.reasons[k]) if k in several.reasons else point
            for k, point in enumerate(points)
        ]

    def _changed(self, changes: Mapping[str, Any]) -> BearingCase:
        """Case with changed inputs."""
        for key in changes:
            if key in ONLY_SOLVED:
                raise InputError.worded(key, "has an effect that only solved contacts have")
        return self.case.replace(changes)

    def over_parts(self) -> tuple[Array, Array, dict[int, str]]:
        """Speeds of ``PARTS`` [rad/s], shape (n,), margins and lambda ratios at them, shape (2, n), and the
        reasons of speeds without a solution, whose numbers are NaN, by their places.
        """
        speeds, several = over_parts(self.quick_case)
        return speeds, self._scaled(several), several.reasons

    def at_speeds(self, speeds: Array) -> Array:
        """Margins and lambda ratios at speeds [rad/s], shape (n,) -> (2, n); NaN without a solution."""
        return self._scaled(at_speeds(self.quick_case, speeds))

    def _scaled(self, several: Several) -> Array:
        """Margins and lambda ratios, scaled to the solution, shape (2, n); NaN without a solution."""
        factors = np.array([[self.margin_factor], [1.0]])
        return np.asarray(factors * several.columns(margin_and_lambda, 2))


def _quick(case: BearingCase) -> BearingCase:
    """Case with quick contacts, with a constant strength where they need one."""
    return required_quick_case(case, constant=True)[0]


def margin_and_lambda(solution: BearingSolution) -> tuple[Numbers, Numbers]:
    """Margin and lambda ratio of a solution with quick contacts, shape (...); a margin of 0 where surfaces
    touch.
    """
    films, ratio = insulating(solution), lambda_ratio(solution)
    margin = _margin_of(solution) if np.any(films) else 0.0
    return np.where(films, margin, 0.0), ratio


def _margin_of(solution: BearingSolution) -> Numbers:
    """Margin of a solution, shape (...); raises an InputError where it has none."""
    return _known(first_margin(solution))


def _known(margin: Numbers | None) -> Numbers:
    """Margin of a solution that must have one."""
    if margin is None:
        raise InputError.worded(None, "the bearing has no margin")
    return margin


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


# Quantities that cross 0 over the speed: logarithm of the margin, and those of the lambda ratio over the
# values below which surfaces touch at times, and below which they touch.
_MARGIN, _PARTED, _TOUCHING = range(3)


def speed_range(margins: QuickMargins) -> SpeedRange:
    """Speeds at which the margin of a bearing crosses 1, from a tenth of the speed of the case to four times
    it.

    The temperature is that of the case at all speeds. The margin is computed at a series of speeds, and at
    more near each crossing, until it lies between two speeds that are 0.2 % apart.
    """
    own = margins.case.bearing.inner_speed
    speeds, points, reasons = margins.over_parts()
    left_out = tuple(
        f"speed {readable(rpm(own * PARTS[place]), 4)} rpm: {reason}"
        for place, reason in sorted(reasons.items())
    )
    known = np.isfinite(points[1])
    # The bearing itself has a result, which is exact.
    known[OWN] = True
    points[:, OWN] = margins.own.margin, margins.own.lambda_ratio
    logarithms = partial(_logarithms, summit_height=margins.case.bearing.summit_height)
    sampled = Sampled(
        lambda log: logarithms(margins.at_speeds(np.exp(log))),
        np.log(speeds[known]),
        logarithms(points[:, known]),
        last=frozenset({_TOUCHING}),
    )
    sampled.refine()
    return _range_of(sampled, left_out)


def _logarithms(points: Array, summit_height: float) -> Array:
    """Quantities that cross 0, shape (3, n), from margins and lambda ratios, shape (2, n)."""
    margin, ratio = points
    limits = np.maximum(PARTIAL, summit_height), touching_ratio(summit_height)
    return np.stack([log_of(margin), *(log_of(ratio / limit) for limit in limits)])


def _range_of(sampled: Sampled, left_out: tuple[str, ...]) -> SpeedRange:
    """Range of speeds from the quantities at many of them."""
    lowest, highest = sampled.log[0], sampled.log[-1]
    margin, ratio = sampled.values[_MARGIN], sampled.values[_PARTED]
    touching = max(sampled.crossings(_TOUCHING), default=None)
    within = np.isfinite(margin) & (sampled.log > (-math.inf if touching is None else touching))
    crossings = [log for log in sampled.crossings(_MARGIN) if touching is None or log > touching]
    parted = [math.exp(log) for log in sampled.crossings(_PARTED)]
    return SpeedRange(
        math.exp(lowest),
        math.exp(highest),
        tuple(math.exp(log) for log in crossings),
        None if touching is None else math.exp(touching),
        _below(parted, above=bool(ratio[-1] >= 0.0)),
        bool(margin[-1] >= 0.0),
        math.exp(np.min(margin[within])) if np.any(within) else None,
        left_out,
    )


def _below(crossings: Sequence[float], *, above: bool) -> Intervals:
    """Intervals of speed with a value below a limit: its crossings, and its side at the highest speed."""
    ends: list[float | None] = [*crossings]
    if not above:
        ends.append(None)
    if len(ends) % 2:
        ends.insert(0, None)
    return tuple(zip(ends[::2], ends[1::2], strict=True))


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
    changes = changes_of(margins.case)
    found = iter(_margins(margins, margin, [(change, end) for change in changes for end in change.ends]))
    for change, low, high in zip(changes, found, found, strict=True):
        error = next((one for one in (low, high) if isinstance(one, InputError)), None)
        if error is None:
            effects.append(Effect(change.key, change.label, *change.ends, low, high))
        else:
            left_out.append(f"{change.label}: {error}")
    effects.sort(key=lambda effect: -effect.size)
    return tuple(effects), tuple(left_out)


def _margins(margins: QuickMargins, margin: float, ends: Sequence[tuple[Change, float]]) -> list[Any]:
    """Margins at the ends of changed inputs, each or the error of why it has none."""
    others = [change.changes(end) for change, end in ends if not proportional_to_strength(change.key)]
    points = iter(margins.at_all(others))
    found: list[Any] = []
    for change, end in ends:
        if proportional_to_strength(change.key):
            found.append(margin * end / change.value)
        else:
            point = next(points)
            found.append(point if isinstance(point, InputError) else point.margin)
    return found


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
    points = margins.at_all([worst, best])
    for point in points:
        if isinstance(point, InputError):
            raise point
    lowest, highest = (point.margin for point in points if isinstance(point, MarginPoint))
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
        """Speed of the inner ring below which the margin is below 1 [rad/s]; None where there is none."""
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
    """Analyse the margin of a solved bearing, by some thirty bearings with quick contacts, in half a second.

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
    solution: BearingSolution,
    analysis: MarginAnalysis,
    chance: Chance | None = None,
    *,
    unknown: str = "",
) -> Verdict:
    """Verdict on a solved bearing; grey where the numbers must not be used, and without a strength or a shaft
    voltage. Of ceramic elements it is about the voltage that they insulate.

    The level follows the probability of breakdown, ``chance``, where it is known. Otherwise the margin may
    lie anywhere between its values at the ends of the stated ranges. Estimated errors of films
    widen this interval, and ``formula_factor`` for contacts by formula. With a Weibull law its lower end is
    that at a probability of 5 %. Without a stated range of the strength, a margin that a change of the
    strength by 20 % takes across 1 is yellow, too. ``unknown``, reason for which the probability has no
    value, though the bearing has a margin: no such verdict is green. The levels and first words follow
    ``breakdown_rule``.
    """
    warnings = bearing_warnings(solution)
    refused = unusable(warnings)
    if refused or not solution.converged:
        return Verdict("grey", refused or "No verdict: a contact of the bearing is not converged.")
    state = lubrication(solution)
    if solution.conditions.ceramic:
        return _of_ceramics(solution)
    if state == "conducting":
        level, lead = touching_rule(chance, driven=solution.case.motor is not None)
        return Verdict(level, _touching_text(solution, lead, chance))
    breakdown, shaft = breakdown_of(solution), shaft_voltage(solution)
    if breakdown is None:
        known = "" if shaft is None else f" The shaft voltage is {readable(shaft)} V {_at(solution)}."
        return Verdict("grey", f"No verdict: no dielectric strength given, no breakdown voltage.{known}")
    first = f"first breakdown at {readable(breakdown.shaft_first_break)} V"
    if shaft is None:
        return Verdict(
            "grey",
            f"No verdict: {first} {_at(solution)}, but no shaft voltage is known without [motor]. "
            + _assumptions(solution),
        )
    warned = [*doubts_of(warnings), *filter(None, [_unknown(unknown)])]
    return _judged(solution, analysis, breakdown, shaft, warned, chance)


def _unknown(reason: str) -> str:
    """Sentence about a probability without a value; empty without a reason."""
    return f"The probability of breakdown is not known: {reason}." if reason else ""


def _touching_text(solution: BearingSolution, lead: str, chance: Chance | None) -> str:
    """Verdict on a bearing whose surfaces touch, in sentences."""
    likely = ""
    if chance is not None and chance.first:
        likely = f" The probability of breakdown, which counts touching surfaces, is {chance.text}."
    return (
        f"{lead}: {_how_touching(solution)} {_at(solution)} (lambda ratio {lambda_text(solution)}), "
        f"{regime_clause(duty_of(solution))}. {_OPENING}, and no voltage is computed for that. This is no "
        f"protection: current passes, and arcs are likely.{likely}"
    )


def _of_ceramics(solution: BearingSolution) -> Verdict:
    """Verdict on a bearing with ceramic elements, through which no film discharges: whether they insulate the
    voltage on them, with a strength that is as uncertain as one without a stated range.
    """
    voltage, most, element = (
        element_voltage(solution),
        element_breakdown(solution),
        solution.conditions.element,
    )
    touch = lubrication(solution) == "touching"
    touching = f" Surfaces touch (lambda ratio {lambda_text(solution)})." if touch else ""
    if most is None or element.dielectric_strength is None:
        return Verdict("grey", f"No verdict: no strength of the insulating elements is known.{touching}")
    insulates = f"insulates at least {amount(float(f'{most:.2g}'), 'V')}"
    ends = " to ".join(readable(1e-6 * end) for end in strength_interval(element.dielectric_strength))
    why = f"{element.strength_of}, ± {100.0 * STRENGTH_UNKNOWN:.0f} %"
    assumed = f" Best estimate: strength of the ceramic {ends} V/µm ({why})"
    assumed = f"{assumed}{equal_bearings_clause(solution.case)}."
    if voltage is None:
        no_voltage = "but no shaft voltage is known without [motor]"
        return Verdict(
            "grey", f"No verdict: each ceramic element {insulates}, {no_voltage}.{touching}{assumed}"
        )
    sure, bound = strength_interval(most / voltage)[0] >= 1.0, capacitance_is_bound(solution)
    return Verdict(
        "green" if sure else "yellow",
        f"{'No discharge expected' if sure else 'Discharge possible'}: each ceramic element must insulate "
        f"{'at most ' if bound else ''}{readable(voltage)} V {_at(solution)}, and {insulates}. The field "
        "in it is "
        f"at most {readable(1e-6 * (element_field(solution) or 0.0), 2)} V/µm. Films beside such "
        "elements do not "
        f"discharge.{touching}{assumed}",
    )


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
    touching, doubts = [*_at_times(solution)], [*_doubts(solution, analysis, chance), *warned]
    if chance is None:
        level, lead, reasons, interval = _by_ends(solution, analysis, margin)
        reasons = [*touching, *_unfavourable(solution, analysis, margin), *doubts, *reasons]
    else:
        level, lead, interval = chance.level, chance.lead, ""
        known = chance.sentence_with(doubts=bool(doubts) and level == "green")
        reasons = [*touching, *_unfavourable(solution, analysis, margin), *doubts, known]
        reasons += _widths(solution, analysis, margin)
    level, lead = doubted(level, lead, doubts=bool(doubts), touching=bool(touching))
    text = (
        f"{lead}: shaft voltage {readable(shaft)} V, first breakdown at "
        f"{readable(breakdown.shaft_first_break)} V (margin {ratio_text(margin)}{interval}) {_at(solution)}."
    )
    speeds = list(_speeds(analysis.speeds))
    shares, leaks = _coating(solution, shaft), _leaks(solution)
    sentences = filter(None, [text, shares, *speeds, *reasons, leaks, _assumptions(solution)])
    return Verdict(level, " ".join(sentences), margin)


def _by_ends(
    solution: BearingSolution, analysis: MarginAnalysis, margin: float
) -> tuple[Level, str, list[str], str]:
    """Level, first words, reasons and interval of a verdict from the smallest and the largest margin."""
    reasons: list[str] = []
    low, high = _widened(solution, *_stated(solution, analysis, margin))
    # Without a stated range of the strength a usual one counts.
    strength = not any(one.key.startswith("discharge.") for one in solution.case.ranges or ())
    if strength:
        weakest, strongest = strength_interval(margin)
        low, high = min(low, weakest), max(high, strongest)
    level = level_of(low, high)
    if strength:
        reasons += filter(None, [strength_doubt(solution.case.discharge, margin)])
    reasons += _widths(solution, analysis, margin)
    interval = ""
    if analysis.low is not None and analysis.high is not None:
        interval = (
            f", {ratio_text(analysis.low)} to {ratio_text(analysis.high)} within the stated ranges of inputs"
        )
    return level, lead_of(level, likely=margin < 1.0), reasons, interval


def _coating(solution: BearingSolution, shaft: float) -> str:
    """Sentence about the share of a coating in the shaft voltage [V]; empty without one."""
    share = film_share(solution)
    if share is None or not shaft_path(solution).coated:
        return ""
    return (
        f"Of the shaft voltage {readable(share * shaft)} V ({readable(100.0 * share)} %) are across the "
        "films at high "
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
    """Interval of margins, widened by the accuracy of the films.

    Over summits a margin falls faster than its film. What it loses beyond that is taken off in full from the
    low end, and in proportion added to the high end, so that the interval is rather too wide.
    """
    thin, thick = film_factors(solution.case, float(film_error(solution)))
    if not solution.case.bearing.summit_height:
        return low * thin, high * thick
    margins, own = margin_with_films(solution, np.array([thin, thick])), first_margin(solution)
    assert own is not None
    lowest = low * thin - (own * thin - float(margins[0]))
    return max(lowest, 0.0), high * float(margins[1]) / own


def film_factors(case: BearingCase, off: float) -> tuple[float, float]:
    """Ends of the factor on all films of a bearing, which are ``off`` by at most this part, dimensionless."""
    if case.contacts == "formula":
        factor = formula_factor(case.bearing.kind)
        return 1.0 / factor, factor
    return 1.0 - off, 1.0 + off


def _at_times(solution: BearingSolution) -> Iterator[str]:
    """Sentences about surfaces that touch at times."""
    duty = duty_of(solution)
    if lubrication(solution) == "partial film" or duty.regime != "capacitive":
        yield (
            f"Surfaces may touch at times (lambda ratio {lambda_text(solution)}): {regime_clause(duty)}. "
            f"Voltages are upper bounds. {_OPENING}, which is not computed."
        )


def _doubts(solution: BearingSolution, analysis: MarginAnalysis, chance: Chance | None) -> Iterator[str]:
    """Sentences about ranges that neither the interval of the margin nor its probability contains.

    An estimate of the probability at once does not contain what changes the films.
    """
    whole = chance is not None and chance.first
    if solution.case.ranges and analysis.low is None and not whole:
        yield "The range of the margin could not be computed from the stated ranges of inputs."
    if chance is not None:
        yield from (f"{text[0].upper()}{text[1:]}." for text in chance.neglected)


def _unfavourable(solution: BearingSolution, analysis: MarginAnalysis, margin: float) -> Iterator[str]:
    """Sentences about a margin that is lower at unfavourable ends of ranges or of a Weibull law.

    The interval of the margin and its probability contain these ends.
    """
    if analysis.low == 0.0:
        yield "At the unfavourable ends of the stated ranges the surfaces touch, at times at least."
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


def _speeds(speeds: SpeedRange | None) -> Iterator[str]:
    """Sentences about the speeds at which the margin is below 1 or surfaces touch; none where no other speed
    was computed. Only the first words of a verdict state how likely a breakdown is.
    """
    if speeds is None or speeds.lowest >= speeds.highest:
        return
    lowest, highest = max(speeds.lowest, speeds.touching or 0.0), speeds.highest
    within = f"at all speeds computed, {rpm_text(lowest)} to {rpm_text(highest)} rpm"
    if speeds.crossings:
        yield f"{_intervals(speeds.broken)} the margin is below 1."
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
            f"Below about {rpm_text(speeds.touching)} rpm the surfaces touch, at times at least: contacts "
            "open and close, discharges are likely, and no voltage is computed."
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


def _how_touching(solution: BearingSolution) -> str:
    """Clause of a bearing without a voltage: its surfaces touch nearly always, or its highest summits do."""
    return "surfaces touch" if lambda_ratio(solution) < CONDUCTING else "the highest summits touch at times"


def _at(solution: BearingSolution) -> str:
    """Speed and temperature of a bearing as text, which names the operating point next to a duty cycle."""
    bearing = solution.case.bearing
    speed, temperature = rpm(bearing.inner_speed), bearing.oil_temperature - 273.15
    point = "" if solution.case.duty is None else "the operating point of "
    return f"at {point}{readable(speed, 4)} rpm, {readable(temperature)} °C"


def _assumptions(solution: BearingSolution) -> str:
    """Sentence about the assumptions behind the breakdown voltage."""
    case, factor = solution.case, solution.conditions.film_factor
    film = f"{'rough' if case.bearing.summit_height else 'smooth'} film"
    films = (
        f"{film} with the given film factor {readable(factor)}, which alone stands for starvation and heat"
    )
    if factor == 1.0:
        films = f"isothermal, fully flooded, {film}"
    elif case.bearing.supply != "flooded":
        films = f"{film} with {supply_words(solution)}"
    elif case.bearing.film_factor == "inlet-shear":
        films = f"fully flooded, {film} with inlet shear heating"
    elif case.bearing.film_factor == "solved":
        films = f"fully flooded, {film} with the solved heat of pure rolling"
    stated = {one.key: (one.low, one.high) for one in case.ranges or ()}
    clause = strength_clause(case.discharge, stated.get("discharge.dielectric_strength"))
    kind = "Upper bound" if case.bearing.bounding else "Best estimate"
    return f"{kind}: {films}; {clause}{equal_bearings_clause(case)}."


def equal_bearings_clause(case: BearingCase) -> str:
    """Clause about the second bearing of the shaft if its capacitance is not given, else empty."""
    if case.motor is None or case.motor.second_bearing_capacitance is not None:
        return ""
    return "; the second bearing of the shaft is taken as equal (for two different bearings: ehlectric drive)"
