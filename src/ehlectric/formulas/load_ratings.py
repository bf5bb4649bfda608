"""Basic load ratings of bearings, static by ISO 76 and dynamic by ISO 281. SI units.

The ratings are of one row of elements. Both standards are written in millimetres and newtons; so are the
factors f_0 and f_c here, and with them the formulas, with D in millimetres.
"""

from __future__ import annotations

import math

from ehlectric.formulas.hertz import point_load

_MILLIMETRES = 1e3

# ISO 76 limits the Hertz pressure of the most loaded ball [MPa]. Its ball carries 5 times the mean load.
_STATIC_PRESSURE = 4200.0
_MOST_LOADED = 5.0

# Radii of the inner and the outer groove over the ball diameter, of which both standards have their ratings:
# at most these.
RATED_GROOVES = 0.52, 0.53

# Young's modulus 207 GPa and Poisson's ratio 0.3 of both bodies [MPa].
_MODULUS = 2.07e5 / (1.0 - 0.3**2)

# Grooves of both rings in the table of f_c, and the constant of its formula: 0.41 of 98.0665 N, by 0.95.
_DYNAMIC_GROOVE = 0.52
_BALLS = 0.95 * 0.41 * 98.0665

# Constant of f_c of cylindrical rollers: 207.9 by 0.83.
_ROLLERS = 0.83 * 207.9

# Radius of a groove of a thrust ball bearing over the ball diameter for which ISO 76 has its rating, and that
# for which ISO 281 has it.
THRUST_GROOVE, _THRUST_DYNAMIC_GROOVE = 0.54, 0.535

# Constants of f_c at a contact angle of 90 degrees: both raceways are alike, and 0.6 and 0.6205 are the
# reductions of Lundberg and Palmgren for balls (0.9 by 2/3) and for rollers (0.73 by 0.85).
_THRUST_BALLS = 0.6 * 98.0665 * 2.0**-0.3
_THRUST_ROLLERS = 0.6205 * 551.13 * 2.0 ** (-2.0 / 9.0)

# Rating factors b_m of present steel: of balls and of rollers in machined rings, and of needles in drawn cups
# and of thrust rollers.
_BALL_STEEL, _ROLLER_STEEL, _NEEDLE_STEEL = 1.3, 1.1, 1.0

# Ball diameter [mm] above which the power of the diameter falls from 1.8 to 1.4.
_LARGE_BALL = 25.4


def static_factor(ratio: float) -> float:
    """Factor f_0 of the static rating of a radial ball bearing.

    A ball of one millimetre loads both grooves to 4200 MPa, with radii of 0.52 D on the inner and 0.53 D on
    the outer ring. f_0 is a fifth of the smaller of both loads.

    Returns f_0 [N/mm^2], between 7 and 17.

    The numbers follow from Hertz' formulas. They reproduce the 41 values from 0 to 0.4 of the table of ISO 76
    to 0.06, the table as read in a public JavaScript program for bearings, function
    ``sfereRadiali``; its value at 0.06, 15.7 between 15.7 and 16.1, is omitted.

    Examples
    --------
    >>> round(static_factor(0.2), 1)
    14.0
    """
    loads = []
    for side, groove in zip((1.0, -1.0), RATED_GROOVES, strict=True):
        along = 2.0 + side * 2.0 * ratio / (1.0 - side * ratio)
        across = 2.0 - 1.0 / groove
        loads.append(point_load(_STATIC_PRESSURE, 1.0 / along, 1.0 / across, _MODULUS))
    return min(loads) / _MOST_LOADED


def dynamic_factor(ratio: float) -> float:
    """Factor f_c of the dynamic rating of a radial ball bearing, without the factor b_m.

    f_c = K (1 + b^(10/3))^(-3/10) g^0.3 (1 - g)^1.39/(1 + g)^(1/3) (2 f/(2 f - 1))^0.41 with g the ratio,
    b = 1.04 ((1 - g)/(1 + g))^1.72 and f = 0.52 of both grooves.

    Returns f_c [N/mm^1.8].

    Formula of Lundberg and Palmgren, as two public programs quote it, with K = 37.91. The K here, 38.2, is
    0.95 of 0.41 of 98.0665 N: with it, the 40 values from 0.01 to 0.4 of the table of ISO 281 come out to
    0.15 %, the table as read in the program that `static_factor` names.

    Examples
    --------
    >>> round(dynamic_factor(0.2), 1)
    59.9
    """
    inner = 1.04 * ((1.0 - ratio) / (1.0 + ratio)) ** 1.72
    both = (1.0 + inner ** (10.0 / 3.0)) ** -0.3
    shape = (2.0 * _DYNAMIC_GROOVE / (2.0 * _DYNAMIC_GROOVE - 1.0)) ** 0.41
    return float(_BALLS * both * shape * ratio**0.3 * (1.0 - ratio) ** 1.39 / (1.0 + ratio) ** (1.0 / 3.0))


