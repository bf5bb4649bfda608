"""Loads of ball bearings: equilibrium of inner ring and balls, for many bearings at once; SI units.

The equilibrium is Harris' model of a bearing at speed. The inner ring is displaced, but not tilted. Contact
forces and centrifugal force balance on each ball, so its inner and outer contact angles differ. The rings are
rigid except in the contacts. The effects of the gyroscopic moment and of friction are neglected. The grooves
have no shoulders in this model, so compare the contact angles with the angle at which the shoulder begins.

Newton's method computes the displacement of the ring and the positions of all balls together; each step
eliminates the balls, so that only the three components of the displacement remain. Contact stiffnesses and
the speed of the cage belong to the contact angles of each step. Points of operation that do not converge in
this way are computed by nested iterations, whose steps are judged by a convex energy: contact angles outside,
then the ring, then the balls, for which see `ball_seats`.

A. B. Jones, J. Basic Eng. 82 (1960) 309-320, doi:10.1115/1.3662587; T. A. Harris and M. N. Kotzalas, Advanced
Concepts of Bearing Technology, 5th ed., 2006, chapters 1 and 3, doi:10.1201/9781420006582.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, ClassVar, TypeVar

import numpy as np

from ehlectric.arrays import Array, IntArray, Mask, Numbers
from ehlectric.bearing.loads.ball_contacts import Contacts, Spans, significant, stiffness_at, stiffness_laws
from ehlectric.bearing.loads.ball_seats import (
    Grooves,
    Seats,
    at_rest,
    determinant,
    first_guess,
    in_series,
    seat,
)
from ehlectric.bearing.loads.geometry import (
    BallBearing,
    FourPointBearing,
    Speeds,
    centrifugal_force,
    gyroscopic_moment,
    rolling_speeds,
)
from ehlectric.bearing.loads.ring import (
    AIM,
    GOOD,
    Batch,
    BearingEquilibrium,
    Operation,
    balance,
    chosen,
    direction,
    joined,
    refuse_unbalanced,
)
from ehlectric.errors import InputError

B = TypeVar("B", BallBearing, FourPointBearing)

# Points of operation that are computed together: few enough for the processor's cache.
_BLOCK = 8192

_TINY = np.finfo(float).tiny


@dataclass(frozen=True)
class BallEquilibrium(BearingEquilibrium):
    """Ball bearing in equilibrium. Arrays have one value per ball, shape (..., elements)."""

    # inner_angle and outer_angle: angle of both contacts [rad]; where a ball does not touch, angle of the
    # smallest gap.
    inner_angle: Array
    outer_angle: Array
    gyroscopic_moment: Array  # gyroscopic moment of each ball [N m]; its effect is neglected
    cage_speed: Numbers  # mean orbital speed of the balls, weighted with their load on the inner ring [rad/s]
    # Displacement of the inner ring from where both grooves face each other [m]; play up to A sin a_0
    axial_displacement: Numbers
    # moment and lateral_moment: moments that keep the ring from tilting, sums of R_i Q_i sin a_i times cos
    # psi and sin psi [N m]; of a pair without the moment due to the distance of its rows.
    moment: Numbers
    lateral_moment: Numbers

    holds_axially: ClassVar[bool] = True  # balls hold the ring along the axis

    @classmethod
    def of(
        cls,
        batch: Batch[B],
        *,
        loads: Array,
        angles: Array,
        depths: Array,
        rolling_angle: Numbers,
        cage_speed: Numbers,
        outward: Numbers,
        ring: Array,
        moments: Sequence[Array],
        residual: Array,
        steps: IntArray,
    ) -> BallEquilibrium:
        """Equilibrium of all n points of a batch.

        ``loads`` [N], ``angles`` [rad] and ``depths`` [m], below 0 where there is a gap, of the inner and the
        outer contact, shape (2, elements, n); ``rolling_angle``, contact angle at which the balls roll [rad],
        shape (elements, n) or (); ``cage_speed`` [rad/s] and centrifugal force ``outward`` [N], shape (n,) or
        (); ``ring``, axial, radial and lateral displacement [m], shape (3, n); ``moments`` about the radial
        and the lateral axis [N m], shape (n,) each; ``residual``, relative; ``steps`` of the ring.
        """
        bearing, operation, spread = batch.bearing, batch.operation, batch.spread
        diameter = bearing.ball_diameter
        rolling = rolling_speeds(
            element_diameter=diameter,
            pitch_diameter=bearing.pitch_diameter,
            inner_speed=operation.inner_speed,
            outer_speed=operation.outer_speed,
            contact_angle=rolling_angle,
        )
        turning = gyroscopic_moment(bearing.element_mass(batch.density), diameter, rolling, rolling_angle)
        touching, gaps = np.maximum(0.0, depths), np.maximum(0.0, -depths)

        def each(values: Numbers) -> Array:
            return np.asarray(spread(np.broadcast_to(values, loads.shape[1:])))

        def whole(values: Numbers) -> Numbers:
            number: Numbers = spread(np.broadcast_to(values, loads.shape[2:]))
            return number

        return cls(
            # Both diagonals of a four-point contact bearing have the same balls.
            position=np.tile(batch.position, loads.shape[1] // batch.position.shape[-1]),
            inner_load=spread(loads[0]),
            outer_load=spread(loads[1]),
            inner_angle=spread(angles[0]),
            outer_angle=spread(angles[1]),
            inner_approach=spread(touching[0]),
            outer_approach=spread(touching[1]),
            inner_gap=spread(gaps[0]),
            outer_gap=spread(gaps[1]),
            speeds=Speeds(*map(each, vars(rolling).values())),
            gyroscopic_moment=each(turning),
            cage_speed=whole(cage_speed),
            centrifugal_force=whole(outward),
            axial_displacement=spread(ring[0]),
            radial_displacement=spread(ring[1]),
            lateral_displacement=spread(ring[2]),
            moment=spread(moments[0]),
            lateral_moment=spread(moments[1]),
            residual=spread(residual),
            iterations=spread(steps),
        )


@dataclass(frozen=True)
class BallPoints:
    """Numbers that every ball bearing and its operation have, at n points.

    The last dimension of arrays is n, or 1 where all points have the same number.
    """

    # Cosine and sine of the position of each ball, shape (elements, n).
    cosine: Array
    sine: Array
    # load: axial, radial and lateral load on the ring [N], shape (3, n).
    load: Array
    inner_speed: Array  # angular speed of the inner ring [rad/s]
    outer_speed: Array
    ratio: Array  # D/d_m
    swing: Array  # centrifugal force over the square of the speed of the cage [kg m]
    distance: Array  # radial distance of the groove centres in concentric rings [m]
    free_cosine: Array  # cosine of the free contact angle
    offsets: Array  # lengths at first touch of the inner and outer contact [m], shape (2, 1, n)

    @classmethod
    def shared(cls, batch: Batch[B], position: Array) -> dict[str, Array]:
        """Values of these fields for a batch, at angles of the balls of shape (elements, n) [rad]."""
        bearing, operation, row = batch.bearing, batch.operation, np.atleast_1d
        load = np.zeros((3, batch.number))
        load[0], load[1] = operation.axial_load, operation.radial_load
        return {
            "cosine": np.cos(position),
            "sine": np.sin(position),
            "load": load,
            "inner_speed": row(operation.inner_speed),
            "outer_speed": row(operation.outer_speed),
            "ratio": row(bearing.ball_diameter / bearing.pitch_diameter),
            "swing": row(
                centrifugal_force(
                    mass=bearing.element_mass(batch.density),
                    pitch_diameter=bearing.pitch_diameter,
                    cage_speed=1.0,
                )
            ),
            "distance": row(bearing.radial_distance),
            "free_cosine": np.cos(row(bearing.free_angle)),
            "offsets": np.stack(np.broadcast_arrays(*map(row, bearing.offsets)))[:, np.newaxis],
        }

    @property
    def shape(self) -> tuple[int, int]:
        """Numbers of balls and of points."""
        return len(self.cosine), self.load.shape[1]

    @property
    def size(self) -> Array:
        """Resultant load [N], shape (n,)."""
        return np.asarray(np.hypot(self.load[0], self.load[1]))

    def cage_speed(self, cosine: Array) -> Array:
        """Speed of the cage [rad/s] at the cosine of the mean contact angle, shape (n,)."""
        share = self.ratio * cosine
        return np.asarray(0.5 * (self.inner_speed * (1.0 - share) + self.outer_speed * (1.0 + share)))

    def outward(self, cosine: Array) -> Array:
        """Centrifugal force on a ball [N] at the cosine of the mean contact angle, shape (n,)."""
        return np.asarray(self.swing * self.cage_speed(cosine) ** 2)


def laws_of(batch: Batch[B]) -> Array:
    """Coefficients of ln K of the contacts of both rings with a ball, shape (m, 2, n)."""
    laws = np.stack(stiffness_laws(batch.bearing, batch.modulus))
    return significant(np.moveaxis(laws[:, np.newaxis] if laws.ndim == 2 else laws, -1, 0))


@dataclass(frozen=True)
class _Points(BallPoints):
    """Bearings with one or two rows of balls and their operation at n points."""

    # 1, or -1 of balls in a second row, whose axial components point the other way, shape (elements, 1).
    sign: Array
    laws: Array  # coefficients of ln K of both contacts, shape (m, 2, 1, n)
    flat: Array  # stiffness K of both contacts at a contact angle of 0, shape (2, 1, n)
    # Axial distance of the groove centres of each row with the ring in the middle of a pair [m], and the
    # force of both rows against each other without load [N], shape (n,).
    apart: Array
    preload: Array

    @classmethod
    def of(cls, batch: Batch[BallBearing]) -> _Points:
        """Points of a batch."""
        laws = laws_of(batch)
        return cls(
            **cls.shared(batch, batch.rows),
            sign=batch.signs,
            laws=laws[:, :, np.newaxis],
            flat=stiffness_at(laws, np.ones(1))[:, np.newaxis],
            apart=np.atleast_1d(_closed(batch.bearing, laws)),
            preload=np.atleast_1d(np.asarray(batch.bearing.rows.preload, dtype=float)),
        )

    @property
    def paired(self) -> bool:
        """Whether there is a second row."""
        return bool(self.sign[-1, 0] < 0.0)

    @property
    def reach(self) -> Array:
        """Longest first step of the ring [m]: a tenth of the distance of the groove centres."""
        return np.asarray(0.1 * np.sum(self.offsets, axis=0)[0])

    def grooves(self, balls: Mask, outward: Array) -> Grooves:
        """Grooves of some balls, shape (elements, n), with the stiffnesses at a contact angle of 0."""
        values = (*self.offsets, *self.flat, outward)
        return Grooves(*(np.broadcast_to(value, balls.shape)[balls] for value in values))

    def centres(self, ring: Array) -> Array:
        """Centres of the inner groove at each ball, axial and radial [m], shape (2, elements, n)."""
        radial = self.distance + ring[1] * self.cosine + ring[2] * self.sine
        return np.stack([np.broadcast_to(self.sign * ring[0] + self.apart, radial.shape), radial])

    def moved(self, step: Array) -> tuple[Array, Array]:
        """Axial and radial movement of the centres of the inner groove by a step of the ring [m]."""
        return self.sign * step[0], step[1] * self.cosine + step[2] * self.sine

    def summed(self, axial: Array, radial: Array) -> Array:
        """Sum of forces on the ring over the balls, axial, radial and lateral [N], shape (3, n)."""
        return np.stack(
            [
                np.add.reduce(self.sign * axial, axis=0),
                np.add.reduce(radial * self.cosine, axis=0),
                np.add.reduce(radial * self.sine, axis=0),
            ]
        )

    def stiffness(self, first: Array, mixed: Array, second: Array) -> tuple[Array, ...]:
        """Stiffness of the ring [N/m] from the stiffnesses of the balls: components 00, 01, 02, 11, 12 and
        22.
        """
        mixed = self.sign * mixed
        along, across = second * self.cosine, mixed * self.cosine
        parts = (
            first,
            across,
            mixed * self.sine,
            along * self.cosine,
            along * self.sine,
            second * self.sine**2,
        )
        return tuple(np.add.reduce(part, axis=0) for part in parts)


def _ring_step(missing: Array, stiffness: tuple[Array, ...], reach: Array) -> tuple[Array, Mask]:
    """Newton step of the ring, shape (3, n) [m], and whether it is limited to the reach, shape (n,)."""
    a, b, c, d, e, f = stiffness
    first, second, third = d * f - e * e, c * e - b * f, b * e - c * d
    det = a * first + b * second + c * third
    regular = det > 1e-10 * a * d * f
    x, y, z = missing
    step = np.stack(
        [
            first * x + second * y + third * z,
            second * x + (a * f - c * c) * y + (b * c - a * e) * z,
            third * x + (b * c - a * e) * y + (a * d - b * b) * z,
        ]
    ) / np.where(regular, det, 1.0)
    limited = ~(regular & (np.max(np.abs(step), axis=0) <= reach))
    if limited.any():
        tangent = np.stack([a, b, c, b, d, e, c, e, f], axis=-1)[limited].reshape(-1, 3, 3)
        step[:, limited] = direction(missing[:, limited].T, tangent, reach[limited]).T
    return step, limited


# Steps of only the ring for the initial guess, and the relative imbalance at which they end.
_FIRST_STEPS, _ROUGH = 12, 1e-2


def _first_span(points: _Points, touch: Array, stiffness: Array) -> tuple[Array, Array]:
    """Length of the span of the most loaded ball, and the cosine of its angle, shape (n,).

    Its load is five times the mean radial load (Stribeck), and its share of the axial load. ``touch`` is the
    length at first touch, and ``stiffness`` the stiffness of both contacts.
    """
    axial, radial = np.abs(points.load[0]), points.load[1]
    cosine = points.free_cosine
    for _ in range(3):
        # The sine of a bearing without clearance is 0 until it is loaded.
        sine = np.sqrt(1.0 - cosine**2) + 0.05
        load = (5.0 * radial + axial / sine) / len(points.cosine)
        length = touch + (load / stiffness) ** (2.0 / 3.0)
        cosine = np.minimum(1.0, points.distance / length)
    return length, np.maximum(cosine, radial / points.size)


def _first_ring(points: _Points) -> tuple[Array, Array]:
    """Displacement of the ring roughly in balance, shape (3, n), and the reach of next steps, shape (n,) [m].

    The balls lie on the lines through both groove centres, and their stiffness does not change. The approach
    under the centrifugal force adds to the clearance, so that at speed the displacement is rather too large:
    from there Newton's method converges without overshooting.
    """
    inner, outer = stiffness_at(points.laws, points.free_cosine)[:, 0]
    stiffness = (inner ** (-2.0 / 3.0) + outer ** (-2.0 / 3.0)) ** -1.5
    clear = np.add.reduce(points.offsets, axis=0)[0]
    touch = clear + (points.outward(points.free_cosine) / outer) ** (2.0 / 3.0)
    length, cosine = _first_span(points, touch, stiffness)
    along = np.sign(points.load[0]) * length * np.sqrt(1.0 - cosine**2)
    if points.paired:
        along = np.sign(points.load[0]) * np.maximum(0.0, np.abs(along) - points.apart)
    ring = np.stack([along, np.maximum(0.0, length * cosine - points.distance), np.zeros_like(along)])
    # Steps are limited to about the approach at first: lighter loads have shorter steps.
    first = np.array(np.broadcast_to(length - clear, along.shape))
    reach = first.copy()
    for _ in range(_FIRST_STEPS):
        contacts = Spans.of(*points.centres(ring)).stiff_contacts(touch, stiffness)
        missing = points.load - points.summed(*contacts.components)
        if np.all(np.abs(missing) <= _ROUGH * points.size):
            break
        step, limited = _ring_step(missing, points.stiffness(*contacts.tangent), reach)
        reach[limited] *= 2.0
        ring += step
    return ring, first


T = TypeVar("T")


def _columns(fields_of: T, points: Any) -> T:
    """Same class with the values of some of the points; each array has a value of every point."""
    return type(fields_of)(*(value[..., points] for value in vars(fields_of).values()))


def _either(first: Mask, fields_of: T, other: T) -> T:
    """Same class with the values of one where ``first``, and of the other elsewhere."""
    pairs = zip(vars(fields_of).values(), vars(other).values(), strict=True)
    return type(fields_of)(*(np.where(first, x, y) for x, y in pairs))


@dataclass(frozen=True)
class _State:
    """Displacements of rings, places of balls, and centrifugal forces on them at n points."""

    ring: Array  # axial, radial and lateral displacement [m], shape (3, n)
    place: Array  # axial and radial position of the balls [m], shape (2, elements, n)
    outward: Array  # centrifugal force on each ball [N], shape (n,)


@dataclass(frozen=True)
class _Forces:
    """Contacts and forces in a state of n points."""

    state: _State  # the state, with the places of balls that touch only one groove or none, and its own cage
    contacts: Contacts  # of both rings, shape (2, elements, n)
    on_balls: Array  # axial and radial unbalanced force on each ball [N], shape (2, elements, n)
    missing: Array  # axial, radial and lateral unbalanced force on the ring [N], shape (3, n)
    residual: Array  # largest unbalanced force over load and centrifugal force, shape (n,)

    @classmethod
    def joined(cls, blocks: tuple[_Forces, ...]) -> _Forces:
        """Contacts and forces of several blocks of points."""
        states, contacts = ([getattr(each, name) for each in blocks] for name in ("state", "contacts"))
        others = (
            np.concatenate([getattr(each, name) for each in blocks], axis=-1)
            for name in ("on_balls", "missing", "residual")
        )
        return cls(joined(states), joined(contacts), *others)

    def chosen(self, points: Mask) -> _Forces:
        """Contacts and forces of some of the points."""
        others = (value[..., points] for value in (self.on_balls, self.missing, self.residual))
        return _Forces(_columns(self.state, points), _columns(self.contacts, points), *others)


def _mean_cosine(contacts: Contacts) -> Array:
    """Cosine of the mean contact angle, shape (n,), weighted with the loads unless all are 0."""
    sine, cosine = np.add.reduce(contacts.sine, axis=0), np.add.reduce(contacts.cosine, axis=0)
    # Where the angles are opposite, the mean angle is 0 deg.
    length = np.sqrt(sine**2 + cosine**2)
    cosines = np.where(length > 0.0, cosine / np.maximum(length, _TINY), 1.0)
    loads = contacts.load[0]
    total = np.add.reduce(loads, axis=0)
    loaded = total > 0.0
    weighted = np.add.reduce(cosines * loads, axis=0) / np.where(loaded, total, 1.0)
    return np.asarray(np.where(loaded, weighted, np.add.reduce(cosines, axis=0) / len(cosines)))


def _placed(points: _Points, state: _State, centres: Array) -> tuple[Array, Spans]:
    """Places of the balls, shape (2, elements, n), and the spans of both contacts, shape (2, elements, n).

    Balls that do not touch both grooves lie where they are in equilibrium. Balls between both grooves that
    lost a contact in the last step are placed where both contacts are loaded.
    """
    bottom = points.offsets[1] + (state.outward / points.flat[1]) ** (2.0 / 3.0)
    held = Spans.of(centres[0], centres[1] - bottom).length > points.offsets[0]
    place = np.stack([np.where(held, state.place[0], 0.0), np.where(held, state.place[1], bottom)])
    resting = state.outward == 0.0
    if resting.any():
        grooves = points.grooves(np.broadcast_to(resting, held.shape), state.outward)
        middle, pressed = at_rest(grooves, centres[:, :, resting].reshape(2, -1))
        middle, pressed = middle.reshape(2, len(held), -1), pressed.reshape(len(held), -1)
        place[:, :, resting] = np.where(pressed, state.place[:, :, resting], middle)
        held[:, resting] = pressed

    def spans() -> Spans:
        return Spans.of(
            np.stack([centres[0] - place[0], place[0]]), np.stack([centres[1] - place[1], place[1]])
        )

    lengths = spans()
    lost = held & np.any(lengths.length <= points.offsets, axis=0)
    if lost.any():
        place[:, lost] = first_guess(points.grooves(lost, state.outward), centres[:, lost])
        lengths = spans()
    return place, lengths


def _forces(points: _Points, state: _State) -> _Forces:
    """Contacts and unbalanced forces; stiffnesses and cage speed follow from the contact angles."""
    place, spans = _placed(points, state, points.centres(state.ring))
    contacts = spans.contacts(points.offsets, points.laws)
    outward = points.outward(_mean_cosine(contacts))
    axial, radial = contacts.components
    missing = points.load - points.summed(axial[0], radial[0])
    on_balls = np.stack([axial[0] - axial[1], radial[0] - radial[1] + outward])
    worst = np.maximum(np.max(np.abs(missing), axis=0), np.max(np.abs(on_balls), axis=(0, 1)))
    # Rounding errors scale with contact forces, and the centrifugal force may exceed a light load.
    residual = worst / (points.size + outward + points.preload)
    return _Forces(_State(state.ring, place, outward), contacts, on_balls, missing, residual)


@dataclass(frozen=True)
class _Step:
    """Step of rings and balls of n points."""

    ring: Array  # movement of the ring [m], shape (3, n)
    place: Array  # movement of the balls [m], shape (2, elements, n)
    limited: Mask  # whether the reach limits the step, shape (n,)
    slope: Array  # force on the ring along its step times the step [J], shape (n,)


# Stiffness of balls without contact [N/m].
_LITTLE = 1e-100


class _Linear:
    """Forces in a state of n points, linear in the movements of rings and balls."""

    def __init__(self, points: _Points, forces: _Forces) -> None:
        inner, outer = forces.contacts.of(0), forces.contacts.of(1)
        self._points, self._offset = points, np.add.reduce(points.offsets, axis=0)
        self._inner, self._series = inner.tangent, in_series(inner, outer)
        first, self._mixed, second = (x + y for x, y in zip(self._inner, outer.tangent, strict=True))
        # Balls that barely touch have no stiffness: this small one keeps the matrices regular.
        little = 1e-13 * (inner.load + outer.load + forces.state.outward) / self._offset + _LITTLE
        self._first, self._second = first + little, second + little
        self._over = 1.0 / np.maximum(determinant(self._first, self._mixed, self._second), little**2)
        self._of_balls = self._moved(*forces.on_balls)
        # Unbalanced force on the ring [N], shape (3, n), when the balls have moved into balance.
        self.missing = forces.missing + points.summed(*self._force(*self._of_balls))

    def _moved(self, axial: Array, radial: Array) -> tuple[Array, Array]:
        """Movements of the balls under forces."""
        return (
            (self._second * axial - self._mixed * radial) * self._over,
            (self._first * radial - self._mixed * axial) * self._over,
        )

    def _force(self, axial: Array, radial: Array) -> tuple[Array, Array]:
        """Forces of the inner contacts under movements."""
        first, mixed, second = self._inner
        return first * axial + mixed * radial, mixed * axial + second * radial

    def step(self, reach: Array) -> _Step:
        """Newton step; ``reach`` is the largest movement of the ring [m], shape (n,)."""
        ring, limited = _ring_step(self.missing, self._points.stiffness(*self._series), reach)
        more = self._moved(*self._force(*self._points.moved(ring)))
        place = np.stack([self._of_balls[0] + more[0], self._of_balls[1] + more[1]])
        length = np.sqrt(place[0] ** 2 + place[1] ** 2)
        place *= np.minimum(1.0, 0.5 * self._offset / np.maximum(length, _TINY))
        return _Step(ring, place, limited, np.add.reduce(self.missing * ring, axis=0))


@dataclass(frozen=True)
class _Trial:
    """Step from a state of n points of which a part is taken, and the reach of the ring."""

    base: _State
    step: _Step
    part: Array  # shape (n,)
    reach: Array  # shape (n,) [m]

    @property
    def state(self) -> _State:
        """State after the part of the step."""
        base, step = self.base, self.step
        return _State(base.ring + self.part * step.ring, base.place + self.part * step.place, base.outward)

    def chosen(self, points: Mask) -> _Trial:
        """Trials of some of the points."""
        return _Trial(
            _columns(self.base, points), _columns(self.step, points), self.part[points], self.reach[points]
        )

    def following(self, linear: _Linear, forces: _Forces, worse: Mask) -> _Trial:
        """Next trial: another step from the state of ``forces``, or a smaller part of one that overshot.

        ``worse`` is whether the forces balance worse than before, shape (n,).
        """
        step, slope = self.step, self.step.slope
        now = np.add.reduce(linear.missing * step.ring, axis=0)
        over = worse & (now < -_OVERSHOOT * slope) & (self.part > _SHORTEST)
        free = step.limited & (now > _OVERSHOOT * slope) & (self.part == 1.0)
        reach = np.where(free, _LONGER * self.reach, self.reach)
        new = linear.step(reach)
        if not over.any():
            return _Trial(forces.state, new, np.ones_like(now), reach)
        # Linear interpolation to zero force along the step; 0.02 keeps the step from becoming too small.
        part = self.part * np.maximum(slope / np.where(over, slope - now, 1.0), 0.02)
        return _Trial(
            _either(over, self.base, forces.state),
            _either(over, step, new),
            np.where(over, part, 1.0),
            np.where(over, part * np.max(np.abs(step.ring), axis=0), reach),
        )


class _Record:
    """Best states of n points."""

    def __init__(self, state: _State) -> None:
        number = len(state.outward)
        self.state = _State(*(value.copy() for value in vars(state).values()))
        self.residual, self.steps = np.full(number, np.inf), np.zeros(number, dtype=np.intp)
        self._idle = np.zeros(number, dtype=np.intp)

    def note(self, going: IntArray, forces: _Forces) -> tuple[Mask, Mask]:
        """Keep the states of the points ``going`` that are the best; whether they are worse, and done."""
        before = self.residual[going]
        better = forces.residual < before
        kept = going[better]
        self.residual[kept] = forces.residual[better]
        for mine, new in zip(vars(self.state).values(), vars(forces.state).values(), strict=True):
            mine[..., kept] = new[..., better]
        # Rounding limits the residual: below GOOD, two steps without improvement end the iteration.
        self._idle[going] = idle = np.where(forces.residual > 0.5 * before, self._idle[going] + 1, 0)
        least = self.residual[going]
        return ~better, (least <= AIM) | ((least <= GOOD) & (idle >= 2))


# Newton steps of rings and balls together, and the shortest part of a step.
_MOST_STEPS, _SHORTEST = 60, 1e-3

# A step that overshoots is shortened until the force against it is at most this part of the force along it
# at its start. One that is limited, and leaves more force than this, is followed by a longer one.
_OVERSHOOT, _LONGER = 0.5, 4.0


def _together(points: _Points) -> _Record:
    """States of n points by Newton's method for rings and balls."""
    ring, reach = _first_ring(points)
    outward = np.array(np.broadcast_to(points.outward(points.free_cosine), reach.shape))
    # Balls at the centre of the outer groove have no contact: they are placed anew.
    state = _State(ring, np.zeros((2, *points.shape)), outward)
    none = _Step(
        np.zeros_like(ring), np.zeros_like(state.place), np.zeros(reach.shape, bool), np.zeros_like(reach)
    )
    trial, record = _Trial(state, none, np.ones_like(reach), reach), _Record(state)
    going = np.arange(reach.size)
    for _ in range(_MOST_STEPS):
        forces = _forces(points, trial.state)
        worse, done = record.note(going, forces)
        if done.all():
            break
        if done.any():
            on = ~done
            going, worse, trial = going[on], worse[on], trial.chosen(on)
            points, forces = chosen(points, on), forces.chosen(on)
        trial = trial.following(_Linear(points, forces), forces, worse)
        record.steps[going] += 1
    return record


