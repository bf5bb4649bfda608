"""Folders of results: one command at a time writes into a folder."""

from __future__ import annotations

import os
import time
from collections.abc import Iterable, Iterator
from contextlib import ExitStack, contextmanager, suppress
from contextvars import ContextVar
from pathlib import Path

from ehlectric.errors import InputError
from ehlectric.runtime.files import clear_left_behind, prepare, refuse_special, writing
from ehlectric.runtime.locks import try_lock
from ehlectric.runtime.progress import LOGGER

# Files that are locked while results, or what is made from stored results, are written into their folder.
# Figures and tables of a sweep may be made while its points are solved, so they have a lock of their own.
RESULT_LOCK, FIGURE_LOCK = ".ehlectric.lock", ".ehlectric-figures.lock"

# Longest time to wait for a command that draws figures, and time between two attempts [s]. Nobody waits for a
# command that solves; a command that has solved waits long.
_PATIENCE = {FIGURE_LOCK: 5.0}
_AGAIN = 0.05
LONG = 600.0

# Locks that the running call holds already: numbers of device and folder, and name of the lock.
_HELD: ContextVar[frozenset[tuple[int, int, str]]] = ContextVar("_HELD", default=frozenset())


@contextmanager
def alone_in(
    folder: str | Path,
    names: Iterable[str] = (),
    *,
    locks: Iterable[str] = (RESULT_LOCK, FIGURE_LOCK),
    patience: float | None = None,
) -> Iterator[Path]:
    """Context in which no other command writes into a folder.

    The folder is made if it does not exist, and removed again where an exception leaves it empty. Hidden
    files that killed commands left there are removed. Contexts of one folder may be nested.

    ``patience``, longest time to wait for another command [s]; by default a few seconds for figures, none for
    results. Raises InputError where the folder or a name cannot be used, or another command writes into the
    folder.

    The kernel keeps the lock on a hidden file of the folder, and releases it when the process ends, also by
    a kill. On a file system without locks the context warns in the log and goes on.
    """
    folder = Path(folder)
    made = [parent for parent in (folder, *folder.parents) if not parent.exists()]
    try:
        prepare(folder, names)
        place = folder.stat()
        keys = {name: (place.st_dev, place.st_ino, name) for name in locks}
        new = [name for name, key in keys.items() if key not in _HELD.get()]
        token = _HELD.set(_HELD.get() | set(keys.values()))
        try:
            with ExitStack() as stack:
                for name in new:
                    stack.enter_context(locked(folder, name, patience))
                if new:
                    clear_left_behind(folder)
                yield folder
        finally:
            _HELD.reset(token)
    except BaseException:
        for parent in made:
            with suppress(OSError):  # it holds something
                parent.rmdir()
        raise


@contextmanager
def locked(folder: Path, name: str, patience: float | None = None) -> Iterator[None]:
    """Context that holds a lock of a folder, which must exist; contexts of one lock cannot be nested.
    ``patience``, longest time to wait for another holder [s]. Raises InputError where the lock is held
    already, by this process or another.
    """
    path = folder / name
    fd = _taken(folder, path, _PATIENCE.get(name, 0.0) if patience is None else patience)
    try:
        yield
    finally:
        # Removed before it is released: nobody else can have locked it. Windows removes no open file.
        if os.name == "posix":
            with suppress(OSError):  # the folder may be gone, or no longer be writable
                path.unlink()
        os.close(fd)


def _taken(folder: Path, path: Path, patience: float) -> int:
    """Descriptor of a locked file. Raises InputError where another command holds the lock."""
    until = time.monotonic() + patience
    refuse_special(path)
    while True:
        with writing(path):
            fd = os.open(path, os.O_RDWR | os.O_CREAT, 0o666)
        try:
            state = try_lock(fd)
            if state == "none":
                LOGGER.warning("%s: has no locks; only one command at a time may write into it", folder)
            if state != "busy" and _same(fd, path):
                return fd
        except BaseException:
            os.close(fd)
            raise
        os.close(fd)
        if state == "busy" and time.monotonic() >= until:
            raise InputError(folder, "is being written to by another ehlectric", takes="a folder of its own")
        time.sleep(_AGAIN if state == "busy" else 0.0)


def _same(fd: int, path: Path) -> bool:
    """Whether an open file still has its path: the last holder of its lock may have removed it."""
    try:
        return os.path.samestat(os.fstat(fd), path.stat())
    except FileNotFoundError:
        return False
