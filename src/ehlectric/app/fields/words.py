"""Texts of fields as a form shows them: signs of units, and bounds of errors in the unit of the field."""

from __future__ import annotations

import re

from ehlectric.app.fields.field import Field
from ehlectric.quantities.units import in_unit, printed, rounded, si_unit, split

# Most digits of a number in a box; one with more, such as that of a point of a sweep, is rounded there.
_MOST_DIGITS = 8

_NUMBER = r"[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?"
# Kinds of numbers that the checks describe, before their bounds in SI units.
_TAKES = re.compile(
    r"(?:a number in \S+ or a string with its unit|a string with its unit, as '[^']*')"
    rf"(?P<bounds>(?:,? (?:and )?(?:above|at least|below|at most) {_NUMBER}(?: rad/s)?)*)"
)
_BOUND = re.compile(rf"({_NUMBER})(?: rad/s)?")


def shown_text(field: Field, text: str) -> str:
    """Text of a number in its box: with the signs of its unit, and without digits that nobody reads.

    Examples
    --------
    >>> speed = Field("bearing.inner_speed", "Speed", "rpm", 50.0, 20000.0)
    >>> shown_text(speed, "181.37993642342187 rad/s"), shown_text(speed, "300 rad/s")
    ('1732.0508 rpm', '300 rad/s')
    """
    found = split(text) if field.kind == "number" and field.unit else None
    if found is None or not found[1]:
        return text
    written = text.strip().removesuffix(found[1]).strip()
    number = in_unit(text, field.unit)
    if number is not None and sum(letter.isdigit() for letter in written.split("e")[0]) > _MOST_DIGITS + 2:
        return f"{rounded(number, _MOST_DIGITS)} {printed(field.unit)}"
    return f"{written} {printed(found[1])}"


def written_text(field: Field, text: str) -> str:
    """Text as the inputs have it: the unit of the field as a keyboard writes it.

    Examples
    --------
    >>> written_text(Field("bearing.temperature", "Temperature", "degC"), "70 °C")
    '70 degC'
    """
    found = split(text)
    if found is None or not field.unit or found[1] != printed(field.unit):
        return text
    return f"{text.strip().removesuffix(found[1]).strip()} {field.unit}"


def in_field_unit(field: Field, text: str) -> str:
    """Text of an error with its bounds in the unit of a field.

    Examples
    --------
    >>> field = Field("bearing.temperature", "Temperature", "degC", 20.0, 120.0)
    >>> in_field_unit(field, "got '1 degC'; expected a number in K or a string with its unit, at least 200")
    "got '1 degC'; expected a number, with or without its unit, such as 70 °C, at least -73.15 °C"
    """
    if not field.unit or field.unit == "%":
        return text
    si, unit = si_unit(field.unit), printed(field.unit)

    def number(value: str) -> str:
        found = in_unit(f"{value} {si}", field.unit)
        return f"{value} {si}" if found is None else f"{rounded(found, 5)} {unit}"

    def takes(found: re.Match[str]) -> str:
        example = f"{rounded(field.at(0.5))} {unit}"
        bounds = _BOUND.sub(lambda bound: number(bound[1]), found["bounds"])
        return f"a number, with or without its unit, such as {example}{bounds}"

    names = "|".join(sorted({re.escape(name) for name in (si, si.replace("^", "**"))}))
    elsewhere = re.compile(rf"(?<!['\d.e+-])({_NUMBER}) (?:{names})(?![\w*^/²³])")
    if si != field.unit:
        text = _TAKES.sub(lambda found: takes(found), text)
        return elsewhere.sub(lambda found: number(found[1]), text)
    return _TAKES.sub(lambda found: takes(found), text)
