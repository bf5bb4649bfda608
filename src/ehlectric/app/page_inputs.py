"""Inputs of a page: the tables of an input file as a person writes them, in an address and as TOML.

A page has no other state of its inputs, so that a link and a downloaded file have all of them. Numbers stay
the texts that were typed, such as "1800 N". An address has a pair of dotted key and value for every input,
both as in TOML, but texts without quotes where they cannot be mistaken for another value.

Inputs of the sweep page are the inputs of a sweep file with its base case inside, so that the downloaded file
runs as it is, and ``show``, the dotted key of the shown result, which only the address has.
"""

from __future__ import annotations

import datetime
import re
import time
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from contextlib import contextmanager
from contextvars import ContextVar
from copy import deepcopy
from dataclasses import dataclass, field
from functools import cache
from typing import Any, Self
from urllib.parse import parse_qsl, urlencode, urlsplit

import tomli

from ehlectric.cases.key_names import MOST_DEEP, refuse_deep, refuse_long_keys
from ehlectric.errors import InputError, shown
from ehlectric.runs.example_files import example_text

# Longest query of an address that is read or written [characters]: far above the length of any case, and
# below what servers and browsers take.
LONGEST_QUERY = 16_000

# Parts of an address that are no inputs: the token of a server that other machines reach.
_NO_INPUTS = ("token",)

# Keys of the ends of a range in a sweep file.
_ENDS = ("from", "to")

# Part of a dotted key that TOML takes without quotes, and characters that it takes as escapes only.
# Longest key with names in quotes: its parts are looked for in a time that grows with its square.
_LONGEST_KEY = 500

_BARE = re.compile(r"[A-Za-z0-9_-]+")
_ESCAPED = re.compile(r'["\\\x00-\x1f\x7f]')


@dataclass(frozen=True)
class Inputs:
    """Inputs of a page, as nested tables of texts and numbers.

    Examples
    --------
    >>> inputs = Inputs({"bearing": {"base": "6208", "radial_load": "1800 N"}})
    >>> inputs.address()
    'bearing.base=%276208%27&bearing.radial_load=1800+N'
    >>> Inputs.of_query([("bearing.base", "'6208'"), ("bearing.radial_load", "1800 N")]) == inputs
    True
    """

    table: Mapping[str, Any] = field(default_factory=dict)  # nested tables, as read from a TOML file

    def value(self, key: str) -> Any:
        """Value of a dotted key; None where it is not given. Tables of a list have numbers, from 1."""
        value: Any = self.table
        for name in parts_of(key):
            value = _item(value, name)
        return value

    def changed(self, changes: Mapping[str, Any]) -> Self:
        """Inputs with other values by dotted key; None removes a key, and a table that has no other."""
        table = deepcopy(dict(self.table))
        for key, value in changes.items():
            _set(table, parts_of(key), deepcopy(value))
        return type(self)(table)

    def toml(self) -> str:
        """Text of the input file with these inputs.

        Varied inputs keep their order, which numbers the points of a sweep.
        """
        import tomli_w

        # A range stands on one line: tables with headings would have to follow the lists of values.
        lines = [f"{dotted_key(names)} = {_toml(value)}" for names, value in _varied(self)]
        rest = {key: value for key, value in self.table.items() if key != "vary" or not lines}
        text: str = tomli_w.dumps(rest)
        return text + "\n".join(["", "[vary]", *lines, ""]) if lines else text

    def flat(self) -> dict[str, Any]:
        """Values by dotted key; lists of tables are values, and names with dots stand in quotes."""
        return {dotted_key(names): value for names, value in _leaves(self.table)}

    def address(self) -> str:
        """Query of an address that holds these inputs."""
        return urlencode([(key, _written(value)) for key, value in self.flat().items()])

    @property
    def linkable(self) -> bool:
        """Whether an address can hold these inputs; a few hundred values are too many."""
        return len(self.address()) <= LONGEST_QUERY

    @classmethod
    def of_query(cls, pairs: Iterable[tuple[str, str]]) -> Self:
        """Inputs of the query of an address, as pairs of key and text.

        Raises InputError if the query is too long, or its keys contradict each other or are no keys.
        """
        table: dict[str, Any] = {}
        length = 0
        for key, text in pairs:
            length += len(key) + len(text)
            if length > LONGEST_QUERY:
                raise InputError(
                    "address", "is too long", takes=f"at most {LONGEST_QUERY} characters; open the TOML file"
                )
            if key not in _NO_INPUTS:
                _add(table, key, _read(text))
        refuse_deep(table)
        return cls(table)

    @classmethod
    def of_link(cls, pairs: Iterable[tuple[str, str]], start: Self) -> tuple[Self, InputError | None]:
        """Inputs of an address, or of a start where it has none or is wrong, and then its error."""
        try:
            inputs = cls.of_query(pairs)
        except InputError as error:
            return start, error
        return (inputs if inputs.table else start), None


