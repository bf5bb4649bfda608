"""Values of a drive that no model gives and that decide its result, in a report."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from types import MappingProxyType
from typing import Any

from ehlectric.cases.bearings.case import BearingCase
from ehlectric.cases.changes import flattened
from ehlectric.cases.drives.case import BOTH, ENDS, DriveCase
from ehlectric.cases.input_keys import of_both_ends
from ehlectric.figures.names import with_units_kept
from ehlectric.quantities.formats import amount
from ehlectric.quantities.inputs import end_and_key
from ehlectric.report.content import Section, Table, Text
from ehlectric.report.origins import input_text, inputs_of

_TEXT = (
    "There is no model of the arc, and capacitances of machines are seldom measured: the values below decide "
    "the result. The report cannot know whether they were measured. Take each of them for an assumption "
    "unless the author of the input file says how it was found, and see with remedies what half and double "
    "of it change."
)

# Words for the origin of an input that is not a value of the library.
_GIVEN = "input file"
_ORIGINS = {"given": _GIVEN}
_CAPTION = "Values that decide the result"
_HEADS, _SHARES = ("input", "value", "origin", "what it decides"), (0.29, 0.14, 0.21, 0.36)

# What the inputs decide, by their keys in a drive file.
_DECIDES: Mapping[str, str] = MappingProxyType(
    {
        "circuit.winding_rotor_capacitance": "bearing voltage, by the capacitive divider",
        "circuit.rotor_frame_capacitance": "bearing voltage; charge and energy that an arc can take",
        "circuit.winding_frame_capacitance": "voltage of the winding behind an inductance; nothing without "
        "one",
        "circuit.frame_earth_capacitance": "voltage of the frame against earth",
        "circuit.cable_capacitance": "edges behind an inductance",
        "circuit.common_mode_inductance": "edges and ringing at the winding",
        "circuit.common_mode_resistance": "edges and ringing at the winding",
        "circuit.ground_inductance": "voltage of the frame against earth",
        "circuit.ground_resistance": "voltage of the frame against earth",
        "circuit.grounding_ring_resistance": "voltage that is left on the shaft",
        "breakdown.arc_resistance": "energy, peak current and duration of a discharge",
        "breakdown.extinction_current": "end of an arc: charge and energy of a discharge",
        "breakdown.extinction_voltage": "end of an arc: charge and energy of a discharge",
        "breakdown.recovery_time": "whether the source feeds an arc again",
        "breakdown.weibull_shape": "scatter of the voltages of discharges, and with it their number",
        "breakdown.renewal_time": "time between new thresholds, and with it the number of discharges",
        "breakdown.touch_time": "time for which asperities close a film",
    }
)

# The same by the keys of a bearing file; tables are named by their first word.
_OF_BEARINGS: Mapping[str, str] = MappingProxyType(
    {
        "contacts": "how exact films, capacitance and breakdown voltage are",
        "bearing.film_factor": "film thickness: what heat and starvation leave of it",
        "discharge.dielectric_strength": "voltage at which films break down, and with it number and energy",
        "discharge.conductivity": "time for which the films hold a voltage",
        "bearing.composite_rq": "whether asperities touch",
        "bearing.contact_resistance": "resistance of touching asperities",
        "bearing.element_capacitance": "capacitance of ceramic elements",
        "bearing.radial_clearance": "load of each element: films and capacitance",
    }
)


def assumption_section(
    case: DriveCase, summary: Mapping[str, Any] | None = None, varied: Iterable[str] = ()
) -> Section:
    """Section of the values that decide the result and that no model gives.

    Parameters
    ----------
    case : DriveCase
        Case of the drive, or base case of a sweep.
    summary : mapping, optional
        Summary of the drive; not of a sweep.
    varied : iterable of str
        Dotted keys that a sweep varies, which get their values from there.
    """
    apart = any(end_and_key(key)[0] in ENDS for key in varied)
    origins = {one.key: _ORIGINS.get(one.origin, one.origin) for one in inputs_of(case, apart=apart)}
    values = [*_of_tables(case), *_renewal(case, summary), *_of_bearings(case, apart=apart)]
    rows = [(key, value, origin or origins.get(key, _GIVEN), why) for key, value, origin, why in values]
    either = {one for key in varied for one in (key, *of_both_ends(key))}
    shown = tuple(
        (key, "varied", "sweep", why) if key in either else (key, *rest, why) for key, *rest, why in rows
    )
    return Section("What decides the result", (Text(_TEXT), Table(_CAPTION, _HEADS, shown, shares=_SHARES)))


def _of_tables(case: DriveCase) -> Iterator[tuple[str, ...]]:
    """Rows of the tables ``circuit`` and ``breakdown``, without an origin where it is that of an input."""
    given = flattened(case.to_dict())
    for key, decides in _DECIDES.items():
        name = key.partition(".")[2]
        if key in given:
            # Resistances of 0 ohm are those of a path that has none.
            if given[key] or "resistance" not in key:
                yield key, input_text(case, key, given[key]), "", decides
        elif name in case.circuit.estimated:
            origin = "geometry of the machine, without end windings"
            yield key, amount(case.circuit.capacitances[name], "F"), origin, decides


def _renewal(case: DriveCase, summary: Mapping[str, Any] | None) -> Iterator[tuple[str, ...]]:
    """Row of the time between new thresholds, where it follows from the bearings."""
    if case.breakdown.renewal_time is not None or summary is None:
        return
    times = sorted({summary[end]["renewal_time"] for end in ENDS} - {None})
    if times:
        key = "breakdown.renewal_time"
        value = " and ".join(dict.fromkeys(amount(float(f"{time:.3g}"), "s") for time in times))
        origin = "time in which oil passes the most loaded contact"
        yield key, with_units_kept(value), origin, _DECIDES[key]


def _of_bearings(case: DriveCase, *, apart: bool) -> Iterator[tuple[str, ...]]:
    """Rows of both bearings; those of equal bearings stand once, where no end has values of its own."""
    first, second = case.bearings
    if first == second and not apart:
        yield from _of_bearing(case, first, BOTH, ENDS[0])
        return
    for end, one in zip(ENDS, (first, second), strict=True):
        yield from _of_bearing(case, one, end, end)


def _of_bearing(case: DriveCase, bearing: BearingCase, name: str, end: str) -> Iterator[tuple[str, ...]]:
    """Rows of one bearing, whose keys begin with a name."""
    given = flattened(bearing.to_dict())
    for key, decides in _OF_BEARINGS.items():
        if key in given:
            yield f"{name}.{key}", input_text(case, f"{end}.{key}", given[key]), "", decides
    decides = _OF_BEARINGS["discharge.dielectric_strength"]
    for key, value in given.items():
        if key.startswith("discharge.weibull."):
            yield f"{name}.{key}", input_text(case, f"{end}.{key}", value), "", decides
    if any(key.startswith("discharge.strength_table.") for key in given):
        yield f"{name}.discharge.strength_table", "a table", _GIVEN, decides
