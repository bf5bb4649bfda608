"""Loads of ball bearings: position and forces of each ball, and equilibrium of the inner ring; SI units.

In the plane through the bearing axis and the ball's centre, a groove is a circle about the groove's centre.
The ball is smaller than both circles and lies inside them. Vectors in this plane are (axial, radial) from the
centre of the outer groove: the ball's centre is at p, and the centre of the inner groove at g. The elastic
approach in the contacts is

    delta_o = abs(p) - (f_o - 1/2) D,    delta_i = abs(g - p) - (f_i - 1/2) D

and their load is Q = K delta^(3/2) where delta is positive. A groove does not enclose the ball. Beyond 90 deg
it continues as a plane wall: of a vector that points inward only the axial component counts. Both lengths are
convex functions of p and g. The energy, (2/5) K delta^(5/2) of both contacts less the work of the centrifugal
force, is then convex as well. Each ball therefore has a single position of equilibrium, which Newton's method
computes.

The equilibrium of the ring is Harris' model of a bearing at speed. The inner ring is displaced, but not
tilted. Contact forces and centrifugal force balance on each ball, so its inner and outer contact angles
differ. The rings are rigid except in the contacts. The effects of the gyroscopic moment and of friction are
neglected. The grooves have no shoulders in this model, so compare the contact angles with the angle at which
the shoulder begins.

A. B. Jones, J. Basic Eng. 82 (1960) 309-320, doi:10.1115/1.3662587; T. A. Harris and M. N. Kotzalas, Advanced
Concepts of Bearing Technology, 5th ed., 2006, chapters 1 and 3, doi:10.1201/9781420006582.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from itertools import count

import numpy as np
from numpy.polynomial import Chebyshev

from ehlectric.arrays import Array, Mask
from ehlectric.bearing.loads.geometry import (
    BallBearing,
    Speeds,
    centrifugal_force,
    gyroscopic_moment,
    rolling_speeds,
)
from ehlectric.bearing.loads.ring import AIM, GOOD, BearingEquilibrium, Operation, balance
from ehlectric.errors import ConvergenceError, InputError
from ehlectric.formulas.hertz import dry_contact

# Degree of the polynomial of log K. K changes smoothly, by a few percent over all angles: the relative error
# is below 1e-11, except where a handful of balls fill their pitch circle.
_DEGREE = 24


def contact_stiffness(bearing: BallBearing, modulus: float, angle: float, *, inner: bool) -> float:
    """Stiffness K of Q = K delta^(3/2), from the exact Hertz ellipse of a ball and a ring. ``modulus``,
    reduced modulus E' of ball and ring [Pa], with 2/E' = (1 - nu1^2)/E1 + (1 - nu2^2)/E2; ``angle`` [rad].
    Returns stiffness K [N/m^(3/2)].

    Examples
    --------
    Approach in micrometres under a load of 870 N:

    >>> bearing = BallBearing(9, 11.906e-3, 60e-3, 0.52, 0.52, radial_clearance=10e-6)
    >>> k = contact_stiffness(bearing, 226e9, 0.0, inner=True)
    >>> round(1e6 * (870.0 / k) ** (2 / 3), 2)
    9.24
    """
    radii = bearing.radii(angle, inner=inner)
    return float(dry_contact(1.0, radii.radius_x, radii.radius_y, modulus).approach ** -1.5)


@lru_cache(maxsize=32)
def stiffness_laws(bearing: BallBearing, modulus: float) -> tuple[Chebyshev, Chebyshev]:
    """Polynomials of ln K of the inner and the outer contact over the cosine of the contact angle, 0 to 1.

    ``modulus`` is the reduced modulus E' of ball and ring [Pa]; K has the unit N/m^(3/2).
    """

    def law(*, inner: bool) -> Chebyshev:
        def logarithm(cosines: Array) -> Array:
            angles = np.arccos(cosines)
            return np.log([contact_stiffness(bearing, modulus, float(a), inner=inner) for a in angles])

        return Chebyshev.interpolate(logarithm, _DEGREE, domain=[0.0, 1.0])

    return law(inner=True), law(inner=False)


_RADIAL = np.array([0.0, 1.0])
_UNITY = np.eye(2)

# Lower bounds of the components of a vector: its axial component counts in full, an inward radial one as 0.
_INWARD = np.array([-np.inf, 0.0])
_TINY = np.finfo(float).tiny
_MOST_STEPS = 60
_MOST_TRIALS = 40

# A step that overshoots is shortened until the force against it is at most this part of the force along it
# at its start.
_OVERSHOOT = 0.5

# Relative rounding errors: of the forces on a ball, and of its position over the distance of groove centres.
_ROUNDING = 1e-15
_NUDGE = 4e-16


@dataclass(frozen=True)
class Contacts:
    """Contacts of n balls with one groove."""

    # Unit vector n along the contact: from the centre of the outer groove to the ball, or from the ball to
    # the centre of the inner groove, shape (n, 2).
    normal: Array
    # Elastic approach [m]; where the ball does not touch, it is negative, the gap with a minus sign,
    # shape (n,).
    depth: Array
    load: Array  # load Q [N], shape (n,)
    # Derivative of the force Q n by the vector between the centres of ball and groove [N/m], shape (n, 2, 2).
    tangent: Array

    @classmethod
    def of(cls, span: Array, offset: float, stiffness: Array) -> Contacts:
        """Contacts from the vectors between centres of ball and groove, their length at touch, and K."""
        counted = np.maximum(span, _INWARD)
        length = np.hypot(counted[:, 0], counted[:, 1])
        # Coinciding centres define no direction, but have no force either.
        normal = counted / np.maximum(length, _TINY)[:, None]
        depth = length - offset
        root = np.sqrt(np.maximum(0.0, depth))
        load = stiffness * root**3
        along = normal[:, :, None] * normal[:, None, :]
        across = (load / np.maximum(length, offset) * (span[:, 1] > 0.0))[:, None, None]
        tangent = (1.5 * stiffness * root)[:, None, None] * along + across * (_UNITY - along)
        return cls(normal, depth, load, tangent)

    @property
    def force(self) -> Array:
        """Contact force Q n, shape (n, 2) [N]."""
        return self.load[:, None] * self.normal


@dataclass(frozen=True)
class Grooves:
    """Grooves of both rings, and contact stiffnesses of n balls."""

    # inner_offset and outer_offset: distance (f - 1/2) D between the centres of ball and groove at first
    # touch [m].
    inner_offset: float
    outer_offset: float
    # inner_stiffness and outer_stiffness: stiffness K of the contacts of each ball [N/m^(3/2)], shape (n,).
    inner_stiffness: Array
    outer_stiffness: Array
    outward: float  # centrifugal force on each ball [N]; zero at rest

    def contacts(self, p: Array, g: Array, chosen: Mask | slice = slice(None)) -> tuple[Contacts, Contacts]:
        """Inner and outer contacts of balls at p, with the groove centres at 0 and g, shape (n, 2)."""
        inner = Contacts.of(g - p, self.inner_offset, self.inner_stiffness[chosen])
        return inner, Contacts.of(p, self.outer_offset, self.outer_stiffness[chosen])


@dataclass(frozen=True)
class Seats:
    """Positions and contacts of n balls between two grooves."""

    place: Array  # position p of the ball's centre [m], shape (n, 2)
    held: Mask  # whether the ball is loaded by both grooves, shape (n,)
    inner: Contacts
    outer: Contacts

    @property
    def tangent(self) -> Array:
        """Derivative of the forces on the inner ring by g, shape (n, 2, 2) [N/m].

        The balls follow the ring to their new equilibrium, so both contacts are springs in series.
        """
        stiffness = np.zeros_like(self.inner.tangent)
        inner, outer = self.inner.tangent[self.held], self.outer.tangent[self.held]
        both = inner + outer
        # Where a ball only just touches, the matrix would be singular without this small stiffness.
        little = 1e-15 * np.trace(both, axis1=1, axis2=2) + _TINY
        both += little[:, None, None] * _UNITY
        stiffness[self.held] = inner @ np.linalg.solve(both, outer)
        # The exact product is symmetric; rounding errors are not.
        return 0.5 * (stiffness + stiffness.transpose(0, 2, 1))


def _corner(g: Array, inner: Array, outer: Array) -> Array:
    """Point at the distances ``outer`` from 0 and ``inner`` from g: of two such points the outward one."""
    length = np.maximum(np.hypot(g[:, 0], g[:, 1]), _TINY)
    along = (length**2 + outer**2 - inner**2) / (2.0 * length)
    across = np.sqrt(np.maximum(0.0, outer**2 - along**2))
    unit = g / length[:, None]
    normal = np.stack([-unit[:, 1], unit[:, 0]], axis=1)
    # Of the two unit vectors perpendicular to g, this is the outward one.
    normal[normal[:, 1] < 0.0] *= -1.0
    corner = along[:, None] * unit + across[:, None] * normal
    # Radially beyond g the inner groove is a plane wall.
    axial = g[:, 0] - np.copysign(inner, g[:, 0])
    wall = np.stack([axial, np.sqrt(np.maximum(0.0, outer**2 - axial**2))], axis=1)
    return np.where((wall[:, 1] > g[:, 1])[:, None], wall, corner)


def _at_rest(grooves: Grooves, g: Array) -> tuple[Array, Mask]:
    """Positions of the balls without centrifugal force, and which of them are loaded.

    Each ball lies on the line through both groove centres. The approach of a loaded ball is divided between
    its contacts according to their stiffnesses. An unloaded ball lies in the middle of its clearance.
    """
    g = np.maximum(g, _INWARD)
    length = np.hypot(g[:, 0], g[:, 1])
    play = length - grooves.inner_offset - grooves.outer_offset
    held = play > 0.0
    softness = grooves.outer_stiffness ** (-2.0 / 3.0)
    share = np.where(held, softness / (softness + grooves.inner_stiffness ** (-2.0 / 3.0)), 0.5)
    # With very unequal grooves, the middle of a clearance may lie beyond one of the groove centres.
    out = np.clip(grooves.outer_offset + share * play, 0.0, length)
    return (out / np.maximum(length, _TINY))[:, None] * g, held


def _first_guess(grooves: Grooves, g: Array) -> Array:
    """Positions where both contacts are loaded; they lie further out than without centrifugal force."""
    place, _ = _at_rest(grooves, g)
    inner, outer = grooves.contacts(place, g)
    more = (grooves.outward / grooves.outer_stiffness) ** (2.0 / 3.0)
    return _corner(
        g,
        grooves.inner_offset + np.maximum(0.0, inner.depth) + more,
        grooves.outer_offset + np.maximum(0.0, outer.depth) + more,
    )


def _start(grooves: Grooves, g: Array, held: Mask, guess: Seats | None) -> Array:
    """Initial guess: positions of ``guess`` where both contacts are loaded, else those of the first guess."""
    if guess is None:
        return _first_guess(grooves, g)
    inner, outer = grooves.contacts(guess.place, g)
    near = guess.held & (inner.depth > 0.0) & (outer.depth > 0.0)
    if near[held].all():
        return guess.place
    return np.where(near[:, None], guess.place, _first_guess(grooves, g))


def _settled(grooves: Grooves, g: Array, held: Mask, p: Array) -> Array:
    """Positions of the balls loaded by both grooves, by Newton's method from the initial guess p."""
    offset = grooves.inner_offset + grooves.outer_offset

    def imbalance(p: Array) -> tuple[Array, Array, Mask]:
        inner, outer = grooves.contacts(p, g, held)
        force = inner.force - outer.force + grooves.outward * _RADIAL
        tangent = inner.tangent + outer.tangent
        size = inner.load + outer.load + grooves.outward
        noise = _ROUNDING * size + _NUDGE * offset * (tangent[:, 0, 0] + tangent[:, 1, 1])
        # A contact that only just touches has no stiffness: this small one keeps the matrix regular.
        tangent += (1e-13 * size / offset)[:, None, None] * _UNITY
        return force, tangent, np.max(np.abs(force), axis=1) > noise

    force, tangent, moving = imbalance(p)
    for _ in range(_MOST_STEPS):
        if not moving.any():
            break
        step = np.linalg.solve(tangent, force[:, :, None])[:, :, 0]
        length = np.hypot(step[:, 0], step[:, 1])
        step *= np.minimum(1.0, 0.5 * offset / np.maximum(length, _TINY))[:, None]
        slope = np.sum(force * step, axis=1)
        part = np.ones_like(slope)
        for _ in range(_MOST_TRIALS):
            there = p + part[:, None] * step
            force, tangent, moving = imbalance(there)
            now = np.sum(force * step, axis=1)
            over = moving & (now < -_OVERSHOOT * slope)
            if not over.any():
                break
            part = np.where(over, part * np.maximum(slope / np.where(over, slope - now, 1.0), 0.02), part)
        p = there
    return p


