"""Solution of anything that can be solved, in memory and in parallel, and saving and loading of results."""

from __future__ import annotations

import math
from collections.abc import Callable, Generator, Iterable, Iterator, Mapping, Sized
from contextlib import closing
from dataclasses import replace
from os import PathLike
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any, Generic, NamedTuple, TypeAlias, TypedDict, TypeVar, Unpack, overload

from ehlectric import axle, bearing, contact, drive, gear
from ehlectric.axle import AxleResult, solve_axle
from ehlectric.bearing import BearingResult, solve_bearing
from ehlectric.cases.axle_case import AxleCase
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.cases.case import Case, LineCase, PointCase
from ehlectric.cases.drive_case import DriveCase, case_of_dict
from ehlectric.cases.gear_case import GearCase
from ehlectric.cases.solved_case import SolvedCase
from ehlectric.contact import (
    DEFAULT_SOLVERS,
    FilmProgress,
    PointResult,
    PreparedContact,
    Result,
    Solvers,
    case_with_laws,
    portable,
    prepare,
)
from ehlectric.contact import solve as solve_stationary
from ehlectric.drive import DriveResult, solve_drive
from ehlectric.errors import ConvergenceError, InputError, LostError, printable, shown
from ehlectric.film import Mesh
from ehlectric.gear import GearResult, solve_gear
from ehlectric.lubricant.python_laws import Laws
from ehlectric.motion.result import MotionResult
from ehlectric.motion.run import run_motion
from ehlectric.motion.stored import SCHEMA as MOVING
from ehlectric.motion.stored_run import checked_motion, read_motion
from ehlectric.runs.by_kind import RUNS, solvers_of
from ehlectric.runs.file_kinds import FileKind, kind_of_tables, read_input
from ehlectric.runs.result_folders import stored_result
from ehlectric.runtime.file_rules import format_of
from ehlectric.runtime.memory import is_out_of_memory
from ehlectric.runtime.netcdf import read_dataset
from ehlectric.runtime.progress import LOGGER, Progress, log_warnings, progress_or_silent, silent
from ehlectric.runtime.result_names import MOTION
from ehlectric.runtime.tasks import finished_tasks
from ehlectric.runtime.worker_processes import cores, processes
from ehlectric.sweep import NAME as SWEEP

if TYPE_CHECKING:
    import xarray as xr


# Results of ``solve``, and of ``load``.
SolvedResult: TypeAlias = Result | PointResult | BearingResult | DriveResult | GearResult | AxleResult
AnyResult: TypeAlias = SolvedResult | MotionResult


def _moving(dataset: xr.Dataset, path: Path) -> MotionResult:
    """Result with moving roughness, whose file may be incomplete."""
    return MotionResult.of(checked_motion(dataset, path))


# Results by the kinds that their files state.
_OF_KINDS: Mapping[str, Callable[[xr.Dataset, Path], AnyResult]] = {
    format_of(schema)[0]: result_of
    for schema, result_of in (
        (contact.SCHEMA, contact.result_of),
        (bearing.SCHEMA, bearing.result_of),
        (drive.SCHEMA, drive.result_of),
        (gear.SCHEMA, gear.result_of),
        (axle.SCHEMA, axle.result_of),
        (MOVING, _moving),
    )
}


def load(path: str | Path) -> AnyResult:
    """Load the result of a contact, a bearing, a gear pair, a drive, an axle or moving roughness.

    Parameters
    ----------
    path : str or Path
        A result.nc, bearing.nc, gear.nc, drive.nc, axle.nc or motion.nc, or the folder with this file.

    Returns
    -------
    Result, PointResult, BearingResult, GearResult, DriveResult, AxleResult or MotionResult
        Result, equal to the one that was saved. The result of a drive does not contain its solved bearings.

    Raises
    ------
    InputError
        Where the file cannot be read or is not a result, or the folder has none, several, or a sweep.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> from ehlectric import solve
    >>> contact = {"reduced_radius": "14.1 mm", "reduced_modulus": "226 GPa"}
    >>> contact |= {"max_hertz_pressure": "1 GPa", "entrainment_speed": "4 m/s"}
    >>> result = solve({"contact": contact, "lubricant": {"base": "paper"}, "grid": {"nodes": 401}})
    >>> with TemporaryDirectory() as folder:
    ...     files = save(result, folder)
    ...     load(folder) == result
    True
    """
    path = stored_result(path)
    if path.name == SWEEP:
        raise InputError(path.parent, "is the folder of a sweep", takes="a result; read_sweep reads a sweep")
    dataset = read_dataset(path) if path.is_file() else read_motion(path)
    kind, _ = format_of(dataset.attrs.get("schema"))
    if kind not in _OF_KINDS:
        raise InputError(path, "is not a result of ehlectric")
    return _OF_KINDS[kind](dataset, path)


