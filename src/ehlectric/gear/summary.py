"""Key figures of a gear pair, nested as in summary.json."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from ehlectric.discharge.discharge_laws import stored_energy
from ehlectric.gear.forces_on_shafts import mesh_forces
from ehlectric.gear.gear_verdict import breakdown_margin, state_of
from ehlectric.gear.iso_film import lambda_gf
from ehlectric.gear.losses import loss_factor
from ehlectric.gear.places_of_breakdown import discharge_places
from ehlectric.gear.points import name_of_place, weakest
from ehlectric.gear.solution import AREA_FACTOR, GearSolution
from ehlectric.quantities.lubrication_states import CONDUCTS

# Share of the breakdowns for which the part of the flank is stated.
_MOST = 0.9


def gear_summary(solution: GearSolution) -> dict[str, Any]:
    """Tables ``gear``, ``mesh`` and ``points`` of summary.json, SI units; None for what is not known."""
    return {
        "gear": _gear(solution),
        "mesh": _mesh(solution),
        "points": point_summaries(solution),
    }


def _gear(solution: GearSolution) -> dict[str, Any]:
    """Geometry, load and loss of the pair."""
    pair, path, plane = solution.pair, solution.path, solution.plane
    gear = solution.case.gear
    operation = gear.operation
    friction, power = operation.friction_coefficient, abs(operation.pinion_torque) * operation.pinion_speed
    factor, forces = (
        loss_factor(pair, path),
        mesh_forces(pair, operation.pinion_torque, gear.hand),
    )
    least, most = plane.extreme_lengths
    return {
        "ratio": pair.ratio,
        "centre_distance": abs(pair.centre_distance),
        "working_pressure_angle": pair.working_pressure_angle,
        "base_helix_angle": pair.base_helix_angle,
        "profile_shift_1": pair.profile_shift[0],
        "profile_shift_2": pair.profile_shift[1],
        "tip_diameter_1": pair.tip_diameter[0],
        "tip_diameter_2": abs(pair.tip_diameter[1]),
        "normal_backlash": pair.normal_backlash,
        "transverse_contact_ratio": path.contact_ratio,
        "overlap_ratio": plane.overlap_ratio,
        "total_contact_ratio": path.contact_ratio + plane.overlap_ratio,
        "contact_length": plane.mean_length,
        "contact_length_low": least,
        "contact_length_high": most,
        "pitch_line_speed": 0.5 * pair.working_diameter[0] * operation.pinion_speed,
        "mesh_frequency": pair.teeth[0] * operation.pinion_speed / (2.0 * math.pi),
        "power": power,
        "normal_force": solution.normal_force,
        "load_factor": operation.load_factor,
        "tangential_force": forces.tangential,
        "radial_force": forces.radial,
        "axial_force": forces.axial,
        "pair_stiffness": solution.stiffness,
        "bulk_temperature": solution.bulk_temperature,
        "loss_factor": factor,
        "loss": None if friction is None else friction * solution.sliding_power,
        "film_loss": solution.film_loss,
        "asperity_loss": solution.asperity_loss,
    }


def _mesh(solution: GearSolution) -> dict[str, Any]:
    """Film, contact, capacitance and breakdown of the mesh."""
    films, capacitance = solution.films, solution.capacitance
    voltage = solution.breakdown_voltage
    thinnest = solution.minimum_film
    place, across = weakest(solution)
    loads = solution.loads
    mean = loads.mean(capacitance)
    state = state_of(solution)
    if state == CONDUCTS:
        voltage = None
    over_phase = None if voltage is None else solution.breakdown_voltage_over_phase
    # Summits that touch leave no film to break down.
    first = None if voltage is None else float(np.min(voltage)) or None
    where = None if first is None else discharge_places(solution)
    relaxation = solution.relaxation_time
    low, high = (loads.mean(solution.contact_time_share(f)) for f in (AREA_FACTOR, 1.0 / AREA_FACTOR))
    return {
        "state": state,
        "minimum_thickness": thinnest,
        "minimum_at": name_of_place(solution, place),
        "minimum_place": place,
        "minimum_across": across,
        "heat_factor": float(films.heat_factor[solution.thinnest]),
        "film_error": solution.film_error,
        "composite_rq": solution.rq,
        "lambda_ratio": thinnest / solution.rq,
        "lambda_gf": lambda_gf(solution),
        "max_pressure": float(np.nanmax(films.max_pressure)),
        "contact_area": loads.mean(loads.along(2.0 * films.half_width)),
        "contact_time_share": solution.mean_contact_share,
        "contact_time_share_low": low,
        "contact_time_share_high": high,
        "capacitance": mean,
        "capacitance_low": float(np.min(capacitance)),
        "capacitance_high": float(np.max(capacitance)),
        "back_capacitance": None if solution.pair.normal_backlash is None else solution.back_capacitance,
        "breakdown_voltage": first,
        "breakdown_voltage_high": None if over_phase is None else float(np.max(over_phase[1])) or None,
        "smooth_breakdown_voltage": solution.smooth_breakdown_voltage,
        "discharge_area_share": None if where is None else where.area_share(_MOST),
        "discharge_root_share": None if where is None else where.before(solution.path.pitch_point),
        "voltage": solution.case.gear.contact.voltage,
        "margin": breakdown_margin(solution),
        "relaxation_time": relaxation,
        "discharge_energy": None if first is None else float(stored_energy(mean, first)),
    }


def point_summaries(solution: GearSolution) -> dict[str, dict[str, float | None]]:
    """Radii, speeds, load and film at the points A to E of the path of contact; None for what needs a load
    where none passes the point.
    """
    films, path = solution.point_films, solution.path
    places = films.places
    first, second = path.transverse_radii(places)
    speeds = path.speeds(places, solution.flanks.pinion_speed, solution.pair.ratio)
    columns = {
        "place": places,
        "radius_1": first,
        "radius_2": second,
        "reduced_radius": films.reduced_radius,
        "speed_1": speeds[0],
        "speed_2": speeds[1],
        "slide_to_roll_ratio": films.slide_to_roll_ratio,
        "load_per_length": np.where(np.isnan(films.load), 0.0, films.load),
        "max_pressure": films.max_pressure,
        "central_thickness": films.central,
        "minimum_thickness": films.minimum,
        "lambda_ratio": films.minimum / solution.rq,
        "friction": films.friction,
    }
    values = np.stack([np.asarray(column) for column in columns.values()], axis=1)
    objects = values.astype(object)
    objects[np.isnan(values)] = None
    rows = objects.tolist()
    return {name: dict(zip(columns, row, strict=True)) for name, row in zip(path.points, rows, strict=True)}
