"""Tables of numbers in text files, as instruments and spreadsheets write them.

Encoding, separator of the columns, decimal mark, quoted fields of RFC 4180, lines above the numbers, and rows
with the numbers of their lines. What the columns mean is the task of the reader of each kind of file.
"""

from __future__ import annotations

import codecs
import csv
import io
import math
import re
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from decimal import Decimal
from itertools import chain, islice
from pathlib import Path
from typing import Any

import numpy as np

from ehlectric.arrays import Array
from ehlectric.errors import InputError, shown
from ehlectric.quantities.grouped_digits import has_thousands, proven_mark, readings, ungrouped, value_of
from ehlectric.quantities.unit_spelling import typed
from ehlectric.runtime.file_kinds import not_text
from ehlectric.runtime.reading import blocks

# Texts of a field without a value, in small letters, as programs and instruments write them.
_VOIDS = frozenset(
    ("", "nan", "+nan", "-nan", "na", "n/a", "#n/a", "#na", "<na>", "null", "none", "bad", "-", "nodata")
)

# Signs that fill a field without a value, as Fortran and instruments write it.
_FILLERS = ("*", "-")

# Texts of a number beyond the range of an instrument, in small letters.
_INFINITE = ("inf", "infinity", "∞")

# Separator of a line with one column, which no text contains.
_NONE = "\x1f"

# Characters of a number, and its largest length [characters].
_OF_NUMBERS, _LONGEST_NUMBER = frozenset("0123456789+-.,eE"), 100

# Characters of a line whose fields are all empty.
_EMPTY = ' \t\r\f\v\u00a0;,"'

# Signs that begin a line of comment.
_COMMENT = "#%/"

# Largest number of lines of one record, whose quoted fields may contain line breaks.
_MOST_LINES = 20

# Size of a block [bytes], and longest line [characters], as a file without line ends would fill the memory.
_BLOCK, _LONGEST = 6_000_000, 100_000

# Largest number of lines that are tried with each separator.
_TRIED = 400

# Field of the first row that no file has to the right of its last column.
_FILLER = "beyond-the-last-column"

# Digits behind a decimal comma that was taken for a separator.
_CUT = re.compile(r"0\d+(?:[eE][-+]?\d+)?")

_QUOTED = re.compile(r'"[^"]*+"')
# First bytes of a text in UTF-16.
UTF_16 = (codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)


class NoTableError(InputError):
    """Error of a file without the columns of numbers that its reader expects."""


def is_text(content: bytes) -> bool:
    """Whether the content of a file looks like text."""
    return content[:2] in UTF_16 or b"\0" not in content[:4096]


def decoded(path: Path, content: bytes) -> str:
    """Text of a file in UTF-8, UTF-16 or Windows-1252 with line feeds at the ends of its lines.

    Raises NoTableError if the file is not text.
    """
    if not is_text(content):
        raise NoTableError(path, not_text(content))
    for code in ("utf-16",) if content[:2] in UTF_16 else ("utf-8-sig", "cp1252"):
        try:
            return content.decode(code).replace("\r\n", "\n").replace("\r", "\n")
        except UnicodeDecodeError:
            continue
    raise NoTableError(path, "is not text in UTF-8, UTF-16 or Windows-1252")


def text_blocks(path: Path, *, most: int) -> Iterator[str]:
    """Blocks of whole lines of a text file of at most ``most`` bytes, decoded like ``decoded``.

    Only the last line of the file may lack its end. Raises InputError if the file is too large, is not text
    or has a line of more than 100 000 characters.
    """
    decoder, rest, first = None, "", b""
    for block in chain(blocks(path, most=most, size=_BLOCK), [b""]):
        decoder, last, first = decoder or _decoder(block), len(block) < _BLOCK, first or block
        try:
            text = rest + decoder.decode(block, final=last)
        except UnicodeDecodeError:
            raise InputError(path, "is not text in UTF-16") from None
        if "\0" in text:
            raise InputError(path, not_text(first))
        end = text.rfind("\n") + 1
        if len(text) - end > _LONGEST:
            got = f"has a line of more than {_LONGEST} characters"
            raise InputError(path, got, takes="a row in each line")
        end = len(text) if last else end
        text, rest = text[:end], text[end:]
        if text:
            yield text


