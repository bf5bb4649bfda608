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
from functools import cached_property
from typing import ClassVar

import numpy as np
from scipy.optimize import brentq

from ehlectric.arrays import Array, Mask
from ehlectric.bearing.loads.geometry import RollerBearing, centrifugal_force, rolling_speeds
from ehlectric.bearing.loads.ring import GOOD, BearingEquilibrium, Operation, Reaction, balance
from ehlectric.errors import ConvergenceError, InputError
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


@dataclass(frozen=True)
class RollerEquilibrium(BearingEquilibrium):
    """Roller bearing in equilibrium. Arrays have one value per roller, shape (n,), unless stated."""

    # Position of the middle of each slice, from the middle of the roller [m], shape (m,).
    slice_position: Array
    # inner_line_load and outer_line_load: load of each slice per length [N/m], shape (n, m).
    inner_line_load: Array
    outer_line_load: Array

    # Cylindrical rollers carry no axial load, do not tilt the ring, and have no gyroscopic moment.
    axial_displacement: ClassVar[None] = None
    moment: ClassVar[None] = None
    gyroscopic_moment: ClassVar[None] = None

    @property
    def cage_speed(self) -> float:
        """Angular speed of the cage about the axis of the bearing [rad/s]."""
        return float(self.speeds.cage)


def line_stiffness(length: float, modulus: float) -> float:
    """Stiffness c_L of Q = c_L delta^(10/9) for a straight roller and both its contacts together.

    For steel c_L = 35 948 L^(8/9) N/mm^(10/9), with L in mm. This value comes from Palmgren's formula, in
    which the approach is proportional to (Q/E')^(9/10); c_L is therefore proportional to E'. The steel of the
    standard is assumed to have an elastic modulus of 206 GPa and Poisson's ratio 0.3.

    ``length``, effective length L of the roller [m]; ``modulus``, reduced modulus E' of roller and ring [Pa],
    with 2/E' = (1 - nu1^2)/E1 + (1 - nu2^2)/E2. Returns stiffness c_L [N/m^(10/9)].

    Examples
    --------
    Steel roller 10 mm long, in N/mm^(10/9):

    >>> steel = reduced_modulus(body_compliance(206e9, 0.3), body_compliance(206e9, 0.3))
    >>> round(line_stiffness(10e-3, steel) / 1e3 ** (10 / 9))
    278332
    """
    return float(_STANDARD * length ** (8.0 / 9.0) * modulus / _STEEL)


