"""Inputs of a case by their dotted keys: what each takes."""

from __future__ import annotations

from typing import Any, get_args, get_origin

from pydantic.fields import FieldInfo

from ehlectric.cases.bearing_case import BearingCase
from ehlectric.cases.case import Case
from ehlectric.cases.quantity import Count, Quantity
from ehlectric.cases.table import Table, nearest_key, table_of
from ehlectric.errors import InputError

# Tables and keys of a bearing file alone.
_OF_BEARINGS = ("bearing", "motor", "contacts")


def input_field(key: str) -> FieldInfo:
    """What the case says of an input.

    Parameters
    ----------
    key : str
        Dotted key of the case, rough surfaces with their number, as "roughness.1.rescale_rq".

    Raises
    ------
    InputError
        Where there is no such key, or it is a table; with the nearest known one.

    Examples
    --------
    >>> input_field("contact.entrainment_speed").is_required()
    False
    """
    names = key.split(".")
    of_bearing = names[0] in _OF_BEARINGS or names[:2] == ["lubricant", "temperature"]
    model: type[Table] = BearingCase if of_bearing else Case
    within: list[str] = []
    if names[0] == "roughness":
        if len(names) < 3 or not names[1].isdecimal():
            raise InputError(
                key, "is a list of tables", takes="a key of one of them, as roughness.1.rescale_rq"
            )
        within, names = names[1:2], [names[0], *names[2:]]
    field: FieldInfo | None = None
    inner: Any = model
    for name in names:
        field = None if inner is None else inner.known_keys().get(name)
        if field is None:
            known = nearest_key(".".join(names), model).split(".")
            known[1:1] = within if known[0] == "roughness" and len(known) > 1 else []
            raise InputError.unknown(key, ".".join(known))
        inner = table_of(field.annotation)
    if field is None or inner is not None:
        raise InputError(
            key, "is a table", takes=f"one of its keys, as {key}.{next(iter(inner.known_keys()))}"
        )
    return field


def number_of(field: FieldInfo) -> Quantity | Count | None:
    """What a key takes that is a number; None of a text, a list or a choice.

    Examples
    --------
    >>> number_of(input_field("contact.entrainment_speed")).unit
    'm/s'
    """
    if get_origin(field.annotation) is tuple:
        return None
    parts = [field, *(part for part in get_args(field.annotation) if hasattr(part, "__metadata__"))]
    for part in parts:
        for item in getattr(part, "__metadata__", ()) or getattr(part, "metadata", ()):
            if isinstance(item, Quantity | Count):
                return item
    return None


def kind_of(key: str) -> Quantity | Count | None:
    """What a dotted key takes where it is a number of the case, None otherwise.

    Examples
    --------
    >>> kind_of("contact.load_per_length").unit
    'N/m'
    >>> kind_of("film.minimum_thickness") is None
    True
    """
    try:
        return number_of(input_field(key))
    except InputError:
        return None
