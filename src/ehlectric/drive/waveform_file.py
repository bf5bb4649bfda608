"""Waveforms of oscilloscopes: heads, units, times and voltages of a file of text.

The names and units of the columns are the last lines above the numbers. What a file does not say there is
asked for by a key of ``[source]``, and never guessed from the numbers.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import chain
from pathlib import Path

import numpy as np

from ehlectric.arrays import Array, IntArray, Mask
from ehlectric.errors import InputError, printable, short, shown
from ehlectric.quantities import units
from ehlectric.quantities.result_warnings import ResultWarning
from ehlectric.quantities.unit_spelling import typed
from ehlectric.readable import readable
from ehlectric.runtime.sizes import check_memory_for
from ehlectric.runtime.text_table import Dialect, Layout, layout_of, name_and_unit, text_blocks


@dataclass(frozen=True, eq=False)
class Waveform:
    """Voltage at equal steps of time.

    Examples
    --------
    >>> import numpy as np
    >>> wave = Waveform(0.0, 1e-6, np.zeros(1001))
    >>> round(wave.duration, 9)
    0.001
    """

    start: float  # time of the first sample [s]
    step: float  # sampling interval [s], above 0
    values: Array  # voltages [V], shape (n,)

    @property
    def duration(self) -> float:
        """Time from the first sample to the last one [s]."""
        return self.step * (self.values.size - 1)


# Fewest different voltages of a waveform that is not called coarse: an eighth of the range of eight bits.
# Short records have few of them anyhow.
_LEVELS, _LONG = 32, 256

# A flat top or bottom is clipped if its longest run has at least _RUN samples and _RUNS times as many as the
# longest run at any other voltage, and if _FLAT times as many samples lie on it as within _BAND of the range
# next to it. Of a smooth top, which is a parabola, the last level has 2.4 times as many as the one before.
_RUN, _RUNS, _FLAT, _BAND = 6, 4, 6.0, 0.005

# Least share of samples between the extremes by which flat extremes differ from a computed square wave.
_QUALITY_BETWEEN = 0.05

# An edge moves by at least this share of the range between two samples; it is resolved by this many samples.
_EDGE, _RESOLVED = 0.2, 3

# Samples to each side of an edge within which it comes and goes, and most edges that are looked at.
_AROUND, _MOST_REPEATED = 4, 100_000

# Least jump from the end of a repeated record to its start that is reported, as a part of its range, and
# least time beyond the record, as a part of it, for which it is reported at all.
_SEAM, _BEYOND = 0.05, 1e-3


def quality_warnings(source: str, waveform: Waveform) -> Iterator[ResultWarning]:
    """Warnings about clipped, coarse and badly resolved waveforms, each at most once."""
    values = waveform.values
    clipped = [
        f"{count} samples at exactly {readable(level, 6)} V"
        for level, count in clipped_levels(values).items()
    ]
    if clipped:
        yield ResultWarning.of("waveform-clipped", file=source, plateaus=" and ".join(clipped))
    levels = few_levels(values)
    if levels is not None:
        yield ResultWarning.of("waveform-coarse", file=source, levels=levels, span=np.ptp(values))
    yield from edge_warnings(source, waveform)


def edge_warnings(source: str, waveform: Waveform) -> Iterator[ResultWarning]:
    """Warning "edges-unresolved" about steep edges with too few samples."""
    unresolved, edges = unresolved_edges(waveform.values)
    if unresolved:
        yield ResultWarning.of(
            "edges-unresolved",
            file=source,
            edges=edges,
            unresolved=unresolved,
            samples=_RESOLVED,
            interval=waveform.step,
        )


def repeat_warnings(source: str, waveform: Waveform, duration: float | None) -> Iterator[ResultWarning]:
    """Warning "record-repeated" about a record that is repeated, and does not end where it begins.

    The ``duration`` is the time that is simulated [s]; None stands for the time of the record.
    """
    if duration is None or duration <= (1.0 + _BEYOND) * waveform.duration:
        return
    jump = float(waveform.values[0] - waveform.values[-1])
    if abs(jump) > _SEAM * float(np.ptp(waveform.values)):
        yield ResultWarning.of(
            "record-repeated", file=source, record=waveform.duration, duration=duration, jump=jump
        )


def clipped_levels(values: Array) -> dict[float, int]:
    """Extremes at which a waveform is probably clipped, with the numbers of samples on them.

    A plateau with noise touches its extremes in short runs only. A waveform without any noise that consists
    of its two extremes and a few samples between them is taken for a computed square wave, not for a clipped
    one. ``values`` are voltages [V], shape (n,), not all equal. Returns the number of samples at each clipped
    voltage [V]; empty where nothing is clipped.

    Examples
    --------
    >>> wave = np.sin(np.linspace(0.0, 20.0, 1000)) + np.random.default_rng(1).normal(0.0, 0.01, 1000)
    >>> clipped_levels(wave), list(clipped_levels(np.minimum(wave, 0.8)))
    ({}, [0.8])
    """
    low, high = float(np.min(values)), float(np.max(values))
    extremes = {level: values == level for level in (low, high)}
    between = ~(extremes[low] | extremes[high])
    if np.count_nonzero(between) < _QUALITY_BETWEEN * values.size:
        return {}
    same = np.concatenate([values[1:] == values[:-1], [False]])
    elsewhere = longest_run(same & between) + 1
    clipped = {}
    for level, on in extremes.items():
        if longest_run(on) >= max(_RUN, _RUNS * elsewhere):
            distances = np.abs(values[between] - level)
            # At least the nearest of the other levels, where levels are coarser than the band.
            near = np.count_nonzero(distances <= max(_BAND * (high - low), float(np.min(distances))))
            count = int(np.count_nonzero(on))
            if count > _FLAT * near:
                clipped[level] = count
    return clipped


def longest_run(on: Mask) -> int:
    """Length of the longest run of consecutive true entries.

    Examples
    --------
    >>> longest_run(np.array([True, True, False, True]))
    2
    """
    changes = np.flatnonzero(np.diff(on.astype(np.int8), prepend=0, append=0))
    return int(np.max(changes[1::2] - changes[::2], initial=0))


def few_levels(values: Array) -> int | None:
    """Number of different voltages if it is below 32; None for finer and for short waveforms."""
    if values.size < _LONG:
        return None
    known: Array = np.empty(0)
    for begin in range(0, values.size, 1 << 16):
        known = np.union1d(known, values[begin : begin + (1 << 16)])
        if known.size >= _LEVELS:
            return None
    return int(known.size)


def unresolved_edges(values: Array) -> tuple[int, int]:
    """Number of steep edges with fewer than three samples between 10 and 90 % of their height, and of all.

    A steep edge moves by a fifth of the range or more between two samples; slower ones are resolved. Of more
    than 100 000 edges, the first ones count. The voltages have the shape (n,).

    Examples
    --------
    >>> steps = np.repeat([0.0, 1.0, 0.0], 20)
    >>> unresolved_edges(steps)
    (2, 2)
    >>> unresolved_edges(np.interp(np.arange(60.0), [20.0, 26.0], [0.0, 1.0]))
    (0, 0)
    """
    steps = np.diff(values)
    np.abs(steps, out=steps)
    steep = np.flatnonzero(steps >= _EDGE * np.ptp(values))
    edges = _largest_of_groups(steep, steps)[:_MOST_REPEATED]
    if not edges.size:
        return 0, 0
    offsets = np.arange(-_AROUND, _AROUND + 2)
    around = values[np.clip(edges[:, np.newaxis] + offsets, 0, values.size - 1)]
    before, after = around[:, :1], around[:, -1:]
    height = after - before
    with np.errstate(divide="ignore", invalid="ignore"):
        share = (around - before) / height
    inside = np.count_nonzero((share > 0.1) & (share < 0.9), axis=1)
    # A spike that comes back within the window has no height of its own: nothing resolves it.
    none = np.abs(height[:, 0]) < 0.5 * steps[edges]
    return int(np.count_nonzero((inside < _RESOLVED) | none)), int(edges.size)


def _largest_of_groups(places: IntArray, steps: Array) -> IntArray:
    """Place of the largest step of each group of places that are at most an edge's width apart."""
    if not places.size:
        return places
    group = np.concatenate([[0], np.cumsum(np.diff(places) > _AROUND)])
    order = np.lexsort((-steps[places], group))
    return places[order[np.searchsorted(group, np.unique(group))]]


