"""Statements of the lines above the numbers: sampling interval, start, length and units."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

from ehlectric.drive.source.text.dialect import Dialect, Layout, bare
from ehlectric.drive.source.text.spelling import NUMBERINGS, TIMES, spelled
from ehlectric.quantities import units

# Keys of the lines above the numbers, in small letters.
_STEP = (
    *("sample interval", "sampling interval", "sampling period", "sample period", "time interval"),
    *("x increment", "increment", "xinc", "xincr", "delta", "tdelta", "dt", "hresolution"),
)
_RATE = ("sample rate", "sampling rate", "sampling frequency", "sample frequency")
_START = ("start", "xorg", "xzero", "x origin", "tstart")
_POINTS = ("record length", "memory length", "waveform length", "data length", "points", "segmentsize")
_X_UNIT = ("horizontal units", "horizontal unit", "x unit", "x units", "xunits", "hunit")
_Y_UNIT = ("vertical units", "vertical unit", "y unit", "y units", "yunits", "vunit")

# First words of other keys, which are no names of columns.
_OTHER = (
    *(
        "model",
        "serial",
        "firmware",
        "version",
        "date",
        "vertical",
        "horizontal",
        "trigger",
        "probe",
        "label",
    ),
    *("record", "memory", "sample", "sampling", "waveform", "gating", "display", "average", "channels"),
)

# Prefixes of a sampling rate such as 1.25 GSa/s.
_PREFIXES = {"": 1.0, "k": 1e3, "K": 1e3, "M": 1e6, "G": 1e9}

# Longest text of a value in a line above the numbers [characters].
_LONGEST = 60


@dataclass
class Stated:
    """Values of known keys.

    Attributes
    ----------
    step, start : float or None
        Sampling interval and time of the first sample [s].
    points : int or None
        Number of samples.
    units : dict of str to list of str
        Units of the times, "x", and of the channels, "y", as they are written.
    """

    step: float | None = None
    start: float | None = None
    points: int | None = None
    units: dict[str, list[str]] = field(default_factory=dict)


def stated_by(layout: Layout) -> Stated:
    """Values of the known keys above the numbers of a file and to the left of them.

    Parameters
    ----------
    layout : Layout
        Dialect and columns of the file, with the lines above the numbers.

    Returns
    -------
    Stated
        Values; None and no units where the file does not state them.
    """
    stated = Stated()
    for key, values in _keys(layout):
        take(stated, key, values)
    return stated


def _keys(layout: Layout) -> Iterator[tuple[str, list[str]]]:
    """Keys and values of the lines above the numbers, and of columns to the left of them."""
    lines = [bare(line) for line in layout.header]
    if min(layout.columns) > 1:
        lines += list(layout.rows)
    for line in lines:
        row = layout.dialect.fields(line)
        if len([text for text in row if text]) == 1:
            # "Sample Interval: 4 ns" has no separator of columns, and files of one column have none at all.
            text = next(text for text in row if text)
            at = min((text.find(mark) for mark in ":=,;\t" if mark in text), default=-1)
            row = [text[:at], text[at + 1 :].strip(",; \t")] if at > 0 else row
        if min(layout.columns) > 1:
            row = row[: min(layout.columns)]
        values = [text.strip() for text in row[1:] if text.strip()]
        if row and values:
            yield key_of(row[0]), values
        # LeCroy has "Segments,1,SegmentSize,502".
        for name, value in zip(row[2::2], row[3::2], strict=False):
            if key_of(name) == "segmentsize":
                yield "segmentsize", [value]


def key_of(text: str) -> str:
    """Key in small letters, without what stands around it."""
    return " ".join(text.lower().replace("_", " ").split()).rstrip(": ")


def take(stated: Stated, key: str, values: Sequence[str]) -> None:
    """Take over the value of a known key; the first one counts."""
    if key in _STEP and stated.step is None:
        step = _amount(values[0])
        stated.step = step if step is not None and step > 0.0 else None
    elif key in _RATE and stated.step is None:
        rate = _rate(values[0])
        stated.step = None if rate is None or rate <= 0.0 else 1.0 / rate
    elif key in _START and (stated.start is None or key != _START[0]):
        # A bare "Start" may be a number of samples, so that any other key replaces it.
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
    unit = spelled(rest) if rest else "s"
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


def is_key(text: str) -> bool:
    """Whether a field is a key of a line above the numbers, and no name of a column.

    Examples
    --------
    >>> is_key("Sample Rate"), is_key("Sample"), is_key("Source")
    (True, False, False)
    """
    key = key_of(text)
    if key in NUMBERINGS:
        return False
    return key.split(" ")[0] in _OTHER or key in (*_STEP, *_RATE, *_POINTS, *_X_UNIT, *_Y_UNIT)
