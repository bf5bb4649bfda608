"""What the loads of a bearing do to it, as totals: displacements, moments, inertia and speeds. SI units."""

from __future__ import annotations

from typing import Any

import numpy as np

from ehlectric.bearing.loads.balls import BallEquilibrium
from ehlectric.bearing.loads.rollers import RollerEquilibrium


def mechanics_of(at: BallEquilibrium | RollerEquilibrium) -> dict[str, Any]:
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
    >>> from ehlectric.bearing.loads.ring import Duty
    >>> from ehlectric.bearing.loads.rollers import roller_equilibrium
    >>> bearing = RollerBearing(14, 11e-3, 60e-3, 11e-3, 0.0, "none")
    >>> found = mechanics_of(roller_equilibrium(bearing, Duty(5000.0, inner_speed=100.0), 226e9, 7800.0))
    >>> round(found["cage_speed"], 3), round(found["element_speed"], 3)
    (40.833, 263.561)
    """
    balls = at if isinstance(at, BallEquilibrium) else None
    inner, outer = (float(np.max(e)) for e in (at.speeds.inner_entrainment, at.speeds.outer_entrainment))
    return {
        "max_load": np.max(at.outer_load),
        "radial_displacement": at.radial_displacement,
        "axial_displacement": balls.axial_displacement if balls else None,
        "moment": balls.moment if balls else None,
        "centrifugal_force": at.centrifugal_force,
        "gyroscopic_moment": float(np.max(balls.gyroscopic_moment)) if balls else None,
        "cage_speed": balls.cage_speed if balls else float(at.speeds.cage),
        "element_speed": float(np.max(at.speeds.spin)),
        "entrainment_speed": inner,
        "entrainment_speed_inner": inner,
        "entrainment_speed_outer": outer,
        "residual": at.residual,
    }
