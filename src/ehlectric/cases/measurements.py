"""Measurements and duty cycles for a case: columns with units, and rows of a text file or a table of
pandas, in SI units.
"""

from __future__ import annotations

import math
import re
import unicodedata
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property, lru_cache
from itertools import islice, product
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING

import numpy as np

from ehlectric.arrays import Array
from ehlectric.cases.amounts import Amount
from ehlectric.errors import InputError, printable, short, shown
from ehlectric.quantities import units
from ehlectric.quantities.grouped_digits import doubt_of_column, readings
from ehlectric.quantities.quantity import data_file
from ehlectric.quantities.result_warnings import ResultWarning
from ehlectric.quantities.unit_spelling import plain
from ehlectric.quantities.units import degree, known_factor
from ehlectric.runtime.memory import MOST_MEASURED
from ehlectric.runtime.reading import read_bytes
from ehlectric.runtime.text_table import (
    OVERLOADED,
    Dialect,
    decimal_mark,
    decoded,
    is_overload,
    is_void,
    name_and_unit,
    record_at,
    uncommented,
)

if TYPE_CHECKING:
    import pandas as pd


@dataclass(frozen=True)
class Measurable(Amount):
    """Quantity of a measurement: SI unit and bounds, a usual unit, and names over a column."""

    usual: str = ""  # unit that stands for the quantity in the advice of an error
    names: tuple[str, ...] = ()  # further names that people write over a column, in small letters
    key: str = ""  # dotted key of the input in whose place it stands; empty without one
    # Usual standard uncertainty of a measured value, as a part of the value or in the SI unit; 0 if unknown.
    relative: float = 0.0
    absolute: float = 0.0
    # Whether a column without a unit is ignored, as its numbers may be fractions or per cent.
    spare: bool = False


@dataclass(frozen=True)
class ColumnBook:
    """Quantities that the columns of a kind of file may have."""

    columns: Mapping[str, Measurable]  # by the names of the columns in the program
    examples: str  # heads that an error names as examples
    most_rows: int  # largest number of rows
    gaps: frozenset[str] = frozenset()  # names of columns that may have empty cells

    @classmethod
    def of(cls, table: str, examples: str, most_rows: int) -> ColumnBook:
        """Book of a table of measured_columns.toml."""
        entries = data_file("ehlectric.quantities", "measured_columns.toml")[table].items()
        columns = {
            name: Measurable(
                **{
                    **column,
                    "names": tuple(column.get("names", ())),
                    "typical": tuple(column["typical"]) if "typical" in column else None,
                }
            )
            for name, column in entries
        }
        return cls(MappingProxyType(columns), examples, most_rows)

    @cached_property
    def names(self) -> Mapping[str, str]:
        """Quantities by the names over a column, as ``_folded`` writes them."""
        return {
            _folded(name): key
            for key, column in self.columns.items()
            for name in (key.replace("_", " "), *column.names)
        }


def _folded(name: str) -> str:
    """Name in small letters, with spaces and without accents."""
    text = unicodedata.normalize("NFKD", name.lower().replace("_", " "))
    return " ".join("".join(letter for letter in text if not unicodedata.combining(letter)).split())


# Largest numbers of rows of a measurement and of a duty cycle: 28 hours at a row a second.
MOST_ROWS, MOST_ROWS_OF_CYCLE = 20_000, 100_000

MEASURED = ColumnBook.of(
    "measured",
    "'speed [rpm]' and 'capacitance [pF]', or 'entrainment speed [m/s]' and 'film [nm]'",
    MOST_ROWS,
)
CYCLE = ColumnBook.of("duty", "'time [s]', 'speed [rpm]' and 'radial load [N]'", MOST_ROWS_OF_CYCLE)
AXLE_CYCLE = ColumnBook.of("axle_duty", "'time [s]', 'speed [rpm]' and 'torque [N m]'", MOST_ROWS_OF_CYCLE)
GEAR_CYCLE = ColumnBook.of("gear_duty", "'time [s]', 'speed [rpm]' and 'torque [N m]'", MOST_ROWS_OF_CYCLE)


# Quantities that a calibration compares, and the columns of a file with quantities at operating points.
CALIBRATED = ColumnBook.of("calibration", "", 0).columns


def calibrated(quantity: str) -> Measurable:
    """Quantity that a calibration compares, by its name; in an axle with its element or shaft.

    Examples
    --------
    >>> calibrated("elements.rotor_1.capacitance").usual, calibrated("shafts.rotor.voltage").usual
    ('pF', 'V')
    """
    from ehlectric.cases.axle_keys import name_of_quantity  # late: contacts do not need it

    return CALIBRATED[name_of_quantity(quantity)]


def quantity_text(quantity: str) -> str:
    """Name of a quantity that a calibration compares, in words.

    Examples
    --------
    >>> quantity_text("breakdown_voltage"), quantity_text("elements.rotor_1.capacitance")
    ('breakdown voltage', 'capacitance of rotor_1')
    """
    of, _, name = quantity.rpartition(".")
    text = name.replace("_", " ")
    return f"{text} of {of.partition('.')[2]}" if of else text


def _points(cycle: ColumnBook, examples: str) -> ColumnBook:
    """Columns of a file of operating points: quantities, and the columns of a duty cycle except the time."""
    inputs = {name: column for name, column in cycle.columns.items() if column.key}
    columns = {**inputs, "speed": replace(MEASURED.columns["speed"], key=inputs["speed"].key), **CALIBRATED}
    return ColumnBook(MappingProxyType(columns), examples, MOST_POINTS, frozenset(CALIBRATED))


# Largest number of operating points of a calibration.
MOST_POINTS = 1000

BEARING_POINTS = _points(CYCLE, "'speed [rpm]', 'capacitance [pF]' and 'uncertainty of capacitance [%]'")
GEAR_POINTS = _points(GEAR_CYCLE, "'torque [N m]', 'capacitance [pF]' and 'uncertainty of capacitance [%]'")


