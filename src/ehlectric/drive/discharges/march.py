"""Discharges over time: films that break down, conduct and insulate again; compiled. SI units.

Between two changes, of the source or of a film, the circuit is linear and its solution exact. The march goes
from change to change: edges of the source, elements that pass, films that are renewed or touch, voltages that
reach the threshold of a film, and arcs that go out.
"""

from __future__ import annotations

import cmath
import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ehlectric.arrays import Array
from ehlectric.drive.discharges.compiled import compiled, inner
from ehlectric.drive.discharges.course import Course, all_at, course_at, course_of, unfold
from ehlectric.drive.discharges.meters import Meters, measure
from ehlectric.drive.discharges.pieces import (
    FALLS,
    FURTHER,
    RATE,
    RISES,
    ROWS,
    START,
    Circuits,
    Complex,
    Source,
    begin,
    crossing,
    curvature_bound,
    move,
    states_at,
    voltages,
)
from ehlectric.drive.discharges.record import CHARGE, COLUMNS, ENERGY, FILM, OFF, ON, PEAK, PLACE, VOLTAGE
from ehlectric.drive.discharges.spectrum import add_parabola
from ehlectric.drive.discharges.states import (
    ARC,
    INSULATING,
    POSITION,
    RECOVERING,
    RECOVERY,
    RENEWAL,
    RESERVE,
    TOUCH,
    TOUCHING,
    Films,
    Segments,
    State,
    burns_in,
    next_film,
    state_of,
    threshold,
    waits,
)

# What ended a piece.
_NOTHING, _BROKEN, _OUT = range(3)

# Abscissae and weights of Gauss and Legendre on (0, 1) for charge and energy of an arc, and the exponent at
# which a mode is over. Rate times duration of a panel, L, leaves an error of 5.8e-31 L^21 in the integral of
# an exponential, which has fallen to exp(-E), and 1e6 times as much in that of its square: for 3e-12, L is
# the smaller one of 4 exp(2 E/21) and 7.4 exp(E/21).
_POINTS, _WEIGHTS = np.polynomial.legendre.leggauss(10)
_OF_SQUARE, _OF_MODE, _ORDER, _GONE = 4.0, 7.4, 21.0, 40.0
POINTS, WEIGHTS = 0.5 * (_POINTS + 1.0), 0.5 * _WEIGHTS


# Voltages are measured as parabolas. While an arc burns, these differ from straight lines by this part of the
# larger voltage at the start, and at least by that part of the tolerance of all other times. A parabola that
# turns back is taken as straight where it bends by less than a part of the tolerance.
_OF_ARC, _LEAST, _STRAIGHT = 8e-3, 0.05, 0.01

# Time from which on the shaft voltage is measured, in spacings of its means from their first one.
_MEASURED = -0.5

# Part of the voltage of extinction above which an arc is taken as fed again, and not as just gone out.
_FED = 1.0 + 1e-9


class Work(NamedTuple):
    """Arrays in which a march works; they are changed in place.

    Attributes
    ----------
    piece : ndarray of complex, shape (ROWS, n + FURTHER)
        Present piece.
    course : Course
        Voltages over the present piece.
    volts : ndarray, shape (2,)
        Voltages across both films at the end of the present piece [V].
    charges : ndarray, shape (n,)
        Charges of the nodes while elements move [C].
    events : ndarray, shape (m, 8)
        Table that takes the events.
    filled : ndarray of int, shape (1,)
        Rows of the table that are filled.
    """

    piece: Complex
    course: Course
    volts: Array
    charges: Array
    events: Array
    filled: NDArray[np.int64]


def work_of(size: int, events: int) -> Work:
    """Arrays for a circuit of a number of states, and a table of a number of events."""
    return Work(
        piece=np.zeros((ROWS, size + FURTHER), dtype=np.complex128),
        course=course_of(size + FURTHER),
        volts=np.zeros(2),
        charges=np.zeros(size),
        events=np.zeros((events, COLUMNS)),
        filled=np.zeros(1, dtype=np.int64),
    )


@inner
def _most_used(state: State) -> int:
    """Largest number of random numbers of a film that are used."""
    return int(max(max(state.used[0, 0], state.used[0, 1]), max(state.used[1, 0], state.used[1, 1])))


