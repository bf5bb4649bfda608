"""Heads of a waveform in text: names and units of the columns, and what lines above the numbers state.

The names and units of the columns are the last lines above the numbers.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise, takewhile

from ehlectric.errors import printable, short
from ehlectric.quantities.unit_spelling import typed
from ehlectric.quantities.units import known_factor
from ehlectric.runtime.text_table import Dialect, Layout, name_and_unit

# Longest name of a column in a message [characters].
_LONGEST_NAME = 40

# Units as oscilloscopes write them, in small letters, and factors by the first letter of a prefix.
_UNIT = re.compile(
    "(milli|micro|nano|pico|kilo|[muµnpk]?)"
    "(?:(?P<s>s|secs?|seconds?|sekunden?|secondes?)|(?P<V>v|volts?)|(?P<A>a|amps?|amp[eè]res?))"
)
_FACTORS = {"": 1.0, "m": 1e-3, "u": 1e-6, "µ": 1e-6, "n": 1e-9, "p": 1e-12, "k": 1e3}

# Between two units of which one is meant.
_OR = " or "

# Names of columns of times, and names and "units" of columns that number the samples.
_TIME_NAMES = ("time", "t", "zeit", "temps", "tiempo", "tempo", "x-axis", "timestamp")
_NUMBERINGS = ("nr", "no", "no.", "#", "index", "sample", "samples", "point", "points", "sequence")

# Voltage of a node or current of an element as circuit simulators write it: "V(vcm)", "I(R1)", "Id(M1)".
_SIMULATED = re.compile(r"(?:([Vv])|[Ii][a-zA-Z]?)\(([^()]+)\)")

# Signs between a key above the numbers and its values.
_BETWEEN = re.compile("[:;,=\t]")

# Meanings of keys above the numbers, and their spellings in small letters without spaces and signs.
SPELLINGS = {
    "length": ("recordlength", "memorylength", "waveformlength", "datalength", "points", "blocksize"),
    "interval": (
        "sampleinterval", "samplinginterval", "sampleperiod", "samplingperiod", "increment", "xincrement",
        "xinc", "tinc", "hresolution", "tinterval", "timeinterval",
    ),
    "rate": ("samplerate", "samplingrate", "samplingfrequency", "samplefrequency"),
    "segments": (
        "segments", "segmentcount", "numberofsegments", "frames", "framecount", "numberofframes",
        "fastframecount", "blocknumber", "numberofblocks",
    ),
    "division": (
        "verticalscale", "voltsdiv", "voltdiv", "vdiv", "voltsperdivision", "voltsperdiv", "vscale",
        "verticalsensitivity", "scalevdiv",
    ),
    "name": ("tracename", "tracenames", "channelname", "channelnames", "signalname", "signalnames"),
    "format": (
        "pointformat", "ptfmt", "acquisitionmode", "acquiremode", "acqmode", "samplemode", "samplingmode",
        "decimation", "acquisition",
    ),
}  # fmt: skip

# Words of keys of the sampling interval, and of keys in general, which are no names of columns.
INTERVALS = ("interval", "increment", "xinc", "tinc", "hresolution", "rate", "period", "frequency", "delta")
_UNITS = ("unit", "einheit")
_STATED = (*_UNITS, "length", *INTERVALS)

# Beginnings of keys of units above the numbers that belong to the other axis: "Vertical Units", "xunit".
_OTHERS = {"s": ("v", "y"), "V": ("h", "x", "time", "zeit", "tunit")}

# Words of a key of units without its channel, as in "Vertical Units CH1" and "Channel 1 Unit".
_OF_UNIT = re.compile("unit[eé]?s?|einheit(?:en)?|verti[ck]ale?|channel|kanal|ch")

# Words of the names of currents.
_CURRENT = re.compile("current|strom|courant", re.IGNORECASE)

# Names that a bare "A" follows as a unit: of a numbered channel or a current, as in "CH1_A" and "i_A". After
# other names it may be a phase; after a space it is a unit if a column next to it has a unit in this way.
_BEFORE_AMPERE = re.compile(r"(?:ch|channel|kanal|voie)[\s_]*\d+|i[a-z\d]?", re.IGNORECASE)
_VOLTS = re.compile(r".*\d [mkµu]?V")

# Amperes that no name ends in, and beginnings of names of voltages, whose last letter is a phase.
_AMPERES = re.compile("[mµunpk]A|amps|[Aa]mp[eè]res?")
_OF_VOLTAGE = re.compile(r"[uv]|phase|volt|l\d*$|diff|gate", re.IGNORECASE)

# Unit after a slash, as in "Kanal 1 / A", and after a colon, as in "CH1: A".
_SLASHED = re.compile(r"(.*\S)\s*/\s*([^\s/]+)")
_AFTER_COLON = re.compile(r"([^:]*\S)\s*:\s*(\S+)")

# Units of other quantities at the end of a name, as in "P_W".
_FOREIGN = ("W", "kW", "Hz", "kHz", "ohm", "degC", "rpm", "Nm")

# Rates of samples: "250000000", "250 MSa/s", "1 GHz".
_RATE = re.compile(r"([\d.]+(?:[eE][-+]?\d+)?)\s*([kMG]?)(?:Sa/s|S/s|sps|Hz)?", re.IGNORECASE)
_PREFIXES = {"": 1.0, "k": 1e3, "m": 1e6, "g": 1e9}

# Run of a circuit simulator below the heads: "Step Information: R=1 (Run: 1/3)".
_RUN = re.compile(r"\(Run:\s*\d+/(\d+)\)")


@dataclass(frozen=True)
class Head:
    """Head of a column at a place from 0; name and unit are empty where they are missing."""

    place: int
    name: str = ""
    unit: str = ""
    written: str = ""  # name and unit as the file contains them; empty where they are apart

    @property
    def base(self) -> str:
        """SI unit of the column; empty where it is not known."""
        return unit_of(self.unit)[0]

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


def unit_of(text: str) -> tuple[str, float]:
    """SI unit and factor of a unit as oscilloscopes write it; an empty unit for other texts.

    The factor is NaN if the text may mean two units: heads in capitals write mV as MV.

    Examples
    --------
    >>> unit_of("mV"), unit_of("MV"), unit_of("KV"), unit_of("furlong")
    (('V', 0.001), ('V', nan), ('V', 1000.0), ('', 1.0))
    """
    if _OR in text:
        return unit_of(text.partition(_OR)[0])[0], math.nan
    text = typed(text)
    match = _UNIT.fullmatch(text.lower())
    if match is None:
        return "", 1.0
    prefix = match[1]
    in_doubt = prefix == "m" and text[0] == "M"
    return match.lastgroup or "", math.nan if in_doubt else _FACTORS[prefix.replace("micro", "u")[:1]]


def parts_of(head: str, *, bare_time: bool = False) -> tuple[str, str]:
    """Name and unit of a head such as "Time (us)", "CH1 [kV]", "C1 in V", "time_ms" or "V(node)".

    ``bare_time``, whether the head of the times has no unit, as circuit simulators write it.

    Examples
    --------
    >>> parts_of("Time (us)"), parts_of("C1 in V"), parts_of("time_ms"), parts_of("Channel A")
    (('Time', 'us'), ('C1', 'V'), ('time', 'ms'), ('Channel A', ''))
    >>> parts_of("Kanal 1 / A"), parts_of("CH1_A"), parts_of("i_mA"), parts_of("phase A")
    (('Kanal 1', 'A'), ('CH1', 'A'), ('i', 'mA'), ('phase A', ''))
    >>> parts_of("V(vcm)"), parts_of("I(R1)"), parts_of("V(s)"), parts_of("V(mV)", bare_time=True)
    (('V(vcm)', 'V'), ('I(R1)', 'A'), ('V(s)', 'V'), ('V(mV)', 'V or mV'))
    """
    simulated = _SIMULATED.fullmatch(head.strip())
    if simulated is not None:
        base = "V" if simulated[1] else "A"
        known, factor = unit_of(simulated[2])
        if known != base:
            return head.strip(), base
        if bare_time:
            return head.strip(), base if factor == 1.0 else f"{base}{_OR}{simulated[2]}"
    text, unit = name_and_unit(head)
    if unit is not None:
        return text, unit
    slashed = _SLASHED.fullmatch(text)
    if slashed is not None and unit_of(slashed[2])[0]:
        return slashed[1], slashed[2]
    words = text.replace("_", " ").replace("/", " ").split()
    base = unit_of(words[-1])[0] if words else ""
    if (
        words
        and words[-1] in _FOREIGN
        and re.fullmatch(r".+(?:_| / )\S+", text)
        and not _OF_VOLTAGE.match(text)
    ):
        return " ".join(words[:-1]), words[-1]
    if len(words) > 1 and words[-2].lower() == "in" and base:
        return " ".join(words[:-2]), words[-1]
    if len(words) == 1 and base in ("s", "V") and len(text) > 1:
        return text, text
    # "Channel A" is a name: of bare words, only those that no channel has are units.
    of_time = base == "s" and words[0].lower() in _TIME_NAMES
    of_current = base == "A" and (is_current(text) or _has_amperes(text, words))
    if len(words) > 1 and (base == "V" or of_time or of_current):
        return " ".join(words[:-1]), words[-1]
    return text, ""


def _has_amperes(text: str, words: Sequence[str]) -> bool:
    """Whether a head of some words ends in a unit of a current, and not in a phase or an amplitude."""
    if _AMPERES.fullmatch(words[-1]) is not None:
        return _OF_VOLTAGE.match(text) is None
    before = text[:-1].rstrip("_")
    return text.endswith("_A") and _BEFORE_AMPERE.fullmatch(before) is not None


def is_current(name: str) -> bool:
    """Whether a name is the name of a current.

    Examples
    --------
    >>> is_current("shaft current"), is_current("CH1")
    (True, False)
    """
    return _CURRENT.search(name) is not None


@dataclass(frozen=True)
class Stated:
    """Key above or left of the numbers, with its values and the number of its line."""

    key: str  # as the file writes it
    values: tuple[str, ...]
    line: int
    text: str  # as a message shows it

    @property
    def spelling(self) -> str:
        """Key in small letters, without spaces and signs."""
        return "".join(filter(str.isalnum, self.key.lower()))

    @property
    def number(self) -> float | None:
        """First number among the values, which a name of a channel or a unit may accompany."""
        for value in self.values:
            match = re.search(r"(?<![\w.])[-+]?\d[\d.]*(?:[eE][-+]?\d+)?(?=\s*[a-zA-Zµ/]*$)", value)
            number = None if match is None else Dialect(None).number(match[0])
            if match is not None and number is not None:
                factor = unit_of(value[match.end() :].strip())[1]
                return number * factor
        return None


@dataclass(frozen=True)
class Labels:
    """Heads of the columns, and what the lines above the numbers and the fields left of them state."""

    heads: list[Head]
    header: tuple[str, ...] = ()  # lines above the numbers
    stated: tuple[Stated, ...] = ()

    @property
    def above(self) -> str:
        """Last line above the numbers; empty without any."""
        return next((line.strip() for line in reversed(self.header) if line.strip()), "")

    def of(self, meaning: str) -> list[Stated]:
        """Keys of a meaning of ``SPELLINGS``."""
        return [each for each in self.stated if each.spelling in SPELLINGS[meaning]]

    def units_above(self, base: str) -> list[str]:
        """Units above the numbers for columns of an SI unit; the first line of a key counts."""
        firsts = {each.spelling: each for each in reversed(self.stated)}
        return [
            value
            for spelling, each in firsts.items()
            if _is_unit(spelling) and not spelling.startswith(_OTHERS[base])
            for value in each.values
        ]

    def intervals(self) -> Iterator[tuple[str, float]]:
        """Texts and values [s] of all statements of the sampling interval or the sampling rate."""
        known = [unit_of(unit) for unit in self.units_above("s")]
        factors = {factor for base, factor in known if base == "s"} or {1.0}
        for stated in self.of("interval"):
            if stated.number and len(factors) == 1:
                bare = Dialect(None).number(stated.values[0]) is not None
                yield stated.text, stated.number * (next(iter(factors)) if bare else 1.0)
        for stated in self.of("rate"):
            match = _RATE.fullmatch(stated.values[0])
            number = None if match is None else Dialect(None).number(match[1])
            if match is not None and number:
                yield stated.text, 1.0 / (number * _PREFIXES[match[2].lower()])

    @property
    def interval(self) -> str | None:
        """Text of the first statement that may be the sampling interval; None without any."""
        named = [*self.of("interval"), *self.of("rate")]
        named += [each for each in self.stated if any(word in each.spelling for word in INTERVALS)]
        # Words in a sentence are none of a key; a number is what the user needs.
        named = [each for each in named if each.number is not None] or named
        return named[0].text if named else None


def labels_of(layout: Layout, lines: Sequence[str]) -> Labels:
    """Heads of the columns of a layout, and the keys that some lines of the beginning state."""
    left = layout.columns[0] if layout.columns[0] > 1 else 0
    rows = [layout.dialect.fields(line) for line in lines[layout.first :]] if left else []
    keys = [",".join(row[:left]) for row in rows]
    stated = (*_of_names_above(layout), *_stated([*layout.header, *keys]))
    return _of_channels(Labels(_of_blocks(layout, rows, _heads(layout)), layout.header, stated))


def _of_channels(labels: Labels) -> Labels:
    """Labels whose heads have the names and units that lines above the numbers state for each channel."""
    heads, others = {head.place: head for head in labels.heads}, []
    if not any(head.name for head in labels.heads):
        for stated in labels.of("name"):
            for place, name in _by_channel(stated, labels.heads).items():
                heads[place] = replace(heads[place], name=name)
    for stated in labels.stated:
        is_unit = _is_unit(stated.spelling) and not stated.spelling.startswith(_OTHERS["V"])
        units = _by_channel(stated, list(heads.values())) if is_unit else {}
        for place, unit in units.items():
            heads[place] = replace(heads[place], unit=heads[place].unit or unit)
        others += [] if units else [stated]
    for place, unit in _named_above(labels.header, list(heads.values())):
        heads[place] = replace(heads[place], unit=heads[place].unit or unit)
    return Labels(list(heads.values()), labels.header, tuple(others))


def _named_above(header: Sequence[str], heads: Sequence[Head]) -> Iterator[tuple[int, str]]:
    """Places and units of channels that a line above names, as "CH1 [A], CH2: V" and "probe on CH1 [A]"."""
    names = {head.name.casefold(): head.place for head in heads if head.name}
    for line in header:
        for field in re.split("[;,\t]", line):
            after = _AFTER_COLON.fullmatch(field.strip())
            name, unit = name_and_unit(field) if after is None else after.groups()
            words, base = name.casefold(), unit_of(unit or "")[0]
            if unit and base and words in names:
                yield names[words], unit
            elif unit and base == "A":
                # A voltage on another name may be an offset or a scale of the channel.
                yield from ((place, unit) for known, place in names.items() if words.endswith(f" {known}"))


def _is_unit(spelling: str) -> bool:
    """Whether a key in small letters is a key of units."""
    return any(word in spelling for word in _UNITS)


def _by_channel(stated: Stated, heads: Sequence[Head]) -> dict[int, str]:
    """Values of a key by the places of their channels; empty where it does not state one for each.

    The key or the values contain the names of the channels ("CH1 Unit,A" or "Unit,CH1:A,CH2:V"), or the
    values have the order of several channels.
    """
    channels = [head for head in heads if not head.is_time and not head.is_numbering]
    names = {head.name.casefold(): head.place for head in channels if head.name}
    spelled = {_OF_UNIT.sub("", "".join(filter(str.isalnum, name))): place for name, place in names.items()}
    of_key = _OF_UNIT.sub("", stated.spelling)
    if of_key and of_key in spelled:
        return {spelled[of_key]: stated.values[0]}
    named = {names[a.casefold()]: b for a, b in pairwise(stated.values) if a.casefold() in names}
    columns = [head for head in heads if not head.is_numbering]
    if not named and len(stated.values) == len(columns) > 1 and unit_of(stated.values[0])[0] == "s":
        # Also the unit of the times.
        return {head.place: value for head, value in zip(columns, stated.values, strict=True)}
    if named or len(stated.values) != len(channels) or len(channels) < 2:
        return named
    return {head.place: value for head, value in zip(channels, stated.values, strict=True)}


def _of_blocks(layout: Layout, rows: Sequence[Sequence[str]], heads: list[Head]) -> list[Head]:
    """Heads with the units that keys left of each block of columns state, as Tektronix writes channels."""
    ends = [0, *(head.place + 1 for head in heads)]
    starts = [(end, head.place) for end, head in zip(ends, heads, strict=False) if head.place > end]
    if len(starts) < 2:
        return heads
    placed = {head.place: head for head in heads}
    for end, first in starts:
        block = list(takewhile(lambda head: head is not None, map(placed.get, range(first, layout.width))))
        pairs = [pair for row in rows for pair in pairwise(row[end:first]) if _is_unit(pair[0].lower())]
        for key, unit in pairs:
            of_times = key.lower().startswith(_OTHERS["V"])
            for head in block[:1] if of_times else block[1:] or block:
                if head is not None and not head.unit:
                    placed[head.place] = replace(head, unit=unit)
    return list(placed.values())


def _stated(lines: Iterable[str]) -> Iterator[Stated]:
    """Values of keys such as "Vertical Units,V", and of texts such as "tInc = 1e-6" within a line."""
    for number, line in enumerate(lines, 1):
        key, *values = (text.strip(' "') for text in _BETWEEN.split(line))
        if any(values):
            yield Stated(key, tuple(value for value in values if value), number, " ".join(line.split()))
        for field in re.split("[;,\t]", line)[1:]:
            name, sign, value = field.partition("=")
            if sign and value.strip():
                yield Stated(name.strip(' "'), (value.strip(' "'),), number, field.strip())
        run = _RUN.search(line)
        if run is not None:
            yield Stated("Segments", (run[1],), number, line.strip())


def _of_names_above(layout: Layout) -> Iterator[Stated]:
    """Values below names, to the right of the columns of numbers: "Start,Increment" above "-3e-5,1e-6"."""
    rows = [layout.dialect.fields(line) for line in layout.header]
    for number, (names, values) in enumerate(pairwise(rows), 2):
        for name, value in list(zip(names, values, strict=False))[layout.width :]:
            if layout.dialect.number(name) is None and layout.dialect.number(value) is not None:
                yield Stated(name, (value,), number, f"{name}: {value}")


def _heads(layout: Layout) -> list[Head]:
    """Heads of the columns of numbers, by the last one or two lines above them."""
    rows = [row for row in (_head_fields(layout, line) for line in layout.header) if any(row)]
    if layout.columns[0]:
        rows = [row for row in rows if not _is_stated(row)]
    rows = [[], *(row if _covers(layout, row) else [] for row in rows)][-2:]
    if not rows[-1]:
        return [Head(place) for place in layout.columns]
    last = [rows[-1][place] for place in layout.columns]
    enclosed = [text[:1] + text[-1:] in ("()", "[]") for text in last]
    bare = [text[1:-1].strip() if inside else text for text, inside in zip(last, enclosed, strict=True)]
    of_scope = [bool(unit_of(text)[0]) or text.lower() in _NUMBERINGS for text in bare]
    known = [a or known_factor(text, text) is not None for a, text in zip(of_scope, bare, strict=True)]
    if any(of_scope) and all(a or b or not c for a, b, c in zip(known, enclosed, last, strict=True)):
        names = rows[-2] if rows[0] and _are_names(layout, rows[-2]) else []
        pairs = zip(layout.columns, bare, strict=True)
        return [Head(place, parts_of(names[place])[0] if names else "", unit) for place, unit in pairs]
    names = rows[-1] if _are_names(layout, rows[-1]) else []
    bare_time = any(name.lower() in _TIME_NAMES for name in names)
    of_volts = any(_VOLTS.fullmatch(name) for name in names)
    names = [re.sub(r"(?<=\d) A$", "_A", name) if of_volts else name for name in names]
    return [
        Head(place, *parts_of(names[place], bare_time=bare_time), names[place]) if names else Head(place)
        for place in layout.columns
    ]


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


def _is_stated(row: Sequence[str]) -> bool:
    """Whether a row begins with a key of units, of a length or of an interval."""
    return any(word in row[0].lower() for word in _STATED)


def _are_names(layout: Layout, row: Sequence[str]) -> bool:
    """Whether a row has names in the columns of numbers: texts, or whole numbers of channels."""
    if _is_stated(row):
        return False
    texts = [row[place] for place in layout.columns]
    numbers = [text for text in texts if layout.dialect.number(text) is not None]
    return len(numbers) < len(texts) and all(text.isdigit() and len(text) <= 2 for text in numbers)
