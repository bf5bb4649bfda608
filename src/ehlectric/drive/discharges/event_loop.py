"""March through the discharges of a circuit over time, and measurement of its voltages; compiled.

Between two changes, of the source or of a film, the circuit is linear and its solution exact. The march goes
from change to change: edges of the source, elements that pass, films that are renewed or touch, voltages that
reach the threshold of a film, and arcs that go out. After each change all films are checked again; of several
films above their threshold, the film with the largest ratio of voltage to threshold breaks down first.

The march stops where it needs the modes of a state that are not made yet, and goes on from there.
"""

from __future__ import annotations

import cmath
import math
from typing import NamedTuple

import numpy as np

from ehlectric.arrays import Array
from ehlectric.drive.circuit_equations import CHARGE as CHARGES
from ehlectric.drive.circuit_equations import JUMP_ROW, UNCHARGE, VOLTAGE_ROWS, Complex, Integers
from ehlectric.drive.circuit_states import BURNS, DOES, MOVED
from ehlectric.drive.discharges.compiled import compiled, inlined, inner
from ehlectric.drive.discharges.voltages_in_time import (
    FALLS,
    RATE,
    RISES,
    START,
    all_at,
    begin,
    crossing,
    curvature_bound,
    move,
    states_at,
    unfold,
)
from ehlectric.drive.drive_record import CHARGE, COLUMNS, ENERGY, FILM, OFF, ON, PEAK, PLACE, VOLTAGE

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


# Phases of a film. What it does in the circuit is (phase + 1)//2.
INSULATING, ARC, RECOVERING, TOUCHING = range(4)

# Columns of a film in ``March.film``. Clocks: time left to the next position, next film, its insulation, and
# the next touch [s].
POSITION, RENEWAL, RECOVERY, TOUCH = range(4)
CLOCKS = 4
# Time from one position to the next, mean time of a film, time until a film insulates again, and mean times
# without and with touching asperities [s].
STEP, MEAN_RENEWAL, RECOVERS, MEAN_TOUCH = 4, 5, 6, 7
# Arc resistance [Ohm], voltage at which an arc goes out [V], reciprocal shape of Weibull's law, threshold
# divided by its scale, and largest absolute voltage while asperities touch [V].
ARC_RESISTANCE, EXTINCTION, EXPONENT, DRAW, TOUCHED = range(9, 14)
# Present event, and scale of the threshold at each position [V].
EVENT, SCALE = 14, 14 + COLUMNS

# Whole numbers of a film in ``March.phases``: phase, position and number of positions of its elements, its
# voltage, and used random numbers of both streams.
PHASE, AT_PLACE, PLACES, ROW, USED = range(5)
COUNTS = 6

# Streams of random numbers of a film; the march stops where one has fewer than the reserve left.
THRESHOLDS, TIMES = range(2)
RESERVE = 16

# Rows of ``March.segments``: duration [s], voltage at the start [V], and slope [V/s].
DURATION, LEVEL, RISE = range(3)

# Numbers of ``March.now``: time [s], as a sum of whole chunks and of what has passed since; time that has
# passed of the segment [s], and voltage of the source now [V]. Lowest and highest voltage of the histograms
# and of the source without its ringing [V]; tolerances of the voltage: within which it is taken as straight
# between two times, and below which the ringing of the source is over [V]; time interval of the trace, and
# time of the first mean of the spectrum and spacing of its means [s].
TIME, SINCE, PASSED, SOURCE = range(4)
(LEFT_EDGE, RIGHT_EDGE, SOURCE_LOW, SOURCE_HIGH, ROUGH, SILENT, TRACE_FROM, TRACE_TO, FIRST_MEAN, SPACING) = (
    range(4, 14)
)
NUMBERS = 14

# Whole numbers of ``March.at``: present segment, whether it has begun, film whose clocks are read next, state
# of the circuit, and the film and the change of a state that is missing; filled rows of the events and of
# the trace; what ended a piece, and at which film; and row of the voltage with a spectrum.
SEGMENT, BEGUN, NEXT, STATE, MISSING, CHANGE, FILLED, TRACED, ENDED_BY, ENDED_AT, SPECTRAL = range(11)
PLACES_OF_MARCH = 11

