"""Sheets: the quantities that each kind of result shows, by section and in order.

The terminal, the notebook and the report show whole sheets; a page shows the same rows, some of them large.
"""

from __future__ import annotations

from ehlectric.quantities.rows import Section, Sheet

_CONDITIONS = Section(
    "operating conditions",
    (
        "inputs.contact.load",
        "inputs.contact.load_per_length",
        "inputs.contact.entrainment_speed",
        "inputs.contact.slide_to_roll_ratio",
        "lubricant.temperature",
        "lubricant.viscosity",
        "inputs.contact.radius_x",
        "inputs.contact.radius_y",
        "inputs.contact.reduced_radius",
        "inputs.contact.reduced_modulus",
        "field.voltage",
    ),
)
_DRY_CONTACT = Section(
    "dry contact (Hertz)",
    (
        "hertz.max_pressure",
        "hertz.half_width",
        "hertz.semi_axis_x",
        "hertz.semi_axis_y",
        "hertz.axis_ratio",
        "lubricant.alpha_star",
        "groups.moes_m",
        "groups.moes_l",
        "regime",
    ),
)
_FORMULAS = Section(
    "film thickness by published formulas",
    ("film_formulas.*.minimum_thickness", "film_formulas.*.central_thickness", "formula_error"),
)

# A contact before it is solved.
CHECK: Sheet = (
    _CONDITIONS,
    _DRY_CONTACT,
    _FORMULAS,
    Section("numerical model", ("grid.film", "inputs.grid.side", "inputs.grid.wedge", "velocity_parameter")),
)

CONTACT: Sheet = (
    _CONDITIONS,
    _DRY_CONTACT,
    Section(
        "film",
        (
            "film.minimum_thickness",
            "film.central_thickness",
            "film.film_ratio",
            "film.flooded.minimum_thickness",
            "film.oil_layer",
            "film.meniscus",
            "film.mean_thickness",
            "film.max_pressure",
            "film.discretisation_error",
            "film.residual",
            "film.load_residual",
        ),
    ),
    Section(
        "heat and shear in the film",
        (
            "film.rheology",
            "film.thermal",
            "film.isothermal.minimum_thickness",
            "film.isothermal.central_thickness",
            "film.max_temperature_rise",
            "film.surface_temperature_1",
            "film.surface_temperature_2",
            "film.traction_coefficient",
            "film.rolling_coefficient",
            "film.power_loss",
        ),
    ),
    Section(
        "roughness",
        (
            "roughness.rq_1",
            "roughness.rq_2",
            "roughness.lambda_ratio",
            "roughness.lambda_ratio_smooth",
            "roughness.smooth_minimum_thickness",
        ),
    ),
    Section(
        "asperities that touch",
        (
            "asperities.behaviour",
            "asperities.load_share",
            "asperities.contact_area_share",
            "asperities.contact_area",
            "asperities.spots",
            "asperities.mean_spot",
            "asperities.largest_spot",
            "asperities.mass_error",
            "asperities.boundary_film",
            "asperities.mean_film",
            "asperities.film_5",
            "asperities.rq_deformed",
            "asperities.lambda_undeformed",
            "asperities.lambda_deformed",
            "asperities.boundary_friction",
            "asperities.resistance",
            "asperities.capacitance_outside",
            "asperities.corner_frequency",
            "asperities.breakdown_1",
            "asperities.breakdown_5",
            "asperities.breakdown_50",
            "asperities.breakdown_voltage",
            "asperities.breakdown_probability",
        ),
    ),
    Section(
        "electric field",
        (
            "field.max_strength",
            "field.max_strength_error",
            "field.max_dimensionless",
            "field.thin_gap_error",
            "field.high_field_width",
            "field.high_field_area",
            "field.capacitance_per_length",
            "field.capacitance",
            "field.capacitance_by_zone.hertz",
            "field.capacitance_by_zone.inlet",
            "field.capacitance_by_zone.outlet",
            "field.capacitance_by_zone.sides",
            "field.columns",
        ),
    ),
    Section(
        "discharge",
        (
            "discharge.zone_position",
            "discharge.zone_size",
            "discharge.capacitance",
            "discharge.capacitance_ratio",
            "discharge.capacitance_hertz",
            "discharge.capacitance_inlet",
            "discharge.capacitance_outlet",
            "discharge.capacitance_sides",
            "discharge.capacitance_by_outlet",
            "discharge.contact_energy",
            "discharge.discharge_energy",
            "discharge.breakdown_energy",
            "discharge.pit_diameter",
            "discharge.current_density",
            "discharge.relaxation_time",
            "discharge.corner_frequency",
            "discharge.dielectric_strength",
            "discharge.breakdown_voltage",
            "discharge.breakdown_field_error",
            "discharge.breakdown_range",
            "discharge.margin",
            "discharge.probability",
        ),
    ),
    Section(
        "capacitance at the meter",
        (
            "meter.capacitance",
            "meter.capacitance_by_gap",
            "meter.capacitance_domain",
            "meter.capacitance_hertz",
            "meter.capacitance_outside",
            "meter.parallel_capacitance",
            "meter.roughness_factor",
            "meter.capacitance_uncoated",
            "meter.coating_capacitance",
            "meter.coating_voltage_share",
            "meter.film_breakdown_voltage",
            "meter.coating_breakdown_voltage",
            "meter.breakdown_voltage",
        ),
    ),
    _FORMULAS,
    Section("run", ("seconds.both",)),
)

