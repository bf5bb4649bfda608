"""Warnings about the result of a drive."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from ehlectric.bearing.result import BearingResult
from ehlectric.cases.drives.case import ENDS, DriveCase
from ehlectric.cases.row import amount
from ehlectric.discharge.laws import CURRENT_DENSITY_LIMITS
from ehlectric.drive.solution import DriveSolution
from ehlectric.drive.statistics import FEW
from ehlectric.errors import ResultWarning

# Share of time from which an arc is said to burn on.
MOSTLY = 0.2


def drive_warnings(solution: DriveSolution) -> Iterator[ResultWarning]:
    """Warnings of both bearings, each with its end, and those of the simulation.

    Parameters
    ----------
    solution : DriveSolution
        Solved drive.

    Yields
    ------
    ResultWarning
        Warning with its code.
    """
    yield from solution.told
    yield from machine_warnings(solution.case)
    yield from _of_threshold(solution)
    yield from _of_time(solution)
    yield from _of_arcs(solution)
    yield from _of_currents(solution)


def bearing_warnings(bearings: tuple[BearingResult, BearingResult]) -> Iterator[ResultWarning]:
    """Warnings of both bearings, each with its end; those of two equal bearings are told once."""
    first, second = bearings
    if second is first:
        yield from first.warnings
        return
    for end, result in zip(ENDS, bearings, strict=True):
        for warning in result.warnings:
            yield ResultWarning(warning.code, f"{end}: {warning}")


def machine_warnings(case: DriveCase) -> Iterator[ResultWarning]:
    """Note of capacitances that follow from the geometry of the machine."""
    circuit = case.circuit
    if circuit.estimated:
        told = ", ".join(
            f"circuit.{key} {amount(circuit.capacitances[key], 'F')}" for key in circuit.estimated
        )
        yield ResultWarning(
            "capacitances-estimated",
            f"{told}: from the geometry of the machine without end windings, which add to them; "
            "measure them, or see what half and double of them change",
        )


def _of_threshold(solution: DriveSolution) -> Iterator[ResultWarning]:
    """Warning of thresholds without scatter, which hold for one film for ever."""
    for end, one in zip(ENDS, solution.elements, strict=True):
        if math.isinf(one.shape) and math.isfinite(float(np.min(one.breakdown))):
            yield ResultWarning(
                "threshold-constant",
                f"the films of {end} break down at the same voltage each time; give breakdown.weibull_shape, "
                "or discharge.weibull in the bearing file, for thresholds that scatter as those of oils do",
            )


def _of_time(solution: DriveSolution) -> Iterator[ResultWarning]:
    """Warning of a simulated time that is too short for a rate."""
    for end, counts in zip(ENDS, solution.record.counts, strict=True):
        number = int(np.sum(counts))
        if 0 < number < FEW:
            yield ResultWarning(
                "few-discharges",
                f"{end} discharges {number} times in {amount(solution.record.duration, 's')}: its rate is "
                "uncertain; give a longer drive.duration",
            )


def _of_arcs(solution: DriveSolution) -> Iterator[ResultWarning]:
    """Warning of arcs that burn for most of the time: they are hardly discharges."""
    for end, burning in zip(ENDS, solution.record.burning, strict=True):
        share = float(burning) / solution.record.duration
        if share > MOSTLY:
            yield ResultWarning(
                "arc-burns-on",
                f"an arc burns in {end} for {100.0 * share:.3g} % of the time: the source feeds it above "
                "breakdown.extinction_current or extinction_voltage, so that few discharges are counted",
            )


def _of_currents(solution: DriveSolution) -> Iterator[ResultWarning]:
    """Warning of largest currents whose density is above published limits."""
    low, high = (1e-6 * CURRENT_DENSITY_LIMITS[k] for k in (0, -1))
    for b, (end, one) in enumerate(zip(ENDS, solution.elements, strict=True)):
        density = solution.largest_current(b) / one.hertz_area if one.hertz_area else 0.0
        if density > CURRENT_DENSITY_LIMITS[0]:
            yield ResultWarning(
                "current-density-high",
                f"{end}: the apparent current density is {1e-6 * density:.3g} A/mm², the largest current "
                f"over the Hertz areas; published limits for bearings are {low:g} to {high:g} A/mm²",
            )
