"""Results of surfaces: statistics of a profile or of a map, and the steps of its preparation."""

from __future__ import annotations

from ehlectric.quantities.quantity import Keys, Quantity, under

PROFILE_STATISTICS: Keys = {
    "rq": Quantity("root-mean-square height", "m"),
    "ra": Quantity("mean absolute height", "m"),
    "rsk": Quantity("skewness of the heights"),
    "rku": Quantity("kurtosis of the heights"),
    "correlation_length": Quantity("distance at which the autocorrelation falls to 1/e", "m"),
    "rms_slope": Quantity("root-mean-square slope"),
    "largest_slope": Quantity("maximum slope"),
}
MAP_STATISTICS: Keys = {
    "sq": Quantity("root-mean-square height", "m"),
    "sa": Quantity("mean absolute height", "m"),
    "ssk": Quantity("skewness of the heights"),
    "sku": Quantity("kurtosis of the heights"),
    "correlation_length_x": Quantity("distance along x at which the autocorrelation falls to 1/e", "m"),
    "correlation_length_y": Quantity("distance along y at which the autocorrelation falls to 1/e", "m"),
    "correlation_length": Quantity(
        "distance at which the autocorrelation falls to 1/e, in the direction in which it falls fastest", "m"
    ),
    "rms_slope": Quantity("root-mean-square gradient"),
    "largest_slope": Quantity("maximum gradient"),
}
_SURFACE: Keys = {
    "surface": Quantity("number of the surface, 1 or 2"),
    "source": Quantity("instrument file of the surface; null for a generated one"),
    "size": Quantity("number of points in the file, of a map along both directions; null without a file"),
    "voids": Quantity("share of points without data; of one line of a map, that of the line"),
    "height_step": Quantity("minimum difference of heights in the file; null if there is none", "m"),
    "steps": Quantity("statistics after every step of processing; empty for an exact shape"),
    "steps.step": Quantity("name of the step"),
}
_PROFILE_STEP: Keys = {
    "points": Quantity("number of points"),
    "spacing": Quantity("distance between points", "m"),
    **PROFILE_STATISTICS,
}
_MAP_STEP: Keys = {
    "points_x": Quantity("number of points along x"),
    "points_y": Quantity("number of points along y"),
    "spacing_x": Quantity("distance between points along x", "m"),
    "spacing_y": Quantity("distance between points along y", "m"),
    **MAP_STATISTICS,
}

# Keys of one surface, of a line contact and of a point contact. A point contact may have a profile too, which
# is constant across its direction.
LINE_SURFACE: Keys = {**_SURFACE, **under("steps", _PROFILE_STEP)}
POINT_SURFACE: Keys = {**_SURFACE, **under("steps", _PROFILE_STEP), **under("steps", _MAP_STEP)}
