"""Fields of the page of a drive: source, circuit, arc, and the bearings at both ends."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from ehlectric.app.fields.bearing import (
    BREAKDOWN,
    CLEARANCE,
    COATING,
    FILM,
    GEOMETRY,
    OPERATION,
    REPORT,
    SUMMITS,
)
from ehlectric.app.fields.ends import DRIVE_END, NON_DRIVE_END, field_at, group_at
from ehlectric.app.fields.field import Field, Group, Way, When
from ehlectric.app.fields.oil import OIL
from ehlectric.app.fields.source import SOURCE
from ehlectric.app.inputs import Inputs

_ASSUMED = "The first values are assumptions: replace them with your own."


def _number(key: str, label: str, unit: str, ends: tuple[float, float], **more: object) -> Field:
    """Field of a number with the ends of its slider."""
    return Field(key, label, unit, *ends, **more)  # type: ignore[arg-type]


def _machine(inputs: Inputs) -> bool:
    return inputs.value("circuit.machine") is not None


def _given(inputs: Inputs) -> bool:
    return not _machine(inputs)


def _by_current(inputs: Inputs) -> bool:
    return inputs.value("breakdown.extinction_current") is not None


def _by_voltage(inputs: Inputs) -> bool:
    return not _by_current(inputs)


def _no(_: Inputs) -> bool:
    return False


_DEGREES = (20.0, 120.0)

DRIVE = Group(
    "Operation",
    (
        _number("drive.speed", "Speed of the rotor", "rpm", (50.0, 20_000.0), log=True),
        _number("drive.temperature", "Temperature of the oil", "degC", _DEGREES),
        _number("drive.duration", "Simulated time", "s", (0.01, 10.0), log=True),
        Field("drive.contacts", "Films", kind="choice", choices=("atlas", "formula", "solved")),
        Field("drive.seed", "Seed of the random numbers", low=0, high=100, kind="count", optional=True),
    ),
)

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

MACHINE = Group(
    "Machine",
    (
        Field(
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
        _number(
            "circuit.winding_rotor_capacitance",
            "Winding to rotor",
            "pF",
            (1.0, 1000.0),
            log=True,
            when=_given,
        ),
        _number(
            "circuit.rotor_frame_capacitance", "Rotor to frame", "pF", (10.0, 20_000.0), log=True, when=_given
        ),
        _number(
            "circuit.winding_frame_capacitance", "Winding to frame", "nF", (0.1, 100.0), log=True, when=_given
        ),
    ),
    note=_ASSUMED,
)

STATOR = Group(
    "Geometry of the machine",
    (
        _number("circuit.machine.stack_length", "Length of the stack", "mm", (20.0, 1000.0), log=True),
        _number("circuit.machine.bore_diameter", "Bore of the stator", "mm", (30.0, 1000.0), log=True),
        _number("circuit.machine.air_gap", "Air gap", "mm", (0.2, 5.0), log=True),
        Field("circuit.machine.slots", "Slots", low=6, high=120, kind="count"),
        _number("circuit.machine.slot_opening", "Opening of a slot", "mm", (0.5, 10.0), log=True),
        _number("circuit.machine.copper_depth", "Depth of the copper", "mm", (0.2, 10.0), log=True),
        _number("circuit.machine.slot_permittivity", "Permittivity above the copper", "", (1.0, 10.0)),
        _number("circuit.machine.liner_width", "Length of the slot liner", "mm", (5.0, 300.0), log=True),
        _number("circuit.machine.liner_thickness", "Thickness of the liner", "mm", (0.05, 2.0), log=True),
        _number("circuit.machine.liner_permittivity", "Permittivity of the liner", "", (1.0, 10.0)),
    ),
    note=f"{_ASSUMED} End windings are left out, and add to all capacitances.",
    when=_machine,
)

PATHS = Group(
    "Ring, choke and ground",
    (
        _number("circuit.grounding_ring_resistance", "Grounding ring or brush", "ohm", (0.01, 1e4), log=True),
        _number(
            "circuit.common_mode_inductance", "Common-mode choke or cable", "mH", (0.001, 100.0), log=True
        ),
        _number("circuit.common_mode_resistance", "Resistance in series with it", "ohm", (0.0, 100.0)),
        _number("circuit.cable_capacitance", "Cable to earth", "nF", (0.1, 100.0), log=True),
        _number("circuit.frame_earth_capacitance", "Frame to earth", "nF", (0.01, 100.0), log=True),
        _number("circuit.ground_inductance", "Ground connection", "uH", (0.01, 100.0), log=True),
        _number("circuit.ground_resistance", "Resistance in series with it", "ohm", (0.0, 10.0)),
    ),
    opened=False,
)

ARC = Group(
    "Arc of a discharge",
    (
        _number("breakdown.arc_resistance", "Resistance of the arc", "ohm", (0.1, 1000.0), log=True),
        Field(
            "breakdown.extinction_way",
            "The arc goes out",
            kind="ways",
            ways=(
                Way(
                    "Below a current",
                    {"breakdown.extinction_current": "10 mA"},
                    "breakdown.extinction_current",
                ),
                Way("Below a voltage", {"breakdown.extinction_voltage": "0.1 V"}),
            ),
        ),
        _number(
            "breakdown.extinction_current",
            "Current at which it goes out",
            "mA",
            (0.1, 1000.0),
            log=True,
            when=_by_current,
        ),
        _number(
            "breakdown.extinction_voltage",
            "Voltage at which it goes out",
            "V",
            (0.01, 10.0),
            log=True,
            when=_by_voltage,
        ),
        _number("breakdown.recovery_time", "The film insulates again after", "ns", (0.0, 2000.0)),
        _number("breakdown.weibull_shape", "Weibull shape of the strength", "", (1.0, 50.0), log=True),
        _number(
            "breakdown.renewal_time",
            "Other oil is in the contacts after",
            "ms",
            (0.01, 100.0),
            log=True,
            optional=True,
        ),
        _number(
            "breakdown.touch_time",
            "Asperities touch for",
            "us",
            (0.1, 1000.0),
            log=True,
            optional=True,
        ),
    ),
    note="There is no model of the arc: these values are assumptions.",
)

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
