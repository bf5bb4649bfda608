"""Numbers and units in case files: conversion of strings to SI values, and checks of bounds."""

from __future__ import annotations

import math
import numbers
import re
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from pydantic import GetCoreSchemaHandler, GetJsonSchemaHandler, ValidationInfo
from pydantic_core import CoreSchema, core_schema

from ehlectric.cases import units
from ehlectric.errors import InputError, short, shown

_PREFIXES = {1e9: "G", 1e6: "M", 1e3: "k", 1.0: "", 1e-3: "m", 1e-6: "µ", 1e-9: "n", 1e-12: "p"}

# Groups that are never given up, "++" and the like, keep the time proportional to the length of the text.
_NUMBER_AND_UNIT = re.compile(r"([-+]?(?:\d++\.?\d*+|\.\d++)(?:[eE][-+]?\d++)?+)\s*+(.*)")

# Longest text of a number with its unit [characters].
_LONGEST = 200

# Temperatures without a unit whose size is below this are meant in degC [K].
_COLDEST_BARE = 200.0

# Key of the context of a validation: whether a person wrote the tables into a file.
WRITTEN = "written"


def unit_for(largest: float, unit: str, *, least: float = 0.1) -> tuple[float, str]:
    """Factor from ``unit`` to a prefixed unit in which ``largest`` is at least ``least``, and this unit."""
    size = next((p for p in _PREFIXES if least * p <= largest), 1e-12)
    prefixed = _PREFIXES[size] + unit
    # Dielectric strengths are usually given in V/µm.
    return 1.0 / size, "V/µm" if prefixed == "MV/m" else prefixed


def to_si(text: str, unit: str) -> float:
    """Convert a string such as "1.57 MN/m" to a value in an SI unit.

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
        If the string is not a number with a unit of the right dimension; the message says why.

    Examples
    --------
    >>> to_si("22 1/GPa", "1/Pa")
    2.2e-08
    """
    number, written = _split(text)
    if not written:
        raise ValueError("it has no unit")
    if unit == "K":
        return units.absolute(number, written)
    ratio = units.factor(written, unit)
    # Fifteen digits remove the rounding error of factors such as 1e-3, which are not binary numbers. A number
    # in the SI unit itself stays as it is: it may have been written by ``to_toml``.
    return number if ratio == 1.0 else float(f"{number * ratio:.15g}")


def _split(text: str, otherwise: str = "it is not a number with a unit") -> tuple[float, str]:
    """Number and unit in a text; raises ValueError, with advice or the given words, if it has none."""
    if len(text) > _LONGEST:
        raise ValueError(f"it has {len(text)} characters, which is too long")
    match = _NUMBER_AND_UNIT.fullmatch(units.plain(text).strip())
    advice = units.comma_advice(text)
    if match is None or advice:
        raise ValueError(advice or otherwise)
    return float(match[1]), match[2]


def to_fraction(text: str) -> float:
    """Convert a string in percent to a fraction.

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
        If the string is not a number in percent. Other dimensionless units, such as rad, are refused.

    Examples
    --------
    >>> to_fraction("3 %")
    0.03
    """
    number, written = _split(text, "it is not a number in percent")
    if written not in ("%", "percent"):
        raise ValueError("it is not a number in percent")
    return float(f"{number / 100.0:.15g}")


