"""Numbers of case files: values in SI units from what a user wrote, within their bounds."""

from __future__ import annotations

import math
import numbers
from collections.abc import Callable
from dataclasses import dataclass, fields
from typing import Any, ClassVar, TypeVar

from pydantic import GetCoreSchemaHandler, GetJsonSchemaHandler, ValidationInfo
from pydantic_core import CoreSchema, core_schema

from ehlectric.errors import InputError, short, shown
from ehlectric.quantities import units
from ehlectric.quantities.grouped_digits import doubt
from ehlectric.quantities.inputs import input_at
from ehlectric.quantities.quantity import Bounds
from ehlectric.quantities.unit_spelling import typed

# Temperatures without a unit whose size is below this are meant in degC [K].
_COLDEST_BARE = 200.0

# Text of an infinite number in files, because JSON has no such number.
INFINITE = "inf"

# Key of the context of a validation: whether a person wrote the tables into a file.
WRITTEN = "written"


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
    """Validator that passes to ``parse`` whether a person wrote the entry, from the validation's context."""

    def validate(entry: Any, info: ValidationInfo) -> Any:
        return parse(entry, written=bool(info.context and info.context.get(WRITTEN)))

    return validate


def finite_or_text(value: Any) -> Any:
    """Number, or the text of an infinite number."""
    return INFINITE if isinstance(value, float) and math.isinf(value) else value


@dataclass(frozen=True)
class Amount(Bounds):
    """Pydantic annotation of a physical quantity: SI number or string with its unit, within bounds."""

    unit: str  # SI unit as pint writes it; empty for a dimensionless quantity

    def __get_pydantic_core_schema__(self, _: Any, __: GetCoreSchemaHandler) -> CoreSchema:
        # JSON has no infinite number.
        written = core_schema.plain_serializer_function_ser_schema(finite_or_text, when_used="json")
        return core_schema.with_info_plain_validator_function(
            _with_context(self.parse), serialization=written if self.infinite else None
        )

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
        """Convert an entry of a case to a value in SI units. Raises InputError if the entry is not a number,
        has a wrong unit, or is out of bounds.
        """
        item = scalar(entry)
        self._check_bare(item, written=written)
        try:
            value = self._number(item)
            if self.infinite and math.isinf(value):
                return math.inf
            if not math.isfinite(value):
                raise ValueError("it is not finite")
            if not self.allow(value):
                raise ValueError("")
        except ValueError as error:
            why = f" ({error})" if str(error) else ""
            takes = self.takes
            parts = units.split(item) if isinstance(item, str) else None
            if self.unit == "K" and not self.difference and parts is not None and not parts[1]:
                takes = f"a temperature with its unit, as '{str(item).strip()} °C'"
            raise InputError(got=f"{shown(entry)}{why}", takes=takes) from None
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
        if isinstance(entry, str) and units.is_infinite(entry, self.unit):
            return math.inf
        if self.difference and units.on_scale(entry):
            raise ValueError("it is a difference of temperatures, not a temperature: write K or delta_degF")
        if isinstance(entry, str) and self.unit:
            return self._of_text(entry)
        if isinstance(entry, str) and self.fraction:
            return units.to_fraction(entry)
        if isinstance(entry, str) and len(entry) <= units.LONGEST and (advice := units.comma_advice(entry)):
            raise ValueError(advice)
        if units.is_pint(entry):
            return units.from_pint(entry, self.unit, difference=self.difference)
        if isinstance(entry, bool) or not isinstance(entry, numbers.Real):
            raise ValueError("it is not a number")
        try:
            return float(entry)
        except OverflowError:
            raise ValueError("it is too large") from None

    def _of_text(self, text: str) -> float:
        """Value in SI units of a number with its unit. Raises ValueError also for a number that may be meant
        with a separator of thousands.
        """
        if self.difference:
            return units.difference(text)
        value = units.to_si(text, self.unit)
        advice = None if self.unit == "K" else doubt(typed(text), self, self.factor)
        if advice is not None:
            raise ValueError(advice)
        return value

    def factor(self, unit: str) -> float:
        """Factor from a unit, as a person writes it, to the SI unit. Raises ValueError for another unit."""
        return units.factor(unit, self.unit)

    @property
    def takes(self) -> str:
        """Description of the values that are allowed, for messages."""
        text = f"a number in {self.unit} or a string with its unit" if self.unit else "a number"
        text = "a number in K or a string such as '20 K'" if self.difference else text
        if self.unit == units.ROTATION:
            text = "a string with its unit, as '3000 rpm'"
        text += " or a string in percent" if self.fraction else ""
        return text + self.bounds_text(self._bound_text)

    def bounds_text(self, shown: Callable[[float], str]) -> str:
        """End of ``takes``: the bounds as ``shown`` writes them, and their reason."""
        bounds = [
            f"{word} {shown(bound)}"
            for word, bound in (
                ("above", self.above),
                ("at least", self.least),
                ("below", self.below),
                ("at most", self.most),
            )
            if math.isfinite(bound)
        ]
        text = f", {' and '.join(bounds)}" if bounds else ""
        text += ", or 'inf' for a plane" if self.infinite else ""
        return text + (f": {self.reason}" if self.reason else "")

    def _bound_text(self, bound: float) -> str:
        """Text of a bound: of angles in degrees, of speeds with their unit."""
        if self.unit == "rad":
            return f"{math.degrees(bound):.3g} deg"
        return f"{bound:g} {self.unit}" if self.unit == units.ROTATION else f"{bound:g}"


