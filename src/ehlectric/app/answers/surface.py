"""Answers about a rough surface before it is used, as data."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from ehlectric.app.answers.told import Told


@dataclass(frozen=True)
class StepFigure:
    """Figure of a surface after a processing step.

    Attributes
    ----------
    name : str
        Name of the step, such as "form: parabola".
    figure : mapping
        Figure as plotly.js takes it.
    label : str
        Sentence about the figure for a screen reader.
    """

    name: str
    figure: Mapping[str, Any]
    label: str


@dataclass(frozen=True)
class SummitsTable:
    """Spectral moments and summits of a surface, as ``ehlectric surface`` prints them.

    Attributes
    ----------
    title : str
        What the numbers belong to.
    heads : tuple of str
        Heads of the columns, with units.
    rows : tuple of tuple of str
        Row for every sampling interval.
    note : str
        What a reader must know to use the numbers.
    """

    title: str
    heads: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    note: str


@dataclass(frozen=True)
class SurfaceAnswer:
    """Rough surface and its processing steps.

    Attributes
    ----------
    kind : str
        "profile", "map" or "shape".
    described : mapping
        Numbers of the surface in SI units, as ``ehlectric surface --json`` gives them.
    size : str
        Points, spacing and resolution of the surface.
    heads : tuple of str
        Heads of the table of statistics, with units.
    rows : tuple of tuple of str
        Row of this table for every processing step; empty for an exact shape.
    figures : tuple of StepFigure
        Figure after every processing step; a single one of an exact shape.
    warnings : tuple of Told
        Warnings about the file, the steps and the grid.
    lines : mapping of str to int
        Number of rows and of columns of a map from a file; empty for other surfaces.
    summits : SummitsTable or None
        Moments and summits after the last processing step; None for an exact shape.
    """

    kind: str
    described: Mapping[str, Any]
    size: str
    heads: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    figures: tuple[StepFigure, ...]
    warnings: tuple[Told, ...]
    lines: Mapping[str, int]
    summits: SummitsTable | None = None
