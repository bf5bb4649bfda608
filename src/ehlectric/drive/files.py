"""Run of a drive and the files of its result: summary.json, events.csv, spectrum.csv and drive.nc."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from ehlectric.cases.drives.case import DriveCase
from ehlectric.quantities.drive_results import EVENT_COLUMNS, SPECTRUM_COLUMNS
from ehlectric.runtime.checks.formats import check_format
from ehlectric.runtime.checks.schema import refusing
from ehlectric.runtime.files import Content, json_of, write_together
from ehlectric.runtime.folders import RESULT_LOCK, alone_in
from ehlectric.runtime.netcdf import content_of, load_library, read_dataset
from ehlectric.runtime.outcome import RunOutcome
from ehlectric.runtime.progress import Progress, silent
from ehlectric.runtime.tables import column_head, csv_of

if TYPE_CHECKING:
    import xarray as xr

    from ehlectric.drive.result import DriveResult

SUMMARY, EVENTS, SPECTRUM, NETCDF = "summary.json", "events.csv", "spectrum.csv", "drive.nc"
FILES = (SUMMARY, EVENTS, SPECTRUM, NETCDF)


def run(
    case: DriveCase,
    folder: str | Path,
    progress: Progress = silent,
    *,
    workers: int | None = None,
    others: Sequence[str] = (),
) -> RunOutcome[DriveResult]:
    """Solve a drive, and write summary.json, events.csv, spectrum.csv and drive.nc.

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
    from ehlectric.drive.result import solve_drive

    load_library()
    names = (*FILES, *others)
    with alone_in(folder, names) as folder:
        result = solve_drive(case, progress=progress, workers=workers)
        files = save(result, folder, replaced=names)
    failure = None if result.converged else "not converged: a contact of a bearing"
    return RunOutcome(result, result.summary(), tuple(files), result.warnings, failure)


def save(result: DriveResult, folder: str | Path, *, replaced: Sequence[str] = ()) -> list[Path]:
    """Save the result of a drive: summary.json, events.csv, spectrum.csv and drive.nc, all or none.

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
    lines = [column_head(name, unit) for name, unit in SPECTRUM_COLUMNS.items()]
    contents: dict[str, Content] = {
        SUMMARY: json_of(result.summary()),
        EVENTS: csv_of(heads, (row.values() for row in result.events())),
        SPECTRUM: csv_of(lines, result.spectrum().itertuples(index=False)),
        NETCDF: content_of(result.to_xarray()),
    }
    with alone_in(folder, FILES, locks=[RESULT_LOCK]) as folder:
        return write_together(folder, contents, (*FILES, *replaced))


def load(path: str | Path) -> DriveResult:
    """Load the result of a drive from its NetCDF file.

    Parameters
    ----------
    path : str or Path
        Path of a drive.nc.

    Returns
    -------
    DriveResult
        Result, equal to the one that was saved; it does not have the solved bearings.

    Raises
    ------
    InputError
        If the file cannot be read, or is not the result of a drive.
    """
    path = Path(path)
    return result_of(read_dataset(path), path)


def result_of(dataset: xr.Dataset, path: Path) -> DriveResult:
    """Result of a drive from its dataset.

    Parameters
    ----------
    dataset : xarray.Dataset
        Contents of a drive.nc.
    path : Path
        The file, named in the error.

    Returns
    -------
    DriveResult
        Result, equal to the one that was saved.

    Raises
    ------
    InputError
        Where the dataset is not the result of a drive.
    DamagedError
        Where its content is not as it was written.
    """
    from ehlectric.drive.result import DriveResult
    from ehlectric.drive.storage.dataset import SCHEMA, parts_of

    check_format(dataset.attrs, SCHEMA, path, "the result of a drive")
    with refusing(path):
        solution, remedies, seconds, version = parts_of(dataset)
        return DriveResult(solution, tuple(remedies), seconds, version)