# Change of the cosines of the contact angles at convergence; each round reduces it by two or three digits.
_SETTLED = 1e-12
_MOST_ROUNDS = 30

# Imbalance of the forces in a round over the last change of the cosines.
_LOOSE = 1e-3


class _BallReaction:
    """Forces of the balls over displacements of rings; each call starts from the places of the last one."""

    def __init__(self, points: _Points, cosines: Array, place: Array, outward: Array) -> None:
        values = (*points.offsets, *stiffness_at(points.laws, cosines), outward)
        self._points, self.place = points, place
        self._grooves = [np.broadcast_to(value, points.shape) for value in values]

    def seats(self, ring: Array, which: IntArray) -> Seats:
        """Seats of the balls at displacements, shape (3, m), of the points ``which``."""
        centres = chosen(self._points, which).centres(ring).reshape(2, -1)
        grooves = Grooves(*(value[:, which].ravel() for value in self._grooves))
        seats = seat(grooves, centres, self.place[..., which].reshape(2, -1))
        self.place[..., which] = seats.place.reshape(2, -1, len(which))
        return seats

    def __call__(self, ring: Array, which: IntArray) -> tuple[Array, Array]:
        """Forces on rings at displacements, and their derivatives, as ``balance`` needs them."""
        points, seats, shape = chosen(self._points, which), self.seats(ring.T, which), (-1, len(which))
        force = points.summed(*(value.reshape(shape) for value in seats.inner.components))
        a, b, c, d, e, f = points.stiffness(*(value.reshape(shape) for value in seats.tangent))
        return force.T, np.stack([a, b, c, b, d, e, c, e, f], axis=-1).reshape(-1, 3, 3)


