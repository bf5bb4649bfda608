"""Results of a bearing: the keys of its summary.json."""

from __future__ import annotations

from ehlectric.quantities.oil_results import OIL_KEYS
from ehlectric.quantities.quantity import Keys, Quantity, under

CLEARANCE_KEYS: Keys = {
    "unmounted_clearance": Quantity(
        "radial clearance before mounting, given or of the class; null without `[bearing.fits]`",
        "m",
        "radial clearance before mounting",
    ),
    "mounted_clearance": Quantity(
        "radial clearance with the fits at their reference temperature; null without `[bearing.fits]`",
        "m",
        "radial clearance, mounted",
    ),
    "running_clearance": Quantity(
        "radial clearance in operation, on which loads and gaps are computed: given, from the free contact "
        "angle, or with `[bearing.fits]` from mounting and temperatures; negative with a preload",
        "m",
        "radial clearance in operation",
    ),
    "running_shaft_interference": Quantity(
        "interference of inner ring and shaft in operation, negative where loose; null without fits",
        "m",
        "interference on the shaft",
    ),
    "running_housing_interference": Quantity(
        "interference of outer ring and housing in operation, negative where loose; null without fits",
        "m",
        "interference in the housing",
    ),
    "shaft_pressure": Quantity(
        "pressure between inner ring and shaft in operation; null without fits", "Pa", "pressure on the shaft"
    ),
    "housing_pressure": Quantity(
        "pressure between outer ring and housing in operation; null without fits",
        "Pa",
        "pressure on the housing",
    ),
}

# Why there is no number.
_NULL = 'null unless `bearing.film_factor` is "solved"'


def _of_ring(name: str) -> dict[str, Quantity]:
    """Keys of the most loaded contact with a ring."""
    most, at = f"most loaded contact with the {name} ring", f", {name} ring"
    return {
        f"{name}_rolling_coefficient": Quantity(
            f"hydrodynamic rolling force on one surface over the load, of the {most}, solved with heat in "
            f"pure rolling; {_NULL}",
            "",
            f"rolling coefficient, {name} ring",
        ),
        f"{name}_contact_power_loss": Quantity(
            f"power that rolling takes in the {most}; {_NULL}", "W", f"power loss, most loaded {name} contact"
        ),
        f"{name}_inlet_temperature_rise": Quantity(
            f"largest temperature at mid-film from the inlet to the middle of the {most}, less that of the "
            f"ring; {_NULL}",
            "K",
            f"inlet temperature rise, {name} contact",
            digits=".2g",
        ),
        f"{name}_max_temperature_rise": Quantity(
            f"largest temperature at mid-film in the {most}, less that of the ring: mostly a peak at the "
            f"pressure spike, which grows with the grid; {_NULL}",
            "K",
            f"maximum temperature rise{at}",
        ),
        f"{name}_temperature_rise_error": Quantity(
            f"estimated error of {name}_max_temperature_rise by the grid; null if unknown",
            "K",
            f"error of the temperature rise{at}",
        ),
    }


FRICTION_KEYS: Keys = {
    "rolling_power_loss": Quantity(
        "power that the hydrodynamic rolling resistance of all contacts takes, flooded, mean over the "
        "positions of the cage: a part of the friction of a bearing, without spin and slip of the balls, "
        f"cage, ribs, seals, churned oil and hysteresis; {_NULL}",
        "W",
        "hydrodynamic rolling power loss",
    ),
    "rolling_moment": Quantity(
        f"rolling_power_loss over the speed of the inner ring; {_NULL}",
        "N*m",
        "hydrodynamic rolling moment",
        shown="N mm",
        digits=".3g",
    ),
    **_of_ring("inner"),
    **_of_ring("outer"),
}

