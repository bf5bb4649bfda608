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

All other laws are shares X over the path of contact. Equilibrium scales them at each phase:

    w = K F_bn X/(integral of X over all lines)

"rigid": X = 1, the same load on all lines.

"iso": shares of ISO/TS 6336-22: of spur pairs 1/3 at A and E, 2/3 at B and D outside the single contact, and
1 within; of helical pairs with eps_beta of at least 1 the share 1/eps_alpha, with 1.3 times this at A and E
that falls over 0.2 sin beta_b mm; interpolated linearly in eps_beta below 1. Shares of spur pairs add up
to 1, so that w = K X F_bn/b; the sum of the shares of a helical pair varies over the phase.

"tip-relief": shares of a spur pair whose relief equals its deflection: 0 at A and E, 1 at B and D.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property, lru_cache
from itertools import pairwise

import numpy as np

from ehlectric.arrays import Array, IntArray
from ehlectric.errors import InputError
from ehlectric.gear.contact_lines import (
    LineParts,
    PlaneOfAction,
    line_nodes,
    line_parts,
    nodes_within,
    with_unloaded,
)
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

    def bends(self, path: ContactPath) -> list[float]:
        """Places g at which the distance of the flanks bends [m]."""
        ends = path.start + self.relief_length, path.end - self.relief_length
        reliefs = self.relief_at_start, self.relief_at_end
        return [place for place, relief in zip(ends, reliefs, strict=True) if relief > 0.0]


@dataclass(frozen=True)
class LineLoads:
    """Loads on the lines of contact over a phase of the mesh.

    Arrays over the nodes of the lines have the shape (n,), in the order of their phases.
    """

    # Phases tau, and parts of the phase that belong to them, shape (p,), dimensionless.
    phases: Array = field(metadata=stored("phase", "", "increasing", name="phase"))
    weights: Array = field(metadata=stored("phase", "", "positive", name="phase_weight"))
    # Number of the phase and of the line of a node.
    phase: IntArray = field(metadata=stored("node", "", "whole", name="node_phase"))
    line: IntArray = field(metadata=stored("node", "", "finite", name="node_line"))
    # Places g on the path of contact, places y on the face, lengths of the line of the nodes, and line loads.
    places: Array = field(metadata=stored("node", "m", "positive", name="place"))
    across: Array = field(metadata=stored("node", "m", "not negative"))
    length: Array = field(metadata=stored("node", "m", "positive"))
    load: Array = field(metadata=stored("node", "N/m", "not negative"))

    def along(self, values: Array) -> Array:
        """Integral of values per length, shape (n,), over all lines at each phase, shape (p,); NaN is 0."""
        part = values * self.length
        part[np.isnan(part)] = 0.0
        return np.asarray(np.bincount(self.phase, part, self.phases.size), dtype=float)

    def least(self, values: Array) -> Array:
        """Least of values of shape (n,) at each phase, shape (p,), without NaN."""
        return np.asarray(np.fmin.reduceat(values, np.searchsorted(self.phase, np.arange(self.phases.size))))

    def least_over_phase(self, values: Array) -> tuple[Array, Array]:
        """Phases in increasing order, and the least of values of shape (n,) there, each of shape (q,).

        A line is determined by its place tau + k. The least value of each line is interpolated linearly over
        this place, so that the result contains the phases at which another line has the least value, and
        both sides of a phase at which a line appears or disappears.
        """
        starts = self._starts()
        place = self.phases[self.phase[starts]] + self.line[starts]
        least = np.fmin.reduceat(values, starts)
        order = np.argsort(place)
        place, least = place[order], least[order]
        known = ~np.isnan(least)
        place, least = place[known], least[known]
        first, last = place[0], place[-1]
        ends = [(first - _NEXT) % 1.0, first % 1.0, last % 1.0, (last + _NEXT) % 1.0]
        # Between the phases on both sides of a jump there is no value.
        after = np.searchsorted(self.phases, _BETWEEN)
        cycle = np.concatenate([self.phases[-1:] - 1.0, self.phases, self.phases[:1] + 1.0])
        between = _BETWEEN[cycle[after + 1] - cycle[after] > _NEXT]
        phases = np.unique(np.concatenate([self.phases, between, ends]))
        lines = phases + np.arange(math.floor(first), math.ceil(last) + 1.0)[:, np.newaxis]
        there = np.min(np.interp(lines, place, least, left=math.inf, right=math.inf), axis=0)
        met = np.isfinite(there)
        return phases[met], np.asarray(there[met])

    def mean(self, values: Array) -> float:
        """Mean over the phases of values of shape (p,)."""
        return float(values @ self.weights)

    @property
    def normal_force(self) -> Array:
        """Sum of the loads of all lines, shape (p,) [N]."""
        return self.along(self.load)

    def lines(self) -> Iterator[slice]:
        """Yield the nodes of each line at each phase, in the order of their places on the face."""
        for start, end in pairwise([*self._starts().tolist(), self.phase.size]):
            yield slice(start, end)

    def _starts(self) -> IntArray:
        """Numbers of the first nodes of each line at each phase."""
        phase, line = self.phase, self.line
        following = np.flatnonzero((phase[1:] != phase[:-1]) | (line[1:] != line[:-1]))
        return np.concatenate([[0], following + 1])


