"""Results of a contact: the keys of its summary.json."""

from __future__ import annotations

from ehlectric.quantities import discharge_results
from ehlectric.quantities.oil_results import OIL_KEYS
from ehlectric.quantities.quantity import Keys, Quantity, under
from ehlectric.quantities.surface_results import (
    LINE_SURFACE,
    MAP_STATISTICS,
    POINT_SURFACE,
    PROFILE_STATISTICS,
)

_ONLY = "; only with `[inlet]`"

STARVED_KEYS: Keys = {
    "oil_layer": Quantity(
        "thickness of the oil on both surfaces together before the contact, on the centre line; if they "
        "slide, the oil that they carry over the mean speed; null for `film_ratio = 1` in a point "
        f"contact{_ONLY}",
        "m",
        "layer of oil before the contact",
        r"$h_\mathrm{oil}$",
    ),
    "film_ratio": Quantity(
        f"central film thickness over that of the flooded contact; null if that did not converge{_ONLY}",
        "",
        "starved / flooded central film",
        r"$h_\mathrm{c}/h_\mathrm{c,ff}$",
    ),
    "meniscus": Quantity(
        "position on the centre line from which oil fills the gap; null if the film is flooded, or if oil "
        f"fills the gap at the inlet edge there{_ONLY}",
        "m",
        "position of the meniscus",
        r"$x_\mathrm{m}$",
    ),
    "flooded.minimum_thickness": Quantity(
        "minimum film thickness of the same contact with a flooded inlet, on the same grid; null if it "
        f"did not converge{_ONLY}",
        "m",
        "minimum film thickness, flooded",
    ),
    "flooded.central_thickness": Quantity(
        "central film thickness of the same contact with a flooded inlet; null if it did not converge"
        f"{_ONLY}",
        "m",
        "central film thickness, flooded",
    ),
}


def heat_keys(power: str) -> Keys:
    """Keys within the table ``film``; ``power`` is the unit of the power loss."""
    per_length = " per length" if power == "W/m" else ""
    return {
        "rheology": Quantity("rheology of the film; only with `[film]`, as all keys below", "", "rheology"),
        "thermal": Quantity(
            "true if the temperature in the film was computed", "", "temperature of the film"
        ),
        "max_temperature_rise": Quantity(
            "largest temperature at mid-film less that of the oil in the inlet; null for an isothermal film",
            "K",
            "temperature rise at mid-film",
            r"$\Delta T_\mathrm{max}$",
        ),
        "temperature_rise_error": Quantity(
            "estimated error of max_temperature_rise by the grids along and across the film, the iteration "
            "and extrapolated properties of the oil; null if unknown",
            "K",
            "error of the temperature rise",
            digits=".1g",
        ),
        "traction_coefficient": Quantity(
            "mean shear stress at mid-film over the mean pressure, positive where surface 1 is faster; "
            "null, as rolling_coefficient and power_loss, if the film did not converge",
            "",
            "traction coefficient",
            r"$\mu$",
            digits=".3g",
        ),
        "rolling_coefficient": Quantity(
            "rolling friction of one surface over the load",
            "",
            "coefficient of rolling friction",
            digits=".2g",
        ),
        "power_loss": Quantity(
            f"power{per_length} that the film turns into heat, by sliding and rolling", power, "power loss"
        ),
        "energy_imbalance": Quantity(
            "heat that the discretisation makes or loses, over the heat of compression and shear; null for "
            "an isothermal film",
            "",
            "error of the heat balance",
        ),
        "isothermal.minimum_thickness": Quantity(
            "minimum film thickness of the same contact, isothermal and Newtonian; null if that film did not "
            "converge",
            "m",
            "isothermal, Newtonian minimum film",
        ),
        "isothermal.central_thickness": Quantity(
            "central film thickness of the same contact, isothermal and Newtonian; null if that film did not "
            "converge",
            "m",
            "isothermal, Newtonian central film",
        ),
    }


