"""Answers about one contact, as data."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from ehlectric.app.answers.figure import Shown
from ehlectric.app.answers.line import Line
from ehlectric.app.answers.number import Number
from ehlectric.app.answers.told import Told


@dataclass(frozen=True)
class ContactCheck:
    """Answer about a contact before its film is solved, as of ``ehlectric check``.

    Attributes
    ----------
    title, geometry : str
        Title of the case; "line" or "point".
    level, text : str
        Level of the verdict by formula, "grey" where there is none, and the verdict in sentences.
    numbers : tuple of Number
        Main numbers.
    rows : tuple of Line
        Table that the command prints.
    warnings : tuple of Told
        Warnings that concern no single one of the numbers.
    summary : mapping
        Numbers in SI units with the keys of the command.
    quick : bool
        Whether the contact is solved so fast that the page need not be asked to.
    moving : bool
        Whether the roughness moves, so that a run in time answers.
    """

    title: str
    geometry: str
    level: str
    text: str
    numbers: tuple[Number, ...]
    rows: tuple[Line, ...]
    warnings: tuple[Told, ...]
    summary: Mapping[str, Any] = field(repr=False)
    quick: bool = False
    moving: bool = False


@dataclass(frozen=True)
class Reach:
    """Range of the points through which a point contact can be cut, and the first one.

    Attributes
    ----------
    x, y : tuple of float
        Ends of the range, in ``unit``.
    at : tuple of float
        First point, such as that of the minimum film, in ``unit``.
    unit : str
        Unit of the positions, as the figures have it.
    turned : bool
        Whether the maps have y along the page.
    first : str
        Words for what is at ``at``.
    """

    x: tuple[float, float]
    y: tuple[float, float]
    at: tuple[float, float]
    unit: str
    turned: bool = False
    first: str = "the smallest film"


@dataclass(frozen=True)
class ContactView:
    """Solved contact.

    Attributes
    ----------
    title, geometry : str
        Title of the case; "line" or "point".
    converged : bool
        Whether the film converged; if not, no number may be used.
    level, text : str
        Level of the verdict and the verdict in sentences.
    numbers : tuple of Number
        Main numbers; none where the film is not converged.
    rows : tuple of Line
        Table that the command prints.
    warnings : tuple of Told
        Warnings that concern no single one of the numbers.
    figures : tuple of Shown
        Figures of the whole contact.
    cuts : tuple of Shown
        Figures of the cuts through one point of a point contact.
    reach : Reach or None
        Range of these points; None for a line contact.
    spots : tuple of Number
        Numbers of the spots in which the surfaces touch; none where they do not touch.
    """

    title: str
    geometry: str
    converged: bool
    level: str
    text: str
    numbers: tuple[Number, ...]
    rows: tuple[Line, ...]
    warnings: tuple[Told, ...]
    figures: tuple[Shown, ...] = field(repr=False)
    cuts: tuple[Shown, ...] = field(default=(), repr=False)
    reach: Reach | None = None
    spots: tuple[Number, ...] = ()
