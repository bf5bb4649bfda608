"""Largest discharges of a drive in a report."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ehlectric.cases.quantity import unit_for
from ehlectric.drive.keys import EVENT_COLUMNS, NAMES_OF_ENDS
from ehlectric.drive.result import DriveResult
from ehlectric.drive.statistics import number_text
from ehlectric.report.content import Block, Table, Text

# Largest number of discharges that a report lists.
LISTED = 20

_NAMES = {"time": "time of the breakdown", "peak_current": "peak current"}


def event_blocks(result: DriveResult) -> Iterator[Block]:
    """Table of the discharges with the largest energy, and sentences about the others.

    Parameters
    ----------
    result : DriveResult
        Result of a drive.
    """
    rows = result.events()
    total = int(np.sum(result.solution.record.counts))
    if not rows:
        yield Text("No film broke down in the simulated time.")
        return
    listed = sorted(rows, key=lambda row: row["energy"], reverse=True)[:LISTED]
    kept = "" if len(rows) == total else f"; they are the largest of the first {len(rows)}, which are stored"
    if total > len(listed):
        yield Text(f"The {len(listed)} discharges with the largest energy of {total}{kept}.")
    yield Text(
        "Voltage and charge have the sign of the shaft against the housing. Charge, energy, current and "
        "duration follow from the given resistance and extinction of an arc. events.csv has all discharges."
    )
    scales = {
        name: unit_for(max(abs(row[name]) for row in listed), unit, least=1.0)
        for name, unit in EVENT_COLUMNS.items()
    }
    heads = [f"{_NAMES.get(name, name)} [{unit}]" for name, (_, unit) in scales.items()]
    cells = tuple(
        (
            str(number),
            NAMES_OF_ENDS[row["bearing"]],
            *(_text(row[name] * factor, name) for name, (factor, _) in scales.items()),
        )
        for number, row in enumerate(listed, 1)
    )
    numeric = (0, *range(2, 2 + len(heads)))
    yield Table("Discharges with the largest energy", ("number", "bearing", *heads), cells, numeric)


def _text(value: float, name: str) -> str:
    """Number of a cell; times have the digits that tell one discharge from the next."""
    return f"{value:.6g}" if name == "time" else number_text(value)