def _spot_mechanics(area: str, what: str) -> Keys:
    """Keys of what the spots carry, with the unit of an area and what a spot is."""
    return {
        "boundary_film": Quantity(
            "gap at which the surfaces touch", "m", "boundary film", shown="nm", digits=".3g"
        ),
        "load_share": Quantity(
            "share of asperities in the load",
            "",
            "load share of asperities",
            r"$L_\mathrm{a}$",
            shown="%",
            digits=".2g",
        ),
        "load_share_coarser": Quantity(
            "load_share on a grid with half the nodes; null if this grid was not solved"
        ),
        "contact_area": Quantity(
            f"real area of contact, {what}", area, "real area of contact", r"$A_\mathrm{c}$", digits=".2g"
        ),
        "contact_area_share": Quantity(
            "part of the Hertz zone in which the surfaces touch",
            "",
            "real contact area / Hertz area",
            r"$A_\mathrm{c}/A$",
            shown="%",
            digits=".2g",
        ),
        "contact_area_error": Quantity(
            "error of contact_area by the grid, the larger of two: edges of spots lie between nodes, "
            "and contact_area_share changed from a grid with half the nodes; null without spots"
        ),
        "contact_area_share_coarser": Quantity("contact_area_share on a grid with half the nodes"),
        "spots": Quantity(
            "number of spots; nodes that are neighbours along a diagonal only are two spots",
            "",
            "number of spots",
        ),
        "spots_of_one_node": Quantity("spots that are a single node of the grid, and so are not resolved"),
        "mean_spot": Quantity(
            f"mean size of a spot, {what}; null without spots", area, "mean size of a spot", digits=".2g"
        ),
        "largest_spot": Quantity(
            f"largest size of a spot, {what}; null without spots",
            area,
            "size of the largest spot",
            digits=".2g",
        ),
    }


_OIL_BALANCE: Keys = {
    "mass_error": Quantity(
        "oil that the film loses and makes, oil_lost + oil_made, over the mean flow through the Hertz zone; "
        "null where the nodes are not equidistant",
        "",
        "error of the oil balance",
        shown="%",
        digits=".2g",
    ),
    "oil_lost": Quantity("part of mass_error that enters spots and does not leave them"),
    "oil_made": Quantity(
        "part of mass_error that appears where cavitated gaps fill again; where they count as full, each "
        "refilling along a streamline counts, so that it may be above 1"
    ),
}
_SPOT_FILM: Keys = {
    "mean_film": Quantity(
        "mean film thickness in the Hertz zone outside of the spots",
        "m",
        "mean film outside of the spots",
        shown="nm",
        digits=".3g",
    ),
    "least_film": Quantity(
        "least film thickness in the Hertz zone outside of the spots",
        "m",
        "minimum film outside of the spots",
        shown="nm",
        digits=".3g",
    ),
    **{
        f"film_{k}": Quantity(
            f"film thickness below which {k} % of the Hertz zone outside of the spots lies",
            "m",
            f"film outside of the spots, {k} % quantile",
            shown="nm",
            digits=".2g",
        )
        for k in (1, 5, 50)
    },
    "rq_deformed": Quantity(
        "root mean square of the film thickness less that of smooth surfaces, about its mean over the "
        "Hertz zone; null if the smooth contact was not solved",
        "m",
        "combined Rq, deformed",
        shown="nm",
        digits=".3g",
    ),
    "lambda_undeformed": Quantity(
        "mean film thickness in the Hertz zone, spots included, over rq_combined",
        "",
        "lambda ratio of the mean film",
        digits=".3g",
    ),
    "lambda_deformed": Quantity(
        "the same film over rq_deformed", "", "lambda ratio of the deformed surfaces", digits=".3g"
    ),
    "boundary_friction": Quantity(
        "share of asperities in the friction coefficient of sliding, load_share times "
        "contact.boundary_friction; null without that key",
        "",
        "friction coefficient of the asperities",
        digits=".2g",
    ),
}


