"""Storage of a sweep in one SQLite file: its input, its points, and the outcome of each point."""

from __future__ import annotations

import json
import os
import sqlite3
from collections.abc import Iterable, Iterator
from contextlib import ExitStack, closing, contextmanager, suppress
from dataclasses import asdict
from pathlib import Path
from typing import Any, Self

from ehlectric.errors import DamagedError, InputError, WriteError
from ehlectric.runtime.checks.schema import refusing
from ehlectric.runtime.files import ADVICE, now, refuse_special
from ehlectric.runtime.folders import locked
from ehlectric.runtime.reading import regular
from ehlectric.runtime.sizes import check_size
from ehlectric.sweep.content import SEALS, check_results, check_seals, check_tables, results_of, seal_of_row
from ehlectric.sweep.inputs import Sweep
from ehlectric.sweep.plan import Outcome, Planned
from ehlectric.sweep.results import SweepResults
from ehlectric.version import __version__

NAME = "sweep.sqlite"

# File that is locked while the database is open for writing; it is removed afterwards.
LOCK = ".ehlectric-sweep.lock"

# SQLite's application id marks the file as a sweep of ehlectric: its bytes are the letters "ehle". The
# version is that of the tables in the file.
_APPLICATION = 0x65686C65
_VERSION = 1

# Error codes of SQLite for a full disk and for a write that fails, as at a limit of the size of files.
_FULL = (sqlite3.SQLITE_FULL, sqlite3.SQLITE_IOERR_WRITE, sqlite3.SQLITE_IOERR_FSYNC)
# Error codes of SQLite that say nothing of the content of a file, but that it is locked, or of its disk.
_UNUSABLE = (
    sqlite3.SQLITE_PERM,
    sqlite3.SQLITE_ABORT,
    sqlite3.SQLITE_BUSY,
    sqlite3.SQLITE_LOCKED,
    sqlite3.SQLITE_READONLY,
    sqlite3.SQLITE_INTERRUPT,
    sqlite3.SQLITE_IOERR,
    sqlite3.SQLITE_FULL,
    sqlite3.SQLITE_CANTOPEN,
    sqlite3.SQLITE_PROTOCOL,
    sqlite3.SQLITE_AUTH,
    sqlite3.SQLITE_NOLFS,
)

# Largest size of a file: that of a sweep of the most points, with room to spare [bytes]. Ratio of the memory
# that its results take to this size.
_LARGEST, _COPIES = 8_000_000_000, 3.0

# Longest time that a reader and the writer wait for each other [s].
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
CREATE TABLE IF NOT EXISTS seals (key TEXT PRIMARY KEY, seal INTEGER NOT NULL);
"""

# SQL condition for an outcome that is final. A failed point is tried again if its process was killed or
# ran out of memory, or if another version of ehlectric failed.
_DONE = f"(results.status <> 'failed' OR (NOT results.again AND results.version = '{__version__}'))"


class Store:
    """File of a sweep, opened by the single process that writes it; a context manager.

    Every ``write`` is a synchronous transaction in SQLite's rollback journal. What it has written survives a
    crash of the machine, and a reader needs no second file. (A write-ahead log would be faster, but does not
    work on network file systems.)

    Parameters
    ----------
    folder : Path
        Folder of the sweep.

    Raises
    ------
    InputError
        By every method, if the file cannot be used, is not a sweep, or is written by another process.
    """

    def __init__(self, folder: Path) -> None:
        self._path = folder / NAME
        refuse_special(self._path)
        with ExitStack() as stack:
            stack.enter_context(locked(folder, LOCK))
            stack.callback(_remove_empty, self._path)
            with _one_line_errors(self._path):
                self._file = _opened(self._path, "rwc")
                stack.callback(self._file.close)
                _check_stored(self._path, self._file)
                self._file.execute("PRAGMA journal_mode = TRUNCATE")
                self._file.execute("PRAGMA synchronous = FULL")
            self._held = stack.pop_all()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        with suppress(sqlite3.Error):
            # Deletes the empty journal file.
            self._file.execute("PRAGMA journal_mode = DELETE")
        self._held.close()

    def begin(self, sweep: Sweep, planned: Iterable[Planned]) -> None:
        """Replace the stored input and points by those of a sweep; stored outcomes are kept."""
        settings = {
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
                [(name, json.dumps(value)) for name, value in settings.items()],
            )
            self._file.executemany("INSERT INTO points VALUES (?, ?, ?, ?)", rows)

    def open_points(self) -> list[tuple[str, dict[str, Any]]]:
        """Keys and inputs of the points that are still to be solved, each case once."""
        with _one_line_errors(self._path):
            rows = self._file.execute(
                "SELECT points.key, inputs, min(number) FROM points LEFT JOIN results USING (key) "
                f"WHERE points.key IS NOT NULL AND (results.key IS NULL OR NOT {_DONE}) "
                "GROUP BY points.key ORDER BY min(number)"
            ).fetchall()
        return [(key, json.loads(inputs)) for key, inputs, _ in rows]

    def counts(self) -> dict[str, int]:
        """Number of points by status; points that are to be tried again count as "open"."""
        with _one_line_errors(self._path):
            rows = self._file.execute(
                "SELECT CASE WHEN points.key IS NULL THEN 'failed' "
                f"WHEN results.key IS NULL OR NOT {_DONE} THEN 'open' ELSE results.status END AS status, "
                "count(*) FROM points LEFT JOIN results USING (key) GROUP BY 1"
            ).fetchall()
        return dict(rows)

    def write(self, rows: Iterable[tuple[str, Outcome]]) -> None:
        """Commit the outcomes of points, given with their keys."""
        values = [
            (
                key, outcome.status, outcome.reason, int(outcome.again),
                None if outcome.summary is None else json.dumps(outcome.summary, allow_nan=False),
                outcome.seconds, outcome.version, outcome.date,
            )
            for key, outcome in rows
        ]  # fmt: skip
        with self._transaction():
            self._file.executemany("INSERT OR REPLACE INTO results VALUES (?, ?, ?, ?, ?, ?, ?, ?)", values)
            seals = [(row[0], seal_of_row(row)) for row in values]
            self._file.executemany(f"INSERT OR REPLACE INTO {SEALS} VALUES (?, ?)", seals)

    @contextmanager
    def _transaction(self) -> Iterator[None]:
        """Commit what is written in the context, or roll it back if an exception is raised."""
        with _one_line_errors(self._path):
            self._file.execute("BEGIN IMMEDIATE")
            try:
                yield
                self._file.execute("COMMIT")
            except BaseException:
                if self._file.in_transaction:
                    self._file.execute("ROLLBACK")
                raise


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
    """
    path = Path(folder) / NAME
    with regular(path) as opened:
        check_size(path, os.fstat(opened.fileno()).st_size, _LARGEST, copies=_COPIES)
    with _reading(path) as file:
        check_tables(file)
        results = results_of(file)
        check_seals(file)
    return results


