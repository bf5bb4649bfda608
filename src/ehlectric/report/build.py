"""Report of a stored result of any kind: a contact, moving roughness, a bearing or a sweep."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from textwrap import shorten
from typing import Any

from ehlectric.bearing.result import BearingResult
from ehlectric.cases.bearings.ways import HOW
from ehlectric.cases.case import Case
from ehlectric.cases.drives.case import DriveCase
from ehlectric.cases.row import Row
from ehlectric.contact.results import PointResult, Result
from ehlectric.discharge.verdict import Verdict
from ehlectric.drive.result import DriveResult
from ehlectric.errors import InputError, ResultWarning, printable
from ehlectric.motion.result import MotionResult
from ehlectric.report.background import (
    date_of_report,
    file_section,
    input_section,
    limit_section,
    source_section,
    version_section,
)
from ehlectric.report.content import Block, Report, Section, Text
from ehlectric.report.drawn import pictures_of
from ehlectric.report.facts import alarms_of, cell_table, row_tables, warning_block
from ehlectric.report.light import light_of
from ehlectric.report.swept import sweep_part
from ehlectric.runs.folders import stored_result
from ehlectric.runs.results import load
from ehlectric.sweep.store import NAME as SWEEP
from ehlectric.sweep.store import read_sweep
from ehlectric.tables.bearing import films_table, loads_table, total_rows
from ehlectric.tables.contact import result_rows
from ehlectric.tables.motion import run_rows

_UNSOLVED = "NOT CONVERGED: this result is no solution. Do not use its numbers and figures."


@dataclass(frozen=True)
class Part:
    """Content of a report that depends on the kind of the result.

    Attributes
    ----------
    kind : str
        What the result is, in a few words.
    command : str
        Command that solves the input file.
    failure : str
        What is not solved; empty where all is.
    verdict : Verdict or None
        Answer of the result; None where it has none.
    warnings : tuple of ResultWarning
        Warnings of the result.
    rows : tuple of Row
        Rows of key numbers that the command prints.
    pictures : tuple
        Figures.
    further : tuple of Section
        Sections after the figures.
    details : dict
        What is known of the computation, by name.
    toml : str
        Input file.
    varied : tuple of str
        Dotted keys that a sweep varies.
    """

    kind: str
    command: str
    failure: str
    verdict: Verdict | None
    warnings: tuple[ResultWarning, ...]
    rows: tuple[Row, ...]
    pictures: tuple[Block, ...]
    further: tuple[Section, ...]
    details: dict[str, str]
    toml: str
    varied: tuple[str, ...] = ()


def report_of(path: str | Path) -> Report:
    """Report of a stored result, as data.

    Parameters
    ----------
    path : str or Path
        Folder of a result of any kind, or its result.nc, bearing.nc or motion.nc.

    Returns
    -------
    Report
        Title, date and sections.

    Raises
    ------
    InputError
        If the folder has no result or several, or the result cannot be read or is that of a drive.
    """
    date = date_of_report()
    path = stored_result(path)
    if path.name == SWEEP:
        result: Any = read_sweep(path.parent)
        if isinstance(result.case, DriveCase):
            takes = "the result of a contact, a bearing, or a sweep of them; ehlectric map draws this one"
            raise InputError(path.parent, "is a sweep of a drive", takes=takes)
        part, case, title = Part(**sweep_part(result)), result.case, result.title or result.case.title
    else:
        result = load(path)
        if isinstance(result, DriveResult):
            told = "is the result of a drive, of which there is no report"
            raise InputError(path, told, takes=f"its figures, as with: ehlectric plot {path.parent}")
        part, case, title = _part(result), result.case, result.case.title
    name = printable(title) or part.kind[0].upper() + part.kind.partition(" over ")[0][1:]
    sections = (
        Section("Answer", tuple(_answer(part, result))),
        Section("Warnings", (warning_block(part.warnings),)),
        Section("Key numbers", tuple(row_tables(part.rows, "Overview"))),
        Section("Figures", part.pictures or (Text("The result has no figures."),)),
        *part.further,
        input_section(case, part.varied),
        limit_section(case),
        source_section(case),
        version_section(part.details),
        file_section(part.toml, part.command),
    )
    return Report(name, part.kind, date, sections)


def _answer(part: Part, result: Any) -> Iterator[Block]:
    yield from alarms_of(part.warnings, part.failure)
    yield Text(_in_short(result))
    if part.verdict is not None:
        yield light_of(part.verdict.level, part.verdict.text)
    else:
        yield Text(
            "This result has no verdict: it has no breakdown voltage, or no voltage to compare it with."
        )


def _in_short(result: Any) -> str:
    """Main numbers of a result: its representation without the name of its class, title and verdict."""
    line = repr(result)[1:-1].partition(" ")[2]
    title = shorten(getattr(result, "title", "") or result.case.title, 60)
    line = re.sub(r", verdict \w+$", "", line.removeprefix(f"{title!r}: "))
    if isinstance(result, BearingResult) and result.case.bearing.base:
        # The name of a bearing keeps its letters.
        line = f"Bearing {line}"
    return printable(f"{line[:1].upper()}{line[1:]}.").replace("≤ ", "≤\xa0").replace("≥ ", "≥\xa0")


def _part(result: Any) -> Part:
    """Part of a result other than a sweep."""
    if isinstance(result, BearingResult):
        return _bearing(result)
    return _motion(result) if isinstance(result, MotionResult) else _contact(result)


def _contact(result: Result | PointResult) -> Part:
    summary, case = result.summary(), result.case
    assert isinstance(case, Case)  # every stored result has one
    return Part(
        kind=f"{case.contact.geometry} contact",
        command="run",
        failure="" if result.converged else _UNSOLVED,
        verdict=result.verdict,
        warnings=result.warnings,
        rows=tuple(result_rows(result)),
        pictures=tuple(pictures_of(result, converged=result.converged)),
        further=(),
        details=_details(summary, result.to_xarray().attrs.get("date", "")),
        toml=case.to_toml(),
    )


def _motion(result: MotionResult) -> Part:
    summary = result.summary()
    ended = (
        "NOT COMPLETE: the run ends early. Numbers and figures hold for the instants that are solved only."
    )
    return Part(
        kind=f"{result.case.contact.geometry} contact with moving roughness",
        command="run",
        failure="" if result.converged else ended,
        verdict=None,
        warnings=result.warnings,
        rows=tuple(run_rows(summary)),
        pictures=tuple(pictures_of(result, converged=result.converged)),
        further=(),
        details=_details(summary, str(result.dataset.attrs.get("date", ""))),
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
        failure="" if result.converged else _UNSOLVED,
        verdict=result.verdict,
        warnings=result.warnings,
        rows=tuple(total_rows(summary)),
        pictures=tuple(pictures_of(result, converged=result.converged)),
        further=(contacts,),
        details=_details(summary, ""),
        toml=result.case.to_toml(),
    )


def _details(summary: dict[str, Any], date: str) -> dict[str, str]:
    """Version, date and state of a computation, by name."""
    seconds = summary.get("seconds")
    return {
        "result computed by": f"ehlectric {summary['version']}",
        "date of the result": date,
        "converged": "yes" if summary["converged"] else "no",
        "computing time": _seconds(seconds),
    }


def _seconds(seconds: float | Mapping[str, float] | None) -> str:
    """Time as text; that of a contact is the sum of its parts."""
    if seconds is None:
        return ""
    total = sum(seconds.values()) if isinstance(seconds, Mapping) else seconds
    return f"{total:.3g} s"