# Smallest number of samples of a waveform.
LEAST_SAMPLES = 16

# Largest size of a file [bytes]: about 100 million samples of time and voltage.
MOST_BYTES = 2_000_000_000

# Characters of the beginning, which shows the columns.
_HEAD = 65_536

# Memory for a sample while it is read [bytes]: numbers, times, and their deviations from equal steps.
_MEMORY = 40.0

# Largest credible voltage [V], and largest sampling interval where no unit of time is stated [s].
_MOST, _SLOW = 1e9, 1e-3

# Largest relative difference of a given interval from the interval of the times.
_SAME = 0.01

# Largest deviation of times from equal spacing, beyond the rounding of printed times [steps]. Rounded to the
# same digits, the times of two ends and a sample between them deviate by one last digit.
_JITTER, _DIGITS = 1e-3, 1.01

# Rows at each end of a file whose printed digits are counted, in some characters there, and largest share of
# double distances that are taken for missing samples.
_COUNTED, _ENDS, _FEW = 40, 8000, 0.05

# Most columns that an error lists, and longest name of one [characters].
_LISTED, _LONGEST_NAME = 9, 40

# Units as oscilloscopes write them, in small letters, and factors by the first letter of a prefix.
_UNIT = re.compile(
    "(milli|micro|nano|pico|kilo|[muµnpk]?)(?:(?P<s>s|secs?|seconds?)|(?P<V>v|volts?)|(?P<A>a|amps?|amperes?))"
)
_FACTORS = {"": 1.0, "m": 1e-3, "u": 1e-6, "µ": 1e-6, "n": 1e-9, "p": 1e-12, "k": 1e3}
_USUAL = {"s": "'s', 'ms' or 'us'", "V": "'V', 'mV' or 'kV'"}

