"""Summary of a solved bearing: totals, breakdown voltages, and a row for every contact."""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from operator import mul, truediv
from typing import Any

import numpy as np

from ehlectric.arrays import Numbers
from ehlectric.bearing.bearing_discharges import (
    Breakdown,
    bearing_costs,
    bearing_voltage_ratio,
    breakdown_of,
    edge_current,
    film_voltage,
    shaft_leakage,
    shaft_voltage,
    strength_per_volt,
)
from ehlectric.bearing.bearing_touching import BearingDuty, contact_duty, duty_of, duty_summary
from ehlectric.bearing.ceramic_elements import ceramic_summary
from ehlectric.bearing.conditions import BearingConditions
from ehlectric.bearing.film_factor import friction_summary, half_time
from ehlectric.bearing.impedance import (
    film_share,
    meter_reading,
    oil_relaxation_time,
    rough_capacitance,
    shaft_capacitance,
    shaft_path,
)
from ehlectric.bearing.loads.totals import mechanics_of
from ehlectric.bearing.rating_life import life_summary
from ehlectric.bearing.solution import (
    BearingSolution,
    bearing_state,
    capacitance,
    conducts,
    film_error,
    former_state,
    insulating,
    lambda_ratio,
    lubrication_state,
    plate_capacitance,
)
from ehlectric.bearing.warnings import bearing_warnings
from ehlectric.discharge.discharge_laws import conductivity_of, known
from ehlectric.quantities.former_keys import with_former_keys
from ehlectric.quantities.result_warnings import ResultWarning, texts_and_codes
from ehlectric.quantities.results import BEARING_KEYS
from ehlectric.runtime.files import plain

SUMMARY_SCHEMA = "ehlectric.bearing/1"

_PARTS_OF_FILM_FACTOR = ("heat_factor", "inlet_shear_factor", "supply_factor")
_VOLTAGES = tuple(field.name for field in dataclasses.fields(Breakdown))


def summary_of(solution: BearingSolution, warnings: Sequence[ResultWarning] | None = None) -> dict[str, Any]:
    """Results of a bearing nested as in summary.json, SI units; None instead of NaN.

    The verdict and the analysis of the margin are omitted, because they solve further bearings. ``warnings``,
    warnings about the bearing, where they are known.
    """
    case, duty = solution.case, duty_of(solution)
    summary: dict[str, Any] = plain(
        {
            "schema": SUMMARY_SCHEMA,
            "version": solution.version,
            "title": case.title,
            "converged": solution.converged,
            **texts_and_codes(bearing_warnings(solution) if warnings is None else warnings),
            "inputs": case.all_inputs(),
            **tables_of(solution, duty),
            "contacts": contact_rows(solution, duty),
            "seconds": solution.seconds,
        }
    )
    return summary


def tables_of(solution: BearingSolution, duty: BearingDuty | None = None) -> dict[str, dict[str, Any]]:
    """Tables ``lubricant``, ``bearing``, ``mechanics`` and ``life`` of summary.json, numbers and texts of
    shape (...); None for what no point has. ``duty`` is the duty cycle of the solution, where it is known.
    """
    case, conditions, oil = solution.case, solution.conditions, solution.case.lubricant.temperature
    return {
        "lubricant": {
            **conditions.oil.summary(),
            **_of_rings(conditions),
            "expansion": None if oil is None else oil.expansion,
            "conductivity": conductivity_of(case.discharge, conditions.oil),
            "film_factor": conditions.film_factor,
        },
        "bearing": with_former_keys(
            clearances_of(conditions) | _totals(solution, duty or duty_of(solution)), "bearing", BEARING_KEYS
        ),
        "mechanics": mechanics_of(solution.positions[0].equilibrium),
        "life": life_summary(solution),
    }


def _of_rings(conditions: BearingConditions[Any]) -> dict[str, Numbers]:
    """Temperatures [K], viscosities [Pa s] and film factors of the oil in the contacts with both rings."""
    values = {}
    for name, ring in zip(("inner", "outer"), conditions.rings, strict=True):
        values[f"{name}_temperature"] = ring.temperature
        values[f"{name}_viscosity"] = ring.oil.viscosity
        values[f"{name}_film_factor"] = ring.film_factor
    return values


