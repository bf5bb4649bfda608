"""Tables in narrow terminals: labels are broken into lines, and values are neither cut nor lost."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence

from rich.cells import cell_len
from rich.console import Group, RenderableType
from rich.padding import Padding
from rich.style import StyleType
from rich.table import Column, Table
from rich.text import Text

# Width above which a word, such as an address, may be broken [characters].
_LONG = 24

# Space behind a column, and before a value that stands below its label [characters].
_GAP, _INDENT = 1, 2

# Label, value and style of a row; a heading has no value.
_Row = tuple[str, str, StyleType | None]


def fitted(table: Table, width: int) -> Table | Group:
    """Table for a terminal of a width [characters]; itself if it fits.

    A table of labels and values gets narrow labels, or its values stand below their labels. A table of
    several columns that cannot be narrow enough becomes a list: each row a heading, with a label and a value
    for each column.
    """
    of_labels = not table.show_header and len(table.columns) == 2
    if _width_of(table, _with_unit if of_labels else _of_words) <= width:
        return table
    return _narrow(table, list(_rows_of(table) if of_labels else _listed(table)), width)


def _width_of(table: Table, width: Callable[[Column, str], int]) -> int:
    """Width of a table whose cells have these widths [characters]."""
    _, right, _, left = table.padding
    texts = ((column, [_plain(column.header), *map(_plain, column.cells)]) for column in table.columns)
    return sum(max(width(column, text) for text in cells) + left + right for column, cells in texts)


def _with_unit(column: Column, text: str) -> int:
    """Width of a label, or of a value, whose number with its unit is not broken [characters]."""
    whole = _longest(text.splitlines())
    return whole if column.no_wrap else min(whole, _LONG)


def _of_words(column: Column, text: str) -> int:
    """Width of a cell, or of the words of a text that may be broken [characters]."""
    return _longest(text.splitlines()) if column.no_wrap else min(_longest(text.split()), _LONG)


def _plain(cell: RenderableType) -> str:
    return cell.plain if isinstance(cell, Text) else str(cell)


def _longest(texts: Iterable[str]) -> int:
    """Width of the widest text [characters]."""
    return max(map(cell_len, texts), default=0)


def _rows_of(table: Table) -> Iterator[_Row]:
    """Rows of a table of labels and values."""
    labels, values = (map(_plain, column.cells) for column in table.columns)
    for label, value, row in zip(labels, values, table.rows, strict=True):
        yield label, value, row.style


def _listed(table: Table) -> Iterator[_Row]:
    """Rows of a table of several columns as a list: its first cell as a heading, and the others below it."""
    # A hyphen at the end of a line parts a word.
    heads = [" ".join(_plain(column.header).replace("-\n", "").split()) for column in table.columns]
    columns = [[*map(_plain, column.cells)] for column in table.columns]
    for number, row in enumerate(table.rows):
        first, *others = (cells[number] for cells in columns)
        # A number needs its head.
        named = first if any(map(str.isalpha, first)) else " ".join(filter(None, (heads[0], first)))
        # A column without a head has the units of its rows.
        units = [f"[{unit}]" for head, unit in zip(heads[1:], others, strict=True) if unit and not head]
        yield " ".join([*named.split(), *units]), "", "bold"
        for head, value in zip(heads[1:], others, strict=True):
            if head and value.strip():
                yield f"  {head}", value.strip(), row.style


def _indent(label: str) -> int:
    return len(label) - len(label.lstrip())


def _narrow(table: Table, rows: Sequence[_Row], width: int) -> Group:
    """Labels next to values, or above them where both do not fit; headings take the whole width."""
    # The text of a value before its first comma is a number with its unit.
    numbers = [value.partition(",")[0] for _, value, _ in rows]
    words = [word for _, value, _ in rows for word in value.split()]
    least = _longest(text for text in (*numbers, *words) if cell_len(text) <= _LONG)
    labels = [label for label, value, _ in rows if value]
    room = min(width - least - _GAP, _longest(labels))
    side_by_side = room >= max((_indent(label) + _longest(label.split()) for label in labels), default=0)
    parts: list[RenderableType] = []
    if table.title:
        parts.append(Text(_plain(table.title), style=table.title_style or "table.title"))
    for label, value, style in rows:
        indent = _indent(label)
        name = Padding(Text(label.strip()), (0, 0, 0, indent), style=style or "")
        if not value:
            parts.append(name)
        elif not side_by_side:
            parts += [name, Padding(Text(value), (0, 0, 0, indent + _INDENT), style=style or "")]
        else:
            row = Table.grid(padding=(0, _GAP, 0, 0))
            row.add_column(width=room)
            row.add_column(overflow="fold")
            row.add_row(name, Text(value), style=style)
            parts.append(row)
    return Group(*parts)