# Names of columns of times, and names and "units" of columns that number the samples.
_TIME_NAMES = ("time", "t", "zeit", "temps", "tiempo", "tempo", "x-axis", "timestamp")
_NUMBERINGS = ("nr", "no", "no.", "#", "index", "sample", "samples", "point", "points", "sequence")

# Signs between a key above the numbers and its values.
_BETWEEN = re.compile("[:;,=\t]")

# First letters of keys of units above the numbers that belong to the other axis: "Vertical Units", "xunit".
_OTHERS = {"s": "vy", "V": "hxt"}

# Keys of the number of samples above the numbers, and words of keys of the sampling interval.
_LENGTHS = ("record length", "memory length", "waveform length", "data length", "points")
_INTERVALS = ("interval", "increment", "xinc", "rate", "period", "frequency", "delta")

# Words of keys above the numbers, which are no names of columns.
_STATED = ("unit", "length", *_INTERVALS)


def read_waveform(
    path: str | Path,
    *,
    column: str | int | None = None,
    time_column: str | int | None = None,
    step: float | None = None,
    time_unit: str | None = None,
    value_unit: str | None = None,
    scale: float = 1.0,
) -> tuple[Waveform, tuple[ResultWarning, ...]]:
    r"""Waveform [V] at equal steps [s] of a text file, and warnings: assumed units, and doubts about samples.

    ``column`` and ``time_column`` are names, or numbers from 1. A given ``step`` [s] replaces times that are
    missing or printed with too few digits. The file is read block by block. An InputError names the key that
    is needed, or the line that has no finite numbers or no later time.

    Examples
    --------
    >>> import tempfile
    >>> lines = ["Time (us),CH1 (kV)", *(f"{k},{0.001 * (-7) ** (k % 3)}" for k in range(20))]
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = Path(folder) / "scope.csv"
    ...     _ = file.write_text("\n".join(lines))
    ...     wave, warnings = read_waveform(file)
    >>> wave.values.size, wave.step, round(float(wave.values[1]), 9)
    (20, 1e-06, -7.0)
    """
    path = Path(path)
    if step is not None and not 0.0 < step < np.inf:
        raise InputError("step", got=step, takes="a sampling interval above 0 s")
    if not np.isfinite(scale) or scale == 0.0:
        raise InputError("scale", got=scale, takes="a finite factor other than 0")
    content = text_blocks(path, most=MOST_BYTES)
    beginning = next(content, "")
    lines = beginning[: beginning.find("\n", _HEAD) + 1 or None].split("\n")
    layout = layout_of(path, lines)
    labels = _labels(layout, lines)
    choice = _choice(path, labels, (column, time_column), (time_unit, value_unit), step)
    count = path.stat().st_size * (beginning.count("\n") + 1) / len(beginning)
    check_memory_for(path, _MEMORY * count, f"has some {readable(count, 2)} samples")
    blocks = chain([layout.below(beginning)], content)
    read = _samples(path, layout, choice.places, blocks, ordered=step is None)
    if read.values.size < LEAST_SAMPLES:
        raise InputError(path, f"has {read.values.size} samples", takes=f"at least {LEAST_SAMPLES}")
    start, interval, gaps = _timing(path, read, choice, step)
    waveform = Waveform(start, interval, _volts(path, read.values, choice, scale))
    warnings = (*_of_reading(path, labels, choice, read.values.size), *gaps)
    return waveform, (*warnings, *quality_warnings(str(path), waveform))


