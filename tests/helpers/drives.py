"""Drives for tests: bearings as plain elements of a circuit, a source, and a march through it."""

import math

import numpy as np

from ehlectric.bearing.circuit import Path
from ehlectric.cases.drive_case import DriveCase
from ehlectric.cases.drive_inputs import Breakdown, Circuit
from ehlectric.drive.discharges.films_and_source import Measuring, Segments
from ehlectric.drive.drive_bearings import BearingElement
from ehlectric.drive.films_in_time import NetworkInTime, films_of_ends
from ehlectric.drive.network import machine
from tests.helpers.places import EXAMPLES

MOTOR = {
    "winding_rotor_capacitance": "50 pF",
    "rotor_frame_capacitance": "500 pF",
    "winding_frame_capacitance": "5 nF",
}
ARC = {"arc_resistance": 10.0, "extinction_voltage": 0.5, "recovery_time": 0.0}


def small_drive(**changes):
    """The example for a few periods of its carrier, with contacts by formula and without remedies."""
    drive = DriveCase.from_toml(EXAMPLES / "drive.toml")
    quick = {"drive.contacts": "formula", "drive.duration": "3 ms", "drive.temperature": "40 degC"}
    return drive.replace({"remedies": []} | quick | changes)


def element(capacitance=300e-12, *, breakdown=math.inf, conductance=0.0, shape=math.inf, step=math.inf,
            path=None, touching=0.0, touch_resistance=math.inf, transit=1e-4):  # fmt: skip
    """Bearing of given capacitance and breakdown voltage at its positions."""
    places = np.atleast_1d(np.array(capacitance, dtype=float))
    return BearingElement(
        capacitance=places,
        conductance=conductance,
        breakdown=np.broadcast_to(np.array(breakdown, dtype=float), places.shape).copy(),
        shape=shape,
        step=step,
        path=path or Path(),
        touching=touching,
        touch_resistance=touch_resistance,
        hertz_area=1e-6,
        largest_area=1e-7,
        transit=transit,
    )


def motor(**keys):
    """Table ``circuit``."""
    return Circuit.from_dict(MOTOR | keys)


def arc(**keys):
    """Table ``breakdown``."""
    return Breakdown.from_dict(ARC | keys)


def square(voltage, period, rise, count):
    """Square wave that begins low: ``count`` periods, each with an edge up and an edge down."""
    flat = 0.5 * period - rise
    return Segments(
        np.tile([rise, flat, rise, flat], count),
        np.tile([-voltage, voltage, voltage, -voltage], count),
        np.tile([2 * voltage / rise, 0.0, -2 * voltage / rise, 0.0], count),
        np.zeros(4 * count, dtype=complex),
    )


def from_rest(segments, rise):
    """The same source after an edge from zero, so that no film has a voltage at the start."""
    first = float(segments.level[0])
    begin = (np.array([rise]), np.zeros(1), np.array([first / rise]), np.zeros(1, dtype=complex))
    return Segments(*(np.concatenate(pair) for pair in zip(begin, segments, strict=True)))


def march(
    circuit,
    bearings,
    breakdown,
    segments,
    *,
    seed=0,
    ring=None,
    highest=20.0,
    trace=0.0,
    limits=(1.0,),
    at_event=False,
):
    """Record of a march through segments of a source, from its begin on."""
    chunks = segments if isinstance(segments, list) else [segments]
    duration = float(sum(np.sum(one.duration) for one in chunks))
    measuring = Measuring(0.0, duration, highest, limits, trace, at_event)
    return rotor_network(circuit, bearings, breakdown, ring).march(iter(chunks), measuring, seed)


def rotor_network(circuit, bearings, breakdown, ring=None):
    """Network of the rotor of a machine with both bearings as elements."""
    return NetworkInTime(machine(circuit, "rotor"), films_of_ends(bearings), breakdown, ring)


def capacitive_divider(circuit, bearings):
    """Voltage across the films of each bearing per volt of the source, right after an edge."""
    return rotor_network(circuit, bearings, arc()).divider


def drive_system(circuit, bearings, conductances=(0.0, 0.0)):
    """State equations of a drive with conductances of the films of both bearings [S]."""
    return rotor_network(circuit, bearings, arc()).with_films((0, 0), conductances).equations


def drive_with_remedy(**changes):
    """The example for a short time, with contacts by formula and one remedy, a grounding ring."""
    drive = DriveCase.from_toml(EXAMPLES / "drive.toml")
    quick = {"drive.contacts": "formula", "drive.duration": "5 ms"}
    return drive.replace({"remedies": drive.remedies[:1]} | quick | changes)
