"""Equilibrium of a ball bearing: what each ball carries, at what angles, and where the rings stand. SI units.

Harris' model for speed. The inner ring is displaced, not tilted; each ball sits between both grooves under
the forces of its contacts and its centrifugal force, so that its contact angles differ. Rings keep their
shape apart from the contacts. The gyroscopic moment is reported and its effect left out, as is friction; the
grooves have no shoulder here, so that contact angles are to be compared with where it begins.

A. B. Jones, J. Basic Eng. 82 (1960) 309-320, doi:10.1115/1.3662587; T. A. Harris and M. N. Kotzalas, Advanced
Concepts of Bearing Technology, 5th ed., 2006, chapters 1 and 3, doi:10.1201/9781420006582.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from itertools import count

import numpy as np
from numpy.polynomial import Chebyshev

from ehlectric.arrays import Array
from ehlectric.bearing.loads.geometry import BallBearing
from ehlectric.bearing.loads.kinematics import Speeds, centrifugal_force, gyroscopic_moment, rolling_speeds
from ehlectric.bearing.loads.ring import GOOD, UNLOADED, Operation, Reaction, RingLoads, balance
from ehlectric.bearing.loads.seating import Grooves, Seats, lean_outward, seat
from ehlectric.errors import ConvergenceError, InputError, shown
from ehlectric.formulas.hertz_point import dry_contact

# K changes by a few percent over all angles and smoothly: this degree leaves less than 1e-11 of it, unless
# a handful of balls fill their pitch circle.
_DEGREE = 24

# Cosines of the contact angles have settled; each round takes two or three digits off their change.
_SETTLED = 1e-12
_MOST_ROUNDS = 30

# First step of the ring over the distance of the groove centres.
_REACH = 0.1


@dataclass(frozen=True)
class BallEquilibrium:
    """Ball bearing in equilibrium; arrays hold one number a ball.

    Attributes
    ----------
    position : ndarray, shape (n,)
        Angle from the direction of the radial load [rad].
    inner_load, outer_load : ndarray
        Q of both contacts [N].
    inner_angle, outer_angle : ndarray
        Contact angle of both [rad]; where a ball does not touch, that of the narrowest place.
    inner_approach, outer_approach : ndarray
        By how much ball and ring come closer in the contact [m].
    inner_gap, outer_gap : ndarray
        Least distance of ball and groove where they do not touch [m], else 0.
    speeds : Speeds
        That each ball would roll at with the mean of its contact angles.
    gyroscopic_moment : ndarray
        [N m]; its effect is left out.
    cage_speed : float
        Mean of that of the balls, weighted with their load on the inner ring [rad/s].
    centrifugal_force : float
        On each ball, at ``cage_speed`` [N].
    axial_displacement : float
        Of the inner ring from where its groove faces the outer one [m]; A sin a_0 of that is free.
    radial_displacement, lateral_displacement : float
        Of the inner ring along the radial load, and at right angles to it, towards the angle of 90 deg [m].
    moment, lateral_moment : float
        That hold the ring from tilting, sum of R_i Q_i sin a_i times cos psi and sin psi [N m], about the
        centre of the circle of inner groove centres, in whose plane the radial load acts; R_i is its radius.
    residual : float
        Largest force that ring or ball miss to balance, over the load and the centrifugal force together.
    iterations : int
        Newton steps of the ring.
    """

    position: Array
    inner_load: Array
    outer_load: Array
    inner_angle: Array
    outer_angle: Array
    inner_approach: Array
    outer_approach: Array
    inner_gap: Array
    outer_gap: Array
    speeds: Speeds
    gyroscopic_moment: Array
    cage_speed: float
    centrifugal_force: float
    axial_displacement: float
    radial_displacement: float
    lateral_displacement: float
    moment: float
    lateral_moment: float
    residual: float
    iterations: int

    def ring(self, *, inner: bool) -> RingLoads:
        """Contacts of all balls with the inner or the outer ring."""
        if inner:
            speed = np.asarray(self.speeds.inner_entrainment)
            return RingLoads(self.inner_load, self.inner_angle, self.inner_approach, self.inner_gap, speed)
        speed = np.asarray(self.speeds.outer_entrainment)
        return RingLoads(self.outer_load, self.outer_angle, self.outer_approach, self.outer_gap, speed)


def contact_stiffness(bearing: BallBearing, modulus: float, angle: float, *, inner: bool) -> float:
    """K of Q = K delta^(3/2) at one contact, from the exact ellipse.

    Parameters
    ----------
    bearing : BallBearing
        The bearing.
    modulus : float
        Reduced modulus E' of ball and ring [Pa], with 2/E' = (1 - nu1^2)/E1 + (1 - nu2^2)/E2.
    angle : float
        Contact angle [rad].
    inner : bool
        Which contact.

    Returns
    -------
    float
        [N/m^(3/2)].

    Examples
    --------
    >>> bearing = BallBearing(9, 11.906e-3, 60e-3, 0.52, 0.52, radial_clearance=10e-6)
    >>> k = contact_stiffness(bearing, 226e9, 0.0, inner=True)
    >>> round(1e6 * (870.0 / k) ** (2 / 3), 2)
    9.24
    """
    radii = bearing.radii(angle, inner=inner)
    return float(dry_contact(1.0, radii.radius_x, radii.radius_y, modulus).approach ** -1.5)


@lru_cache(maxsize=32)
def _stiffness_laws(bearing: BallBearing, modulus: float) -> tuple[Chebyshev, Chebyshev]:
    """Logarithm of K at the inner and outer contacts over the cosine of the contact angle."""

    def law(*, inner: bool) -> Chebyshev:
        def logarithm(cosines: Array) -> Array:
            angles = np.arccos(cosines)
            return np.log([contact_stiffness(bearing, modulus, float(a), inner=inner) for a in angles])

        return Chebyshev.interpolate(logarithm, _DEGREE, domain=[0.0, 1.0])

    return law(inner=True), law(inner=False)


@dataclass(frozen=True)
class _Angles:
    """Contact angles of the balls [rad]."""

    inner: Array
    outer: Array

    @classmethod
    def of(cls, seats: Seats) -> _Angles:
        """Angles of both contacts, or of the narrowest places where there are none."""
        inner, outer = seats.inner.normal, seats.outer.normal
        return cls(np.arctan2(inner[:, 0], inner[:, 1]), np.arctan2(outer[:, 0], outer[:, 1]))

    @property
    def mean(self) -> Array:
        return 0.5 * (self.inner + self.outer)

    def change(self, other: _Angles) -> float:
        """Largest change of a cosine."""
        pairs = ((self.inner, other.inner), (self.outer, other.outer))
        return max(float(np.max(np.abs(np.cos(a) - np.cos(b)))) for a, b in pairs)


@dataclass(frozen=True)
class _Model:
    """A bearing and its operation, as the rounds of the solution need them."""

    bearing: BallBearing
    operation: Operation
    modulus: float
    density: float

    @property
    def position(self) -> Array:
        return self.operation.positions(self.bearing.elements)

    @property
    def load(self) -> Array:
        """On the ring, axial, along the radial load, and lateral [N]."""
        return np.array([self.operation.axial_load, self.operation.radial_load, 0.0])

    @property
    def basis(self) -> Array:
        """Derivative of each ball's groove centre by the displacement of the ring, shape (n, 2, 3)."""
        basis = np.zeros((self.bearing.elements, 2, 3))
        basis[:, 0, 0] = 1.0
        basis[:, 1, 1], basis[:, 1, 2] = np.cos(self.position), np.sin(self.position)
        return basis

    def centres(self, ring: Array) -> Array:
        """Inner groove centres at a displacement of the ring, shape (n, 2) [m]."""
        return np.asarray(self.basis @ ring + np.array([0.0, self.bearing.radial_distance]))

    def cage_speed(self, angles: _Angles, loads: Array) -> float:
        """Mean speed of the balls about the axis, weighted with what they carry, if anything [rad/s]."""
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
        """Both grooves, with K of these contact angles."""
        inner, outer = _stiffness_laws(self.bearing, self.modulus)
        return Grooves(
            *self.bearing.offsets,
            np.exp(inner(np.cos(angles.inner))),
            np.exp(outer(np.cos(angles.outer))),
            outward,
        )

    def reaction(self, grooves: Grooves) -> Reaction:
        """Force of the balls on the ring over its displacement; each seating starts from the last one."""
        basis = self.basis
        across = basis.transpose(0, 2, 1)
        last: Seats | None = None

        def reaction(ring: Array) -> tuple[Array, Array]:
            nonlocal last
            last = seats = seat(grooves, self.centres(ring), last)
            force = np.einsum("nij,ni->j", basis, seats.inner.force)
            return force, np.sum(across @ seats.tangent @ basis, axis=0)

        return reaction

    def start(self) -> tuple[Array, _Angles]:
        """Displacement at which the ring just touches under its axial load, and the free contact angles."""
        angle = np.full(self.bearing.elements, self.bearing.free_angle)
        axial = np.sign(self.operation.axial_load) * 0.5 * self.bearing.endplay
        return np.array([axial, 0.0, 0.0]), _Angles(angle, angle)


