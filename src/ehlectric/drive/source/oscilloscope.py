"""Reader of waveforms that an oscilloscope saved as text."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ehlectric.arrays import Array
from ehlectric.cases import units
from ehlectric.drive.source.quality import quality_warnings
from ehlectric.drive.source.text.dialect import Layout, layout_of
from ehlectric.drive.source.text.heads import TIMES, VOLTAGES, Head, Heads, heads_of, unit_of
from ehlectric.drive.source.text.lines import decoded, whole_lines
from ehlectric.drive.source.text.numbers import Block, Columns, block_of
from ehlectric.drive.source.text.spacing import Spacing, resolution
from ehlectric.drive.source.waveform import Waveform
from ehlectric.errors import InputError, ResultWarning, shown
from ehlectric.runtime.sizes import check_memory_for

# Smallest number of samples, and size of the beginning of a file in which its layout is found [bytes].
LEAST_SAMPLES, _HEAD = 16, 65_536

# Largest credible voltage [V].
_MOST = 1e9

# Rows at each end of a file whose printed digits are counted.
_COUNTED = 40

# Largest relative difference of a stated length or interval from that of the times.
_SAME = 0.01


@dataclass(frozen=True)
class _Choice:
    """Columns of time and voltage, with the factors to SI units, and what was assumed about them."""

    value: Head
    factor: float
    time: Head | None
    time_factor: float
    assumed: tuple[str, ...]


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
    """Read a waveform from a text file of an oscilloscope.

    Separator, decimal mark, encoding, lines above the numbers, heads and units are found in the file. It is
    read block by block, so that ten million samples need about 0.3 GB of memory.

    Parameters
    ----------
    path : str or Path
        Text file with one sample a line: columns of voltages, and mostly one of times.
    column : str or int, optional
        Name of the channel as the file has it, or number of its column in the file, from 1. It may be left out
        where the file has a single voltage.
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
        numbers, times that repeat, go backward or are unevenly spaced, or a constant voltage; or if it does not
        show which columns are meant. The line or the column is named.

    Examples
    --------
    >>> import tempfile
    >>> lines = ["Time (us);CH1 (V)", *(f"{k};{k * (k - 9):.1f}".replace(".", ",") for k in range(20))]
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = Path(folder) / "scope.csv"
    ...     _ = file.write_text("\\n".join(lines))
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
    choice = _choice(path, heads, column, time_column, (time_unit, value_unit), step)
    record = _Record(path, layout, choice, keeps_times=step is None)
    record.read(first, content)
    values = record.values
    if values.size < LEAST_SAMPLES:
        raise InputError(path, f"has {values.size} samples", takes=f"at least {LEAST_SAMPLES}")
    start, interval = _times(path, record, heads, choice, step)
    _scale(path, values, choice, scale)
    waveform = Waveform(start, interval, values)
    warnings = [*_of_reading(path, record, heads, choice), *quality_warnings(str(path), waveform)]
    return waveform, tuple(warnings)


def _check_arguments(step: float | None, scale: float) -> None:
    if step is not None and not 0.0 < step < np.inf:
        raise InputError("step", got=step, takes="a sampling interval above 0 s")
    if not np.isfinite(scale) or scale == 0.0:
        raise InputError("scale", got=scale, takes="a finite factor other than 0")


def _scale(path: Path, values: Array, choice: _Choice, scale: float) -> None:
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


def _choice(
    path: Path,
    heads: Heads,
    column: str | int | None,
    time_column: str | int | None,
    given: tuple[str | None, str | None],
    step: float | None,
) -> _Choice:
    """Columns that are read; an error lists those among which the user must choose."""
    times = [head for head in heads.columns if head.is_time]
    if time_column is not None:
        times = [_named(path, "time_column", time_column, heads.columns)]
    elif not heads.named and len(heads.columns) > 1:
        times = [heads.columns[0]]
    channels = [head for head in heads.columns if head not in times and not head.is_numbering]
    value = _named(path, "column", column, heads.columns) if column is not None else _single(path, channels)
    if value in times:
        raise InputError("column", got=shown(column), takes="a column of voltages, not that of the times")
    # Some programs write times before every channel.
    before = [head for head in times if head.place < value.place]
    time = before[-1] if before else times[0] if times else None
    if time is None and step is None and heads.step is None:
        key, takes = "step", "a sampling interval in s, or the name of a column of times as time_column"
        raise InputError.worded(key, f"missing; {path} has no column of times that is known; expected {takes}")
    assumed: list[str] = []
    factor = _factor(path, value, "value_unit", given[1], "V", assumed)
    time_factor = 1.0 if time is None else _factor(path, time, "time_unit", given[0], "s", assumed)
    return _Choice(value, factor, time, time_factor, tuple(assumed))


def _named(path: Path, key: str, wanted: str | int, columns: Sequence[Head]) -> Head:
    """Column of a name or a number."""
    if isinstance(wanted, int):
        found = [head for head in columns if head.place + 1 == wanted]
    else:
        name = " ".join(wanted.split()).casefold()
        found = [head for head in columns if head.name.casefold() == name]
    if len(found) != 1:
        raise InputError(key, got=f"{shown(wanted)}, but {path} has the columns {_listed(columns)}")
    return found[0]


def _listed(columns: Sequence[Head]) -> str:
    return ", ".join(str(head) for head in columns[:20]) + ", ..." * (len(columns) > 20)


