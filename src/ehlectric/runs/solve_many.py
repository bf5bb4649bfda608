"""Solution of many cases in parallel, in memory: ``solve_many``."""

from __future__ import annotations

from collections.abc import Generator, Iterable, Iterator, Mapping, Sized
from contextlib import ExitStack, closing
from functools import partial
from os import PathLike
from typing import Any, Generic, NamedTuple, TypeVar, overload

from ehlectric.bearing.result import BearingResult
from ehlectric.bearing.solver import solve_bearing
from ehlectric.cases.bearings.case import BearingCase
from ehlectric.cases.case import Case, LineCase, PointCase
from ehlectric.cases.drives.case import DriveCase
from ehlectric.contact.results import PointResult, Result
from ehlectric.contact.solver import solve
from ehlectric.drive.result import DriveResult, solve_drive
from ehlectric.errors import InputError, LostError, shown
from ehlectric.runs.solve import Solvable, case_of
from ehlectric.runtime.log import log_warnings
from ehlectric.runtime.memory import is_out_of_memory
from ehlectric.runtime.parallel.tasks import finished_tasks
from ehlectric.runtime.parallel.workers import Crew, cores, processes
from ehlectric.runtime.progress import Progress, told_to

R = TypeVar("R")

# Result of a case, or the error in its place.
_Outcome = Result | PointResult | BearingResult | DriveResult | Exception


class Solved(NamedTuple, Generic[R]):
    """One case of ``solve_many`` that is finished: its number, its result, and the error in its place.

    Attributes
    ----------
    number : int
        Number of the case in the order in which the cases were given, from 0.
    result : Result, PointResult, BearingResult, DriveResult or None
        Result of the case, which may not be converged; None if there is an error.
    error : Exception or None
        Error that ``solve`` would have raised, or a ``LostError`` if the process of the case was killed.
    """

    number: int
    result: R | None
    error: Exception | None = None


@overload
def solve_many(
    cases: Iterable[LineCase], workers: int | None = None, *, progress: Progress | None = None
) -> Iterator[Solved[Result]]: ...
@overload
def solve_many(
    cases: Iterable[PointCase], workers: int | None = None, *, progress: Progress | None = None
) -> Iterator[Solved[PointResult]]: ...
@overload
def solve_many(
    cases: Iterable[Case], workers: int | None = None, *, progress: Progress | None = None
) -> Iterator[Solved[Result | PointResult]]: ...
@overload
def solve_many(
    cases: Iterable[BearingCase], workers: int | None = None, *, progress: Progress | None = None
) -> Iterator[Solved[BearingResult]]: ...
@overload
def solve_many(
    cases: Iterable[DriveCase], workers: int | None = None, *, progress: Progress | None = None
) -> Iterator[Solved[DriveResult]]: ...
@overload
def solve_many(
    cases: Iterable[Solvable], workers: int | None = None, *, progress: Progress | None = None
) -> Iterator[Solved[Result | PointResult | BearingResult | DriveResult]]: ...


