"""Solution of anything that can be solved, in memory: ``solve`` and ``solve_motion``."""

from __future__ import annotations

import math
from collections.abc import Mapping
from os import PathLike
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, TypeAlias, overload

from ehlectric.bearing.result import BearingResult
from ehlectric.bearing.solver import solve_bearing
from ehlectric.cases.any_case import case_of_dict, case_of_file
from ehlectric.cases.bearings.case import BearingCase
from ehlectric.cases.case import Case, LineCase, PointCase
from ehlectric.cases.drives.case import DriveCase
from ehlectric.cases.table import read_toml
from ehlectric.contact.check import PreparedContact, check_case, with_laws
from ehlectric.contact.reach import FilmProgress
from ehlectric.contact.results import PointResult, Result
from ehlectric.contact.solver import OWN, Solvers
from ehlectric.contact.solver import solve as solve_stationary
from ehlectric.drive.result import DriveResult, solve_drive
from ehlectric.errors import ConvergenceError, InputError, printable, shown
from ehlectric.film.mesh import Mesh
from ehlectric.lubricant.own import Laws
from ehlectric.motion.result import MotionResult
from ehlectric.motion.run import run_motion
from ehlectric.motion.stored_run import MOTION, read_motion
from ehlectric.runs.kinds import kind_of_tables
from ehlectric.runtime.log import LOGGER, log_warnings
from ehlectric.runtime.progress import Progress, silent, told_to

# A case, its tables, or the path of its file.
Solvable: TypeAlias = Case | BearingCase | DriveCase | Mapping[str, Any] | str | PathLike[str]


@overload
def solve(
    case: LineCase,
    *,
    progress: Progress | None = None,
    require_convergence: bool = False,
    solvers: str | Solvers = "ehlectric",
    beside_smooth: bool = True,
    laws: Laws | None = None,
) -> Result: ...
@overload
def solve(
    case: PointCase,
    *,
    progress: Progress | None = None,
    require_convergence: bool = False,
    solvers: str | Solvers = "ehlectric",
    beside_smooth: bool = True,
    laws: Laws | None = None,
) -> PointResult: ...
@overload
def solve(
    case: Case,
    *,
    progress: Progress | None = None,
    require_convergence: bool = False,
    solvers: str | Solvers = "ehlectric",
    beside_smooth: bool = True,
    laws: Laws | None = None,
) -> Result | PointResult: ...
@overload
def solve(
    case: BearingCase,
    *,
    progress: Progress | None = None,
    require_convergence: bool = False,
    workers: int | None = None,
) -> BearingResult: ...
@overload
def solve(
    case: DriveCase,
    *,
    progress: Progress | None = None,
    require_convergence: bool = False,
    workers: int | None = None,
) -> DriveResult: ...
@overload
def solve(
    case: Mapping[str, Any] | str | PathLike[str],
    *,
    progress: Progress | None = None,
    require_convergence: bool = False,
    solvers: str | Solvers = "ehlectric",
    beside_smooth: bool = True,
    laws: Laws | None = None,
    workers: int | None = None,
) -> Any: ...


