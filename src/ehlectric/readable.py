"""Numbers as people write them: with a few digits, large ones in groups of digits or in millions."""

from __future__ import annotations

import math
from collections.abc import Mapping
from string import Formatter
from typing import Any

# Numbers from which digits are grouped by three, from which numbers are in millions, and from which they have
# a power of ten.
_GROUPED, _MILLION, _LARGE = 1e4, 1e6, 1e9

_RAISED = str.maketrans("0123456789", "⁰¹²³⁴⁵⁶⁷⁸⁹")


def formatted(value: float, digits: str, ceiling: float | None = None) -> str:
    r"""Number as a string in a format, as people write it: large ones with groups of digits, or in millions.

    A number above the ``ceiling`` becomes "above" with this limit. Spaces within a number break no line.

    Examples
    --------
    >>> [formatted(value, ".2g").replace("\xa0", " ") for value in (0.012, 98.6, 213.0, 41234.0, 4.2e7, 4e13)]
    ['0.012', '99', '210', '41 000', '42 million', '4·10¹³']
    >>> formatted(3.2e7, ".3g", 1e6).replace("\xa0", " ")
    'above 1 000 000'
    """
    if ceiling is not None and value > ceiling:
        return f"above {_grouped(f'{ceiling:.0f}')}"
    text = format(value, digits)
    if not math.isfinite(value) or digits.endswith("e"):
        return text
    size, fixed = abs(float(text)), digits.endswith("f")
    if size < _GROUPED:
        return f"{float(text):.0f}" if "e+" in text else text
    if size < _MILLION or fixed:
        return _grouped(f"{float(text):.0f}" if "e+" in text else text)
    if size < _LARGE:
        return f"{formatted(value / _MILLION, digits)}\xa0million"
    mantissa, _, power = text.partition("e+")
    return f"{mantissa}·10{str(int(power)).translate(_RAISED)}" if power else text


def _grouped(text: str) -> str:
    """Number without an exponent, its digits before the point in groups of three."""
    whole, point, decimals = text.partition(".")
    return f"{int(whole):,}".replace(",", "\xa0") + point + decimals


def readable(value: float, digits: int = 3) -> str:
    r"""Number with so many significant digits, as people write it.

    Examples
    --------
    >>> readable(9731.0), readable(0.1234), readable(16000.0, 4).replace("\xa0", " ")
    ('9730', '0.123', '16 000')
    """
    return formatted(value, f".{digits}g")


class _Readable(Formatter):
    """Formats templates, with numbers as people write them."""

    def format_field(self, value: Any, format_spec: str) -> str:
        if format_spec.endswith("g") and isinstance(value, int | float):
            return formatted(value, format_spec)
        return str(super().format_field(value, format_spec))


def filled_in(template: str, values: Mapping[str, Any]) -> str:
    r"""Template whose names are replaced by values; numbers in the format "g" are readable.

    Examples
    --------
    >>> filled_in("{speed:.4g} rpm of {name}", {"speed": 16000.0, "name": "6205"}).replace("\xa0", " ")
    '16 000 rpm of 6205'
    """
    return _Readable().vformat(template, (), values)
