"""Results of a contact over time: the keys of its summary.json."""

from __future__ import annotations

from ehlectric.quantities.quantity import Keys, Quantity, under
from ehlectric.quantities.surface_results import LINE_SURFACE, POINT_SURFACE

_ABOUT: Keys = {
    "schema": Quantity("name of the format"),
    "version": Quantity("version of the program"),
    "title": Quantity("title of the case"),
    "converged": Quantity("true if all time steps were solved"),
    "warnings": Quantity("warnings; read them before using the numbers"),
    "warning_codes": Quantity(
        "code of each warning, in the same order; programs should use codes, because texts may change"
    ),
    "inputs": Quantity("the case"),
}
_COURSE: Keys = {
    "duration": Quantity("duration of all steps", "s", "duration of the motion", shown="ms"),
    "steps": Quantity("number of equal steps of the case"),
    "steps_done": Quantity("number of steps in the file"),
    "courant": Quantity(
        "grid spacings that oil travels in a step",
        "",
        "oil travel per time step / grid spacing",
        digits=".3g",
    ),
    "frames": Quantity("number of recorded instants, including the one before the motion"),
    "speed_ratio_1": Quantity("speed of surface 1 / mean speed"),
    "speed_ratio_2": Quantity("speed of surface 2 / mean speed"),
    "covered_from": Quantity(
        "time from which the moving roughness fills the Hertz zone; null if it does not during the run",
        "s",
        "roughness fills the Hertz zone from",
        shown="ms",
    ),
    "coincident": Quantity(
        "time at which all roughness is at its position in the case; null if the run does not reach it, or "
        "two rough surfaces move at different speeds",
        "s",
        "roughness at its place in the case at",
        shown="ms",
    ),
    "newton_per_step": Quantity(
        "mean number of Newton iterations of a time step", "", "Newton steps per time step"
    ),
    "krylov_per_step": Quantity("mean number of GMRES iterations of a time step"),
    "halvings": Quantity("number of halvings of time steps", "", "halvings of time steps"),
}
_FILM: Keys = {
    "before": Quantity("minimum film thickness before the motion", "m", "minimum film before the motion"),
    "minimum_thickness": Quantity(
        "minimum film thickness of all steps", "m", "minimum film, moving roughness", r"$h_\mathrm{min}$"
    ),
    "minimum_time": Quantity("time of minimum_thickness", "s"),
    "minimum_position": Quantity("position of minimum_thickness", "m"),
    "max_pressure": Quantity(
        "maximum pressure of all nodes and steps; a sharp pressure spike grows with the grid",
        "Pa",
        "maximum pressure, moving roughness",
        r"$p_\mathrm{max}$",
    ),
    "max_pressure_time": Quantity("time of max_pressure", "s"),
    "discretisation_error": Quantity(
        "estimated relative discretisation error, of grid and time steps together: the larger of "
        "minimum_thickness_error and central_thickness_error; null if unknown, and where surfaces touch",
        "",
        "discretisation error in space and time",
        shown="%",
    ),
    "minimum_thickness_error": Quantity("estimated relative error of minimum_thickness; null if unknown"),
    "central_thickness_error": Quantity(
        "largest estimated relative error over time of the film thickness at the centre; null if unknown"
    ),
}
_SUPPLIED: Keys = {
    "oil_layer": Quantity(
        "thickness of the oil on both surfaces together before the contact, on the centre line; if they "
        "slide, the oil that they carry over the mean speed; only with `[inlet]`",
        "m",
        "layer of oil before the contact",
        r"$h_\mathrm{oil}$",
    ),
    "meniscus_before": Quantity(
        "position on the centre line from which oil fills the gap before the motion; null if the film is "
        "flooded or oil fills the gap at the inlet edge there, like the two below; only with `[inlet]`",
        "m",
        "meniscus, where oil fills the gap",
    ),
    "meniscus_least": Quantity("minimum over time of this position; only with `[inlet]`", "m"),
    "meniscus_largest": Quantity("maximum over time of this position; only with `[inlet]`", "m"),
}
_FIELD: Keys = {
    "voltage": Quantity("abs(V2 − V1)", "V", "voltage across the film", "$V_{12}$"),
    "before": Quantity(
        "maximum field strength before the motion", "V/m", "maximum field before the motion", bound="≥"
    ),
    "max_strength": Quantity(
        "maximum field strength of the recorded instants",
        "V/m",
        "maximum field, moving roughness",
        r"$|E|_\mathrm{max}$",
        bound="≥",
    ),
    "max_strength_time": Quantity("time of max_strength", "s"),
    "max_strength_error": Quantity(
        "maximum over the recorded instants of the estimated relative error of the maximum field by the grid "
        "of the field; null if it is unknown at one of them",
        "",
        "error of the maximum field",
        shown="%",
    ),
    "max_strength_position": Quantity("position of max_strength", "m"),
    "max_thin_gap_strength": Quantity("voltage / minimum film thickness of all steps", "V/m"),
    "share_above_90": Quantity(
        "share of the time since `covered_from` in which the maximum field is above 90 % of its maximum over "
        "time; between recorded instants the field is taken proportional to voltage / minimum film",
        "",
        "time above 90 % of the maximum field",
        shown="%",
    ),
    "time_above_90": Quantity("duration of share_above_90", "s"),
    "local_maxima": Quantity(
        "number of local maxima of the field strength in the Hertz zone, at all recorded instants together"
    ),
    "local_maxima_quantiles": Quantity(
        "5, 50 and 95 % quantiles of the local maxima of the field strength; null if there are none", "V/m"
    ),
}
_ASPERITIES: Keys = {
    "load_share_mean": Quantity(
        "share of asperities in the load, mean over the steps",
        "",
        "load share of the asperities, mean",
        r"$L_\mathrm{a}$",
        shown="%",
        digits=".2g",
    ),
    "load_share_mean_coarser": Quantity(
        "load_share_mean on every second node with twice the time step; null if this is not known"
    ),
    "load_share_largest": Quantity(
        "largest share of asperities in the load, of all steps",
        "",
        "load share of the asperities, maximum",
        shown="%",
        digits=".2g",
    ),
    "load_share_largest_time": Quantity("time of load_share_largest; null if nothing touches", "s"),
    "contact_area_share_mean": Quantity(
        "part of the Hertz zone in which the surfaces touch, mean over the steps",
        "",
        "real contact area / Hertz area, mean",
        shown="%",
        digits=".2g",
    ),
    "spots_mean": Quantity("number of spots, mean over the steps", "", "number of spots, mean", digits=".3g"),
    "time_share": Quantity(
        "share of the steps with at least one spot", "", "share of time with a spot", shown="%", digits=".3g"
    ),
    "steps": Quantity(
        "number of time steps since `covered_from`, on which means and time_share rest; an asperity in the "
        "contact stays there for many steps, so that neighbouring steps are not independent"
    ),
}
_DISCHARGE: Keys = {
    "breakdown_voltage": Quantity(
        "minimum breakdown voltage of the recorded instants",
        "V",
        "minimum breakdown voltage",
        r"$V_\mathrm{b}$",
        bound="≤",
    ),
    "breakdown_time": Quantity("time of breakdown_voltage", "s"),
    "breakdown_field_error": Quantity(
        "relative error of breakdown_voltage that is due to the field, `field.max_strength_error`; the error "
        "of the film, `film.minimum_thickness_error`, comes on top; null if unknown"
    ),
    "breakdown_voltage_before": Quantity("breakdown voltage before the motion", "V"),
    "breakdown_voltage_median": Quantity("median of the breakdown voltage over time", "V"),
    "margin": Quantity(
        "breakdown_voltage / voltage of the case",
        "",
        "margin (breakdown / applied voltage)",
        r"$V_\mathrm{b}/V_{12}$",
        bound="≤",
    ),
}
_BESIDE: Keys = {
    "time": Quantity("time of the compared instant", "s", "time of the same position", shown="ms"),
    "minimum_thickness": Quantity("minimum film thickness, moving", "m", "minimum film then, moving"),
    "minimum_thickness_stationary": Quantity(
        "minimum film thickness, stationary", "m", "minimum film then, stationary"
    ),
    "thickness_rms_difference": Quantity("root-mean-square difference of the film thickness", "m"),
    "thickness_largest_difference": Quantity("maximum difference of the film thickness", "m"),
    "maximum_pressure": Quantity("maximum pressure, moving", "Pa"),
    "maximum_pressure_stationary": Quantity("maximum pressure, stationary", "Pa"),
    "pressure_rms_difference": Quantity("root-mean-square difference of the pressure", "Pa"),
    "pressure_largest_difference": Quantity("maximum difference of the pressure", "Pa"),
    "maximum_strength": Quantity(
        "maximum field strength, moving", "V/m", "maximum field then, moving", bound="≥"
    ),
    "maximum_strength_stationary": Quantity(
        "maximum field strength, stationary", "V/m", "maximum field then, stationary", bound="≥"
    ),
    "strength_rms_difference": Quantity("root-mean-square difference of the field strength", "V/m"),
    "strength_largest_difference": Quantity("maximum difference of the field strength", "V/m"),
}


