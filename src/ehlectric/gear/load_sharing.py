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
from dataclasses import dataclass, field

import numpy as np

from ehlectric.arrays import Array
from ehlectric.errors import InputError
from ehlectric.gear.contact_lines import LineNodes, LineParts, PlaneOfAction, line_nodes, line_parts
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

    @property
    def none(self) -> bool:
        """Whether the flanks are not modified."""
        relieved = self.relief_length > 0.0 and max(self.relief_at_start, self.relief_at_end) > 0.0
        return not relieved and self.crowning == 0.0

    def relief(self, path: ContactPath, places: Array) -> Array:
        """Relief of both flanks [m] at places g, shape (...)."""
        length = self.relief_length
        if length == 0.0:
            return np.zeros_like(places)
        start = self.relief_at_start * np.maximum(0.0, 1.0 - (places - path.start) / length)
        end = self.relief_at_end * np.maximum(0.0, 1.0 - (path.end - places) / length)
        return np.asarray(start + end)

    def opening(self, plane: PlaneOfAction, places: Array, across: Array) -> Array:
        """Distance f of the unloaded flanks [m] at places g and y of one shape (...)."""
        crowning = self.crowning * (2.0 * across / plane.face_width - 1.0) ** 2
        return np.asarray(crowning + self.relief(plane.path, places))

    def loaded(self, parts: LineParts, approach: Array) -> tuple[Array, Array]:
        """Begin and end of the piece of each part of a line in which f is below an approach [m], shape (p,).

        f is a linear relief plus a parabola, so that this piece lies between two roots. Returns places 0 to 1
        within the part, shape (p, k, z); equal ones where the part has no such piece.
        """
        plane = parts.plane
        here, there = (
            self.relief(plane.path, parts.places(across)) for across in (parts.low, parts.low + parts.width)
        )
        begin, step = 2.0 * parts.low / plane.face_width - 1.0, 2.0 * parts.width / plane.face_width
        square, slope = self.crowning * step**2, 2.0 * self.crowning * begin * step + there - here
        constant = self.crowning * begin**2 + here - approach[:, np.newaxis, np.newaxis]
        with np.errstate(divide="ignore", invalid="ignore"):
            half = -0.5 * (slope + np.copysign(np.sqrt(slope**2 - 4.0 * square * constant), slope))
            roots = half / square, constant / half
        # A constant f has no roots.
        level = (square == 0.0) & (slope == 0.0)
        first = np.where(level, -math.inf, np.fmin(*roots))
        last = np.where(level, math.inf, np.fmax(*roots))
        none = np.where(level, constant >= 0.0, np.isnan(first) | (first >= 1.0) | (last <= 0.0))
        return np.where(none, 1.0, np.clip(first, 0.0, 1.0)), np.where(none, 1.0, np.clip(last, 0.0, 1.0))

    def bends(self, path: ContactPath) -> list[float]:
        """Places g at which the distance of the flanks bends [m]."""
        ends = path.start + self.relief_length, path.end - self.relief_length
        reliefs = self.relief_at_start, self.relief_at_end
        return [place for place, relief in zip(ends, reliefs, strict=True) if relief > 0.0]


@dataclass(frozen=True)
class LineLoads:
    """Loads on the lines of contact at phases of the mesh.

    Arrays have the shape (p, k, s): phases, lines, and nodes of a line; NaN, and lengths of 0, where a line
    has no node.
    """

    # Phases tau, and parts of the phase that belong to them, shape (p,), dimensionless.
    phases: Array = field(metadata=stored("phase", "", "increasing", name="phase"))
    weights: Array = field(metadata=stored("phase", "", "positive", name="phase_weight"))
    # Places g on the path of contact, places y on the face, lengths of the line of the nodes, and line loads.
    places: Array = field(metadata=stored("phase line node", "m", "not negative or NaN", name="place"))
    across: Array = field(metadata=stored("phase line node", "m", "not negative or NaN"))
    length: Array = field(metadata=stored("phase line node", "m", "not negative"))
    load: Array = field(metadata=stored("phase line node", "N/m", "not negative or NaN"))

    def along(self, values: Array) -> Array:
        """Integral of values per length, shape (p, k, s), over all lines at each phase, shape (p,)."""
        return np.asarray(np.nansum(values * self.length, axis=(1, 2)))

    def mean(self, values: Array) -> float:
        """Mean over the phases of values of shape (p,)."""
        return float(values @ self.weights)

    @property
    def normal_force(self) -> Array:
        """Sum of the loads of all lines, shape (p,) [N]."""
        return self.along(self.load)


# Nodes of the phase between two bends, of helical and of spur pairs, and nodes of a line between two bends,
# without and with crowning.
_PHASES, _SPUR_PHASES, _NODES, _CROWNED = 4, 8, 4, 9

# Repetitions by which the ends of the loaded pieces of lines converge.
_PASSES = 3