DUTY_KEYS: Keys = {
    "regime": Quantity(
        'what the bearing is electrically, in one word: "capacitive" up to a contact_time_share of 1 %, '
        '"resistive" above 99 %, else "intermittent"; with a lambda_ratio below 1 it is not called '
        "capacitive, but for ceramic elements and a coating, which insulate",
        "",
        "electrical regime",
    ),
    "contact_time_share": Quantity(
        "share of time in which metallic contacts short the bearing: elements in parallel, both contacts of "
        "an element in series, mean over the positions; 0 for ceramic elements and with a coating",
        "",
        "share of time with contact",
    ),
    "insulating_time_share": Quantity(
        "share of time in which no element touches both rings, and the breakdown voltages can be reached at "
        "all: 1 - touching_time_share",
        "",
        "share of time without contact",
    ),
    "touching_time_share": Quantity(
        "share of time in which at least one element touches both rings, whether or not it conducts",
        "",
        "share of time an element touches",
    ),
    "clarke_time_share": Quantity(
        "touching_time_share with Clarke's 1 - erf(λ) for each contact; with `[bearing.summits]` beside the "
        "one from the number of spots",
        "",
        "share of time with contact, after Clarke",
    ),
    "contact_model": Quantity(
        'what contact_time_share of each contact is from: "clarke", or "greenwood_williamson" with '
        "`[bearing.summits]`"
    ),
    "inner_lambda_ratio": Quantity(
        "minimum film of the loaded contacts with the inner ring / composite_rq",
        "",
        "minimum lambda ratio, inner ring",
        r"$\lambda_\mathrm{i}$",
    ),
    "outer_lambda_ratio": Quantity(
        "minimum film of the loaded contacts with the outer ring / composite_rq",
        "",
        "minimum lambda ratio, outer ring",
        r"$\lambda_\mathrm{o}$",
    ),
    "inner_contact_time_share": Quantity(
        "maximum share of time with metallic contact of a contact with the inner ring",
        "",
        "share of time with contact, inner ring",
    ),
    "outer_contact_time_share": Quantity(
        "maximum share of time with metallic contact of a contact with the outer ring",
        "",
        "share of time with contact, outer ring",
    ),
    "asperity_share": Quantity(
        "maximum share of a contact's load that asperities carry, after Patir and Cheng's exp(-1.8 λ^1.2) "
        "with the λ of the central film",
        "",
        "asperity load share, Patir and Cheng",
    ),
    "asperity_share_low": Quantity(
        "least share of that contact by the published laws, each within its range",
        "",
        "asperity load share, lowest law",
    ),
    "asperity_share_high": Quantity(
        "largest share of that contact by the published laws", "", "asperity load share, highest law"
    ),
    "expected_spots": Quantity(
        "maximum expected number of simultaneous spots in a contact; null without `[bearing.summits]`",
        "",
        "expected spots in a contact",
    ),
}

# Keys of a row of ``contacts``.
CONTACT_DUTY_KEYS: Keys = {
    "central_lambda_ratio": Quantity("central_thickness / composite_rq; null without load"),
    "asperity_share": Quantity("share of the load on asperities, after Patir and Cheng; of the central film"),
    "asperity_share_low": Quantity("least of the published laws, each within its range"),
    "asperity_share_high": Quantity("largest of the published laws"),
    "contact_probability": Quantity(
        "share of time with metallic contact by Clarke's 1 - erf(central_lambda_ratio)"
    ),
    "expected_spots": Quantity(
        "expected number of simultaneous spots in the Hertz area; null without `[bearing.summits]`"
    ),
    "contact_time_share": Quantity(
        "share of time with metallic contact: 1 - exp(-expected_spots), or contact_probability without them"
    ),
}

