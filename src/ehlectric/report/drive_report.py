"""Parts of a report about drives: numbers, assumptions, remedies, discharges, limits, and sweeps of
drives.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import chain
from typing import Any

import numpy as np

from ehlectric.cases.drive_case import DriveCase
from ehlectric.cases.input_keys import of_both_ends
from ehlectric.cases.table_edits import flattened
from ehlectric.drive import DriveResult, drive_verdict
from ehlectric.errors import printable
from ehlectric.figures.figure_names import with_units_kept
from ehlectric.quantities.formats import amount, operating_point
from ehlectric.quantities.inputs import ENDS, end_and_key
from ehlectric.quantities.quantity import unbroken
from ehlectric.quantities.result_bounds import drive_bounds
from ehlectric.quantities.result_warnings import CODES
from ehlectric.quantities.results import DRIVE_BOOK, EVENT_KEYS, NAMES_OF_ENDS
from ehlectric.quantities.rows import Summary
from ehlectric.quantities.sheets import FIRST_PAGE_OF_DRIVE, SWEEPS, at_ends
from ehlectric.quantities.units import unit_for
from ehlectric.readable import readable
from ehlectric.report.appendix import input_text, inputs_of, named, numbered, parts_of, varied_keys
from ehlectric.report.first_page import life_texts, machine_of, measure_first_table, numbers_of, usual_range
from ehlectric.report.report_content import Block, Named, Numbers, Part, Section, Table, Text
from ehlectric.report.report_facts import density_tables, part_of, row_tables
from ehlectric.report.report_texts import SENTENCES, TEXTS
from ehlectric.sweep import SweepResults
from ehlectric.tables.drive_tables import (
    AS_IT_IS,
    RATES,
    end_cells,
    end_rows,
    remedy_cells,
    remedy_rates,
    whole_rows,
)

# Words for the origin of an input that is not a value of the library.
_GIVEN = "input file"


def deciding_blocks(
    case: DriveCase, summary: Mapping[str, Any] | None = None, varied: Sequence[str] = ()
) -> tuple[Block, ...]:
    """Values that decide the result and that no model gives, with a sentence about them."""
    either, _ = varied_keys(varied)
    shown = tuple(
        (named(key), "varied", "sweep", why) if key in either else (named(key), value, origin, why)
        for key, value, origin, why in _deciding(case, summary, varied)
    )
    heads, shares = ("input", "value", "origin", "what it decides"), (0.29, 0.14, 0.21, 0.36)
    table = Table("Values that decide the result", heads, shown, shares=shares)
    return Text(SENTENCES["deciding_values"]), table


def _deciding(
    case: DriveCase, summary: Mapping[str, Any] | None, varied: Sequence[str] = ()
) -> Iterator[tuple[str, str, str, str]]:
    """Key, value, origin and effect of each value that decides the result."""
    _, apart = varied_keys(varied)
    origins = {entry.key: entry.origin for entry in inputs_of(case, apart=apart) if entry.origin != "given"}
    for key, value, origin, why in (
        *_of_inputs(case, apart=apart), *_renewal(case, summary)
    ):  # fmt: skip
        yield key, value, origin or origins.get(key, _GIVEN), why


# Tables that replace a number that decides the result.
_TABLES = {
    "discharge.strength_table": "discharge.dielectric_strength",
    "circuit.grounding_ring_table": "circuit.grounding_ring_resistance",
}


def _of_inputs(case: DriveCase, *, apart: bool) -> Iterator[tuple[str, str, str, str]]:
    """Rows of circuit, arc and bearings, with equal bearings once where no end has values of its own;
    without an origin where it is the origin of an input.
    """
    decided = TEXTS["decided"]
    for before, part in {"": case, **parts_of(case, apart=apart)}.items():
        given = flattened(part.to_dict())
        for key, why in decided.items():
            name = key.partition(".")[2]
            # Resistances of 0 ohm stand for a path without resistance.
            if key in given and (given[key] or "resistance" not in key):
                yield f"{before}{key}", input_text(case, f"{before}{key}", given[key]), "", why
            elif part is case and name in case.circuit.estimated:
                origin = "geometry of the machine, without end windings"
                yield key, amount(case.circuit.capacitances[name], "F"), origin, why
        for table, number in _TABLES.items():
            if any(key.startswith(f"{table}.") for key in given):
                yield f"{before}{table}", "a table", _GIVEN, decided[number]


def _renewal(case: DriveCase, summary: Mapping[str, Any] | None) -> Iterator[tuple[str, str, str, str]]:
    """Row of the time between new thresholds, where it follows from the bearings."""
    if case.breakdown.renewal_time is not None or summary is None:
        return
    times = sorted({summary[end]["renewal_time"] for end in ENDS} - {None})
    if times:
        key = "breakdown.renewal_time"
        value = " and ".join(dict.fromkeys(amount(float(f"{time:.3g}"), "s") for time in times))
        origin = "time in which oil passes the most loaded contact"
        yield key, with_units_kept(value), origin, TEXTS["decided"][key]


# Largest number of discharges that a report lists.
LISTED = 20

# Digits of the largest time: two discharges at the same edge of the source differ in them.
_DIGITS = 6


def event_blocks(result: DriveResult) -> Iterator[Block]:
    """Table of the discharges with the largest energy, and sentences about the others."""
    rows = result.events()
    total = int(np.sum(result.solution.record.counts))
    if not rows:
        yield Text("No film broke down in the simulated time.")
        return
    listed = sorted(rows, key=lambda row: row["energy"], reverse=True)[:LISTED]
    kept = "" if len(rows) == total else f"; they are the largest of the first {len(rows)}, which are stored"
    if total > len(listed):
        yield Text(f"The {len(listed)} discharges with the largest energy of {total}{kept}.")
    yield Text(SENTENCES["events"])
    scales = {
        name: unit_for(max(abs(row[name]) for row in listed), about.unit, least=1.0)
        for name, about in EVENT_KEYS.items()
    }
    heads = ("number", "bearing", *(f"{EVENT_KEYS[name].label} [{scales[name][1]}]" for name in scales))
    largest = max(row["time"] for row in listed) * scales["time"][0]
    digits = max(0, _DIGITS - len(f"{largest:.0f}"))
    cells = tuple(
        (
            str(number),
            NAMES_OF_ENDS[row["bearing"]],
            *(
                f"{row[name] * factor:.{digits}f}" if name == "time" else readable(row[name] * factor)
                for name, (factor, _) in scales.items()
            ),
        )
        for number, row in enumerate(listed, 1)
    )
    numeric, shares = (0, *range(2, len(heads))), (0.09, 0.15, 0.17, 0.12, 0.11, 0.12, 0.11, 0.13)
    yield Table("Discharges with the largest energy", heads, cells, numeric, shares=shares)


def number_tables(summary: Summary) -> Iterator[Table | Text]:
    """Yield tables: the simulation, both bearings side by side, and limits of the current density."""
    yield from row_tables(whole_rows(summary), "simulation")
    heads = ("quantity", *NAMES_OF_ENDS.values(), "unit")
    for caption, rows in end_cells(summary):
        cells = tuple(tuple(map(unbroken, row)) for row in rows)
        yield Table(caption, heads, cells, (1, 2), shares=(0.44, 0.22, 0.22, 0.12))
    bound = drive_bounds(DRIVE_BOOK, summary).get("end.breakdown_voltage")
    yield Text(" ".join([*([TEXTS["bounds"][bound]] if bound else []), SENTENCES["drive_numbers"]]))
    yield from density_tables(
        {place: summary[end]["current_density"] for end, place in NAMES_OF_ENDS.items()}
    )


def remedy_blocks(result: DriveResult, summary: Mapping[str, Any]) -> Iterator[Block]:
    """Tables of the remedies: what they change, and their numbers next to the unchanged drive."""
    yield Text(SENTENCES["remedies"])
    heads, changes = ("mitigation measure", "input", AS_IT_IS, "with the measure"), tuple(_changes(result))
    yield Table("What each mitigation measure changes", heads, changes, shares=(0.25, 0.39, 0.18, 0.18))
    drives = [(AS_IT_IS, result, summary)]
    drives += [(variant.title, variant.result, variant.result.summary()) for variant in result.variants]
    known = {warning.code for warning in result.warnings}
    verdicts = tuple(
        (printable(title), _words(variant, of_drive), _further(variant, known))
        for title, variant, of_drive in drives
    )
    judged = ("drive", "verdict", "further warnings")
    yield Table("Verdict on each mitigation measure", judged, verdicts, shares=(0.25, 0.35, 0.4))
    columns, *cells = remedy_cells([(title, of_drive) for title, _, of_drive in drives])
    rows = tuple((title, place, *map(unbroken, values)) for title, place, *values in cells)
    shares = (0.18, 0.12, *(0.7 / (len(columns) - 2) for _ in columns[2:]))
    yield Table("Mitigation measures compared", columns, rows, tuple(range(2, len(columns))), shares=shares)


def _words(result: DriveResult, summary: Mapping[str, Any]) -> str:
    """Heading of the verdict on a drive."""
    verdict = drive_verdict(result.case, summary, result.warnings)
    bound = verdict.bound_note
    return f"{verdict.heading} ({bound})" if bound else verdict.heading


def _further(result: DriveResult, known: set[str]) -> str:
    """Meanings of the warnings of a remedy that the drive as it is does not have."""
    codes = dict.fromkeys(warning.code for warning in result.warnings if warning.code not in known)
    return " ".join(CODES[code].meaning for code in codes) or "none"


def _changes(result: DriveResult) -> Iterator[tuple[str, Named, str, str]]:
    """Rows of the changes of all remedies: title, input, and its value in the drive and with the remedy."""
    for title, changes, solved in result.remedies:
        for row in changed_inputs(result.case, solved.case, changes):
            yield printable(title), *row


def changed_inputs(
    before: DriveCase, after: DriveCase, changes: Mapping[str, Any]
) -> Iterator[tuple[Named, str, str]]:
    """Rows of the changes of a remedy: input, and its values before and after the change."""
    was, now = (flattened(numbered(case.to_dict())) for case in (before, after))
    for changed in flattened(dict(changes)):
        for key in _leaves(changed, was, now):
            yield named(key), _value_at(before, key, was), _value_at(after, key, now)


def _leaves(changed: str, was: Mapping[str, Any], now: Mapping[str, Any]) -> list[str]:
    """Return the keys of a changed key's values: the base name for a table with a library base."""
    first, *_ = of_both_ends(changed)
    under = [key for key in dict.fromkeys((*was, *now)) if key.startswith(f"{first}.")]
    if first in was or first in now or not under:
        return [changed]
    if f"{first}.base" in now:
        return [f"{changed}.base"]
    return [changed + key.removeprefix(first) for key in under if was.get(key) != now.get(key)]


