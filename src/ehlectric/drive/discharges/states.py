"""State of a march through time, films of both bearings, and pieces of the source; compiled. SI units."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ehlectric.arrays import Array
from ehlectric.drive.discharges.compiled import inner
from ehlectric.drive.discharges.pieces import Complex

Integers = NDArray[np.int64]

# Phases of a film.
INSULATING, ARC, RECOVERING, TOUCHING = range(4)

# Clocks of a film: time left to the next position, next film, its insulation, and the next touch.
POSITION, RENEWAL, RECOVERY, TOUCH = range(4)

# Streams of random numbers of a film; the march stops where one has fewer than the reserve left.
_THRESHOLDS, _TIMES = range(2)
RESERVE = 16


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
    """Pieces of the source: duration [s], value at the start [V], slope [V/s], and what rings from then."""

    duration: Array
    level: Array
    slope: Array
    ring: Complex


@inner
def state_of(films: Films, state: State) -> int:
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
def threshold(films: Films, state: State, b: int) -> float:
    """Voltage at which a film breaks down now [V]; below the voltage of extinction there is no arc."""
    return float(max(films.scale[b, state.place[b]] * state.draw[b], films.extinction[b]))


@inner
def _random(state: State, b: int, stream: int) -> float:
    """Next random number of a film."""
    k = state.used[b, stream]
    state.used[b, stream] = k + 1
    return float(state.random[b, stream, k])


@inner
def next_film(films: Films, state: State, b: int) -> None:
    """Draw the threshold of a new film from Weibull's law of scale 1; 1 without scatter."""
    if math.isfinite(films.shape[b]):
        state.draw[b] = _random(state, b, _THRESHOLDS) ** (1.0 / films.shape[b])
    else:
        state.draw[b] = 1.0


@inner
def waits(state: State, b: int, mean: float) -> float:
    """Waiting time of a Poisson process of a mean interval [s]."""
    return mean * _random(state, b, _TIMES) if math.isfinite(mean) else math.inf


@inner
def burns_in(state: State, b: int) -> bool:
    """Whether an arc burns in a film, or has gone out while the film does not insulate yet."""
    return bool(state.phase[b] == ARC or state.phase[b] == RECOVERING)