MARGIN_KEYS: Keys = {
    "level": Quantity(
        'colour of the verdict: "green", "yellow" where the margin may lie on either side of 1 or surfaces '
        'may touch, "red" where breakdown is expected or surfaces touch under a voltage, or "grey" where '
        "there is nothing to compare"
    ),
    "critical_speed": Quantity(
        "speed of the inner ring at which the margin is 1, and below which breakdown is expected; by film "
        "formulas that are scaled to `bearing.margin` at the speed of the file, at one temperature; null "
        "where the margin does not cross 1 between `lowest_speed` and `highest_speed`",
        "rad/s",
        "critical speed",
        bound="≥",
    ),
    "upper_critical_speed": Quantity(
        "speed of the inner ring above which the margin is below 1 again, up to `highest_speed`; null where "
        "it is not",
        "rad/s",
        "upper critical speed",
        bound="≤",
    ),
    "touching_speed": Quantity(
        "speed of the inner ring below which the surfaces touch; null where they do not in that range",
        "rad/s",
        "speed below which surfaces touch",
        bound="≥",
    ),
    "capacitive_speed": Quantity(
        "speed of the inner ring from which the bearing is capacitive at its temperature: it conducts at "
        "most 1 % of the time and its lambda ratio is at least 1; by quick films that are scaled to those at "
        "the speed of the file; null where it becomes so nowhere from a 27th to 27 times that speed, and for "
        "ceramic elements and a coating",
        "rad/s",
        "lowest speed of the capacitive regime",
        bound="≥",
    ),
    "lowest_speed": Quantity("lower end of the speeds that were searched", "rad/s"),
    "highest_speed": Quantity("upper end of the speeds that were searched", "rad/s"),
    "low": Quantity(
        "margin with all inputs of `[ranges]` at their unfavourable ends, 0 where the surfaces touch; null "
        "without ranges",
        "",
        "margin, inputs at unfavourable ends",
        bound="≤",
    ),
    "high": Quantity(
        "margin with all inputs of `[ranges]` at their favourable ends; null without ranges",
        "",
        "margin, inputs at favourable ends",
        bound="≤",
    ),
    "effects": Quantity("list of the effects of single inputs on the margin, the largest first", bound="≤"),
    "left_out": Quantity("list of what could not be computed, and why"),
}

EFFECT_KEYS: Keys = {
    "key": Quantity("dotted key of the input"),
    "label": Quantity("name of the input"),
    "low_input": Quantity("smaller value of the input, in the SI unit of its key"),
    "high_input": Quantity("larger value of the input, in the SI unit of its key"),
    "low_margin": Quantity("margin at `low_input`, 0 where the surfaces touch"),
    "high_margin": Quantity("margin at `high_input`, 0 where the surfaces touch"),
}

METER_KEYS: Keys = {
    "capacitance_rough": Quantity(
        "capacitance of the films with the roughness `composite_rq` in their Hertz areas; null where a "
        "loaded contact has a central film below 2 composite_rq, and for ceramic elements",
        "F",
        "capacitance, rough films",
    ),
    "roughness_factor": Quantity(
        "capacitance_rough / capacitance; null as capacitance_rough is",
        "",
        "rough / smooth capacitance",
    ),
    "coating_capacitance": Quantity(
        "capacitance of the coating on a ring; null without one", "F", "capacitance of the coating"
    ),
    "coating_breakdown": Quantity(
        "breakdown voltage of the coating alone; null where none is given",
        "V",
        "breakdown voltage of the coating",
    ),
    "coating_margin": Quantity(
        "coating_breakdown / shaft voltage: once a film has broken down, the coating carries nearly all of "
        "the shaft voltage; null as either is",
        "",
        "coating breakdown / shaft voltage",
    ),
    "film_share": Quantity(
        "share of the shaft voltage across the films by the capacitive divider of films and coating; 1 "
        "without a coating; null where surfaces touch, and for ceramic elements without element_capacitance",
        "",
        "voltage share of the films",
    ),
    "coating_share": Quantity(
        "share of the shaft voltage across the coating; null without one and as film_share is",
        "",
        "voltage share of the coating",
        shown="%",
    ),
    "parallel_capacitance": Quantity(
        "capacitance of cage, shields and wiring; 0 where none is given", "F", "parallel capacitance"
    ),
    "shaft_capacitance": Quantity(
        "capacitance from shaft to housing, of smooth films, coating and parallel capacitance, with which "
        "the shaft voltage is computed",
        "F",
        "capacitance from shaft to housing",
        bound="≤",
    ),
    "meter_capacitance": Quantity(
        "capacitance that a meter reads from shaft to housing, the same with rough films; null as "
        "capacitance_rough is, but for ceramic elements with element_capacitance",
        "F",
        "capacitance that a meter reads",
    ),
    "shaft_first_break": Quantity(
        "shaft voltage at which the first contact breaks down: first_break over the share of the films, "
        "minimum over the positions; first_break without a coating; null as first_break is",
        "V",
        "shaft voltage of the first breakdown",
        bound="≤",
    ),
    "shaft_through_breakdown": Quantity(
        "shaft voltage of the ring-to-ring breakdown; through_breakdown without a coating; null likewise",
        "V",
        "shaft voltage, ring-to-ring breakdown",
        bound="≤",
    ),
    "film_voltage": Quantity(
        "part of the shaft voltage across the films, from ring to ring; null as shaft_voltage is",
        "V",
        "voltage across the films",
        bound="≤",
    ),
    "film_time_constant": Quantity(
        "time constant with which the voltage across the films decays right after an edge of the inverter; "
        "shaft_time_constant without a coating, and null as that is",
        "s",
        "time constant of the films",
    ),
    "switching_period": Quantity(
        "period of the inverter, 1 / `motor.switching_frequency`; null without it",
        "s",
        "period of the inverter",
    ),
    "film_voltage_after_period": Quantity(
        "voltage across the films that is left after a period of the inverter; null as "
        "shaft_voltage_after_period is",
        "V",
        "voltage across the films after a period",
    ),
}