def clearances_of(conditions: BearingConditions[Any]) -> dict[str, Numbers | None]:
    """Clearances, interferences [m] and pressures of the fits [Pa] as in summary.json; None without fits."""
    fits = ("shaft_interference", "housing_interference", "shaft_pressure", "housing_pressure")
    clearance = conditions.clearance
    running = None if clearance is None else clearance.running
    clearances = {name: getattr(running, name, None) for name in fits}
    return {
        "unmounted_clearance": None if clearance is None else clearance.unmounted,
        "mounted_clearance": None if clearance is None else clearance.mounted.clearance,
        "running_clearance": conditions.geometry.clearance,
        **{f"running_{name}" if name.endswith("interference") else name: clearances[name] for name in fits},
    }


def _totals(solution: BearingSolution, duty: BearingDuty) -> dict[str, Any]:
    """Capacitances, voltages and error estimates of the whole bearing."""
    films, plate = capacitance(solution), plate_capacitance(solution)
    strength, shaft, across = strength_per_volt(solution), shaft_voltage(solution), film_voltage(solution)
    leaks, rough = shaft_leakage(solution), rough_capacitance(solution)
    errors = [curve.error for curve in solution.curves]
    stated = solution.case.contacts != "atlas" and not any(np.any(np.isnan(error)) for error in errors)
    return {
        "contacts": solution.case.contacts,
        "capacitance": films,
        "capacitance_oil": capacitance(solution, "oil"),
        "capacitance_air": capacitance(solution, "air"),
        "capacitance_plate": plate,
        "capacitance_ratio": None if plate is None else films / plate,
        "capacitance_rough": rough,
        "roughness_factor": None if rough is None else rough / films,
        **_outside(solution, rough),
        "lambda_ratio": lambda_ratio(solution),
        "lubrication_state": (state := bearing_state(solution)),
        "lubrication": former_state(state, conducting=conducts(solution)),
        **duty_summary(solution, duty),
        "film_factor": solution.conditions.film_factor,
        **{name: solution.conditions.part_of_film_factor(name) for name in _PARTS_OF_FILM_FACTOR},
        "film_half_time": half_time(solution),
        **friction_summary(solution),
        **(broken := breaks(solution)),
        "breakdown_probability": _breakdown_probability(solution, broken["margin"]),
        "strength_per_volt": strength,
        "max_strength": known(mul, strength, across),
        "bearing_voltage_ratio": bearing_voltage_ratio(solution),
        "shaft_voltage": shaft,
        "film_voltage": across,
        **ceramic_summary(solution),
        "relaxation_time": oil_relaxation_time(solution),
        "shaft_time_constant": None if leaks is None else leaks.time_constant,
        "film_time_constant": None if leaks is None else leaks.film_time_constant,
        "switching_period": known(truediv, 1.0, getattr(solution.case.motor, "switching_frequency", None)),
        "shaft_voltage_after_period": known(mul, shaft, getattr(leaks, "after_period", None)),
        "film_voltage_after_period": known(mul, across, getattr(leaks, "film_after_period", None)),
        "shaft_voltage_after_rise": known(mul, shaft, getattr(leaks, "after_rise", None)),
        "edge_current": edge_current(solution),
        **dataclasses.asdict(bearing_costs(solution)),
        "discretisation_error": max(float(np.max(error)) for error in errors) if stated else None,
        "film_error": film_error(solution),
        "interpolation_error": np.maximum(
            *(np.asarray(curve.interpolation_error) for curve in solution.curves)
        ),
    }


def _outside(solution: BearingSolution, rough: Numbers | None) -> dict[str, Any]:
    """Coating and parallel capacitance, and the capacitances from shaft to housing."""
    path, share, shaft = shaft_path(solution), film_share(solution), shaft_voltage(solution)
    return {
        "coating_capacitance": path.coating if path.coated else None,
        "coating_breakdown": path.coating_breakdown,
        "coating_margin": known(truediv, path.coating_breakdown, shaft),
        "film_share": share,
        "coating_share": None if share is None or not path.coated else 1.0 - share,
        "parallel_capacitance": path.parallel,
        "shaft_capacitance": shaft_capacitance(solution),
        "meter_capacitance": meter_reading(solution, rough),
    }


