"""Files of a contact's result: summary.json, result.nc and film.csv."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, BinaryIO

import numpy as np

from ehlectric.cases.case import Case
from ehlectric.contact.kinds import KINDS
from ehlectric.contact.problems import scales_of
from ehlectric.contact.results import RESULTS, PointResult, Result
from ehlectric.contact.solution import Smooth
from ehlectric.contact.storage.content import check
from ehlectric.contact.storage.dataset import (
    SCHEMA,
    coarser_of,
    field_parts,
    film_columns,
    film_parts,
    roughness_of,
    smooth_of,
)
from ehlectric.errors import InputError
from ehlectric.lubricant.own import SampledLaws, is_laws
from ehlectric.runtime.checks.formats import check_format
from ehlectric.runtime.checks.schema import case_of, refusing
from ehlectric.runtime.checks.schema import json_of as attribute
from ehlectric.runtime.files import Content, json_of, write_together
from ehlectric.runtime.folders import RESULT_LOCK, alone_in
from ehlectric.runtime.netcdf import content_of, read_dataset
from ehlectric.runtime.stored_warnings import of_attributes

if TYPE_CHECKING:
    import xarray as xr


NETCDF = "result.nc"
SUMMARY = "summary.json"
FILM = "film.csv"
FILES = (SUMMARY, NETCDF, FILM)

# Heads of film.csv that differ from the name of the attribute.
_CSV = {"density": "density ratio"}


def save(
    result: Result | PointResult,
    folder: str | Path,
    *,
    replaced: Sequence[str] = (),
    further: Mapping[str, Content] | None = None,
) -> list[Path]:
    """Write summary.json, result.nc and film.csv, all of them or none.

    Parameters
    ----------
    result : Result or PointResult
        Result of ``solve``.
    folder : str or Path
        Folder of the files; it is made if it does not exist.
    replaced : sequence of str
        Names of further files of an earlier result there, which are removed.
    further : mapping of str to bytes or callable, optional
        Content of further files by their names, which are written together with the others.

    Returns
    -------
    list of Path
        Files written.

    Raises
    ------
    InputError
        Where the folder cannot be written to, its disk is full, another command writes into it, or the
        result has no case, which the files must hold.
    """
    if not isinstance(result.case, Case):
        raise InputError("result", got="one of solve_contact, which has no case;", takes="one of solve(case)")
    contents: dict[str, Content] = {
        SUMMARY: json_of(result.summary()),
        NETCDF: content_of(result.to_xarray()),
        FILM: partial(_write_film, result),
        **(further or {}),
    }
    with alone_in(folder, FILES, locks=[RESULT_LOCK]) as folder:
        return write_together(folder, contents, replaced)


def _write_film(result: Result | PointResult, file: BinaryIO) -> None:
    """Write the columns of a film as CSV."""
    columns = film_columns(result.film)
    header = ",".join(f"{_CSV.get(name, name)} [{unit or '-'}]" for name, (_, unit) in columns.items())
    values = np.column_stack([column for column, _ in columns.values()])
    np.savetxt(file, values, delimiter=",", header=header, comments="", fmt="%.12g")


def load(path: str | Path) -> Result | PointResult:
    """Load the result of a contact from its NetCDF file.

    Parameters
    ----------
    path : str or Path
        A result.nc.

    Returns
    -------
    Result or PointResult
        Result, equal to the one that was saved.

    Raises
    ------
    InputError
        Where the file cannot be read or is not the result of a contact.
    """
    path = Path(path)
    return result_of(read_dataset(path), path)


def result_of(dataset: xr.Dataset, path: Path) -> Result | PointResult:
    """Result of a contact from its dataset.

    Parameters
    ----------
    dataset : xarray.Dataset
        Contents of a result.nc.
    path : Path
        The file, named in the error.

    Returns
    -------
    Result or PointResult
        Result, equal to the one that was saved.

    Raises
    ------
    InputError
        Where the dataset is not the result of a contact, or of a later version.
    DamagedError
        Where its content is not as it was written.
    """
    check_format(dataset.attrs, SCHEMA, path, "the result of a contact", unnamed=True)
    if "case" not in dataset.attrs:
        raise InputError(path, "is not a result of ehlectric")
    with refusing(path):
        return _result_of(dataset)


def _result_of(dataset: xr.Dataset) -> Result | PointResult:
    case = case_of(dataset.attrs, Case.from_dict)
    if "laws" in dataset.attrs:
        case = case.with_laws(SampledLaws.restored(attribute(dataset.attrs, "laws", is_laws)))
    kind = KINDS[case.contact.geometry]
    layout = kind.layout
    check(layout, dataset)
    conditions = kind.resolve(case)
    return RESULTS[case.contact.geometry](
        case=case,
        conditions=conditions,
        film=kind.film(**film_parts(layout, dataset), scales=scales_of(case, conditions)),
        field=kind.field(**field_parts(layout, dataset)),
        **_provenance(dataset),
    )


def _provenance(dataset: xr.Dataset) -> dict[str, Any]:
    """Parts of a result beside its case, film and field."""
    attributes, smooth = dataset.attrs, smooth_of(dataset)
    film_seconds, field_seconds = json.loads(attributes["seconds"])
    return {
        "roughness": roughness_of(dataset),
        "rough": tuple(json.loads(attributes["rough"])),
        "smooth": Smooth(**smooth) if smooth else None,
        "coarser": coarser_of(dataset),
        "warnings": of_attributes(attributes),
        "film_solver": str(attributes["film_solver"]),
        "field_solver": str(attributes["field_solver"]),
        "film_seconds": film_seconds,
        "field_seconds": field_seconds,
        "version": str(attributes["version"]),
        "date": str(attributes["date"]),
    }