def _spot_conduction(capacitance: str) -> Keys:
    """Keys of what the spots conduct, with the unit of a capacitance."""
    return {
        "behaviour": Quantity(
            '"capacitive": no spots, or the film takes ten times their current at 10 kHz; "resistive": the '
            'spots take ten times that of the film, and time_share is at least 0.95; "mixed": all between, '
            "and where contact_area_error is 1 or more and spots carry less than 90 % of the load, as a "
            "finer grid may have no spots",
            "",
            "electrical behaviour",
        ),
        "time_share": Quantity(
            "share of the time with at least one spot, 1 − (1 − f)^(spots/f) with contact_area_share f",
            "",
            "share of time with a spot",
            shown="%",
            digits=".3g",
        ),
        "resistance": Quantity(
            "resistance of all spots with their tribofilm; null without spots or electric.resistivity, and "
            "for a line contact without discharge.length",
            "ohm",
            "resistance of the spots",
            digits=".2g",
            bound="≤" if capacitance == "F/m" else "",
        ),
        "constriction_resistance": Quantity("part of resistance in the bodies", "ohm"),
        "tribofilm_resistance": Quantity("part of resistance in the tribofilm", "ohm"),
        "capacitance_outside": Quantity(
            "capacitance of the film outside of the spots over the domain of the film, by a thin gap",
            capacitance,
            "capacitance outside of the spots",
            digits=".3g",
        ),
        "impedance_ratio": Quantity("impedance of capacitance_outside at 10 kHz over resistance"),
        "corner_frequency": Quantity(
            "frequency above which the film takes more current than the spots",
            "Hz",
            "corner frequency of the spots",
            digits=".2g",
        ),
        **{
            f"breakdown_{k}": Quantity(
                f"voltage at which {k} % of the Hertz zone outside of the spots reach the dielectric "
                "strength; null without a strength",
                "V",
                f"breakdown outside of the spots, {k} % of it",
                digits=".2g",
            )
            for k in (1, 5, 50)
        },
        "breakdown_voltage": Quantity(
            "voltage at which the film outside of the spots breaks down with a probability of 63.2 %; null "
            "without a Weibull law",
            "V",
            "breakdown voltage outside of the spots",
            digits=".2g",
        ),
        "breakdown_probability": Quantity(
            "probability that the film outside of the spots breaks down at the voltage of the case",
            "",
            "breakdown probability beside the spots",
            shown="%",
            digits=".2g",
        ),
    }


def _spot_keys(area: str, what: str, capacitance: str) -> Keys:
    """Keys with the unit of an area, what a spot is, and the unit of a capacitance."""
    return {**_spot_mechanics(area, what), **_OIL_BALANCE, **_SPOT_FILM, **_spot_conduction(capacitance)}


_LINE_SPOTS: Keys = _spot_keys("m", "as a width: a spot is a strip that is as long as the contact", "F/m")
_POINT_SPOTS: Keys = _spot_keys("m**2", "of the nodes that touch", "F")

METER_KEYS: Keys = {
    "capacitance": Quantity(
        "capacitance that a meter at the two bodies reads: film, gap outside its domain, and in parallel",
        "F",
        "capacitance at the meter",
        r"$C_\mathrm{m}$",
    ),
    "capacitance_air": Quantity(
        "the same where air fills the whole gap outside the domain",
        "F",
        "capacitance at the meter, in air",
    ),
    "capacitance_oil": Quantity(
        "the same where oil fills the whole gap outside the domain",
        "F",
        "capacitance at the meter, in oil",
    ),
    "capacitance_domain": Quantity(
        "part of the film's domain; with `rq` and a coating other than `discharge.capacitance`",
        "F",
        "capacitance of the domain",
    ),
    "capacitance_hertz": Quantity("part of the Hertz zone", "F", "capacitance of the Hertz zone in it"),
    "capacitance_outside": Quantity(
        "part of the gap outside the domain, filled as `fill` or `oil_radius` says",
        "F",
        "capacitance outside the domain",
    ),
    "capacitance_outside_air": Quantity("part of the gap outside the domain in air", "F"),
    "capacitance_outside_oil": Quantity("part of the gap outside the domain in oil", "F"),
    "parallel_capacitance": Quantity(
        "part in parallel, from the case; null if not given", "F", "capacitance in parallel"
    ),
    "share_of_hertz": Quantity(
        "capacitance_hertz / capacitance", "", "share of the Hertz zone", shown="%", digits=".3g"
    ),
    "share_of_domain": Quantity(
        "capacitance_domain / capacitance", "", "share of the domain", shown="%", digits=".3g"
    ),
    "share_of_outside": Quantity(
        "capacitance_outside / capacitance", "", "share of the gap outside", shown="%", digits=".3g"
    ),
    "roughness_factor": Quantity(
        "capacitance_domain over its value with smooth surfaces; null without `meter.rq`",
        "",
        "roughness factor",
    ),
    "film_ratio": Quantity(
        "film.minimum_thickness / `meter.rq`; null without it", "", "minimum film / composite roughness"
    ),
    "capacitance_uncoated": Quantity(
        "capacitance of domain and outer gap without the coating; null without one",
        "F",
        "capacitance without the coating",
    ),
    "coating_capacitance": Quantity(
        "capacitor in series with capacitance_uncoated that has the same effect; null without a coating",
        "F",
        "capacitance of the coating",
    ),
    "coating_voltage_share": Quantity(
        "part of the voltage on the coating at the minimum film; null without a coating",
        "",
        "share of the voltage on the coating",
        shown="%",
    ),
    "film_voltage_share": Quantity(
        "part of the voltage on the film at its minimum; null without a coating",
        "",
        "share of the voltage on the film",
        shown="%",
    ),
    "film_breakdown_voltage": Quantity(
        "voltage between the bodies at which the film breaks down; null without a strength of the film",
        "V",
        "breakdown voltage of the film in series",
        bound="≤",
    ),
    "coating_breakdown_voltage": Quantity(
        "voltage at which the coating alone breaks down, its strength times its thickness; null without a "
        "strength of the coating",
        "V",
        "breakdown voltage of the coating",
    ),
    "breakdown_voltage": Quantity(
        "voltage between the bodies at which both film and coating have broken down; null if a strength is "
        "missing",
        "V",
        "breakdown voltage between the bodies",
        bound="≤",
    ),
    "length": Quantity("length of a line contact, or given width of a point contact; null if not given", "m"),
    "bodies": Quantity("bodies that face each other outside the domain"),
    "mismatch": Quantity(
        "largest relative difference between the film and the gap outside, at the edge of the domain"
    ),
}

