"""Storage of a sweep in one SQLite file, and checks of its content before any of it is used."""

from __future__ import annotations

import json
import math
import sqlite3
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import asdict
from functools import partial
from itertools import zip_longest
from pathlib import Path
from types import MappingProxyType
from typing import Any, get_args

from ehlectric.cases.amounts import INFINITE, Amount, finite_or_text
from ehlectric.cases.case import Case
from ehlectric.cases.input_keys import input_field, kind_of
from ehlectric.cases.solved_case import SolvedCase, solved_case_of_dict
from ehlectric.cases.table import number_of
from ehlectric.contact import case_with_stored_laws
from ehlectric.errors import InputError
from ehlectric.lubricant.python_laws import SampledLaws, is_laws
from ehlectric.quantities.former_keys import with_successors
from ehlectric.quantities.result_warnings import (
    CODES_OF_TEXTS,
    TEXTS,
    ResultWarning,
    texts_and_codes,
    warnings_of,
)
from ehlectric.runtime.file_rules import (
    LARGEST,
    UnfitError,
    case_of,
    is_list,
    is_number,
    is_table,
    is_text,
)
from ehlectric.runtime.files import now
from ehlectric.runtime.journal import Journal, JournalForm, reading, seal_of_row
from ehlectric.runtime.result_names import SWEEP
from ehlectric.sweep import sweep_inputs as sweep_design
from ehlectric.sweep.axis_labels import result_keys
from ehlectric.sweep.engine import Outcome, Planned
from ehlectric.sweep.points import Point, Range, Spacing, Status
from ehlectric.sweep.result import SweepResults
from ehlectric.sweep.sweep_inputs import Sweep
from ehlectric.version import __version__

# Columns of the tables by name, as the first version has them; later ones may have more.
_COLUMNS: Mapping[str, tuple[str, ...]] = MappingProxyType(
    {
        "sweep": ("name", "value"),
        "points": ("number", "inputs", "key", "refused"),
        "results": ("key", "status", "reason", "again", "summary", "seconds", "version", "date"),
    }
)
# Table of the checksums of outcomes, which earlier versions do not have.
_SEALS = "seals"

_DESIGNS = ("grid", "paired", "sobol")

# Setting of the samples of the probability of breakdown.
_UNCERTAINTY = "uncertainty_samples"

# Setting of the values of laws of the user's own in the base case.
_LAWS = "laws"

# Most levels of a summary; those that are written have five.
_DEEPEST = 20

# Rows whose JSON is parsed together. Summaries parsed together share the strings of their keys, which would
# fill the memory otherwise.
_TOGETHER = 1000

_COLUMNS_OF_POINTS = "number, inputs, refused, status, reason, seconds, version, summary"


def _check(name: str, *, right: bool) -> None:
    """Raise UnfitError where a part of the file is not as it was written."""
    if not right:
        raise UnfitError(f"{name} is not as it was written")


def check_seals(file: sqlite3.Connection) -> None:
    """Check that outcomes are unchanged since they were written; outcomes of earlier versions have no
    checksum. Raises UnfitError where an outcome has changed.
    """
    if not file.execute(
        "SELECT 1 FROM sqlite_master WHERE type = 'table' AND name = ?", (_SEALS,)
    ).fetchone():
        return
    columns = ", ".join(_COLUMNS["results"])
    for seal, *row in file.execute(f"SELECT seal, {columns} FROM results JOIN {_SEALS} USING (key)"):
        if seal_of_row(row) != seal:
            raise UnfitError(f"the outcome {str(row[0])[:12]} is not as it was written")


def check_results(file: sqlite3.Connection) -> None:
    """Check all stored outcomes, also of other sweeps in the same folder. Raises UnfitError where an
    outcome is not as it was written.
    """
    rows = file.execute("SELECT key, again, date, status, reason, seconds, version, summary FROM results")
    for key, again, date, status, reason, seconds, version, summary in rows:
        name = f"the outcome {str(key)[:12]}"
        _check(name, right=is_text(key) and is_text(date) and again in (0, 1))
        table = None if summary is None else _json(summary, name)
        _check_outcome(name, status, reason, seconds, version, table)


def _law_values(case: SolvedCase) -> SampledLaws | None:
    """Values of laws of the user's own; None without any."""
    return case.law_values if isinstance(case, Case) else None


