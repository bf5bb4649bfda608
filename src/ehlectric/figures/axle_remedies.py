"""Figure of the remedies of an axle: U/V_b of each bearing and mesh with each remedy."""

from __future__ import annotations

import textwrap
from collections.abc import Mapping
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm

from ehlectric.axle import AxleResult, axle_summary, ratio_word, worst_ratio
from ehlectric.errors import printable
from ehlectric.figures.style import new_panels
from ehlectric.figures.sweep_maps import DIVERGING
from ehlectric.quantities.lubrication_states import TOUCHES
from ehlectric.readable import capital, readable

# Letters on a line of the name of a remedy, and ratio from which a colour is full.
_LETTERS, _FULL = 14, 30.0

# Width that the text below the figure needs [inches].
_LEAST_WIDTH = 7.0

# Part of the logarithmic range of colours, from its middle, from which letters are white.
_DARK = 0.55


def axle_remedies(result: AxleResult) -> Axes:
    """Draw U/V_b of all elements as they are and with each remedy: red above 1, blue below 1."""
    names, titles, rows = _table(result)
    ratios = np.array([[row["voltage_ratio"] for row in of_element] for of_element in rows], dtype=float)
    width = max(_LEAST_WIDTH, 2.8 + 1.15 * len(titles))
    (ax,) = new_panels(1, 1, (width, 1.9 + 0.42 * len(names)))
    drawn = np.clip(ratios, 1.0 / _FULL, _FULL)
    ax.imshow(np.ma.masked_invalid(drawn), aspect="auto", cmap=DIVERGING, norm=LogNorm(1.0 / _FULL, _FULL))
    for row, column in np.ndindex(*ratios.shape):
        value = ratios[row, column]
        known = np.isfinite(value)
        dark = known and abs(np.log(drawn[row, column])) > _DARK * np.log(_FULL)
        text, color = _text(rows[row][column]), "white" if dark else "black"
        ax.text(column, row, text, ha="center", va="center", color=color, linespacing=0.95)
    ax.set_xticks(range(len(titles)), ["\n".join(textwrap.wrap(title, _LETTERS)) for title in titles])
    ax.set_yticks(range(len(names)), names)
    ax.xaxis.tick_top()
    ax.tick_params(length=0.0)
    ax.set_xlabel(
        "voltage / breakdown voltage, in brackets its largest value\nif all meshes conduct, or none; "
        "summits that touch discharge at any voltage"
    )
    return ax


def _table(result: AxleResult) -> tuple[list[str], list[str], list[list[Mapping[str, Any]]]]:
    """Names of the elements, the first to discharge first; titles; and rows of all elements by the titles."""
    solutions = (result.solution, *result.remedies)
    tables = [{row["element"]: row for row in axle_summary(each)["elements"]} for each in solutions]
    ranked = [name for name, _ in result.solution.ranking()]
    names = [*ranked, *(name for name in tables[0] if name not in ranked)]
    titles = ["as it is", *(remedy.title for _, remedy in result.case.numbered_remedies)]
    rows = [[table[name] for table in tables] for name in names]
    return [printable(name) for name in names], [printable(title) for title in titles], rows


def _text(row: Mapping[str, Any]) -> str:
    """U/V_b of an element, below it the largest one if all meshes conduct, or none; or a word."""
    worst = worst_ratio(row)
    ratio = ratio_word(row) or readable(row["voltage_ratio"], 3)
    return ratio if worst is None else f"{ratio}\n({readable(worst, 3)})"


def remedies_finding(result: AxleResult) -> str:
    """Sentence about the remedy with the smallest largest ratio."""
    _, titles, rows = _table(result)
    columns = [*zip(*rows, strict=True)]
    largest = [max(row["voltage_ratio"] or 0.0 for row in column) for column in columns]
    best = min(range(len(largest)), key=lambda number: largest[number])
    worst = max((worst_ratio(row) or 0.0 for row in columns[best]), default=0.0)
    touching = sum(ratio_word(row) == TOUCHES for row in columns[best])
    others = f"; summits touch in {touching} other{'s' if touching > 1 else ''}" if touching else ""
    meshes = f", or {readable(worst, 3)} if all meshes conduct, or none" if worst > largest[best] else ""
    return capital(
        f"{titles[best]}: the largest voltage / breakdown voltage is {readable(largest[best], 3)}{meshes}, "
        f"instead of {readable(largest[0], 3)}{others}"
    )