# Phases between 0 and 1 at which the least value of all lines is interpolated, and distance of a phase from
# the first or the last phase of a line, which exceeds the distance of the nodes on both sides of a jump.
_BETWEEN, _NEXT = np.arange(64) / 64.0, 3e-6


# Nodes of a line between two bends, without and with crowning. An odd number has a node in the middle of the
# face, where crowned flanks of a spur pair have their smallest film.
_NODES, _CROWNED = 4, 9


@dataclass(frozen=True)
class OpenPieces:
    """Pieces of lines of contact that relief and crowning keep apart, arrays of shape (n,)."""

    phase: IntArray  # number of the phase
    places: Array  # place g of the middle [m]
    length: Array  # length along the line [m]
    # Distances of the flanks at both ends of the piece, between which they are nearly linear [m].
    first_gap: Array
    last_gap: Array


@dataclass(frozen=True, eq=False)
class Slices:
    """Parts of the lines of contact with springs for a stiffness c_gamma of 1 per face width [N/m^2].

    Only the geometry determines them, so that many operating points share them.
    """

    plane: PlaneOfAction
    law: str
    parts: LineParts
    # Coefficients of the distance f of the flanks [m], a polynomial of the place 0 to 1 in a part.
    opening: tuple[Array, Array, Array]
    number: int  # nodes of a part of a line

    def along(self, at: Array, share: Array) -> tuple[Array, Array]:
        """Places g and lengths of the line [m] at nodes within the parts, each of shape (m, n)."""
        width = self.parts.width[:, np.newaxis]
        places = self.parts.places(self.parts.low[:, np.newaxis] + width * at)
        return places, width * share / math.cos(self.plane.path.base_helix_angle)

    def distance(self, at: Array) -> Array:
        """Distance f of the flanks [m] at places within the parts, shape (m, n)."""
        constant, slope, square = (values[:, np.newaxis] for values in self.opening)
        return np.asarray(constant + at * (slope + at * square))

    def springs(self, at: Array, share: Array) -> tuple[Array, Array]:
        """Sums of c l [m] and of c l f [m^2] over the nodes at each phase, each of shape (p,)."""
        places, length = self.along(at, share)
        spring = single_stiffness(self.plane, places, 1.0) * length
        return self._sum(spring), self._sum(spring * self.distance(at))

    def _sum(self, values: Array) -> Array:
        """Sums of values of shape (m, n) over the nodes at each phase, shape (p,)."""
        number = self.parts.phases.size
        return np.bincount(self.parts.phase, np.sum(values, axis=1), number).astype(float)

    @cached_property
    def shares(self) -> Array:
        """Integrals of the shares X over all lines at each phase, shape (p,) [m]."""
        size = self.parts.width.size
        places, length = self.along(*nodes_within(self.number, (np.zeros(size), np.ones(size))))
        return self._sum(LAWS[self.law](self.plane, places) * length)

    @cached_property
    def whole(self) -> tuple[Array, Array]:
        """Sums of ``springs`` over the whole lines."""
        size = self.parts.width.size
        nodes = nodes_within(max(self.number, _NODES), (np.zeros(size), np.ones(size)))
        return self.springs(*nodes)