def length_unit(text: str) -> str:
    """Check that a string is a unit of length, and return it.

    Raises
    ------
    InputError
        If the string is not a unit of length.

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


def scalar(entry: object) -> object:
    """Number in an array without dimensions; any other entry unchanged.

    Examples
    --------
    >>> import numpy as np
    >>> scalar(np.array(2.5))
    2.5
    """
    if not units.is_pint(entry) and getattr(entry, "ndim", None) == 0 and hasattr(entry, "item"):
        return entry.item()
    return entry


def _with_context(parse: Callable[..., Any]) -> Callable[[Any, ValidationInfo], Any]:
    """Validator that tells ``parse`` whether a person wrote the entry, from the context of the validation."""

    def validate(entry: Any, info: ValidationInfo) -> Any:
        return parse(entry, written=bool(info.context and info.context.get(WRITTEN)))

    return validate


@dataclass(frozen=True)
class Quantity:
    """Pydantic annotation of a physical quantity: number in SI units or string with its unit, within bounds.

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
        Whether the value may be a string in percent.
    difference : bool
        Whether the value is a difference of temperatures, which has no zero of a scale.
    """

    unit: str
    above: float = -math.inf
    below: float = math.inf
    least: float = -math.inf
    most: float = math.inf
    reason: str = ""
    fraction: bool = False
    difference: bool = False

    def __get_pydantic_core_schema__(self, _: Any, __: GetCoreSchemaHandler) -> CoreSchema:
        return core_schema.with_info_plain_validator_function(_with_context(self.parse))

    def __get_pydantic_json_schema__(self, _: CoreSchema, __: GetJsonSchemaHandler) -> dict[str, Any]:
        keywords = {
            "exclusiveMinimum": self.above,
            "minimum": self.least,
            "exclusiveMaximum": self.below,
            "maximum": self.most,
        }
        bounds = {name: bound for name, bound in keywords.items() if math.isfinite(bound)}
        number: dict[str, Any] = {"type": "number", **bounds}
        if self.unit == units.ROTATION:
            return {"type": "string", "description": self.takes}
        if not self.unit and not self.fraction:
            return number
        # A string has the bounds too, but a schema cannot state them.
        return {"anyOf": [number, {"type": "string"}], "description": self.takes}

    def parse(self, entry: object, *, written: bool = False) -> float:
        """Convert an entry of a case to a value in SI units.

        Parameters
        ----------
        entry : object
            Number in SI units, string with its unit, quantity of pint, or array without dimensions.
        written : bool
            Whether a person wrote the entry into a file or a command. A rotational speed then needs its unit.

        Returns
        -------
        float
            Value in ``unit``.

        Raises
        ------
        InputError
            If the entry is not a number, has a wrong unit, or is out of bounds.
        """
        item = scalar(entry)
        self._check_bare(item, written=written)
        try:
            value = self._number(item)
            if not math.isfinite(value):
                raise ValueError("it is not finite")
            if not (self.above < value < self.below and self.least <= value <= self.most):
                raise ValueError("")
        except ValueError as error:
            why = f" ({error})" if str(error) else ""
            raise InputError(got=f"{shown(entry)}{why}", takes=self.takes) from None
        return value

    def _check_bare(self, entry: object, *, written: bool) -> None:
        """Refuse a number without a unit where its unit is not certain: 3000 may be rpm, 70 may be degC."""
        if isinstance(entry, bool) or not isinstance(entry, numbers.Real):
            return
        try:
            number = float(entry)
        except OverflowError:
            return  # any quantity refuses it
        # Tables that the program saved hold floats in SI units, never whole numbers.
        typed = written or isinstance(entry, numbers.Integral)
        if self.unit == units.ROTATION and typed:
            raise InputError(
                got=shown(entry),
                takes=(
                    f"a string with its unit: '{short(f'{entry}')} rpm' or '{short(f'{entry}')} rad/s' "
                    f"(= {short(f'{number / units.RPM:.0f}')} rpm)"
                ),
            )
        coldest = _COLDEST_BARE if typed else self.least
        if self.unit == "K" and not self.difference and -_COLDEST_BARE < number < min(coldest, _COLDEST_BARE):
            raise InputError(
                got=shown(entry),
                takes=f"a temperature with its unit, as '{entry} °C': a bare number would be in kelvin",
            )

    def _number(self, entry: object) -> float:
        if self.difference and units.on_scale(entry):
            raise ValueError("it is a difference of temperatures, not a temperature")
        if isinstance(entry, str) and self.unit:
            return to_si(entry, self.unit)
        if isinstance(entry, str) and self.fraction:
            return to_fraction(entry)
        if isinstance(entry, str) and len(entry) <= _LONGEST and (advice := units.comma_advice(entry)):
            raise ValueError(advice)
        if units.is_pint(entry):
            return units.from_pint(entry, self.unit)
        if isinstance(entry, bool) or not isinstance(entry, numbers.Real):
            raise ValueError("it is not a number")
        try:
            return float(entry)
        except OverflowError:
            raise ValueError("it is too large") from None

    @property
    def takes(self) -> str:
        """Description of the values that are allowed, for messages."""
        text = f"a number in {self.unit} or a string with its unit" if self.unit else "a number"
        text = "a number in K or a string such as '20 K'" if self.difference else text
        if self.unit == units.ROTATION:
            text = "a string with its unit, as '3000 rpm'"
        text += " or a string in percent" if self.fraction else ""
        unit = f" {self.unit}" if self.unit == units.ROTATION else ""
        bounds = [
            f"{word} {bound:g}{unit}"
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
        return core_schema.with_info_plain_validator_function(_with_context(self.parse))

    def __get_pydantic_json_schema__(self, core: CoreSchema, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        each = self.each.__get_pydantic_json_schema__(core, handler)
        return {"type": "array", "items": each, "minItems": self.least}

    @property
    def takes(self) -> str:
        """Description of the values that are allowed, for messages."""
        return f"a list of {self.least} or more, each {self.each.takes}"

    def parse(self, entry: object, *, written: bool = False) -> tuple[float, ...]:
        """Convert an entry of a case to values in SI units.

        Parameters
        ----------
        entry : object
            List, tuple or one-dimensional array of values as ``Quantity.parse`` accepts them.
        written : bool
            Whether a person wrote the entry into a file or a command.

        Returns
        -------
        tuple of float
            Values in the unit of ``each``.

        Raises
        ------
        InputError
            If the entry is not a list, is too short, or a value is not valid.
        """
        row = getattr(entry, "ndim", None) == 1
        if not (row or isinstance(entry, list | tuple)) or len(entry) < self.least:  # type: ignore[arg-type]
            raise InputError(got=shown(entry), takes=self.takes)
        return tuple(self.each.parse(item, written=written) for item in entry)  # type: ignore[attr-defined]


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

    def __get_pydantic_json_schema__(self, _: CoreSchema, __: GetJsonSchemaHandler) -> dict[str, Any]:
        return {
            "type": "integer",
            "minimum": self.least,
            "maximum": self.most,
            "description": self.reason,
        }

    @property
    def takes(self) -> str:
        """Description of the values that are allowed, for messages."""
        return f"a whole number from {self.least} to {self.most}: {self.reason}"

    def parse(self, entry: object) -> int:
        """Check an entry of a case and return it as a whole number.

        Raises
        ------
        InputError
            If the entry is not a whole number or is out of bounds.
        """
        item = scalar(entry)
        whole = isinstance(item, numbers.Integral) and not isinstance(item, bool)
        if not (whole and self.least <= int(item) <= self.most):  # type: ignore[call-overload]
            raise InputError(got=shown(entry), takes=self.takes)
        return int(item)  # type: ignore[call-overload, no-any-return]
