"""Loads of four-point contact ball bearings: equilibrium of inner ring and balls, for many bearings at once.

The model is the model of `ball_loads`, with two arcs per ring: the inner ring is displaced, but not tilted.
Each ball moves in its plane through the bearing's axis, under the forces of up to four Hertz contacts and its
centrifugal force. Friction and the gyroscopic moment are neglected. Arcs have no shoulders, and go on beyond
the middle of their arch; that matters only where an arch has almost no ridge in its middle. SI units.

In the plane of a ball, vectors are (axial, radial). The origin is in the middle of the outer arch, on the
circle of its centres, which lie at -S_o and S_o. The centres of the inner arch lie on either side of its own
middle (u, R), by S_i. The first diagonal, on which the inner ring is pushed by a positive axial load, leads
from -S_o to u + S_i, and the second one from S_o to u - S_i.

For contact stiffnesses and centrifugal forces that are given, the energy is convex in the displacement of the
ring and in the places of the balls. Rounds of iterations take both from the angles of the last round; in each
one Newton's method finds the places of the balls at any displacement, and then the displacement.
"""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import TypeVar

import numpy as np

from ehlectric.arrays import Array, IntArray, Mask, Numbers
from ehlectric.bearing.loads.ball_contacts import Contacts, Spans, stiffness_at
from ehlectric.bearing.loads.ball_loads import BallEquilibrium, BallPoints, laws_of
from ehlectric.bearing.loads.geometry import FourPointBearing
from ehlectric.bearing.loads.ring import AIM, Batch, Operation, balance, chosen, joined, refuse_unbalanced

# Points of operation that are computed together: few enough for the processor's cache.
_BLOCK = 1024

_TINY = np.finfo(float).tiny

# Sign of the contact angle on both diagonals.
_SIDES = np.array([1.0, -1.0])

T = TypeVar("T")


def _take(target: T, points: IntArray, source: T) -> None:
    """Take the values of some points, the last dimension of arrays, from another instance."""
    for each in fields(target):  # type: ignore[arg-type]
        getattr(target, each.name)[..., points] = getattr(source, each.name)


def _spans(ring: Array, place: Array, apart: Array) -> Spans:
    """Vectors between the centres of balls and arcs, shape (2, 2, ...): both rings, both diagonals.

    ``ring`` is the middle of the inner arch and ``place`` the middle of the ball, both (axial, radial), shape
    (2, ...) [m]; ``apart`` is S_i and S_o, shape (2, ...) [m].
    """
    axial, radial = (np.stack([ring[k] - place[k], place[k]])[:, np.newaxis] for k in (0, 1))
    sides = _SIDES.reshape(-1, *[1] * (place.ndim - 1)) * apart[:, np.newaxis]
    axial, radial = np.broadcast_arrays(axial + sides, radial)
    return Spans.of(axial, radial)


def _tangent(contacts: Contacts) -> tuple[tuple[Array, Array, Array], Array]:
    """Stiffness of one ring's contacts with a ball over both diagonals [N/m], and its determinant.

    The components are axial by axial, axial by radial and radial by radial.
    """
    a, b, c = contacts.tangent
    single = contacts.along * contacts.across
    # The determinant of a single contact would lose its digits as a difference.
    both = single[0] + single[1] + a[0] * c[1] + a[1] * c[0] - 2.0 * b[0] * b[1]
    return (a[0] + a[1], b[0] + b[1], c[0] + c[1]), np.asarray(both)


