"""Figure of a sensitivity analysis: distribution of a value, and sensitivity indices of the inputs."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from ehlectric.arrays import Array
from ehlectric.figures.style import axes_or_new, figure_of, legend_above, new_panels, save_figure, style
from ehlectric.figures.sweep import findings
from ehlectric.figures.sweep.points import labelled, name_figure, range_text
from ehlectric.quantities.formats import Scale
from ehlectric.quantities.palette import BLUE, GREY, ORANGE
from ehlectric.sweep.breakdown_keys import breakdown_of
from ehlectric.sweep.labels import label_of
from ehlectric.sweep.results import SweepResults
from ehlectric.sweep.sensitivity import LEVEL, Sensitivity
from ehlectric.sweep.slices import numbers_of

# Probabilities marked in the distribution.
_MARKED = (0.05, 0.5, 0.95)

# An index is drawn as 0 if its interval contains 0 or it is below _ZERO, and if the interval is within
# _NOTHING of 0.
_ZERO, _NOTHING = 0.01, 0.05


def distribution(results: SweepResults, analysis: Sensitivity, ax: Axes | None = None) -> Axes:
    """Draw the cumulative distribution of a value, with its 5, 50 and 95 % quantiles.

    For a breakdown voltage or a margin, the applied voltage is drawn too.

    Parameters
    ----------
    results : SweepResults
        Results of a sweep of the design "sobol".
    analysis : Sensitivity
        Its analysis, from ``ehlectric.sweep.sensitivity.sensitivity``.
    ax : Axes, optional
        Axes to draw on; axes of a new figure if omitted.

    Returns
    -------
    Axes
        Axes with the share of samples below each value. The samples are the solved points of A and B.
    """
    ax = axes_or_new(ax)
    samples = np.sort(_drawn(results, analysis.value))
    label, scale = labelled(results, analysis.value, samples)
    shares = np.arange(1, samples.size + 1) / samples.size
    ax.step(scale.of(samples), shares, where="post", color=BLUE)
    marked = [scale.of(analysis.spread.quantiles[q]) for q in _MARKED]
    ax.vlines(marked, 0.0, _MARKED, color=BLUE, lw=0.8, ls=":")
    (dots,) = ax.plot(marked, _MARKED, ls="none", marker="o", ms=4.0, color=BLUE)
    text = ", ".join(f"{100.0 * q:g}" for q in _MARKED) + " %: "
    text += ", ".join(f"{at:.3g}" for at in marked)
    dots.set_label(f"{text} {scale.unit}".rstrip())
    handles: list[Artist] = [dots]
    if analysis.share_below_voltage is not None:
        handles.append(_applied(results, analysis, ax, scale))
    ax.set(xlabel=label.axis(scale), ylabel=f"share of {samples.size} samples below", ylim=(0.0, 1.04))
    legend_above(ax, handles, columns=1)
    return ax


def _drawn(results: SweepResults, value: str) -> Array:
    """Values at the solved points of the matrices A and B of the Sobol design."""
    values = numbers_of(results, value)[: 2 * results.samples]
    return np.asarray(values[np.isfinite(values)])


def _applied(results: SweepResults, analysis: Sensitivity, ax: Axes, scale: Scale) -> Line2D:
    """Draw the applied voltage or its range; the title says which part of the samples is below it."""
    about = breakdown_of(results.case, analysis.value)
    volts = results.values(about.voltage)[: 2 * results.samples]
    volts = volts[np.isfinite(volts)]
    ends = scale.of(np.array([volts.min(), volts.max()])) if analysis.value == about.value else np.ones(2)
    line = ax.axvline(ends[0], color=ORANGE, lw=1.4, ls="--")
    if ends[1] > ends[0]:
        ax.axvspan(*ends, color=ORANGE, alpha=0.2, lw=0.0)
    line.set_label(f"{about.voltage_name} {range_text(volts, 'V')}")
    return line


def parts(results: SweepResults, analysis: Sensitivity, ax: Axes | None = None) -> Axes:
    """Draw the first-order and the total sensitivity index of each input with their confidence intervals.

    Parameters
    ----------
    results : SweepResults
        Results of a sweep of the design "sobol".
    analysis : Sensitivity
        Its analysis, from ``ehlectric.sweep.sensitivity.sensitivity``.
    ax : Axes, optional
        Axes to draw on; axes of a new figure if omitted.

    Returns
    -------
    Axes
        Axes with the indices as bars, the input with the largest total index on top.
    """
    ax = axes_or_new(ax)
    ordered = sorted(analysis.indices, key=lambda index: index.total)
    rows = np.arange(len(ordered))
    kinds = (("total", BLUE, 0.19), ("first_order", ORANGE, -0.19))
    for kind, colour, shift in kinds:
        middle = np.array([getattr(index, kind) for index in ordered])
        ends = np.array([getattr(index, f"{kind}_interval") for index in ordered]).T
        ax.barh(rows + shift, middle, height=0.36, color=colour, label=kind.replace("_", " "))
        # With few rows, the estimate may lie outside its bootstrap interval.
        reach = np.maximum([middle - ends[0], ends[1] - middle], 0.0)
        # Beside a bar of no length, its interval would look like a stray mark.
        none = (np.abs(middle) < _ZERO) | ((ends[0] <= 0.0) & (ends[1] >= 0.0))
        drawn = ~none | (np.max(np.abs([middle, *ends]), axis=0) > _NOTHING)
        look: dict[str, Any] = {"fmt": "none", "ecolor": "black", "elinewidth": 0.9, "capsize": 2.5}
        ax.errorbar(middle[drawn], (rows + shift)[drawn], xerr=reach[:, drawn], **look)
        for row in np.flatnonzero(~drawn):
            ax.text(0.01, rows[row] + shift, "0", va="center", fontsize="small", color=colour)
    ax.axvline(0.0, color="black", lw=0.7)
    ax.set_yticks(rows, labels=[label_of(i.key, results.case).name for i in ordered])
    highest = max(1.0, *(max(i.total_interval[1], i.first_order_interval[1]) for i in ordered))
    lowest = min(0.0, *(i.first_order_interval[0] for i in ordered))
    ax.set_xlim(1.05 * lowest, 1.03 * highest)
    ax.set_xlabel(f"part of the variance\n{100.0 * LEVEL:g} % intervals of {analysis.used} rows")
    ax.grid(axis="x", color=GREY, alpha=0.25, lw=0.5)
    ax.set_axisbelow(True)
    legend_above(ax)
    return ax


def sensitivity_figure(results: SweepResults, analysis: Sensitivity) -> Figure:
    """Figure of the distribution of a value beside the sensitivity indices of the inputs.

    Parameters
    ----------
    results : SweepResults
        Results of a sweep of the design "sobol".
    analysis : Sensitivity
        Sensitivity of the results, as ``sensitivity`` gives it.

    Returns
    -------
    Figure
        The figure, with its title.
    """
    with style():
        high = max(3.4, 1.6 + 0.42 * len(analysis.indices))
        left, right = new_panels(1, 2, (8.4, high))
        distribution(results, analysis, left)
        parts(results, analysis, right)
        dropped = (
            f"{analysis.dropped} of {analysis.rows} rows dropped: not solved" if analysis.dropped else ""
        )
        doubtful = f"{analysis.doubtful} of {analysis.used} used rows have points that must not be used"
        more = ", ".join(filter(None, [dropped, doubtful if analysis.doubtful else ""]))
        name_figure(left, results, findings.of_sensitivity(results, analysis), more)
    return figure_of(left)


def save_sensitivity(
    results: SweepResults, analysis: Sensitivity, path: Path, formats: Sequence[str] = ("png",)
) -> list[Path]:
    """Write the distribution of a value beside the sensitivity indices, as a file of each format."""
    return save_figure(sensitivity_figure(results, analysis), path, formats)
