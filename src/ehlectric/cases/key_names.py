"""Keys of case files: other names that users give to them, and bounds on their length and depth."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from types import MappingProxyType
from typing import Any

from ehlectric.errors import InputError, short, shown
from ehlectric.quantities.quantity import data_file

_READ = data_file("ehlectric.quantities", "key_aliases.toml")

# Advice for unknown keys that users expect, by the name of the file in the book of inputs, and dotted key.
ADVICE: Mapping[tuple[str, str], str] = MappingProxyType(
    {(file, key): row["text"] for row in _READ["advice"] for file in row["files"] for key in row["keys"]}
)

# Largest number of tables and lists in each other. A case has four, and a sweep of cases five.
MOST_DEEP = 16

# Largest number of bits of an integer. Python writes no text for one of about 14 000 bits, 4300 digits.
MOST_BITS = 10_000

# Longest key, dotted or not [characters]. The longest key of a case has 45.
LONGEST_KEY = 1000

# Parts of a text in TOML that matter to the length of a dotted key: strings and comments, in which dots do
# not count, dots, and what ends a key. A string without an end ends with its line or with the text.
_TOKENS = re.compile(
    r'"""(?:[^\\]|\\.)*?(?:"""|\Z)'
    r"|'''.*?(?:'''|\Z)"
    r'|"(?:[^"\\\n]|\\.)*+"?'
    r"|'[^'\n]*+'?"
    r"|\#[^\n]*+"
    r"|(?P<dot>\.)|(?P<end>[=\[\]{},\n])",
    re.DOTALL,
)


def refuse_long_keys(text: str) -> None:
    """Refuse a text in TOML with a dotted key of many parts, before it is parsed.

    The time in which a parser reads such a key grows with the square of the number of its parts, or faster.

    Raises InputError if a key has more than ``MOST_DEEP`` parts.

    Examples
    --------
    >>> refuse_long_keys("a.b.c = 1.5")
    >>> refuse_long_keys("a." * 1000 + "b = 1")
    Traceback (most recent call last):
    ehlectric.errors.InputError: line 1 has a key of more than 16 parts
    """
    if text.count(".") <= MOST_DEEP:
        return
    dots = 0
    for token in _TOKENS.finditer(text):
        if token["dot"]:
            dots += 1
        elif token["end"]:
            dots = 0
        if dots >= MOST_DEEP:
            line = text.count("\n", 0, token.start()) + 1
            raise InputError(f"line {line} has a key of more than {MOST_DEEP} parts")


def refuse_deep(tables: Mapping[str, Any]) -> None:
    """Refuse tables that lie too deep in each other or within themselves, and keys of many parts. Raises
    InputError if more than ``MOST_DEEP`` tables or lists lie in each other, or a key is no text, has more
    than ``MOST_DEEP`` parts or more than ``LONGEST_KEY`` characters, or an integer has more than
    ``MOST_BITS`` bits.

    Examples
    --------
    >>> table = {}
    >>> table["contact"] = table
    >>> refuse_deep(table)
    Traceback (most recent call last):
    ehlectric.errors.InputError: contact: has tables in each other more than 16 deep
    """
    # Tables of one depth, each once, with the key at the top that leads to them.
    level: dict[int, tuple[str, Any]] = {id(tables): ("", tables)}
    for _ in range(MOST_DEEP):
        level = {
            id(item): (top or name, item)
            for top, table in level.values()
            for name, item in _items(table)
            if _is_table(top or name, item)
        }
        if not level:
            return
    top, _ = next(iter(level.values()))
    raise InputError.worded(short(top), f"has tables in each other more than {MOST_DEEP} deep")


def _is_table(key: str, item: Any) -> bool:
    """Whether an item has items itself; one that is too long for a text is refused."""
    if isinstance(item, int) and item.bit_length() > MOST_BITS:
        takes = f"an integer of at most {MOST_BITS} bits"
        raise InputError(short(key), got=f"an integer of {item.bit_length()} bits", takes=takes)
    return isinstance(item, Mapping | list | tuple)


def _items(table: Any) -> Iterable[tuple[str, Any]]:
    """Items of a table with their keys, which are checked, or items of a list, which have no keys."""
    if not isinstance(table, Mapping):
        return (("", item) for item in table)
    for key in table:
        if not isinstance(key, str):
            raise InputError(got=f"the key {shown(key)}", takes="a text as the key of a table")
        if key.count(".") >= MOST_DEEP:
            raise InputError(shown(key), f"has {key.count('.') + 1} parts", takes=f"at most {MOST_DEEP}")
        if len(key) > LONGEST_KEY:
            raise InputError(
                shown(key), f"has {len(key)} characters", takes=f"a key of at most {LONGEST_KEY}"
            )
    return table.items()