def _stated(lines: Sequence[str]) -> dict[str, list[str]]:
    """Values of keys such as "Vertical Units,V", by keys in small letters; the first line of a key counts."""
    stated: dict[str, list[str]] = {}
    for line in lines:
        key, *values = (text.strip(' "') for text in _BETWEEN.split(line))
        if any(values):
            stated.setdefault(" ".join(key.lower().replace("_", " ").split()), [v for v in values if v])
    return stated


@dataclass(frozen=True)
class _Head:
    """Head of a column at a place from 0; name and unit are empty where they are missing."""

    place: int
    name: str = ""
    unit: str = ""

    @property
    def base(self) -> str:
        """SI unit of the column; empty where it is not known."""
        return _unit(self.unit)[0]

    @property
    def is_numbering(self) -> bool:
        """Whether the column numbers the samples."""
        return (self.unit or self.name).lower() in _NUMBERINGS

    @property
    def is_time(self) -> bool:
        """Whether the column is a time by its unit, or by its name if it has no unit."""
        return self.base == "s" if self.unit else self.name.lower() in _TIME_NAMES

    def __str__(self) -> str:
        column = f"column {self.place + 1}"
        return f"{short(printable(self.name), _LONGEST_NAME)} ({column})" if self.name else column


def _unit(text: str) -> tuple[str, float]:
    """SI unit and factor of a unit as oscilloscopes write it; an empty unit for other texts.

    Examples
    --------
    >>> _unit("mV"), _unit("MV"), _unit("Volt"), _unit("furlong")
    (('V', 0.001), ('V', 1000000.0), ('V', 1.0), ('', 1.0))
    """
    text = typed(text)
    # Capitals count in mV and MV, and in ms and Ms.
    large = len(text) == 2 and text[0] == "M"
    match = _UNIT.fullmatch(text.lower()[large:])
    scale = 1e6 if large else 1.0
    if match is None:
        return "", scale
    return match.lastgroup or "", _FACTORS[match[1].replace("micro", "u")[:1]] * scale