_ABOUT: Keys = {
    "schema": Quantity("name of the format"),
    "version": Quantity("version of the program"),
    "title": Quantity("title of the case"),
    "converged": Quantity("true if the film converged"),
    "status": Quantity('"converged", "stalled", "diverged" or "film collapsed"'),
    "warnings": Quantity("warnings; read them before using the numbers"),
    "warning_codes": Quantity(
        "code of each warning, in the same order; programs should use codes, because texts may change"
    ),
    "verdict": Quantity(
        "answer in sentences: whether breakdown is expected at the applied voltage, and what is assumed; "
        "only with `[discharge]`"
    ),
    "inputs": Quantity("the case, with alternatives resolved"),
}
_GROUPS: Keys = {
    "moes_m": Quantity("dimensionless load parameter M of Moes", "", "load parameter (Moes)", "$M$"),
    "moes_l": Quantity("dimensionless material parameter L of Moes", "", "material parameter (Moes)", "$L$"),
}
_MAX_PRESSURE = Quantity("maximum pressure of the dry contact", "Pa", "Hertz pressure", r"$p_\mathrm{h}$")
_LINE_HERTZ: Keys = {
    "half_width": Quantity("half-width of the dry contact", "m", "half-width", "$b$"),
    "max_pressure": _MAX_PRESSURE,
}
_POINT_HERTZ: Keys = {
    "semi_axis_x": Quantity(
        "semi-axis of the dry ellipse along entrainment",
        "m",
        "semi-axis along entrainment",
        "$b$",
    ),
    "semi_axis_y": Quantity(
        "semi-axis of the dry ellipse across entrainment",
        "m",
        "semi-axis across entrainment",
        "$a$",
    ),
    "max_pressure": _MAX_PRESSURE,
}
_FILM: Keys = {
    "minimum_thickness": Quantity(
        "minimum film thickness of all nodes", "m", "minimum film thickness", r"$h_\mathrm{min}$"
    ),
    "minimum_position": Quantity("position of the node with the minimum film thickness", "m"),
    "central_thickness": Quantity(
        "film thickness at x = 0, interpolated", "m", "central film thickness", "$h(0)$"
    ),
    "mean_thickness": Quantity(
        "mean film thickness within abs(x) ≤ b, trapezoidal",
        "m",
        "mean film thickness",
        r"$\bar{h}$",
    ),
    "max_pressure": Quantity(
        "maximum pressure of all nodes; a sharp pressure spike grows with the grid",
        "Pa",
        "maximum pressure in the film",
        r"$p_\mathrm{max}$",
    ),
    "load_residual": Quantity("abs(∫P dX/(π/2) − 1)", "", "residual of the load balance", digits=".1e"),
    "residual": Quantity(
        "maximum scaled residual of the film equations", "", "residual of the film equations", digits=".1e"
    ),
    "newton_iterations": Quantity("Newton iterations on the finest grid; V-cycles with `--solver paper`"),
    "discretisation_error": Quantity(
        "estimated relative error, the larger of the errors of h_min and h(0); null if unknown, and where "
        "the surfaces touch, so that h_min is the boundary film",
        "",
        "discretisation error of the film",
        shown="%",
        digits=".2g",
    ),
    "target_error": Quantity(
        "relative error of the film to which the grid was to be refined; null for a grid of given nodes",
        "",
        "error asked of the film",
        shown="%",
        digits=".2g",
    ),
    "max_pressure_error": Quantity(
        "estimated relative error of max_pressure; above about 0.3 the grid does not resolve its peak",
        "",
        "error of the maximum pressure",
        shown="%",
        digits=".2g",
    ),
    "solver": Quantity('solver of the film: "ehlectric" or "paper"'),
    "nodes": Quantity("nodes of the film, of the last grid where it is refined", "", "nodes of the film"),
    **STARVED_KEYS,
}
_POINT_FILM: Keys = {
    **_FILM,
    "minimum_position": Quantity(
        "position [x, y] of the node with the minimum film thickness; of two mirror images the one at "
        "negative y",
        "m",
    ),
    "central_thickness": Quantity(
        "film thickness at x = y = 0, interpolated", "m", "central film thickness", "$h(0)$"
    ),
    "mean_thickness": Quantity(
        "mean film thickness within the Hertz ellipse", "m", "mean film thickness", r"$\bar{h}$"
    ),
    "load_residual": Quantity(
        "abs(∫∫P dX dY/(2 π k/3) − 1)", "", "residual of the load balance", digits=".1e"
    ),
    "nodes": Quantity(
        "nodes [along, across] of the film, of the last grid where it is refined", "", "nodes of the film"
    ),
    "inlet_deficit": Quantity("share of the reduced pressure that would build up upstream of the domain"),
    "side_deficit": Quantity(
        "share of the reduced pressure that the sides cut off, where the pressure is set to ambient"
    ),
}
_FIELD: Keys = {
    "voltage": Quantity("abs(V2 − V1)", "V", "voltage across the film", "$V_{12}$"),
    "max_strength": Quantity(
        "maximum abs(E) on either wall or at mid-film",
        "V/m",
        "maximum field strength",
        r"$|E|_\mathrm{max}$",
        bound="≥",
    ),
    "max_strength_position": Quantity("position of max_strength", "m"),
    "max_dimensionless": Quantity(
        "max_strength / (V12/h_min), the ratio to the field of parallel plates",
        "",
        "maximum field / parallel-plate field",
        r"$|E|_\mathrm{max}\,h_\mathrm{min}/V_{12}$",
        digits=".4f",
    ),
    "central_dimensionless": Quantity("abs(E) h_min/V12 at mid-film and x = 0; null outside the field range"),
    "thin_gap_error": Quantity(
        "relative error of the estimate V12/h_min: (max_strength − V12/h_min)/max_strength; null if the "
        "minimum film is outside the field range",
        "",
        "error of the estimate V/h_min",
        shown="%",
        digits=".2g",
    ),
    "max_strength_wall": Quantity(
        'place of max_strength across the film: "surface 1", "mid-film" or "surface 2"'
    ),
    "solver": Quantity('solver of the field: "ehlectric" or "paper"'),
    "max_strength_error": Quantity(
        "estimated relative error of max_strength by the grid of the field; null if unknown",
        "",
        "error of the maximum field",
        shown="%",
        digits=".1g",
    ),
    "degree": Quantity(
        "polynomial degree of the potential across the film; above `grid.field_degree` where short waves "
        "need it"
    ),
    "columns": Quantity("columns of the field's grid", "", "columns of the field"),
}
_LINE_FIELD: Keys = {
    **_FIELD,
    "high_field_width": Quantity(
        "length of the contiguous interval in which mid-film abs(E) is at least 95 % of its maximum",
        "m",
        "width of the high-field zone",
    ),
    "capacitance_per_length": Quantity(
        "capacitance of the field range", "F/m", "capacitance per length, field range"
    ),
}
_POINT_FIELD: Keys = {
    **_FIELD,
    "max_strength_position": Quantity(
        "position [x, y] of max_strength; of two mirror images the one at negative y", "m"
    ),
    "central_dimensionless": Quantity(
        "abs(E) h_min/V12 at mid-film and x = y = 0; null outside the field range"
    ),
    "columns": Quantity("columns [along, across] of the field's grid", "", "columns of the field"),
    "high_field_area": Quantity(
        "area in which mid-film abs(E) is at least 95 % of its maximum; the sum of both side lobes if there "
        "are two",
        "m**2",
        "area of the high-field zone",
    ),
    "capacitance": Quantity(
        "capacitance of the field range, from the field energy",
        "F",
        "capacitance, field range",
        "$C$",
    ),
    "capacitance_by_charge": Quantity("capacitance of the field range, from the charge of surface 2", "F"),
    "capacitance_by_zone.hertz": Quantity(
        "capacitance of the Hertz ellipse, from the charge",
        "F",
        "capacitance of the ellipse, field range",
    ),
    "capacitance_by_zone.inlet": Quantity(
        "capacitance of the inlet: upstream of the ellipse, of the same width",
        "F",
        "capacitance of the inlet, field range",
    ),
    "capacitance_by_zone.outlet": Quantity(
        "capacitance of the outlet: downstream of the ellipse, of the same width",
        "F",
        "capacitance of the outlet, field range",
    ),
    "capacitance_by_zone.sides": Quantity(
        "capacitance of the sides: beyond the width of the ellipse",
        "F",
        "capacitance of the sides, field range",
    ),
}
_FORMULAS: Keys = {
    "*.minimum_thickness": Quantity(
        "minimum film thickness of a published formula; null if it gives none",
        "m",
        "minimum film by formula",
    ),
    "*.central_thickness": Quantity(
        "central film thickness of a published formula; null if it gives none",
        "m",
        "central film by formula",
    ),
}
_SECONDS: Keys = {
    "film": Quantity("computing time of the film", "s"),
    "field": Quantity("computing time of the field", "s"),
}