# Columns of a voltage in ``March.meter``: peak [V] and integral of the square [V^2 s], both of straight lines
# where a parabola turns back; and integral [V s], integral of the square [V^2 s], lowest and highest voltage.
HIGH, SQUARE, SUM, SUM_OF_SQUARES, LOWEST_VOLTAGE, HIGHEST_VOLTAGE = range(6)

# Rows of ``March.volts``: voltages at the start and at the end of a panel, and at the end of a part of it; at
# the start and at the end of this part and in its middle, by the series; and voltages in a search.
FIRST, LAST, UNTIL, BEFORE, AFTER, MIDDLE, SEARCH = range(7)
VOLT_ROWS = 7


class March(NamedTuple):
    """Circuit, films, source, state and meters of a march; the march changes films, state and meters.

    With f films, v voltages, of which the first w are voltages of films, and n states.
    """

    rows: Complex  # modes of all states, as in ``CircuitStates``
    squares: Complex
    links: Integers
    segments: Array  # pieces of the source, shape (3, m)
    rings: Complex  # what rings from each piece on [V], shape (m,)
    film: Array  # shape (f, SCALE + positions)
    phases: Integers  # shape (f, COUNTS)
    # Random numbers of an exponential distribution of mean 1, of each film for thresholds and for times,
    # shape (f, 2, k).
    random: Array
    x: Array  # states of the circuit, shape (n,)
    charges: Array  # charges of the nodes while elements move [C], shape (n,)
    ring: Complex  # amplitude [V] and rate [1/s] of the ringing, shape (2,)
    now: Array  # shape (NUMBERS,)
    at: Integers  # shape (PLACES_OF_MARCH,)
    piece: Complex  # present piece, as in ``empty_piece``
    series: Complex  # voltages over the present piece, as in ``empty_series``
    volts: Array  # voltages [V], shape (VOLT_ROWS, v)
    meter: Array  # shape (v, 6)
    # Time at the voltages of each bin [s]; the number of bins is a multiple of four, and half of them are
    # below zero, shape (w, bins).
    histogram: Array
    limits: Array  # limits of the voltage [V], shape (l,)
    above: Array  # time at which the absolute voltage is above each limit [s], shape (w, l)
    means: Array  # triangular means of the voltage of a shaft over the measured time [V], shape (k,)
    # Time [s], voltage of the source without its ringing, and all voltages [V], until the table is full,
    # shape (k, 2 + v).
    trace: Array
    events: Array  # table that takes the events, shape (k, 8)


@inner
def _widen(histogram: Array) -> None:
    """Double the width of all bins: each takes the time of two neighbours, from zero outwards."""
    half = histogram.shape[1] // 2
    for b in range(histogram.shape[0]):
        for k in range(half):
            upper, lower = 0.0, 0.0
            if 2 * k + 1 < half:
                upper = histogram[b, half + 2 * k] + histogram[b, half + 2 * k + 1]
                lower = histogram[b, half - 1 - 2 * k] + histogram[b, half - 2 - 2 * k]
            histogram[b, half + k], histogram[b, half - 1 - k] = upper, lower


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


# What ended a piece.
NOTHING, BROKEN, OUT = range(3)

# Abscissae and weights of Gauss and Legendre on (0, 1) for charge and energy of an arc, and the exponent at
# which a mode is over. Rate times duration of a panel, L, leaves an error of 5.8e-31 L^21 in the integral of
# an exponential, which has fallen to exp(-E), and 1e6 times as much in the integral of its square: for 3e-12,
# L is the smaller one of 4 exp(2 E/21) and 7.4 exp(E/21).
_POINTS, _WEIGHTS = np.polynomial.legendre.leggauss(10)
_OF_SQUARE, _OF_MODE, _ORDER, _GONE = 4.0, 7.4, 21.0, 40.0
POINTS, GAUSS_WEIGHTS = 0.5 * (_POINTS + 1.0), 0.5 * _WEIGHTS


