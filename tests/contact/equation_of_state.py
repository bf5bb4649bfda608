"""The most loaded inner contact of a 6208 with two equations of state: Dowson and Higginson's, and Tait's."""

from __future__ import annotations

import numpy as np
from scipy.constants import epsilon_0

from ehlectric import Case, solve
from tests.helpers.ball_on_disc import oil

TEMPERATURE = 343.15  # [K]

# Constants of Tait's equation for Shell T9, as in the library. The density refers to 70 degC, so that the
# relative permittivity is that of the contact's temperature with both laws. K00 exp(-beta T) is 1.14 GPa.
TAIT = {
    "density_law": "tait",
    "tait_k0_prime": 10.545,
    "tait_k00": 9.234e9,
    "tait_beta_k": 6.09e-3,
    "tait_expansion": 7.734e-4,
    "reference_temperature": TEMPERATURE,
}


def contact(*, tait, nodes=129):
    """Case of the contact at 2 GPa and 70 degC, with a relative permittivity of 2.4 at ambient pressure."""
    lubricant = oil(0.0118, 18.0, permittivity=2.4)
    if tait:
        kept = {key: value for key, value in lubricant.items() if not key.startswith("density_")}
        lubricant = kept | TAIT
    return Case.from_dict(
        {
            "contact": {
                "geometry": "point",
                "radius_x": "4.77 mm",
                "radius_y": "155 mm",
                "max_hertz_pressure": "2 GPa",
                "reduced_modulus": "228 GPa",
                "entrainment_speed": "4 m/s",
                "temperature": TEMPERATURE,
            },
            "lubricant": lubricant,
            "grid": {"nodes": nodes, "field_degree": 2, "field_nodes": 17, "field_nodes_y": 17},
        }
    )


def values(*, tait, nodes=129):
    """Films [m], density ratio and permittivity at the centre, and capacitance per area [F/m^2]."""
    case = contact(tait=tait, nodes=nodes)
    result = solve(case)
    assert result.film.converged
    film, conditions = result.film, result.conditions
    oil_at = case.lubricant.at(TEMPERATURE)
    ratio, _ = oil_at.density_ratio(film.pressure)
    permittivity = oil_at.permittivity(film.pressure, ratio)
    x, y = np.meshgrid(film.x / conditions.semi_axis_x, film.y / conditions.semi_axis_y, indexing="ij")
    density = epsilon_0 * permittivity / film.thickness
    centre = np.unravel_index(np.argmin(x**2 + y**2), x.shape)
    return {
        "minimum film": film.minimum_thickness,
        "central film": film.central_thickness,
        "density": ratio[centre],
        "permittivity": permittivity[centre],
        "capacitance, centre": density[centre],
        "capacitance, zone": density[x**2 + y**2 <= 1.0].mean(),
        "x": film.x / conditions.semi_axis_x,
        "film": film.thickness[:, film.y.size // 2],
        "pressure": film.pressure[:, film.y.size // 2],
    }
