"""Steps of the common-mode voltage of a three-phase inverter. SI units."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise
from types import MappingProxyType

import numpy as np

from ehlectric.arrays import Array
from ehlectric.cases.drive_inputs import Source
from ehlectric.errors import InputError

# Periods of the carrier, or of the fundamental in six-step operation, that are computed at once.
_PERIODS = 2000

# Most periods of the carrier in which edges are counted.
_COUNTED = 20_000.0


@dataclass(frozen=True, eq=False)
class Steps:
    """Steps of a voltage within a time interval."""

    end: float  # end of the interval [s]; it begins where the one before ends
    time: Array  # times at which the steps begin, in order, none of them before the interval [s], shape (n,)
    step: Array  # their heights [V], shape (n,)


def sinusoidal(angle: Array, index: float) -> Array:
    """References of the three phases, in halves of the DC link: sines, shape (n, 3). ``angle`` [rad],
    shape (n,).

    Examples
    --------
    >>> sinusoidal(np.array([0.0]), 0.8).round(3).tolist()
    [[0.8, -0.4, -0.4]]
    """
    phases: Array = index * np.cos(angle[:, None] - np.array([0.0, 1.0, 2.0]) * 2.0 * np.pi / 3.0)
    return phases


def space_vector(angle: Array, index: float) -> Array:
    """References of the three phases of space-vector modulation, in halves of the DC link, shape (n, 3).

    The mean of the largest and the smallest reference is taken off, so that both zero vectors last equally
    long (J. Holtz, Proc. IEEE 82 (1994) 1194, doi:10.1109/5.301684). The references reach the DC link at an
    index of 2/sqrt(3) = 1.155.

    Examples
    --------
    >>> space_vector(np.array([0.0]), 0.8).round(3).tolist()
    [[0.6, -0.6, -0.6]]
    """
    sines = sinusoidal(angle, index)
    centred: Array = sines - 0.5 * (np.max(sines, axis=1) + np.min(sines, axis=1))[:, None]
    return centred


# References of modulations with a carrier, by their names in a drive file.
REFERENCES: Mapping[str, Callable[[Array, float], Array]] = MappingProxyType(
    {"sinusoidal": sinusoidal, "space-vector": space_vector}
)


def steps_of(source: Source, duration: float, first: float = 0.0) -> tuple[float, Iterator[Steps]]:
    """Common-mode voltage of an inverter: its value at the start, and its steps in consecutive intervals.

    The common-mode voltage is the mean of the three phase voltages, from the middle of the DC link. Every
    phase switches between both ends of the link. The carrier is a symmetrical triangle, and references are
    sampled in the middle of its periods.

    ``duration``, time that the steps cover [s]; ``first``, time at which an interval ends in any case [s], up
    to rounding to whole periods of the carrier. Returns value at time 0 [V], and an iterator of the steps.
    Raises InputError if the source is a measured one.

    The voltage of the middle of the DC link to earth, a few times the mains frequency, is neglected, and so
    is the dead time of the switches, which shifts edges by a microsecond.
    """
    if source.dc_link is None or source.fundamental_frequency is None:
        raise InputError.worded("source", "is measured, and has no modulation")
    if source.modulation == "six-step":
        # The first phase begins its positive half, the second is in its negative one, the third positive.
        steps = _six_steps(source.dc_link, source.fundamental_frequency, duration, first)
        return source.dc_link / 6.0, steps
    return -0.5 * source.dc_link, _carrier_steps(source, duration, first)


@lru_cache(maxsize=64)
def edge_rate(source: Source) -> float:
    """Steps of the common-mode voltage in a second [1/s].

    Steps of two phases at the same time are one, and a phase that stays at an end of the link has none:
    mostly there are six in a period of the carrier, and two at an index of zero. They are counted over the
    periods of the carrier in one of the fundamental, at most 20 000.

    Examples
    --------
    >>> inverter = {"dc_link": "560 V", "modulation": "sinusoidal", "switching_frequency": "8 kHz"}
    >>> inverter |= {"fundamental_frequency": "50 Hz", "rise_time": "100 ns"}
    >>> [round(edge_rate(Source.from_written({**inverter, "modulation_index": m}))) for m in (0.0, 0.9)]
    [16000, 48000]
    """
    carrier, fundamental = source.switching_frequency, source.fundamental_frequency
    if carrier is None or fundamental is None:
        return 6.0 * (fundamental or 0.0)
    duration = min(float(np.ceil(carrier / fundamental)), _COUNTED) / carrier
    return sum(interval.time.size for interval in steps_of(source, duration)[1]) / duration


def _intervals(count: int, first: int) -> Iterator[tuple[int, int]]:
    """First and last number, exclusive, of periods that are computed at once; one begins at ``first``."""
    starts = sorted({0, *range(min(first, count), count, _PERIODS), *range(0, first, _PERIODS), count})
    yield from pairwise(starts)


def _six_steps(link: float, fundamental: float, duration: float, first: float) -> Iterator[Steps]:
    """Steps at every sixth of a fundamental period, alternately up and down by a third of the link."""
    sixth, count = 1.0 / (6.0 * fundamental), int(np.ceil(6.0 * fundamental * duration))
    for start, end in _intervals(count, round(6.0 * fundamental * first)):
        number = np.arange(start, end)
        inside = number[number > 0].astype(float)
        step = np.where(inside % 2 == 1, -1.0, 1.0) * link / 3.0
        yield Steps(min((number[-1] + 1) * sixth, duration), np.asarray(inside * sixth, dtype=float), step)


def _carrier_steps(source: Source, duration: float, first: float) -> Iterator[Steps]:
    """Six steps in each period of the carrier."""
    carrier, link, modulation = source.switching_frequency, source.dc_link, source.modulation
    index, fundamental = source.modulation_index, source.fundamental_frequency
    assert carrier is not None and link is not None and modulation is not None
    assert index is not None and fundamental is not None
    count = int(np.ceil(carrier * duration))
    for start, end in _intervals(count, round(carrier * first)):
        number = np.arange(start, end, dtype=float)[:, None]
        angle = 2.0 * np.pi * fundamental * (number[:, 0] + 0.5) / carrier
        duty = np.clip(0.5 + 0.5 * REFERENCES[modulation](angle, index), 0.0, 1.0)
        high = duty > 0.0
        on, off = (number + (0.5 - 0.5 * duty))[high], (number + (0.5 + 0.5 * duty))[high]
        time = np.concatenate([on, off])
        step = np.concatenate([np.ones(on.size), -np.ones(off.size)]) * link / 3.0
        yield Steps(min((number[-1, 0] + 1.0) / carrier, duration), *_merged(time / carrier, step))


def _merged(time: Array, step: Array) -> tuple[Array, Array]:
    """Steps in the order of time; steps at one time are one, and steps of no height are dropped."""
    times, where = np.unique(time, return_inverse=True)
    heights = np.bincount(where, weights=step, minlength=times.size)
    some = np.abs(heights) > 1e-9 * np.max(np.abs(step), initial=0.0)
    return times[some], heights[some]
