"""Tables of a drive: both bearings side by side, and its remedies."""

from __future__ import annotations

import textwrap
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from itertools import groupby, pairwise
from typing import TYPE_CHECKING, Any, TypeAlias

from ehlectric.bearing import percent
from ehlectric.cases.defaults import HOW
from ehlectric.errors import printable
from ehlectric.quantities.formats import amount, speed_text
from ehlectric.quantities.inputs import ENDS
from ehlectric.quantities.result_bounds import drive_bounds
from ehlectric.quantities.results import DRIVE_BOOK, LIMITS, NAMES_OF_ENDS
from ehlectric.quantities.rows import (
    Row,
    RowTexts,
    Sheet,
    Summary,
    head_of,
    placed,
    placed_rows,
    sheet_rows,
)
from ehlectric.quantities.sheets import DRIVE, DRIVE_CHECK, REMEDIES
from ehlectric.quantities.units import unit_for
from ehlectric.readable import readable
from ehlectric.tables.bearing_tables import of_reliability
from ehlectric.tables.measured_tables import columns_table, status_rows

if TYPE_CHECKING:
    from rich.table import Table

# Rows of a quantity at both ends; None where an end has no value.
Pair: TypeAlias = tuple[Row | None, ...]

# Letters on a line of a head of the terminal.
_HEAD = 11


def prepared_rows(summary: Summary) -> list[Row]:
    """Rows of a drive that is not simulated; ``summary`` comes from ``drive.summary.checked_summary``."""
    return _rows(DRIVE_CHECK, summary)


def drive_rows(summary: Summary) -> list[Row]:
    """Rows of a simulated drive, both bearings below each other."""
    return [*status_rows(summary), *_rows(DRIVE, summary)]


def _rows(sheet: Sheet, summary: Summary) -> list[Row]:
    rows = list(placed_rows(whole_rows(summary, sheet), summary))
    for end, place in NAMES_OF_ENDS.items():
        for row in placed_rows(end_rows(summary, end, sheet), summary):
            placed = replace(row, name=f"{row.name}, {place}") if row.heading else row
            rows.append(replace(placed, key=placed.key.replace("end.", f"{end}.", 1)))
    return rows


def whole_rows(summary: Summary, sheet: Sheet = DRIVE) -> Iterator[Row]:
    """Rows of a sheet that do not belong to a bearing."""
    return sheet_rows(
        _part(sheet, ends=False), DRIVE_BOOK, summary, _WORDS, drive_bounds(DRIVE_BOOK, summary)
    )


def end_rows(summary: Summary, end: str, sheet: Sheet = DRIVE) -> Iterator[Row]:
    """Rows of the bearing at one end, with keys that begin with "end."."""
    of_end = {**summary, "end": summary[end]}
    return sheet_rows(_part(sheet, ends=True), DRIVE_BOOK, of_end, _WORDS, drive_bounds(DRIVE_BOOK, summary))


def _part(sheet: Sheet, *, ends: bool) -> Sheet:
    return tuple(section for section in sheet if section.keys[0].startswith("end.") == ends)


def side_by_side(summary: Summary, sheet: Sheet = DRIVE) -> Iterator[tuple[str, list[Pair]]]:
    """Sections of both bearings: heading, and the rows of each quantity that one of them has."""
    rows_of_ends = [{row.key: row for row in end_rows(summary, end, sheet)} for end in ENDS]
    for section in _part(sheet, ends=True):
        pairs = [tuple(rows.get(key) for rows in rows_of_ends) for key in section.keys]
        if known := [pair for pair in pairs if any(pair)]:
            yield placed(section.heading, section.keys[0], summary), known


def end_cells(summary: Summary, sheet: Sheet = DRIVE) -> Iterator[tuple[str, list[tuple[str, ...]]]]:
    """Tables of both bearings: heading, and cells of each quantity: label, value at each end, and unit."""
    for heading, pairs in side_by_side(summary, sheet):
        yield heading, [_cells(pair) for pair in pairs]


def _cells(pair: Pair) -> tuple[str, ...]:
    """Cells of a row: name, a value for each bearing, and their unit; a unit at each value if they differ."""
    known = [row for row in pair if row is not None]
    units = {row.unit for row in known}
    if len(units) == 1:
        return known[0].name, *map(_cell, pair), known[0].unit
    return known[0].name, *("–" if row is None else f"{row.bounded} {row.unit}" for row in pair), ""


