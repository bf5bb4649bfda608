"""Keys of the clearance and of the fits in the summary.json of a bearing."""

from __future__ import annotations

from ehlectric.cases.result_key import Keys, ResultKey

CLEARANCE_KEYS: Keys = {
    "unmounted_clearance": ResultKey(
        "radial clearance before mounting, given or of the class; null without `[bearing.fits]`",
        "m",
        "radial clearance before mounting",
    ),
    "mounted_clearance": ResultKey(
        "radial clearance with the fits at their reference temperature; null without `[bearing.fits]`",
        "m",
        "radial clearance, mounted",
    ),
    "running_clearance": ResultKey(
        "radial clearance in operation, on which loads and gaps are computed: given, from the free contact "
        "angle, or with `[bearing.fits]` from mounting and temperatures; negative with a preload",
        "m",
        "radial clearance in operation",
    ),
    "running_shaft_interference": ResultKey(
        "interference of inner ring and shaft in operation, negative where loose; null without fits",
        "m",
        "interference on the shaft",
    ),
    "running_housing_interference": ResultKey(
        "interference of outer ring and housing in operation, negative where loose; null without fits",
        "m",
        "interference in the housing",
    ),
    "shaft_pressure": ResultKey(
        "pressure between inner ring and shaft in operation; null without fits", "Pa", "pressure on the shaft"
    ),
    "housing_pressure": ResultKey(
        "pressure between outer ring and housing in operation; null without fits",
        "Pa",
        "pressure on the housing",
    ),
}
