"""Numbers of a bearing that are bounds only."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ehlectric.quantities.quantity import Bound

# Breakdown voltages and margins. The films of a bearing are smooth, and mostly isothermal and fully flooded:
# real films are thinner and break down at lower voltages.
_AT_MOST = (
    "through_breakdown",
    "through_breakdown_mean",
    "through_margin",
    "first_break_mean",
    "first_break",
    "margin",
    "shaft_first_break",
    "shaft_through_breakdown",
)

# Field strengths and the probability of breakdown, which are higher in thinner films. The shaft voltage falls
# with the film, but less than it.
_AT_LEAST = ("strength_per_volt", "max_strength", "breakdown_probability")

# Capacitances of ceramic elements whose own capacitance is not given.
_CERAMIC = ("capacitance", "capacitance_oil", "capacitance_air", "shaft_capacitance")


def bounds_of(summary: Mapping[str, Any]) -> dict[str, Bound]:
    """Bounds of the numbers of a bearing, by their dotted keys.

    Parameters
    ----------
    summary : mapping
        Summary of a bearing, as ``BearingResult.summary`` gives it.

    Returns
    -------
    dict of str to str
        "≤" for an upper bound, "≥" for a lower one; other numbers are left out.
    """
    codes = summary.get("warning_codes", ())
    at_most, at_least = list(_AT_MOST), list(_AT_LEAST)
    if "capacitance-bound" in codes:
        at_most += _CERAMIC
    if "shaft-leaks" in codes:
        # The oil discharges the shaft, whose voltage is lower then, and so may be the field.
        at_most += ["shaft_voltage", "film_voltage"]
        at_least = ["strength_per_volt"]
    bounds: dict[str, Bound] = {f"bearing.{name}": "≤" for name in at_most}
    for name in at_least:
        bounds[f"bearing.{name}"] = "≥"
    return bounds
