"""Verdict on a film: whether breakdown is expected, in sentences and as a colour."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

# "green": no breakdown expected; "yellow": breakdown possible within what is uncertain; "red": breakdown
# expected; "grey": nothing to compare the breakdown voltage with.
Level = Literal["green", "yellow", "red", "grey"]


@dataclass(frozen=True)
class Verdict:
    """Answer to the question whether a film breaks down.

    Attributes
    ----------
    level : str
        "green": no breakdown expected; "yellow": breakdown is possible within what is uncertain; "red":
        breakdown expected; "grey": there is no voltage or no strength to judge by.
    text : str
        The answer in whole sentences, with the numbers that decide and the assumptions behind them.
    margin : float or None
        Breakdown voltage / applied voltage, dimensionless; None where there is none.

    Examples
    --------
    >>> Verdict("green", "No breakdown expected: margin 1.44.", 1.44).level
    'green'
    """

    level: Level
    text: str
    margin: float | None = None

    def __str__(self) -> str:
        return self.text
