"""Results of a drive: the keys of its summary.json."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from types import MappingProxyType

from ehlectric.quantities.quantity import Keys, Quantity, under

# Voltages whose share of time is told [V]: field experience has discharges from a few volts on.
LIMITS = (1.0, 2.0, 5.0, 10.0, 20.0, 50.0)

# Names of the bearings in labels, by the names of their tables.
NAMES_OF_ENDS: Mapping[str, str] = MappingProxyType(
    {"drive_end": "drive end", "non_drive_end": "non-drive end"}
)

_ABOUT: Keys = {
    "schema": Quantity("name of the format"),
    "version": Quantity("version of the program"),
    "title": Quantity("title of the drive file"),
    "converged": Quantity("whether the films of both bearings are converged"),
    "warnings": Quantity("warnings, to be read before the numbers are used"),
    "warning_codes": Quantity("code of each warning, in the same order"),
    "verdict": Quantity(
        "answer: how often which bearing discharges, with which energy, and what it rests on"
    ),
    "level": Quantity('colour of the answer: "green", "yellow", "red", or "grey" where there is none'),
    "inputs": Quantity("the drive file, with both bearings"),
}
_SOURCE: Keys = {
    "peak": Quantity("largest absolute common-mode voltage, without ringing", "V", "common-mode voltage"),
    "edges_per_second": Quantity("steps of the common-mode voltage", "1/s", "edges of the source"),
    "fundamental_frequency": Quantity(
        "frequency of the fundamental at this speed; null for a measured source",
        "Hz",
        "fundamental frequency",
    ),
    "modulation_index": Quantity(
        "modulation index at this speed; null for six-step modulation and a measured source",
        "",
        "modulation index",
    ),
}
_CIRCUIT: Keys = {
    "winding_rotor_capacitance": Quantity(
        "capacitance from the winding to the rotor, given or from the geometry", "F", "winding to rotor"
    ),
    "rotor_frame_capacitance": Quantity(
        "capacitance from the rotor to the frame, given or from the geometry", "F", "rotor to frame"
    ),
    "winding_frame_capacitance": Quantity(
        "capacitance from the winding to the frame, given or from the geometry", "F", "winding to frame"
    ),
}
_DRIVE: Keys = {
    "speed": Quantity("speed of the rotor", "rad/s", "speed"),
    "temperature": Quantity("temperature of the oil of the drive-end bearing", "K", "temperature of the oil"),
    "duration": Quantity("simulated time, after the circuit has settled", "s", "simulated time"),
    "periods": Quantity("periods of the fundamental in this time; null for a measured source", "", "periods"),
    "seed": Quantity("seed of the random numbers"),
    "events": Quantity("discharges of both bearings", "", "discharges"),
    "events_per_second": Quantity("discharges of both bearings in a second", "1/s", "discharges per second"),
    "power": Quantity(
        "energy of the discharges of both bearings in a second", "W", "power of the discharges"
    ),
}
_SPREADS = {
    "voltage": ("voltage across the films at which they break down", "V", "voltage of a discharge"),
    "charge": ("charge through the arc", "C", "charge of a discharge"),
    "energy": ("energy in the arc", "J", "energy of a discharge"),
    "peak_current": ("largest current through the arc", "A", "peak current of a discharge"),
    "time": ("time from breakdown until the film insulates again", "s", "duration of a discharge"),
}
_STATISTICS = {"mean": "mean", "median": "median", "high": "95th percentile", "largest": "largest"}
_END: Keys = {
    "capacitance": Quantity("capacitance of the films, mean over the positions", "F", "bearing capacitance"),
    "conductance": Quantity("conductance of the oil of the films", "S", "conductance of the films"),
    "breakdown_voltage": Quantity(
        "voltage across the films at which an element breaks down from ring to ring, weakest position; "
        "null for ceramic elements",
        "V",
        "breakdown voltage",
    ),
    "weibull_shape": Quantity(
        "shape of Weibull's law of that voltage; null without scatter", "", "Weibull shape"
    ),
    "renewal_time": Quantity(
        "mean time after which other oil, with another threshold, is in them", "s", "renewal time"
    ),
    "touching_time_share": Quantity(
        "share of time in which asperities close the films", "", "share of contact"
    ),
    "voltage_ratio": Quantity(
        "voltage across the films per volt of the source right after an edge, by the capacitive divider, "
        "with the elements at their first position; inductances are left out",
        "",
        "bearing voltage ratio",
    ),
    "waveform_ratio": Quantity(
        "largest voltage across the films over the largest voltage of the source, as simulated",
        "",
        "voltage ratio by the waveform",
    ),
    "peak_voltage": Quantity("largest voltage across the films", "V", "largest bearing voltage"),
    "rms_voltage": Quantity("root mean square of the voltage across the films", "V", "rms bearing voltage"),
    "burning_time_share": Quantity(
        "part of the time for which the films conduct by an arc, from breakdown until they insulate again "
        "(`recovery_time` after the arc goes out); also of arcs that still burn at the end",
        "",
        "share of time with conducting films",
    ),
    "time_above": Quantity("share of time above each of the voltages, by the voltage in volts"),
    **{
        f"time_above.{limit:g}": Quantity(
            f"share of time above {limit:g} V", "", f"share of time above {limit:g} V"
        )
        for limit in LIMITS
    },
    "events": Quantity("number of discharges", "", "discharges"),
    "events_per_second": Quantity("discharges in a second", "1/s", "discharges per second"),
    "events_per_second_low": Quantity(
        "lower bound of that rate, at 95 %", "1/s", "discharges per second, lower bound"
    ),
    "events_per_second_high": Quantity(
        "upper bound of that rate, at 95 %", "1/s", "discharges per second, upper bound"
    ),
    "events_per_edge": Quantity("discharges over edges of the source", "", "discharges per edge"),
    "power": Quantity("energy of the discharges in a second", "W", "power of the discharges"),
    **{
        f"{name}_{short}": Quantity(f"{meaning}: {statistic}", unit, f"{label}, {statistic}")
        for name, (meaning, unit, label) in _SPREADS.items()
        for short, statistic in _STATISTICS.items()
    },
    "contact_current": Quantity(
        "largest current through asperities that touch; 0 where none do",
        "A",
        "peak current through asperities",
    ),
    "real_area": Quantity(
        "real area of contact of all elements whose asperities touch both rings, mean over the time in which "
        "any does; null without `[bearing.summits]` of the bearing file, and where nothing touches",
        "m**2",
        "real area of contact",
    ),
    "real_current_density": Quantity(
        "contact_current over real_area; published limits are for Hertz areas",
        "A/m**2",
        "current density, real area",
    ),
    "hertz_area": Quantity(
        "dry contact areas through which a current can flow, together", "m**2", "Hertz area"
    ),
    "current_density": Quantity(
        "largest current, of an arc or through asperities, over all Hertz areas; null without a current",
        "A/m**2",
        "current density",
    ),
    "element_current_density": Quantity(
        "largest current over the Hertz area of the most loaded element, through which an arc flows alone",
        "A/m**2",
        "current density of an element",
    ),
    "current_density_limits": Quantity("published limits of the current density", "A/m**2"),
}
_ENDS: Keys = {
    f"{end}.{name}": replace(key, label=f"{key.label}, {words}" if key.label else "")
    for end, words in NAMES_OF_ENDS.items()
    for name, key in _END.items()
}
_REMEDY: Keys = {
    "title": Quantity("title of the remedy"),
    "changes": Quantity("what it changes, by dotted key"),
    "changes.*": Quantity("new value of a key of the drive file"),
    **_ENDS,
}

DRIVE_KEYS: Keys = {
    **_ABOUT,
    **under("source", _SOURCE),
    **under("circuit", _CIRCUIT),
    **under("drive", _DRIVE),
    **_ENDS,
    **under("remedies", _REMEDY),
    "seconds": Quantity("computing time", "s", "computing time"),
}

# Columns of the spectrum of the shaft voltage, with their units.
SPECTRUM_COLUMNS = {"frequency": "Hz", "shaft_voltage": "V"}

# Columns of the table of events, with their units.
EVENT_COLUMNS = {
    "time": "s",
    "duration": "s",
    "voltage": "V",
    "charge": "C",
    "energy": "J",
    "peak_current": "A",
}
