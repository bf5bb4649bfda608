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
from typing import TYPE_CHECKING, Any

import numpy as np

from ehlectric.case import Case
from ehlectric.conditions import resolve
from ehlectric.dataset import (
    LINE_LAYOUT,
    POINT_LAYOUT,
    field_parts,
    film_parts,
    roughness_of,
    smooth_of,
)
from ehlectric.errors import InputError
from ehlectric.field import Field
from ehlectric.film import Film
from ehlectric.point_conditions import resolve_point
from ehlectric.point_field import PointField
from ehlectric.point_film import PointFilm
from ehlectric.point_result import PointResult
from ehlectric.problems import scales_of
from ehlectric.result import Result
from ehlectric.solution import Smooth
from ehlectric.typing import Array

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
POINT_FIGURE_FILES = (
    "film_map.png",
    "pressure_map.png",
    "field_map.png",
    "field_deviation.png",
    "field_sections.png",
    "cuts.png",
)
# Of a whole bearing: loads and films, the circuit, its course over a pitch of the cage, and over frequency.
BEARING_FIGURE_FILES = (
    "bearing_loads.png",
    "bearing_circuit.png",
    "bearing_pitch.png",
    "bearing_impedance.png",
)
# And over the speed of the shaft.
SPEED_FIGURE_FILES = ("capacitance_over_speed.png", "breakdown_over_speed.png")
# Of roughness that moves: over time, over position and time, and beside the same roughness held still.
MOTION_FIGURE_FILES = ("motion_history.png", "motion_maps.png", "motion_beside_stationary.png")
# A folder holds one result: what another one left of these goes.
ALL_FIGURES = tuple(dict.fromkeys((*FIGURE_FILES, *POINT_FIGURE_FILES, ROUGHNESS_FIGURE)))


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


def save(result: Result | PointResult, folder: str | Path) -> list[Path]:
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
        columns, names = _film_columns(result)
        header = ",".join([*names, "pressure [Pa]", "thickness [m]", "density ratio [-]"])
        np.savetxt(path, columns, delimiter=",", header=header, comments="", fmt="%.12g")
    return files


def _film_columns(result: Result | PointResult) -> tuple[Array, list[str]]:
    """The film as a table, one line a node, and the names of its positions."""
    film, names = result.film, ["x [m]"]
    positions = [film.x]
    if isinstance(result, PointResult):
        names.append("y [m]")
        positions = [at.ravel() for at in np.meshgrid(film.x, result.film.y, indexing="ij")]
    values = (film.pressure, film.thickness, film.density)
    return np.column_stack([*positions, *(value.ravel() for value in values)]), names


def load(path: str | Path) -> Result | PointResult:
    """Read a result back from its NetCDF file.

    Parameters
    ----------
    path : str or Path
        A result.nc.

    Returns
    -------
    Result or PointResult
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


def _result_of(dataset: xr.Dataset) -> Result | PointResult:
    case = Case.from_dict(tomllib.loads(dataset.attrs["case"]))
    point = case.contact.geometry == "point"
    layout = POINT_LAYOUT if point else LINE_LAYOUT
    if not all(np.all(np.isfinite(variable.values)) for variable in dataset.variables.values()):
        raise ValueError("a value is not finite")
    if min(dataset.sizes[name] for name in {*layout.film_grid, *layout.field_grid, "s"}) < 2:
        raise ValueError("an array is empty")
    film, field = film_parts(layout, dataset), field_parts(layout, dataset)
    if point:
        conditions = resolve_point(case)
        return PointResult(
            case=case,
            conditions=conditions,
            film=PointFilm(**film, scales=scales_of(case, conditions)),
            field=PointField(**field),
            **_provenance(dataset),
        )
    of_line = resolve(case)
    return Result(
        case=case,
        conditions=of_line,
        film=Film(**film, scales=scales_of(case, of_line)),
        field=Field(**field),
        **_provenance(dataset),
    )


def _provenance(dataset: xr.Dataset) -> dict[str, Any]:
    """What all solutions have beside their case, film and field."""
    attributes, smooth = dataset.attrs, smooth_of(dataset)
    film_seconds, field_seconds = json.loads(attributes["seconds"])
    return {
        "roughness": roughness_of(dataset),
        "rough": tuple(json.loads(attributes["rough"])),
        "smooth": Smooth(**smooth) if smooth else None,
        "warnings": tuple(json.loads(attributes["warnings"])),
        "film_solver": str(attributes["film_solver"]),
        "field_solver": str(attributes["field_solver"]),
        "film_seconds": film_seconds,
        "field_seconds": field_seconds,
        "version": str(attributes["version"]),
        "date": str(attributes["date"]),
    }
