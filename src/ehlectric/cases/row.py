"""Rows of a table of key figures, as data: a terminal prints them, a page can render them."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Any

from ehlectric.cases.result_key import Keys, key_of

# SI unit of each unit that is shown, as pint writes it, and the factor from the SI unit to the shown one.
UNITS: Mapping[str, tuple[str, float]] = MappingProxyType(
    {
        "": ("", 1.0),
        "%": ("", 1e2),
        "N": ("N", 1.0),
        "MN/m": ("N/m", 1e-6),
        "GPa": ("Pa", 1e-9),
        "m/s": ("m/s", 1.0),
        "rpm": ("rad/s", 30.0 / math.pi),
        "deg": ("rad", 180.0 / math.pi),
        "mPa s": ("Pa*s", 1e3),
        "mm": ("m", 1e3),
        "µm": ("m", 1e6),
        "nm": ("m", 1e9),
        "µm²": ("m**2", 1e12),
        "ms": ("s", 1e3),
        "s": ("s", 1.0),
        "Hz": ("Hz", 1.0),
        "V": ("V", 1.0),
        "V/µm": ("V/m", 1e-6),
        "1/µm": ("1/m", 1e-6),
        "pF": ("F", 1e12),
        "nF/m": ("F/m", 1e9),
        "nJ": ("J", 1e9),
        "A/mm²": ("A/m**2", 1e-6),
    }
)


@dataclass(frozen=True)
class Row:
    """One row of a table: a name, a value with its unit, and a note.

    Attributes
    ----------
    name : str
        Name of the quantity. Two spaces in front of it say that it belongs to the row above.
    value : float, str or None
        Number in the SI unit of ``unit``, or a text; None where the row has a name and a note only.
    unit : str
        Unit in which a number is shown, one of ``UNITS``, or the unit of a text.
    note : str
        Text behind the unit, printed without a space between them.
    digits : str
        Format of the shown number.
    alarm : bool
        Whether the row says that the numbers must not be used.

    Raises
    ------
    ValueError
        Where ``UNITS`` does not have the unit of a number.

    Examples
    --------
    >>> row = Row("Hertz pressure", 1.234567e9, "GPa")
    >>> row.shown, row.unit
    ('1.235', 'GPa')
    """

    name: str
    value: float | str | None = None
    unit: str = ""
    note: str = ""
    digits: str = field(default=".4g", kw_only=True)
    alarm: bool = field(default=False, kw_only=True)

    def __post_init__(self) -> None:
        if isinstance(self.value, int | float) and self.unit not in UNITS:
            raise ValueError(f"{self.unit!r} is no unit of a row; takes one of {', '.join(UNITS)}")

    @property
    def shown(self) -> str:
        """Value as text, in the shown unit."""
        if self.value is None or isinstance(self.value, str):
            return self.value or ""
        return format(self.value * UNITS[self.unit][1], self.digits)


def rows_of(keys: Keys, summary: Mapping[str, Any], entries: Iterable[tuple[str, ...]]) -> Iterator[Row]:
    """Rows of the numbers of a summary; those that are None are left out.

    Parameters
    ----------
    keys : mapping of str to ResultKey
        Keys of the summary, with the SI unit of each number.
    summary : mapping
        Nested summary, SI units.
    entries : iterable of tuple of str
        Name of the row, dotted key of its number, shown unit, and optionally a note.

    Raises
    ------
    ValueError
        Where the shown unit of a number is not a multiple of the SI unit of its key.

    Examples
    --------
    >>> from ehlectric.cases.result_key import ResultKey
    >>> keys = {"film.error": ResultKey("error"), "film.minimum": ResultKey("minimum", "m")}
    >>> entries = [("error", "film.error", "%"), ("minimum film", "film.minimum", "µm", ", of all")]
    >>> list(rows_of(keys, {"film": {"error": None, "minimum": 1e-7}}, entries))
    [Row(name='minimum film', value=1e-07, unit='µm', note=', of all', digits='.4g', alarm=False)]
    """
    for name, key, unit, *note in entries:
        value, entry = value_at(summary, key), key_of(keys, key)
        if value is None or entry is None:
            continue
        if UNITS[unit][0] != entry.unit:
            raise ValueError(f"{key} in {entry.unit or 'no unit'} is not shown in {unit or 'no unit'}")
        yield Row(name, value, unit, *note)


def value_at(table: Mapping[str, Any], key: str) -> Any:
    """Value of nested tables and lists at a dotted key; None where a table on the way is None or lacks it.

    Examples
    --------
    >>> value_at({"field": {"quantiles": [0.1, 0.5]}}, "field.quantiles.1")
    0.5
    """
    value: Any = table
    for name in key.split("."):
        if isinstance(value, Mapping):
            value = value.get(name)
        elif isinstance(value, list | tuple) and name.isdecimal() and int(name) < len(value):
            value = value[int(name)]
        else:
            return None
    return value