def save(result: SolvedResult, folder: str | Path) -> list[Path]:
    """Save the result of a contact, bearing, gear pair, drive or axle.

    Parameters
    ----------
    result : Result, PointResult, BearingResult, GearResult, DriveResult or AxleResult
        Result of ``solve``. A contact writes summary.json, result.nc and film.csv; a bearing writes
        summary.json, contacts.csv, bearing.nc and, where it has one, impedance.csv; a gear pair writes
        summary.json, path.csv, mesh.csv and gear.nc; a drive writes summary.json, events.csv, spectrum.csv
        and drive.nc; an axle writes summary.json, elements.csv, shafts.csv and axle.nc.
    folder : str or Path
        Folder of the files; it is made if it does not exist.

    Returns
    -------
    list of Path
        Files written.

    Raises
    ------
    InputError
        Where the folder cannot be written to, or the result has no case, which the files must hold. Also
        for a result of ``solve_motion``, which ``run_motion`` writes while it is solved.
    UnreadableError
        If ``load`` would refuse the file, for a reason in the message. All files are written.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> from ehlectric import Case, save, solve
    >>> contact = {"reduced_radius": "14.1 mm", "reduced_modulus": "226 GPa"}
    >>> contact |= {"max_hertz_pressure": "1 GPa", "entrainment_speed": "4 m/s"}
    >>> case = Case.from_dict({"contact": contact, "lubricant": {"base": "paper"}, "grid": {"nodes": 401}})
    >>> with TemporaryDirectory() as folder:
    ...     files = save(solve(case), folder)
    >>> "summary.json" in [file.name for file in files]
    True
    """
    if isinstance(result, BearingResult):
        return bearing.save(result, folder)
    if isinstance(result, GearResult):
        return gear.save(result, folder)
    if isinstance(result, DriveResult):
        return drive.save(result, folder)
    if isinstance(result, AxleResult):
        return axle.save(result, folder)
    if isinstance(result, Result | PointResult):
        return contact.save(result, folder)
    raise InputError(
        "result",
        got=shown(type(result).__name__),
        takes="a result of a contact, a bearing, a gear pair, a drive or an axle",
    )


# A case, its tables, or the path of its file.
Solvable: TypeAlias = SolvedCase | AxleCase | Mapping[str, Any] | str | PathLike[str]


class _Options(TypedDict, total=False):
    progress: Progress | None
    require_convergence: bool


class _ContactOptions(_Options, total=False):
    solvers: str | Solvers
    beside_smooth: bool
    laws: Laws | None


class _BearingOptions(_Options, total=False):
    workers: int | None


class _AnyOptions(_ContactOptions, _BearingOptions, total=False):
    pass


@overload
def solve(case: LineCase, **options: Unpack[_ContactOptions]) -> Result: ...
@overload
def solve(case: PointCase, **options: Unpack[_ContactOptions]) -> PointResult: ...
@overload
def solve(case: Case, **options: Unpack[_ContactOptions]) -> Result | PointResult: ...
@overload
def solve(case: BearingCase, **options: Unpack[_BearingOptions]) -> BearingResult: ...
@overload
def solve(case: DriveCase, **options: Unpack[_BearingOptions]) -> DriveResult: ...
@overload
def solve(case: GearCase, **options: Unpack[_Options]) -> GearResult: ...
@overload
def solve(case: AxleCase, **options: Unpack[_Options]) -> AxleResult: ...
@overload
def solve(case: Mapping[str, Any] | str | PathLike[str], **options: Unpack[_AnyOptions]) -> Any: ...


