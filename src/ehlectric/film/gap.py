"""Gap between the surfaces of a contact under a pressure, its load, and the derivatives of both.

Dimensionless, with X = x/b, P = p/p_h and H = h R/b^2:

    H = H00 + dry gap + deflection(P),   load = integral of P over the contact

The dry gap contains the curvature and the roughness of the surfaces; H00 is their rigid displacement. H and
the load are composed in this module only. A pressure that depends on the gap, such as the contact pressure of
asperities, would be added here.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy
from numpy.typing import NDArray

from ehlectric.arrays import Array
from ehlectric.film.levels import Level


@dataclass(frozen=True)
class Gap:
    """Gap on one grid at one state of the film, with its derivatives by P and H00."""

    level: Level  # grid with its dry gap and its deflection operator
    thickness: Array  # film thickness H, dimensionless, shape (nx, ny)

    @classmethod
    def of(cls, level: Level, pressure: Array, h00: float) -> Gap:
        """Gap under a pressure P (nx, ny) with the rigid displacement H00."""
        opened = level.dry_gap + level.deflection(pressure)
        return cls(level, h00 + opened)

    def load(self, pressure: Array) -> float:
        """Dimensionless load that a pressure P (nx, ny) carries, its integral over the contact."""
        return float(np.vdot(self.level.weights, pressure))

    def change(self, dp: Array, dh00: float) -> tuple[Array, float]:
        """Return the changes in H (nx, ny) and load due to changes in P (nx, ny) and H00."""
        return self.level.deflection(dp) + dh00, self.load(dp)

    def along(self, distance: int | NDArray[np.int64]) -> Array:
        """Derivative of H at a node by P of the node that is ``distance`` nodes away along x."""
        derivative: Array = self.level.deflection.influence[np.abs(distance), 0]
        return derivative

    def block(self, rows: slice, columns: slice) -> Array:
        """Derivative of H at the nodes ``rows`` of a line contact by P at some of these nodes.

        ``columns`` selects the nodes of P within ``rows``.
        """
        kernel = scipy.linalg.toeplitz(self.level.deflection.influence[: rows.stop - rows.start, 0])
        return kernel[:, columns]

    def elastic_weight(self, density: Array) -> Array:
        """Elastic part of the diagonal of the Reynolds equation, shape (nx, ny).

        It is the change of the wedge term at a node if the pressure P of the node rises by one and P of its
        neighbour falls by one. ``density`` (nx, ny) is rho/rho_0.
        """
        return density * ((self.along(0) - self.along(1)) * self.level.rate)