@cache
def example_inputs(name: str) -> Inputs:
    """Inputs of an example."""
    return Inputs(tomli.loads(example_text(name)))


@dataclass
class _Step:
    """Changes of inputs that are undone together: what changes, and when it last did [s]."""

    name: str
    ended: float = 0.0


# Step to which the changes of the running task belong.
_STEP: ContextVar[_Step | None] = ContextVar("step", default=None)

# Time after which a change is a step of its own [s].
_SOON = 1.0


@dataclass
class History:
    """Inputs of a page over time: what was, what is, and what was undone.

    Examples
    --------
    >>> history = History(Inputs({"a": 1}))
    >>> history.push(Inputs({"a": 2}))
    >>> history.undo().value("a"), history.redo().value("a")
    (1, 2)
    """

    now: Inputs
    before: list[Inputs] = field(default_factory=list)
    after: list[Inputs] = field(default_factory=list)
    # Called after every change, as by the buttons that undo.
    listeners: list[Callable[[], None]] = field(default_factory=list, compare=False)
    _last: _Step | None = field(default=None, compare=False, repr=False)

    def push(self, inputs: Inputs) -> None:
        """Make new inputs the present ones; within ``step``, those since its beginning are one step."""
        if inputs == self.now:
            return
        step = _STEP.get()
        if step is None or step is not self._last:
            self.before = [*self.before, self.now][-_STEPS:]
        self._last = step
        self.now, self.after = inputs, []
        self._tell()

    @contextmanager
    def step(self, name: str = "") -> Iterator[None]:
        """Context in which all new inputs are one step to undo."""
        last = self._last
        goes_on = name and last is not None and last.name == name and time.monotonic() - last.ended < _SOON
        step = last if goes_on and last is not None else _Step(name)
        token = _STEP.set(step)
        try:
            yield
        finally:
            _STEP.reset(token)
            step.ended = time.monotonic()

    def undo(self) -> Inputs:
        """Go back to the inputs before; the present ones where there are none."""
        return self._go(self.before, self.after)

    def redo(self) -> Inputs:
        """Take back an undo."""
        return self._go(self.after, self.before)

    def _go(self, there: list[Inputs], back: list[Inputs]) -> Inputs:
        """Make the last inputs of a list the present ones, and keep those before in another list."""
        self._last = None
        if there:
            back.append(self.now)
            self.now = there.pop()
            self._tell()
        return self.now

    def _tell(self) -> None:
        for tell in self.listeners:
            tell()


# Number of steps that can be undone.
_STEPS = 100


def parts_of(key: str) -> list[str]:
    """Names of the tables and the value to which a dotted key leads; a name with dots stands in quotes.

    Raises InputError if it is no key.

    Examples
    --------
    >>> parts_of("lubricant.base"), parts_of('ranges."bearing.temperature"')
    (['lubricant', 'base'], ['ranges', 'bearing.temperature'])
    """
    parts = key.split(".")
    if not all(_BARE.fullmatch(part) for part in parts):
        parts = _quoted_parts(key)
    if len(parts) > MOST_DEEP:
        raise InputError(shown(key), f"has {len(parts)} parts", takes=f"at most {MOST_DEEP}")
    return parts


