"""solve_bearing(case): loads, films, fields and the circuit of a whole rolling bearing."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from ehlectric.bearing.by_formula import check_formula, formula_contact
from ehlectric.bearing.circuit import Circuit
from ehlectric.bearing.conditions import BearingDuty
from ehlectric.bearing.contacts import ContactCurve, ContactSolution, contact_case, solve_contact
from ehlectric.bearing.domain import least_load
from ehlectric.bearing.limits import Equilibrium, check_film, check_load, check_shoulders
from ehlectric.bearing.loads.balls import BallEquilibrium
from ehlectric.bearing.ring_contacts import Race, of_contact
from ehlectric.bearing.state import RaceState, race_state
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.contact.check import check_case
from ehlectric.runtime.workers import cores, run_all

# Loads of each ring that are solved, but for those of light elements, and the least of them over the largest.
LOADS, _LEAST = 6, 0.02

# The least load over the largest: below it films hardly change any more what a bearing's circuit sees.
_LIGHTEST = 0.002

# Loads between that one and the six: about one for each of these ratios, up to six. They crowd at the light
# end, where the film of rigid bodies, which goes with 1/Q, turns into that of bodies that deform: a power of
# their number, since halving the distance there is worth more than elsewhere.
_BETWEEN, _MOST_BETWEEN, _CROWDED = 1.5, 6, 1.5

# Loads closer than this ratio are one.
_ALIKE = 1.001

# Positions of the cage over one pitch of the elements.
POSITIONS = 8
Progress = Callable[[int, int, str], None]


@dataclass(frozen=True)
class Position:
    """A bearing at one position of its cage; ``shape`` is that of a Weibull strength."""

    equilibrium: Equilibrium
    inner: RaceState
    outer: RaceState
    shape: float | None = None

    def circuit(self, fill: str) -> Circuit:
        """Its circuit, with oil or air around the films."""
        return Circuit(
            self.inner.capacitance(fill),
            self.outer.capacitance(fill),
            self.inner.breakdown_voltage,
            self.outer.breakdown_voltage,
            self.shape,
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
        Six loads of either ring are solved, those of light elements besides, and interpolated in between.

    Raises
    ------
    InputError
        Where the bearing cannot carry its load, or a contact cannot be solved.
    """
    started = time.perf_counter()
    by_formula, discharge = case.contacts == "formula", case.discharge.at(case.bearing.temperature)
    duty, equilibria, races = _prepared(case, POSITIONS)
    loads = [_loads(equilibria, least_load(duty, race), inner=race.inner) for race in races]
    given = case.bearing, duty
    tasks = [
        partial(formula_contact, *given, race, load, discharge=discharge)
        if by_formula
        else partial(
            solve_contact,
            *given,
            race,
            load,
            discharge=discharge,
            solver=case.solver.model_dump(),
        )
        for race, those in zip(races, loads, strict=True)
        for load in those
    ]
    processes = 1 if by_formula else workers or cores()
    found = _solved(tasks, progress or (lambda _done, _of, _text: None), processes)
    first = len(loads[0])
    curves = ContactCurve(tuple(found[:first])), ContactCurve(tuple(found[first:]))

    def state(race: Race, curve: ContactCurve, at: Equilibrium) -> RaceState:
        load = at.inner_load if race.inner else at.outer_load
        gap = at.inner_gap if race.inner else at.outer_gap
        return race_state(case.bearing, duty, race, curve, discharge=discharge, load=load, gap=gap)

    shape = None if discharge.weibull is None else discharge.weibull.shape
    positions = tuple(
        Position(at, state(races[0], curves[0], at), state(races[1], curves[1], at), shape)
        for at in equilibria
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
    duty, equilibria, races = _prepared(case, 1)
    discharge = case.discharge.at(case.bearing.temperature)
    for race in races:
        load = float(np.max(equilibria[0].inner_load if race.inner else equilibria[0].outer_load))
        with of_contact(race, load):
            check_case(contact_case(duty, race, load, discharge, case.solver.model_dump()))


def _prepared(case: BearingCase, positions: int) -> tuple[BearingDuty, Sequence[Equilibrium], list[Race]]:
    """The duty of a case, its equilibria, and the contacts with either ring, where they can be found."""
    bearing, duty = case.bearing, BearingDuty.of(case)
    if case.contacts == "formula":
        check_formula(case.discharge.at(bearing.temperature), duty.lubricant)
    check_load(bearing, duty)
    equilibria = duty.equilibria(bearing, positions)
    for at in equilibria:
        check_shoulders(bearing, at)
    races = [_race(duty, equilibria, inner=inner) for inner in (True, False)]
    for race in races:
        check_film(
            duty, race, float(np.max(equilibria[0].inner_load if race.inner else equilibria[0].outer_load))
        )
    return duty, equilibria, races


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
    """Loads to solve [N]: evenly in their logarithm, and below them from one not below ``lightest`` on."""
    all_loads = np.concatenate([at.inner_load if inner else at.outer_load for at in equilibria])
    largest = float(np.max(all_loads))
    least = float(np.min(all_loads[all_loads >= _LEAST * largest]))
    loads = np.geomspace(least, largest, LOADS) if largest / least > _ALIKE else np.array([largest])
    # Elements that their centrifugal force alone presses outward have a film of their own.
    light = all_loads[(all_loads > 0.0) & (all_loads < _LEAST * largest)]
    own = max(float(np.min(light)), _LIGHTEST * largest, lightest) if light.size else math.inf
    return [*_lighter(own, float(loads[0])), *(float(load) for load in loads)]


def _lighter(own: float, least: float) -> list[float]:
    """Loads [N] from that of light elements up to the least of the others; none where they are close."""
    if own >= 0.5 * least:
        return []
    ratio = math.log(least / own)
    number = 1 + min(_MOST_BETWEEN, int(ratio / math.log(_BETWEEN)))
    return [own * math.exp(ratio * (k / number) ** _CROWDED) for k in range(number)]


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
