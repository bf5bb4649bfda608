"""Gear pairs whose geometry and pressures are published."""

import math

from ehlectric.cases.gear_case import GearCase
from ehlectric.gear.contact_lines import PlaneOfAction
from ehlectric.gear.contact_path import contact_path
from ehlectric.gear.geometry import Drawing, gear_pair

DEGREE = math.pi / 180.0

# Test gears of the FZG rig: ISO 14635-1 (type A) and FVA information sheet 54 (type C).
FZG_A = Drawing(4.5e-3, (16, 24), 20.0 * DEGREE, 0.0, 20e-3, 91.5e-3, (0.8532, -0.5), (88.77e-3, 112.5e-3))
FZG_C = Drawing(4.5e-3, (16, 24), 20.0 * DEGREE, 0.0, 14e-3, 91.5e-3, (0.1817, 0.1715), (82.46e-3, 118.36e-3))

# Two helical stages of an e-axle.
FIRST_STAGE = Drawing(
    1.75e-3, (23, 67), 20.0 * DEGREE, 25.0 * DEGREE, 25e-3, 87e-3, (0.3, None), (48.96e-3, 132.04e-3)
)
SECOND_STAGE = Drawing(
    2.5e-3, (19, 73), 20.0 * DEGREE, 18.0 * DEGREE, 38e-3, 121.5e-3, (0.25, None), (56.19e-3, 196.82e-3)
)


def plane_of(drawing):
    """Plane of action of a drawing."""
    pair = gear_pair(drawing)
    return PlaneOfAction(contact_path(pair), pair.face_width)


# Gears type C of the FZG rig at a load of 215.6 N m, with ground flanks and the oil FVA 3.
FZG_C_CASE = {
    "gear": {
        "normal_module": "4.5 mm",
        "teeth": [16, 24],
        "normal_pressure_angle": "20 deg",
        "centre_distance": "91.5 mm",
        "profile_shift": [0.1817, 0.1715],
        "face_width": "14 mm",
        "tip_diameter": ["82.46 mm", "118.36 mm"],
        "flank_ra": "0.3 um",
        "material": "steel",
        "operation": {
            "pinion_torque": "215.6 N m",
            "pinion_speed": "2170 rpm",
            "oil_temperature": "90 degC",
            "bulk_temperature": "90 degC",
        },
    },
    "lubricant": {"base": "fva-3"},
    "discharge": {"dielectric_strength": "15 V/um"},
}


def case_of(**changes):
    """Case of FZG type C with changes by dotted key, a double underscore for each dot."""
    dotted = {"gear." + key.replace("__", "."): value for key, value in changes.items()}
    return GearCase.from_dict(FZG_C_CASE).replace(dotted)
