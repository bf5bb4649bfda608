"""Lines of a slice of a sweep: their points and colours, and the values between the points."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.colors import Normalize

from ehlectric.arrays import Array, IntArray
from ehlectric.figures.axes import DARK_COLOURS, by_logarithm, norm_of
from ehlectric.figures.sweep.time_shares import TIME_SHARES, quantile_of, share_of
from ehlectric.quantities.palette import AMBER, BLUE, GREEN, GREY, ORANGE, PURPLE, SKY
from ehlectric.sweep.interpolation import applied_at, curve_of
from ehlectric.sweep.results import SweepResults
from ehlectric.sweep.slices import Slice

_TEXTS = (BLUE, ORANGE, GREEN, PURPLE, AMBER, SKY, "black", GREY)

# Largest number of lines named in a legend; more lines have a colour bar instead.
NAMED = 8


@dataclass(frozen=True)
class SeriesLine:
    """One line: a value of the second key, the numbers of its points by increasing x, and its colour."""

    value: Any
    numbers: IntArray
    colour: Any


@dataclass(frozen=True)
class LinePath:
    """Interpolation between the points of the lines of a slice, the same as in a map over the same axes."""

    results: SweepResults
    selection: Slice
    log_x: bool
    log_y: bool

    def values(self, line: SeriesLine) -> tuple[Array, Array]:
        """Values of x along a line and the drawn values there, both in SI units."""
        if self.selection.value != self.selection.breakdown.margin:
            return self._curve(self.selection.values, line)
        places, breaks = self._curve(self.selection.margin * self.selection.voltage, line)
        return places, breaks / self.voltages(line)[1]

    def voltages(self, line: SeriesLine) -> tuple[Array, Array]:
        """Values of x along a line, in SI units, and the applied voltage there [V]."""
        places, voltage = self._curve(self.selection.voltage, line)
        applied = applied_at(self.results, self.selection, places, line.value)
        return places, voltage if applied is None else np.where(np.isfinite(voltage), applied, np.nan)

    def _curve(self, values: Array, line: SeriesLine) -> tuple[Array, Array]:
        along, heights = self.selection.along[line.numbers], values[line.numbers]
        if line.numbers.size < 2:
            return along, heights
        if self.selection.value in TIME_SHARES:
            places, quantiles = curve_of(along, quantile_of(heights), log_x=self.log_x, log=False)
            return places, share_of(quantiles)
        log = by_logarithm(values, log_axis=self.log_x or self.log_y)
        return curve_of(along, heights, log_x=self.log_x, log=log)


def lines_of(selection: Slice, *, log: bool) -> list[SeriesLine]:
    """Lines of a slice with their colours.

    Colours go from dark to light with a number; for texts they come from a list of distinct ones.
    """
    series = selection.series()
    if selection.y is None:
        return [SeriesLine(None, numbers, BLUE) for _, numbers in series]
    if not selection.numeric:
        return [SeriesLine(value, n, _TEXTS[k % len(_TEXTS)]) for k, (value, n) in enumerate(series)]
    if len(series) <= NAMED:
        places = np.linspace(0.0, 1.0, len(series))
    else:
        values = np.array([value for value, _ in series])
        places = np.asarray(colours_between(values, log=log)(values))
    return [
        SeriesLine(value, n, DARK_COLOURS(place)) for (value, n), place in zip(series, places, strict=True)
    ]


def joined(selection: Slice, lines: list[SeriesLine]) -> bool:
    """Whether points are joined by lines: those of a line differ in x only, and some line has two of them."""
    return not selection.free and max(line.numbers.size for line in lines) > 1


def colours_between(values: Array, *, log: bool) -> Normalize:
    """Normalisation of colours of many lines, from the smallest value of the second key to the largest."""
    return norm_of(np.array([values.min(), values.max()]), log=log)
