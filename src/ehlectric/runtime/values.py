"""Values of inputs and results: what is a number, and equality and representation of objects with arrays."""

from __future__ import annotations

import textwrap
from collections.abc import Iterator, Mapping
from dataclasses import fields, is_dataclass
from typing import Any, ClassVar, TypeGuard

import numpy as np

# Longest representation [characters].
WIDTH = 200


class Values:
    """Base class of frozen dataclasses with arrays: they can be compared, and print as one short line.

    Two instances are equal if they are of the same class and all of their fields are equal: arrays to the
    last bit, with NaN equal to NaN. Fields with ``compare=False``, such as computing times, are left out.
    Like arrays, the instances cannot be hashed. A subclass is decorated with
    ``dataclass(frozen=True, eq=False, repr=False)``.

    Examples
    --------
    >>> from dataclasses import dataclass
    >>> @dataclass(frozen=True, eq=False, repr=False)
    ... class Film(Values):
    ...     thickness: np.ndarray
    ...     status: str = "converged"
    >>> film = Film(np.array([1e-6, np.nan]))
    >>> film, film == Film(np.array([1e-6, np.nan])), film == Film(np.zeros(2))
    (Film(thickness=float64 (2,), status='converged'), True, False)
    """

    __hash__: ClassVar[None]  # type: ignore[assignment]  # as of every class with __eq__ alone

    def __eq__(self, other: object) -> bool:
        return same(self, other) if type(self) is type(other) else NotImplemented

    def __repr__(self) -> str:
        return shortened(f"{type(self).__name__}({', '.join(_entries(self))})")


def shortened(text: str) -> str:
    """Text on one line, cut to the longest representation."""
    return textwrap.shorten(text, WIDTH, placeholder=" ...)")


def _entries(values: Any) -> Iterator[str]:
    """Fields of a dataclass as name=value; of an array its type and shape, of other objects their class."""
    for field in fields(values):
        value = getattr(values, field.name)
        if isinstance(value, np.ndarray):
            text = f"{value.dtype} {value.shape}"
        elif value is None or isinstance(value, str | bool | int | float):
            text = repr(value)
        else:
            text = f"<{type(value).__name__}>"
        yield f"{field.name}={text}"


def same(one: Any, other: Any) -> bool:
    """Whether two values are equal: arrays to the last bit, NaN equal to NaN, dataclasses field by field.

    Parameters
    ----------
    one, other : object
        Numbers, texts, arrays, lists, tuples, mappings, datasets or dataclasses of such values.

    Examples
    --------
    >>> same([1.0, float("nan")], [1.0, float("nan")]), same(np.zeros(2), np.zeros(3))
    (True, False)
    """
    if one is other:
        return True
    if isinstance(one, np.ndarray) or isinstance(other, np.ndarray):
        return _same_arrays(np.asarray(one), np.asarray(other))
    if isinstance(one, float) and isinstance(other, float):
        return one == other or (one != one and other != other)
    if type(one) is not type(other):
        return bool(one == other)
    if isinstance(one, Mapping) and not hasattr(one, "identical"):
        return one.keys() == other.keys() and all(same(one[key], other[key]) for key in one)
    if isinstance(one, list | tuple):
        return len(one) == len(other) and all(map(same, one, other))
    if is_dataclass(one):
        compared = (field.name for field in fields(one) if field.compare)
        return all(same(getattr(one, name), getattr(other, name)) for name in compared)
    # Datasets of xarray compare name, attributes and values, NaN equal, by this method.
    return bool(one.identical(other) if hasattr(one, "identical") else one == other)


def _same_arrays(one: np.ndarray[Any, Any], other: np.ndarray[Any, Any]) -> bool:
    """Whether two arrays have the same type, shape and values."""
    if one.dtype != other.dtype or one.shape != other.shape:
        return False
    return np.array_equal(one, other, equal_nan=one.dtype.kind in "fc")


def is_number(value: object) -> TypeGuard[int | float]:
    """Whether a value is a number of Python; a bool is none, though Python counts it as an int.

    Examples
    --------
    >>> [is_number(value) for value in (1, 0.5, True, "1", None)]
    [True, True, False, False, False]
    """
    return isinstance(value, int | float) and not isinstance(value, bool)
