"""Heights of a rough surface that a user gives as an array, instead of a file."""

from __future__ import annotations

import base64
import binascii
import math
import re
from dataclasses import dataclass
from typing import Any, Self

import numpy as np
from pydantic import GetCoreSchemaHandler, GetJsonSchemaHandler
from pydantic_core import CoreSchema, core_schema

from ehlectric.arrays import Array
from ehlectric.errors import InputError, shown
from ehlectric.quantities import units

# Largest number of points of an array of heights. A file of the case contains eleven bytes for each.
MOST_POINTS = 4_000_000

# Text of an array in a file: its shape, and its numbers as little-endian floats of eight bytes in base64.
_TEXT = re.compile(r"(\d{1,8}(?:x\d{1,8})?):([A-Za-z0-9+/]*={0,2})")


@dataclass(frozen=True, eq=False, repr=False)
class Heights:
    """Frozen heights of a profile (n,) or a map (rows, columns) [m], NaN at points without data.

    An instance is equal to an instance with the same numbers, has a hash, and can be pickled.

    Raises
    ------
    InputError
        If the values are not real numbers of one or two dimensions, or too many.

    Examples
    --------
    >>> heights = Heights([[0.0, 1e-7], [2e-7, float("nan")]])
    >>> heights, Heights.parse(heights.text()) == heights
    (<Heights 2 x 2>, True)
    """

    values: Array

    def __post_init__(self) -> None:
        object.__setattr__(self, "values", _array_of(self.values))

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Heights):
            return NotImplemented
        return np.array_equal(self.values, other.values, equal_nan=True)

    def __hash__(self) -> int:
        return hash(self.text())

    def __reduce__(self) -> tuple[Any, ...]:
        # A pickled array would be writable.
        return type(self), (np.array(self.values),)

    def __repr__(self) -> str:
        return f"<Heights {' x '.join(map(str, self.values.shape))}>"

    def __array__(self, dtype: Any = None, *, copy: bool | None = None) -> Array:
        return np.array(self.values, dtype=dtype, copy=copy)

    def text(self) -> str:
        """Text of the heights in a file, which ``parse`` reads back to equal heights."""
        # All NaN are equal, and so are both zeros.
        plain = np.where(np.isnan(self.values), np.nan, self.values + 0.0)
        numbers = base64.b64encode(plain.astype("<f8").tobytes()).decode("ascii")
        return f"{'x'.join(map(str, self.values.shape))}:{numbers}"

    @classmethod
    def parse(cls, entry: object) -> Self:
        """Heights from an array, lists of numbers, or the text of ``text``."""
        if isinstance(entry, cls):
            return entry
        values: Any = _of_text(entry) if isinstance(entry, str) else entry
        return cls(values)

    @classmethod
    def __get_pydantic_core_schema__(cls, _: Any, __: GetCoreSchemaHandler) -> CoreSchema:
        written = core_schema.plain_serializer_function_ser_schema(cls.text, when_used="json")
        return core_schema.no_info_plain_validator_function(cls.parse, serialization=written)

    @classmethod
    def __get_pydantic_json_schema__(cls, _: CoreSchema, __: GetJsonSchemaHandler) -> dict[str, Any]:
        return {"type": "string", "pattern": f"^{_TEXT.pattern}$"}


def _array_of(entry: object) -> Array:
    """Frozen copy of an array of heights; masked points become NaN."""
    takes = "real numbers in m of the shape (n,) or (rows, columns)"
    if units.is_pint(entry):
        try:
            entry = entry.m_as("m")
        except Exception:  # pint raises exceptions of several kinds
            raise InputError(got=shown(entry), takes="heights with a unit of length") from None
    try:
        given: Any = entry if isinstance(entry, np.ma.MaskedArray) else np.asarray(entry)
    except (TypeError, ValueError):
        raise InputError(got=shown(entry), takes=takes) from None
    if given.dtype.kind not in "fiu" or given.ndim not in (1, 2) or given.size == 0:
        raise InputError(got=f"an array of shape {given.shape} and type {given.dtype}", takes=takes)
    heights: Array = np.array(np.ma.filled(given.astype(float), np.nan), dtype=float, order="C")
    if heights.size > MOST_POINTS:
        raise InputError(got=f"{heights.size} heights", takes=f"at most {MOST_POINTS}")
    if np.isinf(heights).any():
        raise InputError(got="an infinite height", takes="finite numbers, or NaN at points without data")
    heights.setflags(write=False)
    return heights


def _of_text(text: str) -> Array:
    match = _TEXT.fullmatch(text)
    shape = tuple(int(part) for part in match[1].split("x")) if match else ()
    try:
        if match is None or math.prod(shape) > MOST_POINTS:
            raise ValueError(text[:20])
        array: Array = np.frombuffer(base64.b64decode(match[2], validate=True), "<f8").reshape(shape)
    except (binascii.Error, ValueError):
        raise InputError(
            got=shown(text), takes="heights as an array in Python; name a file in a TOML file"
        ) from None
    return array