def solve_many(
    cases: Iterable[Solvable], workers: int | None = None, *, progress: Progress | None = None
) -> Iterator[Solved[Any]]:
    """Solve many contacts, bearings and drives in parallel, and yield each as it finishes.

    Parameters
    ----------
    cases : iterable of Case, BearingCase, DriveCase, mapping, str or Path
        Whatever ``solve`` takes. The iterable is read as the processes get free, so it may be endless.
    workers : int, optional
        Number of processes of this machine; by default the number of cores. With 1, the cases are solved in
        this process, one after the other. Processes take some seconds to start: 1 is faster for a few cases
        of a second or less, such as bearings whose contacts are not solved.
    progress : callable, optional
        Called before each case is yielded with the number of finished cases, the number of all cases, which
        is 0 where ``cases`` has no length, and the title of the case. ``print`` will do.

    Yields
    ------
    Solved
        Number of the case, and its result or its error, in the order in which they finish. An error of one
        case ends nothing: it stands in place of the result.

    Raises
    ------
    InputError
        If ``workers`` is not a whole number of at least 1, ``cases`` is a single case, or ``progress`` cannot
        be called.
    LostError
        If the processes cannot start or work no longer.

    Notes
    -----
    Nothing is written to files, and nothing is kept where the loop ends early; ``run_sweep`` saves each point
    of a sweep. A process that is killed, as by a system out of memory, costs only its own case.

    Examples
    --------
    >>> oil = {"base": "paper"}
    >>> contact = {"reduced_radius": "14.1 mm", "reduced_modulus": "226 GPa", "max_hertz_pressure": "1 GPa"}
    >>> tables = [{"contact": contact | {"entrainment_speed": u}, "lubricant": oil} for u in (2.0, 4.0)]
    >>> films = {one.number: one.result.film.minimum_thickness for one in solve_many(tables, workers=1)}
    >>> round(films[1] / films[0], 2)
    1.64
    """
    if isinstance(workers, bool) or not (workers is None or (isinstance(workers, int) and workers >= 1)):
        raise InputError("workers", got=shown(workers), takes="a whole number of at least 1")
    single = isinstance(cases, Case | BearingCase | DriveCase | Mapping | str | PathLike)
    if single or not isinstance(cases, Iterable):
        raise InputError(
            "cases", got=shown(type(cases).__name__), takes="a list of cases; solve takes one case"
        )
    number, report = workers or cores(), told_to(progress)
    given = enumerate(cases)
    found = _here(given) if number == 1 else _in_processes(given, number)
    return _reported(found, len(cases) if isinstance(cases, Sized) else 0, report)


def _reported(found: Generator[Solved[Any], None, None], of: int, report: Progress) -> Iterator[Solved[Any]]:
    """Finished cases, each told before it is yielded."""
    with closing(found):
        for done, one in enumerate(found, 1):
            title = "" if one.result is None else one.result.case.title
            report(done, of, title or f"case {one.number}")
            yield one


def _here(cases: Iterator[tuple[int, Solvable]]) -> Generator[Solved[Any], None, None]:
    """Cases solved in this process."""
    for index, case in cases:
        yield _told(index, solve_case(case))


def _in_processes(cases: Iterator[tuple[int, Solvable]], number: int) -> Generator[Solved[Any], None, None]:
    """Cases solved in processes of this machine."""
    with ExitStack() as crews:
        crew: Crew = crews.enter_context(processes(number))
        handed = ((index, _without_classes_of_the_script(case)) for index, case in cases)
        batches = finished_tasks(handed, crew, solve_case, LostError, _ran_out)
        crews.callback(batches.close)
        for batch in batches:
            for index, outcome in batch:
                yield _told(index, outcome)


def _without_classes_of_the_script(given: Solvable) -> Solvable:
    """Case of nested tables, in which values may be of classes that other processes cannot import."""
    if not isinstance(given, Mapping):
        return given
    try:
        return case_of(given)
    except InputError:
        return given  # refused where it is solved, as a case that does not stop the others


def _ran_out(outcome: _Outcome) -> bool:
    """Whether a case found too little memory; alone it may find more."""
    return isinstance(outcome, Exception) and is_out_of_memory(outcome)


def _told(index: int, outcome: _Outcome) -> Solved[Any]:
    """Finished case, whose warnings are logged."""
    if isinstance(outcome, Exception):
        return Solved(index, None, outcome)
    log_warnings(outcome.case.title, outcome.warnings)
    return Solved(index, outcome)


def solve_case(given: Solvable) -> _Outcome:
    """Result of a case, or the error that its solution raises; bearings are solved in this process alone."""
    try:
        case = case_of(given)
        if isinstance(case, DriveCase):
            return solve_drive(case, workers=1)
        solver = partial(solve_bearing, workers=1) if isinstance(case, BearingCase) else solve
        return solver(case)  # type: ignore[arg-type]
    except Exception as error:
        return error