def axle_points(elements: Iterable[str], shafts: Iterable[str]) -> ColumnBook:
    """Columns of a file of operating points of an axle; ``elements`` and ``shafts``, their keys."""
    from ehlectric.cases.axle_keys import OF_ELEMENTS, OF_SHAFTS  # late: contacts do not need it

    quantities = {}
    for place, keys, names in (("elements", elements, OF_ELEMENTS), ("shafts", shafts, OF_SHAFTS)):
        for key, (name, known) in product(keys, names.items()):
            written = f"{name} of {key}".replace("_", " ").lower(), f"{place}.{key}.{name}".lower()
            quantities[f"{place}.{key}.{name}"] = replace(CALIBRATED[known], names=written)
    inputs = {name: column for name, column in AXLE_CYCLE.columns.items() if column.key}
    examples = "'torque [N m]', 'voltage of rotor [V]' and 'uncertainty of voltage of rotor [%]'"
    columns = MappingProxyType({**inputs, **quantities})
    return ColumnBook(columns, examples, MOST_POINTS, frozenset(quantities))


# Options of a measurement: capacitance that is taken off each measured one, and uncertainty of columns that
# have none.
BACKGROUND = Amount("F", least=0.0, most=1e-3, reason="in parallel with the bearing")
UNCERTAINTY = Amount("", above=0.0, below=1.0, fraction=True, reason="relative, one standard deviation")


def parsed_option(quantity: Amount, name: str, value: str | float, takes: str = "") -> float:
    """Option in SI units; a text has its unit. ``takes`` says what the option of a command takes."""
    try:
        return quantity.parse(value)
    except InputError as error:
        if takes:
            raise InputError(name, got=shown(value), takes=f"{takes}, above 0 and below 100 %") from None
        raise error.under(name) from None


_UNCERTAINTY = "uncertainty"

# Name of the speed of a vehicle, from which a duty cycle computes the speed of its shaft.
VEHICLE_SPEED = "vehicle_speed"

# Longest head of a column [characters].
_LONGEST = 200


@dataclass(frozen=True)
class Column:
    """Column of a measurement, by its head."""

    # Name of the quantity in its book; of an uncertainty the name of the quantity, or ""  for the measured
    # one.
    name: str
    head: str
    unit: str  # unit in the head; "%" of a relative uncertainty
    uncertainty: bool = False  # whether the column contains standard uncertainties
    book: ColumnBook = field(default=MEASURED, repr=False)

    def factor(self) -> float:
        """Factor from the unit of the column to the SI unit; 0.01 for a relative uncertainty in per cent.

        Raises ValueError if the unit is not one of the quantity; the message says why.
        """
        unit = "" if self.name == "" else self.book.columns[self.name].unit
        if self.unit == "%":
            if self.uncertainty or (self.name and not unit):
                return 0.01
            raise ValueError("the value of 100 % is unknown")
        if not unit and self.unit in ("-", "1"):
            return 1.0
        return _factor(self.unit, unit)

    def value(self, number: float) -> float:
        """Value in SI units of a number in the unit of the column; an uncertainty stays a difference. Raises
        ValueError if the unit is not one of the quantity, or the value is out of its bounds.
        """
        if self.uncertainty:
            if not 0.0 < (value := number * self.factor()) < math.inf:
                raise ValueError("an uncertainty above 0")
            return value
        bounds = self.book.columns[self.name]
        value = units.absolute(number, self.unit) if bounds.unit == "K" else number * self.factor()
        if not bounds.allow(value):
            least = f"above {bounds.above:g}" if math.isfinite(bounds.above) else f"at least {bounds.least:g}"
            unit = f" {bounds.unit}"
            raise ValueError(f"{least}{unit} and at most {bounds.most:g}{unit}: {bounds.reason}")
        return value


@lru_cache(maxsize=64)
def _factor(written: str, unit: str) -> float:
    """Factor from a unit to an SI unit; a column asks for it once a row."""
    return units.factor(written, unit)


def column_of(head: str, book: ColumnBook = MEASURED) -> Column | None:
    """Column by its head, such as "speed [rpm]" or "capacitance (pF)"; None for an unknown quantity. Returns
    column of a known quantity or of its uncertainty. Raises InputError if the quantity is known, but its unit
    is missing or is not one of the quantity.

    Examples
    --------
    >>> column_of("Capacitance [pF]").name, column_of("uncertainty [%]").uncertainty
    ('capacitance', True)
    >>> column_of("speed [m/s]").name, column_of("speed_rpm").unit, column_of("Drehzahl in 1/min").name
    ('entrainment_speed', 'rpm', 'speed')
    >>> column_of("remark") is None
    True
    """
    read = _parts_of(head, book)
    if read is None:
        return None
    if read.unit is None:
        if not read.uncertain and book.columns[read.known].spare:
            return None
        usual = "%" if read.uncertain else book.columns[read.known].usual
        raise InputError(
            f"column {shown(read.text)}",
            "has no unit",
            takes=f"a unit in brackets, as '{read.name} [{usual}]'",
        )
    if read.uncertain:
        return Column(read.known, read.text, read.unit, uncertainty=True, book=book)
    return _checked(read.known, read.text, read.unit, book)


@dataclass(frozen=True)
class _Head:
    """Head of a column with a known quantity."""

    text: str
    name: str  # without the unit, as it is written
    unit: str | None
    known: str  # name of the quantity in its book; "" of an uncertainty without one
    uncertain: bool


def _parts_of(head: str, book: ColumnBook) -> _Head | None:
    """Name and unit of a head; None for an unknown quantity."""
    text = " ".join(head[: _LONGEST + 1].strip().strip("\"'").split())
    if len(text) > _LONGEST:
        return None
    if text.lower() in _TURNS and "speed" in book.columns:
        return _Head(text, "speed", text, "speed", uncertain=False)
    name, unit = name_and_unit(text)
    return _known_head(text, name, unit, book) or (None if unit is not None else _with_bare_unit(text, book))