@dataclass(frozen=True)
class _State:
    """The ring's displacement and its balls, at contact stiffnesses of given angles."""

    ring: Array
    grooves: Grooves
    seats: Seats
    angles: _Angles
    residual: float

    @classmethod
    def solved(cls, model: _Model, grooves: Grooves, ring: Array) -> tuple[_State, int]:
        """The balance from a displacement to start from, and the steps it took."""
        # Balls that fly press harder than a light load does, and so does what rounding leaves.
        scale = float(np.linalg.norm(model.load)) + grooves.outward
        reach = _REACH * model.bearing.groove_distance
        ring, residual, steps = balance(model.reaction(grooves), model.load, ring, reach, scale)
        seats = seat(grooves, model.centres(ring))
        imbalance = seats.inner.force - seats.outer.force
        imbalance[:, 1] += grooves.outward
        # A ball at rest that nothing holds needs no force either.
        residual = max(residual, float(np.max(np.abs(imbalance))) / scale)
        return cls(ring, grooves, seats, _Angles.of(seats), residual), steps


def _solve(model: _Model) -> tuple[_State, int]:
    """Rounds of a balance with the contact stiffnesses and the cage speed of the last one's angles."""
    bearing = model.bearing
    ring, angles = model.start()
    # Without centrifugal force first: quick, and close to where the ring comes to stand.
    state, iterations = _State.solved(model, model.grooves(angles, 0.0), ring)
    mass = bearing.element_mass(model.density)
    for rounds in count():
        cage = model.cage_speed(state.angles, state.seats.inner.load)
        outward = centrifugal_force(mass, bearing.pitch_diameter, cage)
        settled, steps = _State.solved(model, model.grooves(state.angles, outward), state.ring)
        iterations += steps
        change, state = settled.angles.change(state.angles), settled
        if change <= _SETTLED:
            break
        if rounds == _MOST_ROUNDS:
            raise ConvergenceError(
                f"contact angles of the balls still change by {change:.1e} in their cosine"
            )
    if state.residual > GOOD:
        raise ConvergenceError(f"forces on ring and balls balance to {state.residual:.1e} of the load only")
    return state, iterations


