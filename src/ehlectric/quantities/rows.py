"""Rows of a table of key figures, as data: a terminal prints them, a page can render them."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Any

from ehlectric.quantities.quantity import Bound, Keys, key_of
from ehlectric.quantities.units import unit_for

# SI unit of each unit that is shown, in the notation of pint, and the factor from the SI unit to the shown
# unit.
UNITS: Mapping[str, tuple[str, float]] = MappingProxyType(
    {
        "": ("", 1.0),
        "%": ("", 1e2),
        "N": ("N", 1.0),
        "MN/m": ("N/m", 1e-6),
        "GPa": ("Pa", 1e-9),
        "1/GPa": ("1/Pa", 1e9),
        "m/s": ("m/s", 1.0),
        "rpm": ("rad/s", 30.0 / math.pi),
        "deg": ("rad", 180.0 / math.pi),
        "mPa s": ("Pa*s", 1e3),
        "m": ("m", 1.0),
        "mm": ("m", 1e3),
        "µm": ("m", 1e6),
        "nm": ("m", 1e9),
        "µm²": ("m**2", 1e12),
        "µs": ("s", 1e6),
        "ms": ("s", 1e3),
        "s": ("s", 1.0),
        "Hz": ("Hz", 1.0),
        "GHz": ("Hz", 1e-9),
        "kHz": ("Hz", 1e-3),
        "Ω": ("ohm", 1.0),
        "1/s": ("1/s", 1.0),
        "nC": ("C", 1e9),
        "mA": ("A", 1e3),
        "µW": ("W", 1e6),
        "V": ("V", 1.0),
        "V/µm": ("V/m", 1e-6),
        "1/µm": ("1/m", 1e-6),
        "pF": ("F", 1e12),
        "nF/m": ("F/m", 1e9),
        "nJ": ("J", 1e9),
        "A/mm²": ("A/m**2", 1e-6),
        "kg/m³": ("kg/m**3", 1.0),
        "S/m": ("S/m", 1.0),
        "W/m/K": ("W/m/K", 1.0),
        "MJ/m³/K": ("J/m**3/K", 1e-6),
        "Pa s": ("Pa*s", 1.0),
    }
)


# Number from which one with few digits has an exponent; below it the exponent only hides how large it is.
_LARGE = 1e4


def formatted(value: float, digits: str) -> str:
    """Number as a string in a format, without an exponent where its few digits can be read without one.

    Parameters
    ----------
    value : float
        Number.
    digits : str
        Format, such as ".2g".

    Examples
    --------
    >>> [formatted(value, ".2g") for value in (0.012, 98.6, 213.0, 41234.0)]
    ['0.012', '99', '210', '4.1e+04']
    """
    text = format(value, digits)
    return f"{float(text):.0f}" if "e+" in text and abs(value) < _LARGE else text


def number_text(value: float) -> str:
    """Text: number with three digits, without a power of ten up to a million.

    Examples
    --------
    >>> number_text(29731.0), number_text(0.1234)
    ('29700', '0.123')
    """
    return f"{float(f'{value:.3g}'):.7g}"


@dataclass(frozen=True)
class Row:
    """Row of a table: a name, a value with its unit, and a note. A row with a name alone is a heading.

    Attributes
    ----------
    name : str
        Name of the quantity, which a reader understands without the other rows.
    value : float, str or None
        Number in the SI unit of ``unit``, or a string; None for a row with a name and a note only.
    unit : str
        Unit in which a number is shown, one of ``UNITS``, or the unit of a string.
    note : str
        Note that follows the unit, or the value if there is no unit.
    digits : str
        Format of the shown number.
    alarm : bool
        True if the row says that the numbers must not be used.
    bound : str
        "≤" for a value that is an upper bound, "≥" for a lower bound; it holds for both ends of a range.

    Raises
    ------
    ValueError
        If the unit of a number is not in ``UNITS``.

    Examples
    --------
    >>> row = Row("Hertz pressure", 1.234567e9, "GPa")
    >>> row.shown, row.unit
    ('1.235', 'GPa')
    >>> Row("minimum film thickness", 2e-7, "µm", ", at the outlet").text
    '0.2 µm, at the outlet'
    >>> Row("breakdown voltage", 5.88, "V", bound="≤").text
    '≤ 5.88 V'
    """

    name: str
    value: float | str | None = None
    unit: str = ""
    note: str = ""
    digits: str = field(default=".4g", kw_only=True)
    alarm: bool = field(default=False, kw_only=True)
    bound: Bound = field(default="", kw_only=True)

    def __post_init__(self) -> None:
        if isinstance(self.value, int | float) and self.unit not in UNITS:
            raise ValueError(f"{self.unit!r} is no unit of a row; expected one of {', '.join(UNITS)}")

    @property
    def shown(self) -> str:
        """Value as a string, in the shown unit."""
        if self.value is None or isinstance(self.value, str):
            return self.value or ""
        return formatted(self.value * UNITS[self.unit][1], self.digits)

    @property
    def bounded(self) -> str:
        """Value as a string in the shown unit, after the sign of its bound."""
        return " ".join(filter(None, [self.bound, self.shown]))

    @property
    def text(self) -> str:
        """Bound, value, unit and note as one string."""
        value = " ".join(filter(None, [self.bounded, self.unit]))
        if self.note.startswith((",", ";")):
            return value + self.note
        return " ".join(filter(None, [value, self.note.strip()]))

    @property
    def heading(self) -> bool:
        """True if the row has a name only, which heads the rows that follow."""
        return bool(self.name) and not self.text


def rows_of(
    keys: Keys,
    summary: Mapping[str, Any],
    entries: Iterable[tuple[str, ...]],
    bounds: Mapping[str, Bound] = MappingProxyType({}),
) -> Iterator[Row]:
    """Rows of the numbers of a summary, without the numbers that are None.

    Parameters
    ----------
    keys : mapping of str to Quantity
        Keys of the summary, with the SI unit of each number.
    summary : mapping
        Nested summary, SI units.
    entries : iterable of tuple of str
        Name of the row, dotted key of its number, shown unit, and optionally a note.
    bounds : mapping of str to str, optional
        "≤" or "≥" by the dotted keys of numbers that are bounds only.

    Raises
    ------
    ValueError
        If the shown unit of a number is not a multiple of the SI unit of its key.

    Examples
    --------
    >>> from ehlectric.quantities.quantity import Quantity
    >>> keys = {"film.error": Quantity("error"), "film.minimum": Quantity("minimum", "m")}
    >>> entries = [("error", "film.error", "%"), ("minimum film", "film.minimum", "µm", ", of all")]
    >>> list(rows_of(keys, {"film": {"error": None, "minimum": 1e-7}}, entries))
    [Row(name='minimum film', value=1e-07, unit='µm', note=', of all', digits='.4g', alarm=False, bound='')]
    """
    for name, key, unit, *note in entries:
        value, entry = value_at(summary, key), key_of(keys, key)
        if value is None or entry is None:
            continue
        if UNITS[unit][0] != entry.unit:
            raise ValueError(f"{key} in {entry.unit or 'no unit'} is not shown in {unit or 'no unit'}")
        yield Row(name, value, unit, *note, bound=bounds.get(key, ""))


def value_at(table: Mapping[str, Any], key: str) -> Any:
    """Value at a dotted key of nested tables and lists; None if a table of the path is None or lacks its key.

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


