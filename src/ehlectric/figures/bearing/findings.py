"""Findings of the figures of a bearing, one sentence each, and the lines about its case below them."""

from __future__ import annotations

import textwrap
from collections.abc import Mapping
from typing import Any

import numpy as np

from ehlectric.arrays import Array
from ehlectric.bearing.impedance import impedance_of
from ehlectric.bearing.intermittency.duty import duty_of
from ehlectric.bearing.intermittency.words import time_text
from ehlectric.bearing.meter.reading import shaft_capacitance
from ehlectric.bearing.over_speed import (
    Curves,
    Speed,
    Speeds,
    critical_speed_of,
    opening_speed_of,
    value_of,
)
from ehlectric.bearing.result import BearingResult
from ehlectric.bearing.solution import lambda_text, lubrication
from ehlectric.cases.bearings.ways import HOW, OF_CONTACTS
from ehlectric.discharge.verdict import lead_of, ratio_text
from ehlectric.figures.bearing.impedance import magnitude_at, prefixed, read_at
from ehlectric.figures.bearing.looks import volts
from ehlectric.figures.bearing.pitch import capacitances, first_breakdowns, variation
from ehlectric.figures.bearing.speeds import rpm_text
from ehlectric.quantities.units import rpm

_TOUCHING = ("conducting", "touching")


def loads(result: BearingResult) -> str:
    """Sentence: the contacts with the largest load and the minimum film, at the first cage position."""
    rows = result.contacts()
    most, thinnest = (
        max(rows, key=lambda row: row["load"]),
        min(rows, key=lambda row: row["minimum_thickness"]),
    )
    least = prefixed(thinnest["minimum_thickness"], "m", least=0.1)
    text = (
        f"Largest load {most['load']:.3g} N ({_contact(most)}); minimum film {least} ({_contact(thinnest)})"
    )
    text += f", λ {lambda_text(result.solution)}"
    return text + (": surfaces touch" if lubrication(result.solution) in _TOUCHING else "")


def _contact(row: Mapping[str, Any]) -> str:
    """Name of a contact of the table of contacts."""
    return f"{row['ring']}, element {row['element']}"


def circuit(result: BearingResult) -> str:
    """Sentence: whether breakdown is expected, with the margin; without one, the capacitance."""
    found, shaft = result.breaks(), result.shaft_voltage
    if found["first_break"] is None:
        value = result.capacitance(result.case.bearing.fill)
        conducting = lubrication(result.solution) == "conducting"
        touch = "Contacts open and close: discharges likely, no voltage computed" if conducting else ""
        return touch or f"Capacitance of the bearing: {prefixed(value, 'F')}"
    first = volts(found["shaft_first_break"])
    if shaft is None:
        return f"First breakdown at {first}: {found['first_break_at']}"
    verdict, margin = result.verdict, found["margin"]
    lead = (
        "Margin"
        if verdict is None or verdict.level == "grey"
        else f"{lead_of(verdict.level, margin)}: margin"
    )
    return f"{lead} {ratio_text(margin)} (first breakdown {first} / shaft voltage {volts(shaft)})"


def pitch(result: BearingResult) -> str:
    """Sentence: how much capacitance and first breakdown vary over a pitch of the cage."""
    varied = 100.0 * variation(capacitances(result, result.case.bearing.fill))
    text = f"Over a pitch of the cage, the capacitance varies by {varied:.2g} %"
    if result.breaks()["first_break"] is None:
        return text
    return f"{text}, the first breakdown by {100.0 * variation(first_breakdowns(result)):.2g} %"


def impedance(result: BearingResult) -> str:
    """Sentence: the capacitance that the bearing is above its corner frequency, and its impedance there."""
    found = impedance_of(result.solution)
    assert found is not None
    shown = [(prefixed(magnitude_at(found.mean or found, at), "Ω"), at) for at in read_at(result)]
    values = ", ".join(f"{value} at {prefixed(at, 'Hz')}" for value, at in shown)
    if found.mean is not None:
        duty = duty_of(result.solution)
        return f"An element touches both rings {time_text(duty.touching_time_share)}: mean |Z| = {values}"
    value = prefixed(shaft_capacitance(result.solution), "F")
    return f"A capacitor of {value} above {prefixed(found.corner, 'Hz')}: |Z| = {values}"