@inner
def _panel(piece: Complex, t: float, left: float, rough: float) -> float:
    """Time from t on over which both voltages are straight within a tolerance ``rough`` [V]."""
    bound = 0.0
    for film in range(2):
        bound = max(bound, curvature_bound(piece, film, t))
    return left if bound == 0.0 else min(left, math.sqrt(8.0 * rough / bound))


@inner
def _burning_panel(piece: Complex, t: float, left: float) -> float:
    """Time from t on over which charge and energy of an arc, integrals of exponentials, are resolved."""
    h = left
    for m in range(piece.shape[1]):
        rate, fallen = abs(piece[RATE, m]), -piece[RATE, m].real * t
        if rate * h > _OF_SQUARE and piece[START, m] != 0.0 and fallen < _GONE:
            grown = math.exp(fallen / _ORDER)
            h = min(h, min(_OF_SQUARE * grown * grown, _OF_MODE * grown) / rate)
    return h


@inner
def _burn(course: Course, films: Films, state: State, t: float, h: float, first: tuple[float, float]) -> None:
    """Add charge, energy and largest current of the arcs between t and t + h to their events."""
    for b in range(2):
        if not burns_in(state, b):
            continue
        linear, square, largest = 0.0, 0.0, abs(first[b])
        for k in range(POINTS.size):
            v = course_at(course, b, t + h * POINTS[k])
            linear += WEIGHTS[k] * v
            square += WEIGHTS[k] * v * v
            largest = max(largest, abs(v))
        state.event[b, CHARGE] += h * linear / films.arc[b]
        state.event[b, ENERGY] += h * square / films.arc[b]
        state.event[b, PEAK] = max(state.event[b, PEAK], largest / films.arc[b])


@inner
def _measure(meters: Meters, rough: float, piece: Complex, course: Course, source: Source, now: float,
             t: float, end: float, first: tuple[float, float], last: tuple[float, float]
             ) -> None:  # fmt: skip
    """Measure the voltages between t and end of a piece that began at ``now``, as parabolas.

    Those across the films differ from their straight lines by ``rough`` [V] at the most.
    """
    shaft = all_at(course, t)[2]
    while t < end:
        h = _panel(piece, t, end - t, rough)
        # A parabola that turns back within its panel is parted, down to straight ones.
        while True:
            after, then = end, last
            at_end = all_at(course, min(t + h, end))
            if t + h < end:
                after, then = t + h, (at_end[0], at_end[1])
            # Height of the straight lines over the voltages in the middle.
            middle = all_at(course, 0.5 * (t + after))
            bend = 0.5 * (first[0] + then[0]) - middle[0], 0.5 * (first[1] + then[1]) - middle[1]
            turns = max(_turn(bend[0], first[0], then[0]), _turn(bend[1], first[1], then[1]))
            if turns <= _STRAIGHT * rough:
                break
            h = 0.5 * (after - t)
        measure(meters, now + t, after - t, source.level + source.slope * t, first, then, bend)
        begin, lasts = (now + t - meters.spaced[0]) / meters.spaced[1], (after - t) / meters.spaced[1]
        if begin > _MEASURED:
            add_parabola(meters.shaft, begin, lasts, shaft, middle[2], at_end[2])
        t, first, shaft = after, then, at_end[2]


@inner
def _turn(bend: float, first: float, last: float) -> float:
    """Bend [V] of a parabola that turns back between its ends, zero for another one."""
    return abs(bend) if 4.0 * abs(bend) > abs(last - first) else 0.0


@inner
def _ended(piece: Complex, films: Films, state: State, t: float, end: float, first: tuple[float, float],
           last: tuple[float, float]) -> tuple[float, int, int]:  # fmt: skip
    """First time between t and end at which a film breaks down or an arc goes out, what it is, and where.

    The voltage differs from the straight line between its first and last value by less than its curvature
    allows, so that most panels need no search.
    """
    what, film = _NOTHING, 0
    for b in range(2):
        bound = curvature_bound(piece, b, t) * (end - t) * (end - t) / 8.0
        low, high = min(abs(first[b]), abs(last[b])), max(abs(first[b]), abs(last[b]))
        if first[b] * last[b] < 0.0:
            low = 0.0
        # One call for both ways, and so one compilation.
        way, level, near = FALLS, films.extinction[b], False
        if state.phase[b] == INSULATING:
            way, level = RISES, threshold(films, state, b)
            near = high + bound >= level
        elif state.phase[b] == ARC:
            near = low - bound <= level
        if near:
            found = crossing(piece, b, t, end, level, way)
            if 0.0 <= found <= end:
                what, film, end = (_BROKEN if way == RISES else _OUT), b, found
    return end, what, film


