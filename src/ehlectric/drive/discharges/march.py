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
from ehlectric.drive.discharges.meters import Meters, measure
from ehlectric.drive.discharges.pieces import (
    FURTHER,
    RATE,
    START,
    ROWS,
    Circuits,
    Complex,
    Source,
    begin,
    crossing,
    curvature_bound,
    move,
    states_at,
    voltage,
)

Integers = NDArray[np.int64]

# Phases of a film.
INSULATING, ARC, RECOVERING, TOUCHING = range(4)

# Clocks of a film: time left to the next position, to the next film, to its insulation, and to the next touch.
POSITION, RENEWAL, RECOVERY, TOUCH = range(4)

# Columns of an event.
ON, OFF, FILM, VOLTAGE, CHARGE, ENERGY, PEAK, PLACE = range(8)
COLUMNS = 8

# Streams of random numbers of a film; the march stops where one has fewer than the reserve left.
_THRESHOLDS, _TIMES = range(2)
_RESERVE = 16

# Part of the voltage of extinction above which an arc is taken as fed again, and not as just gone out.
_FED = 1.0 + 1e-9

# What ended a piece.
_NOTHING, _BROKEN, _OUT = range(3)

# Abscissae and weights of Gauss and Legendre on (0, 1) for charge and energy of an arc; rate times duration of
# the panels, for which they are exact to 1e-14; and the exponent at which a mode is over.
_POINTS, _WEIGHTS = np.polynomial.legendre.leggauss(10)
_RESOLVED, _GONE = 3.0, -40.0
POINTS, WEIGHTS = 0.5 * (_POINTS + 1.0), 0.5 * _WEIGHTS


class Films(NamedTuple):
    """Films of both bearings.

    Attributes
    ----------
    scale : ndarray, shape (2, positions)
        Breakdown voltage at which a draw is 1 [V]; infinite for films that do not break down.
    positions : ndarray of int, shape (2,)
        Number of positions of the elements.
    step : ndarray, shape (2,)
        Time from one position to the next [s].
    shape : ndarray, shape (2,)
        Shape of Weibull's law; infinite without scatter.
    renewal : ndarray, shape (2,)
        Mean time after which a new film with a new threshold is in the contacts [s].
    arc : ndarray, shape (2,)
        Arc resistance [Ohm].
    extinction : ndarray, shape (2,)
        Voltage across the arc below which it goes out [V].
    recovery : ndarray, shape (2,)
        Time from there until the film insulates again [s].
    touch : ndarray, shape (2, 2)
        Mean times without and with touching asperities [s].
    states : ndarray of int, shape (1,)
        States of one film: 2, or 3 where films touch.
    """

    scale: Array
    positions: Integers
    step: Array
    shape: Array
    renewal: Array
    arc: Array
    extinction: Array
    recovery: Array
    touch: Array
    states: Integers


class State(NamedTuple):
    """Where a march stands; it is changed in place.

    Attributes
    ----------
    x : ndarray, shape (n,)
        States of the circuit.
    ring : ndarray of complex, shape (1,)
        Amplitude of the ringing [V].
    clocks : ndarray, shape (2, 4)
        Times left [s].
    place : ndarray of int, shape (2,)
        Position of the elements.
    phase : ndarray of int, shape (2,)
        Phase of each film.
    draw : ndarray, shape (2,)
        Threshold of each film over its scale.
    event : ndarray, shape (2, 8)
        Event of each film so far.
    time : ndarray, shape (2,)
        Time [s], as a sum of whole chunks and of what has passed since.
    cursor : ndarray, shape (3,)
        Next segment, what has passed of it [s], and whether it has begun (1) or not (0).
    random : ndarray, shape (2, 2, m)
        Random numbers of an exponential distribution of mean 1, of each film for thresholds and for times.
    used : ndarray of int, shape (2, 2)
        How many of them are used.
    """

    x: Array
    ring: Complex
    clocks: Array
    place: Integers
    phase: Integers
    draw: Array
    event: Array
    time: Array
    cursor: Array
    random: Array
    used: Integers


class Segments(NamedTuple):
    """Pieces of the source: duration [s], value at the start [V], slope [V/s], and what rings from there on."""

    duration: Array
    level: Array
    slope: Array
    ring: Complex


@inner
def _state_of(films: Films, state: State) -> int:
    """Number of the circuit's state: what both films do, and where their elements are."""
    number = 0
    for b in range(2):
        doing = 0
        if state.phase[b] == TOUCHING:
            doing = 2
        elif state.phase[b] != INSULATING:
            doing = 1
        number = number * films.states[0] + doing
    return int((number * films.positions[0] + state.place[0]) * films.positions[1] + state.place[1])


@inner
def _level(films: Films, state: State, b: int) -> float:
    """Voltage at which a film breaks down now [V]; below the voltage of extinction there is no arc."""
    return max(films.scale[b, state.place[b]] * state.draw[b], films.extinction[b])


@inner
def _random(state: State, b: int, stream: int) -> float:
    """Next random number of a film."""
    k = state.used[b, stream]
    state.used[b, stream] = k + 1
    return float(state.random[b, stream, k])


