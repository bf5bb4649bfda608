"""Run of a gear pair and the files of its result: summary.json, gear.nc and tables as CSV."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from ehlectric.cases.gear_case import GearCase
from ehlectric.gear.result import GearResult, solve_gear
from ehlectric.gear.stored import SCHEMA, duty_of, layout_of, solution_of, spread_of
from ehlectric.quantities.results import PHASE_COLUMNS, POINT_KEYS
from ehlectric.runtime.file_rules import check_format, number_of, refusing
from ehlectric.runtime.files import Content, column_head, csv_of, json_of, plain, write_together
from ehlectric.runtime.folders import RESULT_LOCK, alone_in
from ehlectric.runtime.netcdf import check_readable, content_of, load_library
from ehlectric.runtime.progress import Progress, RunOutcome, silent
from ehlectric.runtime.result_names import GEAR_NETCDF as NETCDF
from ehlectric.runtime.result_names import MESH, PATH, SUMMARY
from ehlectric.runtime.result_names import OF_GEARS as FILES

if TYPE_CHECKING:
    import xarray as xr


def solve_to_folder(
    case: GearCase, folder: str | Path, progress: Progress = silent, *, others: Sequence[str] = ()
) -> RunOutcome[GearResult]:
    """Solve a gear pair, and write summary.json, path.csv with the points of the path of contact, mesh.csv
    with capacitance and breakdown voltage over the phase of the mesh, gear.nc and, with a duty cycle,
    duty.csv.

    Files of an earlier result in the folder are removed when the pair is solved, also the ``others``.
    """
    load_library()
    progress(0, 0, "solving films")
    result = solve_gear(case)
    files = save(result, folder, replaced=(*FILES, *others))
    return RunOutcome(result, result.summary(), tuple(files), result.all_warnings)


def save(result: GearResult, folder: str | Path, *, replaced: Sequence[str] = ()) -> list[Path]:
    """Save the result of a gear pair: summary.json, gear.nc and its tables as CSV, all files or none.

    Files of the names ``replaced``, of an earlier result there, are removed. Raises an InputError where the
    folder cannot be used. The files are complete if an UnreadableError is raised, as ``load`` would refuse
    gear.nc.
    """
    heads = ["point", *(column_head(name, about.unit) for name, about in POINT_KEYS.items())]
    phase = result.over_phase()
    columns = [column_head(name, unit) for name, unit in PHASE_COLUMNS.items()]
    layout = layout_of(
        result.solution, result.seconds, result.version, spread=result.spread, duty=result.duty
    )
    contents: dict[str, Content] = {
        SUMMARY: json_of(plain(result.summary())),
        PATH: csv_of(heads, (row.values() for row in result.points())),
        MESH: csv_of(columns, zip(*(phase[name].tolist() for name in PHASE_COLUMNS), strict=True)),
        NETCDF: content_of(layout),
    }
    if result.duty is not None:
        contents |= result.duty.contents()
    with alone_in(folder, FILES, locks=[RESULT_LOCK]) as folder:
        files = write_together(folder, contents, (*FILES, *replaced))
    check_readable(layout, folder / NETCDF, result_of)
    return files


def result_of(dataset: xr.Dataset, path: Path) -> GearResult:
    """Result of a gear pair from the dataset of a gear.nc, equal to the one that was saved. Raises an
    InputError that names the file where it is something else, or was damaged.
    """
    check_format(dataset.attrs, SCHEMA, path, "the result of a gear pair")
    with refusing(path):
        solution, seconds, version = solution_of(dataset)
        probable = number_of(dataset.attrs, "probable", "0 or 1") == 1.0
        duty, spread = duty_of(dataset), spread_of(dataset)
    return GearResult(solution, seconds, version, probable, duty, spread)
