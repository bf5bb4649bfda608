"""Run of a contact: its solution with the files of its results, summary.json, result.nc and film.csv."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, BinaryIO

import numpy as np

from ehlectric.cases.case import Case
from ehlectric.contact.contact_kinds import KINDS
from ehlectric.contact.contact_refinement import FilmProgress
from ehlectric.contact.preparation import PreparedContact
from ehlectric.contact.problems import scales_of
from ehlectric.contact.result import RESULTS, PointResult, Result, film_columns
from ehlectric.contact.solver import DEFAULT_SOLVERS, Solvers, solve
from ehlectric.contact.stored import SCHEMA, layout_of, parts_of, stored_case
from ehlectric.errors import InputError
from ehlectric.runtime.file_rules import check_format, refusing
from ehlectric.runtime.files import Content, json_of, write_together
from ehlectric.runtime.folders import RESULT_LOCK, alone_in
from ehlectric.runtime.netcdf import check_readable, content_of, load_library
from ehlectric.runtime.progress import Progress, RunOutcome, silent
from ehlectric.runtime.result_names import CONTACT_NETCDF as NETCDF
from ehlectric.runtime.result_names import FILM, SUMMARY
from ehlectric.runtime.result_names import OF_CONTACTS as FILES

if TYPE_CHECKING:
    import xarray as xr


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
    folder cannot be used, or the result has no case, which the files must hold. The files are complete if an
    UnreadableError is raised, as ``load`` would refuse result.nc.
    """
    if not isinstance(result.case, Case):
        raise InputError("result", got="one of solve_contact, which has no case;", takes="one of solve(case)")
    summary = result.summary()
    layout = layout_of(result, summary)
    contents: dict[str, Content] = {
        SUMMARY: json_of(summary),
        NETCDF: content_of(layout),
        FILM: partial(_write_film, result),
        **(further or {}),
    }
    with alone_in(folder, FILES, locks=[RESULT_LOCK]) as folder:
        files = write_together(folder, contents, replaced)
    check_readable(layout, folder / NETCDF, result_of)
    return files


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


def solve_to_folder(
    contact: PreparedContact,
    folder: str | Path,
    progress: Progress = silent,
    *,
    solvers: Solvers = DEFAULT_SOLVERS,
    others: Sequence[str] = (),
    further: Mapping[str, Content] | None = None,
) -> RunOutcome[Result | PointResult]:
    """Solve a prepared contact, and write summary.json, result.nc and film.csv.

    The folder is made if it does not exist. A film that did not converge is written too, and is the
    ``failure`` of the outcome. Raises an InputError where the folder cannot be used, or another command
    writes into the folder.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> from ehlectric.contact.preparation import prepare
    >>> contact = {"reduced_radius": "14.1 mm", "reduced_modulus": "226 GPa"}
    >>> contact |= {"max_hertz_pressure": "1 GPa", "entrainment_speed": "4 m/s"}
    >>> case = Case.from_dict({"contact": contact, "lubricant": {"base": "paper"}, "grid": {"nodes": 401}})
    >>> with TemporaryDirectory() as folder:
    ...     outcome = solve_to_folder(prepare(case), folder)
    >>> outcome.converged, [path.name for path in outcome.files]
    (True, ['summary.json', 'result.nc', 'film.csv'])
    """
    load_library()
    names = (*FILES, *(further or ()), *others)
    with alone_in(folder, names) as folder:
        film_progress = FilmProgress(contact.reach)
        result = solve(
            contact,
            progress=lambda nodes, step, residual: progress(0, 0, film_progress.text(nodes, step, residual)),
            solvers=solvers,
            on_grid=film_progress.on_grid,
        )
        progress(0, 0, "writing results")
        files = save(result, folder, replaced=names, further=further)
    failure = None if result.converged else f"not converged: {result.film.status}"
    return RunOutcome(result, result.summary(), tuple(files), result.warnings, failure)
