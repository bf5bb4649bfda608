"""Lines of a netlist: comments that nothing breaks out of, numbers, and parameters with their units."""

from __future__ import annotations

import re
import textwrap
from collections.abc import Iterator
from dataclasses import dataclass

from ehlectric.errors import printable

# Beginning of the first line of every file that is written here, by which it is recognised.
SIGNATURE = "* ehlectric "

# Width of a comment [characters].
_WIDTH = 100

# Letters that texts of ehlectric have, in ASCII: not every simulator reads UTF-8.
_LETTERS = str.maketrans(
    {"µ": "u", "Ω": "Ohm", "°": "deg ", "≤": "<=", "≥": ">=", "×": "x", "–": "-", "²": "^2", "³": "^3"}
)


def ascii_of(text: str) -> str:
    r"""Text on one line in printable ASCII; other letters are escaped.

    Examples
    --------
    >>> print(ascii_of("film of 0.1 µm\nR1 1 0 5"))
    film of 0.1 um\nR1 1 0 5
    """
    return printable(text).translate(_LETTERS).encode("ascii", "backslashreplace").decode("ascii")


def comment(text: str) -> Iterator[str]:
    """Lines of a comment with any text of a user, wrapped.

    Every line begins with an asterisk and a space: ngspice takes ``*#`` for a command.

    Examples
    --------
    >>> list(comment("a title"))
    ['* a title']
    """
    for line in textwrap.wrap(ascii_of(text), _WIDTH) or [""]:
        yield f"* {line}".rstrip()


def number(value: float) -> str:
    """Number with nine digits; it has no suffix, since "M" is a thousandth in SPICE.

    Examples
    --------
    >>> number(1.2e-10), number(3000.0)
    ('1.2e-10', '3000')
    """
    return f"{value:.9g}"


def name_of(text: str) -> str:
    """Name of a subcircuit or a file: lower-case letters, digits and underscores.

    Examples
    --------
    >>> name_of("NU-205")
    'nu_205'
    """
    return re.sub(r"[^a-z0-9]+", "_", ascii_of(text).lower()).strip("_")


@dataclass(frozen=True)
class Parameter:
    """Parameter of a netlist.

    Attributes
    ----------
    name : str
        Name in the netlist.
    value : float
        Value in ``unit``.
    unit : str
        Unit, in ASCII.
    meaning : str
        Words for the quantity.
    """

    name: str
    value: float
    unit: str
    meaning: str

    @property
    def line(self) -> str:
        """Assignment with the unit and the meaning as a comment.

        Examples
        --------
        >>> Parameter("C_films", 1.2e-10, "F", "films").line
        'C_films=1.2e-10 ; F, films'
        """
        return f"{self.name}={number(self.value)} ; {self.unit}, {ascii_of(self.meaning)}"
