"""Totals of a bearing in equilibrium: displacements, moments, inertial forces and speeds. SI units."""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from typing import Any, TypeAlias

import numpy as np

from ehlectric.arrays import Array, IntArray, Numbers, as_float
from ehlectric.bearing.loads.ball_loads import BallEquilibrium
from ehlectric.bearing.loads.geometry import Speeds
from ehlectric.bearing.loads.ring import refuse_unbalanced
from ehlectric.bearing.loads.roller_loads import RollerEquilibrium

Equilibrium: TypeAlias = BallEquilibrium | RollerEquilibrium


# Fields of equilibria with a value per element, and fields with a value per slice of each element.
_SIDES = ("inner", "outer")
_OF_ELEMENTS = {f"{side}_{name}" for side in _SIDES for name in ("load", "angle", "approach", "gap")}
_OF_ELEMENTS |= {"gyroscopic_moment"}
_OF_SLICES = {f"{side}_line_load" for side in _SIDES}


def mirrored(at: Equilibrium, position: Array, rows: int = 1) -> Equilibrium:
    """Equilibrium with the cage at the opposite angle, mirrored about the plane through axis and radial load.

    ``position`` are the angles of the elements, with the cage at the pitch less its angle [rad], shape
    (..., elements), all ``rows`` one after the other.
    """
    values, turn = vars(at), mirrored_order(at.position.shape[-1], rows)
    turned = {name: values[name][..., turn] for name in _OF_ELEMENTS & values.keys()}
    turned |= {name: values[name][..., turn, :] for name in _OF_SLICES & values.keys()}
    lateral = {name: -values[name] for name in values if name.startswith("lateral_")}
    # The speeds of balls have a value per element; all rollers have the same ones.
    per_element = np.ndim(at.speeds.cage) == at.position.ndim
    speeds = Speeds(*(speed[..., turn] for speed in vars(at.speeds).values())) if per_element else at.speeds
    return dataclasses.replace(
        at, position=np.broadcast_to(position, at.position.shape), speeds=speeds, **turned, **lateral
    )


def mirrored_order(number: int, rows: int = 1) -> IntArray:
    """Places of the elements in the order that a mirrored position has: each row has its last one first.

    Examples
    --------
    >>> mirrored_order(6, 2).tolist()
    [2, 1, 0, 5, 4, 3]
    """
    return np.arange(number).reshape(rows, -1)[:, ::-1].ravel()


def around_in_rows(positions: Sequence[Array], rows: int) -> tuple[Array, IntArray]:
    """Angles of all elements at several positions of the cage from 0 to 2 pi, and the order in which the
    angles of each row ascend, all rows one after the other.

    ``positions``, angles of the elements of all ``rows``, one row after the other, at each position of the
    cage [rad], shape (elements,) each. The shape of both is (positions elements,).

    Examples
    --------
    >>> angle, order = around_in_rows([np.array([0.0, 3.0]), np.array([1.0, 4.0])], 1)
    >>> angle[order].tolist()
    [0.0, 1.0, 3.0, 4.0]
    """
    angle = np.mod(np.concatenate(positions), 2.0 * np.pi)
    row = np.tile(np.repeat(np.arange(rows), len(positions[0]) // rows), len(positions))
    return angle, np.lexsort((angle, row))


def check_balance(at: Equilibrium) -> None:
    """Refuse an equilibrium of a single bearing whose forces do not balance. Raises ConvergenceError."""
    refuse_unbalanced(at.residual, "balls" if isinstance(at, BallEquilibrium) else "rollers")


def mechanics_of(at: Equilibrium) -> dict[str, Any]:
    """Loads, displacements and speeds of a bearing, by the keys of ``mechanics`` in summary.json. Returns
    values in SI units, of shape (...); None for the values that roller bearings do not have.

    Examples
    --------
    Rollers of 11 mm on a pitch diameter of 60 mm, g = 11/60, with the inner ring at 100 rad/s. The cage turns
    at 50 (1 - g), and the rollers turn at 50 (1 - g^2)/g relative to it.

    >>> from ehlectric.bearing.loads.geometry import RollerBearing
    >>> from ehlectric.bearing.loads.ring import Operation
    >>> from ehlectric.bearing.loads.roller_loads import roller_equilibrium
    >>> bearing = RollerBearing(14, 11e-3, 60e-3, 11e-3, 0.0, "none")
    >>> state = roller_equilibrium(bearing, Operation(radial_load=5000.0, inner_speed=100.0), 226e9, 7800.0)
    >>> mechanics = mechanics_of(state)
    >>> round(mechanics["cage_speed"], 3), round(mechanics["element_speed"], 3)
    (40.833, 263.561)
    """
    inner, outer = (_largest(at.ring(inner=inner).entrainment_speed) for inner in (True, False))
    spin = np.asarray(at.speeds.spin)
    return {
        "max_load": _largest(at.outer_load),
        "radial_displacement": at.radial_displacement,
        "axial_displacement": at.axial_displacement if at.holds_axially else None,
        "moment": at.moment,
        "centrifugal_force": at.centrifugal_force,
        "gyroscopic_moment": None if at.gyroscopic_moment is None else _largest(at.gyroscopic_moment),
        "cage_speed": at.cage_speed,
        # All rollers have the same speed.
        "element_speed": _largest(spin) if spin.ndim == at.position.ndim else as_float(spin),
        "entrainment_speed": inner,
        "entrainment_speed_inner": inner,
        "entrainment_speed_outer": outer,
        "residual": at.residual,
    }


def _largest(values: Array) -> Numbers:
    """Largest value over the elements, shape (...)."""
    return as_float(np.max(values, axis=-1))
