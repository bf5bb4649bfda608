"""Columns of time and voltage among the columns of a file, with their units."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from ehlectric.drive.source.text.heads import Head, Heads
from ehlectric.drive.source.text.spelling import TIMES, VOLTAGES, unit_of
from ehlectric.errors import InputError, shown
from ehlectric.quantities import units

# Most columns that an error lists: as many as an oscilloscope has channels, with their times.
_LISTED = 9


@dataclass(frozen=True)
class Choice:
    """Columns of time and voltage, with the factors to SI units.

    Attributes
    ----------
    value, time : Head
        Columns; no time where the file has none.
    factor, time_factor : float
        Factors to volts and seconds.
    assumed : tuple of str
        Units that nobody states and that were assumed.
    """

    value: Head
    factor: float
    time: Head | None
    time_factor: float
    assumed: tuple[str, ...]

    @property
    def times_assumed(self) -> bool:
        """Whether seconds are assumed as the unit of the times."""
        return f"{self.time} is in s" in self.assumed


def choice_of(
    path: Path,
    heads: Heads,
    column: str | int | None,
    time_column: str | int | None,
    given: tuple[str | None, str | None],
    step: float | None,
) -> Choice:
    """Columns that are read.

    Parameters
    ----------
    path : Path
        File, for errors.
    heads : Heads
        Heads of its columns.
    column, time_column : str, int or None
        Names or numbers of the columns that the user gave.
    given : tuple of str or None
        Units of time and voltage that the user gave.
    step : float or None
        Sampling interval that the user gave [s].

    Returns
    -------
    Choice
        Columns and factors.

    Raises
    ------
    InputError
        If the file does not show which columns are meant, or a unit is not one of time or voltage. The
        columns among which the user must choose are listed.
    """
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
        raise InputError.worded(
            key, f"missing; {path} has no column of times that is known; expected {takes}"
        )
    assumed: list[str] = []
    factor = _factor(path, value, "value_unit", given[1], "V", assumed)
    time_factor = 1.0 if time is None else _factor(path, time, "time_unit", given[0], "s", assumed)
    return Choice(value, factor, time, time_factor, tuple(assumed))


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
    return ", ".join(str(head) for head in columns[:_LISTED]) + ", ..." * (len(columns) > _LISTED)


def _single(path: Path, channels: Sequence[Head]) -> Head:
    """The only voltage of a file, or its only column without a unit if it has no voltage."""
    voltages = [head for head in channels if head.unit in VOLTAGES]
    candidates = voltages or [head for head in channels if not head.unit] or list(channels)
    if not candidates:
        raise InputError(
            path, "has one column of numbers, which are times", takes="a column of voltages, too"
        )
    if len(candidates) > 1:
        listed = f"{path} has the channels {_listed(candidates)}"
        raise InputError.worded(
            "column", f"missing; {listed}; expected the name or the number of one of them"
        )
    return candidates[0]


def _factor(path: Path, head: Head, key: str, given: str | None, unit: str, assumed: list[str]) -> float:
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
            raise InputError(
                path, f"has {shown(head.unit)} as unit of {head} ({error})", takes=usual
            ) from None
        if factor is not None and factor != stated:
            raise InputError(key, got=f"{shown(given)}, but {path} states {shown(head.unit)} of {head}")
        return stated
    if factor is None:
        assumed.append(f"{head} is in {unit}")
        return 1.0
    return factor
