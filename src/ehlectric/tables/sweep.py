"""Rows of the table of a sweep: how many points were solved, and why the others were not."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator

from ehlectric.quantities.rows import Row
from ehlectric.sweep.results import SweepResults

# Maximum number of reasons that are shown; sweep.csv has all of them.
_REASONS = 5

# Numbers, in which reasons of the same kind differ.
_NUMBER = re.compile(r"\d[\d.e+-]*")


def sweep_rows(results: SweepResults) -> list[Row]:
    """Rows of the numbers of points of each status, with the reasons of those that are not solved.

    Parameters
    ----------
    results : SweepResults
        Results of a sweep.

    Returns
    -------
    list of Row
        A row for each status, followed by rows for the most frequent reasons of the points with this status.
    """
    rows = []
    for status in ("solved", "not converged", "failed"):
        reasons = [point.reason for point in results.points if point.status == status]
        rows.append(Row(f"points {status}", str(len(reasons)), note=f"of {len(results.points)}"))
        rows += [Row(f"  reason, {_points(count)}", note=reason) for count, reason in _grouped(reasons)]
    return rows


def _points(count: int) -> str:
    return "1 point" if count == 1 else f"{count} points"


def _grouped(reasons: Iterable[str]) -> Iterator[tuple[int, str]]:
    """Most frequent reasons with the number of their points; reasons that differ in numbers are one."""
    groups: dict[str, list[str]] = {}
    for reason in filter(None, reasons):
        groups.setdefault(_NUMBER.sub("", reason), []).append(reason)
    ordered = sorted(groups.values(), key=len, reverse=True)
    for group in ordered[:_REASONS]:
        yield len(group), group[0] if len(set(group)) == 1 else f"for example {group[0]}"
    if others := sum(map(len, ordered[_REASONS:])):
        yield others, "other reasons, see sweep.csv"
