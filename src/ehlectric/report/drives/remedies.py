"""Remedies of a drive in a report: what each of them changes, and their numbers side by side."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from ehlectric.cases.changes import flattened
from ehlectric.cases.drives.case import DriveCase
from ehlectric.cases.input_keys import of_both_ends
from ehlectric.drive.result import DriveResult
from ehlectric.drive.verdict import drive_verdict
from ehlectric.errors import CODES, printable
from ehlectric.quantities.drive_results import NAMES_OF_ENDS
from ehlectric.quantities.sheets import REMEDIES
from ehlectric.report.content import Block, Table, Text
from ehlectric.report.facts import unbroken
from ehlectric.report.light import light_of
from ehlectric.report.origins import input_text
from ehlectric.tables.drive import remedy_cells, remedy_heads

AS_IT_IS = "as it is"


def remedy_blocks(result: DriveResult, summary: Mapping[str, Any]) -> Iterator[Block]:
    """Tables of the remedies: what they change, and their numbers beside those of the drive as it is.

    Parameters
    ----------
    result : DriveResult
        Result of a drive with remedies.
    summary : mapping
        Its summary.
    """
    yield Text(
        "Each remedy is a copy of the drive with the changes below, simulated with the same random numbers. "
        "Remedies whose bounds overlap can hardly be told apart in the simulated time. Where films cannot "
        "break down, the voltage stays on the shaft, and may reach the bearings of the driven machine."
    )
    changes = tuple(
        row
        for title, changes, found in result.remedies
        for row in _changes(result.case, found.case, title, changes)
    )
    heads = ("remedy", "input", AS_IT_IS, "with the remedy")
    yield Table("What each remedy changes", heads, changes, shares=(0.25, 0.39, 0.18, 0.18))
    drives = [(AS_IT_IS, result, summary)]
    for title, _, found in result.remedies:
        one = DriveResult(found)
        drives.append((title, one, one.summary()))
    known = {warning.code for warning in result.warnings}
    verdicts = tuple((printable(title), _words(one, own), _further(one, known)) for title, one, own in drives)
    judged = ("drive", "verdict", "further warnings")
    yield Table("Verdict on each remedy", judged, verdicts, shares=(0.25, 0.35, 0.4))
    keys = REMEDIES[0].keys
    rows = tuple(
        (
            printable(title),
            place,
            *map(unbroken, remedy_cells(own, end, keys)),
        )
        for title, _, own in drives
        for end, place in NAMES_OF_ENDS.items()
    )
    columns = ("drive", "bearing", *remedy_heads(keys))
    yield Table(
        "Remedies side by side", columns, rows, tuple(range(2, len(columns))),
        shares=(0.2, 0.14, 0.12, 0.15, 0.1, 0.09, 0.09, 0.11),
    )  # fmt: skip


def _words(result: DriveResult, summary: Mapping[str, Any]) -> str:
    """Heading of the verdict on a drive."""
    verdict = drive_verdict(result.case, summary, result.warnings)
    light = light_of(verdict.level, verdict.text)
    return f"{light.words} ({light.bound})" if light.bound else light.words


def _further(result: DriveResult, known: set[str]) -> str:
    """Meanings of the warnings of a remedy that the drive as it is does not have."""
    codes = dict.fromkeys(warning.code for warning in result.warnings if warning.code not in known)
    return " ".join(CODES[code].meaning for code in codes) or "none"


def _changes(
    case: DriveCase, other: DriveCase, title: str, changes: Mapping[str, Any]
) -> Iterator[tuple[str, ...]]:
    """Rows of the changes of a remedy: its title, the input, and its value in both drives."""
    before, after = (flattened(one.to_dict()) for one in (case, other))
    for key in flattened(dict(changes)):
        first, *_ = of_both_ends(key)
        told = [
            input_text(one, first, tables[first]) if first in tables else "not given"
            for one, tables in ((case, before), (other, after))
        ]
        yield printable(title), key, *told
