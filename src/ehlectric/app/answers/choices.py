"""Choices of the forms: bearings, oils, coatings and solids of the library, with what tells them apart."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Choice:
    """Entry of a list to choose from.

    Attributes
    ----------
    name : str
        Name for a key such as ``bearing.base``.
    label : str
        What the list shows.
    group : str
        Kind, under which the list shows it.
    """

    name: str
    label: str
    group: str = ""
