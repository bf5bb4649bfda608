"""Findings of the figures of a drive, one sentence each, and the lines about its case below them."""

from __future__ import annotations

import math
import textwrap

import numpy as np

from ehlectric.cases.drives.case import ENDS
from ehlectric.drive.result import DriveResult
from ehlectric.drive.summary import end_summary
from ehlectric.figures.bearing.impedance import prefixed
from ehlectric.figures.drive.looks import NAMES, breakdown_of, number_of_events
from ehlectric.figures.drive.remedies import variants
from ehlectric.quantities.formats import amount, number_text
from ehlectric.quantities.units import rpm

# Share of time from which on a voltage is told [%].
_TOLD = 1.0


def voltages(result: DriveResult) -> str:
    """Sentence: how often both bearings discharge, and at which voltages; or why none does."""
    ends = _ends(result)
    if not any(end["events"] for end in ends):
        return f"No discharge in {_duration(result)}: {_largest(result)}{_limit(result)}"
    rates = " and ".join(
        f"{number_text(end['events_per_second'])} ({name})" for end, name in zip(ends, NAMES, strict=True)
    )
    mean = max(end["voltage_mean"] for end in ends if end["events"])
    return f"{rates} discharges a second, mean {mean:.3g} V"


def histogram(result: DriveResult) -> str:
    """Sentence: for which share of time the bearing voltages are above the largest limit that matters."""
    record = result.solution.record
    shares = 100.0 * record.above / record.duration
    told = np.flatnonzero(np.max(shares, axis=0) >= _TOLD)
    if not told.size:
        share = float(np.max(shares[:, 0]))
        lead = (
            f"Above {record.limits[0]:g} V for {share:.2g} % of the time" if share else "Low bearing voltage"
        )
        return f"{lead}: {_largest(result)}"
    k = int(told[-1])
    texts = [f"{share:.3g} %" for share in shares[:, k]]
    if len(set(texts)) == 1:
        return f"Voltage of both bearings above {record.limits[k]:g} V for {texts[0]} of the time"
    told_of = " and ".join(f"{text} ({name})" for text, name in zip(texts, NAMES, strict=True))
    return f"Above {record.limits[k]:g} V for {told_of} of the time"


def spectrum(result: DriveResult) -> str:
    """Sentence: the largest line of the shaft voltage, and the spacing of the lines."""
    record = result.solution.record
    line = 1 + int(np.argmax(record.spectrum[1:]))
    largest, at = prefixed(float(record.spectrum[line]), "V"), prefixed(line / record.duration, "Hz")
    spacing = prefixed(1.0 / record.duration, "Hz")
    return f"Largest line of the shaft voltage {largest} at {at}; lines every {spacing}"


def discharges(result: DriveResult) -> str:
    """Sentence: mean energy of the discharges of each bearing, and the largest one."""
    ends = _ends(result)
    means = ", ".join(
        f"{_energy(end['energy_mean'])} ({name})" if end["events"] else f"none ({name})"
        for name, end in zip(NAMES, ends, strict=True)
    )
    largest = max(end["energy_largest"] for end in ends if end["events"])
    return f"Mean energy of a discharge {means}; largest {_energy(largest)}"


def remedies(result: DriveResult) -> str:
    """Sentence: which remedy has the fewest discharges, beside those of the drive as it is."""
    (_, own), *others = variants(result)
    rates = [sum(end["events_per_second"] for end in pair) for _, pair in others]
    least, now = min(rates), sum(end["events_per_second"] for end in own)
    best = [name for (name, _), rate in zip(others, rates, strict=True) if rate == least]
    if not now + max(rates):
        highest = max(
            end["events_per_second_high"] for pair in (own, *(pair for _, pair in others)) for end in pair
        )
        return f"No discharge, with or without remedies: at most {number_text(highest)} a second"
    if not least < now:
        return f"No remedy lowers the {number_text(now)} discharges a second of both bearings"
    names = " and ".join(textwrap.shorten(name, 40, placeholder=" ...") for name in best[:3])
    if not least:
        return f"No discharge with {names}; {number_text(now)} a second as it is"
    left = "leaves" if len(best) == 1 else "leave"
    return f"{names} {left} {number_text(least)} of the {number_text(now)} discharges a second"


def case_lines(result: DriveResult) -> list[str]:
    """Lines: title of the case, speed, temperature and simulated time."""
    bearing, title = result.case.bearings[0].bearing, result.case.title
    parts = [
        textwrap.shorten(title, 70, placeholder=" ..."),
        f"{rpm(bearing.inner_speed):.4g} rpm",
        f"{bearing.oil_temperature - 273.15:.4g} °C",
        f"{_duration(result)} simulated",
    ]
    return [", ".join(filter(None, parts))]


def arc_line(result: DriveResult) -> str:
    """Line: what charges, energies and currents rest on."""
    arc, kept = result.case.breakdown.arc_resistance, len(result.solution.record.events)
    text = f"charges, energies and currents follow from an arc of {amount(arc, 'Ω')}, which is an assumption"
    if kept < sum(number_of_events(result, b) for b in range(len(ENDS))):
        text += f"; of the first {kept} discharges"
    return text


def _energy(value: float) -> str:
    return prefixed(value, "J")


def _largest(result: DriveResult) -> str:
    """Clause: the largest bearing voltage."""
    peaks = result.solution.record.peak
    b = int(np.argmax(peaks))
    return f"at most {prefixed(float(peaks[b]), 'V')} ({NAMES[b]})"


def _limit(result: DriveResult) -> str:
    """Clause: the lowest voltage at which films break down."""
    breakdown = min(breakdown_of(result, b) for b in range(len(ENDS)))
    return f", films break down at {breakdown:.3g} V" if math.isfinite(breakdown) else ""


def _ends(result: DriveResult) -> list[dict[str, float]]:
    return [end_summary(result.solution, b) for b in range(len(ENDS))]


def _duration(result: DriveResult) -> str:
    return amount(result.solution.record.duration, "s")