@lru_cache(maxsize=64)
def slices_of(plane: PlaneOfAction, law: str, modification: Modification, accuracy: int) -> Slices:
    """Slices of the teeth for a law of the load; arguments of ``line_loads``."""
    path, spur = plane.path, plane.overlap_ratio == 0.0
    bends, further = modification.bends(path), [path.pitch_point]
    if spur:
        bends = [*bends, *path.points.values()]
    elif law == "iso":
        over = _BUTTRESSED * math.sin(path.base_helix_angle)
        further += [path.points["B"], path.points["D"], path.start + over, path.end - over]
    parts = line_parts(plane, bends, further, accuracy)
    # The load of a spur pair without crowning is the same on the whole face.
    number = 1 if spur else (_NODES - 1) * accuracy + 1
    if modification.crowning > 0.0:
        number = (_CROWNED - 1) * accuracy + 1
    return Slices(plane, law, parts, _opening(plane, parts, modification), number)


def _opening(
    plane: PlaneOfAction, parts: LineParts, modification: Modification
) -> tuple[Array, Array, Array]:
    """Coefficients of the distance f of the flanks [m], a polynomial of the place 0 to 1 in a part."""
    width, crowning = plane.face_width, modification.crowning
    across = np.stack([parts.low, parts.low + parts.width], axis=1)
    relief = modification.relief(plane.path, parts.places(across))
    first, step = 2.0 * parts.low / width - 1.0, 2.0 * parts.width / width
    constant, slope = relief[:, 0], relief[:, 1] - relief[:, 0]
    return constant + crowning * first**2, slope + 2.0 * crowning * first * step, crowning * step**2


