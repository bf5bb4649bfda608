"""A sweep on disk: one SQLite file with what was asked, every point, and what was found, row by row."""

from __future__ import annotations

import hashlib
import json
import sqlite3
import tomllib
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from dataclasses import asdict, dataclass
from functools import cache
from pathlib import Path
from typing import Any, Self

from ehlectric.cases.any_case import AnyCase, case_of_dict
from ehlectric.errors import InputError
from ehlectric.runtime.files import now, reading, refuse_special, refuse_unreadable
from ehlectric.sweep.inputs import Sweep
from ehlectric.sweep.results import Point, Range, Status, SweepResults
from ehlectric.version import __version__

NAME = "sweep.sqlite"
LOCK = ".sweep.lock"

# Marks the file as ours, as SQLite provides for; the letters "ehle". And the version of the tables in it.
_APPLICATION = 0x65686C65
_VERSION = 1

# What a reader or the writer waits for the other [s].
_PATIENCE = 60.0
_TABLES = """
CREATE TABLE IF NOT EXISTS sweep (name TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT ROWID;
CREATE TABLE IF NOT EXISTS points (
    number INTEGER PRIMARY KEY, inputs TEXT NOT NULL, key TEXT, refused TEXT NOT NULL
);
CREATE TABLE IF NOT EXISTS results (
    key TEXT PRIMARY KEY, status TEXT NOT NULL, reason TEXT NOT NULL, again INTEGER NOT NULL, summary TEXT,
    seconds REAL NOT NULL, version TEXT NOT NULL, date TEXT NOT NULL
);
"""

# Points whose row is there and need not be tried again. A failed one is, where its process was killed or its
# memory did not do, and where another version of the program failed.
_DONE = f"(results.status <> 'failed' OR (NOT results.again AND results.version = '{__version__}'))"


@dataclass(frozen=True)
class Planned:
    """A point before it is solved.

    ``inputs`` as of a ``Point``; ``key`` of its case, None where that is refused, with the reason.
    """

    number: int
    inputs: Mapping[str, Any]
    key: str | None
    refused: str = ""


@dataclass(frozen=True)
class Outcome:
    """What became of a point that was tried; ``again`` where another try may do better.

    The others as of a ``Point``; ``date`` in ISO 8601.
    """

    status: Status
    reason: str = ""
    again: bool = False
    summary: Mapping[str, Any] | None = None
    seconds: float = 0.0
    version: str = __version__
    date: str = ""


def case_key(case: AnyCase) -> str:
    """What a solution depends on, as a hash: all inputs, defaults filled in, and the contents of files.

    Parameters
    ----------
    case : Case or BearingCase
        A valid case. Its title, and where its files lie, are left out.

    Raises
    ------
    InputError
        Where a file cannot be read.

    Examples
    --------
    >>> contact = {"reduced_radius": "14.1 mm", "reduced_modulus": "226 GPa"}
    >>> contact |= {"max_hertz_pressure": "1 GPa", "entrainment_speed": "4 m/s"}
    >>> case = case_of_dict({"contact": contact, "lubricant": {"base": "paper"}})
    >>> case_key(case) == case_key(case.replace(title="Another", solver={"max_iterations": 30}))
    True
    """
    table = case.to_dict()
    del table["title"]
    for surface in table.get("roughness", ()):
        if "file" in surface:
            path = Path(surface["file"])
            with reading(path):
                status = path.stat()
                surface["file"] = _contents(path, status.st_mtime_ns, status.st_size)
    text = json.dumps(table, sort_keys=True, separators=(",", ":"), allow_nan=False)
    return hashlib.sha256(text.encode()).hexdigest()


@cache
def _contents(path: Path, _changed: int, _size: int) -> str:
    """Hash of a file, read once while it stays as it is."""
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def plan(sweep: Sweep) -> Iterator[Planned]:
    """The points of a sweep with the keys of their cases, or why they are none."""
    for number, inputs in enumerate(sweep.points()):
        try:
            yield Planned(number, inputs, case_key(sweep.case.replace(inputs)))
        except InputError as error:
            yield Planned(number, inputs, None, str(error))


