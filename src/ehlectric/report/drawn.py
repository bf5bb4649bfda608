"""Figures of a report, with their findings as titles."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from types import MappingProxyType
from typing import Any

from matplotlib.figure import Figure

from ehlectric.errors import InputError, printable
from ehlectric.figures.results import figure, figure_names
from ehlectric.report.captions import caption_of
from ehlectric.report.content import Picture, Text

# Values of a sweep that a report draws beside the breakdown voltage; all others are drawn by ehlectric map.
SWEPT = ("bearing.margin", "bearing.capacitance", "film.minimum_thickness", "field.max_strength")

# Sentences in place of figures that have nothing to show.
_EMPTY: Mapping[str, str] = MappingProxyType(
    {"breakdown_over_speed": "There is no figure of the breakdown voltage over the speed: no speed has one."}
)

# Marks of formulas in titles, which matplotlib draws.
_FORMULA = re.compile(r"(?<!\\)\$|\\mathrm|[{}]")


def pictures_of(
    result: Any, *, converged: bool, names: Iterable[str] | None = None
) -> Iterator[Picture | Text]:
    """Figures of a result; a sentence in place of a figure that has nothing to show.

    Parameters
    ----------
    result : Result, PointResult, BearingResult, DriveResult, MotionResult or SweepResults
        Result.
    converged : bool
        Whether the result is converged; captions say so where it is not.
    names : iterable of str, optional
        Names of the figures; by default all of the result.
    """
    for name in figure_names(result) if names is None else names:
        try:
            drawn = figure(result, name, style="screen")
        except InputError as error:
            yield Text(_EMPTY.get(name) or f"The figure {name} is not drawn: {error.text}.")
            continue
        title = title_of(drawn)
        if title and converged:
            _drop_finding(drawn)
        yield Picture(name, title or name, caption_of(name, converged=converged), drawn)


def swept_names(result: Any, values: Iterable[str]) -> list[str]:
    """Names of the figures of a sweep that a report has, for these keys of the summary."""
    names = figure_names(result)
    wanted = [f"{way}{value}" for value in dict.fromkeys(values) for way in ("map_", "lines_")]
    return [name for name in ("sensitivity", *wanted) if name in names]


def title_of(drawn: Figure) -> str:
    """Title of a figure as plain text on one line."""
    lines = (line.strip() for line in drawn.get_suptitle().split("\n"))
    text = _FORMULA.sub("", " ".join(filter(None, lines)))
    return printable(text.replace(r"\$", "$").replace("\xa0", " "))


def _drop_finding(drawn: Figure) -> None:
    """Take the finding out of the title of a figure, as the caption has it; lines below it stay."""
    lines = drawn.get_suptitle().split("\n")
    below = "\n".join(line for line in lines if not line.strip())
    drawn.suptitle(below, x=0.01, ha="left")
