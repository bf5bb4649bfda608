"""Geometry of ball and roller bearings, radii of their contacts, speeds and inertial forces; SI units.

A groove is a circular arc with a radius somewhat larger than the radius of the ball. The centre of the inner
groove lies radially outside the ball's centre, and the centre of the outer groove radially inside. The
contacts follow from the positions of these three centres. Angles are measured from the radial plane, and are
positive where the inner ring is pushed towards positive axial positions. Raceways of roller bearings are
cylinders.

The elements roll without sliding on both rings, and the cage turns with them. Both rings may turn; all speeds
are positive in the same sense of rotation. The formulas have one contact angle for both contacts of an
element. For a ball at speed, whose contact angles differ, it is their mean.

All dimensions, angles and speeds are floats, or arrays over points of operation that broadcast, shape (...).
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from ehlectric.arrays import Array, Booleans, Numbers, as_float
from ehlectric.errors import InputError, shown
from ehlectric.formulas.hertz import reduced_radius

PROFILES = ("none", "logarithmic")

# Largest ratio of length to diameter of rollers with the first profile of ISO/TS 16281.
_SHORT = 2.5


@dataclass(frozen=True, kw_only=True)
class ContactRadii:
    """Radii of a rolling element and a ring at their contact, positive if convex, infinite if straight."""

    # element_x and element_y: radii of the rolling element, in the rolling direction and across it [m].
    element_x: Numbers
    element_y: Numbers
    # ring_x and ring_y: radii of the ring, in the rolling direction and across it [m].
    ring_x: Numbers
    ring_y: Numbers

    @property
    def radius_x(self) -> Numbers:
        """Reduced radius in the rolling direction [m]."""
        return reduced_radius(self.element_x, self.ring_x)

    @property
    def radius_y(self) -> Numbers:
        """Reduced radius across the rolling direction [m]; infinite in a line contact."""
        if np.all(np.isinf(self.element_y)) and np.all(np.isinf(self.ring_y)):
            return math.inf
        return reduced_radius(self.element_y, self.ring_y)


def _rolling_radius(
    element_diameter: Numbers, pitch_diameter: Numbers, angle: Numbers, *, inner: bool
) -> Numbers:
    """Radius of a raceway in the rolling direction [m], from the cone that is tangent to it at the angle."""
    cosine = np.cos(angle)
    sign = 1.0 if inner else -1.0
    curvature = sign * 2.0 * cosine / (pitch_diameter - sign * element_diameter * cosine)
    flat = curvature == 0.0
    return as_float(np.where(flat, math.inf, 1.0 / np.where(flat, 1.0, curvature)))


# Largest distance of a contact angle from 90 degrees that is rounding [rad].
_SQUARE = 1e-9


def is_thrust(contact_angle: Numbers) -> bool:
    """Whether contacts have an angle of 90 degrees [rad].

    Examples
    --------
    >>> is_thrust(math.radians(90.0)), is_thrust(math.radians(45.0))
    (True, False)
    """
    return bool(np.all(np.abs(np.asarray(contact_angle) - 0.5 * math.pi) < _SQUARE))


def _first(wrong: Booleans, *values: Numbers) -> tuple[float, ...] | None:
    """Values of the first point that is wrong; None where all points are right."""
    if not np.any(wrong):
        return None
    first = int(np.argmax(wrong))
    return tuple(float(np.broadcast_to(value, np.shape(wrong)).flat[first]) for value in values)


def _refuse_overlap(elements: int, diameters: Numbers, pitch_diameters: Numbers) -> None:
    """Raise InputError where the elements do not fit on their pitch circle, or are fewer than three."""
    ratio = np.asarray(diameters / pitch_diameters)
    most_of_all = np.floor(np.pi / np.arcsin(np.minimum(ratio, 1.0))) * (ratio < 1.0)
    wrong = _first(
        (most_of_all < 3) | (elements < 3) | (elements > most_of_all), diameters, pitch_diameters, most_of_all
    )
    if wrong is None:
        return
    diameter, pitch_diameter, most = wrong[0], wrong[1], int(wrong[2])
    if most < 3:
        raise InputError(
            "pitch_diameter", got=f"{pitch_diameter:g} m", takes=f"one that three of {diameter:g} m fit on"
        )
    raise InputError(
        "elements",
        got=elements,
        takes=f"3 to {most}, the most of {diameter:g} m that a pitch circle of {pitch_diameter:g} m holds",
    )


@dataclass(frozen=True)
class Rows:
    """Rows of a bearing: one, or two alike that face each other, as in a pair of bearings side by side.

    Both rings stay parallel, so that arrangements back to back (O) and face to face (X) carry the same loads.
    The first row carries loads towards positive axial positions, the second one those against them.
    """

    number: int = 1
    # Axial force with which the rows are pressed against each other without load [N].
    preload: Numbers = 0.0
    # Axial play of the inner ring from one row to the other, instead of a preload [m].
    endplay: Numbers = 0.0

    @property
    def signs(self) -> Array:
        """1 for the first and -1 for the second row, shape (number,)."""
        return np.array([1.0, -1.0][: self.number])

    @property
    def values(self) -> tuple[Numbers, Numbers]:
        """Numbers that may vary over points of operation."""
        return self.preload, self.endplay


SINGLE_ROW = Rows()


class _Bearing(ABC):
    """Properties that are computed in the same way for bearings with balls and with rollers."""

    rows: Rows

    @property
    @abstractmethod
    def clearance(self) -> Numbers:
        """Radial internal clearance, the full diametral play P_d [m]."""

    @property
    @abstractmethod
    def free_angle(self) -> Numbers:
        """Contact angle without a load [rad]."""

    @property
    def tracks(self) -> int:
        """Contacts of an element with one ring."""
        return 1

    @property
    def groups(self) -> int:
        """Groups of as many contacts as there are elements in a row: of each row and each track."""
        return self.rows.number * self.tracks

    @property
    def bottom_angle(self) -> float:
        """Angle of the bottoms of both raceways, from which grooves reach to their shoulders [rad]."""
        return 0.0

    @property
    def room(self) -> Numbers:
        """Room that films take up [m]: the radial clearance, or the play of a pair along its contacts; 0 or
        negative with a preload.
        """
        if self.rows.number == 1:
            return self.clearance
        return as_float(self.rows.endplay * np.sin(self.free_angle))

    @property
    def follows_films(self) -> bool:
        """Whether the ring gives way to the films along the axis, so that they change no load."""
        return False


@dataclass(frozen=True)
class BallBearing(_Bearing):
    """Deep-groove or angular-contact ball bearing with one row of balls, or a pair of the latter.

    Either the radial clearance or the free contact angle is given; the other follows.

    Raises InputError where the balls do not fit on their pitch circle, a value is out of range, or not
    exactly one of clearance and contact angle is given.

    T. A. Harris and M. N. Kotzalas, Essential Concepts of Bearing Technology, 5th ed., 2006, chapter 2,
    doi:10.1201/9781420006599.

    Examples
    --------
    A 6208 with a clearance of 10 um:

    >>> bearing = BallBearing(9, 11.906e-3, 60e-3, 0.52, 0.52, radial_clearance=10e-6)
    >>> round(bearing.groove_distance * 1e3, 5), round(math.degrees(bearing.free_angle), 2)
    (0.47624, 8.31)
    >>> round(bearing.endplay * 1e6)
    138
    """

    elements: int
    # ball_diameter and pitch_diameter: ball diameter D and pitch diameter d_m [m]. d_m is the mean of both
    # raceway diameters at the bottom of the grooves.
    ball_diameter: Numbers
    pitch_diameter: Numbers
    # inner_groove and outer_groove: osculation f_i and f_o: radius of the groove over the diameter of the
    # ball, above 0.5
    inner_groove: Numbers
    outer_groove: Numbers
    # Radial internal clearance, the full diametral play P_d [m]; negative with a radial preload.
    radial_clearance: Numbers | None = None
    # Free contact angle a_0, at which ball and grooves just touch without load [rad].
    contact_angle: Numbers | None = None
    rows: Rows = SINGLE_ROW

    def __post_init__(self) -> None:
        self._refuse_grooves()
        if (self.radial_clearance is None) == (self.contact_angle is None):
            raise InputError("radial_clearance, contact_angle", "give one of the two")
        if self.contact_angle is not None:
            self._refuse_angle()
        most = 2.0 * self.groove_distance
        wrong = _first(self.clearance >= most, self.clearance, most)
        if wrong is not None:
            raise InputError(
                "radial_clearance",
                got=f"{wrong[0]:g} m",
                takes=f"one below {wrong[1]:g} m, at which the balls leave the grooves",
            )

    def _refuse_grooves(self) -> None:
        """Raise InputError where the balls do not fit on their pitch circle or into their grooves."""
        _refuse_overlap(self.elements, self.ball_diameter, self.pitch_diameter)
        for key in ("inner_groove", "outer_groove"):
            groove = np.asarray(getattr(self, key))
            wrong = _first((groove <= 0.5) | (groove > 1.0), groove)
            if wrong is not None:
                raise InputError(key, got=f"{wrong[0]:g}", takes="one above 0.5, up to 1")

    def _refuse_angle(self) -> None:
        """Raise InputError where the contact angle is out of range."""
        angle = np.asarray(self.contact_angle)
        wrong = _first((angle <= 0.0) | (angle >= math.pi / 2.0), angle)
        if wrong is not None:
            raise InputError("contact_angle", got=f"{wrong[0]:g} rad", takes="one between 0 and 90 deg")

    @property
    def dimensions(self) -> tuple[Numbers, ...]:
        """All dimensions that may vary over points of operation."""
        play = self.contact_angle if self.radial_clearance is None else self.radial_clearance
        assert play is not None
        sizes = self.ball_diameter, self.pitch_diameter, self.inner_groove, self.outer_groove
        return *sizes, play, *self.rows.values

    @property
    def groove_distance(self) -> Numbers:
        """Distance of the groove centres at which the ball just touches both, A = (f_i + f_o - 1) D [m]."""
        return (self.inner_groove + self.outer_groove - 1.0) * self.ball_diameter

    @property
    def clearance(self) -> Numbers:
        """Radial internal clearance P_d = 2 A (1 - cos a_0), given or from the free contact angle [m]."""
        if self.radial_clearance is not None:
            return self.radial_clearance
        assert self.contact_angle is not None
        return as_float(4.0 * self.groove_distance * np.sin(self.contact_angle / 2.0) ** 2)

    @property
    def radial_distance(self) -> Numbers:
        """Radial distance of the groove centres in concentric rings, A - P_d/2 = A cos a_0 [m]."""
        return self.groove_distance - self.clearance / 2.0

    @property
    def free_angle(self) -> Numbers:
        """Free contact angle, cos a_0 = 1 - P_d/(2 A) [rad]; 0 with a radial preload."""
        if self.contact_angle is not None:
            return self.contact_angle
        play = np.maximum(0.0, self.clearance) / (4.0 * self.groove_distance)
        return as_float(2.0 * np.arcsin(np.sqrt(play)))

    @property
    def endplay(self) -> Numbers:
        """Axial internal clearance (endplay) from one end to the other, 2 A sin a_0 [m]."""
        return as_float(2.0 * self.groove_distance * np.sin(self.free_angle))

    @property
    def offsets(self) -> tuple[Numbers, Numbers]:
        """Distances (f - 1/2) D from the ball's centre to both groove centres at first touch [m]."""
        inner, outer = self.inner_groove - 0.5, self.outer_groove - 0.5
        return inner * self.ball_diameter, outer * self.ball_diameter

    @property
    def inner_centre_radius(self) -> Numbers:
        """Radius of the circle of inner groove centres, d_m/2 + (f_i - 1/2) D cos a_0 [m]."""
        cosine = self.radial_distance / self.groove_distance
        return 0.5 * self.pitch_diameter + self.offsets[0] * cosine

    @property
    def one_way(self) -> bool:
        """Whether the bearing carries axial loads one way, and radial loads only with them."""
        return self.contact_angle is not None and self.rows.number == 1

    @property
    def first_angles(self) -> tuple[Numbers | None, Numbers | None]:
        """Angles from their bottoms at which the inner and the outer groove begin on the side of the contacts
        [rad]; None where they begin at the other shoulder.
        """
        return None, None

    def radii(self, angle: Numbers, *, inner: bool) -> ContactRadii:
        """Radii of ball and groove at the inner or outer contact, for a contact angle [rad], shape (...).

        Examples
        --------
        Reduced radii of the inner contact, in mm:

        >>> bearing = BallBearing(9, 11.906e-3, 60e-3, 0.52, 0.52, radial_clearance=10e-6)
        >>> radii = bearing.radii(0.0, inner=True)
        >>> round(radii.radius_x * 1e3, 4), round(radii.radius_y * 1e3, 3)
        (4.7717, 154.778)
        """
        groove = self.inner_groove if inner else self.outer_groove
        ball, pitch = self.ball_diameter, self.pitch_diameter
        rolling = _rolling_radius(ball, pitch, angle, inner=inner)
        return ContactRadii(element_x=ball / 2.0, element_y=ball / 2.0, ring_x=rolling, ring_y=-groove * ball)

    def element_mass(self, density: Numbers) -> Numbers:
        """Mass of a ball, rho pi D^3/6 [kg], from its density rho [kg/m^3]."""
        return density * math.pi * self.ball_diameter**3 / 6.0


