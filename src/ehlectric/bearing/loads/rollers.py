"""Equilibrium of a cylindrical roller bearing, its rollers cut into slices as in ISO 16281. SI units.

The inner ring is displaced along and across the radial load, not tilted; rollers stay parallel to it. Each
slice of a roller resists being pressed in between both raceways with a load of its own, so that the profile
of the roller decides how the load spreads along it. Axial loads, which ribs would carry, friction and the
bending of the rings are left out.

ISO/TS 16281:2008, Rolling bearings - Methods for calculating the modified reference rating life for
universally loaded bearings.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar

import numpy as np
from scipy.optimize import brentq

from ehlectric.arrays import Array, Mask
from ehlectric.bearing.loads.geometry import RollerBearing
from ehlectric.bearing.loads.kinematics import Speeds, centrifugal_force, rolling_speeds
from ehlectric.bearing.loads.ring import GOOD, UNLOADED, Operation, Reaction, RingLoads, balance
from ehlectric.errors import ConvergenceError, InputError, shown
from ehlectric.formulas.hertz_line import body_compliance, reduced_modulus

# q = c delta^(10/9); c_L = 35 948 L^(8/9) N/mm^(10/9) with L in mm, both contacts of a steel roller together.
_POWER = 10.0 / 9.0
_STANDARD = 35948.0 * 1e6

# The standard is for steel; its elastic constants are an assumption here.
_STEEL = reduced_modulus(body_compliance(206e9, 0.3), body_compliance(206e9, 0.3))

# The standard asks for 30 at least; an odd number has a slice in the middle.
SLICES = 41
_LEAST_SLICES = 31
_MOST_STEPS = 100


@dataclass(frozen=True)
class RollerEquilibrium:
    """Roller bearing in equilibrium; arrays hold one number a roller.

    Attributes
    ----------
    position : ndarray, shape (n,)
        Angle from the direction of the radial load [rad].
    inner_load, outer_load : ndarray
        Load of both contacts [N].
    slice_position : ndarray, shape (m,)
        Middle of each slice, from the roller's [m].
    inner_line_load, outer_line_load : ndarray, shape (n, m)
        Load per length of each slice [N/m].
    inner_approach, outer_approach : ndarray
        By how much the middle of the roller and the ring come closer in the contact [m].
    inner_gap, outer_gap : ndarray
        Distance of the middle of the roller and the raceway where they do not touch [m], else 0.
    speeds : Speeds
        Of cage, rollers and contacts.
    centrifugal_force : float
        On each roller [N].
    radial_displacement, lateral_displacement : float
        Of the inner ring along the radial load, and at right angles to it, towards the angle of 90 deg [m].
    residual : float
        Largest force that ring or roller miss to balance, over the load and the centrifugal force together.
    iterations : int
        Newton steps of the ring.
    """

    position: Array
    inner_load: Array
    outer_load: Array
    slice_position: Array
    inner_line_load: Array
    outer_line_load: Array
    inner_approach: Array
    outer_approach: Array
    inner_gap: Array
    outer_gap: Array
    speeds: Speeds
    centrifugal_force: float
    radial_displacement: float
    lateral_displacement: float
    residual: float
    iterations: int

    # Cylindrical rollers are not pushed along the axis, nor do they tilt the ring or precess.
    axial_displacement: ClassVar[None] = None
    moment: ClassVar[None] = None
    gyroscopic_moment: ClassVar[None] = None

    @property
    def cage_speed(self) -> float:
        """Angular speed of the cage about the bearing's axis [rad/s]."""
        return float(self.speeds.cage)

    def ring(self, *, inner: bool) -> RingLoads:
        """Contacts of all rollers with the inner or the outer ring, at a contact angle of zero."""
        angle = np.zeros_like(self.inner_load)
        if inner:
            speed = np.broadcast_to(self.speeds.inner_entrainment, angle.shape)
            return RingLoads(self.inner_load, angle, self.inner_approach, self.inner_gap, speed)
        speed = np.broadcast_to(self.speeds.outer_entrainment, angle.shape)
        return RingLoads(self.outer_load, angle, self.outer_approach, self.outer_gap, speed)


