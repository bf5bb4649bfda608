"""Values that hold where the inputs give none, and the bearings at both ends of a drive in its inputs."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from ehlectric.app.catalogue import bearing, coating, oil
from ehlectric.app.form_fields.field import Alternative, Field, Group, When
from ehlectric.app.page_inputs import Inputs
from ehlectric.cases.defaults import BOUNDARY_FILM, DEFAULT_ERROR
from ehlectric.quantities.inputs import ENDS, attributes

DRIVE_END, NON_DRIVE_END = ENDS


def end_and_key(key: str) -> tuple[str, str]:
    """End of a key of a drive file and the key of its bearing file; no end for any other key.

    Examples
    --------
    >>> end_and_key("drive_end.bearing.base"), end_and_key("bearing.base"), end_and_key("drive_end")
    (('drive_end', 'bearing.base'), ('', 'bearing.base'), ('', 'drive_end'))
    """
    first, _, rest = key.partition(".")
    return (first, rest) if first in ENDS and rest else ("", key)


def bearing_at(inputs: Inputs, end: str) -> Inputs:
    """Inputs of the bearing at an end of a drive; the inputs themselves without an end."""
    table = inputs.value(end) if end else inputs.table
    return Inputs(table if isinstance(table, Mapping) else {})


def at_end(changes: Mapping[str, Any], end: str) -> dict[str, Any]:
    """Changes of a bearing as changes of the drive with it at an end; unchanged without an end."""
    return {f"{end}.{key}" if end else key: value for key, value in changes.items()}


def field_at(field: Field, end: str, *, when: When | None = None, strict: bool | None = None) -> Field:
    """Field of the bearing at an end of a drive, with its own condition unless ``when`` is given."""
    shown_when = field.when
    return replace(
        field,
        key=f"{end}.{field.key}",
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
        key=f"{end}.{alternative.key}" if alternative.key else "",
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
    inputs = bearing_at(inputs, end)
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