def _nested(points: _Points) -> tuple[_State, IntArray]:
    """States of n points by nested iterations, and numbers of steps of the rings.

    Each round takes stiffnesses and cage speeds from the last round's angles. The first one is without
    centrifugal force.
    """
    shape = points.shape
    number, everyone = shape[1], np.arange(shape[1])
    axial = (
        np.sign(points.load[0])
        * np.add.reduce(points.offsets, axis=0)[0]
        * np.sqrt(1.0 - points.free_cosine**2)
    )
    if points.paired:
        axial = np.zeros(number)
    ring = np.stack([axial, np.zeros(number), np.zeros(number)])
    cosines, place = np.array(np.broadcast_to(points.free_cosine, (2, *shape))), np.zeros((2, *shape))
    outward, aim, steps = np.zeros(number), np.full(number, _LOOSE), np.zeros(number, dtype=np.intp)
    for _ in range(_MOST_ROUNDS):
        reaction = _BallReaction(points, cosines, place, outward)
        balanced, _, more = balance(
            reaction, points.load.T, ring.T, points.reach, points.size + outward + points.preload, aim
        )
        ring, steps = balanced.T, steps + more
        seats = reaction.seats(ring, everyone)
        contacts = Contacts(
            *(
                np.stack([x, y]).reshape(2, *shape)
                for x, y in zip(vars(seats.inner).values(), vars(seats.outer).values(), strict=True)
            )
        )
        change = np.max(np.abs(contacts.cosine - cosines), axis=(0, 1))
        outward, cosines = points.outward(_mean_cosine(contacts)), contacts.cosine
        if np.all((change <= _SETTLED) & (aim == AIM)):
            break
        # Forces that balance far better than the angles are known are not worth their steps.
        aim = np.maximum(AIM, _LOOSE * change)
    return _State(ring, reaction.place, outward), steps