def _parts(head: str) -> tuple[str, str]:
    """Name and unit of a head such as "Time (us)", "CH1 [kV]", "C1 in V" or "time_ms".

    Examples
    --------
    >>> _parts("Time (us)"), _parts("C1 in V"), _parts("time_ms"), _parts("Channel A")
    (('Time', 'us'), ('C1', 'V'), ('time', 'ms'), ('Channel A', ''))
    """
    text, unit = name_and_unit(head)
    if unit is not None:
        return text, unit
    words = text.replace("_", " ").replace("/", " ").split()
    base = _unit(words[-1])[0] if words else ""
    if len(words) > 1 and words[-2].lower() == "in" and base:
        return " ".join(words[:-2]), words[-1]
    if len(words) == 1 and base in ("s", "V") and len(text) > 1:
        return text, text
    # "Channel A" is a name: of bare words, only those that no channel has are units.
    if len(words) > 1 and (base == "V" or (base == "s" and words[0].lower() in _TIME_NAMES)):
        return " ".join(words[:-1]), words[-1]
    return text, ""


@dataclass(frozen=True)
class _Labels:
    """Heads of the columns, and what the lines above the numbers and the fields left of them state."""

    heads: list[_Head]
    header: tuple[str, ...]  # lines above the numbers
    stated: Mapping[str, Sequence[str]]  # values of keys, by keys in small letters

    @property
    def above(self) -> str:
        """Last line above the numbers; empty without any."""
        return next((line.strip() for line in reversed(self.header) if line.strip()), "")


def _labels(layout: Layout, lines: Sequence[str]) -> _Labels:
    left = layout.columns[0] if layout.columns[0] > 1 else 0
    keys = [",".join(layout.dialect.fields(line)[:left]) for line in lines[layout.first :]] if left else []
    return _Labels(_heads(layout), layout.header, _stated([*layout.header, *keys]))


def _heads(layout: Layout) -> list[_Head]:
    """Heads of the columns of numbers, by the last one or two lines above them."""
    rows = [row for row in (_head_fields(layout, line) for line in layout.header) if any(row)]
    rows = [[], *(row if _covers(layout, row) else [] for row in rows)][-2:]
    if not rows[-1]:
        return [_Head(place) for place in layout.columns]
    last = [rows[-1][place] for place in layout.columns]
    enclosed = [text[:1] + text[-1:] in ("()", "[]") for text in last]
    bare = [text[1:-1].strip() if inside else text for text, inside in zip(last, enclosed, strict=True)]
    known = [bool(_unit(text)[0]) or text.lower() in _NUMBERINGS for text in bare]
    if any(known) and all(a or b or not c for a, b, c in zip(known, enclosed, last, strict=True)):
        names = rows[-2] if rows[0] and _are_names(layout, rows[-2]) else []
        pairs = zip(layout.columns, bare, strict=True)
        return [_Head(place, _parts(names[place])[0] if names else "", unit) for place, unit in pairs]
    names = rows[-1] if _are_names(layout, rows[-1]) else []
    return [_Head(place, *(_parts(names[place]) if names else ())) for place in layout.columns]


def _head_fields(layout: Layout, line: str) -> list[str]:
    """Fields of a line of heads: between columns of white space, names have spaces and units brackets."""
    row = layout.dialect.fields(line)
    if layout.dialect.separator is None and len(row) != layout.width:
        wide = [text.strip() for text in line.replace("\t", "  ").split("  ") if text.strip()]
        joined = line.replace(" (", "(").replace(" [", "[").split()
        return wide if len(wide) == layout.width else joined
    return row


