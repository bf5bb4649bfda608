"""Solution of the points of a sweep by an executor; every point gets an outcome, also if it fails."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import closing
from types import MappingProxyType
from typing import Any

import numpy as np

from ehlectric.bearing.solver import solve_bearing
from ehlectric.bearing.summary import summary_of
from ehlectric.cases.bearings.case import BearingCase
from ehlectric.cases.case import Case
from ehlectric.cases.drives.case import DriveCase
from ehlectric.cases.drives.swept import swept_case_of_dict
from ehlectric.contact.solver import solve
from ehlectric.errors import ConvergenceError, InputError, MemoryLimitError
from ehlectric.runtime.files import now
from ehlectric.runtime.memory import is_out_of_memory
from ehlectric.runtime.parallel.tasks import finished_tasks
from ehlectric.runtime.parallel.workers import Crew
from ehlectric.sweep.plan import Outcome
from ehlectric.sweep.results import Status
from ehlectric.version import __version__

Task = tuple[str, Mapping[str, Any]]


def solve_point(table: Mapping[str, Any]) -> Outcome:
    """Solve a case given as plain data, in any process.

    Parameters
    ----------
    table : mapping
        The case, from ``Case.to_dict``.

    Returns
    -------
    Outcome
        Outcome of the point. No exception is raised: an error becomes the reason of a failed point.
    """
    started = time.perf_counter()
    status, reason, again, summary = _attempt(table)
    # Messages of libraries may have several lines; the reason is a single one.
    reason = " ".join(reason.split())[:1000]
    return Outcome(status, reason, again, summary, time.perf_counter() - started, __version__, now())


def _attempt(table: Mapping[str, Any]) -> tuple[Status, str, bool, dict[str, Any] | None]:
    """Status and reason of a case, whether another try may succeed, and its summary."""
    try:
        solved, summary, reason = _solved(table)
    except MemoryLimitError as error:
        return "failed", str(error), True, None
    except InputError as error:
        return "failed", str(error), False, None
    except (ConvergenceError, ArithmeticError, np.linalg.LinAlgError) as error:
        return "failed", f"not solved: {error}", False, None
    except Exception as error:
        if is_out_of_memory(error):
            return "failed", f"out of memory: {error}".rstrip(": "), True, None
        return "failed", f"unexpected: {type(error).__name__}: {error}", False, None
    return ("solved", "", False, summary) if solved else ("not converged", reason, False, summary)


def _solved(table: Mapping[str, Any]) -> tuple[bool, dict[str, Any], str]:
    """Whether a case converged, its summary, and the reason if it did not."""
    case = swept_case_of_dict(table)
    return _SOLVERS[type(case)](case)


def _solve_contact(case: Case) -> tuple[bool, dict[str, Any], str]:
    result = solve(case)
    # This warning says what residual was reached and what to try.
    reasons = (warning.text for warning in result.warnings if warning.code == "not-converged")
    return result.converged, result.summary(), next(reasons, result.film.status)


def _solve_bearing(case: BearingCase) -> tuple[bool, dict[str, Any], str]:
    bearing = solve_bearing(case, workers=1)
    # Without the analysis of the margin, which would solve twenty bearings for every point.
    summary = summary_of(bearing.solution)
    del summary["contacts"]  # with columns for every contact, the table would be too wide
    return bearing.converged, summary, "a contact of the bearing is not converged"


def _solve_drive(case: DriveCase) -> tuple[bool, dict[str, Any], str]:
    # Imported here because it loads the compiler of the simulation, which other sweeps do not need.
    from ehlectric.drive.result import solve_drive

    drive = solve_drive(case, workers=1)
    summary = drive.summary()
    del summary["remedies"]  # a point has none
    return drive.converged, summary, "a contact of a bearing is not converged"


# Solution of a case of each kind: whether it converged, its summary, and the reason if it did not.
_SOLVERS: Mapping[type, Callable[[Any], tuple[bool, dict[str, Any], str]]] = MappingProxyType(
    {Case: _solve_contact, BearingCase: _solve_bearing, DriveCase: _solve_drive}
)


def run_points(
    tasks: Iterable[Task], crew: Crew, done: Callable[[Sequence[tuple[str, Outcome]]], None]
) -> None:
    """Solve points with a crew, as many at a time as it can take.

    Parameters
    ----------
    tasks : iterable of (str, mapping)
        Key of each point and its case as plain data. An item is read only when its point is handed over.
    crew : Crew
        Processes or machines that solve the points.
    done : callable
        Called in this thread with a sequence of the keys and outcomes of finished points. While no point
        finishes, it is called about every second with an empty sequence.

    Raises
    ------
    LostError
        If the crew cannot be reached any more. All finished points have been passed to ``done`` before.
    """
    with closing(finished_tasks(tasks, crew, solve_point, _lost, _ran_out)) as batches:
        for outcomes in batches:
            done(outcomes)


def _lost(reason: str) -> Outcome:
    """Outcome of a point that was not solved because its process died; another try may succeed."""
    return Outcome("failed", reason, again=True, date=now())


def _ran_out(outcome: Outcome) -> bool:
    """Whether a point found too little memory; alone it may find more."""
    return outcome.status == "failed" and outcome.again
