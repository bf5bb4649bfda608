"""Figure of the remedies of an axle: U/V_b of each bearing and mesh with each remedy."""

from __future__ import annotations

import textwrap

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm

from ehlectric.axle import AxleResult, Element
from ehlectric.errors import printable
from ehlectric.figures.style import new_panels
from ehlectric.figures.sweep_maps import DIVERGING
from ehlectric.quantities.lubrication_states import CONDUCTS
from ehlectric.readable import capital, readable

# Letters on a line of the name of a remedy, and ratio from which a colour is full.
_LETTERS, _FULL = 14, 30.0

# Part of the logarithmic range of colours, from its middle, from which letters are white.
_DARK = 0.55


def axle_remedies(result: AxleResult) -> Axes:
    """Draw U/V_b of all elements as they are and with each remedy: red above 1, blue below 1."""
    names, titles, ratios, words = _table(result)
    (ax,) = new_panels(1, 1, (2.8 + 1.15 * len(titles), 1.9 + 0.42 * len(names)))
    drawn = np.clip(ratios, 1.0 / _FULL, _FULL)
    ax.imshow(np.ma.masked_invalid(drawn), aspect="auto", cmap=DIVERGING, norm=LogNorm(1.0 / _FULL, _FULL))
    for row, column in np.ndindex(*ratios.shape):
        value = ratios[row, column]
        known = np.isfinite(value)
        dark = known and abs(np.log(drawn[row, column])) > _DARK * np.log(_FULL)
        text = readable(float(value), 3) if known else words[row][column]
        ax.text(column, row, text, ha="center", va="center", color="white" if dark else "black")
    ax.set_xticks(range(len(titles)), ["\n".join(textwrap.wrap(title, _LETTERS)) for title in titles])
    ax.set_yticks(range(len(names)), names)
    ax.xaxis.tick_top()
    ax.tick_params(length=0.0)
    ax.set_xlabel("voltage / breakdown voltage\n(summits that touch discharge at any voltage)")
    return ax


def _table(result: AxleResult) -> tuple[list[str], list[str], np.ndarray, list[list[str]]]:
    """Names of the elements, the first to break down first; titles; U/V_b, NaN without one; and why there is
    none.
    """
    solutions = (result.solution, *result.remedies)
    tables = [dict(solution.ranking()) for solution in solutions]
    rest = [each.name for each in result.solution.elements if each.name not in tables[0]]
    names = [*tables[0], *rest]
    titles = ["as it is", *(remedy.title for remedy in result.case.remedies)]
    ratios = np.array([[table.get(name, np.nan) for table in tables] for name in names])
    elements = [{each.name: each for each in solution.elements} for solution in solutions]
    words = [[_without_ratio(of[name]) for of in elements] for name in names]
    return [printable(name) for name in names], [printable(title) for title in titles], ratios, words


def _without_ratio(element: Element) -> str:
    """Word for an element that has no ratio of voltages."""
    if element.state == CONDUCTS:
        return CONDUCTS
    return "touches" if element.touching else "–"


def remedies_finding(result: AxleResult) -> str:
    """Sentence about the remedy with the smallest largest ratio."""
    _, titles, ratios, words = _table(result)
    largest = [float(np.nanmax(column)) if np.any(np.isfinite(column)) else 0.0 for column in ratios.T]
    best = int(np.argmin(largest))
    touching = sum(row[best] == "touches" for row in words)
    others = f"; summits touch in {touching} other{'s' if touching > 1 else ''}" if touching else ""
    return capital(
        f"{titles[best]}: the largest voltage / breakdown voltage is {readable(largest[best], 3)} instead of "
        f"{readable(largest[0], 3)}{others}"
    )
