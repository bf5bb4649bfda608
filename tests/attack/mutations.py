"""Seeded mutations of bytes, of text, and of the tables of TOML and JSON files."""

from __future__ import annotations

import copy
import datetime
import random
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

_NUMBERS = (
    0, -1, 1, 2, 3, 7, 2**31, 2**53 + 1, 2**63, 10**30, -(10**18), 0.0, -0.0, 0.5, 1e-9, 5e-324, 1e-300,
    1e300, 1.8e308, -1e-12, 1e6, 1e12, float("nan"), float("inf"), float("-inf"), True, False,
)  # fmt: skip

_TEXTS = (
    "", " ", "\t", "nan", "inf", "nan m", "inf GPa", "-1 m", "1e309 m", "1 m m", "1,5 mm", "1.5.5 mm",
    "1 furlong",
    "0x10 m", "1_000 m", "1 / 0 m", "(1 m", "1 m)", "1 m**999999999", "m", "1", "-", "--help",
    "1 degC", "-300 degC",
    "1e400", "1 m/0", "２ mm", "١ mm", "1 µm", "1 μm", "1\u00a0mm", "1 mm\u202e",
    "\u2028", "\u0085", "\u200b",
    "\x1b[31mred\x1b[0m", "\x07", "a\nb", "a\rb", "=HYPERLINK(\"http://x\",\"y\")",
    "+1+cmd|' /C calc'!A0", "@SUM(1)",
    "$\\frac{1}{$", "$$", "\\", "${HOME}", "%s%s%n", "{0.__class__}", "<script>alert(1)</script>", "&amp;",
    "'", '"',
    "..", "../../../../etc/passwd", "/etc/passwd", "/dev/zero", "/dev/random", "/proc/self/mem", "/", "~",
    "file:///",
    "con", "none", "paper", "6208", "steel", "N" * 300, "é" * 300, "😀", "None", "true", "[]", "{}",
)  # fmt: skip

_LONG = (
    lambda n: "1" * n,
    lambda n: "1 " + "a" * n,
    lambda n: "1 " + "m*" * n + "m",
    lambda n: "1 " + "(" * n + "m" + ")" * n,
    lambda n: "1" * n + "y\nz",
    lambda n: "1 " + "1" * n + "x",
    lambda n: "." * n,
    lambda n: "a." * n + "a",
    lambda n: " " * n,
    lambda n: "-" * n + "1 m",
    lambda n: "1e" + "9" * n,
    lambda n: "1 m**" + "9" * n,
    lambda n: "\\" * n,
    lambda n: "$" * n,
)

# Part of the tables that keep their keys, with values that are larger or smaller.
GENTLE = 0.25

_NUMBER = re.compile(r"[-+]?\d+(?:\.\d+)?(?:[eE][-+]?\d+)?")


def hostile(draw: random.Random) -> Any:
    """A value that nobody gives: an extreme number, an odd text, a container or a date."""
    choice = draw.random()
    if choice < 0.35:
        return draw.choice(_NUMBERS)
    if choice < 0.75:
        return draw.choice(_TEXTS)
    if choice < 0.85:
        return draw.choice(_LONG)(int(10 ** draw.uniform(1.0, 5.0)))
    if choice < 0.95:
        return draw.choice(
            ([], {}, [[]], [1, "a"], {"a": {"b": {}}}, _nested(draw.randrange(2, 60)), [0.0] * 1000)
        )
    return draw.choice(
        (datetime.datetime(2000, 1, 1), datetime.date(2000, 1, 1), datetime.time(1, 2), datetime.datetime.max)
    )


def _nested(depth: int) -> list[Any]:
    value: list[Any] = []
    for _ in range(depth):
        value = [value]
    return value


def mutated_bytes(data: bytes, draw: random.Random, others: Sequence[bytes] = ()) -> bytes:
    """Bytes with one to eight changes: flipped, set, cut, doubled, inserted, swapped or truncated."""
    data = bytearray(data)
    for _ in range(draw.choice((1, 1, 1, 2, 4, 8))):
        draw.choice(_ON_BYTES)(data, draw, others)
    return bytes(data)


def _span(data: bytearray, draw: random.Random) -> slice:
    start = draw.randrange(len(data) + 1)
    return slice(start, min(len(data), start + int(10 ** draw.uniform(0.0, 3.0))))


def _flip(data: bytearray, draw: random.Random, _: Sequence[bytes]) -> None:
    if data:
        data[draw.randrange(len(data))] ^= 1 << draw.randrange(8)


def _flip_in_head(data: bytearray, draw: random.Random, _: Sequence[bytes]) -> None:
    if data:
        data[draw.randrange(min(len(data), 2048))] ^= 1 << draw.randrange(8)


def _cut(data: bytearray, draw: random.Random, _: Sequence[bytes]) -> None:
    del data[_span(data, draw)]


def _double(data: bytearray, draw: random.Random, _: Sequence[bytes]) -> None:
    span = _span(data, draw)
    data[span.start : span.start] = data[span]


def _insert(data: bytearray, draw: random.Random, _: Sequence[bytes]) -> None:
    start = draw.randrange(len(data) + 1)
    data[start:start] = draw.randbytes(draw.randrange(1, 20))


def _zero(data: bytearray, draw: random.Random, _: Sequence[bytes]) -> None:
    span = _span(data, draw)
    data[span] = bytes(span.stop - span.start)


def _truncate(data: bytearray, draw: random.Random, _: Sequence[bytes]) -> None:
    del data[draw.randrange(len(data) + 1) :]