SUPPLY_KEYS: Keys = {
    "heat_factor": Quantity(
        "part of the film factor by the heat, of the inlet by formula or of the solved film; 1 for an "
        "isothermal film; of the ring whose films it reduces more; null where `bearing.film_factor` is a "
        "number, which may stand for more",
        "",
        "film factor of the heat",
    ),
    "inlet_shear_factor": Quantity(
        "part of the film factor by the heat in the inlet after Wilson and Sheu, also beside that of the "
        "solved film; of the ring where it is smaller; null unless `bearing.film_factor` is "
        '"inlet-shear" or "solved"',
        "",
        "film factor of the heat, by formula",
    ),
    "supply_factor": Quantity(
        "part of the film factor by the supply of oil: film over the fully flooded one, 1 for "
        '"flooded"; of the ring whose films it reduces more',
        "",
        "film factor of the supply",
    ),
    "film_half_time": Quantity(
        "time in which the film of the most loaded contact would halve if no oil returned to its track "
        "(van Zoelen, Venner and Lugt); null for a flooded bearing and for rollers",
        "s",
        "half time of the film without supply",
    ),
}

_ABOUT: Keys = {
    "schema": Quantity("name of the format"),
    "version": Quantity("version of the program"),
    "title": Quantity("title of the bearing file"),
    "converged": Quantity("whether all contacts were solved"),
    "warnings": Quantity(
        "warnings, to be read before the numbers are used; contacts are named by ring and load, but for what "
        "all of them share"
    ),
    "warning_codes": Quantity(
        "code of each warning, in the same order: programs decide by codes, as words may change"
    ),
    "verdict": Quantity(
        "answer in sentences: whether breakdown is expected at the shaft voltage, below which speed, and "
        "what is assumed; points of sweeps have none"
    ),
    "inputs": Quantity("the bearing file, its base resolved"),
}
_LUBRICANT: Keys = {
    **OIL_KEYS,
    "temperature": Quantity(
        "temperature of the oil outside the films; that of `bearing.temperature`, not the input table of "
        "that name",
        "K",
        "temperature of the oil",
        shown="°C",
    ),
    "inner_temperature": Quantity(
        "temperature of the inner ring and of the oil in its contacts",
        "K",
        "temperature of the inner ring",
        shown="°C",
    ),
    "inner_viscosity": Quantity(
        "viscosity of the oil in the inner contacts", "Pa*s", "viscosity at the inner ring", shown="mPa s"
    ),
    "inner_film_factor": Quantity("film factor of the inner contacts", "", "film factor at the inner ring"),
    "outer_temperature": Quantity(
        "temperature of the outer ring and of the oil in its contacts",
        "K",
        "temperature of the outer ring",
        shown="°C",
    ),
    "outer_viscosity": Quantity(
        "viscosity of the oil in the outer contacts", "Pa*s", "viscosity at the outer ring", shown="mPa s"
    ),
    "outer_film_factor": Quantity("film factor of the outer contacts", "", "film factor at the outer ring"),
    "expansion": Quantity(
        "coefficient of thermal expansion; null without `[lubricant.temperature]`",
        "1/K",
        "thermal expansion of the oil",
        "$a$",
    ),
    "conductivity": Quantity(
        "electrical conductivity of the oil: `discharge.conductivity`, or that of the lubricant at the "
        "temperature; null without both",
        "S/m",
        "conductivity of the oil",
        r"$\sigma$",
    ),
    "film_factor": Quantity(
        "the same as `bearing.film_factor`, under a key that no input has: a sweep over that input has both",
        "",
        "film factor, resolved",
        "$C$",
    ),
}
_CAPACITANCES: Keys = {
    "contacts": Quantity(
        'how films and fields were obtained: "solved", "atlas" or "formula"', "", "films of the contacts"
    ),
    "capacitance": Quantity(
        "capacitance of the smooth films from ring to ring, mean over the positions of the cage, with `fill` "
        "around the films; of ceramic elements an upper bound, or what the file gives",
        "F",
        "capacitance of the bearing",
        "$C$",
        bound="≤",
    ),
    "capacitance_oil": Quantity(
        "capacitance with oil around the films", "F", "capacitance, oil in all gaps", bound="≤"
    ),
    "capacitance_air": Quantity(
        "capacitance with air around the films", "F", "capacitance, air around the films", bound="≤"
    ),
    "capacitance_plate": Quantity(
        "ε0 ε_r A_H/h(0) of the dry contacts, in series and parallel; elements without load have none; null "
        "for ceramic elements",
        "F",
        "capacitance of parallel plates",
    ),
    "capacitance_ratio": Quantity(
        "capacitance / capacitance_plate; null for ceramic elements", "", "capacitance / parallel plates"
    ),
    "lambda_ratio": Quantity(
        "minimum film of all loaded contacts / composite_rq",
        "",
        "minimum lambda ratio",
        r"$\lambda$",
        digits=".3g",
        bound="≤",
    ),
    "lubrication": Quantity(
        'state of lubrication: "conducting" for a lambda below 1, where contacts open and close and no '
        'voltage is computed, or "touching" of ceramic elements, "partial film" below 3, "full film"',
        "",
        "state of lubrication",
    ),
    "film_factor": Quantity(
        "factor on the isothermal, fully flooded film, heat times supply; of the ring whose films it reduces "
        "more",
        "",
        "film factor",
    ),
}
_VOLTAGES: Keys = {
    "first_break": Quantity(
        "bearing voltage, from ring to ring, at which the first contact breaks down, minimum over the "
        "positions; by a Weibull strength that at which one of all has with a probability of 63.2 %; null "
        "without a strength, for a conducting bearing and for ceramic elements",
        "V",
        "first breakdown voltage",
        bound="≤",
    ),
    "first_break_mean": Quantity(
        "mean of first_break over the positions", "V", "mean first breakdown voltage", bound="≤"
    ),
    "first_break_at": Quantity(
        "contact that breaks down first, or by a Weibull strength the likeliest",
        "",
        "contact of the first breakdown",
    ),
    "through_breakdown": Quantity(
        "bearing voltage at which the first element breaks down through both contacts; by a Weibull strength "
        "each at its own 63.2 %",
        "V",
        "ring-to-ring breakdown voltage",
        bound="≤",
    ),
    "through_breakdown_mean": Quantity(
        "mean of through_breakdown over the positions",
        "V",
        "mean ring-to-ring breakdown voltage",
        bound="≤",
    ),
    "margin": Quantity(
        "shaft_first_break / shaft voltage; null without a motor",
        "",
        "margin (first breakdown / shaft voltage)",
        bound="≤",
    ),
    "breakdown_probability": Quantity(
        "probability that a contact has broken down at the shaft voltage while no metallic contact shorts "
        "the bearing, 1 − exp(−1/margin^m) with the shape m of a Weibull law, at the weakest position; "
        "`insulating_time_share` is the share of time in which that is possible; null as margin is, and "
        "without this law",
        "",
        "breakdown probability at shaft voltage",
        shown="%",
        digits=".2g",
        bound="≥",
    ),
    "through_margin": Quantity(
        "shaft_through_breakdown / shaft voltage; null without a motor",
        "",
        "margin (ring-to-ring / shaft voltage)",
        bound="≤",
    ),
    "strength_per_volt": Quantity(
        "maximum field strength of a contact / bearing voltage, maximum over the positions; null for a "
        "conducting bearing and for ceramic elements",
        "1/m",
        "maximum field per volt on the bearing",
        bound="≥",
    ),
    "max_strength": Quantity(
        "maximum field strength at the shaft voltage, before anything has broken down; null without a motor",
        "V/m",
        "maximum field at the shaft voltage",
        bound="≥",
    ),
    "bearing_voltage_ratio": Quantity(
        "C_wr/(C_wr + C_rf + C_DE + C_NDE); null without a motor, for a conducting bearing, and for ceramic "
        "elements without element_capacitance",
        "",
        "bearing voltage ratio",
        shown="%",
    ),
    "shaft_voltage": Quantity(
        "bearing_voltage_ratio times the common-mode voltage, peak; capacitive alone; null as that ratio is",
        "V",
        "shaft voltage",
        bound="≤",
    ),
    "relaxation_time": Quantity(
        "charge relaxation time ε0 ε_r/σ; null without a conductivity",
        "s",
        "charge relaxation time of the oil",
    ),
    "shaft_time_constant": Quantity(
        "time constant with which the shaft voltage decays through the oil of both bearings, right after an "
        "edge of the inverter; null without a conductivity or a motor, for a conducting bearing and for "
        "ceramic elements",
        "s",
        "time constant of the shaft voltage",
    ),
    "shaft_voltage_after_period": Quantity(
        "shaft voltage that is left after a period of the inverter; null without `motor.switching_frequency` "
        "and as shaft_time_constant is",
        "V",
        "shaft voltage after a period",
    ),
    "shaft_voltage_after_rise": Quantity(
        "shaft voltage at the end of an edge of the inverter, with leakage through the oil; null without "
        "`motor.rise_time` and as shaft_time_constant is",
        "V",
        "shaft voltage after an edge",
    ),
    "discharged_capacitance": Quantity(
        "capacitance that a discharge empties: bearing, winding and frame to rotor, and second bearing, or "
        "`discharge.external_capacitance` without a motor, all but the bearing in series with its coating; "
        "null where nothing is given, for a conducting bearing and for ceramic elements",
        "F",
        "discharged capacitance",
    ),
    "bearing_energy": Quantity(
        "energy C V²/2 in the films alone at the shaft voltage, of which film_voltage is across them; null "
        "without a motor",
        "J",
        "energy in the bearing",
    ),
    "discharge_energy": Quantity(
        "energy C V²/2 in discharged_capacitance at the shaft voltage, with V = film_voltage; null without a "
        "motor",
        "J",
        "discharge energy at the shaft voltage",
    ),
    "breakdown_energy": Quantity(
        "energy C V²/2 in discharged_capacitance at the first breakdown; null as either is",
        "J",
        "discharge energy at the first breakdown",
        bound="≤",
    ),
    "pit_volume": Quantity(
        "volume of one surface that discharge_energy melts; null without `[discharge.pit]`",
        "m**3",
        "melted volume",
    ),
    "pit_diameter": Quantity(
        "diameter of a hemisphere of that volume; null as pit_volume is",
        "m",
        "pit diameter at the shaft voltage",
        shown="prefixed",
    ),
    "breakdown_pit_diameter": Quantity(
        "diameter of the hemisphere that breakdown_energy melts; null without `[discharge.pit]`",
        "m",
        "pit diameter at the first breakdown",
        shown="prefixed",
        bound="≤",
    ),
    "hertz_area": Quantity(
        "area of the smaller dry contact of each element that both rings load, added up, the cage in its "
        "first position",
        "m**2",
        "area of the dry contacts",
    ),
    "current_density": Quantity(
        "peak current / hertz_area; null without `discharge.peak_current`",
        "A/m**2",
        "apparent current density",
        digits=".3g",
    ),
    "element_current_density": Quantity(
        "peak current / area of the smaller contact of the most loaded element, as if it alone carried the "
        "current; null without `discharge.peak_current`",
        "A/m**2",
        "current density of one element",
        digits=".3g",
    ),
    "current_density_limits": Quantity(
        "published limits of current_density: 0.1 to 0.3 A/mm² (doi:10.3390/lubricants12050148) and 0.8 "
        "A/mm² (Busse et al. 1997, as quoted by doi:10.3390/lubricants10050087); null without a current",
        "A/m**2",
    ),
    "discretisation_error": Quantity(
        "maximum estimated error of the solved films; null where one is not known, and for contacts from the "
        "atlas",
        "",
        "discretisation error of the films",
        shown="%",
    ),
    "film_error": Quantity(
        "estimated error of the films and their interpolation over the load; for contacts from the atlas "
        "of loads above 2 % of the largest, for contacts by formula that of the formula",
        "",
        "error of the films",
        shown="%",
    ),
    "interpolation_error": Quantity(
        "maximum error at a load that is left out of the interpolation; of the breakdown voltage only for at "
        "least 2 % of the largest load",
        "",
        "interpolation error of the films",
        shown="%",
    ),
}
_MECHANICS: Keys = {
    "max_load": Quantity("load of the most loaded contact with the outer ring", "N"),
    "radial_displacement": Quantity(
        "radial displacement of the inner ring against the outer one, the clearance included", "m"
    ),
    "axial_displacement": Quantity("axial displacement of the inner ring; null for rollers", "m"),
    "moment": Quantity("moment that holds the inner ring from tilting; null for rollers", "N*m"),
    "centrifugal_force": Quantity("centrifugal force on each element", "N"),
    "gyroscopic_moment": Quantity(
        "maximum gyroscopic moment of a ball; reported, its effect is left out; null for rollers", "N*m"
    ),
    "cage_speed": Quantity(
        "speed of the cage in pure rolling; of balls the mean of theirs, weighted with their load", "rad/s"
    ),
    "element_speed": Quantity(
        "maximum speed of the elements about their own axes, seen from the cage, in pure rolling", "rad/s"
    ),
    "entrainment_speed": Quantity("maximum entrainment speed, without the film factor", "m/s"),
    "entrainment_speed_inner": Quantity(
        "maximum entrainment speed at the inner ring", "m/s", "entrainment speed, inner ring"
    ),
    "entrainment_speed_outer": Quantity(
        "maximum entrainment speed at the outer ring; equal to that of the inner one in pure rolling",
        "m/s",
        "entrainment speed, outer ring",
    ),
    "residual": Quantity("maximum unbalanced force on ring or element / (load + centrifugal force)"),
}

