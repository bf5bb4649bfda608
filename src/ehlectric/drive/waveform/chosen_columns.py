"""Columns of a waveform that are read, and their factors to SI units.

What a file does not state is asked for by a key of ``[source]``, and never guessed from the numbers.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ehlectric.arrays import Array
from ehlectric.drive.waveform.text_heads import Head, Labels, is_current, unit_of
from ehlectric.errors import InputError, shown
from ehlectric.quantities import units

# Most columns that an error lists.
_LISTED = 9

# Units that errors propose.
_USUAL = {"s": "'s', 'ms' or 'us'", "V": "'V', 'mV' or 'kV'"}

# Least share of increasing distances in a column of times, and largest deviation of times from equal steps
# by which a column without a head is recognised as times [steps].
_INCREASING, _EQUAL = 0.9, 0.05

# Words by which heads name the two columns of an envelope.
_EXTREME = re.compile(r"(?<![a-z])(min|max)(?:imum)?(?![a-z])", re.IGNORECASE)


@dataclass(frozen=True)
class Keys:
    """Keys of ``[source]`` that state what a file does not."""

    column: str | int | None = None
    time_column: str | int | None = None
    step: float | None = None  # sampling interval [s]
    time_unit: str | None = None
    value_unit: str | None = None
    scale: float = 1.0

    def check(self) -> None:
        """Refuse a step or a factor without a meaning."""
        if self.step is not None and not 0.0 < self.step < np.inf:
            raise InputError("step", got=self.step, takes="a sampling interval above 0 s")
        if not np.isfinite(self.scale) or self.scale == 0.0:
            raise InputError("scale", got=self.scale, takes="a finite factor other than 0")


@dataclass(frozen=True)
class Choice:
    """Columns of voltage and time, factors to SI units, and units that nobody states and that are assumed."""

    value: Head
    factor: float
    time: Head | None
    time_factor: float
    assumed: tuple[str, ...]

    @property
    def places(self) -> tuple[int, ...]:
        """Places of the voltages, and of the times where the file contains them."""
        return (self.value.place, *(() if self.time is None else (self.time.place,)))


def choice_of(path: Path, labels: Labels, keys: Keys, peek: Callable[[int], Array]) -> Choice:
    """Columns that are read. ``peek`` returns the first numbers of the column at a place."""
    heads = labels.heads
    times = _times(path, labels, keys, peek)
    channels = [head for head in heads if head not in times and not head.is_numbering]
    value = _named(path, "column", keys.column, heads) if keys.column is not None else _single(path, channels)
    if value in times:
        raise InputError(
            "column", got=shown(keys.column), takes="a column of voltages, not the column of times"
        )
    _refuse_envelope(path, value, heads)
    # Some programs write times before every channel.
    before = [head for head in times if head.place < value.place]
    time = (before or times[:1])[-1] if times else None
    if time is None and keys.step is None:
        raise InputError.worded("step", f"missing; {path} has {_no_times(labels)}")
    assumed: list[str] = []
    factor = _factor(path, labels, value, ("value_unit", keys.value_unit, "V"), assumed)
    of_time = ("time_unit", keys.time_unit, "s")
    time_factor = 1.0 if time is None else _factor(path, labels, time, of_time, assumed)
    return Choice(value, factor, time, time_factor, tuple(assumed))


def _times(path: Path, labels: Labels, keys: Keys, peek: Callable[[int], Array]) -> list[Head]:
    """Columns of times: as the user or the heads name them, or the first one of a file without heads."""
    heads = labels.heads
    unnamed, unread = not any(head.name or head.unit for head in heads), labels.above
    if keys.time_column is not None:
        return [_named(path, "time_column", keys.time_column, heads)]
    if not unnamed or len(heads) < 2:
        return [head for head in heads if head.is_time]
    if unread and keys.step is None:
        what = f"{path} has no names of its {len(heads)} columns in {shown(unread)} above them"
        raise InputError.worded("time_column", f"missing; {what}; expected the number of one, such as 1")
    if unread:
        return []
    first = peek(heads[0].place)
    if keys.step is None and len(heads) > 2 and first.size > 1 and np.all(np.diff(first) == 1.0):
        what = f"{path} has no names of its {len(heads)} columns, and column 1 may number the samples"
        raise InputError.worded("time_column", f"missing; {what}; expected the number of a column")
    return heads[:1] if _first_is_time(path, keys, first) else []


def _first_is_time(path: Path, keys: Keys, numbers: Array) -> bool:
    """Whether the first column of a file without heads contains times; ``numbers``, its first ones."""
    gaps = np.diff(numbers)
    increases = bool(np.mean(gaps > 0.0) > _INCREASING) if gaps.size else False
    if keys.column == 1 and keys.step is not None:
        if increases and np.ptp(gaps) < _EQUAL * np.mean(gaps):
            got = f"1, but column 1 of {path} increases in equal steps, as times do"
            raise InputError("column", got=got, takes="a column of voltages")
        return False
    if not increases and keys.step is None and gaps.size:
        what = f"{path} has no names of its columns, and column 1 does not increase as times do"
        raise InputError.worded("step", f"missing; {what}; expected a sampling interval, such as 4e-9")
    return increases


def _refuse_envelope(path: Path, value: Head, heads: Sequence[Head]) -> None:
    """Refuse a column of minima or maxima with the other one next to it."""
    word = _EXTREME.search(value.name)
    if word is None:
        return
    pattern = _EXTREME.sub("*", value.name).casefold()
    for head in heads:
        other = _EXTREME.search(head.name)
        same = _EXTREME.sub("*", head.name).casefold() == pattern
        if other is not None and same and other[1].lower() != word[1].lower():
            raise InputError(path, envelope(f"in {value} and {head}"))


def envelope(where: str) -> str:
    """Text about a file with pairs of minimum and maximum, as an acquisition of peaks saves them."""
    return (
        f"contains an envelope, pairs of minimum and maximum {where}; save the samples without peak detection"
    )


def _no_times(labels: Labels) -> str:
    """Columns of a file without times, the line that may have its interval, and what to give."""
    states = "" if labels.interval is None else f", and the line {shown(labels.interval)}"
    return (
        f"no column of times that is known, but {_listed(labels.heads)}{states}; expected a sampling "
        "interval, such as 4e-9 or '4 ns', or the name or number of the column of times as time_column"
    )


def _named(path: Path, key: str, requested: str | int, heads: Sequence[Head]) -> Head:
    """Column of a name or a number."""
    if isinstance(requested, int):
        matches = [head for head in heads if head.place + 1 == requested]
        called = [head for head in heads if head.name == str(requested) and head not in matches]
        if called and matches:
            got = f"{requested}, the number of {matches[0]} and the name of {called[0]} in {path}"
            raise InputError(key, got=got, takes="the name of a column in quotes")
    else:
        # Fields of forms take a number in quotes as a name.
        name = " ".join(requested.strip(" \"'").split()).casefold()
        matches = [head for head in heads if name in (head.name.casefold(), head.written.casefold())]
    if len(matches) != 1:
        raise InputError(key, got=f"{shown(requested)}, but {path} has the columns {_listed(heads)}")
    return matches[0]


def _listed(heads: Sequence[Head]) -> str:
    return ", ".join(str(head) for head in heads[:_LISTED]) + ", ..." * (len(heads) > _LISTED)


def _single(path: Path, channels: Sequence[Head]) -> Head:
    """The only voltage of a file, or its only column without a unit if it has no voltage."""
    voltages = [head for head in channels if head.base == "V"]
    candidates = voltages or [head for head in channels if not head.unit] or list(channels)
    if not candidates:
        raise InputError(
            path, "has one column of numbers, which are times", takes="also a column of voltages"
        )
    if len(candidates) > 1:
        listed = f"{path} has the channels {_listed(candidates)}"
        raise InputError.worded(
            "column", f"missing; {listed}; expected the name or the number of one of them"
        )
    return candidates[0]


def _factor(
    path: Path, labels: Labels, head: Head, unit_input: tuple[str, str | None, str], assumed: list[str]
) -> float:
    """Factor from the unit of a column to the SI unit: as its head, the user or a line above states it.

    ``unit_input`` are the key of the unit, the unit that the user gave, and the SI unit. A unit that nobody
    states is taken as the SI unit and added to ``assumed``.
    """
    key, given, base = unit_input
    requested = None if given is None else _factor_of(key, given, base, f"got {shown(given)}")
    if head.base or (head.unit and requested is None):
        stated = _factor_of(path, head.unit, base, f"has {shown(head.unit)} as unit of {head}")
        return _agreed(path, f"{shown(head.unit)} of {head}", unit_input, stated, requested)
    above = labels.units_above(base)
    factors = {unit_of(value)[1] for value in above if unit_of(value)[0] == base}
    if not above and labels.above and not head.name:
        # The line above the numbers could not be read, and may state the unit.
        above = [labels.above]
    if len(factors) == 1 and all(unit_of(value)[0] == base for value in above):
        return _agreed(path, f"{shown(above[0])} above its numbers", unit_input, factors.pop(), requested)
    if requested is not None and factors <= {requested}:
        return requested
    if above:
        says = "missing;" if given is None else f"got {shown(given)}, but"
        states = f"{path} states {shown(', '.join(above))} above its numbers"
        raise InputError.worded(key, f"{says} {states}; expected the unit of {head}, such as {_USUAL[base]}")
    if requested is None and base == "V" and is_current(head.name):
        raise InputError.worded(
            key, f"missing; {head} of {path} may be a current; expected the unit, such as {_USUAL[base]}"
        )
    assumed.append(f"{head} is in {base}")
    return 1.0


def _agreed(
    path: Path,
    where: str,
    unit_input: tuple[str, str | None, str],
    stated: float,
    requested: float | None,
) -> float:
    """Factor that a file states, if the user gave no other one; a unit in doubt needs the user's."""
    key, given, base = unit_input
    if requested is not None and (requested == stated or math.isnan(stated)):
        return requested
    if requested is not None:
        raise InputError(key, got=f"{shown(given)}, but {path} states {where}")
    if math.isnan(stated):
        what = f"missing; {path} states {where}, which may be two units"
        raise InputError.worded(key, f"{what}; expected {_USUAL[base]}")
    return stated


def _factor_of(source: object, unit: str, base: str, says: str) -> float:
    """Factor of a unit to the SI unit; an error has the key or the file as ``source``, and ``says``.

    NaN for a unit in doubt, such as "MV" in a head; the user's own "MV" are megavolts.
    """
    known, factor = unit_of(unit)
    if known == base and not (math.isnan(factor) and isinstance(source, str)):
        return factor
    try:
        return units.factor(unit, base)
    except ValueError as error:
        key = "" if isinstance(source, str) else f", or {'time' if base == 's' else 'value'}_unit"
        raise InputError(source, f"{says} ({error})", takes=f"{_USUAL[base]}{key}") from None
