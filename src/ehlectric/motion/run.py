"""Run of a contact with moving roughness into its file, from the start or resumed where it was stopped."""

from __future__ import annotations

import json
import time
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ehlectric.cases.case import Case
from ehlectric.contact import PointResult, PreparedContact, Result, prepare, solve
from ehlectric.errors import ConvergenceError, InputError
from ehlectric.film import History
from ehlectric.motion.coarse_run import CoarseRun
from ehlectric.motion.moving_contact import TransientContact
from ehlectric.motion.solver import TransientSolver
from ehlectric.motion.storage import (
    MotionJournal,
    Record,
    described,
    is_hot,
    is_run_of,
    stored_attributes,
    time_step,
)
from ehlectric.motion.stored import SCHEMA, Maps, TimeStep
from ehlectric.motion.stored_run import read_motion, refuse_other_case
from ehlectric.motion.summary import summary_of
from ehlectric.motion.warnings import motion_warnings
from ehlectric.quantities.result_warnings import warnings_of
from ehlectric.runtime.files import clear, now, plain, write_json
from ehlectric.runtime.folders import FIGURE_LOCK, RESULT_LOCK, alone_in
from ehlectric.runtime.journal import remove
from ehlectric.runtime.progress import Progress, RunOutcome, silent
from ehlectric.runtime.result_names import MOTION, MOTION_CHANGES, MOTION_JOURNAL, SUMMARY
from ehlectric.runtime.result_names import OF_CONTACTS as FILES
from ehlectric.runtime.stored import warnings_as_attributes
from ehlectric.version import __version__

if TYPE_CHECKING:
    import xarray as xr


def solve_to_folder(
    case: Case, folder: str | Path, progress: Progress = silent, *, others: Sequence[str] = ()
) -> RunOutcome[xr.Dataset]:
    """Solve a contact with moving roughness, and write motion.nc and summary.json.

    The folder is made if it does not exist, and the result is the dataset of ``read_motion``. Raises an
    InputError where the case or the folder cannot be used, or another command writes into the folder, and a
    ConvergenceError where the film before the motion did not converge.
    """
    prepared = prepare(case)
    contact = TransientContact.of(case, prepared.rough)
    failure = None
    with alone_in(folder, (MOTION, *FILES, *others), locks=[RESULT_LOCK]) as folder:
        refuse_other_case(folder, case)
        # A run that was stopped between its last step and its summary has no summary.json.
        again = (folder / SUMMARY).is_file()
        with alone_in(folder, locks=[FIGURE_LOCK]):
            clear(folder, (*FILES, *others))
        try:
            _solve(contact, prepared, folder, again=again, progress=progress)
        except ConvergenceError as error:
            if not (folder / MOTION).is_file():
                raise
            failure = f"not converged: {error}"
        dataset = read_motion(folder)
        summary = summary_of(dataset)
        write_json(folder / SUMMARY, summary)
    return RunOutcome(dataset, summary, (folder / SUMMARY, folder / MOTION), warnings_of(summary), failure)


def run_motion(case: Case, folder: str | Path, *, again: bool = True, progress: Progress = silent) -> Path:
    """Solve a contact with moving roughness, and write motion.nc.

    Each recorded instant is saved in motion.sqlite. When the run ends or is stopped, motion.nc is written;
    motion.sqlite remains until the run is complete.

    Parameters
    ----------
    case : Case
        A case with ``motion``.
    folder : str or Path
        Folder of the files; made if it is not there. An unfinished run of the same case there is resumed from
        the last recorded instant. A complete run of the same case, or one of another version, is replaced.
    again : bool
        True to solve a complete run of the same case again.
    progress : callable, optional
        Called with the number of solved steps, the number of all steps, and a message.

    Returns
    -------
    Path
        The file, which ``read_motion`` reads.

    Raises
    ------
    InputError
        If the case or the folder cannot be used, another command writes into the folder, or it contains
        recorded steps of another case, or a stopped run without motion.sqlite.
    ConvergenceError
        If a time step does not converge; motion.nc contains the recorded instants before this step.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> import ehlectric
    >>> case = ehlectric.Case.from_toml(ehlectric.example("moving_roughness.toml"))
    >>> case = case.replace({"grid.nodes": 401, "motion.passes": 0.05, "motion.steps": 4, "motion.record": 4})
    >>> with TemporaryDirectory() as folder:
    ...     file = ehlectric.run_motion(case, folder)
    >>> file.name
    'motion.nc'
    """
    prepared = prepare(case)
    contact = TransientContact.of(case, prepared.rough)
    with alone_in(folder, (MOTION,), locks=[RESULT_LOCK]) as folder:
        refuse_other_case(folder, case)
        _solve(contact, prepared, folder, again=again, progress=progress)
    return folder / MOTION