def _splice(data: bytearray, draw: random.Random, others: Sequence[bytes]) -> None:
    if others:
        other = bytearray(draw.choice(others))
        data[_span(data, draw)] = other[_span(other, draw)]


_ON_BYTES: tuple[Callable[[bytearray, random.Random, Sequence[bytes]], None], ...] = (
    _flip, _flip, _flip_in_head, _cut, _double, _insert, _zero, _truncate, _splice,
)  # fmt: skip


def mutated_text(text: str, draw: random.Random) -> str:
    """Text with a number, a word, a line or a character changed."""
    choice = draw.random()
    if choice < 0.4 and (found := list(_NUMBER.finditer(text))):
        match = draw.choice(found)
        value = draw.choice(_NUMBERS) if draw.random() < 0.5 else scaled(match[0], draw)
        return text[: match.start()] + str(value) + text[match.end() :]
    lines = text.splitlines(keepends=True) or [""]
    number = draw.randrange(len(lines))
    if choice < 0.55:
        del lines[number]
    elif choice < 0.7:
        lines.insert(draw.randrange(len(lines)), lines[number])
    elif choice < 0.85:
        lines[number] = str(hostile(draw)) + "\n"
    else:
        at = draw.randrange(len(lines[number]) + 1)
        lines[number] = lines[number][:at] + str(hostile(draw)) + lines[number][at:]
    return "".join(lines)


def scaled(text: str, draw: random.Random) -> str:
    """Text whose first number is multiplied by a power of ten, by -1 or by a factor near one."""
    factor = draw.choice(
        (10 ** draw.uniform(-9.0, 9.0), 10 ** draw.uniform(-1.0, 1.0), draw.uniform(0.5, 2.0), -1.0)
    )
    try:
        return _NUMBER.sub(lambda match: f"{float(match[0]) * factor:.6g}", text, count=1)
    except (OverflowError, ValueError):
        return text


def mutated_table(
    table: Mapping[str, Any], draw: random.Random, others: Sequence[Mapping[str, Any]] = ()
) -> Any:
    """A copy of nested tables with one to four changes of keys and values.

    ``others`` are tables of which keys are taken over.
    """
    table = copy.deepcopy(dict(table))
    if draw.random() < GENTLE:
        # Values within reason, so that there is something to solve.
        values = [
            (inside, key) for inside, key in places(table) if not isinstance(inside[key], dict | list | bool)
        ]
        for inside, key in draw.sample(values, min(len(values), draw.randrange(1, 6))):
            inside[key] = gentle(inside[key], draw)
        return table
    for _ in range(draw.choice((1, 1, 2, 2, 3, 4))):
        _change(table, draw, others)
    return table


def gentle(value: Any, draw: random.Random) -> Any:
    """A number, or a text with one, up to three times larger or smaller; other values as they are."""
    factor = 3.0 ** draw.uniform(-1.0, 1.0)
    if isinstance(value, str):
        return (
            _NUMBER.sub(lambda match: f"{float(match[0]) * factor:.4g}", value, count=1)
            if value[:1].isdigit()
            else value
        )
    if isinstance(value, int | float):
        return type(value)(value * factor)
    return value


def places(table: Any) -> Iterator[tuple[Any, Any]]:
    """Every container in nested tables and lists with every key or number of an entry."""
    entries = table.items() if isinstance(table, dict) else enumerate(table)
    for key, value in list(entries):
        yield table, key
        if isinstance(value, dict | list):
            yield from places(value)


def _change(table: dict[str, Any], draw: random.Random, others: Sequence[Mapping[str, Any]]) -> None:
    found = list(places(table))
    if not found:
        return
    inside, key = draw.choice(found)
    choice = draw.random()
    if choice < 0.4:
        inside[key] = near(inside[key], draw)
    elif choice < 0.65:
        inside[key] = hostile(draw)
    elif choice < 0.75:
        del inside[key]
    elif choice < 0.85 and others:
        other, name = draw.choice(list(places(draw.choice(others))))
        if isinstance(inside, dict) and isinstance(other, dict):
            inside[name] = copy.deepcopy(other[name])
    elif choice < 0.95 and isinstance(inside, dict):
        inside[_misspelt(key, draw)] = inside.pop(key)
    else:
        other, name = draw.choice(found)
        inside[key], other[name] = copy.deepcopy(other[name]), copy.deepcopy(inside[key])


def near(value: Any, draw: random.Random) -> Any:
    """A value of the same type, larger or smaller."""
    if isinstance(value, bool):
        return not value
    if isinstance(value, int):
        return draw.choice((value + 1, value - 1, -value, value * draw.randrange(2, 20), value // 3))
    if isinstance(value, float):
        return value * draw.choice((-1.0, 10 ** draw.uniform(-9.0, 9.0), draw.uniform(0.3, 3.0)))
    if isinstance(value, str):
        return (
            scaled(value, draw)
            if _NUMBER.search(value)
            else draw.choice((value.upper(), value + " ", value[:-1]))
        )
    if isinstance(value, list):
        return draw.choice((value * 2, value[1:], value[::-1], [*value, hostile(draw)]))
    return hostile(draw)


def _misspelt(key: str, draw: random.Random) -> str:
    at = draw.randrange(len(key) + 1)
    return draw.choice(
        (
            key[:at] + key[at + 1 :],
            key[:at] + "_" + key[at:],
            key.upper(),
            key + "." + key,
            str(hostile(draw)),
        )
    )
