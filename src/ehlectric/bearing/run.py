"""Run of a bearing and the files of its result: summary.json, bearing.nc and tables as CSV."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from ehlectric.bearing.impedance import impedance_of
from ehlectric.bearing.result import BearingResult, check_bearing, contact_units, solve_bearing
from ehlectric.bearing.stored import SCHEMA, duty_of, layout_of, solution_of
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.runtime.file_rules import check_format, refusing
from ehlectric.runtime.files import Content, column_head, csv_of, json_of, write_together
from ehlectric.runtime.folders import RESULT_LOCK, alone_in
from ehlectric.runtime.netcdf import check_readable, content_of, load_library
from ehlectric.runtime.progress import Progress, RunOutcome, silent
from ehlectric.runtime.result_names import BEARING_NETCDF as NETCDF
from ehlectric.runtime.result_names import CONTACTS, IMPEDANCE, SUMMARY
from ehlectric.runtime.result_names import OF_BEARINGS as FILES

if TYPE_CHECKING:
    import xarray as xr


def solve_to_folder(
    case: BearingCase,
    folder: str | Path,
    progress: Progress = silent,
    *,
    workers: int | None = None,
    others: Sequence[str] = (),
    further: Mapping[str, Content] | None = None,
) -> RunOutcome[BearingResult]:
    """Solve a whole bearing, and write summary.json, contacts.csv, impedance.csv, duty.csv and bearing.nc.

    Files of an earlier result in the folder are removed when the bearing is solved, also the ``others``, such
    as figures. The outcome has a ``failure`` where a contact is not converged; its files are written all the
    same.

    >>> from tempfile import TemporaryDirectory
    >>> duty = {"radial_load": "1 kN", "inner_speed": "3000 rpm", "temperature": "70 degC"}
    >>> case = BearingCase.from_dict(
    ...     {
    ...         "contacts": "formula",
    ...         "bearing": duty | {"base": "6208", "radial_clearance": "10 um", "composite_rq": "0.03 um"},
    ...         "lubricant": {"base": "paper", "viscosity": "20 mPa s"},
    ...     }
    ... )
    >>> with TemporaryDirectory() as folder:
    ...     outcome = solve_to_folder(case, folder)
    >>> outcome.converged, [path.name for path in outcome.files]
    (True, ['summary.json', 'contacts.csv', 'bearing.nc'])
    """
    load_library()
    check_bearing(case)
    names = (*FILES, *(further or ()), *others)
    with alone_in(folder, names) as folder:
        result = solve_bearing(case, progress=progress, workers=workers)
        files = save(result, folder, replaced=names, further=further)
    failure = None if result.converged else "not converged: a contact of the bearing"
    return RunOutcome(result, result.summary(), tuple(files), result.all_warnings, failure)


def save(
    result: BearingResult,
    folder: str | Path,
    *,
    replaced: Sequence[str] = (),
    further: Mapping[str, Content] | None = None,
) -> list[Path]:
    """Save the result of a bearing: summary.json, bearing.nc and tables as CSV, all or none.

    The file impedance.csv is written only if the bearing has an impedance, and duty.csv only if it has a duty
    cycle. Further files are written together
    with these, and files with the names ``replaced`` are removed. Raises an InputError where the folder
    cannot be used. The files are complete if an UnreadableError is raised, as ``load`` would refuse
    bearing.nc.
    """
    summary, impedance = result.summary(), impedance_of(result.solution)
    rows = summary["contacts"]
    units = contact_units()
    heads = [column_head(name, units[name]) if name in units else name for name in rows[0]]
    contents: dict[str, Content] = {
        SUMMARY: json_of(summary),
        CONTACTS: csv_of(heads, (row.values() for row in rows)),
    }
    if impedance is not None:
        columns = [impedance.frequency.tolist(), impedance.magnitude.tolist(), impedance.phase.tolist()]
        units = {"frequency": "Hz", "magnitude": "ohm", "phase_degrees": "deg"}
        if impedance.mean is not None:
            columns += [impedance.mean.magnitude.tolist(), impedance.mean.phase.tolist()]
            units |= {"mean_magnitude": "ohm", "mean_phase_degrees": "deg"}
        heads = [column_head(*column) for column in units.items()]
        contents[IMPEDANCE] = csv_of(heads, zip(*columns, strict=True))
    if result.duty is not None:
        contents |= result.duty.contents()
    layout = layout_of(result.solution, result.duty)
    contents[NETCDF] = content_of(layout)
    contents |= further or {}
    with alone_in(folder, FILES, locks=[RESULT_LOCK]) as folder:
        files = write_together(folder, contents, (*FILES, *replaced))
    check_readable(layout, folder / NETCDF, result_of)
    return files


def result_of(dataset: xr.Dataset, path: Path) -> BearingResult:
    """Result of a bearing from the dataset of a bearing.nc, equal to the one that was saved.

    Raises an InputError that names the file where it is something else, or was damaged.
    """
    check_format(dataset.attrs, SCHEMA, path, "the result of a bearing")
    with refusing(path):
        return BearingResult(solution_of(dataset), duty_of(dataset))
