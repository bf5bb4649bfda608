"""Temporary folder of a server, which holds those of its sessions and is removed with it."""

from __future__ import annotations

import contextlib
import os
import shutil
import tempfile
from multiprocessing.util import Finalize, get_temp_dir
from pathlib import Path

from ehlectric.runtime.locks import RENAMES_OPEN, take

# Names of the folders of servers, and of the file in each that its server keeps locked.
_PREFIX, _LOCK = "ehlectric-app-", "lock"

# Beginning of the name of the folder that multiprocessing makes for its sockets.
_MULTIPROCESSING = "pymp-"


# Longest path of a folder whose sockets have names that systems allow, of about 100 characters, below the
# folder that multiprocessing makes.
_LONGEST = 70


class Scratch:
    """Temporary folder of a server, which only this user can read.

    Attributes
    ----------
    folder : Path
        The folder.

    Examples
    --------
    >>> scratch = Scratch()
    >>> scratch.new().is_dir()
    True
    >>> scratch.remove()
    >>> scratch.folder.exists()
    False
    """

    def __init__(self) -> None:
        self.folder = Path(tempfile.mkdtemp(prefix=_PREFIX))
        # The file gets its name when it is locked, so that no other server takes the folder for a dead one's.
        begun = self.folder / ("unlocked" if RENAMES_OPEN else _LOCK)
        self._lock = begun.open("wb")
        take(self._lock.fileno())
        if RENAMES_OPEN:
            begun.rename(self.folder / _LOCK)
        # At exit, and after multiprocessing has removed its folder in it.
        Finalize(None, shutil.rmtree, (self.folder,), {"ignore_errors": True}, exitpriority=-200)

    def new(self) -> Path:
        """New folder in it."""
        return Path(tempfile.mkdtemp(prefix="session-", dir=self.folder))

    def remove(self) -> None:
        """Remove the folder with all that is in it; that of multiprocessing lasts until the exit."""
        for entry in list(self.folder.iterdir()) if self.folder.exists() else []:
            if entry.is_dir() and not entry.name.startswith(_MULTIPROCESSING):
                shutil.rmtree(entry, ignore_errors=True)
            elif not entry.is_dir():
                entry.unlink(missing_ok=True)
        self._lock.close()
        with contextlib.suppress(OSError):
            self.folder.rmdir()


def take_temporary_files(folder: Path) -> None:
    """Have this process put its temporary files into a folder, with the sockets of its workers if they fit.

    The names of sockets are bounded, so those below a long path lie in /tmp.
    """
    fits = len(str(folder)) <= _LONGEST or not Path("/tmp").is_dir()
    tempfile.tempdir = str(folder) if fits else "/tmp"
    # multiprocessing makes its folder for sockets once.
    get_temp_dir()
    tempfile.tempdir = str(folder)


def clear_left_behind() -> None:
    """Remove the folders of servers that were killed."""
    for folder in Path(tempfile.gettempdir()).glob(f"{_PREFIX}*"):
        if _left_behind(folder):
            shutil.rmtree(folder, ignore_errors=True)


def _left_behind(folder: Path) -> bool:
    """Whether a folder is this user's and its server has ended."""
    try:
        owner = getattr(os, "getuid", lambda: folder.lstat().st_uid)()
        if folder.is_symlink() or folder.lstat().st_uid != owner:
            return False
        with (folder / _LOCK).open("rb+") as file:
            return take(file.fileno()) == "taken"
    except OSError:
        # It is another user's, or it is being made or removed by its server.
        return False