def results_of(file: sqlite3.Connection) -> SweepResults:
    """Results of a sweep from its tables, in an open transaction. Raises UnfitError where a setting or a
    point is not as it was written; sqlite3.Error where the file cannot be read.
    """
    settings = _settings(file.execute("SELECT name, value FROM sweep").fetchall())
    rows = file.execute(
        f"SELECT {_COLUMNS_OF_POINTS} FROM points LEFT JOIN results USING (key) ORDER BY number"
    ).fetchall()
    stored = settings[_LAWS]
    read = solved_case_of_dict if stored is None else partial(case_with_stored_laws, stored=stored)
    case: SolvedCase = case_of(settings, read)
    results = SweepResults(
        case=case,
        design=settings["design"],
        axes={key: tuple(_read(key, value) for value in values) for key, values in settings["axes"].items()},
        ranges={key: Range(**over) for key, over in settings["ranges"].items()},
        samples=settings["samples"],
        points=tuple(_points(rows, case)),
        seed=settings["seed"],
        title=settings["title"],
        uncertainty_samples=settings[_UNCERTAINTY],
    )
    _check_design(results)
    return results


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
    kind = number_of(input_field(key))
    right = (
        _is_small
        if kind is None
        else lambda item: is_number(item) or (_may_be_infinite(key) and item == INFINITE)
    )
    return is_list(value, right) and bool(value)


def _may_be_infinite(key: str) -> bool:
    """Whether a key is a number that may be infinite."""
    kind = kind_of(key)
    return isinstance(kind, Amount) and kind.infinite


def _read(key: str, value: Any) -> Any:
    """Value of an input from JSON."""
    return math.inf if value == INFINITE and _may_be_infinite(key) else value


def _written_inputs(inputs: Mapping[str, Any]) -> dict[str, Any]:
    return {key: finite_or_text(value) for key, value in inputs.items()}


def _read_inputs(inputs: Mapping[str, Any]) -> dict[str, Any]:
    return {key: _read(key, value) for key, value in inputs.items()}


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
        _UNCERTAINTY: _is_count,
        _LAWS: lambda value: value is None or is_laws(value),
    }
)

# Settings that files of earlier versions do not have, as JSON.
_ADDED = MappingProxyType({_UNCERTAINTY: "0", _LAWS: "null"})


def _settings(rows: Sequence[tuple[Any, Any]]) -> dict[str, Any]:
    """Settings of a sweep by name, checked."""
    texts = _ADDED | dict(rows)
    settings = {}
    for name, right in _SETTINGS.items():
        if name not in texts:
            raise UnfitError(f"the setting {name} is missing")
        settings[name] = _json(texts[name], f"the setting {name}")
        _check(f"the setting {name}", right=right(settings[name]))
    return settings


def _check_design(results: SweepResults) -> None:
    """Check that the points are the points of the design.

    Points of a Sobol design are not computed again, as other versions may draw others.
    """
    axes, ranges, points = results.axes, results.ranges, results.points
    sobol = results.design == "sobol"
    if not (ranges if sobol else axes) or (axes if sobol else ranges):
        raise UnfitError("axes and ranges do not belong to the design")
    if [point.number for point in points] != list(range(len(points))):
        raise UnfitError("the numbers of its points have gaps")
    if not sobol:
        if results.design == "paired" and len({len(axis) for axis in axes.values()}) > 1:
            raise UnfitError("the setting axes has lists of different lengths")
        planned = (sweep_design.grid if results.design == "grid" else sweep_design.paired)(axes)
        # A grid may have far more points than the file: no list of them is made.
        pairs = zip_longest(planned, (point.inputs for point in points))
        if any(expected != stored for expected, stored in pairs):
            raise UnfitError("its points differ from the design")
        return
    if results.samples < 1 or len(points) != results.samples * (len(ranges) + 2):
        raise UnfitError(f"it has {len(points)} points, which its design has not")
    within = dict.fromkeys(ranges, is_number)
    for point in points:
        if not is_table(point.inputs, within):
            raise UnfitError(f"inputs of point {point.number} are not as they were written")


def _points(rows: Sequence[tuple[Any, ...]], case: SolvedCase) -> Iterator[Point]:
    """Points from rows of the joined tables, checked."""
    for (number, _, refused, status, reason, seconds, version, _), (inputs, summary) in zip(
        rows, _parsed(rows), strict=True
    ):
        name = f"point {number}"
        _check(name, right=is_text(refused) and isinstance(inputs, dict))
        inputs = _read_inputs(inputs)
        if refused or status is None:
            yield Point(number, inputs, "failed" if refused else "open", refused)
            continue
        _check_outcome(name, status, reason, seconds, version, summary)
        if summary is not None:
            # The key does not cover the title, so the summary may belong to a case with another title.
            summary["title"] = inputs.get("title", case.title)
            summary = with_successors(summary, result_keys(case))
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
            # One of them is no JSON: read one by one, it is named.
            values = [_json(text, f"point {some[k // 2][0]}") for k, text in enumerate(texts)]
        yield from zip(values[::2], values[1::2], strict=True)


