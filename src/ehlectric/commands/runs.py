"""Runs of files of every kind: how each kind is recognised, read and run, and how results are loaded.

A command line and a page both start here; nothing here prints. The module lies in ``commands`` because it
needs everything below: bearings, sweeps, the names of figures and the solvers of the paper.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, Literal

from ehlectric.cases.table import read_toml
from ehlectric.errors import InputError, ResultWarning, shown
from ehlectric.figures.names import ALL_FIGURES, BEARING_FIGURE_FILES, MOTION_FIGURE_FILES, SPEED_FIGURE_FILES
from ehlectric.runtime.outcome import RunOutcome
from ehlectric.runtime.progress import Progress, silent

if TYPE_CHECKING:
    import xarray as xr

    from ehlectric.bearing.result import BearingResult
    from ehlectric.cases.bearing_case import BearingCase
    from ehlectric.cases.case import Case
    from ehlectric.cases.row import Row
    from ehlectric.contact.results import PointResult, Result
    from ehlectric.sweep.inputs import Sweep
    from ehlectric.sweep.results import SweepResults

FileKind = Literal["contact", "motion", "bearing", "sweep"]

# Tables and keys that only sweep files have.
_OF_SWEEPS = ("case", "vary", "design")


@dataclass(frozen=True)
class Kind:
    """Functions for one kind of file.

    Attributes
    ----------
    read : callable
        Case, bearing case or sweep of a TOML file.
    run : callable
        ``run(case, folder, progress, **options)`` solves it and returns a ``RunOutcome``. Every run prepares
        the folder, removes the files of an earlier result, and writes its own; it draws no figures.
    """

    read: Callable[[str | Path], Any]
    run: Callable[..., RunOutcome[Any]]


def kind_of_file(path: str | Path) -> FileKind:
    """Kind of a TOML file: "contact", "motion", "bearing" or "sweep", recognised by its tables.

    Parameters
    ----------
    path : str or Path
        A case file, bearing file or sweep file.

    Raises
    ------
    InputError
        Where the file cannot be read or is not TOML.
    """
    table = read_toml(path)
    if any(key in table for key in _OF_SWEEPS):
        return "sweep"
    if "bearing" in table:
        return "bearing"
    return "motion" if "motion" in table else "contact"


def run(path: str | Path, folder: str | Path, progress: Progress = silent, **options: Any) -> RunOutcome[Any]:
    """Solve a file of any kind, and write its results.

    Parameters
    ----------
    path : str or Path
        A case file, bearing file or sweep file, TOML.
    folder : str or Path
        Folder of the results; it is made if it does not exist.
    progress : callable, optional
        Called with the number of parts done, the number of all parts (0 where it is not known), and a text.
    **options
        Options of the kind of file: ``solver`` of a contact; ``contacts`` and ``workers`` of a bearing;
        ``workers`` and ``scheduler`` of a sweep.

    Returns
    -------
    RunOutcome
        Result, summary, files, warnings and, where something was not solved, a failure.

    Raises
    ------
    InputError
        Where the file, the options or the folder cannot be used.
    ConvergenceError
        Where the film before a motion is not converged.
    LostError
        Where the processes or the cluster of a sweep no longer work.
    """
    kind = RUNS[kind_of_file(path)]
    return kind.run(kind.read(path), folder, progress, **options)


def run_and_draw(
    kind: FileKind,
    case: Any,
    folder: str | Path,
    progress: Progress = silent,
    *,
    draw: bool = True,
    **options: Any,
) -> RunOutcome[Any]:
    """Solve a case of a kind, write its results, and draw its figures.

    Parameters
    ----------
    kind : str
        "contact", "motion", "bearing" or "sweep". The figures of a sweep are not drawn here.
    case : Case, BearingCase or Sweep
        Case of this kind.
    folder : str or Path
        Folder of the results; it is made if it does not exist.
    progress : callable, optional
        Called with the number of parts done, the number of all parts (0 where it is not known), and a text.
    draw : bool
        Whether figures are drawn.
    **options
        Options of the kind, as of ``run``.

    Returns
    -------
    RunOutcome
        With the figures among the files, and their warnings among the warnings.

    Raises
    ------
    InputError, ConvergenceError, LostError
        As ``run`` raises them.
    """
    outcome = RUNS[kind].run(case, folder, progress, **options)
    if not draw:
        return outcome
    from ehlectric.figures.results import draw_figures

    progress(0, 0, "drawing figures")
    drawn = draw_figures(outcome.result, folder)
    files, warnings = (*outcome.files, *drawn.files), (*outcome.warnings, *drawn.warnings)
    return replace(outcome, files=files, warnings=warnings)


def read_case(path: str | Path) -> Case:
    """Case of a contact, with or without motion."""
    from ehlectric.cases.case import Case

    return Case.from_toml(path)


def read_bearing(path: str | Path) -> BearingCase:
    """Case of a bearing."""
    from ehlectric.cases.bearing_case import BearingCase

    return BearingCase.from_toml(path)


def read_sweep_file(path: str | Path) -> Sweep:
    """Sweep of a sweep file."""
    from ehlectric.sweep.inputs import Sweep

    return Sweep.from_toml(path)


def run_contact(
    case: Case, folder: str | Path, progress: Progress = silent, *, solver: str = "ehlectric"
) -> RunOutcome[Result | PointResult]:
    """Solve a stationary contact by a solver of a name, "ehlectric" or "paper", and write its results."""
    from ehlectric.contact.run import run
    from ehlectric.motion.stored_run import MOTION
    from ehlectric.paper.solvers import SOLVERS

    _check_solver(solver, tuple(SOLVERS))
    others = (*ALL_FIGURES, MOTION, *MOTION_FIGURE_FILES)
    return run(case, folder, progress, solvers=SOLVERS[solver], others=others)


def run_motion(
    case: Case, folder: str | Path, progress: Progress = silent, *, solver: str = "ehlectric"
) -> RunOutcome[xr.Dataset]:
    """Solve a transient contact, and write its results; the only solver is "ehlectric"."""
    from ehlectric.motion.run import run
    from ehlectric.paper.solvers import SOLVERS

    _check_solver(solver, tuple(SOLVERS))
    if solver != "ehlectric":
        raise InputError("--solver", got=f"{shown(solver)} for a case with motion", takes="'ehlectric'")
    return run(case, folder, progress, others=(*ALL_FIGURES, *MOTION_FIGURE_FILES))


def _check_solver(solver: str, known: tuple[str, ...]) -> None:
    if solver not in known:
        raise InputError("--solver", got=shown(solver), takes=f"one of {', '.join(known)}")


def run_bearing(
    case: BearingCase,
    folder: str | Path,
    progress: Progress = silent,
    *,
    contacts: str = "",
    workers: int | None = None,
) -> RunOutcome[BearingResult]:
    """Solve a bearing, and write its results; ``contacts``, "solved" or "formula", replaces the key."""
    from ehlectric.bearing.files import run

    case = case.replace({"contacts": contacts}) if contacts else case
    return run(case, folder, progress, workers=workers, others=(*BEARING_FIGURE_FILES, *SPEED_FIGURE_FILES))


def run_sweep(
    sweep: Sweep,
    folder: str | Path,
    progress: Progress = silent,
    *,
    workers: int | None = None,
    scheduler: str | None = None,
) -> RunOutcome[SweepResults]:
    """Solve a sweep in processes of this machine, or on the Dask cluster of a scheduler's address."""
    from ehlectric.sweep.run import crew, run

    if scheduler is None:
        return run(sweep, folder, progress, solvers=crew(None, workers))
    from ehlectric.sweep.cluster import cluster

    return run(sweep, folder, progress, solvers=cluster(scheduler))


