"""Bearings of a drive in its inputs: fields and inputs of a bearing under the table of each end."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from ehlectric.app.fields.field import Field, Group, Way, When
from ehlectric.app.inputs import Inputs
from ehlectric.quantities.inputs import ENDS

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
    """Field of the bearing at an end of a drive.

    Parameters
    ----------
    field : Field
        Field of a bearing.
    end : str
        Table of the end.
    when : callable, optional
        Whether it belongs to the inputs of a drive; that of the field for its bearing if not given.
    strict : bool, optional
        In place of that of the field.
    """
    own = field.when
    return replace(
        field,
        key=f"{end}.{field.key}",
        ways=tuple(_way_at(way, end) for way in field.ways),
        when=when or (lambda inputs: own(bearing_at(inputs, end))),
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


def _way_at(way: Way, end: str) -> Way:
    return replace(way, changes=at_end(way.changes, end), key=f"{end}.{way.key}" if way.key else "")
