"""Run of a contact: its solution with the files of its results."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

from ehlectric.cases.case import Case
from ehlectric.contact.check import check_case
from ehlectric.contact.files import FILES, save
from ehlectric.contact.reach import FilmProgress
from ehlectric.contact.results import PointResult, Result
from ehlectric.contact.solver import OWN, Solvers, solve
from ehlectric.runtime.files import Content
from ehlectric.runtime.folders import alone_in
from ehlectric.runtime.netcdf import load_library
from ehlectric.runtime.outcome import RunOutcome
from ehlectric.runtime.progress import Progress, silent


def run(
    case: Case,
    folder: str | Path,
    progress: Progress = silent,
    *,
    solvers: Solvers = OWN,
    others: Sequence[str] = (),
    further: Mapping[str, Content] | None = None,
) -> RunOutcome[Result | PointResult]:
    """Solve a contact, and write summary.json, result.nc and film.csv.

    Parameters
    ----------
    case : Case
        Case without ``motion``.
    folder : str or Path
        Folder of the files; it is made if it does not exist.
    progress : callable, optional
        Called with 0, 0 and a text: the number of Newton steps is not known before. The text has the grid,
        the error of the grid before, and about the time that is left.
    solvers : Solvers, optional
        Solvers of film and field; by default those of the package.
    others : sequence of str, optional
        Names of other files in the folder that belong to its result, such as figures. Those of an earlier
        result are removed when the contact is solved.
    further : mapping of str to bytes or callable, optional
        Content of further files by their names, which are written together with the others.

    Returns
    -------
    RunOutcome
        With a ``failure`` where the film is not converged; its files are written all the same.

    Raises
    ------
    InputError
        Where the case or the folder cannot be used, or another command writes into the folder.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> contact = {"reduced_radius": "14.1 mm", "reduced_modulus": "226 GPa"}
    >>> contact |= {"max_hertz_pressure": "1 GPa", "entrainment_speed": "4 m/s"}
    >>> case = Case.from_dict({"contact": contact, "lubricant": {"base": "paper"}, "grid": {"nodes": 401}})
    >>> with TemporaryDirectory() as folder:
    ...     outcome = run(case, folder)
    >>> outcome.converged, [path.name for path in outcome.files]
    (True, ['summary.json', 'result.nc', 'film.csv'])
    """
    load_library()
    prepared = check_case(case)
    case = solvers.accept(case)
    names = (*FILES, *(further or ()), *others)
    with alone_in(folder, names) as folder:
        told = FilmProgress(prepared.reach)
        result = solve(
            case,
            progress=lambda nodes, step, residual: progress(0, 0, told.text(nodes, step, residual)),
            solvers=solvers,
            prepared=prepared,
            on_grid=told.on_grid,
        )
        progress(0, 0, "writing results")
        files = save(result, folder, replaced=names, further=further)
    failure = None if result.converged else f"not converged: {result.film.status}"
    return RunOutcome(result, result.summary(), tuple(files), result.warnings, failure)
