"""Equilibrium of a thrust ball bearing: all balls carry the same load; SI units.

An axial load F_a and the centrifugal force F_c act on each of Z balls, which move outwards in both grooves,
by the angles b_i and b_o from their bottoms. The grooves of the centred washers face each other, so that a
ball is as far from the middle of both. With the offsets e = (f - 1/2) D and the approaches d of its contacts

    tan(b_i) + tan(b_o) = Z F_c/F_a,    (e_i + d_i) sin(b_i) = (e_o + d_o) sin(b_o),    Q = F_a/(Z cos(b)).

Each washer carries half of the centrifugal force where both grooves are alike. The washers stay parallel, and
the gyroscopic moment, which friction holds, is neglected. The spin of the balls on the washers is also
neglected; it raises the losses but does not change the film of pure rolling.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ehlectric.arrays import Array, Numbers
from ehlectric.bearing.loads.ball_contacts import contact_stiffness
from ehlectric.bearing.loads.ball_loads import BallEquilibrium
from ehlectric.bearing.loads.geometry import (
    BallBearing,
    ThrustBallBearing,
    centrifugal_force,
    rolling_speeds,
)
from ehlectric.bearing.loads.ring import Batch, Operation
from ehlectric.errors import InputError


def check_thrust_loads(_bearing: ThrustBallBearing, operation: Operation) -> None:
    """Refuse single loads that a thrust bearing cannot carry. Raises InputError for a radial load, and for an
    axial one that does not press the washers together; arrays are not refused.
    """
    if np.ndim(operation.radial_load) == 0 and operation.radial_load != 0.0:
        got = f"{operation.radial_load:g} N"
        raise InputError("radial_load", got=got, takes="0: a thrust bearing carries none")
    if np.ndim(operation.axial_load) == 0 and operation.axial_load <= 0.0:
        got = f"{operation.axial_load:g} N"
        raise InputError("axial_load", got=got, takes="one above 0, which presses the washers together")


# Halvings of the interval of a slope, and rounds in which the stiffnesses follow the angles.
_HALVINGS, _ROUNDS = 52, 3


def _depths(
    bearing: BallBearing, modulus: Numbers, along: Numbers, slopes: Sequence[Numbers]
) -> list[Numbers]:
    """Approaches of both contacts [m] at the slopes tan(b) of their angles from the bottoms."""
    if not np.size(along):
        # No point can be solved.
        return [along, along]
    square = bearing.bottom_angle
    return [
        (
            along
            * np.hypot(1.0, slope)
            / contact_stiffness(bearing, modulus, square + sign * np.arctan(slope), inner=inner)
        )
        ** (2.0 / 3.0)
        for slope, sign, inner in zip(slopes, (1.0, -1.0), (True, False), strict=True)
    ]


def _slopes(
    bearing: BallBearing, modulus: Numbers, along: Numbers, outward: Numbers
) -> tuple[Numbers, Numbers]:
    """Slopes tan(b) of the angles of both contacts from the bottoms of their grooves.

    ``along`` and ``outward``, axial and centrifugal force on a ball [N].
    """
    total = outward / along
    inner = 0.5 * total
    for _ in range(_ROUNDS):
        depths = _depths(bearing, modulus, along, (inner, total - inner))
        spans = [offset + depth for offset, depth in zip(bearing.offsets, depths, strict=True)]
        low, high = np.zeros_like(total), np.array(total, dtype=float)
        for _ in range(_HALVINGS):
            middle = 0.5 * (low + high)
            further = spans[0] * middle / np.hypot(1.0, middle)
            rest = total - middle
            less = further < spans[1] * rest / np.hypot(1.0, rest)
            low, high = np.where(less, middle, low), np.where(less, high, middle)
        inner = 0.5 * (low + high)
    return inner, total - inner


def thrust_ball_equilibrium(
    bearing: ThrustBallBearing, operation: Operation, modulus: Numbers, density: Numbers
) -> BallEquilibrium:
    """Return the equilibrium of the shaft washer and all balls, of shape (..., elements).

    ``modulus``, reduced modulus E' of ball and washer [Pa]; ``density`` [kg/m^3]; both, the operation and the
    dimensions of the bearing are floats, or arrays of shape (...) that broadcast. The contact angle of the
    washer of the shaft is above 90 degrees, and the angle of the other washer is below by as much. Raises
    InputError where a single bearing cannot carry its load; such points of many are NaN.

    Examples
    --------
    16 balls that carry 1600 N at rest have 100 N each, at an angle of 90 degrees:

    >>> bearing = ThrustBallBearing(16, 9.525e-3, 54e-3, 0.54, 0.54)
    >>> state = thrust_ball_equilibrium(bearing, Operation(radial_load=0.0, axial_load=1600.0), 226e9, 7800.0)
    >>> float(state.inner_load[0]), round(float(np.degrees(state.inner_angle[0])), 9)
    (100.0, 90.0)
    """
    able = np.greater(operation.axial_load, 0.0) & np.equal(operation.radial_load, 0.0)
    batch = Batch.of(bearing, operation, modulus, density, able)
    if not batch.shape:
        check_thrust_loads(bearing, operation)
    of_batch, duty, rows = batch.bearing, batch.operation, (bearing.elements, batch.number)
    square = bearing.bottom_angle
    speeds = rolling_speeds(
        element_diameter=of_batch.ball_diameter,
        pitch_diameter=of_batch.pitch_diameter,
        inner_speed=duty.inner_speed,
        outer_speed=duty.outer_speed,
        contact_angle=square,
    )
    outward = centrifugal_force(
        mass=of_batch.element_mass(batch.density),
        pitch_diameter=of_batch.pitch_diameter,
        cage_speed=speeds.cage,
    )
    along = duty.axial_load / bearing.elements
    slopes = _slopes(of_batch, batch.modulus, along, outward)
    loads = [along * np.hypot(1.0, slope) for slope in slopes]
    asides = [np.arctan(slope) for slope in slopes]
    angles = square + asides[0], square - asides[1]
    depths = _depths(of_batch, batch.modulus, along, slopes)
    moved = [
        (offset + depth) * np.cos(aside)
        for offset, depth, aside in zip(of_batch.offsets, depths, asides, strict=True)
    ]
    # The distance of both grooves equals the distance of the ball from each of them up to rounding.
    residual = np.abs(loads[0] * np.sin(asides[0]) + loads[1] * np.sin(asides[1]) - outward)

    def both(values: Sequence[Numbers]) -> Array:
        return np.array([np.broadcast_to(value, rows) for value in values])

    nothing = np.zeros(batch.number)
    return BallEquilibrium.of(
        batch,
        loads=both(loads),
        angles=both(angles),
        depths=both(depths),
        rolling_angle=square,
        cage_speed=speeds.cage,
        outward=outward,
        ring=np.array([np.broadcast_to(sum(moved), rows[1:]), nothing, nothing]),
        moments=(nothing, nothing),
        residual=np.array(np.broadcast_to(residual / (duty.axial_load + outward), rows[1:])),
        steps=np.zeros(batch.number, dtype=np.intp),
    )