def _single(path: Path, channels: Sequence[Head]) -> Head:
    """The only voltage of a file, or its only column without a unit if it has no voltage."""
    voltages = [head for head in channels if head.unit in VOLTAGES]
    candidates = voltages or [head for head in channels if not head.unit] or list(channels)
    if not candidates:
        raise InputError(path, "has one column of numbers, which are times", takes="a column of voltages, too")
    if len(candidates) > 1:
        listed = f"{path} has the channels {_listed(candidates)}"
        raise InputError.worded("column", f"missing; {listed}; expected the name or the number of one of them")
    return candidates[0]


def _factor(
    path: Path, head: Head, key: str, given: str | None, unit: str, assumed: list[str]
) -> float:
    """Factor from the unit of a column to the SI unit; a unit that nobody states is assumed to be that."""
    wanted = None if given is None else unit_of(given)
    usual = "'s', 'ms' or 'us'" if unit == "s" else "'V', 'mV' or 'kV'"
    try:
        factor = None if wanted is None else units.factor(units.plain(wanted), unit)
    except ValueError as error:
        raise InputError(key, got=f"{shown(given)} ({error})", takes=usual) from None
    known = head.unit in (*TIMES, *VOLTAGES, "A") or (head.unit and factor is None)
    if known:
        try:
            stated = units.factor(units.plain(head.unit), unit)
        except ValueError as error:
            raise InputError(path, f"has {shown(head.unit)} as unit of {head} ({error})", takes=usual) from None
        if factor is not None and factor != stated:
            raise InputError(key, got=f"{shown(given)}, but {path} states {shown(head.unit)} of {head}")
        return stated
    if factor is None:
        assumed.append(f"{head} is in {unit}")
        return 1.0
    return factor


class _Record:
    """Samples of a file, read block by block."""

    def __init__(self, path: Path, layout: Layout, choice: _Choice, *, keeps_times: bool) -> None:
        self.path, self.layout = path, layout
        self.spacing = Spacing(str(path))
        self.values: Array = np.empty(0)
        self.count = 0
        self.has_time = choice.time is not None
        # With a given interval, times may repeat; the first and the last one are compared with it.
        self.tests_times = keeps_times
        self.ends: list[tuple[float, str]] = []
        self.digits: list[list[str]] = [[], []]
        places = (choice.value.place, *([choice.time.place] if choice.time is not None else []))
        # Of a column that comes twice in the list, pandas would read one.
        self.columns = Columns(str(path), layout.dialect, places, layout.width)

    def read(self, first: bytes, rest: Iterator[bytes]) -> None:
        """Read all samples; the array of values grows with the file."""
        line = self.layout.first
        self._take(first, line)
        line += first.count(b"\n")
        for text in rest:
            self._take(text, line)
            line += text.count(b"\n")
        self.values.resize(self.count, refcheck=False)

    def _take(self, text: bytes, line: int) -> None:
        block = block_of(text, line, self.columns)
        values = block.values[0]
        if not values.size:
            return
        if self.count + values.size > self.values.size:
            self._grow(self.count + values.size)
        self.values[self.count : self.count + values.size] = values
        self.count += values.size
        if self.has_time:
            self._take_times(block)

    def _grow(self, least: int) -> None:
        """Make room for at least so many values; what is written stays."""
        size = max(least, 3 * self.values.size // 2)
        check_memory_for(self.path, 8.0 * (size - self.values.size), f"has above {self.count} samples")
        self.values.resize(size, refcheck=False)

    def _take_times(self, block: Block) -> None:
        times = block.values[1]
        if not self.ends:
            self.digits[0] = self._texts(block, last=False)
            self.ends = [(float(times[0]), "")]
        self.digits[1] = self._texts(block, last=True)
        self.ends[1:] = [(float(times[-1]), "")]
        if self.tests_times:
            self.spacing.add(times, block.line)

    def _texts(self, block: Block, *, last: bool) -> list[str]:
        place = self.columns.places[1]
        return [row[place] for row in block.fields(_COUNTED, last=last) if place < len(row) and row[place]]

    @property
    def resolution(self) -> float:
        """Last printed digit of the times, in their unit."""
        return resolution(self.layout.dialect.decimal, self.digits)


def _times(
    path: Path, record: _Record, heads: Heads, choice: _Choice, step: float | None
) -> tuple[float, float]:
    """Time of the first sample and sampling interval [s]."""
    if choice.time is None:
        return heads.start or 0.0, step if step is not None else heads.step or 0.0
    if step is None:
        factor = choice.time_factor
        interval = record.spacing.step(record.resolution)
        return record.spacing.first * factor, float(f"{interval * factor:.15g}")
    first, last = (at * choice.time_factor for at, _ in record.ends)
    told, given = last - first, step * (record.count - 1)
    if abs(told - given) > _SAME * given + 2.0 * record.resolution * choice.time_factor:
        says = f"{step:g} s, {given:.6g} s for {record.count} samples, but the times of {path} span {told:.6g} s"
        raise InputError("step", got=says)
    return first, step


def _of_reading(path: Path, record: _Record, heads: Heads, choice: _Choice) -> Iterator[ResultWarning]:
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
            f"{path}: {record.spacing.long} of {record.count - 1} distances between times are twice the others, "
            f"the first after sample {at}: times are rounded, or samples are missing; equal steps were taken"
        )
        yield ResultWarning("samples-missing", text)
