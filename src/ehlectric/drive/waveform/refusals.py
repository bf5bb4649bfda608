"""Files of oscilloscopes whose numbers are no samples of one waveform in volts.

Instruments write words, signs or a large number where a voltage exceeds their range. They also save counts of
their converter, pairs of minimum and maximum, and several records below each other.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from ehlectric.arrays import Array, IntArray
from ehlectric.drive.waveform.chosen_columns import Keys, envelope
from ehlectric.drive.waveform.samples import Samples, numbered_lines
from ehlectric.drive.waveform.text_heads import Labels
from ehlectric.errors import InputError, shown
from ehlectric.readable import readable
from ehlectric.runtime.text_table import Layout

# What instruments write for a voltage beyond their range.
_EXCEEDED = re.compile(
    r"[-+]?(?:∞|inf(?:inity)?\.?|1\.#inf\w*|ol|o\.l\.?|o/l|ovl|ovr|over|overflow|overload|over[- ]?range|"
    r"out[- ]of[- ]range|clip(?:ped|ping)?)|[<>≤≥]=?\s*[-+]?\d+(?:[.,]\d*)?(?:e[-+]?\d+)?",
    re.IGNORECASE,
)

# Infinity and no number after SCPI-99, volume 1, section 7.2.1; relative difference of printed ones.
_SCPI, _NEAR = (9.9e37, 9.91e37), 5e-4

# Between the fields of a line, if it contains other signs than spaces there, and first signs of a number.
_BETWEEN, _OF_NUMBER = re.compile("[;,\t]"), "+-.0123456789"

# Lines that begin a segment, below the first numbers.
_BEGINS = re.compile(r"[#\s]*(?:segment|frame|block|step information)\b", re.IGNORECASE)

# Values of keys of the format or the acquisition that announce pairs of minimum and maximum.
_ENVELOPES = ("env", "minmax", "min/max", "min-max", "peak", "pkdetect", "p-p")

# Most segments whose places a message lists; least samples of a segment whose times begin again, and of a
# segment after a gap, as circuit simulators also leave gaps.
_LISTED, _LEAST, _LEAST_APART = 5, 4, 16

# A gap of time between segments [usual steps].
_GAP = 1.5

# Divisions of a screen with some reserve, and counts of a converter in a division, as GW Instek saves them
# (user manual of the GDS-2000 series, page 121: 25 points in a division).
_DIVISIONS, _COUNTS = 12.0, 25.0

# Whole numbers are doubted if a count of the converter is smaller than this [V].
_COUNT = 0.5


def refuse_stated(path: Path, labels: Labels) -> None:
    """Refuse a file that states several segments, or an envelope."""
    for stated in labels.of("segments"):
        if stated.number is not None and stated.number > 1:
            raise segments(path, int(stated.number), f"as line {stated.line} states ({shown(stated.text)})")
    for stated in labels.of("format"):
        if stated.values[0].lower().startswith(_ENVELOPES):
            raise InputError(path, envelope(f"as line {stated.line} states ({shown(stated.text)})"))


def segments(path: Path, count: int, where: str) -> InputError:
    """Error of a file with several records; ``where`` says what shows them."""
    return InputError(path, f"has {count} segments, {where}; save a single segment")


def refuse_words(path: Path, layout: Layout | None) -> None:
    """Refuse a file with words for a voltage beyond the range, or with heads below its numbers.

    The ``layout`` is None if its columns could not be recognised.
    """
    beyond: list[tuple[int, str]] = []
    begins: list[int] = []
    first = 1 if layout is None else layout.first
    above = [line.strip() for line in layout.header if line.strip()] if layout is not None else []
    for number, line in numbered_lines(path):
        parts = _BETWEEN.split(line) if _BETWEEN.search(line) else line.split()
        fields = [field for field in (part.strip(' "') for part in parts) if field]
        words = [field for field in fields if _EXCEEDED.fullmatch(field)]
        # A row has numbers in its other fields.
        if words and all(field in words or field[0] in _OF_NUMBER for field in fields):
            beyond.append((number, words[0]))
        elif number > first and (_BEGINS.match(line) or line.strip().lstrip("#%/ ") in above[-1:]):
            begins.append(number)
    if beyond:
        raise exceeded(path, len(beyond), f"line {beyond[0][0]}: {shown(beyond[0][1])}")
    if begins and layout is not None:
        places = [f"line {number}" for number in begins]
        raise segments(path, len(begins) + 1, f"the others begin in {_joined(places)}")


def exceeded(path: Path, count: int, first: str) -> InputError:
    """Error of voltages beyond the range; ``first`` is the place of the first one."""
    what = f"exceeds the range of the instrument in {count} samples, the first in {first}"
    return InputError(path, f"{what}; measure with a larger range")


def _joined(places: Sequence[str]) -> str:
    return ", ".join(places[:_LISTED]) + ", ..." * (len(places) > _LISTED)


def refuse_scpi(path: Path, read: Samples) -> None:
    """Refuse the numbers by which SCPI replaces voltages beyond the range, and missing ones."""
    size = np.abs(read.values)
    if not size.size or np.max(size) < _SCPI[0] * (1.0 - _NEAR):
        return
    bad = np.flatnonzero(np.any([np.isclose(size, known, rtol=_NEAR) for known in _SCPI], axis=0))
    if bad.size:
        first = int(bad[0])
        raise exceeded(path, bad.size, f"{read.place(first)}: {read.values[first]:g}")


def refuse_restarts(path: Path, read: Samples) -> None:
    """Refuse times that begin again, or that are all there twice."""
    times, steps = read.times, np.diff(read.times)
    begins = np.flatnonzero(steps <= 0.0) + 1
    if not begins.size:
        return
    usual = float(np.median(np.abs(steps)))
    again = np.abs(times[begins] - times[0]) <= _GAP * usual + read.digit
    if usual > 0.0 and np.all(again) and np.all(_lengths(read, begins) >= _LEAST):
        raise _of_begins(path, read, begins, "the times of the others begin again in")
    whole = times[: 2 * (times.size // 2)]
    if np.array_equal(whole[::2], whole[1::2]) and np.all(np.diff(whole[::2]) > 0.0):
        raise InputError(path, envelope(f"at each time, as in {read.place(1)}"))


def refuse_gaps(path: Path, read: Samples) -> None:
    """Refuse records of equal lengths with gaps of time between them."""
    gaps = np.diff(read.times)
    begins = np.flatnonzero(gaps > _GAP * np.median(gaps)) + 1
    lengths = _lengths(read, begins)
    if begins.size and np.all(lengths == lengths[0]) and lengths[0] >= _LEAST_APART:
        raise _of_begins(path, read, begins, "gaps of time are before")


def _lengths(read: Samples, begins: IntArray) -> IntArray:
    return np.diff([0, *begins, read.times.size])


def _of_begins(path: Path, read: Samples, begins: IntArray, what: str) -> InputError:
    places = [read.place(int(k)) for k in begins[: _LISTED + 1]]
    return segments(path, begins.size + 1, f"{what} {_joined(places)}")


def refuse_counts(path: Path, labels: Labels, values: Array, factor: float, keys: Keys) -> None:
    """Refuse whole numbers that are counts of a converter, not volts, by the volts per division of the file.

    ``values`` are the numbers of the file, and ``factor`` is their factor to volts, without the user's scale.
    """
    divisions = [each.number for each in labels.of("division") if each.number]
    if not divisions or not np.all(values == np.rint(values)):
        return
    division = max(map(abs, divisions))
    span = float(np.ptp(values)) * factor * abs(keys.scale) / division
    stated = keys.scale != 1.0 or keys.value_unit is not None
    if span <= _DIVISIONS and (stated or division / _COUNTS >= _COUNT):
        return
    count = readable(division / _COUNTS / factor, 6)
    says = "missing;" if keys.scale == 1.0 else f"got {keys.scale:g};"
    what = f"{path} has whole numbers, which as volts span {readable(span)} divisions of {division:g} V"
    takes = (
        f"the volts of a count, such as {count} for 25 counts in a division, or value_unit if they are volts"
    )
    raise InputError.worded("scale", f"{says} {what}; expected {takes}")
