"""Numbers that pages show large, in units that people read."""

from __future__ import annotations

from ehlectric.app.answers.contact import Number
from ehlectric.quantities.units import unit_for


def number_of(
    key: str, label: str, value: float, unit: str, note: str = "", *, least: float = 0.1, digits: int = 4
) -> Number:
    """Number of a quantity in a unit with a prefix, but for voltages, which stay in volts.

    Parameters
    ----------
    key : str
        Name for tests.
    label : str
        Name of the quantity.
    value : float
        Value in SI units.
    unit : str
        SI unit, as it is printed.
    note : str
        What a reader must know beside it.
    least : float
        Smallest number before a prefix, from which the prefix follows.
    digits : int
        Number of significant digits.

    Examples
    --------
    >>> number_of("film", "Minimum film", 2.345678e-7, "m").text
    '0.2346'
    """
    factor, shown = (1.0, unit) if unit == "V" else unit_for(abs(value), unit, least=least)
    return Number(key, label, short_text(factor * value, digits), shown, note)


def short_text(value: float, digits: int) -> str:
    """Number with a few significant digits, without an exponent where it can be read without one.

    Examples
    --------
    >>> short_text(2213.7, 2), short_text(0.0536, 2), short_text(1.23456e-7, 3)
    ('2200', '0.054', '1.23e-07')
    """
    return f"{float(f'{value:.{digits}g}'):.{max(digits, 6)}g}"
