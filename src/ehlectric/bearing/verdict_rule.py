"""Verdict on a bearing: whether breakdown is expected at the shaft voltage, and what the answer rests on."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from ehlectric.bearing.bearing_discharges import (
    Breakdown,
    breakdown_of,
    first_margin,
    leakage_warning_conditions,
    margin_with_films,
    shaft_leakage,
    shaft_voltage,
)
from ehlectric.bearing.bearing_touching import behaviour_clause, duty_of
from ehlectric.bearing.ceramic_elements import element_breakdown, element_field, element_voltage
from ehlectric.bearing.film_factor import supply_words
from ehlectric.bearing.impedance import film_share, shaft_path
from ehlectric.bearing.margin import Intervals, MarginAnalysis, SpeedRange, film_factors
from ehlectric.bearing.quick_contacts import is_quick
from ehlectric.bearing.solution import (
    BearingSolution,
    bearing_state,
    capacitance_is_bound,
    conducts,
    film_error,
    lambda_ratio,
    shown_lambda,
)
from ehlectric.bearing.warnings import bearing_warnings
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.cases.defaults import HOW
from ehlectric.discharge.breakdown_rule import (
    STRENGTH_UNKNOWN,
    UNLIKELY,
    Chance,
    code_of,
    doubted,
    level_of,
    strength_interval,
    touching_rule,
)
from ehlectric.discharge.film_verdict import (
    doubts_of,
    no_verdict,
    strength_clause,
    strength_doubt,
    unusable,
    weibull_part,
)
from ehlectric.quantities.lubrication_states import BOUNDARY, MIXED
from ehlectric.quantities.result_warnings import ResultWarning, active
from ehlectric.quantities.statement import Bound, Fact, Level, Statement
from ehlectric.quantities.verdict import Verdict


def bearing_verdict(
    solution: BearingSolution,
    analysis: MarginAnalysis,
    chance: Chance | None = None,
    *,
    unknown: str = "",
    follows: bool = False,
    warnings: Sequence[ResultWarning] | None = None,
) -> Verdict:
    """Verdict on a solved bearing; grey where the numbers must not be used, and without a strength or a shaft
    voltage. Of ceramic elements it is about the voltage that they insulate.

    The level follows the probability of breakdown, ``chance``, where it is known. Otherwise the margin may
    lie anywhere between its values at the ends of the stated ranges. Estimated errors of films
    widen this interval, and ``formula_factor`` for contacts from formulas. With a Weibull law its lower end
    is the margin at a probability of 5 %. Without a stated range of the strength, a margin that a change of
    the strength by 20 % takes across 1 is also yellow. ``unknown``, reason for which the probability has no
    value, though the bearing has a margin: no such verdict is green. ``follows``, whether the range of the
    margin is still to be computed. ``warnings``, warnings about the bearing, where they are known. The levels
    and codes follow ``breakdown_rule``.
    """
    warnings = bearing_warnings(solution) if warnings is None else warnings
    refused = unusable(warnings)
    if refused is not None:
        return refused
    if not solution.converged:
        return no_verdict(Statement.of("bearing-not-converged"))
    if solution.conditions.ceramic:
        return _of_ceramics(solution)
    if conducts(solution):
        return _touching(solution, chance)
    breakdown, shaft = breakdown_of(solution), shaft_voltage(solution)
    at = operating_point(solution.case)
    if breakdown is None:
        known = "no-strength" if shaft is None else "no-strength-shaft"
        return replace(no_verdict(Statement.of(known, shaft=shaft)), at=at)
    if shaft is None:
        answer = Statement.of("no-shaft-voltage", breakdown=breakdown.shaft_first_break)
        return replace(no_verdict(answer), at=at, assumptions=_assumptions(solution), bound=_bound(solution))
    warned = doubts_of(warnings)
    if unknown:
        warned.append(Statement.of("probability-unknown", reason=unknown))
    doubts = [*_doubts(solution, analysis, chance, follows=follows), *warned]
    return _judged(solution, analysis, breakdown, float(shaft), doubts, chance)


def operating_point(case: BearingCase) -> Statement:
    """Speed and temperature of a bearing, which names the operating point next to a duty cycle."""
    code = "at" if case.duty is None else "at-of-cycle"
    return Statement.of(code, speed=case.bearing.inner_speed, temperature=case.bearing.oil_temperature)


def _touching(solution: BearingSolution, chance: Chance | None) -> Verdict:
    """Verdict on a bearing whose surfaces touch, for which no voltage is computed."""
    level, code = touching_rule(chance, driven=solution.case.motor is not None)
    how = "surfaces-touch" if bearing_state(solution) == BOUNDARY.name else "summits-touch"
    ratio, behaviour = shown_lambda(solution), behaviour_clause(duty_of(solution))
    answer = Statement.of("touching", how=Statement.of(how), lambda_ratio=ratio, regime=behaviour)
    reasons: tuple[Statement, ...] = (Statement.of("discharges-as-opening"), Statement.of("no-protection"))
    if chance is not None and chance.first:
        reasons += (Statement.of("probability-of-touching", probability=chance.stated),)
    facts = (Fact("bearing.lambda_ratio", float(lambda_ratio(solution))),)
    return Verdict(level, code, answer, operating_point(solution.case), facts, reasons)


def _of_ceramics(solution: BearingSolution) -> Verdict:
    """Verdict on a bearing with ceramic elements, through which no film discharges: whether they insulate the
    voltage on them, with a strength that is as uncertain as one without a stated range.
    """
    voltage, most = element_voltage(solution), element_breakdown(solution)
    element = solution.conditions.element
    touching: tuple[Statement, ...] = ()
    if bearing_state(solution) == BOUNDARY.name:
        touching = (Statement.of("surfaces-touch-too", lambda_ratio=shown_lambda(solution)),)
    if most is None or element.dielectric_strength is None:
        return replace(no_verdict(Statement.of("no-ceramic-strength")), reasons=touching)
    low, high = strength_interval(element.dielectric_strength)
    strength = Statement.of(
        "ceramic-strength", low=low, high=high, material=element.strength_of, part=STRENGTH_UNKNOWN
    )
    assumed: dict[str, Any] = {
        "at": operating_point(solution.case),
        "reasons": touching,
        "assumptions": (strength, *equal_bearings(solution.case)),
        "bound": "best",
    }
    most = float(f"{most:.2g}")
    if voltage is None:
        return replace(no_verdict(Statement.of("no-ceramic-voltage", most=most)), **assumed)
    margins = strength_interval(float(most / voltage))
    at_most = "at most " if capacitance_is_bound(solution) else ""
    answer = Statement.of(
        "ceramic-insulates", at_most=at_most, voltage=voltage, most=most, field=element_field(solution) or 0.0
    )
    level: Level = "green" if margins[0] >= 1.0 else "yellow"
    code = "discharge-excluded" if level == "green" else "discharge-possible"
    facts = (Fact("bearing.element_voltage", float(voltage)), Fact("bearing.element_breakdown", most))
    return Verdict(level, code, answer, facts=facts, **assumed)


def _judged(
    solution: BearingSolution,
    analysis: MarginAnalysis,
    breakdown: Breakdown,
    shaft: float,
    doubts: list[Statement],
    chance: Chance | None,
) -> Verdict:
    """Verdict on a bearing with a margin; ``doubts`` state what neither its interval nor its probability
    contains.
    """
    first = float(breakdown.shaft_first_break)
    margin = first / shaft
    touching = [*_at_times(solution)]
    reasons = [*touching, *_unfavourable(solution, analysis, margin), *doubts]
    interval = None
    if chance is None:
        level, code, further, interval = _by_ends(solution, analysis, margin)
        reasons += further
    else:
        level, code = chance.level, chance.code
        reasons += chance.statements(doubts=bool(doubts) and level == "green")
        reasons += _widths(solution, analysis, margin)
    level, code = doubted(level, code, doubts=bool(doubts), touching=bool(touching))
    answer = Statement.of("bearing-voltages", shaft=shaft, breakdown=first, margin=margin, interval=interval)
    return Verdict(
        level,
        code,
        answer,
        operating_point(solution.case),
        facts=tuple(_facts(shaft, first, margin, chance)),
        reasons=(*_coating(solution, shaft), *_speeds(analysis.speeds), *reasons, *_leaks(solution)),
        assumptions=_assumptions(solution),
        bound=_bound(solution),
    )


def _facts(shaft: float, first: float, margin: float, chance: Chance | None) -> Iterator[Fact]:
    """Quantities that decide: voltages, the margin, and its probability where it is known."""
    known = chance is not None and chance.first and not chance.failed
    yield Fact("bearing.shaft_voltage", shaft)
    yield Fact("bearing.shaft_first_break", first)
    yield Fact("bearing.margin", margin, (chance.low, chance.high) if known and chance is not None else None)
    if chance is not None and chance.first:
        yield Fact("uncertainty.breakdown_probability", chance.probability, chance.bounds)


def _by_ends(
    solution: BearingSolution, analysis: MarginAnalysis, margin: float
) -> tuple[Level, str, list[Statement], Statement | None]:
    """Level, code, reasons and interval of a verdict from the smallest and the largest margin."""
    reasons: list[Statement] = []
    low, high = _widened(solution, *_stated(solution, analysis, margin))
    # Without a stated range of the strength a usual one counts.
    strength = not any(entry.key.startswith("discharge.") for entry in solution.case.ranges or ())
    if strength:
        weakest, strongest = strength_interval(margin)
        low, high = min(low, weakest), max(high, strongest)
    level = level_of(low, high)
    if strength:
        reasons += strength_doubt(solution.case.discharge, margin)
    reasons += _widths(solution, analysis, margin)
    interval = None
    if analysis.low is not None and analysis.high is not None:
        interval = Statement.of("within-ranges", low=analysis.low, high=analysis.high)
    return level, code_of(level, likely=margin < 1.0), reasons, interval


def _coating(solution: BearingSolution, shaft: float) -> Iterator[Statement]:
    """Statement on the share of a coating in the shaft voltage [V]; none without one."""
    share = film_share(solution)
    if share is not None and shaft_path(solution).coated:
        yield Statement.of("coating-share", films=share * shaft, share=share)


def _leaks(solution: BearingSolution) -> Iterator[Statement]:
    """Statement on films that discharge through the oil within a period; none where they do not."""
    leakage = shaft_leakage(solution)
    if leakage is None or not any(active(leakage_warning_conditions(solution))):
        return
    motor, time = solution.case.motor, leakage.film_time_constant
    frequency = None if motor is None else motor.switching_frequency
    if frequency is None:
        yield Statement.of("leaks-in-common-period", time=time)
    else:
        yield Statement.of("leaks-in-period", period=1.0 / frequency, time=time)


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
    margins, first = margin_with_films(solution, np.array([thin, thick])), first_margin(solution)
    assert first is not None
    margin = float(first)
    lowest = low * thin - (margin * thin - float(margins[0]))
    return max(lowest, 0.0), high * float(margins[1]) / margin


def _at_times(solution: BearingSolution) -> Iterator[Statement]:
    """Statement on surfaces that touch at times."""
    duty = duty_of(solution)
    if bearing_state(solution) == MIXED.name or duty.behaviour != "capacitive":
        ratio = shown_lambda(solution)
        yield Statement.of("touching-at-times", lambda_ratio=ratio, regime=behaviour_clause(duty))


def _doubts(
    solution: BearingSolution, analysis: MarginAnalysis, chance: Chance | None, *, follows: bool
) -> Iterator[Statement]:
    """Statements on ranges that neither the interval of the margin nor its probability contains.

    An estimate of the probability at once does not contain what changes the films.
    """
    whole = chance is not None and chance.first
    if solution.case.ranges and analysis.low is None and not whole:
        yield Statement.of("range-follows" if follows else "range-not-computed")
    if chance is not None:
        yield from (Statement.of("neglected", reason=reason) for reason in chance.neglected)


def _unfavourable(solution: BearingSolution, analysis: MarginAnalysis, margin: float) -> Iterator[Statement]:
    """Statements on a margin that is lower at unfavourable ends of ranges or of a Weibull law.

    The interval of the margin and its probability contain these ends.
    """
    if analysis.low == 0.0:
        yield Statement.of("ranges-touching")
    weibull = solution.case.discharge.weibull
    if weibull is not None:
        unlikely = margin * weibull_part(weibull.shape, UNLIKELY)
        if unlikely < 1.0:
            yield Statement.of("weibull-unlikely", margin=unlikely)


def _widths(solution: BearingSolution, analysis: MarginAnalysis, margin: float) -> Iterator[Statement]:
    """Statement on the accuracy of the films, where it takes the margin or its stated range across 1."""
    intervals = ((margin, margin), _stated(solution, analysis, margin))
    if not any(
        level_of(*ends) != "yellow" and level_of(*_widened(solution, *ends)) == "yellow" for ends in intervals
    ):
        return
    error = film_error(solution)
    if is_quick(solution.case):
        yield Statement.of("quick-films-off", how=HOW[solution.case.contacts], error=error)
    elif error > 0.0:
        yield Statement.of("films-off", error=error)


def _speeds(speeds: SpeedRange | None) -> Iterator[Statement]:
    """Statements on the speeds at which the margin is below 1 or surfaces touch; none where no other speed
    was computed. Only the code of a verdict states how likely a breakdown is.
    """
    if speeds is None or speeds.lowest >= speeds.highest:
        return
    lowest, highest = max(speeds.lowest, speeds.touching or 0.0), speeds.highest
    within = Statement.of("speeds-within", low=lowest, high=highest)
    if speeds.crossings:
        yield Statement.of("speeds-below-1", intervals=_intervals(speeds.broken))
    elif not speeds.above:
        yield Statement.of("all-speeds-below-1", within=within)
    elif speeds.minimum is not None:
        yield Statement.of("speeds-margin", margin=speeds.minimum, within=within)
    if speeds.partial == ((None, None),):
        yield Statement.of("all-speeds-partial", within=within)
    elif speeds.partial:
        yield Statement.of("speeds-partial", intervals=_intervals(speeds.partial))
    if speeds.touching is not None:
        yield Statement.of("speeds-touching", speed=speeds.touching)


def _intervals(ranges: Intervals) -> tuple[Statement, ...]:
    """Clauses with intervals of speed [rad/s], whose open ends are the ends of all computed speeds."""
    return tuple(_interval(low, high) for low, high in ranges)


def _interval(low: float | None, high: float | None) -> Statement:
    if low is None:
        return Statement.of("speeds-below", high=high or 0.0)
    if high is None:
        return Statement.of("speeds-above", low=low)
    return Statement.of("speeds-between", low=low, high=high)


def _bound(solution: BearingSolution) -> Bound:
    """Whether the breakdown voltage is an upper bound, or a best estimate."""
    return "upper" if solution.case.bearing.bounding else "best"


def _assumptions(solution: BearingSolution) -> tuple[Statement, ...]:
    """Clauses on the assumptions behind the breakdown voltage."""
    case = solution.case
    stated = {entry.key: (entry.low, entry.high) for entry in case.ranges or ()}
    clause = strength_clause(case.discharge, stated.get("discharge.dielectric_strength"))
    rough: tuple[Statement, ...] = ()
    if not {"bearing.composite_rq", "bearing.composite_ra"} & stated.keys():
        rough = (Statement.of("exact-roughness", rq=case.bearing.composite_rq),)
    return (_films(solution), clause, *rough, *equal_bearings(case))


def _films(solution: BearingSolution) -> Statement:
    """Clause on the film that is computed."""
    bearing, factor = solution.case.bearing, solution.conditions.film_factor
    rough = "rough" if bearing.summit_height else "smooth"
    heat = _HEAT.get(str(bearing.film_factor))
    if factor == 1.0:
        return Statement.of("films", words=("isothermal", "fully flooded", rough))
    if bearing.supply != "flooded":
        return Statement.of("supplied-films", rough=rough, supply=supply_words(solution))
    if heat is not None:
        return Statement.of("heated-films", rough=rough, heat=heat)
    return Statement.of("given-factor-films", rough=rough, factor=factor)


# Words for the heat of a film by its film factor.
_HEAT = {"inlet-shear": "inlet shear heating", "solved": "the thermal solution for pure rolling"}


def equal_bearings(case: BearingCase) -> tuple[Statement, ...]:
    """Clause about the second bearing of the shaft if its capacitance is not given, else none."""
    if case.motor is None or case.motor.second_bearing_capacitance is not None:
        return ()
    return (Statement.of("equal-bearings"),)
