"""Files that are written whole or not at all, folders for them, values that JSON can hold, and tables in
CSV.
"""

from __future__ import annotations

import csv
import errno
import json
import math
import os
import re
import secrets
import shutil
import stat
import tempfile
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager, suppress
from datetime import UTC, datetime
from io import TextIOWrapper
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np

from ehlectric.errors import InputError, WriteError
from ehlectric.runtime.locks import RENAMES_OPEN, held_back, try_lock

# Content of a file, or a function that writes it to an open file.
Content = bytes | Callable[[BinaryIO], object]

# Beginning of the names of files that are being written, and pattern of such names, which no other program
# chooses.
_HIDDEN = ".ehlectric-"
_LEFT = re.compile(r"\.ehlectric-[0-9a-f]{16}(\.[^.]*)?")

# Errors of a full disk or quota, and what to do about them.
_FULL = tuple(getattr(errno, name) for name in ("ENOSPC", "EDQUOT", "EFBIG") if hasattr(errno, name))
ADVICE = "; free some space, or choose another folder"

# Flags with which a name that somebody else may have made is opened: no link, and no wait for a pipe.
_SAFELY = getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_NONBLOCK", 0)

# Space that any result needs, and space below which a disk counts as full once a file on it failed [bytes].
_LITTLE, _BLOCK = 1 << 14, 1 << 16

# Errors of files that cannot be flushed, on some file systems.
_NO_FLUSH = (errno.EINVAL, errno.ENOSYS, errno.ENOTSUP)


