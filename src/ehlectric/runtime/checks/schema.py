"""Rules for the content of stored results: variables with their dimensions, units and values, and texts.

A kind of file has a table of rules, one for each variable. ``check_variables`` holds the variables against it
before any of them is used.
"""

from __future__ import annotations

import json
import tomllib
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np

from ehlectric.arrays import Array
from ehlectric.errors import DamagedError, InputError
from ehlectric.runtime.stored_warnings import CODES_OF_TEXTS, TEXTS
from ehlectric.runtime.values import is_number as is_python_number

if TYPE_CHECKING:
    import xarray as xr

C = TypeVar("C")

# No quantity in SI units is larger, and no positive one smaller; squares of such numbers are finite.
_LARGEST, _SMALLEST = 1e30, 1e-60


class UnfitError(ValueError):
    """Error of content that is not as its rules say; its text says what is wrong, without the file."""


def _finite(values: Array) -> bool:
    return bool(np.all(np.abs(values) < _LARGEST))  # a comparison with NaN is false


def _whole(values: Array) -> bool:
    return _finite(values) and bool(np.all((values >= 0) & (values == np.floor(values))))


# Checks of values by the words of the error, each true where the values are right.
VALUES: Mapping[str, Callable[[Array], bool]] = MappingProxyType(
    {
        "finite": _finite,
        "positive": lambda values: _finite(values) and bool(np.all(values > _SMALLEST)),
        "positive or infinite": lambda values: bool(np.all(values > _SMALLEST)),
        "not negative": lambda values: _finite(values) and bool(np.all(values >= 0)),
        "finite or NaN": lambda values: _finite(values[~np.isnan(values)]),
        "not negative or NaN": lambda values: VALUES["not negative"](values[~np.isnan(values)]),
        "increasing": lambda values: _finite(values) and bool(np.all(np.diff(values) > 0)),
        "0 or 1": lambda values: bool(np.all((values == 0) | (values == 1))),
        "whole": _whole,
    }
)


@contextmanager
def refusing(path: Path) -> Iterator[None]:
    """Context in which the content of a file is used: what does not fit becomes a DamagedError of one line.

    Raises
    ------
    DamagedError
        Where an UnfitError is raised, or an error that only inconsistent content raises.
    """
    try:
        yield
    except UnfitError as error:
        raise DamagedError.of(path, str(error)) from None
    except DamagedError:
        raise
    except InputError as error:
        raise DamagedError.of(path, f"its values do not fit together, {error}") from None
    except (ArithmeticError, AttributeError, LookupError, RecursionError, TypeError, ValueError):
        raise DamagedError.of(path, "its values do not fit together") from None


@dataclass(frozen=True)
class Rule:
    """Rule that a variable of a file follows.

    Attributes
    ----------
    dims : tuple of str
        Names of its dimensions, in order.
    values : str
        What its values must be, a key of ``VALUES``.
    unit : str, optional
        Its unit; not checked by default, nor where the file states none.
    needed : bool
        Whether the file must have it.
    """

    dims: tuple[str, ...]
    values: str = "finite"
    unit: str | None = None
    needed: bool = True


def check_variables(
    dataset: xr.Dataset, rules: Mapping[str, Rule], least: Mapping[str, int] = MappingProxyType({})
) -> None:
    """Check variables of a dataset against their rules.

    Parameters
    ----------
    dataset : xarray.Dataset
        Content of a file.
    rules : mapping of str to Rule
        Rule of each variable by its name.
    least : mapping of str to int
        Smallest size of dimensions, by name; of others it is 1.

    Raises
    ------
    UnfitError
        Where a variable is missing, or has other dimensions, another type, another unit, or values that it
        cannot have.

    Examples
    --------
    >>> import xarray as xr
    >>> film = xr.Dataset({"thickness": ("x", [1e-7, -1e-7], {"units": "m"})})
    >>> check_variables(film, {"thickness": Rule(("x",), "finite", "m")})
    >>> check_variables(film, {"thickness": Rule(("x",), "positive", "m")})
    Traceback (most recent call last):
    ehlectric.runtime.checks.schema.UnfitError: thickness is not positive
    """
    for name, rule in rules.items():
        if name in dataset.variables:
            _check_variable(name, dataset.variables[name], rule, least)
        elif rule.needed:
            raise UnfitError(f"{name} is missing")