def _covers(layout: Layout, row: Sequence[str]) -> bool:
    """Whether a row has a field for every column of numbers; the first one may be empty."""
    # Any sentence has as many words as there are columns.
    enough = len(row) == layout.width or (len(row) > layout.width and layout.dialect.separator is not None)
    return enough and all(row[place] for place in layout.columns[1:])


def _are_names(layout: Layout, row: Sequence[str]) -> bool:
    """Whether a row has names in the columns of numbers: texts, or whole numbers of channels."""
    if any(word in row[0].lower() for word in _STATED):
        return False
    texts = [row[place] for place in layout.columns]
    numbers = [text for text in texts if layout.dialect.number(text) is not None]
    return len(numbers) < len(texts) and all(text.isdigit() and len(text) <= 2 for text in numbers)


@dataclass(frozen=True)
class _Choice:
    """Columns of voltage and time, factors to SI units, and units that nobody states and that are assumed."""

    value: _Head
    factor: float
    time: _Head | None
    time_factor: float
    assumed: tuple[str, ...]

    @property
    def places(self) -> tuple[int, ...]:
        """Places of the voltages, and of the times where the file contains them."""
        return (self.value.place, *(() if self.time is None else (self.time.place,)))


def _choice(
    path: Path,
    labels: _Labels,
    requested: tuple[str | int | None, str | int | None],
    given: tuple[str | None, str | None],
    step: float | None,
) -> _Choice:
    """Columns that are read, ``requested`` of voltage and time; ``given`` are units of time and voltage."""
    heads = labels.heads
    times = [head for head in heads if head.is_time]
    unnamed, unread = not any(head.name or head.unit for head in heads), labels.above
    if requested[1] is not None:
        times = [_named(path, "time_column", requested[1], heads)]
    elif unnamed and unread and step is None and len(heads) > 1:
        what = f"{path} has no names of its {len(heads)} columns in {shown(unread)} above them"
        raise InputError.worded("time_column", f"missing; {what}; expected the number of one, such as 1")
    elif unnamed and not unread and len(heads) > 1:
        times = heads[:1]
    channels = [head for head in heads if head not in times and not head.is_numbering]
    value = (
        _named(path, "column", requested[0], heads) if requested[0] is not None else _single(path, channels)
    )
    if value in times:
        raise InputError(
            "column", got=shown(requested[0]), takes="a column of voltages, not that of the times"
        )
    # Some programs write times before every channel.
    before = [head for head in times if head.place < value.place]
    time = (before or times[:1])[-1] if times else None
    if time is None and step is None:
        raise InputError.worded("step", f"missing; {path} has {_no_times(labels)}")
    assumed: list[str] = []
    factor = _factor(path, labels, value, ("value_unit", given[1], "V"), assumed)
    of_time = ("time_unit", given[0], "s")
    time_factor = 1.0 if time is None else _factor(path, labels, time, of_time, assumed)
    return _Choice(value, factor, time, time_factor, tuple(assumed))


def _no_times(labels: _Labels) -> str:
    """Columns of a file without times, the line that may have its interval, and what to give."""
    lines = [*labels.header, *(f"{key}: {values[0]}" for key, values in labels.stated.items())]
    line = next((line for line in lines if any(word in line.lower() for word in _INTERVALS)), None)
    states = "" if line is None else f", and the line {shown(line.strip())}"
    return (
        f"no column of times that is known, but {_listed(labels.heads)}{states}; expected a sampling "
        "interval, such as 4e-9 or '4 ns', or the name or number of the column of times as time_column"
    )


def _named(path: Path, key: str, requested: str | int, heads: Sequence[_Head]) -> _Head:
    """Column of a name or a number."""
    if isinstance(requested, int):
        matches = [head for head in heads if head.place + 1 == requested]
    else:
        name = " ".join(requested.split()).casefold()
        matches = [head for head in heads if head.name.casefold() == name]
    if len(matches) != 1:
        raise InputError(key, got=f"{shown(requested)}, but {path} has the columns {_listed(heads)}")
    return matches[0]


