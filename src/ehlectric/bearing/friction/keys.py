"""Keys of summary.json for the rolling friction of a bearing, and for the heat in its contacts."""

from __future__ import annotations

from ehlectric.cases.result_key import Keys, ResultKey

# Why there is no number.
_NULL = 'null unless `bearing.film_factor` is "solved"'


def _of_ring(name: str) -> dict[str, ResultKey]:
    """Keys of the most loaded contact with a ring."""
    most, at = f"most loaded contact with the {name} ring", f", {name} ring"
    return {
        f"{name}_rolling_coefficient": ResultKey(
            f"hydrodynamic rolling force on one surface over the load, of the {most}, solved with heat in "
            f"pure rolling; {_NULL}",
            "",
            f"coefficient of rolling friction{at}",
        ),
        f"{name}_contact_power_loss": ResultKey(
            f"power that rolling takes in the {most}; {_NULL}", "W", f"power loss of a contact{at}"
        ),
        f"{name}_inlet_temperature_rise": ResultKey(
            f"largest temperature at mid-film from the inlet to the middle of the {most}, less that of the "
            f"ring; {_NULL}",
            "K",
            f"temperature rise in the inlet{at}",
        ),
        f"{name}_max_temperature_rise": ResultKey(
            f"largest temperature at mid-film in the {most}, less that of the ring: mostly a peak at the "
            f"pressure spike, which grows with the grid; {_NULL}",
            "K",
            f"largest temperature rise at mid-film{at}",
        ),
        f"{name}_temperature_rise_error": ResultKey(
            f"estimated error of {name}_max_temperature_rise by the grid; null if unknown",
            "K",
            f"error of the temperature rise{at}",
        ),
    }


FRICTION_KEYS: Keys = {
    "rolling_power_loss": ResultKey(
        "power that the hydrodynamic rolling resistance of all contacts takes, flooded, mean over the "
        "positions of the cage: a part of the friction of a bearing, without spin and slip of the balls, "
        f"cage, ribs, seals, churned oil and hysteresis; {_NULL}",
        "W",
        "hydrodynamic rolling power loss",
    ),
    "rolling_moment": ResultKey(
        f"rolling_power_loss over the speed of the inner ring; {_NULL}",
        "N*m",
        "hydrodynamic rolling moment",
    ),
    **_of_ring("inner"),
    **_of_ring("outer"),
}
