"""Lines of the table that the command prints, as data."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Line:
    """Line of the table that the command prints; a line without text is a heading.

    Attributes
    ----------
    name, text : str
        Name of the quantity; value, unit and note.
    alarm : bool
        Whether the line says that the numbers must not be used.
    """

    name: str
    text: str = ""
    alarm: bool = False