# Quantities that the page of a contact shows large: before it is solved, solved, and where surfaces touch.
CHECK_CARDS = (
    "hertz.max_pressure",
    "hertz.half_width",
    "hertz.semi_axis_x",
    "hertz.semi_axis_y",
    "film_formulas.*.minimum_thickness",
    "film_formulas.*.central_thickness",
    "groups.moes_m",
    "groups.moes_l",
    "breakdown_by_formula.breakdown_voltage",
)
_FURTHER_CARDS = (
    "film.max_pressure",
    "field.max_strength",
    "field.capacitance_per_length",
    "field.capacitance",
    "discharge.breakdown_voltage",
    "film.max_temperature_rise",
    "film.traction_coefficient",
    "film.power_loss",
)
CONTACT_CARDS = ("film.minimum_thickness", "film.central_thickness", *_FURTHER_CARDS)
# A spot may be in the middle of a contact whose surfaces touch, so that the mean film says more.
TOUCHING_CARDS = ("film.minimum_thickness", "film.mean_thickness", *_FURTHER_CARDS)
SPOT_CARDS = (
    "asperities.behaviour",
    "asperities.load_share",
    "asperities.contact_area",
    "asperities.spots",
    "asperities.boundary_friction",
    "asperities.resistance",
    "asperities.capacitance_outside",
    "asperities.breakdown_1",
    "asperities.breakdown_5",
    "asperities.breakdown_50",
    "asperities.breakdown_voltage",
    "asperities.breakdown_probability",
)

# A contact with moving roughness, before its run: below the rows of its stationary contact.
MOTION_CHECK: Sheet = (
    Section(
        "motion of the roughness",
        (
            "motion.duration",
            "motion.courant",
            "motion.speed_1",
            "motion.speed_2",
            "motion.covered_from",
            "motion.coincident",
        ),
    ),
)

# A contact over time, below its operating conditions.
MOTION: Sheet = (
    Section("motion of the roughness", ("motion.duration",)),
    Section(
        "film",
        (
            "film.minimum_thickness",
            "film.discretisation_error",
            "stationary.minimum_thickness",
            "film.before",
            "film.max_pressure",
            "stationary.max_pressure",
            "film.oil_layer",
            "film.meniscus_before",
        ),
    ),
    Section(
        "electric field",
        (
            "field.max_strength",
            "field.max_strength_error",
            "stationary.max_strength",
            "field.before",
            "field.share_above_90",
            "field.local_maxima_quantiles.1",
            "field.local_maxima_quantiles.2",
            "discharge.breakdown_voltage",
            "discharge.margin",
        ),
    ),
    Section(
        "asperities that touch",
        (
            "asperities.load_share_mean",
            "asperities.load_share_largest",
            "asperities.contact_area_share_mean",
            "asperities.spots_mean",
            "asperities.time_share",
        ),
    ),
    Section(
        "moving and stationary, same position",
        (
            "beside_stationary.time",
            "beside_stationary.minimum_thickness",
            "beside_stationary.minimum_thickness_stationary",
            "beside_stationary.maximum_strength",
            "beside_stationary.maximum_strength_stationary",
        ),
    ),
    Section("run", ("motion.halvings", "motion.newton_per_step", "seconds")),
)

