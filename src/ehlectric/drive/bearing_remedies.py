"""Remedies of a drive at a single bearing: what each makes of its voltages and its margin, not simulated."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from ehlectric.bearing import BearingSolution, shaft_capacitance, voltage_ratio
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.discharge.breakdown_rule import code_of, level_of, strength_interval
from ehlectric.discharge.film_verdict import no_verdict
from ehlectric.quantities.inputs import BOTH
from ehlectric.quantities.statement import Fact, Statement
from ehlectric.quantities.verdict import Verdict

# Change of the common-mode voltage of an inverter by one edge over its largest value: a third of the DC link,
# as one phase of three switches, over half of it.
EDGE = 2.0 / 3.0


def with_remedy(case: BearingCase, changes: Mapping[str, Any]) -> BearingCase:
    """Bearing with those changes of a remedy that are of both bearings of its drive.

    Raises InputError if the changed bearing is not valid.
    """
    first = f"{BOTH}."
    of_bearing = {key.removeprefix(first): value for key, value in changes.items() if key.startswith(first)}
    return case.replace(of_bearing) if of_bearing else case


def grounded_voltage(solution: BearingSolution, resistance: float, rise_time: float) -> float | None:
    """Shaft voltage with a grounding ring at the end of an edge of the inverter [V]; None without a motor.

    An edge of the height dV that rises over the time t_r drives the current C_wr dV/t_r through the
    winding-rotor capacitance into the ring R and the other capacitances of the shaft. With their sum C and
    T = R C it leaves V = R C_wr dV/t_r (1 - exp(-t_r/T)), which decays with T before the next edge. The
    inductance of the ring is neglected.

    ``resistance``, of the ring R from shaft to frame [ohm]; ``rise_time``, of an edge t_r [s].
    """
    motor = solution.case.motor
    if motor is None:
        return None
    first, second = float(shaft_capacitance(solution)), motor.second_bearing_capacitance
    winding, frame = motor.winding_rotor_capacitance, motor.rotor_frame_capacitance
    other = first if second is None else second
    ratio = float(voltage_ratio(winding, frame, first, other))
    periods = rise_time / (resistance * (winding + frame + first + other))
    return EDGE * motor.common_mode_voltage * ratio * -math.expm1(-periods) / periods


# Numbers of a bearing that are proportional to the shaft voltage, and those that are so to its reciprocal.
_PROPORTIONAL = ("film_voltage", "max_strength", "element_voltage", "element_field")
_RECIPROCAL = ("margin", "ring_to_ring_margin", "coating_margin", "element_margin")


def at_shaft_voltage(summary: Mapping[str, Any], voltage: float) -> dict[str, Any]:
    """Summary of a bearing at another shaft voltage [V], without what follows from further bearings."""
    bearing = dict(summary["bearing"])
    factor = None if bearing["shaft_voltage"] is None else voltage / bearing["shaft_voltage"]
    for keys, power in ((_PROPORTIONAL, 1), (_RECIPROCAL, -1)):
        known = (key for key in keys if bearing[key] is not None)
        bearing |= {key: None if factor is None else bearing[key] * factor**power for key in known}
    rest = {key: value for key, value in summary.items() if key not in ("margin", "uncertainty")}
    return {**rest, "bearing": {**bearing, "shaft_voltage": voltage, "breakdown_probability": None}}


def grounded_verdict(margin: float | None) -> Verdict:
    """Verdict on a bearing with a grounding ring from its margin, without the spread of its inputs."""
    if margin is None:
        return no_verdict(Statement.of("no-margin-known"))
    level = level_of(*strength_interval(margin))
    return Verdict(
        level,
        code_of(level, likely=margin < 1.0),
        Statement.of("margin-only", margin=margin),
        facts=(Fact("bearing.margin", margin),),
    )