def roller_dynamic_factor(ratio: float) -> float:
    """Factor f_c of the dynamic rating of a radial roller bearing, without the factor b_m.

    f_c = K (1 + b^(9/2))^(-2/9) g^(2/9) (1 - g)^(29/27)/(1 + g)^(1/4) with K = 207.9 by 0.83, g the ratio and
    b = 1.04 ((1 - g)/(1 + g))^(143/108).

    Returns f_c [N/mm^(50/27)].

    Formula of Lundberg and Palmgren, as quoted with 207 and 208 by two public programs.

    Examples
    --------
    >>> round(roller_dynamic_factor(0.2), 1)
    88.7
    """
    inner = 1.04 * ((1.0 - ratio) / (1.0 + ratio)) ** (143.0 / 108.0)
    both = (1.0 + inner**4.5) ** (-2.0 / 9.0)
    return float(
        _ROLLERS * both * ratio ** (2.0 / 9.0) * (1.0 - ratio) ** (29.0 / 27.0) / (1.0 + ratio) ** 0.25
    )


def _ball_size(diameter: float) -> float:
    """Factor of the dynamic rating by the ball diameter D [mm]: D^1.8, and 3.647 D^1.4 above 25.4 mm."""
    return float(diameter**1.8 if diameter <= _LARGE_BALL else 3.647 * diameter**1.4)


def ball_static_rating(
    elements: int, ball_diameter: float, pitch_diameter: float, contact_angle: float = 0.0
) -> float:
    """Basic static radial load rating of a ball bearing, C_0r = f_0 Z D^2 cos(a) of ISO 76. ``ball_diameter``
    and ``pitch_diameter``, ball diameter D and pitch diameter d_m [m]; ``contact_angle`` [rad]. Returns C_0r
    [N].

    Examples
    --------
    The 6208, with nine balls of 11.906 mm; NSK prints 17 900 N.

    >>> round(ball_static_rating(9, 11.906e-3, 60e-3), -2)
    17900.0
    """
    cosine = math.cos(contact_angle)
    diameter = _MILLIMETRES * ball_diameter
    return static_factor(ball_diameter * cosine / pitch_diameter) * elements * diameter**2 * cosine


def ball_dynamic_rating(
    elements: int, ball_diameter: float, pitch_diameter: float, contact_angle: float = 0.0
) -> float:
    """Basic dynamic radial load rating of a ball bearing by ISO 281.

    C_r = b_m f_c cos(a)^0.7 Z^(2/3) D^1.8 with b_m = 1.3, and 3.647 D^1.4 instead of D^1.8 above 25.4 mm.

    ``ball_diameter`` and ``pitch_diameter``, ball diameter D and pitch diameter d_m [m]; ``contact_angle``
    [rad]. Returns C_r [N].

    Examples
    --------
    The 6208, with nine balls of 11.906 mm; NSK prints 29 100 N.

    >>> round(ball_dynamic_rating(9, 11.906e-3, 60e-3), -2)
    29100.0
    """
    cosine = math.cos(contact_angle)
    diameter = _MILLIMETRES * ball_diameter
    factor = dynamic_factor(ball_diameter * cosine / pitch_diameter)
    return float(_BALL_STEEL * factor * cosine**0.7 * elements ** (2.0 / 3.0) * _ball_size(diameter))


def roller_static_rating(
    elements: int, roller_diameter: float, pitch_diameter: float, length: float, contact_angle: float = 0.0
) -> float:
    """Basic static radial load rating of a roller bearing by ISO 76.

    C_0r = 44 (1 - D cos(a)/d_m) Z L D cos(a), of cylindrical, needle and tapered rollers.

    ``roller_diameter``, ``pitch_diameter`` and ``length``, roller diameter D, of tapered rollers in their
    middle, pitch diameter d_m, and effective length L of a roller [m]; ``contact_angle`` a [rad]. Returns
    C_0r [N].

    Examples
    --------
    The NU 205, with thirteen rollers of 7.5 mm; NSK prints 27 700 N.

    >>> round(roller_static_rating(13, 7.5e-3, 39e-3, 8e-3), -2)
    27700.0
    """
    cosine = math.cos(contact_angle)
    area = length * roller_diameter * _MILLIMETRES**2
    return 44.0 * (1.0 - roller_diameter * cosine / pitch_diameter) * elements * area * cosine


