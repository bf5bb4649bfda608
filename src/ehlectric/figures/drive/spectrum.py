"""Figure of the spectrum of the shaft voltage of a drive."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.ticker import LogLocator, NullFormatter

from ehlectric.arrays import Array
from ehlectric.drive.result import DriveResult
from ehlectric.figures.drive.looks import voltage_unit
from ehlectric.figures.style import axes_or_new
from ehlectric.quantities.palette import BLUE

# Number of points that are drawn for each decade of frequency, and part of the largest line that is drawn.
_POINTS, _LEAST = 400, 1e-6


def shaft_spectrum(result: DriveResult, ax: Axes | None = None) -> Axes:
    """Draw the amplitude spectrum of the shaft voltage, without the line at 0 Hz.

    Parameters
    ----------
    result : DriveResult
        Result of the drive to draw, with a spectrum.
    ax : Axes, optional
        Axes to draw on; axes of a new figure if omitted.

    Returns
    -------
    Axes
        Axes of both logarithms. Where lines are too close to be seen apart, the largest one is drawn.
    """
    ax = axes_or_new(ax)
    frequencies, amplitudes = highest_lines(result)
    least, most = shown_range(amplitudes)
    factor, unit = voltage_unit(float(np.max(amplitudes)))
    ax.plot(frequencies, factor * amplitudes, color=BLUE, lw=0.8)
    ax.set_xscale("log")
    ax.set_yscale("log")
    ax.set_xlim(0.8 * frequencies[0], 1.25 * frequencies[-1])
    ax.set_ylim(factor * least, factor * most)
    for axis in (ax.xaxis, ax.yaxis):
        axis.set_major_locator(LogLocator(numticks=9))
        axis.set_minor_formatter(NullFormatter())
    ax.set_xlabel("frequency [Hz]")
    ax.set_ylabel(f"amplitude of the shaft voltage [{unit}]")
    return ax


def shown_range(amplitudes: Array) -> tuple[float, float]:
    """Ends of a logarithmic axis of amplitudes, with room below the least and above the largest one."""
    return 0.5 * float(np.min(amplitudes)), 3.0 * float(np.max(amplitudes))


def has_spectrum(result: DriveResult) -> bool:
    """Whether a result has a spectrum with a line above 0 Hz to draw."""
    return bool(np.any(result.solution.record.spectrum[1:] > 0.0))


def highest_lines(result: DriveResult) -> tuple[Array, Array]:
    """Largest line of the spectrum in each of many parts of a decade of frequency.

    Returns
    -------
    frequencies, amplitudes : ndarray, shape (m,)
        Frequency [Hz] and amplitude [V] of each of these lines, in the order of frequency. Amplitudes below
        a millionth of the largest one are raised to it, so that a logarithmic axis has them.
    """
    amplitudes = result.solution.record.spectrum
    lines = np.arange(1, amplitudes.size)
    part = np.floor(_POINTS * np.log10(lines))
    starts = np.flatnonzero(np.diff(part, prepend=-1.0))
    # Largest amplitude first within each part.
    order = np.lexsort((-amplitudes[lines], part))
    kept = lines[order[starts]]
    least = _LEAST * float(np.max(amplitudes[lines]))
    return kept / result.solution.record.duration, np.maximum(amplitudes[kept], least)
