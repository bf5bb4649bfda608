"""Keys of the heat and the shear of a film in the summary.json of a contact."""

from __future__ import annotations

from ehlectric.cases.result_key import Keys, ResultKey


def heat_keys(power: str) -> Keys:
    """Keys within the table ``film``; ``power`` is the unit of the power loss."""
    per_length = " per length" if power == "W/m" else ""
    return {
        "rheology": ResultKey("rheology of the film; only with `[film]`, as all keys below"),
        "thermal": ResultKey("true if the temperature in the film was computed"),
        "max_temperature_rise": ResultKey(
            "largest temperature at mid-film less that of the oil in the inlet; null for an isothermal film",
            "K",
            "temperature rise at mid-film",
            r"$\Delta T_\mathrm{max}$",
        ),
        "temperature_rise_error": ResultKey(
            "estimated error of max_temperature_rise by the grids along and across the film, the iteration "
            "and extrapolated properties of the oil; null if unknown",
            "K",
            "error of the temperature rise",
        ),
        "traction_coefficient": ResultKey(
            "mean shear stress at mid-film over the mean pressure, positive where surface 1 is faster; "
            "null, as rolling_coefficient and power_loss, if the film did not converge",
            "",
            "traction coefficient",
            r"$\mu$",
        ),
        "rolling_coefficient": ResultKey(
            "rolling friction of one surface over the load", "", "coefficient of rolling friction"
        ),
        "power_loss": ResultKey(
            f"power{per_length} that the film turns into heat, by sliding and rolling", power, "power loss"
        ),
        "energy_imbalance": ResultKey(
            "heat that the discretisation makes or loses, over the heat of compression and shear; null for "
            "an isothermal film",
            "",
            "error of the heat balance",
        ),
        "isothermal.minimum_thickness": ResultKey(
            "minimum film thickness of the same contact, isothermal and Newtonian; null if that film did not "
            "converge",
            "m",
            "minimum isothermal film thickness",
        ),
        "isothermal.central_thickness": ResultKey(
            "central film thickness of the same contact, isothermal and Newtonian; null if that film did not "
            "converge",
            "m",
            "central isothermal film thickness",
        ),
    }
