"""Times of a waveform: the start and the sampling interval, if the steps of the times are equal."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ehlectric.arrays import Array
from ehlectric.drive.waveform.chosen_columns import Choice
from ehlectric.drive.waveform.refusals import refuse_gaps, refuse_restarts
from ehlectric.drive.waveform.samples import LEAST_SAMPLES, Samples
from ehlectric.errors import InputError
from ehlectric.quantities.result_warnings import ResultWarning
from ehlectric.readable import readable
from ehlectric.runtime.sizes import check_memory_for

# Largest sampling interval where no unit of time is stated [s].
_SLOW = 1e-3

# Largest relative difference of a given interval from the interval of the times.
_SAME = 0.01

# Largest deviation of times from equal spacing, beyond the rounding of printed times [steps]. Rounded to the
# same digits, the times of two ends and a sample between them deviate by one last digit.
_JITTER, _DIGITS = 1e-3, 1.01

# Largest rounding of uneven times [new steps], relative allowance for rounding at the end of the times, and
# memory for a new sample [bytes].
_COARSE, _END, _MEMORY = 0.1, 1e-12, 40.0

# Number of new samples that no memory contains.
_MOST = 1e15

# Largest share of double distances that are taken for missing samples.
_FEW = 0.05


def timing(
    path: Path, read: Samples, choice: Choice, step: float | None
) -> tuple[float, float, tuple[ResultWarning, ...]]:
    """Time of the first sample and sampling interval [s], and a warning where samples may be missing.

    The user's ``step`` [s] replaces times that are missing or printed with too few digits. Raises InputError
    if the times do not increase in equal steps, within the rounding of printed times.
    """
    times, last = read.times, read.values.size - 1
    if choice.time is None:
        return 0.0, step or 0.0, ()
    refuse_restarts(path, read)
    factor, span = choice.time_factor, float(times[-1] - times[0])
    start, each, single = float(times[0]) * factor, span / last, _single_precision(times, read.digit)
    if step is not None:
        given = step * last
        if abs(span * factor - given) > _SAME * given + 2.0 * max(read.digit, single) * factor:
            says = f"{step:g} s, {readable(given, 6)} s for {last + 1} samples, but the times of {path} span"
            raise InputError("step", got=f"{says} {readable(span * factor, 6)} s")
        _check_even(path, read, each, single, step)
        return start, step, ()
    _check_order(path, read, each, single)
    _check_even(path, read, each, single, None)
    # Exactly equal steps, such as 2^-14 s, are not rounded to fewer digits.
    exact = _worst(times, each)[1] == 0.0
    interval = float(f"{_shortest(each, 0.0 if exact else single / last) * factor:.15g}")
    if interval > _SLOW and f"{choice.time} is in s" in choice.assumed:
        raise InputError.worded(
            "time_unit",
            f"missing; {path} states no unit of its times, and in seconds its samples are {interval:g} s "
            "apart, too far for an inverter; expected 's', 'ms' or 'us'",
        )
    return start, interval, _missing(path, times)


def evened(
    path: Path, read: Samples, choice: Choice, interval: float | None, scale: float
) -> tuple[Samples, tuple[ResultWarning, ...]]:
    """Samples at equal steps of the user's ``interval`` [s], if times are uneven, and a warning.

    Circuit simulators choose their steps, and join their points by straight lines: new samples lie on these
    lines. The warning contains the largest distance of a point from the new samples, joined in the same way.
    ``scale`` is the user's factor on the voltages. Without an interval, and for even times, nothing changes.
    """
    times = read.times
    if choice.time is None or interval is None or times.size < 2:
        return read, ()
    refuse_restarts(path, read)
    each, single = float(times[-1] - times[0]) / (times.size - 1), _single_precision(times, read.digit)
    _check_order(path, read, each, single)
    if _worst(times, each)[1] <= _tolerance(read, each, single):
        return read, ()
    refuse_gaps(path, read)
    step, steps = interval / choice.time_factor, np.diff(times)
    if max(read.digit, single) > _COARSE * step:
        what = f"prints times to {read.digit * choice.time_factor:.2g} s, too coarse for uneven steps"
        raise InputError(
            path, what, takes=f"at most {_COARSE:g} of the resampling interval of {interval:g} s"
        )
    count = int(min((times[-1] - times[0]) / step * (1.0 + _END), _MOST)) + 1
    if count < LEAST_SAMPLES:
        longest = (times[-1] - times[0]) * choice.time_factor / (LEAST_SAMPLES - 1)
        takes = f"at most {longest:.3g} s, for {LEAST_SAMPLES} samples"
        raise InputError("resample", got=f"{interval:g} s", takes=takes)
    check_memory_for(path, _MEMORY * count, f"has {readable(count, 2)} samples at the resampling interval")
    grid = times[0] + step * np.arange(count, dtype=np.float64)
    values = np.interp(grid, times, read.values)
    inside = times <= grid[-1]
    off = float(np.max(np.abs(np.interp(times[inside], grid, values) - read.values[inside])))
    span = float(np.ptp(read.values)) or 1.0
    warning = ResultWarning.of(
        "waveform-uneven",
        file=path,
        least=float(np.min(steps)) * choice.time_factor,
        most=float(np.max(steps)) * choice.time_factor,
        interval=interval,
        error=off * abs(choice.factor * scale),
        share=100.0 * off / span,
    )
    return Samples(values, grid), (warning,)


def _single_precision(times: Array, digit: float) -> float:
    """Distance of neighbouring numbers of single precision at the largest time; 0 for finer times.

    Some oscilloscopes compute times as numbers of 32 bits, and print them with more digits than these have.
    """
    largest = np.max(np.abs(times))
    with np.errstate(over="ignore", under="ignore"):
        single = times.astype(np.float32)
        if not np.all(np.abs(single - times) <= _DIGITS * digit):
            return 0.0
        return float(np.spacing(np.float32(largest)))


def _shortest(number: float, error: float) -> float:
    """Number with the fewest digits within an error of another one.

    Examples
    --------
    >>> _shortest(1.0000047e-4, 1e-9), _shortest(0.125, 0.0)
    (0.0001, 0.125)
    """
    rounded = (float(f"{number:.{digits}g}") for digits in range(1, 16))
    return next((each for each in rounded if abs(each - number) <= error), number)


def _worst(times: Array, each: float) -> tuple[int, float]:
    """Sample whose time deviates most from equal steps between the ends, and the size of this deviation."""
    off = np.arange(times.size) * each
    off += times[0]
    off -= times
    worst = int(np.argmax(np.abs(off, out=off)))
    return worst, float(off[worst])


def _tolerance(read: Samples, each: float, single: float) -> float:
    """Largest deviation of even times by jitter, by their last printed digit and by their precision."""
    times = read.times
    rounding = 8.0 * np.finfo(float).eps * max(abs(times[0]), abs(times[-1]))
    return float(_DIGITS * read.digit + _JITTER * each + rounding + single)


def _check_even(path: Path, read: Samples, each: float, single: float, step: float | None) -> None:
    """Refuse times that deviate from equal steps by more than their rounding."""
    worst, off = _worst(read.times, each)
    if off <= _tolerance(read, each, single):
        return
    refuse_gaps(path, read)
    says = f"is unevenly sampled: the time of sample {worst + 1} is {readable(off / each)} steps off"
    takes = f"equal steps of time, here {readable(each, 6)}, up to {_JITTER:g} of a step and the rounding"
    takes += " of printed times; or a new interval as resample, for circuit simulators"
    if step is not None:
        raise InputError("step", f"got {step:g} s, but {path} {says}", takes=takes)
    raise InputError(path, says, takes=takes)


def _check_order(path: Path, read: Samples, each: float, single: float) -> None:
    """Refuse times that do not increase."""
    steps = np.diff(read.times)
    if np.all(steps > 0.0):
        return
    bad = int(np.argmin(steps > 0.0))
    place = read.place(bad + 1)
    if steps[bad] < 0.0:
        raise InputError(path, f"{place} goes backward in time", takes="increasing times")
    takes = "increasing times"
    if each > 0.0 and _worst(read.times, each)[1] <= _tolerance(read, each, single):
        takes += "; if times are printed with too few digits, give the sampling interval as step"
    else:
        takes += " in equal steps; save the times with more digits"
    raise InputError(path, f"{place} repeats the time before it", takes=takes)


def _missing(path: Path, times: Array) -> tuple[ResultWarning, ...]:
    gaps = np.diff(times)
    long = np.flatnonzero(gaps > 1.5 * gaps.min())
    if not 0 < long.size <= _FEW * times.size:
        return ()
    return (
        ResultWarning.of(
            "samples-missing", "distances", file=path, long=long.size, distances=gaps.size, sample=long[0] + 1
        ),
    )
