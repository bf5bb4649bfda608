"""Number of an answer as a page shows it."""

from __future__ import annotations

from dataclasses import dataclass

from ehlectric.app.answers.told import Told


@dataclass(frozen=True)
class Number:
    """Number that an answer shows large.

    Attributes
    ----------
    key : str
        Dotted key of the quantity.
    label : str
        Label of the quantity.
    text, unit : str
        The number as it is shown, or why there is none, and its unit.
    note : str
        What a reader must know beside it.
    bound : str
        "≤" where the value is an upper bound only, "≥" where it is a lower one.
    known : bool
        Whether there is a value.
    told : tuple of Told
        Warnings that concern it.
    """

    key: str
    label: str
    text: str
    unit: str = ""
    note: str = ""
    bound: str = ""
    known: bool = True
    told: tuple[Told, ...] = ()
