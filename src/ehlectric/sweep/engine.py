"""Solution of the points of a sweep, on this machine or on a Dask cluster: what is solved, and every
outcome.
"""

from __future__ import annotations

import asyncio
import hashlib
import json
import logging
import math
import os
import time
import warnings
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import Executor
from contextlib import closing, contextmanager, suppress
from dataclasses import dataclass
from functools import cache, partial
from pathlib import Path
from types import MappingProxyType
from typing import Any, TypeAlias

import numpy as np

from ehlectric.axle import solve_axle
from ehlectric.bearing import (
    SEED,
    solve_bearing,
    spread_alone,
    summary_of,
    tables_of_spread,
    warnings_of_spread,
)
from ehlectric.cases.axle_case import AxleCase, changed_axle
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.cases.case import Case
from ehlectric.cases.drive_case import DriveCase
from ehlectric.cases.gear_case import GearCase, changed_pair
from ehlectric.cases.solved_case import SolvedCase, solved_case_of_dict
from ehlectric.contact import portable, solve
from ehlectric.drive import quick_drive
from ehlectric.errors import ConvergenceError, InputError, LostError, MemoryLimitError, shown
from ehlectric.gear import solve_gear
from ehlectric.lubricant.python_laws import SampledLaws
from ehlectric.quantities.inputs import SPEED, TEMPERATURE, end_and_replaced
from ehlectric.quantities.result_warnings import texts_and_codes
from ehlectric.runtime.files import now
from ehlectric.runtime.memory import is_out_of_memory
from ehlectric.runtime.reading import regular
from ehlectric.runtime.tasks import finished_tasks
from ehlectric.runtime.threads import local_filters
from ehlectric.runtime.worker_processes import Crew, packed_submit
from ehlectric.sweep.points import Status
from ehlectric.sweep.sweep_inputs import Sweep
from ehlectric.version import __version__

# Points whose tables are kept from the plan to the solution, about 10 MB. The others are made twice.
_TABLES_KEPT = 2000


# Case of a point as data for any process: its tables, or the case with the values of laws of the user's own.
PointCase: TypeAlias = Mapping[str, Any] | Case


def task_of(case: SolvedCase) -> PointCase:
    """Case of a point as data for any process."""
    if isinstance(case, Case) and case.user_laws is not None:
        return portable(case)
    return case.to_dict()


@dataclass(frozen=True)
class Planned:
    """Point of a sweep before it is solved."""

    number: int  # number of the point in the order of the design, from 0
    inputs: Mapping[str, Any]  # values of the varied keys, by dotted key of the case, in SI units
    key: str | None  # key of its case, from ``case_key``; None if these inputs make no valid case
    refused: str = ""  # reason why the inputs make no valid case; empty if they do
    # Tables of its case, for the first points only, which would fill the memory of a large sweep.
    table: PointCase | None = None


@dataclass(frozen=True)
class Outcome:
    """Outcome of a point that was tried."""

    status: Status  # "solved", "not converged" or "failed"
    reason: str = ""  # reason why the point is not solved; empty if it is
    again: bool = False  # whether another try may succeed, as after a killed process
    summary: Mapping[str, Any] | None = None  # nested tables, as in summary.json; None if the point failed
    seconds: float = 0.0  # time taken by the solution [s]
    version: str = __version__  # version of ehlectric that tried the point
    date: str = ""