class Store:
    """The file of a sweep, for the one process that writes it.

    Every ``write`` is a transaction of its own in SQLite's rollback journal, synchronous: what it has written
    is there after a crash of the machine, and a reader needs the one file alone. (A write-ahead log is
    quicker, but not for network file systems.)

    Raises
    ------
    InputError
        From every method: where the file cannot be used, is none of a sweep, or another sweep writes it.
    """

    def __init__(self, folder: Path) -> None:
        self._path = folder / NAME
        for name in (NAME, LOCK):
            refuse_special(folder / name)
        self._lock = _locked(folder / LOCK)
        try:
            with _told(self._path):
                self._file = _opened(self._path, "rwc")
                self._file.execute("PRAGMA journal_mode = TRUNCATE")
                self._file.execute("PRAGMA synchronous = FULL")
        except BaseException:
            self._lock.close()
            raise

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        with suppress(sqlite3.Error):
            # Leaves no empty journal behind.
            self._file.execute("PRAGMA journal_mode = DELETE")
        self._file.close()
        self._lock.close()

    def begin(self, sweep: Sweep, planned: Iterable[Planned]) -> None:
        """Write what is asked in place of what was asked before; what was found stays."""
        asked = {
            "case": sweep.case.to_toml(),
            "design": sweep.design,
            "axes": sweep.axes,
            "ranges": {key: asdict(over) for key, over in sweep.ranges.items()},
            "samples": sweep.samples or 0,
            "seed": sweep.seed,
            "title": sweep.title,
            "version": __version__,
            "date": now(),
        }
        rows = ((point.number, json.dumps(point.inputs), point.key, point.refused) for point in planned)
        with self._transaction():
            for statement in _TABLES.split(";"):
                self._file.execute(statement)
            self._file.execute(f"PRAGMA application_id = {_APPLICATION}")
            self._file.execute(f"PRAGMA user_version = {_VERSION}")
            self._file.execute("DELETE FROM sweep")
            self._file.execute("DELETE FROM points")
            self._file.executemany(
                "INSERT INTO sweep VALUES (?, ?)",
                [(name, json.dumps(value)) for name, value in asked.items()],
            )
            self._file.executemany("INSERT INTO points VALUES (?, ?, ?, ?)", rows)

    def open_points(self) -> list[tuple[str, dict[str, Any]]]:
        """Keys and inputs of what is to be solved, each case once."""
        with _told(self._path):
            rows = self._file.execute(
                "SELECT points.key, inputs, min(number) FROM points LEFT JOIN results USING (key) "
                f"WHERE points.key IS NOT NULL AND (results.key IS NULL OR NOT {_DONE}) "
                "GROUP BY points.key ORDER BY min(number)"
            ).fetchall()
        return [(key, json.loads(inputs)) for key, inputs, _ in rows]

    def counts(self) -> dict[str, int]:
        """Points by their status; those that are to be tried again count as "open"."""
        with _told(self._path):
            rows = self._file.execute(
                "SELECT CASE WHEN points.key IS NULL THEN 'failed' "
                f"WHEN results.key IS NULL OR NOT {_DONE} THEN 'open' ELSE results.status END AS status, "
                "count(*) FROM points LEFT JOIN results USING (key) GROUP BY 1"
            ).fetchall()
        return dict(rows)

    def write(self, rows: Iterable[tuple[str, Outcome]]) -> None:
        """Commit what was found at points, by their keys."""
        values = [
            (
                key, found.status, found.reason, found.again,
                None if found.summary is None else json.dumps(found.summary, allow_nan=False),
                found.seconds, found.version, found.date,
            )
            for key, found in rows
        ]  # fmt: skip
        with self._transaction():
            self._file.executemany("INSERT OR REPLACE INTO results VALUES (?, ?, ?, ?, ?, ?, ?, ?)", values)

    @contextmanager
    def _transaction(self) -> Iterator[None]:
        with _told(self._path):
            self._file.execute("BEGIN IMMEDIATE")
            try:
                yield
                self._file.execute("COMMIT")
            except BaseException:
                if self._file.in_transaction:
                    self._file.execute("ROLLBACK")
                raise


def read_sweep(folder: str | Path) -> SweepResults:
    """A sweep as it stands in its folder, finished, killed or still running.

    Parameters
    ----------
    folder : str or Path
        Where ``sweep`` writes; sweep.sqlite alone is read.

    Returns
    -------
    SweepResults
        All points of the design; those not solved yet are "open".

    Raises
    ------
    InputError
        Where there is no sweep, or its file is damaged.
    """
    path = Path(folder) / NAME
    refuse_unreadable(path)
    with _told(path):
        file = _opened(path, "rw")
        try:
            file.execute("BEGIN")
            asked = file.execute("SELECT name, value FROM sweep").fetchall()
            rows = file.execute(
                "SELECT number, inputs, refused, status, reason, seconds, version, summary "
                "FROM points LEFT JOIN results USING (key) ORDER BY number"
            ).fetchall()
        finally:
            file.close()
    try:
        return _results({name: json.loads(value) for name, value in asked}, rows)
    except (InputError, LookupError, TypeError, ValueError):
        raise InputError(path, "is not a sweep of ehlectric, or damaged") from None


