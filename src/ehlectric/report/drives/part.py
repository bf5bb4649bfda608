"""Part of a report about the result of a drive."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import Any

from ehlectric.cases.drives.case import DriveCase
from ehlectric.drive.result import DriveResult
from ehlectric.figures.names import with_units_kept
from ehlectric.quantities.formats import amount, number_text
from ehlectric.quantities.units import rpm
from ehlectric.report.content import Section
from ehlectric.report.drawn import pictures_of
from ehlectric.report.drives.assumptions import assumption_section
from ehlectric.report.drives.events import event_blocks
from ehlectric.report.drives.limits import drive_limits, drive_references
from ehlectric.report.drives.numbers import number_tables
from ehlectric.report.drives.remedies import remedy_blocks
from ehlectric.report.part import UNSOLVED, Part, details_of


def drive_part(result: DriveResult) -> Part:
    """Part of a report about a drive.

    Parameters
    ----------
    result : DriveResult
        Result of a drive.

    Returns
    -------
    Part
        What the report says of this result.
    """
    summary, case = result.summary(), result.case
    verdict = result.verdict
    return Part(
        kind=_kind(case),
        command="drive",
        lead=_lead(summary),
        failure="" if result.converged else UNSOLVED,
        verdict=replace(verdict, text=with_units_kept(verdict.text)),
        warnings=result.warnings,
        before=(assumption_section(case, summary),),
        numbers=tuple(number_tables(summary)),
        pictures=tuple(pictures_of(result, converged=result.converged)),
        further=tuple(_sections(result, summary)),
        limits=tuple(drive_limits(case)),
        references=tuple(drive_references(case)),
        details=details_of(summary, "") | {"seed of the random numbers": str(summary["drive"]["seed"])},
        toml=case.to_toml(),
    )


def _kind(case: DriveCase) -> str:
    """Phrase for a drive: its source and its bearings."""
    names = dict.fromkeys(one.bearing.base or f"{one.bearing.kind} bearing" for one in case.bearings)
    source = "a measured voltage" if case.source.measured else f"{case.source.modulation} modulation"
    return f"drive with {source}, bearings {' and '.join(names)}"


def _lead(summary: Mapping[str, Any]) -> str:
    """Sentences: operating point, simulated time, and how often the source changed in it."""
    drive, source = summary["drive"], summary["source"]
    parts = [f"{amount(drive['duration'], 's')} simulated"]
    if drive["periods"] is not None:
        count = f"{drive['periods']:.4g}"
        parts.append(f"{count} {'period' if count == '1' else 'periods'} of the fundamental")
    if source["edges_per_second"] is not None:
        edges = number_text(source["edges_per_second"] * drive["duration"])
        parts.append(f"{edges} edges of the common-mode voltage")
    speed, temperature = rpm(drive["speed"]), drive["temperature"] - 273.15
    return f"{speed:.4g} rpm, {temperature:.4g} °C; {', '.join(parts)}."


def _sections(result: DriveResult, summary: Mapping[str, Any]) -> Iterator[Section]:
    if result.remedies:
        yield Section("Remedies", tuple(remedy_blocks(result, summary)))
    yield Section("Largest discharges", tuple(event_blocks(result)))
