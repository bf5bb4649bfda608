"""Solution of a prepared bearing: its contacts over their load, all elements, and kept quick solutions."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from functools import lru_cache, partial
from typing import Any, Literal

import numpy as np

from ehlectric.arrays import Array
from ehlectric.bearing.bearing_kinds import kind_of
from ehlectric.bearing.loads.totals import Equilibrium, mirrored_order
from ehlectric.bearing.physical_bounds import check_bounds
from ehlectric.bearing.preparation import PreparedBearing, loads_to_solve, prepare_bearing
from ehlectric.bearing.quick_contacts import QUICK_METHODS, is_quick, quick_curve
from ehlectric.bearing.ring_contacts import ContactCurve, ContactValues, RingContacts, solve
from ehlectric.bearing.solution import BearingSolution, Position, RingState, ring_state
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.cases.table_edits import flattened
from ehlectric.readable import readable
from ehlectric.runtime.progress import Progress, silent
from ehlectric.runtime.tasks import run_all
from ehlectric.runtime.worker_processes import cores

# Detail of estimated contacts: whole, or with fewer loads where only ratios of results are used ("coarse"),
# or with these and without the capacitance around the films ("films").
Detail = Literal["whole", "coarse", "films"]

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

    ``workers`` is the number of processes, by default the number of cores. Raises InputError where the
    bearing cannot carry its load, or a contact cannot be solved; LostError where the process of a contact was
    killed four times, as by a system out of memory.
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
    detail: Detail = "whole",
) -> BearingSolution:
    """Solve the contacts of a prepared bearing, and join them to its circuit.

    ``detail`` is the detail of estimated contacts. Raises the errors of ``solution_of``, and for a single
    bearing the errors of ``check_bounds``.
    """
    started = time.perf_counter()
    if is_quick(case):
        curves = _quick_curves(case, prepared, progress or silent, detail)
    else:
        curves = _solved_curves(case, prepared, progress or silent, workers or cores())
    solution = BearingSolution(
        case=case,
        conditions=prepared.conditions,
        inner=prepared.rings[0],
        outer=prepared.rings[1],
        inner_curve=curves[0],
        outer_curve=curves[1],
        positions=_positions(prepared, curves),
        seconds=time.perf_counter() - started,
    )
    if not case.shape:
        check_bounds(solution)
    return solution


def _quick_curves(
    case: BearingCase, prepared: PreparedBearing, progress: Progress, detail: Detail
) -> tuple[ContactCurve, ContactCurve]:
    """Curves of the contacts with both rings, from the atlas or from formulas."""
    progress(0, len(prepared.rings), "contacts")

    def curve(number: int, ring: RingContacts[Any]) -> ContactCurve:
        loads, used = loads_to_solve(prepared, ring, quick=True, coarse=detail != "whole")
        contact = replace(kind_of(ring).contact(ring, np.moveaxis(loads, -1, 0)), coarse=detail != "whole")
        quick = QUICK_METHODS[case.contacts](contact)
        progress(number, len(prepared.rings), f"contacts with the {ring.name} ring")
        unknown = np.full(quick.inside.shape, np.nan)
        return quick_curve(quick, used, (unknown, unknown) if detail == "films" else None)

    # The outer ring comes first, so that its contacts are refused before the contacts of the inner ring.
    outer = curve(1, prepared.rings[1])
    return curve(2, prepared.rings[0]), outer


def _solved_curves(
    case: BearingCase, prepared: PreparedBearing, progress: Progress, workers: int
) -> tuple[ContactCurve, ContactCurve]:
    """Curves of the contacts with both rings, from solved films and fields."""
    tasks = [_tasks(case, prepared, ring) for ring in prepared.rings]
    solved = _solved([*tasks[0], *tasks[1]], progress, workers)
    return ContactCurve.of(solved[: len(tasks[0])]), ContactCurve.of(solved[len(tasks[0]) :])


def _tasks(case: BearingCase, prepared: PreparedBearing, ring: RingContacts[Any]) -> list[Callable[[], Any]]:
    """Functions that solve the contacts with one ring, by increasing load."""
    loads, _ = loads_to_solve(prepared, ring, quick=False)
    return [partial(solve, kind_of(ring).contact(ring, load), solver=case.solver) for load in loads.tolist()]


def _positions(prepared: PreparedBearing, curves: tuple[ContactCurve, ContactCurve]) -> tuple[Position, ...]:
    """Contacts of all elements at each equilibrium."""
    weibull = prepared.conditions.discharge.weibull
    inner, outer = (
        _states(prepared.equilibria, ring, curve) for ring, curve in zip(prepared.rings, curves, strict=True)
    )
    shape = None if weibull is None else weibull.shape
    tracks = prepared.conditions.geometry.tracks
    positions = zip(prepared.equilibria, inner, outer, strict=True)
    return tuple(Position(*position, shape, tracks) for position in positions)


def _states(
    equilibria: Sequence[Equilibrium], ring: RingContacts[Any], curve: ContactCurve
) -> Iterator[RingState]:
    """Contacts of all elements with a ring at each equilibrium, computed together.

    The second half of the equilibria mirrors the first, and has equal contacts.
    """
    loads = [at.ring(inner=ring.inner) for at in equilibria]
    geometry, number = ring.conditions.geometry, len(equilibria) // 2 + 1
    load, gap = (
        np.concatenate([getattr(at, name) for at in loads[:number]], axis=-1) for name in ("load", "gap")
    )
    rooms = [_room(at, geometry.tracks, inner=ring.inner) for at in equilibria[:number]]
    whole = ring_state(ring, curve, load=load, gap=gap, room=np.concatenate(rooms, axis=-1))
    columns = [np.split(column, number, axis=-1) for column in (whole.solved, *whole.values.columns())]
    order = mirrored_order(loads[0].load.shape[-1], geometry.groups)
    for k, at in enumerate(loads):
        if k < number:
            solved, *values = (column[k] for column in columns)
        else:
            solved, *values = (column[len(loads) - k][..., order] for column in columns)
        yield RingState(at.load, at.gap, solved, ContactValues(*values))


# Load of an element at the inner ring over the largest one, from which on another track holds the element.
_HELD = 1e-3


def _room(at: Equilibrium, tracks: int, *, inner: bool) -> Array:
    """Room for the films of elements at a ring [m], shape (..., n).

    A free element has the room of its gaps with both rings. If an element with several tracks is pressed in
    one of them, it cannot move, and has the own gap in the others.
    """
    gap, opposite = at.ring(inner=inner).gap, at.ring(inner=not inner).gap
    if tracks == 1:
        return gap + opposite
    load = at.inner_load.reshape(*at.inner_load.shape[:-1], tracks, -1)
    held = np.concatenate([np.sum(load, axis=-2)] * tracks, axis=-1)
    return np.asarray(gap + opposite / (1.0 + held / (_HELD * np.max(load, axis=(-2, -1))[..., np.newaxis])))


def _solved(tasks: Sequence[Callable[[], Any]], progress: Progress, workers: int) -> list[Any]:
    """Contacts in the order of their tasks; the heaviest, which take longest, are solved first."""
    solutions: dict[int, Any] = {}

    def done(number: int, solution: Any) -> None:
        solutions[len(tasks) - 1 - number] = solution
        progress(len(solutions), len(tasks), f"contact with {readable(solution.load, 4)} N")

    progress(0, len(tasks), "contacts")
    if workers == 1 or len(tasks) == 1:
        for number, task in enumerate(reversed(tasks)):
            done(number, task())
    else:
        run_all(list(reversed(tasks)), done, limit=workers, what="contact")
    return [solutions[k] for k in range(len(tasks))]


# Tables and keys on which neither films nor breakdown voltages of smooth contacts depend.
NOT_IN_FILMS = (
    "motor.",
    "discharge.conductivity",
    "bearing.composite_rq",
    "bearing.summit_height",
    "bearing.summits",
    "bearing.contact_resistance",
    "bearing.fill",
    "bearing.parallel_capacitance",
    "bearing.coating",
)

# Tables and keys that no solution uses.
UNUSED = ("title", "ranges")

# Solutions that are kept, for the analyses of some bearings. Each takes about 0.1 MB.
_KEPT = 30


@dataclass(frozen=True)
class CaseKey:
    """Case that is found again by all of its values that have an effect."""

    text: str
    case: BearingCase = field(compare=False)


def key_of(case: BearingCase, *, without_effect: tuple[str, ...]) -> CaseKey:
    """Key of a case, in which the keys that begin with one of ``without_effect`` do not matter."""
    inputs = flattened(case.to_dict())
    text = repr({key: value for key, value in inputs.items() if not key.startswith(without_effect)})
    return CaseKey(text, case)


def quick_solution(case: BearingCase) -> BearingSolution:
    """Solution of a bearing with estimated contacts, which have few loads, computed once for cases with equal
    films. Raises the errors of ``solution_of``.
    """
    return replace(_once(key_of(case, without_effect=(*NOT_IN_FILMS, *UNUSED))), case=case)


@lru_cache(maxsize=_KEPT)
def _once(key: CaseKey) -> BearingSolution:
    """Solution of the case of a key."""
    prepared = prepare_bearing(key.case, POSITIONS)
    return solution_of_prepared(key.case, prepared, detail="coarse")