def _known_head(text: str, name: str, unit: str | None, book: ColumnBook) -> _Head | None:
    bare = _folded(name)
    uncertain = _UNCERTAINTY in bare
    words = bare.replace(_UNCERTAINTY + " of", "").replace(_UNCERTAINTY, "").strip()
    if words not in book.names and not (uncertain and not words):
        return None
    return _Head(text, name, unit, book.names.get(words, ""), uncertain)


# Between a name and a unit without brackets: "speed_rpm", "Zeit in s", "U / V", "Torque, N m".
_BETWEEN = re.compile(r"\s*+[_,/:]\s*+|\s+(?:in\s+)?")

# Units of rotation that stand alone over a column of speeds.
_TURNS = ("rpm", "1/min", "min-1", "u/min", "tr/min", "r/min")

# Largest number of words of a head with a unit without brackets.
_MOST_WORDS = 12


def _with_bare_unit(text: str, book: ColumnBook) -> _Head | None:
    """Name and unit of a head without brackets; None if its end is not a unit.

    In a name of a program, "rad_s", "radps" and "m_per_s" are quotients, and "mPa_s" is a product.
    """
    for match in islice(_BETWEEN.finditer(text), _MOST_WORDS):
        end = text[match.end() :].strip()
        head = _known_head(text, text[: match.start()], end, book)
        if head is None or not end:
            continue
        of_program = end.replace("_per_", "/").replace("_", "/"), end.replace("_", " ")
        quotient = (f"{end[:-2]}/s",) if end.endswith("ps") else ()
        for unit in (end, *of_program, *quotient):
            fits = any(units.is_unit(unit, book.columns[name].unit) for name in _candidates(head.known, book))
            if unit == "%" or known_factor(unit, unit) is not None or degree(unit) is not None:
                if fits or not head.known or len(end.split("_")) == 1:
                    return replace(head, unit=unit)
            elif fits:
                return replace(head, unit=unit)
    return None


# Quantities that a speed may be, whose unit is a unit of a velocity.
_VELOCITIES = ("entrainment_speed", VEHICLE_SPEED)


def _candidates(name: str, book: ColumnBook) -> tuple[str, ...]:
    """Quantities of a book that a name over a column may mean: the unit of a speed says which speed it is."""
    others = {"speed": _VELOCITIES, VEHICLE_SPEED: ("speed",)}.get(name, ())
    return tuple(each for each in (name, *others) if each in book.columns)


# Units of the speeds of vehicles, in small letters: an entrainment speed in them needs its whole name.
_OF_VEHICLES = ("km/h", "mph", "mi/h", "kn", "knot")


def _checked(name: str, head: str, unit: str, book: ColumnBook) -> Column:
    """Column whose unit belongs to its quantity; a speed in m/s is an entrainment speed or the speed of the
    vehicle, if the book contains either of them, and the speed of a vehicle in rpm is a speed.
    """
    reasons = []
    candidates = _candidates(name, book)
    if plain(unit).lower() in _OF_VEHICLES:
        candidates = tuple(each for each in candidates if each != "entrainment_speed" or each == name)
    for candidate in candidates:
        column = Column(candidate, head, unit, book=book)
        try:
            if book.columns[candidate].unit == "K":
                units.absolute(0.0, unit)
            else:
                column.factor()
        except ValueError as error:
            reasons.append(str(error))
        else:
            return column
    raise InputError(
        f"column {shown(head)}",
        f"has the unit {shown(unit)} ({reasons[0]})",
        takes=f"values in {book.columns[name].usual} or another unit of this quantity",
    )


# Quantities that a meter prints in one of its modes, all of which give a parallel capacitance, and the
# impedance [Ohm] that they state.
_TURN = 2.0 * math.pi
_MODES: Mapping[tuple[str, ...], Callable[..., Array]] = {
    ("impedance", "phase", "frequency"): lambda z, phase, _: z * np.exp(1j * phase),
    ("series_resistance", "reactance", "frequency"): lambda r, x, _: r + 1j * x,
    ("series_capacitance", "series_resistance", "frequency"): lambda c, r, f: (
        r - 1j / (2.0 * math.pi * f * c)
    ),
    ("series_capacitance", "dissipation", "frequency"): lambda c, d, f: (d - 1j) / (_TURN * f * c),
}

# Quantities that only a mode has, and the columns of the modes in the words of an error.
_OF_MODES = ("impedance", "phase", "series_resistance", "series_capacitance", "reactance")
_MODE_TEXT = (
    "a column 'capacitance [pF]', or the frequency with impedance and phase, Rs and Xs, or Cs and Rs, such "
    "as 'frequency [Hz]', 'impedance [ohm]' and 'phase [deg]'"
)


@dataclass(frozen=True, eq=False)
class MeasuredCapacitance:
    """Parallel capacitance of measured rows, with the background in it."""

    value: Array  # capacitance [F]; NaN where the phase does not belong to a capacitor, shape (n,)
    uncertainty: Array | None  # standard uncertainty [F]; None where the measurement states none, shape (n,)
    # Parallel resistance [Ohm], infinite at a phase of -90 deg; None where a capacitance was measured,
    # shape (n,).
    resistance: Array | None = None


def parallel_circuit(magnitude: Array, phase: Array, frequency: Array) -> tuple[Array, Array]:
    """Capacitance and resistance in parallel that have an impedance, C = -sin(phase)/(2 pi f magnitude).

    ``magnitude``, ``phase`` and ``frequency``, magnitude of the impedance [Ohm], its phase [rad], negative
    for a capacitor, and the frequency f [Hz], shape (n,). Returns C [F], and R = magnitude/cos(phase) [Ohm],
    shape (n,); C is negative for an inductive phase.

    Examples
    --------
    >>> c, r = parallel_circuit(np.array([1e4]), np.array([-np.pi / 3]), np.array([1e5]))
    >>> round(float(c[0]) * 1e12, 3), round(float(r[0]))
    (137.832, 20000)
    """
    capacitance = -np.sin(phase) / (2.0 * math.pi * frequency * magnitude)
    with np.errstate(divide="ignore"):
        resistance = magnitude / np.cos(phase)
    return capacitance, resistance