def _keys(capacitance: str, surface: Keys) -> Keys:
    """Keys of a kind of contact, from the unit of its capacitances and the keys of its rough surfaces."""
    return {
        **_ABOUT,
        **under("motion", _COURSE),
        **under("film", _FILM),
        **under("film", _SUPPLIED),
        **under("field", _FIELD),
        **under("field", _capacitances(capacitance)),
        **under("asperities", _ASPERITIES),
        "discharge": Quantity("null without a constant `dielectric_strength`"),
        **under("discharge", _DISCHARGE),
        "stationary": Quantity(
            "results with the same roughness, stationary; null if that film did not converge"
        ),
        **under("stationary", _stationary(capacitance)),
        "beside_stationary": Quantity(
            "comparison of moving and stationary roughness within abs(x) < b, at the recorded instant next "
            "to `coincident`; null if none is within 0.6 of a step, or the stationary film did not converge"
        ),
        **under("beside_stationary", _BESIDE),
        "rough": Quantity("source, size, voids and statistics after every step, for each rough surface"),
        **under("rough", surface),
        "seconds": Quantity("computing time, without interruptions", "s", "computing time", shown="s"),
    }


def _capacitances(unit: str) -> Keys:
    return {
        "capacitance_mean": Quantity("mean over time of the capacitance of the field range", unit),
        "capacitance_least": Quantity("minimum over time of the capacitance of the field range", unit),
        "capacitance_largest": Quantity("maximum over time of the capacitance of the field range", unit),
    }


