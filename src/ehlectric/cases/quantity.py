"""Numbers with units at the edge of the program: what a case file may write for a physical quantity."""

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

# A product and quotient of named units with one-digit exponents. Anything more is no unit of the field, and a
# tower of exponents would keep pint busy for ever.
_NAME = r"[A-Za-zµμΩ°]+(?:(?:\*\*|\^)?[-+]?[1-9]|²|³)?"
_UNIT = re.compile(rf"(?:1?\s*/\s*)?{_NAME}(?:(?:\s*[*/·]\s*|\s+){_NAME})*")
_EXPONENT = re.compile(r"(?<=[A-Za-zµμΩ°])(?:\*\*|\^)?([-+]?[1-9])")
_ANGLE = re.compile("rad|rpm|rev|turn|deg")
_NUMBER_AND_UNIT = re.compile(r"\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*(.*?)\s*")

# What is often given in place of a quantity, by the units of both, and what turns it into that.
_HINTS = {
    "Pa*s": ("m**2/s", "multiply a kinematic viscosity by the density"),
    "m/s": ("1/s", "multiply a rotational speed, in rad/s, by the radius"),
    "N/m": ("N", "divide a load by the length of the line"),
}

# Units of an absolute temperature, with the zero of each in kelvin.
_ZEROS = {"K": 0.0, "degC": 273.15, "°C": 273.15}


def unit_for(largest: float, unit: str, *, least: float = 0.1) -> tuple[float, str]:
    """Factor and prefixed unit in which ``largest`` is from ``least`` to a thousand times that."""
    size = next((p for p in _PREFIXES if least * p <= largest), 1e-12)
    prefixed = _PREFIXES[size] + unit
    # Breakdown strengths are given in V/µm.
    return 1.0 / size, "V/µm" if prefixed == "MV/m" else prefixed


@cache
def _registry() -> pint.UnitRegistry[float]:
    import pint

    return pint.UnitRegistry()


def to_si(text: str, unit: str) -> float:
    """SI value of a text such as "1.57 MN/m".

    Parameters
    ----------
    text : str
        A number and its unit.
    unit : str
        The SI unit of the quantity, as pint writes it.

    Returns
    -------
    float
        Value in ``unit``.

    Raises
    ------
    ValueError
        Where the text is not a number with a unit of the right dimension.

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
    # Fifteen digits undo the rounding of factors such as 1e-3, which are no binary numbers.
    return float(f"{float(number) * _factor(written, unit):.15g}")


def _absolute(number: float, written: str) -> float:
    """Absolute temperature [K]: 70 degC is 343.15 K, not a difference of 70 K."""
    if written not in _ZEROS:
        raise ValueError(f"{shown(written)} is not a unit of an absolute temperature: {', '.join(_ZEROS)}")
    return float(f"{number + _ZEROS[written]:.15g}")


def _factor(written: str, unit: str) -> float:
    """What a value in the unit written is multiplied with to be in ``unit``."""
    import pint

    if _UNIT.fullmatch(written) is None:
        raise ValueError(f"{shown(written)} is not a unit")
    if unit == "rad/s" and _ANGLE.search(written) is None:
        # Angles are dimensionless: 50 Hz would be 50 rad/s.
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
    """Part of one that a text in percent says.

    Parameters
    ----------
    text : str
        A number and a percent sign, or the word.

    Returns
    -------
    float
        The fraction, dimensionless.

    Raises
    ------
    ValueError
        Where the text is not a number in percent: no other unit is a part of something, though an angle is
        dimensionless too.

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
    """The text, if it is a unit of length.

    Raises
    ------
    ValueError
        Where it is none.

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
    """Pydantic annotation: a float in SI, or a text with its unit, within bounds.

    ``reason`` says why the bounds are there; a ``fraction`` may be a text in percent.
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

    def parse(self, given: object) -> float:
        """SI value of what the case gives.

        Raises
        ------
        ValueError
            With what it got and what the quantity takes.
        """
        try:
            value = self._number(given)
            if not math.isfinite(value):
                raise ValueError("it is not finite")
            if not (self.above < value < self.below and self.least <= value <= self.most):
                raise ValueError("")
        except ValueError as error:
            why = f" ({error})" if str(error) else ""
            raise InputError(got=f"{shown(given)}{why}", takes=self.takes) from None
        return value

    def _number(self, given: object) -> float:
        if isinstance(given, str) and self.unit:
            return to_si(given, self.unit)
        if isinstance(given, str) and self.fraction:
            return to_fraction(given)
        if isinstance(given, bool) or not isinstance(given, numbers.Real):
            raise ValueError("it is not a number")
        try:
            return float(given)
        except OverflowError:
            raise ValueError("it is too large") from None

    @property
    def takes(self) -> str:
        """What the quantity takes, for messages."""
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
    """Pydantic annotation: a list of quantities of one kind, as a tuple of floats in SI."""

    each: Quantity
    least: int = 1

    def __get_pydantic_core_schema__(self, _: Any, __: GetCoreSchemaHandler) -> CoreSchema:
        return core_schema.no_info_plain_validator_function(self.parse)

    def parse(self, given: object) -> tuple[float, ...]:
        """SI values of what the case gives.

        Raises
        ------
        ValueError
            With what it got and what each quantity takes.
        """
        if not isinstance(given, list | tuple) or len(given) < self.least:
            raise InputError(
                got=shown(given), takes=f"a list of {self.least} or more, each {self.each.takes}"
            )
        return tuple(self.each.parse(item) for item in given)


@dataclass(frozen=True)
class Count:
    """Pydantic annotation: a whole number within bounds."""

    least: int
    most: int
    reason: str

    def __get_pydantic_core_schema__(self, _: Any, __: GetCoreSchemaHandler) -> CoreSchema:
        return core_schema.no_info_plain_validator_function(self.parse)

    def parse(self, given: object) -> int:
        """The whole number given.

        Raises
        ------
        ValueError
            With what it got and what the count takes.
        """
        whole = isinstance(given, numbers.Integral) and not isinstance(given, bool)
        if not (whole and self.least <= int(given) <= self.most):  # type: ignore[call-overload]
            raise InputError(
                got=shown(given), takes=f"a whole number from {self.least} to {self.most}: {self.reason}"
            )
        return int(given)  # type: ignore[call-overload, no-any-return]
