"""Samples of a file, read block by block."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import chain

import numpy as np

from ehlectric.arrays import Array
from ehlectric.drive.source.text.dialect import Layout
from ehlectric.drive.source.text.numbers import Block, Columns, block_of
from ehlectric.drive.source.text.spacing import Spacing, resolution
from ehlectric.runtime.sizes import check_memory_for

# Rows at each end of a file whose printed digits are counted.
_COUNTED = 40


class Record:
    """Samples of a file, read block by block.

    Parameters
    ----------
    source : str
        Name of the file in errors.
    layout : Layout
        Dialect and columns of the file.
    places : tuple of int
        Place of the voltages, and of the times where the file has them.
    tests_times : bool
        Whether times must be evenly spaced. With a given interval they may repeat, and only both ends count.

    Attributes
    ----------
    values : ndarray, shape (n,)
        Voltages in the unit of the file.
    count : int
        Number of samples.
    ends : tuple of float
        First and last time, in the unit of the file.
    spacing : Spacing
        Test of the times.
    """

    def __init__(self, source: str, layout: Layout, places: tuple[int, ...], *, tests_times: bool) -> None:
        self.values: Array = np.empty(0)
        self.count = 0
        self.ends = (np.nan, np.nan)
        self.spacing = Spacing(source)
        self._columns = Columns(source, layout.dialect, places, layout.width)
        self._line = layout.first
        self._tests_times = tests_times
        self._digits: tuple[list[str], list[str]] = ([], [])

    def read(self, first: bytes, rest: Iterator[bytes]) -> None:
        """Read all samples; the array of values grows with the file."""
        for text in chain([first], rest):
            self._take(text)
            self._line += text.count(b"\n")
        self.values.resize(self.count, refcheck=False)

    def _take(self, text: bytes) -> None:
        block = block_of(text, self._line, self._columns)
        values = block.values[0]
        if not values.size:
            return
        if self.count + values.size > self.values.size:
            self._grow(self.count + values.size)
        self.values[self.count : self.count + values.size] = values
        self.count += values.size
        if len(block.values) > 1:
            self._take_times(block)

    def _grow(self, least: int) -> None:
        """Make room for at least so many values; what is written stays."""
        size = max(least, 3 * self.values.size // 2)
        check_memory_for(
            self.spacing.source, 8.0 * (size - self.values.size), f"has above {self.count} samples"
        )
        self.values.resize(size, refcheck=False)

    def _take_times(self, block: Block) -> None:
        times = block.values[1]
        first = not self._digits[0]
        self.ends = (float(times[0]) if first else self.ends[0], float(times[-1]))
        self._digits = (_texts(block, last=False) if first else self._digits[0], _texts(block, last=True))
        if self._tests_times:
            self.spacing.add(times, block.line)

    @property
    def resolution(self) -> float:
        """Last printed digit of the times, in their unit."""
        return resolution(self._columns.dialect.decimal, self._digits)


def _texts(block: Block, *, last: bool) -> list[str]:
    """Texts of the first or last times of a block."""
    place = block.columns.places[1]
    return [row[place] for row in block.fields(_COUNTED, last=last) if place < len(row) and row[place]]
