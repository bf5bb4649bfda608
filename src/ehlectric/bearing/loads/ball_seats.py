"""Position of each ball between its two grooves, for contact stiffnesses that are given; SI units.

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
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ehlectric.arrays import Array, Mask, Numbers
from ehlectric.bearing.loads.ball_contacts import Contacts, Spans

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
class Grooves:
    """Grooves of both rings, and contact stiffnesses of n balls."""

    # inner_offset and outer_offset: distance (f - 1/2) D between the centres of ball and groove at first
    # touch [m], float or shape (n,).
    inner_offset: Numbers
    outer_offset: Numbers
    # inner_stiffness and outer_stiffness: stiffness K of the contacts of each ball [N/m^(3/2)], shape (n,).
    inner_stiffness: Array
    outer_stiffness: Array
    outward: Numbers  # centrifugal force on each ball [N]; zero at rest; float or shape (n,)

    def chosen(self, chosen: Mask) -> Grooves:
        """Grooves of some of the balls."""
        shape = np.shape(chosen)
        return Grooves(*(np.broadcast_to(value, shape)[chosen] for value in vars(self).values()))

    @property
    def inner_share(self) -> Array:
        """Share of the inner contact in the approach of a ball under the same load on both contacts."""
        softness = self.inner_stiffness ** (-2.0 / 3.0)
        return np.asarray(softness / (softness + self.outer_stiffness ** (-2.0 / 3.0)))

    @property
    def bottom(self) -> Array:
        """Radial position of a ball that only the centrifugal force presses into the outer groove [m]."""
        return np.asarray(self.outer_offset + self.sunk)

    @property
    def sunk(self) -> Array:
        """Approach of the outer contact under only the centrifugal force [m]."""
        return np.asarray((self.outward / self.outer_stiffness) ** (2.0 / 3.0))

    def contacts(self, p: Array, g: Array) -> tuple[Contacts, Contacts]:
        """Inner and outer contacts of balls at p, with the groove centres at 0 and g, shape (2, n)."""
        inner = Spans.of(g[0] - p[0], g[1] - p[1]).stiff_contacts(self.inner_offset, self.inner_stiffness)
        return inner, Spans.of(p[0], p[1]).stiff_contacts(self.outer_offset, self.outer_stiffness)


@dataclass(frozen=True)
class Seats:
    """Positions and contacts of n balls between two grooves."""

    place: Array  # position p of the ball's centre, axial and radial [m], shape (2, n)
    held: Mask  # whether the ball is loaded by both grooves, shape (n,)
    inner: Contacts
    outer: Contacts

    @property
    def tangent(self) -> tuple[Array, Array, Array]:
        """Derivative of the forces on the inner ring by g [N/m]: axial by axial, axial by radial and radial
        by radial component.
        """
        return in_series(self.inner, self.outer)


def in_series(inner: Contacts, outer: Contacts) -> tuple[Array, Array, Array]:
    """Stiffness of both contacts of a ball [N/m], which follows the ring to its new equilibrium.

    Returns the components axial by axial, axial by radial and radial by radial. Springs in series with the
    matrices A and B have A (A + B)^-1 B = (det(A) B + det(B) A)/det(A + B).
    """
    a, b = inner.tangent, outer.tangent
    det_a, det_b = inner.along * inner.across, outer.along * outer.across
    # Where a ball only just touches, the matrix would be singular.
    both = np.maximum(determinant(*(x + y for x, y in zip(a, b, strict=True))), det_a + det_b)
    over = 1.0 / np.maximum(both, _TINY)
    first, second = det_a * over, det_b * over
    return tuple(first * y + second * x for x, y in zip(a, b, strict=True))  # type: ignore[return-value]


def determinant(first: Array, mixed: Array, second: Array) -> Array:
    """Determinants of symmetric matrices of two rows."""
    return first * second - mixed**2


def corner(g: tuple[Array, Array], inner: Array, outer: Array) -> tuple[Array, Array]:
    """Point at the distances ``outer`` from 0 and ``inner`` from g: of two such points the outward one."""
    length = np.maximum(np.hypot(*g), _TINY)
    along = (length**2 + outer**2 - inner**2) / (2.0 * length)
    across = np.sqrt(np.maximum(0.0, outer**2 - along**2))
    unit = g[0] / length, g[1] / length
    # Of the two unit vectors perpendicular to g, this is the outward one.
    side = np.where(unit[0] < 0.0, -1.0, 1.0)
    axial, radial = along * unit[0] - across * side * unit[1], along * unit[1] + across * np.abs(unit[0])
    # Radially beyond g the inner groove is a plane wall.
    wall_axial = g[0] - np.copysign(inner, g[0])
    wall_radial = np.sqrt(np.maximum(0.0, outer**2 - wall_axial**2))
    wall = wall_radial > g[1]
    return np.where(wall, wall_axial, axial), np.where(wall, wall_radial, radial)


def at_rest(grooves: Grooves, g: Array) -> tuple[Array, Mask]:
    """Positions of the balls without centrifugal force, shape (2, n) [m], and which of them are loaded.

    Each ball lies on the line through both groove centres. The approach of a loaded ball is divided between
    its contacts according to their stiffnesses. An unloaded ball lies in the middle of its clearance.
    """
    g = np.stack([g[0], np.maximum(g[1], 0.0)])
    length = np.hypot(g[0], g[1])
    play = length - grooves.inner_offset - grooves.outer_offset
    held = play > 0.0
    # With very unequal grooves, the middle of a clearance may lie beyond one of the groove centres.
    share = np.where(held, 1.0 - grooves.inner_share, 0.5)
    out = np.clip(grooves.outer_offset + share * play, 0.0, length)
    return out / np.maximum(length, _TINY) * g, held


def first_guess(grooves: Grooves, g: Array) -> Array:
    """Positions where both contacts are loaded; they lie further out than without centrifugal force."""
    resting = at_rest(grooves, g)[0]
    inner, outer = grooves.contacts(resting, g)
    sunk = grooves.sunk
    axial, radial = corner(
        (g[0], g[1]),
        grooves.inner_offset + np.maximum(0.0, inner.depth) + sunk,
        grooves.outer_offset + np.maximum(0.0, outer.depth) + sunk,
    )
    # Without axial displacement a ball stays in the radial plane.
    upright = (g[0] == 0.0) & (g[1] > 0.0)
    return np.stack(
        [np.where(upright, 0.0, axial), np.where(upright, np.maximum(resting[1], grooves.bottom), radial)]
    )


def _start(grooves: Grooves, g: Array, guess: Array | None) -> Array:
    """Initial guess: positions ``guess`` where both contacts are loaded, else the positions of the first
    guess.
    """
    if guess is None:
        return first_guess(grooves, g)
    inner, outer = grooves.contacts(guess, g)
    near = (inner.depth > 0.0) & (outer.depth > 0.0)
    return guess if near.all() else np.where(near, guess, first_guess(grooves, g))


def _settled(grooves: Grooves, g: Array, p: Array) -> Array:
    """Positions of the balls loaded by both grooves, by Newton's method from the initial guess p."""
    offset = grooves.inner_offset + grooves.outer_offset

    def imbalance(p: Array) -> tuple[Array, tuple[Array, Array, Array], Mask]:
        inner, outer = grooves.contacts(p, g)
        axial = inner.load * inner.sine - outer.load * outer.sine
        radial = inner.load * inner.cosine - outer.load * outer.cosine + grooves.outward
        first, mixed, second = (x + y for x, y in zip(inner.tangent, outer.tangent, strict=True))
        size = inner.load + outer.load + grooves.outward
        noise = _ROUNDING * size + _NUDGE * offset * (first + second)
        # A contact that only just touches has no stiffness: this small one keeps the matrix regular.
        little = 1e-13 * size / offset
        moving = np.maximum(np.abs(axial), np.abs(radial)) > noise
        return np.stack([axial, radial]), (first + little, mixed, second + little), moving

    force, (first, mixed, second), moving = imbalance(p)
    for _ in range(_MOST_STEPS):
        if not moving.any():
            break
        over = 1.0 / np.maximum(determinant(first, mixed, second), _TINY)
        step = np.stack(
            [(second * force[0] - mixed * force[1]) * over, (first * force[1] - mixed * force[0]) * over]
        )
        step *= np.minimum(1.0, 0.5 * offset / np.maximum(np.hypot(step[0], step[1]), _TINY))
        slope = np.sum(force * step, axis=0)
        part = np.ones_like(slope)
        for _ in range(_MOST_TRIALS):
            there = p + part * step
            force, (first, mixed, second), moving = imbalance(there)
            now = np.sum(force * step, axis=0)
            over_shot = moving & (now < -_OVERSHOOT * slope)
            if not over_shot.any():
                break
            shorter = np.maximum(slope / np.where(over_shot, slope - now, 1.0), 0.02)
            part = np.where(over_shot, part * shorter, part)
        p = there
    return p