# Contact angle of most four-point contact bearings [rad].
_USUAL_ANGLE = math.radians(35.0)


@dataclass(frozen=True)
class FourPointBearing(BallBearing):
    """Four-point contact ball bearing with one row of balls: the grooves of both rings are gothic arches.

    The left and the right half of an arch are arcs with centres on either side of its middle. A ball has two
    diagonals: each leads from the centre of an arc of the outer ring to the centre of the opposite arc of the
    inner ring. The first diagonal carries positive axial loads on the inner ring, and the second one negative
    ones. Both carry radial loads. With the rings concentric and centred axially, the vector along the first
    diagonal has the axial component S and the radial component A cos a. Its length is A when a small axial
    load has moved the ring by A sin a - S, and again when a small radial load has moved it by P_d/2. So

        S = sqrt(A^2 - (A cos a + P_d/2)^2)

    Inner and outer arcs have parts of S in proportion to their offsets: all four contacts of a ball touch at
    once when a radial load moves the ring. Both contact angle and clearance are given.

    Raises InputError where the balls do not fit on their pitch circle, or a value is out of range.

    T. A. Harris and M. N. Kotzalas, Essential Concepts of Bearing Technology, 5th ed., 2006, chapter 2,
    doi:10.1201/9781420006599.

    Examples
    --------
    A QJ 208 with a clearance of 30 um, and its axial play in micrometres:

    >>> bearing = FourPointBearing(12, 12.7e-3, 60e-3, 0.52, 0.52, 30e-6, math.radians(35.0))
    >>> round(bearing.separation * 1e3, 4), round(bearing.endplay * 1e6, 1)
    (0.2687, 45.4)
    """

    # Radial internal clearance, the full diametral play P_d of rings that are centred axially [m]; negative
    # with a preload.
    radial_clearance: Numbers = 0.0
    # Contact angle a, at which a ball touches both rings under an axial load that is vanishingly small [rad].
    contact_angle: Numbers = _USUAL_ANGLE

    def __post_init__(self) -> None:
        self._refuse_grooves()
        self._refuse_angle()
        least = -2.0 * self.radial_distance
        most = 4.0 * self.groove_distance * np.sin(self.contact_angle / 2.0) ** 2
        wrong = _first((self.clearance <= least) | (self.clearance >= most), self.clearance, least, most)
        if wrong is not None:
            raise InputError(
                "radial_clearance",
                got=f"{wrong[0]:g} m",
                takes=f"one between {wrong[1]:g} and {wrong[2]:g} m, where the arches have two arcs each",
            )

    @property
    def dimensions(self) -> tuple[Numbers, ...]:
        """All dimensions that may vary over points of operation."""
        sizes = self.ball_diameter, self.pitch_diameter, self.inner_groove, self.outer_groove
        return *sizes, self.radial_clearance, self.contact_angle

    @property
    def radial_distance(self) -> Numbers:
        """Radial distance of the groove centres in concentric rings, A cos a [m]."""
        return as_float(self.groove_distance * np.cos(self.contact_angle))

    @property
    def separation(self) -> Numbers:
        """Axial distance S of the centres at both ends of a diagonal in centred rings [m]."""
        distance, near = self.groove_distance, self.radial_distance + self.clearance / 2.0
        return as_float(np.sqrt((distance - near) * (distance + near)))

    @property
    def separations(self) -> tuple[Numbers, Numbers]:
        """Axial distances of the arcs' centres from the middle of the inner and the outer arch [m]."""
        share = self.separation / self.groove_distance
        return self.offsets[0] * share, self.offsets[1] * share

    @property
    def tracks(self) -> int:
        """Contacts of a ball with one ring, on both diagonals."""
        return 2

    @property
    def one_way(self) -> bool:
        """Whether the bearing carries axial loads one way: both diagonals together do not."""
        return False

    @property
    def first_angles(self) -> tuple[Numbers, Numbers]:
        """Angles of the middle of both arches, at which their arcs begin, from the bottoms of these [rad]."""
        grooves = self.inner_groove * self.ball_diameter, self.outer_groove * self.ball_diameter
        inner, outer = (
            as_float(np.arcsin(aside / groove))
            for aside, groove in zip(self.separations, grooves, strict=True)
        )
        return inner, outer

    @property
    def endplay(self) -> Numbers:
        """Axial internal clearance (endplay), 2 (A sin a - S) [m]; negative with a preload."""
        # The difference of the squares of both distances, without loss of digits for a small clearance.
        squares = self.clearance * (self.radial_distance + self.clearance / 4.0)
        both = self.groove_distance * np.sin(self.contact_angle) + self.separation
        return as_float(2.0 * squares / both)


