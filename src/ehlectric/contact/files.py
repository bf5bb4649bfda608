"""Files of a contact's result: summary.json, result.nc and film.csv."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, BinaryIO

import numpy as np

from ehlectric.cases.case import Case
from ehlectric.contact.kinds import KINDS
from ehlectric.contact.problems import scales_of
from ehlectric.contact.results import RESULTS, PointResult, Result, film_columns
from ehlectric.contact.stored import SCHEMA, parts_of, stored_case
from ehlectric.errors import InputError
from ehlectric.runtime.checks.schema import check_format, refusing
from ehlectric.runtime.files import Content, json_of, write_together
from ehlectric.runtime.folders import RESULT_LOCK, alone_in
from ehlectric.runtime.netcdf import content_of

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
    """Write summary.json, result.nc and film.csv, all of them or none, with the content of further files.

    Files of the names ``replaced``, of an earlier result there, are removed. Raises an InputError where the
    folder cannot be used, or the result has no case, which the files must hold.
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


def result_of(dataset: xr.Dataset, path: Path) -> Result | PointResult:
    """Result of a contact from the dataset of a result.nc, equal to the one that was saved.

    Raises an InputError that names the file where it is something else, or was damaged.
    """
    check_format(dataset.attrs, SCHEMA, path, "the result of a contact")
    with refusing(path):
        case = stored_case(dataset.attrs)
        geometry = case.contact.geometry
        conditions = KINDS[geometry].resolve(case)
        parts = parts_of(dataset, geometry, scales_of(case, conditions))
        return RESULTS[geometry](case=case, conditions=conditions, **parts)
