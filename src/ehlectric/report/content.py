"""Content of a report as data: sections of texts, tables, figures, warnings and a verdict."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal, TypeAlias

from matplotlib.figure import Figure

from ehlectric.errors import Severity
from ehlectric.report.light import Light

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
