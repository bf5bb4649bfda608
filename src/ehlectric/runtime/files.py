"""Files written whole or not at all, folders made ready for them, and values as JSON takes them."""

from __future__ import annotations

import math
import os
import secrets
import tempfile
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import numpy as np

from ehlectric.errors import InputError

# It can only be read by setting it, for the whole process: once, at the start.
_UMASK = os.umask(0o077)
os.umask(_UMASK)


def plain(value: Any) -> Any:
    """JSON value: no NumPy scalars, and None for what is not finite."""
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
    """Make a folder for files of these names, before anything is solved.

    Parameters
    ----------
    folder : str or Path
        Where the files will go.
    names : iterable of str
        Files that will be written there.

    Returns
    -------
    Path
        The folder.

    Raises
    ------
    InputError
        Where it cannot be made or written to, or a name is taken by something that is no file.
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
    """Refuse to write where a folder, a device or a broken link is.

    Raises
    ------
    InputError
        Where ``path`` is there and no regular file.
    """
    if os.path.lexists(path) and not path.is_file():
        raise InputError(path, "cannot be written to, it is no regular file")


def clear(folder: Path, names: Iterable[str]) -> None:
    """Take files of an earlier result away: a folder holds one result, whole."""
    for name in names:
        (folder / name).unlink(missing_ok=True)


@contextmanager
def whole(path: Path) -> Iterator[Path]:
    """A path beside ``path`` to write to; it becomes ``path`` when all went well, else it goes.

    A link is followed, and its target replaced.
    """
    path = path.resolve()
    beside = path.with_name(f".{path.stem}-{secrets.token_hex(4)}{path.suffix}")
    # Named before it is made: a signal in between must not leave it behind.
    try:
        beside.touch(mode=0o600, exist_ok=False)
        yield beside
        beside.chmod(0o666 & ~_UMASK)
        beside.replace(path)
    finally:
        beside.unlink(missing_ok=True)


def now() -> str:
    """Date and time, ISO 8601."""
    return datetime.now(UTC).isoformat(timespec="seconds")
