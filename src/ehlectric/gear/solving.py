"""Solution of one gear pair or of many: films are interpolated in tables that all pairs fill together."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import islice

import numpy as np

from ehlectric.arrays import Array
from ehlectric.cases.case_oil import Lubricant
from ehlectric.cases.gear_case import GearCase, changed_pair
from ehlectric.errors import ConvergenceError, InputError
from ehlectric.film import Groups
from ehlectric.gear.contact_path import POINTS
from ehlectric.gear.film_table import LOAD_RANGE, FilmTable, film_tables
from ehlectric.gear.flank_films import FlankFilms, Flanks, PlacedContacts, contacts_of, flank_films
from ehlectric.gear.flank_oil import by_lubricant, check_oils, flank_oils
from ehlectric.gear.load_sharing import SIDES, LineLoads, OpenPieces, loads_at_points
from ehlectric.gear.mesh_capacitance import capacitance_per_length, open_capacitance
from ehlectric.gear.solution import GearSolution, OperatingPair
from ehlectric.quantities.formats import amount

# Result of a pair, or why it has none.
Outcome = GearSolution | InputError | ConvergenceError

# Distance of a place next to B or D from it [m].
_JUMP = 1e-8

# Part of the path of contact on both sides of C over which the friction of a film reverses.
_REVERSAL = 0.05

# Pairs that are solved together: few enough for the memory, many enough for the time of a call.
_TOGETHER = 256


@dataclass(frozen=True)
class _LoadedPair:
    """Gear pair with its loads, before its films are known."""

    number: int  # place in the list of cases that are solved together
    case: GearCase
    at: OperatingPair
    loads: LineLoads
    at_points: Array  # line loads at A to E [N/m], shape (5,)
    opened: OpenPieces  # pieces of the lines at which the flanks do not touch

    @property
    def contacts(self) -> tuple[Array, Array]:
        """Places g [m] and line loads [N/m]: all nodes, then A to E; if flanks are open in part, then the
        pitch point under the lightest load.
        """
        path, loads = self.at.plane.path, self.loads
        places, load = [*path.points.values()], [*self.at_points.tolist()]
        if self.opened.length.size:
            places.append(path.pitch_point)
            load.append(float(np.max(loads.load)) / LOAD_RANGE)
        return np.append(loads.places, places), np.append(loads.load, load)


def solve_gear_pair(case: GearCase) -> GearSolution:
    """Mesh of a gear pair at its operating point. Raises InputError for drawings that cannot run, and for an
    oil without a value at the temperature of the flanks; ConvergenceError if a solved film does not converge.
    """
    (outcome,) = solve_gear_pairs([case])
    if isinstance(outcome, GearSolution):
        return outcome
    raise outcome


class FilledError(InputError):
    """Error of a mesh whose films would fill more than half of the backlash."""

    least: float = math.nan  # torque of gear 1 at which they fill half of it [N m]


# Times that the torque of a mesh is raised until its films fill half of the backlash, and how far beyond.
_RAISED, _BEYOND = 4, 1.0 + 1e-6


def solve_loose_pairs(cases: Sequence[GearCase], *, unloaded: bool = True) -> list[Outcome]:
    """Meshes of many gear pairs as ``solve_gear_pairs`` solves them, also almost without a torque.

    If the films of a mesh would fill more than half of the backlash, the oil on both sides of the teeth keeps
    them in its middle. Its solution then has the torque at which films fill half of it.
    """
    given, outcomes = [*cases], [*solve_gear_pairs(cases, unloaded=unloaded)]
    for _ in range(_RAISED):
        filled = {place: each for place, each in enumerate(outcomes) if isinstance(each, FilledError)}
        if not filled:
            break
        for place, error in filled.items():
            torque = math.copysign(_BEYOND * error.least, given[place].gear.operation.pinion_torque)
            given[place] = changed_pair(given[place], {"gear.operation.pinion_torque": torque})
        solved = solve_gear_pairs([given[place] for place in filled], unloaded=unloaded)
        for place, outcome in zip(filled, solved, strict=True):
            outcomes[place] = outcome
    return outcomes


def capacitances_over_films(solution: GearSolution, factors: Array) -> Array:
    """Mean capacitances over a phase [F], shape (k,), of a mesh whose films are ``factors`` times as thick,
    shape (k,). The films of the solution are from the atlas or from a formula.
    """
    case = solution.case
    pair = _loaded_pair(0, case, unloaded=False)
    oils = flank_oils(case.lubricant, np.array([pair.at.bulk_temperature]))
    flanks = pair.at.flanks(case, oils.each[0])
    placed = contacts_of(flanks, *pair.contacts)
    (table,) = film_tables(oils.oil, oils.groups, [_ranges(placed.groups)])
    films, shape = flank_films(flanks, placed, table, by_formula=case.contacts == "formula")
    loads, back = pair.loads, solution.back_capacitance
    means = []
    for factor in factors.tolist():
        scaled = replace(films, central=factor * films.central, minimum=factor * films.minimum)
        lines = loads.along(capacitance_per_length(flanks, scaled, shape)[: loads.load.size])
        lightest = float(scaled.central[-1])
        opened = open_capacitance(flanks, pair.opened, lightest, loads.phases.size)
        means.append(loads.mean(lines + opened + back))
    return np.array(means)


def solve_gear_pairs(cases: Iterable[GearCase], *, unloaded: bool = True) -> Iterator[Outcome]:
    """Yield the meshes of many gear pairs, or the errors of those that have none, in the order of the cases.

    ``unloaded``, whether the solutions also contain nodes without a load, as ``solve_gear_pair`` gives them;
    no sum over the lines needs them.
    """
    remaining = iter(cases)
    while part := list(islice(remaining, _TOGETHER)):
        yield from _solved_together(part, unloaded=unloaded)


def _solved_together(cases: Sequence[GearCase], *, unloaded: bool) -> list[Outcome]:
    """Results of some pairs, in the order of the cases."""
    outcomes: dict[int, Outcome] = {}
    pairs: list[_LoadedPair] = []
    for number, case in enumerate(cases):
        try:
            pairs.append(_loaded_pair(number, case, unloaded=unloaded))
        except InputError as error:
            outcomes[number] = error
    for lubricant, places in by_lubricant(pair.case.lubricant for pair in pairs):
        outcomes |= _solved(lubricant, [pairs[place] for place in places])
    return [outcomes[number] for number in range(len(cases))]


def _loaded_pair(number: int, case: GearCase, *, unloaded: bool) -> _LoadedPair:
    """Gear pair of a case with its loads. Raises InputError for drawings that cannot run."""
    at = OperatingPair.of(case)
    sharing = at.sharing(case.gear)
    loads = sharing.loads(unloaded=unloaded)
    return _LoadedPair(number, case, at, loads, loads_at_points(sharing), sharing.opened)


def _solved(lubricant: Lubricant, pairs: Sequence[_LoadedPair]) -> dict[int, Outcome]:
    """Results of pairs with one lubricant, by their numbers."""
    temperatures = np.array([pair.at.bulk_temperature for pair in pairs])
    errors = check_oils(lubricant, temperatures)
    outcomes: dict[int, Outcome] = {
        pair.number: error for pair, error in zip(pairs, errors, strict=True) if error is not None
    }
    pairs = [pair for pair, error in zip(pairs, errors, strict=True) if error is None]
    if not pairs:
        return outcomes
    try:
        oils = flank_oils(lubricant, np.array([pair.at.bulk_temperature for pair in pairs]))
    except InputError as error:
        return outcomes | {pair.number: error for pair in pairs}
    flanks = [pair.at.flanks(pair.case, oil) for pair, oil in zip(pairs, oils.each, strict=True)]
    placed = [contacts_of(each, *pair.contacts) for pair, each in zip(pairs, flanks, strict=True)]
    tables = film_tables(oils.oil, oils.groups, [_ranges(each.groups) for each in placed])
    for pair, each, contacts, table in zip(pairs, flanks, placed, tables, strict=True):
        try:
            solution = _solution(pair, each, contacts, table)
            check_room(solution)
            outcomes[pair.number] = solution
        except (InputError, ConvergenceError) as error:
            outcomes[pair.number] = error
    return outcomes


def check_room(solution: GearSolution) -> None:
    """Refuse a mesh whose smallest film fills half the backlash.

    Oil pushes back from behind the teeth: without a torque, a tooth is in the middle of the backlash. Raises
    InputError.
    """
    torque, film = solution.case.gear.operation.pinion_torque, solution.minimum_film
    if film <= 0.5 * solution.backlash:
        return
    least = 2.0 * abs(torque) * film / solution.backlash
    assumed = " (assumed without gear.normal_backlash)" if solution.pair.normal_backlash is None else ""
    error = FilledError(
        "gear.operation.pinion_torque",
        got=f"{amount(torque, 'N m')}, which gives a film of {amount(film, 'm')} in a normal backlash of "
        f"{amount(solution.backlash, 'm')}{assumed}",
        takes=f"about {amount(least, 'N m')} or more, a lower speed, or a "
        "lower viscosity: below this torque the oil on both sides of the teeth keeps them in the middle of "
        "the backlash, and they may rattle",
    )
    error.least = least
    raise error


def _ranges(groups: Groups) -> tuple[float, float, float, float]:
    """Smallest and greatest M of the loaded contacts of a pair, and smallest and greatest L."""
    load, lubricant = np.asarray(groups.moes_m), np.asarray(groups.moes_l)
    least = np.min(load, where=load > 0.0, initial=math.inf)
    return float(least), float(np.max(load)), float(np.min(lubricant)), float(np.max(lubricant))


def _solution(pair: _LoadedPair, flanks: Flanks, contacts: PlacedContacts, table: FilmTable) -> GearSolution:
    """Films and capacitance of a pair."""
    case, loads, number = pair.case, pair.loads, pair.loads.load.size
    both, shape = flank_films(flanks, contacts, table, by_formula=case.contacts == "formula")
    films, at_points = both.some(slice(number)), both.some(slice(number, number + len(POINTS)))
    lightest = float(both.central[-1])
    capacitance = capacitance_per_length(flanks, both, shape)[:number]
    if case.contacts == "solved":
        films, at_points = _with_solved(pair, flanks, table, films, at_points)
        capacitance = capacitance_per_length(flanks, films, shape.some(slice(number)))
    return GearSolution(
        case=case,
        pair=pair.at.pair,
        plane=pair.at.plane,
        flanks=flanks,
        loads=loads,
        films=films,
        point_films=at_points,
        bulk_temperature=pair.at.bulk_temperature,
        stiffness=pair.at.stiffness,
        capacitance_of_lines=capacitance,
        open_capacitance=open_capacitance(flanks, pair.opened, lightest, loads.phases.size),
    )


def _with_solved(
    pair: _LoadedPair, flanks: Flanks, table: FilmTable, films: FlankFilms, at_points: FlankFilms
) -> tuple[FlankFilms, FlankFilms]:
    """Films corrected by solved films."""
    from ehlectric.gear.solved_points import solved_correction  # late: the atlas needs no solver

    places, load = _to_solve(pair, films)
    loaded = load > 0.0
    atlas, _ = flank_films(flanks, contacts_of(flanks, places[loaded], load[loaded]), table)
    correction = solved_correction(pair.case, flanks, atlas)
    return correction.applied(films), correction.applied(at_points)


def _to_solve(pair: _LoadedPair, films: FlankFilms) -> tuple[Array, Array]:
    """Places and loads at which films are solved: the smallest film, A to E, both sides of C, between which
    the friction reverses, and the other sides of B and D, where the load on a spur pair jumps.
    """
    path, thinnest = pair.at.plane.path, films.thinnest
    points, other = path.points, loads_at_points(pair.at.sharing(pair.case.gear), other=True)
    jumps = [points[name] - SIDES[name] * _JUMP for name in "BD"]
    reversal = [points["C"] + side * _REVERSAL * path.length for side in (-1.0, 1.0)]
    at_pitch_point = pair.at_points[2]
    return (
        np.array([films.places[thinnest], *points.values(), *jumps, *reversal]),
        np.array([films.load[thinnest], *pair.at_points, other[1], other[3], at_pitch_point, at_pitch_point]),
    )
