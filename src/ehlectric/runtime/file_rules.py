"""Rules for the content of stored results: their format, variables with dimensions, units and values, and
texts.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np
import tomli

from ehlectric.arrays import Array
from ehlectric.errors import DamagedError, InputError
from ehlectric.runtime.display import is_number as is_python_number

if TYPE_CHECKING:
    import xarray as xr

C = TypeVar("C")

# No version of a format has more digits.
_DIGITS = 6

# No quantity in SI units is larger, and no positive one smaller; squares of such numbers are finite.
LARGEST, _SMALLEST = 1e30, 1e-60

# Distance from a bound that is rounding, of shares in files of earlier versions.
ROUNDING = 1e-9


class UnfitError(ValueError):
    """Error of content that is not as its rules say; its text says what is wrong, without the file."""


def _finite(values: Array) -> bool:
    return bool(np.all(np.abs(values) < LARGEST))  # a comparison with NaN is false


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
        "0 to 1": lambda values: bool(np.all(np.abs(values - 0.5) <= 0.5 + ROUNDING)),
        "whole": _whole,
        # Also NaN and infinite.
        "a number": lambda values: values.dtype.kind in "fiu",
    }
)


def unfit_error(name: str, values: Array, rule: str) -> UnfitError:
    """Error of values that break a rule, a key of ``VALUES``; it contains the value that is out of bounds.

    >>> print(unfit_error("film_fraction", np.array([0.5, -4e-16]), "not negative"))
    film_fraction is negative, -4e-16
    """
    known = np.ravel(values)[np.isfinite(np.ravel(values))]
    if rule.startswith("not negative"):
        least = float(np.min(known, initial=np.inf))
        return UnfitError(f"{name} is negative, {least:.3g}" if least < 0.0 else f"{name} is not finite")
    if rule == "0 to 1":
        furthest = known[np.argsort(np.abs(known - 0.5))][-1:]
        furthest_text = f", but {furthest[0]:.3g}" if known.size == np.size(values) else ""
        return UnfitError(f"{name} is not from 0 to 1{furthest_text}")
    return UnfitError(f"{name} is not {rule}")


def format_of(schema: object) -> tuple[str, int]:
    """Kind and version in a schema, as ``("ehlectric.drive.result", 1)``; ``("", 0)`` where it has none."""
    kind, _, version = str(schema).rpartition("/")
    known = version.isascii() and version.isdecimal() and len(version) <= _DIGITS
    return (kind, int(version)) if known else ("", 0)


def check_format(attributes: Mapping[Any, Any], schema: str, path: Path, what: str) -> None:
    """Refuse a file of another kind, or of a later version than a schema, with an InputError.

    >>> own, path = "ehlectric.drive.result/2", Path("a.nc")
    >>> check_format({"schema": "ehlectric.drive.result/1"}, own, path, "the result of a drive")
    >>> check_format({"schema": "ehlectric.drive.result/3"}, own, path, "the result of a drive")
    Traceback (most recent call last):
    ehlectric.errors.InputError: a.nc: is of a later version of ehlectric; expected version 2 or
    earlier of ehlectric.drive.result, not 3
    """
    (expected, version), (kind, stored) = format_of(schema), format_of(attributes.get("schema"))
    if kind != expected or not stored:
        raise InputError(path, f"is not {what} of ehlectric")
    if stored > version:
        takes = f"version {version} or earlier of {expected}, not {stored}"
        raise InputError(path, "is of a later version of ehlectric", takes=takes)


@contextmanager
def refusing(path: Path) -> Iterator[None]:
    """Context in which the content of a file is used: what does not fit becomes a DamagedError of one line.

    That is an UnfitError, and an error that only inconsistent content raises.
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
    """Rule for a variable of a file: dimensions, values by a key of ``VALUES``, and unit.

    The unit is not checked where it is None, nor where the file states none. ``needed`` says whether the file
    must have the variable.
    """

    dims: tuple[str, ...]
    values: str = "finite"
    unit: str | None = None
    needed: bool = True


def check_variables(
    dataset: xr.Dataset, rules: Mapping[str, Rule], least: Mapping[str, int] = MappingProxyType({})
) -> None:
    """Check variables of a dataset against their rules by name; raises an UnfitError.

    ``least`` has the smallest size of dimensions; of others it is 1.

    >>> import xarray as xr
    >>> film = xr.Dataset({"thickness": ("x", [1e-7, -1e-7], {"units": "m"})})
    >>> check_variables(film, {"thickness": Rule(("x",), "finite", "m")})
    >>> check_variables(film, {"thickness": Rule(("x",), "positive", "m")})
    Traceback (most recent call last):
    ehlectric.runtime.file_rules.UnfitError: thickness is not positive
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
        raise unfit_error(name, np.asarray(variable.values), rule.values)


def text_of(attributes: Mapping[Any, Any], name: str) -> str:
    """Attribute that is a text; raises an UnfitError where it is missing, or something else."""
    if name not in attributes:
        raise UnfitError(f"{name} is missing")
    if not isinstance(attributes[name], str):
        raise UnfitError(f"{name} is not a text")
    return str(attributes[name])


def number_of(attributes: Mapping[Any, Any], name: str, values: str = "not negative") -> float:
    """Attribute that is a number, as a key of ``VALUES`` says; raises an UnfitError where it is none."""
    if name not in attributes:
        raise UnfitError(f"{name} is missing")
    number = np.asarray(attributes[name])
    if number.dtype.kind not in "fiub" or number.size != 1:
        raise UnfitError(f"{name} is not a number")
    if not VALUES[values](number):
        raise unfit_error(name, number, values)
    return float(number.item())


def json_of(attributes: Mapping[Any, Any], name: str, right: Callable[[Any], bool]) -> Any:
    """Value of an attribute that is JSON; raises an UnfitError where it is not ``right``."""
    text = text_of(attributes, name)
    try:
        value = json.loads(text)
    except (RecursionError, ValueError):
        raise UnfitError(f"{name} is no JSON") from None
    if not right(value):
        raise UnfitError(f"{name} is not as it was written")
    return value


def case_of(attributes: Mapping[Any, Any], read: Callable[[dict[str, Any]], C]) -> C:
    """Case in the attribute ``case``, which is TOML, by the function that makes it of its nested tables.

    Raises an UnfitError where the attribute is missing, or its text is no TOML or no case.
    """
    text = text_of(attributes, "case")
    try:
        return read(tomli.loads(text))
    except InputError as error:
        raise UnfitError(f"its case is not valid, {error}") from None
    except (RecursionError, ValueError):
        raise UnfitError("its case is no TOML") from None


def is_number(value: Any, values: str = "finite") -> bool:
    """Whether a value of JSON is a number, as the words in ``values`` say; true and false are none."""
    if not is_python_number(value) or not abs(value) < LARGEST:
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
    """Whether a value of JSON is an object with the keys of ``columns``, and any keys of ``others``."""
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