@dataclass(frozen=True)
class _Balls:
    """Balls between the arches of both rings, with contact stiffnesses that are given, shape (..., m)."""

    ring: Array  # middle of the inner arch, axial and radial [m], shape (2, m)
    apart: Array  # S_i and S_o [m], shape (2, m)
    offsets: Array  # lengths at first touch of the inner and outer contacts [m], shape (2, m)
    stiffness: Array  # stiffness K of both rings and both diagonals [N/m^(3/2)], shape (2, 2, m)
    outward: Array  # centrifugal force on each ball [N], shape (m,)
    tolerance: Array  # unbalanced force on each ball that is left [N], shape (m,)

    def contacts(self, place: Array) -> Contacts:
        """Contacts of balls at a place, shape (2, 2, m)."""
        spans = _spans(self.ring, place, self.apart)
        return spans.stiff_contacts(self.offsets[:, np.newaxis], self.stiffness)

    def depth(self, place: Array) -> Array:
        """Largest approach of the four contacts [m], shape (m,); negative where the ball has play."""
        lengths = _spans(self.ring, place, self.apart).length
        return np.asarray(np.max(lengths - self.offsets[:, np.newaxis], axis=(0, 1)))

    @property
    def sunk(self) -> Array:
        """Approach of both outer contacts under only the centrifugal force [m], at the angle of touch."""
        cosine = np.sqrt(1.0 - (self.apart[1] / self.offsets[1]) ** 2)
        both = np.sum(self.stiffness[1], axis=0) * cosine
        return np.asarray((self.outward / both) ** (2.0 / 3.0))

    @property
    def bottom(self) -> Array:
        """Places of balls that only the centrifugal force presses, into the outer arch, shape (2, m) [m]."""
        radial = np.sqrt((self.offsets[1] + self.sunk) ** 2 - self.apart[1] ** 2)
        return np.stack([np.zeros_like(radial), radial])

    def touches_inner(self, place: Array) -> Mask:
        """Whether balls touch the inner ring at a place, shape (m,)."""
        lengths = _spans(self.ring, place, self.apart).length[0]
        return np.asarray(np.max(lengths, axis=0) > self.offsets[0])

    def middle(self) -> Array:
        """Places of the balls in the middle of their play, shape (2, m) [m].

        There the smallest gap of the four contacts is as large as it can be; of balls without play, the
        largest approach is as small as it can be. As both arcs of a ring have the same offset, the closer one
        belongs to the side on which the ball lies. Between the middles of both arches, the contacts to watch
        are the contacts of the longer diagonal. The place sought is the middle of its play, or the place on
        the border of that strip that is as close to both of its arcs.
        """
        side = np.where(self.ring[0] < 0.0, -1.0, 1.0)
        width, height = np.abs(self.ring[0]), np.maximum(self.ring[1], 0.0)
        along = width + self.apart[0] + self.apart[1]
        length = np.maximum(np.hypot(along, height), _TINY)
        out = np.clip(self.offsets[1] + 0.5 * (length - np.sum(self.offsets, axis=0)), 0.0, length)
        free = out * along / length - self.apart[1]
        axial, radial = np.clip(free, 0.0, width), out * height / length
        bound = axial != free
        if bound.any():
            x = (axial + self.apart[1])[bound]
            apart, offsets = along[bound] - x, np.broadcast_to(self.offsets, (2, len(bound)))[:, bound]
            radial[bound] = _between(x, apart, height[bound], offsets)
        return np.stack([side * axial, radial])


def _between(out: Array, back: Array, height: Array, offsets: Array) -> Array:
    """Radial positions that are as close to the inner as to the outer arc [m], for given axial positions.

    ``out`` and ``back`` are the axial distances to the centres of the outer and the inner arc, and ``height``
    is the radial distance of these centres [m]; ``offsets``, shape (2, m).
    """
    low, high = np.zeros_like(height), height
    # Halving ends at the rounding error of a radial distance.
    for _ in range(52):
        middle = 0.5 * (low + high)
        closer = np.hypot(out, middle) - np.hypot(back, height - middle) > offsets[1] - offsets[0]
        low, high = np.where(closer, low, middle), np.where(closer, middle, high)
    return np.asarray(0.5 * (low + high))


# Newton steps of the balls, and shorter trials of a step.
_MOST_STEPS, _MOST_TRIALS = 60, 40

# A step that overshoots is shortened until the force along it is at most this part of the force at its start,
# forward or backward. The ends of the interval for its length move by at least the second part of it: where
# another contact begins on the way, the force is far from linear.
_OVERSHOOT, _SHIFT = 0.5, 0.3

# Relative rounding errors: of the forces on a ball, and of its position over the distance of groove centres.
_ROUNDING, _NUDGE = 1e-15, 6e-16


