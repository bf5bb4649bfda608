"""Rows of key figures as data, and sheets: which quantities a kind of result shows, in which order."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from itertools import pairwise
from types import MappingProxyType
from typing import Any, NamedTuple, TypeAlias

from ehlectric.quantities.formats import UNITS, USUAL, scale_of, suited
from ehlectric.quantities.quantity import BOUNDS, Bound, Keys, Quantity, key_of
from ehlectric.readable import formatted

# Nested tables of a result, SI units, as in summary.json.
Summary: TypeAlias = Mapping[str, Any]


@dataclass(frozen=True)
class Row:
    r"""Row of a table: a name, a value with its unit, and a note. A row with only a name is a heading.

    Raises ValueError if the unit of a number is not in ``UNITS``.

    Examples
    --------
    >>> row = Row("Hertz pressure", 1.234567e9, "GPa")
    >>> row.shown, row.unit
    ('1.235', 'GPa')
    >>> Row("minimum film thickness", 2e-7, "µm", ", at the outlet").text
    '0.2 µm, at the outlet'
    >>> Row("breakdown voltage", 5.88, "V", bound="≤").text
    '≤ 5.88 V'
    >>> Row("rating life", 1e12, "h", bound="≤", ceiling=1e6).text.replace("\xa0", " ")
    'upper bound above 1 000 000 h'
    """

    name: str  # label of the quantity, which a reader understands without the other rows
    # Number in the SI unit of ``unit``, or a string; None for a row with a name and a note only.
    value: float | str | None = None
    unit: str = ""  # unit in which a number is shown, one of ``UNITS``, or the unit of a string
    note: str = ""  # note that follows the unit, or the value if there is no unit
    digits: str = field(default=".4g", kw_only=True)  # format of the shown number
    ceiling: float | None = field(default=None, kw_only=True)  # as of ``Quantity``
    alarm: bool = field(default=False, kw_only=True)  # True if the row says that the numbers must not be used
    # "≤" for a value that is an upper bound, "≥" for a lower bound; it holds for both ends of a range.
    bound: Bound = field(default="", kw_only=True)
    key: str = field(default="", kw_only=True)  # dotted key of the quantity; empty for a row that shows none

    def __repr__(self) -> str:
        """Name and text as a table shows them; ``value`` is in SI units, and ``unit`` is not."""
        return f"<Row {self.name}: {self.text}>"

    def __post_init__(self) -> None:
        if isinstance(self.value, int | float) and self.unit not in UNITS:
            raise ValueError(f"{self.unit!r} is no unit of a row; expected one of {', '.join(UNITS)}")

    @property
    def shown(self) -> str:
        """Value as a string, in the shown unit."""
        if self.value is None or isinstance(self.value, str):
            return self.value or ""
        return formatted(scale_of(self.unit).of(self.value), self.digits, self.ceiling)

    @property
    def bounded(self) -> str:
        """Value as a string in the shown unit, after the sign of its bound."""
        # A sign in front of "above" would contradict it.
        sign = BOUNDS[self.bound] if self.bound and self.shown.startswith("above") else self.bound
        return " ".join(filter(None, [sign, self.shown]))

    @property
    def amount(self) -> str:
        """Value with the sign of its bound and its unit."""
        return " ".join(filter(None, [self.bounded, self.unit]))

    @property
    def text(self) -> str:
        """Bound, value, unit and note as one string."""
        if self.note.startswith((",", ";", ":")):
            return self.amount + self.note
        return " ".join(filter(None, [self.amount, self.note.strip()]))

    @property
    def heading(self) -> bool:
        """True if the name is all that the row contains: a heading of the rows that follow."""
        return bool(self.name) and not self.text


@dataclass(frozen=True)
class Section:
    """Section of a sheet: its heading, and the keys of its quantities in the order in which they stand."""

    heading: str
    keys: tuple[str, ...]
    only: str = ""  # condition under which it is shown; empty for one that always is


# What a kind of result shows: one list for the terminal, the notebook, the report and the page.
Sheet: TypeAlias = tuple[Section, ...]


class ValueWithNote(NamedTuple):
    """Value of a quantity, as ``RowTexts`` gives it, with the note that follows it."""

    value: Any
    note: str


@dataclass(frozen=True)
class RowTexts:
    """Texts next to the numbers of a kind of result, by dotted key: functions of the summary."""

    notes: Mapping[str, Callable[[Summary], str]] = field(default_factory=dict)
    # Value instead of the stored one, or of a quantity that is not stored: a number in SI units, a text, a
    # text with its unit, or None where there is nothing to show; ``ValueWithNote`` for a value and a note.
    values: Mapping[str, Callable[[Summary], Any]] = field(default_factory=dict)
    # Whether a quantity says that the numbers must not be used.
    alarms: Mapping[str, Callable[[Summary], bool]] = field(default_factory=dict)
    # Rows of a key that stands for several quantities, as "film_formulas.*.minimum_thickness"
    rows: Mapping[str, Callable[[Summary], Iterable[Row]]] = field(default_factory=dict)
    # Conditions under which sections and quantities are shown, by name.
    holds: Mapping[str, Callable[[Summary], bool]] = field(default_factory=dict)
    # Keys that are shown only where a condition holds, by the name of the condition.
    only: Mapping[str, Iterable[str]] = field(default_factory=dict)

    def __or__(self, other: RowTexts) -> RowTexts:
        """Texts of both, where the other takes precedence, and the conditions of the first."""
        return RowTexts(
            {**self.notes, **other.notes},
            {**self.values, **other.values},
            {**self.alarms, **other.alarms},
            {**self.rows, **other.rows},
            self.holds,
            self.only,
        )


def sheet_rows(
    sheet: Iterable[Section],
    book: Keys,
    summary: Summary,
    words: RowTexts = RowTexts(),
    bounds: Mapping[str, Bound] = MappingProxyType({}),
) -> Iterator[Row]:
    """Rows of a sheet, without quantities that a summary lacks and without sections that have none.
    ``bounds``, "≤" or "≥" by the keys of numbers that are bounds only.

    Examples
    --------
    >>> book = {"film.error": Quantity("error"), "film.minimum": Quantity("", "m", "minimum film")}
    >>> sheet = [Section("film", ("film.error", "film.minimum"))]
    >>> [row.name for row in sheet_rows(sheet, book, {"film": {"error": None, "minimum": 1e-7}})]
    ['film', 'minimum film']
    """
    hidden = {key for name, keys in words.only.items() if not words.holds[name](summary) for key in keys}
    for section in sheet:
        if section.only and not words.holds[section.only](summary):
            continue
        keys = (key for key in section.keys if key not in hidden)
        rows = [row for key in keys for row in _row(key, book, summary, words, bounds)]
        if rows:
            yield Row(section.heading)
            yield from rows


def _row(
    key: str, book: Keys, summary: Summary, words: RowTexts, bounds: Mapping[str, Bound]
) -> Iterator[Row]:
    """Rows of a key; none where the summary has no value."""
    if key in words.rows:
        yield from words.rows[key](summary)
        return
    about = key_of(book, key)
    value = words.values[key](summary) if key in words.values else value_at(summary, key)
    value, note = value if isinstance(value, ValueWithNote) else (value, "")
    table, _, name = key.rpartition(".")
    if value is None and about is not None and about.null and name in (value_at(summary, table) or ()):
        value = about.null
    if value is None:
        return
    if about is None:
        raise KeyError(key)
    note = words.notes[key](summary) if key in words.notes else note or about.note
    alarm = words.alarms[key](summary) if key in words.alarms else False
    yield row_of(key, about, value, note, bound=bounds.get(key, ""), alarm=alarm)


# Addition to names of numbers that belong to the operating point of a file with a duty cycle.
_AT_POINT = "operating point"


def placed(name: str, key: str, summary: Summary) -> str:
    """Name of a number, or of a section with its first key, that states the operating point if the result
    contains a duty cycle and the key does not belong to it.

    Examples
    --------
    >>> placed("films", "bearing.lambda_ratio", {"duty": {}})
    'films, operating point'
    """
    whole = key.startswith("duty.") or ".duty_" in key or key == "seconds"
    return name if whole or not in_cycle(summary) else f"{name}, {_AT_POINT}"


def in_cycle(summary: Summary) -> bool:
    """Whether a result contains numbers of a duty cycle, or its file names one."""
    return summary.get("duty") is not None or "duty" in summary.get("inputs", ())


def placed_rows(rows: Iterable[Row], summary: Summary) -> Iterator[Row]:
    """Rows whose headings state the operating point; see ``placed``."""
    for row, following in pairwise([*rows, Row("")]):
        yield replace(row, name=placed(row.name, following.key, summary)) if row.heading else row


def row_of(
    key: str,
    about: Quantity,
    value: float | str | tuple[str, str],
    note: str = "",
    *,
    bound: Bound = "",
    alarm: bool = False,
) -> Row:
    """Row of a quantity with its label, unit and digits; a text may have its unit next to it.

    Examples
    --------
    >>> row_of("film.minimum", Quantity("", "m", "minimum film"), 2e-7).text
    '0.2 µm'
    >>> row_of("energy", Quantity("", "J", "energy"), 2e-9).text
    '2 nJ'
    """
    name = about.label or key
    if isinstance(value, tuple):
        return Row(name, *value, note, alarm=alarm, bound=bound, key=key)
    if isinstance(value, str):
        return Row(name, value, "", note, alarm=alarm, bound=bound, key=key)
    unit = shown_unit(about, value)
    row = Row(name, value, unit, note, digits=about.digits, alarm=alarm, bound=bound, key=key)
    return replace(row, ceiling=about.ceiling)


def shown_unit(about: Quantity, value: float) -> str:
    """Unit in which a value of a quantity is shown: its own, the usual one, or one that suits the value.

    Raises ValueError if its own is no unit of the quantity.
    """
    unit = about.shown or USUAL.get(about.unit, "prefixed")
    if unit == "prefixed":
        return suited(value, about.unit)[1]
    if UNITS[unit][0] != about.unit:
        name = about.label or about.meaning
        raise ValueError(f"{name} in {about.unit or 'no unit'} is not shown in {unit or 'no unit'}")
    return unit


def head_of(about: Quantity) -> str:
    """Head of a column: short label, and the unit in which all values of the quantity are shown.

    Examples
    --------
    >>> head_of(Quantity("", "J", "energy of a discharge", shown="nJ"))
    'energy of a discharge [nJ]'
    """
    unit = shown_unit(about, 1.0)
    head = about.head or about.label
    return f"{head} [{unit}]" if unit else head


def value_at(table: Summary, key: str) -> Any:
    """Value at a dotted key of nested tables and lists; None if a table of the path is None or lacks its key.

    Examples
    --------
    >>> value_at({"field": {"quantiles": [0.1, 0.5]}}, "field.quantiles.1")
    0.5
    """
    value: Any = table
    for name in key.split("."):
        if isinstance(value, Mapping):
            value = value.get(name)
        elif isinstance(value, list | tuple) and name.isdecimal() and int(name) < len(value):
            value = value[int(name)]
        else:
            return None
    return value
