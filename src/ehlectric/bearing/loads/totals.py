"""Totals of a bearing in equilibrium: displacements, moments, inertial forces and speeds. SI units."""

from __future__ import annotations

import dataclasses
from typing import Any, TypeAlias

import numpy as np

from ehlectric.arrays import Array
from ehlectric.bearing.loads.ball_loads import BallEquilibrium
from ehlectric.bearing.loads.geometry import Speeds
from ehlectric.bearing.loads.roller_loads import RollerEquilibrium

Equilibrium: TypeAlias = BallEquilibrium | RollerEquilibrium


# Fields of equilibria with a row per element.
_OF_ELEMENTS = frozenset(
    f"{ring}_{quantity}"
    for ring in ("inner", "outer")
    for quantity in ("load", "line_load", "angle", "approach", "gap")
) | {"gyroscopic_moment"}


def mirrored(at: Equilibrium, position: Array) -> Equilibrium:
    """Equilibrium with the cage at the opposite angle, mirrored about the plane through axis and radial load.

    ``position`` are the angles of the elements, with the cage at the pitch less its angle [rad], shape (n,).
    """
    values = vars(at)
    turned = {name: values[name][::-1] for name in _OF_ELEMENTS & values.keys()}
    lateral = {name: -values[name] for name in values if name.startswith("lateral_")}
    # The speeds of balls are arrays; all rollers have the same ones.
    speeds = Speeds(*(speed[::-1] if np.ndim(speed) else speed for speed in vars(at.speeds).values()))
    return dataclasses.replace(at, position=position, speeds=speeds, **turned, **lateral)


def mechanics_of(at: Equilibrium) -> dict[str, Any]:
    """Loads, displacements and speeds of a bearing, by the keys of ``mechanics`` in summary.json. Returns
    values in SI units; None for the values that roller bearings do not have.

    Examples
    --------
    Rollers of 11 mm on a pitch diameter of 60 mm, g = 11/60, with the inner ring at 100 rad/s. The cage turns
    at 50 (1 - g), and the rollers turn at 50 (1 - g^2)/g relative to it.

    >>> from ehlectric.bearing.loads.geometry import RollerBearing
    >>> from ehlectric.bearing.loads.ring import Operation
    >>> from ehlectric.bearing.loads.roller_loads import roller_equilibrium
    >>> bearing = RollerBearing(14, 11e-3, 60e-3, 11e-3, 0.0, "none")
    >>> state = roller_equilibrium(bearing, Operation(5000.0, inner_speed=100.0), 226e9, 7800.0)
    >>> mechanics = mechanics_of(state)
    >>> round(mechanics["cage_speed"], 3), round(mechanics["element_speed"], 3)
    (40.833, 263.561)
    """
    inner, outer = (float(np.max(at.ring(inner=inner).entrainment_speed)) for inner in (True, False))
    gyroscopic = None if at.gyroscopic_moment is None else float(np.max(at.gyroscopic_moment))
    return {
        "max_load": np.max(at.outer_load),
        "radial_displacement": at.radial_displacement,
        "axial_displacement": at.axial_displacement,
        "moment": at.moment,
        "centrifugal_force": at.centrifugal_force,
        "gyroscopic_moment": gyroscopic,
        "cage_speed": at.cage_speed,
        "element_speed": float(np.max(at.speeds.spin)),
        "entrainment_speed": inner,
        "entrainment_speed_inner": inner,
        "entrainment_speed_outer": outer,
        "residual": at.residual,
    }