def _listed(heads: Sequence[_Head]) -> str:
    return ", ".join(str(head) for head in heads[:_LISTED]) + ", ..." * (len(heads) > _LISTED)


def _single(path: Path, channels: Sequence[_Head]) -> _Head:
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
    path: Path, labels: _Labels, head: _Head, unit_input: tuple[str, str | None, str], assumed: list[str]
) -> float:
    """Factor from the unit of a column to the SI unit: as its head, the user or a line above states it.

    ``unit_input`` are the key of the unit, the unit that the user gave, and the SI unit. A unit that nobody
    states is taken as the SI unit and added to ``assumed``.
    """
    key, given, base = unit_input
    requested = None if given is None else _factor_of(key, given, base, f"got {shown(given)}")
    if head.base or (head.unit and requested is None):
        stated = _factor_of(path, head.unit, base, f"has {shown(head.unit)} as unit of {head}")
        if requested is not None and requested != stated:
            raise InputError(key, got=f"{shown(given)}, but {path} states {shown(head.unit)} of {head}")
        return stated
    above = [
        value
        for name, values in labels.stated.items()
        if "unit" in name and name[:1] not in _OTHERS[base]
        for value in values
    ]
    factors = {_unit(value)[1] for value in above if _unit(value)[0] == base}
    if not above and labels.above and not head.name:
        # The line above the numbers could not be read, and may state the unit.
        above = [labels.above]
    if requested is not None and factors <= {requested}:
        return requested
    if above and (len(factors) != 1 or requested is not None):
        says = "missing;" if given is None else f"got {shown(given)}, but"
        states = f"{path} states {shown(', '.join(above))} above its numbers"
        raise InputError.worded(key, f"{says} {states}; expected the unit of {head}, such as {_USUAL[base]}")
    if not factors:
        assumed.append(f"{head} is in {base}")
    return next(iter(factors), 1.0)


def _factor_of(source: object, unit: str, base: str, says: str) -> float:
    """Factor of a unit to the SI unit; an error has the key or the file as ``source``, and ``says``."""
    known, factor = _unit(unit)
    if known == base:
        return factor
    try:
        return units.factor(unit, base)
    except ValueError as error:
        raise InputError(source, f"{says} ({error})", takes=_USUAL[base]) from None


@dataclass(frozen=True, eq=False)
class _Samples:
    """Voltages and times in the units of the file, and the last printed digit of the times."""

    values: Array
    times: Array
    digit: float


def _samples(
    path: Path, layout: Layout, places: tuple[int, ...], blocks: Iterable[str], *, ordered: bool
) -> _Samples:
    """Numbers of the columns at ``places``; ``ordered`` times must increase."""
    parts: list[tuple[Array, ...]] = []
    line, last, head, tail = layout.first + 1, -np.inf, "", ""
    for text in blocks:
        columns = layout.numbers(path, places, text, line)
        if ordered and len(places) > 1 and columns[1].size:
            _check_order(path, layout, (text, line), np.diff(columns[1], prepend=last))
            last = columns[1][-1]
        parts.append(columns)
        line += text.count("\n")
        head, tail = head or text[:_ENDS], (tail + text[-_ENDS:])[-_ENDS:]
    values, times = (
        np.concatenate([each[k] for each in parts]) if k < len(places) else np.empty(0) for k in (0, 1)
    )
    # The last line of the one text may be cut off, and the first one of the other.
    ends = head.split("\n")[:-1][:_COUNTED], tail.split("\n")[1:][-_COUNTED:]
    return _Samples(values, times, layout.last_digit(places[-1], ends) if times.size else 0.0)