@dataclass(frozen=True)
class _Rollers:
    """Rollers between two raceways."""

    stiffness: float  # stiffness of one slice in one contact [N/m^(10/9)]
    relief: Array  # relief of each slice [m], shape (m,)
    outward: float  # centrifugal force on each roller [N]

    @cached_property
    def least_relief(self) -> float:
        """Relief of the slice that touches first [m]."""
        return float(np.min(self.relief))

    def slices(self, depth: Array) -> Array:
        """Load of each slice of contacts with a depth [m], shape (n, m) [N]."""
        pressed = np.maximum(0.0, np.asarray(depth)[..., None] - self.relief)
        return np.asarray(self.stiffness * pressed**_POWER)

    def load(self, depth: Array) -> tuple[Array, Array]:
        """Load of contacts with a depth [m], shape (n,) [N], and its derivative [N/m]."""
        pressed = np.maximum(0.0, np.asarray(depth)[..., None] - self.relief)
        root = self.stiffness * pressed ** (_POWER - 1.0)
        return np.sum(root * pressed, axis=-1), _POWER * np.sum(root, axis=-1)

    @cached_property
    def bottom(self) -> float:
        """Depth at which the outer contact carries the centrifugal force alone [m]."""
        if self.outward == 0.0:
            return 0.0
        # Upper bound: at this depth the slice that touches first carries the force alone.
        deepest = (self.outward / self.stiffness) ** (1.0 / _POWER) + self.least_relief
        return float(
            brentq(lambda d: float(self.load(np.array(d))[0]) - self.outward, 0.0, deepest, xtol=1e-18)
        )

    def seat(self, interference: Array) -> tuple[Array, Mask]:
        """Depth of the outer contacts [m], and which rollers are loaded by both rings, shape (n,).

        ``interference`` is the sum of the depths of both contacts [m]; it is negative for a clearance.
        Without centrifugal force each contact has half of it.
        """
        if self.outward == 0.0:
            return 0.5 * interference, interference > 0.0
        loaded = interference > self.bottom + self.least_relief
        outer = np.full_like(interference, self.bottom)
        if loaded.any():
            outer[loaded] = self._shared(interference[loaded])
        return outer, loaded

    def _shared(self, interference: Array) -> Array:
        """Depth of the outer contacts of loaded rollers, which also carry the centrifugal force [m].

        Newton's method between bounds. An outer contact carries at least the centrifugal force, and at least
        the load of the inner contact. Its depth is at most the sum of half the interference and the depth
        under the centrifugal force alone, because loads grow faster than depths.
        """
        half = 0.5 * interference
        low, high = np.maximum(half, self.bottom), np.minimum(half + self.bottom, interference)
        outer = low
        for _ in range(_MOST_STEPS):
            (load, stiff), (inner, soft) = self.load(outer), self.load(interference - outer)
            excess = load - inner - self.outward
            if np.all(np.abs(excess) <= 1e-15 * (load + self.outward)):
                break
            low, high = np.where(excess < 0.0, outer, low), np.where(excess < 0.0, high, outer)
            newton = outer - excess / (stiff + soft)
            outer = np.where((newton >= low) & (newton <= high), newton, 0.5 * (low + high))
            if np.all(high - low <= 1e-16 * interference):
                break
        return outer

    def reaction(self, basis: Array, clearance: float) -> Reaction:
        """Force of the rollers as a function of the ring's displacement."""

        def reaction(ring: Array) -> tuple[Array, Array]:
            interference = basis @ ring - 0.5 * clearance
            outer, loaded = self.seat(interference)
            (load, inner), (_, stiff) = self.load(interference - outer), self.load(outer)
            inner, stiff, load = inner[loaded], stiff[loaded], np.where(loaded, load, 0.0)
            # Both contacts of a roller are springs in series.
            series = inner * stiff / (inner + stiff)
            return basis.T @ load, (basis[loaded].T * series) @ basis[loaded]

        return reaction


def _refuse(operation: Operation, slices: int) -> None:
    """Raise InputError for loads that the bearing cannot carry, and for a wrong number of slices."""
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
    slices: int = SLICES,
) -> RollerEquilibrium:
    """Equilibrium of the inner ring and of all rollers.

    At a displacement (x, y) of the ring, a roller at the angle psi is compressed by
    x cos psi + y sin psi - P_d/2, the sum over both contacts. Slice k of a contact with the depth d carries
    q_k = c (d - P_k)^(10/9), with the relief P_k. The stiffness of the standard is that of two equal contacts
    in series, so c is 2^(10/9) c_L over the number of slices. The outer contact also carries the centrifugal
    force.

    ``modulus``, reduced modulus E' of roller and ring [Pa], with 2/E' = (1 - nu1^2)/E1 + (1 - nu2^2)/E2;
    ``density`` [kg/m^3]; ``slices``, number of slices of a roller, odd and at least 31. Returns forces that
    balance to 1e-9 of the load plus the centrifugal force. Raises InputError where the bearing cannot carry
    the load, or the number of slices is out of range; ConvergenceError where the iteration does not converge.

    Examples
    --------
    Load of the most loaded of 14 straight rollers, over their mean load:

    >>> bearing = RollerBearing(14, 11e-3, 60e-3, 11e-3, 0.0, "none")
    >>> state = roller_equilibrium(bearing, Operation(5000.0), 226e9, 7800.0)
    >>> round(float(state.inner_load[0]) * 14 / 5000.0, 2)
    4.09
    """
    _refuse(operation, slices)
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

    interference = basis @ ring - 0.5 * bearing.radial_clearance
    outer, _ = rollers.seat(interference)
    inner = interference - outer
    inner_slices, outer_slices = rollers.slices(inner), rollers.slices(outer)
    inner_load, outer_load = inner_slices.sum(axis=1), outer_slices.sum(axis=1)
    imbalance = outer_load - inner_load - outward
    residual = max(residual, float(np.max(np.abs(imbalance))) / scale)
    if residual > GOOD:
        raise ConvergenceError(f"forces on ring and rollers, balanced only to {residual:.1e} of the load")
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
