"""Table of a sweep."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rich.table import Table

    from ehlectric.sweep.results import SweepResults


# Reasons that are printed; all of them are in the tables.
_REASONS = 5

# What reasons that are alike differ in.
_NUMBER = re.compile(r"\d[\d.e+-]*")


def results_table(results: SweepResults) -> Table:
    """How many points were solved, and why the others were not."""
    from ehlectric.commands.tables.layout import plain_table

    table = plain_table("")
    for status in ("solved", "not converged", "failed"):
        reasons = [point.reason for point in results.points if point.status == status]
        table.add_row(status, str(len(reasons)), f"of {len(results.points)} points" * (status == "solved"))
        for count, reason in _alike(reasons):
            table.add_row("", str(count), reason)
    return table


def _alike(reasons: Iterable[str]) -> Iterator[tuple[int, str]]:
    """How many reasons are alike but for their numbers, with the first of them; the most frequent ones."""
    kinds: dict[str, list[str]] = {}
    for reason in filter(None, reasons):
        kinds.setdefault(_NUMBER.sub("", reason), []).append(reason)
    found = sorted(kinds.values(), key=len, reverse=True)
    for alike in found[:_REASONS]:
        yield len(alike), alike[0] if len(set(alike)) == 1 else f"such as: {alike[0]}"
    if others := sum(map(len, found[_REASONS:])):
        yield others, "for other reasons, which are in sweep.csv"
