"""Table ``duty`` of a bearing, a gear or a drive file, and the duty cycle in the file that it names."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from ehlectric.arrays import Array
from ehlectric.cases.measurements import CYCLE, VEHICLE_SPEED, ColumnBook, Measurement, read_measurement
from ehlectric.cases.table import Table
from ehlectric.errors import InputError, shown

# Example of the table of a vehicle, in messages.
_VEHICLE = "vehicle = { wheel_radius = '0.32 m', ratio = 9 } in [duty]"


class Vehicle(Table, book="duty.vehicle"):
    """Wheels of a vehicle, and the ratio of their speed, for a duty cycle with the speed of the vehicle."""

    wheel_radius: float
    ratio: float | None = None
    shaft: str | None = None

    def shaft_speed(self, speed: Array, ratio: float) -> Array:
        r"""Return the speed of the shaft [rad/s], shape (n,).

        .. math:: \omega = i v / r,

        with the speed v of the vehicle [m/s], the radius r of its wheels [m], and the ratio i of the speed of
        the shaft to the speed of the wheels. The wheels roll without slip.

        Examples
        --------
        >>> vehicle = Vehicle(wheel_radius="0.5 m", ratio=10.0)
        >>> vehicle.shaft_speed(np.array([20.0]), 10.0)
        array([400.])
        """
        return speed * (ratio / self.wheel_radius)


class Duty(Table, book="duty"):
    """Duty cycle of a bearing, a drive or a gear pair: speed, loads, temperature and voltage over time."""

    file: str
    vehicle: Vehicle | None = None


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


def read_cycle(duty: Duty, book: ColumnBook = CYCLE, ratio: float | None = None) -> Cycle:
    """Read a duty cycle from a text file with units in its heads, such as ``time [s],speed [rpm]``; ``book``,
    quantities that its columns may have; ``ratio``, speed of the shaft divided by the speed of the wheels, of
    an axle that contains it.

    Raises InputError if the file cannot be read or is too large; if it has no time, or nothing else; if it
    has fewer than two rows, or a time that does not increase; if it has the speed of a vehicle and ``duty``
    does not describe the vehicle; and for a value as ``read_measurement`` does.
    """
    read = read_measurement(duty.file, book)
    values = _of_shaft(read, duty.vehicle, book, ratio)
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


def _of_shaft(
    read: Measurement, vehicle: Vehicle | None, book: ColumnBook, ratio: float | None
) -> dict[str, Array]:
    """Values of a cycle in which the vehicle speed is converted to the speed of the shaft."""
    values = dict(read.values)
    speed = values.pop(VEHICLE_SPEED, None)
    if vehicle is None:
        if speed is not None:
            got = f"column {shown(read.heads[VEHICLE_SPEED])} is a speed of the vehicle"
            takes = f"a column 'speed [rpm]' with the speed {_shaft_of(book)}, or {_VEHICLE}"
            raise InputError(read.source, got, takes=takes)
        return values
    if speed is None:
        known = "the column 'speed [rpm]'" if "speed" in values else "no column 'vehicle speed [km/h]'"
        got = f"is given, and the file of the cycle has {known}"
        raise InputError(
            "duty.vehicle", got, takes="a vehicle speed or the speed of the shaft, one of the two"
        )
    if ratio is None:
        if vehicle.shaft is not None:
            raise InputError.worded("duty.vehicle.shaft", "is only used by an axle with shafts")
        if vehicle.ratio is None:
            text = f"the speed {_shaft_of(book)} divided by the speed of the wheels"
            raise InputError.missing("duty.vehicle.ratio", text)
        ratio = vehicle.ratio
    elif vehicle.ratio is not None:
        text = "is not used by an axle: the ratio follows from its meshes; omit it"
        raise InputError.worded("duty.vehicle.ratio", text)
    turns = vehicle.shaft_speed(speed, ratio)
    column = book.columns["speed"]
    wrong = np.flatnonzero(np.abs(turns) > column.most)
    if wrong.size:
        line = read.lines[int(wrong[0])]
        got = f"line {line}: got a speed of the shaft of {turns[wrong[0]]:.3g} rad/s"
        raise InputError(read.source, got, takes=f"at most {column.most:g} rad/s: check duty.vehicle")
    return values | {"speed": turns}


def _shaft_of(book: ColumnBook) -> str:
    """Shaft whose speed a cycle contains, as in its book."""
    return book.columns["speed"].reason.partition(",")[0]