_BEARING_CONDITIONS = Section(
    "operating conditions",
    (
        "inputs.bearing.inner_speed",
        "inputs.bearing.radial_load",
        "inputs.bearing.axial_load",
        "lubricant.temperature",
        "lubricant.viscosity",
        "lubricant.alpha_star",
        "lubricant.inner_temperature",
        "lubricant.inner_viscosity",
        "lubricant.outer_temperature",
        "lubricant.outer_viscosity",
        "inputs.bearing.radial_clearance",
        "bearing.unmounted_clearance",
        "bearing.mounted_clearance",
        "bearing.running_clearance",
        "inputs.bearing.contact_angle",
        "inputs.discharge.dielectric_strength",
    ),
)
# Sections of a bearing that is solved, or whose films are from the atlas or by formula.
_BEARING_OUTCOME = (
    Section(
        "films",
        (
            "bearing.contacts",
            "bearing.minimum_thickness",
            "bearing.lambda_ratio",
            "bearing.film_factor",
            "bearing.heat_factor",
            "bearing.inlet_shear_factor",
            "bearing.supply_factor",
            "bearing.film_half_time",
            "bearing.discretisation_error",
            "bearing.interpolation_error",
            "bearing.film_error",
        ),
    ),
    Section(
        "friction, hydrodynamic rolling alone",
        (
            "bearing.rolling_power_loss",
            "bearing.rolling_moment",
            "bearing.inner_contact_power_loss",
            "bearing.inner_inlet_temperature_rise",
            "bearing.outer_contact_power_loss",
            "bearing.outer_inlet_temperature_rise",
        ),
    ),
    Section(
        "asperities",
        (
            "bearing.regime",
            "bearing.inner_contact_time_share",
            "bearing.outer_contact_time_share",
            "bearing.clarke_time_share",
            "bearing.insulating_time_share",
            "bearing.asperity_share_range",
            "margin.capacitive_speed",
        ),
    ),
    Section(
        "capacitance",
        (
            "bearing.capacitance",
            "bearing.capacitance_oil",
            "bearing.capacitance_air",
            "bearing.capacitance_ratio",
            "bearing.capacitance_rough",
            "bearing.parallel_capacitance",
            "bearing.coating_capacitance",
            "bearing.shaft_capacitance",
            "bearing.meter_capacitance",
        ),
    ),
    Section(
        "breakdown",
        (
            "bearing.bearing_voltage_ratio",
            "bearing.shaft_voltage",
            "bearing.strength_per_volt",
            "bearing.max_strength",
            "bearing.through_breakdown",
            "bearing.through_breakdown_mean",
            "bearing.through_margin",
            "bearing.first_break_mean",
            "bearing.first_break",
            "bearing.coating_share",
            "bearing.film_voltage",
            "bearing.shaft_first_break",
            "bearing.shaft_through_breakdown",
            "bearing.coating_breakdown",
            "bearing.lubrication",
            "bearing.margin",
            "bearing.breakdown_probability",
            "margin.range",
            "margin.critical_speed",
            "margin.upper_critical_speed",
            "margin.touching_speed",
        ),
    ),
    Section("margin if one input changes", ("margin.effects", "margin.left_out")),
    Section(
        "leakage through the oil",
        (
            "bearing.relaxation_time",
            "bearing.shaft_time_constant",
            "bearing.film_time_constant",
            "bearing.shaft_voltage_after_rise",
            "bearing.shaft_voltage_after_period",
        ),
    ),
    Section(
        "discharge",
        (
            "bearing.discharge_energy",
            "bearing.breakdown_energy",
            "bearing.pit_diameter",
            "bearing.breakdown_pit_diameter",
            "bearing.current_density",
            "bearing.element_current_density",
        ),
    ),
)
BEARING: Sheet = (_BEARING_CONDITIONS, *_BEARING_OUTCOME, Section("run", ("seconds",)))

# A bearing before its contacts are solved, or two of them beside each other.
BEARING_CHECK: Sheet = (
    _BEARING_CONDITIONS,
    *(
        Section(
            f"contacts with the {ring} ring",
            (
                f"rings.{ring}.load",
                f"rings.{ring}.max_pressure",
                f"rings.{ring}.minimum_thickness",
                f"mechanics.entrainment_speed_{ring}",
            ),
        )
        for ring in ("inner", "outer")
    ),
    *_BEARING_OUTCOME,
)

# Columns of the tables of all contacts of a bearing: of its loads, of its films, and on its page.
LOAD_COLUMNS = (
    *("element", "ring", "position", "load", "contact_angle", "max_pressure", "semi_axis_x", "semi_axis_y"),
)
FILM_COLUMNS = (
    *("element", "ring", "minimum_thickness", "central_thickness", "lambda_ratio", "capacitance"),
    *("voltage_share", "max_strength", "strength_per_volt", "breakdown_voltage"),
)
PAGE_COLUMNS = (
    *("element", "ring", "position", "load", "max_pressure", "minimum_thickness", "lambda_ratio"),
    *("capacitance", "breakdown_voltage"),
)

