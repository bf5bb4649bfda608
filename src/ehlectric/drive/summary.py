"""Summary of a drive, as in summary.json."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from ehlectric.bearing.solution import film_error
from ehlectric.cases.drive_case import DriveCase
from ehlectric.discharge.discharge_laws import CURRENT_DENSITY_LIMITS
from ehlectric.drive.drive_bearings import BearingElement
from ehlectric.drive.drive_record import (
    ENERGY,
    FILM,
    OFF,
    ON,
    VALUES,
    DriveSolution,
    Record,
    event_rate,
    spread,
)
from ehlectric.drive.drive_verdict import drive_verdict
from ehlectric.drive.inverter import edge_rate
from ehlectric.errors import ResultWarning, texts_and_codes
from ehlectric.quantities.inputs import ENDS
from ehlectric.runtime.files import plain

if TYPE_CHECKING:
    from ehlectric.drive.solver import PreparedDrive

SCHEMA = "ehlectric.drive/1"


def drive_summary(solution: DriveSolution) -> dict[str, Any]:
    """Summary of a drive without its head and its remedies: its source, its circuit and both bearings."""
    case, record = solution.case, solution.record
    ends = {end: end_summary(solution, b) for b, end in enumerate(ENDS)}
    fundamental = case.running_source.fundamental_frequency
    drive = {
        "duration": record.duration,
        "periods": None if fundamental is None else record.duration * fundamental,
        "seed": case.drive.seed,
        **{key: sum(one[key] for one in ends.values()) for key in ("events", "events_per_second", "power")},
    }
    tables = _tables(case, solution.highest_source, drive, ends)
    tables["source"] |= plain({"peak_to_peak": record.source_highest - record.source_lowest})
    shaft = {
        "rms_voltage": record.shaft_rms,
        "mean_voltage": record.shaft_mean,
        "highest_voltage": record.shaft_highest,
        "lowest_voltage": record.shaft_lowest,
        "peak_to_peak": record.shaft_highest - record.shaft_lowest,
    }
    return {**tables, "shaft": plain(shaft)}


def _tables(
    case: DriveCase, highest: float, drive: Mapping[str, Any], ends: Mapping[str, Any]
) -> dict[str, Any]:
    """Tables of a drive: its source with the highest voltage [V], circuit, operation, and both bearings."""
    running, bearing = case.running_source, case.bearings[0].bearing
    circuit = dict(case.circuit.capacitances)
    if (ring := case.running_circuit.grounding_ring_resistance) is not None:
        circuit["grounding_ring_resistance"] = ring
    tables: dict[str, Any] = plain(
        {
            "source": {
                "peak": highest,
                "edges_per_second": edges_per_second(case),
                "fundamental_frequency": running.fundamental_frequency,
                "modulation_index": running.modulation_index,
            },
            "circuit": circuit,
            "drive": {"speed": bearing.inner_speed, "temperature": bearing.oil_temperature, **drive},
            **ends,
        }
    )
    return tables


def edges_per_second(case: DriveCase) -> float | None:
    """Steps of the common-mode voltage in a second [1/s]; None for a measured source."""
    source = case.running_source
    return None if source.measured else edge_rate(source)


def end_summary(solution: DriveSolution, b: int) -> dict[str, Any]:
    """Summary of the bearing at one end: its film, its voltage, and its events."""
    case, record, one = solution.case, solution.record, solution.elements[b]
    peak = float(record.peak[b])
    return {
        **_film(case, one),
        "voltage_ratio": solution.divider[b],
        "waveform_ratio": peak / solution.highest_source,
        "peak_voltage": peak,
        "rms_voltage": float(record.rms[b]),
        "burning_time_share": float(record.burning[b]) / record.duration,
        "time_above": {
            f"{limit:g}": float(time) / record.duration
            for limit, time in zip(record.limits, record.above[b], strict=True)
        },
        **_events(record, b, edges_per_second(case)),
        **_densities(solution, b),
    }


def _film(case: DriveCase, one: BearingElement) -> dict[str, Any]:
    """Films of a bearing as an element of the circuit."""
    breakdown = float(np.min(one.breakdown))
    finite = math.isfinite(one.shape) and math.isfinite(breakdown)
    return {
        "capacitance": one.mean_capacitance,
        "conductance": one.conductance,
        "breakdown_voltage": breakdown if math.isfinite(breakdown) else None,
        "weibull_shape": one.shape if finite else None,
        "renewal_time": (case.breakdown.renewal_time or one.transit) if finite else None,
        "touching_time_share": one.touching,
    }


def checked_summary(ready: PreparedDrive) -> dict[str, Any]:
    """Summary of a drive that is not simulated, with the kind of its contacts and the error of its films."""
    case, highest = ready.case, ready.highest_source
    ends = {
        end: {
            **_film(case, one),
            "voltage_ratio": ratio,
            "voltage_at_peak": ratio * highest,
            "films": result.case.contacts,
            "films_error": film_error(result.solution),
        }
        for end, one, ratio, result in zip(ENDS, ready.elements, ready.divider, ready.bearings, strict=True)
    }
    drive = {"duration": ready.duration, "remedies": len(case.remedies)}
    return {**_tables(case, highest, drive, ends), "inputs": case.to_dict()}


def _events(record: Record, b: int, edges: float | None) -> dict[str, Any]:
    """Rate and distributions of the events of a film."""
    rate, count = event_rate(record.counts[b], record.duration), int(np.sum(record.counts[b]))
    own = record.events[record.events[:, FILM] == b]
    found: dict[str, Any] = {
        "events": count,
        "events_per_second": rate.mean,
        "events_per_second_low": rate.low,
        "events_per_second_high": rate.high,
        "events_per_second_positive": float(record.positive[b]) / record.duration,
        "events_per_second_negative": (count - float(record.positive[b])) / record.duration,
        "events_per_edge": None if edges is None else rate.mean / edges,
        "power": float(record.sums[b, ENERGY]) / record.duration,
    }
    for name, column in VALUES.items():
        total, largest = float(record.sums[b, column]), float(record.largest[b, column])
        found |= _spread(name, np.abs(own[:, column]), count, total, largest)
    lasting = own[:, OFF] - own[:, ON]
    total = float(record.sums[b, OFF] - record.sums[b, ON])
    return found | _spread("time", lasting, count, total, float(np.max(lasting, initial=0.0)))


def _spread(name: str, values: np.ndarray, count: int, total: float, largest: float) -> dict[str, Any]:
    """Statistics of a value of ``count`` events, of which the first ones are known one by one."""
    found = spread(values, total / count, largest) if count else spread(values, None, None)
    return {f"{name}_{key}": value for key, value in found.items()}


def _densities(solution: DriveSolution, b: int) -> dict[str, Any]:
    """Largest currents of a film, and their current densities."""
    one = solution.elements[b]
    peak, through = solution.largest_current(b), solution.contact_current(b)
    return {
        "contact_current": through,
        "real_area": one.real_area or None,
        "real_current_density": through / one.real_area if through and one.real_area else None,
        "hertz_area": one.hertz_area,
        "current_density": peak / one.hertz_area if peak and one.hertz_area else None,
        "element_current_density": peak / one.largest_area if peak and one.largest_area else None,
        "current_density_limits": list(CURRENT_DENSITY_LIMITS),
    }


def whole_summary(
    solution: DriveSolution,
    remedies: Sequence[tuple[str, dict[str, Any], dict[str, Any]]],
    warnings: Sequence[ResultWarning],
    seconds: float,
    version: str,
) -> dict[str, Any]:
    """Whole summary of a drive: head, tables and those of its remedies. ``seconds`` is the computing time
    [s].
    """
    tables = drive_summary(solution)
    verdict = drive_verdict(solution.case, {"converged": solution.converged, **tables}, warnings)
    return {
        "schema": SCHEMA,
        "version": version,
        "title": solution.case.title,
        "converged": solution.converged,
        **texts_and_codes(warnings),
        "verdict": verdict.text,
        "level": verdict.level,
        "inputs": solution.case.to_dict(),
        **tables,
        "remedies": [
            {"title": title, "changes": changes, **{end: found[end] for end in ENDS}}
            for title, changes, found in remedies
        ],
        "seconds": seconds,
    }