@dataclass(frozen=True)
class _Pull:
    """Unbalanced forces on m balls at their places, and their stiffness."""

    force: Array  # axial and radial unbalanced force [N], shape (2, m)
    tangent: Array  # stiffness: axial by axial, axial by radial, radial by radial [N/m], shape (3, m)
    moving: Mask  # whether the force exceeds its tolerance and its rounding errors, shape (m,)

    @classmethod
    def of(cls, balls: _Balls, place: Array) -> _Pull:
        """Forces on balls at a place."""
        contacts, reach = balls.contacts(place), np.sum(balls.offsets, axis=0)
        axial, radial = (np.sum(value, axis=1) for value in contacts.components)
        first, mixed, second = (np.sum(value, axis=(0, 1)) for value in contacts.tangent)
        force = np.stack([axial[0] - axial[1], radial[0] - radial[1] + balls.outward])
        size = np.sum(contacts.load, axis=(0, 1)) + balls.outward
        noise = _ROUNDING * size + _NUDGE * reach * (first + second)
        moving = np.max(np.abs(force), axis=0) > np.maximum(balls.tolerance, noise)
        # Contacts that only just touch have no stiffness: this small one keeps the matrix regular.
        little = 1e-13 * size / reach + _TINY
        return cls(force, np.stack([first + little, mixed, second + little]), moving)

    def step(self, longest: Array) -> Array:
        """Newton steps up to a length [m], shape (2, m)."""
        first, mixed, second = self.tangent
        over = 1.0 / np.maximum(first * second - mixed**2, _TINY)
        axial, radial = self.force
        step = np.stack([(second * axial - mixed * radial) * over, (first * radial - mixed * axial) * over])
        return np.asarray(step * np.minimum(1.0, longest / np.maximum(np.hypot(*step), _TINY)))


def _stepped(balls: _Balls, place: Array, pull: _Pull) -> tuple[Array, _Pull]:
    """Places after a Newton step, shortened where it overshoots, and the forces there."""
    step = pull.step(0.5 * np.sum(balls.offsets, axis=0))
    slope = np.sum(pull.force * step, axis=0)
    there = place + step
    pull = _Pull.of(balls, there)
    now = np.sum(pull.force * step, axis=0)
    on = np.flatnonzero(pull.moving & (now < -_OVERSHOOT * slope))
    # Interval of the part of the step, and the forces at its ends divided by the force at the start of the
    # step.
    low, ahead = np.zeros_like(slope), np.ones_like(slope)
    high, back = np.ones_like(slope), now / np.where(slope > 0.0, slope, 1.0)
    for _ in range(_MOST_TRIALS):
        if not on.size:
            break
        share = np.clip(ahead[on] / (ahead[on] - back[on]), _SHIFT, 1.0 - _SHIFT)
        part = low[on] + share * (high[on] - low[on])
        there[:, on] = place[:, on] + part * step[:, on]
        new = _Pull.of(chosen(balls, on), there[:, on])
        _take(pull, on, new)
        force = np.sum(new.force * step[:, on], axis=0) / slope[on]
        before = force > 0.0
        low[on], ahead[on] = np.where(before, part, low[on]), np.where(before, force, ahead[on])
        high[on], back[on] = np.where(before, high[on], part), np.where(before, back[on], force)
        on = on[new.moving & (np.abs(force) > _OVERSHOOT)]
    return there, pull


def _settled(balls: _Balls, start: Array) -> Array:
    """Places of balls in balance, shape (2, m) [m], by Newton's method from ``start``."""
    place, on = start.copy(), np.arange(start.shape[1])
    pull, here = _Pull.of(balls, start), start
    for _ in range(_MOST_STEPS):
        moving = pull.moving
        if not moving.any():
            break
        if not moving.all():
            on, here, pull, balls = on[moving], here[:, moving], chosen(pull, moving), chosen(balls, moving)
        here, pull = _stepped(balls, here, pull)
        place[:, on] = here
    return place


# Places of a last call are good guesses where the largest approach is within this factor of the last one.
_NEAR = 2.0


def _seated(balls: _Balls, guess: Array, depth: Array) -> Array:
    """Places of all balls, shape (2, m) [m]: in balance, or in the middle of their play at rest.

    ``guess`` are places of a last call, with a largest approach ``depth`` there, 0 for balls with play.
    """
    now, bottom, turning = balls.depth(guess), balls.bottom, balls.outward > 0.0
    near = (now < _NEAR * depth) & (now * _NEAR > depth)
    lower = turning & ~balls.touches_inner(bottom)
    place, loaded = np.where(lower, bottom, guess), turning.copy()
    # A ball at rest may have play now.
    unsure = ~lower & ~(near & turning)
    if unsure.any():
        some = chosen(balls, unsure)
        middle = some.middle()
        least = some.depth(middle)
        start = np.where(some.sunk > np.maximum(least, 0.0), bottom[:, unsure], middle)
        place[:, unsure] = np.where(near[unsure] & (least > 0.0), guess[:, unsure], start)
        loaded[unsure] |= least > 0.0
    if loaded.any():
        place[:, loaded] = _settled(chosen(balls, loaded), place[:, loaded])
    return place