def seat(grooves: Grooves, g: Array, guess: Seats | None = None) -> Seats:
    """Positions and contacts of balls between grooves with their centres at 0 and g.

    At speed, a ball that does not touch the inner groove lies at the bottom of the outer groove, where
    centrifugal force presses it. At rest, an unloaded ball lies in the middle of its clearance.

    ``g``, centre of the inner groove at each ball, axial and radial [m], shape (n, 2).

    Examples
    --------
    Two equal contacts share an approach of 2 um equally:

    >>> both = np.full(1, 1e10)
    >>> seats = seat(Grooves(0.2e-3, 0.2e-3, both, both, 0.0), np.array([[0.0, 0.402e-3]]))
    >>> round(float(seats.inner.load[0]), 3), round(float(seats.place[0, 1]) * 1e3, 6)
    (10.0, 0.201)
    """
    if grooves.outward == 0.0:
        place, held = _at_rest(grooves, g)
        return Seats(place, held, *grooves.contacts(place, g))
    bottom = grooves.outer_offset + (grooves.outward / grooves.outer_stiffness) ** (2.0 / 3.0)
    place = bottom[:, None] * _RADIAL
    clear, _ = grooves.contacts(place, g)
    held = clear.depth > 0.0
    if held.any():
        place[held] = _settled(grooves, g[held], held, _start(grooves, g, held, guess)[held])
    return Seats(place, held, *grooves.contacts(place, g))


