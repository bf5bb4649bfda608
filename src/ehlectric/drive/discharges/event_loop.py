"""March through the discharges of a drive over time, and measurement of its voltages; compiled.

Between two changes, of the source or of a film, the circuit is linear and its solution exact. The march goes
from change to change: edges of the source, elements that pass, films that are renewed or touch, voltages that
reach the threshold of a film, and arcs that go out.
"""

from __future__ import annotations

import cmath
import math
from typing import NamedTuple

import numpy as np

from ehlectric.arrays import Array
from ehlectric.drive.discharges.compiled import compiled, inlined, inner
from ehlectric.drive.discharges.films_and_source import Films, Integers, Segments
from ehlectric.drive.discharges.voltages_in_time import (
    FALLS,
    FURTHER,
    RATE,
    RISES,
    ROWS,
    START,
    PieceVoltages,
    Source,
    all_at,
    begin,
    crossing,
    curvature_bound,
    empty_piece_voltages,
    move,
    states_at,
    unfold,
    voltages,
)
from ehlectric.drive.drive_record import CHARGE, COLUMNS, ENERGY, FILM, OFF, ON, PEAK, PLACE, VOLTAGE
from ehlectric.drive.motor_circuit import Complex, Modes

# Largest number of lines of a spectrum, and the frequency above which it has none [Hz]: edges of 100 ns have
# their corner at 1/(pi 100 ns) = 3 MHz.
LINES, HIGHEST = 200_000, 1e7

# Means for each line. With eight of them the highest line takes up 1/49 of the first frequency that is folded
# onto it.
_MEANS = 8

# Abscissae of Gauss and Legendre for two points on (-1, 1), exact for a parabola times a straight line.
_GAUSS = 1.0 / math.sqrt(3.0)


def empty_means(duration: float) -> Array:
    """Means of a voltage over a duration [s], all zero: as many as its spectrum needs."""
    lines = max(int(min(HIGHEST * duration, LINES)), 1)
    return np.zeros(_MEANS * lines)


@inner
def add_parabola(means: Array, start: float, duration: float, first: float, middle: float, last: float
                 ) -> None:  # fmt: skip
    """Add a voltage that goes on a parabola to its means.

    Each mean is weighted by a triangle, which is 1 at a time of the mean and 0 at those before and after it.

    ``means``, means at evenly spaced times; the time after the last one is the first one again,
    shape (n,); ``first``, ``middle`` and ``last``, voltage at its start, in its middle and at its end [V].
    """
    straight, bend = last - first, 2.0 * (first + last - 2.0 * middle)
    at, end = start, start + duration
    while at < end:
        cell = math.floor(at)
        to = min(cell + 1.0, end)
        k = int(cell) % means.size
        after = (k + 1) % means.size
        for sign in (-1.0, 1.0):
            x = 0.5 * (at + to) + sign * _GAUSS * 0.5 * (to - at)
            part = (x - start) / duration
            value = 0.5 * (to - at) * (first + straight * part - bend * part * (1.0 - part))
            means[k] += value * (cell + 1.0 - x)
            means[after] += value * (x - cell)
        at = to


