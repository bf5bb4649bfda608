"""Journals: SQLite files to which one process adds rows, and which a kill at any moment leaves whole.

Sweeps keep their points in a journal, and runs with moving roughness their instants.
"""

from __future__ import annotations

import json
import os
import sqlite3
import zlib
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import ExitStack, closing, contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Self

from ehlectric.errors import DamagedError, InputError, WriteError
from ehlectric.runtime.file_rules import UnfitError, refusing
from ehlectric.runtime.files import ADVICE, refuse_special
from ehlectric.runtime.folders import locked
from ehlectric.runtime.reading import regular
from ehlectric.runtime.sizes import check_size

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

# Largest size of a file, which is larger than a sweep of the most points [bytes]. Ratio of the memory
# that its content takes to this size.
_LARGEST, _COPIES = 8_000_000_000, 3.0

# Longest time that a reader and the writer wait for each other [s].
_PATIENCE = 60.0


@dataclass(frozen=True)
class JournalForm:
    """Kind of a journal: its tables, and how its file is recognised."""

    name: str  # name of the kind in messages, as "sweep"
    application: int  # SQLite's application id of the file, which four letters give
    version: int  # latest version of the tables, SQLite's user version
    tables: str  # statements of SQL that create the tables
    # Columns of the tables by name that every version contains.
    columns: Mapping[str, tuple[str, ...]]


class Journal:
    """Journal that is opened by the single process that writes it; a context manager.

    Every transaction is synchronous, in SQLite's rollback journal. What it has written survives a crash of
    the machine, and a reader needs no second file. (A write-ahead log would be faster, but does not work on
    network file systems.)

    Raises InputError by every method, if the file cannot be used, is of another kind, or is written by
    another process; DamagedError if the file is damaged.
    """

    def __init__(self, path: Path, form: JournalForm, check: Callable[[sqlite3.Connection], None]) -> None:
        # ``check`` raises UnfitError if the rows of the file are not as they were written.
        self.path, self.form = path, form
        refuse_special(path)
        with ExitStack() as stack:
            stack.enter_context(locked(path.parent, lock_of(path)))
            stack.callback(_remove_empty, path)
            with self.one_line_errors():
                self.file = _opened(path, form, "rwc")
                stack.callback(self.file.close)
                with refusing(path):
                    if not self.empty:
                        _check_tables(self.file, form)
                        check(self.file)
                self.file.execute("PRAGMA journal_mode = TRUNCATE")
                self.file.execute("PRAGMA synchronous = FULL")
            self._held = stack.pop_all()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        with suppress(sqlite3.Error):
            # Deletes the empty rollback journal.
            self.file.execute("PRAGMA journal_mode = DELETE")
        self._held.close()

    @property
    def empty(self) -> bool:
        """Whether the file is new, without tables."""
        return not _number_of_tables(self.file)

    @contextmanager
    def transaction(self, *, create: bool = False) -> Iterator[sqlite3.Connection]:
        """Commit what is written in the context, or roll it back if an exception is raised.

        With ``create`` the tables are created first if the file lacks them.
        """
        with self.one_line_errors():
            self.file.execute("BEGIN IMMEDIATE")
            try:
                for statement in self._creation if create else ():
                    self.file.execute(statement)
                yield self.file
                self.file.execute("COMMIT")
            except BaseException:
                if self.file.in_transaction:
                    self.file.execute("ROLLBACK")
                raise

    @property
    def _creation(self) -> list[str]:
        marks = f"PRAGMA application_id = {self.form.application}; PRAGMA user_version = {self.form.version}"
        return [*self.form.tables.split(";"), *marks.split(";")]

    @contextmanager
    def one_line_errors(self) -> Iterator[None]:
        """Context in which errors of SQLite become an InputError of one line."""
        with _one_line_errors(self.path, self.form):
            yield


