"""Equal spacing of times that are read block by block and printed with few digits."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from decimal import Decimal

import numpy as np

from ehlectric.arrays import Array
from ehlectric.errors import InputError

# Largest deviation from equal spacing, beyond the rounding of printed times [steps].
_JITTER = 1e-3

# Rounded to the same digits, the times of two ends and a sample between them deviate by one last digit.
_DIGITS = 1.01

# Samples whose extremes are kept together, and number of times from which a provisional step is estimated.
# The uncertainty of this step moves the deviations within a group by at most the ratio of the two, 1/200 of a
# last printed digit.
_GROUP, _FIRST = 100, 20_000

# Largest share of double distances that are taken for missing samples.
_FEW = 0.05


class Spacing:
    """Test of equal spacing that keeps no times, only their extremes within groups of samples.

    Parameters
    ----------
    source : str
        Name of the file in errors.
    """

    def __init__(self, source: str) -> None:
        self.source = source
        self.count = 0
        self.first = self.last = 0.0
        self.long = 0
        self.first_long: int | None = None
        self._step = 0.0  # provisional
        self._shortest = self._before = 0.0
        self._waiting: list[Array] = []
        self._groups: list[tuple[Array, Array, Array, Array]] = []

    def add(self, times: Array, line: Callable[[int], int]) -> None:
        """Take further times; ``line`` gives the line of the file of one of them.

        Raises
        ------
        InputError
            If a time is not after the one before it.
        """
        if not times.size:
            return
        if not self.count:
            self.first = float(times[0])
        before = self.last if self.count else -np.inf
        steps = np.diff(times, prepend=before)
        if not np.all(steps > 0.0):
            bad = int(np.argmin(steps > 0.0))
            what, takes = "goes backward in time", "increasing times"
            if steps[bad] == 0.0:
                what = "repeats the time before it"
                takes += "; if times are printed with too few digits, give the sampling interval as step"
            raise InputError(self.source, f"line {line(bad)} {what}", takes=takes)
        self._waiting.append(times)
        self.count += times.size
        self.last = float(times[-1])
        if self._step or sum(each.size for each in self._waiting) >= _FIRST:
            self._take()

    def _take(self) -> None:
        """Extremes of the deviations of the times that wait from the provisional step."""
        times = np.concatenate(self._waiting)
        self._waiting.clear()
        at = self.count - times.size
        if not self._step:
            self._step = (float(times[-1]) - float(times[0])) / max(1, times.size - 1)
            self._shortest = float(np.min(np.diff(times))) if times.size > 1 else 0.0
            steps = np.diff(times)
        else:
            steps = np.diff(times, prepend=self._before)
        long = np.flatnonzero(steps > 1.5 * self._shortest)
        if long.size and self.first_long is None:
            self.first_long = self.count - steps.size + int(long[0])
        self.long += long.size
        self._before = float(times[-1])
        numbers = np.arange(at, self.count)
        deviations = times - (self.first + self._step * numbers)
        begins = np.arange(0, times.size, _GROUP)
        ends = np.append(begins[1:], times.size) - 1
        self._groups.append(
            (
                numbers[begins].astype(np.float64),
                numbers[ends].astype(np.float64),
                np.minimum.reduceat(deviations, begins),
                np.maximum.reduceat(deviations, begins),
            )
        )

    def step(self, resolution: float) -> float:
        """Spacing of all times, from the first and the last one.

        Parameters
        ----------
        resolution : float
            Last printed digit of the times, in their unit.

        Returns
        -------
        float
            Spacing, in the unit of the times.

        Raises
        ------
        InputError
            If a time deviates from equal spacing by more than the rounding of printed digits explains.
        """
        if self._waiting:
            self._take()
        step = (self.last - self.first) / (self.count - 1)
        begin, end, least, most = (np.concatenate(column) for column in zip(*self._groups, strict=True))
        drift = step - self._step
        high = most - np.minimum(drift * begin, drift * end)
        low = least - np.maximum(drift * begin, drift * end)
        deviations = np.maximum(high, -low)
        rounding = 8.0 * np.finfo(float).eps * max(abs(self.first), abs(self.last))
        if np.max(deviations) > _DIGITS * resolution + _JITTER * step + rounding:
            worst = int(np.argmax(deviations))
            raise InputError(
                self.source,
                f"is unevenly sampled: between samples {int(begin[worst]) + 1} and {int(end[worst]) + 1}, a "
                f"time is {deviations[worst] / step:.3g} of a step off",
                takes=f"equal steps of time, here {step:.6g}, up to {_JITTER:g} of a step and the rounding "
                "of printed times",
            )
        return step

    @property
    def missing(self) -> bool:
        """Whether a few distances between times are twice the others, as where samples are missing."""
        return 0 < self.long <= _FEW * self.count


def resolution(decimal: str, ends: Sequence[Sequence[str]]) -> float:
    """Last printed digit of times, at that end of a record where it is coarser.

    A program that leaves out zeros at the end prints some times with fewer digits than others, and one with a
    fixed number of digits prints fewer decimal places the larger a time is. At each end, the largest time
    therefore counts, with the most digits that any time there has.

    Parameters
    ----------
    decimal : str
        Decimal mark.
    ends : sequence of sequences of str
        Texts of the first times and of the last ones.

    Returns
    -------
    float
        Last digit, in the unit of the times.

    Examples
    --------
    >>> resolution(".", [["-1.000e-03", "-9.99e-04"], ["0.001", "0.00101"]])
    1e-05
    """
    return max(_last_digit([text.replace(decimal, ".") for text in texts]) for texts in ends if texts)


def _last_digit(texts: Sequence[str]) -> float:
    numbers = [Decimal(text) for text in texts]
    filled = [number for number in numbers if number]
    if not filled:
        return float(10.0 ** max(-300, min(number.adjusted() for number in numbers)))
    digits = max(len(number.as_tuple().digits) for number in filled)
    return float(10.0 ** max(-300, max(number.adjusted() for number in filled) - digits + 1))
