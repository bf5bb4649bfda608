"""Answers about a contact with moving roughness, as data."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from ehlectric.app.answers.told import Told


@dataclass(frozen=True)
class MotionAnswer:
    """Movie of a contact with moving roughness.

    Attributes
    ----------
    title : str
        Title of the case.
    complete : bool
        Whether all time steps are solved.
    failure : str
        Reason why the run ended early; empty for a complete run and for one that was stopped.
    of : int
        Number of recorded instants of the file; the movie has fewer where they are many.
    movie : mapping
        Figure as plotly.js takes it, with a frame for every instant of the movie.
    history : mapping
        Figure of the minimum film, the maximum field and the breakdown voltage over time. Its first shape is
        the line of the present time.
    times : tuple of float
        Times of the instants, in the unit of the history.
    texts : tuple of str
        Sentence with time, minimum film, maximum field and breakdown voltage for every instant.
    at_least_film, at_largest_field : int
        Instants of the movie with the thinnest film and with the largest field.
    rows : tuple of tuple of str
        Rows of the key figures: name, value and unit; a heading has no value.
    warnings : tuple of Told
        Warnings of the run.
    folder : str
        Folder of its files.
    """

    title: str
    complete: bool
    failure: str
    of: int
    movie: Mapping[str, Any]
    history: Mapping[str, Any]
    times: tuple[float, ...]
    texts: tuple[str, ...]
    at_least_film: int
    at_largest_field: int
    rows: tuple[tuple[str, str], ...]
    warnings: tuple[Told, ...]
    folder: str
