"""Results on disk: NetCDF, JSON and CSV, each file whole or not there."""

from __future__ import annotations

import json
import os
import secrets
import tempfile
import tomllib
import warnings
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ehlectric.case import Case
from ehlectric.conditions import resolve
from ehlectric.dataset import field_of, film_of, roughness_of, smooth_of
from ehlectric.errors import InputError
from ehlectric.result import Result, Smooth, scales_of

if TYPE_CHECKING:
    import xarray as xr

# It can only be read by setting it, for the whole process: once, at the start.
_UMASK = os.umask(0o077)
os.umask(_UMASK)

NETCDF = "result.nc"
SUMMARY = "summary.json"
FILM = "film.csv"
FILES = (SUMMARY, NETCDF, FILM)
FIGURE_FILES = (
    "film.png",
    "potential.png",
    "field_strength.png",
    "field_profiles.png",
    "field_deviation.png",
)
ROUGHNESS_FIGURE = "roughness.png"  # of rough contacts alone


def prepare(folder: str | Path, names: Iterable[str] = ()) -> Path:
    """Make a folder for files of these names, before anything is solved.

    Parameters
    ----------
    folder : str or Path
        Where the files will go.
    names : iterable of str
        Files that will be written there.

    Returns
    -------
    Path
        The folder.

    Raises
    ------
    InputError
        Where it cannot be made or written to, or a name is taken by something that is no file.
    """
    folder = Path(folder)
    if folder.exists() and not folder.is_dir():
        raise InputError(f"{folder}: cannot be written to, it is no folder")
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=folder):
            pass
    except OSError as error:
        reason = (error.strerror or str(error)).lower()
        raise InputError(f"{folder}: cannot be written to, {reason}") from None
    for name in names:
        refuse_special(folder / name)
    return folder


def refuse_special(path: Path) -> None:
    """Refuse to write where a folder, a device or a broken link is.

    Raises
    ------
    InputError
        Where ``path`` is there and no regular file.
    """
    if os.path.lexists(path) and not path.is_file():
        raise InputError(f"{path}: cannot be written to, it is no regular file")


def clear(folder: Path, names: Iterable[str]) -> None:
    """Take files of an earlier result away: a folder holds one result, whole."""
    for name in names:
        (folder / name).unlink(missing_ok=True)


@contextmanager
def whole(path: Path) -> Iterator[Path]:
    """A path beside ``path`` to write to; it becomes ``path`` when all went well, else it goes.

    A link is followed, and its target replaced.
    """
    path = path.resolve()
    beside = path.with_name(f".{path.stem}-{secrets.token_hex(4)}{path.suffix}")
    # Named before it is made: a signal in between must not leave it behind.
    try:
        beside.touch(mode=0o600, exist_ok=False)
        yield beside
        beside.chmod(0o666 & ~_UMASK)
        beside.replace(path)
    finally:
        beside.unlink(missing_ok=True)


def save(result: Result, folder: str | Path) -> list[Path]:
    """Write summary.json, result.nc and film.csv.

    Parameters
    ----------
    result : Result
        What ``solve`` gave.
    folder : str or Path
        Where to; made if it is not there.

    Returns
    -------
    list of Path
        The files written.

    Raises
    ------
    InputError
        Where the folder cannot be written to.
    """
    folder = prepare(folder, FILES)
    files = [folder / name for name in FILES]
    with whole(files[0]) as path:
        text = json.dumps(result.summary(), indent=2, allow_nan=False)
        path.write_text(text + "\n", encoding="utf-8")
    with whole(files[1]) as path:
        result.to_xarray().to_netcdf(path, engine="h5netcdf")
    with whole(files[2]) as path:
        film = result.film
        columns = np.column_stack([film.x, film.pressure, film.thickness, film.density])
        header = "x [m],pressure [Pa],thickness [m],density ratio [-]"
        np.savetxt(path, columns, delimiter=",", header=header, comments="", fmt="%.12g")
    return files


def load(path: str | Path) -> Result:
    """Read a result back from its NetCDF file.

    Parameters
    ----------
    path : str or Path
        A result.nc.

    Returns
    -------
    Result
        As it was saved.

    Raises
    ------
    InputError
        Where the file cannot be read or is not a result.
    """
    import xarray as xr

    path = Path(path)
    try:
        path.open("rb").close()
    except OSError as error:
        reason = (error.strerror or str(error)).lower()
        raise InputError(f"{path}: cannot be read, {reason}") from None
    try:
        with warnings.catch_warnings(), xr.open_dataset(path, engine="h5netcdf") as file:
            warnings.simplefilter("ignore")  # of what xarray thinks of files that are refused below
            dataset = file.load()
    except Exception:  # whatever HDF5 and its wrappers raise at damaged files
        raise InputError(f"{path}: is not a NetCDF file") from None
    try:
        return _result_of(dataset)
    except (InputError, ArithmeticError, AttributeError, LookupError, TypeError, ValueError):
        raise InputError(f"{path}: is not a result of ehlectric, or damaged") from None


def _result_of(dataset: xr.Dataset) -> Result:
    if not all(np.all(np.isfinite(variable.values)) for variable in dataset.variables.values()):
        raise ValueError("a value is not finite")
    if min(dataset.sizes[name] for name in ("x", "x_field", "s")) < 2:
        raise ValueError("an array is empty")
    attributes = dataset.attrs
    case = Case.from_dict(tomllib.loads(attributes["case"]))
    conditions = resolve(case)
    scales = scales_of(case, conditions)
    film_seconds, field_seconds = json.loads(attributes["seconds"])
    return Result(
        case=case,
        conditions=conditions,
        film=film_of(dataset, scales),
        roughness=roughness_of(dataset),
        rough=tuple(json.loads(attributes["rough"])),
        smooth=Smooth(**smooth) if (smooth := smooth_of(dataset)) else None,
        field=field_of(dataset),
        warnings=tuple(json.loads(attributes["warnings"])),
        film_solver=str(attributes["film_solver"]),
        field_solver=str(attributes["field_solver"]),
        film_seconds=film_seconds,
        field_seconds=field_seconds,
        version=str(attributes["version"]),
        date=str(attributes["date"]),
    )