def _decoder(beginning: bytes) -> io.IncrementalNewlineDecoder:
    encoding, errors = "utf-8-sig", "replace"
    if beginning[:2] in UTF_16:
        encoding, errors = "utf-16", "strict"
    else:
        try:
            codecs.getincrementaldecoder("utf-8")().decode(beginning)
        except UnicodeDecodeError:
            encoding = "cp1252"
    return io.IncrementalNewlineDecoder(codecs.getincrementaldecoder(encoding)(errors), translate=True)


def is_void(field: str) -> bool:
    """Whether a field contains no value.

    Examples
    --------
    >>> is_void(" NaN"), is_void(""), is_void("***"), is_void("0")
    (True, True, True, False)
    """
    text = field.strip().lower()
    return text in _VOIDS or (text[:1] in _FILLERS and text == text[0] * len(text))


# Texts of an overload, in small letters, and what a user does about it.
_OVERLOADS = ("ol", "o.l", "o.l.", "ovl", "ovld", "overload", "overflow")
OVERLOADED = "a number, or an empty cell where the meter was overloaded"


def is_overload(field: str) -> bool:
    """Whether a field contains the overload of a meter.

    Examples
    --------
    >>> is_overload("OL"), is_overload("251.3")
    (True, False)
    """
    return field.strip().lower() in _OVERLOADS


@dataclass(frozen=True)
class Dialect:
    """Separator of columns, None for white space, and decimal mark."""

    separator: str | None
    decimal: str = "."

    @classmethod
    def of_heads(cls, line: str) -> Dialect:
        """Dialect of a line of heads, by the first separator outside of its quotes.

        Examples
        --------
        >>> Dialect.of_heads('"speed, mean [rpm]";film [nm]').separator
        ';'
        """
        bare = _QUOTED.sub("", line)
        return cls(next((mark for mark in (";", "\t", ",") if mark in bare), _NONE))

    def fields(self, line: str) -> list[str]:
        """Fields of a line, without white space and quotes around them. A quote without an end is ignored.

        Examples
        --------
        >>> Dialect(",").fields('"x, filtered [um]",z [nm]')
        ['x, filtered [um]', 'z [nm]']
        """
        if '"' in line and self.separator is not None:
            try:
                return [field.strip() for row in self._parsed([line.strip(" \n")]) for field in row]
            except csv.Error:
                pass
        return [field.strip().strip('"').strip() for field in line.split(self.separator)]

    def _parsed(self, lines: Iterable[str]) -> Any:
        ended = (line if line.endswith("\n") else f"{line}\n" for line in lines)
        return csv.reader(ended, delimiter=self.separator or " ", skipinitialspace=True, strict=True)

    def records(self, path: object, lines: Sequence[str], first: int = 0) -> Iterator[tuple[int, list[str]]]:
        """Fields of each record below the first lines, and the number of its last line from 1.

        A quoted field may contain the separator and line breaks, and a doubled quote is a quote. Raises
        InputError if a quoted field is not closed.

        Examples
        --------
        >>> list(Dialect(",").records("a.csv", ["a", '"1,500.5","5"" shaft"'], 1))
        [(2, ['1,500.5', '5" shaft'])]
        """
        reader = self._parsed(lines[first:])
        while True:
            place = first + reader.line_num
            try:
                row = next(reader, None)
            except csv.Error as error:
                got = f"line {place + 1}: got {shown(lines[place])} ({error})"
                raise InputError(path, got, takes="fields whose quotes are closed") from None
            if row is None:
                return
            yield first + reader.line_num, [field.strip() for field in row]

    def value(self, field: str) -> float:
        """Finite number in a field, which may have separators of thousands.

        Raises ValueError for other texts; the message says what is expected.
        """
        value = math.inf
        if field.lower().lstrip("+-") not in _INFINITE:
            try:
                if len(field) > _LONGEST_NUMBER or not _OF_NUMBERS.issuperset(field):
                    raise ValueError(field)
                value = value_of(field, self.decimal)
            except ValueError:
                if is_overload(field):
                    raise ValueError(OVERLOADED) from None
                mark = "point" if self.decimal == "." else "comma"
                raise ValueError(f"a number, with a decimal {mark} if it has decimals") from None
        if math.isinf(value):
            raise ValueError("a finite number")
        return value

    def number(self, field: str) -> float | None:
        """Number in a field that has no other reading; None for other texts.

        Examples
        --------
        >>> Dialect(";", ",").number("-1,5e-3"), Dialect(";", ",").number("1.500"), Dialect(";").number("∞")
        (-0.0015, None, None)
        >>> Dialect(",").number("1,500.5"), Dialect(",").number("1,500")
        (1500.5, None)
        """
        thousands = "," if self.decimal == "." else "."
        if (thousands in field and not has_thousands(field)) or field.endswith(","):
            return None
        try:
            return self.value(field)
        except ValueError:
            return None

    @property
    def other(self) -> Dialect:
        """Dialect with the other decimal mark."""
        return Dialect(self.separator, "," if self.decimal == "." else ".")

    def is_row(self, row: Sequence[str]) -> bool:
        """Whether all fields with a value are numbers, and any field has a value."""
        filled = [field for field in row if not is_void(field)]
        return bool(filled) and all(self.number(field) is not None for field in filled)