def spectrum_of(means: Array) -> Array:
    """Amplitudes of the lines of a spectrum from triangular means. ``means``, means of a voltage at evenly
    spaced times of the measured one [V], shape (n,). Returns absolute mean, and the amplitudes of the lines
    at whole multiples of one over the measured time [V], shape (n/8 + 1,).

    A triangular mean multiplies the Fourier coefficient of line m by sinc(m/n)^2, with
    sinc(x) = sin(pi x)/(pi x), which is divided out. Sampling adds the coefficients of lines n - m, n + m and
    so on; the coefficient of line n - m has the weight (m/(n - m))^2.

    Examples
    --------
    Means of 1 V and a cosine of 2 V with three periods in the measured time:

    >>> time = np.arange(80) / 80.0
    >>> means = 1.0 + 2.0 * np.sinc(3.0 / 80.0) ** 2 * np.cos(6.0 * np.pi * time)
    >>> spectrum_of(means).round(6)[:5].tolist()
    [1.0, 0.0, 0.0, 2.0, 0.0]
    """
    lines = np.arange(means.size // _MEANS + 1)
    spectrum = np.fft.rfft(means)[: lines.size] / means.size
    amplitudes: Array = np.where(lines > 0, 2.0, 1.0) * np.abs(spectrum) / np.sinc(lines / means.size) ** 2
    return amplitudes


# Phases of a film.
INSULATING, ARC, RECOVERING, TOUCHING = range(4)

# Clocks of a film: time left to the next position, next film, its insulation, and the next touch.
POSITION, RENEWAL, RECOVERY, TOUCH = range(4)

# Streams of random numbers of a film; the march stops where one has fewer than the reserve left.
_THRESHOLDS, _TIMES = range(2)
RESERVE = 16


class State(NamedTuple):
    """State of a march; it is changed in place."""

    x: Array  # states of the circuit, shape (n,)
    ring: Complex  # amplitude of the ringing [V], shape (1,)
    clocks: Array  # times left [s], shape (2, 4)
    place: Integers  # position of the elements, shape (2,)
    phase: Integers  # phase of each film, shape (2,)
    draw: Array  # threshold of each film over its scale, shape (2,)
    event: Array  # event of each film so far, shape (2, 8)
    time: Array  # time [s], as a sum of whole chunks and of what has passed since, shape (2,)
    # Next segment, what has passed of it [s], and whether it has begun (1) or not (0), shape (3,).
    cursor: Array
    # Random numbers of an exponential distribution of mean 1, of each film for thresholds and for times,
    # shape (2, 2, m).
    random: Array
    used: Integers  # how many of them are used, shape (2, 2)


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


@inlined
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


class Meters(NamedTuple):
    """Measured values; they are changed in place."""

    # Lowest and highest voltage of the histograms [V], which are doubled where a voltage is beyond them,
    # shape (2,).
    edges: Array
    # Time at the voltages of each bin [s]; the number of bins is a multiple of four, and half of them are
    # below zero, shape (2, bins).
    histogram: Array
    limits: Array  # limits of the voltage [V], shape (l,)
    above: Array  # time at which the absolute voltage is above each limit [s], shape (2, l)
    peak: Array  # largest absolute voltage [V], shape (2,)
    # Triangular means of the shaft voltage over the measured time [V], as in ``spectrum``, shape (n,).
    shaft: Array
    spaced: Array  # time of the first mean and spacing of the means [s], shape (2,)
    touching: Array  # largest absolute voltage while asperities touch [V], shape (2,)
    square: Array  # integral of the squared voltage over time [V^2 s], shape (2,)
    # Integrals of the shaft voltage [V s] and of its square [V^2 s] over time, shape (2,).
    of_shaft: Array
    # Lowest and highest voltage of the shaft, and of the source without its ringing [V], shape (2, 2).
    ranges: Array
    # Time [s], voltage of the source without its ringing, and both voltages [V], until the table is full,
    # shape (m, 4).
    trace: Array
    traced: Array  # rows of the trace that are filled, shape (1,)
    until: Array  # time interval of the trace [s], shape (2,)
    # Tolerances of the voltage: within which it is taken as straight between two times, and below which the
    # ringing of the source is over [V], shape (2,).
    rough: Array


@inner
def measure(
    meters: Meters, now: float, duration: float, source: float,
    first: tuple[float, float], last: tuple[float, float], bend: tuple[float, float],
) -> None:  # fmt: skip
    """Measure voltages that go on parabolas from first to last values in a duration [s].

    In its middle a parabola lies by ``bend`` [V] below the straight line between its ends. It is taken as
    straight if it turns back between them.
    """
    largest = max(max(abs(first[0]), abs(last[0])), max(abs(first[1]), abs(last[1])))
    while largest > meters.edges[1]:
        _widen(meters)
    for b in range(2):
        v, w = first[b], last[b]
        e = bend[b] if 4.0 * abs(bend[b]) <= abs(w - v) else 0.0
        highest = max(abs(v), abs(w))
        meters.peak[b] = max(meters.peak[b], highest)
        # Integral of (v + (w - v) s - 4 e s (1 - s))^2 over s from 0 to 1.
        square = (v * v + v * w + w * w - 2.0 * e * (v + w)) / 3.0 + 8.0 * e * e / 15.0
        meters.square[b] += duration * square
        _fill(meters, b, v, w, e, duration)
        for k in range(meters.limits.size):
            if highest > meters.limits[k]:
                meters.above[b, k] += duration * _share_above(v, w, e, meters.limits[k])
    row = meters.traced[0]
    if row < meters.trace.shape[0] and meters.until[0] <= now < meters.until[1]:
        meters.trace[row, 0], meters.trace[row, 1] = now, source
        meters.trace[row, 2], meters.trace[row, 3] = first[0], first[1]
        meters.traced[0] = row + 1


@inlined
def _widen(meters: Meters) -> None:
    """Double the width of all bins: each takes the time of two neighbours, from zero outwards."""
    half = meters.histogram.shape[1] // 2
    for b in range(2):
        bins = meters.histogram[b]
        for k in range(half):
            inside = 2 * k + 1 < half
            bins[half + k] = bins[half + 2 * k] + bins[half + 2 * k + 1] if inside else 0.0
            bins[half - 1 - k] = bins[half - 1 - 2 * k] + bins[half - 2 - 2 * k] if inside else 0.0
    meters.edges[0] *= 2.0
    meters.edges[1] *= 2.0


@inner
def _share_before(v: float, w: float, e: float, level: float) -> float:
    """Share of the time on a parabola from v to another value w before it reaches a level, from 0 to 1."""
    if (level - v) * (w - v) <= 0.0:
        return 0.0
    if (level - w) * (w - v) >= 0.0:
        return 1.0
    # Smaller root s of v + (w - v) s - 4 e s (1 - s) = level, without cancellation.
    steep = w - v - 4.0 * e
    root = math.sqrt(max(steep * steep + 16.0 * e * (level - v), 0.0))
    return min(2.0 * (level - v) / (steep + math.copysign(root, w - v)), 1.0)


@inner
def _share_above(v: float, w: float, e: float, limit: float) -> float:
    """Share of the time on a parabola from v to w at which its absolute value is above a limit."""
    if v == w:
        return 1.0 if abs(v) > limit else 0.0
    upper, lower = _share_before(v, w, e, limit), _share_before(v, w, e, -limit)
    return 1.0 - abs(upper - lower)


@inner
def _fill(meters: Meters, b: int, v: float, w: float, e: float, duration: float) -> None:
    """Share a duration on a parabola from v to w among the bins between both."""
    bins = meters.histogram.shape[1]
    width = (meters.edges[1] - meters.edges[0]) / bins
    low, high = (min(v, w) - meters.edges[0]) / width, (max(v, w) - meters.edges[0]) / width
    start, end = min(max(int(low), 0), bins - 1), min(max(int(high), 0), bins - 1)
    if start == end:
        meters.histogram[b, start] += duration
    elif e == 0.0:
        each = duration / (high - low)
        meters.histogram[b, start] += each * (start + 1.0 - low)
        for k in range(start + 1, end):
            meters.histogram[b, k] += each
        meters.histogram[b, end] += each * (high - end)
    else:
        before = 0.0 if w > v else 1.0
        for k in range(start, end):
            share = _share_before(v, w, e, meters.edges[0] + (k + 1) * width)
            meters.histogram[b, k] += duration * abs(share - before)
            before = share
        meters.histogram[b, end] += duration * abs((1.0 if w > v else 0.0) - before)


# What ended a piece.
_NOTHING, _BROKEN, _OUT = range(3)

# Abscissae and weights of Gauss and Legendre on (0, 1) for charge and energy of an arc, and the exponent at
# which a mode is over. Rate times duration of a panel, L, leaves an error of 5.8e-31 L^21 in the integral of
# an exponential, which has fallen to exp(-E), and 1e6 times as much in the integral of its square: for 3e-12,
# L is the smaller one of 4 exp(2 E/21) and 7.4 exp(E/21).
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
    """Arrays in which a march works; they are changed in place."""

    piece: Complex  # present piece, shape (ROWS, n + FURTHER)
    course: PieceVoltages  # voltages over the present piece
    volts: Array  # voltages across both films at the end of the present piece [V], shape (2,)
    charges: Array  # charges of the nodes while elements move [C], shape (n,)
    events: Array  # table that takes the events, shape (m, 8)
    filled: Integers  # rows of the table that are filled, shape (1,)


def work_of(size: int, events: int) -> Work:
    """Allocate the arrays for a number of circuit states, and a table for a number of events."""
    return Work(
        piece=np.zeros((ROWS, size + FURTHER), dtype=np.complex128),
        course=empty_piece_voltages(size + FURTHER),
        volts=np.zeros(2),
        charges=np.zeros(size),
        events=np.zeros((events, COLUMNS)),
        filled=np.zeros(1, dtype=np.int64),
    )


@inlined
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


@inlined
def _burn(
    course: PieceVoltages, films: Films, state: State, t: float, h: float, first: tuple[float, float]
) -> None:
    """Add charge, energy and largest current of the arcs between t and t + h to their events."""
    for b in range(2):
        if not burns_in(state, b):
            continue
        linear, square, largest = 0.0, 0.0, abs(first[b])
        for k in range(POINTS.size):
            v = all_at(course, t + h * POINTS[k])[b]
            linear += WEIGHTS[k] * v
            square += WEIGHTS[k] * v * v
            largest = max(largest, abs(v))
        state.event[b, CHARGE] += h * linear / films.arc[b]
        state.event[b, ENERGY] += h * square / films.arc[b]
        state.event[b, PEAK] = max(state.event[b, PEAK], largest / films.arc[b])


@inner
def _measure(meters: Meters, rough: float, piece: Complex, course: PieceVoltages, source: Source, now: float,
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
        at_start, at_stop = source.level + source.slope * t, source.level + source.slope * after
        measure(meters, now + t, after - t, at_start, first, then, bend)
        _measure_shaft(meters, after - t, shaft, middle[2], at_end[2])
        _stretch(meters.ranges[1], at_start, at_stop)
        begin, lasts = (now + t - meters.spaced[0]) / meters.spaced[1], (after - t) / meters.spaced[1]
        if begin > _MEASURED:
            add_parabola(meters.shaft, begin, lasts, shaft, middle[2], at_end[2])
        t, first, shaft = after, then, at_end[2]


@inlined
def _measure_shaft(meters: Meters, duration: float, first: float, middle: float, last: float) -> None:
    """Measure a shaft voltage that goes on a parabola, from its begin, middle and end [V]."""
    bend = 0.5 * (first + last) - middle
    meters.of_shaft[0] += duration * (first + 4.0 * middle + last) / 6.0
    square = (first * first + first * last + last * last - 2.0 * bend * (first + last)) / 3.0
    meters.of_shaft[1] += duration * (square + 8.0 * bend * bend / 15.0)
    _stretch(meters.ranges[0], first, last)
    _stretch(meters.ranges[0], middle, middle)


@inner
def _stretch(ends: Array, first: float, last: float) -> None:
    """Let a range, its lowest and its highest value, hold two further values."""
    ends[0], ends[1] = min(ends[0], first, last), max(ends[1], first, last)


@inlined
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
            crossed = crossing(piece, b, t, end, level, way)
            if 0.0 <= crossed <= end:
                what, film, end = (_BROKEN if way == RISES else _OUT), b, crossed
    return end, what, film


@inner
def _piece(circuits: Modes, films: Films, state: State, source: Source, left: float,
           piece: Complex, course: PieceVoltages, meters: Meters, now: float,
           volts: Array) -> tuple[float, int, int]:  # fmt: skip
    """Go on for a time in which nothing is scheduled, or until a film breaks down or an arc goes out.

    ``volts`` takes the voltages across both films at the end.

    Returns time that has passed [s], what ended it, and at which film.
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


@inlined
def _replace(circuits: Modes, films: Films, state: State, b: int, volts: float, charges: Array
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


@inlined
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


@inlined
def _scheduled(circuits: Modes, films: Films, state: State, b: int, now: float, source: float,
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


@inlined
def _touch(films: Films, state: State, b: int, now: float, work: Work) -> None:
    """Let asperities of a bearing touch, or part; an arc ends where they touch."""
    if state.phase[b] == TOUCHING:
        state.phase[b] = INSULATING
        next_film(films, state, b)
        return
    if state.phase[b] != INSULATING:
        _insulate(films, state, b, now, work)
    state.phase[b] = TOUCHING


@inlined
def _start_clocks(films: Films, state: State, b: int) -> None:
    """Set the clocks of a bearing that are not set yet, and draw its first threshold."""
    if not math.isnan(state.clocks[b, POSITION]):
        return
    state.clocks[b, POSITION] = films.step[b]
    state.clocks[b, RENEWAL] = waits(state, b, films.renewal[b])
    state.clocks[b, RECOVERY] = math.inf
    state.clocks[b, TOUCH] = waits(state, b, films.touch[b, 0])
    next_film(films, state, b)


@inlined
def _until_next(state: State, left: float) -> tuple[float, bool]:
    """Time to the next change [s], and whether it is the end of the segment, of which some time is left."""
    ends = True
    for b in range(2):
        for clock in range(4):
            if state.clocks[b, clock] < left:
                left, ends = max(state.clocks[b, clock], 0.0), False
    return left, ends


@inlined
def _pass_time(circuits: Modes, state: State, t: float, silent: float) -> None:
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
def advance(circuits: Modes, films: Films, segments: Segments, state: State, meters: Meters,
            work: Work) -> None:  # fmt: skip
    """March through segments of the source, from where the state stands until their end."""
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
