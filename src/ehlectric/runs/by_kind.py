"""Runs of files of every kind: how each kind is recognised, read and run, and how results are loaded.

The command line and the pages of the app both start here; nothing here prints.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, TypeVar

from ehlectric.errors import InputError, shown
from ehlectric.runs.file_kinds import FileKind, InputFile, read_input
from ehlectric.runs.result_folders import files_of_results, protect
from ehlectric.runtime.folders import FIGURE_LOCK, LONG, RESULT_LOCK, alone_in
from ehlectric.runtime.progress import Progress, RunOutcome, silent
from ehlectric.runtime.undrawn import Drawn, kept_going

if TYPE_CHECKING:
    import xarray as xr

    from ehlectric.axle import AxleResult
    from ehlectric.bearing import BearingResult
    from ehlectric.calibration import Calibration
    from ehlectric.cases.axle_case import AxleCase
    from ehlectric.cases.bearing_case import BearingCase
    from ehlectric.cases.case import Case
    from ehlectric.cases.drive_case import DriveCase
    from ehlectric.cases.film_factors import FilmFactors
    from ehlectric.cases.gear_case import GearCase
    from ehlectric.contact import PointResult, PreparedContact, Result, Solvers
    from ehlectric.drive import DriveResult
    from ehlectric.gear import GearResult
    from ehlectric.runs.measured_film_factors import MeasuredFile
    from ehlectric.sweep import Sweep, SweepResults


R = TypeVar("R")


@dataclass(frozen=True)
class Kind:
    """Functions for one kind of file."""

    read: Callable[[InputFile], Any]  # case, bearing case, drive case or sweep of a file
    # ``run(case, folder, progress, **options)`` solves it and returns a ``RunOutcome``
    run: Callable[..., RunOutcome[Any]]


def run(path: str | Path, folder: str | Path, progress: Progress = silent, **options: Any) -> RunOutcome[Any]:
    """Solve a file of any kind, and write its results.

    ``folder``, folder of the results; it is made if it does not exist; ``progress``, called with the number
    of parts done, the number of all parts (0 where it is not known), and a text. Returns result, summary,
    files, warnings and, where something was not solved, a failure. Raises InputError where the file, the
    options or the folder cannot be used; ConvergenceError where the film before a motion is not converged;
    LostError where the processes or the cluster of a sweep no longer work.
    """
    file = read_input(path)
    kind = RUNS[file.kind]
    return kind.run(kind.read(file), folder, progress, **options)


def draw_outcome(
    outcome: RunOutcome[Any],
    folder: str | Path,
    progress: Progress = silent,
    *,
    formats: Sequence[str] = ("png",),
    style: str = "screen",
) -> Drawn:
    """Draw the figures of a run into its folder.

    A figure that fails does not end the run: it is among ``undrawn``.
    """
    progress(0, 0, "drawing figures")
    drawn: list[Drawn] = []
    with kept_going() as undrawn, alone_in(folder, locks=[FIGURE_LOCK], patience=LONG):
        from ehlectric.figures.result_figures import draw_figures

        for result in (outcome.result, *outcome.further_results):
            drawn.append(draw_figures(result, folder, formats=formats, style=style))
    files = tuple(file for drawing in drawn for file in drawing.files)
    warnings = tuple(warning for drawing in drawn for warning in drawing.warnings)
    return Drawn(files, warnings, tuple(undrawn))


def read_case(file: InputFile) -> Case:
    """Case of a contact, with or without motion."""
    from ehlectric.cases.case import Case

    return Case.of_file(file.table, file.path)


def read_bearing(file: InputFile) -> BearingCase:
    """Case of a bearing."""
    from ehlectric.cases.bearing_case import BearingCase

    return BearingCase.of_file(file.table, file.path)


def read_drive(file: InputFile) -> DriveCase:
    """Case of a drive."""
    from ehlectric.cases.drive_case import DriveCase

    return DriveCase.of_file(file.table, file.path)


def read_gear(file: InputFile) -> GearCase:
    """Case of a gear pair."""
    from ehlectric.cases.gear_case import GearCase

    return GearCase.of_file(file.table, file.path)


def read_axle(file: InputFile) -> AxleCase:
    """Case of an axle."""
    from ehlectric.cases.axle_case import AxleCase

    return AxleCase.of_file(file.table, file.path)


def read_sweep(file: InputFile) -> Sweep:
    """Sweep of a sweep file."""
    from ehlectric.sweep import Sweep

    return Sweep.of_file(file.table, file.path)


def run_contact(
    case: Case | PreparedContact,
    folder: str | Path,
    progress: Progress = silent,
    *,
    solver: str = "ehlectric",
    measured: MeasuredFile | None = None,
) -> RunOutcome[Result | PointResult]:
    """Solve a stationary contact by a solver of a name, "ehlectric" or "paper", and write its results.

    The case may be prepared already. With a measurement, its film factors are written together with the
    results.
    """
    from ehlectric.cases.case import Case
    from ehlectric.contact import PreparedContact, prepare, solve_to_folder

    solvers = solvers_of(solver, "--solver")
    contact = case if isinstance(case, PreparedContact) else prepare(case)
    assert isinstance(contact.case, Case)
    with alone_in(folder, locks=[RESULT_LOCK]) as folder:
        protect(folder)
        factors = None if measured is None else measured.factors(contact.case, progress)
        outcome = solve_to_folder(
            contact,
            folder,
            progress,
            solvers=solvers,
            others=files_of_results(folder),
            further=None if factors is None else factors.contents(),
        )
    return _with_factors(outcome, factors)


def run_motion(
    case: Case,
    folder: str | Path,
    progress: Progress = silent,
    *,
    solver: str = "ehlectric",
    measured: MeasuredFile | None = None,
) -> RunOutcome[xr.Dataset]:
    """Solve a transient contact, and write its results; the only solver is "ehlectric"."""
    from ehlectric.motion.run import solve_to_folder
    from ehlectric.runtime.result_names import OF_MOTION

    solvers_of(solver, "--solver")
    if measured is not None:
        raise InputError.worded("--measured", "is for stationary contacts, and this case has [motion]")
    if solver != "ehlectric":
        raise InputError("--solver", got=f"{shown(solver)} for a case with motion", takes="'ehlectric'")
    with alone_in(folder, locks=[RESULT_LOCK]) as folder:
        protect(folder, case)
        return solve_to_folder(case, folder, progress, others=files_of_results(folder, keep=OF_MOTION))


def solvers_of(given: str | Solvers, key: str = "solvers") -> Solvers:
    """Solvers by their name, "ehlectric" or "paper". Raises InputError, which names the ``key``, for another
    name.
    """
    from ehlectric.contact import DEFAULT_SOLVERS, Solvers

    if isinstance(given, Solvers):
        return given
    if given == DEFAULT_SOLVERS.name:
        return DEFAULT_SOLVERS
    from ehlectric.paper.paper_contacts import SOLVERS

    if given not in SOLVERS:
        raise InputError(key, got=shown(given), takes=f"one of {', '.join(SOLVERS)}")
    return SOLVERS[given]


def run_bearing(
    case: BearingCase,
    folder: str | Path,
    progress: Progress = silent,
    *,
    contacts: str = "",
    workers: int | None = None,
    measured: MeasuredFile | None = None,
) -> RunOutcome[BearingResult]:
    """Solve a bearing, and write its results; ``contacts``, "solved", "atlas" or "formula", replaces the key.

    With a measurement, its film factors are written together with them.
    """
    from ehlectric.bearing import solve_to_folder

    case = case.replace({"contacts": contacts}) if contacts else case
    with alone_in(folder, locks=[RESULT_LOCK]) as folder:
        protect(folder)
        factors = None if measured is None else measured.factors(case, progress, workers)
        outcome = solve_to_folder(
            case,
            folder,
            progress,
            workers=workers,
            others=files_of_results(folder),
            further=None if factors is None else factors.contents(),
        )
    return _with_factors(outcome, factors)


def run_drive(
    case: DriveCase,
    folder: str | Path,
    progress: Progress = silent,
    *,
    contacts: str = "",
    workers: int | None = None,
) -> RunOutcome[DriveResult]:
    """Solve a drive, and write its results; ``contacts`` replaces the key of both bearings."""
    from ehlectric.drive import solve_to_folder

    case = case.replace({"drive.contacts": contacts}) if contacts else case
    with alone_in(folder, locks=[RESULT_LOCK]) as folder:
        protect(folder)
        return solve_to_folder(case, folder, progress, workers=workers, others=files_of_results(folder))


def run_gear(
    case: GearCase, folder: str | Path, progress: Progress = silent, *, contacts: str = ""
) -> RunOutcome[GearResult]:
    """Solve a gear pair, and write its results; ``contacts``, "atlas" or "formula", replaces the key."""
    from ehlectric.gear import solve_to_folder

    case = case.replace({"contacts": contacts}) if contacts else case
    with alone_in(folder, locks=[RESULT_LOCK]) as folder:
        protect(folder)
        return solve_to_folder(case, folder, progress, others=files_of_results(folder))


def run_axle(
    case: AxleCase, folder: str | Path, progress: Progress = silent, *, contacts: str = ""
) -> RunOutcome[AxleResult]:
    """Solve an axle, and write its results; ``contacts`` replaces the key of all bearings and meshes."""
    from ehlectric.axle import solve_to_folder

    case = case.replace({"drive.contacts": contacts}) if contacts else case
    with alone_in(folder, locks=[RESULT_LOCK]) as folder:
        protect(folder)
        return solve_to_folder(case, folder, progress, others=files_of_results(folder))


# Kinds of files that a measurement can correct.
CALIBRATED_KINDS: tuple[FileKind, ...] = ("bearing", "drive", "gear", "axle")


def run_calibration(
    case: BearingCase | DriveCase | GearCase | AxleCase,
    folder: str | Path,
    progress: Progress = silent,
    *,
    measured: Path | None = None,
    background: str | None = None,
    uncertainty: str | None = None,
    file: Path | None = None,
) -> RunOutcome[Calibration]:
    """Update the uncertain inputs of a case by measured values, and write the results; ``file``, file of the
    case, whose units and comments the calibrated file keeps.
    """
    from ehlectric.calibration import calibrate_to_folder

    with alone_in(folder, locks=[RESULT_LOCK]) as folder:
        protect(folder)
        return calibrate_to_folder(
            case,
            folder,
            progress,
            measured=measured,
            background=background,
            uncertainty=uncertainty,
            file=file,
            others=files_of_results(folder),
        )


def _with_factors(outcome: RunOutcome[R], factors: FilmFactors | None) -> RunOutcome[R]:
    """Outcome of a run, with the film factors of a measurement next to its result if there are any."""
    if factors is None:
        return outcome
    return replace(
        outcome,
        summary={**outcome.summary, "measured": factors.summary()},
        warnings=(*outcome.warnings, *factors.warnings),
        further_results=(factors,),
    )


def run_sweep(
    sweep: Sweep,
    folder: str | Path,
    progress: Progress = silent,
    *,
    workers: int | None = None,
    scheduler: str | None = None,
) -> RunOutcome[SweepResults]:
    """Solve a sweep in processes of this machine, or on the Dask cluster of a scheduler's address."""
    from ehlectric.sweep import crew, solve_to_folder

    solvers = crew(None, workers)
    if scheduler is not None:
        from ehlectric.sweep import cluster

        solvers = cluster(scheduler)
    with alone_in(folder, locks=[RESULT_LOCK]) as folder:
        protect(folder, sweep=True)
        return solve_to_folder(sweep, folder, progress, solvers=solvers, others=files_of_results(folder))


RUNS: Mapping[FileKind, Kind] = MappingProxyType(
    {
        "contact": Kind(read_case, run_contact),
        "motion": Kind(read_case, run_motion),
        "bearing": Kind(read_bearing, run_bearing),
        "drive": Kind(read_drive, run_drive),
        "gear": Kind(read_gear, run_gear),
        "axle": Kind(read_axle, run_axle),
        "sweep": Kind(read_sweep, run_sweep),
    }
)