@dataclass(frozen=True)
class _Points(BallPoints):
    """Four-point contact bearings and their operation at n points, with the arches of their grooves."""

    endplay: Array  # axial internal clearance [m]
    apart: Array  # S_i and S_o [m], shape (2, 1, n)
    laws: Array  # coefficients of ln K of both rings' contacts, shape (m, 2, 1, 1, n)

    @classmethod
    def of(cls, batch: Batch[FourPointBearing]) -> _Points:
        """Points of a batch."""
        bearing, row = batch.bearing, np.atleast_1d
        return cls(
            # Each ball once.
            **cls.shared(batch, batch.rows[: bearing.elements]),
            endplay=row(bearing.endplay),
            apart=np.stack(np.broadcast_arrays(*map(row, bearing.separations)))[:, np.newaxis],
            laws=laws_of(batch)[:, :, np.newaxis, np.newaxis],
        )

    def stiffness(self, cosines: Array) -> Array:
        """Stiffness K of contacts with cosines of shape (2, 2, elements, n) [N/m^(3/2)]."""
        return stiffness_at(self.laws, cosines)

    def middles(self, ring: Array) -> Array:
        """Middle of the inner arch at each ball, axial and radial [m], shape (2, elements, n)."""
        radial = self.distance + ring[1] * self.cosine + ring[2] * self.sine
        return np.stack([np.broadcast_to(ring[0], radial.shape), radial])

    def summed(self, axial: Array, radial: Array) -> Array:
        """Sum of forces on the ring over the balls, axial, radial and lateral [N], shape (3, n)."""
        values = (axial, radial * self.cosine, radial * self.sine)
        return np.stack([np.add.reduce(value, axis=0) for value in values])

    def forces(self, force: tuple[Array, Array], tangent: tuple[Array, Array, Array]) -> tuple[Array, Array]:
        """Forces on rings, shape (n, 3), and their derivatives, shape (n, 3, 3), from the forces at each
        ball.
        """
        first, mixed, second = tangent
        toward = np.stack(np.broadcast_arrays(self.cosine, self.sine))
        stiffness = np.empty((self.shape[1], 3, 3))
        stiffness[:, 0, 0] = np.add.reduce(first, axis=0)
        stiffness[:, 0, 1:] = stiffness[:, 1:, 0] = np.add.reduce(mixed * toward, axis=1).T
        for i, j in ((0, 0), (0, 1), (1, 1)):
            both = np.add.reduce(second * toward[i] * toward[j], axis=0)
            stiffness[:, 1 + i, 1 + j] = stiffness[:, 1 + j, 1 + i] = both
        return self.summed(*force).T, stiffness


@dataclass(frozen=True)
class _State:
    """Displacements of rings, places of balls, contact angles and centrifugal forces at n points."""

    ring: Array  # axial, radial and lateral displacement [m], shape (3, n)
    place: Array  # axial and radial position of the balls [m], shape (2, elements, n)
    depth: Array  # largest approach of each ball [m], 0 with play, shape (elements, n)
    cosines: Array  # of the contact angles, shape (2, 2, elements, n)
    outward: Array  # centrifugal force on each ball [N], shape (n,)

    @classmethod
    def first(cls, points: _Points) -> _State:
        """Rings roughly in balance, and balls without places; contacts have the free contact angle."""
        shape = points.shape
        cosines = np.array(np.broadcast_to(points.free_cosine, (2, 2, *shape)))
        outward = np.array(np.broadcast_to(points.outward(points.free_cosine), shape[1:]))
        ring = _first_ring(points, points.stiffness(cosines[..., :1, :])[:, 0, 0], outward)
        return cls(ring, np.zeros((2, *shape)), np.zeros(shape), cosines, outward)

    def contacts(self, points: _Points) -> Contacts:
        """Contacts with the stiffnesses of their own angles, shape (2, 2, elements, n)."""
        spans = _spans(points.middles(self.ring), self.place, points.apart)
        return spans.contacts(points.offsets[:, np.newaxis], points.laws)


