"""Internal geometry of bearings that the library lacks, estimated from their dimensions and load ratings.

``series.csv`` has the boundary dimensions and the load ratings of the usual series. Number, diameter and
length of the elements are those whose ratings by ISO 76 and ISO 281 are the printed ones. The two ratings
depend on them in different ways, which decides two of them; the others follow from the space between the
rings, as the functions below say.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cache, cached_property
from typing import Any

import scipy

from ehlectric.cases import library
from ehlectric.errors import InputError
from ehlectric.formulas.load_ratings import (
    RATED_GROOVES,
    THRUST_GROOVE,
    ball_dynamic_rating,
    ball_static_rating,
    roller_dynamic_rating,
    roller_static_rating,
    thrust_ball_dynamic_rating,
    thrust_ball_static_rating,
    thrust_roller_static_rating,
)

_MILLIMETRE = 1e-3

# Steps of the diameters of balls, 1/64 in, of metric balls, and of needles [m].
BALL_STEP, METRIC_STEP, NEEDLE_STEP = 25.4e-3 / 64.0, 0.5e-3, 0.5e-3

# Series of thin bearings, which also contain metric balls: the 6804 has 13 balls of 3.5 mm.
_METRIC = ("68", "69")

# Bore below which bearings of all series also contain metric balls [m]: the 626 has 6 balls of 3.5 mm.
_SMALL_BORE = 10.0 * _MILLIMETRE

# Small bearings of several bores or outside diameters with the same two ratings contain the same balls on the
# same pitch circle: the pitch circle of the bearing that fits the ratings best.
_SAME_BALLS = {
    "604": "694", "633": "624", "634": "625", "607": "626", "635": "626", "627": "608", "636": "608",
    "628": "609", "629": "6000", "637": "6000", "638": "6000", "639": "6200",
}  # fmt: skip

# Pitch diameter of balls and of tapered rollers divided by the mean of bore and outside diameter.
PITCH_RATIO = 1.0

# Least and largest ball over the difference of outside diameter and bore; of balls and rollers in all series.
_BALL_PARTS = 0.2, 0.4

# Part of the pitch circle that balls fill at most.
_MOST_FILLED = 0.95

# Relative difference of the static ratings of two makers with the same balls: rounding to three
# digits, and the rounded factors f_0 of ISO 76. One ball more or less changes the rating by 3 % or more.
_SAME_STATIC = 0.025

# Units of the deviation of dynamic ratings of other makers, and of their balls from the balls of the series,
# in units of their static ratings; and the largest deviation of balls that is taken, in per cent.
_OTHER_MAKER, _MOST_MISSED = 5.0, 6.0

# Gap between two rollers over their diameter: of cylindrical rollers of reinforced design (E), and of tapered
# rollers, whose pressed cages are thin.
ROLLER_GAP, TAPERED_GAP = 0.2, 0.08

# Diameter of a cylindrical roller that is as long as thick, less its effective length, and width of the ring
# of needles, less theirs [m]: chamfers, and flanges.
_CHAMFERS, _FLANGES = 1.0 * _MILLIMETRE, 4.5 * _MILLIMETRE

# Needle diameter over half of what the outside diameter of a drawn cup exceeds the shaft.
_IN_CUP = 0.73

# Rating of a four-point contact bearing: its axial ratings over the radial ones of one row with a contact
# angle of 35 degrees, 1/Y = 1/0.66 of ISO 281 and 1/Y_0 = 1/0.29 of ISO 76.
_FOUR_POINT = 0.66, 0.29

# Radial ratings of a four-point contact bearing with its two rows, as ``bearing.life`` takes them, over its
# printed axial ratings.
_FOUR_POINT_RADIAL = 2.0**0.7 * _FOUR_POINT[0], 2.0 * _FOUR_POINT[1]

# Height of a shoulder over the ball diameter, by the largest contact angle [deg] for which it is usual.
_SHOULDERS = ((20.0, 0.19), (27.0, 0.25), (32.0, 0.27), (90.0, 0.31))
_THRUST_SHOULDER = 0.19

# Types whose numbers are dimensions.
_SIZED = ("hk", "nk", "axk")

# Designs of cylindrical roller bearings without the reinforced rollers, whose rollers are as long as thick.
_SQUARE_ROLLERS = ("nu-10", "nu-4")


@dataclass(frozen=True)
class SeriesBearing:
    """Bearing of a series: dimensions and printed load ratings, without its internal geometry."""

    name: str
    kind: str
    # bore, outer_diameter, width: boundary dimensions, the bore of a needle bearing without an inner ring
    # being the diameter of the shaft; width of a tapered roller bearing, over both rings together [m].
    bore: float
    outer_diameter: float
    width: float
    contact_angle: float | None  # contact angle free of load [rad]
    # inner_raceway and outer_raceway: diameters under and over the rollers [m], where catalogues print them.
    inner_raceway: float | None
    outer_raceway: float | None
    cup_width: float | None  # width of the outer ring of a tapered roller bearing [m]
    # dynamic and static: basic load ratings, axial ones of thrust and four-point contact bearings [N].
    dynamic: float
    static: float

    @cached_property
    def series(self) -> str:
        """Name of the series: the designation without the code of its size.

        Examples
        --------
        >>> [series()[name].series for name in ("nu-2310", "na-49/22", "7210-b", "nk-20/20", "608")]
        ['nu-23', 'na-49', '72-b', 'nk', '60']
        """
        stem, _, angle = self.name.partition("-") if self.name[0].isdigit() else (self.name, "", "")
        if stem.startswith(_SIZED):
            return stem.partition("-")[0]
        # The bore is two digits, or one of three.
        stem = stem.rpartition("/")[0] if "/" in stem else stem[: max(2, len(stem) - 2)]
        return f"{stem}-{angle}" if angle else stem

    @property
    def middle(self) -> float:
        """Mean of bore and outside diameter [m]."""
        return 0.5 * (self.bore + self.outer_diameter)

    @property
    def without_inner_ring(self) -> bool:
        """Whether the shaft is the inner raceway."""
        return self.kind == "needle roller" and self.bore == self.inner_raceway


@cache
def series() -> Mapping[str, SeriesBearing]:
    """Bearings of the usual series by name, such as "6314", "nu-210", "7210-b" or "nk-20/20"."""
    lengths = ("bore", "outer_diameter", "width", "inner_raceway", "outer_raceway", "cup_width")
    bearings = {}
    for row in library.rows("series.csv"):
        # Decimal places of a millimetre are kept, as the product has a rounding error.
        sizes = {key: float(f"{row[key]}e-3") if row[key] else None for key in lengths}
        angle = math.radians(float(row["contact_angle"])) if row["contact_angle"] else None
        ratings = {key: float(row[key]) for key in ("dynamic", "static")}
        name = row["designation"]
        bearings[name] = SeriesBearing(name=name, kind=row["kind"], contact_angle=angle, **sizes, **ratings)  # type: ignore[arg-type]
    return bearings


@dataclass(frozen=True)
class EstimatedGeometry:
    """Elements of a bearing that have its load ratings."""

    elements: int
    # element_diameter, pitch_diameter and roller_length: dimensions, the length being effective [m].
    element_diameter: float
    pitch_diameter: float
    roller_length: float | None = None


@dataclass(frozen=True)
class Rules:
    """Constants of the estimate that are fitted to bearings of known geometry."""

    pitch_ratio: float = PITCH_RATIO
    roller_gap: float = ROLLER_GAP


RULES = Rules()


@cache
def estimated_geometry(
    bearing: SeriesBearing, dynamic: float | None = None, static: float | None = None, rules: Rules = RULES
) -> EstimatedGeometry:
    """Elements of a bearing from its dimensions and load ratings.

    ``dynamic`` and ``static``, ratings of another maker that replace the ratings of the series [N]; radial
    ratings with two rows of a four-point contact bearing. Raises InputError where no elements that fit
    between the rings have both ratings.

    Dynamic ratings of other makers contain factors of their own, so that the ratio of both ratings would give
    wrong diameters. Therefore balls remain the balls of the series, unless the static rating differs by more
    than 2.5 %; then they remain near them. Rollers keep their diameter.

    Examples
    --------
    >>> found = estimated_geometry(series()["6208"])
    >>> found.elements, round(1e3 * found.element_diameter, 3), found.pitch_diameter
    (9, 11.906, 0.06)
    """
    usual = _ESTIMATES[bearing.kind](bearing, Target(bearing.dynamic, bearing.static), rules)
    if dynamic is None and static is None:
        return usual
    factors = rating_factors(bearing.kind)
    target = Target(
        bearing.dynamic if dynamic is None else dynamic / factors[0],
        bearing.static if static is None else static / factors[1],
        usual.element_diameter,
    )
    if usual.roller_length is None and abs(target.static / bearing.static - 1.0) < _SAME_STATIC:
        return usual
    return _ESTIMATES[bearing.kind](bearing, target, rules)


def rating_factors(kind: str) -> tuple[float, float]:
    """Factors of the dynamic and the static load ratings of a series for ratings of ``bearing.life``."""
    return _FOUR_POINT_RADIAL if kind == "four-point contact ball" else (1.0, 1.0)


@dataclass(frozen=True)
class Target:
    """Load ratings that the elements of a bearing are to have."""

    # dynamic and static: basic load ratings [N].
    dynamic: float
    static: float
    near: float | None = None  # diameter near which the elements are [m]; None for ratings of the series

    def miss(self, dynamic: float, static: float, diameter: float) -> float:
        """Return how far the ratings [N] for an element diameter [m] are from the target, in units of 1 %."""
        parts = [static / self.static - 1.0, dynamic / self.dynamic - 1.0]
        if self.near is not None:
            parts = [parts[0], parts[1] / _OTHER_MAKER, (diameter / self.near - 1.0) / _OTHER_MAKER]
        return 100.0 * math.hypot(*parts)


def _balls(bearing: SeriesBearing, target: Target, rules: Rules) -> EstimatedGeometry:
    """Whole number of standard balls whose ratings are nearest to both ratings."""
    like = series().get(_SAME_BALLS.get(bearing.name, ""), bearing)
    pitch, angle = rules.pitch_ratio * like.middle, bearing.contact_angle or 0.0
    rates = (
        lambda number, ball: ball_dynamic_rating(number, ball, pitch, angle),
        lambda number, ball: ball_static_rating(number, ball, pitch, angle),
    )
    return _best_balls(bearing, target, pitch, rates)


def _four_point(bearing: SeriesBearing, target: Target, rules: Rules) -> EstimatedGeometry:
    """Balls from axial ratings, as the balls of one row with the corresponding radial ratings."""
    radial = replace(target, dynamic=_FOUR_POINT[0] * target.dynamic, static=_FOUR_POINT[1] * target.static)
    return _balls(bearing, radial, rules)


def _thrust_balls(bearing: SeriesBearing, target: Target, rules: Rules) -> EstimatedGeometry:
    pitch = rules.pitch_ratio * bearing.middle
    rates = (
        lambda number, ball: thrust_ball_dynamic_rating(number, ball, pitch),
        lambda number, ball: thrust_ball_static_rating(number, ball),
    )
    return _best_balls(bearing, target, pitch, rates)


def _best_balls(
    bearing: SeriesBearing,
    target: Target,
    pitch: float,
    rates: tuple[Callable[[int, float], float], Callable[[int, float], float]],
) -> EstimatedGeometry:
    """Number and standard ball with the least distance from the ratings."""
    best, geometry = _MOST_MISSED, None
    for ball in _standard_balls(bearing):
        # The static rating is proportional to the number.
        near = target.static / rates[1](1, ball)
        for number in (math.floor(near), math.ceil(near)):
            if number >= 3 and number * ball < _MOST_FILLED * math.pi * pitch:
                miss = target.miss(rates[0](number, ball), rates[1](number, ball), ball)
                if miss < best:
                    best, geometry = miss, EstimatedGeometry(number, ball, float(f"{pitch:.9g}"))
    if geometry is None:
        raise _no_elements(bearing)
    return geometry


def _standard_balls(bearing: SeriesBearing) -> Iterator[float]:
    """Diameters of standard balls that fit between the rings of a bearing [m]."""
    space = bearing.outer_diameter - bearing.bore
    metric = bearing.series in _METRIC or bearing.bore < _SMALL_BORE
    for step in (BALL_STEP, *((METRIC_STEP,) if metric else ())):
        first, last = round(_BALL_PARTS[0] * space / step), int(_BALL_PARTS[1] * space / step)
        yield from (float(f"{number * step:.9g}") for number in range(first, last + 1))


def _no_elements(bearing: SeriesBearing) -> InputError:
    factors = rating_factors(bearing.kind)
    dynamic, static = factors[0] * bearing.dynamic, factors[1] * bearing.static
    return InputError.worded(
        "life.static_rating",
        f"no elements that fit into a {bearing.name.upper()} have these load ratings, "
        f"for which ISO 76 and ISO 281 are solved",
        takes=f"ratings near the ratings of the series, {dynamic:.4g} N and {static:.4g} N",
    )


def _cylindrical(bearing: SeriesBearing, target: Target, rules: Rules) -> EstimatedGeometry:
    """Rollers between the printed raceways: as many as leave the usual gap, with the length that has the
    static rating. Rollers that are as long as thick have a number that gives this length.
    """
    assert bearing.inner_raceway is not None and bearing.outer_raceway is not None
    roller = 0.5 * (bearing.outer_raceway - bearing.inner_raceway)
    pitch = 0.5 * (bearing.outer_raceway + bearing.inner_raceway)
    number = math.floor(math.pi * pitch / ((1.0 + rules.roller_gap) * roller))
    if bearing.series in _SQUARE_ROLLERS:
        number = round(target.static / roller_static_rating(1, roller, pitch, roller - _CHAMFERS))
    return _with_length(number, roller, pitch, target.static)


def _with_length(
    number: int, roller: float, pitch: float, static: float, angle: float = 0.0
) -> EstimatedGeometry:
    """Rollers with the effective length that has the static rating."""
    length = static / roller_static_rating(number, roller, pitch, 1.0, angle)
    sizes = (float(f"{size:.5g}") for size in (roller, pitch, length))
    return EstimatedGeometry(number, *sizes)


def _needles(bearing: SeriesBearing, target: Target, _rules: Rules) -> EstimatedGeometry:
    """Needles in steps of half a millimetre, whose diameter has the ratio of both ratings, and in drawn cups
    leaves their usual wall. The number gives the usual length.
    """
    shaft = bearing.inner_raceway
    assert shaft is not None
    space = 0.5 * (bearing.outer_diameter - shaft)
    needle = _IN_CUP * space
    if bearing.series != "hk" or target.near is not None:
        needle = _roller_of_ratio(bearing, target, lambda roller: shaft + roller, space)
    needle = max(round(needle / NEEDLE_STEP), 1) * NEEDLE_STEP
    if needle >= space:
        raise _no_elements(bearing)
    pitch = shaft + needle
    number = round(target.static / roller_static_rating(1, needle, pitch, bearing.width - _FLANGES))
    if not 0 < number * needle < math.pi * pitch:
        raise _no_elements(bearing)
    return _with_length(number, needle, pitch, target.static)


def _tapered(bearing: SeriesBearing, target: Target, rules: Rules) -> EstimatedGeometry:
    """Rollers with the ratio of both ratings on the middle of the section, as many as leave the usual gap."""
    pitch, angle = rules.pitch_ratio * bearing.middle, bearing.contact_angle or 0.0
    space = 0.5 * (bearing.outer_diameter - bearing.bore)
    roller = _roller_of_ratio(bearing, target, lambda _roller: pitch, space)
    number = math.floor(math.pi * pitch / ((1.0 + TAPERED_GAP) * roller))
    return _with_length(number, roller, pitch, target.static, angle)


def _roller_of_ratio(
    bearing: SeriesBearing, target: Target, pitch: Callable[[float], float], space: float
) -> float:
    """Roller diameter whose rollers have the dynamic rating with the length that has the static one [m].

    The dynamic rating goes by Z^(3/4) and L^(7/9), the static one by Z L. Together they determine almost
    only the diameter, so that a usual number is enough here. ``space``, half of the difference of
    diameters that the rollers and both rings share [m].
    """
    if target.near is not None:
        return target.near
    angle = bearing.contact_angle or 0.0

    def excess(roller: float) -> float:
        number = math.pi * pitch(roller) / (1.5 * roller)
        length = target.static / roller_static_rating(1, roller, pitch(roller), 1.0, angle) / number
        rated = roller_dynamic_rating(1, roller, pitch(roller), length, angle) * number**0.75
        return float(rated / target.dynamic - 1.0)

    low, high = 0.1 * space, 0.95 * space
    if excess(low) * excess(high) > 0.0:
        raise _no_elements(bearing)
    return float(scipy.optimize.brentq(excess, low, high, xtol=1e-9))


def _thrust_needles(bearing: SeriesBearing, target: Target, _rules: Rules) -> EstimatedGeometry:
    """Needles as thick as the assembly is high, as many as have the static rating on the printed raceway."""
    assert bearing.inner_raceway is not None and bearing.outer_raceway is not None
    needle, length = bearing.width, 0.5 * (bearing.outer_raceway - bearing.inner_raceway)
    number = round(target.static / thrust_roller_static_rating(1, needle, length))
    pitch = 0.5 * (bearing.outer_raceway + bearing.inner_raceway)
    if not 0 < number * needle < math.pi * pitch:
        raise _no_elements(bearing)
    length = target.static / thrust_roller_static_rating(number, needle, 1.0)
    return EstimatedGeometry(number, needle, float(f"{pitch:.9g}"), float(f"{length:.5g}"))


@dataclass(frozen=True)
class EstimateError:
    """Largest relative deviation of an estimated geometry from the true one, either way."""

    element_diameter: float = 0.0
    pitch_diameter: float = 0.0
    roller_length: float = 0.0


# Largest deviations if each bearing of the library of known geometry is omitted in turn, rounded up, by
# benchmarks/estimated_bearings.py: of balls the 209 of another maker and the 6205 deviate most. Cylindrical
# rollers have printed raceways, and one roller more or less changes their length by 7 % at most. Other kinds
# have no known bearing, and the widest of all; only what is printed of them is exact.
_BALLS_OFF = EstimateError(element_diameter=0.065, pitch_diameter=0.015)
_WIDEST = EstimateError(element_diameter=0.065, pitch_diameter=0.015, roller_length=0.08)
ESTIMATE_ERRORS: Mapping[str, EstimateError] = {
    "deep-groove ball": _BALLS_OFF,
    "angular-contact ball": _BALLS_OFF,
    "four-point contact ball": _BALLS_OFF,
    "thrust ball": _BALLS_OFF,
    "cylindrical roller": EstimateError(roller_length=0.08),
    "needle roller": EstimateError(element_diameter=0.065, roller_length=0.08),
    "tapered roller": _WIDEST,
    "thrust needle roller": EstimateError(pitch_diameter=0.015, roller_length=0.08),
}

# Kinds of which no bearing of known geometry is omitted in turn.
WITHOUT_KNOWN = (
    "four-point contact ball",
    "thrust ball",
    "needle roller",
    "tapered roller",
    "thrust needle roller",
)


_ESTIMATES: Mapping[str, Callable[[SeriesBearing, Target, Rules], EstimatedGeometry]] = {
    "deep-groove ball": _balls,
    "angular-contact ball": _balls,
    "four-point contact ball": _four_point,
    "thrust ball": _thrust_balls,
    "cylindrical roller": _cylindrical,
    "needle roller": _needles,
    "tapered roller": _tapered,
    "thrust needle roller": _thrust_needles,
}


def is_estimated(base: str | None) -> bool:
    """Whether the geometry of a bearing that a file names is estimated, as the library lacks it.

    Examples
    --------
    >>> is_estimated("6314"), is_estimated("6208"), is_estimated(None)
    (True, False, False)
    """
    return base is not None and base in series() and base not in library.bearing_names()


def estimated_bearing(name: str, dynamic: float | None = None, static: float | None = None) -> dict[str, Any]:
    """Return the table ``bearing`` of a series bearing, in the form of a library file, SI units.

    ``dynamic`` and ``static``, ratings that replace the usual ones of the series [N].

    Examples
    --------
    >>> table = estimated_bearing("6314")
    >>> table["elements"], table["element_diameter"], table["bore"]
    (8, '0.0254 m', '0.07 m')
    """
    bearing = series()[name]
    geometry = estimated_geometry(bearing, dynamic, static)
    lengths = {
        "element_diameter": geometry.element_diameter,
        "pitch_diameter": geometry.pitch_diameter,
        "roller_length": geometry.roller_length,
        "bore": bearing.bore,
        "outer_diameter": bearing.outer_diameter,
        "width": bearing.width,
    }
    table: dict[str, Any] = {"kind": bearing.kind, "elements": geometry.elements}
    table |= {key: f"{size!r} m" for key, size in lengths.items() if size is not None}
    if geometry.roller_length is None:
        table |= _grooves(bearing)
    else:
        table["profile"] = "logarithmic"
    if bearing.contact_angle is not None and not bearing.kind.startswith("thrust"):
        table["contact_angle"] = f"{bearing.contact_angle!r} rad"
    if bearing.without_inner_ring:
        table["inner_ring"] = False
    return table


# Where dimensions and ratings of series were read; the head of ``series.csv`` says which catalogue has which.
_CATALOGUES = (
    "General catalogues of NSK, NKE, ZVL, ZEN, FBJ and URB, as transcribed in the public repository "
    "ArtemFilin1990/Mar"
)
# Keys of an estimated bearing by the kind of their source, and what a note says of them.
_SOURCES = (
    (("bore", "outer_diameter", "width", "contact_angle", "inner_ring"), "published", ""),
    (
        ("elements", "element_diameter", "pitch_diameter", "roller_length"),
        "by rule",
        "Estimated: by ISO 76 and ISO 281 these elements have the load ratings of the bearing.",
    ),
    (
        ("inner_groove", "outer_groove", "shoulder_height", "profile"),
        "assumed",
        "Grooves are the widest for which the ratings hold; the shoulders and the profile are usual ones.",
    ),
)


def estimated_file(name: str, dynamic: float | None = None, static: float | None = None) -> dict[str, Any]:
    """Tables ``bearing`` and ``source`` of a bearing of a series, as a file of the library contains them.

    Examples
    --------
    >>> [source["kind"] for source in estimated_file("6314")["source"]]
    ['published', 'by rule', 'assumed']
    """
    table = estimated_bearing(name, dynamic, static)
    sources = [
        {
            "keys": [key for key in keys if key in table],
            "kind": kind,
            **({} if kind == "assumed" else {"citation": _CATALOGUES}),
            **({"note": note} if note else {}),
        }
        for keys, kind, note in _SOURCES
    ]
    return {"bearing": table, "source": sources}


def _grooves(bearing: SeriesBearing) -> dict[str, float]:
    """Radii of the grooves for which the ratings hold, and the usual height of their shoulders."""
    if bearing.kind == "thrust ball":
        grooves, shoulder = (THRUST_GROOVE, THRUST_GROOVE), _THRUST_SHOULDER
    else:
        angle = math.degrees(bearing.contact_angle or 0.0)
        grooves, shoulder = RATED_GROOVES, next(height for most, height in _SHOULDERS if angle <= most)
    return {"inner_groove": grooves[0], "outer_groove": grooves[1], "shoulder_height": shoulder}
