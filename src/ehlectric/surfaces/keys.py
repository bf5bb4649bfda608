"""Keys of rough surfaces in summary.json: source, processing steps, and statistics of profiles and maps."""

from __future__ import annotations

from ehlectric.cases.result_key import Keys, ResultKey, under

PROFILE_STATISTICS: Keys = {
    "rq": ResultKey("root-mean-square height", "m"),
    "ra": ResultKey("mean absolute height", "m"),
    "rsk": ResultKey("skewness of the heights"),
    "rku": ResultKey("kurtosis of the heights"),
    "correlation_length": ResultKey("distance at which the autocorrelation falls to 1/e", "m"),
    "rms_slope": ResultKey("root-mean-square slope"),
    "largest_slope": ResultKey("maximum slope"),
}
MAP_STATISTICS: Keys = {
    "sq": ResultKey("root-mean-square height", "m"),
    "sa": ResultKey("mean absolute height", "m"),
    "ssk": ResultKey("skewness of the heights"),
    "sku": ResultKey("kurtosis of the heights"),
    "correlation_length_x": ResultKey("distance along x at which the autocorrelation falls to 1/e", "m"),
    "correlation_length_y": ResultKey("distance along y at which the autocorrelation falls to 1/e", "m"),
    "correlation_length": ResultKey(
        "distance at which the autocorrelation falls to 1/e, in the direction in which it falls fastest", "m"
    ),
    "rms_slope": ResultKey("root-mean-square gradient"),
    "largest_slope": ResultKey("maximum gradient"),
}
_SURFACE: Keys = {
    "surface": ResultKey("number of the surface, 1 or 2"),
    "source": ResultKey("instrument file of the surface; null for a generated one"),
    "size": ResultKey("number of points in the file, of a map along both directions; null without a file"),
    "voids": ResultKey("share of points without data; of one line of a map, that of the line"),
    "height_step": ResultKey("minimum difference of heights in the file; null if there is none", "m"),
    "steps": ResultKey("statistics after every step of processing; empty for an exact shape"),
    "steps.step": ResultKey("name of the step"),
}
_PROFILE_STEP: Keys = {
    "points": ResultKey("number of points"),
    "spacing": ResultKey("distance between points", "m"),
    **PROFILE_STATISTICS,
}
_MAP_STEP: Keys = {
    "points_x": ResultKey("number of points along x"),
    "points_y": ResultKey("number of points along y"),
    "spacing_x": ResultKey("distance between points along x", "m"),
    "spacing_y": ResultKey("distance between points along y", "m"),
    **MAP_STATISTICS,
}

# Keys of one surface, of a line contact and of a point contact. A point contact may have a profile too, which
# is constant across its direction.
LINE_SURFACE: Keys = {**_SURFACE, **under("steps", _PROFILE_STEP)}
POINT_SURFACE: Keys = {**_SURFACE, **under("steps", _PROFILE_STEP), **under("steps", _MAP_STEP)}