# In the order of preference: a comma separates columns only if neither semicolon nor tab does.
_DIALECTS = tuple(Dialect(separator, mark) for separator in (";", "\t", ",", None) for mark in ".,")


def decimal_mark(path: object, rows: Iterable[tuple[int, Sequence[str]]], separator: str | None) -> str:
    """Decimal mark of the numbers in rows, each with the number of its line.

    Raises InputError if the numbers have different marks, or may all be read with both.

    Examples
    --------
    >>> decimal_mark("a.csv", [(1, ["0,5", "remark"]), (2, ["1.500,25", ""])], ";")
    ','
    """
    numbers = [(cell, line) for line, row in rows for cell in row if _OF_NUMBERS.issuperset(cell)]
    marked = {mark: number for mark in ".," for number in reversed(numbers) if mark in number[0]}
    proofs = {mark: number for number in reversed(numbers) if (mark := proven_mark(number[0])) is not None}
    # A comma in quotes between commas separates thousands if a point is proven to be the decimal mark.
    certain = marked.keys() <= proofs.keys() or (separator == "," and "." in proofs)
    if len(proofs) == 1 and (certain or any(has_thousands(cell) for cell, _ in numbers)):
        return next(iter(proofs))
    if len(marked) > 1:
        (point, at), (comma, behind) = ({**marked, **proofs}[mark] for mark in ".,")
        got = f"{shown(point)} in line {at} and {shown(comma)} in line {behind}"
        raise InputError(path, f"mixes decimal points and decimal commas, {got}", takes="one of the two")
    if "," in marked and separator == ",":
        cell, line = marked[","]
        whole, part = cell.split(",")
        decimal, thousands = readings(whole, part, "")
        raise InputError(
            path,
            f"line {line} has the number {shown(cell)}, which may be {decimal} or {thousands}",
            takes="numbers without separators of thousands",
        )
    return next(iter(marked), ".")


def record_at(lines: Sequence[str], place: int) -> tuple[str, int]:
    r"""Text of the record that begins in a line, and the place of the line after it.

    Examples
    --------
    >>> record_at(['"speed', '[rpm]",film [nm]', "1,2"], 0)
    ('"speed\n[rpm]",film [nm]', 2)
    """
    quotes = 0
    for end in range(place, min(place + _MOST_LINES, len(lines))):
        quotes += lines[end].count('"')
        if quotes % 2 == 0:
            return "\n".join(lines[place : end + 1]), end + 1
    return lines[place], place + 1


def uncommented(line: str) -> str:
    r"""Line without signs of a comment before it. Without them, a tab at its start ends an empty field.

    Examples
    --------
    >>> uncommented("#\tt\tu"), uncommented("\tt\tu")
    ('t\tu', '\tt\tu')
    """
    text = line.lstrip(" ")
    return text.lstrip(f"{_COMMENT} \t") if text.startswith(tuple(_COMMENT)) else text


