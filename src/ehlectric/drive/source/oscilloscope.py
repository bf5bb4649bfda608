"""Reader of waveforms that an oscilloscope saved as text."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np

from ehlectric.arrays import Array
from ehlectric.drive.source.quality import quality_warnings
from ehlectric.drive.source.text.choice import Choice, choice_of
from ehlectric.drive.source.text.dialect import Layout, layout_of
from ehlectric.drive.source.text.heads import Heads, heads_of
from ehlectric.drive.source.text.lines import decoded, whole_lines
from ehlectric.drive.source.text.record import Record
from ehlectric.drive.source.waveform import Waveform
from ehlectric.errors import InputError, ResultWarning

# Smallest number of samples, and size of the beginning of a file in which its layout is found [bytes].
LEAST_SAMPLES, _HEAD = 16, 65_536

# Largest credible voltage [V], and largest credible sampling interval where no unit of time is stated [s].
_MOST, _SLOW = 1e9, 1e-3

# Largest relative difference of a stated length or interval from that of the times.
_SAME = 0.01


def read_waveform(
    path: str | Path,
    *,
    column: str | int | None = None,
    time_column: str | int | None = None,
    step: float | None = None,
    time_unit: str | None = None,
    value_unit: str | None = None,
    scale: float = 1.0,
) -> tuple[Waveform, tuple[ResultWarning, ...]]:
    r"""Read a waveform from a text file of an oscilloscope.

    Separator, decimal mark, encoding, lines above the numbers, heads and units are found in the file. It is
    read block by block, so that ten million samples need less than 0.5 GB of memory.

    Parameters
    ----------
    path : str or Path
        Text file with one sample a line: columns of voltages, and mostly one of times.
    column : str or int, optional
        Name of the channel as the file has it, or number of its column in the file, from 1. It may be left
        out where the file has a single voltage.
    time_column : str or int, optional
        Name or number of the column of times, where the file does not show which one it is.
    step : float, optional
        Sampling interval [s] of a file without times. It also replaces times with too few printed digits; of
        them, only the first one is used then.
    time_unit, value_unit : str, optional
        Units of the columns, where the file states none.
    scale : float
        Factor of all voltages, such as the ratio of a probe that the oscilloscope does not know.

    Returns
    -------
    waveform : Waveform
        Samples in volts at equal steps of time.
    warnings : tuple of ResultWarning
        Units that were assumed, and doubts about the samples: missing, clipped or coarse ones.

    Raises
    ------
    InputError
        If the file cannot be read, has fewer than 16 samples, text or a number that is not finite among its
        numbers, times that repeat, go backward or are unevenly spaced, or a constant voltage; or if it does
        not show which columns are meant. The line or the column is named.

    Examples
    --------
    >>> import tempfile
    >>> lines = ["Time (us);CH1 (V)", *(f"{k};{k * (k - 9):.1f}".replace(".", ",") for k in range(20))]
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = Path(folder) / "scope.csv"
    ...     _ = file.write_text("\n".join(lines))
    ...     wave, warnings = read_waveform(file)
    >>> wave.values.size, wave.step, wave.values[2]
    (20, 1e-06, np.float64(-14.0))
    """
    path = Path(path)
    _check_arguments(step, scale)
    content = whole_lines(path)
    beginning = next(content, b"")
    if len(beginning) < _HEAD:
        # The last line of a short file may have no end, and comes alone then.
        beginning += b"".join(content)
    layout, first = _layout(path, beginning)
    heads = heads_of(layout)
    choice = choice_of(path, heads, column, time_column, (time_unit, value_unit), step)
    places = (choice.value.place, *(() if choice.time is None else (choice.time.place,)))
    record = Record(str(path), layout, places, tests_times=step is None)
    record.read(first, content)
    values = record.values
    if values.size < LEAST_SAMPLES:
        raise InputError(path, f"has {values.size} samples", takes=f"at least {LEAST_SAMPLES}")
    start, interval = _times(path, record, heads, choice, step)
    if choice.times_assumed and interval > _SLOW:
        raise InputError.worded(
            "time_unit",
            f"missing; {path} states no unit of its times, and in seconds its samples are {interval:g} s "
            "apart, too far for an inverter; expected 's', 'ms' or 'us'",
        )
    _scale(path, values, choice, scale)
    waveform = Waveform(start, interval, values)
    warnings = [*_of_reading(path, record, heads, choice), *quality_warnings(str(path), waveform)]
    return waveform, tuple(warnings)


def _check_arguments(step: float | None, scale: float) -> None:
    if step is not None and not 0.0 < step < np.inf:
        raise InputError("step", got=step, takes="a sampling interval above 0 s")
    if not np.isfinite(scale) or scale == 0.0:
        raise InputError("scale", got=scale, takes="a finite factor other than 0")


def _scale(path: Path, values: Array, choice: Choice, scale: float) -> None:
    """Make voltages [V] of numbers, in place; constant ones and those beyond all machines are refused."""
    with np.errstate(over="ignore"):
        values *= choice.factor * scale
    low, high = float(np.min(values)), float(np.max(values))
    if max(abs(low), abs(high)) > _MOST:
        takes = f"at most {_MOST:g} V; are unit and scale right?"
        raise InputError(path, f"has {low:g} to {high:g} V in {choice.value}", takes=takes)
    if low == high:
        raise InputError(path, f"is constant, all {values.size} samples of {choice.value} are {low:g} V")


def _layout(path: Path, text: bytes) -> tuple[Layout, bytes]:
    """Layout of a file from its first block, and the rest of the block, which begins with the numbers."""
    head = text[:_HEAD]
    if len(text) > _HEAD:
        head = head[: head.rfind(b"\n") + 1]
    layout = layout_of(path, [decoded(line) for line in head.split(b"\n")])
    at = 0
    for _ in range(layout.first - 1):
        at = text.index(b"\n", at) + 1
    return layout, text[at:]


def _times(
    path: Path, record: Record, heads: Heads, choice: Choice, step: float | None
) -> tuple[float, float]:
    """Time of the first sample and sampling interval [s]."""
    if choice.time is None:
        return heads.start or 0.0, step if step is not None else heads.step or 0.0
    if step is None:
        factor = choice.time_factor
        interval = record.spacing.step(record.resolution)
        return record.spacing.first * factor, float(f"{interval * factor:.15g}")
    first, last = (at * choice.time_factor for at in record.ends)
    told, given = last - first, step * (record.count - 1)
    if abs(told - given) > _SAME * given + 2.0 * record.resolution * choice.time_factor:
        says = (
            f"{step:g} s, {given:.6g} s for {record.count} samples, but the times of {path} span {told:.6g} s"
        )
        raise InputError("step", got=says)
    return first, step


def _of_reading(path: Path, record: Record, heads: Heads, choice: Choice) -> Iterator[ResultWarning]:
    """Warnings about what the file does not state, and about samples that it may lack."""
    if choice.assumed:
        text = f"{path} states no units: it was assumed that {' and that '.join(choice.assumed)}"
        yield ResultWarning("units-assumed", text)
    if heads.points is not None and record.count < heads.points:
        text = f"{path} states {heads.points} samples, but has {record.count}: is the file cut off?"
        yield ResultWarning("samples-missing", text)
    if record.spacing.missing:
        at = record.spacing.first_long
        text = (
            f"{path}: {record.spacing.long} of {record.count - 1} distances between times are twice the "
            f"others, the first after sample {at}: times are rounded, or samples are missing; equal steps "
            "were taken"
        )
        yield ResultWarning("samples-missing", text)
