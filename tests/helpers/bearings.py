"""Bearing files that tests change: a 6208 and an invented roller bearing; contacts with their rings."""

import copy
import dataclasses

import numpy as np

from ehlectric.bearing.bearing_kinds import kind_of
from ehlectric.bearing.preparation import resolve_bearing
from ehlectric.bearing.quick_contacts import QUICK_METHODS, quick_curve
from ehlectric.bearing.ring_contacts import ContactSolution, ContactValues, RingContacts, solve
from ehlectric.bearing.summary import summary_of
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.cases.case import Case
from ehlectric.cases.grid_inputs import Solver

OIL = {
    "base": "paper",
    "temperature": {
        "kinematic_viscosity_40": "46 mm^2/s",
        "kinematic_viscosity_100": "6.8 mm^2/s",
        "density_15": "870 kg/m^3",
    },
}
DUTY = {
    "inner_speed": "3000 rpm",
    "temperature": "70 degC",
    "composite_rq": "0.03 um",
    "film_factor": "none",
}
OTHERS = {
    "lubricant": OIL,
    "discharge": {"dielectric_strength": "15 V/um", "conductivity": "1 pS/m"},
    "motor": {
        "common_mode_voltage": "300 V",
        "winding_rotor_capacitance": "20 pF",
        "rotor_frame_capacitance": "1 nF",
    },
}

# A 6208 of the catalogue at a point of operation, in SI units.
BALLS_IN_SI = {
    "base": "6208",
    "radial_clearance": 1e-5,
    "radial_load": 1000.0,
    "inner_speed": 314.0,
    "temperature": 343.15,
    "composite_rq": 3e-8,
}

# Groove radii of ISO 76, clearance within the class CN of ISO 5753.
BALLS = {
    "bearing": DUTY
    | {
        "kind": "deep-groove ball",
        "elements": 9,
        "element_diameter": "11.906 mm",
        "pitch_diameter": "60 mm",
        "inner_groove": 0.52,
        "outer_groove": 0.52,
        "shoulder_height": 0.2,
        "radial_clearance": "10 um",
        "radial_load": "1800 N",
        "axial_load": "300 N",
    },
    **OTHERS,
}

# About the size of an NU 208. Its internal geometry is not published, so the values are invented.
ROLLERS = {
    "bearing": DUTY
    | {
        "kind": "cylindrical roller",
        "elements": 14,
        "element_diameter": "11 mm",
        "pitch_diameter": "60 mm",
        "roller_length": "10 mm",
        "profile": "logarithmic",
        "radial_clearance": "20 um",
        "radial_load": "3 kN",
    },
    **OTHERS,
}


def changed(tables, **changes):
    """Copy of nested tables with changed values; ``bearing__fill`` names a key, and None removes it."""
    copied = copy.deepcopy(tables)
    for key, value in changes.items():
        *path, last = key.split("__")
        table = copied
        for name in path:
            table = table.setdefault(name, {})
        if value is None:
            table.pop(last, None)
        else:
            # A later key may change a given table, which belongs to the caller.
            table[last] = copy.deepcopy(value)
    return copied


def bearing_case(tables, **changes):
    """Bearing case of tables with changed values."""
    return BearingCase.from_dict(changed(tables, **changes))


def ring_of(case, *, inner=True, angle=0.0, speed):
    """Contacts of a bearing with one ring, at a contact angle [rad] and an entrainment speed [m/s]."""
    return RingContacts(resolve_bearing(case), inner, angle, speed)


def contact_of(ring, load):
    """Contact with a ring at a load [N]."""
    return kind_of(ring).contact(ring, load)


def contact_case(ring, load, solver):
    """Case that a user would write of a contact with a ring at a load [N], with isothermal, flooded oil."""
    conditions, radii = ring.conditions, ring.radii
    assert conditions.film_factor == 1.0
    contact = {"body_1": elastic(conditions.ring), "body_2": elastic(conditions.element)}
    length, discharge = conditions.bearing.roller_length, {}
    if length is None:
        contact |= {"geometry": "point", "load": load}
        contact["body_1"] |= {"radius_x": radii.ring_x, "radius_y": radii.ring_y}
        contact["body_2"] |= {"radius_x": radii.element_x, "radius_y": radii.element_y}
    else:
        contact |= {"radius_1": radii.ring_x, "radius_2": radii.element_x, "load_per_length": load / length}
        discharge = {"length": length}
    oil = {key: value for key, value in conditions.oil.inputs.items() if key != "base"}
    return Case.from_dict(
        {
            "contact": contact | {"entrainment_speed": ring.speed, "temperature": conditions.oil.temperature},
            "lubricant": {**oil, "ambient_pressure": 0.0},
            "grid": contact_of(ring, load).grid.model_dump(exclude_none=True),
            "discharge": conditions.discharge.model_dump(exclude_none=True) | discharge,
            "solver": solver,
        }
    )


def elastic(solid):
    """Elastic constants of a body of a case."""
    return {"youngs_modulus": solid.youngs_modulus, "poissons_ratio": solid.poissons_ratio}


def solve_contact(ring, load, solver):
    """Solution of a contact with a ring at a load [N], with the values of a table ``[solver]``."""
    return solve(contact_of(ring, load), Solver.from_dict(solver))


def formula_contact(ring, load):
    """Contact with a ring at a load [N], computed by film formulas."""
    return quick_contact(ring, load, "formula")


def rigid_capacitance(ring, gap):
    """Capacitance in vacuum [F] of an element and a ring, rigid and a gap [m] apart."""
    return kind_of(ring).rigid_capacitance(ring, gap)


def contact_solution(**numbers):
    """Invented solution of a contact from all of its attributes; half of ``inside`` is the Hertz area's."""
    names = {field.name for field in dataclasses.fields(ContactValues)}
    numbers.setdefault("hertz", 0.5 * numbers["inside"])
    values = ContactValues(**{name: numbers.pop(name) for name in names})
    return ContactSolution(values=values, **numbers)


def with_values(one, **values):
    """Copy of a contact, or of the contacts with a ring, with other values."""
    return dataclasses.replace(one, values=dataclasses.replace(one.values, **values))


def quick_contact(ring, load, way):
    """Contact with a ring at a load [N] without solving it: "atlas" or "formula"."""
    (found,) = quick_curve(QUICK_METHODS[way](contact_of(ring, np.array([load])))).solutions
    return found


def numbers_of(result):
    """Summary of a bearing without its margin, whose analysis solves the bearing some twenty times."""
    return summary_of(result.solution)
