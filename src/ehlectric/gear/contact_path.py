"""Path of contact: its points, with the curvature and the speeds of both flanks. SI units.

Places on the path are measured from T1, where it touches the base circle of the pinion, so that a place g is
the transverse radius of curvature of the pinion's flank. With the transverse angles of ``geometry``

    T1T2 = a sin alpha_wt        g_A = T1T2 - sqrt(d_a2^2 - d_b2^2)/2        g_E = sqrt(d_a1^2 - d_b1^2)/2
    g_C = (d_b1/2) tan alpha_wt        g_B = g_E - p_bt        g_D = g_A + p_bt
    rho_t1 = g        rho_t2 = T1T2 - g        1/rho_n = cos beta_b (1/rho_t1 + 1/rho_t2)
    v_1 = omega_1 rho_t1        v_2 = omega_2 rho_t2        u_m = (v_1 + v_2)/2        SRR = (v_1 - v_2)/u_m

For a ring the root in g_A is added, and rho_t2 is negative, the radius of its concave flank. Both speeds are
across the line of contact, also of helical gears: the component along the line is the same on both flanks.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from ehlectric.arrays import Numbers
from ehlectric.errors import InputError
from ehlectric.gear.geometry import GearPair

# Names of the points of the path, by ISO 21771.
POINTS = ("A", "B", "C", "D", "E")


@dataclass(frozen=True)
class ContactPath:
    """Path of contact; places g, base tangent length T1T2 and base pitch in metres."""

    start: float  # g_A
    pitch_point: float  # g_C
    end: float  # g_E
    base_pitch: float  # p_bt
    tangent_length: float  # T1T2, negative for an internal pair
    base_helix_angle: float  # beta_b [rad]

    @property
    def length(self) -> float:
        """Length g_alpha of the path of contact [m]."""
        return self.end - self.start

    @property
    def contact_ratio(self) -> float:
        """Transverse contact ratio eps_alpha, dimensionless."""
        return self.length / self.base_pitch

    @property
    def points(self) -> dict[str, float]:
        """Places of A, B, C, D and E [m]. B and D bound the single contact of a spur pair."""
        places = (
            self.start,
            self.end - self.base_pitch,
            self.pitch_point,
            self.start + self.base_pitch,
            self.end,
        )
        return dict(zip(POINTS, places, strict=True))

    def transverse_radii(self, place: Numbers) -> tuple[Numbers, Numbers]:
        """Radii of curvature of both flanks in the transverse plane at places g [m], of any shape."""
        return place, self.tangent_length - place

    def reduced_radius(self, place: Numbers) -> Numbers:
        """Radius rho_n of the equivalent roller on a plane at places g [m]."""
        first, second = self.transverse_radii(place)
        return first * second / (self.tangent_length * math.cos(self.base_helix_angle))

    def speeds(self, place: Numbers, pinion_speed: float, ratio: float) -> tuple[Numbers, Numbers]:
        """Speeds of both flanks across the line of contact [m/s] at places g [m]. ``pinion_speed``, angular
        speed omega_1 [rad/s]; ``ratio``, u = z2/z1.
        """
        first, second = self.transverse_radii(place)
        return pinion_speed * first, pinion_speed / ratio * second

    def sliding_speed(self, place: Numbers, pinion_speed: float, ratio: float) -> Numbers:
        """Sliding speed v_1 - v_2 = (omega_1 + omega_2) (g - g_C) [m/s] at places g [m]."""
        return (pinion_speed + pinion_speed / ratio) * (place - self.pitch_point)


def contact_path(pair: GearPair) -> ContactPath:
    """Path of contact of a gear pair.

    Raises
    ------
    InputError
        If the path begins before T1, where the tip of the wheel would cut into the root of the pinion below
        its involute, or ends beyond T2 of an external pair; if the transverse contact ratio is below 1, so
        that no pair of teeth touches at times.

    Examples
    --------
    >>> from ehlectric.gear.geometry import Drawing, gear_pair
    >>> pair = gear_pair(Drawing(4.5e-3, (16, 24), math.radians(20.0), 0.0, 14e-3, 91.5e-3, (0.1817, 0.1715),
    ...     (82.46e-3, 118.36e-3)))
    >>> round(contact_path(pair).contact_ratio, 4)
    1.4375
    """
    tangent = pair.centre_distance * math.sin(pair.working_pressure_angle)
    (first_tip, second_tip), (first_base, second_base) = pair.tip_diameter, pair.base_diameter
    half = 0.5 * math.sqrt(second_tip**2 - second_base**2)
    path = ContactPath(
        start=tangent + half if pair.internal else tangent - half,
        pitch_point=0.5 * first_base * math.tan(pair.working_pressure_angle),
        end=0.5 * math.sqrt(first_tip**2 - first_base**2),
        base_pitch=pair.transverse_base_pitch,
        tangent_length=tangent,
        base_helix_angle=pair.base_helix_angle,
    )
    _check(path, pair)
    return path


def _check(path: ContactPath, pair: GearPair) -> None:
    """Refuse a path on which the flanks cannot run."""
    if path.start <= 0.0:
        raise InputError(
            "gear.tip_diameter.2",
            got=f"{1e3 * abs(pair.tip_diameter[1]):.4f} mm, with contact below the base circle of gear 1",
            takes="a tip circle that ends the contact above it, or a larger profile shift of gear 1",
        )
    if not pair.internal and path.end >= path.tangent_length:
        raise InputError(
            "gear.tip_diameter.1",
            got=f"{1e3 * pair.tip_diameter[0]:.4f} mm, with contact below the base circle of gear 2",
            takes="a tip circle that ends the contact above it, or a larger profile shift of gear 2",
        )
    if path.contact_ratio < 1.0:
        raise InputError.worded("gear.tip_diameter", _too_short(path, pair))


def _too_short(path: ContactPath, pair: GearPair) -> str:
    """Text on a path of contact that is shorter than the base pitch."""
    times = "at times" if path.contact_ratio > 0.0 else "at all times"
    tips = " and ".join(f"{1e3 * abs(tip):.4g} mm" for tip in pair.usual_tips)
    distance, helix = 1e3 * pair.centre_distance, math.degrees(pair.helix_angle)
    return (
        f"gives a transverse contact ratio of {path.contact_ratio:.4f} "
        f"at a centre distance of {distance:.5g} mm and a helix angle of {helix:.4g} deg: "
        f"{times} no pair of teeth would touch. A full addendum has tip diameters of {tips}. "
        "Use larger tip circles, a smaller centre distance or more teeth"
    )