def capacitance_of(measured: Measurement, uncertainty: float | None = None) -> MeasuredCapacitance:
    """Parallel capacitance of all rows of a measurement, with its uncertainty. Columns of the measurement
    are used instead of ``uncertainty``. Raises InputError if the measurement has neither, or has both.
    """
    both = next((name for name in _OF_MODES if measured.has("capacitance", name)), None)
    if both in ("impedance", "series_capacitance"):
        words = both.replace("_", " ")
        raise InputError(measured.source, f"has a capacitance and an {words}", takes="one of the two")
    if measured.has("capacitance"):
        value = measured.values["capacitance"]
        stated = measured.uncertainties.get("capacitance")
        return MeasuredCapacitance(value, _stated(value, stated, uncertainty))
    lacking = {mode: [name for name in mode if not measured.has(name)] for mode in _MODES}
    mode = min(lacking, key=lambda each: len(lacking[each]))
    if lacking[mode]:
        of_file = f"; the file contains {listed_heads((*measured.heads.values(), *measured.ignored))}"
        if not any(measured.has(name) for name in _OF_MODES):
            raise InputError.missing(f"{measured.source}: capacitance", f"{_MODE_TEXT}{of_file}")
        missing, given = lacking[mode][0], mode[0].replace("_", " ")
        of_quantity = f"a column of this quantity with the {given}"
        raise InputError.missing(f"{measured.source}: {missing}", f"{of_quantity}{of_file}")
    columns = [measured.values[name] for name in mode]
    value, resistance = _parallel(mode, columns)
    stated = _of_mode(measured, mode, columns)
    value = np.where(value > 0.0, value, np.nan)
    return MeasuredCapacitance(value, _stated(value, stated, uncertainty), resistance)


def _parallel(mode: tuple[str, ...], columns: Sequence[Array]) -> tuple[Array, Array]:
    """Capacitance and resistance in parallel from the quantities of a mode."""
    impedance = _MODES[mode](*columns)
    return parallel_circuit(np.abs(impedance), np.angle(impedance), columns[mode.index("frequency")])


def _of_mode(measured: Measurement, mode: tuple[str, ...], columns: Sequence[Array]) -> Array | None:
    """Uncertainty of the capacitance [F] from the uncertainties of the quantities, in quadrature."""
    given = {k: measured.uncertainties[name] for k, name in enumerate(mode) if name in measured.uncertainties}
    if not given:
        return None
    squares = []
    for k, uncertainty in given.items():
        # Central differences over a small part of the uncertainty.
        ends = [
            _parallel(mode, [*columns[:k], columns[k] + sign * _PART * uncertainty, *columns[k + 1 :]])[0]
            for sign in (1.0, -1.0)
        ]
        squares.append(((ends[0] - ends[1]) / (2.0 * _PART)) ** 2)
    total: Array = np.sqrt(np.sum(squares, axis=0))
    return total


# Part of an uncertainty over which differences are taken.
_PART = 1e-3


def _stated(value: Array, stated: Array | None, relative: float | None) -> Array | None:
    if stated is not None:
        return stated
    return None if relative is None else relative * value


# Largest numbers of lines above the heads, and of columns.
_MOST_ABOVE, _MOST_COLUMNS = 500, 200


@dataclass(frozen=True, eq=False)
class Measurement:
    """Measured rows for a case, SI units."""

    source: str  # path of the file, or "table" for a table of pandas
    lines: tuple[int, ...]  # line of each row in the file, from 1; of a table its rows, from 1
    values: Mapping[str, Array]  # quantities of the rows by name, as their book has them, shape (n,)
    # Standard uncertainties of the quantities, in the same units; relative ones are multiplied out,
    # shape (n,).
    uncertainties: Mapping[str, Array]
    ignored: tuple[str, ...] = ()  # heads of columns that are not known, and were ignored
    void: tuple[int, ...] = ()  # lines of rows without a value in a known column, which are not used
    heads: Mapping[str, str] = field(default_factory=dict)  # heads of the quantities by name

    @property
    def size(self) -> int:
        """Number of rows."""
        return len(self.lines)

    def only(self, *names: str) -> Measurement:
        """Measurement whose other quantities are ignored columns."""
        spare = tuple(self.heads[name] for name in self.values if name not in names)
        values, uncertain = (
            {name: column for name, column in of.items() if name in names}
            for of in (self.values, self.uncertainties)
        )
        ignored = (*self.ignored, *spare)
        return replace(self, values=values, uncertainties=uncertain, ignored=ignored)

    def has(self, *names: str) -> bool:
        """Whether the measurement has all of some quantities."""
        return all(name in self.values for name in names)


@dataclass(frozen=True)
class _Rows:
    heads: Sequence[str]
    cells: Sequence[Sequence[str]]
    lines: tuple[int, ...]
    dialect: Dialect
    units: Mapping[int, Sequence[str]]  # units of the cells of known columns by their place
    skipped: tuple[str, ...] = ()  # names of tables that are not used


