"""Voltages of a circuit while nothing switches, exact in time and as a power series; compiled.

The source is u0 + s t + Re(r exp(mu t)). Each mode has the amplitude exp(z) y0 + t phi1(z) f0 + t^2 phi2(z)
f1 with z = lambda t, and the rates f0 = b u0 and f1 = b s. SI units.

Compiled functions take few arrays with many columns: each array among the arguments, and each function, takes
time to compile.
"""

from __future__ import annotations

import cmath
import math

import numpy as np

from ehlectric.arrays import Array
from ehlectric.drive.circuit_equations import (
    FORCE_ROW,
    INVERSE,
    RATE_ROW,
    RING_ROW,
    SHAPES,
    VOLTAGE_ROWS,
    Complex,
)
from ehlectric.drive.discharges.compiled import inner

# Size of lambda t below which phi2 is summed from its series.
SERIES = 0.1
_TERMS = 9
RECIPROCALS = tuple(1.0 / (k + 2.0) for k in range(_TERMS, 0, -1))

# Exponents below which exp is taken as zero.
LOWEST = -700.0

# Rows of a piece: rates, amplitudes at its start, forces f0 and f1, and amplitudes at a time; from WEIGHTS
# on, each voltage per amplitude, and then the size of the second derivative of each voltage at the start. Its
# columns are the modes of the circuit, the source without its ringing, and the ringing.
RATE, START, FORCE, SLOPE, NOW, WEIGHTS = range(6)
FURTHER = 2

# Steps of the search for a crossing, and the part of the level within which it is found.
_STEPS, _CLOSE = 200, 1e-13

# Ways of a crossing.
RISES, FALLS = range(2)

# Spacing of floating-point numbers at 1, relative: the least step in time that moves it.
_EPSILON = float(np.finfo(float).eps)


def empty_piece(states: int, voltages: int) -> Complex:
    """Piece without values yet, for a number of states of the circuit and of voltages."""
    return np.zeros((WEIGHTS + 2 * voltages, states + FURTHER), dtype=np.complex128)


@inner
def begin(rows: Complex, squares: Complex, c: int, x: Array, level: float, slope: float, ring: Complex,
          piece: Complex) -> None:  # fmt: skip
    """Fill a piece in state c of the circuit, from its states x and the source u0 [V], s [V/s] and r [V].

    ``rows`` and ``squares`` as in ``Modes``, of all states; ``ring``, amplitude and rate of the ringing.
    """
    n, voltages = x.size, (piece.shape[0] - WEIGHTS) // 2
    amplitude = ring[0]
    for m in range(n):
        y = 0j
        for j in range(n):
            y += squares[c, INVERSE, m, j] * (x[j] - (rows[c, RING_ROW, j] * amplitude).real)
        piece[RATE, m], piece[START, m] = rows[c, RATE_ROW, m], y
        force = rows[c, FORCE_ROW, m]
        piece[FORCE, m] = force * level
        piece[SLOPE, m] = force * slope
    piece[START, n], piece[FORCE, n] = level, slope
    piece[RATE, n + 1], piece[START, n + 1] = ring[1], amplitude
    for m in range(n + FURTHER):
        rate = piece[RATE, m]
        curvature = rate * (rate * piece[START, m] + piece[FORCE, m]) + piece[SLOPE, m]
        for v in range(voltages):
            weight = rows[c, VOLTAGE_ROWS + v, m]
            piece[WEIGHTS + v, m] = weight
            piece[WEIGHTS + voltages + v, m] = abs(weight * curvature)


@inner
def move(piece: Complex, t: float, volts: Array) -> None:
    """Move the amplitudes of all modes to a time t of the piece [s], and write all voltages at that time [V].

    exp(z), phi1 = (exp(z) - 1)/z and phi2 = (exp(z) - 1 - z)/z^2 are without cancellation at small z.
    """
    for m in range(piece.shape[1]):
        rate, start, force, slope = piece[RATE, m], piece[START, m], piece[FORCE, m], piece[SLOPE, m]
        if rate == 0.0:
            piece[NOW, m] = start + t * (force + 0.5 * t * slope)
        elif start == 0.0 and force == 0.0 and slope == 0.0:
            piece[NOW, m] = 0.0
        else:
            z = rate * t
            grown, first, second = 0j, 0j, 0j
            if abs(z.real) + abs(z.imag) < SERIES:
                for k in range(_TERMS):
                    second = 1.0 + z * second * RECIPROCALS[k]
                second *= 0.5
                first = 1.0 + z * second
                grown = 1.0 + z * first
            else:
                if z.real > LOWEST:
                    grown = complex(math.exp(z.real)) if z.imag == 0.0 else cmath.exp(z)
                first = (grown - 1.0) / z
                second = (first - 1.0) / z
            piece[NOW, m] = grown * start + t * (first * force + t * second * slope)
    for v in range(volts.size):
        value = 0.0
        for m in range(piece.shape[1]):
            y, weight = piece[NOW, m], piece[WEIGHTS + v, m]
            value += weight.real * y.real - weight.imag * y.imag
        volts[v] = value


@inner
def curvature_bound(piece: Complex, v: int, t: float) -> float:
    """Bound of the second derivative of a voltage from the time t on [V/s^2]."""
    bound, row = 0.0, (piece.shape[0] + WEIGHTS) // 2 + v
    for m in range(piece.shape[1]):
        size = piece[row, m].real
        if size > 0.0:
            bound += size * math.exp(max(piece[RATE, m].real * t, LOWEST))
    return bound


