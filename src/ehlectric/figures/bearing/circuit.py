"""Figures of a bearing's circuit: capacitance, voltage shares, breakdown voltages and impedance."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.ticker import FixedLocator, FuncFormatter, NullLocator

from ehlectric.arrays import Array
from ehlectric.bearing.impedance import Impedance, impedance_of
from ehlectric.bearing.result import BearingResult
from ehlectric.cases.quantity import unit_for
from ehlectric.figures.axes import is_wide, round_numbers
from ehlectric.figures.style import BLUE, GREEN, GREY, ORANGE, axes_or_new, legend_above

# Lines of the voltages of the whole bearing in all figures. The voltages are often equal, so the line drawn
# first is the wider one.
FIRST: dict[str, Any] = {"color": "black", "lw": 1.1, "ls": "-"}
THROUGH: dict[str, Any] = {"color": "#e69f00", "lw": 3.0, "ls": "-"}
SHAFT: dict[str, Any] = {"color": GREEN, "lw": 1.4, "ls": "--"}

# Largest number of elements that have a tick on the axis.
_NUMBERED = 16


def contact_capacitances(result: BearingResult, ax: Axes | None = None) -> Axes:
    """Draw the capacitance of both contacts of every element, with the cage at its first position.

    Parameters
    ----------
    result : BearingResult
        Result of the bearing to draw.
    ax : Axes, optional
        Axes to draw on; axes of a new figure if omitted.

    Returns
    -------
    Axes
        Axes whose title states the capacitance of the bearing at this position of the cage.
    """
    ax = axes_or_new(ax)
    fill = result.solution.case.bearing.fill
    circuit = result.solution.circuits(fill)[0]
    factor, unit = unit_for(float(max(np.max(circuit.inner), np.max(circuit.outer))), "F", least=1.0)
    at = np.arange(circuit.inner.size)
    ax.bar(at - 0.2, factor * circuit.inner, 0.4, color=BLUE, label="inner contact")
    ax.bar(at + 0.2, factor * circuit.outer, 0.4, color=ORANGE, label="outer contact")
    total, of = unit_for(circuit.capacitance, "F", least=1.0)
    # The capacitance in summary.json is another one, the mean over a pitch.
    ax.set_title(f"bearing, cage as here: {total * circuit.capacitance:.4g} {of}, {fill} fill", loc="right")
    ax.set_ylabel(f"capacitance\n[{unit}]")
    _elements(result, ax)
    legend_above(ax)
    return ax


def voltage_shares(result: BearingResult, ax: Axes | None = None) -> Axes:
    """Draw the shares of the bearing voltage on both contacts of every element.

    Parameters
    ----------
    result : BearingResult
        Result of the bearing to draw.
    ax : Axes, optional
        Axes to draw on; axes of a new figure if omitted.

    Returns
    -------
    Axes
        Axes with the shares in per cent, with the cage at its first position.
    """
    ax = axes_or_new(ax)
    inner = 100.0 * result.solution.circuits()[0].inner_share
    at = np.arange(inner.size)
    ax.bar(at, inner, 0.8, color=BLUE, label="inner contact")
    ax.bar(at, 100.0 - inner, 0.8, bottom=inner, color=ORANGE, label="outer contact")
    ax.axhline(50.0, color="white", lw=0.8, ls=":")
    ax.set(ylim=(0.0, 100.0), ylabel="share of the\nvoltage [%]")
    _elements(result, ax)
    legend_above(ax)
    return ax


def breakdown_voltages(result: BearingResult, ax: Axes | None = None) -> Axes:
    """Draw the bearing voltage at which each contact breaks down under its share of the voltage.

    Parameters
    ----------
    result : BearingResult
        Result of a bearing that has breakdown voltages.
    ax : Axes, optional
        Axes to draw on; axes of a new figure if omitted.

    Returns
    -------
    Axes
        Axes with the contacts at the first position of the cage. First break and through breakdown are the
        smallest voltages over all positions.
    """
    ax = axes_or_new(ax)
    circuit = result.solution.circuits()[0]
    at = np.arange(circuit.inner.size)
    inner, outer = circuit.inner_breaks, circuit.outer_breaks
    marks: dict[str, Any] = {"ls": "none", "ms": 6.0, "zorder": 4.0}
    ax.plot(at - 0.12, inner, marker="o", color=BLUE, label="inner contact", **marks)
    ax.plot(at + 0.12, outer, marker="s", color=ORANGE, label="outer contact", **marks)
    _levels(result, ax)
    shaft = result.shaft_voltage
    everything = np.concatenate([inner, outer, [] if shaft is None else [shaft]])
    if is_wide(everything):
        ax.set_yscale("log")
        ax.set_ylim(0.7 * np.min(everything), 1.4 * np.max(everything))
        ax.yaxis.set_major_locator(FixedLocator(list(round_numbers(*ax.get_ylim()))))
        ax.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
        ax.yaxis.set_minor_locator(NullLocator())
    else:
        ax.set_ylim(0.0, 1.15 * np.max(everything))
    ax.set_ylabel("bearing voltage at\nbreakdown [V]")
    _elements(result, ax)
    legend_above(ax, columns=3)
    return ax


def _levels(result: BearingResult, ax: Axes) -> None:
    """Draw lines at the voltages of the whole bearing, as far as there are any."""
    breaks, shaft = result.breaks(), result.shaft_voltage
    for name, value, look in (
        ("through breakdown", breaks["through_breakdown"], THROUGH),
        ("first break", breaks["first_break"], FIRST),
        ("shaft voltage", shaft, SHAFT),
    ):
        if value is not None:
            ax.axhline(value, label=f"{name}, {value:.3g} V", **look)


def _elements(result: BearingResult, ax: Axes) -> None:
    """Label the axis of the elements with their numbers and their angles from the radial load."""
    angles = np.degrees(result.solution.positions[0].equilibrium.position)
    ticks = np.arange(0, angles.size, math.ceil(angles.size / _NUMBERED))
    ax.set_xticks(ticks, [f"{k}\n{angles[k]:.0f}°" for k in ticks])
    ax.set_xlim(-0.6, angles.size - 0.4)
    radial = result.solution.case.bearing.radial_load > 0.0
    ax.set_xlabel("element, and its angle" + (" from the radial load" if radial else ""))


def impedance_magnitude(result: BearingResult, ax: Axes | None = None) -> Axes:
    """Draw the magnitude of the bearing's impedance over the frequency.

    Parameters
    ----------
    result : BearingResult
        Result of a bearing whose oil has a conductivity.
    ax : Axes, optional
        Axes to draw on; axes of a new figure if omitted.

    Returns
    -------
    Axes
        Axes with two logarithmic scales. The corner frequency of the oil alone, 1/(2 pi tau), is marked. With
        air around the films, the corner frequency of the bearing is lower.
    """
    ax = axes_or_new(ax)
    impedance = _impedance(result)
    frequency = impedance.frequency
    ax.loglog(frequency, impedance.magnitude, color=BLUE)
    ax.set(ylabel=r"magnitude $|Z|$ [Ω]", xlabel="frequency $f$ [Hz]", xlim=(frequency[0], frequency[-1]))
    _corner(ax, impedance.corner)
    ax.grid(color="0.9", lw=0.6)
    return ax


def impedance_phase(result: BearingResult, ax: Axes | None = None) -> Axes:
    """Draw the phase of the bearing's impedance over the frequency.

    Parameters
    ----------
    result : BearingResult
        Result of a bearing whose oil has a conductivity.
    ax : Axes, optional
        Axes to draw on; axes of a new figure if omitted.

    Returns
    -------
    Axes
        Axes from -90 degrees (a capacitor) to 0 (a resistor).
    """
    ax = axes_or_new(ax)
    impedance = _impedance(result)
    frequency = impedance.frequency
    ax.semilogx(frequency, impedance.phase, color=BLUE)
    ax.set(ylabel="phase [°]", xlabel="frequency $f$ [Hz]", xlim=(frequency[0], frequency[-1]))
    ax.set_ylim(-95.0, 5.0)
    ax.set_yticks([-90, -60, -45, -30, 0])
    _corner(ax, impedance.corner)
    ax.grid(color="0.9", lw=0.6)
    return ax


def _impedance(result: BearingResult) -> Impedance:
    impedance = impedance_of(result.solution)
    assert impedance is not None
    return impedance


def _corner(ax: Axes, corner: float) -> None:
    label = f"corner of the oil alone, $1/(2\\pi\\tau)$ = {corner:.3g} Hz"
    ax.axvline(corner, color=GREY, lw=0.9, ls="--", label=label)
    legend_above(ax)


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
        Axes with a line for oil and a line for air around the films.
    """
    ax = axes_or_new(ax)
    oil, air = (np.array([c.capacitance for c in result.solution.circuits(fill)]) for fill in ("oil", "air"))
    factor, unit = unit_for(float(np.max(oil)), "F", least=1.0)
    for fill, values, color in (("oil", oil, BLUE), ("air", air, GREY)):
        mean = factor * float(np.mean(values))
        label = f"{fill} around the films, mean {mean:.4g} {unit}"
        _over_pitch(result, ax, factor * values, label, {"color": color})
    ax.set_ylim(0.0, 1.15 * factor * float(np.max(oil)))
    ax.set_ylabel(f"capacitance [{unit}]")
    legend_above(ax)
    return ax