def line_stiffness(length: float, modulus: float) -> float:
    """c_L of Q = c_L delta^(10/9) for a straight roller between two raceways, both contacts together.

    c_L = 35 948 L^(8/9) N/mm^(10/9) for steel, L in mm. The approach of Palmgren's formula, from which it is,
    goes with (Q/E')^(9/10), so that c_L is in proportion to E'. The steel of the standard is assumed to have
    206 GPa and 0.3.

    Parameters
    ----------
    length : float
        Effective length L of the roller [m].
    modulus : float
        Reduced modulus E' of roller and ring [Pa], with 2/E' = (1 - nu1^2)/E1 + (1 - nu2^2)/E2.

    Returns
    -------
    float
        [N/m^(10/9)].

    Examples
    --------
    Of a roller 10 mm long, in the standard's units:

    >>> steel = reduced_modulus(body_compliance(206e9, 0.3), body_compliance(206e9, 0.3))
    >>> round(line_stiffness(10e-3, steel) / 1e3 ** (10 / 9))
    278332
    """
    return float(_STANDARD * length ** (8.0 / 9.0) * modulus / _STEEL)


@dataclass(frozen=True)
class _Rollers:
    """Rollers between two raceways.

    Attributes
    ----------
    stiffness : float
        Of one slice of one contact [N/m^(10/9)].
    relief : ndarray, shape (m,)
        Of each slice [m].
    outward : float
        Centrifugal force [N].
    """

    stiffness: float
    relief: Array
    outward: float

    @cached_property
    def least_relief(self) -> float:
        """Of the slice that touches first [m]."""
        return float(np.min(self.relief))

    def slices(self, depth: Array) -> Array:
        """Load of each slice [N] of contacts pressed in by a depth [m], shape (n, m)."""
        pressed = np.maximum(0.0, np.asarray(depth)[..., None] - self.relief)
        return np.asarray(self.stiffness * pressed**_POWER)

    def load(self, depth: Array) -> tuple[Array, Array]:
        """Load of contacts pressed in by a depth, and its derivative."""
        pressed = np.maximum(0.0, np.asarray(depth)[..., None] - self.relief)
        root = self.stiffness * pressed ** (_POWER - 1.0)
        return np.sum(root * pressed, axis=-1), _POWER * np.sum(root, axis=-1)

    @cached_property
    def bottom(self) -> float:
        """Depth at which the outer contact carries the centrifugal force alone [m]."""
        if self.outward == 0.0:
            return 0.0
        # Deep enough even if no more than the middle slice carried it.
        deepest = (self.outward / self.stiffness) ** (1.0 / _POWER) + self.least_relief
        return float(
            brentq(lambda d: float(self.load(np.array(d))[0]) - self.outward, 0.0, deepest, xtol=1e-18)
        )

    def seat(self, play: Array) -> tuple[Array, Mask]:
        """Depth of the outer contacts and which rollers are held, of what presses in both contacts together.

        Without centrifugal force both contacts share ``play`` alike, also where it is a clearance.
        """
        if self.outward == 0.0:
            return 0.5 * play, play > 0.0
        held = play > self.bottom + self.least_relief
        outer = np.full_like(play, self.bottom)
        if held.any():
            outer[held] = self._shared(play[held])
        return outer, held

    def _shared(self, play: Array) -> Array:
        """Depth of the outer contacts of held rollers, where they carry the centrifugal force more.

        Newton's method between bounds: an outer contact carries at least the centrifugal force and at least
        as much as the inner one, and is pressed in less than by each of them apart, since loads grow faster
        than depths.
        """
        low, high = np.maximum(0.5 * play, self.bottom), np.minimum(0.5 * play + self.bottom, play)
        outer = low
        for _ in range(_MOST_STEPS):
            (load, stiff), (inner, soft) = self.load(outer), self.load(play - outer)
            excess = load - inner - self.outward
            if np.all(np.abs(excess) <= 1e-15 * (load + self.outward)):
                break
            low, high = np.where(excess < 0.0, outer, low), np.where(excess < 0.0, high, outer)
            newton = outer - excess / (stiff + soft)
            outer = np.where((newton >= low) & (newton <= high), newton, 0.5 * (low + high))
            if np.all(high - low <= 1e-16 * play):
                break
        return outer

    def reaction(self, basis: Array, clearance: float) -> Reaction:
        """Force of the rollers on the ring over its displacement."""

        def reaction(ring: Array) -> tuple[Array, Array]:
            play = basis @ ring - 0.5 * clearance
            outer, held = self.seat(play)
            (load, inner), (_, stiff) = self.load(play - outer), self.load(outer)
            inner, stiff, load = inner[held], stiff[held], np.where(held, load, 0.0)
            # Two springs in series.
            series = inner * stiff / (inner + stiff)
            return basis.T @ load, (basis[held].T * series) @ basis[held]

        return reaction