RUNS: Mapping[FileKind, Kind] = MappingProxyType(
    {
        "contact": Kind(read_case, run_contact),
        "motion": Kind(read_case, run_motion),
        "bearing": Kind(read_bearing, run_bearing),
        "sweep": Kind(read_sweep_file, run_sweep),
    }
)


@dataclass(frozen=True)
class Meaning:
    """Meaning of a case before it is solved.

    Attributes
    ----------
    title : str
        Title of the case.
    rows : tuple of Row
        Dry contact, groups, regime, film formulas and, of a case with motion, its schedule.
    summary : dict
        The same numbers as nested tables, SI units.
    warnings : tuple of ResultWarning
        Warnings about the case and its surfaces.
    """

    title: str
    rows: tuple[Row, ...]
    summary: dict[str, Any]
    warnings: tuple[ResultWarning, ...]


def check(case: Case) -> Meaning:
    """Hertz contact, groups, regime and film formulas of a case.

    Parameters
    ----------
    case : Case
        Case of a contact, with or without motion.

    Returns
    -------
    Meaning
        Rows of a table, the same numbers as nested tables, and warnings.

    Raises
    ------
    InputError
        Where the values contradict each other, a surface cannot be used or the grid fits into no memory.

    Examples
    --------
    >>> from ehlectric import Case
    >>> contact = {"geometry": "point", "radius_x": 0.01, "radius_y": 0.01, "load": "20 N"}
    >>> contact |= {"reduced_modulus": "226 GPa", "entrainment_speed": 2.0}
    >>> meaning = check(Case.from_dict({"contact": contact, "lubricant": {"base": "paper"}}))
    >>> round(meaning.summary["hertz"]["max_pressure"] / 1e9, 3)
    0.791
    """
    from ehlectric.commands.tables.contact import case_rows
    from ehlectric.commands.tables.motion import schedule_rows
    from ehlectric.contact.check import check_case
    from ehlectric.contact.summary import case_summary
    from ehlectric.motion.contact import TransientContact

    contact = check_case(case)
    rows, summary = case_rows(case, contact.conditions), case_summary(case, contact.conditions)
    if case.motion is not None:
        schedule = TransientContact.of(case, contact.rough).schedule
        summary["motion"] = schedule.described()
        rows += schedule_rows(schedule, contact.conditions.entrainment_speed)
    return Meaning(case.title, tuple(rows), summary, tuple(contact.warnings()))


