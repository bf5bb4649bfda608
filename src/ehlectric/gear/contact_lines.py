"""Lines of contact of a gear pair in its plane of action. SI units.

In the plane of action, with x along the path of contact from A and y along the face, the lines of contact are

    x = (tau + k) p_bt + y tan beta_b        for all whole k, inside 0 <= x <= g_alpha and 0 <= y <= b.

tau is the phase of the mesh, which grows by 1 while one tooth passes. The area of the plane over the distance
of two lines gives the mean length over a phase, eps_alpha b/cos beta_b. With the fractional parts n_a of
eps_alpha and n_b of eps_beta, the least and the greatest length, divided by the mean length, are

    1 - n_a n_b/(eps_alpha eps_beta)                      if n_a + n_b <= 1
    1 - (1 - n_a)(1 - n_b)/(eps_alpha eps_beta)           otherwise
    1 + min(n_a, n_b) (1 - max(n_a, n_b))/(eps_alpha eps_beta)

A spur pair has the limit of these for eps_beta to 0: floor(eps_alpha) and ceil(eps_alpha) lines of length b.

Integrals along the lines and over the phase are sums over Gauss-Lobatto nodes between all places where the
integrand bends, so that both ends of each line are nodes.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from ehlectric.arrays import Array, IntArray
from ehlectric.formulas.polynomials import lobatto_nodes, lobatto_weights
from ehlectric.gear.contact_path import ContactPath

# Least distance of two phases between which the mesh is integrated. Distances of nodes in base pitches: from
# a phase at which a line appears or disappears, and from a place at which a load jumps.
_CLOSE, _GAP, _INSIDE = 1e-7, 1e-6, 1e-9

# Nodes of a helical pair over the phase: two at least of an interval, and one of an interval that is narrow.
# Nodes of a spur pair between two phases at which the mesh changes.
_PHASES, _NARROW, _SPUR_PHASES = 4, 1e-3, 8

# Largest distance of a place without load from a loaded piece, over its length: nodes no longer depend on it.
_DISTANT = 1e4

# Nodes of a piece without a load: its outer end, and a place next to the load.
_UNLOADED = np.array([0.0, 0.99])


@dataclass(frozen=True)
class PlaneOfAction:
    """Plane of action, a rectangle: path of contact times common face width."""

    path: ContactPath
    face_width: float  # b [m]

    @property
    def overlap_ratio(self) -> float:
        """Overlap ratio eps_beta, dimensionless."""
        return self.face_width * math.tan(self.path.base_helix_angle) / self.path.base_pitch

    @property
    def mean_length(self) -> float:
        """Mean length of all lines of contact over a phase [m]."""
        return self.path.contact_ratio * self.face_width / math.cos(self.path.base_helix_angle)

    @property
    def extreme_lengths(self) -> tuple[float, float]:
        """Least and greatest length of all lines of contact [m]."""
        alpha, beta = self.path.contact_ratio, self.overlap_ratio
        part_a = alpha - math.floor(alpha)
        if beta == 0.0:
            return math.floor(alpha) * self.face_width, math.ceil(alpha) * self.face_width
        part_b = beta - math.floor(beta)
        least = part_a * part_b if part_a + part_b <= 1.0 else (1.0 - part_a) * (1.0 - part_b)
        most = min(part_a, part_b) * (1.0 - max(part_a, part_b))
        mean = self.mean_length
        return mean * (1.0 - least / (alpha * beta)), mean * (1.0 + most / (alpha * beta))

    def length(self, phase: float) -> float:
        """Length of all lines of contact at a phase [m], exactly.

        Examples
        --------
        One and two pairs of a spur gear with a contact ratio of 1.5 and a face of 10 mm:

        >>> path = ContactPath(1e-3, 4e-3, 7e-3, 4e-3, 20e-3, 0.0)
        >>> [round(1e3 * PlaneOfAction(path, 10e-3).length(phase), 6) for phase in (0.25, 0.75)]
        [20.0, 10.0]
        """
        path, tangent = self.path, math.tan(self.path.base_helix_angle)
        total = 0.0
        for number in range(-math.ceil(self.overlap_ratio) - 1, math.ceil(path.contact_ratio) + 1):
            x = (phase + number) * path.base_pitch
            if tangent == 0.0:
                total += self.face_width if 0.0 <= x < path.length else 0.0
            else:
                begin, end = max(0.0, -x / tangent), min(self.face_width, (path.length - x) / tangent)
                total += max(0.0, end - begin)
        return total / math.cos(path.base_helix_angle)


@dataclass(frozen=True)
class LineParts:
    """Parts of the lines of contact between places where an integrand bends, in the order of their phases.

    Arrays have the shape (m,) of all parts.
    """

    plane: PlaneOfAction
    phases: Array  # tau, shape (p,)
    weights: Array  # parts of the phase, shape (p,); their sum is 1
    phase: IntArray  # number of the phase
    line: IntArray  # number k of the line
    begin: Array  # x at y = 0 of the line [m]
    ends: tuple[Array, Array]  # x of both bends [m]
    low: Array  # y where the part starts [m]
    width: Array  # difference of y over the part [m]

    def places(self, across: Array) -> Array:
        """Places g [m] at y = ``across`` [m], shape (m, ...), kept inside of their parts."""
        path, more = self.plane.path, (slice(None), *(np.newaxis,) * (across.ndim - 1))
        inset = _INSIDE * path.base_pitch
        x = self.begin[more] + math.tan(path.base_helix_angle) * across
        x = np.minimum(np.maximum(x, self.ends[0][more] + inset), self.ends[1][more] - inset)
        return path.start + x


@dataclass(frozen=True)
class LineNodes:
    """Nodes on the lines of contact, with which integrals over the lines are sums; arrays of shape (n,)."""

    phase: IntArray  # number of the phase
    line: IntArray  # number k of the line
    places: Array  # g on the path of contact [m]
    across: Array  # y on the face [m]
    length: Array  # length of the line that belongs to a node [m]


def line_parts(
    plane: PlaneOfAction, bends: Iterable[float], further: Iterable[float] = (), accuracy: int = 1
) -> LineParts:
    """Parts of the lines of contact. ``bends``, places g at which the load bends [m], next to both ends of
    the path; ``further``, places that divide the lines only; ``accuracy``, factor on the number of phases.
    """
    path, spur = plane.path, plane.overlap_ratio == 0.0
    tau, weights = _phase_nodes(_inside(path, bends) / path.base_pitch, plane.overlap_ratio, accuracy)
    numbers = np.arange(-math.ceil(plane.overlap_ratio), math.ceil(path.contact_ratio))
    begin = (tau[:, np.newaxis] + numbers) * path.base_pitch
    if spur:
        # A line is at one place, and the bends of its path do not divide it.
        ends = _inside(path, ())
        limits = np.where(ends <= begin[..., np.newaxis], -math.inf, math.inf)
    else:
        ends = _inside(path, (*bends, *further))
        limits = (ends - begin[..., np.newaxis]) / math.tan(path.base_helix_angle)
    limits = np.minimum(np.maximum(limits, 0.0), plane.face_width)
    width = limits[..., 1:] - limits[..., :-1]
    phase, line, part = np.nonzero(width > 0.0)
    return LineParts(
        plane,
        tau,
        weights,
        phase,
        numbers[line],
        begin[phase, line],
        (ends[part], ends[part + 1]),
        limits[phase, line, part],
        width[phase, line, part],
    )


def _inside(path: ContactPath, bends: Iterable[float]) -> Array:
    """Places x of bends inside of the path, and its ends, in increasing order [m]."""
    inner = {min(max(place - path.start, 0.0), path.length) for place in bends}
    return np.array(sorted({0.0, path.length, *inner}))


def line_nodes(parts: LineParts, at: Array, share: Array) -> LineNodes:
    """Nodes on the lines of contact. ``at``, places 0 to 1 within each part, and ``share``, parts of its
    length that belong to them, each of shape (m, n); a node without a length is omitted.
    """
    width = parts.width[:, np.newaxis]
    across = parts.low[:, np.newaxis] + width * at
    length = width * share / math.cos(parts.plane.path.base_helix_angle)
    inside = length > 0.0
    number = np.count_nonzero(inside, axis=1)
    return LineNodes(
        np.repeat(parts.phase, number),
        np.repeat(parts.line, number),
        parts.places(across)[inside],
        across[inside],
        length[inside],
    )


def nodes_within(
    number: int, loaded: tuple[Array, Array], zeros: tuple[Array, Array] | None = None
) -> tuple[Array, Array]:
    """Places and shares of nodes within the loaded pieces of parts, each of shape (m, n).

    ``number``, nodes of a part; ``loaded``, start and end of its loaded piece, 0 to 1, shape (m,); ``zeros``,
    places before and behind it at which the load is zero, by default at ends inside of the part. Nodes are
    dense near zeros, as the width of a contact grows with the root of the load: with the distances e and e'
    of both zeros from a piece of the length 1, and L = 1 + e + e', the places are x = L sin^2(theta) - e, and
    theta is linear. For distant zeros this is x itself, for one near zero a root law. Nodes move without a
    step as a zero enters the part.
    """
    at, weight = lobatto(number)
    first, last = loaded
    if zeros is None:
        zeros = np.where(first > 0.0, first, -math.inf), np.where(last < 1.0, last, math.inf)
    length = last - first
    with np.errstate(divide="ignore", invalid="ignore"):
        before, behind = (
            np.clip(np.nan_to_num(distance / length, nan=_DISTANT), 0.0, _DISTANT)[:, np.newaxis]
            for distance in (first - zeros[0], zeros[1] - last)
        )
    whole = 1.0 + before + behind
    low, high = np.arcsin(np.sqrt(before / whole)), np.arccos(np.sqrt(behind / whole))
    angle = low + (high - low) * at
    places = whole * np.sin(angle) ** 2 - before
    places = np.minimum(np.maximum(places, 0.0), 1.0)
    share = weight * np.sin(2.0 * angle)
    share /= np.sum(share, axis=1, keepdims=True)
    return first[:, np.newaxis] + length[:, np.newaxis] * places, length[:, np.newaxis] * share


def with_unloaded(at: Array, share: Array, loaded: tuple[Array, Array]) -> tuple[Array, Array]:
    """Nodes of ``nodes_within`` with two further nodes in each piece without a load."""
    first, rest = loaded[0][:, np.newaxis], 1.0 - loaded[1][:, np.newaxis]
    halves = np.full(_UNLOADED.size, 1.0 / _UNLOADED.size)
    places = _UNLOADED * first, at, 1.0 - np.flip(_UNLOADED) * rest
    return np.concatenate(places, axis=1), np.concatenate([halves * first, share, halves * rest], axis=1)


def _phase_nodes(ends: Array, overlap: float, accuracy: int) -> tuple[Array, Array]:
    """Nodes and weights of the phase. ``ends``, places on the path in base pitches at which the load bends as
    an end of a line passes them.

    Lines of a spur pair appear and disappear as a whole: its nodes are on both sides of these phases. A line
    of a helical pair starts and ends as a point, of which nodes are a small part.
    """
    gap, bends = min(_GAP, 0.01 * overlap), ends
    if overlap > 0.0:
        late, early = ends.copy(), ends - overlap
        late[-1] -= gap
        early[0] += gap
        bends = np.concatenate([late, early])
    bends = np.sort(bends % 1.0)
    apart = bends[1:] - bends[:-1] > (min(_CLOSE, 0.1 * gap) if overlap else _CLOSE)
    bends = np.concatenate([bends[:1], bends[1:][apart]])
    bends = np.concatenate([bends[bends < 1.0 - _CLOSE], [1.0]])
    begin, width = bends[:-1], bends[1:] - bends[:-1]
    if overlap == 0.0:
        at, part = lobatto((_SPUR_PHASES - 1) * accuracy + 1)
        wide = width[:, np.newaxis]
        gaps = np.minimum(_GAP, 0.01 * wide)
        tau = begin[:, np.newaxis] + np.clip(wide * at, gaps, wide - gaps)
        return np.ravel(tau), np.ravel(wide * part)
    numbers = accuracy * np.maximum(np.where(width > _NARROW, 2, 1), np.rint(_PHASES * width)).astype(int)
    at, part, before, interval = _around(tuple(numbers.tolist()))
    wide = width[interval]
    return begin[interval] + wide * at, wide * part + width[interval - 1] * before


@lru_cache(maxsize=256)
def _around(numbers: tuple[int, ...]) -> tuple[Array, Array, Array, IntArray]:
    """Nodes of intervals that follow each other around a phase, without the last node of each.

    ``numbers``, nodes of each interval next to the last one. Returns places, weights in the interval and in
    the interval before it, whose last node is the first one of the interval, and numbers of the intervals.
    """
    nodes = [lobatto(number + 1) for number in numbers]
    at, part = (np.concatenate([each[k][:-1] for each in nodes]) for k in (0, 1))
    before = np.zeros_like(at)
    before[np.cumsum(numbers) - numbers] = [weights[-1] for _, weights in nodes[-1:] + nodes[:-1]]
    return at, part, before, np.repeat(np.arange(len(numbers)), numbers)


@lru_cache(maxsize=16)
def lobatto(nodes: int) -> tuple[Array, Array]:
    """Nodes and weights of Gauss and Lobatto on 0 to 1; the middle for one node."""
    if nodes == 1:
        return np.array([0.5]), np.ones(1)
    at = lobatto_nodes(nodes - 1)
    return at, lobatto_weights(at)
