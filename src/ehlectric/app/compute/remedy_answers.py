"""Answers about a bearing without and with a remedy of its drive."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from ehlectric.app.compute.answer_parts import drive_of
from ehlectric.app.compute.bearing_answers import quick_summary, quick_verdict, solved_quickly, without_cycle
from ehlectric.app.view_models import PENDING, RemedyAnswer, Table
from ehlectric.bearing import BearingResult
from ehlectric.cases.defaults import HOW
from ehlectric.drive import at_shaft_voltage, grounded_verdict, grounded_voltage, with_remedy
from ehlectric.quantities.results import BEARING_BOOK
from ehlectric.quantities.rows import Summary
from ehlectric.quantities.sheets import REMEDIED
from ehlectric.quantities.verdict import Verdict
from ehlectric.readable import capital
from ehlectric.tables.bearing_tables import total_rows

# Text instead of a number that one of both does not have.
_NONE = "–"

# Voltages on the shaft, and those on the films, to which they are equal without a coating.
_WITHOUT_COATING = {
    "bearing.shaft_first_break": "bearing.first_break",
    "bearing.film_voltage": "bearing.shaft_voltage",
}


def quick_remedy(
    table: Mapping[str, Any], drive: Mapping[str, Any], session: Path | None = None
) -> RemedyAnswer:
    """Answer about a bearing and the first remedy of its drive, without what depends on further bearings.

    Raises InputError if the tables are no valid bearing and drive, or its films have to be solved.
    """
    return _answer(table, drive, session, whole=False)


def whole_remedy(
    table: Mapping[str, Any], drive: Mapping[str, Any], session: Path | None = None
) -> RemedyAnswer:
    """Answer as ``quick_remedy`` has it, with critical speeds, ranges and probabilities."""
    return _answer(table, drive, session, whole=True)


def _answer(
    table: Mapping[str, Any], drive: Mapping[str, Any], session: Path | None, *, whole: bool
) -> RemedyAnswer:
    case, driven = without_cycle(table, session), drive_of(drive)
    (remedy, *_), (variant, *_) = driven.remedies, driven.variants()
    ring = variant.running_circuit.grounding_ring_resistance
    result = solved_quickly(case)
    summary, verdict = _numbers(result, whole=whole)
    if ring is None:
        other, other_verdict = _numbers(solved_quickly(with_remedy(case, remedy.changes)), whole=whole)
    else:
        voltage = grounded_voltage(result.solution, ring, variant.source.rise_time or 0.0)
        other = at_shaft_voltage(summary, voltage or 0.0)
        other_verdict = grounded_verdict(other["bearing"]["margin"])
    now, then = (_texts(numbers, whole=whole) for numbers in (summary, other))
    for key, same in _WITHOUT_COATING.items():
        if key in then and same in now:
            now.setdefault(key, now[same])
    rows = [("Verdict", verdict.heading, other_verdict.heading)]
    for key in REMEDIED:
        texts = now.get(key, _NONE), then.get(key, _NONE)
        if texts[0] != texts[1] or PENDING in texts or (key == "bearing.margin" and key in now):
            label = BEARING_BOOK[key].label
            rows.append((capital(label), *texts))
    caption = f"With {remedy.title.lower()}; contacts {HOW[result.case.contacts]}"
    return RemedyAnswer(Table(caption, ("", "now", "with it"), tuple(rows)), whole)


def _numbers(result: BearingResult, *, whole: bool) -> tuple[Summary, Verdict]:
    if whole:
        return result.summary(), result.verdict
    return quick_summary(result), quick_verdict(result)


def _texts(summary: Summary, *, whole: bool) -> dict[str, str]:
    """Texts of the numbers of a bearing by key; those that follow with the whole answer are pending."""
    texts = {row.key: row.amount for row in total_rows(summary)}
    if whole or summary["bearing"]["margin"] is None:
        return texts
    return {key: PENDING for key in REMEDIED if not key.startswith("bearing.")} | texts
