"""Rating lives of a bearing over its duty cycle, by the rule of Palmgren and Miner, SI units.

Each row of the cycle uses the part of a life that its duration takes: revolutions divided by the life in
revolutions. The cycle is repeated until the parts add up to 1. Rows at rest use no part.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, fields
from typing import Any

import numpy as np

from ehlectric.arrays import Array, Mask
from ehlectric.bearing.loads.life import LOWEST_RATIO
from ehlectric.bearing.rating_life import Fatigue, life_exponent, lives_of, rated_loads
from ehlectric.cases.bearing_case import BearingCase
from ehlectric.quantities.field_metadata import number
from ehlectric.quantities.inputs import SPEED
from ehlectric.quantities.result_warnings import ResultWarning
from ehlectric.runtime.files import plain

_TURN = 2.0 * math.pi


@dataclass(frozen=True)
class CycleLife:
    """Mean load and rating lives of a bearing over a duty cycle; None for what is not known."""

    mean_speed: float | None = field(default=None, metadata=number())  # [rad/s], rows at rest included
    equivalent_load: float | None = field(default=None, metadata=number())  # mean over the revolutions [N]
    # Lives [s] by their names in ``RatingLife``.
    basic_life: float | None = field(default=None, metadata=number())
    modified_life: float | None = field(default=None, metadata=number())
    film_modified_life: float | None = field(default=None, metadata=number())
    reference_life: float | None = field(default=None, metadata=number())
    reference_modified_life: float | None = field(default=None, metadata=number())
    film_reference_modified_life: float | None = field(default=None, metadata=number())
    roughened_life: float | None = field(default=None, metadata=number())
    reliable_life: float | None = field(default=None, metadata=number())
    reliable_reference_life: float | None = field(default=None, metadata=number())
    # Minimum of the static safety s_0 over all rows, at rest and in motion.
    static_safety: float | None = field(default=None, metadata=number())
    # Shares of the revolutions with a viscosity ratio below 0.1, the lowest ratio of ISO 281, of the oil and
    # of the film. They count with a ratio of 0.1, so that the modified lives are upper bounds.
    low_viscosity_share: float | None = field(default=None, metadata=number())
    low_film_share: float | None = field(default=None, metadata=number())
    # Share of the revolutions in rows without a result, which only the basic life contains.
    unsolved_share: float | None = field(default=None, metadata=number())

    def summary(self) -> dict[str, float | None]:
        """Values by the keys of the table ``duty`` of summary.json, without the speed."""
        return {each.name: getattr(self, each.name) for each in fields(self)}

    def warnings(self) -> Iterator[ResultWarning]:
        """Notes of revolutions for which ISO 281 has no life modification factor."""
        for share, what in ((self.low_viscosity_share, "oil"), (self.low_film_share, "film")):
            if share:
                yield ResultWarning.of("life-outside", f"cycle-{what}", percent=100.0 * share)


# Names of the lives.
LIVES = tuple(each.name for each in fields(CycleLife) if each.name.endswith("_life"))


# Names of the lives that need no solution of a row.
_OF_LOADS = ("basic_life", "reliable_life")


def cycle_life(
    case: BearingCase, given: Mapping[str, Array], values: Mapping[str, Array], total: float
) -> CycleLife:
    """Rating lives over a cycle of a duration ``total`` [s]; all None without ``[bearing.life]``.

    ``given``, speed, loads and duration of the rows that move, and ``values``, the fields of ``Fatigue`` at
    them, NaN for a row without a result, SI units, shape (n,).
    """
    life, speed, duration = case.bearing.life, np.abs(given["speed"]), given["duration"]
    if life is None:
        return CycleLife()
    if not speed.size:
        return CycleLife(mean_speed=0.0)
    loads = {f"bearing.{name}": given[name] for name in ("radial_load", "axial_load")}
    bearing = case.with_values({SPEED: speed, **loads}).bearing
    fatigue = Fatigue(**{each.name: values[each.name] for each in fields(Fatigue)})
    lives = lives_of(bearing, life, fatigue, least_ratio=LOWEST_RATIO)
    computed, turns = np.isfinite(fatigue.reference_turns), speed * duration / _TURN
    of_lives: dict[str, Any] = {
        name: _miner(total, duration, getattr(lives, name), computed | (name in _OF_LOADS)) for name in LIVES
    }
    power = life_exponent(bearing)
    mean = np.average(lives.equivalent_load**power, weights=turns) ** (1.0 / power)
    rows = {
        "low_viscosity_share": lives.viscosity_ratio < LOWEST_RATIO,
        "low_film_share": lives.film_viscosity_ratio < LOWEST_RATIO,
        "unsolved_share": ~computed,
    }
    return CycleLife(
        mean_speed=float(np.sum(speed * duration) / total),
        equivalent_load=plain(mean),
        **of_lives,
        **{name: float(np.sum(turns[within]) / np.sum(turns)) for name, within in rows.items()},
    )


def minimum_static_safety(case: BearingCase, radial: Array, axial: Array) -> float | None:
    """Minimum of the static safety s_0 over the rows of a cycle, also at rest.

    ``radial`` and ``axial``, loads of the rows, shape (n,) [N]. None without ``[bearing.life]``, without a
    load, and for a contact angle that ISO 76 does not have.
    """
    life = case.bearing.life
    if life is None:
        return None
    bearing = case.with_values({"bearing.radial_load": radial, "bearing.axial_load": axial}).bearing
    with np.errstate(divide="ignore"):
        minimum = float(np.min(rated_loads(bearing, life).static_safety))
    return minimum if math.isfinite(minimum) else None


def _miner(total: float, duration: Array, life: Any, counted: Mask) -> float | None:
    """Return the life [s] of a cycle with the duration ``total`` [s] from the lives [s] of its counted rows;
    None if one of these lives is unknown.
    """
    if life is None:
        return None
    life_of_all: float | None = plain(total / np.sum((duration / life)[counted])) if np.any(counted) else None
    return life_of_all