@dataclass(frozen=True)
class Sharing:
    """Law of the load of a gear pair, with the state of the mesh at each phase."""

    plane: PlaneOfAction
    slices: Slices
    force: float  # K F_bn [N]
    law: str
    stiffness: float  # c_gamma per face width [N/m^2]
    modification: Modification
    accuracy: int = 1  # factor on the numbers of nodes

    @classmethod
    def of(
        cls,
        plane: PlaneOfAction,
        force: float,
        law: str,
        *,
        stiffness: float,
        modification: Modification = Modification(),
        accuracy: int = 1,
    ) -> Sharing:
        """Law of the load; arguments of ``line_loads``."""
        if law not in ("stiffness", *LAWS):
            raise ValueError(law)
        slices = slices_of(plane, law, modification, accuracy)
        return cls(plane, slices, force, law, stiffness, modification, accuracy)

    @property
    def parts(self) -> LineParts:
        """Parts of the lines of contact."""
        return self.slices.parts

    @property
    def number(self) -> int:
        """Nodes of a part of a line."""
        return self.slices.number

    def _loaded(self, delta: Array) -> tuple[tuple[Array, Array], tuple[Array, Array]]:
        """Start and end of the piece of each part in which f is below delta, 0 to 1; equal ones for none.
        Then the places at which f is delta, also outside of the part.
        """
        constant, slope, square = self.slices.opening
        constant = constant - delta[self.parts.phase]
        with np.errstate(divide="ignore", invalid="ignore"):
            half = -0.5 * (slope + np.copysign(np.sqrt(slope**2 - 4.0 * square * constant), slope))
            roots = half / square, constant / half
        # A constant f has no roots.
        level = (square == 0.0) & (slope == 0.0)
        first = np.where(level, -math.inf, np.fmin(*roots))
        last = np.where(level, math.inf, np.fmax(*roots))
        none = np.where(level, constant >= 0.0, np.isnan(first) | (first >= 1.0) | (last <= 0.0))
        ends = (np.minimum(np.maximum(place, 0.0), 1.0) for place in (first, last))
        start, end = (np.where(none, 1.0, place) for place in ends)
        return (start, end), (first, last)

    def _delta(self, at: Array, share: Array) -> Array:
        """Approach delta at each phase [m], shape (p,), of nodes that all carry load."""
        return self._approach(*self.slices.springs(at, share))

    def _approach(self, springs: Array, moments: Array) -> Array:
        """Approach delta at each phase [m], shape (p,), from sums of ``Slices.springs``."""
        return np.asarray((self.force / self.stiffness + moments) / springs)

    @cached_property
    def _solved(self) -> tuple[Array, Array, tuple[Array, Array], Array]:
        """Nodes within the parts, places and shares of shape (m, n), the loaded pieces, and delta at each
        phase; without the law "stiffness", the integral of X over all lines at each phase instead of delta.

        The force is a convex function of delta, so that the steps of Newton fall towards its root.
        """
        whole = np.zeros(self.parts.width.size), np.ones(self.parts.width.size)
        nodes = nodes_within(self.number, whole)
        if self.law != "stiffness":
            return *nodes, whole, self.slices.shares
        if self.modification.none:
            return *nodes, whole, self._delta(*nodes)
        delta, loaded = self._approach(*self.slices.whole), whole
        for _ in range(_STEPS):
            loaded, zeros = self._loaded(delta)
            nodes = nodes_within(self.number, loaded, zeros)
            before, delta = delta, self._delta(*nodes)
            if np.all(np.abs(delta - before) <= _SETTLED * delta):
                break
        return *nodes, loaded, delta

    @property
    def state(self) -> Array:
        """Approach delta of the flanks, or integral of the shares over all lines, at each phase [m]."""
        return self._solved[-1]

    @property
    def opened(self) -> OpenPieces:
        """Pieces of the lines in which the flanks do not touch: none without relief and crowning."""
        _, _, (start, end), state = self._solved
        if self.modification.none:
            # All flanks touch.
            start, end = np.zeros_like(start), np.ones_like(end)
        # Both ends of the pieces before and behind the loaded one; a part without a load is the first piece.
        last = np.where(start >= 1.0, 1.0, end)
        at = np.stack([np.zeros_like(start), start, last, np.ones_like(end)], axis=1)
        gap = np.maximum(self.slices.distance(at) - state[self.parts.phase][:, np.newaxis], 0.0)
        low, width = self.parts.low[:, np.newaxis], self.parts.width[:, np.newaxis]
        middle = low + 0.5 * width * (at[:, 0::2] + at[:, 1::2])
        length = width * (at[:, 1::2] - at[:, 0::2]) / math.cos(self.plane.path.base_helix_angle)
        inside = length > 0.0
        return OpenPieces(
            np.broadcast_to(self.parts.phase[:, np.newaxis], inside.shape)[inside],
            self.parts.places(middle)[inside],
            length[inside],
            gap[:, 0::2][inside],
            gap[:, 1::2][inside],
        )

    def load(self, places: Array, across: Array, state: Array) -> Array:
        """Line loads [N/m] at places g and y [m] and states of the mesh, which broadcast to a shape (...)."""
        if self.law != "stiffness":
            return np.asarray(self.force * LAWS[self.law](self.plane, places) / state)
        opening = self.modification.opening(self.plane, places, across)
        spring = single_stiffness(self.plane, places, self.stiffness)
        return np.asarray(spring * np.maximum(state - opening, 0.0))

    def loads(self, *, unloaded: bool = True) -> LineLoads:
        """Line loads at the nodes; ``unloaded``, whether also at nodes without a load."""
        at, share, loaded, state = self._solved
        if unloaded and not self.modification.none:
            at, share = with_unloaded(at, share, loaded)
        nodes = line_nodes(self.parts, at, share)
        load = self.load(nodes.places, nodes.across, state[nodes.phase])
        at_phases = self.parts.phases, self.parts.weights
        loads = LineLoads(*at_phases, load=load, **vars(nodes))
        if self.law == "stiffness":
            # Where the load starts at zero, a rounding of delta loads or unloads a node.
            load *= (self.force / loads.normal_force)[nodes.phase]
        return loads


# Largest number of steps of Newton, and relative change of delta at which they end: the error is then about
# its square.
_STEPS, _SETTLED = 50, 1e-6


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
    law_of = Sharing.of(
        plane, normal_force, law, stiffness=stiffness, modification=modification, accuracy=accuracy
    )
    return law_of.loads()


