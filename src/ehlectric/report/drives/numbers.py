"""Tables of a drive in a report: what was simulated, and both bearings side by side."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from ehlectric.cases.drives.case import ENDS
from ehlectric.discharge.laws import CURRENT_DENSITY_LIMITS
from ehlectric.quantities.drive_results import DRIVE_KEYS, LIMITS, NAMES_OF_ENDS
from ehlectric.quantities.formats import UNITS, number_text
from ehlectric.report.content import Table, Text

# Row of the bounds of the rate of discharges.
BOUNDS = "bounds"

# Tables of both bearings: caption, and the keys of the rows with the units in which they are shown.
_TABLES = (
    (
        "Films of both bearings",
        (
            ("capacitance", "pF"),
            ("breakdown_voltage", "V"),
            ("weibull_shape", ""),
            ("renewal_time", "µs"),
            ("touching_time_share", "%"),
        ),
    ),
    (
        "Voltages across the films",
        (
            ("voltage_ratio", "%"),
            ("waveform_ratio", "%"),
            ("peak_voltage", "V"),
            ("rms_voltage", "V"),
            *((f"time_above.{limit:g}", "%") for limit in LIMITS),
        ),
    ),
    (
        "Discharges",
        (
            ("events", ""),
            ("events_per_second", "1/s"),
            (BOUNDS, "1/s"),
            ("events_per_edge", "%"),
            ("burning_time_share", "%"),
            ("voltage_mean", "V"),
            ("voltage_high", "V"),
            ("voltage_largest", "V"),
            ("energy_mean", "nJ"),
            ("energy_high", "nJ"),
            ("energy_largest", "nJ"),
            ("charge_mean", "nC"),
            ("peak_current_mean", "mA"),
            ("peak_current_largest", "mA"),
            ("time_mean", "µs"),
            ("power", "µW"),
            ("contact_current", "mA"),
            ("current_density", "A/mm²"),
            ("element_current_density", "A/mm²"),
            ("real_current_density", "A/mm²"),
        ),
    ),
)

# Published limits of the current density [A/mm²].
_LIMITS = f"{1e-6 * CURRENT_DENSITY_LIMITS[0]:g} to {1e-6 * CURRENT_DENSITY_LIMITS[-1]:g}"

# Names where the label of a key says less than a reader without the other rows needs.
_NAMES = {
    "breakdown_voltage": "breakdown voltage, weakest position (≤)",
    "voltage_ratio": "bearing voltage ratio by the capacitive divider",
    "waveform_ratio": "bearing voltage ratio as simulated",
    "events": "discharges in the simulated time",
    BOUNDS: "discharges per second, bounds of 95 %",
    "touching_time_share": "share of time in which asperities touch",
    "current_density": "current density, all elements",
    "element_current_density": "current density, one element",
    "real_current_density": "current density, real area of asperities",
    "power": "mean power of the discharges",
}
_SHARES = (0.44, 0.22, 0.22, 0.12)
_BOUND = (
    "≤ marks an upper bound: real films are thinner than smooth ones, and break down at lower voltages. The "
    "bounds of 95 % count the scatter within the simulated time, and not the errors of the inputs. A dash "
    "stands where there is no such number, as without discharges or for ceramic elements. Published limits "
    f"are {_LIMITS} A/mm² for the current density of all elements."
)


def simulation_table(summary: Mapping[str, Any]) -> Table:
    """Table of what was simulated.

    Parameters
    ----------
    summary : mapping
        Summary of a drive.
    """
    drive, source = summary["drive"], summary["source"]
    rows = [
        ("largest common-mode voltage", number_text(source["peak"]), "V"),
        ("simulated time, after the circuit has settled", number_text(1e3 * drive["duration"]), "ms"),
    ]
    if drive["periods"] is not None:
        rows.append(("periods of the fundamental", f"{drive['periods']:.4g}", ""))
    edges = source["edges_per_second"]
    if edges is not None:
        rows.append(("edges of the common-mode voltage", f"{edges * drive['duration']:.0f}", ""))
        rows.append(("edges per second", number_text(edges), "1/s"))
    if source["fundamental_frequency"] is not None:
        rows.append(("fundamental frequency", number_text(source["fundamental_frequency"]), "Hz"))
    if source["modulation_index"] is not None:
        rows.append(("modulation index", number_text(source["modulation_index"]), ""))
    rows.append(("discharges of both bearings", f"{drive['events']}", ""))
    return Table("Simulation", ("quantity", "value", "unit"), tuple(rows), (1,), shares=(0.6, 0.25, 0.15))


def end_tables(summary: Mapping[str, Any]) -> Iterator[Table | Text]:
    """Tables of both bearings side by side; rows without a number at either end are left out.

    Parameters
    ----------
    summary : mapping
        Summary of a drive.
    """
    heads = ("quantity", *NAMES_OF_ENDS.values(), "unit")
    for caption, entries in _TABLES:
        rows: list[tuple[str, ...]] = []
        for key, unit in entries:
            cells = [value_text(summary[end], key, unit) for end in ENDS]
            # One of the voltages that are never reached says enough.
            none = set(cells) == {"0"}
            again = none and key.startswith("time_above.") and set(rows[-1][1:3]) == {"0"}
            if set(cells) != {"–"} and not again and not (none and key == "contact_current"):
                rows.append((_name(key), *cells, unit.replace(" ", "\xa0")))
        yield Table(caption, heads, tuple(rows), (1, 2), shares=_SHARES)
    yield Text(_BOUND)


def _name(key: str) -> str:
    if key in _NAMES:
        return _NAMES[key]
    return DRIVE_KEYS[f"{ENDS[0]}.{key}"].label.removesuffix(f", {NAMES_OF_ENDS[ENDS[0]]}")


def value_text(end: Mapping[str, Any], key: str, unit: str) -> str:
    """Number of one bearing in its shown unit; a dash for none.

    Parameters
    ----------
    end : mapping
        Summary of one bearing.
    key : str
        Key of the number, or ``BOUNDS`` for the bounds of the rate of discharges.
    unit : str
        Unit in which it is shown.

    Examples
    --------
    >>> end = {"events": 0, "events_per_second_low": 0.0, "events_per_second_high": 18.44}
    >>> value_text(end, BOUNDS, "1/s"), value_text({"power": 2.5e-6}, "power", "µW")
    ('at most 18.4', '2.5')
    """
    if key == BOUNDS:
        low, high = (number_text(end[f"events_per_second_{side}"]) for side in ("low", "high"))
        return f"{low} to {high}" if end["events"] else f"at most {high}"
    name, _, limit = key.partition(".")
    value = end[name][limit] if limit else end[name]
    if value is None:
        return "–"
    return str(value) if key == "events" else number_text(value * UNITS[unit][1])
