"""Content of sweep.sqlite: its tables, settings and rows are checked before any of them is used."""

from __future__ import annotations

import json
import sqlite3
import zlib
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from itertools import zip_longest
from types import MappingProxyType
from typing import Any, get_args

from ehlectric.cases.drives.swept import SweptCase, swept_case_of_dict
from ehlectric.cases.input_keys import input_field, number_of
from ehlectric.errors import CODES_OF_TEXTS, TEXTS, InputError
from ehlectric.runtime.checks.schema import UnfitError, case_of, is_list, is_number, is_table, is_text
from ehlectric.sweep import design as sweep_design
from ehlectric.sweep.points import Point, Range, Spacing, Status
from ehlectric.sweep.results import SweepResults

# Columns of the tables by name, as the first version has them; later ones may have more.
_COLUMNS: Mapping[str, tuple[str, ...]] = MappingProxyType(
    {
        "sweep": ("name", "value"),
        "points": ("number", "inputs", "key", "refused"),
        "results": ("key", "status", "reason", "again", "summary", "seconds", "version", "date"),
    }
)
# Table of the checksums of outcomes, which earlier versions do not have.
SEALS = "seals"

_DESIGNS = ("grid", "paired", "sobol")

# Most levels of a summary; those that are written have five.
_DEEPEST = 20

# Rows whose JSON is parsed together. Summaries parsed together share the strings of their keys, which would
# fill the memory otherwise.
_TOGETHER = 1000

_COLUMNS_OF_POINTS = "number, inputs, refused, status, reason, seconds, version, summary"


def check_tables(file: sqlite3.Connection) -> None:
    """Check the structure of a database and its tables, in an open transaction.

    Raises
    ------
    UnfitError
        Where pages or indices of the file are damaged, or a table is missing or is no table of a sweep.
    sqlite3.Error
        Where the file cannot be read.
    """
    entries = file.execute("SELECT type, name FROM sqlite_master").fetchall()
    if any(kind in ("view", "trigger") for kind, _ in entries):
        raise UnfitError("it has a view or a trigger, which no sweep has")
    for table, columns in _COLUMNS.items():
        if ("table", table) not in entries:
            raise UnfitError(f"the table {table} is missing")
        present = {row[1] for row in file.execute(f"PRAGMA table_info({table})")}
        for column in columns:
            if column not in present:
                raise UnfitError(f"{column} of the table {table} is missing")
    (found,) = file.execute("PRAGMA integrity_check(1)").fetchone()
    if found != "ok":
        raise UnfitError("its pages do not fit together")


def seal_of_row(row: Sequence[Any]) -> int:
    """Checksum of the outcome of a point, the values of its row in the table of results.

    Examples
    --------
    >>> seal_of_row(["a key", "solved", 1.5]) == seal_of_row(["a key", "solved", 9.5])
    False
    """
    return zlib.crc32(json.dumps(list(row), default=repr).encode())


def check_seals(file: sqlite3.Connection) -> None:
    """Check that outcomes are those that were written; those of earlier versions have no checksum.

    Raises
    ------
    UnfitError
        Where an outcome has changed.
    """
    if not file.execute("SELECT 1 FROM sqlite_master WHERE type = 'table' AND name = ?", (SEALS,)).fetchone():
        return
    columns = ", ".join(_COLUMNS["results"])
    for seal, *row in file.execute(f"SELECT seal, {columns} FROM results JOIN {SEALS} USING (key)"):
        if seal_of_row(row) != seal:
            raise UnfitError(f"the outcome {str(row[0])[:12]} is not as it was written")


def check_results(file: sqlite3.Connection) -> None:
    """Check all stored outcomes, also those of other sweeps in the same folder.

    Raises
    ------
    UnfitError
        Where an outcome is not as it was written.
    """
    rows = file.execute("SELECT key, again, date, status, reason, seconds, version, summary FROM results")
    for key, again, date, status, reason, seconds, version, summary in rows:
        name = f"the outcome {str(key)[:12]}"
        if not (is_text(key) and is_text(date) and again in (0, 1)):
            raise UnfitError(f"{name} is not as it was written")
        table = None if summary is None else _json(summary, name)
        _check_outcome(name, status, reason, seconds, version, table)


