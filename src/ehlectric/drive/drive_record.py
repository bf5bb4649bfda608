"""Record of a simulated time: events, histograms and spectrum, and rates and spreads of the events."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import scipy

from ehlectric.arrays import Array
from ehlectric.bearing import BearingResult
from ehlectric.cases.drive_case import DriveCase
from ehlectric.drive.drive_bearings import BearingElement
from ehlectric.quantities.field_metadata import stored
from ehlectric.quantities.result_warnings import ResultWarning

# Columns of an event: begin and end [s], number of the film, voltage at breakdown [V], charge [C], energy
# [J], largest current [A], and position of the elements.
ON, OFF, FILM, VOLTAGE, CHARGE, ENERGY, PEAK, PLACE = range(8)
COLUMNS = 8

# Columns of the values of an event that tables and summaries have, by their names there.
VALUES = {"voltage": VOLTAGE, "charge": CHARGE, "energy": ENERGY, "peak_current": PEAK}

# Text of the progress while time is simulated.
SIMULATING = "simulating"

# Events that are kept one by one; of all others only counts and sums are.
KEPT = 200_000


# Voltage that a file of version 1.0.0 does not have, NaN in its result.
_LATER = stored("", "V", "finite or NaN", needed=False)


@dataclass(frozen=True, eq=False)
class Record:
    """Record of a simulated time: a drive has two films, and an axle any number."""

    duration: float = field(metadata=stored("", "s", "positive"))  # time that was measured [s]
    # The first events of both films, a row for each with the columns above; times from the start of the
    # measured time, shape (m, 8).
    events: Array
    # Number of events of each film in equal blocks of time, shape (2, blocks).
    counts: np.ndarray = field(metadata=stored("bearing block", None, "whole", name="block_events"))
    # sums and largest: sums, and largest absolute values, of the columns of the events of each film,
    # shape (2, 8).
    sums: Array = field(metadata=stored("bearing column", None, "not negative", name="event_sum"))
    largest: Array = field(metadata=stored("bearing column", None, "not negative", name="event_largest"))
    # Edges of the bins of the histogram [V], shape (bins + 1,).
    edges: Array = field(metadata=stored("edge", "V", "increasing", name="voltage_edge"))
    # Time at the voltages of each bin [s], shape (2, bins).
    histogram: Array = field(metadata=stored("bearing bin", "s", "not negative", name="time_at_voltage"))
    limits: Array  # limits of the voltage [V], shape (l,)
    # Time above each limit [s], shape (2, l).
    above: Array = field(metadata=stored("bearing limit", "s", "not negative", name="time_above"))
    # peak and rms: largest and root mean square voltage across each film [V], shape (2,).
    peak: Array = field(metadata=stored("bearing", "V", "not negative", name="peak_voltage"))
    rms: Array = field(metadata=stored("bearing", "V", "not negative", name="rms_voltage"))
    # Absolute mean of the shaft voltage, and amplitudes of its lines at whole multiples of one over the
    # duration [V]; empty where a file of version 1.0.0 has none, shape (lines,).
    spectrum: Array = field(
        metadata=stored("line", "V", "not negative", name="line_amplitude", count="line_count", needed=False)
    )
    # Largest voltage across each film while its asperities touch [V], shape (2,).
    touching: Array = field(metadata=stored("bearing", "V", "not negative", name="touching_voltage"))
    # Time for which an arc burnt in each film, with arcs that burnt before and after [s], shape (2,).
    burning: Array = field(metadata=stored("bearing", "s", "not negative", name="burning_time"))
    # Time [s], voltage of the source without its ringing, voltage across each film, and voltage of each shaft
    # [V], in a short stretch; straight between the rows, shape (m, 2 + films + shafts). The record of a drive
    # has only the columns of both films.
    trace: Array
    # Number of events of each film at a positive voltage of the shaft, shape (2,).
    positive: Array = field(
        default_factory=lambda: np.full(2, math.nan),
        metadata=stored("bearing", None, "not negative or NaN", name="positive_events", needed=False),
    )
    # Voltage of the shaft against the frame over the measured time: mean, root mean square, lowest and
    # highest one; and lowest and highest voltage of the source without its ringing [V].
    shaft_mean: float = field(default=math.nan, metadata=_LATER)
    shaft_rms: float = field(default=math.nan, metadata=_LATER)
    shaft_lowest: float = field(default=math.nan, metadata=_LATER)
    shaft_highest: float = field(default=math.nan, metadata=_LATER)
    source_lowest: float = field(default=math.nan, metadata=_LATER)
    source_highest: float = field(default=math.nan, metadata=_LATER)
    # The same four values of each shaft against the frame [V], shape (shafts, 4).
    shafts: Array = field(default_factory=lambda: np.zeros((0, 4)))


# Probability that a rate lies within its bounds.
CONFIDENCE = 0.95

# Events below which a rate is called uncertain.
FEW = 20


@dataclass(frozen=True)
class Rate:
    """Rate of events and its bounds [1/s]."""

    mean: float
    low: float
    high: float


def event_rate(counts: Array, duration: float) -> Rate:
    """Rate of events with bounds of 95 % probability, from their numbers in equal blocks of time. ``counts``,
    numbers of events in the blocks, shape (blocks,); ``duration``, length of all blocks together [s].

    The bounds are the wider ones of two: the bounds of a Poisson process with this number of events (F.
    Garwood, Biometrika 28 (1936) 437, doi:10.1093/biomet/28.3-4.437), which also hold without events, and the
    bounds of Student's distribution of the blocks, which hold for events that follow from each other.

    Examples
    --------
    No event in 2 s: the rate is less than 1.84/s, as -ln(0.025) = 3.69.

    >>> rate = event_rate(np.zeros(10), 2.0)
    >>> rate.mean, rate.low, round(rate.high, 2)
    (0.0, 0.0, 1.84)
    """
    total, blocks, outside = float(np.sum(counts)), counts.size, 0.5 * (1.0 - CONFIDENCE)
    low = float(scipy.special.gammaincinv(total, outside)) if total else 0.0
    high = float(scipy.special.gammaincinv(total + 1.0, 1.0 - outside))
    error = float(np.std(counts, ddof=1)) / math.sqrt(blocks) if blocks > 1 else 0.0
    student = float(scipy.special.stdtrit(max(blocks - 1, 1), 1.0 - outside)) * error * blocks
    return Rate(
        mean=total / duration,
        low=max(min(low, total - student), 0.0) / duration,
        high=max(high, total + student) / duration,
    )


def spread(values: Array, mean: float | None, largest: float | None) -> dict[str, float | None]:
    """Mean, median, 95th percentile ("high") and largest value of events; None where no event is known.

    ``values``, values of events, or of a part of them, from which the percentiles follow, shape (m,);
    ``mean`` and ``largest``, mean and largest value of all events; None without an event.

    Examples
    --------
    >>> spread(np.array([1.0, 2.0, 3.0]), 2.0, 3.0)
    {'mean': 2.0, 'median': 2.0, 'high': 2.9, 'largest': 3.0}
    """
    median, high = np.percentile(values, [50.0, 95.0]).tolist() if values.size else (None, None)
    return {"mean": mean, "median": median, "high": high, "largest": largest}


# Ends of the keys of a rate and of its bounds, by the names of its fields.
BOUNDS: Mapping[str, str] = {"mean": "", "low": "_low", "high": "_high"}


def rates(counts: Array, duration: float) -> dict[str, float]:
    """Rate of discharges with its bounds of 95 % by their keys; arguments as for ``event_rate``."""
    rate = event_rate(counts, duration)
    return {f"events_per_second{bound}": getattr(rate, name) for name, bound in BOUNDS.items()}


def statistics(record: Record, b: int, columns: Mapping[str, int]) -> dict[str, float | None]:
    """Statistics of the events of a film, by the names of their ``columns`` in the record."""
    count, rows = int(np.sum(record.counts[b])), record.events[record.events[:, FILM] == b]
    values: dict[str, float | None] = {}
    for name, column in columns.items():
        mean = float(record.sums[b, column]) / count if count else None
        largest = float(record.largest[b, column]) if count else None
        of_events = spread(np.abs(rows[:, column]), mean, largest)
        values |= {f"{name}_{key}": value for key, value in of_events.items()}
    return values


def film_row(record: Record, b: int) -> dict[str, Any]:
    """Row of a film: rate of its discharges with bounds, their power and statistics, and its voltages."""
    counts, duration = record.counts[b], record.duration
    return {
        **_rate_row(counts, float(record.sums[b, ENERGY]), duration),
        "peak_voltage": float(record.peak[b]),
        "rms_voltage": float(record.rms[b]),
        **statistics(record, b, VALUES),
    }


def whole_row(record: Record) -> dict[str, Any]:
    """Row of all films together: rate of their discharges with bounds, and their power."""
    total = float(np.sum(record.sums[:, ENERGY]))
    return _rate_row(np.sum(record.counts, axis=0), total, record.duration)


def shaft_row(mean: float, rms: float, lowest: float, highest: float) -> dict[str, float]:
    """Row of a shaft from its voltages against the housing [V]."""
    return {
        "rms_voltage": rms,
        "mean_voltage": mean,
        "lowest_voltage": lowest,
        "highest_voltage": highest,
        "peak_voltage": max(abs(lowest), abs(highest)),
        "peak_to_peak": highest - lowest,
    }


def _rate_row(counts: Array, energy: float, duration: float) -> dict[str, Any]:
    return {"events": int(np.sum(counts)), **rates(counts, duration), "power": energy / duration}


# Columns of a record by the names of the table of events.
_RECORDED = {"time": ON, "duration": OFF, **VALUES}


def event_rows(record: Record, head: str, names: Sequence[str]) -> list[dict[str, Any]]:
    """Discharges in the order of time, SI units; ``head``, column with the name of the film of each."""
    rows = []
    for row in record.events[np.argsort(record.events[:, ON], kind="stable")]:
        values = {name: float(row[column]) for name, column in _RECORDED.items()}
        values["duration"] -= values["time"]
        rows.append({head: names[int(row[FILM])], **values})
    return rows


@dataclass(frozen=True, eq=False)
class DriveSolution:
    """Solved drive."""

    case: DriveCase
    elements: tuple[BearingElement, BearingElement]
    record: Record  # what happened over time
    # Voltage across the films of each bearing per volt of the source, right after an edge.
    divider: tuple[float, float] = field(metadata=stored("bearing", "", "not negative"))
    # Largest absolute voltage of the source [V].
    highest_source: float = field(metadata=stored("", "V", "not negative"))
    # Whether the films of both bearings are converged.
    converged: bool = field(default=True, metadata=stored("", None, "0 or 1", dtype="i1"))
    prior_warnings: tuple[
        ResultWarning, ...
    ] = ()  # warnings about the file of a measured source, and of the bearings
    # Rating lives at both ends, as in the table ``life`` of a bearing; empty for a file of version 1.0.
    lives: tuple[Mapping[str, Any], ...] = ()
    # Solved bearings at both ends; none in a loaded result, whose file does not hold them.
    bearings: tuple[BearingResult, ...] = field(default=(), compare=False)

    def contact_current(self, b: int) -> float:
        """Largest current through asperities of a bearing that touch [A]."""
        return float(self.record.touching[b]) / self.elements[b].touch_resistance

    def largest_current(self, b: int) -> float:
        """Largest current through the films of a bearing, by an arc or through asperities [A]."""
        return max(float(self.record.largest[b, PEAK]), self.contact_current(b))
