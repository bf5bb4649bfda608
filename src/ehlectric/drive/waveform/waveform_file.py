"""Waveforms of oscilloscopes: heads, units, times and voltages of a file.

What a file does not state is asked for by a key of ``[source]``, and never guessed from the numbers.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from itertools import chain
from pathlib import Path

import numpy as np

from ehlectric.arrays import Array
from ehlectric.drive.waveform.binary_files import READERS, read_binary
from ehlectric.drive.waveform.chosen_columns import Choice, Keys, choice_of
from ehlectric.drive.waveform.refusals import refuse_counts, refuse_scpi, refuse_stated, refuse_words
from ehlectric.drive.waveform.sample_quality import quality_warnings
from ehlectric.drive.waveform.sample_times import evened, timing
from ehlectric.drive.waveform.samples import LEAST_SAMPLES, MOST_BYTES, Samples, read_samples
from ehlectric.drive.waveform.text_heads import Labels, labels_of
from ehlectric.drive.waveform.waveform import Waveform
from ehlectric.errors import InputError
from ehlectric.quantities.result_warnings import ResultWarning
from ehlectric.readable import readable
from ehlectric.runtime.file_kinds import PEEKED, kind_of
from ehlectric.runtime.reading import regular
from ehlectric.runtime.sizes import check_memory_for
from ehlectric.runtime.text_table import Layout, layout_of, text_blocks

# Characters of the beginning, which shows the columns, and rows of it in which times are recognised.
_HEAD, _ROWS = 65_536, 1000

# Memory for a sample while it is read [bytes]: numbers, times, and their deviations from equal steps.
_MEMORY = 40.0

# Largest relative difference of a given interval from the interval that a file states.
_SAME = 0.01

# Largest credible voltage [V].
_MOST = 1e9


def read_waveform(
    path: str | Path,
    *,
    column: str | int | None = None,
    time_column: str | int | None = None,
    step: float | None = None,
    time_unit: str | None = None,
    value_unit: str | None = None,
    scale: float = 1.0,
    resample: float | None = None,
) -> tuple[Waveform, tuple[ResultWarning, ...]]:
    r"""Waveform [V] at equal steps [s] of a text file, and warnings: assumed units, and doubts about samples.

    ``column`` and ``time_column`` are names, or numbers from 1. A given ``step`` [s] replaces times that are
    missing or printed with too few digits. Uneven times are replaced by equal steps of ``resample`` [s] if it
    is given, by linear interpolation; even ones are kept. The file is read block by block. An InputError
    names the key that is needed, or the line that has no finite numbers or no later time.

    Examples
    --------
    >>> import tempfile
    >>> lines = ["Time (us),CH1 (kV)", *(f"{k},{0.001 * (-7) ** (k % 3)}" for k in range(20))]
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = Path(folder) / "scope.csv"
    ...     _ = file.write_text("\n".join(lines))
    ...     wave, warnings = read_waveform(file)
    >>> wave.values.size, wave.step, round(float(wave.values[1]), 9)
    (20, 1e-06, -7.0)
    """
    path = Path(path)
    keys = Keys(column, time_column, step, time_unit, value_unit, scale)
    keys.check()
    kind = _binary_kind(path)
    labels, choice, read = _of_text(path, keys) if kind is None else read_binary(path, kind, keys)
    if read.values.size < LEAST_SAMPLES:
        raise InputError(path, f"has {read.values.size} samples", takes=f"at least {LEAST_SAMPLES}")
    refuse_scpi(path, read)
    refuse_counts(path, labels, read.values, choice.factor, keys)
    count = read.values.size
    read, uneven = evened(path, read, choice, resample if step is None else None, scale)
    start, interval, gaps = timing(path, read, choice, step)
    waveform = Waveform(start, interval, _volts(path, read.values, choice, scale))
    warnings = (
        *_of_reading(path, labels, choice, count, read.spare),
        *_of_step(path, labels, step),
        *gaps,
        *uneven,
    )
    return waveform, (*warnings, *quality_warnings(str(path), waveform))


def _binary_kind(path: Path) -> str | None:
    """Kind of a binary file that a library reads; None for text, whose reader names all other kinds."""
    with regular(path) as file:
        kind = kind_of(file.read(PEEKED))
    return kind if kind in READERS else None


def _of_text(path: Path, keys: Keys) -> tuple[Labels, Choice, Samples]:
    """Labels, columns and samples of a file of text."""
    content = text_blocks(path, most=MOST_BYTES)
    beginning = next(content, "")
    lines = beginning[: beginning.find("\n", _HEAD) + 1 or None].split("\n")
    layout = None
    try:
        layout = layout_of(path, lines)
        labels = labels_of(layout, lines)
        refuse_stated(path, labels)
        choice = choice_of(path, labels, keys, partial(_first_numbers, layout, lines))
        count = path.stat().st_size * (beginning.count("\n") + 1) / len(beginning)
        check_memory_for(path, _MEMORY * count, f"has some {readable(count, 2)} samples")
        read = read_samples(path, layout, choice.places, chain([layout.below(beginning)], content))
    except InputError as error:
        if error.key == str(path):
            refuse_words(path, layout)
        raise
    return labels, choice, read


def _first_numbers(layout: Layout, lines: list[str], place: int) -> Array:
    """Numbers of a column in the first rows."""
    rows = map(layout.dialect.fields, lines[layout.first : layout.first + _ROWS])
    numbers = [layout.dialect.number(row[place]) for row in rows if place < len(row)]
    return np.array([number for number in numbers if number is not None])


def _volts(path: Path, values: Array, choice: Choice, scale: float) -> Array:
    """Voltages [V] of numbers, which are changed; constant ones and those beyond all machines are refused."""
    with np.errstate(over="ignore"):
        values *= choice.factor * scale
    low, high = float(np.min(values)), float(np.max(values))
    if max(abs(low), abs(high)) > _MOST:
        takes = f"at most {_MOST:g} V; are unit and scale right?"
        raise InputError(path, f"has {low:g} to {high:g} V in {choice.value}", takes=takes)
    if low == high:
        raise InputError(path, f"is constant, all {values.size} samples of {choice.value} are {low:g} V")
    return values


def _of_reading(
    path: Path, labels: Labels, choice: Choice, count: int, spare: int
) -> Iterator[ResultWarning]:
    """Warnings about units that the file does not state, and about a length that it does not have.

    ``count`` is the number of samples, and ``spare`` the number of rows at the end without a voltage.
    """
    if choice.assumed:
        assumptions = " and that ".join(choice.assumed)
        yield ResultWarning.of("units-assumed", file=path, assumptions=assumptions)
    if spare:
        yield ResultWarning.of(
            "samples-missing", "channel", file=path, spare=spare, rows=count + spare, head=choice.value
        )
        return
    points = max((each.number or 0.0 for each in labels.of("length")), default=0.0)
    if count < points:
        yield ResultWarning.of("samples-missing", "cut_off", file=path, stated=points, count=count)


def _of_step(path: Path, labels: Labels, step: float | None) -> Iterator[ResultWarning]:
    """Warning about the user's sampling interval, if the file states other ones only."""
    stated = list(labels.intervals())
    if step is not None and stated and all(abs(step / value - 1.0) > _SAME for _, value in stated):
        yield ResultWarning.of("samples-missing", "interval", file=path, stated=stated[0][0], step=step)
