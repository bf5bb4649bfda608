"""Margin against breakdown: critical speed, sensitivity and range."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass, field, replace
from functools import partial
from typing import Any

import numpy as np

from ehlectric.arrays import Array, Numbers
from ehlectric.bearing.bearing_discharges import (
    first_margin,
    margin_apart,
    with_films_scaled,
)
from ehlectric.bearing.perturbed_bearings import (
    AT_CASE,
    PARTS,
    Sampled,
    Several,
    alike,
    at_speeds,
    log_of,
    over_parts,
    solve_several,
)
from ehlectric.bearing.quick_contacts import formula_factor, is_quick, required_quick_case
from ehlectric.bearing.solution import (
    BearingSolution,
    contact_limit,
    full_film_limit,
    insulating,
    lambda_ratio,
)
from ehlectric.bearing.solving import NOT_IN_FILMS, quick_solution
from ehlectric.bearing.uncertain_inputs import (
    Change,
    changes_of,
    proportional_to_strength,
    temperature_is_unused,
)
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.errors import InputError
from ehlectric.quantities.formats import speed_text

# Inputs of strength laws that only solved contacts have: others replace them by a constant strength.
ONLY_SOLVED = ("discharge.weibull.shape", "discharge.weibull.reference_area")


# Reason for which a bearing with a margin has none at changed inputs.
TOUCHING_ALREADY = "without solved contacts asperity contact is frequent already in the case itself"


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
    solved: MarginPoint  # margin and lambda ratio of the solution
    # margin_factor and lambda_factor: margin and lambda ratio of the solution divided by the values of
    # bearings that are solved together, dimensionless. Their films are taken to be ``lambda_factor`` times as
    # thick.
    margin_factor: float
    lambda_factor: float
    quick_case: BearingCase = field(repr=False)  # case with estimated contacts, whose films are scaled
    quick: BearingSolution = field(repr=False)  # solution with estimated contacts at the inputs of the case
    quick_scale: float  # lambda ratio of the solution divided by the ratio of ``quick``, dimensionless
    # Margin of the solution divided by the margin of ``quick`` with films so much thicker, dimensionless.
    quick_factor: float

    @classmethod
    def of(cls, solution: BearingSolution) -> QuickMargins:
        """Margins from estimated contacts, scaled to the margins of a solution. Raises InputError where the
        solution has no margin, or the formulas have none for the same inputs.

        If the surfaces touch, the margins of much thicker films are compared instead.
        """
        touching = not np.any(insulating(solution))
        margin = 0.0 if touching else _margin_of(solution)
        solved = MarginPoint(float(margin), float(lambda_ratio(solution)))
        case = _quick(solution.case)
        _, several = over_parts(case)
        if AT_CASE in several.reasons:
            raise InputError.worded(None, several.reasons[AT_CASE])
        ratio = several.columns(lambda at: (lambda_ratio(at),), 1)[0, AT_CASE]
        quick = solution if is_quick(solution.case) else quick_solution(case)
        scale, quick_scale = (
            float(solved.lambda_ratio / ratio),
            float(solved.lambda_ratio / lambda_ratio(quick)),
        )
        case = with_films_scaled(case, scale)
        scaled = replace(quick, case=with_films_scaled(quick.case, quick_scale))
        if touching:
            margin = _known(margin_apart(solution))
            coarse = over_parts(case)[1].columns(lambda at: (margin_apart(at),), 1)[0, AT_CASE]
            whole = _known(margin_apart(scaled))
        else:
            coarse = over_parts(case)[1].columns(margin_and_lambda, 2)[0, AT_CASE]
            whole = margin_and_lambda(scaled)[0]
        if not coarse * whole:
            raise InputError.worded(None, TOUCHING_ALREADY)
        factor, quick_factor = float(margin / coarse), float(margin / whole)
        return cls(solution.case, solved, factor, scale, case, quick, quick_scale, quick_factor)

    def at(self, changes: Mapping[str, Any]) -> MarginPoint:
        """Margin and lambda ratio with changed inputs, scaled to the solution. Returns scaled values; the
        margin is 0 where the surfaces touch. Raises InputError where the changed inputs make no valid case,
        or one that needs solved contacts.
        """
        (point,) = self.at_all([changes])
        if isinstance(point, InputError):
            raise point
        return point

    def at_all(self, changes: Sequence[Mapping[str, Any]]) -> list[MarginPoint | InputError]:
        """Margins and lambda ratios at several changes of the inputs, which are solved together.

        Returns for each change what ``at`` returns, or the error that it raises.
        """
        points: dict[int, MarginPoint | InputError] = {}
        films: dict[int, BearingCase] = {}
        others: dict[int, BearingCase] = {}
        for place, changed in enumerate(changes):
            try:
                case = self._changed(changed)
                if all(key.startswith(NOT_IN_FILMS) for key in changed):
                    others[place] = case
                else:
                    films[place] = _quick(case)
            except InputError as error:
                points[place] = error
        for known, solve in ((others, self._at_same_films), (films, self._with_films)):
            for places, case in alike(list(known.values())):
                numbers = np.array(list(known))[places].tolist()
                try:
                    points |= zip(numbers, solve(case), strict=True)
                except InputError as error:
                    points |= dict.fromkeys(numbers, error)
        return [points[place] for place in range(len(changes))]

    def _at_same_films(self, case: BearingCase) -> list[MarginPoint | InputError]:
        """Points of a case with arrays on which the films do not depend."""
        margin, _ = margin_and_lambda(replace(self.quick, case=with_films_scaled(case, self.quick_scale)))
        ratio = self.solved.lambda_ratio * self.case.bearing.composite_rq / case.bearing.composite_rq
        columns = self.quick_factor * margin, ratio, np.ones(case.shape)
        return [MarginPoint(*pair) for pair in np.stack(np.broadcast_arrays(*columns)[:2], axis=-1).tolist()]

    def _with_films(self, case: BearingCase) -> list[MarginPoint | InputError]:
        """Points of a case with arrays, whose films are solved."""
        several = solve_several(with_films_scaled(case, self.lambda_factor))
        points = [MarginPoint(*pair) for pair in self._scaled(several).T.tolist()]
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
    """Case with estimated contacts, with a constant strength where they need one."""
    return required_quick_case(case, constant=True)[0]


def margin_and_lambda(solution: BearingSolution) -> tuple[Numbers, Numbers]:
    """Margin and lambda ratio of a solution with estimated contacts, shape (...); a margin of 0 where
    surfaces touch.
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