def _roughness(zone: str) -> Keys:
    """Keys of the table ``roughness``, without those of its surfaces and its statistics."""
    return {
        "surfaces": Quantity("source, size, voids and statistics after every step, for each rough surface"),
        "rq_1": Quantity(
            f"root-mean-square height of surface 1 within the {zone}",
            "m",
            "Rq of surface 1",
            shown="nm",
            digits=".3g",
        ),
        "rq_2": Quantity(
            f"root-mean-square height of surface 2 within the {zone}",
            "m",
            "Rq of surface 2",
            shown="nm",
            digits=".3g",
        ),
        "rq_combined": Quantity(
            f"root-mean-square height of z1 + z2 within the {zone}",
            "m",
            "combined Rq",
            shown="nm",
            digits=".3g",
        ),
        "lambda_ratio": Quantity(
            "minimum_thickness / rq_combined; null if rq_combined is below 10⁻¹² m",
            "",
            "lambda ratio",
            r"$\Lambda$",
            digits=".3g",
        ),
        "lambda_ratio_smooth": Quantity(
            "smooth_minimum_thickness / rq_combined, the lambda ratio of film formulas; null if the smooth "
            "contact was not solved",
            "",
            "lambda ratio of the smooth film",
            digits=".3g",
        ),
        "smooth_minimum_thickness": Quantity(
            "minimum film thickness of the contact with smooth surfaces",
            "m",
            "minimum film with smooth surfaces",
        ),
    }


