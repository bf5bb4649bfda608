"""Values that hold where the inputs give none, and the bearings and gear pairs in the inputs of drives and
axles.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from ehlectric.app.catalogue import bearing, coating, oil
from ehlectric.app.form_fields.field import Alternative, Field, Group, When
from ehlectric.app.page_inputs import Inputs
from ehlectric.cases.defaults import BOUNDARY_FILM, DEFAULT_ERROR
from ehlectric.quantities.inputs import ENDS, attributes, key_of_list

DRIVE_END, NON_DRIVE_END = ENDS


# Bearing or gear pair of an axle, by its number, and the key in it.
_BEARING = re.compile(r"(bearing\.\d+)\.(.+)")
_PAIR = re.compile(r"(mesh\.\d+\.pair)\.(.+)")


def end_and_key(key: str) -> tuple[str, str]:
    """End in a key of a drive file, and the key in its bearing file. Bearings and gear pairs of an axle are
    also ends. Any other key has no end.

    Examples
    --------
    >>> end_and_key("drive_end.bearing.base"), end_and_key("bearing.base"), end_and_key("drive_end")
    (('drive_end', 'bearing.base'), ('', 'bearing.base'), ('', 'drive_end'))
    >>> end_and_key("bearing.3.base"), end_and_key("mesh.1.pair.gear.hand")
    (('bearing.3', 'bearing.base'), ('mesh.1.pair', 'gear.hand'))
    """
    first, _, rest = key.partition(".")
    if first in ENDS and rest:
        return first, rest
    if (mounted := _BEARING.fullmatch(key)) is not None:
        return mounted[1], f"bearing.{mounted[2]}"
    return ("", key) if (pair := _PAIR.fullmatch(key)) is None else (pair[1], pair[2])


def key_at(end: str, key: str) -> str:
    """Key of a drive or an axle from an end and the key of its file, as ``end_and_key`` separates them.

    Examples
    --------
    >>> key_at("drive_end", "bearing.base"), key_at("bearing.3", "bearing.base"), key_at("", "title")
    ('drive_end.bearing.base', 'bearing.3.base', 'title')
    """
    if end.startswith("bearing."):
        return f"{end}.{key.removeprefix('bearing.')}"
    return f"{end}.{key}" if end else key


# List of two values of a mesh or a link, and the number of a value.
_LIST = re.compile(r"((?:mesh\.\d+\.(?:gears|at))|(?:link\.\d+\.between))\.[12]")


def list_of(key: str) -> str:
    """Key of a list from the key of one of its values; any other key itself.

    Examples
    --------
    >>> list_of("gear.teeth.2"), list_of("mesh.1.pair.gear.teeth.2"), list_of("mesh.1.at.2"), list_of("title")
    ('gear.teeth', 'mesh.1.pair.gear.teeth', 'mesh.1.at', 'title')
    """
    end, inner = end_and_key(key)
    listed = _LIST.fullmatch(key)
    return listed[1] if listed is not None else key_at(end, key_of_list(inner))


def bearing_at(inputs: Inputs, end: str) -> Inputs:
    """Inputs of the bearing or the gear pair at an end; the inputs themselves without an end."""
    table = inputs.value(end) if end else inputs.table
    inner = table if isinstance(table, Mapping) else {}
    return Inputs({"bearing": inner} if end.startswith("bearing.") else inner)


def with_bearing_at(inputs: Inputs, end: str, local: Inputs) -> Inputs:
    """Inputs with other inputs of a bearing or a gear pair at an end; see ``bearing_at``."""
    table = local.value("bearing") if end.startswith("bearing.") else dict(local.table)
    return inputs.changed({end: table or ({} if "." in end else None)})


def at_end(changes: Mapping[str, Any], end: str) -> dict[str, Any]:
    """Changes of a bearing as changes of the drive with it at an end; unchanged without an end."""
    return {key_at(end, key): value for key, value in changes.items()}


def field_at(field: Field, end: str, *, when: When | None = None, strict: bool | None = None) -> Field:
    """Field of the bearing at an end of a drive, with its own condition unless ``when`` is given."""
    shown_when = field.when
    return replace(
        field,
        key=key_at(end, field.key),
        alternatives=tuple(_alternative_at(alternative, end) for alternative in field.alternatives),
        when=when or (lambda inputs: shown_when(bearing_at(inputs, end))),
        strict=field.strict if strict is None else strict,
    )


def group_at(group: Group, end: str, title: str, fields: tuple[Field, ...], **more: Any) -> Group:
    """Group of fields of the bearing at an end of a drive."""
    return replace(
        group,
        title=title,
        fields=fields,
        table=f"{end}.{group.table}" if group.table else "",
        tells=lambda inputs: group.tells(bearing_at(inputs, end)),
        **more,
    )


def _alternative_at(alternative: Alternative, end: str) -> Alternative:
    return replace(
        alternative,
        changes=at_end(alternative.changes, end),
        key=key_at(end, alternative.key) if alternative.key else "",
    )


# Values of a library's oil that do not hold with a data sheet, as the cases resolve it.
_NOT_WITH_SHEET = (
    *("lubricant.viscosity", "lubricant.pressure_viscosity_coefficient", "lubricant.density"),
    "lubricant.atmospheric_law",
)

_LIBRARY = {"bearing.coating": coating, "bearing": bearing, "lubricant": oil}


def default_of(inputs: Inputs, key: str) -> Any:
    """Value that holds where the inputs do not give the key; None where there is none.

    Examples
    --------
    >>> default_of(Inputs({"bearing": {"base": "6208"}}), "bearing.bore")
    '40 mm'
    """
    if key == "drive.contacts":
        return inputs.value("drive_end.contacts") or "solved"
    end, key = end_and_key(key)
    all_bearings = inputs.value("bearings") if end.startswith("bearing.") else None
    inputs = bearing_at(inputs, end)
    if isinstance(all_bearings, Mapping) and (name := key.removeprefix("bearing.")) in all_bearings:
        return all_bearings[name]
    if key == "grid.error":
        error = DEFAULT_ERROR[inputs.value("contact.geometry") == "point"]
        return f"{100.0 * error:g} %"
    if key in ("gear.flank_ra.2", "gear.tip_relief.2"):
        return inputs.value(f"{key[:-1]}1")
    if key == "contact.boundary_film":
        return f"{1e9 * BOUNDARY_FILM:g} nm"
    if key in _NOT_WITH_SHEET and inputs.value("lubricant.temperature") is not None:
        return None
    if key == "lubricant.roelands_z" and inputs.value("lubricant.temperature.base_oil") is not None:
        return None
    table = next((table for table in _LIBRARY if key.startswith(f"{table}.")), None)
    known = {} if table is None else _LIBRARY[table](str(inputs.value(f"{table}.base")))
    return known.get(key.removeprefix(f"{table}."), attributes("default").get(key))
