"""Results of a drive: the keys of its summary.json."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from functools import partial
from types import MappingProxyType

from ehlectric.quantities.quantity import Keys, Quantity, under

# Quantity with the digits of a simulation whose numbers scatter.
_number = partial(Quantity, digits=".3g")

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
    "peak": _number("largest absolute common-mode voltage, without ringing", "V", "peak common-mode voltage"),
    "edges_per_second": _number("steps of the common-mode voltage", "1/s", "edges of the source per second"),
    "fundamental_frequency": _number(
        "frequency of the fundamental at this speed; null for a measured source",
        "Hz",
        "fundamental frequency",
        shown="Hz",
    ),
    "modulation_index": _number(
        "modulation index at this speed; null for six-step modulation and a measured source",
        "",
        "modulation index",
    ),
}
_CIRCUIT: Keys = {
    "winding_rotor_capacitance": _number(
        "capacitance from the winding to the rotor, given or from the geometry",
        "F",
        "winding-to-rotor capacitance",
        shown="prefixed",
    ),
    "rotor_frame_capacitance": _number(
        "capacitance from the rotor to the frame, given or from the geometry",
        "F",
        "rotor-to-frame capacitance",
        shown="prefixed",
    ),
    "winding_frame_capacitance": _number(
        "capacitance from the winding to the frame, given or from the geometry",
        "F",
        "winding-to-frame capacitance",
        shown="prefixed",
    ),
}
_DRIVE: Keys = {
    "speed": Quantity("speed of the rotor", "rad/s", "speed of the rotor"),
    "temperature": Quantity(
        "temperature of the oil of the drive-end bearing", "K", "temperature of the oil", shown="°C"
    ),
    "duration": _number("simulated time, after the circuit has settled", "s", "simulated time", shown="ms"),
    "periods": Quantity(
        "periods of the fundamental in this time; null for a measured source",
        "",
        "periods of the fundamental",
    ),
    "seed": Quantity("seed of the random numbers"),
    "events": Quantity("discharges of both bearings", "", "discharges of both bearings", digits=".0f"),
    "events_per_second": _number(
        "discharges of both bearings in a second", "1/s", "discharges per second, both bearings"
    ),
    "power": _number(
        "energy of the discharges of both bearings in a second",
        "W",
        "power of discharges, both bearings",
        shown="µW",
    ),
}
_SPREADS: Keys = {
    "voltage": _number("voltage across the films at which they break down", "V", "voltage of a discharge"),
    "charge": _number("charge through the arc", "C", "charge of a discharge", shown="nC"),
    "energy": _number("energy in the arc", "J", "energy of a discharge", shown="nJ"),
    "peak_current": _number("largest current through the arc", "A", "peak arc current", shown="mA"),
    "time": _number(
        "time from breakdown until the film insulates again", "s", "duration of a discharge", shown="µs"
    ),
}
STATISTICS = {"mean": "mean", "median": "median", "high": "95th percentile", "largest": "maximum"}
_END: Keys = {
    "capacitance": _number("capacitance of the films, mean over the positions", "F", "bearing capacitance"),
    "conductance": _number("conductance of the oil of the films", "S", "conductance of the films"),
    "breakdown_voltage": _number(
        "voltage across the films at which an element breaks down from ring to ring, weakest position; "
        "null for ceramic elements",
        "V",
        "breakdown voltage, weakest position",
        bound="≤",
    ),
    "weibull_shape": _number(
        "shape of Weibull's law of that voltage; null without scatter",
        "",
        "Weibull shape of the breakdown voltage",
    ),
    "renewal_time": _number(
        "mean time after which other oil, with another threshold, is in them",
        "s",
        "mean renewal time of the oil",
        shown="µs",
    ),
    "touching_time_share": _number(
        "share of time in which asperities close the films",
        "",
        "share of time with metallic contact",
        shown="%",
    ),
    "voltage_ratio": _number(
        "voltage across the films per volt of the source right after an edge, by the capacitive divider, "
        "with the elements at their first position; inductances are left out",
        "",
        "bearing voltage ratio, divider",
        shown="%",
    ),
    "waveform_ratio": _number(
        "largest voltage across the films over the largest voltage of the source, as simulated",
        "",
        "bearing voltage ratio, waveform",
        shown="%",
    ),
    "peak_voltage": _number("largest voltage across the films", "V", "peak bearing voltage"),
    "rms_voltage": _number("root mean square of the voltage across the films", "V", "rms bearing voltage"),
    "burning_time_share": _number(
        "part of the time for which the films conduct by an arc, from breakdown until they insulate again "
        "(`recovery_time` after the arc goes out); also of arcs that still burn at the end",
        "",
        "share of time with conducting films",
        shown="%",
    ),
    "time_above": Quantity("share of time above each of the voltages, by the voltage in volts"),
    **{
        f"time_above.{limit:g}": _number(
            f"share of time above {limit:g} V", "", f"share of time above {limit:g} V", shown="%"
        )
        for limit in LIMITS
    },
    "events": Quantity("number of discharges", "", "number of discharges", digits=".0f"),
    "events_per_second": _number("discharges in a second", "1/s", "discharges per second"),
    "events_per_second_low": _number(
        "lower bound of that rate, at 95 %", "1/s", "discharges per second, lower bound"
    ),
    "events_per_second_high": _number(
        "upper bound of that rate, at 95 %", "1/s", "discharges per second, upper bound"
    ),
    "events_per_edge": _number(
        "discharges over edges of the source", "", "discharges per edge of the source", shown="%"
    ),
    "power": _number("energy of the discharges in a second", "W", "power of the discharges", shown="µW"),
    **{
        f"{name}_{short}": replace(
            one, meaning=f"{one.meaning}: {statistic}", label=f"{one.label}, {statistic}"
        )
        for name, one in _SPREADS.items()
        for short, statistic in STATISTICS.items()
    },
    "contact_current": _number(
        "largest current through asperities that touch; 0 where none do",
        "A",
        "peak current through asperities",
        shown="mA",
    ),
    "real_area": _number(
        "real area of contact of all elements whose asperities touch both rings, mean over the time in which "
        "any does; null without `[bearing.summits]` of the bearing file, and where nothing touches",
        "m**2",
        "real area of contact",
    ),
    "real_current_density": _number(
        "contact_current over real_area; published limits are for Hertz areas",
        "A/m**2",
        "current density, real area of contact",
    ),
    "hertz_area": _number(
        "dry contact areas through which a current can flow, together", "m**2", "Hertz area", shown="mm²"
    ),
    "current_density": _number(
        "largest current, of an arc or through asperities, over all Hertz areas; null without a current",
        "A/m**2",
        "current density, all elements",
    ),
    "element_current_density": _number(
        "largest current over the Hertz area of the most loaded element, through which an arc flows alone",
        "A/m**2",
        "current density, one element",
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

# Quantities that outputs show and no summary stores: those of a drive before its simulation, and those made
# of several. The table "end" is that of the bearing at either end.
_SHOWN: Keys = {
    "source.edges": Quantity(
        "steps of the common-mode voltage in the simulated time", "", "edges of the source", digits=".0f"
    ),
    "drive.remedies": Quantity("number of remedies", "", "number of remedies", digits=".0f"),
    "end.films": Quantity("how the contacts of a bearing were computed", "", "contacts"),
    "end.voltage_at_peak": _number(
        "voltage_ratio times the peak of the source", "V", "bearing voltage at the source peak"
    ),
    "end.events_per_second_range": _number(
        "discharges per second, interval of 95 %", "1/s", "discharges per second, 95 % interval"
    ),
}
# Everything that outputs of a drive show.
DRIVE_BOOK: Keys = {**DRIVE_KEYS, **under("end", _END), **_SHOWN}

# Columns of the spectrum of the shaft voltage, with their units.
SPECTRUM_COLUMNS = {"frequency": "Hz", "shaft_voltage": "V"}

# Columns of the table of events.
EVENT_KEYS: Keys = {
    "time": Quantity("time of the breakdown", "s", "time of the breakdown"),
    "duration": _SPREADS["time"],
    **{name: _SPREADS[name] for name in ("voltage", "charge", "energy", "peak_current")},
}
EVENT_COLUMNS = {name: one.unit for name, one in EVENT_KEYS.items()}
