"""Axial stiffness of one inclined row, which is adjusted against a second row elsewhere on a shaft. SI units.

A row of tapered rollers or of angular-contact balls carries an axial force one way. The equilibrium of the
row gives the axial force as a function of the axial approach, and of the radial load.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ehlectric.arrays import Array, Numbers
from ehlectric.bearing.bearing_kinds import KINDS
from ehlectric.bearing.conditions import Solid
from ehlectric.bearing.loads.geometry import Geometry, RollerBearing
from ehlectric.bearing.loads.ring import Operation
from ehlectric.bearing.loads.roller_loads import least_axial_load
from ehlectric.cases.bearing_inputs import Bearing
from ehlectric.formulas.hertz import reduced_modulus

# Part of the radial load, or of the least axial load, by which an axial load exceeds its limit: at the limit
# the row has no equilibrium.
_BEYOND = 1e-6


@dataclass(frozen=True)
class InclinedRow:
    """Row with an inclined contact."""

    kind: str  # of its bearing
    geometry: Geometry
    modulus: float  # reduced modulus [Pa]
    density: float  # of its elements [kg/m^3]

    @classmethod
    def of(cls, bearing: Bearing) -> InclinedRow:
        """Row of a table ``bearing``, whose loads and speed are not used."""
        element, ring = Solid.of(bearing.element_material), Solid.of(bearing.ring_material)
        modulus = reduced_modulus(element.compliance, ring.compliance)
        geometry = KINDS[bearing.kind].geometry(bearing)
        return cls(bearing.kind, geometry, float(modulus), float(element.density))

    @property
    def pressure_distance(self) -> float:
        """Distance from the middle of the row to its pressure centre, (d_m/2) tan a [m].

        At the pressure centre, the lines of the contact forces meet on the axis of the bearing.
        """
        return float(0.5 * self.geometry.pitch_diameter * np.tan(self.geometry.free_angle))

    def least_axial_load(self, radial: Numbers) -> Array:
        """Least axial load at which the row is in equilibrium under a radial load [N], shape (...).

        With less, the row is pushed apart: rollers by the radial load on a few of them. Balls move to the
        bottom of their grooves, and need almost none.
        """
        if isinstance(self.geometry, RollerBearing):
            return np.asarray((1.0 + _BEYOND) * least_axial_load(self.geometry, radial))
        return np.asarray(_BEYOND * radial)

    def approach(self, radial: Numbers, axial: Numbers, speed: Numbers) -> Array:
        """Axial approach of the inner ring from where unloaded elements just touch [m], shape (...).

        The approach is below 0 if the axial load is smaller than the axial load that a radial load on half
        of the elements induces. Without loads the approach is 0. ``radial`` and ``axial`` load [N] and
        ``speed`` of the inner ring [rad/s], shape (...). The approach is NaN where the row has no
        equilibrium.
        """
        radial, axial, speed = np.broadcast_arrays(*map(np.atleast_1d, (radial, axial, speed)))
        loaded = (radial != 0.0) | (axial != 0.0)
        operation = Operation(
            radial_load=radial, axial_load=np.where(loaded, axial, 1.0), inner_speed=np.abs(speed)
        )
        at = KINDS[self.kind].equilibrium(self.geometry, operation, self.modulus, self.density)
        # The grooves of balls that just touch are apart; inclined rollers have their zero there.
        apart = 0.0 if isinstance(self.geometry, RollerBearing) else 0.5 * self.geometry.endplay
        approach = np.where(at.balanced, at.axial_displacement - apart, np.nan)
        return np.asarray(np.where(loaded, approach, 0.0))
