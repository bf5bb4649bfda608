"""Names that users give to keys that have another name, and the keys that they mean."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

_SPEEDS = ("contact.entrainment_speed", "contact.speed_1", "contact.speed_2")
_RADII = ("contact.reduced_radius", "contact.radius_x", "contact.radius_1")
_MODULI = ("contact.reduced_modulus", "contact.body_1.youngs_modulus")
_LOADS = ("contact.load", "contact.load_per_length", "contact.max_hertz_pressure")
_PRESSURE = ("contact.max_hertz_pressure",)
_ALPHA = ("lubricant.pressure_viscosity_coefficient",)
_GRADE = ("lubricant.temperature.iso_vg",)
_STRENGTH = ("discharge.dielectric_strength",)

# Keys that a wrong name may mean, by the dotted name; a file that has none of them takes its nearest key.
ALIASES: Mapping[str, tuple[str, ...]] = MappingProxyType(
    {
        # Contacts
        "contact.kind": ("contact.geometry",),
        "contact.type": ("contact.geometry",),
        "contact.shape": ("contact.geometry",),
        "contact.speed": _SPEEDS,
        "contact.velocity": _SPEEDS,
        "contact.rolling_speed": _SPEEDS,
        "contact.mean_speed": _SPEEDS,
        "contact.radius": _RADII,
        "contact.r": _RADII,
        "contact.modulus": _MODULI,
        "contact.e_modulus": _MODULI,
        "contact.youngs_modulus": _MODULI,
        "contact.elastic_modulus": _MODULI,
        "contact.force": _LOADS,
        "contact.normal_load": _LOADS,
        "contact.line_load": ("contact.load_per_length",),
        "contact.pressure": _PRESSURE,
        "contact.hertz_pressure": _PRESSURE,
        "contact.max_pressure": _PRESSURE,
        "contact.srr": ("contact.slide_to_roll_ratio",),
        "contact.slip": ("contact.slide_to_roll_ratio",),
        "contact.voltage": ("electric.potential_1", "electric.potential_2"),
        # Oils
        "lubricant.name": ("lubricant.base",),
        "lubricant.oil": ("lubricant.base",),
        "lubricant.alpha": _ALPHA,
        "lubricant.pressure_viscosity": _ALPHA,
        "lubricant.dynamic_viscosity": ("lubricant.viscosity",),
        "lubricant.eta": ("lubricant.viscosity",),
        "lubricant.kinematic_viscosity": ("lubricant.temperature.kinematic_viscosity_40",),
        "lubricant.grade": _GRADE,
        "lubricant.permittivity": ("lubricant.relative_permittivity",),
        "lubricant.z": ("lubricant.roelands_z",),
        # Roughness
        "roughness.rms": ("roughness.rq", "roughness.rescale_rq"),
        "roughness.kind": ("roughness.generator",),
        "roughness.type": ("roughness.generator",),
        # Bearings
        "bearing.speed": ("bearing.inner_speed",),
        "bearing.shaft_speed": ("bearing.inner_speed",),
        "bearing.rotational_speed": ("bearing.inner_speed",),
        "bearing.rpm": ("bearing.inner_speed",),
        "bearing.load": ("bearing.radial_load", "bearing.axial_load"),
        "bearing.force": ("bearing.radial_load", "bearing.axial_load"),
        "bearing.name": ("bearing.base",),
        "bearing.type": ("bearing.base", "bearing.kind"),
        "bearing.designation": ("bearing.base",),
        "bearing.ball_diameter": ("bearing.element_diameter",),
        "bearing.roller_diameter": ("bearing.element_diameter",),
        "bearing.balls": ("bearing.elements",),
        "bearing.rollers": ("bearing.elements",),
        "bearing.number_of_balls": ("bearing.elements",),
        "bearing.rq": ("bearing.composite_rq",),
        "bearing.roughness": ("bearing.composite_rq",),
        "bearing.oil_temperature": ("bearing.temperature",),
        # Discharge and motor
        "discharge.strength": _STRENGTH,
        "discharge.breakdown_strength": _STRENGTH,
        "discharge.field_strength": _STRENGTH,
        "motor.voltage": ("motor.common_mode_voltage",),
        "motor.frequency": ("motor.switching_frequency",),
        # Drives
        "drive.rpm": ("drive.speed",),
        "drive.time": ("drive.duration",),
        "source.voltage": ("source.dc_link",),
        "source.frequency": ("source.switching_frequency", "source.fundamental_frequency"),
        "source.edge_time": ("source.rise_time",),
    }
)
