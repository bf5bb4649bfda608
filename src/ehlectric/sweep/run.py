"""Runs of sweeps: many cases solved in parallel, each saved as it finishes."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from concurrent.futures import Executor
from contextlib import AbstractContextManager, ExitStack, nullcontext
from itertools import chain
from pathlib import Path
from typing import Any

from ehlectric.contact import case_with_laws
from ehlectric.errors import InputError, shown
from ehlectric.lubricant.python_laws import Laws
from ehlectric.runtime.files import clear
from ehlectric.runtime.folders import FIGURE_LOCK, LONG, RESULT_LOCK, alone_in
from ehlectric.runtime.netcdf import load_library
from ehlectric.runtime.progress import Progress, RunOutcome, progress_or_silent, silent
from ehlectric.runtime.worker_processes import Crew, cores, crew_of, processes, this_process
from ehlectric.sweep.batches import batches_of, run_batches, weight_of
from ehlectric.sweep.engine import Outcome, Planned, Task, run_points, task_of
from ehlectric.sweep.point_groups import Inputs, plan_together
from ehlectric.sweep.result import FILES, SweepResults, write_tables
from ehlectric.sweep.store import NAME, Store, read_sweep
from ehlectric.sweep.sweep_inputs import Sweep, check_user_laws
from ehlectric.sweep.verdict_rule import sweep_verdict
from ehlectric.sweep.warnings import sweep_warnings

# Weight of batches below which they are solved in this process, in the time that others take to begin.
_HERE = 5000


def run_sweep(
    sweep: Sweep | Mapping[str, Any] | str | Path,
    folder: str | Path,
    executor: Executor | None = None,
    progress: Progress | None = None,
    *,
    workers: int | None = None,
    laws: Laws | None = None,
) -> SweepResults:
    """Solve a sweep, except the points that its folder already has, and write its tables.

    Parameters
    ----------
    sweep : Sweep, mapping, str or Path
        Sweep to solve, its nested tables, or the path of its TOML file.
    folder : str or Path
        Folder of sweep.sqlite and of the tables; it is made if it does not exist.
    executor : Executor, optional
        Executor of concurrent.futures that solves the points; it is not shut down here. By default, processes
        of this machine solve them.
    progress : callable, optional
        Called with the number of solved points, the number of all points, and a message.
    workers : int, optional
        Number of processes of this machine; by default as many as there are cores.
    laws : Laws, optional
        Laws of your own for the oil of a contact, at every point. The processes get their values, so that
        functions of a script work.

    Returns
    -------
    SweepResults
        Results of all points.

    Raises
    ------
    InputError
        Where the sweep or no point of it is valid, or the folder cannot be used.
    LostError
        Where the executor no longer works. The points solved so far are saved, and the same call solves the
        others.

    Notes
    -----
    Each point is saved as it finishes. A point that the folder has is not solved again, unless its process
    was killed or ran out of memory.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> import ehlectric
    >>> case = ehlectric.BearingCase.from_toml(ehlectric.example("bearing_6208.toml"))
    >>> vary = {"bearing.inner_speed": ["1000 rpm", "3000 rpm"]}
    >>> sweep = ehlectric.Sweep.from_dict({"case": case.replace(contacts="atlas"), "vary": vary})
    >>> with TemporaryDirectory() as folder:
    ...     results = ehlectric.run_sweep(sweep, folder, workers=1)
    >>> [point.status for point in results.points]
    ['solved', 'solved']
    """
    given, report = _with_laws(_sweep_of(sweep), laws), progress_or_silent(progress)
    return solve_to_folder(given, folder, report, solvers=crew(executor, workers)).result


def _sweep_of(given: object) -> Sweep:
    """Sweep that is given as itself, as its nested tables, or by the path of its file."""
    if isinstance(given, Sweep):
        return given
    if isinstance(given, Mapping):
        return Sweep.from_dict(given)
    if isinstance(given, str | Path):
        return Sweep.from_toml(given)
    takes = "a Sweep, a dict, or the path of a TOML file"
    raise InputError("sweep", got=shown(type(given).__name__), takes=takes)


def _with_laws(sweep: Sweep, laws: Laws | None) -> Sweep:
    """Sweep whose base case has laws of the user's own; unchanged for None."""
    if laws is None:
        return sweep
    changed = sweep.model_copy(update={"case": case_with_laws(sweep.case, laws)})
    check_user_laws(changed)
    return changed


