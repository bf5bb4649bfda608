"""Sliding loss of a gear mesh, and the temperature of its flanks that follows from it. SI units.

With the tip contact ratios eps_1 = (g_E - g_C)/p_bt and eps_2 = (g_C - g_A)/p_bt, the loss factor of
Ohlendorf and the loss are

    H_v = pi (u + 1)/(z_1 u cos beta_b) (1 - eps_alpha + eps_1^2 + eps_2^2)          P_v = mu P H_v,

for transverse contact ratios of 1 to 2. It is the loss of pairs that share the load equally: with the number
n of pairs that touch, and tip contact ratios as distances from C,

    H_v = 2 pi (u + 1)/(z_1 u cos beta_b) integral of abs(eps)/n d eps, from -eps_2 to eps_1,

which holds for larger contact ratios too, and is used for them. ISO/TS 6336-22 estimates the bulk temperature
of the flanks as

    theta_M = theta_oil + 7400 K (P mu H_v/(a b))^0.72 X_S/1.2        P [kW], a and b [mm],

with X_S = 1.2 for oil that is injected and 1 for dip lubrication, without tip relief. The text of the
standard was not at hand: its constants are an unverified source.
"""

from __future__ import annotations

import itertools
import math
from functools import lru_cache

from ehlectric.gear.contact_path import ContactPath
from ehlectric.gear.geometry import GearPair

# Constants of the bulk temperature for power in W and lengths in m, and of injected oil.
_RISE, _EXPONENT, _INJECTED = 7400.0, 0.72, 1.2


@lru_cache(maxsize=64)
def loss_factor(pair: GearPair, path: ContactPath) -> float:
    """Loss factor H_v of a gear pair, dimensionless."""
    first = (path.end - path.pitch_point) / path.base_pitch
    second = (path.pitch_point - path.start) / path.base_pitch
    ratio = pair.ratio
    scale = math.pi * (ratio + 1.0) / (pair.teeth[0] * ratio * math.cos(pair.base_helix_angle))
    if path.contact_ratio > 2.0:
        return scale * _of_equal_loads(first, second)
    return scale * (1.0 - path.contact_ratio + first * first + second * second)


def _of_equal_loads(first: float, second: float) -> float:
    """Twice the integral of abs(eps)/n over the path of contact, from -second to first, dimensionless.

    The number n of pairs changes where a pair a whole number of base pitches away begins or ends its contact.
    """
    whole = range(math.ceil(first + second))
    ends = {0.0, *(k - second for k in whole), *(first - k for k in whole), first, -second}
    edges = sorted(end for end in ends if -second <= end <= first)
    total = 0.0
    for low, high in itertools.pairwise(edges):
        middle = 0.5 * (low + high)
        pairs = math.floor(middle + second) + math.floor(first - middle) + 1
        total += abs(high * abs(high) - low * abs(low)) / pairs
    return total


def bulk_temperature(
    oil_temperature: float, power: float, friction: float, factor: float, distance: float, width: float
) -> float:
    """Bulk temperature of the flanks for injected oil [K]. ``oil_temperature`` [K]; ``power`` that the mesh
    transmits [W]; ``friction``, mean coefficient; ``factor``, H_v; ``distance`` and ``width``, centre
    distance and face width [m].
    """
    per_area = 1e-3 * abs(power) * friction * factor / (1e6 * abs(distance) * width)
    rise: float = _RISE * per_area**_EXPONENT * _INJECTED / 1.2
    return oil_temperature + rise
