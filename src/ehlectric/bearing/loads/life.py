"""Rating life of bearings: basic and modified by ISO 281, and from the loads of the elements by ISO/TS 16281.

Lives are in revolutions. They are those that 90 of 100 bearings reach; fatigue that begins below the surface
ends them. Nothing here knows of damage by discharges.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ehlectric.arrays import Array, Numbers, as_float

_MILLION = 1e6

# Speed [rpm] at which the rated viscosity changes its law, and the constants of both [mm^2/s].
_SLOW = 1000.0
_RATED_SLOW, _RATED_FAST = 45000.0, 4500.0

# Viscosity ratios for which the life modification factor holds, and ratios at which its formula changes.
LOWEST_RATIO, _HIGHEST_RATIO = 0.1, 4.0
_CHANGES = (0.4, 1.0)

# Largest life modification factor, and largest part of contamination, fatigue limit and load in it.
_MOST_FACTOR, _MOST_LOAD_PART = 50.0, 5.0

# Exponent of the viscosity ratio over the ratio of film and roughness.
_FILM_EXPONENT = 1.3

# Part of the static rating that is the fatigue load limit, and pitch diameter [m] above which it falls.
_FATIGUE_BALL, _FATIGUE_ROLLER = 22.0, 8.2
_LARGE = 0.1

# Factor λν of the stress at the ends of rollers in the rating of a bearing: ISO/TS 16281 divides the ratings
# of the elements by it, because their loads contain that stress.
_END_STRESS, _END_STRESS_THRUST = 0.83, 0.73

# Powers of the viscosity ratio in its three ranges.
_POWERS = (0.054381, 0.19087, 0.071739)


@dataclass(frozen=True)
class _Modification:
    """Constants of the life modification factor of a kind of bearing."""

    most: float  # bracket at an unlimited viscosity ratio
    factors: tuple[float, float, float]  # of the power of the viscosity ratio in its three ranges
    bracket: float  # exponent of the bracket
    load: float  # exponent of the part with contamination, fatigue limit and load
    whole: float  # exponent of the whole
    thrust: float  # number by which the load is multiplied in a thrust bearing


_BALL = (2.5671, (2.2649, 1.9987, 1.9987), 0.83, 1.0 / 3.0, -9.3)
_ROLLER = (1.5859, (1.3993, 1.2348, 1.2348), 1.0, 0.4, -9.185)

# By kind of bearing. Constants as public texts quote them from ISO 281:2007; the standard was not read.
MODIFICATIONS = {
    "radial ball": _Modification(*_BALL, thrust=1.0),
    "radial roller": _Modification(*_ROLLER, thrust=1.0),
    "thrust ball": _Modification(*_BALL, thrust=3.0),
    "thrust roller": _Modification(*_ROLLER, thrust=2.5),
}


# Reliability and its factor a_1, table 12 of ISO 281:2007. Values up to 99 % are quoted by public programs;
# larger ones are from an unverified source. All are rounded values of a Weibull law of three parameters,
# (1 - C)(ln(1/S)/ln(1/0.9))^(2/3) + C with C = 0.05.
_RELIABILITIES = (
    *(0.90, 0.95, 0.96, 0.97, 0.98, 0.99, 0.992, 0.994, 0.996, 0.998, 0.999, 0.9992, 0.9994, 0.9995),
)
_FACTORS = (1.0, 0.64, 0.55, 0.47, 0.37, 0.25, 0.22, 0.19, 0.16, 0.12, 0.093, 0.087, 0.080, 0.077)


def reliability_factor(reliability: float) -> float:
    """Factor a_1 of ISO 281:2007 by which lives are shorter for a reliability above 90 %.

    ``reliability``, share of bearings that reach the life, from 0.9 to 0.9995. Between the values of the
    table, the logarithm of a_1 is interpolated over the logarithm of the probability of failure.

    Examples
    --------
    >>> [reliability_factor(value) for value in (0.9, 0.95, 0.99)]
    [1.0, 0.64, 0.25]
    """
    failures = [-math.log(1.0 - value) for value in _RELIABILITIES]
    factor = np.exp(np.interp(-math.log(1.0 - reliability), failures, np.log(_FACTORS)))
    # Two or three digits of each value are printed in the table.
    return float(f"{factor:.12g}")


def basic_life(rating: float, load: float, exponent: float = 3.0) -> float:
    """Basic rating life L_10 = (C/P)^p of ISO 281 [revolutions]. ``rating``, basic dynamic load rating C [N];
    ``load``, equivalent dynamic load P [N]; ``exponent`` p, 3 for balls and 10/3 for rollers.

    Examples
    --------
    >>> basic_life(29_100.0, 2_910.0)
    1000000000.0
    """
    return float(_MILLION * (rating / load) ** exponent)


def load_of_life(rating: float, life: float, exponent: float = 3.0) -> float:
    """Load [N] of which a life [revolutions] is the basic rating life, C (10^6/L)^(1/p).

    Examples
    --------
    >>> round(load_of_life(29_100.0, 1e9), 3)
    2910.0
    """
    return float(rating * (_MILLION / life) ** (1.0 / exponent))


# Radial and axial load factors X and Y of single-row ball bearings, and the ratio e of axial and radial load
# up to which only the radial load counts: over f_0 F_a/C_0 of deep-groove bearings and of contact angles of
# 15 degrees, and over the contact angle [degrees]. Tables of ISO 281:2007 as makers' catalogues print them.
_AXIAL = (0.172, 0.345, 0.689, 1.03, 1.38, 2.07, 3.45, 5.17, 6.89)
_DEEP_X, _DEEP_E = 0.56, (0.19, 0.22, 0.26, 0.28, 0.30, 0.34, 0.38, 0.42, 0.44)
_DEEP_Y = (2.30, 1.99, 1.71, 1.55, 1.45, 1.31, 1.15, 1.04, 1.00)
_AXIAL_15 = (0.178, 0.357, 0.714, 1.07, 1.43, 2.14, 3.57, 5.35, 7.14)
_X_15, _E_15 = 0.44, (0.38, 0.40, 0.43, 0.46, 0.47, 0.50, 0.55, 0.56, 0.56)
_Y_15 = (1.47, 1.40, 1.30, 1.23, 1.19, 1.12, 1.02, 1.00, 1.00)
_ANGLES = (20.0, 25.0, 30.0, 35.0, 40.0, 45.0)
_ANGLE_X, _ANGLE_E = (0.43, 0.41, 0.39, 0.37, 0.35, 0.33), (0.57, 0.68, 0.80, 0.95, 1.14, 1.34)
_ANGLE_Y = (1.00, 0.87, 0.76, 0.66, 0.57, 0.50)


def equivalent_load(radial: float, axial: float, contact_angle: float, axial_part: float) -> float:
    """Equivalent dynamic load P of a radial ball bearing with one row by ISO 281 [N]: X F_r + Y F_a where F_a
    is above e F_r, else F_r.

    ``radial`` F_r and ``axial`` F_a [N]; ``contact_angle`` [rad], 0 of deep-groove bearings; ``axial_part``,
    f_0 F_a/C_0. NaN for contact angles above 45 degrees, and between 0 and 15, which the tables do not have.
    Between 15 and 45 degrees X, Y and e are interpolated.

    Examples
    --------
    >>> equivalent_load(1000.0, 200.0, 0.0, 1.38), round(equivalent_load(1000.0, 500.0, 0.0, 1.38), 3)
    (1000.0, 1285.0)
    """
    degrees = math.degrees(contact_angle)
    if degrees > _ANGLES[-1] + 1e-6 or 1e-6 < degrees < 15.0 - 1e-6:
        return math.nan
    if degrees <= 1e-6:
        x, y, e = _DEEP_X, *(np.interp(axial_part, _AXIAL, values) for values in (_DEEP_Y, _DEEP_E))
    else:
        narrow = _X_15, *(float(np.interp(axial_part, _AXIAL_15, values)) for values in (_Y_15, _E_15))
        x, y, e = (
            np.interp(degrees, (15.0, *_ANGLES), (first, *rest))
            for first, rest in zip(narrow, (_ANGLE_X, _ANGLE_Y, _ANGLE_E), strict=True)
        )
    return float(x * radial + y * axial) if axial > e * radial else radial


# Factors of bearings with two rows that face each other: Y up to e, and X and Y above.
_PAIR_X_15, _PAIR_X = 0.72, (0.70, 0.67, 0.63, 0.60, 0.57, 0.54)
_PAIR_LOW_15 = (1.65, 1.57, 1.46, 1.38, 1.34, 1.26, 1.14, 1.12, 1.12)
_PAIR_HIGH_15 = (2.39, 2.28, 2.11, 2.00, 1.93, 1.82, 1.66, 1.63, 1.63)
_PAIR_LOW, _PAIR_HIGH = (1.09, 0.92, 0.78, 0.66, 0.55, 0.47), (1.63, 1.41, 1.24, 1.07, 0.93, 0.81)


def equivalent_load_of_pair(radial: float, axial: float, contact_angle: float, axial_part: float) -> float:
    """Equivalent dynamic load P of two rows of balls that face each other, by ISO 281 [N]: F_r + Y_1 F_a, and
    X F_r + Y_2 F_a where F_a is above e F_r.

    The arguments are the arguments of ``equivalent_load``, with the static rating of both rows in
    ``axial_part``. Makers also use it for four-point contact bearings. NaN for contact angles below 15 and
    above 45 degrees.

    Examples
    --------
    >>> equivalent_load_of_pair(1000.0, 1000.0, math.radians(40.0), 0.0)
    1550.0
    """
    degrees = math.degrees(contact_angle)
    if not 15.0 - 1e-6 <= degrees <= _ANGLES[-1] + 1e-6:
        return math.nan
    axial = abs(axial)
    low, high, e = (
        float(np.interp(degrees, (15.0, *_ANGLES), (np.interp(axial_part, _AXIAL_15, narrow), *wide)))
        for narrow, wide in (
            (_PAIR_LOW_15, _PAIR_LOW),
            (_PAIR_HIGH_15, _PAIR_HIGH),
            (_E_15, _ANGLE_E),
        )
    )
    x = float(np.interp(degrees, (15.0, *_ANGLES), (_PAIR_X_15, *_PAIR_X)))
    return x * radial + high * axial if axial > e * radial else radial + low * axial


def equivalent_load_of_rollers(
    radial: float, axial: float, contact_angle: float = 0.0, rows: int = 1
) -> float:
    """Equivalent dynamic load P of a radial roller bearing by ISO 281 [N].

    With e = 1.5 tan(a), one row has F_r up to e F_r, and 0.4 F_r + 0.4 cot(a) F_a above; two rows have
    F_r + 0.45 cot(a) F_a, and 0.67 F_r + 0.67 cot(a) F_a above.

    ``radial`` F_r and ``axial`` F_a [N]; ``contact_angle`` a [rad], 0 of cylindrical rollers, which carry
    only F_r; ``rows``, 1 or 2.

    Examples
    --------
    >>> equivalent_load_of_rollers(1000.0, 0.0)
    1000.0
    >>> round(equivalent_load_of_rollers(1000.0, 1000.0, math.radians(14.0)), 1)
    2004.3
    """
    if contact_angle == 0.0:
        return radial
    axial, cotangent = abs(axial), 1.0 / math.tan(contact_angle)
    beyond = axial * cotangent > 1.5 * radial
    if rows == 1:
        return 0.4 * (radial + cotangent * axial) if beyond else radial
    return 0.67 * (radial + cotangent * axial) if beyond else radial + 0.45 * cotangent * axial


# Factors X_0 and Y_0 of the equivalent static load of ISO 76: of deep-groove bearings, and of a row of
# angular-contact balls over the contact angle [degrees]. The JTEKT (Koyo) bearing catalogue prints the same
# values for deep-groove bearings and for 15, 30 and 40 degrees. Unverified source: Y_0 at 20, 25, 35 and 45
# degrees, and the rule of 0.22 cot(a) for rollers.
_STATIC_DEEP = 0.6, 0.5
_STATIC_ANGLES = (15.0, 20.0, 25.0, 30.0, 35.0, 40.0, 45.0)
_STATIC_Y = (0.46, 0.42, 0.38, 0.33, 0.29, 0.26, 0.22)


def static_load(radial: float, axial: float, contact_angle: float, rows: int = 1) -> float:
    """Equivalent static load P_0 of a radial ball bearing by ISO 76 [N], at least F_r.

    One row has X_0 F_r + Y_0 F_a with X_0 = 0.5 and Y_0 of its contact angle, or 0.6 F_r + 0.5 F_a of a
    deep-groove bearing; two rows that face each other have F_r + 2 Y_0 F_a.

    ``radial`` F_r and ``axial`` F_a [N]; ``contact_angle`` [rad], 0 of deep-groove bearings; ``rows``, 1 or
    2. NaN for contact angles above 45 degrees, and between 0 and 15, which the table does not have.

    Examples
    --------
    >>> static_load(1000.0, 1000.0, 0.0), static_load(1000.0, 0.0, 0.0)
    (1100.0, 1000.0)
    >>> static_load(1000.0, 4000.0, math.radians(40.0)), static_load(1000.0, 1000.0, math.radians(40.0), 2)
    (1540.0, 1520.0)
    """
    degrees, axial = math.degrees(contact_angle), abs(axial)
    if degrees <= 1e-6:
        x, y = _STATIC_DEEP
        return max(radial, x * radial + y * axial)
    if not _STATIC_ANGLES[0] - 1e-6 <= degrees <= _STATIC_ANGLES[-1] + 1e-6:
        return math.nan
    y = float(np.interp(degrees, _STATIC_ANGLES, _STATIC_Y))
    return radial + 2.0 * y * axial if rows > 1 else max(radial, 0.5 * radial + y * axial)


def static_load_of_rollers(radial: float, axial: float, contact_angle: float = 0.0, rows: int = 1) -> float:
    """Equivalent static load P_0 of a radial roller bearing by ISO 76 [N], at least F_r.

    One row has 0.5 F_r + 0.22 cot(a) F_a, and two rows that face each other F_r + 0.44 cot(a) F_a.

    ``radial`` F_r and ``axial`` F_a [N]; ``contact_angle`` a [rad], 0 of cylindrical rollers, which carry
    only F_r; ``rows``, 1 or 2.

    Examples
    --------
    >>> static_load_of_rollers(1000.0, 0.0)
    1000.0
    >>> round(static_load_of_rollers(1000.0, 1000.0, math.radians(14.0)), 1)
    1382.4
    """
    if contact_angle == 0.0:
        return radial
    part = 0.22 / math.tan(contact_angle) * abs(axial)
    return radial + 2.0 * part if rows > 1 else max(radial, 0.5 * radial + part)


def rated_viscosity(speed: float, pitch_diameter: float) -> float:
    """Kinematic viscosity nu_1 that ISO 281 asks for [m^2/s]: 45000 n^-0.83 D^-0.5 mm^2/s below 1000 rpm, and
    4500 n^-0.5 D^-0.5 above. ``speed`` n [rpm]; ``pitch_diameter`` D [m], in millimetres in the formula.

    Examples
    --------
    >>> round(1e6 * rated_viscosity(3000.0, 60e-3), 1)
    10.6
    """
    constant, power = (_RATED_SLOW, 0.83) if speed < _SLOW else (_RATED_FAST, 0.5)
    return float(1e-6 * constant * speed**-power / math.sqrt(1e3 * pitch_diameter))


def viscosity_ratio_of_film(lambda_ratio: float) -> float:
    """Viscosity ratio kappa that belongs to a ratio of film and roughness: lambda^1.3, by ISO 281.

    Examples
    --------
    >>> viscosity_ratio_of_film(1.0)
    1.0
    """
    return float(lambda_ratio**_FILM_EXPONENT)


def fatigue_load_limit(static_rating: float, pitch_diameter: float, *, rollers: bool) -> float:
    """Fatigue load limit C_u [N] by the simplified rule of ISO 281: C_0/22 of balls and C_0/8.2 of rollers.

    Above a pitch diameter D of 0.1 m it falls with (0.1 m/D)^0.5 or (0.1 m/D)^0.3. ``static_rating`` C_0
    [N]; ``pitch_diameter`` D [m].

    Examples
    --------
    >>> round(fatigue_load_limit(17_900.0, 60e-3, rollers=False))
    814
    """
    part, power = (_FATIGUE_ROLLER, 0.3) if rollers else (_FATIGUE_BALL, 0.5)
    return float(static_rating / part * min(1.0, _LARGE / pitch_diameter) ** power)


def life_factor(kind: str, viscosity_ratio: float, load_part: float) -> float:
    """Life modification factor a_ISO of ISO 281 for a reliability of 90 %, at most 50. ``kind``, a name of
    ``MODIFICATIONS``; ``viscosity_ratio`` kappa, which counts as 4 above 4; ``load_part``, e_C C_u/P with the
    contamination factor, the fatigue load limit and the load, which counts as 5 above 5. NaN for a viscosity
    ratio below 0.1, where the standard has no factor.

    Examples
    --------
    >>> round(life_factor("radial ball", 1.0, 0.1), 4)
    2.4305
    """
    if not viscosity_ratio >= LOWEST_RATIO or math.isnan(load_part):
        return math.nan
    law, ratio = MODIFICATIONS[kind], min(viscosity_ratio, _HIGHEST_RATIO)
    place = sum(ratio >= change for change in _CHANGES)
    oil = (law.most - law.factors[place] / ratio ** _POWERS[place]) ** law.bracket
    bracket = 1.0 - oil * (min(load_part, _MOST_LOAD_PART) / law.thrust) ** law.load
    if bracket <= 0.0:
        return _MOST_FACTOR
    return float(min(_MOST_FACTOR, 0.1 * bracket**law.whole))


@dataclass(frozen=True)
class ElementRatings:
    """Dynamic load ratings of one rolling element with each ring [N], of shape (...)."""

    inner: Numbers
    outer: Numbers


def ball_ratings(
    rating: Numbers,
    elements: int,
    ratio: Numbers,
    grooves: tuple[Numbers, Numbers],
    contact_angle: Numbers = 0.0,
) -> ElementRatings:
    """Ratings of a ball with both rings, Q_ci and Q_ce of ISO/TS 16281, from the rating of the bearing.

    Q_ci = C/(0.407 Z cos(a)^0.7) (1 + c^(10/3))^0.3 and Q_ce = C/(0.389 Z cos(a)^0.7) (1 + c^(-10/3))^0.3
    with c = 1.044 ((1 - g)/(1 + g))^1.72 (f_i/f_e (2 f_e - 1)/(2 f_i - 1))^0.41. ``rating`` C of one row [N];
    ``elements`` Z; ``ratio`` g of ball diameter times cos(a) and pitch diameter; ``grooves``, radii f_i and
    f_e over the ball diameter; ``contact_angle`` a [rad].

    Examples
    --------
    A small ball on a wide track: g = 0 and c = 1.044.

    >>> found = ball_ratings(9_000.0, 9, 0.0, (0.52, 0.52))
    >>> round(found.inner, 1), round(found.outer, 1)
    (3093.1, 3099.9)
    """
    inner, outer = grooves
    shape = inner / outer * (2.0 * outer - 1.0) / (2.0 * inner - 1.0)
    c = 1.044 * ((1.0 - ratio) / (1.0 + ratio)) ** 1.72 * shape**0.41
    each = rating / elements / np.cos(contact_angle) ** 0.7
    return ElementRatings(
        inner=as_float(each / 0.407 * (1.0 + c ** (10.0 / 3.0)) ** 0.3),
        outer=as_float(each / 0.389 * (1.0 + c ** (-10.0 / 3.0)) ** 0.3),
    )


def roller_ratings(
    rating: Numbers, elements: int, ratio: Numbers, contact_angle: Numbers = 0.0
) -> ElementRatings:
    """Ratings of a roller with both rings by ISO/TS 16281, from the rating of the bearing, without slices.

    Q_ci = C/(λν 0.378 Z cos(a)^(7/9)) (1 + c^(9/2))^(2/9) and Q_ce = C/(λν 0.364 Z cos(a)^(7/9))
    (1 + c^(-9/2))^(2/9) with c = 1.038 ((1 - g)/(1 + g))^(143/108) and λν = 0.83. ``rating`` C of one row
    [N]; ``elements`` Z; ``ratio`` g of roller diameter times cos(a) and pitch diameter; ``contact_angle`` a
    [rad]. A load that is even along the roller has the same life with n slices of a rating Q_c n^(-7/9).

    Examples
    --------
    >>> found = roller_ratings(0.83 * 14_000.0, 14, 0.0)
    >>> round(found.inner), round(found.outer)
    (3147, 3148)
    """
    c = 1.038 * ((1.0 - ratio) / (1.0 + ratio)) ** (143.0 / 108.0)
    each = rating / _END_STRESS / elements / np.cos(contact_angle) ** (7.0 / 9.0)
    return ElementRatings(
        inner=each / 0.378 * (1.0 + c**4.5) ** (2.0 / 9.0),
        outer=each / 0.364 * (1.0 + c**-4.5) ** (2.0 / 9.0),
    )


def thrust_ratings(rating: Numbers, elements: int, *, rollers: bool) -> ElementRatings:
    """Ratings of an element with both washers by ISO/TS 16281, at a contact angle of 90 degrees, where both
    raceways are alike: 2^(3/10) C_a/Z of balls and 2^(2/9) C_a/(0.73 Z) of rollers. ``rating`` C_a [N].

    Examples
    --------
    >>> round(thrust_ratings(16_000.0, 16, rollers=False).inner, 1)
    1231.1
    """
    each = rating / elements * (2.0 ** (2.0 / 9.0) / _END_STRESS_THRUST if rollers else 2.0**0.3)
    return ElementRatings(each, each)


def reference_life(
    loads: tuple[ArrayLike, ArrayLike], ratings: ElementRatings, *, rollers: bool = False, rows: int = 1
) -> Numbers:
    """Basic reference rating life L_10r of ISO/TS 16281 [revolutions], shape (...); infinite without load.

    The inner ring turns under a load that stands still. ``loads``, of all n elements with the inner and the
    outer ring [N], shape (..., n) each, zeros included, all ``rows`` one after the other;
    ``ratings`` are the ratings of one row, of shape (...).

    Balls: ((Q_ci/Q_ei)^(-10/3) + (Q_ce/Q_ee)^(-10/3))^(-9/10) with the mean of power 3 of the loads with the
    turning ring and of power 10/3 of the loads with the standing ring. Rollers: powers 9/2, 8/9, 4 and 9/2,
    so that their life falls with the power 4 of the load, instead of the power 10/3 of the basic life.

    Examples
    --------
    Nine balls that share the load evenly, as under a central axial load.

    >>> life = reference_life(([970.0] * 9, [970.0] * 9), ElementRatings(9_700.0, 9_700.0))
    >>> round(life / 1e6, 1)
    535.9
    """
    turning, standing, slope = (4.0, 4.5, 4.5) if rollers else (3.0, 10.0 / 3.0, 10.0 / 3.0)
    inner, outer = _power_mean(loads[0], turning, rows), _power_mean(loads[1], standing, rows)
    spent = sum(
        (mean / np.asarray(rating)[..., np.newaxis]) ** slope
        for mean, rating in ((inner, ratings.inner), (outer, ratings.outer))
    )
    with np.errstate(divide="ignore"):
        return as_float(_MILLION * np.sum(spent, axis=-1) ** (-8.0 / 9.0 if rollers else -9.0 / 10.0))


def _power_mean(loads: ArrayLike, power: float, rows: int) -> Array:
    """Return the power mean of the element loads in each row, shape (..., rows) [N]."""
    values = np.asarray(loads, dtype=float)
    each = values.reshape(*values.shape[:-1], rows, -1)
    mean: Array = np.mean(each**power, axis=-1) ** (1.0 / power)
    return mean
