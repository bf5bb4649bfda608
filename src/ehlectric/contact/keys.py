"""Keys of the summary.json of a contact: meaning, unit, name and symbol of each value."""

from __future__ import annotations

from ehlectric.cases.oils.keys import OIL_KEYS
from ehlectric.cases.result_key import Keys, ResultKey, under
from ehlectric.contact.heat.keys import heat_keys
from ehlectric.contact.meter.keys import METER_KEYS
from ehlectric.contact.spots import keys as spot_keys
from ehlectric.contact.starved.keys import STARVED_KEYS
from ehlectric.discharge import keys as discharge_keys
from ehlectric.surfaces.keys import LINE_SURFACE, MAP_STATISTICS, POINT_SURFACE, PROFILE_STATISTICS

_ABOUT: Keys = {
    "schema": ResultKey("name of the format"),
    "version": ResultKey("version of the program"),
    "title": ResultKey("title of the case"),
    "converged": ResultKey("true if the film converged"),
    "status": ResultKey('"converged", "stalled", "diverged" or "film collapsed"'),
    "warnings": ResultKey("warnings; read them before using the numbers"),
    "warning_codes": ResultKey(
        "code of each warning, in the same order; programs should use codes, because texts may change"
    ),
    "verdict": ResultKey(
        "answer in sentences: whether breakdown is expected at the applied voltage, and what is assumed; "
        "only with `[discharge]`"
    ),
    "inputs": ResultKey("the case, with alternatives resolved"),
}
_GROUPS: Keys = {
    "moes_m": ResultKey("dimensionless load parameter M of Moes", "", "load parameter (Moes)", "$M$"),
    "moes_l": ResultKey("dimensionless material parameter L of Moes", "", "material parameter (Moes)", "$L$"),
}
_MAX_PRESSURE = ResultKey("maximum pressure of the dry contact", "Pa", "Hertz pressure", r"$p_\mathrm{h}$")
_LINE_HERTZ: Keys = {
    "half_width": ResultKey("half-width of the dry contact", "m", "half-width", "$b$"),
    "max_pressure": _MAX_PRESSURE,
}
_POINT_HERTZ: Keys = {
    "semi_axis_x": ResultKey(
        "semi-axis of the dry ellipse along entrainment", "m", "semi-axis along entrainment", "$b$"
    ),
    "semi_axis_y": ResultKey(
        "semi-axis of the dry ellipse across entrainment", "m", "semi-axis across entrainment", "$a$"
    ),
    "max_pressure": _MAX_PRESSURE,
}
_FILM: Keys = {
    "minimum_thickness": ResultKey(
        "minimum film thickness of all nodes", "m", "minimum film thickness", r"$h_\mathrm{min}$"
    ),
    "minimum_position": ResultKey("position of the node with the minimum film thickness", "m"),
    "central_thickness": ResultKey(
        "film thickness at x = 0, interpolated", "m", "central film thickness", "$h(0)$"
    ),
    "mean_thickness": ResultKey(
        "mean film thickness within abs(x) ≤ b, trapezoidal", "m", "mean film thickness", r"$\bar{h}$"
    ),
    "max_pressure": ResultKey(
        "maximum pressure of all nodes; a sharp pressure spike grows with the grid",
        "Pa",
        "maximum pressure in the film",
        r"$p_\mathrm{max}$",
    ),
    "load_residual": ResultKey("abs(∫P dX/(π/2) − 1)"),
    "residual": ResultKey("maximum scaled residual of the film equations"),
    "newton_iterations": ResultKey("Newton iterations on the finest grid; V-cycles with `--solver paper`"),
    "discretisation_error": ResultKey(
        "estimated relative error, the larger of the errors of h_min and h(0); null if unknown, and where "
        "the surfaces touch, so that h_min is the boundary film",
        "",
        "discretisation error of the film",
    ),
    "target_error": ResultKey(
        "relative error of the film to which the grid was to be refined; null for a grid of given nodes",
        "",
        "error asked of the film",
    ),
    "max_pressure_error": ResultKey(
        "estimated relative error of max_pressure; above about 0.3 the grid does not resolve its peak",
        "",
        "error of the maximum pressure",
    ),
    "solver": ResultKey('solver of the film: "ehlectric" or "paper"'),
    "nodes": ResultKey("nodes of the film, of the last grid where it is refined"),
    **STARVED_KEYS,
}
_POINT_FILM: Keys = {
    **_FILM,
    "minimum_position": ResultKey(
        "position [x, y] of the node with the minimum film thickness; of two mirror images the one at "
        "negative y",
        "m",
    ),
    "central_thickness": ResultKey(
        "film thickness at x = y = 0, interpolated", "m", "central film thickness", "$h(0)$"
    ),
    "mean_thickness": ResultKey(
        "mean film thickness within the Hertz ellipse", "m", "mean film thickness", r"$\bar{h}$"
    ),
    "load_residual": ResultKey("abs(∫∫P dX dY/(2 π k/3) − 1)"),
    "nodes": ResultKey("nodes [along, across] of the film, of the last grid where it is refined"),
    "inlet_deficit": ResultKey("share of the reduced pressure that would build up upstream of the domain"),
    "side_deficit": ResultKey(
        "share of the reduced pressure that the sides cut off, where the pressure is set to ambient"
    ),
}
_FIELD: Keys = {
    "voltage": ResultKey("abs(V2 − V1)", "V", "voltage", "$V_{12}$"),
    "max_strength": ResultKey(
        "maximum abs(E) on either wall or at mid-film", "V/m", "maximum field strength", r"$|E|_\mathrm{max}$"
    ),
    "max_strength_position": ResultKey("position of max_strength", "m"),
    "max_dimensionless": ResultKey(
        "max_strength / (V12/h_min), the ratio to the field of parallel plates",
        "",
        "maximum field / parallel-plate field",
        r"$|E|_\mathrm{max}\,h_\mathrm{min}/V_{12}$",
    ),
    "central_dimensionless": ResultKey(
        "abs(E) h_min/V12 at mid-film and x = 0; null outside the field range"
    ),
    "thin_gap_error": ResultKey(
        "relative error of the estimate V12/h_min: (max_strength − V12/h_min)/max_strength; null if the "
        "minimum film is outside the field range",
        "",
        "error of the estimate V/h_min",
    ),
    "max_strength_wall": ResultKey(
        'place of max_strength across the film: "surface 1", "mid-film" or "surface 2"'
    ),
    "solver": ResultKey('solver of the field: "ehlectric" or "paper"'),
    "max_strength_error": ResultKey(
        "estimated relative error of max_strength by the grid of the field; null if unknown",
        "",
        "error of the maximum field",
    ),
    "degree": ResultKey(
        "polynomial degree of the potential across the film; above `grid.field_degree` where short waves "
        "need it"
    ),
    "columns": ResultKey("columns of the field's grid"),
}
_LINE_FIELD: Keys = {
    **_FIELD,
    "high_field_width": ResultKey(
        "length of the contiguous interval in which mid-film abs(E) is at least 95 % of its maximum",
        "m",
        "width of the high-field zone (above 95 %)",
    ),
    "capacitance_per_length": ResultKey(
        "capacitance of the field range", "F/m", "capacitance per length, field range"
    ),
}
_POINT_FIELD: Keys = {
    **_FIELD,
    "max_strength_position": ResultKey(
        "position [x, y] of max_strength; of two mirror images the one at negative y", "m"
    ),
    "central_dimensionless": ResultKey(
        "abs(E) h_min/V12 at mid-film and x = y = 0; null outside the field range"
    ),
    "columns": ResultKey("columns [along, across] of the field's grid"),
    "high_field_area": ResultKey(
        "area in which mid-film abs(E) is at least 95 % of its maximum; the sum of both side lobes if there "
        "are two",
        "m**2",
        "area of the high-field zone (above 95 %)",
    ),
    "capacitance": ResultKey(
        "capacitance of the field range, from the field energy", "F", "capacitance, field range", "$C$"
    ),
    "capacitance_by_charge": ResultKey("capacitance of the field range, from the charge of surface 2", "F"),
    "capacitance_by_zone.hertz": ResultKey("capacitance of the Hertz ellipse, from the charge", "F"),
    "capacitance_by_zone.inlet": ResultKey(
        "capacitance of the inlet: upstream of the ellipse, of the same width", "F"
    ),
    "capacitance_by_zone.outlet": ResultKey(
        "capacitance of the outlet: downstream of the ellipse, of the same width", "F"
    ),
    "capacitance_by_zone.sides": ResultKey("capacitance of the sides: beyond the width of the ellipse", "F"),
}
_FORMULAS: Keys = {
    "*.minimum_thickness": ResultKey(
        "minimum film thickness of a published formula; null if it gives none", "m"
    ),
    "*.central_thickness": ResultKey(
        "central film thickness of a published formula; null if it gives none", "m"
    ),
}
_SECONDS: Keys = {
    "film": ResultKey("computing time of the film", "s"),
    "field": ResultKey("computing time of the field", "s"),
}