@inner
def states_at(rows: Complex, squares: Complex, c: int, piece: Complex, x: Array) -> None:
    """States x of the circuit at the time to which the piece was moved."""
    n = x.size
    for j in range(n):
        value = (rows[c, RING_ROW, j] * piece[NOW, n + 1]).real
        for m in range(n):
            value += (squares[c, SHAPES, j, m] * piece[NOW, m]).real
        x[j] = value


@inner
def _safe_step(distance: float, rate: float, bound: float) -> float:
    """Longest time in which a distance that changes at a rate, and curves within a bound, stays above 0."""
    root = math.sqrt(rate * rate + 2.0 * bound * distance)
    if rate <= 0.0:
        return math.inf if root == rate else 2.0 * distance / (root - rate)
    return math.inf if bound == 0.0 else (rate + root) / bound


@inner
def crossing(piece: Complex, v: int, start: float, end: float, level: float, way: int, volts: Array
             ) -> float:  # fmt: skip
    """First time in (start, end) at which abs(voltage) RISES to a level, or FALLS to it; -1 if at none.

    No crossing is stepped over: each step is one in which the bound of the second derivative allows none.
    If the voltage is not turned away from the level, the steps converge as in Newton's method.
    """
    t = start
    for _ in range(_STEPS):
        move(piece, t, volts)
        now, rate = volts[v], 0.0
        for m in range(piece.shape[1]):
            change = piece[RATE, m] * piece[NOW, m] + piece[FORCE, m] + t * piece[SLOPE, m]
            rate += (piece[WEIGHTS + v, m] * change).real
        bound, size = curvature_bound(piece, v, t), abs(now)
        distance = level - size if way == RISES else size - level
        if distance <= _CLOSE * level:
            return t
        # Rate at which the distance changes.
        rate *= math.copysign(1.0, now) * (-1.0 if way == RISES else 1.0)
        step = _safe_step(distance, rate, bound)
        if way == RISES:
            step = min(step, _safe_step(level + size, -rate, bound))
        t += max(step, _EPSILON * t)
        if t >= end:
            return -1.0
    return t


# Terms of the power series of modes that change little in a piece, and of modes below another change. The
# first omitted term belongs to the slope of the source, change^(n - 2) 2/n! of what it does.
_POWERS, _FEW, _SLOWEST = 10, 5, 1e-4


def empty_series(states: int, voltages: int) -> Complex:
    """Voltages over a piece without values yet, for a number of states of the circuit.

    Row 0 has the number of powers and of exponentials in its first columns, and then the rates of the
    exponentials. Voltage v is the sum of the powers in the first columns of row 1 + v, each times t^k, and of
    the real parts of the amplitudes after them times exp(rate t), shape (1 + voltages, 10 + modes).
    """
    return np.zeros((1 + voltages, _POWERS + states + FURTHER), dtype=np.complex128)


@inner
def unfold(piece: Complex, duration: float, series: Complex) -> None:
    """Write the voltages over a piece as a power series and exponentials, by which many times are quick.

    A mode that changes little in the duration goes into the series, with an error below 2e-14 of its size; of
    another one the series has the steady part.
    """
    rows, count, most = series.shape[0], _POWERS, 2
    for k in range(rows * _POWERS):
        series[k // _POWERS, k % _POWERS] = 0.0
    for m in range(piece.shape[1]):
        rate, start, force, slope = piece[RATE, m], piece[START, m], piece[FORCE, m], piece[SLOPE, m]
        if start == 0.0 and force == 0.0 and slope == 0.0:
            continue
        change = (abs(rate.real) + abs(rate.imag)) * duration
        terms, first, second = _FEW if change < _SLOWEST else _POWERS, start, rate * start + force
        if change >= SERIES:
            rising = slope / rate
            steady = (force + rising) / rate
            for v in range(1, rows):
                series[v, count] = piece[WEIGHTS - 1 + v, m] * (start + steady)
            series[0, count] = rate
            count += 1
            terms, first, second = 2, -steady, -rising
        most = terms if terms > most else most
        term = first
        for k in range(terms):
            if k > 0:
                term = second if k == 1 else (rate * term + (slope if k == 2 else 0j)) / k
            for v in range(1, rows):
                series[v, k] += (piece[WEIGHTS - 1 + v, m] * term).real
    series[0, 0], series[0, 1] = most, count


@inner
def all_at(series: Complex, t: float, volts: Array) -> None:
    """Write all voltages at a time t of the piece [V]."""
    powers, count = int(series[0, 0].real), int(series[0, 1].real)
    for v in range(volts.size):
        value = 0.0
        for k in range(powers - 1, -1, -1):
            value = value * t + series[1 + v, k].real
        volts[v] = value
    for m in range(_POWERS, count):
        rate = series[0, m]
        if rate.real * t > LOWEST:
            grown = math.exp(rate.real * t)
            cosine, sine = 1.0, 0.0
            if rate.imag != 0.0:
                cosine, sine = math.cos(rate.imag * t), math.sin(rate.imag * t)
            for v in range(volts.size):
                weight = series[1 + v, m]
                volts[v] += grown * (weight.real * cosine - weight.imag * sine)
