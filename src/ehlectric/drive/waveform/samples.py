"""Samples of a waveform in text: the numbers of its columns, and the lines in which they are."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from itertools import islice
from pathlib import Path

import numpy as np

from ehlectric.arrays import Array
from ehlectric.errors import InputError
from ehlectric.runtime.text_table import Layout, text_blocks

# Smallest number of samples of a waveform.
LEAST_SAMPLES = 16

# Largest size of a file [bytes]: about 100 million samples of time and voltage.
MOST_BYTES = 2_000_000_000

# Rows at each end of a file whose printed digits are counted, in some characters there.
_COUNTED, _ENDS = 40, 8000


def _number_of(index: int) -> str:
    return f"sample {index + 1}"


@dataclass(frozen=True, eq=False)
class Samples:
    """Voltages and times in the units of the file, and the last printed digit of the times."""

    values: Array
    times: Array
    digit: float = 0.0
    place: Callable[[int], str] = _number_of  # name of the place of a sample, by its index from 0
    spare: int = 0  # number of rows at the end without a voltage


def read_samples(path: Path, layout: Layout, places: tuple[int, ...], blocks: Iterable[str]) -> Samples:
    """Numbers of the columns at ``places``, voltages first; the blocks are the text below the header.

    A channel may be shorter than the others: rows at the end may lack its voltages.
    """
    parts: list[tuple[Array, ...]] = []
    line, head, tail = layout.first + 1, "", ""
    spare, ended = 0, None
    for text in blocks:
        try:
            columns = layout.numbers(path, places, text, line)
        except InputError as error:
            columns, ended = layout.numbers(path, places, text, line, voids=places), ended or error
        count = int(np.count_nonzero(~np.isnan(columns[0])))
        if ended is not None and ((spare and count) or any(np.isnan(each[:count]).any() for each in columns)):
            raise ended
        spare += columns[0].size - count
        parts.append(tuple(each[:count] for each in columns))
        line += text.count("\n")
        head, tail = head or text[:_ENDS], (tail + text[-_ENDS:])[-_ENDS:]
    values, times = (
        np.concatenate([each[k] for each in parts]) if k < len(places) else np.empty(0) for k in (0, 1)
    )
    # The last line of the one text may be cut off, and the first one of the other.
    ends = head.split("\n")[:-1][:_COUNTED], tail.split("\n")[1:][-_COUNTED:]
    digit = layout.last_digit(places[-1], ends) if times.size else 0.0
    return Samples(values, times, digit, lambda index: f"line {line_of(path, layout, index)}", spare)


def numbered_lines(path: Path) -> Iterator[tuple[int, str]]:
    """Lines of a text file with their numbers from 1."""
    line = 1
    for text in text_blocks(path, most=MOST_BYTES):
        lines = text.split("\n")
        yield from enumerate(lines if lines[-1] else lines[:-1], line)
        line += len(lines) - 1


def line_of(path: Path, layout: Layout, index: int) -> int:
    """Number of the line of a sample by its index from 0, for messages: the file is read again."""
    below = islice(numbered_lines(path), layout.first, None)
    return next(islice((number for number, line in below if any(layout.dialect.fields(line))), index, None))
