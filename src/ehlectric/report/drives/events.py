"""Largest discharges of a drive in a report."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ehlectric.drive.result import DriveResult
from ehlectric.quantities.drive_results import EVENT_KEYS, NAMES_OF_ENDS
from ehlectric.quantities.formats import number_text
from ehlectric.quantities.units import unit_for
from ehlectric.report.content import Block, Table, Text

# Largest number of discharges that a report lists.
LISTED = 20

# Digits of the largest time: two discharges at the same edge of the source differ in them.
_DIGITS = 6

_SHARES = (0.09, 0.15, 0.17, 0.12, 0.11, 0.12, 0.11, 0.13)


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
        "duration follow from the given resistance and extinction of an arc. events.csv has the others."
    )
    scales = {
        name: unit_for(max(abs(row[name]) for row in listed), about.unit, least=1.0)
        for name, about in EVENT_KEYS.items()
    }
    heads = [f"{EVENT_KEYS[name].label} [{unit}]" for name, (_, unit) in scales.items()]
    digits = _decimals(max(row["time"] for row in listed) * scales["time"][0])
    cells = tuple(
        (
            str(number),
            NAMES_OF_ENDS[row["bearing"]],
            *(
                f"{row[name] * factor:.{digits}f}" if name == "time" else number_text(row[name] * factor)
                for name, (factor, _) in scales.items()
            ),
        )
        for number, row in enumerate(listed, 1)
    )
    numeric = (0, *range(2, 2 + len(scales)))
    heads = ["number", "bearing", *heads]
    yield Table("Discharges with the largest energy", tuple(heads), cells, numeric, shares=_SHARES)


def _decimals(largest: float) -> int:
    """Decimals of numbers up to a largest one, which is at least 1."""
    return max(0, _DIGITS - len(f"{largest:.0f}"))