def _statistics(where: str, keys: Keys) -> Keys:
    """Keys of the statistics of z1 + z2 over a region; ``where`` is the name of the region."""
    return {
        name: Quantity(f"{key.meaning}, of z1 + z2 within the {where}", key.unit)
        for name, key in keys.items()
    }


LINE_KEYS: Keys = {
    **_ABOUT,
    **under("lubricant", OIL_KEYS),
    **under("groups", _GROUPS),
    **under("hertz", _LINE_HERTZ),
    **under("film", {**_FILM, **heat_keys("W/m")}),
    **under("field", _LINE_FIELD),
    **under("film_formulas", _FORMULAS),
    **under("seconds", _SECONDS),
    **under("asperities", _LINE_SPOTS),
    **under("discharge", discharge_results.LINE_KEYS),
    **under("meter", METER_KEYS),
    **under("roughness", _roughness("Hertz zone")),
    **under("roughness.surfaces", LINE_SURFACE),
    **under("roughness.combined", _statistics("Hertz zone", PROFILE_STATISTICS)),
}
POINT_KEYS: Keys = {
    **_ABOUT,
    **under("lubricant", OIL_KEYS),
    **under("groups", _GROUPS),
    **under("hertz", _POINT_HERTZ),
    **under("film", {**_POINT_FILM, **heat_keys("W")}),
    **under("field", _POINT_FIELD),
    **under("film_formulas", _FORMULAS),
    **under("seconds", _SECONDS),
    **under("asperities", _POINT_SPOTS),
    **under("discharge", discharge_results.POINT_KEYS),
    **under("meter", METER_KEYS),
    **under("roughness", _roughness("Hertz ellipse")),
    **under("roughness.surfaces", POINT_SURFACE),
    **under("roughness.combined", _statistics("rectangle around the Hertz ellipse", MAP_STATISTICS)),
}