# Relative imbalance of the rings at first.
_ROUGH = 1e-2


def _first_ring(points: _Points, stiffness: Array, outward: Array) -> Array:
    """Displacements of rings roughly in balance, shape (3, n) [m].

    Both contacts of a diagonal have an approach along the line through their arcs' centres, where the
    approach of the outer contact under the centrifugal force adds to the clearance. ``stiffness`` is the
    stiffness of the inner and the outer contacts, shape (2, n).
    """
    inner, outer = stiffness
    series = (inner ** (-2.0 / 3.0) + outer ** (-2.0 / 3.0)) ** -1.5
    distance, apart = np.sum(points.offsets, axis=0)[0], np.sum(points.apart, axis=0)[0]
    touch = distance + (outward / (2.0 * outer * points.free_cosine)) ** (2.0 / 3.0)

    def reaction(ring: Array, which: IntArray) -> tuple[Array, Array]:
        chosen_points, (axial, radial) = chosen(points, which), chosen(points, which).middles(ring.T)
        sides = np.multiply.outer(_SIDES, np.broadcast_to(apart, touch.shape)[which])[:, np.newaxis]
        spans = Spans.of(*np.broadcast_arrays(axial + sides, radial))
        contacts = spans.stiff_contacts(touch[which], series[which])
        force, tangent = (
            tuple(np.add.reduce(value, axis=0) for value in values)
            for values in (contacts.components, contacts.tangent)
        )
        return chosen_points.forces(force, tangent)

    axial, radial, _ = points.load
    start = np.zeros((points.shape[1], 3))
    start[:, 0] = np.sign(axial) * np.maximum(0.5 * points.endplay, 0.0) * (np.abs(axial) > 0.1 * radial)
    return balance(reaction, points.load.T, start, 0.1 * distance, points.size, _ROUGH)[0].T


def _mean_cosine(contacts: Contacts) -> Array:
    """Mean of cos a over all diagonals, weighted with their load on the inner ring unless all are 0, shape
    (n,); the direction of a diagonal is the mean direction of its two contacts.
    """
    sine, cosine = (np.add.reduce(value, axis=0) for value in (contacts.sine, contacts.cosine))
    length = np.hypot(sine, cosine)
    # Where the directions are opposite, the mean angle is 0 deg.
    cosines = np.where(length > 0.0, cosine / np.maximum(length, _TINY), 1.0)
    loads = contacts.load[0]
    total = np.sum(loads, axis=(0, 1))
    loaded = total > 0.0
    weighted = np.sum(cosines * loads, axis=(0, 1)) / np.where(loaded, total, 1.0)
    return np.asarray(np.where(loaded, weighted, np.mean(cosines, axis=(0, 1))))


class _Reaction:
    """Forces of the balls over displacements of rings, with stiffnesses and centrifugal forces of a state.

    Each call starts from the places of the last one.
    """

    def __init__(self, points: _Points, state: _State, tolerance: Array) -> None:
        self._points, self.place, self.depth = points, state.place.copy(), state.depth.copy()
        self._stiffness = points.stiffness(state.cosines)
        self._outward, self._tolerance = state.outward, tolerance

    def contacts(self, ring: Array, which: IntArray) -> Contacts:
        """Contacts at displacements, shape (3, m), of the points ``which``, shape (2, 2, elements m)."""
        part = chosen(self._points, which)
        shape = part.shape
        apart, offsets = (np.broadcast_to(value, (2, *shape)) for value in (part.apart, part.offsets))
        balls = _Balls(
            ring=part.middles(ring).reshape(2, -1),
            apart=apart.reshape(2, -1),
            offsets=offsets.reshape(2, -1),
            stiffness=self._stiffness[..., which].reshape(2, 2, -1),
            outward=np.broadcast_to(self._outward[which], shape).ravel(),
            tolerance=np.broadcast_to(self._tolerance[which], shape).ravel(),
        )
        last = self.place[..., which].reshape(2, -1), self.depth[:, which].ravel()
        place = _seated(balls, *last)
        contacts = balls.contacts(place)
        self.place[..., which] = place.reshape(2, *shape)
        self.depth[:, which] = np.max(contacts.depth, axis=(0, 1), initial=0.0).reshape(shape)
        return contacts

    def __call__(self, ring: Array, which: IntArray) -> tuple[Array, Array]:
        """Forces on rings at displacements, and their derivatives, as ``balance`` needs them."""
        part, contacts = chosen(self._points, which), self.contacts(ring.T, which)
        axial, radial = (np.sum(value[0], axis=0).reshape(part.shape) for value in contacts.components)
        # Inner and outer contacts in series, A (A + B)^-1 B = (det(A) B + det(B) A)/det(A + B).
        (a, det_a), (b, det_b) = (_tangent(contacts.of(side)) for side in (0, 1))
        mixed = a[0] * b[2] + a[2] * b[0] - 2.0 * a[1] * b[1]
        over = 1.0 / np.maximum(det_a + det_b + mixed, _TINY)
        first, mixed, second = (
            ((det_a * y + det_b * x) * over).reshape(part.shape) for x, y in zip(a, b, strict=True)
        )
        return part.forces((axial, radial), (first, mixed, second))


