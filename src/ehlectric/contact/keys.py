"""Keys of the summary.json of a contact: meaning, unit, name and symbol of each value."""

from __future__ import annotations

from ehlectric.cases.result_key import Keys, ResultKey, under
from ehlectric.discharge import keys as discharge_keys
from ehlectric.surfaces.keys import LINE_SURFACE, MAP_STATISTICS, POINT_SURFACE, PROFILE_STATISTICS

_ABOUT: Keys = {
    "schema": ResultKey("name of the format"),
    "version": ResultKey("version of the program"),
    "title": ResultKey("title of the case"),
    "converged": ResultKey("whether the film is a solution"),
    "status": ResultKey('"converged", "stalled", "diverged" or "film collapsed"'),
    "warnings": ResultKey("warnings, to be read before the numbers are used"),
    "warning_codes": ResultKey(
        "code of each warning, in the same order: programs decide by codes, as words may change"
    ),
    "verdict": ResultKey(
        "answer in sentences: whether breakdown is expected at the applied voltage, and what is assumed; "
        "only with `[discharge]`"
    ),
    "inputs": ResultKey("the case, its alternatives resolved"),
}
_GROUPS: Keys = {
    "moes_m": ResultKey("dimensionless load M of Moes", "", "Moes", "$M$"),
    "moes_l": ResultKey("dimensionless material parameter L of Moes", "", "Moes", "$L$"),
}
_MAX_PRESSURE = ResultKey("largest pressure of the dry contact", "Pa", "Hertz pressure", r"$p_\mathrm{h}$")
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
        "smallest film thickness of all nodes", "m", "minimum film thickness", r"$h_\mathrm{min}$"
    ),
    "minimum_position": ResultKey("position of the node with the smallest film thickness", "m"),
    "central_thickness": ResultKey(
        "film thickness at x = 0, interpolated", "m", "central film thickness", "$h(0)$"
    ),
    "mean_thickness": ResultKey(
        "mean film thickness over abs(x) ≤ b, trapezoidal", "m", "mean film thickness", r"$\bar{h}$"
    ),
    "max_pressure": ResultKey(
        "largest pressure of all nodes; a sharp pressure spike grows with the grid",
        "Pa",
        "largest pressure in the film",
        r"$p_\mathrm{max}$",
    ),
    "load_residual": ResultKey("abs(∫P dX/(π/2) − 1)"),
    "residual": ResultKey("largest scaled residual of the film equations"),
    "newton_iterations": ResultKey(
        "Newton iterations on the finest grid; V-cycles where `--solver paper` solved the film"
    ),
    "discretisation_error": ResultKey(
        "Richardson's estimate of the relative error: the larger one of h_min and of h(0)",
        "",
        "discretisation error of the film",
    ),
    "solver": ResultKey('solver of the film: "ehlectric", or "paper" where `--solver paper` solved it'),
    "nodes": ResultKey("nodes of the film that was solved last, where `grid.refine` is given too"),
}
_POINT_FILM: Keys = {
    **_FILM,
    "minimum_position": ResultKey(
        "position [x, y] of the node with the smallest film thickness; of two mirror images the one at "
        "negative y",
        "m",
    ),
    "central_thickness": ResultKey(
        "film thickness at x = y = 0, interpolated", "m", "central film thickness", "$h(0)$"
    ),
    "mean_thickness": ResultKey(
        "mean film thickness over the Hertz ellipse", "m", "mean film thickness", r"$\bar{h}$"
    ),
    "load_residual": ResultKey("abs(∫∫P dX dY/(2 π k/3) − 1)"),
    "nodes": ResultKey(
        "nodes [along, across] of the film that was solved last, where `grid.refine` is given too"
    ),
    "inlet_deficit": ResultKey("share of the reduced pressure that would be built up before the inlet"),
    "side_deficit": ResultKey(
        "share of the reduced pressure that there would be at the sides, where it is held at ambient"
    ),
}
_FIELD: Keys = {
    "voltage": ResultKey("abs(V2 − V1)", "V", "voltage", "$V_{12}$"),
    "max_strength": ResultKey(
        "largest abs(E) on either wall or at mid-film", "V/m", "largest field strength", r"$|E|_\mathrm{max}$"
    ),
    "max_strength_position": ResultKey("position of max_strength", "m"),
    "max_dimensionless": ResultKey(
        "max_strength h_min/V12",
        "",
        "largest field strength",
        r"$|E|_\mathrm{max}\,h_\mathrm{min}/V_{12}$",
    ),
    "central_dimensionless": ResultKey(
        "abs(E) at mid-film, x = 0, times h_min/V12; null where the field range leaves the centre out"
    ),
    "thin_gap_error": ResultKey(
        "(max_strength − V12/h_min)/max_strength; null where the field range leaves h_min out"
    ),
    "max_strength_wall": ResultKey(
        'where across the film max_strength is: "surface 1", "mid-film" or "surface 2"'
    ),
    "solver": ResultKey('solver of the field: "ehlectric", or "paper" where `--solver paper` solved it'),
    "columns": ResultKey("columns of the field's grid"),
}
_LINE_FIELD: Keys = {
    **_FIELD,
    "high_field_width": ResultKey(
        "length of the contiguous interval in which mid-film abs(E) is at least 95 % of its maximum",
        "m",
        "width above 95 % of the largest field",
    ),
    "capacitance_per_length": ResultKey(
        "capacitance over the field range", "F/m", "capacitance per length, field range"
    ),
}
_POINT_FIELD: Keys = {
    **_FIELD,
    "max_strength_position": ResultKey(
        "position [x, y] of max_strength; of two mirror images the one at negative y", "m"
    ),
    "central_dimensionless": ResultKey(
        "abs(E) at mid-film, x = y = 0, times h_min/V12; null where the field range leaves the centre out"
    ),
    "columns": ResultKey("columns [along, across] of the field's grid"),
    "high_field_area": ResultKey(
        "area in which mid-film abs(E) is at least 95 % of its maximum, of both side lobes where there are "
        "two",
        "m**2",
        "area above 95 % of the largest field",
    ),
    "capacitance": ResultKey(
        "capacitance over the field range, by energy", "F", "capacitance, field range", "$C$"
    ),
    "capacitance_by_charge": ResultKey(
        "the same by the charge of surface 2, which agrees with capacitance", "F"
    ),
    "capacitance_by_zone.hertz": ResultKey("capacitance within the Hertz ellipse, by charge", "F"),
    "capacitance_by_zone.inlet": ResultKey("capacitance before the ellipse, as wide as it is", "F"),
    "capacitance_by_zone.outlet": ResultKey("capacitance behind the ellipse, as wide as it is", "F"),
    "capacitance_by_zone.sides": ResultKey("capacitance beyond that strip", "F"),
}
_FORMULAS: Keys = {
    "*.minimum_thickness": ResultKey(
        "minimum film thickness of a published formula; null where it has none", "m"
    ),
    "*.central_thickness": ResultKey(
        "central film thickness of a published formula; null where it has none", "m"
    ),
}
_SECONDS: Keys = {
    "film": ResultKey("time that the solver of the film took", "s"),
    "field": ResultKey("time that the solver of the field took", "s"),
}