# Voltages are measured as parabolas. While an arc burns, these differ from straight lines by this part of the
# larger voltage at the start, and at least by that part of the tolerance of all other times. A parabola that
# turns back is taken as straight where it bends by less than a part of the tolerance.
_OF_ARC, _LEAST, _STRAIGHT = 8e-3, 0.05, 0.01

# Time from which on the shaft voltage is measured, in spacings of its means from their first one.
_MEASURED = -0.5

# Part of the voltage of extinction above which an arc is taken as fed again, and not as just gone out.
_FED = 1.0 + 1e-9


@inner
def _panel(piece: Complex, films: int, t: float, left: float, rough: float) -> float:
    """Time from t on over which the voltages of all films are straight within a tolerance ``rough`` [V]."""
    bound = 0.0
    for v in range(films):
        bound = max(bound, curvature_bound(piece, v, t))
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
def _burn(film: Array, phases: Integers, series: Complex, t: float, h: float, first: Array, volts: Array
          ) -> None:  # fmt: skip
    """Add charge, energy and largest current of the arcs between t and t + h to their events."""
    for b in range(phases.shape[0]):
        if (phases[b, PHASE] + 1) // 2 == BURNS:
            row, arc = phases[b, ROW], film[b, ARC_RESISTANCE]
            linear, square, largest = 0.0, 0.0, abs(first[row])
            for k in range(POINTS.size):
                all_at(series, t + h * POINTS[k], volts)
                v = volts[row]
                linear += GAUSS_WEIGHTS[k] * v
                square += GAUSS_WEIGHTS[k] * v * v
                largest = max(largest, abs(v))
            film[b, EVENT + CHARGE] += h * linear / arc
            film[b, EVENT + ENERGY] += h * square / arc
            film[b, EVENT + PEAK] = max(film[b, EVENT + PEAK], largest / arc)


@inner
def _part(piece: Complex, series: Complex, films: int, rough: float, t: float, end: float, volts: Array
          ) -> float:  # fmt: skip
    """End of a part of a panel [s] in which the voltages of films are parabolas that do not turn back.

    They differ from their straight lines by ``rough`` [V] at the most. Writes the voltages in its middle and
    at its end.
    """
    after, middle = volts[AFTER], volts[MIDDLE]
    h, turns, to = _panel(piece, films, t, end - t, rough), math.inf, end
    while turns > _STRAIGHT * rough:
        to, by_series = end, t + h < end
        if by_series:
            to = t + h
        all_at(series, to, after)
        all_at(series, 0.5 * (t + to), middle)
        turns = 0.0
        for b in range(films):
            v, w = volts[FIRST, b], volts[LAST, b]
            if by_series:
                w = after[b]
            volts[UNTIL, b] = w
            # Height of the straight line over the voltage in the middle.
            bend = abs(0.5 * (v + w) - middle[b])
            if 4.0 * bend > abs(w - v):
                turns = max(turns, bend)
        h = 0.5 * (to - t)
    return to


@inner
def _fill(histogram: Array, b: int, now: Array, v: float, w: float, e: float, duration: float
          ) -> None:  # fmt: skip
    """Share a duration on a parabola from v to w among the bins between both."""
    bins, left = histogram.shape[1], now[LEFT_EDGE]
    width = (now[RIGHT_EDGE] - left) / bins
    low, high = (min(v, w) - left) / width, (max(v, w) - left) / width
    start, end = int(low), int(high)
    start = 0 if start < 0 else bins - 1 if start >= bins else start
    end = 0 if end < 0 else bins - 1 if end >= bins else end
    if start == end:
        histogram[b, start] += duration
    elif e == 0.0:
        each = duration / (high - low)
        histogram[b, start] += each * (start + 1.0 - low)
        for k in range(start + 1, end):
            histogram[b, k] += each
        histogram[b, end] += each * (high - end)
    else:
        before = 0.0 if w > v else 1.0
        for k in range(start, end):
            share = _share_before(v, w, e, left + (k + 1) * width)
            histogram[b, k] += duration * abs(share - before)
            before = share
        histogram[b, end] += duration * abs((1.0 if w > v else 0.0) - before)


