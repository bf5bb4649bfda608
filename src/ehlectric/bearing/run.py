"""Run of a bearing: its solution with the files of its results."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from ehlectric.bearing.files import FILES, save
from ehlectric.bearing.result import BearingResult
from ehlectric.bearing.solver import check_bearing, solve_bearing
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.runtime.files import clear, prepare
from ehlectric.runtime.outcome import RunOutcome
from ehlectric.runtime.progress import Progress, silent


def run(
    case: BearingCase,
    folder: str | Path,
    progress: Progress = silent,
    *,
    workers: int | None = None,
    others: Sequence[str] = (),
) -> RunOutcome[BearingResult]:
    """Solve a whole bearing, and write summary.json, contacts.csv, impedance.csv and bearing.nc.

    Parameters
    ----------
    case : BearingCase
        Bearing to solve.
    folder : str or Path
        Folder of the files; it is made if it does not exist.
    progress : callable, optional
        Called with the number of contacts done, the number of all contacts, and what is being done.
    workers : int, optional
        Number of processes; by default as many as there are cores.
    others : sequence of str, optional
        Names of other files in the folder that belong to its result, such as figures. Those of an earlier
        result are removed when the bearing is solved.

    Returns
    -------
    RunOutcome
        With a ``failure`` where a contact is not converged; its files are written all the same.

    Raises
    ------
    InputError
        Where the bearing cannot be solved, or the folder cannot be used.

    Examples
    --------
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
    ...     outcome = run(case, folder)
    >>> outcome.converged, [path.name for path in outcome.files]
    (True, ['summary.json', 'contacts.csv', 'bearing.nc'])
    """
    check_bearing(case)
    names = (*FILES, *others)
    folder = prepare(folder, names)
    result = solve_bearing(case, progress=progress, workers=workers)
    clear(folder, names)
    files = save(result, folder)
    failure = None if result.converged else "not converged: a contact of the bearing"
    return RunOutcome(result, result.summary(), tuple(files), tuple(result.warnings()), failure)
