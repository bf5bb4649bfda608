"""Summary of a drive, as in summary.json."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from ehlectric.bearing import KEYS as LIFE_KEYS
from ehlectric.bearing import film_error, life_summary
from ehlectric.cases.axle_keys import LOADS
from ehlectric.cases.drive_case import DriveCase
from ehlectric.discharge.discharge_laws import CURRENT_DENSITY_LIMITS
from ehlectric.drive.drive_bearings import BearingElement
from ehlectric.drive.drive_record import (
    BOUNDS,
    FILM,
    OFF,
    ON,
    DriveSolution,
    Record,
    film_row,
    shaft_row,
    spread,
    whole_row,
)
from ehlectric.drive.inverter import edge_rate
from ehlectric.drive.verdict_rule import drive_verdict
from ehlectric.quantities.former_keys import with_former_keys
from ehlectric.quantities.inputs import ENDS
from ehlectric.quantities.result_warnings import ResultWarning, texts_and_codes
from ehlectric.quantities.results import DRIVE_BOOK
from ehlectric.runtime.files import plain

if TYPE_CHECKING:
    from ehlectric.drive.drive_cycle import DriveDuty
    from ehlectric.drive.preparation import PreparedDrive

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
        **whole_row(record),
    }
    tables = _tables(case, solution.highest_source, drive, ends)
    tables["source"] |= plain({"peak_to_peak": record.source_highest - record.source_lowest})
    row = shaft_row(record.shaft_mean, record.shaft_rms, record.shaft_lowest, record.shaft_highest)
    return {**tables, "shaft": plain({key: row[key] for key in _OF_SHAFT})}


# Keys of the shaft.
_OF_SHAFT = ("rms_voltage", "mean_voltage", "highest_voltage", "lowest_voltage", "peak_to_peak")


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
    case, record, bearing = solution.case, solution.record, solution.elements[b]
    peak = float(record.peak[b])
    values = {
        **_film(case, bearing, ENDS[b]),
        "voltage_ratio": solution.divider[b],
        "waveform_ratio": peak / solution.highest_source,
        "burning_time_share": float(record.burning[b]) / record.duration,
        "time_above": {
            f"{limit:g}": float(time) / record.duration
            for limit, time in zip(record.limits, record.above[b], strict=True)
        },
        **_events(record, b, edges_per_second(case)),
        **_densities(solution, b),
        "life": dict(solution.lives[b]) if solution.lives else dict.fromkeys(LIFE_KEYS),
    }
    return with_former_keys(values, "end", DRIVE_BOOK)


def _film(case: DriveCase, bearing: BearingElement, end: str) -> dict[str, Any]:
    """Loads of the bearing at an end, and its films as an element of the circuit."""
    breakdown = float(np.min(bearing.breakdown))
    finite = math.isfinite(bearing.shape) and math.isfinite(breakdown)
    return {
        **{load: getattr(getattr(case, end).bearing, load) for load in LOADS},
        "capacitance": bearing.mean_capacitance,
        "conductance": bearing.conductance,
        "breakdown_voltage": breakdown if math.isfinite(breakdown) else None,
        "weibull_shape": bearing.shape if finite else None,
        "renewal_time": (case.breakdown.renewal_time or bearing.transit) if finite else None,
        "contact_time_share": bearing.touching,
    }


def checked_summary(ready: PreparedDrive) -> dict[str, Any]:
    """Summary of a drive that is not simulated, with the kind of its contacts and the error of its films."""
    case, highest = ready.case, ready.source.highest
    ends = {
        end: with_former_keys(
            {
                **_film(case, bearing, end),
                "voltage_ratio": ratio,
                "voltage_at_peak": ratio * highest,
                "films": result.case.contacts,
                "films_error": film_error(result.solution),
                "life": life_summary(result.solution),
            },
            "end",
            DRIVE_BOOK,
        )
        for end, bearing, ratio, result in zip(
            ENDS, ready.elements, ready.divider, ready.bearings, strict=True
        )
    }
    drive = {"duration": ready.source.duration, "remedies": len(case.numbered_remedies)}
    return {**_tables(case, highest, drive, ends), "inputs": case.all_inputs()}


def _events(record: Record, b: int, edges: float | None) -> dict[str, Any]:
    """Rate and distributions of the events of a film."""
    count, rows = int(np.sum(record.counts[b])), record.events[record.events[:, FILM] == b]
    values: dict[str, Any] = {
        **film_row(record, b),
        "events_per_second_positive": float(record.positive[b]) / record.duration,
        "events_per_second_negative": (count - float(record.positive[b])) / record.duration,
        "events_per_edge": None if edges is None else count / record.duration / edges,
    }
    lasting = rows[:, OFF] - rows[:, ON]
    mean = float(record.sums[b, OFF] - record.sums[b, ON]) / count if count else None
    times = spread(lasting, mean, float(np.max(lasting, initial=0.0)) if count else None)
    return values | {f"time_{key}": value for key, value in times.items()}


def _densities(solution: DriveSolution, b: int) -> dict[str, Any]:
    """Largest currents of a film, and their current densities."""
    bearing = solution.elements[b]
    peak, through = solution.largest_current(b), solution.contact_current(b)
    return {
        "contact_current": through,
        "real_area": bearing.real_area or None,
        "real_current_density": through / bearing.real_area if through and bearing.real_area else None,
        "hertz_area": bearing.hertz_area,
        "current_density": peak / bearing.hertz_area if peak and bearing.hertz_area else None,
        "element_current_density": peak / bearing.largest_area if peak and bearing.largest_area else None,
        "current_density_limits": list(CURRENT_DENSITY_LIMITS),
    }


def with_cycle(tables: dict[str, Any], duty: DriveDuty) -> dict[str, Any]:
    """Return the tables of a drive with the values of its duty cycle."""
    ends = {end: tables[end] | plain(duty.end_summary(b)) for b, end in enumerate(ENDS)}
    return {**tables, "duty": plain(duty.summary()), **ends}


# Keys of the tables "drive" and "duty" that a remedy has: sums of both bearings.
_OF_BOTH = ("events", *(f"events_per_second{bound}" for bound in BOUNDS.values()), "power")
_OF_CYCLE = ("discharges", "energy", "left_out_share")


def _remedy_tables(of_remedy: Mapping[str, Any]) -> dict[str, Any]:
    """Tables of a remedy, from the tables of its drive: both bearings, and their sums."""
    tables = {end: of_remedy[end] for end in ENDS} | {
        "drive": {key: of_remedy["drive"][key] for key in _OF_BOTH}
    }
    if "duty" in of_remedy:
        tables["duty"] = {key: of_remedy["duty"][key] for key in _OF_CYCLE}
    return tables


def whole_summary(
    solution: DriveSolution,
    remedies: Sequence[tuple[str, dict[str, Any], dict[str, Any]]],
    warnings: Sequence[ResultWarning],
    seconds: float,
    version: str,
) -> dict[str, Any]:
    """Whole summary of a drive: head, tables and tables of its remedies. ``seconds`` is the computing time
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
        **verdict.as_data(),
        "level": verdict.level,
        "inputs": solution.case.all_inputs(),
        **tables,
        "remedies": [
            {"title": title, "changes": changes, **_remedy_tables(of_remedy)}
            for title, changes, of_remedy in remedies
        ],
        "seconds": seconds,
    }