def _cell(row: Row | None) -> str:
    """Bound and value of a row; a dash where there is none."""
    return "–" if row is None else row.bounded


def ends_table(summary: Summary) -> Table:
    """Table of both bearings of a drive, for the terminal."""
    rows: list[tuple[str, ...]] = []
    for heading, cells in end_cells(summary):
        rows += [(heading,), *((f"  {name}", *rest) for name, *rest in cells)]
    heads = [printable(summary["title"]), *NAMES_OF_ENDS.values(), ""]
    return columns_table(heads, rows, left=(0, 3), wrapped=(0,))


def remedies_table(summary: Summary) -> Table:
    """Table of the drive and its remedies for the terminal: each bearing, and both together."""
    (head, _, *heads), *cells = remedy_cells(remedied(summary), intervals=False)
    rows: list[tuple[str, ...]] = []
    for title, group in groupby(cells, key=lambda row: row[0]):
        rows += [(title,), *((f"  {place}", *numbers) for _, place, *numbers in group)]
    wrapped = [head, *("\n".join(textwrap.wrap(name, _HEAD)) for name in heads)]
    return columns_table(wrapped, rows, left=(0,), wrapped=(0,))


AS_IT_IS, BOTH = "as it is", "both"


def remedied(summary: Summary) -> list[tuple[str, Summary]]:
    """Titles and tables of the drive as it is and of its remedies."""
    return [(AS_IT_IS, summary), *((remedy["title"], remedy) for remedy in summary["remedies"])]


def remedy_cells(
    drives: Sequence[tuple[str, Summary]], *, intervals: bool = True
) -> Iterator[tuple[str, ...]]:
    """Yield the heads of the remedy table, then for each drive the cells of both bearings and their sums.

    ``drives``, titles and tables, as ``remedied`` returns them. Quantities that no drive has are omitted.
    """
    places = {**NAMES_OF_ENDS, BOTH: BOTH}
    blocks = [
        (title, place, _remedy_rows(tables, end)) for title, tables in drives for end, place in places.items()
    ]
    keys = [
        key
        for key in REMEDIES[0].keys
        if (intervals or not key.endswith("_range")) and any(key in rows for _, _, rows in blocks)
    ]
    yield "mitigation measure", "bearing", *(head_of(DRIVE_BOOK[key]) for key in keys)
    for title, place, rows in blocks:
        yield printable(title), place, *(_cell(rows.get(key)) for key in keys)


_RATE = "end.events_per_second"

# Name of the numbers in the columns of ``remedy_rates``, with their unit.
RATES = head_of(DRIVE_BOOK[_RATE])


def remedy_rates(summary: Summary) -> Iterator[tuple[str, ...]]:
    """Yield the heads of the short remedy table, then a row for each drive: discharges per second at each
    bearing and at both, as ``RATES`` names them, and with a duty cycle, discharges of both over the cycle.
    """
    places = {**NAMES_OF_ENDS, BOTH: BOTH}
    columns = [(_RATE, end) for end in places]
    columns += [("end.duty_discharges", BOTH)] if summary.get("duty") else []
    names = (f"{head_of(DRIVE_BOOK[key])}, {places[end]}" for key, end in columns[len(places) :])
    yield "mitigation measure", *places.values(), *names
    for title, tables in remedied(summary):
        rows = {end: _remedy_rows(tables, end) for end in places}
        yield printable(title), *(_cell(rows[end].get(key)) for key, end in columns)


def _remedy_rows(tables: Summary, end: str) -> dict[str, Row]:
    """Rows of one bearing, or of the sums of both, by key."""
    with_sums = {**tables, BOTH: _sums(tables)}
    return {row.key: row for row in end_rows(with_sums, end, REMEDIES)}


def _sums(tables: Summary) -> dict[str, Any]:
    """Sums of both bearings, by the keys of one bearing."""
    cycle = tables.get("duty") or {}
    return {**tables["drive"], **{f"duty_{key}": cycle.get(key) for key in ("discharges", "energy")}}