@dataclass(frozen=True)
class ThrustBallBearing(BallBearing):
    """Thrust ball bearing with one row of balls between two washers, whose grooves face each other along the
    axis. ``inner`` is the washer of the shaft and ``outer`` the washer of the housing; the contact angle is
    90 degrees.

    Raises InputError where the balls do not fit on their pitch circle, or a value is out of range.

    Examples
    --------
    Reduced radii of both contacts of a 51208, in mm:

    >>> bearing = ThrustBallBearing(16, 9.525e-3, 54e-3, 0.54, 0.54)
    >>> radii = [bearing.radii(bearing.free_angle, inner=inner) for inner in (True, False)]
    >>> [round(one.radius_x * 1e3, 4) for one in radii], round(radii[0].radius_y * 1e3, 2)
    ([4.7625, 4.7625], 64.29)
    """

    contact_angle: Numbers | None = 0.5 * math.pi

    def __post_init__(self) -> None:
        self._refuse_grooves()

    @property
    def dimensions(self) -> tuple[Numbers, ...]:
        """All dimensions that may vary over points of operation."""
        return self.ball_diameter, self.pitch_diameter, self.inner_groove, self.outer_groove

    @property
    def clearance(self) -> Numbers:
        """Radial internal clearance [m]; there is none, as nothing holds the washers radially."""
        return 0.0

    @property
    def radial_distance(self) -> Numbers:
        """Radial distance of the groove centres [m]."""
        return 0.0

    @property
    def follows_films(self) -> bool:
        """Whether the ring gives way to the films along the axis, so that they change no load."""
        return True

    @property
    def bottom_angle(self) -> float:
        """Angle of the bottoms of both grooves [rad]."""
        return 0.5 * math.pi


