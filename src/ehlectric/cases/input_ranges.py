"""Ranges of uncertain inputs of a file, in its table ``ranges``."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from pydantic.fields import FieldInfo

from ehlectric.cases.amounts import Amount
from ehlectric.cases.table import Table, field_within, leaf_of, nearest_key, number_of, parser_of, table_of
from ehlectric.cases.table_edits import flattened, given_value
from ehlectric.errors import InputError, for_all, shown
from ehlectric.runtime.display import is_number

# Relative error by which a value that is rounded may lie outside of its range.
_ROUNDING = 1e-9


@dataclass(frozen=True)
class InputRange:
    """Range of an input, within which its true value is taken to lie."""

    key: str
    # low and high: ends of the range, in SI units; ``low`` is below ``high``
    low: float
    high: float


def ranges_of(
    tables: Any, model: type[Table], field_of: Callable[[str], FieldInfo] | None = None
) -> tuple[InputRange, ...]:
    """Ranges of inputs in SI units, from dotted keys or nested tables with lists of two values.

    ``field_of``, field of a dotted key, by default the field in the model. Raises InputError where a key is
    unknown or is not a number, or its values are not two that increase.

    Examples
    --------
    >>> from ehlectric.cases.bearing_case import BearingCase
    >>> ranges_of({"bearing.radial_load": ["1 kN", "2 kN"]}, BearingCase)
    (InputRange(key='bearing.radial_load', low=1000.0, high=2000.0),)
    """
    if not isinstance(tables, Mapping):
        raise InputError(got=shown(tables), takes="a table of keys, each with a list of two values")
    known: set[str] = set()

    def ranged(item: tuple[str, Any]) -> InputRange:
        key, value = item
        if key in known:
            raise InputError(key, got="it twice", takes="it once")
        known.add(key)
        return _range(key, value, field_of_values(key, model) if field_of is None else field_of(key))

    return tuple(for_all(ranged, _flat(tables)))


def _flat(tables: Mapping[str, Any], prefix: str = "") -> Iterator[tuple[str, Any]]:
    """Dotted keys with their values, from dotted keys and nested tables in any mixture."""
    for name, value in tables.items():
        if isinstance(value, Mapping):
            yield from _flat(value, f"{prefix}{name}.")
        else:
            yield prefix + name, value


def _range(key: str, value: Any, field: FieldInfo) -> InputRange:
    parse, leaf = parser_of(field, key), leaf_of(key)
    if isinstance(value, str) or not isinstance(value, Sequence) or len(value) != 2:
        raise InputError(key, got=shown(value), takes="a list of two values, the smaller one first")
    ends = []
    for end in value:
        parsed = getattr(parse(end), leaf)
        if not is_number(parsed):
            raise InputError(key, got=shown(end), takes="numbers: only they have a range")
        # A whole number stays one: no other is allowed where it counts something.
        ends.append(parsed)
    low, high = ends
    if not low < high:
        raise InputError(key, got=f"{shown(value[0])} and {shown(value[1])}", takes="the smaller one first")
    return InputRange(key, low, high)


def field_of_values(key: str, model: type[Table], takes: str = "a list of two values") -> FieldInfo:
    """Field of a dotted key that takes some values."""
    field = field_within(model, key)
    if field is None or key == "ranges":
        raise InputError.unknown(key, nearest_key(key, model))
    if table_of(field.annotation) is not None:
        raise InputError(key, "is a table", takes=f"one of its keys with {takes}")
    return field


def quantity_at(model: type[Table], key: str) -> Amount | None:
    """Quantity of a dotted key; None for a key that is none."""
    field = field_within(model, key)
    quantity = None if field is None else number_of(field)
    return quantity if isinstance(quantity, Amount) else None


def flat_changes(tables: Mapping[str, Any]) -> dict[str, Any]:
    """New values by dotted key; ``ranges``, whose own keys are dotted, stays a table."""
    ranges = {"ranges": tables["ranges"]} if "ranges" in tables else {}
    return flattened({name: table for name, table in tables.items() if name != "ranges"}) | ranges


def drop_ranges(table: dict[str, Any], changes: Mapping[str, Any]) -> None:
    """Remove from the table ``ranges`` of changed tables the ranges of changed keys and of keys without a
    number.
    """
    if "ranges" in table and "ranges" not in changes:
        table["ranges"] = {
            key: ends
            for key, ends in table["ranges"].items()
            if not is_changed(key, changes) and is_number(given_value(table, key))
        }


def is_changed(key: str, changes: Mapping[str, Any]) -> bool:
    """Whether the number of a range, or the list that contains it, is changed."""
    return key in changes or key.rpartition(".")[0] in changes


def table_of_ranges(ranges: Sequence[InputRange] | None) -> dict[str, list[int | float]] | None:
    """Table ``ranges`` of a file; None without ranges."""
    return None if ranges is None else {entry.key: [entry.low, entry.high] for entry in ranges}


def check_ranges(ranges: Sequence[InputRange] | None, tables: Callable[[], Mapping[str, Any]]) -> None:
    """Check that each range is one of a number of the file with these tables, and contains it."""
    table = tables() if ranges else {}
    for span in ranges or ():
        check_range(span, given_value(table, span.key))


def check_range(span: InputRange, value: Any) -> None:
    """Check that a range contains the number of the file."""
    key = f"ranges.{span.key}"
    if isinstance(value, list | tuple):
        takes = " and ".join(f"{span.key}.{place}" for place in range(1, len(value) + 1))
        raise InputError(key, got="one range of a list", takes=f"ranges of its numbers, {takes}")
    if not is_number(value):
        raise InputError(key, got="a range", takes=f"a number for {span.key} in the file too")
    if not span.low - _ROUNDING * abs(span.low) <= value <= span.high + _ROUNDING * abs(span.high):
        raise InputError(
            key,
            got=f"{span.low:.6g} to {span.high:.6g}",
            takes=f"a range that contains the value of the file, {value:.6g} (in SI units)",
        )
