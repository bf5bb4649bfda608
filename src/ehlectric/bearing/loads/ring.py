"""Equilibrium of a ring on its rolling elements, by Newton's method on a convex energy.

The elastic energy of the elements is a convex function of the ring's displacement. Its gradient is the force
of the elements against the displacement, and is continuous. The energy is constant where the ring moves in
its clearance. It is also flat across the load where a single element carries the load. Each Newton step is
therefore limited in length. A step is judged by the force along it, not by the energy: near convergence the
energy does not change even in its last digit.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields, replace
from typing import Any, Generic, Self, TypeAlias, TypeVar

import numpy as np

from ehlectric.arrays import Array, Booleans, IntArray, Mask, Numbers
from ehlectric.bearing.loads.geometry import BallBearing, FourPointBearing, RollerBearing, Speeds
from ehlectric.errors import ConvergenceError, InputError

# Force of the elements against displacements of the ring, shape (m, k), and its derivative by the
# displacement, shape (m, k, k). The second argument says which of the points of operation they belong to.
Reaction: TypeAlias = Callable[[Array, IntArray], tuple[Array, Array]]

# Relative residual at which the iteration ends, and the one accepted where rounding prevents the first.
AIM, GOOD = 1e-12, 1e-9
_MOST_STEPS = 200
_MOST_TRIALS = 60

# A step that overshoots is shortened until the force against it is at most this part of the force along it
# at its start.
_OVERSHOOT = 0.5

# Stiffness below this part of the largest one counts as zero: only the reach limits the step there.
_FLAT = 1e-13


@dataclass(frozen=True)
class RingLoads:
    """Contacts of all elements with one ring in equilibrium; arrays have the shape (..., elements)."""

    load: Array  # load of each contact [N]
    angle: Array  # contact angle of each element [rad]; negative in a second row
    approach: Array  # elastic approach of element and ring in the contact [m]; 0 where they do not touch
    gap: Array  # distance between element and ring [m]; 0 where they touch
    entrainment_speed: Array  # entrainment speed in pure rolling [m/s]


@dataclass(frozen=True)
class BearingEquilibrium:
    """Bearing in equilibrium, at one or many points of operation.

    Arrays have one value per element, shape (..., elements), and numbers of the bearing the shape (...),
    unless stated. Points that the bearing cannot carry are NaN; see ``balanced``.
    """

    position: Array  # angle of the element from the direction of the radial load [rad]
    # inner_load and outer_load: load of both contacts [N].
    inner_load: Array
    outer_load: Array
    # inner_approach and outer_approach: elastic approach of ring and element, of a roller at its middle [m];
    # 0 where they do not touch.
    inner_approach: Array
    outer_approach: Array
    # inner_gap and outer_gap: smallest distance between the raceway and the element, of a roller at its
    # middle [m]; 0 where they touch.
    inner_gap: Array
    outer_gap: Array
    # Speeds of cage, elements and contacts in pure rolling; of each ball at the mean of its two contact
    # angles.
    speeds: Speeds
    # Centrifugal force on each element at the speed of the cage [N].
    centrifugal_force: Numbers
    # radial_displacement and lateral_displacement: displacement of the inner ring along the radial load, and
    # towards the angle of 90 deg [m].
    radial_displacement: Numbers
    lateral_displacement: Numbers
    # Largest unbalanced force on ring or element over the sum of load and centrifugal force, dimensionless;
    # NaN where the bearing cannot carry the load.
    residual: Numbers
    iterations: Numbers  # number of Newton steps for the ring

    @property
    def balanced(self) -> Booleans:
        """Whether all forces balance, with the stiffnesses of the contacts at their own contact angles."""
        return self.residual <= GOOD

    def at(self, index: Any) -> Self:
        """Equilibrium at some of the points of operation, or at a single one.

        ``index`` is an index of arrays of shape (...). A single point has floats, and arrays of shape
        (elements,).
        """
        values = {name: _at(value, index) for name, value in vars(self).items() if name != "speeds"}
        speeds = Speeds(**{name: _at(value, index) for name, value in vars(self.speeds).items()})
        return replace(self, speeds=speeds, **values)

    def ring(self, *, inner: bool) -> RingLoads:
        """Contacts of all elements with the inner or the outer ring."""
        side, values = "inner" if inner else "outer", vars(self)
        load = values[f"{side}_load"]
        angle = values.get(f"{side}_angle", np.zeros_like(load))
        speed = np.asarray(getattr(values["speeds"], f"{side}_entrainment"))
        # All rollers have the same speed.
        speed = np.broadcast_to(speed if speed.ndim == load.ndim else speed[..., np.newaxis], load.shape)
        return RingLoads(load, angle, values[f"{side}_approach"], values[f"{side}_gap"], speed)


def _at(value: Any, index: Any) -> Any:
    """Values at an index over points of operation, as a plain number where there is a single one."""
    chosen = value[index]
    return chosen.item() if np.ndim(chosen) == 0 else chosen


def refuse_unbalanced(residual: Numbers, elements: str) -> None:
    """Raise ConvergenceError for a single bearing whose forces on ring and ``elements`` do not balance.

    ``residual`` is the largest unbalanced force over the load, dimensionless; arrays are not refused.
    """
    if np.ndim(residual) == 0 and not residual <= GOOD:
        raise ConvergenceError(f"forces on ring and {elements}, balanced only to {residual:.1e} of the load")


@dataclass(frozen=True, kw_only=True)
class Operation:
    """Loads on a bearing, speeds of its rings, and the position of its cage.

    All are floats, or arrays of shape (...) that broadcast. Raises InputError where a radial load that is a
    single number is negative, or there is no load: then the position of the ring is arbitrary. Such points of
    arrays are not ``loaded``.
    """

    radial_load: Numbers  # radial load on the inner ring, towards the angle 0 [N]
    axial_load: Numbers = 0.0  # axial load on the inner ring, towards positive axial positions [N]
    # inner_speed and outer_speed: angular speeds of the rings [rad/s].
    inner_speed: Numbers = 0.0
    outer_speed: Numbers = 0.0
    cage_angle: Numbers = 0.0  # angle of the first element from the direction of the radial load [rad]

    def __post_init__(self) -> None:
        if np.ndim(self.radial_load) == 0 and self.radial_load < 0.0:
            raise InputError("radial_load", got=f"{self.radial_load:g} N", takes="0 or more")
        if np.ndim(self.loaded) == 0 and self.radial_load == 0.0 and self.axial_load == 0.0:
            raise InputError(
                "radial_load, axial_load", "both are 0", takes="a load: without one no element bears any"
            )

    @property
    def loaded(self) -> Mask:
        """Whether there is a load, and no negative radial one, shape (...)."""
        radial, axial = np.asarray(self.radial_load), np.asarray(self.axial_load)
        return np.asarray((radial >= 0.0) & ((radial > 0.0) | (axial != 0.0)))

    def positions(self, elements: int, rows: int = 1) -> Array:
        """Angle of each element from the direction of the radial load, shape (..., rows elements) [rad].

        All rows have the same angles, the first row first.
        """
        cage = np.asarray(self.cage_angle)[..., np.newaxis]
        return np.asarray(cage + np.tile(2.0 * np.pi * np.arange(elements) / elements, rows))


T = TypeVar("T")
G = TypeVar("G", BallBearing, FourPointBearing, RollerBearing)


@dataclass(frozen=True)
class Batch(Generic[G]):
    """Bearings and operations of all points that can be solved, in one row.

    Numbers are floats, or arrays of shape (n,) with n points.
    """

    shape: tuple[int, ...]  # shape (...) of the points
    able: Mask  # which of the points can be solved, shape (...)
    bearing: G
    operation: Operation
    modulus: Numbers  # reduced modulus E' [Pa]
    density: Numbers  # [kg/m^3]
    position: Array  # angles of the elements of all points, shape (..., elements) [rad]

    @classmethod
    def of(
        cls, bearing: G, operation: Operation, modulus: Numbers, density: Numbers, able: Booleans
    ) -> Batch[G]:
        """Batch of numbers of shape (...). ``able``: where the bearing can carry the load; points with a
        number that is not finite are also skipped.
        """
        numbers = (*bearing.dimensions, *vars(operation).values(), modulus, density)
        shape: tuple[int, ...] = np.broadcast_shapes(*map(np.shape, numbers))
        solvable = np.array(np.broadcast_to(able & operation.loaded, shape))
        for number in numbers:
            solvable &= np.isfinite(number)

        def row(number: Any) -> Any:
            return number if np.ndim(number) == 0 else np.broadcast_to(number, shape)[solvable]

        def rowed(thing: Any) -> Any:
            arrays = {name: row(value) for name, value in vars(thing).items() if np.ndim(value)}
            return replace(thing, **arrays) if arrays else thing

        position = operation.positions(bearing.elements, bearing.rows.number)
        return cls(
            shape=shape,
            able=solvable,
            bearing=rowed(replace(bearing, rows=rowed(bearing.rows))),
            operation=rowed(operation),
            modulus=row(modulus),
            density=row(density),
            position=np.array(np.broadcast_to(position, (*shape, position.shape[-1]))),
        )

    @property
    def number(self) -> int:
        """Number of points that can be solved."""
        return int(np.count_nonzero(self.able))

    @property
    def rows(self) -> Array:
        """Angle of each element, shape (elements, n), or (elements, 1) where they are equal [rad]."""
        rows = self.bearing.rows
        return np.atleast_2d(self.operation.positions(self.bearing.elements, rows.number)).T

    @property
    def signs(self) -> Array:
        """Sign of the axial loads that each element carries, shape (elements, 1)."""
        return np.repeat(self.bearing.rows.signs, self.bearing.elements)[:, np.newaxis]

    def spread(self, values: Array | IntArray) -> Any:
        """Values of shape (elements, n) or (n,) as an array of shape (..., elements) or (...).

        They are NaN where a point was not solved. A single number is a float or an int.
        """
        return self.spread_rows(np.moveaxis(values, -1, 0))

    def spread_rows(self, rows: Array | IntArray) -> Any:
        """Reshape the rows of all points, shape (n, ...), to the shape of the points and a row."""
        values: Any = rows
        if not self.able.all():
            values = np.full((self.able.size, *rows.shape[1:]), np.nan)
            values[self.able.ravel()] = rows
        values = np.ascontiguousarray(values).reshape(self.shape + rows.shape[1:])
        return values.item() if values.ndim == 0 else values


def chosen(thing: T, points: slice | Mask | IntArray) -> T:
    """Same class with some of the points, the last dimension of its arrays; a dimension of 1 is for all."""
    values = (getattr(thing, each.name) for each in fields(thing))  # type: ignore[arg-type]
    return type(thing)(*(value if value.shape[-1] == 1 else value[..., points] for value in values))


def joined(parts: Sequence[T]) -> T:
    """Same class with the points of all parts, along the last dimension of its arrays."""
    columns = zip(*(vars(each).values() for each in parts), strict=True)
    return type(parts[0])(*(np.concatenate(values, axis=-1) for values in columns))


def direction(missing: Array, tangent: Array, reach: Array) -> Array:
    """Newton steps whose components along the eigenvectors of the tangents are limited to ``reach``.

    ``missing``, shape (m, k); ``tangent``, shape (m, k, k); ``reach``, shape (m,).
    """
    values, vectors = np.linalg.eigh(tangent)
    part = np.einsum("mij,mi->mj", vectors, missing)
    stiffness = np.maximum(values, _FLAT * np.maximum(values[:, -1:], 0.0))
    # This stiffness limits the step to the reach, also in directions without stiffness.
    softest = np.maximum(np.abs(part) / reach[:, np.newaxis], np.finfo(float).tiny)
    return np.asarray(np.einsum("mij,mj->mi", vectors, part / np.maximum(stiffness, softest)))


def _shortened(
    reaction: Reaction, points: IntArray, load: Array, position: Array, step: Array, slope: Array
) -> tuple[Array, Array, Array, Mask]:
    """Positions after shortened steps, forces and tangents there, and whether longer ones may be tried."""
    there = position + step
    force, tangent = reaction(there, points)
    now = np.einsum("mi,mi->m", load - force, step)
    free = now > _OVERSHOOT * slope
    part, over = np.ones_like(slope), np.flatnonzero(now < -_OVERSHOOT * slope)
    for _ in range(_MOST_TRIALS):
        if not over.size:
            break
        # Linear interpolation to zero force along the step; 0.02 keeps the step from becoming too small.
        part[over] *= np.maximum(slope[over] / (slope[over] - now[over]), 0.02)
        there[over] = position[over] + part[over, np.newaxis] * step[over]
        force[over], tangent[over] = reaction(there[over], points[over])
        now[over] = np.einsum("mi,mi->m", load[over] - force[over], step[over])
        over = over[now[over] < -_OVERSHOOT * slope[over]]
    return there, force, tangent, free


def balance(
    reaction: Reaction,
    load: Array,
    start: Array,
    reach: Numbers,
    scale: Numbers,
    aim: Numbers = AIM,
) -> tuple[Array, Array, IntArray]:
    """Displacements of rings at which the forces of their elements balance their loads.

    ``reaction``, force and tangent over displacements [m], shape (m, k), of the points with the indices that
    are its second argument, shape (m,); ``load`` [N], shape (n, k); ``start``, initial guess of the
    displacement [m], shape (n, k); ``reach``, largest component of the first step [m], which grows where the
    ring moves freely; ``scale``, force that the residual is relative to [N]; ``aim``, residual at which the
    iteration ends; these three are floats or arrays of shape (n,). Returns ``position``, displacement [m],
    shape (n, k); ``residual``, largest component of the imbalance over ``scale``, which is above ``GOOD``
    without convergence; ``iterations``, number of Newton steps; shape (n,).

    Examples
    --------
    Two rings touch a spring after 1 mm, F = k (x - 1 mm)^(3/2):

    >>> def spring(x, points):
    ...     depth = np.maximum(0.0, x - 1e-3)
    ...     return 1e10 * depth**1.5, 1.5e10 * depth[:, :, np.newaxis] ** 0.5
    >>> load = np.array([[1e4], [8e4]])
    >>> position, residual, _ = balance(spring, load, np.zeros((2, 1)), 1e-4, 1e4)
    >>> (position[:, 0] * 1e3).round(6).tolist(), bool(np.all(residual < 1e-12))
    ([1.1, 1.4], True)
    """
    number = len(load)
    reach, scale, aim = (np.array(np.broadcast_to(value, (number,))) for value in (reach, scale, aim))
    best, least = np.array(start, dtype=float), np.full(number, np.inf)
    idle, iterations = np.zeros(number, dtype=np.intp), np.zeros(number, dtype=np.intp)
    points, position = np.arange(number), best.copy()
    force, tangent = reaction(position, points)
    for _ in range(_MOST_STEPS):
        missing = load[points] - force
        residual = np.max(np.abs(missing), axis=1) / scale[points]
        # Rounding limits the residual: below GOOD, two steps without improvement end the iteration.
        idle[points] = np.where(residual > 0.5 * least[points], idle[points] + 1, 0)
        better = residual < least[points]
        best[points[better]], least[points[better]] = position[better], residual[better]
        going = ~((least <= aim) | ((least <= GOOD) & (idle >= 2)))[points]
        if not going.any():
            break
        points, position, missing = points[going], position[going], missing[going]
        step = direction(missing, tangent[going], reach[points])
        slope = np.einsum("mi,mi->m", missing, step)
        position, force, tangent, free = _shortened(reaction, points, load[points], position, step, slope)
        reach[points[free]] *= 2.0
        iterations[points] += 1
    return best, least, iterations
