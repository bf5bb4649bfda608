"""Numbers of the heat and the shear of a film for the summary of a contact."""

from __future__ import annotations

from typing import Any

from ehlectric.film.thermal.result import HeatedFilm


def heat_summary(heated: HeatedFilm | None) -> dict[str, Any]:
    """Numbers within the table ``film`` of summary.json; none of an isothermal Newtonian film.

    Parameters
    ----------
    heated : HeatedFilm or None
        Heat and shear of the film.

    Returns
    -------
    dict
        Values in SI units, with the keys of ``contact.heat.keys``.
    """
    if heated is None:
        return {}
    return {
        "rheology": heated.rheology,
        "thermal": heated.thermal,
        "max_temperature_rise": heated.max_temperature_rise,
        "temperature_rise_error": heated.temperature_rise_error,
        "traction_coefficient": heated.traction_coefficient,
        "rolling_coefficient": heated.rolling_coefficient,
        "power_loss": heated.power_loss,
        "energy_imbalance": heated.energy_imbalance,
        "isothermal": {
            "minimum_thickness": heated.isothermal_minimum_thickness,
            "central_thickness": heated.isothermal_central_thickness,
        },
    }