def seat(grooves: Grooves, g: Array, guess: Array | None = None) -> Seats:
    """Positions and contacts of balls between grooves with their centres at 0 and g.

    At speed, a ball that does not touch the inner groove lies at the bottom of the outer groove, where
    centrifugal force presses it. At rest, an unloaded ball lies in the middle of its clearance.

    ``g``, centre of the inner groove at each ball, axial and radial [m], shape (2, n); ``guess``, positions
    that may be close, shape (2, n).

    Examples
    --------
    Two equal contacts share an approach of 2 um equally:

    >>> both = np.full(1, 1e10)
    >>> seats = seat(Grooves(0.2e-3, 0.2e-3, both, both, 0.0), np.array([[0.0], [0.402e-3]]))
    >>> round(float(seats.inner.load[0]), 3), round(float(seats.place[1, 0]) * 1e3, 6)
    (10.0, 0.201)
    """
    place, held = at_rest(grooves, g)
    turning = np.broadcast_to(grooves.outward, held.shape) != 0.0
    if turning.any():
        sunk = np.stack([np.zeros_like(place[0]), np.broadcast_to(grooves.bottom, held.shape)])
        place = np.where(turning, sunk, place)
        held = np.where(turning, grooves.contacts(place, g)[0].depth > 0.0, held)
        pressed = held & turning
        if pressed.any():
            part, there = grooves.chosen(pressed), g[:, pressed]
            place[:, pressed] = _settled(
                part, there, _start(part, there, None if guess is None else guess[:, pressed])
            )
    return Seats(place, held, *grooves.contacts(place, g))
