"""Table ``ranges`` of a bearing file: inputs that are known between two values only."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Annotated, Any

from pydantic import create_model
from pydantic.fields import FieldInfo

from ehlectric.cases.table import Table, nearest_key, table_of
from ehlectric.errors import InputError, shown
from ehlectric.runtime.values import is_number


@dataclass(frozen=True)
class InputRange:
    """Range of an input, within which its true value is taken to lie.

    Attributes
    ----------
    key : str
        Dotted key of the case.
    low, high : float
        Ends of the range, in SI units; ``low`` is below ``high``.
    """

    key: str
    low: float
    high: float


def ranges_of(tables: Any, model: type[Table]) -> tuple[InputRange, ...]:
    """Ranges of inputs, from dotted keys or nested tables with lists of two values.

    Parameters
    ----------
    tables : mapping
        Two values by key of the case: numbers in SI units, or texts with a unit.
    model : type of Table
        Class of the case that has the keys.

    Returns
    -------
    tuple of InputRange
        Ranges in the order of the tables, SI units.

    Raises
    ------
    InputError
        Where a key is unknown or is not a number, or its values are not two that increase.

    Examples
    --------
    >>> from ehlectric.cases.bearings.case import BearingCase
    >>> ranges_of({"bearing.radial_load": ["1 kN", "2 kN"]}, BearingCase)
    (InputRange(key='bearing.radial_load', low=1000.0, high=2000.0),)
    """
    if not isinstance(tables, Mapping):
        raise InputError(got=shown(tables), takes="a table of keys, each with a list of two values")
    found: dict[str, InputRange] = {}
    for key, value in _flat(tables):
        if key in found:
            raise InputError(key, got="it twice", takes="it once")
        found[key] = _range(key, value, model)
    return tuple(found.values())


def _flat(tables: Mapping[str, Any], prefix: str = "") -> Iterator[tuple[str, Any]]:
    """Dotted keys with their values, from dotted keys and nested tables in any mixture."""
    for name, value in tables.items():
        if isinstance(value, Mapping):
            yield from _flat(value, f"{prefix}{name}.")
        else:
            yield prefix + name, value


def _range(key: str, value: Any, model: type[Table]) -> InputRange:
    field, (table, _, leaf) = _field(key, model), key.rpartition(".")
    if isinstance(value, str) or not isinstance(value, Sequence) or len(value) != 2:
        raise InputError(key, got=shown(value), takes="a list of two values, the smaller one first")
    annotation = Annotated[field.annotation, *field.metadata] if field.metadata else field.annotation
    keys: Any = {leaf: (annotation, ...)}
    one: type[Table] = create_model("Value", __base__=Table, **keys)
    ends = []
    for end in value:
        try:
            parsed = getattr(one.from_dict({leaf: end}), leaf)
        except InputError as error:
            raise error.under(table) if table else error from None
        if not is_number(parsed):
            raise InputError(key, got=shown(end), takes="numbers: only they have a range")
        # A whole number stays one: no other is allowed where it counts something.
        ends.append(parsed)
    low, high = ends
    if not low < high:
        raise InputError(key, got=f"{shown(value[0])} and {shown(value[1])}", takes="the smaller one first")
    return InputRange(key, low, high)


def _field(key: str, model: type[Table]) -> FieldInfo:
    """Field of a dotted key."""
    field: FieldInfo | None = None
    inner: type[Table] | None = model
    for name in key.split("."):
        field = None if inner is None else inner.known_keys().get(name)
        if field is None or key == "ranges":
            raise InputError.unknown(key, nearest_key(key, model))
        inner = table_of(field.annotation)
    if field is None or inner is not None:
        raise InputError(key, "is a table", takes="one of its keys with a list of two values")
    return field
