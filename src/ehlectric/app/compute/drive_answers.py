"""Answers about a drive: at once by the capacitive divider, and simulated over time."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

from ehlectric.app.compute.answer_parts import (
    at_operating_point,
    card,
    drive_of,
    lines_of,
    page_warnings_of,
    percent_of,
    unknown,
    usable,
)
from ehlectric.app.view_models import (
    Deciding,
    DriveAnswer,
    Number,
    PageWarning,
    Table,
    concerning,
    limited_to,
)
from ehlectric.bearing import percent
from ehlectric.cases.defaults import HOW
from ehlectric.cases.drive_case import DriveCase
from ehlectric.drive import (
    SIMULATING,
    bearing_warnings,
    checked_summary,
    drive_verdict,
    expected,
    machine_warnings,
    prepare,
    quick_drive,
)
from ehlectric.errors import InputError
from ehlectric.quantities.inputs import ENDS
from ehlectric.quantities.results import DRIVE_BOOK, NAMES_OF_ENDS
from ehlectric.quantities.rows import Row, Sheet, Summary
from ehlectric.quantities.sheets import DRIVE, DRIVE_CARDS, DRIVE_CHECK
from ehlectric.quantities.statement import Statement
from ehlectric.quantities.verdict import Verdict
from ehlectric.readable import readable
from ehlectric.report.report_texts import TEXTS
from ehlectric.runs.by_kind import run_drive
from ehlectric.runtime.progress import Progress
from ehlectric.runtime.worker_processes import cores
from ehlectric.tables.drive_tables import (
    RATES,
    Pair,
    drive_rows,
    end_cells,
    prepared_rows,
    remedy_rates,
    side_by_side,
    whole_rows,
)


def drive_numbers(summary: Summary, sheet: Sheet, warnings: tuple[PageWarning, ...]) -> tuple[Number, ...]:
    """Main numbers of a drive, of those in a sheet, with warnings."""
    whole = {row.key: row for row in whole_rows(summary, sheet)}
    ends = _pairs(summary, sheet)
    keys = [key for key in DRIVE_CARDS if any(key in section.keys for section in sheet)]
    if _BREAKDOWN not in ends:  # Ceramic elements insulate.
        keys.remove(_BREAKDOWN)
    numbers = [_of_ends(key, ends) if key.startswith("end.") else _of_drive(key, whole) for key in keys]
    numbers = usable(numbers, converged=summary.get("converged", True))
    return tuple(replace(number, warnings=concerning(warnings, number.key)) for number in numbers)


def merged(warnings: Iterable[PageWarning]) -> tuple[PageWarning, ...]:
    """Warnings, where warnings with one code, as of both bearings, are joined with both texts."""
    by_code: dict[str, PageWarning] = {}
    for warning in warnings:
        before = by_code.get(warning.code)
        by_code[warning.code] = (
            warning if before is None else replace(before, text=f"{before.text} {warning.text}")
        )
    return tuple(by_code.values())


def ends_table(summary: Summary, sheet: Sheet) -> Table:
    """Numbers of both bearings side by side, as the command prints them."""
    rows: list[tuple[str, ...]] = []
    for heading, cells in end_cells(summary, sheet):
        rows += [(heading, "", "", ""), *((f"\u2003{name}", *rest) for name, *rest in cells)]
    return Table("Both bearings", ("", *NAMES_OF_ENDS.values(), ""), tuple(rows))


def remedies_table(summary: Mapping[str, Any]) -> Table | None:
    """The drive and its remedies side by side; None without remedies."""
    if not summary["remedies"]:
        return None
    (_, *heads), *rows = remedy_rates(summary)
    return Table(f"Each bearing, and both together: {RATES}", ("", *heads), tuple(rows))


def _pairs(summary: Summary, sheet: Sheet) -> dict[str, Pair]:
    """Rows of both bearings by key."""
    pairs = [pair for _, group in side_by_side(summary, sheet) for pair in group]
    return {next(row.key for row in pair if row is not None): pair for pair in pairs}


def _of_drive(key: str, rows: Mapping[str, Row]) -> Number:
    others = [rows[other] for other in DRIVE_CARDS[key] if other in rows]
    return replace(card(rows[key]), note="; ".join(_texts(rows[key], others)))


# Number that decides, and its interval.
_RATE, _RATE_RANGE = "end.events_per_second", "end.events_per_second_range"
_BREAKDOWN = "end.breakdown_voltage"


def _worse(pairs: Mapping[str, Pair]) -> int:
    """Number of the bearing that discharges more often: 0 for the drive end, 1 for the other one."""
    rates = [0.0 if row is None else float(row.value or 0.0) for row in pairs.get(_RATE, (None, None))]
    return int(rates[1] > rates[0])


def deciding_rate(summary: Summary, figures: Mapping[str, Any]) -> Deciding:
    """Discharges in a second of the worse bearing of a simulated drive, with their interval."""
    pairs = _pairs(summary, DRIVE)
    worse = _worse(pairs)
    rate, interval = (pairs[key][worse] for key in (_RATE, _RATE_RANGE))
    facts = () if interval is None else ((DRIVE_BOOK[_RATE_RANGE].head, interval.amount),)
    # The statement on discharges has both rates; that on none says how many there may be.
    said = ("rates",) if rate is not None and rate.value else ()
    named = (name for name in ("remedies", "voltages") if name in figures)
    return Deciding(_RATE, facts, figure=next(named, ""), said=said)


def _of_ends(key: str, pairs: Mapping[str, Pair]) -> Number:
    """Number to show for both bearings: for rates the larger value, otherwise the drive end; the other value
    is in its note where it differs.
    """
    places = [*NAMES_OF_ENDS.values()]
    order = slice(None, None, -1) if key == _RATE and _worse(pairs) else slice(None)
    first, second = pairs.get(key, (None, None))[order]
    small_pairs = [pairs[other][order] for other in DRIVE_CARDS[key] if other in pairs]
    note, other_note = (
        "; ".join(_texts(row, [pair[k] for pair in small_pairs])) for k, row in enumerate((first, second))
    )
    if first is None and second is None:
        return unknown(key, DRIVE_BOOK[key], "none")
    number = card(first) if first is not None else unknown(key, DRIVE_BOOK[key], "none")
    if first is not None and second is not None and (first.text, note) == (second.text, other_note):
        return replace(number, note="; ".join(filter(None, [note, "each of both bearings"])))
    place, further = places[order]
    value = "none" if second is None else second.amount
    here = ", ".join(filter(None, [place, note]))
    return replace(number, note=f"{here}; {further}: {', '.join(filter(None, [value, other_note]))}")


def _texts(row: Row | None, others: Iterable[Row | None]) -> Iterator[str]:
    """Note of a row, and the quantities next to it."""
    if row is not None and row.note:
        yield row.note.strip(" ,")
    yield from (f"{other.name}: {other.amount}" for other in others if other is not None)


def meaning_before(verdict: Verdict) -> str:
    """What a verdict on a drive that is not simulated means, in plain words."""
    insulated = verdict.level == "green" and verdict.margin is None
    return str(TEXTS["meanings"]["drive_before"]["ceramic" if insulated else verdict.level])


_SOLVING = "solving the contacts of both bearings, then simulating"


def quick_answer(table: Mapping[str, Any], session: Path | None = None) -> DriveAnswer:
    """Answer about a drive without a simulation, with contacts from the atlas or from formulas. Raises
    InputError if the tables are no valid drive, or its films have to be solved.
    """
    # The simulation has the duty cycle, whose file this session may lack.
    case = drive_of(at_operating_point(table), session)
    # A wrong remedy is refused as by the command.
    case.variants()
    quick, key = quick_drive(case)
    if quick is None:
        raise InputError(key, got="films that have to be solved", takes="a simulation with solved contacts")
    ready = prepare(quick, workers=1)
    summary = checked_summary(ready)
    raised = (
        *ready.source.prior_warnings,
        *bearing_warnings(ready.bearings),
        *machine_warnings(case, ready.elements),
    )
    warnings = merged(page_warnings_of(raised))
    shown = drive_numbers(summary, DRIVE_CHECK, warnings)
    # The divider does not say how often, and with which energy, the bearings discharge.
    verdict = replace(expected(case, summary), assumptions=(Statement.of("not-simulated"),))
    films = {(summary[end]["films"], percent(summary[end]["films_error"])) for end in ENDS}
    how = "; ".join(f"Contacts {HOW[way]}: films may be {error} off" for way, error in sorted(films))
    solved = "; the simulation solves them" if _is_solved(case) else ""
    return DriveAnswer(
        title=case.title,
        simulated=False,
        verdict=verdict,
        meaning=meaning_before(verdict),
        how=f"{how}{solved}. By the capacitive divider, without a simulation.",
        shown=shown,
        deciding=Deciding("end.voltage_at_peak"),
        ends=ends_table(summary, DRIVE_CHECK),
        lines=lines_of(prepared_rows(summary)),
        warnings=limited_to(warnings, {number.key for number in shown}),
    )


def simulate(table: Mapping[str, Any], session: Path, folder: Path, progress: Progress) -> DriveAnswer:
    """Answer about a drive and its remedies over time, by the run that the command uses. Raises
    InputError if the tables are no valid drive, or it cannot be simulated; LostError where the process of a
    contact was killed four times.
    """
    from ehlectric.app.charts.drive_charts import drive_figures

    case = drive_of(table, session)
    progress(0, 0, _SOLVING if _is_solved(case) else SIMULATING)
    # A core is left for the pages.
    outcome = run_drive(case, folder, percent_of(progress), workers=max(1, cores() - 1))
    summary = outcome.summary
    warnings = merged(page_warnings_of(outcome.warnings))
    shown = drive_numbers(summary, DRIVE, warnings)
    progress(0, 0, "drawing")
    figures = drive_figures(outcome.result) if summary["converged"] else {}
    verdict = drive_verdict(case, summary, outcome.warnings)
    return DriveAnswer(
        title=case.title,
        simulated=True,
        verdict=verdict,
        meaning=TEXTS["meanings"]["drive_after"][verdict.level],
        how=f"Simulated in {readable(summary['seconds'])} s, as ehlectric drive does it.",
        shown=shown,
        deciding=deciding_rate(summary, figures),
        ends=ends_table(summary, DRIVE),
        lines=lines_of(drive_rows(summary)),
        warnings=limited_to(warnings, {number.key for number in shown}),
        remedies=remedies_table(summary),
        figures=figures,
        seconds=summary["seconds"],
    )


def _is_solved(case: DriveCase) -> bool:
    return any(bearing.contacts == "solved" for bearing in case.bearings)