def _solved(points: _Points) -> tuple[_Forces, IntArray]:
    """Forces in equilibrium at n points, and the numbers of Newton steps."""
    record = _together(points)
    stuck = np.flatnonzero(~(record.residual <= GOOD))
    if stuck.size:
        state, steps = _nested(chosen(points, stuck))
        for mine, new in zip(vars(record.state).values(), vars(state).values(), strict=True):
            mine[..., stuck] = new
        record.steps[stuck] += steps
    return _forces(points, record.state), record.steps


# Halvings of the interval of a contact angle in which the angle of a preload lies.
_HALVINGS = 60


def _closed(bearing: BallBearing, laws: Array) -> Numbers:
    """Return the unloaded axial distance of a row's groove centres in a pair [m], shape (...); 0 for one row.

    Under the preload F of Z balls at rest, K (l - A)^(3/2) sin a = F/Z with the length l = A cos a_0/cos a
    and the stiffness K of both contacts together. ``laws``, coefficients of ln K, shape (m, 2, n).
    """
    rows = bearing.rows
    if rows.number == 1:
        return 0.0
    each = np.atleast_1d(np.asarray(rows.preload, dtype=float)) / bearing.elements
    radial, free = np.atleast_1d(bearing.radial_distance), np.atleast_1d(bearing.free_angle)
    touch = np.atleast_1d(bearing.groove_distance)
    low = np.array(np.broadcast_to(free, np.broadcast_shapes(each.shape, free.shape, laws.shape[2:])))
    high = np.full_like(low, 0.5 * np.pi)
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        inner, outer = stiffness_at(laws, np.cos(middle))
        stiffness = (inner ** (-2.0 / 3.0) + outer ** (-2.0 / 3.0)) ** -1.5
        depth = np.maximum(0.0, radial / np.cos(middle) - touch)
        less = stiffness * depth**1.5 * np.sin(middle) < each
        low, high = np.where(less, middle, low), np.where(less, high, middle)
    # Without a preload the balls just touch, except for an axial play of both rows together.
    angle = np.where(each > 0.0, 0.5 * (low + high), free)
    return np.asarray(radial * np.tan(angle) - 0.5 * rows.endplay)


