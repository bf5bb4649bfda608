"""Solution of a prepared bearing: its contacts over their load, and all elements at positions of the cage."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from typing import Any

from ehlectric.bearing.contacts import ContactCurve
from ehlectric.bearing.kinds import kind_of
from ehlectric.bearing.loads.totals import Equilibrium
from ehlectric.bearing.preparation import PreparedBearing, loads_to_solve, prepare_bearing
from ehlectric.bearing.quick.dry import quick_solutions
from ehlectric.bearing.quick.ways import is_quick
from ehlectric.bearing.ring_contacts import RingContacts
from ehlectric.bearing.solution import BearingSolution, Position, ring_state
from ehlectric.cases.bearings.case import BearingCase
from ehlectric.runtime.parallel.tasks import run_all
from ehlectric.runtime.parallel.workers import cores
from ehlectric.runtime.progress import Progress, silent

# Number of positions of the cage over one pitch of the elements.
POSITIONS = 8


def solution_of(
    case: BearingCase,
    *,
    positions: int = POSITIONS,
    progress: Progress | None = None,
    workers: int | None = None,
) -> BearingSolution:
    """Solve a whole rolling bearing: loads, films, fields and the electrical circuit.

    Parameters
    ----------
    case : BearingCase
        Bearing file.
    positions : int
        Number of positions of the cage over one pitch of the elements.
    progress : callable, optional
        Called with the number of solved contacts, the number of all contacts, and a text.
    workers : int, optional
        Number of processes; the number of cores if not given.

    Returns
    -------
    BearingSolution
        Solution from which results, warnings and summaries are made.

    Raises
    ------
    InputError
        Where the bearing cannot carry its load, or a contact cannot be solved.
    LostError
        Where the process of a contact was killed four times, as by a system out of memory.
    """
    started = time.perf_counter()
    prepared = prepare_bearing(case, positions)
    solution = solution_of_prepared(case, prepared, progress=progress, workers=workers)
    # Films whose heat is solved take seconds before the first contact.
    return replace(solution, seconds=time.perf_counter() - started)


def solution_of_prepared(
    case: BearingCase,
    prepared: PreparedBearing,
    *,
    progress: Progress | None = None,
    workers: int | None = None,
) -> BearingSolution:
    """Solve the contacts of a prepared bearing, and join them to its circuit.

    Parameters
    ----------
    case : BearingCase
        Bearing file; its ``contacts`` says how they are solved.
    prepared : PreparedBearing
        Conditions, equilibria and contacts of the case.
    progress, workers : optional
        As for ``solution_of``.

    Returns
    -------
    BearingSolution
        Solution at the positions of the prepared bearing.

    Raises
    ------
    InputError, LostError
        As ``solution_of`` raises them.
    """
    started = time.perf_counter()
    tasks = [_tasks(case, prepared, ring) for ring in prepared.rings]
    processes = 1 if is_quick(case) else workers or cores()
    found = _solved([*tasks[0], *tasks[1]], progress or silent, processes)
    rings = found[: len(tasks[0])], found[len(tasks[0]) :]
    if is_quick(case):
        rings = quick_solutions(rings[0]), quick_solutions(rings[1])
    curves = ContactCurve(tuple(rings[0])), ContactCurve(tuple(rings[1]))
    return BearingSolution(
        case=case,
        conditions=prepared.conditions,
        inner=prepared.inner,
        outer=prepared.outer,
        inner_curve=curves[0],
        outer_curve=curves[1],
        positions=tuple(_position(prepared, curves, at) for at in prepared.equilibria),
        seconds=time.perf_counter() - started,
    )


def _tasks(case: BearingCase, prepared: PreparedBearing, ring: RingContacts[Any]) -> list[Callable[[], Any]]:
    """Functions that solve the contacts with one ring, or compute them quickly, by increasing load."""
    kind = kind_of(ring)
    quick = is_quick(case)
    contacts = [kind.contact(ring, load) for load in loads_to_solve(prepared, ring, quick=quick)]
    if quick:
        return [partial(kind.quick[case.contacts], contact) for contact in contacts]
    return [partial(kind.solve, contact, case.solver) for contact in contacts]


def _position(
    prepared: PreparedBearing, curves: tuple[ContactCurve, ContactCurve], at: Equilibrium
) -> Position:
    """Contacts of all elements at an equilibrium."""
    weibull = prepared.conditions.discharge.weibull
    inner, outer = (
        ring_state(ring, curve, load=loads.load, gap=loads.gap)
        for ring, curve in zip(prepared.rings, curves, strict=True)
        for loads in (at.ring(inner=ring.inner),)
    )
    return Position(at, inner, outer, None if weibull is None else weibull.shape)


def _solved(tasks: Sequence[Callable[[], Any]], progress: Progress, workers: int) -> list[Any]:
    """Contacts in the order of their tasks; the heaviest, which take longest, are solved first."""
    solutions: dict[int, Any] = {}

    def done(number: int, solution: Any) -> None:
        solutions[len(tasks) - 1 - number] = solution
        progress(len(solutions), len(tasks), f"contact with {solution.load:.4g} N")

    progress(0, len(tasks), "contacts")
    if workers == 1 or len(tasks) == 1:
        for number, task in enumerate(reversed(tasks)):
            done(number, task())
    else:
        run_all(list(reversed(tasks)), done, limit=workers, what="contact")
    return [solutions[k] for k in range(len(tasks))]
