"""Content of a report as data: sections, tables, figures, warnings, verdict, and the part of a kind of
result.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from textwrap import shorten
from typing import Any, Literal, TypeAlias

from matplotlib.figure import Figure

from ehlectric.bearing.result import BearingResult
from ehlectric.discharge.film_verdict import Verdict
from ehlectric.errors import ResultWarning, Severity, printable
from ehlectric.report.light import Light
from ehlectric.report.limits import Limit, Reference

Tone = Literal["plain", "alarm", "code"]


@dataclass(frozen=True)
class Text:
    """Paragraph of a report.

    Attributes
    ----------
    text : str
        Plain text without any markup.
    tone : str
        "plain"; "alarm" for what a reader must not miss; "code" for text with its line breaks, as of a file.
    """

    text: str
    tone: Tone = "plain"


@dataclass(frozen=True)
class Link:
    """Text of a cell that leads to a page.

    Attributes
    ----------
    text : str
        Plain text before the address.
    address : str
        Address of the page, which begins with "https://doi.org/".
    """

    text: str
    address: str


Cell: TypeAlias = str | Link


@dataclass(frozen=True)
class Table:
    """Table of a report.

    Attributes
    ----------
    caption : str
        Title of the table.
    heads : tuple of str
        Heads of the columns, with units.
    rows : tuple of tuple
        Cells of each row: plain texts, or links.
    numeric : tuple of int
        Numbers of the columns that are aligned to the right.
    alarms : tuple of int
        Numbers of the rows that say that numbers must not be used.
    shares : tuple of float
        Share of the width that each column takes; empty where the texts decide.
    """

    caption: str
    heads: tuple[str, ...]
    rows: tuple[tuple[Cell, ...], ...]
    numeric: tuple[int, ...] = ()
    alarms: tuple[int, ...] = ()
    shares: tuple[float, ...] = ()


@dataclass(frozen=True)
class Picture:
    """Figure of a report.

    Attributes
    ----------
    name : str
        Name of the figure, as of its file.
    title : str
        Finding of the figure, which is its title.
    caption : str
        What the figure shows, in a sentence.
    figure : Figure
        The figure of matplotlib.
    """

    name: str
    title: str
    caption: str
    figure: Figure


@dataclass(frozen=True)
class WarningLine:
    """Warnings of a result of one kind: severity, code, what the code means, and the text of each of them."""

    severity: Severity
    code: str
    meaning: str
    texts: tuple[str, ...]


@dataclass(frozen=True)
class Warnings:
    """Warnings of a result, the severe ones first."""

    lines: tuple[WarningLine, ...]


Block: TypeAlias = Text | Table | Picture | Warnings | Light


@dataclass(frozen=True)
class Section:
    """Section of a report: its title, and its blocks in their order."""

    title: str
    blocks: tuple[Block, ...]


@dataclass(frozen=True)
class Report:
    """Report of a result.

    Attributes
    ----------
    title : str
        Title of the case, or what the result is.
    kind : str
        What the result is, in a few words.
    date : str
        Date of the report, ISO 8601.
    sections : tuple of Section
        Sections in their order.
    """

    title: str
    kind: str
    date: str
    sections: tuple[Section, ...]

    def blocks(self) -> Iterator[Block]:
        """All blocks of all sections, in their order."""
        for section in self.sections:
            yield from section.blocks


UNSOLVED = "NOT CONVERGED: this result is no solution. Do not use its numbers and figures."
NO_VERDICT = "This result has no verdict: it has no breakdown voltage, or no voltage to compare it with."


@dataclass(frozen=True, kw_only=True)
class Part:
    """Content of a report that depends on the kind of the result.

    Attributes
    ----------
    kind : str
        What the result is, in a few words.
    command : str
        Command that solves the input file.
    lead : str
        Main numbers in a sentence.
    failure : str
        What is not solved; empty where all is.
    verdict : Verdict or None
        Answer of the result; None where it has none.
    no_verdict : str
        Why it has none.
    warnings : tuple of ResultWarning
        Warnings of the result.
    before : tuple of Section
        Sections before the key numbers.
    numbers : tuple
        Tables of key numbers.
    pictures : tuple
        Figures.
    further : tuple of Section
        Sections after the figures.
    limits : tuple of Limit
        What the models leave out.
    references : tuple of Reference
        Publications behind the equations.
    details : dict
        What is known of the computation, by name.
    toml : str
        Input file.
    varied : tuple of str
        Dotted keys that a sweep varies.
    """

    kind: str
    command: str
    lead: str
    failure: str
    verdict: Verdict | None
    no_verdict: str = NO_VERDICT
    warnings: tuple[ResultWarning, ...]
    before: tuple[Section, ...] = ()
    numbers: tuple[Block, ...]
    pictures: tuple[Block, ...]
    further: tuple[Section, ...] = ()
    limits: tuple[Limit, ...]
    references: tuple[Reference, ...]
    details: dict[str, str]
    toml: str
    varied: tuple[str, ...] = ()


def details_of(summary: Mapping[str, Any], date: str) -> dict[str, str]:
    """Version, date and state of a computation, by name.

    Parameters
    ----------
    summary : mapping
        Summary of a result.
    date : str
        Date of the result; empty where it is not known.
    """
    return {
        "result computed by": f"ehlectric {summary['version']}",
        "date of the result": date,
        "converged": "yes" if summary["converged"] else "no",
        "computing time": _seconds(summary.get("seconds")),
    }


def _seconds(seconds: float | Mapping[str, float] | None) -> str:
    """Time as text; that of a contact is the sum of its parts."""
    if seconds is None:
        return ""
    total = sum(seconds.values()) if isinstance(seconds, Mapping) else seconds
    return f"{total:.3g} s"


def lead_of(result: Any) -> str:
    """Main numbers of a result: its representation without the name of its class, title and verdict.

    Parameters
    ----------
    result : object
        Result of a contact, of moving roughness, of a bearing, or of a sweep.
    """
    line = repr(result)[1:-1].partition(" ")[2]
    title = shorten(getattr(result, "title", "") or result.case.title, 60)
    line = re.sub(r", verdict \w+$", "", line.removeprefix(f"{title!r}: "))
    if isinstance(result, BearingResult) and result.case.bearing.base:
        # The name of a bearing keeps its letters.
        line = f"Bearing {line}"
    return printable(f"{line[:1].upper()}{line[1:]}.").replace("≤ ", "≤\xa0").replace("≥ ", "≥\xa0")