@dataclass(frozen=True)
class RollerBearing(_Bearing):
    """Bearing with rows of rollers: cylindrical rollers and needles, tapered rollers, or needles of a thrust
    bearing. Raises InputError where the rollers do not fit on their pitch circle, or the profile is unknown.

    The axis of tapered rollers is inclined by the contact angle, and both of their contacts have this angle.
    It is 90 degrees in a thrust bearing.

    Examples
    --------
    Reduced radii of the inner and the outer contact, in mm:

    >>> bearing = RollerBearing(14, 11e-3, 60e-3, 11e-3, 20e-6)
    >>> [round(bearing.radii(inner=inner).radius_x * 1e3, 4) for inner in (True, False)]
    [4.4917, 6.5083]
    """

    elements: int
    # roller_diameter and pitch_diameter: roller diameter D and pitch diameter d_m [m]. d_m is the mean of
    # both raceway diameters.
    roller_diameter: Numbers
    pitch_diameter: Numbers
    roller_length: Numbers  # effective length L of the rollers [m]
    # Radial internal clearance, the full diametral play P_d [m]; negative with a radial preload.
    radial_clearance: Numbers
    # "none" for straight rollers, or "logarithmic" for the profile of ISO/TS 16281
    profile: str = "logarithmic"
    # Angle between the contacts and the radial plane, from 0 to 90 degrees [rad].
    contact_angle: Numbers = 0.0
    rows: Rows = SINGLE_ROW

    def __post_init__(self) -> None:
        _refuse_overlap(self.elements, self.roller_diameter, self.pitch_diameter)
        if self.profile not in PROFILES:
            raise InputError("profile", got=shown(self.profile), takes=f"one of {', '.join(PROFILES)}")

    @property
    def dimensions(self) -> tuple[Numbers, ...]:
        """All dimensions that may vary over points of operation."""
        sizes = self.roller_diameter, self.pitch_diameter, self.roller_length, self.radial_clearance
        return *sizes, self.contact_angle, *self.rows.values

    @property
    def thrust(self) -> bool:
        """Whether the contacts have an angle of 90 degrees, so that they carry only axial loads."""
        return is_thrust(self.contact_angle)

    @property
    def carries_axial(self) -> bool:
        """Whether the raceways carry axial loads."""
        return bool(np.any(np.asarray(self.contact_angle) > 0.0))

    def relief(self, position: ArrayLike) -> Array:
        """Relief of a roller's profile: its radius in the middle less its radius at a position.

        For L up to 2.5 D it is P(x) = 0.00035 D ln(1/(1 - (2 x/L)^2)). Longer rollers are straight except for
        1.25 D at either end, where P(x) = 0.0005 D ln(1/(1 - ((2 abs(x) - L)/(2.5 D) + 1)^2)).

        ``position``, position x along the roller, from its middle, within L/2 [m], shape (..., n); ``...`` is
        the shape of diameter and length. Returns relief P [m]; it grows without bound towards the ends, shape
        (..., n).

        ISO/TS 16281:2008, profile functions of cylindrical rollers.

        Examples
        --------
        Relief in micrometres:

        >>> bearing = RollerBearing(14, 11e-3, 60e-3, 11e-3, 20e-6)
        >>> [round(float(p) * 1e6, 3) for p in bearing.relief([0.0, 2.75e-3, 5e-3])]
        [0.0, 1.108, 6.742]
        """
        x = np.abs(np.asarray(position, dtype=float))
        if self.profile == "none":
            return np.zeros_like(x)
        length, diameter = (
            value if np.ndim(value) == 0 else np.asarray(value)[..., np.newaxis]
            for value in (self.roller_length, self.roller_diameter)
        )
        end = _SHORT * diameter
        short = length <= end
        outward = np.where(short, 2.0 * x / length, np.maximum(0.0, (2.0 * x - length) / end + 1.0))
        return np.asarray(-np.where(short, 0.00035, 0.0005) * diameter * np.log1p(-(outward**2)))

    @property
    def clearance(self) -> Numbers:
        """Radial internal clearance, the full diametral play P_d [m]."""
        return self.radial_clearance

    @property
    def follows_films(self) -> bool:
        """Whether the ring gives way to the films along the axis, so that they change no load."""
        return self.carries_axial and self.rows.number == 1

    @property
    def free_angle(self) -> Numbers:
        """Contact angle [rad]; zero of cylindrical rollers, which carry radial loads only."""
        return self.contact_angle

    def radii(self, _angle: Numbers = 0.0, *, inner: bool) -> ContactRadii:
        """Radii of roller and ring at the inner or outer contact, a line contact at the contact angle."""
        if self.thrust:
            return ContactRadii(
                element_x=self.roller_diameter / 2.0, element_y=math.inf, ring_x=math.inf, ring_y=math.inf
            )
        sizes = self.roller_diameter, self.pitch_diameter, self.contact_angle
        return ContactRadii(
            element_x=self.roller_diameter / 2.0,
            element_y=math.inf,
            ring_x=_rolling_radius(*sizes, inner=inner),
            ring_y=math.inf,
        )

    def element_mass(self, density: Numbers) -> Numbers:
        """Mass of a roller, rho pi D^2 L/4 [kg], from its density rho [kg/m^3]."""
        return density * math.pi * self.roller_diameter**2 * self.roller_length / 4.0


