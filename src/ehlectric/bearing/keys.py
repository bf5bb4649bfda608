"""Keys of the summary.json of a bearing."""

from __future__ import annotations

from ehlectric.bearing.fits.keys import CLEARANCE_KEYS
from ehlectric.bearing.friction.keys import FRICTION_KEYS
from ehlectric.bearing.intermittency.keys import CONTACT_DUTY_KEYS, DUTY_KEYS
from ehlectric.bearing.margin.keys import EFFECT_KEYS, MARGIN_KEYS
from ehlectric.bearing.meter.keys import METER_KEYS
from ehlectric.bearing.supply.keys import SUPPLY_KEYS
from ehlectric.cases.oils.keys import OIL_KEYS
from ehlectric.cases.result_key import Keys, ResultKey, under

_ABOUT: Keys = {
    "schema": ResultKey("name of the format"),
    "version": ResultKey("version of the program"),
    "title": ResultKey("title of the bearing file"),
    "converged": ResultKey("whether all contacts were solved"),
    "warnings": ResultKey(
        "warnings, to be read before the numbers are used; contacts are named by ring and load, but for what "
        "all of them share"
    ),
    "warning_codes": ResultKey(
        "code of each warning, in the same order: programs decide by codes, as words may change"
    ),
    "verdict": ResultKey(
        "answer in sentences: whether breakdown is expected at the shaft voltage, below which speed, and "
        "what is assumed; points of sweeps have none"
    ),
    "inputs": ResultKey("the bearing file, its base resolved"),
}
_LUBRICANT: Keys = {
    **OIL_KEYS,
    "temperature": ResultKey(
        "temperature of the oil outside the films; that of `bearing.temperature`, not the input table of "
        "that name",
        "K",
        "temperature of the oil",
    ),
    "inner_temperature": ResultKey(
        "temperature of the inner ring and of the oil in its contacts", "K", "temperature of the inner ring"
    ),
    "inner_viscosity": ResultKey(
        "viscosity of the oil in the inner contacts", "Pa*s", "viscosity at the inner ring"
    ),
    "inner_film_factor": ResultKey("film factor of the inner contacts", "", "film factor at the inner ring"),
    "outer_temperature": ResultKey(
        "temperature of the outer ring and of the oil in its contacts", "K", "temperature of the outer ring"
    ),
    "outer_viscosity": ResultKey(
        "viscosity of the oil in the outer contacts", "Pa*s", "viscosity at the outer ring"
    ),
    "outer_film_factor": ResultKey("film factor of the outer contacts", "", "film factor at the outer ring"),
    "expansion": ResultKey(
        "coefficient of thermal expansion; null without `[lubricant.temperature]`",
        "1/K",
        "thermal expansion of the oil",
        "$a$",
    ),
    "conductivity": ResultKey(
        "electrical conductivity of the oil: `discharge.conductivity`, or that of the lubricant at the "
        "temperature; null without both",
        "S/m",
        "conductivity of the oil",
        r"$\sigma$",
    ),
    "film_factor": ResultKey(
        "the same as `bearing.film_factor`, under a key that no input has: a sweep over that input has both",
        "",
        "film factor, resolved",
        "$C$",
    ),
}
_CAPACITANCES: Keys = {
    "contacts": ResultKey('how films and fields were obtained: "solved", "atlas" or "formula"'),
    "capacitance": ResultKey(
        "capacitance of the smooth films from ring to ring, mean over the positions of the cage, with `fill` "
        "around the films; of ceramic elements an upper bound, or what the file gives",
        "F",
        "capacitance of the bearing",
        "$C$",
    ),
    "capacitance_oil": ResultKey(
        "capacitance with oil around the films", "F", "capacitance of the bearing, all in oil"
    ),
    "capacitance_air": ResultKey(
        "capacitance with air around the films", "F", "capacitance of the bearing, air around the films"
    ),
    "capacitance_plate": ResultKey(
        "ε0 ε_r A_H/h(0) of the dry contacts, in series and parallel; elements without load have none; null "
        "for ceramic elements",
        "F",
        "capacitance of parallel plates",
    ),
    "capacitance_ratio": ResultKey(
        "capacitance / capacitance_plate; null for ceramic elements", "", "capacitance / parallel plates"
    ),
    "lambda_ratio": ResultKey(
        "minimum film of all loaded contacts / composite_rq",
        "",
        "minimum film / roughness",
        r"$\lambda$",
    ),
    "lubrication": ResultKey(
        'state of lubrication: "conducting" for a lambda below 1, where contacts open and close and no '
        'voltage is computed, or "touching" of ceramic elements, "partial film" below 3, "full film"',
        "",
        "state of lubrication",
    ),
    "film_factor": ResultKey(
        "factor on the isothermal, fully flooded film, heat times supply; of the ring whose films it reduces "
        "more",
        "",
        "film factor",
    ),
}
_VOLTAGES: Keys = {
    "first_break": ResultKey(
        "bearing voltage, from ring to ring, at which the first contact breaks down, minimum over the "
        "positions; by a Weibull strength that at which one of all has with a probability of 63.2 %; null "
        "without a strength, for a conducting bearing and for ceramic elements",
        "V",
        "first breakdown voltage",
    ),
    "first_break_mean": ResultKey(
        "mean of first_break over the positions", "V", "first breakdown voltage, mean over a pitch"
    ),
    "first_break_at": ResultKey(
        "contact that breaks down first, or by a Weibull strength the likeliest",
        "",
        "contact of the first breakdown",
    ),
    "through_breakdown": ResultKey(
        "bearing voltage at which the first element breaks down through both contacts; by a Weibull strength "
        "each at its own 63.2 %",
        "V",
        "ring-to-ring breakdown voltage",
    ),
    "through_breakdown_mean": ResultKey(
        "mean of through_breakdown over the positions",
        "V",
        "ring-to-ring breakdown voltage, mean over a pitch",
    ),
    "margin": ResultKey(
        "shaft_first_break / shaft voltage; null without a motor",
        "",
        "margin (first breakdown / shaft voltage)",
    ),
    "breakdown_probability": ResultKey(
        "probability that a contact has broken down at the shaft voltage while no metallic contact shorts "
        "the bearing, 1 − exp(−1/margin^m) with the shape m of a Weibull law, at the weakest position; "
        "`insulating_time_share` is the share of time in which that is possible; null as margin is, and "
        "without this law",
        "",
        "probability of breakdown at the shaft voltage",
    ),
    "through_margin": ResultKey(
        "shaft_through_breakdown / shaft voltage; null without a motor",
        "",
        "margin (ring-to-ring breakdown / shaft voltage)",
    ),
    "strength_per_volt": ResultKey(
        "maximum field strength of a contact / bearing voltage, maximum over the positions; null for a "
        "conducting bearing and for ceramic elements",
        "1/m",
        "maximum field strength per volt on the bearing",
    ),
    "max_strength": ResultKey(
        "maximum field strength at the shaft voltage, before anything has broken down; null without a motor",
        "V/m",
        "maximum field strength",
    ),
    "bearing_voltage_ratio": ResultKey(
        "C_wr/(C_wr + C_rf + C_DE + C_NDE); null without a motor, for a conducting bearing, and for ceramic "
        "elements without element_capacitance",
        "",
        "bearing voltage ratio",
    ),
    "shaft_voltage": ResultKey(
        "bearing_voltage_ratio times the common-mode voltage, peak; capacitive alone; null as that ratio is",
        "V",
        "shaft voltage",
    ),
    "relaxation_time": ResultKey("charge relaxation time ε0 ε_r/σ; null without a conductivity", "s"),
    "shaft_time_constant": ResultKey(
        "time constant with which the shaft voltage decays through the oil of both bearings, right after an "
        "edge of the inverter; null without a conductivity or a motor, for a conducting bearing and for "
        "ceramic elements",
        "s",
        "time constant of the shaft voltage",
    ),
    "shaft_voltage_after_period": ResultKey(
        "shaft voltage that is left after a period of the inverter; null without `motor.switching_frequency` "
        "and as shaft_time_constant is",
        "V",
        "shaft voltage after a period of the inverter",
    ),
    "shaft_voltage_after_rise": ResultKey(
        "shaft voltage at the end of an edge of the inverter, with leakage through the oil; null without "
        "`motor.rise_time` and as shaft_time_constant is",
        "V",
        "shaft voltage after an edge of the inverter",
    ),
    "discharged_capacitance": ResultKey(
        "capacitance that a discharge empties: bearing, winding and frame to rotor, and second bearing, or "
        "`discharge.external_capacitance` without a motor, all but the bearing in series with its coating; "
        "null where nothing is given, for a conducting bearing and for ceramic elements",
        "F",
        "discharged capacitance",
    ),
    "bearing_energy": ResultKey(
        "energy C V²/2 in the films alone at the shaft voltage, of which film_voltage is across them; null "
        "without a motor",
        "J",
        "energy in the bearing",
    ),
    "discharge_energy": ResultKey(
        "energy C V²/2 in discharged_capacitance at the shaft voltage, with V = film_voltage; null without a "
        "motor",
        "J",
        "energy of a discharge at the shaft voltage",
    ),
    "breakdown_energy": ResultKey(
        "energy C V²/2 in discharged_capacitance at the first breakdown; null as either is",
        "J",
        "energy of a discharge at the first breakdown",
    ),
    "pit_volume": ResultKey(
        "volume of one surface that discharge_energy melts; null without `[discharge.pit]`",
        "m**3",
        "melted volume",
    ),
    "pit_diameter": ResultKey(
        "diameter of a hemisphere of that volume; null as pit_volume is",
        "m",
        "diameter of the pit",
    ),
    "breakdown_pit_diameter": ResultKey(
        "diameter of the hemisphere that breakdown_energy melts; null without `[discharge.pit]`",
        "m",
        "diameter of the pit at the first breakdown",
    ),
    "hertz_area": ResultKey(
        "area of the smaller dry contact of each element that both rings load, added up, the cage in its "
        "first position",
        "m**2",
        "area of the dry contacts",
    ),
    "current_density": ResultKey(
        "peak current / hertz_area; null without `discharge.peak_current`", "A/m**2", "current density"
    ),
    "element_current_density": ResultKey(
        "peak current / area of the smaller contact of the most loaded element, as if it alone carried the "
        "current; null without `discharge.peak_current`",
        "A/m**2",
        "current density of one element",
    ),
    "current_density_limits": ResultKey(
        "published limits of current_density: 0.1 to 0.3 A/mm² (doi:10.3390/lubricants12050148) and 0.8 "
        "A/mm² (Busse et al. 1997, as quoted by doi:10.3390/lubricants10050087); null without a current",
        "A/m**2",
    ),
    "discretisation_error": ResultKey(
        "maximum estimated error of the solved films; null where one is not known, and for contacts from the "
        "atlas"
    ),
    "film_error": ResultKey(
        "estimated error of the films and their interpolation over the load; for contacts from the atlas "
        "of loads above 2 % of the largest, for contacts by formula that of the formula"
    ),
    "interpolation_error": ResultKey(
        "maximum error at a load that is left out of the interpolation; of the breakdown voltage only for at "
        "least 2 % of the largest load"
    ),
}
_MECHANICS: Keys = {
    "max_load": ResultKey("load of the most loaded contact with the outer ring", "N"),
    "radial_displacement": ResultKey(
        "radial displacement of the inner ring against the outer one, the clearance included", "m"
    ),
    "axial_displacement": ResultKey("axial displacement of the inner ring; null for rollers", "m"),
    "moment": ResultKey("moment that holds the inner ring from tilting; null for rollers", "N*m"),
    "centrifugal_force": ResultKey("centrifugal force on each element", "N"),
    "gyroscopic_moment": ResultKey(
        "maximum gyroscopic moment of a ball; reported, its effect is left out; null for rollers", "N*m"
    ),
    "cage_speed": ResultKey(
        "speed of the cage in pure rolling; of balls the mean of theirs, weighted with their load", "rad/s"
    ),
    "element_speed": ResultKey(
        "maximum speed of the elements about their own axes, seen from the cage, in pure rolling", "rad/s"
    ),
    "entrainment_speed": ResultKey("maximum entrainment speed, without the film factor", "m/s"),
    "entrainment_speed_inner": ResultKey("maximum entrainment speed at the inner ring", "m/s"),
    "entrainment_speed_outer": ResultKey(
        "maximum entrainment speed at the outer ring; equal to that of the inner one in pure rolling", "m/s"
    ),
    "residual": ResultKey("maximum unbalanced force on ring or element / (load + centrifugal force)"),
}