def check_ball_loads(bearing: BallBearing, operation: Operation) -> None:
    """Refuse a single axial load that the bearing cannot carry. Raises InputError for an angular-contact
    bearing without axial load; arrays are not refused.
    """
    load = operation.axial_load
    if bearing.one_way and np.ndim(load) == 0 and load <= 0.0:
        raise InputError(
            "axial_load",
            got=f"{load:g} N",
            takes="one above 0: an angular-contact bearing carries it one way, and a radial load only "
            "with it",
        )


def ball_equilibrium(
    bearing: BallBearing, operation: Operation, modulus: Numbers, density: Numbers
) -> BallEquilibrium:
    """Equilibrium of the inner ring and of all balls.

    The sum of Q_i sin a_i over the balls is the axial load, with negative angles in a second row, and the sum
    of Q_i cos a_i cos psi is the radial load. The sum of Q_i cos a_i sin psi is zero. At each ball
    Q_o sin a_o = Q_i sin a_i and Q_o cos a_o = Q_i cos a_i + F_c. The stiffness K of each contact belongs to
    its own contact angle. At speed, a ball without load from the inner ring lies in the outer groove under
    its centrifugal force, and its clearance is at the inner ring.

    ``modulus``, reduced modulus E' of ball and ring [Pa], with 2/E' = (1 - nu1^2)/E1 + (1 - nu2^2)/E2;
    ``density`` [kg/m^3]. Both, the operation and the dimensions of the bearing are floats, or arrays of shape
    (...) that broadcast. Returns forces that balance to 1e-9 of the load plus the centrifugal force. Of a
    single bearing, raises InputError where it cannot carry the load, and ConvergenceError where the iteration
    does not converge; such points of many are not ``balanced``, and points without equilibrium are NaN.

    Examples
    --------
    An axial load of 900 N on nine balls:

    >>> bearing = BallBearing(9, 11.906e-3, 60e-3, 0.52, 0.52, radial_clearance=10e-6)
    >>> state = ball_equilibrium(bearing, Operation(radial_load=0.0, axial_load=900.0), 226e9, 7800.0)
    >>> angle = state.inner_angle[0]
    >>> bool(np.allclose(state.inner_load * np.sin(angle), 100.0, rtol=1e-9))
    True

    Two loads at once:

    >>> both = ball_equilibrium(bearing, Operation(
    ...     radial_load=0.0, axial_load=np.array([900.0, 1800.0]),
    ... ), 226e9, 7800.0)
    >>> both.inner_load.shape, bool(np.allclose(both.inner_load[0], state.inner_load, rtol=1e-9))
    ((2, 9), True)
    """
    able = np.greater(operation.axial_load, 0.0) if bearing.one_way else True
    batch = Batch.of(bearing, operation, modulus, density, able)
    if not batch.shape:
        check_ball_loads(bearing, operation)
    points = _Points.of(batch)
    number = points.shape[1]
    parts = [slice(first, first + _BLOCK) for first in range(0, max(1, number), _BLOCK)]
    blocks, numbers = zip(*(_solved(chosen(points, part)) for part in parts), strict=True)
    forces, steps = _Forces.joined(blocks), np.concatenate(numbers)
    refuse_unbalanced(batch.spread(forces.residual), "balls")
    return _equilibrium(batch, points, forces, steps)


def _equilibrium(
    batch: Batch[BallBearing], points: _Points, forces: _Forces, steps: IntArray
) -> BallEquilibrium:
    contacts = forces.contacts
    angles = np.arctan2(contacts.sine, contacts.cosine)
    # The moments are about the centre of the circle of groove centres, which the contact forces pass through.
    levers = batch.bearing.inner_centre_radius * contacts.load[0] * contacts.sine[0] * points.sign
    return BallEquilibrium.of(
        batch,
        loads=contacts.load,
        angles=points.sign * angles,
        depths=contacts.depth,
        rolling_angle=0.5 * (angles[0] + angles[1]),
        cage_speed=points.cage_speed(_mean_cosine(contacts)),
        outward=forces.state.outward,
        ring=forces.state.ring,
        moments=[np.add.reduce(levers * points.cosine, axis=0), np.add.reduce(levers * points.sine, axis=0)],
        residual=forces.residual,
        steps=steps,
    )
