"""Integrals over the gaps of balls whose films are dry gaps widened by a number.

With the semi-axis b along rolling as the unit of length on the raceway and b^2/Rx as the unit of the gap, a
dry contact depends only on the ratio of its radii. Positions along entrainment are positive behind the
contact. Ends of domains are distances from its middle, all positive.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any

import numpy as np

from ehlectric.arrays import Array, IntArray, Numbers, as_float
from ehlectric.bearing.gaps import (
    FINE,
    LoadedContact,
    Nodes,
    Raceway,
    for_nodes,
    missing_gap,
    outside_capacitance,
)
from ehlectric.contact import DomainRule, Ends
from ehlectric.formulas.capacitances import matched_offset
from ehlectric.formulas.carlson import complete_rd, complete_rf
from ehlectric.formulas.hertz import DryContact, axis_ratio
from ehlectric.formulas.hertz_outside import unit_deflection

# Largest relative difference of ends of domains that are alike up to rounding.
_ALIKE = 1e-12


@dataclass(frozen=True)
class DomainLaw:
    """Ends of the domains of films: default ones, or further ones where the film builds up over a length."""

    # Default inlet and outlet over b, and default side over a as a function of the ratio k of the semi-axes.
    inlet: float
    outlet: float
    side: Callable[[Numbers], Numbers]
    rule: DomainRule  # further ends
    coarseness: float = 1.0  # factor on the errors of polynomials instead of integrals
    least: int = 200  # least number of contacts for which polynomials are made
    nodes: Nodes = FINE  # nodes of the integrals around films

    def ends(self, state: tuple[int, ...], length: Numbers, unit: UnitContact) -> Ends:
        """Inlet, outlet and side that are default, follow from a length, or are largest: ``state`` 0, 1 or 2.

        ``length``, sqrt(2 Rx h)/b, shape (...).
        """
        rule, across = self.rule, length * np.sqrt(unit.radius_ratio) / unit.ratio
        return (
            (self.inlet, rule.inlet(length), rule.most[0])[state[0]],
            (self.outlet, rule.downstream * length, rule.most[1])[state[1]],
            (self.side(unit.ratio), rule.side(across), rule.most[2])[state[2]],
        )

    def states(self, ends: Ends, unit: UnitContact) -> IntArray:
        """Return the states of domain ends as digits of a number to the base of three."""
        least = (self.inlet, self.outlet, self.side(unit.ratio))
        total: IntArray = np.zeros((), dtype=np.intp)
        for end, near, most in zip(ends, least, self.rule.most, strict=True):
            total = 3 * total + np.where(end >= most, 2, np.where(end > near * (1.0 + _ALIKE), 1, 0))
        return total

    def length(self, state: tuple[int, ...], ends: Ends, unit: UnitContact) -> Numbers:
        """Length sqrt(2 Rx h)/b from which ends follow; 1 where none does."""
        if state[0] == 1:
            return ends[0] / self.rule.upstream
        if state[1] == 1:
            return ends[1] / self.rule.downstream
        if state[2] == 1:
            return (ends[2] - 1.0) / self.rule.sideways * unit.ratio / np.sqrt(unit.radius_ratio)
        return np.ones_like(ends[0])


@dataclass(frozen=True)
class UnitContact:
    """Dry contact with lengths on the raceway in b and gaps in b^2/Rx; numbers, or arrays of shape (...)."""

    ratio: Numbers  # k = a/b
    radius_ratio: Numbers  # Ry/Rx
    opening: Numbers  # deflection over the integral I of ``unit_deflection``
    approach: Numbers  # elastic approach

    @classmethod
    def of(cls, radius_x: Numbers, radius_y: Numbers) -> UnitContact:
        """Contact of bodies with reduced radii [m]."""
        ratio = _axis_ratios(radius_x, radius_y)
        # b^3 = 2 F Rx R_D(0, k^2, 1)/(pi E') and p_h = 3 F/(2 pi k b^2).
        size = complete_rd(ratio**2, 1.0)
        opening, approach = as_float(0.75 / size), as_float(1.5 * complete_rf(1.0, ratio**2) / size)
        return cls(ratio, radius_y / radius_x, opening, approach)

    def gap(self, x: Array, y: Array) -> tuple[Array, Array]:
        """Gap of the bodies in contact, and the deflection in it; ``x`` and ``y``, positions over b."""
        x2, y2 = x * x, y * y
        opened = self.opening * unit_deflection(x2, y2, self.ratio)
        gap: Array = 0.5 * (x2 + y2 / self.radius_ratio) + opened - self.approach
        return np.maximum(0.0, gap), opened

    def for_nodes(self, axes: int) -> UnitContact:
        """Contacts with further axes for nodes."""
        return UnitContact(*(for_nodes(value, axes) for value in vars(self).values()))

    def at(self, points: IntArray) -> UnitContact:
        """Some of the contacts."""
        return UnitContact(*(v if np.ndim(v) == 0 else v[points] for v in vars(self).values()))


def rims(
    unit: UnitContact, domain: tuple[Numbers, Numbers, Numbers], rim: tuple[int, int]
) -> tuple[Array, Array, Array, Array]:
    """Nodes on the edge of domains over b, gap there and the deflection in it over b^2/Rx, shape (..., n).

    ``domain``, inlet and outlet over b and side over a, shape (...); ``rim``, numbers of nodes along and
    across entrainment. Gap and deflection are the same on both sides across entrainment.
    """
    inlet, outlet, side = (
        np.asarray(end, dtype=float)[..., np.newaxis] for end in np.broadcast_arrays(*domain)
    )
    unit = unit.for_nodes(1)
    along = inlet + (outlet - inlet) * np.linspace(0.0, 1.0, rim[0])[1:-1]
    across = side * unit.ratio * np.linspace(0.0, 1.0, rim[1] // 2 + 1)
    # Both ends from the middle to the side, and the side without its ends.
    ones, rest = np.ones(across.shape), np.ones(along.shape)
    x = np.concatenate([inlet * ones, outlet * ones, along], axis=-1)
    y = np.concatenate([across, across, across[..., -1:] * rest], axis=-1)
    gap, opened = unit.gap(x, y)
    other = [n for n in range(x.shape[-1]) if n % across.shape[-1] or n >= 2 * across.shape[-1]]
    return (
        np.concatenate([x, x[..., other]], axis=-1),
        np.concatenate([y, -y[..., other]], axis=-1),
        np.concatenate([gap, gap[..., other]], axis=-1),
        np.concatenate([opened, opened[..., other]], axis=-1),
    )


def _axis_ratios(radius_x: Numbers, radius_y: Numbers) -> Numbers:
    """Ratios of semi-axes, computed once for equal radii; 1 without radii."""
    if np.ndim(radius_x) == np.ndim(radius_y) == 0:
        return axis_ratio(float(radius_x), float(radius_y))
    radius_ratio = np.where(np.isfinite(radius_x * radius_y), radius_y / radius_x, 1.0)
    several, number = np.unique(radius_ratio, return_inverse=True)
    ratios = np.asarray(axis_ratio(np.ones_like(several), several))
    return ratios[number].reshape(radius_ratio.shape)


# Contacts that are matched together: few enough for the processor's cache.
_BLOCK = 96


def around_directly(
    race: Raceway,
    b: Numbers,
    domain: tuple[Numbers, Numbers, Numbers],
    films: Numbers,
    *,
    shoulders: bool = True,
    nodes: Nodes = FINE,
) -> tuple[Array, Array]:
    """Capacitance between balls and raceway outside the domains of films: dry gaps widened by a number.

    The gap continues the film at the edge of its domain. ``b``, semi-axis of the dry contact along
    entrainment [m]; ``domain``, inlet and outlet over b and side over the semi-axis across entrainment;
    ``films``, film thickness in the middle [m]; they broadcast with the numbers of ``race`` to the shape
    (...); ``nodes``, numbers of quadrature nodes. Returns the capacitance in vacuum [F], shape (...), and the
    largest relative difference, at the edge of the domain, between the film thickness and the gap outside,
    shape (...).
    """
    varies = [name for name, value in vars(race).items() if np.ndim(value) > 0]
    numbers = (b, films, *domain, *(getattr(race, name) for name in varies))
    shape = np.broadcast_shapes(*(np.shape(value) for value in numbers))
    flat = [np.broadcast_to(value, shape).ravel() for value in numbers]
    integral = np.empty((2, flat[0].size))
    for start in range(0, integral.shape[1], _BLOCK):
        columns = [values[start : start + _BLOCK] for values in flat]
        values: dict[str, Any] = dict(zip(varies, columns[5:], strict=True))
        part = replace(race, **values)
        integral[:, start : start + _BLOCK] = _around(part, *columns[:5], shoulders=shoulders, nodes=nodes)
    return integral[0].reshape(shape)[()], integral[1].reshape(shape)[()]


def _around(
    race: Raceway, b: Array, films: Array, *domain: Array, shoulders: bool, nodes: Nodes
) -> tuple[Array, Array]:
    """As ``around_directly``, for arrays of shape (m,)."""
    unit = UnitContact.of(race.radius_x, race.radius_y)
    inlet, outlet, side = domain
    x, y, gap, opened = rims(unit, (inlet, outlet, side), nodes.rim)
    scale = b**2 / race.radius_x
    thickness = films[:, np.newaxis] + scale[:, np.newaxis] * gap
    lengths = b[:, np.newaxis]
    missing = missing_gap(race, thickness - scale[:, np.newaxis] * opened, x * lengths, y * lengths)
    offset, mismatch = matched_offset(missing, thickness, start=films - scale * unit.approach)
    # Pressure over modulus with which the opening of the unit contact equals the opening of
    # ``LoadedContact``.
    a = unit.ratio * b
    contact = LoadedContact(
        DryContact(b, a, unit.opening * scale / a, 0.0), 1.0, offset, mismatch, unit.ratio
    )
    ends = b * inlet, b * outlet, a * side
    capacitance = outside_capacitance(race, contact, ends, shoulders=shoulders, nodes=nodes)
    return np.asarray(capacitance), mismatch


# Nodes and weights on 0 to 1 with which the gap between two domains is integrated.
_AT, _PART = (0.5 * values for values in np.polynomial.legendre.leggauss(12))
_AT = _AT + 0.5


def between_directly(unit: UnitContact, near: Ends, far: Ends, middle: Array) -> Array:
    """Integral of dA/h over Rx between the default domain of a film and a wider one, for dry gaps widened by
    the film in the middle.

    ``unit``, dry contacts; ``near`` and ``far``, inlet, outlet and side of the domains in semi-axes;
    ``middle``, film over b^2/Rx; all of shape (m,). Returns the integral, dimensionless, shape (m,).
    """
    integral, rows = np.empty(middle.size), np.arange(middle.size)
    for part in np.array_split(rows, 1 + rows.size // _BLOCK):
        ends = [np.broadcast_to(end, middle.shape)[part] for end in (*near, *far)]
        integral[part] = _between(unit.at(part), *ends, middle=middle[part])
    return integral


def _between(unit: UnitContact, *ends: Array, middle: Array) -> Array:
    """As ``between_directly``, for few contacts."""
    inlet, outlet, side, *far = ends
    ratio, middle = unit.ratio, for_nodes(middle, 3)
    # Ahead and behind over the whole side, denser in the middle, and next to the default ends.
    ahead, behind, further = (_geometric(*pair) for pair in zip((inlet, outlet, side), far, strict=True))
    whole = for_nodes(far[2]) * _AT**2, for_nodes(far[2]) * 2.0 * _AT * _PART
    along = (
        ahead,
        behind,
        (for_nodes(inlet) * _AT, for_nodes(inlet) * _PART),
        (for_nodes(outlet) * _AT, for_nodes(outlet) * _PART),
    )
    across = whole, whole, further, further
    (x, along_weights), (y, across_weights) = (
        (np.stack(columns, axis=1) for columns in zip(*parts, strict=True)) for parts in (along, across)
    )
    x[:, ::2] *= -1.0
    unit = unit.for_nodes(3)
    gap, _ = unit.gap(x[..., :, np.newaxis], unit.ratio * y[..., np.newaxis, :])
    over = np.add.reduce(across_weights[..., np.newaxis, :] / (middle + gap), axis=-1)
    integral: Array = 2.0 * ratio * np.add.reduce(along_weights * over, axis=(-2, -1))
    return integral


def _geometric(near: Array, far: Array) -> tuple[Array, Array]:
    """Nodes and weights from ``near`` to ``far``, denser at the near end."""
    near = for_nodes(near)
    ratio = np.log(for_nodes(far) / near)
    nodes = near * np.exp(ratio * _AT)
    return nodes, ratio * nodes * _PART


# Nodes and weights on 0 to 1 with which the gap around the Hertz ellipse is integrated. The integrals are
# within 1e-4 of the integrals with three times as many nodes.
_FINE, _FINE_PART = (0.5 * values for values in np.polynomial.legendre.leggauss(32))
_FINE = _FINE + 0.5

# Weights, and gaps over b^2/Rx, of an integral over a part of the gap.
_Part = tuple[Array, Array]


def around_ellipse_directly(radius_ratio: Array, middle: Array, law: DomainLaw) -> tuple[Array, Array]:
    """Integrals of dA/h over Rx before and behind the middle of contacts, outside the ellipse and inside the
    default domain, for dry gaps widened by the film in the middle.

    ``radius_ratio``, Ry/Rx, and ``middle``, film over b^2/Rx; shape (m,). Returns both integrals,
    dimensionless, shape (m,).
    """
    integrals = np.empty((2, middle.size))
    ratios, number = np.unique(radius_ratio, return_inverse=True)
    for k, ratio in enumerate(ratios.tolist()):
        rows = np.flatnonzero(number == k)
        for part, (weights, gap) in enumerate(parts_around_ellipse(ratio, law)):
            for some in np.array_split(rows, 1 + rows.size // _BLOCK):
                integrals[part, some] = (1.0 / (middle[some, np.newaxis] + gap)) @ weights
    return integrals[0], integrals[1]


@lru_cache(maxsize=64)
def parts_around_ellipse(radius_ratio: float, law: DomainLaw) -> tuple[_Part, _Part]:
    """Weights and gaps of the integrals of ``around_ellipse_directly``, before and behind the middle.

    Lengths are in b. Next to the ellipse, x is the cosine of an angle, so that its edge is smooth in this
    angle; away from it nodes are dense at the edge.
    """
    unit = UnitContact.of(1.0, radius_ratio)
    side = float(law.side(unit.ratio))
    # Next to the ellipse: angle and distance from its edge.
    angle, far = 0.5 * np.pi * _FINE[:, np.newaxis], _FINE**3
    edge = np.sin(angle)
    near = np.cos(angle), edge + (side - edge) * far
    weights = 0.5 * np.pi * edge * _FINE_PART[:, np.newaxis] * (side - edge) * 3.0 * _FINE**2 * _FINE_PART
    lengths = [end - 1.0 for end in (law.inlet, law.outlet)]
    ahead = [(1.0 + length * _FINE[:, np.newaxis] ** 3, side * _FINE) for length in lengths]
    x, y = (np.stack(np.broadcast_arrays(*values)) for values in zip(near, *ahead, strict=True))
    gap, _ = unit.gap(x, unit.ratio * y)
    parts = []
    for length, beyond in zip(lengths, gap[1:], strict=True):
        more = length * 3.0 * (_FINE**2 * _FINE_PART)[:, np.newaxis] * side * _FINE_PART
        # Both halves across entrainment.
        both = 2.0 * unit.ratio * np.stack([weights, more])
        parts.append((both.ravel(), np.stack([gap[0], beyond]).ravel()))
    return parts[0], parts[1]
