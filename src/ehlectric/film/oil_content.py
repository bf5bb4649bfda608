"""Film content in the gap, for films with an oil supply and films that form again downstream of a cavity.

Oil that fills only a part of the gap is carried along by the surfaces. Every node fulfils the complementarity
condition of Elrod and Adams in the whole domain:

    P >= P_amb,   theta <= 1,   (P - P_amb) (1 - theta) = 0,
    d(theta rho H)/dX - d/dX(eps dP/dX) - d/dY(eps dP/dY) = 0

A node is filled (theta = 1) or cavitated (P = P_amb). If the gap is cavitated, the mass m = theta rho H,
of a hot film with its drift (``Flow.carried``), is carried along entrainment by an upstream difference of
first order, which conserves it whatever the grid. It begins as the layer of oil at the inlet edge. The masses
of a run of cavitated nodes follow from the rows of the Reynolds equation one after the other. They are
eliminated: the row of the first filled node behind a run is the sum of the rows of the run and its own.

H. G. Elrod, J. Lubr. Technol. 103 (1981) 350, doi:10.1115/1.3251669; F. Chevalier, A. A. Lubrecht,
P. M. E. Cann, F. Colin and G. Dalmaz, J. Tribol. 120 (1998) 126, doi:10.1115/1.2834175 (both second-hand).
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np

from ehlectric.arrays import Array, Mask
from ehlectric.film.cavitation import full_film_nodes
from ehlectric.film.face_flow import Flow
from ehlectric.film.levels import Level
from ehlectric.film.mesh import Mesh
from ehlectric.film.reynolds import ALONG, Stencil, residual

# Ratio of the full gaps of two nodes up to which the mass behind them is extrapolated, and the further rise
# of this ratio at which half of it is the mean of two nodes.
_STEEP, _HALF = 1.3, 1.0


@dataclass(frozen=True)
class Steepness:
    """How steeply the gap closes to the nodes of a grid, where the mass at a face follows from their ratio.

    The mass at the face behind a node is 3/2 m of the node minus 1/2 m of the node before, little where the
    gap falls steeply, and negative where it falls to less than a third from node to node: no oil would enter
    a spot that touches. A part of it is the mean of two nodes there. The part grows smoothly with the
    steepness, so that the film does not depend on the way to it.
    """

    part: Array  # part w of the mass behind a node that is a mean, from 0 to 1, shape (nx, ny)
    # by_before and by_node: derivatives of w by the full mass of the node before and of the node,
    # shape (nx, ny); zero on coarser grids.
    by_before: Array
    by_node: Array
    # Part of the mass at the face behind a node that is the mass of the node, because the gap opens steeply
    # to the next node, and its derivatives by the full mass of the node and of the next one, (nx - 1, ny).
    opening: Array
    opening_by_node: Array
    opening_by_next: Array

    @classmethod
    def of(cls, full: Array) -> Steepness:
        """Steepness of a gap with the mass rho H (nx, ny).

        Examples
        --------
        >>> Steepness.of(np.array([[2.3], [1.0], [1.0]])).part[:, 0].round(3).tolist()
        [0.0, 0.5, 0.0]
        """
        ratio = np.ones_like(full)
        ratio[1:] = full[:-1] / full[1:]
        part, slope = _part_of(ratio)
        rise = full[1:] / full[:-1]
        opening, by_rise = _part_of(rise)
        return cls(
            part=part,
            by_before=slope / full,
            by_node=-slope * ratio / full,
            opening=opening,
            opening_by_node=-by_rise * rise / full[:-1],
            opening_by_next=by_rise / full[:-1],
        )

    def injected(self, level: Level) -> Steepness:
        """Steepness on the next coarser grid, for its wedge term only."""
        part = level.inject(self.part)
        # The opening to the next node of a coarser grid is larger.
        opening = level.inject(np.concatenate([self.opening, self.opening[-1:]]))[:-1]
        none, no_opening = np.zeros_like(part), np.zeros_like(opening)
        return Steepness(part, none, none, opening, no_opening, no_opening)


def _part_of(ratio: Array) -> tuple[Array, Array]:
    """Part of lower order at a ratio of two full gaps, and its derivative by the ratio."""
    above = np.maximum(ratio - _STEEP, 0.0) / _HALF
    return above**2 / (1.0 + above**2), 2.0 * above / _HALF / (1.0 + above**2) ** 2


# Pressure at which a node counts as half full, as a part of the pressure that drives back across one spacing
# what the surfaces carry, and its largest value over p_h.
_HALF_FULL, _MOST_HALF_FULL = 0.1, 1e-2


@dataclass(frozen=True)
class Fullness:
    """How far filled nodes are from cavitation, which weighs their mass in formulas of a higher order.

    A node is filled or cavitated. If only this decided the formula of a face, the flow would jump where a
    node changes at ambient pressure, and several sets of filled nodes could fulfil the equations. The weight
    of a node, P^2/(P^2 + P_s^2) with its excess pressure P, vanishes at ambient pressure, so that the flow is
    continuous.
    """

    weight: Array  # weight w of each node, from 0 to 1, shape (nx, ny)
    slope: Array  # derivative of w by the pressure of the node, shape (nx, ny)

    @classmethod
    def of(cls, excess: Array, mass: Array, poiseuille: Array, rate: float) -> Fullness:
        """Fullness at an excess pressure, for the mass rho H and the diagonal of the Poiseuille term.

        All are dimensionless, shape (nx, ny).

        Examples
        --------
        >>> ones = np.ones((3, 1))
        >>> Fullness.of(1e-3 * ones, ones, 1e3 * ones, 10.0).weight[:, 0].round(3).tolist()
        [1.0, 1.0, 0.5]
        """
        with np.errstate(divide="ignore"):
            scale = np.minimum(_HALF_FULL * rate * mass / poiseuille, _MOST_HALF_FULL)
        ratio = np.maximum(excess, 0.0) / scale
        weight, slope = ratio**2 / (1.0 + ratio**2), 2.0 * ratio / (1.0 + ratio**2) ** 2 / scale
        # Oil floods the inlet edge at ambient pressure, and the first face takes the mean of its two nodes.
        weight[:2], slope[:2] = 1.0, 0.0
        return cls(weight, slope)

    def injected(self, level: Level) -> Fullness:
        """Fullness on the next coarser grid, for its wedge term only."""
        weight = level.inject(self.weight)
        return Fullness(weight, np.zeros_like(weight))


@dataclass(frozen=True)
class Scheme:
    """Formulas of the mass at the faces next to cavities and to steep edges of the gap."""

    # Whether the flow is continuous where a node changes from filled to cavitated, as rough surfaces need it.
    continuous: bool = True
    # Whether the mass downstream of nodes to which the gap closes steeply is the mass of the node instead of
    # the mean.
    first_order: bool = False

    @property
    def simpler(self) -> Scheme | None:
        """Less accurate scheme that may converge where this one does not; None if there is none."""
        return next(iter(SCHEMES[SCHEMES.index(self) + 1 :]), None)


# All schemes, each less accurate than the one before, which it replaces where that one does not converge.
SCHEMES = (Scheme(), Scheme(continuous=False), Scheme(continuous=False, first_order=True))
USUAL = SCHEMES[0]


@dataclass(frozen=True)
class Supply:
    """Oil that is supplied at the inlet edge, and the order of the wedge term."""

    mass: Array  # mass rho H of the layer of oil at ambient pressure, dimensionless, shape (ny,)
    order: int  # order of the wedge term where the film is filled: 1, 2 or 3
    # Nodes whose mass enters no formula of a higher order, although they may be filled, shape (nx, ny).
    upwind: Mask | bool = False
    steepness: Steepness | None = None  # of the gap at the state; None where surfaces cannot touch
    fullness: Fullness | None = None  # of the nodes at the state; None if all filled nodes are full
    scheme: Scheme = USUAL  # formulas of the mass at the faces

    def wedge(self, mesh: Mesh, filled: Mask, full: Array | None = None) -> Stencil:
        """Operator of the wedge term, an upstream difference, with given filled nodes, a mask (nx, ny).

        With the mass rho H of the full gap (nx, ny), zero where it is cavitated, it is the derivative of the
        wedge term by this mass.
        """
        high = filled & ~np.asarray(self.upwind)
        before, ahead = self._weights(high)
        faces = Faces.weighted(before, ahead, self.order)
        steepness = self.steepness
        if steepness is None:
            return faces.difference(mesh)
        mean = 0.0 * ahead if self.scheme.first_order else 0.5 * ahead
        faces = faces.steep(high, steepness, full, mean)
        if full is not None and self.order > 1 and self.scheme.continuous:
            # The weight ahead falls where the gap opens more steeply.
            change = -self._by_weights(high, full)[1] * _ahead(high, self.fullness)
            near = faces.near + change * steepness.opening_by_node
            faces = replace(faces, near=near, ahead=faces.ahead + change * steepness.opening_by_next)
        return faces.difference(mesh)

    def _weights(self, high: Mask) -> tuple[Array, Array]:
        """Weights (nx - 1, ny) of the node before and of the node behind each face."""
        ahead = _ahead(high, self.fullness)
        if self.steepness is not None and self.scheme.continuous:
            ahead = ahead * (1.0 - self.steepness.opening)
        return _before(high, self.fullness), ahead

    def _by_weights(self, high: Mask, mass: Array) -> tuple[Array, Array]:
        """Derivatives of the mass at the faces (nx - 1, ny) by both weights."""
        before, ahead = self._weights(high)
        by_before, by_ahead = (
            Faces.weighted(1.0, ahead, self.order)(mass) - Faces.weighted(0.0, ahead, self.order)(mass),
            Faces.weighted(before, 1.0, self.order)(mass) - Faces.weighted(before, 0.0, self.order)(mass),
        )
        if self.steepness is None:
            return by_before, by_ahead
        part = np.where(high, self.steepness.part, 0.0)[:-1]
        mean = 0.0 if self.scheme.first_order else 0.5 * np.diff(mass, axis=0)
        return (1.0 - part) * by_before, (1.0 - part) * by_ahead + part * mean

    def by_fullness(self, mesh: Mesh, filled: Mask, mass: Array) -> Stencil | None:
        """Derivative of the wedge term by the pressure that decides how full nodes are; None without it.

        ``mass`` (nx, ny) is the mass rho H of filled nodes, zero where the gap is cavitated.
        """
        if self.fullness is None or self.order == 1:
            return None
        high = filled & ~np.asarray(self.upwind)
        by_before, by_ahead = self._by_weights(high, mass)
        if self.steepness is not None:
            by_ahead = by_ahead * (1.0 - self.steepness.opening)
        weight, slope = self.fullness.weight * high, self.fullness.slope * high
        far = np.zeros_like(by_before)
        far[1:] = by_before[1:] * slope[:-2] * high[1:-1]
        near, ahead = by_ahead * slope[:-1] * weight[1:], by_ahead * weight[:-1] * slope[1:]
        return Faces(far, near, ahead).difference(mesh)

    @property
    def of_full_order(self) -> Supply:
        """Supply whose nodes all enter formulas of a higher order."""
        return replace(self, upwind=False, steepness=None, fullness=None)

    def at_gap(self, full: Array) -> Supply:
        """Supply with the steepness of a gap whose mass rho H is ``full`` (nx, ny)."""
        return replace(self, steepness=Steepness.of(full))

    def at_state(self, excess: Array, full: Array, poiseuille: Array, rate: float) -> Supply:
        """Supply with the fullness of the nodes at an excess pressure, as in ``Fullness.of``."""
        if not self.scheme.continuous:
            return self
        return replace(self, fullness=Fullness.of(excess, full, poiseuille, rate))

    def at_rupture(self, filled: Mask, mass: Array) -> Array:
        """Mass of oil (nx, ny) from the flow out of cavitated nodes, whose first one has a higher order.

        Behind a filled node the flow is 3/2 m of the node minus 1/2 m of the node before, as if oil filled
        the node. One whose content is below the full gap thus would be under tension as a filled one, and the
        iteration cannot oscillate there.
        """
        if self.order == 1:
            return mass
        not_upwind = ~np.asarray(self.upwind)
        high = ~filled & not_upwind
        high[:2] = False
        high[1:] &= (filled & not_upwind)[:-1]
        before: Array = np.concatenate([mass[:1], mass[:-1]])
        part: Array = high * (1.0 if self.steepness is None else 1.0 - self.steepness.part)
        if self.fullness is not None:
            part[1:] *= self.fullness.weight[:-1]
        return mass + part / (2.0 + part) * (before - mass)

    def injected(self, level: Level) -> Supply:
        """Supply on the next coarser grid, for its wedge term only."""
        upwind, steepness = self.upwind, self.steepness
        if not isinstance(upwind, bool):
            upwind = level.inject(upwind.astype(float)) > 0.0
        if steepness is not None:
            steepness = steepness.injected(level)
        fullness = None if self.fullness is None else self.fullness.injected(level)
        return replace(self, upwind=upwind, steepness=steepness, fullness=fullness)


@dataclass(frozen=True)
class Runs:
    """Runs of successive cavitated nodes along entrainment."""

    cavitated: Mask  # nodes of the runs, shape (nx, ny)
    # Index along x of the last filled node up to each node, or -1 where there is none, shape (nx, ny).
    before: Array

    @classmethod
    def of(cls, filled: Mask) -> Runs:
        """Runs of the nodes that are not filled, a mask (nx, ny)."""
        number = np.arange(len(filled))[:, np.newaxis]
        return cls(~filled, np.maximum.accumulate(np.where(filled, number, -1), axis=0))

    def summed(self, values: Array) -> Array:
        """Sum of values (nx, ny) over the run of each cavitated node up to the node, zero at filled nodes.

        Examples
        --------
        >>> filled = np.array([[False], [False], [True], [False], [False]])
        >>> Runs.of(filled).summed(np.array([[1.0], [2.0], [4.0], [8.0], [16.0]]))[:, 0].tolist()
        [1.0, 3.0, 0.0, 8.0, 24.0]
        """
        total = np.cumsum(np.where(self.cavitated, values, 0.0), axis=0)
        first = np.take_along_axis(total, np.maximum(self.before, 0), axis=0)
        return np.where(self.cavitated, total - np.where(self.before < 0, 0.0, first), 0.0)

    def reduced(self, rows: Array) -> Array:
        """Rows (nx, ny) with the rows of the run before each node added; only rows of filled nodes count.

        Examples
        --------
        >>> filled = np.array([[False], [False], [True], [True]])
        >>> Runs.of(filled).reduced(np.array([[1.0], [2.0], [4.0], [8.0]]))[2:, 0].tolist()
        [7.0, 8.0]
        """
        reduced = rows.copy()
        reduced[1:] += self.summed(rows)[:-1]
        return reduced


@dataclass(frozen=True)
class Faces:
    """Weights of the mass of three nodes in the mass at the downstream face of each node except the last."""

    # far, near and ahead: of the node before, of the node and of the one behind the face, (nx - 1, ny).
    far: Array
    near: Array
    ahead: Array

    @classmethod
    def weighted(cls, before: Array | float, ahead: Array | float, order: int) -> Faces:
        """Formula for weights, 0 to 1, of the node before and of the node and the one behind the face.

        Both at 1 give the formula of ``order``, and both at 0 the upwind formula.
        """
        before, ahead = np.broadcast_arrays(np.asarray(before, dtype=float), np.asarray(ahead, dtype=float))
        if order == 1:
            return cls(0.0 * before, 1.0 + 0.0 * before, 0.0 * before)
        alone = (1.0 - before) * ahead
        far, near, behind = -0.5 * before, 1.0 + 0.5 * before - 0.5 * alone, 0.5 * alone
        if order == 3:
            third = before * ahead
            far, near, behind = far + 0.375 * third, near - 0.75 * third, behind + 0.375 * third
        return cls(far, near, behind)

    def steep(self, filled: Mask, steepness: Steepness, full: Array | None, ahead: Array) -> Faces:
        """Weights where the gap closes steeply; with ``full`` the weights of the derivatives by the mass.

        ``ahead`` (nx - 1, ny) is the weight of the node behind the face there.
        """
        part = np.where(filled, steepness.part, 0.0)[:-1]
        off = Faces(-self.far, 1.0 - ahead - self.near, ahead - self.ahead)
        far, near, ahead = (
            self.far + part * off.far,
            self.near + part * off.near,
            self.ahead + part * off.ahead,
        )
        if full is not None:
            change = np.where(filled[:-1], off(full), 0.0)
            far, near = far + change * steepness.by_before[:-1], near + change * steepness.by_node[:-1]
        return Faces(far, near, ahead)

    def __call__(self, mass: Array) -> Array:
        """Mass (nx - 1, ny) at the faces from the mass at the nodes (nx, ny)."""
        before: Array = np.concatenate([mass[:1], mass[:-2]])
        return self.far * before + self.near * mass[:-1] + self.ahead * mass[1:]

    def difference(self, mesh: Mesh) -> Stencil:
        """Upstream difference d/dX of the mass at the faces; the end rows are zero.

        Examples
        --------
        The mass at the two last faces is extrapolated from the two nodes before:

        >>> filled = np.array([[False], [True], [True], [True], [True]])
        >>> faces = Faces.weighted(_before(filled, None), _ahead(filled, None), 2)
        >>> faces.difference(Mesh.over(5, 0.0, 4.0)).coefficients[:, 3, 0].tolist()
        [0.5, -2.0, 1.5, 0.0]
        """
        c = np.zeros((ALONG, *mesh.shape))
        c[0, 1:-1] = -self.far[:-1]
        c[1, 1:-1] = self.far[1:] - self.near[:-1]
        c[2, 1:-1] = self.near[1:] - self.ahead[:-1]
        c[3, 1:-1] = self.ahead[1:]
        return Stencil(c / mesh.dx)


def _before(high: Mask, fullness: Fullness | None) -> Array:
    """Weight (nx - 1, ny) of the node before the node upstream of each face."""
    weight = np.zeros((high.shape[0] - 1, high.shape[1]))
    weight[1:] = (high[1:-1] & high[:-2]) * (1.0 if fullness is None else fullness.weight[:-2])
    return weight


def _ahead(high: Mask, fullness: Fullness | None) -> Array:
    """Weight (nx - 1, ny) of the two nodes next to each face."""
    both: Array = (high[:-1] & high[1:]).astype(float)
    return both if fullness is None else both * fullness.weight[:-1] * fullness.weight[1:]


def of_filled(flow: Flow, filled: Mask) -> Flow:
    """Flow whose density is zero where the film is not filled, so that only filled nodes have mass."""
    k = flow.coefficients
    density, density_p = (np.where(filled, values, 0.0) for values in (k.density, k.density_p))
    flow = replace(flow, coefficients=replace(k, density=density, density_p=density_p))
    return flow.undrifted(~filled)


def unreduced(level: Level, flow: Flow, thickness: Array, filled: Mask, supply: Supply) -> Array:
    """Rows of the Reynolds equation without the masses of cavitated nodes, shape (nx, ny).

    The row of a cavitated node at the inlet edge is the layer of oil that enters there, over -dX.
    """
    wedge = supply.wedge(level.mesh, filled)
    rows = residual(of_filled(flow, filled), wedge, thickness, level.mesh) - level.source
    rows[0] = np.where(filled[0], 0.0, -supply.mass / level.mesh.dx)
    return rows


def content(runs: Runs, rows: Array, full: Array, dx: float) -> Array:
    """Mass of oil that the surfaces carry out of each node (nx, ny): the mass of the full gap at filled
    nodes.

    ``rows`` (nx, ny) are the rows of the Reynolds equation without the masses of cavitated nodes, as
    ``unreduced`` returns them; ``full`` (nx, ny) is the mass that a full gap carries.

    Examples
    --------
    A layer is carried to the first filled node, to which no pressure drives oil:

    >>> runs = Runs.of(np.array([[False], [False], [True]]))
    >>> content(runs, np.array([[-0.2], [0.0], [0.0]]), np.ones((3, 1)), 0.5)[:, 0].tolist()
    [0.1, 0.1, 1.0]
    """
    return np.where(runs.cavitated, -dx * runs.summed(rows), full)


def behind_cavities(filled: Mask) -> Mask:
    """Mask of the filled nodes (nx, ny) whose node before is not filled."""
    behind = filled.copy()
    behind[1:] &= ~filled[:-1]
    behind[0] = False
    return behind


def with_row_before(stencil: Stencil, rows: Mask) -> Stencil:
    """Stencil to whose ``rows`` (nx, ny) the row of the node before is added.

    A neighbour of the node before is one step further upstream; the one three steps upstream and those across
    entrainment are neglected.
    """
    c = stencil.coefficients.copy()
    for row in range(3):
        c[row, 1:] += np.where(rows[1:], stencil.coefficients[row + 1, :-1], 0.0)
    return Stencil(c)


# Excess of the content over the full gap, relative, and pressure below ambient over p_h, that are rounding.
OVERFLOW, TENSION = 1e-10, 1e-13


class MaskMemory:
    """Masks of filled nodes that an iteration has had, to detect cycles.

    The order of the wedge term depends on the nodes that are filled. It may happen that a node overflows as a
    cavitated node and is under tension as a filled one. With the upwind difference on both sides this is
    impossible, so that the nodes that change in a circle get it for the rest of the iteration. Circles of
    several nodes may take long to meet in a known mask: a node that changes more than ``most_changes`` times
    counts as one that goes in a circle.
    """

    def __init__(self, most_changes: float = np.inf) -> None:
        self._most_changes, self._masks = most_changes, set[bytes]()
        self._changes: Array | int = 0  # number of changes of each node, shape (nx, ny)

    def supply_after(self, supply: Supply, filled: Mask, moved: Mask) -> Supply:
        """Supply with an upwind difference at the nodes that go in circles, the last change included."""
        key, changed = np.packbits(moved).tobytes(), filled != moved
        self._changes = self._changes + changed
        circling = changed
        if key not in self._masks:
            circling = changed & (self._changes > self._most_changes)
        if circling.any():
            supply = replace(supply, upwind=supply.upwind | circling)
        self._masks.add(key)
        return supply


@dataclass(frozen=True)
class Carried:
    """Oil that is carried through cavities of a stationary film."""

    supply: Supply  # oil at the inlet edge and order of the wedge term
    filled: Mask  # nodes that oil fills, with the nodes of the inlet edge, shape (nx, ny)
    # Mass of oil that the surfaces carry out of each node, theta times the mass of the full gap, shape (nx,
    # ny).
    mass: Array = field(default_factory=lambda: np.zeros((1, 1)))

    @property
    def hollow(self) -> Mask:
        """Cavitated nodes (nx, ny) from which oil flows to a filled node on their line."""
        ahead = np.logical_or.accumulate(self.filled[::-1], axis=0)[::-1]
        return ~self.filled & ahead

    def fraction(self, full: Array) -> Array:
        """Part theta of the gap that oil fills, from the mass that a full gap carries, both (nx, ny)."""
        return np.where(self.filled, 1.0, np.clip(self.mass / full, 0.0, 1.0))

    def on(self, level: Level) -> Carried:
        """Filled nodes and supply on the next coarser grid, for its equations only."""
        return Carried(self.supply.injected(level), level.inside(self.filled))


def filled_anew(
    level: Level, at_faces: Flow, thickness: Array, poiseuille: Array, excess: Array, carried: Carried
) -> tuple[Carried, Array]:
    """Oil carried with the nodes that it fills at a state, and the rows (nx, ny) of the filled nodes."""
    full = at_faces.carried(thickness, level.mesh.dx)
    r, mass = carried_rows(level, at_faces, thickness, carried)
    surplus = ((1.0 + OVERFLOW) * full - mass) / level.mesh.dx
    moved = full_film_nodes(
        excess + TENSION * carried.filled,
        np.where(carried.filled, r, surplus),
        poiseuille=poiseuille,
        rate=level.rate,
        thickness=thickness,
        inner=level.mesh.inner,
    )
    moved |= _backed_up(carried.filled, mass, full) & level.mesh.inner
    moved[0] = carried.supply.mass >= full[0]
    if not np.array_equal(moved, carried.filled):
        carried = replace(carried, filled=moved)
        r, mass = carried_rows(level, at_faces, thickness, carried)
    return replace(carried, mass=mass), r


def _backed_up(filled: Mask, mass: Array, full: Array) -> Mask:
    """Cavitated nodes upstream of an overflow that the surplus of its mass fills.

    The backflow from a filled node overflows the node before it only. The nodes before that one would be
    filled one by one.
    """
    over = ~filled & (mass > full)
    backed = np.zeros_like(over)
    if not over.any():
        return backed
    surplus = np.zeros(over.shape[1])
    for i in range(len(over) - 1, 0, -1):
        surplus = np.where(filled[i], 0.0, np.maximum(surplus, 0.0) + mass[i] - full[i])
        backed[i] = surplus > 0.0
    return backed


def carried_rows(level: Level, at_faces: Flow, thickness: Array, carried: Carried) -> tuple[Array, Array]:
    """Rows of the filled nodes, zero elsewhere, and the mass that the surfaces carry, both (nx, ny)."""
    runs, filled = Runs.of(carried.filled), carried.filled
    rows = unreduced(level, at_faces, thickness, filled, carried.supply)
    full = at_faces.carried(thickness, level.mesh.dx)
    mass = carried.supply.at_rupture(filled, content(runs, rows, full, level.mesh.dx))
    return np.where(filled & level.mesh.inner, runs.reduced(rows), 0.0), mass
