"""Figure of a bearing's circuit: capacitance and breakdown voltage of every contact."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.ticker import FixedLocator, FuncFormatter, NullLocator

from ehlectric.bearing.meter.reading import shaft_path
from ehlectric.bearing.over_speed import nearly_equal
from ehlectric.bearing.result import BearingResult
from ehlectric.figures.axes import round_numbers
from ehlectric.figures.bearing.looks import FIRST, SHAFT, THROUGH, fill_text, label_ends, volts
from ehlectric.figures.data import is_wide
from ehlectric.figures.draw import line_look
from ehlectric.figures.style import axes_or_new, figure_of, legend_above
from ehlectric.quantities.palette import BLUE, ORANGE
from ehlectric.quantities.units import unit_for

# Largest number of elements that have a tick on the axis of a figure of this width [inches]. Fewer have one
# in a narrower figure.
_NUMBERED, _WIDTH = 16, 6.0


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
        Axes that state the capacitance of the bearing at this position of the cage.
    """
    ax = axes_or_new(ax)
    fill = result.solution.case.bearing.fill
    circuit = result.solution.circuits(fill)[0]
    factor, unit = unit_for(float(max(np.max(circuit.inner), np.max(circuit.outer))), "F", least=1.0)
    at = np.arange(circuit.inner.size)
    ax.bar(at - 0.2, factor * circuit.inner, 0.4, color=BLUE, label="inner contact")
    ax.bar(at + 0.2, factor * circuit.outer, 0.4, color=ORANGE, label="outer contact")
    ax.set_ylabel(f"capacitance\n[{unit}]")
    _elements(result, ax)
    # The capacitance in summary.json is the mean over a pitch, that of this position another one.
    here, mean = circuit.capacitance, result.capacitance(fill)
    total, of = unit_for(mean, "F", least=1.0)
    text = f"bearing, {fill_text(fill)}: mean {total * mean:.4g} {of}\n"
    text += f"at this cage position {total * here:.4g} {of}"
    ax.set_ylim(0.0, 1.4 * ax.dataLim.ymax)
    ax.text(0.5, 0.97, text, transform=ax.transAxes, ha="center", va="top", fontsize="small")
    legend_above(ax)
    return ax


def breakdown_voltages(result: BearingResult, ax: Axes | None = None) -> Axes:
    """Draw the bearing voltage at which each contact breaks down under its share of the voltage.

    With a coating on a ring it is the shaft voltage, of which the coating has a part.

    Parameters
    ----------
    result : BearingResult
        Result of a bearing that has breakdown voltages.
    ax : Axes, optional
        Axes to draw on; axes of a new figure if omitted.

    Returns
    -------
    Axes
        Axes with the contacts at the first position of the cage. First and ring-to-ring breakdown are the
        smallest voltages over all positions. The range below the shaft voltage is shaded: a contact that
        lies in it breaks down.
    """
    ax = axes_or_new(ax)
    circuit, position = result.solution.circuits()[0], result.solution.positions[0]
    at = np.arange(circuit.inner.size)
    shaft, path = result.shaft_voltage, shaft_path(result.solution)
    share = path.film_share(circuit.capacitance)
    inner, outer = circuit.inner_breaks / share, circuit.outer_breaks / share
    everything = np.concatenate([inner, outer, [] if shaft is None else [shaft]])
    if is_wide(everything):
        ax.set_yscale("log")
        ax.set_ylim(0.6 * np.min(everything), 1.5 * np.max(everything))
        ax.yaxis.set_major_locator(FixedLocator(list(round_numbers(*ax.get_ylim()))))
        ax.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
        ax.yaxis.set_minor_locator(NullLocator())
    else:
        ax.set_ylim(0.0, 1.15 * np.max(everything))
    if shaft is not None:
        ax.axhspan(ax.get_ylim()[0], shaft, color=ORANGE, alpha=0.12, lw=0.0, zorder=0.0)
        ax.text(
            0.01,
            0.03,
            "below the shaft voltage: breakdown",
            transform=ax.transAxes,
            color=ORANGE,
            fontsize="small",
        )
    for name, values, ring, shift, marker, colour in (
        ("inner", inner, position.inner, -0.12, "o", BLUE),
        ("outer", outer, position.outer, 0.12, "s", ORANGE),
    ):
        look: dict[str, Any] = {"ls": "none", "ms": 6.0, "zorder": 4.0, "marker": marker, "color": colour}
        ax.plot(at + shift, values, label=f"{name} contact", **look)
        free = ~ring.solved
        if np.any(free):
            ax.plot(
                (at + shift)[free], values[free], **(look | {"mfc": "white", "label": f"{name}, unloaded"})
            )
    _levels(result, ax)
    ax.set_ylabel(f"{'shaft' if path.coated else 'bearing'} voltage at\nbreakdown [V]")
    _elements(result, ax)
    legend_above(ax, [line for line in ax.get_lines() if line.get_marker() != "None"], columns=4)
    return ax


def _levels(result: BearingResult, ax: Axes) -> None:
    """Draw lines at the voltages of the whole bearing, as far as there are any, and name them at the edge."""
    breaks, shaft = result.breaks(), result.shaft_voltage
    first, through = breaks["shaft_first_break"], breaks["shaft_through_breakdown"]
    levels = [("first\nbreakdown", first, FIRST), ("ring-to-ring\nbreakdown", through, THROUGH)]
    if nearly_equal(np.array([first]), np.array([through])):
        levels = [("first and\nring-to-ring\nbreakdown", first, FIRST)]
    if shaft is not None:
        levels.append(("shaft voltage", shaft, SHAFT))
    for name, value, look in reversed(levels):
        ax.axhline(value, label=name.replace("\n", " "), **line_look(*look))
    label_ends(ax, [(value, f"{name}\n{volts(value)}", look[0]) for name, value, look in levels])


def _elements(result: BearingResult, ax: Axes) -> None:
    """Label the axis of the elements with their numbers and their angles from the radial load."""
    angles = np.degrees(result.solution.positions[0].equilibrium.position)
    numbered = _NUMBERED * min(1.0, figure_of(ax).get_figwidth() / _WIDTH)
    ticks = np.arange(0, angles.size, math.ceil(angles.size / numbered))
    ax.set_xticks(ticks, [f"{k}\n{angles[k]:.0f}°" for k in ticks])
    ax.set_xlim(-0.6, angles.size - 0.4)
    radial = result.solution.case.bearing.radial_load > 0.0
    ax.set_xlabel("element, and its angle" + (" from the radial load" if radial else ""))
