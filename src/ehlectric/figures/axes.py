"""Axes of figures: ticks, levels and colours of linear and of logarithmic values."""

from __future__ import annotations

import math

import matplotlib as mpl
import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Colormap, ListedColormap, LogNorm, Normalize
from matplotlib.font_manager import FontProperties
from matplotlib.ticker import FixedLocator, FuncFormatter, MaxNLocator, NullFormatter, NullLocator

from ehlectric.arrays import Array
from ehlectric.figures.data import is_wide
from ehlectric.figures.style import figure_of

COLOURS = colormaps["viridis"]

# For lines and dots on white: the lightest colours are left out, they can hardly be seen there.
DARK_COLOURS = ListedColormap(COLOURS(np.linspace(0.0, 0.85, 256)))

# An axis has a tick at each value where there are at most so many, each of at most so many characters.
_FEW_VALUES, _SHORT = 8, 4

# Place of a colour bar beside the axes, in parts of them.
BAR = (1.025, 0.0, 0.04, 1.0)

# Round numbers of a decade: three, six and twelve of them.
_FEW, _SOME = (1.0, 2.0, 5.0), (1.0, 1.5, 2.0, 3.0, 5.0, 7.0)
_MANY = (1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0)


def scale_axis(axis: Axis, text: str, *, values: Array, log: bool) -> None:
    """Label an axis; where ``log`` is set, make it logarithmic with ticks at round numbers.

    Parameters
    ----------
    axis : Axis
        The x or y axis.
    text : str
        Label of the axis.
    values : ndarray
        Values drawn along the axis, in its unit. Values that are not finite are ignored.
    log : bool
        Whether the axis is logarithmic.
    """
    axis.set_label_text(text)
    if not log:
        return
    ax = axis.axes
    assert ax is not None
    along = axis is ax.xaxis
    (ax.set_xscale if along else ax.set_yscale)("log")
    finite = values[np.isfinite(values)]
    ticks = _ticks(np.unique(finite))
    axis.set_major_locator(FixedLocator(list(_apart(ticks, ax) if along else ticks)))
    axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axis.set_minor_locator(NullLocator())
    axis.set_minor_formatter(NullFormatter())


def _apart(ticks: Array, ax: Axes) -> Array:
    """Ticks of a logarithmic x axis whose labels do not touch on the page; the largest ones stay."""
    if len(ticks) < 2:
        return ticks
    size = FontProperties(size=mpl.rcParams["xtick.labelsize"]).get_size_in_points()
    # Labels beside the curves take up to a third of the width from the axes.
    width = 0.67 * 72.0 * figure_of(ax).get_figwidth() * ax.get_position().width
    room = width / np.log(ticks[-1] / ticks[0])
    kept = [float(ticks[-1])]
    for tick in ticks[-2::-1]:
        # A digit is about 0.64 of its size wide, and two labels are as far from each other.
        letters = 0.5 * (len(f"{tick:g}") + len(f"{kept[0]:g}")) + 1.0
        if np.log(kept[0] / tick) * room >= 0.64 * size * letters:
            kept.insert(0, float(tick))
    return np.array(kept)


def _ticks(values: Array) -> Array:
    """Ticks of a logarithmic axis: the values themselves where they are few and short, else round numbers."""
    if values.size <= _FEW_VALUES and all(len(f"{value:g}") <= _SHORT for value in values):
        return values
    return np.asarray(round_numbers(float(values[0]), float(values[-1])))


def round_numbers(low: float, high: float) -> Array:
    """Round numbers from ``low`` to ``high``, at least four, about evenly spaced in their logarithm.

    Over a wide range they are powers of ten. Over a range too narrow for four such numbers they are evenly
    spaced, and the first and last may lie outside of it.

    Examples
    --------
    >>> round_numbers(0.2, 2.0)
    array([0.2, 0.5, 1. , 2. ])
    """
    decades = range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)
    slack = 1e-9
    for steps in ((1.0,), _FEW, _SOME, _MANY):
        all_steps = np.array([float(f"{step}e{decade}") for decade in decades for step in steps])
        inside = all_steps[(all_steps >= low * (1.0 - slack)) & (all_steps <= high * (1.0 + slack))]
        if inside.size >= 4:
            return inside
    return np.asarray(MaxNLocator(5).tick_values(low, high))


def by_logarithm(values: Array, *, log_axis: bool) -> bool:
    """Whether values are interpolated linearly in their logarithm between points.

    Film thickness and breakdown voltage are nearly powers of speed and load. On a logarithmic axis of speed
    or load, linear interpolation of the values themselves would overstate them between the points.

    Parameters
    ----------
    values : ndarray
        Values at the points. Values that are not finite are ignored.
    log_axis : bool
        Whether an axis that the values are drawn over is logarithmic.

    Returns
    -------
    bool
        True where all finite values are positive, and an axis is logarithmic or they differ by more than the
        ratio ``WIDE``.

    Examples
    --------
    >>> by_logarithm(np.array([1.0, 2.0]), log_axis=False), by_logarithm(np.array([1.0, 2.0]), log_axis=True)
    (False, True)
    """
    finite = values[np.isfinite(values)]
    positive = bool(finite.size and finite.min() > 0.0)
    return positive and (log_axis or is_wide(finite))


def levels_of(values: Array, *, log: bool) -> Array:
    """Round levels that enclose all finite values.

    Parameters
    ----------
    values : ndarray
        Values, of which at least one is finite; all positive where ``log``.
    log : bool
        Whether the levels are spaced evenly in their logarithm.

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
        levels = np.array([float(f"{step}e{decade}") for decade in decades for step in steps])
    else:
        room = 0.0 if high - low > 1e-6 * abs(high) else 0.01 * abs(high) or 1.0
        levels = np.asarray(MaxNLocator(14, steps=[1, 2, 2.5, 5, 10]).tick_values(low - room, high + room))
        low, high = low - room, high + room
    first = int(np.searchsorted(levels, low, side="right")) - 1
    last = int(np.searchsorted(levels, high, side="left"))
    return levels[max(first, 0) : max(last, first + 1) + 1]


def norm_of(levels: Array, *, log: bool) -> Normalize:
    """Normalisation of colours from the first level to the last."""
    return LogNorm(levels[0], levels[-1]) if log else Normalize(levels[0], levels[-1])


def colour_bar(ax: Axes, norm: Normalize, text: str, levels: Array, colours: Colormap = COLOURS) -> None:
    """Add a colour bar with ticks at round levels, at every second or third one where there are many."""
    # Beside the axes themselves, a wide legend above them does not push the bar away.
    beside = ax.inset_axes(BAR)
    bar = figure_of(ax).colorbar(ScalarMappable(norm, colours), cax=beside, label=text)
    ticks = levels if levels.size <= 9 else levels[:: 2 if levels.size <= 18 else 3]
    bar.set_ticks(list(ticks), labels=[f"{level:.6g}" for level in ticks])
    bar.ax.minorticks_off()
