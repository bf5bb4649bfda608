"""Cases of contacts with heat and shear in their films.

The oil is that of the paper with the law of Roelands over temperature; thermal conductivities of 0.14 and
46 W/(m K) are those of usual mineral oils and of bearing steel.
"""

OIL = {
    "base": "paper",
    "viscosity": 0.04,
    "atmospheric_law": "roelands",
    "roelands_s0": 1.1,
    "reference_temperature": 313.15,
    "density": 870.0,
    "thermal_expansion": 6.5e-4,
    "thermal_conductivity": 0.14,
    "heat_capacity": 2000.0,
    "eyring_stress": 5e6,
}
STEEL = {"material": "steel"}
HOT_LINE = {
    "contact": {
        "reduced_radius": 0.0141,
        "reduced_modulus": 226e9,
        "max_hertz_pressure": 0.6e9,
        "entrainment_speed": 3.0,
        "slide_to_roll_ratio": 0.1,
        "temperature": 313.15,
        "body_1": STEEL,
        "body_2": STEEL,
    },
    "lubricant": OIL,
    "film": {"thermal": True, "rheology": "eyring"},
    "grid": {"nodes": 201, "inlet": -6.5},
}
HOT_POINT = HOT_LINE | {
    "contact": {
        "geometry": "point",
        "radius_x": 0.01,
        "radius_y": 0.01,
        "reduced_modulus": 226e9,
        "max_hertz_pressure": 0.6e9,
        "entrainment_speed": 3.0,
        "slide_to_roll_ratio": 0.1,
        "temperature": 313.15,
        "body_1": STEEL,
        "body_2": STEEL,
    },
    "grid": {"nodes": 65},
}