def read_measurement(measured: str | Path | pd.DataFrame, book: ColumnBook = MEASURED) -> Measurement:
    """Read a measurement from a text file or a table of pandas.

    ``measured``, text file with separators ``,``, ``;`` or tab, decimal points or (not with ``,``) decimal
    commas, and a line of heads such as ``speed [rpm];capacitance [pF]``; ``book``, quantities that its
    columns may have. Returns all rows in SI units. Raises InputError if the file cannot be read or is too
    large, has no heads that are known, a head has no unit or a wrong one, or a row has a value that is
    no number or is out of bounds; the line is named. A row without a value in a known column is not used.

    Examples
    --------
    >>> import pandas as pd
    >>> table = pd.DataFrame({"speed [rpm]": [1000, 3000], "capacitance [pF]": [260.0, 190.0]})
    >>> measurement = read_measurement(table)
    >>> measurement.size, measurement.values["capacitance"]
    (2, array([2.6e-10, 1.9e-10]))
    """
    if hasattr(measured, "columns") and hasattr(measured, "itertuples"):
        source, rows = "table", _of_table(measured, book)
    else:
        path = Path(measured)
        source, rows = str(path), _of_text(path, decoded(path, read_bytes(path, most=MOST_MEASURED)), book)
    columns, ignored, twins = _columns(source, rows.heads, book)
    if len(rows.cells) > book.most_rows:
        takes = f"at most {book.most_rows}; average them"
        raise InputError(source, f"has more than {book.most_rows} rows", takes=takes)
    rows, void = _without_void(source, rows, columns, book)
    numbers = {place: _values(source, rows, place, column) for place, column in columns.items()}
    _check_twins(source, rows, columns, numbers, twins)
    columns = {place: column for place, column in columns.items() if place not in twins}
    numbers = {place: numbers[place] for place in columns}
    values = {columns[place].name: numbers[place] for place in numbers if not columns[place].uncertainty}
    uncertain = {place: numbers[place] for place in numbers if columns[place].uncertainty}
    uncertainties = _uncertainties(source, columns, uncertain, values)
    known = {columns[place].name: columns[place].head for place in numbers if not columns[place].uncertainty}
    ignored = (*ignored, *(rows.heads[place] for place in twins), *rows.skipped)
    return Measurement(source, rows.lines, values, uncertainties, ignored, void, known)


# Largest relative difference of two columns with one head, as of the speed that a rig was set to and had.
_ALIKE = 0.01


def _check_twins(
    source: str,
    rows: _Rows,
    columns: Mapping[int, Column],
    numbers: Mapping[int, Array],
    twins: Mapping[int, int],
) -> None:
    """Refuse columns with one head and different values; ``twins``, place of the first by the second."""
    for second, first in twins.items():
        earlier, later = numbers[first], numbers[second]
        wrong = np.flatnonzero(np.abs(earlier - later) > _ALIKE * np.abs(earlier))
        if wrong.size:
            row = int(wrong[0])
            got = f"has two columns {shown(columns[first].head)}, and line {rows.lines[row]} has "
            got += f"{shown(rows.cells[row][first])} and {shown(rows.cells[row][second])}"
            raise InputError(source, got, takes="one of the two")


def _without_void(
    source: str, rows: _Rows, columns: Mapping[int, Column], book: ColumnBook
) -> tuple[_Rows, tuple[int, ...]]:
    """Rows with a value in every known column that has no gaps, and in one with gaps if there are any; and
    the lines of the other rows.
    """
    if not rows.cells:
        raise InputError(source, "has no rows below its headings", takes="at least one")
    places = [place for place, column in columns.items() if column.name not in book.gaps]
    gaps = [place for place in columns if place not in places and not columns[place].uncertainty]
    kept = [
        not any(is_void(row[place]) for place in places)
        and (not gaps or not all(is_void(row[place]) for place in gaps))
        for row in rows.cells
    ]
    if not any(kept):
        raise InputError(source, "has no row with a number in every known column", takes="at least one")
    cells = [row for row, whole in zip(rows.cells, kept, strict=True) if whole]
    lines = tuple(line for line, whole in zip(rows.lines, kept, strict=True) if whole)
    void = tuple(line for line, whole in zip(rows.lines, kept, strict=True) if not whole)
    used = {
        place: [unit for unit, whole in zip(column, kept, strict=True) if whole]
        for place, column in rows.units.items()
    }
    return replace(rows, cells=cells, lines=lines, units=used), void


def void_rows(measured: Measurement) -> Iterator[ResultWarning]:
    """Warning about rows of a measurement or a duty cycle without a value in a known column."""
    if measured.void:
        rows = measured.size + len(measured.void)
        yield ResultWarning.of(
            "rows-void", file=measured.source, void=len(measured.void), rows=rows, line=measured.void[0]
        )


def _of_table(table: pd.DataFrame, book: ColumnBook) -> _Rows:
    heads = [str(name) for name in table.columns]
    cells = [[str(cell).strip() for cell in row] for row in table.itertuples(index=False, name=None)]
    if cells:
        heads = _merged(heads, cells[0], Dialect(None), book)[0]
    whole = _Table(0, heads, list(enumerate(cells, 1)))
    written = {
        place: [column.unit] * len(cells) for place, column in _columns("table", heads, book)[0].items()
    }
    return _with_units("table", whole, written, Dialect(None))


@dataclass
class _Table:
    """Heads of a table in a file, and its rows with the numbers of their lines."""

    line: int  # line of the heads, from 1
    heads: list[str]
    rows: list[tuple[int, list[str]]]


def _of_text(path: Path, text: str, book: ColumnBook) -> _Rows:
    """Heads and rows of a text; the heads may be in a line of comment above the numbers.

    Tables below each other, as of the steps of a rig, are one table if all contain one set of known columns.
    """
    lines = text.removesuffix("\n").split("\n")
    tables, dialect = _tables_of(path, lines, book)
    first, *others = sorted(
        tables, key=lambda table: not _measures(_columns(str(path), table.heads, book)[0])
    )
    columns, _, twins = _columns(str(path), first.heads, book)
    measures, numbered = _measures(columns), _numbered(columns, twins)
    rows, skipped = list(first.rows), []
    written = {place: [column.unit] * len(rows) for place, column in columns.items()}
    for table in others:
        known, _, twins = _columns(str(path), table.heads, book)
        same = {key: place for place, key in _numbered(known, twins).items()}
        if measures and not _measures(known):
            skipped.append(f"the table below line {table.line}")
            continue
        if set(same) != set(numbered.values()):
            got = f"has tables with different columns, below line {first.line} and line {table.line}"
            raise InputError(path, got, takes="one table, or tables with one set of columns")
        for place, key in numbered.items():
            written[place] += [known[same[key]].unit] * len(table.rows)
        for number, row in table.rows:
            cells = [""] * len(first.heads)
            for place, key in numbered.items():
                cells[place] = row[same[key]]
            rows.append((number, cells))
    return _with_units(path, _Table(first.line, first.heads, rows), written, dialect, tuple(skipped))


