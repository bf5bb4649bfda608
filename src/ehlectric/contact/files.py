"""Results on disk: summary.json, result.nc and film.csv, and back."""

from __future__ import annotations

import json
import tomllib
import warnings
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ehlectric.arrays import Array
from ehlectric.cases.case import Case
from ehlectric.contact.conditions import resolve, resolve_point
from ehlectric.contact.dataset import (
    LINE_LAYOUT,
    POINT_LAYOUT,
    field_parts,
    film_parts,
    roughness_of,
    smooth_of,
)
from ehlectric.contact.problems import scales_of
from ehlectric.contact.results import PointResult, Result
from ehlectric.contact.solution import Smooth
from ehlectric.errors import InputError
from ehlectric.field.line import Field
from ehlectric.field.point import PointField
from ehlectric.film.line import Film
from ehlectric.film.point import PointFilm
from ehlectric.runtime.files import prepare, whole
from ehlectric.runtime.stored_warnings import of_attributes

if TYPE_CHECKING:
    import xarray as xr


NETCDF = "result.nc"
SUMMARY = "summary.json"
FILM = "film.csv"
FILES = (SUMMARY, NETCDF, FILM)


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
        raise InputError(path, f"cannot be read, {reason}") from None
    try:
        with warnings.catch_warnings(), xr.open_dataset(path, engine="h5netcdf") as file:
            warnings.simplefilter("ignore")  # of what xarray thinks of files that are refused below
            dataset = file.load()
    except Exception:  # whatever HDF5 and its wrappers raise at damaged files
        raise InputError(path, "is not a NetCDF file") from None
    try:
        return _result_of(dataset)
    except (InputError, ArithmeticError, AttributeError, LookupError, TypeError, ValueError):
        raise InputError(path, "is not a result of ehlectric, or damaged") from None


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
        "warnings": of_attributes(attributes),
        "film_solver": str(attributes["film_solver"]),
        "field_solver": str(attributes["field_solver"]),
        "film_seconds": film_seconds,
        "field_seconds": field_seconds,
        "version": str(attributes["version"]),
        "date": str(attributes["date"]),
    }