def _solve(
    contact: TransientContact, prepared: PreparedContact, folder: Path, *, again: bool, progress: Progress
) -> None:
    """Solve the time steps that are not saved yet, and write motion.nc when the run ends or stops."""
    path, journal_path = folder / MOTION, folder / MOTION_JOURNAL
    stored = stored_attributes(path)
    if stored is not None and stored["complete"]:
        remove(journal_path)  # a kill came after motion.nc was written
        if not again and is_run_of(contact, stored):
            return
    with MotionJournal(folder, contact) as journal:
        if stored is not None and not stored["complete"] and journal.empty and not is_hot(contact):
            raise InputError(
                path,
                f"contains a stopped run without {MOTION_JOURNAL}, which cannot be resumed",
                takes="another folder, as with -o; or remove it to solve the case from its start",
            )
        resumed = journal.resumed()
        clear(folder, (MOTION, MOTION_CHANGES))
        complete = _steps(journal, resumed, contact, prepared, progress)
    if complete:
        remove(journal_path)


def _steps(
    journal: MotionJournal,
    resumed: tuple[int, History, History | None] | None,
    contact: TransientContact,
    prepared: PreparedContact,
    progress: Progress,
) -> bool:
    """Solve the time steps that a journal lacks; whether the run is complete."""
    solver, coarse_run = TransientSolver(contact), CoarseRun(contact)
    if resumed is None:
        progress(0, contact.schedule.steps, "film before the motion")
        resumed = 0, *_begin(journal, solver, coarse_run, prepared)
    done, history, coarse = resumed
    coarse = coarse_run.resumed(coarse, done)
    try:
        progress(done, contact.schedule.steps, "time steps")
        started, rows = time.perf_counter(), list[TimeStep]()
        recorded = set(contact.schedule.recorded.tolist())
        for step, latest in solver.run(history, done):
            coarse = coarse_run.after(step, coarse)
            rows.append(time_step(solver, latest, coarse_run.films(step, coarse)))
            if step in recorded:
                snapshot = solver.snapshot(latest.now)
                since, started = started, time.perf_counter()
                journal.append(Record(step, rows, snapshot, latest, coarse, started - since))
                rows = []
                progress(step, contact.schedule.steps, "time steps")
    finally:
        complete = journal.write()
    return complete


def _begin(
    journal: MotionJournal, solver: TransientSolver, coarse_run: CoarseRun, prepared: PreparedContact
) -> tuple[History, History | None]:
    """Write the film before the motion as the first instant, with the film of stationary roughness.

    Returns the films before the motion of the run and of its coarse run, None where that did not converge.
    """
    contact, started = solver.contact, time.perf_counter()
    at_rest = contact.case.replace(motion=None)
    still = solve(replace(prepared, case=at_rest), beside_smooth=False)
    history, coarse = solver.start(), coarse_run.start()
    first = solver.snapshot(history.now)
    maps, numbers = _stationary(contact, still)
    attributes = {
        "title": contact.case.title,
        "schema": SCHEMA,
        "case": contact.case.to_toml(),
        "version": __version__,
        "date": now(),
        "stationary": json.dumps(plain(numbers)),
        "rough": described(contact),
    }
    attributes |= warnings_as_attributes(motion_warnings(contact, still))
    rows = [time_step(solver, history, coarse_run.films(0, coarse))]
    record = Record(0, rows, first, history, coarse, time.perf_counter() - started)
    journal.begin(record, attributes | contact.schedule.moments(), maps)
    return history, coarse


def _stationary(
    contact: TransientContact, still: Result | PointResult
) -> tuple[Maps | None, dict[str, Any] | None]:
    """Film and field of stationary roughness over its nodes, and their numbers as in summary.json.

    Both are None where the film is not converged.
    """
    if not still.converged:
        return None, None
    film, field = still.film, still.field
    return Maps(film.pressure, film.thickness, contact.kind.column_strength(film, field)), {
        "minimum_thickness": film.minimum_thickness,
        "minimum_position": film.minimum_position,
        "max_pressure": film.max_pressure,
        "max_strength": field.max_strength,
        "capacitance": field.capacitance,
        "discretisation_error": still.film_error,
    }
