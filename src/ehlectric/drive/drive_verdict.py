"""Verdict on a drive: whether its bearings discharge, as sentences and as a colour."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping
from typing import Any

from ehlectric.bearing.quick_contacts import formula_factor
from ehlectric.cases.drive_case import DriveCase
from ehlectric.discharge.breakdown_rule import (
    STRENGTH_UNKNOWN,
    TOUCHING,
    TOUCHING_AT_TIMES,
    TOUCHING_EXPECTED,
    Level,
    doubted,
)
from ehlectric.discharge.discharge_laws import beside_limits
from ehlectric.discharge.film_verdict import DOUBTS, Verdict, strength_clause, unusable
from ehlectric.drive.drive_record import FEW
from ehlectric.drive.warnings import MOSTLY
from ehlectric.errors import CODES, ResultWarning
from ehlectric.quantities.formats import amount
from ehlectric.quantities.inputs import ENDS
from ehlectric.quantities.results import NAMES_OF_ENDS
from ehlectric.readable import readable

# Discharges in a second, by Weibull's law at the largest voltage, up to which none is expected: one a minute,
# where a drive that discharges does so thousands of times in a second.
SELDOM = 1.0 / 60.0

# Warnings for which a film may break down at a lower voltage.
_DOUBTS = (*DOUBTS, "partial-film")

_UNSOLVED = "No verdict: a film is not converged, and the numbers must not be used."
_HARM = "How much currents damage raceways and oil is not computed."
_OPENING = "contacts discharge as they open, which is not computed"

# First words of a verdict by its level, in the order of their severity.
LEADS: Mapping[Level, str] = {
    "grey": "No verdict",
    "green": "No discharge expected",
    "yellow": TOUCHING_AT_TIMES,
    "red": TOUCHING_EXPECTED,
}
_ORDER = tuple(LEADS)


def drive_verdict(case: DriveCase, summary: Mapping[str, Any], warnings: Iterable[ResultWarning]) -> Verdict:
    """Verdict on a solved drive.

    It is red where a bearing discharges at least twenty times in the simulated time, or its films conduct for
    a fifth of that time after breakdowns, and would at a 20 % higher strength.
    """
    warnings = tuple(warnings)
    codes = {warning.code for warning in warnings}
    refused = unusable(warnings) or ("" if summary["converged"] else _UNSOLVED)
    if refused:
        return Verdict("grey", refused)
    part = weakest_part(case, formula="formula-contacts" in codes)
    ends = [summary[end] for end in ENDS]
    levels = [_level(end, summary["source"]["peak"], part) for end in ends]
    events, arcs = sum(end["events"] for end in ends), any(end["burning_time_share"] for end in ends)
    doubts = [] if events else [CODES[code].meaning for code in _DOUBTS if code in codes]
    level: Level = max(levels, key=_ORDER.index)
    level, lead = doubted(
        level, LEADS[level], doubts=bool(doubts), touching="partial-film" in codes and not events, drive=True
    )
    if events or arcs:
        lead = TOUCHING if level == "yellow" and events >= FEW else lead
        sentences = [f"{lead}: {_rates(summary)}.", *_doubts_of_rates(ends, level)]
    else:
        sentences = [f"{lead}: {_none(summary, part)}."]
    sentences += [*_touching(ends), *_harm(case, ends), *([] if arcs else doubts)]
    if any(end["breakdown_voltage"] is not None for end in ends):
        sentences += [*([] if events or arcs else [_bound(case, codes)]), _assumption(case)]
    return Verdict(level, " ".join(filter(None, sentences)))


def weakest_part(case: DriveCase, *, formula: bool) -> float:
    """Lowest strength of the films of a drive that is possible, over that of its case, dimensionless."""
    part = 1.0 - STRENGTH_UNKNOWN
    if not formula:
        # Films of the atlas and solved ones are far more exact than the strength is known.
        return part
    return part / max(formula_factor(one.bearing.kind) for one in case.bearings)


def _level(end: Mapping[str, Any], source: float, part: float) -> Level:
    """Level of one bearing, with films that break down at a part of their voltage."""
    if end["events"] >= FEW or end["burning_time_share"] > MOSTLY:
        # The voltage that films would see without discharges: thresholds that scatter are reached all the
        # same, others only below it.
        reach = max(end["peak_voltage"], end["voltage_ratio"] * source)
        stronger = most_by_law({**end, "peak_voltage": reach}, 1.0 + STRENGTH_UNKNOWN)
        return "red" if stronger > SELDOM else "yellow"
    if end["events"] or end["burning_time_share"] or end["touching_time_share"]:
        return "yellow"
    return "green" if most_by_law(end, part) <= SELDOM else "yellow"


def most_by_law(end: Mapping[str, Any], part: float = 1.0) -> float:
    """Discharges in a second if the largest voltage lasted, by the law of the threshold [1/s].

    ``part``, strength over that of the case, dimensionless. Returns upper bound of the rate for films that
    are renewed: the probability that a new film breaks down at the largest voltage, over the time between new
    films; 0 or infinite for a threshold without scatter.

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
    # A threshold that is reached at all is reached in each new film from some voltage on.
    return float(-math.expm1(-(min(ratio, 1e3) ** end["weibull_shape"]))) / float(end["renewal_time"])