def solve(
    case: Solvable,
    *,
    progress: Progress | None = None,
    require_convergence: bool = False,
    solvers: str | Solvers = "ehlectric",
    beside_smooth: bool = True,
    laws: Laws | None = None,
    workers: int | None = None,
) -> SolvedResult:
    """Solve a contact, a bearing, a gear pair, a drive or an axle.

    Parameters
    ----------
    case : Case, BearingCase, GearCase, DriveCase, AxleCase, mapping, str or Path
        Case of a stationary contact, of a bearing, of a gear pair, of a drive or of an axle, its nested
        tables, or the path of its TOML file.
    progress : callable, optional
        Called with a number of parts done, the number of all parts, and a text. The parts of a contact are
        percent of the expected work; they never decrease, and reach 100 at the end. If a grid is refined,
        their text has its grid, the error so far and about the time that is left. The parts of a bearing are
        its contacts, and the parts of a drive percent of the simulated time. A gear pair has no parts.
    require_convergence : bool
        Whether to raise a ConvergenceError if a film does not converge, instead of returning the result with
        ``converged`` false.
    solvers : str
        "ehlectric", or "paper" for the solvers of the paper, which solve smooth and rough line contacts.
    beside_smooth : bool
        Whether to solve a rough contact with smooth surfaces too, for ``result.smooth``.
    laws : Laws, optional
        Laws of your own for the oil of a contact, which replace the laws of the case: Python functions of
        pressure and temperature. The contact needs a temperature. The case of the result keeps them.
    workers : int, optional
        Number of processes that solve the contacts of bearings; by default the number of cores.

    Returns
    -------
    Result, PointResult, BearingResult, GearResult, DriveResult or AxleResult
        Result of a line contact, a point contact, a bearing, a gear pair or a drive. Its warnings are also
        logged.

    Raises
    ------
    InputError
        If the input or ``progress`` is wrong, or the input is a sweep or a case with motion; the message
        names the right function.
    ConvergenceError
        If a film did not converge and ``require_convergence`` is True, or if a field did not converge.

    Examples
    --------
    >>> case = Case.line(
    ...     reduced_radius="14.1 mm",
    ...     reduced_modulus="226 GPa",
    ...     max_hertz_pressure="1 GPa",
    ...     entrainment_speed="4 m/s",
    ...     lubricant="paper",
    ... )
    >>> solve(case)  # doctest: +ELLIPSIS
    <Result line contact, minimum film ..., maximum pressure ..., maximum field ..., converged>
    """
    valid_case = case_of(case)
    progress_or_silent(progress)
    if isinstance(valid_case, AxleCase):
        return _of_axle(valid_case, progress or silent, solvers, laws)
    if laws is not None:
        valid_case = case_with_laws(valid_case, laws)
    if isinstance(valid_case, GearCase):
        return _of_gears(valid_case, progress or silent, solvers)
    if isinstance(valid_case, BearingCase | DriveCase):
        return _of_bearings(valid_case, progress, workers, solvers, require_convergence=require_convergence)
    if valid_case.motion is not None:
        takes = "solve_motion(case), run_motion(case, folder), or a case without it"
        raise InputError("motion", "is a table of transient contacts;", takes=takes)
    chosen = solvers_of(solvers)
    prepared = prepare(chosen.accept(valid_case))
    log_warnings(valid_case.title, prepared.reach_warnings())
    percent = _Percent(prepared, progress or silent)
    result = solve_stationary(
        prepared,
        progress=percent,
        require_convergence=require_convergence,
        solvers=chosen,
        beside_smooth=beside_smooth,
        on_grid=percent.on_grid,
    )
    if progress is not None:
        progress(100, 100, "solved")
    log_warnings(valid_case.title, result.warnings)
    return result


def _of_gears(case: GearCase, progress: Progress, solvers: str | Solvers) -> GearResult:
    """Result of a gear pair; its warnings are logged."""
    if solvers_of(solvers) is not DEFAULT_SOLVERS:
        raise InputError("solvers", got=shown(solvers), takes="'ehlectric' for a gear pair")
    progress(0, 0, "solving films")
    result = solve_gear(case)
    log_warnings(case.title, result.warnings)
    return result


def _of_axle(case: AxleCase, progress: Progress, solvers: str | Solvers, laws: Laws | None) -> AxleResult:
    """Result of an axle; its warnings are logged."""
    if solvers_of(solvers) is not DEFAULT_SOLVERS:
        raise InputError("solvers", got=shown(solvers), takes="'ehlectric' for an axle")
    if laws is not None:
        raise InputError("laws", got="them with an axle", takes="a contact")
    result = solve_axle(case, progress=progress)
    log_warnings(case.title, result.warnings)
    return result


