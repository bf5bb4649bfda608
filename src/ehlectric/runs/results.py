"""Saving and loading of results of every kind: ``save`` and ``load``."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, TypeAlias

from ehlectric.bearing import files as of_bearings
from ehlectric.bearing.result import BearingResult
from ehlectric.bearing.stored import SCHEMA as BEARING
from ehlectric.contact import files as of_contacts
from ehlectric.contact.results import PointResult, Result
from ehlectric.contact.stored import SCHEMA as CONTACT
from ehlectric.drive import files as of_drives
from ehlectric.drive.result import DriveResult
from ehlectric.drive.stored import SCHEMA as DRIVE
from ehlectric.errors import InputError, shown
from ehlectric.motion.result import MotionResult
from ehlectric.motion.stored import SCHEMA as MOVING
from ehlectric.motion.stored_run import checked_motion
from ehlectric.runs.folders import stored_result
from ehlectric.runtime.checks.schema import format_of
from ehlectric.runtime.netcdf import read_dataset
from ehlectric.sweep.store import NAME as SWEEP

if TYPE_CHECKING:
    import xarray as xr

AnyResult: TypeAlias = Result | PointResult | BearingResult | DriveResult | MotionResult


def _moving(dataset: xr.Dataset, path: Path) -> MotionResult:
    """Result with moving roughness, whose file may be incomplete."""
    return MotionResult.of(checked_motion(dataset, path))


# Results by the kinds that their files state.
_OF_KINDS: Mapping[str, Callable[[xr.Dataset, Path], AnyResult]] = {
    format_of(schema)[0]: result_of
    for schema, result_of in (
        (CONTACT, of_contacts.result_of),
        (BEARING, of_bearings.result_of),
        (DRIVE, of_drives.result_of),
        (MOVING, _moving),
    )
}


def load(path: str | Path) -> AnyResult:
    """Load the result of a contact, of a bearing, of a drive or of a contact with moving roughness.

    Parameters
    ----------
    path : str or Path
        A result.nc, bearing.nc, drive.nc or motion.nc, or the folder with this file.

    Returns
    -------
    Result, PointResult, BearingResult, DriveResult or MotionResult
        Result, equal to the one that was saved. That of a drive does not have its solved bearings.

    Raises
    ------
    InputError
        Where the file cannot be read or is not a result, or the folder has none, several, or a sweep.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> from ehlectric import solve
    >>> contact = {"reduced_radius": "14.1 mm", "reduced_modulus": "226 GPa"}
    >>> contact |= {"max_hertz_pressure": "1 GPa", "entrainment_speed": "4 m/s"}
    >>> result = solve({"contact": contact, "lubricant": {"base": "paper"}, "grid": {"nodes": 401}})
    >>> with TemporaryDirectory() as folder:
    ...     files = save(result, folder)
    ...     load(folder) == result
    True
    """
    path = stored_result(path)
    if path.name == SWEEP:
        raise InputError(path.parent, "is the folder of a sweep", takes="a result; read_sweep reads a sweep")
    dataset = read_dataset(path)
    kind, _ = format_of(dataset.attrs.get("schema"))
    if kind not in _OF_KINDS:
        raise InputError(path, "is not a result of ehlectric")
    return _OF_KINDS[kind](dataset, path)


def save(result: Result | PointResult | BearingResult | DriveResult, folder: str | Path) -> list[Path]:
    """Save the result of a contact, of a bearing or of a drive.

    Parameters
    ----------
    result : Result, PointResult, BearingResult or DriveResult
        Result of ``solve``. A contact writes summary.json, result.nc and film.csv; a bearing writes
        summary.json, contacts.csv, bearing.nc and, where it has one, impedance.csv; a drive writes
        summary.json, events.csv, spectrum.csv and drive.nc.
    folder : str or Path
        Folder of the files; it is made if it does not exist.

    Returns
    -------
    list of Path
        Files written.

    Raises
    ------
    InputError
        Where the folder cannot be written to, or the result has no case, which the files must hold. Also
        for a result of ``solve_motion``, which ``run_motion`` writes while it is solved.
    """
    if isinstance(result, BearingResult):
        return of_bearings.save(result, folder)
    if isinstance(result, DriveResult):
        return of_drives.save(result, folder)
    if isinstance(result, Result | PointResult):
        return of_contacts.save(result, folder)
    raise InputError(
        "result", got=shown(type(result).__name__), takes="a result of a contact, a bearing or a drive"
    )