def results_of(file: sqlite3.Connection) -> SweepResults:
    """Results of a sweep from its tables, in an open transaction.

    Raises
    ------
    UnfitError
        Where a setting or a point is not as it was written.
    sqlite3.Error
        Where the file cannot be read.
    """
    settings = _settings(file.execute("SELECT name, value FROM sweep").fetchall())
    rows = file.execute(
        f"SELECT {_COLUMNS_OF_POINTS} FROM points LEFT JOIN results USING (key) ORDER BY number"
    ).fetchall()
    case = case_of(settings, swept_case_of_dict)
    axes = {key: tuple(values) for key, values in settings["axes"].items()}
    ranges = {key: Range(**over) for key, over in settings["ranges"].items()}
    points = tuple(_points(rows, case))
    _check_design(settings["design"], axes, ranges, settings["samples"], points)
    return SweepResults(
        case=case,
        design=settings["design"],
        axes=axes,
        ranges=ranges,
        samples=settings["samples"],
        points=points,
        seed=settings["seed"],
        title=settings["title"],
    )


_is_count = partial(is_number, values="whole")


def _is_varied(value: Any, right: Callable[[str, Any], bool]) -> bool:
    """Whether a value of JSON is an object whose keys can vary, each with a right value."""
    if not isinstance(value, dict):
        return False
    try:
        return all(right(key, item) for key, item in value.items())
    except InputError:  # of a key that no case has
        return False


def _is_axis(key: str, value: Any) -> bool:
    numeric = number_of(input_field(key)) is not None
    return is_list(value, is_number if numeric else _is_small) and bool(value)


def _is_small(value: Any) -> bool:
    """Whether a value of JSON may be an input: a text, a number, or a list of them."""
    return is_text(value) or is_number(value) or isinstance(value, bool) or is_list(value, is_number)


def _is_range(key: str, value: Any) -> bool:
    ends = {"start": is_number, "stop": is_number}
    spacing = {"spacing": lambda item: item in get_args(Spacing)}
    return number_of(input_field(key)) is not None and is_table(value, ends, spacing)


# Settings by name, each with a check of its value.
_SETTINGS: Mapping[str, Callable[[Any], bool]] = MappingProxyType(
    {
        "case": is_text,
        "design": lambda value: is_text(value) and value in _DESIGNS,
        "axes": partial(_is_varied, right=_is_axis),
        "ranges": partial(_is_varied, right=_is_range),
        "samples": _is_count,
        "seed": _is_count,
        "title": is_text,
    }
)


def _settings(rows: Sequence[tuple[Any, Any]]) -> dict[str, Any]:
    """Settings of a sweep by name, checked."""
    texts = dict(rows)
    settings = {}
    for name, right in _SETTINGS.items():
        if name not in texts:
            raise UnfitError(f"the setting {name} is missing")
        settings[name] = _json(texts[name], f"the setting {name}")
        if not right(settings[name]):
            raise UnfitError(f"the setting {name} is not as it was written")
    return settings


def _check_design(
    design: str,
    axes: Mapping[str, tuple[Any, ...]],
    ranges: Mapping[str, Range],
    samples: int,
    points: Sequence[Point],
) -> None:
    """Check that the points are those of the design.

    Those of a Sobol design are not computed again, as other versions may draw others.
    """
    sobol = design == "sobol"
    if not (ranges if sobol else axes) or (axes if sobol else ranges):
        raise UnfitError("axes and ranges do not belong to the design")
    if [point.number for point in points] != list(range(len(points))):
        raise UnfitError("the numbers of its points have gaps")
    if not sobol:
        if design == "paired" and len({len(axis) for axis in axes.values()}) > 1:
            raise UnfitError("the setting axes has lists of different lengths")
        expected = (sweep_design.grid if design == "grid" else sweep_design.paired)(axes)
        for planned, point in zip_longest(expected, points):
            if planned is None or point is None or planned != point.inputs:
                raise UnfitError("its points are not those of the design")
        return
    if samples < 1 or len(points) != samples * (len(ranges) + 2):
        raise UnfitError(f"it has {len(points)} points, which its design has not")
    within = dict.fromkeys(ranges, is_number)
    for point in points:
        if not is_table(point.inputs, within):
            raise UnfitError(f"inputs of point {point.number} are not as they were written")