@inner
def _next_film(films: Films, state: State, b: int) -> None:
    """Draw the threshold of a new film from Weibull's law of scale 1; 1 without scatter."""
    if math.isfinite(films.shape[b]):
        state.draw[b] = _random(state, b, _THRESHOLDS) ** (1.0 / films.shape[b])
    else:
        state.draw[b] = 1.0


@inner
def _waits(state: State, b: int, mean: float) -> float:
    """Waiting time of a Poisson process of a mean interval [s]."""
    return mean * _random(state, b, _TIMES) if math.isfinite(mean) else math.inf


@inner
def _burns(state: State, b: int) -> bool:
    """Whether an arc burns in a film, or has gone out while the film does not insulate yet."""
    return bool(state.phase[b] == ARC or state.phase[b] == RECOVERING)


@inner
def _panel(piece: Complex, burns: bool, t: float, left: float, rough: float) -> float:
    """Time from t on over which both voltages are straight within a tolerance ``rough`` [V].

    While an arc burns it is the time over which charge and energy, which are integrals of exponentials, are
    resolved.
    """
    h = left
    if burns:
        for m in range(piece.shape[1]):
            rate = abs(piece[RATE, m])
            if rate * h > _RESOLVED and piece[START, m] != 0.0 and piece[RATE, m].real * t > _GONE:
                h = _RESOLVED / rate
        return h
    bound = max(curvature_bound(piece, 0, t), curvature_bound(piece, 1, t))
    return h if bound == 0.0 else min(h, math.sqrt(8.0 * rough / bound))


@inner
def _burn(piece: Complex, films: Films, state: State, t: float, h: float) -> None:
    """Add charge, energy and largest current of the arcs between t and t + h to their events."""
    for k in range(POINTS.size):
        at = t + h * POINTS[k]
        move(piece, at)
        for b in range(2):
            if _burns(state, b):
                v = voltage(piece, b)
                current = v / films.arc[b]
                state.event[b, CHARGE] += h * WEIGHTS[k] * current
                state.event[b, ENERGY] += h * WEIGHTS[k] * current * v
                state.event[b, PEAK] = max(state.event[b, PEAK], abs(current))


@inner
def _piece(circuits: Circuits, films: Films, state: State, source: Source, left: float, piece: Complex,
           meters: Meters, now: float, volts: Array) -> tuple[float, int, int]:  # fmt: skip
    """Go on for a time in which nothing is scheduled, or until a film breaks down or an arc goes out.

    ``volts`` takes the voltages across both films at the end.

    Returns
    -------
    tuple
        Time that has passed [s], what ended it, and at which film.
    """
    c = _state_of(films, state)
    begin(circuits, c, state.x, source, piece)
    t, what, film = 0.0, _NOTHING, 0
    burns = _burns(state, 0) or _burns(state, 1)
    move(piece, 0.0)
    first = (voltage(piece, 0), voltage(piece, 1))
    while t < left and what == _NOTHING:
        h = _panel(piece, burns, t, left - t, meters.rough[0])
        end = left if t + h >= left else t + h
        move(piece, end)
        last = (voltage(piece, 0), voltage(piece, 1))
        for b in range(2):
            bound = curvature_bound(piece, b, t) * (end - t) ** 2 / 8.0
            low, high = min(abs(first[b]), abs(last[b])), max(abs(first[b]), abs(last[b]))
            if first[b] * last[b] < 0.0:
                low = 0.0
            found = -1.0
            if state.phase[b] == INSULATING:
                level = _level(films, state, b)
                if high + bound >= level:
                    found = crossing(piece, b, t, end, level, True)
            elif state.phase[b] == ARC and low - bound <= films.extinction[b]:
                found = crossing(piece, b, t, end, films.extinction[b], False)
            if found >= 0.0 and found <= end:
                what, film, end = (_BROKEN if state.phase[b] == INSULATING else _OUT), b, found
        if what != _NOTHING:
            move(piece, end)
            last = (voltage(piece, 0), voltage(piece, 1))
        for b in range(2):
            if _burns(state, b):
                state.event[b, PEAK] = max(state.event[b, PEAK], abs(first[b]) / films.arc[b])
        measure(meters, now + t, end - t, source.level + source.slope * t, first, last)
        if burns:
            _burn(piece, films, state, t, end - t)
        t, first = end, last
    volts[0], volts[1] = first
    move(piece, t)
    states_at(circuits, c, piece, state.x)
    return t, what, film


@inner
def _replace(circuits: Circuits, films: Films, state: State, b: int, volts: float) -> None:
    """Move the elements of a bearing to their next position; the charges of all nodes stay."""
    before = _state_of(films, state)
    state.place[b] = (state.place[b] + 1) % films.positions[b]
    after = _state_of(films, state)
    n = state.x.size
    charges = np.zeros(n)
    for i in range(n):
        for j in range(n):
            charges[i] += circuits.charge[before, i, j] * (state.x[j] - circuits.jump[before, j] * volts)
    for i in range(n):
        value = circuits.jump[after, i] * volts
        for j in range(n):
            value += circuits.uncharge[after, i, j] * charges[j]
        state.x[i] = value


