"""Fields of the page of a drive: source, circuit, arc, and the bearings at both ends."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

from ehlectric.app.fields.bearing import (
    BREAKDOWN,
    CLEARANCE,
    COATING,
    FILM,
    GEOMETRY,
    OIL,
    OPERATION,
    REPORT,
    SUMMITS,
)
from ehlectric.app.fields.ends import DRIVE_END, NON_DRIVE_END, field_at, group_at
from ehlectric.app.fields.field import Field, Group, Way, When, fields_of
from ehlectric.app.fields.source import SOURCE
from ehlectric.app.inputs import Inputs
from ehlectric.quantities.inputs import form

_ASSUMED = "The first values are assumptions: replace them with your own."


def _machine(inputs: Inputs) -> bool:
    return inputs.value("circuit.machine") is not None


def _given(inputs: Inputs) -> bool:
    return not _machine(inputs)


def _by_current(inputs: Inputs) -> bool:
    return inputs.value("breakdown.extinction_current") is not None


def _by_voltage(inputs: Inputs) -> bool:
    return not _by_current(inputs)


# Geometry of the machine of the guide.
_GEOMETRY = {
    "stack_length": "120 mm",
    "bore_diameter": "110 mm",
    "air_gap": "0.5 mm",
    "slots": 36,
    "slot_opening": "3 mm",
    "copper_depth": "2 mm",
    "slot_permittivity": 2,
    "liner_width": "50 mm",
    "liner_thickness": "0.3 mm",
    "liner_permittivity": 3.5,
}
_CAPACITANCES = {
    "circuit.winding_rotor_capacitance": "50 pF",
    "circuit.rotor_frame_capacitance": "500 pF",
    "circuit.winding_frame_capacitance": "5 nF",
}

_WAYS = {
    "circuit.winding_rotor_capacitance": Field(
        "circuit.way",
        "Capacitances",
        kind="ways",
        ways=(
            Way(
                "From the geometry of the machine",
                {**dict.fromkeys(_CAPACITANCES), "circuit.machine": _GEOMETRY},
                "circuit.machine",
            ),
            Way("Given, as measured", {**_CAPACITANCES, "circuit.machine": None}),
        ),
    ),
    "breakdown.extinction_current": Field(
        "breakdown.extinction_way",
        "The arc goes out",
        kind="ways",
        ways=(
            Way("Below a current", {"breakdown.extinction_current": "10 mA"}, "breakdown.extinction_current"),
            Way("Below a voltage", {"breakdown.extinction_voltage": "0.1 V"}),
        ),
    ),
}
_SHOWN = {
    **{key: {"when": _given} for key in _CAPACITANCES},
    "breakdown.extinction_current": {"when": _by_current},
    "breakdown.extinction_voltage": {"when": _by_voltage},
}


def _group(title: str, **more: Any) -> Group:
    return Group(title, fields_of(form("drive")[title], _SHOWN, _WAYS), **more)


DRIVE = _group("Operation")
MACHINE = _group("Machine", note=_ASSUMED)
STATOR = _group(
    "Geometry of the machine",
    note=f"{_ASSUMED} End windings are left out, and add to all capacitances.",
    when=_machine,
)
PATHS = _group("Ring, choke and ground", opened=False)
ARC = _group("Arc of a discharge", note="There is no model of the arc: these values are assumptions.")

# Keys of a bearing that the table "drive" replaces, by those of the drive.
_REPLACED = {"bearing.inner_speed": "drive.speed", "bearing.temperature": "drive.temperature"}


def _open(key: str) -> When:
    """Whether the drive leaves a key to its bearings."""
    return lambda inputs: inputs.value(key) is None


def _fields_at(group: Group, end: str) -> Iterator[Field]:
    for field in group.fields:
        if field.key in _REPLACED:
            yield field_at(field, end, when=_open(_REPLACED[field.key]), strict=True)
        elif field.key != "discharge.peak_current":
            # The simulation computes the current of a discharge.
            yield field_at(field, end)


# Groups of a bearing, with their titles in a drive. The capacitances of the motor are in the circuit.
_OF_BEARING = (
    (GEOMETRY, "bearing"),
    (OPERATION, "load"),
    (OIL, "oil"),
    (FILM, "films"),
    (CLEARANCE, "clearance"),
    (BREAKDOWN, "strength of the oil"),
    (COATING, "coating"),
    (SUMMITS, "summits"),
)
_OPENED = (GEOMETRY, OPERATION)


def _bearing(end: str, name: str) -> Iterator[Group]:
    """Groups of the bearing at an end; a drive needs a strength, so that its group is always on."""
    for group, words in _OF_BEARING:
        title, fields = f"{name}: {words}", tuple(_fields_at(group, end))
        opened = group in _OPENED and end == DRIVE_END
        found = group_at(group, end, title, fields, opened=opened)
        if group is BREAKDOWN:
            found = Group(title, fields, note=group.note, opened=False)
        yield found if end == DRIVE_END else _only_own(found)


def _own(inputs: Inputs) -> bool:
    return inputs.value(NON_DRIVE_END) is not None


def _only_own(group: Group) -> Group:
    """Group that is there only where the non-drive end has a bearing of its own."""
    return replace(group, when=_own)


def _which(inputs: Inputs) -> str:
    return "" if _own(inputs) else "The bearing at the non-drive end is the same as at the drive end."


OTHER = Group(
    "Another bearing at the non-drive end",
    (),
    table=NON_DRIVE_END,
    copies=DRIVE_END,
    tells=_which,
    opened=False,
)

DRIVE_GROUPS = (
    DRIVE,
    SOURCE,
    MACHINE,
    STATOR,
    PATHS,
    ARC,
    *_bearing(DRIVE_END, "Drive end"),
    OTHER,
    *_bearing(NON_DRIVE_END, "Non-drive end"),
    REPORT,
)