def load_and_draw(path: str | Path, folder: str | Path) -> tuple[tuple[Path, ...], tuple[ResultWarning, ...]]:
    """Draw the figures of a stored result again.

    Parameters
    ----------
    path : str or Path
        A result.nc, bearing.nc or motion.nc.
    folder : str or Path
        Folder of the figures; it is made if it does not exist.

    Returns
    -------
    files : tuple of Path
        Files written.
    warnings : tuple of ResultWarning
        Warnings of the result and of its figures.

    Raises
    ------
    InputError
        Where the file is not a result, or the folder cannot be used.
    """
    from ehlectric.bearing.result import BearingResult
    from ehlectric.commands.results import load
    from ehlectric.motion.stored_run import MOTION, read_motion
    from ehlectric.runtime.stored_warnings import of_attributes

    if Path(path).name == MOTION:
        dataset = read_motion(path)
        return _draw(dataset, folder, MOTION_FIGURE_FILES, of_attributes(dataset.attrs))
    result = load(path)
    if isinstance(result, BearingResult):
        names = (*BEARING_FIGURE_FILES, *SPEED_FIGURE_FILES)
        return _draw(result, folder, names, tuple(result.warnings()))
    return _draw(result, folder, ALL_FIGURES, result.warnings)


def _draw(
    result: Any, folder: str | Path, names: tuple[str, ...], warnings: tuple[ResultWarning, ...]
) -> tuple[tuple[Path, ...], tuple[ResultWarning, ...]]:
    """Draw figures of these names; files, and the warnings with those of the figures."""
    from ehlectric.runtime.files import prepare

    folder = prepare(folder, names)
    from ehlectric.figures.results import draw_figures

    drawn = draw_figures(result, folder)
    return drawn.files, (*warnings, *drawn.warnings)
