"""Numbers and units in case files: conversion of texts to SI values, and checks of bounds."""

from __future__ import annotations

import math
import numbers
import re
from dataclasses import dataclass
from functools import cache
from typing import TYPE_CHECKING, Any

from pydantic import GetCoreSchemaHandler
from pydantic_core import CoreSchema, core_schema

from ehlectric.errors import InputError, shown

if TYPE_CHECKING:
    import pint


_PREFIXES = {1e9: "G", 1e6: "M", 1e3: "k", 1.0: "", 1e-3: "m", 1e-6: "µ", 1e-9: "n", 1e-12: "p"}

# Products and quotients of named units with one-digit exponents. No quantity here needs other units, and pint
# would compute for ever on nested exponents.
_NAME = r"[A-Za-zµμΩ°]+(?:(?:\*\*|\^)?[-+]?[1-9]|²|³)?"
_UNIT = re.compile(rf"(?:1?\s*/\s*)?{_NAME}(?:(?:\s*[*/·]\s*|\s+){_NAME})*")
_EXPONENT = re.compile(r"(?<=[A-Za-zµμΩ°])(?:\*\*|\^)?([-+]?[1-9])")
_ANGLE = re.compile("rad|rpm|rev|turn|deg")
_NUMBER_AND_UNIT = re.compile(r"\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*(.*?)\s*")

# Frequent mistakes, by the SI unit of the quantity: unit of another quantity that users write, and advice.
_HINTS = {
    "Pa*s": ("m**2/s", "multiply a kinematic viscosity by the density"),
    "m/s": ("1/s", "multiply a rotational speed, in rad/s, by the radius"),
    "N/m": ("N", "divide a load by the length of the line"),
}

# Units of an absolute temperature, and the zero point of each unit [K].
_ZEROS = {"K": 0.0, "degC": 273.15, "°C": 273.15}


def unit_for(largest: float, unit: str, *, least: float = 0.1) -> tuple[float, str]:
    """Factor from ``unit`` to a prefixed unit in which ``largest`` is at least ``least``, and this unit."""
    size = next((p for p in _PREFIXES if least * p <= largest), 1e-12)
    prefixed = _PREFIXES[size] + unit
    # Dielectric strengths are usually given in V/µm.
    return 1.0 / size, "V/µm" if prefixed == "MV/m" else prefixed


@cache
def _registry() -> pint.UnitRegistry[float]:
    import pint

    return pint.UnitRegistry()


def to_si(text: str, unit: str) -> float:
    """Convert a text such as "1.57 MN/m" to a value in an SI unit.

    Parameters
    ----------
    text : str
        Number and unit.
    unit : str
        SI unit of the quantity, as pint writes it.

    Returns
    -------
    float
        Value in ``unit``.

    Raises
    ------
    ValueError
        If the text is not a number with a unit of the right dimension.

    Examples
    --------
    >>> to_si("22 1/GPa", "1/Pa")
    2.2e-08
    """
    match = _NUMBER_AND_UNIT.fullmatch(text)
    if match is None:
        raise ValueError("it is not a number with a unit")
    number, written = match.groups()
    if not written:
        raise ValueError("it has no unit")
    if unit == "K":
        return _absolute(float(number), written)
    # Fifteen digits remove the rounding error of factors such as 1e-3, which are not binary numbers.
    return float(f"{float(number) * _factor(written, unit):.15g}")


def _absolute(number: float, written: str) -> float:
    """Convert an absolute temperature to kelvin: 70 degC is 343.15 K, not a difference of 70 K."""
    if written not in _ZEROS:
        raise ValueError(f"{shown(written)} is not a unit of an absolute temperature: {', '.join(_ZEROS)}")
    return float(f"{number + _ZEROS[written]:.15g}")


def _factor(written: str, unit: str) -> float:
    """Factor that converts a value from the unit ``written`` to ``unit``."""
    import pint

    if _UNIT.fullmatch(written) is None:
        raise ValueError(f"{shown(written)} is not a unit")
    if unit == "rad/s" and _ANGLE.search(written) is None:
        # Angles are dimensionless in pint, which would convert 50 Hz to 50 rad/s.
        raise ValueError(f"{written} is a frequency and leaves open what turns, takes rpm, rad/s or deg/s")
    plain = _EXPONENT.sub(r"**\1", written).removeprefix("1").lstrip()
    expression = f"1{plain}" if plain.startswith("/") else plain
    try:
        return float(_registry().Quantity(1.0, _registry().parse_units(expression)).to(unit).magnitude)
    except pint.DimensionalityError:
        other, hint = _HINTS.get(unit, ("", ""))
        mistaken = other and _registry().Quantity(1.0, expression).check(other)
        advice = f"; {hint}" if mistaken else ""
        raise ValueError(f"{written} is not a unit of this quantity{advice}") from None
    except pint.UndefinedUnitError:
        raise ValueError(f"{written!r} is not a unit; capital and small letters count") from None
    except pint.PintError:
        raise ValueError(f"{written!r} is not a unit") from None


