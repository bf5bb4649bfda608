"""Films of bearings and meshes, pieces of the source, and settings of the march through discharges."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ehlectric.arrays import Array
from ehlectric.cases.drive_inputs import Breakdown
from ehlectric.drive.circuit_equations import Complex, Integers
from ehlectric.drive.drive_bearings import BearingElement


class Films(NamedTuple):
    """Films of n bearings and gear meshes, each with positions of its rolling elements or teeth."""

    # Breakdown voltage at which a draw is 1 [V]; infinite for films that do not break down,
    # shape (n, positions).
    scale: Array
    positions: Integers  # number of positions of each film, shape (n,)
    step: Array  # time from one position to the next [s], shape (n,)
    shape: Array  # shape of Weibull's law; infinite without scatter, shape (n,)
    renewal: Array  # mean time after which a new film with a new threshold is in the contacts [s], shape (n,)
    arc: Array  # arc resistance [Ohm]; 0 for discharges that take no time, shape (n,)
    extinction: Array  # voltage across the arc below which it goes out [V], shape (n,)
    recovery: Array  # time from there until the film insulates again [s], shape (n,)
    touch: Array  # mean times without and with touching asperities [s], shape (n, 2)


class Segments(NamedTuple):
    """Pieces of the source: duration [s], value at the start [V], slope [V/s], and what rings from then."""

    duration: Array
    level: Array
    slope: Array
    ring: Complex


@dataclass(frozen=True)
class Measuring:
    """Settings of a measurement."""

    # start and duration: time from which on it is measured, and how long [s].
    start: float
    duration: float
    highest: float  # voltage that is about the highest one [V], of which tolerances are parts
    limits: tuple[float, ...]  # limits of the voltage [V]
    trace: float  # time that the trace covers [s]
    # Whether the trace is around a typical one of the first events, where there are any, and not at the
    # begin.
    at_event: bool = False


def films_of(bearings: Sequence[BearingElement], breakdown: Breakdown) -> Films:
    """Films of bearings as the march reads them.

    Films are replaced in the time that the oil takes through the most loaded contact, unless the case gives
    another time. Asperities touch for that time, and part for as long as their share of time asks for.
    """
    number, count = len(bearings), max(bearing.breakdown.size for bearing in bearings)
    scale = np.full((number, count), math.inf)
    touch = np.full((number, 2), math.inf)
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
        arc=np.full(number, breakdown.arc_resistance),
        extinction=np.full(number, breakdown.lowest_voltage),
        recovery=np.full(number, breakdown.recovery_time),
        touch=touch,
    )