@inner
def _piece(circuits: Circuits, films: Films, state: State, source: Source, left: float, piece: Complex,
           course: Course, meters: Meters, now: float, volts: Array) -> tuple[float, int, int]:  # fmt: skip
    """Go on for a time in which nothing is scheduled, or until a film breaks down or an arc goes out.

    ``volts`` takes the voltages across both films at the end.

    Returns
    -------
    tuple
        Time that has passed [s], what ended it, and at which film.
    """
    c = state_of(films, state)
    begin(circuits, c, state.x, source, piece)
    t, what, film = 0.0, _NOTHING, 0
    burns = False
    for b in range(2):
        burns = burns or burns_in(state, b)
    unfold(piece, left, course)
    move(piece, 0.0)
    first = voltages(piece)
    while t < left and what == _NOTHING:
        h = _burning_panel(piece, t, left - t) if burns else _panel(piece, t, left - t, meters.rough[0])
        end = left if t + h >= left else t + h
        move(piece, end)
        last = voltages(piece)
        end, what, film = _ended(piece, films, state, t, end, first, last)
        if what != _NOTHING:
            move(piece, end)
            last = voltages(piece)
        rough = meters.rough[0]
        if burns:
            _burn(course, films, state, t, end - t, first)
            rough = max(_OF_ARC * max(abs(first[0]), abs(first[1])), _LEAST * rough)
        _measure(meters, rough, piece, course, source, now, t, end, first, last)
        for b in range(2):
            if state.phase[b] == TOUCHING:
                meters.touching[b] = max(meters.touching[b], abs(first[b]), abs(last[b]))
        t, first = end, last
    volts[0], volts[1] = first
    move(piece, t)
    states_at(circuits, c, piece, state.x)
    return t, what, film


@inner
def _replace(circuits: Circuits, films: Films, state: State, b: int, volts: float, charges: Array
             ) -> None:  # fmt: skip
    """Move the elements of a bearing to their next position; the charges of all nodes stay."""
    before = state_of(films, state)
    state.place[b] = (state.place[b] + 1) % films.positions[b]
    after = state_of(films, state)
    n = state.x.size
    for i in range(n):
        charges[i] = 0.0
        for j in range(n):
            charges[i] += circuits.charge[before, i, j] * (state.x[j] - circuits.jump[before, j] * volts)
    for i in range(n):
        value = circuits.jump[after, i] * volts
        for j in range(n):
            value += circuits.uncharge[after, i, j] * charges[j]
        state.x[i] = value


@inner
def _ignite(state: State, b: int, now: float, volts: float) -> None:
    """Let the film of a bearing break down."""
    state.phase[b] = ARC
    for column in range(COLUMNS):
        state.event[b, column] = 0.0
    state.event[b, ON], state.event[b, FILM], state.event[b, VOLTAGE] = now, b, volts
    state.event[b, PLACE] = state.place[b]


@inner
def _insulate(films: Films, state: State, b: int, now: float, work: Work) -> None:
    """Let the film insulate again: its event is over, and the next threshold is drawn."""
    count = work.filled[0]
    work.filled[0] = count + 1
    state.phase[b] = INSULATING
    state.clocks[b, RECOVERY] = math.inf
    state.event[b, OFF] = now
    for column in range(COLUMNS):
        work.events[count, column] = state.event[b, column]
    next_film(films, state, b)


@inner
def _scheduled(circuits: Circuits, films: Films, state: State, b: int, now: float, source: float,
               work: Work) -> None:  # fmt: skip
    """Do what the clocks of a bearing say."""
    if state.clocks[b, POSITION] <= 0.0:
        _replace(circuits, films, state, b, source, work.charges)
        state.clocks[b, POSITION] = films.step[b]
    if state.clocks[b, RENEWAL] <= 0.0:
        if state.phase[b] == INSULATING or state.phase[b] == TOUCHING:
            next_film(films, state, b)
        state.clocks[b, RENEWAL] = waits(state, b, films.renewal[b])
    if state.clocks[b, RECOVERY] <= 0.0:
        if abs(work.volts[b]) > _FED * films.extinction[b]:
            # The source has fed the arc again.
            state.phase[b], state.clocks[b, RECOVERY] = ARC, math.inf
        else:
            _insulate(films, state, b, now, work)
    if state.clocks[b, TOUCH] <= 0.0:
        _touch(films, state, b, now, work)
        touching = state.phase[b] == TOUCHING
        state.clocks[b, TOUCH] = waits(state, b, films.touch[b, 1 if touching else 0])