def breaks(solution: BearingSolution) -> dict[str, Any]:
    """Breakdown voltages over the positions of the cage [V], and their ratios to the shaft voltage.

    Values are None where there is no breakdown voltage or no shaft voltage.
    """
    breakdown, shaft = breakdown_of(solution), shaft_voltage(solution)
    if breakdown is None:
        return dict.fromkeys((*_VOLTAGES, "margin", "ring_to_ring_margin"))
    return dataclasses.asdict(breakdown) | {
        "margin": known(truediv, breakdown.shaft_first_break, shaft),
        "ring_to_ring_margin": known(truediv, breakdown.shaft_ring_to_ring_breakdown, shaft),
    }


def _breakdown_probability(solution: BearingSolution, ratio: Numbers | None) -> Numbers | None:
    """Probability that a contact has broken down at the shaft voltage, from the margin and a Weibull law.

    It is 1 - exp(-(V/V_1)^m) with the shape m, the shaft voltage V and the voltage of the first breakdown at
    63.2 %, V_1. None where there is no margin, or the strength does not scatter.
    """
    shape = solution.positions[0].shape
    if shape is None or ratio is None:
        return None
    # From this exponent on the probability is 1 to the last digit.
    exponent = np.minimum(-shape * np.log(ratio), 10.0)
    return -np.expm1(-np.exp(exponent))


def contact_rows(solution: BearingSolution, duty: BearingDuty | None = None) -> list[dict[str, Any]]:
    """Table of contacts, a row per element and ring, with the cage at its first position, SI units.

    ``duty`` is the duty cycle of the solution, where it is already known.
    """
    position, circuit, across = solution.positions[0], solution.circuits()[0], film_voltage(solution)
    at, insulates, ceramic = position.equilibrium, insulating(solution), solution.conditions.ceramic
    bearing = solution.case.bearing
    fill, rq, height = bearing.fill, bearing.composite_rq, bearing.summit_height
    inner_duty, outer_duty = (duty or duty_of(solution)).rings[0]
    inner_share, rows = position.inner_share(circuit), []
    for k in range(at.position.size):
        for name, ring, share, asperities in (
            ("inner", position.inner, inner_share, inner_duty),
            ("outer", position.outer, 1.0 - inner_share, outer_duty),
        ):
            values, part = ring.values, ring.part_left(solution.summits)[k]
            ratio = values.minimum_thickness[k] / rq
            strength = share[k] * values.strength_per_volt[k] / part if insulates else None
            of_film = part * values.breakdown_voltage[k] if insulates else None
            rows.append(
                {
                    "element": k,
                    "ring": name,
                    "position": at.position[k],
                    "load": ring.load[k],
                    "contact_angle": at.ring(inner=name == "inner").angle[k],
                    "max_pressure": values.max_pressure[k] or None,
                    "semi_axis_x": values.semi_axis_x[k] or None,
                    "semi_axis_y": values.semi_axis_y[k] or None,
                    "minimum_thickness": values.minimum_thickness[k],
                    "central_thickness": values.central_thickness[k],
                    "lambda_ratio": ratio,
                    "lubrication_state": (state := lubrication_state(ratio, height, loaded=ring.solved[k])),
                    "regime": former_state(state),
                    **contact_duty(asperities, k),
                    "capacitance": None if ceramic else ring.capacitance(fill)[k],
                    "voltage_share": share[k] if insulates else None,
                    "strength_per_volt": strength,
                    "max_strength": known(mul, strength, across),
                    "breakdown_voltage": of_film,
                    "bearing_breakdown_voltage": known(truediv, of_film, share[k]),
                    "solved": bool(ring.solved[k]),
                }
            )
    return [plain(row) for row in rows]