def _refuse(operation: Operation, unloaded: str, slices: int) -> None:
    """Raise InputError for what the bearing, or its model, cannot do."""
    if unloaded not in UNLOADED:
        raise InputError("unloaded", got=shown(unloaded), takes=f"one of {', '.join(UNLOADED)}")
    if operation.axial_load != 0.0:
        raise InputError(
            "axial_load",
            got=f"{operation.axial_load:g} N",
            takes="0: the raceways of a cylindrical roller bearing carry none",
        )
    if slices < _LEAST_SLICES or slices % 2 == 0:
        raise InputError("slices", got=slices, takes=f"an odd number from {_LEAST_SLICES}")


def roller_equilibrium(
    bearing: RollerBearing,
    operation: Operation,
    modulus: float,
    density: float,
    *,
    unloaded: str = "centred",
    slices: int = SLICES,
) -> RollerEquilibrium:
    """Equilibrium of the inner ring over all rollers.

    A roller at the angle psi is pressed in by x cos psi + y sin psi - P_d/2 at both contacts together. Each
    slice k of either contact carries q_k = c (d - P_k)^(10/9) of the contact's own share d, with the relief
    P_k; two equal contacts in series make up the stiffness of the standard, so c is 2^(10/9) c_L over the
    number of slices. The outer contact carries the centrifugal force as well.

    Parameters
    ----------
    bearing : RollerBearing
        Its geometry.
    operation : Operation
        Load, speeds and position.
    modulus : float
        Reduced modulus E' of roller and ring [Pa], with 2/E' = (1 - nu1^2)/E1 + (1 - nu2^2)/E2.
    density : float
        Of the rollers [kg/m^3].
    unloaded : str
        Where rollers without load are in a bearing at rest, gravity left out: "centred", between equal gaps,
        or "outer", at the outer ring. At speed they are at the outer ring.
    slices : int
        Of a roller, odd.

    Returns
    -------
    RollerEquilibrium
        Forces in balance to 1e-9 of the load and the centrifugal force.

    Raises
    ------
    InputError
        Where the bearing cannot bear the load.
    ConvergenceError
        Where no balance was found.

    Examples
    --------
    >>> bearing = RollerBearing(14, 11e-3, 60e-3, 11e-3, 0.0, "none")
    >>> state = roller_equilibrium(bearing, Operation(5000.0), 226e9, 7800.0)
    >>> round(float(state.inner_load[0]) * 14 / 5000.0, 2)
    4.09
    """
    _refuse(operation, unloaded, slices)
    length = bearing.roller_length
    x = ((np.arange(slices) + 0.5) / slices - 0.5) * length
    stiffness = line_stiffness(length, modulus)
    speeds = rolling_speeds(
        bearing.roller_diameter, bearing.pitch_diameter, operation.inner_speed, operation.outer_speed
    )
    outward = centrifugal_force(bearing.element_mass(density), bearing.pitch_diameter, float(speeds.cage))
    rollers = _Rollers(2.0**_POWER * stiffness / slices, bearing.relief(x), outward)

    position = operation.positions(bearing.elements)
    basis = np.stack([np.cos(position), np.sin(position)], axis=1)
    reaction = rollers.reaction(basis, bearing.radial_clearance)
    load = np.array([operation.radial_load, 0.0])
    reach = (operation.radial_load / stiffness) ** (1.0 / _POWER) + abs(bearing.radial_clearance)
    scale = operation.radial_load + outward
    ring, residual, iterations = balance(reaction, load, np.zeros(2), reach, scale)

    play = basis @ ring - 0.5 * bearing.radial_clearance
    outer, held = rollers.seat(play)
    if unloaded == "outer" and outward == 0.0:
        outer = np.where(held, outer, 0.0)
    inner = play - outer
    inner_slices, outer_slices = rollers.slices(inner), rollers.slices(outer)
    inner_load, outer_load = inner_slices.sum(axis=1), outer_slices.sum(axis=1)
    missing = outer_load - inner_load - outward
    residual = max(residual, float(np.max(np.abs(missing))) / scale)
    if residual > GOOD:
        raise ConvergenceError(f"forces on ring and rollers balance to {residual:.1e} of the load only")
    return RollerEquilibrium(
        position=position,
        inner_load=inner_load,
        outer_load=outer_load,
        slice_position=x,
        inner_line_load=inner_slices * slices / length,
        outer_line_load=outer_slices * slices / length,
        inner_approach=np.maximum(0.0, inner),
        outer_approach=np.maximum(0.0, outer),
        inner_gap=np.maximum(0.0, -inner),
        outer_gap=np.maximum(0.0, -outer),
        speeds=speeds,
        centrifugal_force=outward,
        radial_displacement=float(ring[0]),
        lateral_displacement=float(ring[1]),
        residual=residual,
        iterations=iterations,
    )