def name_and_unit(head: str) -> tuple[str, str | None]:
    """Name and unit of the head of a column: the unit is in the last brackets; None without brackets.

    Examples
    --------
    >>> name_and_unit("Film  (mean) [㎛]"), name_and_unit("t")
    (('Film (mean)', 'µm'), ('t', None))
    """
    text = " ".join(typed(head).split())
    for opening, closing in ("[]", "()"):
        start = text.rfind(opening)
        if start >= 0 and text.endswith(closing):
            return text[:start].strip(), text[start + 1 : -1].strip()
    return text, None


@dataclass(frozen=True)
class Layout:
    """Dialect, columns and header of a table of numbers."""

    dialect: Dialect
    columns: tuple[int, ...]  # places of the columns of numbers from 0
    width: int  # number of fields of a row
    first: int  # place of the first row from 0
    header: tuple[str, ...]  # lines above the rows, without signs of comments

    def below(self, text: str) -> str:
        """Text of the rows, below the header."""
        return text.split("\n", self.first)[self.first]

    def rows(self, text: str, line: int) -> Iterator[tuple[int, list[str]]]:
        """Rows of a text that begins with the line of a number, with the numbers of their lines.

        Rows without any field are omitted.
        """
        for number, each in enumerate(text.split("\n"), line):
            row = self.dialect.fields(each) if each.strip() else []
            if any(row):
                yield number, row

    def line_of(self, text: str, line: int, index: int) -> int:
        """Number of the line with a row of a text, by the index of the row from 0."""
        return next(islice(self.rows(text, line), index, None))[0]

    def numbers(
        self, path: object, places: Sequence[int], text: str, line: int, *, voids: Sequence[int] = ()
    ) -> tuple[Array, ...]:
        """Numbers of the columns at some places, in a text that begins with the line of a number.

        Fields of the columns ``voids`` may lack a value, which is NaN. For another field, and for a row that
        is too short or too long, raises InputError, which names the line and the column.
        """
        columns = self._at_once(places, text)
        if columns is None:
            rows = [self._row(path, places, voids, *row) for row in self.rows(text, line)]
            columns = tuple(np.array(rows, dtype=float).reshape(-1, len(places)).T.copy())
        return columns

    def _at_once(self, places: Sequence[int], text: str) -> tuple[Array, ...] | None:
        """Numbers as pandas reads them; None if it meets a line with other contents."""
        if '"' in text:
            # A quote that is not closed would make one field of many lines.
            return None
        import pandas as pd  # takes a while

        # Pandas ignores fields to the right of the last column, so that there is a column for them: its
        # category is empty. With a row of zeros before the others, the parser expects this column.
        kinds: dict[int, Any] = dict.fromkeys(places, np.float64) | {self.width: "category"}
        separator = self.dialect.separator
        longer = (separator or " ").join([*["0"] * self.width, _FILLER])
        try:
            table = pd.read_csv(
                io.StringIO(f"{longer}\n{text}"),
                sep=separator or r"\s+",
                decimal=self.dialect.decimal,
                header=None,
                names=range(self.width + 1),
                usecols=list(kinds),
                index_col=False,
                dtype=kinds,
                na_filter=False,
                skipinitialspace=True,
            )
        except ValueError:  # of pandas, too
            return None
        columns = tuple(table[place].to_numpy()[1:] for place in places)
        whole = {"", _FILLER}.issuperset(table[self.width].cat.categories)
        return columns if whole and all(np.isfinite(each).all() for each in columns) else None

    def _row(
        self, path: object, places: Sequence[int], voids: Sequence[int], number: int, row: Sequence[str]
    ) -> list[float]:
        count = max(k for k, field in enumerate(row, 1) if field)
        missing = [k for k in places if k >= len(row) or (k >= count and k not in voids)]
        if count > self.width or missing:
            got = f"line {number} has {count} columns" + "".join(f", no column {k + 1}" for k in missing)
            ends = "; is the file cut off?" if missing else ""
            raise InputError(path, got, takes=f"{self.width} as in other lines{ends}")
        return [
            math.nan if k in voids and is_void(row[k]) else self._value(path, number, k, row[k])
            for k in places
        ]

    def _value(self, path: object, number: int, place: int, field: str) -> float:
        value = self.dialect.number(field)
        if value is not None:
            return value
        got = f"line {number}, column {place + 1}: got {shown(field)}"
        if self.dialect.other.number(field) is not None:
            raise InputError(
                path, f"{got}, and mixes decimal points and decimal commas", takes="one of the two"
            )
        try:
            self.dialect.value(field)
        except ValueError as error:
            raise InputError(path, got, takes=str(error)) from None
        raise InputError(path, got, takes="a number without separators of thousands")

    def last_digit(self, place: int, ends: Iterable[Sequence[str]]) -> float:
        """Last printed digit of a column at that end of its lines where it is coarser.

        A program that omits zeros at the end prints some numbers with fewer digits than others. A program
        with a fixed number of digits prints fewer decimal places the larger a number is. At each end, the
        largest number therefore counts, with the most digits that any number there has.
        """
        digits = []
        for lines in ends:
            rows = map(self.dialect.fields, lines)
            fields = [row[place] for row in rows if place < len(row)]
            known = [field for field in fields if self.dialect.number(field) is not None]
            numbers = [Decimal(ungrouped(field, self.dialect.decimal)) for field in known]
            filled = [number for number in numbers if number] or numbers
            if filled:
                most = max(len(number.as_tuple().digits) for number in filled)
                digits.append(max(number.adjusted() for number in filled) - most + 1)
        return float(10.0 ** max([-300, *digits]))


