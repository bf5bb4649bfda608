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

from dataclasses import dataclass

import numpy as np

from ehlectric.arrays import Array, Numbers
from ehlectric.bearing import InclinedRow
from ehlectric.cases.axle_inputs import ASSUMED_ARRANGEMENT, Adjustment, Arrangement
from ehlectric.errors import InputError

# Factor by which a bound grows until the root lies below it, and most steps.
_GROWTH, _MOST_STEPS = 2.0, 60

# Relative error of axial loads, and the least step to a bound [N].
_ACCURACY, _LEAST = 1e-10, 1.0

# Sign of the z axis along which the row at the smaller z carries axial forces of the shaft.
_WAYS: dict[Arrangement, float] = {"O": 1.0, "X": -1.0}


@dataclass(frozen=True)
class AxialShare:
    """Axial forces of n shafts along z on their two rows, in the order of the rows."""

    forces: Array  # [N], shape (2, n); NaN where a row has no equilibrium
    # For each row, whether it carries only the axial load that keeps it together, shape (2, n).
    unloaded: Array


@dataclass(frozen=True)
class AdjustedRows:
    """Two rows that are adjusted against each other."""

    rows: tuple[InclinedRow, InclinedRow]
    adjustment: Adjustment
    ascending: bool = True  # whether the first row is at the smaller z

    @property
    def ways(self) -> tuple[float, float]:
        """Sign of the z axis along which each row carries axial forces of the shaft."""
        first = _WAYS[self.adjustment.arrangement or ASSUMED_ARRANGEMENT] * (1.0 if self.ascending else -1.0)
        return first, -first

    def pressure_centres(self, places: tuple[float, float]) -> tuple[float, float]:
        """Places of the pressure centres along z, at which the rows carry their radial loads, from the places
        of the rows [m].
        """
        first, second = (
            place - way * row.pressure_distance
            for row, place, way in zip(self.rows, places, self.ways, strict=True)
        )
        if (second - first) * (places[1] - places[0]) <= 0.0:
            raise InputError(
                "bearing.at",
                got=f"places {abs(places[1] - places[0]):g} m apart, face to face",
                takes="a larger distance: the pressure centres of both rows coincide or cross",
            )
        return first, second

    @property
    def total_approach(self) -> float:
        """Sum s_0 of the approaches of both rows [m]."""
        preload, play = self.adjustment.preload, self.adjustment.axial_play
        if preload is None:
            return -(play or 0.0)
        return float(sum(row.approach(0.0, preload, 0.0)[0] for row in self.rows))

    def share(self, radial: tuple[Numbers, Numbers], axial: Numbers, speed: Numbers) -> AxialShare:
        """Axial forces on both rows, for one shaft or n shafts.

        ``radial`` loads of the rows [N], ``axial`` force of the shaft along z [N] and its ``speed`` [rad/s]
        are numbers, or arrays of shape (n,).
        """
        *loads, axial, speed = np.broadcast_arrays(*map(np.atleast_1d, (*radial, axial, speed)))
        along = self.ways[0] * axial
        further = np.stack([np.maximum(along, 0.0), np.maximum(-along, 0.0)])
        limits = (
            np.stack([row.least_axial_load(at) for row, at in zip(self.rows, loads, strict=True)]) - further
        )
        load = self._lesser(np.maximum(0.0, np.max(limits, axis=0)), (*loads, *further, speed))
        both = load + further
        return AxialShare(
            np.array(self.ways)[:, np.newaxis] * both,
            (load == limits) | (both == 0.0),
        )

    def _lesser(self, least: Array, values: tuple[Array, ...]) -> Array:
        """Axial load of the row that carries less [N], at least ``least``, shape (n,).

        ``values`` are the radial loads of both rows, the axial loads that each row carries in addition, and
        the speed, shape (n,) each.
        """
        import scipy.optimize.elementwise

        total, (first, second) = self.total_approach, self.rows

        def excess(load: Array, *of: Array) -> Array:
            """Approach of both rows beyond the sum."""
            approach = first.approach(of[0], load + of[2], of[4]) + second.approach(
                of[1], load + of[3], of[4]
            )
            return approach - total

        low = excess(least, *values)
        lesser = np.where(np.isnan(low), np.nan, least)
        sought = low < 0.0
        if not np.any(sought):
            return lesser
        bound, chosen = least[sought], tuple(value[sought] for value in values)
        step = np.maximum(_LEAST, np.max(np.abs(chosen[:4]), axis=0))
        for _ in range(_MOST_STEPS):
            short = excess(bound + step, *chosen) < 0.0
            if not np.any(short):
                break
            step = np.where(short, _GROWTH * step, step)
        root = scipy.optimize.elementwise.find_root(
            excess, (bound, bound + step), args=chosen, tolerances={"xrtol": _ACCURACY, "xatol": _ACCURACY}
        )
        lesser[sought] = np.where(root.success, root.x, np.nan)
        return lesser