def solve(
    case: Solvable,
    *,
    progress: Progress | None = None,
    require_convergence: bool = False,
    solvers: str | Solvers = "ehlectric",
    beside_smooth: bool = True,
    laws: Laws | None = None,
    workers: int | None = None,
) -> Result | PointResult | BearingResult | DriveResult:
    """Solve a contact, a bearing or a drive.

    Parameters
    ----------
    case : Case, BearingCase, DriveCase, mapping, str or Path
        Case of a stationary contact, of a bearing or of a drive, its nested tables, or the path of its TOML
        file.
    progress : callable, optional
        Called with a number of parts done, the number of all parts, and a text. The parts of a contact are
        percent of the expected work; they never decrease, and reach 100 at the end. Where a grid is refined,
        their text has its grid, the error so far and about the time that is left. Those of a bearing are its
        contacts, and those of a drive percent of the simulated time.
    require_convergence : bool
        Whether to raise a ConvergenceError if a film does not converge, instead of returning the result with
        ``converged`` false.
    solvers : str
        "ehlectric", or "paper" for the solvers of the paper, which solve smooth and rough line contacts.
    beside_smooth : bool
        Whether to solve a rough contact with smooth surfaces too, for ``result.smooth``.
    laws : Laws, optional
        Laws of your own for the oil of a contact, in place of those of the case: Python functions of pressure
        and temperature. The contact needs a temperature.
    workers : int, optional
        Number of processes that solve the contacts of bearings; by default the number of cores.

    Returns
    -------
    Result, PointResult, BearingResult or DriveResult
        Result of a line contact, a point contact, a bearing or a drive. Its warnings are logged, too.

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
    found = case_of(case)
    told_to(progress)
    if laws is not None and (not isinstance(laws, Laws) or not isinstance(found, Case)):
        raise InputError(
            "laws", got=shown(type(laws).__name__), takes="Laws of functions, for a case of a contact"
        )
    if isinstance(found, BearingCase | DriveCase):
        return _of_bearings(found, progress, workers, solvers, require_convergence=require_convergence)
    if found.motion is not None:
        takes = "solve_motion(case), run_motion(case, folder), or a case without it"
        raise InputError("motion", "is a table of transient contacts;", takes=takes)
    chosen = solvers_of(solvers)
    accepted = chosen.accept(found)
    if laws is not None:
        accepted = with_laws(accepted, laws)
    prepared = check_case(accepted)
    if prepared.reach is not None:
        log_warnings(found.title, prepared.reach.warnings())
    told = _Percent(prepared, progress or silent)
    result = solve_stationary(
        accepted,
        progress=told,
        require_convergence=require_convergence,
        solvers=chosen,
        beside_smooth=beside_smooth,
        prepared=prepared,
        on_grid=told.on_grid,
    )
    if progress is not None:
        progress(100, 100, "solved")
    log_warnings(found.title, result.warnings)
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
    if solvers_of(solvers) is not OWN:
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


def case_of(given: object) -> Case | BearingCase | DriveCase:
    """Case that is given as itself, as its nested tables, or by the path of its file.

    Raises
    ------
    InputError
        If it is none of these, or not valid.
    """
    if isinstance(given, Case | BearingCase | DriveCase):
        return given
    if isinstance(given, Mapping):
        drive = _is_drive("case", given)
        return DriveCase.from_dict(given) if drive else case_of_dict(given)
    if isinstance(given, str | PathLike):
        path = Path(given)
        drive = _is_drive(path, read_toml(path))
        return DriveCase.from_toml(path) if drive else case_of_file(path)
    takes = "a Case, a BearingCase, a DriveCase, a dict, or the path of a TOML file"
    sweep = "; run_sweep solves a Sweep" if type(given).__name__ == "Sweep" else ""
    raise InputError("case", got=shown(type(given).__name__), takes=takes + sweep)


def _is_drive(name: object, table: Mapping[str, Any]) -> bool:
    """Whether tables are those of a drive; those of a sweep are refused."""
    kind = kind_of_tables(table)
    if kind == "sweep":
        raise InputError(name, "is a sweep;", takes="run_sweep(Sweep.from_toml(path), folder)")
    return kind == "drive"


def solvers_of(given: str | Solvers) -> Solvers:
    """Solvers by their name, "ehlectric" or "paper".

    Raises
    ------
    InputError
        If there are no solvers of this name.
    """
    if isinstance(given, Solvers):
        return given
    if given == OWN.name:
        return OWN
    from ehlectric.paper.solvers import SOLVERS

    if given not in SOLVERS:
        raise InputError("solvers", got=shown(given), takes=f"one of {', '.join(SOLVERS)}")
    return SOLVERS[given]


class _Percent:
    """Progress of a film in percent of the expected work, from the Newton steps on its grids.

    The work on a grid grows with its nodes; on a grid it is done as the logarithm of the residual falls. The
    number never decreases, also where a film starts again or a finer grid follows.
    """

    def __init__(self, contact: PreparedContact, progress: Progress) -> None:
        self._nodes = contact.case.first_grid.nodes_along
        self._power = 1 if contact.conditions.geometry == "line" else 2
        self._tolerance, self._progress = contact.case.solver.tolerance, progress
        self._told = FilmProgress(contact.reach)
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
        self._progress(self._most, 100, self._told.text(nodes, step, residual))

    def on_grid(self, mesh: Mesh, error: float | None) -> None:
        """Note that a grid of a refinement is solved, and its error."""
        self._told.on_grid(mesh, error)


def solve_motion(case: Case, *, progress: Progress = silent) -> MotionResult:
    """Solve a contact with moving roughness in memory.

    ``run_motion`` writes the instants of a long run into a folder while they are solved, and resumes a run
    that was stopped; ``load`` reads them.

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
    """
    if case.motion is None:
        raise InputError("motion", "missing;", takes="it, or solve for a stationary contact")
    told_to(progress)
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