Geometry: TypeAlias = BallBearing | RollerBearing


@dataclass(frozen=True)
class Speeds:
    """Speeds of cage, elements and contacts in pure rolling."""

    cage: Array | float  # angular speed of the element's centre about the axis of the bearing [rad/s]
    spin: Array | float  # angular speed of the element about its own axis, relative to the cage [rad/s]
    # inner_entrainment and outer_entrainment: entrainment speed (u1 + u2)/2, with the speeds of both surfaces
    # relative to the contact [m/s].
    inner_entrainment: Array | float
    outer_entrainment: Array | float


def rolling_speeds(
    *,
    element_diameter: Numbers,
    pitch_diameter: Numbers,
    inner_speed: Numbers,
    outer_speed: Numbers = 0.0,
    contact_angle: ArrayLike = 0.0,
) -> Speeds:
    """Speeds of cage, elements and contacts in pure rolling.

    Let g = D cos a/d_m. The cage turns at w_c = (w_i (1 - g) + w_o (1 + g))/2. Relative to the cage, the
    element turns at (w_i - w_o) (1 - g^2) d_m/(2 D). The inner raceway, with the radius d_m (1 - g)/2, turns
    at w_i - w_c relative to the cage. The outer raceway, with the radius d_m (1 + g)/2, turns at w_c - w_o in
    the other sense. The surface speed of both is the entrainment speed, (w_i - w_o) (1 - g^2) d_m/4.

    ``element_diameter`` and ``pitch_diameter``, diameter D of the element and pitch diameter d_m [m];
    ``inner_speed`` and ``outer_speed``, angular speeds w_i and w_o of the rings [rad/s]; ``contact_angle``
    [rad]; all of shape (...). Returns speeds, shape (...).

    T. A. Harris and M. N. Kotzalas, Essential Concepts of Bearing Technology, 5th ed., 2006, chapter 10,
    doi:10.1201/9781420006599. The ball's own axis is perpendicular to the line of contact.

    Examples
    --------
    Speed of the cage in rpm and entrainment speed in m/s of a 6208 at 3000 rpm:

    >>> speeds = rolling_speeds(
    ...     element_diameter=11.906e-3, pitch_diameter=60e-3, inner_speed=3000 * 2 * np.pi / 60,
    ... )
    >>> round(speeds.cage * 60 / (2 * np.pi)), round(float(speeds.inner_entrainment), 3)
    (1202, 4.527)
    """
    cosine = np.cos(np.asarray(contact_angle, dtype=float))
    gamma = element_diameter * cosine / pitch_diameter
    cage = 0.5 * (inner_speed * (1.0 - gamma) + outer_speed * (1.0 + gamma))
    inner = 0.5 * pitch_diameter * (1.0 - gamma) * (inner_speed - cage)
    outer = 0.5 * pitch_diameter * (1.0 + gamma) * (cage - outer_speed)
    return Speeds(cage, 2.0 * inner / element_diameter, inner, outer)


