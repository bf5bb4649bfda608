"""Rating lives of a bearing by fatigue, without its discharges: basic, reference and modified, SI units.

The lives follow ISO 281 and ISO/TS 16281; 90 of 100 bearings reach them, or a larger share with the
factor a_1. They depend on oil, dirt and load, and on discharges only through a rougher surface; there is no
law of erosion.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, fields, replace
from typing import Any, TypeAlias

import numpy as np

from ehlectric.arrays import Numbers, any_of, as_float, labels
from ehlectric.bearing.loads.life import (
    LOWEST_RATIO,
    ElementRatings,
    ball_ratings,
    basic_life,
    equivalent_load,
    equivalent_load_of_pair,
    equivalent_load_of_rollers,
    fatigue_load_limit,
    life_factor,
    load_of_life,
    rated_viscosity,
    reference_life,
    reliability_factor,
    roller_ratings,
    static_load,
    static_load_of_rollers,
    thrust_ratings,
    viscosity_ratio_of_film,
)
from ehlectric.bearing.solution import BearingSolution, lambda_ratio
from ehlectric.cases.bearing_inputs import Bearing, Life
from ehlectric.cases.library.printed_ratings import PrintedRatings, printed_ratings
from ehlectric.formulas.load_ratings import (
    RATED_GROOVES,
    THRUST_GROOVE,
    ball_dynamic_rating,
    ball_static_rating,
    roller_dynamic_rating,
    roller_static_rating,
    static_factor,
    thrust_ball_dynamic_rating,
    thrust_ball_static_rating,
    thrust_roller_dynamic_rating,
    thrust_roller_static_rating,
)
from ehlectric.quantities.result_warnings import WarningCondition
from ehlectric.quantities.units import rpm
from ehlectric.runtime.display import is_number

_TURN = 2.0 * math.pi

# Largest load over the dynamic rating for which ISO 281 holds.
_MOST_LOAD = 0.5

# Relative excess of a groove over the rated one that is rounding.
_ROUNDING = 1e-9


def _at_points(law: Callable[..., float]) -> Callable[..., Numbers]:
    """Function of a single bearing, at many points."""
    at_points = np.vectorize(law, otypes=[float])

    def law_at_points(*values: Numbers, **options: Any) -> Numbers:
        # A comparison with NaN, of a quantity that is not known, is not an error.
        with np.errstate(invalid="ignore"):
            return as_float(at_points(*values, **options))

    return law_at_points


_basic_life, _load_of_life = _at_points(basic_life), _at_points(load_of_life)
_life_factor, _film_ratio = _at_points(life_factor), _at_points(viscosity_ratio_of_film)
_reliability_factor = _at_points(reliability_factor)


# Bearing whose sizes give a rating by ISO 281 and ISO 76: of a file, or with printed ratings.
Sized: TypeAlias = Bearing | PrintedRatings


@dataclass(frozen=True)
class _Rules:
    """Rules of the standards that differ between kinds of bearings; ratings hold for one track."""

    factor: str  # name of the life modification factor
    dynamic: Callable[[Sized], Numbers]  # basic dynamic rating [N]
    static: Callable[[Sized], Numbers]  # basic static rating [N]
    # Equivalent load [N], from the static rating [N] and the number of tracks.
    equivalent: Callable[[Bearing, Numbers, int], Numbers]
    standing: Callable[[Bearing, int], Numbers]  # equivalent static load [N], from the number of tracks
    ratings: Callable[[Bearing, Numbers], ElementRatings]  # of an element, from the dynamic rating [N]
    grooves: tuple[float, ...] = ()  # widest grooves over the ball diameter that have the ratings
    tracks: int = 1  # contacts of an element with one ring

    @property
    def rollers(self) -> bool:
        """Whether the elements are rollers."""
        return self.factor.endswith("roller")

    @property
    def exponent(self) -> float:
        """Exponent of the basic life over the load."""
        return 10.0 / 3.0 if self.rollers else 3.0

    @property
    def slope(self) -> float:
        """Exponent of the dynamic rating over the number of tracks."""
        return 7.0 / 9.0 if self.rollers else 0.7


def _angle(bearing: Sized) -> Numbers:
    """Nominal contact angle of a radial bearing [rad]; 0 where it has none."""
    return 0.0 if bearing.contact_angle is None else bearing.contact_angle


def _ratio(bearing: Bearing) -> Numbers:
    """Diameter of the elements, along the contact angle, divided by the pitch diameter."""
    return bearing.element_diameter * np.cos(_angle(bearing)) / bearing.pitch_diameter


def _sizes(bearing: Sized) -> tuple[Numbers, ...]:
    """Number, diameter and pitch diameter of the elements, and the length of rollers."""
    length = () if bearing.roller_length is None else (bearing.roller_length,)
    return bearing.elements, bearing.element_diameter, bearing.pitch_diameter, *length


def _inclined(law: Callable[..., float]) -> Callable[[Sized], Numbers]:
    """Rating of a radial bearing, whose law takes its sizes and its contact angle."""
    at_points = _at_points(law)
    return lambda bearing: at_points(*_sizes(bearing), _angle(bearing))


def _loads(bearing: Bearing) -> tuple[Numbers, Numbers]:
    return bearing.radial_load, bearing.axial_load


def _equivalent_of_balls(bearing: Bearing, static: Numbers, tracks: int) -> Numbers:
    axial_part = _at_points(static_factor)(_ratio(bearing)) * bearing.axial_load / static
    law = equivalent_load if tracks == 1 else equivalent_load_of_pair
    return _at_points(law)(*_loads(bearing), _angle(bearing), axial_part)


def _equivalent_of_rollers(bearing: Bearing, _static: Numbers, tracks: int) -> Numbers:
    return _at_points(equivalent_load_of_rollers)(*_loads(bearing), _angle(bearing), tracks)


def _axial(bearing: Bearing, *_: Any) -> Numbers:
    return bearing.axial_load


def _static_of_balls(bearing: Bearing, tracks: int) -> Numbers:
    return _at_points(static_load)(*_loads(bearing), _angle(bearing), tracks)


def _static_of_rollers(bearing: Bearing, tracks: int) -> Numbers:
    return _at_points(static_load_of_rollers)(*_loads(bearing), _angle(bearing), tracks)


def _ratings_of_balls(bearing: Bearing, dynamic: Numbers) -> ElementRatings:
    assert bearing.inner_groove is not None and bearing.outer_groove is not None
    grooves = bearing.inner_groove, bearing.outer_groove
    return ball_ratings(dynamic, bearing.elements, _ratio(bearing), grooves, _angle(bearing))


def _ratings_of_rollers(bearing: Bearing, dynamic: Numbers) -> ElementRatings:
    return roller_ratings(dynamic, bearing.elements, _ratio(bearing), _angle(bearing))


_OF_BALLS = _Rules(
    factor="radial ball",
    dynamic=_inclined(ball_dynamic_rating),
    static=_inclined(ball_static_rating),
    equivalent=_equivalent_of_balls,
    standing=_static_of_balls,
    ratings=_ratings_of_balls,
    grooves=RATED_GROOVES,
)
_OF_ROLLERS = _Rules(
    factor="radial roller",
    dynamic=_inclined(roller_dynamic_rating),
    static=_inclined(roller_static_rating),
    equivalent=_equivalent_of_rollers,
    standing=_static_of_rollers,
    ratings=_ratings_of_rollers,
)
_RULES: dict[str, _Rules] = {
    "deep-groove ball": _OF_BALLS,
    "angular-contact ball": _OF_BALLS,
    "four-point contact ball": replace(_OF_BALLS, tracks=2),
    "thrust ball": _Rules(
        factor="thrust ball",
        dynamic=lambda bearing: _at_points(thrust_ball_dynamic_rating)(*_sizes(bearing)),
        static=lambda bearing: _at_points(thrust_ball_static_rating)(*_sizes(bearing)[:2]),
        equivalent=_axial,
        standing=_axial,
        ratings=lambda bearing, dynamic: thrust_ratings(dynamic, bearing.elements, rollers=False),
        grooves=(THRUST_GROOVE, THRUST_GROOVE),
    ),
    "cylindrical roller": _OF_ROLLERS,
    "needle roller": _OF_ROLLERS,
    "tapered roller": _OF_ROLLERS,
    "thrust needle roller": _Rules(
        factor="thrust roller",
        dynamic=lambda bearing: _at_points(thrust_roller_dynamic_rating)(*_sizes(bearing)),
        static=lambda bearing: _at_points(thrust_roller_static_rating)(
            bearing.elements, bearing.element_diameter, bearing.roller_length
        ),
        equivalent=_axial,
        standing=_axial,
        ratings=lambda bearing, dynamic: thrust_ratings(dynamic, bearing.elements, rollers=True),
    ),
}


@dataclass(frozen=True)
class RatedLoads:
    """Ratings of a bearing or of a bearing pair, and their load, shape (...) [N]."""

    dynamic_rating: Numbers
    static_rating: Numbers
    # dynamic_rating_source and static_rating_source: words for the origin of both ratings.
    dynamic_rating_source: Any
    static_rating_source: Any
    fatigue_load_limit: Numbers
    equivalent_load: Numbers  # NaN for a contact angle that the tables do not have
    static_equivalent_load: Numbers  # P_0, NaN for a contact angle that the table does not have
    static_safety: Numbers  # s_0, static rating divided by P_0


@dataclass(frozen=True)
class RatingLife(RatedLoads):
    """Ratings, viscosity ratios, factors and lives of a bearing, of shape (...); NaN where there is none."""

    rated_viscosity: Numbers  # kinematic viscosity that ISO 281 requires, nu_1 [m^2/s]
    viscosity_ratio: Numbers  # viscosity of the oil at the temperature of the bearing, divided by nu_1
    film_viscosity_ratio: Numbers  # viscosity ratio that corresponds to the lambda ratio
    reliability_factor: Numbers  # a_1 of the reliability of the file
    # Factors and lives [s]. Names with "film" use the viscosity ratio of the film, which is no standard's.
    # All lives except the basic ones, of 90 % reliability, have the reliability of the file.
    life_factor: Numbers
    film_life_factor: Numbers
    basic_life: Numbers
    reliable_life: Numbers
    modified_life: Numbers
    film_modified_life: Numbers
    # Lives from the loads of the elements [s].
    reference_life: Numbers
    reliable_reference_life: Numbers
    reference_modified_life: Numbers
    film_reference_modified_life: Numbers
    roughened_life: Numbers | None  # None if no roughness after discharges is given


# Keys of ``life`` in summary.json.
KEYS = tuple(field.name for field in fields(RatingLife))


def life_summary(solution: BearingSolution) -> dict[str, Numbers | None]:
    """Rating lives by the keys of ``life`` in summary.json; None without the table ``bearing.life``."""
    bearing = solution.case.bearing
    if bearing.life is None:
        return dict.fromkeys(KEYS)
    return vars(lives_of(bearing, bearing.life, fatigue_of(solution, bearing.life)))


@dataclass(frozen=True)
class Fatigue:
    """What a solved bearing contributes to its rating lives, of shape (...)."""

    viscosity: Numbers  # kinematic viscosity of the oil at the temperature of the bearing [m^2/s], or NaN
    lambda_ratio: Numbers
    reference_turns: Numbers  # basic reference rating life [revolutions]


def fatigue_of(solution: BearingSolution, life: Life) -> Fatigue:
    """What the rating lives of a bearing with the table ``life`` need of its solution."""
    bearing, oil = solution.case.bearing, solution.conditions.oil
    rules, groups = _RULES[bearing.kind], solution.conditions.geometry.groups
    at = solution.positions[0].equilibrium
    elements = rules.ratings(bearing, rated_loads(bearing, life).dynamic_rating / groups**rules.slope)
    return Fatigue(
        viscosity=math.nan if oil.density is None else oil.viscosity / oil.density,
        lambda_ratio=lambda_ratio(solution),
        reference_turns=reference_life(
            (at.inner_load, at.outer_load), elements, rollers=rules.rollers, rows=groups
        ),
    )


def lives_of(bearing: Bearing, life: Life, fatigue: Fatigue, *, least_ratio: float = 0.0) -> RatingLife:
    """Rating lives of a bearing with the inputs of its table ``life``.

    Viscosity ratios below ``least_ratio`` count as this ratio in the factors of the lives.
    """
    rules, rated = _RULES[bearing.kind], rated_loads(bearing, life)
    turns = bearing.inner_speed / _TURN
    clean = life.contamination_factor * rated.fatigue_load_limit

    def factor(ratio: Numbers, load: Numbers) -> Numbers:
        return _life_factor(rules.factor, np.maximum(ratio, least_ratio), clean / load)

    required = _required_viscosity(bearing)
    by_oil, by_film = fatigue.viscosity / required, _film_ratio(fatigue.lambda_ratio)
    factors = [factor(ratio, rated.equivalent_load) for ratio in (by_oil, by_film)]
    reliable = _reliability_factor(life.reliability)
    basic = _basic_life(rated.dynamic_rating, rated.equivalent_load, rules.exponent) / turns
    reference = fatigue.reference_turns / turns
    # The load whose basic life equals the reference life.
    same = _load_of_life(rated.dynamic_rating, fatigue.reference_turns, rules.exponent)
    rougher = None
    if life.roughened_rq is not None:
        # Points of a sweep may have a rougher surface than that.
        smoother = bearing.composite_rq / np.maximum(life.roughened_rq, bearing.composite_rq)
        rougher = reliable * factor(_film_ratio(smoother * fatigue.lambda_ratio), same) * reference
    return RatingLife(
        **vars(rated),
        rated_viscosity=required,
        viscosity_ratio=by_oil,
        film_viscosity_ratio=by_film,
        reliability_factor=reliable,
        life_factor=factors[0],
        film_life_factor=factors[1],
        basic_life=basic,
        reliable_life=reliable * basic,
        modified_life=reliable * factors[0] * basic,
        film_modified_life=reliable * factors[1] * basic,
        reference_life=reference,
        reliable_reference_life=reliable * reference,
        reference_modified_life=reliable * factor(by_oil, same) * reference,
        film_reference_modified_life=reliable * factor(by_film, same) * reference,
        roughened_life=rougher,
    )


def life_exponent(bearing: Bearing) -> float:
    """Exponent p of the basic rating life, (C/P)^p."""
    return _RULES[bearing.kind].exponent


def rated_loads(bearing: Bearing, life: Life) -> RatedLoads:
    """Ratings and load of a bearing; a pair counts as a bearing with two rows.

    The two tracks of a four-point contact bearing also count as rows.
    """
    rules = _RULES[bearing.kind]
    (turning, dynamic_source), (still, static_source) = (
        _rating(bearing, life, name) for name in ("dynamic", "static")
    )
    dynamic, static = bearing.rows**rules.slope * turning, bearing.rows * still
    limit: Numbers | None = life.fatigue_load_limit
    if limit is None:
        limit = _at_points(fatigue_load_limit)(static, bearing.pitch_diameter, rollers=rules.rollers)
    tracks = rules.tracks * bearing.rows
    load, standing = rules.equivalent(bearing, static, tracks), rules.standing(bearing, tracks)
    return RatedLoads(
        *(dynamic, static, dynamic_source, static_source, limit, load),
        static_equivalent_load=standing,
        static_safety=static / standing,
    )


def dynamic_rating(bearing: Bearing) -> Numbers:
    """Basic dynamic rating of a bearing, or of both bearings of a pair [N], also without ``life``."""
    rules, life = _RULES[bearing.kind], bearing.life or Life(contamination_factor=1.0)
    rating: Numbers = bearing.rows**rules.slope * _rating(bearing, life, "dynamic")[0]
    return rating


def _rating(bearing: Bearing, life: Life, name: str) -> tuple[Numbers, Any]:
    """Rating of one bearing, "dynamic" or "static" [N], with words for its origin: the rating of the file,
    otherwise the printed rating of the designation, otherwise a rating computed from the elements.

    A printed rating follows ISO 281 or ISO 76 if a file has other elements than its designation.
    """
    given: Numbers | None = getattr(life, f"{name}_rating")
    if given is not None:
        return given, "given"
    rules = _RULES[bearing.kind]
    law, factor, standard = {
        "dynamic": (rules.dynamic, rules.tracks**rules.slope, "ISO 281"),
        "static": (rules.static, rules.tracks, "ISO 76"),
    }[name]
    computed, printed = law(bearing), _printed(bearing, life)
    if printed is None:
        return factor * computed, f"computed from the elements by {standard}"
    scale, words = computed / law(printed), printed.source
    alike = np.abs(scale - 1.0) < _ROUNDING
    return scale * getattr(printed, name), labels((alike, words), f"{words}, scaled to these elements")


def _printed(bearing: Bearing, life: Life) -> PrintedRatings | None:
    """Printed ratings of the designation of a bearing; None without a designation."""
    given = (value if is_number(value) else None for value in (life.dynamic_rating, life.static_rating))
    ratings = printed_ratings(bearing.base, *given)
    return ratings if ratings is not None and ratings.kind == bearing.kind else None


def _required_viscosity(bearing: Bearing) -> Numbers:
    """Kinematic viscosity nu_1 that ISO 281 requires at the speed of a bearing [m^2/s]."""
    return _at_points(rated_viscosity)(rpm(bearing.inner_speed), bearing.pitch_diameter)


def life_warning_conditions(solution: BearingSolution) -> Iterator[WarningCondition]:
    """Notes of inputs for which the rating lives have no value, or are beyond what the standards cover."""
    bearing = solution.case.bearing
    life = bearing.life
    if life is None:
        return
    rated, fatigue = rated_loads(bearing, life), fatigue_of(solution, life)
    ratio, film = fatigue.viscosity / _required_viscosity(bearing), _film_ratio(fatigue.lambda_ratio)
    limit, static = rated.fatigue_load_limit, rated.static_rating
    part = rated.equivalent_load / rated.dynamic_rating
    yield WarningCondition.of(np.isnan(part), "life-outside", "angle")
    yield WarningCondition.of(ratio < LOWEST_RATIO, "life-outside", "oil", ratio=ratio)
    yield WarningCondition.of(film < LOWEST_RATIO, "life-outside", "film", ratio=film)
    yield WarningCondition.of(part > _MOST_LOAD, "life-outside", "load", part=part)
    yield WarningCondition.of(limit > static, "life-outside", "limit", limit=limit, static=static)
    given = life.static_rating is not None and life.fatigue_load_limit is not None
    yield WarningCondition.of(solution.conditions.ceramic and not given, "life-outside", "ceramic")
    grooves = (bearing.inner_groove, bearing.outer_groove)
    wide = [
        groove > most * (1.0 + _ROUNDING)
        for groove, most in zip(grooves, _RULES[bearing.kind].grooves, strict=False)
        if groove is not None
    ]
    yield WarningCondition.of(any_of(*wide) & (life.dynamic_rating is None), "life-outside", "grooves")
