"""What the axes of a sweep's figures are called: name, symbol and unit of varied keys and of values."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ehlectric.arrays import Array
from ehlectric.cases.any_case import AnyCase
from ehlectric.cases.case import Case
from ehlectric.cases.keys import kind_of
from ehlectric.cases.lubricant import law_parameters
from ehlectric.cases.quantity import Quantity

# Name and symbol of inputs; their units stand in the case. Parameters of laws bring their own.
_INPUTS = {
    "contact.entrainment_speed": ("entrainment speed", r"$(u_1 + u_2)/2$"),
    "contact.speed_1": ("speed of surface 1", "$u_1$"),
    "contact.speed_2": ("speed of surface 2", "$u_2$"),
    "contact.slide_to_roll_ratio": ("slide-to-roll ratio", ""),
    "contact.load": ("load", "$F$"),
    "contact.load_per_length": ("load per length", "$w$"),
    "contact.max_hertz_pressure": ("Hertz pressure", r"$p_\mathrm{h}$"),
    "contact.reduced_radius": ("reduced radius", "$R$"),
    "contact.radius_x": ("reduced radius along entrainment", "$R_x$"),
    "contact.radius_y": ("reduced radius across entrainment", "$R_y$"),
    "contact.reduced_modulus": ("reduced modulus", "$E'$"),
    "lubricant.base": ("lubricant", ""),
    "lubricant.viscosity": ("viscosity", r"$\eta_0$"),
    "electric.potential_1": ("potential of surface 1", "$V_1$"),
    "electric.potential_2": ("potential of surface 2", "$V_2$"),
    "bearing.inner_speed": ("speed of the inner ring", ""),
    "bearing.radial_load": ("radial load", r"$F_\mathrm{r}$"),
    "bearing.axial_load": ("axial load", r"$F_\mathrm{a}$"),
    "bearing.temperature": ("temperature", ""),
    "bearing.composite_rq": ("composite roughness", r"$R_\mathrm{q}$"),
    "bearing.radial_clearance": ("radial clearance", ""),
    "bearing.contact_angle": ("free contact angle", ""),
    "bearing.film_factor": ("film factor", ""),
    "bearing.inner_groove": ("groove of the inner ring over the ball", r"$f_\mathrm{i}$"),
    "bearing.outer_groove": ("groove of the outer ring over the ball", r"$f_\mathrm{o}$"),
    "lubricant.temperature.kinematic_viscosity_40": ("kinematic viscosity at 40 °C", r"$\nu_{40}$"),
    "lubricant.temperature.kinematic_viscosity_100": ("kinematic viscosity at 100 °C", r"$\nu_{100}$"),
    "motor.common_mode_voltage": ("common-mode voltage", ""),
    "motor.winding_rotor_capacitance": ("capacitance from winding to rotor", r"$C_\mathrm{wr}$"),
    "motor.rotor_frame_capacitance": ("capacitance from rotor to frame", r"$C_\mathrm{rf}$"),
    "discharge.dielectric_strength": ("dielectric strength", ""),
    "discharge.weibull.scale": ("Weibull scale", "$E_0$"),
    "discharge.weibull.shape": ("Weibull shape", "$m$"),
    "discharge.temperature": ("temperature", ""),
    "discharge.conductivity": ("conductivity", r"$\sigma$"),
    "discharge.external_capacitance": ("external capacitance", r"$C_\mathrm{ext}$"),
    "discharge.outlet": ("what fills the outlet", ""),
    "discharge.peak_current": ("peak current", ""),
    "discharge.pit.efficiency": ("part of the energy that melts", r"$\zeta$"),
    "discharge.pit.melting_energy": ("heat to melt a volume", "$q$"),
    "discharge.length": ("length of the contact", ""),
    "grid.nodes": ("nodes", ""),
}

# Name and symbol of values of the summary; their units follow from the last part of the key.
_VALUES = {
    "groups.moes_m": ("Moes", "$M$"),
    "groups.moes_l": ("Moes", "$L$"),
    "hertz.half_width": ("half-width", "$b$"),
    "hertz.semi_axis_x": ("semi-axis along entrainment", "$b$"),
    "hertz.semi_axis_y": ("semi-axis across entrainment", "$a$"),
    "hertz.max_pressure": ("Hertz pressure", r"$p_\mathrm{h}$"),
    "film.minimum_thickness": ("minimum film thickness", r"$h_\mathrm{min}$"),
    "film.central_thickness": ("central film thickness", "$h(0)$"),
    "film.mean_thickness": ("mean film thickness", r"$\bar{h}$"),
    "film.max_pressure": ("largest pressure in the film", r"$p_\mathrm{max}$"),
    "film.discretisation_error": ("discretisation error of the film", ""),
    "field.voltage": ("voltage", "$V_{12}$"),
    "field.max_strength": ("largest field strength", r"$|E|_\mathrm{max}$"),
    "field.max_dimensionless": ("largest field strength", r"$|E|_\mathrm{max}\,h_\mathrm{min}/V_{12}$"),
    "field.high_field_width": ("width above 95 % of the largest field", ""),
    "field.high_field_area": ("area above 95 % of the largest field", ""),
    "field.capacitance_per_length": ("capacitance per length, field range", ""),
    "field.capacitance": ("capacitance, field range", "$C$"),
    "roughness.lambda_ratio": ("lambda ratio", r"$\Lambda$"),
    "lubricant.temperature": ("temperature of the oil", ""),
    "lubricant.expansion": ("thermal expansion of the oil", "$a$"),
    "lubricant.film_factor": ("film factor, resolved", "$C$"),
    "bearing.lubrication": ("state of lubrication", ""),
    "bearing.first_break_at": ("contact that breaks first", ""),
    "bearing.capacitance": ("capacitance of the bearing", "$C$"),
    "bearing.capacitance_oil": ("capacitance of the bearing, all in oil", ""),
    "bearing.capacitance_air": ("capacitance of the bearing, air around the films", ""),
    "bearing.capacitance_plate": ("capacitance of plates", ""),
    "bearing.capacitance_ratio": ("capacitance over that of plates", ""),
    "bearing.lambda_ratio": ("least film over roughness", r"$\lambda$"),
    "bearing.first_break": ("bearing voltage of the first break", ""),
    "bearing.first_break_mean": ("first break, mean over a pitch", ""),
    "bearing.through_breakdown": ("bearing voltage of the through breakdown", ""),
    "bearing.through_breakdown_mean": ("through breakdown, mean over a pitch", ""),
    "bearing.margin": ("first break over shaft voltage", ""),
    "bearing.through_margin": ("through breakdown over shaft voltage", ""),
    "bearing.strength_per_volt": ("largest field strength by bearing voltage", ""),
    "bearing.max_strength": ("largest field strength", ""),
    "bearing.bearing_voltage_ratio": ("bearing voltage ratio", ""),
    "bearing.shaft_voltage": ("shaft voltage", ""),
    "discharge.breakdown_voltage": ("breakdown voltage", r"$V_\mathrm{b}$"),
    "discharge.margin": ("breakdown voltage over applied voltage", r"$V_\mathrm{b}/V_{12}$"),
    "discharge.breakdown_voltage_low": ("breakdown voltage at 5 %", ""),
    "discharge.breakdown_voltage_high": ("breakdown voltage at 95 %", ""),
    "discharge.probability": ("probability of breakdown", ""),
    "discharge.zone_position": ("place of the zone that breaks down first", ""),
    "discharge.zone_size": ("size of the zone that breaks down first", ""),
    "discharge.zone_area": ("area of the zone that breaks down first", ""),
    "discharge.zone_over_half_width": ("size of the zone over the half-width", ""),
    "discharge.zone_over_largest_pit": ("size of the zone over the largest pit", ""),
    "discharge.zone_over_mean_pit": ("size of the zone over the mean pit", ""),
    "discharge.capacitance": ("capacitance of the whole film", "$C$"),
    "discharge.capacitance_hertz": ("capacitance of the Hertz zone", r"$C_\mathrm{H}$"),
    "discharge.capacitance_inlet": ("capacitance of the inlet", ""),
    "discharge.capacitance_outlet": ("capacitance of the outlet", ""),
    "discharge.capacitance_sides": ("capacitance of the sides", ""),
    "discharge.capacitance_plate": (
        "capacitance of a plate",
        r"$\varepsilon_0 \varepsilon_\mathrm{r} A_\mathrm{H}/h(0)$",
    ),
    "discharge.capacitance_ratio": ("capacitance over that of a plate", ""),
    "discharge.capacitance_outlet_full": ("capacitance of the outlet, full of oil", ""),
    "discharge.capacitance_outlet_fingers": ("capacitance of the outlet, oil in fingers", ""),
    "discharge.capacitance_outlet_layers": ("capacitance of the outlet, oil in layers", ""),
    "discharge.contact_energy": ("energy of the contact", "$C V_{12}^2/2$"),
    "discharge.discharge_energy": ("energy of the discharge", "$W$"),
    "discharge.breakdown_energy": ("energy of the discharge at breakdown", r"$W_\mathrm{b}$"),
    "discharge.pit_volume": ("volume of the pit", ""),
    "discharge.pit_diameter": ("diameter of the pit", ""),
    "discharge.current_density": ("apparent current density", "$J$"),
    "discharge.current_density_limits": ("published limit of the current density", ""),
    "discharge.relaxation_time": ("charge relaxation time", r"$\varepsilon/\sigma$"),
    "discharge.corner_frequency": ("frequency above which it is a capacitor", r"$f_\mathrm{c}$"),
}

# SI units by words of the last part of a key: keys are named for what they are.
_UNITS = (
    (
        ("ratio", "error", "share", "margin", "probability", "dimensionless", "residual", "deficit", "over"),
        "",
    ),
    (("volt",), "1/m"),
    (("voltage", "potential"), "V"),
    (("density",), "A/m**2"),
    (("thickness", "width", "position", "length", "depth", "diameter", "radius", "axis", "size"), "m"),
    (("rq", "ra", "sq", "sa", "spacing"), "m"),
    (("area",), "m**2"),
    (("volume",), "m**3"),
    (("pressure",), "Pa"),
    (("strength",), "V/m"),
    (("energy",), "J"),
    (("time",), "s"),
    (("frequency",), "Hz"),
    (("conductivity",), "S/m"),
    (("break", "breakdown"), "V"),
    (("temperature",), "K"),
    (("expansion",), "1/K"),
    (("displacement",), "m"),
    (("force", "load"), "N"),
    (("moment",), "N*m"),
    (("entrainment",), "m/s"),
    (("speed",), "rad/s"),
)

# Units that are never prefixed: of none, of angles, and of absolute temperatures.
_PLAIN = ("", "deg", "K", "rad")


@dataclass(frozen=True)
class Label:
    """A key as it is shown.

    Attributes
    ----------
    name, symbol : str
        As "load per length" and "$w$"; the dotted key and none where it has no name of its own.
    unit : str
        SI unit as pint writes it; empty where there is none, or it is not known.
    """

    name: str
    symbol: str
    unit: str

    def scaled(self, values: Array) -> Scale:
        """The unit in which values, SI, are numbers that can be read; those not finite do not count."""
        finite = np.abs(values[np.isfinite(values)])
        return scale_for(float(np.max(finite, initial=0.0)) or 1.0, self.unit)

    def axis(self, scale: Scale) -> str:
        """Label of an axis in that unit."""
        return " ".join(filter(None, [self.name, self.symbol, f"[{scale.unit}]" if scale.unit else ""]))


@dataclass(frozen=True)
class Scale:
    """A unit to show values in, and what SI values are multiplied with."""

    factor: float
    unit: str

    def text(self, value: Any) -> str:
        """A value, SI, with its unit; a text as it is."""
        if not isinstance(value, int | float):
            return str(value)
        return f"{value * self.factor:.4g} {self.unit}".rstrip()


# Not prefixed either: limits of a current density are published in A/mm^2, and speeds are told in rpm.
_OWN = {"A/m**2": Scale(1e-6, "A/mm²"), "rad/s": Scale(30.0 / np.pi, "rpm")}


def label_of(key: str, case: AnyCase) -> Label:
    """Name, symbol and unit of a varied key or of a value of the summary.

    Parameters
    ----------
    key : str
        Dotted key of the case or of the summary; "inputs." before one of the case makes no difference.
    case : Case or BearingCase
        Of a line contact, whose capacitances are per length, or of a point contact.

    Returns
    -------
    Label
        With the dotted key as its name where that is all that is known.
    """
    own = key.removeprefix("inputs.")
    kind = kind_of(own)
    if kind is not None or own in _INPUTS:
        unit = kind.unit if isinstance(kind, Quantity) else ""
        parameter = law_parameters().get(own.removeprefix("lubricant."))
        if parameter is not None and parameter.title:
            return Label(parameter.title, parameter.symbol, unit)
        return Label(*_INPUTS.get(own, (own, "")), unit)
    name, symbol = _VALUES.get(key) or _VALUES.get(key.rstrip("0123456789").rstrip("."), (key, ""))
    return Label(name, symbol, _unit_of(key, case))


def _unit_of(key: str, case: AnyCase) -> str:
    """SI unit of a value of the summary."""
    table, *_ = parts = [part for part in key.split(".") if not part.isdigit()]
    if table in ("seconds", "inputs"):
        # Inputs that are no numbers are lists of those without a unit.
        return "s" if table == "seconds" else ""
    if key.startswith("roughness.surfaces.") and parts[-1] == "size":
        return ""  # points of a profile or a map
    if "capacitance_by_zone" in parts:
        return "F"  # a point contact has them alone
    words = parts[-1].split("_")
    if "capacitance" in parts[-1] and "ratio" not in words:
        # Those of all zones are per length of a line; field.capacitance is a point contact's alone.
        of_line = isinstance(case, Case) and case.contact.geometry == "line"
        return "F/m" if of_line and "external" not in words else "F"
    return next((unit for names, unit in _UNITS if set(names) & set(words)), "")


def scale_for(largest: float, unit: str) -> Scale:
    """Prefix of a unit by the largest of the values.

    Parameters
    ----------
    largest : float
        Above 0, SI.
    unit : str
        SI unit as pint writes it.

    Returns
    -------
    Scale
        With the unit as it is printed.

    Examples
    --------
    >>> scale_for(2.2e-8, "1/Pa")
    Scale(factor=1000000000.0, unit='1/GPa')
    >>> scale_for(3e-12, "m**2")
    Scale(factor=1000000000000.0, unit='µm²')
    >>> scale_for(0.04, "Pa*s")
    Scale(factor=1000.0, unit='mPa s')
    """
    if unit in _PLAIN:
        return Scale(1.0, unit)
    if unit in _OWN:
        return _OWN[unit]
    # With it comes matplotlib, which names and units alone do not take.
    from ehlectric.cases.quantity import unit_for

    if unit.startswith("1/"):
        # One over a value in the prefixed unit: the prefix of what is below the line.
        factor, prefixed = unit_for(1.0 / largest, unit[2:], least=0.001)
        return Scale(round_factor(1.0 / factor), f"1/{prefixed}")
    base, power = (unit[:-3], int(unit[-1])) if unit in ("m**2", "m**3") else (unit, 1)
    if unit == "s":
        largest = min(largest, 1.0)
    factor, prefixed = unit_for(largest ** (1.0 / power), base)
    return Scale(round_factor(factor) ** power, _printed(prefixed) + {1: "", 2: "²", 3: "³"}[power])


def round_factor(factor: float) -> float:
    """The power of ten that a factor is, without the rounding of one over a negative power.

    Examples
    --------
    >>> round_factor(1 / 1e-6)
    1000000.0
    """
    return float(f"{factor:.9g}")


def _printed(unit: str) -> str:
    """A unit of pint's as it is printed."""
    return unit.replace("**3", "³").replace("**2", "²").replace("*", " ").replace("ohm", "Ω")