def _rates(summary: Mapping[str, Any]) -> str:
    """Clause: how often each bearing discharges, with bounds, and with which energy."""
    duration = amount(summary["drive"]["duration"], "s")
    clauses = []
    for key, name in NAMES_OF_ENDS.items():
        end = summary[key]
        high = readable(end["events_per_second_high"])
        if end["events"]:
            low = readable(end["events_per_second_low"])
            clauses.append(
                f"{readable(end['events_per_second'])} a second ({low} to {high} at 95 %) at the {name}, "
                f"with {_rounded(end['energy_mean'], 'J')} on average"
            )
        else:
            clauses.append(f"none in {duration} at the {name}, at most {high} a second at 95 %")
    return "; ".join(clauses)


def _doubts_of_rates(ends: Iterable[Mapping[str, Any]], level: Level) -> Iterator[str]:
    """Sentences: why discharges are not sure, and arcs that burn on."""
    ends = list(ends)
    if level == "yellow" and any(end["events"] >= FEW for end in ends):
        yield f"A strength that is {100.0 * STRENGTH_UNKNOWN:.0f} % higher would end them."
    elif level == "yellow":
        yield "So few discharges give no certain rate."
    burning = max(end["burning_time_share"] for end in ends)
    if burning > MOSTLY:
        yield f"After breakdowns the films conduct for {readable(100.0 * burning)} % of the time."


def _harm(case: DriveCase, ends: Iterable[Mapping[str, Any]]) -> Iterator[str]:
    """Sentences: current density beside its published limits, what it rests on, and that harm is unknown."""
    ends = list(ends)
    densities = [end["current_density"] for end in ends if end["current_density"]]
    if not densities:
        return
    most = max(densities)
    text = f"The largest current over the Hertz areas is {readable(1e-6 * most)} A/mm², {beside_limits(most)}"
    if any(end["events"] for end in ends):
        arc = amount(case.breakdown.arc_resistance, "Ω")
        text += f"; energies and currents follow from the given arc of {arc}"
    yield f"{text}."
    yield _HARM


def _none(summary: Mapping[str, Any], part: float) -> str:
    """Clause: that nothing discharged, the bound of the rate, and how far the voltage is from the films'."""
    ends = [summary[end] for end in ENDS]
    high = max(end["events_per_second_high"] for end in ends)
    peak = max(end["peak_voltage"] for end in ends)
    known = [end["breakdown_voltage"] for end in ends if end["breakdown_voltage"] is not None]
    text = (
        f"none in {amount(summary['drive']['duration'], 's')}, so that there are at most {readable(high)} "
        f"a second in each bearing at 95 %; the largest voltage is {_rounded(peak, 'V')}"
    )
    if not known:
        return f"{text}, and the elements are ceramic"
    text += f", and the films break down at {readable(min(known))} V"
    if all(end["weibull_shape"] is None for end in ends):
        return text
    most = sum(most_by_law(end, part) for end in ends)
    weaker = f"{100.0 * (1.0 - part):.0f} % weaker"
    return f"{text}. With films that are {weaker}, Weibull's law allows {_seldom(most)} of both bearings"


def _rounded(value: float, unit: str) -> str:
    """Value with three digits in a unit that suits it."""
    return amount(float(f"{value:.3g}"), unit)


def _seldom(rate: float) -> str:
    """Rate of rare discharges as text, such as "at most 3 an hour"."""
    for name, seconds in (("a second", 1.0), ("an hour", 3600.0), ("a year", 3.156e7)):
        if rate * seconds >= 1.0:
            return f"at most {readable(rate * seconds)} discharges {name}"
    return "less than one discharge a year"


def _touching(ends: Iterable[Mapping[str, Any]]) -> Iterator[str]:
    share = max(end["touching_time_share"] for end in ends)
    if share:
        yield f"Asperities close the films for {readable(100.0 * share)} % of the time: {_OPENING}."


def _bound(case: DriveCase, codes: set[str]) -> str:
    films = f"{'rough' if all(one.bearing.summit_height for one in case.bearings) else 'smooth'} films"
    films = f"isothermal, fully flooded, {films}" if "isothermal-film" in codes else films
    kind = "Upper bound" if any(one.bearing.bounding for one in case.bearings) else "Best estimate"
    return f"{kind}: the voltages at which films break down are those of {films}."


def _assumption(case: DriveCase) -> str:
    """Sentence about the strength of the oil; empty where no bearing has one, as with ceramic elements."""
    told = dict.fromkeys(
        strength_clause(one.discharge)
        for one in case.bearings
        if one.discharge is not None and one.discharge.has_strength
    )
    text = "; ".join(told)
    return f"{text[0].upper()}{text[1:]}." if text else ""
