"""Rating lives of a bearing by fatigue, beside its discharges: basic, reference and modified, SI units.

The lives are those of ISO 281 and ISO/TS 16281 that 90 of 100 bearings reach. They know of oil, dirt and
load, and of discharges only through a rougher surface; there is no law of erosion.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from ehlectric.arrays import Array, Numbers, as_float
from ehlectric.bearing.loads.geometry import BallBearing
from ehlectric.bearing.loads.life import (
    ElementRatings,
    ball_ratings,
    basic_life,
    equivalent_load,
    fatigue_load_limit,
    life_factor,
    rated_viscosity,
    reference_life,
    roller_ratings,
    viscosity_ratio_of_film,
)
from ehlectric.bearing.loads.ratings import (
    ball_dynamic_rating,
    ball_static_rating,
    roller_dynamic_rating,
    roller_static_rating,
    static_factor,
)
from ehlectric.bearing.solution import BearingSolution, lambda_ratio
from ehlectric.errors import Flag
from ehlectric.quantities.units import rpm

_TURN = 2.0 * math.pi

KEYS = (
    *("dynamic_rating", "static_rating", "fatigue_load_limit", "equivalent_load"),
    *("viscosity_ratio", "film_viscosity_ratio", "life_factor", "film_life_factor"),
    *("basic_life", "modified_life", "film_modified_life"),
    *("reference_life", "reference_modified_life", "roughened_life"),
)

# Least viscosity ratio that has a factor, largest load over the dynamic rating, and grooves over the ball
# diameter up to which ISO 281 rates a bearing.
_LEAST_RATIO, _MOST_LOAD, _GROOVES = 0.1, 0.5, (0.52 + 1e-9, 0.53 + 1e-9)

# Functions of single bearings, at many points.
_basic_life = np.vectorize(basic_life, otypes=[float])
_equivalent_load = np.vectorize(equivalent_load, otypes=[float])
_fatigue_load_limit = np.vectorize(fatigue_load_limit, otypes=[float])
_life_factor = np.vectorize(life_factor, otypes=[float])
_rated_viscosity = np.vectorize(rated_viscosity, otypes=[float])
_film_ratio = np.vectorize(viscosity_ratio_of_film, otypes=[float])
_static_factor = np.vectorize(static_factor, otypes=[float])
_RATINGS = {
    True: tuple(np.vectorize(rating, otypes=[float]) for rating in (ball_dynamic_rating, ball_static_rating)),
    False: tuple(
        np.vectorize(rating, otypes=[float]) for rating in (roller_dynamic_rating, roller_static_rating)
    ),
}


def life_of(solution: BearingSolution) -> dict[str, Numbers | None]:
    """Ratings [N], viscosity ratios, factors and lives [s] of a bearing, by the keys of ``life`` in
    summary.json, of shape (...); NaN where a number has no value, None without the table ``bearing.life``.
    """
    bearing, geometry = solution.case.bearing, solution.conditions.geometry
    life = bearing.life
    if life is None:
        return dict.fromkeys(KEYS)
    balls = isinstance(geometry, BallBearing)
    kind, exponent = ("radial ball", 3.0) if balls else ("radial roller", 10.0 / 3.0)
    dynamic, static = ratings_of(solution)
    limit = life.fatigue_load_limit
    if limit is None:
        limit = _fatigue_load_limit(static, geometry.pitch_diameter, rollers=not balls)
    load = _load(solution, static)
    turns, found = bearing.inner_speed / _TURN, {"dynamic_rating": dynamic, "static_rating": static}
    ratios = {"": _viscosity_ratio(solution), "film_": _film_ratio(lambda_ratio(solution))}
    clean = life.contamination_factor * limit
    factors = {name: _life_factor(kind, ratio, clean / load) for name, ratio in ratios.items()}
    basic = _basic_life(dynamic, load, exponent) / turns
    reference = _reference_revolutions(solution, dynamic) / turns
    # The load of which the reference life is the basic life.
    same = dynamic * (reference * turns / 1e6) ** (-1.0 / exponent)
    of_film = _life_factor(kind, ratios["film_"], clean / same)
    found |= {
        "fatigue_load_limit": limit,
        "equivalent_load": load,
        "viscosity_ratio": ratios[""],
        "film_viscosity_ratio": ratios["film_"],
        "life_factor": factors[""],
        "film_life_factor": factors["film_"],
        "basic_life": basic,
        "modified_life": factors[""] * basic,
        "film_modified_life": factors["film_"] * basic,
        "reference_life": reference,
        "reference_modified_life": of_film * reference,
        "roughened_life": None,
    }
    if life.roughened_rq is not None:
        rougher = _film_ratio(solution.least_film / np.maximum(life.roughened_rq, bearing.composite_rq))
        found["roughened_life"] = _life_factor(kind, rougher, clean / same) * reference
    return {key: None if found[key] is None else as_float(np.asarray(found[key])) for key in KEYS}


def life_flags(solution: BearingSolution) -> Iterator[Flag]:
    """Notes of inputs for which the rating lives have no value, or are beyond what the standards cover."""
    bearing, life = solution.case.bearing, life_of(solution)
    if bearing.life is None:
        return
    dynamic, static, limit, load, film = (
        np.asarray(life[key], dtype=float)
        for key in (
            *("dynamic_rating", "static_rating", "fatigue_load_limit", "equivalent_load"),
            "film_viscosity_ratio",
        )
    )
    yield Flag.of(np.isnan(load), "life-outside", "angle")
    yield Flag.of(film < _LEAST_RATIO, "life-outside", "oil", ratio=film)
    yield Flag.of(load > _MOST_LOAD * dynamic, "life-outside", "load", part=load / dynamic)
    yield Flag.of(limit > static, "life-outside", "limit", limit=limit, static=static)
    given = bearing.life.static_rating is not None and bearing.life.fatigue_load_limit is not None
    yield Flag.of(solution.conditions.ceramic and not given, "life-outside", "ceramic")
    inner, outer = (
        0.0 if groove is None else groove for groove in (bearing.inner_groove, bearing.outer_groove)
    )
    wide = np.logical_or(inner > _GROOVES[0], outer > _GROOVES[1])
    yield Flag.of(wide & (bearing.life.dynamic_rating is None), "life-outside", "grooves")


def ratings_of(solution: BearingSolution) -> tuple[Numbers, Numbers]:
    """Basic dynamic and static load rating [N], given, or of the geometry by ISO 281 and ISO 76."""
    bearing, geometry = solution.case.bearing, solution.conditions.geometry
    assert bearing.life is not None
    balls = isinstance(geometry, BallBearing)
    last = (bearing.contact_angle or 0.0) if balls else bearing.roller_length
    of_geometry = (bearing.elements, bearing.element_diameter, bearing.pitch_diameter, last)
    given = (bearing.life.dynamic_rating, bearing.life.static_rating)
    dynamic, static = (
        rating(*of_geometry) if one is None else one
        for rating, one in zip(_RATINGS[balls], given, strict=True)
    )
    return dynamic, static


def _load(solution: BearingSolution, static: Numbers) -> Array:
    """Equivalent dynamic load of ISO 281 [N], shape (...)."""
    bearing = solution.case.bearing
    radial, axial = np.abs(bearing.radial_load), np.abs(bearing.axial_load)
    if not isinstance(solution.conditions.geometry, BallBearing):
        return np.asarray(radial, dtype=float)
    angle = bearing.contact_angle or 0.0
    factor = _static_factor(bearing.element_diameter * np.cos(angle) / bearing.pitch_diameter)
    found: Array = _equivalent_load(radial, axial, angle, factor * axial / static)
    return found


def _viscosity_ratio(solution: BearingSolution) -> Numbers:
    """Kinematic viscosity of the oil at the temperature of the bearing over the rated one; NaN without the
    density of the oil, shape (...).
    """
    bearing, oil = solution.case.bearing, solution.conditions.oil
    if oil.density is None:
        return math.nan
    rated: Array = _rated_viscosity(rpm(bearing.inner_speed), bearing.pitch_diameter)
    return oil.viscosity / oil.density / rated


def _reference_revolutions(solution: BearingSolution, dynamic: Numbers) -> Numbers:
    """Basic reference rating life by the loads of the elements [revolutions], shape (...)."""
    bearing, geometry = solution.case.bearing, solution.conditions.geometry
    equilibrium = solution.positions[0].equilibrium
    loads = equilibrium.inner_load, equilibrium.outer_load
    ratio = bearing.element_diameter / bearing.pitch_diameter
    if isinstance(geometry, BallBearing):
        assert bearing.inner_groove is not None and bearing.outer_groove is not None
        angle = bearing.contact_angle or 0.0
        grooves = bearing.inner_groove, bearing.outer_groove
        each = ball_ratings(dynamic, bearing.elements, ratio * np.cos(angle), grooves, angle)
    else:
        each = roller_ratings(dynamic, bearing.elements, ratio)
    each = ElementRatings(np.asarray(each.inner), np.asarray(each.outer))
    return reference_life(loads, each, rollers=not isinstance(geometry, BallBearing))