@inner
def _measure_films(histogram: Array, limits: Array, above: Array, meter: Array, now: Array, volts: Array,
                   duration: float) -> None:  # fmt: skip
    """Measure the voltages of films, which go on parabolas in a duration [s].

    They are taken as straight where the parabola turns back between its ends.
    """
    films, largest = histogram.shape[0], 0.0
    for b in range(films):
        largest = max(largest, max(abs(volts[FIRST, b]), abs(volts[UNTIL, b])))
    while largest > now[RIGHT_EDGE]:
        _widen(histogram)
        now[LEFT_EDGE] *= 2.0
        now[RIGHT_EDGE] *= 2.0
    for b in range(films):
        v, w = volts[FIRST, b], volts[UNTIL, b]
        e = 0.5 * (v + w) - volts[MIDDLE, b]
        if 4.0 * abs(e) > abs(w - v):
            e = 0.0
        highest = max(abs(v), abs(w))
        meter[b, HIGH] = max(meter[b, HIGH], highest)
        # Integral of (v + (w - v) s - 4 e s (1 - s))^2 over s from 0 to 1.
        square = (v * v + v * w + w * w - 2.0 * e * (v + w)) / 3.0 + 8.0 * e * e / 15.0
        meter[b, SQUARE] += duration * square
        _fill(histogram, b, now, v, w, e, duration)
        for k in range(limits.size):
            if highest > limits[k]:
                share = 1.0
                if v != w:
                    upper = _share_before(v, w, e, limits[k])
                    share = 1.0 - abs(upper - _share_before(v, w, e, -limits[k]))
                above[b, k] += duration * share


@inner
def _measure_all(meter: Array, volts: Array, duration: float) -> None:
    """Measure all voltages, which go on parabolas in a duration [s], and go on to the end of this part."""
    for b in range(meter.shape[0]):
        v, w, middle = volts[BEFORE, b], volts[AFTER, b], volts[MIDDLE, b]
        e = 0.5 * (v + w) - middle
        meter[b, SUM] += duration * (v + 4.0 * middle + w) / 6.0
        square = (v * v + v * w + w * w - 2.0 * e * (v + w)) / 3.0
        meter[b, SUM_OF_SQUARES] += duration * (square + 8.0 * e * e / 15.0)
        meter[b, LOWEST_VOLTAGE] = min(meter[b, LOWEST_VOLTAGE], min(min(v, w), middle))
        meter[b, HIGHEST_VOLTAGE] = max(meter[b, HIGHEST_VOLTAGE], max(max(v, w), middle))
        volts[FIRST, b], volts[BEFORE, b] = volts[UNTIL, b], w


@inner
def _ended(piece: Complex, film: Array, phases: Integers, at: Integers, t: float, end: float, volts: Array
           ) -> float:  # fmt: skip
    """First time between t and end at which a film breaks down or an arc goes out.

    The voltage differs from the straight line between its first and last value by less than its curvature
    allows, so that most panels need no search. Of discharges that begin at once and take no time, the film
    with the largest ratio of voltage to threshold is the first.
    """
    at[ENDED_BY], largest = NOTHING, 0.0
    for b in range(phases.shape[0]):
        phase, row = phases[b, PHASE], phases[b, ROW]
        way = RISES if phase == INSULATING else FALLS
        if way == RISES or phase == ARC:
            v, w, level = volts[FIRST, row], volts[LAST, row], film[b, EXTINCTION]
            bound = curvature_bound(piece, row, t) * (end - t) * (end - t) / 8.0
            if way == RISES:
                level = max(film[b, SCALE + phases[b, AT_PLACE]] * film[b, DRAW], level)
                near = max(abs(v), abs(w)) + bound >= level
            else:
                near = v * w < 0.0 or min(abs(v), abs(w)) - bound <= level
            if near:
                crossed = crossing(piece, row, t, end, level, way, volts[SEARCH])
                ratio = abs(v) / level if film[b, ARC_RESISTANCE] == 0.0 else 0.0
                if 0.0 <= crossed < end or (crossed == end and ratio >= largest):
                    end, largest = crossed, ratio
                    at[ENDED_BY], at[ENDED_AT] = (BROKEN if way == RISES else OUT), b
    return end


