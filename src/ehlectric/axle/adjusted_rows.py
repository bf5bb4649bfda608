"""Axial forces of two inclined rows that are adjusted against each other on a shaft. SI units.

Each row carries axial forces one way. Back to back (O), the pressure centres lie outside of the rows, and the
row at the smaller z carries forces of the shaft towards +z; face to face (X), they lie between the rows, and
this row carries forces towards -z. With the axial load F_i of row i and its approach s_i, which follows from
its equilibrium under F_i and its radial load, the axial place of the shaft is the one unknown:

    s_1(F_1) + s_2(F_2) = s_0        F_1 - F_2 = F_x (O), -F_x (X)

with the axial force F_x of the shaft along z. The sum s_0 is minus the axial play, or the approach of both
rows at rest under the preload, without a radial load. A row whose radial load would push it apart carries the
least axial load of its equilibrium. Shaft, rings and housing are rigid.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import scipy

from ehlectric.bearing import InclinedRow
from ehlectric.cases.axle_inputs import ASSUMED_ARRANGEMENT, Adjustment, Arrangement
from ehlectric.errors import InputError

# Factor by which a bound grows until the root lies below it, and most steps.
_GROWTH, _MOST_STEPS = 2.0, 60

# Relative error of axial loads, and the least load of a bound [N].
_ACCURACY, _LEAST = 1e-10, 1.0

# Sign of the z axis along which the row at the smaller z carries axial forces of the shaft.
_WAYS: dict[Arrangement, float] = {"O": 1.0, "X": -1.0}


@dataclass(frozen=True)
class AxialShare:
    """Axial forces along z of the shaft on its two rows [N], in the order of the rows."""

    forces: tuple[float, float]
    # For each row, whether it carries only the axial load that keeps it together.
    unloaded: tuple[bool, bool]


@dataclass(frozen=True)
class AdjustedRows:
    """Two rows at places along z [m], adjusted against each other."""

    rows: tuple[InclinedRow, InclinedRow]
    places: tuple[float, float]
    adjustment: Adjustment

    @property
    def ways(self) -> tuple[float, float]:
        """Sign of the z axis along which each row carries axial forces of the shaft."""
        arrangement = self.adjustment.arrangement or ASSUMED_ARRANGEMENT
        first = _WAYS[arrangement] * (1.0 if self.places[0] < self.places[1] else -1.0)
        return first, -first

    @property
    def pressure_centres(self) -> tuple[float, float]:
        """Places of the pressure centres along z [m], at which the rows carry their radial loads."""
        first, second = (
            place - way * row.pressure_distance
            for row, place, way in zip(self.rows, self.places, self.ways, strict=True)
        )
        if (second - first) * (self.places[1] - self.places[0]) <= 0.0:
            raise InputError(
                "bearing.at",
                got=f"places {abs(self.places[1] - self.places[0]):g} m apart, face to face",
                takes="a larger distance: the pressure centres of both rows coincide or cross",
            )
        return first, second

    @property
    def total_approach(self) -> float:
        """Sum s_0 of the approaches of both rows [m]."""
        preload, play = self.adjustment.preload, self.adjustment.axial_play
        if preload is None:
            return -(play or 0.0)
        return sum(row.approach(0.0, preload, resting=True) for row in self.rows)

    def share(self, radial: tuple[float, float], axial: float) -> AxialShare:
        """Axial forces on both rows under radial loads [N] and the axial force of the shaft along z [N]."""
        along = self.ways[0] * axial
        further = max(along, 0.0), max(-along, 0.0)
        rows = tuple(zip(self.rows, radial, further, strict=True))
        total = self.total_approach

        def excess(load: float) -> float:
            """Approach of both rows beyond the sum, at an axial load of the row that carries less."""
            return sum(row.approach(at, load + more) for row, at, more in rows) - total

        limits = [row.least_axial_load(at) - more for row, at, more in rows]
        least = max(0.0, *limits)
        load = least if excess(least) >= 0.0 else _root(excess, least, max(_LEAST, abs(along), *radial))
        first, second = (load + more for more in further)
        return AxialShare(
            (self.ways[0] * first, self.ways[1] * second),
            (load == limits[0] or first == 0.0, load == limits[1] or second == 0.0),
        )


def _root(excess: Callable[[float], float], least: float, step: float) -> float:
    """Root of a function that increases from a value below 0 at ``least``."""
    high = least + step
    for _ in range(_MOST_STEPS):
        if excess(high) >= 0.0:
            break
        high = least + _GROWTH * (high - least)
    return float(scipy.optimize.brentq(excess, least, high, xtol=_ACCURACY * high, rtol=_ACCURACY))