@inner
def _ignite(films: Films, state: State, b: int, now: float, volts: float) -> None:
    """Let the film of a bearing break down."""
    state.phase[b] = ARC
    for column in range(COLUMNS):
        state.event[b, column] = 0.0
    state.event[b, ON], state.event[b, FILM], state.event[b, VOLTAGE] = now, b, volts
    state.event[b, PLACE] = state.place[b]


@inner
def _insulate(films: Films, state: State, b: int, now: float, events: Array, count: int) -> None:
    """Let the film insulate again: its event is over, and the next threshold is drawn."""
    state.phase[b] = INSULATING
    state.clocks[b, RECOVERY] = math.inf
    state.event[b, OFF] = now
    for column in range(COLUMNS):
        events[count, column] = state.event[b, column]
    _next_film(films, state, b)


@inner
def _scheduled(circuits: Circuits, films: Films, state: State, b: int, now: float, source: float, volts: float,
               events: Array, count: int) -> int:  # fmt: skip
    """Do what the clocks of a bearing say; return the number of events."""
    if state.clocks[b, POSITION] <= 0.0:
        _replace(circuits, films, state, b, source)
        state.clocks[b, POSITION] = films.step[b]
    if state.clocks[b, RENEWAL] <= 0.0:
        if state.phase[b] == INSULATING or state.phase[b] == TOUCHING:
            _next_film(films, state, b)
        state.clocks[b, RENEWAL] = _waits(state, b, films.renewal[b])
    if state.clocks[b, RECOVERY] <= 0.0:
        if abs(volts) > _FED * films.extinction[b]:
            # The source has fed the arc again.
            state.phase[b], state.clocks[b, RECOVERY] = ARC, math.inf
        else:
            _insulate(films, state, b, now, events, count)
            count += 1
    if state.clocks[b, TOUCH] <= 0.0:
        count = _touch(films, state, b, now, events, count)
        touching = state.phase[b] == TOUCHING
        state.clocks[b, TOUCH] = _waits(state, b, films.touch[b, 1 if touching else 0])
    return count


@inner
def _touch(films: Films, state: State, b: int, now: float, events: Array, count: int) -> int:
    """Let asperities of a bearing touch, or part; an arc ends where they touch."""
    if state.phase[b] == TOUCHING:
        state.phase[b] = INSULATING
        _next_film(films, state, b)
        return count
    if state.phase[b] != INSULATING:
        _insulate(films, state, b, now, events, count)
        count += 1
    state.phase[b] = TOUCHING
    return count


@compiled
def start_clocks(films: Films, state: State, b: int) -> None:
    """Set the clocks of a bearing at the start, and draw its first threshold."""
    state.clocks[b, POSITION] = films.step[b]
    state.clocks[b, RENEWAL] = _waits(state, b, films.renewal[b])
    state.clocks[b, RECOVERY] = math.inf
    state.clocks[b, TOUCH] = _waits(state, b, films.touch[b, 0])
    _next_film(films, state, b)


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
            events: Array) -> int:  # fmt: skip
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
    events : ndarray, shape (m, 8)
        Table that takes the events; where it is full, or random numbers run out, the march stops in between.

    Returns
    -------
    int
        Number of events in the table.
    """
    piece = np.zeros((ROWS, state.x.size + FURTHER), dtype=np.complex128)
    volts = np.zeros(2)
    count, k, passed = 0, int(state.cursor[0]), state.cursor[1]
    while k < segments.duration.size:
        if state.cursor[2] == 0.0:
            state.ring[0] += segments.ring[k]
            state.cursor[2] = 1.0
        while passed < segments.duration[k]:
            if count + 4 > events.shape[0] or np.max(state.used) > state.random.shape[2] - _RESERVE:
                state.cursor[0], state.cursor[1] = k, passed
                return count
            left, ends = _until_next(state, segments.duration[k] - passed)
            level = segments.level[k] + segments.slope[k] * passed
            source = Source(level, segments.slope[k], state.ring[0])
            now = state.time[0] + state.time[1]
            t, what, film = _piece(circuits, films, state, source, left, piece, meters, now, volts)
            _pass_time(circuits, state, t, meters.rough[1])
            passed = segments.duration[k] if ends and what == _NOTHING else passed + t
            now = state.time[0] + state.time[1]
            if what == _BROKEN:
                _ignite(films, state, film, now, volts[film])
            elif what == _OUT:
                state.phase[film] = RECOVERING
                state.clocks[film, RECOVERY] = films.recovery[film]
            at = level + segments.slope[k] * t + state.ring[0].real
            for b in range(2):
                count = _scheduled(circuits, films, state, b, now, at, volts[b], events, count)
        k, passed, state.cursor[2] = k + 1, 0.0, 0.0
    state.time[0], state.time[1] = state.time[0] + state.time[1], 0.0
    state.cursor[0], state.cursor[1] = -1.0, 0.0
    return count
