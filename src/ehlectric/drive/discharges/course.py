"""Voltages over a piece as a power series and exponentials, for many times of it; compiled. SI units."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ehlectric.arrays import Array
from ehlectric.drive.discharges.compiled import inner
from ehlectric.drive.discharges.pieces import (
    FILMS,
    FORCE,
    LOWEST,
    RATE,
    SERIES,
    SLOPE,
    START,
    VOLTAGES,
    Complex,
)

# Terms of the power series of modes that change little in a piece, and of those below another change. The
# first term that is left out is that of the slope of the source, change^(n - 2) 2/n! of what it does.
_POWERS, _FEW, _SLOWEST = 10, 5, 1e-4


class Course(NamedTuple):
    """Voltages over a piece, as a power series and exponentials; changed in place.

    Voltage b, across one of both films or of the shaft, is the sum of ``powers[b, k] t^k``, and of the real
    parts of ``amplitudes[b, m] exp(rates[m] t)`` of the first ``number[0]`` rates; the first ``number[1]``
    powers count.
    """

    powers: Array
    rates: Complex
    amplitudes: Complex
    number: NDArray[np.int64]


def course_of(modes: int) -> Course:
    """Empty course of a number of modes."""
    return Course(
        np.zeros((VOLTAGES, _POWERS)),
        np.zeros(modes, dtype=np.complex128),
        np.zeros((VOLTAGES, modes), dtype=np.complex128),
        np.zeros(2, dtype=np.int64),
    )


@inner
def unfold(piece: Complex, duration: float, course: Course) -> None:
    """Write the voltages over a piece as a power series and exponentials, by which many times are quick.

    A mode that hardly changes in the duration goes into the series, with an error below 2e-14 of its size; of
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
            own, term = _FEW if change < _SLOWEST else _POWERS, start
            powers = max(powers, own)
            for k in range(own):
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
def all_at(course: Course, t: float) -> tuple[float, float, float]:
    """Voltages across both films, and of the shaft, at a time t of the piece [V]."""
    first, second, shaft = 0.0, 0.0, 0.0
    for k in range(course.number[1] - 1, -1, -1):
        first, second = first * t + course.powers[0, k], second * t + course.powers[1, k]
        shaft = shaft * t + course.powers[2, k]
    for m in range(course.number[0]):
        rate, one, other = course.rates[m], course.amplitudes[0, m], course.amplitudes[1, m]
        third = course.amplitudes[2, m]
        if rate.real * t > LOWEST:
            grown = math.exp(rate.real * t)
            if rate.imag == 0.0:
                first, second = first + one.real * grown, second + other.real * grown
                shaft += third.real * grown
            else:
                cosine, sine = math.cos(rate.imag * t), math.sin(rate.imag * t)
                first += grown * (one.real * cosine - one.imag * sine)
                second += grown * (other.real * cosine - other.imag * sine)
                shaft += grown * (third.real * cosine - third.imag * sine)
    return first, second, shaft


@inner
def course_at(course: Course, b: int, t: float) -> float:
    """Voltage b, across a film or of the shaft, at a time t of the piece [V]."""
    value = 0.0
    for k in range(course.number[1] - 1, -1, -1):
        value = value * t + course.powers[b, k]
    for m in range(course.number[0]):
        rate, size = course.rates[m], course.amplitudes[b, m]
        if rate.real * t > LOWEST:
            grown = math.exp(rate.real * t)
            if rate.imag == 0.0:
                value += size.real * grown
            else:
                angle = rate.imag * t
                value += grown * (size.real * math.cos(angle) - size.imag * math.sin(angle))
    return value
