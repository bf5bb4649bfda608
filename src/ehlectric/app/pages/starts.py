"""Inputs with which the pages begin: the examples, so that the first answer is that of a documented case."""

from __future__ import annotations

import tomllib
from functools import cache

from ehlectric.app.fields.rules import changed
from ehlectric.app.inputs import Inputs
from ehlectric.runs.example_files import example_text


@cache
def start(name: str) -> Inputs:
    """Inputs of an example."""
    return Inputs(tomllib.loads(example_text(name)))


BEARING = start("bearing_6208")

# The way to the films stands in the table of the drive, where the form has it for both bearings.
DRIVE = start("drive").changed({"drive_end.contacts": None, "drive.contacts": "atlas"})


# Tables of a bearing that a drive does not take over: of its title and its margin, and of the motor, whose
# capacitances go into the circuit.
_NOT_OF_DRIVES = ("title", "contacts", "ranges", "motor")
_OF_MOTOR = {
    "motor.winding_rotor_capacitance": "circuit.winding_rotor_capacitance",
    "motor.rotor_frame_capacitance": "circuit.rotor_frame_capacitance",
    "motor.switching_frequency": "source.switching_frequency",
    "motor.rise_time": "source.rise_time",
}


def drive_with(bearing: Inputs) -> Inputs:
    """Drive of the example with a bearing at both ends, at its speed and temperature."""
    own = bearing.changed({**dict.fromkeys(_NOT_OF_DRIVES), "discharge.peak_current": None})
    strength = {} if own.value("discharge") else _STRENGTH
    changes = {
        "drive_end": dict(own.changed(strength).table),
        "drive.speed": bearing.value("bearing.inner_speed"),
        "drive.temperature": bearing.value("bearing.temperature"),
        "title": bearing.value("title"),
    }
    motor = {theirs: bearing.value(key) for key, theirs in _OF_MOTOR.items()}
    given = {key: value for key, value in motor.items() if value is not None}
    return changed(DRIVE, changes | given)


# Strength of the first answers, that of the bearing: an assumption.
_STRENGTH = {"discharge.dielectric_strength": "15 V/um"}

# Domain of the point contact, larger than that of the example, so that the film has no warning about it, also
# with the oil and the speed of the line contact with which the page begins.
_POINT_DOMAIN = {"grid.inlet": -6.0, "grid.side": 5.0}


def contact_start(geometry: str) -> Inputs:
    """Inputs with which the page of a line contact or of a point contact begins, with an assumed strength."""
    if geometry == "point":
        return start("ball_contact").changed({**_STRENGTH, **_POINT_DOMAIN})
    return start("line_contact").changed(_STRENGTH)


SWEEP = Inputs(
    {
        "case": dict(BEARING.changed({"contacts": "atlas"}).table),
        "vary": {
            "bearing": {
                "inner_speed": {"from": "300 rpm", "to": "6000 rpm", "count": 8, "spacing": "log"},
                "radial_load": {"from": "500 N", "to": "8000 N", "count": 8},
            }
        },
    }
)
