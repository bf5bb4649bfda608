"""Waveforms in binary files, read by libraries: MATLAB, TDMS of LabVIEW, and files of oscilloscopes.

A library returns all columns of a file. What it does not check is checked here from the header: the unit, the
number of segments, and that the samples are no envelope.
"""

from __future__ import annotations

import math
import re
import struct
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from logging import LogRecord
from pathlib import Path
from typing import Any

import numpy as np
import scipy

from ehlectric.arrays import Array
from ehlectric.drive.waveform.chosen_columns import Choice, Keys, choice_of, envelope
from ehlectric.drive.waveform.refusals import exceeded, segments
from ehlectric.drive.waveform.samples import MOST_BYTES, Samples
from ehlectric.drive.waveform.text_heads import Head, Labels, Stated, parts_of
from ehlectric.errors import InputError, short, shown
from ehlectric.readable import readable
from ehlectric.runtime.file_kinds import PEEKED
from ehlectric.runtime.reading import regular
from ehlectric.runtime.sizes import check_memory_for, check_size

# Memory for a byte of a file while it is read [bytes], as its samples have 16 bits or more, and for a number.
_MEMORY, _NUMBER = 16.0, 24.0

# Largest number of columns, and of first samples in which times are recognised.
_MOST_COLUMNS, _PEEKED = 1000, 1000

# Classes of MATLAB of arrays of numbers.
_MAT_NUMBERS = re.compile(r"double|single|u?int\d+")

# Fields of the header of LeCroy, template LECROY_2_3, by their place from the word WAVEDESC: form of struct,
# without the order of bytes. Source: the template that these oscilloscopes return by TEMPLATE?.
_LECROY = {"segments": (144, "i"), "interval": (176, "f"), "start": (180, "d"), "record_type": (316, "H")}
_LECROY_ORDER, _LECROY_UNITS = 34, (196, 244)

# Types of records that are one waveform: single sweep and interleaved sampling.
_LECROY_WAVEFORMS = (0, 1)

# Keys of the header of Tektronix without which samples and times are not known, in their long and short form.
_TEKTRONIX = {
    "points": r"NR_P(?:T)?", "bytes": r"BYT_N(?:R)?", "sign": r"BN_F(?:MT)?", "format": r"PT_F(?:MT)?",
    "interval": r"XIN(?:CR)?", "start": r"XZE(?:RO)?", "unit of x": r"XUN(?:IT)?",
    "factor": r"YMU(?:LT)?", "offset": r"YOF(?:F)?", "zero": r"YZE(?:RO)?", "unit of y": r"YUN(?:IT)?",
}  # fmt: skip


@dataclass(frozen=True, eq=False)
class Column:
    """Column of a binary file; ``counts``, whether whole numbers of a converter are its type."""

    name: str
    unit: str
    numbers: Array
    counts: bool = False


def read_binary(path: Path, kind: str, keys: Keys) -> tuple[Labels, Choice, Samples]:
    """Labels, columns and samples of a binary file of a kind in ``READERS``."""
    with regular(path) as file:
        size = file.seek(0, 2)
    check_size(path, size, MOST_BYTES, copies=_MEMORY)
    library, reader = READERS[kind]
    try:
        columns, stated = reader(path)
    except InputError:
        raise
    except MemoryError:
        raise InputError(path, "states more numbers than fit into the memory") from None
    except ImportError:
        takes = "the extra ehlectric[scopes], or the waveform as CSV"
        raise InputError(path, f"needs the package {library}", takes=takes) from None
    except Exception as error:  # readers of damaged files raise exceptions of any kind
        what = f"cannot be read by {library}, {short(str(error))}"
        raise InputError(path, f"{what}; export it as CSV") from None
    if not 0 < len(columns) <= _MOST_COLUMNS:
        raise InputError(path, f"has {len(columns)} columns of numbers", takes=f"1 to {_MOST_COLUMNS}")
    heads = [Head(place, column.name, column.unit) for place, column in enumerate(columns)]
    labels = Labels(heads, (), tuple(stated))
    choice = choice_of(path, labels, keys, lambda place: columns[place].numbers[:_PEEKED])
    return labels, choice, _samples(path, choice, columns, keys)