def _of_bearings(
    case: BearingCase | DriveCase,
    progress: Progress | None,
    workers: int | None,
    solvers: str | Solvers,
    *,
    require_convergence: bool,
) -> BearingResult | DriveResult:
    """Result of a bearing or of a drive; its warnings are logged."""
    if solvers_of(solvers) is not DEFAULT_SOLVERS:
        raise InputError("solvers", got=shown(solvers), takes="'ehlectric' for a bearing or a drive")
    result: BearingResult | DriveResult
    if isinstance(case, BearingCase):
        result = solve_bearing(case, progress=progress, workers=workers)
    else:
        result = solve_drive(case, progress=progress, workers=workers)
    if require_convergence and not result.converged:
        raise ConvergenceError("a contact of the bearing")
    log_warnings(case.title, result.warnings)
    return result


def case_of(given: object) -> SolvedCase | AxleCase:
    """Case that is given as itself, as its nested tables, or by the path of its file. Raises InputError if it
    is none of these, or not valid.
    """
    if isinstance(given, SolvedCase | AxleCase):
        return given
    if isinstance(given, Mapping):
        kind = kind_of_tables(given)
        _refuse_sweep("case", kind)
        if kind == "gear":
            return GearCase.from_dict(given)
        if kind == "axle":
            return AxleCase.from_dict(given)
        return DriveCase.from_dict(given) if kind == "drive" else case_of_dict(given)
    if isinstance(given, str | PathLike):
        file = read_input(Path(given))
        _refuse_sweep(file.path, file.kind)
        case: SolvedCase | AxleCase = RUNS[file.kind].read(file)
        return case
    takes = "a Case, a BearingCase, a GearCase, a DriveCase, an AxleCase, a dict, or the path of a TOML file"
    sweep = "; run_sweep solves a Sweep" if type(given).__name__ == "Sweep" else ""
    raise InputError("case", got=shown(type(given).__name__), takes=takes + sweep)


def _refuse_sweep(name: object, kind: FileKind | None) -> None:
    if kind == "sweep":
        raise InputError(name, "is a sweep;", takes="run_sweep(Sweep.from_toml(path), folder)")


class _Percent:
    """Progress of a film in percent of the expected work, from the Newton steps on its grids.

    The work on a grid grows with its nodes; on a grid it is done as the logarithm of the residual falls. The
    number never decreases, also where a film starts again or a finer grid follows.
    """

    def __init__(self, contact: PreparedContact, progress: Progress) -> None:
        self._nodes = contact.case.first_grid.nodes_along
        self._power = 1 if contact.conditions.geometry == "line" else 2
        self._tolerance, self._progress = contact.case.solver.tolerance, progress
        self._film_progress = FilmProgress(contact.reach)
        self._grid, self._first, self._most = 0, 1.0, 0
        self._start = 0.0  # share of coarser grids than the first, which are not solved

    def __call__(self, nodes: int, step: int, residual: float) -> None:
        if nodes != self._grid or step == 0:
            self._grid, self._first = nodes, max(residual, 10.0 * self._tolerance)
        self._nodes = max(self._nodes, nodes)  # grid.refine adds grids
        fallen = math.log(self._first / residual) if 0.0 < residual < math.inf else 0.0
        part = min(1.0, max(0.0, fallen / math.log(self._first / self._tolerance)))
        # The grids before have 1/2 of the nodes along each axis, 1/4, and so on.
        share, ratio = (nodes / self._nodes) ** self._power, 0.5**self._power
        self._start = self._start or share * ratio
        done = (share * (ratio + (1.0 - ratio) * part) - self._start) / (1.0 - self._start)
        self._most = max(self._most, min(99, int(100.0 * done)))
        self._progress(self._most, 100, self._film_progress.text(nodes, step, residual))

    def on_grid(self, mesh: Mesh, error: float | None) -> None:
        """Note that a grid of a refinement is solved, and its error."""
        self._film_progress.on_grid(mesh, error)