# Change of the cosines of the contact angles at convergence; each round reduces it by two or three digits.
_SETTLED = 1e-12
_MOST_ROUNDS = 30

# Imbalance of the forces in a round over the last change of the cosines.
_ROUGH = 1e-3

# Longest first step of the ring over the distance of the groove centres.
_REACH = 0.1


@dataclass(frozen=True)
class BallEquilibrium(BearingEquilibrium):
    """Ball bearing in equilibrium. Arrays have one value per ball, shape (n,)."""

    # inner_angle and outer_angle: angle of both contacts [rad]; where a ball does not touch, angle of the
    # smallest gap.
    inner_angle: Array
    outer_angle: Array
    gyroscopic_moment: Array  # gyroscopic moment of each ball [N m]; its effect is neglected
    cage_speed: float  # mean orbital speed of the balls, weighted with their load on the inner ring [rad/s]
    # Displacement of the inner ring from where both grooves face each other [m]; play up to A sin a_0
    axial_displacement: float
    # moment and lateral_moment: moments that keep the ring from tilting, sums of R_i Q_i sin a_i times cos
    # psi and sin psi [N m].
    moment: float
    lateral_moment: float


@dataclass(frozen=True)
class _Angles:
    """Contact angles of the balls [rad]."""

    inner: Array
    outer: Array

    @classmethod
    def of(cls, seats: Seats) -> _Angles:
        """Angles of both contacts; where a ball does not touch, angles of the smallest gap."""
        inner, outer = seats.inner.normal, seats.outer.normal
        return cls(np.arctan2(inner[:, 0], inner[:, 1]), np.arctan2(outer[:, 0], outer[:, 1]))

    @property
    def mean(self) -> Array:
        return 0.5 * (self.inner + self.outer)

    def change(self, other: _Angles) -> float:
        """Largest change of the cosine of a contact angle."""
        pairs = ((self.inner, other.inner), (self.outer, other.outer))
        return max(float(np.max(np.abs(np.cos(a) - np.cos(b)))) for a, b in pairs)


