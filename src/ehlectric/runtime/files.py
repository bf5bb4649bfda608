"""Files that are written whole or not at all, folders for them, and values that JSON can hold."""

from __future__ import annotations

import json
import math
import os
import secrets
import tempfile
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import numpy as np

from ehlectric.errors import InputError


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

    Parameters
    ----------
    folder : str or Path
        Folder of the files; it is made if it does not exist.
    names : iterable of str
        Names of the files that will be written.

    Returns
    -------
    Path
        The folder.

    Raises
    ------
    InputError
        Where the folder cannot be made or written to, or a folder, a device or a broken link has one of the
        names.
    """
    folder = Path(folder)
    if folder.exists() and not folder.is_dir():
        raise InputError(folder, "cannot be written to, it is no folder")
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=folder):
            pass
    except OSError as error:
        reason = (error.strerror or str(error)).lower()
        raise InputError(folder, f"cannot be written to, {reason}") from None
    for name in names:
        refuse_special(folder / name)
    return folder


def refuse_special(path: Path) -> None:
    """Refuse to write a file where a folder, a device or a broken link is.

    Raises
    ------
    InputError
        Where ``path`` exists and is no regular file.
    """
    if os.path.lexists(path) and not path.is_file():
        raise InputError(path, "cannot be written to, it is no regular file")


@contextmanager
def reading(path: str | Path) -> Iterator[None]:
    """Context in which a file is read: an OSError becomes an InputError of one line.

    Raises
    ------
    InputError
        Where an OSError is raised within the context.

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

    Yields a new empty file in the same folder. It is renamed to ``path`` where the context ends without an
    exception, and removed otherwise. The file has the permissions of any new file of the process. Where
    ``path`` is a link, its target is replaced.
    """
    path = path.resolve()
    beside = path.with_name(f".{path.stem}-{secrets.token_hex(4)}{path.suffix}")
    # The name is known before the file is made: a signal in between must not leave the file behind.
    try:
        # The kernel takes the umask off this mode: the umask can only be read by changing it.
        os.close(os.open(beside, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o666))
        yield beside
        beside.replace(path)
    finally:
        beside.unlink(missing_ok=True)


def write_json(path: Path, table: Mapping[str, Any]) -> None:
    """Write a table as a JSON file, whole or not at all.

    Raises
    ------
    ValueError
        Where a number is not finite; ``plain`` turns such numbers into None.
    """
    with whole(path) as beside:
        beside.write_text(json.dumps(table, indent=2, allow_nan=False) + "\n", encoding="utf-8")


def now() -> str:
    """Date and time in UTC, ISO 8601."""
    return datetime.now(UTC).isoformat(timespec="seconds")