@dataclass(frozen=True)
class Amounts:
    """Pydantic annotation for a list of like quantities, parsed to a tuple of floats in SI units."""

    each: Amount
    least: int = 1
    single: bool = False  # whether a number that is in no list is allowed, too, and holds for all
    numbered: ClassVar[bool] = False  # whether each number has a key, as ``gear.flank_ra.1``

    def __get_pydantic_core_schema__(self, _: Any, __: GetCoreSchemaHandler) -> CoreSchema:
        return core_schema.with_info_plain_validator_function(_with_context(self.parse))

    def __get_pydantic_json_schema__(self, core: CoreSchema, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        each = self.each.__get_pydantic_json_schema__(core, handler)
        return {"type": "array", "items": each, "minItems": self.least}

    @property
    def takes(self) -> str:
        """Description of the values that are allowed, for messages."""
        return f"a list of {self.least} or more, each {self.each.takes}"

    def parse(self, entry: object, *, written: bool = False) -> float | tuple[float, ...]:
        """Convert an entry of a case to values in SI units. Raises InputError if the entry is not a list, is
        too short, or a value is not valid.
        """
        row = getattr(entry, "ndim", None) == 1
        if not (row or isinstance(entry, list | tuple)) or len(entry) < self.least:  # type: ignore[arg-type]
            raise InputError(got=shown(entry), takes=self.takes)
        return tuple(self.each.parse(item, written=written) for item in entry)  # type: ignore[attr-defined]


@dataclass(frozen=True)
class AmountOrWord:
    """Pydantic annotation of a physical quantity that a word may replace."""

    each: Amount
    word: str

    def __get_pydantic_core_schema__(self, _: Any, __: GetCoreSchemaHandler) -> CoreSchema:
        return core_schema.with_info_plain_validator_function(_with_context(self.parse))

    def __get_pydantic_json_schema__(self, core: CoreSchema, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        each = self.each.__get_pydantic_json_schema__(core, handler)
        return {"anyOf": [each, {"const": self.word}]}

    @property
    def takes(self) -> str:
        """Description of the values that are allowed, for messages."""
        return f"{self.word!r}, or {self.each.takes}"

    def parse(self, entry: object, *, written: bool = False) -> float | str:
        """Convert an entry of a case to a value in SI units, or to the word. Raises InputError if the entry
        is neither.
        """
        return self.word if entry == self.word else self.each.parse(entry, written=written)


@dataclass(frozen=True)
class Count:
    """Pydantic annotation of a whole number within bounds."""

    # least and most: smallest and largest value allowed.
    least: int
    most: int
    reason: str  # reason for the bounds, or a description of the number, for messages

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

    def parse(self, entry: object, *, written: bool = False) -> int:  # noqa: ARG002
        """Check an entry of a case and return it as a whole number. Raises InputError if the entry is not a
        whole number or is out of bounds.
        """
        item = scalar(entry)
        whole = isinstance(item, numbers.Integral) and not isinstance(item, bool)
        if not (whole and self.least <= int(item) <= self.most):  # type: ignore[call-overload]
            raise InputError(got=shown(entry), takes=self.takes)
        return int(item)  # type: ignore[call-overload, no-any-return]


N = TypeVar("N", Amount, Count)


def with_bounds(kind: type[N], entry: object) -> N:
    """Return the amount or count with the unit and bounds of a book entry or law parameter."""
    names = (field.name for field in fields(kind))
    return kind(**{name: getattr(entry, name) for name in names})


def amount_at(key: str) -> Amount:
    """Unit and bounds of the input with a dotted key.

    Examples
    --------
    >>> amount_at("bearing.bore").least
    0.0001
    """
    return with_bounds(Amount, input_at(key))