@dataclass(frozen=True)
class _Model:
    """Bearing and operation, with the functions that each round of the solution needs."""

    bearing: BallBearing
    operation: Operation
    modulus: float
    density: float

    @property
    def position(self) -> Array:
        return self.operation.positions(self.bearing.elements)

    @property
    def load(self) -> Array:
        """Load on the ring: axial, along the radial load, and lateral, shape (3,) [N]."""
        return np.array([self.operation.axial_load, self.operation.radial_load, 0.0])

    @property
    def basis(self) -> Array:
        """Derivative of the inner groove centres by the displacement of the ring, shape (n, 2, 3)."""
        basis = np.zeros((self.bearing.elements, 2, 3))
        basis[:, 0, 0] = 1.0
        basis[:, 1, 1], basis[:, 1, 2] = np.cos(self.position), np.sin(self.position)
        return basis

    def centres(self, ring: Array) -> Array:
        """Inner groove centres at a displacement of the ring, shape (n, 2) [m]."""
        return np.asarray(self.basis @ ring + np.array([0.0, self.bearing.radial_distance]))

    def cage_speed(self, angles: _Angles, loads: Array) -> float:
        """Mean orbital speed of the balls, weighted with their loads unless all are 0 [rad/s]."""
        weights = loads if loads.any() else None
        return float(np.average(np.asarray(self.speeds(angles).cage), weights=weights))

    def speeds(self, angles: _Angles) -> Speeds:
        bearing, operation = self.bearing, self.operation
        return rolling_speeds(
            bearing.ball_diameter,
            bearing.pitch_diameter,
            operation.inner_speed,
            operation.outer_speed,
            angles.mean,
        )

    def grooves(self, angles: _Angles, outward: float) -> Grooves:
        """Both grooves, with the contact stiffnesses K at these contact angles."""
        inner, outer = stiffness_laws(self.bearing, self.modulus)
        return Grooves(
            *self.bearing.offsets,
            np.exp(inner(np.cos(angles.inner))),
            np.exp(outer(np.cos(angles.outer))),
            outward,
        )

    def start(self) -> tuple[Array, _Angles]:
        """Displacement at which the ring just touches under its axial load, and the free contact angles."""
        angle = np.full(self.bearing.elements, self.bearing.free_angle)
        axial = np.sign(self.operation.axial_load) * 0.5 * self.bearing.endplay
        return np.array([axial, 0.0, 0.0]), _Angles(angle, angle)


