"""Text of a calibrated case: the file of the user with its units and comments, and updated values."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import tomli

from ehlectric.cases.input_keys import unit_of
from ehlectric.cases.table_edits import flattened
from ehlectric.errors import InputError
from ehlectric.quantities.inputs import ENDS, input_at
from ehlectric.quantities.units import in_unit, rounded

# Digits of updated values, and relative difference of two values that are equal with these digits.
_DIGITS, _EQUAL = 5, 1e-4

# Heads of tables, and keys with their values on one line: before the value, the value, and what follows it.
_HEAD = re.compile(r"\s*(?P<brackets>\[\[?)(?P<name>[^\[\]]+)\]")
_PAIR = re.compile(
    r"(?P<before>\s*(?P<key>[^=#\[]+?)\s*=\s*)"
    r"(?P<value>\"[^\"]*\"|'[^']*'|\[[^\]]*\]|[^#\"'\[{]+?)(?P<after>\s*(#.*)?)"
)

# Tables of a measurement and of ranges.
_MEASURED, _RANGES = "measured", "ranges"


def written_input(key: str, value: Any) -> Any:
    """Value of an input, or the ends of its range, as a person writes it: with the unit of its field.

    Examples
    --------
    >>> written_input("bearing.temperature", 333.15), written_input("bearing.base", "6208")
    ('60 degC', '6208')
    >>> written_input("bearing.radial_load", [400.0, 612.345678])
    ['400 N', '612.35 N']
    """
    if isinstance(value, list | tuple):
        return [written_input(key, each) for each in value]
    if isinstance(value, bool) or not isinstance(value, int | float):
        return value
    entry, unit = input_at(key), unit_of(key)
    if not unit:
        return float(rounded(value, _DIGITS))
    shown = unit if entry is None or not entry.shown else entry.shown
    number = in_unit(f"{value!r} {unit}", shown)
    return f"{value!r} {unit}" if number is None else f"{rounded(number, _DIGITS)} {shown}"


def kept_text(text: str, case: Any, updated: Any, path: Path) -> str | None:
    """Text of the file of a case with the values of the updated case, and without measured values.

    ``path``, future path of the text. Other lines stay as they are. None if the text does not give the
    updated case, such as a text with inline tables.
    """
    before, after = flattened(case.to_dict()), flattened(updated.to_dict())
    changes = {key: value for key, value in after.items() if not _alike(before.get(key), value)}
    second = ENDS[1]
    if not re.search(rf"^\s*\[{second}\b|^\s*{second}\b", text, re.MULTILINE):
        # Without its table, the second bearing of a drive equals the first one.
        changes = {key: value for key, value in changes.items() if not key.startswith(f"{second}.")}
    # A relative path in the file belongs to another folder: the second attempt contains the whole path.
    for _ in range(2):
        edited = _edited(text, {key: _toml(_inner(key), value) for key, value in changes.items()})
        try:
            again = flattened(type(case).of_file(tomli.loads(edited), path).to_dict())
        except (InputError, tomli.TOMLDecodeError):
            return None
        missing = [key for key in {**again, **after} if not _alike(again.get(key), after.get(key))]
        if not missing:
            return edited
        changes |= {key: after[key] for key in missing if isinstance(after.get(key), str)}
    return None


def _edited(text: str, changes: Mapping[str, str]) -> str:
    """Text of a TOML file with other values by dotted key, and without the table of measured values."""
    left, lines, ends = dict(changes), [], {}
    table = ""
    for line in text.splitlines():
        head = _HEAD.match(line)
        if head is not None:
            table = head["name"].strip() + ("[]" if head["brackets"] == "[[" else "")
        if table.partition(".")[0] == _MEASURED:
            continue
        pair = _PAIR.fullmatch(line)
        if pair is not None:
            key = ".".join(filter(None, (table, pair["key"]))).replace('"', "").replace("'", "")
            if key.startswith(f"{_MEASURED}."):
                continue
            if key in left:
                line = pair["before"] + left.pop(key) + pair["after"]
        lines.append(line)
        if line.strip():
            ends[table] = len(lines)
    for place, added in sorted(_added(left, ends), reverse=True):
        lines[place:place] = added
    return "\n".join(lines).rstrip() + "\n"


def _added(changes: Mapping[str, str], ends: Mapping[str, int]) -> Iterator[tuple[int, list[str]]]:
    """Lines of keys that a text lacks, with their places: below the last line of their table."""
    tables: dict[str, list[str]] = {}
    for key, value in changes.items():
        table, _, name = key.rpartition(".")
        at = next((part for part in (f"{end}.{_RANGES}" for end in ENDS) if key.startswith(part)), _RANGES)
        if key.startswith(f"{at}."):
            table, name = at, f'"{key.removeprefix(f"{at}.")}"'
        tables.setdefault(table, []).append(f"{name} = {value}")
    last = max(ends.values(), default=0)
    new = [line for table, rows in tables.items() if table not in ends for line in ("", f"[{table}]", *rows)]
    yield from ((ends[table], rows) for table, rows in tables.items() if table in ends)
    if new:
        yield last, new


def _inner(key: str) -> str:
    """Key of an input in the file of its bearing, from the key of its value or its range."""
    for part in (f"{end}." for end in ENDS):
        key = key.removeprefix(part)
    return key.removeprefix(f"{_RANGES}.")


def _toml(key: str, value: Any) -> str:
    """Value of an input as TOML."""
    written = written_input(key, value)
    if isinstance(written, list):
        return f"[{', '.join(_toml('', each) for each in written)}]"
    if isinstance(written, bool):
        return str(written).lower()
    if isinstance(written, str):
        escaped = written.replace("\\", "\\\\").replace('"', '\\"')
        return f'"{escaped}"'
    return repr(written)


def _alike(first: Any, second: Any) -> bool:
    """Whether two values are equal with the digits of updated values."""
    if isinstance(first, list) and isinstance(second, list):
        return len(first) == len(second) and all(map(_alike, first, second))
    numbers = all(isinstance(each, int | float) and not isinstance(each, bool) for each in (first, second))
    return math.isclose(first, second, rel_tol=_EQUAL) if numbers else first == second
