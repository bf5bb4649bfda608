"""Gear pairs for tests: cases with superfinished or ground flanks."""

from ehlectric import GearCase

STRENGTH = {"dielectric_strength": "15 V/um"}

# FZG type C by FVA information sheet 54, at its load stage 8.
SPUR = {
    "title": "FZG type C",
    "gear": {
        "normal_module": "4.5 mm",
        "teeth": [16, 24],
        "normal_pressure_angle": "20 deg",
        "face_width": "14 mm",
        "centre_distance": "91.5 mm",
        "profile_shift": [0.1817, 0.1715],
        "tip_diameter": ["82.46 mm", "118.36 mm"],
        "normal_backlash": "100 um",
        "flank_ra": ["0.02 um"],
        "material": "steel",
        "operation": {
            "pinion_torque": "215.6 N m",
            "pinion_speed": "2250 rpm",
            "oil_temperature": "90 degC",
            "bulk_temperature": "90 degC",
        },
        "contact": {"voltage": "3 V"},
    },
    "lubricant": {"base": "fva-3"},
    "discharge": STRENGTH,
}

# First stage of an e-axle.
HELICAL = {
    "title": "First stage",
    "gear": {
        "normal_module": "1.75 mm",
        "teeth": [23, 67],
        "normal_pressure_angle": "20 deg",
        "helix_angle": "25 deg",
        "face_width": "25 mm",
        "centre_distance": "87 mm",
        "profile_shift": [0.3],
        "tip_diameter": ["48.96 mm", "132.04 mm"],
        "flank_ra": ["0.3 um"],
        "material": "steel",
        "operation": {
            "pinion_torque": "150 N m",
            "pinion_speed": "12000 rpm",
            "oil_temperature": "80 degC",
            "bulk_temperature": "95 degC",
        },
    },
    "lubricant": {"base": "e-axle-fluid"},
    "discharge": STRENGTH,
}

# Relief and crowning with which the flanks carry no load at both ends of the path and of the face.
RELIEVED = {
    "gear.tip_relief": ["80 um"],
    "gear.tip_relief_length": "4 mm",
    "gear.lead_crowning": "30 um",
    "gear.operation.pinion_torque": "-60 N m",
}


def spur_case(**changes):
    return GearCase.from_dict(SPUR).replace(changes)


def helical_case(**changes):
    return GearCase.from_dict(HELICAL).replace(changes)