def solve_motion(case: Case, *, progress: Progress = silent) -> MotionResult:
    """Solve a contact with moving roughness in memory.

    ``run_motion`` saves the instants of a long run in a folder while they are solved, and resumes a run that
    was stopped; ``load`` reads them.

    Parameters
    ----------
    case : Case
        Case with ``motion``.
    progress : callable, optional
        Called with the number of steps done, the number of all steps, and what is being done.

    Returns
    -------
    MotionResult
        All solved steps. If a step did not converge, the result ends before it, ``complete`` is false, and
        the reason is logged as a warning.

    Raises
    ------
    InputError
        If the case has no motion or cannot be solved.
    ConvergenceError
        If the film before the motion did not converge.

    Examples
    --------
    >>> import ehlectric
    >>> case = ehlectric.Case.from_toml(ehlectric.example("moving_roughness.toml"))
    >>> case = case.replace({"grid.nodes": 401, "motion.passes": 0.05, "motion.steps": 4, "motion.record": 4})
    >>> result = ehlectric.solve_motion(case)
    >>> result.complete, result.dataset.sizes["step"]
    (True, 5)
    """
    if case.motion is None:
        raise InputError("motion", "missing;", takes="it, or solve for a stationary contact")
    progress_or_silent(progress)
    with TemporaryDirectory() as folder:
        try:
            run_motion(case, folder, progress=progress)
        except ConvergenceError as error:
            if not (Path(folder) / MOTION).is_file():
                raise
            LOGGER.warning("%s: the run ends early, %s", printable(case.title or "motion"), error)
        result = MotionResult.of(read_motion(folder))
    log_warnings(case.title, result.warnings)
    return result


R = TypeVar("R")

# Result of a case, or the error instead.
_Outcome = SolvedResult | Exception


class Solved(NamedTuple, Generic[R]):
    """One case of ``solve_many`` that is finished: its number, its result, and the error instead.

    Attributes
    ----------
    number : int
        Number of the case in the order in which the cases were given, from 0.
    result : Result, PointResult, BearingResult, GearResult, DriveResult or None
        Result of the case, which may not be converged; None if there is an error.
    error : Exception or None
        Error that ``solve`` would have raised, or a ``LostError`` if the process of the case was killed.

    Examples
    --------
    >>> from ehlectric import Case, solve_many
    >>> contact = {"reduced_radius": "14.1 mm", "reduced_modulus": "226 GPa"}
    >>> contact |= {"max_hertz_pressure": "1 GPa", "entrainment_speed": "4 m/s"}
    >>> case = Case.from_dict({"contact": contact, "lubricant": {"base": "paper"}, "grid": {"nodes": 401}})
    >>> (solved,) = solve_many([case], workers=1)
    >>> solved.number, solved.result.converged, solved.error
    (0, True, None)
    """

    number: int
    result: R | None
    error: Exception | None = None


@overload
def solve_many(
    cases: Iterable[LineCase],
    workers: int | None = None,
    *,
    progress: Progress | None = None,
    laws: Laws | None = None,
) -> Iterator[Solved[Result]]: ...
@overload
def solve_many(
    cases: Iterable[PointCase],
    workers: int | None = None,
    *,
    progress: Progress | None = None,
    laws: Laws | None = None,
) -> Iterator[Solved[PointResult]]: ...
@overload
def solve_many(
    cases: Iterable[Case],
    workers: int | None = None,
    *,
    progress: Progress | None = None,
    laws: Laws | None = None,
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
    cases: Iterable[GearCase], workers: int | None = None, *, progress: Progress | None = None
) -> Iterator[Solved[GearResult]]: ...
@overload
def solve_many(
    cases: Iterable[Solvable],
    workers: int | None = None,
    *,
    progress: Progress | None = None,
    laws: Laws | None = None,
) -> Iterator[Solved[SolvedResult]]: ...