@inner
def _touch(films: Films, state: State, b: int, now: float, work: Work) -> None:
    """Let asperities of a bearing touch, or part; an arc ends where they touch."""
    if state.phase[b] == TOUCHING:
        state.phase[b] = INSULATING
        next_film(films, state, b)
        return
    if state.phase[b] != INSULATING:
        _insulate(films, state, b, now, work)
    state.phase[b] = TOUCHING


@inner
def _start_clocks(films: Films, state: State, b: int) -> None:
    """Set the clocks of a bearing that are not set yet, and draw its first threshold."""
    if not math.isnan(state.clocks[b, POSITION]):
        return
    state.clocks[b, POSITION] = films.step[b]
    state.clocks[b, RENEWAL] = waits(state, b, films.renewal[b])
    state.clocks[b, RECOVERY] = math.inf
    state.clocks[b, TOUCH] = waits(state, b, films.touch[b, 0])
    next_film(films, state, b)


@inner
def _until_next(state: State, left: float) -> tuple[float, bool]:
    """Time to the next change [s], and whether it is the end of the segment, of which some time is left."""
    ends = True
    for b in range(2):
        for clock in range(4):
            if state.clocks[b, clock] < left:
                left, ends = max(state.clocks[b, clock], 0.0), False
    return left, ends


@inner
def _pass_time(circuits: Circuits, state: State, t: float, silent: float) -> None:
    """Let a time pass on all clocks, and let the source ring on; below an amplitude it is silent."""
    for b in range(2):
        for clock in range(4):
            state.clocks[b, clock] -= t
    if state.ring[0] != 0.0:
        state.ring[0] *= cmath.exp(circuits.ring[0] * t)
        if abs(state.ring[0]) < silent:
            state.ring[0] = 0.0
    state.time[1] += t


@compiled
def advance(circuits: Circuits, films: Films, segments: Segments, state: State, meters: Meters,
            work: Work) -> None:  # fmt: skip
    """March through segments of the source, from where the state stands until their end.

    Parameters
    ----------
    circuits : Circuits
        Modes of all states of the circuit.
    films : Films
        Films of both bearings.
    segments : Segments
        Source of this chunk.
    state : State
        Where the march stands; it is moved on. At the end of the segments its cursor is (-1, 0).
    meters : Meters
        What is measured; it is moved on.
    work : Work
        Takes the events. Where their table is full, or random numbers run out, the march stops in between.
    """
    piece, course, volts = work.piece, work.course, work.volts
    k, passed = int(state.cursor[0]), state.cursor[1]
    work.filled[0] = 0
    for b in range(2):
        _start_clocks(films, state, b)
    while k < segments.duration.size:
        if state.cursor[2] == 0.0:
            state.ring[0] += segments.ring[k]
            state.cursor[2] = 1.0
        while passed < segments.duration[k]:
            used = _most_used(state)
            if work.filled[0] + 4 > work.events.shape[0] or used > state.random.shape[2] - RESERVE:
                state.cursor[0], state.cursor[1] = k, passed
                return
            left, ends = _until_next(state, segments.duration[k] - passed)
            level = segments.level[k] + segments.slope[k] * passed
            source = Source(level, segments.slope[k], state.ring[0])
            now = state.time[0] + state.time[1]
            t, what, film = _piece(circuits, films, state, source, left, piece, course, meters, now, volts)
            _pass_time(circuits, state, t, meters.rough[1])
            passed = segments.duration[k] if ends and what == _NOTHING else passed + t
            now = state.time[0] + state.time[1]
            if what == _BROKEN:
                _ignite(state, film, now, volts[film])
            elif what == _OUT:
                state.phase[film] = RECOVERING
                state.clocks[film, RECOVERY] = films.recovery[film]
            at = level + segments.slope[k] * t + state.ring[0].real
            for b in range(2):
                _scheduled(circuits, films, state, b, now, at, work)
        k, passed, state.cursor[2] = k + 1, 0.0, 0.0
    state.time[0], state.time[1] = state.time[0] + state.time[1], 0.0
    state.cursor[0], state.cursor[1] = -1.0, 0.0