def _samples(path: Path, choice: Choice, columns: list[Column], keys: Keys) -> Samples:
    value = columns[choice.value.place]
    if value.counts and keys.value_unit is None and keys.scale == 1.0:
        what = f"missing; {path} has whole numbers in {choice.value}, which may be counts of a converter"
        raise InputError.worded("scale", f"{what}; expected the volts of a count, or value_unit")
    numbers = np.array(value.numbers, dtype=float)
    bad = np.flatnonzero(~np.isfinite(numbers))
    if bad.size:
        first = f"sample {bad[0] + 1}"
        if np.isinf(numbers[bad[0]]):
            raise exceeded(path, int(np.count_nonzero(np.isinf(numbers))), first)
        raise InputError(path, f"has no number in {bad.size} samples of {choice.value}, the first in {first}")
    times = np.empty(0) if choice.time is None else np.array(columns[choice.time.place].numbers, dtype=float)
    if choice.time is not None and (times.size != numbers.size or not np.all(np.isfinite(times))):
        what = f"has {times.size} finite times in {choice.time} and {numbers.size} samples in {choice.value}"
        raise InputError(path, what, takes="a time for each sample")
    return Samples(numbers, times)


def _mat(path: Path) -> tuple[list[Column], list[Stated]]:
    """Arrays of real numbers of a file of MATLAB; single numbers are keys. Other variables are ignored."""
    known = scipy.io.whosmat(str(path))
    # A compressed variable may be large.
    count = sum(math.prod(map(float, shape)) for _, shape, _ in known)
    check_memory_for(path, _NUMBER * count, f"has {readable(count, 2)} numbers")
    content = scipy.io.loadmat(str(path), appendmat=False)
    columns: list[Column] = []
    stated: list[Stated] = []
    for name, shape, kind in known:
        array = np.asarray(content[name])
        if _MAT_NUMBERS.fullmatch(kind) is None or array.dtype.kind not in "fiu" or len(shape) > 2:
            continue
        if array.size == 1:
            number = f"{float(array.flat[0]):.12g}"
            stated.append(Stated(name, (number,), 0, f"{name}: {number}"))
        elif array.size:
            # MATLAB stores whole numbers of the class double as integers: only the class means counts.
            columns += _of_array(name, array, counts="int" in kind)
    return columns, stated


def _of_array(name: str, array: Any, *, counts: bool) -> Iterator[Column]:
    """Columns of an array, named as MATLAB indexes them; the samples are along its longer axis."""
    if 1 in array.shape:
        yield Column(*parts_of(name), array.ravel(), counts)
        return
    along_rows = array.shape[0] >= array.shape[1]
    for k, numbers in enumerate(array.T if along_rows else array, 1):
        yield Column(f"{name}(:,{k})" if along_rows else f"{name}({k},:)", "", numbers, counts)


def _tdms(path: Path) -> tuple[list[Column], list[Stated]]:
    """Channels of a file of LabVIEW, each after its times, if the file contains times."""
    from nptdms import TdmsFile
    from nptdms.log import log_manager

    # The package prints what is damaged, and goes on.
    faults: list[str] = []

    def refuse(record: LogRecord) -> bool:
        faults.append(record.getMessage())
        return False

    log_manager.console_handler.addFilter(refuse)
    try:
        file = TdmsFile.read(str(path))
    finally:
        log_manager.console_handler.removeFilter(refuse)
    if faults:
        raise InputError(path, f"is damaged: {short(faults[0])}; export it as CSV")
    columns: list[Column] = []
    channels = [channel for group in file.groups() for channel in group.channels()]
    names = [channel.name for channel in channels]
    for channel in channels:
        numbers = np.asarray(channel[:])
        if not numbers.size or numbers.dtype.kind not in "fiu":
            continue
        known: Mapping[str, Any] = channel.properties
        name = channel.name if names.count(channel.name) == 1 else f"{channel.group_name}/{channel.name}"
        unit = str(known.get("unit_string", known.get("NI_UnitDescription", ""))).strip()
        if "wf_increment" in known and float(known["wf_increment"]) > 0.0:
            columns.append(
                Column(f"time of {name}", "s", _even(known.get("wf_start_offset", 0.0), known, numbers.size))
            )
        columns.append(Column(name, unit, numbers, numbers.dtype.kind in "iu"))
    return columns, []


