"""Figure of the remedies of a drive side by side: rates of discharges with their bounds, and energies."""

from __future__ import annotations

import math
import textwrap
from collections.abc import Iterator
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.ticker import LogLocator, NullFormatter, NullLocator

from ehlectric.cases.drives.case import ENDS
from ehlectric.drive.result import DriveResult
from ehlectric.drive.summary import end_summary
from ehlectric.figures.drive.looks import COLOURS, NAMES
from ehlectric.figures.names import literal
from ehlectric.figures.style import axes_or_new, legend_above
from ehlectric.quantities.drive_results import DRIVE_BOOK
from ehlectric.quantities.palette import GREY
from ehlectric.quantities.units import unit_for

# Letters on a line of a name, and lines of it; distance of both bearings from the middle of their row.
_LETTERS, _LINES, _BESIDE = 20, 2, 0.16

AS_IT_IS = "as it is"


def variants(result: DriveResult) -> Iterator[tuple[str, list[dict[str, Any]]]]:
    """Name, and summary of both bearings, of the drive as it is and of each remedy."""
    solutions = [(AS_IT_IS, result.solution), *((title, found) for title, _, found in result.remedies)]
    for name, solution in solutions:
        yield name, [end_summary(solution, b) for b in range(len(ENDS))]


def rates(result: DriveResult, ax: Axes | None = None) -> Axes:
    """Draw the discharges per second of the drive and its remedies, with bounds of 95 %.

    Parameters
    ----------
    result : DriveResult
        Result of a drive with remedies.
    ax : Axes, optional
        Axes to draw on; axes of a new figure if omitted.

    Returns
    -------
    Axes
        Axes with a row for the drive as it is and for each remedy. An arrow is an upper bound where no
        discharge happened.
    """
    ax = axes_or_new(ax)
    rows = list(variants(result))
    ends = [end for _, pair in rows for end in pair]
    known = [end["events_per_second_low"] for end in ends] + [end["events_per_second"] for end in ends]
    highest = [end["events_per_second_high"] for end in ends]
    least = min([value for value in (*known, *highest) if value > 0.0])
    bottom = 10.0 ** math.floor(math.log10(0.5 * least))
    for row, (_, pair) in enumerate(rows):
        for b, end in enumerate(pair):
            at = _place(row, b)
            look: dict[str, Any] = {"color": COLOURS[b], "lw": 1.3}
            low, high = end["events_per_second_low"], end["events_per_second_high"]
            if end["events"]:
                ax.plot([max(low, bottom), high], [at, at], **look)
                ax.plot([end["events_per_second"]], [at], marker="os"[b], ms=5.0, **look)
            else:
                ax.plot([bottom, high], [at, at], ls=":", **look)
                ax.plot([high], [at], marker="<", ms=5.5, mfc="white", **look)
    _log_axis(ax, bottom, 2.0 * max(highest))
    ax.set_xlabel(DRIVE_BOOK["end.events_per_second"].label)
    _rows(ax, [name for name, _ in rows])
    return ax


def energies(result: DriveResult, ax: Axes | None = None) -> Axes:
    """Draw the mean energy of a discharge of the drive and its remedies.

    Parameters
    ----------
    result : DriveResult
        Result of a drive with remedies.
    ax : Axes, optional
        Axes to draw on; axes of a new figure if omitted.

    Returns
    -------
    Axes
        Axes with a row for the drive as it is and for each remedy.
    """
    ax = axes_or_new(ax)
    rows = list(variants(result))
    found = [end["energy_mean"] for _, pair in rows for end in pair if end["events"]]
    factor, unit = unit_for(max(found, default=1e-9), "J", least=1.0)
    for row, (_, pair) in enumerate(rows):
        for b, end in enumerate(pair):
            if end["events"]:
                ax.plot(
                    [factor * end["energy_mean"]], [_place(row, b)], marker="os"[b], color=COLOURS[b], ms=5.0
                )
        if not any(end["events"] for end in pair):
            ax.text(
                0.03, row, "no discharge", transform=ax.get_yaxis_transform(), va="center",
                color=GREY, fontsize="small",
            )  # fmt: skip
    positive = [factor * value for value in found if value > 0.0]
    if positive and max(positive) > 20.0 * min(positive):
        _log_axis(ax, 0.5 * min(positive), 2.0 * max(positive))
    else:
        ax.set_xlim(0.0, 1.15 * max(positive, default=1.0))
    ax.set_xlabel(f"{DRIVE_BOOK['end.energy_mean'].label} [{unit}]")
    _rows(ax, [name for name, _ in rows])
    ax.tick_params(labelleft=False)
    return ax


def legend_of(axes: list[Axes]) -> None:
    """Legend above the first panel: both bearings, and the bounds."""
    from matplotlib.lines import Line2D

    handles = [
        Line2D([], [], color=COLOURS[b], marker="os"[b], ms=5.0, lw=1.3, label=f"{NAMES[b]}, bounds of 95 %")
        for b in range(2)
    ]
    legend_above(axes[0], handles, columns=1)


def _place(row: int, b: int) -> float:
    """Height of a bearing in its row."""
    return row + (_BESIDE if b else -_BESIDE)


def _rows(ax: Axes, names: list[str]) -> None:
    """Rows with their names, from top to bottom, and lines between them."""
    ax.set_ylim(len(names) - 0.5, -0.5)
    ax.yaxis.set_minor_locator(NullLocator())
    ax.set_yticks(np.arange(len(names)), labels=[_broken(name) for name in names])
    ax.tick_params(axis="y", length=0.0)
    for row in range(1, len(names)):
        ax.axhline(row - 0.5, color=GREY, lw=0.4, alpha=0.5)


def _broken(name: str) -> str:
    """Name on few short lines."""
    return "\n".join(textwrap.wrap(literal(name), _LETTERS, max_lines=_LINES, placeholder=" ..."))


def _log_axis(ax: Axes, low: float, high: float) -> None:
    ax.set_xscale("log")
    ax.set_xlim(low, high)
    ax.xaxis.set_major_locator(LogLocator(numticks=5))
    ax.xaxis.set_minor_formatter(NullFormatter())
