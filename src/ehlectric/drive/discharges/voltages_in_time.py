"""Voltage across the films of a circuit while nothing switches, exact in time and as a power series;
compiled.

The source is u0 + s t + Re(r exp(mu t)). Each mode has the amplitude exp(z) y0 + t phi1(z) f0 + t^2 phi2(z)
f1 with z = lambda t, and the rates f0 = b u0 and f1 = b s. SI units.
"""

from __future__ import annotations

import cmath
import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ehlectric.arrays import Array
from ehlectric.drive.discharges.compiled import inlined, inner
from ehlectric.drive.motor_circuit import Complex, Modes

# Size of lambda t below which phi2 is summed from its series.
SERIES = 0.1
_TERMS = 9
RECIPROCALS = tuple(1.0 / (k + 2.0) for k in range(_TERMS, 0, -1))

# Exponents below which exp is taken as zero.
LOWEST = -700.0

# Number of the voltages of a circuit: across both films, and of the shaft.
VOLTAGES = 3

# Rows of a piece: rates, amplitudes at its start, forces f0 and f1, amplitudes at a time; each voltage, both
# films' and the shaft's, per amplitude; and of each film the size of the second derivative of its voltage at
# the start. Its columns are the modes of the circuit, the source without its ringing, and the ringing, which
# are modes of their own.
RATE, START, FORCE, SLOPE, NOW, FILMS, CURVATURE = 0, 1, 2, 3, 4, 5, 5 + VOLTAGES
ROWS, FURTHER = CURVATURE + 2, 2

# Steps of the search for a crossing, and the part of the level within which it is found.
_STEPS, _CLOSE = 200, 1e-13

# Ways of a crossing.
RISES, FALLS = range(2)

# Spacing of floating-point numbers at 1, relative: the least step in time that moves it.
_EPSILON = float(np.finfo(float).eps)


class Source(NamedTuple):
    """Source from the start of a piece on: u0 [V], its slope [V/s], and the amplitude of the ringing [V]."""

    level: float
    slope: float
    ring: complex


@inner
def phi(z: complex) -> tuple[complex, complex, complex]:
    """exp(z), (exp(z) - 1)/z and (exp(z) - 1 - z)/z^2, without cancellation at small z."""
    if z.imag == 0.0:
        grown, first, second = _phi_of_real(z.real)
        return complex(grown), complex(first), complex(second)
    if abs(z.real) + abs(z.imag) < SERIES:
        last = 0j
        for k in range(_TERMS):
            last = 1.0 + z * last * RECIPROCALS[k]
        last *= 0.5
        return 1.0 + z * (1.0 + z * last), 1.0 + z * last, last
    full = cmath.exp(z) if z.real > LOWEST else 0j
    once = (full - 1.0) / z
    return full, once, (once - 1.0) / z


@inner
def _phi_of_real(z: float) -> tuple[float, float, float]:
    """Same as ``phi`` for a real number, in half of the time."""
    if abs(z) < SERIES:
        last = 0.0
        for k in range(_TERMS):
            last = 1.0 + z * last * RECIPROCALS[k]
        last *= 0.5
        return 1.0 + z * (1.0 + z * last), 1.0 + z * last, last
    grown = math.exp(z) if z > LOWEST else 0.0
    first = (grown - 1.0) / z
    return grown, first, (first - 1.0) / z


@inner
def begin(circuits: Modes, c: int, x: Array, source: Source, piece: Complex) -> None:
    """Fill a piece in state c of the circuit, from its states x; shape of the piece (ROWS, n + FURTHER)."""
    n = x.size
    for m in range(n):
        y = 0j
        for j in range(n):
            y += circuits.inverse[c, m, j] * (x[j] - (circuits.ring_state[c, j] * source.ring).real)
        piece[RATE, m], piece[START, m] = circuits.rates[c, m], y
        piece[FORCE, m] = circuits.force[c, m] * source.level
        piece[SLOPE, m] = circuits.force[c, m] * source.slope
        for across in range(VOLTAGES):
            piece[FILMS + across, m] = circuits.films[c, across, m]
    piece[RATE, n], piece[START, n], piece[FORCE, n], piece[SLOPE, n] = 0.0, source.level, source.slope, 0.0
    piece[RATE, n + 1], piece[START, n + 1] = circuits.ring[0], source.ring
    piece[FORCE, n + 1], piece[SLOPE, n + 1] = 0.0, 0.0
    for across in range(VOLTAGES):
        piece[FILMS + across, n] = circuits.films_source[c, across]
        piece[FILMS + across, n + 1] = circuits.ring_films[c, across]
    for m in range(n + FURTHER):
        rate = piece[RATE, m]
        curvature = rate * (rate * piece[START, m] + piece[FORCE, m]) + piece[SLOPE, m]
        for film in range(2):
            piece[CURVATURE + film, m] = abs(piece[FILMS + film, m] * curvature)


