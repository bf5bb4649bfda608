"""Balls between two grooves: where each sits, what it carries, how stiff it is. SI units.

Seen in the plane through the bearing's axis and the ball's centre, a groove is a circle about its centre,
and the ball, which is smaller, lies inside both. Vectors in that plane are (axial, radial), from the centre
of the outer groove: the ball's centre is at p and the inner groove's at g. The contacts are pressed in by

    delta_o = abs(p) - (f_o - 1/2) D,    delta_i = abs(g - p) - (f_i - 1/2) D

and resist with Q = K delta^(3/2) where that is positive. A groove does not reach round the ball: beyond
90 deg it goes on as a plane wall, so that for a vector that points inward only its axial part counts. Both
lengths are convex functions, and so is the energy (2/5) K delta^(5/2) of both contacts less the work of the
centrifugal force, in p and g together: each ball has one place, and Newton's method finds it.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ehlectric.arrays import Array, Mask

_RADIAL = np.array([0.0, 1.0])
_UNITY = np.eye(2)

# What counts of a vector: all of its axial part, of its radial one what points outward.
_INWARD = np.array([-np.inf, 0.0])
_TINY = np.finfo(float).tiny
_MOST_STEPS = 60
_MOST_TRIALS = 40

# A step that overshoots is taken back until the force along it is at most this part of the one at its start.
_OVERSHOOT = 0.5

# What rounding leaves: of the forces of a ball, and of its place over the distance of the groove centres.
_ROUNDING = 1e-15
_NUDGE = 4e-16


@dataclass(frozen=True)
class Contacts:
    """One contact of each ball.

    Attributes
    ----------
    normal : ndarray, shape (n, 2)
        Unit vector, from the outer groove's centre or towards the inner one's.
    depth : ndarray, shape (n,)
        By how much it is pressed in [m]; its negative is the gap where the ball does not touch.
    load : ndarray, shape (n,)
        Q [N].
    tangent : ndarray, shape (n, 2, 2)
        Derivative of the force Q n [N/m].
    """

    normal: Array
    depth: Array
    load: Array
    tangent: Array

    @classmethod
    def of(cls, span: Array, offset: float, stiffness: Array) -> Contacts:
        """Contacts of a vector between both centres, with the length at which they touch and K."""
        counted = np.maximum(span, _INWARD)
        length = np.hypot(counted[:, 0], counted[:, 1])
        # Two centres on each other have no direction, and no force either.
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
        """Q n [N], shape (n, 2)."""
        return self.load[:, None] * self.normal


@dataclass(frozen=True)
class Grooves:
    """What the balls sit in.

    Attributes
    ----------
    inner_offset, outer_offset : float
        (f - 1/2) D of both grooves [m].
    inner_stiffness, outer_stiffness : ndarray, shape (n,)
        K of the contacts of each ball [N/m^(3/2)].
    outward : float
        Centrifugal force on each ball [N]; zero at rest.
    """

    inner_offset: float
    outer_offset: float
    inner_stiffness: Array
    outer_stiffness: Array
    outward: float

    def contacts(self, p: Array, g: Array, chosen: Mask | slice = slice(None)) -> tuple[Contacts, Contacts]:
        """Inner and outer contacts of balls at p between groove centres at 0 and g, shape (n, 2)."""
        inner = Contacts.of(g - p, self.inner_offset, self.inner_stiffness[chosen])
        return inner, Contacts.of(p, self.outer_offset, self.outer_stiffness[chosen])


@dataclass(frozen=True)
class Seats:
    """Where the balls sit.

    Attributes
    ----------
    place : ndarray, shape (n, 2)
        p [m].
    held : ndarray of bool, shape (n,)
        Whether a ball is held between both grooves.
    inner, outer : Contacts
        Its contacts.
    """

    place: Array
    held: Mask
    inner: Contacts
    outer: Contacts

    @property
    def tangent(self) -> Array:
        """Derivative of the forces on the inner ring by g, the balls following: two springs in series."""
        stiffness = np.zeros_like(self.inner.tangent)
        inner, outer = self.inner.tangent[self.held], self.outer.tangent[self.held]
        both = inner + outer
        # A ball just touched is stiff one way only, or not at all.
        little = 1e-15 * np.trace(both, axis1=1, axis2=2) + _TINY
        both += little[:, None, None] * _UNITY
        stiffness[self.held] = inner @ np.linalg.solve(both, outer)
        # The product of the two is symmetric but for rounding.
        return 0.5 * (stiffness + stiffness.transpose(0, 2, 1))


def _corner(g: Array, inner: Array, outer: Array) -> Array:
    """The outward one of the two points at the lengths ``outer`` from 0 and ``inner`` from g."""
    length = np.maximum(np.hypot(g[:, 0], g[:, 1]), _TINY)
    along = (length**2 + outer**2 - inner**2) / (2.0 * length)
    across = np.sqrt(np.maximum(0.0, outer**2 - along**2))
    unit = g / length[:, None]
    normal = np.stack([-unit[:, 1], unit[:, 0]], axis=1)
    # Of the two unit vectors across, the outward one.
    normal[normal[:, 1] < 0.0] *= -1.0
    corner = along[:, None] * unit + across[:, None] * normal
    # Further out than g the ball leans on the plane wall.
    axial = g[:, 0] - np.copysign(inner, g[:, 0])
    wall = np.stack([axial, np.sqrt(np.maximum(0.0, outer**2 - axial**2))], axis=1)
    return np.where((wall[:, 1] > g[:, 1])[:, None], wall, corner)


def _at_rest(grooves: Grooves, g: Array) -> tuple[Array, Mask]:
    """Places without centrifugal force: on the line of the centres, pressed in as far as both K say.

    Balls that nothing holds are in the middle of their clearance.
    """
    g = np.maximum(g, _INWARD)
    length = np.hypot(g[:, 0], g[:, 1])
    play = length - grooves.inner_offset - grooves.outer_offset
    held = play > 0.0
    softness = grooves.outer_stiffness ** (-2.0 / 3.0)
    share = np.where(held, softness / (softness + grooves.inner_stiffness ** (-2.0 / 3.0)), 0.5)
    # A groove far smaller than the other one is left from its own centre, not beyond.
    out = np.clip(grooves.outer_offset + share * play, 0.0, length)
    return (out / np.maximum(length, _TINY))[:, None] * g, held


def _first_guess(grooves: Grooves, g: Array) -> Array:
    """Places where both contacts are pressed in: further out than at rest."""
    still, _ = _at_rest(grooves, g)
    inner, outer = grooves.contacts(still, g)
    more = (grooves.outward / grooves.outer_stiffness) ** (2.0 / 3.0)
    return _corner(
        g,
        grooves.inner_offset + np.maximum(0.0, inner.depth) + more,
        grooves.outer_offset + np.maximum(0.0, outer.depth) + more,
    )


def _start(grooves: Grooves, g: Array, held: Mask, guess: Seats | None) -> Array:
    """Places to start from: those nearby where both contacts are pressed in there, else the first guess."""
    if guess is None:
        return _first_guess(grooves, g)
    inner, outer = grooves.contacts(guess.place, g)
    near = guess.held & (inner.depth > 0.0) & (outer.depth > 0.0)
    if near[held].all():
        return guess.place
    return np.where(near[:, None], guess.place, _first_guess(grooves, g))


def _settled(grooves: Grooves, g: Array, held: Mask, p: Array) -> Array:
    """Places of the balls held between both grooves, by Newton's method on each; p to start from."""
    offset = grooves.inner_offset + grooves.outer_offset

    def imbalance(p: Array) -> tuple[Array, Array, Mask]:
        inner, outer = grooves.contacts(p, g, held)
        force = inner.force - outer.force + grooves.outward * _RADIAL
        tangent = inner.tangent + outer.tangent
        size = inner.load + outer.load + grooves.outward
        noise = _ROUNDING * size + _NUDGE * offset * (tangent[:, 0, 0] + tangent[:, 1, 1])
        # A touch of stiffness where a contact is just being made and has none.
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
    """Where balls sit between groove centres at 0 and g.

    A ball that centrifugal force alone would seat clear of the inner groove stays at the bottom of the outer
    one. At rest a ball that nothing holds is shown in the middle of its clearance.

    Parameters
    ----------
    grooves : Grooves
        The grooves and contacts of n balls.
    g : ndarray, shape (n, 2)
        Centres of the inner groove, axial and radial [m].
    guess : Seats or None
        Seats nearby.

    Returns
    -------
    Seats
        Of the n balls.

    Examples
    --------
    Equal grooves pulled 2 um apart beyond touching share that equally:

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


def lean_outward(grooves: Grooves, g: Array) -> Array:
    """Places of balls at rest that nothing holds, at the outer groove: the limit of slow rotation.

    At the bottom of the outer groove, or, where the inner one does not let it get there, in the corner that
    both leave.

    Parameters
    ----------
    grooves : Grooves
        The grooves.
    g : ndarray, shape (n, 2)
        Centres of the inner groove [m].

    Returns
    -------
    ndarray, shape (n, 2)
        p [m].

    Examples
    --------
    >>> both = np.full(1, 1e10)
    >>> grooves = Grooves(0.2e-3, 0.2e-3, both, both, 0.0)
    >>> [round(float(x) * 1e3, 4) for x in lean_outward(grooves, np.array([[0.0, 0.39e-3]]))[0]]
    [0.0, 0.2]
    >>> [round(float(x) * 1e3, 4) for x in lean_outward(grooves, np.array([[0.3e-3, 0.0]]))[0]]
    [0.1, 0.1732]
    """
    bottom = np.broadcast_to(grooves.outer_offset * _RADIAL, g.shape)
    inner, _ = grooves.contacts(bottom, g)
    ones = np.ones(len(g))
    corner = _corner(g, grooves.inner_offset * ones, grooves.outer_offset * ones)
    return np.where((inner.depth > 0.0)[:, None], corner, bottom)
