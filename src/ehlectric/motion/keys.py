"""Keys of the summary.json of a transient contact.

Capacitances of line contacts are per length.
"""

from __future__ import annotations

from ehlectric.cases.result_key import Keys, ResultKey, under
from ehlectric.surfaces.keys import LINE_SURFACE, POINT_SURFACE

_ABOUT: Keys = {
    "schema": ResultKey("name of the format"),
    "version": ResultKey("version of the program"),
    "title": ResultKey("title of the case"),
    "converged": ResultKey("whether all steps were solved, to the end of the motion"),
    "warnings": ResultKey("warnings, to be read before the numbers are used"),
    "warning_codes": ResultKey(
        "code of each warning, in the same order: programs decide by codes, as words may change"
    ),
    "inputs": ResultKey("the case"),
}
_COURSE: Keys = {
    "duration": ResultKey("time of all steps", "s"),
    "steps": ResultKey("number of equal steps of the case"),
    "steps_done": ResultKey("number of steps in the file"),
    "courant": ResultKey("grid spacings that oil travels in a step"),
    "frames": ResultKey("number of instants that were kept, with the one before the motion"),
    "speed_ratio_1": ResultKey("speed of surface 1 over the mean speed"),
    "speed_ratio_2": ResultKey("speed of surface 2 over the mean speed"),
    "covered_from": ResultKey(
        "time from which the roughness that moves fills the Hertz zone, its front gone; null where it does "
        "not in time",
        "s",
    ),
    "coincident": ResultKey(
        "time at which all that moves lies as the case has it; null where it does not in time, or two rough "
        "surfaces move at unlike speeds",
        "s",
    ),
    "newton_per_step": ResultKey("mean number of Newton iterations of a time step"),
    "krylov_per_step": ResultKey("mean number of GMRES iterations of a time step"),
    "halvings": ResultKey("number of times that a step was halved, of all steps"),
}
_FILM: Keys = {
    "before": ResultKey("smallest film thickness before the motion", "m"),
    "minimum_thickness": ResultKey(
        "smallest film thickness of all steps", "m", "minimum film thickness", r"$h_\mathrm{min}$"
    ),
    "minimum_time": ResultKey("time of minimum_thickness", "s"),
    "minimum_position": ResultKey("position of minimum_thickness", "m"),
    "max_pressure": ResultKey(
        "largest pressure of all nodes and steps; a sharp pressure spike grows with the grid",
        "Pa",
        "largest pressure in the film",
        r"$p_\mathrm{max}$",
    ),
    "max_pressure_time": ResultKey("time of max_pressure", "s"),
}
_FIELD: Keys = {
    "voltage": ResultKey("abs(V2 − V1)", "V", "voltage", "$V_{12}$"),
    "before": ResultKey("largest field strength before the motion", "V/m"),
    "max_strength": ResultKey(
        "largest field strength of the kept instants", "V/m", "largest field strength", r"$|E|_\mathrm{max}$"
    ),
    "max_strength_time": ResultKey("time of max_strength", "s"),
    "max_strength_position": ResultKey("position of max_strength", "m"),
    "max_thin_gap_strength": ResultKey("voltage over the smallest film thickness of all steps", "V/m"),
    "share_above_90": ResultKey(
        "share of the time of all steps in which the largest field is above 90 % of its largest value "
        "since `covered_from`; between the kept instants it goes as the voltage over the smallest film"
    ),
    "time_above_90": ResultKey("how long that is", "s"),
    "local_maxima": ResultKey(
        "number of places where the field strength is larger than beside them, in the Hertz zone, of all "
        "instants together"
    ),
    "local_maxima_quantiles": ResultKey(
        "field strength at 5, 50 and 95 % of them; null where there are none", "V/m"
    ),
}
_DISCHARGE: Keys = {
    "breakdown_voltage": ResultKey(
        "smallest breakdown voltage of the kept instants", "V", "breakdown voltage", r"$V_\mathrm{b}$"
    ),
    "breakdown_time": ResultKey("time of breakdown_voltage", "s"),
    "breakdown_voltage_before": ResultKey("breakdown voltage before the motion", "V"),
    "breakdown_voltage_median": ResultKey("median of the breakdown voltage over time", "V"),
    "margin": ResultKey(
        "breakdown_voltage over the voltage of the case",
        "",
        "breakdown voltage over applied voltage",
        r"$V_\mathrm{b}/V_{12}$",
    ),
}
_BESIDE: Keys = {
    "time": ResultKey("time of that instant", "s"),
    "minimum_thickness": ResultKey("smallest film thickness, moving", "m"),
    "minimum_thickness_stationary": ResultKey("smallest film thickness, stationary", "m"),
    "thickness_rms_difference": ResultKey("root-mean-square difference of the film thickness", "m"),
    "thickness_largest_difference": ResultKey("largest difference of the film thickness", "m"),
    "maximum_pressure": ResultKey("largest pressure, moving", "Pa"),
    "maximum_pressure_stationary": ResultKey("largest pressure, stationary", "Pa"),
    "pressure_rms_difference": ResultKey("root-mean-square difference of the pressure", "Pa"),
    "pressure_largest_difference": ResultKey("largest difference of the pressure", "Pa"),
    "maximum_strength": ResultKey("largest field strength, moving", "V/m"),
    "maximum_strength_stationary": ResultKey("largest field strength, stationary", "V/m"),
    "strength_rms_difference": ResultKey("root-mean-square difference of the field strength", "V/m"),
    "strength_largest_difference": ResultKey("largest difference of the field strength", "V/m"),
}


