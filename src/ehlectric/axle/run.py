"""Run of an axle and the files of its result: summary.json and tables as CSV."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ehlectric.axle.result import AxleResult, solve_axle
from ehlectric.axle.stored import SCHEMA, duty_of, solutions_of
from ehlectric.axle.stored_discharges import discharges_of
from ehlectric.cases.axle_case import AxleCase
from ehlectric.quantities.quantity import Quantity
from ehlectric.quantities.results import AXLE_ELEMENT_KEYS, AXLE_SHAFT_KEYS, EVENT_COLUMNS
from ehlectric.runtime.file_rules import check_format, number_of, refusing, text_of
from ehlectric.runtime.files import Content, column_head, csv_of, json_of, plain, write_together
from ehlectric.runtime.folders import RESULT_LOCK, alone_in
from ehlectric.runtime.netcdf import check_readable, content_of, load_library
from ehlectric.runtime.progress import Progress, RunOutcome, silent
from ehlectric.runtime.result_names import AXLE_NETCDF as NETCDF
from ehlectric.runtime.result_names import ELEMENTS, EVENTS, SHAFTS, SUMMARY
from ehlectric.runtime.result_names import OF_AXLES as FILES

if TYPE_CHECKING:
    import xarray as xr


def solve_to_folder(
    case: AxleCase, folder: str | Path, progress: Progress = silent, *, others: Sequence[str] = ()
) -> RunOutcome[AxleResult]:
    """Solve an axle, and write summary.json, axle.nc, elements.csv with bearings and meshes, and shafts.csv.

    Files of an earlier result in the folder are removed when the axle is solved, also the ``others``. The
    outcome has a ``failure`` where a contact is not converged; its files are written nevertheless.
    """
    load_library()
    names = (*FILES, *others)
    with alone_in(folder, names) as folder:
        result = solve_axle(case, progress=progress)
        files = save(result, folder, replaced=names)
    failure = None if result.converged else "not converged: a contact of a bearing"
    warnings = (*result.all_warnings, *result.warnings_of_remedies)
    return RunOutcome(result, result.summary(), tuple(files), warnings, failure)


def save(result: AxleResult, folder: str | Path, *, replaced: Sequence[str] = ()) -> list[Path]:
    """Save the result of an axle: summary.json, axle.nc and its tables as CSV, all files or none.

    Files of the names ``replaced``, of an earlier result there, are removed. Raises an InputError where the
    folder cannot be used. The files are complete if an UnreadableError is raised, as ``load`` would refuse
    axle.nc.
    """
    summary = result.summary()
    contents: dict[str, Content] = {
        SUMMARY: json_of(plain(summary)),
        ELEMENTS: _csv(summary["elements"], AXLE_ELEMENT_KEYS),
        SHAFTS: _csv(summary["shafts"], AXLE_SHAFT_KEYS),
        NETCDF: content_of(layout := result.layout()),
    }
    if result.duty is not None:
        contents |= result.duty.contents()
    if result.discharges is not None:
        heads = ["element", *(column_head(name, unit) for name, unit in EVENT_COLUMNS.items())]
        contents[EVENTS] = csv_of(heads, (row.values() for row in result.discharges.events()))
    with alone_in(folder, FILES, locks=[RESULT_LOCK]) as folder:
        files = write_together(folder, contents, (*FILES, *replaced))
    check_readable(layout, folder / NETCDF, result_of)
    return files


def result_of(dataset: xr.Dataset, path: Path) -> AxleResult:
    """Result of an axle from the dataset of an axle.nc, equal to the one that was saved. Raises an InputError
    that names the file where it is something else, or was damaged.
    """
    check_format(dataset.attrs, SCHEMA, path, "the result of an axle")
    with refusing(path):
        solution, *remedies = solutions_of(dataset)
        seconds, version = number_of(dataset.attrs, "seconds"), text_of(dataset.attrs, "version")
        probable = number_of(dataset.attrs, "probable", "0 or 1") == 1.0
        duty = duty_of(dataset, solution.case)
        simulated = discharges_of(dataset, [solution, *remedies])
    return AxleResult(solution, tuple(remedies), seconds, version, probable, duty, simulated)


def _csv(rows: Sequence[Mapping[str, Any]], columns: Mapping[str, Quantity]) -> Content:
    """Rows as CSV, with the units of the columns in their heads."""
    heads = [column_head(key, about.unit) for key, about in columns.items()]
    return csv_of(heads, ([row[key] for key in columns] for row in rows))
