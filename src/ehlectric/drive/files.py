"""Run of a drive and the files of its result: summary.json and events.csv."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from ehlectric.cases.drives.case import DriveCase
from ehlectric.drive.keys import EVENT_COLUMNS
from ehlectric.runtime.files import Content, json_of, write_together
from ehlectric.runtime.folders import RESULT_LOCK, alone_in
from ehlectric.runtime.outcome import RunOutcome
from ehlectric.runtime.progress import Progress, silent
from ehlectric.runtime.tables import column_head, csv_of

if TYPE_CHECKING:
    from ehlectric.drive.result import DriveResult

SUMMARY, EVENTS = "summary.json", "events.csv"
FILES = (SUMMARY, EVENTS)


def run(
    case: DriveCase,
    folder: str | Path,
    progress: Progress = silent,
    *,
    workers: int | None = None,
    others: Sequence[str] = (),
) -> RunOutcome[DriveResult]:
    """Solve a drive, and write summary.json and events.csv.

    Parameters
    ----------
    case : DriveCase
        Drive to solve.
    folder : str or Path
        Folder of the files; it is made if it does not exist.
    progress : callable, optional
        Called with the part that is done in percent, 100, and what is being done.
    workers : int, optional
        Number of processes that solve contacts; by default as many as there are cores.
    others : sequence of str, optional
        Names of other files in the folder that belong to its result, such as figures. Those of an earlier
        result are removed when the drive is solved.

    Returns
    -------
    RunOutcome
        With a ``failure`` where a contact is not converged; its files are written all the same.

    Raises
    ------
    InputError
        Where the drive cannot be solved, the folder cannot be used, or another command writes into it.
    """
    # Loads the compiler of the simulation, which the names of the files above do not need.
    from ehlectric.drive.result import solve_drive

    names = (*FILES, *others)
    with alone_in(folder, names) as folder:
        result = solve_drive(case, progress=progress, workers=workers)
        files = save(result, folder, replaced=names)
    failure = None if result.converged else "not converged: a contact of a bearing"
    return RunOutcome(result, result.summary(), tuple(files), result.warnings, failure)


def save(result: DriveResult, folder: str | Path, *, replaced: Sequence[str] = ()) -> list[Path]:
    """Save the result of a drive: summary.json and events.csv, both or none.

    Parameters
    ----------
    result : DriveResult
        Result of ``solve_drive``.
    folder : str or Path
        Folder of the files; it is made if it does not exist.
    replaced : sequence of str
        Names of further files of an earlier result there, which are removed.

    Returns
    -------
    list of Path
        Files written.

    Raises
    ------
    InputError
        If the folder cannot be written to, its disk is full, or another command writes into it.
    """
    heads = ["bearing", *(column_head(name, unit) for name, unit in EVENT_COLUMNS.items())]
    contents: dict[str, Content] = {
        SUMMARY: json_of(result.summary()),
        EVENTS: csv_of(heads, (row.values() for row in result.events())),
    }
    with alone_in(folder, FILES, locks=[RESULT_LOCK]) as folder:
        return write_together(folder, contents, (*FILES, *replaced))
