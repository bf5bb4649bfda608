"""Run of a drive and the files of its result: summary.json, drive.nc and tables as CSV."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from ehlectric.cases.drive_case import DriveCase
from ehlectric.drive.stored import SCHEMA, duties_of, parts_of
from ehlectric.quantities.results import EVENT_COLUMNS, SPECTRUM_COLUMNS
from ehlectric.runtime.file_rules import check_format, refusing
from ehlectric.runtime.files import Content, column_head, csv_of, json_of, write_together
from ehlectric.runtime.folders import RESULT_LOCK, alone_in
from ehlectric.runtime.netcdf import check_readable, content_of, load_library
from ehlectric.runtime.progress import Progress, RunOutcome, silent
from ehlectric.runtime.result_names import DRIVE_NETCDF as NETCDF
from ehlectric.runtime.result_names import EVENTS, SPECTRUM, SUMMARY
from ehlectric.runtime.result_names import OF_DRIVES as FILES

if TYPE_CHECKING:
    import xarray as xr

    from ehlectric.drive.result import DriveResult


def solve_to_folder(
    case: DriveCase,
    folder: str | Path,
    progress: Progress = silent,
    *,
    workers: int | None = None,
    others: Sequence[str] = (),
) -> RunOutcome[DriveResult]:
    """Solve a drive, and write summary.json, events.csv, spectrum.csv and drive.nc, and with a duty cycle
    duty.csv.

    Files of an earlier result in the folder are removed when the drive is solved, also the ``others``, such
    as figures. The outcome has a ``failure`` where a contact is not converged; its files are written all the
    same.
    """
    from ehlectric.drive.result import solve_drive

    load_library()
    names = (*FILES, *others)
    with alone_in(folder, names) as folder:
        result = solve_drive(case, progress=progress, workers=workers)
        files = save(result, folder, replaced=names)
    failure = None if result.converged else "not converged: a contact of a bearing"
    return RunOutcome(result, result.summary(), tuple(files), result.warnings, failure)


def save(result: DriveResult, folder: str | Path, *, replaced: Sequence[str] = ()) -> list[Path]:
    """Save the result of a drive: summary.json, drive.nc and its tables as CSV, all files or none.

    If the summary cannot be made, the simulation is saved before the error is raised. Files of the names
    ``replaced``, of an earlier result there, are removed. Raises an InputError where the folder cannot be
    used. The files are complete if an UnreadableError is raised, as ``load`` would refuse drive.nc.
    """
    heads = ["bearing", *(column_head(name, unit) for name, unit in EVENT_COLUMNS.items())]
    lines = [column_head(name, unit) for name, unit in SPECTRUM_COLUMNS.items()]
    dataset = result.to_xarray()
    contents: dict[str, Content] = {
        EVENTS: csv_of(heads, (row.values() for row in result.events())),
        SPECTRUM: csv_of(lines, result.spectrum().itertuples(index=False)),
        **({} if result.duty is None else result.duty.contents()),
        NETCDF: content_of(dataset),
    }
    with alone_in(folder, FILES, locks=[RESULT_LOCK]) as folder:
        try:
            contents = {SUMMARY: json_of(result.summary()), **contents}
        finally:
            files = write_together(folder, contents, (*FILES, *replaced))
    check_readable(dataset, folder / NETCDF, result_of)
    return files


def result_of(dataset: xr.Dataset, path: Path) -> DriveResult:
    """Result of a drive from the dataset of a drive.nc, equal to the one that was saved.

    It does not have the solved bearings. Raises an InputError that names the file where it is something else,
    or was damaged.
    """
    from ehlectric.drive.result import DriveResult

    check_format(dataset.attrs, SCHEMA, path, "the result of a drive")
    with refusing(path):
        solution, remedies, seconds, version = parts_of(dataset)
        duty, others = duties_of(dataset, len(remedies))
        return DriveResult(solution, tuple(remedies), duty, seconds, version, others)
