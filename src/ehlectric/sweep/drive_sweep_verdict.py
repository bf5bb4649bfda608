"""Verdict on a sweep of drives: at how many of its points discharges are expected."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator

from ehlectric.cases.drive_case import DriveCase
from ehlectric.discharge.breakdown_rule import TOUCHING_AT_TIMES
from ehlectric.drive import drive_verdict
from ehlectric.quantities.statement import Level, Statement
from ehlectric.quantities.verdict import Verdict
from ehlectric.sweep.points import SweepPoints

# Code of a verdict by its level.
_CODES = {"green": "drives-none", "yellow": "drives-some", "red": "drives-all"}


def swept_verdict(results: SweepPoints) -> Verdict | None:
    """Verdict on a sweep of a drive from the verdicts of its points; None without a solved point. Returns
    green where no point is expected to discharge, red where all are, else yellow; points that are not solved,
    or must not be used, leave neither green nor red.
    """
    case = results.case
    assert isinstance(case, DriveCase)
    counts = Counter(
        drive_verdict(case, point.summary, point.warnings).level
        for point in results.points
        if point.solved and point.summary
    )
    known = sum(counts[level] for level in ("green", "yellow", "red"))
    if not known:
        return None
    missing = len(results.points) - known
    level: Level = "yellow"
    if not missing and max(counts["green"], counts["red"]) == known:
        level = "green" if counts["green"] else "red"
    code = TOUCHING_AT_TIMES if level == "yellow" and not counts["red"] else _CODES[level]
    yellow, green = (
        Statement.of(f"drives-{name}", number=counts[name]) if counts[name] else None
        for name in ("yellow", "green")
    )
    answer = Statement.of("drives-at-points", red=counts["red"], known=known, yellow=yellow, green=green)
    reasons = [Statement.of("drives-missing", missing=missing)] if missing else []
    assumed = (Statement.of("drives-judged"),)
    return Verdict(level, code, answer, reasons=(*reasons, *_rates(results)), assumptions=assumed)


def _rates(results: SweepPoints) -> Iterator[Statement]:
    """Statement on the smallest and the largest rate of discharges."""
    rates = [float(point.usable["drive"]["events_per_second"]) for point in results.points if point.usable]
    if rates:
        yield Statement.of("drives-rates", low=min(rates), high=max(rates))