def _numbered(columns: Mapping[int, Column], twins: Mapping[int, int]) -> dict[int, tuple[str, bool, int]]:
    """Keys of columns by their place, with a number for the columns that have the head of another one."""
    order = {
        place: list(twins.values())[:k].count(first) + 1 for k, (place, first) in enumerate(twins.items())
    }
    return {place: (*_key(column), order.get(place, 0)) for place, column in columns.items()}


# Quantities that a film factor explains.
_MEASURED = ("capacitance", "impedance", "series_capacitance", "film")


def _measures(columns: Mapping[int, Column]) -> bool:
    return any(column.name in _MEASURED and not column.uncertainty for column in columns.values())


# Number with a unit in a cell, such as "123.4 pF".
_CELL = re.compile(r"([-+]?[\d.,]*\d[\d.,]*(?:[eE][-+]?\d+)?)\s*+([^\W\d_].*|[%°Ω∞].*)")


def _split(cell: str) -> tuple[str, str]:
    """Number of a cell and its unit, "" without one.

    Examples
    --------
    >>> _split("123.4 pF"), _split("-89.5°"), _split("1e-10"), _split("abc")
    (('123.4', 'pF'), ('-89.5', '°'), ('1e-10', ''), ('abc', ''))
    """
    if not cell or cell[-1].isdigit():
        return cell, ""
    match = _CELL.fullmatch(cell)
    return (cell, "") if match is None else (match[1], match[2])


def _with_units(
    path: object,
    table: _Table,
    written: Mapping[int, Sequence[str]],
    dialect: Dialect,
    skipped: tuple[str, ...] = (),
) -> _Rows:
    """Rows of a table whose cells may contain units; ``written``, units of the heads by place and row."""
    cells = [row for _, row in table.rows]
    numbers = tuple(number for number, _ in table.rows)
    given: dict[int, Sequence[str]] = {}
    for place, of_heads in written.items():
        pairs = [_split(row[place]) for row in cells]
        for row, (number, _) in zip(cells, pairs, strict=True):
            row[place] = number
        given[place] = [unit or head for (_, unit), head in zip(pairs, of_heads, strict=True)]
        if table.heads[place].startswith(_FROM_CELLS):
            bare = [k for k, (cell, unit) in enumerate(pairs) if not unit and not is_void(cell)]
            if bare:
                cell = cells[bare[0]][place]
                if is_overload(cell):
                    raise InputError(path, f"line {numbers[bare[0]]}: got {shown(cell)}", takes=OVERLOADED)
                got = f"line {numbers[bare[0]]}: got {shown(cell)} without a unit"
                raise InputError(path, got, takes="a unit in the head of the column, or in each of its cells")
    heads = [head.removeprefix(_FROM_CELLS) for head in table.heads]
    if dialect.separator is not None:
        mark = decimal_mark(path, zip(numbers, cells, strict=True), dialect.separator)
        dialect = replace(dialect, decimal=mark)
    return _Rows(heads, cells, numbers, dialect, given, skipped=skipped)


# Mark of a head whose unit is from the cells below it.
_FROM_CELLS = "\x1f"


def _tables_of(path: Path, lines: list[str], book: ColumnBook) -> tuple[list[_Table], Dialect]:
    """Tables of a text, one or more below each other, and their dialect."""
    heads, first, dialect = _heads(path, lines, book)
    table = _Table(first, heads, [])
    tables, title = [table], ""
    count = 0
    for number, row in dialect.records(path, lines, first):
        if not any(row) or row[0].startswith("#"):
            continue
        if _is_heads(row, dialect, book):
            table = _Table(number, row, [])
            tables.append(table)
            title = ""
        elif title or _is_title(row, table.heads, dialect, book):
            if any(_split(cell)[1] or dialect.number(cell) is not None for cell in row) and title:
                got = f"line {number} has numbers below {shown(title)}"
                raise InputError(path, got, takes="a line of headings below each title")
            title = title or short(" ".join(filter(None, row)))
        else:
            table.rows.append((number, _fitted(path, number, row, table.heads)))
            count += 1
            if count > book.most_rows:
                break
    for each in tables:
        if each.rows:
            each.heads, units_below = _merged(each.heads, each.rows[0][1], dialect, book)
            each.rows = each.rows[1:] if units_below else each.rows
    return [each for each in tables if each.rows] or tables[:1], dialect


def _is_heads(row: Sequence[str], dialect: Dialect, book: ColumnBook) -> bool:
    """Whether a row contains heads: at least one of them is known, and none is a number."""
    if any(cell[:1].isdigit() or dialect.number(cell) is not None for cell in row):
        return False
    return any(_parts_of(cell, book) is not None for cell in row if cell)


def _is_title(row: Sequence[str], heads: Sequence[str], dialect: Dialect, book: ColumnBook) -> bool:
    """Whether a row is a text between two tables, as the name of a step or "Interval and points: 2 31"."""
    text, *others = row
    if text.endswith(":"):
        return True
    if not text or len(heads) == 1 or any(is_void(cell) for cell in row if cell):
        return False
    known = len(row) < len(heads) or (not any(others) and _parts_of(heads[0], book) is not None)
    return known and not any(dialect.number(_split(cell)[0]) is not None for cell in row)


