"""Keys of summary.json for the circuit between shaft and housing: coating, meter, shaft and film voltages."""

from __future__ import annotations

from ehlectric.cases.result_key import Keys, ResultKey

METER_KEYS: Keys = {
    "capacitance_rough": ResultKey(
        "capacitance of the films with the roughness `composite_rq` in their Hertz areas; null where a "
        "loaded contact has a central film below 2 composite_rq, and for ceramic elements",
        "F",
        "capacitance of the bearing, rough films",
    ),
    "roughness_factor": ResultKey(
        "capacitance_rough / capacitance; null as capacitance_rough is",
        "",
        "rough / smooth capacitance",
    ),
    "coating_capacitance": ResultKey(
        "capacitance of the coating on a ring; null without one", "F", "capacitance of the coating"
    ),
    "coating_breakdown": ResultKey(
        "breakdown voltage of the coating alone; null where none is given",
        "V",
        "breakdown voltage of the coating",
    ),
    "coating_margin": ResultKey(
        "coating_breakdown / shaft voltage: once a film has broken down, the coating carries nearly all of "
        "the shaft voltage; null as either is",
        "",
        "coating breakdown / shaft voltage",
    ),
    "film_share": ResultKey(
        "share of the shaft voltage across the films by the capacitive divider of films and coating; 1 "
        "without a coating; null where surfaces touch, and for ceramic elements without element_capacitance",
        "",
        "share of the shaft voltage across the films",
    ),
    "coating_share": ResultKey(
        "share of the shaft voltage across the coating; null without one and as film_share is",
        "",
        "share of the shaft voltage across the coating",
    ),
    "parallel_capacitance": ResultKey(
        "capacitance of cage, shields and wiring; 0 where none is given", "F", "parallel capacitance"
    ),
    "shaft_capacitance": ResultKey(
        "capacitance from shaft to housing, of smooth films, coating and parallel capacitance, with which "
        "the shaft voltage is computed",
        "F",
        "capacitance from shaft to housing",
    ),
    "meter_capacitance": ResultKey(
        "capacitance that a meter reads from shaft to housing, the same with rough films; null as "
        "capacitance_rough is, but for ceramic elements with element_capacitance",
        "F",
        "capacitance that a meter reads",
    ),
    "shaft_first_break": ResultKey(
        "shaft voltage at which the first contact breaks down: first_break over the share of the films, "
        "minimum over the positions; first_break without a coating; null as first_break is",
        "V",
        "shaft voltage of the first breakdown",
    ),
    "shaft_through_breakdown": ResultKey(
        "shaft voltage of the ring-to-ring breakdown; through_breakdown without a coating; null likewise",
        "V",
        "shaft voltage of the ring-to-ring breakdown",
    ),
    "film_voltage": ResultKey(
        "part of the shaft voltage across the films, from ring to ring; null as shaft_voltage is",
        "V",
        "voltage across the films",
    ),
    "film_time_constant": ResultKey(
        "time constant with which the voltage across the films decays right after an edge of the inverter; "
        "shaft_time_constant without a coating, and null as that is",
        "s",
        "time constant of the films",
    ),
    "switching_period": ResultKey(
        "period of the inverter, 1 / `motor.switching_frequency`; null without it",
        "s",
        "period of the inverter",
    ),
    "film_voltage_after_period": ResultKey(
        "voltage across the films that is left after a period of the inverter; null as "
        "shaft_voltage_after_period is",
        "V",
        "voltage across the films after a period of the inverter",
    ),
}