def _points(rows: Sequence[tuple[Any, ...]], case: SweptCase) -> Iterator[Point]:
    """Points from rows of the joined tables, checked."""
    for (number, _, refused, status, reason, seconds, version, _), (inputs, summary) in zip(
        rows, _parsed(rows), strict=True
    ):
        name = f"point {number}"
        if not (is_text(refused) and isinstance(inputs, dict)):
            raise UnfitError(f"{name} is not as it was written")
        if refused or status is None:
            yield Point(number, inputs, "failed" if refused else "open", refused)
            continue
        _check_outcome(name, status, reason, seconds, version, summary)
        if summary is not None:
            # The key does not cover the title, so the summary may belong to a case with another title.
            summary["title"] = inputs.get("title", case.title)
        yield Point(number, inputs, status, reason, summary, seconds, version)


def _parsed(rows: Sequence[tuple[Any, ...]]) -> Iterator[tuple[Any, Any]]:
    """Inputs and summaries of rows, parsed from JSON, a thousand at a time."""
    for start in range(0, len(rows), _TOGETHER):
        some = rows[start : start + _TOGETHER]
        texts = [text for _, inputs, *_, summary in some for text in (inputs, summary or "null")]
        try:
            values = json.loads(f"[{','.join(texts)}]", parse_constant=_refuse)
        except (RecursionError, TypeError, ValueError):
            values = ()
        if len(values) != len(texts):
            # One of them is no JSON: alone, it is named.
            values = [_json(text, f"point {some[k // 2][0]}") for k, text in enumerate(texts)]
        yield from zip(values[::2], values[1::2], strict=True)


def _json(text: Any, name: str) -> Any:
    """Value of a JSON text."""
    if not isinstance(text, str):
        raise UnfitError(f"{name} is not a text")
    try:
        return json.loads(text, parse_constant=_refuse)
    except (RecursionError, ValueError):
        raise UnfitError(f"{name} is no JSON") from None


def _refuse(constant: str) -> None:
    """Refuse NaN and infinite numbers, which are not written."""
    raise ValueError(constant)


def _check_outcome(name: str, status: Any, reason: Any, seconds: Any, version: Any, summary: Any) -> None:
    """Check the outcome of a point that was tried."""
    if status not in get_args(Status) or status == "open":
        raise UnfitError(f"the status of {name} is none of a point")
    if not (is_text(reason) and is_text(version) and is_number(seconds, "not negative")):
        raise UnfitError(f"{name} is not as it was written")
    if summary is None:
        if status != "failed":
            raise UnfitError(f"the summary of {name} is missing")
    elif not (isinstance(summary, dict) and _is_summary(summary) and _has_warnings(summary)):
        raise UnfitError(f"the summary of {name} is not as it was written")


def _is_summary(value: Any, levels: int = _DEEPEST) -> bool:
    """Whether a value of JSON holds finite numbers, and no more levels than a summary."""
    if isinstance(value, dict | list):
        items = value.values() if isinstance(value, dict) else value
        return levels > 0 and all(
            item is None or isinstance(item, str | bool) or _is_summary(item, levels - 1) for item in items
        )
    return value is None or isinstance(value, str | bool) or is_number(value)


def _has_warnings(summary: Mapping[str, Any]) -> bool:
    """Whether the warnings of a summary are texts, with as many codes, where it has any."""
    texts = summary.get(TEXTS, [])
    codes = summary.get(CODES_OF_TEXTS, [])
    return is_list(texts, is_text) and is_list(codes, is_text) and len(texts) == len(codes)
