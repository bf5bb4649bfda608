"""Verdict on a bearing: whether breakdown is expected at its shaft voltage, and below which speed."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from ehlectric.bearing.accuracy import error_text, film_error
from ehlectric.bearing.breakdown import Breakdown, breakdown_of
from ehlectric.bearing.discharges.leakage import leakage_warnings, shaft_leakage
from ehlectric.bearing.intermittency.duty import duty_of
from ehlectric.bearing.intermittency.words import time_text
from ehlectric.bearing.margin.analysis import MarginAnalysis
from ehlectric.bearing.margin.critical_speed import Intervals, SpeedRange
from ehlectric.bearing.meter.reading import film_share, shaft_path
from ehlectric.bearing.quick.errors import formula_factor
from ehlectric.bearing.quick.ways import is_quick
from ehlectric.bearing.shaft_voltage import shaft_voltage
from ehlectric.bearing.solution import BearingSolution, lambda_text, lubrication
from ehlectric.bearing.supply.warnings import supply_words
from ehlectric.bearing.warnings import bearing_warnings
from ehlectric.cases.bearings.ways import HOW
from ehlectric.discharge.verdict import (
    UNLIKELY,
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
from ehlectric.quantities.formats import amount
from ehlectric.quantities.units import rpm, rpm_text

# Sentence about contacts of asperities, without its full stop.
_OPENING = "Contacts discharge at a low voltage as they open"


def bearing_verdict(solution: BearingSolution, analysis: MarginAnalysis) -> Verdict:
    """Verdict on a solved bearing.

    Parameters
    ----------
    solution : BearingSolution
        Solved bearing.
    analysis : MarginAnalysis
        Analysis of its margin.

    Returns
    -------
    Verdict
        Grey where the numbers must not be used, for ceramic elements, and without a strength or a shaft
        voltage. Red where surfaces touch and the case has a common-mode voltage, yellow where they touch
        without one. At most yellow where they may touch, and yellow where the margin may lie on either side
        of 1.

    Notes
    -----
    The margin may lie anywhere between its values at the ends of the stated ranges. Estimated errors of
    films widen this interval, and ``formula_factor`` for contacts by formula. With a Weibull law its
    lower end is that at a probability of 5 %. Without a stated range of the strength, a margin that a change
    of the strength by 20 % takes across 1 is yellow, too.
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
    return _judged(solution, analysis, breakdown, shaft, doubts_of(warnings))


def _judged(
    solution: BearingSolution,
    analysis: MarginAnalysis,
    breakdown: Breakdown,
    shaft: float,
    warned: Iterable[str],
) -> Verdict:
    """Verdict on a bearing with a margin, with the doubts that its warnings tell."""
    margin = breakdown.shaft_first_break / shaft
    low, high = _possible(solution, analysis, margin)
    strength = _strength_is_open(solution)
    if strength:
        weakest, strongest = strength_interval(margin)
        low, high = min(low, weakest), max(high, strongest)
    level = level_of(low, high)
    doubts = [*_doubts(solution, analysis, margin), *warned]
    if doubts and level == "green":
        level = "yellow"
    if strength:
        doubts += filter(None, [strength_doubt(solution.case.discharge, margin)])
    reasons = [*doubts, *_widths(solution, analysis, margin)]
    interval = ""
    if analysis.low is not None and analysis.high is not None:
        interval = (
            f", {ratio_text(analysis.low)} to {ratio_text(analysis.high)} within the stated ranges of inputs"
        )
    text = (
        f"{lead_of(level, margin)}: shaft voltage {shaft:.3g} V, first breakdown at "
        f"{breakdown.shaft_first_break:.3g} V (margin {ratio_text(margin)}{interval}) {_at(solution)}."
    )
    speeds = list(_speeds(analysis.speeds, level))
    shares, leaks = _coating(solution, shaft), _leaks(solution)
    sentences = filter(None, [text, shares, *speeds, *reasons, leaks, _assumptions(solution)])
    return Verdict(level, " ".join(sentences), margin)


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
    if found is None or not any(leakage_warnings(solution)):
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


def _possible(solution: BearingSolution, analysis: MarginAnalysis, margin: float) -> tuple[float, float]:
    """Smallest and largest margin that are possible."""
    return _widened(solution, *_stated(solution, analysis, margin))


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


def _strength_is_open(solution: BearingSolution) -> bool:
    """Whether the case states no range of the strength, so that a usual one counts."""
    return not any(one.key.startswith("discharge.") for one in solution.case.ranges or ())


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
    return f"Upper bound: {films}; {clause}."
