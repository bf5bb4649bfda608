"""solve_bearing(case): loads, films, fields and the circuit of a whole rolling bearing."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from ehlectric.ball_equilibrium import BallEquilibrium
from ehlectric.bearing_case import BearingCase
from ehlectric.bearing_circuit import Circuit
from ehlectric.bearing_contacts import ContactCurve, ContactSolution, contact_case, solve_contact
from ehlectric.bearing_domain import least_load
from ehlectric.bearing_duty import BearingDuty
from ehlectric.bearing_formula import check_formula, formula_contact
from ehlectric.bearing_race import Race, of_contact
from ehlectric.bearing_state import RaceState, race_state
from ehlectric.meaning import check_case
from ehlectric.roller_equilibrium import RollerEquilibrium
from ehlectric.workers import cores, run_all

# Loads of each ring that are solved, and the least of them over the largest.
LOADS, _LEAST = 6, 0.02

# The least load over the largest: below it films hardly change any more what a bearing's circuit sees.
_LIGHTEST = 0.002

# Loads closer than this ratio are one.
_ALIKE = 1.001

# Positions of the cage over one pitch of the elements.
POSITIONS = 8

Equilibrium = BallEquilibrium | RollerEquilibrium
Progress = Callable[[int, int, str], None]


@dataclass(frozen=True)
class Position:
    """A bearing at one position of its cage."""

    equilibrium: Equilibrium
    inner: RaceState
    outer: RaceState

    def circuit(self, fill: str) -> Circuit:
        """Its circuit, with oil or air around the films."""
        return Circuit(
            self.inner.capacitance(fill),
            self.outer.capacitance(fill),
            self.inner.breakdown_voltage,
            self.outer.breakdown_voltage,
        )


@dataclass(frozen=True)
class BearingSolution:
    """A bearing over one pitch of its elements.

    Attributes
    ----------
    case, duty : BearingCase and BearingDuty
        What was solved.
    inner, outer : Race
        The contacts with both rings.
    inner_curve, outer_curve : ContactCurve
        Their solutions over the load.
    positions : tuple of Position
        The first has an element on the load line.
    seconds : float
        Time it took [s].
    """

    case: BearingCase
    duty: BearingDuty
    inner: Race
    outer: Race
    inner_curve: ContactCurve
    outer_curve: ContactCurve
    positions: tuple[Position, ...]
    seconds: float


def solve_bearing(
    case: BearingCase,
    *,
    progress: Progress | None = None,
    workers: int | None = None,
) -> BearingSolution:
    """Solve a whole bearing.

    Parameters
    ----------
    case : BearingCase
        What to solve.
    progress : callable, optional
        Called with (contacts done, contacts in all, a text).
    workers : int, optional
        Processes; as many as there are cores if not given.

    Returns
    -------
    BearingSolution
        Six loads of either ring are solved, and interpolated in between.

    Raises
    ------
    InputError
        Where the bearing cannot carry its load, or a contact cannot be solved.
    """
    started = time.perf_counter()
    by_formula, duty = case.contacts == "formula", _duty(case)
    equilibria = duty.equilibria(case.bearing, POSITIONS)
    races = [_race(duty, equilibria, inner=inner) for inner in (True, False)]
    loads = [_loads(equilibria, least_load(duty, race), inner=race.inner) for race in races]
    given = case.bearing, duty
    tasks = [
        partial(formula_contact, *given, race, load, discharge=case.discharge)
        if by_formula
        else partial(
            solve_contact,
            *given,
            race,
            load,
            discharge=case.discharge,
            solver=case.solver.model_dump(),
        )
        for race, those in zip(races, loads, strict=True)
        for load in those
    ]
    processes = 1 if by_formula else workers or cores()
    found = _solved(tasks, progress or (lambda _done, _of, _text: None), processes)
    first = len(loads[0])
    curves = _curve(found[:first]), _curve(found[first:])

    def state(race: Race, curve: ContactCurve, at: Equilibrium) -> RaceState:
        load = at.inner_load if race.inner else at.outer_load
        gap = at.inner_gap if race.inner else at.outer_gap
        return race_state(case.bearing, duty, race, curve, discharge=case.discharge, load=load, gap=gap)

    positions = tuple(
        Position(at, state(races[0], curves[0], at), state(races[1], curves[1], at)) for at in equilibria
    )
    return BearingSolution(
        case=case,
        duty=duty,
        inner=races[0],
        outer=races[1],
        inner_curve=curves[0],
        outer_curve=curves[1],
        positions=positions,
        seconds=time.perf_counter() - started,
    )


def check_bearing(case: BearingCase) -> None:
    """Refuse, before a folder is made for its results, a bearing that cannot be solved.

    Raises
    ------
    InputError
        As ``solve_bearing`` does, of the cage's first position.
    """
    duty = _duty(case)
    equilibria = duty.equilibria(case.bearing, 1)
    for inner in (True, False):
        load = float(np.max(equilibria[0].inner_load if inner else equilibria[0].outer_load))
        race = _race(duty, equilibria, inner=inner)
        with of_contact(race, load):
            check_case(contact_case(duty, race, load, case.discharge, case.solver.model_dump()))


def _duty(case: BearingCase) -> BearingDuty:
    """The duty of a case, which its contacts can be found for."""
    duty = BearingDuty.of(case)
    if case.contacts == "formula":
        check_formula(case.discharge, duty.lubricant)
    return duty


def _race(duty: BearingDuty, equilibria: Sequence[Equilibrium], *, inner: bool) -> Race:
    """The contacts with one ring, their radii at the contact angle of the most loaded one."""
    at = equilibria[0]
    most = int(np.argmax(at.inner_load))
    angle = 0.0
    if isinstance(at, BallEquilibrium):
        angle = float((at.inner_angle if inner else at.outer_angle)[most])
    entrainment = at.speeds.inner_entrainment if inner else at.speeds.outer_entrainment
    speed = float(np.broadcast_to(entrainment, at.inner_load.shape)[most])
    return Race(inner, angle, speed * duty.entrainment_factor)


def _loads(equilibria: Sequence[Equilibrium], lightest: float, *, inner: bool) -> list[float]:
    """Loads to solve [N], evenly in their logarithm, and one below them that is not below ``lightest``."""
    all_loads = np.concatenate([at.inner_load if inner else at.outer_load for at in equilibria])
    largest = float(np.max(all_loads))
    least = float(np.min(all_loads[all_loads >= _LEAST * largest]))
    loads = np.geomspace(least, largest, LOADS) if largest / least > _ALIKE else np.array([largest])
    # Elements that their centrifugal force alone presses outward have a film of their own.
    light = all_loads[(all_loads > 0.0) & (all_loads < _LEAST * largest)]
    own = max(float(np.min(light)), _LIGHTEST * largest, lightest) if light.size else math.inf
    apart = own < 0.5 * float(loads[0])
    return [*([own] if apart else []), *(float(load) for load in loads)]


def _curve(solutions: Sequence[ContactSolution]) -> ContactCurve:
    light = len(solutions) > 1 and solutions[0].load < _LEAST * solutions[-1].load
    return ContactCurve(tuple(solutions), light)


def _solved(
    tasks: Sequence[Callable[[], ContactSolution]], progress: Progress, workers: int
) -> list[ContactSolution]:
    """Contacts in the order of their tasks; the heaviest, which take longest, begin."""
    found: dict[int, ContactSolution] = {}

    def done(number: int, solution: ContactSolution) -> None:
        found[len(tasks) - 1 - number] = solution
        progress(len(found), len(tasks), f"contact with {solution.load:.4g} N")

    progress(0, len(tasks), "contacts")
    if workers == 1 or len(tasks) == 1:
        for number, task in enumerate(reversed(tasks)):
            done(number, task())
    else:
        run_all(list(reversed(tasks)), done, processes=workers)
    return [found[k] for k in range(len(tasks))]