def centrifugal_force(*, mass: Numbers, pitch_diameter: Numbers, cage_speed: Numbers) -> Numbers:
    """Centrifugal force of an element, m (d_m/2) w_c^2. ``mass``, mass m of the element [kg];
    ``pitch_diameter``, pitch diameter d_m [m]; ``cage_speed``, angular speed w_c of the cage [rad/s]; all of
    shape (...). Returns centrifugal force [N], shape (...).

    Examples
    --------
    >>> centrifugal_force(mass=0.007, pitch_diameter=0.06, cage_speed=100.0)
    2.1
    """
    return mass * 0.5 * pitch_diameter * cage_speed**2


def gyroscopic_moment(mass: Numbers, diameter: Numbers, speeds: Speeds, contact_angle: ArrayLike) -> Array:
    """Gyroscopic moment of a ball, J w_s w_c sin a with J = m D^2/10.

    The ball's own axis is taken perpendicular to the line of contact. An axis closer to the axis of the
    bearing, as with outer raceway control, makes the moment smaller.

    ``mass`` and ``diameter``, mass m [kg] and diameter D [m] of the ball; ``contact_angle`` [rad],
    shape (...). Returns gyroscopic moment [N m], shape (...).

    T. A. Harris and M. N. Kotzalas, Advanced Concepts of Bearing Technology, 5th ed., 2006, chapter 3,
    doi:10.1201/9781420006582.

    Examples
    --------
    >>> speeds = rolling_speeds(
    ...     element_diameter=11.906e-3, pitch_diameter=60e-3, inner_speed=1000.0, contact_angle=0.5,
    ... )
    >>> round(float(gyroscopic_moment(0.007, 11.906e-3, speeds, 0.5)), 4)
    0.048
    """
    inertia = mass * diameter**2 / 10.0
    return np.asarray(inertia * speeds.spin * speeds.cage * np.sin(contact_angle))