def plain(value: Any) -> Any:
    """JSON value: NumPy scalars become Python numbers, and numbers that are not finite None.

    Examples
    --------
    >>> plain({"load": np.float64(20.0), "error": float("nan"), "at": (1, 2)})
    {'load': 20.0, 'error': None, 'at': [1, 2]}
    """
    if isinstance(value, dict):
        return {key: plain(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [plain(item) for item in value]
    if isinstance(value, np.generic):
        value = value.item()
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value


def prepare(folder: str | Path, names: Iterable[str] = ()) -> Path:
    """Make a folder for results and check that files can be written into it.

    Call it before anything is solved, so that no result is lost.

    ``folder``, folder of the files; it is made if it does not exist. Raises InputError where the folder
    cannot be made or written to, or a folder, a device or a broken link has one of the names.
    """
    folder = Path(folder)
    if folder.exists() and not folder.is_dir():
        raise InputError(folder, "cannot be written to, it is no folder")
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=folder) as file:
            file.write(bytes(_LITTLE))
    except OSError as error:
        reason = (error.strerror or str(error)).lower()
        raise WriteError(folder, f"cannot be written to, {reason}{ADVICE * (error.errno in _FULL)}") from None
    for name in names:
        refuse_special(folder / name)
    return folder


def refuse_special(path: Path) -> None:
    """Refuse to write a file where a folder, a device or a broken link is. Raises InputError where ``path``
    exists and is no regular file.
    """
    try:
        # One look at it: another command may remove a file of its own between two.
        mode = path.lstat().st_mode
    except (OSError, ValueError):
        return
    if not (stat.S_ISREG(mode) or (stat.S_ISLNK(mode) and path.is_file())):
        raise InputError(path, "cannot be written to, it is no regular file")


def check_target(path: Path) -> None:
    """Check that a file can be written, before it is computed. Raises InputError where its folder does not
    exist or cannot be written to, or where it is no regular file.
    """
    if not path.parent.is_dir():
        raise InputError(path, "cannot be written to, its folder does not exist")
    prepare(path.parent, [path.name])


@contextmanager
def reading(path: str | Path) -> Iterator[None]:
    """Context in which a file is read: an OSError becomes an InputError of one line. Raises InputError where
    an OSError is raised within the context.

    Examples
    --------
    >>> with reading("no.toml"):
    ...     text = Path("no.toml").read_text()
    Traceback (most recent call last):
    ehlectric.errors.InputError: no.toml: cannot be read, no such file or directory
    """
    try:
        yield
    except OSError as error:
        raise InputError(path, f"cannot be read, {(error.strerror or str(error)).lower()}") from None


def clear(folder: Path, names: Iterable[str]) -> None:
    """Remove files of an earlier result: a folder holds the files of one result only."""
    for name in names:
        (folder / name).unlink(missing_ok=True)


@contextmanager
def whole(path: Path) -> Iterator[Path]:
    """Context that writes a file whole or not at all.

    Yields a new empty file in the same folder, with a hidden name. It is renamed to ``path`` where the
    context ends without an exception, and removed otherwise. Its permissions are the permissions of any new
    file of the process. If ``path`` is a link, its target is replaced.

    Raises WriteError where the file cannot be written, as on a full disk.
    """
    with _new_file(path) as (new, finish):
        yield new
        finish()
        new.replace(path.resolve())


@contextmanager
def _new_file(path: Path) -> Iterator[tuple[Path, Callable[[], None]]]:
    """Context with a new file in the folder of a path, and a function that brings its content to the disk."""
    # The name is known before the file is made: a signal in between must not leave the file behind.
    new = path.resolve().with_name(f"{_HIDDEN}{secrets.token_hex(8)}{path.suffix}")
    fd = -1

    def finish() -> None:
        nonlocal fd
        flush(fd)
        if not RENAMES_OPEN:
            os.close(fd)
            fd = -1

    try:
        with writing(path, new):
            # The kernel takes the umask off this mode: the umask can only be read by changing it.
            fd = os.open(new, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o666)
            try_lock(fd)
            yield new, finish
    finally:
        if fd >= 0:
            os.close(fd)
        new.unlink(missing_ok=True)


def flush(fd: int) -> None:
    """Bring the content of an open file to the disk; network file systems report a full disk only then."""
    try:
        os.fsync(fd)
    except OSError as error:
        if error.errno not in _NO_FLUSH:
            raise


@contextmanager
def writing(path: Path, *others: Path) -> Iterator[None]:
    """Context in which a file is written: an OSError becomes a WriteError of one line that names it. Raises
    WriteError where an OSError about these files, or about no file, is raised within the context.

    Examples
    --------
    >>> with writing(Path("film.csv")):
    ...     raise OSError(errno.EROFS, "Read-only file system")
    Traceback (most recent call last):
    ehlectric.errors.WriteError: film.csv: cannot be written to, read-only file system
    """
    try:
        yield
    except BrokenPipeError:
        raise
    except OSError as error:
        if error.filename is not None and Path(os.fsdecode(error.filename)) not in (path, *others):
            raise
        reason = (error.strerror or str(error)).lower()
        raise WriteError(path, f"cannot be written to, {reason}{ADVICE * (error.errno in _FULL)}") from None


def refuse_full(path: Path) -> None:
    """Refuse to go on where the disk of a file is full, for programs that do not say why they cannot write.
    Raises WriteError where the disk has almost no block left.
    """
    with writing(path):
        if shutil.disk_usage(path.resolve().parent).free < _BLOCK:
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))


def write(path: Path, content: Content) -> None:
    """Write a file whole or not at all. Raises WriteError where the file cannot be written, as on a full
    disk.
    """
    with whole(path) as new:
        _fill(new, content)


def write_together(folder: Path, contents: Mapping[str, Content], replaced: Iterable[str] = ()) -> list[Path]:
    """Write the files of a result, all of them or none. Returns files written, in the order of ``contents``.
    Raises WriteError where a file cannot be written, as on a full disk.
    """
    files = [folder / name for name in contents]
    with ExitStack() as stack:
        hidden = []
        for path, content in zip(files, contents.values(), strict=True):
            new, finish = stack.enter_context(_new_file(path))
            with writing(path, new):
                _fill(new, content)
                finish()
            hidden.append(new)
        with held_back():
            # Without the earlier files first, a kill could leave files of both results.
            clear(folder, {*replaced, *contents})
            for path, new in zip(files, hidden, strict=True):
                with writing(path, new):
                    new.replace(path)
    return files


