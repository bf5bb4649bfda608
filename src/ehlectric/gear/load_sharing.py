"""Line loads on the lines of contact of a gear pair over a phase of its mesh. SI units.

F_bt = 2 T_1/d_b1 is the force along the path of contact, and F_bn = F_bt/cos beta_b the normal force. A line
load w is a normal force over the length of the line of contact, so that the integral of w over all lines is
K F_bn, with the product K of the load factors. Laws:

"stiffness": slices of teeth as springs. With the approach delta of the flanks along the path of contact,

    w = c(xi) max(delta - f, 0)        c = c_0 cos(b_0 (xi - eps_alpha/2))        xi = (g - g_A)/p_bt
    1/b_0^2 = (1 + eps_alpha/2)^2/2 - 1        c_0 = c_gamma b_0/(2 sin(b_0 eps_alpha/2))

f is the distance by which relief and crowning move the flanks apart, and delta follows from the load. The
shape of c is the one of least elastic energy (J. I. Pedrero, M. Pleguezuelos, M. Munoz, Mech. Mach. Theory
2013, doi:10.1016/j.mechmachtheory.2013.01.010); with c_0 the mean of the stiffness over a phase is c_gamma b.

"rigid": w = K F_bn/l, the same load on all lines of the present length l.

"iso": shares X of ISO/TS 6336-22, w = K X F_bn/b: of spur pairs 1/3 at A and E, 2/3 at B and D outside the
single contact, and 1 within; of helical pairs with eps_beta of at least 1 the mean load, with 1.3 times this
at A and E that falls over 0.2 sin beta_b mm; interpolated linearly in eps_beta below 1.

"tip-relief": shares of a spur pair whose relief equals its deflection: 0 at A and E, 1 at B and D.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import field

import numpy as np

from ehlectric.arrays import Array
from ehlectric.dataclass import dataclass
from ehlectric.errors import InputError
from ehlectric.gear.contact_lines import PlaneOfAction
from ehlectric.gear.contact_path import ContactPath
from ehlectric.quantities.field_metadata import stored

# Buttressing of helical teeth at both ends of the path, and the length over which it falls at a base helix
# angle whose sine is 1 [m].
_BUTTRESSING, _BUTTRESSED = 1.3, 0.2e-3


@dataclass(frozen=True)
class Modification:
    """Modifications of the flanks, sums of both gears [m]."""

    relief_at_start: float = 0.0  # relief at A, of the tip of the wheel
    relief_at_end: float = 0.0  # relief at E, of the tip of the pinion
    relief_length: float = 0.0  # length along the path of contact over which both fall to zero, linearly
    crowning: float = 0.0  # parabolic lead crowning: distance of the flanks at the ends of the face

    def opening(self, plane: PlaneOfAction, places: Array, across: Array) -> Array:
        """Distance f of the unloaded flanks [m] at places g, shape (..., s), and y, shape (s,)."""
        path, length = plane.path, self.relief_length
        opening: Array = self.crowning * (2.0 * across / plane.face_width - 1.0) ** 2 + np.zeros_like(places)
        if length > 0.0:
            opening = opening + self.relief_at_start * np.maximum(0.0, 1.0 - (places - path.start) / length)
            opening = opening + self.relief_at_end * np.maximum(0.0, 1.0 - (path.end - places) / length)
        return opening


@dataclass(frozen=True)
class LineLoads:
    """Loads on the lines of contact at phases of the mesh.

    Arrays have the shape (p, k, s): phases, lines, and slices of the face; NaN where a line is outside.
    """

    # Phases tau, shape (p,), dimensionless.
    phases: Array = field(metadata=stored("phase", "", "increasing", name="phase"))
    # Places y of the slices on the face, shape (s,).
    across: Array = field(metadata=stored("slice", "m", "increasing", name="slice"))
    slice_length: float  # length of the line of contact in a slice [m]
    # Places g on the path of contact, and line loads w.
    places: Array = field(metadata=stored("phase line slice", "m", "not negative or NaN", name="place"))
    load: Array = field(metadata=stored("phase line slice", "N/m", "not negative or NaN"))

    @property
    def normal_force(self) -> Array:
        """Sum of the loads of all lines, shape (p,) [N]."""
        return np.asarray(self.slice_length * np.nansum(self.load, axis=(1, 2)))


def line_loads(
    plane: PlaneOfAction,
    normal_force: float,
    law: str,
    *,
    stiffness: float,
    modification: Modification = Modification(),
    phases: int = 48,
    slices: int = 48,
) -> LineLoads:
    """Line loads over a phase of the mesh.

    ``normal_force``, K F_bn [N]; ``law``, "stiffness", "rigid", "iso" or "tip-relief"; ``stiffness``,
    c_gamma per face width [N/m^2], of the law "stiffness" only; ``phases`` and ``slices``, numbers of phases
    and of slices of the face.
    """
    # Midpoints: no place is on the edge of the plane, where a line begins or ends.
    tau = (np.arange(phases) + 0.5) / phases
    width = plane.face_width / slices
    across: Array = width * np.arange(0.5, slices)
    places = plane.places(tau, across)
    length = width / math.cos(plane.path.base_helix_angle)
    weights = LAWS[law](
        plane, places, across, modification, normal_force * math.cos(plane.path.base_helix_angle), stiffness
    )
    if law in _NORMALISED:
        total = length * np.nansum(weights, axis=(1, 2), keepdims=True)
        weights = weights * (normal_force / total)
    return LineLoads(tau, across, length, places, weights)


# Laws that distribute the whole force at each phase; the others are shares of standards.
_NORMALISED = ("stiffness", "rigid")


def single_stiffness(plane: PlaneOfAction, places: Array, stiffness: float) -> Array:
    """Stiffness c of a slice of one pair per face width [N/m^2], at places g on the path of contact [m]."""
    ratio = plane.path.contact_ratio
    b0 = 1.0 / math.sqrt(0.5 * (1.0 + 0.5 * ratio) ** 2 - 1.0)
    xi = (places - plane.path.start) / plane.path.base_pitch
    return 0.5 * stiffness * b0 / math.sin(0.5 * b0 * ratio) * np.cos(b0 * (xi - 0.5 * ratio))


def _on_springs(
    plane: PlaneOfAction,
    places: Array,
    across: Array,
    modification: Modification,
    path_force: float,
    stiffness: float,
) -> Array:
    """Line loads of slices on springs [N/m]."""
    c = np.nan_to_num(single_stiffness(plane, places, stiffness))
    opening = np.nan_to_num(modification.opening(plane, places, across))
    width = plane.face_width / across.size
    delta = _approach(c.reshape(len(c), -1), opening.reshape(len(c), -1), path_force / width)
    load = c * np.maximum(delta[:, None, None] - opening, 0.0)
    return np.where(np.isnan(places), np.nan, load)


def _approach(c: Array, opening: Array, force: float) -> Array:
    """Approach delta at which sum of c max(delta - f, 0) is the force, for each row, shape (p,).

    The sum is piecewise linear in delta: between two openings, in increasing order, it is a line.
    """
    order = np.argsort(opening, axis=1)
    c, opening = np.take_along_axis(c, order, 1), np.take_along_axis(opening, order, 1)
    total, moment = np.cumsum(c, axis=1), np.cumsum(c * opening, axis=1)
    with np.errstate(divide="ignore", invalid="ignore"):
        delta = (force + moment) / total
    following = np.concatenate([opening[:, 1:], np.full((len(c), 1), np.inf)], axis=1)
    fits = (total > 0.0) & (delta <= following)
    approach: Array = delta[np.arange(len(c)), np.argmax(fits, axis=1)]
    return approach


def _rigid(_plane: PlaneOfAction, places: Array, *_: object) -> Array:
    """Equal loads on all lines; the sum follows."""
    return np.where(np.isnan(places), np.nan, 1.0)


def _shares(
    plane: PlaneOfAction, places: Array, _across: Array, _modification: object, path_force: float, _: float
) -> Array:
    """Line loads of the shares of ISO/TS 6336-22 without relief [N/m]."""
    beta = min(1.0, plane.overlap_ratio)
    spur = _trapezoid(plane, places, at_end=1.0 / 3.0)
    share = spur
    if beta > 0.0:
        sine = math.sin(plane.path.base_helix_angle)
        helical = _buttressing(plane, places, 1.0 + (_BUTTRESSING - 1.0) * beta, _BUTTRESSED * sine)
        share = (1.0 - beta) * spur + beta * helical / plane.path.contact_ratio
    return share * path_force / plane.face_width


def _tip_relief(
    plane: PlaneOfAction, places: Array, _across: Array, _modification: object, path_force: float, _: float
) -> Array:
    """Line loads of a spur pair with as much relief as deflection [N/m]."""
    if plane.overlap_ratio > 0.0:
        raise InputError(
            "gear.operation.load_sharing",
            got="'tip-relief' for helical gears",
            takes="'stiffness' with gear.tip_relief and gear.tip_relief_length",
        )
    return _trapezoid(plane, places, at_end=0.0) * path_force / plane.face_width


def _trapezoid(plane: PlaneOfAction, places: Array, *, at_end: float) -> Array:
    """Share of a spur pair: 1 in single contact, else a line from ``at_end`` at A and E.

    Both shares of double contact add up to 1, so that the lines end at 1 - at_end next to B and D. With a
    contact ratio above 2 there is no single contact: the share is a trapezoid that adds up to 1.
    """
    path = plane.path
    if path.contact_ratio > 2.0:
        raise InputError(
            "gear.operation.load_sharing",
            got=f"shares for a transverse contact ratio of {path.contact_ratio:.3f}",
            takes="'stiffness' or 'rigid': these shares are for one or two pairs in contact",
        )
    x = places - path.start
    double = path.length - path.base_pitch
    first, last = x / double, (path.length - x) / double
    inside = (first >= 1.0) & (last >= 1.0)
    line = at_end + (1.0 - 2.0 * at_end) * np.minimum(first, last)
    return np.where(np.isnan(places), np.nan, np.where(inside, 1.0, line))


def _buttressing(plane: PlaneOfAction, places: Array, most: float, over: float) -> Array:
    """Factor of the load at the ends of the path of a helical pair, which falls to 1 over a length [m]."""
    nearest = np.minimum(places - plane.path.start, plane.path.end - places)
    return 1.0 + (most - 1.0) * np.maximum(0.0, 1.0 - nearest / over)


LAWS: Mapping[str, Callable[..., Array]] = {
    "stiffness": _on_springs,
    "rigid": _rigid,
    "iso": _shares,
    "tip-relief": _tip_relief,
}


# Side of a point on which its line load is taken: B and D belong to the single contact of a spur pair.
SIDES: Mapping[str, float] = {"A": 1.0, "B": 1.0, "C": 0.0, "D": -1.0, "E": -1.0}

# Part of the path of contact over which a line load is averaged.
_WINDOW = 0.02


def load_at(path: ContactPath, loads: LineLoads, place: float, side: float = 0.0) -> float:
    """Mean line load that passes a place g of the path of contact [N/m]; ``side``, 1 just behind it, -1 just
    before it, 0 around it.
    """
    window = _WINDOW * path.length
    centre = place + 0.5 * side * window
    distance = np.abs(np.where(np.isnan(loads.places), np.inf, loads.places) - centre)
    near = distance <= max(0.5 * window, float(np.min(distance)))
    return float(np.mean(loads.load[near]))
