"""Initial breakdown of bearings: exponents over the speed and ratios of loads, measured and computed.

The bearing, its oil and its temperature are not known, so that voltages are compared as ratios only. The
computed ones are those of candidate bearings with an oil of 96 mm^2/s at 40 degC and one strength of films.
"""

from __future__ import annotations

from functools import lru_cache
from typing import Any

import numpy as np

from ehlectric import BearingCase, solve_bearing
from ehlectric.bearing.summary import summary_of
from tests.helpers.measurements import Reference, load

# Radial and axial load [N] of the points that were read, and the speeds [rpm].
LOADS = ((1800, 900), (1800, 300), (600, 900))
SLOW, FAST = 2000, 7000

# Bearing of the catalogue whose rating is nearest to 16.9 kN, and those with 14 to 23 kN.
NEAREST, CANDIDATES = "6008", ("6205", "6006", "6008", "6206", "7206-b", "6305")

# What is added one after the other to smooth, flooded, isothermal films; the last is the best estimate.
FLOODED, HOT, GREASED, BEST = "flooded, isothermal", "heat in the inlet", "grease", "highest summits, 60 nm"
EFFECTS: dict[str, dict[str, Any]] = {
    FLOODED: {"film_factor": "none", "summit_height": 0.0},
    HOT: {"summit_height": 0.0},
    GREASED: {"supply": "grease", "summit_height": 0.0},
    BEST: {"supply": "grease", "summit_height": 2.0},
}
# Oil at the low speed [degC], and how much hotter it may be at the high one [K].
TEMPERATURE, WARMER = 60.0, 40.0


@lru_cache(maxsize=256)
def breakdown(
    bearing: str, loads: tuple[int, int], speed: int, effect: str, temperature: float = TEMPERATURE
) -> float:
    """Shaft voltage of the first breakdown [V], films from the atlas."""
    table: dict[str, Any] = {
        "contacts": "atlas",
        "bearing": {
            "base": bearing,
            "radial_load": f"{loads[0]} N",
            "axial_load": f"{loads[1]} N",
            "inner_speed": f"{speed} rpm",
            "temperature": f"{temperature} degC",
            "composite_rq": "0.03 um",
        },
        "lubricant": {"base": "fva-3", "thermal_conductivity": "0.134 W/m/K"},
        "discharge": {"dielectric_strength": "15 V/um"},
    }
    if not bearing.startswith("7"):
        table["bearing"]["radial_clearance"] = "10 um"
    table["bearing"] |= EFFECTS[effect]
    # Without the verdict, which solves further bearings.
    solution = solve_bearing(BearingCase.from_dict(table)).solution
    return float(summary_of(solution)["bearing"]["shaft_first_break"])


def computed_exponent(bearing: str, loads: tuple[int, int], effect: str, *, warmer: float = 0.0) -> float:
    """Exponent of the breakdown voltage over the speed, with oil that is warmer at the high speed [K]."""
    fast = breakdown(bearing, loads, FAST, effect, TEMPERATURE + warmer)
    return exponent_between(breakdown(bearing, loads, SLOW, effect), fast)


def exponent_between(slow: float, fast: float) -> float:
    """Exponent over the speed from the voltages at both speeds."""
    return float(np.log(fast / slow) / np.log(FAST / SLOW))


def measured(loads: tuple[int, int], speed: int) -> list[float]:
    """Measured voltages of the initial breakdown at a point [V], in the order of the table."""
    table = _data().table
    at = (table["radial_load"] == loads[0]) & (table["axial_load"] == loads[1]) & (table["speed"] == speed)
    return table["critical_1"][at].tolist()


def measured_exponents(loads: tuple[int, int]) -> list[float]:
    """Exponents over the speed of the pairs of tests with the same long test; 0.5 V is about 0.15 of it."""
    pairs = zip(measured(loads, SLOW), measured(loads, FAST), strict=False)
    return [exponent_between(slow, fast) for slow, fast in pairs]


@lru_cache(maxsize=1)
def _data() -> Reference:
    """The data file."""
    return load("bearing_breakdown")