def _roughness(zone: str) -> Keys:
    """Keys of the table ``roughness``, without those of its surfaces and its statistics."""
    return {
        "surfaces": ResultKey(
            "for each rough surface its source, size, voids and statistics after every step"
        ),
        "rq_1": ResultKey(f"root-mean-square height of surface 1 over the {zone}", "m"),
        "rq_2": ResultKey(f"root-mean-square height of surface 2 over the {zone}", "m"),
        "rq_combined": ResultKey(f"root-mean-square height of z1 + z2 over the {zone}", "m"),
        "lambda_ratio": ResultKey(
            "minimum_thickness/rq_combined; null where that is below 10⁻¹² m",
            "",
            "lambda ratio",
            r"$\Lambda$",
        ),
        "lambda_ratio_smooth": ResultKey(
            "smooth_minimum_thickness/rq_combined, as film formulas give it; null where the smooth contact "
            "was not solved too"
        ),
        "smooth_minimum_thickness": ResultKey(
            "smallest film thickness of the same contact with smooth surfaces", "m"
        ),
    }


def _statistics(where: str, keys: Keys) -> Keys:
    """Keys of the statistics of z1 + z2 over a region; ``where`` is the name of the region."""
    return {
        name: ResultKey(f"{key.meaning}, of z1 + z2 over the {where}", key.unit) for name, key in keys.items()
    }


LINE_KEYS: Keys = {
    **_ABOUT,
    **under("groups", _GROUPS),
    **under("hertz", _LINE_HERTZ),
    **under("film", _FILM),
    **under("field", _LINE_FIELD),
    **under("film_formulas", _FORMULAS),
    **under("seconds", _SECONDS),
    **under("discharge", discharge_keys.LINE_KEYS),
    **under("roughness", _roughness("Hertz zone")),
    **under("roughness.surfaces", LINE_SURFACE),
    **under("roughness.combined", _statistics("Hertz zone", PROFILE_STATISTICS)),
}
POINT_KEYS: Keys = {
    **_ABOUT,
    **under("groups", _GROUPS),
    **under("hertz", _POINT_HERTZ),
    **under("film", _POINT_FILM),
    **under("field", _POINT_FIELD),
    **under("film_formulas", _FORMULAS),
    **under("seconds", _SECONDS),
    **under("discharge", discharge_keys.POINT_KEYS),
    **under("roughness", _roughness("Hertz ellipse")),
    **under("roughness.surfaces", POINT_SURFACE),
    **under("roughness.combined", _statistics("rectangle around the Hertz ellipse", MAP_STATISTICS)),
}

# Keys of the summary by the geometry of the contact.
CONTACT_KEYS: dict[str, Keys] = {"line": LINE_KEYS, "point": POINT_KEYS}