def case_key(case: SolvedCase, uncertainty_samples: int | None = None) -> str:
    """Hash of everything that the result of a case depends on.

    The hash covers all inputs, with their defaults, and the contents of files, but not the title and the
    paths of files. ``uncertainty_samples``, samples of the probability of breakdown, where it is requested.

    Returns SHA-256 hash, hexadecimal. Raises InputError if a file of the case cannot be read.

    Examples
    --------
    >>> from ehlectric.cases.drive_case import case_of_dict
    >>> contact = {"reduced_radius": "14.1 mm", "reduced_modulus": "226 GPa"}
    >>> contact |= {"max_hertz_pressure": "1 GPa", "entrainment_speed": "4 m/s"}
    >>> case = case_of_dict({"contact": contact, "lubricant": {"base": "paper"}})
    >>> case_key(case) == case_key(case.replace(title="Another", solver={"max_iterations": 30}))
    True
    """
    table = case.plain_tables()
    # Rough surfaces, and the measured voltage of a drive.
    for holder in (*table.get("roughness", ()), table.get("source", {})):
        if "file" in holder:
            path = Path(holder["file"])
            with regular(path) as file:
                status = os.fstat(file.fileno())
            holder["file"] = _contents(path, status.st_mtime_ns, status.st_size)
    if isinstance(case, Case) and (laws := portable(case).user_laws) is not None:
        assert isinstance(laws, SampledLaws)
        table["laws"] = laws.digest
    return hash_of(text_of(table, uncertainty_samples))


def text_of(table: Mapping[str, Any], uncertainty_samples: int | None = None) -> str:
    """Return the JSON text of a case's tables without title and duty cycle, on which no sweep point depends;
    ``case_key`` is the hash of such a text.
    """
    known = {key: value for key, value in table.items() if key not in ("title", "duty")}
    if uncertainty_samples is not None:
        known["uncertainty_samples"] = uncertainty_samples
    return json.dumps(known, sort_keys=True, separators=(",", ":"), allow_nan=False)


def hash_of(text: str) -> str:
    """SHA-256 hash of a text, hexadecimal."""
    return hashlib.sha256(text.encode()).hexdigest()


@cache
def _contents(path: Path, _changed: int, _size: int) -> str:
    """SHA-256 hash of a file; it is read again only when its time of change or size differs."""
    with regular(path) as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def plan(sweep: Sweep) -> Iterator[Planned]:
    """Points of a sweep, each with the key of its case, or with the reason why it is no valid case."""
    for number, inputs in enumerate(sweep.points()):
        yield planned_point(sweep, number, inputs)


def planned_point(sweep: Sweep, number: int, inputs: Mapping[str, Any]) -> Planned:
    """Point of a sweep with the key of its case, or with the reason why it is no valid case."""
    try:
        case = _changed(sweep.case, inputs)
        table = task_of(case) if number < _TABLES_KEPT else None
        return Planned(number, inputs, case_key(case, sweep.uncertainty_samples), table=table)
    except InputError as error:
        return Planned(number, inputs, None, str(error))


def _changed(case: SolvedCase, inputs: Mapping[str, Any]) -> SolvedCase:
    """Changed copy of a case, quick if only an operating point changes."""
    if isinstance(case, GearCase):
        return changed_pair(case, inputs)
    return changed_axle(case, inputs) if isinstance(case, AxleCase) else case.replace(inputs)


@dataclass(frozen=True)
class Lacking:
    """Point of a sweep that cannot be computed."""

    point: Planned
    reason: str  # key that it lacks, and why, as one line

    def __str__(self) -> str:
        return f"point {self.point.number}, the slowest and hottest, cannot be computed: {self.reason}"


def lacking_point(sweep: Sweep, planned: Sequence[Planned]) -> Lacking | None:
    """Slowest and, of these, hottest point of a sweep of drives, if it cannot be computed.

    Its films are the thinnest, so that asperities may close them as at no other point. The bearings
    of the point are solved with films of the atlas or from formulas, in about a second.

    Returns point and reason; None where it can be computed, and for sweeps of contacts and bearings, whose
    results do not need the resistance of closed contacts.
    """
    valid = [point for point in planned if point.key is not None]
    if not isinstance(sweep.case, DriveCase) or not valid:
        return None
    # Other sweeps do not need a drive.
    from ehlectric.drive import prepare

    point = min(valid, key=_films)
    case: Any = sweep.case.replace(point.inputs)
    try:
        quick, _ = quick_drive(case)
        if quick is not None:
            prepare(quick, workers=1)
    except InputError as error:
        return Lacking(point, str(error))
    return None


