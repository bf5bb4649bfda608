"""Verdict on a drive: whether its bearings discharge."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping
from typing import Any

from ehlectric.bearing import formula_factor
from ehlectric.cases.drive_case import DriveCase
from ehlectric.discharge.breakdown_rule import (
    STRENGTH_UNKNOWN,
    TOUCHING,
    TOUCHING_AT_TIMES,
    TOUCHING_EXPECTED,
    doubted,
)
from ehlectric.discharge.discharge_laws import compared_with_limits
from ehlectric.discharge.film_verdict import DOUBTS, no_verdict, strength_clause, unusable
from ehlectric.drive.drive_record import FEW
from ehlectric.drive.warnings import MOSTLY
from ehlectric.quantities.inputs import ENDS
from ehlectric.quantities.result_warnings import ResultWarning
from ehlectric.quantities.results import NAMES_OF_ENDS
from ehlectric.quantities.statement import Bound, Fact, Level, Statement
from ehlectric.quantities.verdict import Verdict
from ehlectric.readable import readable

# Discharges in a second, by Weibull's law at the largest voltage, up to which none is expected: one a minute,
# where a drive that discharges does so thousands of times in a second.
SELDOM = 1.0 / 60.0

# Warnings for which a film may break down at a lower voltage.
_DOUBTS = (*DOUBTS, "partial-film")

# Codes of a verdict by its level, in the order of their severity.
CODES_OF_LEVELS: Mapping[Level, str] = {
    "grey": "none",
    "green": "discharge-excluded",
    "yellow": TOUCHING_AT_TIMES,
    "red": TOUCHING_EXPECTED,
}
_ORDER = tuple(CODES_OF_LEVELS)


def drive_verdict(case: DriveCase, summary: Mapping[str, Any], warnings: Iterable[ResultWarning]) -> Verdict:
    """Verdict on a solved drive.

    It is red where a bearing discharges at least twenty times in the simulated time, or its films conduct for
    a fifth of that time after breakdowns, and would at a 20 % higher strength.
    """
    warnings = tuple(warnings)
    codes = {warning.code for warning in warnings}
    refused = unusable(warnings)
    if refused is not None:
        return refused
    if not summary["converged"]:
        return no_verdict(Statement.of("film-not-converged"))
    part = weakest_part(case, formula="formula-contacts" in codes)
    ends = [summary[end] for end in ENDS]
    levels = [_level(end, summary["source"]["peak"], part) for end in ends]
    events, arcs = sum(end["events"] for end in ends), any(end["burning_time_share"] for end in ends)
    doubts = [] if events else [Statement.of("warning", code=code) for code in _DOUBTS if code in codes]
    if not events:
        doubts += voltages_doubted(case, summary)
    level: Level = max(levels, key=_ORDER.index)
    touching = "partial-film" in codes and not events
    level, code = doubted(level, CODES_OF_LEVELS[level], doubts=bool(doubts), touching=touching, drive=True)
    reasons = [*_touching(ends), *_harm(case, ends), *([] if arcs else doubts)]
    answer, bound = _none(summary, part), _bound(case)
    if events or arcs:
        code = TOUCHING if level == "yellow" and events >= FEW else code
        answer, bound = _rates(summary), ""
        reasons = [*_doubts_of_rates(ends, level), *reasons]
    assumed = tuple(_assumptions(case, codes, films=bool(bound)))
    if all(end["breakdown_voltage"] is None for end in ends):
        assumed, bound = (), ""
    facts = (Fact("drive.events_per_second", summary["drive"]["events_per_second"]),)
    return Verdict(level, code, answer, None, facts, tuple(reasons), assumed, bound)


def voltages_doubted(case: DriveCase, summary: Mapping[str, Any]) -> list[Statement]:
    """Statement that voltages are lower bounds, because the capacitance of ceramic elements at one end is an
    upper bound; none where no film breaks down.
    """
    bounded = any(bearing_case.bearing.capacitance_is_bound for bearing_case in case.bearings)
    if not bounded or all(summary[end]["breakdown_voltage"] is None for end in ENDS):
        return []
    return [Statement.of("warning", code="capacitance-bound")]


def weakest_part(case: DriveCase, *, formula: bool) -> float:
    """Lowest strength of the films of a drive that is possible, divided by the strength of its case,
    dimensionless.
    """
    part = 1.0 - STRENGTH_UNKNOWN
    if not formula:
        # Films of the atlas and solved ones are far more exact than the strength is known.
        return part
    return part / max(formula_factor(bearing_case.bearing.kind) for bearing_case in case.bearings)


def _level(end: Mapping[str, Any], source: float, part: float) -> Level:
    """Level of one bearing, with films that break down at a part of their voltage."""
    if end["events"] >= FEW or end["burning_time_share"] > MOSTLY:
        # The voltage that films would see without discharges: thresholds that scatter are reached all the
        # same, others only below it.
        reach = max(end["peak_voltage"], end["voltage_ratio"] * source)
        stronger = most_by_law({**end, "peak_voltage": reach}, 1.0 + STRENGTH_UNKNOWN)
        return "red" if stronger > SELDOM else "yellow"
    if end["events"] or end["burning_time_share"] or end["contact_time_share"]:
        return "yellow"
    return "green" if most_by_law(end, part) <= SELDOM else "yellow"


def most_by_law(end: Mapping[str, Any], part: float = 1.0) -> float:
    """Discharges in a second if the largest voltage lasted, by the law of the threshold [1/s].

    ``part``, strength divided by the strength of the case, dimensionless. Returns upper bound of the rate for
    films that are renewed: the probability that a new film breaks down at the largest voltage, over the time
    between new films; 0 or infinite for a threshold without scatter.

    Examples
    --------
    One of a million films breaks down at 1 V, and 10 000 films are new in a second:

    >>> end = {"peak_voltage": 1.0, "breakdown_voltage": 10.0, "weibull_shape": 6.0, "renewal_time": 1e-4}
    >>> round(most_by_law(end), 5)
    0.01
    """
    at = end["breakdown_voltage"]
    if at is None:
        return 0.0
    ratio = end["peak_voltage"] / (part * at)
    if end["weibull_shape"] is None:
        return math.inf if ratio >= 1.0 else 0.0
    if ratio <= 0.0:
        return 0.0
    # Each new film breaks down long before the exponent is 100.
    exponent = min(end["weibull_shape"] * math.log(ratio), 100.0)
    return float(-math.expm1(-math.exp(exponent))) / float(end["renewal_time"])


def _rates(summary: Mapping[str, Any]) -> Statement:
    """Statement on how often each bearing discharges, with bounds, and with which energy."""
    clauses = []
    for key, name in NAMES_OF_ENDS.items():
        end = summary[key]
        high = end["events_per_second_high"]
        if end["events"]:
            rate = {"rate": end["events_per_second"], "low": end["events_per_second_low"], "high": high}
            clauses.append(Statement.of("rate-of-end", **rate, end=name, energy=end["energy_mean"]))
        else:
            duration = summary["drive"]["duration"]
            clauses.append(Statement.of("no-rate-of-end", duration=duration, end=name, high=high))
    return Statement.of("rates", ends=tuple(clauses))


def _doubts_of_rates(ends: Iterable[Mapping[str, Any]], level: Level) -> Iterator[Statement]:
    """Statements: why discharges are not sure, and arcs that burn on."""
    ends = list(ends)
    if level == "yellow" and any(end["events"] >= FEW for end in ends):
        yield Statement.of("strength-ends", change=STRENGTH_UNKNOWN)
    elif level == "yellow":
        yield Statement.of("few-discharges")
    burning = max(end["burning_time_share"] for end in ends)
    if burning > MOSTLY:
        yield Statement.of("burning", share=burning)


def _harm(case: DriveCase, ends: Iterable[Mapping[str, Any]]) -> Iterator[Statement]:
    """Statements on the current density and its published limits, and that harm is unknown."""
    ends = list(ends)
    densities = [end["current_density"] for end in ends if end["current_density"]]
    if not densities:
        return
    most, arc = max(densities), None
    if any(end["events"] for end in ends):
        arc = Statement.of("given-arc", resistance=case.breakdown.arc_resistance)
    yield Statement.of("current-density", density=most, limits=compared_with_limits(most), arc=arc)
    yield Statement.of("harm-unknown")


def _none(summary: Mapping[str, Any], part: float) -> Statement:
    """Statement that nothing discharged, with the bound of the rate, and the voltages."""
    ends = [summary[end] for end in ENDS]
    return Statement.of(
        "no-discharges",
        duration=summary["drive"]["duration"],
        high=max(end["events_per_second_high"] for end in ends),
        peak=max(end["peak_voltage"] for end in ends),
        films=_films(ends, part),
    )


def _films(ends: list[Mapping[str, Any]], part: float) -> Statement:
    """Clause on the voltage at which films break down, and on the rate that Weibull's law allows."""
    known = [end["breakdown_voltage"] for end in ends if end["breakdown_voltage"] is not None]
    if not known:
        return Statement.of("ceramic-elements")
    law = None
    if any(end["weibull_shape"] is not None for end in ends):
        most = sum(most_by_law(end, part) for end in ends)
        law = Statement.of("weibull-allows", weaker=1.0 - part, most=_seldom(most))
    return Statement.of("films-break-at", breakdown=min(known), law=law)


