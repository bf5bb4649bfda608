"""Moving roughness: heights of the surfaces of a transient contact over position and time.

The case describes each surface at rest. A point at x in the case is at x - D + u_k t at the time t. Here D is
the length of the domain and u_k the speed of its surface. If u_k is negative, the point is at x + D + u_k t.
Roughness that lies beyond the far end of the domain in the case is left out. Moving roughness therefore
begins with a front, behind which its height rises from zero over one half-width.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ehlectric.arrays import Array
from ehlectric.motion.schedule import Schedule
from ehlectric.surfaces.rough_maps import RoughMap
from ehlectric.surfaces.rough_profiles import RoughSurface


@dataclass(frozen=True)
class MovingRoughness:
    """Rough surfaces that move through a contact.

    Attributes
    ----------
    surfaces : sequence of RoughSurface or RoughMap
        Rough surfaces, long enough for the whole run.
    schedule : Schedule
        Time steps and speeds of the surfaces.
    half_width : float
        Half-width b, in a point contact the semi-axis along entrainment [m].
    """

    surfaces: Sequence[RoughSurface] | Sequence[RoughMap]
    schedule: Schedule
    half_width: float

    @property
    def moving(self) -> list[RoughSurface | RoughMap]:
        """Rough surfaces that move."""
        return [surface for surface in self.surfaces if self.schedule.speed_of(surface.surface)]

    @property
    def resting(self) -> list[RoughSurface | RoughMap]:
        """Rough surfaces at rest."""
        return [surface for surface in self.surfaces if not self.schedule.speed_of(surface.surface)]

    def heights(self, time: float, *axes: Array) -> Array:
        """Roughness heights of both surfaces at a time.

        Parameters
        ----------
        time : float
            Time T, dimensionless.
        *axes : ndarray
            Positions X, shape (nx,), and of a point contact also Y, shape (ny,) [half-widths].

        Returns
        -------
        ndarray, shape (2, nx) or (2, nx, ny)
            Heights, positive out of the body [m].
        """
        heights = np.zeros((2, *(axis.size for axis in axes)))
        for surface in self.surfaces:
            heights[surface.surface - 1] += self._height(surface, time, *axes)
        return heights

    def moving_height(self, time: float, *axes: Array) -> Array:
        """Sum of the heights of all moving surfaces at a time [m], shape (nx,) or (nx, ny)."""
        total: Array = np.sum([self._height(surface, time, *axes) for surface in self.moving], axis=0)
        return total

    def _height(self, surface: RoughSurface | RoughMap, time: float, x: Array, *others: Array) -> Array:
        speed, b = self.schedule.speed_of(surface.surface), self.half_width
        if not speed:
            return surface.height(b * x, *(b * other for other in others))
        inlet, outlet = self.schedule.domain
        travelled = speed * time - np.sign(speed) * self.schedule.length
        front = (outlet if speed > 0.0 else inlet) + travelled
        behind = np.clip((front - x) * np.sign(speed), 0.0, 1.0)
        here = np.flatnonzero(behind > 0.0)
        height = np.zeros((x.size, *(other.size for other in others)))
        if here.size:
            rise = np.sin(0.5 * np.pi * behind[here]) ** 2
            there = surface.height(b * (x[here] - travelled), *(b * other for other in others))
            height[here] = there * rise.reshape(-1, *(1 for _ in others))
        return height
