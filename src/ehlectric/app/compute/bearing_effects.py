"""Effects of single inputs on the margin of a bearing, as a table of its page."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from ehlectric.app.answers.bearing import Table
from ehlectric.discharge.verdict import ratio_text
from ehlectric.quantities.bearing_results import BEARING_BOOK
from ehlectric.tables.bearing import input_range

EFFECT_HEADS = ("one input changed", "lowest margin", "with", "highest margin", "with")

_CAPTION = "Margin if one input changes and all others stay, largest effect first; below 1 breakdown is {}"


def effects_table(summary: Mapping[str, Any], level: str) -> Table | None:
    """Table of the inputs that change the margin, with the value of each that belongs to either end.

    Parameters
    ----------
    summary : mapping
        Summary of a bearing, SI units; without its table ``margin`` there are no effects.
    level : str
        Level of the verdict, which is no surer at other inputs.

    Returns
    -------
    Table or None
        None without any effect.
    """
    effects = (summary.get("margin") or {}).get("effects")
    if not effects:
        return None
    caption = _CAPTION.format("likely" if level == "yellow" else "expected")
    return Table(caption, EFFECT_HEADS, tuple(tuple(_cells(effect)) for effect in effects))


def _cells(effect: Mapping[str, Any]) -> Iterator[str]:
    bound = BEARING_BOOK["margin.effects"].bound
    # Both values with the unit that the range has.
    low, _, rest = input_range(effect).partition(" to ")
    high, _, unit = rest.partition(" ")
    ends = [
        (effect[f"{name}_margin"], f"{value} {unit}".rstrip())
        for name, value in (("low", low), ("high", high))
    ]
    yield effect["label"]
    for margin, value in sorted(ends, key=lambda end: end[0]):
        yield f"{bound} {ratio_text(margin)}" if margin > 0.0 else "surfaces touch"
        yield value