# Keys of the summary by the geometry of the contact.
CONTACT_KEYS: dict[str, Keys] = {"line": LINE_KEYS, "point": POINT_KEYS}


# Quantities that outputs show and no summary stores.
_SHOWN: Keys = {
    "hertz.axis_ratio": Quantity("semi_axis_y / semi_axis_x", "", "axis ratio a/b"),
    "regime": Quantity("lubrication regime by the groups of Moes", "", "lubrication regime"),
    "film.surface_temperature_1": Quantity(
        "maximum temperature of surface 1", "K", "maximum temperature of surface 1", shown="°C"
    ),
    "film.surface_temperature_2": Quantity(
        "maximum temperature of surface 2", "K", "maximum temperature of surface 2", shown="°C"
    ),
    "formula_error": Quantity(
        "usual difference of a film formula from a solved film", "", "usual difference from a solved film"
    ),
    "discharge.capacitance_by_outlet": Quantity(
        "capacitance with oil in layers, and full of oil", "", "capacitance by outlet filling"
    ),
    "discharge.breakdown_range": Quantity(
        "breakdown voltage at probabilities of 5 and 95 %", "V", "breakdown voltage, 5 to 95 %", bound="≤"
    ),
    "meter.capacitance_by_gap": Quantity(
        "capacitance at the meter with air and with oil outside", "F", "capacitance, outer gap in air to oil"
    ),
    "seconds.both": Quantity("computing time of film and field", "s", "computing time", digits=".2g"),
    "velocity_parameter": Quantity(
        "dimensionless velocity parameter Λ of the film equation", "", "dimensionless velocity parameter Λ"
    ),
    "breakdown_by_formula.breakdown_voltage": Quantity(
        "breakdown voltage of the minimum film of a formula", "V", "breakdown voltage by formula", bound="≤"
    ),
    "breakdown_by_formula.margin": Quantity(
        "breakdown_voltage / applied voltage",
        "",
        "margin (breakdown / applied voltage)",
        digits=".3g",
        bound="≤",
    ),
    "lambda_by_formula.rq": Quantity(
        "combined Rq before deformation", "m", "combined Rq", shown="nm", digits=".3g"
    ),
    "lambda_by_formula.lambda_ratio": Quantity(
        "central film of a formula / combined Rq", "", "lambda ratio by formula", digits=".2g"
    ),
    "grid.film": Quantity("nodes of the film before it is solved", "", "grid of the film"),
    "inputs.grid.side": Quantity(
        "half-width of the domain in semi-axes a", "", "half-width of the domain across"
    ),
    "inputs.grid.wedge": Quantity("scheme of the wedge term", "", "discretisation of the wedge term"),
}
_CONDITIONS: Keys = {
    "inputs.contact.load": Quantity("load", "N", "load"),
    "inputs.contact.load_per_length": Quantity("load per length", "N/m", "load per length", shown="MN/m"),
    "inputs.contact.entrainment_speed": Quantity("mean speed of the surfaces", "m/s", "entrainment speed"),
    "inputs.contact.slide_to_roll_ratio": Quantity("slide-to-roll ratio", "", "slide-to-roll ratio"),
    "inputs.contact.radius_x": Quantity(
        "reduced radius", "m", "reduced radius along entrainment", shown="prefixed"
    ),
    "inputs.contact.radius_y": Quantity(
        "reduced radius", "m", "reduced radius across entrainment", shown="prefixed"
    ),
    "inputs.contact.reduced_radius": Quantity("reduced radius", "m", "reduced radius", shown="prefixed"),
    "inputs.contact.reduced_modulus": Quantity("reduced modulus E'", "Pa", "reduced modulus"),
}
# Everything that outputs of a contact show, by its geometry.
CONTACT_BOOK: dict[str, Keys] = {
    geometry: {**keys, **_SHOWN, **_CONDITIONS} for geometry, keys in CONTACT_KEYS.items()
}