def _fitted(path: Path, number: int, row: list[str], heads: Sequence[str]) -> list[str]:
    """Cells of a row below all heads; empty cells without a head, at the end of the line, do not count."""
    more = row[len(heads) :]
    less = heads[len(row) :]
    if any(more) or any(less):
        raise InputError(
            path, f"line {number} has {len(row)} columns", takes=f"{len(heads)} as in its headings"
        )
    return [*row[: len(heads)], *less]


def _merged(
    heads: Sequence[str], row: Sequence[str], dialect: Dialect, book: ColumnBook
) -> tuple[list[str], bool]:
    """Heads, which get their units from the row below them if they contain none: a row of units, or cells
    with units. Also returns whether the row contains units only.
    """
    merged, used = list(heads), False
    lacking = {place: part for place, head in enumerate(heads) if (part := _parts_of(head, book)) is not None}
    lacking = {place: part for place, part in lacking.items() if part.unit is None and place < len(row)}
    of_units = not any(_split(cell)[1] or dialect.number(cell) is not None for cell in row)
    for place, part in lacking.items():
        unit = row[place].strip("[]() ") if of_units else _split(row[place])[1]
        try:
            known = column_of(f"{part.name} [{unit}]", book) if unit else None
        except InputError:
            continue
        if known is not None:
            merged[place], used = f"{'' if of_units else _FROM_CELLS}{part.name} [{unit}]", True
    return merged, used and of_units


def _heads(path: Path, lines: list[str], book: ColumnBook) -> tuple[list[str], int, Dialect]:
    """Heads in the first line with a known quantity, the place of the line below, and their dialect."""
    wrong: InputError | None = None
    listed: Sequence[str] = ()
    for place in range(min(len(lines), _MOST_ABOVE)):
        record, below = record_at(lines, place)
        text = uncommented(record)
        dialect = Dialect.of_heads(text)
        heads = dialect.fields(text)
        if len(heads) > 1 and any(dialect.number(head) is not None for head in heads[:_MOST_COLUMNS]):
            # The name of a quantity with its value, as above the table of a rig.
            continue
        listed = heads if len(heads) >= len(listed) else listed
        if len(heads) == 1 and len(text) <= _LONGEST and _with_bare_unit(text.strip(), book) is not None:
            # A sentence may end with a unit.
            continue
        known = 0
        try:
            known = _number_known(heads, lines, below, dialect, book)
        except InputError as error:
            # A sentence above the heads may be the name of a quantity, too: it has no unit.
            wrong = wrong or error
        if known:
            if len(heads) > _MOST_COLUMNS:
                raise InputError(path, f"has {len(heads)} columns", takes=f"at most {_MOST_COLUMNS}")
            return heads, below, dialect
    if wrong is not None:
        raise InputError(path, str(wrong))
    raise _unknown(path, listed, book)


# Most headings that an error lists.
_LISTED = 9


def listed_heads(heads: Iterable[str]) -> str:
    """Return the first headings of a file as a message shows them; empty without any.

    Examples
    --------
    >>> listed_heads(["speed [rpm]", "", "C"])
    "'speed [rpm]', 'C'"
    """
    listed = [shown(printable(head)) for head in heads if head]
    return ", ".join(listed[:_LISTED]) + ", ..." * (len(listed) > _LISTED)


def _unknown(source: object, heads: Sequence[str], book: ColumnBook) -> InputError:
    """Error of a file without known headings, which lists those that it has."""
    listed = listed_heads(heads)
    has = f", but {listed}" if listed else ""
    return InputError(
        source, f"has no headings of known columns{has}", takes=f"headings such as {book.examples}"
    )


def _number_known(
    heads: Sequence[str], lines: Sequence[str], below: int, dialect: Dialect, book: ColumnBook
) -> int:
    """Number of heads of known columns with a unit, which may be in the line below. Raises InputError if
    there is none, and a known column has no unit or a wrong one.
    """
    next_row = next((dialect.fields(line) for line in lines[below : below + 3] if line.strip()), [])
    known, wrong = 0, None
    for head in _merged(heads[:_MOST_COLUMNS], next_row, dialect, book)[0]:
        try:
            known += column_of(head.removeprefix(_FROM_CELLS), book) is not None
        except InputError as error:
            wrong = wrong or error
    if wrong is not None and not known:
        raise wrong
    return known


def _columns(
    source: str, heads: Sequence[str], book: ColumnBook
) -> tuple[dict[int, Column], tuple[str, ...], dict[int, int]]:
    """Known columns by their place, heads of the others, and repeated columns: place of the first by the
    place of the second.
    """
    columns: dict[int, Column] = {}
    doubtful: dict[int, Column] = {}
    twins: dict[int, int] = {}
    for place, head in enumerate(heads):
        in_doubt = _in_doubt(head)
        try:
            column = column_of(head.removeprefix(_FROM_CELLS), book)
        except InputError as error:
            if in_doubt:
                continue
            raise InputError(source, str(error)) from None
        if column is None:
            continue
        if in_doubt:
            doubtful[place] = column
            continue
        same = [(at, other) for at, other in columns.items() if _key(other) == _key(column)]
        if same and same[0][1].head == column.head:
            twins[place] = same[0][0]
        elif same:
            raise InputError(
                source,
                f"has the columns {shown(same[0][1].head)} and {shown(column.head)}",
                takes="one of the two",
            )
        columns[place] = column
    columns = dict(sorted({**columns, **_without_doubt(doubtful, columns)}.items()))
    columns = _with_vehicle(source, heads, columns, book)
    if all(column.uncertainty for column in columns.values()):
        raise _unknown(source, heads, book)
    ignored = (printable(short(head)) for place, head in enumerate(heads) if place not in columns)
    return columns, tuple(head for head in ignored if head), twins


# Names of a single letter that mean something else in files without a meter.
_LETTERS = ("r", "x", "d", "phi", "φ")

# Name of a program whose end is a quotient, as in "speed_radps".
_QUOTIENT = re.compile(r"\S*_[a-z]+ps", re.IGNORECASE)


