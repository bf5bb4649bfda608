"""Measured initial breakdown of bearings beside that of a candidate bearing."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from matplotlib.figure import Figure
from tests.bearing.bearing_breakdown import (
    BEST,
    EFFECTS,
    FAST,
    FLOODED,
    LOADS,
    NEAREST,
    SLOW,
    TEMPERATURE,
    WARMER,
    breakdown,
    computed_exponent,
    measured,
    measured_exponents,
)

from ehlectric.quantities.palette import BLUE, GREEN
from measured_figures.look import MEASURED, decades, label, new

# Speeds [rpm] of the computed lines, and the warming at them [K], in proportion to ln of the speed.
_SPEEDS = (SLOW, 3700, FAST)
_WARMING = [WARMER * np.log(speed / SLOW) / np.log(FAST / SLOW) for speed in _SPEEDS]


def bearing_breakdown() -> tuple[Figure, list[str], Iterator[list[str]]]:
    """Initial breakdown over the speed at three loads."""
    figure, panels = new(7.2, 3.2, columns=3)
    for ax, loads in zip(panels, LOADS, strict=True):
        flooded = [breakdown(NEAREST, loads, speed, FLOODED) for speed in _SPEEDS]
        best = [breakdown(NEAREST, loads, speed, BEST) for speed in _SPEEDS]
        warm = [
            breakdown(NEAREST, loads, speed, BEST, TEMPERATURE + rise)
            for speed, rise in zip(_SPEEDS, _WARMING, strict=True)
        ]
        ax.plot(_SPEEDS, flooded, color=BLUE, ls="--", label=FLOODED)
        ax.fill_between(_SPEEDS, warm, best, color=GREEN, alpha=0.25, lw=0)
        ax.plot(_SPEEDS, best, color=GREEN, label=f"heat, grease, summits; band: up to {WARMER:.0f} K warmer")
        points = [(speed, volt) for speed in (SLOW, FAST) for volt in measured(loads, speed)]
        ax.errorbar(*zip(*points, strict=True), yerr=0.25, label="measured", **MEASURED)
        ax.set_xscale("log")
        ax.set_yscale("log")
        ax.set_xlim(1700, 8300)
        decades(ax.xaxis, [2000, 4000, 7000])
        decades(ax.yaxis, [1, 2, 5, 10, 20])
        label(ax, "speed [rpm]", "peak voltage of the initial breakdown [V]" if ax is panels[0] else "")
        ax.set_title(f"{loads[0]} N radial, {loads[1]} N axial")
    figure.legend(*panels[0].get_legend_handles_labels(), loc="outside upper center", ncols=3)
    return figure, ["exponent over the speed", *(f"{a} N, {b} N" for a, b in LOADS)], _exponents()


def _exponents() -> Iterator[list[str]]:
    """Rows of the exponents, measured and computed."""
    yield ["measured, two tests", *(", ".join(f"{n:.2f}" for n in measured_exponents(at)) for at in LOADS)]
    for effect in EFFECTS:
        start = "" if effect == FLOODED else "+ "
        yield [start + effect, *(f"{computed_exponent(NEAREST, loads, effect):.2f}" for loads in LOADS)]
    for warmer in (20.0, WARMER):
        found = (computed_exponent(NEAREST, loads, BEST, warmer=warmer) for loads in LOADS)
        yield [f"+ oil {warmer:.0f} K warmer at 7000 rpm", *(f"{value:.2f}" for value in found)]
