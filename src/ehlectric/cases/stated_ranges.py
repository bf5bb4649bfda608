"""Inputs that are written with their uncertainty, as "15 V/um +- 30 %" or "10 V/um to 20 V/um"."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping
from typing import Any

from ehlectric.cases.amounts import Amount
from ehlectric.errors import InputError, short, shown
from ehlectric.quantities import units
from ehlectric.quantities.grouped_digits import certain, doubt
from ehlectric.quantities.quantity import Bounds

# A value and what it may be off either way, and two ends of a range.
_AROUND = re.compile(r"(?P<value>.+?)\s*(?:\+-|\+/-|±)\s*(?P<part>.+)", re.DOTALL)
_BETWEEN = re.compile(r"(?P<low>.+?)\s+to\s+(?P<high>.+)", re.DOTALL)

_PERCENT = re.compile(r"(?P<number>[^%]+?)\s*(?:%|percent)")


def with_stated_ranges(
    tables: Mapping[str, Any], quantity_of: Callable[[str], Amount | None]
) -> dict[str, Any]:
    """Tables in which inputs with an uncertainty have their middle, and ``ranges`` both ends, in SI units.

    ``quantity_of`` gives the quantity of a dotted key, None for a key that is none. Raises InputError where
    an uncertainty is no number above 0, or ``ranges`` also has this key.

    Examples
    --------
    >>> tables = {"bearing": {"radial_load": "2 kN +- 10 %"}}
    >>> with_stated_ranges(tables, lambda key: Amount(unit="N"))
    {'bearing': {'radial_load': '2000.0 N'}, 'ranges': {'bearing.radial_load': ['1800.0 N', '2200.0 N']}}
    """
    stated: dict[str, list[Any]] = {}
    for key, text in _texts(tables):
        quantity = quantity_of(key)
        if quantity is not None:
            stated[key] = [_written(value, quantity) for value in _range(key, text, quantity)]
    if not stated:
        return dict(tables)
    given = tables.get("ranges") or {}
    if not isinstance(given, Mapping):
        return dict(tables)
    for key in stated:
        if key in given:
            raise InputError(key, got="an uncertainty, and a range in [ranges]", takes="one of the two")
    changed = _changed(tables, {key: ends[1] for key, ends in stated.items()})
    return changed | {"ranges": {**given, **{key: [ends[0], ends[2]] for key, ends in stated.items()}}}


def _texts(tables: Mapping[str, Any], prefix: str = "") -> Iterator[tuple[str, str]]:
    """Dotted keys of nested tables whose text may have an uncertainty, with these texts."""
    for name, value in tables.items():
        if isinstance(value, Mapping) and name != "ranges":
            yield from _texts(value, f"{prefix}{name}.")
        elif isinstance(value, list | tuple):
            yield from _texts({str(place): item for place, item in enumerate(value, 1)}, f"{prefix}{name}.")
        elif isinstance(value, str) and (_AROUND.fullmatch(value) or _BETWEEN.fullmatch(value)):
            yield prefix + str(name), value


def _changed(tables: Mapping[str, Any], values: Mapping[str, Any], prefix: str = "") -> dict[str, Any]:
    """Nested tables with other values of some dotted keys."""
    changed: dict[str, Any] = {}
    for name, value in tables.items():
        key = f"{prefix}{name}"
        if isinstance(value, Mapping) and name != "ranges":
            changed[name] = _changed(value, values, f"{key}.")
        elif isinstance(value, list | tuple):
            numbered = {str(place): item for place, item in enumerate(value, 1)}
            changed[name] = [*_changed(numbered, values, f"{key}.").values()]
        else:
            changed[name] = values.get(key, value)
    return changed


def _written(value: float, quantity: Amount) -> float | str:
    """Value in SI units with its unit, which a speed has to have."""
    return certain(f"{value!r} {quantity.unit}") if quantity.unit else value


def value_and_uncertainty(key: str, text: str, quantity: Amount, usual: str = "") -> tuple[float, float]:
    """Value and its uncertainty behind "+-", SI units. ``usual``, unit in the advice of an error. Raises
    InputError for a text without them.

    Examples
    --------
    >>> value_and_uncertainty("measured.shaft_voltage", "12 V +- 5 %", Amount(unit="V"))
    (12.0, 0.6000000000000001)
    """
    around = _AROUND.fullmatch(text)
    if around is None:
        raise InputError(key, got=shown(text), takes=with_uncertainty_text(text, quantity, usual))
    bare = _number(around["value"])
    if not quantity.unit and None in (bare, _number(around["part"])):
        raise InputError(key, got=shown(text), takes="two numbers, such as 0.02 +- 0.01")
    if quantity.unit and bare is not None:
        got = f"{shown(text)} ({around['value'].strip()} has no unit)"
        raise InputError(key, got=got, takes=with_uncertainty_text(around["value"], quantity, usual))
    value = _parsed(key, quantity, around["value"].strip() if quantity.unit else bare)
    return value, _difference(key, text, value, around["part"].strip(), quantity)


def with_uncertainty_text(entry: object, quantity: Amount, usual: str = "") -> str:
    """What a value with its uncertainty looks like, from what a user wrote; ``usual``, a usual unit.

    Examples
    --------
    >>> with_uncertainty_text("8", Amount(unit="V"))
    "a value with its standard uncertainty behind +-, such as '8 V +- 5 %'"
    """
    written = str(entry).strip()
    number = _number(written)
    unit = usual or quantity.unit
    if quantity.unit:
        example = f"1 {unit}" if number is None else f"{written} {unit}"
        if number is None and units.split(written) is not None:
            example = written
        example += " +- 1 K" if quantity.unit == "K" else " +- 5 %"
    else:
        example = f"{0.02 if number is None else written} +- 0.01"
    return f"a value with its standard uncertainty behind +-, such as '{short(example)}'"


def _range(key: str, text: str, quantity: Amount) -> tuple[float, float, float]:
    """Low end, middle and high end of an input with its uncertainty, SI units."""
    if between := _BETWEEN.fullmatch(text):
        low, high = (_parsed(key, quantity, between[end].strip()) for end in ("low", "high"))
        if not low < high:
            raise InputError(key, got=shown(text), takes="the smaller value first")
        return low, 0.5 * (low + high), high
    around = _AROUND.fullmatch(text)
    assert around is not None
    value = _parsed(key, quantity, around["value"].strip())
    part = _difference(key, text, value, around["part"].strip(), quantity)
    ends = value - part, value + part
    for end in ends:
        _parsed(key, quantity, certain(f"{end:.9g} {quantity.unit}") if quantity.unit else end)
    return ends[0], value, ends[1]


def _difference(key: str, text: str, value: float, part: str, quantity: Amount) -> float:
    """Largest deviation from a value in both directions, which stands behind "+-", SI units."""
    takes = "a difference above 0 behind +-, with the unit of the value or in %"
    percent = _PERCENT.fullmatch(part)
    if quantity.unit == "K":
        takes = "a difference above 0 behind +-, in K or degC, or in degF"
        number_and_unit = units.split(part)
        degree = None if number_and_unit is None else units.degree(number_and_unit[1])
        difference = None if number_and_unit is None or degree is None else degree * number_and_unit[0]
    elif percent is not None:
        number = _number(percent["number"])
        difference = None if number is None else 0.01 * number * abs(value)
    elif not quantity.unit:
        difference = _number(part)
    else:
        try:
            difference = units.to_si(part, quantity.unit)
        except ValueError:
            difference = None
        if difference is not None and (advice := doubt(part, Bounds(), quantity.factor)) is not None:
            raise InputError(key, got=f"{shown(text)} ({advice})", takes=takes)
    if difference is None or not difference > 0.0:
        raise InputError(key, got=shown(text), takes=takes)
    return difference


def _number(text: str) -> float | None:
    """Number of a text; None where it is none."""
    try:
        return float(text)
    except ValueError:
        return None


def _parsed(key: str, quantity: Amount, entry: object) -> float:
    """Value of an entry in SI units; the text of a number without a unit is this number."""
    if not quantity.unit and isinstance(entry, str) and (number := _number(entry)) is not None:
        entry = number
    try:
        return quantity.parse(entry, written=isinstance(entry, str))
    except InputError as error:
        raise error.with_text(key, error.text) from None