# Change of the cosines of the contact angles at convergence; each round reduces it by two or three digits.
_CLOSE = 1e-12
_MOST_ROUNDS = 30

# Imbalance of the forces in a round over the last change of the cosines.
_LOOSE = 1e-3


def _round(points: _Points, state: _State, aim: Array) -> tuple[_State, Array, IntArray]:
    """Return the balanced state for the last stiffnesses and centrifugal forces, the largest change in the
    cosines of contact angles, and the numbers of ring steps.
    """
    scale = points.size + state.outward
    # First steps are limited to about the approach under the load: longer ones would miss light contacts.
    softest = np.min(points.stiffness(np.ones((2, 1, 1, 1)))[:, 0, 0], axis=0)
    reach = 2.0 * (points.size / softest) ** (2.0 / 3.0)
    # The balls are better in balance than the rings.
    reaction = _Reaction(points, state, 0.01 * aim * scale)
    ring, _, steps = balance(reaction, points.load.T, state.ring.T, reach, scale, aim)
    # The places belong to the best displacement, which need not be the last one.
    reaction.contacts(ring.T, np.arange(len(ring)))
    there = _State(ring.T, reaction.place, reaction.depth, state.cosines, state.outward)
    contacts = there.contacts(points)
    change = np.max(np.abs(contacts.cosine - state.cosines), axis=(0, 1, 2))
    outward = points.outward(_mean_cosine(contacts))
    return _State(ring.T, there.place, there.depth, contacts.cosine, outward), change, steps


def _solved(points: _Points) -> tuple[_State, IntArray]:
    """States of n points in equilibrium, and numbers of steps of the rings."""
    state, number = _State.first(points), points.shape[1]
    going, aim, steps = np.arange(number), np.full(number, _LOOSE), np.zeros(number, dtype=np.intp)
    for _ in range(_MOST_ROUNDS):
        if not going.size:
            break
        new, change, more = _round(chosen(points, going), chosen(state, going), aim[going])
        _take(state, going, new)
        steps[going] += more
        done = (change <= _CLOSE) & (aim[going] == AIM)
        # Forces that balance far better than the angles are known are not worth their steps.
        aim[going] = np.maximum(AIM, _LOOSE * change)
        going = going[~done]
    return state, steps


def _residual(points: _Points, state: _State, contacts: Contacts) -> Array:
    """Largest unbalanced force on ring or ball over load and centrifugal force, shape (n,)."""
    axial, radial = (np.add.reduce(value, axis=1) for value in contacts.components)
    missing = points.load - points.summed(axial[0], radial[0])
    on_balls = np.stack([axial[0] - axial[1], radial[0] - radial[1] + state.outward])
    worst = np.maximum(np.max(np.abs(missing), axis=0), np.max(np.abs(on_balls), axis=(0, 1)))
    return np.asarray(worst / (points.size + state.outward))