def _range(summary: Summary) -> tuple[str, str]:
    """Interval of the rate of discharges; an upper bound where there was none."""
    end = summary["end"]
    low, high = (readable(end[f"events_per_second_{side}"]) for side in ("low", "high"))
    return f"{low} to {high}" if end["events"] else f"at most {high}", "1/s"


def _duty_range(name: str) -> Callable[[Summary], Any]:
    """Interval of a sum over the duty cycle; None without one."""

    def value(summary: Summary) -> Any:
        end = summary["end"]
        if f"duty_{name}" not in end:
            return None
        low, high = end[f"duty_{name}_low"], end[f"duty_{name}_high"]
        unit = DRIVE_BOOK[f"end.duty_{name}"].unit
        most = low if high is None else high
        factor, shown = unit_for(most, unit, least=1.0) if unit and most else (1.0, unit)
        if high is None:
            return (f"at least {readable(factor * low)}", shown) if low else ("not known", "")
        texts = [readable(factor * value) for value in (low, high)]
        return f"{texts[0]} to {texts[1]}", shown

    return value


def _stretches(summary: Summary) -> Iterator[Row]:
    """Rows of the worst stretches of a duty cycle, the stretch with the most discharges first."""
    about = DRIVE_BOOK[key := "duty.stretches.discharges"]
    for place, stretch in enumerate((summary.get("duty") or {}).get("stretches", ())):
        yield Row(
            f"{about.label}, {readable(stretch['start'], 6)} to {readable(stretch['end'], 6)} s",
            stretch["discharges"],
            note=f", {amount(stretch['energy'], 'J')}, mean {speed_text(stretch['speed'])}",
            digits=about.digits,
            key=key.replace("stretches.", f"stretches.{place}."),
        )


def _edges(summary: Summary) -> float | None:
    rate = summary["source"]["edges_per_second"]
    return None if rate is None else rate * summary["drive"]["duration"]


def _time_above(name: str, before: str) -> Callable[[Summary], Any]:
    """Share of time above a voltage; None where neither bearing reaches the voltage before."""

    def value(summary: Summary) -> Any:
        reached = any(summary[end]["time_above"][before] for end in ENDS)
        return summary["end"]["time_above"][name] if reached else None

    return value


def _unless_zero(name: str) -> Callable[[Summary], Any]:
    """Share of the bearing at an end; None if it is zero or unknown."""
    return lambda summary: summary["end"].get(name) or None


def _rating_note(name: str) -> Callable[[Summary], str]:
    """Note with the origin of a load rating of the bearing at an end."""
    return lambda summary: f", {summary['end']['life'][f'{name}_rating_source']}"


def _contact_current(summary: Summary) -> Any:
    """Current through asperities; None where it is none in both bearings."""
    either = any(summary[end]["contact_current"] for end in ENDS)
    return summary["end"]["contact_current"] if either else None


_LIMITS = [f"{limit:g}" for limit in LIMITS]


_WORDS = RowTexts(
    rows={"duty.stretches": _stretches},
    notes={
        "source.peak": lambda s: ", measured waveform" if s["source"]["edges_per_second"] is None else "",
        "circuit.grounding_ring_resistance": lambda s: (
            ", by its table at this speed" if "grounding_ring_table" in s["inputs"]["circuit"] else ""
        ),
        "end.films": lambda s: f", films may be {percent(s['end']['films_error'])} off",
        **{f"end.life.{name}_rating": _rating_note(name) for name in ("dynamic", "static")},
        "end.breakdown_voltage": lambda s: (
            ", at a probability of 63.2 %" if s["end"]["weibull_shape"] is not None else ""
        ),
    },
    values={
        "source.edges": _edges,
        "end.films": lambda s: HOW.get(s["end"].get("films")),
        "end.events_per_second_range": _range,
        "end.duty_discharges_range": _duty_range("discharges"),
        "end.duty_energy_range": _duty_range("energy"),
        **{
            f"end.duty_{name}_share": _unless_zero(f"duty_{name}_share")
            for name in ("low_viscosity", "low_film", "unsolved")
        },
        **of_reliability("end.life.", "end.duty_"),
        "duty.left_out_share": lambda s: (s.get("duty") or {}).get("left_out_share") or None,
        "end.contact_current": _contact_current,
        **{f"end.time_above.{name}": _time_above(name, before) for before, name in pairwise(_LIMITS)},
    },
)