@inner
def _move_elements(rows: Complex, squares: Complex, links: Integers, film: Array, phases: Integers,
                   at: Integers, x: Array, volts: float, charges: Array) -> bool:  # fmt: skip
    """Move the elements of a film if their time is over; the charges of all nodes stay.

    False if the modes of the state with their next position are not made yet.
    """
    b, before, n = at[NEXT], at[STATE], x.size
    if film[b, POSITION] <= 0.0:
        after = links[before, b, MOVED]
        if after < 0:
            at[MISSING], at[CHANGE] = b, MOVED
            return False
        for i in range(n if after != before else 0):
            charges[i] = 0.0
            for j in range(n):
                plain = x[j] - rows[before, JUMP_ROW, j].real * volts
                charges[i] += squares[before, CHARGES, i, j].real * plain
        for i in range(n if after != before else 0):
            value = rows[after, JUMP_ROW, i].real * volts
            for j in range(n):
                value += squares[after, UNCHARGE, i, j].real * charges[j]
            x[i] = value
        at[STATE], film[b, POSITION] = after, film[b, STEP]
        phases[b, AT_PLACE] = (phases[b, AT_PLACE] + 1) % phases[b, PLACES]
    return True


@inner
def _ignite(rows: Complex, c: int, x: Array, film: Array, phases: Integers, b: int, time: float, volts: Array
            ) -> None:  # fmt: skip
    """Let a film break down: an arc begins. Without a resistance it takes no time, and ends at extinction.

    With the capacitance C_th that is discharged, the charge is C_th (U - U_r), and the energy
    C_th (U^2 - U_r^2)/2 of voltages before and after.
    """
    row = phases[b, ROW]
    v = volts[row]
    for column in range(COLUMNS):
        film[b, EVENT + column] = 0.0
    film[b, EVENT + ON], film[b, EVENT + FILM], film[b, EVENT + VOLTAGE] = time, b, v
    film[b, EVENT + PLACE] = phases[b, AT_PLACE]
    phases[b, PHASE] = ARC
    if film[b, ARC_RESISTANCE] == 0.0:
        spark = VOLTAGE_ROWS + volts.size + row
        rest = math.copysign(film[b, EXTINCTION], v)
        capacitance = rows[c, spark, x.size].real
        for i in range(x.size):
            x[i] -= rows[c, spark, i].real * (v - rest)
        film[b, EVENT + CHARGE] = capacitance * (v - rest)
        film[b, EVENT + ENERGY] = 0.5 * capacitance * (v * v - rest * rest)
        film[b, RECOVERY] = 0.0


