"""Record of a simulated time: events, histograms, a spectrum, and a trace of voltages. SI units."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from ehlectric.arrays import Array
from ehlectric.runtime.stored import stored

# Columns of an event: begin and end [s], number of the film, voltage at breakdown [V], charge [C], energy
# [J], largest current [A], and position of the elements.
ON, OFF, FILM, VOLTAGE, CHARGE, ENERGY, PEAK, PLACE = range(8)
COLUMNS = 8

# Events that are kept one by one; of all others only counts and sums are.
KEPT = 200_000


@dataclass(frozen=True, eq=False)
class Record:
    """Record of a simulated time.

    Attributes
    ----------
    duration : float
        Time that was measured [s].
    events : ndarray, shape (m, 8)
        The first events of both films, a row for each with the columns above; times from the begin of
        the measured time.
    counts : ndarray of int, shape (2, blocks)
        Number of events of each film in equal blocks of time.
    sums, largest : ndarray, shape (2, 8)
        Sums, and largest absolute values, of the columns of the events of each film.
    edges : ndarray, shape (bins + 1,)
        Edges of the bins of the histogram [V].
    histogram : ndarray, shape (2, bins)
        Time at the voltages of each bin [s].
    limits : ndarray, shape (l,)
        Limits of the voltage [V].
    above : ndarray, shape (2, l)
        Time above each limit [s].
    peak, rms : ndarray, shape (2,)
        Largest and root mean square voltage across each film [V].
    spectrum : ndarray, shape (lines,)
        Absolute mean of the shaft voltage, and amplitudes of its lines at whole multiples of one over the
        duration [V]; empty where a file of version 1.0.0 has none.
    touching : ndarray, shape (2,)
        Largest voltage across each film while its asperities touch [V].
    burning : ndarray, shape (2,)
        Time for which an arc burnt in each film, with arcs that burnt before and after [s].
    trace : ndarray, shape (m, 4)
        Time [s], voltage of the source without its ringing, and voltage across both films [V], in a short
        stretch; straight between the rows.
    """

    duration: float = field(metadata=stored("", "s", "positive"))
    events: Array
    counts: np.ndarray = field(metadata=stored("bearing block", None, "whole", name="block_events"))
    sums: Array = field(metadata=stored("bearing column", None, "not negative", name="event_sum"))
    largest: Array = field(metadata=stored("bearing column", None, "not negative", name="event_largest"))
    edges: Array = field(metadata=stored("edge", "V", "increasing", name="voltage_edge"))
    histogram: Array = field(metadata=stored("bearing bin", "s", "not negative", name="time_at_voltage"))
    limits: Array
    above: Array = field(metadata=stored("bearing limit", "s", "not negative", name="time_above"))
    peak: Array = field(metadata=stored("bearing", "V", "not negative", name="peak_voltage"))
    rms: Array = field(metadata=stored("bearing", "V", "not negative", name="rms_voltage"))
    spectrum: Array = field(
        metadata=stored("line", "V", "not negative", name="line_amplitude", count="line_count", needed=False)
    )
    touching: Array = field(metadata=stored("bearing", "V", "not negative", name="touching_voltage"))
    burning: Array = field(metadata=stored("bearing", "s", "not negative", name="burning_time"))
    trace: Array
