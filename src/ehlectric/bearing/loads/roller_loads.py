"""Equilibrium of a bearing with rollers, which are divided into slices as in ISO 16281. SI units.

The inner ring is displaced along and across the radial load, and along the axis where the contact angle is
above zero, but it is not tilted, and the rollers stay parallel to the raceways. Each slice of a roller is
compressed between both raceways and carries a load of its own. The profile of the roller thus determines the
distribution of the load along it. Friction and the bending of the rings are neglected.

Ribs carry nothing: of cylindrical rollers no axial load, and of tapered rollers not the force that presses
them against the flange. That force follows from the taper, as the normals of both raceways differ by its
angle, and from the part of the centrifugal force along the raceway; it changes the loads by less than a tenth
for tapers up to five degrees. Both contacts of a tapered roller have the contact angle of the bearing here.

ISO/TS 16281:2008, Rolling bearings - Methods for calculating the modified reference rating life for
universally loaded bearings.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ehlectric.arrays import Array, IntArray, Mask, Numbers, as_float
from ehlectric.bearing.loads.geometry import RollerBearing, Speeds, centrifugal_force, rolling_speeds
from ehlectric.bearing.loads.ring import Batch, BearingEquilibrium, Operation, balance, refuse_unbalanced
from ehlectric.errors import InputError
from ehlectric.formulas.hertz import body_compliance, reduced_modulus
from ehlectric.readable import readable

# q = c delta^(10/9). For both contacts of a steel roller together, c_L = 35 948 L^(8/9) N/mm^(10/9), L in mm.
_POWER = 10.0 / 9.0
_STANDARD = 35948.0 * 1e6

# The standard is for steel; the elastic constants of this steel are an assumption.
_STEEL = reduced_modulus(body_compliance(206e9, 0.3), body_compliance(206e9, 0.3))

# The standard requires at least 30 slices; with an odd number, one slice is in the middle.
SLICES = 41
_LEAST_SLICES = 31
_MOST_STEPS = 100


def _ninth_root(depth: Array) -> Array:
    """Depth to the power 1/9, _POWER - 1; two cube roots take less time than a power."""
    return np.asarray(np.cbrt(np.cbrt(depth)))


# Relative rounding errors: of the loads of a roller, and of depths over the interference.
_ROUNDING, _NUDGE = 4e-15, 4e-16

# Points of operation that are computed together: few enough for the processor's cache.
_BLOCK = 256


@dataclass(frozen=True)
class RollerEquilibrium(BearingEquilibrium):
    """Roller bearing in equilibrium. Arrays have a value per roller, shape (..., elements), unless stated."""

    # Position of the middle of each slice, from the middle of the roller [m], shape (..., slices).
    slice_position: Array
    # inner_line_load and outer_line_load: load of each slice per length [N/m], shape (..., elements, slices).
    inner_line_load: Array
    outer_line_load: Array
    # inner_angle and outer_angle: contact angles [rad], negative in a second row, shape (..., elements).
    inner_angle: Array
    outer_angle: Array
    # Displacement of the inner ring along the axis from where the rollers just touch [m]; of a pair, from the
    # middle between its rows; 0 of cylindrical rollers.
    axial_displacement: Numbers

    # The moment that keeps the ring from tilting and the gyroscopic moment of rollers are not computed.
    moment: ClassVar[None] = None
    gyroscopic_moment: ClassVar[None] = None

    @property
    def cage_speed(self) -> Numbers:
        """Angular speed of the cage about the axis of the bearing [rad/s]."""
        return as_float(self.speeds.cage)

    @property
    def holds_axially(self) -> bool:
        """Whether the raceways hold the ring along the axis; raceways of cylindrical rollers do not."""
        return bool(np.any(self.inner_angle))


def line_stiffness(length: Numbers, modulus: Numbers) -> Numbers:
    """Stiffness c_L of Q = c_L delta^(10/9) for a straight roller and both its contacts together.

    For steel c_L = 35 948 L^(8/9) N/mm^(10/9), with L in mm. This value comes from Palmgren's formula, in
    which the approach is proportional to (Q/E')^(9/10); c_L is therefore proportional to E'. The steel of the
    standard is assumed to have an elastic modulus of 206 GPa and Poisson's ratio 0.3.

    ``length``, effective length L of the roller [m]; ``modulus``, reduced modulus E' of roller and ring [Pa],
    with 2/E' = (1 - nu1^2)/E1 + (1 - nu2^2)/E2; shape (...). Returns stiffness c_L [N/m^(10/9)], shape (...).

    Examples
    --------
    Steel roller 10 mm long, in N/mm^(10/9):

    >>> steel = reduced_modulus(body_compliance(206e9, 0.3), body_compliance(206e9, 0.3))
    >>> round(line_stiffness(10e-3, steel) / 1e3 ** (10 / 9))
    278332
    """
    return as_float(_STANDARD * length ** (8.0 / 9.0) * modulus / _STEEL)


@dataclass(frozen=True)
class _Profile:
    """Slices of rollers in contact with a raceway, of n contacts or points.

    The profile is symmetric: slices are counted from the middle of the roller to one end, and each of them
    but the middle one stands for two.
    """

    stiffness: Array  # stiffness of one slice [N/m^(10/9)], shape (n,) or (1,)
    relief: Array  # relief of each slice [m], shape (h, n) or (h, 1), least in the middle
    weights: Array  # number of slices with this relief, shape (h,)

    @classmethod
    def of(cls, stiffness: Numbers, relief: Array) -> _Profile:
        """Profile from the relief of all slices, shape (..., slices)."""
        slices = relief.shape[-1]
        if not relief.any():
            return cls(np.atleast_1d(stiffness), np.zeros((1, 1)), np.array([float(slices)]))
        half = np.atleast_2d(relief)[:, slices // 2 :].T
        weights = np.full(len(half), 2.0)
        weights[0] = 1.0
        return cls(np.atleast_1d(stiffness), np.ascontiguousarray(half), weights)

    @property
    def least_relief(self) -> Array:
        """Relief of the slice that touches first [m]."""
        return np.asarray(self.relief[0])

    def chosen(self, points: slice | Mask | IntArray) -> _Profile:
        """Slices of some of the points, or of contacts at points with these indices."""
        stiffness, relief = (
            value if value.shape[-1] == 1 else value[..., points] for value in (self.stiffness, self.relief)
        )
        return _Profile(stiffness, relief, self.weights)

    def load(self, depth: Array) -> tuple[Array, Array]:
        """Load of contacts with a depth [m], shape (n,) [N], and its derivative [N/m]."""
        pressed = np.maximum(0.0, depth - self.relief)
        root = _ninth_root(pressed)
        stiff = _POWER * self.stiffness * (self.weights @ root)
        root *= pressed
        return self.stiffness * (self.weights @ root), stiff

    def slices(self, depth: Array, number: int) -> Array:
        """Load of each of the slices of contacts with a depth [m], shape (n, elements), shape
        (n, elements, number) [N].
        """
        pressed = np.maximum(0.0, depth[..., np.newaxis] - self.relief.T[:, np.newaxis])
        half = self.stiffness[:, np.newaxis, np.newaxis] * pressed * _ninth_root(pressed)
        # Slices from one end to the other have the relief of those from the middle to the end.
        across = np.abs(np.arange(number) - number // 2) if len(self.weights) > 1 else np.zeros(number, int)
        return np.take(half, across, axis=-1)

    def bottom(self, outward: Array) -> Array:
        """Depth at which an outer contact carries only the centrifugal force [m], shape (n,)."""
        # Upper bound: at this depth the slice that touches first carries the whole force. From there
        # Newton's method for a convex function does not overshoot.
        depth = (outward / self.stiffness) ** (1.0 / _POWER) + self.least_relief
        for _ in range(_MOST_STEPS):
            load, stiff = self.load(depth)
            step = (load - outward) / np.where(stiff > 0.0, stiff, 1.0)
            depth = np.maximum(0.0, depth - step)
            if np.all(np.abs(step) <= 2e-16 * depth):
                break
        return np.where(outward > 0.0, depth, 0.0)


@dataclass(frozen=True)
class _Points:
    """Rollers between two raceways at n points of operation."""

    profile: _Profile
    outward: Array  # centrifugal force on each roller [N], shape (n,)
    bottom: Array  # depth of outer contacts that carry only the centrifugal force [m], shape (n,)
    # cosine and sine of the position of each roller, by the cosine of the contact angle, shape (elements, n).
    cosine: Array
    sine: Array
    play: Array  # distance of both raceways beyond the roller in concentric rings [m], shape (n,)
    load: Array  # radial, lateral and axial load [N], shape (3, n)
    lever: Array  # sine of the contact angle, negative in a second row, shape (elements, n)
    preload: Array  # axial force of both rows of a pair against each other without load [N], shape (n,)

    @classmethod
    def of(cls, batch: Batch[RollerBearing], relief: Array) -> _Points:
        """Points of a batch; relief of all slices, shape (slices,) or (n, slices)."""
        bearing, operation = batch.bearing, batch.operation
        shape = (batch.signs.size, batch.number)
        # The standard's stiffness holds for two equal contacts in series.
        stiffness = 2.0**_POWER * line_stiffness(bearing.roller_length, batch.modulus) / relief.shape[-1]
        profile = _Profile.of(stiffness, relief)
        sine, cosine = _sine_and_cosine(bearing)
        # The rest of the centrifugal force acts along the raceway, and on the flange or the cage.
        outward = cosine * _centrifugal_force(batch)
        zero = np.zeros(shape[1])
        load = np.stack([zero + operation.radial_load, zero, zero + operation.axial_load])
        play = 0.5 * bearing.radial_clearance * cosine - _closed(bearing, profile, sine)

        def spread(values: Numbers, shape: tuple[int, ...]) -> Array:
            return np.array(np.broadcast_to(values, shape))

        return cls(
            profile,
            outward=outward,
            bottom=spread(profile.bottom(outward), shape[1:]),
            cosine=spread(cosine * np.cos(batch.rows), shape),
            sine=spread(cosine * np.sin(batch.rows), shape),
            play=spread(play, shape[1:]),
            load=load,
            lever=spread(sine * batch.signs, shape),
            preload=spread(bearing.rows.preload, shape[1:]),
        )

    def chosen(self, points: slice | IntArray) -> _Points:
        """Some of the points."""
        profile, *values = vars(self).values()
        return _Points(profile.chosen(points), *(value[..., points] for value in values))

    @property
    def size(self) -> Array:
        """Resultant load [N], shape (n,)."""
        return np.asarray(np.hypot(self.load[0], self.load[2]))

    @property
    def scale(self) -> Array:
        """Force that unbalanced forces are relative to [N]."""
        return self.size + self.outward + self.preload

    def interference(self, ring: Array) -> Array:
        """Sum of the depths of both contacts [m], negative for a gap, at displacements of shape (k, n)."""
        total = -self.play
        for displacement, way in zip(ring, self.ways, strict=True):
            total = total + displacement * way
        return np.asarray(total)

    @property
    def ways(self) -> tuple[Array, ...]:
        """Components of the normals of the contacts along displacements of the ring, shape (elements, n).

        They are radial, lateral, and axial where contacts carry axial loads.
        """
        return (self.cosine, self.sine, self.lever)[: 3 if self.lever.any() else 2]


class _Reaction:
    """Forces of the rollers over displacements of rings; each call starts from the depths of the last one."""

    def __init__(self, points: _Points) -> None:
        self._points = points
        self._outer = np.zeros_like(points.cosine)
        self._interference = np.zeros_like(points.cosine)
        # Change of the depth of outer contacts with the interference.
        self._share = np.full_like(points.cosine, 0.5)

    def seats(self, ring: Array, chosen: IntArray) -> tuple[Array, Array, Array]:
        """Depth of outer contacts [m], load of inner ones [N], and stiffness of both in series [N/m].

        ``ring``, displacements of the points ``chosen``, shape (k, m). Returns values of shape (elements, m).
        Without centrifugal force each contact has half of the interference.
        """
        points = self._points.chosen(chosen)
        interference = points.interference(ring)
        resting = points.outward == 0.0
        outer = np.where(resting, 0.5 * interference, points.bottom)
        loaded = interference > np.where(resting, 0.0, points.bottom + points.profile.least_relief)
        load, series, share = np.zeros_like(outer), np.zeros_like(outer), np.full_like(outer, 0.5)
        if loaded.any():
            where = np.nonzero(loaded)[1]
            change = interference - self._interference[:, chosen]
            guess = (self._outer[:, chosen] + self._share[:, chosen] * change)[loaded]
            rollers = _Rollers(
                points.profile.chosen(where),
                points.outward[where],
                points.bottom[where],
                interference[loaded],
            )
            outer[loaded], load[loaded], series[loaded], share[loaded] = rollers.shared(guess)
        self._outer[:, chosen], self._interference[:, chosen] = outer, interference
        self._share[:, chosen] = share
        return outer, load, series

    def __call__(self, ring: Array, chosen: IntArray) -> tuple[Array, Array]:
        """Forces on rings at displacements, and their derivatives, as ``balance`` needs them."""
        _, load, series = self.seats(ring.T, chosen)
        ways = [values[:, chosen] for values in self._points.ways]
        stiff, number = [series * way for way in ways], range(len(ways))
        force = [np.add.reduce(load * way, axis=0) for way in ways]
        # Each pair once, as rounding must not make the matrices unsymmetric.
        tangent = [np.add.reduce(stiff[min(i, j)] * ways[max(i, j)], axis=0) for i in number for j in number]
        return np.stack(force, axis=-1), np.stack(tangent, axis=-1).reshape(-1, len(ways), len(ways))


@dataclass(frozen=True)
class _Rollers:
    """Rollers that both rings load, shape (n,)."""

    profile: _Profile
    outward: Array  # centrifugal force [N]
    bottom: Array  # depth of an outer contact under only the centrifugal force [m]
    interference: Array  # sum of the depths of both contacts [m]

    def shared(self, guess: Array) -> list[Array]:
        """Depth of the outer contacts [m], load of the inner ones [N], stiffness in series [N/m], and change
        of the depth with the interference.

        Newton's method between bounds, from a guess of the depths [m]. An outer contact carries at least
        the centrifugal force, and at least the load of the inner contact. Its depth is at most the sum of
        half the interference and the depth under only the centrifugal force, because loads grow faster than
        depths.
        """
        half = 0.5 * self.interference
        low, high = np.maximum(half, self.bottom), np.minimum(half + self.bottom, self.interference)
        outer = np.clip(guess, low, high)
        results, going, now = [np.empty_like(half) for _ in range(4)], np.arange(half.size), self
        for _ in range(_MOST_STEPS):
            (load, stiff), (inner, soft) = now.profile.load(outer), now.profile.load(now.interference - outer)
            excess, both = load - inner - now.outward, stiff + soft
            noise = _ROUNDING * (load + now.outward) + _NUDGE * now.interference * both
            done = (np.abs(excess) <= noise) | (high - low <= 1e-16 * now.interference)
            share = soft / both
            for values, new in zip(results, (outer, inner, stiff * share, share), strict=True):
                values[going] = new
            if done.all():
                break
            on = ~done
            low, high = np.where(excess < 0.0, outer, low)[on], np.where(excess < 0.0, high, outer)[on]
            newton = (outer - excess / both)[on]
            outer = np.where((newton >= low) & (newton <= high), newton, 0.5 * (low + high))
            going, now = going[on], now.chosen(on)
        return results

    def chosen(self, rollers: Mask) -> _Rollers:
        """Some of the rollers."""
        others = (value[rollers] for value in (self.outward, self.bottom, self.interference))
        return _Rollers(self.profile.chosen(rollers), *others)


def _rolling(batch: Batch[RollerBearing]) -> Speeds:
    """Speeds of cage, rollers and contacts; floats, or arrays of shape (n,)."""
    bearing, operation = batch.bearing, batch.operation
    return rolling_speeds(
        element_diameter=bearing.roller_diameter,
        pitch_diameter=bearing.pitch_diameter,
        inner_speed=operation.inner_speed,
        outer_speed=operation.outer_speed,
        contact_angle=bearing.contact_angle,
    )


def _centrifugal_force(batch: Batch[RollerBearing]) -> Array:
    """Centrifugal force on each roller [N], shape (n,)."""
    mass, cage = batch.bearing.element_mass(batch.density), _rolling(batch).cage
    force = centrifugal_force(mass=mass, pitch_diameter=batch.bearing.pitch_diameter, cage_speed=cage)
    return np.array(np.broadcast_to(force, (batch.number,)))


def _sine_and_cosine(bearing: RollerBearing) -> tuple[Numbers, Numbers]:
    """Sine and cosine of the contact angle; a thrust bearing carries no radial load, not even a rounding."""
    if bearing.thrust:
        return 1.0, 0.0
    return as_float(np.sin(bearing.contact_angle)), as_float(np.cos(bearing.contact_angle))


def _closed(bearing: RollerBearing, profile: _Profile, sine: Numbers) -> Numbers:
    """Return the sum of both contact depths of an unloaded roller [m]: due to a pair's preload, or negative
    due to its play.
    """
    rows = bearing.rows
    if rows.number == 1:
        return 0.0
    force = np.atleast_1d(np.asarray(rows.preload, dtype=float) / bearing.elements / sine)
    # An axial play is the play of both rows together.
    return 2.0 * profile.bottom(force) - 0.5 * rows.endplay * sine


def check_roller_loads(bearing: RollerBearing, operation: Operation) -> None:
    """Refuse single loads that the raceways do not carry. Raises InputError for an axial load on cylindrical
    rollers, for a radial one on a thrust bearing, and where the axial load on one row of tapered rollers is
    too small to hold it together; arrays are not refused.
    """
    axial, radial = operation.axial_load, operation.radial_load
    if np.ndim(axial) == 0 and axial != 0.0 and not bearing.carries_axial:
        raise InputError(
            "axial_load",
            got=f"{axial:g} N",
            takes="0: cylindrical raceways carry none",
        )
    if np.ndim(radial) == 0 and radial != 0.0 and bearing.thrust:
        raise InputError("radial_load", got=f"{radial:g} N", takes="0: a thrust bearing carries none")
    least = least_axial_load(bearing, radial)
    if np.ndim(least) == np.ndim(axial) == 0 and not axial > least:
        raise InputError(
            "axial_load",
            got=f"{axial:g} N",
            takes=f"one above {readable(float(least), 4)} N: with less, an inclined row is pushed apart by "
            "its radial load",
        )


def least_axial_load(bearing: RollerBearing, radial: Numbers) -> Numbers:
    """Axial load above which one inclined row has an equilibrium at all positions of its cage [N], shape
    (...).

    A radial load F_r on one roller leans on the ring with F_r tan(a) along the axis; on the two rollers
    next to the line of the load it is 1/cos(180 deg/Z) times as much. It is minus infinity for a pair and for
    cylindrical rollers, which need none, and 0 for a thrust bearing.
    """
    if bearing.rows.number > 1 or not bearing.carries_axial:
        return -np.inf
    if bearing.thrust:
        return 0.0
    return as_float(radial * np.tan(bearing.contact_angle) / np.cos(np.pi / bearing.elements))


def _able(bearing: RollerBearing, operation: Operation) -> Mask:
    """Whether the raceways carry the loads, shape (...)."""
    able = np.asarray(np.greater(operation.axial_load, least_axial_load(bearing, operation.radial_load)))
    if not bearing.carries_axial:
        able = able & np.equal(operation.axial_load, 0.0)
    return able & np.equal(operation.radial_load, 0.0) if bearing.thrust else able


def _check_slices(slices: int) -> None:
    """Raise InputError for a wrong number of slices."""
    if slices < _LEAST_SLICES or slices % 2 == 0:
        raise InputError("slices", got=slices, takes=f"an odd number from {_LEAST_SLICES}")


def _solved(points: _Points) -> tuple[Array, Array, Array, IntArray]:
    """Displacements of rings, shape (k, n) [m], depths of outer contacts, shape (elements, n) [m], residuals
    of the rings and numbers of Newton steps, shape (n,).
    """
    reaction, size = _Reaction(points), points.size
    # A guess that is rather too large: five times the mean load on one roller, and its approach, beyond the
    # clearance and the depth under the centrifugal force.
    whole = points.profile.stiffness * np.add.reduce(points.profile.weights)
    slope = np.max(np.abs(points.lever), axis=0)
    load, most = points.load[: len(points.ways)], np.maximum(points.cosine[0], slope)
    # Inclined rollers lean on the axial load.
    mean = (5.0 * points.load[0] + np.abs(points.load[2]) / np.where(slope > 0.0, slope, 1.0)) / most
    depth = 2.0 * (mean / len(points.cosine) / whole) ** (1.0 / _POWER)
    start = np.zeros_like(load)
    beyond = np.maximum(0.0, points.play + points.bottom + depth)
    if len(load) == 2:
        start[0] = beyond
    else:
        start[2] = np.sign(points.load[2]) * beyond / slope
    reach = 2.0 * (size / whole) ** (1.0 / _POWER) + 2.0 * np.abs(points.play)
    ring, residual, steps = balance(reaction, load.T, start.T, reach, points.scale)
    return ring.T, reaction.seats(ring.T, np.arange(size.size))[0], residual, steps


def roller_equilibrium(
    bearing: RollerBearing,
    operation: Operation,
    modulus: Numbers,
    density: Numbers,
    *,
    slices: int = SLICES,
) -> RollerEquilibrium:
    """Equilibrium of the inner ring and of all rollers.

    At a displacement (x, y, z) of the ring, a roller at the angle psi is compressed by
    (x cos psi + y sin psi - P_d/2) cos a + z sin a with the contact angle a, the sum over both contacts; with
    -z in a second row, and there with the depth of the preload in both rows. Slice k of a contact with the
    depth d carries q_k = c (d - P_k)^(10/9), with the relief P_k. The stiffness of the standard holds for
    two equal contacts in series, so c is 2^(10/9) c_L over the number of slices. The outer contact also
    carries the part F_c cos a of the centrifugal force.

    ``modulus``, reduced modulus E' of roller and ring [Pa], with 2/E' = (1 - nu1^2)/E1 + (1 - nu2^2)/E2;
    ``density`` [kg/m^3]; both, the operation and the dimensions of the bearing are floats, or arrays of shape
    (...) that broadcast; ``slices``, number of slices of a roller, odd and at least 31. Returns forces that
    balance to 1e-9 of the load plus the centrifugal force. Raises InputError where the number of slices is
    out of range. Of a single bearing, raises InputError where it cannot carry the load, and ConvergenceError
    where the iteration does not converge; such points of many are not ``balanced``, and points without
    equilibrium are NaN.

    Examples
    --------
    Load of the most loaded of 14 straight rollers, over their mean load:

    >>> bearing = RollerBearing(14, 11e-3, 60e-3, 11e-3, 0.0, "none")
    >>> state = roller_equilibrium(bearing, Operation(radial_load=5000.0), 226e9, 7800.0)
    >>> round(float(state.inner_load[0]) * 14 / 5000.0, 2)
    4.09

    At two loads:

    >>> both = roller_equilibrium(bearing, Operation(radial_load=np.array([5000.0, 8000.0])), 226e9, 7800.0)
    >>> both.inner_load.shape, both.inner_line_load.shape
    ((2, 14), (2, 14, 41))
    """
    _check_slices(slices)
    batch = Batch.of(bearing, operation, modulus, density, _able(bearing, operation))
    if not batch.shape:
        check_roller_loads(bearing, operation)
    length = np.asarray(batch.bearing.roller_length)[..., np.newaxis]
    x = ((np.arange(slices) + 0.5) / slices - 0.5) * length
    relief = batch.bearing.relief(x)
    points, number = _Points.of(batch, relief), batch.number
    ring, bodies = np.zeros((3, number)), len(batch.signs)
    residual, steps = np.empty(number), np.empty(number, dtype=np.intp)
    depths, lines = np.empty((2, bodies, number)), np.empty((2, number, bodies, slices))
    for first in range(0, number, _BLOCK):
        part = slice(first, first + _BLOCK)
        of_part = points.chosen(part)
        moved, outer, residual[part], steps[part] = _solved(of_part)
        ring[: len(moved), part] = moved
        depths[:, :, part] = inner, outer = of_part.interference(moved) - outer, outer
        lines[0, part], lines[1, part] = (
            of_part.profile.slices(inner.T, slices),
            of_part.profile.slices(outer.T, slices),
        )
    loads = np.add.reduce(lines, axis=-1)
    missing = np.max(np.abs(loads[1] - loads[0] - points.outward[:, np.newaxis]), axis=1)
    residual = batch.spread(np.maximum(residual, missing / points.scale))
    refuse_unbalanced(residual, "rollers")
    lines *= slices / length[..., np.newaxis]
    spread, touching, gaps = batch.spread, np.maximum(0.0, depths), np.maximum(0.0, -depths)
    speeds = [np.broadcast_to(speed, (number,)) for speed in vars(_rolling(batch)).values()]
    angle = spread(np.broadcast_to(batch.bearing.contact_angle * batch.signs, (bodies, number)))
    return RollerEquilibrium(
        position=batch.position,
        inner_load=batch.spread_rows(loads[0]),
        outer_load=batch.spread_rows(loads[1]),
        slice_position=batch.spread_rows(np.broadcast_to(x, (number, slices))),
        inner_line_load=batch.spread_rows(lines[0]),
        outer_line_load=batch.spread_rows(lines[1]),
        inner_angle=angle,
        outer_angle=angle,
        axial_displacement=spread(ring[2]),
        inner_approach=spread(touching[0]),
        outer_approach=spread(touching[1]),
        inner_gap=spread(gaps[0]),
        outer_gap=spread(gaps[1]),
        speeds=Speeds(*map(spread, speeds)),
        centrifugal_force=spread(_centrifugal_force(batch)),
        radial_displacement=spread(ring[0]),
        lateral_displacement=spread(ring[1]),
        residual=residual,
        iterations=spread(steps),
    )