def _json(text: Any, name: str) -> Any:
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
    _check(name, right=is_text(reason) and is_text(version) and is_number(seconds) and seconds >= 0)
    if summary is not None:
        usable = isinstance(summary, dict) and _is_summary(summary) and _has_warnings(summary)
        _check(f"the summary of {name}", right=usable)
    elif status != "failed":
        raise UnfitError(f"the summary of {name} is missing")


def _is_summary(value: Any, levels: int = _DEEPEST) -> bool:
    """Whether an object or list of JSON holds finite numbers, and no more levels than a summary."""
    if levels == 0:
        return False
    for item in value.values() if isinstance(value, dict) else value:
        kind = type(item)
        if kind is float or kind is int:
            right = abs(item) < LARGEST
        else:
            right = kind in _OTHERS or _is_summary(item, levels - 1)
        if not right:
            return False
    return True


_OTHERS = frozenset({str, bool, type(None)})


def _readable(summary: Mapping[str, Any]) -> str:
    """JSON text of a summary that readers accept: numbers that no file may contain are null, with a warning.

    Examples
    --------
    >>> found = json.loads(_readable({"film": {"at": [1.0, 2e40]}, "warnings": [], "warning_codes": []}))
    >>> found["film"], found["warning_codes"], found["warnings"][0][23:41]
    ({'at': [1.0, None]}, ['number-not-stored'], 'film.at.1 is 2e+40')
    """
    unfit: dict[str, float] = {}
    fit = _with_fit_numbers(summary, "", unfit)
    if unfit:
        names = ", ".join(f"{key} is {value:.3g}" for key, value in unfit.items())
        warnings = texts_and_codes([*warnings_of(fit), ResultWarning.of("number-not-stored", names=names)])
        fit |= warnings
    return json.dumps(fit, allow_nan=False)


def _with_fit_numbers(value: Any, key: str, unfit: dict[str, float]) -> Any:
    """Value of JSON whose numbers are null if no file may contain them; these are added to ``unfit``."""
    if isinstance(value, Mapping):
        return {
            name: _with_fit_numbers(item, f"{key}.{name}" if key else name, unfit)
            for name, item in value.items()
        }
    if isinstance(value, list | tuple):
        return [_with_fit_numbers(item, f"{key}.{number}", unfit) for number, item in enumerate(value)]
    if isinstance(value, float) and not abs(value) < LARGEST:
        unfit[key] = value
        return None
    return value


def _has_warnings(summary: Mapping[str, Any]) -> bool:
    """Whether the warnings of a summary are texts, with as many codes, where it has any."""
    texts = summary.get(TEXTS, [])
    codes = summary.get(CODES_OF_TEXTS, [])
    return is_list(texts, is_text) and is_list(codes, is_text) and len(texts) == len(codes)


NAME = SWEEP

_TABLES = """
CREATE TABLE IF NOT EXISTS sweep (name TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT ROWID;
CREATE TABLE IF NOT EXISTS points (
    number INTEGER PRIMARY KEY, inputs TEXT NOT NULL, key TEXT, refused TEXT NOT NULL
);
CREATE TABLE IF NOT EXISTS results (
    key TEXT PRIMARY KEY, status TEXT NOT NULL, reason TEXT NOT NULL, again INTEGER NOT NULL, summary TEXT,
    seconds REAL NOT NULL, version TEXT NOT NULL, date TEXT NOT NULL
);
CREATE TABLE IF NOT EXISTS seals (key TEXT PRIMARY KEY, seal INTEGER NOT NULL);
"""

# The application id is the letters "ehle".
_FORM = JournalForm("sweep", application=0x65686C65, version=1, tables=_TABLES, columns=_COLUMNS)

# SQL condition for an outcome that is final. A failed point is tried again if its process was killed or
# ran out of memory, or if another version of ehlectric failed.
_DONE = f"(results.status <> 'failed' OR (NOT results.again AND results.version = '{__version__}'))"