def _in_doubt(head: str) -> bool:
    """Whether a head counts only if no other one names its quantity: a letter, a bare unit of rotation, or
    the name of a program.
    """
    text = head.removeprefix(_FROM_CELLS).strip().lower()
    letter = re.split(r"[\s_\[(/,:]", text, maxsplit=1)[0] in _LETTERS
    return letter or text in _TURNS or _QUOTIENT.fullmatch(text) is not None


def _without_doubt(doubtful: Mapping[int, Column], columns: Mapping[int, Column]) -> dict[int, Column]:
    """Columns of doubtful heads that no other column names: letters belong to a meter with a frequency and
    without a capacitance or a film, and there is one speed.
    """
    names = {column.name for column in columns.values()}
    of_meter = "frequency" in names and not names & {"capacitance", "film"}
    speeds = {"speed", *_VELOCITIES}
    certain: dict[int, Column] = {}
    for place, column in doubtful.items():
        known = names | {each.name for each in certain.values()}
        taken = known & speeds if column.name in speeds else known & {column.name}
        if not taken and (column.name in speeds or of_meter):
            certain[place] = column
    return certain


def _with_vehicle(
    source: str, heads: Sequence[str], columns: Mapping[int, Column], book: ColumnBook
) -> dict[int, Column]:
    """Columns of a duty cycle with the speed of its vehicle, which may have any name if its unit is a unit of
    vehicles. If a speed of the shaft is known, the speed of the vehicle is ignored.
    """
    names = {column.name for column in columns.values()}
    if VEHICLE_SPEED not in book.columns or "speed" in names:
        return {place: column for place, column in columns.items() if column.name != VEHICLE_SPEED}
    units_of = {
        place: name_and_unit(head)[1] or re.split(r"[\s_]", head.strip())[-1]
        for place, head in enumerate(heads)
    }
    vehicles = {
        place: Column(VEHICLE_SPEED, heads[place].strip(), unit, book=book)
        for place, unit in units_of.items()
        if place not in columns and plain(unit).lower() in _OF_VEHICLES
    }
    if VEHICLE_SPEED in names:
        return dict(columns)
    if len(vehicles) > 1:
        named = " and ".join(shown(column.head) for column in vehicles.values())
        raise InputError(source, f"has the columns {named}", takes="one speed of the vehicle")
    return {**columns, **vehicles}


def _key(column: Column) -> tuple[str, bool]:
    return column.name, column.uncertainty


def _values(source: str, rows: _Rows, place: int, column: Column) -> Array:
    """Values of a column in SI units, shape (n,)."""
    written = rows.units.get(place, [column.unit] * len(rows.cells))
    kinds = {unit: replace(column, unit=unit) for unit in dict.fromkeys(written)}
    values = np.empty(len(rows.cells))
    for k, (row, line) in enumerate(zip(rows.cells, rows.lines, strict=True)):
        cell, kind = row[place], kinds[written[k]]
        if column.name in column.book.gaps and is_void(cell):
            values[k] = math.nan
            continue
        try:
            number = rows.dialect.value(cell)
            # A relative uncertainty has no quantity of its own; others are converted with the quantity of the
            # value.
            later = column.uncertainty and column.unit != "%"
            if column.uncertainty and kind.unit != column.unit:
                raise ValueError(f"the unit {column.unit} of the column")
            values[k] = number if later else kind.value(number)
        except ValueError as error:
            got = f"line {line}, {column.head}: got {shown(cell)}"
            got += f" {kind.unit}" if kind.unit != column.unit else ""
            raise InputError(source, got, takes=str(error)) from None
    for unit, kind in kinds.items():
        marked = [
            row[place]
            for row, each in zip(rows.cells, written, strict=True)
            if each == unit and rows.dialect.decimal in row[place]
        ]
        _refuse_grouped(source, marked, kind)
    return values


def _refuse_grouped(source: str, cells: Sequence[str], column: Column) -> None:
    """Refuse a column whose separators may be separators of thousands."""
    bounds = None if column.uncertainty else column.book.columns[column.name]
    if bounds is None or bounds.unit == "K":
        return
    cell = doubt_of_column(cells, bounds, column.factor())
    if cell is not None:
        whole, part = re.split("[.,]", cell)
        decimal, thousands = readings(whole, part, "")
        raise InputError(
            source,
            f"{column.head}: all numbers have three digits after the separator, so that {shown(cell)} may be "
            f"{decimal} or {thousands}",
            takes="numbers without separators of thousands, or with another number of decimals",
        )


def _uncertainties(
    source: str, columns: Mapping[int, Column], uncertain: Mapping[int, Array], values: Mapping[str, Array]
) -> dict[str, Array]:
    """Standard uncertainties in SI units by quantity; one without a name belongs to the measured quantity."""
    uncertainties: dict[str, Array] = {}
    for place, numbers in uncertain.items():
        column = columns[place]
        name = column.name or next((key for key in _MEASURED if key in values), "")
        if name not in values:
            what = name or "capacitance, impedance or film"
            raise InputError(source, f"has the column {shown(column.head)}", takes=f"a column {what} with it")
        if column.unit == "%":
            uncertainties[name] = numbers * np.abs(values[name])
        else:
            uncertainties[name] = _absolute(source, column, name, numbers)
    return uncertainties


def _absolute(source: str, column: Column, name: str, numbers: Array) -> Array:
    """Uncertainties in the SI unit of a quantity, from numbers in the unit of the column."""
    absolute = column.book.columns[name].unit == "K"
    degree = units.degree(column.unit) if absolute else None
    try:
        factor = (
            Column(name, column.head, column.unit, book=column.book).factor() if degree is None else degree
        )
    except ValueError as error:
        takes = f"per cent or a unit of {name.replace('_', ' ')}"
        raise InputError(source, f"column {shown(column.head)}: {error}", takes=takes) from None
    if np.any(numbers <= 0.0):
        raise InputError(source, f"column {shown(column.head)} has a value of 0 or below", takes="above 0")
    return numbers * factor
