"""Numbers and tables of a drive as its page shows them, from the rows that the command prints."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from typing import Any

from ehlectric.app.answers.bearing import Table
from ehlectric.app.answers.number import Number
from ehlectric.app.answers.told import Told, beside
from ehlectric.app.compute.cards import card
from ehlectric.quantities.drive_results import DRIVE_BOOK, NAMES_OF_ENDS
from ehlectric.quantities.rows import Row, Sheet, Summary
from ehlectric.quantities.sheets import DRIVE_CARDS
from ehlectric.tables.drive import Pair, end_cells, side_by_side, whole_rows, worse_cells

# Quantities that a card has in its note.
_BESIDE: Mapping[str, tuple[str, ...]] = {
    "source.peak": ("source.edges_per_second",),
    "circuit.winding_rotor_capacitance": (
        "circuit.rotor_frame_capacitance",
        "circuit.winding_frame_capacitance",
    ),
    "end.events_per_second": ("end.events_per_second_range",),
}

# Why neither bearing has a value.
_NONE = {"end.breakdown_voltage": "ceramic elements insulate"}


def drive_numbers(summary: Summary, sheet: Sheet, told: tuple[Told, ...]) -> tuple[Number, ...]:
    """Numbers of a drive that its page shows large, of those in a sheet, with warnings."""
    whole = {row.key: row for row in whole_rows(summary, sheet)}
    ends = _pairs(summary, sheet)
    keys = [key for key in DRIVE_CARDS if any(key in section.keys for section in sheet)]
    found = [_of_ends(key, ends) if key.startswith("end.") else _of_drive(key, whole) for key in keys]
    if not summary.get("converged", True):
        note = "not converged: do not use this value"
        found = [replace(one, note=note, known=False) for one in found]
    return tuple(replace(one, told=beside(told, one.key)) for one in found)


def merged(told: Iterable[Told]) -> tuple[Told, ...]:
    """Warnings of which those of one code, as of both bearings, are one with both texts."""
    found: dict[str, Told] = {}
    for one in told:
        before = found.get(one.code)
        found[one.code] = one if before is None else replace(before, text=f"{before.text}. {one.text}")
    return tuple(found.values())


def ends_table(summary: Summary, sheet: Sheet) -> Table:
    """Numbers of both bearings side by side, as the command prints them."""
    rows: list[tuple[str, ...]] = []
    for heading, cells in end_cells(summary, sheet):
        rows += [(heading, "", "", ""), *((f"\u2003{name}", *rest) for name, *rest in cells)]
    return Table("As the command prints them", ("", *NAMES_OF_ENDS.values(), ""), tuple(rows))


def remedies_table(summary: Mapping[str, Any]) -> Table | None:
    """The drive and its remedies side by side; None without remedies."""
    if not summary["remedies"]:
        return None
    (_, *heads), *rows = worse_cells(summary)
    return Table("Worse bearing of each", ("", *heads), tuple(rows))


def _pairs(summary: Summary, sheet: Sheet) -> dict[str, Pair]:
    """Rows of both bearings by key."""
    pairs = [pair for _, found in side_by_side(summary, sheet) for pair in found]
    return {next(row.key for row in pair if row is not None): pair for pair in pairs}


def _of_drive(key: str, rows: Mapping[str, Row]) -> Number:
    row = rows[key]
    others = [rows[other] for other in _BESIDE.get(key, ()) if other in rows]
    notes = [row.note.strip(" ,"), *(f"{other.name}: {other.amount}" for other in others)]
    return replace(card(row), note="; ".join(filter(None, notes)))


def _of_ends(key: str, pairs: Mapping[str, Pair]) -> Number:
    """Number of both bearings: that of the drive end, and the other one in its note where it differs."""
    first, second = pairs.get(key, (None, None))
    beside_it = [pairs[other] for other in _BESIDE.get(key, ()) if other in pairs]
    one, other = (
        "; ".join(_texts(row, [pair[k] for pair in beside_it])) for k, row in enumerate((first, second))
    )
    number = card(first) if first is not None else _unknown(key)
    if first is None and second is None:
        return number
    if first is not None and second is not None and (first.text, one) == (second.text, other):
        return replace(number, note="; ".join(filter(None, [one, "each of both bearings"])))
    place, further = NAMES_OF_ENDS.values()
    value = "none" if second is None else second.amount
    own = ", ".join(filter(None, [place, one]))
    return replace(number, note=f"{own}; {further}: {', '.join(filter(None, [value, other]))}")


def _texts(row: Row | None, others: Iterable[Row | None]) -> Iterator[str]:
    """Note of a row, and the quantities beside it."""
    if row is not None and row.note:
        yield row.note.strip(" ,")
    yield from (f"{other.name}: {other.amount}" for other in others if other is not None)


def _unknown(key: str) -> Number:
    """Number that a bearing does not have."""
    label = DRIVE_BOOK[key].label
    return Number(key, f"{label[:1].upper()}{label[1:]}", "none", note=_NONE.get(key, ""), known=False)
