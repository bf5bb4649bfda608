"""Spectrum of a voltage that is known as parabolas over time: its means over short times, and its lines."""

from __future__ import annotations

import math

import numpy as np

from ehlectric.arrays import Array
from ehlectric.drive.discharges.compiled import inner

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

    Parameters
    ----------
    means : ndarray, shape (n,)
        Means at evenly spaced times; the time after the last one is that of the first one again.
    start, duration : float
        Where the parabola begins, and how long it goes on, in spacings of the means.
    first, middle, last : float
        Voltage at its begin, in its middle and at its end [V].
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
    """Amplitudes of the lines of a spectrum from triangular means.

    Parameters
    ----------
    means : ndarray, shape (n,)
        Means of a voltage at evenly spaced times of the measured one [V].

    Returns
    -------
    ndarray, shape (n/8 + 1,)
        Absolute mean, and the amplitudes of the lines at whole multiples of one over the measured time [V].

    Notes
    -----
    A triangular mean multiplies the Fourier coefficient of line m by sinc(m/n)^2, with
    sinc(x) = sin(pi x)/(pi x), which is divided out. Sampling adds the coefficients of lines n - m, n + m and
    so on; that of line n - m has the weight (m/(n - m))^2.

    Examples
    --------
    Means of 1 V and a cosine of 2 V with three periods in the measured time:

    >>> time = np.arange(80) / 80.0
    >>> means = 1.0 + 2.0 * np.sinc(3.0 / 80.0) ** 2 * np.cos(6.0 * np.pi * time)
    >>> spectrum_of(means).round(6)[:5].tolist()
    [1.0, 0.0, 0.0, 2.0, 0.0]
    """
    lines = np.arange(means.size // _MEANS + 1)
    found = np.fft.rfft(means)[: lines.size] / means.size
    amplitudes: Array = np.where(lines > 0, 2.0, 1.0) * np.abs(found) / np.sinc(lines / means.size) ** 2
    return amplitudes