def single_stiffness(plane: PlaneOfAction, places: Array, stiffness: float) -> Array:
    """Stiffness c of a slice of one pair per face width [N/m^2], at places g on the path of contact [m]."""
    ratio = plane.path.contact_ratio
    b0 = 1.0 / math.sqrt(0.5 * (1.0 + 0.5 * ratio) ** 2 - 1.0)
    xi = (places - plane.path.start) / plane.path.base_pitch
    return 0.5 * stiffness * b0 / math.sin(0.5 * b0 * ratio) * np.cos(b0 * (xi - 0.5 * ratio))


def _rigid(_plane: PlaneOfAction, places: Array) -> Array:
    """Equal loads on all lines."""
    return np.ones_like(places)


def _shares(plane: PlaneOfAction, places: Array) -> Array:
    """Shares of ISO/TS 6336-22 without relief."""
    beta = min(1.0, plane.overlap_ratio)
    share = _trapezoid(plane, places, at_end=1.0 / 3.0)
    if beta > 0.0:
        sine = math.sin(plane.path.base_helix_angle)
        helical = _buttressing(plane, places, 1.0 + (_BUTTRESSING - 1.0) * beta, _BUTTRESSED * sine)
        share = (1.0 - beta) * share + beta * helical / plane.path.contact_ratio
    return share


def _tip_relief(plane: PlaneOfAction, places: Array) -> Array:
    """Shares of a spur pair with as much relief as deflection."""
    if plane.overlap_ratio > 0.0:
        raise InputError(
            "gear.operation.load_sharing",
            got="'tip-relief' for helical gears",
            takes="'stiffness' with gear.tip_relief and gear.tip_relief_length",
        )
    return _trapezoid(plane, places, at_end=0.0)


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
    return np.where(inside, 1.0, line)


def _buttressing(plane: PlaneOfAction, places: Array, most: float, over: float) -> Array:
    """Factor of the load at the ends of the path of a helical pair, which falls to 1 over a length [m]."""
    nearest = np.minimum(places - plane.path.start, plane.path.end - places)
    return 1.0 + (most - 1.0) * np.maximum(0.0, 1.0 - nearest / over)


# Shares X at places g of shape (...), of the laws without the stiffness of the teeth.
LAWS: Mapping[str, Callable[..., Array]] = {
    "rigid": _rigid,
    "iso": _shares,
    "tip-relief": _tip_relief,
}


# Side of a point on which its line load is taken: B and D belong to the single contact of a spur pair.
SIDES: Mapping[str, float] = {"A": 1.0, "B": 1.0, "C": 0.0, "D": -1.0, "E": -1.0}

# Distance of a place on one side of a point from it, in base pitches, and places on the face at which a load
# is averaged.
_ASIDE, _ON_FACE = 2e-6, 16


def loads_at_points(sharing: Sharing, *, other: bool = False) -> Array:
    """Mean over the face of the line load at A, B, C, D and E [N/m], shape (5,); ``other``, on the other side
    of B and D.
    """
    places, across, phase = _around_points(sharing.plane, other=other)
    state = np.interp(phase, sharing.parts.phases, sharing.state, period=1.0)
    return np.asarray(np.mean(sharing.load(places, across, state), axis=1))


@lru_cache(maxsize=64)
def _around_points(plane: PlaneOfAction, *, other: bool) -> tuple[Array, Array, Array]:
    """Places g next to A to E, shape (5, 1), places y on the face, shape (y,), and phases at which lines of
    contact pass both, shape (5, y).
    """
    path = plane.path
    sides = {**SIDES, "B": -SIDES["B"], "D": -SIDES["D"]} if other else SIDES
    places = np.array([place + sides[name] * _ASIDE * path.base_pitch for name, place in path.points.items()])
    across = plane.face_width * np.arange(0.5, _ON_FACE) / _ON_FACE
    # Lines of a helical pair pass the place one after the other along the face.
    begin = (places - path.start)[:, np.newaxis] - math.tan(path.base_helix_angle) * across
    return places[:, np.newaxis], across, begin / path.base_pitch % 1.0
