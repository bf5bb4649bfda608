"""Equilibrium of a cylindrical roller bearing, its rollers divided into slices as in ISO 16281. SI units.

The inner ring is displaced along and across the radial load, but not tilted, and the rollers stay parallel to
it. Each slice of a roller is compressed between both raceways and carries a load of its own. The profile of
the roller thus determines the distribution of the load along it. Axial loads, which the ribs would carry,
friction and the bending of the rings are neglected.

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

    # Cylindrical rollers carry no axial load, do not tilt the ring, and have no gyroscopic moment.
    axial_displacement: ClassVar[None] = None
    moment: ClassVar[None] = None
    gyroscopic_moment: ClassVar[None] = None

    @property
    def cage_speed(self) -> Numbers:
        """Angular speed of the cage about the axis of the bearing [rad/s]."""
        return as_float(self.speeds.cage)


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
        """Depth at which an outer contact carries the centrifugal force alone [m], shape (n,)."""
        # Upper bound: at this depth the slice that touches first carries the force alone. From there
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
    bottom: Array  # depth of outer contacts that carry the centrifugal force alone [m], shape (n,)
    # cosine and sine of the position of each roller, shape (elements, n).
    cosine: Array
    sine: Array
    play: Array  # half of the radial clearance [m], shape (n,)
    load: Array  # radial load [N], shape (n,)

    @classmethod
    def of(cls, batch: Batch[RollerBearing], relief: Array) -> _Points:
        """Points of a batch; relief of all slices, shape (slices,) or (n, slices)."""
        bearing, operation = batch.bearing, batch.operation
        shape = (bearing.elements, batch.number)
        # The stiffness of the standard is that of two equal contacts in series.
        stiffness = 2.0**_POWER * line_stiffness(bearing.roller_length, batch.modulus) / relief.shape[-1]
        profile = _Profile.of(stiffness, relief)
        mass, cage = bearing.element_mass(batch.density), _rolling(batch).cage
        outward = np.atleast_1d(centrifugal_force(mass, bearing.pitch_diameter, cage))
        values = outward, profile.bottom(outward), 0.5 * bearing.radial_clearance, operation.radial_load
        rows = [np.array(np.broadcast_to(value, shape[1:])) for value in values]
        turned = [np.array(np.broadcast_to(turn(batch.rows), shape)) for turn in (np.cos, np.sin)]
        return cls(profile, rows[0], rows[1], *turned, *rows[2:])

    def chosen(self, points: slice | IntArray) -> _Points:
        """Some of the points."""
        profile, *values = vars(self).values()
        return _Points(profile.chosen(points), *(value[..., points] for value in values))

    @property
    def scale(self) -> Array:
        """Force that unbalanced forces are relative to [N]."""
        return self.load + self.outward

    def interference(self, ring: Array) -> Array:
        """Sum of the depths of both contacts [m], negative for a gap, at displacements of shape (2, n)."""
        return np.asarray(ring[0] * self.cosine + ring[1] * self.sine - self.play)


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

        ``ring``, displacements of the points ``chosen``, shape (2, m). Returns values of shape (elements, m).
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
        cosine, sine = self._points.cosine[:, chosen], self._points.sine[:, chosen]
        along, across = series * cosine, series * sine
        force = [np.add.reduce(load * cosine, axis=0), np.add.reduce(load * sine, axis=0)]
        a, b, c = (np.add.reduce(part, axis=0) for part in (along * cosine, along * sine, across * sine))
        return np.stack(force, axis=-1), np.stack([a, b, b, c], axis=-1).reshape(-1, 2, 2)


@dataclass(frozen=True)
class _Rollers:
    """Rollers that both rings load, shape (n,)."""

    profile: _Profile
    outward: Array  # centrifugal force [N]
    bottom: Array  # depth of an outer contact under the centrifugal force alone [m]
    interference: Array  # sum of the depths of both contacts [m]

    def shared(self, guess: Array) -> list[Array]:
        """Depth of the outer contacts [m], load of the inner ones [N], stiffness in series [N/m], and change
        of the depth with the interference.

        Newton's method between bounds, from a guess of the depths [m]. An outer contact carries at least
        the centrifugal force, and at least the load of the inner contact. Its depth is at most the sum of
        half the interference and the depth under the centrifugal force alone, because loads grow faster than
        depths.
        """
        half = 0.5 * self.interference
        low, high = np.maximum(half, self.bottom), np.minimum(half + self.bottom, self.interference)
        outer = np.clip(guess, low, high)
        found, going, own = [np.empty_like(half) for _ in range(4)], np.arange(half.size), self
        for _ in range(_MOST_STEPS):
            (load, stiff), (inner, soft) = own.profile.load(outer), own.profile.load(own.interference - outer)
            excess, both = load - inner - own.outward, stiff + soft
            noise = _ROUNDING * (load + own.outward) + _NUDGE * own.interference * both
            done = (np.abs(excess) <= noise) | (high - low <= 1e-16 * own.interference)
            share = soft / both
            for values, new in zip(found, (outer, inner, stiff * share, share), strict=True):
                values[going] = new
            if done.all():
                break
            on = ~done
            low, high = np.where(excess < 0.0, outer, low)[on], np.where(excess < 0.0, high, outer)[on]
            newton = (outer - excess / both)[on]
            outer = np.where((newton >= low) & (newton <= high), newton, 0.5 * (low + high))
            going, own = going[on], own.chosen(on)
        return found

    def chosen(self, rollers: Mask) -> _Rollers:
        """Some of the rollers."""
        others = (value[rollers] for value in (self.outward, self.bottom, self.interference))
        return _Rollers(self.profile.chosen(rollers), *others)


def _rolling(batch: Batch[RollerBearing]) -> Speeds:
    """Speeds of cage, rollers and contacts; floats, or arrays of shape (n,)."""
    bearing, operation = batch.bearing, batch.operation
    return rolling_speeds(
        bearing.roller_diameter, bearing.pitch_diameter, operation.inner_speed, operation.outer_speed
    )


def check_roller_loads(operation: Operation) -> None:
    """Refuse a single axial load. Raises InputError where there is one; arrays are not refused."""
    load = operation.axial_load
    if np.ndim(load) == 0 and load != 0.0:
        raise InputError(
            "axial_load",
            got=f"{load:g} N",
            takes="0: the raceways of a cylindrical roller bearing carry none",
        )


def _check_slices(slices: int) -> None:
    """Raise InputError for a wrong number of slices."""
    if slices < _LEAST_SLICES or slices % 2 == 0:
        raise InputError("slices", got=slices, takes=f"an odd number from {_LEAST_SLICES}")


def _solved(points: _Points) -> tuple[Array, Array, Array, IntArray]:
    """Displacements of rings, shape (2, n) [m], depths of outer contacts, shape (elements, n) [m], residuals
    of the rings and numbers of Newton steps, shape (n,).
    """
    reaction, number = _Reaction(points), len(points.load)
    # A guess that is rather too large: five times the mean load on one roller, and its approach, beyond the
    # clearance and the depth under the centrifugal force.
    whole = points.profile.stiffness * np.add.reduce(points.profile.weights)
    depth = 2.0 * (5.0 * points.load / len(points.cosine) / whole) ** (1.0 / _POWER)
    start = np.stack([np.maximum(0.0, points.play + points.bottom + depth), np.zeros(number)], axis=-1)
    reach = 2.0 * (points.load / whole) ** (1.0 / _POWER) + 2.0 * np.abs(points.play)
    load = np.stack([points.load, np.zeros(number)], axis=-1)
    ring, residual, steps = balance(reaction, load, start, reach, points.scale)
    return ring.T, reaction.seats(ring.T, np.arange(number))[0], residual, steps


def roller_equilibrium(
    bearing: RollerBearing,
    operation: Operation,
    modulus: Numbers,
    density: Numbers,
    *,
    slices: int = SLICES,
) -> RollerEquilibrium:
    """Equilibrium of the inner ring and of all rollers.

    At a displacement (x, y) of the ring, a roller at the angle psi is compressed by
    x cos psi + y sin psi - P_d/2, the sum over both contacts. Slice k of a contact with the depth d carries
    q_k = c (d - P_k)^(10/9), with the relief P_k. The stiffness of the standard is that of two equal contacts
    in series, so c is 2^(10/9) c_L over the number of slices. The outer contact also carries the centrifugal
    force.

    ``modulus``, reduced modulus E' of roller and ring [Pa], with 2/E' = (1 - nu1^2)/E1 + (1 - nu2^2)/E2;
    ``density`` [kg/m^3]; both, the operation and the dimensions of the bearing are floats, or arrays of shape
    (...) that broadcast; ``slices``, number of slices of a roller, odd and at least 31. Returns forces that
    balance to 1e-9 of the load plus the centrifugal force. Raises InputError where the number of slices is
    out of range. Of a single bearing, raises InputError where it cannot carry the load, and ConvergenceError
    where the iteration does not converge; such points of many are not ``balanced``, and those without
    equilibrium are NaN.

    Examples
    --------
    Load of the most loaded of 14 straight rollers, over their mean load:

    >>> bearing = RollerBearing(14, 11e-3, 60e-3, 11e-3, 0.0, "none")
    >>> state = roller_equilibrium(bearing, Operation(5000.0), 226e9, 7800.0)
    >>> round(float(state.inner_load[0]) * 14 / 5000.0, 2)
    4.09

    At two loads:

    >>> both = roller_equilibrium(bearing, Operation(np.array([5000.0, 8000.0])), 226e9, 7800.0)
    >>> both.inner_load.shape, both.inner_line_load.shape
    ((2, 14), (2, 14, 41))
    """
    _check_slices(slices)
    batch = Batch.of(bearing, operation, modulus, density, np.equal(operation.axial_load, 0.0))
    if not batch.shape:
        check_roller_loads(operation)
    length = np.asarray(batch.bearing.roller_length)[..., np.newaxis]
    x = ((np.arange(slices) + 0.5) / slices - 0.5) * length
    relief = batch.bearing.relief(x)
    points, number = _Points.of(batch, relief), batch.number
    ring, residual, steps = np.empty((2, number)), np.empty(number), np.empty(number, dtype=np.intp)
    depths = np.empty((2, bearing.elements, number))
    lines = np.empty((2, number, bearing.elements, slices))
    for first in range(0, number, _BLOCK):
        part = slice(first, first + _BLOCK)
        own = points.chosen(part)
        ring[:, part], outer, residual[part], steps[part] = _solved(own)
        depths[:, :, part] = inner, outer = own.interference(ring[:, part]) - outer, outer
        lines[0, part], lines[1, part] = (
            own.profile.slices(inner.T, slices),
            own.profile.slices(outer.T, slices),
        )
    loads = np.add.reduce(lines, axis=-1)
    missing = np.max(np.abs(loads[1] - loads[0] - points.outward[:, np.newaxis]), axis=1)
    residual = batch.spread(np.maximum(residual, missing / points.scale))
    refuse_unbalanced(residual, "rollers")
    lines *= slices / length[..., np.newaxis]
    spread, touching, gaps = batch.spread, np.maximum(0.0, depths), np.maximum(0.0, -depths)
    speeds = [np.broadcast_to(speed, (number,)) for speed in vars(_rolling(batch)).values()]
    return RollerEquilibrium(
        position=batch.position,
        inner_load=batch.spread_rows(loads[0]),
        outer_load=batch.spread_rows(loads[1]),
        slice_position=batch.spread_rows(np.broadcast_to(x, (number, slices))),
        inner_line_load=batch.spread_rows(lines[0]),
        outer_line_load=batch.spread_rows(lines[1]),
        inner_approach=spread(touching[0]),
        outer_approach=spread(touching[1]),
        inner_gap=spread(gaps[0]),
        outer_gap=spread(gaps[1]),
        speeds=Speeds(*map(spread, speeds)),
        centrifugal_force=spread(points.outward),
        radial_displacement=spread(ring[0]),
        lateral_displacement=spread(ring[1]),
        residual=residual,
        iterations=spread(steps),
    )
