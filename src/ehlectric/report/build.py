"""Report of a stored result of any kind: contact, moving roughness, bearing, drive, or a sweep of them."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from types import MappingProxyType
from typing import Any

from ehlectric.bearing.result import BearingResult
from ehlectric.cases.defaults import HOW
from ehlectric.contact.result import ContactResult
from ehlectric.drive.result import DriveResult
from ehlectric.errors import printable
from ehlectric.motion.result import MotionResult
from ehlectric.report.background import (
    date_of_report,
    file_section,
    input_section,
    limit_section,
    source_section,
    version_section,
)
from ehlectric.report.drive_report import drive_part
from ehlectric.report.light import light_of
from ehlectric.report.report_content import Block, Part, Report, Section, Text, details_of, lead_of
from ehlectric.report.report_facts import alarms_of, cell_table, pictures_of, row_tables, warning_block
from ehlectric.report.report_texts import SENTENCES
from ehlectric.report.sweep_report import sweep_part
from ehlectric.runs.result_folders import stored_result
from ehlectric.runs.solve import load
from ehlectric.sweep.result import SweepResults
from ehlectric.sweep.store import NAME as SWEEP
from ehlectric.sweep.store import read_sweep
from ehlectric.tables.bearing_tables import films_table, loads_table, total_rows
from ehlectric.tables.contact_tables import result_rows
from ehlectric.tables.motion_tables import run_rows


def report_of(path: str | Path) -> Report:
    """Report of a stored result, as data. Returns title, date and sections. Raises InputError if the folder
    has no result or several, or the result cannot be read.
    """
    date = date_of_report()
    path = stored_result(path)
    result: Any = read_sweep(path.parent) if path.name == SWEEP else load(path)
    part = next(make for kind, make in _PARTS.items() if isinstance(result, kind))(result)
    name = _title(result) or part.kind[0].upper() + part.kind.partition(" over ")[0][1:]
    sections = (
        Section("Answer", tuple(_answer(part))),
        Section("Warnings", (warning_block(part.warnings),)),
        *part.before,
        Section("Key numbers", part.numbers),
        Section("Figures", part.pictures or (Text("The result has no figures."),)),
        *part.further,
        input_section(result.case, part.varied),
        limit_section(result.case),
        source_section(result.case),
        version_section(part.details),
        file_section(part.toml, part.command),
    )
    return Report(name, part.kind, date, sections)


def _title(result: Any) -> str:
    """Title of a result; that of a sweep is its own, or that of its case."""
    return printable(getattr(result, "title", "") or result.case.title)


def _answer(part: Part) -> Iterator[Block]:
    yield from alarms_of(part.warnings, part.failure)
    yield Text(part.lead)
    if part.verdict is not None:
        yield light_of(part.verdict.level, part.verdict.text)
    else:
        yield Text(SENTENCES["no_verdict"])


def _contact(result: Any) -> Part:
    summary = result.summary()
    return Part(
        kind=f"{result.case.contact.geometry} contact",
        command="run",
        lead=lead_of(result),
        failure="" if result.converged else SENTENCES["unsolved"],
        verdict=result.verdict,
        warnings=result.warnings,
        numbers=tuple(row_tables(result_rows(result), "Overview")),
        pictures=tuple(pictures_of(result, converged=result.converged)),
        details=details_of(summary, result.to_xarray().attrs.get("date", "")),
        toml=result.case.to_toml(),
    )


def _motion(result: MotionResult) -> Part:
    summary = result.summary()
    return Part(
        kind=f"{result.case.contact.geometry} contact with moving roughness",
        command="run",
        lead=lead_of(result),
        failure="" if result.converged else SENTENCES["ended_early"],
        verdict=None,
        warnings=result.warnings,
        numbers=tuple(row_tables(run_rows(summary), "Overview")),
        pictures=tuple(pictures_of(result, converged=result.converged)),
        details=details_of(summary, str(result.dataset.attrs.get("date", ""))),
        toml=result.case.to_toml(),
    )


def _bearing(result: BearingResult) -> Part:
    summary = result.summary()
    base = result.case.bearing.base
    of_library = f" {base}" if base else ""
    contacts = Section(
        "Contacts",
        (
            cell_table(
                loads_table(summary), "Loads and dry contacts of the elements with both rings", "element"
            ),
            cell_table(films_table(summary), "Films, capacitances and voltages of the contacts", "element"),
        ),
    )
    return Part(
        kind=f"{result.case.bearing.kind} bearing{of_library}, contacts {HOW[result.case.contacts]}",
        command="bearing",
        lead=lead_of(result),
        failure="" if result.converged else SENTENCES["unsolved"],
        verdict=result.verdict,
        warnings=result.warnings,
        numbers=tuple(row_tables(total_rows(summary), "Overview")),
        pictures=tuple(pictures_of(result, converged=result.converged)),
        further=(contacts,),
        details=details_of(summary, ""),
        toml=result.case.to_toml(),
    )


# Parts by the class of the result.
_PARTS: Mapping[type, Callable[[Any], Part]] = MappingProxyType(
    {
        ContactResult: _contact,
        MotionResult: _motion,
        BearingResult: _bearing,
        DriveResult: drive_part,
        SweepResults: sweep_part,
    }
)
