"""Heads of the columns of an oscilloscope's file, their units, and what the lines above them state."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field

from ehlectric.cases import units
from ehlectric.drive.source.text.dialect import Dialect, Layout, bare

# Units as oscilloscopes and people write them, in small letters.
_WORDS = (
    dict.fromkeys(("s", "sec", "secs", "second", "seconds"), "s")
    | dict.fromkeys(("ms", "millisecond", "milliseconds"), "ms")
    | dict.fromkeys(("us", "µs", "usec", "microsecond", "microseconds"), "us")
    | dict.fromkeys(("ns", "nanosecond", "nanoseconds"), "ns")
    | dict.fromkeys(("ps", "picosecond", "picoseconds"), "ps")
    | dict.fromkeys(("v", "volt", "volts"), "V")
    | dict.fromkeys(("uv", "µv", "microvolt", "microvolts"), "uV")
    | dict.fromkeys(("kv", "kilovolt", "kilovolts"), "kV")
    | dict.fromkeys(("a", "amp", "amps", "ampere", "amperes"), "A")
    | {"millivolt": "mV", "millivolts": "mV"}
)
TIMES = ("s", "ms", "us", "ns", "ps")
VOLTAGES = ("V", "mV", "uV", "kV")

# "Unit" of a column that numbers the samples, and names of such columns.
NUMBERING = "sequence"
_NUMBERINGS = ("nr", "no", "no.", "#", "index", "sample", "samples", "point", "points", NUMBERING)
_TIME_NAMES = ("time", "t", "zeit", "temps", "tiempo", "tempo", "x-axis", "x", "timestamp")

# Keys of the lines above the numbers, in small letters.
_STEP = ("sample interval", "sampling interval", "sampling period", "sample period", "xinc", "xincr", "dt")
_STEP += ("x increment", "increment", "delta", "time interval", "tdelta", "hresolution")
_RATE = ("sample rate", "sampling rate", "sampling frequency", "sample frequency")
_START = ("start", "xorg", "xzero", "x origin", "tstart")
_POINTS = ("record length", "memory length", "waveform length", "data length", "points", "segmentsize")
_X_UNIT = ("horizontal units", "horizontal unit", "x unit", "x units", "xunits", "hunit")
_Y_UNIT = ("vertical units", "vertical unit", "y unit", "y units", "yunits", "vunit")

# First words of other keys, which are no names of columns.
_OTHER = ("model", "serial", "firmware", "vertical", "horizontal", "trigger", "probe", "label", "record", "memory")
_OTHER += ("sample", "sampling", "waveform", "gating", "date", "display", "average", "channels", "version")

# Prefixes of a sampling rate such as 1.25 GSa/s.
_PREFIXES = {"": 1.0, "k": 1e3, "K": 1e3, "M": 1e6, "G": 1e9}

# Longest text of a value in a line above the numbers [characters].
_LONGEST = 60


@dataclass(frozen=True)
class Head:
    """Head of a column.

    Attributes
    ----------
    place : int
        Place of the column, from 0.
    name : str
        Name; empty if the file has none.
    unit : str
        Unit in the spelling of pint, or as it is written if it is not known; empty if the file has none.
    """

    place: int
    name: str = ""
    unit: str = ""

    @property
    def is_numbering(self) -> bool:
        """Whether the column numbers the samples."""
        return self.unit == NUMBERING or (not self.unit and self.name.lower() in _NUMBERINGS)

    @property
    def is_time(self) -> bool:
        """Whether the column is a time by its unit, or by its name if it has no unit."""
        if self.unit:
            return self.unit in TIMES
        return not self.is_numbering and self.name.lower() in _TIME_NAMES

    def __str__(self) -> str:
        return f"{self.name or 'without a name'} (column {self.place + 1})"


@dataclass(frozen=True)
class Heads:
    """Heads of all columns of numbers, and what the lines above them state.

    Attributes
    ----------
    columns : tuple of Head
        Heads in the order of the columns.
    named : bool
        Whether the file has names or units of its columns.
    step, start : float or None
        Sampling interval and time of the first sample that the file states [s].
    points : int or None
        Number of samples that the file states.
    """

    columns: tuple[Head, ...]
    named: bool
    step: float | None = None
    start: float | None = None
    points: int | None = None


@dataclass
class _Stated:
    step: float | None = None
    start: float | None = None
    points: int | None = None
    units: dict[str, list[str]] = field(default_factory=dict)


def heads_of(layout: Layout) -> Heads:
    """Heads of the columns of numbers, and what the lines above them state.

    Parameters
    ----------
    layout : Layout
        Dialect and columns of the file, with the lines above the numbers.

    Returns
    -------
    Heads
        Names and units, empty where the file has none, and stated intervals and lengths.
    """
    stated = _Stated()
    for key, values in _keys(layout):
        _take(stated, key, values)
    names, below = _rows(layout)
    for place, name in enumerate(names):
        number = layout.dialect.number(below[place]) if place < len(below) else None
        if place not in layout.columns and number is not None:
            _take(stated, _key(name), [below[place]])
    columns = []
    for place in layout.columns:
        name, unit = parts(names[place] if place < len(names) else "")
        other = _unit(below[place]) if place < len(below) else ""
        columns.append(Head(place, name, other or unit))
    named = any(head.name or head.unit for head in columns)
    columns = _with_stated(columns, stated.units)
    return Heads(tuple(columns), named, stated.step, stated.start, stated.points)


def _with_stated(columns: Sequence[Head], stated: Mapping[str, Sequence[str]]) -> list[Head]:
    """Heads with the units that lines such as "Vertical Units,V" state."""
    unnamed = not any(head.name or head.unit for head in columns)
    result, channels = [], 0
    for k, head in enumerate(columns):
        time = head.is_time or (unnamed and k == 0 and len(columns) > 1)
        found = stated.get("x" if time else "y", ())
        at = 0 if time else channels
        channels += not time
        if head.unit or not found or head.is_numbering:
            result.append(head)
        else:
            result.append(Head(head.place, head.name, _unit(found[min(at, len(found) - 1)])))
    return result


def _keys(layout: Layout) -> Iterator[tuple[str, list[str]]]:
    """Keys and values of the lines above the numbers, and of columns to the left of them."""
    lines = [bare(line) for line in layout.header]
    if min(layout.columns) > 1:
        lines += list(layout.rows)
    for line in lines:
        row = layout.dialect.fields(line)
        if len([text for text in row if text]) == 1:
            # "Sample Interval: 4 ns" has no separator of columns.
            text = next(text for text in row if text)
            mark = next((mark for mark in (":", "=") if mark in text), None)
            row = list(text.partition(mark)[::2]) if mark else row
        if min(layout.columns) > 1:
            row = row[: min(layout.columns)]
        values = [text.strip() for text in row[1:] if text.strip()]
        if row and values:
            yield _key(row[0]), values
        # LeCroy has "Segments,1,SegmentSize,502".
        for name, value in zip(row[2::2], row[3::2], strict=False):
            if _key(name) == "segmentsize":
                yield "segmentsize", [value]


def _key(text: str) -> str:
    return " ".join(text.lower().replace("_", " ").split()).rstrip(": ")


def _take(stated: _Stated, key: str, values: Sequence[str]) -> None:
    """Take over the value of a known key; the first one counts."""
    if key in _STEP and stated.step is None:
        step = _amount(values[0])
        stated.step = step if step is not None and step > 0.0 else None
    elif key in _RATE and stated.step is None:
        rate = _rate(values[0])
        stated.step = None if rate is None or rate <= 0.0 else 1.0 / rate
    elif key in _START and stated.start is None:
        stated.start = _amount(values[0])
    elif key in _POINTS and stated.points is None:
        number = _plain(values[0].rpartition(":")[2])
        stated.points = int(number) if number is not None and 0 < number < 1e15 else None
    elif key in _X_UNIT:
        stated.units.setdefault("x", list(values))
    elif key in _Y_UNIT:
        stated.units.setdefault("y", [value.rpartition(":")[2].strip() for value in values])


def _plain(text: str) -> float | None:
    """Number with a decimal point or comma; None for other texts."""
    text = text.strip()
    return Dialect(None, "." if "." in text else ",").number(text) if len(text) <= _LONGEST else None


def _split(text: str) -> tuple[float | None, str]:
    """Number at the beginning of a short text, and the rest."""
    text = text.strip()[:_LONGEST]
    for end in range(len(text), 0, -1):
        number = _plain(text[:end])
        if number is not None:
            return number, text[end:].strip()
    return None, text


def _amount(text: str) -> float | None:
    """Time [s] of a text such as "4e-09" or "4 ns"; None for other texts."""
    number, rest = _split(text)
    unit = _unit(rest) if rest else "s"
    return number * units.factor(unit, "s") if number is not None and unit in TIMES else None


def _rate(text: str) -> float | None:
    """Sampling rate [1/s] of a text such as "1.00GSa/s" or "5 MHz"; None for other texts."""
    number, rest = _split(text.rpartition(":")[2])
    for ending in ("sa/s", "sps", "s/s", "hz"):
        if rest.lower().endswith(ending):
            rest = rest[: -len(ending)].strip()
            break
    factor = _PREFIXES.get(rest)
    return None if number is None or factor is None else number * factor


def _rows(layout: Layout) -> tuple[list[str], list[str]]:
    """Row of names and row of units above the numbers; empty where the file has none."""
    lines = [bare(line) for line in layout.header]
    rows = [_head_fields(layout, line) for line in lines]
    rows = [row for row in rows if any(row)]
    if not rows or not _covers(layout, rows[-1]):
        return [], []
    if not _are_units(layout, rows[-1]):
        return (rows[-1], []) if _are_names(layout, rows[-1]) else ([], [])
    if len(rows) > 1 and _covers(layout, rows[-2]) and _are_names(layout, rows[-2]):
        return rows[-2], rows[-1]
    return [], rows[-1]


def _head_fields(layout: Layout, line: str) -> list[str]:
    """Fields of a line of heads: between columns of white space, names have spaces and units brackets."""
    row = layout.dialect.fields(line)
    if layout.dialect.separator is not None or len(row) == layout.width:
        return row
    wide = [text.strip() for text in line.replace("\t", "  ").split("  ") if text.strip()]
    if len(wide) == layout.width:
        return wide
    joined: list[str] = []
    for text in row:
        if joined and text.startswith(("(", "[")):
            joined[-1] += f" {text}"
        else:
            joined.append(text)
    return joined


def _covers(layout: Layout, row: Sequence[str]) -> bool:
    """Whether a row has a field for every column of numbers; the first one may be empty."""
    return len(row) > max(layout.columns) and all(row[place] for place in layout.columns[1:])


def _are_units(layout: Layout, row: Sequence[str]) -> bool:
    """Whether a row has units in the columns of numbers, in brackets or as words."""
    found = [row[place] for place in layout.columns if row[place]]
    known = [_unit(text) in (*TIMES, *VOLTAGES, "A", NUMBERING) for text in found]
    enclosed = [text[:1] + text[-1:] in ("()", "[]") for text in found]
    # "Second,Value" has one unit and no names; "Time,Value" has names.
    values = [text.lower() == "value" for text in found]
    return any(known) and all(a or b or c for a, b, c in zip(known, enclosed, values, strict=True))


def _are_names(layout: Layout, row: Sequence[str]) -> bool:
    """Whether a row has names in the columns of numbers: texts, or whole numbers of channels."""
    key = _key(row[0])
    # "Sample,CH1" numbers the samples, "Sample Rate,5 MHz" does not.
    of_keys = key not in _NUMBERINGS and key.split(" ")[0] in _OTHER
    if of_keys or key in (*_STEP, *_RATE, *_POINTS[:-2], *_X_UNIT, *_Y_UNIT):
        return False
    texts = [row[place] for place in layout.columns]
    numbers = [text for text in texts if layout.dialect.number(text) is not None]
    channels = all(text.isdigit() and len(text) <= 2 for text in numbers)
    return len(numbers) < len(texts) and channels


def parts(head: str) -> tuple[str, str]:
    """Name and unit of a head such as "Time (us)", "CH1 [kV]", "C1 in V" or "time_ms".

    Examples
    --------
    >>> parts("Time (us)"), parts("C1 in V"), parts("time_ms"), parts("Channel A")
    (('Time', 'us'), ('C1', 'V'), ('time', 'ms'), ('Channel A', ''))
    """
    text = " ".join(head.split())
    for opening, closing in (("[", "]"), ("(", ")")):
        start = text.rfind(opening)
        if start >= 0 and text.endswith(closing):
            return text[:start].strip(), _unit(text[start:])
    words = text.replace("_", " ").replace("/", " ").split()
    if not words:
        return "", ""
    unit = _unit(words[-1])
    if len(words) > 1 and words[-2].lower() == "in" and unit:
        return " ".join(words[:-2]), unit
    if len(words) == 1 and unit in (*TIMES, *VOLTAGES) and len(text) > 1:
        return text, unit
    # "Channel A" is a name: of bare words, only those that no channel has are units.
    of_time = words[0].lower() in _TIME_NAMES and unit in TIMES
    if len(words) > 1 and (of_time or unit in VOLTAGES):
        return " ".join(words[:-1]), unit
    return text, ""


def _unit(text: str) -> str:
    """Unit in the spelling of pint; a text in brackets that is none as it stands, other texts as ""."""
    enclosed = text[:1] + text[-1:] in ("()", "[]")
    inner = (text[1:-1] if enclosed else text).strip().replace("\u03bc", "µ")
    # Capitals count in mV and MV, and in ms and Ms: no oscilloscope writes mega.
    if inner[:1] == "M" and inner[1:2] in ("V", "s", "S"):
        return inner
    if inner.lower() == "mv":
        return "mV"
    if inner.lower() == NUMBERING:
        return NUMBERING
    known = _WORDS.get(inner.lower(), "")
    return known or (inner if enclosed else "")


def unit_of(text: str) -> str:
    """Unit that a user gave, in the spelling of pint."""
    return _unit(f"({text})")
