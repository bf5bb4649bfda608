"""Table ``duty`` of a bearing, a gear or a drive file, and the duty cycle in the file that it names."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ehlectric.arrays import Array
from ehlectric.cases.measurements import CYCLE, ColumnBook, Measurement, read_measurement
from ehlectric.cases.table import Table
from ehlectric.errors import InputError


class Duty(Table, book="duty"):
    """Duty cycle of a bearing, a drive or a gear pair: speed, loads, temperature and voltage over time."""

    file: str


@dataclass(frozen=True, eq=False)
class Cycle:
    """Rows of a duty cycle, SI units."""

    source: str  # path of the file
    lines: tuple[int, ...]  # line of each row in the file, from 1
    time: Array  # increasing [s], shape (n,)
    # Quantities of the rows besides the time by name, as their book has them, shape (n,).
    values: Mapping[str, Array]
    read: Measurement  # rows as read, with the heads of ignored columns and the lines of void rows

    @property
    def ignored(self) -> tuple[str, ...]:
        """Heads of columns that are not known, and of uncertainties, which are not used."""
        uncertain = (f"uncertainty of {name}" for name in self.read.uncertainties)
        return (*self.read.ignored, *uncertain)


def read_cycle(path: str | Path, book: ColumnBook = CYCLE) -> Cycle:
    """Read a duty cycle from a text file with units in its heads, such as ``time [s],speed [rpm]``; ``book``,
    quantities that its columns may have.

    Raises InputError if the file cannot be read or is too large; if it has no time, or nothing else; if it
    has fewer than two rows, or a time that does not increase; and for a value as ``read_measurement`` does.
    """
    read = read_measurement(path, book)
    values = dict(read.values)
    if "time" not in values:
        raise InputError.missing(f"{read.source}: time", "a column 'time [s]'")
    time = values.pop("time")
    if not values:
        text = "has no column but the time"
        raise InputError(read.source, text, takes=f"headings such as {book.examples}")
    if time.size < 2:
        raise InputError(read.source, "has one row", takes="at least two")
    back = np.flatnonzero(np.diff(time) <= 0.0)
    if back.size:
        place = int(back[0])
        raise InputError(
            read.source,
            f"line {read.lines[place + 1]}: got the time {time[place + 1]:.9g} s",
            takes=f"more than {time[place]:.9g} s, as the time increases from row to row",
        )
    return Cycle(read.source, read.lines, time, values, read)
