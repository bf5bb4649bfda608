"""Inputs of a case by dotted key: field, number type, unit, and their entry in the book of inputs."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from functools import cache, lru_cache
from typing import Any, get_args, get_origin

from pydantic.fields import FieldInfo

from ehlectric.cases.amounts import Amount, AmountOrWord, Amounts, Count
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.cases.case import Case
from ehlectric.cases.oil_inputs import law_parameters
from ehlectric.cases.table import (
    Table,
    advice_for,
    annotation_of,
    any_of,
    item_of,
    meant,
    name_key,
    nearest,
    number_of,
    table_of,
)
from ehlectric.errors import InputError
from ehlectric.quantities.inputs import (
    BOTH,
    ENDS,
    end_and_key,
    input_at,
    inputs,
    plain_text,
    table_and_key,
    with_end,
)
from ehlectric.quantities.quantity import Quantity
from ehlectric.quantities.units import printed

# Tables and keys that only a bearing file has, and the duty cycle with equal keys in files of all kinds.
_OF_BEARINGS = ("bearing", "motor", "contacts", "duty")

# Tables that only a drive file has, in addition to the tables of its bearings.
_OF_DRIVES = ("drive", "source", "circuit", "breakdown", "rotor", "force")


def _tables_in(model: type[Table]) -> Iterator[type[Table]]:
    yield model
    for field in model.known_keys().values():
        if inner := table_of(_item_of(field.annotation)):
            yield from _tables_in(inner)


def _item_of(annotation: Any) -> Any:
    """Annotation of the values of tables by a name of the user; otherwise the given annotation."""
    return get_args(annotation)[1] if get_origin(annotation) is dict else annotation


def _files() -> Iterator[type[Table]]:
    """Files of all kinds. Gear pairs and drives, which few commands need, are imported last."""
    yield from (Case, BearingCase)
    from ehlectric.cases.gear_case import GearCase

    yield GearCase
    from ehlectric.cases.drive_case import DriveCase

    yield DriveCase
    from ehlectric.cases.axle_case import AxleCase

    yield AxleCase


@cache
def tables_of_files() -> Mapping[str, type[Table]]:
    """Tables of case, bearing, gear, drive and axle files by their names in the book of inputs.

    The table of sweep files is in the package sweep.
    """
    return {table.BOOK: table for file in reversed([*_files()]) for table in _tables_in(file)}


def input_of(key: str) -> Quantity | None:
    """Label, symbol, meaning and SI unit of a dotted key; None where no file has this key.

    Parameters of laws that are not in the book of inputs are described with their law.

    Examples
    --------
    >>> input_of("bearing.radial_load").unit, input_of("lubricant.roelands_pressure").label
    ('N', "Roelands' constant")
    """
    entry = input_at(key) or _entry(*table_and_key(key)[:2])
    # A key that is a number or a word has no annotation with a unit.
    return None if entry is None else replace(entry, unit=unit_of(_numbered(key)) or entry.unit)


def _entry(table: str, name: str) -> Quantity | None:
    """Entry of a key of a table: from the book, or from the law whose parameter it is."""
    parameter = law_parameters().get(name) if table == "lubricant" else None
    return inputs().get(table, {}).get(name) or (None if parameter is None else parameter.quantity)


def descriptions(table: str) -> dict[str, str]:
    """Return what the keys of a table of ``tables_of_files``, or of "sweep", mean, in Markdown.

    Examples
    --------
    >>> descriptions("contact")["load"], descriptions("contact")["reduced_radius"]
    ('load of a point contact', 'reduced radius $R$ of a line contact, with $1/R = 1/R_1 + 1/R_2$')
    """
    if table not in inputs():
        raise InputError.unknown(table, nearest(table, inputs()))
    laws = law_parameters() if table == "lubricant" else {}
    entries = {name: parameter.quantity for name, parameter in laws.items()} | dict(inputs()[table])
    return {name: entry.meaning for name, entry in entries.items()}


def describe(key: str) -> str:
    """Return the meaning of a key of a case, bearing or sweep file as plain text, with the SI unit.

    The unit follows the first sentence, in brackets, as in "load of a point contact [N]". Raises InputError
    if no file contains the key; the error names the nearest known key.

    Examples
    --------
    >>> describe("contact.load"), describe("roughness.1.hurst")
    ('load of a point contact [N]', 'Hurst exponent of a self-affine surface')
    >>> describe("bearing.radial_load")
    'radial load F_r: force on the inner ring perpendicular to the axis [N]'
    """
    table, name, _ = table_and_key(key)
    if not table or name not in (descriptions(table) if table in inputs() else {}):
        every = [f"{book}.{name}" for book in inputs() for name in descriptions(book)]
        within = [known for known in every if known.startswith(f"{key}.")]
        raise InputError.unknown(key, nearest(key, within or every))
    unit, text = unit_of(_numbered(key)), phrase(table, name)
    first, stop, others = text.partition(". ")
    return f"{first} [{printed(unit)}]{stop}{others}" if unit else text


def phrase(table: str, key: str) -> str:
    """Return the meaning of a key of a table as plain text.

    Examples
    --------
    >>> phrase("bearing", "radial_load"), phrase("contact.body", "youngs_modulus")
    ('radial load F_r: force on the inner ring perpendicular to the axis', "Young's modulus E of the body")
    """
    return plain_text(descriptions(table)[key])


def _numbered(key: str) -> str:
    """Key with the number of a rough surface, which a description does not need."""
    first, _, rest = key.partition(".")
    return f"{first}.1.{rest}" if first == "roughness" and not rest[:1].isdecimal() else key


def input_field(key: str) -> FieldInfo:
    """Field of an input in its table, with its annotation and default. Raises InputError if the key is
    unknown or is a table; the message names the nearest known key, or a key of the table.

    Examples
    --------
    >>> input_field("contact.entrainment_speed").is_required()
    False
    """
    end, leaf = end_and_key(key)
    names = leaf.split(".")
    model = BearingCase if end in (*ENDS, BOTH) else _model_of(*names[:2])
    if names[0] == "axle":
        names = names[1:]
    within: list[str] = []
    if names[0] == "roughness":
        if len(names) < 3 or not names[1].isdecimal():
            raise InputError(
                key, "is a list of tables", takes="a key of one of them, as roughness.1.rescale_rq"
            )
        within, names = names[1:2], [names[0], *names[2:]]
        if int(within[0]) == 0:
            first = ".".join(["roughness", "1", *names[1:]])
            raise InputError(
                key, got="the number 0", takes=f"numbers of rough surfaces from 1, as in {first}"
            )
    field: FieldInfo | None = None
    inner: Any = model
    for name in names:
        field = item_of(field, name) if inner is None else inner.known_keys().get(name)
        if field is None:
            if advice := advice_for(leaf, model):
                raise InputError.worded(key, f"unknown key; {advice}")
            similar = [with_end(end, _with_number(name, within)) for name in meant(".".join(names), model)]
            raise InputError.unknown(key, any_of(similar))
        inner = table_of(field.annotation)
    if field is None or inner is not None:
        raise InputError(
            key, "is a table", takes=f"one of its keys, as {key}.{next(iter(inner.known_keys()))}"
        )
    return field


def key_of_names(key: str, values: Any) -> str:
    """Dotted key of values of many points: for names of the library that stand for a table, the key in it.

    Examples
    --------
    >>> key_of_names("bearings.lubricant", ["paper", "fva-3"]), key_of_names("lubricant", [1.0])
    ('bearings.lubricant.base', 'lubricant')
    """
    listed = isinstance(values, list | tuple) or getattr(values, "ndim", 0) == 1
    if not listed or not all(isinstance(value, str) for value in values):
        return key
    end, inner = end_and_key(key)
    name = name_key(inner, BearingCase if end in (*ENDS, BOTH) else _model_of(inner.partition(".")[0]))
    return with_end(end, name)


def _with_number(key: str, within: list[str]) -> str:
    """Known key with the number of its rough surface, if it is one of a rough surface."""
    first, dot, rest = key.partition(".")
    return ".".join([first, *within, rest]) if first == "roughness" and dot else key


def _model_of(name: str, inner: str = "") -> type[Table]:
    """Case that has a table or key of this name, with this key in the table."""
    if name in _OF_BEARINGS:
        return BearingCase
    if name == "gear":
        from ehlectric.cases.gear_case import GearCase

        return GearCase
    if name not in (*_OF_DRIVES, *ENDS, "axle"):
        return Case
    from ehlectric.cases.drive_case import DriveCase
    from ehlectric.cases.drive_inputs import Operation

    if name == "axle" or (name == "drive" and inner and inner not in Operation.known_keys()):
        from ehlectric.cases.axle_case import AxleCase
        from ehlectric.cases.axle_inputs import AxleOperation

        # A key of axle files in a table that drive files also have.
        return AxleCase if name == "axle" or inner in AxleOperation.known_keys() else DriveCase
    return DriveCase


def is_of_drive(key: str) -> bool:
    """Whether a dotted key is in a table that only drive files have.

    Examples
    --------
    >>> is_of_drive("source.dc_link"), is_of_drive("bearings.bearing.radial_load")
    (True, True)
    >>> is_of_drive("bearing.radial_load")
    False
    """
    return key.partition(".")[0] in (*_OF_DRIVES, *ENDS, BOTH)


def is_of_axle(key: str) -> bool:
    """Whether a dotted key is a number or a word of an axle that stands in no list.

    Examples
    --------
    >>> is_of_axle("drive.torque"), is_of_axle("lubricant.base"), is_of_axle("link"), is_of_axle("motor")
    (True, True, False, False)
    """
    from ehlectric.cases.axle_case import AxleCase

    name, _, inner = key.partition(".")
    field = AxleCase.known_keys().get(name)
    table = None if field is None else table_of(field.annotation)
    return inner.partition(".")[0] in (() if table is None else table.known_keys())


def of_both_ends(key: str) -> tuple[str, ...]:
    """Dotted keys of a case that a key stands for: two for a key of both bearings of a drive, else itself.

    Examples
    --------
    >>> of_both_ends("bearings.bearing.temperature")
    ('drive_end.bearing.temperature', 'non_drive_end.bearing.temperature')
    """
    end, inner = end_and_key(key)
    return tuple(f"{name}.{inner}" for name in ENDS) if end == BOTH else (key,)


def _in_a_table(key: str) -> bool:
    """Whether a key begins with the name of a table; the search for the nearest key takes milliseconds."""
    end, inner = end_and_key(key)
    name = inner.partition(".")[0]
    if end in (*ENDS, BOTH):
        return name in BearingCase.known_keys()
    return name == "axle" or any(name in file.known_keys() for file in _files())


def unit_of(key: str) -> str:
    """SI unit of an input, as pint writes it.

    It is empty for a dimensionless number, a text or an unknown key.

    Examples
    --------
    >>> unit_of("contact.load_per_length"), unit_of("discharge.strength_table.strength.0")
    ('N/m', 'V/m')
    """
    if not _in_a_table(key):
        return ""
    try:
        name = key.rstrip("0123456789").rstrip(".") if key[-2:-1] == "." else key
        annotation = annotation_of(input_field(name))
    except InputError:
        return ""
    each = annotation.each if isinstance(annotation, Amounts | AmountOrWord) else annotation
    return each.unit if isinstance(each, Amount) else ""


def kind_of(key: str) -> Amount | Count | None:
    """Quantity or count of a dotted key that is a number of the case; None for every other key.

    Examples
    --------
    >>> kind_of("contact.load_per_length").unit
    'N/m'
    >>> kind_of("film.minimum_thickness") is None
    True
    """
    if not _in_a_table(key):
        return None
    try:
        return number_of(input_field(key))
    except InputError:
        return None


# Keys that are remembered as quantities or none: more than files have.
_REMEMBERED = 4096


@lru_cache(maxsize=_REMEMBERED)
def is_quantity(key: str) -> bool:
    """Whether a dotted key is a number with a unit or without one, of which points may have different values.

    Examples
    --------
    >>> is_quantity("bearing.radial_load"), is_quantity("bearing.elements"), is_quantity("bearing.kind")
    (True, False, False)
    """
    return isinstance(kind_of(key), Amount)