def to_fraction(text: str) -> float:
    """Convert a text in percent to a fraction.

    Parameters
    ----------
    text : str
        Number, followed by "%" or "percent".

    Returns
    -------
    float
        Fraction, dimensionless.

    Raises
    ------
    ValueError
        If the text is not a number in percent. Other dimensionless units, such as rad, are refused.

    Examples
    --------
    >>> to_fraction("3 %")
    0.03
    """
    match = _NUMBER_AND_UNIT.fullmatch(text)
    if match is None or match[2] not in ("%", "percent"):
        raise ValueError("it is not a number in percent")
    return float(f"{float(match[1]) / 100.0:.15g}")


def length_unit(text: str) -> str:
    """Check that a text is a unit of length, and return it.

    Raises
    ------
    InputError
        If the text is not a unit of length.

    Examples
    --------
    >>> length_unit("um")
    'um'
    """
    try:
        to_si(f"1 {text}", "m")
    except ValueError as error:
        raise InputError(got=f"{shown(text)} ({error})", takes="a unit of length such as 'um'") from None
    return text


@dataclass(frozen=True)
class Quantity:
    """Pydantic annotation of a physical quantity: number in SI units or text with unit, within bounds.

    Attributes
    ----------
    unit : str
        SI unit as pint writes it; empty for a dimensionless quantity.
    above, below : float
        Bounds in ``unit`` that are not allowed themselves.
    least, most : float
        Smallest and largest value allowed, in ``unit``.
    reason : str
        Reason for the bounds, or a description of the quantity, for messages.
    fraction : bool
        Whether the value may be a text in percent.
    """

    unit: str
    above: float = -math.inf
    below: float = math.inf
    least: float = -math.inf
    most: float = math.inf
    reason: str = ""
    fraction: bool = False

    def __get_pydantic_core_schema__(self, _: Any, __: GetCoreSchemaHandler) -> CoreSchema:
        return core_schema.no_info_plain_validator_function(self.parse)

    def parse(self, entry: object) -> float:
        """Convert an entry of a case to a value in SI units.

        Raises
        ------
        InputError
            If the entry is not a number, has a wrong unit, or is out of bounds.
        """
        try:
            value = self._number(entry)
            if not math.isfinite(value):
                raise ValueError("it is not finite")
            if not (self.above < value < self.below and self.least <= value <= self.most):
                raise ValueError("")
        except ValueError as error:
            why = f" ({error})" if str(error) else ""
            raise InputError(got=f"{shown(entry)}{why}", takes=self.takes) from None
        return value

    def _number(self, entry: object) -> float:
        if isinstance(entry, str) and self.unit:
            return to_si(entry, self.unit)
        if isinstance(entry, str) and self.fraction:
            return to_fraction(entry)
        if isinstance(entry, bool) or not isinstance(entry, numbers.Real):
            raise ValueError("it is not a number")
        try:
            return float(entry)
        except OverflowError:
            raise ValueError("it is too large") from None

    @property
    def takes(self) -> str:
        """Description of the values that are allowed, for messages."""
        text = f"a number in {self.unit} or a text with its unit" if self.unit else "a number"
        text += " or a text in percent" if self.fraction else ""
        bounds = [
            f"{word} {bound:g}"
            for word, bound in (
                ("above", self.above),
                ("at least", self.least),
                ("below", self.below),
                ("at most", self.most),
            )
            if math.isfinite(bound)
        ]
        if bounds:
            text += ", " + " and ".join(bounds)
        return text + (f": {self.reason}" if self.reason else "")


@dataclass(frozen=True)
class Quantities:
    """Pydantic annotation of a list of quantities of one kind, parsed to a tuple of floats in SI units.

    Attributes
    ----------
    each : Quantity
        Unit and bounds of each value.
    least : int
        Smallest number of values.
    """

    each: Quantity
    least: int = 1

    def __get_pydantic_core_schema__(self, _: Any, __: GetCoreSchemaHandler) -> CoreSchema:
        return core_schema.no_info_plain_validator_function(self.parse)

    def parse(self, entry: object) -> tuple[float, ...]:
        """Convert an entry of a case to values in SI units.

        Raises
        ------
        InputError
            If the entry is not a list, is too short, or a value is not valid.
        """
        if not isinstance(entry, list | tuple) or len(entry) < self.least:
            raise InputError(
                got=shown(entry), takes=f"a list of {self.least} or more, each {self.each.takes}"
            )
        return tuple(self.each.parse(item) for item in entry)


@dataclass(frozen=True)
class Count:
    """Pydantic annotation of a whole number within bounds.

    Attributes
    ----------
    least, most : int
        Smallest and largest value allowed.
    reason : str
        Reason for the bounds, or a description of the number, for messages.
    """

    least: int
    most: int
    reason: str

    def __get_pydantic_core_schema__(self, _: Any, __: GetCoreSchemaHandler) -> CoreSchema:
        return core_schema.no_info_plain_validator_function(self.parse)

    def parse(self, entry: object) -> int:
        """Check an entry of a case and return it as a whole number.

        Raises
        ------
        InputError
            If the entry is not a whole number or is out of bounds.
        """
        whole = isinstance(entry, numbers.Integral) and not isinstance(entry, bool)
        if not (whole and self.least <= int(entry) <= self.most):  # type: ignore[call-overload]
            raise InputError(
                got=shown(entry), takes=f"a whole number from {self.least} to {self.most}: {self.reason}"
            )
        return int(entry)  # type: ignore[call-overload, no-any-return]