# Intervals of speed [rad/s]; None instead of an end of the range of speeds.
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
        """Intervals of speed with a margin below 1 [rad/s]; None instead of an end of the range.

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


# Quantities that cross 0 over the speed: logarithm of the margin, and logarithms of the lambda ratio divided
# by the values below which surfaces touch at times, and below which they touch.
_MARGIN, _PARTED, _TOUCHING = range(3)


def speed_range(margins: QuickMargins) -> SpeedRange:
    """Speeds at which the margin of a bearing crosses 1, from a tenth of the speed of the case to four times
    it.

    The temperature is the temperature of the case at all speeds. The margin is computed at a series of
    speeds, and at more near each crossing, until it lies between two speeds that are 0.2 % apart.
    """
    at_case = margins.case.bearing.inner_speed
    speeds, points, reasons = margins.over_parts()
    left_out = tuple(
        f"speed {speed_text(at_case * PARTS[place], 4)}: {reason}"
        for place, reason in sorted(reasons.items())
    )
    known = np.isfinite(points[1])
    # The bearing itself has a result, which is exact.
    known[AT_CASE] = True
    points[:, AT_CASE] = margins.solved.margin, margins.solved.lambda_ratio
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
    limits = full_film_limit(summit_height), contact_limit(summit_height)
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

    key: str  # dotted key of the input; for the load the larger component, where both change together
    label: str
    # low_input and high_input: smaller and larger value of the input, SI units.
    low_input: float
    high_input: float
    # low_margin and high_margin: margin at these values, dimensionless; 0 where the surfaces touch.
    low_margin: float
    high_margin: float

    @property
    def size(self) -> float:
        """Size of the effect: logarithm of the margin ratio; infinite where a margin is 0."""
        low, high = sorted((self.low_margin, self.high_margin))
        return math.inf if low <= 0.0 else math.log(high / low)


def effects_of(margins: QuickMargins, margin: float) -> tuple[tuple[Effect, ...], tuple[str, ...]]:
    """Effects of strength, temperature, clearance, load, motor and all inputs with a range on the margin.

    ``margin`` is the margin of the bearing, dimensionless. A range of the file replaces the usual change of
    an input. Returns the effects, the largest first, and texts about inputs whose effect could not be
    computed.
    """
    effects, left_out = [], []
    if temperature_is_unused(margins.case):
        left_out.append("temperature: without effect, because lubricant.viscosity is given")
    changes = changes_of(margins.case)
    of_ends = iter(_margins(margins, margin, [(change, end) for change in changes for end in change.ends]))
    for change, low, high in zip(changes, of_ends, of_ends, strict=True):
        error = next((end_margin for end_margin in (low, high) if isinstance(end_margin, InputError)), None)
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
    margins_at_ends: list[Any] = []
    for change, end in ends:
        if proportional_to_strength(change.key):
            margins_at_ends.append(margin * end / change.value)
        else:
            point = next(points)
            margins_at_ends.append(point if isinstance(point, InputError) else point.margin)
    return margins_at_ends


def margin_range(
    margins: QuickMargins, margin: float, effects: Iterable[Effect]
) -> tuple[float, float] | None:
    """Margin with all inputs of ``ranges`` at their unfavourable ends, and at their favourable ends; None
    without.

    The ends are found one input at a time, and then taken together: 2n + 2 bearings with estimated contacts
    for n ranges. The range is wider than an interval of confidence, because all inputs are seldom at their
    worst at once. The smallest margin is 0 where the surfaces touch. Raises InputError where a range has no
    effect on estimated contacts, or one of both cases cannot be computed.
    """
    by_key = {effect.key: effect for effect in effects}
    ranges = margins.case.ranges or ()
    if not ranges:
        return None
    worst: dict[str, float] = {}
    best: dict[str, float] = {}
    for entry in ranges:
        effect = by_key.get(entry.key)
        if effect is None:
            raise InputError.worded(f"ranges.{entry.key}", "its ends have no margin without solved contacts")
        ends = {entry.low: effect.low_margin, entry.high: effect.high_margin}
        # The value of the case counts as well, as it may lie outside of its range or at the top of a curve.
        low, high = min(ends, key=ends.__getitem__), max(ends, key=ends.__getitem__)
        if ends[low] < margin:
            worst[entry.key] = low
        if ends[high] > margin:
            best[entry.key] = high
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
            "asperity_contact_speed": None if speeds is None else speeds.touching,
            "lowest_speed": None if speeds is None else speeds.lowest,
            "highest_speed": None if speeds is None else speeds.highest,
            "low": self.low,
            "high": self.high,
            "effects": [asdict(effect) for effect in self.effects],
            "left_out": list(self.left_out),
        }


def analyse_margin(solution: BearingSolution) -> MarginAnalysis:
    """Analyse the margin of a solved bearing, by about thirty bearings with estimated contacts, in half a
    second.

    The analysis has no values where the bearing has no margin, or its films must not be used.
    """
    first = first_margin(solution)
    margin = None if first is None else float(first)
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


def film_factors(case: BearingCase, off: float) -> tuple[float, float]:
    """Ends of the factor on all films of a bearing, which are ``off`` by at most this part, dimensionless."""
    if case.contacts == "formula":
        factor = formula_factor(case.bearing.kind)
        return 1.0 / factor, factor
    return 1.0 - off, 1.0 + off