def _refuse(bearing: BallBearing, operation: Operation, unloaded: str) -> None:
    """Raise InputError for what the bearing cannot do."""
    if unloaded not in UNLOADED:
        raise InputError("unloaded", got=shown(unloaded), takes=f"one of {', '.join(UNLOADED)}")
    if bearing.contact_angle is not None and operation.axial_load <= 0.0:
        raise InputError(
            "axial_load",
            got=f"{operation.axial_load:g} N",
            takes="one above 0: an angular-contact bearing carries it one way, and a radial load only "
            "with it",
        )


def _placed(state: _State, g: Array, unloaded: str) -> Seats:
    """Seats with the unloaded balls of a bearing at rest where they are wanted."""
    seats, grooves = state.seats, state.grooves
    if unloaded == "centred" or grooves.outward > 0.0:
        return seats
    place = np.where(seats.held[:, None], seats.place, lean_outward(grooves, g))
    return Seats(place, seats.held, *grooves.contacts(place, g))


def ball_equilibrium(
    bearing: BallBearing, operation: Operation, modulus: float, density: float, *, unloaded: str = "centred"
) -> BallEquilibrium:
    """Equilibrium of the inner ring over all balls.

    The sum over the balls of Q_i sin a_i is the axial load, that of Q_i cos a_i cos psi the radial one, that
    of Q_i cos a_i sin psi vanishes; at each ball Q_o sin a_o = Q_i sin a_i and
    Q_o cos a_o = Q_i cos a_i + F_c. K of each contact is that of its own contact angle. At speed a ball
    without load from the inner ring stays at the outer one with the centrifugal force alone, and its
    clearance is at the inner ring.

    Parameters
    ----------
    bearing : BallBearing
        Its geometry.
    operation : Operation
        Loads, speeds and position.
    modulus : float
        Reduced modulus E' of ball and ring [Pa], with 2/E' = (1 - nu1^2)/E1 + (1 - nu2^2)/E2.
    density : float
        Of the balls [kg/m^3].
    unloaded : str
        Where balls without load are in a bearing at rest, gravity left out: "centred", between equal gaps, or
        "outer", at the outer ring, as in slow rotation.

    Returns
    -------
    BallEquilibrium
        Forces in balance to 1e-9 of the load and the centrifugal force.

    Raises
    ------
    InputError
        Where the bearing cannot bear the load.
    ConvergenceError
        Where no balance was found.

    Examples
    --------
    >>> bearing = BallBearing(9, 11.906e-3, 60e-3, 0.52, 0.52, radial_clearance=10e-6)
    >>> state = ball_equilibrium(bearing, Operation(0.0, 900.0), 226e9, 7800.0)
    >>> angle = state.inner_angle[0]
    >>> bool(np.allclose(state.inner_load * np.sin(angle), 100.0, rtol=1e-9))
    True
    """
    _refuse(bearing, operation, unloaded)
    model = _Model(bearing, operation, modulus, density)
    state, iterations = _solve(model)
    seats = _placed(state, model.centres(state.ring), unloaded)
    angles = _Angles.of(seats)
    mass, speeds = bearing.element_mass(density), model.speeds(angles)
    # About the centre of the ring's own groove circle: a contact's force passes through the groove's centre.
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
