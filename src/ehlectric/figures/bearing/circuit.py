"""Figures of a bearing's circuit: capacitance, shares, breakdown and impedance, over a pitch of the cage."""

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

# How voltages of the whole bearing look in all figures. They are often equal: the one below is the wider.
FIRST: dict[str, Any] = {"color": "black", "lw": 1.1, "ls": "-"}
THROUGH: dict[str, Any] = {"color": "#e69f00", "lw": 3.0, "ls": "-"}
SHAFT: dict[str, Any] = {"color": GREEN, "lw": 1.4, "ls": "--"}

# With more elements than this not all of them have their number on the axis.
_NUMBERED = 16


def contact_capacitances(result: BearingResult, ax: Axes | None = None) -> Axes:
    """Capacitance of both contacts of every element, cage at its first position.

    Parameters
    ----------
    result : BearingResult
        What to draw.
    ax : Axes, optional
        Where to; new axes otherwise.

    Returns
    -------
    Axes
        With that of the bearing over them, its cage at that position.
    """
    ax = axes_or_new(ax)
    fill = result.solution.case.bearing.fill
    circuit = result.solution.circuits(fill)[0]
    factor, unit = unit_for(float(max(np.max(circuit.inner), np.max(circuit.outer))), "F", least=1.0)
    at = np.arange(circuit.inner.size)
    ax.bar(at - 0.2, factor * circuit.inner, 0.4, color=BLUE, label="inner contact")
    ax.bar(at + 0.2, factor * circuit.outer, 0.4, color=ORANGE, label="outer contact")
    total, of = unit_for(circuit.capacitance, "F", least=1.0)
    # That of the summary is the mean over a pitch.
    ax.set_title(f"bearing, cage as here: {total * circuit.capacitance:.4g} {of}, {fill} fill", loc="right")
    ax.set_ylabel(f"capacitance\n[{unit}]")
    _elements(result, ax)
    legend_above(ax)
    return ax


def voltage_shares(result: BearingResult, ax: Axes | None = None) -> Axes:
    """Part of the bearing's voltage on both contacts of every element, cage at its first position.

    Parameters
    ----------
    result : BearingResult
        What to draw.
    ax : Axes, optional
        Where to; new axes otherwise.

    Returns
    -------
    Axes
        In per cent.
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
    """Bearing voltages at which each contact breaks down, its share of it reckoned with.

    Parameters
    ----------
    result : BearingResult
        With breakdown voltages.
    ax : Axes, optional
        Where to; new axes otherwise.

    Returns
    -------
    Axes
        Contacts with the cage at its first position; first break and through breakdown are the least over its
        positions.
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
    """Lines of the voltages of the whole bearing, those there are."""
    found, shaft = result.breaks(), result.shaft_voltage
    for name, value, look in (
        ("through breakdown", found["through_breakdown"], THROUGH),
        ("first break", found["first_break"], FIRST),
        ("shaft voltage", shaft, SHAFT),
    ):
        if value is not None:
            ax.axhline(value, label=f"{name}, {value:.3g} V", **look)


def _elements(result: BearingResult, ax: Axes) -> None:
    """Axis of elements, each with its angle from the load."""
    angles = np.degrees(result.solution.positions[0].equilibrium.position)
    shown = np.arange(0, angles.size, math.ceil(angles.size / _NUMBERED))
    ax.set_xticks(shown, [f"{k}\n{angles[k]:.0f}°" for k in shown])
    ax.set_xlim(-0.6, angles.size - 0.4)
    radial = result.solution.case.bearing.radial_load > 0.0
    ax.set_xlabel("element, and its angle" + (" from the radial load" if radial else ""))


def impedance_magnitude(result: BearingResult, ax: Axes | None = None) -> Axes:
    """Magnitude of the bearing's impedance over the frequency.

    Parameters
    ----------
    result : BearingResult
        Of an oil with a conductivity.
    ax : Axes, optional
        Where to; new axes otherwise.

    Returns
    -------
    Axes
        Both logarithmic; the corner of the oil alone, 1/(2 pi tau), is marked; with air
        around the films that of the bearing is below it.
    """
    ax = axes_or_new(ax)
    found = _found(result)
    frequency = found.frequency
    ax.loglog(frequency, found.magnitude, color=BLUE)
    ax.set(ylabel=r"magnitude $|Z|$ [Ω]", xlabel="frequency $f$ [Hz]", xlim=(frequency[0], frequency[-1]))
    _corner(ax, found.corner)
    ax.grid(color="0.9", lw=0.6)
    return ax


def impedance_phase(result: BearingResult, ax: Axes | None = None) -> Axes:
    """Phase of the bearing's impedance over the frequency.

    Parameters
    ----------
    result : BearingResult
        Of an oil with a conductivity.
    ax : Axes, optional
        Where to; new axes otherwise.

    Returns
    -------
    Axes
        From 0, a resistor, to -90 degrees, a capacitor.
    """
    ax = axes_or_new(ax)
    found = _found(result)
    frequency = found.frequency
    ax.semilogx(frequency, found.phase, color=BLUE)
    ax.set(ylabel="phase [°]", xlabel="frequency $f$ [Hz]", xlim=(frequency[0], frequency[-1]))
    ax.set_ylim(-95.0, 5.0)
    ax.set_yticks([-90, -60, -45, -30, 0])
    _corner(ax, found.corner)
    ax.grid(color="0.9", lw=0.6)
    return ax


def _found(result: BearingResult) -> Impedance:
    found = impedance_of(result.solution)
    assert found is not None
    return found


def _corner(ax: Axes, corner: float) -> None:
    label = f"corner of the oil alone, $1/(2\\pi\\tau)$ = {corner:.3g} Hz"
    ax.axvline(corner, color=GREY, lw=0.9, ls="--", label=label)
    legend_above(ax)


def capacitance_over_pitch(result: BearingResult, ax: Axes | None = None) -> Axes:
    """Capacitance of the bearing while the cage turns by a pitch of the elements.

    Parameters
    ----------
    result : BearingResult
        What to draw.
    ax : Axes, optional
        Where to; new axes otherwise.

    Returns
    -------
    Axes
        With oil and with air around the films.
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
    """First break and through breakdown while the cage turns by a pitch of the elements.

    Parameters
    ----------
    result : BearingResult
        With breakdown voltages.
    ax : Axes, optional
        Where to; new axes otherwise.

    Returns
    -------
    Axes
        With the shaft voltage, where there is a motor.
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
    """Values at the positions of the cage, the first again at the end of the pitch."""
    pitch = 360.0 / result.solution.case.bearing.elements
    angle = np.linspace(0.0, pitch, values.size + 1)
    ax.plot(angle, np.append(values, values[0]), marker="o", ms=4.0, clip_on=False, label=label, **look)
    ax.set(xlim=(0.0, pitch), xlabel="turn of the cage from its first position [°]")