def _stationary(capacitance: str) -> Keys:
    return {
        "minimum_thickness": Quantity("minimum film thickness", "m", "minimum film, stationary roughness"),
        "minimum_position": Quantity("position of minimum_thickness", "m"),
        "max_pressure": Quantity(
            "maximum pressure of all nodes", "Pa", "maximum pressure, stationary roughness"
        ),
        "max_strength": Quantity(
            "maximum field strength", "V/m", "maximum field, stationary roughness", bound="≥"
        ),
        "capacitance": Quantity("capacitance of the field range", capacitance),
        "discretisation_error": Quantity(
            "relative discretisation error of the stationary film, null where its surfaces touch; that of "
            "the moving film is `film.discretisation_error`"
        ),
    }


LINE_KEYS: Keys = _keys("F/m", LINE_SURFACE)
POINT_KEYS: Keys = _keys("F", POINT_SURFACE)

# Keys by the geometry of the case.
MOTION_KEYS: dict[str, Keys] = {"line": LINE_KEYS, "point": POINT_KEYS}

# Quantities that outputs show and no summary stores, or stores as items of a list.
_SHOWN: Keys = {
    "field.local_maxima_quantiles.1": Quantity(
        "median of the local maxima of the field strength", "V/m", "local field maxima, median", bound="≥"
    ),
    "field.local_maxima_quantiles.2": Quantity(
        "95 % quantile of the local maxima of the field strength",
        "V/m",
        "local field maxima, 95 % quantile",
        bound="≥",
    ),
    **{
        f"motion.speed_{k}": Quantity(f"speed of surface {k}", "m/s", f"speed of rough surface {k}")
        for k in (1, 2)
    },
}
# Everything that outputs of a contact over time show, by its geometry.
MOTION_BOOK: dict[str, Keys] = {geometry: {**keys, **_SHOWN} for geometry, keys in MOTION_KEYS.items()}