def _quoted_parts(key: str) -> list[str]:
    """Names of a dotted key of which some stand in quotes."""
    wrong = InputError("address", got=f"the key {shown(key)}", takes="a key of an input file")
    if len(key) > _LONGEST_KEY or "\n" in key or "=" in re.sub(r'"(?:[^"\\]|\\.)*"', "", key):
        raise wrong
    try:
        refuse_long_keys(f"{key} = 0")
        table: Any = tomli.loads(f"{key} = 0")
    except (ValueError, RecursionError):
        raise wrong from None
    parts = []
    while isinstance(table, Mapping):
        if len(table) != 1:
            raise wrong
        name, table = next(iter(table.items()))
        parts.append(name)
    return parts


def _item(table: Any, name: str) -> Any:
    """Value of a name in a table, or of a number, from 1, in a list; None where there is none. A single value
    is the first of its list.
    """
    if isinstance(table, Mapping):
        return table.get(name)
    if name == "1" and isinstance(table, str | int | float):
        return table
    if isinstance(table, list) and name.isdecimal() and 1 <= int(name) <= len(table):
        return table[int(name) - 1]
    return None


def _set(table: dict[str, Any], names: list[str], value: Any) -> None:
    """Set a value in nested tables, in place; None removes it and the tables that are then empty."""
    name, *rest = names
    inner = table.get(name)
    if rest and isinstance(inner, list) and rest[0].isdecimal() and 1 <= int(rest[0]) <= len(inner):
        _set_in_list(inner, int(rest[0]) - 1, rest[1:], value)
        value = inner or None
    elif rest:
        value = _with(inner, rest, value)
    if value is None:
        table.pop(name, None)
    else:
        table[name] = value


def _with(inner: Any, rest: list[str], value: Any) -> dict[str, Any] | None:
    """Table with a value set; None where it is then empty."""
    table = dict(inner) if isinstance(inner, Mapping) else {}
    _set(table, rest, value)
    return table or None


def _set_in_list(tables: list[Any], number: int, rest: list[str], value: Any) -> None:
    """Set a value in a table of a list, or the table itself."""
    if rest:
        value = _with(tables[number], rest, value) or {}
    if value is None:
        del tables[number]
    else:
        tables[number] = value


def _add(table: dict[str, Any], key: str, value: Any) -> None:
    """Add a value of an address; a key that is there already, or is within a value, is refused."""
    *parents, leaf = parts_of(key)
    for parent in parents:
        table = table.setdefault(parent, {})
        if not isinstance(table, dict):
            raise InputError("address", f"has {shown(key)} within another value", takes="each input once")
    if leaf in table:
        raise InputError("address", f"has {shown(key)} twice", takes="each input once")
    table[leaf] = value


def _leaves(table: Mapping[str, Any], whole: Collection[str] = ()) -> Iterator[tuple[list[str], Any]]:
    """Values with the names that lead to them; a table that has one of the keys ``whole`` is a value."""
    for name, value in table.items():
        if isinstance(value, Mapping) and value and value.keys().isdisjoint(whole):
            yield from (([name, *names], leaf) for names, leaf in _leaves(value, whole))
        else:
            yield [name], value


def dotted_key(names: Iterable[str]) -> str:
    """Dotted key of names; a name with dots stands in quotes."""
    return ".".join(map(_name, names))


def _varied(inputs: Inputs) -> list[tuple[list[str], Any]]:
    """Varied inputs with the names of their keys, in the order of the design; a range is a table."""
    vary = inputs.table.get("vary")
    return list(_leaves(vary, _ENDS)) if isinstance(vary, Mapping) else []


