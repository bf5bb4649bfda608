"""Inputs of the sweep page: a sweep file with its base case inside, and the result that the map shows.

``case`` and ``vary`` are those of a sweep file, so that the downloaded file runs as it is. ``show`` is the
dotted key of the shown result; only the address has it.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any
from urllib.parse import parse_qsl, urlsplit

from ehlectric.app.inputs import Inputs


@dataclass(frozen=True)
class Range:
    """Range of a varied input, as a sweep file has it.

    Attributes
    ----------
    key : str
        Dotted key of the case.
    start, stop : str
        Ends with their units.
    count : int or str
        Number of values; another text as it was typed.
    log : bool
        Whether the values are spaced by logarithms.
    """

    key: str
    start: str
    stop: str
    count: int | str = 8
    log: bool = False

    def table(self) -> dict[str, Any]:
        """Table of a sweep file."""
        ends = (number_of_text(self.start), number_of_text(self.stop))
        table: dict[str, Any] = {"from": ends[0], "to": ends[1], "count": self.count}
        return table | ({"spacing": "log"} if self.log else {})


def sweep_inputs(inputs: Inputs) -> Inputs | None:
    """Inputs of the sweep page from an address: its own, or those of the page of a case.

    Examples
    --------
    >>> sweep_inputs(Inputs({"bearing": {"base": "6208"}})).value("case.bearing.base")
    '6208'
    >>> sweep_inputs(Inputs()) is None
    True
    """
    if isinstance(inputs.value("case"), Mapping):
        return inputs
    if any(inputs.value(table) for table in ("bearing", "drive_end", "contact")):
        return Inputs({"case": _of_case(inputs.table)})
    return None


def case_of_link(link: str) -> dict[str, Any] | None:
    """Tables of the case in a link to a bearing, contact or sweep page; None where it has none.

    Examples
    --------
    >>> case_of_link("http://localhost:8080/?bearing.base=%276208%27")
    {'bearing': {'base': '6208'}}
    """
    query = urlsplit(link.strip()).query
    found = sweep_inputs(Inputs.of_query(parse_qsl(query, keep_blank_values=True)))
    return None if found is None else dict(found.value("case"))


def ranges_of(inputs: Inputs) -> list[Range]:
    """Ranges of the varied inputs, in the order of the design; lists of values are none."""
    return [one for _, one in _varied(inputs) if isinstance(one, Range)]


def lists_of(inputs: Inputs) -> dict[str, Any]:
    """Varied inputs of an opened file that have other values than a range, by their keys.

    Examples
    --------
    >>> lists_of(Inputs({"vary": {"bearing": {"elements": [8, 9]}}}))
    {'bearing.elements': [8, 9]}
    """
    return {key: value for key, value in _varied(inputs) if not isinstance(value, Range)}


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
    for key, value in _varied(inputs):
        if not isinstance(value, Range):
            varied[key] = value
        elif (one := next(new, None)) is not None:
            varied[one.key] = one.table()
    varied |= {one.key: one.table() for one in new}
    without = inputs.changed({"vary": None})
    return without.changed({f"vary.{key}": value for key, value in varied.items()})


def sweep_file(inputs: Inputs) -> Inputs:
    """Inputs without the shown result, which a sweep file does not have."""
    return inputs.changed({"show": None})


def same_sweep(one: Inputs, other: Inputs) -> bool:
    """Whether two sweeps have the same points in the same order.

    Examples
    --------
    >>> ranges = [Range("bearing.elements", "8", "9", 2), Range("bearing.radial_load", "1 N", "2 N", 2)]
    >>> same_sweep(with_ranges(Inputs(), ranges), with_ranges(Inputs(), ranges[::-1]))
    False
    """
    orders = [list(Inputs(inputs.value("vary") or {}).flat()) for inputs in (one, other)]
    return one == other and orders[0] == orders[1]


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


def _of_case(table: Mapping[str, Any]) -> dict[str, Any]:
    return {key: value for key, value in table.items() if key not in ("vary", "show", "case", "token")}


def _varied(inputs: Inputs) -> list[tuple[str, Any]]:
    """Varied inputs in the order of the design, by dotted key: a range, or other values as they are."""
    table = inputs.value("vary")
    return list(_leaves(table)) if isinstance(table, Mapping) else []


def _leaves(table: Mapping[str, Any], prefix: str = "") -> Iterator[tuple[str, Any]]:
    for name, value in table.items():
        key = f"{prefix}{name}"
        if not isinstance(value, Mapping) or not value:
            yield key, value
        elif "from" in value or "to" in value:
            log = value.get("spacing") == "log"
            ends = (str(value.get("from", "")), str(value.get("to", "")))
            yield key, Range(key, *ends, count=value.get("count", ""), log=log)
        else:
            yield from _leaves(value, f"{key}.")
