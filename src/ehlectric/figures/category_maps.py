"""Maps of names over two varied keys, such as the element of an axle that breaks down first."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib import colormaps
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap, to_hex, to_rgba
from matplotlib.patches import Patch

from ehlectric.arrays import Array
from ehlectric.errors import printable
from ehlectric.figures.data import MapPanel
from ehlectric.quantities.lubrication_states import AT_TIMES, CONDUCTS, INSULATES
from ehlectric.quantities.palette import AMBER, BLUE, GREEN, GREY, ORANGE, PURPLE, SKY

# Colours of names by their order; further names have colours of ``_MANY``.
_NAMED, _MANY = (BLUE, ORANGE, GREEN, PURPLE, AMBER, SKY), "tab20b"

# Colours of electrical states, as on maps of the share of time.
_STATES = {CONDUCTS: GREY, AT_TIMES: ORANGE, INSULATES: BLUE}

# Opacity of the areas, so that the marks of the points stay visible.
_OPACITY = 0.55


def colours_of_names(names: Sequence[str]) -> list[str]:
    """Colour of each name.

    Examples
    --------
    >>> colours_of_names(["insulates", "conducts"]) == [BLUE, GREY]
    True
    """
    # Five hues of four tones: neighbours differ in hue.
    many = [
        to_hex(colormaps[_MANY](4 * (number % 5) + number // 5)) for number in (3, 2, 0, 1, *range(4, 20))
    ]
    colours = [*_NAMED, *many]
    return [_STATES.get(name, colours[number % len(colours)]) for number, name in enumerate(names)]


def edges_of(places: Array, *, log: bool) -> Array:
    """Edges of the cells around increasing places, shape (n + 1,): halfway between neighbours on the axis.

    Examples
    --------
    >>> edges_of(np.array([1.0, 2.0, 4.0]), log=False).tolist()
    [0.5, 1.5, 3.0, 5.0]
    >>> edges_of(np.array([1.0, 4.0, 16.0]), log=True).round(9).tolist()
    [0.5, 2.0, 8.0, 32.0]
    """
    on_axis = np.log(places) if log else places
    middle = 0.5 * (on_axis[1:] + on_axis[:-1])
    edges = np.concatenate(([2.0 * on_axis[0] - middle[0]], middle, [2.0 * on_axis[-1] - middle[-1]]))
    return np.asarray(np.exp(edges) if log else edges)


def draw_categories(panel: MapPanel, ax: Axes) -> list[Artist]:
    """Colour the cell around each point of a full grid, or the points of another design, by their names.

    Returns the legend entries, with the number of points of each name.
    """
    colours = [to_rgba(colour, _OPACITY) for colour in colours_of_names(panel.categories)]
    known = np.isfinite(panel.values)
    x, i = np.unique(panel.places[0], return_inverse=True)
    y, j = np.unique(panel.places[1], return_inverse=True)
    if min(x.size, y.size) > 1 and x.size * y.size == panel.values.size:
        cells = np.full((y.size, x.size), np.nan)
        cells[j, i] = panel.values
        along, across = (edges_of(at, log=axis.log) for at, axis in zip((x, y), panel.axes, strict=True))
        ax.pcolormesh(
            along,
            across,
            np.ma.masked_invalid(cells),
            cmap=ListedColormap(colours),
            vmin=-0.5,
            vmax=len(colours) - 0.5,
        )
    else:
        shown = [colours[int(number)] for number in panel.values[known]]
        along, across = panel.places[:, known]
        ax.scatter(along, across, c=shown, s=60.0, edgecolors="black", lw=0.5, zorder=4.0)
    counts = [int(np.sum(panel.values == number)) for number in range(len(colours))]
    return [
        Patch(facecolor=colour, label=f"{printable(name)}: {count} points")
        for name, colour, count in zip(panel.categories, colours, counts, strict=True)
        if count
    ]
