"""Warnings about the result of a drive."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

import numpy as np

from ehlectric.arrays import Array
from ehlectric.bearing import BearingResult, conducts, lambda_text
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.cases.drive_case import NOT_IN_DRIVES, NOT_OF_DISCHARGES, DriveCase, NetworkCase
from ehlectric.cases.drive_inputs import Circuit
from ehlectric.cases.plausibility import unusual_machine
from ehlectric.discharge.discharge_laws import CURRENT_DENSITY_LIMITS, compared_with_limits
from ehlectric.drive.drive_bearings import BearingElement
from ehlectric.drive.drive_record import FEW, FILM, ON, DriveSolution
from ehlectric.drive.films_in_time import network_of_ends
from ehlectric.drive.network import Network
from ehlectric.quantities.formats import amount, rpm_text
from ehlectric.quantities.inputs import ENDS
from ehlectric.quantities.result_warnings import ResultWarning, active
from ehlectric.quantities.unused_keys import given_keys, unused_note

# Share of time from which films are said to conduct on.
MOSTLY = 0.2

# Quality factor from which an oscillation of the circuit is called almost undamped: it rings for more than
# a hundred periods.
_UNDAMPED = 300.0

# An oil that discharges the films within so many periods of the inverter is expected to have an effect, and
# one that takes so many times an edge has none at the edge.
_PERIODS, _SLOWER = 10.0, 10.0

# Time constants after which an arc has drained the shaft, and share of the discharges from which both ends
# are said to discharge at once.
_DRAINED, _TOGETHER = 5.0, 0.1


def drive_warnings(solution: DriveSolution) -> Iterator[ResultWarning]:
    """Warnings of both bearings, each with its end, and warnings of the simulation."""
    yield from solution.prior_warnings
    yield from machine_warnings(solution.case, solution.elements)
    yield from _of_threshold(solution)
    yield from _of_time(solution)
    yield from _of_arcs(solution)
    yield from _of_both_ends(solution)
    yield from _of_currents(solution)
    yield from _of_coatings(solution)


def _of_coatings(solution: DriveSolution) -> Iterator[ResultWarning]:
    """Warnings of a shaft voltage above the breakdown voltage of a coating, each with its end."""
    shaft = max(solution.record.shaft_highest, -solution.record.shaft_lowest)
    for end, bearing in zip(ENDS, solution.elements, strict=True):
        withstands = bearing.path.coating_breakdown
        if withstands is not None and withstands < shaft:
            warning = ResultWarning.of("coating-breakdown", withstands=withstands, shaft=shaft)
            yield ResultWarning(warning.code, f"{end}: {warning}")


def unused_keys(case: DriveCase) -> Iterator[ResultWarning]:
    """Yield notes about keys that the result of a drive does not use."""
    weightless = case.rotor is None or case.rotor.mass is None
    if weightless and (keys := given_keys(case, ["drive.gravity_direction"])):
        yield unused_note("mass", keys)
    for end in ENDS[: 1 if case.non_drive_end == case.drive_end else 2]:
        bearing: BearingCase = getattr(case, end)
        keys = given_keys(bearing, [*NOT_IN_DRIVES, *(f"discharge.{key}" for key in NOT_OF_DISCHARGES)])
        if keys:
            yield unused_note("end", keys, end)


def bearing_warnings(bearings: tuple[BearingResult, BearingResult]) -> Iterator[ResultWarning]:
    """Warnings of both bearings, each with its end; warnings of two equal bearings are given once."""
    first, second = bearings
    if second is first:
        yield from _of_bearing(first)
        return
    for end, result in zip(ENDS, bearings, strict=True):
        for warning in _of_bearing(result):
            yield ResultWarning(warning.code, f"{end}: {warning}")


def _of_bearing(result: BearingResult) -> Iterator[ResultWarning]:
    """Warnings of a bearing; on touching surfaces and ceramic elements in words about a drive."""
    for warning in result.warnings:
        if warning.code == "touching" and conducts(result.solution):
            yield ResultWarning.of("touching", "drive", ratio=lambda_text(result.solution))
        elif warning.code == "capacitance-bound":
            yield ResultWarning.of("capacitance-bound", "drive")
        else:
            yield warning


def machine_warnings(case: DriveCase, bearings: Sequence[BearingElement]) -> Iterator[ResultWarning]:
    """Notes about remedies that are not computed, and about capacitances that follow from the geometry of the
    machine; warning about its oscillations.
    """
    yield from remedy_notes(case)
    circuit = case.circuit
    if circuit.estimated:
        values = ", ".join(
            f"circuit.{key} {amount(circuit.capacitances[key], 'F')}" for key in circuit.estimated
        )
        yield ResultWarning.of("capacitances-estimated", capacitances=values)
    for table in ("source", "circuit", "breakdown"):
        yield from active(unusual_machine({f"{table}.{key}": value for key, value in getattr(case, table)}))
    yield from ring_warning(case.circuit, case.running_speed)
    if case.circuit.inductive:
        yield from oscillation_warning(case.circuit, network_of_ends(case, bearings).at_rest)
    yield from _of_conduction(case, bearings)


def remedy_notes(case: NetworkCase) -> Iterator[ResultWarning]:
    """Note of each remedy that changes a described source, while the source is measured."""
    for remedy in case.remedies:
        if keys := case.described_changes(remedy):
            yield ResultWarning.of("remedy-not-applicable", title=remedy.title, keys=", ".join(keys))


def ring_warning(circuit: Circuit, speed: float) -> Iterator[ResultWarning]:
    """Note of a speed [rad/s] beyond the table of the grounding ring."""
    table = circuit.grounding_ring_table
    if table is None or table.covers(speed):
        return
    ends = table.speed[0], table.speed[-1]
    yield ResultWarning.of(
        "ring-table-exceeded",
        "drive",
        speed=rpm_text(speed),
        first=rpm_text(ends[0]),
        last=rpm_text(ends[1]),
        resistance=amount(table.at_speed(speed), "ohm"),
        end=rpm_text(ends[abs(speed) > ends[1]]),
    )


def _of_conduction(case: DriveCase, bearings: Sequence[BearingElement]) -> Iterator[ResultWarning]:
    """Note of an oil that conducts within some periods of the inverter, but not within its edges."""
    source = case.running_source
    rise, frequency = source.rise_time, source.switching_frequency or source.fundamental_frequency
    if not rise or not frequency:
        return
    times = [
        float(np.min(bearing.capacitance)) / bearing.conductance
        for bearing in bearings
        if bearing.conductance > 0.0
    ]
    if times and _SLOWER * rise < min(times) < _PERIODS / frequency:
        shortest = min(times)
        yield ResultWarning.of(
            "edges-faster-than-oil",
            decay=amount(shortest, "s"),
            times=shortest / rise,
            rise=amount(rise, "s"),
            period=amount(1.0 / frequency, "s"),
        )


def oscillation_warning(circuit: Circuit, network: Network) -> Iterator[ResultWarning]:
    """Warning of an inductance that rings with the capacitances for hundreds of periods."""
    frequency, quality = next(iter(network.oscillations()), (0.0, 0.0))
    if quality > _UNDAMPED:
        paths = [name for name in ("common_mode", "ground") if getattr(circuit, f"{name}_inductance")]
        bare = [name for name in paths if not getattr(circuit, f"{name}_resistance")] or paths
        keys = " and ".join(f"circuit.{name}_resistance" for name in bare)
        # Above this, only the oil damps it.
        shown = "above 10 000" if quality > 1e4 else f"of {quality:.0f}"
        rounded = float(f"{frequency:.3g}")
        yield ResultWarning.of("circuit-undamped", frequency=amount(rounded, "Hz"), quality=shown, keys=keys)


def _of_threshold(solution: DriveSolution) -> Iterator[ResultWarning]:
    """Warning of thresholds without scatter, which hold for one film permanently."""
    for end, bearing in zip(ENDS, solution.elements, strict=True):
        if math.isinf(bearing.shape) and math.isfinite(float(np.min(bearing.breakdown))):
            yield ResultWarning.of("threshold-constant", end=end)


def _of_time(solution: DriveSolution) -> Iterator[ResultWarning]:
    """Warning of a simulated time that is too short for a rate."""
    for end, counts in zip(ENDS, solution.record.counts, strict=True):
        number = int(np.sum(counts))
        if 0 < number < FEW:
            duration = amount(solution.record.duration, "s")
            yield ResultWarning.of("few-discharges", end=end, times=number, duration=duration)


def _of_arcs(solution: DriveSolution) -> Iterator[ResultWarning]:
    """Warning of films that conduct for most of the time: arcs that burn on, or films that recover slowly."""
    for end, burning in zip(ENDS, solution.record.burning, strict=True):
        share = float(burning) / solution.record.duration
        if share > MOSTLY:
            yield ResultWarning.of("arc-burns-on", end=end, percent=100.0 * share)


def _of_both_ends(solution: DriveSolution) -> Iterator[ResultWarning]:
    """Note of discharges at both ends at once, by edges that are faster than an arc drains the shaft."""
    events = solution.record.events
    first, second = (np.sort(events[events[:, FILM] == end, ON]) for end in (0, 1))
    if min(len(first), len(second)) < FEW:
        return
    circuit = solution.case.circuit.capacitances
    shaft = sum(circuit.get(key, 0.0) for key in ("winding_rotor_capacitance", "rotor_frame_capacitance"))
    shaft += sum(float(np.mean(bearing.capacitance)) for bearing in solution.elements)
    drains = solution.case.breakdown.arc_resistance * shaft
    share = float(np.mean(_distance(first, second) < _DRAINED * drains))
    if share > _TOGETHER:
        yield ResultWarning.of("both-ends-discharge", percent=100.0 * share, drained=amount(drains, "s"))


def _distance(times: Array, others: Array) -> Array:
    """Distance of each time to the nearest of other times, both sorted, in their unit."""
    at = np.clip(np.searchsorted(others, times), 1, len(others) - 1)
    return np.minimum(np.abs(times - others[at - 1]), np.abs(times - others[at]))


def _of_currents(solution: DriveSolution) -> Iterator[ResultWarning]:
    """Warning of largest currents whose density is above the lowest of the published limits."""
    for b, (end, bearing) in enumerate(zip(ENDS, solution.elements, strict=True)):
        density = solution.largest_current(b) / bearing.hertz_area if bearing.hertz_area else 0.0
        if density > CURRENT_DENSITY_LIMITS[0]:
            yield ResultWarning.of(
                "current-density-high",
                "drive",
                end=end,
                density=1e-6 * density,
                limits=compared_with_limits(density),
            )