def _check_variable(name: str, variable: Any, rule: Rule, least: Mapping[str, int]) -> None:
    if variable.dims != rule.dims:
        raise UnfitError(
            f"{name} is over ({', '.join(map(str, variable.dims))}), not ({', '.join(rule.dims)})"
        )
    for dimension, size in variable.sizes.items():
        if size < least.get(dimension, 1):
            raise UnfitError(f"{name} has {size} values along {dimension}")
    if variable.dtype.kind not in "fiub":
        raise UnfitError(f"{name} is not numbers")
    stated = variable.attrs.get("units")
    if rule.unit is not None and stated is not None and not (isinstance(stated, str) and stated == rule.unit):
        raise UnfitError(f"{name} is not in {rule.unit}")
    if not VALUES[rule.values](np.asarray(variable.values)):
        raise UnfitError(f"{name} is not {rule.values}")


def text_of(attributes: Mapping[Any, Any], name: str) -> str:
    """Attribute that is a text.

    Raises
    ------
    UnfitError
        Where it is missing, or something else.
    """
    if name not in attributes:
        raise UnfitError(f"{name} is missing")
    if not isinstance(attributes[name], str):
        raise UnfitError(f"{name} is not a text")
    return str(attributes[name])


def number_of(attributes: Mapping[Any, Any], name: str, values: str = "not negative") -> float:
    """Attribute that is a number, as the words in ``values`` say, a key of ``VALUES``.

    Raises
    ------
    UnfitError
        Where it is missing, is no number, or is another one.
    """
    if name not in attributes:
        raise UnfitError(f"{name} is missing")
    found = np.asarray(attributes[name])
    if found.dtype.kind not in "fiub" or found.size != 1:
        raise UnfitError(f"{name} is not a number")
    if not VALUES[values](found):
        raise UnfitError(f"{name} is not {values}")
    return float(found.item())


def json_of(attributes: Mapping[Any, Any], name: str, right: Callable[[Any], bool]) -> Any:
    """Value of an attribute that is JSON.

    Parameters
    ----------
    attributes : mapping
        Attributes of a file.
    name : str
        Name of the attribute.
    right : callable
        Whether the value is what it must be.

    Raises
    ------
    UnfitError
        Where the attribute is missing, or its text is no JSON or another value.
    """
    text = text_of(attributes, name)
    try:
        value = json.loads(text)
    except (RecursionError, ValueError):
        raise UnfitError(f"{name} is no JSON") from None
    if not right(value):
        raise UnfitError(f"{name} is not as it was written")
    return value


def check_warnings(attributes: Mapping[Any, Any]) -> None:
    """Check the attributes that hold warnings: as many codes as texts, and no codes in earlier versions.

    Raises
    ------
    UnfitError
        Where one of them is missing or is no list of texts, or the numbers differ.
    """
    texts = json_of(attributes, TEXTS, partial(is_list, right=is_text))
    if CODES_OF_TEXTS in attributes:
        json_of(
            attributes,
            CODES_OF_TEXTS,
            lambda codes: is_list(codes, is_text) and len(codes) == len(texts),
        )


def case_of(attributes: Mapping[Any, Any], read: Callable[[dict[str, Any]], C]) -> C:
    """Case in the attribute ``case``, which is TOML.

    Parameters
    ----------
    attributes : mapping
        Attributes of a file.
    read : callable
        Function that makes the case of its nested tables.

    Raises
    ------
    UnfitError
        Where the attribute is missing, or its text is no TOML or no case.
    """
    text = text_of(attributes, "case")
    try:
        return read(tomllib.loads(text))
    except InputError as error:
        raise UnfitError(f"its case is not valid, {error}") from None
    except (RecursionError, ValueError):
        raise UnfitError("its case is no TOML") from None


def is_number(value: Any, values: str = "finite") -> bool:
    """Whether a value of JSON is a number, as the words in ``values`` say; true and false are none."""
    if not is_python_number(value) or not abs(value) < _LARGEST:
        return False
    return values == "finite" or VALUES[values](np.asarray(value, dtype=float))


def is_number_or_null(value: Any) -> bool:
    """Whether a value of JSON is a finite number or null."""
    return value is None or is_number(value)


def is_table(
    value: Any,
    columns: Mapping[str, Callable[[Any], bool]],
    others: Mapping[str, Callable[[Any], bool]] = MappingProxyType({}),
) -> bool:
    """Whether a value of JSON is an object with the keys of ``columns``, and any of those of ``others``."""
    if not isinstance(value, dict) or columns.keys() - value.keys():
        return False
    known = {**others, **columns}
    return all(key in known and known[key](item) for key, item in value.items())


def is_list(value: Any, right: Callable[[Any], bool]) -> bool:
    """Whether a value of JSON is a list whose items are right."""
    return isinstance(value, list) and all(map(right, value))


def is_text(value: Any) -> bool:
    """Whether a value of JSON is a text."""
    return isinstance(value, str)
