"""run_sweep: many cases solved in parallel, each saved as it finishes."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Executor
from contextlib import AbstractContextManager, ExitStack, nullcontext
from pathlib import Path
from typing import Any

from ehlectric.errors import InputError, LostError
from ehlectric.runtime.files import clear, prepare
from ehlectric.runtime.workers import cores
from ehlectric.sweep.engine import Crew, Task, crew_of, processes, run_points
from ehlectric.sweep.inputs import Sweep
from ehlectric.sweep.results import SweepResults
from ehlectric.sweep.store import LOCK, NAME, Outcome, Planned, Store, plan, read_sweep
from ehlectric.sweep.tables import FILES, write_tables

# Called with (points done, points in all, what is to be said).
Progress = Callable[[int, int, str], None]


def run_sweep(
    sweep: Sweep,
    folder: str | Path,
    executor: Executor | None = None,
    progress: Progress | None = None,
    *,
    workers: int | None = None,
) -> SweepResults:
    """Solve the points of a sweep that its folder does not have yet, and write its tables.

    Parameters
    ----------
    sweep : Sweep
        What to solve.
    folder : str or Path
        Where sweep.sqlite is kept, and the tables are written.
    executor : Executor, optional
        Who solves, of the kind of concurrent.futures; not ended here. Processes of this machine otherwise.
    progress : callable, optional
        Called with (points done, points in all, a text) as they finish.
    workers : int, optional
        Processes of this machine; as many as there are cores if not given.

    Returns
    -------
    SweepResults
        All of its points.

    Raises
    ------
    InputError
        Where no point is a case, or the folder cannot be used.
    LostError
        Where the executor is gone; what is solved is saved, and the same call goes on. Also where a script
        calls this without ``if __name__ == "__main__":``, as processes import it again.

    Notes
    -----
    Each point is committed as it finishes. Points that the folder has are not solved again, but those whose
    process was killed or whose memory did not do.
    """
    try:
        return run_with(sweep, folder, crew(executor, workers), progress)
    except LostError as error:
        if executor is not None:
            raise
        raise LostError(f'{error}; a script takes this call below if __name__ == "__main__":') from None


def crew(executor: Executor | None, workers: int | None) -> AbstractContextManager[Crew]:
    """Who solves: the executor, or processes of this machine."""
    return processes(workers or cores()) if executor is None else nullcontext(crew_of(executor))


def run_with(
    sweep: Sweep,
    folder: str | Path,
    solvers: AbstractContextManager[Crew],
    progress: Progress | None = None,
) -> SweepResults:
    """``run_sweep`` with a crew that comes when the sweep is known to be one, before its folder is made."""
    planned = planned_points(sweep)
    with ExitStack() as crews:
        those = crews.enter_context(solvers)
        folder = prepare(folder, (NAME, LOCK, *FILES))
        with Store(folder) as store:
            store.begin(sweep, planned)
            clear(folder, FILES)
            _solve(sweep, store, planned, those, progress or (lambda _done, _of, _text: None))
            # They leave while the tables are written, which nobody else can do meanwhile.
            crews.close()
            results = read_sweep(folder)
            write_tables(results, folder)
    return results


def planned_points(sweep: Sweep) -> list[Planned]:
    """The points of a sweep with the keys of their cases.

    Raises
    ------
    InputError
        Where none of them is a case.
    """
    planned = list(plan(sweep))
    if all(point.key is None for point in planned):
        raise InputError("vary", f"no point is a case; of the first, {planned[0].refused}")
    return planned


def _solve(sweep: Sweep, store: Store, planned: Sequence[Planned], solvers: Crew, progress: Progress) -> None:
    points, counts = Counter(point.key for point in planned), Counter(store.counts())

    def done(found: Sequence[tuple[str, Outcome]]) -> None:
        if found:
            store.write(found)
        for key, outcome in found:
            counts[outcome.status] += points[key]
            counts["open"] -= points[key]
        told = [f"{counts[status]} {status}" for status in ("not converged", "failed") if counts[status]]
        waiting = solvers.waiting()
        progress(len(planned) - counts["open"], len(planned), ", ".join([*told, *filter(None, [waiting])]))

    def tasks() -> Iterator[Task]:
        for key, inputs in store.open_points():
            yield key, _plain(sweep, inputs)

    done(())
    run_points(tasks(), solvers, done)


def _plain(sweep: Sweep, inputs: dict[str, Any]) -> dict[str, Any]:
    return sweep.case.replace(inputs).to_dict()