def line_loads(
    plane: PlaneOfAction,
    normal_force: float,
    law: str,
    *,
    stiffness: float,
    modification: Modification = Modification(),
    accuracy: int = 1,
) -> LineLoads:
    """Line loads over a phase of the mesh.

    ``normal_force``, K F_bn [N]; ``law``, "stiffness", "rigid", "iso" or "tip-relief"; ``stiffness``,
    c_gamma per face width [N/m^2], of the law "stiffness"; ``accuracy``, factor on the numbers of nodes.
    """
    path, spur = plane.path, plane.overlap_ratio == 0.0
    bends = [*path.points.values(), *modification.bends(path)]
    if law == "iso" and not spur:
        over = _BUTTRESSED * math.sin(path.base_helix_angle)
        bends += [path.start + over, path.end - over]
    parts = line_parts(plane, bends, accuracy * (_SPUR_PHASES if spur else _PHASES))
    # An odd number has a node in the middle of the face, where crowned flanks have their smallest film.
    number = accuracy * (_NODES - 1 if modification.crowning == 0.0 else _CROWNED - 1) + 1
    number = 1 if spur and modification.crowning == 0.0 else number
    nodes = line_nodes(parts, number)
    if law != "stiffness":
        load = LAWS[law](plane, nodes, normal_force)
    else:
        for _ in range(0 if modification.none else _PASSES):
            delta = approach(nodes, normal_force, plane, modification, stiffness)
            nodes = line_nodes(parts, number, modification.loaded(parts, delta))
        load = _on_springs(plane, nodes, modification, normal_force, stiffness)
    return LineLoads(nodes.phases, nodes.weights, nodes.places, nodes.across, nodes.length, load)


def single_stiffness(plane: PlaneOfAction, places: Array, stiffness: float) -> Array:
    """Stiffness c of a slice of one pair per face width [N/m^2], at places g on the path of contact [m]."""
    ratio = plane.path.contact_ratio
    b0 = 1.0 / math.sqrt(0.5 * (1.0 + 0.5 * ratio) ** 2 - 1.0)
    xi = (places - plane.path.start) / plane.path.base_pitch
    return 0.5 * stiffness * b0 / math.sin(0.5 * b0 * ratio) * np.cos(b0 * (xi - 0.5 * ratio))


def approach(
    nodes: LineNodes, force: float, plane: PlaneOfAction, modification: Modification, stiffness: float
) -> Array:
    """Approach delta of the flanks at each phase [m], shape (p,)."""
    c = np.nan_to_num(single_stiffness(plane, nodes.places, stiffness))
    opening = np.nan_to_num(modification.opening(plane, nodes.places, nodes.across))
    rows = (nodes.phases.size, -1)
    return _approach((c * nodes.length).reshape(rows), opening.reshape(rows), force)


def _on_springs(
    plane: PlaneOfAction, nodes: LineNodes, modification: Modification, force: float, stiffness: float
) -> Array:
    """Line loads of slices on springs [N/m]."""
    delta = approach(nodes, force, plane, modification, stiffness)[:, np.newaxis, np.newaxis]
    opening = modification.opening(plane, nodes.places, nodes.across)
    return single_stiffness(plane, nodes.places, stiffness) * np.maximum(delta - opening, 0.0)


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
    return np.asarray(delta[np.arange(len(c)), np.argmax(fits, axis=1)])


def _rigid(_plane: PlaneOfAction, nodes: LineNodes, force: float) -> Array:
    """Equal loads on all lines [N/m]."""
    present = np.sum(nodes.length, axis=(1, 2), keepdims=True)
    return np.where(np.isnan(nodes.places), np.nan, force / present)


def _shares(plane: PlaneOfAction, nodes: LineNodes, force: float) -> Array:
    """Line loads of the shares of ISO/TS 6336-22 without relief [N/m]."""
    beta, places = min(1.0, plane.overlap_ratio), nodes.places
    spur = _trapezoid(plane, places, at_end=1.0 / 3.0)
    share = spur
    if beta > 0.0:
        sine = math.sin(plane.path.base_helix_angle)
        helical = _buttressing(plane, places, 1.0 + (_BUTTRESSING - 1.0) * beta, _BUTTRESSED * sine)
        share = (1.0 - beta) * spur + beta * helical / plane.path.contact_ratio
    return share * _per_face(plane, force)


def _tip_relief(plane: PlaneOfAction, nodes: LineNodes, force: float) -> Array:
    """Line loads of a spur pair with as much relief as deflection [N/m]."""
    if plane.overlap_ratio > 0.0:
        raise InputError(
            "gear.operation.load_sharing",
            got="'tip-relief' for helical gears",
            takes="'stiffness' with gear.tip_relief and gear.tip_relief_length",
        )
    return _trapezoid(plane, nodes.places, at_end=0.0) * _per_face(plane, force)


def _per_face(plane: PlaneOfAction, force: float) -> float:
    """Load of a single line that is as long as the face [N/m]."""
    return force * math.cos(plane.path.base_helix_angle) / plane.face_width


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


# Laws without the stiffness of the teeth.
LAWS: Mapping[str, Callable[..., Array]] = {
    "rigid": _rigid,
    "iso": _shares,
    "tip-relief": _tip_relief,
}


# Side of a point on which its line load is taken: B and D belong to the single contact of a spur pair.
SIDES: Mapping[str, float] = {"A": 1.0, "B": 1.0, "C": 0.0, "D": -1.0, "E": -1.0}

# Distance of nodes that are at a point, in base pitches.
_AT_POINT = 2e-6


def load_at(plane: PlaneOfAction, loads: LineLoads, place: float, side: float = 0.0) -> float:
    """Mean over phases and face of the line load at A, B, C, D or E [N/m]. ``place``, its place g; ``side``,
    1 just behind the place, -1 just before it, 0 on both sides.
    """
    ahead = (loads.places - place) / plane.path.base_pitch
    near = (np.abs(ahead) <= _AT_POINT) & (side * ahead >= 0.0)
    # Lines of a helical pair pass the place one after the other along the face, lines of a spur pair at once.
    share = loads.length if plane.overlap_ratio == 0.0 else 1.0
    weights = near * share * loads.weights[:, np.newaxis, np.newaxis]
    total = float(np.sum(weights))
    return float(np.sum(weights * np.nan_to_num(loads.load))) / total if total > 0.0 else 0.0
