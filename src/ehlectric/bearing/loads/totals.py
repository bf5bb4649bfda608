"""Totals of a bearing in equilibrium: displacements, moments, inertia and speeds. SI units."""

from __future__ import annotations

from typing import Any, TypeAlias

import numpy as np

from ehlectric.bearing.loads.balls import BallEquilibrium
from ehlectric.bearing.loads.rollers import RollerEquilibrium

Equilibrium: TypeAlias = BallEquilibrium | RollerEquilibrium


def mechanics_of(at: Equilibrium) -> dict[str, Any]:
    """Loads, displacements and speeds of a bearing, nested as summary.json.

    Parameters
    ----------
    at : BallEquilibrium or RollerEquilibrium
        One position of the cage.

    Returns
    -------
    dict
        None where rollers have no such number. Speeds are those of pure rolling; of balls, whose contact
        angles differ, the largest, and the cage's mean.

    Examples
    --------
    Rollers of 11 mm on 60 mm, g = 11/60, at 100 rad/s of the inner ring: the cage at 50 (1 - g), the rollers
    against it at 50 (1 - g^2)/g.

    >>> from ehlectric.bearing.loads.geometry import RollerBearing
    >>> from ehlectric.bearing.loads.ring import Operation
    >>> from ehlectric.bearing.loads.rollers import roller_equilibrium
    >>> bearing = RollerBearing(14, 11e-3, 60e-3, 11e-3, 0.0, "none")
    >>> found = mechanics_of(roller_equilibrium(bearing, Operation(5000.0, inner_speed=100.0), 226e9, 7800.0))
    >>> round(found["cage_speed"], 3), round(found["element_speed"], 3)
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