def _written(value: Any) -> str:
    """Value as text of an address: a text as it is, unless it reads as another value of TOML."""
    if not isinstance(value, str):
        return _toml(value)
    if _read(value) is value:
        return str(value)
    return f"'{value}'" if "'" not in value and value.isprintable() else _quoted(value)


def _read(text: str) -> Any:
    """Value of a text of an address, in TOML; the text itself where it is none."""
    if "\n" in text or "\r" in text or len(text) > LONGEST_QUERY:
        return text
    try:
        refuse_long_keys(text)
        table = tomli.loads(f"value = {text}")
    except (ValueError, RecursionError):
        # Not TOML, or a number of thousands of digits.
        return text
    return table["value"] if set(table) == {"value"} else text


def _toml(value: Any) -> str:
    """Value as TOML on one line."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return _quoted(value)
    if isinstance(value, Mapping):
        pairs = (f"{_name(name)} = {_toml(item)}" for name, item in value.items())
        return "{" + ", ".join(pairs) + "}"
    if isinstance(value, list | tuple):
        return "[" + ", ".join(map(_toml, value)) + "]"
    return str(value.isoformat()) if isinstance(value, datetime.date | datetime.time) else repr(value)


def _name(name: str) -> str:
    """Name of a table or a value as part of a dotted key."""
    return name if _BARE.fullmatch(name) else _quoted(name)


def _quoted(text: str) -> str:
    """Text in the quotes of TOML."""
    return '"' + _ESCAPED.sub(lambda match: f"\\u{ord(match[0]):04x}", text) + '"'


@dataclass(frozen=True)
class Range:
    """Range of a varied input, as a sweep file has it."""

    key: str
    start: str
    stop: str
    count: int | str = 8  # number of values; another text as it was typed
    log: bool = False  # whether the values are spaced by logarithms

    def table(self) -> dict[str, Any]:
        """Table of a sweep file."""
        ends = (number_of_text(self.start), number_of_text(self.stop))
        table: dict[str, Any] = {"from": ends[0], "to": ends[1], "count": self.count}
        return table | ({"spacing": "log"} if self.log else {})


def sweep_inputs(inputs: Inputs) -> Inputs | None:
    """Inputs of the sweep page from an address: its own, or the inputs of the page of a case.

    Examples
    --------
    >>> sweep_inputs(Inputs({"bearing": {"base": "6208"}})).value("case.bearing.base")
    '6208'
    >>> sweep_inputs(Inputs()) is None
    True
    """
    if isinstance(inputs.value("case"), Mapping):
        return inputs
    if any(inputs.value(table) for table in ("bearing", "drive_end", "gear", "contact")):
        others = ("vary", "show", "case", "token")
        return Inputs({"case": {key: value for key, value in inputs.table.items() if key not in others}})
    return None


def case_of_link(link: str) -> dict[str, Any] | None:
    """Tables of the case in a link to the page of a case or a sweep; None where it has none.

    Examples
    --------
    >>> case_of_link("http://localhost:8080/?bearing.base=%276208%27")
    {'bearing': {'base': '6208'}}
    """
    query = urlsplit(link.strip()).query
    inputs = sweep_inputs(Inputs.of_query(parse_qsl(query, keep_blank_values=True)))
    return None if inputs is None else dict(inputs.value("case"))


def ranges_of(inputs: Inputs) -> list[Range]:
    """Ranges of the varied inputs, in the order of the design; lists of values are none."""
    return [varied for _, varied in _varied_ranges(inputs) if isinstance(varied, Range)]


def lists_of(inputs: Inputs) -> dict[str, Any]:
    """Varied inputs of an opened file that have other values than a range, by their keys.

    Examples
    --------
    >>> lists_of(Inputs({"vary": {"bearing": {"elements": [8, 9]}}}))
    {'bearing.elements': [8, 9]}
    """
    return {key: value for key, value in _varied_ranges(inputs) if not isinstance(value, Range)}


def with_ranges(inputs: Inputs, ranges: list[Range]) -> Inputs:
    """Inputs with other ranges, which take the places of those before; lists of values stay.

    Examples
    --------
    >>> inputs = Inputs({"vary": {"bearing": {"elements": [8, 9]}}})
    >>> with_ranges(inputs, [Range("bearing.radial_load", "1 N", "2 N", 3)]).value("vary.bearing.elements")
    [8, 9]
    """
    new = iter(ranges)
    varied: dict[str, Any] = {}
    for key, value in _varied_ranges(inputs):
        if not isinstance(value, Range):
            varied[key] = value
        elif (new_range := next(new, None)) is not None:
            varied[new_range.key] = new_range.table()
    varied |= {new_range.key: new_range.table() for new_range in new}
    without = inputs.changed({"vary": None})
    return without.changed({f"vary.{key}": value for key, value in varied.items()})


def sweep_file(inputs: Inputs) -> Inputs:
    """Inputs without the shown result, which a sweep file does not have."""
    return inputs.changed({"show": None})


# Table of the results that a sweep has only where it is asked for their samples, and their usual number.
_UNCERTAINTY, _UNCERTAINTY_SAMPLES = "uncertainty.", 256


def with_shown(inputs: Inputs, key: str, solved: Inputs | None) -> Inputs:
    """Inputs of the sweep page that show another result of the points.

    Inputs of ``uncertainty`` need samples, which are asked for. They stay for another result where the
    ``solved`` sweep has them, whose map stays valid then.

    Examples
    --------
    >>> shown = with_shown(Inputs(), "uncertainty.breakdown_probability", None)
    >>> shown.value("uncertainty_samples")
    256
    >>> with_shown(shown, "bearing.margin", None) == Inputs({"show": "bearing.margin"})
    True
    >>> with_shown(shown, "bearing.margin", shown).value("uncertainty_samples")
    256
    """
    name = "uncertainty_samples"
    samples = None if solved is None else solved.value(name)
    if key.startswith(_UNCERTAINTY):
        samples = inputs.value(name) or samples or _UNCERTAINTY_SAMPLES
    return inputs.changed({"show": key, name: samples})


def same_sweep(first: Inputs, second: Inputs) -> bool:
    """Whether two sweeps have the same points in the same order.

    Examples
    --------
    >>> ranges = [Range("bearing.elements", "8", "9", 2), Range("bearing.radial_load", "1 N", "2 N", 2)]
    >>> same_sweep(with_ranges(Inputs(), ranges), with_ranges(Inputs(), ranges[::-1]))
    False
    """
    orders = [list(Inputs(inputs.value("vary") or {}).flat()) for inputs in (first, second)]
    return first == second and orders[0] == orders[1]


def number_of_text(text: str) -> str | int | float:
    """Number of a text without a unit, which a file has without quotes; another text as it is.

    Examples
    --------
    >>> number_of_text("0.5"), number_of_text("20"), number_of_text("20 N"), number_of_text("inf")
    (0.5, 20, '20 N', 'inf')
    """
    if not re.fullmatch(r"[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?", text.strip()):
        return text
    return int(text) if re.fullmatch(r"[-+]?\d{1,15}", text.strip()) else float(text)


def _varied_ranges(inputs: Inputs) -> list[tuple[str, Any]]:
    """Varied inputs in the order of the design, by dotted key: a range, or other values as they are."""
    varied = ((".".join(names), value) for names, value in _varied(inputs))
    return [(key, _range(key, value)) for key, value in varied]


def _range(key: str, value: Any) -> Any:
    """Range of a table of a sweep file; another value as it is."""
    if not isinstance(value, Mapping) or not value:
        return value
    start, stop = (str(value.get(name, "")) for name in _ENDS)
    return Range(key, start, stop, value.get("count", ""), value.get("spacing") == "log")
