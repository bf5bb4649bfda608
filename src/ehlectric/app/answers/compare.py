"""Two cases side by side, as data: what differs in their inputs, and the effect on every result."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any, Literal

from ehlectric.app.answers.told import Told
from ehlectric.app.inputs import Inputs

# Change of a result that is shown as none: the results have four digits [%].
_NO_CHANGE = 0.005

# Critical speeds are found along speeds that depend on that of the case: a smaller change means nothing [%].
_SPEED_ACCURACY = 1.0

# Factors of the prefixes of units.
_PREFIXES = {"p": 1e-12, "n": 1e-9, "µ": 1e-6, "m": 1e-3, "": 1.0, "k": 1e3, "M": 1e6, "G": 1e9}

# Units that have a prefix in texts of results.
_PREFIXED = ("s", "J", "V", "m", "F", "Hz")


@dataclass(frozen=True)
class Result:
    """Result of one case.

    Attributes
    ----------
    group : str
        Heading under which it stands.
    name : str
        Name of the quantity.
    value : float or None
        Number in its SI unit; None for a result in words.
    text : str
        Value as shown, without its unit.
    unit : str
        Unit of the text.
    note : str
        Note that follows.
    bound : str
        "≤" where the number is an upper bound only, "≥" where it is a lower one.
    main : bool
        Whether it is one of the results that decide.
    key : str
        Dotted key of the quantity, by which results are compared; empty for a result that has none.
    """

    group: str
    name: str
    value: float | None
    text: str
    unit: str = ""
    note: str = ""
    bound: str = ""
    main: bool = False
    key: str = ""

    @property
    def number(self) -> tuple[float | None, str]:
        """Number and its unit, also of a result that is a text such as "12.1 nJ"; None of other texts."""
        if self.value is not None:
            return self.value, ""
        text, _, unit = self.text.partition(" ")
        unit = unit or self.unit
        base = next((one for one in _PREFIXED if unit.endswith(one) and unit[: -len(one)] in _PREFIXES), unit)
        factor = _PREFIXES[unit.removesuffix(base)] if base else 1.0
        try:
            return factor * float(text), base
        except ValueError:
            return None, ""

    @property
    def shown(self) -> str:
        """Bound, value and unit."""
        return " ".join(filter(None, [self.bound, self.text, self.unit]))


@dataclass(frozen=True)
class Film:
    """Minimum films of the contacts of one ring, over the position of the elements [deg, m]."""

    ring: str
    position: tuple[float, ...]
    thickness: tuple[float, ...]


@dataclass(frozen=True)
class Side:
    """Answer about one of two cases.

    Attributes
    ----------
    kind : str
        "bearing" or "contact".
    title : str
        Title of the case.
    level, text : str
        Level of the verdict and its sentences, without solving.
    results : tuple of Result
        Results in their order.
    warnings : tuple of Told
        Warnings of the result.
    films : tuple of Film
        Films of a bearing.
    method : str
        How the results were obtained, and their error.
    """

    kind: str
    title: str
    level: str
    text: str
    results: tuple[Result, ...]
    warnings: tuple[Told, ...] = ()
    films: tuple[Film, ...] = ()
    method: str = ""


@dataclass(frozen=True)
class InputRow:
    """Input of both cases.

    Attributes
    ----------
    key : str
        Dotted key.
    first, second : str
        Values as they are written; empty where a case does not give it.
    sign : str
        "=", "≠", "only A" or "only B".
    """

    key: str
    first: str
    second: str
    sign: Literal["=", "≠", "only A", "only B"]


@dataclass(frozen=True)
class Effect:
    """Result of both cases.

    Attributes
    ----------
    first, second : Result or None
        The result of each case; None where a case has none.
    change : float or None
        Change from the first to the second [%]; None where one has no number, or the first is zero.
    """

    first: Result | None
    second: Result | None
    change: float | None

    @property
    def either(self) -> Result:
        """The result of a case that has it."""
        found = self.first or self.second
        if found is None:
            raise ValueError("an effect has a result")
        return found

    @property
    def same(self) -> bool:
        """Whether both cases show the same."""
        first, second = self.first, self.second
        return first is not None and second is not None and first.shown == second.shown

    @property
    def _accuracy(self) -> float:
        """Change that is none, within the accuracy of the method and of the shown digits [%]."""
        return _SPEED_ACCURACY if self.either.unit == "rpm" else _NO_CHANGE

    @property
    def words(self) -> str:
        """Change as a text with its direction."""
        if self.same:
            return "no change"
        if self.change is None:
            return "differs" if self.first and self.second else "only A" if self.first else "only B"
        if abs(self.change) < self._accuracy:
            return "no change"
        sign, digits = ("▲ +" if self.change > 0.0 else "▼ −"), abs(self.change)
        number = f"{digits:.3g}" if digits < 1000.0 else f"{digits:.0f}"
        return f"{sign}{number}\N{NO-BREAK SPACE}%"


def input_rows(first: Mapping[str, Any], second: Mapping[str, Any]) -> list[InputRow]:
    """Inputs of two cases, those that differ first.

    Examples
    --------
    >>> [row.sign for row in input_rows({"a": 1, "b": 2}, {"a": 1, "b": 3, "c": 4})]
    ['≠', 'only B', '=']
    """
    one, two = Inputs(first).flat(), Inputs(second).flat()
    rows = [_input_row(key, one, two) for key in {**one, **two}]
    return sorted(rows, key=lambda row: row.sign == "=")


def _input_row(key: str, one: Mapping[str, Any], two: Mapping[str, Any]) -> InputRow:
    first, second = (str(table[key]) if key in table else "" for table in (one, two))
    if key not in two:
        return InputRow(key, first, second, "only A")
    if key not in one:
        return InputRow(key, first, second, "only B")
    same = one[key] == two[key] and type(one[key]) is type(two[key])
    return InputRow(key, first, second, "=" if same else "≠")


def effects(first: Side, second: Side) -> list[Effect]:
    """Effects on every result, in the order of the cases, under their headings."""
    one, two = ({row.key or (row.group, row.name): row for row in side.results} for side in (first, second))
    found = [_effect(one.get(key), two.get(key)) for key in {**one, **two}]
    groups = list(dict.fromkeys(effect.either.group for effect in found))
    return sorted(found, key=lambda effect: groups.index(effect.either.group))


def _effect(first: Result | None, second: Result | None) -> Effect:
    if first is None or second is None:
        return Effect(first, second, None)
    (one, unit), (two, other) = first.number, second.number
    if one is None or two is None or one == 0.0 or unit != other:
        return Effect(first, second, None)
    change = 100.0 * (two - one) / abs(one)
    return Effect(first, second, change if math.isfinite(change) else None)


def only_in(first: Side, second: Side) -> Iterator[Told]:
    """Warnings that the first case has, and the second has not in any words."""
    codes = {told.code for told in second.warnings}
    return (told for told in first.warnings if told.code not in codes)


def in_both(first: Side, second: Side) -> Iterator[Told]:
    """Warnings of the first case that the second has, too."""
    codes = {told.code for told in second.warnings}
    return (told for told in first.warnings if told.code in codes)