def layout_of(path: object, lines: Sequence[str], *, strict: bool = False) -> Layout:
    """Layout of a table of numbers that ends with the last of some lines.

    Each of the rows of a comma and two whole numbers, such as "0,5", may also be one number. The number of
    heads decides; without heads, or if ``strict``, such rows are refused. The first row is a line of numbers
    that another one follows; if ``strict``, it is the first line of numbers. Raises NoTableError if the lines
    have no columns of numbers, and InputError if these may be read in two ways.

    Examples
    --------
    >>> table = layout_of("a.txt", ["# x [um];z [nm]", "0,5;12,5", "1,0;13"])
    >>> table.dialect, table.columns, table.header
    (Dialect(separator=';', decimal=','), (0, 1), ('x [um];z [nm]',))
    """
    filled = [(number, line) for number, line in enumerate(lines, 1) if line.strip(_EMPTY)]
    if not filled:
        raise NoTableError(path, "is empty", takes="lines of numbers")
    if max(len(line) for _, line in filled) > _LONGEST:
        raise NoTableError(path, f"has a line of more than {_LONGEST} characters", takes="a row in each line")
    dialect, rows = _dialect(path, filled, strict=strict)
    counts = Counter(place for row in rows for place, field in enumerate(row) if not is_void(field))
    columns = tuple(sorted(place for place, count in counts.items() if 2 * count > len(rows)))
    if not columns:
        got = f"has no columns of numbers, as in its line {shown(filled[-1][1].strip())}"
        raise NoTableError(path, got, takes="numbers separated by ';', ',', tabs or spaces")
    header = lines[: _first_row(path, filled, dialect, columns, strict=strict)]
    return Layout(dialect, columns, columns[-1] + 1, len(header), tuple(map(uncommented, header)))