@inner
def move(piece: Complex, t: float) -> None:
    """Move the amplitudes of all modes to a time t of the piece [s]."""
    for m in range(piece.shape[1]):
        rate, start, force = piece[RATE, m], piece[START, m], piece[FORCE, m]
        if rate == 0.0:
            piece[NOW, m] = start + t * (force + 0.5 * t * piece[SLOPE, m])
        elif start != 0.0 or force != 0.0 or piece[SLOPE, m] != 0.0:
            grown, first, second = phi(rate * t)
            piece[NOW, m] = grown * start + t * (first * force + t * second * piece[SLOPE, m])
        else:
            piece[NOW, m] = 0.0


@inner
def voltages(piece: Complex) -> tuple[float, float]:
    """Voltages across both films at the time to which the piece was moved [V]."""
    first, second = 0.0, 0.0
    for m in range(piece.shape[1]):
        y, film_1, film_2 = piece[NOW, m], piece[FILMS, m], piece[FILMS + 1, m]
        first += film_1.real * y.real - film_1.imag * y.imag
        second += film_2.real * y.real - film_2.imag * y.imag
    return first, second


@inner
def voltage_rate(piece: Complex, film: int, t: float) -> float:
    """Rate of the voltage across a film at the time t to which the piece was moved [V/s]."""
    value = 0.0
    for m in range(piece.shape[1]):
        rate = piece[RATE, m] * piece[NOW, m] + piece[FORCE, m] + t * piece[SLOPE, m]
        value += (piece[FILMS + film, m] * rate).real
    return value


@inner
def curvature_bound(piece: Complex, film: int, t: float) -> float:
    """Bound of the second derivative of the voltage across a film from the time t on [V/s^2]."""
    bound = 0.0
    for m in range(piece.shape[1]):
        size = piece[CURVATURE + film, m].real
        if size > 0.0:
            bound += size * math.exp(max(piece[RATE, m].real * t, LOWEST))
    return bound


@inlined
def states_at(circuits: Modes, c: int, piece: Complex, x: Array) -> None:
    """States x of the circuit at the time to which the piece was moved."""
    n = x.size
    for j in range(n):
        value = (circuits.ring_state[c, j] * piece[NOW, n + 1]).real
        for m in range(n):
            value += (circuits.shapes[c, j, m] * piece[NOW, m]).real
        x[j] = value


@inner
def _safe_step(distance: float, rate: float, bound: float) -> float:
    """Longest time in which a distance that changes at a rate, and curves within a bound, stays above 0."""
    root = math.sqrt(rate * rate + 2.0 * bound * distance)
    if rate <= 0.0:
        return math.inf if root == rate else 2.0 * distance / (root - rate)
    return math.inf if bound == 0.0 else (rate + root) / bound


@inner
def crossing(piece: Complex, film: int, start: float, end: float, level: float, way: int) -> float:
    """First time in (start, end) at which abs(voltage) RISES to a level, or FALLS to it; -1 if at none.

    No crossing is stepped over: each step is one in which the bound of the second derivative allows none.
    If the voltage is not turned away from the level, the steps converge as in Newton's method.
    """
    t = start
    for _ in range(_STEPS):
        move(piece, t)
        v, rate = voltages(piece)[film], voltage_rate(piece, film, t)
        bound = curvature_bound(piece, film, t)
        if way == RISES:
            if level - abs(v) <= _CLOSE * level:
                return t
            step = min(_safe_step(level - v, -rate, bound), _safe_step(level + v, rate, bound))
        else:
            if abs(v) - level <= _CLOSE * level:
                return t
            step = _safe_step(abs(v) - level, math.copysign(1.0, v) * rate, bound)
        t += max(step, _EPSILON * t)
        if t >= end:
            return -1.0
    return t


