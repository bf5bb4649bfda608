"""Axial stiffness of one inclined row, which is adjusted against a second row elsewhere on a shaft. SI units.

A row of tapered rollers or of angular-contact balls carries an axial force one way. The equilibrium of the
row gives the axial force as a function of the axial approach, and of the radial load.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ehlectric.bearing.conditions import BearingConditions
from ehlectric.bearing.loads.geometry import RollerBearing
from ehlectric.bearing.loads.roller_loads import least_axial_load
from ehlectric.bearing.preparation import equilibria_of, resolve_bearing
from ehlectric.cases.bearing_case import BearingCase

# Part of the radial load, or of the least axial load, by which an axial load exceeds its limit: at the limit
# the row has no equilibrium.
_BEYOND = 1e-6


@dataclass(frozen=True)
class InclinedRow:
    """Row with an inclined contact, at its speed and temperature."""

    conditions: BearingConditions[Any]

    @classmethod
    def of(cls, case: BearingCase) -> InclinedRow:
        """Row of a bearing case, whose loads are not used."""
        return cls(resolve_bearing(case))

    @property
    def pressure_distance(self) -> float:
        """Distance from the middle of the row to its pressure centre, (d_m/2) tan a [m].

        At the pressure centre, the lines of the contact forces meet on the axis of the bearing.
        """
        geometry = self.conditions.geometry
        return float(0.5 * geometry.pitch_diameter * np.tan(geometry.free_angle))

    def least_axial_load(self, radial: float) -> float:
        """Least axial load at which the row is in equilibrium under a radial load [N].

        With less, the row is pushed apart: rollers by the radial load on a few of them. Balls move to the
        bottom of their grooves, and need almost none.
        """
        geometry = self.conditions.geometry
        if isinstance(geometry, RollerBearing):
            return (1.0 + _BEYOND) * float(least_axial_load(geometry, radial))
        return _BEYOND * radial

    def approach(self, radial: float, axial: float, *, resting: bool = False) -> float:
        """Axial approach of the inner ring from where unloaded elements just touch [m], under loads [N].

        The approach is below 0 if the axial load is smaller than the axial load that a radial load on half
        of the elements induces. Without loads the approach is 0. ``resting`` is at rest, without centrifugal
        forces. Raises ConvergenceError where the equilibrium does not converge.
        """
        if radial == 0.0 and axial == 0.0:
            return 0.0
        loads = {"radial_load": radial, "axial_load": axial} | ({"inner_speed": 0.0} if resting else {})
        bearing = self.conditions.bearing.model_copy(update=loads)
        (at,) = equilibria_of(replace(self.conditions, bearing=bearing), 1)
        # The grooves of balls that just touch are apart; inclined rollers have their zero there.
        geometry = self.conditions.geometry
        apart = 0.0 if isinstance(geometry, RollerBearing) else 0.5 * float(geometry.endplay)
        return float(at.axial_displacement) - apart