def _films(point: Planned) -> tuple[float, float]:
    """Order of points by their films: speed and negative temperature, the thinnest films first."""
    values = {end_and_replaced(key)[1]: value for key, value in point.inputs.items()}
    return float(values.get(SPEED, 0.0)), -float(values.get(TEMPERATURE, 0.0))


Task = tuple[str, PointCase]


def solve_point(table: PointCase, uncertainty_samples: int | None = None) -> Outcome:
    """Solve a case given as data, in any process. Returns outcome of the point; no exception is raised:
    an error becomes the reason of a failed point. ``uncertainty_samples``, samples of the probability of
    breakdown of a bearing, which is not computed without them.
    """
    started = time.perf_counter()
    status, reason, again, summary = _attempt(table, uncertainty_samples)
    # Messages of libraries may have several lines; the reason is a single one.
    reason = " ".join(reason.split())[:1000]
    return Outcome(status, reason, again, summary, time.perf_counter() - started, __version__, now())


def _attempt(table: PointCase, samples: int | None) -> tuple[Status, str, bool, dict[str, Any] | None]:
    """Status and reason of a case, whether another try may succeed, and its summary."""
    try:
        solved, summary, reason = _solved(table, samples)
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


def _solved(table: PointCase, samples: int | None) -> tuple[bool, dict[str, Any], str]:
    """Whether a case converged, its summary, and the reason if it did not."""
    case = table if isinstance(table, Case) else solved_case_of_dict(table)
    kind = Case if isinstance(case, Case) else type(case)
    return _SOLVERS[kind](case, samples)


def _solve_contact(case: Case, _: int | None) -> tuple[bool, dict[str, Any], str]:
    result = solve(case)
    # This warning says what residual was reached and what to try.
    reasons = (warning.text for warning in result.warnings if warning.code == "not-converged")
    return result.converged, result.summary(), next(reasons, result.film.status)


def _solve_bearing(case: BearingCase, samples: int | None) -> tuple[bool, dict[str, Any], str]:
    bearing = solve_bearing(case, workers=1)
    # Without the analysis of the margin, which would solve twenty bearings for every point.
    summary = summary_of(bearing.solution)
    del summary["contacts"]  # with columns for every contact, the table would be too wide
    if samples is not None:
        spread = spread_alone(bearing.solution, samples, SEED)
        warnings = (*bearing.warnings, *warnings_of_spread(spread))
        summary |= texts_and_codes(warnings) | tables_of_spread(spread)
    return bearing.converged, summary, "a contact of the bearing is not converged"


def _solve_drive(case: DriveCase, _: int | None) -> tuple[bool, dict[str, Any], str]:
    # Imported here because it loads the compiler of the simulation, which other sweeps do not need.
    from ehlectric.drive import solve_drive

    drive = solve_drive(case, workers=1)
    summary = drive.summary()
    del summary["remedies"]  # a point has none
    return drive.converged, summary, "a contact of a bearing is not converged"


def _solve_gear_pair(case: GearCase, _: int | None) -> tuple[bool, dict[str, Any], str]:
    return True, solve_gear(case, probable=False).summary(), ""


def _solve_axle(case: AxleCase, _: int | None) -> tuple[bool, dict[str, Any], str]:
    axle = solve_axle(case, remedies=False, probable=False)
    return axle.converged, axle.point_summary(), "a contact of a bearing is not converged"


# Solution of a case of each kind, and of bearings with samples for the probability of breakdown: whether it
# converged, its summary, and the reason if it did not.
_SOLVERS: Mapping[type, Callable[[Any, int | None], tuple[bool, dict[str, Any], str]]] = MappingProxyType(
    {
        Case: _solve_contact,
        BearingCase: _solve_bearing,
        DriveCase: _solve_drive,
        GearCase: _solve_gear_pair,
        AxleCase: _solve_axle,
    }
)


