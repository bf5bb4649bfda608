"""Films of the bearings and pieces of the source, as the compiled march through discharges reads them."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from ehlectric.arrays import Array
from ehlectric.cases.drive_inputs import Breakdown
from ehlectric.drive.drive_bearings import BearingElement
from ehlectric.drive.motor_circuit import Complex

Integers: TypeAlias = NDArray[np.int64]


class Films(NamedTuple):
    """Films of both bearings."""

    # Breakdown voltage at which a draw is 1 [V]; infinite for films that do not break down,
    # shape (2, positions).
    scale: Array
    positions: Integers  # number of positions of the elements, shape (2,)
    step: Array  # time from one position to the next [s], shape (2,)
    shape: Array  # shape of Weibull's law; infinite without scatter, shape (2,)
    renewal: Array  # mean time after which a new film with a new threshold is in the contacts [s], shape (2,)
    arc: Array  # arc resistance [Ohm], shape (2,)
    extinction: Array  # voltage across the arc below which it goes out [V], shape (2,)
    recovery: Array  # time from there until the film insulates again [s], shape (2,)
    touch: Array  # mean times without and with touching asperities [s], shape (2, 2)
    states: Integers  # states of one film: 2, or 3 where films touch, shape (1,)


class Segments(NamedTuple):
    """Pieces of the source: duration [s], value at the start [V], slope [V/s], and what rings from then."""

    duration: Array
    level: Array
    slope: Array
    ring: Complex


def films_of(bearings: Sequence[BearingElement], breakdown: Breakdown) -> Films:
    """Films of both bearings as the compiled march reads them.

    Films are replaced in the time that the oil takes through the most loaded contact, unless the case gives
    another time. Asperities touch for that time, and part for as long as their share of time asks for.
    """
    count = max(bearing.breakdown.size for bearing in bearings)
    scale = np.full((2, count), math.inf)
    touch = np.full((2, 2), math.inf)
    renewal = np.array([breakdown.renewal_time or bearing.transit for bearing in bearings])
    for b, bearing in enumerate(bearings):
        scale[b, : bearing.breakdown.size] = bearing.breakdown
        if bearing.touching > 0.0:
            closed = breakdown.touch_time or bearing.transit
            # A film that never insulates opens for a part of the time that is not noticed.
            touch[b] = closed * max(1.0 - bearing.touching, 1e-9) / bearing.touching, closed
    still = [bearing.breakdown.size == 1 for bearing in bearings]
    return Films(
        scale=scale,
        positions=np.array([bearing.breakdown.size for bearing in bearings]),
        step=np.array(
            [math.inf if fixed else bearing.step for fixed, bearing in zip(still, bearings, strict=True)]
        ),
        shape=np.array([bearing.shape for bearing in bearings]),
        renewal=np.where([math.isfinite(bearing.shape) for bearing in bearings], renewal, math.inf),
        arc=np.full(2, breakdown.arc_resistance),
        extinction=np.full(2, breakdown.lowest_voltage),
        recovery=np.full(2, breakdown.recovery_time),
        touch=touch,
        states=np.array([3 if np.any(np.isfinite(touch)) else 2]),
    )
