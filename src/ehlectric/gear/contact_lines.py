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

import numpy as np

from ehlectric.arrays import Array, Mask
from ehlectric.formulas.polynomials import lobatto_nodes, lobatto_weights
from ehlectric.gear.contact_path import ContactPath

# Least distance of two phases between which the mesh is integrated. Distances of nodes in base pitches: from
# a phase at which a line of a spur pair appears or disappears as a whole, and from a place at which a load
# jumps.
_CLOSE, _GAP, _INSIDE = 1e-7, 1e-6, 1e-9

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
    """Parts of the lines of contact between places where an integrand bends, at phases of the mesh.

    Arrays have the shape (p, k, z): phases, lines, and parts of the path of contact between two bends.
    """

    plane: PlaneOfAction
    phases: Array  # tau, shape (p,)
    weights: Array  # parts of the phase, shape (p,); their sum is 1
    begin: Array  # x at y = 0 of each line [m], shape (p, k)
    ends: Array  # x of the bends [m], shape (z + 1,)
    low: Array  # y where each part starts [m]
    width: Array  # difference of y over each part [m]; 0 for no part

    def places(self, across: Array) -> Array:
        """Places g [m] at y = ``across`` [m], shape (p, k, z, ...), kept inside of their parts."""
        path, more = self.plane.path, (np.newaxis,) * (across.ndim - 3)
        x = self.begin[(..., np.newaxis, *more)] + math.tan(path.base_helix_angle) * across
        inset = _INSIDE * path.base_pitch
        ends = self.ends[(..., *more)]
        return path.start + np.clip(x, ends[:-1] + inset, ends[1:] - inset)


@dataclass(frozen=True)
class LineNodes:
    """Nodes on the lines of contact at phases of the mesh, with which integrals over the lines are sums.

    Arrays have the shape (p, k, s): phases, lines, and nodes of a line; NaN, and lengths of 0, where a line
    has no node.
    """

    phases: Array  # tau, shape (p,)
    weights: Array  # parts of the phase, shape (p,); their sum is 1
    places: Array  # g on the path of contact [m]
    across: Array  # y on the face [m]
    length: Array  # length of the line that belongs to a node [m]


def line_parts(plane: PlaneOfAction, bends: Iterable[float], phases: int) -> LineParts:
    """Parts of the lines of contact. ``bends``, places g at which the integrand bends [m], next to both ends
    of the path; ``phases``, nodes between two phases at which it bends.
    """
    path = plane.path
    inner = [min(max(place - path.start, 0.0), path.length) for place in bends]
    ends = np.array(sorted({0.0, path.length, *inner}))
    tau, weights = _phase_nodes(ends / path.base_pitch, plane.overlap_ratio, phases)
    numbers = np.arange(-math.ceil(plane.overlap_ratio), math.ceil(path.contact_ratio))
    begin = (tau[:, np.newaxis] + numbers) * path.base_pitch
    if plane.overlap_ratio == 0.0:
        # A line is at one place, and the bends of its path do not divide it.
        ends = np.array([0.0, path.length])
        limits = np.where(ends <= begin[..., np.newaxis], -math.inf, math.inf)
    else:
        limits = (ends - begin[..., np.newaxis]) / math.tan(path.base_helix_angle)
    limits = np.clip(limits, 0.0, plane.face_width)
    return LineParts(plane, tau, weights, begin, ends, limits[..., :-1], np.diff(limits, axis=-1))


def line_nodes(parts: LineParts, number: int, loaded: tuple[Array, Array] | None = None) -> LineNodes:
    """Nodes on the lines of contact.

    ``number``, nodes of each part; ``loaded``, begin and end of its loaded piece, 0 to 1 within the part,
    shape (p, k, z); equal ones for none. The pieces without a load have two nodes. Nodes are dense where a
    load begins at zero, as the width of a contact grows with the root of the load.
    """
    at, weight = _rule(number)
    if loaded is None:
        share = np.broadcast_to(weight, (*parts.width.shape, number))
    else:
        first, last = (edge[..., np.newaxis] for edge in loaded)
        at, share = _from_zero(at, weight, first > 0.0, last < 1.0)
        rest = 1.0 - last
        pieces = _UNLOADED * first, first + (last - first) * at, 1.0 - np.flip(_UNLOADED) * rest
        at = np.concatenate(pieces, axis=-1)
        halves = np.full(_UNLOADED.size, 1.0 / _UNLOADED.size)
        share = np.concatenate([halves * first, (last - first) * share, halves * rest], axis=-1)
    width = parts.width[..., np.newaxis]
    across = parts.low[..., np.newaxis] + width * at
    length = width * share / math.cos(parts.plane.path.base_helix_angle)
    inside = length > 0.0
    shape = (*parts.begin.shape, -1)
    return LineNodes(
        parts.phases,
        parts.weights,
        np.where(inside, parts.places(across), math.nan).reshape(shape),
        np.where(inside, across, math.nan).reshape(shape),
        length.reshape(shape),
    )


def _from_zero(at: Array, weight: Array, low: Mask, high: Mask) -> tuple[Array, Array]:
    """Nodes and weights on 0 to 1 that are dense at the low and at the high end, where these are true."""
    both, rest = low & high, 1.0 - at
    moved = np.where(low, at**2, np.where(high, 1.0 - rest**2, at))
    slope = np.where(low, 2.0 * at, np.where(high, 2.0 * rest, 1.0))
    moved = np.where(both, at**2 * (3.0 - 2.0 * at), moved)
    return moved, weight * np.where(both, 6.0 * at * rest, slope)


def _phase_nodes(ends: Array, overlap: float, each: int) -> tuple[Array, Array]:
    """Nodes and weights of the phase. ``ends``, places on the path in base pitches at which the integrand
    bends as an end of a line passes them.

    Lines of a spur pair appear and disappear as a whole: its nodes are on both sides of these phases.
    """
    bends = np.sort(np.concatenate([ends, ends - overlap]) % 1.0)
    bends = bends[np.diff(bends, prepend=-1.0) > _CLOSE]
    bends = np.append(bends[bends < 1.0 - _CLOSE], 1.0)
    at, part = _rule(each)
    begin, width = bends[:-1, np.newaxis], np.diff(bends)[:, np.newaxis]
    weights = width * part
    if overlap == 0.0:
        gap = np.minimum(_GAP, 0.01 * width)
        return np.ravel(begin + np.clip(width * at, gap, width - gap)), np.ravel(weights)
    # The first node of an interval is the last one of the interval before.
    weights[:, 0] += np.roll(weights[:, -1], 1)
    return np.ravel(begin + width * at[:-1]), np.ravel(weights[:, :-1])


def _rule(nodes: int) -> tuple[Array, Array]:
    """Nodes and weights of Gauss and Lobatto on 0 to 1; the middle for one node."""
    if nodes == 1:
        return np.array([0.5]), np.ones(1)
    at = lobatto_nodes(nodes - 1)
    return at, lobatto_weights(at)