def crew(executor: Executor | None, workers: int | None) -> AbstractContextManager[Crew]:
    """Context with the crew that solves points: an executor, or by default processes of this machine."""
    return processes(workers or cores()) if executor is None else nullcontext(crew_of(executor))


def solve_to_folder(
    sweep: Sweep,
    folder: str | Path,
    progress: Progress = silent,
    *,
    solvers: AbstractContextManager[Crew] | None = None,
    others: Sequence[str] = (),
) -> RunOutcome[SweepResults]:
    """Solve a sweep, except the points that its folder already has, and write its tables.

    ``folder``, folder of sweep.sqlite and of the tables; it is made if it does not exist. Returns its summary
    is the number of points of each status, and the verdict as text where points have a margin; it has a
    ``failure`` where no point is solved. Raises InputError where no point is a valid case, the folder cannot
    be used, or another command writes into it; LostError where the crew no longer works.
    """
    load_library()
    planned = planned_points(sweep)
    with alone_in(folder, (NAME, *FILES, *others), locks=[RESULT_LOCK]) as folder, ExitStack() as crews:
        working = crews.enter_context(crew(None, None) if solvers is None else solvers)
        with Store(folder) as store:
            store.begin(sweep, planned)
            with alone_in(folder, locks=[FIGURE_LOCK]):
                clear(folder, (*FILES, *others))
            _solve(sweep, store, planned, working, progress)
            # The crew leaves before the tables are written: a cluster can be used for something else.
            crews.close()
            results = read_sweep(folder)
            with alone_in(folder, locks=[FIGURE_LOCK], patience=LONG):
                write_tables(results, folder)
    files = tuple(folder / name for name in FILES if (folder / name).exists())
    summary: dict[str, Any] = dict(Counter(str(point.status) for point in results.points))
    failure = None if "solved" in summary else f"none of {len(results.points)} points was solved"
    verdict = sweep_verdict(results)
    if verdict is not None:
        summary |= verdict.as_data()
    return RunOutcome(results, summary, files, tuple(sweep_warnings(results)), failure)


def planned_points(sweep: Sweep) -> list[Planned]:
    """Points of a sweep with the keys of their cases. Raises InputError where no point is a valid case."""
    planned = list(plan_together(sweep))
    if all(point.key is None for point in planned):
        raise InputError("vary", f"no point is a case; of the first, {planned[0].refused}")
    return planned


def _solve(sweep: Sweep, store: Store, planned: Sequence[Planned], solvers: Crew, progress: Progress) -> None:
    """Solve the open points, save each, and call the progress."""
    tables = {point.key: point.table for point in planned if point.table is not None}
    points, counts = Counter(point.key for point in planned), Counter(store.counts())

    def done(outcomes: Sequence[tuple[str, Outcome]]) -> None:
        if outcomes:
            store.write(outcomes)
        for key, outcome in outcomes:
            counts[outcome.status] += points[key]
            counts["open"] -= points[key]
        texts = [f"{counts[status]} {status}" for status in ("not converged", "failed") if counts[status]]
        texts += filter(None, [solvers.waiting()])
        progress(len(planned) - counts["open"], len(planned), ", ".join(texts))

    def tasks(some: Iterable[tuple[str, Inputs]]) -> Iterator[Task]:
        for key, inputs in some:
            yield key, tables.get(key) or task_of(sweep.case.replace(inputs))

    done(())
    batches, others = batches_of(sweep, store.open_points())
    here = solvers.shares_memory and weight_of(batches) < _HERE
    left = run_batches(batches, this_process() if here else solvers, done)
    alone = chain.from_iterable(batch.tasks() for batch in left)
    run_points(chain(alone, tasks(others)), solvers, done, sweep.uncertainty_samples)
