"""Content of a report as data: sections, tables, figures, warnings, verdict, and the part of a kind of
result.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from io import BytesIO
from typing import Literal, TypeAlias

from matplotlib.figure import Figure

from ehlectric.figures.figure_names import with_units_kept
from ehlectric.figures.style import style as figure_style
from ehlectric.quantities.result_warnings import ResultWarning, Severity
from ehlectric.quantities.statement import Level
from ehlectric.quantities.verdict import Verdict

# Resolution of pixels [1/inch].
DPI = 200

# Largest image of vectors [bytes]; maps have a path for each of their cells.
_LARGEST = 400_000

# Neither kind of image has a date, so that equal figures are equal files.
_METADATA = {"png": {"Software": None}, "svg": {"Date": None, "Creator": None}}

Tone = Literal["plain", "alarm", "code", "small"]


@dataclass(frozen=True)
class Text:
    """Paragraph of a report."""

    text: str  # plain text without any markup
    # "plain"; "alarm" for what a reader must not miss; "code" for text with its line breaks, as of a file;
    # "small" for what is looked up and not read.
    tone: Tone = "plain"


# Beginning of the addresses of links.
DOI = "https://doi.org/"


@dataclass(frozen=True)
class Link:
    """Text of a cell that leads to a page."""

    text: str  # plain text before the address
    address: str  # address of the page, which begins with ``DOI``


@dataclass(frozen=True)
class Named:
    """Name of an input, with its dotted key of a file, which a page shows under the pointer."""

    text: str
    key: str


Cell: TypeAlias = str | Link | Named


@dataclass(frozen=True)
class Table:
    """Table of a report."""

    caption: str
    heads: tuple[str, ...]  # heads of the columns, with units
    rows: tuple[tuple[Cell, ...], ...]
    numeric: tuple[int, ...] = ()  # numbers of the columns that are aligned to the right
    alarms: tuple[int, ...] = ()  # numbers of the rows that say that numbers must not be used
    shares: tuple[float, ...] = ()  # share of the width of each column; empty where the texts decide


@dataclass(frozen=True)
class Picture:
    """Figure of a report."""

    name: str
    title: str
    caption: str  # what the figure shows, in a sentence
    figure: Figure


@dataclass(frozen=True)
class WarningLine:
    """Warnings of one kind in a result: severity, code, meaning of the code, and each text."""

    severity: Severity
    code: str
    meaning: str
    texts: tuple[str, ...]


@dataclass(frozen=True)
class Warnings:
    """Warnings of a result, the severe ones first."""

    lines: tuple[WarningLine, ...]


@dataclass(frozen=True)
class Numbers:
    """Numbers in large letters: label, value with its unit, and a note of each."""

    numbers: tuple[tuple[str, str, str], ...]
    # Number of columns. A figure that follows stands next to a single column, and below several of them.
    columns: int = 1


@dataclass(frozen=True)
class Light:
    """Verdict of a result, with its traffic light."""

    level: Level
    # Heading, so that the colour is not the only sign; it states if the verdict holds for an ideal film.
    words: str
    text: str  # sentences after the heading
    bound: str = ""  # "upper bound" for a verdict on one, after the heading; empty otherwise

    @classmethod
    def of(cls, verdict: Verdict, reasons: int) -> Light:
        """Light of a verdict, with so many of its reasons.

        Examples
        --------
        >>> Light.of(Verdict("green", "breakdown-excluded", bound="upper"), 0).words
        'No breakdown expected in an ideal film'
        """
        text = with_units_kept(verdict.rest(reasons))
        return cls(verdict.level, verdict.heading, text, verdict.bound_note)


Block: TypeAlias = Text | Table | Picture | Warnings | Light | Numbers


@dataclass(frozen=True)
class Section:
    """Section of a report: its title, and its blocks in their order."""

    title: str
    blocks: tuple[Block, ...]
    single_page: bool = False  # whether it has a page of its own, on which all of it stands


@dataclass(frozen=True)
class Report:
    """Report of a result."""

    title: str
    kind: str  # what the result is, in a few words
    date: str
    sections: tuple[Section, ...]

    def blocks(self) -> Iterator[Block]:
        """All blocks of all sections, in their order."""
        for section in self.sections:
            yield from section.blocks


@dataclass(frozen=True, kw_only=True)
class Part:
    """Content of a report that depends on the kind of the result."""

    kind: str  # what the result is, in a few words
    command: str  # command that solves the input file
    question: str = ""  # name of its question, by default the command
    machine: str = ""  # machine in a sentence; empty for contacts and sweeps, of which the lead says it
    lead: str  # main numbers in a sentence
    failure: str  # what is not solved; empty where all is
    verdict: Verdict | None  # answer of the result; None where it has none
    warnings: tuple[ResultWarning, ...]
    first: tuple[Block, ...] = ()  # numbers and tables of the first page
    numbers: tuple[Block, ...]
    figures: tuple[str, ...]  # names of the figures, the first of which decides
    figure_note: str = ""  # sentence below the figures
    further: tuple[Section, ...] = ()
    rests: tuple[Block, ...] = ()  # what the result rests on, next to the inputs to measure or to check
    details: dict[str, str]  # what is known of the computation, by name
    toml: str
    varied: tuple[str, ...] = ()  # dotted keys that a sweep varies


def image_of(picture: Picture, kind: Literal["png", "svg"]) -> bytes:
    """Content of an image file of a figure."""
    content = BytesIO()
    with figure_style():
        metadata = {**_METADATA[kind], "Title": picture.title}
        picture.figure.savefig(content, format=kind, dpi=DPI, metadata=metadata)
    return content.getvalue()


def best_image(picture: Picture) -> tuple[str, bytes]:
    """MIME type and content of a figure for a page: vectors, or pixels where vectors are too large."""
    vectors = image_of(picture, "svg")
    if len(vectors) <= _LARGEST:
        return "image/svg+xml", vectors
    return "image/png", image_of(picture, "png")