def capacitance_over_speed(curves: Curves, own: Speed | None) -> str:
    """Sentence: the capacitance at the lowest and the highest speed, and at the speed of the bearing."""
    values = curves["capacitance"]
    ends = [f"{prefixed(float(values[k]), 'F')} at {rpm_text(curves.speed[k])}" for k in (0, -1)]
    text = f"Capacitance {ends[0]}, {ends[1]}"
    return (
        text
        if own is None
        else f"{text}; {prefixed(own[1]['bearing']['capacitance'], 'F')} at {rpm_text(own[0])}"
    )


def breakdown_over_speed(curves: Curves, own: Speed | None) -> str:
    """Sentence: at which speeds breakdown is expected, and the margin of the bearing itself."""
    margin = curves["first_break"] / curves["shaft_voltage"]
    known = np.isfinite(margin)
    at_own = ""
    if own is not None and (value := value_of(own[1], "first_break")) is not None:
        shaft = own[1]["bearing"]["shaft_voltage"]
        at_own = f"{volts(value)}" if shaft is None else f"margin {ratio_text(value / shaft)}"
        at_own += f" at {rpm_text(own[0])}"
    opening = opening_speed_of(curves)
    below = "" if opening is None else f"; contacts open and close below {rpm_text(opening)}"
    if not np.any(known):
        first = np.flatnonzero(np.isfinite(curves["first_break"]))
        ends = [f"{volts(curves['first_break'][k])} at {rpm_text(curves.speed[k])}" for k in first[[0, -1]]]
        span = f"First breakdown at {at_own}" if at_own else f"First breakdown from {' to '.join(ends)}"
        return f"{span}{below}"
    text = f"{_where(curves, margin[known], curves.speed[known])}{below}"
    return f"{text} ({at_own})" if at_own else text


def _where(
    curves: Curves,
    margin: Array,
    speed: Array,
) -> str:
    """Clause: the speeds at which breakdown is expected."""
    critical = critical_speed_of(curves)
    lowest = curves.touching or max(float(speed[0]), opening_speed_of(curves) or 0.0)
    span = f"from {rpm_text(lowest)} to {rpm_text(float(speed[-1]))}"
    if critical is None:
        if np.all(margin >= 1.0):
            return f"No breakdown expected {span}"
        if np.all(margin < 1.0):
            return f"Breakdown expected at all speeds {span}"
        return f"Breakdown expected above {rpm_text(float(speed[margin >= 1.0][-1]))}"
    some = "" if np.all(margin[speed < critical] < 1.0) else " at some speeds"
    return f"Breakdown expected{some} below about {rpm_text(critical)}"


def case_lines(result: BearingResult, *, voltages: bool) -> list[str]:
    """Lines: title of the case, duty as far as the title lacks it, and how the films were computed."""
    bearing, title = result.solution.case.bearing, result.solution.case.title
    duty = [
        f"{load:.4g} N {way}"
        for load, way in ((bearing.radial_load, "radial"), (bearing.axial_load, "axial"))
        if load
    ]
    duty += [f"{rpm(bearing.inner_speed):.4g} rpm", f"{bearing.oil_temperature - 273.15:.4g} °C"]
    parts = [part for part in duty if part not in title]
    line = ", ".join([*filter(None, [textwrap.shorten(title, 70, placeholder=" ...")]), *parts])
    return [line, film_line(result, voltages=voltages)]


def film_line(result: BearingResult, *, voltages: bool) -> str:
    """Line: how the films were computed, and what that means for voltages."""
    solution = result.solution
    factor = solution.conditions.film_factor
    text = "isothermal, fully flooded film" if factor == 1.0 else f"film factor {factor:.3g}"
    text += f", minimum λ {lambda_text(solution)}"
    text += f", contacts {HOW[solution.case.contacts]}"
    if lubrication(solution) in _TOUCHING:
        return text + ": surfaces touch"
    return text + (": voltages are upper bounds" if voltages else "")


def curves_line(points: Speeds, curves: Curves, own: Speed | None) -> str:
    """Line: how the curves over speed were computed, and how they were scaled to the bearing itself."""
    contacts = sorted({OF_CONTACTS[summary["bearing"]["contacts"]] for _, summary in points})
    text = f"curves: {' or '.join(contacts)}"
    if own is None or own[1]["bearing"]["contacts"] != "solved":
        return text
    factors = [curves.scaled[key] for key in ("capacitance", "first_break") if curves.scaled[key] != 1.0]
    if not factors:
        return text
    values = " and ".join(f"{factor:.3g}" for factor in factors)
    return f"{text}, scaled by {values} to the solved contacts at {rpm_text(own[0])} (star)"