def _keys(capacitance: str, surface: Keys) -> Keys:
    """Keys of a kind of contact, from the unit of its capacitances and the keys of its rough surfaces."""
    return {
        **_ABOUT,
        **under("motion", _COURSE),
        **under("film", _FILM),
        **under("field", _FIELD),
        **under("field", _capacitances(capacitance)),
        "discharge": ResultKey("null without a constant `dielectric_strength`"),
        **under("discharge", _DISCHARGE),
        "stationary": ResultKey("the same roughness held still; null where that was not solved"),
        **under("stationary", _stationary(capacitance)),
        "beside_stationary": ResultKey(
            "moving and stationary roughness within abs(x) < b, at the kept instant next to `coincident`; "
            "null where none is within 0.6 of a step, or nothing was solved to be set beside"
        ),
        **under("beside_stationary", _BESIDE),
        "rough": ResultKey("for each rough surface its source, size, voids and statistics after every step"),
        **under("rough", surface),
        "seconds": ResultKey("time that the run took, stops left out", "s"),
    }


def _capacitances(unit: str) -> Keys:
    return {
        "capacitance_mean": ResultKey("mean capacitance over the field range", unit),
        "capacitance_least": ResultKey("smallest capacitance over the field range", unit),
        "capacitance_largest": ResultKey("largest capacitance over the field range", unit),
    }


def _stationary(capacitance: str) -> Keys:
    return {
        "minimum_thickness": ResultKey("smallest film thickness", "m"),
        "minimum_position": ResultKey("position of minimum_thickness", "m"),
        "max_pressure": ResultKey("largest pressure of all nodes", "Pa"),
        "max_strength": ResultKey("largest field strength", "V/m"),
        "capacitance": ResultKey("capacitance over the field range", capacitance),
        "discretisation_error": ResultKey(
            "relative discretisation error of the stationary film; the moving film has no estimate"
        ),
    }


LINE_KEYS: Keys = _keys("F/m", LINE_SURFACE)
POINT_KEYS: Keys = _keys("F", POINT_SURFACE)

# Keys by the geometry of the case.
MOTION_KEYS: dict[str, Keys] = {"line": LINE_KEYS, "point": POINT_KEYS}