def _value_at(case: DriveCase, key: str, tables: Mapping[str, Any]) -> str:
    """Value of an input; the values of both ends if the input of both bearings has two."""
    texts = {
        end_key: input_text(case, end_key, tables[end_key]) if end_key in tables else "not given"
        for end_key in of_both_ends(key)
    }
    if len(set(texts.values())) == 1:
        return next(iter(texts.values()))
    return "; ".join(f"{text}, {NAMES_OF_ENDS[end_and_key(end_key)[0]]}" for end_key, text in texts.items())


def swept_values(results: SweepResults) -> tuple[str, ...]:
    """Keys of the summary that a report of a sweep shows: of one end where both bearings are equal."""
    return tuple(at_ends(SWEEPS["drive_drawn"], _ends(results)))


def listed_values(results: SweepResults) -> tuple[str, ...]:
    """Return the summary keys in the table of points: for equal bearings with the bounds of the rate."""
    ends = _ends(results)
    keys = SWEEPS["equal_bearings_listed" if len(ends) == 1 else "drive_listed"]
    return ("drive.events_per_second", *(key for end in ends for key in at_ends(keys, [end])))


def _ends(results: SweepResults) -> tuple[str, ...]:
    """Ends whose numbers are shown: one where both bearings are equal at all points."""
    assert isinstance(results.case, DriveCase)
    first, second = results.case.bearings
    # With a rotor, both bearings carry different loads at some points.
    alike = first == second and results.case.rotor is None
    alike = alike and not any(end_and_key(key)[0] in ENDS for key in results.varied)
    return ENDS[:1] if alike else ENDS