@inner
def _scheduled(film: Array, phases: Integers, b: int, random: Array, events: Array, at: Integers, time: float,
               volts: Array) -> None:  # fmt: skip
    """Do what the clocks of a film say, except the clock of its elements."""
    over, renewed, phase, used = False, False, phases[b, PHASE], phases[b, USED + TIMES]
    if film[b, RENEWAL] <= 0.0:
        renewed = (phase + 1) // 2 != BURNS
        film[b, RENEWAL] = film[b, MEAN_RENEWAL] * random[b, TIMES, used]
        used += 1
    if film[b, RECOVERY] <= 0.0:
        # The source may have fed the arc again.
        over = film[b, ARC_RESISTANCE] == 0.0 or abs(volts[phases[b, ROW]]) <= _FED * film[b, EXTINCTION]
        phase = INSULATING if over else ARC
        film[b, RECOVERY] = math.inf
    if film[b, TOUCH] <= 0.0:
        over = over or (phase + 1) // 2 == BURNS
        if phase == TOUCHING:
            phase, renewed = INSULATING, True
        else:
            phase, film[b, RECOVERY] = TOUCHING, math.inf
        film[b, TOUCH] = film[b, MEAN_TOUCH + phase // TOUCHING] * random[b, TIMES, used]
        used += 1
    if over:
        filled = at[FILLED]
        at[FILLED] = filled + 1
        film[b, EVENT + OFF] = time
        for column in range(COLUMNS):
            events[filled, column] = film[b, EVENT + column]
    if (over or renewed) and film[b, EXPONENT] > 0.0:
        film[b, DRAW] = random[b, THRESHOLDS, phases[b, USED]] ** film[b, EXPONENT]
        phases[b, USED] += 1
    phases[b, PHASE], phases[b, USED + TIMES] = phase, used


@inner
def _ready(links: Integers, phases: Integers, at: Integers, events: int, reserve: int) -> bool:
    """Whether there is room for events and random numbers, and the modes of the present state are made."""
    ready: bool = at[FILLED] + 2 * phases.shape[0] <= events
    for b in range(phases.shape[0]):
        does = (phases[b, PHASE] + 1) // 2
        ready = ready and phases[b, USED] <= reserve and phases[b, USED + TIMES] <= reserve
        if ready and links[at[STATE], b, DOES] != does:
            after = links[at[STATE], b, does]
            if after < 0:
                at[MISSING], at[CHANGE] = b, does
                ready = False
            else:
                at[STATE] = after
    return ready


@inner
def _until_next(film: Array, left: float) -> float:
    """Time to the next change [s] in a segment of which some time is left."""
    for b in range(film.shape[0]):
        for clock in range(CLOCKS):
            if film[b, clock] < left:
                left = max(film[b, clock], 0.0)
    return left


@inner
def _pass_time(film: Array, now: Array, ring: Complex, t: float) -> None:
    """Let a time pass on all clocks, and let the source ring on; below an amplitude it is silent."""
    for b in range(film.shape[0]):
        for clock in range(CLOCKS):
            film[b, clock] -= t
    if ring[0] != 0.0:
        ring[0] *= cmath.exp(ring[1] * t)
        if abs(ring[0]) < now[SILENT]:
            ring[0] = 0.0
    now[SINCE] += t
    now[PASSED] += t


@inlined
def _measure(march: March, rough: float, level: float, slope: float, t: float, end: float) -> None:
    """Measure the voltages between t and end of the present piece, as parabolas.

    The source is u0 [V] and s [V/s] at the start of the piece.
    """
    now, at, volts, trace, films = march.now, march.at, march.volts, march.trace, march.histogram.shape[0]
    start, shown = now[TIME] + now[SINCE], at[SPECTRAL]
    all_at(march.series, t, volts[BEFORE])
    while t < end:
        to = _part(march.piece, march.series, films, rough, t, end, volts)
        source, row = level + slope * t, at[TRACED]
        now[SOURCE_LOW] = min(now[SOURCE_LOW], min(source, level + slope * to))
        now[SOURCE_HIGH] = max(now[SOURCE_HIGH], max(source, level + slope * to))
        if row < trace.shape[0] and now[TRACE_FROM] <= start + t < now[TRACE_TO]:
            trace[row, 0], trace[row, 1] = start + t, source
            for b in range(volts.shape[1]):
                trace[row, 2 + b] = volts[FIRST if b < films else BEFORE, b]
            at[TRACED] = row + 1
        begins = (start + t - now[FIRST_MEAN]) / now[SPACING]
        if begins > _MEASURED:
            v, middle, w = volts[BEFORE, shown], volts[MIDDLE, shown], volts[AFTER, shown]
            add_parabola(march.means, begins, (to - t) / now[SPACING], v, middle, w)
        _measure_films(march.histogram, march.limits, march.above, march.meter, now, volts, to - t)
        _measure_all(march.meter, volts, to - t)
        t = to


@inlined
def _piece(march: March, level: float, slope: float, left: float) -> float:
    """Go on for a time in which nothing is scheduled, or until a film breaks down or an arc goes out.

    Returns time that has passed [s]. ``FIRST`` of the voltages is at its end.
    """
    piece, film, phases, volts, at = march.piece, march.film, march.phases, march.volts, march.at
    films, rough, first, last = march.histogram.shape[0], march.now[ROUGH], volts[FIRST], volts[LAST]
    begin(march.rows, march.squares, at[STATE], march.x, level, slope, march.ring, piece)
    unfold(piece, left, march.series)
    burns = False
    for b in range(phases.shape[0]):
        burns = burns or (phases[b, PHASE] + 1) // 2 == BURNS
    t, at[ENDED_BY] = 0.0, NOTHING
    move(piece, 0.0, first)
    while t < left and at[ENDED_BY] == NOTHING:
        h = _burning_panel(piece, t, left - t) if burns else _panel(piece, films, t, left - t, rough)
        end = left if t + h >= left else t + h
        move(piece, end, last)
        end = _ended(piece, film, phases, at, t, end, volts)
        if at[ENDED_BY] != NOTHING:
            move(piece, end, last)
        within = rough
        if burns:
            _burn(film, phases, march.series, t, end - t, first, volts[MIDDLE])
            largest = 0.0
            for v in range(films):
                largest = max(largest, abs(first[v]))
            within = max(_OF_ARC * largest, _LEAST * rough)
        for b in range(phases.shape[0]):
            if phases[b, PHASE] == TOUCHING:
                highest = max(abs(first[phases[b, ROW]]), abs(last[phases[b, ROW]]))
                film[b, TOUCHED] = max(film[b, TOUCHED], highest)
        _measure(march, within, level, slope, t, end)
        t = end
    move(piece, t, last)
    states_at(march.rows, march.squares, at[STATE], piece, march.x)
    return t


@inlined
def _step(march: March, k: int) -> None:
    """Go on in a segment to the next change, and let it happen."""
    now, at, film, phases = march.now, march.at, march.film, march.phases
    slope, rest = march.segments[RISE, k], march.segments[DURATION, k] - now[PASSED]
    left = _until_next(film, rest)
    level = march.segments[LEVEL, k] + slope * now[PASSED]
    t = _piece(march, level, slope, left)
    _pass_time(film, now, march.ring, t)
    b = at[ENDED_AT]
    if at[ENDED_BY] == BROKEN:
        time = now[TIME] + now[SINCE]
        _ignite(march.rows, at[STATE], march.x, film, phases, b, time, march.volts[FIRST])
    elif at[ENDED_BY] == OUT:
        phases[b, PHASE], film[b, RECOVERY] = RECOVERING, film[b, RECOVERS]
    elif left == rest:
        now[PASSED] = march.segments[DURATION, k]
    now[SOURCE] = level + slope * t + march.ring[0].real
    at[NEXT] = 0


@compiled
def advance(march: March) -> None:
    """March through segments of the source, from the present place until their end.

    It stops earlier if the table of events is full, random numbers are used up, or a state is missing.
    """
    now, at, film, phases = march.now, march.at, march.film, march.phases
    films, volts, reserve = phases.shape[0], march.volts[FIRST], march.random.shape[2] - RESERVE
    while at[SEGMENT] < march.segments.shape[1]:
        k = at[SEGMENT]
        if at[BEGUN] == 0:
            march.ring[0] += march.rings[k]
            at[BEGUN] = 1
        while now[PASSED] < march.segments[DURATION, k] or at[NEXT] < films:
            if at[NEXT] == films:
                if not _ready(march.links, phases, at, march.events.shape[0], reserve):
                    return
                _step(march, k)
            while at[NEXT] < films:
                if not _move_elements(
                    march.rows, march.squares, march.links, film, phases, at, march.x, now[SOURCE],
                    march.charges,
                ):  # fmt: skip
                    return
                time = now[TIME] + now[SINCE]
                _scheduled(film, phases, at[NEXT], march.random, march.events, at, time, volts)
                at[NEXT] += 1
        at[SEGMENT], now[PASSED], at[BEGUN] = k + 1, 0.0, 0
    now[TIME], now[SINCE] = now[TIME] + now[SINCE], 0.0
    at[SEGMENT] = -1
