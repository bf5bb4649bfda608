"""Hostile spellings of one record: each is read to the numbers that were written, or refused or doubted."""

from dataclasses import dataclass

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from ehlectric.drive.waveform.waveform_file import read_waveform
from ehlectric.errors import InputError
from tests.helpers.share import share_of

# One record of whole steps and thousandths of a volt, so that each spelling contains it exactly.
COUNT, STEP, START = 48, 2e-6, -1e-5
VOLTS = np.array([round(40.0 * np.sin(k / 3.0) + 3.0 * (-1) ** k, 3) for k in range(COUNT)])
AMPS = np.round(0.5 * np.cos(np.arange(COUNT) / 5.0), 3)

TIMES = {"s": 1.0, "ms": 1e-3, "us": 1e-6, "µs": 1e-6, "ns": 1e-9, "MS": 1e-3, "US": 1e-6, "Second": 1.0}
UNITS = {"V": 1.0, "mV": 1e-3, "kV": 1e3, "MV": 1e-3, "Volt": 1.0, "VOLTS": 1.0, "KV": 1e3}
PLAIN = {"MS": "ms", "MV": "mV", "US": "us", "Second": "s", "VOLTS": "V", "KV": "kV", "Volt": "V"}
HEADS = ["{name} ({unit})", "{name} [{unit}]", "{name}_{unit}", "{name} in {unit}", "{name}/{unit}"]
HEADS += ["rows", "keys", "bare", "none", "simulator"]
ABOVE = [[], [""], ["Made on a bench"], ["# run 7", ""], ["Model{s}XY-1", "Date{s}2026-03-21"]]
ABOVE += [["Record Length{s}48"], ["Vertical Scale{s}10", "Sample Interval{s}2e-06"], ["%% x", "%% y"]]
SEPARATORS = [";", "\t", ",", "  ", " ; ", ", ", " "]


@dataclass(frozen=True)
class Spelling:
    """Units, head and signs of a file."""

    time: str
    voltage: str
    head: str
    separator: str
    decimal: str
    exponent: str
    digits: int
    quoted: bool

    def number(self, value):
        text = f"{value:.{self.digits + 8}f}" if not self.exponent else f"{value:.{self.digits + 6}e}"
        text = text.upper() if self.exponent == "E" else text
        sign = "+" if self.exponent == "+e" and value >= 0 else ""
        return (sign + text).replace(".", self.decimal)

    def heads(self, names, units):
        """Rows of heads of columns with names and units."""
        if self.head == "none":
            return []
        if "{" in self.head:
            names = [self.head.format(name=n, unit=u) if u else n for n, u in zip(names, units, strict=True)]
        rows = [names, [unit and f"({unit})" for unit in units]] if self.head == "rows" else [names]
        return [self.separator.join(f'"{text}"' if self.quoted else text for text in row) for row in rows]


@st.composite
def spelled(draw):
    """Signs and units of a file; circuit simulators write seconds and volts."""
    head, any_of = draw(st.sampled_from(HEADS)), st.sampled_from
    time, voltage = draw(any_of(sorted(TIMES))), draw(any_of(sorted(UNITS)))
    return Spelling(
        "s" if head == "simulator" else time,
        "V" if head == "simulator" else voltage,
        head,
        draw(any_of(SEPARATORS)),
        draw(any_of(".,")),
        draw(any_of(["", "e", "E", "+e"])),
        draw(st.integers(0, 4)),
        draw(st.booleans()),
    )


@st.composite
def columns(draw, spelling):
    """Columns of a file in any order: names, units, numbers."""
    times = (START + STEP * np.arange(COUNT)) / TIMES[spelling.time]
    voltage = "V(CH1)" if spelling.head == "simulator" else "CH1"
    rows = [("time", spelling.time, times), (voltage, spelling.voltage, VOLTS / UNITS[spelling.voltage])]
    more = [("CH2", "A", AMPS), ("Nr", "", np.arange(COUNT))]
    rows += [row for row in more if draw(st.booleans())]
    return draw(st.permutations(rows))


@st.composite
def keys_of(draw, spelling, names):
    """Keys that a user may give, each true of the file."""
    units = {"time_unit": spelling.time, "value_unit": spelling.voltage}
    keys = {key: PLAIN.get(unit, unit) for key, unit in units.items() if draw(st.booleans())}
    for key, name in (("column", next(n for n in names if "CH1" in n)), ("time_column", "time")):
        if draw(st.booleans()):
            place = names.index(name) + 1
            keys[key] = place if spelling.head == "none" else draw(st.sampled_from([place, name]))
    return keys | ({"step": STEP} if draw(st.booleans()) else {})


@st.composite
def files(draw):
    """Content of a file, and keys of its user."""
    spelling = draw(spelled())
    separator = spelling.separator
    names, units, numbers = zip(*draw(columns(spelling)), strict=True)
    above = [line.replace("{s}", separator) for line in draw(st.sampled_from(ABOVE))]
    if spelling.head == "keys":
        above += [
            f"Horizontal Units{separator}{spelling.time}",
            f"Vertical Units{separator}{spelling.voltage}",
        ]
    last = draw(st.sampled_from(["", separator.strip(" ")]))
    rows = [separator.join(map(spelling.number, row)) + last for row in zip(*numbers, strict=True)]
    lines = [*above, *spelling.heads(names, units), *rows, *draw(st.sampled_from([[], [""], [last]]))]
    text = draw(st.sampled_from(["\n", "\r\n", "\r"])).join(lines)
    encoding = draw(st.sampled_from(["utf-8", "utf-8-sig", "utf-16", "cp1252"]))
    return text.encode(encoding), draw(keys_of(spelling, list(names)))


@settings(max_examples=share_of(600, 20))
@given(files())
def test_one_record_in_any_spelling_is_read_or_doubted(tmp_path_factory, made):
    content, keys = made
    path = tmp_path_factory.mktemp("spelling") / "scope.csv"
    path.write_bytes(content)
    try:
        read, warnings = read_waveform(path, **keys)
    except InputError:
        return
    same = read.values.size == COUNT and np.allclose(read.values, VOLTS, rtol=0.0, atol=1e-5)
    same = same and abs(read.step / STEP - 1.0) < 1e-3
    assert same or any(warning.code == "units-assumed" for warning in warnings)