def drive_part(result: DriveResult) -> Part:
    """Part of a report about a drive."""
    summary, case = result.summary(), result.case
    return part_of(
        result,
        summary,
        kind=_kind(case),
        command="drive",
        machine=machine_of(case, summary),
        lead=_lead(summary),
        verdict=result.verdict,
        first=tuple(_first_blocks(result, summary)),
        numbers=tuple(number_tables(summary)),
        further=tuple(_sections(result, summary)),
        rests=deciding_blocks(case, summary),
    )


def _first_blocks(result: DriveResult, summary: Mapping[str, Any]) -> Iterator[Block]:
    """Numbers and rating lives of both bearings, remedies, and the three values that decide most."""
    rows = {place: tuple(end_rows(summary, end)) for end, place in NAMES_OF_ENDS.items()}
    numbers = [
        numbers_of(rows_of_end, FIRST_PAGE_OF_DRIVE, summary, place) for place, rows_of_end in rows.items()
    ]
    # A row for each bearing.
    yield Numbers(tuple(chain.from_iterable(numbers)), columns=max(map(len, numbers)))
    yield from life_texts(rows)
    if result.remedies:
        yield _remedy_table(result, summary)
    case = result.case
    decisive: dict[str, tuple[str, str, str]] = {}
    for key, value, _, why in _deciding(case, summary):
        end, inner = end_and_key(key)
        # Ceramic elements do not break down.
        if summary.get(end, {"breakdown_voltage": 0.0})["breakdown_voltage"] is not None:
            decisive.setdefault(inner, (key, value, why))
    yield measure_first_table(
        (named(key).text, value, usual_range(case, key), why)
        for key, value, why in (decisive[key] for key in TEXTS["first_page"]["drive"] if key in decisive)
    )


