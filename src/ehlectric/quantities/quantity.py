"""A quantity of the book: what every output says about one result or input.

The modules next to this one list the quantities of each kind of file. Tables, pages, reports, figures, heads
of columns and the documentation look them up by key, and have no labels, units or digits of their own.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cache
from importlib import resources
from types import MappingProxyType
from typing import Any, Literal, TypeAlias

import tomli

from ehlectric.errors import printable

# Sign of a value that is a bound only; empty for any other value.
Bound: TypeAlias = Literal["", "≤", "≥"]

# Words for the signs of bounds.
BOUNDS: Mapping[str, str] = MappingProxyType({"≤": "upper bound", "≥": "lower bound"})


@dataclass(frozen=True)
class Quantity:
    """Label, symbol, units, digits and meaning of one quantity."""

    meaning: str
    # SI unit as pint writes it, such as "V/m"; empty for a dimensionless number, a text or a choice.
    unit: str = ""
    label: str = ""  # label, such as "minimum film thickness"; if it is empty, outputs show the dotted key
    symbol: str = ""  # symbol in labels, in LaTeX; empty if there is none
    # Unit in which the value is shown, such as "nm"; if it is empty, the usual one of its SI unit, or if
    # there is none, or for "prefixed", the SI unit with the prefix that suits the value.
    shown: str = field(default="", kw_only=True)
    digits: str = field(default=".4g", kw_only=True)  # format of the shown number
    # Shown number above which texts only state that the value is higher; None without such a number.
    ceiling: float | None = field(default=None, kw_only=True)
    # What an ideal film makes of the value: "≤" for an upper bound, "≥" for a lower one. ``result_bounds``
    # says whether it holds for a result.
    bound: Bound = field(default="", kw_only=True)
    # Short label at the head of a column; if it is empty, the label.
    head: str = field(default="", kw_only=True)
    # Note that follows every value and its unit, such as ", of each surface".
    note: str = field(default="", kw_only=True)
    # Text instead of a value that is null in a summary; if it is empty, such a value is not shown.
    null: str = field(default="", kw_only=True)
    # Key of the same table that contains the dotted key of an input, in whose unit the value is.
    unit_of: str = field(default="", kw_only=True)
    # Key of the same table that replaces this former key; empty for a key in use.
    successor: str = field(default="", kw_only=True)

    @property
    def absolute(self) -> bool:
        """Whether the value is a temperature on a scale with a zero, and no difference of temperatures."""
        return self.unit == "K" and self.shown in ("degC", "°C")

    def with_sign(self, text: str) -> str:
        """Text of a value after the sign of its bound.

        Examples
        --------
        >>> Quantity("maximum field", "V/m", bound="≥").with_sign("2 V/µm")
        '≥ 2 V/µm'
        """
        return " ".join(filter(None, [self.bound, text]))


@dataclass(frozen=True, kw_only=True)
class Bounds:
    """Bounds of an input in its SI unit, and what a message says of them."""

    # above and below: bounds that are not allowed themselves; least and most: smallest and largest value.
    above: float = -math.inf
    below: float = math.inf
    least: float = -math.inf
    most: float = math.inf
    reason: str = ""  # reason for the bounds, or a description of the quantity, for messages
    fraction: bool = False  # whether the value may be a string in percent
    # Whether the value is a difference of temperatures, which has no zero of a scale.
    difference: bool = False
    # Whether the value may be infinite, as the radius of a plane; the sign of infinity does not count.
    infinite: bool = False
    # Smallest and largest value that is typical in machines; None if unknown. Values beyond are allowed.
    typical: tuple[float, float] | None = None

    def allow(self, value: float) -> bool:
        """Whether a value [SI unit] lies within the bounds.

        Examples
        --------
        >>> Bounds(above=0.0, most=1.0).allow(0.0), Bounds(above=0.0, most=1.0).allow(1.0)
        (False, True)
        """
        if math.isinf(value):
            return self.infinite
        return self.above < value < self.below and self.least <= value <= self.most


# Keys of a summary, or of one of its tables. An item of a list has the key of the list, if it has none of its
# own; ``*`` stands for any single name.
Keys = Mapping[str, Quantity]


@cache
def data_file(package: str, name: str) -> dict[str, Any]:
    """Contents of a data file in TOML that lies in a package; it is read once, and no caller changes it.

    Examples
    --------
    >>> sorted(data_file("ehlectric.quantities", "sheets.toml")["columns"])
    ['films', 'loads', 'page']
    """
    return tomli.loads(resources.files(package).joinpath(name).read_text(encoding="utf-8"))


def unbroken(text: str) -> str:
    """Printable text in which the sign of a bound stays on the line of its number."""
    text = printable(text)
    for sign in BOUNDS:
        text = text.replace(f"{sign} ", f"{sign}\xa0")
    return text


def under(table: str, keys: Keys) -> dict[str, Quantity]:
    """Convert the keys of a table to dotted keys of the summary that contains the table. Returns the same
    keys, each preceded by ``table`` and a dot.

    Examples
    --------
    >>> list(under("film", {"residual": Quantity("largest residual")}))
    ['film.residual']
    """
    return {f"{table}.{name}": key for name, key in keys.items()}


def key_of(keys: Keys, dotted: str) -> Quantity | None:
    """Look up a dotted key of a summary. Returns meaning, unit, name and symbol of the key; None if the key
    is unknown.

    Examples
    --------
    >>> keys = {"contacts.load": Quantity("load", "N"), "sources.*": Quantity("source of a number")}
    >>> key_of(keys, "contacts.0.load").unit
    'N'
    >>> key_of(keys, "sources.zone_size").meaning
    'source of a number'
    """
    parts = [part for part in dotted.split(".") if not part.isdigit()]
    entry = keys.get(dotted) or keys.get(".".join(parts))
    for k in range(1, len(parts)):
        entry = entry or keys.get(".".join([*parts[:k], "*", *parts[k + 1 :]]))
    return entry