def four_point_equilibrium(
    bearing: FourPointBearing, operation: Operation, modulus: Numbers, density: Numbers
) -> BallEquilibrium:
    """Equilibrium of the inner ring and of all balls of a four-point contact ball bearing.

    Resulting arrays have the shape (..., 2 Z): the Z balls on the diagonal that is loaded by a positive
    axial load on the inner ring, with positive contact angles, and then the same Z balls on the other one.
    The sum of Q_i sin a_i over all of them is the axial load, and the sum of Q_i cos a_i cos psi is the
    radial load. The sums over both diagonals of a ball are Q_o sin a_o = Q_i sin a_i and
    Q_o cos a_o = Q_i cos a_i + F_c: ``centrifugal_force`` is that on a whole ball, of which each diagonal
    takes its share. The speed of the cage belongs to the mean of cos a, weighted with the loads on the inner
    ring. At speed, a ball without load from the inner ring lies in the middle of the outer arch, on both its
    arcs. At rest, an unloaded ball lies where its smallest gap is as large as it can be.

    ``moment`` and ``lateral_moment`` are about the middle of the inner ring, sums of
    (R_i sin a_i - z_i cos a_i) Q_i times cos psi and sin psi, with the arcs' centres at R_i and z_i.

    ``modulus``, reduced modulus E' of ball and ring [Pa], with 2/E' = (1 - nu1^2)/E1 + (1 - nu2^2)/E2;
    ``density`` [kg/m^3]. Both, the operation and the dimensions of the bearing are floats, or arrays of shape
    (...) that broadcast. Returns forces that balance to 1e-9 of the load plus the centrifugal force. Raises
    ConvergenceError for a single bearing whose iteration does not converge; such points of many are not
    ``balanced``, and points without load are NaN.

    T. A. Harris and M. N. Kotzalas, Advanced Concepts of Bearing Technology, 5th ed., 2006, chapters 1 and 3,
    doi:10.1201/9781420006582.

    Examples
    --------
    Under an axial load only one diagonal carries; a light radial load is shared by both:

    >>> bearing = FourPointBearing(12, 12.7e-3, 60e-3, 0.52, 0.52, 0.0, np.radians(35.0))
    >>> state = four_point_equilibrium(bearing, Operation(
    ...     radial_load=0.0, axial_load=np.array([1200.0, -1200.0]),
    ... ), 226e9, 7800.0)
    >>> np.round(state.inner_load[:, [0, 12]] * np.abs(np.sin(state.inner_angle[:, [0, 12]])), 6).tolist()
    [[100.0, 0.0], [0.0, 100.0]]
    >>> state = four_point_equilibrium(bearing, Operation(radial_load=1000.0), 226e9, 7800.0)
    >>> [round(float(state.inner_load[ball]), 1) for ball in (0, 1, 12, 13)]
    [220.8, 177.9, 220.8, 177.9]
    """
    batch = Batch.of(bearing, operation, modulus, density, able=True)
    points = _Points.of(batch)
    number = points.shape[1]
    parts = [slice(first, first + _BLOCK) for first in range(0, max(1, number), _BLOCK)]
    states, numbers = zip(*(_solved(chosen(points, part)) for part in parts), strict=True)
    state = joined(states)
    contacts = state.contacts(points)
    residual = _residual(points, state, contacts)
    refuse_unbalanced(batch.spread(residual), "balls")
    return _equilibrium(batch, points, state, contacts, residual, np.concatenate(numbers))


def _equilibrium(
    batch: Batch[FourPointBearing],
    points: _Points,
    state: _State,
    contacts: Contacts,
    residual: Array,
    steps: IntArray,
) -> BallEquilibrium:
    elements, number = points.shape

    def both(values: Array) -> Array:
        """Values of both rings, of the balls on the first and then on the second diagonal."""
        return values.reshape(2, 2 * elements, number)

    angles = both(np.arctan2(contacts.sine, contacts.cosine))
    # The contact forces pass through the centres of their arcs.
    axial, radial = (value[0] for value in contacts.components)
    levers = np.sum(
        batch.bearing.inner_centre_radius * axial
        - _SIDES[:, np.newaxis, np.newaxis] * points.apart[0] * radial,
        axis=0,
    )
    return BallEquilibrium.of(
        batch,
        loads=both(contacts.load),
        angles=angles,
        depths=both(contacts.depth),
        rolling_angle=angles.mean(axis=0),
        cage_speed=points.cage_speed(_mean_cosine(contacts)),
        outward=state.outward,
        ring=state.ring,
        moments=[np.add.reduce(levers * points.cosine, axis=0), np.add.reduce(levers * points.sine, axis=0)],
        residual=residual,
        steps=steps,
    )
