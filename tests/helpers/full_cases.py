"""Cases of every kind that together contain every key which their files accept: a table, and changes of it."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import Any

from tests.axle.axles import ALONE
from tests.helpers.drives import MOTOR as DRIVE_MOTOR
from tests.helpers.gears import HELICAL
from tests.helpers.input_keys import merged
from tests.helpers.kinds_of_bearings import DISCHARGE, KINDS, MOTOR, OIL, POINT
from tests.helpers.moving_cases import TABLES as MOVING

Tables = dict[str, Any]

_LINE = {
    "title": "contact",
    "contact": {
        "geometry": "line",
        "reduced_radius": "14.1 mm",
        "reduced_modulus": "226 GPa",
        "max_hertz_pressure": "0.6 GPa",
        "entrainment_speed": "1 m/s",
        "temperature": "60 degC",
    },
    "lubricant": {"base": "fva-3"},
    "electric": {"potential_1": -1.0, "potential_2": 2.0},
    "discharge": {"dielectric_strength": "15 V/um", "conductivity": "1 nS/m"},
    "grid": {"nodes": 257, "field_degree": 3},
}
_POINT = merged(
    _LINE,
    {
        "contact": {"geometry": "point", "reduced_radius": None, "radius_x": "10 mm", "radius_y": "15 mm"},
        "grid": {"nodes": 65, "nodes_y": 65, "field_nodes": 33, "field_nodes_y": 33},
    },
)
_BODIES = {
    "contact": {
        "reduced_modulus": None,
        "body_1": {"youngs_modulus": "210 GPa", "poissons_ratio": 0.3},
        "body_2": {"youngs_modulus": "300 GPa", "poissons_ratio": 0.25},
    }
}
_DISCHARGE = {
    "conductivity": "1 nS/m",
    "external_capacitance": "1 nF",
    "peak_current": "1 A",
    "pit": {"efficiency": 0.2, "melting_energy": "10 GJ/m^3"},
    "outlet": "fingers",
}
_LENGTH = {"discharge": {"length": "10 mm"}}

# Other ways to state the dielectric strength.
STRENGTHS: tuple[Tables, ...] = (
    {"strength_table": {"pressure": ["1 kPa", "3 GPa"], "strength": ["10 V/um", "40 V/um"]}},
    {
        "strength_table": {"temperature": ["10 degC", "150 degC"], "strength": ["20 V/um", "10 V/um"]},
        "temperature": "60 degC",
    },
    {"weibull": {"scale": "20 V/um", "shape": 5.0, "reference_area": "1 mm^2"}},
)

_SHEET = {"density_15": "870 kg/m^3", "expansion": 6.5e-4, "thermal_conductivity": "0.137 W/m/K"}
_FIXED = {
    "viscosity_law": "roelands",
    "pressure_viscosity_coefficient": "20 1/GPa",
    "roelands_z": 0.6,
    "roelands_pressure": "0.198 GPa",
    "density_law": "dowson-higginson",
    "density_c1": "0.59 GPa",
    "density_c2": 1.34,
    "permittivity_law": "clausius-mossotti",
    "relative_permittivity": 2.2,
    "ambient_pressure": "0.2 MPa",
}
_TAIT = {
    "tait_k0_prime": 10.545,
    "tait_k00": "9.234 GPa",
    "tait_beta_k": 6.09e-3,
    "tait_expansion": 7.734e-4,
    "reference_temperature": "25 degC",
}
_MURNAGHAN = {
    "density_law": "murnaghan",
    "murnaghan_k0_prime": 10.5,
    "murnaghan_k00": "9 GPa",
    "murnaghan_beta_k": 6e-3,
    "murnaghan_expansion": 7.7e-4,
    "reference_temperature": "25 degC",
}
_YASUTOMI = {
    "viscosity_law": "yasutomi",
    "yasutomi_glass_viscosity": 1e12,
    "yasutomi_glass_temperature": 189.95,
    "yasutomi_a1": 188.86,
    "yasutomi_a2": 7.19e-10,
    "yasutomi_b1": 8.2e-9,
    "yasutomi_b2": -0.5278,
    "yasutomi_c1": 16.09,
    "yasutomi_c2": 17.38,
}
_DOOLITTLE = {
    "viscosity_law": "doolittle",
    "doolittle_viscosity": 0.02,
    "doolittle_b": 4.422,
    "doolittle_r0": 0.6694,
    "doolittle_epsilon": -9.599e-4,
}

# Oils that together have the parameters of all laws.
OILS: list[Tables] = [
    {"base": "iso-vg-46", "temperature_range": ["-10 degC", "110 degC"]},
    {**_FIXED, "temperature": {**_SHEET, "iso_vg": 46, "viscosity_index": 97.0}},
    {
        **_FIXED,
        "temperature": {
            **_SHEET,
            "kinematic_viscosity_40": "46 mm^2/s",
            "kinematic_viscosity_100": "6.8 mm^2/s",
        },
    },
    {
        **{
            key: value
            for key, value in _FIXED.items()
            if key not in ("pressure_viscosity_coefficient", "roelands_z")
        },
        "temperature": {
            **_SHEET,
            "base_oil": "pao",
            "kinematic_viscosity_1": "50 mm^2/s",
            "temperature_1": "35 degC",
            "dynamic_viscosity_2": "7 mPa s",
            "temperature_2": "90 degC",
        },
    },
    {
        **_FIXED,
        "temperature": {
            **_SHEET,
            "dynamic_viscosity_1": "50 mPa s",
            "temperature_1": "35 degC",
            "kinematic_viscosity_2": "8 mm^2/s",
            "temperature_2": "90 degC",
        },
    },
    {
        **_FIXED,
        "atmospheric_law": "vogel",
        "vogel_viscosity": 6.2e-5,
        "vogel_b": 1021.7,
        "vogel_c": 171.6,
        "density": "863 kg/m^3",
        "thermal_expansion": 7.4e-4,
        "reference_temperature": "40 degC",
        "thermal_conductivity": "0.134 W/m/K",
        "conductivity_table": {"temperature": ["20 degC", "120 degC"], "conductivity": ["1 nS/m", "50 nS/m"]},
    },
    {
        **_FIXED,
        "relative_permittivity": None,
        "permittivity_table": {"temperature": ["20 degC", "120 degC"], "relative_permittivity": [2.4, 2.1]},
        "atmospheric_law": "roelands",
        "viscosity": "50 mPa s",
        "roelands_s0": 1.1,
        "reference_temperature": "40 degC",
        "density": "863 kg/m^3",
        "thermal_expansion": 7.4e-4,
        "conductivity_law": "arrhenius",
        "conductivity": "1 nS/m",
        "conductivity_activation": "40 kJ/mol",
        "conductivity_temperature": "40 degC",
    },
    {
        "base": "fva-3",
        "modulus_a1": -4.8e7,
        "modulus_a2": 2.99e5,
        "modulus_b1": -0.0778,
        "modulus_b2": 3.01e-4,
        "conductivity_law": "constant",
        "conductivity": "1 nS/m",
    },
    {"base": "shell-t9", **_YASUTOMI, **_TAIT, "relative_permittivity": 2.2},
    {**_FIXED, **_MURNAGHAN, "viscosity": "20 mPa s"},
    {"base": "shell-t9", "relative_permittivity": 2.2, **_TAIT, **_DOOLITTLE},
    {
        "base": "fva-3",
        "viscosity_table": {
            "pressure": [1e5, 1e8, 2e8, 1e5, 1e8, 2e8],
            "temperature": [313.15, 313.15, 313.15, 353.15, 353.15, 353.15],
            "viscosity": [0.08, 0.5, 3.0, 0.02, 0.08, 0.3],
        },
    },
]

# Oils with a measured table in a file.
OILS += [
    {
        "base": "fva-3",
        "viscosity_table": {
            "file": "pressure [MPa],temperature [degC],viscosity [mPa s]\n0.1,40,80\n100,40,500\n200,40,3000\n0.1,80,20\n100,80,80\n200,80,300\n"
        },
    },
]

# Oils with the parameters of heat and shear.
HOT_OILS: tuple[Tables, ...] = (
    {
        "base": "iso-vg-46",
        "heat_capacity_law": "constant",
        "heat_capacity": "2000 J/kg/K",
        "temperature": {"thermal_conductivity": "0.14 W/m/K"},
    },
    {
        "base": "fva-3",
        "thermal_conductivity_law": "larsson",
        "thermal_conductivity": "0.14 W/m/K",
        "larsson_c1": "1.54 1/GPa",
        "larsson_c2": "0.33 1/GPa",
        "heat_capacity_law": "larsson",
        "volumetric_heat_capacity": 1.71e6,
        "larsson_temperature": "22 degC",
        "larsson_beta": 9.3e-4,
        "larsson_b1": 1.4e-10,
        "larsson_b2": -5.1e-19,
        "larsson_k1": "0.58 1/GPa",
        "larsson_k2": "0.46 1/GPa",
    },
    {
        "base": "shell-t9",
        "relative_permittivity": 2.2,
        "thermal_conductivity_law": "scaling",
        "scaling_k_base": 0.0553,
        "scaling_k_factor": 0.172,
        "scaling_k_exponent": 0.764,
        "scaling_a": -0.115,
        "scaling_q": 2.0,
        "heat_capacity_law": "scaling",
        "scaling_c_base": 1.17e6,
        "scaling_c_factor": 0.39e6,
        "scaling_c_exponent": 5.0,
    },
)
_HOT = {
    "contact": {"slide_to_roll_ratio": 0.5, "temperature": "60 degC"},
    "film": {"thermal": True, "rheology": "eyring"},
}
_STEEL = {"contact": {"body_1": {"material": "steel"}, "body_2": {"material": "steel"}}}


def _of_contacts(base: Tables) -> Iterator[Tables]:
    """Cases of a line or a point contact."""
    point = base["contact"]["geometry"] == "point"
    yield base
    yield merged(
        base,
        {
            "contact": {
                "max_hertz_pressure": None,
                **({"load": "100 N"} if point else {"load_per_length": "100 kN/m"}),
                "entrainment_speed": None,
                "speed_1": "1 m/s",
                "speed_2": "0.8 m/s",
            }
        },
    )
    yield merged(base, _BODIES)
    if point:
        ball, groove = {"radius_x": "10 mm", "radius_y": "10 mm"}, {"radius_x": "50 mm", "radius_y": "-60 mm"}
        yield merged(
            base, {"contact": {"radius_x": None, "radius_y": None, "body_1": ball, "body_2": groove}}
        )
        yield merged(
            base,
            {
                "grid": {
                    "inlet": -5.0,
                    "outlet": 1.6,
                    "side": 4.0,
                    "wedge": "second-order",
                    "field_range": [-1.3, 1.2],
                    "field_side": 1.1,
                }
            },
        )
        yield merged(
            base, {"inlet": {"layer_table": {"y": ["-1 mm", "1 mm"], "thickness": ["150 nm", "180 nm"]}}}
        )
    else:
        yield merged(base, {"contact": {"reduced_radius": None, "radius_1": "20 mm", "radius_2": "-100 mm"}})
        yield merged(
            base,
            {
                "grid": {
                    "inlet": -5.0,
                    "outlet": 2.1,
                    "wedge": "second-order",
                    "field_range": [-1.3, 1.2],
                    "field_nodes": 65,
                }
            },
        )
    yield merged(base, {"grid": {"nodes": None, "nodes_y": None, "error": 0.001, "most_nodes": 401}})
    yield merged(base, {"grid": {"refine": 0.001, "most_nodes": 401}})
    yield merged(base, {"solver": {"tolerance": 1e-7, "max_iterations": 100}})
    length = {} if point else _LENGTH
    yield merged(base, merged({"discharge": _DISCHARGE}, length))
    for strength in STRENGTHS:
        yield merged(merged(base, {"discharge": {"dielectric_strength": None, **strength}}), length)
    yield from _measured(base, point=point)
    yield merged(base, {"inlet": {"oil_layer": "150 nm"}})
    yield merged(base, {"inlet": {"film_ratio": 0.5}})
    yield from _rough(base, point=point)
    for oil in OILS:
        yield merged({**base, "lubricant": oil}, {"discharge": {"conductivity": None}})
    yield from _hot(base)


def _measured(base: Tables, *, point: bool) -> Iterator[Tables]:
    """Contacts in a capacitance meter."""
    length = {"length": "10 mm"}
    coating = {"thickness": "1 um", "relative_permittivity": 9.0, "strength": "100 V/um"}
    yield merged(
        base,
        {
            "meter": {
                "fill": 0.5,
                "parallel_capacitance": "10 pF",
                "rq": "20 nm",
                "coating": coating,
                **length,
            }
        },
    )
    yield merged(base, {"meter": {"oil_radius": "1 mm", "ra": "20 nm", "rq_over_ra": 1.3, "length": "10 mm"}})


def _rough(base: Tables, *, point: bool) -> Iterator[Tables]:
    """Contacts with rough surfaces."""
    across = {"shift_y": "3 um"} if point else {}
    surfaces: list[Tables] = [
        {
            "generator": "sinusoid",
            "amplitude": "30 nm",
            "wavelength": "100 um",
            "phase": 0.5,
            **({"orientation": 10.0} if point else {}),
        },
        {
            "generator": "gaussian",
            "rq": "30 nm",
            "correlation_length": "50 um",
            "seed": 3,
            "form": "line",
            "cutoff_long": "0.2 mm",
            "cutoff_short": "30 um",
            "trim": "10 um",
            "rescale_rq": "20 nm",
            "truncate": "30 nm",
            "extend": "repeat",
        },
        {
            "generator": "gaussian",
            "ra": "30 nm",
            "rq_over_ra": 1.3,
            "correlation_length": "50 um",
            "seed": 3,
            **({"correlation_length_y": "80 um", "orientation": 10.0} if point else {}),
        },
        {
            "generator": "self-affine",
            "rq": "30 nm",
            "hurst": 0.8,
            "rolloff_wavelength": "50 um",
            "shortest_wavelength": "20 um",
            "seed": 3,
        },
        {
            "generator": "pit",
            "depth": "50 nm",
            "width": "100 um",
            "rim": "5 nm",
            "position": "5 um",
            **({"position_y": "3 um"} if point else {}),
        },
        {
            "generator": "asperity",
            "height": "50 nm",
            "width": "100 um",
            "position": "5 um",
            **({"position_y": "3 um"} if point else {}),
        },
    ]
    for surface in surfaces:
        yield merged(base, {"roughness": [{"surface": 1, "shift": "4 um", **surface, **across}]})
    waves = [round(30.0 * math.sin(k / 3.0), 3) for k in range(400)]
    heights = [1e-9 * wave for wave in waves]
    yield merged(base, {"roughness": [{"surface": 2, "heights": heights, "spacing": "5 um"}]})
    rows = [f"{2 * k},{wave}" for k, wave in enumerate(waves)]
    yield merged(
        base, {"roughness": [{"surface": 2, "file": "\n".join(rows), "x_unit": "um", "z_unit": "nm"}]}
    )
    matrix = ["\t".join(f"{wave + row}" for wave in waves[row : row + 200]) for row in range(150)]
    of_map = {"spacing": "5 um", "z_unit": "nm", "line": 3, "along": "column", "direction": "x"}
    if point:
        of_map = {"spacing": "5 um", "spacing_y": "6 um", "z_unit": "nm"}
    yield merged(base, {"roughness": [{"surface": 2, "file": "\n".join(matrix), **of_map}]})
    sinusoid = {"surface": 1, "generator": "sinusoid", "amplitude": "200 nm", "wavelength": "120 um"}
    slow = {"entrainment_speed": "3 mm/s", "slide_to_roll_ratio": 0.3}
    coarse = merged(base, {"contact": slow, "roughness": [sinusoid], "grid": {"nodes": 65}})
    conducts = {"resistivity": "2.2e-7 ohm m", "mean_free_path": "40 nm", "tribofilm_resistance": "1e-12 ohm m^2"}
    touching = {"boundary_film": "2 nm", "boundary_friction": 0.12}
    yield merged(merged(coarse, {} if point else _LENGTH), {"contact": touching, "electric": conducts})
    yield merged(coarse, {"contact": {"hardness": "1 GPa"}})
    if not point:
        across = {"spacing": "5 um", "direction": "y", "assume_transverse": True}
        yield merged(base, {"roughness": [{"surface": 2, "heights": heights, **across}]})


def _hot(base: Tables) -> Iterator[Tables]:
    """Contacts with heat and shear in the film."""
    hot = merged(base, merged(_HOT, _STEEL))
    for oil in HOT_OILS:
        yield {**hot, "lubricant": {**oil, "eyring_stress": "5 MPa"}}
    oil = HOT_OILS[0]
    yield merged(
        {**hot, "lubricant": {**oil, "carreau_stress": "5 MPa", "carreau_exponent": 0.5}},
        {"film": {"rheology": "carreau"}},
    )
    yield merged(
        {**hot, "lubricant": {**oil, "limiting_coefficient": 0.05}}, {"film": {"rheology": "limiting"}}
    )
    solid = {"thermal_conductivity": "40 W/m/K", "heat_capacity": "450 J/kg/K", "density": "7800 kg/m^3"}
    yield merged(
        {**hot, "lubricant": {**oil, "eyring_stress": "5 MPa"}},
        {
            "contact": {
                "temperature_1": "65 degC",
                "temperature_2": "62 degC",
                "body_1": {"material": None, **solid},
                "body_2": {"material": None, **solid},
            }
        },
    )


def _of_motion() -> Iterator[Tables]:
    """Transient contacts."""
    for base, steps in ((MOVING["line"], {"steps": 20}), (MOVING["point"], {})):
        yield merged(base, {"title": "motion", "motion": {"record": 8, **steps}})
    contact = MOVING["line"]["contact"]
    yield merged(
        MOVING["line"],
        {"contact": {"slide_to_roll_ratio": 0.3}, "motion": {"passes": None, "duration": "0.2 ms"}},
    )
    assert contact


# Dimensions of a ball bearing and of a roller bearing, without a base.
_BALLS = {
    "kind": "deep-groove ball",
    "elements": 9,
    "bore": "40 mm",
    "outer_diameter": "80 mm",
    "width": "18 mm",
    "element_diameter": "11.906 mm",
    "pitch_diameter": "60 mm",
    "inner_groove": 0.52,
    "outer_groove": 0.53,
    "shoulder_height": 0.2,
    "radial_clearance": "10 um",
    "ring_material": "steel",
    "element_material": "steel",
    "radial_load": "2 kN",
    "axial_load": "300 N",
}
_ROLLERS = {
    "kind": "needle roller",
    "elements": 20,
    "bore": "20 mm",
    "outer_diameter": "37 mm",
    "width": "20 mm",
    "element_diameter": "3 mm",
    "pitch_diameter": "28 mm",
    "roller_length": "15 mm",
    "profile": "logarithmic",
    "inner_ring": True,
    "radial_clearance": "20 um",
    "radial_load": "1.5 kN",
}
_TAPERED = {
    **{key: value for key, value in _ROLLERS.items() if key not in ("inner_ring", "radial_clearance")},
    "kind": "tapered roller",
    "contact_angle": "15 deg",
    "radial_load": "1 kN",
    "axial_load": "1 kN",
}
_OF_BEARING = {
    "summit_height": 1.5,
    "contact_resistance": "1 ohm",
    "fill": 0.5,
    "parallel_capacitance": "20 pF",
    "supply": 0.8,
    "film_factor": 0.9,
}
_RATINGS = {
    "reliability": 0.95,
    "fatigue_load_limit": "800 N",
    "dynamic_rating": "30 kN",
    "static_rating": "18 kN",
}
_COATING = {
    "base": "alumina",
    "ring": "outer",
    "resistance": "1 Gohm",
    "thickness": "0.2 mm",
    "relative_permittivity": 9.0,
    "breakdown_voltage": "1 kV",
}
_AREA = {
    "ring": "inner",
    "thickness": "0.2 mm",
    "relative_permittivity": 9.0,
    "over_moulded": False,
    "area": "30 cm^2",
    "strength": "20 kV/mm",
}
_RANGES = {
    "ranges": {
        "bearing.composite_rq": ["0.04 um", "0.06 um"],
        "discharge.dielectric_strength": ["10 V/um", "20 V/um"],
    }
}

# Measured values of a bearing and of a drive.
_MEASURED = {
    "capacitance": "300 pF +- 20 %",
    "first_breakdown_voltage": "3 V +- 30 %",
    "breakdown_voltage": "6 V +- 30 %",
    "shaft_voltage": "5 V +- 20 %",
    "shaft_voltage_rms": "3 V +- 20 %",
    "bearing_voltage_ratio": "0.015 +- 0.003",
    "discharge_rate": "100 1/s +- 90 %",
    "conducting_share": "0.02 +- 0.01",
    "inner_ring_temperature": "71 degC +- 2 K",
    "outer_ring_temperature": "68 degC +- 2 K",
    "film": "200 nm +- 20 %",
}
_POINTS = "speed [rpm],temperature [degC],capacitance [pF],uncertainty of capacitance [%]\n1500,70,350,10\n3000,72,260,10\n"


def _of_bearings(base: Tables) -> Iterator[Tables]:
    """Bearings, of which each has the operating point of a table."""
    point = {key: base["bearing"][key] for key in ("inner_speed", "temperature", "composite_rq")}

    def other(own: Tables, **tables: Any) -> Tables:
        return {**base, "bearing": {**point, **own}, **tables}

    yield base
    yield other(KINDS["deep groove with fits"])
    for own in (
        _BALLS,
        _ROLLERS,
        _TAPERED,
        *(KINDS[kind] for kind in KINDS if kind != "deep groove with fits"),
    ):
        yield other(own)
    yield other({**KINDS["angular contact"], "contact_angle": "20 deg"})
    radial = {"base": "6208", "radial_load": "2 kN"}
    yield other({**radial, **_OF_BEARING, "radial_clearance": "10 um"})
    yield other(
        {
            **radial,
            "clearance_class": "C3",
            "composite_rq": None,
            "composite_ra": "0.04 um",
            "rq_over_ra": 1.2,
        }
    )
    yield other({**radial, "designation": "6208 C3", "base": None})
    for coating in (_COATING, _AREA):
        yield other({**radial, "radial_clearance": "10 um", "coating": coating})
    yield other(
        {
            **radial,
            "radial_clearance": "10 um",
            "life": {"contamination_factor": 0.5, "roughened_rq": "0.3 um", **_RATINGS},
        }
    )
    yield other(
        {
            **radial,
            "fits": {
                "unmounted_clearance": "25 um",
                "shaft_interference": "10 um",
                "shaft_material": "steel",
                "housing_material": "cast-iron",
                "housing_interference": "5 um",
                "reference_temperature": "25 degC",
                "shaft_temperature": "80 degC",
                "housing_temperature": "50 degC",
                "housing_diameter": "120 mm",
            },
        }
    )
    for oil in OILS:
        yield {**base, "lubricant": oil}
    for oil in HOT_OILS:
        yield {**base, "lubricant": oil}
    for strength in STRENGTHS:
        yield merged(
            base,
            {
                "discharge": {
                    "dielectric_strength": None,
                    **{key: value for key, value in strength.items() if key != "temperature"},
                }
            },
        )


_BEARING = {
    "title": "bearing",
    "contacts": "atlas",
    "bearing": {**POINT, **KINDS["deep groove"]},
    "lubricant": OIL,
    "discharge": {**DISCHARGE, "outlet": "fingers"},
    "motor": MOTOR,
}


def _of_bearing_files() -> Iterator[Tables]:
    """Bearing files."""
    yield from _of_bearings(_BEARING)
    yield merged(_BEARING, {"motor": None, "discharge": {"external_capacitance": "1 nF"}})
    yield merged(_BEARING, _RANGES)
    yield merged(_BEARING, {"measured": _MEASURED})
    yield merged(_BEARING, {"measured": {"file": _POINTS}})
    yield merged(
        _BEARING,
        {
            "contacts": "solved",
            "solver": {"tolerance": 1e-7, "max_iterations": 100},
            "bearing": {
                "base": "51208",
                "radial_clearance": None,
                "radial_load": None,
                "axial_load": "5 kN",
                "inner_speed": "1000 rpm",
            },
        },
    )


_GEAR = merged(
    HELICAL,
    {
        "contacts": "formula",
        "gear": {
            "hand": "right",
            "flank_ra": ["0.05 um", "0.06 um"],
            "rq_over_ra": 1.2,
            "summit_height": 1.5,
            "normal_backlash": "60 um",
            "tip_relief": ["8 um", "9 um"],
            "tip_relief_length": "1.5 mm",
            "lead_crowning": "5 um",
            "profile_shift": [0.3, 0.2],
            "centre_distance": None,
            "operation": {
                "friction_coefficient": 0.03,
                "boundary_friction": 0.12,
                "application_factor": 1.1,
                "dynamic_factor": 1.05,
                "face_load_factor": 1.02,
                "transverse_load_factor": 1.03,
                "pinion_torque": "30 N m",
            },
            "contact": {
                "voltage": "5 V",
                "conduction": "by-film",
                "contact_resistance": "1 ohm",
                "reference_area": "2 mm^2",
                "weibull_shape": 8.0,
            },
        },
        "discharge": {"conductivity": "20 nS/m"},
    },
)


def _of_gears(base: Tables) -> Iterator[Tables]:
    """Gear pairs."""
    yield base
    rough = {"flank_ra": None, "rq_over_ra": None, "composite_rq": "0.3 um"}
    yield merged(
        base, {"gear": {**rough, "operation": {"load_sharing": "stiffness", "bulk_temperature": "iso"}}}
    )
    yield merged(
        base,
        {
            "gear": {
                "tip_relief": None,
                "tip_relief_length": None,
                "lead_crowning": None,
                "operation": {"load_sharing": "rigid"},
            }
        },
    )
    yield merged(base, {"gear": {"centre_distance": "87 mm", "profile_shift": [0.3]}})
    for oil in (*OILS, *HOT_OILS):
        yield {**base, "lubricant": oil}
    for strength in STRENGTHS[:2]:
        yield merged(base, {"discharge": {"dielectric_strength": None, **strength}})


def _of_gear_files() -> Iterator[Tables]:
    yield from _of_gears(_GEAR)
    yield merged(_GEAR, {"ranges": {"gear.operation.pinion_torque": ["25 N m", "35 N m"]}})
    yield merged(
        _GEAR,
        {
            "measured": {
                "capacitance": "300 pF +- 20 %",
                "breakdown_voltage": "6 V +- 30 %",
                "conducting_share": "0.02 +- 0.01",
            }
        },
    )


_END = {
    "contacts": "formula",
    "bearing": {**KINDS["deep groove"], **POINT, "contact_resistance": "1 ohm"},
    "lubricant": OIL,
    "discharge": {"dielectric_strength": "15 V/um", "conductivity": "1 pS/m"},
}
_DRIVE = {
    "title": "drive",
    "drive": {
        "speed": "3000 rpm",
        "temperature": "60 degC",
        "contacts": "formula",
        "duration": "2 ms",
        "seed": 3,
    },
    "source": {
        "dc_link": "560 V",
        "modulation": "space-vector",
        "switching_frequency": "10 kHz",
        "pole_pairs": 2,
        "modulation_index": 0.8,
        "base_frequency": "200 Hz",
        "rise_time": "100 ns",
        "overshoot": 0.2,
        "ringing_frequency": "2 MHz",
        "ringing_time": "1 us",
    },
    "circuit": {
        **DRIVE_MOTOR,
        "frame_earth_capacitance": "1 nF",
        "cable_capacitance": "2 nF",
        "common_mode_inductance": "1 mH",
        "common_mode_resistance": "100 ohm",
        "ground_inductance": "1 uH",
        "ground_resistance": "1 ohm",
    },
    "breakdown": {
        "arc_resistance": "10 ohm",
        "extinction_current": "10 mA",
        "recovery_time": "100 ns",
        "weibull_shape": 5.0,
        "renewal_time": "1 ms",
        "touch_time": "1 us",
    },
    "drive_end": _END,
    "non_drive_end": merged(_END, {"bearing": {"radial_load": "1 kN"}}),
}
_MACHINE = {
    "stack_length": "100 mm",
    "bore_diameter": "100 mm",
    "air_gap": "0.7 mm",
    "slots": 36,
    "slot_opening": "3 mm",
    "copper_depth": "2 mm",
    "slot_permittivity": 3.0,
    "liner_width": "40 mm",
    "liner_thickness": "0.3 mm",
    "liner_permittivity": 3.5,
}


def _record(columns: int) -> str:
    """Text of a record of an oscilloscope: a square wave, and a part of it."""
    rows = []
    for k in range(4000):
        level = 280.0 if (k // 250) % 2 else -280.0
        rows.append(",".join([f"{0.2 * k:.1f}", f"{level}", f"{0.03 * level}"][: columns + 1]))
    return "\n".join([["time [us],u_cm [V]", "time [us],u_cm [V],u_shaft [V]"][columns - 1], *rows, ""])


def _of_drives() -> Iterator[Tables]:
    yield _DRIVE
    plain = merged(_DRIVE, {"circuit": {key: None for key in _DRIVE["circuit"] if key not in DRIVE_MOTOR}})
    yield merged(
        plain,
        {
            "circuit": {"grounding_ring_resistance": "1 ohm"},
            "breakdown": {"extinction_current": None, "extinction_voltage": "0.5 V"},
            "source": {"pole_pairs": None, "fundamental_frequency": "100 Hz"},
        },
    )
    yield merged(
        plain,
        {
            "circuit": {
                "grounding_ring_table": {"speed": ["0 rpm", "6000 rpm"], "resistance": ["0.5 ohm", "50 ohm"]}
            }
        },
    )
    yield merged(plain, {"circuit": {**dict.fromkeys(DRIVE_MOTOR), "machine": _MACHINE}})
    yield merged(
        plain, {"remedies": [{"title": "ring", "changes": {"circuit.grounding_ring_resistance": "1 ohm"}}]}
    )
    described = dict.fromkeys(_DRIVE["source"])
    yield merged(
        plain,
        {"source": {**described, "file": _record(1), "column": "u_cm", "scale": 1.2, "resample": "0.3 us"}},
    )
    yield merged(
        plain,
        {
            "source": {
                **described,
                "file": _record(1).replace("time [us]", "t").replace("u_cm [V]", "u"),
                "column": 2,
                "time_column": 1,
                "time_unit": "us",
                "value_unit": "V",
            }
        },
    )
    yield merged(plain, {"source": {**described, "file": _record(1), "column": "u_cm", "step": "0.2 us"}})
    yield merged(plain, {"drive": {"speed": None, "temperature": None, "contacts": None}})
    yield merged(plain, {"measured": _MEASURED})
    yield merged(
        plain,
        {
            "measured": {
                "shaft_record": {
                    "file": _record(2),
                    "column": "u_shaft",
                    "common_mode_column": "u_cm",
                    "scale": 1.1,
                    "common_mode_scale": 1.05,
                    "threshold": "3 V",
                    "gain_uncertainty": 0.05,
                }
            }
        },
    )
    for end in _of_bearings({**_END}):
        yield merged({**plain, "drive_end": end}, {})


_AXLE = merged(
    ALONE,
    {
        "title": "axle",
        "drive": {"contacts": "formula", "duration": "2 ms", "seed": 3},
        "breakdown": _DRIVE["breakdown"],
        "bearings": {"contact_resistance": "1 ohm"},
    },
)


def _of_axles() -> Iterator[Tables]:
    yield _AXLE
    geared = _geared()
    yield geared
    for tables in _of_gears(merged(_GEAR, {"title": "stage"})):
        yield merged(geared, {"mesh": [{**geared["mesh"][0], "pair": tables}]})
    for oil in OILS:
        yield {**geared, "lubricant": oil}
    for strength in STRENGTHS:
        yield merged(geared, {"discharge": {"dielectric_strength": None, **strength}})
    for own in _of_bearings({**_END}):
        shared = {
            key: value
            for key, value in own["bearing"].items()
            if key not in ("radial_load", "axial_load", "inner_speed", "temperature")
        }
        mounted = [
            {
                "shaft": "rotor",
                "at": f"{at} mm",
                **{
                    key: value
                    for key, value in own["bearing"].items()
                    if key in ("radial_load", "axial_load")
                },
            }
            for at in (0, 80)
        ]
        yield {**_AXLE, "bearings": shared, "bearing": mounted}


def _geared() -> Tables:
    """Two shafts with a mesh."""
    bearing = {"base": "6208", "radial_clearance": "10 um", "composite_rq": "0.03 um"}
    rows = [
        {"shaft": shaft, "at": at, "locating": at == "0 mm", **bearing}
        for shaft in ("rotor", "output")
        for at in ("0 mm", "80 mm")
    ]
    return merged(
        _AXLE,
        {
            "shaft": [
                {"name": "rotor", "rotor": True, "housing_capacitance": "20 pF"},
                {"name": "output", "rotor": False, "housing_capacitance": "50 pF"},
            ],
            "bearing": rows,
            "mesh": [
                {
                    "gears": ["rotor", "output"],
                    "at": ["30 mm", "31 mm"],
                    "direction": "10 deg",
                    "contact_resistance": "2 ohm",
                    "pair": _GEAR,
                }
            ],
            "link": [{"between": ["rotor", "housing"], "kind": "ring", "resistance": "1 kohm"}],
            "remedies": [{"title": "ring", "changes": {"circuit.grounding_ring_resistance": "1 ohm"}}],
        },
    )


CASES: Mapping[str, tuple[Tables, ...]] = {
    "line": tuple(_of_contacts(_LINE)),
    "point": tuple(_of_contacts(_POINT)),
    "motion": tuple(_of_motion()),
    "bearing": tuple(_of_bearing_files()),
    "gear": tuple(_of_gear_files()),
    "drive": tuple(_of_drives()),
    "axle": tuple(_of_axles()),
}