def amount_row(name: str, value: float, unit: str, note: str = "", *, bound: Bound = "") -> Row:
    """Row of a value in a prefixed unit that suits it.

    Examples
    --------
    >>> row = amount_row("charge relaxation time", 2.1e-3, "s", ", of the oil")
    >>> row.shown, row.unit, row.text
    ('2.1', 'ms', '2.1 ms, of the oil')
    """
    factor, prefixed = suited(value, unit)
    return Row(name, f"{factor * value:.4g}", prefixed, note, bound=bound)


def amount(value: float, unit: str) -> str:
    """Value in a prefixed unit that suits it, with four digits.

    Lengths and field strengths below 1 of a unit stay in it, as films do in micrometres.

    Examples
    --------
    >>> amount(7.4e-7, "m"), amount(2.5e6, "V/m"), amount(300.0, "V")
    ('0.74 µm', '2.5 V/µm', '300 V')
    """
    factor, prefixed = suited(value, unit)
    return f"{factor * value:.4g} {prefixed}"


def suited(value: float, unit: str) -> tuple[float, str]:
    """Factor from an SI unit to a prefixed unit that suits a value, and this unit.

    Units that have a prefix already, as kg, or a power of their own, as 1/K, get no other one.

    Examples
    --------
    >>> suited(870.0, "kg/m**3"), suited(2.3e-10, "F")
    ((1.0, 'kg/m³'), (1000000000000.0, 'pF'))
    """
    if not unit or "**" in unit or unit.startswith(("kg", "1/", "K", "deg", "rad")):
        return 1.0, unit.replace("**2", "²").replace("**3", "³").replace("*", " ")
    factor, prefixed = unit_for(abs(value), unit, least=0.1 if unit in ("m", "V/m") else 1.0)
    return round(factor, 12), prefixed.replace("*", " ")
