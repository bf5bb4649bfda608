"""Rows of the table of a sweep: how many points were solved, and why the others were not."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator

from ehlectric.cases.row import Row
from ehlectric.sweep.results import SweepResults

# Largest number of reasons that are shown; sweep.csv has all of them.
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
        Rows without a name are reasons, with the number of their points.
    """
    rows = []
    for status in ("solved", "not converged", "failed"):
        reasons = [point.reason for point in results.points if point.status == status]
        of_all = f"of {len(results.points)} points" if status == "solved" else ""
        rows.append(Row(status, str(len(reasons)), note=of_all))
        rows += [Row("", str(count), note=reason) for count, reason in _grouped(reasons)]
    return rows


def _grouped(reasons: Iterable[str]) -> Iterator[tuple[int, str]]:
    """Most frequent reasons with the number of their points; reasons that differ in numbers are one."""
    groups: dict[str, list[str]] = {}
    for reason in filter(None, reasons):
        groups.setdefault(_NUMBER.sub("", reason), []).append(reason)
    ordered = sorted(groups.values(), key=len, reverse=True)
    for group in ordered[:_REASONS]:
        yield len(group), group[0] if len(set(group)) == 1 else f"such as: {group[0]}"
    if others := sum(map(len, ordered[_REASONS:])):
        yield others, "for other reasons, which are in sweep.csv"