def roller_dynamic_rating(
    elements: int, roller_diameter: float, pitch_diameter: float, length: float, contact_angle: float = 0.0
) -> float:
    """Basic dynamic radial load rating of a roller bearing in machined rings by ISO 281.

    C_r = b_m f_c (L cos(a))^(7/9) Z^(3/4) D^(29/27) with b_m = 1.1. Needles in drawn cups have b_m = 1.

    ``roller_diameter``, ``pitch_diameter`` and ``length``, roller diameter D, of tapered rollers in their
    middle, pitch diameter d_m, and effective length L of a roller [m]; ``contact_angle`` a [rad]. Returns C_r
    [N].

    Examples
    --------
    The NU 205, with thirteen rollers of 7.5 mm; NSK prints 29 300 N.

    >>> round(roller_dynamic_rating(13, 7.5e-3, 39e-3, 8e-3), -2)
    29300.0
    """
    cosine = math.cos(contact_angle)
    factor = roller_dynamic_factor(roller_diameter * cosine / pitch_diameter)
    size = (_MILLIMETRES * length * cosine) ** (7.0 / 9.0) * (_MILLIMETRES * roller_diameter) ** (29.0 / 27.0)
    return float(_ROLLER_STEEL * factor * elements**0.75 * size)


def thrust_ball_static_rating(elements: int, ball_diameter: float) -> float:
    """Basic static axial load rating of a thrust ball bearing, C_0a = f_0 Z D^2 of ISO 76.

    f_0 is the load that presses a ball of one millimetre to 4200 MPa into a groove of 0.54 of its diameter;
    all balls carry an equal load. It is 61.6, also in the table of ISO 76.

    ``ball_diameter`` D [m]. Returns C_0a [N].

    Examples
    --------
    The 51208, with fifteen balls of 13/32 in; NSK prints 98 500 N.

    >>> round(thrust_ball_static_rating(15, 10.319e-3), -2)
    98300.0
    """
    across = 2.0 - 1.0 / THRUST_GROOVE
    factor = point_load(_STATIC_PRESSURE, 0.5, 1.0 / across, _MODULUS)
    return float(factor * elements * (_MILLIMETRES * ball_diameter) ** 2)


def thrust_ball_dynamic_rating(elements: int, ball_diameter: float, pitch_diameter: float) -> float:
    """Basic dynamic axial load rating of a thrust ball bearing by ISO 281.

    C_a = b_m f_c Z^(2/3) D^1.8 with b_m = 1.3, f_c = K (2 f/(2 f - 1))^0.41 (D/d_m)^0.3, f = 0.535 and
    K = 47.79; 3.647 D^1.4 replaces D^1.8 above 25.4 mm.

    ``ball_diameter`` and ``pitch_diameter``, ball diameter D and pitch diameter d_m [m]. Returns C_a [N].

    Examples
    --------
    The 51208, with fifteen balls of 13/32 in; NSK prints 47 500 N.

    >>> round(thrust_ball_dynamic_rating(15, 10.319e-3, 54e-3), -2)
    47000.0
    """
    diameter, groove = _MILLIMETRES * ball_diameter, _THRUST_DYNAMIC_GROOVE
    shape = (2.0 * groove / (2.0 * groove - 1.0)) ** 0.41
    factor = _THRUST_BALLS * shape * (ball_diameter / pitch_diameter) ** 0.3
    return float(_BALL_STEEL * factor * elements ** (2.0 / 3.0) * _ball_size(diameter))


def thrust_roller_static_rating(elements: int, roller_diameter: float, length: float) -> float:
    """Basic static axial load rating of a thrust bearing with cylindrical or needle rollers.

    C_0a = 220 Z L D of ISO 76. ``roller_diameter`` D and effective ``length`` L of a roller [m]. Returns C_0a
    [N].
    """
    return 220.0 * elements * length * roller_diameter * _MILLIMETRES**2


def thrust_roller_dynamic_rating(
    elements: int, roller_diameter: float, pitch_diameter: float, length: float
) -> float:
    """Basic dynamic axial load rating of a thrust bearing with cylindrical or needle rollers by ISO 281.

    C_a = b_m f_c L^(7/9) Z^(3/4) D^(29/27) with b_m = 1 and f_c = 293.2 (D/d_m)^(2/9).

    ``roller_diameter``, ``pitch_diameter`` and ``length``, roller diameter D, pitch diameter d_m and
    effective length L of a roller [m]. Returns C_a [N].
    """
    factor = _THRUST_ROLLERS * (roller_diameter / pitch_diameter) ** (2.0 / 9.0)
    size = (_MILLIMETRES * length) ** (7.0 / 9.0) * (_MILLIMETRES * roller_diameter) ** (29.0 / 27.0)
    return float(_NEEDLE_STEEL * factor * elements**0.75 * size)