def _spread(lines: Sequence[tuple[int, str]]) -> Sequence[tuple[int, str]]:
    """Some hundred of many lines, evenly spaced."""
    return lines[:: 1 + len(lines) // _TRIED]


def _dialect(
    path: object, filled: Sequence[tuple[int, str]], *, strict: bool
) -> tuple[Dialect, list[list[str]]]:
    """Dialect in which most of some lines are rows of numbers, and these rows."""
    half = filled[len(filled) // 2 :]
    # The numbers of many lines may be whole, without a decimal mark.
    sample = [*_spread(half), *_spread([(n, line) for n, line in half if "." in line or "," in line])]
    rows = {d: [row for _, line in sample if d.is_row(row := d.fields(line))] for d in _DIALECTS}
    most = {d: max((sum(map(bool, row)) for row in rows[d]), default=0) for d in _DIALECTS}
    best = max(_DIALECTS, key=lambda d: (len(rows[d]), most[d]))
    single = _single_column(best, filled)
    if best != Dialect(",") or single is None:
        _refuse_cut_numbers(path, best, filled)
        return best, rows[best]
    # A pair such as "0,5" or "1,500.25" is one number, too: the heads decide.
    heads = [row for _, line in filled if not best.is_row(row := best.fields(line))]
    if not heads or strict:
        number, line = next((n, line) for n, line in filled if "," in line and best.is_row(best.fields(line)))
        mark = "a decimal comma" if single.decimal == "," else "a separator of thousands"
        got = f"line {number} is {shown(line.strip())}, one number with {mark} or two numbers;"
        takes = "a semicolon or a tab between columns" + ", or heads above them" * (not strict)
        raise InputError(path, got, takes=takes)
    best = best if len(heads[-1]) >= most[best] else single
    return best, rows[best]


def _refuse_cut_numbers(path: object, best: Dialect, filled: Sequence[tuple[int, str]]) -> None:
    """Refuse rows in which a comma both separates columns and is the decimal mark, by digits after it.

    No program writes a whole number such as 0125, but "0,0125;3" becomes "0,0125,3" with another separator.
    """
    if best != Dialect(",") or any("." in line for _, line in filled if best.is_row(best.fields(line))):
        return
    for number, line in _spread(filled):
        row = best.fields(line)
        if best.is_row(row) and any(_CUT.fullmatch(field) for field in row[1:]):
            got = f"line {number} is {shown(line.strip())}, in which commas separate columns and decimals"
            raise InputError(path, got, takes="a semicolon or a tab between columns")


def _single_column(best: Dialect, filled: Sequence[tuple[int, str]]) -> Dialect | None:
    """Dialect in which each row of the best one is a single number; None if a row has no such reading."""
    lines = [line.strip() for _, line in filled if best.is_row(best.fields(line))]
    singles = (Dialect(";", ","), Dialect(";", "."))
    return next((d for d in singles if all(d.number(line) is not None for line in lines)), None)


def _first_row(
    path: object, filled: Sequence[tuple[int, str]], dialect: Dialect, columns: Sequence[int], *, strict: bool
) -> int:
    """Number of lines above the first row that another row follows."""
    begin = wrong = None
    for place, (_, line) in enumerate(filled):
        row = dialect.fields(line)
        whole = len(row) > columns[-1] and not _begins_with_key(dialect, columns, row)
        if whole and dialect.is_row([row[k] for k in columns]):
            begin = place if begin is None else begin
            if strict or begin < place:
                break
        else:
            wrong, begin = place if wrong is None else wrong, None
    if begin is None:
        raise NoTableError(path, "has no lines of numbers below each other", takes="a line for each row")
    if wrong:
        number, line = filled[wrong]
        raise InputError(
            path, f"line {number} is {shown(line.strip())}", takes="numbers below the first numbers"
        )
    above = [dialect.fields(line) for _, line in filled[:begin]]
    if above and _is_broken_row(above, dialect, columns, len(filled) - begin):
        number, line = filled[begin - 1]
        takes = "numbers in all columns as in the lines below it, or # before a line of the header"
        raise InputError(path, f"line {number} is {shown(line.strip())}", takes=takes)
    return filled[begin][0] - 1


def _begins_with_key(dialect: Dialect, columns: Sequence[int], row: Sequence[str]) -> bool:
    """Whether a line has a key left of its values, in a table of rows whose first field is empty."""
    return columns[0] == 1 and not is_void(row[0]) and dialect.number(row[0]) is None


def _is_broken_row(above: Sequence[list[str]], dialect: Dialect, columns: Sequence[int], count: int) -> bool:
    """Whether the last line above the first row is a row that lacks a number, and not a part of the header.

    A header may end with the number of rows; ``count`` is the number of known rows.
    """
    row = above[-1]
    if _begins_with_key(dialect, columns, row):
        return False
    numbers = {k: dialect.number(field) for k, field in enumerate(row) if not is_void(field)}
    if None not in numbers.values():
        known = list(numbers.values()) or [None]
        return not (len(row) == 1 and known[0] is not None and known[0] >= count and known[0] % 1 == 0)
    whole = len(row) > columns[-1] if dialect.separator else len(row) == columns[-1] + 1
    below_row = len(above) > 1 and len(above[-2]) > columns[-1] and dialect.is_row(above[-2])
    places = columns if below_row else columns[:1]
    return whole and any(numbers.get(k) is not None for k in places)