@contextmanager
def reading(path: Path, form: JournalForm, *, checked: bool = False) -> Iterator[sqlite3.Connection]:
    """Context with a connection that reads in a transaction, also while another process writes.

    ``checked`` says whether size and pages of the file are checked first. Raises InputError if the file
    cannot be used, or is of another kind; DamagedError if it is damaged, or an UnfitError is raised within.
    """
    if checked:
        with regular(path) as opened:
            check_size(path, os.fstat(opened.fileno()).st_size, _LARGEST, copies=_COPIES)
    with _one_line_errors(path, form), closing(_opened(path, form, "rw")) as file:
        file.execute("BEGIN")
        with refusing(path):
            if checked:
                _check_tables(file, form)
            yield file


def seal_of_row(row: Sequence[Any]) -> int:
    """Checksum of the values of a row.

    Examples
    --------
    >>> seal_of_row(["a key", "solved", 1.5]) == seal_of_row(["a key", "solved", 9.5])
    False
    """
    total = zlib.crc32(json.dumps([v for v in row if not isinstance(v, bytes)], default=repr).encode())
    for content in row:
        total = zlib.crc32(content, total) if isinstance(content, bytes) else total
    return total


def _check_tables(file: sqlite3.Connection, form: JournalForm) -> None:
    """Check the structure of a database and its tables, in an open transaction. Raises UnfitError where pages
    or indices of the file are damaged, or a table is missing or is of another kind; sqlite3.Error where the
    file cannot be read.
    """
    entries = file.execute("SELECT type, name FROM sqlite_master").fetchall()
    if any(kind in ("view", "trigger") for kind, _ in entries):
        raise UnfitError(f"it has a view or a trigger, which no {form.name} has")
    for table, columns in form.columns.items():
        if ("table", table) not in entries:
            raise UnfitError(f"the table {table} is missing")
        present = {row[1] for row in file.execute(f"PRAGMA table_info({table})")}
        for column in columns:
            if column not in present:
                raise UnfitError(f"{column} of the table {table} is missing")
    (verdict,) = file.execute("PRAGMA integrity_check(1)").fetchone()
    if verdict != "ok":
        raise UnfitError("its pages do not fit together")


def lock_of(path: Path) -> str:
    """Name of the file that is locked in the folder of a journal while a process may write to it."""
    return f".ehlectric-{path.stem}.lock"


def remove(path: Path) -> None:
    """Remove a journal that no process writes to."""
    # SQLite would apply a rollback journal that is left behind to the next file of the name.
    path.with_name(f"{path.name}-journal").unlink(missing_ok=True)
    path.unlink(missing_ok=True)


def begun(path: Path) -> bool:
    """Whether a file of a journal exists and contains anything: a kill may leave an empty one."""
    return path.is_file() and path.stat().st_size > 0


def _opened(path: Path, form: JournalForm, mode: str) -> sqlite3.Connection:
    """Connection to a file, which must be empty or a journal of a kind."""
    file = sqlite3.connect(
        f"{path.absolute().as_uri()}?mode={mode}", uri=True, timeout=_PATIENCE, isolation_level=None
    )
    try:
        (application,) = file.execute("PRAGMA application_id").fetchone()
        (version,) = file.execute("PRAGMA user_version").fetchone()
        tables = _number_of_tables(file)
        ours = application == form.application
        known = ours and 1 <= version <= form.version
        if not known and (tables or mode != "rwc"):
            later = ours and version > form.version
            raise InputError(
                path, f"is {'of a later version' if later else f'not a {form.name}'} of ehlectric"
            )
    except BaseException:
        file.close()
        raise
    return file


def _number_of_tables(file: sqlite3.Connection) -> int:
    (tables,) = file.execute("SELECT count(*) FROM sqlite_master").fetchone()
    return int(tables)


def _remove_empty(path: Path) -> None:
    """Remove a file to which nothing was written, as on a full disk."""
    if path.is_file() and not path.stat().st_size:
        path.unlink()


@contextmanager
def _one_line_errors(path: Path, form: JournalForm) -> Iterator[None]:
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
            raise InputError(path, f"is not a {form.name} of ehlectric") from None
        raise DamagedError.of(path, f"SQLite says: {error}") from None
    except UnicodeDecodeError:  # of the text of an error that quotes damaged bytes
        raise DamagedError.of(path, "SQLite cannot read its tables") from None