def saved_points(folder: str | Path) -> tuple[int, int]:
    """How many points of a sweep have been tried and saved, and how many it has.

    Raises
    ------
    InputError
        As ``read_sweep``.
    """
    path = Path(folder) / NAME
    with _told(path):
        file = _opened(path, "rw")
        try:
            saved, points = file.execute(
                "SELECT count(CASE WHEN points.key IS NULL OR results.key IS NOT NULL THEN 1 END), count(*) "
                "FROM points LEFT JOIN results USING (key)"
            ).fetchone()
        finally:
            file.close()
    return saved, points


def _results(asked: Mapping[str, Any], rows: Sequence[tuple[Any, ...]]) -> SweepResults:
    case = case_of_dict(tomllib.loads(asked["case"]))
    return SweepResults(
        case=case,
        design=asked["design"],
        axes={key: tuple(values) for key, values in asked["axes"].items()},
        ranges={key: Range(**over) for key, over in asked["ranges"].items()},
        samples=asked["samples"],
        points=tuple(_point(case, *row) for row in _parsed(rows)),
        seed=asked["seed"],
        title=asked["title"],
    )


def _parsed(rows: Sequence[tuple[Any, ...]]) -> Iterator[tuple[Any, ...]]:
    """Rows with their JSON read, many at a time: so they share their keys, which else fill the memory."""
    for start in range(0, len(rows), 1000):
        some = rows[start : start + 1000]
        texts = ",".join(f"[{inputs},{summary or 'null'}]" for _, inputs, *_, summary in some)
        for (number, _, *others, _), (inputs, summary) in zip(some, json.loads(f"[{texts}]"), strict=True):
            yield number, inputs, summary, *others


def _point(
    case: AnyCase,
    number: int,
    inputs: dict[str, Any],
    summary: dict[str, Any] | None,
    refused: str,
    status: Status | None,
    *found: Any,
) -> Point:
    if refused or status is None:
        return Point(number, inputs, "failed" if refused else "open", refused)
    reason, seconds, version = found
    if summary is not None:
        # A title is no part of the key: rows of another sweep may have come with theirs.
        summary["title"] = inputs.get("title", case.title)
    return Point(number, inputs, status, reason, summary, seconds, version)


def _opened(path: Path, mode: str) -> sqlite3.Connection:
    """A connection to a file that is empty or a sweep's."""
    file = sqlite3.connect(
        f"{path.absolute().as_uri()}?mode={mode}", uri=True, timeout=_PATIENCE, isolation_level=None
    )
    try:
        (application,) = file.execute("PRAGMA application_id").fetchone()
        (version,) = file.execute("PRAGMA user_version").fetchone()
        (tables,) = file.execute("SELECT count(*) FROM sqlite_master").fetchone()
        if (application, version) != (_APPLICATION, _VERSION) and (tables or mode != "rwc"):
            later = application == _APPLICATION and version > _VERSION
            raise InputError(path, f"is {'of a later version' if later else 'not a sweep'} of ehlectric")
    except BaseException:
        file.close()
        raise
    return file


def _locked(path: Path) -> sqlite3.Connection:
    """A lock that ends with this process, however that ends, and holds on network file systems too."""
    lock = sqlite3.connect(path, timeout=0.0, isolation_level=None)
    try:
        lock.execute("BEGIN EXCLUSIVE")
    except sqlite3.Error as error:
        lock.close()
        if getattr(error, "sqlite_errorcode", 0) & 0xFF == sqlite3.SQLITE_BUSY:
            raise InputError(
                path.parent, "is being written to by another sweep", takes="a folder of its own"
            ) from None
        raise InputError(path, f"cannot be used, {error}") from None
    return lock


@contextmanager
def _told(path: Path) -> Iterator[None]:
    """Errors of SQLite as one line."""
    try:
        yield
    except sqlite3.OperationalError as error:
        raise InputError(path, f"cannot be used, {error}") from None
    except sqlite3.DatabaseError as error:
        raise InputError(path, f"is not a sweep of ehlectric, or damaged: {error}") from None