# Terms of the power series of modes that change little in a piece, and of modes below another change. The
# first omitted term belongs to the slope of the source, change^(n - 2) 2/n! of what it does.
_POWERS, _FEW, _SLOWEST = 10, 5, 1e-4


class PieceVoltages(NamedTuple):
    """Voltages over a piece, as a power series and exponentials; changed in place.

    Voltage b, across one of both films or of the shaft, is the sum of ``powers[b, k] t^k``, and of the real
    parts of ``amplitudes[b, m] exp(rates[m] t)`` of the first ``number[0]`` rates; the first ``number[1]``
    powers count.
    """

    powers: Array
    rates: Complex
    amplitudes: Complex
    number: NDArray[np.int64]


def empty_piece_voltages(modes: int) -> PieceVoltages:
    """Voltages over a piece without values yet, for a number of modes."""
    return PieceVoltages(
        np.zeros((VOLTAGES, _POWERS)),
        np.zeros(modes, dtype=np.complex128),
        np.zeros((VOLTAGES, modes), dtype=np.complex128),
        np.zeros(2, dtype=np.int64),
    )


@inner
def unfold(piece: Complex, duration: float, course: PieceVoltages) -> None:
    """Write the voltages over a piece as a power series and exponentials, by which many times are quick.

    A mode that changes little in the duration goes into the series, with an error below 2e-14 of its size; of
    another one the series has the steady part.
    """
    course.powers[:] = 0.0
    count, powers = 0, 2
    for m in range(piece.shape[1]):
        rate, start, force, slope = piece[RATE, m], piece[START, m], piece[FORCE, m], piece[SLOPE, m]
        if start == 0.0 and force == 0.0 and slope == 0.0:
            continue
        change = (abs(rate.real) + abs(rate.imag)) * duration
        if change < SERIES:
            number, term = _FEW if change < _SLOWEST else _POWERS, start
            powers = max(powers, number)
            for k in range(number):
                if k == 1:
                    term = rate * start + force
                elif k == 2:
                    term = 0.5 * (rate * term + slope)
                elif k > 2:
                    term = rate * term / k
                for b in range(VOLTAGES):
                    course.powers[b, k] += (piece[FILMS + b, m] * term).real
            continue
        rising = slope / rate
        steady = (force + rising) / rate
        for b in range(VOLTAGES):
            weight = piece[FILMS + b, m]
            course.powers[b, 0] -= (weight * steady).real
            course.powers[b, 1] -= (weight * rising).real
            course.amplitudes[b, count] = weight * (start + steady)
        course.rates[count] = rate
        count += 1
    course.number[0], course.number[1] = count, powers


@inner
def all_at(course: PieceVoltages, t: float) -> tuple[float, float, float]:
    """Voltages across both films, and of the shaft, at a time t of the piece [V]."""
    first, second, shaft = 0.0, 0.0, 0.0
    for k in range(course.number[1] - 1, -1, -1):
        first, second = first * t + course.powers[0, k], second * t + course.powers[1, k]
        shaft = shaft * t + course.powers[2, k]
    for m in range(course.number[0]):
        rate, film_1, film_2 = course.rates[m], course.amplitudes[0, m], course.amplitudes[1, m]
        third = course.amplitudes[2, m]
        if rate.real * t > LOWEST:
            grown = math.exp(rate.real * t)
            if rate.imag == 0.0:
                first, second = first + film_1.real * grown, second + film_2.real * grown
                shaft += third.real * grown
            else:
                cosine, sine = math.cos(rate.imag * t), math.sin(rate.imag * t)
                first += grown * (film_1.real * cosine - film_1.imag * sine)
                second += grown * (film_2.real * cosine - film_2.imag * sine)
                shaft += grown * (third.real * cosine - third.imag * sine)
    return first, second, shaft