class _BallReaction:
    """Force of the balls over the ring's displacement; each call starts from the seats of the last one.

    The first call starts from ``seats``, where they are given.
    """

    def __init__(self, model: _Model, grooves: Grooves, seats: Seats | None = None) -> None:
        self._model, self._grooves = model, grooves
        self._basis = model.basis
        self._ring = np.full(3, np.nan)
        self._seats = seats

    def __call__(self, ring: Array) -> tuple[Array, Array]:
        """Force on the ring at a displacement, and its derivative, as ``balance`` needs them."""
        seats, basis = self.seats(ring), self._basis
        force = np.einsum("nij,ni->j", basis, seats.inner.force)
        return force, np.sum(basis.transpose(0, 2, 1) @ seats.tangent @ basis, axis=0)

    def seats(self, ring: Array) -> Seats:
        """Seats of the balls at a displacement of the ring."""
        if self._seats is None or not np.array_equal(ring, self._ring):
            self._seats = seat(self._grooves, self._model.centres(ring), self._seats)
            self._ring = ring
        return self._seats


@dataclass(frozen=True)
class _State:
    """Displacement of the ring and seats of the balls, for contact stiffnesses that are constant."""

    ring: Array
    grooves: Grooves
    seats: Seats
    angles: _Angles
    residual: float

    @classmethod
    def solved(
        cls, model: _Model, grooves: Grooves, ring: Array, aim: float, seats: Seats | None = None
    ) -> tuple[_State, int]:
        """State balanced to ``aim``, and the number of Newton steps.

        The initial guess is a displacement, and seats where those of nearly the same stiffnesses are known.
        """
        # Rounding errors scale with contact forces, and the centrifugal force may exceed a light load.
        scale = float(np.linalg.norm(model.load)) + grooves.outward
        reach = _REACH * model.bearing.groove_distance
        reaction = _BallReaction(model, grooves, seats)
        ring, residual, steps = balance(reaction, model.load, ring, reach, scale, aim)
        seats = reaction.seats(ring)
        imbalance = seats.inner.force - seats.outer.force
        imbalance[:, 1] += grooves.outward
        # An unloaded ball of a bearing at rest has no forces: its imbalance is 0.
        residual = max(residual, float(np.max(np.abs(imbalance))) / scale)
        return cls(ring, grooves, seats, _Angles.of(seats), residual), steps