class Store(Journal):
    """File of a sweep, opened by the single process that writes it; a context manager.

    Raises InputError by every method, if the file cannot be used, is not a sweep, or is written by another
    process.
    """

    def __init__(self, folder: Path) -> None:
        super().__init__(folder / NAME, _FORM, _check_stored)

    def begin(self, sweep: Sweep, planned: Iterable[Planned]) -> None:
        """Replace the stored input and points by another sweep's; stored outcomes are kept."""
        settings = {
            "case": sweep.case.toml_text(),
            _LAWS: None if (laws := _law_values(sweep.case)) is None else laws.stored(),
            "design": sweep.design,
            "axes": {key: [finite_or_text(value) for value in values] for key, values in sweep.axes.items()},
            "ranges": {key: asdict(over) for key, over in sweep.ranges.items()},
            "samples": sweep.samples or 0,
            "seed": sweep.seed,
            "title": sweep.title,
            _UNCERTAINTY: sweep.uncertainty_samples or 0,
            "version": __version__,
            "date": now(),
        }
        rows = ((at.number, json.dumps(_written_inputs(at.inputs)), at.key, at.refused) for at in planned)
        with self.transaction(create=True) as file:
            file.execute("DELETE FROM sweep")
            file.execute("DELETE FROM points")
            file.executemany(
                "INSERT INTO sweep VALUES (?, ?)",
                [(name, json.dumps(value)) for name, value in settings.items()],
            )
            file.executemany("INSERT INTO points VALUES (?, ?, ?, ?)", rows)

    def open_points(self) -> list[tuple[str, dict[str, Any]]]:
        """Keys and inputs of the points that are still to be solved, each case once."""
        with self.one_line_errors():
            rows = self.file.execute(
                "SELECT points.key, inputs, min(number) FROM points LEFT JOIN results USING (key) "
                f"WHERE points.key IS NOT NULL AND (results.key IS NULL OR NOT {_DONE}) "
                "GROUP BY points.key ORDER BY min(number)"
            ).fetchall()
        return [(key, _read_inputs(json.loads(inputs))) for key, inputs, _ in rows]

    def counts(self) -> dict[str, int]:
        """Number of points by status; points that are to be tried again count as "open"."""
        with self.one_line_errors():
            rows = self.file.execute(
                "SELECT CASE WHEN points.key IS NULL THEN 'failed' "
                f"WHEN results.key IS NULL OR NOT {_DONE} THEN 'open' ELSE results.status END AS status, "
                "count(*) FROM points LEFT JOIN results USING (key) GROUP BY 1"
            ).fetchall()
        return dict(rows)

    def write(self, rows: Iterable[tuple[str, Outcome]]) -> None:
        """Commit the outcomes of points, given with their keys.

        Numbers of a summary that ``read_sweep`` would refuse are stored as null, with a warning that names
        them.
        """
        values = [
            (
                key, outcome.status, outcome.reason, int(outcome.again),
                None if outcome.summary is None else _readable(outcome.summary),
                outcome.seconds, outcome.version, outcome.date,
            )
            for key, outcome in rows
        ]  # fmt: skip
        with self.transaction() as file:
            file.executemany("INSERT OR REPLACE INTO results VALUES (?, ?, ?, ?, ?, ?, ?, ?)", values)
            seals = [(row[0], seal_of_row(row)) for row in values]
            file.executemany(f"INSERT OR REPLACE INTO {_SEALS} VALUES (?, ?)", seals)


def read_sweep(folder: str | Path) -> SweepResults:
    """Read a sweep from its folder, whether it is finished, interrupted or still running.

    Parameters
    ----------
    folder : str or Path
        Folder of the sweep. Only its file sweep.sqlite is read.

    Returns
    -------
    SweepResults
        All points of the design; points that are not solved yet are "open".

    Raises
    ------
    InputError
        If the folder has no sweep, or its file cannot be read.
    DamagedError
        If its file is damaged.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> import ehlectric
    >>> case = ehlectric.BearingCase.from_toml(ehlectric.example("bearing_6208.toml"))
    >>> vary = {"bearing.inner_speed": ["1000 rpm", "3000 rpm"]}
    >>> sweep = ehlectric.Sweep.from_dict({"case": case.replace(contacts="atlas"), "vary": vary})
    >>> with TemporaryDirectory() as folder:
    ...     results = ehlectric.run_sweep(sweep, folder, workers=1)
    ...     ehlectric.read_sweep(folder).numbers == results.numbers
    True
    """
    with reading(Path(folder) / NAME, _FORM, checked=True) as file:
        results = results_of(file)
        check_seals(file)
    return results


def saved_points(folder: str | Path) -> tuple[int, int]:
    """Number of points of a sweep that have been tried and saved, and number of all its points. Raises
    InputError if the file cannot be used, or is not a sweep.
    """
    with reading(Path(folder) / NAME, _FORM) as file:
        saved, points = file.execute(
            "SELECT count(CASE WHEN points.key IS NULL OR results.key IS NOT NULL THEN 1 END), count(*) "
            "FROM points LEFT JOIN results USING (key)"
        ).fetchone()
    return saved, points


def _check_stored(file: sqlite3.Connection) -> None:
    """Check the outcomes of a file before points are added to it."""
    check_results(file)
    check_seals(file)