# Keys of a row of ``contacts``, which are also the columns of contacts.csv.
CONTACT_KEYS: Keys = {
    "element": Quantity("number of the element from 0, which lies on the load line", head="no."),
    "ring": Quantity('"inner" or "outer"', head="ring"),
    "position": Quantity(
        "angle of the element from the direction of the load", "rad", head="position", digits=".0f"
    ),
    "load": Quantity("load of the contact", "N", head="load"),
    "contact_angle": Quantity(
        "contact angle; where there is no contact that of the narrowest place",
        "rad",
        head="angle",
        digits="z.1f",  # an angle that is rounded to zero has no sign
    ),
    "max_pressure": Quantity(
        "Hertz pressure of the dry contact; null without load", "Pa", head="Hertz p", digits=".3f"
    ),
    "semi_axis_x": Quantity(
        "semi-axis of the dry contact along entrainment, of a roller its half-width; null without load",
        "m",
        head="semi-axis x",
    ),
    "semi_axis_y": Quantity(
        "semi-axis across entrainment, of a roller half of its length; null without load",
        "m",
        head="semi-axis y",
    ),
    "minimum_thickness": Quantity(
        "minimum film thickness, or the gap where there is no contact", "m", head="h_min"
    ),
    "central_thickness": Quantity(
        "central film thickness, or the gap where there is no contact", "m", head="h central"
    ),
    "lambda_ratio": Quantity("minimum_thickness / composite_rq", head="lambda", digits=".3g"),
    "regime": Quantity(
        '"full film" from a lambda_ratio of 3 on; "partial film" below, where asperities touch at times; '
        '"touching" below 1, with contacts that open and close; "gap" without load'
    ),
    **CONTACT_DUTY_KEYS,
    "capacitance": Quantity(
        "capacitance of the contact, with `fill` around it; null for ceramic elements", "F", head="C"
    ),
    "voltage_share": Quantity(
        "share of the bearing's voltage on the contact; null for ceramic elements and a conducting bearing",
        head="V share",
        shown="%",
        digits=".1f",
    ),
    "strength_per_volt": Quantity(
        "maximum field strength of the contact / bearing voltage; null for a conducting bearing and for "
        "ceramic elements",
        "1/m",
        head="E/V",
        digits=".3g",
        bound="≥",
    ),
    "max_strength": Quantity(
        "that field strength at the shaft voltage; null without a motor",
        "V/m",
        head="E",
        digits=".3g",
        bound="≥",
    ),
    "breakdown_voltage": Quantity(
        "voltage on the contact itself, not on the bearing, at which it breaks down; null without a "
        "strength, for a conducting bearing and for ceramic elements",
        "V",
        head="breakdown",
        digits=".3g",
        bound="≤",
    ),
    "bearing_breakdown_voltage": Quantity(
        "bearing voltage at which the contact breaks down, breakdown_voltage / voltage_share; null as "
        "breakdown_voltage is",
        "V",
        bound="≤",
    ),
    "solved": Quantity("whether there is a film; a gap of rigid bodies otherwise"),
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
    "contacts": Quantity("list with each contact, the cage in its first position; contacts.csv has the same"),
    **under("contacts", CONTACT_KEYS),
    "seconds": Quantity("computing time", "s", "computing time", shown="s", digits=".3g"),
}


