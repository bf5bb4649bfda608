"""Geometry of a pair of cylindrical involute gears, by ISO 21771-1. SI units, angles in radians.

Index 1 is the pinion and 2 the wheel; t is the transverse plane, n the plane normal to the teeth, w the
working circle and b the base circle. The wheel of an internal pair is a ring: its number of teeth, its
diameters and the centre distance are negative, so that all equations have one form.

    m_t = m_n/cos beta            tan alpha_t = tan alpha_n/cos beta        d = z m_t      d_b = d cos alpha_t
    tan beta_b = tan beta cos alpha_t                 cos alpha_wt = (d_1 + d_2) cos alpha_t/(2 a)
    inv alpha_wt = inv alpha_t + 2 (x_1 + x_2) tan alpha_n/(z_1 + z_2)           inv alpha = tan alpha - alpha

The last equation holds without backlash. Backlash of profile shifts whose sum is smaller than that sum S is
j_n = 2 (S - x_1 - x_2) m_n sin alpha_n along the line of action.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

from ehlectric.errors import InputError, shown

# Steps of Newton's method for the inverse of the involute function, which doubles its digits in each.
_STEPS = 50

# Rounding of the sum of two profile shifts that a drawing states with three digits: within it a centre
# distance and both shifts neither contradict each other nor give the backlash.
_ROUNDING = 1e-3

# Profile shift coefficients between which those that follow from a centre distance must be.
_LEAST_SHIFT, _MOST_SHIFT = -2.0, 3.0


def involute(angle: float) -> float:
    """Involute of a pressure angle [rad], inv alpha = tan alpha - alpha.

    Examples
    --------
    The table of DIN 3960 prints 0.014904 for 20 degrees:

    >>> round(involute(math.radians(20.0)), 6)
    0.014904
    """
    if abs(angle) < 1e-2:
        # Series, where the difference of both terms would lose its digits.
        square = angle * angle
        return angle * square * (1.0 / 3.0 + square * (2.0 / 15.0 + square * (17.0 / 315.0)))
    return math.tan(angle) - angle


def pressure_angle(value: float) -> float:
    """Pressure angle [rad] of an involute of at least 0, the inverse of ``involute``.

    Examples
    --------
    >>> round(math.degrees(pressure_angle(involute(math.radians(25.0)))), 12)
    25.0
    """
    if value <= 0.0:
        return 0.0
    # Beyond 1.8 the tangent is large, and the angle near a right angle.
    angle = (3.0 * value) ** (1.0 / 3.0) if value < 1.8 else math.atan(value + 0.5 * math.pi)
    angle = min(angle, math.atan(value + 0.5 * math.pi))
    for _ in range(_STEPS):
        step = (involute(angle) - value) / math.tan(angle) ** 2
        angle -= step
        if abs(step) <= 1e-15 * angle:
            break
    return angle


@dataclass(frozen=True)
class Drawing:
    """Numbers on the drawing of a gear pair; lengths in metres, angles in radians.

    ``teeth``, ``profile_shift`` (x, dimensionless) and ``tip_diameter`` are pairs for gear 1 and gear 2. The
    teeth of a ring are negative; its tip diameter and the centre distance are positive here, as on drawings.
    ``None`` stands for a number that follows from the others.
    """

    normal_module: float
    teeth: tuple[int, int]
    normal_pressure_angle: float
    helix_angle: float
    face_width: float
    centre_distance: float | None = None
    profile_shift: tuple[float | None, float | None] = (None, None)
    tip_diameter: tuple[float | None, float | None] = (None, None)
    normal_backlash: float | None = None


@dataclass(frozen=True)
class GearPair:
    """Geometry of a gear pair that can run; the negative sign of a ring is described at the head of the
    module.
    """

    normal_module: float
    teeth: tuple[int, int]
    normal_pressure_angle: float
    helix_angle: float
    face_width: float
    centre_distance: float  # a, negative for an internal pair
    profile_shift: tuple[float, float]
    tip_diameter: tuple[float, float]  # d_a, negative for a ring
    normal_backlash: float | None  # j_n along the line of action [m]; None if it is not known

    @property
    def internal(self) -> bool:
        """Whether gear 2 is a ring."""
        return self.teeth[1] < 0

    @property
    def ratio(self) -> float:
        """Ratio u = z2/z1 of the numbers of teeth, negative for an internal pair."""
        return self.teeth[1] / self.teeth[0]

    @cached_property
    def transverse_module(self) -> float:
        """Transverse module m_t [m]."""
        return self.normal_module / math.cos(self.helix_angle)

    @cached_property
    def transverse_pressure_angle(self) -> float:
        """Pressure angle alpha_t of the transverse plane [rad]."""
        return math.atan(math.tan(self.normal_pressure_angle) / math.cos(self.helix_angle))

    @cached_property
    def base_helix_angle(self) -> float:
        """Helix angle beta_b of the base cylinder [rad]."""
        return math.atan(math.tan(self.helix_angle) * math.cos(self.transverse_pressure_angle))

    @cached_property
    def reference_diameter(self) -> tuple[float, float]:
        """Reference diameters d [m]."""
        first, second = self.teeth
        return first * self.transverse_module, second * self.transverse_module

    @property
    def usual_tips(self) -> tuple[float, float]:
        """Tip diameters d + 2 m_n (1 + x) of a full addendum, negative for a ring [m]."""
        return usual_tips(self, self.profile_shift)

    @cached_property
    def base_diameter(self) -> tuple[float, float]:
        """Base diameters d_b [m]."""
        first, second = self.reference_diameter
        cosine = math.cos(self.transverse_pressure_angle)
        return first * cosine, second * cosine

    @cached_property
    def working_pressure_angle(self) -> float:
        """Working pressure angle alpha_wt [rad]."""
        return math.acos(sum(self.base_diameter) / (2.0 * self.centre_distance))

    @cached_property
    def form_curvature(self) -> tuple[float, float]:
        """Transverse radii of curvature at which the involutes begin above the fillets of both gears [m].

        Of external gears by a rack whose flanks are straight to m_n beyond its datum line, as of ISO 53:
        d sin alpha_t/2 - (1 - x) m_n/sin alpha_t. The fillet of a ring, minus infinity, is not known.
        """
        sine = math.sin(self.transverse_pressure_angle)
        first, second = (
            0.5 * diameter * sine - (1.0 - shift) * self.normal_module / sine
            for diameter, shift in zip(self.reference_diameter, self.profile_shift, strict=True)
        )
        return first, -math.inf if self.internal else second

    @cached_property
    def working_diameter(self) -> tuple[float, float]:
        """Diameters d_w of the working circles, which touch at the pitch point [m]."""
        first = 2.0 * self.centre_distance / (self.ratio + 1.0)
        return first, first * self.ratio

    @property
    def transverse_base_pitch(self) -> float:
        """Distance p_bt of two flanks along the path of contact [m]."""
        return math.pi * self.transverse_module * math.cos(self.transverse_pressure_angle)

    @property
    def axial_pitch(self) -> float:
        """Distance of two teeth along the axis, pi m_n/sin beta [m]; infinite for spur gears."""
        sine = math.sin(self.helix_angle)
        return math.pi * self.normal_module / sine if sine else math.inf

    @property
    def recommended_backlash(self) -> float:
        """Least normal backlash that ISO/TR 10064-2 recommends for steel gears [m], in mm
        2/3 (0.06 + 0.0005 a + 0.03 m_n): an unverified source.
        """
        return 2.0 / 3.0 * (0.06e-3 + 0.0005 * abs(self.centre_distance) + 0.03 * self.normal_module)

    @property
    def overlap_ratio(self) -> float:
        """Overlap ratio eps_beta = b sin beta/(pi m_n), dimensionless; 0 for spur gears."""
        return self.face_width / self.axial_pitch

    @property
    def tip_thickness(self) -> tuple[float, float]:
        """Transverse thickness of the teeth at their tips [m], with all backlash taken from neither."""
        first, second = (_tip_thickness(self, index) for index in (0, 1))
        return first, second


def _tip_thickness(pair: GearPair, index: int) -> float:
    """Transverse thickness of the teeth of one gear at its tip circle [m]; negative for pointed teeth.

    s_a = d_a (s/d + inv alpha_t - inv alpha_a), s = m_t (pi/2 + 2 x tan alpha_n), cos alpha_a = d_b/d_a.
    """
    thickness = 0.5 * math.pi + 2.0 * pair.profile_shift[index] * math.tan(pair.normal_pressure_angle)
    tip = math.acos(pair.base_diameter[index] / pair.tip_diameter[index])
    half_angles = thickness / pair.teeth[index] + involute(pair.transverse_pressure_angle) - involute(tip)
    return pair.tip_diameter[index] * half_angles


def gear_pair(drawing: Drawing) -> GearPair:
    """Geometry of a drawing, with the numbers that follow from others.

    Without profile shifts and centre distance both shifts are 0. With a centre distance and one shift, the
    other shift follows without backlash. With a centre distance and both shifts, backlash follows. A tip
    diameter that is not given is d + 2 m_n (1 + x).

    Raises
    ------
    InputError
        If numbers contradict each other, or the teeth cannot run: no pair of teeth in contact at times
        (contact ratio below 1), pointed teeth, contact below the base circle, or negative backlash.

    Examples
    --------
    The gears type C of the FZG test rig:

    >>> pair = gear_pair(Drawing(4.5e-3, (16, 24), math.radians(20.0), 0.0, 14e-3, 91.5e-3, (0.1817, 0.1715),
    ...     (82.46e-3, 118.36e-3)))
    >>> round(math.degrees(pair.working_pressure_angle), 4), round(1e3 * pair.working_diameter[0], 4)
    (22.4388, 73.2)
    """
    _check_teeth(drawing)
    distance, shifts, backlash = _distance_and_shifts(drawing)
    plain = GearPair(
        normal_module=drawing.normal_module,
        teeth=drawing.teeth,
        normal_pressure_angle=drawing.normal_pressure_angle,
        helix_angle=drawing.helix_angle,
        face_width=drawing.face_width,
        centre_distance=distance,
        profile_shift=shifts,
        tip_diameter=_tips(drawing, shifts),
        normal_backlash=backlash,
    )
    _check_tips(plain)
    return plain


def _check_teeth(drawing: Drawing) -> None:
    first, second = drawing.teeth
    if second < 0 and -second <= first:
        raise InputError(
            "gear.teeth", got=f"{first} and {second}", takes="a ring with more teeth than the gear in it"
        )


def _sign(drawing: Drawing) -> float:
    return -1.0 if drawing.teeth[1] < 0 else 1.0


def _distance_and_shifts(drawing: Drawing) -> tuple[float, tuple[float, float], float | None]:
    """Centre distance with its sign [m], both profile shifts, and the backlash [m]."""
    first, second = drawing.profile_shift
    if drawing.centre_distance is None:
        if (first is None) != (second is None):
            raise InputError(
                "gear.profile_shift",
                "is given for one gear;",
                takes="both profile shifts, or the centre distance",
            )
        shifts = (first or 0.0, second or 0.0)
        return _distance_of(drawing, sum(shifts)), shifts, drawing.normal_backlash
    distance = _sign(drawing) * drawing.centre_distance
    total = _sum_without_backlash(drawing, distance)
    if first is None and second is None:
        raise InputError(
            "gear.profile_shift",
            "missing;",
            takes=f"the profile shift of one gear: the sum of both is {total:.4f} at this centre distance",
        )
    if first is None or second is None:
        known = second if first is None else first
        assert known is not None
        shifts = (total - known, known) if first is None else (known, total - known)
        if not _LEAST_SHIFT <= total - known <= _MOST_SHIFT:
            raise InputError(
                "gear.centre_distance",
                got=f"{1e3 * abs(distance):g} mm, for a profile shift coefficient of {total - known:.4g}",
                takes=f"a distance at which both coefficients are from {_LEAST_SHIFT:g} to {_MOST_SHIFT:g}",
            )
        return distance, shifts, drawing.normal_backlash
    return distance, (first, second), _backlash(drawing, total, first + second)


def _transverse(drawing: Drawing) -> tuple[float, float]:
    """Sum of both reference diameters with its sign [m], and the transverse pressure angle [rad]."""
    cosine = math.cos(drawing.helix_angle)
    alpha = math.atan(math.tan(drawing.normal_pressure_angle) / cosine)
    return sum(drawing.teeth) * drawing.normal_module / cosine, alpha


def _distance_of(drawing: Drawing, total_shift: float) -> float:
    """Centre distance without backlash of the sum of both profile shifts [m]."""
    diameters, alpha = _transverse(drawing)
    slope = 2.0 * math.tan(drawing.normal_pressure_angle) / sum(drawing.teeth)
    value = involute(alpha) + slope * total_shift
    if value <= 0.0:
        ring = sum(drawing.teeth) < 0
        size = "a smaller" if ring else "a larger"
        sign = "; the shift of a ring is positive towards the axis" if ring else ""
        raise InputError(
            "gear.profile_shift",
            got=shown(total_shift) + " as sum",
            takes=f"{size} sum of both: the working pressure angle would be 0{sign}",
        )
    return diameters * math.cos(alpha) / (2.0 * math.cos(pressure_angle(value)))


def _sum_without_backlash(drawing: Drawing, distance: float) -> float:
    """Sum of both profile shifts that a centre distance [m] needs without backlash."""
    diameters, alpha = _transverse(drawing)
    cosine = diameters * math.cos(alpha) / (2.0 * distance)
    if cosine >= 1.0:
        least = 0.5 * abs(diameters) * math.cos(alpha)
        raise InputError(
            "gear.centre_distance",
            got=f"{1e3 * abs(distance):g} mm",
            takes=f"more than {1e3 * least:.4f} mm, where the base circles would touch",
        )
    working = involute(math.acos(cosine))
    return (working - involute(alpha)) * sum(drawing.teeth) / (2.0 * math.tan(drawing.normal_pressure_angle))


def _backlash(drawing: Drawing, without: float, total: float) -> float | None:
    """Normal backlash of both profile shifts, or the one that is given [m]; None if neither is known."""
    unit = 2.0 * drawing.normal_module * math.sin(drawing.normal_pressure_angle)
    given, free = drawing.normal_backlash, without - total
    if free < -_ROUNDING:
        raise InputError(
            "gear.profile_shift",
            got=f"a sum of {total:.4f}",
            takes=f"at most {without:.4f} at this centre distance: the teeth would overlap by "
            f"{-1e6 * free * unit:.1f} µm",
        )
    if free <= _ROUNDING:
        return given
    if given is not None and given < (free - _ROUNDING) * unit:
        raise InputError(
            "gear.normal_backlash",
            got=f"{1e6 * given:.1f} µm",
            takes=f"at least the {1e6 * free * unit:.1f} µm of centre distance and profile shifts",
        )
    return free * unit if given is None else given


def usual_tips(drawing: Drawing | GearPair, shifts: tuple[float, float]) -> tuple[float, float]:
    """Tip diameters d + 2 m_n (1 + x) of a full addendum, negative for a ring [m]."""
    module = drawing.normal_module
    transverse = module / math.cos(drawing.helix_angle)
    first, second = (
        teeth * transverse + 2.0 * module * (1.0 + shift)
        for teeth, shift in zip(drawing.teeth, shifts, strict=True)
    )
    return first, second


def _tips(drawing: Drawing, shifts: tuple[float, float]) -> tuple[float, float]:
    """Tip diameters with the sign of their gears [m]."""
    first, second = (
        usual if given is None else math.copysign(given, usual)
        for usual, given in zip(usual_tips(drawing, shifts), drawing.tip_diameter, strict=True)
    )
    return first, second


def _check_tips(pair: GearPair) -> None:
    """Refuse tips at which the teeth cannot run."""
    for index in (0, 1):
        tip, base, usual = pair.tip_diameter[index], pair.base_diameter[index], pair.usual_tips[index]
        if abs(tip) <= abs(base):
            raise InputError(
                f"gear.tip_diameter.{index + 1}",
                got=f"{1e3 * abs(tip):g} mm",
                takes=f"more than the base circle, {1e3 * abs(base):.4f} mm; a full addendum has a tip "
                f"diameter of {1e3 * abs(usual):.5g} mm with {abs(pair.teeth[index])} teeth and a module of "
                f"{1e3 * pair.normal_module:g} mm",
            )
    for index in (0, 1):
        tip, key = pair.tip_diameter[index], f"gear.tip_diameter.{index + 1}"
        thickness = pair.tip_thickness[index]
        if thickness < 0.0:
            raise InputError(
                key,
                got=f"{1e3 * abs(tip):g} mm with pointed teeth",
                takes=f"a {'larger' if tip < 0.0 else 'smaller'} tip circle, or a smaller profile shift",
            )
