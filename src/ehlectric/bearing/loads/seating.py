"""Balls between two grooves: position, contact forces and stiffness of each ball. SI units.

In the plane through the bearing axis and the ball's centre, a groove is a circle about the groove's centre.
The ball is smaller than both circles and lies inside them. Vectors in this plane are (axial, radial) from the
centre of the outer groove: the ball's centre is at p, and the centre of the inner groove at g. The elastic
approach in the contacts is

    delta_o = abs(p) - (f_o - 1/2) D,    delta_i = abs(g - p) - (f_i - 1/2) D

and their load is Q = K delta^(3/2) where delta is positive. A groove does not enclose the ball. Beyond 90 deg
it continues as a plane wall: of a vector that points inward only the axial component counts. Both lengths
are convex functions of p and g. The energy, (2/5) K delta^(5/2) of both contacts less the work of the
centrifugal force, is then convex as well. Each ball therefore has a single position of equilibrium, which
Newton's method computes.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ehlectric.arrays import Array, Mask

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
    """Contacts of n balls with one groove.

    Attributes
    ----------
    normal : ndarray, shape (n, 2)
        Unit vector n along the contact: from the centre of the outer groove to the ball, or from the ball to
        the centre of the inner groove.
    depth : ndarray, shape (n,)
        Elastic approach [m]; where the ball does not touch, it is negative, the gap with a minus sign.
    load : ndarray, shape (n,)
        Load Q [N].
    tangent : ndarray, shape (n, 2, 2)
        Derivative of the force Q n by the vector between the centres of ball and groove [N/m].
    """

    normal: Array
    depth: Array
    load: Array
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
    """Grooves of both rings, and contact stiffnesses of n balls.

    Attributes
    ----------
    inner_offset, outer_offset : float
        Distance (f - 1/2) D between the centres of ball and groove at first touch [m].
    inner_stiffness, outer_stiffness : ndarray, shape (n,)
        Stiffness K of the contacts of each ball [N/m^(3/2)].
    outward : float
        Centrifugal force on each ball [N]; zero at rest.
    """

    inner_offset: float
    outer_offset: float
    inner_stiffness: Array
    outer_stiffness: Array
    outward: float

    def contacts(self, p: Array, g: Array, chosen: Mask | slice = slice(None)) -> tuple[Contacts, Contacts]:
        """Inner and outer contacts of balls at p, with the groove centres at 0 and g, shape (n, 2)."""
        inner = Contacts.of(g - p, self.inner_offset, self.inner_stiffness[chosen])
        return inner, Contacts.of(p, self.outer_offset, self.outer_stiffness[chosen])


@dataclass(frozen=True)
class Seats:
    """Positions and contacts of n balls between two grooves.

    Attributes
    ----------
    place : ndarray, shape (n, 2)
        Position p of the ball's centre [m].
    held : ndarray of bool, shape (n,)
        Whether the ball is loaded by both grooves.
    inner, outer : Contacts
        Contacts with the inner and the outer groove.
    """

    place: Array
    held: Mask
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

    Parameters
    ----------
    grooves : Grooves
        Grooves and contact stiffnesses of n balls.
    g : ndarray, shape (n, 2)
        Centre of the inner groove at each ball, axial and radial [m].
    guess : Seats or None
        Seats at groove centres close to ``g``, as an initial guess.

    Returns
    -------
    Seats
        Positions and contacts of the n balls.

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


def lean_outward(grooves: Grooves, g: Array) -> Array:
    """Positions of unloaded balls at rest that lie in the outer groove: the limit of slow rotation.

    A ball lies at the bottom of the outer groove. Where the inner groove is in the way, the ball lies in the
    corner where it touches both grooves.

    Parameters
    ----------
    grooves : Grooves
        Grooves and contact stiffnesses of n balls.
    g : ndarray, shape (n, 2)
        Centre of the inner groove at each ball, axial and radial [m].

    Returns
    -------
    ndarray, shape (n, 2)
        Position p of each ball [m].

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