def _fill(path: Path, content: Content) -> None:
    with path.open("w+b") as file:
        if callable(content):
            content(file)
        else:
            file.write(content)


def clear_left_behind(folder: Path) -> None:
    """Remove the hidden files that killed writers left in a folder, and no file of a writer that lives.

    The kernel releases the lock of a file with its writer. If the file system has no locks, nothing is
    removed.
    """
    with os.scandir(folder) as entries:
        hidden_files = [entry.path for entry in entries if _LEFT.fullmatch(entry.name)]
    for path in hidden_files:
        with suppress(OSError):  # another command has removed it, or it belongs to another user
            fd = os.open(path, os.O_RDONLY | _SAFELY)
            try:
                if try_lock(fd) == "taken" and stat.S_ISREG(os.fstat(fd).st_mode):
                    Path(path).unlink()
            finally:
                os.close(fd)


def json_of(table: Mapping[str, Any]) -> bytes:
    """Content of a JSON file. Raises ValueError where a number is not finite; ``plain`` turns such numbers
    into None.
    """
    return (json.dumps(table, indent=2, allow_nan=False) + "\n").encode()


def write_json(path: Path, table: Mapping[str, Any]) -> None:
    """Write a table as a JSON file, whole or not at all. Raises ValueError where a number is not finite;
    ``plain`` turns such numbers into None; WriteError where the file cannot be written, as on a full disk.
    """
    write(path, json_of(table))


def now() -> str:
    """Date and time in UTC, ISO 8601."""
    return datetime.now(UTC).isoformat(timespec="seconds")


def column_head(name: str, unit: str) -> str:
    """Head of a column of numbers: its name, and its unit in brackets, a hyphen for a dimensionless one.

    Examples
    --------
    >>> column_head("load", "N"), column_head("lambda_ratio", ""), column_head("zone_size", "m**2")
    ('load [N]', 'lambda_ratio [-]', 'zone_size [m^2]')
    """
    return f"{name} [{unit.replace('**', '^').replace('*', ' ') or '-'}]"


# First characters of a text that a spreadsheet takes for a formula.
_FORMULA = re.compile(r"'*+[=+\-@\t\r\n＝＋－＠]")

# A number, which no spreadsheet takes for anything else.
_NUMBER = re.compile(r"-?[0-9]++(?:\.[0-9]++)?(?:e[-+]?[0-9]++)?")


def csv_text(text: str) -> str:
    """Text for a cell of a CSV file, which no spreadsheet takes for a formula.

    A text that begins like a formula, with "=", "+", "-", "@", a tab or a line break, gets an apostrophe
    before it, which spreadsheets take for the mark of a text.

    Examples
    --------
    >>> csv_text("=HYPERLINK(A1)"), csv_text("6208, 70 °C")
    ("'=HYPERLINK(A1)", '6208, 70 °C')
    """
    # A text with apostrophes before the sign gets one more, so that the way back is certain.
    return f"'{text}" if _FORMULA.match(text) else text


def _cell(value: Any) -> Any:
    """Value for a cell: a number is unchanged, also one as text, and another text is no formula."""
    return csv_text(value) if isinstance(value, str) and not _NUMBER.fullmatch(value) else value


def csv_of(
    heads: Sequence[str], rows: Iterable[Iterable[Any]], *, ending: str = "\r\n"
) -> Callable[[BinaryIO], None]:
    """Function that writes a table as CSV in UTF-8 to an open file, with this ending of its lines.

    No text is taken for a formula by a spreadsheet, see ``csv_text``.
    """

    def content(file: BinaryIO) -> None:
        # Names of files may hold bytes that are no text in UTF-8; they are escaped.
        text = TextIOWrapper(file, encoding="utf-8", errors="backslashreplace", newline="")
        writer = csv.writer(text, lineterminator=ending)
        writer.writerow(map(_cell, heads))
        writer.writerows(map(_cell, row) for row in rows)
        text.detach()

    return content