def _shown_of_ring(name: str) -> Keys:
    """Quantities of the loaded contacts with a ring, which outputs show and no summary stores."""
    return {
        f"rings.{name}.load": Quantity(
            f"load of the most loaded contact with the {name} ring", "N", f"maximum load, {name} ring"
        ),
        f"rings.{name}.max_pressure": Quantity(
            f"maximum Hertz pressure of the contacts with the {name} ring",
            "Pa",
            f"Hertz pressure, {name} ring",
        ),
        f"rings.{name}.minimum_thickness": Quantity(
            f"minimum film of the loaded contacts with the {name} ring",
            "m",
            f"minimum film, {name} ring",
            bound="≤",
        ),
    }


# Quantities that outputs show and no summary stores.
_SHOWN: Keys = {
    **_shown_of_ring("inner"),
    **_shown_of_ring("outer"),
    "bearing.minimum_thickness": Quantity(
        "minimum film of all loaded contacts", "m", "minimum film thickness", bound="≤"
    ),
    "bearing.asperity_share_range": Quantity(
        "asperity load share by the published laws", "", "asperity load share"
    ),
    "margin.range": Quantity(
        "margin with all inputs of `[ranges]` at their unfavourable and favourable ends",
        "",
        "margin within the stated ranges",
        bound="≤",
    ),
}
_CONDITIONS: Keys = {
    "inputs.bearing.inner_speed": Quantity("speed of the inner ring", "rad/s", "speed of the inner ring"),
    "inputs.bearing.radial_load": Quantity("radial load", "N", "radial load"),
    "inputs.bearing.axial_load": Quantity("axial load", "N", "axial load"),
    "inputs.bearing.radial_clearance": Quantity("radial clearance", "m", "radial clearance"),
    "inputs.bearing.contact_angle": Quantity("free contact angle", "rad", "free contact angle"),
    "inputs.discharge.dielectric_strength": Quantity(
        "dielectric strength of the oil", "V/m", "dielectric strength"
    ),
}
# Everything that outputs of a bearing show.
BEARING_BOOK: Keys = {**BEARING_KEYS, **_SHOWN, **_CONDITIONS}