def breakdown_over_pitch(result: BearingResult, ax: Axes | None = None) -> Axes:
    """Draw first break and through breakdown while the cage turns by one pitch of the elements.

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
    circuits = result.solution.circuits()
    first = np.array([circuit.first_break for circuit in circuits])
    through = np.array([circuit.through_breakdown for circuit in circuits])
    shaft = result.shaft_voltage
    for name, values, look in (("through breakdown", through, THROUGH), ("first break", first, FIRST)):
        _over_pitch(result, ax, values, f"{name}, least {np.min(values):.3g} V", look)
    if shaft is not None:
        ax.axhline(shaft, label=f"shaft voltage, {shaft:.3g} V", **SHAFT)
    ax.set_ylim(0.0, 1.15 * max(float(np.max(through)), shaft or 0.0))
    ax.set_ylabel("bearing voltage [V]")
    legend_above(ax)
    return ax


def _over_pitch(result: BearingResult, ax: Axes, values: Array, label: str, look: dict[str, Any]) -> None:
    """Draw values over the positions of the cage; the end of the pitch has the first value again."""
    pitch = 360.0 / result.solution.case.bearing.elements
    angle = np.linspace(0.0, pitch, values.size + 1)
    ax.plot(angle, np.append(values, values[0]), marker="o", ms=4.0, clip_on=False, label=label, **look)
    ax.set(xlim=(0.0, pitch), xlabel="turn of the cage from its first position [°]")