def solve_many(
    cases: Iterable[Solvable],
    workers: int | None = None,
    *,
    progress: Progress | None = None,
    laws: Laws | None = None,
) -> Iterator[Solved[Any]]:
    """Solve many contacts, bearings, gear pairs, drives and axles in parallel, and yield each as it finishes.

    Parameters
    ----------
    cases : iterable of Case, BearingCase, GearCase, DriveCase, AxleCase, mapping, str or Path
        Whatever ``solve`` takes. The iterable is read as the processes get free, so it may be endless.
    workers : int, optional
        Number of processes of this machine; by default the number of cores. With 1, the cases are solved in
        this process, one after the other. Processes take a few seconds to start: 1 is faster for a few cases
        of a second or less, such as bearings whose contacts are not solved.
    progress : callable, optional
        Called before each case is yielded with the number of finished cases, the number of all cases, which
        is 0 where ``cases`` has no length, and the title of the case. ``print`` will do.
    laws : Laws, optional
        Laws of your own for the oil of every contact, as in ``solve``. The processes get their values, so
        that functions of a script work.

    Yields
    ------
    Solved
        Number of the case, and its result or its error, in the order in which they finish. An error of one
        case ends nothing: it replaces the result.

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
    >>> results = {solved.number: solved.result for solved in solve_many(tables, workers=1)}
    >>> films = [results[number].film.minimum_thickness for number in range(2)]
    >>> round(films[1] / films[0], 2)
    1.64
    """
    if isinstance(workers, bool) or not (workers is None or (isinstance(workers, int) and workers >= 1)):
        raise InputError("workers", got=shown(workers), takes="a whole number of at least 1")
    single = isinstance(cases, SolvedCase | AxleCase | Mapping | str | PathLike)
    if single or not isinstance(cases, Iterable):
        raise InputError(
            "cases", got=shown(type(cases).__name__), takes="a list of cases; solve takes one case"
        )
    if laws is not None and not isinstance(laws, Laws):
        raise InputError("laws", got=shown(type(laws).__name__), takes="Laws of functions")
    number, report = workers or cores(), progress_or_silent(progress)
    given = enumerate(cases if laws is None else (_given_laws(case, laws) for case in cases))
    finished = _here(given) if number == 1 else _in_processes(given, number)
    return _reported(finished, len(cases) if isinstance(cases, Sized) else 0, report)


def _reported(
    finished: Generator[Solved[Any], None, None], of: int, report: Progress
) -> Iterator[Solved[Any]]:
    """Finished cases, each reported before it is yielded."""
    with closing(finished):
        for done, solved in enumerate(finished, 1):
            title = "" if solved.result is None else solved.result.case.title
            report(done, of, title or f"case {solved.number}")
            yield solved


def _given_laws(case: Solvable, laws: Laws) -> Solvable | InputError:
    """Case with laws of the user's own, or the error of a case that does not take them."""
    try:
        return case_with_laws(case_of(case), laws)
    except InputError as error:
        return error


def _here(cases: Iterator[tuple[int, Solvable | InputError]]) -> Generator[Solved[Any], None, None]:
    """Cases solved in this process."""
    for index, case in cases:
        yield _logged(index, solve_case(case))


def _in_processes(
    cases: Iterator[tuple[int, Solvable | InputError]], number: int
) -> Generator[Solved[Any], None, None]:
    """Cases solved in processes of this machine."""
    with_functions: dict[int, Case] = {}  # cases with functions, which the processes do not get

    def handed() -> Iterator[tuple[int, Solvable | InputError]]:
        for index, given in cases:
            case = _without_classes_of_the_script(given)
            if isinstance(given, Case) and case is not given:
                with_functions[index] = given
            yield index, case

    with (
        processes(number) as crew,
        closing(finished_tasks(handed(), crew, solve_case, LostError, _ran_out)) as batches,
    ):
        for index, outcome in (each for batch in batches for each in batch):
            case = with_functions.pop(index, None)
            if case is not None and isinstance(outcome, Result | PointResult):
                outcome = replace(outcome, case=case)
            yield _logged(index, outcome)


def _without_classes_of_the_script(given: Solvable | InputError) -> Solvable | InputError:
    """Case of nested tables, in which values may be of classes that other processes cannot import, and case
    with the values of functions of the user's own.
    """
    try:
        if isinstance(given, Mapping):
            given = case_of(given)
        return portable(given) if isinstance(given, Case) else given
    except InputError as error:
        return error if isinstance(given, Case) else given  # refused where it is solved


def _ran_out(outcome: _Outcome) -> bool:
    """Whether a case had too little memory; without other cases it may have more."""
    return isinstance(outcome, Exception) and is_out_of_memory(outcome)


def _logged(index: int, outcome: _Outcome) -> Solved[Any]:
    """Finished case, whose warnings are logged."""
    if isinstance(outcome, Exception):
        return Solved(index, None, outcome)
    log_warnings(outcome.case.title, outcome.warnings)
    return Solved(index, outcome)


def solve_case(given: Solvable | InputError) -> _Outcome:
    """Result of a case, or the error that its solution raises; bearings are solved in this process only."""
    if isinstance(given, InputError):
        return given
    try:
        case = case_of(given)
        if isinstance(case, DriveCase):
            return solve_drive(case, workers=1)
        if isinstance(case, BearingCase):
            return solve_bearing(case, workers=1)
        if isinstance(case, GearCase):
            return solve_gear(case)
        if isinstance(case, AxleCase):
            return solve_axle(case)
        return solve_stationary(case)
    except Exception as error:
        return error