# Keys of a row of ``contacts``, which are also the columns of contacts.csv.
CONTACT_KEYS: Keys = {
    "element": ResultKey("number of the element from 0, which lies on the load line"),
    "ring": ResultKey('"inner" or "outer"'),
    "position": ResultKey("angle of the element from the direction of the load", "rad"),
    "load": ResultKey("load of the contact", "N"),
    "contact_angle": ResultKey("contact angle; where there is no contact that of the narrowest place", "rad"),
    "max_pressure": ResultKey("Hertz pressure of the dry contact; null without load", "Pa"),
    "semi_axis_x": ResultKey(
        "semi-axis of the dry contact along entrainment, of a roller its half-width; null without load", "m"
    ),
    "semi_axis_y": ResultKey(
        "semi-axis across entrainment, of a roller half of its length; null without load", "m"
    ),
    "minimum_thickness": ResultKey("minimum film thickness, or the gap where there is no contact", "m"),
    "central_thickness": ResultKey("central film thickness, or the gap where there is no contact", "m"),
    "lambda_ratio": ResultKey("minimum_thickness / composite_rq"),
    "regime": ResultKey(
        '"full film" from a lambda_ratio of 3 on; "partial film" below, where asperities touch at times; '
        '"touching" below 1, with contacts that open and close; "gap" without load'
    ),
    **CONTACT_DUTY_KEYS,
    "capacitance": ResultKey(
        "capacitance of the contact, with `fill` around it; null for ceramic elements", "F"
    ),
    "voltage_share": ResultKey(
        "share of the bearing's voltage on the contact; null for ceramic elements and a conducting bearing"
    ),
    "strength_per_volt": ResultKey(
        "maximum field strength of the contact / bearing voltage; null for a conducting bearing and for "
        "ceramic elements",
        "1/m",
    ),
    "max_strength": ResultKey("that field strength at the shaft voltage; null without a motor", "V/m"),
    "breakdown_voltage": ResultKey(
        "voltage on the contact itself, not on the bearing, at which it breaks down; null without a "
        "strength, for a conducting bearing and for ceramic elements",
        "V",
    ),
    "bearing_breakdown_voltage": ResultKey(
        "bearing voltage at which the contact breaks down, breakdown_voltage / voltage_share; null as "
        "breakdown_voltage is",
        "V",
    ),
    "solved": ResultKey("whether there is a film; a gap of rigid bodies otherwise"),
}

BEARING_KEYS: Keys = {
    **_ABOUT,
    **under("lubricant", _LUBRICANT),
    **under("bearing", CLEARANCE_KEYS),
    **under("bearing", _CAPACITANCES),
    **under("bearing", SUPPLY_KEYS),
    **under("bearing", FRICTION_KEYS),
    **under("bearing", DUTY_KEYS),
    **under("bearing", _VOLTAGES),
    **under("bearing", METER_KEYS),
    **under("margin", MARGIN_KEYS),
    **under("margin.effects", EFFECT_KEYS),
    **under("mechanics", _MECHANICS),
    "contacts": ResultKey(
        "list with each contact, the cage in its first position; contacts.csv has the same"
    ),
    **under("contacts", CONTACT_KEYS),
    "seconds": ResultKey("computing time", "s"),
}
