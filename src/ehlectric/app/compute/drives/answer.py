"""Answers about a drive: at once by the capacitive divider, and simulated over time."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from ehlectric.app.answers.drive import DriveAnswer
from ehlectric.app.answers.told import within
from ehlectric.app.compute.cases import drive_of
from ehlectric.app.compute.drives.numbers import (
    drive_numbers,
    ends_table,
    merged,
    remedies_table,
)
from ehlectric.app.compute.drives.verdict import judged_after, judged_before
from ehlectric.app.compute.lines import lines_of
from ehlectric.app.compute.warnings import told_of
from ehlectric.bearing.accuracy import percent
from ehlectric.cases.bearings.ways import HOW
from ehlectric.cases.drives.case import ENDS, DriveCase
from ehlectric.drive.quick import expected, quick_drive
from ehlectric.drive.solver import SIMULATING, prepare
from ehlectric.drive.summary import checked_summary
from ehlectric.drive.verdict import drive_verdict
from ehlectric.drive.warnings import bearing_warnings, machine_warnings
from ehlectric.errors import InputError
from ehlectric.quantities.sheets import DRIVE, DRIVE_CHECK
from ehlectric.runs.by_kind import run_drive
from ehlectric.runtime.parallel.workers import cores
from ehlectric.runtime.progress import Progress
from ehlectric.tables.drive import drive_rows, prepared_rows

_SOLVING = "solving the contacts of both bearings, then simulating"


def quick_answer(table: Mapping[str, Any], session: Path | None = None) -> DriveAnswer:
    """Answer about a drive without a simulation, with contacts from the atlas or by formula.

    Parameters
    ----------
    table : mapping
        Nested tables of a drive file.
    session : Path, optional
        Folder of the session, in which the waveform of a measured source lies.

    Raises
    ------
    InputError
        If the tables are no valid drive, or its films have to be solved.
    """
    case = drive_of(table, session)
    # A wrong remedy is told as it is by the command.
    case.variants()
    quick, key = quick_drive(case)
    if quick is None:
        raise InputError(key, got="films that have to be solved", takes="a simulation with solved contacts")
    ready = prepare(quick, workers=1)
    summary = checked_summary(ready)
    found = (*ready.told, *bearing_warnings(ready.bearings), *machine_warnings(case, ready.elements))
    told = merged(told_of(found))
    shown = drive_numbers(summary, DRIVE_CHECK, told)
    films = {(summary[end]["films"], percent(summary[end]["films_error"])) for end in ENDS}
    how = "; ".join(f"Contacts {HOW[way]}: films may be {error} off" for way, error in sorted(films))
    solved = "; the simulation solves them" if _is_solved(case) else ""
    return DriveAnswer(
        title=case.title,
        simulated=False,
        judged=judged_before(expected(case, summary)),
        how=f"{how}{solved}. By the capacitive divider, without a simulation.",
        shown=shown,
        ends=ends_table(summary, DRIVE_CHECK),
        lines=lines_of(prepared_rows(summary)),
        warnings=within(told, {one.key for one in shown}),
    )


def simulate(table: Mapping[str, Any], session: Path, folder: Path, progress: Progress) -> DriveAnswer:
    """Answer about a drive and its remedies over time, by the same run as that of the command.

    Parameters
    ----------
    table : mapping
        Nested tables of a drive file.
    session : Path
        Folder of the session.
    folder : Path
        Folder of the result's files.
    progress : callable
        Called with the simulated part in percent, 100, and a text.

    Raises
    ------
    InputError
        If the tables are no valid drive, or it cannot be simulated.
    LostError
        Where the process of a contact was killed four times.
    """
    from ehlectric.app.figures.drives.every import drive_figures

    case = drive_of(table, session)
    progress(0, 0, _SOLVING if _is_solved(case) else SIMULATING)

    def told_percent(done: int, of: int, text: str) -> None:
        if text == SIMULATING:
            progress(done, of, "percent simulated")
        else:
            progress(0, 0, text)

    # A core is left for the pages.
    outcome = run_drive(case, folder, told_percent, workers=max(1, cores() - 1))
    summary = outcome.summary
    told = merged(told_of(outcome.warnings))
    shown = drive_numbers(summary, DRIVE, told)
    progress(0, 0, "drawing")
    return DriveAnswer(
        title=case.title,
        simulated=True,
        judged=judged_after(drive_verdict(case, summary, outcome.warnings)),
        how=f"Simulated in {summary['seconds']:.3g} s, as ehlectric drive does it.",
        shown=shown,
        ends=ends_table(summary, DRIVE),
        lines=lines_of(drive_rows(summary)),
        warnings=within(told, {one.key for one in shown}),
        remedies=remedies_table(summary),
        figures=drive_figures(outcome.result) if summary["converged"] else {},
        seconds=summary["seconds"],
    )


def _is_solved(case: DriveCase) -> bool:
    return any(one.contacts == "solved" for one in case.bearings)