def _check_order(path: Path, layout: Layout, block: tuple[str, int], steps: Array) -> None:
    """Refuse times that do not increase; ``block`` is the text in which they are, and its first line."""
    if np.all(steps > 0.0):
        return
    bad = int(np.argmin(steps > 0.0))
    number = layout.line_of(*block, bad)
    what, takes = "goes backward in time", "increasing times"
    if steps[bad] == 0.0:
        what = "repeats the time before it"
        takes += "; if times are printed with too few digits, give the sampling interval as step"
    raise InputError(path, f"line {number} {what}", takes=takes)


def _timing(
    path: Path, read: _Samples, choice: _Choice, step: float | None
) -> tuple[float, float, tuple[ResultWarning, ...]]:
    """Time of the first sample and sampling interval [s], and a warning where samples may be missing."""
    times, last = read.times, read.values.size - 1
    if choice.time is None:
        return 0.0, step or 0.0, ()
    factor, span = choice.time_factor, float(times[-1] - times[0])
    start = float(times[0]) * factor
    if step is not None:
        given = step * last
        if abs(span * factor - given) > _SAME * given + 2.0 * read.digit * factor:
            says = f"{step:g} s, {readable(given, 6)} s for {last + 1} samples, but the times of {path} span"
            raise InputError("step", got=f"{says} {readable(span * factor, 6)} s")
        return start, step, ()
    each = span / last
    interval = float(f"{each * factor:.15g}")
    off = np.arange(times.size) * each
    off += times[0]
    off -= times
    worst = int(np.argmax(np.abs(off, out=off)))
    rounding = 8.0 * np.finfo(float).eps * max(abs(times[0]), abs(times[-1]))
    if off[worst] > _DIGITS * read.digit + _JITTER * each + rounding:
        takes = f"equal steps of time, here {readable(each, 6)}, up to {_JITTER:g} of a step and the rounding"
        says = (
            f"is unevenly sampled: the time of sample {worst + 1} is {readable(off[worst] / each)} of "
            "a step off"
        )
        raise InputError(path, says, takes=f"{takes} of printed times")
    if interval > _SLOW and f"{choice.time} is in s" in choice.assumed:
        raise InputError.worded(
            "time_unit",
            f"missing; {path} states no unit of its times, and in seconds its samples are {interval:g} s "
            "apart, too far for an inverter; expected 's', 'ms' or 'us'",
        )
    gaps = np.diff(times)
    long = np.flatnonzero(gaps > 1.5 * gaps.min())
    if not 0 < long.size <= _FEW * times.size:
        return start, interval, ()
    missing = ResultWarning.of(
        "samples-missing", "distances", file=path, long=long.size, distances=last, sample=long[0] + 1
    )
    return start, interval, (missing,)


def _volts(path: Path, values: Array, choice: _Choice, scale: float) -> Array:
    """Voltages [V] of numbers, which are changed; constant ones and those beyond all machines are refused."""
    with np.errstate(over="ignore"):
        values *= choice.factor * scale
    low, high = float(np.min(values)), float(np.max(values))
    if max(abs(low), abs(high)) > _MOST:
        takes = f"at most {_MOST:g} V; are unit and scale right?"
        raise InputError(path, f"has {low:g} to {high:g} V in {choice.value}", takes=takes)
    if low == high:
        raise InputError(path, f"is constant, all {values.size} samples of {choice.value} are {low:g} V")
    return values


def _of_reading(path: Path, labels: _Labels, choice: _Choice, count: int) -> Iterator[ResultWarning]:
    """Warnings about units that the file does not state, and about a length that it does not have."""
    if choice.assumed:
        assumptions = " and that ".join(choice.assumed)
        yield ResultWarning.of("units-assumed", file=path, assumptions=assumptions)
    stated = [labels.stated[key][-1] for key in _LENGTHS if key in labels.stated]
    points = max((Dialect(None).number(text) or 0.0 for text in stated), default=0.0)
    if count < points:
        yield ResultWarning.of("samples-missing", "cut_off", file=path, stated=points, count=count)
