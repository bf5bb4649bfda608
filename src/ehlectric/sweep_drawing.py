"""What the figures of a sweep share: axes with their units, points by their status, levels, legends."""

from __future__ import annotations

import math
import textwrap
from typing import Any

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Colormap, ListedColormap, LogNorm, Normalize
from matplotlib.lines import Line2D
from matplotlib.patheffects import withStroke
from matplotlib.ticker import FixedLocator, FuncFormatter, MaxNLocator, NullFormatter, NullLocator

from ehlectric.drawing import GREY, ORANGE, figure_of, name_over
from ehlectric.sweep_labels import Label, Scale, label_of
from ehlectric.sweep_results import SweepResults
from ehlectric.sweep_slices import Slice
from ehlectric.typing import Array, Mask

COLOURS = colormaps["viridis"]

# For lines and dots on white: without the lightest, which is hardly seen there.
DARK_COLOURS = ListedColormap(COLOURS(np.linspace(0.0, 0.85, 256)))

# Values that differ by more than this ratio have logarithmic colours or axes.
WIDE = 20.0

# How points are shown by what became of them: in maps, and in legends.
_MARKS: dict[str, dict[str, Any]] = {
    "solved": {"marker": "o", "ms": 2.6, "color": "black", "mew": 0.0},
    "without this value": {"marker": "s", "ms": 4.0, "color": GREY, "mfc": "none", "mew": 0.8},
    "do not use": {"marker": "D", "ms": 4.2, "color": ORANGE, "mfc": "none", "mew": 1.2},
    "not converged": {"marker": "+", "ms": 7.0, "color": "black", "mew": 1.3},
    "failed": {"marker": "x", "ms": 5.5, "color": ORANGE, "mew": 1.6},
    "not tried yet": {"marker": "o", "ms": 4.0, "color": GREY, "mfc": "none", "mew": 0.8},
}

# How many values, of how many letters at most, are the ticks of their axis.
_FEW_VALUES, _SHORT = 8, 4

# Round numbers in a decade, few, some and many.
_FEW, _SOME = (1.0, 2.0, 5.0), (1.0, 1.5, 2.0, 3.0, 5.0, 7.0)
_MANY = (1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0)


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


def scale_axis(axis: Axis, text: str, *, values: Array, log: bool) -> None:
    """Label an axis; where it is logarithmic, with ticks at round numbers.

    Parameters
    ----------
    axis : Axis
        The x or y axis.
    text : str
        Its label.
    values : ndarray
        What is drawn along it, in its unit.
    log : bool
        Whether it is logarithmic.
    """
    axis.set_label_text(text)
    if not log:
        return
    ax = axis.axes
    assert ax is not None
    (ax.set_xscale if axis.axis_name == "x" else ax.set_yscale)("log")  # type: ignore[attr-defined]
    finite = values[np.isfinite(values)]
    axis.set_major_locator(FixedLocator(list(_ticks(np.unique(finite)))))
    axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axis.set_minor_locator(NullLocator())
    axis.set_minor_formatter(NullFormatter())


def _ticks(values: Array) -> Array:
    """The values themselves where they are few and short, else round numbers."""
    if values.size <= _FEW_VALUES and all(len(f"{value:g}") <= _SHORT for value in values):
        return values
    return np.asarray(round_numbers(float(values[0]), float(values[-1])))


def round_numbers(low: float, high: float) -> Array:
    """Four or more round numbers from ``low`` to ``high``, evenly in their logarithm; decades of wide ranges.

    Examples
    --------
    >>> round_numbers(0.2, 2.0)
    array([0.2, 0.5, 1. , 2. ])
    """
    decades = range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)
    slack = 1e-9
    found = np.empty(0)
    for steps in ((1.0,), _FEW, _SOME, _MANY):
        all_steps = np.array([float(f"{step}e{decade}") for decade in decades for step in steps])
        found = all_steps[(all_steps >= low * (1.0 - slack)) & (all_steps <= high * (1.0 + slack))]
        if found.size >= 4:
            return found
    return np.asarray(MaxNLocator(5).tick_values(low, high))


def is_wide(values: Array) -> bool:
    """Whether values, those that are finite, are positive and differ widely."""
    return by_logarithm(values, log_axis=False)


def by_logarithm(values: Array, *, log_axis: bool) -> bool:
    """Whether it is the logarithm of values that is linear between points.

    Film and breakdown voltage go nearly with powers of speed and load; straight lines over a logarithmic axis
    would overstate them between the points.

    Parameters
    ----------
    values : ndarray
        Those that are not finite do not count.
    log_axis : bool
        Whether an axis that they lie over is logarithmic.

    Examples
    --------
    >>> by_logarithm(np.array([1.0, 2.0]), log_axis=False), by_logarithm(np.array([1.0, 2.0]), log_axis=True)
    (False, True)
    """
    finite = values[np.isfinite(values)]
    if not finite.size or finite.min() <= 0.0:
        return False
    return log_axis or bool(finite.max() > WIDE * finite.min())


def levels_of(values: Array, *, log: bool) -> Array:
    """Round levels from the least of values or below to the largest or above; not finite ones do not count.

    Examples
    --------
    >>> levels_of(np.array([3.0, 9.5]), log=False)
    array([3. , 3.5, 4. , 4.5, 5. , 5.5, 6. , 6.5, 7. , 7.5, 8. , 8.5, 9. ,
           9.5])
    >>> levels_of(np.array([0.03, 20.0]), log=True)
    array([ 0.02,  0.05,  0.1 ,  0.2 ,  0.5 ,  1.  ,  2.  ,  5.  , 10.  ,
           20.  ])
    """
    finite = values[np.isfinite(values)]
    low, high = float(finite.min()), float(finite.max())
    if log:
        steps = (1.0,) if high > 1e5 * low else _FEW if high > 300.0 * low else _SOME
        decades = range(math.floor(math.log10(low)) - 1, math.ceil(math.log10(high)) + 2)
        found = np.array([float(f"{step}e{decade}") for decade in decades for step in steps])
    else:
        room = 0.0 if high - low > 1e-6 * abs(high) else 0.01 * abs(high) or 1.0
        found = np.asarray(MaxNLocator(14, steps=[1, 2, 2.5, 5, 10]).tick_values(low - room, high + room))
        low, high = low - room, high + room
    first = int(np.searchsorted(found, low, side="right")) - 1
    last = int(np.searchsorted(found, high, side="left"))
    return found[max(first, 0) : max(last, first + 1) + 1]


def norm_of(levels: Array, *, log: bool) -> Normalize:
    """Colours from the first level to the last."""
    return LogNorm(levels[0], levels[-1]) if log else Normalize(levels[0], levels[-1])


def colour_bar(ax: Axes, norm: Normalize, text: str, levels: Array, colours: Colormap = COLOURS) -> None:
    """Colour bar with round levels, every second or third one named where they are many."""
    bar = figure_of(ax).colorbar(ScalarMappable(norm, colours), ax=ax, label=text, pad=0.02)
    ticks = levels if levels.size <= 9 else levels[:: 2 if levels.size <= 18 else 3]
    bar.set_ticks(list(ticks), labels=[f"{level:.6g}" for level in ticks])
    bar.ax.minorticks_off()


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
