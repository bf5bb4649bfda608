"""Stiffness of the teeth of a gear pair, by method B of ISO 6336-1 as gear texts quote it.

With z_n = z/(cos^2 beta_b cos beta), the flexibility of a pair of teeth at the pitch point is

    q' = 0.04723 + 0.15551/z_n1 + 0.25791/z_n2 - 0.00635 x_1 - 0.11654 x_1/z_n1 - 0.00193 x_2
    - 0.24188 x_2/z_n2 + 0.00529 x_1^2 + 0.00182 x_2^2        [mm um/N]
    c' = 0.8 C_B cos beta/q'        c_gamma = c' (0.75 eps_alpha + 0.25)        [N/(mm um)]
    C_B = (1 + 0.5 (1.2 - h_fP/m_n)) (1 - 0.02 (20 - alpha_n))        alpha_n [degrees]

for steel gears of solid discs, with a dedendum h_fP of 1.25 modules of the basic rack. Below 100 N/mm of
F_t K_A/b both are less by the power 1/4 of that load over 100 N/mm. The text of the standard was not at hand:
its constants are quoted from memory of it, an unverified source.
"""

from __future__ import annotations

import math

from ehlectric.gear.geometry import GearPair

# Constants of q': 1, 1/z_n1, 1/z_n2, x_1, x_1/z_n1, x_2, x_2/z_n2, x_1^2, x_2^2.
_FLEXIBILITY = (0.04723, 0.15551, 0.25791, -0.00635, -0.11654, -0.00193, -0.24188, 0.00529, 0.00182)

# Factor between computed and measured stiffness of full discs.
_MEASURED = 0.8

# Factor C_B of a dedendum of 1.25 m_n at 20 degrees, and its change per degree of the pressure angle.
_BASIC_RACK, _PER_DEGREE = 0.975, 0.02

# Load below which the stiffness decreases, F_t K_A/b [N/m].
_LIGHT = 100e3

# N/(mm um) in SI units [N/m^2].
_UNIT = 1e9


def pair_stiffness(pair: GearPair, load_per_width: float) -> float:
    """Stiffness c' of a pair of teeth of steel at the pitch point, per face width [N/m^2].

    ``load_per_width``, tangential load over the face width with the application factor, F_t K_A/b [N/m].
    """
    cosine = math.cos(pair.helix_angle) * math.cos(pair.base_helix_angle) ** 2
    first, second = (
        # A ring is stiffer than any wheel: it has the limit of infinitely many teeth.
        (cosine / teeth if teeth > 0 else 0.0)
        for teeth in pair.teeth
    )
    x1, x2 = pair.profile_shift
    if pair.internal:
        x2 = 0.0
    elif first < second:
        # Index 1 of the method is the gear with fewer teeth.
        first, second, x1, x2 = second, first, x2, x1
    terms = (1.0, first, second, x1, x1 * first, x2, x2 * second, x1 * x1, x2 * x2)
    flexibility: float = sum(factor * term for factor, term in zip(_FLEXIBILITY, terms, strict=True))
    rack = _BASIC_RACK * (1.0 - _PER_DEGREE * (20.0 - math.degrees(pair.normal_pressure_angle)))
    light: float = min(1.0, load_per_width / _LIGHT) ** 0.25
    return light * _UNIT * _MEASURED * rack * math.cos(pair.helix_angle) / flexibility


def mesh_stiffness(pair_stiffness: float, contact_ratio: float) -> float:
    """Mean stiffness c_gamma of the mesh over a phase, per face width [N/m^2].

    Examples
    --------
    >>> round(mesh_stiffness(13.0e9, 1.5) / 1e9, 3)
    17.875
    """
    return pair_stiffness * (0.75 * contact_ratio + 0.25)