# Quantities that the page of a bearing shows large, each with those that stand small below it.
BEARING_CARDS = {
    "bearing.capacitance": ("bearing.capacitance_air", "bearing.capacitance_oil"),
    "bearing.first_break": (),
    "bearing.shaft_first_break": (),
    "bearing.shaft_voltage": ("bearing.bearing_voltage_ratio",),
    "bearing.margin": ("margin.range", "bearing.breakdown_probability"),
    "bearing.lambda_ratio": ("bearing.minimum_thickness",),
    "margin.critical_speed": ("margin.upper_critical_speed", "margin.touching_speed"),
    "bearing.regime": ("margin.capacitive_speed",),
}

# Quantities by which a page says how far solved contacts differ from quick ones.
DIFFERENCES = (
    "bearing.capacitance",
    "bearing.first_break",
    "bearing.shaft_first_break",
    "bearing.shaft_voltage",
    "bearing.margin",
    "bearing.minimum_thickness",
)

# Quantities of the table "end" are those of each bearing.
_FILMS = (
    "end.capacitance",
    "end.breakdown_voltage",
    "end.weibull_shape",
    "end.renewal_time",
    "end.touching_time_share",
)
# A drive before its simulation.
DRIVE_CHECK: Sheet = (
    Section(
        "source and circuit",
        (
            "source.peak",
            "source.edges_per_second",
            "source.fundamental_frequency",
            "circuit.winding_rotor_capacitance",
            "circuit.rotor_frame_capacitance",
            "circuit.winding_frame_capacitance",
            "drive.duration",
            "drive.remedies",
        ),
    ),
    Section("films of the bearing", ("end.films", *_FILMS)),
    Section("voltage across the films", ("end.voltage_ratio", "end.voltage_at_peak")),
)

DRIVE: Sheet = (
    Section(
        "simulation",
        (
            "source.peak",
            "drive.duration",
            "drive.periods",
            "source.edges",
            "source.edges_per_second",
            "source.fundamental_frequency",
            "source.modulation_index",
            "drive.events",
        ),
    ),
    Section("films of the bearing", _FILMS),
    Section(
        "voltage across the films",
        (
            "end.voltage_ratio",
            "end.waveform_ratio",
            "end.peak_voltage",
            "end.rms_voltage",
            "end.time_above.1",
            "end.time_above.2",
            "end.time_above.5",
            "end.time_above.10",
            "end.time_above.20",
            "end.time_above.50",
        ),
    ),
    Section(
        "discharges",
        (
            "end.events",
            "end.events_per_second",
            "end.events_per_second_range",
            "end.events_per_edge",
            "end.burning_time_share",
            "end.voltage_mean",
            "end.voltage_high",
            "end.voltage_largest",
            "end.energy_mean",
            "end.energy_high",
            "end.energy_largest",
            "end.charge_mean",
            "end.peak_current_mean",
            "end.peak_current_largest",
            "end.time_mean",
            "end.power",
            "end.contact_current",
            "end.current_density",
            "end.element_current_density",
            "end.real_current_density",
        ),
    ),
)

# A bearing of a drive, beside those of its remedies.
REMEDIES: Sheet = (
    Section(
        "remedies side by side",
        (
            "end.events_per_second",
            "end.events_per_second_range",
            "end.voltage_mean",
            "end.energy_mean",
            "end.power",
            "end.peak_voltage",
        ),
    ),
)
# Main results of two cases beside each other.
COMPARED = (
    *("bearing.capacitance", "bearing.first_break", "bearing.shaft_first_break", "bearing.shaft_voltage"),
    *("bearing.margin", "bearing.lambda_ratio", "rings.*.max_pressure", "rings.*.minimum_thickness"),
    *("margin.critical_speed", "hertz.max_pressure", "film_formulas.*.minimum_thickness"),
    *("breakdown_by_formula.breakdown_voltage", "breakdown_by_formula.margin"),
)
# What two cases beside each other show elsewhere, among their inputs, or what is no result of either.
NOT_COMPARED = frozenset((*_CONDITIONS.keys, *_BEARING_CONDITIONS.keys, *CHECK[-1].keys, "formula_error"))

# Quantities that the page of a drive shows large, simulated or not.
DRIVE_CARDS = (
    "end.events_per_second",
    "end.voltage_at_peak",
    "end.peak_voltage",
    "end.breakdown_voltage",
    "end.voltage_mean",
    "end.energy_mean",
    "end.power",
    "end.current_density",
    "end.capacitance",
    "end.voltage_ratio",
    "source.peak",
    "circuit.winding_rotor_capacitance",
)
