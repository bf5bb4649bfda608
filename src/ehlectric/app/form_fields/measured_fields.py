"""Fields of the measured values of a page, and texts of values with their uncertainties."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from typing import Any

from ehlectric.app.form_fields.axle_fields import MEASURED, measured_places
from ehlectric.app.form_fields.field import Field, form_data
from ehlectric.app.page_inputs import Inputs, dotted_key
from ehlectric.cases.axle_keys import name_of_quantity
from ehlectric.quantities.field_help import help_text
from ehlectric.quantities.inputs import input_at
from ehlectric.quantities.quantity import data_file
from ehlectric.quantities.units import rounded, split
from ehlectric.readable import capital

# Key of a file of operating points.
MEASURED_FILE = f"{MEASURED}.file"

_SIGNS = ("+-", "±")


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


@cache
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
    text = str(inputs.value(f"{MEASURED}.{name}") or "")
    sign = next((sign for sign in _SIGNS if sign in text), _SIGNS[0])
    value, _, part = text.partition(sign)
    return value.strip(), part.strip()


def with_value(inputs: Inputs, name: str, field: Field, text: str) -> str | None:
    """Measured value of a typed text, with its present uncertainty or the usual one; None for an empty text.

    Examples
    --------
    >>> field = measured_fields("bearing", Inputs())["capacitance"]
    >>> with_value(Inputs(), "capacitance", field, "250")
    '250 pF +- 5 %'
    """
    value = field.from_text(text)
    if value is None:
        return None
    part = measured_text(inputs, name)[1] or _usual_uncertainty(name, str(value))
    return _joined(str(value), part)


def with_uncertainty(inputs: Inputs, name: str, field: Field, text: str) -> str:
    """Measured value with the uncertainty of a typed text; a bare number has the unit of the field.

    Examples
    --------
    >>> inputs = Inputs({"measured": {"outer_ring_temperature": "74 degC +- 1 K"}})
    >>> field = measured_fields("bearing", Inputs())["outer_ring_temperature"]
    >>> with_uncertainty(inputs, "outer_ring_temperature", field, "2")
    '74 degC +- 2 K'
    """
    unit = "K" if _column(name)["unit"] == "K" else field.unit
    part = Field(field.key, field.label, unit).from_text(text)
    return _joined(measured_text(inputs, name)[0], "" if part is None else str(part))


def _joined(value: str, part: str) -> str:
    return f"{value} {_SIGNS[0]} {part}" if part else value


def _usual_uncertainty(name: str, value: str) -> str:
    """Usual standard uncertainty of a measured value; empty if it is unknown."""
    about = _column(name)
    if about.get("absolute"):
        return f"{about['absolute']:g} {about['unit']}".strip()
    if about["unit"]:
        return f"{100.0 * about['relative']:g} %"
    amount = split(value)
    return "" if amount is None else rounded(about["relative"] * amount[0], 2)
