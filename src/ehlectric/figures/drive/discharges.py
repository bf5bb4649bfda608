"""Figure of the discharges of a drive: distributions of voltage, charge, energy and peak current."""

from __future__ import annotations

from functools import partial

import numpy as np
from matplotlib.axes import Axes
from matplotlib.ticker import MaxNLocator

from ehlectric.arrays import Array
from ehlectric.drive.discharges.record import CHARGE, ENERGY, PEAK, VOLTAGE
from ehlectric.drive.result import DriveResult
from ehlectric.figures.axes import scale_axis
from ehlectric.figures.data import is_wide
from ehlectric.figures.drive.looks import COLOURS, NAMES, events_of, number_of_events
from ehlectric.figures.style import axes_or_new, legend_above
from ehlectric.quantities.drive_results import EVENT_KEYS
from ehlectric.quantities.units import unit_for

# Quantities of a discharge, and their columns of a record.
QUANTITIES = (("voltage", VOLTAGE), ("charge", CHARGE), ("energy", ENERGY), ("peak_current", PEAK))

# Number of bins of a distribution, and values outside of which lie too few discharges to be seen [%].
_LEAST, _MOST = 8, 40
_SHOWN = (0.05, 99.95)

# Relative difference of values below which they are shown as nearly equal.
_NARROW = 0.05


def distribution(result: DriveResult, ax: Axes | None = None, *, quantity: int = 0) -> Axes:
    """Draw how a quantity of the discharges of both bearings is distributed.

    Parameters
    ----------
    result : DriveResult
        Result of a drive with discharges.
    ax : Axes, optional
        Axes to draw on; axes of a new figure if omitted.
    quantity : int
        Number of the quantity in ``QUANTITIES``.

    Returns
    -------
    Axes
        Axes with the share of the discharges of each bearing. Bins have equal ratios where the values differ
        by more than a factor of 20; the outer ones hold what lies beyond.
    """
    ax = axes_or_new(ax)
    name, column = QUANTITIES[quantity]
    about = EVENT_KEYS[name]
    values = [np.abs(events_of(result, b)[:, column]) for b in range(2)]
    edges, log = bins_of(np.concatenate(values))
    factor, prefixed = unit_for(float(edges[-1]), about.unit, least=1.0)
    edges = factor * edges
    for b, own in enumerate(values):
        if not own.size:
            continue
        counts, _ = np.histogram(np.clip(factor * own, edges[0], edges[-1]), edges)
        share = 100.0 * counts / own.size
        if b == 0:
            ax.stairs(share, edges, color=COLOURS[b], fill=True, alpha=0.35, lw=0.0, label=_label(result, b))
        ax.stairs(share, edges, color=COLOURS[b], lw=1.1, label="_" if b == 0 else _label(result, b))
    scale_axis(ax.xaxis, f"{about.label} [{prefixed}]", values=edges, log=log)
    if not log:
        ax.xaxis.set_major_locator(MaxNLocator(5))
    ax.set_xlim(edges[0], edges[-1])
    ax.set_ylim(0.0, None)
    ax.set_ylabel("discharges [%]")
    return ax


# Panels of the figure, row by row.
DISTRIBUTIONS = tuple(partial(distribution, quantity=number) for number in range(len(QUANTITIES)))


def legend_of(axes: list[Axes]) -> None:
    """Legend above the first panel."""
    legend_above(axes[0], columns=1)


def _label(result: DriveResult, b: int) -> str:
    return f"{NAMES[b]}: {number_of_events(result, b)} discharges"


def bins_of(values: Array) -> tuple[Array, bool]:
    """Edges of the bins of a distribution of positive values, and whether they have equal ratios.

    Parameters
    ----------
    values : ndarray, shape (n,)
        Values of all discharges, of which the rarest are left out.
    """
    low, high = np.percentile(values[values > 0.0] if np.any(values) else [1.0], _SHOWN)
    log = is_wide(np.array([low, high]))
    return _edges(float(low), float(high), values.size, log=log), log


def _edges(low: float, high: float, number: int, *, log: bool) -> Array:
    """Edges of bins, about as many as the square root of the number of values."""
    bins = int(np.clip(np.sqrt(number), _LEAST, _MOST))
    if log:
        return np.asarray(np.geomspace(low, high, bins + 1))
    room = _NARROW * high if high - low < _NARROW * high else 0.0
    return np.linspace(low - room, high + room, bins + 1)