def run_points(
    tasks: Iterable[Task],
    crew: Crew,
    done: Callable[[Sequence[tuple[str, Outcome]]], None],
    uncertainty_samples: int | None = None,
) -> None:
    """Solve points with a crew, as many at a time as it can take, with their probability of breakdown where
    it is asked for. Raises LostError if the crew cannot be reached any more.
    """
    solve = (
        solve_point
        if uncertainty_samples is None
        else partial(solve_point, uncertainty_samples=uncertainty_samples)
    )
    with closing(finished_tasks(tasks, crew, solve, _lost, _ran_out)) as batches:
        for outcomes in batches:
            done(outcomes)


def _lost(reason: str) -> Outcome:
    """Outcome of a point that was not solved because its process died; another try may succeed."""
    return Outcome("failed", reason, again=True, date=now())


def _ran_out(outcome: Outcome) -> bool:
    """Whether a point had too little memory; without other points it may have more."""
    return outcome.status == "failed" and outcome.again


# Time limit for the answer of an address, and for the reconnection to a lost scheduler [s].
ANSWER = 8.0

# Smallest number of points in flight. A cluster that adapts its workers to the queued work needs some points
# to start.
_LEAST = 64

# Interval between two requests for the number of workers [s].
_REFRESH = 2.0
_LOGGERS = ("distributed", "tornado", "asyncio")


@contextmanager
def cluster(address: str) -> Iterator[Crew]:
    """Context manager that connects to a Dask scheduler and yields a crew of its workers.

    Workers that join the cluster later are also used.

    Raises InputError if no scheduler answers at the address, or dask.distributed is not installed.

    Log messages of Dask in this process are switched off: an error of one line reports a lost scheduler.
    """
    try:
        from distributed import Client
    except ImportError:
        raise InputError(
            "scheduler", "needs the package distributed; install it with: pip install 'ehlectric[cluster]'"
        ) from None
    _silence()
    with local_filters():
        # Dask warns if versions differ. If the difference breaks something, an error follows.
        warnings.simplefilter("ignore")
        try:
            asyncio.run(asyncio.wait_for(_ask(address), ANSWER))
            client = Client(address, timeout=ANSWER, set_as_default=False)
        except Exception as error:  # from the address, the socket, TLS or another kind of server
            reason = " ".join(str(error).split())[:200] or f"none in {ANSWER:g} s"
            raise InputError("scheduler", got=f"no answer from {shown(address)}, {reason}") from None
    try:
        with client.get_executor(pure=False) as executor:
            yield _crew(client, executor)
    finally:
        with suppress(Exception):
            client.close(timeout=1.0)


async def _ask(address: str) -> None:
    """Check that a scheduler answers: a client would wait for a server that listens but never answers."""
    from distributed import Security
    from distributed.core import rpc

    async with rpc(address, connection_args=Security().get_connection_args("client")) as there:
        kind = (await there.identity())["type"]
    if kind != "Scheduler":
        raise ValueError(f"it is a {kind.lower()}")


def _crew(client: Any, executor: Executor) -> Crew:
    """Crew of the workers of a connected client."""
    threads, counted_at = 0, -math.inf

    def width() -> int:
        """Number of points that the present workers may have in flight.

        The number of workers is requested at intervals only, because each request costs the scheduler time.
        """
        nonlocal threads, counted_at
        if client.status != "running":
            raise LostError("the connection is lost")
        if time.monotonic() - counted_at > _REFRESH:
            try:
                threads, counted_at = sum(client.nthreads().values()), time.monotonic()
            except Exception as error:  # from the connection
                raise LostError(" ".join(str(error).split())) from None
        return max(_LEAST, 3 * threads)

    return Crew(packed_submit(executor), width, waiting=lambda: "" if threads else "no workers yet")


def _silence() -> None:
    """Switch off the loggers of Dask: existing ones and, through their parents, loggers created later."""
    for name in (*_LOGGERS, *logging.root.manager.loggerDict):
        if name.partition(".")[0] in _LOGGERS:
            logging.getLogger(name).setLevel(logging.CRITICAL + 1)
