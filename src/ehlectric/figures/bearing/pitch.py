"""Figures of a bearing while its cage turns by one pitch: capacitance and breakdown voltages."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes

from ehlectric.arrays import Array
from ehlectric.bearing.meter.path import shaft_first_break, shaft_through_breakdown
from ehlectric.bearing.meter.reading import shaft_path
from ehlectric.bearing.over_speed import nearly_equal
from ehlectric.bearing.result import BearingResult
from ehlectric.figures.bearing.looks import FIRST, SHAFT, THROUGH, label_ends, volts
from ehlectric.figures.draw import line_look
from ehlectric.figures.style import axes_or_new, legend_above
from ehlectric.quantities.palette import BLUE, GREY
from ehlectric.quantities.units import unit_for

# A quantity that varies by less than this part of its mean over a pitch is a number, not a figure.
LEAST_VARIATION = 0.01


def capacitances(result: BearingResult, fill: float | str) -> Array:
    """Capacitance of the bearing at each position of the cage, with "oil" or "air" around the films [F]."""
    return np.array([circuit.capacitance for circuit in result.solution.circuits(fill)])


def first_breakdowns(result: BearingResult) -> Array:
    """Voltage of the first breakdown at each position of the cage, on the bearing with its coating [V]."""
    path = shaft_path(result.solution)
    return np.array([shaft_first_break(circuit, path) for circuit in result.solution.circuits()])


def variation(values: Array) -> float:
    """Difference of the largest and the smallest value, divided by their mean, dimensionless.

    Examples
    --------
    >>> variation(np.array([9.0, 10.0, 11.0]))
    0.2
    """
    return float(np.ptp(values) / np.mean(values))


def capacitance_over_pitch(result: BearingResult, ax: Axes | None = None) -> Axes:
    """Draw the capacitance of the bearing while the cage turns by one pitch of the elements.

    Parameters
    ----------
    result : BearingResult
        Result of the bearing to draw.
    ax : Axes, optional
        Axes to draw on; axes of a new figure if omitted.

    Returns
    -------
    Axes
        Axes with the difference from the mean in per cent, for oil and for air around the films.
    """
    ax = axes_or_new(ax)
    for fill, look in (("oil", {"color": BLUE}), ("air", {"color": GREY, "ls": "--"})):
        values = capacitances(result, fill)
        mean = float(np.mean(values))
        factor, unit = unit_for(mean, "F", least=1.0)
        label = f"{fill} around the films, mean {factor * mean:.4g} {unit}"
        _over_pitch(result, ax, 100.0 * (values / mean - 1.0), label, look)
    ax.axhline(0.0, color="black", lw=0.6)
    ax.set_ylabel("capacitance,\ndifference from\nthe mean [%]")
    legend_above(ax)
    return ax


def breakdown_over_pitch(result: BearingResult, ax: Axes | None = None) -> Axes:
    """Draw first and ring-to-ring breakdown while the cage turns by one pitch of the elements.

    Parameters
    ----------
    result : BearingResult
        Result of a bearing that has breakdown voltages.
    ax : Axes, optional
        Axes to draw on; axes of a new figure if omitted.

    Returns
    -------
    Axes
        Axes that also show the shaft voltage if there is one.
    """
    ax = axes_or_new(ax)
    first = first_breakdowns(result)
    path = shaft_path(result.solution)
    through = np.array([shaft_through_breakdown(circuit, path) for circuit in result.solution.circuits()])
    lines = [("ring-to-ring\nbreakdown", through, THROUGH), ("first\nbreakdown", first, FIRST)]
    if nearly_equal(first, through):
        lines = [("first and\nring-to-ring\nbreakdown", first, FIRST)]
    for name, values, look in lines:
        _over_pitch(result, ax, values, name.replace("\n", " "), line_look(*look))
    shaft = result.shaft_voltage
    ends = [
        (float(values[0]), f"{name}\nmin. {volts(np.min(values))}", look[0]) for name, values, look in lines
    ]
    if shaft is not None:
        ax.axhline(shaft, label="shaft voltage", **line_look(*SHAFT))
        ends.append((shaft, f"shaft voltage\n{volts(shaft)}", SHAFT[0]))
    ax.set_ylim(0.0, 1.15 * max(float(np.max(through)), shaft or 0.0))
    ax.set_ylabel(f"{'shaft' if path.coated else 'bearing'} voltage [V]")
    label_ends(ax, ends)
    return ax


def _over_pitch(result: BearingResult, ax: Axes, values: Array, label: str, look: dict[str, Any]) -> None:
    """Draw values over the positions of the cage; the end of the pitch has the first value again."""
    pitch = 360.0 / result.solution.case.bearing.elements
    angle = np.linspace(0.0, pitch, values.size + 1)
    ax.plot(angle, np.append(values, values[0]), marker="o", ms=4.0, clip_on=False, label=label, **look)
    ax.set(xlim=(0.0, pitch), xlabel="turn of the cage from its first position [°]")