def _seldom(rate: float) -> str:
    """Rate of rare discharges as text, such as "at most 3 an hour"."""
    for name, seconds in (("a second", 1.0), ("an hour", 3600.0), ("a year", 3.156e7)):
        if rate * seconds >= 1.0:
            return f"at most {readable(rate * seconds)} discharges {name}"
    return "less than one discharge a year"


def _touching(ends: Iterable[Mapping[str, Any]]) -> Iterator[Statement]:
    share = max(end["contact_time_share"] for end in ends)
    if share:
        yield Statement.of("asperities-close", share=share)


def _bound(case: DriveCase) -> Bound:
    """Whether the voltages at which films break down are upper bounds, or best estimates."""
    return "upper" if any(bearing_case.bearing.bounding for bearing_case in case.bearings) else "best"


def _assumptions(case: DriveCase, codes: set[str], *, films: bool) -> Iterator[Statement]:
    """Clauses on the films, where ``films``, and on the strength of the oil of bearings that have one."""
    if films:
        rough = (
            "rough" if all(bearing_case.bearing.summit_height for bearing_case in case.bearings) else "smooth"
        )
        ideal = ("isothermal", "fully flooded") if "isothermal-film" in codes else ()
        yield Statement.of("films-of-drive", words=(*ideal, rough))
    clauses = [
        strength_clause(bearing_case.discharge)
        for bearing_case in case.bearings
        if bearing_case.discharge is not None and bearing_case.discharge.has_strength
    ]
    yield from (clause for place, clause in enumerate(clauses) if clause not in clauses[:place])
