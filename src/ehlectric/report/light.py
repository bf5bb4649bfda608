"""Traffic light of a verdict, which is the same in a report and on a page of the app."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import TYPE_CHECKING

from ehlectric.errors import printable

if TYPE_CHECKING:
    from ehlectric.discharge.breakdown_rule import Level

# What the levels mean, for a verdict whose first words are no such name.
_WORDS = {
    "green": "No breakdown expected",
    "yellow": "Breakdown possible",
    "red": "Breakdown expected",
    "grey": "No verdict",
}

# Ends of a heading for a verdict on an upper bound: the computed film is an ideal one, and a real film may be
# thinner.
_ENDS = {
    "green": " in an ideal film",
    "yellow": " even in an ideal film",
    "red": " even in an ideal film",
    "grey": "; the breakdown voltage is an upper bound",
}

# Beginning of the sentence of a verdict that names its bound.
_BOUND = "Upper bound"

# End of the first words: of a clause or a sentence.
_FIRST = re.compile(r"[:.,;] ")

# Beginning of the verdict of a sweep with breakdown at points of it.
_SOME = re.compile(r"Breakdown is (expected|likely) at \d+ of ")

# Longest first words that are a heading [characters].
_LONGEST = 30


@dataclass(frozen=True)
class Light:
    """Verdict of a result, with its traffic light."""

    level: Level
    # Heading, so that the colour is not the only sign; it says where the verdict is that of an ideal film.
    words: str
    text: str
    bound: str = ""  # "upper bound" for a verdict on one, which stands beside the heading; empty otherwise

    @property
    def rest(self) -> str:
        """Sentences without the first words, where the heading has these."""
        first, _, rest = self.text.partition(": ")
        return rest[:1].upper() + rest[1:] if rest and self.words.startswith(first) else self.text


def light_of(level: Level, text: str) -> Light:
    """Traffic light of a verdict.

    Examples
    --------
    >>> text = "No breakdown expected: margin 1.44. Upper bound: isothermal film."
    >>> light = light_of("green", text)
    >>> light.level, light.words, light.bound
    ('green', 'No breakdown expected in an ideal film', 'upper bound')
    >>> light.rest
    'Margin 1.44. Upper bound: isothermal film.'
    """
    text = printable(text)
    first = _FIRST.split(text, maxsplit=1)[0].rstrip(".")
    named = len(first) <= _LONGEST and not any(letter.isdigit() for letter in first)
    words = first if named and first else _WORDS[level]
    if level == "yellow" and (some := _SOME.match(text)):
        words = f"Breakdown {some[1]} at some points"
    bound = text.startswith(_BOUND) or f". {_BOUND}" in text
    return Light(level, words + _ENDS[level] if bound else words, text, "upper bound" if bound else "")
