"""Numbers as people write them: with a few digits, large ones in groups of digits or in millions."""

from __future__ import annotations

import math
import os.path
from collections.abc import Iterable, Mapping
from pathlib import Path
from string import Formatter
from typing import Any

# Numbers from which digits are grouped by three, from which numbers are in millions, and from which they have
# a power of ten.
_GROUPED, _MILLION, _LARGE = 1e4, 1e6, 1e9

_RAISED = str.maketrans("0123456789", "⁰¹²³⁴⁵⁶⁷⁸⁹")


def file_text(path: object) -> str:
    """Name of a file without the folders of a machine, relative to the working folder if this contains it.

    Examples
    --------
    >>> file_text("/home/ann/rig/scope.csv"), file_text("measurements/scope.csv")
    ('scope.csv', 'measurements/scope.csv')
    """
    given = Path(str(path))
    if not given.is_absolute():
        return str(path)
    try:
        return given.relative_to(Path.cwd()).as_posix()
    except (OSError, ValueError):
        return given.name


def file_texts(paths: Iterable[Any]) -> list[Any]:
    """Names of files as by ``file_text``; with folders below a common one if names are equal.

    Examples
    --------
    >>> file_texts(["/rig/a.csv", "/rig/b.csv", None]), file_texts(["/rig/1/a.csv", "/rig/2/a.csv"])
    (['a.csv', 'b.csv', None], ['1/a.csv', '2/a.csv'])
    """
    listed = list(paths)
    distinct = sorted({path for path in listed if isinstance(path, str)})
    names = {path: file_text(path) for path in distinct}
    if len(set(names.values())) < len(distinct) and all(Path(path).is_absolute() for path in distinct):
        common = os.path.commonpath(distinct)
        names = {path: Path(path).relative_to(common).as_posix() for path in distinct}
    return [names.get(path, path) if isinstance(path, str) else path for path in listed]


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


def at_an_end(probability: float, error: float) -> bool:
    """Whether a probability differs from 0 or from 1 by less than its sampling error."""
    return min(probability, 1.0 - probability) < error


def chance_text(probability: float, error: float) -> str:
    """Probability with its sampling error as text.

    Examples
    --------
    >>> chance_text(0.163, 0.032), chance_text(0.0, 0.00372), chance_text(1.0, 0.00372)
    ('16 % (sampling error 3.2 %)', 'below 0.75 %', 'above 99.25 %')
    >>> chance_text(0.997, 0.002)
    '99.7 % (sampling error 0.2 %)'
    """
    if not at_an_end(probability, error):
        # A probability below 1 is not rounded to 100 %.
        digits = 2 if probability < 0.99 else 2 - math.floor(math.log10(1.0 - probability))
        return f"{readable(100.0 * probability, digits)} % (sampling error {readable(100.0 * error, 2)} %)"
    # Wilson's interval of a share of 0 is twice as wide as its half. Two digits, rounded up.
    most = 100.0 * (min(probability, 1.0 - probability) + 2.0 * error)
    step = 10.0 ** (math.floor(math.log10(most)) - 1)
    most = step * math.ceil(most / step)
    return f"below {readable(most, 2)} %" if probability < error else f"above {readable(100.0 - most, 4)} %"


# Difference of the bounds of a probability below which they are one number.
SAME_NUMBER = 1e-9


def mean_text(probability: float, low: float, high: float) -> str:
    """Mean probability as text, or its bounds if points without a result leave it open.

    Examples
    --------
    >>> mean_text(0.694, 0.694, 0.694), mean_text(0.5, 0.165, 0.5664)
    ('69 %', 'between 16 and 57 %')
    """
    return f"{readable(100.0 * probability, 2)} %" if high - low < SAME_NUMBER else bounds_text(low, high)


def bounds_text(low: float, high: float) -> str:
    """Probability between bounds as text.

    Examples
    --------
    >>> bounds_text(0.165, 0.5664), bounds_text(0.5661, 0.5664)
    ('between 16 and 57 %', '57 %')
    """
    first, last = (readable(100.0 * end, 2) for end in (low, high))
    return f"{first} %" if first == last else f"between {first} and {last} %"


def ratio_text(ratio: Any) -> str:
    """Ratio as text with two digits behind the point; more where it would be rounded to 1.

    Examples
    --------
    >>> ratio_text(1.4432), ratio_text(0.9981), ratio_text(0.0123), ratio_text(2345.6)
    ('1.44', '0.9981', '0.012', '2300')
    """
    if not 0.1 <= ratio < 100.0:
        return readable(ratio, 2)
    text = f"{ratio:.2f}"
    return readable(ratio, 4) if text == "1.00" else text


def capital(text: str) -> str:
    """Return a text with a capital letter at its beginning.

    Examples
    --------
    >>> capital("first breakdown"), capital("")
    ('First breakdown', '')
    """
    return f"{text[:1].upper()}{text[1:]}"