def _remedy_table(result: DriveResult, summary: Summary) -> Table:
    """Remedies with what they change, and the discharges in a second of the drive and of each of them."""
    heads, *cells = remedy_rates(summary)
    changes = ["none"] + [
        "; ".join(
            f"{name.text} =\xa0{value}"
            for name, _, value in changed_inputs(result.case, solved.case, changed)
        )
        for _, changed, solved in result.remedies
    ]
    rows = tuple((title, change, *rates) for (title, *rates), change in zip(cells, changes, strict=True))
    heads = ("mitigation measure", "change", *heads[1:])
    numeric = (0.11, 0.15, 0.11, 0.15)[: len(heads) - 2]
    shares = (0.22, 0.78 - sum(numeric), *numeric)
    return Table(f"Mitigation measures: {RATES}", heads, rows, tuple(range(2, len(heads))), shares=shares)


def _kind(case: DriveCase) -> str:
    """Phrase for a drive: its source and its bearings."""
    names = dict.fromkeys(end.bearing.name or f"{end.bearing.kind} bearing" for end in case.bearings)
    source = "a measured voltage" if case.source.measured else f"{case.source.modulation} modulation"
    return f"drive with {source}, bearings {' and '.join(names)}"


def _lead(summary: Mapping[str, Any]) -> str:
    """Sentences: operating point, simulated time, and how often the source changed in it."""
    drive, source = summary["drive"], summary["source"]
    parts = [f"{amount(drive['duration'], 's')} simulated"]
    if drive["periods"] is not None:
        count = readable(drive["periods"], 4)
        parts.append(f"{count} {'period' if count == '1' else 'periods'} of the fundamental")
    if source["edges_per_second"] is not None:
        edges = readable(source["edges_per_second"] * drive["duration"])
        parts.append(f"{edges} edges of the common-mode voltage")
    return f"{', '.join(operating_point(drive['speed'], drive['temperature']))}; {', '.join(parts)}."


def _sections(result: DriveResult, summary: Mapping[str, Any]) -> Iterator[Section]:
    if result.remedies:
        yield Section("Mitigation measures", tuple(remedy_blocks(result, summary)))
    yield Section("Largest discharges", tuple(event_blocks(result)))
