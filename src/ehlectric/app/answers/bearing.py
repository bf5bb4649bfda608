"""Answers about a bearing, as data."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from ehlectric.app.answers.line import Line
from ehlectric.app.answers.number import Number
from ehlectric.app.answers.told import Told
from ehlectric.cases.bearings.ways import Contacts

# Texts of an answer at once in place of what the whole one adds: a number, and the range of the margin
# in the verdict and beside the margin.
PENDING = "…"
FOLLOWS = "Margin at once; its range follows."
RANGE_FOLLOWS = "its range within the stated ranges follows"


@dataclass(frozen=True)
class Judged:
    """Verdict on a bearing, taken apart.

    Attributes
    ----------
    level : str
        "green", "yellow", "red", or "grey" without a verdict.
    lead : str
        Heading, such as "No breakdown expected in an ideal film", for a margin that is an upper bound.
    meaning : str
        What this means for the bearing, in plain words.
    numbers : str
        Numbers that decide.
    reasons : tuple of str
        Further sentences: speeds, what is uncertain, and what follows.
    assumptions : str
        Sentence about what is assumed, which names an upper bound; empty without one.
    bound : str
        "upper bound" where the verdict is on one; empty otherwise.
    """

    level: str
    lead: str
    meaning: str
    numbers: str
    reasons: tuple[str, ...]
    assumptions: str
    bound: str = ""


@dataclass(frozen=True)
class Table:
    """Table of texts.

    Attributes
    ----------
    caption : str
        What the table has.
    heads : tuple of str
        Heads of the columns, with units.
    rows : tuple of tuple of str
        Cells.
    """

    caption: str
    heads: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]


@dataclass(frozen=True)
class Figure:
    """Figure of an answer.

    Attributes
    ----------
    title : str
        Heading of the figure.
    label : str
        What it shows, for those who do not see it.
    plot : mapping
        Data and layout of Plotly.
    table : Table
        Its main numbers.
    caption : str
        What a reader must know beside the figure.
    """

    title: str
    label: str
    plot: Mapping[str, Any]
    table: Table
    caption: str = ""


@dataclass(frozen=True)
class Difference:
    """Difference of a solved number from the quick one, as texts; ``way`` is "atlas" or "formula"."""

    name: str
    quick: str
    solved: str
    change: str
    way: str


@dataclass(frozen=True)
class BearingAnswer:
    """Answer about a bearing, in SI units.

    Attributes
    ----------
    title : str
        Title of the case.
    contacts : str
        "atlas", "formula" or "solved".
    whole : bool
        Whether it has all that takes a moment: speeds, ranges, effects of inputs, and the final verdict.
    converged : bool
        Whether the films of all contacts converged.
    level : str
        Level of the verdict; "grey" without one.
    text : str
        The verdict in sentences.
    judged : Judged
        The verdict taken apart.
    how : str
        How the contacts were computed, and how far off they may be.
    shown : tuple of Number
        Numbers at the top.
    numbers : mapping of str to float, str, bool or None
        Numbers of the table ``bearing`` of summary.json.
    margin : mapping or None
        Table ``margin`` of summary.json; None unless ``whole``.
    contact_rows : tuple of mapping
        A row for each element and ring, as in ``contacts.csv``.
    lines : tuple of Line
        All rows that the command prints.
    figures : mapping of str to Figure
        "load" and "film"; with a whole answer "breakdown" and "capacitance" over the speed. Empty where the
        films are not converged.
    differences : tuple of Difference
        Differences of a solved answer from the quick one.
    effects : Table or None
        Margins if one input changes; None unless ``whole``, and without a margin.
    warnings : tuple of Told
        Warnings, with the numbers that they concern.
    seconds : float
        Computing time [s].
    """

    title: str
    contacts: Contacts
    whole: bool
    converged: bool
    level: str
    text: str
    judged: Judged
    how: str
    shown: tuple[Number, ...]
    numbers: Mapping[str, Any]
    margin: Mapping[str, Any] | None
    contact_rows: tuple[Mapping[str, Any], ...]
    lines: tuple[Line, ...]
    figures: Mapping[str, Figure]
    warnings: tuple[Told, ...]
    seconds: float
    differences: tuple[Difference, ...] = field(default=())
    effects: Table | None = None

    def number(self, key: str) -> Number | None:
        """Number of a key; None where the answer has none."""
        return next((one for one in self.shown if one.key == key), None)
