"""Metadata of the fields of dataclasses: dimensions, unit, allowed values and meaning of a quantity.

``stored`` describes an array, ``number`` a number or a text. Whoever writes or reads a file calls
``arrays_of`` and ``rules_of_numbers``; a class that describes its fields knows no file.
"""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Any

# Keys of the metadata of a field.
_ARRAY, _NUMBER = "stored", "stored number"


@dataclass(frozen=True)
class Stored:
    """Variable of a file that holds the values of a field."""

    dims: tuple[str, ...]  # its dimensions; a ``Part`` may replace a name by several
    unit: str | None = None  # its unit; None where the file states none
    # What its values must be, a key of ``VALUES``. Values of "0 or 1" are read as booleans.
    rule: str = "finite"
    text: str = ""
    name: str = ""  # its name in the file, by default the field's name with the prefix of the part
    needed: bool = True  # whether a file must have it
    dtype: str | None = None  # type of its values in the file, by default the type of the field
    unknown: bool = False  # whether None instead of a number is stored as NaN
    # Where the lengths of the arrays of several objects differ, they follow each other in one variable; this
    # variable has the lengths.
    count: str = ""

    @property
    def attributes(self) -> dict[str, str]:
        """Attributes of the variable: long name and unit."""
        named = {"long_name": self.text} if self.text else {}
        return named if self.unit is None else {**named, "units": self.unit}


def stored(
    dims: str = "", unit: str | None = None, rule: str = "finite", text: str = "", **options: Any
) -> dict[str, Stored]:
    """Metadata of a field whose values are a variable over the dimensions in a text; see ``Stored``."""
    return {_ARRAY: Stored(tuple(dims.split()), unit, rule, text, **options)}


def number(rule: str | tuple[str, ...] = "finite or null") -> dict[str, Any]:
    """Metadata of a field that is a number or a text in an attribute.

    The rule is a key of ``VALUES``, perhaps with " or null", or "text", "truth", or the texts that are
    possible.
    """
    return {_NUMBER: rule}


def arrays_of(kind: type[Any]) -> dict[str, Stored]:
    """Return the metadata of the arrays of a dataclass by the names of its fields.

    Examples
    --------
    >>> from dataclasses import field
    >>> @dataclass(frozen=True)
    ... class Film:
    ...     thickness: float = field(metadata=stored("x", "m", "positive"))
    ...     load: float = field(metadata=number("positive"))
    >>> arrays_of(Film)["thickness"].unit, rules_of_numbers(Film)
    ('m', {'load': 'positive'})
    """
    return {each.name: each.metadata[_ARRAY] for each in fields(kind) if _ARRAY in each.metadata}


def rules_of_numbers(kind: type[Any]) -> dict[str, str | tuple[str, ...]]:
    """Return the rules of the numbers and texts of a dataclass by the names of its fields."""
    return {each.name: each.metadata[_NUMBER] for each in fields(kind) if _NUMBER in each.metadata}