def saved_points(folder: str | Path) -> tuple[int, int]:
    """Number of points of a sweep that have been tried and saved, and number of all its points.

    Parameters
    ----------
    folder : str or Path
        Folder of the sweep. Only its file sweep.sqlite is read.

    Raises
    ------
    InputError
        If the file cannot be used, or is not a sweep.
    """
    with _reading(Path(folder) / NAME) as file:
        saved, points = file.execute(
            "SELECT count(CASE WHEN points.key IS NULL OR results.key IS NOT NULL THEN 1 END), count(*) "
            "FROM points LEFT JOIN results USING (key)"
        ).fetchone()
    return saved, points


@contextmanager
def _reading(path: Path) -> Iterator[sqlite3.Connection]:
    """Context with a connection that reads in a transaction; all its errors are one line."""
    with _one_line_errors(path), closing(_opened(path, "rw")) as file:
        file.execute("BEGIN")
        with refusing(path):
            yield file


def _check_stored(path: Path, file: sqlite3.Connection) -> None:
    """Check what an open file has stored before points are added to it; a new file has nothing yet."""
    (tables,) = file.execute("SELECT count(*) FROM sqlite_master").fetchone()
    with refusing(path):
        if tables:
            check_tables(file)
            check_results(file)
            check_seals(file)


def _opened(path: Path, mode: str) -> sqlite3.Connection:
    """Connection to a file, which must be empty or the file of a sweep."""
    file = sqlite3.connect(
        f"{path.absolute().as_uri()}?mode={mode}", uri=True, timeout=_PATIENCE, isolation_level=None
    )
    try:
        (application,) = file.execute("PRAGMA application_id").fetchone()
        (version,) = file.execute("PRAGMA user_version").fetchone()
        (tables,) = file.execute("SELECT count(*) FROM sqlite_master").fetchone()
        known = application == _APPLICATION and 1 <= version <= _VERSION
        if not known and (tables or mode != "rwc"):
            later = application == _APPLICATION and version > _VERSION
            raise InputError(path, f"is {'of a later version' if later else 'not a sweep'} of ehlectric")
    except BaseException:
        file.close()
        raise
    return file


def _remove_empty(path: Path) -> None:
    """Remove a file to which nothing was written, as on a full disk."""
    if path.is_file() and not path.stat().st_size:
        path.unlink()


@contextmanager
def _one_line_errors(path: Path) -> Iterator[None]:
    """Context manager in which errors of SQLite become an InputError of one line."""
    try:
        yield
    except sqlite3.Error as error:
        full = getattr(error, "sqlite_errorcode", 0)
        if full in _FULL:
            raise WriteError(path, f"cannot be written to, {error}{ADVICE}") from None
        code = full & 0xFF
        if code in _UNUSABLE:
            raise InputError(path, f"cannot be used, {error}") from None
        if code == sqlite3.SQLITE_NOTADB:
            raise InputError(path, "is not a sweep of ehlectric") from None
        raise DamagedError.of(path, f"SQLite says: {error}") from None
    except UnicodeDecodeError:  # of the text of an error that quotes damaged bytes
        raise DamagedError.of(path, "SQLite cannot read its tables") from None
