"""Fields of the measured values of a page, and texts of values with their uncertainties."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import replace
from functools import lru_cache
from typing import Any

from ehlectric.app.form_fields.axle_fields import MEASURED, measured_places
from ehlectric.app.form_fields.field import Field, form_data, written_text
from ehlectric.app.page_inputs import Inputs, dotted_key
from ehlectric.cases.axle_keys import name_of_quantity
from ehlectric.quantities.field_help import help_text
from ehlectric.quantities.inputs import input_at
from ehlectric.quantities.quantity import data_file
from ehlectric.quantities.units import in_unit, rounded, split
from ehlectric.readable import capital

# Key of a file of operating points.
MEASURED_FILE = f"{MEASURED}.file"

# Sign before an uncertainty, and other signs that a user may type.
_SIGN, _SIGNS = "+-", re.compile(r"\+/?-|±")


def has_measured(kind: str) -> bool:
    """Whether a page of a ``kind`` offers fields of measured values."""
    return kind in form_data("measured")


def measured_fields(kind: str, inputs: Inputs) -> Mapping[str, Field]:
    """Fields of the measured values of a page of a ``kind`` by their names; none for a page without them.

    The fields of an axle depend on its shafts, bearings and meshes.

    Examples
    --------
    >>> list(measured_fields("gear", Inputs())), measured_fields("gear", Inputs())["capacitance"].unit
    (['capacitance', 'breakdown_voltage', 'conducting_share'], 'pF')
    >>> axle = Inputs({"shaft": [{"name": "rotor"}], "bearing": [{"shaft": "rotor"}]})
    >>> list(measured_fields("axle", axle))[::3], measured_fields("axle", axle)["shafts.rotor.voltage"].label
    (['elements.rotor_1.capacitance', 'shafts.rotor.voltage'], 'Voltage of the shaft rotor')
    """
    offered = form_data("measured").get(kind, ())
    if not isinstance(offered, Mapping):
        return {name: _field(name) for name in offered}
    fields = (
        _field(dotted_key([place, key, name]), f"axle.{MEASURED}.{place}.{name}", text)
        for place, named in measured_places(inputs).items()
        for key, text in named.items()
        for name in offered[place]
    )
    return {field.key.removeprefix(f"{MEASURED}."): field for field in fields}


# Names of shafts, which a user types, are in the names of fields.
@lru_cache(maxsize=256)
def _field(name: str, of_book: str = "", element: str = "") -> Field:
    """Field of a measured value; ``of_book``, key of its entry in the book if it differs from its own key."""
    known = of_book or f"{MEASURED}.{name}"
    entry = input_at(known)
    assert entry is not None
    about = _column(name)
    unit = about["usual"] if about["unit"] else ""
    label = capital(" ".join(filter(None, [entry.label, element])))
    return Field(f"{MEASURED}.{name}", label, unit, help=help_text(known))


def _column(name: str) -> Mapping[str, Any]:
    columns: Mapping[str, Mapping[str, Any]] = data_file("ehlectric.quantities", "measured_columns.toml")[
        "calibration"
    ]
    return columns[name_of_quantity(name)]


def measured_keys(kind: str, inputs: Inputs) -> tuple[str, ...]:
    """Keys of the measured values of a page of a ``kind``; none for a page without them."""
    fields = measured_fields(kind, inputs)
    return (*(field.key for field in fields.values()), MEASURED_FILE) if has_measured(kind) else ()


def measured_text(inputs: Inputs, name: str) -> tuple[str, str]:
    """Measured value and its uncertainty as texts; empty texts without them.

    Examples
    --------
    >>> measured_text(Inputs({"measured": {"capacitance": "250 pF +- 5 %"}}), "capacitance")
    ('250 pF', '5 %')
    """
    return _pieces(str(inputs.value(f"{MEASURED}.{name}") or ""))


def _pieces(text: str) -> tuple[str, str]:
    """Value before the first sign of an uncertainty, and the uncertainty behind the sign."""
    value, *part = _SIGNS.split(text, maxsplit=1)
    return value.strip(), "".join(part).strip()


def with_value(inputs: Inputs, name: str, field: Field, text: str) -> str | None:
    """Measured value of a typed text with its uncertainty; None for an empty text.

    If the text has no uncertainty, the value has its present uncertainty, or the usual one if no readable
    uncertainty is given. A bare number has the unit of the other number, or else the unit of the field.

    Examples
    --------
    >>> field = measured_fields("bearing", Inputs())["capacitance"]
    >>> with_value(Inputs(), "capacitance", field, "250")
    '250 pF +- 5 %'
    >>> with_value(Inputs(), "capacitance", field, "0.25 ± 0.01 nF")
    '0.25 nF +- 0.01 nF'
    """
    first, part = _pieces(text)
    if not first:
        return None
    value = str(field.from_text(written_text(field, _with_unit(first, part, field))))
    if part:
        return _joined(value, _uncertainty(field, part, value))
    present = measured_text(inputs, name)[1]
    return _joined(value, present if is_uncertainty(field, present) else _usual_uncertainty(name, value))


def with_uncertainty(inputs: Inputs, name: str, field: Field, text: str) -> str:
    """Measured value with the uncertainty of a typed text; a bare number has the unit of the value.

    Examples
    --------
    >>> inputs = Inputs({"measured": {"outer_ring_temperature": "74 degC +- 1 K"}})
    >>> field = measured_fields("bearing", Inputs())["outer_ring_temperature"]
    >>> with_uncertainty(inputs, "outer_ring_temperature", field, "2")
    '74 degC +- 2 K'
    """
    value, (first, part) = measured_text(inputs, name)[0], _pieces(text)
    return _joined(value, _uncertainty(field, part or first, value))


def _uncertainty(field: Field, text: str, value: str) -> str:
    """Uncertainty of a typed text; a bare number has the unit of the value, or else the unit of the field."""
    part = replace(field, unit=_unit_of_difference(field)).from_text(_with_unit(text, value, field))
    return "" if part is None else str(part)


def _with_unit(text: str, other: str, field: Field) -> str:
    """Bare number with the unit of another number, if values of the field may have this unit. The unit of a
    temperature is not the unit of its uncertainty.
    """
    bare, unit = split(text), split(other)
    if bare is None or bare[1] or unit is None or not field.unit or _is_temperature(field):
        return text
    return f"{text} {unit[1]}" if in_unit(other, field.unit) is not None else text


def _is_temperature(field: Field) -> bool:
    return field.unit == "degC"


def _unit_of_difference(field: Field) -> str:
    """Unit of an uncertainty that is typed without a unit."""
    return "K" if _is_temperature(field) else field.unit


def is_uncertainty(field: Field, text: str) -> bool:
    """Whether a text is a number with a unit that the uncertainty of a value may have.

    Examples
    --------
    >>> field = measured_fields("bearing", Inputs())["capacitance"]
    >>> [is_uncertainty(field, text) for text in ("5 %", "0.01 nF", "4 % pF", "")]
    [True, True, False, False]
    """
    amount = split(text)
    if amount is None or not field.unit:
        return amount is not None and not amount[1]
    return amount[1] == "%" or in_unit(text, _unit_of_difference(field)) is not None


def _joined(value: str, part: str) -> str:
    return f"{value} {_SIGN} {part}" if part else value


def _usual_uncertainty(name: str, value: str) -> str:
    """Usual standard uncertainty of a measured value; empty if it is unknown."""
    about = _column(name)
    if about.get("absolute"):
        return f"{about['absolute']:g} {about['unit']}".strip()
    if about["unit"]:
        return f"{100.0 * about['relative']:g} %"
    amount = split(value)
    return "" if amount is None else rounded(about["relative"] * amount[0], 2)
