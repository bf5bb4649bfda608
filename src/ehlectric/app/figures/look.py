"""Common look of the figures: colours, layout, axes, numbers, and marks of a result that did not converge."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ehlectric.arrays import Array
from ehlectric.quantities.palette import MIDDLE_GREY

# Maps of colours: film, pressure and field. Plotly has no Plasma of its own.
FILM_COLOURS, PRESSURE_COLOURS = "Viridis", "Cividis"
_PLASMA = [
    "#0d0887",
    "#46039f",
    "#7201a8",
    "#9c179e",
    "#bd3786",
    "#d8576b",
    "#ed7953",
    "#fb9f3a",
    "#fdca26",
    "#f0f921",
]
FIELD_COLOURS = [[round(k / 9.0, 4), colour] for k, colour in enumerate(_PLASMA)]

# Lines of the grid and of axes: seen on white and on black.
_GRID, _LINE = "rgba(128,128,128,0.25)", "rgba(128,128,128,0.7)"

# Colour of texts in figures of three dimensions, which the styles of the page do not reach: readable on
# white and on black.
INK = "#808080"

# Text across a figure of a film that did not converge.
NO_SOLUTION = "NOT CONVERGED<br>do not use these values"

Plot = dict[str, Any]
Indices = NDArray[np.intp]


def plot(data: Iterable[Mapping[str, Any]], *, height: int, converged: bool = True, **layout: Any) -> Plot:
    """Figure of Plotly with the look of the app.

    Parameters
    ----------
    data : iterable of mapping
        Traces.
    height : int
        Height of the figure [px].
    converged : bool
        Whether the result converged; if not, words across the figure say so.
    **layout
        Further keys of the layout.

    Returns
    -------
    dict
        Data, layout and config. Texts have no colours: the styles of the page give them, in light and dark.
    """
    whole: Plot = {
        "height": height,
        "margin": {"l": 62, "r": 16, "t": 36, "b": 48},
        "paper_bgcolor": "rgba(0,0,0,0)",
        "plot_bgcolor": "rgba(0,0,0,0)",
        "font": {"size": 13},
        "legend": {"orientation": "h", "x": 0.0, "y": 1.02, "yanchor": "bottom"},
        "hoverlabel": {"font": {"size": 13}},
        "modebar": {"bgcolor": "rgba(0,0,0,0)"},
        "uirevision": "same",
        **layout,
    }
    if not converged:
        whole["annotations"] = [*whole.get("annotations", ()), _across(NO_SOLUTION)]
    return {"data": [dict(trace) for trace in data], "layout": whole, "config": _CONFIG}


_CONFIG: Plot = {
    "displaylogo": False,
    "modeBarButtonsToRemove": ["select2d", "lasso2d", "autoScale2d"],
    "toImageButtonOptions": {"format": "svg", "filename": "ehlectric"},
}


def axis(title: str = "", **more: Any) -> Plot:
    """Axis of a figure; ``title`` has its unit in brackets."""
    look: Plot = {"gridcolor": _GRID, "zerolinecolor": _LINE, "linecolor": _LINE, "ticks": "outside"}
    look |= {"tickcolor": _LINE, "automargin": True, "showline": True}
    return look | ({"title": {"text": title, "standoff": 6}} if title else {}) | more


def log_ticks(*, log: bool) -> Plot:
    """Type of an axis, and ticks of a logarithmic one, whose numbers are written in full."""
    if not log:
        return {"type": "linear"}
    ticks = [digit * 10.0**power for power in range(-6, 10) for digit in (1.0, 2.0, 5.0)]
    texts = [f"{tick:.12g}" for tick in ticks]
    return {"type": "log", "tickmode": "array", "tickvals": ticks, "ticktext": texts}


def vertical(at: float, **more: Any) -> Plot:
    """Dashed line across all panels at a position, such as the edge of the dry contact."""
    line = {"color": MIDDLE_GREY, "width": 1, "dash": "dash"}
    return {"type": "line", "x0": at, "x1": at, "yref": "paper", "y0": 0.0, "y1": 1.0, "line": line} | more


def values(array: Any, digits: int = 7) -> list[Any]:
    """Numbers of an array as nested lists, with a number of digits; None where there is none.

    Examples
    --------
    >>> values([1.23456789, float("nan"), 0.0], 4)
    [1.235, None, 0.0]
    """
    numbers = np.asarray(array, dtype=float)
    finite = np.isfinite(numbers)
    size = np.abs(np.where(finite & (numbers != 0.0), numbers, 1.0))
    factor = 10.0 ** np.clip(digits - 1 - np.floor(np.log10(size)), -300, 300)
    rounded = np.where(finite, np.round(np.where(finite, numbers, 0.0) * factor) / factor, 0.0)
    whole: NDArray[Any] = rounded
    if not finite.all():
        whole = rounded.astype(object)
        whole[~finite] = None
    found: list[Any] = whole.tolist()
    return found


def thinned(curves: Sequence[Array], most: int) -> Indices:
    """Indices of nodes along a line, of which every curve keeps its smallest and its largest values.

    Parameters
    ----------
    curves : sequence of ndarray, shape (n,)
        Values over the same nodes.
    most : int
        Largest number of intervals; each has up to two nodes of each curve.

    Returns
    -------
    ndarray of int
        Increasing indices, with both ends; all of them where they are few.

    Examples
    --------
    >>> wave = np.sin(np.linspace(0.0, 9.0, 10001))
    >>> kept = thinned([wave], 100)
    >>> kept.size < 210, bool(np.max(wave[kept]) == np.max(wave))
    (True, True)
    """
    number = curves[0].size
    if number <= 2 * most:
        return np.arange(number)
    edges = np.linspace(0, number, most + 1).astype(int)
    kept = {0, number - 1}
    for curve in curves:
        for first, last in pairwise(edges):
            part = curve[first:last]
            kept |= {first + int(np.argmin(part)), first + int(np.argmax(part))}
    return np.array(sorted(kept))


def kept_nodes(number: int, most: int, also: Iterable[int] = ()) -> Indices:
    """Indices of at most ``most`` nodes of a number, evenly spaced, with both ends and some others.

    Examples
    --------
    >>> kept_nodes(17, 6, [3]).tolist()
    [0, 3, 4, 8, 12, 16]
    """
    if number <= most:
        return np.arange(number)
    further = sorted(set(also))
    even = np.round(np.linspace(0, number - 1, max(2, most - len(further)))).astype(int)
    return np.unique(np.concatenate([even, np.array(further, dtype=int)]))


def _across(text: str) -> Plot:
    place = {"xref": "paper", "yref": "paper", "x": 0.5, "y": 0.5, "showarrow": False}
    return place | {"text": text, "font": {"size": 26}, "opacity": 0.85, "textangle": -12}