def _roughness(zone: str) -> Keys:
    """Keys of the table ``roughness``, without those of its surfaces and its statistics."""
    return {
        "surfaces": ResultKey("source, size, voids and statistics after every step, for each rough surface"),
        "rq_1": ResultKey(f"root-mean-square height of surface 1 within the {zone}", "m"),
        "rq_2": ResultKey(f"root-mean-square height of surface 2 within the {zone}", "m"),
        "rq_combined": ResultKey(f"root-mean-square height of z1 + z2 within the {zone}", "m"),
        "lambda_ratio": ResultKey(
            "minimum_thickness / rq_combined; null if rq_combined is below 10⁻¹² m",
            "",
            "lambda ratio",
            r"$\Lambda$",
        ),
        "lambda_ratio_smooth": ResultKey(
            "smooth_minimum_thickness / rq_combined, the lambda ratio of film formulas; null if the smooth "
            "contact was not solved"
        ),
        "smooth_minimum_thickness": ResultKey(
            "minimum film thickness of the contact with smooth surfaces", "m"
        ),
    }


def _statistics(where: str, keys: Keys) -> Keys:
    """Keys of the statistics of z1 + z2 over a region; ``where`` is the name of the region."""
    return {
        name: ResultKey(f"{key.meaning}, of z1 + z2 within the {where}", key.unit)
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
    **under("asperities", spot_keys.LINE_KEYS),
    **under("discharge", discharge_keys.LINE_KEYS),
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
    **under("asperities", spot_keys.POINT_KEYS),
    **under("discharge", discharge_keys.POINT_KEYS),
    **under("meter", METER_KEYS),
    **under("roughness", _roughness("Hertz ellipse")),
    **under("roughness.surfaces", POINT_SURFACE),
    **under("roughness.combined", _statistics("rectangle around the Hertz ellipse", MAP_STATISTICS)),
}

# Keys of the summary by the geometry of the contact.
CONTACT_KEYS: dict[str, Keys] = {"line": LINE_KEYS, "point": POINT_KEYS}