def _solve(model: _Model) -> tuple[_State, int]:
    """State in equilibrium: each round takes stiffnesses and cage speed from the last round's angles."""
    bearing = model.bearing
    ring, angles = model.start()
    # The equilibrium without centrifugal force is quick to compute, and a good initial guess.
    state, iterations = _State.solved(model, model.grooves(angles, 0.0), ring, _ROUGH)
    mass, change = bearing.element_mass(model.density), 1.0
    for rounds in count():
        cage = model.cage_speed(state.angles, state.seats.inner.load)
        outward = centrifugal_force(mass, bearing.pitch_diameter, cage)
        # Forces that balance far better than the angles are known are not worth their steps.
        aim = max(AIM, _ROUGH * change)
        settled, steps = _State.solved(
            model, model.grooves(state.angles, outward), state.ring, aim, state.seats
        )
        iterations += steps
        change, state = settled.angles.change(state.angles), settled
        if change <= _SETTLED and aim == AIM:
            break
        if rounds == _MOST_ROUNDS:
            raise ConvergenceError(f"contact angles of the balls, whose cosines still change by {change:.1e}")
    if state.residual > GOOD:
        raise ConvergenceError(f"forces on ring and balls, balanced only to {state.residual:.1e} of the load")
    return state, iterations


def ball_equilibrium(
    bearing: BallBearing, operation: Operation, modulus: float, density: float
) -> BallEquilibrium:
    """Equilibrium of the inner ring and of all balls.

    The sum of Q_i sin a_i over the balls is the axial load, and the sum of Q_i cos a_i cos psi is the radial
    load. The sum of Q_i cos a_i sin psi is zero. At each ball Q_o sin a_o = Q_i sin a_i and
    Q_o cos a_o = Q_i cos a_i + F_c. The stiffness K of each contact belongs to its own contact angle. At
    speed, a ball without load from the inner ring lies in the outer groove under its centrifugal force, and
    its clearance is at the inner ring.

    ``modulus``, reduced modulus E' of ball and ring [Pa], with 2/E' = (1 - nu1^2)/E1 + (1 - nu2^2)/E2;
    ``density`` [kg/m^3]. Returns forces that balance to 1e-9 of the load plus the centrifugal force. Raises
    InputError where the bearing cannot carry the load; ConvergenceError where the iteration does not
    converge.

    Examples
    --------
    An axial load of 900 N on nine balls:

    >>> bearing = BallBearing(9, 11.906e-3, 60e-3, 0.52, 0.52, radial_clearance=10e-6)
    >>> state = ball_equilibrium(bearing, Operation(0.0, 900.0), 226e9, 7800.0)
    >>> angle = state.inner_angle[0]
    >>> bool(np.allclose(state.inner_load * np.sin(angle), 100.0, rtol=1e-9))
    True
    """
    if bearing.contact_angle is not None and operation.axial_load <= 0.0:
        raise InputError(
            "axial_load",
            got=f"{operation.axial_load:g} N",
            takes="one above 0: an angular-contact bearing carries it one way, and a radial load only "
            "with it",
        )
    model = _Model(bearing, operation, modulus, density)
    state, iterations = _solve(model)
    seats, angles = state.seats, state.angles
    mass, speeds = bearing.element_mass(density), model.speeds(angles)
    # The moments are about the centre of the circle of groove centres, which the contact forces pass through.
    levers = bearing.inner_centre_radius * seats.inner.force[:, 0]
    return BallEquilibrium(
        position=model.position,
        inner_load=seats.inner.load,
        outer_load=seats.outer.load,
        inner_angle=angles.inner,
        outer_angle=angles.outer,
        inner_approach=np.maximum(0.0, seats.inner.depth),
        outer_approach=np.maximum(0.0, seats.outer.depth),
        inner_gap=np.maximum(0.0, -seats.inner.depth),
        outer_gap=np.maximum(0.0, -seats.outer.depth),
        speeds=speeds,
        gyroscopic_moment=gyroscopic_moment(mass, bearing.ball_diameter, speeds, angles.mean),
        cage_speed=model.cage_speed(state.angles, seats.inner.load),
        centrifugal_force=state.grooves.outward,
        axial_displacement=float(state.ring[0]),
        radial_displacement=float(state.ring[1]),
        lateral_displacement=float(state.ring[2]),
        moment=float(levers @ np.cos(model.position)),
        lateral_moment=float(levers @ np.sin(model.position)),
        residual=state.residual,
        iterations=iterations,
    )
