"""What the figures of a sweep share: axes with their units, points by their status, levels, legends."""

from __future__ import annotations

import math
import textwrap
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patheffects import withStroke

from ehlectric.arrays import Array, Mask
from ehlectric.figures.style import GREY, ORANGE, name_over
from ehlectric.sweep.labels import Label, Scale, label_of
from ehlectric.sweep.results import SweepResults
from ehlectric.sweep.slices import Slice

# How points are shown by what became of them: in maps, and in legends.
_MARKS: dict[str, dict[str, Any]] = {
    "solved": {"marker": "o", "ms": 2.6, "color": "black", "mew": 0.0},
    "without this value": {"marker": "s", "ms": 4.0, "color": GREY, "mfc": "none", "mew": 0.8},
    "do not use": {"marker": "D", "ms": 4.2, "color": ORANGE, "mfc": "none", "mew": 1.2},
    "not converged": {"marker": "+", "ms": 7.0, "color": "black", "mew": 1.3},
    "failed": {"marker": "x", "ms": 5.5, "color": ORANGE, "mew": 1.6},
    "not tried yet": {"marker": "o", "ms": 4.0, "color": GREY, "mfc": "none", "mew": 0.8},
}


def kinds(taken: Slice) -> dict[str, Mask]:
    """Which points of a slice are of each kind that is shown, shape (points,) each; those there are."""
    known = np.isfinite(taken.values)
    masks = {
        "solved": taken.of("solved") & known,
        "without this value": taken.of("solved") & ~known & ~taken.doubtful,
        "do not use": taken.doubtful,
        "not converged": taken.of("not converged"),
        "failed": taken.of("failed"),
        "not tried yet": taken.of("open"),
    }
    return {kind: mask for kind, mask in masks.items() if np.any(mask)}


def dot_size(taken: Slice, largest: float) -> float:
    """Size of the dots of solved points [pt]: where there are many, they leave room between them."""
    return largest * min(1.0, max(0.3, math.sqrt(400.0 / len(taken.points))))


def mark(ax: Axes, kind: str, x: Array, y: Array, **look: Any) -> None:
    """Mark points of a kind, over everything else."""
    edge = [] if kind == "solved" else [withStroke(linewidth=2.6, foreground="white")]
    plain: dict[str, Any] = {"ls": "none", "zorder": 5.0, "clip_on": False, "path_effects": edge}
    ax.plot(x, y, **(plain | _MARKS[kind] | look))


def kind_handles(taken: Slice, **look: Any) -> list[Line2D]:
    """Entries of a legend: how many points there are of each kind."""
    return [
        Line2D([], [], ls="none", label=f"{np.sum(mask)} {kind}", **(_MARKS[kind] | look))
        for kind, mask in kinds(taken).items()
    ]


def labelled(results: SweepResults, key: str, values: Array) -> tuple[Label, Scale]:
    """What a key is called, and the unit that suits these values."""
    label = label_of(key, results.case)
    return label, label.scaled(values)


def voltage_text(taken: Slice) -> str:
    """The applied voltage of the solved points, or its range."""
    return range_text(taken.voltage[np.isfinite(taken.voltage)], "V")


def range_text(values: Array, unit: str) -> str:
    """Values as one with its unit, or from the least to the largest.

    Examples
    --------
    >>> range_text(np.array([2.0, 2.0]), "V"), range_text(np.array([2.0, 30.0]), "V")
    ('2 V', '2 to 30 V')
    """
    low, high = float(values.min()), float(values.max())
    return f"{low:.4g} {unit}" if high - low <= 1e-9 * high else f"{low:.4g} to {high:.4g} {unit}"


def name_figure(ax: Axes, results: SweepResults, more: str) -> None:
    """Title of a figure: that of the case, and below it what else there is to say."""
    title = textwrap.shorten(results.title, 70, placeholder=" ...")
    text = "\n".join(filter(None, [title, textwrap.fill(more, 100)]))
    if text:
        name_over(ax, text)


def held_text(results: SweepResults, taken: Slice) -> str:
    """What is held at which value, and what varies beside what is drawn."""
    texts = []
    for key, value in taken.at.items():
        numbers = np.array([value]) if isinstance(value, int | float) else np.empty(0)
        label, scale = labelled(results, key, numbers)
        texts.append(f"{label.name} = {scale.text(value)}")
    if taken.free:
        names = ", ".join(label_of(key, results.case).name for key in taken.free)
        texts.append(f"at any {names}")
    return ", ".join(texts)