def _even(start: float, known: Mapping[str, Any], count: int) -> Array:
    return float(start) + float(known["wf_increment"]) * np.arange(count, dtype=np.float64)


def _scope(path: Path, unit: str, times: Array | None = None) -> list[Column]:
    """Channels of a file of an oscilloscope; ``unit`` and ``times`` of the header replace the library's."""
    from RigolWFM.wfm import Wfm

    columns: list[Column] = []
    for channel in Wfm.from_file(str(path)).channels:
        if channel.volts is not None:
            seconds = channel.times if times is None else times[: channel.volts.size]
            columns += [
                Column(f"time of {channel.name}", "s", seconds),
                Column(channel.name, unit, channel.volts),
            ]
    return columns


def _trc(path: Path) -> tuple[list[Column], list[Stated]]:
    """Waveform of LeCroy: one segment, no envelope, and the unit of its header."""
    with regular(path) as file:
        content = file.read(PEEKED)
    header = content[content.index(b"WAVEDESC") :]
    template = _text(header, 16, 16)
    if not template.startswith("LECROY_2"):
        raise InputError(path, f"has the template {shown(template)}", takes="LECROY_2_3; export it as CSV")
    order = "<" if header[_LECROY_ORDER] == 1 else ">"
    known = {
        key: struct.unpack_from(order + form, header, place)[0] for key, (place, form) in _LECROY.items()
    }
    if known["segments"] > 1:
        raise segments(path, known["segments"], "as its header states")
    if known["record_type"] not in _LECROY_WAVEFORMS:
        raise InputError(path, f"has records of type {known['record_type']}", takes="a single sweep")
    unit, unit_of_x = (_text(header, place, 48) for place in _LECROY_UNITS)
    if unit_of_x.upper() != "S":
        raise InputError(path, f"has {shown(unit_of_x)} as unit of its horizontal axis", takes="'S'")
    # The interval has single precision: its shortest decimal number is what the oscilloscope means.
    interval = float(str(np.float32(known["interval"])))
    with regular(path) as file:
        count = file.seek(0, 2)
    return _scope(path, unit, known["start"] + interval * np.arange(count, dtype=np.float64)), []


def _text(header: bytes, place: int, length: int) -> str:
    return header[place : place + length].split(b"\0")[0].decode("latin-1").strip()


def _isf(path: Path) -> tuple[list[Column], list[Stated]]:
    """Waveform of Tektronix: samples with a sign, no envelope, and the unit of its header."""
    with regular(path) as file:
        header = file.read(PEEKED).partition(b"#")[0].decode("latin-1")
    known = {}
    for key, pattern in _TEKTRONIX.items():
        match = re.search(rf'\b{pattern}\s+(?:"([^"]*)"|([^;\s]+))', header)
        if match is None:
            raise InputError(path, f"has no {key} in its header", takes="a waveform with its header")
        known[key] = (match[1] or match[2] or "").strip().upper()
    if known["format"] != "Y":
        raise InputError(path, envelope(f"as its header states ({known['format']})"))
    if known["sign"] != "RI" or known["unit of x"] != "S":
        what = f"has {shown(known['sign'])} as its numbers and {shown(known['unit of x'])} as unit of times"
        raise InputError(path, what, takes="'RI' and 'S'; export it as CSV")
    columns = _scope(path, known["unit of y"])
    count = columns[-1].numbers.size if columns else 0
    if str(count) != known["points"]:
        raise InputError(path, f"has {count} samples, but states {known['points']}; export it as CSV")
    return columns, []


# Libraries and readers of binary files, by the keys of ``file_kinds.KINDS``.
Reader = Callable[[Path], tuple[list[Column], Iterable[Stated]]]
READERS: Mapping[str, tuple[str, Reader]] = {
    "mat": ("SciPy", _mat),
    "tdms": ("npTDMS", _tdms),
    "trc": ("RigolWFM", _trc),
    "isf": ("RigolWFM", _isf),
}
